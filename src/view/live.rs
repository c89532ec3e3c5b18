//! Live pages: controls for what was asked, and the program that solves anew when one is moved.

use super::encode::{packed, script};
use super::tracks::list;
use crate::error::Error;
use serde_json::{Value, json};
use std::fmt::Write;

/// The worker that runs the program.
const WORKER: &str = include_str!("../../assets/viewer/worker.js");

/// The files and the command with which a live page solves.
#[derive(Clone, Debug, Default)]
pub struct Live {
    /// The command line after `looproot`, without the request itself: it writes the [`parts`](super::parts) of a page.
    pub arguments: Vec<String>,
    /// The names of files that these arguments read, with their texts.
    pub files: Vec<(String, String)>,
    /// The program. Without it the window around the page is asked to solve.
    pub program: Option<Program>,
}

/// The program of a live page: two gzipped files that `web/build` writes.
#[derive(Clone, Debug)]
pub struct Program {
    /// The program as WebAssembly.
    pub module: Vec<u8>,
    /// The script of the page, bundled.
    pub viewer: Vec<u8>,
}

/// The controls of a document of `solve`: the argument that asks, in which `{0}` is the value of the first control, and each
/// control with its name, unit, value and range. Of several results the first one is asked.
///
/// # Errors
/// [`Error::Invalid`] where no pose, input or set of legs was asked.
pub(super) fn controls(document: &Value) -> Result<Value, Error> {
    let Some(asked) = list(document, "results").first().map(|result| &result["asked"]) else {
        return Err(nothing(document));
    };
    let size = document["scene"]["size"].as_f64().filter(|size| *size > 0.0).unwrap_or(1.0);
    let (argument, controls) = if let Some(matrix) = numbers(&asked["matrix"]) {
        pose(&matrix, size)
    } else if let Some(legs) = asked["legs"].as_array() {
        let names = (1..=legs.len()).map(|leg| format!("leg {leg}"));
        let values: Vec<f64> = legs.iter().map(|leg| leg.as_f64().unwrap_or(0.0)).collect();
        let controls = names.zip(&values).map(|(name, leg)| length(&name, *leg, [0.4 * leg, 1.6 * leg])).collect();
        (format!("--legs={}", places(0..values.len(), "m")), controls)
    } else if let (Some(joint), Some(angle)) = (asked["joint"].as_u64(), asked["angle"].as_f64()) {
        (format!("--input={joint}={{0}} deg"), vec![turn(&format!("q{joint}"), angle.to_degrees())])
    } else if let (Some(joint), Some(distance)) = (asked["joint"].as_u64(), asked["distance"].as_f64()) {
        let range = [distance - size, distance + size];
        (format!("--input={joint}={{0}} m"), vec![length(&format!("d{joint}"), distance, range)])
    } else if let Some(joints) = asked["joints"].as_object().filter(|joints| !joints.is_empty()) {
        given(document, joints, size)
    } else {
        return Err(nothing(document));
    };
    Ok(json!({ "argument": argument, "controls": controls }))
}

fn nothing(document: &Value) -> Error {
    let kind = document["kind"].as_str().unwrap_or("document");
    Error::Invalid(format!("found a {kind} without a single pose, input or set of legs, expected one for a live page"))
}

/// The joints of a linkage that were given, each with its value.
fn given(document: &Value, joints: &serde_json::Map<String, Value>, size: f64) -> (String, Vec<Value>) {
    let is_distance = |name: &str| {
        list(document, "joint_variables").iter().any(|own| own["name"] == name && own["kind"] == "distance")
    };
    let (mut asked, mut controls) = (Vec::new(), Vec::new());
    for (place, (name, value)) in joints.iter().enumerate() {
        let value = value.as_f64().unwrap_or(0.0);
        let slides = is_distance(name);
        asked.push(format!("{name}={{{place}}} {}", if slides { "m" } else { "deg" }));
        controls.push(if slides {
            length(name, value, [value - size, value + size])
        } else {
            turn(name, value.to_degrees())
        });
    }
    (format!("--input={}", asked.join(", ")), controls)
}

/// A matrix row by row.
fn numbers(value: &Value) -> Option<[[f64; 4]; 3]> {
    let row = |i: usize| {
        let row = value.get(i)?.as_array()?;
        Some([row.first()?.as_f64()?, row.get(1)?.as_f64()?, row.get(2)?.as_f64()?, row.get(3)?.as_f64()?])
    };
    Some([row(0)?, row(1)?, row(2)?])
}

