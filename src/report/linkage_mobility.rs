//! Whether a linkage moves, as text and JSON.

use super::document::units;
use super::mobility::of_document;
use super::model::any_json;
use super::number::counted;
use super::table::paragraph;
use super::{linkage, space, sphere};
use crate::catalogue::{Any, Heading};
use crate::error::Result;
use crate::mobility::{LinkageMobility, planar_mobility, space_mobility, sphere_mobility};
use serde_json::{Value, json};

/// The answer to the question whether a linkage moves, with what reports say of the linkage.
pub struct Asked {
    /// The answer.
    pub answer: LinkageMobility,
    heading: Heading,
    /// Gruebler's count in words.
    counts: String,
    /// Names of the joints, by their numbers.
    joints: Vec<String>,
    joint_variables: Value,
    mechanism: Value,
}

/// Returns the answer for a linkage; `None` for anything else.
///
/// # Errors
/// For a configuration that does not close, and for what is not decided yet, with the line.
#[must_use]
pub fn ask(any: &Any, path: &str) -> Option<Result<Asked>> {
    let bodies = |count: usize| counted(count, "body");
    let of = |answer: Result<LinkageMobility>, line: Option<usize>, parts: (&Heading, String, Vec<String>, Value)| {
        let (heading, counts, joints, joint_variables) = parts;
        let answer = answer.map_err(|error| error.at(path, line.unwrap_or(1)))?;
        let counts = format!("Gruebler: {counts} = {}", answer.gruebler);
        Ok(Asked { answer, heading: heading.clone(), counts, joints, joint_variables, mechanism: any_json(any) })
    };
    Some(match any {
        Any::Linkage(file) => {
            let own = &file.linkage;
            let joints = own.joints.len() - own.joints.iter().filter(|joint| joint.is_gear()).count();
            let (n, list) = (own.bodies.len(), counted(joints, "joint"));
            let counts = format!("{}, {list}: 3 x {} - 2 x {joints}", bodies(n), n - 1);
            let names = own.joints.iter().map(|joint| joint.name.clone()).collect();
            let line = file.configuration.as_ref().map(|configuration| configuration.line);
            of(planar_mobility(file), line, (&file.heading, counts, names, linkage::joint_variables(file)))
        }
        Any::Sphere(file) => {
            let own = &file.linkage;
            let (n, joints) = (own.bodies.len(), own.joints.len());
            let counts = format!("{}, {}: 3 x {} - 2 x {joints}", bodies(n), counted(joints, "joint"), n - 1);
            let names = own.joints.iter().map(|joint| joint.name.clone()).collect();
            let line = file.configuration.as_ref().map(|configuration| configuration.line);
            of(sphere_mobility(file), line, (&file.heading, counts, names, sphere::joint_variables(file)))
        }
        Any::Space(file) => {
            let own = &file.linkage;
            let (n, joints) = (own.bodies.len(), own.joints.len());
            let taken: usize = own.joints.iter().map(|joint| joint.pair.conditions()).sum();
            let list = counted(joints, "joint");
            let counts = format!("{}, {list} with {}: 6 x {} - {taken}", bodies(n), counted(taken, "condition"), n - 1);
            let names = own.joints.iter().map(|joint| joint.name.clone()).collect();
            let line = file.configuration.as_ref().map(|configuration| configuration.line);
            of(space_mobility(file), line, (&file.heading, counts, names, space::joint_variables(file)))
        }
        _ => return None,
    })
}

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
pub fn text(asked: &Asked) -> String {
    let answer = &asked.answer;
    let mut text = verdict(answer) + "\n";
    paragraph(&mut text, &answer.reason);
    paragraph(&mut text, &asked.counts);
    if let Some(first) = answer.first_order {
        paragraph(&mut text, &format!("{} to first order", counted(first, "motion")));
    }
    text
}

/// Writes the document that equations/mobility.schema.json describes.
#[must_use]
pub fn json(asked: &Asked) -> Value {
    let answer = &asked.answer;
    let mut document = json!({
        "title": asked.heading.title,
        "kind": "linkage",
        "verdict": of_document(&verdict(answer), answer.mobility == Some(0)),
        "mobility": answer.mobility,
        "gruebler": answer.gruebler,
        "first_order": answer.first_order,
        "shaky": answer.is_shaky(),
        "order": answer.order,
        "branches": answer.branches,
        "proof": answer.proof.word(),
        "code": answer.code.word(),
        "reason": answer.reason,
        "name": asked.heading.name,
        "version": env!("CARGO_PKG_VERSION"),
        "units": units(),
        "joint_variables": asked.joint_variables,
        "mechanism": asked.mechanism,
    });
    if !answer.shafts.is_empty() {
        let shafts = answer.shafts.iter().map(|shafts| {
            let names = shafts.joints.map(|joint| asked.joints[joint].as_str());
            json!({ "joints": names, "ratio": if shafts.is_opposite { -1 } else { 1 } })
        });
        document["shafts"] = shafts.collect();
    }
    document
}
