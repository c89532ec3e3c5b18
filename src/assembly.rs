//! Roots to assembly modes: prepare a geometry once, then find every way to close it, pose after pose.

use crate::certify::{Certificate, certificate, certificate_in_any_frame, refined_certificate};
use crate::closure::half_angle::{HalfAngleForm, half_angle_form};
use crate::closure::woernle_lee::MarkedLine;
use crate::elimination::cut::{Cut, Hidden};
use crate::elimination::pencil::{Bilinear, Pencil, before_second_link, bilinear, offset, pencil};
use crate::kinematics::closed_loop::{ClosedLoop, OpenLoop, Variable};
use crate::kinematics::motion::Motion;
use crate::solve::back_substitution::CutView;
use crate::solve::dense;
use crate::solve::eigen::EigenWorkspace;
use crate::solve::kernel::{double_angle, kernel};
use crate::solve::newton::{Closure, Polished, Six, closure, polish};
use crate::solve::scalar::{Number, Scalar};
use crate::solve::singular::{Nature, nature, pair, self_motion, spread, structural_rank};
use num_complex::Complex;
use std::f64::consts::{PI, TAU};

/// Which roots are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Roots {
    /// Every complex root polished and certified: what completeness needs.
    All,
    /// Real roots only: faster, without a proof that none is missing.
    Real,
}

/// One way to assemble the loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// The six unknowns in loop order; angles in (-pi, pi], lengths in the unit of the mechanism.
    pub unknowns: Six<Complex<f64>>,
    /// Whether all unknowns are real.
    pub real: bool,
    /// How many solutions coincide here; 0 where that is not known.
    pub multiplicity: usize,
    /// Largest entry of |E - I| of the closure E, translations over the scale of the mechanism (its mean link length,
    /// rounded to a power of two); of a complex mode over the largest product of norms round the loop, too.
    pub residual: f64,
    /// Row-sum condition number of the Jacobian, lengths over the scale of the mechanism.
    pub condition: f64,
    /// The proof, if there is one. Radii are in radians, lengths over the scale.
    pub certificate: Option<Certificate>,
    /// In how many cuts it was found.
    pub hits: usize,
}

/// What was found at one pose or input.
#[derive(Clone, Debug, Default)]
pub struct Assembly {
    /// Isolated solutions, real ones first.
    pub modes: Vec<Mode>,
    /// Dimension of the self-motion, 0 if there is none.
    pub self_motion: usize,
    /// Whether some cut gave a pencil whose every root was accounted for.
    pub clean: bool,
    /// How many pencils were solved.
    pub tries: usize,
}

impl Assembly {
    /// Number of isolated solutions, with multiplicity.
    #[must_use]
    pub fn total(&self) -> usize {
        self.modes.iter().map(|m| m.multiplicity.max(1)).sum()
    }

    /// Number of isolated real solutions, with multiplicity.
    #[must_use]
    pub fn real(&self) -> usize {
        self.modes.iter().filter(|m| m.real).map(|m| m.multiplicity.max(1)).sum()
    }
}

/// A cut whose elimination does not depend on the pose.
struct PreparedCut {
    cut: Cut,
    form: HalfAngleForm<f64>,
    /// `form.rows` carried over constant 2, where that is free of the pose too.
    rows: Option<[MarkedLine<f64>; 8]>,
}

/// A geometry, prepared: solve many poses of it.
///
/// # Example
/// ```
/// use looproot::assembly::{Assembly, Roots, Solver, Workspace};
/// use looproot::kinematics::{closed_loop::{OpenLoop, Variable}, motion::Motion};
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
    /// Cuts that need no pose, best first.
    prepared: Vec<PreparedCut>,
    structural_rank: usize,
}

/// Memory reused from pose to pose: one per thread.
#[derive(Default)]
pub struct Workspace {
    eigen: EigenWorkspace,
}

