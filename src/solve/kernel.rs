//! Null vectors of the pencil at a root, and the unknowns they hold.

use super::scalar::Number;
use crate::algebra::ring::Ring;
use crate::elimination::pencil::{Pencil, Square};

/// Pivots below this part of the largest one count as zero in f64: a kernel of more than one dimension.
pub const SHARED: f64 = 1e-7;

/// The kernel of an 8 x 8 matrix that is singular to rounding.
#[derive(Clone, Debug)]
pub struct Kernel<S> {
    /// Basis vectors; the first `dimension` count. Orthonormal when there are several.
    pub basis: [[S; 8]; 8],
    /// Number of basis vectors, at least 1.
    pub dimension: usize,
    /// Size of the last but one pivot over the first: how far the kernel is from a second dimension.
    pub separation: f64,
}

/// A pencil at a root, divided by `1 + |x|^2` so that large roots do not overflow.
#[must_use]
pub fn at_root<S: Number>(pencil: &Pencil<S::Real>, x: S) -> Square<S, 8> {
    let scale = (1.0 / (1.0 + x.square_size())).into();
    let (square, linear) = (x.mul(&x).times(scale), x.times(scale));
    let [a0, a1, a2] = &pencil.coefficients;
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            square.times(a2[i][j]).add(&linear.times(a1[i][j])).add(&S::from_real(scale.mul(&a0[i][j])))
        })
    })
}

/// Roundings that may separate what is zero from zero.
const ROUNDINGS: f64 = 1e4;

/// The kernel by elimination with complete pivoting; the smallest pivot always counts as zero, and those below the part
/// `shared` of the largest one.
#[must_use]
pub fn kernel<S: Number>(matrix: &Square<S, 8>, shared: f64) -> Kernel<S> {
    let mut a = *matrix;
    let mut columns: [usize; 8] = std::array::from_fn(|j| j);
    let mut pivots = [0.0; 8];
    for k in 0..8 {
        let (mut best, mut row, mut column) = (-1.0, k, k);
        for (i, entries) in a.iter().enumerate().skip(k) {
            for (j, x) in entries.iter().enumerate().skip(k) {
                if x.size() > best {
                    (best, row, column) = (x.size(), i, j);
                }
            }
        }
        a.swap(k, row);
        columns.swap(k, column);
        for entries in &mut a {
            entries.swap(k, column);
        }
        pivots[k] = a[k][k].size();
        let Some(inverse) = a[k][k].inverse() else { break };
        let pivot_row = a[k];
        for target in a.iter_mut().skip(k + 1) {
            let factor = target[k].mul(&inverse);
            for j in k + 1..8 {
                target[j] = target[j].sub(&factor.mul(&pivot_row[j]));
            }
        }
    }
    let separation = if pivots[0] > 0.0 { pivots[6] / pivots[0] } else { 0.0 };
    let rank = (0..7).take_while(|&k| pivots[k] > shared * pivots[0]).count();
    let dimension = 8 - rank;
    let mut basis = [[S::zero(); 8]; 8];
    for (b, vector) in basis.iter_mut().take(dimension).enumerate() {
        let mut y = [S::zero(); 8];
        y[rank + b] = S::one();
        for i in (0..rank).rev() {
            let mut sum = S::zero();
            for j in i + 1..8 {
                sum = sum.add(&a[i][j].mul(&y[j]));
            }
            y[i] = sum.neg().over(a[i][i]);
        }
        for (value, &column) in y.iter().zip(&columns) {
            vector[column] = *value;
        }
    }
    if dimension > 1 {
        orthonormalise(&mut basis[..dimension]);
    }
    Kernel { basis, dimension, separation }
}

fn orthonormalise<S: Number>(rows: &mut [[S; 8]]) {
    for i in 0..rows.len() {
        let (done, rest) = rows.split_at_mut(i);
        let row = &mut rest[0];
        for _ in 0..2 {
            for other in done.iter() {
                let dot = row.iter().zip(other).fold(S::zero(), |s, (x, y)| s.add(&x.mul(&y.conjugate())));
                for (x, y) in row.iter_mut().zip(other) {
                    *x = x.sub(&dot.mul(y));
                }
            }
            let square: f64 = row.iter().map(|x| x.square_size()).sum();
            for x in row.iter_mut() {
                *x = x.times((1.0 / square.sqrt().max(f64::MIN_POSITIVE)).into());
            }
        }
    }
}

/// Cosine and sine of an angle from its half-angle pair `tan(q/2) = sin_half / cos_half`; `None` near tan = +-i, where
/// no finite angle is.
#[must_use]
pub fn double_angle<S: Number>(cos_half: S, sin_half: S) -> Option<(S, S)> {
    let (cc, ss) = (cos_half.mul(&cos_half), sin_half.mul(&sin_half));
    let norm = cc.add(&ss);
    if !(norm.size() > ROUNDINGS * S::UNIT_ROUNDOFF * (cc.size() + ss.size())) {
        return None;
    }
    let product = cos_half.mul(&sin_half);
    Some((cc.sub(&ss).over(norm), product.add(&product).over(norm)))
}

/// Cosine and sine of the other unknown and of unknown 3 from a one-dimensional kernel.
///
/// Ratios of neighbouring entries, taken where they are largest: infinite half-angle tangents are no exception.
#[must_use]
pub fn unknowns<S: Number>(y: &[S; 8]) -> Option<((S, S), (S, S))> {
    let square = |part: &[S]| -> f64 { part.iter().map(|x| x.square_size()).sum() };
    let b = if square(&y[..4]) >= square(&y[4..]) { &y[..4] } else { &y[4..] };
    let other = if b[0].size() >= b[3].size() { double_angle(b[0], b[1]) } else { double_angle(b[2], b[3]) }?;
    let i = (0..4).max_by(|&i, &j| square(&[y[i], y[i + 4]]).total_cmp(&square(&[y[j], y[j + 4]])))?;
    Some((other, double_angle(y[i], y[i + 4])?))
}
