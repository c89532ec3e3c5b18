//! From roots to assembly modes: prepares a geometry once, then finds every way to close it, pose after pose.

mod axis_triples;
mod spherical;
mod closed_form;
pub mod ss_dyad;
mod few_revolutes;
mod lane_list;
mod limits;
mod mode;
pub mod platform;
mod prepared;
mod proof;
mod real_list;
mod high_precision;
mod search;
mod shifted;
mod solver;

pub use axis_triples::AxisTriple;
pub use spherical::{Proof, proof};
pub use mode::{Assembly, Hits, Mode, Roots, are_apart, distance, wrapped};
pub use high_precision::by_ring;
pub use real_list::distinct_real;
pub use solver::{Gap, Margin, Solver, Workspace};
