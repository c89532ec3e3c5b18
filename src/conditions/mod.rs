//! For which parameters a closed chain moves: conditions derived symbolically, each step computed and checked.

pub mod closure_identity;
pub mod component;
pub mod decide;
mod degenerate;
pub mod four_bar;
pub mod null_space;
pub mod quotient;
pub mod step;
pub mod twist_family;
