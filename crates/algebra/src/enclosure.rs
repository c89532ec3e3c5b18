//! Real numbers enclosed by a float of many digits and a power of two that bounds its error.
//!
//! The irrational numbers of a file are enclosed, and so are results computed from them until they are rounded once. A
//! proof about such a number then holds for the number of the file. Bounds are powers of two: a sum of errors is bounded by
//! the largest one times the next power of two above their number.

use super::number::{Angle, Number};
use super::ring::{Ring, exact_cos_sin};
use rug::ops::AssignRound;
use rug::{Float, Rational, float::Constant, float::Round};
use std::cmp::Ordering;

/// Precision in bits: 960 for the longest numbers of proofs, and 500 that a chain of motions with a base 1e150 away
/// loses.
pub const BITS: u32 = 1536;
/// An exponent of two above a full turn.
const WHOLE_TURN: i32 = 3;
/// The exponent of the error of exact numbers, and of the size of zero.
const NONE: i32 = i32::MIN;

/// All real numbers at most `2^off` from `middle`.
///
/// Comparison is of middle and bound. Subtraction and products forget that their operands may be the same number.
#[derive(Clone, Debug, PartialEq)]
pub struct Enclosure {
    middle: Float,
    off: i32,
}

/// Returns the least power of two above a number, as an exponent.
fn size(x: &Float) -> i32 {
    x.get_exp().unwrap_or(NONE)
}

/// Returns the exponent of a product of powers of two.
fn times(one: i32, two: i32) -> i32 {
    if one == NONE || two == NONE { NONE } else { one.saturating_add(two) }
}

/// Returns an exponent no smaller than that of a sum of powers of two.
fn total<const N: usize>(terms: [i32; N]) -> i32 {
    let largest = terms.into_iter().fold(NONE, i32::max);
    let count = terms.into_iter().filter(|term| *term != NONE).count();
    times(largest, if count < 2 { 0 } else { count.next_power_of_two().ilog2().cast_signed() })
}

/// Returns a rounded result with the exponent of its error: half a unit in the last place, or none if it is exact.
fn rounded((result, ordering): (Float, Ordering)) -> (Float, i32) {
    let error = if ordering == Ordering::Equal { NONE } else { times(size(&result), -BITS.cast_signed() - 1) };
    (result, error)
}

/// A Float of [`BITS`], with the exponent of its rounding.
macro_rules! nearest {
    ($value:expr) => {
        rounded(Float::with_val_round(BITS, $value, Round::Nearest))
    };
}

impl Enclosure {
    /// Returns an enclosure of a rounded result with these errors, as powers of two.
    fn new<const N: usize>((middle, rounding): (Float, i32), errors: [i32; N]) -> Self {
        Self { middle, off: total([total(errors), rounding]) }
    }

    /// Returns the rational itself.
    #[must_use]
    pub fn of(q: &Rational) -> Self {
        Self::new(nearest!(q), [])
    }

    /// Returns a float itself.
    #[must_use]
    pub fn of_float(x: &Float) -> Self {
        Self::new(nearest!(x), [])
    }

    /// pi
    #[must_use]
    pub fn pi() -> Self {
        Self::new(nearest!(Constant::Pi), [])
    }

    /// Returns the enclosure widened by `2^off`.
    #[must_use]
    pub fn widened(self, off: i32) -> Self {
        Self { off: total([self.off, off]), ..self }
    }

    /// Returns the middle.
    #[must_use]
    pub fn middle(&self) -> &Float {
        &self.middle
    }

    /// Returns the exponent k of a bound `2^k` of the distance of the number from the middle.
    #[must_use]
    pub fn off(&self) -> i32 {
        self.off
    }

    /// Returns a bound of the distance of the number from the middle: 0 for an exact number.
    #[must_use]
    pub fn error(&self) -> Float {
        if self.off == NONE { Float::new(BITS) } else { Float::with_val(BITS, 1) << self.off }
    }

    /// Returns the exponent k of a bound `2^k` of the size of the middle; the least there is of zero.
    #[must_use]
    pub fn size(&self) -> i32 {
        size(&self.middle)
    }

    /// Returns whether the number may be zero.
    #[must_use]
    pub fn holds_zero(&self) -> bool {
        // |middle| is at least 2^(size - 1).
        self.middle.is_zero() || (self.off != NONE && self.size() <= self.off.saturating_add(1))
    }

