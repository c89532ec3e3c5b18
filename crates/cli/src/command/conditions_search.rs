//! `looproot conditions` for loops of five and six joints.

use super::arguments::ConditionsOptions;
use super::exit::{Exit, Fault};
use super::output::Output;
use indicatif::{ProgressBar, ProgressDrawTarget};
use looproot::internal::catalogue::ansatz::Ansatz;
use looproot::internal::conditions::search::search;
use looproot::internal::report::conditions_search::{empty, json, markdown, proof, system, text, verdict};
use looproot::internal::report::document::complete_ansatz;
use std::time::Duration;

/// The default seed of all random choices, so that the same question has the same answer.
const SEED: u64 = 1;

/// Searches for conditions under which a loop moves.
pub fn run(options: &ConditionsOptions, ansatz: &Ansatz) -> Result<Exit, Fault> {
    // Visible on a terminal only.
    let progress = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    progress.set_message("searching");
    progress.enable_steady_tick(Duration::from_millis(200));
    let seed = options.seed.unwrap_or(SEED);
    let found = search(ansatz, seed);
    progress.finish_and_clear();
    let found = found?;
    let written = if options.json {
        let mut document = json(ansatz, &found);
        complete_ansatz(&mut document, ansatz, Some(seed));
        format!("{document}\n")
    } else if let Some(format) = options.format {
        system(ansatz, &found, options.family.as_deref(), format)?
    } else if options.explain {
        markdown(ansatz, &found)?
    } else if options.quiet {
        verdict(ansatz, &found) + "\n"
    } else {
        text(ansatz, &found)
    };
    Output::write(&options.output, &options.mechanism, &written)?;
    Ok(if !proof(ansatz, &found).is_proved() {
        Exit::NotProved
    } else if empty(ansatz, &found).is_some() {
        Exit::Unreachable
    } else {
        Exit::Complete
    })
}
