//! Arms of few joints: which solutions of the conditions that they meet are solutions of the pose.

use super::{Found, Inner, OF_FEW, TaskArm, Tools, conditions_of};
use crate::catalogue::entry::Case;
use crate::error::Result;
use crate::kinematics::chain::Placement;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::screws::VirtualJoint;
use crate::kinematics::task::Task;
use crate::kinematics::tolerance::{PoseError, Tolerance};
use crate::mechanism::nearest::{nearest, nearest_of_all};
use crate::mechanism::{ArmAnswer, Family, FullMode, Solution};
use crate::verdict::{Code, Proof, Status};
use std::f64::consts::TAU;

/// A complex solution with smaller imaginary parts may be a real one that rounding split.
const NEARLY_REAL: f64 = 1e-3;
/// Configurations whose joints all agree so far are one: those of a double root lie apart by the root of the rounding.
const SAME: f64 = 1e-5;
/// Largest condition number of a solution of the conditions, times the tolerance, that is surely apart from their self-motions.
const CONDITION: f64 = 1e-3;
/// Choices of conditions without a real solution after which no more are tried: at a pose that is reached others have one, and each takes
/// up to a tenth of a second.
const EMPTY: usize = 3;
/// Solutions of the conditions that miss the pose by fewer tolerances than this may have a configuration beside them that is within it: the
/// conditions are met exactly, and what is left takes all of the rounding of the pose.
const BESIDE: f64 = 100.0;
/// A curve of samples a tenth of a radian apart leaves the line between two of them by less than this.
const BESIDE_CURVE: f64 = 0.01;
/// Rounding of a miss that was measured in f64, in parts of the reach.
const ROUNDING: f64 = 1e-13;

impl TaskArm {
    /// Solves a pose by the conditions that the arm can meet.
    pub(super) fn by_conditions(
        &self,
        choices: &[(Vec<VirtualJoint>, Inner)],
        case: &Case,
        pose: &Placement,
        with: &mut Tools<'_>,
    ) -> Result<Solution> {
        let typed = case.typed.unwrap_or(OF_FEW).or(OF_FEW);
        let tolerance = with.tolerance.unwrap_or(typed);
        // What is worse conditioned may be near a self-motion of the conditions that is none of the arm, and says nothing of the pose.
        let within = tolerance.angle.max(tolerance.length / self.forward.reach().max(f64::MIN_POSITIVE));
        let is_regular = |found: &Found| found.mode.condition < CONDITION / within;
        let (mut best, mut none) = (None::<Solution>, None::<Solution>);
        let rank = |own: &Solution| (own.modes.len(), is_answer(own), own.nearest.is_some());
        let take = |judged: Solution, best: &mut Option<Solution>| {
            if best.as_ref().is_none_or(|best| rank(&judged) > rank(best)) {
                *best = Some(judged);
            }
        };
        // Closed forms first: where they fail, the other ways take a hundred times as long.
        for (filled, inner) in choices {
            let Some((solution, found)) = self.by_closed_form(inner, case, pose, with)? else { continue };
            let is_regular = !found.is_empty() && found.iter().all(is_regular);
            let judged = self.judged(solution, found, filled, pose, tolerance);
            if is_regular && is_listed(&judged) {
                return Ok(judged);
            }
            // Where all solutions of the conditions are complex, others may have a real one that shows how far the pose is.
            take(judged, if is_regular { &mut none } else { &mut best });
        }
        if let Some(known) = best.take_if(|best| is_listed(best)).or_else(|| none.take()) {
            return Ok(known);
        }
        let mut empty = 0;
        for (filled, inner) in choices {
            let (solution, found) = self.by(inner, case, pose, with)?;
            // Without a solution nothing shows whether the conditions are regular: rounding takes double ones away.
            let shows_nothing = found.is_empty() && solution.verdict.code != Code::OutOfReach;
            let is_regular = found.iter().all(is_regular);
            let judged = self.judged(solution, found, filled, pose, tolerance);
            let is_sure = is_answer(&judged) && is_regular;
            if is_sure && is_listed(&judged) {
                return Ok(judged);
            }
            let has_best = best.as_ref().is_some_and(is_listed);
            if is_sure && has_best {
                break;
            }
            if is_sure && !shows_nothing {
                return Ok(judged);
            }
            take(judged, if is_sure { &mut none } else { &mut best });
            empty += usize::from(shows_nothing);
            if empty == EMPTY {
                break;
            }
        }
        let says_more = |best: &mut Solution| is_listed(best) || is_answer(best) && best.nearest.is_some();
        let known = best.take_if(says_more).or(none).or(best);
        known.ok_or_else(|| crate::error::Error::Unsupported("no choice of conditions is regular".to_owned()))
    }

