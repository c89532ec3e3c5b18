//! Polynomials in several variables with integer coefficients, and their reduction by others.

use super::monomial::Monomial;
use crate::ring::Ring;
use rug::{Integer, Rational};
use std::collections::BTreeMap;

/// A polynomial with rational coefficients, by which a system is given; a ring, so that equations can be written down with
/// the formulas of kinematics.
#[derive(Clone, Debug, PartialEq)]
pub struct Equation {
    terms: BTreeMap<Monomial, Rational>,
}

impl Equation {
    /// Returns the variable of this number, below [`super::MOST_VARIABLES`].
    #[must_use]
    pub fn variable(k: usize) -> Self {
        Self { terms: BTreeMap::from([(Monomial::variable(k), Rational::from(1))]) }
    }

    /// Returns the value for these values of the unknowns.
    ///
    /// # Panics
    /// If an unknown has no value.
    #[must_use]
    pub fn evaluate<R: Ring>(&self, values: &[R]) -> R {
        let mut sum = R::zero();
        for (monomial, c) in &self.terms {
            let mut term = R::from_rational(c).expect("a ring that holds the rational numbers");
            for (k, value) in values.iter().enumerate() {
                for _ in 0..monomial.exponent(k) {
                    term = term.mul(value);
                }
            }
            sum = sum.add(&term);
        }
        sum
    }

    /// Returns one monomial.
    pub(super) fn monomial(monomial: Monomial) -> Self {
        Self { terms: BTreeMap::from([(monomial, Rational::from(1))]) }
    }

    /// Returns the terms.
    pub(super) fn terms(&self) -> &BTreeMap<Monomial, Rational> {
        &self.terms
    }

    fn sum(&self, other: &Self, sign: i32) -> Self {
        let mut terms = self.terms.clone();
        for (monomial, c) in &other.terms {
            *terms.entry(*monomial).or_default() += Rational::from(c * sign);
        }
        terms.retain(|_, c| *c != 0);
        Self { terms }
    }
}

impl Ring for Equation {
    fn zero() -> Self {
        Self { terms: BTreeMap::new() }
    }
    fn one() -> Self {
        Self { terms: BTreeMap::from([(Monomial::one(), Rational::from(1))]) }
    }
    fn add(&self, other: &Self) -> Self {
        self.sum(other, 1)
    }
    fn sub(&self, other: &Self) -> Self {
        self.sum(other, -1)
    }
    /// # Panics
    /// When the degree is above 127.
    fn mul(&self, other: &Self) -> Self {
        let mut terms: BTreeMap<Monomial, Rational> = BTreeMap::new();
        for (m, c) in &self.terms {
            for (n, d) in &other.terms {
                let product = m.times(*n).expect("the degree is at most 127");
                *terms.entry(product).or_default() += Rational::from(c * d);
            }
        }
        terms.retain(|_, c| *c != 0);
        Self { terms }
    }
    fn neg(&self) -> Self {
        Self::zero().sub(self)
    }
    fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        let terms = if *q == 0 { BTreeMap::new() } else { BTreeMap::from([(Monomial::one(), q.clone())]) };
        Some(Self { terms })
    }
}

/// Integer coefficients without common factor, the first one positive; the largest monomial first.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Polynomial {
    pub terms: Vec<(Monomial, Integer)>,
}

/// A polynomial being reduced to its normal form, with the largest monomial at hand.
pub(super) type Work = BTreeMap<Monomial, Integer>;

impl Polynomial {
    /// Returns the primitive multiple of an equation; `None` for zero.
    pub fn of(equation: &Equation) -> Option<Self> {
        let mut denominator = Integer::from(1);
        for c in equation.terms.values() {
            denominator.lcm_mut(c.denom());
        }
        let whole = |c: &Rational| Integer::from(denominator.div_exact_ref(c.denom())) * c.numer();
        Self::primitive(equation.terms.iter().map(|(m, c)| (*m, whole(c))).collect())
    }

    /// Returns the primitive multiple of a sum of terms; `None` for zero.
    pub fn primitive(work: Work) -> Option<Self> {
        let mut terms: Vec<(Monomial, Integer)> = work.into_iter().rev().filter(|(_, c)| *c != 0).collect();
        let mut content = terms.first()?.1.clone();
        for (_, c) in &terms[1..] {
            if content == 1 || content == -1 {
                break;
            }
            content.gcd_mut(c);
        }
        if content.is_negative() != terms[0].1.is_negative() {
            content = -content;
        }
        if content != 1 {
            for (_, c) in &mut terms {
                c.div_exact_mut(&content);
            }
        }
        Some(Self { terms })
    }

    /// Returns the largest monomial.
    pub fn leading(&self) -> Monomial {
        self.terms[0].0
    }

    /// Returns the coefficient of the largest monomial.
    pub fn coefficient(&self) -> &Integer {
        &self.terms[0].1
    }
}

/// Returns the cost of a product of two numbers, in words.
fn words(x: &Integer, y: &Integer) -> u64 {
    1 + u64::from(x.significant_bits() + y.significant_bits()) / 64
}

/// Computes `work -= factor monomial polynomial` without the leading term; `None` if a degree is too large.
fn subtract(work: &mut Work, factor: &Integer, monomial: Monomial, polynomial: &Polynomial) -> Option<()> {
    for (m, c) in &polynomial.terms[1..] {
        *work.entry(m.times(monomial)?).or_default() -= Integer::from(c * factor);
    }
    Some(())
}

/// Returns the remainder of a sum of terms by polynomials: no monomial of it is a multiple of a leading one. `scale` receives
/// the factor by which everything was multiplied. `None` if a degree is too large, or if this takes more products of words
/// than `effort` has; those used are subtracted from it.
pub(super) fn remainder(mut work: Work, by: &[&Polynomial], scale: &mut Integer, effort: &mut u64) -> Option<Work> {
    let mut rest = Work::new();
    while let Some((monomial, mut c)) = work.pop_last() {
        if c == 0 {
            continue;
        }
        let Some(divisor) = by.iter().find(|p| p.leading().divides(monomial)) else {
            rest.insert(monomial, c);
            continue;
        };
        let common = Integer::from(c.gcd_ref(divisor.coefficient()));
        c.div_exact_mut(&common);
        let factor = Integer::from(divisor.coefficient().div_exact_ref(&common));
        let terms = divisor.terms.len() + if factor == 1 { 0 } else { work.len() + rest.len() };
        *effort = effort.checked_sub(terms as u64 * words(&c, divisor.coefficient()))?;
        if factor != 1 {
            work.values_mut().chain(rest.values_mut()).for_each(|x| *x *= &factor);
            *scale *= &factor;
        }
        subtract(&mut work, &c, monomial.over(divisor.leading()), divisor)?;
    }
    Some(rest)
}
