//! Planes: `normal . x = distance`, with a normal of any length.

use super::pluecker::Line;
use crate::motion::{Motion, Vector, cross, dot};
use crate::rotation::matrix::apply;
use crate::rotation::positions::reflection;
use crate::unit::Unit;
use looproot_algebra::ring::Ring;

/// The points with `normal . x = distance`.
///
/// # Units
/// `distance` is in the unit of `normal` times a length.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane<R> {
    /// The normal, of any length.
    pub normal: Vector<R>,
    /// The product of the normal with every point of the plane.
    pub distance: R,
}

impl<R: Ring> Plane<R> {
    /// Returns the plane through three points; its normal is 0 for points in a line.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::line::plane::Plane;
    /// let plane = Plane::through(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    /// assert_eq!((plane.normal, plane.distance), ([1.0, 1.0, 1.0], 1.0));
    /// ```
    ///
    /// # Source
    /// \[Wittenburg2016, 2.1\]
    #[must_use]
    pub fn through(points: &[Vector<R>; 3]) -> Self {
        let from_first = |k: usize| -> Vector<R> { std::array::from_fn(|i| points[k][i].sub(&points[0][i])) };
        let normal = cross(&from_first(1), &from_first(2));
        let distance = dot(&normal, &points[0]);
        Self { normal, distance }
    }

    /// Returns the line that two planes share; its direction is 0 for parallel planes.
    #[must_use]
    pub fn meet(&self, other: &Self) -> Line<R> {
        Line::of_planes((&self.normal, &self.distance), (&other.normal, &other.distance))
    }
}

impl<R: Unit> Plane<R> {
    /// Returns the point of the plane nearest the origin; `None` for a plane without normal.
    #[must_use]
    pub fn foot(&self) -> Option<Vector<R>> {
        let share = self.distance.over(&dot(&self.normal, &self.normal))?;
        Some(self.normal.each_ref().map(|c| c.mul(&share)))
    }

    /// Returns the reflection in the plane, as a map with a matrix of determinant -1.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::line::plane::Plane;
    /// let mirror = Plane { normal: [2.0, 0.0, 0.0], distance: 6.0 }.mirror().unwrap();
    /// assert_eq!(mirror.apply(&[1.0, 5.0, 7.0]), [5.0, 5.0, 7.0]);
    /// ```
    ///
    /// # Source
    /// \[Wittenburg2016, 1.16\]
    #[must_use]
    pub fn mirror(&self) -> Option<Motion<R>> {
        let (rotation, foot) = (reflection(&self.normal)?, self.foot()?);
        let image = apply(&rotation, &foot);
        Some(Motion { rotation, translation: std::array::from_fn(|i| foot[i].sub(&image[i])) })
    }
}
