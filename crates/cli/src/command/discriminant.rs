//! `looproot derive --discriminant`

use super::arguments::DeriveOptions;
use super::exit::{Exit, Fault};
use super::output::Output;
use super::solve::stop_on_interrupt;
use super::symbols::watched;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use looproot::internal::error::Error;
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::report::cells::{is_map_proved, json, map_json, map_text, map_verdict, text, verdict};
use looproot::internal::report::cells_picture::{map_svg, svg};
use looproot::internal::sweep::{MapWanted, Subject, cell_map, cells};
use looproot_algebra::number::{Angle, Number, Quantity, Reading};
use serde_json::Value;
use std::sync::atomic::Ordering;

/// A mechanism of which cells are printed.
pub struct Asked<'a, S> {
    /// What has the cells.
    pub subject: S,
    /// The title of its file.
    pub title: &'a str,
    /// How numbers of the file and of options are read.
    pub reading: &'a Reading,
    /// Adds the place in the file to an error.
    pub place: &'a dyn Fn(Error) -> Error,
    /// Adds the keys about the file to a document.
    pub document: &'a dyn Fn(Value) -> String,
}

/// Prints the cells of one parameter, or of two.
pub fn run<S: Subject>(
    options: &DeriveOptions,
    mechanism: &str,
    asked: &Asked<'_, S>,
    names: &str,
) -> Result<Exit, Fault> {
    let names: Vec<&str> = names.split(',').map(str::trim).filter(|name| !name.is_empty()).collect();
    let Asked { subject, title, reading, place, document } = asked;
    let (written, exit) = match names.as_slice() {
        [name] => {
            if options.from.is_some() {
                let message = format!(
                    "found --from with one parameter, {name}, whose cells have no ends; expected two parameters"
                );
                return Err(Error::Invalid(message).into());
            }
            let found = watched(options, |watch| cells(subject, name, watch)).map_err(place)?;
            let written = if options.json {
                document(json(&found))
            } else if options.svg {
                svg(title, &found)
            } else if options.quiet {
                verdict(&found) + "\n"
            } else {
                text(&found)
            };
            (written, if found.verdict.proof.is_proved() { Exit::Complete } else { Exit::NotProved })
        }
        [one, two] => {
            let range = range(options, reading, subject.parameter(one)?.kind)?;
            let stop = stop_on_interrupt();
            let running = || !stop.load(Ordering::Relaxed);
            let progress = progress(options);
            let wanted = MapWanted { parameters: [one, two], range, columns: options.columns };
            let found = cell_map(subject, wanted, running, || progress.inc(1)).map_err(place)?;
            progress.finish_and_clear();
            let written = if options.json {
                document(map_json(&found))
            } else if options.svg {
                map_svg(title, &found)
            } else if options.quiet {
                map_verdict(&found) + "\n"
            } else {
                map_text(&found)
            };
            let exit = match (found.columns.len() < options.columns, is_map_proved(&found)) {
                (true, _) => Exit::Interrupted,
                (_, true) => Exit::Complete,
                _ => Exit::NotProved,
            };
            (written, exit)
        }
        several => {
            let message = format!("found --discriminant with {} parameters, expected one or two", several.len());
            return Err(Error::Invalid(message).into());
        }
    };
    Output::write(&options.output, mechanism, &written)?;
    Ok(exit)
}

/// Returns the range of the first parameter, radians or metres.
fn range(options: &DeriveOptions, reading: &Reading, kind: Variable) -> Result<Option<[f64; 2]>, Error> {
    let (Some(from), Some(to)) = (&options.from, &options.to) else { return Ok(None) };
    let end = |name: &str, text: &str| {
        let value = match kind {
            Variable::Rotation => Angle::parse(text, reading).map(|angle| angle.radians()),
            Variable::Translation => Number::parse(text, Quantity::Length, reading).map(|length| length.to_f64()),
        };
        value.map_err(|error| match error.into() {
            Error::Invalid(message) => Error::Invalid(format!("{name}: {message}")),
            other => other,
        })
    };
    Ok(Some([end("--from", from)?, end("--to", to)?]))
}

/// Returns a progress bar, which hides itself if stderr is no terminal.
fn progress(options: &DeriveOptions) -> ProgressBar {
    let target = if options.quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let progress = ProgressBar::with_draw_target(Some(options.columns as u64), target);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} {per_sec} {eta}") {
        progress.set_style(style);
    }
    progress
}
