//! `looproot check`

use super::arguments::CheckOptions;
use super::exit::{Exit, Fault, complain};
use super::output::{pool, print};
use looproot::internal::catalogue::{
    Any, Options, builtin_any, builtin_names, builtin_page, calculus_names, is_ansatz, load_any, moving_names,
};
use looproot::internal::claims::{Finding, Judgement, Sort, judge_any};
use looproot::internal::error::Error;
use looproot::internal::report::atlas::judged;
use looproot::internal::report::number::{counted, duration};
use looproot::internal::report::table::Columns;
use rayon::prelude::*;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

/// A file or built-in entry, and the result for its claims.
struct Checked {
    name: String,
    outcome: Result<Judgement, Error>,
    microseconds: f64,
}

/// Solves every named mechanism and compares the results with its claims.
pub fn run(options: &CheckOptions) -> Result<Exit, Fault> {
    let is_library = options.paths.is_empty();
    let names =
        if is_library { [builtin_names(), moving_names(), calculus_names()].concat() } else { files(&options.paths)? };
    let checked: Vec<Checked> = pool(options.threads)?.install(|| {
        let one = |name: &String| {
            let start = Instant::now();
            let reading = Options::default();
            let any = if is_library { builtin_any(name, &reading) } else { load_any(name, &reading) };
            let outcome = any.and_then(|any| {
                let mut judgement = judge_any(&any)?;
                judgement.findings.extend(page(name, is_library, &any)?);
                Ok(judgement)
            });
            Checked { name: name.clone(), outcome, microseconds: start.elapsed().as_secs_f64() * 1e6 }
        };
        names.par_iter().map(one).collect()
    });
    print(&if options.json { document(&checked) } else { text(&checked, options.quiet) })?;
    let mut exit = Exit::Complete;
    for one in &checked {
        exit = exit.max(match &one.outcome {
            Ok(judgement) if judgement.failures().next().is_none() => Exit::Complete,
            Ok(_) => Exit::NotProved,
            Err(error) => {
                let message = error.to_string();
                complain(&if message.contains(&one.name) { message } else { format!("{}: {message}", one.name) });
                Exit::of_error(error)
            }
        });
    }
    Ok(exit)
}

/// Checks whether the equations beside a file, if there are any, are those derived from it.
fn page(name: &str, is_library: bool, any: &Any) -> Result<Option<Finding>, Error> {
    if !matches!(any, Any::Entry(_) | Any::Linkage(_) | Any::Space(_) | Any::Sphere(_)) {
        return Ok(None);
    }
    let path = Path::new(name).with_extension("eqs");
    if is_library || !Path::new(name).is_file() {
        return Ok(builtin_page(name).map(|(file, text)| judged(any, &file, text)));
    }
    // A name without extension would be its own equations file.
    if !path.is_file() || path == Path::new(name) {
        return Ok(None);
    }
    let file = path.display().to_string();
    let text =
        std::fs::read_to_string(&path).map_err(|error| Error::Io { path: file.clone(), message: error.to_string() })?;
    Ok(Some(judged(any, &file, &text)))
}

/// Returns the mechanism files under these paths, in order; names of built-in entries are kept as they are.
pub fn files(paths: &[String]) -> Result<Vec<String>, Error> {
    let mut files = Vec::new();
    for path in paths {
        if Path::new(path).is_dir() {
            let before = files.len();
            collect(Path::new(path), &mut files)?;
            if files.len() == before {
                let message = "found no mechanism file (.toml) in it".to_owned();
                return Err(Error::Io { path: path.clone(), message });
            }
        } else {
            files.push(path.clone());
        }
    }
    Ok(files)
}

fn collect(folder: &Path, files: &mut Vec<String>) -> Result<(), Error> {
    let fault = |error: std::io::Error| Error::Io { path: folder.display().to_string(), message: error.to_string() };
    let mut inside = Vec::new();
    for item in std::fs::read_dir(folder).map_err(fault)? {
        inside.push(item.map_err(fault)?.path());
    }
    inside.sort();
    for path in inside {
        // Links to folders may form cycles.
        if path.is_dir() && !path.is_symlink() {
            collect(&path, files)?;
        } else if path.is_file() && path.extension().is_some_and(|extension| extension == "toml") {
            // Loops with symbols make no claims: they are questions. A file that cannot be read is reported like any other.
            let asks = std::fs::read_to_string(&path).is_ok_and(|text| is_ansatz(&text));
            if !asks {
                files.push(path.display().to_string());
            }
        }
    }
    Ok(())
}

