//! The seed of the primes of this run.

use clap::Args;
use looproot_algebra::drawn;

/// The seed of the numbers that a count or a trace draws.
#[derive(Args)]
pub struct SeedOptions {
    /// Seed of the numbers that are drawn: the same seed repeats an answer [default: drawn]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(..1 << 53))]
    pub seed: Option<u64>,
}

/// Draws the primes of this run from a seed, if one is given.
pub fn plant(seed: Option<u64>) {
    if let Some(seed) = seed {
        drawn::plant(seed);
    }
}
