//! Synthesis files in normalised form.

use super::{labels, origin};
use crate::catalogue::{AnglePair, SynthesisFile, Task};
use crate::report::number::counted;
use crate::report::table::Columns;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// `RR dyad, 5 positions`, `four-bar, 3 pairs`.
pub(super) fn short(file: &SynthesisFile) -> String {
    match &file.task {
        Task::Motion(dyad, positions) => format!("{} dyad, {}", dyad.word(), counted(positions.len(), "position")),
        Task::Function(pairs) => format!("four-bar, {}", counted(pairs.len(), "pair")),
        Task::Path(points) => format!("four-bar, {}", counted(points.len(), "point")),
    }
}

pub(super) fn identity(file: &SynthesisFile) -> Map<String, Value> {
    let heading = &file.heading;
    labels(&heading.name, &heading.title, "synthesis", &short(file), heading.source.as_ref())
}

/// The positions as a table.
pub(super) fn text(file: &SynthesisFile) -> String {
    let mut text = format!("{}\n{}, {}\n", file.heading.title, short(file), file.space.word());
    origin(&mut text, file.heading.source.as_ref(), file.heading.notes.as_deref());
    let mut table = match &file.task {
        Task::Motion(..) => Columns::new(&["position", "rotation, by rows", "translation"], &["position"]),
        Task::Function(_) => {
            Columns::new(&["pair", "cos, sin of the input", "cos, sin of the output", "ratio of the rates"], &["pair"])
        }
        Task::Path(_) => Columns::new(&["point", "x, y"], &["point"]),
    };
    match &file.task {
        Task::Motion(_, positions) => {
            for (k, motion) in positions.iter().enumerate() {
                let row = |row: &[rug::Rational; 3]| row.each_ref().map(ToString::to_string).join(", ");
                table.row([
                    (k + 1).to_string(),
                    motion.rotation.each_ref().map(row).join("; "),
                    row(&motion.translation),
                ]);
            }
        }
        Task::Function(pairs) => {
            for (k, pair) in pairs.iter().enumerate() {
                let [input, output] = pair.angles.each_ref().map(|(cos, sin)| format!("{cos}, {sin}"));
                let ratio = pair.ratio.as_ref().map_or(String::new(), ToString::to_string);
                table.row([(k + 1).to_string(), input, output, ratio]);
            }
        }
        Task::Path(points) => {
            for (k, [x, y]) in points.iter().enumerate() {
                table.row([(k + 1).to_string(), format!("{x}, {y}")]);
            }
        }
    }
    let _ = writeln!(text, "\n{}", table.text());
    let count = |claim: Option<usize>| claim.map(|count| count.to_string());
    text + &super::claims([
        ("complex", count(file.expected.complex)),
        ("real", count(file.expected.real)),
        ("dimension", count(file.expected.dimension)),
    ])
}

/// The positions as exact numbers, lengths in metres.
#[must_use]
pub fn json(file: &SynthesisFile) -> Value {
    let mut object = identity(file);
    super::remarks(&mut object, file.heading.source.as_ref(), file.heading.notes.as_deref());
    object.insert("space".into(), json!(file.space.word()));
    match &file.task {
        Task::Motion(dyad, positions) => {
            object.insert("task".into(), json!("motion"));
            object.insert("dyad".into(), json!(dyad.word()));
            let position = |motion: &crate::kinematics::motion::Motion<rug::Rational>| {
                json!({
                    "rotation": motion.rotation.each_ref().map(|row| row.each_ref().map(ToString::to_string)),
                    "translation": motion.translation.each_ref().map(ToString::to_string),
                })
            };
            object.insert("positions".into(), positions.iter().map(position).collect());
        }
        Task::Function(pairs) => {
            object.insert("task".into(), json!("function"));
            let angle = |(cos, sin): &(rug::Rational, rug::Rational)| json!([cos.to_string(), sin.to_string()]);
            let pair = |pair: &AnglePair| {
                let [input, output] = &pair.angles;
                let ratio = pair.ratio.as_ref().map(ToString::to_string);
                json!({ "input": angle(input), "output": angle(output), "ratio": ratio })
            };
            object.insert("pairs".into(), pairs.iter().map(pair).collect());
        }
        Task::Path(points) => {
            object.insert("task".into(), json!("path"));
            let point = |point: &[rug::Rational; 2]| json!(point.each_ref().map(ToString::to_string));
            object.insert("points".into(), points.iter().map(point).collect());
        }
    }
    let claims = json!({
        "complex": file.expected.complex,
        "real": file.expected.real,
        "dimension": file.expected.dimension,
    });
    object.insert("expected".into(), claims);
    Value::Object(object)
}
