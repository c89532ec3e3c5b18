//! `looproot solve`

use super::answer_file::AnswerFile;
use super::arguments::{Limits, OutputOptions, SolveOptions};
use super::calculus;
use super::certificates::{Certificates, not_covered};
use super::demand::demand;
use super::exit::{Exit, Fault, complain, unexpected};
use super::follow::Follow;
use super::kept::{Prepared, Source, keep};
use super::order::Order;
use super::output::{Output, pool};
use super::rows::{self, Row};
use super::seed::plant;
use super::stream::ordered;
use super::wanted::{in_place, tolerance, wanted};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::entry::{Case, Entry, Kind};
use looproot::internal::catalogue::poses::PoseRows;
use looproot::internal::catalogue::{Any, Chains, Options, load_solvable};
use looproot::internal::error::Error;
use looproot::internal::mechanism::{Derivatives, InputCurve, Mechanism, Solution};
use looproot::internal::report::derivatives;
use looproot::internal::report::document;
use looproot::internal::report::json;
use looproot::internal::report::model::case_noun;
use looproot::internal::report::number::{counted, duration};
use looproot::internal::report::scene;
use looproot::internal::report::text::{self, View};
use looproot::internal::scene::Stage;
use looproot::internal::verdict::{Code, Proof, Status, Verdict};
use looproot_algebra::drawn::seed_used;
use serde_json::{Map, Value, json};
use std::borrow::Cow;
use std::io::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Finds every solution of every case, or of the requested one, and prints them in the order of the file.
pub fn run(options: &SolveOptions) -> Result<Exit, Fault> {
    // Arrays have a file of their own, and what else there is to say is printed.
    let output = OutputOptions {
        output: options.output.output.clone().filter(|path| !AnswerFile::is_named(path)),
        ..options.output
    };
    run_to(options, || Output::open(&output, &options.mechanism))
}

/// As [`run`], with output to `open`, which is called once the mechanism is read.
pub fn run_to(options: &SolveOptions, open: impl FnOnce() -> Result<Output, Fault>) -> Result<Exit, Fault> {
    let chains = if options.poses.is_some() { Chains::Swept } else { options.asked.chains() };
    let read = Options { chains, ..options.read.options() };
    let source = Source::of(options, &read);
    let (mut entry, kept) = match source.as_ref().and_then(Source::take) {
        Some(kept) => (kept.entry, Some(kept.prepared)),
        None => match load_solvable(&options.mechanism, &read)? {
            Any::Entry(entry) => (*entry, None),
            Any::Calculus(file) => {
                not_covered(options.certificate.as_ref(), "displacements, lines, gears and motions");
                return calculus::run(options, &file, open);
            }
            Any::Linkage(file) => return super::linkage::run(options, &file, open()?),
            Any::Sphere(file) => {
                not_covered(options.certificate.as_ref(), "linkages on the sphere");
                return super::sphere::run(options, &file, open()?);
            }
            Any::Space(file) => {
                not_covered(options.certificate.as_ref(), "linkages in space");
                return super::space::run(options, &file, open()?);
            }
            other => {
                let expected = "an arm, a loop or a platform with numbers";
                return Err(unexpected(&options.mechanism, other.kind(), expected));
            }
        },
    };
    let cases = if source.is_some() { entry.cases.clone() } else { Vec::new() };
    if options.inverse {
        return super::inverse::run(options, &mut entry, open);
    }
    plant(options.seed);
    let stage = staged(options, &entry)?;
    let mut keys = if options.json || stage.is_some() { document::keys(&entry) } else { Map::new() };
    if let Some(stage) = &stage {
        keys.insert("scene".into(), scene::json(&stage.scene));
    }
    if options.poses.is_some() {
        refuse_loop(&entry)?;
        entry.cases.clear();
    }
    let wanted = if options.poses.is_some() { 0..0 } else { wanted(&options.asked, &options.mechanism, &mut entry)? };
    let demand = demand(&options.demand, &entry)?;
    let order = Order::of(options, &entry)?;
    if options.derivatives && entry.kind() != Kind::Loop {
        let what = if entry.kind() == Kind::Arm { "an arm" } else { "a platform" };
        let message = format!("found --derivatives for {what}, expected a loop: derivatives are by its input");
        return Err(Error::Invalid(message).into());
    }
    let tolerance = tolerance(options.tolerance.as_deref(), &entry)?;
    let table = options.poses.as_ref().map(|path| rows::open(path, &entry.design, &entry.reading)).transpose()?;
    let (reader, rows) = table.unzip();
    let total = reader.is_none().then_some(wanted.len());
    let mut report = Report::new(options, &entry, keys, (stage, order), total, open()?);
    report.answers = answer_file(options, &entry, &report.labels)?;
    let prepared = Prepared::or_prepare(kept, &entry, &demand).map(|mechanism| mechanism.with_tolerance(tolerance));
    let mut solved = None;
    let exit = match prepared {
        Ok(mechanism) => {
            let listed = wanted.map(Job::Listed);
            let jobs = listed.chain((1..).zip(rows.into_iter().flatten()).map(|(number, row)| Job::Row(number, row)));
            let lines = report.lines(options);
            let is_alone = total == Some(1);
            let work = Work { options, entry: &entry, mechanism: &mechanism, reader, lines, is_alone };
            let exit = work.solve(jobs, total, &mut report)?;
            solved = Some(Prepared::new(mechanism, demand, &entry));
            exit
        }
        // The document of a mechanism that cannot be solved reports that for each case.
        Err(error) if error.unsupported().is_some() && report.is_json() => {
            for index in wanted {
                report.add(
                    index + 1,
                    &entry.cases[index],
                    &Answer::alone(unsupported(&in_place(error.clone(), &options.mechanism, &entry))),
                )?;
            }
            Exit::Unsupported
        }
        Err(Error::Invalid(message)) => return Err(Error::Invalid(format!("{}: {message}", options.mechanism)).into()),
        Err(error) => return Err(in_place(error, &options.mechanism, &entry).into()),
    };
    report.close()?;
    if let (Some(source), Some(prepared)) = (source, solved) {
        keep(source, entry, cases, prepared);
    }
    Ok(exit)
}

