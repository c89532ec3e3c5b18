//! Proofs in more digits: for solutions that f64 cannot prove, badly conditioned ones, and those with large imaginary
//! parts.
//!
//! Angles are known as `w = e^(iq)`: any number but 0 is an exact angle in this form.

use super::{Certificate, certificate, weighted_certificate};
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::ring::{Field, Ring};
use crate::elimination::cut::Cut;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::{Motion, cross};
use crate::solve::dense::{inverse, norm, times};
use crate::solve::newton::{Closure, Six, closure_at, coordinates, product, reach};
use crate::solve::scalar::{Extended, Number, Scalar, extended, narrowed};
use num_complex::Complex;

/// Roundings in a stored constant.
const CONSTANT_ROUNDINGS: f64 = 8.0;
/// A solution that the rounding of the constants may have moved farther than this, over its longest translation, is not
/// proved at all.
const MOST_DRIFT: f64 = 1e-6;

type Quad = Complex<DoubleDouble>;
type Square<R> = [Six<Complex<R>>; 6];
/// The closure at a point, the inverse of its Jacobian, and the product of that with the residual.
type Step<R> = (Closure<Complex<R>>, Square<R>, Six<Complex<R>>);
/// What enters the motions of a loop, unknown by unknown: cosine and sine, or a distance and 0.
type Pairs<R> = [(Complex<R>, Complex<R>); 6];

/// `e^(iq)` of an angle known in f64: any number but 0 is an exact angle in this form, and no cosine is needed in more
/// digits.
#[must_use]
pub fn exponential<R: Extended>(angle: Complex<f64>) -> Complex<R> {
    // From cosine and sine it would cancel for large imaginary parts.
    let (sin, cos) = angle.re.sin_cos();
    let w = Complex::new(cos, sin) * (-angle.im).exp();
    // What has no f64 is no angle, as 0 is none.
    if w.is_finite() { extended(w) } else { Complex::zero() }
}

/// Cosine and sine of an angle q given as `w = e^(iq)`; `None` for 0.
#[must_use]
pub fn exponential_pair<R: Extended>(w: Complex<R>) -> Option<(Complex<R>, Complex<R>)> {
    let back = w.inverse()?;
    // sin = (w - 1/w) / (2i)
    let difference = w.sub(&back).halved();
    Some((w.add(&back).halved(), Complex { re: difference.im, im: difference.re.neg() }))
}

/// `e^(id)` to order 5: good enough for a Newton step, after which w is as exact an angle as before.
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

/// A solution refined and proved in more digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refined {
    /// The unknowns, rounded from that precision.
    pub unknowns: Six<Complex<f64>>,
    /// Whether the solution is proved to be real: conjugation maps the ball of the proof into one three times as large,
    /// and a single solution there is its own conjugate.
    pub real: bool,
    /// The proof.
    pub certificate: Certificate,
    /// Row-sum condition number of the Jacobian.
    pub condition: f64,
}

/// A point on the way to a solution: angles as `e^(iq)`, and distances.
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

    /// Goes back by a step of Newton's method.
    fn step_back(&mut self, step: &Six<Complex<R>>) {
        for j in 0..6 {
            let d = step[j].neg();
            match self.closed.variables[j] {
                Variable::Rotation => self.state[j] = self.state[j].mul(&small_turn(d)),
                Variable::Translation => self.state[j] = self.state[j].add(&d),
            }
        }
    }

    /// The unknowns in f64.
    fn unknowns(&self) -> Six<Complex<f64>> {
        std::array::from_fn(|j| {
            let z = narrowed(self.state[j]);
            match self.closed.variables[j] {
                Variable::Rotation => Complex::new(z.arg(), -z.norm().ln()),
                Variable::Translation => z,
            }
        })
    }

    /// The step from here, with the closure and the inverse of its Jacobian as `invert` computes it.
    fn newton(&self, pairs: &Pairs<R>, invert: impl Fn(&Square<R>) -> Option<Square<R>>) -> Option<Step<R>> {
        let here = closure_at::<Complex<R>>(self.closed, pairs);
        let inverse = invert(&here.jacobian)?;
        let step = times(&inverse, &here.residual);
        Some((here, inverse, step))
    }

    /// What is proved of the solution, in f64, where the rounding of the constants cannot have moved it by more than
    /// `drift`.
    fn told(&self, proof: Certificate, condition: f64, drift: f64) -> Refined {
        let unknowns = self.unknowns();
        let certificate = rounded(proof, &unknowns, drift);
        // Judged by the solution itself, not by what its rounding left of it.
        let imaginary = (0..6).map(|j| imaginary(self.closed.variables[j], self.state[j])).fold(0.0, f64::max);
        let real = imaginary <= proof.radius && 3.0 * proof.radius <= proof.isolation;
        let unknowns = if real { unknowns.map(|z| z.re.into()) } else { unknowns };
        Refined { unknowns, real, certificate, condition }
    }
}

