//! `looproot derive`

use super::arguments::DeriveOptions;
use super::exit::{Exit, Fault};
use super::output::Output;
use super::wanted::wanted;
use looproot::catalogue::load;
use looproot::derivation::{Derivation, derive};
use looproot::report::derivation::{json, markdown, system, text, verdict};
use std::io::Write;

/// Derives closure equations and closure polynomial of the case asked for, else of the first one.
pub fn run(options: &DeriveOptions) -> Result<Exit, Fault> {
    if options.transference {
        return super::transference::run(options);
    }
    let mut entry = load(&options.mechanism, &options.read.options())?;
    let index = wanted(&options.asked, &options.mechanism, &mut entry)?.start;
    let derivation = derive(&entry, &entry.cases[index])?;
    let written = if options.json {
        format!("{}\n", json(&entry, index + 1, &derivation))
    } else if let Some(format) = options.format {
        system(&derivation, format)?
    } else if options.explain {
        markdown(&entry, index + 1, &derivation)?
    } else if options.quiet {
        verdict(&derivation) + "\n"
    } else {
        text(&derivation)
    };
    let mut output = Output::open(&options.output, &options.mechanism)?;
    output.writer.write_all(written.as_bytes())?;
    output.writer.flush()?;
    Ok(exit(&derivation))
}

/// Without a polynomial nothing is proved; without a real root nothing is reached.
fn exit(derivation: &Derivation) -> Exit {
    match &derivation.polynomial {
        None => Exit::NotProved,
        Some(polynomial) if polynomial.roots.is_empty() && polynomial.at_pi == 0 => Exit::Unreachable,
        Some(_) => Exit::Complete,
    }
}
