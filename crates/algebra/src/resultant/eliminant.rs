//! Eliminates a variable from two polynomials in several, and recovers it.

use super::bezout::{self, Expansion};
use super::common_divisor::common_divisor;
use super::route;
use super::subresultant;
use crate::int::Int;
use crate::modular::{self, Terms};
use crate::polynomial::Polynomial;
use crate::ring::{Domain, Field, Ring};
use crate::univariate::Univariate;
use std::borrow::Cow;

/// Rows of a Bezout matrix beyond which its minors in words are not worth a trial.
const MOST_ROWS: usize = 6;

/// Returns the resultant of two polynomials with respect to a variable, with the sign of the Sylvester determinant.
///
/// `Res(f, c) = c^m` for c free of the variable, and 0 if either polynomial is zero.
///
/// # Panics
/// If an exponent becomes larger than [`LARGEST_EXPONENT`](crate::monomial::LARGEST_EXPONENT).
///
/// # Example
/// ```
/// use looproot_algebra::{int::Int, polynomial::Polynomial, resultant::resultant, ring::Ring};
///
/// // The circle x^2 + y^2 = 25 and the line x + y = 7 meet where y = 3 or 4.
/// let (x, y) = (Polynomial::<Int>::variable(0), Polynomial::variable(1));
/// let circle = x.pow(2).add(&y.pow(2)).sub(&Ring::from_integer(25));
/// let line = x.add(&y).sub(&Ring::from_integer(7));
/// let (three, four) = (Ring::from_integer(3), Ring::from_integer(4));
/// assert_eq!(resultant(&circle, &line, 0), y.sub(&three).mul(&y.sub(&four)).scale(&Int::from_integer(2)));
/// ```
#[must_use]
pub fn resultant(f: &Polynomial<Int>, g: &Polynomial<Int>, variable: usize) -> Polynomial<Int> {
    let (m, n) = (f.degree(variable) as usize, g.degree(variable) as usize);
    let ((content_f, f), (content_g, g)) = (without_content(f), without_content(g));
    let factor = subresultant::power(&content_f, n).mul(&subresultant::power(&content_g, m));
    let resultant = by_values(&f, &g, variable);
    let resultant = resultant.unwrap_or_else(|| eliminate(&f, &g, variable).resultant);
    if factor == Int::one() { resultant } else { resultant.scale(&factor) }
}

/// Returns the resultant from its values modulo primes; `None` if another way is expected to be faster, or that takes too
/// much memory.
fn by_values(f: &Polynomial<Int>, g: &Polynomial<Int>, variable: usize) -> Option<Polynomial<Int>> {
    let (m, n) = (f.degree(variable), g.degree(variable));
    if m.min(n) < 2 || m.max(n) < 3 {
        return None;
    }
    let variables = f.variables().max(g.variables()).max(variable + 1);
    let (of_f, of_g) = (Terms::of(f, variables), Terms::of(g, variables));
    let (cost, values) = modular::resultant_cost(&of_f, &of_g, variables, variable)?;
    if let Some(resultant) = by_words(f, g, variable, cost) {
        return Some(resultant);
    }
    if !route::values_pay(f, g, variable, cost, values) {
        return None;
    }
    modular::resultant(&of_f, &of_g, variables, variable).map(|terms| terms.polynomial(variables))
}

/// Returns the resultant of polynomials with one parameter as the determinant of the Bezout matrix in machine words; `None` where
/// that is not possible, or takes more nanoseconds than the limit.
fn by_words(f: &Polynomial<Int>, g: &Polynomial<Int>, variable: usize, limit: f64) -> Option<Polynomial<Int>> {
    let (m, n) = (f.degree(variable) as usize, g.degree(variable) as usize);
    if m < n {
        let swapped = by_words(g, f, variable, limit)?;
        return Some(if m * n % 2 == 1 { swapped.neg() } else { swapped });
    }
    let occurs = |v: &usize| *v != variable && (f.degree(*v) > 0 || g.degree(*v) > 0);
    let mut parameters = (0..f.variables().max(g.variables())).filter(occurs);
    let parameter = parameters.next()?;
    if m > MOST_ROWS || parameters.next().is_some() {
        return None;
    }
    let coefficients = |f: &Polynomial<Int>| {
        let mut parts = vec![vec![Int::zero(); f.degree(parameter) as usize + 1]; f.degree(variable) as usize + 1];
        for (term, c) in f.coefficients().iter().enumerate() {
            parts[f.exponent(term, variable) as usize][f.exponent(term, parameter) as usize] = c.clone();
        }
        parts.into_iter().map(Univariate::new).collect::<Vec<_>>()
    };
    let matrix = bezout::matrix(&coefficients(f), &coefficients(g));
    let entries: Vec<Vec<Int>> = matrix.iter().flatten().map(|entry| entry.coefficients().to_vec()).collect();
    let determinant = modular::short_determinant(m, &entries, Some(limit))?;
    Some(Polynomial::from_univariate(parameter, &Univariate::new(determinant)))
}

