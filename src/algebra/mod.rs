//! Exact and generic arithmetic; knows nothing of robots.

mod approximation;
mod expression;
mod half_tangent;
pub mod number;
pub mod ring;
mod value;
