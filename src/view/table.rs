//! The table of a page: a row for every mode, or for every branch.

use super::tracks::{Kind, Track, is_path, is_sweep, list, shown, turns};
use crate::report::number::three_digits;
use crate::report::picture::escaped;
use serde_json::Value;
use std::fmt::Write;

/// A cell: its text, what it is sorted by, and its class.
struct Cell {
    text: String,
    value: Option<f64>,
    class: &'static str,
}

impl Cell {
    fn number(value: Option<f64>, digits: usize) -> Self {
        let text = value.map_or_else(|| "\u{2013}".to_owned(), |x| signed(x, digits));
        Self { text, value, class: "" }
    }

    fn text(text: impl Into<String>) -> Self {
        Self { text: text.into(), value: None, class: "word" }
    }
}

/// A number with the minus sign of print.
pub(super) fn signed(x: f64, digits: usize) -> String {
    let text = format!("{:.digits$}", x + 0.0);
    let is_zero = text.bytes().all(|c| matches!(c, b'-' | b'0' | b'.'));
    if is_zero { text.replace('-', "") } else { text.replace('-', "\u{2212}") }
}

/// The rows of all tracks that are listed, and their heads.
pub(super) fn table(document: &Value, tracks: &[Track<'_>]) -> String {
    let listed: Vec<(usize, &Track<'_>)> =
        tracks.iter().enumerate().filter(|(_, track)| is_listed(document, track)).collect();
    if is_sweep(document) {
        return of_branches(document, &listed);
    }
    if document["kind"] == "framework" {
        return of_vertices(document);
    }
    of_modes(document, &listed)
}

/// Modes are listed, and the branches of a sweep; those of a path have buttons.
fn is_listed(document: &Value, track: &Track<'_>) -> bool {
    matches!(track.kind, Kind::Mode | Kind::Nearest) || track.kind == Kind::Branch && is_sweep(document)
}

fn written(caption: &str, heads: &[String], rows: &[(Option<usize>, String, Vec<Cell>)]) -> String {
    let mut text = format!("<div class=\"scroll\"><table>\n<caption>{}</caption>\n<thead><tr>", escaped(caption));
    for head in heads {
        let _ = write!(text, "<th scope=\"col\" data-sort>{}</th>", escaped(head));
    }
    text.push_str("</tr></thead>\n<tbody>\n");
    for (track, class, cells) in rows {
        let index = track.map_or_else(String::new, |track| format!(" data-track=\"{track}\""));
        let _ = write!(text, "<tr{index}{class}>");
        for Cell { text: cell, value, class } in cells {
            // A numeric text is sorted by its number.
            let is_plain = cell.replace('\u{2212}', "-").parse::<f64>().is_ok();
            let value = value.filter(|_| !is_plain).map_or_else(String::new, |x| format!(" data-value=\"{x}\""));
            let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
            let _ = write!(text, "<td{class}{value}>{}</td>", escaped(cell));
        }
        text.push_str("</tr>\n");
    }
    text.push_str("</tbody></table></div>\n");
    text
}

/// A real number, or a complex one as a pair.
fn complex(value: &Value, scale: f64, digits: usize) -> Cell {
    match value.as_array().map(Vec::as_slice) {
        Some([re, im]) => {
            let (re, im) = (re.as_f64().unwrap_or(0.0) * scale, im.as_f64().unwrap_or(0.0) * scale);
            let sign = if im < 0.0 { "\u{2212}" } else { "+" };
            let text = format!("{}{sign}{:.digits$}i", signed(re, digits), im.abs());
            Cell { text, value: Some(re), class: "" }
        }
        _ => Cell::number(value.as_f64().map(|x| x * scale), digits),
    }
}

fn of_modes(document: &Value, listed: &[(usize, &Track<'_>)]) -> String {
    let is_platform = document["kind"] == "platform";
    let variables = list(document, "joint_variables");
    let has_cases = list(document, "results").len() > 1;
    let has = |key: &str, test: fn(&Value) -> bool| listed.iter().any(|(_, track)| test(&track.source[key]));
    let is_path = is_path(document);
    let has_limits = has("within_limits", Value::is_boolean);
    let is_multiple = has("multiplicity", |value| value.as_u64().is_some_and(|m| m > 1));
    let mut heads: Vec<String> = Vec::new();
    if has_cases {
        heads.push(case_noun(document).to_owned());
    }
    heads.extend(["#".to_owned(), "proved".to_owned()]);
    heads.extend(is_path.then(|| "branch".to_owned()));
    if is_platform {
        heads.extend(["x [m]", "y [m]", "z [m]", "qw", "qx", "qy", "qz"].map(str::to_owned));
    } else {
        let unit = |variable: &Value| if variable["kind"] == "distance" { "m" } else { "\u{b0}" };
        heads.extend(variables.iter().map(|v| format!("{} [{}]", v["name"].as_str().unwrap_or_default(), unit(v))));
    }
    let placed = placed(document);
    heads.extend(placed.iter().flat_map(|body| ["x", "y", "z"].map(|axis| format!("{body} {axis} [m]"))));
    // Without any R or P joint the values of joints and the places may be the same in all modes.
    let turned = if list(&document["mechanism"], "joints").iter().any(is_placing) { &[] } else { placed.as_slice() };
    heads.extend(turned.iter().flat_map(|body| ["qw", "qx", "qy", "qz"].map(|part| format!("{body} {part}"))));
    // Linkages have none.
    let has_condition = has("condition", |value| !value.is_null()) || document["kind"] != "linkage";
    heads.extend(has_condition.then(|| "condition".to_owned()));
    heads.extend(has_limits.then(|| "limits".to_owned()));
    heads.extend(is_multiple.then(|| "times".to_owned()));
    let row = |(index, track): &(usize, &Track<'_>)| {
        let mode = track.source;
        let mut cells = Vec::new();
        if has_cases {
            cells.push(Cell::text(case_name(document, track.case)));
        }
        cells.push(Cell { text: track.name.clone(), value: track.name.parse().ok(), class: "id" });
        let is_near = mode["near"] == true;
        let sign = if is_near {
            "near"
        } else if mode["certified"] == true {
            "\u{2713}"
        } else {
            "\u{2013}"
        };
        cells.push(Cell {
            text: sign.to_owned(),
            value: Some(f64::from(u8::from(mode["certified"] == true))),
            class: "proved",
        });
        if is_path {
            cells.push(Cell::number(mode["branch"].as_f64(), 0));
        }
        if is_platform {
            let part = |key: &str, digits: usize| list(mode, key).iter().map(move |x| complex(x, 1.0, digits));
            cells.extend(part("position", 4));
            cells.extend(part("quaternion", 4));
        } else {
            let values = list(mode, "q").iter().zip(variables).map(|(x, variable)| {
                if variable["kind"] == "distance" { complex(x, 1.0, 4) } else { complex(x, 1f64.to_degrees(), 3) }
            });
            cells.extend(values);
        }
        for body in &placed {
            cells.extend(list(&mode["bodies"][*body], "position").iter().map(|x| complex(x, 1.0, 4)));
        }
        for body in turned {
            cells.extend(list(&mode["bodies"][*body], "quaternion").iter().map(|x| complex(x, 1.0, 4)));
        }
        // The nearest configuration has none.
        let is_nearest = track.kind == Kind::Nearest;
        let own = || if is_nearest { Cell::number(None, 0) } else { condition(&mode["condition"]) };
        cells.extend(has_condition.then(own));
        if has_limits {
            let word =
                mode["within_limits"].as_bool().map_or("", |is_within| if is_within { "within" } else { "outside" });
            cells.push(Cell::text(word));
        }
        if is_multiple {
            cells.push(Cell::text(mode["multiplicity"].as_u64().map_or_else(|| "?".to_owned(), |m| m.to_string())));
        }
        let class = if mode["real"] == false { " class=\"complex\"" } else { "" };
        (Some(*index), class.to_owned(), cells)
    };
    let rows: Vec<_> = listed.iter().map(row).collect();
    let noun = match listed {
        [(_, Track { kind: Kind::Nearest, source, .. })] => nearest(&source["error"]),
        _ if document["kind"] == "arm" => "Inverse-kinematics solutions".to_owned(),
        _ => "Assembly modes".to_owned(),
    };
    written(&noun, &heads, &rows)
}

/// Whether the value of a joint says where its second body is on its first one.
fn is_placing(joint: &Value) -> bool {
    joint["type"] == "R" || joint["type"] == "P"
}

/// The bodies of a linkage in space on which no R or P joint stands second: their places are listed, as in the text of `solve`.
fn placed(document: &Value) -> Vec<&str> {
    let mechanism = &document["mechanism"];
    if mechanism["space"] != "space" {
        return Vec::new();
    }
    let moved: Vec<&Value> =
        list(mechanism, "joints").iter().filter(|joint| is_placing(joint)).map(|joint| &joint["of"][1]).collect();
    let bodies = mechanism["bodies"].as_object().into_iter().flatten().map(|(name, _)| name.as_str());
    bodies.filter(|name| mechanism["ground"] != *name && !moved.iter().any(|own| *own == name)).collect()
}

/// The caption of the table of a pose that nothing reaches.
fn nearest(error: &Value) -> String {
    let part = |key: &str, scale: f64| three_digits(error[key].as_f64().unwrap_or(0.0) * scale);
    let (position, orientation) = (part("position", 1.0), part("orientation", 1f64.to_degrees()));
    format!("The nearest configuration found misses the pose by {position} m and {orientation}\u{b0}")
}

fn condition(value: &Value) -> Cell {
    let number = value.as_f64();
    let text = match number {
        Some(x) if x < 1e4 => format!("{x:.0}"),
        Some(x) => format!("{x:.0e}"),
        None => "\u{221e}".to_owned(),
    };
    Cell { text, value: Some(number.unwrap_or(f64::MAX)), class: "" }
}

/// Returns the noun for a case.
pub(super) fn case_noun(document: &Value) -> &'static str {
    match document["kind"].as_str() {
        Some("arm") => "pose",
        Some("loop" | "linkage") => "input",
        _ => "legs",
    }
}

/// The number of a case in its file.
pub(super) fn case_name(document: &Value, case: usize) -> String {
    list(document, "results").get(case).and_then(|result| result["case"].as_u64()).unwrap_or(0).to_string()
}

fn of_branches(document: &Value, listed: &[(usize, &Track<'_>)]) -> String {
    let (unit, digits) = if turns(document) { ("\u{b0}", 3) } else { ("m", 4) };
    let (from, to) = (format!("from [{unit}]"), format!("to [{unit}]"));
    let heads = ["branch", "circuit", &from, "begins", &to, "ends", "inputs"].map(str::to_owned);
    let row = |(index, track): &(usize, &Track<'_>)| {
        let branch = track.source;
        let cells = vec![
            Cell { text: track.name.clone(), value: track.name.parse().ok(), class: "id" },
            Cell::text(branch["circuit"].to_string()),
            Cell::number(Some(shown(document, &branch["from"])), digits),
            Cell::text(end(document, &branch["begins"])),
            Cell::number(Some(shown(document, &branch["to"])), digits),
            Cell::text(end(document, &branch["ends"])),
            Cell::number(Some(track.frames.len() as f64), 0),
        ];
        (Some(*index), String::new(), cells)
    };
    written("Branches", &heads, &listed.iter().map(row).collect::<Vec<_>>())
}

/// Describes an end of a branch.
fn end(document: &Value, end: &Value) -> String {
    match end["kind"].as_str() {
        Some("limit") => format!("limit {}", end["limit"]),
        Some("closed") if end["turns"] == 1 => "closed".to_owned(),
        Some("closed") => format!("closed after {} turns", end["turns"]),
        Some("range") => "end of range".to_owned(),
        Some("infinity") => format!("to infinity near {}", signed(shown(document, &end["near"]), 3)),
        Some("isolated") => "isolated".to_owned(),
        _ => "not resolved".to_owned(),
    }
}

fn of_vertices(document: &Value) -> String {
    let mechanism = &document["mechanism"];
    let heads = ["vertex", "x [m]", "y [m]", "z [m]"].map(str::to_owned);
    let rows = list(mechanism, "names").iter().zip(list(mechanism, "vertices")).map(|(name, vertex)| {
        let mut cells = vec![Cell { text: name.as_str().unwrap_or_default().to_owned(), value: None, class: "id" }];
        cells.extend(vertex.as_array().into_iter().flatten().map(|x| Cell::number(x.as_f64(), 4)));
        (None, String::new(), cells)
    });
    written("Vertices", &heads, &rows.collect::<Vec<_>>())
}