/// A proof of unknowns as it holds for their nearest f64.
fn rounded<S: Scalar>(proof: Certificate, unknowns: &Six<S>, drift: f64) -> Certificate {
    let largest = unknowns.iter().map(|x| x.bound()).fold(1.0, f64::max);
    let proved = proof.radius + drift;
    Certificate { radius: proved + 4.0 * f64::EPSILON * largest, proved, ..proof }
}

/// The inverse of a matrix, as good as f64 makes it.
fn rough_inverse<R: Extended>(matrix: &Square<R>) -> Option<Square<R>> {
    let inverse = inverse(&matrix.map(|row| row.map(narrowed)))?;
    let is_finite = inverse.as_flattened().iter().all(|x| x.is_finite());
    is_finite.then(|| inverse.map(|row| row.map(extended)))
}

/// A proof in double-double arithmetic from unknowns known in f64.
///
/// The proof is of the loop whose constants are the rigid motions nearest to the stored ones. How far the rounding of
/// those constants can have moved the solution is added to the radius, to first order; where that is no small amount
/// the solution is not proved.
#[must_use]
pub fn refined_certificate(closed: &ClosedLoop<f64>, unknowns: &Six<Complex<f64>>) -> Option<Refined> {
    if unknowns.iter().all(|z| z.im == 0.0)
        && let Some(refined) = refined_real(closed, &unknowns.map(|z| z.re))
    {
        return Some(refined);
    }
    let variables = closed.variables;
    let precise = ClosedLoop { variables, constants: closed.constants.each_ref().map(rigid) };
    let state: Six<Quad> = std::array::from_fn(|j| match variables[j] {
        Variable::Rotation => exponential(unknowns[j]),
        Variable::Translation => extended(unknowns[j]),
    });
    let mut at = Approach { closed: &precise, state, reach: reach(&variables, unknowns) };
    let mut before = f64::INFINITY;
    for round in 0..12 {
        let pairs = at.pairs()?;
        let (here, inverse, step) = at.newton(&pairs, rough_inverse)?;
        let size = step.iter().map(|x| x.bound()).fold(0.0, f64::max) / at.reach;
        // Newton's method has to converge from where it starts, not to wander.
        let stalls = !(size < 0.5 * before);
        if !(size < 0.3) || (stalls && size > 1e-12) {
            return None;
        }
        if size < 1e-26 || stalls || round == 11 {
            let proof = certificate(&here, &inverse).or_else(|| in_any_frame(&precise, &pairs, at.reach))?;
            let condition = norm(&here.jacobian) * norm(&inverse);
            let drift = drift(closed, &at.unknowns());
            return (drift < MOST_DRIFT * at.reach).then(|| at.told(proof, condition, drift));
        }
        before = size;
        at.step_back(&step);
    }
    None
}

/// Cosine and sine over their norm, which is nearly 1.
fn on_circle(cos: DoubleDouble, sin: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    // 1/sqrt(1 + e) = 1 - e/2 + 3 e^2/8; what is left over is less than the rounding that the proof allows for.
    let off = cos.mul(&cos).add(&sin.mul(&sin)).sub(&DoubleDouble::one());
    let bend = DoubleDouble::from(0.375).mul(&off).sub(&DoubleDouble::from(0.5));
    let scale = DoubleDouble::one().add(&off.mul(&bend));
    (cos.mul(&scale), sin.mul(&scale))
}

