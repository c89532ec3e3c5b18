//! `looproot solve --inverse`: the lengths of the legs of a platform at its poses, beside their limits.

use super::arguments::{Limits, SolveOptions};
use super::exit::{Exit, Fault, complain};
use super::output::{Output, pool};
use super::rows::{self, Row};
use super::solve::stop_on_interrupt;
use super::stream::ordered;
use super::wanted::wanted;
use looproot::internal::catalogue::entry::{Case, Design, Entry};
use looproot::internal::error::Error;
use looproot::internal::kinematics::platform::Platform;
use looproot::internal::kinematics::platform_limits::{Part, listed};
use looproot::internal::mechanism::platform_over;
use looproot::internal::report::document;
use looproot::internal::report::json::{head, number, words};
use looproot::internal::report::number::{counted, short};
use looproot_algebra::number::Number;
use rug::Rational;
use serde_json::{Value, json};
use std::borrow::Cow;
use std::io::Write;
use std::sync::atomic::Ordering;

/// A pose of the plate: one of the file, by its index, or a row of a table.
enum Job {
    Listed(usize),
    Row(Row),
}

/// The lengths of the legs at a pose.
struct Legs {
    lengths: [f64; 6],
    /// The legs and joints outside their limits.
    outside: Vec<Part>,
    warnings: Vec<String>,
}

/// Prints the lengths of the legs at every pose.
pub fn run(
    options: &SolveOptions,
    entry: &mut Entry,
    open: impl FnOnce() -> Result<Output, Fault>,
) -> Result<Exit, Fault> {
    let Design::Platform(geometry) = &entry.design else {
        return Err(Error::Invalid("found --inverse, expected it for a platform only".to_owned()).into());
    };
    let points = platform_over::<f64>(geometry);
    let points = points.ok_or_else(|| Error::Invalid("found points without numbers, expected some".to_owned()))?;
    let listed = if options.poses.is_some() { 0..0 } else { wanted(&options.asked, &options.mechanism, entry)? };
    let entry = &*entry;
    if let Some(case) = entry.cases[listed.clone()].iter().find(|case| case.pose.is_none()) {
        let message = "found legs, expected a pose beside --inverse: --at, --poses or a [[pose]] of the file";
        return Err(Error::Invalid(message.to_owned()).at(&options.mechanism, case.line).into());
    }
    let table = options.poses.as_ref().map(|path| rows::open(path, &entry.design, &entry.reading)).transpose()?;
    let (reader, rows) = table.unzip();
    let jobs = listed.map(Job::Listed).chain(rows.into_iter().flatten().map(Job::Row));
    let work = |(): &mut (), job: &Job| -> Result<Legs, Error> {
        let case = match (job, &reader) {
            (Job::Listed(index), _) => Cow::Borrowed(&entry.cases[*index]),
            (Job::Row(row), Some(reader)) => Cow::Owned(row.case(reader)?),
            (Job::Row(_), None) => return Err(Error::Invalid("a row without a table".to_owned())),
        };
        legs(entry, &points, &case)
    };
    let mut report = Report { options, entry, output: open()?, written: 0, counts: [0; 3] };
    report.begin()?;
    let stop = stop_on_interrupt();
    let mut number = 0;
    let mut is_whole = true;
    let take = |batch: Vec<(Job, Result<Legs, Error>)>| -> Result<bool, Fault> {
        for (job, legs) in batch {
            number += 1;
            match (&job, &legs) {
                (Job::Listed(index), _) => report.add(index + 1, None, &legs)?,
                (Job::Row(row), _) => report.add(number, Some(row.line), &legs)?,
            }
        }
        report.output.writer.flush()?;
        is_whole = !stop.load(Ordering::Relaxed);
        Ok(is_whole)
    };
    let pool = pool(options.threads)?;
    ordered(&pool, jobs, || (), work, take)?;
    report.end()?;
    let has_bad_rows = report.counts[2] > 0;
    Ok(if !is_whole {
        Exit::Interrupted
    } else if has_bad_rows {
        Exit::Misuse
    } else {
        Exit::Complete
    })
}

