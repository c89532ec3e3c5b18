//! The search for the solutions of one pose: cut after cut, root after root, until nothing is missing.

use super::all_list::AllList;
use super::closed_form::{Rounded, STORED};
use super::lane_finish::Finish;
use super::lane_list::LaneWorkspace;
use super::limits;
use super::mode::{Assembly, Hits, Mode, Roots, are_all_apart, distance, wrapped};
use super::prepared::PreparedCut;
use super::proof::certificate_in_reach;
use super::shifted::Shifted;
use super::side_by_side::{self, SideBySide};
use super::spherical::canonical;
use crate::certify::{Refined, certificate, certificate_in_any_frame, refined_certificate_of};
use crate::closure::half_angle::{HalfAngleForm, half_angle_form};
use crate::closure::woernle_lee::MarkedLine;
use crate::elimination::cut::{Cut, Hidden};
use crate::elimination::kind::Elimination;
use crate::elimination::pencil::{before_second_link, bilinear};
use crate::elimination::rearranged::rearranged;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::solve::back_substitution::CutView;
use crate::solve::curve::CLOSES_WITHIN;
use crate::solve::decoupled::Decoupled;
use crate::solve::dense;
use crate::solve::eigen::{EigenWorkspace, Method};
use crate::solve::kernel::{SHARED, at_root, kernel};
use crate::solve::newton::{Polished, Six, approach, approach_singular, closure, polish, reach};
use crate::solve::scalar::Scalar;
use crate::solve::self_motion::{SelfMotion, self_motions};
use crate::solve::separated::unshifted;
use crate::solve::singular::{Nature, nature, pair, spread};
use num_complex::Complex;
use pulp::Arch;
use std::cell::LazyCell;

/// A cut, the loop in the order of the cut, and its elimination.
type Ready = (Cut, ClosedLoop<f64>, HalfAngleForm<f64>);

/// The arrangement that leaves every unknown in its place.
pub(super) const AS_IT_IS: ([usize; 6], bool) = ([0, 1, 2, 3, 4, 5], false);

/// The effort of a search.
#[derive(Clone, Copy)]
pub(super) enum Effort<'a> {
    /// One pencil. Unresolved roots are left undecided.
    OnePencil,
    /// Pencil after pencil, up to a number of solutions, with proofs of pairs that f64 hardly distinguishes. Unresolved roots
    /// are left undecided.
    Pencils(&'a dyn Fn(usize) -> usize),
    /// Pencils up to a number of solutions, multistart if they leave roots unresolved, and a decision on modes without certificate.
    All(&'a dyn Fn(usize) -> usize),
}

/// The search for the solutions of one pose.
pub(super) struct Search<'a> {
    /// The prepared cuts, best first.
    pub prepared: &'a [PreparedCut],
    /// The loop, scaled.
    pub closed: &'a ClosedLoop<f64>,
    /// Index of the first of the three rotations of a spherical joint, if there is one.
    pub spherical: Option<usize>,
    /// The part of the loop that a closed form solves, if there is one.
    pub decoupled: Option<Decoupled>,
    /// The way to all solutions side by side, if they are requested and there is one.
    pub all_list: Option<(&'a AllList, &'a mut LaneWorkspace)>,
    /// Whether the joints are dependent in every position.
    pub is_deficient: bool,
    /// Bound on the rounding error of the closing transformation.
    pub gap_rounding: f64,
    /// Index of every unknown of a cut in the loop, and whether the translation has the opposite sign there.
    pub arrangement: ([usize; 6], bool),
    /// The roots that are requested.
    pub roots: Roots,
    /// The effort of the search.
    pub effort: Effort<'a>,
    /// Scratch memory of the eigenvalue routines.
    pub eigen: &'a mut EigenWorkspace,
    /// The results.
    pub assembly: &'a mut Assembly,
}

