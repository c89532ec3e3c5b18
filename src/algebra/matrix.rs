//! Small dense matrices over a field or ring: elimination, null spaces, linear systems.
//!
//! Matrices are arrays of rows and work on the stack, so that the per-pose path allocates nothing.

use super::ring::{Field, Ring};

/// `R` rows of `C` entries.
pub type Matrix<F, const R: usize, const C: usize> = [[F; C]; R];

/// The unit matrix.
#[must_use]
pub fn identity<R: Ring, const N: usize>() -> Matrix<R, N, N> {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { R::one() } else { R::zero() }))
}

/// The transposed matrix.
#[must_use]
pub fn transpose<F: Clone, const R: usize, const C: usize>(a: &Matrix<F, R, C>) -> Matrix<F, C, R> {
    std::array::from_fn(|j| std::array::from_fn(|i| a[i][j].clone()))
}

/// `A B`
#[must_use]
#[inline]
pub fn multiply<F: Ring, const A: usize, const B: usize, const C: usize>(
    a: &Matrix<F, A, B>,
    b: &Matrix<F, B, C>,
) -> Matrix<F, A, C> {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..B).fold(F::zero(), |sum, k| sum.add(&a[i][k].mul(&b[k][j])))))
}

/// `A v`
#[must_use]
#[inline]
pub fn apply<F: Ring, const R: usize, const C: usize>(a: &Matrix<F, R, C>, v: &[F; C]) -> [F; R] {
    std::array::from_fn(|i| (0..C).fold(F::zero(), |sum, k| sum.add(&a[i][k].mul(&v[k]))))
}

/// The matrix over another ring; `None` as soon as one entry has no image.
///
/// # Panics
/// Never: no entry is taken before all are seen to be there.
pub fn map<F, G, const R: usize, const C: usize>(
    a: &Matrix<F, R, C>,
    image: impl Fn(&F) -> Option<G>,
) -> Option<Matrix<G, R, C>> {
    let mut images: [[Option<G>; C]; R] = std::array::from_fn(|i| std::array::from_fn(|j| image(&a[i][j])));
    let complete = images.iter().flatten().all(Option::is_some);
    complete
        .then(|| std::array::from_fn(|i| std::array::from_fn(|j| images[i][j].take().expect("all images are there"))))
}

/// `P A Q = L U` by full pivoting, as far as the rank goes.
///
/// # Shape
/// In `entries`, rows and columns are permuted: U on and above the diagonal of the first `rank` rows, the
/// multipliers of L (whose diagonal is 1) below it, the part that counts as zero in the remaining corner.
#[derive(Clone, Debug)]
pub struct Elimination<F, const R: usize, const C: usize> {
    entries: Matrix<F, R, C>,
    /// Position -> row of the given matrix.
    rows: [usize; R],
    /// Position -> column of the given matrix.
    columns: [usize; C],
    /// Inverses of the pivots.
    inverses: [F; R],
    odd: bool,
    rank: usize,
    pivots: [f64; R],
}

/// Eliminates by full pivoting, down to pivots of the relative size [`Field::PIVOT_ZERO`].
#[must_use]
#[inline]
pub fn lu<F: Field, const R: usize, const C: usize>(a: &Matrix<F, R, C>) -> Elimination<F, R, C> {
    let mut lu = Elimination {
        entries: a.clone(),
        rows: std::array::from_fn(|i| i),
        columns: std::array::from_fn(|j| j),
        inverses: std::array::from_fn(|_| F::zero()),
        odd: false,
        rank: 0,
        pivots: [0.0; R],
    };
    for k in 0..R.min(C) {
        if !lu.step(k) {
            break;
        }
    }
    lu
}

impl<F: Field, const R: usize, const C: usize> Elimination<F, R, C> {
    /// Finds the pivot of position `k` and eliminates its column below; false if what is left counts as zero.
    #[inline]
    fn step(&mut self, k: usize) -> bool {
        let (mut row, mut column, mut size) = (k, k, -1.0);
        for (i, entries) in self.entries.iter().enumerate().skip(k) {
            for (j, entry) in entries.iter().enumerate().skip(k) {
                let candidate = entry.pivot_size();
                if candidate > size {
                    (row, column, size) = (i, j, candidate);
                }
            }
        }
        self.pivots[k] = size.max(0.0);
        // NaN, which no comparison above accepts, leaves a negative size.
        if size <= F::PIVOT_ZERO * self.pivots[0] {
            return false;
        }
        self.odd ^= (row != k) ^ (column != k);
        self.entries.swap(k, row);
        self.rows.swap(k, row);
        self.columns.swap(k, column);
        for entries in &mut self.entries {
            entries.swap(k, column);
        }
        let Some(inverse) = self.entries[k][k].inverse() else {
            return false;
        };
        let (above, below) = self.entries.split_at_mut(k + 1);
        let pivot_row = &above[k];
        for entries in below {
            let multiplier = entries[k].mul(&inverse);
            for j in k + 1..C {
                entries[j] = entries[j].sub(&multiplier.mul(&pivot_row[j]));
            }
            entries[k] = multiplier;
        }
        self.inverses[k] = inverse;
        self.rank = k + 1;
        true
    }

