//! The dyads of a synthesis as text and JSON.

pub mod defects;
pub mod linkage;
pub mod picture;

use super::document::units;
use super::json::number;
use super::model;
use super::number::{at_most, digits};
use super::table::{Columns, paragraph};
use crate::algebra::number::nearest_f64;
use crate::catalogue::{SynthesisFile, Task};
use crate::synthesis::{Answer, Dyad, Mode, Part, Pole, poles};
use crate::verdict::Proof;
use num_complex::Complex;
use rug::Rational;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// Most poles that are printed as text: those of five positions.
const MOST_POLES: usize = 10;

/// The verdict in a line.
#[must_use]
pub fn verdict(file: &SynthesisFile, answer: &Answer) -> String {
    let verdict = &answer.verdict;
    let what = match &file.task {
        Task::Motion(..) => "dyads",
        Task::Function(_) => "four-bars",
        Task::Path(_) => "four-bars with their cognates",
    };
    let found = if verdict.self_motion > 0 {
        format!("a family of {what} of dimension {}", verdict.self_motion)
    } else {
        format!("{} complex {what}, {} real", verdict.complex, verdict.real)
    };
    format!("{}: {found}; proof: {}; {}", verdict.status.word(), verdict.proof.word(), verdict.reason)
}

/// Whether a mode is listed.
fn is_shown(mode: &Mode, complex: bool) -> bool {
    mode.is_real || complex
}

/// Verdict, dyads, families and curves.
#[must_use]
pub fn text(file: &SynthesisFile, answer: &Answer, complex: bool) -> String {
    let mut text = String::new();
    paragraph(&mut text, &verdict(file, answer));
    for warning in &answer.warnings {
        paragraph(&mut text, &format!("note: {warning}"));
    }
    let shown: Vec<(usize, &Mode)> = (1..).zip(&answer.modes).filter(|(_, mode)| is_shown(mode, complex)).collect();
    if let Some((_, first)) = shown.first() {
        // Both cognates of a four-bar would make a table too wide to be read: the document has them.
        let columns = |mode: &Mode| -> Vec<Part> {
            mode.dyad.parts.iter().filter(|part| !part.name.starts_with("cognate")).cloned().collect()
        };
        let columns_of_first = columns(first);
        let names: Vec<&str> = columns_of_first.iter().map(|part| part.name).collect();
        let header = [
            &[if matches!(file.task, Task::Motion(..)) { "dyad" } else { "four-bar" }][..],
            &names,
            &["multiplicity", "radius"],
        ]
        .concat();
        let mut table = Columns::new(&header, &[]);
        for (id, mode) in &shown {
            let mut row = vec![id.to_string()];
            row.extend(columns(mode).iter().map(|part| written(part, mode.is_real)));
            row.extend([mode.multiplicity.to_string(), at_most(mode.dyad.radius)]);
            table.row(row);
        }
        let _ = write!(text, "\n{}", table.text());
    }
    for family in &answer.families {
        if let Some(sample) = &family.sample {
            let parts: Vec<String> =
                sample.parts.iter().map(|part| format!("{} {}", part.name, written(part, true))).collect();
            text.push('\n');
            paragraph(&mut text, &format!("one member of the family: {}", parts.join(", ")));
        }
    }
    for curve in &answer.curves {
        text.push('\n');
        paragraph(&mut text, &format!("curve of {} (degree {}): {} = 0", curve.name, curve.degree, curve.polynomial()));
    }
    text + &pole_table(&poles(file))
}

/// A table of poles; empty where there are none, or more than can be taken in at a glance.
fn pole_table(poles: &[Pole]) -> String {
    if poles.is_empty() || poles.len() > MOST_POLES {
        return String::new();
    }
    let mut table = Columns::new(&["pole of positions", "in the ground", "in the body"], &[]);
    for pole in poles {
        let [i, j] = pole.positions.map(|k| k + 1);
        let place = |[x, y]: &[Rational; 2]| format!("({}, {})", digits(nearest_f64(x)), digits(nearest_f64(y)));
        table.row([format!("{i}, {j}"), place(&pole.fixed), place(&pole.moving)]);
    }
    format!("\n{}", table.text())
}

