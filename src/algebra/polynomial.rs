//! Sparse polynomials in any number of variables over any ring, themselves a ring.

use super::monomial::Packing;
use super::ring::{Domain, Ring};
use super::univariate::Univariate;
use rug::Rational;
use std::collections::BTreeMap;

/// A polynomial in the variables 0, 1, 2, ..., whose names are kept elsewhere.
///
/// Sums and products of polynomials in different numbers of variables need no preparation: a variable that a polynomial
/// does not have has exponent 0 there.
///
/// # Example
/// ```
/// use looproot::algebra::{int::Int, polynomial::Polynomial, ring::{Domain, Ring}};
///
/// let (x, y) = (Polynomial::<Int>::variable(0), Polynomial::variable(1));
/// let product = x.add(&y).mul(&x.sub(&y));
/// assert_eq!(product, x.pow(2).sub(&y.pow(2)));
/// assert_eq!(product.div_exact(&x.add(&y)), x.sub(&y));
/// ```
#[derive(Clone, Debug)]
pub struct Polynomial<R> {
    packing: Packing,
    /// The monomials, decreasing lexicographically, `packing.words()` words each.
    monomials: Vec<u64>,
    /// Their coefficients, none zero.
    coefficients: Vec<R>,
}

impl<R: Ring> Polynomial<R> {
    /// A constant.
    #[must_use]
    pub fn constant(c: R) -> Self {
        Self::from_terms([(Vec::new(), c)])
    }

    /// A variable.
    #[must_use]
    pub fn variable(variable: usize) -> Self {
        let mut exponents = vec![0; variable + 1];
        exponents[variable] = 1;
        Self::from_terms([(exponents, R::one())])
    }

    /// The sum of terms in any order, each given by the exponents of the first variables and its coefficient.
    ///
    /// # Panics
    /// When an exponent is above [`super::monomial::LARGEST_EXPONENT`].
    #[must_use]
    pub fn from_terms(terms: impl IntoIterator<Item = (Vec<u32>, R)>) -> Self {
        let mut sum: BTreeMap<Vec<u32>, R> = BTreeMap::new();
        for (mut exponents, c) in terms {
            while exponents.last() == Some(&0) {
                exponents.pop();
            }
            sum.entry(exponents).and_modify(|s| *s = s.add(&c)).or_insert(c);
        }
        sum.retain(|_, c| !c.is_zero());
        let variables = sum.keys().map(Vec::len).max().unwrap_or(0);
        let largest = sum.keys().flatten().copied().max().unwrap_or(0);
        let packing = Packing::new(variables, largest);
        let (mut monomials, mut coefficients) = (Vec::new(), Vec::new());
        for (exponents, c) in sum.into_iter().rev() {
            packing.push(&exponents, &mut monomials);
            coefficients.push(c);
        }
        Self { packing, monomials, coefficients }
    }

    /// The terms, the lexicographically highest first: the exponents of all [`Self::variables`], and the coefficient.
    pub fn terms(&self) -> impl ExactSizeIterator<Item = (Vec<u32>, &R)> + DoubleEndedIterator {
        (0..self.len()).map(|i| (self.packing.unpack(self.monomial(i)), &self.coefficients[i]))
    }

    fn monomial(&self, i: usize) -> &[u64] {
        let words = self.packing.words();
        &self.monomials[i * words..(i + 1) * words]
    }

    /// The exponent of a variable in the term with the given number.
    ///
    /// # Panics
    /// When there is no such term.
    #[must_use]
    pub fn exponent(&self, term: usize, variable: usize) -> u32 {
        self.packing.exponent(self.monomial(term), variable)
    }

    /// The coefficients, in the order of the terms.
    #[must_use]
    pub fn coefficients(&self) -> &[R] {
        &self.coefficients
    }

    /// The number of terms.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a polynomial without terms is zero")]
    pub fn len(&self) -> usize {
        self.coefficients.len()
    }

    /// One more than the highest variable that may occur.
    #[must_use]
    pub const fn variables(&self) -> usize {
        self.packing.variables()
    }

