//! Does a closed chain move: decided from exact configurations, with proofs written out in docs/mobility.md.

pub mod linkage;
pub mod order;
mod positions;

pub use linkage::{JointValue, Linkage, Position};
pub use order::{Germ, Local};
pub use positions::{Conjugates, Positions, positions};
