//! Frameworks in normalised form.

use super::{labels, origin};
use crate::algebra::number::nearest_f64;
use crate::catalogue::FrameworkFile;
use crate::report::json::number;
use crate::report::number::{counted, short as rounded};
use crate::report::table::Columns;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// `framework, 9 vertices, 21 bars`.
pub(super) fn short(file: &FrameworkFile) -> String {
    format!("framework, {}", size(file))
}

fn size(file: &FrameworkFile) -> String {
    let mut size = format!("{} vertices, {}", file.names.len(), counted(file.framework.given_bars, "bar"));
    if !file.bodies.is_empty() {
        let noun = if file.bodies.len() == 1 { "body" } else { "bodies" };
        let _ = write!(size, ", {} {noun}", file.bodies.len());
    }
    size
}

pub(super) fn identity(file: &FrameworkFile) -> Map<String, Value> {
    let heading = &file.heading;
    labels(&heading.name, &heading.title, "framework", &size(file), heading.source.as_ref())
}

/// The bars that the file gives: their ends, and their lengths there or at the vertices.
fn bars(file: &FrameworkFile) -> Vec<([usize; 2], f64)> {
    let squares = file.squares.clone().unwrap_or_else(|| file.framework.squares());
    let given = file.framework.bars.iter().take(file.framework.given_bars);
    given.zip(squares).map(|(bar, square)| (*bar, nearest_f64(&square).sqrt())).collect()
}

/// Vertices, bars and bodies as tables.
pub(super) fn text(file: &FrameworkFile) -> String {
    let mut text = format!("{}\n{}\n", file.heading.title, short(file));
    origin(&mut text, file.heading.source.as_ref(), file.heading.notes.as_deref());
    text.push_str(match (&file.squares, file.exact) {
        (Some(_), _) => "lengths are given; the vertices are where the search for a realisation begins\n",
        (None, true) => "exact; the lengths are those between the vertices\n",
        (None, false) => "exact: no; the lengths are those between the vertices\n",
    });
    let metres = |length: f64| rounded(length, 9);
    let mut table = Columns::new(&["vertex", "x [m]", "y [m]", "z [m]"], &["vertex"]);
    for (name, vertex) in file.names.iter().zip(&file.framework.vertices) {
        let [x, y, z] = vertex.each_ref().map(|x| metres(nearest_f64(x)));
        table.row([name.clone(), x, y, z]);
    }
    let _ = write!(text, "\n{}", table.text());
    let mut table = Columns::new(&["bar", "length [m]"], &["bar"]);
    for ([a, b], length) in bars(file) {
        table.row([format!("{} {}", file.names[a], file.names[b]), metres(length)]);
    }
    if file.framework.given_bars > 0 {
        let _ = write!(text, "\n{}", table.text());
    }
    for body in &file.bodies {
        let names: Vec<&str> = body.iter().map(|vertex| file.names[*vertex].as_str()).collect();
        let _ = write!(text, "\nbody {}", names.join(" "));
    }
    let claims = [("dimension", file.dimension), ("infinitesimal", file.infinitesimal)];
    text + "\n" + &super::claims(claims.map(|(what, claim)| (what, claim.map(|count| count.to_string()))))
}

/// Vertices, bars and bodies, lengths in metres.
#[must_use]
pub fn json(file: &FrameworkFile) -> Value {
    let mut object = identity(file);
    super::remarks(&mut object, file.heading.source.as_ref(), file.heading.notes.as_deref());
    let vertex = |vertex: &[rug::Rational; 3]| vertex.each_ref().map(|x| number(nearest_f64(x)));
    let bars: Vec<Value> =
        bars(file).iter().map(|(ends, length)| json!({ "ends": ends, "length": number(*length) })).collect();
    object.insert("names".into(), json!(file.names));
    object.insert("vertices".into(), file.framework.vertices.iter().map(|v| json!(vertex(v))).collect());
    object.insert("bars".into(), json!(bars));
    object.insert("bodies".into(), json!(file.bodies));
    object.insert("lengths_given".into(), json!(file.squares.is_some()));
    object.insert("exact".into(), json!(file.exact));
    object.insert("expected".into(), json!({ "dimension": file.dimension, "infinitesimal": file.infinitesimal }));
    Value::Object(object)
}
