//! Proofs in higher precision, for solutions that f64 cannot prove: badly conditioned ones, and those with large imaginary
//! parts.
//!
//! Angles are represented as `w = e^(iq)`: any number but 0 is an exact angle in this form.

use super::{ALIKE, Certificate, certificate, weighted_certificate};
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::elementary::{exp, sin_cos};
use crate::algebra::ring::{Field, Ring};
use crate::elimination::cut::Cut;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::{Motion, cross};
use crate::solve::dense::{inverse, norm, times};
use crate::solve::newton::{Closure, Six, behind_step, closure_at, reach};
use crate::solve::scalar::{Extended, Number, Scalar, extended, narrowed};
use num_complex::Complex;

/// Distance between a stored constant's nearest rigid motion and the constant before rounding, in parts of u and of 1
/// or the longest coordinate: entries are off by u, so are those of the nearest rotation, together by 6 u at most.
const CONSTANT_ROUNDINGS: f64 = 8.0;
/// A step of this size, over the longest translation, is the last one for stored constants: their rounding moves the solution by more.
const STORED_SETTLED: f64 = 1e-20;
/// The same for exact constants: what is left is rounding of double-double arithmetic, in well conditioned places.
const EXACT_SETTLED: f64 = 1e-26;
/// A solution that the rounding of the constants may have moved farther than this, over its longest translation, gets no
/// certificate.
const MOST_DRIFT: f64 = 1e-6;

type Quad = Complex<DoubleDouble>;
type Square<R> = [Six<Complex<R>>; 6];
/// The closure at a point, the inverse of its Jacobian, and the product of that with the residual.
type Step<R> = (Closure<Complex<R>>, Square<R>, Six<Complex<R>>);
/// The data of the motions of a loop, per unknown: cosine and sine of an angle, or a distance and 0.
type Pairs<R> = [(Complex<R>, Complex<R>); 6];

/// Returns `e^(iq)` of an angle known in f64. Any number but 0 is an exact angle in this form, and no cosine is needed in
/// higher precision.
#[must_use]
pub fn exponential<R: Extended>(angle: Complex<f64>) -> Complex<R> {
    // Computed from cosine and sine it would cancel for large imaginary parts.
    let (sin, cos) = sin_cos(angle.re);
    let w = Complex::new(cos, sin) * exp(-angle.im);
    // Overflow is mapped to 0, which is not a valid e^(iq).
    if w.is_finite() { extended(w) } else { Complex::zero() }
}

/// Returns cosine and sine of an angle q given as `w = e^(iq)`; `None` for 0.
#[must_use]
pub fn exponential_pair<R: Extended>(w: Complex<R>) -> Option<(Complex<R>, Complex<R>)> {
    let back = w.inverse()?;
    // sin = (w - 1/w) / (2i)
    let difference = w.sub(&back).halved();
    Some((w.add(&back).halved(), Complex { re: difference.im, im: difference.re.neg() }))
}

/// Returns `e^(id)` to order 5: enough for a Newton step, after which w is as exact an angle as before.
#[must_use]
pub fn small_turn<R: Extended>(d: Complex<R>) -> Complex<R> {
    let turn = d.mul(&Complex { re: R::zero(), im: R::one() });
    let mut factor = Complex::<R>::one();
    for k in (1..=5).rev() {
        let term = turn.mul(&factor).times(R::from(1.0 / f64::from(k)));
        factor = Complex::<R>::one().add(&term);
    }
    factor
}

/// A solution refined and proved in higher precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refined {
    /// The unknowns, rounded from that precision.
    pub unknowns: Six<Complex<f64>>,
    /// Whether the solution is proved to be real: conjugation maps the ball of the proof into the larger one in which there
    /// is no other solution, and a single solution there is its own conjugate.
    pub real: bool,
    /// The certificate.
    pub certificate: Certificate,
    /// Row-sum condition number of the Jacobian.
    pub condition: f64,
}

/// A Newton iterate: angles as `e^(iq)`, and distances.
struct Approach<'a, R> {
    closed: &'a ClosedLoop<R>,
    state: Six<Complex<R>>,
    reach: f64,
}

