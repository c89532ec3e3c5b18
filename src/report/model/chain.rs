//! Chains in normalised form.

use super::matrix;
use crate::algebra::number::Number;
use crate::catalogue::entry::Entry;
use crate::kinematics::chain::{Chain, Geometry, JointKind, Placement};
use crate::kinematics::closed_loop::Variable;
use crate::report::json::number;
use crate::report::number::short;
use crate::report::table::Columns;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// The letters of its joints.
pub(super) fn letters(chain: &Chain) -> String {
    chain.joint_kinds().into_iter().map(JointKind::letter).collect()
}

/// The name of a convention and its formula.
pub(super) fn convention(geometry: &Geometry) -> (&'static str, &'static str) {
    match geometry {
        Geometry::Dh(_) => ("dh", "Rz(q + theta0) Tz(d) Tx(a) Rx(alpha)"),
        Geometry::ModifiedDh(_) => ("modified-dh", "Rx(alpha) Tx(a) Rz(q + theta0) Tz(d)"),
        Geometry::Screws { .. } => ("screws", "product of exponentials about the axes in the home position"),
    }
}

/// The joints as a table, and the motions beside them.
pub(super) fn write(text: &mut String, entry: &Entry, chain: &Chain) {
    text.push_str(&joint_table(entry, chain).text());
    if let Geometry::Screws { home, .. } = &chain.geometry {
        placement(text, "home", home);
    }
    placement(text, "base", &chain.base);
    placement(text, "tool", &chain.tool);
}

fn joint_table(entry: &Entry, chain: &Chain) -> Columns {
    let degrees = |radians: f64| short(radians.to_degrees(), 6);
    let metres = |length: f64| short(length, 9);
    let limited = !entry.limits.is_empty();
    let limits = limits_of_joints(entry, chain);
    let finish = |header: &mut Vec<&str>| {
        if limited {
            header.push("limits");
        }
    };
    let mut table;
    match &chain.geometry {
        Geometry::Dh(list) | Geometry::ModifiedDh(list) => {
            let pitched = list.iter().any(|joint| joint.pitch.is_some());
            let mut header = vec!["joint", "type", "a [m]", "alpha [deg]", "d [m]", "theta0 [deg]"];
            if pitched {
                header.push("pitch [m/rad]");
            }
            finish(&mut header);
            table = Columns::new(&header, &["type", "limits"]);
            for (index, joint) in list.iter().enumerate() {
                let mut row = vec![
                    (index + 1).to_string(),
                    joint.kind.letter().to_owned(),
                    metres(joint.a.to_f64()),
                    degrees(joint.alpha.radians()),
                    metres(joint.d.to_f64()),
                    degrees(joint.theta0.radians()),
                ];
                if pitched {
                    row.push(joint.pitch.as_ref().map_or(String::new(), |pitch| metres(pitch.to_f64())));
                }
                if limited {
                    row.push(limits[index].clone());
                }
                table.row(row);
            }
        }
        Geometry::Screws { joints: list, .. } => {
            let mut header = vec!["joint", "type", "axis x", "y", "z", "point x [m]", "y [m]", "z [m]"];
            finish(&mut header);
            table = Columns::new(&header, &["type", "limits"]);
            for (index, joint) in list.iter().enumerate() {
                let mut row = vec![(index + 1).to_string(), joint.kind.letter().to_owned()];
                row.extend(joint.axis.iter().chain(&joint.point).map(|x| metres(x.to_f64())));
                if limited {
                    row.push(limits[index].clone());
                }
                table.row(row);
            }
        }
    }
    table
}

/// The limits of each joint in words.
fn limits_of_joints(entry: &Entry, chain: &Chain) -> Vec<String> {
    let mut texts = vec![String::new(); chain.joint_kinds().len()];
    for (variable, [low, high]) in chain.variables().iter().zip(&entry.limits) {
        let text = match variable.variable {
            Variable::Rotation => format!("{}..{} deg", short(low.to_degrees(), 2), short(high.to_degrees(), 2)),
            Variable::Translation => format!("{}..{} m", short(*low, 4), short(*high, 4)),
        };
        let cell = &mut texts[variable.joint - 1];
        if !cell.is_empty() {
            cell.push_str(", ");
        }
        cell.push_str(&text);
    }
    texts
}

fn placement(text: &mut String, name: &str, placement: &Placement) {
    if *placement == Placement::identity() {
        return;
    }
    let _ = writeln!(text, "\n{name}");
    let rows: Vec<[String; 4]> = matrix(placement)[..3].iter().map(|row| row.map(|x| short(x, 9))).collect();
    let width = rows.iter().flatten().map(String::len).max().unwrap_or(0);
    for row in rows {
        let _ = writeln!(text, "  {}", row.map(|x| format!("{x:>width$}")).join("  "));
    }
}

/// The joints and the motions beside them, in radians and metres.
pub(super) fn insert(object: &mut Map<String, Value>, entry: &Entry, chain: &Chain) {
    object.insert("convention".into(), json!(convention(&chain.geometry).0));
    let pitch = |pitch: &Option<Number>| pitch.as_ref().map(|pitch| number(pitch.to_f64()));
    let joints: Vec<Value> = match &chain.geometry {
        Geometry::Dh(list) | Geometry::ModifiedDh(list) => list
            .iter()
            .map(|joint| {
                json!({
                    "type": joint.kind.letter(),
                    "a": number(joint.a.to_f64()),
                    "alpha": number(joint.alpha.radians()),
                    "d": number(joint.d.to_f64()),
                    "theta0": number(joint.theta0.radians()),
                    "pitch": pitch(&joint.pitch),
                })
            })
            .collect(),
        Geometry::Screws { joints: list, home } => {
            object.insert("home".into(), json!(matrix(home)));
            let vector = |v: &[Number; 3]| v.each_ref().map(|x| number(x.to_f64()));
            list.iter()
                .map(|joint| {
                    json!({
                        "type": joint.kind.letter(),
                        "axis": vector(&joint.axis),
                        "point": vector(&joint.point),
                        "pitch": pitch(&joint.pitch),
                    })
                })
                .collect()
        }
    };
    object.insert("joints".into(), json!(joints));
    object.insert("base".into(), json!(matrix(&chain.base)));
    object.insert("tool".into(), json!(matrix(&chain.tool)));
    object.insert("limits".into(), json!(entry.limits));
}
