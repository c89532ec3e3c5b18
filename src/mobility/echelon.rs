//! Row reduction of matrices of any size over a field.

use crate::algebra::ring::Field;

/// A matrix reduced by row operations.
#[derive(Clone, Debug)]
pub(super) struct Echelon<F> {
    /// The pivot column of each nonzero row; these rows come first and are unit vectors in the pivot columns.
    pub pivots: Vec<usize>,
    /// The reduced rows.
    pub rows: Vec<Vec<F>>,
}

impl<F: Field> Echelon<F> {
    /// Reduces a matrix, looking for pivots in its first `columns` columns only, the largest of all rows and columns first.
    pub(super) fn of(mut rows: Vec<Vec<F>>, columns: usize) -> Self {
        let mut pivots: Vec<usize> = Vec::new();
        let mut largest = 0.0_f64;
        while pivots.len() < rows.len() {
            let step = pivots.len();
            let (mut best, mut at) = (0.0, (step, 0));
            for (i, row) in rows.iter().enumerate().skip(step) {
                for (j, x) in row[..columns].iter().enumerate() {
                    let size = x.pivot_size();
                    if size > best {
                        (best, at) = (size, (i, j));
                    }
                }
            }
            largest = largest.max(best);
            if best <= F::PIVOT_ZERO * largest {
                break;
            }
            let Some(inverse) = rows[at.0][at.1].inverse() else { break };
            rows.swap(step, at.0);
            for x in &mut rows[step] {
                *x = x.mul(&inverse);
            }
            let pivot = rows[step].clone();
            for (i, row) in rows.iter_mut().enumerate() {
                if i == step || row[at.1].is_zero() {
                    continue;
                }
                let factor = row[at.1].neg();
                for (j, (x, p)) in row.iter_mut().zip(&pivot).enumerate() {
                    // Structural zeros, so that an inexact field does not take a rounding error for a pivot again.
                    if j == at.1 {
                        *x = F::zero();
                    } else {
                        x.add_product(&factor, p);
                    }
                }
            }
            pivots.push(at.1);
        }
        Self { pivots, rows }
    }

    /// The rank.
    pub(super) fn rank(&self) -> usize {
        self.pivots.len()
    }

    /// A basis of the vectors that the first `columns` columns of the matrix send to 0.
    pub(super) fn kernel(&self, columns: usize) -> Vec<Vec<F>> {
        let free = (0..columns).filter(|j| !self.pivots.contains(j));
        let vector = |j: usize| {
            let mut vector = vec![F::zero(); columns];
            vector[j] = F::one();
            for (pivot, row) in self.pivots.iter().zip(&self.rows) {
                vector[*pivot] = row[j].neg();
            }
            vector
        };
        free.map(vector).collect()
    }
}
