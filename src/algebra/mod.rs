//! Exact and generic arithmetic; knows nothing of mechanisms.

mod approximation;
pub mod determinant;
pub mod double_double;
pub mod dual;
mod expression;
pub mod factors;
mod half_tangent;
pub mod int;
mod integer_polynomial;
pub mod interval;
pub mod modp;
pub mod modular;
pub mod monomial;
pub mod number;
pub mod polynomial;
pub mod ratio;
pub mod rational;
pub mod real_roots;
pub mod reduction;
pub mod resultant;
pub mod ring;
mod rounded_chain;
pub mod sturm;
pub mod text;
pub mod trigonometric;
pub mod univariate;
mod value;
