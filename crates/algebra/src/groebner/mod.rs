//! Gröbner bases of small systems: up to fifteen variables, by Buchberger's algorithm, over the rationals or modulo the prime of this
//! run.
//!
//! Over the rationals polynomials have integer coefficients without common factor, reductions multiply across, and no division leaves
//! the integers. Monomials are ordered by degree, then reverse lexicographically.

mod basis;
mod coefficient;
mod monomial;
mod polynomial;
mod ring;
mod solutions;

pub use basis::Basis;
pub use coefficient::Coefficient;
pub use monomial::MOST_VARIABLES;
pub use polynomial::Equation;
pub use ring::{FiniteRing, Quotient};
pub use solutions::{Solutions, Values, inverse_modulo};
