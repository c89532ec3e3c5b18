//! JSON as equations/result.schema.json describes it: radians, lengths in metres, finite numbers only.

use super::text::View;
use crate::catalogue::entry::{Entry, Kind};
use crate::mechanism::{FullMode, Solution};
use num_complex::Complex;
use serde_json::{Value, json};

/// The word of a kind.
#[must_use]
pub fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Arm => "arm",
        Kind::Loop => "loop",
        Kind::Platform => "platform",
    }
}

/// What stands before the results of the document: everything up to the opening bracket of the list.
#[must_use]
pub fn head(entry: &Entry) -> String {
    format!("{{ \"title\": {}, \"kind\": \"{}\", \"results\": [", json!(entry.title), kind(entry.kind))
}

/// The answer to one case; `case` is its number in the file, from 1.
#[must_use]
pub fn result(case: usize, solution: &Solution, view: &View) -> Value {
    let verdict = &solution.verdict;
    json!({
        "case": case,
        "verdict": {
            "status": verdict.status.word(),
            "complex": verdict.complex,
            "real": verdict.real,
            "at_infinity": verdict.at_infinity,
            "self_motion": verdict.self_motion,
            "certified": verdict.certified,
            "reason": verdict.reason,
        },
        "modes": solution.modes.iter().filter(|mode| view.shows(mode)).map(mode).collect::<Vec<_>>(),
        "warnings": solution.warnings,
        "timings_us": { "prepare": tenths(solution.prepare_us), "solve": tenths(solution.solve_us) },
    })
}

fn mode(mode: &FullMode) -> Value {
    let value = |z: &Complex<f64>| if mode.real { number(z.re) } else { json!([number(z.re), number(z.im)]) };
    json!({
        "real": mode.real,
        "q": mode.q.iter().map(value).collect::<Vec<_>>(),
        "multiplicity": (mode.multiplicity > 0).then_some(mode.multiplicity),
        "residual": number(mode.residual),
        "condition": number(mode.condition),
        "certified": mode.certified,
        "radius": number(mode.radius),
        "within_limits": mode.within_limits,
    })
}

/// A finite number, else null; zero has no sign.
#[must_use]
pub fn number(x: f64) -> Value {
    if x.is_finite() { json!(x + 0.0) } else { Value::Null }
}

fn tenths(microseconds: f64) -> Value {
    number((microseconds * 10.0).round() / 10.0)
}
