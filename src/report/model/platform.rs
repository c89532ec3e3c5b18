//! Platforms in normalised form.

use crate::algebra::number::Number;
use crate::catalogue::entry::Entry;
use crate::kinematics::platform::Platform;
use crate::report::json::number;
use crate::report::number::short;
use crate::report::table::Columns;
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
}

/// The points in metres.
pub(super) fn insert(object: &mut Map<String, Value>, platform: &Platform<Number>) {
    let points = |points: &Points| points.each_ref().map(|p| p.each_ref().map(|x| number(x.to_f64())));
    object.insert("base".into(), json!(points(&platform.base)));
    object.insert("plate".into(), json!(points(&platform.plate)));
}
