//! Gröbner bases over the rationals, for small systems: up to fifteen variables, by Buchberger's algorithm.
//!
//! Polynomials have integer coefficients without common factor, reductions multiply across, and no division leaves the
//! integers. Monomials are ordered by degree, then reverse lexicographically.

mod basis;
mod monomial;
mod polynomial;
mod ring;
mod solutions;

pub use basis::Basis;
pub use monomial::MOST_VARIABLES;
pub use polynomial::Equation;
pub use ring::FiniteRing;
pub use solutions::{Solutions, Values, inverse_modulo};
