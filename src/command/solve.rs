//! `looproot solve`

use super::arguments::{Limits, SolveOptions};
use super::exit::{Exit, Fault};
use super::output::{Output, pool};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use looproot::algebra::number::{Angle, Number, Quantity, Reading};
use looproot::assembly::{Assembly, Roots, Workspace};
use looproot::catalogue::entry::{Case, Entry, Expected, Input, InputValue, Kind};
use looproot::catalogue::load;
use looproot::error::Error;
use looproot::kinematics::chain::Placement;
use looproot::kinematics::closed_loop::{Layout, Variable, angle_motion, distance_motion};
use looproot::mechanism::{Mechanism, Solution};
use looproot::report::json;
use looproot::report::number::{counted, duration};
use looproot::report::text::{self, View};
use looproot::verdict::{Status, Verdict};
use rayon::prelude::*;
use std::io::Write;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Finds every solution of every case, or of the one asked for, and prints them in the order of the file.
pub fn run(options: &SolveOptions) -> Result<Exit, Fault> {
    let mut entry = load(&options.mechanism, &options.read.options())?;
    let wanted = wanted(options, &mut entry)?;
    let mut report = Report::open(options, &entry, wanted.len())?;
    let exit = match Mechanism::prepare(&entry) {
        Ok(mechanism) => solve(options, &entry, &mechanism, wanted, &mut report)?,
        // The document of a mechanism that cannot be solved says so, case by case.
        Err(error @ Error::Unsupported(_)) if report.is_json() => {
            for index in wanted {
                report.add(index, &unsupported(&error))?;
            }
            Exit::Unsupported
        }
        Err(error) => return Err(error.into()),
    };
    report.close()?;
    Ok(exit)
}

/// Solves the cases on all threads, some at a time, and reports them in order.
fn solve(
    options: &SolveOptions,
    entry: &Entry,
    mechanism: &Mechanism,
    wanted: Range<usize>,
    report: &mut Report<'_>,
) -> Result<Exit, Fault> {
    let roots = if options.real { Roots::Real } else { Roots::All };
    let stop = stop_on_interrupt();
    let pool = pool(if wanted.len() == 1 { Some(1) } else { options.threads })?;
    let chunk = 16 * pool.current_num_threads();
    let mut exit = Exit::Complete;
    let indices: Vec<usize> = wanted.collect();
    for chunk in indices.chunks(chunk) {
        let memory = || (Workspace::default(), Assembly::default());
        let solutions: Vec<Option<Result<Solution, Error>>> = pool.install(|| {
            let one = |memory: &mut (Workspace, Assembly), index: &usize| {
                let stopped = stop.load(Ordering::Relaxed);
                (!stopped).then(|| mechanism.solve(&entry.cases[*index], roots, &mut memory.0, &mut memory.1))
            };
            chunk.par_iter().map_init(memory, one).collect()
        });
        for (index, solution) in chunk.iter().zip(solutions) {
            let Some(solution) = solution else { return Ok(Exit::Interrupted) };
            let solution = match solution {
                Err(error @ Error::Unsupported(_)) => unsupported(&error),
                other => other?,
            };
            exit = exit.max(Exit::of(&solution));
            report.add(*index, &solution)?;
        }
        report.flush()?;
        if stop.load(Ordering::Relaxed) && chunk.last() != indices.last() {
            return Ok(Exit::Interrupted);
        }
    }
    Ok(exit)
}

