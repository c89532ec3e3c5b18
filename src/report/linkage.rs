//! Assemblies of linkages as text and as JSON.

use super::document::units;
use super::json::{number, tenths};
use super::model;
use super::number::{counted, duration, short};
use super::table::{Columns, paragraph};
use crate::catalogue::{LinkageCase, LinkageFile};
use crate::kinematics::linkage::{Given, Linkage, LinkageJoint};
use crate::linkage::answer::{Coordinate, LinkageAnswer, LinkageFamily, LinkageMode};
use crate::verdict::Verdict;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// Returns the inputs in words such as `A = 53.130 deg`.
pub(super) fn asked(linkage: &Linkage, given: &[Given]) -> String {
    let one = |given: &Given| match given {
        Given::Turn { joint, turn, .. } => {
            let angle = turn.im.to_f64().atan2(turn.re.to_f64()).to_degrees();
            format!("{} = {} deg", linkage.joints[*joint].name, short(angle, 6))
        }
        Given::Shift { joint, .. } => {
            format!("{} = {} m", linkage.joints[*joint].name, short(distance(linkage, given).unwrap_or(f64::NAN), 6))
        }
        Given::Place { body, turn, origin, .. } => {
            let angle = turn.im.to_f64().atan2(turn.re.to_f64()).to_degrees();
            let (x, y) = (short(origin.re.to_f64(), 6), short(origin.im.to_f64(), 6));
            format!("{} at ({x}, {y}) m turned by {} deg", linkage.bodies[*body].name, short(angle, 6))
        }
    };
    if given.is_empty() { "nothing given".to_owned() } else { given.iter().map(one).collect::<Vec<_>>().join(", ") }
}

/// A given displacement in metres.
fn distance(linkage: &Linkage, given: &Given) -> Option<f64> {
    let Given::Shift { joint, shift, .. } = given else { return None };
    let crate::kinematics::linkage::Pair::Prismatic { length, .. } = &linkage.joints[*joint].pair else { return None };
    Some(shift.to_f64() * length.to_f64())
}

/// Returns the inputs as JSON: joints with their values, bodies with their places.
fn asked_json(linkage: &Linkage, given: &[Given]) -> Value {
    let (mut joints, mut bodies) = (Map::new(), Map::new());
    for one in given {
        match one {
            Given::Turn { joint, turn, .. } => {
                let angle = turn.im.to_f64().atan2(turn.re.to_f64());
                joints.insert(linkage.joints[*joint].name.clone(), number(angle));
            }
            Given::Shift { joint, .. } => {
                joints.insert(linkage.joints[*joint].name.clone(), number(distance(linkage, one).unwrap_or(f64::NAN)));
            }
            Given::Place { body, turn, origin, .. } => {
                let angle = turn.im.to_f64().atan2(turn.re.to_f64());
                let position = [number(origin.re.to_f64()), number(origin.im.to_f64())];
                bodies.insert(
                    linkage.bodies[*body].name.clone(),
                    json!({ "angle": number(angle), "position": position }),
                );
            }
        }
    }
    json!({ "joints": joints, "bodies": bodies })
}

/// The joints that have a value, in the order of the file.
pub(super) fn joint_variables(file: &LinkageFile) -> Value {
    let joints = file.linkage.joints.iter().enumerate().filter(|(_, joint)| !joint.is_gear());
    let variable = |(index, joint): (usize, &LinkageJoint)| {
        let kind = if joint.is_prismatic() { "distance" } else { "angle" };
        json!({ "name": joint.name, "kind": kind, "joint": index + 1, "label": joint.name })
    };
    joints.map(variable).collect()
}

/// One document for all cases.
#[must_use]
pub fn json(file: &LinkageFile, results: &[Value]) -> Value {
    json!({
        "title": file.heading.title,
        "kind": "linkage",
        "name": file.heading.name,
        "version": env!("CARGO_PKG_VERSION"),
        "units": units(),
        "joint_variables": joint_variables(file),
        "mechanism": model::linkage_json(file),
        "results": results,
    })
}

