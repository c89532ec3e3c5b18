//! All zeros of a trigonometric polynomial on the circle, from sampled values with bounds of their errors.
//!
//! On each of eight arcs, with t the half-tangent of the angle from its middle, `(1 + t^2)^8 f` is a polynomial of degree 16. Its
//! Bernstein coefficients on the arc are sums of the values with fixed weights. An arc is halved by de Casteljau's rule, which
//! takes averages and so does not enlarge errors. Where all coefficients have one sign for sure there is no zero; where they change
//! sign once, whatever the sign of the one between that is not sure, there is exactly one zero, a simple one (Descartes' rule). The
//! statements hold for every trigonometric polynomial of degree 8 whose values at the samples are within the bounds.

use super::ROUNDOFF;
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::ring::{Field, Ring};
use crate::solve::scalar::Number;
use num_complex::Complex;
use std::f64::consts::TAU;
use std::sync::LazyLock;

/// Degree of the trigonometric polynomial.
pub(super) const DEGREE: usize = 8;
/// Number of Bernstein coefficients.
pub(super) const SIZE: usize = 2 * DEGREE + 1;
/// Number of samples: 17 are needed, and arcs begin at samples.
pub const SAMPLES: usize = 24;
/// Number of arcs: on a longer one `(1 + t^2)^8` varies much, and so does the meaning of a bound.
pub(super) const ARCS: usize = 8;
/// Half-tangent `1/5` of the angle of the first sample, the middle of the first arc: its cosine is 12/13 and its sine 5/13. Zeros of real
/// mechanisms tend to lie at multiples of a right angle, where the circle must not be divided.
const FIRST: [f64; 3] = [12.0, 5.0, 13.0];
/// No sample's cosine or sine is off by more: they are computed in double-double arithmetic and rounded once.
pub const SAMPLE_ERROR: f64 = f64::EPSILON;
/// Arcs are halved no further: zeros nearer than 1e-10 count as multiple.
pub(super) const DEPTH: usize = 32;
/// Number of intervals after which the zeros count as crowded: sixteen zeros a distance 1e-3 apart need 300.
pub(super) const MOST: usize = 600;

/// The samples, and the Bernstein coefficients on the first arc.
struct Tables {
    samples: [(f64, f64); SAMPLES],
    /// `[Bernstein coefficient][sample]`, rounded once; the other arcs have the same weights, the samples counted from their middle.
    weights: [[f64; SAMPLES]; SIZE],
}

static TABLES: LazyLock<Tables> = LazyLock::new(|| {
    let [cos, sin, over] = FIRST.map(DoubleDouble::from);
    let over = over.inverse().unwrap_or(DoubleDouble::one());
    let first = Long::new(cos.mul(&over), sin.mul(&over));
    let samples = turns().map(|turn| first.mul(&turn)).map(|w| (w.re.to_f64(), w.im.to_f64()));
    Tables { samples, weights: weights() }
});

type Long = Complex<DoubleDouble>;

/// Returns `e^(i k q)` for q = 15 degrees and k = 0 to 23.
fn turns() -> [Long; SAMPLES] {
    let real = |x: f64| DoubleDouble::from(x);
    // cos 15 degrees = sqrt(2 + sqrt 3) / 2.
    let half = |x: DoubleDouble| Number::root(x).mul(&real(0.5));
    let three = Number::root(real(3.0));
    let step = Long::new(half(real(2.0).add(&three)), half(real(2.0).sub(&three)));
    let mut turns = [Long::one(); SAMPLES];
    for k in 1..SAMPLES {
        turns[k] = turns[k - 1].mul(&step);
    }
    turns
}