/// Raised by the first Ctrl-C, which lets what is done be printed; the second one ends the program at once.
pub fn stop_on_interrupt() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&stop);
    // Without a handler Ctrl-C still ends the program, only less politely.
    let _ = ctrlc::set_handler(move || {
        if raised.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
    stop
}

/// The answer where there is no solver.
fn unsupported(error: &Error) -> Solution {
    let reason = match error {
        Error::Unsupported(reason) => reason.clone(),
        other => other.to_string(),
    };
    let status = Status::Unsupported;
    let verdict = Verdict { status, complex: 0, real: 0, at_infinity: 0, self_motion: 0, certified: 0, reason };
    Solution { verdict, modes: Vec::new(), warnings: Vec::new(), prepare_us: 0.0, solve_us: 0.0 }
}

/// Which cases to solve. A case given on the command line takes the place of those of the file.
fn wanted(options: &SolveOptions, entry: &mut Entry) -> Result<Range<usize>, Error> {
    let is_arm = entry.kind == Kind::Arm;
    if let Some(joints) = &options.joints {
        if !is_arm {
            return Err(Error::Invalid("found --joints for a loop, expected --input".to_owned()));
        }
        entry.cases = vec![reached(entry, joints)?];
    }
    let number = match (&options.input, options.pose) {
        (Some(_), _) if is_arm => return Err(Error::Invalid("found --input for an arm, expected --pose".to_owned())),
        (_, Some(_)) if !is_arm => return Err(Error::Invalid("found --pose for a loop, expected --input".to_owned())),
        (Some(input), _) => match input.split_once('=') {
            Some((joint, value)) => {
                entry.cases = vec![given(entry, joint, value)?];
                None
            }
            None => Some(input.trim().parse().map_err(|_| {
                Error::Invalid(format!("found --input {input}, expected a number from 1 or JOINT=VALUE"))
            })?),
        },
        (None, pose) => pose,
    };
    let count = entry.cases.len();
    match number {
        None if count == 0 => {
            let hint = if is_arm {
                "expected a [[pose]], or --joints with joint values that reach one"
            } else {
                "expected an [[input]]"
            };
            Err(Error::Invalid(format!("{}: found nothing to solve, {hint}", options.mechanism)))
        }
        None => Ok(0..count),
        Some(number) if (1..=count).contains(&number) => Ok(number - 1..number),
        Some(number) => {
            let noun = if is_arm { "pose" } else { "input" };
            Err(Error::Invalid(format!("found --{noun} {number}, expected 1 to {count}")))
        }
    }
}

/// A case that locks a joint at a value of the command line.
fn given(entry: &Entry, joint: &str, value: &str) -> Result<Case, Error> {
    let joint: usize = joint.trim().trim_start_matches('q').parse().map_err(|_| {
        Error::Invalid(format!("found --input {joint}={value}, expected the number of a joint before `=`"))
    })?;
    let reading = Reading::default();
    let is_length = Layout::variable_of(&entry.chain, joint, Variable::Rotation).is_none();
    if is_length && Layout::variable_of(&entry.chain, joint, Variable::Translation).is_none() {
        let count = entry.chain.joint_kinds().len();
        return Err(Error::Invalid(format!("found joint {joint} in --input, expected one from 1 to {count}")));
    }
    let value = if is_length {
        InputValue::Distance(Number::parse(value, Quantity::Length, &reading)?)
    } else {
        InputValue::Angle(Angle::parse(value, &reading)?)
    };
    Ok(case(None, vec![Input { joint, value }]))
}

/// A case that asks for the pose which these joint values reach.
fn reached(entry: &Entry, joints: &str) -> Result<Case, Error> {
    let variables = Layout::of(&entry.chain, None)?.variables;
    let texts: Vec<&str> = joints.split(',').map(str::trim).collect();
    if texts.len() != variables.len() {
        let (found, expected) = (texts.len(), variables.len());
        return Err(Error::Invalid(format!(
            "found {found} values in --joints, expected {expected}, separated by commas"
        )));
    }
    let reading = Reading::default();
    let mut motions = Vec::new();
    for (text, variable) in texts.into_iter().zip(variables) {
        let motion = match variable {
            Variable::Rotation => angle_motion(&Angle::parse(text, &reading)?),
            Variable::Translation => distance_motion(&Number::parse(text, Quantity::Length, &reading)?),
        };
        motions.extend(motion);
    }
    let pose = entry.chain.forward(&motions).map(Placement::from_motion_exact);
    Ok(case(pose, Vec::new()))
}

fn case(pose: Option<Placement>, input: Vec<Input>) -> Case {
    Case { pose, input, expected: Expected::default(), warnings: Vec::new(), line: 1 }
}

/// The form of the output.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Text,
    Document,
    Lines,
}