impl<R: Extended> Approach<'_, R> {
    fn pairs(&self) -> Option<Pairs<R>> {
        let mut pairs = [(Complex::zero(), Complex::zero()); 6];
        for j in 0..6 {
            pairs[j] = match self.closed.variables[j] {
                Variable::Rotation => exponential_pair(self.state[j])?,
                Variable::Translation => (self.state[j], Complex::zero()),
            };
        }
        Some(pairs)
    }

    /// Subtracts a Newton step.
    fn step_back(&mut self, step: &Six<Complex<R>>) {
        for j in 0..6 {
            let d = step[j].neg();
            match self.closed.variables[j] {
                Variable::Rotation => self.state[j] = self.state[j].mul(&small_turn(d)),
                Variable::Translation => self.state[j] = self.state[j].add(&d),
            }
        }
    }

    /// Returns the unknowns in f64.
    fn unknowns(&self) -> Six<Complex<f64>> {
        std::array::from_fn(|j| {
            let z = narrowed(self.state[j]);
            match self.closed.variables[j] {
                Variable::Rotation => Complex::new(z.arg(), -z.norm().ln()),
                Variable::Translation => z,
            }
        })
    }

    /// Returns the Newton step from here, with the closure and the inverse of its Jacobian as `invert` computes it.
    fn newton(&self, pairs: &Pairs<R>, invert: impl Fn(&Square<R>) -> Option<Square<R>>) -> Option<Step<R>> {
        let here = closure_at::<Complex<R>>(self.closed, pairs);
        let inverse = invert(&here.jacobian)?;
        let step = times(&inverse, &here.residual);
        Some((here, inverse, step))
    }

    /// Returns the proved solution in f64.
    fn told(&self, proof: Certificate, condition: f64) -> Refined {
        let unknowns = self.unknowns();
        let off = |j: usize| printed_error(self.closed.variables[j], self.state[j], unknowns[j]);
        let certificate = rounded(proof, &unknowns, &std::array::from_fn(off));
        // The solution itself is tested, not its rounding.
        let imaginary = (0..6).map(|j| imaginary(self.closed.variables[j], self.state[j])).fold(0.0, f64::max);
        // The conjugate is a solution, too, at the same distance up to twice the imaginary parts of the midpoint.
        let real = imaginary <= proof.radius && proof.radius + 2.1 * imaginary <= proof.isolation;
        let unknowns = if real { unknowns.map(|z| z.re.into()) } else { unknowns };
        Refined { unknowns, real, certificate, condition }
    }
}

/// Returns the certificate of the unknowns rounded to f64, each off by `off`. A few roundings of the unknown itself do
/// not count in `proved`.
fn rounded<S: Scalar>(proof: Certificate, unknowns: &Six<S>, off: &Six<f64>) -> Certificate {
    let roundings = |x: &S| 4.0 * f64::EPSILON * x.bound().max(1.0);
    let excess = unknowns.iter().zip(off).map(|(x, off)| (off - roundings(x)).max(0.0)).fold(0.0, f64::max);
    let proved = proof.radius + excess;
    Certificate { radius: proved + unknowns.iter().map(roundings).fold(0.0, f64::max), proved, ..proof }
}

/// Bounds the error of an unknown rounded to f64, an angle q given as e^(iq), for any functions that computed it: e^(iq)
/// of the f64 is computed with 16 roundings at most and compared.
fn printed_error<R: Extended>(variable: Variable, state: Complex<R>, printed: Complex<f64>) -> f64 {
    const ROUNDINGS: f64 = 16.0;
    match variable {
        // The result is the nearest f64 or a neighbour of it.
        Variable::Translation => f64::EPSILON * printed.bound(),
        Variable::Rotation => {
            let (sin, cos) = sin_cos(printed.re);
            let size = exp(-printed.im);
            let Some(back) = extended::<R>(Complex::new(cos, sin) * size).inverse() else { return f64::INFINITY };
            let ratio = state.mul(&back).sub(&Complex::one()).bound();
            // |log (1 + x)| <= 1.1 |x|
            let error = 1.1 * (ratio + ROUNDINGS * f64::UNIT_ROUNDOFF);
            if error < 0.01 { error } else { f64::INFINITY }
        }
    }
}

/// Error bounds of the constants of a loop stored in f64: one rounding of the entries, and this much more.
#[derive(Clone, Copy)]
struct Data {
    /// Bounds on the coordinates of the twist of the error of the nearest rigid motion of a constant.
    twists: Six<f64>,
}

impl Data {
    fn of(closed: &ClosedLoop<f64>, off: &Six<f64>) -> Self {
        let twist = |j: usize| {
            let length = closed.constants[j].translation.iter().map(|x| x.abs()).fold(1.0, f64::max);
            CONSTANT_ROUNDINGS * f64::UNIT_ROUNDOFF * length + 4.0 * off[j]
        };
        Self { twists: std::array::from_fn(twist) }
    }

