//! What every JSON document says of its mechanism: names, units, joint variables, and what was understood of the file.

use super::model;
use crate::algebra::drawn;
use crate::catalogue::entry::Entry;
use serde_json::{Map, Value, json};

/// The keys of the document, in their order, without its results.
#[must_use]
pub fn keys(entry: &Entry) -> Map<String, Value> {
    let mut object = Map::new();
    object.insert("name".into(), json!(entry.name));
    object.insert("version".into(), json!(env!("CARGO_PKG_VERSION")));
    object.insert("units".into(), json!({ "length": "m", "angle": "rad" }));
    if let Some([base, tip]) = &entry.labels.links {
        object.insert("base_link".into(), json!(base));
        object.insert("tip_link".into(), json!(tip));
    }
    object.insert("joint_variables".into(), joint_variables(entry));
    object.insert("mechanism".into(), model::json(entry));
    object
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

/// What the file calls the joint of every variable, else the name of the variable.
#[must_use]
pub fn labels(entry: &Entry) -> Vec<String> {
    let variables = entry.chain().map(crate::kinematics::chain::Chain::variables).unwrap_or_default();
    let label = |joint: usize| entry.labels.joints.get(joint - 1).cloned().flatten();
    variables.iter().map(|variable| label(variable.joint).unwrap_or_else(|| variable.name())).collect()
}