/// The results, written as they come.
struct Report<'a> {
    entry: &'a Entry,
    output: Output,
    form: Form,
    view: View,
    written: usize,
    total: usize,
    tally: [usize; 5],
    start: Instant,
    progress: ProgressBar,
}

impl<'a> Report<'a> {
    fn open(options: &SolveOptions, entry: &'a Entry, total: usize) -> Result<Self, Fault> {
        let output = Output::open(&options.output, &options.mechanism)?;
        let form = match (options.json, options.jsonl) {
            (true, _) => Form::Document,
            (_, true) => Form::Lines,
            _ => Form::Text,
        };
        let view = View {
            complex: options.complex,
            drop_outside_limits: options.limits == Limits::Drop,
            quiet: options.quiet,
            colour: output.colour,
        };
        // Hidden by itself where stderr is no terminal; a terminal that shows the results needs no bar.
        let target = if output.is_terminal || options.quiet || total < 2 {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let progress = ProgressBar::with_draw_target(Some(total as u64), target);
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} {per_sec} {eta}") {
            progress.set_style(style);
        }
        Ok(Self { entry, output, form, view, written: 0, total, tally: [0; 5], start: Instant::now(), progress })
    }

    fn is_json(&self) -> bool {
        self.form != Form::Text
    }

    fn add(&mut self, index: usize, solution: &Solution) -> Result<(), Fault> {
        let out = &mut self.output.writer;
        match self.form {
            Form::Document if self.written == 0 => write!(out, "{}\n  ", json::head(self.entry))?,
            Form::Document => write!(out, ",\n  ")?,
            Form::Text if self.written > 0 && !self.view.quiet => writeln!(out)?,
            _ => {}
        }
        match self.form {
            Form::Text => {
                let case = &self.entry.cases[index];
                write!(out, "{}", text::solution(self.entry, index + 1, case, solution, &self.view))?;
            }
            Form::Document => write!(out, "{}", json::result(index + 1, solution, &self.view))?,
            Form::Lines => writeln!(out, "{}", json::result(index + 1, solution, &self.view))?,
        }
        self.written += 1;
        self.tally[solution.verdict.status as usize] += 1;
        self.progress.inc(1);
        Ok(())
    }

    fn flush(&mut self) -> Result<(), Fault> {
        Ok(self.output.writer.flush()?)
    }

    /// Ends the output, finished or interrupted.
    fn close(mut self) -> Result<(), Fault> {
        self.progress.finish_and_clear();
        let out = &mut self.output.writer;
        match self.form {
            Form::Document if self.written == 0 => writeln!(out, "{}] }}", json::head(self.entry))?,
            Form::Document => writeln!(out, "\n] }}")?,
            Form::Text if self.total > 1 => {
                let noun = if self.entry.kind == Kind::Arm { "pose" } else { "input" };
                let words = ["complete", "incomplete", "unreachable", "self-motion", "unsupported"];
                let counts = words.iter().zip(self.tally).filter(|(_, count)| *count > 0);
                let counts: Vec<String> = counts.map(|(word, count)| format!("{count} {word}")).collect();
                let time = duration(self.start.elapsed().as_secs_f64() * 1e6);
                let missing = if self.written < self.total { format!(" of {}", self.total) } else { String::new() };
                let gap = if self.view.quiet { "" } else { "\n" };
                let done = counted(self.written, noun);
                writeln!(out, "{gap}{done}{missing}: {} in {time}", counts.join(", "))?;
            }
            _ => {}
        }
        self.flush()
    }
}
