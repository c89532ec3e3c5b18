//! The numbers of closed forms: real ones and complex ones, in f64 and of more digits.

use crate::solve::scalar::{Extended, Number, extended, narrowed};
use num_complex::Complex;

/// A real or complex number of a closed form.
pub trait FormNumber: Number {
    /// Complex numbers of the same digits.
    type Complex: FormNumber<Real = Self::Real, Complex = Self::Complex>;
    /// Whether values of this type are real.
    const REAL: bool;
    /// Number of Newton steps from f64, each doubling its digits, until all digits are right.
    const DOUBLINGS: u32;
    /// A number known in f64; a real type drops the imaginary part.
    fn of(z: Complex<f64>) -> Self;
    /// The real part.
    fn real(self) -> Self::Real;
    /// The real part in f64.
    fn re(self) -> f64;
    /// The number in f64.
    fn rounded(self) -> Complex<f64>;
    /// As a complex number.
    fn lifted(self) -> Self::Complex;
    /// The complex number with these parts.
    fn joined(re: Self::Real, im: Self::Real) -> Self::Complex;
}

/// Real numbers of a closed form.
pub trait Base: FormNumber<Real = Self> {}

impl<R: FormNumber<Real = R>> Base for R {}

/// Real or complex numbers over these real ones.
pub trait Over<R: Base>: FormNumber<Real = R, Complex = R::Complex> {}

impl<R: Base, S: FormNumber<Real = R, Complex = R::Complex>> Over<R> for S {}

impl FormNumber for f64 {
    type Complex = Complex<f64>;
    const REAL: bool = true;
    const DOUBLINGS: u32 = 0;
    fn of(z: Complex<f64>) -> Self {
        z.re
    }
    fn real(self) -> f64 {
        self
    }
    fn re(self) -> f64 {
        self
    }
    fn rounded(self) -> Complex<f64> {
        self.into()
    }
    fn lifted(self) -> Complex<f64> {
        Complex::from(self)
    }
    fn joined(re: f64, im: f64) -> Complex<f64> {
        Complex::new(re, im)
    }
}

impl FormNumber for Complex<f64> {
    type Complex = Self;
    const REAL: bool = false;
    const DOUBLINGS: u32 = 0;
    fn of(z: Self) -> Self {
        z
    }
    fn real(self) -> f64 {
        self.re
    }
    fn re(self) -> f64 {
        self.re
    }
    fn rounded(self) -> Self {
        self
    }
    fn lifted(self) -> Self {
        self
    }
    fn joined(re: f64, im: f64) -> Self {
        Self::new(re, im)
    }
}

impl<R: Extended> FormNumber for R {
    type Complex = Complex<R>;
    const REAL: bool = true;
    const DOUBLINGS: u32 = <R as Extended>::DOUBLINGS;
    fn of(z: Complex<f64>) -> Self {
        z.re.into()
    }
    fn real(self) -> R {
        self
    }
    fn re(self) -> f64 {
        self.to_f64()
    }
    fn rounded(self) -> Complex<f64> {
        self.to_f64().into()
    }
    fn lifted(self) -> Complex<R> {
        Complex::new(self, R::zero())
    }
    fn joined(re: R, im: R) -> Complex<R> {
        Complex::new(re, im)
    }
}

impl<R: Extended> FormNumber for Complex<R> {
    type Complex = Self;
    const REAL: bool = false;
    const DOUBLINGS: u32 = <R as Extended>::DOUBLINGS;
    fn of(z: Complex<f64>) -> Self {
        extended(z)
    }
    fn real(self) -> R {
        self.re
    }
    fn re(self) -> f64 {
        self.re.to_f64()
    }
    fn rounded(self) -> Complex<f64> {
        narrowed(self)
    }
    fn lifted(self) -> Self {
        self
    }
    fn joined(re: R, im: R) -> Self {
        Complex::new(re, im)
    }
}