    /// The number of pivots accepted.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// The sizes of the pivots in order of elimination, the first refused one included; 0 beyond.
    #[must_use]
    pub fn pivots(&self) -> &[f64; R] {
        &self.pivots
    }

    /// The last accepted pivot relative to the first: a cheap measure of conditioning, 1 in exact fields, 0 at rank 0.
    #[must_use]
    pub fn pivot_ratio(&self) -> f64 {
        if self.rank == 0 { 0.0 } else { self.pivots[self.rank - 1] / self.pivots[0] }
    }
}

impl<F: Field, const N: usize> Elimination<F, N, N> {
    /// X with `A X = B`; `None` when A is singular.
    #[must_use]
    #[inline]
    pub fn solve<const M: usize>(&self, b: &Matrix<F, N, M>) -> Option<Matrix<F, N, M>> {
        if self.rank < N {
            return None;
        }
        let mut y: Matrix<F, N, M> = std::array::from_fn(|i| b[self.rows[i]].clone());
        for k in 0..N {
            let (above, below) = y.split_at_mut(k + 1);
            for (i, row) in below.iter_mut().enumerate() {
                subtract_multiple(row, &self.entries[k + 1 + i][k], &above[k]);
            }
        }
        for k in (0..N).rev() {
            let (above, below) = y.split_at_mut(k);
            let row = &mut below[0];
            for entry in row.iter_mut() {
                *entry = entry.mul(&self.inverses[k]);
            }
            for (i, other) in above.iter_mut().enumerate() {
                subtract_multiple(other, &self.entries[i][k], row);
            }
        }
        let mut x = y.clone();
        for (position, row) in y.into_iter().enumerate() {
            x[self.columns[position]] = row;
        }
        Some(x)
    }

    /// `det A`; 0 when A counts as singular.
    #[must_use]
    pub fn determinant(&self) -> F {
        if self.rank < N {
            return F::zero();
        }
        let product = (0..N).fold(F::one(), |product, k| product.mul(&self.entries[k][k]));
        if self.odd { product.neg() } else { product }
    }
}

/// `row -= multiplier * other`
#[inline(always)]
pub(super) fn subtract_multiple<F: Ring>(row: &mut [F], multiplier: &F, other: &[F]) {
    for (x, y) in row.iter_mut().zip(other) {
        *x = x.sub(&multiplier.mul(y));
    }
}

/// X with `A X = B`; `None` when A is singular (in floating point: counts as singular).
#[must_use]
#[inline]
pub fn solve<F: Field, const N: usize, const M: usize>(
    a: &Matrix<F, N, N>,
    b: &Matrix<F, N, M>,
) -> Option<Matrix<F, N, M>> {
    lu(a).solve(b)
}

/// The inverse matrix; `None` when A is singular.
#[must_use]
pub fn inverse<F: Field, const N: usize>(a: &Matrix<F, N, N>) -> Option<Matrix<F, N, N>> {
    lu(a).solve(&identity())
}

/// All `y` with `y A = 0`, by a basis, and how sure the rank is.
#[derive(Clone, Debug)]
pub struct NullSpace<F, const R: usize> {
    basis: Matrix<F, R, R>,
    /// The rank of A; the null space has `R - rank` dimensions.
    pub rank: usize,
    /// The sizes of the pivots in order of elimination, the first refused one included; 0 beyond.
    pub pivots: [f64; R],
    /// The last accepted pivot relative to the first.
    pub pivot_ratio: f64,
}

impl<F, const R: usize> NullSpace<F, R> {
    /// The basis: `R - rank` independent rows, orthonormal where the field makes them so.
    #[must_use]
    pub fn rows(&self) -> &[[F; R]] {
        &self.basis[..R - self.rank]
    }
}

/// The left null space: all rows `y` with `y A = 0`.
#[must_use]
#[inline]
pub fn left_null_space<F: Field, const R: usize, const C: usize>(a: &Matrix<F, R, C>) -> NullSpace<F, R> {
    let lu = lu(a);
    let rank = lu.rank;
    let mut basis: Matrix<F, R, R> = std::array::from_fn(|_| std::array::from_fn(|_| F::zero()));
    for (row, position) in basis.iter_mut().zip(rank..R) {
        // In permuted order the row is (z, 0.. 1 ..0) with z L = -(the multipliers of this row).
        row[lu.rows[position]] = F::one();
        for j in (0..rank).rev() {
            let inner = (j + 1..rank)
                .fold(lu.entries[position][j].clone(), |sum, k| sum.add(&row[lu.rows[k]].mul(&lu.entries[k][j])));
            row[lu.rows[j]] = inner.neg();
        }
    }
    F::orthonormalise(&mut basis[..R - rank]);
    NullSpace { basis, rank, pivots: lu.pivots, pivot_ratio: lu.pivot_ratio() }
}

/// The right null space: all `x` with `A x = 0`, each as a row of the result.
#[must_use]
pub fn right_null_space<F: Field, const R: usize, const C: usize>(a: &Matrix<F, R, C>) -> NullSpace<F, C> {
    left_null_space(&transpose(a))
}
