//! `looproot sweep`

use super::arguments::SweepOptions;
use super::certificates::{Certificates, not_covered};
use super::exit::{Exit, Fault, unexpected};
use super::output::{Output, pool};
use super::seed::plant;
use super::solve::stop_on_interrupt;
use super::space_instant::link;
use super::wanted::in_place;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use looproot::internal::catalogue::entry::{Design, Entry};
use looproot::internal::catalogue::turn::turn;
use looproot::internal::catalogue::{Any, Chains, Options, load_solvable};
use looproot::internal::error::Error;
use looproot::internal::kinematics::chain::{Chain, JointKind};
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::kinematics::freedom::Freedom;
use looproot::internal::report::axodes;
use looproot::internal::report::certificate::certificate_of_sweep;
use looproot::internal::report::document::complete;
use looproot::internal::report::picture::svg;
use looproot::internal::report::ratio::Ratio;
use looproot::internal::report::scene;
use looproot::internal::report::sweep::{self as report, Swept};
use looproot::internal::report::text::variables;
use looproot::internal::scene::Stage;
use looproot::internal::sweep::{Range, Sweep, SweepVerdict, sweep};
use looproot::internal::verdict::Status;
use looproot_algebra::number::{Number, Quantity, Reading};
use std::io::Write;
use std::sync::atomic::Ordering;

/// Sweeps an input through its range and prints the branches.
pub fn run(options: &SweepOptions) -> Result<Exit, Fault> {
    run_to(options, || Output::open(&options.output, &options.mechanism))
}

/// As [`run`], with output to `open`, which is called once the mechanism is read.
pub fn run_to(options: &SweepOptions, open: impl FnOnce() -> Result<Output, Fault>) -> Result<Exit, Fault> {
    plant(options.drawn.seed);
    // The input is that of the command line, if given.
    let chains = if options.joint.is_some() { Chains::Swept } else { Chains::Solved };
    let entry = match load_solvable(&options.mechanism, &Options { chains, ..options.read.options() })? {
        Any::Entry(entry) => *entry,
        Any::Linkage(file) => return super::linkage_sweep::run(options, &file, open),
        Any::Sphere(file) => return super::sphere::sweep(options, &file, open),
        Any::Space(file) => return super::space::sweep(options, &file, open),
        other => {
            return Err(unexpected(
                &options.mechanism,
                other.kind(),
                "a loop, a linkage or a platform, which has an input to sweep",
            ));
        }
    };
    if options.trace.is_some() {
        return Err(unexpected(&options.mechanism, entry.kind().into(), "a linkage, whose points have curves"));
    }
    let chain = match &entry.design {
        Design::Loop(chain) => chain,
        Design::Platform(_) => {
            not_covered(options.certificate.as_ref(), "platforms");
            return super::platform_sweep::run(options, &entry, open);
        }
        Design::Arm(_) => {
            let expected = "a loop, a linkage or a platform, which has an input to sweep";
            return Err(unexpected(&options.mechanism, entry.kind().into(), expected));
        }
    };
    if options.centrodes.is_some() {
        return Err(Error::Invalid("found --centrodes for a loop, expected --axodes".to_owned()).into());
    }
    let rolling = options.axodes.as_ref().map(|name| link(name, chain.joint_kinds().len())).transpose()?;
    let swept = swept(options, &entry, chain)?;
    let range = range(options, swept.variable, &entry.reading)?;
    let follower = options.ratio.as_ref().map(|name| variable(chain, name)).transpose()?;
    let output = open()?;
    let progress = progress(options, &output);
    let stop = stop_on_interrupt();
    let running = || !stop.load(Ordering::Relaxed);
    let pool = pool(options.threads)?;
    let found = pool.install(|| sweep(&entry, swept.joint, swept.variable, range, running, || progress.inc(1)));
    let found = found.map_err(|error| in_place(error, &options.mechanism, &entry))?;
    progress.finish_and_clear();
    Certificates::write_one(options.certificate.as_ref(), || certificate_of_sweep(&entry, swept, &found))?;
    let ratio = follower.map(|follower| {
        let follower = (follower.0, follower.1.as_str());
        Ratio::of_loop(&entry, (swept.joint, swept.variable), &found, follower)
    });
    let more = More { rolling, ratio: ratio.transpose()? };
    write(options, &entry, swept, (&found, &more), output)?;
    Ok(exit(&found))
}

/// Returns a bar that counts the inputs of a sweep.
pub fn progress(options: &SweepOptions, output: &Output) -> ProgressBar {
    let target = if output.is_terminal || options.quiet {
        ProgressDrawTarget::hidden()
    } else {
        // The bar hides itself if stderr is no terminal.
        ProgressDrawTarget::stderr()
    };
    let progress = ProgressBar::with_draw_target(Some(options.steps as u64 + 1), target);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} {per_sec} {eta}") {
        progress.set_style(style);
    }
    progress
}

/// What is requested beside the branches.
struct More {
    /// The body whose axodes are requested.
    rolling: Option<usize>,
    ratio: Option<Ratio>,
}