    /// The solutions of the conditions as those of the pose.
    fn judged(
        &self,
        mut solution: Solution,
        found: Vec<Found>,
        filled: &[VirtualJoint],
        pose: &Placement,
        tolerance: Tolerance,
    ) -> Solution {
        let total = found.len();
        let (mut listed, mut others) = (Vec::<FullMode>::new(), Vec::new());
        let is_met = |found: &Found| found.mode.real && tolerance.allows(&found.miss);
        // Three virtual rotations about one point have two triples of angles for every rotation. At a solution of the pose one is near
        // 0, the other one near a half turn: each of these is that of one solution with the first.
        let (turned, found): (Vec<Found>, Vec<Found>) =
            found.into_iter().partition(|found| found.is_turned && is_met(found));
        for found in found {
            if is_met(&found) {
                listed.push(FullMode { error: Some(found.miss), ..found.mode });
            } else {
                others.push(found);
            }
        }
        let mut has_twin = vec![false; listed.len()];
        for Found { mode, miss, .. } in turned {
            match (0..has_twin.len()).find(|k| !has_twin[*k] && self.is_twice(&listed[*k], &mode)) {
                Some(k) => has_twin[k] = true,
                None => listed.push(FullMode { error: Some(miss), ..mode }),
            }
        }
        let is_double = has_twin.contains(&true);
        let exact = listed.iter().filter(|mode| !mode.near).count();
        let with_multiplicity = listed.iter().filter(|mode| !mode.near).map(|mode| mode.multiplicity.max(1)).sum();
        let listed_none = listed.is_empty();
        let is_beside = |other: &Found| other.mode.real && tolerance.parts(&other.miss) < BESIDE;
        let mut closest: Option<(Vec<f64>, PoseError)> = None;
        for other in others.iter().filter(|other| listed_none || is_nearly_real(&other.mode) || is_beside(other)) {
            let Some((q, miss)) = self.nearest(other, pose, tolerance) else { continue };
            if tolerance.allows(&miss) {
                if listed.iter().all(|mode| self.are_apart(mode, &q)) {
                    listed.push(self.near_mode(&q, miss, &other.mode));
                }
            } else if closest.as_ref().is_none_or(|(_, best)| tolerance.parts(&miss) < tolerance.parts(best)) {
                closest = Some((q, miss));
            }
        }
        let all_miss = others.iter().filter(|other| other.mode.real).all(|other| self.surely_misses(other, tolerance));
        // A family may meet the conditions only, and not the pose.
        let families = &mut solution.families;
        for family in families.iter_mut() {
            self.measure(family, pose, tolerance);
        }
        families.retain(|family| !family.moving.is_empty() && family.distance.is_finite());
        listed.retain(|mode| !mode.near || !families.iter().any(|family| self.is_on(family, mode)));
        let is_nothing = listed.is_empty() && families.is_empty();
        let verdict = &mut solution.verdict;
        let is_known = matches!(verdict.status, Status::Complete | Status::Unreachable);
        let is_far = verdict.code == Code::OutOfReach;
        if is_known && !is_far {
            verdict.status = if is_nothing { Status::Unreachable } else { Status::Complete };
            if is_nothing && !all_miss {
                verdict.proof = Proof::None;
            }
            if is_nothing {
                verdict.code = Code::NoSolution;
            }
        }
        if verdict.status == Status::SelfMotion && !families.iter().any(|family| family.distance == 0.0) {
            verdict.status = Status::Incomplete;
            (verdict.proof, verdict.code, verdict.self_motion) = (Proof::None, Code::SelfMotion, 0);
        }
        let near = listed.len() - exact;
        (verdict.real, verdict.complex) = (with_multiplicity, with_multiplicity);
        verdict.complex_complete = false;
        verdict.certified = listed.iter().filter(|mode| mode.certified).count();
        let conditions = 6 - filled.len();
        let by = if is_double { ", two triples of virtual angles for each," } else { "" };
        let are = if exact == 1 { "is a solution" } else { "are solutions" };
        let of = format!("{exact} of {total} solutions of {conditions} conditions{by} {are} of the pose");
        let also = if near > 0 { format!(", {near} more come within the tolerance") } else { String::new() };
        verdict.reason = format!("{of}{also}; of the conditions: {}", verdict.reason);
        solution.nearest = if listed.is_empty() { closest } else { None };
        solution.modes = listed;
        solution.arm = Some(ArmAnswer { conditions: conditions_of(filled) });
        solution
    }

    /// Sets how far a family stays from the pose; infinitely far if beyond the tolerance.
    fn measure(&self, family: &mut Family, pose: &Placement, tolerance: Tolerance) {
        let miss = |q: &Vec<f64>| self.task.miss(&self.forward.pose(q), &pose.float);
        let misses: Vec<PoseError> = std::iter::once(&family.sample).chain(&family.samples).map(miss).collect();
        let worst = misses.iter().map(PoseError::largest).fold(0.0, f64::max);
        let rounding = ROUNDING * (1.0 + self.forward.reach());
        family.distance = match misses.iter().all(|miss| tolerance.allows(miss)) {
            true if worst < rounding => 0.0,
            true => worst,
            false => f64::INFINITY,
        };
    }

