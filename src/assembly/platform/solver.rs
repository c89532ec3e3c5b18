//! A platform prepared once and solved for one set of leg lengths after the other.

use super::affine::affine_starts;
use super::exact::exact_modes;
use super::high_precision::{starts, starts_of_table};
use super::homotopy::{End, Homotopy};
use super::mode::{PlatformAssembly, PlatformMode, Route};
use super::prepared::{Chart, Frame, LegNumbers, Squares};
use super::reflection::Reflection;
use super::search::{Found, Search, Source, real_parts, take_in, tell};
use super::self_motion::{curve, project, self_motion};
use super::triangle::TriangleRoute;
use crate::algebra::long_float::{LongFloat, LongNumber};
use crate::algebra::number::nearest_f64;
use crate::assembly::Roots;
use crate::closure::study::Leg;
use crate::elimination::affine_platform::AffineRelation;
use crate::elimination::border::{BorderBasis, DIMENSION, Reals};
use crate::elimination::multiple_pose::ExactPoses;
use crate::elimination::pencil::Square;
use crate::elimination::platform_basis::PoseTable;
use crate::elimination::platform_incidence::most_poses;
use crate::kinematics::motion::{Motion, Vector};
use crate::kinematics::platform::Platform;
use crate::solve::eigen::Method;
use crate::solve::pose::Eight;
use crate::solve::scalar::narrowed;
use crate::solve::spectrum::Spectrum;
use num_complex::Complex;
use rug::Rational;

/// Maximum number of homotopies from different general platforms.
const MOST_RUNS: usize = 2;

/// A radius above this is wide: two nearly coincident poses may differ by less.
const WIDE_BALL: f64 = 1e-10;

/// Factor on `MOST_RUNS` when poses are known to be missing.
const PATIENCE: usize = 4;

/// The effort spent on a set of legs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Effort {
    /// Special geometries with an algebra of their own are searched for simple poses only; exact arithmetic handles the other
    /// poses better.
    Algebra,
    /// Homotopies are added if poses may be missing.
    All,
    /// The algebra of special geometries is skipped, because it was tried before.
    Homotopies,
}

/// The geometry of a platform, prepared for every set of leg lengths. Shared between threads.
#[derive(Clone, Debug)]
pub struct PlatformSolver {
    platform: Platform<f64>,
    frame: Frame,
    charts: [Chart; 2],
    reflection: Option<Reflection>,
    triangle: Option<TriangleRoute>,
    /// The exact points if base and moving platform are affine images of the same six points, and the number of poses then.
    affine: Option<(Box<Platform<Rational>>, usize)>,
    /// A bound on the number of poses for legs of any length, and its reason.
    incidence: Option<(usize, &'static str)>,
}

/// Scratch memory, reused from call to call; each thread needs its own.
pub struct PlatformWorkspace {
    basis: BorderBasis<f64>,
    spectrum: Spectrum<DIMENSION>,
    found: Vec<Found>,
    /// Solutions of the general platform at which a homotopy starts.
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
    /// Prepares a geometry. Any finite coordinates are accepted; the results show degenerate ones.
    #[must_use]
    pub fn prepare(platform: &Platform<f64>) -> Self {
        let exact = |points: &[Vector<f64>; 6]| points.map(|p| p.map(|x| Rational::from_f64(x).unwrap_or_default()));
        Self::prepare_exact(&Platform { base: exact(&platform.base), plate: exact(&platform.plate) })
    }

    /// Prepares a geometry whose numbers are not all exact in f64.
    #[must_use]
    pub fn prepare_exact(platform: &Platform<Rational>) -> Self {
        let frame = Frame::new(platform);
        let affine = AffineRelation::of(platform).map(|relation| (Box::new(platform.clone()), relation.bound().poses));
        let incidence = most_poses(platform);
        let charts = std::array::from_fn(|choice| Chart::new(&frame.platform, choice));
        let nearest = |points: &[Vector<Rational>; 6]| points.each_ref().map(|p| p.each_ref().map(nearest_f64));
        let platform = Platform { base: nearest(&platform.base), plate: nearest(&platform.plate) };
        let (reflection, triangle) = (Reflection::of(&platform), TriangleRoute::of(&frame.platform));
        Self { platform, frame, charts, reflection, triangle, affine, incidence }
    }

