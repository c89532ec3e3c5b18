//! Loops whose numbers are rounded: whether they close, to rounding, through the whole range of a joint.

use super::answer::JointVariable;
use crate::algebra::number::{Angle, HalfTangent, Number};
use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::entry::{Case, Entry, Input, InputValue};
use crate::error::Result;
use crate::exact::linkage::is_square;
use crate::kinematics::chain::{Chain, Geometry, ScrewJoint};
use crate::kinematics::closed_loop::Variable;
use crate::mechanism::{FullMode, Mechanism};
use rug::{Integer, Rational};
use std::f64::consts::{PI, TAU};

/// Closure residuals up to this are rounding.
const CLOSED: f64 = 1e-13;
/// Residuals above this at an end of a range are on their way to more.
const CEASING: f64 = CLOSED / 4.0;
/// Inputs in a full turn, none of them special.
const INPUTS: u32 = 180;
/// Least number of neighbouring inputs that make a range.
const FEWEST: usize = 12;
/// Number of digits behind the point from which decimals may be rounded numbers.
const LONG: u32 = 14;
/// No decimal of more digits is looked at.
const MOST_DIGITS: u32 = 64;

/// A range of a joint in which a loop closes to rounding.
pub(super) struct Closing {
    /// Place of the joint variable, and its value at the configurations below.
    pub held: (usize, f64),
    /// The modes at one input of the range.
    pub modes: Vec<FullMode>,
    /// Largest residual in the range.
    pub residual: f64,
    /// The number of neighbouring inputs in the range, and the number of inputs tried.
    pub inputs: (usize, usize),
}

/// The first revolute joint that turns through a range in which the loop closes to rounding at every input.
pub(super) fn closing(entry: &Entry, variables: &[JointVariable]) -> Result<Option<Closing>> {
    for (k, JointVariable { joint, variable }) in variables.iter().copied().enumerate() {
        if variable == Variable::Translation {
            continue;
        }
        let input = |radians: f64| Input { joint, value: InputValue::Angle(Angle::from_radians(radians)) };
        // Long decimals, too, are rounded numbers here.
        let one = Entry { cases: vec![Case::given(input(0.0), 0)], rounded: true, ..entry.clone() };
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
        // The circle has no ends: where it does not close all round, it is cut where it does not close.
        let open = samples.iter().position(|(_, modes)| modes.is_empty()).unwrap_or_default();
        samples.rotate_left(open);
        let ranges = samples.split(|(_, modes)| modes.is_empty());
        let longest = ranges.max_by_key(|range| range.len()).unwrap_or_default();
        // The best mode of each input: others may be of another, broken branch.
        let best = |(_, modes): &(f64, Vec<FullMode>)| modes.iter().map(|m| m.residual).fold(f64::INFINITY, f64::min);
        // A range ends in limit positions; a loop that only nearly closes ceases to close.
        let ceases = longest.len() < samples.len()
            && [longest.first(), longest.last()].into_iter().flatten().any(|end| best(end) > CEASING);
        if longest.len() >= FEWEST && !ceases {
            let (held, modes) = longest[longest.len() / 2].clone();
            let residual = longest.iter().map(best).fold(0.0, f64::max);
            return Ok(Some(Closing { held: (k, held), modes, residual, inputs: (longest.len(), samples.len()) }));
        }
    }
    Ok(None)
}

/// Whether the loop of exact arithmetic is that of the file.
pub(super) fn is_exact(chain: &Chain) -> bool {
    match &chain.geometry {
        Geometry::Dh(joints) | Geometry::ModifiedDh(joints) => joints.iter().all(|joint| {
            [&joint.a, &joint.d].iter().all(|x| x.is_exact())
                && [&joint.alpha, &joint.theta0].iter().all(|x| x.is_exact())
        }),
        Geometry::Screws { joints, home } => {
            let has_frame = |joint: &ScrewJoint| {
                is_square(&joint.axis.iter().map(|x| Rational::from(x.rational().square_ref())).sum())
            };
            let needs_none = |joint: &ScrewJoint| joint.kind.is_plain();
            home.defect == 0.0
                && joints.iter().flat_map(|joint| joint.axis.iter().chain(&joint.point)).all(Number::is_exact)
                && (joints.iter().all(has_frame) || joints.iter().all(needs_none))
        }
    }
}

/// Whether the file gives decimals so long that they may be rounded numbers.
pub(super) fn has_long_decimals(chain: &Chain) -> bool {
    let is_long = |q: &Rational| {
        let (mut rest, mut digits) = (q.denom().clone(), 0);
        while digits < MOST_DIGITS && rest.is_divisible_u(2) | rest.is_divisible_u(5) {
            rest /= rest.clone().gcd(&Integer::from(10));
            digits += 1;
        }
        rest == 1 && digits >= LONG
    };
    let angle = |angle: &Angle| matches!(angle.half_tangent(), HalfTangent::Finite(t) if is_long(t));
    let number = |number: &Number| is_long(number.rational());
    match &chain.geometry {
        Geometry::Dh(joints) | Geometry::ModifiedDh(joints) => joints
            .iter()
            .any(|joint| number(&joint.a) || number(&joint.d) || angle(&joint.alpha) || angle(&joint.theta0)),
        Geometry::Screws { joints, .. } => joints.iter().any(|joint| joint.axis.iter().chain(&joint.point).any(number)),
    }
}
