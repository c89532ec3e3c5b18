//! Poses as 4 x 4 matrices of floats, and the exact motions that they stand for.

use crate::error::{Error, Result};
use crate::kinematics::chain::Placement;
use crate::kinematics::motion::Motion;
use crate::scene::pose_of;

/// A homogeneous matrix, row by row.
pub type Matrix = [[f64; 4]; 4];

/// Largest distance from the nearest rotation that is accepted: a matrix farther off is not a rounded rotation.
const REFUSED: f64 = 3e-3;
/// Distance from the nearest rotation above which a note is given.
const NOTED: f64 = 1e-9;
/// Bits of the quaternion that represents a rotation.
const BITS: i32 = 60;
/// Newton's iteration for the nearest rotation squares the error: from 3e-3 four steps are enough.
const STEPS: usize = 5;

/// The matrix of a motion.
pub(super) fn matrix(motion: &Motion<f64>) -> Matrix {
    let row = |i: usize| {
        let [x, y, z] = motion.rotation[i];
        [x, y, z, motion.translation[i]]
    };
    [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]
}

/// Returns the placement for a matrix, and a note where it is not quite a rotation. The rotation is replaced by the nearest one,
/// whose quaternion is written in 60 bits; all proofs rest on that quaternion. The position is taken as it is.
pub(super) fn placement(matrix: &Matrix) -> Result<(Placement, Option<String>)> {
    if let Some(at) = matrix.iter().flatten().position(|x| !x.is_finite()) {
        let (row, column) = (at / 4, at % 4);
        let found = matrix[row][column];
        return Err(Error::Invalid(format!("found {found} at [{row}, {column}], expected finite numbers")));
    }
    if matrix[3] != [0.0, 0.0, 0.0, 1.0] {
        return Err(Error::Invalid(format!("found the last row {:?}, expected [0, 0, 0, 1]", matrix[3])));
    }
    let given: [[f64; 3]; 3] = std::array::from_fn(|i| [matrix[i][0], matrix[i][1], matrix[i][2]]);
    let determinant = determinant(&given);
    if determinant <= 0.0 {
        return Err(Error::Invalid(format!(
            "found a rotation with determinant {determinant:.6}, expected 1 (a reflection is no rotation)"
        )));
    }
    let rotation = nearest(&given);
    let off = (0..9).map(|k| (given[k / 3][k % 3] - rotation[k / 3][k % 3]).abs()).fold(0.0, f64::max);
    // A comparison that fails for NaN as well.
    if !(off <= REFUSED) {
        return Err(Error::Invalid(format!(
            "found a matrix that is off the nearest rotation by {off:.2e}, expected at most {REFUSED:e}"
        )));
    }
    let position: [f64; 3] = std::array::from_fn(|i| matrix[i][3]);
    let [w, x, y, z, ..] = pose_of(&Motion { rotation, translation: position });
    let unknown = || Error::Invalid("found a rotation without a quaternion".to_owned());
    let placement = Placement::of_whole_quaternion([w, x, y, z].map(rounded), position).ok_or_else(unknown)?;
    let noted =
        (off > NOTED).then(|| format!("the rotation matrix is off by {off:.1e}; the nearest rotation is taken"));
    Ok((placement, noted))
}

fn determinant(m: &[[f64; 3]; 3]) -> f64 {
    let minor = |a: usize, b: usize| m[1][a] * m[2][b] - m[1][b] * m[2][a];
    m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1)
}

/// The polar factor by Newton's iteration, the mean of the matrix and its inverse transposed.
fn nearest(given: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let mut m = *given;
    for _ in 0..STEPS {
        let d = determinant(&m);
        let cofactor = |i: usize, j: usize| {
            let (a, b) = ((i + 1) % 3, (i + 2) % 3);
            let (c, e) = ((j + 1) % 3, (j + 2) % 3);
            m[a][c] * m[b][e] - m[a][e] * m[b][c]
        };
        m = std::array::from_fn(|i| std::array::from_fn(|j| f64::midpoint(m[i][j], cofactor(i, j) / d)));
    }
    m
}

/// A number at most 1 as an integer over 2^60.
#[expect(clippy::cast_possible_truncation, reason = "a whole number of at most 2^60")]
fn rounded(q: f64) -> i64 {
    (q * f64::from(BITS).exp2()).round() as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rounded_rotation_becomes_the_nearest_exact_one() {
        let (cos, sin) = (0.6, 0.8);
        let exact = [[cos, -sin, 0.0, 0.1], [sin, cos, 0.0, -0.2], [0.0, 0.0, 1.0, 0.3], [0.0, 0.0, 0.0, 1.0]];
        let (found, noted) = placement(&exact).expect("a rotation");
        assert!(noted.is_none());
        let columns = (0..9).map(|k| (found.float.rotation[k / 3][k % 3] - exact[k / 3][k % 3]).abs());
        assert!(columns.fold(0.0, f64::max) < 1e-15);
        let mut off = exact;
        off[0][0] += 1e-5;
        assert!(placement(&off).expect("near a rotation").1.is_some());
        off[0][0] += 0.1;
        assert!(placement(&off).is_err());
        off[0][0] = f64::NAN;
        assert!(placement(&off).is_err());
        let mirrored = exact.map(|row| [row[0], row[1], -row[2], row[3]]);
        assert!(placement(&mirrored).is_err());
    }
}
