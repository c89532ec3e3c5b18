//! The number types roots live in: f64 for real ones, complex f64 for all of them, complex numbers of more digits for
//! proofs and for roots that f64 does not reach.

use crate::algebra::double_double::DoubleDouble;
use crate::algebra::elementary::{exp, sin_cos, small_sinh};
use crate::algebra::long_float::LongNumber;
use crate::algebra::ring::{Field, Ring, formula};
use num_complex::Complex;

/// The operations on a number that linear algebra and error bounds need.
pub trait Number: Field + Copy {
    /// The type of the constants it is multiplied by.
    type Real: Field + Copy + From<f64>;
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
    /// The square of the absolute value.
    fn square_size(self) -> f64;
    /// A square root; of a negative real zero.
    #[must_use]
    fn root(self) -> Self;
    /// `self / other`; zero where that does not exist in numbers without infinity.
    #[must_use]
    fn over(self, other: Self) -> Self;
    /// The complex conjugate.
    #[must_use]
    fn conjugate(self) -> Self;
    /// A number of the type of the constants.
    fn from_real(x: Self::Real) -> Self;
}

/// Real numbers of more digits than f64 has.
pub trait Extended: Number<Real = Self> + From<f64> {
    /// The nearest f64, or one beside it.
    fn to_f64(self) -> f64;
    /// Number of Newton steps, each doubling the digits of f64, until all digits are right.
    const DOUBLINGS: u32;
    /// Bits of a mantissa.
    const BITS: u32;
}

/// Converts a complex number to more digits, exactly.
#[must_use]
pub fn extended<R: Extended>(z: Complex<f64>) -> Complex<R> {
    Complex::new(z.re.into(), z.im.into())
}

/// The nearest complex f64, or one beside it.
#[must_use]
pub fn narrowed<R: Extended>(z: Complex<R>) -> Complex<f64> {
    Complex::new(z.re.to_f64(), z.im.to_f64())
}

/// The further operations that root finding needs.
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
    /// The angle of a pair (cos, sin), normalised or not.
    fn angle_of(cos: Self, sin: Self) -> Self;
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
    #[inline(always)]
    fn square_size(self) -> f64 {
        self * self
    }
    fn root(self) -> Self {
        self.max(0.0).sqrt()
    }
    #[inline(always)]
    fn over(self, other: Self) -> Self {
        self / other
    }
    #[inline(always)]
    fn conjugate(self) -> Self {
        self
    }
    #[inline(always)]
    fn from_real(x: f64) -> Self {
        x
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
    #[inline(always)]
    fn square_size(self) -> f64 {
        self.norm_sqr()
    }
    fn root(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn over(self, other: Self) -> Self {
        self / other
    }
    #[inline(always)]
    fn conjugate(self) -> Self {
        self.conj()
    }
    #[inline(always)]
    fn from_real(x: f64) -> Self {
        Complex::new(x, 0.0)
    }
}

impl Extended for DoubleDouble {
    fn to_f64(self) -> f64 {
        Self::to_f64(self)
    }
    const DOUBLINGS: u32 = 1;
    const BITS: u32 = 106;
}

impl<const LIMBS: usize> Extended for LongNumber<LIMBS> {
    fn to_f64(self) -> f64 {
        Self::to_f64(self)
    }
    const DOUBLINGS: u32 = Self::DOUBLINGS;
    const BITS: u32 = Self::BITS;
}

/// The common part of numbers of more digits, without their unit roundoff and their halves.
macro_rules! extended_number {
    ($real:ty, $halved:expr $(, $parameter:ident)?) => {
        impl$(<const $parameter: usize>)? Number for $real {
            type Real = Self;
            const UNIT_ROUNDOFF: f64 = <$real>::UNIT_ROUNDOFF;
            fn times(self, x: Self) -> Self {
                self.mul(&x)
            }
            fn halved(self) -> Self {
                $halved(self)
            }
            fn size(self) -> f64 {
                self.to_f64().abs()
            }
            fn bound(self) -> f64 {
                self.to_f64().abs()
            }
            fn square_size(self) -> f64 {
                self.to_f64().powi(2)
            }
            fn root(self) -> Self {
                let start = self.to_f64().max(0.0).sqrt();
                let usable = start > 0.0 && start.is_finite();
                if usable { improved_root(self, start.into(), Self::DOUBLINGS) } else { Self::zero() }
            }
            fn over(self, other: Self) -> Self {
                other.inverse().map_or_else(Self::zero, |inverse| self.mul(&inverse))
            }
            fn conjugate(self) -> Self {
                self
            }
            fn from_real(x: Self) -> Self {
                x
            }
        }
    };
}

extended_number!(DoubleDouble, |x: DoubleDouble| x.mul(&DoubleDouble::from(0.5)));
extended_number!(LongNumber<LIMBS>, |x: Self| x.shifted(-1), LIMBS);

/// Newton's method for a square root: every step doubles the digits.
fn improved_root<S: Number>(of: S, start: S, doublings: u32) -> S {
    (0..doublings).fold(start, |root, _| root.add(&of.over(root)).halved())
}

impl<R: Extended> Number for Complex<R> {
    type Real = R;
    const UNIT_ROUNDOFF: f64 = R::UNIT_ROUNDOFF;
    fn times(self, x: R) -> Self {
        formula::<R, _>(|| Complex::new(self.re.mul(&x), self.im.mul(&x)))
    }
    fn halved(self) -> Self {
        Complex::new(self.re.halved(), self.im.halved())
    }
    fn size(self) -> f64 {
        self.re.to_f64().abs().max(self.im.to_f64().abs())
    }
    fn bound(self) -> f64 {
        self.re.to_f64().abs() + self.im.to_f64().abs()
    }
    fn square_size(self) -> f64 {
        narrowed(self).norm_sqr()
    }
    fn root(self) -> Self {
        let start = narrowed(self).sqrt();
        let usable = start.norm_sqr() > 0.0 && start.is_finite();
        if usable { improved_root(self, extended(start), R::DOUBLINGS) } else { Self::zero() }
    }
    fn over(self, other: Self) -> Self {
        other.inverse().map_or_else(Self::zero, |inverse| self.mul(&inverse))
    }
    fn conjugate(self) -> Self {
        Complex::new(self.re, self.im.neg())
    }
    fn from_real(x: R) -> Self {
        Complex::new(x, R::zero())
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
        let (sin, cos) = sin_cos(self);
        (cos, sin)
    }
    #[inline(always)]
    fn angle_of(cos: Self, sin: Self) -> Self {
        sin.atan2(cos)
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
        let (sin, cos) = sin_cos(self.re);
        let grown = exp(self.im);
        let shrunk = 1.0 / grown;
        let cosh = 0.5 * (grown + shrunk);
        // sinh of a small argument would cancel; the series is exact to rounding there.
        let sinh = if self.im.abs() < 0.25 { small_sinh(self.im) } else { 0.5 * (grown - shrunk) };
        (Complex::new(cos * cosh, -sin * sinh), Complex::new(sin * cosh, cos * sinh))
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
