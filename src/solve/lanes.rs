//! Numbers side by side in a vector register, with operators.
//!
//! Formulas are written once for registers of 1, 2, 4 or 8 numbers; [`pulp`] chooses at run time. Functions of lanes are
//! always inlined, and pass no closures on: others would not be compiled for the registers that the caller runs with.

use pulp::Simd;
use std::ops::{Add, Div, Mul, Neg, Not, Sub};

/// The number of numbers in a row of lanes: registers of 1, 2, 4 and 8 divide it.
pub const WIDTH: usize = 8;

/// One number in every lane of a row.
pub type Row = [f64; WIDTH];

/// Numbers side by side.
#[derive(Clone, Copy)]
pub struct Lanes<S: Simd> {
    simd: S,
    values: S::f64s,
}

/// Complex numbers side by side.
#[derive(Clone, Copy)]
pub struct ComplexLanes<S: Simd> {
    /// The real parts.
    pub re: Lanes<S>,
    /// The imaginary parts.
    pub im: Lanes<S>,
}

/// Real or complex numbers side by side, for formulas that are written once for both.
pub trait LaneNumber<S: Simd>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// Returns these real numbers.
    fn of(re: Lanes<S>) -> Self;
    /// Returns numbers with these real and imaginary parts; real numbers have no imaginary part.
    fn from_parts(re: Lanes<S>, im: Lanes<S>) -> Self;
    /// Returns `self * x` for real x.
    #[must_use]
    fn times(self, x: Lanes<S>) -> Self;
    /// Returns `self * x + b` for real x.
    #[must_use]
    fn times_plus(self, x: Lanes<S>, b: Self) -> Self;
    /// Returns `self * a + b`.
    #[must_use]
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// Returns `b - self * a`.
    #[must_use]
    fn mul_from(self, a: Self, b: Self) -> Self;
    /// Returns the conjugates.
    #[must_use]
    fn conj(self) -> Self;
    /// Returns upper bounds of the absolute values, those of real and imaginary part added up.
    fn bound(self) -> Lanes<S>;
    /// Returns the squares of the absolute values.
    fn square_size(self) -> Lanes<S>;
    /// Returns these squares and a sum.
    fn square_plus(self, sum: Lanes<S>) -> Lanes<S>;
    /// Returns `1 / self`.
    #[must_use]
    fn inverse(self) -> Self;
    /// Returns the square roots with real parts that are not negative; NaN at 0 for complex numbers.
    #[must_use]
    fn root(self) -> Self;
    /// Returns `yes` where the condition holds, and `no` in the other lanes.
    fn selected(mask: Mask<S>, yes: Self, no: Self) -> Self;
}

/// A condition in every lane.
#[derive(Clone, Copy)]
pub struct Mask<S: Simd> {
    simd: S,
    values: S::m64s,
}

impl<S: Simd> Lanes<S> {
    /// The number of registers that hold a row.
    pub const CHUNKS: usize = WIDTH / S::F64_LANES;

    /// Returns the same number in every lane.
    #[must_use]
    #[inline(always)]
    pub fn splat(simd: S, x: f64) -> Self {
        Self { simd, values: simd.splat_f64s(x) }
    }

    /// Loads one register of a row.
    #[must_use]
    #[inline(always)]
    pub fn load(simd: S, row: &[f64], chunk: usize) -> Self {
        let (registers, _) = S::as_simd_f64s(row);
        Self { simd, values: registers[chunk] }
    }

    /// Stores one register of a row.
    #[inline(always)]
    pub fn store(self, row: &mut [f64], chunk: usize) {
        let (registers, _) = S::as_mut_simd_f64s(row);
        registers[chunk] = self.values;
    }

    /// Loads the first register of a row.
    #[must_use]
    #[inline(always)]
    pub fn loaded(self, row: &Row) -> Self {
        Self::load(self.simd, row, 0)
    }

    /// Returns the same number as here in every lane.
    #[must_use]
    #[inline(always)]
    pub fn like(self, x: f64) -> Self {
        Self::splat(self.simd, x)
    }