impl Search<'_> {
    /// Finds all solutions.
    pub fn run(&mut self) {
        let most = match self.effort {
            Effort::OnePencil => &|_| usize::MAX,
            Effort::Pencils(most) | Effort::All(most) => most,
        };
        let is_asked = self.roots == Roots::All && matches!(self.effort, Effort::All(_));
        if is_asked && self.by_closed_form(most, Rounded::STORED) {
            return;
        }
        if self.by_all_zeros() {
            return;
        }
        match Elimination::of(self.closed.variables, self.spherical) {
            Elimination::Centre(spherical) => self.centre(spherical),
            Elimination::Triangle => self.triangle(),
            Elimination::FourBar => self.four_bars(most),
            Elimination::Cut | Elimination::Planar => self.all_cuts(most),
        }
        match self.effort {
            Effort::OnePencil => return,
            Effort::Pencils(_) => return self.resolve_pairs(),
            Effort::All(_) => {}
        }
        // The pencils of dependent joints vanish but for rounding, and their roots say nothing of the solutions.
        if !self.assembly.all_resolved || self.is_deficient {
            self.cast_about();
        }
        self.resolve_pairs();
        self.resolve_singular();
    }

    /// Solves one pencil after the other, the prepared ones first, until the search is done.
    fn all_cuts(&mut self, most: &dyn Fn(usize) -> usize) {
        if self.cuts_of_this(most) || !self.closed.variables.contains(&Variable::Translation) {
            return;
        }
        for moved in rearranged(self.closed, limits::ALONG) {
            self.arrangement = (moved.order, moved.flipped);
            let done = self.cuts_inside(&moved.closed, &Cut::ALL, most);
            self.arrangement = AS_IT_IS;
            if done {
                return;
            }
        }
    }

    /// Solves the cuts of the loop in its present arrangement. Returns whether the search is done.
    fn cuts_of_this(&mut self, most: &dyn Fn(usize) -> usize) -> bool {
        for prepared in self.prepared {
            let cut = prepared.cut.of(self.closed);
            let carried;
            let rows = if let Some(rows) = &prepared.rows {
                rows
            } else {
                carried = before_second_link(&prepared.form, &cut.constants[1]);
                &carried
            };
            if self.both_hidings(prepared.cut, &cut, &prepared.form, rows, most) {
                return true;
            }
        }
        let closed = self.closed;
        self.cuts_inside(closed, &Cut::ALL[Cut::PREPARED..], most)
    }

    /// Solves cuts whose elimination is not prepared, best first. Returns whether the search is done.
    fn cuts_inside(&mut self, closed: &ClosedLoop<f64>, cuts: &[Cut], most: &dyn Fn(usize) -> usize) -> bool {
        let ready = |cut: &Cut| {
            let view = cut.of(closed);
            let form = half_angle_form(&view).filter(|form| form.score > limits::SCORE)?;
            Some((*cut, view, form))
        };
        let fitting = |k: usize| cuts.get(k).filter(|cut| cut.fits(closed.variables));
        let rest: [Option<Ready>; 12] = std::array::from_fn(|k| fitting(k).and_then(ready));
        let score = |k: usize| rest[k].as_ref().map_or(0.0, |(_, _, form)| form.score);
        let mut order: [usize; 12] = std::array::from_fn(|k| k);
        order.sort_by(|&a, &b| score(b).total_cmp(&score(a)));
        order.iter().filter_map(|&k| rest[k].as_ref()).any(|(cut, view, form)| {
            let rows = before_second_link(form, &view.constants[1]);
            self.both_hidings(*cut, view, form, &rows, most)
        })
    }

    /// Solves a cut with each of its two angles hidden, the better one first, until the search is done.
    fn both_hidings(
        &mut self,
        cut: Cut,
        view: &ClosedLoop<f64>,
        form: &HalfAngleForm<f64>,
        rows: &[MarkedLine<f64>; 8],
        most: &dyn Fn(usize) -> usize,
    ) -> bool {
        let equations = bilinear(rows, view);
        let first = Shifted::best(&equations, Hidden::First);
        let order = if first.quality > limits::GOOD_LEADING {
            [Some(first), None]
        } else {
            let second = Shifted::best(&equations, Hidden::Second);
            if second.quality > first.quality { [Some(second), Some(first)] } else { [Some(first), Some(second)] }
        };
        for (index, shifted) in order.into_iter().enumerate() {
            let shifted = match shifted {
                Some(shifted) => shifted,
                None if index == 1 => Shifted::best(&equations, Hidden::Second),
                None => continue,
            };
            let all_resolved = self.one_pencil(cut, view, form, &shifted, most);
            self.assembly.all_resolved |= all_resolved;
            if self.done(most, all_resolved) {
                return true;
            }
        }
        false
    }

    /// Returns whether further pencils are of no use.
    pub fn done(&self, most: &dyn Fn(usize) -> usize, all_resolved: bool) -> bool {
        match self.roots {
            _ if matches!(self.effort, Effort::OnePencil) => true,
            Roots::Real => all_resolved,
            Roots::All => {
                let proved = self.proved();
                // Modes without a certificate are double as a rule; the verdict decides later.
                let likely = 2 * self.assembly.modes.len() - proved;
                let variables = self.closed.variables;
                let general = Elimination::of(variables, None).degree(variables).unwrap_or(0);
                proved >= general
                    || self.is_full(proved, most)
                    || (all_resolved && (likely >= general || likely >= most(likely)))
            }
        }
    }

    /// Returns whether as many solutions are proved as the loop can have; then the other roots are extraneous.
    ///
    /// The bound is computed only if a special geometry is likely: at half of the general number or a quarter of it.
    pub(super) fn is_full(&self, proved: usize, most: &dyn Fn(usize) -> usize) -> bool {
        self.roots == Roots::All && proved >= FEWEST_OF_SPECIAL && proved >= most(proved)
    }

    /// Returns the number of proved solutions.
    pub(super) fn proved(&self) -> usize {
        self.assembly.modes.iter().filter(|m| m.certificate.is_some()).count()
    }

    /// Solves one pencil and admits the solutions of its roots. Returns whether the pencil was regular and every root
    /// resolved, which means that it led to solutions or to infinity.
    fn one_pencil(
        &mut self,
        cut: Cut,
        view: &ClosedLoop<f64>,
        form: &HalfAngleForm<f64>,
        shifted: &Shifted,
        most: &dyn Fn(usize) -> usize,
    ) -> bool {
        let Some((constant, linear)) = shifted.monic() else { return false };
        // The fast routine comes first; if it leaves a root unresolved, the reference routine decides.
        [Method::Francis, Method::Faer].into_iter().any(|method| {
            self.assembly.tries += 1;
            let roots = self.eigen.companion(method, &constant, &linear);
            let mut family =
                OfPencil { cut, view, form, shifted, real: CutView::new(view, form, shifted.hidden), complex: None };
            if method == Method::Francis && roots.as_ref().is_some_and(|roots| self.all_at_once(&mut family, roots)) {
                return true;
            }
            roots.is_some_and(|roots| self.all_roots(&mut family, &roots)) || self.is_full(self.proved(), most)
        })
    }

    /// Lists the solutions of sixteen simple roots, all polished and proved side by side. Returns whether that succeeds; otherwise the list is
    /// as it was.
    fn all_at_once(&mut self, family: &mut OfPencil<'_>, roots: &[Complex<f64>]) -> bool {
        let is_general = self.closed.variables == [Variable::Rotation; 6] && self.assembly.modes.is_empty();
        if self.roots != Roots::All || !is_general || roots.len() != side_by_side::MOST {
            return false;
        }
        let none = Complex::new(0.0, 0.0);
        let (mut real, mut complex) = ([[(0.0, 0.0); 6]; side_by_side::MOST], [[(none, none); 6]; side_by_side::MOST]);
        let (mut reals, mut pairs) = (0, 0);
        for &x in roots {
            let size = 1.0 + x.norm_sqr();
            // Roots at infinity and nearly double ones are for other ways.
            let is_far = (1.0 + x * x).norm() < limits::INFINITE * size;
            if is_far || x.im != 0.0 && x.im.abs() < limits::NEAR_REAL * size {
                return false;
            }
            if x.im == 0.0 {
                let Some(found) = simple(&family.real, family.shifted, x.re) else { return false };
                real[reals] = self.pairs_in_loop_order(family.cut, &found);
                reals += 1;
            } else if x.im > 0.0 {
                let view =
                    family.complex.get_or_insert_with(|| CutView::new(family.view, family.form, family.shifted.hidden));
                let Some(found) = simple(view, family.shifted, x) else { return false };
                complex[pairs] = self.pairs_in_loop_order(family.cut, &found);
                pairs += 1;
            }
        }
        let finish = Finish::new(self.closed, self.gap_rounding);
        let (real, complex) = (&real[..reals], &complex[..pairs]);
        let done = Arch::new().dispatch(SideBySide { finish, real, complex, modes: &mut self.assembly.modes });
        let stored = LazyCell::new(STORED);
        let all = self.alone(real, &done[0], &stored) && self.alone(complex, &done[1], &stored);
        self.is_whole(all)
    }

    /// Lists sixteen solutions by the zeros of a determinant, if there are so many that are certified. Returns whether that succeeds; otherwise
    /// the list is as it was.
    fn by_all_zeros(&mut self) -> bool {
        let Some((list, workspace)) = &mut self.all_list else { return false };
        if !self.assembly.modes.is_empty() {
            return false;
        }
        let finish = Finish::new(self.closed, self.gap_rounding);
        let left = list.solve(self.closed, finish, &mut workspace.waiting, &mut self.assembly.modes);
        let stored = LazyCell::new(STORED);
        let alone = |(start, is_real): &(Six<Complex<f64>>, bool)| self.one_alone(start, *is_real, &stored);
        let all = left.is_some_and(|left| left.starts().iter().all(alone));
        self.is_whole(all)
    }

    /// Returns whether sixteen solutions are listed, all certified and apart, if `all` are proved; otherwise nothing is listed.
    fn is_whole(&mut self, all: bool) -> bool {
        let modes = &mut self.assembly.modes;
        if all && modes.len() == side_by_side::MOST && are_all_apart(&self.closed.variables, modes) {
            (self.assembly.all_resolved, self.assembly.real_resolved) = (true, true);
            return true;
        }
        modes.clear();
        false
    }

    /// Returns cosines and sines of the unknowns of a cut in the order and direction of the loop.
    fn pairs_in_loop_order<S: Scalar>(&self, cut: Cut, pairs: &[(S, S); 6]) -> [(S, S); 6] {
        let mut ordered = *pairs;
        for (j, (cos, sin)) in pairs.iter().enumerate() {
            ordered[self.arrangement.0[cut.unknown_index(j)]] = (*cos, if cut.reversed { sin.neg() } else { *sin });
        }
        ordered
    }

    /// Admits the solutions of the roots of a polynomial. Returns whether all of the roots are resolved.
    pub fn all_roots(&mut self, family: &mut impl Family, roots: &[Complex<f64>]) -> bool {
        let mut all_resolved = true;
        let (mut real_resolved, mut closes) = (true, false);
        let mut repeated = Repeated::default();
        for &x in roots {
            let size = 1.0 + x.norm_sqr();
            if repeated.takes(x, limits::REPEATED * size) {
                continue;
            }
            if (1.0 + x * x).norm() < limits::INFINITE * size && x.im.abs() > limits::NEAR_REAL * size {
                // tan(q/2) near +-i has no solution in special geometry as a rule, but it is checked.
                if self.roots == Roots::All && x.im > 0.0 {
                    family.complex(self, x);
                }
                continue;
            }
            if x.im.abs() < limits::NEAR_REAL * size {
                let outcome = family.real(self, x.re);
                // A shared root may have complex solutions beside the real ones.
                let settled = outcome.settled && !(self.roots == Roots::All && outcome.shared && !outcome.whole);
                repeated.expect(x, &outcome);
                all_resolved &= !outcome.unresolved;
                closes |= outcome.settled;
                // A pair of complex roots near the real axis need not close; any other failure is a loss.
                let lost = !(outcome.settled || x.im != 0.0 && outcome.separation > limits::SHARED);
                real_resolved &= !outcome.unresolved && !lost;
                if settled {
                    continue;
                }
                if self.roots == Roots::Real {
                    all_resolved &= !lost;
                    continue;
                }
            } else if self.roots == Roots::Real {
                continue;
            }
            if x.im < 0.0 {
                continue;
            }
            let outcome = family.complex(self, x);
            repeated.expect(x, &outcome);
            all_resolved &= outcome.settled && !outcome.unresolved;
            closes |= outcome.settled;
        }
        // Roots of a polynomial that vanishes but for rounding lead nowhere.
        self.assembly.real_resolved |= real_resolved && closes;
        all_resolved
    }

    /// Admits all solutions of one root of the pencil.
    fn one_root<S: Scalar>(&mut self, cut: Cut, view: &CutView<S>, shifted: &Shifted, x: S) -> RootOutcome {
        let kernel = kernel(&at_root(&shifted.pencil, x), SHARED);
        let mut outcome = RootOutcome {
            settled: false,
            unresolved: false,
            shared: kernel.dimension > 1,
            whole: false,
            dimension: kernel.dimension,
            separation: kernel.separation,
        };
        let Some(hidden) = unshifted(x, shifted.offset) else { return outcome };
        let candidates = view.candidates(hidden, &kernel);
        outcome.unresolved = candidates.unresolved;
        outcome.settled = !candidates.as_slice().is_empty();
        outcome.whole = candidates.as_slice().len() == kernel.dimension;
        for candidate in candidates.as_slice() {
            outcome.settled &= self.admit(&self.in_loop_order(cut, candidate));
        }
        outcome
    }

    /// Returns the unknowns of a cut in the order and direction of the loop.
    pub(super) fn in_loop_order<S: Scalar>(&self, cut: Cut, candidate: &Six<S>) -> Six<S> {
        let mut unknowns = [S::zero(); 6];
        for (j, value) in candidate.iter().enumerate() {
            let (index, (order, flipped)) = (cut.unknown_index(j), self.arrangement);
            let flip = flipped && self.closed.variables[order[index]] == Variable::Translation;
            unknowns[order[index]] = if cut.reversed == flip { *value } else { value.neg() };
        }
        unknowns
    }

    /// Polishes a candidate and lists it if it closes. Returns whether it was a solution from the start.
    pub fn admit<S: Scalar>(&mut self, start: &Six<S>) -> bool {
        let mut polished = polish(self.closed, start);
        polished.closure.constant_is_off(5, self.gap_rounding);
        let growth = 6.0 * polished.closure.growth(false);
        if !S::REAL && !(growth < limits::FAR) {
            // Far from the real numbers f64 has too few digits to polish with.
            let Some(mode) = self.proved_mode(&start.map(Scalar::to_complex)) else { return false };
            self.merge_with_conjugate(mode);
            return true;
        }
        // Rounding errors of a closure also grow with its longest translation.
        let reach = reach(&self.closed.variables, &polished.unknowns.map(Scalar::to_complex)).min(limits::LONGEST);
        let closed = limits::CLOSED * reach + self.gap_rounding;
        if !(polished.closure.defect <= closed.max((1e-14 * growth).min(1e-4))) {
            return false;
        }
        let near = polished.raw < limits::RAW.max((1e-10 * growth).min(0.1)) * reach && polished.moved < 0.1 * reach;
        let imaginary = polished.unknowns.iter().map(|x| x.to_complex().im.abs()).fold(0.0, f64::max);
        // Beside a real double root, a complex point that closes to rounding is no solution of its own.
        let singular = polished.inverse.as_ref().is_none_or(|a| dense::norm(a) > 1e6);
        let nearly_real = if singular { limits::NEAR_DOUBLE } else { limits::REAL_PART };
        if !S::REAL && imaginary < nearly_real {
            let mut real = polish::<f64>(self.closed, &polished.unknowns.map(|x| x.to_complex().re));
            real.closure.constant_is_off(5, self.gap_rounding);
            if real.closure.defect <= closed {
                self.record(&real);
                return near;
            }
        }
        self.record(&polished);
        near
    }

    pub(super) fn record<S: Scalar>(&mut self, polished: &Polished<S>) {
        let variables = self.closed.variables;
        let mut unknowns = polished.unknowns.map(Scalar::to_complex);
        let mut wrapping = 0.0_f64;
        for (z, variable) in unknowns.iter_mut().zip(variables) {
            if variable == Variable::Rotation {
                let turned = z.re;
                z.re = wrapped(turned);
                // Reduction by a full rotation adds a rounding error of its own.
                wrapping = wrapping.max(f64::EPSILON * (z.re - turned).abs());
            }
        }
        let inverse_norm = polished.inverse.as_ref().map_or(f64::INFINITY, dense::norm);
        let mut mode = Mode {
            unknowns,
            real: S::REAL,
            multiplicity: 1,
            residual: polished.closure.relative_defect(self.closed, &unknowns, S::REAL),
            condition: dense::norm(&polished.closure.jacobian) * inverse_norm,
            certificate: None,
            hits: Hits::first(self.assembly.tries),
        };
        self.prove(polished, &mut mode);
        if let Some(proof) = &mut mode.certificate {
            (proof.radius, proof.proved) = (proof.radius + wrapping, proof.proved + wrapping);
        }
        self.merge_with_conjugate(mode);
    }

    fn merge_with_conjugate(&mut self, mode: Mode) {
        if !mode.real {
            self.merge(mode.conjugate());
        }
        self.merge(mode);
    }

    /// Proves a polished solution by the cheapest method that works.
    fn prove<S: Scalar>(&self, polished: &Polished<S>, mode: &mut Mode) {
        let Some(inverse) = polished.inverse.as_ref() else { return };
        mode.certificate = certificate(&polished.closure, inverse);
        // Beside a double root a proof would single out one of two solutions that cannot be distinguished.
        if mode.certificate.is_none() && dense::norm(inverse) > limits::SINGULAR {
            return;
        }
        if mode.certificate.is_none() {
            mode.certificate = certificate_in_reach(self.closed, &polished.unknowns, self.gap_rounding);
        }
        if mode.certificate.is_none() && !S::REAL {
            mode.certificate = certificate_in_any_frame(self.closed, &polished.unknowns, self.gap_rounding);
        }
        if mode.certificate.is_none()
            && let Some(refined) = refined_certificate_of(self.closed, &mode.unknowns, self.gap_rounding)
            && refined.real == S::REAL
        {
            (mode.unknowns, mode.certificate) = (refined.unknowns, Some(refined.certificate));
        }
    }

    pub fn merge(&mut self, mut mode: Mode) {
        if let Some(spherical) = self.spherical {
            canonical(&mut mode.unknowns, spherical);
        }
        let variables = self.closed.variables;
        for other in &mut self.assembly.modes {
            let distance = distance(&variables, &other.unknowns, &mode.unknowns);
            let proved_apart = match (&other.certificate, &mode.certificate) {
                (Some(a), Some(b)) => distance > a.radius + b.radius,
                _ => false,
            };
            if distance < limits::SAME && !proved_apart {
                let better = match (&other.certificate, &mode.certificate) {
                    (None, Some(_)) => true,
                    (Some(_), None) => false,
                    _ => mode.real && !other.real || (mode.real == other.real && mode.residual < other.residual),
                };
                let hits = other.hits.again(mode.hits);
                if better {
                    *other = mode;
                }
                other.hits = hits;
                return;
            }
        }
        self.assembly.modes.push(mode);
    }

    /// Searches from random starts. If every pencil leaves roots unresolved, solutions form families as a rule.
    fn cast_about(&mut self) {
        // The missing solutions have large imaginary parts, which no real start reaches.
        if self.assembly.real_resolved && !self.is_deficient {
            return;
        }
        for trial in 1..=limits::CASTS {
            let start = approach(self.closed, &spread(&self.closed.variables, trial));
            // A start that ends far from closing is at a dead end.
            if closure(self.closed, &start).defect < limits::NEAR {
                self.admit::<f64>(&approach_singular(self.closed, &start));
            }
        }
    }

    /// Proves solutions that are nearly double, both or none: the pencil may have led to one of a pair only, and f64
    /// cannot distinguish them.
    fn resolve_pairs(&mut self) {
        for k in 0..self.assembly.modes.len() {
            let mode = &self.assembly.modes[k];
            if mode.certificate.is_some() {
                continue;
            }
            let starts = if mode.real {
                pair(self.closed, &mode.unknowns.map(|z| z.re))
            } else {
                pair(self.closed, &mode.unknowns)
            };
            let own = mode.unknowns;
            let variables = self.closed.variables;
            let apart = |starts: &[Six<Complex<f64>>; 2]| distance(&variables, &starts[0], &starts[1]);
            if starts.as_ref().is_some_and(|(_, vertex)| *vertex < limits::TOLD_APART) {
                continue;
            }
            let both = starts.map(|(starts, _)| (apart(&starts), starts.map(|start| self.proved_mode(&start))));
            let radius = |mode: &Mode| mode.certificate.map_or(f64::INFINITY, |proof| proof.radius);
            let reach = reach(&variables, &own);
            let alone = |mode: &Mode| {
                let near = distance(&variables, &mode.unknowns, &own) < limits::SAME * reach;
                near && radius(mode) < limits::LONE_RADIUS * reach
            };
            let proved = match both {
                Some((_, [Some(one), Some(two)]))
                    if distance(&variables, &one.unknowns, &two.unknowns) > radius(&one) + radius(&two) =>
                {
                    [Some(one), Some(two)]
                }
                // A close pair is proved together or not at all.
                Some((near, _)) if near < limits::MERGED => continue,
                _ => [self.proved_mode(&own).filter(alone), None],
            };
            if proved[0].is_none() {
                continue;
            }
            let hits = self.assembly.modes[k].hits;
            self.assembly.modes.swap_remove(k);
            for mut mode in proved.into_iter().flatten() {
                mode.hits = hits;
                self.merge(mode);
            }
            return self.resolve_pairs();
        }
    }

    /// Returns a solution proved in double-double arithmetic from a start nearby, real if its imaginary parts vanish.
    pub(super) fn proved_mode(&self, start: &Six<Complex<f64>>) -> Option<Mode> {
        refined_certificate_of(self.closed, start, self.gap_rounding).map(|refined| self.refined_mode(refined))
    }

    /// Returns the mode of a solution proved in longer numbers.
    pub(super) fn refined_mode(&self, refined: Refined) -> Mode {
        let Refined { mut unknowns, real, certificate, condition } = refined;
        for (z, variable) in unknowns.iter_mut().zip(self.closed.variables) {
            if variable == Variable::Rotation {
                z.re = wrapped(z.re);
            }
        }
        let here = closure(self.closed, &unknowns);
        // Next to a singular position the matrix of f64 may be singular.
        let inverse = dense::inverse(&here.jacobian);
        Mode {
            unknowns,
            real,
            multiplicity: 1,
            residual: here.relative_defect(self.closed, &unknowns, real),
            condition: inverse.map_or(condition, |inverse| dense::norm(&here.jacobian) * dense::norm(&inverse)),
            certificate: Some(certificate),
            hits: Hits::first(self.assembly.tries),
        }
    }

    /// Classifies the modes without certificate as multiple, points of a self-motion, or unknown.
    fn resolve_singular(&mut self) {
        let closed = self.closed;
        let mut families: Vec<SelfMotion> = Vec::new();
        let mut unresolved: Vec<Six<Complex<f64>>> = Vec::new();
        // Real solutions decide whether there is a self-motion.
        self.assembly.modes.retain_mut(|mode| {
            if mode.certificate.is_some() || !mode.real {
                return true;
            }
            let q = mode.unknowns.map(|z| z.re);
            let is_known = families.iter().any(|family| family.holds(closed, &q, CLOSES_WITHIN));
            if is_known || is_crowded(&unresolved, &mode.unknowns) {
                return false;
            }
            let found = self_motions(closed, &q, CLOSES_WITHIN);
            let moves = !found.is_empty();
            for family in found {
                if !families.iter().any(|known| is_same(closed, known, &family)) {
                    families.push(family);
                }
            }
            if !moves {
                mode.multiplicity = match nature(closed, &q) {
                    Nature::Isolated(multiplicity) => multiplicity,
                    // With several singular directions, the number of roots of a pencil that led here is the multiplicity.
                    _ if (2..=MOST_HITS).contains(&mode.hits.most) => mode.hits.most,
                    _ => 0,
                };
                if mode.multiplicity == 0 {
                    unresolved.push(mode.unknowns);
                }
            }
            !moves
        });
        let dimension = families.iter().map(|family| family.dimension).max().unwrap_or(0);
        self.assembly.self_motion = dimension;
        self.assembly.families = families;
        let mut continued = 0;
        self.assembly.modes.retain_mut(|mode| {
            if mode.certificate.is_some() || mode.real {
                return true;
            }
            if is_crowded(&unresolved, &mode.unknowns) {
                return false;
            }
            let own = if continued < MOST_CONTINUED { nature(closed, &mode.unknowns) } else { Nature::Unresolved };
            if let Nature::Isolated(multiplicity) = own {
                mode.multiplicity = multiplicity;
                return true;
            }
            mode.multiplicity = 0;
            unresolved.push(mode.unknowns);
            continued += 1;
            // Beside a self-motion, complex solutions that are not isolated are points of its complex continuation. One
            // pair is enough to show that there is a curve of complex solutions.
            dimension == 0 && continued <= 2
        });
        self.merge_multiple();
    }

    /// Merges the cluster of points that rounding leaves at a solution of multiplicity m, with a radius of the order of
    /// eps^(1/m). One point stays: a real one if there is one, and the nearest to the middle.
    fn merge_multiple(&mut self) {
        let is_cloudy = |mode: &Mode| mode.certificate.is_none() && mode.multiplicity >= 3;
        if !self.assembly.modes.iter().any(is_cloudy) {
            return;
        }
        let variables = self.closed.variables;
        let mut left = std::mem::take(&mut self.assembly.modes);
        while let Some(mode) = left.pop() {
            if !is_cloudy(&mode) {
                self.assembly.modes.push(mode);
                continue;
            }
            let width = limits::CLOUD * f64::EPSILON.powf(1.0 / mode.multiplicity as f64);
            let near = |other: &Mode| {
                let alike = other.certificate.is_none() && other.multiplicity == mode.multiplicity;
                alike && distance(&variables, &other.unknowns, &mode.unknowns) < width
            };
            let (mut cloud, apart): (Vec<Mode>, Vec<Mode>) = left.into_iter().partition(near);
            left = apart;
            cloud.push(mode);
            let off =
                |mode: &Mode| cloud.iter().map(|x| distance(&variables, &x.unknowns, &mode.unknowns)).sum::<f64>();
            let order = |a: &&Mode, b: &&Mode| b.real.cmp(&a.real).then(off(a).total_cmp(&off(b)));
            let middle = cloud.iter().min_by(order).cloned();
            self.assembly.modes.extend(middle);
        }
    }
}

