//! Proof of one mode: Newton-Kantorovich in the form of radii polynomials, every rounding error bounded.
//!
//! With the twists Z_j (4 x 4 matrices in the frame of the cut) the closure at unknowns q + h is
//! `E(q + h) = exp(h_1 Z_1) ... exp(h_6 Z_6) E(q)`, so that all its derivatives are bounded by the norms |Z_j|: second
//! ones in a ball of radius r by `(sum |Z_j|)^2 e^(r sum |Z_j|) |E|`. The same bound holds for complex unknowns. For an
//! approximate inverse A of the Jacobian and
//!
//! * `Y >= |A F(q)|`, the step,
//! * `Z0 >= |I - A F'(q)|`, the inexactness of A,
//! * `Z2 >= |A| (sum |Z_j|)^2 e^(r sum |Z_j|) |E|`, the curvature,
//!
//! every r with `Y + Z0 r + Z2 r^2 / 2 <= r` and `Z0 + Z2 r < 1` has exactly one solution of F = 0 in the ball of radius
//! r (largest coordinate) around q. F holds the translation and the skew part of the rotation of E; near E = I its zeros
//! are exactly the closures. \[Krawczyk1969\]
//!
//! Rounding: E is computed as a product of six steps. Step j leaves an error of at most `c u |before| |step|`, which the
//! steps behind it magnify by at most their norm. Constants of the loop count as known to a few roundings, so that the
//! proof covers the mechanism as given and not only as stored.

pub mod pose;

use crate::algebra::double_double::DoubleDouble;
use crate::algebra::ring::Ring;
use crate::elimination::cut::Cut;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::{Motion, cross};
use crate::solve::dense::{inverse, norm, times};
use crate::solve::newton::{Closure, Six, closure, closure_at, coordinates, product, reach};
use crate::solve::scalar::{Number, Scalar};
use num_complex::Complex;

/// What was proved of a mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certificate {
    /// Exactly one solution lies within this distance (largest coordinate) of the mode.
    pub radius: f64,
    /// And within this larger distance there is no other one.
    pub isolation: f64,
}

/// Roundings per step of the product: cosine and sine (2), their use (4), the product (6), all with room for complex
/// products (a factor of sqrt 8 on each operation), and the stored constant (32).
const ROUNDINGS: f64 = 70.0;
/// Roundings in a stored constant.
const CONSTANT_ROUNDINGS: f64 = 8.0;
/// A solution that the rounding of the constants may have moved farther than this, over its longest translation, is not
/// proved at all.
const MOST_DRIFT: f64 = 1e-6;
/// Margin on bounds that are themselves computed in f64.
const MARGIN: f64 = 1.01;

/// Bounds the rounding error of every entry of the closure: computed against exact, of the mechanism as given. Holds
/// near E = I.
#[must_use]
pub fn product_error<S: Number>(at: &Closure<S>) -> f64 {
    ROUNDINGS * S::UNIT_ROUNDOFF * at.norms.iter().map(|n| n.before * n.step * n.behind).sum::<f64>()
}

/// Bounds |E - I|, as a sum over a row.
fn off_identity<S: Number>(at: &Closure<S>) -> f64 {
    8.0 * at.defect + product_error(at)
}

/// Bounds the sum of the |Z_j|.
fn twists<S: Number>(at: &Closure<S>) -> f64 {
    MARGIN * at.norms.iter().map(|n| n.twist).sum::<f64>()
}

/// Bounds the error of the Jacobian, summed over a row: the derivative is L(Z_j E), from which `at.jacobian` differs by
/// |Z_j| |E - I|, and Z_j is computed from a product of steps.
#[must_use]
pub fn derivative_error<S: Number>(at: &Closure<S>) -> f64 {
    twists(at) * (2.0 * off_identity(at) + 4.0 * product_error(at))
}

/// Bounds how much faster than a distance the derivative changes, as the largest sum over a row, within `r` (largest
/// coordinate) of the unknowns.
#[must_use]
pub fn curvature<S: Number>(at: &Closure<S>, r: f64) -> f64 {
    let twists = twists(at);
    twists * twists * (r * twists).exp() * (1.0 + off_identity(at))
}

