//! Complex ball arithmetic: a number is enclosed by a midpoint and a radius.
//!
//! Every operation rounds its midpoint correctly to `BITS` bits and adds the bound of that rounding to the radius, which
//! is itself rounded up. A ball that does not contain 0 proves that a number is not 0. \[Johansson2017\]

use super::enclosure::Enclosure;
use super::ring::{Field, Ring};
use rug::float::Round;
use rug::ops::{AddAssignRound, DivAssignRound, MulAssignRound};
use rug::{Float, Rational};

/// Precision of a radius in bits; its own digits matter little.
const RADIUS_BITS: u32 = 32;

/// All complex numbers within `radius` of a midpoint of `BITS` bits.
#[derive(Clone, Debug, PartialEq)]
pub struct Ball<const BITS: u32> {
    re: Float,
    im: Float,
    radius: Float,
}

/// Returns `x` rounded up to a radius.
fn up(x: &Float) -> Float {
    Float::with_val_round(RADIUS_BITS, x, Round::Up).0
}

/// Returns an upper bound of `|x|`.
fn magnitude(x: &Float) -> Float {
    up(&x.as_abs())
}

fn sum(mut x: Float, y: &Float) -> Float {
    x.add_assign_round(y, Round::Up);
    x
}

fn product(mut x: Float, y: &Float) -> Float {
    x.mul_assign_round(y, Round::Up);
    x
}

impl<const BITS: u32> Ball<BITS> {
    /// Returns the ball of one point.
    #[must_use]
    pub fn point(re: &Float, im: &Float) -> Self {
        Self::rounded(re, im, Float::new(RADIUS_BITS))
    }

    /// Returns the ball around a midpoint, which is rounded, with a radius that is enlarged by that.
    fn rounded(re: &Float, im: &Float, radius: Float) -> Self {
        let (re, im) = (Float::with_val(BITS, re), Float::with_val(BITS, im));
        Self { re, im, radius }.with_rounding()
    }

    /// Returns the ball of another precision, its midpoint rounded to this one.
    #[must_use]
    pub fn of_precision<const OTHER: u32>(other: &Ball<OTHER>) -> Self {
        Self::rounded(&other.re, &other.im, other.radius.clone())
    }

    /// Enlarges the radius by a bound on the rounding of both parts of the midpoint to the nearest.
    fn with_rounding(mut self) -> Self {
        let size = sum(magnitude(&self.re), &magnitude(&self.im));
        if !size.is_zero() {
            self.radius = sum(self.radius, &(size >> (BITS - 1)));
        }
        self
    }

    /// Returns the same ball with a larger radius.
    #[must_use]
    pub fn enlarged(mut self, by: &Float) -> Self {
        self.radius = sum(self.radius, &magnitude(by));
        self
    }

    /// Real part of the midpoint.
    #[must_use]
    pub fn re(&self) -> &Float {
        &self.re
    }

    /// Imaginary part of the midpoint.
    #[must_use]
    pub fn im(&self) -> &Float {
        &self.im
    }

    /// Returns the radius.
    #[must_use]
    pub fn radius(&self) -> &Float {
        &self.radius
    }

    /// Returns the midpoint alone.
    #[must_use]
    pub fn midpoint(&self) -> Self {
        Self { radius: Float::new(RADIUS_BITS), ..self.clone() }
    }

    /// Returns the complex conjugate.
    #[must_use]
    pub fn conjugate(&self) -> Self {
        Self { im: -self.im.clone(), ..self.clone() }
    }

    /// Returns an upper bound of the absolute value of every number in the ball.
    #[must_use]
    pub fn upper(&self) -> Float {
        sum(sum(magnitude(&self.re), &magnitude(&self.im)), &self.radius)
    }

    /// Returns a lower bound of the absolute value of every number in the ball, 0 if it contains 0.
    #[must_use]
    pub fn lower(&self) -> Float {
        let part = |x: &Float| Float::with_val_round(RADIUS_BITS, &*x.as_abs(), Round::Down).0;
        let (re, im) = (part(&self.re), part(&self.im));
        let size = if re > im { re } else { im };
        let (rest, _) = Float::with_val_round(RADIUS_BITS, &size - &self.radius, Round::Down);
        if rest.is_sign_negative() || rest.is_nan() { Float::new(RADIUS_BITS) } else { rest }
    }

    /// Returns whether 0 may lie in the ball. A ball that overflowed contains everything.
    #[must_use]
    pub fn contains_zero(&self) -> bool {
        !(self.lower() > 0)
    }

    /// Returns whether the two balls may have a number in common.
    #[must_use]
    pub fn overlaps(&self, other: &Self) -> bool {
        self.sub(other).contains_zero()
    }

