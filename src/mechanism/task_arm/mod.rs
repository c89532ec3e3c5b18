//! Arms that have more or fewer free joints than the pose has conditions: joints are held, or virtual joints make up for what is
//! missing, until the loop has six unknowns.

mod choice;
mod judge;
mod redundant;
mod trace;
mod upright;

use super::single_loop::SingleLoop;
use super::{FullMode, Solution};
use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::entry::{Case, Design, Entry};
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Placement};
use crate::kinematics::closed_loop::{Layout, Variable};
use crate::kinematics::data_field::ClosedForm;
use crate::kinematics::forward::Forward;
use crate::kinematics::screws::{Behind, Held, VirtualJoint};
use crate::kinematics::task::{Demand, Task};
use crate::kinematics::tolerance::{PoseError, Tolerance};
use choice::{Trial, conditions};
use num_complex::Complex;
use std::sync::OnceLock;
use std::time::Instant;

/// Largest number of free joints of an arm that is solved for a pose: one freedom is a family of curves.
const MOST_FREE: usize = 7;
/// Number of choices of conditions tried at a pose where one of them leaves a question open.
const MOST_CHOICES: usize = 4;
/// Tolerance of a pose of few joints where no other one is given.
const OF_FEW: Tolerance = Tolerance { length: 1e-6, angle: 1e-6 };

/// The part of an answer that only an arm of few or many joints has.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ArmAnswer {
    /// The conditions of the pose that the verdict is about; none where it is about the whole task.
    pub conditions: Vec<String>,
}

/// An arm, prepared for all its poses.
pub(super) struct TaskArm {
    /// The entry without what is not the business of the loops of six unknowns.
    shell: Entry,
    chain: Chain,
    forward: Forward,
    limits: Vec<[f64; 2]>,
    task: Task,
    /// The variables that are held, the last one by the virtual joint that is coaxial with it.
    held: Vec<(usize, Held)>,
    /// The joint that the task leaves free as it stands along the tool's axis.
    coaxial: Option<usize>,
    plan: Plan,
    /// The same arm asked for the direction of the tool's axis, for poses at which the tilt fixes it.
    upright: OnceLock<Result<Box<TaskArm>>>,
}

/// The way in which the loop is completed to six unknowns.
enum Plan {
    /// It has them.
    Whole(Box<Inner>),
    /// Virtual joints make up for those that are missing, in one of these ways.
    Filled(Vec<(Vec<VirtualJoint>, Inner)>),
    /// This number of joints has to be held, in one of these ways.
    Redundant(usize, Vec<Inner>),
    /// No choice of conditions is regular where the tool may tilt, as of arms whose tool never does.
    Dependent(Error),
}

/// A loop of six unknowns, prepared at its first use.
#[derive(Default)]
struct Inner {
    held: Vec<(usize, Held)>,
    filled: Vec<VirtualJoint>,
    solver: OnceLock<Result<SingleLoop>>,
}

/// A solution of the loop of six unknowns as one of the arm.
struct Found {
    mode: FullMode,
    miss: PoseError,
    /// Whether there are three virtual rotations, all nearer to a half turn than to 0.
    is_turned: bool,
}

