//! `looproot list`

use super::arguments::ListOptions;
use super::exit::{Exit, Fault};
use super::output::print;
use looproot::catalogue::entry::{Entry, Kind};
use looproot::catalogue::{Options, builtin, builtin_names};
use looproot::report::json::kind;
use looproot::report::model::{cases, claimed, joints, summary};
use looproot::report::table::Columns;
use serde_json::{Value, json};

/// Prints the built-in library, one entry a line.
pub fn run(options: &ListOptions) -> Result<Exit, Fault> {
    let mut entries = Vec::new();
    for name in builtin_names() {
        let entry = builtin(&name, &Options::default())?;
        entries.push((name, entry));
    }
    print(&if options.json { document(&entries) } else { table(&entries) })?;
    Ok(Exit::Complete)
}

fn table(entries: &[(String, Entry)]) -> String {
    let header = ["name", "mechanism", "cases", "complex", "real", "source", "title"];
    let mut table = Columns::new(&header, &["name", "mechanism", "source", "title"]);
    for (name, entry) in entries {
        table.row([
            name.clone(),
            format!("{} {}", joints(entry), kind(entry.kind())),
            cases(entry),
            claimed(entry, |claims| claims.complex),
            claimed(entry, |claims| claims.real),
            entry.source.as_ref().map_or(String::new(), |source| source.key.clone()),
            entry.title.clone(),
        ]);
    }
    table.text()
}

fn document(entries: &[(String, Entry)]) -> String {
    let lines = entries.iter().map(|(name, entry)| {
        let mut line = summary(entry);
        line["name"] = json!(name);
        let cases = match entry.kind() {
            Kind::Arm => "poses",
            Kind::Loop => "inputs",
            Kind::Platform => "leg_sets",
        };
        line[cases] = json!(entry.cases.len());
        let counts = |claim: fn(&_) -> Option<usize>| -> Vec<Value> {
            entry.cases.iter().map(|case| json!(claim(&case.expected))).collect()
        };
        line["expected"] = json!({ "complex": counts(|e| e.complex), "real": counts(|e| e.real) });
        line.to_string()
    });
    format!("[\n{}\n]\n", lines.collect::<Vec<_>>().join(",\n"))
}
