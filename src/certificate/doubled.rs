//! Complex discs of twice the digits of f64, which the checker tries where those of f64 are too wide: many times faster than long ones.
//!
//! With u = 2^-53 a sum of two such numbers is off by at most 4 u^2 of itself, and a product by at most 7 u^2
//! \[JoldesMullerPopescu2017\]. A sum of two products is off by at most 12 u^2 of the sizes of their factors, sizes being sums of the
//! absolute values of both parts. Bounds take 64 u^2 of each; they are computed in f64, and enlarged by a part of 2^-48 of themselves
//! for the roundings of their own sums. Underflow loses less than the smallest normal number. A number that overflows gets a radius
//! that is infinite or NaN.

use super::enclosing::{Enclosing, distance_from_middle};
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::{Field, Ring};
use rug::{Float, Rational};

/// 64 u^2
const ROUNDING: f64 = DoubleDouble::UNIT_ROUNDOFF;
/// Factor that covers the roundings of a radius.
const UP: f64 = 1.0 + 32.0 * (f64::EPSILON / 2.0);
/// Several times the loss by underflow.
const TINY: f64 = 1e-300;
/// Newton steps for an inverse, from the 53 bits of f64.
const STEPS: usize = 2;

/// All complex numbers within a radius of a centre. A radius that is NaN bounds nothing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Doubled {
    re: DoubleDouble,
    im: DoubleDouble,
    radius: f64,
}

impl Doubled {
    /// Returns the sum of the absolute values of both parts, rounded.
    fn size(&self) -> f64 {
        self.re.to_f64().abs() + self.im.to_f64().abs()
    }

    /// Returns the disc about a centre that was rounded.
    fn with(re: DoubleDouble, im: DoubleDouble, radius: f64) -> Self {
        let size = re.to_f64().abs() + im.to_f64().abs();
        Self { re, im, radius: (radius + ROUNDING * size) * UP + TINY }
    }

    fn is_real(&self) -> bool {
        self.im.is_zero()
    }
}

impl Ring for Doubled {
    fn zero() -> Self {
        Self { re: DoubleDouble::zero(), im: DoubleDouble::zero(), radius: 0.0 }
    }
    fn one() -> Self {
        Self { re: DoubleDouble::one(), ..Self::zero() }
    }
    fn add(&self, other: &Self) -> Self {
        if other.is_zero() {
            return self.clone();
        }
        if self.is_zero() {
            return other.clone();
        }
        Self::with(self.re.add(&other.re), self.im.add(&other.im), self.radius + other.radius)
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
        let (re, im) = if self.is_real() && other.is_real() {
            (self.re.mul(&other.re), DoubleDouble::zero())
        } else {
            let re = self.re.mul(&other.re).sub(&self.im.mul(&other.im));
            (re, self.re.mul(&other.im).add(&self.im.mul(&other.re)))
        };
        Self::with(re, im, spread + ROUNDING * own * others)
    }
    fn neg(&self) -> Self {
        Self { re: self.re.neg(), im: self.im.neg(), radius: self.radius }
    }
    fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero() && self.radius == 0.0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        let re = DoubleDouble::from_rational(q)?;
        let is_exact = Rational::from_f64(re.to_f64()).is_some_and(|near| near == *q);
        let point = Self { re, ..Self::zero() };
        Some(if is_exact { point } else { Self::with(point.re, point.im, 0.0) })
    }
    fn from_integer(n: i32) -> Self {
        Self { re: DoubleDouble::from(f64::from(n)), ..Self::zero() }
    }
}

/// Pivots are chosen by their least absolute value; a disc that contains 0 is no pivot.
impl Field for Doubled {
    fn inverse(&self) -> Option<Self> {
        let start = num_complex::Complex::new(self.re.to_f64(), self.im.to_f64()).inv();
        let centre = Self { re: DoubleDouble::from(start.re), im: DoubleDouble::from(start.im), radius: 0.0 };
        let two = Self::from_integer(2);
        let near = (0..STEPS).fold(centre, |x, _| x.mul(&two.sub(&self.middle().mul(&x))).middle());
        // For every m of the disc 1/m - x = x (1 - m x)/(m x), and |m x| >= 1 - |1 - m x|.
        let off = Self::one().sub(&self.mul(&near)).at_most();
        let spread = near.at_most() * off / (1.0 - off);
        (off < 0.5).then(|| Self::with(near.re, near.im, spread))
    }
    fn pivot_size(&self) -> f64 {
        self.at_least()
    }
    const PIVOT_ZERO: f64 = 0.0;
}

