//! Square-free parts and decompositions.

use super::Polynomial;
use crate::int::Int;
use crate::ring::{Domain, Ring};
use crate::sort;

impl Polynomial<Int> {
    /// Returns the square-free factors that are not constant, primitive with positive leading coefficients, each with its
    /// multiplicity, by increasing multiplicity; the product of their powers is the primitive part.
    ///
    /// Factors of one multiplicity are not separated further.
    ///
    /// # Panics
    /// When the polynomial is zero.
    ///
    /// # Source
    /// Yun 1976, On square-free decomposition algorithms, SYMSAC.
    ///
    /// # Example
    /// ```
    /// use looproot_algebra::{int::Int, polynomial::Polynomial, ring::Ring};
    ///
    /// let (x, y) = (Polynomial::<Int>::variable(0), Polynomial::variable(1));
    /// let product = x.mul(&x.add(&y).pow(3)).scale(&Int::from(-6));
    /// assert_eq!(product.square_free_decomposition(), [(x.clone(), 1), (x.add(&y), 3)]);
    /// ```
    #[must_use]
    pub fn square_free_decomposition(&self) -> Vec<(Self, usize)> {
        assert!(!self.is_zero(), "every factor divides zero without end");
        let mut factors = Vec::new();
        let monomial = self.monomial_content();
        for (variable, degree) in monomial.degrees().into_iter().enumerate() {
            if degree > 0 {
                enter(&mut factors, Self::variable(variable), degree as usize);
            }
        }
        let mut rest = self.div_exact(&monomial).primitive_part();
        if rest.len() > 1 && rest.degrees().into_iter().all(|degree| degree <= 1) {
            // The square of a factor would have a degree of 2 or more.
            enter(&mut factors, rest, 1);
            sort::by_key(&mut factors, |(_, multiplicity)| *multiplicity);
            return factors;
        }
        // In characteristic 0 a factor that the main variable occurs in is not lost by the derivative; others are in the
        // content.
        let occurs =
            |rest: &Self| (0..rest.variables()).filter(|&v| rest.degree(v) > 0).min_by_key(|&v| rest.degree(v));
        while let Some(variable) = occurs(&rest) {
            let content = rest.content_in(variable);
            rest.div_exact(&content).decompose_in(variable, &mut factors);
            rest = content;
        }
        sort::by_key(&mut factors, |(_, multiplicity)| *multiplicity);
        factors
    }

    /// Returns the product of the distinct irreducible factors that are not constant, its leading coefficient positive.
    ///
    /// # Panics
    /// When the polynomial is zero.
    #[must_use]
    pub fn square_free_part(&self) -> Self {
        let factors = self.square_free_decomposition();
        factors.iter().fold(Self::one(), |product, (factor, _)| product.mul(factor))
    }

    /// Yun's algorithm for a polynomial that is primitive in the variable.
    fn decompose_in(&self, variable: usize, factors: &mut Vec<(Self, usize)>) {
        if self.degree(variable) == 1 {
            // Primitive and of degree 1: irreducible.
            return enter(factors, self.primitive_part(), 1);
        }
        let derivative = self.derivative(variable);
        let repeated = self.gcd(&derivative);
        let mut rest = self.div_exact(&repeated);
        let mut slope = derivative.div_exact(&repeated).sub(&rest.derivative(variable));
        let mut multiplicity = 1;
        while rest.degree(variable) > 0 {
            let factor = rest.gcd(&slope);
            rest = rest.div_exact(&factor);
            slope = slope.div_exact(&factor).sub(&rest.derivative(variable));
            if factor.degree(variable) > 0 {
                enter(factors, factor.primitive_part(), multiplicity);
            }
            multiplicity += 1;
        }
    }
}

/// Multiplies a factor into the one of the same multiplicity.
fn enter(factors: &mut Vec<(Polynomial<Int>, usize)>, factor: Polynomial<Int>, multiplicity: usize) {
    match factors.iter_mut().find(|(_, known)| *known == multiplicity) {
        Some((product, _)) => *product = product.mul(&factor),
        None => factors.push((factor, multiplicity)),
    }
}
