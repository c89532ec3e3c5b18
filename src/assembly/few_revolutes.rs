//! Loops with three or four rotations: one small polynomial replaces a pencil of size 8.

use super::limits;
use super::search::{Family, RootOutcome, Search};
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::ring::Ring;
use crate::certify::{exponential, exponential_pair, small_turn};
use crate::elimination::cut::Hidden;
use crate::elimination::opposite_axes::OppositeAxes;
use crate::elimination::separated::Plan;
use crate::elimination::spherical_four_bar::{Equations, Form, FourBar};
use crate::elimination::spherical_triangle::{Triangle, triangle};
use crate::kinematics::link_form::LinkForm;
use crate::solve::biquadratic;
use crate::solve::dense;
use crate::solve::newton::Six;
use crate::solve::scalar::{Number, Scalar};
use crate::solve::separated::{SeparatedRoots, both_roots, unshifted};
use num_complex::Complex;

impl Search<'_> {
    /// Admits both solutions of a spherical triangle.
    pub fn triangle(&mut self) {
        let Some(form) = LinkForm::of(self.closed) else { return };
        let triangle = triangle(&form);
        let [constant, cos, sin] = triangle.equation;
        let amplitude = cos.hypot(sin);
        self.assembly.tries += 1;
        if !(amplitude > limits::PARALLEL) {
            // Two axes are parallel: the third one either makes the required angle with them or does not.
            self.assembly.all_resolved = constant.abs() > limits::PARALLEL;
            return;
        }
        // The angle is turned so that the equation reads `constant + amplitude' cos q' = 0`, which keeps both roots finite.
        let turned = -amplitude.copysign(constant);
        let square = (amplitude - constant.abs()) / (amplitude + constant.abs());
        let root = Complex::new(square, 0.0).sqrt();
        let roots = OfTriangle { triangle, offset: (cos / turned, sin / turned) };
        let mut family = InLinkForm { form: &form, complex: None, roots };
        self.assembly.all_resolved = self.all_roots(&mut family, &[root, -root]);
    }

    /// Admits the eight solutions of a spherical four-bar whose translations have to bridge the links. It starts from the
    /// best link and goes on to the others until the search is done.
    pub fn four_bars(&mut self, most: &dyn Fn(usize) -> usize) {
        let Some(form) = LinkForm::of(self.closed) else { return };
        if self.opposite_axes(&form) {
            return;
        }
        let mut bases = [0, 1, 2, 3];
        bases.sort_by(|&a, &b| form.twist(b + 2).0.total_cmp(&form.twist(a + 2).0));
        let bars = bases.into_iter().filter(|base| form.twist(base + 2).0 > limits::PARALLEL);
        for bar in bars.filter_map(|base| FourBar::new(&form, base)) {
            let equations = bar.equations();
            for hidden in [Hidden::First, Hidden::Second] {
                let Some(found) = biquadratic::roots(&equations, hidden) else { continue };
                self.assembly.tries += 1;
                let (base, offset) = (bar.base, found.offset);
                let roots = OfFourBar { form: &form, base, hidden, offset, equations: &equations };
                let mut family = InLinkForm { form: &form, complex: None, roots };
                let all_resolved = self.all_roots(&mut family, &found.roots);
                self.assembly.all_resolved |= all_resolved;
                if self.done(most, all_resolved) {
                    return;
                }
            }
        }
    }

    /// Admits the four solutions of a loop whose translations run along two opposite axes. Returns whether they do and every
    /// root of the quartic was resolved.
    fn opposite_axes(&mut self, form: &LinkForm<f64, 4, 2>) -> bool {
        let Some(axes) = OppositeAxes::of(form, limits::ALONG) else { return false };
        let equations = axes.equations(form);
        if matches!(equations.plan(limits::REACH_DEPENDENT), Plan::Apart { .. }) {
            return false;
        }
        let Some(found) = SeparatedRoots::of(&equations, limits::REACH_DEPENDENT) else { return false };
        self.assembly.tries += 1;
        let mut family = InLinkForm { form, complex: None, roots: OfOppositeAxes { axes, found: &found } };
        self.assembly.all_resolved = self.all_roots(&mut family, found.roots());
        self.assembly.all_resolved
    }

    /// Computes the translations at these rotations and admits the loop.
    fn admit_rotations<S: Scalar, const RHO: usize, const TAU: usize>(
        &mut self,
        form: &LinkForm<S, RHO, TAU>,
        rotations: &[(S, S); RHO],
    ) -> Bridged {
        let slides = form.slides_at(rotations);
        let dependent = !(slides.independence > limits::DEPENDENT);
        let Some(values) = slides.values else {
            return if slides.gap > limits::DEPENDENT { Bridged::Never } else { Bridged::Family };
        };
        let mut start: Six<S> = [S::zero(); 6];
        for (&unknown, &(cos, sin)) in form.rotations.iter().zip(rotations) {
            start[unknown] = S::angle_of(cos, sin);
        }
        for (slide, value) in form.slides.iter().zip(values) {
            start[slide.unknown] = value;
        }
        match (self.admit(&start), dependent) {
            (true, _) => Bridged::Closed,
            (false, true) if slides.gap > limits::DEPENDENT => Bridged::Never,
            (false, true) => Bridged::Family,
            (false, false) => Bridged::Open,
        }
    }
}

