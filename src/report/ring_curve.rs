//! Interpolated curves of points of linkages in space and on the sphere as text and as JSON.

use super::linkage_derivation::{rational, sections, terms, written};
use super::number::counted;
use super::ring_derivation::Named;
use super::table::paragraph;
use crate::derivation::{CurveRelation, RingCurve};
use serde_json::{Value, json};
use std::fmt::Write;

const AXES: [&str; 3] = ["x", "y", "z"];

fn polynomial(relation: &CurveRelation) -> String {
    written(&rational(&relation.polynomial), &AXES.map(str::to_owned))
}

fn coordinates(relation: &CurveRelation) -> Vec<&'static str> {
    relation.coordinates.iter().map(|k| AXES[*k]).collect()
}

/// The degree of the curve on the sphere, else the largest of its projections.
fn degree(curve: &RingCurve) -> u64 {
    let most = curve.relations.iter().map(CurveRelation::degree).max().unwrap_or(0);
    // The sphere has the degree 2.
    if curve.square.is_some() { 2 * most } else { most }
}

/// The verdict on a curve.
#[must_use]
pub fn verdict(of: &str, curve: &RingCurve) -> String {
    let size = |relation: &CurveRelation| {
        format!("degree {} with {}", relation.degree(), counted(relation.polynomial.len(), "term"))
    };
    if let (Some(square), Some(relation)) = (&curve.square, curve.relations.first()) {
        return format!(
            "curve of {of}: of degree {} in space, the sphere x^2 + y^2 + z^2 = {square} and a surface of {}; {}",
            degree(curve),
            size(relation),
            sections(curve.compared, "planes")
        );
    }
    let each = |relation: &CurveRelation| format!("in {} of {}", coordinates(relation).join(" and "), size(relation));
    let list: Vec<String> = curve.relations.iter().map(each).collect();
    format!("curve of {of}: relations {}; {}", list.join(", "), sections(curve.compared, "lines each"))
}

/// How the relations were found.
fn how(curve: &RingCurve) -> String {
    let [with, what, form] = if curve.square.is_some() {
        ["a plane", "the powers of y and their products with z", "x, y and z"]
    } else {
        ["a line in the plane of two coordinates", "the powers of the second coordinate", "both coordinates"]
    };
    format!(
        "The equations of the linkage and of {with} have finitely many solutions, in whose ring {what} have a relation; it is \
         interpolated in a linear form of {form}."
    )
}

/// The curve of a point as one document.
#[must_use]
pub fn json(named: &Named<'_>, (body, point): (&str, &str), curve: &RingCurve) -> Value {
    let relation = |one: &CurveRelation| {
        json!({
            "coordinates": coordinates(one),
            "degree": one.degree(),
            "assemblies": one.assemblies,
            "polynomial": polynomial(one),
            "terms": terms(&one.polynomial, 3),
        })
    };
    named.completed(json!({
        "verdict": verdict(&format!("{body}.{point}"), curve),
        "equations": [],
        "steps": [how(curve)],
        "warnings": [],
        "removed_factors": [],
        "unknowns": [],
        "degree": null,
        "real_roots": null,
        "polynomial": null,
        "trace": {
            "body": body,
            "point": point,
            "degree": degree(curve),
            "polynomial": curve.relations.first().map(polynomial),
            "sphere": curve.square.as_ref().map(ToString::to_string),
            "relations": curve.relations.iter().map(relation).collect::<Value>(),
            "compared": curve.compared,
        },
    }))
}

/// The curve of a point for a reader.
#[must_use]
pub fn text(named: &Named<'_>, of: &str, curve: &RingCurve) -> String {
    let mut text = format!("{}\n", named.title());
    paragraph(&mut text, &verdict(of, curve));
    paragraph(&mut text, &how(curve));
    for relation in &curve.relations {
        let _ = writeln!(text, "\n{} = 0", polynomial(relation));
    }
    text
}
