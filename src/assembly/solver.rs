//! A geometry prepared once for many poses.

use super::all_list::AllList;
use super::axis_triples::{AxisTriple, decoupled};
use super::closed_form::Rounded;
use super::high_precision::solve_in_high_precision;
use super::lane_list::{LaneList, LaneWorkspace};
use super::limits;
use super::mode::{Assembly, Mode, Roots, wrapped};
use super::platform::{PlatformAssembly, PlatformWorkspace};
use super::prepared::PreparedCut;
use super::search::{AS_IT_IS, Effort, Search};
use super::shifted::Shifted;
use crate::algebra::double_double::DoubleDouble;
use crate::certify::certificate_in_any_frame;
use crate::closure::half_angle::half_angle_form;
use crate::elimination::coordinate_ring::Plan;
use crate::elimination::cut::{Cut, Hidden};
use crate::elimination::kind::Elimination;
use crate::elimination::pencil::{before_second_link, bilinear};
use crate::kinematics::closed_loop::{ClosedLoop, OpenLoop, Variable};
use crate::kinematics::motion::{Motion, unit_near};
use crate::kinematics::tolerance::Tolerance;
use crate::solve::decoupled::Decoupled;
use crate::solve::eigen::{EigenWorkspace, companion};
use crate::solve::newton::{Six, product};
use crate::solve::scalar::Extended;
use crate::solve::singular::structural_rank;
use num_complex::Complex;
use std::sync::OnceLock;

/// A prepared geometry, which solves many poses.
///
/// # Example
/// ```
/// use looproot_engine::assembly::{Assembly, Roots, Solver, Workspace};
/// use looproot_engine::kinematics::{closed_loop::{OpenLoop, Variable}, motion::Motion};
/// // Six axes, each link turned and shifted against the last.
/// let link = |k: usize| {
///     let k = k as f64;
///     let mut m = Motion::rotation_x((1.0 + k).cos(), (1.0 + k).sin());
///     m.translation = [0.3 + 0.1 * k, 0.2, 0.4 - 0.1 * k];
///     m
/// };
/// let open = OpenLoop {
///     variables: [Variable::Rotation; 6],
///     constants: std::array::from_fn(link),
///     before_gap: Motion::identity(),
///     after_gap: Motion::identity(),
/// };
/// let solver = Solver::prepare(&open);
/// let mut assembly = Assembly::default();
/// solver.solve(&link(7), Roots::All, &mut Workspace::default(), &mut assembly);
/// assert_eq!(assembly.total(), 16);
/// ```
pub struct Solver {
    open: OpenLoop<f64>,
    /// Lengths inside the solver are lengths of the mechanism over this power of two.
    scale: f64,
    /// The cuts that are independent of the pose, best first.
    prepared: Vec<PreparedCut>,
    structural_rank: usize,
    axis_triples: Vec<AxisTriple>,
    /// The part of the loop that a closed form solves, if there is one.
    decoupled: Option<Decoupled>,
    /// Index of the first of the three rotations of a spherical joint, if there is one.
    spherical: Option<usize>,
    /// The cuts and hidden angles in which real solutions are looked for by zeros, those first in which they are apart as a rule.
    zero_order: OnceLock<Vec<(usize, Hidden)>>,
    /// The same side by side.
    lanes: OnceLock<LaneList>,
    /// The cut and hidden angle in which all solutions are looked for side by side, if there is one.
    all_list: OnceLock<Option<AllList>>,
}

/// The closing transformation at a pose or input: the constant behind the last unknown, in the scale of its solver.
#[derive(Clone, Debug)]
pub struct Gap {
    last: Motion<f64>,
    /// Bound of the row-sum norm of its error beyond one rounding.
    rounding: f64,
    is_rough: bool,
}

/// For what a list of real solutions is to be proved beside the pose or input itself.
#[derive(Clone, Copy, Debug)]
pub enum Margin {
    /// Every pose within a tolerance has as many solutions, so that nothing else is near.
    Tolerance(Tolerance),
    /// The pose itself, where the determinant is not nearer to a double zero than by so much in parts of its largest value.
    Blur(f64),
}

