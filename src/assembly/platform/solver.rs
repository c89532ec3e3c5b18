//! A platform prepared once and solved for one set of leg lengths after the other.

use super::mode::PlatformAssembly;
use crate::assembly::Roots;
use crate::kinematics::platform::Platform;

/// The geometry of a platform, prepared for every set of leg lengths. Shared between threads.
#[derive(Clone, Debug)]
pub struct PlatformSolver {
    platform: Platform<f64>,
}

/// Scratch memory, reused from call to call: one for every thread.
#[derive(Clone, Debug, Default)]
pub struct PlatformWorkspace {}

impl PlatformSolver {
    /// Prepares a geometry. Any finite coordinates will do; degenerate ones show in the answers.
    #[must_use]
    pub fn prepare(platform: &Platform<f64>) -> Self {
        Self { platform: platform.clone() }
    }

    /// The geometry as given.
    #[must_use]
    pub fn platform(&self) -> &Platform<f64> {
        &self.platform
    }

    /// All poses with legs of these squared lengths (negative ones are meant as written: no pose is real then). With
    /// [`Roots::Real`] only real ones.
    pub fn solve(
        &self,
        _legs_squared: &[f64; 6],
        _roots: Roots,
        _workspace: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) {
        assembly.modes.clear();
    }
}
