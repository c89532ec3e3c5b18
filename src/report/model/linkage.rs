//! Linkages in normalised form.

use super::{labels, origin};
use crate::algebra::ring::Ring;
use crate::catalogue::LinkageFile;
use crate::kinematics::linkage::{Gaussian, Pair};
use crate::linkage::assembly::groups_of;
use crate::linkage::grashof::{Grashof, planar};
use crate::report::json::number;
use crate::report::number::{counted, short as rounded};
use crate::report::table::Columns;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// `linkage, 6 bodies, 7 joints`.
pub(super) fn short(file: &LinkageFile) -> String {
    format!("linkage, {}", size(file))
}

fn size(file: &LinkageFile) -> String {
    format!("{} bodies, {}", file.linkage.bodies.len(), counted(file.linkage.joints.len(), "joint"))
}

pub(super) fn identity(file: &LinkageFile) -> Map<String, Value> {
    let heading = &file.heading;
    labels(&heading.name, &heading.title, "linkage", &size(file), heading.source.as_ref())
}

fn letter(pair: &Pair) -> &'static str {
    match pair {
        Pair::Revolute => "R",
        Pair::Prismatic { .. } => "P",
        Pair::Gear { .. } => "gear",
    }
}

/// Bodies, joints and groups as tables.
pub(super) fn text(file: &LinkageFile) -> String {
    let linkage = &file.linkage;
    let mut text = format!("{}\n{}, ground {}\n", file.heading.title, short(file), linkage.bodies[linkage.ground].name);
    origin(&mut text, file.heading.source.as_ref(), file.heading.notes.as_deref());
    text.push_str(if file.exact { "exact\n" } else { "exact: no\n" });
    let metres = |x: &rug::Rational| rounded(x.to_f64(), 9);
    let mut table = Columns::new(&["body", "point", "x [m]", "y [m]"], &["body", "point"]);
    for body in &linkage.bodies {
        for (name, place) in &body.points {
            table.row([body.name.clone(), name.clone(), metres(&place.re), metres(&place.im)]);
        }
    }
    let _ = write!(text, "\n{}", table.text());
    let mut table = Columns::new(&["joint", "type", "first", "second"], &["joint", "type", "first", "second"]);
    for joint in &linkage.joints {
        let [a, b] = joint.of.map(|body| linkage.bodies[body].name.clone());
        table.row([joint.name.clone(), letter(&joint.pair).to_owned(), a, b]);
    }
    let _ = write!(text, "\n{}\n", table.text());
    for (index, case) in file.cases.iter().enumerate() {
        let line = match groups_of(linkage, &case.given) {
            Err(error) => error.to_string(),
            Ok(groups) => {
                let names = |clusters: &[usize]| {
                    clusters.iter().map(|body| linkage.bodies[*body].name.as_str()).collect::<Vec<_>>().join(" ")
                };
                let list: Vec<String> =
                    groups.list.iter().map(|group| format!("({})", names(&group.clusters))).collect();
                format!("{}: {}", counted(groups.list.len(), "group"), list.join(" "))
            }
        };
        let _ = writeln!(text, "case {}: {line}", index + 1);
    }
    grashof_text(&mut text, planar(linkage));
    let expected = file.cases.first().map(|case| &case.expected);
    let claim = |of: Option<usize>| of.map(|count| count.to_string());
    let claims = [("complex", expected.and_then(|e| e.complex)), ("real", expected.and_then(|e| e.real))];
    text + &super::claims(claims.map(|(what, count)| (what, claim(count))))
}

/// The line of the class of a four-bar.
pub(super) fn grashof_text(text: &mut String, found: Option<Grashof>) {
    if let Some(found) = found {
        let _ = writeln!(text, "four-bar: {}, {}", found.class, found.condition());
    }
}

/// The class of a four-bar; null of other linkages.
pub(super) fn grashof_json(found: Option<Grashof>) -> Value {
    found.map_or(Value::Null, |found| json!({ "sum": found.condition(), "class": found.class }))
}

fn pair(z: &Gaussian) -> Value {
    json!([number(z.re.to_f64()), number(z.im.to_f64())])
}

/// Bodies and joints, lengths in metres.
#[must_use]
pub fn json(file: &LinkageFile) -> Value {
    let linkage = &file.linkage;
    let mut object = identity(file);
    super::remarks(&mut object, file.heading.source.as_ref(), file.heading.notes.as_deref());
    let mut bodies = Map::new();
    for body in &linkage.bodies {
        let points: Map<String, Value> = body.points.iter().map(|(name, place)| (name.clone(), pair(place))).collect();
        bodies.insert(body.name.clone(), Value::Object(points));
    }
    let joints = linkage.joints.iter().map(|joint| {
        let of = joint.of.map(|body| linkage.bodies[body].name.clone());
        let at = joint.at.each_ref().map(pair);
        let mut object = json!({ "name": joint.name, "type": letter(&joint.pair), "of": of, "at": at });
        match &joint.pair {
            Pair::Revolute => {}
            Pair::Prismatic { turn, along, .. } => {
                // The same direction in the second body.
                let back = along.mul(&Gaussian { re: turn.re.clone(), im: -turn.im.clone() });
                object["along"] = json!([pair(along), pair(&back)]);
            }
            Pair::Gear { carrier, ratio, phase } => {
                object["carrier"] = json!(linkage.bodies[*carrier].name);
                object["ratio"] = number(ratio.to_f64());
                object["phase"] = number(phase.im.to_f64().atan2(phase.re.to_f64()));
            }
        }
        object
    });
    object.insert("space".into(), json!("plane"));
    object.insert("ground".into(), json!(linkage.bodies[linkage.ground].name));
    object.insert("joints".into(), joints.collect());
    object.insert("bodies".into(), Value::Object(bodies));
    let traces = file.traces.iter().map(|trace| format!("{}.{}", linkage.bodies[trace.body].name, trace.point.0));
    object.insert("traces".into(), traces.collect());
    object.insert("grashof".into(), grashof_json(planar(linkage)));
    object.insert("exact".into(), json!(file.exact));
    Value::Object(object)
}
