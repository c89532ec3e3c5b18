//! Sparse polynomials in any number of variables over any ring, themselves a ring.

mod blocks;
mod content;
mod coprime;
mod determinant;
mod gcd;
mod grading;
mod heap;
mod image;
mod kronecker;
mod limbs;
mod line;
mod line_divisor;
mod planes;
mod power;
mod product;
mod quotient;
mod recurrence;
mod scattered;
mod short;
mod slots;
mod sparse_gcd;
mod square_free;
mod substitution;
mod sum;
mod transform;

pub(crate) use content::common_factor;

use super::monomial::Packing;
use super::ring::{Domain, Ring};
use super::univariate::Univariate;
use rug::Rational;
use std::borrow::Cow;
use std::cmp::Reverse;

/// A polynomial in the variables 0, 1, 2, ..., whose names are kept elsewhere.
///
/// Sums and products of polynomials in different numbers of variables need no preparation: a variable that a polynomial
/// does not have has exponent 0 there.
///
/// # Example
/// ```
/// use looproot_algebra::{int::Int, polynomial::Polynomial, ring::{Domain, Ring}};
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

/// A bound on the size of a result, known before it is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Maximum number of terms.
    pub terms: u64,
    /// The largest exponent of a variable; above [`super::monomial::LARGEST_EXPONENT`] the computation would panic.
    pub largest_exponent: u64,
}

impl<R: Ring> Polynomial<R> {
    /// Returns a constant.
    #[must_use]
    pub fn constant(c: R) -> Self {
        let (monomials, coefficients) = if c.is_zero() { (Vec::new(), Vec::new()) } else { (vec![0], vec![c]) };
        Self { packing: Packing::new(0, 0), monomials, coefficients }
    }

    /// Returns a variable.
    #[must_use]
    pub fn variable(variable: usize) -> Self {
        let packing = Packing::new(variable + 1, 1);
        let (word, shift) = packing.place(variable);
        let mut monomials = vec![0; packing.words()];
        monomials[word] = 1 << shift;
        Self { packing, monomials, coefficients: vec![R::one()] }
    }

    /// Returns the sum of terms in any order, each given by the exponents of the first variables and its coefficient.
    ///
    /// # Panics
    /// When an exponent is above [`super::monomial::LARGEST_EXPONENT`].
    #[must_use]
    pub fn from_terms(terms: impl IntoIterator<Item = (Vec<u32>, R)>) -> Self {
        let terms: Vec<(Vec<u32>, R)> = terms.into_iter().collect();
        let used = |exponents: &Vec<u32>| exponents.iter().rposition(|&e| e > 0).map_or(0, |last| last + 1);
        let variables = terms.iter().map(|(exponents, _)| used(exponents)).max().unwrap_or(0);
        let largest = terms.iter().flat_map(|(exponents, _)| exponents).copied().max().unwrap_or(0);
        let packing = Packing::new(variables, largest);
        let (mut monomials, mut coefficients) = (Vec::new(), Vec::new());
        for (exponents, c) in terms {
            packing.push(&exponents[..exponents.len().min(variables)], &mut monomials);
            coefficients.push(c);
        }
        Self::from_unsorted(packing, monomials, coefficients)
    }

    /// As [`Self::from_terms`], from the exponents of all variables, term after term.
    pub(crate) fn from_lists(variables: usize, exponents: &[u32], coefficients: Vec<R>) -> Self {
        let largest = exponents.iter().copied().max().unwrap_or(0);
        let packing = Packing::new(variables, largest);
        let mut monomials = Vec::with_capacity(packing.words() * coefficients.len());
        if variables == 0 {
            monomials.resize(coefficients.len(), 0);
        }
        for exponents in exponents.chunks_exact(variables.max(1)) {
            packing.push(exponents, &mut monomials);
        }
        Self::from_unsorted(packing, monomials, coefficients)
    }