/// Returns the answer to one case, its number counted from 1, with complex assemblies on request.
#[must_use]
pub fn result(file: &LinkageFile, case: &LinkageCase, index: usize, answer: &LinkageAnswer, complex: bool) -> Value {
    let (linkage, verdict) = (&file.linkage, &answer.verdict);
    let groups = answer.groups.iter().map(|group| {
        let names = |bodies: &Vec<usize>| bodies.iter().map(|body| linkage.bodies[*body].name.clone()).collect::<Vec<_>>();
        json!({ "bodies": group.bodies.iter().map(names).collect::<Vec<_>>(), "count": group.count, "route": group.route })
    });
    let modes = (1..).zip(&answer.modes).filter(|(_, mode)| complex || mode.real);
    let families = listed_families(answer, complex).map(|family| {
        let labels: Vec<&str> = family.joints.iter().map(|joint| linkage.joints[*joint].name.as_str()).collect();
        let numbers: Vec<usize> = family.joints.iter().map(|joint| joint + 1).collect();
        json!({ "dimension": family.dimension, "joints": numbers, "labels": labels, "real": family.sample.real, "distance": 0, "sample": places(linkage, &family.sample), "samples": [] })
    });
    let mut result = json!({
        "case": index,
        "asked": asked_json(linkage, &case.given),
        "verdict": {
            "status": verdict.status.word(),
            "proof": verdict.proof.word(),
            "code": verdict.code.word(),
            "complex_complete": verdict.complex_complete,
            "complex": complex_count(verdict),
            "real": verdict.real,
            "at_infinity": verdict.at_infinity,
            "self_motion": verdict.self_motion,
            "certified": verdict.certified,
            "near": 0,
            "reason": verdict.reason,
        },
        "groups": groups.collect::<Value>(),
        "modes": modes.map(|(id, mode)| self::mode(linkage, id, mode)).collect::<Value>(),
        "families": families.collect::<Value>(),
        "warnings": [],
        "timings_us": { "solve": tenths(answer.solve_us) },
    });
    if !answer.listed {
        result["listed"] = json!(false);
    }
    result
}

fn value(z: &Coordinate, real: bool) -> Value {
    if real { number(z.re) } else { json!([number(z.re), number(z.im)]) }
}

/// Joints and bodies of an assembly.
fn places(linkage: &Linkage, mode: &LinkageMode) -> Map<String, Value> {
    let mut joints = Map::new();
    for (joint, z) in linkage.joints.iter().zip(&mode.joints) {
        if let Some(z) = z {
            joints.insert(joint.name.clone(), value(z, mode.real));
        }
    }
    let mut bodies = Map::new();
    for (body, (angle, origin)) in linkage.bodies.iter().zip(&mode.bodies) {
        let position = origin.each_ref().map(|z| value(z, mode.real));
        bodies.insert(body.name.clone(), json!({ "angle": value(angle, mode.real), "position": position }));
    }
    let mut object = Map::new();
    object.insert("q".into(), joints.values().cloned().collect());
    object.insert("joints".into(), Value::Object(joints));
    object.insert("bodies".into(), Value::Object(bodies));
    object
}

fn mode(linkage: &Linkage, id: usize, mode: &LinkageMode) -> Value {
    let mut object = Map::new();
    object.insert("id".into(), json!(id));
    object.insert("real".into(), json!(mode.real));
    object.extend(places(linkage, mode));
    object.insert("multiplicity".into(), json!(mode.multiplicity));
    object.insert("residual".into(), number(mode.residual));
    object.insert("certified".into(), json!(true));
    object.insert("radius".into(), number(mode.radius));
    Value::Object(object)
}

/// The families of an answer, those that are not real on request alone, as modes are.
fn listed_families(answer: &LinkageAnswer, complex: bool) -> impl Iterator<Item = &LinkageFamily> {
    answer.families.iter().filter(move |family| complex || family.sample.real)
}

/// The number of complex assemblies; `None` where they were not looked for, or form curves.
fn complex_count(verdict: &Verdict) -> Option<usize> {
    (!verdict.is_of_real_ones()).then_some(verdict.complex)
}