fn text(checked: &[Checked], quiet: bool) -> String {
    let mut text = String::new();
    if !quiet {
        let mut header = vec!["entry", "cases", "complete"];
        header.extend(Sort::ALL.map(Sort::word));
        header.extend(["time", "claims"]);
        let mut table = Columns::new(&header, &["entry", "claims"]);
        for one in checked {
            table.row(row(one));
        }
        text += &table.text();
        text.push('\n');
    }
    for one in checked {
        for failure in one.outcome.iter().flat_map(Judgement::failures) {
            let file = failure.file.as_ref().unwrap_or(&one.name);
            let _ = writeln!(text, "{file}:{}: case {}: {}", failure.line, failure.case, failure.message);
        }
    }
    let judged = || checked.iter().filter_map(|one| one.outcome.as_ref().ok());
    let claims: usize = judged().map(|judgement| judgement.findings.len()).sum();
    let failed: usize = judged().map(|judgement| judgement.failures().count()).sum();
    let cases: usize = judged().map(|judgement| judgement.cases).sum();
    let complete: usize = judged().map(|judgement| judgement.complete).sum();
    let self_motions: usize = judged().map(|judgement| judgement.self_motions).sum();
    let what = format!("{} in {}", counted(claims, "claim"), counted(judged().count(), "entry"));
    let outcome = if failed == 0 { format!("{what} hold") } else { format!("{failed} of {what} FAIL") };
    let motions = if self_motions > 0 { format!(", {}", counted(self_motions, "self-motion")) } else { String::new() };
    let _ = writeln!(text, "{outcome}; {complete} of {} proved complete{motions}", counted(cases, "case"));
    let unread = checked.len() - judged().count();
    if unread > 0 {
        let _ = writeln!(text, "{} could not be checked", counted(unread, "entry"));
    }
    text
}

fn row(one: &Checked) -> Vec<String> {
    let mut row = vec![one.name.clone()];
    match &one.outcome {
        Ok(judgement) => {
            row.extend([judgement.cases.to_string(), judgement.complete.to_string()]);
            row.extend(Sort::ALL.map(|sort| match judgement.score(sort) {
                (_, 0) => String::new(),
                (good, all) if good == all => all.to_string(),
                (good, all) => format!("{good}/{all}"),
            }));
            row.push(duration(one.microseconds));
            row.push(if judgement.failures().next().is_none() { "hold" } else { "FAIL" }.to_owned());
        }
        Err(error) => {
            row.extend(vec![String::new(); 3 + Sort::ALL.len()]);
            row.push(if error.exit_code() == 4 { "unsupported" } else { "unreadable" }.to_owned());
        }
    }
    row
}

fn document(checked: &[Checked]) -> String {
    let lines = checked.iter().map(|one| {
        let mut line = json!({ "entry": one.name });
        match &one.outcome {
            Ok(judgement) => {
                line["holds"] = json!(judgement.failures().next().is_none());
                line["cases"] = json!(judgement.cases);
                line["complete"] = json!(judgement.complete);
                line["self_motions"] = json!(judgement.self_motions);
                line["claims"] = json!(judgement.findings.len());
                let failures = judgement.failures().map(|failure| -> Value {
                    json!({
                        "file": failure.file.as_ref().unwrap_or(&one.name),
                        "line": failure.line,
                        "case": failure.case,
                        "claim": failure.sort.word(),
                        "message": failure.message,
                    })
                });
                line["failures"] = json!(failures.collect::<Vec<_>>());
            }
            Err(error) => {
                line["holds"] = Value::Null;
                line["error"] = json!(error.to_string());
            }
        }
        line.to_string()
    });
    format!("[\n  {}\n]\n", lines.collect::<Vec<_>>().join(",\n  "))
}
