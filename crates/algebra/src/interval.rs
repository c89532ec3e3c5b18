//! Intervals of real numbers with f64 bounds rounded outward; results computed in them are proved.
//!
//! Each bound is the f64 next to the rounded result, unless an error-free transformation shows the result exact or
//! already on the safe side; so integers and short binary fractions stay points. No rounding mode, no FMA.

use super::enclosure::Enclosure;
use super::number::{Angle, Number};
use super::ring::{Field, Ring, exact_cos_sin};
use rug::{Float, Rational, float::Round};

/// All real numbers from `lo` to `hi`; an infinite bound means none is known.
///
/// Comparison is of the bounds. Subtraction and products forget that their operands may be the same number, so
/// intervals satisfy the ring laws only up to inclusion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    lo: f64,
    hi: f64,
}

/// Returns the exact rounding error of `sum = x + y` (Knuth's `TwoSum`); NaN when that overflowed.
#[inline(always)]
fn sum_error(x: f64, y: f64, sum: f64) -> f64 {
    let y_part = sum - x;
    let x_part = sum - y_part;
    (x - x_part) + (y - y_part)
}

/// Returns the exact rounding error of `product = x y` (Dekker); NaN if it might be inexact itself.
#[inline(always)]
fn product_error(x: f64, y: f64, product: f64) -> f64 {
    let split = |a: f64| {
        let c = 134_217_729.0 * a;
        let head = c - (c - a);
        (head, a - head)
    };
    let safe = |a: f64| (1e-250..1e250).contains(&a.abs());
    if !(safe(x) && safe(y) && safe(product)) {
        return f64::NAN;
    }
    let ((x_head, x_tail), (y_head, y_tail)) = (split(x), split(y));
    ((x_head * y_head - product) + x_head * y_tail + x_tail * y_head) + x_tail * y_tail
}

/// Returns a lower bound of `rounded + error`; next below when the error is unknown.
#[inline(always)]
fn down(rounded: f64, error: f64) -> f64 {
    if error >= 0.0 { rounded } else { rounded.next_down() }
}

/// Returns an upper bound of `rounded + error`; next above when the error is unknown.
#[inline(always)]
fn up(rounded: f64, error: f64) -> f64 {
    if error <= 0.0 { rounded } else { rounded.next_up() }
}

/// Returns a bound of `x y`, by the given rounding. Zero times an unknown (infinite) bound is zero.
#[inline(always)]
fn product(x: f64, y: f64, round: impl Fn(f64, f64) -> f64) -> f64 {
    if x == 0.0 || y == 0.0 {
        return 0.0;
    }
    let product = x * y;
    round(product, product_error(x, y, product))
}

/// Returns whether `1/x` is exact: `x` is a power of two whose inverse is normal, or infinite.
fn has_exact_inverse(x: f64) -> bool {
    x.to_bits() & ((1 << 52) - 1) == 0 && (1.0 / x).is_normal() || x.is_infinite()
}

impl Interval {
    /// All real numbers: nothing is known.
    pub const ENTIRE: Self = Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY };

    /// Returns the interval from `lo` to `hi`; all reals when a bound is NaN.
    ///
    /// # Panics
    /// When `lo > hi`.
    #[must_use]
    pub fn new(lo: f64, hi: f64) -> Self {
        if lo.is_nan() || hi.is_nan() {
            return Self::ENTIRE;
        }
        assert!(lo <= hi, "the lower bound {lo} is above the upper bound {hi}");
        Self { lo, hi }
    }

    /// Returns the point `x`; all reals when `x` is not finite.
    #[must_use]
    pub fn from_f64(x: f64) -> Self {
        if x.is_finite() { Self { lo: x, hi: x } } else { Self::ENTIRE }
    }

    /// Returns all numbers at most `radius` from `mid`.
    #[must_use]
    pub fn around(mid: f64, radius: f64) -> Self {
        Self::from_f64(mid).add(&Self::new(-radius.abs(), radius.abs()))
    }

    /// Returns the f64 neighbours of a correctly rounded number, which enclose it.
    fn about(x: f64) -> Self {
        Self::new(x.next_down(), x.next_up())
    }

    /// Returns the lower bound.
    #[must_use]
    #[inline(always)]
    pub fn lo(&self) -> f64 {
        self.lo
    }

    /// Returns the upper bound.
    #[must_use]
    #[inline(always)]
    pub fn hi(&self) -> f64 {
        self.hi
    }

    /// Returns a number inside, the middle up to rounding; finite always.
    #[must_use]
    pub fn mid(&self) -> f64 {
        match (self.lo.is_finite(), self.hi.is_finite()) {
            (true, true) => (0.5 * self.lo + 0.5 * self.hi).clamp(self.lo, self.hi),
            (true, false) => f64::MAX,
            (false, true) => f64::MIN,
            (false, false) => 0.0,
        }
    }

    /// Returns a distance from `mid` that no number of the interval exceeds.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.sub(&Self::from_f64(self.mid())).magnitude()
    }

    /// Returns the largest absolute value.
    #[must_use]
    pub fn magnitude(&self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    /// Returns the smallest absolute value.
    #[must_use]
    pub fn mignitude(&self) -> f64 {
        if self.contains(0.0) { 0.0 } else { self.lo.abs().min(self.hi.abs()) }
    }

    /// Returns whether `x` lies in the interval (NaN never does).
    #[must_use]
    pub fn contains(&self, x: f64) -> bool {
        self.lo <= x && x <= self.hi
    }

    /// Returns whether every number of `self` lies strictly between the bounds of `other`.
    #[must_use]
    pub fn is_interior_to(&self, other: &Self) -> bool {
        (other.lo < self.lo || other.lo == f64::NEG_INFINITY) && (self.hi < other.hi || other.hi == f64::INFINITY)
    }

    /// Returns the smallest interval that holds both.
    #[must_use]
    pub fn hull(&self, other: &Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// Returns the common numbers; `None` if there are none.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        let (lo, hi) = (self.lo.max(other.lo), self.hi.min(other.hi));
        (lo <= hi).then_some(Self { lo, hi })
    }

    /// Returns `x^2`, never negative.
    #[must_use]
    pub fn square(&self) -> Self {
        let (small, large) = (self.mignitude(), self.magnitude());
        Self { lo: product(small, small, down).max(0.0), hi: product(large, large, up) }
    }

    /// Returns `1/x`; `None` when 0 lies inside.
    #[must_use]
    pub fn inverse(&self) -> Option<Self> {
        let bound = |x: f64, round: fn(f64) -> f64| {
            if has_exact_inverse(x) { 1.0 / x } else { round(1.0 / x) }
        };
        (!self.contains(0.0)).then(|| Self { lo: bound(self.hi, f64::next_down), hi: bound(self.lo, f64::next_up) })
    }

    /// Returns the square root; `None` when some number of the interval has none.
    #[must_use]
    pub fn sqrt(&self) -> Option<Self> {
        let bound = |x: f64, round: fn(f64) -> f64| {
            let root = x.sqrt();
            let square = root * root;
            let exact = x == 0.0 || x.is_infinite() || (square - x == 0.0 && product_error(root, root, square) == 0.0);
            if exact { root } else { round(root) }
        };
        (self.lo >= 0.0).then(|| Self { lo: bound(self.lo, f64::next_down), hi: bound(self.hi, f64::next_up) })
    }
}

