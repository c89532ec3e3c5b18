//! `looproot derive --transference`

use super::arguments::DeriveOptions;
use super::exit::{Exit, Fault};
use super::output::Output;
use looproot::internal::catalogue::load;
use looproot::internal::derivation::transference::{NAMED, Transfer};
use looproot::internal::error::Error;
use looproot::internal::report::transference::{json, system, text, verdict};

/// Derives the spherical and the spatial closure equation of a loop of four joints.
pub fn run(options: &DeriveOptions, mechanism: &str) -> Result<Exit, Fault> {
    let transfer = if let Some(transfer) = Transfer::named(&mechanism.to_ascii_lowercase())? {
        transfer
    } else {
        let entry = load(mechanism, &options.read.options())?;
        let expected = NAMED.join(", ");
        let other = || Error::Unsupported(format!("transference of what is no loop; expected one, or {expected}"));
        Transfer::of(&entry.title, entry.chain().ok_or_else(other)?)?
    };
    let written = if options.json {
        format!("{}\n", json(&transfer))
    } else if let Some(format) = options.format {
        system(&transfer, format)?
    } else if options.quiet {
        verdict(&transfer) + "\n"
    } else {
        text(&transfer)
    };
    Output::write(&options.output, mechanism, &written)?;
    Ok(Exit::Complete)
}