    /// Returns the geometry as given.
    #[must_use]
    pub fn platform(&self) -> &Platform<f64> {
        &self.platform
    }

    /// Returns the bound on the number of poses that a theorem on the geometry gives, and its reason.
    #[must_use]
    pub fn incidence(&self) -> Option<(usize, &'static str)> {
        self.incidence
    }

    /// Returns a bound on the error of the translation of a certified mode, in the unit of the mechanism; infinite without certificate.
    #[must_use]
    pub fn position_error(&self, mode: &PlatformMode) -> f64 {
        mode.certificate.map_or(f64::INFINITY, |c| self.frame.position_error(&mode.study, c.radius))
    }

    /// Returns the 40 x 40 matrix whose eigenvalues are computed for these legs; `None` if the geometry is special.
    #[must_use]
    pub fn matrix(&self, legs_squared: &[f64; 6], workspace: &mut PlatformWorkspace) -> Option<Square<f64, DIMENSION>> {
        let unit = self.frame.scale * self.frame.scale;
        let setting = self.charts[0].with_legs(&legs_squared.map(|square| square / unit));
        workspace.basis.build(&Reals, &setting).ok()?;
        workspace.basis.products[0].as_slice().try_into().ok()
    }

    /// Finds all poses with legs of these squared lengths, or only the real ones with [`Roots::Real`]. A negative square is
    /// allowed; then no pose is real.
    pub fn solve(
        &self,
        legs_squared: &[f64; 6],
        roots: Roots,
        workspace: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) {
        workspace.found.clear();
        // The algebra of special platforms needs exact numbers and memory; the homotopy in f64 does not.
        self.run(&Squares::of_floats(legs_squared), roots, None, Effort::All, workspace, assembly);
    }

    /// Searches for the missing poses of the list solved last in this workspace, in numbers of `LIMBS` words of 64 bits.
    /// `platform` and `legs_squared` are the same data in exact form; `expected` is the number of poses.
    pub fn solve_in_high_precision<const LIMBS: usize>(
        &self,
        platform: &Platform<Rational>,
        legs_squared: &[Rational; 6],
        expected: usize,
        workspace: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) {
        let starts = starts::<LIMBS>(platform, legs_squared, &self.frame);
        self.prove_near::<LIMBS>(&starts, legs_squared, expected, workspace, assembly);
    }

    /// As [`Self::solve_in_high_precision`], from the exact table of the poses of the same platform and legs.
    pub fn solve_by_table<const LIMBS: usize>(
        &self,
        table: &PoseTable,
        legs_squared: &[Rational; 6],
        expected: usize,
        workspace: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) {
        let starts = starts_of_table::<LIMBS>(table, &self.frame);
        self.prove_near::<LIMBS>(&starts, legs_squared, expected, workspace, assembly);
    }

    fn prove_near<const LIMBS: usize>(
        &self,
        starts: &[Eight<Complex<LongNumber<LIMBS>>>],
        legs_squared: &[Rational; 6],
        expected: usize,
        workspace: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) {
        let numbers = self.frame.with_legs(&Squares::of(legs_squared));
        let proved = |assembly: &PlatformAssembly| assembly.modes.iter().filter(|m| m.certificate.is_some()).count();
        let before = proved(assembly);
        // Solutions with a wide ball are found again, as a rule with a narrow one.
        let is_wide = |found: &Found| found.certificate.is_some_and(|c| c.radius > WIDE_BALL);
        let wide: Vec<Found> = workspace.found.iter().copied().filter(is_wide).collect();
        workspace.found.retain(|found| found.certificate.is_some() && !is_wide(found));
        let mut search = Search::going_on(&numbers, Roots::All, Some(expected), &mut workspace.found);
        let legs = self.frame.long_legs::<LongNumber<LIMBS>>(legs_squared);
        search.proved_near(&legs, starts);
        for found in wide {
            take_in(search.found, found);
        }
        assembly.modes.clear();
        tell(search.found, &self.frame, assembly);
        assembly.unresolved = search.unresolved();
        let more = proved(assembly).saturating_sub(before);
        if more > 0 {
            (assembly.by_high_precision, assembly.high_precision_bits) =
                (assembly.by_high_precision + more, 64 * LIMBS);
        }
        if let Some(reflection) = &self.reflection {
            reflection.mark(&mut assembly.modes);
        }
    }

