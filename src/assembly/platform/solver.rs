//! A platform prepared once and solved for one set of leg lengths after the other.

use super::homotopy::{End, Homotopy};
use super::mode::{PlatformAssembly, PlatformMode, Route};
use super::prepared::{Chart, Frame};
use super::reflection::Reflection;
use super::rescue::starts;
use super::search::{Found, Search, Source, real_parts};
use super::self_motion::self_motion;
use super::triangle::TriangleRoute;
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

/// Homotopies from different general platforms, at most.
const MOST_RUNS: usize = 2;

/// So many times more are where it is known that poses are missing.
const PATIENCE: usize = 4;

/// The geometry of a platform, prepared for every set of leg lengths. Shared between threads.
#[derive(Clone, Debug)]
pub struct PlatformSolver {
    platform: Platform<f64>,
    frame: Frame,
    charts: [Chart; 2],
    reflection: Option<Reflection>,
    triangle: Option<TriangleRoute>,
}

/// Scratch memory, reused from call to call: one for every thread.
pub struct PlatformWorkspace {
    basis: BorderBasis<f64>,
    spectrum: Spectrum<DIMENSION>,
    found: Vec<Found>,
    /// Of the general platform at which a homotopy starts.
    general: Vec<Found>,
}

impl Default for PlatformWorkspace {
    fn default() -> Self {
        Self {
            basis: BorderBasis::new(&Reals),
            spectrum: Spectrum::default(),
            found: Vec::with_capacity(2 * DIMENSION),
            general: Vec::with_capacity(2 * DIMENSION),
        }
    }
}

impl PlatformSolver {
    /// Prepares a geometry. Any finite coordinates will do; degenerate ones show in the answers.
    #[must_use]
    pub fn prepare(platform: &Platform<f64>) -> Self {
        let frame = Frame::new(platform);
        let charts = std::array::from_fn(|choice| Chart::new(&frame.platform, choice));
        let (reflection, triangle) = (Reflection::of(platform), TriangleRoute::of(&frame.platform));
        Self { platform: platform.clone(), frame, charts, reflection, triangle }
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
        let known = workspace.found.clone();
        let mut search = Search::going_on(&legs, &curvature, Roots::All, Some(expected), &mut workspace.found);
        let poses = search.poses();
        search.proved_near(&starts(platform, legs_squared, &self.frame));
        if search.poses() < poses {
            // Of several that coincide, or nearly so, one was proved and the others were not found.
            *search.found = known;
        }
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
        let PlatformWorkspace { basis, spectrum, found, general } = workspace;
        let mut search = Search::new(&legs, &curvature, roots, expected, found);
        if let Some(triangle) = &self.triangle
            && triangle.solve(&self.frame.platform, &squares, &mut search)
            && search.is_done()
        {
            assembly.route = Route::Triangle { at_base: triangle.at_base() };
        }
        for chart in &self.charts {
            if assembly.route != Route::None && search.is_done() {
                break;
            }
            match by_border_basis(chart, &squares, basis, spectrum, &mut search) {
                Ok(directions) => assembly.route = Route::BorderBasis { directions },
                Err(degree) => assembly.lost_rank = Some(degree),
            }
        }
        if assembly.route == Route::None || search.lacks_known_poses() {
            let most = if expected.is_some() { PATIENCE * MOST_RUNS } else { MOST_RUNS };
            let (mut runs, mut unchanged) = (0, 0);
            // Two runs without anything new are enough, unless poses are known to be missing.
            let patience = if expected.is_some() { most } else { 2 };
            while runs < most
                && unchanged < patience
                && (runs == 0 || !search.is_done())
                && !search.has_all_known_poses()
            {
                let before = search.found.len();
                let start = self.frame.general(runs);
                let begin = std::array::from_fn(|i| Leg::new(&start.base[i], &start.plate[i], squares[i]));
                let curvature = Curvature::new(&begin);
                let mut first = Search::new(&begin, &curvature, Roots::All, None, general);
                runs += 1;
                if by_border_basis(&Chart::new(&start, 0), &squares, basis, spectrum, &mut first).is_ok() {
                    let bend = Complex::from_polar(1.0, BENDS[(runs - 1) % BENDS.len()]);
                    by_homotopy(&Homotopy { target: &legs, start: &begin, bend }, first.found, &mut search);
                }
                unchanged = if search.found.len() == before { unchanged + 1 } else { 0 };
            }
            assembly.route = Route::Homotopy { runs };
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

/// Angles by which the arcs of homotopies are bent, one after the other: none near 0 or pi, where arcs are straight or far.
const BENDS: [f64; 8] = [0.73, -1.31, 1.87, -0.52, 1.13, -2.05, 0.41, -0.94];

/// Follows all eigenvalues of a border basis: the number of unknowns beside the rotation, or the degree in which it lost
/// rank.
fn by_border_basis(
    chart: &Chart,
    squares: &[f64; 6],
    basis: &mut BorderBasis<f64>,
    spectrum: &mut Spectrum<DIMENSION>,
    search: &mut Search,
) -> Result<usize, usize> {
    let setting = chart.with_legs(squares);
    basis.build(&Reals, &setting).map_err(|lost| lost.degree)?;
    for method in [Method::Francis, Method::Faer] {
        if !spectrum.decompose(method, &basis.products[0]) {
            continue;
        }
        search.all_eigenvalues(&Source { chart, setting: &setting, basis }, spectrum);
        if search.is_done() {
            break;
        }
    }
    Ok(setting.count)
}

/// Carries all solutions of a general platform to the one that is searched.
fn by_homotopy(homotopy: &Homotopy, general: &[Found], search: &mut Search) {
    search.begin(0);
    for (index, found) in general.iter().enumerate() {
        let conjugate = (!found.real).then(|| found.study.map(|z| z.conj()));
        for (side, start) in [Some(found.study), conjugate].into_iter().flatten().enumerate() {
            match homotopy.carry(&start) {
                // Solutions on a curve are none to be listed, but a real one may pass near.
                End::Singular(point) if self_motion(homotopy.target, &point) > 0 => {
                    search.lost += 1;
                    search.keep_stray(&real_parts(&point)[2]);
                }
                End::Regular(point) => {
                    search.arrive(&point, 2 * index + side);
                }
                End::Singular(point) => search.arrive_singular(&point, 2 * index + side),
                End::Null => search.null += 1,
                End::Lost => search.lost += 1,
            }
        }
    }
    search.end();
}
