//! `looproot mobility`

use super::arguments::MobilityOptions;
use super::certificates::{Certificates, not_covered};
use super::exit::{Exit, Fault, unexpected};
use super::output::Output;
use super::seed::plant;
use looproot::internal::catalogue::{Any, Chains, FrameworkFile, Options, load_any};
use looproot::internal::mobility::{Mobility, mobility};
use looproot::internal::report::document::complete;
use looproot::internal::report::framework as report;
use looproot::internal::report::linkage_mobility;
use looproot::internal::report::mobility::{json, text, verdict};

/// Decides whether a mechanism moves.
pub fn run(options: &MobilityOptions) -> Result<Exit, Fault> {
    plant(options.drawn.seed);
    let entry = match load_any(&options.mechanism, &Options { chains: Chains::Any, ..options.read.options() })? {
        Any::Entry(entry) => entry,
        Any::Framework(file) => {
            not_covered(options.certificate.as_ref(), "frameworks");
            return of_framework(options, &file);
        }
        other => {
            not_covered(options.certificate.as_ref(), "motions of linkages");
            let Some(asked) = linkage_mobility::ask(&other, &options.mechanism) else {
                let expected = "a loop, an arm, a platform, a linkage or a framework";
                return Err(unexpected(&options.mechanism, other.kind(), expected));
            };
            return of_linkage(options, &asked?);
        }
    };
    let answer = mobility(&entry)?;
    if let Some(path) = &options.certificate {
        let mut certificates = Certificates::new(path);
        certificates.add_motion(&entry, &answer)?;
        certificates.close()?;
    }
    let written = if options.json {
        let mut document = json(&entry, &answer);
        complete(&mut document, &entry);
        format!("{document:#}\n")
    } else if options.quiet {
        verdict(&answer) + "\n"
    } else {
        text(&entry, &answer)
    };
    Output::write(&options.output, &options.mechanism, &written)?;
    Ok(exit(&answer))
}

/// Decides whether a framework moves.
fn of_framework(options: &MobilityOptions, file: &FrameworkFile) -> Result<Exit, Fault> {
    let answer = file.mobility(options.steps)?;
    let written = if options.json {
        format!("{:#}\n", report::json(file, &answer))
    } else if options.quiet {
        report::verdict(&answer) + "\n"
    } else {
        report::text(file, &answer)
    };
    Output::write(&options.output, &options.mechanism, &written)?;
    Ok(match (answer.is_proved(), answer.freedom()) {
        (false, _) => Exit::NotProved,
        (true, (_, 0)) => Exit::Unreachable,
        _ => Exit::Complete,
    })
}

/// Writes whether a linkage moves.
fn of_linkage(options: &MobilityOptions, asked: &linkage_mobility::Asked) -> Result<Exit, Fault> {
    let answer = &asked.answer;
    let written = if options.json {
        format!("{:#}\n", linkage_mobility::json(asked))
    } else if options.quiet {
        linkage_mobility::verdict(answer) + "\n"
    } else {
        linkage_mobility::text(asked)
    };
    Output::write(&options.output, &options.mechanism, &written)?;
    Ok(if !answer.proof.is_proved() {
        Exit::NotProved
    } else if answer.mobility == Some(0) {
        Exit::Unreachable
    } else {
        Exit::Complete
    })
}

/// Returns the exit code: without a proof nothing is decided; a proof of rigidity counts like one of no real solution.
fn exit(answer: &Mobility) -> Exit {
    if !answer.proof.is_proved() {
        Exit::NotProved
    } else if answer.mobility == Some(0) {
        Exit::Unreachable
    } else {
        Exit::Complete
    }
}
