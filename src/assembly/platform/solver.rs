//! A platform prepared once and solved for one set of leg lengths after the other.

use super::mode::{PlatformAssembly, PlatformMode, Route};
use super::prepared::{Chart, Frame, STAGES};
use super::reflection::Reflection;
use super::rescue::starts;
use super::search::{Found, Search, Source};
use crate::algebra::number::nearest_f64;
use crate::assembly::Roots;
use crate::certify::pose::Curvature;
use crate::closure::study::Leg;
use crate::elimination::border::{BorderBasis, DIMENSION, Reals};
use crate::elimination::pencil::Square;
use crate::kinematics::platform::Platform;
use crate::solve::eigen::Method;
use crate::solve::spectrum::Spectrum;
use num_complex::Complex;
use rug::Rational;

/// Platforms moved a little that are solved for one whose border basis loses rank, at most.
const MOST_RUNS: usize = 8;

/// So many times more are where it is known that poses are missing.
const PATIENCE: usize = 4;

/// The geometry of a platform, prepared for every set of leg lengths. Shared between threads.
#[derive(Clone, Debug)]
pub struct PlatformSolver {
    platform: Platform<f64>,
    frame: Frame,
    charts: [Chart; 2],
    reflection: Option<Reflection>,
}

/// Scratch memory, reused from call to call: one for every thread.
pub struct PlatformWorkspace {
    basis: BorderBasis<f64>,
    spectrum: Spectrum<DIMENSION>,
    found: Vec<Found>,
}

impl Default for PlatformWorkspace {
    fn default() -> Self {
        Self {
            basis: BorderBasis::new(&Reals),
            spectrum: Spectrum::default(),
            found: Vec::with_capacity(2 * DIMENSION),
        }
    }
}

impl PlatformSolver {
    /// Prepares a geometry. Any finite coordinates will do; degenerate ones show in the answers.
    #[must_use]
    pub fn prepare(platform: &Platform<f64>) -> Self {
        let frame = Frame::new(platform);
        let charts = std::array::from_fn(|choice| Chart::new(&frame.platform, choice));
        Self { platform: platform.clone(), frame, charts, reflection: Reflection::of(platform) }
    }

    /// The geometry as given.
    #[must_use]
    pub fn platform(&self) -> &Platform<f64> {
        &self.platform
    }

    /// The 40 x 40 matrix whose eigenvalues are asked for with these legs; `None` where the geometry is special.
    #[must_use]
    pub fn matrix(&self, legs_squared: &[f64; 6], workspace: &mut PlatformWorkspace) -> Option<Square<f64, DIMENSION>> {
        let unit = self.frame.scale * self.frame.scale;
        let setting = self.charts[0].with_legs(&legs_squared.map(|square| square / unit));
        workspace.basis.build(&Reals, &setting).ok()?;
        workspace.basis.products[0].as_slice().try_into().ok()
    }

    /// Study's parameters of a mode as its certificate bounds them, where it has one: about the centre of the platform,
    /// lengths over the scale.
    #[must_use]
    pub fn study(&self, mode: &PlatformMode) -> [Complex<f64>; 8] {
        self.frame.study(&mode.quaternion, &mode.position)
    }

    /// All poses with legs of these squared lengths (negative ones are meant as written: no pose is real then). With
    /// [`Roots::Real`] only real ones.
    pub fn solve(
        &self,
        legs_squared: &[f64; 6],
        roots: Roots,
        workspace: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) {
        self.solve_up_to(legs_squared, roots, None, workspace, assembly);
    }

    /// The legs in the frame of polishing.
    fn legs(&self, legs_squared: &[f64; 6]) -> [Leg<f64>; 6] {
        let unit = self.frame.scale * self.frame.scale;
        let mut legs = self.frame.legs.clone();
        for (leg, square) in legs.iter_mut().zip(legs_squared) {
            leg.square = square / unit;
        }
        legs
    }

