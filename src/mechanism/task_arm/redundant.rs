//! Arms of more free joints than conditions: some joints are held, and what is found is a point of a family.

use super::trace::Tracer;
use super::{ArmAnswer, Found, Inner, TaskArm, Tools};
use crate::algebra::number::{Angle, HalfTangent, Number};
use crate::algebra::sort;
use crate::assembly::{Assembly, Roots};
use crate::catalogue::entry::Case;
use crate::error::{Error, Result};
use crate::kinematics::chain::Placement;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::forward::Forward;
use crate::kinematics::screws::Held;
use crate::mechanism::{Family, FullMode, Joints, Solution};
use crate::verdict::{Code, Proof, Status};
use looproot_calculus::finite::finite;
use nalgebra::DMatrix;
use rug::Rational;
use std::f64::consts::PI;
use std::sync::OnceLock;

/// Places within the limits at which a joint is held in turn.
const PLACES: [f64; 7] = [0.5, 0.25, 0.75, 0.375, 0.625, 0.125, 0.875];
/// Half-angle tangents are rounded to multiples of one over this: short numbers make exact work short.
const PARTS: f64 = 16.0;
/// Number of choices of held joints that are tried where several joints are held.
const CHOICES: usize = 2;
/// A joint moves along a family where its part of the motion is larger.
const MOVES: f64 = 1e-7;
/// Solutions that miss what is asked for by less, in metres or radians, meet it but for rounding.
const EXACT: f64 = 1e-12;

/// A short number within the limits of a joint: at this part of the way between them.
fn place(forward: &Forward, limits: &[[f64; 2]], joint: usize, part: f64) -> Held {
    let is_angle = forward.variables()[joint] == Variable::Rotation;
    let whole = if is_angle { PI } else { forward.reach() };
    let [low, high] = limits.get(joint).copied().unwrap_or([-whole, whole]);
    let (low, high) = (low.max(-whole), high.min(whole));
    let value = low + part * (high - low);
    let rounded = |x: f64| Rational::from_f64((x * PARTS).round() / PARTS).unwrap_or_default();
    if is_angle {
        Held::Angle(Angle::from_half_tangent(HalfTangent::Finite(rounded((value / 2.0).tan()))))
    } else {
        Held::Distance(Number::exact(rounded(value)))
    }
}

/// A short number in the middle of the limits.
pub(super) fn middle(forward: &Forward, limits: &[[f64; 2]], joint: usize) -> Held {
    place(forward, limits, joint, 0.5)
}

/// Turns every solution into the circle that a free joint makes of it, and every family into one of a dimension more.
pub(super) fn free(solution: &mut Solution, joint: usize) {
    turn_families(solution, joint);
    let known = solution.families.len();
    let real: Vec<_> = std::mem::take(&mut solution.modes).into_iter().filter(|mode| mode.real).collect();
    for mode in real {
        let sample: Vec<f64> = mode.q.iter().map(|value| value.re).collect();
        // A solution of the conditions may miss the rest of the pose by less than the tolerance.
        let distance = mode.error.map_or(0.0, |miss| miss.largest());
        let distance = if distance < EXACT { 0.0 } else { distance };
        solution.families.push(Family {
            dimension: 1,
            moving: vec![joint],
            distance,
            samples: vec![sample.clone()],
            sample,
        });
    }
    if solution.families.is_empty() {
        return;
    }
    let verdict = &mut solution.verdict;
    let number = solution.families.len() - known;
    let is_exact = solution.families.iter().any(|family| family.distance == 0.0);
    let besides = if known > 0 { format!(", along {known} more it turns freely besides") } else { String::new() };
    verdict.reason = format!("{number} families, each a full turn of joint {}{besides}; {}", joint + 1, verdict.reason);
    if verdict.status == Status::Complete && is_exact {
        (verdict.status, verdict.code) = (Status::SelfMotion, Code::SelfMotion);
    }
    // A motion that the loop without this joint has already is one dimension more.
    verdict.self_motion += usize::from(is_exact);
    (verdict.complex, verdict.real, verdict.certified) = (0, 0, 0);
}

/// Adds the turns of a free joint to the families of a redundant arm.
pub(super) fn free_besides(solution: &mut Solution, joint: usize) {
    if solution.families.is_empty() {
        return;
    }
    turn_families(solution, joint);
    let verdict = &mut solution.verdict;
    verdict.self_motion += 1;
    verdict.reason = format!("joint {} turns freely along every family; with it held, {}", joint + 1, verdict.reason);
}

/// Makes every family one of a dimension more, along which a joint that was held turns.
fn turn_families(solution: &mut Solution, joint: usize) {
    for family in &mut solution.families {
        family.dimension += 1;
        family.moving.push(joint);
        family.moving.sort_unstable();
    }
}

