//! Quadratic forms in the quaternion of a rotation.

use crate::closure::study::Form;
use crate::kinematics::motion::{Vector, dot};
use rug::Rational;

/// A 3 x 3 matrix, row by row.
pub type Matrix = [Vector<Rational>; 3];

/// `sum_ij c_ij (N R)_ij` for the matrix `N R` of a quaternion.
pub fn rotation_form(c: &Matrix) -> Form<Rational> {
    let [a, b, d] = [&c[0][0], &c[1][1], &c[2][2]];
    let sum = |p: &Rational, q: &Rational| Rational::from(p + q);
    let gap = |p: &Rational, q: &Rational| Rational::from(p - q);
    let (w, x, y, z) = (sum(a, b) + d, gap(a, b) - d, gap(b, a) - d, gap(d, a) - b);
    let (wx, wy, wz) = (gap(&c[2][1], &c[1][2]), gap(&c[0][2], &c[2][0]), gap(&c[1][0], &c[0][1]));
    let (xy, xz, yz) = (sum(&c[0][1], &c[1][0]), sum(&c[0][2], &c[2][0]), sum(&c[1][2], &c[2][1]));
    [[w, wx.clone(), wy.clone(), wz.clone()], [wx, x, xy.clone(), xz.clone()], [wy, xy, y, yz.clone()], [wz, xz, yz, z]]
}

/// A multiple of N.
pub fn norm_form(factor: &Rational) -> Form<Rational> {
    let entry = |j: usize, k: usize| if j == k { factor.clone() } else { Rational::new() };
    std::array::from_fn(|j| std::array::from_fn(|k| entry(j, k)))
}

/// A combination of forms.
pub fn combination<'a>(terms: impl IntoIterator<Item = (Rational, &'a Form<Rational>)>) -> Form<Rational> {
    let mut sum = norm_form(&Rational::new());
    for (factor, form) in terms {
        for (target, source) in sum.iter_mut().flatten().zip(form.iter().flatten()) {
            *target += Rational::from(&factor * source);
        }
    }
    sum
}

/// `p - q`
pub fn difference(p: &Form<Rational>, q: &Form<Rational>) -> Form<Rational> {
    combination([(Rational::from(1), p), (Rational::from(-1), q)])
}

/// The matrix with these columns.
pub fn of_columns(columns: &[Vector<Rational>]) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i].clone()))
}

/// The cofactors of a matrix: `m^-T` times its determinant.
pub fn cofactors(m: &Matrix) -> Matrix {
    let minor = |i: usize, j: usize| {
        let at = |k: usize, l: usize| &m[(i + k) % 3][(j + l) % 3];
        Rational::from(at(1, 1) * at(2, 2)) - Rational::from(at(1, 2) * at(2, 1))
    };
    std::array::from_fn(|i| std::array::from_fn(|j| minor(i, j)))
}

/// `sum_k m_0k c_0k` with the cofactors c.
pub fn determinant(m: &Matrix, cofactors: &Matrix) -> Rational {
    dot(&m[0], &cofactors[0])
}

/// `a b^T`
pub fn times_transposed(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| dot(&a[i], &b[j])))
}

/// The transposed matrix.
pub fn transposed(m: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i].clone()))
}