    /// Moves the middle to 0 if 0 is enclosed; otherwise returns the same enclosure.
    #[must_use]
    pub fn settled(self) -> Self {
        if !self.holds_zero() {
            return self;
        }
        Self { off: total([self.off, self.size()]), middle: Float::new(BITS) }
    }

    /// Returns the middle over another ring, 0 if the number may be 0.
    #[must_use]
    pub fn image<R: Ring>(&self) -> Option<R> {
        if self.holds_zero() { Some(R::zero()) } else { R::from_rational(&self.middle.to_rational()?) }
    }

    /// Returns `self q`.
    #[must_use]
    pub fn scaled(&self, q: &Rational) -> Self {
        self.mul(&Self::of(q))
    }

    /// Returns `self / other`; `None` if the divisor may be too near to 0.
    #[must_use]
    pub fn over(&self, other: &Self) -> Option<Self> {
        let (below, off) = (size(&other.middle).checked_sub(1)?, other.off);
        if other.middle.is_zero() || !other.middle.is_finite() || (off != NONE && off > below.saturating_sub(2)) {
            return None;
        }
        // Both the divisor and the number it stands for are at least 2^(below - 1).
        let ratio = nearest!(&self.middle / &other.middle);
        let of_divisor = times(times(size(&ratio.0), off), 1 - below);
        Some(Self::new(ratio, [times(self.off, 1 - below), of_divisor]))
    }

    /// Returns the square root; `None` if the number is negative. If it may be 0, the root is enclosed about 0.
    #[must_use]
    pub fn sqrt(&self) -> Option<Self> {
        if self.middle < 0 && !self.holds_zero() {
            return None;
        }
        if self.holds_zero() {
            // All are below 2^(off + 3), their roots below half that exponent.
            let bound = if self.off == NONE { NONE } else { (self.off.saturating_add(4)) / 2 + 1 };
            return Some(Self { middle: Float::new(BITS), off: bound });
        }
        // |sqrt x - sqrt y| <= |x - y| / sqrt x, which is at least 2^((size - 2) / 2).
        let below = (self.size() - 2).div_euclid(2);
        let root = nearest!(self.middle.sqrt_ref());
        Some(Self::new(root, [times(self.off, -below)]))
    }

    /// Returns cosine and sine of an angle in radians: neither changes faster than the angle.
    #[must_use]
    pub fn cos_sin_of(&self) -> (Self, Self) {
        let (mut sin, mut cos) = (Float::new(BITS), Float::new(BITS));
        // Both together take half the time.
        let (sin_is, cos_is) = (&mut sin, &mut cos).assign_round(self.middle.sin_cos_ref(), Round::Nearest);
        (Self::new(rounded((cos, cos_is)), [self.off]), Self::new(rounded((sin, sin_is)), [self.off]))
    }

    /// Returns the angle of the direction (other, self) in (-pi, pi]; `None` if there may be none.
    #[must_use]
    pub fn atan2(&self, other: &Self) -> Option<Self> {
        let off = total([self.off, other.off]);
        let reach = self.size().max(other.size()).checked_sub(1)?;
        if off != NONE && off > reach.saturating_sub(2) {
            return None;
        }
        // The segment between both points stays 2^(reach - 1) away from the origin, so the angle changes by at most
        // its length over that distance.
        let angle = nearest!(self.middle.atan2_ref(&other.middle));
        // If the direction may be on either side of the cut at -pi and pi, every angle is possible.
        let is_cut = other.middle < 0 && self.holds_zero() && !self.is_zero();
        Some(Self::new(angle, [if is_cut { WHOLE_TURN } else { times(off, 1 - reach) }]))
    }

    /// Returns the arc cosine, as the angle of (x, sqrt(1 - x^2)); `None` outside [-1, 1].
    #[must_use]
    pub fn acos(&self) -> Option<Self> {
        self.complement()?.atan2(self)
    }

    /// Returns the arc sine; `None` outside [-1, 1].
    #[must_use]
    pub fn asin(&self) -> Option<Self> {
        self.atan2(&self.complement()?)
    }

    /// Returns `sqrt(1 - x^2)`.
    fn complement(&self) -> Option<Self> {
        Self::one().sub(self).mul(&Self::one().add(self)).sqrt()
    }
}

impl Ring for Enclosure {
    const ENCLOSES: bool = true;

