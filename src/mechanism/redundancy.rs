//! The curves that a loop of seven joint variables runs through while none of them is given: of an arm of seven joints at a
//! pose, its redundancy.
//!
//! Every joint in turn is held at values all round, and every configuration that closes the loop then is the start of a
//! curve, if it lies on none that is known. A component is met where one joint runs through one of these values on it.

use super::family::{Family, Joints, Shape};
use super::input_curve::InputCurve;
use super::{FullMode, Mechanism};
use crate::algebra::number::{Angle, HalfTangent, Number};
use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::entry::{Case, Entry, Input, InputValue};
use crate::error::{Error, Result};
use crate::kinematics::closed_loop::Variable;
use crate::solve::walk::Trace;
use crate::verdict::{Code, Status};
use rug::Rational;
use std::f64::consts::{PI, TAU};

/// The curves of a loop as far as they were met.
#[derive(Clone, Debug, Default)]
pub struct Redundancy {
    /// One family for every curve, or for every part of it within the joint limits.
    pub families: Vec<Family>,
    /// The number of curves.
    pub curves: usize,
    /// The number of curves that were followed until they closed.
    pub closed: usize,
    /// At how many values joints were held.
    pub asked: usize,
    /// At how many of these the list of configurations is not complete.
    pub incomplete: usize,
}

/// Variables that change by less along a curve stand still.
const MOVED: f64 = 1e-6;

/// Half-angle tangents of held joints are multiples of one over this.
const SHORT: f64 = 1024.0;

/// The curves followed by one held joint.
struct Curves {
    curve: InputCurve,
    traces: Vec<Trace>,
}

/// The curves of a loop of seven joint variables, each joint held at `values` values in turn. Solutions of other dimensions
/// are not looked for.
///
/// # Errors
/// [`Error::Invalid`] for entries that are no loops of seven joint variables; [`Error::Unsupported`] where no joint can be
/// held.
pub fn redundancy(entry: &Entry, values: usize) -> Result<Redundancy> {
    let chain = entry.chain().ok_or_else(|| Error::Invalid("found a platform, expected a loop".to_owned()))?;
    let variables = chain.variables();
    if variables.len() != 7 {
        let found = variables.len();
        return Err(Error::Invalid(format!("found a loop of {found} joint variables, expected 7")));
    }
    let shell = Entry { limits: Vec::new(), ..entry.clone() };
    let mut found = Redundancy::default();
    let mut all: Vec<Curves> = Vec::new();
    let mut refused = None;
    for (index, own) in variables.iter().enumerate() {
        let cases = held(own.joint, own.variable, entry.limits.get(index), values);
        match follow(&Entry { cases, ..shell.clone() }, &mut all, &mut found) {
            Ok(()) => {}
            Err(error) if error.unsupported().is_some() => refused = Some(error),
            Err(error) => return Err(error),
        }
    }
    if let (Some(error), 0) = (refused, found.asked) {
        return Err(error);
    }
    for Curves { curve, traces } in &all {
        for trace in traces {
            found.curves += 1;
            found.closed += usize::from(trace.is_closed);
            found.families.extend(families(entry, curve, trace));
        }
    }
    Ok(found)
}

/// The cases that hold a joint at values all round, or between its limits; a slide without limits is not held.
fn held(joint: usize, variable: Variable, limits: Option<&[f64; 2]>, values: usize) -> Vec<Case> {
    let range = match (variable, limits) {
        (Variable::Translation, None) => return Vec::new(),
        (Variable::Rotation, Some([low, high])) if high - low < TAU => [*low, *high],
        (Variable::Rotation, _) => [-PI, PI],
        (Variable::Translation, Some(limits)) => *limits,
    };
    let case = |k: usize| {
        // Off the middle, and off the parts of a turn that special positions like.
        let value = range[0] + (range[1] - range[0]) * (k as f64 + 0.437) / values as f64;
        let value = match variable {
            // Short numbers: any value will do.
            Variable::Rotation => {
                let tangent = Rational::from_f64(((value / 2.0).tan() * SHORT).round() / SHORT)?;
                InputValue::Angle(Angle::from_half_tangent(HalfTangent::Finite(tangent)))
            }
            Variable::Translation => InputValue::Distance(Number::exact(Rational::from_f64(value)?)),
        };
        Some(Case::given(Input { joint, value }, 0))
    };
    (0..values).filter_map(case).collect()
}

/// Follows the curves through the configurations of all cases of a loop that are on no known curve.
fn follow(entry: &Entry, all: &mut Vec<Curves>, found: &mut Redundancy) -> Result<()> {
    let Some(first) = entry.cases.first() else { return Ok(()) };
    let mechanism = Mechanism::prepare(entry)?;
    let mut own = Curves { curve: InputCurve::of(entry, first)?, traces: Vec::new() };
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    for case in &entry.cases {
        let solution = mechanism.solve(case, Roots::All, &mut workspace, &mut assembly)?;
        if solution.verdict.code == Code::StructurallyDeficient || solution.verdict.status == Status::SelfMotion {
            // With this joint held the others are dependent, or the joint does not move along a curve.
            break;
        }
        found.asked += 1;
        let is_done = matches!(solution.verdict.status, Status::Complete | Status::Unreachable);
        found.incomplete += usize::from(!is_done);
        for mode in solution.modes.iter().filter(|mode| mode.real && mode.multiplicity == 1) {
            let q: Vec<f64> = mode.q.iter().map(|z| z.re).collect();
            if !(all.iter().any(|other| other.holds(&q)) || own.holds(&q)) {
                own.trace(mode, &q);
            }
        }
    }
    all.push(own);
    Ok(())
}

impl Curves {
    fn turns(&self) -> [bool; 7] {
        self.curve.kinds().map(|variable| variable == Variable::Rotation)
    }

    fn holds(&self, q: &[f64]) -> bool {
        let (point, turns) = (self.curve.point(q), self.turns());
        self.traces.iter().any(|trace| trace.holds(&self.curve, &point, &turns))
    }

    fn trace(&mut self, mode: &FullMode, q: &[f64]) {
        let point = self.curve.point(q);
        let trace = Trace::through(&self.curve, &point, &self.turns());
        // A singular configuration is no start; another one of its curve is, as a rule.
        self.traces.extend(trace.filter(|trace| mode.certified && trace.points.len() > 2));
    }
}

/// A curve as families.
fn families(entry: &Entry, curve: &InputCurve, trace: &Trace) -> Vec<Family> {
    let points: Vec<Vec<f64>> = trace.points.iter().map(|point| curve.joints(point)).collect();
    let moves = |k: &usize| points.iter().any(|q| (q[*k] - points[0][*k]).abs() > MOVED);
    let moving = (0..curve.variables().len()).filter(moves).collect();
    let shape = Shape { dimension: 1, moving, distance: 0.0, is_closed: trace.is_closed, points };
    let between = |first: usize, part: f64| Some(curve.joints(&trace.between(curve, first, part)?));
    Joints { variables: curve.variables(), limits: &entry.limits }.families(&shape, &between)
}
