//! `looproot instant`

use super::arguments::InstantOptions;
use super::exit::{Exit, Fault, unexpected};
use super::linkage::{code, posed, wanted};
use super::loads::{Named, loads};
use super::output::Output;
use super::space_instant;
use looproot::internal::catalogue::{Any, LinkageFile, Options, load_any};
use looproot::internal::error::Error;
use looproot::internal::linkage::answer::solve;
use looproot::internal::linkage::rates::pair;
use looproot::internal::report::instant::{Asked, AskedBody, result, text};
use looproot::internal::report::linkage as report;
use std::io::Write;

/// Finds every assembly of the requested cases, and the instantaneous motion of a body there.
pub fn run(options: &InstantOptions) -> Result<Exit, Fault> {
    let read = Options { chains: options.asked.chains(), ..options.read.options() };
    let file = match load_any(&options.mechanism, &read)? {
        Any::Linkage(file) => file,
        Any::Entry(entry) => return space_instant::of_chain(options, *entry),
        Any::Sphere(file) => return space_instant::of_sphere(options, &file),
        Any::Space(file) => return space_instant::of_space(options, &file),
        other => return Err(unexpected(&options.mechanism, other.kind(), "a linkage, a loop or an arm")),
    };
    if options.rate.is_some() {
        return Err(Error::Invalid("found --rate for a linkage, expected it for an arm".to_owned()).into());
    }
    let bodies = &file.linkage.bodies;
    let body = match &options.body {
        Some(name) => {
            let body = named(&file, name)?;
            let against = options.against.as_ref().map_or(Ok(file.linkage.ground), |name| named(&file, name))?;
            if body == against {
                let message = format!("found --body {name} against itself, expected two bodies");
                return Err(Error::Invalid(message).into());
            }
            let own = &bodies[body];
            let points = own.points.iter().map(|(name, _)| name.as_str());
            let point = options.point.as_ref().map(|asked| point_of(&own.name, points, asked)).transpose()?;
            Some(AskedBody { body, against, point, inverse: options.inverse })
        }
        None => None,
    };
    let names: Vec<Named<'_, 2>> = bodies
        .iter()
        .map(|body| (body.name.as_str(), body.points.iter().map(|(name, at)| (name.as_str(), pair(at))).collect()))
        .collect();
    let loads = options.loads.as_ref().map(|text| loads(text, &names)).transpose()?;
    let asked = Asked { body, loads: loads.as_deref() };
    let mut output = Output::open(&options.output, &options.mechanism)?;
    let mut exit = Exit::Complete;
    let mut results = Vec::new();
    let file = posed(options.asked.input.as_deref(), &file)?;
    for index in wanted(options.asked.input.as_deref(), &file)? {
        let case = &file.cases[index];
        if case.given.is_empty() {
            let message = "found no input of the linkage, expected an [[input]], which runs at unit rate";
            return Err(Error::Invalid(message.to_owned()).at(&options.mechanism, case.line).into());
        }
        let answer = solve(&file.linkage, &case.given, file.accuracy(case))
            .map_err(|error| error.at(&options.mechanism, case.line))?;
        exit = exit.max(code(&answer.verdict));
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

/// Returns the index of a body of a linkage in the plane by its name.
pub fn named(file: &LinkageFile, name: &str) -> Result<usize, Error> {
    among(file.linkage.bodies.iter().map(|body| body.name.as_str()), name)
}

/// Returns the index of a body by its name.
pub fn among<'a>(bodies: impl Iterator<Item = &'a str> + Clone, name: &str) -> Result<usize, Error> {
    bodies.clone().position(|body| body == name).ok_or_else(|| {
        let known: Vec<&str> = bodies.take(12).collect();
        let name: String = name.chars().take(40).collect();
        Error::Invalid(format!("found the unknown body `{name}`, expected one of {}", known.join(", ")))
    })
}

/// Returns the point of `BODY.P`, which must be one of these points of the requested body.
pub fn point_of<'a, 'p>(
    body: &str,
    points: impl Iterator<Item = &'p str> + Clone,
    asked: &'a str,
) -> Result<&'a str, Error> {
    let found = asked.strip_prefix(body).and_then(|rest| rest.strip_prefix('.'));
    found.filter(|name| points.clone().any(|own| own == *name)).ok_or_else(|| {
        let known: Vec<String> = points.take(12).map(|name| format!("{body}.{name}")).collect();
        let asked: String = asked.chars().take(40).collect();
        Error::Invalid(format!("found --point {asked}, expected one of {}", known.join(", ")))
    })
}