impl TaskArm {
    /// Returns the ways to hold `more` further joints, those that leave the loop most regular first.
    pub(super) fn with_more_held(&self, more: usize) -> Vec<Inner> {
        let free: Vec<usize> = self.kept(&Inner { held: self.held.clone(), ..Inner::default() });
        let choices = self.trial().held(more, &self.behind(&Placement::identity()));
        let inner = |chosen: &Vec<usize>, part: f64| {
            let mut held = self.held.clone();
            held.extend(chosen.iter().map(|k| (free[*k], place(&self.forward, &self.limits, free[*k], part))));
            Inner { held, filled: Vec::new(), solver: OnceLock::new() }
        };
        let of_choice = |chosen: &Vec<usize>| PLACES.map(|part| inner(chosen, part));
        // A curve along which a joint stands still is met where another one is held: each is held in turn.
        let tried = if more == 1 { choices.len() } else { CHOICES };
        choices.iter().take(tried).flat_map(of_choice).collect()
    }

    /// The families of configurations that reach the pose, or one of them.
    pub(super) fn redundant(
        &self,
        more: usize,
        ways: &[Inner],
        case: &Case,
        pose: &Placement,
        with: &mut Tools<'_>,
    ) -> Result<Solution> {
        // A curve is what counts here: that its points are all solutions with a joint held need not be proved. Complex ones lead to curves
        // that no held value meets, and to near configurations where rounding put the pose out of reach.
        let (lists, roots) = (std::mem::replace(&mut with.workspace.only_lists, true), with.roots);
        with.roots = Roots::All;
        let answer = self.met(more, ways, case, pose, with);
        (with.workspace.only_lists, with.roots) = (lists, roots);
        answer
    }

    /// The families that are met where joints are held in these ways.
    fn met(
        &self,
        more: usize,
        ways: &[Inner],
        case: &Case,
        pose: &Placement,
        with: &mut Tools<'_>,
    ) -> Result<Solution> {
        let tolerance = with.tolerance.unwrap_or_default();
        let mut tracer = if more == 1 { Tracer::of(self, pose, tolerance) } else { None };
        let (mut last, mut any): (Option<Solution>, Option<Vec<f64>>) = (None, None);
        for inner in ways {
            let (solution, found) = match self.by(inner, case, pose, with) {
                Ok(answer) => answer,
                // With some joints held the others may be dependent: another choice is then held.
                Err(error) if error.unsupported().is_some() => continue,
                Err(error) => return Err(error),
            };
            for (q, is_near, is_inside) in starts(&solution, &found) {
                match &mut tracer {
                    Some(tracer) => tracer.follow(&q, is_near),
                    None if is_inside => return Ok(self.one_family(solution, q, pose, more)),
                    None => {}
                }
                any = any.or(Some(q));
            }
            if let Some(tracer) = &mut tracer {
                for q in middles(&found) {
                    tracer.follow_beside(&q);
                    tracer.look_for_locked(&q);
                }
            }
            last = Some(solution);
        }
        let (mut families, locked) =
            tracer.map_or_else(Default::default, |tracer| (tracer.families(), tracer.locked()));
        // Those that the arm can run along stand first.
        let joints = Joints { variables: self.forward.variables(), limits: &self.limits };
        sort::by_key(&mut families, |family| !joints.is_inside(&family.sample));
        match (last, any) {
            (Some(solution), Some(q)) if families.is_empty() && locked.is_empty() => {
                Ok(self.one_family(solution, q, pose, more))
            }
            (Some(solution), _) if families.is_empty() => Ok(nothing_found(solution, more, locked)),
            (Some(solution), _) => Ok(traced(solution, families, locked)),
            (None, _) => {
                Err(Error::UnsupportedMobility("the joint axes are dependent in every configuration".to_owned()))
            }
        }
    }

    /// The answer with one sample of the family.
    fn one_family(&self, mut solution: Solution, sample: Vec<f64>, pose: &Placement, more: usize) -> Solution {
        let moving = self.moving(&sample, pose);
        moves(&mut solution, more);
        solution.verdict.reason = format!(
            "the arm has {more} more freedom{} than the task has conditions; one configuration is listed, and --lock NAME=VALUE \
             lists all at a value of a joint",
            if more == 1 { "" } else { "s" }
        );
        let family = Family { dimension: more, moving, distance: 0.0, samples: vec![sample.clone()], sample };
        solution.families = vec![family];
        solution
    }

