//! Stewart platforms: one geometry, one set of leg lengths after the other.

use super::{FullMode, PlatformAnswer, PlatformMode, Solution};
use crate::algebra::number::Number;
use crate::algebra::ring::Ring;
use crate::assembly::platform::{self, PlatformAssembly, PlatformSolver};
use crate::assembly::{Roots, Workspace};
use crate::catalogue::entry::Case;
use crate::elimination::border::DIMENSION;
use crate::elimination::platform_degree::{PlatformDegree, platform_degree};
use crate::error::{Error, Result};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::motion::Motion;
use crate::kinematics::platform::Platform;
use crate::kinematics::velocity::velocity;
use crate::verdict::{Status, platform_verdict};
use rug::Rational;
use std::time::Instant;

/// A platform, prepared.
pub(super) struct PreparedPlatform {
    geometry: Platform<Number>,
    solver: PlatformSolver,
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

/// Whether a list needs no exact count: as many simple poses as there can be, all of them certified.
fn is_settled(assembly: &PlatformAssembly) -> bool {
    assembly.modes.len() == DIMENSION && assembly.modes.iter().all(|mode| mode.certificate.is_some())
}

/// What an exact count tells of singular poses: points of a curve of poses are no isolated ones, and a single singular pose
/// beside simple ones counts as many times as these leave over.
fn account_for_singular(assembly: &mut PlatformAssembly, exact: Option<PlatformDegree>) {
    match exact {
        // All of them are proved to be isolated.
        Some(PlatformDegree::Finite { poses, .. }) if certified(assembly) == poses => assembly.self_motion = 0,
        Some(PlatformDegree::Finite { poses, .. }) if assembly.self_motion == 0 => {
            let known: usize = assembly.modes.iter().map(|mode| mode.multiplicity).sum();
            let mut unknown = assembly.modes.iter_mut().filter(|mode| mode.multiplicity == 0);
            if let (Some(mode), None) = (unknown.next(), unknown.next())
                && poses >= known + 2
            {
                mode.multiplicity = poses - known;
            }
        }
        None if assembly.self_motion == 0 => {}
        _ => {
            let before = assembly.modes.len();
            assembly.modes.retain(|mode| mode.certificate.is_some());
            if assembly.modes.len() < before {
                // Their numbers have changed.
                assembly.modes.iter_mut().for_each(|mode| mode.mirror = None);
            }
        }
    }
}

fn certified(assembly: &PlatformAssembly) -> usize {
    assembly.modes.iter().filter(|mode| mode.certificate.is_some()).count()
}

impl PreparedPlatform {
    /// Prepares the geometry.
    pub(super) fn prepare(geometry: &Platform<Number>) -> Result<Self> {
        let image = over(geometry).ok_or_else(|| Error::Invalid("a coordinate without value".to_owned()))?;
        let start = Instant::now();
        let solver = PlatformSolver::prepare(&image);
        let prepare_us = start.elapsed().as_secs_f64() * 1e6;
        Ok(Self { geometry: geometry.clone(), solver, prepare_us })
    }

    /// Finds all poses with the legs of one case.
    pub(super) fn solve(&self, case: &Case, roots: Roots, workspace: &mut Workspace) -> Result<Solution> {
        let case_squares = case.legs_squared.as_ref();
        let case_squares =
            case_squares.ok_or_else(|| Error::Invalid("a case of a platform without legs".to_owned()))?;
        let squares = case_squares.each_ref().map(Number::to_f64);
        let (memory, assembly) = (&mut workspace.platform, &mut workspace.platform_assembly);
        let start = Instant::now();
        self.solver.solve(&squares, roots, memory, assembly);
        let mut solve_us = start.elapsed().as_secs_f64() * 1e6;
        let rationals = case_squares.each_ref().map(|square| square.rational().clone());
        let exact = match roots {
            Roots::All if !is_settled(assembly) => self.degree(&rationals),
            _ => None,
        };
        // Knowing how many poses there are, it looks for those it missed.
        if let Some(PlatformDegree::Finite { poses, .. }) = exact
            && assembly.total() < poses
        {
            let start = Instant::now();
            self.solver.solve_up_to(&squares, roots, Some(poses), memory, assembly);
            solve_us += start.elapsed().as_secs_f64() * 1e6;
        }
        let judge = |assembly: &PlatformAssembly| {
            let study: Vec<_> = assembly.modes.iter().map(|mode| self.solver.study(mode)).collect();
            platform_verdict(assembly, &study, roots, exact)
        };
        account_for_singular(assembly, exact);
        let mut verdict = judge(assembly);
        if let (Status::Incomplete, Some(PlatformDegree::Finite { poses, .. })) = (verdict.status, exact)
            && let Some(platform) = over(&self.geometry)
        {
            // What f64 does not reach, the exact data do.
            let start = Instant::now();
            self.solver.rescue(&platform, &rationals, poses, memory, assembly);
            account_for_singular(assembly, exact);
            verdict = judge(assembly);
            solve_us += start.elapsed().as_secs_f64() * 1e6;
        }
        let modes = assembly.modes.iter().map(|mode| self.full(mode));
        let legs = squares.map(f64::sqrt);
        let short = platform::out_of_reach(self.solver.platform(), &legs).map(|why| format!("no pose is real: {why}"));
        Ok(Solution {
            families: Vec::new(),
            verdict,
            modes: modes.collect(),
            warnings: case.warnings.iter().cloned().chain(short).collect(),
            prepare_us: self.prepare_us,
            solve_us,
            platform: Some(PlatformAnswer { legs, route: assembly.route.to_string() }),
        })
    }

    /// The exact number of poses.
    fn degree(&self, squares: &[Rational; 6]) -> Option<PlatformDegree> {
        platform_degree(&over(&self.geometry)?, squares)
    }

    fn full(&self, mode: &platform::PlatformMode) -> FullMode {
        let velocity = mode.real.then(|| {
            let [w, x, y, z] = mode.quaternion.map(|z| z.re);
            let rotation = Quaternion { scalar: w, vector: [x, y, z] }.scaled_rotation();
            let norm = w * w + x * x + y * y + z * z;
            let pose = Motion {
                rotation: rotation.map(|row| row.map(|x| x / norm)),
                translation: mode.position.map(|z| z.re),
            };
            velocity(self.solver.platform(), &pose)
        });
        FullMode {
            q: mode.quaternion.into_iter().chain(mode.position).collect(),
            real: mode.real,
            multiplicity: mode.multiplicity,
            residual: mode.residual,
            condition: velocity.as_ref().map_or(mode.condition, |v| v.singular_values[0] / v.singular_values[5]),
            certified: mode.certificate.is_some(),
            radius: mode.certificate.map_or(f64::INFINITY, |c| c.radius),
            within_limits: None,
            platform: Some(PlatformMode { velocity, mirror: mode.mirror.map(|index| index + 1) }),
        }
    }
}
