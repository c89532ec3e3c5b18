//! Questions about displacements and lines, as they were understood.

use super::{labels, origin};
use crate::catalogue::CalculusFile;
use crate::catalogue::calculus::Question;
use serde_json::{Map, Value, json};

/// `displacement: elements`
pub(super) fn short(file: &CalculusFile) -> String {
    format!("{}: {}", kind(file), file.find())
}

fn kind(file: &CalculusFile) -> &'static str {
    match file.question {
        Question::Displacement(_) => "displacement",
        Question::Lines(_) => "lines",
        Question::Gearing(_) => "gearing",
    }
}

pub(super) fn identity(file: &CalculusFile) -> Map<String, Value> {
    let heading = &file.heading;
    labels(&heading.name, &heading.title, kind(file), file.find(), heading.source.as_ref())
}

pub(super) fn text(file: &CalculusFile) -> String {
    let mut text = format!("{}\n{}\n", file.heading.title, short(file));
    origin(&mut text, file.heading.source.as_ref(), file.heading.notes.as_deref());
    let count = |claim: Option<usize>| claim.map(|count| count.to_string());
    let claims = &file.claims;
    text + &super::claims([
        ("complex", count(claims.complex)),
        ("real", count(claims.real)),
        ("dimension", count(claims.dimension)),
    ])
}

pub(super) fn json(file: &CalculusFile) -> Value {
    let mut object = identity(file);
    super::remarks(&mut object, file.heading.source.as_ref(), file.heading.notes.as_deref());
    object.insert("exact".into(), json!(!file.rounded));
    let claims = &file.claims;
    let claims = json!({ "complex": claims.complex, "real": claims.real, "dimension": claims.dimension });
    object.insert("expected".into(), claims);
    Value::Object(object)
}
