//! All poses of a Stewart platform with legs of given lengths.

mod candidate;
mod mode;
mod prepared;
mod reflection;
mod rescue;
mod search;
mod self_motion;
mod solver;

pub use mode::{PlatformAssembly, PlatformMode, Route};
pub use solver::{PlatformSolver, PlatformWorkspace};
