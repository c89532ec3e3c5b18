//! Numbers of twice the precision of f64: an unevaluated sum of two of them, about 31 decimal digits.

use super::number::nearest_f64;
use super::ring::{Field, Ring};
use rug::Rational;

/// `high + low` with `|low| <= ulp(high) / 2`. \[Dekker1971\]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

/// Returns the sum and its rounding error, exactly.
#[inline(always)]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let other = sum - a;
    (sum, (a - (sum - other)) + (b - other))
}

/// As `two_sum`, for `|a| >= |b|`.
#[inline(always)]
fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// Returns the two halves of the digits of a number.
#[inline(always)]
fn halves(a: f64) -> (f64, f64) {
    let shifted = 134_217_729.0 * a;
    let high = shifted - (shifted - a);
    (high, a - high)
}

/// Returns the product and its rounding error, exactly (below 1e300).
#[inline(always)]
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((ah, al), (bh, bl)) = (halves(a), halves(b));
    (product, ((ah * bh - product) + ah * bl + al * bh) + al * bl)
}

impl DoubleDouble {
    /// Bound on the relative error of one operation.
    pub const UNIT_ROUNDOFF: f64 = 1.0 / (1_u64 << 50) as f64 / (1_u64 << 50) as f64;

    /// Returns the quotient by a number of f64 other than 0: that of the leading parts, and that of what is left.
    #[must_use]
    #[inline]
    pub fn divided_by(self, by: f64) -> Self {
        let first = self.high / by;
        let (product, error) = two_product(first, by);
        // The leading parts agree, so that their difference is exact.
        let second = ((self.high - product) - error + self.low) / by;
        let (high, low) = quick_two_sum(first, second);
        Self { high, low }
    }

    /// Returns the two numbers of which this is the sum, the larger one first.
    #[must_use]
    pub fn parts(self) -> [f64; 2] {
        [self.high, self.low]
    }

    /// Returns the nearest f64.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        self.high
    }
}

impl From<f64> for DoubleDouble {
    fn from(x: f64) -> Self {
        Self { high: x, low: 0.0 }
    }
}

impl Ring for DoubleDouble {
    const DIGITS: Option<u32> = Some(106);

    fn zero() -> Self {
        Self::from(0.0)
    }
    fn one() -> Self {
        Self::from(1.0)
    }
    #[inline]
    fn add(&self, other: &Self) -> Self {
        let (sum, error) = two_sum(self.high, other.high);
        let (tail, tail_error) = two_sum(self.low, other.low);
        let (sum, error) = quick_two_sum(sum, error + tail);
        let (high, low) = quick_two_sum(sum, error + tail_error);
        Self { high, low }
    }
    #[inline]
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    #[inline]
    fn mul(&self, other: &Self) -> Self {
        let (product, error) = two_product(self.high, other.high);
        let (high, low) = quick_two_sum(product, error + (self.high * other.low + self.low * other.high));
        Self { high, low }
    }
    #[inline]
    fn neg(&self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
    fn is_zero(&self) -> bool {
        self.high == 0.0
    }
    fn from_integer(n: i32) -> Self {
        Self::from(f64::from(n))
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        let high = nearest_f64(q);
        let rest = Rational::from_f64(high).map_or(0.0, |h| nearest_f64(&(q - h)));
        let (high, low) = quick_two_sum(high, rest);
        Some(Self { high, low })
    }
}

impl Field for DoubleDouble {
    fn inverse(&self) -> Option<Self> {
        if self.high == 0.0 {
            return None;
        }
        // One Newton step from the f64 inverse, and a second for its last digits.
        let mut x = Self::from(1.0 / self.high);
        for _ in 0..2 {
            let error = Self::one().sub(&self.mul(&x));
            x = x.add(&x.mul(&error));
        }
        Some(x)
    }
    fn pivot_size(&self) -> f64 {
        self.high.abs()
    }
    const PIVOT_ZERO: f64 = 1e-29;
}
