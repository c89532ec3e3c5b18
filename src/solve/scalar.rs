//! The number types roots live in: f64 for real ones, complex f64 for all of them, complex double-double for proofs.

use crate::algebra::double_double::DoubleDouble;
use crate::algebra::ring::{Field, Ring};
use num_complex::Complex;

/// What linear algebra and error bounds need of a numeric field.
pub trait Number: Field + Copy {
    /// The type of the constants it is multiplied by.
    type Real: Field + Copy;
    /// Bound on the relative error of one real operation.
    const UNIT_ROUNDOFF: f64;
    /// `self * x`.
    #[must_use]
    fn times(self, x: Self::Real) -> Self;
    /// `self / 2`, exactly.
    #[must_use]
    fn halved(self) -> Self;
    /// The absolute value, within a factor sqrt(2): the larger of |re| and |im|.
    fn size(self) -> f64;
    /// An upper bound of the absolute value: |re| + |im|.
    fn bound(self) -> f64;
}

/// What finding roots needs on top.
pub trait Scalar: Number<Real = f64> {
    /// Whether values of this type are real.
    const REAL: bool;
    /// A real number.
    fn from_f64(x: f64) -> Self;
    /// A complex number, its imaginary part dropped where the type is real.
    fn from_complex(z: Complex<f64>) -> Self;
    /// As a complex number.
    fn to_complex(self) -> Complex<f64>;
    /// Cosine and sine.
    fn cos_sin_of(self) -> (Self, Self);
    /// A square root; of a negative real zero.
    #[must_use]
    fn root(self) -> Self;
    /// The angle of a pair (cos, sin), normalised or not.
    fn angle_of(cos: Self, sin: Self) -> Self;
    /// `self / other`
    #[must_use]
    fn over(self, other: Self) -> Self;
    /// The complex conjugate.
    #[must_use]
    fn conjugate(self) -> Self;
}

impl Number for f64 {
    type Real = f64;
    const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;
    #[inline(always)]
    fn times(self, x: f64) -> Self {
        self * x
    }
    #[inline(always)]
    fn halved(self) -> Self {
        0.5 * self
    }
    #[inline(always)]
    fn size(self) -> f64 {
        self.abs()
    }
    #[inline(always)]
    fn bound(self) -> f64 {
        self.abs()
    }
}

impl Number for Complex<f64> {
    type Real = f64;
    const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;
    #[inline(always)]
    fn times(self, x: f64) -> Self {
        Complex::new(self.re * x, self.im * x)
    }
    #[inline(always)]
    fn halved(self) -> Self {
        self.times(0.5)
    }
    #[inline(always)]
    fn size(self) -> f64 {
        self.re.abs().max(self.im.abs())
    }
    #[inline(always)]
    fn bound(self) -> f64 {
        self.re.abs() + self.im.abs()
    }
}

impl Number for DoubleDouble {
    type Real = DoubleDouble;
    const UNIT_ROUNDOFF: f64 = DoubleDouble::UNIT_ROUNDOFF;
    fn times(self, x: DoubleDouble) -> Self {
        self.mul(&x)
    }
    fn halved(self) -> Self {
        self.mul(&DoubleDouble::from(0.5))
    }
    fn size(self) -> f64 {
        self.to_f64().abs()
    }
    fn bound(self) -> f64 {
        self.to_f64().abs()
    }
}

impl Number for Complex<DoubleDouble> {
    type Real = DoubleDouble;
    const UNIT_ROUNDOFF: f64 = DoubleDouble::UNIT_ROUNDOFF;
    fn times(self, x: DoubleDouble) -> Self {
        Complex::new(self.re.mul(&x), self.im.mul(&x))
    }
    fn halved(self) -> Self {
        self.times(DoubleDouble::from(0.5))
    }
    fn size(self) -> f64 {
        self.re.to_f64().abs().max(self.im.to_f64().abs())
    }
    fn bound(self) -> f64 {
        self.re.to_f64().abs() + self.im.to_f64().abs()
    }
}

impl Scalar for f64 {
    const REAL: bool = true;
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn from_complex(z: Complex<f64>) -> Self {
        z.re
    }
    #[inline(always)]
    fn to_complex(self) -> Complex<f64> {
        Complex::new(self, 0.0)
    }
    #[inline(always)]
    fn cos_sin_of(self) -> (Self, Self) {
        let (sin, cos) = self.sin_cos();
        (cos, sin)
    }
    fn root(self) -> Self {
        self.max(0.0).sqrt()
    }
    #[inline(always)]
    fn angle_of(cos: Self, sin: Self) -> Self {
        sin.atan2(cos)
    }
    #[inline(always)]
    fn over(self, other: Self) -> Self {
        self / other
    }
    #[inline(always)]
    fn conjugate(self) -> Self {
        self
    }
}

impl Scalar for Complex<f64> {
    const REAL: bool = false;
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Complex::new(x, 0.0)
    }
    #[inline(always)]
    fn from_complex(z: Complex<f64>) -> Self {
        z
    }
    #[inline(always)]
    fn to_complex(self) -> Complex<f64> {
        self
    }
    #[inline(always)]
    fn cos_sin_of(self) -> (Self, Self) {
        let (sin, cos) = self.re.sin_cos();
        let grown = self.im.exp();
        let shrunk = 1.0 / grown;
        let cosh = 0.5 * (grown + shrunk);
        // sinh of a small argument would cancel; the series is exact to rounding there.
        let sinh = if self.im.abs() < 0.25 { self.im.sinh() } else { 0.5 * (grown - shrunk) };
        (Complex::new(cos * cosh, -sin * sinh), Complex::new(sin * cosh, cos * sinh))
    }
    fn root(self) -> Self {
        self.sqrt()
    }
    fn angle_of(cos: Self, sin: Self) -> Self {
        // e^(i q) = (cos + i sin) / norm; the larger of e^(i q), e^(-i q) keeps its digits.
        let i = Complex::new(0.0, 1.0);
        let (plus, minus) = (cos + i * sin, cos - i * sin);
        if plus.norm_sqr() >= minus.norm_sqr() {
            -i * (plus / (plus * minus).sqrt_towards_one()).ln()
        } else {
            i * (minus / (plus * minus).sqrt_towards_one()).ln()
        }
    }
    #[inline(always)]
    fn over(self, other: Self) -> Self {
        self / other
    }
    #[inline(always)]
    fn conjugate(self) -> Self {
        self.conj()
    }
}

/// The square root with positive real part, or 1 for 0 or for what is not finite: `cos^2 + sin^2` is near 1 here unless
/// a candidate is no solution at all, which its closure then shows.
trait TowardsOne {
    fn sqrt_towards_one(self) -> Self;
}

impl TowardsOne for Complex<f64> {
    fn sqrt_towards_one(self) -> Self {
        let root = self.sqrt();
        if root.norm_sqr() > 0.0 && root.is_finite() { root } else { Complex::new(1.0, 0.0) }
    }
}