    /// As [`PlatformSolver::solve`], for numbers that are not all exact in f64. If the number of poses is known (see
    /// [`platform_degree`](crate::elimination::platform_degree::platform_degree)), special geometries are searched until
    /// all of them are found, and no longer.
    pub fn solve_up_to(
        &self,
        legs_squared: &[Rational; 6],
        roots: Roots,
        expected: Option<usize>,
        workspace: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) {
        workspace.found.clear();
        let effort = if expected.is_some() { Effort::All } else { Effort::Algebra };
        self.run(&Squares::of(legs_squared), roots, expected, effort, workspace, assembly);
    }

    /// Searches for poses that are not proved in the list solved last in this workspace, up to the expected number.
    pub fn solve_further(
        &self,
        legs_squared: &[Rational; 6],
        expected: usize,
        workspace: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) {
        workspace.found.retain(|found| found.certificate.is_some());
        self.run(&Squares::of(legs_squared), Roots::All, Some(expected), Effort::Homotopies, workspace, assembly);
    }

    /// Searches for self-motions, if there are known to be infinitely many poses.
    pub fn find_self_motion(
        &self,
        legs_squared: &[Rational; 6],
        workspace: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) {
        workspace.found.retain(|found| found.certificate.is_some());
        self.run(&Squares::of(legs_squared), Roots::All, None, Effort::Homotopies, workspace, assembly);
    }

    /// Returns the poses on the curve through a real pose with legs of these squared lengths, as quaternion and position, in their order; none
    /// where the legs are others.
    #[must_use]
    pub fn curve_through(&self, legs_squared: &[Rational; 6], pose: &Motion<f64>) -> Vec<[f64; 7]> {
        let numbers = self.frame.with_legs(&Squares::of(legs_squared));
        let points = curve(&numbers.legs, &self.frame.study(pose));
        points.iter().map(|point| self.pose(point)).collect()
    }

    /// Replaces the unproved solutions of the list solved last in this workspace by multiple poses that are known exactly.
    /// Returns `false`, with nothing changed, if their values are not computed to the last digit.
    pub fn add_exact(
        &self,
        poses: &[ExactPoses],
        workspace: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) -> bool {
        let Some(exact) = poses.iter().map(|poses| exact_modes(poses, &self.frame)).collect::<Option<Vec<_>>>() else {
            return false;
        };
        workspace.found.retain(|found| found.certificate.is_some());
        // A singular pose cannot be one of those proved before; a regular one may be.
        for pose in exact.into_iter().flatten() {
            take_in(&mut workspace.found, pose);
        }
        self.list(workspace, assembly);
        true
    }

    /// Drops the solutions of the last list that are not proved, or not proved to differ from all others.
    pub fn keep_proved(&self, workspace: &mut PlatformWorkspace, assembly: &mut PlatformAssembly) {
        let mut proved = std::mem::take(&mut workspace.found);
        proved.retain(|found| found.certificate.is_some());
        let radius = |found: &Found| found.certificate.map_or(f64::INFINITY, |c| c.radius);
        proved.sort_by(|a, b| radius(a).total_cmp(&radius(b)));
        for found in proved {
            take_in(&mut workspace.found, found);
        }
        self.list(workspace, assembly);
    }

    /// Finds the poses of a platform whose base and moving platform are affine images of the same points. Returns whether
    /// these are all; `None` for other platforms.
    fn by_algebra(&self, given: &Squares, search: &mut Search) -> Option<bool> {
        let (Some((platform, poses)), Some(squares)) = (&self.affine, &given.exact) else { return None };
        let starts = affine_starts(platform, squares, &self.frame);
        search.begin(DIMENSION - poses);
        for (index, start) in starts.iter().enumerate() {
            search.arrive(&start.map(narrowed), index);
        }
        search.found.retain(|found| found.certificate.is_some());
        if search.roots == Roots::Real {
            return Some(search.lost == 0);
        }
        if search.poses() < *poses {
            let legs = self.frame.long_legs::<LongFloat>(squares);
            for start in &starts {
                search.far_away(&legs, start);
            }
        }
        Some(search.poses() == *poses)
    }