/// If more roots of one pencil than this lead to one solution, it is not isolated: a closure polynomial has no more roots.
const MOST_HITS: usize = 16;
/// Maximum number of complex solutions that are not isolated and are examined.
const MOST_CONTINUED: usize = 6;
/// Distance below which points belong to one unresolved solution: the fourth root of the rounding error.
const CROWD: f64 = 1e-3;

/// Returns whether a solution lies beside an unresolved one.
fn is_crowded(unresolved: &[Six<Complex<f64>>], unknowns: &Six<Complex<f64>>) -> bool {
    unresolved.iter().any(|other| distance(&[Variable::Rotation; 6], other, unknowns) < CROWD)
}

/// Returns whether two self-motions are one: curves that share a point, or surfaces along which the same unknowns move.
pub(super) fn is_same(closed: &ClosedLoop<f64>, known: &SelfMotion, other: &SelfMotion) -> bool {
    if known.dimension > 1 || other.dimension > 1 {
        return known.dimension == other.dimension && known.moving == other.moving;
    }
    known.holds(closed, &other.points[other.points.len() / 2], CLOSES_WITHIN)
}

/// The handlers of the roots of one closure polynomial.
pub(super) trait Family {
    /// Admits the solutions of a real root.
    fn real(&mut self, search: &mut Search<'_>, x: f64) -> RootOutcome;
    /// Admits the solutions of a complex root.
    fn complex(&mut self, search: &mut Search<'_>, x: Complex<f64>) -> RootOutcome;
}

/// The roots of the pencil of a cut.
struct OfPencil<'a> {
    cut: Cut,
    view: &'a ClosedLoop<f64>,
    form: &'a HalfAngleForm<f64>,
    shifted: &'a Shifted,
    real: CutView<'a, f64>,
    complex: Option<CutView<'a, Complex<f64>>>,
}

impl Family for OfPencil<'_> {
    fn real(&mut self, search: &mut Search<'_>, x: f64) -> RootOutcome {
        search.one_root(self.cut, &self.real, self.shifted, x)
    }