    /// The degree in one variable; 0 for the zero polynomial.
    #[must_use]
    pub fn degree(&self, variable: usize) -> u32 {
        (0..self.len()).map(|i| self.exponent(i, variable)).max().unwrap_or(0)
    }

    /// The degrees in all [`Self::variables`].
    #[must_use]
    pub fn degrees(&self) -> Vec<u32> {
        (0..self.variables()).map(|variable| self.degree(variable)).collect()
    }

    /// The total degree; `None` for the zero polynomial.
    #[must_use]
    pub fn total_degree(&self) -> Option<u64> {
        self.terms().map(|(exponents, _)| exponents.iter().copied().map(u64::from).sum()).max()
    }

    /// The number, if no variable occurs; `Some(zero)` for the zero polynomial.
    #[must_use]
    pub fn to_constant(&self) -> Option<R> {
        match self.coefficients.as_slice() {
            [] => Some(R::zero()),
            [c] if self.monomials.iter().all(|&word| word == 0) => Some(c.clone()),
            _ => None,
        }
    }

    /// The product with a number.
    #[must_use]
    pub fn scale(&self, factor: &R) -> Self {
        Self::from_terms(self.terms().map(|(exponents, c)| (exponents, c.mul(factor))))
    }

    /// The power, by repeated squaring.
    #[must_use]
    pub fn pow(&self, exponent: u32) -> Self {
        let (mut result, mut power, mut rest) = (Self::one(), self.clone(), exponent);
        while rest > 0 {
            if rest & 1 == 1 {
                result = result.mul(&power);
            }
            rest >>= 1;
            if rest > 0 {
                power = power.mul(&power);
            }
        }
        result
    }

    /// The derivative with respect to a variable.
    ///
    /// # Panics
    /// Never: exponents fit an i32.
    #[must_use]
    pub fn derivative(&self, variable: usize) -> Self {
        let term = |(mut exponents, c): (Vec<u32>, &R)| {
            let exponent = exponents.get(variable).copied().filter(|&e| e > 0)?;
            exponents[variable] -= 1;
            let factor = R::from_integer(i32::try_from(exponent).expect("exponents fit an i32"));
            Some((exponents, c.mul(&factor)))
        };
        Self::from_terms(self.terms().filter_map(term))
    }

    /// The polynomial over another ring; `None` as soon as one coefficient has no image.
    pub fn map<S: Ring>(&self, image: impl Fn(&R) -> Option<S>) -> Option<Polynomial<S>> {
        let terms = self.terms().map(|(exponents, c)| Some((exponents, image(c)?)));
        Some(Polynomial::from_terms(terms.collect::<Option<Vec<_>>>()?))
    }

    /// The value where each variable has the given one; variables beyond them are 0.
    #[must_use]
    pub fn evaluate(&self, values: &[R]) -> R {
        let mut sum = R::zero();
        for (exponents, c) in self.terms() {
            let mut product = c.clone();
            for (variable, &exponent) in exponents.iter().enumerate() {
                for _ in 0..exponent {
                    product = product.mul(values.get(variable).unwrap_or(&R::zero()));
                }
            }
            sum = sum.add(&product);
        }
        sum
    }

    /// The polynomial with a variable replaced by another polynomial (a number: by a constant one).
    #[must_use]
    pub fn substitute(&self, variable: usize, replacement: &Self) -> Self {
        let parts = self.coefficients_in(variable);
        parts.iter().rev().fold(Self::zero(), |sum, part| sum.mul(replacement).add(part))
    }

    /// The coefficients of the powers of a variable, lowest first, free of that variable; none for zero.
    #[must_use]
    pub fn coefficients_in(&self, variable: usize) -> Vec<Self> {
        if self.is_zero() {
            return Vec::new();
        }
        let mut parts = vec![Vec::new(); self.degree(variable) as usize + 1];
        for (mut exponents, c) in self.terms() {
            let power = exponents.get_mut(variable).map_or(0, std::mem::take);
            parts[power as usize].push((exponents, c.clone()));
        }
        parts.into_iter().map(Self::from_terms).collect()
    }

