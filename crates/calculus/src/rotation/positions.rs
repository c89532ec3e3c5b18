//! Positions of a body that turns about a point: rotations from points, between positions, reflections.

use super::matrix::{Matrix, determinant, nearest};
use super::vectors::unit;
use crate::finite::finite;
use crate::motion::{Vector, cross, dot};
use crate::quaternion::Quaternion;
use crate::unit::{Analytic, Root, Unit};
use looproot_algebra::ring::Ring;

/// Returns the linear map that takes two vectors to two others, and their cross product to that of the others. It is the
/// rotation if lengths and the angle agree. `None` for parallel vectors.
///
/// # Example
/// ```
/// use looproot_calculus::rotation::positions::taking;
/// let a = taking(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]).unwrap();
/// assert_eq!(a, [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
/// ```
///
/// # Source
/// \[Wittenburg2016, 1.15.7\]: two displacements of points determine the rotation.
#[must_use]
pub fn taking<R: Unit>(before: &[Vector<R>; 2], after: &[Vector<R>; 2]) -> Option<Matrix<R>> {
    let (u, v) = (&before[0], &before[1]);
    let w = cross(u, v);
    let inverse = dot(&w, &w).reciprocal()?;
    // The dual basis of u, v, u x v.
    let dual = [cross(v, &w), cross(&w, u), w].map(|row| row.map(|c| c.mul(&inverse)));
    let images = [&after[0], &after[1], &cross(&after[0], &after[1])];
    Some(std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let mut sum = R::zero();
            for k in 0..3 {
                sum.add_product(&images[k][i], &dual[k][j]);
            }
            sum
        })
    }))
}

/// Returns the rotation that takes the first vectors nearest to the second ones, in the sum of squares; `None` if the vectors do
/// not span a plane.
///
/// # Source
/// \[Kabsch1976\]
#[must_use]
pub fn nearest_rotation(pairs: &[(Vector<f64>, Vector<f64>)]) -> Option<Matrix<f64>> {
    let product: Matrix<f64> = std::array::from_fn(|i| {
        std::array::from_fn(|j| pairs.iter().map(|(before, after)| after[i] * before[j]).sum())
    });
    let singular = finite(nalgebra::Matrix3::from_fn(|i, j| product[i][j])).singular_values();
    let largest = singular.max();
    // Two of the three singular values must exceed rounding.
    let clear = singular.iter().filter(|s| **s > 1e-12 * largest).count();
    if clear < 2 {
        return None;
    }
    nearest(&product).map(|(rotation, _)| rotation)
}

/// Returns the axis of the rotation that takes a point of the body through three positions on one circle: the normal of the
/// plane of the three. It is 0 for points in a line.
///
/// # Source
/// \[Wittenburg2016, 1.15.6\]
#[must_use]
pub fn circle_axis<R: Ring>(points: &[Vector<R>; 3]) -> Vector<R> {
    let difference = |k: usize| std::array::from_fn(|i| points[k][i].sub(&points[0][i]));
    cross(&difference(1), &difference(2))
}

/// Returns the reflection in the plane through the origin with this normal of any length, as a matrix of determinant -1.
///
/// # Example
/// ```
/// use looproot_calculus::rotation::matrix::{product, determinant};
/// use looproot_calculus::rotation::positions::reflection;
/// let (m, n) = (reflection(&[1.0, 0.0, 0.0]).unwrap(), reflection(&[1.0, 1.0, 0.0]).unwrap());
/// // Two reflections are the rotation by twice the angle between the planes: here 90 degrees.
/// assert!((product(&n, &m)[1][0].abs() - 1.0).abs() < 1e-15 && determinant(&m) == -1.0);
/// ```
///
/// # Source
/// \[Wittenburg2016, 1.16\]
#[must_use]
pub fn reflection<R: Unit>(normal: &Vector<R>) -> Option<Matrix<R>> {
    let twice = dot(normal, normal).reciprocal().map(|inverse| inverse.add(&inverse))?;
    Some(std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let unit = if i == j { R::one() } else { R::zero() };
            unit.sub(&twice.mul(&normal[i]).mul(&normal[j]))
        })
    }))
}

/// Returns whether a matrix keeps lengths and orientation, exactly.
#[must_use]
pub fn is_rotation<R: Ring>(a: &Matrix<R>) -> bool {
    let is_orthogonal = (0..3).all(|i| (0..3).all(|j| dot(&a[i], &a[j]) == if i == j { R::one() } else { R::zero() }));
    is_orthogonal && determinant(a) == R::one()
}

/// Returns the rotation at the share `s` of the way from one position to another, at constant angular velocity about a fixed axis.
///
/// # Example
/// ```
/// use looproot_calculus::quaternion::Quaternion;
/// use looproot_calculus::rotation::positions::between;
/// let quarter = Quaternion { scalar: 1.0, vector: [0.0, 0.0, 1.0] };
/// let half_way = between(&Quaternion::identity(), &quarter, &0.5).unwrap();
/// assert!((half_way.vector[2] - (std::f64::consts::PI / 8.0).sin()).abs() < 1e-15);
/// ```
///
/// # Source
/// \[Wittenburg2016, 1.15.8\]
#[must_use]
pub fn between<R: Analytic>(from: &Quaternion<R>, to: &Quaternion<R>, s: &R) -> Option<Quaternion<R>> {
    let start = unit(from)?;
    let step = unit(&unit(to)?.mul(&start.conjugate()))?;
    let vector = super::vectors::euler_vectors(&step).into_iter().next()?;
    let part = super::vectors::from_euler_vector(&vector.map(|c| c.mul(s)))?;
    Some(part.mul(&start))
}

/// Returns the rotations that take position i to position j, for three positions: the sides of the rotation triangle. The
/// product of all three, in order, is the identity.
///
/// # Example
/// ```
/// use looproot_calculus::quaternion::Quaternion;
/// use looproot_calculus::rotation::positions::triangle;
/// use rug::Rational;
/// let q = |w: i32, v: [i32; 3]| Quaternion { scalar: Rational::from(w), vector: v.map(Rational::from) };
/// let [a, b, c] = triangle(&[q(1, [0, 0, 0]), q(1, [1, 0, 2]), q(2, [0, 1, 1])]);
/// assert!(c.mul(&b).mul(&a).vector.iter().all(|x| *x == 0));
/// ```
///
/// # Source
/// \[Wittenburg2016, 1.9\]
#[must_use]
pub fn triangle<R: Ring>(positions: &[Quaternion<R>; 3]) -> [Quaternion<R>; 3] {
    std::array::from_fn(|k| positions[(k + 1) % 3].mul(&positions[k].conjugate()))
}

/// Returns the cosines of the sides of the spherical triangle of three unit axes. Half the rotation angles are its outer angles.
#[must_use]
pub fn sides<R: Root>(axes: &[Vector<R>; 3]) -> [R; 3] {
    std::array::from_fn(|k| dot(&axes[(k + 1) % 3], &axes[(k + 2) % 3]))
}
