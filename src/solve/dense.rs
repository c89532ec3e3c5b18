//! Small dense matrices in f64 or complex f64, on the stack.

use super::scalar::Number;

/// The row, of those from k on, with the largest entry in column k; `None` where all are zero.
#[inline(always)]
fn pivot_row<S: Number, const N: usize>(a: &[[S; N]; N], k: usize) -> Option<usize> {
    let mut row = k;
    for i in k + 1..N {
        if a[i][k].size() > a[row][k].size() {
            row = i;
        }
    }
    (a[row][k].size() > 0.0).then_some(row)
}

/// The inverse by Gauss-Jordan elimination with partial pivoting; `None` for a singular matrix.
#[must_use]
pub fn inverse<S: Number, const N: usize>(matrix: &[[S; N]; N]) -> Option<[[S; N]; N]> {
    let mut a = *matrix;
    let mut pivots = [0; N];
    for k in 0..N {
        let row = pivot_row(&a, k)?;
        a.swap(k, row);
        pivots[k] = row;
        let pivot = a[k][k].inverse()?;
        a[k][k] = S::one();
        for x in &mut a[k] {
            *x = x.mul(&pivot);
        }
        let pivot_row = a[k];
        for (i, target) in a.iter_mut().enumerate() {
            if i != k {
                let factor = target[k];
                target[k] = S::zero();
                for (x, p) in target.iter_mut().zip(&pivot_row) {
                    *x = x.sub(&factor.mul(p));
                }
            }
        }
    }
    for k in (0..N).rev() {
        if pivots[k] != k {
            for row in &mut a {
                row.swap(k, pivots[k]);
            }
        }
    }
    Some(a)
}

/// The solution of `matrix x = right` by Gaussian elimination with partial pivoting; `None` for a singular matrix.
#[must_use]
pub fn solve_one<S: Number, const N: usize>(matrix: &[[S; N]; N], right: &[S; N]) -> Option<[S; N]> {
    let (mut a, mut x) = (*matrix, *right);
    for k in 0..N {
        let row = pivot_row(&a, k)?;
        a.swap(k, row);
        x.swap(k, row);
        let inverse = a[k][k].inverse()?;
        a[k][k] = inverse;
        let (pivot_row, value) = (a[k], x[k]);
        for i in k + 1..N {
            let factor = a[i][k].mul(&inverse);
            for j in k + 1..N {
                a[i][j] = a[i][j].sub(&factor.mul(&pivot_row[j]));
            }
            x[i] = x[i].sub(&factor.mul(&value));
        }
    }
    for k in (0..N).rev() {
        let mut sum = x[k];
        for j in k + 1..N {
            sum = sum.sub(&a[k][j].mul(&x[j]));
        }
        x[k] = sum.mul(&a[k][k]);
    }
    Some(x)
}

/// `matrix * vector`
#[inline(always)]
#[must_use]
pub fn times<S: Number, const R: usize, const C: usize>(matrix: &[[S; C]; R], vector: &[S; C]) -> [S; R] {
    std::array::from_fn(|i| {
        let mut sum = S::zero();
        for (x, y) in matrix[i].iter().zip(vector) {
            sum = sum.add(&x.mul(y));
        }
        sum
    })
}

/// The largest sum of absolute values (bounded by |re| + |im|) in a row.
#[inline(always)]
#[must_use]
pub fn norm<S: Number, const R: usize, const C: usize>(matrix: &[[S; C]; R]) -> f64 {
    let mut largest = 0.0_f64;
    for row in matrix {
        largest = largest.max(row.iter().map(|x| x.bound()).sum());
    }
    largest
}

/// The LU factors of an 8 x 8 matrix, in place, with partial pivoting; the ratio of its smallest to its largest
/// pivot, and the row order. 0 for a singular matrix.
pub fn factor<const N: usize>(a: &mut [[f64; N]; N]) -> (f64, [usize; N]) {
    let mut order: [usize; N] = std::array::from_fn(|i| i);
    let (mut smallest, mut largest) = (f64::INFINITY, 0.0_f64);
    for k in 0..N {
        let mut row = k;
        for i in k + 1..N {
            if a[i][k].abs() > a[row][k].abs() {
                row = i;
            }
        }
        a.swap(k, row);
        order.swap(k, row);
        let size = a[k][k].abs();
        (smallest, largest) = (smallest.min(size), largest.max(size));
        if !(size > 0.0) {
            return (0.0, order);
        }
        let inverse = 1.0 / a[k][k];
        let pivot_row = a[k];
        for target in a.iter_mut().skip(k + 1) {
            let factor = target[k] * inverse;
            target[k] = factor;
            for j in k + 1..N {
                target[j] -= factor * pivot_row[j];
            }
        }
    }
    (smallest / largest, order)
}

/// `A^-1 B` from the factors of A.
#[must_use]
pub fn solve<const N: usize>(lu: &[[f64; N]; N], order: &[usize; N], b: &[[f64; N]; N]) -> [[f64; N]; N] {
    let mut x: [[f64; N]; N] = std::array::from_fn(|i| b[order[i]]);
    for i in 1..N {
        let (done, rest) = x.split_at_mut(i);
        for (k, row) in done.iter().enumerate() {
            let factor = lu[i][k];
            for (t, s) in rest[0].iter_mut().zip(row) {
                *t -= factor * s;
            }
        }
    }
    for i in (0..N).rev() {
        let (rest, done) = x.split_at_mut(i + 1);
        let row = &mut rest[i];
        for (k, s) in done.iter().enumerate() {
            let factor = lu[i][i + 1 + k];
            for (t, s) in row.iter_mut().zip(s) {
                *t -= factor * s;
            }
        }
        let inverse = 1.0 / lu[i][i];
        for t in row.iter_mut() {
            *t *= inverse;
        }
    }
    x
}
