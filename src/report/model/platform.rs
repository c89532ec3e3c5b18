//! Platforms in normalised form.

use crate::algebra::number::Number;
use crate::catalogue::entry::Entry;
use crate::kinematics::platform::Platform;
use crate::kinematics::platform_limits::{Cone, PlatformLimits};
use crate::report::json::number;
use crate::report::number::short;
use crate::report::table::{Columns, paragraph};
use serde_json::{Map, Value, json};

type Points = [[Number; 3]; 6];

/// Returns the numbers of different points of base and plate, as `6-3`.
pub(super) fn points(platform: &Platform<Number>) -> String {
    let different = |points: &Points| (0..6).filter(|k| !points[..*k].contains(&points[*k])).count();
    format!("{}-{}", different(&platform.base), different(&platform.plate))
}

/// The lengths of legs from their squares.
pub(super) fn lengths(squares: &[Number; 6]) -> [f64; 6] {
    squares.each_ref().map(|square| square.to_f64().sqrt())
}

/// The legs as a table: their ends and their lengths, which stand in a table of their own if there are several sets.
pub(super) fn write(text: &mut String, entry: &Entry, platform: &Platform<Number>) {
    let one = match entry.cases.as_slice() {
        [case] => case.legs_squared.as_ref().map(lengths),
        _ => None,
    };
    let mut header = vec!["leg", "base x [m]", "y [m]", "z [m]", "plate x [m]", "y [m]", "z [m]"];
    if one.is_some() {
        header.push("length [m]");
    }
    let metres = |length: f64| short(length, 9);
    let mut table = Columns::new(&header, &[]);
    for leg in 0..6 {
        let mut row = vec![(leg + 1).to_string()];
        row.extend(platform.base[leg].iter().chain(&platform.plate[leg]).map(|x| metres(x.to_f64())));
        row.extend(one.map(|lengths| metres(lengths[leg])));
        table.row(row);
    }
    text.push_str(&table.text());
    if one.is_none() {
        let header = ["#", "L1 [m]", "L2 [m]", "L3 [m]", "L4 [m]", "L5 [m]", "L6 [m]"];
        let mut table = Columns::new(&header, &[]);
        for (index, case) in entry.cases.iter().enumerate() {
            let mut row = vec![(index + 1).to_string()];
            row.extend(case.legs_squared.iter().flat_map(lengths).map(metres));
            table.row(row);
        }
        text.push('\n');
        text.push_str(&table.text());
    }
    if !entry.platform_limits.is_empty() {
        text.push('\n');
        paragraph(text, &limits(&entry.platform_limits));
    }
}

/// Returns the shortest and the longest length of every leg, metres.
fn leg_limits(limits: &PlatformLimits) -> Option<[[f64; 2]; 6]> {
    let squares = limits.legs_squared.as_ref()?;
    Some(squares.each_ref().map(|pair| pair.each_ref().map(|square| square.to_f64().sqrt())))
}

/// The limits in words, what holds for all legs once.
#[must_use]
pub fn limits(limits: &PlatformLimits) -> String {
    fn each<T: PartialEq>(name: &str, values: &[T; 6], word: impl Fn(&T) -> String) -> String {
        if values.iter().all(|value| *value == values[0]) {
            return format!("{name} {}", word(&values[0]));
        }
        let all: Vec<String> = (1..).zip(values).map(|(number, value)| format!("{number}: {}", word(value))).collect();
        format!("{name} {}", all.join(", "))
    }
    let legs = leg_limits(limits)
        .map(|legs| each("leg lengths", &legs, |[low, high]| format!("{}..{} m", short(*low, 6), short(*high, 6))));
    let cone = |cone: &Cone| {
        let axis = cone.axis.map(|x| short(x, 4)).join(", ");
        format!("within {} deg of ({axis})", short(cone.angle.to_degrees(), 2))
    };
    let base = limits.base.as_ref().map(|cones| each("base joints", cones, cone));
    let plate = limits.plate.as_ref().map(|cones| each("plate joints", cones, cone));
    let parts: Vec<String> = legs.into_iter().chain(base).chain(plate).collect();
    format!("limits: {}", parts.join("; "))
}

/// The points in metres, and the limits.
pub(super) fn insert(object: &mut Map<String, Value>, entry: &Entry, platform: &Platform<Number>) {
    let points = |points: &Points| points.each_ref().map(|p| p.each_ref().map(|x| number(x.to_f64())));
    object.insert("base".into(), json!(points(&platform.base)));
    object.insert("plate".into(), json!(points(&platform.plate)));
    if let Some(legs) = leg_limits(&entry.platform_limits) {
        object.insert("limits".into(), json!(legs));
    }
    let cone = |cone: &Cone| json!({ "axis": cone.axis, "angle": cone.angle });
    let cones = [("base_cones", &entry.platform_limits.base), ("plate_cones", &entry.platform_limits.plate)];
    for (key, cones) in cones {
        if let Some(cones) = cones {
            object.insert(key.into(), cones.iter().map(cone).collect());
        }
    }
}
