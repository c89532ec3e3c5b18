//! Row reduction of matrices of any shape: rank, null space, independent rows. One code for exact and inexact fields.

use super::ring::Field;

/// Pivots of an inexact field below this share of the largest one are zero: above rounding and below intended values.
const NEGLIGIBLE: f64 = 1e-9;

/// The reduced echelon form of a matrix, with every pivot 1 and alone in its column.
///
/// # Example
/// ```
/// use looproot_algebra::echelon::Echelon;
/// use rug::Rational;
///
/// let rows = [[1, 2, 3], [2, 4, 6], [0, 0, 5]].map(|row| row.map(Rational::from).to_vec());
/// let echelon = Echelon::of(rows.to_vec(), 3);
/// assert_eq!(echelon.rank(), 2);
/// assert_eq!(echelon.null_space(), [[-2, 1, 0].map(Rational::from).to_vec()]);
/// ```
#[derive(Clone, Debug)]
pub struct Echelon<F> {
    rows: Vec<Vec<F>>,
    pivots: Vec<usize>,
    sources: Vec<usize>,
    columns: usize,
}

impl<F: Field> Echelon<F> {
    /// Reduces the matrix with these rows, by complete pivoting: for stability in inexact fields, by the first nonzero entry
    /// in exact ones.
    ///
    /// # Panics
    /// If the length of a row is not the number of columns.
    #[must_use]
    pub fn of(rows: Vec<Vec<F>>, columns: usize) -> Self {
        Self::among(rows, columns, columns)
    }

    /// As [`Self::of`], with pivots in the first `among` columns only: the others record the row operations, or hold
    /// right sides. The rank is that of the first columns, and rows without pivot are left out.
    ///
    /// # Panics
    /// If the length of a row is not the number of columns.
    #[must_use]
    pub fn among(mut rows: Vec<Vec<F>>, columns: usize, among: usize) -> Self {
        assert!(rows.iter().all(|row| row.len() == columns), "all rows are of one length");
        let mut sources: Vec<usize> = (0..rows.len()).collect();
        let mut pivots = Vec::new();
        let mut largest = 0.0;
        while pivots.len() < rows.len() {
            let step = pivots.len();
            let Some((size, row, column)) = best_pivot(&rows, step, &pivots, among) else { break };
            if step == 0 {
                largest = size;
            }
            if F::PIVOT_ZERO > 0.0 && size <= NEGLIGIBLE * largest {
                break;
            }
            let Some(inverse) = rows[row][column].inverse() else { break };
            rows.swap(step, row);
            sources.swap(step, row);
            for x in &mut rows[step] {
                *x = x.mul(&inverse);
            }
            // Rounding must not change the entries on which the steps below rely.
            rows[step][column] = F::one();
            let pivot_row = rows[step].clone();
            for (i, row) in rows.iter_mut().enumerate() {
                if i == step || row[column].is_zero() {
                    continue;
                }
                let factor = row[column].clone();
                for (x, p) in row.iter_mut().zip(&pivot_row) {
                    if !p.is_zero() {
                        *x = x.sub(&factor.mul(p));
                    }
                }
                row[column] = F::zero();
            }
            pivots.push(column);
        }
        rows.truncate(pivots.len());
        sources.truncate(pivots.len());
        Self { rows, pivots, sources, columns }
    }

    /// Returns the number of independent rows.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.pivots.len()
    }

    /// Returns the rows of the echelon form: a basis of the space that the rows of the matrix span.
    #[must_use]
    pub fn rows(&self) -> &[Vec<F>] {
        &self.rows
    }

    /// Returns the column of the pivot of each row.
    #[must_use]
    pub fn pivots(&self) -> &[usize] {
        &self.pivots
    }

    /// Returns the rows of the matrix that are independent and span all others, in the order in which they gave the pivots.
    #[must_use]
    pub fn independent_rows(&self) -> &[usize] {
        &self.sources
    }

    /// Returns the columns without pivot.
    #[must_use]
    pub fn free_columns(&self) -> Vec<usize> {
        (0..self.columns).filter(|column| !self.pivots.contains(column)).collect()
    }

    /// Returns a basis of the vectors that every row annihilates: one for each column without pivot, in which it has the entry 1 and
    /// the other such columns 0.
    #[must_use]
    pub fn null_space(&self) -> Vec<Vec<F>> {
        let vector = |free: usize| {
            let mut vector = vec![F::zero(); self.columns];
            vector[free] = F::one();
            for (row, &pivot) in self.rows.iter().zip(&self.pivots) {
                vector[pivot] = row[free].neg();
            }
            vector
        };
        self.free_columns().into_iter().map(vector).collect()
    }
}

/// Returns the largest entry in the rows and the first columns that have no pivot yet, with its place; `None` if all are zero.
fn best_pivot<F: Field>(rows: &[Vec<F>], step: usize, pivots: &[usize], columns: usize) -> Option<(f64, usize, usize)> {
    let mut used = vec![false; columns];
    for &pivot in pivots {
        used[pivot] = true;
    }
    let mut best: Option<(f64, usize, usize)> = None;
    for (i, row) in rows.iter().enumerate().skip(step) {
        for (j, x) in row.iter().enumerate().take(columns) {
            let size = x.pivot_size();
            if !used[j] && size > best.map_or(0.0, |(best, ..)| best) {
                best = Some((size, i, j));
                if F::PIVOT_ZERO == 0.0 {
                    return best;
                }
            }
        }
    }
    best
}
