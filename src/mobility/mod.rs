//! Does a closed chain move: decided from exact configurations, with proofs written out in docs/mobility.md.

mod echelon;
pub mod linkage;
pub mod order;

pub use linkage::{JointValue, Linkage, Position};
pub use order::{Germ, Local};