    fn complex(&mut self, search: &mut Search<'_>, x: Complex<f64>) -> RootOutcome {
        let view = self.complex.get_or_insert_with(|| CutView::new(self.view, self.form, self.shifted.hidden));
        search.one_root(self.cut, view, self.shifted, x)
    }
}

/// Returns cosines and sines of the unknowns of a cut at a root of its pencil to which one solution belongs.
fn simple<S: Scalar>(view: &CutView<'_, S>, shifted: &Shifted, x: S) -> Option<[(S, S); 6]> {
    let kernel = kernel(&at_root(&shifted.pencil, x), SHARED);
    if kernel.dimension != 1 {
        return None;
    }
    view.pairs_of(unshifted(x, shifted.offset)?, &kernel.basis[0])
}

/// The result of following one root.
pub(super) struct RootOutcome {
    /// Whether every candidate of the root closed.
    pub settled: bool,
    /// Whether a family of solutions belongs to the root.
    pub unresolved: bool,
    /// Whether several solutions may belong to the root.
    pub shared: bool,
    /// Whether the root has as many candidates as its kernel has dimensions.
    pub whole: bool,
    /// The dimension of that kernel.
    pub dimension: usize,
    /// The separation of that kernel from one of a higher dimension.
    pub separation: f64,
}

