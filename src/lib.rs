#![doc = include_str!("../README.md")]
//
// The modules in layer order, apart so that no formatter sorts them: none imports a later one.

pub mod error;

pub use looproot_algebra as algebra;

pub mod kinematics;

pub mod catalogue;

pub mod certificate;

pub mod closure;

pub mod elimination;

pub mod solve;

pub mod certify;
pub mod exact;

pub mod assembly;

pub mod verdict;

pub mod mechanism;

pub mod displacement;
pub mod lines;
pub mod synthesis;

pub mod linkage;

pub mod derivation;

pub mod sweep;

pub mod mobility;

pub mod factoring;

pub mod conditions;

pub mod benchmark;

pub mod claims;

pub mod scene;

pub mod report;

pub mod view;

pub mod face;

pub use face::{Arm, Loop, Platform};
