//! Real numbers of many bits with a bound on their errors in f64: several times faster than complex balls.
//!
//! A middle is rounded once an operation, by at most half of its last bit. Bounds are computed in f64, and enlarged by a part of
//! 2^-48 of themselves for the roundings of their own sums. A bound that overflows or is NaN bounds nothing.

use super::enclosing::{Enclosing, distance_from_middle};
use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::{Field, Ring};
use rug::{Float, Rational};

/// Bits of a middle.
const BITS: u32 = 384;
/// Twice the bound of the rounding of a middle to these bits, as part of its size: 2^-383.
const ROUNDING: f64 = f64::from_bits((1023 - 383) << 52);
/// Factor that covers the roundings of a bound.
const UP: f64 = 1.0 + 32.0 * (f64::EPSILON / 2.0);
/// Several times the loss by underflow.
const TINY: f64 = 1e-300;

/// All real numbers within a radius of a middle.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RealBall {
    middle: Float,
    radius: f64,
}

impl RealBall {
    /// Returns the ball of a middle that was rounded.
    fn with(middle: Float, radius: f64) -> Self {
        let size = size(&middle);
        Self { middle, radius: (radius + ROUNDING * size) * UP + TINY }
    }
}

/// Returns the absolute value, rounded.
fn size(x: &Float) -> f64 {
    x.to_f64().abs()
}

impl Ring for RealBall {
    fn zero() -> Self {
        Self { middle: Float::new(BITS), radius: 0.0 }
    }
    fn one() -> Self {
        Self { middle: Float::with_val(BITS, 1), radius: 0.0 }
    }
    fn add(&self, other: &Self) -> Self {
        if other.is_zero() {
            return self.clone();
        }
        if self.is_zero() {
            return other.clone();
        }
        Self::with(Float::with_val(BITS, &self.middle + &other.middle), self.radius + other.radius)
    }
    fn sub(&self, other: &Self) -> Self {
        if other.is_zero() {
            return self.clone();
        }
        Self::with(Float::with_val(BITS, &self.middle - &other.middle), self.radius + other.radius)
    }
    fn mul(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::zero();
        }
        // A size that is below all doubles counts as the least of them; the enlargement covers roundings.
        let bound = |x: &Self| if x.middle.is_zero() { 0.0 } else { size(&x.middle).max(f64::MIN_POSITIVE) };
        let (own, others) = (bound(self), bound(other));
        let spread = own * other.radius + others * self.radius + self.radius * other.radius;
        Self::with(Float::with_val(BITS, &self.middle * &other.middle), spread)
    }
    fn neg(&self) -> Self {
        Self { middle: -self.middle.clone(), radius: self.radius }
    }
    fn is_zero(&self) -> bool {
        self.middle.is_zero() && self.radius == 0.0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        let middle = Float::with_val(BITS, q);
        Some(if middle == *q { Self { middle, radius: 0.0 } } else { Self::with(middle, 0.0) })
    }
    fn from_integer(n: i32) -> Self {
        Self { middle: Float::with_val(BITS, n), radius: 0.0 }
    }
}

/// Pivots are chosen by their least absolute value; a ball that contains 0 is no pivot.
impl Field for RealBall {
    fn inverse(&self) -> Option<Self> {
        let least = self.at_least();
        // |1/x - 1/m| <= r/(|x| |m|). The square of a large pivot may be above all doubles, and nothing is divided by that.
        let spread = self.radius / least / least;
        (least > 0.0).then(|| Self::with(self.middle.clone().recip(), spread))
    }
    fn pivot_size(&self) -> f64 {
        self.at_least()
    }
    const PIVOT_ZERO: f64 = 0.0;
}

impl Enclosing for RealBall {
    const BITS: u32 = BITS;
    /// Returns the ball about the real part: the imaginary one is 0 wherever these numbers are used.
    fn near(re: &Float, im: &Float, radius: f64) -> Self {
        Self::with(Float::with_val(BITS, re), radius + size(im))
    }
    fn of(known: &Enclosure) -> Self {
        let off = distance_from_middle(known);
        let middle = Float::with_val(BITS, known.middle());
        if off == 0.0 && middle == *known.middle() { Self { middle, radius: 0.0 } } else { Self::with(middle, off) }
    }
    fn middle(&self) -> Self {
        Self { radius: 0.0, ..self.clone() }
    }
    fn at_most(&self) -> f64 {
        (size(&self.middle) + self.radius) * UP + TINY
    }
    fn at_least(&self) -> f64 {
        let least = size(&self.middle) * (2.0 - UP) - self.radius * UP;
        if least > 0.0 { least } else { 0.0 }
    }
    fn is_right(&self) -> bool {
        self.middle > 0
    }
}

impl RealBall {
    /// Returns the middle and the radius.
    pub(super) fn parts(&self) -> (&Float, f64) {
        (&self.middle, self.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn balls_hold_what_is_computed_exactly() {
        let of = |p: i32, q: i32| Rational::from((p, q));
        let ball = |x: &Rational| RealBall::from_rational(x).unwrap();
        for k in 1..60 {
            let (x, y) = (of(7 * k % 23 - 11, 9), of(5 * k % 17 - 8, 7 + k));
            let exact = Rational::from(&x * &y) - of(1, 3);
            let sum = ball(&x).mul(&ball(&y)).sub(&ball(&of(1, 3)));
            let (middle, radius) = sum.parts();
            let off = (middle.to_rational().unwrap() - &exact).abs();
            assert!(off <= Rational::from_f64(radius).unwrap() && radius < 1e-110, "{k}");
            let inverse = ball(&exact).inverse().unwrap();
            let off = (inverse.middle.to_rational().unwrap() - exact.recip()).abs();
            assert!(off <= Rational::from_f64(inverse.radius).unwrap() && inverse.radius < 1e-105, "{k}");
        }
        assert!(ball(&of(1, 3)).sub(&ball(&of(1, 3))).inverse().is_none());
        assert!(RealBall { middle: Float::with_val(BITS, 1), radius: f64::NAN }.inverse().is_none());
    }
}
