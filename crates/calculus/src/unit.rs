//! The operations of a ring for formulas that divide, take a root or measure an angle.
//!
//! Dual numbers and series have zero divisors and are no fields. Their elements with an invertible value are units, which
//! suffices for the formulas of this crate.

use looproot_algebra::dual::Dual;
use looproot_algebra::enclosure::Enclosure;
use looproot_algebra::number::nearest_f64;
use looproot_algebra::ring::{Field, Ring};
use looproot_algebra::series::Series;
use num_complex::Complex;
use rug::{Integer, Rational};

/// A number below this share of 1 is a rounded zero: some thousand units in the last place.
const ROUNDED_ZERO: f64 = 1e-12;

/// A ring with known units.
pub trait Unit: Ring {
    /// Returns the inverse; `None` if the element is no unit.
    #[must_use]
    fn reciprocal(&self) -> Option<Self>;

    /// Returns the absolute value of the part that decides whether this is a unit; larger ones divide better.
    fn size(&self) -> f64;

    /// Returns whether this is no unit: 0 in exact rings, a rounded zero relative to 1 in inexact ones.
    fn is_small(&self) -> bool;

    /// Returns `self / other`; `None` if `other` is no unit.
    #[must_use]
    fn over(&self, other: &Self) -> Option<Self> {
        Some(self.mul(&other.reciprocal()?))
    }
}

/// An ordered ring with some square roots.
pub trait Root: Unit {
    /// Returns the nonnegative square root; `None` if the ring has none.
    #[must_use]
    fn sqrt(&self) -> Option<Self>;

    /// Returns whether the value is below 0.
    fn is_negative(&self) -> bool;
}

/// A ring in which angles have cosines and sines, and points of the plane have angles.
pub trait Analytic: Root {
    /// Returns cosine and sine of an angle in radians.
    #[must_use]
    fn cos_sin_of(&self) -> (Self, Self);

    /// Returns the angle of the point `(x, y)` in (-pi, pi]; `None` at a point without one.
    #[must_use]
    fn atan2(y: &Self, x: &Self) -> Option<Self>;

    /// Returns an element with this value and no other part.
    #[must_use]
    fn from_value(value: f64) -> Self;
}

impl Unit for f64 {
    fn reciprocal(&self) -> Option<Self> {
        Field::inverse(self)
    }
    fn size(&self) -> f64 {
        self.abs()
    }
    fn is_small(&self) -> bool {
        !(self.abs() > ROUNDED_ZERO)
    }
}

impl Root for f64 {
    fn sqrt(&self) -> Option<Self> {
        (*self >= 0.0).then(|| f64::sqrt(*self))
    }
    fn is_negative(&self) -> bool {
        *self < 0.0
    }
}

impl Analytic for f64 {
    fn cos_sin_of(&self) -> (Self, Self) {
        (self.cos(), self.sin())
    }
    fn atan2(y: &Self, x: &Self) -> Option<Self> {
        // Adding 0 turns -0 into 0, so that the angle of the negative axis is pi.
        (*x != 0.0 || *y != 0.0).then(|| f64::atan2(y + 0.0, *x))
    }
    fn from_value(value: f64) -> Self {
        value
    }
}

impl Unit for Rational {
    fn reciprocal(&self) -> Option<Self> {
        Field::inverse(self)
    }
    fn size(&self) -> f64 {
        nearest_f64(self).abs()
    }
    fn is_small(&self) -> bool {
        self.is_zero()
    }
}

impl Root for Rational {
    /// Returns the root of a square of a rational number, and of no other.
    fn sqrt(&self) -> Option<Self> {
        let root = |n: &Integer| n.is_perfect_square().then(|| n.clone().sqrt());
        Some(Rational::from((root(self.numer())?, root(self.denom())?)))
    }
    fn is_negative(&self) -> bool {
        *self < 0
    }
}

impl Unit for Enclosure {
    fn reciprocal(&self) -> Option<Self> {
        Self::one().over(self)
    }
    fn size(&self) -> f64 {
        self.middle().to_f64().abs()
    }
    /// Returns whether it may be 0; a number that is not small is proved to be a unit.
    fn is_small(&self) -> bool {
        self.holds_zero()
    }
    fn over(&self, other: &Self) -> Option<Self> {
        Self::over(self, other)
    }
}

impl Root for Enclosure {
    fn sqrt(&self) -> Option<Self> {
        if self.is_zero() { Some(Self::zero()) } else { Self::sqrt(self) }
    }
    fn is_negative(&self) -> bool {
        self.middle().is_sign_negative() && !self.middle().is_zero()
    }
}

impl<R: Root + Field> Unit for Complex<R> {
    fn reciprocal(&self) -> Option<Self> {
        Field::inverse(self)
    }
    fn size(&self) -> f64 {
        self.re.size().max(self.im.size())
    }
    fn is_small(&self) -> bool {
        self.re.is_small() && self.im.is_small()
    }
}

impl Root for Complex<f64> {
    /// Returns the principal root, whose real part is not negative.
    fn sqrt(&self) -> Option<Self> {
        Some(Complex::sqrt(*self))
    }
    /// Returns whether the real part is below 0, as complex numbers have no order.
    fn is_negative(&self) -> bool {
        self.re < 0.0
    }
}

