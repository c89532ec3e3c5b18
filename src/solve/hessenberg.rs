//! Eigenvalues and eigenvectors in multiprecision arithmetic: a matrix in upper Hessenberg form, and its characteristic polynomial.

use super::scalar::{Extended, Number};
use crate::algebra::ring::{Field, Ring};
use crate::algebra::univariate::Univariate;
use num_complex::Complex;

/// A matrix brought to upper Hessenberg form by elimination.
pub struct Hessenberg<R> {
    matrix: Vec<Vec<R>>,
    /// The row exchanged with the one below the diagonal of every column, and the factors by which that one was taken
    /// from those below.
    steps: Vec<(usize, Vec<R>)>,
}

impl<R: Field + Copy> Hessenberg<R> {
    /// The form of a square matrix.
    #[must_use]
    pub fn of(mut matrix: Vec<Vec<R>>) -> Self {
        let n = matrix.len();
        let mut steps = Vec::new();
        for column in 0..n.saturating_sub(2) {
            let target = column + 1;
            let size = |i: usize| matrix[i][column].pivot_size();
            let pivot = (target..n).fold(target, |best, i| if size(i) > size(best) { i } else { best });
            matrix.swap(pivot, target);
            for row in &mut matrix {
                row.swap(pivot, target);
            }
            let inverse = matrix[target][column].inverse().unwrap_or_else(R::zero);
            let mut factors = vec![R::zero(); n];
            let (head, tail) = matrix.split_at_mut(target + 1);
            let pivot_row = &head[target];
            for (factor, row) in factors[target + 1..].iter_mut().zip(tail) {
                *factor = row[column].mul(&inverse);
                let back = factor.neg();
                row[column] = R::zero();
                for (x, p) in row.iter_mut().zip(pivot_row).skip(target) {
                    *x = x.add(&back.mul(p));
                }
            }
            // The inverse operations from the right.
            for row in &mut matrix {
                row[target] = (target + 1..n).fold(row[target], |sum, i| sum.add(&row[i].mul(&factors[i])));
            }
            steps.push((pivot, factors));
        }
        Self { matrix, steps }
    }

    /// `det(x - H)`
    #[must_use]
    pub fn characteristic(&self) -> Univariate<R> {
        let h = &self.matrix;
        // Polynomials of the leading blocks: p_k = (x - h_kk) p_{k-1} - sum_i h_ik (h_{i+1,i} ... h_{k,k-1}) p_{i-1}.
        let mut leading = vec![Univariate::constant(R::one())];
        for k in 0..h.len() {
            let mut p = leading[k].mul(&Univariate::new(vec![h[k][k].neg(), R::one()]));
            let mut product = R::one();
            for i in (0..k).rev() {
                product = product.mul(&h[i + 1][i]);
                p = p.add(&leading[i].scale(&product.mul(&h[i][k]).neg()));
            }
            leading.push(p);
        }
        leading.pop().unwrap_or_else(Univariate::zero)
    }
}

impl<R: Extended> Hessenberg<R> {
    /// The eigenvector of the matrix itself at an eigenvalue; `None` where it is not unique.
    #[must_use]
    pub fn vector(&self, value: &Complex<R>) -> Option<Vec<Complex<R>>> {
        let h = &self.matrix;
        let n = h.len();
        let mut v = vec![Complex::<R>::zero(); n];
        *v.last_mut()? = Complex::one();
        for k in (1..n).rev() {
            let known = (k..n).fold(value.mul(&v[k]), |sum, j| sum.sub(&v[j].times(h[k][j])));
            v[k - 1] = known.times(h[k][k - 1].inverse()?);
        }
        for (column, (pivot, factors)) in self.steps.iter().enumerate().rev() {
            let target = column + 1;
            let from = v[target];
            for (x, factor) in v.iter_mut().zip(factors).skip(target + 1) {
                *x = x.add(&from.times(*factor));
            }
            v.swap(target, *pivot);
        }
        Some(v)
    }
}
