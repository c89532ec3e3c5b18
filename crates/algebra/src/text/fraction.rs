//! Polynomials with rational coefficients, kept as integers over one common denominator.

use crate::int::Int;
use crate::polynomial::{Polynomial, common_factor};
use crate::ring::{Domain, Ring};
use rug::{Integer, Rational};

/// `numerator / denominator`: the form of texts with rational numbers once read, and the input of integer algorithms.
#[derive(Clone, Debug, PartialEq)]
pub struct Fraction {
    /// The polynomial times the denominator.
    pub numerator: Polynomial<Int>,
    /// The denominator, which is positive.
    pub denominator: Int,
}

impl Fraction {
    /// Returns the same polynomial in lowest terms: no number but 1 divides the denominator and all coefficients of the numerator.
    #[must_use]
    pub fn reduced(self) -> Self {
        let common = common_factor(&self.denominator, self.numerator.coefficients());
        self.divided(&common)
    }

    /// Returns the product; it is in lowest terms.
    ///
    /// The content of a product is the product of the contents (Gauss), so that the coefficients of the factors, which are fewer and shorter, tell
    /// what can be cancelled.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        let numerator = self.numerator.mul(&other.numerator);
        let denominator = self.denominator.mul(&other.denominator);
        let [own, others] = [self, other].map(|f| common_factor(&denominator, f.numerator.coefficients()));
        let common = own.mul(&others).gcd(&denominator);
        Self { numerator, denominator }.divided(&common)
    }

    /// Divides both by a number that divides them.
    fn divided(self, common: &Int) -> Self {
        if *common == Int::one() {
            return self;
        }
        let numerator = self.numerator.map(|c| Some(c.div_exact(common)));
        Self { numerator: numerator.unwrap_or_else(Polynomial::zero), denominator: self.denominator.div_exact(common) }
    }

    /// Returns the polynomial itself.
    #[must_use]
    pub fn to_rational(&self) -> Polynomial<Rational> {
        let denominator = self.denominator.to_integer();
        let image = |c: &Int| Some(Rational::from((c.to_integer(), denominator.clone())));
        self.numerator.map(image).unwrap_or_else(Polynomial::zero)
    }

    /// Returns the polynomial over its common denominator, in lowest terms.
    #[must_use]
    pub fn from_rational(polynomial: &Polynomial<Rational>) -> Self {
        let mut denominator = Integer::from(1);
        for c in polynomial.coefficients() {
            denominator.lcm_mut(c.denom());
        }
        let image = |c: &Rational| Some(Int::from(Integer::from(denominator.div_exact_ref(c.denom())) * c.numer()));
        let numerator = polynomial.map(image).unwrap_or_else(Polynomial::zero);
        Self { numerator, denominator: Int::from(denominator) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn fraction() -> impl Strategy<Value = Fraction> {
        let term = (prop::collection::vec(0..5_u32, 2), -60..60_i64);
        (prop::collection::vec(term, 1..14), 1..5_i64, 1..1000_i64, 0..90_u32).prop_map(|(terms, factor, d, bits)| {
            let factor = Int::from(factor);
            let terms = terms.into_iter().map(|(exponents, c)| (exponents, Int::from(c).mul(&factor)));
            Fraction { numerator: Polynomial::from_terms(terms), denominator: Int::from(Integer::from(d) << bits) }
        })
    }

    proptest! {
        #[test]
        fn products_and_fractions_in_lowest_terms_are_those_of_rational_numbers((f, g) in (fraction(), fraction())) {
            prop_assume!(!f.numerator.is_zero() && !g.numerator.is_zero());
            for (found, expected) in [
                (f.times(&g), f.to_rational().mul(&g.to_rational())),
                (f.clone().reduced(), f.to_rational()),
            ] {
                prop_assert_eq!(found, Fraction::from_rational(&expected));
            }
        }
    }
}
