//! Exact and generic arithmetic; knows nothing of mechanisms.

mod approximation;
pub mod double_double;
mod expression;
mod half_tangent;
pub mod number;
pub mod reduction;
pub mod ring;
mod value;
