//! Stewart platforms: one geometry, one set of leg lengths after the other.

mod curve;
mod dependent;
mod exact;
mod roots;

use super::{Family, FullMode, PlatformAnswer, PlatformMode, Solution};
use crate::algebra::number::Number;
use crate::algebra::ring::Ring;
use crate::assembly::platform::{self, Distances, PlatformAssembly, PlatformSolver, PlatformWorkspace, Route};
use crate::assembly::{Roots, Workspace};
use crate::catalogue::entry::Case;
use crate::elimination::border::DIMENSION;
use crate::elimination::platform_polynomial::PlatformPolynomial;
use crate::error::{Error, Result};
use crate::kinematics::chain::Placement;
use crate::kinematics::motion::Motion;
use crate::kinematics::platform::{Platform, pose_of};
use crate::kinematics::platform_limits::{Part, PlatformLimits, listed};
use crate::kinematics::velocity::velocity;
use crate::verdict::{Code, Moving, PlatformKnowledge, Proof, Status, platform_verdict};
use curve::moves_along_curve;
use dependent::{Consistency, DependentLegs};
use exact::{ExactSide, Search};
use rug::Rational;
use std::time::Instant;

/// Most poses of a family seen in f64 from which a regular one is looked for.
const MOST_NEAR: usize = 8;

/// What is looked for.
struct Asked {
    roots: Roots,
    /// Whether complex poses are looked for beside the real ones.
    complex: bool,
    /// Whether the list has to be complete: it is known to have no real pose otherwise.
    is_needed: bool,
    /// Whether numbers of the file were rounded.
    is_rounded: bool,
}

/// A platform, prepared.
pub(super) struct PreparedPlatform {
    /// The points, rationals in the place of irrational coordinates.
    exact: Platform<Rational>,
    /// Whether some coordinate is irrational.
    is_rounded: bool,
    distances: Distances,
    solver: PlatformSolver,
    /// The legs that follow from others, whatever their lengths are.
    dependent: Option<DependentLegs>,
    limits: PlatformLimits,
    prepare_us: f64,
}

/// The points over a ring; `None` for an unlucky prime.
#[must_use]
pub fn over<R: Ring>(geometry: &Platform<Number>) -> Option<Platform<R>> {
    let points = |points: &[[Number; 3]; 6]| -> Option<[[R; 3]; 6]> {
        let images: Option<Vec<[R; 3]>> =
            points.iter().map(|[x, y, z]| Some([R::from_number(x)?, R::from_number(y)?, R::from_number(z)?])).collect();
        images?.try_into().ok()
    };
    Some(Platform { base: points(&geometry.base)?, plate: points(&geometry.plate)? })
}

/// Returns whether a list needs no exact count: it has the largest possible number of poses, all simple and certified.
fn is_settled(assembly: &PlatformAssembly) -> bool {
    assembly.modes.len() == DIMENSION && assembly.modes.iter().all(|mode| mode.certificate.is_some())
}

/// All poses of a platform whose polynomial is known, as far as they are found.
#[must_use]
pub fn exact_modes(
    platform: &Platform<Rational>,
    squares: &[Rational; 6],
    known: Option<&PlatformPolynomial>,
) -> Vec<platform::PlatformMode> {
    let solver = PlatformSolver::prepare_exact(platform);
    let (mut memory, mut assembly) = (PlatformWorkspace::default(), PlatformAssembly::default());
    solver.solve_up_to(squares, Roots::All, None, &mut memory, &mut assembly);
    if !is_settled(&assembly) {
        let side = ExactSide { platform, squares, incidence: solver.incidence(), complex: false };
        side.settle(&mut Search { solver: &solver, memory: &mut memory, assembly: &mut assembly }, known);
    }
    assembly.modes
}

/// The self-motion of a list as an answer, with a sample within the limits if there is one. No leg is named: all of them turn on
/// their joints.
fn families(
    assembly: &PlatformAssembly,
    status: Status,
    dimension: usize,
    is_within: impl Fn(&[f64]) -> bool,
) -> Vec<Family> {
    let all: Vec<Vec<f64>> = assembly.motion.iter().map(|pose| pose.to_vec()).collect();
    let sample = all.iter().find(|pose| is_within(pose)).or(all.first());
    let Some(sample) = sample.cloned().filter(|_| status == Status::SelfMotion) else { return Vec::new() };
    let samples = if all.len() > 1 { all } else { Vec::new() };
    vec![Family { dimension, moving: Vec::new(), distance: 0.0, sample, samples }]
}