/// Proves that exactly one solution lies near these unknowns; `None` where that cannot be shown.
#[must_use]
pub fn certificate<S: Number>(at: &Closure<S>, approximate_inverse: &[Six<S>; 6]) -> Option<Certificate> {
    let product_error = product_error(at);
    if !(off_identity(at) < 1e-3) {
        return None;
    }
    let inverse_norm = norm(approximate_inverse) * MARGIN;
    // |A F| with the error of F and of the product A F.
    let step = times(approximate_inverse, &at.residual).into_iter().map(Number::bound).fold(0.0, f64::max);
    let residual = at.residual.iter().map(|x| x.bound()).fold(0.0, f64::max);
    let y = MARGIN * (step + inverse_norm * (product_error + 16.0 * S::UNIT_ROUNDOFF * residual));
    // |I - A J|, the error of J as the derivative, and the roundings of this very product.
    let mut deviation = [[S::zero(); 6]; 6];
    let mut sums = 0.0_f64;
    for (i, row) in deviation.iter_mut().enumerate() {
        let mut sum = 0.0;
        for (j, entry) in row.iter_mut().enumerate() {
            let mut value = if i == j { S::one() } else { S::zero() };
            for k in 0..6 {
                let term = approximate_inverse[i][k].mul(&at.jacobian[k][j]);
                sum += term.bound();
                value = value.sub(&term);
            }
            *entry = value;
        }
        sums = sums.max(sum);
    }
    let derivative_error = inverse_norm * derivative_error(at);
    let z0 = MARGIN * (norm(&deviation) + 40.0 * S::UNIT_ROUNDOFF * sums + derivative_error);
    if !(z0 < 0.5) {
        return None;
    }
    // Smallest radius that works, then the largest one (with half the contraction to spare).
    let bend = |r: f64| MARGIN * inverse_norm * curvature(at, r);
    let radius = (1.05 * y / (1.0 - z0)).max(f64::MIN_POSITIVE);
    let works = |r: f64| {
        let z2 = bend(r);
        y + z0 * r + 0.5 * z2 * r * r <= r && z0 + z2 * r < 1.0
    };
    let radius = [1.0, 1.5, 2.0].into_iter().map(|f| f * radius).find(|&r| works(r))?;
    let mut isolation = (1.0 - z0) / bend(radius) * 0.9;
    if !(isolation > radius) || !works(isolation) {
        isolation *= 0.5;
        if !(isolation > radius) || !works(isolation) {
            isolation = radius;
        }
    }
    Some(Certificate { radius, isolation })
}

/// As [`certificate`], with the loop opened in turn behind each of its joints: imaginary parts make some frames far
/// worse than others.
#[must_use]
pub fn certificate_in_any_frame<S: Scalar>(closed: &ClosedLoop<f64>, unknowns: &Six<S>) -> Option<Certificate> {
    (1..6).find_map(|k| {
        let rotated = Cut { rotation: k, reversed: false }.of(closed);
        let here = closure(&rotated, &std::array::from_fn(|j| unknowns[(k + j) % 6]));
        certificate(&here, &inverse(&here.jacobian)?)
    })
}

type Quad = Complex<DoubleDouble>;

fn quad(z: Complex<f64>) -> Quad {
    Complex { re: DoubleDouble::from(z.re), im: DoubleDouble::from(z.im) }
}

/// `e^(iq)` of an angle known in f64: any number but 0 is an exact angle in this form, and no cosine is needed in
/// double-double precision.
#[must_use]
pub fn exponential(angle: Complex<f64>) -> Complex<DoubleDouble> {
    // From cosine and sine it would cancel for large imaginary parts.
    let (sin, cos) = angle.re.sin_cos();
    quad(Complex::new(cos, sin) * (-angle.im).exp())
}

/// Cosine and sine of an angle q given as `w = e^(iq)`; `None` for 0.
#[must_use]
pub fn exponential_pair(w: Complex<DoubleDouble>) -> Option<(Complex<DoubleDouble>, Complex<DoubleDouble>)> {
    let back = crate::algebra::ring::Field::inverse(&w)?;
    // sin = (w - 1/w) / (2i)
    let difference = w.sub(&back).halved();
    Some((w.add(&back).halved(), Complex { re: difference.im, im: difference.re.neg() }))
}

/// `e^(id)` to order 5: good enough for a Newton step, after which w is as exact an angle as before.
#[must_use]
pub fn small_turn(d: Complex<DoubleDouble>) -> Complex<DoubleDouble> {
    let turn = d.mul(&Complex { re: DoubleDouble::zero(), im: DoubleDouble::one() });
    let mut factor = Quad::one();
    for k in (1..=5).rev() {
        let term = turn.mul(&factor).times(DoubleDouble::from(1.0 / f64::from(k)));
        factor = Quad::one().add(&term);
    }
    factor
}

/// A solution refined and proved in double-double arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refined {
    /// The unknowns, rounded from that precision.
    pub unknowns: Six<Complex<f64>>,
    /// Whether the solution is proved to be real: conjugation maps the ball of the proof into one three times as large,
    /// and a single solution there is its own conjugate.
    pub real: bool,
    /// The proof.
    pub certificate: Certificate,
}

