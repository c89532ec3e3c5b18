//! Cells of dyadic grids, and the exact sign of a polynomial at their corners.

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

    /// The part at `index` of `2^bits` equal ones.
    pub(super) fn part(&self, index: &Integer, bits: u32) -> Self {
        Self::new(Integer::from(&self.numerator << bits) + index, self.exponent - i64::from(bits))
    }

    /// The right end, as a numerator over the same power of two.
    pub(super) fn end(&self) -> Integer {
        Integer::from(&self.numerator + 1_u32)
    }

    pub(super) fn lo(&self) -> Rational {
        dyadic(&self.numerator, self.exponent)
    }

    pub(super) fn hi(&self) -> Rational {
        dyadic(&self.end(), self.exponent)
    }

    /// The cell of the negatives.
    pub(super) fn mirrored(&self) -> Self {
        Self::new(-self.end(), self.exponent)
    }
}

/// `numerator 2^exponent`
pub(super) fn dyadic(numerator: &Integer, exponent: i64) -> Rational {
    let bits = u32::try_from(exponent.unsigned_abs()).expect("exponents are of the size of the coefficients' lengths");
    if exponent < 0 { Rational::from(numerator) >> bits } else { Rational::from(numerator) << bits }
}

/// The value at `numerator 2^exponent` times `2^(-exponent degree)` for negative exponents, times 1 otherwise.
pub(super) fn scaled_value(coefficients: &[Integer], numerator: &Integer, exponent: i64) -> Integer {
    let size = u32::try_from(exponent.unsigned_abs()).expect("exponents are of the size of the coefficients' lengths");
    if exponent >= 0 {
        let x = Integer::from(numerator << size);
        return coefficients.iter().rev().fold(Integer::new(), |value, c| value * &x + c);
    }
    let (mut value, mut shift) = (Integer::new(), 0_u32);
    for c in coefficients.iter().rev() {
        value *= numerator;
        value += Integer::from(c << shift);
        shift += size;
    }
    value
}

/// The sign of the value at `numerator 2^exponent`.
pub(super) fn sign_at(coefficients: &[Integer], numerator: &Integer, exponent: i64) -> i8 {
    let zeros = numerator.find_one(0).unwrap_or(0);
    let odd = Integer::from(numerator >> zeros);
    sign(&scaled_value(coefficients, &odd, if zeros == 0 { exponent } else { exponent + i64::from(zeros) }))
}

/// The sign as a number.
pub(super) fn sign(n: &Integer) -> i8 {
    match n.cmp0() {
        std::cmp::Ordering::Less => -1,
        std::cmp::Ordering::Equal => 0,
        std::cmp::Ordering::Greater => 1,
    }
}
