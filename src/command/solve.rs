//! `looproot solve`

use super::arguments::{Limits, SolveOptions};
use super::exit::{Exit, Fault};
use super::output::{Output, pool};
use super::seed::plant;
use super::wanted::{in_place, wanted};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use looproot::algebra::drawn::seed_used;
use looproot::assembly::{Assembly, Roots, Workspace};
use looproot::catalogue::entry::{Entry, Kind};
use looproot::catalogue::{Options, load};
use looproot::error::Error;
use looproot::mechanism::{Derivatives, InputCurve, Mechanism, Solution};
use looproot::report::derivatives;
use looproot::report::document;
use looproot::report::json;
use looproot::report::model::case_noun;
use looproot::report::number::{counted, duration};
use looproot::report::text::{self, View};
use looproot::verdict::{Code, Proof, Status, Verdict};
use rayon::prelude::*;
use serde_json::{Map, Value};
use std::io::Write;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Finds every solution of every case, or of the one asked for, and prints them in the order of the file.
pub fn run(options: &SolveOptions) -> Result<Exit, Fault> {
    let read = Options { chains: options.asked.chains(), ..options.read.options() };
    let mut entry = load(&options.mechanism, &read)?;
    plant(options.seed);
    let keys = if options.json { document::keys(&entry) } else { Map::new() };
    let wanted = wanted(&options.asked, &options.mechanism, &mut entry)?;
    if options.derivatives && entry.kind() != Kind::Loop {
        let what = if entry.kind() == Kind::Arm { "an arm" } else { "a platform" };
        let message = format!("found --derivatives for {what}, expected a loop: derivatives are by its input");
        return Err(Error::Invalid(message).into());
    }
    let mut report = Report::open(options, &entry, keys, wanted.len())?;
    let exit = match Mechanism::prepare(&entry) {
        Ok(mechanism) => solve(options, &entry, &mechanism, wanted, &mut report)?,
        // The document of a mechanism that cannot be solved says so, case by case.
        Err(error) if error.unsupported().is_some() && report.is_json() => {
            for index in wanted {
                report.add(index, &unsupported(&in_place(error.clone(), &options.mechanism, &entry)), None)?;
            }
            Exit::Unsupported
        }
        Err(error) => return Err(in_place(error, &options.mechanism, &entry).into()),
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
    let stop = stop_on_interrupt();
    let pool = pool(if wanted.len() == 1 { Some(1) } else { options.threads })?;
    let chunk = 16 * pool.current_num_threads();
    let mut exit = Exit::Complete;
    let indices: Vec<usize> = wanted.collect();
    for chunk in indices.chunks(chunk) {
        let memory = || {
            let mut workspace = Workspace::default();
            workspace.only_real_list = !options.complex;
            (workspace, Assembly::default())
        };
        let solutions: Vec<Option<Result<Answer, Error>>> = pool.install(|| {
            let one = |memory: &mut (Workspace, Assembly), index: &usize| {
                let stopped = stop.load(Ordering::Relaxed);
                (!stopped).then(|| answer(options, entry, mechanism, *index, memory))
            };
            chunk.par_iter().map_init(memory, one).collect()
        });
        for (index, solution) in chunk.iter().zip(solutions) {
            let Some(solution) = solution else { return Ok(Exit::Interrupted) };
            let (solution, derivatives) = match solution {
                Err(error) if error.unsupported().is_some() => (unsupported(&error), None),
                other => other?,
            };
            exit = exit.max(Exit::of(&solution));
            report.add(*index, &solution, derivatives.as_deref())?;
        }
        report.flush()?;
        if stop.load(Ordering::Relaxed) && chunk.last() != indices.last() {
            return Ok(Exit::Interrupted);
        }
    }
    Ok(exit)
}

/// A solution, and where they are asked for the derivatives at each of its modes.
type Answer = (Solution, Option<Vec<Option<Derivatives>>>);

/// Solves one case.
fn answer(
    options: &SolveOptions,
    entry: &Entry,
    mechanism: &Mechanism,
    index: usize,
    memory: &mut (Workspace, Assembly),
) -> Result<Answer, Error> {
    let roots = if options.real { Roots::Real } else { Roots::All };
    let case = &entry.cases[index];
    let solution = mechanism.solve(case, roots, &mut memory.0, &mut memory.1)?;
    let curve = if options.derivatives { Some(InputCurve::of(entry, case)?) } else { None };
    let derivatives = curve.map(|curve| solution.modes.iter().map(|mode| curve.derivatives(mode)).collect());
    Ok((solution, derivatives))
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
    let reason = error.unsupported().map_or_else(|| error.to_string(), str::to_owned);
    let status = Status::Unsupported;
    let verdict = Verdict {
        status,
        proof: Proof::None,
        code: Code::Unsupported,
        complex_complete: false,
        complex: 0,
        real: 0,
        at_infinity: 0,
        self_motion: 0,
        certified: 0,
        reason,
    };
    let (modes, families) = (Vec::new(), Vec::new());
    Solution { verdict, modes, families, warnings: Vec::new(), prepare_us: 0.0, solve_us: 0.0, platform: None }
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
    keys: Map<String, Value>,
    labels: Vec<String>,
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
    fn open(options: &SolveOptions, entry: &'a Entry, keys: Map<String, Value>, total: usize) -> Result<Self, Fault> {
        let labels = document::labels(entry);
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
        let start = Instant::now();
        Ok(Self { entry, keys, labels, output, form, view, written: 0, total, tally: [0; 5], start, progress })
    }

    fn is_json(&self) -> bool {
        self.form != Form::Text
    }

    fn add(
        &mut self,
        index: usize,
        solution: &Solution,
        derivatives: Option<&[Option<Derivatives>]>,
    ) -> Result<(), Fault> {
        let document = || {
            let mut result = json::result(index + 1, &self.entry.cases[index], solution, &self.labels, &self.view);
            if let Some(derivatives) = derivatives {
                derivatives::insert(&mut result, solution, derivatives, &self.view);
            }
            result
        };
        let out = &mut self.output.writer;
        match self.form {
            Form::Document if self.written == 0 => write!(out, "{}\n  ", json::head(self.entry, &self.keys))?,
            Form::Document => write!(out, ",\n  ")?,
            Form::Text if self.written > 0 && !self.view.quiet => writeln!(out)?,
            _ => {}
        }
        match self.form {
            Form::Text => {
                let case = &self.entry.cases[index];
                write!(out, "{}", text::solution(self.entry, index + 1, case, solution, &self.view))?;
                if let (Some(derivatives), false) = (derivatives, self.view.quiet) {
                    write!(out, "{}", derivatives::text(self.entry, case, solution, derivatives, &self.view))?;
                }
            }
            Form::Document => write!(out, "{}", document())?,
            Form::Lines => writeln!(out, "{}", document())?,
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
            Form::Document if self.written == 0 => {
                writeln!(out, "{}{}", json::head(self.entry, &self.keys), json::foot(seed_used()))?;
            }
            Form::Document => writeln!(out, "\n{}", json::foot(seed_used()))?,
            Form::Text if self.total > 1 => {
                let noun = case_noun(self.entry);
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