/// Returns the verdict on one line: how many assemblies there are, how many of them are real, and why.
#[must_use]
pub fn headline(verdict: &Verdict) -> String {
    let (status, proof) = (verdict.status.word(), verdict.proof.word());
    let real = match verdict.real {
        0 => "none of them real".to_owned(),
        real => format!("{real} of them real"),
    };
    let counts = match complex_count(verdict) {
        // A motion, or equations that contradict one another: the reason says all.
        Some(0) => String::new(),
        Some(complex) => format!("{}, {real}; ", counted(complex, "assembly")),
        None => format!("{}; ", counted(verdict.real, "real assembly")),
    };
    format!("{status} ({proof}): {counts}{}", verdict.reason)
}

/// Returns the answer to one case as tables, with complex assemblies on request.
#[must_use]
pub fn text(file: &LinkageFile, case: &LinkageCase, index: usize, answer: &LinkageAnswer, complex: bool) -> String {
    let linkage = &file.linkage;
    let mut text = format!("{}, case {index}: {}\n", file.heading.title, asked(linkage, &case.given));
    paragraph(&mut text, &headline(&answer.verdict));
    let groups: Vec<String> = answer
        .groups
        .iter()
        .map(|group| {
            let names: Vec<&str> = group
                .bodies
                .iter()
                .filter_map(|bodies| bodies.first())
                .map(|body| linkage.bodies[*body].name.as_str())
                .collect();
            format!("{} ({}: {})", group.count, names.join(" "), group.route)
        })
        .collect();
    if !groups.is_empty() {
        paragraph(&mut text, &format!("groups: {}", groups.join(" x ")));
    }
    let shown: Vec<(usize, &LinkageMode)> = (1..).zip(&answer.modes).filter(|(_, mode)| complex || mode.real).collect();
    let listed = shown.iter().copied().chain(listed_families(answer, complex).map(|family| (0, &family.sample)));
    let joints: Vec<usize> = (0..linkage.joints.len()).filter(|joint| !linkage.joints[*joint].is_gear()).collect();
    let mut header = vec!["mode".to_owned()];
    header.extend(joints.iter().map(|joint| {
        let joint = &linkage.joints[*joint];
        format!("{} [{}]", joint.name, if joint.is_prismatic() { "m" } else { "deg" })
    }));
    let multiple = shown.iter().any(|(_, mode)| mode.multiplicity > 1);
    if multiple {
        header.push("multiplicity".to_owned());
    }
    let mut table = Columns::new(&header, &["mode"]);
    let mut rows = 0;
    for (id, mode) in listed {
        let name = if id == 0 { "family".to_owned() } else { id.to_string() };
        let cell = |joint: &usize| {
            let scale = if linkage.joints[*joint].is_prismatic() { 1.0 } else { 1.0_f64.to_degrees() };
            mode.joints[*joint].map_or(String::new(), |z| {
                if mode.real {
                    short(z.re * scale, 6)
                } else {
                    format!("{} {:+.6}i", short(z.re * scale, 6), z.im * scale)
                }
            })
        };
        // A sample of a family has none.
        let times = if id == 0 { String::new() } else { mode.multiplicity.to_string() };
        table.row([name].into_iter().chain(joints.iter().map(cell)).chain(multiple.then_some(times)));
        rows += 1;
    }
    if rows > 0 {
        let _ = write!(text, "\n{}", table.text());
    }
    for family in listed_families(answer, complex) {
        let labels: Vec<&str> = family.joints.iter().map(|joint| linkage.joints[*joint].name.as_str()).collect();
        paragraph(
            &mut text,
            &format!(
                "{} of dimension {}: the joints {} move",
                if family.sample.real { "family" } else { "complex family" },
                family.dimension,
                labels.join(", ")
            ),
        );
    }
    let listed = if answer.listed { "" } else { " listed" };
    let _ = writeln!(text, "\n{}{listed} in {}", counted(answer.modes.len(), "assembly"), duration(answer.solve_us));
    text
}
