//! `looproot solve` and `looproot sweep` for linkages in space.

use super::arguments::{SolveOptions, SweepOptions};
use super::certificates::not_covered;
use super::exit::{Exit, Fault};
use super::instant::among;
use super::linkage::{code, refuse_beside_plane, written};
use super::output::{Output, pool};
use super::sweep::{judged, progress, range};
use looproot::internal::catalogue::SpaceFile;
use looproot::internal::error::Error;
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::linkage::space::solve;
use looproot::internal::report::axodes;
use looproot::internal::report::linkage::headline;
use looproot::internal::report::ratio::Ratio;
use looproot::internal::report::space as report;
use looproot::internal::report::space_sweep as sweeps;
use looproot::internal::sweep::sweep_space;
use looproot::internal::view::drawable;
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
            if options.jsonl && !options.scene {
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
    if options.json || options.scene {
        written(options, report::json(file, &results), &mut output)?;
    }
    output.writer.flush()?;
    Ok(exit)
}

/// Returns a joint that has a value by its name, as an option says it.
fn joint_named(file: &SpaceFile, option: &str, name: &str) -> Result<usize, Error> {
    let joints = &file.linkage.joints;
    let found = joints.iter().position(|joint| joint.name == *name && joint.is_distance().is_some());
    found.ok_or_else(|| {
        let valued = joints.iter().filter(|joint| joint.is_distance().is_some());
        let known: Vec<&str> = valued.take(12).map(|joint| joint.name.as_str()).collect();
        let name: String = name.chars().take(40).collect();
        Error::Invalid(format!("found {option} {name}, expected one of {}", known.join(", ")))
    })
}

/// Sweeps a joint through its range and prints the branches.
pub fn sweep(
    options: &SweepOptions,
    file: &SpaceFile,
    open: impl FnOnce() -> Result<Output, Fault>,
) -> Result<Exit, Fault> {
    if options.centrodes.is_some() {
        return Err(Error::Invalid("found --centrodes for a linkage in space, expected --axodes".to_owned()).into());
    }
    let (linkage, case) = (&file.linkage, &file.cases[0]);
    let rolling = options.axodes.as_ref().map(|name| among(linkage.bodies.iter().map(|body| body.name.as_str()), name));
    let rolling = rolling.transpose()?;
    let traced = match &options.trace {
        Some(asked) => {
            let (body, _, place) = file.point(asked)?;
            Some((body, asked.clone(), place))
        }
        None => None,
    };
    let follower = options.ratio.as_ref().map(|name| joint_named(file, "--ratio", name)).transpose()?;
    let joint = match &options.joint {
        Some(name) => joint_named(file, "--joint", name)?,
        None => case
            .given
            .iter()
            .find_map(|given| given.joint)
            .ok_or_else(|| Error::Invalid("found no joint given in the file, expected --joint".to_owned()))?,
    };
    let is_length = linkage.joints[joint].is_distance() == Some(true);
    let variable = if is_length { Variable::Translation } else { Variable::Rotation };
    let range = range(options, variable, &file.reading)?;
    let mut output = open()?;
    let bar = progress(options, &output);
    let found = pool(options.threads)?.install(|| sweep_space(file, joint, range, || bar.inc(1)));
    let found = found.map_err(|error| error.at(&options.mechanism, case.line))?;
    bar.finish_and_clear();
    not_covered(options.certificate.as_ref(), "linkages in space");
    let (out, traced) = (&mut output.writer, traced.as_ref());
    let ratio = follower.map(|follower| Ratio::of_space(file, &found, follower));
    if options.json {
        let mut document = sweeps::json(file, traced, &found);
        if let Some(body) = rolling {
            axodes::of_space(&mut document, file, &found, body);
        }
        if let Some(ratio) = &ratio {
            ratio.insert(&mut document);
        }
        if options.scene {
            drawable(&mut document)?;
        }
        writeln!(out, "{document}")?;
    } else if options.svg {
        write!(out, "{}", sweeps::svg(file, traced, &found))?;
    } else if options.csv {
        let text = sweeps::csv(file, traced, &found);
        write!(out, "{}", ratio.map_or(text.clone(), |ratio| ratio.csv(&text)))?;
    } else if options.quiet {
        writeln!(out, "{}", sweeps::verdict(&found))?;
    } else {
        let more = ratio.map_or(String::new(), |ratio| ratio.text(&linkage.joints[joint].name, is_length));
        write!(out, "{}{more}", sweeps::text(file, &found))?;
    }
    out.flush()?;
    Ok(judged(&found.verdict))
}
