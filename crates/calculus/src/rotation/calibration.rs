//! Calibration of a sensor: the motion X with `A X = X B` for pairs of motions.
//!
//! The axes of A are the images of those of B, which determines the rotation. The translation solves
//! `(R_A - I) t = R t_B - t_A`.

use super::matrix::{Matrix, apply, from_matrix};
use super::positions::nearest_rotation;
use super::vectors::{euler_vectors, unit};
use crate::finite::finite;
use crate::motion::{Motion, Vector};
use looproot_algebra::echelon::Echelon;
use looproot_algebra::ring::Field;
use nalgebra::{DMatrix, DVector};

/// The solutions of the linear equations for the translation, given the rotation.
#[derive(Clone, Debug, PartialEq)]
pub enum Translation<F> {
    /// There is exactly one.
    One(Vector<F>),
    /// They form a space of this dimension.
    Many(usize),
    /// There is none.
    None,
}

/// Returns the translation of X, given its rotation.
///
/// # Source
/// \[Wittenburg2016, 1.15.10\]
#[must_use]
pub fn translation<F: Field>(pairs: &[(Motion<F>, Motion<F>)], rotation: &Matrix<F>) -> Translation<F> {
    let rows = pairs.iter().flat_map(|(a, b)| {
        let right = apply(rotation, &b.translation);
        (0..3).map(move |i| {
            let mut row: Vec<F> = (0..3)
                .map(|j| if i == j { a.rotation[i][j].sub(&F::one()) } else { a.rotation[i][j].clone() })
                .collect();
            row.push(right[i].sub(&a.translation[i]));
            row
        })
    });
    let rows: Vec<Vec<F>> = rows.collect();
    let plain = Echelon::of(rows.iter().map(|row| row[..3].to_vec()).collect(), 3);
    let with = Echelon::of(rows.clone(), 4);
    if with.rank() > plain.rank() {
        return Translation::None;
    }
    if plain.rank() < 3 {
        return Translation::Many(3 - plain.rank());
    }
    let solved = Echelon::among(rows, 4, 3);
    let mut found: Vector<F> = std::array::from_fn(|_| F::zero());
    for (row, pivot) in solved.rows().iter().zip(solved.pivots()) {
        found[*pivot] = row[3].clone();
    }
    Translation::One(found)
}

/// Returns the motion X that fits many pairs best: the rotation nearest to the map of the Euler vectors, then the least-squares
/// translation. `None` if the axes of the pairs are parallel, which leaves the rotation free.
#[must_use]
pub fn nearest(pairs: &[(Motion<f64>, Motion<f64>)]) -> Option<Motion<f64>> {
    let vector = |motion: &Motion<f64>| Some(euler_vectors(&unit(&from_matrix(&motion.rotation))?)[0]);
    let axes: Vec<(Vector<f64>, Vector<f64>)> =
        pairs.iter().map(|(a, b)| Some((vector(b)?, vector(a)?))).collect::<Option<_>>()?;
    let rotation = nearest_rotation(&axes)?;
    let size = 3 * pairs.len();
    let left = DMatrix::from_fn(size, 3, |row, j| {
        let (pair, i) = (&pairs[row / 3], row % 3);
        pair.0.rotation[i][j] - f64::from(u8::from(i == j))
    });
    let right = DVector::from_fn(size, |row, _| {
        let (pair, i) = (&pairs[row / 3], row % 3);
        apply(&rotation, &pair.1.translation)[i] - pair.0.translation[i]
    });
    // Singular values below this part of the largest belong to directions that the pairs leave free.
    let found = finite(left).svd(true, true).solve(&right, 1e-9).ok()?;
    Some(Motion { rotation, translation: [found[0], found[1], found[2]] })
}

/// Returns the largest entry of `A X - X B` over all pairs.
#[must_use]
pub fn residual(pairs: &[(Motion<f64>, Motion<f64>)], x: &Motion<f64>) -> f64 {
    let mut largest = 0.0_f64;
    for (a, b) in pairs {
        let (left, right) = (a.then_after(x), x.then_after(b));
        for i in 0..3 {
            largest = largest.max((left.translation[i] - right.translation[i]).abs());
            for j in 0..3 {
                largest = largest.max((left.rotation[i][j] - right.rotation[i][j]).abs());
            }
        }
    }
    largest
}
