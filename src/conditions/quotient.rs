//! Rational functions in lowest terms, the field over which an ansatz with symbols is a single mechanism.

use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Field, Ring};
use rug::Rational;
use std::cmp::Ordering;

/// A quotient of polynomials with integer coefficients, in lowest terms, its denominator with positive leading coefficient.
#[derive(Clone, Debug, PartialEq)]
pub struct Quotient {
    numerator: Polynomial<Int>,
    denominator: Polynomial<Int>,
}

impl Quotient {
    /// Returns a variable.
    #[must_use]
    pub fn variable(variable: usize) -> Self {
        Self::from(Polynomial::variable(variable))
    }

    /// Returns the numerator.
    #[must_use]
    pub const fn numerator(&self) -> &Polynomial<Int> {
        &self.numerator
    }

    /// Returns the denominator.
    #[must_use]
    pub const fn denominator(&self) -> &Polynomial<Int> {
        &self.denominator
    }

    /// Reduces a quotient to lowest terms.
    fn reduced(numerator: Polynomial<Int>, denominator: Polynomial<Int>) -> Self {
        if numerator.is_zero() {
            return Self::zero();
        }
        if denominator == Polynomial::one() {
            return Self { numerator, denominator };
        }
        let common = numerator.gcd(&denominator);
        let (mut numerator, mut denominator) = (numerator.div_exact(&common), denominator.div_exact(&common));
        if denominator.coefficients().first().is_some_and(|c| c.sign() == Ordering::Less) {
            (numerator, denominator) = (numerator.neg(), denominator.neg());
        }
        Self { numerator, denominator }
    }
}

impl From<Polynomial<Int>> for Quotient {
    fn from(numerator: Polynomial<Int>) -> Self {
        Self { numerator, denominator: Polynomial::one() }
    }
}

impl Ring for Quotient {
    fn zero() -> Self {
        Self::from(Polynomial::zero())
    }
    fn one() -> Self {
        Self::from(Polynomial::one())
    }
    fn add(&self, other: &Self) -> Self {
        if self.denominator == other.denominator {
            return Self::reduced(self.numerator.add(&other.numerator), self.denominator.clone());
        }
        let numerator = self.numerator.mul(&other.denominator).add(&other.numerator.mul(&self.denominator));
        Self::reduced(numerator, self.denominator.mul(&other.denominator))
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    fn mul(&self, other: &Self) -> Self {
        Self::reduced(self.numerator.mul(&other.numerator), self.denominator.mul(&other.denominator))
    }
    fn neg(&self) -> Self {
        Self { numerator: self.numerator.neg(), denominator: self.denominator.clone() }
    }
    fn is_zero(&self) -> bool {
        self.numerator.is_zero()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        let constant = |n: &rug::Integer| Polynomial::constant(Int::from(n.clone()));
        Some(Self { numerator: constant(q.numer()), denominator: constant(q.denom()) })
    }
}

impl Domain for Quotient {
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        Some(self.mul(&other.inverse()?))
    }
}

impl Field for Quotient {
    fn inverse(&self) -> Option<Self> {
        (!self.is_zero()).then(|| Self::reduced(self.denominator.clone(), self.numerator.clone()))
    }
    fn pivot_size(&self) -> f64 {
        if self.is_zero() { 0.0 } else { 1.0 }
    }
    const PIVOT_ZERO: f64 = 0.0;
}
