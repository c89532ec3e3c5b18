//! One elimination of several: the verdict, its matrix, then the derivation; as text, JSON and a paper.

use super::derivation::{self, paper_with};
use super::paper::Style;
use crate::algebra::text::Format;
use crate::catalogue::entry::Entry;
use crate::derivation::{ByWay, Removed, Substitution};
use serde_json::{Value, json};
use std::fmt::Write;

/// Factors longer than this are described by their degree.
const LONGEST_FACTOR: usize = 60;

/// `raghavan-roth: 12 x 12 matrix of degree 2, eliminant of degree 24 before false factors; degree 16 in t3 ...`
#[must_use]
pub fn verdict(by: &ByWay) -> String {
    let matrix = &by.matrix;
    format!(
        "{}: {} x {} matrix of degree {}, eliminant of degree {} before false factors; {}",
        by.way.name(),
        matrix.rows,
        matrix.columns,
        matrix.entries,
        by.before,
        derivation::verdict(&by.derivation)
    )
}

fn factor(by: &ByWay, one: &Removed) -> String {
    let power = if one.multiplicity > 1 { format!("^{}", one.multiplicity) } else { String::new() };
    let Some(factor) = &one.factor else { return format!("{} roots at infinity", one.multiplicity) };
    let text = Format::Text.polynomial(factor, &by.derivation.names);
    let degree = factor.total_degree().unwrap_or(0);
    if text.len() <= LONGEST_FACTOR { format!("({text}){power}") } else { format!("(degree {degree}){power}") }
}

/// A line for each factor that was divided out, and why.
fn divided(by: &ByWay) -> Vec<String> {
    by.divided.iter().map(|one| format!("{}: {}", factor(by, one), one.reason)).collect()
}

/// Everything for a reader.
#[must_use]
pub fn text(by: &ByWay) -> String {
    let matrix = &by.matrix;
    let mut text = verdict(by) + "\n";
    let _ = writeln!(
        text,
        "\nMatrix: {} x {}, entries of degree {}: {}",
        matrix.rows, matrix.columns, matrix.entries, matrix.meaning
    );
    if !by.divided.is_empty() {
        text.push_str("Divided out of the eliminant\n");
    }
    for line in divided(by) {
        let _ = writeln!(text, "  {line}");
    }
    // Its verdict stands above.
    let derived = derivation::text(&by.derivation);
    text + derived.split_once('\n').map_or("", |(_, rest)| rest)
}

/// The document that equations/derivation.schema.json describes.
#[must_use]
pub fn json(entry: &Entry, case: usize, by: &ByWay) -> Value {
    let mut document = derivation::json(entry, case, &by.derivation);
    let matrix = &by.matrix;
    let factors = by.divided.iter().map(|one| {
        let text = one.factor.as_ref().map(|factor| Format::Text.polynomial(factor, &by.derivation.names));
        json!({ "factor": text, "multiplicity": one.multiplicity, "reason": one.reason })
    });
    document["by"] = json!({
        "way": by.way.name(),
        "matrix": { "rows": matrix.rows, "columns": matrix.columns, "degree": matrix.entries, "meaning": matrix.meaning },
        "degree_before": by.before,
        "false_factors": factors.collect::<Vec<_>>(),
    });
    document["verdict"] = json!(verdict(by));
    document
}

/// The derivation as a paper.
#[must_use]
pub fn paper(entry: &Entry, case: usize, by: &ByWay, found: &Substitution, style: Style) -> String {
    let matrix = &by.matrix;
    let sentence = format!(
        "The matrix is of size {} x {}, with entries of degree {}: {}. The eliminant is of degree {} before false factors are divided out.",
        matrix.rows, matrix.columns, matrix.entries, matrix.meaning, by.before
    );
    paper_with(entry, case, &by.derivation, found, style, Some((by.way.name(), &sentence, &divided(by))))
}
