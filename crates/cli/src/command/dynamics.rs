//! `looproot dynamics`

use super::arguments::DynamicsOptions;
use super::exit::{Exit, Fault, unexpected};
use super::linkage::{code, posed, wanted};
use super::output::Output;
use looproot::internal::catalogue::{Any, load_any};
use looproot::internal::error::Error;
use looproot::internal::linkage::answer::solve;
use looproot::internal::report::dynamics::{Asked, result, text};
use looproot::internal::report::linkage as report;
use std::io::Write;

/// Maximum number of rows of a motion.
const MOST_STEPS: usize = 100_000;

/// Finds every assembly of the requested cases, its equation of motion, and a motion from one of them.
pub fn run(options: &DynamicsOptions) -> Result<Exit, Fault> {
    let file = match load_any(&options.mechanism, &options.read.options())? {
        Any::Linkage(file) => file,
        other => return Err(unexpected(&options.mechanism, other.kind(), "a linkage")),
    };
    if file.masses.is_empty() {
        let message = "found no mass of a body, expected [mechanism.mass] with one at least";
        return Err(Error::Invalid(message.to_owned()).into());
    }
    let asked = Asked { rates: rates(&options.rate)?, forces: options.forces, motion: motion(options)? };
    let mut output = Output::open(&options.output, &options.mechanism)?;
    let mut exit = Exit::Complete;
    let mut results = Vec::new();
    let file = posed(options.input.as_deref(), &file)?;
    for index in wanted(options.input.as_deref(), &file)? {
        let case = &file.cases[index];
        if case.given.is_empty() {
            let message = "found no input of the linkage, expected an [[input]], which is the coordinate";
            return Err(Error::Invalid(message.to_owned()).at(&options.mechanism, case.line).into());
        }
        let answer = solve(&file.linkage, &case.given, file.accuracy(case))
            .map_err(|error| error.at(&options.mechanism, case.line))?;
        exit = exit.max(code(&answer.verdict));
        if asked.motion.is_some() {
            // Steps in time are a measurement.
            exit = exit.max(Exit::NotProved);
        }
        let found = result(&file, case, index + 1, &answer, &asked);
        if options.json {
            results.push(found);
        } else {
            write!(output.writer, "{}", text(&file, &answer, &found))?;
        }
    }
    if options.json {
        writeln!(output.writer, "{:#}", report::json(&file, &results))?;
    }
    output.writer.flush()?;
    Ok(exit)
}

/// Reads the rates of the inputs, separated by commas.
fn rates(text: &str) -> Result<Vec<f64>, Error> {
    let one = |part: &str| {
        let found = part.trim().parse::<f64>().ok().filter(|x| x.is_finite());
        found.ok_or_else(|| {
            let part: String = part.trim().chars().take(40).collect();
            Error::Invalid(format!("found `{part}` in --rate, expected numbers such as 2 or \"1, -2\""))
        })
    };
    text.split(',').map(one).collect()
}

/// Returns mode, time and rows of the requested motion.
fn motion(options: &DynamicsOptions) -> Result<Option<(usize, f64, usize)>, Error> {
    let Some(time) = options.time else { return Ok(None) };
    if !(time.is_finite() && time > 0.0) {
        return Err(Error::Invalid(format!("found --time {time}, expected a positive number of seconds")));
    }
    if !(1..=MOST_STEPS).contains(&options.steps) {
        return Err(Error::Invalid(format!("found --steps {}, expected 1 to {MOST_STEPS}", options.steps)));
    }
    Ok(Some((options.from, time, options.steps)))
}
