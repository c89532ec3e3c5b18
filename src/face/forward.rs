//! Forward kinematics in f64: the pose of the tool, and its velocity per joint rate.

use super::pose::{Matrix, matrix};
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::{Motion, cross};

/// A chain in f64.
#[derive(Clone, Debug)]
pub(super) struct Forward {
    variables: Vec<Variable>,
    /// Constant k stands before variable k, the last one behind them all.
    constants: Vec<Motion<f64>>,
}

impl Forward {
    pub(super) fn of(chain: &Chain) -> Result<Self> {
        let found = chain.unknowns_and_constants::<f64>();
        let (variables, constants) =
            found.ok_or_else(|| Error::Invalid("found a chain without numbers, expected one".to_owned()))?;
        Ok(Self { variables, constants })
    }

    pub(super) fn freedoms(&self) -> usize {
        self.variables.len()
    }

    fn check(&self, q: &[f64]) -> Result<()> {
        if q.len() != self.variables.len() {
            let (found, expected) = (q.len(), self.variables.len());
            return Err(Error::Invalid(format!("found {found} joint values, expected {expected}")));
        }
        match q.iter().position(|x| !x.is_finite()) {
            Some(at) => Err(Error::Invalid(format!("found {} at [{at}], expected finite joint values", q[at]))),
            None => Ok(()),
        }
    }

    /// The frames before every variable, and the pose of the tool.
    fn frames(&self, q: &[f64]) -> (Vec<Motion<f64>>, Motion<f64>) {
        let mut frame = self.constants[0].clone();
        let mut frames = Vec::with_capacity(q.len());
        for ((value, variable), constant) in q.iter().zip(&self.variables).zip(&self.constants[1..]) {
            frames.push(frame.clone());
            let moved = match variable {
                Variable::Rotation => Motion::rotation_z(value.cos(), value.sin()),
                Variable::Translation => Motion::translation_z(*value),
            };
            frame = frame.then_after(&moved).then_after(constant);
        }
        (frames, frame)
    }

    pub(super) fn pose(&self, q: &[f64]) -> Result<Matrix> {
        self.check(q)?;
        Ok(matrix(&self.frames(q).1))
    }

    /// Six rows: the velocity of the origin of the tool, then its angular velocity, in the frame of the base.
    pub(super) fn jacobian(&self, q: &[f64]) -> Result<[Vec<f64>; 6]> {
        self.check(q)?;
        let (frames, tool) = self.frames(q);
        let mut rows: [Vec<f64>; 6] = std::array::from_fn(|_| Vec::with_capacity(q.len()));
        for (frame, variable) in frames.iter().zip(&self.variables) {
            let axis: [f64; 3] = std::array::from_fn(|k| frame.rotation[k][2]);
            let arm: [f64; 3] = std::array::from_fn(|k| tool.translation[k] - frame.translation[k]);
            let (linear, angular) = match variable {
                Variable::Rotation => (cross(&axis, &arm), axis),
                Variable::Translation => (axis, [0.0; 3]),
            };
            for k in 0..3 {
                rows[k].push(linear[k]);
                rows[k + 3].push(angular[k]);
            }
        }
        Ok(rows)
    }
}
