//! Rational motions in normalised form.

use super::{labels, origin};
use crate::catalogue::MotionFile;
use crate::kinematics::motion_polynomial::parts;
use crate::report::table::Columns;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// Study's parameters.
const PARTS: [&str; 8] = ["x0", "x1", "x2", "x3", "y0", "y1", "y2", "y3"];

/// `motion of degree 2`.
pub(super) fn short(file: &MotionFile) -> String {
    format!("motion of {}", degree(file))
}

fn degree(file: &MotionFile) -> String {
    format!("degree {}", coefficients(file).len().saturating_sub(1))
}

pub(super) fn identity(file: &MotionFile) -> Map<String, Value> {
    let heading = &file.heading;
    labels(&heading.name, &heading.title, "motion", &degree(file), heading.source.as_ref())
}

/// The coefficients from the constant one up, by Study's parameters.
fn coefficients(file: &MotionFile) -> Vec<[String; 8]> {
    let parts = parts(&file.polynomial);
    let length = parts.iter().map(|part| part.coefficients().len()).max().unwrap_or(0);
    let coefficient = |power: usize| {
        parts.each_ref().map(|part| part.coefficients().get(power).map_or("0".to_owned(), ToString::to_string))
    };
    (0..length).map(coefficient).collect()
}

/// The monic motion polynomial as a table.
pub(super) fn text(file: &MotionFile) -> String {
    let mut text = format!("{}\n{}, monic, by its coefficients\n", file.heading.title, short(file));
    origin(&mut text, file.heading.source.as_ref(), file.heading.notes.as_deref());
    let header: Vec<&str> = std::iter::once("power of t").chain(PARTS).collect();
    let mut table = Columns::new(&header, &[]);
    for (power, coefficient) in coefficients(file).into_iter().enumerate() {
        table.row(std::iter::once(power.to_string()).chain(coefficient));
    }
    let _ = writeln!(text, "\n{}", table.text());
    let count = |claim: Option<usize>| claim.map(|count| count.to_string());
    text + &super::claims([
        ("factorisations", count(file.factorisations)),
        ("loop", file.closed_loop.clone()),
        ("order", count(file.order)),
        ("dimension", count(file.dimension)),
    ])
}

/// The coefficients as exact numbers, lengths in metres.
pub(super) fn json(file: &MotionFile) -> Value {
    let mut object = identity(file);
    super::remarks(&mut object, file.heading.source.as_ref(), file.heading.notes.as_deref());
    object.insert("polynomial".into(), json!(coefficients(file)));
    let claims = json!({
        "factorisations": file.factorisations,
        "loop": file.closed_loop,
        "order": file.order,
        "dimension": file.dimension,
    });
    object.insert("expected".into(), claims);
    Value::Object(object)
}