/// Thresholds. Lengths are scaled, so all of them are relative.
mod limits {
    /// Cuts with a lower score lose equations.
    pub const SCORE: f64 = 1e-5;
    /// Leading matrices below this are singular.
    pub const LEADING: f64 = 1e-9;
    /// Leading matrices above this need no other offset.
    pub const GOOD_LEADING: f64 = 1e-2;
    /// |Im x| / (1 + |x|^2) below which a root may be real: double roots split by 1e-8 and more.
    pub const NEAR_REAL: f64 = 1e-4;
    /// Closure before polishing above which a candidate is none: Newton might wander to another solution.
    pub const RAW: f64 = 1e-3;
    /// Closure after polishing above which a candidate is no solution.
    pub const CLOSED: f64 = 1e-12;
    /// |1 + x^2| / (1 + |x|^2) below which a root belongs to no finite angle.
    pub const INFINITE: f64 = 1e-2;
    /// Solutions nearer than this are one unless both are proved and apart.
    pub const SAME: f64 = 1e-5;
    /// Imaginary parts below this are rounding of a real solution.
    pub const REAL_PART: f64 = 1e-8;
    /// Solutions farther apart than this are polished to different points and have a place in the list each.
    pub const MERGED: f64 = 1e-4;
    /// Closure errors that make two solutions one and are no larger than this are rounding of the input: the solution
    /// counts as double.
    pub const TOLD_APART: f64 = 1e-13;
    /// Starts of a search without a pencil to lead it.
    pub const CASTS: usize = 40;
    /// Norm of the inverse Jacobian above which a solution may be one of a pair, to be proved together.
    pub const SINGULAR: f64 = 1e5;
    /// Separation of the kernel below which a root that does not close may belong to a family.
    pub const SHARED: f64 = 1e-7;
}

impl Solver {
    /// Prepares a geometry: all that does not depend on the pose, and the order of the cuts.
    #[must_use]
    pub fn prepare(open: &OpenLoop<f64>) -> Self {
        let length = |m: &Motion<f64>| m.translation.iter().map(|x| x * x).sum::<f64>();
        let square: f64 = open.constants.iter().map(length).sum::<f64>() / 5.0
            + 0.5 * (length(&open.before_gap) + length(&open.after_gap)) / 5.0;
        // A power of two: scaling then costs no digit.
        let scale = if square > 0.0 { square.sqrt().log2().round().exp2() } else { 1.0 };
        let scaled = |m: &Motion<f64>| Motion { translation: m.translation.map(|x| x / scale), ..m.clone() };
        let open = OpenLoop {
            variables: open.variables,
            constants: open.constants.each_ref().map(scaled),
            before_gap: scaled(&open.before_gap),
            after_gap: scaled(&open.after_gap),
        };
        let closed = open.close(&Motion::identity());
        let mut prepared: Vec<PreparedCut> = Cut::ALL[..Cut::PREPARED]
            .iter()
            .filter(|cut| cut.fits(open.variables))
            .filter_map(|&cut| {
                let view = cut.of(&closed);
                let form = half_angle_form(&view)?;
                // The gap sits in constant 6 of the original loop.
                let free = cut.constant_index(1) != 5;
                let rows = free.then(|| before_second_link(&form, &view.constants[1]));
                (form.score > limits::SCORE).then_some(PreparedCut { cut, form, rows })
            })
            .collect();
        prepared.sort_by(|a, b| b.form.score.total_cmp(&a.form.score));
        let structural_rank = structural_rank(&closed);
        Self { open, scale, prepared, structural_rank }
    }

    /// The largest rank the six joints reach in general position: below 6 the arm is structurally deficient, and every
    /// solution is part of a self-motion.
    #[must_use]
    pub fn structural_rank(&self) -> usize {
        self.structural_rank
    }

    /// Whether no cut fits: translations stand where the elimination cannot take them.
    #[must_use]
    pub fn is_out_of_reach(&self) -> bool {
        !Cut::ALL.iter().any(|cut| cut.fits(self.open.variables))
    }