    /// Quaternion and position of a real point.
    fn pose(&self, study: &Eight<f64>) -> [f64; 7] {
        let length = study[..4].iter().map(|x| x * x).sum::<f64>().sqrt();
        let position = self.frame.position(study);
        std::array::from_fn(|k| if k < 4 { study[k] / length } else { position[k - 4] })
    }

    fn list(&self, workspace: &PlatformWorkspace, assembly: &mut PlatformAssembly) {
        assembly.modes.clear();
        tell(&workspace.found, &self.frame, assembly);
        if let Some(reflection) = &self.reflection {
            reflection.mark(&mut assembly.modes);
        }
    }

    fn run(
        &self,
        given: &Squares,
        roots: Roots,
        expected: Option<usize>,
        effort: Effort,
        workspace: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) {
        assembly.modes.clear();
        assembly.route = Route::None;
        assembly.lost_rank = None;
        assembly.rank = self.charts[0].directions.rank;
        assembly.self_motion = 0;
        assembly.motion.clear();
        (assembly.by_high_precision, assembly.high_precision_bits) = (0, 0);
        let numbers = self.frame.with_legs(given);
        let squares = numbers.legs.each_ref().map(|leg| leg.square);
        let PlatformWorkspace { basis, spectrum, found, general } = workspace;
        let mut search = Search::going_on(&numbers, roots, expected, found);
        search.most = self.incidence.map(|(most, _)| most);
        if let Some(triangle) = &self.triangle
            && triangle.solve(&self.frame.platform, &squares, &mut search)
            && search.is_done()
        {
            assembly.route = Route::Triangle { at_base: triangle.at_base() };
        }
        if assembly.route == Route::None
            && effort != Effort::Homotopies
            && let Some(has_all) = self.by_algebra(given, &mut search)
            && (has_all || effort == Effort::Algebra)
        {
            assembly.route = Route::Affine;
        }
        for chart in &self.charts {
            if assembly.route != Route::None && (search.is_done() || assembly.route == Route::Affine) {
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
                let begin = LegNumbers::of_floats(begin);
                let mut first = Search::new(&begin, Roots::All, None, general);
                runs += 1;
                if by_border_basis(&Chart::new(&start, 0), &squares, basis, spectrum, &mut first).is_ok() {
                    let bend = Complex::from_polar(1.0, BENDS[(runs - 1) % BENDS.len()]);
                    by_homotopy(
                        &Homotopy { target: &numbers.legs, start: &begin.legs, bend },
                        first.found,
                        &mut search,
                    );
                }
                unchanged = if search.found.len() == before { unchanged + 1 } else { 0 };
            }
            assembly.route = Route::Homotopy { runs };
            if let Some((dimension, point)) = search.self_motion() {
                assembly.self_motion = dimension;
                let points = if dimension == 1 {
                    curve(search.legs, &point)
                } else {
                    Vec::from_iter(project(search.legs, &point))
                };
                assembly.motion = points.iter().map(|point| self.pose(point)).collect();
            }
        }
        assembly.null = search.null;
        assembly.unresolved = search.unresolved();
        tell(search.found, &self.frame, assembly);
        if let Some(reflection) = &self.reflection {
            reflection.mark(&mut assembly.modes);
        }
    }
}

/// Angles by which the arcs of successive homotopies are bent; none is near 0 or pi, where an arc is straight or far away.
const BENDS: [f64; 8] = [0.73, -1.31, 1.87, -0.52, 1.13, -2.05, 0.41, -0.94];

/// Follows all eigenvalues of a border basis. Returns the number of unknowns beside the rotation, or the degree in which
/// the basis lost rank.
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

/// Carries all solutions of a general platform to the requested one.
fn by_homotopy(homotopy: &Homotopy, general: &[Found], search: &mut Search) {
    search.begin(0);
    for (index, found) in general.iter().enumerate() {
        let conjugate = (!found.real).then(|| found.study.map(|z| z.conj()));
        for (side, start) in [Some(found.study), conjugate].into_iter().flatten().enumerate() {
            match homotopy.carry(&start) {
                // Solutions on a curve are not listed, but a real one may pass near.
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
