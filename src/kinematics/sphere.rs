//! Linkages on the sphere: a graph of bodies and revolute joints whose axes all pass through one point.

use looproot_calculus::motion::{Vector, cross, dot};
use looproot_calculus::rotation::matrix::Matrix;
use rug::Rational;

/// A direction from the common point, of any length.
pub type Direction = Vector<Rational>;

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereBody {
    /// Its name in the file.
    pub name: String,
    /// Its points as directions in coordinates of its own, in the order of the file.
    pub points: Vec<(String, Direction)>,
    /// Line of the file, from 1.
    pub line: usize,
}

impl SphereBody {
    /// The direction of a point.
    #[must_use]
    pub fn point(&self, name: &str) -> Option<&Direction> {
        self.points.iter().find(|(own, _)| own == name).map(|(_, place)| place)
    }
}

/// A revolute joint of two bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereJoint {
    /// Its name in the file.
    pub name: String,
    /// The two bodies, by their numbers. Values of the joint are the turn of the second against the first.
    pub of: [usize; 2],
    /// Its axis in each of them: directions of equal length.
    pub at: [Direction; 2],
    /// A direction in each of them, not along the axis: the angle is that from the first to the second, seen along the axis.
    pub zero: [Direction; 2],
    /// Line of the file, from 1.
    pub line: usize,
}

impl SphereJoint {
    /// The part of a reference direction across the axis, times the square of the length of the axis.
    #[must_use]
    pub fn reference(&self, side: usize) -> Direction {
        across(&self.at[side], &self.zero[side])
    }
}

/// `(u.u) e - (u.e) u`
#[must_use]
pub fn across(axis: &Direction, e: &Direction) -> Direction {
    let (square, along) = (dot(axis, axis), dot(axis, e));
    std::array::from_fn(|k| Rational::from(&square * &e[k]) - Rational::from(&along * &axis[k]))
}

/// Whether two directions are parallel or opposite.
#[must_use]
pub fn is_parallel(a: &Direction, b: &Direction) -> bool {
    cross(a, b).iter().all(|c| *c == 0)
}

/// A linkage on the sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereLinkage {
    /// The body that stands still.
    pub ground: usize,
    /// The bodies.
    pub bodies: Vec<SphereBody>,
    /// The joints.
    pub joints: Vec<SphereJoint>,
}

/// A rotation that is known beforehand.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereGiven {
    /// The two bodies: the rotation is that of the second against the first.
    pub of: [usize; 2],
    /// The rotation.
    pub rotation: Matrix<Rational>,
    /// The joint whose angle is given; none for a body that is placed.
    pub joint: Option<usize>,
    /// Line of the file, from 1.
    pub line: usize,
}