    /// Returns the errors of the loop that begins behind the first k constants.
    fn behind(self, k: usize) -> Self {
        Self { twists: std::array::from_fn(|j| self.twists[(j + k) % 6]) }
    }

    /// Adds these errors to a closure.
    fn note<S: Number>(self, at: &mut Closure<S>) {
        for j in 0..6 {
            let after = if j < 5 { at.norms[j + 1].before } else { 1.1 };
            // A row of a twist has three entries; the fourth part is for its second order.
            at.data_error += 4.0 * self.twists[j] * after * at.norms[j].behind;
        }
    }

    /// Bounds `|A (F' - F)|` for all F' within the errors of the constants. A constant off by a factor 1 + X behind the frame
    /// P moves E by a factor `1 + P X P^-1`: six columns `A Ad_P` to first order, in f64, and norms for the second order
    /// and for the roundings of P.
    fn moved<S: Number>(self, at: &Closure<S>, view: &View, weights: &Six<f64>) -> f64 {
        let mut sums = [0.0_f64; 6];
        let mut frame: Motion<Complex<f64>> = Motion::identity();
        for j in 0..6 {
            frame = behind_step(&frame, view.closed.variables[j], view.pairs[j], &view.closed.constants[j]);
            for axis in 0..3 {
                // A rotation about this axis of the frame, and a translation along it.
                let direction: [Complex<f64>; 3] = std::array::from_fn(|i| frame.rotation[i][axis]);
                let moment = cross(&frame.translation, &direction);
                let part =
                    |from: &[Complex<f64>], v: &[Complex<f64>; 3]| from[0] * v[0] + from[1] * v[1] + from[2] * v[2];
                for (sum, from) in sums.iter_mut().zip(&view.inverse) {
                    let turn = part(&from[..3], &direction) + part(&from[3..], &moment);
                    *sum += self.twists[j] * (turn.bound() + part(&from[3..], &direction).bound());
                }
            }
        }
        let norm = view.inverse.iter().zip(weights).map(|(row, w)| row.iter().map(|x| x.bound()).sum::<f64>() / w);
        let first = sums.iter().zip(weights).map(|(sum, w)| sum / w).fold(0.0, f64::max);
        let roundings = 70.0 * f64::UNIT_ROUNDOFF * at.norms.iter().map(|n| n.before * n.step * n.behind).sum::<f64>();
        let second = at.data_error * (2.0 * at.data_error + 8.0 * at.defect + 4.0 * roundings);
        1.01 * (first + norm.fold(0.0, f64::max) * second)
    }
}

/// A loop, a point of it and the approximate inverse of its Jacobian there, in f64.
struct View {
    closed: ClosedLoop<f64>,
    pairs: [(Complex<f64>, Complex<f64>); 6],
    inverse: [Six<Complex<f64>>; 6],
}

impl View {
    fn of<S: Number>(
        closed: &ClosedLoop<S::Real>,
        pairs: &[(S, S); 6],
        inverse: &[Six<S>; 6],
        narrow: impl Fn(S) -> Complex<f64>,
    ) -> Self {
        let constant = |motion: &Motion<S::Real>| {
            let entry = |x: &S::Real| narrow(S::from_real(*x)).re;
            Motion {
                rotation: motion.rotation.each_ref().map(|row| row.each_ref().map(entry)),
                translation: motion.translation.each_ref().map(entry),
            }
        };
        Self {
            closed: ClosedLoop { variables: closed.variables, constants: closed.constants.each_ref().map(constant) },
            pairs: pairs.map(|(x, y)| (narrow(x), narrow(y))),
            inverse: inverse.map(|row| row.map(&narrow)),
        }
    }
}

/// Proves a point of a loop whose constants have these errors.
fn of_stored<S: Number>(here: &mut Closure<S>, inverse: &[Six<S>; 6], data: Data, view: &View) -> Option<Certificate> {
    data.note(here);
    let moved = data.moved(here, view, &ALIKE);
    weighted_certificate(here, inverse, &ALIKE, Some(moved))
}

/// Returns the inverse of a matrix in f64 accuracy.
fn rough_inverse<R: Extended>(matrix: &Square<R>) -> Option<Square<R>> {
    let inverse = inverse(&matrix.map(|row| row.map(narrowed)))?;
    let is_finite = inverse.as_flattened().iter().all(|x| x.is_finite());
    is_finite.then(|| inverse.map(|row| row.map(extended)))
}