impl RootOutcome {
    /// Returns the outcome of a root that leads nowhere.
    pub fn nothing() -> Self {
        Self { settled: false, unresolved: false, shared: false, whole: false, dimension: 0, separation: 1.0 }
    }
}

/// Shared roots that are resolved. Such a root occurs once for each of its solutions, and its first occurrence finds them all.
#[derive(Default)]
struct Repeated {
    /// The roots, and the number of occurrences of each that are still to come.
    roots: [(Complex<f64>, usize); MOST_SHARED],
    count: usize,
}

/// Maximum number of roots that two solutions share, of a pencil with sixteen roots.
const MOST_SHARED: usize = 8;
/// Arms with fewer solutions than this are solved without computing a bound on their number.
const FEWEST_OF_SPECIAL: usize = 4;

impl Repeated {
    /// Returns whether a root is one of these and still to come.
    fn takes(&mut self, x: Complex<f64>, reach: f64) -> bool {
        let is_it = |(root, left): &&mut (Complex<f64>, usize)| *left > 0 && (x - *root).norm() < reach;
        let Some((_, left)) = self.roots[..self.count].iter_mut().find(is_it) else { return false };
        *left -= 1;
        true
    }

    /// Adds a root, if all the solutions that share it are found.
    fn expect(&mut self, x: Complex<f64>, outcome: &RootOutcome) {
        let is_done = outcome.settled && outcome.whole && outcome.shared && !outcome.unresolved;
        if is_done && self.count < MOST_SHARED {
            self.roots[self.count] = (x, outcome.dimension - 1);
            self.count += 1;
        }
    }
}