/// `{0} m, {1} m`
fn places(range: std::ops::Range<usize>, unit: &str) -> String {
    let places: Vec<String> = range.map(|place| format!("{{{place}}} {unit}")).collect();
    places.join(", ")
}

/// A pose as position and roll, pitch, yaw: `Rz(yaw) Ry(pitch) Rx(roll)`.
fn pose(matrix: &[[f64; 4]; 3], size: f64) -> (String, Vec<Value>) {
    let [first, second, third] = matrix;
    let level = first[0].hypot(second[0]);
    let pitch = (-third[0]).atan2(level);
    // With the tool straight up or down, roll and yaw have the same axis: the whole angle counts as roll.
    let (roll, yaw) = if level > 1e-9 {
        (third[1].atan2(third[2]), second[0].atan2(first[0]))
    } else {
        ((-second[2]).atan2(second[1]), 0.0)
    };
    let position = ["x", "y", "z"].iter().zip(matrix).map(|(name, row)| {
        let value = row[3];
        length(name, value, [value - size, value + size])
    });
    let angles = [("roll", roll), ("pitch", pitch), ("yaw", yaw)];
    let controls = position.chain(angles.iter().map(|(name, angle)| turn(name, angle.to_degrees()))).collect();
    (format!("--at={}; {}", places(0..3, "m"), places(3..6, "deg")), controls)
}

/// An angle in degrees, through a whole turn.
fn turn(name: &str, value: f64) -> Value {
    json!({ "name": name, "unit": "deg", "value": rounded(value, 0.01), "low": -180.0, "high": 180.0, "step": 0.5, "digits": 2 })
}

/// A length in metres; its steps are about a thousandth of the range.
fn length(name: &str, value: f64, [low, high]: [f64; 2]) -> Value {
    let step = 10_f64.powf(((high - low) / 500.0).max(1e-6).log10().floor());
    // A tenth of a step is still to be typed.
    #[expect(clippy::cast_possible_truncation, reason = "a few digits")]
    let digits = (1.0 - step.log10()).clamp(0.0, 9.0).round() as i32;
    let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
    let value = rounded(value, step / 10.0);
    json!({ "name": name, "unit": "m", "value": value, "low": low, "high": high, "step": step, "digits": digits })
}

fn rounded(value: f64, unit: f64) -> f64 {
    (value / unit).round() * unit
}

/// Writes the data with which the script solves: the controls, the command, its files, the worker and the program.
pub(super) fn solver(text: &mut String, controls: &Value, live: &Live) {
    let files: serde_json::Map<String, Value> =
        live.files.iter().map(|(name, text)| (name.clone(), json!(text))).collect();
    let mut asked = controls.clone();
    asked["arguments"] = json!(live.arguments);
    asked["files"] = Value::Object(files);
    let _ = writeln!(text, "<script type=\"application/json\" id=\"live\">{}</script>", script(&asked));
    if let Some(program) = &live.program {
        let worker = WORKER.replace("</script", "<\\/script");
        let _ = writeln!(text, "<script type=\"text/plain\" id=\"worker\">{worker}</script>");
        for (id, bytes) in [("module", &program.module), ("viewer", &program.viewer)] {
            let _ = writeln!(text, "<script type=\"text/plain\" id=\"{id}\">{}</script>", packed(bytes));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_is_asked_by_position_and_angles() {
        // Rz(90 deg) after Rx(30 deg).
        let (sin, cos) = 30_f64.to_radians().sin_cos();
        let matrix = [[0.0, -cos, sin, 0.1], [1.0, 0.0, 0.0, 0.2], [0.0, sin, cos, 0.3], [0.0, 0.0, 0.0, 1.0]];
        let document =
            json!({ "kind": "arm", "scene": { "size": 2.0 }, "results": [{ "asked": { "matrix": matrix } }] });
        let found = controls(&document).expect("a pose");
        assert_eq!(found["argument"], "--at={0} m, {1} m, {2} m; {3} deg, {4} deg, {5} deg");
        let values: Vec<f64> = list(&found, "controls").iter().filter_map(|one| one["value"].as_f64()).collect();
        for (value, wanted) in values.iter().zip([0.1, 0.2, 0.3, 30.0, 0.0, 90.0]) {
            assert!((value - wanted).abs() < 1e-6, "{values:?}");
        }
        assert!(controls(&json!({ "kind": "framework" })).is_err());
    }
}
