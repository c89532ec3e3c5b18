//! `looproot list`

use super::arguments::ListOptions;
use super::exit::{Exit, Fault};
use super::output::print;
use looproot::internal::catalogue::entry::{Entry, Kind};
use looproot::internal::catalogue::{Any, Options, all_names, builtin_any, robot_names};
use looproot::internal::report::model::{cases, claimed, listed};
use looproot::internal::report::table::Columns;
use serde_json::{Value, json};

/// Prints the built-in library, one entry a line.
pub fn run(options: &ListOptions) -> Result<Exit, Fault> {
    let mut entries = Vec::new();
    let names = if options.what.is_some() { robot_names() } else { all_names() };
    for name in names {
        let any = builtin_any(&name, &Options::default())?;
        entries.push((name, any));
    }
    print(&if options.json { document(&entries) } else { table(&entries) })?;
    Ok(Exit::Complete)
}

fn table(entries: &[(String, Any)]) -> String {
    let header = ["name", "mechanism", "cases", "complex", "real", "source", "title"];
    let mut table = Columns::new(&header, &["name", "mechanism", "source", "title"]);
    for (name, any) in entries {
        let ([mechanism, source, title], _) = listed(any);
        let [cases, complex, real] = match any {
            Any::Entry(entry) => [cases(entry), claimed(entry, |e| e.complex), claimed(entry, |e| e.real)],
            Any::Linkage(file) => {
                let first = |claim: fn(&looproot::internal::catalogue::LinkageClaims) -> Option<usize>| {
                    file.cases
                        .iter()
                        .find_map(|case| claim(&case.expected))
                        .map_or(String::new(), |count| count.to_string())
                };
                [file.cases.len().to_string(), first(|e| e.complex), first(|e| e.real)]
            }
            Any::Sphere(file) => {
                let first = |claim: fn(&looproot::internal::catalogue::SphereClaims) -> Option<usize>| {
                    file.cases
                        .iter()
                        .find_map(|case| claim(&case.expected))
                        .map_or(String::new(), |count| count.to_string())
                };
                [file.cases.len().to_string(), first(|e| e.complex), first(|e| e.real)]
            }
            Any::Space(file) => {
                let first = |claim: fn(&looproot::internal::catalogue::SpaceClaims) -> Option<usize>| {
                    file.cases
                        .iter()
                        .find_map(|case| claim(&case.expected))
                        .map_or(String::new(), |count| count.to_string())
                };
                [file.cases.len().to_string(), first(|e| e.complex), first(|e| e.real)]
            }
            _ => Default::default(),
        };
        table.row([name.clone(), mechanism, cases, complex, real, source, title]);
    }
    table.text()
}

fn document(entries: &[(String, Any)]) -> String {
    let lines = entries.iter().map(|(name, any)| {
        let (_, mut line) = listed(any);
        line["name"] = json!(name);
        if let Any::Entry(entry) = any {
            count(&mut line, entry);
        }
        line.to_string()
    });
    format!("[\n{}\n]\n", lines.collect::<Vec<_>>().join(",\n"))
}

/// Adds the number of cases of an entry and its claims about them.
fn count(line: &mut Value, entry: &Entry) {
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
}
