//! JSON as equations/result.schema.json describes it: radians, lengths in metres, finite numbers only.

use super::text::View;
use crate::catalogue::entry::{Entry, Kind};
use crate::mechanism::{FullMode, Solution};
use crate::verdict::Proof;
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
    format!("{{ \"title\": {}, \"kind\": \"{}\", \"results\": [", json!(entry.title), kind(entry.kind()))
}

/// The answer to one case; `case` is its number in the file, from 1.
#[must_use]
pub fn result(case: usize, solution: &Solution, view: &View) -> Value {
    let verdict = &solution.verdict;
    let mut result = json!({
        "case": case,
        "verdict": {
            "status": verdict.status.word(),
            "proof": verdict.proof.word(),
            "code": verdict.code.word(),
            "complex_complete": verdict.complex_complete,
            "complex": verdict.complex,
            "real": verdict.real,
            "at_infinity": verdict.at_infinity,
            "self_motion": verdict.self_motion,
            "certified": verdict.certified,
            "reason": verdict.reason,
        },
    });
    if let Proof::Probable { error, seed } = verdict.proof {
        result["verdict"]["probability_of_error"] = number(error);
        result["verdict"]["seed"] = json!(seed);
    }
    if let Some(platform) = &solution.platform {
        result["legs"] = json!(platform.legs.map(number));
        result["route"] = json!(platform.route);
    }
    result["modes"] = solution.modes.iter().filter(|mode| view.shows(mode)).map(mode).collect();
    result["warnings"] = json!(solution.warnings);
    result["timings_us"] = json!({ "prepare": tenths(solution.prepare_us), "solve": tenths(solution.solve_us) });
    result
}

fn mode(mode: &FullMode) -> Value {
    let value = |z: &Complex<f64>| if mode.real { number(z.re) } else { json!([number(z.re), number(z.im)]) };
    let values = |part: &[Complex<f64>]| part.iter().map(value).collect::<Value>();
    let mut object = json!({ "real": mode.real });
    match (&mode.platform, mode.q.split_at_checked(4)) {
        (Some(_), Some((quaternion, position))) => {
            object["quaternion"] = values(quaternion);
            object["position"] = values(position);
        }
        _ => object["q"] = values(&mode.q),
    }
    object["multiplicity"] = json!((mode.multiplicity > 0).then_some(mode.multiplicity));
    object["residual"] = number(mode.residual);
    object["condition"] = number(mode.condition);
    object["certified"] = json!(mode.certified);
    object["radius"] = number(mode.radius);
    match &mode.platform {
        Some(platform) => {
            let velocity = platform.velocity.as_ref();
            object["mirror"] = json!(platform.mirror);
            object["singular_values"] = json!(velocity.map(|v| v.singular_values.map(number)));
            object["twist"] = json!(velocity.and_then(|v| v.twist.map(|rows| rows.map(|row| row.map(number)))));
        }
        None => object["within_limits"] = json!(mode.within_limits),
    }
    object
}

/// A finite number, else null; zero has no sign.
#[must_use]
pub fn number(x: f64) -> Value {
    if x.is_finite() { json!(x + 0.0) } else { Value::Null }
}

/// Microseconds with one decimal.
#[must_use]
pub fn tenths(microseconds: f64) -> Value {
    number((microseconds * 10.0).round() / 10.0)
}
