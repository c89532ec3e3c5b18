//! Assemblies of linkages in space as text and as JSON.

use super::document::units;
use super::json::{number, tenths, verdict as verdict_json};
use super::linkage::headline;
use super::model;
use super::number::{counted, duration, short};
use super::table::{Columns, paragraph};
use crate::algebra::drawn;
use crate::catalogue::{SpaceCase, SpaceFile};
use crate::kinematics::space::{Known, SpaceGiven, SpaceJoint, SpaceLinkage, SpacePair};
use crate::linkage::space::{Coordinate, SpaceAnswer, SpaceMode};
use looproot_calculus::rotation::matrix::from_matrix;
use looproot_calculus::rotation::vectors::unit;
use rug::Rational;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// The quaternion and the position of a body that is placed.
fn placed(given: &SpaceGiven) -> ([f64; 4], [f64; 3]) {
    let Known::Motion(motion) = &given.known else { return ([f64::NAN; 4], [f64::NAN; 3]) };
    let rows = motion.rotation.each_ref().map(|row| row.each_ref().map(Rational::to_f64));
    let q = unit(&from_matrix(&rows)).map_or([f64::NAN; 4], |q| [q.scalar, q.vector[0], q.vector[1], q.vector[2]]);
    (q, motion.translation.each_ref().map(Rational::to_f64))
}

/// Returns the inputs in words.
pub(super) fn asked(file: &SpaceFile, given: &[SpaceGiven]) -> String {
    let linkage = &file.linkage;
    let one = |given: &SpaceGiven| {
        if let (Some(joint), Some(value)) = (given.joint, given.value) {
            let joint = &linkage.joints[joint];
            let is_distance = joint.is_distance() == Some(true);
            let (value, unit) = if is_distance { (value, "m") } else { (value.to_degrees(), "deg") };
            format!("{} = {} {unit}", joint.name, short(value, 6))
        } else {
            let (q, p) = placed(given);
            let list = |parts: &[f64]| parts.iter().map(|part| short(*part, 6)).collect::<Vec<_>>().join(", ");
            format!("{} at ({}) m turned by ({})", linkage.bodies[given.of[1]].name, list(&p), list(&q))
        }
    };
    if given.is_empty() { "nothing given".to_owned() } else { given.iter().map(one).collect::<Vec<_>>().join(", ") }
}

fn asked_json(file: &SpaceFile, given: &[SpaceGiven]) -> Value {
    let (mut joints, mut bodies) = (Map::new(), Map::new());
    for one in given {
        if let (Some(joint), Some(value)) = (one.joint, one.value) {
            joints.insert(file.linkage.joints[joint].name.clone(), number(value));
        } else {
            let (q, p) = placed(one);
            let list = |parts: &[f64]| parts.iter().map(|part| number(*part)).collect::<Value>();
            bodies.insert(
                file.linkage.bodies[one.of[1]].name.clone(),
                json!({ "quaternion": list(&q), "position": list(&p) }),
            );
        }
    }
    json!({ "joints": joints, "bodies": bodies })
}

/// The joints that have a value, in the order of the file.
pub(super) fn joint_variables(file: &SpaceFile) -> Value {
    let joints = (1..).zip(&file.linkage.joints);
    let variables = joints.filter_map(|(k, joint)| {
        let kind = if joint.is_distance()? { "distance" } else { "angle" };
        Some(json!({ "name": joint.name, "kind": kind, "joint": k, "label": joint.name }))
    });
    variables.collect()
}

/// The keys that every document of a linkage has.
pub(super) fn shared(file: &SpaceFile) -> Value {
    json!({
        "title": file.heading.title,
        "kind": "linkage",
        "name": file.heading.name,
        "version": env!("CARGO_PKG_VERSION"),
        "units": units(),
        "joint_variables": joint_variables(file),
        "mechanism": model::space_json(file),
    })
}

/// Returns a document about a case with the keys that every document of a linkage has; `case` is counted from 1.
#[must_use]
pub fn completed(file: &SpaceFile, case: usize, own: Value) -> Value {
    let mut document = shared(file);
    document["case"] = json!(case);
    if let (Value::Object(document), Value::Object(own)) = (&mut document, own) {
        document.extend(own);
    }
    document
}

