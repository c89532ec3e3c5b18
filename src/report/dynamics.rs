//! Dynamics of linkages: JSON and text.

use super::calculus::write_values;
use super::json::number;
use super::linkage;
use crate::catalogue::{LinkageCase, LinkageFile};
use crate::displacement::answer::list;
use crate::kinematics::linkage::Linkage;
use crate::linkage::answer::{LinkageAnswer, LinkageMode};
use crate::linkage::dynamics::{Loaded, Row};
use crate::linkage::rates::{Body, Moving, freedoms, moving, resting};
use crate::linkage::tree::hanging;
use nalgebra::{DMatrix, DVector};
use serde_json::{Map, Value, json};

/// The results requested beside the accelerations.
#[derive(Clone, Debug, Default)]
pub struct Asked {
    /// The rates of the inputs; those not given are 0.
    pub rates: Vec<f64>,
    /// Whether the forces in the joints are requested.
    pub forces: bool,
    /// The mode from which a motion is followed, its time, and the number of its rows.
    pub motion: Option<(usize, f64, usize)>,
}

/// Returns the answer to a case: all real assemblies with `dynamics`, and `motion` on request.
#[must_use]
pub fn result(file: &LinkageFile, case: &LinkageCase, index: usize, answer: &LinkageAnswer, asked: &Asked) -> Value {
    let mut result = linkage::result(file, case, index, answer, false);
    let real: Vec<&LinkageMode> = answer.modes.iter().filter(|mode| mode.real).collect();
    let loaded = Loaded { linkage: &file.linkage, masses: &file.masses };
    if let Some(modes) = result.get_mut("modes").and_then(Value::as_array_mut) {
        for (shown, mode) in modes.iter_mut().zip(&real) {
            if let Value::Object(fields) = shown {
                fields.insert("dynamics".into(), dynamics(&loaded, case, mode, asked));
            }
        }
    }
    if let (Some((id, time, steps)), Value::Object(fields)) = (asked.motion, &mut result) {
        let start = id.checked_sub(1).and_then(|k| real.get(k)).map(|mode| resting(mode));
        let rows = start.and_then(|rest| loaded.motion(&case.given, &rest, &asked.rates, time, steps));
        fields.insert("motion".into(), rows.map_or(Value::Null, |rows| motion(&file.linkage, &rows)));
    }
    result
}

/// One number, or a list of several.
fn numbers(vector: &DVector<f64>) -> Value {
    if vector.len() == 1 { number(vector[0]) } else { list(vector.as_slice()) }
}

fn matrix(matrix: &DMatrix<f64>) -> Value {
    if matrix.nrows() == 1 {
        return number(matrix[(0, 0)]);
    }
    (0..matrix.nrows()).map(|i| (0..matrix.ncols()).map(|j| number(matrix[(i, j)])).collect::<Value>()).collect()
}

fn dynamics(loaded: &Loaded<'_>, case: &LinkageCase, mode: &LinkageMode, asked: &Asked) -> Value {
    let rest = resting(mode);
    let mut object = Map::new();
    // At a limit position of the inputs they are no coordinates of the motion.
    let Some(found) = loaded.reduced(&case.given, &rest, &asked.rates) else { return Value::Null };
    object.insert("reduced_inertia".into(), matrix(&found.inertia));
    let rate = asked.rates.first().copied().unwrap_or(0.0);
    if freedoms(&case.given) == 1 {
        let at_one = loaded.reduced(&case.given, &rest, &[1.0]).map_or(f64::NAN, |unit| 2.0 * unit.bias[0]);
        object.insert("reduced_inertia_derivative".into(), number(at_one));
        object.insert("potential_derivative".into(), numbers(&found.potential));
        object.insert("rate".into(), number(rate));
    } else {
        object.insert("bias".into(), numbers(&found.bias));
        object.insert("potential_derivative".into(), numbers(&found.potential));
        let rates = (0..freedoms(&case.given)).map(|k| number(asked.rates.get(k).copied().unwrap_or(0.0)));
        object.insert("rate".into(), rates.collect());
    }
    object.insert("acceleration".into(), found.acceleration.as_ref().map_or(Value::Null, numbers));
    // The drive that keeps the inputs at rest, by virtual power.
    object.insert("holding".into(), numbers(&found.potential));
    if asked.forces {
        let reactions = loaded.reactions(&case.given, &rest, &asked.rates);
        let joints = reactions.map_or(Value::Null, |list| self::reactions(loaded.linkage, &list));
        object.insert("joints".into(), joints);
    }
    if let Some(tree) = tree(loaded.linkage, case, &rest, &asked.rates) {
        object.insert("tree".into(), tree);
    }
    Value::Object(object)
}

