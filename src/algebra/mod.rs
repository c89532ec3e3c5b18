//! Exact and generic arithmetic; knows nothing of mechanisms.

mod approximation;
pub mod determinant;
pub mod double_double;
pub mod dual;
mod expression;
mod half_tangent;
pub mod int;
pub mod interval;
pub mod modp;
pub mod monomial;
pub mod number;
pub mod polynomial;
pub mod ratio;
pub mod rational;
pub mod reduction;
pub mod ring;
pub mod sturm;
pub mod text;
pub mod univariate;
mod value;
