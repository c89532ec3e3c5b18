//! Does a mechanism, a closed chain above all, move: decided from exact configurations, with proofs written out in docs/mobility.md.

mod answer;
mod branches;
mod count;
mod decision;
mod free;
mod ground;
mod multiplicity;
mod nearby;
mod open;
pub mod order;
mod planar;
mod rounded;
mod search;
mod spatial;
mod stillness;

pub use crate::exact::{Axis, Conjugates, JointValue, Linkage, Position, Positions, positions};
pub use answer::{Configuration, Held, JointVariable, Mobility};
pub use count::{at_most, count};
pub use decision::mobility;
pub use order::{Germ, Local};
pub use planar::{LinkageMobility, planar_mobility, solve_or_move};
pub use search::moves;
pub use spatial::{Shafts, space_mobility, sphere_mobility};
