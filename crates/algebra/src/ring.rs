//! The coefficient rings: everything above this file is written once and run over any of them.
//!
//! Methods instead of operators: rug's reference operators return incomplete values, and a local trait can be
//! implemented for foreign types.

use super::enclosure::Enclosure;
use super::int::Int;
use super::number::{Angle, HalfTangent};
use num_complex::Complex;
use rug::{Integer, Rational};
use std::borrow::Cow;
use std::fmt::Debug;

/// A commutative ring with one, into which the rationals (almost) map.
///
/// `is_zero` is structural, never a tolerance.
pub trait Ring: Clone + PartialEq + Debug {
    /// Returns the neutral element of addition.
    #[must_use]
    fn zero() -> Self;
    /// Returns the neutral element of multiplication.
    #[must_use]
    fn one() -> Self;
    /// Returns `self + other`.
    #[must_use]
    fn add(&self, other: &Self) -> Self;
    /// Returns `self - other`.
    #[must_use]
    fn sub(&self, other: &Self) -> Self;
    /// Returns `self * other`.
    #[must_use]
    fn mul(&self, other: &Self) -> Self;
    /// Returns `-self`.
    #[must_use]
    fn neg(&self) -> Self;
    /// Returns whether this is the zero of the ring, exactly.
    fn is_zero(&self) -> bool;
    /// Returns the image of a rational number; `None` if the denominator is not invertible (an unlucky prime).
    fn from_rational(q: &Rational) -> Option<Self>;

    /// Returns the image of a small integer.
    ///
    /// # Panics
    /// Never: integers have an image in every ring.
    #[must_use]
    fn from_integer(n: i32) -> Self {
        Self::from_rational(&Rational::from(n)).expect("integers map into every ring")
    }

    /// `self += a b`; types whose numbers own memory do it in place.
    fn add_product(&mut self, a: &Self, b: &Self) {
        *self = self.add(&a.mul(b));
    }

    /// Returns the integer that an element of a ring of integers is, if it fits an i128: sums of many products then run in machine
    /// words. `None` in all other rings.
    fn to_wide(&self) -> Option<i128> {
        None
    }

    /// Returns the image of a sum of products of machine words, and of any other integer of this size.
    ///
    /// # Panics
    /// Never: integers have an image in every ring.
    #[must_use]
    fn from_wide(n: i128) -> Self {
        Self::from_rational(&Rational::from(n)).expect("integers map into every ring")
    }

    /// Returns the integer that an element of a ring of integers is, if it fits a word. `None` in all other rings.
    #[inline]
    fn to_word(&self) -> Option<i64> {
        self.to_wide().and_then(|n| i64::try_from(n).ok())
    }

    /// Returns the image of a word.
    #[must_use]
    #[inline]
    fn from_word(n: i64) -> Self {
        Self::from_wide(n.into())
    }

    /// Returns the integer that an element of a ring of integers is, of any size. `None` in all other rings.
    fn to_large(&self) -> Option<Cow<'_, Integer>> {
        None
    }

    /// Returns the integer itself, if the ring is that of the integers. `None` in all other rings.
    #[inline(always)]
    fn as_int(&self) -> Option<&Int> {
        None
    }

    /// Returns the image of an integer of any size.
    ///
    /// # Panics
    /// Never: integers have an image in every ring.
    #[must_use]
    fn from_large(n: Integer) -> Self {
        Self::from_rational(&Rational::from(n)).expect("integers map into every ring")
    }

    /// Returns cosine and sine of an angle, see [`exact_cos_sin`].
    /// Inexact rings override this with the correctly rounded values. `None` for an unlucky prime.
    #[must_use]
    fn cos_sin(angle: &Angle) -> Option<(Self, Self)> {
        let (cos, sin) = exact_cos_sin(angle);
        Some((Self::from_rational(&cos)?, Self::from_rational(&sin)?))
    }

    /// Returns the image of a number of a mechanism file. `None` for an unlucky prime.
    #[must_use]
    fn from_number(number: &super::number::Number) -> Option<Self> {
        Self::from_rational(number.rational())
    }

    /// Returns the image of a number that a rational stands for, and that an enclosure holds unless the rational is exact.
    /// `None` for an unlucky prime.
    #[must_use]
    fn from_known(q: &Rational, _known: Option<&Enclosure>) -> Option<Self> {
        Self::from_rational(q)
    }

    /// Whether elements enclose numbers that rationals only approximate.
    const ENCLOSES: bool = false;

    /// Whether an operation takes a few machine instructions, so that a formula of a few operations is shorter than a call. See
    /// [`formula`].
    const LIGHT: bool = false;

    /// Number of binary digits of a ring of floating-point numbers; `None` in all other rings. Quantities derived from the data of
    /// a mechanism are computed exactly, or enclosed, and rounded to these digits once.
    const DIGITS: Option<u32> = None;
}

