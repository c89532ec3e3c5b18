//! The rationals and the integers of rug as rings: the exact engine.

use super::ring::{Domain, Field, Ring};
use rug::{Integer, Rational, ops::NegAssign};
use std::cmp::Ordering;

impl Ring for Rational {
    fn zero() -> Self {
        Rational::new()
    }
    fn one() -> Self {
        Rational::from(1)
    }
    // Zeros are frequent, and GMP would take greatest common divisors for them too.
    fn add(&self, other: &Self) -> Self {
        if other.is_zero() { self.clone() } else { Rational::from(self + other) }
    }
    fn sub(&self, other: &Self) -> Self {
        if other.is_zero() { self.clone() } else { Rational::from(self - other) }
    }
    fn mul(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() { Rational::new() } else { Rational::from(self * other) }
    }
    fn neg(&self) -> Self {
        let mut x = self.clone();
        x.neg_assign();
        x
    }
    fn is_zero(&self) -> bool {
        self.cmp0() == Ordering::Equal
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Some(q.clone())
    }
    fn from_integer(n: i32) -> Self {
        Rational::from(n)
    }
}

impl Domain for Rational {
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        (!other.is_zero()).then(|| Rational::from(self / other))
    }
}

impl Field for Rational {
    fn inverse(&self) -> Option<Self> {
        (!self.is_zero()).then(|| self.clone().recip())
    }
    fn pivot_size(&self) -> f64 {
        if self.is_zero() { 0.0 } else { 1.0 }
    }
    const PIVOT_ZERO: f64 = 0.0;

    fn normalise(coefficients: &mut [Self]) {
        let mut scale = primitive_scale(coefficients);
        if coefficients.last().is_some_and(|c| c.cmp0() == Ordering::Less) {
            scale.neg_assign();
        }
        for c in coefficients {
            *c *= &scale;
        }
    }
}

/// Returns the positive number that turns these, not all zero, into integers without common factor; 1 if all are zero.
pub(super) fn primitive_scale(numbers: &[Rational]) -> Rational {
    let (mut content, mut denominator) = (Integer::new(), Integer::from(1));
    for q in numbers {
        content.gcd_mut(q.numer());
        denominator.lcm_mut(q.denom());
    }
    // In lowest terms, the integers q * lcm(denominators) have the gcd of the numerators as their own.
    if content == 0 { Rational::from(1) } else { Rational::from((denominator, content)) }
}

impl Ring for Integer {
    fn zero() -> Self {
        Integer::new()
    }
    fn one() -> Self {
        Integer::from(1)
    }
    fn add(&self, other: &Self) -> Self {
        Integer::from(self + other)
    }
    fn sub(&self, other: &Self) -> Self {
        Integer::from(self - other)
    }
    fn mul(&self, other: &Self) -> Self {
        Integer::from(self * other)
    }
    fn neg(&self) -> Self {
        Integer::from(-self)
    }
    fn is_zero(&self) -> bool {
        self.cmp0() == Ordering::Equal
    }
    fn add_product(&mut self, a: &Self, b: &Self) {
        *self += a * b;
    }
    fn to_wide(&self) -> Option<i128> {
        self.to_i128()
    }
    fn from_wide(n: i128) -> Self {
        Integer::from(n)
    }
    /// Only integers have an image.
    fn from_rational(q: &Rational) -> Option<Self> {
        q.is_integer().then(|| q.numer().clone())
    }
    fn from_integer(n: i32) -> Self {
        Integer::from(n)
    }
}

impl Domain for Integer {
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        (!other.is_zero() && self.is_divisible(other)).then(|| self.div_exact(other))
    }
    fn div_exact(&self, other: &Self) -> Self {
        Integer::from(self.div_exact_ref(other))
    }
}
