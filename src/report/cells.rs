//! The cells of one or two parameters as text and JSON.

use super::json::number;
use super::number::counted;
use super::table::{Columns, paragraph};
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::text::{Format, Names};
use crate::algebra::univariate::Univariate;
use crate::kinematics::closed_loop::Variable;
use crate::sweep::{Cell, CellMap, Cells, Column, Zero};
use crate::verdict::{Code, Proof};
use rug::{Integer, Rational};
use serde_json::{Value, json};
use std::fmt::Write;

/// Polynomials longer than this are described by their degree.
const LONGEST: usize = 1500;

/// `theta1: 2 cells with 0 and 2 real modes, 2 zeros; proved`
#[must_use]
pub fn verdict(cells: &Cells) -> String {
    let mut modes: Vec<usize> = cells.cells.iter().map(|cell| cell.modes).collect();
    modes.sort_unstable();
    modes.dedup();
    let modes: Vec<String> = modes.iter().map(ToString::to_string).collect();
    format!(
        "{}: {} with {} {}, {}; {}",
        cells.parameter,
        counted(cells.cells.len(), "cell"),
        modes.join(", "),
        what_is_counted(cells),
        counted(cells.zeros.len(), "zero"),
        certainty(cells.verdict.proof)
    )
}

/// What the numbers of cells count: a root of the closure polynomial may have several real modes, or none.
fn what_is_counted(cells: &Cells) -> &'static str {
    if cells.verdict.code == Code::CellsNotMatched { "real roots" } else { "real modes" }
}

fn certainty(proof: Proof) -> &'static str {
    match proof {
        Proof::Proved => "proved",
        Proof::Probable { .. } => "probability of error below 2^-40",
        Proof::RoundedData => "proved for the rounded numbers",
        Proof::None => "not proved",
    }
}

/// Degrees, or a length.
fn shown(x: f64, kind: Variable) -> String {
    match kind {
        Variable::Rotation => format!("{:.6}", x.to_degrees() + 0.0),
        Variable::Translation => format!("{:.9}", x + 0.0),
    }
}

fn unit(kind: Variable) -> &'static str {
    if kind == Variable::Rotation { "deg" } else { "m" }
}

/// Returns the names of the variables.
fn names(cells: &Cells) -> [&str; 2] {
    [&cells.variable, &cells.unknown]
}

fn plain(polynomial: &Polynomial<Int>, names: &[&str]) -> Option<String> {
    let names = Names::given(names.iter().copied()).ok()?;
    let image = |c: &Int| Some(Rational::from(c.to_integer()));
    Some(Format::Text.polynomial(&polynomial.map(image)?, &names))
}

fn factor(factor: &Univariate<Integer>, name: &str) -> Option<String> {
    let polynomial = Polynomial::from_univariate(0, &factor.map(|c| Some(Int::from(c.clone())))?);
    plain(&polynomial, &[name])
}

fn short(text: Option<String>, degree: usize) -> String {
    match text {
        Some(text) if text.len() <= LONGEST => text,
        _ => format!("of degree {degree}, in --json"),
    }
}