/// A proof in double-double arithmetic, for solutions that f64 cannot prove: badly conditioned ones, and those with
/// large imaginary parts.
///
/// The proof is of the loop whose constants are the rigid motions nearest to the stored ones. How far the rounding of
/// those constants can have moved the solution is added to the radius, to first order; where that is no small amount
/// the solution is not proved.
#[must_use]
pub fn refined_certificate(closed: &ClosedLoop<f64>, unknowns: &Six<Complex<f64>>) -> Option<Refined> {
    let variables = closed.variables;
    let precise = ClosedLoop { variables, constants: closed.constants.each_ref().map(rigid) };
    let mut state: Six<Quad> = std::array::from_fn(|j| match variables[j] {
        Variable::Rotation => exponential(unknowns[j]),
        Variable::Translation => quad(unknowns[j]),
    });
    let reach = reach(&variables, unknowns);
    let mut before = f64::INFINITY;
    for round in 0..12 {
        let mut pairs = [(Quad::zero(), Quad::zero()); 6];
        for j in 0..6 {
            pairs[j] = match variables[j] {
                Variable::Rotation => exponential_pair(state[j])?,
                Variable::Translation => (state[j], Quad::zero()),
            };
        }
        let here = closure_at::<Quad>(&precise, &pairs);
        let jacobian = here.jacobian.map(|row| row.map(|x| Complex::new(x.re.to_f64(), x.im.to_f64())));
        let inverse = inverse(&jacobian)?.map(|row| row.map(quad));
        let step = times(&inverse, &here.residual);
        let size = step.iter().map(|x| x.bound()).fold(0.0, f64::max) / reach;
        // Newton's method has to converge from where it starts, not to wander.
        let stalls = !(size < 0.5 * before);
        if !(size < 0.3) || (stalls && size > 1e-12) {
            return None;
        }
        if size < 1e-26 || stalls || round == 11 {
            let proof = certificate(&here, &inverse).or_else(|| in_any_frame(&precise, &pairs))?;
            let refined: Six<Complex<f64>> = std::array::from_fn(|j| {
                let z = Complex::new(state[j].re.to_f64(), state[j].im.to_f64());
                match variables[j] {
                    Variable::Rotation => Complex::new(z.arg(), -z.norm().ln()),
                    Variable::Translation => z,
                }
            });
            // The reported unknowns are those of the proof, rounded.
            let largest = refined.iter().map(|x| x.bound()).fold(1.0, f64::max);
            let rounding = 4.0 * f64::EPSILON * largest;
            let drift = drift(closed, &refined);
            let certificate = Certificate { radius: proof.radius + rounding + drift, ..proof };
            // Judged by the solution itself, not by what its rounding left of it.
            let imaginary = (0..6).map(|j| imaginary(variables[j], state[j])).fold(0.0, f64::max);
            let real = imaginary <= proof.radius && 3.0 * proof.radius <= proof.isolation;
            let unknowns = if real { refined.map(|z| z.re.into()) } else { refined };
            return (drift < MOST_DRIFT * reach).then_some(Refined { unknowns, real, certificate });
        }
        before = size;
        for j in 0..6 {
            let d = step[j].neg();
            match variables[j] {
                Variable::Rotation => state[j] = state[j].mul(&small_turn(d)),
                Variable::Translation => state[j] = state[j].add(&d),
            }
        }
    }
    None
}

/// [`certificate`] in double-double arithmetic with the loop opened in turn behind each of its joints.
fn in_any_frame(closed: &ClosedLoop<DoubleDouble>, pairs: &[(Quad, Quad); 6]) -> Option<Certificate> {
    (1..6).find_map(|k| {
        let rotated = Cut { rotation: k, reversed: false }.of(closed);
        let here = closure_at::<Quad>(&rotated, &std::array::from_fn(|j| pairs[(k + j) % 6]));
        let jacobian = here.jacobian.map(|row| row.map(|x| Complex::new(x.re.to_f64(), x.im.to_f64())));
        certificate(&here, &inverse(&jacobian)?.map(|row| row.map(quad)))
    })
}

/// The size of the imaginary part of an unknown, an angle q given as e^(iq); near 0 to double-double precision.
fn imaginary(variable: Variable, state: Quad) -> f64 {
    match variable {
        Variable::Rotation => {
            let square = state.re.mul(&state.re).add(&state.im.mul(&state.im));
            let off = square.sub(&DoubleDouble::one()).to_f64();
            0.5 * off.ln_1p().abs()
        }
        Variable::Translation => state.im.to_f64().abs(),
    }
}

/// How far the rounding of the constants can have moved a solution, to first order. A constant off by a twist x, a few
/// roundings in size, moves the unknowns by `J^-1 Ad_j x` with the frame of its step.
fn drift(closed: &ClosedLoop<f64>, unknowns: &Six<Complex<f64>>) -> f64 {
    let pairs: Six<(Complex<f64>, Complex<f64>)> =
        std::array::from_fn(|j| coordinates(closed.variables[j], unknowns[j]));
    let Some(inverse) = inverse(&closure_at(closed, &pairs).jacobian) else { return f64::INFINITY };
    let mut sum = 0.0;
    for count in 1..=6 {
        let frame: Motion<Complex<f64>> = product(closed, &pairs, count);
        let mut moved = [[Complex::new(0.0, 0.0); 6]; 6];
        for axis in 0..3 {
            // A turn about this axis of the frame, and a shift along it.
            let direction: [Complex<f64>; 3] = std::array::from_fn(|i| frame.rotation[i][axis]);
            let moment = cross(&frame.translation, &direction);
            for (row, from) in moved.iter_mut().zip(&inverse) {
                for i in 0..3 {
                    row[axis] += from[i] * direction[i] + from[3 + i] * moment[i];
                    row[3 + axis] += from[3 + i] * direction[i];
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