/// Returns the lengths of the legs of a case.
fn legs(entry: &Entry, points: &Platform<f64>, case: &Case) -> Result<Legs, Error> {
    let missing = || Error::Invalid("found a case without legs, expected a pose".to_owned());
    let squares: &[Number; 6] = case.legs_squared.as_ref().ok_or_else(missing)?;
    let pose = &case.pose.as_ref().ok_or_else(missing)?.float;
    let exact: [Rational; 6] = squares.each_ref().map(|square| square.rational().clone());
    let mut outside = entry.platform_limits.legs_outside(&exact);
    outside.extend(entry.platform_limits.joints_outside(points, pose));
    let lengths = squares.each_ref().map(|square| square.to_f64().sqrt());
    Ok(Legs { lengths, outside, warnings: case.warnings.clone() })
}

/// The output, written as it comes.
struct Report<'a> {
    options: &'a SolveOptions,
    entry: &'a Entry,
    output: Output,
    written: usize,
    /// The numbers of poses within the limits, outside them, and of rows without a pose.
    counts: [usize; 3],
}

impl Report<'_> {
    fn is_limited(&self) -> bool {
        !self.entry.platform_limits.is_empty()
    }

    fn begin(&mut self) -> Result<(), Fault> {
        let out = &mut self.output.writer;
        if self.options.json {
            write!(out, "{}", head(self.entry, &document::keys(self.entry)))?;
        } else if !self.options.jsonl && !self.options.quiet {
            write!(out, "{:>8} ", "pose")?;
            for leg in 1..=6 {
                write!(out, "{:>14}", format!("leg {leg} [m]"))?;
            }
            writeln!(out)?;
        }
        Ok(())
    }

    /// Writes the legs at a pose, or the reason why a row is none.
    fn add(&mut self, case: usize, line: Option<usize>, legs: &Result<Legs, Error>) -> Result<(), Fault> {
        let legs = match (legs, line) {
            (Ok(legs), _) => legs,
            (Err(error), Some(line)) => return self.refuse(case, line, error),
            (Err(error), None) => return Err(error.clone().into()),
        };
        self.counts[usize::from(!legs.outside.is_empty())] += 1;
        if self.options.limits == Limits::Drop && !legs.outside.is_empty() {
            return Ok(());
        }
        if self.options.json || self.options.jsonl {
            let mut value = json!({ "case": case, "legs": legs.lengths.map(number), "warnings": legs.warnings });
            if self.is_limited() {
                value["within_limits"] = json!(legs.outside.is_empty());
                value["outside"] = words(&legs.outside);
            }
            return self.write_value(&value);
        }
        if self.options.quiet {
            return Ok(());
        }
        let lengths =
            legs.lengths.iter().fold(String::new(), |text, length| text + &format!("{:>14}", short(*length, 9)));
        let outside = listed(&legs.outside);
        let outside = if outside.is_empty() { outside } else { format!("  outside: {outside}") };
        writeln!(self.output.writer, "{case:>8} {lengths}{outside}")?;
        for warning in &legs.warnings {
            writeln!(self.output.writer, "warning: {warning}")?;
        }
        Ok(())
    }

    fn refuse(&mut self, case: usize, line: usize, error: &Error) -> Result<(), Fault> {
        self.counts[2] += 1;
        if !self.options.json && !self.options.jsonl {
            complain(&error.to_string());
            return Ok(());
        }
        let message = match error {
            Error::File { message, .. } => message.clone(),
            other => other.to_string(),
        };
        self.write_value(&json!({ "case": case, "line": line, "error": { "code": "bad-row", "message": message } }))
    }

    fn write_value(&mut self, value: &Value) -> Result<(), Fault> {
        let out = &mut self.output.writer;
        match (self.options.json, self.written) {
            (false, _) => writeln!(out, "{value}")?,
            (true, 0) => write!(out, "\n  {value}")?,
            (true, _) => write!(out, ",\n  {value}")?,
        }
        self.written += 1;
        Ok(())
    }

    fn end(&mut self) -> Result<(), Fault> {
        let [within, outside, refused] = self.counts;
        let is_limited = self.is_limited();
        let out = &mut self.output.writer;
        if self.options.json {
            writeln!(out, "\n] }}")?;
        } else if !self.options.jsonl {
            let limits = if is_limited { format!(", {within} within the limits") } else { String::new() };
            let bad = if refused > 0 { format!(", {} without a pose", counted(refused, "row")) } else { String::new() };
            writeln!(out, "{}{limits}{bad}", counted(within + outside, "pose"))?;
        }
        Ok(out.flush()?)
    }
}