/// Values of six unknowns without any property.
const ANY_PLACE: [f64; 6] = [0.7, -1.1, 1.9, 0.4, -2.3, 1.3];
/// Places at which ways to find real solutions are compared: with one, the first way fails at 8 poses of general arms in a hundred, with
/// so many at 6.
const PLACES: usize = 5;
/// Number of configurations that may share a hidden angle, with which a further one would not go unnoticed: see [`Solver::stay_alone`].
const MOST_SHARED: usize = 3;
/// Roundings of the difference of two angles, at most.
const ROUNDING: f64 = 1e-14;
/// Places at which the way to all solutions is tried: at one of them f64 leaves too much unproved for 2 arms in a hundred.
const PLACES_OF_ALL: usize = 2;
/// Rounding errors, in units u, of the rotation of a closing transformation, by rows. It is a product of three rotations,
/// each rounded once. An entry of the first product is off by 5 u, one of the second by 5 sqrt(3) u and 4 u of its own.
const GAP_TURN: f64 = 40.0;
/// Rounding errors of the translation of a closing transformation, relative to the lengths that are added up. They are
/// those of an entry, with the rotation of the first end in front.
const GAP_SHIFT: f64 = 16.0;

impl Gap {
    /// Returns whether digits were lost that exact arithmetic would keep, as with a distant base or tool.
    #[must_use]
    pub fn is_rough(&self) -> bool {
        self.is_rough
    }
}

/// The first imaginary part that is not 0, if there is one.
fn first_part(unknowns: &Six<Complex<f64>>) -> f64 {
    unknowns.iter().map(|z| z.im).find(|x| *x != 0.0).unwrap_or(0.0)
}

fn length(motion: &Motion<f64>) -> f64 {
    let square: f64 = motion.translation.iter().map(|x| x * x).sum();
    // The squares of lengths beyond 1e154 are infinite, they themselves are not.
    if square.is_finite() { square.sqrt() } else { motion.translation.iter().fold(0.0, |sum: f64, x| sum.hypot(*x)) }
}

/// Memory reused from pose to pose: one per thread.
#[derive(Default)]
pub struct Workspace {
    eigen: EigenWorkspace,
    lanes: LaneWorkspace,
    /// The workspace of platforms.
    pub platform: PlatformWorkspace,
    /// The last result for a platform.
    pub platform_assembly: PlatformAssembly,
    /// Whether a list counts as complete once its real solutions are, though complex ones may be missing.
    pub only_real_list: bool,
    /// Whether real solutions are looked for side by side first, and complex ones only where these are not proved to be all.
    pub real_first: bool,
    /// Whether clustered solutions are listed without a proof of completeness if the numbers lie in a number field, where
    /// that proof takes seconds.
    pub leaves_fields: bool,
    /// Whether solutions are listed as f64 finds them, without a proof of completeness.
    pub only_lists: bool,
}

impl Workspace {
    /// Memory of the eigenvalue routines.
    pub(super) fn eigen(&mut self) -> &mut EigenWorkspace {
        &mut self.eigen
    }
}

impl Solver {
    /// Prepares the parts of a geometry that do not depend on the pose, and the order of its cuts.
    #[must_use]
    pub fn prepare(open: &OpenLoop<f64>) -> Self {
        let square = |m: &Motion<f64>| length(m).powi(2);
        // The unit is the mean link length, without the distance of a base or a tool. For an arm without lengths it is that of
        // its ends, else 1. It is a power of two, so that scaling is exact.
        let links = open.constants.iter().map(square).sum::<f64>() / 5.0;
        let mean = if links > 0.0 { links } else { square(&open.before_gap) + square(&open.after_gap) };
        let scale = unit_near(mean.sqrt());
        let open = open.over(scale);
        let closed = open.close(&Motion::identity());
        let mut prepared: Vec<PreparedCut> = Cut::ALL[..Cut::PREPARED]
            .iter()
            .filter(|cut| cut.fits(open.variables))
            .filter_map(|&cut| {
                let view = cut.of(&closed);
                let form = half_angle_form(&view)?;
                // The closing transformation is constant 6 of the original loop.
                let free = cut.constant_index(1) != 5;
                let second = free.then_some(&view.constants[1]);
                (form.score > limits::SCORE).then(|| PreparedCut::new(cut, form, second))
            })
            .collect();
        prepared.sort_by(|a, b| b.form.score.total_cmp(&a.form.score));
        let structural_rank = structural_rank(&closed);
        let axis_triples = AxisTriple::all(&open);
        let decoupled = decoupled(&open);
        let (zero_order, lanes, all_list) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
        Self {
            open,
            scale,
            prepared,
            structural_rank,
            axis_triples,
            decoupled,
            spherical: None,
            zero_order,
            lanes,
            all_list,
        }
    }

