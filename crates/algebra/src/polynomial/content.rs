//! Contents and primitive parts, of integers and of polynomials.

use super::Polynomial;
use crate::int::Int;
use crate::ring::{Domain, Ring};
use rug::{Integer, Rational};
use std::cmp::Ordering;

/// Coefficients that are looked at before a sum of multiples of all; and the fewest of them for that.
const FIRST: usize = 2;
const FEW: usize = 8;
/// The first state of the generator of factors: that of the golden ratio.
const SEED: u64 = 0x9e37_79b9_7f4a_7c15;

/// Returns the greatest common divisor of a number, not negative, and coefficients.
///
/// It divides every sum of multiples of them. Where it is long after a few of them, which are multiples of parts of a common denominator, one such
/// sum mostly shows that it is short, and the coefficients would give up their common factors one after the other.
pub(crate) fn common_factor(number: &Int, coefficients: &[Int]) -> Int {
    let (one, mut common) = (Int::one(), number.clone());
    for (k, c) in coefficients.iter().enumerate() {
        if common == one {
            break;
        }
        if k == FIRST && coefficients.len() >= FEW && common.to_i64().is_none() {
            common = common.gcd(&sum_of_multiples(coefficients));
        }
        common = common.gcd(c);
    }
    common
}

/// Returns a sum of multiples of numbers, by factors without a pattern.
fn sum_of_multiples(numbers: &[Int]) -> Int {
    let (mut sum, mut state) = (Int::zero(), SEED);
    for n in numbers {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        sum.add_product(n, &Int::from((state >> 1).cast_signed()));
    }
    sum
}

impl Polynomial<Int> {
    /// Returns the greatest common divisor of the coefficients, never negative; zero only of the zero polynomial.
    #[must_use]
    pub fn content(&self) -> Int {
        self.coefficients.split_first().map_or_else(Int::zero, |(first, others)| common_factor(&first.abs(), others))
    }

    /// Returns the polynomial divided by its content, its leading coefficient positive.
    #[must_use]
    pub fn primitive_part(&self) -> Self {
        let Some(leading) = self.coefficients.first() else { return Self::zero() };
        let content = self.content();
        let divisor = if leading.sign() == Ordering::Less { content.neg() } else { content };
        if divisor == Int::one() {
            return self.clone();
        }
        let coefficients = self.coefficients.iter().map(|c| c.div_exact(&divisor)).collect();
        Self { packing: self.packing, monomials: self.monomials.clone(), coefficients }
    }

    /// Returns the greatest common divisor of the coefficients of the powers of a variable, leading coefficient positive.
    #[must_use]
    pub fn content_in(&self, variable: usize) -> Self {
        let mut parts = self.coefficients_in(variable);
        parts.retain(|part| !part.is_zero());
        parts.sort_unstable_by_key(Self::len);
        let mut content = Self::zero();
        for part in &parts {
            content = content.gcd(part);
            if content.len() == 1 && content == Self::one() {
                break;
            }
        }
        content
    }

    /// Returns the largest monomial that divides all terms, as a polynomial; 1 for the zero polynomial.
    pub(super) fn monomial_content(&self) -> Self {
        // From the last term on, which as a rule is free of the variable already.
        let lowest = |variable| {
            let mut lowest = u32::MAX;
            for i in (0..self.len()).rev() {
                lowest = lowest.min(self.exponent(i, variable));
                if lowest == 0 {
                    break;
                }
            }
            if self.is_zero() { 0 } else { lowest }
        };
        Self::from_terms([((0..self.variables()).map(lowest).collect(), Int::one())])
    }
}

impl Polynomial<Rational> {
    /// Returns the primitive polynomial with integer coefficients, its leading coefficient positive, and the factor by which this
    /// one is a multiple of it; zero and 1 for the zero polynomial.
    ///
    /// # Panics
    /// Never: multiples by a common denominator are integers.
    #[must_use]
    pub fn primitive(&self) -> (Polynomial<Int>, Rational) {
        let (mut content, mut denominator) = (Integer::new(), Integer::from(1));
        for q in &self.coefficients {
            content.gcd_mut(q.numer());
            denominator.lcm_mut(q.denom());
        }
        let Some(leading) = self.coefficients.first() else { return (Polynomial::zero(), Rational::from(1)) };
        if leading.cmp0() == Ordering::Less {
            content = -content;
        }
        // In lowest terms, the integers q * lcm(denominators) have the gcd of the numerators as their own.
        let integer = |q: &Rational| {
            let numerator = Integer::from(q.numer().div_exact_ref(&content));
            Some(Int::from(numerator * Integer::from(denominator.div_exact_ref(q.denom()))))
        };
        let primitive = self.map(integer).expect("every coefficient has an image");
        (primitive, Rational::from((content, denominator)))
    }

    /// Returns the greatest common divisor, primitive over the integers with positive leading coefficient; zero only of two zeros.
    #[must_use]
    pub fn gcd(&self, other: &Self) -> Polynomial<Int> {
        self.primitive().0.gcd(&other.primitive().0)
    }
}