    /// The best score of a cut that needs no pose; 0 if there is none.
    #[must_use]
    pub fn score(&self) -> f64 {
        self.prepared.first().map_or(0.0, |c| c.form.score)
    }

    /// The loop at a filling of its gap, scaled.
    fn close(&self, filling: &Motion<f64>) -> ClosedLoop<f64> {
        let filling = Motion { translation: filling.translation.map(|x| x / self.scale), ..filling.clone() };
        self.open.close(&filling)
    }

    /// The 16 x 16 matrix whose eigenvalues the first pencil of this pose asks for; `None` where that is singular.
    #[must_use]
    pub fn companion(&self, filling: &Motion<f64>) -> Option<[[f64; 16]; 16]> {
        let prepared = self.prepared.first()?;
        let cut = prepared.cut.of(&self.close(filling));
        let rows = prepared.rows.unwrap_or_else(|| before_second_link(&prepared.form, &cut.constants[1]));
        let shifted = Shifted::best(&bilinear(&rows, &cut), Hidden::First);
        let (constant, linear) = shifted.monic()?;
        Some(std::array::from_fn(|i| {
            std::array::from_fn(|j| match (i < 8, j < 8) {
                (true, _) => f64::from(u8::from(j == 8 + i)),
                (false, true) => -constant[i - 8][j],
                (false, false) => -linear[i - 8][j - 8],
            })
        }))
    }

    /// Finds the solutions at one pose or input, given as the motion that fills the gap of the loop. Allocates nothing
    /// once `assembly` has grown to its size, but for degenerate poses.
    pub fn solve(&self, filling: &Motion<f64>, roots: Roots, workspace: &mut Workspace, assembly: &mut Assembly) {
        self.solve_up_to(filling, roots, &|| 16, workspace, assembly);
    }

    /// As [`Solver::solve`], for a geometry known to have no more than `most()` solutions: stops looking for more.
    /// `most` is asked only where fewer than 16 are found.
    pub fn solve_up_to(
        &self,
        filling: &Motion<f64>,
        roots: Roots,
        most: &dyn Fn() -> usize,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) {
        assembly.modes.clear();
        (assembly.self_motion, assembly.clean, assembly.tries) = (0, false, 0);
        let closed = self.close(filling);
        let mut search = Search { solver: self, closed: &closed, roots, workspace, assembly, fruitless: 0 };
        search.run(most);
        if !search.assembly.clean {
            search.cast_about();
        }
        search.resolve_pairs();
        search.resolve_singular();
        assembly.modes.sort_by(|a, b| {
            b.real.cmp(&a.real).then_with(|| {
                let key = |m: &Mode| m.unknowns.map(|z| (z.re, z.im));
                key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal)
            })
        });
        for mode in &mut assembly.modes {
            for (value, variable) in mode.unknowns.iter_mut().zip(self.open.variables) {
                if variable == Variable::Translation {
                    *value *= self.scale;
                }
            }
        }
    }
}

/// One pose being solved.
struct Search<'a> {
    solver: &'a Solver,
    closed: &'a ClosedLoop<f64>,
    roots: Roots,
    workspace: &'a mut Workspace,
    assembly: &'a mut Assembly,
    /// Clean pencils in a row that added nothing.
    fruitless: usize,
}

