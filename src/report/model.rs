//! A mechanism in its normalised form: what was understood of a file, for the reader to compare.

use super::json::{kind, number};
use super::number::{counted, short};
use super::table::{Columns, paragraph};
use super::text::variables;
use crate::algebra::number::Number;
use crate::catalogue::citation;
use crate::catalogue::entry::{Case, Entry, Expected, InputValue, Kind};
use crate::kinematics::chain::{Geometry, JointKind, Placement};
use crate::kinematics::closed_loop::Variable;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// The letter of a joint kind.
#[must_use]
pub fn letter(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Revolute => "R",
        JointKind::Prismatic => "P",
        JointKind::Cylindrical => "C",
        JointKind::Helical => "H",
        JointKind::Spherical => "S",
        JointKind::Universal => "U",
    }
}

/// The joints in short: `6R`, `RRPRRR`.
#[must_use]
pub fn joints(entry: &Entry) -> String {
    let letters: String = entry.chain.joint_kinds().into_iter().map(letter).collect();
    let first = &letters[..1.min(letters.len())];
    if letters.len() > 1 && letters.replace(first, "").is_empty() {
        return format!("{}{first}", letters.len());
    }
    letters
}

/// `6 poses`, `1 input`.
#[must_use]
pub fn cases(entry: &Entry) -> String {
    counted(entry.cases.len(), if entry.kind == Kind::Arm { "pose" } else { "input" })
}

/// The claims of one sort over all cases: `16`, `4-8`, empty without any.
#[must_use]
pub fn claimed(entry: &Entry, claim: impl Fn(&Expected) -> Option<usize>) -> String {
    let counts: Vec<usize> = entry.cases.iter().filter_map(|case| claim(&case.expected)).collect();
    match (counts.iter().min(), counts.iter().max()) {
        (Some(low), Some(high)) if low == high => low.to_string(),
        (Some(low), Some(high)) => format!("{low}-{high}"),
        _ => String::new(),
    }
}

fn convention(geometry: &Geometry) -> (&'static str, &'static str) {
    match geometry {
        Geometry::Dh(_) => ("dh", "Rz(q + theta0) Tz(d) Tx(a) Rx(alpha)"),
        Geometry::ModifiedDh(_) => ("modified-dh", "Rx(alpha) Tx(a) Rz(q + theta0) Tz(d)"),
        Geometry::Screws { .. } => ("screws", "product of exponentials about the axes in the home position"),
    }
}

/// The model as a table, with its source and its claims.
#[must_use]
pub fn text(entry: &Entry) -> String {
    let mut text = format!("{}\n", entry.title);
    let (name, formula) = convention(&entry.chain.geometry);
    let _ = writeln!(text, "{} {}, {name}: {formula}", joints(entry), kind(entry.kind));
    if let Some(source) = &entry.source {
        let place = source.place.as_ref().map_or(String::new(), |place| format!(", {place}"));
        let citation = citation(&source.key).map_or(String::new(), |citation| format!(". {citation}"));
        paragraph(&mut text, &format!("source: [{}]{place}{citation}", source.key));
    }
    if let Some(notes) = &entry.notes {
        paragraph(&mut text, &format!("notes: {notes}"));
    }
    if entry.rounded {
        paragraph(&mut text, "exact: no; some numbers are irrational and rounded for exact work (--digits)");
    }
    text.push('\n');
    text.push_str(&joint_table(entry).text());
    if let Geometry::Screws { home, .. } = &entry.chain.geometry {
        placement(&mut text, "home", home);
    }
    placement(&mut text, "base", &entry.chain.base);
    placement(&mut text, "tool", &entry.chain.tool);
    let _ = write!(text, "\n{}", cases(entry));
    let solutions: usize = entry.cases.iter().map(|case| case.expected.solutions.len()).sum();
    let claims = [
        ("complex", claimed(entry, |e| e.complex)),
        ("real", claimed(entry, |e| e.real)),
        ("dimension", claimed(entry, |e| e.dimension)),
        ("solutions", if solutions > 0 { solutions.to_string() } else { String::new() }),
    ];
    let claims: Vec<String> = claims
        .into_iter()
        .filter(|(_, count)| !count.is_empty())
        .map(|(what, count)| format!("{what} {count}"))
        .collect();
    if claims.is_empty() {
        text.push_str(", no claims\n");
    } else {
        let _ = writeln!(text, "; claimed: {}", claims.join(", "));
    }
    text
}

