//! Floating-point numbers with a bound of their error, for proofs that must be nearly as fast as these numbers.
//!
//! [`Bounded`] holds a computed number and a bound of its distance to the exact one. [`Magnitude`] holds bounds alone, of a
//! number and of its error: one evaluation in it bounds the errors of every evaluation of the same formula in f64 whose
//! inputs are no larger and no less exact.
//!
//! Errors are added up in f64. All their operations are sums and products of numbers that are not negative, so each
//! loses at most a relative 2^-52, and what is read is enlarged by a hundredth, which no formula of fewer than 10^13
//! operations loses. Underflow is covered by a tiny number that every product adds.

use super::double_double::DoubleDouble;
use super::ring::Ring;
use rug::Rational;

/// Half a unit in the last place of 1: the relative error of one operation in f64.
const ROUNDOFF: f64 = f64::EPSILON / 2.0;
/// Bounds are enlarged by this when they are read.
const MARGIN: f64 = 1.01;
/// More than a product loses where it, or the tail of one in double-double arithmetic, underflows.
const TINY: f64 = 1e-280;

/// Floating-point numbers of which every operation has a bounded relative error.
pub trait Floating: Ring + Copy {
    /// Bound on the relative error of one operation.
    const ROUNDOFF: f64;

    /// Returns the nearest f64, or one beside it.
    fn in_f64(self) -> f64;
}

impl Floating for f64 {
    const ROUNDOFF: f64 = ROUNDOFF;
    #[inline(always)]
    fn in_f64(self) -> f64 {
        self
    }
}

impl Floating for DoubleDouble {
    const ROUNDOFF: f64 = Self::UNIT_ROUNDOFF;
    #[inline(always)]
    fn in_f64(self) -> f64 {
        self.to_f64()
    }
}

/// A computed number, and a bound of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounded<T> {
    /// The computed number.
    pub value: T,
    error: f64,
}

impl<T: Floating> Bounded<T> {
    /// Returns all numbers within `error` of `value`.
    #[must_use]
    pub fn new(value: T, error: f64) -> Self {
        Self { value, error }
    }

    /// Returns a bound of the error; NaN or infinite where none is known.
    #[must_use]
    pub fn error(self) -> f64 {
        self.error * MARGIN
    }

    /// Returns an upper bound of the absolute value.
    #[must_use]
    pub fn size(self) -> f64 {
        (self.value.in_f64().abs() + self.error) * MARGIN
    }

    /// Returns the number rounded to f64.
    #[must_use]
    pub fn in_f64(self) -> Bounded<f64> {
        let value = self.value.in_f64();
        // The nearest f64, or one beside it.
        Bounded { value, error: self.error + 4.0 * ROUNDOFF * value.abs() + TINY }
    }
}

impl<T: Floating> Ring for Bounded<T> {
    const LIGHT: bool = T::LIGHT;

    fn zero() -> Self {
        Self::new(T::zero(), 0.0)
    }
    fn one() -> Self {
        Self::new(T::one(), 0.0)
    }
    #[inline(always)]
    fn add(&self, other: &Self) -> Self {
        let value = self.value.add(&other.value);
        Self { value, error: self.error + other.error + T::ROUNDOFF * value.in_f64().abs() }
    }
    #[inline(always)]
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    #[inline(always)]
    fn mul(&self, other: &Self) -> Self {
        let value = self.value.mul(&other.value);
        let moved = self.value.in_f64().abs() * other.error + self.error * (other.value.in_f64().abs() + other.error);
        Self { value, error: moved + T::ROUNDOFF * value.in_f64().abs() + TINY }
    }
    #[inline(always)]
    fn neg(&self) -> Self {
        Self { value: self.value.neg(), error: self.error }
    }
    fn is_zero(&self) -> bool {
        self.value.is_zero() && self.error == 0.0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        let value = T::from_rational(q)?;
        Some(Self::new(value, 2.0 * T::ROUNDOFF * value.in_f64().abs() + TINY))
    }
}

/// A bound of the absolute value of a computed number, and one of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Magnitude {
    size: f64,
    error: f64,
}

impl Magnitude {
    /// Returns a bound of numbers of at most this size that are off by at most `error`.
    #[must_use]
    pub fn new(size: f64, error: f64) -> Self {
        Self { size, error }
    }

    /// Returns the bound of the size of the computed number.
    #[must_use]
    pub fn size(self) -> f64 {
        self.size * MARGIN
    }

    /// Returns the bound of its error; NaN or infinite where none is known.
    #[must_use]
    pub fn error(self) -> f64 {
        self.error * MARGIN
    }
}

impl From<Bounded<f64>> for Magnitude {
    fn from(x: Bounded<f64>) -> Self {
        Self { size: x.value.abs(), error: x.error }
    }
}

impl Ring for Magnitude {
    fn zero() -> Self {
        Self::new(0.0, 0.0)
    }
    fn one() -> Self {
        Self::new(1.0, 0.0)
    }
    #[inline(always)]
    fn add(&self, other: &Self) -> Self {
        let size = self.size + other.size;
        Self { size, error: self.error + other.error + ROUNDOFF * size }
    }
    #[inline(always)]
    fn sub(&self, other: &Self) -> Self {
        self.add(other)
    }
    #[inline(always)]
    fn mul(&self, other: &Self) -> Self {
        let size = self.size * other.size + TINY;
        let moved = self.size * other.error + self.error * (other.size + other.error);
        Self { size, error: moved + ROUNDOFF * size + TINY }
    }
    #[inline(always)]
    fn neg(&self) -> Self {
        *self
    }
    fn is_zero(&self) -> bool {
        self.size == 0.0 && self.error == 0.0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Bounded::<f64>::from_rational(q).map(Self::from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn formula<R: Ring>([a, b, c, d]: &[R; 4]) -> R {
        let sum = a.mul(b).sub(&c.mul(d)).mul(&a.add(c));
        sum.mul(&sum).sub(&b.mul(&d.sub(a)).mul(c))
    }

    #[test]
    fn errors_are_bounded() {
        // A product of differences with cancellation, against exact arithmetic.
        for seed in 1..2000_i64 {
            let mut state = seed.wrapping_mul(6_364_136_223_846_793_005);
            let mut next = || {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                Rational::from(((state >> 33) % 2_000_001 - 1_000_000, 999_983))
            };
            let numbers: [Rational; 4] = std::array::from_fn(|_| next());
            let exact = formula(&numbers);
            let checked = |value: Rational, error: f64| (value - &exact).abs() <= Rational::from_f64(error).unwrap();
            let short = numbers.each_ref().map(|q| Bounded::<f64>::from_rational(q).unwrap());
            let bounded = formula(&short);
            assert!(checked(Rational::from_f64(bounded.value).unwrap(), bounded.error()));
            let magnitude = formula(&short.map(Magnitude::from));
            assert!(bounded.error() <= magnitude.error() && bounded.value.abs() <= magnitude.size());
            let long = formula(&numbers.each_ref().map(|q| Bounded::<DoubleDouble>::from_rational(q).unwrap()));
            assert!(long.error() < 1e-6 * bounded.error());
            let rounded = long.in_f64();
            assert!(checked(Rational::from_f64(rounded.value).unwrap(), rounded.error()));
        }
    }
}
