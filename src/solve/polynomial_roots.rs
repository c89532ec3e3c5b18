//! All complex roots of a polynomial at once, to the number of digits of its coefficients.
//!
//! Newton's correction N = p/p' at every approximation x_k, with the other approximations divided out of p:
//! `x_k -= N / (1 - N sum_j 1/(x_k - x_j))`. It converges with order three to simple roots. \[Aberth1973\]

use super::crowded_roots::approximations;
use super::scalar::{Extended, Number, extended, narrowed};
use crate::algebra::ball::Ball;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::univariate::Univariate;
use num_complex::Complex;
use rug::Float;
use std::f64::consts::TAU;

/// Rounds in 384 bits without a root that settles after which none will.
const PATIENCE: usize = 60;
/// Corrections that shrink no more have reached the noise of the coefficients.
const STALLED: f64 = 0.5;
/// Where they have, an approximation belongs to one root if they are smaller than this part of the distance to the nearest other one: of a
/// crowd of m roots the distance loses m - 1 times its digits.
const APART: f64 = 1e-9;
/// No fewer bits than any multiprecision number has.
const MOST_BITS: u32 = 1024;

/// The simple roots of a polynomial with real coefficients; those at infinity and multiple ones, which do not settle, are
/// left out. `None` for zero.
#[must_use]
pub fn polynomial_roots<R: Extended>(polynomial: &Univariate<R>) -> Option<Vec<Complex<R>>> {
    let coefficients = polynomial.coefficients();
    let sizes: Vec<f64> = coefficients.iter().map(|c| c.to_f64().abs()).collect();
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    // Leading coefficients that are nearly rounding are none.
    let degree = sizes.iter().rposition(|size| *size > R::UNIT_ROUNDOFF.powf(0.8) * largest)?;
    let coefficients = &coefficients[..=degree];
    let radii = radii(&sizes[..=degree]);
    if !radii.iter().all(|radius| *radius > 0.0 && radius.is_finite()) {
        return None;
    }
    let mut roots: Vec<Complex<R>> = starts(coefficients).unwrap_or_else(|| {
        // Turned, so that no two approximations are conjugate and stay so.
        let start = |k: usize| Complex::from_polar(radii[k], TAU * (k as f64 + 0.3) / degree as f64 + 0.4);
        (0..degree).map(|k| extended(start(k))).collect()
    });
    // Corrections of this relative size are rounding.
    let settled = R::UNIT_ROUNDOFF.powf(0.75);
    // More digits separate nearer roots, which approximations approach by a constant factor per step only.
    let patience = PATIENCE * (R::BITS as usize).div_ceil(384).pow(2);
    let mut open = vec![true; degree];
    let mut before = vec![f64::INFINITY; degree];
    let mut idle = 0;
    while idle < patience && open.contains(&true) {
        idle += 1;
        for k in 0..degree {
            if !open[k] {
                continue;
            }
            let x = roots[k];
            let (value, slope) = value_and_slope(coefficients, &x);
            if value.is_zero() {
                open[k] = false;
                idle = 0;
                continue;
            }
            let Some(newton) = slope.inverse().map(|inverse| value.mul(&inverse)) else {
                // At a zero of the derivative: anywhere else.
                roots[k] = x.add(&extended(Complex::new(1e-3 * radii[k], 2e-3 * radii[k])));
                continue;
            };
            let repelled = (0..degree).filter(|j| *j != k).fold(Complex::new(0.0, 0.0), |sum, j| {
                let gap = narrowed(x.sub(&roots[j]));
                if gap.norm_sqr() > 0.0 { sum + gap.inv() } else { sum }
            });
            let factor = (1.0 - narrowed(newton) * repelled).inv();
            let factor = if factor.is_finite() { factor } else { Complex::new(1.0, 0.0) };
            let correction = newton.mul(&extended(factor));
            roots[k] = x.sub(&correction);
            let size = correction.size();
            let is_at_rest =
                size <= settled * roots[k].size() || (size >= STALLED * before[k] && size < APART * nearest(&roots, k));
            before[k] = size;
            if is_at_rest {
                open[k] = false;
                idle = 0;
            }
        }
    }
    Some(roots.into_iter().zip(open).filter(|(_, open)| !open).map(|(root, _)| root).collect())
}

/// The distance of an approximation from the nearest other one.
fn nearest<R: Extended>(roots: &[Complex<R>], k: usize) -> f64 {
    let others = roots.iter().enumerate().filter(|(j, _)| *j != k);
    others.map(|(_, other)| other.sub(&roots[k]).size()).fold(f64::INFINITY, f64::min)
}

/// Returns approximations of all roots, with crowded ones separated as far as the digits allow.
fn starts<R: Extended>(coefficients: &[R]) -> Option<Vec<Complex<R>>> {
    let image = |c: &R| {
        let whole = whole(*c);
        let error = Float::with_val(32, whole.abs_ref()) * R::UNIT_ROUNDOFF;
        Ball::<MOST_BITS>::point(&whole, &Float::new(32)).enlarged(&error)
    };
    let found = approximations(&coefficients.iter().map(image).collect::<Vec<_>>())?;
    let part = |x: &Float| R::from_rational(&x.to_rational()?);
    let roots: Option<Vec<Complex<R>>> =
        found.iter().map(|z| Some(Complex::new(part(z.re())?, part(z.im())?))).collect();
    // Two that are one would stay so.
    roots.filter(|roots| (1..roots.len()).all(|k| roots[..k].iter().all(|other| !roots[k].sub(other).is_zero())))
}