    /// As [`Solver::prepare`] for a loop with a spherical joint, whose three rotations begin at this unknown.
    #[must_use]
    pub fn with_spherical_joint(open: &OpenLoop<f64>, spherical: usize) -> Self {
        Self { spherical: Some(spherical), decoupled: None, prepared: Vec::new(), ..Self::prepare(open) }
    }

    /// Returns the power of two that is the unit of lengths inside the solver.
    #[must_use]
    pub fn unit(&self) -> f64 {
        self.scale
    }

    /// Returns the largest rank the six joints reach in general position. Below 6 the arm is structurally deficient, and
    /// every solution is part of a self-motion.
    #[must_use]
    pub fn structural_rank(&self) -> usize {
        self.structural_rank
    }

    /// Returns the triples of neighbouring axes that are parallel or meet in a point.
    #[must_use]
    pub fn axis_triples(&self) -> &[AxisTriple] {
        &self.axis_triples
    }

    /// Returns whether a closed form finds the solutions: three neighbouring axes meet in a point or are parallel.
    #[must_use]
    pub fn is_decoupled(&self) -> bool {
        self.decoupled.is_some()
    }

    /// Returns whether some cut loses equations: the geometry is special, and may have fewer than 16 solutions.
    #[must_use]
    pub fn is_special(&self) -> bool {
        let fitting = Cut::ALL[..Cut::PREPARED].iter().filter(|cut| cut.fits(self.open.variables)).count();
        self.prepared.len() < fitting || fitting == 0
    }

    /// Returns whether the loop has fewer than three rotations: its links move in parallel planes or only translate.
    #[must_use]
    pub fn is_out_of_reach(&self) -> bool {
        self.elimination() == Elimination::Planar
    }

    /// Returns the degree of the closure polynomial of general loops with these unknowns, 0 if [`Self::is_out_of_reach`].
    #[must_use]
    pub fn general_degree(&self) -> usize {
        self.elimination().degree(self.open.variables).unwrap_or(0)
    }

    fn elimination(&self) -> Elimination {
        Elimination::of(self.open.variables, self.spherical)
    }

    /// Returns the distance to be closed and the total length of the links, in the unit of the mechanism, if the former is
    /// larger, so that no real solution can close the loop.
    #[must_use]
    pub fn too_far(&self, gap: &Gap) -> Option<(f64, f64)> {
        if self.open.variables.contains(&Variable::Translation) {
            return None;
        }
        let width = length(&gap.last);
        let links: f64 = self.open.constants.iter().map(length).sum();
        // At best every link points along the distance; the margin allows for rounding.
        (width > links * (1.0 + 1e-12) + gap.rounding).then_some((width * self.scale, links * self.scale))
    }

    /// Returns the closing constant: this motion between the two ends of the open loop.
    #[must_use]
    pub fn gap(&self, closing: &Motion<f64>) -> Gap {
        let closing = closing.over(self.scale);
        let ends = length(&self.open.before_gap) + length(&closing) + length(&self.open.after_gap);
        let last = self.open.before_gap.then_after(&closing).then_after(&self.open.after_gap);
        let rounding = 0.5 * f64::EPSILON * (GAP_TURN + GAP_SHIFT * ends);
        // If the ends are much longer than their difference, digits are lost.
        Gap { rounding, is_rough: ends > 8.0 * (1.0 + length(&last)), last }
    }

    /// Takes a closing constant (behind the last unknown) that was computed exactly and rounded once.
    #[must_use]
    pub fn exact_gap(&self, last: &Motion<f64>) -> Gap {
        Gap { last: last.over(self.scale), rounding: 0.0, is_rough: false }
    }

    /// Returns the loop with this closing constant, and the power of two that is the unit of its lengths.
    #[must_use]
    pub fn closed(&self, gap: &Gap) -> (ClosedLoop<f64>, f64) {
        (self.close(gap), self.scale)
    }

