//! The closure equations of a Stewart platform in Study's parameters: six leg quadrics and the Study condition.
//!
//! A pose is a point (x, y) of the projective space: x the quaternion of the rotation, `y = p x` that of the translation
//! p (no factor 1/2). With `N = x.x` the vector of leg i, times the quaternion x, is `w_i = y + x b_i - a_i x`, so that
//!
//! * leg i: `w_i.w_i = L_i^2 N`,
//! * the Study condition: `x.y = 0`,
//!
//! and every solution with `N != 0` is a pose. \[Wittenburg2016\], section 8.1.
//!
//! The legs are linear in `u = N (p.p, p, R^T p)`: `K u = c(x)` with a constant 6 x 7 matrix K and quadratic forms c.

use crate::algebra::ring::Ring;
use crate::kinematics::motion::{Vector, dot};
use crate::kinematics::platform::Platform;

/// Four coordinates, the scalar part first.
pub type Four<R> = [R; 4];
/// A 4 x 4 matrix, or the quadratic form of a symmetric one.
pub type Form<R> = [[R; 4]; 4];

/// Returns the matrix of the product `v x` with a pure quaternion v on the left.
#[must_use]
pub fn left<R: Ring>(v: &Vector<R>) -> Form<R> {
    let [a, b, c] = v;
    let zero = R::zero;
    [
        [zero(), a.neg(), b.neg(), c.neg()],
        [a.clone(), zero(), c.neg(), b.clone()],
        [b.clone(), c.clone(), zero(), a.neg()],
        [c.clone(), b.neg(), a.clone(), zero()],
    ]
}

/// Returns the matrix of the product `x v` with a pure quaternion v on the right.
#[must_use]
pub fn right<R: Ring>(v: &Vector<R>) -> Form<R> {
    let [a, b, c] = v;
    let zero = R::zero;
    [
        [zero(), a.neg(), b.neg(), c.neg()],
        [a.clone(), zero(), c.clone(), b.neg()],
        [b.clone(), c.neg(), zero(), a.clone()],
        [c.clone(), b.clone(), a.neg(), zero()],
    ]
}

/// Returns the skew matrix M of a leg, `M x = x b - a x`.
#[must_use]
pub fn leg_matrix<R: Ring>(base: &Vector<R>, plate: &Vector<R>) -> Form<R> {
    let (left, right) = (left(base), right(plate));
    std::array::from_fn(|i| std::array::from_fn(|j| right[i][j].sub(&left[i][j])))
}

/// Returns `x0 y0 + x1 y1 + x2 y2 + x3 y3`: the norm N of x with itself, the left side of the Study condition of x with y.
#[must_use]
#[inline(always)]
pub fn scalar<R: Ring>(x: &Four<R>, y: &Four<R>) -> R {
    x[0].mul(&y[0]).add(&x[1].mul(&y[1])).add(&x[2].mul(&y[2])).add(&x[3].mul(&y[3]))
}

/// One leg in Study's parameters: its points as a matrix, and its squared length. The constants may be of a smaller ring
/// than the unknowns; `times` multiplies an unknown by a constant.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg<C> {
    /// The skew matrix M.
    pub matrix: Form<C>,
    /// L^2.
    pub square: C,
}

impl<C: Ring> Leg<C> {
    /// Returns the leg between two points.
    #[must_use]
    pub fn new(base: &Vector<C>, plate: &Vector<C>, square: C) -> Self {
        Self { matrix: leg_matrix(base, plate), square }
    }

    /// Returns `w = y + M x`, the vector of the leg times x.
    #[inline(always)]
    pub fn vector<R: Ring>(&self, x: &Four<R>, y: &Four<R>, times: impl Fn(&R, &C) -> R + Copy) -> Four<R> {
        std::array::from_fn(|i| y[i].add(&self.row(i, x, times)))
    }

    /// Returns the leg quadric `w.w - L^2 N`.
    #[inline(always)]
    pub fn quadric<R: Ring>(&self, x: &Four<R>, y: &Four<R>, times: impl Fn(&R, &C) -> R + Copy) -> R {
        let w = self.vector(x, y, times);
        scalar(&w, &w).sub(&times(&scalar(x, x), &self.square))
    }

    /// Returns half the derivative of the leg quadric by x, `-M w - L^2 x` (M is skew); half the one by y is w.
    #[inline(always)]
    pub fn half_slope<R: Ring>(&self, w: &Four<R>, x: &Four<R>, times: impl Fn(&R, &C) -> R + Copy) -> Four<R> {
        std::array::from_fn(|i| self.row(i, w, times).add(&times(&x[i], &self.square)).neg())
    }

    /// Row i of the matrix times a vector; the diagonal of a skew matrix is zero.
    #[inline(always)]
    fn row<R: Ring>(&self, i: usize, x: &Four<R>, times: impl Fn(&R, &C) -> R + Copy) -> R {
        let [j, k, l] = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]][i];
        let row = &self.matrix[i];
        times(&x[j], &row[j]).add(&times(&x[k], &row[k])).add(&times(&x[l], &row[l]))
    }
}

/// The legs as linear equations, `K u = c(x)`, for any lengths.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearLegs<R> {
    /// The rows `(1, -2 a_i, 2 b_i)` of K, for `u = N (p.p, p, R^T p)`.
    pub matrix: [[R; 7]; 6],
    /// The forms `c_i - L_i^2 N`, as symmetric matrices: `2 (a_i x).(x b_i) - (a_i.a_i + b_i.b_i) N`.
    pub forms: [Form<R>; 6],
}

/// Returns the legs of a platform as linear equations.
#[must_use]
pub fn linear_legs<R: Ring>(platform: &Platform<R>) -> LinearLegs<R> {
    let twice = |x: &R| x.add(x);
    let row = |i: usize| {
        std::array::from_fn(|k| match k {
            0 => R::one(),
            1..=3 => twice(&platform.base[i][k - 1]).neg(),
            _ => twice(&platform.plate[i][k - 4]),
        })
    };
    let form = |i: usize| -> Form<R> {
        let (a, b) = (&platform.base[i], &platform.plate[i]);
        let (left, right) = (left(a), right(b));
        let squares = dot(a, a).add(&dot(b, b));
        // (a x).(x b) = x^T left^T right x; left is skew, and the product of the two symmetric as they commute.
        std::array::from_fn(|j| {
            std::array::from_fn(|k| {
                let entry = (0..4).fold(R::zero(), |sum, l| sum.sub(&left[j][l].mul(&right[l][k])));
                let entry = twice(&entry);
                if j == k { entry.sub(&squares) } else { entry }
            })
        })
    };
    LinearLegs { matrix: std::array::from_fn(row), forms: std::array::from_fn(form) }
}
