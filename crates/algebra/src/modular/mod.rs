//! Determinants and resultants of polynomials with numeric coefficients, from their images modulo many primes.
//!
//! Polynomials are evaluated at integer points modulo primes, determinants of numbers are found there, interpolated, and
//! the coefficients put together by Chinese remainders. The arithmetic is that of f64 with a fused multiply-add, primes
//! side by side in the lanes of vector registers, or where the machine is seen at run time to have none that of Montgomery.

mod batch;
mod bound;
mod chinese;
mod determinant;
pub mod lanes;
mod lattice;
pub mod primes;
mod problem;
mod resultant;
mod substitution;
mod terms;

pub use determinant::determinant;
pub(super) use determinant::{degree_bound, univariate_determinant};
pub use resultant::resultant;
pub use terms::Terms;