impl Doubled {
    /// Returns the centre in other numbers.
    pub(super) fn centre<S: Enclosing>(&self) -> S {
        let rest = |x: DoubleDouble| x.sub(&DoubleDouble::from(x.to_f64())).to_f64();
        S::holding(self.re.to_f64(), self.im.to_f64()).add(&S::holding(rest(self.re), rest(self.im)))
    }
}

impl Enclosing for Doubled {
    const BITS: u32 = 107;
    fn near(re: &Float, im: &Float, radius: f64) -> Self {
        Self::with(part(re), part(im), radius)
    }
    fn of(known: &Enclosure) -> Self {
        let (re, off) = (part(known.middle()), distance_from_middle(known));
        if off == 0.0 && *known.middle() == re.to_f64() {
            return Self { re, ..Self::zero() };
        }
        Self::with(re, DoubleDouble::zero(), off)
    }
    fn holding(re: f64, im: f64) -> Self {
        Self { re: DoubleDouble::from(re), im: DoubleDouble::from(im), radius: 0.0 }
    }
    fn middle(&self) -> Self {
        Self { radius: 0.0, ..self.clone() }
    }
    fn at_most(&self) -> f64 {
        (self.size() + self.radius) * UP
    }
    fn at_least(&self) -> f64 {
        let least = self.re.to_f64().abs().max(self.im.to_f64().abs()) * (2.0 - UP) - self.radius * UP;
        if least > 0.0 { least } else { 0.0 }
    }
    fn is_right(&self) -> bool {
        self.re.to_f64() > 0.0
    }
}

/// Returns a number to twice the digits of f64.
fn part(x: &Float) -> DoubleDouble {
    let high = x.to_f64();
    let low = Float::with_val(53, x - high).to_f64();
    DoubleDouble::from(high).add(&DoubleDouble::from(low))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::ball::Ball;

    #[test]
    fn discs_hold_what_long_numbers_compute() {
        let at = |k: i32| (Rational::from((7 * k % 23 - 11, 9)), Rational::from((5 * k % 17 - 8, 7)));
        let off = |near: &Doubled, far: &Ball<384>| {
            let float = |x: DoubleDouble| {
                let high = Float::with_val(384, x.to_f64());
                let low = x.sub(&DoubleDouble::from(x.to_f64())).to_f64();
                high + low
            };
            let ball = Ball::<384>::point(&float(near.re), &float(near.im));
            ball.sub(far).upper().to_f64() / near.radius
        };
        for k in 0..40 {
            let (a, b) = (Doubled::about(&at(k), 1e-40), Doubled::about(&at(k + 3), 1e-40));
            let (x, y) = (Ball::about(&at(k), 0.0), Ball::about(&at(k + 3), 0.0));
            let value = a.mul(&b).sub(&a);
            assert!(off(&value, &x.mul(&y).sub(&x)) < 1.0 && value.radius < 1e-26, "{k}");
            let ((c, s), (cos, sin)) = (Doubled::cos_sin_about(&at(k), 0.0), Ball::cos_sin_about(&at(k), 0.0));
            assert!(off(&c, &cos) < 1.0 && off(&s, &sin) < 1.0, "{k}");
            let inverse = b.inverse().unwrap();
            assert!(off(&inverse, &Ball::one().over(&y).unwrap()) < 1.0 && inverse.radius < 1e-25, "{k}");
        }
        let third = Doubled::from_rational(&Rational::from((1, 3))).unwrap();
        assert!(third.sub(&third).inverse().is_none());
        let huge = Doubled::from_integer(1 << 30);
        let overflown = (0..6).fold(huge, |x, _| x.mul(&x));
        assert!(overflown.inverse().is_none() && overflown.at_least() == 0.0);
    }
}