    /// The configuration nearest to the pose near a solution of the conditions.
    fn nearest(&self, other: &Found, pose: &Placement, tolerance: Tolerance) -> Option<(Vec<f64>, PoseError)> {
        if !(other.mode.real || is_nearly_real(&other.mode)) {
            return None;
        }
        let start: Vec<f64> = other.mode.q.iter().map(|value| value.re).collect();
        if self.task != Task::Pose {
            let miss = self.task.miss(&self.forward.pose(&start), &pose.float);
            return Some((start, miss));
        }
        Some(nearest(&self.forward, &start, &self.free_joints(), &pose.float, tolerance))
    }

    /// Returns the configuration that comes nearest to a pose of all that the search finds; `None` for a task that asks for less.
    pub(crate) fn nearest_of_all(&self, pose: &Placement) -> Option<(Vec<f64>, PoseError)> {
        if self.task != Task::Pose {
            return None;
        }
        let mut start = vec![0.0; self.forward.variables().len()];
        for (joint, held) in &self.held {
            start[*joint] = held.value();
        }
        nearest_of_all(&self.forward, &start, &self.free_joints(), &pose.float)
    }

    /// The joints that are not held.
    fn free_joints(&self) -> Vec<usize> {
        let total = self.forward.variables().len();
        (0..total).filter(|k| self.held.iter().all(|(held, _)| held != k)).collect()
    }

    /// Returns whether a configuration differs from a mode.
    fn are_apart(&self, mode: &FullMode, q: &[f64]) -> bool {
        let variables = self.forward.variables();
        mode.q.iter().zip(q).zip(variables).any(|((one, other), variable)| {
            let off = one.re - other;
            let off = if *variable == Variable::Rotation { off - TAU * (off / TAU).round() } else { off };
            off.abs() > SAME
        })
    }

    /// Returns whether a configuration is on a traced curve: near the line between two neighbouring samples.
    fn is_on(&self, family: &Family, mode: &FullMode) -> bool {
        let variables = self.forward.variables();
        let off = |k: usize, x: f64, y: f64| {
            let off = x - y;
            if variables[k] == Variable::Rotation { off - TAU * (off / TAU).round() } else { off }
        };
        let between =
            |one: &[f64], other: &[f64]| -> Vec<f64> { (0..one.len()).map(|k| off(k, other[k], one[k])).collect() };
        let q: Vec<f64> = mode.q.iter().map(|value| value.re).collect();
        let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
        family.samples.windows(2).any(|pair| {
            let (step, own) = (between(&pair[0], &pair[1]), between(&pair[0], &q));
            let part = (dot(&step, &own) / dot(&step, &step).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            own.iter().zip(&step).all(|(own, step)| (own - part * step).abs() < BESIDE_CURVE)
        })
    }

    /// Whether two certified modes agree within their radii in all joints of the arm: they differ in virtual joints alone.
    fn is_twice(&self, one: &FullMode, other: &FullMode) -> bool {
        let radius = one.radius + other.radius;
        let variables = self.forward.variables();
        one.certified
            && other.certified
            && one.q.iter().zip(&other.q).zip(variables).all(|((one, other), variable)| {
                let off = one.re - other.re;
                let off = if *variable == Variable::Rotation { off - TAU * (off / TAU).round() } else { off };
                off.abs() <= radius
            })
    }

    /// A configuration that only comes near the pose.
    fn near_mode(&self, q: &[f64], miss: PoseError, like: &FullMode) -> FullMode {
        let q: Vec<_> = q.iter().map(|value| num_complex::Complex::from(*value)).collect();
        let is_limited = !self.limits.is_empty();
        let within_limits = is_limited
            .then(|| crate::mechanism::single_loop::within_limits(&q, self.forward.variables(), &self.limits));
        FullMode {
            real: true,
            near: true,
            certified: false,
            radius: f64::INFINITY,
            multiplicity: 0,
            within_limits,
            error: Some(miss),
            q,
            ..like.clone()
        }
    }

    /// Whether a solution of the conditions is proved to miss the pose by more than the tolerance.
    fn surely_misses(&self, other: &Found, tolerance: Tolerance) -> bool {
        if !other.mode.certified || !other.mode.radius.is_finite() {
            return false;
        }
        let slack = self.slack(other.mode.radius);
        let rounding = ROUNDING * (1.0 + self.forward.reach());
        other.miss.position - slack.position - rounding > tolerance.length
            || other.miss.orientation - slack.orientation - ROUNDING > tolerance.angle
    }
}

/// Whether an answer lists a configuration.
fn is_listed(own: &Solution) -> bool {
    !own.modes.is_empty() || !own.families.is_empty()
}

/// Whether a list is one that its verdict is sure of.
fn is_answer(own: &Solution) -> bool {
    matches!(own.verdict.status, Status::Complete | Status::Unreachable)
}

/// Whether a complex solution may be a real one that rounding split.
fn is_nearly_real(mode: &FullMode) -> bool {
    !mode.real && mode.q.iter().all(|value| value.im.abs() < NEARLY_REAL)
}