/// Returns the weights: the Bernstein coefficients of `(1 + t^2)^8 (1 + 2 sum cos k (q - q_j)) / 24`, k = 1 to 8, for every sample q_j.
pub(super) fn weights() -> [[f64; SAMPLES]; SIZE] {
    let real = |x: f64| DoubleDouble::from(x);
    // tan 11.25 degrees, where an arc of 45 degrees ends.
    let root = |x: DoubleDouble| Number::root(x);
    let two = root(real(2.0));
    let end = root(real(4.0).add(&two).add(&two)).sub(&two).sub(&real(1.0));
    let turns = turns();
    let mut weights = [[0.0; SAMPLES]; SIZE];
    let mut sums = [[real(0.0); SAMPLES]; SIZE];
    for k in 0..=DEGREE {
        let of_power = power(DEGREE + k, DEGREE - k, end);
        let factor = real(if k == 0 { 1.0 } else { 2.0 } / SAMPLES as f64);
        for (i, value) in of_power.into_iter().enumerate() {
            for j in 0..SAMPLES {
                // The real part of e^(i k q) e^(-i k q_j).
                let turn = &turns[(k * j) % SAMPLES];
                let term = value.re.mul(&turn.re).add(&value.im.mul(&turn.im));
                sums[i][j] = sums[i][j].add(&term.mul(&factor));
            }
        }
    }
    for (row, sums) in weights.iter_mut().zip(&sums) {
        for (weight, sum) in row.iter_mut().zip(sums) {
            *weight = sum.to_f64();
        }
    }
    weights
}

/// Returns the Bernstein coefficients of `(1 + i t)^p (1 - i t)^q` for t from `-end` to `end`, p + q = 16.
fn power(p: usize, q: usize, end: DoubleDouble) -> [Long; SIZE] {
    let one = DoubleDouble::one();
    let (plus, minus) = (Complex::new(one, end), Complex::new(one, end.neg()));
    let mut product = [Long::zero(); SIZE];
    product[0] = Long::one();
    for factor in 0..p + q {
        let (left, right) = if factor < p { (minus, plus) } else { (plus, minus) };
        for i in (0..=factor + 1).rev() {
            let here = if i <= factor { product[i].mul(&left) } else { Long::zero() };
            let before = if i > 0 { product[i - 1].mul(&right) } else { Long::zero() };
            product[i] = here.add(&before);
        }
    }
    let mut choose = 1.0;
    for (i, value) in product.iter_mut().enumerate() {
        let part = DoubleDouble::from(choose).inverse().unwrap_or(one);
        *value = Complex::new(value.re.mul(&part), value.im.mul(&part));
        // Exact: a binomial coefficient times one number is a multiple of the other.
        choose = choose * (SIZE - 1 - i) as f64 / (i + 1) as f64;
    }
    product
}

/// Returns cosine and sine of the angle of every sample, each within [`SAMPLE_ERROR`].
#[must_use]
pub fn samples() -> &'static [(f64, f64); SAMPLES] {
    &TABLES.samples
}

/// The zeros of a trigonometric polynomial, each alone in its interval and simple.
#[derive(Clone, Debug)]
pub struct Zeros {
    angles: [f64; 2 * DEGREE],
    count: usize,
}

impl Zeros {
    /// Returns an angle near each zero.
    #[must_use]
    pub fn angles(&self) -> &[f64] {
        &self.angles[..self.count]
    }
}

/// Bernstein coefficients on an interval of the half-tangent.
#[derive(Clone, Copy)]
struct Piece {
    coefficients: [f64; SIZE],
    error: f64,
    depth: usize,
    low: f64,
    high: f64,
}

/// The number of zeros in a piece.
enum Count {
    None,
    One,
    Unknown,
}

impl Piece {
    /// Returns the Bernstein coefficients on an arc of the polynomial that has these values at [`samples`], each off by at most its error.
    fn of_arc(arc: usize, values: &[f64; SAMPLES], errors: &[f64; SAMPLES]) -> Self {
        let end = (TAU / (4 * ARCS) as f64).tan();
        let mut piece = Self { coefficients: [0.0; SIZE], error: 0.0, depth: 0, low: -end, high: end };
        for (slot, row) in piece.coefficients.iter_mut().zip(&TABLES.weights) {
            let (mut sum, mut error) = (0.0, 0.0);
            for (j, weight) in row.iter().enumerate() {
                let at = (j + arc * (SAMPLES / ARCS)) % SAMPLES;
                let term = weight * values[at];
                sum += term;
                // A weight is rounded twice, a product, and a sum of so many terms by one of each.
                error += weight.abs() * errors[at] + (SAMPLES as f64 + 6.0) * ROUNDOFF * term.abs();
            }
            *slot = sum;
            piece.error = piece.error.max(1.01 * error);
        }
        piece
    }