    /// As [`Self::from_terms`], from variables and exponents, term after term up to the given ends; no variable stands twice
    /// in a term.
    pub(crate) fn from_powers(variables: usize, powers: &[(u32, u32)], ends: &[usize], coefficients: Vec<R>) -> Self {
        let largest = powers.iter().map(|power| power.1).max().unwrap_or(0);
        let packing = Packing::new(variables, largest);
        let places: Vec<(usize, u32)> = (0..variables).map(|variable| packing.place(variable)).collect();
        let mut monomials = vec![0; packing.words() * coefficients.len()];
        let mut start = 0;
        for (monomial, &end) in monomials.chunks_exact_mut(packing.words()).zip(ends) {
            for &(variable, exponent) in &powers[start..end] {
                let (word, shift) = places[variable as usize];
                monomial[word] |= u64::from(exponent) << shift;
            }
            start = end;
        }
        Self::from_unsorted(packing, monomials, coefficients)
    }

    /// Returns the sum of packed terms in any order.
    pub(crate) fn from_unsorted(packing: Packing, monomials: Vec<u64>, coefficients: Vec<R>) -> Self {
        let words = packing.words();
        let decreasing = if words == 1 {
            monomials.is_sorted_by(|a, b| a > b)
        } else {
            monomials.chunks_exact(words).is_sorted_by(|a, b| a > b)
        };
        if decreasing {
            return Self::from_sorted(packing, monomials, coefficients);
        }
        let mut sorted = Self { packing, monomials: Vec::with_capacity(monomials.len()), coefficients: Vec::new() };
        sorted.coefficients.reserve(coefficients.len());
        if words == 1 {
            let mut keyed: Vec<(u64, R)> = monomials.into_iter().zip(coefficients).collect();
            keyed.sort_unstable_by_key(|term| Reverse(term.0));
            for (monomial, c) in keyed {
                sorted.push(&[monomial], c);
            }
        } else {
            let mut keyed: Vec<(&[u64], R)> = monomials.chunks_exact(words).zip(coefficients).collect();
            keyed.sort_unstable_by_key(|term| Reverse(term.0));
            for (monomial, c) in keyed {
                sorted.push(monomial, c);
            }
        }
        sorted.drop_last_if_zero();
        sorted
    }

    /// Appends a term that is not above the last one, and adds it to that one if the monomials are equal. Leaves a last
    /// term of zero to [`Self::drop_last_if_zero`].
    fn push(&mut self, monomial: &[u64], c: R) {
        let is_same = match (monomial, self.monomials.last()) {
            // Most monomials are one word, which needs no call.
            ([word], Some(last)) => word == last,
            _ => !self.coefficients.is_empty() && self.monomials.ends_with(monomial),
        };
        if is_same {
            let last = self.coefficients.len() - 1;
            self.coefficients[last] = self.coefficients[last].add(&c);
        } else {
            self.drop_last_if_zero();
            self.monomials.extend_from_slice(monomial);
            self.coefficients.push(c);
        }
    }

    fn drop_last_if_zero(&mut self) {
        if self.coefficients.last().is_some_and(Ring::is_zero) {
            self.coefficients.pop();
            self.monomials.truncate(self.monomials.len() - self.packing.words());
        }
    }

    /// Returns the sum of packed terms of decreasing monomials; zeros are dropped.
    fn from_sorted(packing: Packing, mut monomials: Vec<u64>, mut coefficients: Vec<R>) -> Self {
        if coefficients.iter().any(Ring::is_zero) {
            let words = packing.words();
            let kept = coefficients.iter().map(|c| !c.is_zero());
            monomials = monomials
                .chunks_exact(words)
                .zip(kept)
                .filter(|(_, kept)| *kept)
                .flat_map(|(m, _)| m)
                .copied()
                .collect();
            coefficients.retain(|c| !c.is_zero());
        }
        Self { packing, monomials, coefficients }
    }

    /// Returns the terms, the lexicographically highest first: the exponents of all [`Self::variables`], and the coefficient.
    #[must_use]
    pub fn terms(&self) -> impl ExactSizeIterator<Item = (Vec<u32>, &R)> + DoubleEndedIterator {
        (0..self.len()).map(|i| (self.packing.unpack(self.monomial(i)), &self.coefficients[i]))
    }

    fn monomial(&self, i: usize) -> &[u64] {
        let words = self.packing.words();
        &self.monomials[i * words..(i + 1) * words]
    }

