//! looproot
#![warn(missing_docs)]
pub mod error;
pub mod algebra;
pub mod kinematics;
pub mod closure;
pub mod elimination;
pub mod solve;
pub mod certify;
pub mod assembly;