    /// Returns the scaled loop with this closing constant.
    fn close(&self, gap: &Gap) -> ClosedLoop<f64> {
        let constants = std::array::from_fn(|j| if j < 5 { self.open.constants[j].clone() } else { gap.last.clone() });
        ClosedLoop { variables: self.open.variables, constants }
    }

    /// Returns the 16 x 16 matrix whose eigenvalues the first pencil of this pose needs; `None` if that pencil is singular.
    #[must_use]
    pub fn companion(&self, closing: &Motion<f64>) -> Option<[[f64; 16]; 16]> {
        let prepared = self.prepared.first()?;
        let cut = prepared.cut.of(&self.close(&self.gap(closing)));
        let rows = prepared.rows.unwrap_or_else(|| before_second_link(&prepared.form, &cut.constants[1]));
        let shifted = Shifted::best(&bilinear(&rows, &cut), Hidden::First);
        let (constant, linear) = shifted.monic()?;
        Some(companion(&constant, &linear))
    }

    /// Finds the solutions at one pose or input, given as the closing transformation of the loop. Allocates nothing once
    /// `assembly` has grown to its size, except for degenerate poses.
    pub fn solve(&self, closing: &Motion<f64>, roots: Roots, workspace: &mut Workspace, assembly: &mut Assembly) {
        self.solve_up_to(&self.gap(closing), roots, &|_| usize::MAX, workspace, assembly);
    }

    /// As [`Solver::solve`], for a geometry known to have at most `most(n)` solutions, at which the search stops; whether there
    /// are more than n is what is asked. `most` is called only if fewer than 16 are found.
    pub fn solve_up_to(
        &self,
        gap: &Gap,
        roots: Roots,
        most: &dyn Fn(usize) -> usize,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) {
        self.search(gap, roots, Effort::All(most), workspace, assembly);
    }

    /// As [`Solver::solve_up_to`] for all roots, by the closed form alone. Returns whether as many solutions are proved as the geometry is
    /// known to have at most; otherwise nothing is listed. `exact` is asked where candidates are too near to each other for stored
    /// constants.
    pub fn solve_in_closed_form(
        &self,
        gap: &Gap,
        most: &dyn Fn(usize) -> usize,
        exact: Rounded<'_>,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> bool {
        assembly.clear();
        let unit = 1.0 / self.scale;
        let double = || (exact.double)().map(|exact| exact.in_unit(&unit.into()));
        let crowded = || (exact.crowded)().map(|exact| exact.in_unit(&unit.into()));
        let closed = self.close(gap);
        let mut search = self.searched(gap, &closed, Roots::All, Effort::OnePencil, workspace, assembly);
        let is_proved = search.by_closed_form(most, Rounded { double: &double, crowded: &crowded });
        self.finish(assembly);
        is_proved
    }

    /// As [`Solver::solve_up_to`] for all roots, by the pencils alone: no closed form is used, unresolved roots are not searched for, and
    /// modes without certificate are left undecided.
    pub fn solve_by_pencils(
        &self,
        gap: &Gap,
        most: &dyn Fn(usize) -> usize,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) {
        self.search(gap, Roots::All, Effort::Pencils(most), workspace, assembly);
    }

    /// Finds the solutions of one pencil alone, which are most of those that f64 can distinguish. Modes without certificate
    /// are left undecided.
    pub fn solve_briefly(&self, gap: &Gap, workspace: &mut Workspace, assembly: &mut Assembly) {
        self.search(gap, Roots::All, Effort::OnePencil, workspace, assembly);
    }