/// All digits of a multiprecision number.
fn whole<R: Extended>(mut x: R) -> Float {
    let mut sum = Float::new(MOST_BITS);
    while !x.is_zero() {
        let part = x.to_f64();
        if part == 0.0 || !part.is_finite() {
            break;
        }
        sum += part;
        x = x.sub(&R::from(part));
    }
    sum
}

/// Estimates the distances of the roots from the origin by the sizes of the coefficients: on a logarithmic scale, every edge of
/// their upper convex hull stands for as many roots as its length, and its slope for their size. Roots at 0 share the smallest
/// radius.
fn radii(sizes: &[f64]) -> Vec<f64> {
    let logs: Vec<f64> = sizes.iter().map(|size| size.ln()).collect();
    sizes_of_roots(&logs).into_iter().map(f64::exp).collect()
}

/// Logarithms of the sizes that the roots may have, smallest first, from those of the coefficients, which are minus infinite for
/// a zero.
pub(super) fn sizes_of_roots(logs: &[f64]) -> Vec<f64> {
    let slope = |i: usize, j: usize| (logs[j] - logs[i]) / (j - i) as f64;
    let mut hull: Vec<usize> = Vec::new();
    for k in (0..logs.len()).filter(|&k| logs[k] > f64::NEG_INFINITY) {
        while let [.., i, j] = hull[..]
            && slope(i, j) <= slope(j, k)
        {
            hull.pop();
        }
        hull.push(k);
    }
    let mut sizes = Vec::new();
    for edge in hull.windows(2) {
        sizes.resize(edge[1], -slope(edge[0], edge[1]));
    }
    // A power of the variable alone has no edge.
    sizes.resize(logs.len().saturating_sub(1), 0.0);
    sizes
}

/// A real polynomial and its derivative at a point.
fn value_and_slope<R: Extended>(coefficients: &[R], x: &Complex<R>) -> (Complex<R>, Complex<R>) {
    let mut value = Complex::zero();
    let mut slope = Complex::zero();
    for c in coefficients.iter().rev() {
        slope = slope.mul(x).add(&value);
        value = value.mul(x).add(&Complex::from_real(*c));
    }
    (value, slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::long_float::LongFloat;
    use rug::Rational;

    fn long(numerator: i64, denominator: u64) -> LongFloat {
        LongFloat::from_rational(&Rational::from((numerator, denominator))).unwrap()
    }

    #[test]
    fn roots_that_f64_cannot_tell_apart_are_told() {
        // (x - 1)(x - 1 - 10^-12)(x - 1 - 2 10^-12)(x^2 + 1/9)(x - 10^9)
        let near = 1_000_000_000_000_u64;
        let mut polynomial = Univariate::new(vec![long(1, 9), LongFloat::zero(), LongFloat::one()]);
        for k in 0..3 {
            let root = long(near.cast_signed() + k, near);
            polynomial = polynomial.mul(&Univariate::new(vec![root.neg(), LongFloat::one()]));
        }
        polynomial = polynomial.mul(&Univariate::new(vec![long(-1_000_000_000, 1), LongFloat::one()]));
        let roots = polynomial_roots(&polynomial).unwrap();
        assert_eq!(roots.len(), 6);
        let expected = [
            Complex::new(long(near.cast_signed(), near), LongFloat::zero()),
            Complex::new(long(near.cast_signed() + 1, near), LongFloat::zero()),
            Complex::new(long(near.cast_signed() + 2, near), LongFloat::zero()),
            Complex::new(LongFloat::zero(), long(1, 3)),
            Complex::new(LongFloat::zero(), long(-1, 3)),
            Complex::new(long(1_000_000_000, 1), LongFloat::zero()),
        ];
        for wanted in expected {
            assert!(roots.iter().any(|root| root.sub(&wanted).size() < 1e-60), "{:?}", narrowed(wanted));
        }
    }

    #[test]
    fn multiple_roots_are_left_out() {
        // (x^2 + 1)^3 (x - 2) (2 x + 1)
        let mut polynomial = Univariate::new([-2, -3, 2].map(|c| long(c, 1)).to_vec());
        for _ in 0..3 {
            polynomial = polynomial.mul(&Univariate::new([1, 0, 1].map(|c| long(c, 1)).to_vec()));
        }
        let mut roots: Vec<f64> = polynomial_roots(&polynomial).unwrap().into_iter().map(|z| narrowed(z).re).collect();
        roots.sort_by(f64::total_cmp);
        assert_eq!(roots, [-0.5, 2.0]);
    }

    #[test]
    fn constants_and_zero_have_no_roots() {
        assert_eq!(polynomial_roots(&Univariate::constant(long(1, 3))), Some(Vec::new()));
        assert_eq!(polynomial_roots(&Univariate::<LongFloat>::zero()), None);
    }
}
