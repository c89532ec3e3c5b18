//! Polynomials with rational coefficients, kept as integers over one common denominator.

use crate::int::Int;
use crate::polynomial::Polynomial;
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
    /// In lowest terms: no number but 1 divides the denominator and all coefficients of the numerator.
    #[must_use]
    pub fn reduced(self) -> Self {
        let one = Int::one();
        if self.denominator == one {
            return self;
        }
        let mut common = self.denominator.clone();
        for c in self.numerator.coefficients() {
            if common == one {
                return self;
            }
            common = common.gcd(c);
        }
        let numerator = self.numerator.map(|c| Some(c.div_exact(&common)));
        Self { numerator: numerator.unwrap_or_else(Polynomial::zero), denominator: self.denominator.div_exact(&common) }
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