impl TaskArm {
    /// Prepares the arm of an entry.
    ///
    /// # Errors
    /// For joints that are not solved, and where too many joints are free.
    pub(super) fn prepare(entry: &Entry, chain: &Chain, demand: &Demand) -> Result<Self> {
        Layout::of(chain, None)?;
        let forward = Forward::of(chain)
            .ok_or_else(|| Error::Unsupported("the numbers of this arm are not known well enough".to_owned()))?;
        let total = forward.variables().len();
        let free = total - demand.held.len();
        if free > MOST_FREE {
            let more = free - MOST_FREE;
            return Err(Error::Invalid(format!(
                "found {free} free joints, expected at most {MOST_FREE}: hold {more} of them by --lock NAME=VALUE"
            )));
        }
        if free == 0 {
            return Err(Error::Invalid("found no free joint, expected one at least".to_owned()));
        }
        let limits = entry.limits.clone();
        let mut held = demand.held.clone();
        let coaxial = coaxial(chain, demand.task, &held);
        held.extend(coaxial.map(|joint| (joint, redundant::middle(&forward, &limits, joint))));
        let shell = Entry { limits: Vec::new(), cases: Vec::new(), ..entry.clone() };
        let mut arm = Self {
            shell,
            chain: chain.clone(),
            forward,
            limits,
            task: demand.task,
            held,
            coaxial,
            plan: Plan::Redundant(0, Vec::new()),
            upright: OnceLock::new(),
        };
        let unknowns = total - arm.held.len() + arm.task.free();
        arm.plan = match unknowns {
            6 => Plan::Whole(Box::new(Inner { held: arm.held.clone(), ..Inner::default() })),
            7.. => Plan::Redundant(unknowns - 6, arm.with_more_held(unknowns - 6)),
            _ => match arm.filled(6 - unknowns) {
                Err(error) if arm.task == Task::PositionTilt => Plan::Dependent(error),
                choices => Plan::Filled(choices?),
            },
        };
        Ok(arm)
    }

    /// The ways to make up for missing joints, the best one first.
    fn filled(&self, missing: usize) -> Result<Vec<(Vec<VirtualJoint>, Inner)>> {
        let choices = self.trial().filled(missing, &self.behind(&Placement::identity()));
        if choices.is_empty() {
            let message =
                "the joint axes are dependent in every configuration: fewer conditions than joints can be met";
            return Err(Error::UnsupportedMobility(message.to_owned()));
        }
        let inner = |filled: Vec<VirtualJoint>| {
            (filled.clone(), Inner { held: self.held.clone(), filled, solver: OnceLock::new() })
        };
        Ok(choices.into_iter().take(MOST_CHOICES).map(inner).collect())
    }

    fn trial(&self) -> Trial {
        let held: Vec<(usize, f64)> = self.held.iter().map(|(k, value)| (*k, value.value())).collect();
        Trial::of(&self.forward, &self.limits, &held)
    }

    /// The virtual joints of the task at a pose.
    fn behind(&self, pose: &Placement) -> Vec<Behind> {
        self.task.behind(&|| Behind::Constant(Box::new(pose.turned_back())))
    }

