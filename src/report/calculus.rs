//! Answers about displacements and lines: JSON and text.

use super::json::{number, verdict};
use super::number::{counted, short};
use super::table::paragraph;
use super::text::View;
use crate::catalogue::CalculusFile;
use crate::displacement::{Answer, Mode};
use crate::verdict::Status;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// The document of all problems of a file.
#[must_use]
pub fn json(file: &CalculusFile, answers: &[Answer], view: &View) -> Value {
    json!({
        "title": file.heading.title,
        "kind": word(file),
        "find": file.find(),
        "name": file.heading.name,
        "version": env!("CARGO_PKG_VERSION"),
        "units": super::document::units(),
        "results": (1..).zip(answers).map(|(number, answer)| result(number, answer, view)).collect::<Vec<_>>(),
    })
}

/// A document as text: one line for every key, and one for every result.
#[must_use]
pub fn document(value: &Value) -> String {
    let Value::Object(fields) = value else { return format!("{value}\n") };
    let line = |(key, value): (&String, &Value)| {
        let text = match (key.as_str(), value.as_array()) {
            ("results", Some(items)) => {
                let items: Vec<String> = items.iter().map(|item| format!("\n    {item}")).collect();
                format!("[{}\n  ]", items.join(","))
            }
            _ => value.to_string(),
        };
        format!("  {}: {text}", json!(key))
    };
    let lines: Vec<String> = fields.iter().map(line).collect();
    format!("{{\n{}\n}}\n", lines.join(",\n"))
}

/// The word of the kind.
fn word(file: &CalculusFile) -> &'static str {
    use crate::catalogue::calculus::Question;
    match file.question {
        Question::Displacement(_) => "displacement",
        Question::Lines(_) => "lines",
        Question::Gearing(_) => "gearing",
    }
}

/// The answer to one problem; `number` is its number in the file, from 1.
#[must_use]
pub fn result(number: usize, answer: &Answer, view: &View) -> Value {
    let mut result = Map::new();
    result.insert("case".into(), json!(number));
    result.insert("verdict".into(), verdict(&answer.verdict));
    let shown = (1..).zip(&answer.modes).filter(|(_, mode)| mode.real || view.complex);
    result.insert("modes".into(), shown.map(|(id, own)| mode(id, own)).collect());
    result.extend(answer.keys.clone());
    result.insert("warnings".into(), json!(answer.warnings));
    Value::Object(result)
}

fn mode(id: usize, mode: &Mode) -> Value {
    let mut object = Map::new();
    object.insert("id".into(), json!(id));
    object.insert("real".into(), json!(mode.real));
    object.insert("multiplicity".into(), json!(mode.multiplicity));
    object.insert("residual".into(), number(mode.residual));
    object.insert("certified".into(), json!(mode.radius.is_some()));
    object.insert("radius".into(), mode.radius.map_or(Value::Null, number));
    object.extend(mode.values.clone());
    Value::Object(object)
}

/// The verdict in one line.
#[must_use]
pub fn line(answer: &Answer) -> String {
    let verdict = &answer.verdict;
    let proof = verdict.proof.word();
    match verdict.status {
        Status::Complete => {
            let all = counted(verdict.complex, "solution");
            format!("{} of {all} ({} real), proof: {proof}", verdict.complex, verdict.real)
        }
        Status::Unreachable => format!("0 real of {}, proof: {proof}", counted(verdict.complex, "solution")),
        Status::SelfMotion => format!("self-motion of dimension {}, proof: {proof}", verdict.self_motion),
        Status::Incomplete => format!("incomplete, proof: {proof}: {}", verdict.reason),
        Status::Unsupported => format!("unsupported: {}", verdict.reason),
    }
}

/// The verdict, the solutions, the reason.
#[must_use]
pub fn text(answer: &Answer, view: &View) -> String {
    let colour = match answer.verdict.status {
        Status::Complete => 32,
        Status::Unreachable | Status::SelfMotion => 33,
        Status::Incomplete | Status::Unsupported => 31,
    };
    let mut text = view.painted(&line(answer), colour) + "\n";
    if view.quiet {
        return text;
    }
    for (id, mode) in (1..).zip(&answer.modes).filter(|(_, mode)| mode.real || view.complex) {
        let kind = if mode.real { "real" } else { "complex" };
        let times = if mode.multiplicity > 1 { format!(", multiplicity {}", mode.multiplicity) } else { String::new() };
        let _ = writeln!(text, "\n{id} {kind}{times}");
        write_values(&mut text, &mode.values);
    }
    if !answer.keys.is_empty() {
        text.push('\n');
        write_values(&mut text, &answer.keys);
    }
    if answer.verdict.status != Status::Incomplete {
        text.push('\n');
        paragraph(&mut text, &format!("why: {}", answer.verdict.reason));
    }
    for warning in &answer.warnings {
        paragraph(&mut text, &format!("warning: {warning}"));
    }
    text
}

/// Named values, one a line.
pub fn write_values(text: &mut String, values: &Map<String, Value>) {
    for (name, value) in values {
        let _ = writeln!(text, "  {:<22} {}", name.replace('_', " "), shown(value));
    }
}

/// Decimals of the text: enough to compare, few enough to read. JSON has all digits.
const DECIMALS: usize = 9;

/// A value with short numbers.
fn shown(value: &Value) -> String {
    match value {
        Value::Number(number) => number.as_f64().map_or_else(|| number.to_string(), |x| short(x, DECIMALS)),
        Value::Array(items) => {
            let items: Vec<String> = items.iter().map(shown).collect();
            format!("[{}]", items.join(", "))
        }
        Value::Object(fields) => {
            let fields: Vec<String> = fields.iter().map(|(key, value)| format!("{key} {}", shown(value))).collect();
            fields.join(", ")
        }
        Value::String(text) => text.clone(),
        Value::Null => "none".to_owned(),
        Value::Bool(truth) => truth.to_string(),
    }
}