    /// Returns `self * a + b`, rounded once or twice.
    #[must_use]
    #[inline(always)]
    pub fn fma(self, a: Self, b: Self) -> Self {
        if S::IS_SCALAR {
            return self * a + b;
        }
        Self { values: self.simd.mul_add_e_f64s(self.values, a.values, b.values), ..self }
    }

    /// Returns `b - self * a`, rounded once or twice.
    #[must_use]
    #[inline(always)]
    pub fn subtracted_from(self, a: Self, b: Self) -> Self {
        if S::IS_SCALAR {
            return b - self * a;
        }
        Self { values: self.simd.negate_mul_add_e_f64s(self.values, a.values, b.values), ..self }
    }

    /// Returns the absolute values.
    #[must_use]
    #[inline(always)]
    pub fn abs(self) -> Self {
        Self { values: self.simd.abs_f64s(self.values), ..self }
    }

    /// Returns the square roots.
    #[must_use]
    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self { values: self.simd.sqrt_f64s(self.values), ..self }
    }

    /// Returns the larger number of each lane; which one for NaN is not defined.
    #[must_use]
    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        Self { values: self.simd.max_f64s(self.values, other.values), ..self }
    }

    /// Returns the smaller number of each lane; which one for NaN is not defined.
    #[must_use]
    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        Self { values: self.simd.min_f64s(self.values, other.values), ..self }
    }

    /// Returns whether a number is below another one; false for NaN.
    #[must_use]
    #[inline(always)]
    pub fn below(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, values: self.simd.less_than_f64s(self.values, other.values) }
    }

    /// Returns whether a number is at most another one; false for NaN.
    #[must_use]
    #[inline(always)]
    pub fn at_most(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, values: self.simd.less_than_or_equal_f64s(self.values, other.values) }
    }
}

