//! `looproot solve` for questions about displacements and lines.

use super::arguments::SolveOptions;
use super::exit::{Exit, Fault};
use super::output::Output;
use looproot::internal::catalogue::CalculusFile;
use looproot::internal::error::Error;
use looproot::internal::lines;
use looproot::internal::report::calculus;
use looproot::internal::report::text::View;
use std::io::Write;

/// Answers every problem of the file.
pub fn run(
    options: &SolveOptions,
    file: &CalculusFile,
    open: impl FnOnce() -> Result<Output, Fault>,
) -> Result<Exit, Fault> {
    refuse(options, file)?;
    let answers = lines::answers(file)?;
    let mut output = open()?;
    let view = View {
        complex: options.complex,
        drop_outside_limits: false,
        quiet: options.quiet,
        colour: output.colour && !options.json && !options.jsonl,
    };
    if options.json {
        write!(output.writer, "{}", calculus::document(&calculus::json(file, &answers, &view)))?;
    } else {
        for (number, answer) in (1..).zip(&answers) {
            if options.jsonl {
                writeln!(output.writer, "{}", calculus::result(number, answer, &view))?;
            } else {
                write!(output.writer, "{}", calculus::text(answer, &view))?;
            }
        }
    }
    output.writer.flush()?;
    Ok(answers.iter().map(|answer| Exit::of_verdict(&answer.verdict)).max().unwrap_or(Exit::Complete))
}

/// Refuses the options that belong to mechanisms.
fn refuse(options: &SolveOptions, file: &CalculusFile) -> Result<(), Error> {
    let asked = &options.asked;
    let given = [
        ("--pose", asked.pose.is_some()),
        ("--input", asked.input.is_some()),
        ("--joints", asked.joints.is_some()),
        ("--legs", asked.legs.is_some()),
        ("--at", asked.at.is_some()),
        ("--poses", options.poses.is_some()),
        ("--lock", !options.demand.lock.is_empty()),
        ("--task", options.demand.task.is_some()),
        ("--near", options.near.is_some()),
        ("--tolerance", options.tolerance.is_some()),
        ("--turns", options.turns),
        ("--derivatives", options.derivatives),
        ("--scene", options.scene),
    ];
    match given.into_iter().find(|(_, is_given)| *is_given) {
        Some((name, _)) => {
            let noun = file.kind().noun();
            Err(Error::Invalid(format!("found {name} for {noun}, expected it for a mechanism only")))
        }
        None => Ok(()),
    }
}