/// Everything for a reader.
#[must_use]
pub fn text(cells: &Cells) -> String {
    let mut text = verdict(cells) + "\n";
    paragraph(&mut text, &format!("why: {}", cells.verdict.reason));
    let [s, t] = names(cells);
    let [of_s, of_t] = [0, 1].map(|k| cells.polynomial.degree(k));
    let meaning = |name: &str, kind: Variable| match kind {
        Variable::Rotation => format!("{name}, a half-angle tangent"),
        Variable::Translation => format!("{name}, a length"),
    };
    let _ = writeln!(
        text,
        "\nClosure polynomial, degree {of_s} in {}, degree {of_t} in {}",
        meaning(s, cells.kind),
        meaning(t, cells.unknown_kind)
    );
    let _ = writeln!(text, "  {}", short(plain(&cells.polynomial, &[s, t]), of_s as usize));
    let _ = writeln!(text, "\nDiscriminant by {t}, square-free factors");
    if cells.discriminant.is_empty() {
        let _ = writeln!(text, "  a number");
    }
    for (one, multiplicity) in &cells.discriminant {
        let degree = one.degree().unwrap_or(0);
        let _ = writeln!(text, "  ({})^{multiplicity}, degree {degree}", short(factor(one, s), degree));
    }
    let parameter = format!("{} [{}]", cells.parameter, unit(cells.kind));
    if !cells.zeros.is_empty() {
        text.push_str("\nZeros\n");
        let mut table = Columns::new(&[parameter.as_str(), "order", what_is_counted(cells), "what", s], &["what", s]);
        for zero in &cells.zeros {
            let [before, behind] = zero.modes;
            let order = if zero.order > 0 { zero.order.to_string() } else { "-".to_owned() };
            let exact = zero.exact.as_ref().map_or_else(String::new, ToString::to_string);
            let modes = format!("{before} to {behind}");
            table.row([shown(zero.value, cells.kind), order, modes, zero.label.word().to_owned(), exact]);
        }
        text.push_str(&table.text());
    }
    text.push_str("\nCells\n");
    let header = ["from", "to", what_is_counted(cells), "sample", s, "solver"];
    let mut table = Columns::new(&header, &[s]);
    for cell in &cells.cells {
        let end = |x: Option<f64>, infinite: &str| {
            x.map_or_else(
                || if cells.kind == Variable::Rotation { "-".to_owned() } else { infinite.to_owned() },
                |x| shown(x, cells.kind),
            )
        };
        let solved = cell.solved.map_or_else(|| "not complete".to_owned(), |n| n.to_string());
        table.row([
            end(cell.from, "-inf"),
            end(cell.to, "inf"),
            cell.modes.to_string(),
            shown(cell.value, cells.kind),
            cell.sample.to_string(),
            solved,
        ]);
    }
    text + &table.text()
}

fn zero(zero: &Zero) -> Value {
    json!({
        "value": number(zero.value),
        "exact": zero.exact.as_ref().map(ToString::to_string),
        "order": zero.order,
        "label": zero.label.word(),
        "modes": zero.modes,
        "at": zero.at,
    })
}

fn cell(cell: &Cell) -> Value {
    json!({
        "from": cell.from.map(number),
        "to": cell.to.map(number),
        "sample": { "exact": cell.sample.to_string(), "value": number(cell.value) },
        "modes": cell.modes,
        "solved": cell.solved,
    })
}

fn parameter(name: &str, kind: Variable, given: Option<f64>) -> Value {
    json!({ "name": name, "kind": if kind == Variable::Rotation { "angle" } else { "distance" }, "given": given.map(number) })
}

fn judged(verdict: &crate::sweep::CellsVerdict) -> Value {
    let mut value = json!({
        "proof": verdict.proof.word(),
        "code": verdict.code.word(),
        "reason": verdict.reason,
    });
    if let Proof::Probable { error, seed } = verdict.proof {
        value["probability_of_error"] = json!(error);
        value["seed"] = json!(seed);
    }
    value
}

/// The document of one parameter that equations/cells.schema.json describes, but for the keys about the file.
#[must_use]
pub fn json(cells: &Cells) -> Value {
    let [s, t] = names(cells);
    let factors = cells.discriminant.iter().map(|(one, multiplicity)| {
        let coefficients: Vec<String> = one.coefficients().iter().map(ToString::to_string).collect();
        json!({ "coefficients": coefficients, "multiplicity": multiplicity })
    });
    json!({
        "parameters": [parameter(&cells.parameter, cells.kind, cells.given)],
        "polynomial": {
            "variables": [s, t],
            "degrees": [cells.polynomial.degree(0), cells.polynomial.degree(1)],
            "text": plain(&cells.polynomial, &[s, t]),
        },
        "discriminant": { "variable": s, "factors": factors.collect::<Vec<_>>() },
        "zeros": cells.zeros.iter().map(zero).collect::<Vec<_>>(),
        "cells": cells.cells.iter().map(cell).collect::<Vec<_>>(),
        "verdict": judged(&cells.verdict),
    })
}

