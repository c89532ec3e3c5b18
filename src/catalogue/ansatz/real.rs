//! Detects relations that no real numbers satisfy.

use super::{Ansatz, Meaning, Relation, Symbols};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::trigonometric::{Pair, half_tangents, reduce};
use crate::algebra::univariate::Univariate;
use rug::Rational;
use std::cmp::Ordering;

impl Relation {
    /// Returns why it has no real solution, by itself or together with the relations that give values to symbols.
    pub(super) fn without_real_solution(&self, ansatz: &Ansatz) -> Option<String> {
        let Meaning::Polynomial(polynomial) = &self.meaning else { return None };
        let here = ansatz.without_real_solution(polynomial);
        let why = here.or_else(|| {
            let with_others = ansatz.without_real_solution(&polynomial.substitute_all(&ansatz.replacements()))?;
            Some(format!("with the relations that give values to its symbols, {with_others}"))
        })?;
        Some(format!("`{}` (line {}) has no real solution: {why}", self.text, self.line))
    }
}

impl Ansatz {
    /// Returns why a polynomial in the symbols has no real zero; `None` if that is not detected.
    ///
    /// It is detected for a polynomial in one length or in functions of one angle, by its number of real roots; for a sum of even
    /// powers of one sign and a constant; and for one of degree 2 in lengths, by completing squares.
    #[must_use]
    pub fn without_real_solution(&self, polynomial: &Polynomial<Rational>) -> Option<String> {
        let angles = self.symbols.angles.len();
        let pairs: Vec<Pair> = (0..angles).map(|k| Pair { cos: Symbols::cos(k), sin: Symbols::sin(k) }).collect();
        let polynomial = &reduce(polynomial, &pairs);
        if let Some(constant) = polynomial.to_constant() {
            return (!constant.is_zero()).then(|| format!("it says that {constant} vanishes"));
        }
        let used: Vec<usize> = (0..self.symbols.names().list().len()).filter(|&k| polynomial.degree(k) > 0).collect();
        let first = polynomial.coefficients().first()?;
        let of_one_sign =
            polynomial.terms().all(|(exponents, c)| c.cmp0() == first.cmp0() && exponents.iter().all(|e| e % 2 == 0));
        let has_constant = polynomial.terms().any(|(exponents, _)| exponents.iter().all(|&e| e == 0));
        if of_one_sign && has_constant {
            let why = "a sum of even powers of one sign and a constant of the same sign does not vanish";
            return Some(why.to_owned());
        }
        if bounded_away(polynomial, angles) {
            let why = "with all cosines and sines between -1 and 1 its terms do not make up for its constant";
            return Some(why.to_owned());
        }
        let angle = used.first()? / 3;
        let (univariate, what, at_pi) = if angle < angles && used.iter().all(|&k| k / 3 == angle) {
            let variable = Symbols::tan_half(angle);
            if polynomial.degree(variable) > 0 {
                if used.len() > 1 {
                    return None;
                }
                (polynomial.to_univariate(variable)?, "tangent of half the angle", false)
            } else {
                let form = half_tangents(polynomial, &[(pairs[angle], variable)]);
                let at_pi = form.polynomial.degree(variable) < 2 * form.powers[0];
                (form.polynomial.to_univariate(variable)?, "tangent of half the angle", at_pi)
            }
        } else if let [variable] = used.as_slice() {
            (polynomial.to_univariate(*variable)?, "length", false)
        } else {
            let only_lengths = used.iter().all(|&k| k >= 3 * angles);
            let why = "completed squares of one sign and a constant of the same sign do not vanish";
            return (only_lengths && is_definite(polynomial)).then(|| why.to_owned());
        };
        if at_pi || univariate.is_zero() || Univariate::new(univariate.primitive_integers()).distinct_real_roots() > 0 {
            return None;
        }
        Some(format!("the polynomial in the {what}, of degree {}, has no real root", univariate.degree()?))
    }
}

/// Returns whether the constant of a polynomial in cosines and sines exceeds the sum of all its other terms.
fn bounded_away(polynomial: &Polynomial<Rational>, angles: usize) -> bool {
    let (mut constant, mut others) = (Rational::new(), Rational::new());
    for (exponents, c) in polynomial.terms() {
        let is_bounded =
            |(variable, &exponent): (usize, &u32)| exponent == 0 || variable < 3 * angles && variable % 3 != 2;
        if !exponents.iter().enumerate().all(is_bounded) {
            return false;
        }
        if exponents.iter().all(|&e| e == 0) { constant += c } else { others += Rational::from(c.abs_ref()) }
    }
    constant.abs() > others
}

/// Returns whether a polynomial of degree 2 has one sign everywhere.
fn is_definite(polynomial: &Polynomial<Rational>) -> bool {
    let mut rest = polynomial.clone();
    let mut sign = None;
    loop {
        if let Some(constant) = rest.to_constant() {
            return !constant.is_zero() && sign == Some(constant.cmp0());
        }
        if rest.total_degree() > Some(2) {
            return false;
        }
        let Some(variable) = (0..rest.variables()).find(|&k| rest.degree(k) > 0) else { return false };
        let parts = rest.coefficients_in(variable);
        let [constant, linear, square] = parts.as_slice() else { return false };
        let Some(square) = square.to_constant() else { return false };
        if square.cmp0() == Ordering::Equal || *sign.get_or_insert(square.cmp0()) != square.cmp0() {
            return false;
        }
        // s x^2 + l x + c = s (x + l/2s)^2 + c - l^2/4s
        let Some(inverse) = Rational::from(&square * 4).inverse() else { return false };
        rest = constant.sub(&linear.mul(linear).scale(&inverse));
    }
}
