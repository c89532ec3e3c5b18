//! Eigenvalues and eigenvectors of one balanced matrix, by our own routine or by faer.

use super::eigen::{Eigenvectors, Method};
use super::francis;
use super::scalar::Scalar;
use crate::elimination::pencil::Square;
use num_complex::Complex;

/// Sweeps of balancing, at most.
const SWEEPS: usize = 4;

/// The spectrum of one N x N matrix after the other, in the same memory.
pub struct Spectrum<const N: usize> {
    /// The eigenvalues.
    pub values: [Complex<f64>; N],
    /// The powers of two that balance the matrix.
    pub balance: [f64; N],
    method: Method,
    reduced: Box<Square<f64, N>>,
    order: [usize; N],
    work: Box<Square<f64, N>>,
    upper_real: Box<Square<f64, N>>,
    upper: Box<Square<Complex<f64>, N>>,
    reference: Eigenvectors<N>,
}

impl<const N: usize> Default for Spectrum<N> {
    fn default() -> Self {
        let square = || Box::new([[0.0; N]; N]);
        Self {
            values: [Complex::new(0.0, 0.0); N],
            balance: [1.0; N],
            method: Method::Francis,
            reduced: square(),
            order: [0; N],
            work: square(),
            upper_real: square(),
            upper: Box::new([[Complex::new(0.0, 0.0); N]; N]),
            reference: Eigenvectors::default(),
        }
    }
}

impl<const N: usize> Spectrum<N> {
    /// Finds the eigenvalues of a matrix; whether the iteration converged.
    pub fn decompose(&mut self, method: Method, matrix: &[[f64; N]]) -> bool {
        self.reduced.copy_from_slice(matrix);
        self.balance = balance(&mut self.reduced);
        self.method = method;
        match method {
            Method::Francis => {
                self.order = francis::reduce(&mut self.reduced);
                self.work.copy_from_slice(&*self.reduced);
                let values = francis::of_hessenberg(&mut self.work);
                self.values = values.unwrap_or(self.values);
                values.is_some()
            }
            Method::Faer => {
                let converged = self.reference.decompose(&self.reduced);
                self.values = std::array::from_fn(|k| self.reference.value(k));
                converged
            }
        }
    }

    /// The eigenvector of eigenvalue k of the balanced matrix; that of the matrix itself is `balance` times it. Real
    /// types ask for the real part of complex ones.
    pub fn vector<S: Scalar>(&mut self, k: usize) -> [S; N] {
        let mut found = match self.method {
            Method::Faer => return self.reference.vector(k).map(S::from_complex),
            Method::Francis if S::REAL => {
                francis::vector(&self.reduced, self.values[k].re, &mut self.upper_real).map(S::from_f64)
            }
            Method::Francis => francis::vector(&self.reduced, self.values[k], &mut self.upper).map(S::from_complex),
        };
        francis::back(&self.reduced, &self.order, &mut found);
        found
    }
}

/// Scales rows and columns by powers of two until their sums without the diagonal are alike: `D^-1 A D`. Source: E. E. Osborne 1960, On pre-conditioning of matrices.
fn balance<const N: usize>(a: &mut Square<f64, N>) -> [f64; N] {
    let mut scales = [1.0; N];
    for _ in 0..SWEEPS {
        let mut changed = false;
        let mut columns = [0.0; N];
        for (i, row) in a.iter().enumerate() {
            for (j, x) in row.iter().enumerate() {
                columns[j] += if i == j { 0.0 } else { x.abs() };
            }
        }
        for i in 0..N {
            // Columns change as rows are scaled; the sums kept are brought up to date below.
            let row_sum: f64 = a[i].iter().enumerate().map(|(j, x)| if i == j { 0.0 } else { x.abs() }).sum();
            let column_sum = columns[i];
            if !(row_sum > 0.0 && column_sum > 0.0) {
                continue;
            }
            let factor = (0.5 * (row_sum / column_sum).log2()).round().clamp(-40.0, 40.0).exp2();
            if factor == 1.0 || !((column_sum * factor + row_sum / factor) < 0.95 * (column_sum + row_sum)) {
                continue;
            }
            changed = true;
            scales[i] *= factor;
            let inverse = 1.0 / factor;
            for j in 0..N {
                if j != i {
                    columns[j] += (inverse - 1.0) * a[i][j].abs();
                    a[i][j] *= inverse;
                }
            }
            for (j, row) in a.iter_mut().enumerate() {
                if j != i {
                    row[i] *= factor;
                }
            }
            columns[i] *= factor;
        }
        if !changed {
            break;
        }
    }
    scales
}
