//! Arms as mechanism files.

use crate::algebra::number::{Angle, HalfTangent, Number};
use crate::catalogue::entry::Entry;
use crate::kinematics::chain::{Chain, Geometry, Joint, Placement, ScrewJoint};
use crate::kinematics::joint::DhConstant;
use rug::Rational;
use serde_json::{Map, Value, json};
use std::f64::consts::PI;

/// Longest exact number that is written as such, characters: longer ones are those of rounded data.
const LONGEST: usize = 40;
/// Joints without limits: more turns than any joint makes.
const UNLIMITED: f64 = 1e4;

/// The keys of a mechanism file.
pub(super) fn document(entry: &Entry, chain: &Chain) -> Value {
    let mut mechanism = Map::new();
    mechanism.insert("kind".into(), json!("arm"));
    let label = |k: usize| entry.labels.joints.get(k).cloned().flatten();
    let named = |k: usize, mut fields: Map<String, Value>| {
        if let Some(label) = label(k) {
            fields.insert("name".into(), json!(label));
        }
        Value::Object(fields)
    };
    let (convention, joints): (&str, Vec<Value>) = match &chain.geometry {
        Geometry::Dh(list) => ("dh", list.iter().enumerate().map(|(k, own)| named(k, joint(own))).collect()),
        Geometry::ModifiedDh(list) => {
            ("modified-dh", list.iter().enumerate().map(|(k, own)| named(k, joint(own))).collect())
        }
        Geometry::Screws { joints, home } => {
            mechanism.insert("home".into(), matrix(home));
            ("screws", joints.iter().enumerate().map(|(k, own)| named(k, screw(own))).collect())
        }
    };
    mechanism.insert("convention".into(), json!(convention));
    mechanism.insert("joints".into(), json!(joints));
    for (key, placement) in [("base", &chain.base), ("tool", &chain.tool)] {
        if *placement != Placement::identity() {
            mechanism.insert(key.into(), matrix(placement));
        }
    }
    if !entry.limits.is_empty() {
        let finite = |x: f64| x.clamp(-UNLIMITED, UNLIMITED);
        mechanism.insert("limits".into(), json!(entry.limits.iter().map(|pair| pair.map(finite)).collect::<Vec<_>>()));
    }
    let poses: Vec<Value> =
        entry.cases.iter().filter_map(|case| Some(json!({ "matrix": matrix(case.pose.as_ref()?) }))).collect();
    let mut document = json!({ "title": entry.title, "mechanism": mechanism });
    if !poses.is_empty() {
        document["pose"] = json!(poses);
    }
    document
}

/// The keys of a DH joint.
fn joint(joint: &Joint) -> Map<String, Value> {
    let mut fields = Map::new();
    fields.insert("type".into(), json!(joint.kind.letter()));
    fields.insert("a".into(), text_of(&number(&joint.a)));
    insert_angle(&mut fields, "alpha", &joint.alpha);
    let is_zero = *joint.d.rational() == 0;
    let (d, theta) = (joint.kind.row().d, joint.kind.row().theta);
    if theta == DhConstant::Stated {
        insert_angle(&mut fields, "theta", &joint.theta0);
    }
    if let Some(key) = d.key_of_d().filter(|_| d != DhConstant::Offset || !is_zero) {
        fields.insert(key.into(), text_of(&number(&joint.d)));
    }
    if let Some([key, _]) =
        theta.keys_of_theta().filter(|_| theta != DhConstant::Stated && joint.theta0 != Angle::zero())
    {
        insert_angle(&mut fields, key, &joint.theta0);
    }
    if let Some(pitch) = &joint.pitch {
        fields.insert("pitch".into(), text_of(&number(pitch)));
    }
    fields
}

/// The keys of a screw joint.
fn screw(joint: &ScrewJoint) -> Map<String, Value> {
    let vector = |v: &[Number; 3]| Value::from(v.iter().map(|x| text_of(&number(x))).collect::<Vec<_>>());
    let mut fields = Map::new();
    fields.insert("type".into(), json!(joint.kind.letter()));
    fields.insert("axis".into(), vector(&joint.axis));
    if !joint.kind.only_translates() {
        fields.insert("point".into(), vector(&joint.point));
    }
    if let Some(pitch) = &joint.pitch {
        fields.insert("pitch".into(), text_of(&number(pitch)));
    }
    fields
}

