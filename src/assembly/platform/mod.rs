//! All poses of a Stewart platform with legs of given lengths.

mod affine;
mod arrival;
mod candidate;
mod coincident;
mod exact;
mod high_precision;
mod homotopy;
mod mode;
mod prepared;
mod reach;
mod reflection;
mod search;
mod self_motion;
mod solver;
mod triangle;

pub use mode::{PlatformAssembly, PlatformMode, Route};
pub use reach::Distances;
pub use solver::{PlatformSolver, PlatformWorkspace};
