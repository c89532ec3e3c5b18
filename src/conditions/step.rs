//! A step of a derivation: the claim, the polynomials computed, and whether the claim holds for them.

use super::quotient::Quotient;
use super::twist_family::Ratio;
use crate::algebra::factors::remove_factors;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};
use crate::algebra::text::{Format, Names};
use crate::derivation::transference::Variables;
use rug::Rational;

type Poly = Polynomial<Int>;

/// A step.
#[derive(Clone, Debug)]
pub struct Step {
    /// A short title.
    pub title: String,
    /// The claim and its reason.
    pub text: String,
    /// The formulas computed.
    pub formulas: Vec<Formula>,
    /// Whether the computation confirms the claim.
    pub holds: bool,
}

/// A named polynomial or ratio, in factors.
#[derive(Clone, Debug)]
pub struct Formula {
    /// The left side.
    pub name: String,
    /// The right side as readable text.
    pub value: String,
}

impl Formula {
    /// Creates a formula from a polynomial in factors: the given ones, and the rest.
    #[must_use]
    pub fn new(name: &str, polynomial: &Poly, factors: &[Poly]) -> Self {
        Self { name: name.to_owned(), value: product(&factored(polynomial, factors), &tangents()) }
    }

    /// Creates a formula with any text.
    #[must_use]
    pub fn text(name: &str, value: String) -> Self {
        Self { name: name.to_owned(), value }
    }

    /// Creates a formula from a ratio of polynomials.
    #[must_use]
    pub fn ratio(name: &str, ratio: &Ratio) -> Self {
        Self { name: name.to_owned(), value: ratio_text(ratio, &tangents()) }
    }
}

/// Returns the names of the half-angle tangents, lengths and offsets.
///
/// # Panics
/// Never: the names are distinct.
#[must_use]
pub fn tangents() -> Names {
    Names::given(Variables::TANGENTS).expect("the names are distinct")
}

/// Returns a ratio of polynomials as text, both in factors.
#[must_use]
pub fn ratio_text((numerator, denominator): &Ratio, names: &Names) -> String {
    let bracketed = |p: &Poly| {
        let text = product(&factored(p, &[]), names);
        if text.contains(' ') { format!("({text})") } else { text }
    };
    if *denominator == Poly::one() {
        return product(&factored(numerator, &[]), names);
    }
    format!("{}/{}", bracketed(numerator), bracketed(denominator))
}

/// Returns a rational function as text.
#[must_use]
pub fn quotient_text(quotient: &Quotient, names: &Names) -> String {
    ratio_text(&(quotient.numerator().clone(), quotient.denominator().clone()), names)
}

/// Converts to rational coefficients, as text output needs.
#[must_use]
pub fn rational(polynomial: &Poly) -> Polynomial<Rational> {
    polynomial.map(|c| Some(Rational::from(c.to_integer()))).unwrap_or_else(Polynomial::zero)
}

/// Returns a polynomial as text.
#[must_use]
pub fn plain(polynomial: &Poly, names: &Names) -> String {
    Format::Text.polynomial(&rational(polynomial), names)
}

/// Returns the factors of a polynomial with their powers, a number first if it is not 1: the given factors, then the
/// square-free factors of the rest.
#[must_use]
pub fn factored(polynomial: &Poly, factors: &[Poly]) -> Vec<(Poly, u32)> {
    if polynomial.is_zero() {
        return vec![(Poly::zero(), 1)];
    }
    let removal = remove_factors(polynomial, factors);
    let rest = removal.rest.primitive_part();
    let number = removal.rest.div_exact(&rest);
    let mut found: Vec<(Poly, u32)> = Vec::new();
    if number != Poly::one() {
        found.push((number, 1));
    }
    found.extend(removal.factors.into_iter().filter(|(_, power)| *power > 0));
    for (factor, power) in rest.square_free_decomposition() {
        let mut factor = factor;
        // Variables are factors of their own.
        for variable in 0..factor.variables() {
            let removal = remove_factors(&factor, &[Poly::variable(variable)]);
            if removal.factors[0].1 > 0 && removal.rest != Poly::one() {
                found.push((Poly::variable(variable), u32::try_from(power).unwrap_or(u32::MAX)));
                factor = removal.rest;
            }
        }
        found.push((factor, u32::try_from(power).unwrap_or(u32::MAX)));
    }
    if found.is_empty() {
        found.push((Poly::one(), 1));
    }
    found
}

/// Returns a product as text.
#[must_use]
pub fn product(factors: &[(Poly, u32)], names: &Names) -> String {
    let one = |(factor, power): &(Poly, u32)| {
        let text = plain(factor, names);
        let single = factor.len() <= 1 && (*power == 1 || factor.total_degree() == Some(1)) && !text.starts_with('-');
        let text = if single || factors.len() == 1 && *power == 1 { text } else { format!("({text})") };
        if *power == 1 { text } else { format!("{text}^{power}") }
    };
    let number = |(factor, power): &(Poly, u32)| *power == 1 && factor.to_constant().is_some();
    let texts: Vec<String> =
        factors.iter().map(|factor| if number(factor) { plain(&factor.0, names) } else { one(factor) }).collect();
    match texts.split_first() {
        Some((first, [_])) if first == "-1" && factors[1].1 == 1 => plain(&factors[1].0.neg(), names),
        Some((first, rest)) if first == "-1" && !rest.is_empty() => format!("-{}", rest.join(" ")),
        _ => texts.join(" "),
    }
}
