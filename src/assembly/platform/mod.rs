//! All poses of a Stewart platform with legs of given lengths.

mod mode;
mod solver;

pub use mode::{PlatformAssembly, PlatformMode, Route};
pub use solver::{PlatformSolver, PlatformWorkspace};