fn joint_table(entry: &Entry) -> Columns {
    let degrees = |radians: f64| short(radians.to_degrees(), 6);
    let metres = |length: f64| short(length, 9);
    let limited = !entry.limits.is_empty();
    let limits = limits_of_joints(entry);
    let finish = |header: &mut Vec<&str>| {
        if limited {
            header.push("limits");
        }
    };
    let mut table;
    match &entry.chain.geometry {
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
                    letter(joint.kind).to_owned(),
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
                let mut row = vec![(index + 1).to_string(), letter(joint.kind).to_owned()];
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
fn limits_of_joints(entry: &Entry) -> Vec<String> {
    let mut texts = vec![String::new(); entry.chain.joint_kinds().len()];
    for ((name, variable), [low, high]) in variables(entry).iter().zip(&entry.limits) {
        let text = match variable {
            Variable::Rotation => format!("{}..{} deg", short(low.to_degrees(), 2), short(high.to_degrees(), 2)),
            Variable::Translation => format!("{}..{} m", short(*low, 4), short(*high, 4)),
        };
        let joint: usize = name[1..].parse().unwrap_or(1);
        let cell = &mut texts[joint - 1];
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

/// The homogeneous matrix of a placement.
fn matrix(placement: &Placement) -> [[f64; 4]; 4] {
    let motion = &placement.float;
    let mut rows = [[0.0, 0.0, 0.0, 1.0]; 4];
    for (i, row) in rows.iter_mut().take(3).enumerate() {
        row[..3].copy_from_slice(&motion.rotation[i]);
        row[3] = motion.translation[i];
    }
    rows
}

/// The model in radians and metres.
#[must_use]
pub fn json(entry: &Entry) -> Value {
    let mut object = identity(entry);
    object.insert("notes".into(), json!(entry.notes));
    object.insert("citation".into(), json!(entry.source.as_ref().and_then(|source| citation(&source.key))));
    object.insert("convention".into(), json!(convention(&entry.chain.geometry).0));
    let pitch = |pitch: &Option<Number>| pitch.as_ref().map(|pitch| number(pitch.to_f64()));
    let joints: Vec<Value> = match &entry.chain.geometry {
        Geometry::Dh(list) | Geometry::ModifiedDh(list) => list
            .iter()
            .map(|joint| {
                json!({
                    "type": letter(joint.kind),
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
                        "type": letter(joint.kind),
                        "axis": vector(&joint.axis),
                        "point": vector(&joint.point),
                        "pitch": pitch(&joint.pitch),
                    })
                })
                .collect()
        }
    };
    object.insert("joints".into(), json!(joints));
    object.insert("base".into(), json!(matrix(&entry.chain.base)));
    object.insert("tool".into(), json!(matrix(&entry.chain.tool)));
    object.insert("limits".into(), json!(entry.limits));
    object.insert("exact".into(), json!(!entry.rounded));
    object.insert("cases".into(), json!(entry.cases.iter().map(case).collect::<Vec<_>>()));
    Value::Object(object)
}

/// What a listing says of an entry.
#[must_use]
pub fn summary(entry: &Entry) -> Value {
    Value::Object(identity(entry))
}

fn identity(entry: &Entry) -> Map<String, Value> {
    let source = entry.source.as_ref().map(|source| json!({ "key": source.key, "where": source.place }));
    let mut object = Map::new();
    object.insert("name".into(), json!(entry.name));
    object.insert("title".into(), json!(entry.title));
    object.insert("kind".into(), json!(kind(entry.kind)));
    object.insert("type".into(), json!(entry.chain.joint_kinds().into_iter().map(letter).collect::<String>()));
    object.insert("source".into(), json!(source));
    object
}

fn case(case: &Case) -> Value {
    let mut object = Map::new();
    if let Some(pose) = &case.pose {
        object.insert("matrix".into(), json!(matrix(pose)));
    }
    for input in &case.input {
        object.insert("joint".into(), json!(input.joint));
        match &input.value {
            InputValue::Angle(angle) => object.insert("angle".into(), number(angle.radians())),
            InputValue::Distance(distance) => object.insert("distance".into(), number(distance.to_f64())),
        };
    }
    object.insert("expected".into(), expected(&case.expected));
    Value::Object(object)
}

/// The claims of a case.
fn expected(expected: &Expected) -> Value {
    let counts = [("complex", expected.complex), ("real", expected.real), ("dimension", expected.dimension)];
    let mut object: Map<String, Value> =
        counts.into_iter().filter_map(|(key, count)| Some((key.to_owned(), json!(count?)))).collect();
    if !expected.solutions.is_empty() {
        let solutions = expected.solutions.iter().map(|claim| json!({ "q": claim.q, "digits": claim.digits }));
        object.insert("solutions".into(), json!(solutions.collect::<Vec<_>>()));
    }
    Value::Object(object)
}
