//! Derivations with symbols: their names, and what is seen of them while they run.

use super::arguments::DeriveOptions;
use super::solve::stop_on_interrupt;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use looproot::internal::derivation::Watch;
use looproot::internal::error::Error;
use std::sync::atomic::Ordering;

/// Returns the names of `--symbolic=NAMES`.
pub fn names(list: &str) -> Vec<String> {
    list.split(',').map(|name| name.trim().to_owned()).filter(|name| !name.is_empty()).collect()
}

/// Derives with symbols and shows the number of values that are done; `None` where Ctrl-C ended it.
pub fn watched<T>(
    options: &DeriveOptions,
    derive: impl FnOnce(&Watch<'_>) -> Result<T, Error>,
) -> Result<Option<T>, Error> {
    let stop = stop_on_interrupt();
    let target = if options.quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let progress = ProgressBar::with_draw_target(None, target);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} {per_sec} {eta}") {
        progress.set_style(style);
    }
    let begin = |count: usize| progress.set_length(count as u64);
    let step = || progress.inc(1);
    let found = derive(&Watch { stop: &stop, begin: &begin, step: &step });
    progress.finish_and_clear();
    if stop.load(Ordering::Relaxed) {
        eprintln!("interrupted: a polynomial with symbols is known at the end only");
        return Ok(None);
    }
    found.map(Some)
}
