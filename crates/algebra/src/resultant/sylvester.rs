//! The Sylvester matrix: the definition of the resultant and of its sign.

use crate::determinant::bareiss;
use crate::ring::{Domain, Ring};
use crate::univariate::Univariate;

/// Returns the Sylvester matrix of two polynomials: the rows `x^(n-1) f, ..., f, x^(m-1) g, ..., g`, the highest power of x in
/// the first column.
///
/// # Shape
/// `m + 1` and `n + 1` coefficients, constant term first; leading ones may be zero. The matrix is of size `m + n`.
///
/// # Panics
/// When there are no coefficients.
#[must_use]
pub fn matrix<R: Ring>(f: &[R], g: &[R]) -> Vec<Vec<R>> {
    assert!(!f.is_empty() && !g.is_empty(), "a polynomial of a given degree has coefficients");
    let (m, n) = (f.len() - 1, g.len() - 1);
    let row = |coefficients: &[R], shift: usize| {
        let mut row = vec![R::zero(); m + n];
        for (k, c) in coefficients.iter().enumerate() {
            row[m + n - 1 - k - shift] = c.clone();
        }
        row
    };
    (0..n).rev().map(|shift| row(f, shift)).chain((0..m).rev().map(|shift| row(g, shift))).collect()
}

/// Returns the resultant as the determinant of the Sylvester matrix, without fractions.
///
/// This is the slow reference for the other routes. As everywhere here, `Res(f, c) = c^m` for a constant c other than
/// zero, and the resultant with the zero polynomial is 0, including `Res(0, c)`.
#[must_use]
pub fn resultant<D: Domain>(f: &Univariate<D>, g: &Univariate<D>) -> D {
    if f.is_zero() || g.is_zero() {
        return D::zero();
    }
    bareiss(&matrix(f.coefficients(), g.coefficients()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_matrix_is_the_one_in_the_books() {
        let rows = matrix(&[3.0, 2.0, 1.0], &[5.0, 4.0]);
        assert_eq!(rows, [[1.0, 2.0, 3.0], [4.0, 5.0, 0.0], [0.0, 4.0, 5.0]]);
        assert!(matrix(&[3.0], &[5.0]).is_empty());
    }
}
