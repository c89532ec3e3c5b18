//! Forward kinematics and the Jacobian of a chain in f64, prepared once.

use super::chain::Chain;
use super::closed_loop::Variable;
use super::motion::{Motion, Vector, cross};

/// A chain between two frames, in f64.
#[derive(Clone, Debug)]
pub struct Forward {
    variables: Vec<Variable>,
    /// The constant before each variable, and the last one behind them all.
    constants: Vec<Motion<f64>>,
}

/// A velocity: of the origin of the tool, and angular, both in the frame of the base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist {
    /// The velocity of the origin of the tool.
    pub linear: Vector<f64>,
    /// The angular velocity.
    pub angular: Vector<f64>,
}

impl Forward {
    /// Returns the chain in f64; `None` where a constant is not known to that precision.
    #[must_use]
    pub fn of(chain: &Chain) -> Option<Self> {
        let (variables, constants) = chain.unknowns_and_constants::<f64>()?;
        Some(Self { variables, constants })
    }

    /// Returns the kinds of the joint variables.
    #[must_use]
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// Returns the sum of the lengths of all constants: no point of the arm is farther from the base while its sliding joints are
    /// at zero.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.constants.iter().map(|constant| length(&constant.translation)).sum()
    }

    /// Returns the distance that the links have to bridge to a pose and their length together, in metres, if the former is larger by more
    /// than rounding and `slack`: no configuration reaches the pose then. `None` for chains with sliding joints.
    #[must_use]
    pub fn too_far(&self, wanted: &Motion<f64>, slack: f64) -> Option<(f64, f64)> {
        let [base, links @ .., tool] = self.constants.as_slice() else { return None };
        if self.variables.contains(&Variable::Translation) {
            return None;
        }
        let ends = [base, wanted, tool].map(|motion| length(&motion.translation)).iter().sum::<f64>();
        let links: f64 = links.iter().map(|link| length(&link.translation)).sum();
        let gap = length(&base.inverse().then_after(wanted).then_after(&tool.inverse()).translation);
        // A few dozen roundings, each by less than two units of the last place, and matrices that are rotations to as much.
        let rounding = 1e-13 * (ends + links);
        (gap > links + rounding + slack).then_some((gap, links))
    }

    /// The pose of the tool at these joint values.
    #[must_use]
    pub fn pose(&self, q: &[f64]) -> Motion<f64> {
        self.frames(q).pop().unwrap_or_else(Motion::identity)
    }

    /// The pose of the tool, and its velocity per unit rate of every joint variable.
    #[must_use]
    pub fn jacobian(&self, q: &[f64]) -> (Motion<f64>, Vec<Twist>) {
        let mut frames = self.frames(q);
        let tool = frames.pop().unwrap_or_else(Motion::identity);
        let twist = |(frame, variable): (&Motion<f64>, &Variable)| {
            let axis: Vector<f64> = std::array::from_fn(|i| frame.rotation[i][2]);
            let arm: Vector<f64> = std::array::from_fn(|i| tool.translation[i] - frame.translation[i]);
            match variable {
                Variable::Rotation => Twist { linear: cross(&axis, &arm), angular: axis },
                Variable::Translation => Twist { linear: axis, angular: [0.0; 3] },
            }
        };
        let twists = frames.iter().zip(&self.variables).map(twist).collect();
        (tool, twists)
    }

    /// The frame in which each joint moves, and that of the tool.
    fn frames(&self, q: &[f64]) -> Vec<Motion<f64>> {
        let mut constants = self.constants.iter();
        let mut at = constants.next().cloned().unwrap_or_else(Motion::identity);
        let mut frames = Vec::with_capacity(self.constants.len());
        for ((variable, value), constant) in self.variables.iter().zip(q).zip(constants) {
            frames.push(at.clone());
            let motion = match variable {
                Variable::Rotation => Motion::rotation_z(value.cos(), value.sin()),
                Variable::Translation => Motion::translation_z(*value),
            };
            at = at.then_after(&motion).then_after(constant);
        }
        frames.push(at);
        frames
    }
}

fn length(v: &Vector<f64>) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}