    /// Solves one pose.
    pub(super) fn solve(
        &self,
        case: &Case,
        roots: Roots,
        tolerance: Option<Tolerance>,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Result<Solution> {
        let start = Instant::now();
        let mut with = Tools { roots, tolerance, workspace, assembly };
        let Some(pose) = &case.pose else { return Err(Error::Invalid("a case of an arm without pose".to_owned())) };
        // The loops have other joints than the arm.
        let own;
        let (case, pose) = if matches!(pose.closed, Some(ClosedForm::Joints(_))) {
            own = (Case { pose: None, ..case.clone() }, pose.in_entries(&self.chain));
            (&Case { pose: Some(own.1.clone()), ..own.0 }, &own.1)
        } else {
            (case, pose)
        };
        if let Some(is_exact) = self.stands_upright(case, pose, tolerance) {
            return self.solve_upright(is_exact, case, &mut with);
        }
        let mut solution = match &self.plan {
            Plan::Dependent(error) => return Err(error.clone()),
            Plan::Whole(inner) => {
                let (solution, found) = self.by(inner, case, pose, &mut with)?;
                let modes = found.into_iter().map(|found| FullMode { error: Some(found.miss), ..found.mode }).collect();
                Solution { modes, arm: Some(ArmAnswer::default()), ..solution }
            }
            Plan::Filled(choices) => self.by_conditions(choices, case, pose, &mut with)?,
            Plan::Redundant(more, ways) => {
                let solution = match self.beyond(pose, tolerance.unwrap_or_default()) {
                    Some(distance) => redundant::out_of_reach(case, distance),
                    None => self.redundant(*more, ways, case, pose, &mut with)?,
                };
                Solution { solve_us: start.elapsed().as_secs_f64() * 1e6, ..solution }
            }
        };
        match (self.coaxial, &self.plan) {
            (Some(joint), Plan::Redundant(..)) => redundant::free_besides(&mut solution, joint),
            (Some(joint), _) => redundant::free(&mut solution, joint),
            (None, _) => {}
        }
        Ok(solution)
    }

    /// Returns the distance to a pose and the length of all links together, in metres, where these are too short for every pose within the
    /// tolerance. A task that leaves the orientation open is not asked.
    fn beyond(&self, pose: &Placement, tolerance: Tolerance) -> Option<(f64, f64)> {
        if self.task != Task::Pose {
            return None;
        }
        // Another orientation moves the origin of the last link by so much.
        let turned = tolerance.angle * self.forward.reach();
        self.forward.too_far(&pose.float, tolerance.length + turned)
    }

    /// The solutions of a loop of six unknowns.
    fn by(&self, inner: &Inner, case: &Case, pose: &Placement, with: &mut Tools<'_>) -> Result<(Solution, Vec<Found>)> {
        let tolerance = with.tolerance;
        let solution = self.with_solver(inner, case, pose, |solver, case| {
            solver.solve(case, with.roots, tolerance, with.workspace, with.assembly)
        })?;
        Ok(self.of_loop(solution, inner, pose))
    }

    /// The solutions of a loop of six unknowns by a closed form alone, complex ones too; `None` where that does not prove its list.
    fn by_closed_form(
        &self,
        inner: &Inner,
        case: &Case,
        pose: &Placement,
        with: &mut Tools<'_>,
    ) -> Result<Option<(Solution, Vec<Found>)>> {
        let tolerance = with.tolerance;
        let solution = self.with_solver(inner, case, pose, |solver, case| {
            solver.solve_in_closed_form(case, Roots::All, tolerance, with.workspace, with.assembly)
        })?;
        Ok(solution.map(|solution| self.of_loop(solution, inner, pose)))
    }

    /// Asks the solver of a loop of six unknowns, prepared at its first use.
    fn with_solver<T>(
        &self,
        inner: &Inner,
        case: &Case,
        pose: &Placement,
        ask: impl FnOnce(&SingleLoop, &Case) -> Result<T>,
    ) -> Result<T> {
        // The angle between the axes of a task with tilt is a constant of the loop: it is prepared for every pose.
        if self.task == Task::PositionTilt {
            let own = Case { pose: Some(pose.without_rotation()), ..case.clone() };
            return ask(&self.loop_of(inner, pose)?, &own);
        }
        ask(inner.solver.get_or_init(|| self.loop_of(inner, pose)).as_ref().map_err(Clone::clone)?, case)
    }

    /// Returns the solution of a loop of six unknowns as one of the arm, its modes apart.
    fn of_loop(&self, mut solution: Solution, inner: &Inner, pose: &Placement) -> (Solution, Vec<Found>) {
        let kept = self.kept(inner);
        let found =
            std::mem::take(&mut solution.modes).into_iter().map(|mode| self.of_arm(mode, &kept, inner, pose)).collect();
        for family in &mut solution.families {
            family.moving = family.moving.iter().filter_map(|k| kept.get(*k).copied()).collect();
            family.sample = self.assembled(&family.sample, &kept, inner);
            family.samples = family.samples.iter().map(|q| self.assembled(q, &kept, inner)).collect();
        }
        (solution, found)
    }

    /// The variables that are not held, in joint order.
    fn kept(&self, inner: &Inner) -> Vec<usize> {
        let is_held = |k: &usize| inner.held.iter().any(|(own, _)| own == k);
        (0..self.forward.variables().len()).filter(|k| !is_held(k)).collect()
    }

    /// The loop of six unknowns at a pose.
    fn loop_of(&self, inner: &Inner, pose: &Placement) -> Result<SingleLoop> {
        let mut behind: Vec<Behind> = inner.filled.iter().copied().map(Behind::Joint).collect();
        behind.extend(self.behind(pose));
        let chain = self
            .chain
            .in_screws(&inner.held, &behind)
            .ok_or_else(|| Error::Unsupported("the numbers of this arm are not known well enough".to_owned()))?;
        let is_rounded = self.shell.rounded || inner.held.iter().any(|(_, value)| !value.is_exact());
        let cases = vec![Case::at(Placement::identity(), 1)];
        let shell = Entry { design: Design::Arm(chain.clone()), rounded: is_rounded, cases, ..self.shell.clone() };
        SingleLoop::prepare(&shell, &chain)
    }

    /// The values of all joints from those of a loop; held ones stand at their values, virtual ones are left out.
    fn assembled<T: Copy + From<f64>>(&self, unknowns: &[T], kept: &[usize], inner: &Inner) -> Vec<T> {
        let mut q = vec![T::from(0.0); self.forward.variables().len()];
        for (k, value) in &inner.held {
            q[*k] = T::from(value.value());
        }
        for (k, value) in kept.iter().zip(unknowns) {
            q[*k] = *value;
        }
        q
    }

    fn of_arm(&self, mode: FullMode, kept: &[usize], inner: &Inner, pose: &Placement) -> Found {
        let q: Vec<Complex<f64>> = self.assembled(&mode.q, kept, inner);
        // Virtual joints stand behind those of the arm.
        let virtual_ones = mode.q.iter().skip(kept.len());
        let is_turned = inner.filled.len() == 3
            && inner.filled.iter().all(|own| own.variable == Variable::Rotation)
            && virtual_ones.take(3).all(|angle| angle.re.cos() < 0.0);
        let real: Vec<f64> = q.iter().map(|value| value.re).collect();
        let miss = self.task.miss(&self.forward.pose(&real), &pose.float);
        let is_limited = mode.real && !self.limits.is_empty();
        let within_limits =
            is_limited.then(|| super::single_loop::within_limits(&q, self.forward.variables(), &self.limits));
        Found { mode: FullMode { q, within_limits, ..mode }, miss, is_turned }
    }

    /// Bound of the way of the tool by joint values that are off by a radius, and of its turning.
    fn slack(&self, radius: f64) -> PoseError {
        let variables = self.forward.variables();
        let turning = variables.iter().filter(|variable| **variable == Variable::Rotation).count() as f64;
        let sliding = variables.len() as f64 - turning;
        // A sliding joint at a value lengthens the arm: twice the reach leaves room for that of every pose that is met.
        let reach = 2.0 * self.forward.reach();
        PoseError { position: radius * (turning * reach + sliding), orientation: radius * turning }
    }
}

/// The tools of a search.
struct Tools<'a> {
    roots: Roots,
    tolerance: Option<Tolerance>,
    workspace: &'a mut Workspace,
    assembly: &'a mut Assembly,
}

/// The last joint that is not held, where it turns about the tool's z axis, about which the task lets the tool turn.
fn coaxial(chain: &Chain, task: Task, held: &[(usize, Held)]) -> Option<usize> {
    if !matches!(task, Task::PositionAxis | Task::PositionTilt) {
        return None;
    }
    let (variables, constants) = chain.unknowns_and_constants::<rug::Rational>()?;
    let last = variables.len().checked_sub(1)?;
    let (constant, variable) = (constants.last()?, variables.last()?);
    let [x, y, _] = &constant.translation;
    let along = x.is_zero() && y.is_zero() && constant.rotation[2][0].is_zero() && constant.rotation[2][1].is_zero();
    let is_held = held.iter().any(|(k, _)| *k == last);
    (along && *variable == Variable::Rotation && !is_held).then_some(last)
}

/// The conditions that a choice of virtual joints leaves.
fn conditions_of(filled: &[VirtualJoint]) -> Vec<String> {
    conditions(filled)
}
