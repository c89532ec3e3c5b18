//! `looproot view`

use super::arguments::{SweepOptions, ViewOptions};
use super::exit::{Exit, Fault};
use super::output::{Memory, Output};
use super::seed::SeedOptions;
use super::view_map::map;
use super::{solve, sweep, view_live};
use looproot::internal::catalogue::{Any, Chains, Options, load_any};
use looproot::internal::error::Error;
use looproot::internal::report::framework;
use looproot::internal::view::{drawable, figures, is_scores, live_page, page, parse, parts};
use serde_json::Value;
use std::io::{IsTerminal, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Maximum size of a document: a page of a larger one could not be used.
const MOST_BYTES: u64 = 256 << 20;

/// Solves, sweeps or reads the requested mechanism, and draws the result.
pub fn run(options: &ViewOptions) -> Result<Exit, Fault> {
    let begun = if options.live { view_live::begun(options) } else { None };
    let options = begun.as_ref().unwrap_or(options);
    let has_place = options.open || options.parts || options.svg || options.solve.output.output.is_some();
    if !has_place && std::io::stdout().is_terminal() {
        let message = "found no place for the page, expected -o page.html or --open";
        return Err(Error::Invalid(message.to_owned()).into());
    }
    let (exit, mut document) = document(options)?;
    drawable(&mut document)?;
    let map = options.map.as_ref().map(|plane| map(options, plane)).transpose()?;
    if options.svg && is_scores(&document) {
        return Err(Error::Invalid("found --svg of scores, expected a mechanism: scores are a page".to_owned()).into());
    }
    let text = match (options.svg, map) {
        _ if options.live => live_page(&document, &view_live::live(options, &document)?)?,
        _ if options.parts => parts(&document).to_string(),
        (true, Some(map)) => map,
        (true, None) => figures(&document),
        (false, map) => page(&document, map.as_deref()),
    };
    if options.svg || !options.open {
        Output::write(&options.solve.output, &options.solve.mechanism, &text)?;
    } else {
        open(options, &text, &document)?;
    }
    if !options.parts {
        remind(&document);
    }
    Ok(exit)
}

/// Tells what was understood of the file, as `solve` does below its table; a page may be made of it by mistake.
fn remind(document: &Value) {
    for remark in document["remarks"].as_array().into_iter().flatten().filter_map(Value::as_str) {
        eprintln!("note: {remark}");
    }
}

/// Returns a saved document, or a fresh one.
fn document(options: &ViewOptions) -> Result<(Exit, Value), Fault> {
    let name = &options.solve.mechanism;
    if let Some(document) = saved(name)? {
        return Ok((exit_of(&document), document));
    }
    if name == "-" {
        let message =
            "found something else on standard input, expected what solve, sweep, mobility or bench --json prints";
        return Err(Error::Invalid(message.to_owned()).into());
    }
    let memory = Memory::default();
    let exit = if options.sweep {
        sweep::run_to(&sweep_options(options), || Ok(memory.output()))?
    } else {
        let mut solve = options.solve.clone();
        (solve.json, solve.jsonl, solve.scene) = (true, false, true);
        match solve::run_to(&solve, || Ok(memory.output())) {
            Ok(exit) => exit,
            // A framework is refused there. Other files are read once, as live pages read one for every answer.
            Err(fault) => return framework(options)?.ok_or(fault),
        }
    };
    let document = memory.take().map_err(|error| Error::Invalid(format!("the answer is no document: {error}")))?;
    Ok((exit, document))
}

/// Reads a document from a file or standard input.
fn saved(name: &str) -> Result<Option<Value>, Fault> {
    let read = |mut reader: Box<dyn Read>| {
        let mut text = String::new();
        reader.read_to_string(&mut text).map(|_| text)
    };
    if name == "-" {
        let text = read(Box::new(std::io::stdin().take(MOST_BYTES)))
            .map_err(|error| Error::Io { path: "standard input".to_owned(), message: error.to_string() })?;
        return Ok(parse(&text));
    }
    let path = Path::new(name);
    let is_json =
        path.extension().is_some_and(|end| end.eq_ignore_ascii_case("json") || end.eq_ignore_ascii_case("jsonl"));
    if !is_json || !path.is_file() {
        return Ok(None);
    }
    // A file that is no document is left to the reader of mechanism files, whose messages name the place.
    let file = std::fs::File::open(path).ok();
    let text = file.and_then(|file| read(Box::new(file.take(MOST_BYTES))).ok());
    Ok(text.and_then(|text| parse(&text)))
}

/// Returns the exit code that belongs to the verdicts of a saved document.
fn exit_of(document: &Value) -> Exit {
    if is_scores(document) {
        return Exit::Complete;
    }
    let one = |verdict: &Value| match (verdict["status"].as_str(), verdict["proof"] == "proved") {
        (Some("complete"), true) => Exit::Complete,
        (Some("unreachable"), true) => Exit::Unreachable,
        (Some("unsupported"), _) => Exit::Unsupported,
        _ => Exit::NotProved,
    };
    let results = document["results"].as_array().into_iter().flatten();
    let worst = results.map(|result| one(&result["verdict"])).max();
    match worst {
        Some(exit) => exit,
        None if document["branches"].is_array() => one(&document["verdict"]),
        None if document["proof"] == "proved" => Exit::Complete,
        None => Exit::NotProved,
    }
}

fn sweep_options(options: &ViewOptions) -> SweepOptions {
    let solve = &options.solve;
    SweepOptions {
        mechanism: solve.mechanism.clone(),
        joint: options.joint.clone(),
        from: options.from.clone().unwrap_or_default(),
        to: options.to.clone().unwrap_or_default(),
        steps: options.steps,
        csv: false,
        svg: false,
        centrodes: None,
        axodes: None,
        certificate: None,
        ratio: None,
        trace: options.trace.clone(),
        json: true,
        scene: true,
        drawn: SeedOptions { seed: solve.seed },
        threads: solve.threads,
        quiet: true,
        read: solve.read.clone(),
        output: solve.output.clone(),
    }
}

/// Decides whether a framework moves, if the file is one.
fn framework(options: &ViewOptions) -> Result<Option<(Exit, Value)>, Fault> {
    /// Number of steps, the default of `looproot mobility`.
    const STEPS: usize = 60;
    let solve = &options.solve;
    let read = Options { chains: Chains::Any, ..solve.read.options() };
    // Faults of a file of another kind are reported by its reader.
    let Ok(Any::Framework(file)) = load_any(&solve.mechanism, &read) else { return Ok(None) };
    let answer = file.mobility(STEPS)?;
    let exit = if answer.is_proved() { Exit::Complete } else { Exit::NotProved };
    Ok(Some((exit, framework::json(&file, &answer))))
}

/// Writes the page and shows it.
fn open(options: &ViewOptions, text: &str, document: &Value) -> Result<(), Fault> {
    let path = options.solve.output.output.clone().unwrap_or_else(|| temporary(document));
    let fault = |error: std::io::Error| Error::Io { path: path.display().to_string(), message: error.to_string() };
    std::fs::write(&path, text).map_err(fault)?;
    let (program, before): (&str, &[&str]) = match std::env::consts::OS {
        "macos" => ("open", &[]),
        "windows" => ("cmd", &["/C", "start", ""]),
        _ => ("xdg-open", &[]),
    };
    let child = Command::new(program)
        .args(before)
        .arg(&path)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    child.map_err(|error| {
        let place = path.display();
        Error::Invalid(format!("found no browser by `{program}` ({error}), expected one; the page is {place}"))
    })?;
    Ok(())
}

/// Returns the path of a temporary file for this page alone.
fn temporary(document: &Value) -> PathBuf {
    let name = document["name"].as_str().unwrap_or("page");
    let safe: String = name.chars().map(|c| if c.is_ascii_alphanumeric() || c == '_' { c } else { '-' }).collect();
    std::env::temp_dir().join(format!("looproot-{safe}-{}.html", std::process::id()))
}