    /// Returns the sign of a coefficient, 0 where it is not sure.
    fn sign(&self, x: f64) -> i32 {
        if x > self.error {
            1
        } else if x < -self.error {
            -1
        } else {
            0
        }
    }

    /// Returns the most zeros in the piece, with multiplicity, of all polynomials within the error; `None` where one may be at an end.
    ///
    /// They are the sign changes of the coefficients, where those that are not sure have the signs that change most often.
    fn most(&self) -> Option<usize> {
        let ends = [0, SIZE - 1].map(|k| self.sign(self.coefficients[k]));
        if ends.contains(&0) {
            return None;
        }
        // The most changes up to a coefficient that is positive, and up to one that is negative.
        let mut most = if ends[0] > 0 { [Some(0), None] } else { [None, Some(0)] };
        for x in &self.coefficients[1..] {
            let sign = self.sign(*x);
            let change = |from: Option<usize>, other: Option<usize>| from.max(other.map(|count| count + 1));
            let next = [change(most[0], most[1]), change(most[1], most[0])];
            most = [if sign < 0 { None } else { next[0] }, if sign > 0 { None } else { next[1] }];
        }
        most[usize::from(ends[1] < 0)]
    }

    fn count(&self) -> Count {
        let sign = |x: f64| self.sign(x);
        let (first, last) = (sign(self.coefficients[0]), sign(self.coefficients[SIZE - 1]));
        if first == 0 || last == 0 {
            return Count::Unknown;
        }
        let run = |from: usize, wanted: i32| (from..SIZE).take_while(|&k| sign(self.coefficients[k]) == wanted).count();
        let same = run(0, first);
        if same == SIZE {
            return Count::None;
        }
        // One coefficient that is not sure has no say between two that differ; two could change the sign twice more.
        let unsure = run(same, 0);
        let other = run(same + unsure, -first);
        if unsure <= 1 && same + unsure + other == SIZE { Count::One } else { Count::Unknown }
    }

    /// Returns the two halves.
    fn halves(&self) -> [Self; 2] {
        let mut right = self.coefficients;
        let mut left = [0.0; SIZE];
        let size = right.iter().map(|x| x.abs()).fold(0.0, f64::max);
        for (step, slot) in left.iter_mut().enumerate() {
            *slot = right[0];
            for k in 0..SIZE - 1 - step {
                right[k] = 0.5 * (right[k] + right[k + 1]);
            }
        }
        // Sixteen averages, each rounded once; the bound itself is a rounded sum.
        let error = (self.error + SIZE as f64 * ROUNDOFF * size) * (1.0 + 4.0 * f64::EPSILON);
        let middle = 0.5 * (self.low + self.high);
        let depth = self.depth + 1;
        [
            Self { coefficients: left, error, depth, high: middle, ..*self },
            Self { coefficients: right, error, depth, low: middle, ..*self },
        ]
    }
}

/// Returns all zeros of a trigonometric polynomial of degree 8 that has these values at [`samples`], each off by at most its error;
/// `None` where zeros crowd or may be multiple.
#[must_use]
pub fn zeros(values: &[f64; SAMPLES], errors: &[f64; SAMPLES]) -> Option<Zeros> {
    if !values.iter().chain(errors).all(|x| x.is_finite()) {
        return None;
    }
    let mut zeros = Zeros { angles: [0.0; 2 * DEGREE], count: 0 };
    let mut visited = 0;
    let mut pieces = [Piece { coefficients: [0.0; SIZE], error: 0.0, depth: 0, low: -1.0, high: 1.0 }; DEPTH + 2];
    for arc in 0..ARCS {
        pieces[0] = Piece::of_arc(arc, values, errors);
        let mut left = 1;
        while left > 0 {
            left -= 1;
            visited += 1;
            let piece = pieces[left];
            match piece.count() {
                Count::None => {}
                Count::One if zeros.count < 2 * DEGREE => {
                    zeros.angles[zeros.count] = middle_of(arc) + 2.0 * zero_of(&piece).atan();
                    zeros.count += 1;
                }
                _ if piece.depth >= DEPTH || visited > MOST => return None,
                _ => {
                    [pieces[left + 1], pieces[left]] = piece.halves();
                    left += 2;
                }
            }
        }
    }
    Some(zeros)
}

