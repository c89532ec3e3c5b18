//! Matrices that may be decomposed.

use nalgebra::{ComplexField, Dim, Matrix, RawStorageMut};

/// Returns the matrix, or the zero matrix of its shape where an entry is infinite or not a number.
///
/// The singular values and eigenvalues of nalgebra are found by iterations that do not end with such entries, to which lengths of
/// 1e100 lead. The zero matrix has rank 0, which proves nothing.
#[must_use]
pub fn finite<T, R, C, S>(mut matrix: Matrix<T, R, C, S>) -> Matrix<T, R, C, S>
where
    T: ComplexField,
    R: Dim,
    C: Dim,
    S: RawStorageMut<T, R, C>,
{
    if matrix.iter().any(|entry| !entry.is_finite()) {
        matrix.fill(T::zero());
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Matrix2;

    #[test]
    fn a_matrix_with_an_entry_that_is_no_number_has_rank_zero() {
        for entry in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let matrix = Matrix2::new(1.0, 2.0, entry, 3.0);
            assert_eq!(finite(matrix).singular_values().iter().copied().collect::<Vec<_>>(), [0.0, 0.0]);
        }
        let matrix = Matrix2::new(1.0, 2.0, 1e300, 3.0);
        assert_eq!(finite(matrix), matrix);
    }
}
