//! Planted solutions found, degenerate answers named, and no verdict better than its proof.
#![allow(clippy::unwrap_used)]

mod degenerate;
mod high_precision;
mod platforms;
mod primes;
mod published;
mod verdicts;

use looproot::internal::assembly::Roots;
use looproot::internal::benchmark::accuracy::{Counts, Job, run};
use looproot::internal::benchmark::sample::Set;

/// Nothing lost, spurious or double, and every residual small.
fn faultless(set: Set, count: u64, roots: Roots) -> Counts {
    let counts = run(Job { set, count, seed: 2024, roots, exact: false }, || true, || ()).unwrap();
    assert!(counts.is_faultless(), "{set:?}, {roots:?}:\n{counts}");
    assert_eq!(counts.solved as u64, count, "{set:?}, {roots:?}");
    let residual = counts.residuals.iter().copied().fold(0.0, f64::max);
    assert!(residual <= 1e-14, "{set:?}, {roots:?}: {residual:e}\n{counts}");
    counts
}

#[test]
fn general_arms_are_all_complete() {
    let counts = faultless(Set::General, 300, Roots::All);
    let words: usize = ["complete", "unreachable"].iter().filter_map(|word| counts.verdicts.get(word)).sum();
    assert_eq!(words, 300, "\n{counts}");
    assert_eq!(counts.complex.get(&16), Some(&300), "\n{counts}");
    assert_eq!(counts.modes, (4800, 4800), "\n{counts}");
    faultless(Set::General, 300, Roots::Real);
}

#[test]
fn structured_arms_lose_nothing() {
    faultless(Set::Structured, 300, Roots::All);
}

#[test]
fn nothing_is_lost_near_singular_poses() {
    faultless(Set::NearSingular, 200, Roots::All);
}

#[test]
fn calibrated_arms_are_all_complete() {
    let counts = faultless(Set::Calibrated, 60, Roots::All);
    let words: usize = ["complete", "unreachable"].iter().filter_map(|word| counts.verdicts.get(word)).sum();
    assert_eq!(words, 60, "\n{counts}");
    faultless(Set::Calibrated, 200, Roots::Real);
}

#[test]
fn lengths_of_different_sizes_lose_nothing() {
    faultless(Set::BadlyScaled, 100, Roots::All);
}