/// Result of solving for the translations at given rotations.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Bridged {
    /// They close the loop.
    Closed,
    /// They should close the loop, but did not.
    Open,
    /// They are dependent and cannot close the loop.
    Never,
    /// They are dependent and close the loop in a continuum of ways.
    Family,
}

/// The roots of one elimination, with a handler for real and one for complex roots.
trait Roots<const RHO: usize, const TAU: usize> {
    fn one<S: Scalar>(&self, form: &LinkForm<S, RHO, TAU>, search: &mut Search<'_>, x: S) -> RootOutcome;
}

/// The roots of a loop in link form, whose complex copy is made when the first complex root asks for it.
struct InLinkForm<'a, T, const RHO: usize, const TAU: usize> {
    form: &'a LinkForm<f64, RHO, TAU>,
    complex: Option<LinkForm<Complex<f64>, RHO, TAU>>,
    roots: T,
}

impl<T: Roots<RHO, TAU>, const RHO: usize, const TAU: usize> Family for InLinkForm<'_, T, RHO, TAU> {
    fn real(&mut self, search: &mut Search<'_>, x: f64) -> RootOutcome {
        self.roots.one(self.form, search, x)
    }

    fn complex(&mut self, search: &mut Search<'_>, x: Complex<f64>) -> RootOutcome {
        if self.complex.is_none() {
            self.complex = self.form.map(|x| Some(Complex::from(*x)));
        }
        let one = |form: &_| self.roots.one(form, search, x);
        self.complex.as_ref().map_or_else(RootOutcome::nothing, one)
    }
}

/// The roots of a spherical triangle.
struct OfTriangle {
    triangle: Triangle<f64>,
    offset: (f64, f64),
}

impl Roots<3, 3> for OfTriangle {
    fn one<S: Scalar>(&self, form: &LinkForm<S, 3, 3>, search: &mut Search<'_>, x: S) -> RootOutcome {
        let Some(known) = unshifted(x, self.offset) else { return RootOutcome::nothing() };
        let triangle = Triangle { dropped: self.triangle.dropped, equation: self.triangle.equation.map(S::from_f64) };
        let Some(rotations) = triangle.rotations(form, &known) else {
            return RootOutcome { unresolved: true, ..RootOutcome::nothing() };
        };
        let bridged = search.admit_rotations(form, &rotations);
        RootOutcome {
            settled: matches!(bridged, Bridged::Closed | Bridged::Never),
            unresolved: bridged == Bridged::Family,
            ..RootOutcome::nothing()
        }
    }
}

/// The roots of a spherical four-bar with two translations.
struct OfFourBar<'a> {
    form: &'a LinkForm<f64, 4, 2>,
    base: usize,
    hidden: Hidden,
    offset: (f64, f64),
    equations: &'a Equations<f64>,
}

fn size<S: Scalar>(values: &[S]) -> f64 {
    values.iter().map(|x| x.to_complex().norm_sqr()).sum::<f64>().sqrt()
}

impl Roots<4, 2> for OfFourBar<'_> {
    fn one<S: Scalar>(&self, form: &LinkForm<S, 4, 2>, search: &mut Search<'_>, x: S) -> RootOutcome {
        let Some(known) = unshifted(x, self.offset) else { return RootOutcome::nothing() };
        let Some(bar) = FourBar::new(form, self.base) else { return RootOutcome::nothing() };
        let angle = [S::one(), known.0, known.1];
        let row = |form: &[[f64; 3]; 3]| -> [S; 3] {
            std::array::from_fn(|l| {
                (0..3).fold(S::zero(), |sum, k| {
                    let coefficient = if self.hidden == Hidden::First { form[k][l] } else { form[l][k] };
                    sum.add(&angle[k].times(coefficient))
                })
            })
        };
        let (f, g) = (row(&self.equations.f), row(&self.equations.g));
        let minor = |i: usize, j: usize| f[i].mul(&g[j]).sub(&f[j].mul(&g[i]));
        let (n1, n2, n3) = (minor(2, 0), minor(0, 1), minor(1, 2));
        let norms = [&self.equations.f, &self.equations.g].map(|form| size(form.as_flattened()));
        let scale = norms[0] * norms[1] * size(&angle).powi(2);
        let shared = !(n3.size() > limits::SHARED_ANGLE * scale);
        let mut others = [None; 3];
        if n3.size() > 1e-14 * scale {
            others[0] = n3.inverse().map(|inverse| (n1.mul(&inverse), n2.mul(&inverse)));
        }
        if shared {
            // Two solutions may share the hidden angle; one of the rows may vanish there altogether.
            let row = if size(&f) * norms[1] > size(&g) * norms[0] { &f } else { &g };
            if let Some([one, two]) = both_roots(row) {
                (others[1], others[2]) = (Some(one), Some(two));
            }
        }
        let mut outcome = RootOutcome { shared, ..RootOutcome::nothing() };
        for other in others.into_iter().flatten() {
            let (a, b) = if self.hidden == Hidden::First { (known, other) } else { (other, known) };
            let mut bridged = search.admit_rotations(form, &bar.rotations(&a, &b));
            if bridged != Bridged::Closed && !S::REAL {
                // Far from the real numbers the translations lose their digits, so better angles are used if there are any.
                let angles = [a, b].map(|(cos, sin)| S::angle_of(cos, sin).to_complex());
                let start = refined(self.form, self.base, angles);
                if start.is_some_and(|start| search.admit(&start)) {
                    bridged = Bridged::Closed;
                }
            }
            outcome.settled |= matches!(bridged, Bridged::Closed | Bridged::Never);
            outcome.unresolved |= bridged == Bridged::Family;
        }
        outcome
    }
}