/// Proves unknowns known in f64 in double-double arithmetic, for a loop whose constants were rounded once.
#[must_use]
pub fn refined_certificate(closed: &ClosedLoop<f64>, unknowns: &Six<Complex<f64>>) -> Option<Refined> {
    refined_certificate_of(closed, unknowns, 0.0)
}

/// As [`refined_certificate`]; the last constant may also be off by a matrix of row-sum norm `off` beyond its rounding.
///
/// The point belongs to the loop whose constants are the rigid motions nearest to the stored ones. The error of these is
/// part of the proof, which holds for all loops with constants within it. If that error alone moves the solution by more than a
/// small amount, there is no certificate.
#[must_use]
pub fn refined_certificate_of(closed: &ClosedLoop<f64>, unknowns: &Six<Complex<f64>>, off: f64) -> Option<Refined> {
    let data = Data::of(closed, &[0.0, 0.0, 0.0, 0.0, 0.0, off]);
    let precise = ClosedLoop { variables: closed.variables, constants: closed.constants.each_ref().map(rigid) };
    let real = || refined_real(&precise, &unknowns.map(|z| z.re), Some(data));
    let is_real = unknowns.iter().all(|z| z.im == 0.0);
    (if is_real { real() } else { None }).or_else(|| refined_complex(&precise, unknowns, Some(data)))
}

/// Whether Newton's method goes on, has arrived, or goes astray. It has to converge from its start, not to wander.
#[derive(Debug)]
struct Convergence {
    before: f64,
    may_stall: bool,
    settled: f64,
}

impl Convergence {
    /// Steps below this are rounding errors of double-double arithmetic, also where a Jacobian is nearly singular.
    const ROUNDING: f64 = 1e-12;

    fn of(data: Option<Data>) -> Self {
        Self {
            before: f64::INFINITY,
            may_stall: true,
            settled: if data.is_some() { STORED_SETTLED } else { EXACT_SETTLED },
        }
    }

    /// Returns whether a step of this size was the last one; `None` where the method does not converge.
    fn has_arrived(&mut self, size: f64) -> Option<bool> {
        let stalls = !(size < 0.5 * self.before);
        // Near a singular position the first step corrects the rounding of the start alone, and the second one is as long.
        let wanders = stalls && size > Self::ROUNDING;
        if !(size < 0.3) || (wanders && !self.may_stall) {
            return None;
        }
        self.may_stall &= !wanders;
        self.before = size;
        Some(size < self.settled || (stalls && !wanders))
    }
}

/// Proves unknowns known in f64 in complex arithmetic. Without `data` the constants are exact.
fn refined_complex(
    precise: &ClosedLoop<DoubleDouble>,
    unknowns: &Six<Complex<f64>>,
    data: Option<Data>,
) -> Option<Refined> {
    let state: Six<Quad> = std::array::from_fn(|j| match precise.variables[j] {
        Variable::Rotation => exponential(unknowns[j]),
        Variable::Translation => extended(unknowns[j]),
    });
    let mut at = Approach { closed: precise, state, reach: reach(&precise.variables, unknowns) };
    let mut convergence = Convergence::of(data);
    for round in 0..12 {
        let pairs = at.pairs()?;
        let (mut here, inverse, step) = at.newton(&pairs, rough_inverse)?;
        let size = step.iter().map(|x| x.bound()).fold(0.0, f64::max) / at.reach;
        if convergence.has_arrived(size)? || round == 11 {
            let view = || View::of(precise, &pairs, &inverse, narrowed);
            let proof = match data {
                Some(data) => of_stored(&mut here, &inverse, data, &view()),
                None => certificate(&here, &inverse),
            };
            let proof = proof.or_else(|| in_any_frame(precise, &pairs, at.reach, data))?;
            let condition = norm(&here.jacobian) * norm(&inverse);
            return (proof.radius < MOST_DRIFT * at.reach).then(|| at.told(proof, condition));
        }
        at.step_back(&step);
    }
    None
}

/// Returns cosine and sine over their norm, which is nearly 1.
fn on_circle(cos: DoubleDouble, sin: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    // 1/sqrt(1 + e) = 1 - e/2 + 3 e^2/8; the remainder is less than the rounding that the proof allows for.
    let off = cos.mul(&cos).add(&sin.mul(&sin)).sub(&DoubleDouble::one());
    let bend = DoubleDouble::from(0.375).mul(&off).sub(&DoubleDouble::from(0.5));
    let scale = DoubleDouble::one().add(&off.mul(&bend));
    (cos.mul(&scale), sin.mul(&scale))
}

