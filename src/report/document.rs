//! The part about the mechanism in every JSON document: names, units, joint variables, and the interpretation of the file.

use super::model;
use crate::algebra::drawn;
use crate::catalogue::Snapped;
use crate::catalogue::ansatz::Ansatz;
use crate::catalogue::entry::Entry;
use serde_json::{Map, Value, json};

/// The keys of the document, in their order, without its results.
#[must_use]
pub fn keys(entry: &Entry) -> Map<String, Value> {
    let mut object = Map::new();
    object.insert("name".into(), json!(entry.name));
    object.insert("version".into(), json!(env!("CARGO_PKG_VERSION")));
    object.insert("units".into(), units());
    if let Some([base, tip]) = &entry.labels.links {
        object.insert("base_link".into(), json!(base));
        object.insert("tip_link".into(), json!(tip));
    }
    if !entry.labels.snapped.is_empty() {
        object.insert("snapped".into(), entry.labels.snapped.iter().map(snapped).collect());
    }
    if !entry.labels.remarks.is_empty() {
        object.insert("remarks".into(), json!(entry.labels.remarks));
    }
    object.insert("joint_variables".into(), joint_variables(entry));
    object.insert("mechanism".into(), model::json(entry));
    object
}

/// An angle that stands for a multiple of half a degree.
fn snapped(snapped: &Snapped) -> Value {
    json!({ "place": snapped.place, "written": snapped.written, "meant": snapped.meant(), "taken": snapped.taken })
}

/// The units of every number.
#[must_use]
pub fn units() -> Value {
    json!({ "length": "m", "angle": "rad" })
}

/// Adds these keys to a document that is complete, and the seed of the primes if any was drawn.
pub fn complete(document: &mut Value, entry: &Entry) {
    let Some(object) = document.as_object_mut() else { return };
    for (key, value) in keys(entry) {
        object.entry(key).or_insert(value);
    }
    if let Some(seed) = drawn::seed_used() {
        object.insert("seed".into(), json!(seed));
    }
}

/// Completes the document of a loop with symbols, whose joints are all revolute. The seed stands in it if anything was drawn.
pub fn complete_ansatz(document: &mut Value, ansatz: &Ansatz, seed: Option<u64>) {
    let Some(object) = document.as_object_mut() else { return };
    let angle = |joint: usize| json!({ "name": format!("q{joint}"), "kind": "angle", "joint": joint, "label": format!("q{joint}") });
    object.insert("name".into(), json!(ansatz.name));
    object.insert("version".into(), json!(env!("CARGO_PKG_VERSION")));
    object.insert("units".into(), units());
    object.insert("joint_variables".into(), (1..=ansatz.joints.len()).map(angle).collect());
    object.insert("mechanism".into(), model::ansatz_json(ansatz));
    if let Some(seed) = seed {
        object.insert("seed".into(), json!(seed));
    }
}

/// The variables of the joints, in the order of every `q`; none of a platform.
fn joint_variables(entry: &Entry) -> Value {
    let Some(chain) = entry.chain() else { return json!([]) };
    let labels = labels(entry);
    let own = chain.variables().into_iter().zip(labels).map(|(variable, label)| {
        json!({
            "name": variable.name(),
            "kind": variable.variable.word(),
            "joint": variable.joint,
            "label": label,
        })
    });
    own.collect()
}

/// Returns the name of each variable's joint in the file, else the name of the variable.
#[must_use]
pub fn labels(entry: &Entry) -> Vec<String> {
    let variables = entry.chain().map(crate::kinematics::chain::Chain::variables).unwrap_or_default();
    let label = |joint: usize| entry.labels.joints.get(joint - 1).cloned().flatten();
    variables.iter().map(|variable| label(variable.joint).unwrap_or_else(|| variable.name())).collect()
}
