//! All complex roots of a square-free integer polynomial, each in a ball of its own.

use super::eliminant::in_balls;
use crate::algebra::ball::Ball;
use crate::algebra::long_float::{LongFloat, LongerFloat};
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::solve::crowded_roots::approximations;
use crate::solve::polynomial_roots::polynomial_roots;
use crate::solve::scalar::Extended;
use num_complex::Complex;
use rug::{Float, Integer, Rational};

/// Weierstrass' iteration doubles the digits of simple roots: it reaches any precision in use from an f64, with some steps to
/// spare for crowded roots.
const STEPS: usize = 12;

/// A root in a ball that holds no other root of its polynomial.
#[derive(Clone, Debug)]
pub struct Isolated<const BITS: u32> {
    /// The ball; its midpoint is real if the root is.
    pub ball: Ball<BITS>,
    /// Whether the root is real.
    pub is_real: bool,
}

/// Returns the roots of a square-free polynomial, conjugates included; `None` where this precision does not separate them.
///
/// # Source
/// Each disc of radius `n |w_k|` around one of n approximations, with Weierstrass' corrections `w_k = p(z_k) / (a_n prod_j
/// (z_k - z_j))`, holds a root, and exactly one if it meets no other disc. \[Smith1970\]
#[must_use]
pub fn isolated_roots<const BITS: u32>(polynomial: &Univariate<Integer>) -> Option<Vec<Isolated<BITS>>> {
    isolated_in_balls(&in_balls(polynomial)?)
}

/// The roots of a square-free polynomial with real coefficients in balls.
pub(super) fn isolated_in_balls<const BITS: u32>(coefficients: &[Ball<BITS>]) -> Option<Vec<Isolated<BITS>>> {
    if coefficients.last()?.contains_zero() {
        return None;
    }
    if coefficients.len() == 1 {
        return Some(Vec::new());
    }
    // f64 about their middle separates most crowded roots; multiprecision arithmetic separates the rest and takes more time.
    approximations(coefficients)
        .and_then(|midpoints| isolated_from(coefficients, midpoints))
        .or_else(|| isolated_from(coefficients, starts::<LongFloat, BITS>(coefficients)?))
        .or_else(|| isolated_from(coefficients, starts::<LongerFloat, BITS>(coefficients)?))
}

/// The discs after some steps from these approximations.
fn isolated_from<const BITS: u32>(
    coefficients: &[Ball<BITS>],
    mut midpoints: Vec<Ball<BITS>>,
) -> Option<Vec<Isolated<BITS>>> {
    for _ in 0..STEPS {
        let corrections = corrections(coefficients, &midpoints)?;
        let is_done = corrections.iter().zip(&midpoints).all(|(w, z)| {
            let size = z.midpoint().upper();
            w.midpoint().upper() <= (size >> (BITS - 24))
        });
        midpoints = midpoints.iter().zip(&corrections).map(|(z, w)| z.sub(w).midpoint()).collect();
        if is_done {
            break;
        }
    }
    isolated(coefficients, &midpoints)
}

/// Returns approximations of all roots by Aberth's iteration in multiprecision; `None` where some did not converge.
fn starts<R: Extended, const BITS: u32>(coefficients: &[Ball<BITS>]) -> Option<Vec<Ball<BITS>>> {
    let scale = Scale::of(coefficients)?;
    let image: Option<Vec<R>> =
        coefficients.iter().zip(0..).map(|(c, k)| R::from_rational(&scale.coefficient(c, k)?)).collect();
    let roots: Vec<Complex<R>> = polynomial_roots(&Univariate::new(image?))?;
    let outward = |x: R| wide(x) << scale.root;
    let ball = |z: Complex<R>| Ball::point(&outward(z.re), &outward(z.im)).midpoint();
    (roots.len() + 1 == coefficients.len()).then(|| roots.into_iter().map(ball).collect())
}

/// Powers of two by which coefficients and roots come into the range of f64.
struct Scale {
    /// Roots are over 2 to this power.
    root: i32,
    /// Coefficients, those of the scaled roots, are over 2 to this power.
    size: i32,
}

impl Scale {
    /// The geometric mean of the roots becomes about 1, and the largest coefficient, too.
    fn of<const BITS: u32>(coefficients: &[Ball<BITS>]) -> Option<Self> {
        let bits = |c: &Ball<BITS>| c.re().get_exp();
        let first = coefficients.iter().position(|c| !c.contains_zero())?;
        let span = i32::try_from(coefficients.len() - 1 - first).ok()?.max(1);
        let root = (bits(&coefficients[first])? - bits(coefficients.last()?)?) / span;
        let sizes =
            coefficients.iter().zip(0..).filter(|(c, _)| !c.contains_zero()).map(|(c, k)| Some(bits(c)? + root * k));
        Some(Self { root, size: sizes.collect::<Option<Vec<i32>>>()?.into_iter().max()? })
    }

