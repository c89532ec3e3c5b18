//! `looproot solve` for linkages in space.

use super::arguments::SolveOptions;
use super::exit::{Exit, Fault};
use super::linkage::{code, refuse_beside_plane, written};
use super::output::Output;
use looproot::internal::catalogue::SpaceFile;
use looproot::internal::error::Error;
use looproot::internal::linkage::space::solve;
use looproot::internal::report::linkage::headline;
use looproot::internal::report::space as report;
use std::borrow::Cow;
use std::io::Write;

/// Returns the file, with the case of `--input JOINT=VALUE` instead of its own if that is given.
pub fn posed<'f>(input: Option<&str>, file: &'f SpaceFile) -> Result<Cow<'f, SpaceFile>, Error> {
    match input {
        Some(text) if text.contains('=') => {
            Ok(Cow::Owned(SpaceFile { cases: vec![file.case_with(text)?], ..file.clone() }))
        }
        _ => Ok(Cow::Borrowed(file)),
    }
}

/// Returns the requested cases: all, or the one of `--input`.
pub fn wanted(input: Option<&str>, file: &SpaceFile) -> Result<std::ops::Range<usize>, Error> {
    let Some(asked) = input else { return Ok(0..file.cases.len()) };
    if asked.contains('=') {
        return Ok(0..1);
    }
    match asked.trim().parse::<usize>() {
        Ok(number) if (1..=file.cases.len()).contains(&number) => Ok(number - 1..number),
        _ => {
            let count = file.cases.len();
            let message = format!(
                "found --input {asked}, expected JOINT=VALUE or the number of an input of the file, 1 to {count}"
            );
            Err(Error::Invalid(message))
        }
    }
}

/// Finds every assembly of every case, or of the requested one.
pub fn run(options: &SolveOptions, file: &SpaceFile, output: Output) -> Result<Exit, Fault> {
    refuse_beside_plane(options)?;
    if options.scene {
        return Err(Error::Unsupported("linkages in space are not drawn yet".to_owned()).into());
    }
    let mut output = output;
    let mut exit = Exit::Complete;
    let mut results = Vec::new();
    let file = &*posed(options.asked.input.as_deref(), file)?;
    for index in wanted(options.asked.input.as_deref(), file)? {
        let case = &file.cases[index];
        let line = case.given.first().map_or(case.line, |given| given.line);
        let answer = solve(&file.linkage, &case.given, file.exact && case.exact)
            .map_err(|error| error.at(&options.mechanism, line))?;
        exit = exit.max(code(&answer.verdict));
        if options.json || options.jsonl {
            let result = report::result(file, case, index + 1, &answer, options.complex);
            if options.jsonl {
                writeln!(output.writer, "{result}")?;
            } else {
                results.push(result);
            }
        } else if options.quiet {
            writeln!(output.writer, "{}", headline(&answer.verdict))?;
        } else {
            let gap = if index > 0 && options.asked.input.is_none() { "\n" } else { "" };
            write!(output.writer, "{gap}{}", report::text(file, case, index + 1, &answer, options.complex))?;
        }
    }
    if options.json {
        written(options, report::json(file, &results), &mut output)?;
    }
    output.writer.flush()?;
    Ok(exit)
}
