//! Bounds on the coefficients of determinants with polynomial entries.

use rug::Integer;

/// Sums of absolute values of coefficients, from which a determinant is bounded.
///
/// On the unit circles of all its variables a polynomial is at most the sum of the absolute values of its coefficients,
/// a determinant there at most the product of the Euclidean norms of its rows (Hadamard), and the coefficients of the
/// determinant are at most its maximum there.
///
/// # Source
/// Goldstein, Graham 1974, A Hadamard-type bound on the coefficients of a determinant of polynomials, SIAM Review 16.
pub(super) struct Norms {
    /// All sums are multiplied by `2^-exponent`, so that none overflows.
    exponent: u32,
    sums: Vec<f64>,
}

impl Norms {
    /// Computes the norms of `count` polynomials, given their coefficients each with the index of its polynomial.
    pub(super) fn new<'a>(count: usize, coefficients: impl Iterator<Item = (usize, &'a Integer)> + Clone) -> Self {
        let exponent = coefficients.clone().map(|(_, c)| c.significant_bits()).max().unwrap_or(0);
        let mut sums = vec![0.0; count];
        for (k, c) in coefficients {
            let (mantissa, own) = c.to_f64_exp();
            // Whatever is smaller than this by 300 bits than the largest may count as that.
            let down = i32::try_from(exponent - own).unwrap_or(i32::MAX).min(300);
            if mantissa != 0.0 {
                sums[k] += mantissa.abs() * 2_f64.powi(-down);
            }
        }
        Self { exponent, sums }
    }

    /// As `new`, of coefficients that are words: their sums do not overflow.
    pub(super) fn of_words(count: usize, coefficients: impl Iterator<Item = (usize, i64)>) -> Self {
        let mut sums = vec![0.0; count];
        for (k, c) in coefficients {
            sums[k] += c.unsigned_abs() as f64;
        }
        Self { exponent: 0, sums }
    }

    /// Returns the binary logarithm of an upper bound on the Euclidean norm of a row of polynomials, given their indices.
    pub(super) fn bits(&self, row: impl Iterator<Item = usize>) -> f64 {
        let square: f64 = row.map(|k| self.sums[k] * self.sums[k]).sum();
        // Truncated mantissas, rounded sums and the logarithm together err by far less than the last summand.
        square.log2() / 2.0 + f64::from(self.exponent) + 1e-6
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn norms_are_bounded_closely_from_above_whatever_their_size() {
        for shift in [0, 100, 5000] {
            let numbers = [3, -4, 12].map(|n: i32| Integer::from(n) << shift);
            let norms = Norms::new(2, [(0, &numbers[0]), (0, &numbers[1]), (1, &numbers[2])].into_iter());
            let bits = norms.bits(0..2) - f64::from(shift);
            // The norm of (3 + 4, 12)
            let exact = 193_f64.log2() / 2.0;
            assert!(exact < bits && bits < exact + 1e-5);
        }
        let (large, small) = (Integer::from(1) << 5000, Integer::from(1));
        assert!(Norms::new(2, [(0, &large), (1, &small)].into_iter()).bits(1..2) > 0.0);
        assert_eq!(Norms::new(1, [(0, &Integer::new())].into_iter()).bits(0..1), f64::NEG_INFINITY);
    }
}
