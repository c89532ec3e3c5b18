//! All poses of a Stewart platform with legs of given lengths.

mod arrival;
mod candidate;
mod homotopy;
mod mode;
mod prepared;
mod reflection;
mod search;
mod self_motion;
mod solver;
mod triangle;

pub use mode::{PlatformAssembly, PlatformMode, Route};
pub use solver::{PlatformSolver, PlatformWorkspace};