    /// Returns the exponent of a variable in the term with the given number.
    ///
    /// # Panics
    /// When there is no such term.
    #[must_use]
    pub fn exponent(&self, term: usize, variable: usize) -> u32 {
        self.packing.exponent(self.monomial(term), variable)
    }

    /// Returns the coefficients, in the order of the terms.
    #[must_use]
    pub fn coefficients(&self) -> &[R] {
        &self.coefficients
    }

    /// Returns the number of terms.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a polynomial without terms is zero")]
    pub fn len(&self) -> usize {
        self.coefficients.len()
    }

    /// Returns one more than the highest variable that may occur.
    #[must_use]
    pub const fn variables(&self) -> usize {
        self.packing.variables()
    }

    /// Returns a bound of all exponents, known without a look at them.
    #[must_use]
    pub const fn exponent_bound(&self) -> u32 {
        self.packing.largest()
    }

    /// Returns the degree in one variable; 0 for the zero polynomial.
    #[must_use]
    pub fn degree(&self, variable: usize) -> u32 {
        if variable >= self.variables() {
            return 0;
        }
        if variable == 0 {
            // The first variable decreases along the terms.
            return if self.is_zero() { 0 } else { self.exponent(0, 0) };
        }
        let (word, shift) = self.packing.place(variable);
        let highest = |degree: u32, word: &u64| degree.max(self.packing.field(*word, shift));
        match self.packing.words() {
            1 => self.monomials.iter().fold(0, highest),
            words => self.monomials.iter().skip(word).step_by(words).fold(0, highest),
        }
    }

    /// Returns the degrees in all [`Self::variables`].
    #[must_use]
    pub fn degrees(&self) -> Vec<u32> {
        // The bitwise or shows which variables occur at all, mostly few of them.
        let words = self.packing.words();
        let mut outline = vec![0; words];
        for monomial in self.monomials.chunks_exact(words) {
            for (or, word) in outline.iter_mut().zip(monomial) {
                *or |= word;
            }
        }
        let degree = |variable| if self.packing.exponent(&outline, variable) == 0 { 0 } else { self.degree(variable) };
        (0..self.variables()).map(degree).collect()
    }

    /// Returns the total degree; `None` for the zero polynomial.
    #[must_use]
    pub fn total_degree(&self) -> Option<u64> {
        let total = |i| (0..self.variables()).map(|variable| u64::from(self.exponent(i, variable))).sum();
        (0..self.len()).map(total).max()
    }

    /// Returns the number, if no variable occurs; `Some(zero)` for the zero polynomial.
    #[must_use]
    pub fn to_constant(&self) -> Option<R> {
        match self.coefficients.as_slice() {
            [] => Some(R::zero()),
            [c] if self.monomials.iter().all(|&word| word == 0) => Some(c.clone()),
            _ => None,
        }
    }

    /// Returns the product with a number.
    #[must_use]
    pub fn scale(&self, factor: &R) -> Self {
        let coefficients = self.coefficients.iter().map(|c| c.mul(factor)).collect();
        Self::from_sorted(self.packing, self.monomials.clone(), coefficients)
    }

    /// Returns the derivative with respect to a variable.
    ///
    /// # Panics
    /// Never: exponents fit an i32.
    #[must_use]
    pub fn derivative(&self, variable: usize) -> Self {
        if variable >= self.variables() {
            return Self::zero();
        }
        let (word, shift) = self.packing.place(variable);
        let (mut monomials, mut coefficients) = (Vec::new(), Vec::new());
        for (i, c) in self.coefficients.iter().enumerate() {
            let exponent = self.packing.field(self.monomial(i)[word], shift);
            if exponent > 0 {
                // Lowering one exponent everywhere by one keeps the order.
                let start = monomials.len();
                monomials.extend_from_slice(self.monomial(i));
                monomials[start + word] -= 1 << shift;
                coefficients.push(c.mul(&R::from_integer(exponent.cast_signed())));
            }
        }
        Self::from_sorted(self.packing, monomials, coefficients)
    }