/// As [`refined_certificate_of`] for a real solution in real arithmetic alone, and in the frame of the loop.
#[must_use]
pub fn refined_real_of(closed: &ClosedLoop<f64>, unknowns: &Six<f64>, off: f64) -> Option<Refined> {
    let precise = ClosedLoop { variables: closed.variables, constants: closed.constants.each_ref().map(rigid) };
    refined_real(&precise, unknowns, Some(Data::of(closed, &[0.0, 0.0, 0.0, 0.0, 0.0, off])))
}

/// Proves unknowns known in f64 for a loop of constants that are known to double-double rounding.
#[must_use]
pub fn refined_exactly(closed: &ClosedLoop<DoubleDouble>, unknowns: &Six<Complex<f64>>) -> Option<Refined> {
    let is_real = unknowns.iter().all(|z| z.im == 0.0);
    if is_real { refined_real(closed, &unknowns.map(|z| z.re), None) } else { refined_complex(closed, unknowns, None) }
}

/// As [`refined_certificate`] for a real solution, in real arithmetic, at a third of the cost; `None` also if only
/// another frame would prove it. Without `data` the constants are exact.
fn refined_real(precise: &ClosedLoop<DoubleDouble>, unknowns: &Six<f64>, data: Option<Data>) -> Option<Refined> {
    let variables = precise.variables;
    let reach = reach(&variables, &unknowns.map(Complex::from));
    let mut pairs: [(DoubleDouble, DoubleDouble); 6] = std::array::from_fn(|j| match variables[j] {
        Variable::Rotation => on_circle(unknowns[j].cos().into(), unknowns[j].sin().into()),
        Variable::Translation => (unknowns[j].into(), DoubleDouble::zero()),
    });
    let mut convergence = Convergence::of(data);
    loop {
        let mut here = closure_at::<DoubleDouble>(precise, &pairs);
        let rough = inverse(&here.jacobian.map(|row| row.map(DoubleDouble::to_f64)))?;
        let rough = rough.map(|row| row.map(DoubleDouble::from));
        let step = times(&rough, &here.residual);
        let size = step.iter().map(|x| x.bound()).fold(0.0, f64::max) / reach;
        if convergence.has_arrived(size)? {
            let view = || View::of(precise, &pairs, &rough, |x| x.to_f64().into());
            let proof = match data {
                Some(data) => of_stored(&mut here, &rough, data, &view()),
                None => certificate(&here, &rough),
            }?;
            let values: Six<f64> = std::array::from_fn(|j| match (variables[j], pairs[j]) {
                (Variable::Rotation, (cos, sin)) => sin.to_f64().atan2(cos.to_f64()),
                (Variable::Translation, (distance, _)) => distance.to_f64(),
            });
            let printed = |j: usize| {
                let (re, im) = if variables[j] == Variable::Rotation { pairs[j] } else { (pairs[j].0, Ring::zero()) };
                printed_error(variables[j], Complex { re, im }, values[j].into())
            };
            return (proof.radius < MOST_DRIFT * reach).then(|| Refined {
                unknowns: values.map(Complex::from),
                real: true,
                certificate: rounded(proof, &values, &std::array::from_fn(printed)),
                condition: norm(&here.jacobian) * norm(&rough),
            });
        }
        for j in 0..6 {
            let d = step[j].neg();
            let (first, second) = pairs[j];
            pairs[j] = match variables[j] {
                Variable::Translation => (first.add(&d), second),
                Variable::Rotation => {
                    let turn = small_turn(Complex { re: d, im: DoubleDouble::zero() });
                    let (cos, sin) = (turn.re, turn.im);
                    on_circle(first.mul(&cos).sub(&second.mul(&sin)), second.mul(&cos).add(&first.mul(&sin)))
                }
            };
        }
    }
}

/// Maximum number of Newton steps from a start that is nearly as exact as its numbers.
const MOST_STEPS: usize = 8;
/// A step below this ends the iteration.
const SETTLED: f64 = 1e-30;

