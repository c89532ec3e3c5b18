//! Cells of dyadic grids.

use rug::{Integer, Rational};
use std::cmp::Ordering;

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

/// Compares two numbers `numerator 2^exponent`.
pub(super) fn compare((a, i): (&Integer, i64), (b, j): (&Integer, i64)) -> Ordering {
    if i == j {
        return a.cmp(b);
    }
    let bits = u32::try_from((i - j).unsigned_abs()).expect("exponents are of the size of the coefficients' lengths");
    if i > j { Integer::from(a << bits).cmp(b) } else { a.cmp(&Integer::from(b << bits)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dyadic_numbers_compare_like_rationals() {
        let numbers: Vec<(Integer, i64)> = [-9_i32, -4, -1, 0, 1, 3, 8]
            .into_iter()
            .flat_map(|n| [-70, -2, 0, 1, 66].map(|e| (Integer::from(n), e)))
            .collect();
        for (a, i) in &numbers {
            for (b, j) in &numbers {
                assert_eq!(compare((a, *i), (b, *j)), dyadic(a, *i).cmp(&dyadic(b, *j)), "{a} {i} {b} {j}");
            }
        }
    }
}
