//! Exact decisions: the closure equations of a loop over the rationals, for cases that f64 leaves open.

pub(crate) mod cut;
mod eliminant;
mod fibre;
mod ground;
mod height;
mod incidence;
mod krawczyk;
pub(crate) mod linkage;
mod missing;
mod multiplicity;
mod over_field;
pub(crate) mod positions;
mod rank;
mod resolution;
mod roots;
mod rough;
mod tuples;
mod values;

pub use eliminant::{Eliminant, Way, eliminant, eliminant_by_ring, has_no_solution, ways};
pub use ground::{Ground, OverRationals};
pub use incidence::{MOST_WITH_TRIPLE, has_triple};
pub use linkage::{Axis, JointValue, Linkage, Position};
pub use over_field::OverField;
pub use positions::{Conjugates, Positions, positions};
pub use rank::general_rank;
pub use resolution::{BALL_BITS, Known, Resolution, Solution, resolve};
pub use roots::{Isolated, isolated_roots};
pub use values::{Pair, Value, values};
