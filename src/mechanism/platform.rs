//! Stewart platforms: one geometry, one set of leg lengths after the other.

mod exact;
mod roots;

use super::{Family, FullMode, PlatformAnswer, PlatformMode, Solution};
use crate::algebra::number::Number;
use crate::algebra::ring::Ring;
use crate::assembly::platform::{self, Distances, PlatformAssembly, PlatformSolver, PlatformWorkspace};
use crate::assembly::{Roots, Workspace};
use crate::catalogue::entry::Case;
use crate::elimination::border::DIMENSION;
use crate::elimination::platform_polynomial::PlatformPolynomial;
use crate::error::{Error, Result};
use crate::kinematics::platform::{Platform, pose_of};
use crate::kinematics::platform_limits::{Part, PlatformLimits, listed};
use crate::kinematics::velocity::velocity;
use crate::verdict::{Code, PlatformKnowledge, Status, platform_verdict};
use exact::{ExactSide, Search};
use rug::Rational;
use std::time::Instant;

/// A platform, prepared.
pub(super) struct PreparedPlatform {
    /// The points, rationals in the place of irrational coordinates.
    exact: Platform<Rational>,
    /// Whether some coordinate is irrational.
    is_rounded: bool,
    distances: Distances,
    solver: PlatformSolver,
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
        let prepare_us = start.elapsed().as_secs_f64() * 1e6;
        let distances = Distances::new(&exact);
        let is_rounded = geometry.base.iter().chain(&geometry.plate).flatten().any(|number| !number.is_exact());
        Ok(Self { exact, is_rounded, distances, solver, limits: limits.clone(), prepare_us })
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
        self.solver.solve_up_to(&squares, roots, None, memory, assembly);
        let mut solve_us = start.elapsed().as_secs_f64() * 1e6;
        let short = self.distances.out_of_reach(&squares);
        let mut knowledge = PlatformKnowledge::default();
        let is_asked = complex || short.is_none();
        let is_settled_in_f64 = is_settled(assembly);
        if roots == Roots::All && is_asked && !is_settled_in_f64 {
            let start = Instant::now();
            let (platform, squares, incidence) = (&self.exact, &squares, self.solver.incidence());
            let side = ExactSide { platform, squares, incidence, complex };
            knowledge = side.settle(&mut Search { solver: &self.solver, memory, assembly }, None);
            solve_us += start.elapsed().as_secs_f64() * 1e6;
        }
        knowledge.complex_asked = complex && roots == Roots::All;
        knowledge.no_real_pose = short.is_some();
        let mut verdict = platform_verdict(assembly, roots, &knowledge);
        // Certificates in f64 have the rounding of every coordinate in their radii; whatever else there is speaks of the rationals that
        // stand for irrational coordinates.
        let is_theorem = is_settled_in_f64 && verdict.code == Code::GeneralBoundMet;
        verdict.proof = verdict.proof.of_rounded(self.is_rounded && !is_theorem);
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
