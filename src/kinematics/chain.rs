//! Open chains and closed loops as a mechanism file gives them.

use super::data_field::ClosedForm;
use super::exact_motion::ExactMotion;
pub use super::joint::JointKind;
use super::joint::JointVariable;
use super::motion::Motion;
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::{Angle, Number};

/// A joint with the link that follows (DH) or precedes (modified DH) it.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Its kind.
    pub kind: JointKind,
    /// Link length a.
    pub a: Number,
    /// Link twist alpha.
    pub alpha: Angle,
    /// Offset along the joint axis: the constant d, for P and C the offset d0 of the variable.
    pub d: Number,
    /// Angle about the joint axis: for R and C the offset theta0 of the variable, for P the constant.
    pub theta0: Angle,
    /// H only: translation per radian.
    pub pitch: Option<Number>,
}

/// A joint given by its axis in the home position (product of exponentials).
#[derive(Clone, Debug, PartialEq)]
pub struct ScrewJoint {
    /// Its kind.
    pub kind: JointKind,
    /// Direction of the axis, of any nonzero length.
    pub axis: [Number; 3],
    /// A point of the axis.
    pub point: [Number; 3],
    /// H only: translation per radian.
    pub pitch: Option<Number>,
}

/// A given motion, enclosed.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// Its entries.
    pub motion: Motion<Enclosure>,
    /// Whether its rotation is orthogonal; otherwise the nearest rotation is meant.
    pub is_rotation: bool,
}

/// A constant rigid motion of a file (base, tool, home, pose): exactly rigid over the rationals, and in f64.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// The exact motion: the given one where that is exactly rigid, else the nearest one found with rational entries.
    pub exact: ExactMotion,
    /// The given motion, where the exact motion only represents it.
    pub given: Option<Box<Given>>,
    /// The given closed form, where it is known and not rational.
    pub closed: Option<ClosedForm>,
    /// The motion in twice the digits of f64, where it was made without exact numbers.
    pub precise: Option<Box<Motion<DoubleDouble>>>,
    /// The correctly rounded image of the motion, its rotation orthogonal to rounding.
    pub float: Motion<f64>,
    /// The rows of the given matrix, where the exact motion only represents it.
    pub rows: Option<Box<[[Number; 4]; 3]>>,
    /// Distance of the given rotation from a rotation: the largest entry of |R - nearest rotation|.
    pub defect: f64,
}

/// The description of the links.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// `prod Rz(q + theta0) Tz(d) Tx(a) Rx(alpha)`
    Dh(Vec<Joint>),
    /// `prod Rx(alpha) Tx(a) Rz(q + theta0) Tz(d)` (Craig)
    ModifiedDh(Vec<Joint>),
    /// Screw axes in the home position of the flange.
    Screws {
        /// The joints from base to flange.
        joints: Vec<ScrewJoint>,
        /// Pose of the flange with all joint variables zero.
        home: Box<Placement>,
    },
}

/// A serial chain: its geometry between a base and a tool.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// Joints and links.
    pub geometry: Geometry,
    /// From the world to the first joint.
    pub base: Placement,
    /// From the last link to the tool.
    pub tool: Placement,
}

impl Chain {
    /// The kinds of the joints from base to tool.
    #[must_use]
    pub fn joint_kinds(&self) -> Vec<JointKind> {
        match &self.geometry {
            Geometry::Dh(joints) | Geometry::ModifiedDh(joints) => joints.iter().map(|j| j.kind).collect(),
            Geometry::Screws { joints, .. } => joints.iter().map(|j| j.kind).collect(),
        }
    }

    /// The variables of the joints, in joint order.
    #[must_use]
    pub fn variables(&self) -> Vec<JointVariable> {
        JointVariable::of(&self.joint_kinds())
    }

    /// Returns the number of variables of all joints.
    #[must_use]
    pub fn freedoms(&self) -> usize {
        self.joint_kinds().into_iter().map(JointKind::freedoms).sum()
    }
}