/// Returns a variable of a loop by its name, `q3`, `d3` or `3`, and its place among all.
fn variable(chain: &Chain, asked: &str) -> Result<(usize, String), Error> {
    let names: Vec<String> = variables(chain).into_iter().map(|(name, _)| name).collect();
    let is_named = |name: &&String| *name == asked || name[1..] == *asked;
    let found = names.iter().find(is_named).and_then(|name| names.iter().position(|own| own == name));
    let found = found.map(|index| (index, names[index].clone()));
    found.ok_or_else(|| {
        let asked: String = asked.chars().take(40).collect();
        Error::Invalid(format!("found --ratio {asked}, expected one of {}", names.join(", ")))
    })
}

fn write(
    options: &SweepOptions,
    entry: &Entry,
    swept: Swept,
    (found, more): (&Sweep, &More),
    mut output: Output,
) -> Result<(), Fault> {
    let out = &mut output.writer;
    if options.json {
        let mut document = report::json(entry, swept, found);
        if let Some(body) = more.rolling {
            axodes::of_loop(&mut document, entry, (swept.joint, swept.variable), body)?;
        }
        if let Some(ratio) = &more.ratio {
            ratio.insert(&mut document);
        }
        complete(&mut document, entry);
        if let Some(stage) = Stage::of(entry).filter(|_| options.scene) {
            document["scene"] = scene::json(&stage.scene);
            scene::pose_sweep(&mut document, &stage);
        }
        writeln!(out, "{document}")?;
    } else if options.svg {
        write!(out, "{}", svg(entry, swept, found))?;
    } else if options.csv {
        let text = report::csv(entry, found);
        write!(out, "{}", more.ratio.as_ref().map_or(text.clone(), |ratio| ratio.csv(&text)))?;
    } else if options.quiet {
        writeln!(out, "{}", report::verdict(found))?;
    } else {
        write!(out, "{}", report::text(entry, swept, found))?;
        if let Some(ratio) = &more.ratio {
            let letter = if swept.variable == Variable::Rotation { "q" } else { "d" };
            let text = ratio.text(&format!("{letter}{}", swept.joint), swept.variable == Variable::Translation);
            write!(out, "{text}")?;
        }
        if let Some(chain) = entry.chain().filter(|_| found.branches.is_empty()) {
            writeln!(out, "\nthe loop has {}; `looproot mobility` decides whether it moves", Freedom::of(chain))?;
        }
    }
    Ok(out.flush()?)
}

fn exit(found: &Sweep) -> Exit {
    if found.samples.len() <= found.range.steps {
        return Exit::Interrupted;
    }
    judged(&found.verdict)
}

/// The exit code of the verdict on a whole sweep.
pub fn judged(verdict: &SweepVerdict) -> Exit {
    match (verdict.proof.is_proved(), verdict.status) {
        (true, Status::Unreachable) => Exit::Unreachable,
        (true, _) => Exit::Complete,
        _ => Exit::NotProved,
    }
}

/// Returns the joint variable to sweep: the requested one, or the input of the file.
fn swept(options: &SweepOptions, entry: &Entry, chain: &Chain) -> Result<Swept, Error> {
    let Some(name) = &options.joint else {
        let input = entry.cases.first().and_then(|case| case.input.first());
        let input = input.ok_or_else(|| Error::Invalid("found no input in the file, expected --joint".to_owned()))?;
        return Ok(Swept { joint: input.joint, variable: input.value.variable() });
    };
    let kinds = chain.joint_kinds();
    let found = |what: &str| Error::Invalid(format!("found --joint {name}, {what}"));
    let (letter, digits) = match name.trim().split_at_checked(1) {
        Some((letter @ ("q" | "d"), digits)) => (letter, digits),
        _ => ("", name.trim()),
    };
    let joint: usize = digits.parse().map_err(|_| found("expected the number of a joint, or q3, or d3"))?;
    let kind = joint.checked_sub(1).and_then(|index| kinds.get(index));
    let kind = kind.ok_or_else(|| {
        found(&format!("expected one from 1 to {}: the loop has {}", kinds.len(), Freedom::of(chain)))
    })?;
    let freedom = || Freedom::of(chain);
    if !kind.is_plain() {
        let plain = JointKind::letters(JointKind::is_plain, "or");
        return Err(found(&format!("which is {kind:?}; expected a joint {plain}: the loop has {}", freedom())));
    }
    // A joint that only slides has no other variable that could be meant.
    let variable = if letter == "d" || kind.only_translates() { Variable::Translation } else { Variable::Rotation };
    if !kind.takes(variable) {
        let message = "which turns and has no distance; expected q before its number";
        return Err(found(&format!("{message}: the loop has {}", freedom())));
    }
    Ok(Swept { joint, variable })
}

/// Reads the range of the input.
pub fn range(options: &SweepOptions, variable: Variable, reading: &Reading) -> Result<Range, Error> {
    let ends = [("--from", &options.from), ("--to", &options.to)];
    let [from, to] = ends.map(|(name, text)| end(name, text, variable, reading));
    let (from, to) = (from?, to?);
    if from == to {
        return Err(Error::Invalid(format!("found --from and --to both {}, expected a range", options.from)));
    }
    Ok(Range { from, to, steps: options.steps })
}

/// Reads an end of the range; a number without a unit has that of the file.
fn end(name: &str, text: &str, variable: Variable, reading: &Reading) -> Result<f64, Error> {
    let value = match variable {
        Variable::Rotation => turn(text, reading).map(|angle| angle.radians()),
        Variable::Translation => {
            Number::parse(text, Quantity::Length, reading).map(|length| length.to_f64()).map_err(Error::from)
        }
    };
    value.map_err(|fault| fault.of_option(name))
}