impl<R: Unit> Unit for Dual<R> {
    /// Returns `1/a - eps b/a^2`.
    fn reciprocal(&self) -> Option<Self> {
        let value = self.value.reciprocal()?;
        let epsilon = self.epsilon.mul(&value).mul(&value).neg();
        Some(Self { value, epsilon })
    }
    fn size(&self) -> f64 {
        self.value.size()
    }
    fn is_small(&self) -> bool {
        self.value.is_small()
    }
}

impl<R: Root> Root for Dual<R> {
    /// Returns `sqrt(a) + eps b/(2 sqrt(a))`, and 0 for 0.
    fn sqrt(&self) -> Option<Self> {
        if self.is_zero() {
            return Some(Self::zero());
        }
        let value = self.value.sqrt()?;
        let epsilon = self.epsilon.over(&value.add(&value))?;
        Some(Self { value, epsilon })
    }
    fn is_negative(&self) -> bool {
        self.value.is_negative()
    }
}

impl<R: Analytic> Analytic for Dual<R> {
    fn cos_sin_of(&self) -> (Self, Self) {
        let (cos, sin) = self.value.cos_sin_of();
        Self::angle(cos, sin, &self.epsilon)
    }
    /// Returns `atan2(y, x) + eps (x dy - y dx)/(x^2 + y^2)`.
    fn atan2(y: &Self, x: &Self) -> Option<Self> {
        let square = x.value.mul(&x.value).add(&y.value.mul(&y.value));
        let turned = x.value.mul(&y.epsilon).sub(&y.value.mul(&x.epsilon));
        Some(Self { value: R::atan2(&y.value, &x.value)?, epsilon: turned.over(&square)? })
    }
    fn from_value(value: f64) -> Self {
        Self::constant(R::from_value(value))
    }
}

impl<R: Unit, const N: usize> Unit for Series<R, N> {
    /// Returns the series with `a_0 b_k = -sum_{j >= 1} a_j b_{k-j}`.
    fn reciprocal(&self) -> Option<Self> {
        let first = self.coefficients[0].reciprocal()?;
        let mut inverse = Self::constant(first.clone());
        for k in 1..N {
            let mut sum = R::zero();
            for j in 1..=k {
                sum.add_product(&self.coefficients[j], &inverse.coefficients[k - j]);
            }
            inverse.coefficients[k] = sum.mul(&first).neg();
        }
        Some(inverse)
    }
    fn size(&self) -> f64 {
        self.coefficients[0].size()
    }
    fn is_small(&self) -> bool {
        self.coefficients[0].is_small()
    }
}

impl<R: Root, const N: usize> Root for Series<R, N> {
    /// Returns the series with `2 s_0 s_k = a_k - sum_{0 < j < k} s_j s_{k-j}`, and 0 for 0.
    fn sqrt(&self) -> Option<Self> {
        if self.is_zero() {
            return Some(Self::zero());
        }
        let first = self.coefficients[0].sqrt()?;
        let half = first.add(&first).reciprocal()?;
        let mut root = Self::constant(first);
        for k in 1..N {
            let mut rest = self.coefficients[k].clone();
            for j in 1..k {
                rest = rest.sub(&root.coefficients[j].mul(&root.coefficients[k - j]));
            }
            root.coefficients[k] = rest.mul(&half);
        }
        Some(root)
    }
    fn is_negative(&self) -> bool {
        self.coefficients[0].is_negative()
    }
}

impl<R: Analytic, const N: usize> Analytic for Series<R, N> {
    fn cos_sin_of(&self) -> (Self, Self) {
        let (cos, sin) = self.coefficients[0].cos_sin_of();
        let constant = (Self::constant(cos.clone()), Self::constant(sin.clone()));
        self.cos_sin_beyond(cos, sin).unwrap_or(constant)
    }
    /// Returns the integral of `(x y' - y x')/(x^2 + y^2)`.
    fn atan2(y: &Self, x: &Self) -> Option<Self> {
        let slope = |a: &Self| {
            let mut slope = Self::zero();
            for k in 1..N {
                slope.coefficients[k - 1] = R::from_integer(i32::try_from(k).ok()?).mul(&a.coefficients[k]);
            }
            Some(slope)
        };
        let rate = x.mul(&slope(y)?).sub(&y.mul(&slope(x)?)).over(&x.mul(x).add(&y.mul(y)))?;
        let mut angle = Self::constant(R::atan2(&y.coefficients[0], &x.coefficients[0])?);
        for k in 1..N {
            let part = R::from_rational(&Rational::from((1, k)))?;
            angle.coefficients[k] = rate.coefficients[k - 1].mul(&part);
        }
        Some(angle)
    }
    fn from_value(value: f64) -> Self {
        Self::constant(R::from_value(value))
    }
}

/// Returns the length of a vector, the root of its square.
///
/// # Example
/// ```
/// use looproot_calculus::unit::length;
/// assert_eq!(length(&[2.0, 3.0, 6.0]), Some(7.0));
/// ```
#[must_use]
pub fn length<R: Root>(v: &[R; 3]) -> Option<R> {
    crate::motion::dot(v, v).sqrt()
}

/// Returns the unit vector of a vector; `None` for the zero vector, and if the ring lacks the root.
#[must_use]
pub fn direction<R: Root>(v: &[R; 3]) -> Option<[R; 3]> {
    let inverse = length(v)?.reciprocal()?;
    Some(v.each_ref().map(|c| c.mul(&inverse)))
}
