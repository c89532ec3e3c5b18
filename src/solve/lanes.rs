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