impl Ring for Interval {
    fn zero() -> Self {
        Self { lo: 0.0, hi: 0.0 }
    }
    fn one() -> Self {
        Self { lo: 1.0, hi: 1.0 }
    }
    #[inline(always)]
    fn add(&self, other: &Self) -> Self {
        let (lo, hi) = (self.lo + other.lo, self.hi + other.hi);
        Self { lo: down(lo, sum_error(self.lo, other.lo, lo)), hi: up(hi, sum_error(self.hi, other.hi, hi)) }
    }
    #[inline(always)]
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    fn mul(&self, other: &Self) -> Self {
        let (x, y) = (self, other);
        let interval = |a, b, c, d| Self { lo: product(a, b, down), hi: product(c, d, up) };
        if x.lo < 0.0 && x.hi <= 0.0 {
            return x.neg().mul(y).neg();
        }
        if y.lo < 0.0 && y.hi <= 0.0 {
            return x.mul(&y.neg()).neg();
        }
        match (x.lo >= 0.0, y.lo >= 0.0) {
            (true, true) => interval(x.lo, y.lo, x.hi, y.hi),
            (true, false) => interval(x.hi, y.lo, x.hi, y.hi),
            (false, true) => interval(x.lo, y.hi, x.hi, y.hi),
            (false, false) => interval(x.lo, y.hi, x.hi, y.hi).hull(&interval(x.hi, y.lo, x.lo, y.lo)),
        }
    }
    #[inline(always)]
    fn neg(&self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
    fn is_zero(&self) -> bool {
        self.lo == 0.0 && self.hi == 0.0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        let bound = |round| Float::with_val_round(53, q, round).0.to_f64_round(round);
        Some(Self { lo: bound(Round::Down), hi: bound(Round::Up) })
    }
    fn from_integer(n: i32) -> Self {
        Self::from_f64(f64::from(n))
    }
    fn cos_sin(angle: &Angle) -> Option<(Self, Self)> {
        if angle.is_exact() {
            let (cos, sin) = exact_cos_sin(angle);
            return Some((Self::from_rational(&cos)?, Self::from_rational(&sin)?));
        }
        // The angle of the file itself, not the rational that stands in for it in exact work.
        let (cos, sin) = angle.cos_sin_f64();
        Some((Self::about(cos), Self::about(sin)))
    }
    fn from_number(number: &Number) -> Option<Self> {
        if number.is_exact() { Self::from_rational(number.rational()) } else { Some(Self::about(number.to_f64())) }
    }
}

/// Pivots are chosen by their least absolute value; an interval that contains 0 is no pivot.
impl Field for Interval {
    fn inverse(&self) -> Option<Self> {
        Self::inverse(self)
    }
    fn pivot_size(&self) -> f64 {
        self.mignitude()
    }
    const PIVOT_ZERO: f64 = 0.0;
}

impl From<&Enclosure> for Interval {
    fn from(x: &Enclosure) -> Self {
        let bound = |round| x.middle().to_f64_round(round);
        let off = Float::with_val(53, Float::i_exp(1, x.off())).to_f64_round(Round::Up);
        let off = if x.off() == i32::MIN { 0.0 } else { off.max(f64::MIN_POSITIVE) };
        Self { lo: bound(Round::Down), hi: bound(Round::Up) }.add(&Self::around(0.0, off))
    }
}
