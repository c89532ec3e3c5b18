//! Does a mechanism, a closed chain above all, move: decided from exact configurations, with proofs written out in docs/mobility.md.

mod answer;
mod branches;
mod count;
mod cut;
mod decision;
mod free;
mod ground;
pub mod linkage;
mod multiplicity;
mod nearby;
mod open;
pub mod order;
mod positions;
mod rounded;
mod search;
mod stillness;

pub use answer::{Configuration, Held, JointVariable, Mobility};
pub use count::{at_most, count};
pub use decision::mobility;
pub use linkage::{Axis, JointValue, Linkage, Position};
pub use order::{Germ, Local};
pub use positions::{Conjugates, Positions, positions};
pub use search::moves;