/// Returns the greatest common divisor of the coefficients, and the polynomial without it.
fn without_content(f: &Polynomial<Int>) -> (Int, Cow<'_, Polynomial<Int>>) {
    let content = f.content();
    if content == Int::one() || content.is_zero() {
        return (Int::one(), Cow::Borrowed(f));
    }
    let divided = f.map(|c| c.checked_div_exact(&content)).expect("the content divides all coefficients");
    (content, Cow::Owned(divided))
}

/// The result of eliminating a variable from two polynomials.
#[derive(Clone, Debug)]
pub struct Eliminant<R> {
    /// The resultant, with the sign of the Sylvester determinant: it vanishes if the two have a common root, or both
    /// lose their leading coefficients.
    pub resultant: Polynomial<R>,
    /// A polynomial in the eliminated variable that vanishes at the common root, mostly `s1 x + s0`, the first
    /// subresultant up to factors free of x; then `x = -s0/s1` wherever s1 does not vanish. Two polynomials in `x^k` have
    /// `s1 x^k + s0` here. It is zero if there is no such polynomial.
    pub lift: Univariate<Polynomial<R>>,
    f: Univariate<Polynomial<R>>,
    g: Univariate<Polynomial<R>>,
}

/// Eliminates a variable from two polynomials over any ring with exact division.
///
/// # Panics
/// When an exponent becomes larger than [`LARGEST_EXPONENT`](crate::monomial::LARGEST_EXPONENT).
///
/// # Example
/// ```
/// use looproot_algebra::{polynomial::Polynomial, resultant::eliminate, ring::{Field, Ring}};
/// use rug::Rational;
///
/// // x^2 = y and x y = 8 meet at x = 2, y = 4.
/// let (x, y) = (Polynomial::<Rational>::variable(0), Polynomial::variable(1));
/// let eliminant = eliminate(&x.pow(2).sub(&y), &x.mul(&y).sub(&Ring::from_integer(8)), 0);
/// assert_eq!(eliminant.resultant, Polynomial::<Rational>::from_integer(64).sub(&y.pow(3)));
/// assert_eq!(eliminant.lift.coefficients(), [Ring::from_integer(-8), y]);
/// let exact = eliminant.common_divisor_at(|c| Some(c.clone()), &[Rational::new(), Rational::from(4)], 0.0);
/// assert_eq!(exact, Some(vec![Rational::from(-2), Rational::from(1)]));
/// let close = eliminant.common_divisor_at(f64::from_rational, &[0.0, 4.000_000_000_1], 1e-9).unwrap();
/// assert!((close[0] / close[1] + 2.0).abs() < 1e-9);
/// ```
#[must_use]
pub fn eliminate<D: Domain>(f: &Polynomial<D>, g: &Polynomial<D>, variable: usize) -> Eliminant<D> {
    let parts = |f: &Polynomial<D>| Univariate::new(f.coefficients_in(variable));
    let (f, g) = (parts(f), parts(g));
    let Expansion { resultant, linear } = route::expansion(&f, &g);
    Eliminant { resultant, lift: linear, f, g }
}

impl<R: Ring> Eliminant<R> {
    /// Returns the greatest common divisor of the two polynomials at the given values of the variables (that of the
    /// eliminated one is ignored), see [`common_divisor`]; `None` if a coefficient has no image.
    pub fn common_divisor_at<F: Field>(
        &self,
        image: impl Fn(&R) -> Option<F>,
        values: &[F],
        tolerance: f64,
    ) -> Option<Vec<F>> {
        let at = |f: &Univariate<Polynomial<R>>| -> Option<Vec<F>> {
            f.coefficients().iter().map(|c| c.map(&image).map(|c| c.evaluate(values))).collect()
        };
        Some(common_divisor(&at(&self.f)?, &at(&self.g)?, tolerance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Degrees in any order, so that an exchange turns the sign or not.
    #[test]
    fn resultants_by_words_are_those_by_polynomials() {
        let polynomial = |degree: u32, seed: u32| {
            let c = move |i: u32, j: u32| Int::from(i64::from(seed * (7 * i * i + 3 * j + i * j + 1) % 23) - 11);
            Polynomial::from_terms((0..=degree).flat_map(|i| (0..=2).map(move |j| (vec![j, i], c(i, j)))))
        };
        for (m, n) in [(3, 2), (2, 3), (3, 3), (1, 4), (3, 5), (4, 3), (5, 5), (6, 3)] {
            let (f, g) = (polynomial(m, 17), polynomial(n, 29));
            let found = by_words(&f, &g, 1, f64::INFINITY).unwrap();
            assert!(!found.is_zero());
            assert_eq!(found, eliminate(&f, &g, 1).resultant);
            assert_eq!(found, resultant(&f, &g, 1));
        }
        let f = polynomial(3, 17);
        assert!(by_words(&f, &polynomial(7, 29), 1, f64::INFINITY).is_none());
        assert!(by_words(&f, &f.add(&Polynomial::variable(2)), 1, f64::INFINITY).is_none());
        assert!(by_words(&f, &f, 1, f64::INFINITY).unwrap().is_zero());
    }
}
