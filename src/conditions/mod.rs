//! Conditions on the parameters for a closed chain to move, derived symbolically, each step computed and checked.

mod branch;
pub mod closure_identity;
pub mod component;
pub mod configurations;
pub mod curve_ansatz;
pub mod decide;
mod degenerate;
pub mod family;
pub mod finite_field;
mod fit;
pub mod formulas;
pub mod four_bar;
pub mod identity;
pub mod implication;
pub mod multiplier;
pub mod null_space;
pub mod number_field;
pub mod pattern;
pub mod quotient;
pub mod search;
pub mod spherical;
pub mod step;
pub mod sweep;
pub mod symmetry;
pub mod twist_family;
pub mod verification;