impl Search<'_> {
    fn run(&mut self, most: &dyn Fn() -> usize) {
        let solver = self.solver;
        for prepared in &solver.prepared {
            let cut = prepared.cut.of(self.closed);
            let carried;
            let rows = if let Some(rows) = &prepared.rows {
                rows
            } else {
                carried = before_second_link(&prepared.form, &cut.constants[1]);
                &carried
            };
            if self.both_hidings(prepared.cut, &cut, &prepared.form, rows, most) {
                return;
            }
        }
        // The cuts with the pose inside their elimination, best first.
        let mut rest: Vec<(Cut, ClosedLoop<f64>, HalfAngleForm<f64>)> = Cut::ALL[Cut::PREPARED..]
            .iter()
            .filter(|cut| cut.fits(self.closed.variables))
            .filter_map(|&cut| {
                let view = cut.of(self.closed);
                let form = half_angle_form(&view)?;
                (form.score > limits::SCORE).then_some((cut, view, form))
            })
            .collect();
        rest.sort_by(|a, b| b.2.score.total_cmp(&a.2.score));
        for (cut, view, form) in &rest {
            let rows = before_second_link(form, &view.constants[1]);
            if self.both_hidings(*cut, view, form, &rows, most) {
                return;
            }
        }
    }

    /// Solves a cut with each of its two angles hidden, the better one first, until the search is done.
    fn both_hidings(
        &mut self,
        cut: Cut,
        view: &ClosedLoop<f64>,
        form: &HalfAngleForm<f64>,
        rows: &[MarkedLine<f64>; 8],
        most: &dyn Fn() -> usize,
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
            let before = self.assembly.modes.len();
            let clean = self.one_pencil(cut, view, form, &shifted);
            self.assembly.tries += 1;
            let grown = self.assembly.modes.len() > before;
            if clean {
                self.assembly.clean = true;
                self.fruitless = if grown { 0 } else { self.fruitless + 1 };
            }
            if self.done(most, clean) {
                return true;
            }
        }
        false
    }

    /// Whether more pencils are of no use.
    fn done(&self, most: &dyn Fn() -> usize, clean: bool) -> bool {
        match self.roots {
            Roots::Real => clean,
            Roots::All => {
                let proved: usize = self.assembly.modes.iter().filter(|m| m.certificate.is_some()).count();
                proved >= 16 || (clean && (self.fruitless >= 2 || self.assembly.modes.len() >= most()))
            }
        }
    }

    /// Solves one pencil and admits what its roots lead to. Whether the pencil was regular and every root accounted for:
    /// it led to solutions or to infinity.
    fn one_pencil(&mut self, cut: Cut, view: &ClosedLoop<f64>, form: &HalfAngleForm<f64>, shifted: &Shifted) -> bool {
        let Some((constant, linear)) = shifted.monic() else { return false };
        let Some(roots) = self.workspace.eigen.companion(&constant, &linear) else { return false };
        let real_view = CutView::<f64>::new(view, form, shifted.hidden);
        let mut complex_view: Option<CutView<Complex<f64>>> = None;
        let mut clean = true;
        for x in roots {
            let size = 1.0 + x.norm_sqr();
            if (1.0 + x * x).norm() < limits::INFINITE * size && x.im.abs() > limits::NEAR_REAL * size {
                // tan(q/2) near +-i: in special geometry where no solution is, but look in case one is.
                if self.roots == Roots::All && x.im > 0.0 {
                    let complex_view = complex_view.get_or_insert_with(|| CutView::new(view, form, shifted.hidden));
                    self.one_root(cut, complex_view, shifted, x);
                }
                continue;
            }
            if x.im.abs() < limits::NEAR_REAL * size {
                let outcome = self.one_root(cut, &real_view, shifted, x.re);
                let settled = outcome.settled && !(self.roots == Roots::All && outcome.shared);
                clean &= !outcome.unresolved;
                if settled {
                    continue;
                }
                if self.roots == Roots::Real {
                    // A pair of complex roots near the real axis does not close; anything else is a loss.
                    clean &= outcome.settled || (x.im != 0.0 && outcome.separation > limits::SHARED);
                    continue;
                }
            } else if self.roots == Roots::Real {
                continue;
            }
            if x.im < 0.0 {
                continue;
            }
            let complex_view = complex_view.get_or_insert_with(|| CutView::new(view, form, shifted.hidden));
            let outcome = self.one_root(cut, complex_view, shifted, x);
            clean &= outcome.settled && !outcome.unresolved;
        }
        clean
    }

    /// Everything one root of the pencil leads to.
    fn one_root<S: Scalar>(&mut self, cut: Cut, view: &CutView<S>, shifted: &Shifted, x: S) -> RootOutcome {
        let at = shifted.pencil.at_root(x);
        let kernel = kernel(&at);
        let mut outcome = RootOutcome {
            settled: false,
            unresolved: false,
            shared: kernel.dimension > 1,
            separation: kernel.separation,
        };
        let Some(turned) = double_angle(S::one(), x) else { return outcome };
        // Back from the offset: q = q' + offset.
        let (cos, sin) = shifted.offset;
        let hidden = (turned.0.times(cos).sub(&turned.1.times(sin)), turned.1.times(cos).add(&turned.0.times(sin)));
        let candidates = view.candidates(hidden, &kernel);
        outcome.unresolved = candidates.unresolved;
        outcome.settled = !candidates.as_slice().is_empty();
        for candidate in candidates.as_slice() {
            let mut start = [S::zero(); 6];
            for (j, value) in candidate.iter().enumerate() {
                start[cut.unknown_index(j)] = if cut.reversed { value.neg() } else { *value };
            }
            outcome.settled &= self.admit(&start);
        }
        outcome
    }

    /// Polishes a candidate and takes it into the list if it closes. Whether it was a solution from the start.
    fn admit<S: Scalar>(&mut self, start: &Six<S>) -> bool {
        let polished = polish(self.closed, start);
        let growth = 6.0 * growth(&polished.closure, false);
        if !(polished.closure.defect <= limits::CLOSED.max((1e-14 * growth).min(1e-4))) {
            return false;
        }
        let near = polished.raw < limits::RAW.max((1e-10 * growth).min(0.1)) && polished.moved < 0.1;
        let imaginary = polished.unknowns.iter().map(|x| x.to_complex().im.abs()).fold(0.0, f64::max);
        if !S::REAL && imaginary < limits::REAL_PART {
            let real = polish::<f64>(self.closed, &polished.unknowns.map(|x| x.to_complex().re));
            if real.closure.defect <= limits::CLOSED {
                self.record(&real);
                return near;
            }
        }
        if !S::REAL && imaginary < 1e-6 && polished.inverse.as_ref().is_none_or(|a| dense::norm(a) > 1e6) {
            // Beside a real double root, a complex point within rounding of closing is no solution of its own.
            let real = polish::<f64>(self.closed, &polished.unknowns.map(|x| x.to_complex().re));
            if real.closure.defect <= limits::CLOSED {
                self.record(&real);
                return near;
            }
        }
        self.record(&polished);
        near
    }

    fn record<S: Scalar>(&mut self, polished: &Polished<S>) {
        let variables = self.closed.variables;
        let mut unknowns = polished.unknowns.map(Scalar::to_complex);
        for (z, variable) in unknowns.iter_mut().zip(variables) {
            if variable == Variable::Rotation {
                z.re = wrapped(z.re);
            }
        }
        let inverse_norm = polished.inverse.as_ref().map_or(f64::INFINITY, dense::norm);
        let mut mode = Mode {
            unknowns,
            real: S::REAL,
            multiplicity: 1,
            residual: polished.closure.defect / growth(&polished.closure, S::REAL),
            condition: dense::norm(&polished.closure.jacobian) * inverse_norm,
            certificate: None,
            hits: 1,
        };
        self.prove(polished, &mut mode);
        if !S::REAL {
            let mut conjugate = mode.clone();
            conjugate.unknowns = mode.unknowns.map(|z| z.conj());
            self.merge(conjugate);
        }
        self.merge(mode);
    }

    /// Proves a polished solution by the cheapest way that works.
    fn prove<S: Scalar>(&self, polished: &Polished<S>, mode: &mut Mode) {
        let Some(inverse) = polished.inverse.as_ref() else { return };
        mode.certificate = certificate(&polished.closure, inverse);
        // Beside a double root a proof would single out one of two solutions that cannot be told apart.
        if mode.certificate.is_some() || dense::norm(inverse) > limits::SINGULAR {
            return;
        }
        if !S::REAL {
            mode.certificate = certificate_in_any_frame(self.closed, &polished.unknowns);
        }
        if mode.certificate.is_none() {
            if let Some((unknowns, proof)) = refined_certificate(self.closed, &mode.unknowns) {
                (mode.unknowns, mode.certificate) = (unknowns, Some(proof));
            }
        }
    }

    fn merge(&mut self, mode: Mode) {
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
                let hits = other.hits + 1;
                if better {
                    *other = mode;
                }
                other.hits = hits;
                return;
            }
        }
        self.assembly.modes.push(mode);
    }

    /// Where no pencil was clean solutions form families, as a rule: looks for points of them from everywhere.
    fn cast_about(&mut self) {
        for trial in 1..=limits::CASTS {
            self.admit::<f64>(&spread(&self.closed.variables, trial));
        }
    }

    /// Proves solutions that are nearly double, both or none: the pencil may have led to one of a pair only, and f64
    /// cannot tell them apart.
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
            let proved = match both {
                Some((apart, [Some(one), Some(two)]))
                    if distance(&variables, &one.unknowns, &two.unknowns) > 0.5 * apart =>
                {
                    [Some(one), Some(two)]
                }
                // A pair that close is proved together or not at all.
                Some((near, _)) if near < limits::MERGED => continue,
                _ => [self.proved_mode(&own).filter(|m| distance(&variables, &m.unknowns, &own) < limits::SAME), None],
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

    /// A solution proved in double-double arithmetic from a start nearby, real if its imaginary parts vanish.
    fn proved_mode(&self, start: &Six<Complex<f64>>) -> Option<Mode> {
        let (mut unknowns, certificate) = refined_certificate(self.closed, start)?;
        let imaginary = unknowns.iter().map(|z| z.im.abs()).fold(0.0, f64::max);
        // Conjugation maps the ball of the proof into one three times as large: a single solution there is its own
        // conjugate.
        let real = imaginary <= certificate.radius && 3.0 * certificate.radius <= certificate.isolation;
        if real {
            unknowns = unknowns.map(|z| z.re.into());
        }
        for (z, variable) in unknowns.iter_mut().zip(self.closed.variables) {
            if variable == Variable::Rotation {
                z.re = wrapped(z.re);
            }
        }
        let here = closure(self.closed, &unknowns);
        let inverse_norm = dense::inverse(&here.jacobian).map_or(f64::INFINITY, |a| dense::norm(&a));
        Some(Mode {
            unknowns,
            real,
            multiplicity: 1,
            residual: here.defect / growth(&here, real),
            condition: dense::norm(&here.jacobian) * inverse_norm,
            certificate: Some(certificate),
            hits: 1,
        })
    }

    /// Decides what the modes without certificate are: multiple, points of a self-motion, or unknown.
    fn resolve_singular(&mut self) {
        let mut dimension = 0;
        let mut k = 0;
        while k < self.assembly.modes.len() {
            let mode = &mut self.assembly.modes[k];
            if mode.certificate.is_some() {
                k += 1;
                continue;
            }
            let kind = if mode.real {
                let q = mode.unknowns.map(|z| z.re);
                match nature(self.closed, &q) {
                    Nature::Unresolved => self_motion(self.closed, &q).map_or(Nature::Unresolved, Nature::SelfMotion),
                    // A curve may lie in a surface.
                    Nature::SelfMotion(_) => Nature::SelfMotion(self_motion(self.closed, &q).unwrap_or(1)),
                    isolated => isolated,
                }
            } else {
                nature(self.closed, &mode.unknowns)
            };
            match kind {
                Nature::SelfMotion(found) => {
                    dimension = dimension.max(found);
                    self.assembly.modes.swap_remove(k);
                }
                Nature::Isolated(multiplicity) => {
                    mode.multiplicity = multiplicity;
                    k += 1;
                }
                Nature::Unresolved => {
                    mode.multiplicity = 0;
                    k += 1;
                }
            }
        }
        self.assembly.self_motion = dimension;
    }
}