/// Begins the file of arrays or the table that is asked for.
fn answer_file(options: &SolveOptions, entry: &Entry, labels: &[String]) -> Result<Option<AnswerFile>, Error> {
    let Some(path) = options.output.output.as_ref().filter(|path| AnswerFile::is_named(path)) else { return Ok(None) };
    let unfit = [("--json", options.json), ("--jsonl", options.jsonl), ("--complex", options.complex)];
    let what = unfit.iter().find(|(_, is_there)| *is_there).map(|(name, _)| *name);
    let what = what.or((entry.kind() != Kind::Arm).then_some("a mechanism that is no arm"));
    match what {
        Some(what) => {
            Err(Error::Invalid(format!("found {what} with `-o {}`, expected real solutions of an arm", path.display())))
        }
        None => AnswerFile::create(path, labels, !entry.limits.is_empty()).map(Some),
    }
}

/// Refuses `--poses` for mechanisms without poses.
fn refuse_loop(entry: &Entry) -> Result<(), Error> {
    match entry.kind() {
        Kind::Loop => Err(Error::Invalid("found --poses for a loop, expected --input".to_owned())),
        Kind::Arm | Kind::Platform => Ok(()),
    }
}

/// A problem to solve.
enum Job {
    /// A case of the file, by its index.
    Listed(usize),
    /// A row of a table, and its number, from 1.
    Row(usize, Row),
}

impl Job {
    /// Returns the number of the case, from 1.
    fn number(&self) -> usize {
        match self {
            Self::Listed(index) => index + 1,
            Self::Row(number, _) => *number,
        }
    }
}

/// The data that all threads share.
struct Work<'a> {
    options: &'a SolveOptions,
    entry: &'a Entry,
    mechanism: &'a Mechanism,
    reader: Option<PoseRows<'a>>,
    lines: Option<Lines>,
    /// Whether one case was asked for: where nothing reaches its pose, what comes nearest is worth the search.
    is_alone: bool,
}

/// What is needed to write the JSON of an answer on the thread that has found it.
struct Lines {
    labels: Vec<String>,
    view: View,
}

/// Returns the stage on which the bodies are posed, if the scene is requested.
fn staged(options: &SolveOptions, entry: &Entry) -> Result<Option<Stage>, Error> {
    if options.scene && !options.json && !options.jsonl {
        return Err(Error::Invalid("found --scene alone, expected it with --json or --jsonl".to_owned()));
    }
    Ok(Stage::of(entry).filter(|_| options.scene))
}

/// A solution and what was made of it where it was found.
struct Answer {
    solution: Solution,
    /// The derivatives at each mode, if requested.
    derivatives: Option<Vec<Option<Derivatives>>>,
}