/// Whether the value of a joint says where its second body is on its first one.
fn is_placing(joint: &SpaceJoint) -> bool {
    matches!(joint.pair, SpacePair::Revolute(_) | SpacePair::Prismatic(_))
}

/// The bodies on which no R or P joint stands second: other joints leave their places unsaid.
pub(super) fn moved(linkage: &SpaceLinkage) -> Vec<usize> {
    let placed: Vec<usize> = linkage.joints.iter().filter(|joint| is_placing(joint)).map(|joint| joint.of[1]).collect();
    (0..linkage.bodies.len()).filter(|body| *body != linkage.ground && !placed.contains(body)).collect()
}

/// One document for all cases.
#[must_use]
pub fn json(file: &SpaceFile, results: &[Value]) -> Value {
    let mut document = shared(file);
    document["results"] = json!(results);
    if let Some(seed) = drawn::seed_used() {
        document["seed"] = json!(seed);
    }
    document
}

fn value(z: &Coordinate, real: bool) -> Value {
    if real { number(z.re) } else { json!([number(z.re), number(z.im)]) }
}

/// Joints and bodies of an assembly.
pub(super) fn places(file: &SpaceFile, mode: &SpaceMode) -> Map<String, Value> {
    let linkage = &file.linkage;
    let joints = linkage.joints.iter().zip(&mode.joints);
    let joints: Map<String, Value> =
        joints.filter_map(|(joint, z)| Some((joint.name.clone(), value(z.as_ref()?, mode.real)))).collect();
    let bodies = linkage.bodies.iter().enumerate().map(|(k, body)| {
        let q = mode.quaternion(k).map_or(Value::Null, |q| q.iter().map(|z| value(z, mode.real)).collect());
        let position: Value = mode.position(k).iter().map(|z| value(z, mode.real)).collect();
        (body.name.clone(), json!({ "quaternion": q, "position": position }))
    });
    let mut object = Map::new();
    object.insert("q".into(), joints.values().cloned().collect());
    object.insert("bodies".into(), Value::Object(bodies.collect()));
    object.insert("joints".into(), Value::Object(joints));
    object
}

fn mode(file: &SpaceFile, id: usize, mode: &SpaceMode) -> Value {
    let mut object = Map::new();
    object.insert("id".into(), json!(id));
    object.insert("real".into(), json!(mode.real));
    object.extend(places(file, mode));
    object.insert("multiplicity".into(), json!(mode.multiplicity));
    object.insert("residual".into(), number(mode.residual));
    object.insert("certified".into(), json!(mode.certified));
    object.insert("radius".into(), number(mode.radius));
    Value::Object(object)
}

/// Returns the answer to one case, its number counted from 1, with complex assemblies on request.
#[must_use]
pub fn result(file: &SpaceFile, case: &SpaceCase, index: usize, answer: &SpaceAnswer, complex: bool) -> Value {
    let (linkage, verdict) = (&file.linkage, &answer.verdict);
    let groups = answer.groups.iter().map(|group| {
        let names =
            |bodies: &Vec<usize>| bodies.iter().map(|body| linkage.bodies[*body].name.clone()).collect::<Vec<_>>();
        let bodies = group.bodies.iter().map(names).collect::<Vec<_>>();
        json!({ "bodies": bodies, "count": group.count, "route": group.route })
    });
    let families = answer.sample.iter().map(|(sample, joints)| {
        let labels: Vec<&str> = joints.iter().map(|joint| linkage.joints[*joint].name.as_str()).collect();
        let numbers: Vec<usize> = joints.iter().map(|joint| joint + 1).collect();
        json!({ "dimension": verdict.self_motion, "joints": numbers, "labels": labels, "distance": 0, "sample": places(file, sample), "samples": [] })
    });
    let modes = (1..).zip(&answer.modes).filter(|(_, mode)| complex || mode.real);
    json!({
        "case": index,
        "asked": asked_json(file, &case.given),
        "verdict": verdict_json(verdict),
        "groups": groups.collect::<Value>(),
        "modes": modes.map(|(id, own)| mode(file, id, own)).collect::<Value>(),
        "families": families.collect::<Value>(),
        "warnings": [],
        "timings_us": { "solve": tenths(answer.solve_us) },
    })
}

