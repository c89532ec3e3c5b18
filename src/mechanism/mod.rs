//! A mechanism ready to solve: what a file says, prepared once, answered case by case.

mod bounds;
mod by_input;
mod data;
mod dependence;
pub(crate) mod exact_loop;
mod exact_modes;
mod family;
mod input_curve;
mod instant;
mod near;
mod nearest;
mod overconstrained_loop;
mod platform;
mod redundancy;
mod single_loop;
mod singular_posture;
mod spherical_angles;
mod spherical_chain;
mod task_arm;
mod turns;
mod unproved;
mod vicinity;

pub use family::{Family, Joints, Shape};
pub use input_curve::{Derivatives, InputCurve};
pub use instant::{Moving, MovingChain, relative};

use crate::algebra::number::Number;
use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::entry::{Case, Design, Entry};
use crate::error::Result;
use crate::kinematics::platform::Platform;
use crate::kinematics::platform_limits::{Part, PlatformLimits};
use crate::kinematics::task::Demand;
pub use crate::kinematics::tolerance::{PoseError, Tolerance};
use crate::kinematics::velocity::Velocity;
use crate::verdict::Verdict;
use num_complex::Complex;
use overconstrained_loop::OverconstrainedLoop;
use platform::PreparedPlatform;
pub use platform::{exact_modes as platform_modes, over as platform_over};
pub use redundancy::{Redundancy, redundancy};
use single_loop::SingleLoop;
pub use single_loop::{closed_loop, locked_variable, ss_dyad_loop};
pub use task_arm::ArmAnswer;
use task_arm::TaskArm;
use turns::Turns;
pub use turns::representatives;

/// One solution as a user reads it.
#[derive(Clone, Debug, PartialEq)]
pub struct FullMode {
    /// Joint variables in joint order; a C joint has its angle, then its distance; the given joint of a loop included.
    /// For a platform, the quaternion `w, x, y, z` and the position `x, y, z` of the plate.
    pub q: Vec<Complex<f64>>,
    /// Whether all of them are real.
    pub real: bool,
    /// The number of solutions that coincide here; 0 where it is not known.
    pub multiplicity: usize,
    /// Closure residual, dimensionless: see [`crate::assembly::Mode::residual`].
    pub residual: f64,
    /// Condition number of the Jacobian.
    pub condition: f64,
    /// Whether exactly one solution was proved to lie within `radius`.
    pub certified: bool,
    /// Error bound of every joint variable that is not given, angles in radians, distances in metres; infinite without
    /// proof.
    pub radius: f64,
    /// Whether a real solution respects the joint limits, of a platform those of its legs and joints; `None` for complex ones or
    /// without limits. Where it does, its
    /// angles lie within them, which may be outside `(-pi, pi]`.
    pub within_limits: Option<bool>,
    /// Whether it reaches the pose within the tolerance, but not exactly.
    pub near: bool,
    /// The error of the pose; `None` for an exact solution.
    pub error: Option<PoseError>,
    /// The part that only a platform has.
    pub platform: Option<PlatformMode>,
}

/// The part of a mode that only a platform has.
#[derive(Clone, Debug, PartialEq)]
pub struct PlatformMode {
    /// The velocity of the plate with respect to the legs, at a real mode.
    pub velocity: Option<Velocity>,
    /// Number, from 1, of the mode that is this one mirrored in the plane of the base.
    pub mirror: Option<usize>,
    /// The legs and joints of a real mode that are outside their limits.
    pub outside: Vec<Part>,
}

/// The answer to one case of a file.
#[derive(Clone, Debug)]
pub struct Solution {
    /// Is the list complete, and why.
    pub verdict: Verdict,
    /// Isolated solutions, real ones first.
    pub modes: Vec<FullMode>,
    /// Solutions that form a curve or more, as far as they were followed.
    pub families: Vec<Family>,
    /// Warnings of the reader of the file and of the solver.
    pub warnings: Vec<String>,
    /// Microseconds for the preparation of the geometry, spent once for all cases.
    pub prepare_us: f64,
    /// Microseconds for this case.
    pub solve_us: f64,
    /// The part that only an arm of few or many joints has, or one with a task or with held joints.
    pub arm: Option<ArmAnswer>,
    /// The configuration of an arm that comes nearest to a pose where none is within the tolerance, and by how much it misses: of arms of
    /// few joints the nearest one that the search met, of others see [`Mechanism::alone`].
    pub nearest: Option<(Vec<f64>, PoseError)>,
    /// The part that only a platform has.
    pub platform: Option<PlatformAnswer>,
}

impl Solution {
    /// Returns the number of modes and families that reach the pose within the tolerance, but not exactly.
    #[must_use]
    pub fn near(&self) -> usize {
        let modes = self.modes.iter().filter(|mode| mode.near).count();
        modes + self.families.iter().filter(|family| family.distance > 0.0).count()
    }

    /// Returns the answer without its complex solutions.
    fn of_real(mut self) -> Self {
        let complex = self.modes.iter().filter(|mode| !mode.real && mode.certified).count();
        self.modes.retain(|mode| mode.real);
        self.verdict.certified = self.verdict.certified.saturating_sub(complex);
        self.verdict.complex_complete = false;
        self
    }
}

/// The part of an answer that only a platform has.
#[derive(Clone, Debug, PartialEq)]
pub struct PlatformAnswer {
    /// The lengths of the legs.
    pub legs: [f64; 6],
    /// The route by which the modes were found, and its reason.
    pub route: String,
    /// The legs whose lengths are outside their limits.
    pub outside: Vec<Part>,
}

