//! Eigenvalues of pencils: by our own small-matrix routine, and by faer, which is the reference and decides where the
//! first leaves a root unresolved. The only file that names faer.

use super::francis;
use crate::elimination::pencil::Square;
use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd;
use faer::{Mat, Par};
use num_complex::Complex;
use pulp::{Arch, NullaryFnOnce};
use std::hint::black_box;

/// Who computes the eigenvalues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Our own routine, see [`francis`].
    Francis,
    /// faer.
    Faer,
}

/// The companion matrix `[[0, I], [-A2^-1 A0, -A2^-1 A1]]` from its two lower blocks, sign reversed.
#[must_use]
pub fn companion(constant: &Square<f64, 8>, linear: &Square<f64, 8>) -> Square<f64, SIZE> {
    let mut matrix = [[0.0; SIZE]; SIZE];
    for i in 0..8 {
        matrix[i][8 + i] = 1.0;
        for j in 0..8 {
            matrix[8 + i][j] = -constant[i][j];
            matrix[8 + i][8 + j] = -linear[i][j];
        }
    }
    matrix
}

/// Scratch memory for eigenvalues of 16 x 16 matrices, reused from call to call.
pub struct EigenWorkspace {
    matrix: Mat<f64>,
    real: Diag<f64>,
    imaginary: Diag<f64>,
    memory: MemBuffer,
}

const SIZE: usize = 16;

impl Default for EigenWorkspace {
    fn default() -> Self {
        let no = evd::ComputeEigenvectors::No;
        Self {
            matrix: Mat::zeros(SIZE, SIZE),
            real: Diag::zeros(SIZE),
            imaginary: Diag::zeros(SIZE),
            memory: MemBuffer::new(evd::evd_scratch::<f64>(SIZE, no, no, Par::Seq, faer::prelude::default())),
        }
    }
}

impl EigenWorkspace {
    /// The eigenvalues x of `(A0 + A1 x + A2 x^2) y = 0` from the lower half of its companion matrix
    /// `[[0, I], [-A2^-1 A0, -A2^-1 A1]]`. `None` where the iteration does not converge or an entry is not finite.
    pub fn companion(
        &mut self,
        method: Method,
        constant: &Square<f64, 8>,
        linear: &Square<f64, 8>,
    ) -> Option<[Complex<f64>; SIZE]> {
        let mut matrix = companion(constant, linear);
        match method {
            Method::Francis => francis::eigenvalues(&mut matrix),
            Method::Faer => self.of_matrix(&matrix),
        }
    }

    /// The eigenvalues of any 16 x 16 matrix by faer: what the speed of the solver is measured against.
    pub fn of_matrix(&mut self, matrix: &Square<f64, SIZE>) -> Option<[Complex<f64>; SIZE]> {
        copy(matrix, &mut self.matrix);
        let found = evd::evd_real(
            self.matrix.as_ref(),
            self.real.as_mut(),
            self.imaginary.as_mut(),
            None,
            None,
            Par::Seq,
            MemStack::new(&mut self.memory),
            faer::prelude::default(),
        );
        free_registers();
        found.ok()?;
        Some(std::array::from_fn(|k| Complex::new(self.real.column_vector()[k], self.imaginary.column_vector()[k])))
    }
}

/// The matrix as faer stores it.
fn copy<const N: usize>(matrix: &Square<f64, N>, target: &mut Mat<f64>) {
    for (i, row) in matrix.iter().enumerate() {
        for (j, x) in row.iter().enumerate() {
            target[(i, j)] = *x;
        }
    }
}

/// Scratch memory for eigenvalues and eigenvectors of N x N matrices by faer, reused from call to call.
pub struct Eigenvectors<const N: usize> {
    matrix: Mat<f64>,
    real: Diag<f64>,
    imaginary: Diag<f64>,
    vectors: Mat<f64>,
    memory: MemBuffer,
}

impl<const N: usize> Default for Eigenvectors<N> {
    fn default() -> Self {
        let (no, yes) = (evd::ComputeEigenvectors::No, evd::ComputeEigenvectors::Yes);
        Self {
            matrix: Mat::zeros(N, N),
            real: Diag::zeros(N),
            imaginary: Diag::zeros(N),
            vectors: Mat::zeros(N, N),
            memory: MemBuffer::new(evd::evd_scratch::<f64>(N, no, yes, Par::Seq, faer::prelude::default())),
        }
    }
}

impl<const N: usize> Eigenvectors<N> {
    /// Eigenvalues and right eigenvectors of a matrix, kept in here; whether the iteration converged.
    pub fn decompose(&mut self, matrix: &Square<f64, N>) -> bool {
        copy(matrix, &mut self.matrix);
        let found = evd::evd_real(
            self.matrix.as_ref(),
            self.real.as_mut(),
            self.imaginary.as_mut(),
            None,
            Some(self.vectors.as_mut()),
            Par::Seq,
            MemStack::new(&mut self.memory),
            faer::prelude::default(),
        );
        free_registers();
        found.is_ok()
    }

    /// Eigenvalue k.
    #[must_use]
    pub fn value(&self, k: usize) -> Complex<f64> {
        Complex::new(self.real.column_vector()[k], self.imaginary.column_vector()[k])
    }

    /// The eigenvector of eigenvalue k; conjugate eigenvalues stand next to each other, the one with positive imaginary
    /// part first.
    #[must_use]
    pub fn vector(&self, k: usize) -> [Complex<f64>; N] {
        let imaginary = self.imaginary.column_vector()[k];
        std::array::from_fn(|i| {
            if imaginary == 0.0 {
                Complex::from(self.vectors[(i, k)])
            } else if imaginary > 0.0 {
                Complex::new(self.vectors[(i, k)], self.vectors[(i, k + 1)])
            } else {
                Complex::new(self.vectors[(i, k - 1)], -self.vectors[(i, k)])
            }
        })
    }
}

/// faer's kernels leave the upper halves of vector registers in use, and then every instruction on the lower halves alone
/// waits for them: the code that follows on this thread runs three times slower. A function compiled for wide registers
/// frees them when it returns.
fn free_registers() {
    struct Wide<'a>(&'a mut [f64; 16]);
    impl NullaryFnOnce for Wide<'_> {
        type Output = ();
        #[inline(always)]
        fn call(self) {
            for x in self.0.iter_mut() {
                *x = 1.5 * *x + 0.25;
            }
        }
    }
    let mut numbers = black_box([1.0; 16]);
    Arch::new().dispatch(Wide(&mut numbers));
    black_box(numbers);
}

/// The eigenvalues of a small complex matrix of any size, rows given one after the other. Allocates: for rare cases.
#[must_use]
pub fn eigenvalues(size: usize, entries: &[Complex<f64>]) -> Vec<Complex<f64>> {
    let matrix = Mat::from_fn(size, size, |i, j| entries[i * size + j]);
    let values = matrix.eigenvalues().unwrap_or_default();
    free_registers();
    values
}