/// As [`refined_certificate`] for a real solution, in real numbers, which cost a third; `None` also where only another
/// frame would prove it.
fn refined_real(closed: &ClosedLoop<f64>, unknowns: &Six<f64>) -> Option<Refined> {
    let variables = closed.variables;
    let precise = ClosedLoop { variables, constants: closed.constants.each_ref().map(rigid) };
    let reach = reach(&variables, &unknowns.map(Complex::from));
    let mut pairs: [(DoubleDouble, DoubleDouble); 6] = std::array::from_fn(|j| match variables[j] {
        Variable::Rotation => on_circle(unknowns[j].cos().into(), unknowns[j].sin().into()),
        Variable::Translation => (unknowns[j].into(), DoubleDouble::zero()),
    });
    let mut before = f64::INFINITY;
    loop {
        let here = closure_at::<DoubleDouble>(&precise, &pairs);
        let rough = inverse(&here.jacobian.map(|row| row.map(DoubleDouble::to_f64)))?;
        let rough = rough.map(|row| row.map(DoubleDouble::from));
        let step = times(&rough, &here.residual);
        let size = step.iter().map(|x| x.bound()).fold(0.0, f64::max) / reach;
        let stalls = !(size < 0.5 * before);
        if !(size < 0.3) || (stalls && size > 1e-12) {
            return None;
        }
        if size < 1e-26 || stalls {
            let proof = certificate(&here, &rough)?;
            let values: Six<f64> = std::array::from_fn(|j| match (variables[j], pairs[j]) {
                (Variable::Rotation, (cos, sin)) => sin.to_f64().atan2(cos.to_f64()),
                (Variable::Translation, (distance, _)) => distance.to_f64(),
            });
            let drift = drift(closed, &values);
            return (drift < MOST_DRIFT * reach).then(|| Refined {
                unknowns: values.map(Complex::from),
                real: true,
                certificate: rounded(proof, &values, drift),
                condition: norm(&here.jacobian) * norm(&rough),
            });
        }
        before = size;
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

/// Steps of Newton's method from a start that is nearly as exact as its numbers.
const MOST_STEPS: usize = 8;
/// A step this small ends them.
const SETTLED: f64 = 1e-30;

/// A proof in the arithmetic of exact constants, from cosines, sines and distances that nearly close the loop.
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
            && let Some(proof) = certificate(&here, &inverse).or_else(|| in_any_frame(closed, &pairs, at.reach))
        {
            let told = at.told(proof, norm(&here.jacobian) * norm(&inverse), 0.0);
            // Unknowns without an f64 cannot be told.
            return told.unknowns.iter().all(|z| z.is_finite()).then_some(told);
        }
        at.step_back(&step);
    }
    None
}

/// [`certificate`] with the loop opened in turn behind each of its joints, and translations measured by the reach of the
/// loop.
fn in_any_frame<R: Extended>(closed: &ClosedLoop<R>, pairs: &Pairs<R>, reach: f64) -> Option<Certificate> {
    (0..6).find_map(|k| {
        let rotated = Cut { rotation: k, reversed: false }.of(closed);
        let here = closure_at::<Complex<R>>(&rotated, &std::array::from_fn(|j| pairs[(k + j) % 6]));
        let weights = rotated.variables.map(|v| if v == Variable::Translation { reach } else { 1.0 });
        // Where f64 does not reach, an inverse in all digits does.
        let rough = rough_inverse(&here.jacobian).and_then(|inverse| weighted_certificate(&here, &inverse, &weights));
        rough.or_else(|| weighted_certificate(&here, &inverse(&here.jacobian)?, &weights))
    })
}

/// The size of the imaginary part of an unknown, an angle q given as e^(iq); near 0 to the precision of its numbers.
fn imaginary<R: Extended>(variable: Variable, state: Complex<R>) -> f64 {
    match variable {
        Variable::Rotation => {
            let square = state.re.mul(&state.re).add(&state.im.mul(&state.im));
            let off = square.sub(&R::one()).to_f64();
            0.5 * off.ln_1p().abs()
        }
        Variable::Translation => state.im.to_f64().abs(),
    }
}

/// How far the rounding of the constants can have moved a solution, to first order. A constant off by a twist x, a few
/// roundings in size, moves the unknowns by `J^-1 Ad_j x` with the frame of its step.
fn drift<S: Scalar>(closed: &ClosedLoop<f64>, unknowns: &Six<S>) -> f64 {
    let pairs: Six<(S, S)> = std::array::from_fn(|j| coordinates(closed.variables[j], unknowns[j]));
    let Some(inverse) = inverse(&closure_at(closed, &pairs).jacobian) else { return f64::INFINITY };
    let mut sum = 0.0;
    for count in 1..=6 {
        let frame: Motion<S> = product(closed, &pairs, count);
        let mut moved = [[S::zero(); 6]; 6];
        for axis in 0..3 {
            // A turn about this axis of the frame, and a shift along it.
            let direction: [S; 3] = std::array::from_fn(|i| frame.rotation[i][axis]);
            let moment = cross(&frame.translation, &direction);
            for (row, from) in moved.iter_mut().zip(&inverse) {
                for i in 0..3 {
                    row[axis] = row[axis].add(&from[i].mul(&direction[i])).add(&from[3 + i].mul(&moment[i]));
                    row[3 + axis] = row[3 + axis].add(&from[3 + i].mul(&direction[i]));
                }
            }
        }
        let length = closed.constants[count - 1].translation.iter().map(|x| x.abs()).fold(1.0, f64::max);
        sum += norm(&moved) * length;
    }
    CONSTANT_ROUNDINGS * f64::UNIT_ROUNDOFF * sum
}

/// The rigid motion nearest to a stored one: two steps of Newton's iteration for the polar factor.
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
