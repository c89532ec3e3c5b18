//! Gauss-Jordan elimination with complete pivoting for matrices of any size: pivots and null vectors.

use crate::ring::Field;

/// A matrix reduced to unit columns at its pivots.
pub(super) struct Reduced<F> {
    /// The rows of the pivots, in the order of `pivots`.
    rows: Vec<Vec<F>>,
    /// Row and column of each pivot in the matrix as it was given.
    pub(super) pivots: Vec<(usize, usize)>,
    columns: usize,
}

/// Reduces a matrix; pivots whose size is not above `tolerance` count as zero.
///
/// # Panics
/// When a row does not have the given number of columns.
pub(super) fn reduce<F: Field>(matrix: &[Vec<F>], columns: usize, tolerance: f64) -> Reduced<F> {
    reduce_up_to(matrix, columns, columns, tolerance)
}

/// Reduces a matrix whose rank is known not to exceed `rank`: any further pivot would be rounding.
pub(super) fn reduce_up_to<F: Field>(matrix: &[Vec<F>], columns: usize, rank: usize, tolerance: f64) -> Reduced<F> {
    assert!(matrix.iter().all(|row| row.len() == columns), "the rows of a matrix are of one length");
    let mut rows = matrix.to_vec();
    let mut names: Vec<usize> = (0..rows.len()).collect();
    let mut pivots: Vec<(usize, usize)> = Vec::new();
    for step in 0..rows.len().min(rank) {
        let (mut best, mut at) = (0.0, (step, 0));
        for (i, row) in rows.iter().enumerate().skip(step) {
            for (j, x) in row.iter().enumerate() {
                let size = x.pivot_size();
                if size > best && pivots.iter().all(|&(_, used)| used != j) {
                    (best, at) = (size, (i, j));
                }
            }
        }
        let Some(inverse) = rows[at.0][at.1].inverse().filter(|_| best > tolerance) else { break };
        rows.swap(step, at.0);
        names.swap(step, at.0);
        pivots.push((names[step], at.1));
        let pivot_row: Vec<F> = rows[step].iter().map(|x| x.mul(&inverse)).collect();
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = row[at.1].clone();
            if i != step && !factor.is_zero() {
                for (x, p) in row.iter_mut().zip(&pivot_row) {
                    *x = x.sub(&factor.mul(p));
                }
                row[at.1] = F::zero();
            }
        }
        rows[step] = pivot_row;
    }
    rows.truncate(pivots.len());
    Reduced { rows, pivots, columns }
}

impl<F: Field> Reduced<F> {
    /// Returns a basis of the vectors that the matrix sends to zero.
    pub(super) fn null_space(&self) -> Vec<Vec<F>> {
        let is_free = |column: &usize| self.pivots.iter().all(|(_, used)| used != column);
        let vector = |free: usize| {
            let mut vector = vec![F::zero(); self.columns];
            vector[free] = F::one();
            for (row, &(_, column)) in self.rows.iter().zip(&self.pivots) {
                vector[column] = row[free].neg();
            }
            vector
        };
        (0..self.columns).filter(is_free).map(vector).collect()
    }
}
