//! Whether a planar linkage moves, as text and JSON.

use super::document::units;
use super::linkage::joint_variables;
use super::model;
use super::number::counted;
use super::table::paragraph;
use crate::catalogue::LinkageFile;
use crate::mobility::LinkageMobility;
use serde_json::{Value, json};

/// Writes the verdict on one line: `mobile: mobility 1 (Gruebler's count 0); proof: proved`.
#[must_use]
pub fn verdict(answer: &LinkageMobility) -> String {
    let count = answer.gruebler;
    let what = match (answer.mobility, answer.order) {
        (None, _) => "not decided".to_owned(),
        (Some(0), Some(order)) => format!("immobile: shaky of order {order}, infinitesimally mobile only"),
        (Some(0), None) => "immobile".to_owned(),
        (Some(mobility), _) => format!("mobile: mobility {mobility}"),
    };
    let branches = match answer.branches {
        0 => String::new(),
        branches => format!(", {branches} branches"),
    };
    format!("{what} (Gruebler's count {count}){branches}; proof: {}", answer.proof.word())
}

/// Writes the verdict, the reason and the counts.
#[must_use]
pub fn text(file: &LinkageFile, answer: &LinkageMobility) -> String {
    let mut text = verdict(answer) + "\n";
    paragraph(&mut text, &answer.reason);
    let linkage = &file.linkage;
    let gears = linkage.joints.iter().filter(|joint| joint.is_gear()).count();
    let joints = linkage.joints.len() - gears;
    let counts = format!(
        "Gruebler: {}, {}: 3 x {} - 2 x {joints} = {}",
        counted(linkage.bodies.len(), "body").replace("bodys", "bodies"),
        counted(joints, "joint"),
        linkage.bodies.len() - 1,
        answer.gruebler
    );
    paragraph(&mut text, &counts);
    if let Some(first) = answer.first_order {
        paragraph(&mut text, &format!("{} to first order", counted(first, "motion")));
    }
    text
}

/// Writes the document that equations/mobility.schema.json describes.
#[must_use]
pub fn json(file: &LinkageFile, answer: &LinkageMobility) -> Value {
    json!({
        "title": file.heading.title,
        "kind": "linkage",
        "mobility": answer.mobility,
        "gruebler": answer.gruebler,
        "first_order": answer.first_order,
        "shaky": answer.is_shaky(),
        "order": answer.order,
        "branches": answer.branches,
        "proof": answer.proof.word(),
        "code": answer.code.word(),
        "reason": answer.reason,
        "name": file.heading.name,
        "version": env!("CARGO_PKG_VERSION"),
        "units": units(),
        "joint_variables": joint_variables(file),
        "mechanism": model::linkage_json(file),
    })
}
