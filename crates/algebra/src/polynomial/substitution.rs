//! Values, partial values, and polynomials in the place of variables.

use super::Polynomial;
use crate::monomial::Packing;
use crate::ring::Ring;

/// Returns `1, x, x^2, ...` up to the given exponent.
fn powers<R: Ring>(x: &R, exponent: u32) -> Vec<R> {
    let mut powers = vec![R::one()];
    for k in 0..exponent as usize {
        powers.push(powers[k].mul(x));
    }
    powers
}

impl<R: Ring> Polynomial<R> {
    /// Returns the value for the given values of the variables; further variables are 0.
    #[must_use]
    pub fn evaluate(&self, values: &[R]) -> R {
        let zero = R::zero();
        let table = |variable| powers(values.get(variable).unwrap_or(&zero), self.degree(variable));
        let tables: Vec<Vec<R>> = (0..self.variables()).map(table).collect();
        let mut sum = R::zero();
        for (i, c) in self.coefficients.iter().enumerate() {
            let mut product: Option<R> = None;
            for (variable, powers) in tables.iter().enumerate() {
                match self.exponent(i, variable) {
                    0 => {}
                    exponent => {
                        let power = &powers[exponent as usize];
                        product = Some(product.map_or_else(|| power.clone(), |product| product.mul(power)));
                    }
                }
            }
            match product {
                Some(product) => sum.add_product(c, &product),
                None => sum = sum.add(c),
            }
        }
        sum
    }

    /// Returns the polynomial with a variable replaced by another polynomial (a number: by a constant one).
    #[must_use]
    pub fn substitute(&self, variable: usize, replacement: &Self) -> Self {
        if let Some(value) = replacement.to_constant() {
            return self.at(variable, &value);
        }
        let parts = self.coefficients_in(variable);
        parts.iter().rev().fold(Self::zero(), |sum, part| sum.mul(replacement).add(part))
    }

    /// Returns the polynomial with several variables replaced at once: replaced variables may occur in the replacements.
    #[must_use]
    pub fn substitute_all(&self, replacements: &[(usize, Self)]) -> Self {
        let Some(((variable, replacement), others)) = replacements.split_first() else {
            return self.clone();
        };
        if others.is_empty() {
            return self.substitute(*variable, replacement);
        }
        let parts = self.coefficients_in(*variable);
        parts.iter().rev().fold(Self::zero(), |sum, part| sum.mul(replacement).add(&part.substitute_all(others)))
    }

    /// Returns the polynomial for a value of one variable.
    fn at(&self, variable: usize, value: &R) -> Self {
        if variable >= self.variables() {
            return self.clone();
        }
        let powers = powers(value, self.degree(variable));
        let (word, shift) = self.packing.place(variable);
        let words = self.packing.words();
        let mut monomials = self.monomials.clone();
        let mut coefficients = Vec::with_capacity(self.len());
        for (i, c) in self.coefficients.iter().enumerate() {
            let exponent = self.packing.field(monomials[i * words + word], shift);
            monomials[i * words + word] -= u64::from(exponent) << shift;
            coefficients.push(if exponent == 0 { c.clone() } else { c.mul(&powers[exponent as usize]) });
        }
        Self::from_unsorted(self.packing, monomials, coefficients)
    }

    /// Returns the coefficients of the powers of a variable, lowest first, free of that variable; none for zero.
    #[must_use]
    pub fn coefficients_in(&self, variable: usize) -> Vec<Self> {
        if self.is_zero() {
            return Vec::new();
        }
        if variable >= self.variables() {
            return vec![self.clone()];
        }
        let (word, shift) = self.packing.place(variable);
        let empty = Self { packing: self.packing, monomials: Vec::new(), coefficients: Vec::new() };
        let mut parts = vec![empty; self.degree(variable) as usize + 1];
        for (i, c) in self.coefficients.iter().enumerate() {
            // Monomials that agree in the exponent of the variable keep their order without it.
            let exponent = self.packing.field(self.monomial(i)[word], shift);
            let part = &mut parts[exponent as usize];
            let start = part.monomials.len();
            part.monomials.extend_from_slice(self.monomial(i));
            part.monomials[start + word] -= u64::from(exponent) << shift;
            part.coefficients.push(c.clone());
        }
        parts
    }

    /// Returns the sum of `coefficients[k] x^k` for the variable x, lowest first.
    ///
    /// # Panics
    /// When an exponent grows above [`crate::monomial::LARGEST_EXPONENT`].
    #[must_use]
    pub fn from_coefficients_in(variable: usize, coefficients: &[Self]) -> Self {
        let variables = coefficients.iter().map(Self::variables).max().unwrap_or(0).max(variable + 1);
        let degree = |(k, part): (usize, &Self)| k + part.degree(variable) as usize;
        let largest = coefficients.iter().enumerate().map(degree).max().unwrap_or(0);
        let largest = coefficients.iter().map(|part| part.largest_exponent() as usize).max().unwrap_or(0).max(largest);
        let packing = Packing::new(variables, u32::try_from(largest).unwrap_or(u32::MAX));
        let (word, shift) = packing.place(variable);
        let (mut monomials, mut sum) = (Vec::new(), Vec::new());
        for (k, part) in coefficients.iter().enumerate().rev() {
            let start = monomials.len();
            monomials.extend_from_slice(&part.packed_as(packing));
            for monomial in monomials[start..].chunks_exact_mut(packing.words()) {
                monomial[word] += (k as u64) << shift;
            }
            sum.extend_from_slice(&part.coefficients);
        }
        Self::from_unsorted(packing, monomials, sum)
    }
}