fn insert_angle(fields: &mut Map<String, Value>, key: &str, angle: &Angle) {
    match angle.half_tangent() {
        HalfTangent::Finite(half)
            if angle.is_exact() && in_degrees(angle).is_none() && half.to_string().len() < LONGEST =>
        {
            fields.insert(format!("tan_half_{key}"), json!(half.to_string()));
        }
        _ => {
            fields.insert(key.to_owned(), text_of(&self::angle(angle)));
        }
    }
}

/// A number as the files write it.
pub(super) fn number(number: &Number) -> String {
    let text = decimal(number.rational()).unwrap_or_else(|| number.rational().to_string());
    if number.is_exact() && text.len() < LONGEST { text } else { format!("{:?}", number.to_f64()) }
}

/// An angle as the files write it: in degrees where it is a multiple of half a degree, else in radians.
pub(super) fn angle(angle: &Angle) -> String {
    in_degrees(angle).unwrap_or_else(|| format!("{:?}", angle.radians()))
}

fn in_degrees(angle: &Angle) -> Option<String> {
    let halves = (angle.radians() * 360.0 / PI).round();
    let is_multiple = (halves * PI / 360.0 - angle.radians()).abs() <= f64::EPSILON * angle.radians().abs();
    if halves == 0.0 && angle.radians() == 0.0 {
        return Some("0".to_owned());
    }
    (is_multiple && halves != 0.0).then(|| format!("{} deg", halves / 2.0))
}

/// A rational number as a finite decimal, where it is one.
fn decimal(q: &Rational) -> Option<String> {
    let mut scaled = q.clone();
    for places in 0..LONGEST {
        if *scaled.denom() == 1 {
            let digits = scaled.numer().clone().abs().to_string();
            let sign = if *scaled.numer() < 0 { "-" } else { "" };
            let digits = format!("{digits:0>width$}", width = places + 1);
            let (whole, part) = digits.split_at(digits.len() - places);
            return Some(if part.is_empty() { format!("{sign}{whole}") } else { format!("{sign}{whole}.{part}") });
        }
        scaled *= 10;
    }
    None
}

/// A number in JSON where it is one, else an expression.
fn text_of(text: &str) -> Value {
    match text.parse::<f64>() {
        // Printed again the number must be the same one.
        Ok(number) if format!("{number:?}") == text || format!("{number}") == text => json!(number),
        _ => json!(text),
    }
}

/// The matrix of a placement: exact where it is.
fn matrix(placement: &Placement) -> Value {
    let entry = |i: usize, j: usize| {
        let (exact, float) = if j < 3 {
            (&placement.exact.rotation[i][j], placement.float.rotation[i][j])
        } else {
            (&placement.exact.translation[i], placement.float.translation[i])
        };
        let text = decimal(exact).unwrap_or_else(|| exact.to_string());
        if placement.given.is_none() && text.len() < LONGEST { text_of(&text) } else { json!(float) }
    };
    let mut rows: Vec<Value> = (0..3).map(|i| (0..4).map(|j| entry(i, j)).collect::<Vec<_>>().into()).collect();
    rows.push(json!([0, 0, 0, 1]));
    rows.into()
}

/// The document as TOML.
pub(super) fn toml(document: &Value) -> String {
    let mut text = format!("title = {}\n\n[mechanism]\n", inline(&document["title"]));
    let mechanism = document["mechanism"].as_object().cloned().unwrap_or_default();
    for key in ["kind", "convention", "joints", "home", "base", "tool", "limits"] {
        let Some(value) = mechanism.get(key) else { continue };
        match value.as_array() {
            Some(list) => {
                let rows: Vec<String> = list.iter().map(|row| format!("    {},\n", inline(row))).collect();
                text += &format!("{key} = [\n{}]\n", rows.concat());
            }
            None => text += &format!("{key} = {}\n", inline(value)),
        }
    }
    for pose in document["pose"].as_array().into_iter().flatten() {
        text += &format!("\n[[pose]]\nmatrix = {}\n", inline(&pose["matrix"]));
    }
    text
}

/// A value in one line.
fn inline(value: &Value) -> String {
    match value {
        Value::Array(items) => format!("[{}]", items.iter().map(inline).collect::<Vec<_>>().join(", ")),
        Value::Object(fields) => {
            let fields: Vec<String> = fields.iter().map(|(key, value)| format!("{key} = {}", inline(value))).collect();
            format!("{{ {} }}", fields.join(", "))
        }
        // Strings of both formats are quoted alike.
        other => other.to_string(),
    }
}