    fn coefficient<const BITS: u32>(&self, c: &Ball<BITS>, k: i32) -> Option<Rational> {
        if c.contains_zero() {
            return Some(Rational::new());
        }
        Float::with_val(BITS, c.re() << (self.root * k - self.size)).to_rational()
    }
}

/// A multiprecision number as a Float, to its first three doubles' digits.
fn wide<R: Extended>(x: R) -> Float {
    let first = x.to_f64();
    let second = x.sub(&R::from(first)).to_f64();
    let third = x.sub(&R::from(first)).sub(&R::from(second)).to_f64();
    Float::with_val(192, first) + second + third
}

/// Weierstrass' corrections with rigorous error bounds; `None` where two approximations are one.
fn corrections<const BITS: u32>(coefficients: &[Ball<BITS>], midpoints: &[Ball<BITS>]) -> Option<Vec<Ball<BITS>>> {
    let leading = coefficients.last()?;
    let correction = |(k, z): (usize, &Ball<BITS>)| {
        let value = coefficients.iter().rev().fold(Ball::zero(), |value: Ball<BITS>, c| value.mul(z).add(c));
        let others = midpoints.iter().enumerate().filter(|(j, _)| *j != k);
        let product = others.fold(leading.clone(), |product, (_, other)| product.mul(&z.sub(other)));
        value.over(&product)
    };
    midpoints.iter().enumerate().map(correction).collect()
}

/// The discs around the approximations, if none meets another one.
fn isolated<const BITS: u32>(coefficients: &[Ball<BITS>], midpoints: &[Ball<BITS>]) -> Option<Vec<Isolated<BITS>>> {
    let count = u32::try_from(midpoints.len()).ok()?;
    let disc = |(z, w): (&Ball<BITS>, &Ball<BITS>)| z.clone().enlarged(&Float::with_val(32, w.upper() * (count + 1)));
    let corrections = corrections(coefficients, midpoints)?;
    let mut discs: Vec<Isolated<BITS>> =
        midpoints.iter().zip(&corrections).map(disc).map(|ball| Isolated { ball, is_real: false }).collect();
    // A disc around a real midpoint that meets no other one holds one root and its conjugate, which are one.
    for root in &mut discs {
        if *root.ball.im().as_abs() <= *root.ball.radius() {
            let off = Float::with_val(32, root.ball.im() * 1.01_f64);
            let (re, radius) = (root.ball.re().clone(), root.ball.radius().clone());
            root.ball = Ball::point(&re, &Float::new(BITS)).enlarged(&radius).enlarged(&off);
            root.is_real = true;
        }
    }
    let apart = |j: usize, k: usize| !discs[j].ball.overlaps(&discs[k].ball);
    (0..discs.len()).all(|k| (0..k).all(|j| apart(j, k))).then_some(discs)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polynomial(coefficients: &[i64]) -> Univariate<Integer> {
        Univariate::new(coefficients.iter().map(|&c| Integer::from(c)).collect())
    }

    #[test]
    fn roots_are_isolated_and_real_ones_are_known_as_such() {
        // (x^2 - 2)(x^2 + 1)(10^12 x - 1)(x - 10^9)
        let factors = [&[-2, 0, 1][..], &[1, 0, 1], &[-1, 1_000_000_000_000], &[-1_000_000_000, 1]];
        let product = factors.iter().fold(polynomial(&[1]), |p, f| p.mul(&polynomial(f)));
        let roots = isolated_roots::<256>(&product).expect("256 bits are enough");
        assert_eq!(roots.len(), 6);
        assert_eq!(roots.iter().filter(|root| root.is_real).count(), 4);
        let near = |x: f64| roots.iter().any(|root| (root.ball.re().to_f64() - x).abs() <= 1e-15 * x.abs());
        assert!([2_f64.sqrt(), -2_f64.sqrt(), 1e-12, 1e9].into_iter().all(near));
        assert!(roots.iter().all(|root| *root.ball.radius() < 1e-50));
    }

    #[test]
    fn roots_that_nearly_coincide_are_told_apart_or_refused() {
        // (10^15 x - 1)^2 (x + 3) - 10^-15 or so: two roots 6e-23 apart, real for one sign only.
        for (sign, real) in [(1, 3), (-1, 1)] {
            let double = polynomial(&[-1, 1_000_000_000_000_000]);
            let shifted =
                double.mul(&double).mul(&polynomial(&[3, 1])).scale(&Integer::from(1_000_000_000_000_000_i64));
            let split = shifted.sub(&polynomial(&[sign]));
            let roots = isolated_roots::<512>(&split).expect("512 bits are enough");
            assert_eq!(roots.iter().filter(|root| root.is_real).count(), real);
        }
    }
}
