//! Derivations with symbols: their names, and what is seen of them while they run.

use super::arguments::DeriveOptions;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use looproot::internal::derivation::Watch;
use looproot::internal::error::Error;
use std::sync::atomic::AtomicBool;

/// Returns the names of `--symbolic=NAMES`.
pub fn names(list: &str) -> Vec<String> {
    list.split(',').map(|name| name.trim().to_owned()).filter(|name| !name.is_empty()).collect()
}

/// Derives with symbols and shows the number of values that are done. Ctrl-C ends the program: nothing is known before the end.
pub fn watched<T>(options: &DeriveOptions, derive: impl FnOnce(&Watch<'_>) -> Result<T, Error>) -> Result<T, Error> {
    end_on_interrupt();
    let target = if options.quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let progress = ProgressBar::with_draw_target(None, target);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} {per_sec} {eta}") {
        progress.set_style(style);
    }
    let begin = |count: usize| progress.set_length(count as u64);
    let step = || progress.inc(1);
    let found = derive(&Watch { stop: &AtomicBool::new(false), begin: &begin, step: &step });
    progress.finish_and_clear();
    found
}

/// Lets Ctrl-C say why nothing is printed, and end the program.
fn end_on_interrupt() {
    // Without a handler Ctrl-C still ends the program, though without a word.
    #[cfg(not(target_family = "wasm"))]
    let _ = ctrlc::set_handler(|| {
        eprintln!("\ninterrupted: a polynomial with symbols is known at the end only");
        std::process::exit(130);
    });
}
