//! From roots to assembly modes: prepares a geometry once, then finds every way to close it, pose after pose.

mod all_list;
mod axis_triples;
mod beside_families;
mod closed_form;
mod few_revolutes;
mod high_precision;
mod lane_finish;
mod lane_list;
mod limits;
mod mode;
pub mod platform;
mod prepared;
mod proof;
mod real_list;
mod search;
mod shifted;
mod side_by_side;
mod solver;
mod spherical;
pub mod ss_dyad;

pub use axis_triples::AxisTriple;
pub use closed_form::{Crowded, Rounded};
pub use high_precision::{MOST_TRIES, by_ring};
pub use mode::{Assembly, Hits, Mode, Roots, are_apart, distance, wrapped};
pub use real_list::distinct_real;
pub use solver::{Gap, Margin, Solver, Workspace};
pub use spherical::{Proof, proof, spherical_angles};
