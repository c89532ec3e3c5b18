//! `looproot sweep` for linkages.

use super::arguments::SweepOptions;
use super::certificates::Certificates;
use super::exit::{Exit, Fault};
use super::instant::named;
use super::output::{Output, pool};
use super::sweep::{judged, range};
use looproot::internal::catalogue::LinkageFile;
use looproot::internal::error::Error;
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::kinematics::linkage::Given;
use looproot::internal::report::axodes;
use looproot::internal::report::certificate::certificate_of_linkage_sweep;
use looproot::internal::report::linkage_sweep::{self as report, Asked, Traced};
use looproot::internal::report::ratio::Ratio;
use looproot::internal::sweep::{count_limits, sweep_linkage};
use looproot::internal::view::drawable;
use std::io::Write;

/// Sweeps a joint through its range and prints the branches.
pub fn run(
    options: &SweepOptions,
    file: &LinkageFile,
    open: impl FnOnce() -> Result<Output, Fault>,
) -> Result<Exit, Fault> {
    let traced = match &options.trace {
        Some(asked) => {
            let (body, _, place) = file.point(asked)?;
            Some(Traced { body, name: asked.clone(), place })
        }
        None => None,
    };
    if options.axodes.is_some() {
        return Err(Error::Invalid("found --axodes for a linkage in the plane, expected --centrodes".to_owned()).into());
    }
    let rolling = options.centrodes.as_ref().map(|name| named(file, name)).transpose()?;
    let case = &file.cases[0];
    let joint = joint_of(options, file, &case.given)?;
    let is_length = file.linkage.joints[joint].is_prismatic();
    let variable = if is_length { Variable::Translation } else { Variable::Rotation };
    let range = range(options, variable, &file.reading)?;
    let follower = options.ratio.as_ref().map(|name| joint_named(file, "--ratio", name)).transpose()?;
    let pool = pool(options.threads)?;
    let found = pool.install(|| sweep_linkage(&file.linkage, file.given(case), joint, range, || ()));
    let mut found = found.map_err(|error| error.at(&options.mechanism, case.line))?;
    Certificates::write_one(options.certificate.as_ref(), || certificate_of_linkage_sweep(file, &found))?;
    // Pictures, whose documents have a scene, have no use for the number.
    if options.json && !options.scene {
        count_limits(&mut found, &file.linkage, file.given(case));
    }
    let asked = Asked { file, traced: traced.as_ref() };
    let ratio = follower.map(|follower| Ratio::of_plane(file, &found, follower));
    let mut output = open()?;
    let out = &mut output.writer;
    match &traced {
        _ if options.json => {
            let mut document = report::json(asked, &found);
            if let Some(body) = rolling {
                axodes::of_plane(&mut document, file, &found, body);
            }
            if let Some(ratio) = &ratio {
                ratio.insert(&mut document);
            }
            if options.scene {
                drawable(&mut document)?;
            }
            writeln!(out, "{document}")?;
        }
        None if options.svg => write!(out, "{}", report::joints_svg(file, &found))?,
        Some(traced) if options.svg => write!(out, "{}", report::svg(file, traced, &found))?,
        _ if options.csv => {
            let text = report::csv(asked, &found);
            write!(out, "{}", ratio.map_or(text.clone(), |ratio| ratio.csv(&text)))?;
        }
        _ if options.quiet => writeln!(out, "{}", report::verdict(&found))?,
        _ => {
            let input = &file.linkage.joints[joint].name;
            let more = ratio.map_or(String::new(), |ratio| ratio.text(input, is_length));
            write!(out, "{}{more}", report::text(asked, &found))?;
        }
    }
    out.flush()?;
    Ok(judged(&found.verdict))
}

/// Returns the requested joint, by name, or the first given one of the file.
fn joint_of(options: &SweepOptions, file: &LinkageFile, given: &[Given]) -> Result<usize, Error> {
    let Some(name) = &options.joint else {
        let first = given.iter().find_map(|one| match one {
            Given::Turn { joint, .. } | Given::Shift { joint, .. } => Some(*joint),
            Given::Place { .. } => None,
        });
        return first.ok_or_else(|| Error::Invalid("found no joint given in the file, expected --joint".to_owned()));
    };
    joint_named(file, "--joint", name)
}

/// Returns a joint that has a value by its name.
fn joint_named(file: &LinkageFile, option: &str, name: &str) -> Result<usize, Error> {
    let joints = &file.linkage.joints;
    let found = joints.iter().position(|joint| joint.name == *name && !joint.is_gear());
    found.ok_or_else(|| {
        let known: Vec<&str> =
            joints.iter().filter(|joint| !joint.is_gear()).take(12).map(|joint| joint.name.as_str()).collect();
        Error::Invalid(format!("found {option} {name}, expected one of {}", known.join(", ")))
    })
}