/// Returns the angle in the middle of an arc.
fn middle_of(arc: usize) -> f64 {
    FIRST[1].atan2(FIRST[0]) + TAU * arc as f64 / ARCS as f64
}

/// Returns whether every trigonometric polynomial of degree 8 that has these values at [`samples`], each off by at most its error, has at
/// most as many zeros as there are angles given, with multiplicity. Pieces are halved until each may have as many as angles lie in it: zeros
/// that are nearer to each other than the errors tell need not be told apart.
#[must_use]
pub fn are_no_more(values: &[f64; SAMPLES], errors: &[f64; SAMPLES], angles: &[f64]) -> bool {
    if !values.iter().chain(errors).all(|x| x.is_finite()) {
        return false;
    }
    let (mut total, mut visited) = (0, 0);
    for arc in 0..ARCS {
        let places: Vec<f64> = angles.iter().map(|angle| (0.5 * (angle - middle_of(arc))).tan()).collect();
        let mut pieces = vec![Piece::of_arc(arc, values, errors)];
        while let Some(piece) = pieces.pop() {
            visited += 1;
            let inside = places.iter().filter(|place| (piece.low..piece.high).contains(*place)).count();
            match piece.most() {
                Some(most) if most <= inside => total += most,
                _ if piece.depth >= DEPTH || visited > MOST => return false,
                _ => pieces.extend(piece.halves()),
            }
        }
    }
    // Rounding may have counted an angle on both sides of an end.
    total <= angles.len()
}

