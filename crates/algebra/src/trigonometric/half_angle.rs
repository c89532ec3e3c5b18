//! Half-angle tangents for cosines and sines, with the powers of `1 + t^2` that this takes.

use super::{Pair, reduce};
use crate::polynomial::Polynomial;
use crate::ring::Ring;

/// A polynomial in half-angle tangents.
#[derive(Clone, Debug)]
pub struct HalfAngles<R> {
    /// `f (1 + t_1^2)^(k_1) (1 + t_2^2)^(k_2) ...`, divisible by none of the `1 + t^2`.
    pub polynomial: Polynomial<R>,
    /// `k_1, k_2, ...` in the order of the substitutions. Where the degree in t falls short of 2k, the angle pi is a
    /// root, of as high a multiplicity.
    pub powers: Vec<u32>,
}

/// Replaces cosines and sines by `(1 - t^2)/(1 + t^2)` and `2t/(1 + t^2)`, and multiplies by the least powers of
/// `1 + t^2` that leave no denominator.
///
/// # Shape
/// Each substitution is an angle and the variable of its half-angle tangent, which may be the one of the cosine or sine.
///
/// # Panics
/// When a variable is in two angles, or a tangent occurs in `f` or is that of another angle.
///
/// # Example
/// ```
/// use looproot_algebra::{int::Int, polynomial::Polynomial, ring::Ring, trigonometric::{Pair, half_tangents}};
///
/// // cos^2 - sin^2 = cos 2 phi
/// let (c, s, t) = (Polynomial::<Int>::variable(0), Polynomial::variable(1), Polynomial::variable(2));
/// let form = half_tangents(&c.pow(2).sub(&s.pow(2)), &[(Pair { cos: 0, sin: 1 }, 2)]);
/// assert_eq!(form.polynomial, t.pow(4).sub(&t.pow(2).scale(&Int::from_integer(6))).add(&Ring::one()));
/// assert_eq!(form.powers, [2]);
/// ```
#[must_use]
pub fn half_tangents<R: Ring>(f: &Polynomial<R>, substitutions: &[(Pair, usize)]) -> HalfAngles<R> {
    let pairs: Vec<Pair> = substitutions.iter().map(|(pair, _)| *pair).collect();
    let mut polynomial = reduce(f, &pairs);
    let mut powers = Vec::new();
    for &(pair, tangent) in substitutions {
        let own = tangent == pair.cos || tangent == pair.sin;
        assert!(own || polynomial.degree(tangent) == 0, "the half-angle tangent is a new variable");
        let (substituted, power) = substitute(&polynomial, pair, tangent);
        polynomial = substituted;
        powers.push(power);
    }
    HalfAngles { polynomial, powers }
}

/// Returns the substitution for one angle in a polynomial in normal form.
///
/// Least is the degree in cosine and sine together: at `t = i` the terms of that degree k, `p c^k + q c^(k-1) s`, become
/// `2^k (p + i q)`, and the others vanish.
fn substitute<R: Ring>(f: &Polynomial<R>, pair: Pair, tangent: usize) -> (Polynomial<R>, u32) {
    let parts: Vec<Vec<Polynomial<R>>> =
        f.coefficients_in(pair.sin).iter().map(|part| part.coefficients_in(pair.cos)).collect();
    let degrees = parts.iter().enumerate().filter(|(_, part)| !part.is_empty()).map(|(b, part)| part.len() - 1 + b);
    let Some(k) = degrees.max() else { return (Polynomial::zero(), 0) };
    let mut sum = vec![Polynomial::zero(); 2 * k + 1];
    for (b, part) in parts.iter().enumerate() {
        for (a, coefficient) in part.iter().enumerate().filter(|(_, c)| !c.is_zero()) {
            for (power, weight) in weights::<R>(a, b, k - a - b).iter().enumerate() {
                if !weight.is_zero() {
                    sum[power] = sum[power].add(&coefficient.scale(weight));
                }
            }
        }
    }
    let k = u32::try_from(k).expect("the degree of a polynomial fits a u32");
    (Polynomial::from_coefficients_in(tangent, &sum), k)
}

/// Returns the coefficients of `(1 - t^2)^a (2t)^b (1 + t^2)^rest`.
fn weights<R: Ring>(a: usize, b: usize, rest: usize) -> Vec<R> {
    let mut weights = vec![R::one()];
    let mut multiply = |low: i32, high: i32, shift: usize| {
        let (low, high) = (R::from_integer(low), R::from_integer(high));
        let mut product = vec![R::zero(); weights.len() + shift];
        for (i, w) in weights.iter().enumerate() {
            product[i] = product[i].add(&w.mul(&low));
            product[i + shift] = product[i + shift].add(&w.mul(&high));
        }
        weights = product;
    };
    (0..a).for_each(|_| multiply(1, -1, 2));
    (0..b).for_each(|_| multiply(0, 2, 1));
    (0..rest).for_each(|_| multiply(1, 1, 2));
    weights
}