    /// Returns the polynomial over another ring; `None` as soon as one coefficient has no image.
    pub fn map<S: Ring>(&self, image: impl Fn(&R) -> Option<S>) -> Option<Polynomial<S>> {
        let coefficients = self.coefficients.iter().map(image).collect::<Option<_>>()?;
        Some(Polynomial::from_sorted(self.packing, self.monomials.clone(), coefficients))
    }

    /// Returns the polynomial in one variable; `None` if another one occurs.
    #[must_use]
    pub fn to_univariate(&self, variable: usize) -> Option<Univariate<R>> {
        let mut coefficients = Vec::new();
        for (i, c) in self.coefficients.iter().enumerate() {
            if (0..self.variables()).any(|other| other != variable && self.exponent(i, other) > 0) {
                return None;
            }
            let exponent = self.exponent(i, variable) as usize;
            coefficients.resize(coefficients.len().max(exponent + 1), R::zero());
            coefficients[exponent] = c.clone();
        }
        Some(Univariate::new(coefficients))
    }

    /// Converts a polynomial in one variable to one in several.
    ///
    /// # Panics
    /// When the degree is above [`super::monomial::LARGEST_EXPONENT`].
    #[must_use]
    pub fn from_univariate(variable: usize, polynomial: &Univariate<R>) -> Self {
        let degree = polynomial.degree().unwrap_or(0);
        let packing = Packing::new(variable + 1, u32::try_from(degree).unwrap_or(u32::MAX));
        let (word, shift) = packing.place(variable);
        let mut monomials = vec![0; polynomial.coefficients().len() * packing.words()];
        for (power, monomial) in monomials.chunks_exact_mut(packing.words()).rev().enumerate() {
            monomial[word] = (power as u64) << shift;
        }
        Self::from_sorted(packing, monomials, polynomial.coefficients().iter().rev().cloned().collect())
    }

    /// Returns the largest exponent of any variable.
    fn largest_exponent(&self) -> u32 {
        self.degrees().into_iter().max().unwrap_or(0)
    }

    /// Returns a packing that holds both.
    fn joint_packing(&self, other: &Self) -> Packing {
        if self.packing == other.packing {
            return self.packing;
        }
        let (wide, narrow) = if self.variables() < other.variables() { (other, self) } else { (self, other) };
        if narrow.packing.largest() <= wide.packing.largest() {
            return wide.packing;
        }
        let largest = narrow.largest_exponent();
        if largest <= wide.packing.largest() {
            return wide.packing;
        }
        Packing::new(wide.variables(), largest.max(wide.largest_exponent()))
    }

    /// Returns the monomials in another packing, which holds them.
    fn packed_as(&self, packing: Packing) -> Cow<'_, [u64]> {
        if self.packing.agrees(&packing) {
            Cow::Borrowed(&self.monomials)
        } else {
            Cow::Owned(packing.repack(&self.packing, &self.monomials))
        }
    }
}

impl<R: Ring> PartialEq for Polynomial<R> {
    fn eq(&self, other: &Self) -> bool {
        if self.coefficients != other.coefficients {
            return false;
        }
        if self.packing == other.packing {
            return self.monomials == other.monomials;
        }
        let variables = self.variables().max(other.variables());
        (0..self.len())
            .all(|i| (0..variables).all(|variable| self.exponent(i, variable) == other.exponent(i, variable)))
    }
}

impl<R: Ring> Ring for Polynomial<R> {
    fn zero() -> Self {
        Self { packing: Packing::new(0, 0), monomials: Vec::new(), coefficients: Vec::new() }
    }
    fn one() -> Self {
        Self::constant(R::one())
    }
    fn add(&self, other: &Self) -> Self {
        self.merge(other, R::clone, R::add)
    }
    fn sub(&self, other: &Self) -> Self {
        self.merge(other, R::neg, R::sub)
    }
    fn mul(&self, other: &Self) -> Self {
        self.product(other)
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

impl<D: Domain> Domain for Polynomial<D> {
    /// Over rings that are not fields, coefficients must divide too: `2x` does not divide `x^2` over the integers.
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        self.quotient(other)
    }
}
