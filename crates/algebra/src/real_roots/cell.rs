//! Cells of dyadic grids.

use rug::{Integer, Rational};

/// The interval from `numerator 2^exponent` to `(numerator + 1) 2^exponent`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Cell {
    pub(super) numerator: Integer,
    pub(super) exponent: i64,
}

impl Cell {
    pub(super) fn new(numerator: Integer, exponent: i64) -> Self {
        Self { numerator, exponent }
    }

    /// Returns the part at `index` of `2^bits` equal ones.
    pub(super) fn part(&self, index: &Integer, bits: u32) -> Self {
        Self::new(Integer::from(&self.numerator << bits) + index, self.exponent - i64::from(bits))
    }

    /// Returns the right end, as a numerator over the same power of two.
    pub(super) fn end(&self) -> Integer {
        Integer::from(&self.numerator + 1_u32)
    }

    pub(super) fn lo(&self) -> Rational {
        dyadic(&self.numerator, self.exponent)
    }

    pub(super) fn hi(&self) -> Rational {
        dyadic(&self.end(), self.exponent)
    }

    /// Returns the cell of the negatives.
    pub(super) fn mirrored(&self) -> Self {
        Self::new(-self.end(), self.exponent)
    }
}

/// Returns `numerator 2^exponent`.
pub(super) fn dyadic(numerator: &Integer, exponent: i64) -> Rational {
    let bits = u32::try_from(exponent.unsigned_abs()).expect("exponents are of the size of the coefficients' lengths");
    if exponent < 0 { Rational::from(numerator) >> bits } else { Rational::from(numerator) << bits }
}