impl<S: Simd> LaneNumber<S> for Lanes<S> {
    #[inline(always)]
    fn of(re: Self) -> Self {
        re
    }
    #[inline(always)]
    fn from_parts(re: Self, _: Self) -> Self {
        re
    }
    #[inline(always)]
    fn times(self, x: Self) -> Self {
        self * x
    }
    #[inline(always)]
    fn times_plus(self, x: Self, b: Self) -> Self {
        self.fma(x, b)
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self.fma(a, b)
    }
    #[inline(always)]
    fn mul_from(self, a: Self, b: Self) -> Self {
        self.subtracted_from(a, b)
    }
    #[inline(always)]
    fn conj(self) -> Self {
        self
    }
    #[inline(always)]
    fn bound(self) -> Self {
        self.abs()
    }
    #[inline(always)]
    fn square_size(self) -> Self {
        self * self
    }
    #[inline(always)]
    fn square_plus(self, sum: Self) -> Self {
        self.fma(self, sum)
    }
    #[inline(always)]
    fn inverse(self) -> Self {
        self.like(1.0) / self
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
    #[inline(always)]
    fn selected(mask: Mask<S>, yes: Self, no: Self) -> Self {
        mask.select(yes, no)
    }
}

impl<S: Simd> LaneNumber<S> for ComplexLanes<S> {
    #[inline(always)]
    fn of(re: Lanes<S>) -> Self {
        Self { re, im: re.like(0.0) }
    }
    #[inline(always)]
    fn from_parts(re: Lanes<S>, im: Lanes<S>) -> Self {
        Self { re, im }
    }
    #[inline(always)]
    fn times(self, x: Lanes<S>) -> Self {
        Self { re: self.re * x, im: self.im * x }
    }
    #[inline(always)]
    fn times_plus(self, x: Lanes<S>, b: Self) -> Self {
        Self { re: self.re.fma(x, b.re), im: self.im.fma(x, b.im) }
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        Self {
            re: self.im.subtracted_from(a.im, self.re.fma(a.re, b.re)),
            im: self.im.fma(a.re, self.re.fma(a.im, b.im)),
        }
    }
    #[inline(always)]
    fn mul_from(self, a: Self, b: Self) -> Self {
        Self {
            re: self.im.fma(a.im, self.re.subtracted_from(a.re, b.re)),
            im: self.im.subtracted_from(a.re, self.re.subtracted_from(a.im, b.im)),
        }
    }
    #[inline(always)]
    fn conj(self) -> Self {
        Self { im: -self.im, ..self }
    }
    #[inline(always)]
    fn bound(self) -> Lanes<S> {
        self.re.abs() + self.im.abs()
    }
    #[inline(always)]
    fn square_size(self) -> Lanes<S> {
        self.re.fma(self.re, self.im * self.im)
    }
    #[inline(always)]
    fn square_plus(self, sum: Lanes<S>) -> Lanes<S> {
        self.re.fma(self.re, self.im.fma(self.im, sum))
    }
    #[inline(always)]
    fn inverse(self) -> Self {
        let over = self.re.like(1.0) / self.square_size();
        Self { re: self.re * over, im: -(self.im * over) }
    }
    #[inline(always)]
    fn root(self) -> Self {
        // The part with the larger square without cancellation, the other one from their product.
        let half = self.re.like(0.5);
        let size = self.square_size().sqrt();
        let larger = ((size + self.re.abs()) * half).sqrt();
        let other = self.im * half / larger;
        let is_negative = self.re.below(self.re.like(0.0));
        let turned = self.im.below(self.im.like(0.0)).select(-larger, larger);
        Self { re: is_negative.select(other.abs(), larger), im: is_negative.select(turned, other) }
    }
    #[inline(always)]
    fn selected(mask: Mask<S>, yes: Self, no: Self) -> Self {
        Self { re: mask.select(yes.re, no.re), im: mask.select(yes.im, no.im) }
    }
}

impl<S: Simd> Add for ComplexLanes<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl<S: Simd> Sub for ComplexLanes<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl<S: Simd> Mul for ComplexLanes<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self {
            re: self.im.subtracted_from(other.im, self.re * other.re),
            im: self.im.fma(other.re, self.re * other.im),
        }
    }
}

impl<S: Simd> Neg for ComplexLanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}

impl<S: Simd> Mask<S> {
    /// Returns `yes` in the lanes where this holds, and `no` in the others.
    #[must_use]
    #[inline(always)]
    pub fn select(self, yes: Lanes<S>, no: Lanes<S>) -> Lanes<S> {
        Lanes { simd: self.simd, values: self.simd.select_f64s(self.values, yes.values, no.values) }
    }

    /// Returns where both hold.
    #[must_use]
    #[inline(always)]
    pub fn and(self, other: Self) -> Self {
        Self { values: self.simd.and_m64s(self.values, other.values), ..self }
    }

    /// Returns where one holds at least.
    #[must_use]
    #[inline(always)]
    pub fn or(self, other: Self) -> Self {
        Self { values: self.simd.or_m64s(self.values, other.values), ..self }
    }

    /// Returns whether this holds in every lane.
    #[must_use]
    #[inline(always)]
    pub fn all(self) -> bool {
        let one = self.simd.splat_f64s(1.0);
        let zero = self.simd.splat_f64s(0.0);
        self.simd.reduce_min_f64s(self.simd.select_f64s(self.values, one, zero)) == 1.0
    }
}

impl<S: Simd> Not for Mask<S> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self { values: self.simd.not_m64s(self.values), ..self }
    }
}

impl<S: Simd> Add for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { values: self.simd.add_f64s(self.values, other.values), ..self }
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { values: self.simd.sub_f64s(self.values, other.values), ..self }
    }
}

impl<S: Simd> Mul for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { values: self.simd.mul_f64s(self.values, other.values), ..self }
    }
}

impl<S: Simd> Div for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self { values: self.simd.div_f64s(self.values, other.values), ..self }
    }
}

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { values: self.simd.neg_f64s(self.values), ..self }
    }
}
