//! Rotations that take a direction to a direction, and over the dual numbers the screws that take a line to a line.

use crate::motion::{Vector, dot};
use crate::quaternion::Quaternion;
use crate::unit::Root;
use looproot_algebra::ring::Ring;

use super::turn::Turn;

/// Returns the rotations that take the unit vector `before` to the unit vector `after`: `(cos f/2 + after sin f/2) m`, with m the
/// half turn about their bisector and a free angle f. `None` for opposite vectors, for which m may be any perpendicular half turn.
///
/// # Example
/// ```
/// use looproot_calculus::rotation::line::taking;
/// use looproot_calculus::rotation::{matrix::{apply, matrix}, turn::Turn};
/// let (x, y) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
/// for angle in [0.0, 0.7, 2.0] {
///     let q = taking(&x, &y, &Turn::of_angle(&(angle / 2.0))).unwrap();
///     assert!(apply(&matrix(&q).unwrap(), &x).iter().zip(&y).all(|(a, b)| (a - b).abs() < 1e-15));
/// }
/// ```
///
/// # Source
/// \[Wittenburg2016, 1.15.9 and 3.14\]
#[must_use]
pub fn taking<R: Root>(before: &Vector<R>, after: &Vector<R>, half: &Turn<R>) -> Option<Quaternion<R>> {
    let sum: Vector<R> = std::array::from_fn(|i| before[i].add(&after[i]));
    if dot(&sum, &sum).is_small() {
        return None;
    }
    let bisector = crate::unit::direction(&sum)?;
    Some(about(after, half).mul(&Quaternion { scalar: R::zero(), vector: bisector }))
}

/// Returns the quaternion of a rotation about a unit axis, from half its angle.
#[must_use]
pub fn about<R: Ring>(axis: &Vector<R>, half: &Turn<R>) -> Quaternion<R> {
    Quaternion { scalar: half.cos.clone(), vector: axis.each_ref().map(|c| c.mul(&half.sin)) }
}
