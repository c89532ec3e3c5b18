//! Matrices of direction cosines. They act on columns: `r* = A r`, and their columns are the rotated base vectors.

use crate::finite::finite;
use crate::motion::{Vector, dot};
use crate::quaternion::Quaternion;
use crate::unit::Unit;
use looproot_algebra::ring::Ring;
use nalgebra::Matrix3;

/// Three rows of three direction cosines.
pub type Matrix<R> = [[R; 3]; 3];

/// Returns the matrix of a quaternion of any norm; `None` if the norm is no unit.
///
/// # Example
/// ```
/// use looproot_calculus::quaternion::Quaternion;
/// use looproot_calculus::rotation::matrix::matrix;
/// let q = Quaternion { scalar: 1.0, vector: [2.0, 2.0, 4.0] };
/// assert!(matrix(&q).unwrap()[0].iter().zip([-0.6, 0.0, 0.8]).all(|(a, b)| (a - b).abs() < 1e-15));
/// ```
///
/// # Source
/// \[Wittenburg2016, ch. 1\]
#[must_use]
pub fn matrix<R: Unit>(q: &Quaternion<R>) -> Option<Matrix<R>> {
    let (w, [x, y, z]) = (&q.scalar, &q.vector);
    let twice = q.norm().reciprocal().map(|inverse| inverse.add(&inverse))?;
    let diagonal = |a: &R, b: &R| R::one().sub(&twice.mul(&a.mul(a).add(&b.mul(b))));
    let plus = |a: &R, b: &R, c: &R| twice.mul(&a.mul(b).add(&w.mul(c)));
    let minus = |a: &R, b: &R, c: &R| twice.mul(&a.mul(b).sub(&w.mul(c)));
    Some([
        [diagonal(y, z), minus(x, y, z), plus(x, z, y)],
        [plus(x, y, z), diagonal(x, z), minus(y, z, x)],
        [minus(x, z, y), plus(y, z, x), diagonal(x, y)],
    ])
}

/// Returns a quaternion of a rotation matrix, up to a factor: the longest of the four columns of the matrix of its products.
///
/// # Example
/// ```
/// use looproot_calculus::rotation::matrix::from_matrix;
/// use rug::Rational;
/// let half_turn = [[1, 0, 0], [0, -1, 0], [0, 0, -1]].map(|row| row.map(Rational::from));
/// let q = from_matrix(&half_turn);
/// assert!(q.scalar == 0 && q.vector[0] != 0 && q.vector[1] == 0 && q.vector[2] == 0);
/// ```
#[must_use]
pub fn from_matrix<R: Unit>(a: &Matrix<R>) -> Quaternion<R> {
    let one = R::one();
    let signed = |x: i8, y: i8, z: i8| {
        let part = |sign: i8, entry: &R| if sign > 0 { entry.clone() } else { entry.neg() };
        one.add(&part(x, &a[0][0])).add(&part(y, &a[1][1])).add(&part(z, &a[2][2]))
    };
    let squares = [signed(1, 1, 1), signed(1, -1, -1), signed(-1, 1, -1), signed(-1, -1, 1)];
    let mut largest = 0;
    for k in 1..4 {
        if squares[k].size() > squares[largest].size() {
            largest = k;
        }
    }
    let skew = [a[2][1].sub(&a[1][2]), a[0][2].sub(&a[2][0]), a[1][0].sub(&a[0][1])];
    let sum = |i: usize, j: usize| a[i][j].add(&a[j][i]);
    match largest {
        0 => Quaternion { scalar: squares[0].clone(), vector: skew },
        1 => Quaternion { scalar: skew[0].clone(), vector: [squares[1].clone(), sum(0, 1), sum(0, 2)] },
        2 => Quaternion { scalar: skew[1].clone(), vector: [sum(0, 1), squares[2].clone(), sum(1, 2)] },
        _ => Quaternion { scalar: skew[2].clone(), vector: [sum(0, 2), sum(1, 2), squares[3].clone()] },
    }
}

/// Returns the product of two matrices, which applies `b` first.
#[must_use]
pub fn product<R: Ring>(a: &Matrix<R>, b: &Matrix<R>) -> Matrix<R> {
    let columns = transpose(b);
    std::array::from_fn(|i| std::array::from_fn(|j| dot(&a[i], &columns[j])))
}

/// Returns the transposed matrix, which is the inverse of a rotation.
#[must_use]
pub fn transpose<R: Ring>(a: &Matrix<R>) -> Matrix<R> {
    std::array::from_fn(|i| std::array::from_fn(|j| a[j][i].clone()))
}

/// Returns the image of a vector.
#[must_use]
pub fn apply<R: Ring>(a: &Matrix<R>, v: &Vector<R>) -> Vector<R> {
    a.each_ref().map(|row| dot(row, v))
}

/// Returns the determinant.
#[must_use]
pub fn determinant<R: Ring>(a: &Matrix<R>) -> R {
    dot(&a[0], &crate::motion::cross(&a[1], &a[2]))
}

/// Returns the rotation nearest to a matrix, in the sum of squares of the entries, and the largest entry of the difference.
/// `None` for a matrix that is not finite.
///
/// # Source
/// The polar factor by singular values, \[Kabsch1976\].
#[must_use]
pub fn nearest(a: &Matrix<f64>) -> Option<(Matrix<f64>, f64)> {
    if a.iter().flatten().any(|c| !c.is_finite()) {
        return None;
    }
    let given = Matrix3::from_fn(|i, j| a[i][j]);
    let parts = finite(given).svd(true, true);
    let (u, v) = (parts.u?, parts.v_t?);
    let mut flip = Matrix3::identity();
    flip[(2, 2)] = (u * v).determinant().signum();
    let found = u * flip * v;
    let rotation = std::array::from_fn(|i| std::array::from_fn(|j| found[(i, j)]));
    Some((rotation, (given - found).amax()))
}
