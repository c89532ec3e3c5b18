//! Polynomials in unknown rotations and their inverses, with exact complex coefficients.

use super::state::Half;
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::Gaussian;
use num_complex::Complex;
use rug::Rational;
use std::collections::BTreeMap;

/// A sum of products of powers of unknowns, negative powers among them. Trailing zeros of exponents are left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Laurent(BTreeMap<Vec<i32>, Gaussian>);

/// The conjugate.
#[must_use]
pub fn conjugate(z: &Gaussian) -> Gaussian {
    Complex { re: z.re.clone(), im: Rational::from(-&z.im) }
}

/// The exponents without trailing zeros.
fn trimmed(mut exponents: Vec<i32>) -> Vec<i32> {
    while exponents.last() == Some(&0) {
        exponents.pop();
    }
    exponents
}

impl Laurent {
    /// The power of an unknown.
    #[must_use]
    pub fn power(variable: usize, exponent: i32) -> Self {
        let mut exponents = vec![0; variable + 1];
        exponents[variable] = exponent;
        Self(BTreeMap::from([(trimmed(exponents), Complex::one())]))
    }

    /// The terms: exponents and coefficients.
    pub fn terms(&self) -> impl Iterator<Item = (&[i32], &Gaussian)> {
        self.0.iter().map(|(exponents, c)| (exponents.as_slice(), c))
    }

    /// Returns the inverse of a single term; `None` for sums.
    #[must_use]
    pub fn inverse(&self) -> Option<Self> {
        let mut terms = self.terms();
        let (exponents, c) = terms.next()?;
        if terms.next().is_some() {
            return None;
        }
        let norm = Rational::from(&c.re * &c.re) + Rational::from(&c.im * &c.im);
        let inverse = Complex { re: Rational::from(&c.re / &norm), im: -Rational::from(&c.im / &norm) };
        Some(Self(BTreeMap::from([(exponents.iter().map(|e| -e).collect(), inverse)])))
    }

    /// Returns the product with an exact complex number.
    #[must_use]
    pub fn scale(&self, factor: &Gaussian) -> Self {
        self.mul(&Self::exactly(factor))
    }

    /// Returns the value for unknowns of absolute value 1 or real ones, and the sum of the absolute values of all terms.
    #[must_use]
    pub fn value(&self, unknowns: &[Complex<f64>]) -> (Complex<f64>, f64) {
        let mut sum = (Complex::new(0.0, 0.0), 0.0);
        for (exponents, c) in self.terms() {
            let powers = exponents.iter().zip(unknowns).map(|(e, x)| x.powi(*e));
            let term = powers.fold(Complex::new(c.re.to_f64(), c.im.to_f64()), |product, x| product * x);
            sum = (sum.0 + term, sum.1 + term.norm());
        }
        sum
    }
}

impl Half for Laurent {
    fn exactly(z: &Gaussian) -> Self {
        if z.is_zero() { Self::zero() } else { Self(BTreeMap::from([(Vec::new(), z.clone())])) }
    }
}

impl Ring for Laurent {
    fn zero() -> Self {
        Self(BTreeMap::new())
    }
    fn one() -> Self {
        Self::exactly(&Complex::one())
    }
    fn add(&self, other: &Self) -> Self {
        let mut sum = self.0.clone();
        for (exponents, c) in &other.0 {
            let own = sum.entry(exponents.clone()).or_insert_with(Complex::zero);
            *own = Ring::add(own, c);
        }
        sum.retain(|_, c| !c.is_zero());
        Self(sum)
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    fn mul(&self, other: &Self) -> Self {
        let mut product: BTreeMap<Vec<i32>, Gaussian> = BTreeMap::new();
        for (one, c) in &self.0 {
            for (two, d) in &other.0 {
                let at = |list: &[i32], k: usize| list.get(k).copied().unwrap_or(0);
                let exponents = (0..one.len().max(two.len())).map(|k| at(one, k) + at(two, k)).collect();
                let own = product.entry(trimmed(exponents)).or_insert_with(Complex::zero);
                *own = Ring::add(own, &Ring::mul(c, d));
            }
        }
        product.retain(|_, c| !c.is_zero());
        Self(product)
    }
    fn neg(&self) -> Self {
        Self(self.0.iter().map(|(exponents, c)| (exponents.clone(), Ring::neg(c))).collect())
    }
    fn is_zero(&self) -> bool {
        self.0.is_empty()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Some(Self::exactly(&Complex { re: q.clone(), im: Rational::new() }))
    }
}
