//! Dual numbers `a + b eps`, `eps^2 = 0`: derivatives, and lines in place of directions.

use super::number::{Angle, Number};
use super::ring::{Field, Ring};
use rug::Rational;

/// A dual number over any ring: a value and its derivative, or an angle's function and its spatial part.
///
/// Numbers with value 0 have no inverse, so the dual numbers are a [`Ring`] and no field.
///
/// # Example
/// ```
/// use looproot_algebra::{dual::Dual, ring::Ring};
/// use rug::Rational;
///
/// // x^3 - 2x at 3: the value and the derivative.
/// let x = Dual::variable(Rational::from(3));
/// let cube = x.mul(&x).mul(&x);
/// let found = cube.sub(&x.add(&x));
/// assert_eq!((found.value, found.epsilon), (Rational::from(21), Rational::from(25)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<R> {
    /// The part without `eps`.
    pub value: R,
    /// The coefficient of `eps`.
    pub epsilon: R,
}

impl<R: Ring> Dual<R> {
    /// Returns a constant: its derivative is 0.
    #[must_use]
    pub fn constant(value: R) -> Self {
        Self { value, epsilon: R::zero() }
    }

    /// Returns the variable of differentiation at the given value: its derivative is 1.
    #[must_use]
    pub fn variable(value: R) -> Self {
        Self { value, epsilon: R::one() }
    }

    /// Returns cosine and sine of the dual angle `theta + eps d`: `(cos - eps d sin, sin + eps d cos)`.
    ///
    /// With such angles the equations of a spherical mechanism are those of the spatial one whose axes are `d` apart, by the
    /// principle of transference.
    #[must_use]
    pub fn angle(cos: R, sin: R, d: &R) -> (Self, Self) {
        let (minus_d_sin, d_cos) = (d.mul(&sin).neg(), d.mul(&cos));
        (Self { value: cos, epsilon: minus_d_sin }, Self { value: sin, epsilon: d_cos })
    }
}

impl<F: Field> Dual<F> {
    /// Returns `1/a - eps b/a^2`; `None` when the value has no inverse.
    #[must_use]
    pub fn inverse(&self) -> Option<Self> {
        let value = self.value.inverse()?;
        let epsilon = self.epsilon.mul(&value).mul(&value).neg();
        Some(Self { value, epsilon })
    }
}

impl<R: Ring> Ring for Dual<R> {
    fn zero() -> Self {
        Self::constant(R::zero())
    }
    fn one() -> Self {
        Self::constant(R::one())
    }
    #[inline(always)]
    fn add(&self, other: &Self) -> Self {
        Self { value: self.value.add(&other.value), epsilon: self.epsilon.add(&other.epsilon) }
    }
    #[inline(always)]
    fn sub(&self, other: &Self) -> Self {
        Self { value: self.value.sub(&other.value), epsilon: self.epsilon.sub(&other.epsilon) }
    }
    #[inline(always)]
    fn mul(&self, other: &Self) -> Self {
        Self {
            value: self.value.mul(&other.value),
            epsilon: self.value.mul(&other.epsilon).add(&self.epsilon.mul(&other.value)),
        }
    }
    #[inline(always)]
    fn neg(&self) -> Self {
        Self { value: self.value.neg(), epsilon: self.epsilon.neg() }
    }
    fn is_zero(&self) -> bool {
        self.value.is_zero() && self.epsilon.is_zero()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        R::from_rational(q).map(Self::constant)
    }
    fn from_integer(n: i32) -> Self {
        Self::constant(R::from_integer(n))
    }
    fn cos_sin(angle: &Angle) -> Option<(Self, Self)> {
        R::cos_sin(angle).map(|(cos, sin)| (Self::constant(cos), Self::constant(sin)))
    }
    fn from_number(number: &Number) -> Option<Self> {
        R::from_number(number).map(Self::constant)
    }
}
