//! The regulus of three lines, and its quadric.

use super::pluecker::Line;
use crate::motion::{Vector, dot};
use crate::unit::Unit;
use looproot_algebra::ring::Ring;

/// Returns the symmetric matrix of the quadric through three skew lines, in homogeneous coordinates (x, y, z, 1), up to a factor.
///
/// The plane of a point x and the first line cuts the second line in a point. The point x lies on the quadric if the third line
/// is in one plane with the two points: `x^T W3 L2 W1 x = 0` with the skew matrices W of planes and L of points.
///
/// # Example
/// ```
/// use looproot_calculus::line::{pluecker::Line, regulus::quadric};
/// let line = |p, d| Line::at(&p, &d);
/// // Three generators of x^2 + y^2 - z^2 = 1.
/// let lines = [
///     line([1.0, 0.0, 0.0], [0.0, 1.0, 1.0]), line([0.0, 1.0, 0.0], [-1.0, 0.0, 1.0]), line([-1.0, 0.0, 0.0], [0.0, -1.0, 1.0]),
/// ];
/// let q = quadric(&lines);
/// assert_eq!(q[0][0], q[1][1]);
/// assert_eq!(q[0][0], -q[2][2]);
/// assert_eq!(q[0][0], -q[3][3]);
/// ```
///
/// # Source
/// \[Wittenburg2016, 2.9.1\]
#[must_use]
pub fn quadric<R: Ring>(lines: &[Line<R>; 3]) -> [[R; 4]; 4] {
    let plane = |line: &Line<R>, k: usize| -> [R; 4] {
        // Row k of the matrix that takes a point p to its plane with the line: (p x d - m; m . p).
        let (d, m) = (&line.direction, &line.moment);
        let zero = R::zero();
        match k {
            0 => [zero, d[2].clone(), d[1].neg(), m[0].neg()],
            1 => [d[2].neg(), zero, d[0].clone(), m[1].neg()],
            2 => [d[1].clone(), d[0].neg(), zero, m[2].neg()],
            _ => [m[0].clone(), m[1].clone(), m[2].clone(), zero],
        }
    };
    let points = |line: &Line<R>| -> [[R; 4]; 4] {
        let (d, m) = (&line.direction, &line.moment);
        let zero = R::zero;
        [
            [zero(), m[2].clone(), m[1].neg(), d[0].neg()],
            [m[2].neg(), zero(), m[0].clone(), d[1].neg()],
            [m[1].clone(), m[0].neg(), zero(), d[2].neg()],
            [d[0].clone(), d[1].clone(), d[2].clone(), zero()],
        ]
    };
    let skew = |line: &Line<R>| -> [[R; 4]; 4] { std::array::from_fn(|k| plane(line, k)) };
    let product = |a: &[[R; 4]; 4], b: &[[R; 4]; 4]| -> [[R; 4]; 4] {
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let mut sum = R::zero();
                for k in 0..4 {
                    sum.add_product(&a[i][k], &b[k][j]);
                }
                sum
            })
        })
    };
    let form = product(&product(&skew(&lines[2]), &points(&lines[1])), &skew(&lines[0]));
    std::array::from_fn(|i| std::array::from_fn(|j| form[i][j].add(&form[j][i])))
}

/// Returns the line of the other family through a point of the first of three skew lines, which meets all three; `None` if
/// there is none.
#[must_use]
pub fn opposite<R: Unit>(lines: &[Line<R>; 3], point: &Vector<R>) -> Option<Line<R>> {
    let normal = |line: &Line<R>| -> Vector<R> {
        let turned = crate::motion::cross(point, &line.direction);
        std::array::from_fn(|i| turned[i].sub(&line.moment[i]))
    };
    let direction = crate::motion::cross(&normal(&lines[1]), &normal(&lines[2]));
    if dot(&direction, &direction).is_small() {
        return None;
    }
    Some(Line::at(point, &direction))
}
