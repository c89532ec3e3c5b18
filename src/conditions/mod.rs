//! For which parameters a closed chain moves: conditions derived symbolically, each step computed and checked.

pub mod configurations;
pub mod curve_ansatz;
pub mod finite_field;
pub mod identity;
pub mod lift;
pub mod multiplier;
pub mod search;
pub mod spherical;
pub mod sweep;
pub mod symmetry;
pub mod verification;
