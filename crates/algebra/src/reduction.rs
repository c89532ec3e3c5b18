//! Gauss-Jordan reduction with complete pivoting, one code for exact and inexact fields, without allocation.

use super::ring::Field;

/// The row operations that reduce a matrix, and their result.
///
/// `transform * matrix` has the unit row `e_(columns[i])` as row i below `rank`, and zero rows from there on: the first
/// rows of `transform` solve, the last ones annihilate.
#[derive(Clone, Debug)]
pub struct Reduction<F, const R: usize, const C: usize> {
    /// The product of all row operations.
    pub transform: [[F; R]; R],
    /// The column for which each pivot row solves.
    pub columns: [usize; C],
    /// Number of pivots.
    pub rank: usize,
    /// Smallest over largest pivot if the columns are independent, else 0: an estimate of how independent they are.
    pub independence: f64,
}

/// Reduces a matrix of `R >= C` rows.
#[must_use]
pub fn reduce<F: Field, const R: usize, const C: usize>(mut matrix: [[F; C]; R]) -> Reduction<F, R, C> {
    let mut transform: [[F; R]; R] =
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { F::one() } else { F::zero() }));
    let mut columns: [usize; C] = std::array::from_fn(|j| j);
    let mut free = [true; C];
    let (mut largest, mut smallest) = (0.0_f64, f64::INFINITY);
    let mut rank = 0;
    for step in 0..C.min(R) {
        let (mut best, mut row, mut column) = (0.0, step, 0);
        for (i, entries) in matrix.iter().enumerate().skip(step) {
            for (j, x) in entries.iter().enumerate() {
                let size = x.pivot_size();
                if free[j] && size > best {
                    (best, row, column) = (size, i, j);
                }
            }
        }
        if step == 0 {
            largest = best;
        }
        if best <= F::PIVOT_ZERO * largest {
            break;
        }
        let Some(inverse) = matrix[row][column].inverse() else { break };
        smallest = smallest.min(best);
        matrix.swap(step, row);
        transform.swap(step, row);
        free[column] = false;
        columns[step] = column;
        rank += 1;
        for x in &mut matrix[step] {
            *x = x.mul(&inverse);
        }
        for x in &mut transform[step] {
            *x = x.mul(&inverse);
        }
        let pivot_row = matrix[step].clone();
        let pivot_transform = transform[step].clone();
        for i in 0..R {
            if i == step || matrix[i][column].is_zero() {
                continue;
            }
            let factor = matrix[i][column].clone();
            for (x, p) in matrix[i].iter_mut().zip(&pivot_row) {
                *x = x.sub(&factor.mul(p));
            }
            for (x, p) in transform[i].iter_mut().zip(&pivot_transform) {
                *x = x.sub(&factor.mul(p));
            }
        }
    }
    let independence = if rank == C && largest > 0.0 { smallest / largest } else { 0.0 };
    Reduction { transform, columns, rank, independence }
}