impl PreparedPlatform {
    /// Prepares the geometry.
    pub(super) fn prepare(geometry: &Platform<Number>, limits: &PlatformLimits) -> Result<Self> {
        let exact: Platform<Rational> =
            over(geometry).ok_or_else(|| Error::Invalid("a coordinate without value".to_owned()))?;
        let start = Instant::now();
        let solver = PlatformSolver::prepare_exact(&exact);
        let dependent = DependentLegs::of(&exact);
        let prepare_us = start.elapsed().as_secs_f64() * 1e6;
        let distances = Distances::new(&exact);
        let is_rounded = geometry.base.iter().chain(&geometry.plate).flatten().any(|number| !number.is_exact());
        Ok(Self { exact, is_rounded, distances, solver, dependent, limits: limits.clone(), prepare_us })
    }

    /// Finds all poses with the legs of one case.
    pub(super) fn solve(&self, case: &Case, roots: Roots, workspace: &mut Workspace) -> Result<Solution> {
        let case_squares = case.legs_squared.as_ref();
        let case_squares =
            case_squares.ok_or_else(|| Error::Invalid("a case of a platform without legs".to_owned()))?;
        let squares = case_squares.each_ref().map(|square| square.rational().clone());
        let complex = !workspace.only_real_list;
        let (memory, assembly) = (&mut workspace.platform, &mut workspace.platform_assembly);
        let start = Instant::now();
        let short = self.distances.out_of_reach(&squares);
        let is_rounded = self.is_rounded || !case_squares.iter().all(Number::is_exact);
        let asked = Asked { roots, complex, is_needed: complex || short.is_none(), is_rounded };
        let (mut knowledge, is_settled_in_f64) = self.knowledge(&squares, &asked, memory, assembly);
        knowledge.complex_asked = complex && roots == Roots::All;
        knowledge.no_real_pose = short.is_some();
        let mut verdict = platform_verdict(assembly, roots, &knowledge);
        if roots == Roots::All
            && verdict.proof != Proof::Proved
            && assembly.self_motion <= 1
            && self.moves_at(case, &squares)
        {
            knowledge.moving = Some(Moving { dimension: 1, is_all: false });
            self.trace(case, &squares, assembly);
            verdict = platform_verdict(assembly, roots, &knowledge);
        }
        let solve_us = start.elapsed().as_secs_f64() * 1e6;
        // Certificates in f64 have the rounding of every number in their radii; whatever else there is speaks of the rationals that
        // stand for irrational ones.
        let is_theorem = is_settled_in_f64 && verdict.code == Code::GeneralBoundMet;
        verdict.proof = verdict.proof.of_rounded(is_rounded && !is_theorem);
        let outside = self.limits.legs_outside(&squares);
        let modes = assembly.modes.iter().map(|mode| self.full(mode, &outside));
        let is_within = |pose: &[f64]| self.joints_outside(pose).is_empty();
        let legs = case_squares.each_ref().map(|square| square.to_f64().sqrt());
        let short = short.map(|why| format!("no pose is real: {why}"));
        let beyond = (!outside.is_empty()).then(|| beyond(&outside));
        Ok(Solution {
            arm: None,
            nearest: None,
            families: families(assembly, verdict.status, verdict.self_motion, is_within),
            verdict,
            modes: modes.collect(),
            warnings: case.warnings.iter().cloned().chain(short).chain(beyond).collect(),
            prepare_us: self.prepare_us,
            solve_us,
            platform: Some(PlatformAnswer { legs, route: assembly.route.to_string(), outside }),
        })
    }

    /// Finds the poses, and says what is known of their number, and whether f64 alone has found and proved as many as there can be.
    fn knowledge(
        &self,
        squares: &[Rational; 6],
        asked: &Asked,
        memory: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) -> (PlatformKnowledge, bool) {
        let dependent = self.dependent.as_ref().filter(|_| asked.roots == Roots::All);
        if let Some(legs) = dependent
            && let Some(knowledge) = self.by_dependence(legs, (squares, asked.is_rounded), &[], memory, assembly)
        {
            return (knowledge, false);
        }
        self.solver.solve_up_to(squares, asked.roots, None, memory, assembly);
        let is_settled = is_settled(assembly);
        if asked.roots != Roots::All || !asked.is_needed || is_settled {
            return (PlatformKnowledge::default(), is_settled);
        }
        let side =
            ExactSide { platform: &self.exact, squares, incidence: self.solver.incidence(), complex: asked.complex };
        let found = side.settle(&mut Search { solver: &self.solver, memory, assembly }, None);
        let near: Vec<Motion<f64>> = assembly.motion.iter().filter_map(|pose| pose_of(pose)).take(MOST_NEAR).collect();
        let proved = dependent.filter(|_| !near.is_empty());
        let proved =
            proved.and_then(|legs| self.by_dependence(legs, (squares, asked.is_rounded), &near, memory, assembly));
        (proved.unwrap_or(found), false)
    }

