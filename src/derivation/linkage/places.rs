//! Places of points as polynomials in coordinates that are symbols.

use super::symbolic::Coordinate;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::Linkage;
use rug::Rational;

/// A polynomial in two variables and, from variable 2 on, the symbols.
pub(super) type Space = Polynomial<Rational>;
/// The two coordinates of a vector.
pub(super) type Plane = [Space; 2];

/// The points of a linkage, of which some coordinates are symbols.
pub(super) struct Places<'l> {
    pub linkage: &'l Linkage,
    pub symbols: &'l [Coordinate],
}

impl Places<'_> {
    /// Returns the place of a point of a body by its number.
    pub fn of_point(&self, body: usize, point: usize) -> Plane {
        let place = &self.linkage.bodies[body].points[point].1;
        [(0, &place.re), (1, &place.im)].map(|(axis, value)| {
            let is_own = |one: &Coordinate| (one.body, one.point, one.axis) == (body, point, axis);
            self.symbols.iter().position(is_own).map_or_else(|| constant(value), |k| Space::variable(2 + k))
        })
    }

    /// Returns the place of a joint in one of its bodies.
    pub fn of_joint(&self, joint: usize, side: usize) -> Plane {
        let joint = &self.linkage.joints[joint];
        let (body, place) = (joint.of[side], &joint.at[side]);
        let number = self.linkage.bodies[body].points.iter().position(|(_, at)| at == place);
        number.map_or_else(|| [constant(&place.re), constant(&place.im)], |number| self.of_point(body, number))
    }
}

pub(super) fn constant(value: &Rational) -> Space {
    Space::constant(value.clone())
}

pub(super) fn difference(a: &Plane, b: &Plane) -> Plane {
    [a[0].sub(&b[0]), a[1].sub(&b[1])]
}

/// Returns the factor of the cosine of a rotation in the inner product of a vector with another one that is turned by it.
pub(super) fn dot(a: &Plane, b: &Plane) -> Space {
    a[0].mul(&b[0]).add(&a[1].mul(&b[1]))
}

/// Returns the factor of its sine there.
pub(super) fn cross(a: &Plane, b: &Plane) -> Space {
    a[1].mul(&b[0]).sub(&a[0].mul(&b[1]))
}