    /// Looks again for what is missing of the list solved last in this workspace, in numbers of 384 bits: `platform` and
    /// `legs_squared` are the same ones exactly, `expected` the number of its poses.
    pub fn rescue(
        &self,
        platform: &Platform<Rational>,
        legs_squared: &[Rational; 6],
        expected: usize,
        workspace: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) {
        let legs = self.legs(&legs_squared.each_ref().map(nearest_f64));
        let curvature = Curvature::new(&legs);
        let proved = |assembly: &PlatformAssembly| assembly.modes.iter().filter(|m| m.certificate.is_some()).count();
        let before = proved(assembly);
        let mut search = Search::going_on(&legs, &curvature, Roots::All, Some(expected), &mut workspace.found);
        search.proved_near(&starts(platform, legs_squared, &self.frame));
        assembly.modes.clear();
        search.tell(&self.frame, assembly);
        assembly.unresolved = search.unresolved();
        assembly.rescued = proved(assembly).saturating_sub(before);
        if let Some(reflection) = &self.reflection {
            reflection.mark(&mut assembly.modes);
        }
    }

    /// As [`PlatformSolver::solve`]; where the number of poses is known (see
    /// [`platform_degree`](crate::elimination::platform_degree::platform_degree)), special geometries are searched until
    /// all of them are found, and not longer.
    pub fn solve_up_to(
        &self,
        legs_squared: &[f64; 6],
        roots: Roots,
        expected: Option<usize>,
        workspace: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) {
        assembly.modes.clear();
        assembly.route = Route::None;
        assembly.lost_rank = None;
        assembly.rank = self.charts[0].directions.rank;
        assembly.self_motion = 0;
        assembly.rescued = 0;
        let legs = self.legs(legs_squared);
        let squares = legs.each_ref().map(|leg| leg.square);
        let curvature = Curvature::new(&legs);
        let mut search = Search::new(&legs, &curvature, roots, expected, &mut workspace.found);
        let mut solve = |chart: &Chart, path: &[[Leg<f64>; 6]], search: &mut Search| {
            let setting = chart.with_legs(&squares);
            if let Err(lost) = workspace.basis.build(&Reals, &setting) {
                return Err(lost.degree);
            }
            let near = !self.charts.iter().any(|own| std::ptr::eq(own, chart));
            for method in [Method::Francis, Method::Faer] {
                if !workspace.spectrum.decompose(method, &workspace.basis.products[0]) {
                    continue;
                }
                let source = Source { chart, setting: &setting, basis: &workspace.basis, path };
                search.all_eigenvalues(&source, &mut workspace.spectrum);
                if search.is_done() || near {
                    break;
                }
            }
            Ok(setting.count)
        };
        for chart in &self.charts {
            match solve(chart, &[], &mut search) {
                Ok(directions) => assembly.route = Route::BorderBasis { directions },
                Err(degree) => assembly.lost_rank = Some(degree),
            }
            if search.is_done() {
                break;
            }
        }
        if assembly.route == Route::None || search.lacks_known_poses() {
            // One border basis after the other, until three in a row bring nothing new.
            let mut unchanged = 0;
            let mut runs = 0;
            let most = if expected.is_some() { PATIENCE * MOST_RUNS } else { MOST_RUNS };
            while runs < most && (unchanged < 3 || search.lacks_known_poses()) && !search.has_all_known_poses() {
                let before = search.found.len();
                let platforms = self.frame.perturbed(runs / 2);
                let path = platforms
                    .each_ref()
                    .map(|p| std::array::from_fn(|i| Leg::new(&p.base[i], &p.plate[i], squares[i])));
                // In turn: a platform so near that its solutions lead to those wanted at once, and one farther away.
                let (start, path) =
                    if runs % 2 == 0 { (&platforms[STAGES - 1], &[][..]) } else { (&platforms[0], &path[..]) };
                let solved = solve(&Chart::new(start, runs / 2 % 2), path, &mut search);
                unchanged = if solved.is_ok() && search.found.len() == before { unchanged + 1 } else { 0 };
                runs += 1;
            }
            assembly.route = Route::Perturbed { runs };
            assembly.self_motion = search.self_motion();
        }
        assembly.null = search.null;
        assembly.unresolved = search.unresolved();
        search.tell(&self.frame, assembly);
        if let Some(reflection) = &self.reflection {
            reflection.mark(&mut assembly.modes);
        }
    }
}