/// Runs a formula of a few operations of a ring. Over light rings it is repeated wherever it is used, because the poses of an arm pass
/// through it; over all others it exists once and is called, because one product there costs more than the call.
#[inline(always)]
pub fn formula<R: Ring, T>(compute: impl FnOnce() -> T) -> T {
    if R::LIGHT { compute() } else { called(compute) }
}

#[inline(never)]
fn called<T>(compute: impl FnOnce() -> T) -> T {
    compute()
}

/// Returns `((1 - t^2)/(1 + t^2), 2t/(1 + t^2))`, cosine and sine of an angle from its rational half-angle tangent t.
#[must_use]
pub fn exact_cos_sin(angle: &Angle) -> (Rational, Rational) {
    match angle.half_tangent() {
        HalfTangent::Infinite => (Rational::from(-1), Rational::new()),
        HalfTangent::Finite(t) => {
            let square = Rational::from(t * t);
            let denominator = Rational::from(&square + 1);
            ((1 - square) / &denominator, Rational::from(t * 2) / denominator)
        }
    }
}

/// A ring with exact division, for fraction-free algorithms. Only exact types have it, so that an exact algorithm on
/// an inexact ring does not compile:
///
/// ```compile_fail
/// fn exact_algorithm<R: looproot_algebra::ring::Domain>(_: R) {}
/// exact_algorithm(1.0_f64);
/// ```
pub trait Domain: Ring {
    /// Returns `self / other`; `None` if `other` is zero or the division leaves a remainder.
    #[must_use]
    fn checked_div_exact(&self, other: &Self) -> Option<Self>;

    /// Returns `self / other` for a division known to leave no remainder; types may omit the test.
    ///
    /// # Panics
    /// If `other` is zero, or if there is a remainder, unless the type omits the test.
    #[must_use]
    fn div_exact(&self, other: &Self) -> Self {
        self.checked_div_exact(other).expect("the division leaves no remainder")
    }
}

/// A ring in which every element but zero has an inverse.
pub trait Field: Ring {
    /// Returns the inverse; `None` for zero.
    #[must_use]
    fn inverse(&self) -> Option<Self>;

    /// Returns the quality of a pivot: the absolute value in inexact fields, 1 for every nonzero element of an exact one.
    /// One elimination code thereby pivots for stability in f64 and takes any nonzero entry in exact fields.
    fn pivot_size(&self) -> f64;

    /// Pivots of this relative size or below are zero: 0 in exact fields, a rounding level in inexact ones.
    const PIVOT_ZERO: f64;

    /// Scales a coefficient list that ends in a nonzero number to the one chosen to stand for all its multiples: ending
    /// in 1, or over the rationals primitive integers ending in a positive one, which keeps Euclid's algorithm short.
    fn normalise(coefficients: &mut [Self]) {
        if let Some(inverse) = coefficients.last().and_then(Self::inverse) {
            for c in coefficients {
                *c = c.mul(&inverse);
            }
        }
    }

    /// Makes rows orthonormal if that improves conditioning; leaves them unchanged in exact fields (the default).
    fn orthonormalise<const N: usize>(_rows: &mut [[Self; N]]) {}
}

impl Ring for f64 {
    const DIGITS: Option<u32> = Some(f64::MANTISSA_DIGITS);
    const LIGHT: bool = true;