fn written(part: &Part, is_real: bool) -> String {
    let one = |z: &Complex<f64>| {
        if is_real {
            digits(z.re)
        } else {
            format!("{} {} {}i", digits(z.re), if z.im < 0.0 { "-" } else { "+" }, digits(z.im.abs()))
        }
    };
    let values: Vec<String> = part.values.iter().map(one).collect();
    if part.is_scalar { values.join("") } else { format!("({})", values.join(", ")) }
}

/// The numbers of a dyad: `fixed.direction` stands in a table `fixed`.
fn numbers(dyad: &Dyad, is_real: bool) -> Value {
    let one = |z: &Complex<f64>| if is_real { number(z.re) } else { json!([number(z.re), number(z.im)]) };
    let mut object = Map::new();
    for part in &dyad.parts {
        let value = match part.values.as_slice() {
            [z] if part.is_scalar => one(z),
            values => values.iter().map(one).collect(),
        };
        match part.name.split_once('.') {
            Some((table, key)) => {
                let inner = object.entry(table).or_insert_with(|| json!({}));
                inner[key] = value;
            }
            None => {
                object.insert(part.name.into(), value);
            }
        }
    }
    Value::Object(object)
}

/// Everything as JSON.
#[must_use]
pub fn json(file: &SynthesisFile, answer: &Answer, complex: bool) -> Value {
    let verdict = &answer.verdict;
    let key = if matches!(file.task, Task::Motion(..)) { "dyad" } else { "linkage" };
    let mode = |(id, mode): (usize, &Mode)| {
        json!({
            "id": id,
            "real": mode.is_real,
            "multiplicity": mode.multiplicity,
            "certified": mode.is_certified(),
            "radius": number(mode.dyad.radius),
            key: numbers(&mode.dyad, mode.is_real),
        })
    };
    let modes = (1..).zip(&answer.modes).filter(|(_, mode)| is_shown(mode, complex)).map(mode);
    let families = answer.families.iter().map(|family| {
        let sample = family.sample.as_ref().map(|sample| json!({ key: numbers(sample, true) }));
        json!({ "dimension": family.dimension, "sample": sample })
    });
    let curves = answer.curves.iter().map(
        |curve| json!({ "of": curve.of, "name": curve.name, "degree": curve.degree, "polynomial": curve.polynomial() }),
    );
    let poles = poles(file).into_iter().map(|pole| {
        let place = |point: &[Rational; 2]| -> Value { point.iter().map(|c| number(nearest_f64(c))).collect() };
        json!({ "positions": pole.positions.map(|k| k + 1), "fixed": place(&pole.fixed), "moving": place(&pole.moving) })
    });
    let mut document = json!({
        "title": file.heading.title,
        "kind": "synthesis",
        "name": file.heading.name,
        "version": env!("CARGO_PKG_VERSION"),
        "units": units(),
        "mechanism": model::synthesis_json(file),
        "results": [{
            "case": 1,
            "verdict": {
                "status": verdict.status.word(),
                "proof": verdict.proof.word(),
                "code": verdict.code.word(),
                "complex_complete": verdict.complex_complete,
                "complex": verdict.complex_complete.then_some(verdict.complex),
                "real": verdict.real,
                "at_infinity": verdict.at_infinity,
                "self_motion": verdict.self_motion,
                "certified": verdict.certified,
                "reason": verdict.reason,
            },
            "degrees": answer.degrees,
            "modes": modes.collect::<Vec<_>>(),
            "families": families.collect::<Vec<_>>(),
            "curves": curves.collect::<Vec<_>>(),
            "poles": poles.collect::<Vec<_>>(),
            "warnings": answer.warnings,
        }],
    });
    if let Proof::Probable { error, seed } = verdict.proof {
        document["seed"] = json!(seed);
        let verdict = &mut document["results"][0]["verdict"];
        (verdict["probability_of_error"], verdict["seed"]) = (number(error), json!(seed));
    }
    document
}
