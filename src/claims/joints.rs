//! Joint variables, measured against the closure of their chain.

use crate::algebra::number::Number;
use crate::assembly::wrapped;
use crate::catalogue::entry::{Case, InputValue};
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Geometry};
use crate::kinematics::closed_loop::{Layout, Variable};
use crate::kinematics::motion::Motion;
use crate::mechanism::FullMode;

/// A chain and its joint variables in joint order.
pub(super) struct Joints<'a> {
    chain: &'a Chain,
    variables: Vec<Variable>,
}

impl<'a> Joints<'a> {
    /// Returns the joints of a chain.
    pub(super) fn of(chain: &'a Chain) -> Result<Self> {
        Ok(Self { chain, variables: Layout::of(chain, None)?.variables })
    }

    /// Returns the joint variables, with the given one inserted if the claim leaves it out.
    pub(super) fn complete(&self, case: &Case, q: &[f64]) -> Result<Vec<f64>> {
        let mut q = q.to_vec();
        if let (Some(input), true) = (case.input.first(), q.len() + 1 == self.variables.len()) {
            let (wanted, value) = match &input.value {
                InputValue::Angle(angle) => (Variable::Rotation, angle.radians()),
                InputValue::Distance(distance) => (Variable::Translation, distance.to_f64()),
            };
            if let Some(index) = Layout::variable_of(self.chain, input.joint, wanted) {
                q.insert(index, value);
            }
        }
        if q.len() == self.variables.len() {
            return Ok(q);
        }
        let (found, expected) = (q.len(), self.variables.len());
        Err(Error::Invalid(format!("found a solution of {found} values, expected {expected}, one per joint variable")))
    }

    /// Returns the closure error of these joints: the largest entry of the difference of two poses, lengths over the reach.
    pub(super) fn closure(&self, case: &Case, q: &[f64]) -> Result<f64> {
        let motions: Vec<Motion<f64>> = q.iter().zip(&self.variables).map(|(x, v)| joint_motion(*x, *v)).collect();
        let reached = self.chain.forward(&motions);
        let reached = reached.ok_or_else(|| Error::Invalid("the joints of the claim have no pose".to_owned()))?;
        let wanted = case.pose.as_ref().map_or_else(Motion::identity, |pose| pose.float.clone());
        let lengths: f64 =
            q.iter().zip(&self.variables).filter(|(_, v)| **v == Variable::Translation).map(|(x, _)| x.abs()).sum();
        let reach = reach(self.chain) + lengths;
        let mut defect = 0.0_f64;
        for i in 0..3 {
            for j in 0..3 {
                defect = defect.max((reached.rotation[i][j] - wanted.rotation[i][j]).abs());
            }
            let off = (reached.translation[i] - wanted.translation[i]).abs();
            defect = defect.max(if reach > 0.0 { off / reach } else { off });
        }
        Ok(defect)
    }

    /// Returns the largest difference of a joint variable, imaginary parts included; angles modulo 2 pi, lengths over the
    /// reach.
    pub(super) fn distance(&self, mode: &FullMode, q: &[f64]) -> f64 {
        let reach = reach(self.chain).max(f64::MIN_POSITIVE);
        let differences =
            mode.q.iter().zip(q).zip(&self.variables).map(|((found, claimed), variable)| match variable {
                Variable::Rotation => wrapped(found.re - claimed).abs().max(found.im.abs()),
                Variable::Translation => (found.re - claimed).abs().max(found.im.abs()) / reach,
            });
        differences.fold(0.0, f64::max)
    }
}

/// Returns the motion of one joint variable.
fn joint_motion(value: f64, variable: Variable) -> Motion<f64> {
    match variable {
        Variable::Rotation => Motion::rotation_z(value.cos(), value.sin()),
        Variable::Translation => Motion::translation_z(value),
    }
}

/// Returns the sum of all constant lengths of a chain.
fn reach(chain: &Chain) -> f64 {
    let length = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let ends = length(&chain.base.float.translation) + length(&chain.tool.float.translation);
    ends + match &chain.geometry {
        Geometry::Dh(joints) | Geometry::ModifiedDh(joints) => {
            joints.iter().map(|joint| joint.a.to_f64().abs() + joint.d.to_f64().abs()).sum::<f64>()
        }
        Geometry::Screws { joints, home } => {
            let points = joints.iter().map(|joint| length(&joint.point.each_ref().map(Number::to_f64)));
            length(&home.float.translation) + points.sum::<f64>()
        }
    }
}