    fn zero() -> Self {
        0.0
    }
    fn one() -> Self {
        1.0
    }
    #[inline(always)]
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    #[inline(always)]
    fn sub(&self, other: &Self) -> Self {
        self - other
    }
    #[inline(always)]
    fn mul(&self, other: &Self) -> Self {
        self * other
    }
    #[inline(always)]
    fn neg(&self) -> Self {
        -self
    }
    fn is_zero(&self) -> bool {
        *self == 0.0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Some(super::number::nearest_f64(q))
    }
    fn from_integer(n: i32) -> Self {
        f64::from(n)
    }
    fn cos_sin(angle: &Angle) -> Option<(Self, Self)> {
        Some(angle.cos_sin_f64())
    }
    fn from_number(number: &super::number::Number) -> Option<Self> {
        Some(number.to_f64())
    }
}

impl Field for f64 {
    #[inline(always)]
    fn inverse(&self) -> Option<Self> {
        (*self != 0.0).then(|| 1.0 / self)
    }
    #[inline(always)]
    fn pivot_size(&self) -> f64 {
        self.abs()
    }
    const PIVOT_ZERO: f64 = 1e-14;

    fn orthonormalise<const N: usize>(rows: &mut [[Self; N]]) {
        // Modified Gram-Schmidt, each row against the finished ones, twice: enough for orthogonality to rounding.
        for i in 0..rows.len() {
            let (done, rest) = rows.split_at_mut(i);
            let row = &mut rest[0];
            for _ in 0..2 {
                for other in done.iter() {
                    let dot: f64 = row.iter().zip(other).map(|(x, y)| x * y).sum();
                    for (x, y) in row.iter_mut().zip(other) {
                        *x -= dot * y;
                    }
                }
                let norm = row.iter().map(|x| x * x).sum::<f64>().sqrt();
                if norm > 0.0 {
                    for x in row.iter_mut() {
                        *x /= norm;
                    }
                }
            }
        }
    }
}

impl<T: Ring> Ring for Complex<T> {
    const LIGHT: bool = T::LIGHT;

    fn zero() -> Self {
        Complex { re: T::zero(), im: T::zero() }
    }
    fn one() -> Self {
        Complex { re: T::one(), im: T::zero() }
    }
    #[inline(always)]
    fn add(&self, other: &Self) -> Self {
        formula::<T, _>(|| Complex { re: self.re.add(&other.re), im: self.im.add(&other.im) })
    }
    #[inline(always)]
    fn sub(&self, other: &Self) -> Self {
        formula::<T, _>(|| Complex { re: self.re.sub(&other.re), im: self.im.sub(&other.im) })
    }
    #[inline(always)]
    fn mul(&self, other: &Self) -> Self {
        formula::<T, _>(|| Complex {
            re: self.re.mul(&other.re).sub(&self.im.mul(&other.im)),
            im: self.re.mul(&other.im).add(&self.im.mul(&other.re)),
        })
    }
    #[inline(always)]
    fn neg(&self) -> Self {
        Complex { re: self.re.neg(), im: self.im.neg() }
    }
    fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Some(Complex { re: T::from_rational(q)?, im: T::zero() })
    }
    fn from_integer(n: i32) -> Self {
        Complex { re: T::from_integer(n), im: T::zero() }
    }
    fn cos_sin(angle: &Angle) -> Option<(Self, Self)> {
        let (cos, sin) = T::cos_sin(angle)?;
        Some((Complex { re: cos, im: T::zero() }, Complex { re: sin, im: T::zero() }))
    }
    fn from_number(number: &super::number::Number) -> Option<Self> {
        Some(Complex { re: T::from_number(number)?, im: T::zero() })
    }
}

impl<T: Field + Domain> Domain for Complex<T> {
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        Some(self.mul(&other.inverse()?))
    }
}

impl<T: Field> Field for Complex<T> {
    #[inline(always)]
    fn inverse(&self) -> Option<Self> {
        // Over f64 this can overflow for entries beyond 1e150, which scaled mechanisms never reach.
        formula::<T, _>(|| {
            let square = self.re.mul(&self.re).add(&self.im.mul(&self.im)).inverse()?;
            Some(Complex { re: self.re.mul(&square), im: self.im.neg().mul(&square) })
        })
    }
    #[inline(always)]
    fn pivot_size(&self) -> f64 {
        let (re, im) = (self.re.pivot_size(), self.im.pivot_size());
        if re > im { re } else { im }
    }
    const PIVOT_ZERO: f64 = T::PIVOT_ZERO;
}
