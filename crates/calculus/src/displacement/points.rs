//! Displacements from the displacements of points.

use crate::motion::{Motion, Vector};
use crate::rotation::matrix::apply;
use crate::rotation::positions::{nearest_rotation, taking};
use crate::unit::Unit;
use looproot_algebra::ring::Ring;

/// Points before and after a displacement.
pub type Moved<R> = (Vector<R>, Vector<R>);

fn difference<R: Ring>(a: &Vector<R>, b: &Vector<R>) -> Vector<R> {
    std::array::from_fn(|i| a[i].sub(&b[i]))
}

/// Returns the displacement of three points that are not in a line; `None` for points in a line. If distances have changed, the
/// result is no motion; [`crate::rotation::positions::is_rotation`] tests that.
///
/// # Example
/// ```
/// use looproot_calculus::displacement::points::of_three;
/// use rug::Rational;
/// let vector = |v: [i32; 3]| v.map(Rational::from);
/// let pair = |v, w| (vector(v), vector(w));
/// let motion = of_three(&[
///     pair([0, 0, 0], [1, 2, 3]), pair([1, 0, 0], [1, 3, 3]), pair([0, 1, 0], [0, 2, 3]),
/// ]).unwrap();
/// assert_eq!(motion.apply(&vector([0, 0, 5])), vector([1, 2, 8]));
/// ```
///
/// # Source
/// \[Wittenburg2016, 3.5\]
#[must_use]
pub fn of_three<R: Unit>(points: &[Moved<R>; 3]) -> Option<Motion<R>> {
    let [p, q, r] = points;
    let rotation =
        taking(&[difference(&q.0, &p.0), difference(&r.0, &p.0)], &[difference(&q.1, &p.1), difference(&r.1, &p.1)])?;
    let translation = difference(&p.1, &apply(&rotation, &p.0));
    Some(Motion { rotation, translation })
}

/// Returns three of the points that are not in a line; `None` if all are in a line.
#[must_use]
pub fn spread<R: Unit>(points: &[Vector<R>]) -> Option<[usize; 3]> {
    let first = points.first()?;
    let from_first = |k: usize| difference(&points[k], first);
    let second = (1..points.len()).find(|k| from_first(*k).iter().any(|c| !c.is_small()))?;
    let along = from_first(second);
    let is_beside = |k: &usize| crate::motion::cross(&along, &from_first(*k)).iter().any(|c| !c.is_small());
    let third = (1..points.len()).find(is_beside)?;
    Some([0, second, third])
}

/// Returns the displacement nearest to those of many points, in the sum of squares; `None` for points in a line.
///
/// # Source
/// \[Kabsch1976\]
#[must_use]
pub fn nearest(points: &[Moved<f64>]) -> Option<Motion<f64>> {
    let count = points.len() as f64;
    let mean = |of: fn(&Moved<f64>) -> &Vector<f64>| -> Vector<f64> {
        std::array::from_fn(|i| points.iter().map(|p| of(p)[i]).sum::<f64>() / count)
    };
    let (before, after) = (mean(|p| &p.0), mean(|p| &p.1));
    let centred: Vec<Moved<f64>> =
        points.iter().map(|(p, q)| (difference(p, &before), difference(q, &after))).collect();
    let rotation = nearest_rotation(&centred)?;
    let translation = difference(&after, &apply(&rotation, &before));
    Some(Motion { rotation, translation })
}

/// Returns the largest distance between the images of the points under a displacement and their given images.
#[must_use]
pub fn residual(points: &[Moved<f64>], motion: &Motion<f64>) -> f64 {
    let miss = |(p, q): &Moved<f64>| {
        let d = difference(&motion.apply(p), q);
        crate::motion::dot(&d, &d).sqrt()
    };
    points.iter().map(miss).fold(0.0, f64::max)
}
