//! `looproot synthesize`

use super::arguments::SynthesizeOptions;
use super::exit::{Exit, Fault, unexpected};
use super::output::Output;
use super::seed::plant;
use looproot::internal::catalogue::{Any, DyadKind, Space, Task, load_any};
use looproot::internal::error::Error;
use looproot::internal::report::synthesis::{defects, json, linkage, picture, text, verdict};
use looproot::internal::synthesis::{Answer, synthesize};
use looproot::internal::verdict::Status;

/// Finds all dyads of a file, or four-bars, and prints them or a linkage of them.
pub fn run(options: &SynthesizeOptions) -> Result<Exit, Fault> {
    let file = match load_any(&options.mechanism, &options.read.options())? {
        Any::Synthesis(file) => file,
        other => return Err(unexpected(&options.mechanism, other.kind(), "a synthesis")),
    };
    plant(options.drawn.seed);
    let mut answer = synthesize(&file);
    if let Some(near) = &options.near {
        answer.sort_near(&numbers(near)?)?;
    }
    let has_four_bars = match file.task {
        Task::Motion(DyadKind::RR, _) => file.space == Space::Plane,
        Task::Path(_) => true,
        _ => false,
    };
    if options.no_defects && !has_four_bars {
        let message = "found --no-defects, expected it for points of a path, or for positions and RR dyads in the plane, two of which make a four-bar";
        return Err(Error::Invalid(message.to_owned()).into());
    }
    let written = if let Some(list) = &options.linkage {
        linkage::toml(&file, &answer, &numbered(list)?)?
    } else if options.svg {
        picture::svg(&file, &answer)?
    } else if options.json {
        let mut document = json(&file, &answer, options.complex);
        if options.no_defects {
            defects::add(&mut document, &file, &answer);
        }
        format!("{document:#}\n")
    } else if options.quiet {
        verdict(&file, &answer) + "\n"
    } else {
        let table = if options.no_defects { defects::text(&file, &answer) } else { String::new() };
        text(&file, &answer, options.complex) + &table
    };
    Output::write(&options.output, &options.mechanism, &written)?;
    Ok(exit(&answer))
}

/// Reads numbers separated by commas.
fn numbers(text: &str) -> Result<Vec<f64>, Error> {
    let one = |part: &str| {
        let number = part.trim().parse::<f64>().ok().filter(|x| x.is_finite());
        number.ok_or_else(|| {
            Error::Invalid(format!("found `{}` in --near, expected numbers such as \"1, -2\"", part.trim()))
        })
    };
    text.split(',').map(one).collect()
}

/// Converts numbers of modes counted from 1 to numbers counted from 0.
fn numbered(text: &str) -> Result<Vec<usize>, Error> {
    let one = |part: &str| {
        let number = part.trim().parse::<usize>().ok().and_then(|number| number.checked_sub(1));
        number.ok_or_else(|| {
            Error::Invalid(format!("found `{}` in --linkage, expected numbers from 1, such as 1,3", part.trim()))
        })
    };
    text.split(',').map(one).collect()
}

fn exit(answer: &Answer) -> Exit {
    let is_proved = answer.verdict.proof.is_proved();
    match answer.verdict.status {
        Status::Complete if is_proved => Exit::Complete,
        Status::Unreachable if is_proved => Exit::Unreachable,
        Status::Unsupported => Exit::Unsupported,
        _ => Exit::NotProved,
    }
}
