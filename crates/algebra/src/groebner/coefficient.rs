//! What Buchberger's algorithm asks of the coefficients of polynomials.

use super::monomial::Monomial;
use crate::drawn::Drawn;
use crate::ring::{Field, Ring};
use rug::{Integer, Rational};
use std::collections::BTreeMap;
use std::fmt::Debug;

/// Coefficients: integers without common factor, or residues of which the first is 1.
pub trait Coefficient: Clone + Debug + PartialEq {
    /// Returns the number 0.
    fn nothing() -> Self;

    /// Returns the number 1.
    fn unit() -> Self;

    /// Returns whether this is 0.
    fn is_nothing(&self) -> bool;

    /// Returns whether this is 1.
    fn is_unit(&self) -> bool;

    /// Returns two numbers of the ratio of these, the second of which is not 0.
    fn ratio(&self, other: &Self) -> (Self, Self);

    /// Computes `self -= a b`.
    fn subtract_product(&mut self, a: &Self, b: &Self);

    /// Computes `self *= a`.
    fn scale(&mut self, a: &Self);

    /// Returns the cost of a product, in products of words.
    fn words(&self, other: &Self) -> u64;

    /// Divides terms, the largest monomial first, by a number that makes them what polynomials have.
    fn normalise(terms: &mut [(Monomial, Self)]);

    /// Returns terms that are a multiple of these; `None` if a denominator has no inverse.
    fn terms(of: &BTreeMap<Monomial, Rational>) -> Option<BTreeMap<Monomial, Self>>;
}

impl Coefficient for Integer {
    fn nothing() -> Self {
        Self::new()
    }
    fn unit() -> Self {
        Self::from(1)
    }
    fn is_nothing(&self) -> bool {
        *self == 0
    }
    fn is_unit(&self) -> bool {
        *self == 1
    }
    fn ratio(&self, other: &Self) -> (Self, Self) {
        let common = Self::from(self.gcd_ref(other));
        (Self::from(self.div_exact_ref(&common)), Self::from(other.div_exact_ref(&common)))
    }
    fn subtract_product(&mut self, a: &Self, b: &Self) {
        *self -= Self::from(a * b);
    }
    fn scale(&mut self, a: &Self) {
        *self *= a;
    }
    fn words(&self, other: &Self) -> u64 {
        1 + u64::from(self.significant_bits() + other.significant_bits()) / 64
    }
    fn normalise(terms: &mut [(Monomial, Self)]) {
        let Some((first, rest)) = terms.split_first() else { return };
        let mut content = first.1.clone();
        for (_, c) in rest {
            if content == 1 || content == -1 {
                break;
            }
            content.gcd_mut(c);
        }
        if content.is_negative() != first.1.is_negative() {
            content = -content;
        }
        if content != 1 {
            for (_, c) in terms {
                c.div_exact_mut(&content);
            }
        }
    }
    fn terms(of: &BTreeMap<Monomial, Rational>) -> Option<BTreeMap<Monomial, Self>> {
        let mut denominator = Self::from(1);
        for c in of.values() {
            denominator.lcm_mut(c.denom());
        }
        let whole = |c: &Rational| Self::from(denominator.div_exact_ref(c.denom())) * c.numer();
        Some(of.iter().map(|(m, c)| (*m, whole(c))).collect())
    }
}

/// Residues modulo the prime of this run.
impl Coefficient for Drawn {
    fn nothing() -> Self {
        Self::zero()
    }
    fn unit() -> Self {
        Self::one()
    }
    fn is_nothing(&self) -> bool {
        self.is_zero()
    }
    fn is_unit(&self) -> bool {
        *self == Self::one()
    }
    fn ratio(&self, other: &Self) -> (Self, Self) {
        (other.inverse().map_or_else(Self::zero, |inverse| self.mul(&inverse)), Self::one())
    }
    fn subtract_product(&mut self, a: &Self, b: &Self) {
        *self = self.sub(&a.mul(b));
    }
    fn scale(&mut self, a: &Self) {
        *self = self.mul(a);
    }
    fn words(&self, _: &Self) -> u64 {
        1
    }
    fn normalise(terms: &mut [(Monomial, Self)]) {
        let Some(inverse) = terms.first().and_then(|(_, c)| c.inverse()) else { return };
        for (_, c) in terms {
            *c = c.mul(&inverse);
        }
    }
    fn terms(of: &BTreeMap<Monomial, Rational>) -> Option<BTreeMap<Monomial, Self>> {
        of.iter().map(|(m, c)| Some((*m, Self::from_rational(c)?))).collect()
    }
}