/// The roots of a loop whose translations run along two opposite axes.
struct OfOppositeAxes<'a> {
    axes: OppositeAxes,
    found: &'a SeparatedRoots,
}

impl Roots<4, 2> for OfOppositeAxes<'_> {
    fn one<S: Scalar>(&self, form: &LinkForm<S, 4, 2>, search: &mut Search<'_>, x: S) -> RootOutcome {
        let mut outcome = RootOutcome::nothing();
        for [[_, c, s], [_, c2, s2]] in self.found.monomials(x).into_iter().flatten() {
            let Some(rotations) = self.axes.rotations(form, &(c, s), &(c2, s2)) else {
                outcome.unresolved = true;
                continue;
            };
            let bridged = search.admit_rotations(form, &rotations);
            outcome.settled |= matches!(bridged, Bridged::Closed | Bridged::Never);
            outcome.unresolved |= bridged == Bridged::Family;
        }
        outcome
    }
}

type Quad = Complex<DoubleDouble>;

/// Returns all unknowns from two angles of a spherical four-bar, improved by Newton's method on its two equations in
/// double-double arithmetic.
fn refined(form: &LinkForm<f64, 4, 2>, base: usize, angles: [Complex<f64>; 2]) -> Option<Six<Complex<f64>>> {
    let form = form.map(|x| Some(Quad { re: DoubleDouble::from(*x), im: DoubleDouble::zero() }))?;
    let bar = FourBar::new(&form, base)?;
    let Equations { f, g } = bar.equations();
    let mut state = angles.map(exponential);
    let mut before = f64::INFINITY;
    for _ in 0..12 {
        let (a, b) = (exponential_pair(state[0])?, exponential_pair(state[1])?);
        let (at_a, at_b) = ([Quad::one(), a.0, a.1], [Quad::one(), b.0, b.1]);
        let slope = |[_, cos, sin]: [Quad; 3]| [Quad::zero(), sin.neg(), cos];
        let value = |form: &Form<Quad>, a: &[Quad; 3], b: &[Quad; 3]| {
            (0..3).fold(Quad::zero(), |sum, k| {
                let row = (0..3).fold(Quad::zero(), |sum, l| sum.add(&form[k][l].mul(&b[l])));
                sum.add(&a[k].mul(&row))
            })
        };
        let jacobian = [&f, &g].map(|form| [value(form, &slope(at_a), &at_b), value(form, &at_a, &slope(at_b))]);
        let inverse = dense::inverse(&jacobian)?;
        let step = dense::times(&inverse, &[&f, &g].map(|form| value(form, &at_a, &at_b)));
        let size = step[0].bound().max(step[1].bound());
        if !(size < 0.3) || !(size < before || size < 1e-20) {
            return None;
        }
        if size < 1e-24 {
            let rotations = bar.rotations(&a, &b);
            let values = form.slides_at(&rotations).values?;
            let plain = |z: Quad| Complex::new(z.re.to_f64(), z.im.to_f64());
            let mut start: Six<Complex<f64>> = [Complex::new(0.0, 0.0); 6];
            for (&unknown, &(cos, sin)) in form.rotations.iter().zip(&rotations) {
                start[unknown] = Scalar::angle_of(plain(cos), plain(sin));
            }
            for (slide, value) in form.slides.iter().zip(values) {
                start[slide.unknown] = plain(value);
            }
            return Some(start);
        }
        before = size;
        for (w, d) in state.iter_mut().zip(step) {
            *w = w.mul(&small_turn(d.neg()));
        }
    }
    None
}