/// Proves, in the arithmetic of exact constants, cosines, sines and distances that nearly close the loop.
#[must_use]
pub fn from_pairs<R: Extended>(closed: &ClosedLoop<R>, pairs: &Pairs<R>) -> Option<Refined> {
    let i = Complex { re: R::zero(), im: R::one() };
    let mut state = [Complex::zero(); 6];
    for (j, (first, second)) in pairs.iter().enumerate() {
        state[j] = match closed.variables[j] {
            Variable::Rotation => {
                // The larger of e^(iq), e^(-iq) keeps its digits.
                let turned = second.mul(&i);
                let (plus, minus) = (first.add(&turned), first.sub(&turned));
                if plus.size() >= minus.size() { plus } else { minus.inverse()? }
            }
            Variable::Translation => *first,
        };
    }
    let reach = reach(&closed.variables, &state.map(narrowed));
    let mut at = Approach { closed, state, reach };
    for _ in 0..MOST_STEPS {
        let pairs = at.pairs()?;
        let (here, inverse, step) = at.newton(&pairs, inverse)?;
        let size = step.iter().map(|x| x.bound()).fold(0.0, f64::max) / at.reach;
        if !(size < 0.3) {
            return None;
        }
        if size < SETTLED
            && let Some(proof) = certificate(&here, &inverse).or_else(|| in_any_frame(closed, &pairs, at.reach, None))
        {
            let told = at.told(proof, norm(&here.jacobian) * norm(&inverse));
            // Unknowns without an f64 cannot be reported.
            return told.unknowns.iter().all(|z| z.is_finite()).then_some(told);
        }
        at.step_back(&step);
    }
    None
}

/// [`certificate`] with the loop opened in turn behind each of its joints, and translations measured by the reach of the
/// loop.
fn in_any_frame<R: Extended>(
    closed: &ClosedLoop<R>,
    pairs: &Pairs<R>,
    reach: f64,
    data: Option<Data>,
) -> Option<Certificate> {
    (0..6).find_map(|k| {
        let rotated = Cut { rotation: k, reversed: false }.of(closed);
        let pairs = std::array::from_fn(|j| pairs[(k + j) % 6]);
        let mut here = closure_at::<Complex<R>>(&rotated, &pairs);
        let weights = rotated.variables.map(|v| if v == Variable::Translation { reach } else { 1.0 });
        let data = data.map(|data| data.behind(k));
        data.inspect(|data| data.note(&mut here));
        let proof = |inverse: &Square<R>| {
            let view = || View::of(&rotated, &pairs, inverse, narrowed);
            let moved = data.map(|data| data.moved(&here, &view(), &weights));
            weighted_certificate(&here, inverse, &weights, moved)
        };
        // If f64 does not suffice, the inverse is computed in full precision.
        rough_inverse(&here.jacobian).and_then(|inverse| proof(&inverse)).or_else(|| proof(&inverse(&here.jacobian)?))
    })
}

/// Returns the size of the imaginary part of an unknown, an angle q given as e^(iq), accurate near 0.
fn imaginary<R: Extended>(variable: Variable, state: Complex<R>) -> f64 {
    match variable {
        Variable::Rotation => {
            let square = state.re.mul(&state.re).add(&state.im.mul(&state.im));
            let off = square.sub(&R::one()).to_f64().abs();
            // |log (1 + x)| <= 1.02 |x| for small x; large ones are larger than any radius.
            if off < 0.01 { 0.51 * off } else { f64::INFINITY }
        }
        Variable::Translation => state.im.to_f64().abs(),
    }
}

/// Returns the rigid motion nearest to a stored one: two steps of Newton's iteration for the polar factor.
fn rigid(stored: &Motion<f64>) -> Motion<DoubleDouble> {
    let mut rotation = stored.rotation.map(|row| row.map(DoubleDouble::from));
    for _ in 0..2 {
        // R (3 I - R^T R) / 2
        let gram = |i: usize, j: usize| {
            (0..3).fold(DoubleDouble::zero(), |sum, k| sum.add(&rotation[k][i].mul(&rotation[k][j])))
        };
        let factor: [[DoubleDouble; 3]; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let three = DoubleDouble::from(if i == j { 3.0 } else { 0.0 });
                three.sub(&gram(i, j)).halved()
            })
        });
        rotation = rotation.map(|row| times_row(&row, &factor));
    }
    Motion { rotation, translation: stored.translation.map(DoubleDouble::from) }
}

fn times_row(row: &[DoubleDouble; 3], matrix: &[[DoubleDouble; 3]; 3]) -> [DoubleDouble; 3] {
    std::array::from_fn(|j| (0..3).fold(DoubleDouble::zero(), |sum, k| sum.add(&row[k].mul(&matrix[k][j]))))
}
