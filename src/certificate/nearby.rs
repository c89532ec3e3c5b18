//! Complex discs in f64, which the checker tries first.
//!
//! With u = 2^-53 a sum is off by at most u times its size, a product by at most 4 u times the sizes of its factors, sizes
//! being sums of the absolute values of both parts. Bounds take 8 u and more of each, and radii are enlarged by a part of
//! 2^-48 of themselves for the roundings of their own sums. Underflow loses less than the smallest normal number.

use super::enclosing::{Enclosing, distance_from_middle};
use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::{Field, Ring};
use rug::{Float, Rational};

/// 8 u
const ROUNDING: f64 = 8.0 * (f64::EPSILON / 2.0);
/// Factor that covers the roundings of a radius.
const UP: f64 = 1.0 + 32.0 * (f64::EPSILON / 2.0);
/// Several times the loss by underflow.
const TINY: f64 = 1e-300;

/// All complex numbers within a radius of a centre. A radius that is NaN bounds nothing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Nearby {
    re: f64,
    im: f64,
    radius: f64,
}

impl Nearby {
    /// Returns the centre in other numbers.
    pub(super) fn centre<S: Enclosing>(&self) -> S {
        S::holding(self.re, self.im)
    }

    fn size(&self) -> f64 {
        self.re.abs() + self.im.abs()
    }

    fn with(re: f64, im: f64, radius: f64) -> Self {
        let radius = (radius + ROUNDING * (re.abs() + im.abs())) * UP + TINY;
        Self { re, im, radius }
    }
}

impl Ring for Nearby {
    fn zero() -> Self {
        Self { re: 0.0, im: 0.0, radius: 0.0 }
    }
    fn one() -> Self {
        Self { re: 1.0, im: 0.0, radius: 0.0 }
    }
    fn add(&self, other: &Self) -> Self {
        if other.is_zero() {
            return self.clone();
        }
        if self.is_zero() {
            return other.clone();
        }
        Self::with(self.re + other.re, self.im + other.im, self.radius + other.radius)
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    fn mul(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::zero();
        }
        let (own, others) = (self.size(), other.size());
        let spread = own * other.radius + others * self.radius + self.radius * other.radius;
        let re = self.re * other.re - self.im * other.im;
        let im = self.re * other.im + self.im * other.re;
        Self::with(re, im, spread + ROUNDING * own * others)
    }
    fn neg(&self) -> Self {
        Self { re: -self.re, im: -self.im, radius: self.radius }
    }
    fn is_zero(&self) -> bool {
        self.re == 0.0 && self.im == 0.0 && self.radius == 0.0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Some(Self::with(Float::with_val(53, q).to_f64(), 0.0, 0.0))
    }
}

impl Field for Nearby {
    /// Returns the inverse of the centre: the checker divides by midpoints only, and no proof rests on the result.
    fn inverse(&self) -> Option<Self> {
        let inverse = num_complex::Complex::new(self.re, self.im).inv();
        (self.radius == 0.0 && inverse.is_finite()).then_some(Self { re: inverse.re, im: inverse.im, radius: 0.0 })
    }
    fn pivot_size(&self) -> f64 {
        self.size()
    }
    const PIVOT_ZERO: f64 = 0.0;
}

impl Enclosing for Nearby {
    const BITS: u32 = 53;
    fn near(re: &Float, im: &Float, radius: f64) -> Self {
        Self::with(re.to_f64(), im.to_f64(), radius)
    }
    fn of(known: &Enclosure) -> Self {
        let off = distance_from_middle(known);
        let near = known.middle().to_f64();
        if off == 0.0 && *known.middle() == near {
            return Self { re: near, im: 0.0, radius: 0.0 };
        }
        Self::with(near, 0.0, off)
    }
    fn middle(&self) -> Self {
        Self { radius: 0.0, ..*self }
    }
    fn at_most(&self) -> f64 {
        (self.size() + self.radius) * UP
    }
    fn at_least(&self) -> f64 {
        let least = self.re.abs().max(self.im.abs()) * (2.0 - UP) - self.radius * UP;
        if least > 0.0 { least } else { 0.0 }
    }
    fn is_right(&self) -> bool {
        self.re > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::ball::Ball;

    #[test]
    fn discs_hold_what_long_numbers_compute() {
        let at = |k: i32| (Rational::from((7 * k % 23 - 11, 9)), Rational::from((5 * k % 17 - 8, 7)));
        let off = |near: &Nearby, far: &Ball<256>| {
            let ball = Ball::<256>::point(&Float::with_val(53, near.re), &Float::with_val(53, near.im));
            ball.sub(far).upper().to_f64() / near.radius
        };
        for k in 0..40 {
            let (a, b) = (Nearby::about(&at(k), 1e-30), Nearby::about(&at(k + 3), 1e-30));
            let (x, y) = (Ball::about(&at(k), 0.0), Ball::about(&at(k + 3), 0.0));
            assert!(off(&a.mul(&b).sub(&a), &x.mul(&y).sub(&x)) < 1.0);
            let ((c, s), (cos, sin)) = (Nearby::cos_sin_about(&at(k), 0.0), Ball::cos_sin_about(&at(k), 0.0));
            assert!(off(&c, &cos) < 1.0 && off(&s, &sin) < 1.0);
        }
    }
}
