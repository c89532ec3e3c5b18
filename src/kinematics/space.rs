//! Linkages in space: a graph of bodies with points and of joints between them.

use super::motion::{Motion, Vector};
use super::sphere::SphereJoint;
use rug::Rational;

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceBody {
    /// Its name in the file.
    pub name: String,
    /// Its points in coordinates of its own, metres, in the order of the file.
    pub points: Vec<(String, Vector<Rational>)>,
    /// Line of the file, from 1.
    pub line: usize,
}

impl SpaceBody {
    /// The place of a point.
    #[must_use]
    pub fn point(&self, name: &str) -> Option<&Vector<Rational>> {
        self.points.iter().find(|(own, _)| own == name).map(|(_, place)| place)
    }
}

/// The axis of a joint in both bodies, with the rotation of the second body at value 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The axis as one of a joint on the sphere: directions of equal length, and references from which angles are measured.
    pub sphere: SphereJoint,
    /// The rotation of the second body against the first at value 0.
    pub home: Motion<Rational>,
}

/// The relative motion that a joint allows its two bodies.
#[derive(Clone, Debug, PartialEq)]
pub enum SpacePair {
    /// R: the bodies turn about a common axis.
    Revolute(Axis),
    /// P: the second body moves along an axis without turning.
    Prismatic(Axis),
    /// S: a common point.
    Spherical,
    /// U: a common point, and an axis in each body that are at right angles.
    Universal([Vector<Rational>; 2]),
    /// SS: a rod between two points; the square of its length.
    Rod(Rational),
    /// SPS: a leg between two points whose length is the value.
    Leg,
    /// UPU: a leg between two points with a universal joint at each end, whose length is the value; the axis fixed in each body. Its two
    /// middle axes are parallel.
    UniversalLeg([Vector<Rational>; 2]),
    /// Parallelogram: R, a circular translation, R; the direction of both axes in each body and the square of the length of the rods.
    Parallelogram([Vector<Rational>; 2], Rational),
}

impl SpacePair {
    /// The word of the file.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Revolute(_) => "R",
            Self::Prismatic(_) => "P",
            Self::Spherical => "S",
            Self::Universal(_) => "U",
            Self::Rod(_) => "SS",
            Self::Leg => "SPS",
            Self::UniversalLeg(_) => "UPU",
            Self::Parallelogram(..) => "parallelogram",
        }
    }

    /// The number of freedoms that it takes away; of rods and legs the spin is not counted.
    #[must_use]
    pub fn conditions(&self) -> usize {
        match self {
            Self::Revolute(_) | Self::Prismatic(_) => 5,
            Self::Universal(_) => 4,
            Self::Spherical | Self::Parallelogram(..) => 3,
            Self::Rod(_) | Self::UniversalLeg(_) => 1,
            Self::Leg => 0,
        }
    }
}

/// A joint between two bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceJoint {
    /// Its name in the file.
    pub name: String,
    /// The relative motion that it allows.
    pub pair: SpacePair,
    /// The two bodies, by their numbers. Values of the joint are the motion of the second against the first.
    pub of: [usize; 2],
    /// The point of the joint in each of them.
    pub at: [Vector<Rational>; 2],
    /// Line of the file, from 1.
    pub line: usize,
}

impl SpaceJoint {
    /// Whether its value is a distance; `None` where it has no value.
    #[must_use]
    pub fn is_distance(&self) -> Option<bool> {
        match self.pair {
            SpacePair::Revolute(_) => Some(false),
            SpacePair::Prismatic(_) | SpacePair::Leg | SpacePair::UniversalLeg(_) => Some(true),
            _ => None,
        }
    }
}

/// A linkage in space.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceLinkage {
    /// The body that stands still.
    pub ground: usize,
    /// The bodies.
    pub bodies: Vec<SpaceBody>,
    /// The joints.
    pub joints: Vec<SpaceJoint>,
}

/// What is known beforehand.
#[derive(Clone, Debug, PartialEq)]
pub enum Known {
    /// The motion of the second body against the first.
    Motion(Box<Motion<Rational>>),
    /// The square of the length of a leg.
    Square(Rational),
}

/// A value of a linkage that is given as input.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceGiven {
    /// The two bodies.
    pub of: [usize; 2],
    /// What is known of them.
    pub known: Known,
    /// The joint whose value is given; none for a body that is placed.
    pub joint: Option<usize>,
    /// The value, radians or metres; none for a body that is placed.
    pub value: Option<f64>,
    /// Line of the file, from 1.
    pub line: usize,
}