/// Returns the answer to one case as tables, with complex assemblies on request.
#[must_use]
pub fn text(file: &SpaceFile, case: &SpaceCase, index: usize, answer: &SpaceAnswer, complex: bool) -> String {
    let linkage = &file.linkage;
    let mut text = format!("{}, case {index}: {}\n", file.heading.title, asked(file, &case.given));
    paragraph(&mut text, &headline(&answer.verdict));
    let groups = answer.groups.iter().map(|group| {
        let first = group.bodies.iter().filter_map(|bodies| bodies.first());
        let names: Vec<&str> = first.map(|body| linkage.bodies[*body].name.as_str()).collect();
        format!("{} ({})", group.count, names.join(" "))
    });
    let groups: Vec<String> = groups.collect();
    if !groups.is_empty() {
        paragraph(&mut text, &format!("groups: {}", groups.join(" x ")));
    }
    let joints: Vec<usize> = (0..linkage.joints.len()).filter(|k| linkage.joints[*k].is_distance().is_some()).collect();
    let bodies = moved(linkage);
    let mut header = vec!["mode".to_owned()];
    header.extend(joints.iter().map(|k| {
        let joint = &linkage.joints[*k];
        format!("{} [{}]", joint.name, if joint.is_distance() == Some(true) { "m" } else { "deg" })
    }));
    for body in &bodies {
        let name = &linkage.bodies[*body].name;
        header.extend(["x", "y", "z"].map(|axis| format!("{name} {axis} [m]")));
    }
    // Without any R or P joint the values of joints and the places may be the same in all modes.
    let turned = if linkage.joints.iter().any(is_placing) { &[] } else { bodies.as_slice() };
    for body in turned {
        let name = &linkage.bodies[*body].name;
        header.extend(["qw", "qx", "qy", "qz"].map(|part| format!("{name} {part}")));
    }
    let multiple = answer.modes.iter().any(|mode| mode.multiplicity > 1 && (complex || mode.real));
    if multiple {
        header.push("multiplicity".to_owned());
    }
    let mut table = Columns::new(&header, &["mode"]);
    let cell = |z: &Coordinate, scale: f64, real: bool| {
        let (re, im) = (z.re * scale, z.im * scale);
        if real { short(re, 6) } else { format!("{} {im:+.6}i", short(re, 6)) }
    };
    let shown =
        (1..).zip(&answer.modes).filter(|(_, mode)| complex || mode.real).map(|(k, mode)| (k.to_string(), mode, false));
    let listed = shown.chain(answer.sample.iter().map(|(sample, _)| ("family".to_owned(), sample, true)));
    let mut rows = 0;
    for (name, mode, is_sample) in listed {
        let mut row = vec![name];
        for joint in &joints {
            let scale = if linkage.joints[*joint].is_distance() == Some(true) { 1.0 } else { 1.0_f64.to_degrees() };
            row.push(mode.joints[*joint].map_or(String::new(), |z| cell(&z, scale, mode.real)));
        }
        row.extend(bodies.iter().flat_map(|body| mode.position(*body)).map(|z| cell(z, 1.0, mode.real)));
        // The quaternion of a complex rotation may have norm 0, and is none then.
        let quaternion = |body: &usize| mode.quaternion(*body).map(|q| q.map(|z| cell(&z, 1.0, mode.real)));
        row.extend(turned.iter().flat_map(|body| quaternion(body).unwrap_or_default()));
        // A sample of a family has none.
        let times = if is_sample { String::new() } else { mode.multiplicity.to_string() };
        row.extend(multiple.then_some(times));
        table.row(row);
        rows += 1;
    }
    if rows > 0 {
        let _ = write!(text, "\n{}", table.text());
    }
    let count = counted(answer.modes.len(), "assembly");
    let _ = writeln!(text, "\n{count} in {}", duration(answer.solve_us));
    text
}
