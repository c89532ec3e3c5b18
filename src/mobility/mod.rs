//! Does a closed chain move: decided from exact configurations, with proofs written out in docs/mobility.md.

mod answer;
mod decision;
pub mod linkage;
pub mod order;
mod positions;
mod rounded;
mod search;

pub use answer::{Configuration, Held, JointVariable, Mobility, Proof};
pub use decision::mobility;
pub use linkage::{Axis, JointValue, Linkage, Position};
pub use order::{Germ, Local};
pub use positions::{Conjugates, Positions, positions};
pub use search::moves;