    /// Returns the inverse; `None` if the ball contains 0.
    #[must_use]
    pub fn inverse(&self) -> Option<Self> {
        let lower = self.lower();
        if !(lower > 0) {
            return None;
        }
        // 1/m = conj(m)/|m|^2; 32 more bits keep the error of the two roundings below one unit.
        let precision = BITS + 32;
        let square = Float::with_val(precision, &self.re * &self.re + &self.im * &self.im);
        let (re, im) = (Float::with_val(precision, &self.re / &square), Float::with_val(precision, &self.im / &square));
        // |1/z - 1/m| <= r / (|z| |m|)
        let mut error = self.radius.clone();
        error.div_assign_round(&lower, Round::Up);
        error.div_assign_round(&lower, Round::Up);
        let inverse = Self::rounded(&re, &-im, error);
        Some(inverse.with_rounding())
    }

    /// Returns `self / other`; `None` if the divisor contains 0.
    #[must_use]
    pub fn over(&self, other: &Self) -> Option<Self> {
        Some(self.mul(&other.inverse()?))
    }

    /// Converts the ball to another precision.
    #[must_use]
    pub fn convert<const OTHER: u32>(&self) -> Ball<OTHER> {
        Ball::rounded(&self.re, &self.im, self.radius.clone())
    }
}

impl<const BITS: u32> Ring for Ball<BITS> {
    fn zero() -> Self {
        Self { re: Float::new(BITS), im: Float::new(BITS), radius: Float::new(RADIUS_BITS) }
    }
    fn one() -> Self {
        Self { re: Float::with_val(BITS, 1), ..Self::zero() }
    }
    fn add(&self, other: &Self) -> Self {
        let re = Float::with_val(BITS, &self.re + &other.re);
        let im = Float::with_val(BITS, &self.im + &other.im);
        Self { re, im, radius: sum(self.radius.clone(), &other.radius) }.with_rounding()
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    fn mul(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::zero();
        }
        let re = Float::with_val(BITS, &self.re * &other.re - &self.im * &other.im);
        let im = Float::with_val(BITS, &self.re * &other.im + &self.im * &other.re);
        // |a + x| |b + y| - |a| |b| for errors x and y
        let size = |b: &Self| sum(magnitude(&b.re), &magnitude(&b.im));
        let mut radius = product(size(self), &other.radius);
        radius = sum(radius, &product(size(other), &self.radius));
        radius = sum(radius, &product(self.radius.clone(), &other.radius));
        Self { re, im, radius }.with_rounding()
    }
    fn neg(&self) -> Self {
        Self { re: -self.re.clone(), im: -self.im.clone(), radius: self.radius.clone() }
    }
    fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero() && self.radius.is_zero()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        let re = Float::with_val(BITS, q);
        Some(Self { re, ..Self::zero() }.with_rounding())
    }
}

/// Pivots are chosen by their least absolute value; a ball that contains 0 is no pivot.
impl<const BITS: u32> Field for Ball<BITS> {
    fn inverse(&self) -> Option<Self> {
        Self::inverse(self)
    }
    fn pivot_size(&self) -> f64 {
        self.lower().to_f64()
    }
    const PIVOT_ZERO: f64 = 0.0;
}

impl<const BITS: u32> From<&Enclosure> for Ball<BITS> {
    fn from(x: &Enclosure) -> Self {
        let ball = Self::point(x.middle(), &Float::new(BITS));
        if x.off() == i32::MIN { ball } else { ball.enlarged(&Float::with_val(RADIUS_BITS, Float::i_exp(1, x.off()))) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Short = Ball<64>;

    fn of(p: i64, q: i64) -> Short {
        Short::from_rational(&Rational::from((p, q))).expect("rationals have balls")
    }

    #[test]
    fn balls_contain_what_is_computed_exactly() {
        // (1/3 + 1/7) * 5/11 / (2/13) = 10/21 * 65/22 = 325/231
        let value = of(1, 3).add(&of(1, 7)).mul(&of(5, 11)).over(&of(2, 13)).expect("2/13 is not 0");
        let off = value.sub(&Short::from_rational(&Rational::from((325, 231))).expect("rationals have balls"));
        assert!(off.contains_zero());
        assert!(*value.radius() < 1e-17 && *value.radius() > 0);
        assert!(!value.sub(&of(325_000_000, 231_000_001)).contains_zero());
    }

    #[test]
    fn complex_products_and_inverses_agree() {
        let z = Short::point(&Float::with_val(64, 3), &Float::with_val(64, -4)).enlarged(&Float::with_val(32, 1e-6));
        let one = z.mul(&z.inverse().expect("3 - 4i is not 0"));
        assert!(one.sub(&Short::one()).contains_zero());
        assert!(*one.radius() < 1e-5);
        assert_eq!(Short::zero().inverse(), None);
        assert!(z.sub(&z.conjugate()).lower() > 7.9);
    }

    #[test]
    fn a_ball_around_zero_has_no_inverse_and_overlaps_its_neighbours() {
        let near = Short::zero().enlarged(&Float::with_val(32, 0.1));
        assert!(near.contains_zero() && near.inverse().is_none());
        assert!(near.overlaps(&of(1, 20)) && !near.overlaps(&of(1, 5)));
    }
}