    /// The joints that move along the family through a configuration.
    fn moving(&self, q: &[f64], pose: &Placement) -> Vec<usize> {
        let (tool, twists) = self.forward.jacobian(q);
        let reach = self.forward.reach().max(f64::MIN_POSITIVE);
        let is_held = |k: &usize| self.held.iter().any(|(own, _)| own == k);
        let mut columns: Vec<[f64; 6]> = twists.iter().map(|twist| super::choice::column(twist, reach)).collect();
        columns.extend(super::choice::columns(&self.behind(pose), &tool, reach));
        let kept: Vec<usize> = (0..columns.len()).filter(|k| !is_held(k)).collect();
        // A square matrix with rows of zeros has all its right singular vectors.
        let size = kept.len().max(6);
        let matrix = DMatrix::from_fn(size, kept.len(), |i, j| columns[kept[j]].get(i).copied().unwrap_or(0.0));
        let svd = finite(matrix).svd(false, true);
        let Some(right) = svd.v_t else { return Vec::new() };
        let small: Vec<usize> =
            (0..right.nrows()).filter(|i| svd.singular_values[*i] < 1e-9 * svd.singular_values.max()).collect();
        let moves = |j: &usize| small.iter().any(|i| right[(*i, *j)].abs() > MOVES);
        (0..kept.len()).filter(moves).map(|j| kept[j]).filter(|k| *k < q.len()).collect()
    }
}

/// Configurations that a joint held leaves: whether each only comes near the pose, and whether it is within the limits as far
/// as is known.
fn starts(solution: &Solution, found: &[Found]) -> Vec<(Vec<f64>, bool, bool)> {
    let modes = found.iter().filter(|found| found.mode.real).map(|found| {
        let q = found.mode.q.iter().map(|value| value.re).collect();
        (q, found.mode.near, found.mode.within_limits != Some(false))
    });
    let family = |family: &Family| (family.sample.clone(), family.distance > 0.0, true);
    modes.chain(solution.families.iter().map(family)).collect()
}

/// The real parts of complex solutions, of a conjugate pair once.
fn middles(found: &[Found]) -> Vec<Vec<f64>> {
    let is_first = |found: &&Found| {
        let part = found.mode.q.iter().map(|value| value.im).find(|im| *im != 0.0);
        !found.mode.real && part.is_some_and(|im| im > 0.0)
    };
    found.iter().filter(is_first).map(|found| found.mode.q.iter().map(|value| value.re).collect()).collect()
}

/// Returns the answer with curves that were followed, and with configurations at which the arm is locked.
fn traced(mut solution: Solution, families: Vec<Family>, locked: Vec<FullMode>) -> Solution {
    let dimension = families.iter().filter(|family| family.distance == 0.0).map(|family| family.dimension).max();
    moves(&mut solution, dimension.unwrap_or(1));
    let number = families.len();
    let besides = match locked.len() {
        0 => String::new(),
        1 => ", and at one configuration the arm is locked".to_owned(),
        count => format!(", and at {count} configurations the arm is locked"),
    };
    solution.verdict.reason = format!(
        "the arm has 1 more freedom than the task has conditions: {number} families were followed from configurations with a joint \
         held{besides}; that none is missed is not proved"
    );
    (solution.verdict.complex, solution.verdict.real) = (locked.len(), locked.len());
    solution.families = families;
    solution.modes = locked;
    solution
}

/// Makes an answer that of a redundant arm, without solutions yet.
fn moves(solution: &mut Solution, more: usize) {
    let verdict = &mut solution.verdict;
    (verdict.status, verdict.proof, verdict.code) = (Status::SelfMotion, Proof::None, Code::SelfMotion);
    (verdict.complex, verdict.real, verdict.certified, verdict.at_infinity) = (0, 0, 0, 0);
    (verdict.self_motion, verdict.complex_complete) = (more, false);
    solution.modes = Vec::new();
    solution.arm = Some(ArmAnswer::default());
}

/// The answer where the links are too short.
pub(super) fn out_of_reach(case: &Case, distance: (f64, f64)) -> Solution {
    Solution {
        arm: Some(ArmAnswer::default()),
        nearest: None,
        verdict: crate::verdict::out_of_reach(distance, &Assembly::default()),
        modes: Vec::new(),
        families: Vec::new(),
        warnings: case.warnings.clone(),
        prepare_us: 0.0,
        solve_us: 0.0,
        platform: None,
    }
}

/// The answer where no choice of held joints reaches the pose: others may.
fn nothing_found(mut solution: Solution, more: usize, locked: Vec<FullMode>) -> Solution {
    let verdict = &mut solution.verdict;
    (verdict.status, verdict.proof, verdict.code) = (Status::Incomplete, Proof::None, Code::TooFew);
    (verdict.complex, verdict.real, verdict.certified, verdict.complex_complete) =
        (locked.len(), locked.len(), 0, false);
    verdict.reason = if locked.is_empty() {
        let joints = if more == 1 { "joint" } else { "joints" };
        format!("not proved: no configuration was found with {more} {joints} held at some values")
    } else {
        "not proved: no configuration was found with a joint held at some values but those at which the arm is locked"
            .to_owned()
    };
    solution.modes = locked;
    solution.families = Vec::new();
    solution.arm = Some(ArmAnswer::default());
    solution
}