impl Answer {
    fn alone(solution: Solution) -> Self {
        Self { solution, derivatives: None }
    }
}

/// The result of a job that has a case.
enum Done<'a> {
    /// Its JSON, where nothing is added to it. What it was written from is gone: many results wait for their turn.
    Line { text: Vec<u8>, status: Status, exit: Exit },
    /// The case and the answer.
    Answer(Box<(Cow<'a, Case>, Result<Answer, Error>)>),
}

/// The result of a job, or the error of the row.
type Outcome<'a> = Result<Done<'a>, Error>;

impl<'a> Work<'a> {
    /// Solves the jobs on all threads and reports them in order.
    fn solve(
        &self,
        jobs: impl Iterator<Item = Job> + Send,
        total: Option<usize>,
        report: &mut Report<'_>,
    ) -> Result<Exit, Fault> {
        let stop = stop_on_interrupt();
        let pool = pool(if total == Some(1) { Some(1) } else { self.options.threads })?;
        let memory = || {
            let mut workspace = Workspace::default();
            workspace.only_real_list = !self.options.complex;
            (workspace, Assembly::default())
        };
        let one = |memory: &mut (Workspace, Assembly), job: &Job| {
            let stopped = stop.load(Ordering::Relaxed);
            (!stopped).then(|| self.outcome(job, memory))
        };
        let mut exit = Exit::Complete;
        let take = |batch: Vec<(Job, Option<Outcome<'_>>)>| -> Result<bool, Fault> {
            for (job, outcome) in batch {
                let Some(outcome) = outcome else {
                    exit = Exit::Interrupted;
                    return Ok(false);
                };
                exit = exit.max(report_one(report, &job, outcome)?);
            }
            report.flush()?;
            Ok(true)
        };
        ordered(&pool, jobs, memory, one, take)?;
        Ok(exit)
    }

    /// Reads and solves one job.
    fn outcome(&self, job: &Job, memory: &mut (Workspace, Assembly)) -> Outcome<'a> {
        let case = match (job, &self.reader) {
            (Job::Listed(index), _) => Cow::Borrowed(&self.entry.cases[*index]),
            (Job::Row(_, row), Some(reader)) => Cow::Owned(row.case(reader)?),
            (Job::Row(..), None) => return Err(Error::Invalid("a row without a table".to_owned())),
        };
        let answer = self.answer(&case, memory);
        if let (Some(Lines { labels, view }), Ok(Answer { solution, .. })) = (&self.lines, &answer) {
            let own = json::Answer { number: job.number(), case: &case, solution, labels, view };
            if let Ok(text) = own.line() {
                return Ok(Done::Line { text, status: solution.verdict.status, exit: Exit::of(solution) });
            }
        }
        Ok(Done::Answer(Box::new((case, answer))))
    }

    /// Solves one case.
    fn answer(&self, case: &Case, memory: &mut (Workspace, Assembly)) -> Result<Answer, Error> {
        let roots = if self.options.real { Roots::Real } else { Roots::All };
        let mut solution = self.mechanism.solve(case, roots, &mut memory.0, &mut memory.1)?;
        if self.is_alone {
            solution = self.mechanism.alone(case, solution);
        }
        let curve = if self.options.derivatives { Some(InputCurve::of(self.entry, case)?) } else { None };
        let derivatives = curve.map(|curve| solution.modes.iter().map(|mode| curve.derivatives(mode)).collect());
        Ok(Answer { solution, derivatives })
    }
}

/// Reports one job, and returns its exit code.
fn report_one(report: &mut Report<'_>, job: &Job, outcome: Outcome<'_>) -> Result<Exit, Fault> {
    let number = job.number();
    let done = match (outcome, job) {
        (Ok(done), _) => done,
        (Err(error), Job::Row(_, row)) => {
            report.refuse(number, row.line, &error)?;
            return Ok(Exit::Misuse);
        }
        (Err(error), Job::Listed(_)) => return Err(error.into()),
    };
    let (case, answer) = match done {
        Done::Line { text, status, exit } => {
            report.write_line(&text)?;
            report.count(status);
            return Ok(exit);
        }
        Done::Answer(own) => *own,
    };
    let answer = match answer {
        Err(error) if error.unsupported().is_some() => Answer::alone(unsupported(&error)),
        answer => answer?,
    };
    report.add(number, &case, &answer)?;
    Ok(Exit::of(&answer.solution))
}

