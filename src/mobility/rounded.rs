//! Loops whose numbers had to be rounded: whether they close, to rounding, through the whole range of a joint.

use super::answer::JointVariable;
use crate::algebra::number::Angle;
use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::entry::{Case, Entry, Input, InputValue};
use crate::error::Result;
use crate::kinematics::closed_loop::Variable;
use crate::mechanism::{FullMode, Mechanism};
use std::f64::consts::{PI, TAU};

/// Closure residuals up to this are rounding.
const CLOSED: f64 = 1e-13;
/// Inputs in a full turn, none of them special.
const INPUTS: u32 = 180;
/// At least so many neighbouring inputs make a range.
const FEWEST: usize = 12;

/// A range of a joint in which a loop closes to rounding.
pub(super) struct Closing {
    /// Place of the joint variable, and its value at the configurations below.
    pub held: (usize, f64),
    /// The modes at one input of the range.
    pub modes: Vec<FullMode>,
    /// Largest residual in the range.
    pub residual: f64,
    /// How many neighbouring inputs the range has, and how many were asked.
    pub inputs: (usize, usize),
}

/// The first revolute joint that turns through a range in which the loop closes to rounding at every input.
pub(super) fn closing(entry: &Entry, variables: &[JointVariable]) -> Result<Option<Closing>> {
    for (k, JointVariable { joint, variable }) in variables.iter().copied().enumerate() {
        if variable == Variable::Translation {
            continue;
        }
        let input = |radians: f64| Input { joint, value: InputValue::Angle(Angle::from_radians(radians)) };
        let one = Entry { cases: vec![Case::given(input(0.0), 0)], ..entry.clone() };
        // Joints without which the others are dependent cannot be held.
        let Ok(mechanism) = Mechanism::prepare(&one) else { continue };
        let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
        let mut samples: Vec<(f64, Vec<FullMode>)> = Vec::new();
        for step in 0..INPUTS {
            let radians = -PI + TAU * (f64::from(step) + 0.3) / f64::from(INPUTS);
            let solution =
                mechanism.solve(&Case::given(input(radians), 0), Roots::All, &mut workspace, &mut assembly)?;
            let modes = solution.modes.into_iter().filter(|mode| mode.real && mode.residual <= CLOSED).collect();
            samples.push((radians, modes));
        }
        let ranges = samples.split(|(_, modes)| modes.is_empty());
        let longest = ranges.max_by_key(|range| range.len()).unwrap_or_default();
        if longest.len() >= FEWEST {
            let (held, modes) = longest[longest.len() / 2].clone();
            // The best mode of each input: others may be of another, broken branch.
            let best =
                |(_, modes): &(f64, Vec<FullMode>)| modes.iter().map(|m| m.residual).fold(f64::INFINITY, f64::min);
            let residual = longest.iter().map(best).fold(0.0, f64::max);
            return Ok(Some(Closing { held: (k, held), modes, residual, inputs: (longest.len(), samples.len()) }));
        }
    }
    Ok(None)
}