/// What became of one root.
struct RootOutcome {
    /// Every candidate of the root closed.
    settled: bool,
    /// A family of solutions belongs to the root.
    unresolved: bool,
    /// The kernel has more than one dimension.
    shared: bool,
    /// How far from that it is.
    separation: f64,
}

/// The pencil of a cut with its hidden unknown turned by an offset, its leading matrix factored.
struct Shifted {
    pencil: Pencil<f64>,
    hidden: Hidden,
    offset: (f64, f64),
    factors: [[f64; 8]; 8],
    order: [usize; 8],
    /// Smallest over largest pivot of the leading matrix.
    quality: f64,
}

impl Shifted {
    /// The first of four offsets whose leading matrix is good, else the best.
    fn best(equations: &Bilinear<f64>, hidden: Hidden) -> Self {
        let mut best: Option<Self> = None;
        for k in 0..4 {
            // No multiple of a right angle, where roots of real mechanisms like to sit.
            let (sin, cos) = (0.4 + 0.25 * TAU * f64::from(k)).sin_cos();
            let pencil = pencil(&offset(equations, hidden, &cos, &sin), hidden);
            let mut factors = pencil.coefficients[2];
            let (quality, order) = dense::factor(&mut factors);
            if best.as_ref().is_none_or(|b| quality > b.quality) {
                best = Some(Self { pencil, hidden, offset: (cos, sin), factors, order, quality });
            }
            if quality > limits::GOOD_LEADING {
                break;
            }
        }
        best.expect("four offsets were tried")
    }
}