/// The weakest of what the columns rest on.
fn weakest(map: &CellMap) -> Proof {
    let rank = |proof: &Proof| match proof {
        Proof::None => 0,
        Proof::RoundedData => 1,
        Proof::Probable { .. } => 2,
        Proof::Proved => 3,
    };
    let proofs =
        map.columns.iter().map(|column| column.cells.as_ref().map_or(Proof::None, |cells| cells.verdict.proof));
    proofs.min_by_key(rank).unwrap_or(Proof::None)
}

/// `theta1, a2: 72 columns with 0, 2 real modes; columns proved`
#[must_use]
pub fn map_verdict(map: &CellMap) -> String {
    let all = map.columns.iter().filter_map(|column| column.cells.as_ref().ok()).flat_map(|cells| &cells.cells);
    let mut modes: Vec<usize> = all.map(|cell| cell.modes).collect();
    modes.sort_unstable();
    modes.dedup();
    let modes: Vec<String> = modes.iter().map(ToString::to_string).collect();
    let columns = counted(map.columns.len(), "column");
    let [one, two] = &map.parameters;
    format!("{one}, {two}: {columns} with {} real modes; each column {}", modes.join(", "), certainty(weakest(map)))
}

/// Whether every column is proved.
#[must_use]
pub fn is_map_proved(map: &CellMap) -> bool {
    weakest(map).is_proved()
}

/// The map for a reader: the cells of every column.
#[must_use]
pub fn map_text(map: &CellMap) -> String {
    let mut text = map_verdict(map) + "\n\n";
    let [one, two] = [0, 1].map(|k| format!("{} [{}]", map.parameters[k], unit(map.kinds[k])));
    let last = format!("real modes | {two}");
    let mut table = Columns::new(&[one.as_str(), last.as_str()], &[last.as_str()]);
    for column in &map.columns {
        table.row([shown(column.value, map.kinds[0]), in_a_line(column, map.kinds[1])]);
    }
    text.push_str(&table.text());
    text
}

/// `0 | 12.5 | 2 | 70.1 | 0`: the modes of the cells, and the zeros between them.
fn in_a_line(column: &Column, kind: Variable) -> String {
    match &column.cells {
        Err(message) => message.clone(),
        Ok(cells) => {
            let ends = cells.zeros.iter().map(|zero| match kind {
                Variable::Rotation => format!("{:.3}", zero.value.to_degrees() + 0.0),
                Variable::Translation => format!("{:.6}", zero.value + 0.0),
            });
            let mut line = cells.cells.first().map_or_else(String::new, |cell| cell.modes.to_string());
            for (k, end) in ends.enumerate() {
                let behind = cells.cells.get(k + 1).or(cells.cells.first());
                let _ = write!(line, " | {end} | {}", behind.map_or(0, |cell| cell.modes));
            }
            line
        }
    }
}

/// The document of two parameters that equations/cells.schema.json describes, but for the keys about the file.
#[must_use]
pub fn map_json(map: &CellMap) -> Value {
    let column = |column: &Column| match &column.cells {
        Ok(cells) => json!({
            "value": number(column.value),
            "exact": column.exact.to_string(),
            "zeros": cells.zeros.iter().map(zero).collect::<Vec<_>>(),
            "cells": cells.cells.iter().map(cell).collect::<Vec<_>>(),
            "verdict": judged(&cells.verdict),
        }),
        Err(message) => json!({ "value": number(column.value), "exact": column.exact.to_string(), "error": message }),
    };
    let parameters = [0, 1].map(|k| parameter(&map.parameters[k], map.kinds[k], map.given[k]));
    json!({
        "parameters": parameters,
        "range": map.range.map(number),
        "columns": map.columns.iter().map(column).collect::<Vec<_>>(),
    })
}
