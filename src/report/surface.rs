//! Surfaces of points of open chains as text and as JSON.

use super::number::counted;
use super::table::paragraph;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::text::{Format, Names};
use crate::catalogue::entry::Entry;
use crate::derivation::Surface;
use crate::kinematics::closed_loop::Variable;
use rug::Rational;
use serde_json::{Value, json};
use std::fmt::Write;

fn written(surface: &Surface) -> String {
    let exact = surface.polynomial.map(|c| Some(Rational::from(c.to_integer()))).unwrap_or_else(Polynomial::zero);
    Names::given(["x", "y", "z"]).map_or_else(|_| String::new(), |names| Format::Text.polynomial(&exact, &names))
}

fn letters(surface: &Surface) -> String {
    let letter = |variable: &Variable| if *variable == Variable::Rotation { 'R' } else { 'P' };
    // Four variables are those of two cylindrical joints.
    if surface.variables.len() == 4 { "CC".to_owned() } else { surface.variables.iter().map(letter).collect() }
}

/// The verdict on one line.
#[must_use]
pub fn verdict(of: &str, surface: &Surface) -> String {
    let terms = counted(surface.polynomial.len(), "term");
    let what = if surface.is_boundary { "boundary of the work space" } else { "surface" };
    format!("{what} of {of} on a chain {}: degree {}, {terms}", letters(surface), surface.degree())
}

/// The surface of a point as one document.
#[must_use]
pub fn json(entry: &Entry, of: &str, surface: &Surface) -> Value {
    json!({
        "title": entry.title,
        "kind": "arm",
        "case": 1,
        "verdict": verdict(of, surface),
        "unknowns": [],
        "degree": null,
        "real_roots": null,
        "polynomial": null,
        "removed_factors": [],
        "equations": [],
        "steps": surface.steps,
        "warnings": [],
        "trace": {
            "body": "tool",
            "point": of,
            "chain": letters(surface),
            "boundary": surface.is_boundary,
            "degree": surface.degree(),
            "polynomial": written(surface),
        },
    })
}

/// The surface of a point for a reader.
#[must_use]
pub fn text(entry: &Entry, of: &str, surface: &Surface) -> String {
    let mut text = format!("{}\n", entry.title);
    paragraph(&mut text, &verdict(of, surface));
    for step in &surface.steps {
        paragraph(&mut text, step);
    }
    let _ = writeln!(text, "\n{} = 0", written(surface));
    text
}
