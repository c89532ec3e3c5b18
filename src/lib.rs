//! All solutions of kinematic closure equations.
#![deny(missing_docs)]

pub mod error;

pub mod algebra;
pub mod kinematics;

pub mod catalogue;
