//! Polynomials in several variables with integer coefficients, and their reduction by others.

use super::coefficient::Coefficient;
use super::monomial::Monomial;
use crate::ring::Ring;
use rug::Rational;
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

    /// Returns the total degree; 0 of the polynomial 0.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.terms.keys().map(|monomial| monomial.degree()).max().unwrap_or(0)
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

/// A polynomial that is not 0, up to a factor: the largest monomial first.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Polynomial<C> {
    pub terms: Vec<(Monomial, C)>,
}

/// A polynomial being reduced to its normal form, with the largest monomial at hand.
pub(super) type Work<C> = BTreeMap<Monomial, C>;

impl<C: Coefficient> Polynomial<C> {
    /// Returns the normalised multiple of a sum of terms; `None` for zero.
    pub fn normalised(work: Work<C>) -> Option<Self> {
        let mut terms: Vec<(Monomial, C)> = work.into_iter().rev().filter(|(_, c)| !c.is_nothing()).collect();
        C::normalise(&mut terms);
        (!terms.is_empty()).then_some(Self { terms })
    }

    /// Returns the largest monomial.
    pub fn leading(&self) -> Monomial {
        self.terms[0].0
    }

    /// Returns the coefficient of the largest monomial.
    pub fn coefficient(&self) -> &C {
        &self.terms[0].1
    }
}

/// Computes `work -= factor monomial polynomial` without the leading term; `None` if a degree is too large.
pub(super) fn subtract<C: Coefficient>(
    work: &mut Work<C>,
    factor: &C,
    monomial: Monomial,
    polynomial: &Polynomial<C>,
) -> Option<()> {
    for (m, c) in &polynomial.terms[1..] {
        work.entry(m.times(monomial)?).or_insert_with(C::nothing).subtract_product(c, factor);
    }
    Some(())
}

/// Returns the remainder of a sum of terms by polynomials: no monomial of it is a multiple of a leading one. `scale` receives
/// the factor by which everything was multiplied. `None` if a degree is too large, or if this takes more products of words
/// than `effort` has; those used are subtracted from it.
pub(super) fn remainder<C: Coefficient>(
    mut work: Work<C>,
    by: &[&Polynomial<C>],
    scale: &mut C,
    effort: &mut u64,
) -> Option<Work<C>> {
    let mut rest = Work::new();
    while let Some((monomial, c)) = work.pop_last() {
        if c.is_nothing() {
            continue;
        }
        let Some(divisor) = by.iter().find(|p| p.leading().divides(monomial)) else {
            rest.insert(monomial, c);
            continue;
        };
        let (c, factor) = c.ratio(divisor.coefficient());
        let terms = divisor.terms.len() + if factor.is_unit() { 0 } else { work.len() + rest.len() };
        *effort = effort.checked_sub(terms as u64 * c.words(divisor.coefficient()))?;
        if !factor.is_unit() {
            work.values_mut().chain(rest.values_mut()).for_each(|x| x.scale(&factor));
            scale.scale(&factor);
        }
        subtract(&mut work, &c, monomial.over(divisor.leading()), divisor)?;
    }
    Some(rest)
}
