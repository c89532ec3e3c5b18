//! All solutions of kinematic closure equations.
#![deny(missing_docs)]

pub mod error;

pub mod algebra;

pub mod kinematics;

pub mod catalogue;

pub mod closure;

pub mod elimination;

pub mod solve;

pub mod certify;

pub mod assembly;

pub mod verdict;

pub mod mechanism;

pub mod benchmark;

pub mod claims;

pub mod report;
