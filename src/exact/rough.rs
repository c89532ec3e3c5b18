//! Complex discs in f64: their refutations are rigorous, and the remaining cases are examined in balls.

use crate::algebra::ball::Ball;
use crate::algebra::ring::Ring;
use rug::Rational;

/// All complex numbers within `radius` of a midpoint; everything, where one of the three is no number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rough {
    /// Real part of the midpoint.
    pub re: f64,
    /// Imaginary part of the midpoint.
    pub im: f64,
    /// The radius.
    pub radius: f64,
}

impl Rough {
    /// A disc that holds a ball.
    pub fn of<const BITS: u32>(ball: &Ball<BITS>) -> Self {
        let (re, im) = (ball.re().to_f64(), ball.im().to_f64());
        // Rounding to f64 moves each part of the midpoint, and the radius, by half a unit in the last place.
        Self { re, im, radius: enclosing(ball.radius().to_f64(), re.abs() + im.abs()) }
    }

    /// Returns whether two discs may have a number in common; overflow counts as yes.
    pub fn may_meet(&self, other: &Self) -> bool {
        let reach = (self.radius + other.radius) * (1.0 + 1e-15);
        !((self.re - other.re).abs() * (1.0 - 1e-15) > reach || (self.im - other.im).abs() * (1.0 - 1e-15) > reach)
    }

    /// No less than the absolute value of the midpoint, but for rounding.
    fn size(&self) -> f64 {
        self.re.abs() + self.im.abs()
    }
}

/// A radius with two units in the last place of a number of that size, the rounding of a few operations and underflow.
fn enclosing(radius: f64, size: f64) -> f64 {
    (radius + 2.0 * f64::EPSILON * size) * (1.0 + 1e-14) + f64::MIN_POSITIVE
}

impl Ring for Rough {
    fn zero() -> Self {
        Self { re: 0.0, im: 0.0, radius: 0.0 }
    }
    fn one() -> Self {
        Self { re: 1.0, ..Self::zero() }
    }
    fn add(&self, other: &Self) -> Self {
        let (re, im) = (self.re + other.re, self.im + other.im);
        Self { re, im, radius: enclosing(self.radius + other.radius, re.abs() + im.abs()) }
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    fn mul(&self, other: &Self) -> Self {
        let re = self.re * other.re - self.im * other.im;
        let im = self.re * other.im + self.im * other.re;
        // The four products add up to that of both sizes, in absolute value.
        let (one, two) = (self.size(), other.size());
        Self { re, im, radius: enclosing(one * other.radius + (two + other.radius) * self.radius, one * two) }
    }
    fn neg(&self) -> Self {
        Self { re: -self.re, im: -self.im, ..*self }
    }
    fn is_zero(&self) -> bool {
        self.re == 0.0 && self.im == 0.0 && self.radius == 0.0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Ball::<64>::from_rational(q).map(|ball| Self::of(&ball))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Float;

    #[test]
    fn discs_hold_what_balls_hold() {
        let number =
            |p: i64, q: u64| Ball::<256>::from_rational(&Rational::from((p, q))).expect("rationals have balls");
        let unit = Ball::<256>::point(&Float::new(64), &Float::with_val(64, 1));
        let mut exact = number(1, 3).add(&unit.mul(&number(-5, 7)));
        let mut rough = Rough::of(&exact);
        for k in 1_u64..200 {
            let other = number(3 * i64::try_from(k).expect("small") - 250, 97).add(&unit.mul(&number(11, k + 2)));
            let disc = Rough::of(&other);
            (exact, rough) = match k % 3 {
                0 => (exact.mul(&other), rough.mul(&disc)),
                1 => (exact.add(&other), rough.add(&disc)),
                _ => (exact.sub(&other), rough.sub(&disc)),
            };
            let off = |x: &Float, y: f64| Float::with_val(64, x - y).abs();
            let distance = off(exact.re(), rough.re).hypot(&off(exact.im(), rough.im));
            assert!(distance <= rough.radius, "{k}");
            assert!(rough.may_meet(&Rough::of(&exact)), "{k}");
        }
        assert!(rough.radius < 1e-9 * rough.size());
        assert!(!Rough::of(&number(1, 3)).may_meet(&Rough::of(&number(1_000_001, 3_000_000))));
        let all = Rough { re: f64::NAN, im: 0.0, radius: f64::INFINITY };
        assert!(all.may_meet(&rough) && all.mul(&rough).may_meet(&Rough::one()));
    }
}