    /// What is known where legs depend on others; `None` where no real pose is found with their lengths. `near` are poses nearby.
    fn by_dependence(
        &self,
        legs: &DependentLegs,
        (squares, is_rounded): (&[Rational; 6], bool),
        near: &[Motion<f64>],
        memory: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) -> Option<PlatformKnowledge> {
        let Consistency::Families(dimension) = legs.consistency(&self.exact, squares, is_rounded) else {
            *assembly = PlatformAssembly { route: Route::Dependent, ..PlatformAssembly::default() };
            return Some(PlatformKnowledge { count: Some(dependent::contradiction()), ..PlatformKnowledge::default() });
        };
        let pose = legs.regular_pose(squares, near, memory)?;
        let motion = match pose_of(&pose) {
            Some(through) if dimension == 1 => self.solver.curve_through(squares, &through),
            _ => vec![pose],
        };
        *assembly =
            PlatformAssembly { route: Route::Dependent, self_motion: dimension, motion, ..PlatformAssembly::default() };
        Some(PlatformKnowledge { moving: Some(Moving { dimension, is_all: true }), ..PlatformKnowledge::default() })
    }

    /// Returns whether the platform moves with its legs locked through the pose from which their lengths were computed.
    fn moves_at(&self, case: &Case, squares: &[Rational; 6]) -> bool {
        let pose = case.pose.as_ref().and_then(Placement::image::<Rational>);
        pose.is_some_and(|pose| moves_along_curve(&self.exact, squares, &pose))
    }

    /// Follows the curve through the pose from which the lengths of the legs were computed, if there are no poses of it yet.
    fn trace(&self, case: &Case, squares: &[Rational; 6], assembly: &mut PlatformAssembly) {
        assembly.self_motion = 1;
        if assembly.motion.is_empty()
            && let Some(pose) = &case.pose
        {
            assembly.motion = self.solver.curve_through(squares, &pose.float);
        }
    }

    /// Returns the joints whose legs leave their cones at a pose.
    fn joints_outside(&self, pose: &[f64]) -> Vec<Part> {
        if self.limits.is_empty() {
            return Vec::new();
        }
        pose_of(pose).map_or_else(Vec::new, |pose| self.limits.joints_outside(self.solver.platform(), &pose))
    }

    /// Returns a mode as a user reads it; `legs` are those outside their limits.
    fn full(&self, mode: &platform::PlatformMode, legs: &[Part]) -> FullMode {
        let q: Vec<f64> = mode.quaternion.iter().chain(&mode.position).map(|z| z.re).collect();
        let pose = pose_of(&q).filter(|_| mode.real);
        let velocity = pose.map(|pose| velocity(self.solver.platform(), &pose));
        let outside = if mode.real { [legs, &self.joints_outside(&q)].concat() } else { Vec::new() };
        let is_limited = mode.real && !self.limits.is_empty();
        FullMode {
            q: mode.quaternion.into_iter().chain(mode.position).collect(),
            real: mode.real,
            multiplicity: mode.multiplicity,
            residual: mode.residual,
            condition: velocity.as_ref().map_or(mode.condition, |v| v.singular_values[0] / v.singular_values[5]),
            certified: mode.certificate.is_some(),
            radius: mode.certificate.map_or(f64::INFINITY, |c| c.radius.max(self.solver.position_error(mode))),
            within_limits: is_limited.then_some(outside.is_empty()),
            near: false,
            error: None,
            platform: Some(PlatformMode { velocity, mirror: mode.mirror.map(|index| index + 1), outside }),
        }
    }
}

/// Describes legs outside their limits.
fn beyond(outside: &[Part]) -> String {
    let verb = if outside.len() == 1 { "is" } else { "are" };
    format!("{} {verb} outside the limits of length, and so is every pose", listed(outside))
}
