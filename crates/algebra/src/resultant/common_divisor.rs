//! The common roots of two polynomials at numbers, exact or not.

use super::bezout;
use super::linear::{reduce, reduce_up_to};
use crate::ring::Field;

/// Returns the greatest common divisor of two polynomials of given degrees over any field, including f64 and complex ones.
///
/// The result holds its coefficients, constant term first. k zeros at the end, which occur only if both polynomials have them,
/// represent a common root at infinity of multiplicity k. `[d0, d1]` is the common root `-d0/d1`; `[1]` means that there is
/// none. It is empty if both polynomials are zero.
///
/// It is found from the null space of the Bezout matrix of the two scaled to a largest coefficient of 1: pivots not above
/// `tolerance` count as zero. In exact fields that is 0; in inexact ones about the relative error of the coefficients.
#[must_use]
pub fn common_divisor<F: Field>(f: &[F], g: &[F], tolerance: f64) -> Vec<F> {
    let (f, g) = if f.len() < g.len() { (g, f) } else { (f, g) };
    let mut divisor = match (to_unit_size(f), to_unit_size(g)) {
        (None, None) => Vec::new(),
        (Some(only), None) | (None, Some(only)) => only,
        (Some(f), Some(g)) => from_null_space(f, &g, tolerance),
    };
    F::normalise(&mut divisor);
    divisor
}

/// Returns the common divisor of two polynomials other than zero, the one of higher degree first.
fn from_null_space<F: Field>(f: Vec<F>, g: &[F], tolerance: f64) -> Vec<F> {
    let m = f.len() - 1;
    let null_space = reduce(&bezout::matrix(&f, g), m, tolerance).null_space();
    let k = null_space.len();
    if k == m {
        // The two are multiples of one another: for m = 0 both are numbers, and else of the same degree.
        return if m == 0 { vec![F::one()] } else { f };
    }
    // The divisor times any power of x is orthogonal to the null vectors, and only its multiples are so for all powers.
    let windows = |v: &Vec<F>| -> Vec<Vec<F>> { v.windows(k + 1).map(<[F]>::to_vec).collect() };
    let windows: Vec<Vec<F>> = null_space.iter().flat_map(windows).collect();
    let mut divisor = reduce_up_to(&windows, k + 1, k, 0.0).null_space().pop().unwrap_or_else(|| vec![F::one()]);
    divisor.reverse();
    divisor
}

/// Returns the coefficients divided by the largest one; `None` if all are zero.
fn to_unit_size<F: Field>(f: &[F]) -> Option<Vec<F>> {
    let larger = |best: &F, c: &F| c.pivot_size() > best.pivot_size();
    let largest = f.iter().fold(F::zero(), |best, c| if larger(&best, c) { c.clone() } else { best });
    let inverse = largest.inverse()?;
    Some(f.iter().map(|c| c.mul(&inverse)).collect())
}
