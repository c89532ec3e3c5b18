//! Resultants: one variable out of two polynomials, two out of three, and the way back to what was eliminated.

pub mod bezout;
pub mod dixon;
mod eliminant;
mod linear;
mod minors;
pub mod subresultant;
pub mod sylvester;

pub use eliminant::{Eliminant, common_divisor, eliminate, resultant};

/// Whether a sign changes.
const fn odd(n: usize) -> bool {
    n % 2 == 1
}
