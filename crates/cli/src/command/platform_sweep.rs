//! `looproot sweep` for a leg of a platform.

use super::arguments::SweepOptions;
use super::exit::{Exit, Fault};
use super::output::{Output, pool};
use super::sweep::range;
use looproot::internal::catalogue::entry::Entry;
use looproot::internal::error::Error;
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::report::document::complete;
use looproot::internal::report::platform_sweep as report;
use looproot::internal::report::scene;
use looproot::internal::scene::Stage;
use looproot::internal::sweep::sweep_platform;
use std::io::Write;

/// Sweeps the length of a leg through its range and prints the branches.
pub fn run(options: &SweepOptions, entry: &Entry, open: impl FnOnce() -> Result<Output, Fault>) -> Result<Exit, Fault> {
    if options.ratio.is_some() {
        return Err(
            Error::Invalid("found --ratio for a platform, expected it for a loop or a linkage".to_owned()).into()
        );
    }
    let leg = leg(options)?;
    if entry.cases.is_empty() {
        let message =
            "found no lengths of the legs in the file, expected `legs` or a [[pose]]: a sweep holds five of them";
        return Err(Error::Invalid(message.to_owned()).at(&options.mechanism, 1).into());
    }
    let range = range(options, Variable::Translation, &entry.reading)?;
    let pool = pool(options.threads)?;
    let found = pool.install(|| sweep_platform(entry, leg, range, || ()))?;
    let mut output = open()?;
    let out = &mut output.writer;
    if options.json {
        let mut document = report::json(entry, &found);
        complete(&mut document, entry);
        if let Some(stage) = Stage::of(entry).filter(|_| options.scene) {
            document["scene"] = scene::json(&stage.scene);
            scene::pose_sweep(&mut document, &stage);
        }
        writeln!(out, "{document}")?;
    } else if options.svg {
        write!(out, "{}", report::svg(entry, &found))?;
    } else if options.csv {
        write!(out, "{}", report::csv(&found))?;
    } else if options.quiet {
        writeln!(out, "{}", report::verdict(&found))?;
    } else {
        write!(out, "{}", report::text(entry, &found))?;
    }
    out.flush()?;
    // Between the lengths nothing is proved.
    Ok(Exit::NotProved)
}

/// Returns the leg to sweep, counted from 0: `leg3` or `3`.
fn leg(options: &SweepOptions) -> Result<usize, Error> {
    let expected = "expected a leg, leg1 to leg6";
    let Some(name) = &options.joint else {
        return Err(Error::Invalid(format!("found a platform and no --joint, {expected}")));
    };
    let number = name.trim().trim_start_matches("leg").parse::<usize>().ok();
    let leg = number.and_then(|number| number.checked_sub(1)).filter(|leg| *leg < 6);
    leg.ok_or_else(|| Error::Invalid(format!("found --joint {name}, {expected}")))
}