/// Returns a flag raised by the first Ctrl-C, so that finished results are printed; the second one ends the program at once.
pub fn stop_on_interrupt() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    #[cfg(not(target_family = "wasm"))]
    {
        let raised = Arc::clone(&stop);
        // Without a handler Ctrl-C still ends the program, though less cleanly.
        let _ = ctrlc::set_handler(move || {
            if raised.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
        });
    }
    stop
}

/// Returns the answer for a mechanism without a solver.
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
    Solution {
        arm: None,
        nearest: None,
        verdict,
        modes,
        families,
        warnings: Vec::new(),
        prepare_us: 0.0,
        solve_us: 0.0,
        platform: None,
    }
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
    stage: Option<Stage>,
    labels: Vec<String>,
    output: Output,
    form: Form,
    view: View,
    order: Order,
    follow: Option<Follow>,
    written: usize,
    /// Number of rows that were no poses.
    refused: usize,
    /// Total number, if it is known beforehand.
    total: Option<usize>,
    tally: [usize; 5],
    start: Instant,
    progress: ProgressBar,
    certificates: Option<Certificates>,
    answers: Option<AnswerFile>,
    /// The results of a document that is read at once.
    results: Vec<Value>,
}

impl<'a> Report<'a> {
    fn new(
        options: &SolveOptions,
        entry: &'a Entry,
        keys: Map<String, Value>,
        (stage, order): (Option<Stage>, Order),
        total: Option<usize>,
        output: Output,
    ) -> Self {
        let labels = document::labels(entry);
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
        // The bar hides itself if stderr is no terminal; a terminal that shows the results needs no bar.
        let target = if output.is_terminal || options.quiet || total.is_some_and(|total| total < 2) {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let progress = ProgressBar::with_draw_target(total.map(|total| total as u64), target);
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} {per_sec} {eta}") {
            progress.set_style(style);
        }
        let start = Instant::now();
        let (written, refused, tally) = (0, 0, [0; 5]);
        let follow = options.follow.then(|| Follow::of(entry));
        let certificates = options.certificate.as_ref().map(|path| Certificates::new(path));
        Self {
            entry,
            keys,
            stage,
            labels,
            output,
            form,
            view,
            order,
            follow,
            written,
            refused,
            total,
            tally,
            start,
            progress,
            certificates,
            answers: None,
            results: Vec::new(),
        }
    }

    fn is_json(&self) -> bool {
        self.form != Form::Text
    }

    /// Returns what writes an answer as JSON, where nothing else is inserted into it and it goes nowhere else.
    fn lines(&self, options: &SolveOptions) -> Option<Lines> {
        let is_plain = self.stage.is_none()
            && self.follow.is_none()
            && self.order.is_as_found()
            && self.output.document.is_none()
            && self.certificates.is_none()
            && !options.derivatives;
        (self.is_json() && is_plain).then(|| Lines { labels: self.labels.clone(), view: self.view })
    }

    fn add(&mut self, number: usize, case: &Case, answer: &Answer) -> Result<(), Fault> {
        let Answer { solution, derivatives } = answer;
        let derivatives = derivatives.as_deref();
        if let Some(certificates) = &mut self.certificates {
            certificates.add(self.entry, number, case, solution)?;
        }
        let sorted = self.order.sorted(solution);
        let solution = sorted.as_ref();
        let row = self.follow.as_mut().map(|follow| follow.add(number, solution));
        if let Some(answers) = &mut self.answers {
            answers.add(solution)?;
        }
        let document = || {
            let mut result = json::result(number, case, solution, &self.labels, &self.view);
            if let Some(derivatives) = derivatives {
                derivatives::insert(&mut result, solution, derivatives, &self.view);
            }
            if let Some(stage) = &self.stage {
                scene::pose_result(&mut result, stage);
            }
            self.order.insert_turns(&mut result, solution, &self.view);
            if let Some(row) = &row {
                row.insert(&mut result, solution, &self.view);
            }
            result
        };
        match self.form {
            Form::Text if self.answers.is_some() => {}
            Form::Text => {
                let mut text = String::new();
                if self.written > 0 && !self.view.quiet {
                    text.push('\n');
                }
                text += &text::solution(self.entry, number, case, solution, &self.view);
                if let (Some(derivatives), false) = (derivatives, self.view.quiet) {
                    text += &derivatives::text(self.entry, case, solution, derivatives, &self.view);
                }
                text += &self.order.turns_text(solution, &self.view);
                self.output.writer.write_all(text.as_bytes())?;
            }
            Form::Document | Form::Lines => {
                let document = document();
                self.write_value(document)?;
            }
        }
        self.count(solution.verdict.status);
        Ok(())
    }

    /// Counts an answer that was written.
    fn count(&mut self, status: Status) {
        self.written += 1;
        self.tally[status as usize] += 1;
        self.progress.inc(1);
    }

    /// Writes an element of the list of results, or keeps it for a document that is read at once.
    fn write_value(&mut self, value: Value) -> Result<(), Fault> {
        if self.form == Form::Document && self.output.document.is_some() {
            self.results.push(value);
            return Ok(());
        }
        self.write_line(format!("{value}\n").as_bytes())
    }

    /// Writes an element of the list of results, a line of JSON.
    fn write_line(&mut self, line: &[u8]) -> Result<(), Fault> {
        let out = &mut self.output.writer;
        match (self.form, &self.stage) {
            (Form::Document, _) => {
                let before = if self.written == 0 { json::head(self.entry, &self.keys) } else { ",".to_owned() };
                write!(out, "{before}\n  ")?;
                out.write_all(line.trim_ascii_end())?;
            }
            (Form::Lines | Form::Text, stage) => {
                // The first line holds the data common to all lines.
                if stage.is_some() && self.written == 0 {
                    writeln!(out, "{}", json::line_of_document(self.entry, &self.keys))?;
                }
                out.write_all(line)?;
            }
        }
        Ok(())
    }

    /// Reports a row that is no pose.
    fn refuse(&mut self, number: usize, line: usize, error: &Error) -> Result<(), Fault> {
        let message = match error {
            Error::File { message, .. } => message.clone(),
            other => other.to_string(),
        };
        if self.is_json() {
            let value = json!({ "case": number, "line": line, "error": { "code": "bad-row", "message": message } });
            self.write_value(value)?;
        } else {
            complain(&error.to_string());
        }
        if let Some(answers) = &mut self.answers {
            answers.refuse(&message)?;
        }
        self.written += usize::from(self.is_json());
        self.refused += 1;
        self.progress.inc(1);
        Ok(())
    }

    fn flush(&mut self) -> Result<(), Fault> {
        Ok(self.output.writer.flush()?)
    }

    /// Ends the output, finished or interrupted.
    fn close(mut self) -> Result<(), Fault> {
        if let Some(certificates) = &mut self.certificates {
            certificates.close()?;
        }
        if let Some(answers) = self.answers.take() {
            answers.close()?;
        }
        self.progress.finish_and_clear();
        if let (Form::Document, Some(slot)) = (self.form, &self.output.document) {
            let branches = self.follow.as_ref().map(Follow::json);
            slot.replace(Some(json::document(self.entry, &self.keys, self.results, branches, seed_used())));
            return Ok(());
        }
        let out = &mut self.output.writer;
        match self.form {
            Form::Document if self.written == 0 => {
                writeln!(out, "{}{}", json::head(self.entry, &self.keys), json::foot(seed_used()))?;
            }
            Form::Document => {
                let foot = json::foot(seed_used());
                let branches = self.follow.as_ref().map(|follow| format!("], \"branches\": {}", follow.json()));
                let foot = branches.map_or_else(|| foot.clone(), |text| text + foot.trim_start_matches(']'));
                writeln!(out, "\n{foot}")?;
            }
            Form::Lines => {
                if let Some(follow) = &self.follow {
                    writeln!(out, "{}", json!({ "branches": follow.json() }))?;
                }
            }
            Form::Text if self.total != Some(1) => {
                let noun = case_noun(self.entry);
                let words = ["complete", "incomplete", "unreachable", "self-motion", "unsupported"];
                let counts = words.iter().zip(self.tally).filter(|(_, count)| *count > 0);
                let counts: Vec<String> = counts.map(|(word, count)| format!("{count} {word}")).collect();
                let time = duration(self.start.elapsed().as_secs_f64() * 1e6);
                let missing = match self.total {
                    Some(total) if self.written < total => format!(" of {total}"),
                    _ if self.refused > 0 => format!(" and {} without a pose", counted(self.refused, "row")),
                    _ => String::new(),
                };
                let gap = if self.view.quiet { "" } else { "\n" };
                let done = counted(self.written, noun);
                writeln!(out, "{gap}{done}{missing}: {} in {time}", counts.join(", "))?;
                if let Some(follow) = &self.follow {
                    write!(out, "{}", follow.text())?;
                }
            }
            Form::Text => {}
        }
        self.flush()
    }
}