    /// The sum of `coefficients[k] x^k` for the variable x, lowest first.
    #[must_use]
    pub fn from_coefficients_in(variable: usize, coefficients: &[Self]) -> Self {
        let x = Self::variable(variable);
        coefficients.iter().rev().fold(Self::zero(), |sum, part| sum.mul(&x).add(part))
    }

    /// The polynomial in one variable; `None` if another one occurs.
    #[must_use]
    pub fn to_univariate(&self, variable: usize) -> Option<Univariate<R>> {
        let parts = self.coefficients_in(variable);
        parts.iter().map(Self::to_constant).collect::<Option<_>>().map(Univariate::new)
    }

    /// The polynomial in several variables that one in one variable is.
    #[must_use]
    pub fn from_univariate(variable: usize, polynomial: &Univariate<R>) -> Self {
        let term = |(k, c): (usize, &R)| {
            let mut exponents = vec![0; variable + 1];
            exponents[variable] = u32::try_from(k).expect("the degree fits a u32");
            (exponents, c.clone())
        };
        Self::from_terms(polynomial.coefficients().iter().enumerate().map(term))
    }
}

impl<R: Ring> PartialEq for Polynomial<R> {
    fn eq(&self, other: &Self) -> bool {
        let trimmed = |(mut exponents, c): (Vec<u32>, _)| {
            while exponents.last() == Some(&0) {
                exponents.pop();
            }
            (exponents, c)
        };
        self.coefficients == other.coefficients && self.terms().map(trimmed).eq(other.terms().map(trimmed))
    }
}

impl<R: Ring> Ring for Polynomial<R> {
    fn zero() -> Self {
        Self::from_terms([])
    }
    fn one() -> Self {
        Self::constant(R::one())
    }
    fn add(&self, other: &Self) -> Self {
        Self::from_terms(self.terms().chain(other.terms()).map(|(exponents, c)| (exponents, c.clone())))
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    fn mul(&self, other: &Self) -> Self {
        let mut terms = Vec::with_capacity(self.len() * other.len());
        for (a, c) in self.terms() {
            for (b, d) in other.terms() {
                let exponent = |i| a.get(i).unwrap_or(&0) + b.get(i).unwrap_or(&0);
                terms.push(((0..a.len().max(b.len())).map(exponent).collect(), c.mul(d)));
            }
        }
        Self::from_terms(terms)
    }
    fn neg(&self) -> Self {
        let coefficients = self.coefficients.iter().map(Ring::neg).collect();
        Self { packing: self.packing, monomials: self.monomials.clone(), coefficients }
    }
    fn is_zero(&self) -> bool {
        self.coefficients.is_empty()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        R::from_rational(q).map(Self::constant)
    }
}

impl<D: Domain> Polynomial<D> {
    fn quotient(&self, divisor: &Self) -> Option<Self> {
        let variables = self.variables().max(divisor.variables());
        let padded = |(mut exponents, c): (Vec<u32>, &D)| {
            exponents.resize(variables, 0);
            (exponents, c.clone())
        };
        let mut rest: BTreeMap<Vec<u32>, D> = self.terms().map(padded).collect();
        let divisor: Vec<(Vec<u32>, D)> = divisor.terms().map(padded).collect();
        let (leading, leading_coefficient) = divisor.first()?;
        let mut quotient = Vec::new();
        while let Some((top, c)) = rest.pop_last() {
            let exponents = top.iter().zip(leading).map(|(a, b)| a.checked_sub(*b)).collect::<Option<Vec<u32>>>()?;
            let c = c.checked_div_exact(leading_coefficient)?;
            for (monomial, d) in &divisor[1..] {
                let key = monomial.iter().zip(&exponents).map(|(a, b)| a + b).collect();
                let product = c.mul(d);
                let entry = rest.entry(key).or_insert_with(D::zero);
                *entry = entry.sub(&product);
            }
            rest.retain(|_, c| !c.is_zero());
            quotient.push((exponents, c));
        }
        Some(Self::from_terms(quotient))
    }
}

impl<D: Domain> Domain for Polynomial<D> {
    /// Over rings that are not fields, coefficients must divide too: `2x` does not divide `x^2` over the integers.
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        self.quotient(other)
    }
}
