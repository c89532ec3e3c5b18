//! Loops with symbols in normalised form.

use super::{labels, origin};
use crate::algebra::number::nearest_f64;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::text::Format;
use crate::catalogue::ansatz::{Ansatz, Twist};
use crate::report::number::short as rounded;
use crate::report::table::{Columns, paragraph};
use rug::Rational;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// `4R loop with symbols`.
pub(super) fn short(file: &Ansatz) -> String {
    format!("{}R loop with symbols", file.joints.len())
}

pub(super) fn identity(file: &Ansatz) -> Map<String, Value> {
    let kinds = "R".repeat(file.joints.len());
    labels(&file.name, &file.title, "conditions", &kinds, file.source.as_ref())
}

fn length(file: &Ansatz, length: &Polynomial<Rational>) -> String {
    Format::Text.polynomial(length, file.symbols.names())
}

/// A sum such as `2 alpha - beta + 90 deg`.
fn angle(file: &Ansatz, twist: &Twist) -> String {
    let (cos, sin) = &twist.constant;
    let constant = nearest_f64(sin).atan2(nearest_f64(cos)).to_degrees();
    let mut terms: Vec<(bool, String)> = Vec::new();
    for (&multiple, name) in twist.multiples.iter().zip(&file.symbols.angles) {
        match multiple.unsigned_abs() {
            0 => {}
            1 => terms.push((multiple < 0, name.clone())),
            size => terms.push((multiple < 0, format!("{size} {name}"))),
        }
    }
    if constant != 0.0 || terms.is_empty() {
        terms.push((constant < 0.0, format!("{} deg", rounded(constant.abs(), 6))));
    }
    let mut text = String::new();
    for (index, (negative, term)) in terms.iter().enumerate() {
        text.push_str(match (index, negative) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        });
        text.push_str(term);
    }
    text
}

/// The joints as a table, and the relations between the symbols.
pub(super) fn text(file: &Ansatz) -> String {
    let mut text = format!("{}\n{}, dh: Rz(q) Tz(d) Tx(a) Rx(alpha)\n", file.title, short(file));
    origin(&mut text, file.source.as_ref(), file.notes.as_deref());
    for (what, names) in [("angles", &file.symbols.angles), ("lengths", &file.symbols.lengths)] {
        if !names.is_empty() {
            paragraph(&mut text, &format!("{what}: {}", names.join(", ")));
        }
    }
    if file.rounded {
        paragraph(&mut text, "exact: no; some numbers are irrational and rounded for exact work (--digits)");
    }
    let header = ["joint", "a [m]", "alpha", "d [m]"];
    let mut table = Columns::new(&header, &header[1..]);
    for (number, joint) in (1..).zip(&file.joints) {
        let row = [number.to_string(), length(file, &joint.a), angle(file, &joint.alpha), length(file, &joint.d)];
        table.row(row);
    }
    let _ = writeln!(text, "\n{}", table.text());
    for relation in &file.relations {
        let _ = writeln!(text, "relation: {}", relation.text);
    }
    let unknown = unknown(file);
    if !unknown.is_empty() {
        let _ = writeln!(text, "unknown: {}", unknown.join(", "));
    }
    if !file.fit.is_empty() {
        let _ = writeln!(text, "a condition may have {} terms", file.fit.len());
    }
    text + "a question: no claims\n"
}

fn unknown(file: &Ansatz) -> Vec<&str> {
    file.unknown.iter().map(|&length| file.symbols.lengths[length].as_str()).collect()
}

/// Joints and relations, in symbols, metres and degrees.
#[must_use]
pub fn json(file: &Ansatz) -> Value {
    let mut object = identity(file);
    super::remarks(&mut object, file.source.as_ref(), file.notes.as_deref());
    let joints = file.joints.iter().map(|joint| {
        json!({
            "type": "R",
            "a": length(file, &joint.a),
            "alpha": angle(file, &joint.alpha),
            "d": length(file, &joint.d),
        })
    });
    let relations: Vec<&str> = file.relations.iter().map(|relation| relation.text.as_str()).collect();
    let fit: Vec<String> = file.fit.iter().map(|term| length(file, term)).collect();
    object.insert("convention".into(), json!("dh"));
    object.insert("symbols".into(), json!({ "angles": file.symbols.angles, "lengths": file.symbols.lengths }));
    object.insert("joints".into(), joints.collect());
    object.insert("relations".into(), json!(relations));
    object.insert("unknown".into(), json!(unknown(file)));
    object.insert("fit".into(), json!(fit));
    object.insert("exact".into(), json!(!file.rounded));
    Value::Object(object)
}
