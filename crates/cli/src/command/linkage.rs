//! `looproot solve` for linkages.

use super::arguments::SolveOptions;
use super::certificates::Certificates;
use super::exit::{Exit, Fault};
use super::output::Output;
use super::solve::stop_on_interrupt;
use looproot::internal::catalogue::LinkageFile;
use looproot::internal::error::Error;
use looproot::internal::linkage::assembly::Asked;
use looproot::internal::mobility::solve_or_move;
use looproot::internal::report::linkage as report;
use looproot::internal::verdict::{Proof, Status, Verdict};
use looproot::internal::view::drawable;
use serde_json::{Value, json};
use std::borrow::Cow;
use std::io::Write;
use std::sync::atomic::Ordering;

/// Finds every assembly of every case, or of the requested one.
pub fn run(options: &SolveOptions, file: &LinkageFile, output: Output) -> Result<Exit, Fault> {
    refuse(options)?;
    let stop = stop_on_interrupt();
    let file = &*posed(options.asked.input.as_deref(), file)?;
    let wanted = wanted(options.asked.input.as_deref(), file)?;
    let near = options.near.as_deref().map(|text| file.near(text)).transpose()?;
    let mut output = output;
    let mut exit = Exit::Complete;
    let mut results = Vec::new();
    let mut certificates = options.certificate.as_ref().map(|path| Certificates::new(path));
    for index in wanted {
        if stop.load(Ordering::Relaxed) {
            exit = Exit::Interrupted;
            break;
        }
        let case = &file.cases[index];
        let line = case.given.first().map_or(case.line, looproot::internal::kinematics::linkage::Given::line);
        let asked = Asked { complex: options.complex, stop: &stop, near: near.as_deref() };
        let answer = solve_or_move(file, case, asked).map_err(|error| error.at(&options.mechanism, line))?;
        exit = exit.max(code(&answer.verdict));
        // Complex assemblies that were asked for and not looked for, or that form curves.
        if options.complex && answer.verdict.is_of_real_ones() {
            exit = exit.max(Exit::NotProved);
        }
        if let Some(certificates) = &mut certificates {
            certificates.add_linkage(file, index + 1, case, &answer)?;
        }
        if options.json || options.jsonl {
            let result = report::result(file, case, index + 1, &answer, options.complex);
            if options.jsonl && !options.scene {
                writeln!(output.writer, "{result}")?;
                output.writer.flush()?;
            } else {
                results.push(result);
            }
        } else if options.quiet {
            writeln!(output.writer, "{}", report::headline(&answer.verdict))?;
        } else {
            let gap = if index > 0 && options.asked.input.is_none() { "\n" } else { "" };
            write!(output.writer, "{gap}{}", report::text(file, case, index + 1, &answer, options.complex))?;
        }
    }
    if stop.load(Ordering::Relaxed) {
        exit = Exit::Interrupted;
    }
    if options.json || options.scene {
        written(options, report::json(file, &results), &mut output)?;
    }
    if let Some(certificates) = &mut certificates {
        certificates.close()?;
    }
    output.writer.flush()?;
    Ok(exit)
}

/// Writes a document, with the scene where it is asked for; as lines the document comes first, then every result.
pub fn written(options: &SolveOptions, mut document: Value, output: &mut Output) -> Result<(), Fault> {
    if options.scene {
        drawable(&mut document)?;
    }
    if options.json {
        writeln!(output.writer, "{document:#}")?;
        return Ok(());
    }
    let results = document["results"].take();
    if let Some(object) = document.as_object_mut() {
        object.remove("results");
    }
    writeln!(output.writer, "{}", json!({ "document": document }))?;
    for result in results.as_array().into_iter().flatten() {
        writeln!(output.writer, "{result}")?;
    }
    Ok(())
}

/// Returns the exit code of a verdict.
pub fn code(verdict: &Verdict) -> Exit {
    match (verdict.status, verdict.proof) {
        (Status::Complete, Proof::Proved) => Exit::Complete,
        (Status::Unreachable, Proof::Proved) => Exit::Unreachable,
        (Status::Unsupported, _) => Exit::Unsupported,
        _ => Exit::NotProved,
    }
}

/// Refuses the options that linkages on the sphere and in space do not have.
pub fn refuse_beside_plane(options: &SolveOptions) -> Result<(), Error> {
    if options.near.is_some() {
        return Err(Error::Invalid("found --near for a linkage that is not in the plane, which has none".to_owned()));
    }
    refuse(options)
}

/// Refuses the options that linkages do not have.
fn refuse(options: &SolveOptions) -> Result<(), Error> {
    let found = [
        (options.poses.is_some(), "--poses"),
        (options.derivatives, "--derivatives"),
        (options.turns, "--turns"),
        (options.tolerance.is_some(), "--tolerance"),
    ];
    if options.scene && !options.json && !options.jsonl {
        return Err(Error::Invalid("found --scene alone, expected it with --json or --jsonl".to_owned()));
    }
    match found.iter().find(|(is_there, _)| *is_there) {
        Some((_, option)) => Err(Error::Invalid(format!("found {option} for a linkage, which has none"))),
        None => Ok(()),
    }
}

/// Returns the file, with the case of `--input JOINT=VALUE` instead of its own if that is given.
pub fn posed<'f>(input: Option<&str>, file: &'f LinkageFile) -> Result<Cow<'f, LinkageFile>, Error> {
    match input {
        Some(text) if text.contains('=') => {
            Ok(Cow::Owned(LinkageFile { cases: vec![file.case_with(text)?], ..file.clone() }))
        }
        _ => Ok(Cow::Borrowed(file)),
    }
}

/// Returns the requested cases: all, or the one of `--input`.
pub fn wanted(input: Option<&str>, file: &LinkageFile) -> Result<std::ops::Range<usize>, Error> {
    let Some(asked) = input else { return Ok(0..file.cases.len()) };
    if asked.contains('=') {
        return Ok(0..1);
    }
    match asked.trim().parse::<usize>() {
        Ok(number) if (1..=file.cases.len()).contains(&number) => Ok(number - 1..number),
        _ => {
            let message = format!(
                "found --input {asked}, expected JOINT=VALUE or the number of an input of the file, 1 to {}",
                file.cases.len()
            );
            Err(Error::Invalid(message))
        }
    }
}