    fn zero() -> Self {
        Self { middle: Float::new(BITS), off: NONE }
    }
    fn one() -> Self {
        Self::from_integer(1)
    }
    fn add(&self, other: &Self) -> Self {
        Self::new(nearest!(&self.middle + &other.middle), [self.off, other.off])
    }
    fn sub(&self, other: &Self) -> Self {
        Self::new(nearest!(&self.middle - &other.middle), [self.off, other.off])
    }
    fn mul(&self, other: &Self) -> Self {
        let (one, two) = (size(&self.middle), size(&other.middle));
        let errors = [times(one, other.off), times(self.off, two), times(self.off, other.off)];
        Self::new(nearest!(&self.middle * &other.middle), errors)
    }
    fn neg(&self) -> Self {
        Self { middle: Float::with_val(BITS, -&self.middle), off: self.off }
    }
    fn is_zero(&self) -> bool {
        self.middle.is_zero() && self.off == NONE
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Some(Self::of(q))
    }
    fn from_integer(n: i32) -> Self {
        Self { middle: Float::with_val(BITS, n), off: NONE }
    }
    fn cos_sin(angle: &Angle) -> Option<(Self, Self)> {
        Some(angle.enclosed().cloned().unwrap_or_else(|| {
            let (cos, sin) = exact_cos_sin(angle);
            (Self::of(&cos), Self::of(&sin))
        }))
    }
    fn from_number(number: &Number) -> Option<Self> {
        Self::from_known(number.rational(), number.enclosed())
    }
    fn from_known(q: &Rational, known: Option<&Enclosure>) -> Option<Self> {
        Some(known.cloned().unwrap_or_else(|| Self::of(q)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(n: i32, d: i32) -> Enclosure {
        Enclosure::of(&Rational::from((n, d)))
    }

    /// Checks that a number known to 4000 bits lies in the enclosure, and that this is narrow.
    fn judge(found: &Enclosure, truth: &Float) {
        let away = Float::with_val(4000, truth - found.middle()).abs();
        let bound = Float::with_val(64, Float::i_exp(1, found.off().max(-1_000_000)));
        assert!(away <= bound, "{truth} is not in {found:?}");
        assert!(found.off() < found.size().max(0) - 1500, "{found:?} is wide");
    }

    #[test]
    fn functions_are_enclosed() {
        let long = |n: i32, d: i32| Float::with_val(4000, n) / d;
        for (n, d) in [(1, 3), (-2, 7), (5, 9), (1, 1_000_000_007), (-999_999, 1_000_000)] {
            let (x, truth) = (of(n, d), long(n, d));
            judge(&x, &truth);
            let (cos, sin) = x.cos_sin_of();
            judge(&cos, &truth.clone().cos());
            judge(&sin, &truth.clone().sin());
            judge(&x.acos().unwrap(), &truth.clone().acos());
            judge(&x.asin().unwrap(), &truth.clone().asin());
            judge(&x.mul(&x).sqrt().unwrap(), &truth.clone().abs());
            judge(&x.atan2(&of(-3, 7)).unwrap(), &truth.clone().atan2(&long(-3, 7)));
            judge(&of(2, 3).over(&x).unwrap(), &Float::with_val(4000, long(2, 3) / &truth));
            judge(&x.add(&of(2, 3)).mul(&x).sub(&of(1, 5)), &((truth.clone() + long(2, 3)) * &truth - long(1, 5)));
        }
        judge(&Enclosure::pi(), &Float::with_val(4000, Constant::Pi));
    }

    #[test]
    fn cancellation_is_told() {
        let root = of(2, 1).sqrt().unwrap();
        let nothing = root.mul(&root).sub(&of(2, 1));
        assert!(nothing.holds_zero() && !nothing.is_zero() && nothing.off() < -1500);
        assert!(of(1, 1).over(&nothing).is_none() && nothing.atan2(&nothing).is_none());
        assert_eq!(nothing.image::<f64>(), Some(0.0));
        let root = nothing.sqrt().unwrap();
        assert!(root.holds_zero() && root.off() < -700 && root.off() > nothing.off() / 2);
        assert!(of(-1, 3).sqrt().is_none() && of(4, 3).acos().is_none());
        // Sums of exact numbers are exact while they fit.
        assert!(of(1, 4).add(&of(3, 4)).sub(&of(1, 1)).is_zero());
        let far = Enclosure::from_integer(10).mul(&of(1, 3));
        assert!(far.sub(&of(10, 3)).holds_zero());
    }
}
