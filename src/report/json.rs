//! JSON as equations/result.schema.json describes it: radians, lengths in metres, finite numbers only.

use super::model::asked;
use super::text::View;
use crate::catalogue::entry::{Case, Entry, Kind};
use crate::kinematics::platform_limits::Part;
use crate::kinematics::tolerance::PoseError;
use crate::mechanism::{ArmAnswer, Family, FullMode, Solution};
use crate::verdict::{Proof, Verdict};
use num_complex::Complex;
use serde_json::{Map, Value, json};

/// The word of a kind.
#[must_use]
pub fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Arm => "arm",
        Kind::Loop => "loop",
        Kind::Platform => "platform",
    }
}

/// Returns the document before the results, up to the opening bracket of the list. `keys` are the keys of every document.
#[must_use]
pub fn head(entry: &Entry, keys: &Map<String, Value>) -> String {
    let mut text = format!("{{ \"title\": {}, \"kind\": \"{}\",", json!(entry.title), kind(entry.kind()));
    for (key, value) in keys {
        text += &format!(" {}: {value},", json!(key));
    }
    text + " \"results\": ["
}

/// The first of several lines of JSON: what holds for all of them.
#[must_use]
pub fn line_of_document(entry: &Entry, keys: &Map<String, Value>) -> Value {
    let mut object = Map::new();
    object.insert("title".into(), json!(entry.title));
    object.insert("kind".into(), json!(kind(entry.kind())));
    object.extend(keys.clone());
    json!({ "document": object })
}

/// Returns the document after the results: the closing bracket, and the seed of the primes if any was drawn.
#[must_use]
pub fn foot(seed: Option<u64>) -> String {
    seed.map_or_else(|| "] }".to_owned(), |seed| format!("], \"seed\": {seed} }}"))
}

/// The answer to one case; `number` is its number in the file, from 1, and `labels` those of the joint variables.
#[must_use]
pub fn result(number: usize, case: &Case, solution: &Solution, labels: &[String], view: &View) -> Value {
    let mut verdict = verdict(&solution.verdict);
    verdict["near"] = json!(solution.near());
    let mut result = json!({ "case": number, "asked": Value::Object(asked(case)), "verdict": verdict });
    if let Some(arm) = &solution.arm {
        insert_arm(&mut result, arm);
    }
    if let Some(platform) = &solution.platform {
        result["legs"] = json!(platform.legs.map(self::number));
        result["route"] = json!(platform.route);
        if !platform.outside.is_empty() {
            result["outside"] = words(&platform.outside);
        }
    }
    let numbered = (1..).zip(&solution.modes).filter(|(_, mode)| view.shows(mode));
    result["modes"] = numbered.map(|(id, mode)| self::mode(id, mode)).collect();
    let is_platform = solution.platform.is_some();
    result["families"] = solution.families.iter().map(|one| family(one, labels, is_platform)).collect();
    result["warnings"] = json!(solution.warnings);
    result["timings_us"] = json!({ "prepare": tenths(solution.prepare_us), "solve": tenths(solution.solve_us) });
    result
}

/// A verdict, key by key.
#[must_use]
pub fn verdict(verdict: &Verdict) -> Value {
    let mut object = json!({
        "status": verdict.status.word(),
        "proof": verdict.proof.word(),
        "code": verdict.code.word(),
        "complex_complete": verdict.complex_complete,
        "complex": verdict.complex,
        "real": verdict.real,
        "at_infinity": verdict.at_infinity,
        "self_motion": verdict.self_motion,
        "certified": verdict.certified,
        "near": 0,
        "reason": verdict.reason,
    });
    if let Proof::Probable { error, seed } = verdict.proof {
        object["probability_of_error"] = number(error);
        object["seed"] = json!(seed);
    }
    object
}

/// Inserts the part that only arms of few or many joints have.
fn insert_arm(result: &mut Value, arm: &ArmAnswer) {
    if !arm.conditions.is_empty() {
        result["verdict"]["conditions"] = json!(arm.conditions);
    }
    if let Some((q, miss)) = &arm.nearest {
        let q: Value = q.iter().map(|x| number(*x)).collect();
        result["nearest"] = json!({ "q": q, "error": error(miss) });
    }
}

/// By how much a pose is missed.
fn error(miss: &PoseError) -> Value {
    json!({ "position": number(miss.position), "orientation": number(miss.orientation) })
}

/// A set of solutions of dimension 1 and more; joint variables are numbered from 1.
fn family(family: &Family, labels: &[String], is_platform: bool) -> Value {
    let configuration = |q: &Vec<f64>| {
        let values = |part: &[f64]| part.iter().map(|x| number(*x)).collect::<Value>();
        match q.split_at_checked(4) {
            Some((quaternion, position)) if is_platform => {
                json!({ "quaternion": values(quaternion), "position": values(position) })
            }
            _ => json!({ "q": values(q) }),
        }
    };
    json!({
        "dimension": family.dimension,
        "joints": family.moving.iter().map(|variable| variable + 1).collect::<Vec<_>>(),
        "labels": family.moving.iter().filter_map(|variable| labels.get(*variable)).collect::<Vec<_>>(),
        "distance": number(family.distance),
        "sample": configuration(&family.sample),
        "samples": family.samples.iter().map(configuration).collect::<Vec<_>>(),
    })
}

/// A mode; `id` is its number among all modes, listed or not.
fn mode(id: usize, mode: &FullMode) -> Value {
    let value = |z: &Complex<f64>| if mode.real { number(z.re) } else { json!([number(z.re), number(z.im)]) };
    let values = |part: &[Complex<f64>]| part.iter().map(value).collect::<Value>();
    let mut object = json!({ "id": id, "real": mode.real });
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
    if mode.near {
        object["near"] = json!(true);
    }
    if let Some(miss) = &mode.error {
        object["error"] = error(miss);
    }
    match &mode.platform {
        Some(platform) => {
            let velocity = platform.velocity.as_ref();
            object["mirror"] = json!(platform.mirror);
            if let Some(within) = mode.within_limits {
                object["within_limits"] = json!(within);
                object["outside"] = words(&platform.outside);
            }
            object["singular_values"] = json!(velocity.map(|v| v.singular_values.map(number)));
            object["twist"] = json!(velocity.and_then(|v| v.twist.map(|rows| rows.map(|row| row.map(number)))));
        }
        None => object["within_limits"] = json!(mode.within_limits),
    }
    object
}

/// The parts of a platform that are outside their limits.
#[must_use]
pub fn words(parts: &[Part]) -> Value {
    parts.iter().map(Part::to_string).collect()
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
