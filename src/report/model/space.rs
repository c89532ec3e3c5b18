//! Linkages in space in normalised form.

use super::{labels, origin};
use crate::catalogue::SpaceFile;
use crate::kinematics::motion::Vector;
use crate::kinematics::space::SpacePair;
use crate::report::json::number;
use crate::report::number::{counted, short as rounded};
use crate::report::table::Columns;
use rug::Rational;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// `linkage in space, 4 bodies, 4 joints`.
pub(super) fn short(file: &SpaceFile) -> String {
    format!("linkage in space, {}", size(file))
}

fn size(file: &SpaceFile) -> String {
    format!("{} bodies, {}", file.linkage.bodies.len(), counted(file.linkage.joints.len(), "joint"))
}

pub(super) fn identity(file: &SpaceFile) -> Map<String, Value> {
    let heading = &file.heading;
    labels(&heading.name, &heading.title, "linkage", &size(file), heading.source.as_ref())
}

/// Bodies and joints as tables.
pub(super) fn text(file: &SpaceFile) -> String {
    let linkage = &file.linkage;
    let mut text = format!("{}\n{}, ground {}\n", file.heading.title, short(file), linkage.bodies[linkage.ground].name);
    origin(&mut text, file.heading.source.as_ref(), file.heading.notes.as_deref());
    text.push_str(if file.exact { "exact\n" } else { "exact: no\n" });
    let mut table = Columns::new(&["body", "point", "x [m]", "y [m]", "z [m]"], &["body", "point"]);
    for body in &linkage.bodies {
        for (name, place) in &body.points {
            let [x, y, z] = place.each_ref().map(|c| rounded(c.to_f64(), 9));
            table.row([body.name.clone(), name.clone(), x, y, z]);
        }
    }
    let _ = write!(text, "\n{}", table.text());
    let mut table = Columns::new(&["joint", "type", "first", "second"], &["joint", "type", "first", "second"]);
    for joint in &linkage.joints {
        let [a, b] = joint.of.map(|body| linkage.bodies[body].name.clone());
        table.row([joint.name.clone(), joint.pair.word().to_owned(), a, b]);
    }
    let _ = write!(text, "\n{}\n", table.text());
    let expected = file.cases.first().map(|case| &case.expected);
    let claim = |of: Option<usize>| of.map(|count| count.to_string());
    let claims = [("complex", expected.and_then(|e| e.complex)), ("real", expected.and_then(|e| e.real))];
    text + &super::claims(claims.map(|(what, count)| (what, claim(count))))
}

fn list(v: &Vector<Rational>) -> Value {
    v.iter().map(|c| number(c.to_f64())).collect()
}

/// Bodies and joints.
#[must_use]
pub fn json(file: &SpaceFile) -> Value {
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
        let at = joint.at.each_ref().map(list);
        let mut object = json!({ "name": joint.name, "type": joint.pair.word(), "of": of, "at": at });
        let root = |square: &Rational| number(square.to_f64().sqrt());
        match &joint.pair {
            SpacePair::Revolute(axis) | SpacePair::Prismatic(axis) => {
                object["axis"] = json!(axis.sphere.at.each_ref().map(list));
                object["zero"] = json!(axis.sphere.zero.each_ref().map(list));
            }
            SpacePair::UniversalLeg(axes) => object["axis"] = json!(axes.each_ref().map(list)),
            SpacePair::Universal(axes) => object["axes"] = json!(axes.each_ref().map(list)),
            SpacePair::Rod(square) => object["length"] = root(square),
            SpacePair::Parallelogram(axes, square) => {
                object["axis"] = json!(axes.each_ref().map(list));
                object["length"] = root(square);
            }
            SpacePair::Spherical | SpacePair::Leg => {}
        }
        object
    });
    object.insert("space".into(), json!("space"));
    object.insert("ground".into(), json!(linkage.bodies[linkage.ground].name));
    object.insert("joints".into(), joints.collect());
    object.insert("bodies".into(), Value::Object(bodies));
    object.insert("exact".into(), json!(file.exact));
    Value::Object(object)
}