/// The forces in the joints by name; sliders have a moment, too.
pub(super) fn reactions(linkage: &Linkage, reactions: &[Option<crate::linkage::dynamics::Reaction>]) -> Value {
    let one = |(joint, reaction): (&crate::kinematics::linkage::LinkageJoint, &Option<_>)| {
        let reaction: &crate::linkage::dynamics::Reaction = reaction.as_ref()?;
        let mut own = Map::new();
        own.insert("force".into(), list(&reaction.force));
        if joint.is_prismatic() {
            own.insert("moment".into(), number(reaction.moment));
        }
        Some((joint.name.clone(), Value::Object(own)))
    };
    Value::Object(linkage.joints.iter().zip(reactions).filter_map(one).collect())
}

/// For linkages without loops: the path matrix, and the velocities of all bodies by it and by recursion.
fn tree(linkage: &Linkage, case: &LinkageCase, rest: &[Body], rates: &[f64]) -> Option<Value> {
    let hanging = hanging(linkage)?;
    let rate = |k: usize| rates.get(k).copied().unwrap_or(0.0);
    let runs: Vec<Moving> =
        (0..freedoms(&case.given)).map(|k| Moving { coefficients: [0.0, rate(k), 0.0, 0.0] }).collect();
    let bodies = moving(linkage, &case.given, rest, &runs)?;
    let explicit = hanging.explicit(linkage, &bodies)?;
    let recursive = hanging.recursive(linkage, &bodies)?;
    let rows = hanging.tree.path_matrix();
    let rows: Value = rows.iter().map(|row| row.iter().map(|is_on| i32::from(*is_on)).collect::<Value>()).collect();
    let mut by_path = Map::new();
    let mut by_recursion = Map::new();
    for ((body, (omega, velocity)), place) in hanging.bodies.iter().zip(&explicit).zip(&recursive) {
        let name = linkage.bodies[*body].name.clone();
        by_path.insert(name.clone(), json!({ "rate": number(omega[2]), "velocity": list(&velocity[..2]) }));
        let [x, y, _] = place
            .translation
            .each_ref()
            .map(|part| [part.coefficients[0], part.coefficients[1], 2.0 * part.coefficients[2]]);
        // The rate of the angle from that of the rotation: sin' cos - cos' sin.
        let ([cos, dcos, ..], [sin, dsin, ..]) = (place.rotation[0][0].coefficients, place.rotation[1][0].coefficients);
        let omega = dsin * cos - dcos * sin;
        let own = json!({
            "rate": number(omega),
            "velocity": list(&[x[1] + omega * y[0], y[1] - omega * x[0]]),
            "acceleration_of_origin": list(&[x[2], y[2]]),
        });
        by_recursion.insert(name, own);
    }
    Some(json!({ "path_matrix": rows, "explicit": by_path, "recursive": by_recursion }))
}

/// The rows of a motion, and by how much its energy changed at most, beside the largest change of the kinetic part.
fn motion(linkage: &Linkage, rows: &[Row]) -> Value {
    let names: Vec<&str> = linkage.joints.iter().map(|joint| joint.name.as_str()).collect();
    let first = rows.first().map_or(0.0, |row| row.energy);
    let drift = rows.iter().map(|row| (row.energy - first).abs()).fold(0.0, f64::max);
    let shown = rows.iter().map(|row| {
        let part = |k: usize| -> Map<String, Value> {
            let list = names.iter().zip(&row.joints);
            list.filter_map(|(name, value)| Some(((*name).to_owned(), number(value.as_ref()?[k])))).collect()
        };
        json!({ "time": number(row.time), "joints": part(0), "rates": part(1), "energy": number(row.energy) })
    });
    json!({ "rows": shown.collect::<Vec<_>>(), "energy_drift": number(drift) })
}

/// A result for a reader.
#[must_use]
pub fn text(file: &LinkageFile, answer: &LinkageAnswer, result: &Value) -> String {
    let mut text = format!("{}, case {}\n{}\n", file.heading.title, result["case"], linkage::headline(&answer.verdict));
    for mode in result["modes"].as_array().into_iter().flatten() {
        text += &format!("\nmode {}\n", mode["id"]);
        match mode["dynamics"].as_object() {
            Some(fields) => write_values(&mut text, fields),
            None => text += "  a limit position of the input, which is no coordinate there\n",
        }
    }
    if let Some(motion) = result.get("motion") {
        match motion["rows"].as_array() {
            Some(rows) => {
                text += &format!("\nmotion, energy kept to {}\n", motion["energy_drift"]);
                for row in rows {
                    text += &format!("  {row}\n");
                }
            }
            None => text += "\nno motion: masses and joints do not determine the accelerations\n",
        }
    }
    text
}
