//! Linkages on the sphere in normalised form.

use super::linkage::{grashof_json, grashof_text};
use super::{labels, origin};
use crate::catalogue::SphereFile;
use crate::kinematics::sphere::Direction;
use crate::linkage::grashof::spherical;
use crate::report::json::number;
use crate::report::number::{counted, short as rounded};
use crate::report::table::Columns;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// `linkage on the sphere, 4 bodies, 4 joints`.
pub(super) fn short(file: &SphereFile) -> String {
    format!("linkage on the sphere, {}", size(file))
}

fn size(file: &SphereFile) -> String {
    format!("{} bodies, {}", file.linkage.bodies.len(), counted(file.linkage.joints.len(), "joint"))
}

pub(super) fn identity(file: &SphereFile) -> Map<String, Value> {
    let heading = &file.heading;
    labels(&heading.name, &heading.title, "linkage", &size(file), heading.source.as_ref())
}

/// Bodies and joints as tables.
pub(super) fn text(file: &SphereFile) -> String {
    let linkage = &file.linkage;
    let mut text = format!("{}\n{}, ground {}\n", file.heading.title, short(file), linkage.bodies[linkage.ground].name);
    origin(&mut text, file.heading.source.as_ref(), file.heading.notes.as_deref());
    text.push_str(if file.exact { "exact\n" } else { "exact: no\n" });
    let mut table = Columns::new(&["body", "point", "x", "y", "z"], &["body", "point"]);
    for body in &linkage.bodies {
        for (name, place) in &body.points {
            let [x, y, z] = place.each_ref().map(|c| rounded(c.to_f64(), 9));
            table.row([body.name.clone(), name.clone(), x, y, z]);
        }
    }
    let _ = write!(text, "\n{}", table.text());
    let mut table = Columns::new(&["joint", "first", "second"], &["joint", "first", "second"]);
    for joint in &linkage.joints {
        let [a, b] = joint.of.map(|body| linkage.bodies[body].name.clone());
        table.row([joint.name.clone(), a, b]);
    }
    let _ = write!(text, "\n{}\n", table.text());
    grashof_text(&mut text, spherical(linkage));
    let expected = file.cases.first().map(|case| &case.expected);
    let claim = |of: Option<usize>| of.map(|count| count.to_string());
    let claims = [("complex", expected.and_then(|e| e.complex)), ("real", expected.and_then(|e| e.real))];
    text + &super::claims(claims.map(|(what, count)| (what, claim(count))))
}

fn list(v: &Direction) -> Value {
    v.iter().map(|c| number(c.to_f64())).collect()
}

/// Bodies and joints.
#[must_use]
pub fn json(file: &SphereFile) -> Value {
    let linkage = &file.linkage;
    let mut object = identity(file);
    super::remarks(&mut object, file.heading.source.as_ref(), file.heading.notes.as_deref());
    let mut bodies = Map::new();
    for body in &linkage.bodies {
        let points: Map<String, Value> = body.points.iter().map(|(name, place)| (name.clone(), list(place))).collect();
        bodies.insert(body.name.clone(), Value::Object(points));
    }
    let joints = linkage.joints.iter().map(|joint| {
        let of = joint.of.map(|body| linkage.bodies[body].name.clone());
        let [at, zero] = [&joint.at, &joint.zero].map(|pair| pair.each_ref().map(list));
        json!({ "name": joint.name, "type": "R", "of": of, "at": at, "zero": zero })
    });
    object.insert("space".into(), json!("sphere"));
    object.insert("ground".into(), json!(linkage.bodies[linkage.ground].name));
    object.insert("joints".into(), joints.collect());
    object.insert("bodies".into(), Value::Object(bodies));
    let traces = file.traces.iter().map(|trace| format!("{}.{}", linkage.bodies[trace.body].name, trace.point));
    object.insert("traces".into(), traces.collect());
    object.insert("grashof".into(), grashof_json(spherical(linkage)));
    object.insert("exact".into(), json!(file.exact));
    Value::Object(object)
}