/// Returns a half-tangent near the only zero of a piece: bisection with secants, in the Bernstein form.
fn zero_of(piece: &Piece) -> f64 {
    let value = |x: f64| {
        // Horner's rule in the Bernstein basis.
        let (y, mut power, mut sum, mut choose) = (1.0 - x, 1.0, 0.0, 1.0);
        if x <= 0.5 {
            let ratio = x / y;
            for (k, b) in piece.coefficients.iter().enumerate() {
                sum += b * choose * power;
                power *= ratio;
                choose *= (SIZE - 1 - k) as f64 / (k + 1) as f64;
            }
        } else {
            let ratio = y / x;
            for (k, b) in piece.coefficients.iter().rev().enumerate() {
                sum += b * choose * power;
                power *= ratio;
                choose *= (SIZE - 1 - k) as f64 / (k + 1) as f64;
            }
        }
        sum
    };
    // The sums above leave out a positive factor, so only signs and ratios near one place count.
    let (mut low, mut high) = (0.0, 1.0);
    let (mut at_low, mut at_high) = (piece.coefficients[0], piece.coefficients[SIZE - 1]);
    for step in 0..60 {
        let secant = low - at_low * (high - low) / (at_high - at_low);
        // The secant of a curved piece keeps one end; every third step halves.
        let x = if step % 3 == 2 || !(secant > low && secant < high) { 0.5 * (low + high) } else { secant };
        let here = value(x);
        if here == 0.0 || high - low < 1e-14 {
            low = x;
            high = x;
            break;
        }
        if (here > 0.0) == (at_low > 0.0) {
            (low, at_low) = (x, here);
        } else {
            (high, at_high) = (x, here);
        }
    }
    piece.low + (piece.high - piece.low) * 0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(f: impl Fn(f64) -> f64) -> [f64; SAMPLES] {
        samples().map(|(cos, sin)| f(sin.atan2(cos)))
    }

    #[test]
    fn zeros_that_are_not_told_apart_are_counted() {
        let near = [0.3, 0.3 + 1e-6, 2.0, 2.0 + 1e-7, 4.0, 4.0 + 1e-6];
        let f = |extra: f64| {
            values(|q: f64| {
                let rest = (1.5 + q.cos()).powi(4) * (1.0 - (q - 5.0).cos() + extra);
                near.iter().map(|a| (0.5 * (q - a)).sin()).product::<f64>() * rest
            })
        };
        let errors = [1e-9; SAMPLES];
        assert!(zeros(&f(0.5), &errors).is_none());
        assert!(are_no_more(&f(0.5), &errors, &near));
        assert!(!are_no_more(&f(0.5), &errors, &near[..5]) && !are_no_more(&f(0.5), &errors, &near[1..]));
        // Another pair of zeros may be within the errors, as a pair of complex ones just beside the circle is.
        assert!(!are_no_more(&f(1e-12), &errors, &near));
        assert!(are_no_more(&f(1e-3), &[1e-14; SAMPLES], &near));
    }

    #[test]
    fn zeros_are_found_and_counted() {
        // Products of sin((q - a) / 2) over sixteen angles have their zeros there.
        for seed in 0..200_u32 {
            let mut state = seed.wrapping_mul(2_654_435_761).wrapping_add(12_345);
            let mut next = || {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                f64::from(state >> 8) / f64::from(1 << 24) * TAU
            };
            let number = 2 * (seed as usize % 9);
            let angles: Vec<f64> = (0..number).map(|_| next()).collect();
            let apart = |a: f64, b: f64| (0.5 * (a - b)).sin().abs();
            let is_apart = (0..number).all(|i| (0..i).all(|j| apart(angles[i], angles[j]) > 0.02));
            let f = |q: f64| {
                let rest = (number / 2..DEGREE).map(|_| 1.5 + q.cos()).product::<f64>();
                angles.iter().map(|a| (0.5 * (q - a)).sin()).product::<f64>() * rest
            };
            let found = zeros(&values(f), &[1e-13; SAMPLES]);
            if !is_apart {
                continue;
            }
            let Some(found) = found else {
                assert!(number > 10, "{number} zeros crowd: {angles:?}");
                continue;
            };
            assert_eq!(found.angles().len(), number);
            for a in &angles {
                assert!(found.angles().iter().any(|b| apart(*a, *b) < 1e-5), "{a} of {:?}", found.angles());
            }
        }
    }

    #[test]
    fn a_wide_bound_hides_no_zeros() {
        // A pair of zeros 0.06 apart, between which the function is 2e-4 of its largest value.
        let f =
            |q: f64| [-1.04, -0.22, -0.08, -0.0135, 2.1, 2.93].iter().map(|a| (0.5 * (q - a)).sin()).product::<f64>();
        for digits in 0..40 {
            let error = 10_f64.powf(-0.25 * f64::from(digits) - 3.0);
            let found = zeros(&values(f), &[error; SAMPLES]);
            assert!(found.is_none_or(|found| found.angles().len() == 6), "{error}");
        }
        assert!(zeros(&values(f), &[1e-12; SAMPLES]).is_some());
    }

    #[test]
    fn double_zeros_are_not_counted() {
        let f = |q: f64| (1.0 - (q - 1.0).cos()) * (2.0 + q.cos());
        assert!(zeros(&values(f), &[1e-13; SAMPLES]).is_none());
        let f = |q: f64| (1.0 - (q - 1.0).cos() + 1e-3) * (2.0 + q.cos());
        assert_eq!(zeros(&values(f), &[1e-13; SAMPLES]).unwrap().angles().len(), 0);
        let f = |q: f64| (1.0 - (q - 1.0).cos() - 1e-3) * (2.0 + q.cos());
        assert_eq!(zeros(&values(f), &[1e-13; SAMPLES]).unwrap().angles().len(), 2);
    }

    #[test]
    fn a_vanishing_polynomial_has_no_count() {
        assert!(zeros(&[0.0; SAMPLES], &[1e-13; SAMPLES]).is_none());
        assert!(zeros(&[f64::NAN; SAMPLES], &[1e-13; SAMPLES]).is_none());
    }
}
