//! Resultants: one variable out of two polynomials, two out of three, and the way back to the eliminated ones.

pub mod bezout;
mod common_divisor;
pub mod dixon;
mod eliminant;
mod linear;
mod route;
pub mod subresultant;
pub mod sylvester;

pub use common_divisor::common_divisor;
pub use eliminant::{Eliminant, eliminate, resultant};

/// Returns whether a sign changes.
const fn odd(n: usize) -> bool {
    n % 2 == 1
}
