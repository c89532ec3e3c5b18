//! The Bezout matrix, in the hybrid form that has the resultant itself as its determinant.

use super::odd;
use super::subresultant::power;
use crate::minors::{expand, maximal_minors};
use crate::ring::Ring;
use crate::univariate::Univariate;

/// Returns the hybrid Bezout matrix of two polynomials of degrees `m >= n`: its determinant is the resultant, sign and powers
/// of leading coefficients included, and the vector `(x^(m-1), ..., x, 1)` of a common root is in its null space.
///
/// The first n rows are the polynomials
/// `(a_m x^(k-1) + ... + a_(m-k+1)) x^(m-n) g - (b_n x^(k-1) + ... + b_(n-k+1)) f` for k = n, ..., 1, of degree m - 1 at
/// most; the rows `x^(m-n-1) g, ..., g` follow. The rows from the second one on are those of the first subresultant: its
/// coefficients are their minors without one of the last two columns.
///
/// # Shape
/// `m + 1` and `n + 1` coefficients, constant term first; leading ones may be zero. The matrix is of size m, with the
/// highest power of x in the first column.
///
/// # Panics
/// When `g` has no coefficients, or more than `f`.
///
/// # Source
/// Diaz-Toca, Gonzalez-Vega 2004, Various new expressions for subresultants and their applications, Applicable Algebra
/// in Engineering, Communication and Computing 15.
#[must_use]
pub fn matrix<R: Ring>(f: &[R], g: &[R]) -> Vec<Vec<R>> {
    assert!(!g.is_empty() && g.len() <= f.len(), "the polynomial of higher degree comes first");
    let (m, n) = (f.len() - 1, g.len() - 1);
    let low = m - n;
    // f_i g_j - f_j g_i for g times x^(m-n); `None` for zero.
    let bracket = |i: usize, j: usize| -> Option<R> {
        let product =
            |i: usize, j: usize| (j >= low && !f[i].is_zero() && !g[j - low].is_zero()).then(|| f[i].mul(&g[j - low]));
        match (product(i, j), product(j, i)) {
            (Some(x), Some(y)) => Some(x.sub(&y)),
            (Some(x), None) => Some(x),
            (None, Some(y)) => Some(y.neg()),
            (None, None) => None,
        }
    };
    let mut brackets = vec![vec![None; m]; m + 1];
    for i in (0..=m).rev() {
        for j in 0..i {
            brackets[i][j] = bracket(i, j);
        }
    }
    // Each of these rows is x times the one before plus the brackets with the next lower coefficient; the brackets are
    // antisymmetric.
    let mut rows: Vec<Vec<R>> = Vec::with_capacity(m);
    let mut row = vec![R::zero(); m];
    for k in 0..n {
        let i = m - k;
        let entry = |j: usize| {
            let shifted = if j == 0 || k == 0 { R::zero() } else { row[m - j].clone() };
            let (value, negative) = if j < i { (&brackets[i][j], false) } else { (&brackets[j][i], true) };
            match value {
                None => shifted,
                Some(_) if i == j => shifted,
                Some(value) if negative => shifted.sub(value),
                Some(value) => shifted.add(value),
            }
        };
        row = (0..m).rev().map(entry).collect();
        rows.push(row.clone());
    }
    rows.reverse();
    for shift in (0..low).rev() {
        let mut row = vec![R::zero(); m];
        for (k, c) in g.iter().enumerate() {
            row[m - 1 - k - shift] = c.clone();
        }
        rows.push(row);
    }
    rows
}

/// A resultant and the first subresultant, which leads back to the common root.
#[derive(Clone, Debug, PartialEq)]
pub struct Expansion<R> {
    /// The resultant.
    pub resultant: R,
    /// A polynomial of degree 1 or less that vanishes at the common root of two that have just one: the first
    /// subresultant up to sign, or the polynomial of degree 1 if one of the two is; zero if one is constant.
    pub linear: Univariate<R>,
}

/// Returns the resultant and the first subresultant by the minors of the hybrid Bezout matrix, without division, for degrees
/// up to about 5 and coefficients with symbols in them. It is right for constants, and 0 if a polynomial is zero.
///
/// # Panics
/// If a degree is above 20.
#[must_use]
pub fn expansion<R: Ring>(f: &Univariate<R>, g: &Univariate<R>) -> Expansion<R> {
    let (Some(m), Some(n)) = (f.degree(), g.degree()) else {
        return Expansion { resultant: R::zero(), linear: Univariate::zero() };
    };
    if m < n {
        let swapped = expansion(g, f);
        let resultant = if odd(m * n) { swapped.resultant.neg() } else { swapped.resultant };
        return Expansion { resultant, linear: swapped.linear };
    }
    let (a, b) = (f.coefficients(), g.coefficients());
    match n {
        0 => Expansion { resultant: power(&b[0], m), linear: Univariate::zero() },
        1 => Expansion { resultant: at_root(a, &b[0], &b[1]), linear: g.clone() },
        _ => {
            let rows = matrix(a, b);
            let minors = maximal_minors(&rows[1..], m);
            let linear = Univariate::new(vec![minors[m - 2].clone(), minors[m - 1].clone()]);
            Expansion { resultant: expand(&rows[0], &minors), linear }
        }
    }
}

/// Returns `b1^m f(-b0/b1)`, by Horner's rule; its sign is that of `Res(b1 x + b0, f)`, turned if m is odd.
fn at_root<R: Ring>(f: &[R], b0: &R, b1: &R) -> R {
    let (Some((top, rest)), root) = (f.split_last(), b0.neg()) else { return R::zero() };
    let (mut value, mut scale) = (top.clone(), R::one());
    for c in rest.iter().rev() {
        scale = scale.mul(b1);
        value = value.mul(&root).add(&c.mul(&scale));
    }
    if odd(rest.len()) { value.neg() } else { value }
}
