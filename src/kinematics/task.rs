//! The task of an arm: a whole pose or a part of it; and the joints that are held.

use super::chain::Placement;
use super::closed_loop::Variable;
use super::motion::{Motion, dot};
use super::placement::rotation_of;
use super::screws::{Behind, Held, VirtualJoint};
use super::tolerance::PoseError;
use rug::Rational;

/// The condition on the tool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Task {
    /// Position and orientation.
    #[default]
    Pose,
    /// The position and the direction of the tool's z axis.
    PositionAxis,
    /// The position and the angle between the tool's z axis and the base's z axis.
    PositionTilt,
    /// The position only.
    Position,
    /// The orientation only.
    Orientation,
}

/// The names of the tasks on the command line.
pub const TASKS: [(&str, Task); 5] = [
    ("pose", Task::Pose),
    ("position+axis", Task::PositionAxis),
    ("position+tilt", Task::PositionTilt),
    ("position", Task::Position),
    ("orientation", Task::Orientation),
];

impl Task {
    /// Returns the number of conditions.
    #[must_use]
    pub fn conditions(self) -> usize {
        6 - self.free()
    }

    /// Returns the number of freedoms left to the tool.
    #[must_use]
    pub fn free(self) -> usize {
        match self {
            Self::Pose => 0,
            Self::PositionAxis => 1,
            Self::PositionTilt => 2,
            Self::Position | Self::Orientation => 3,
        }
    }

    /// The virtual joints behind the tool for what is free, at a pose with this rotation.
    #[must_use]
    pub fn behind(self, turned_back: &dyn Fn() -> Behind) -> Vec<Behind> {
        let turn = |axis| Behind::Joint(VirtualJoint { variable: Variable::Rotation, axis });
        let slide = |axis| Behind::Joint(VirtualJoint { variable: Variable::Translation, axis });
        match self {
            Self::Pose => Vec::new(),
            Self::PositionAxis => vec![turn(2)],
            Self::PositionTilt => vec![turn(2), turned_back(), turn(2)],
            Self::Position => vec![Behind::Spherical],
            Self::Orientation => vec![slide(0), slide(1), slide(2)],
        }
    }

    /// The virtual joints behind the tool with one variable each: three rotations take the place of a spherical joint.
    #[must_use]
    pub fn behind_one_by_one(self, turned_back: &dyn Fn() -> Behind) -> Vec<Behind> {
        let turn = |axis| Behind::Joint(VirtualJoint { variable: Variable::Rotation, axis });
        match self {
            Self::Position => vec![Behind::Constant(Box::new(askew())), turn(0), turn(1), turn(2)],
            _ => self.behind(turned_back),
        }
    }

    /// Returns the values, in radians or metres, of the virtual joints of [`Self::behind_one_by_one`] that lead from a pose reached to the
    /// pose wanted; where the part that the task requests is missed, values that lead near it.
    #[must_use]
    pub fn virtual_values(self, reached: &Motion<f64>, wanted: &Motion<f64>) -> Vec<f64> {
        let between = reached.inverse().then_after(wanted);
        match self {
            Self::Pose => Vec::new(),
            Self::PositionAxis => vec![between.rotation[1][0].atan2(between.rotation[0][0])],
            Self::PositionTilt => {
                // R = Rz(-b) W Rz(-a): its last row is that of W turned by a, its last column that of W turned by -b.
                let row = |motion: &Motion<f64>| motion.rotation[2][1].atan2(motion.rotation[2][0]);
                let column = |motion: &Motion<f64>| motion.rotation[1][2].atan2(motion.rotation[0][2]);
                vec![row(reached) - row(wanted), column(wanted) - column(reached)]
            }
            Self::Position => {
                // Rx(a) Ry(b) Rz(c) behind the constant.
                let r = askew().float.inverse().then_after(&between).rotation;
                vec![(-r[1][2]).atan2(r[2][2]), r[0][2].clamp(-1.0, 1.0).asin(), (-r[0][1]).atan2(r[0][0])]
            }
            Self::Orientation => between.translation.to_vec(),
        }
    }

    /// Returns the error of a pose in the part that the task requests.
    #[must_use]
    pub fn miss(self, reached: &Motion<f64>, wanted: &Motion<f64>) -> PoseError {
        let whole = PoseError::between(reached, wanted);
        let axis = |motion: &Motion<f64>| -> [f64; 3] { std::array::from_fn(|i| motion.rotation[i][2]) };
        let (own, other) = (axis(reached), axis(wanted));
        match self {
            Self::Pose => whole,
            Self::PositionAxis => {
                let across = super::motion::cross(&own, &other);
                let orientation = dot(&across, &across).sqrt().atan2(dot(&own, &other));
                PoseError { orientation, ..whole }
            }
            Self::PositionTilt => {
                let tilt = |axis: [f64; 3]| axis[0].hypot(axis[1]).atan2(axis[2]);
                PoseError { orientation: (tilt(own) - tilt(other)).abs(), ..whole }
            }
            Self::Position => PoseError { orientation: 0.0, ..whole },
            Self::Orientation => PoseError { position: 0.0, ..whole },
        }
    }
}

/// A rotation about no axis that people build along. Three rotations behind it lose a freedom where the second one is a quarter turn: arms that
/// turn the tool about an axis of its own would pass there without it.
fn askew() -> Placement {
    let [w, x, y, z] = [4, 1, 2, 3].map(Rational::from);
    let translation = [0, 0, 0].map(Rational::from);
    Placement::from_motion_exact(Motion { rotation: rotation_of([&w, &x, &y, &z]), translation })
}

/// The task of an arm beside the pose.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Demand {
    /// The part of the pose that is requested.
    pub task: Task,
    /// The joint variables that are held, counted from 0, with their values.
    pub held: Vec<(usize, Held)>,
}
