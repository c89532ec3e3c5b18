//! Determinants and resultants of polynomials with numeric coefficients, from their images modulo many primes.
//!
//! Polynomials are evaluated at integer points modulo primes. Determinants of numbers are computed there and interpolated, and
//! the coefficients are combined by Chinese remainders. The arithmetic is that of f64 with a fused multiply-add, with primes
//! side by side in the lanes of vector registers, or Montgomery's if the machine turns out at run time to have none.

mod batch;
mod bound;
mod chinese;
mod cost;
mod determinant;
pub mod lanes;
mod lattice;
mod minors;
pub mod primes;
mod problem;
mod resultant;
mod substitution;
mod terms;

pub use determinant::determinant;
pub(super) use determinant::{degree_bound, determinant_cost, short_determinant, univariate_determinant};
pub use resultant::resultant;
pub(super) use resultant::resultant_cost;
pub use terms::Terms;
