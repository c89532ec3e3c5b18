//! `looproot mobility`

use super::arguments::MobilityOptions;
use super::exit::{Exit, Fault};
use super::output::Output;
use looproot::catalogue::load;
use looproot::mobility::{Mobility, Proof, mobility};
use looproot::report::mobility::{json, text, verdict};
use std::io::Write;

/// Decides whether a loop moves.
pub fn run(options: &MobilityOptions) -> Result<Exit, Fault> {
    let entry = load(&options.mechanism, &options.read.options())?;
    let answer = mobility(&entry)?;
    let written = if options.json {
        format!("{:#}\n", json(&entry, &answer))
    } else if options.quiet {
        verdict(&answer) + "\n"
    } else {
        text(&entry, &answer)
    };
    let mut output = Output::open(&options.output, &options.mechanism)?;
    output.writer.write_all(written.as_bytes())?;
    output.writer.flush()?;
    Ok(exit(&answer))
}

/// Without a proof nothing is decided; a loop that closes nowhere has no real solution.
fn exit(answer: &Mobility) -> Exit {
    match answer.proof {
        Proof::None => Exit::NotProved,
        _ if answer.mobility == Some(0) && answer.configurations.is_empty() => Exit::Unreachable,
        _ => Exit::Complete,
    }
}
