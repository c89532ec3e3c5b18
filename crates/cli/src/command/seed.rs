//! The seed of the primes of this run.

use looproot_algebra::drawn;

/// Draws the primes of this run from a seed, if one is given.
pub fn plant(seed: Option<u64>) {
    if let Some(seed) = seed {
        drawn::plant(seed);
    }
}