impl Shifted {
    /// `A2^-1 A0` and `A2^-1 A1`; `None` for a singular leading matrix.
    fn monic(&self) -> Option<([[f64; 8]; 8], [[f64; 8]; 8])> {
        let [a0, a1, _] = &self.pencil.coefficients;
        let divided = |a: &[[f64; 8]; 8]| dense::solve(&self.factors, &self.order, a);
        (self.quality > limits::LEADING).then(|| (divided(a0), divided(a1)))
    }
}

impl Pencil<f64> {
    /// The pencil at a root, divided by `1 + |x|^2` so that large roots do not overflow.
    fn at_root<S: Scalar>(&self, x: S) -> [[S; 8]; 8] {
        let scale = 1.0 / (1.0 + x.to_complex().norm_sqr());
        let (square, linear) = (x.mul(&x).times(scale), x.times(scale));
        let [a0, a1, a2] = &self.coefficients;
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                square.times(a2[i][j]).add(&linear.times(a1[i][j])).add(&S::from_f64(scale * a0[i][j]))
            })
        })
    }
}

/// How much rounding errors may grow round the loop: 1 for real unknowns, the largest product of norms for complex
/// ones, which large imaginary parts make large.
fn growth<S: Number>(at: &Closure<S>, real: bool) -> f64 {
    if real { 1.0 } else { at.norms.iter().map(|n| n.before * n.step * n.behind).fold(1.0, f64::max) }
}

/// An angle in (-pi, pi].
#[must_use]
pub fn wrapped(angle: f64) -> f64 {
    let mut x = angle % TAU;
    if x > PI {
        x -= TAU;
    } else if x <= -PI {
        x += TAU;
    }
    x
}

/// The largest difference of two unknowns, angles modulo 2 pi.
#[must_use]
pub fn distance(variables: &[Variable; 6], a: &Six<Complex<f64>>, b: &Six<Complex<f64>>) -> f64 {
    let mut largest = 0.0_f64;
    for k in 0..6 {
        let mut difference = a[k] - b[k];
        if variables[k] == Variable::Rotation {
            difference.re = wrapped(difference.re);
        }
        largest = largest.max(difference.re.abs()).max(difference.im.abs());
    }
    largest
}