    /// Finds the real solutions at one pose or input by the zeros of a determinant on the circle of a hidden angle, and returns
    /// whether they are proved to be all: as many solutions are certified as the determinant has zeros, each of them simple. `exact`
    /// gives the loop rounded once from the exact data and closed by the identity. It is asked once per geometry.
    pub fn solve_real(
        &self,
        gap: &Gap,
        exact: &dyn Fn() -> Option<ClosedLoop<DoubleDouble>>,
        margin: Margin,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> bool {
        self.solve_real_quickly(gap, exact, margin, workspace, assembly)
            || self.solve_real_closely(gap, exact, margin, workspace, assembly)
    }

    /// As [`Solver::solve_real`] for loops of rotations, all solutions side by side, with bounds of errors that are cheap and so not the least.
    /// Allocates nothing once `assembly` has grown to its size.
    pub fn solve_real_quickly(
        &self,
        gap: &Gap,
        exact: &dyn Fn() -> Option<ClosedLoop<DoubleDouble>>,
        margin: Margin,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> bool {
        assembly.clear();
        if self.structural_rank < 6 || self.spherical.is_some() {
            return false;
        }
        let unit = DoubleDouble::from(1.0 / self.scale);
        let exact = || exact().map(|exact| exact.in_unit(&unit));
        let places = || -> Vec<ClosedLoop<f64>> { (0..PLACES).map(|turns| self.at_any_place(turns)).collect() };
        let lanes = self.lanes.get_or_init(|| LaneList::new(&self.prepared, &exact, &places()));
        let [off, blur] = self.margins(gap, margin);
        let is_proved = lanes.solve(&self.close(gap), [off, blur, gap.rounding], &mut workspace.lanes, assembly);
        self.finish(assembly);
        is_proved
    }

    /// As [`Solver::solve_real`], one solution after the other, with a bound for the error of every number.
    pub fn solve_real_closely(
        &self,
        gap: &Gap,
        exact: &dyn Fn() -> Option<ClosedLoop<DoubleDouble>>,
        margin: Margin,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> bool {
        assembly.clear();
        if self.structural_rank < 6 || self.spherical.is_some() {
            return false;
        }
        let closed = self.close(gap);
        let unit = DoubleDouble::from(1.0 / self.scale);
        let exact = || exact().map(|exact| exact.in_unit(&unit));
        let order = self.zero_order.get_or_init(|| self.zero_order(&exact));
        let mut search = self.searched(gap, &closed, Roots::Real, Effort::OnePencil, workspace, assembly);
        let is_proved = search.by_zeros(order, self.margins(gap, margin), &exact);
        self.finish(assembly);
        is_proved
    }

    /// Returns the lengths of the links beside the gap, in units of the loop: a turn of the pose shifts the loop by no more than its angle
    /// times these.
    pub fn lever(&self, gap: &Gap) -> f64 {
        [&self.open.before_gap, &self.open.after_gap, &gap.last].map(length).iter().sum()
    }

    /// Returns a bound of what the closing transformation is off beyond a few roundings, and the part of the largest value of the
    /// determinant below which zeros count as double.
    fn margins(&self, gap: &Gap, margin: Margin) -> [f64; 2] {
        match margin {
            // A turn by a small angle changes a row of a rotation by less than twice that angle, and a translation by the angle times
            // the length that is turned: one end, and the translation itself.
            Margin::Tolerance(Tolerance { length: shift, angle }) => {
                [gap.rounding + 1.01 * (shift / self.scale + 2.0 * angle * (1.0 + 2.0 * self.lever(gap))), 0.0]
            }
            Margin::Blur(blur) => [gap.rounding, blur],
        }
    }

    /// Returns whether each of these complex solutions is proved to stay one, complex and regular, at every pose within the tolerance.
    ///
    /// Where they are as many as the geometry has at any pose, none of these poses has a real solution: at a pose near it that is general,
    /// the configurations beside a real one would be solutions beyond their number.
    #[must_use]
    pub fn stay_complex(&self, gap: &Gap, tolerance: Tolerance, modes: &[Mode]) -> bool {
        let closed = self.close(gap);
        let [off, _] = self.margins(gap, Margin::Tolerance(tolerance));
        let unit = |variable: Variable| if variable == Variable::Translation { self.scale } else { 1.0 };
        // A solution and its conjugate are proved alike.
        modes.iter().filter(|mode| first_part(&mode.unknowns) >= 0.0).all(|mode| {
            let own: Six<Complex<f64>> = std::array::from_fn(|k| mode.unknowns[k] / unit(closed.variables[k]));
            let farthest = own.iter().map(|z| z.im.abs()).fold(0.0, f64::max);
            let proof = certificate_in_any_frame(&closed, &own, off);
            !mode.real && proof.is_some_and(|proof| proof.radius < farthest)
        })
    }

    /// Returns whether it is proved that at every pose within the tolerance the real solutions are these, each moved a little, and no others.
    ///
    /// Each is alone in a ball at all of these poses. Let the determinant of a hidden angle have at most as many zeros as there are balls,
    /// with multiplicity. At a zero the kernel holds `(1, z, z^2, z^3) x (1, x)` of every configuration there, z and x being half-tangents of
    /// two other angles, from which the rest follows, and the multiplicity is its dimension at least. Vectors of up to four configurations are
    /// independent if no more than two of them have one z: a product of up to three factors in z, or two and one in x, is zero at all others
    /// and not at one. So where balls share the hidden angle, three at most and apart in z, a further configuration would need one zero more.
    #[must_use]
    pub fn stay_alone(
        &self,
        gap: &Gap,
        exact: &dyn Fn() -> Option<ClosedLoop<DoubleDouble>>,
        tolerance: Tolerance,
        modes: &[Mode],
    ) -> bool {
        let closed = self.close(gap);
        let [off, _] = self.margins(gap, Margin::Tolerance(tolerance));
        let scale = |variable: Variable| if variable == Variable::Translation { self.scale } else { 1.0 };
        let radius = |mode: &Mode| {
            let own: Six<f64> = std::array::from_fn(|k| mode.unknowns[k].re / scale(closed.variables[k]));
            certificate_in_any_frame(&closed, &own, off).map(|proof| proof.radius)
        };
        let Some(radii) = modes.iter().map(radius).collect::<Option<Vec<f64>>>() else { return false };
        let unit = DoubleDouble::from(1.0 / self.scale);
        let exact = || exact().map(|exact| exact.in_unit(&unit));
        let order = self.zero_order.get_or_init(|| self.zero_order(&exact));
        order.iter().any(|&(k, hidden)| {
            let prepared = &self.prepared[k];
            let places = if hidden == Hidden::First { [0, 1] } else { [1, 0] };
            let [angles, others] = places.map(|place| -> Vec<f64> {
                let index = prepared.cut.unknown_index(place);
                let sign = if prepared.cut.reversed { -1.0 } else { 1.0 };
                modes.iter().map(|mode| sign * mode.unknowns[index].re).collect()
            });
            let are_apart = |angles: &[f64], i: usize, j: usize| {
                wrapped(angles[i] - angles[j]).abs() > radii[i] + radii[j] + ROUNDING
            };
            let beside = |i: usize| (0..modes.len()).filter(move |&j| j != i);
            let is_clear = |i: usize| {
                let shared = || beside(i).filter(|&j| !are_apart(&angles, i, j));
                shared().count() < MOST_SHARED && shared().all(|j| are_apart(&others, i, j))
            };
            (0..modes.len()).all(is_clear)
                && prepared
                    .enclosed(&exact)
                    .is_some_and(|rows| rows.equations(&closed, off).has_no_more_zeros(hidden, &angles))
        })
    }

    /// Returns the loop closed at a place without any property, of which there are six.
    fn at_any_place(&self, turns: usize) -> ClosedLoop<f64> {
        let mut closed = self.close(&self.gap(&Motion::identity()));
        closed.constants[5] = Motion::identity();
        let mut place = ANY_PLACE;
        place.rotate_left(turns);
        closed.constants[5] = product(&closed, &place.map(|x| (x.cos(), x.sin())), 6).inverse();
        closed
    }

    /// Returns the cuts and hidden angles, those first that tell the zeros apart at a pose without any property: where a geometry is
    /// special, solutions share some of the angles at every pose.
    fn zero_order(&self, exact: &dyn Fn() -> Option<ClosedLoop<DoubleDouble>>) -> Vec<(usize, Hidden)> {
        let closed = self.at_any_place(0);
        let mut order: Vec<(bool, usize, Hidden)> = Vec::new();
        for (k, prepared) in self.prepared.iter().enumerate() {
            let Some(rows) = prepared.enclosed(exact) else { continue };
            let equations = rows.equations(&closed, 0.0);
            order.extend(
                [Hidden::First, Hidden::Second].map(|hidden| (equations.zeros(hidden, 0.0).is_none(), k, hidden)),
            );
        }
        order.sort_by_key(|(fails, ..)| *fails);
        order.into_iter().map(|(_, k, hidden)| (k, hidden)).collect()
    }

    /// Returns the way to all solutions side by side, if there is one and no closed form is faster.
    pub(super) fn all_list(&self) -> Option<&AllList> {
        // Pages in a browser ask for real solutions first, and are smaller without it.
        let is_left_out = cfg!(target_arch = "wasm32");
        if is_left_out || self.structural_rank < 6 || self.spherical.is_some() || self.decoupled.is_some() {
            return None;
        }
        let places = || -> Vec<ClosedLoop<f64>> { (0..PLACES_OF_ALL).map(|turns| self.at_any_place(turns)).collect() };
        self.all_list.get_or_init(|| AllList::new(&self.prepared, &places())).as_ref()
    }

    /// Leaves all solutions to the pencils, for comparison.
    #[cfg(test)]
    pub(super) fn by_pencils_alone(self) -> Self {
        Self { all_list: OnceLock::from(None), ..self }
    }

    /// Finds solutions with the given effort.
    fn search(&self, gap: &Gap, roots: Roots, effort: Effort<'_>, workspace: &mut Workspace, assembly: &mut Assembly) {
        assembly.clear();
        let closed = self.close(gap);
        self.searched(gap, &closed, roots, effort, workspace, assembly).run();
        self.finish(assembly);
    }

    /// Returns a search that has not begun.
    pub(super) fn searched<'a>(
        &'a self,
        gap: &Gap,
        closed: &'a ClosedLoop<f64>,
        roots: Roots,
        effort: Effort<'a>,
        workspace: &'a mut Workspace,
        assembly: &'a mut Assembly,
    ) -> Search<'a> {
        let all_list = if roots == Roots::All { self.all_list() } else { None };
        Search {
            prepared: &self.prepared,
            closed,
            spherical: self.spherical,
            decoupled: self.decoupled,
            all_list: all_list.map(|list| (list, &mut workspace.lanes)),
            arrangement: AS_IT_IS,
            is_deficient: self.structural_rank < 6,
            gap_rounding: gap.rounding,
            roots,
            effort,
            eigen: &mut workspace.eigen,
            assembly,
        }
    }

    /// Searches for the missing solutions of a list in multiprecision. `exact` is the same closed loop from exact data,
    /// `plan` the plan of its coordinate ring, if it is known, `expected` the number of its solutions, and `most_tries` that of closure
    /// polynomials which are tried.
    pub fn solve_in_high_precision<R: Extended>(
        &self,
        exact: &ClosedLoop<R>,
        plan: Option<&Plan>,
        expected: usize,
        most_tries: usize,
        assembly: &mut Assembly,
    ) {
        let scaled = exact.in_unit(&R::from(1.0 / self.scale));
        self.scale_lengths(assembly, 1.0 / self.scale, 1.0 / self.scale.max(1.0));
        let modes = solve_in_high_precision(&scaled, self.spherical, plan, expected, most_tries);
        assembly.complete_with(modes, &self.open.variables, expected, R::BITS);
        self.finish(assembly);
    }

    /// Converts translations to another unit. A radius bounds the errors of angles and translations alike, so it is
    /// multiplied by `grown`.
    fn scale_lengths(&self, assembly: &mut Assembly, factor: f64, grown: f64) {
        if !self.open.variables.contains(&Variable::Translation) {
            return;
        }
        for mode in &mut assembly.modes {
            for (value, variable) in mode.unknowns.iter_mut().zip(self.open.variables) {
                if variable == Variable::Translation {
                    *value *= factor;
                }
            }
            if let Some(proof) = &mut mode.certificate {
                (proof.radius, proof.proved) = (proof.radius * grown, proof.proved * grown);
            }
        }
        for point in assembly.families.iter_mut().flat_map(|family| &mut family.points) {
            for (value, variable) in point.iter_mut().zip(self.open.variables) {
                if variable == Variable::Translation {
                    *value *= factor;
                }
            }
        }
    }

    /// Sorts the modes and converts them to the unit of the mechanism.
    pub(super) fn finish(&self, assembly: &mut Assembly) {
        assembly.modes.sort_by(|a, b| {
            b.real.cmp(&a.real).then_with(|| {
                let key = |m: &Mode| m.unknowns.map(|z| (z.re, z.im));
                key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal)
            })
        });
        self.scale_lengths(assembly, self.scale, self.scale.max(1.0));
    }
}