/// A mechanism file, prepared. Shared between threads; every thread brings its own [`Workspace`].
pub struct Mechanism {
    solver: Solver,
    turns: Turns,
    tolerance: Option<Tolerance>,
}

/// Who solves it.
enum Solver {
    SingleLoop(Box<SingleLoop>),
    OverconstrainedLoop(Box<OverconstrainedLoop>),
    Platform(Box<PreparedPlatform>),
    TaskArm(Box<TaskArm>),
}

impl Mechanism {
    /// Prepares an entry for all its cases, an arm for any pose.
    ///
    /// # Errors
    /// [`crate::error::Error::UnsupportedMobility`] for H joints, for a third S joint, and for too many translations.
    pub fn prepare(entry: &Entry) -> Result<Self> {
        Self::prepare_for(entry, &Demand::default())
    }

    /// Prepares an entry of which, if it is an arm, this is asked.
    ///
    /// # Errors
    /// As [`Mechanism::prepare`], and where too many joints of an arm are free.
    pub fn prepare_for(entry: &Entry, demand: &Demand) -> Result<Self> {
        let solver = match &entry.design {
            Design::Loop(chain) if overconstrained_loop::is_short(entry, chain)? => {
                Solver::OverconstrainedLoop(Box::new(OverconstrainedLoop::prepare(entry, chain)?))
            }
            Design::Arm(chain) if chain.freedoms() != 6 || *demand != Demand::default() => {
                Solver::TaskArm(Box::new(TaskArm::prepare(entry, chain, demand)?))
            }
            Design::Arm(chain) | Design::Loop(chain) => {
                Solver::SingleLoop(Box::new(SingleLoop::prepare(entry, chain)?))
            }
            Design::Platform(geometry) => {
                Solver::Platform(Box::new(PreparedPlatform::prepare(geometry, &entry.platform_limits)?))
            }
        };
        let turns = Turns::of(entry.chain(), &entry.limits);
        Ok(Self { solver, turns, tolerance: None })
    }

    /// Prepares a platform without limits.
    ///
    /// # Errors
    /// For a coordinate without a value.
    pub(crate) fn of_platform(geometry: &Platform<Number>) -> Result<Self> {
        let solver = Solver::Platform(Box::new(PreparedPlatform::prepare(geometry, &PlatformLimits::default())?));
        Ok(Self { solver, turns: Turns::of(None, &[]), tolerance: None })
    }

    /// Returns the mechanism with another tolerance: configurations of an arm within it of a pose are listed as near ones.
    #[must_use]
    pub fn with_tolerance(self, tolerance: Option<Tolerance>) -> Self {
        Self { tolerance, ..self }
    }

    /// Solves one case.
    ///
    /// # Errors
    /// [`crate::error::Error::Invalid`] for a case whose locked joint was not prepared.
    pub fn solve(
        &self,
        case: &Case,
        roots: Roots,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Result<Solution> {
        let mut solution = self.sample(case, roots, workspace, assembly)?;
        // Every answer goes through here: nothing is denied without proof. An overconstrained loop of rounded numbers closes
        // nowhere, as a rule, and says so without proof.
        if !matches!(self.solver, Solver::OverconstrainedLoop(_)) {
            solution.verdict = unproved::not_denied(solution.verdict);
        }
        Ok(solution)
    }

    /// Returns the configuration of an arm that comes nearest to the pose of a case where least squares from places all over look for it,
    /// and by how much it misses; a metre counts as much as a radian. `None` for other mechanisms, and for tasks that ask for less than
    /// the pose.
    fn nearest(&self, case: &Case) -> Option<(Vec<f64>, PoseError)> {
        let pose = case.pose.as_ref()?;
        let (mut q, miss) = match &self.solver {
            Solver::SingleLoop(solver) => solver.nearest(pose),
            Solver::TaskArm(solver) => solver.nearest_of_all(pose),
            Solver::OverconstrainedLoop(_) | Solver::Platform(_) => None,
        }?;
        self.turns.turn(&mut q);
        Some((q, miss))
    }

    /// Returns the answer to the only case that is asked: where nothing is listed, with what comes nearest. The search for it takes some
    /// milliseconds, which many cases would not be given.
    #[must_use]
    pub fn alone(&self, case: &Case, mut solution: Solution) -> Solution {
        if !solution.modes.iter().any(|mode| mode.real) && solution.families.is_empty() {
            solution.nearest = self.nearest(case).or(solution.nearest);
        }
        solution
    }

    /// Solves one case of a sweep, whose proof is about all of its inputs together: `unreachable` may be unproved here.
    ///
    /// # Errors
    /// As [`Mechanism::solve`].
    pub(crate) fn sample(
        &self,
        case: &Case,
        roots: Roots,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Result<Solution> {
        let mut solution = match &self.solver {
            Solver::SingleLoop(solver) => solver.solve(case, roots, self.tolerance, workspace, assembly),
            Solver::OverconstrainedLoop(solver) => solver.solve(case, roots, workspace, assembly),
            Solver::Platform(solver) => solver.solve(case, roots, workspace),
            Solver::TaskArm(solver) => solver.solve(case, roots, self.tolerance, workspace, assembly),
        }?;
        solution.modes.iter_mut().for_each(|mode| self.turns.apply(mode));
        Ok(solution)
    }
}
