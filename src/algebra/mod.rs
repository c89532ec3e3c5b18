//! Exact and generic arithmetic; knows nothing of mechanisms.

pub mod number;
pub mod reduction;
pub mod ring;
