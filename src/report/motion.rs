//! Rational motions: factorisations, the loops of two of them, the loop as a mechanism file.

use super::json::number;
use super::number::{counted, short};
use super::table::{Columns, paragraph};
use crate::catalogue::MotionFile;
use crate::factoring::{Factored, Loop};
use crate::kinematics::screw_system::Screw;
use rug::Rational;
use serde_json::{Value, json};
use std::fmt::Write;

/// `moves, proved: 6R loop of factorisations 1 and 2, mobility 1, screw rank 5`
#[must_use]
pub fn verdict(factored: &Factored, closed: Option<&Loop>) -> String {
    let count = counted(factored.factorisations(), "factorisation");
    match (factored, closed) {
        (Factored::Exact(_), Some(closed)) => {
            let (i, j) = closed.pair;
            let name = closed.bennett.as_ref().map_or("", |_| " (Bennett)");
            let (least, most) = closed.mobility();
            let mobility = if least == most { least.to_string() } else { format!("{least} to {most}") };
            format!(
                "{count} over the rationals; {} and {} close a {} loop{name}, mobile: mobility {mobility}, screw rank {}; proof: proved",
                i + 1,
                j + 1,
                closed.letters,
                closed.order
            )
        }
        (Factored::Exact(_), None) => format!("{count} over the rationals; no two of them close a loop"),
        (Factored::Float(found), _) => format!(
            "{count} in f64, exact to {:.0e}: the quadratic factors of the norm are not rational; proof: none",
            found.defect.max(f64::EPSILON)
        ),
        (Factored::None(reason), _) => format!("not factored: {reason}"),
    }
}

/// Verdict, factors, the loop and its links.
#[must_use]
pub fn text(factored: &Factored, closed: Option<&Loop>) -> String {
    let mut text = verdict(factored, closed) + "\n";
    let rows = factored.rows();
    if rows.is_empty() {
        return text;
    }
    let _ = writeln!(text, "\nquadratic factors of the norm");
    for (k, quadratic) in factored.quadratics().iter().enumerate() {
        let _ = writeln!(text, "  M{} = {quadratic}", k + 1);
    }
    let mut table = Columns::new(
        &["factorisation", "factor", "norm", "scalar", "direction", "moment"],
        &["factor", "norm", "scalar", "direction", "moment"],
    );
    for (k, (order, factors)) in rows.iter().enumerate() {
        for (i, parts) in factors.iter().enumerate() {
            let triple = |at: usize| parts[at..at + 3].join(", ");
            table.row([
                if i == 0 { (k + 1).to_string() } else { String::new() },
                format!("t - h{}", i + 1),
                format!("M{}", order[i] + 1),
                parts[0].clone(),
                triple(1),
                triple(5),
            ]);
        }
    }
    let _ = write!(text, "\n{}", table.text());
    if let Some(closed) = closed {
        text.push('\n');
        let (i, j) = closed.pair;
        let words = format!(
            "loop of factorisations {} and {}: the joints of {} in their order, then those of {} backwards; {}",
            i + 1,
            j + 1,
            i + 1,
            j + 1,
            closed.system
        );
        paragraph(&mut text, &words);
        if let Some(ratio) = &closed.bennett {
            paragraph(
                &mut text,
                &format!("Bennett's isogram, verified exactly: (a / sin alpha)^2 = {ratio} of all links, no offsets"),
            );
        }
        if let Some(links) = &closed.parameters {
            let mut table = Columns::new(&["joint", "a", "alpha [deg]", "d", "theta at t = inf [deg]"], &[]);
            for (k, link) in links.iter().enumerate() {
                let degrees = |x: f64| short(x.to_degrees(), 6);
                table.row([
                    (k + 1).to_string(),
                    short(link.a, 9),
                    degrees(link.alpha),
                    short(link.d, 9),
                    degrees(link.theta),
                ]);
            }
            let _ = write!(text, "\n{}", table.text());
        }
        let _ = writeln!(text, "\n--toml prints this loop as a mechanism file");
    }
    text
}

fn vector(v: &[Rational; 3]) -> String {
    let entry = |x: &Rational| if x.is_integer() { x.to_string() } else { format!("\"{x}\"") };
    format!("[{}]", v.iter().map(entry).collect::<Vec<_>>().join(", "))
}

/// The loop as a mechanism file: its joints by their axes at t = infinity, where all joint variables are 0.
#[must_use]
pub fn toml(file: &MotionFile, closed: &Loop) -> String {
    let title = file.heading.title.replace('\\', "\\\\").replace('"', "\\\"");
    let (i, j) = closed.pair;
    let mut text = format!("title = \"{} loop of: {title}\"\n", closed.letters);
    let _ = writeln!(text, "notes = \"Factorisations {} and {} of a motion polynomial.\"", i + 1, j + 1);
    text += "\n[mechanism]\nkind = \"loop\"\nconvention = \"screws\"\njoints = [\n";
    for (screw, prismatic) in &closed.axes {
        let (kind, axis) = if *prismatic { ("P", &screw.moment) } else { ("R", &screw.direction) };
        let point = screw.foot().unwrap_or_else(|| std::array::from_fn(|_| Rational::new()));
        let _ = writeln!(text, "    {{ type = \"{kind}\", axis = {}, point = {} }},", vector(axis), vector(&point));
    }
    text + "]\n"
}

/// Everything as JSON.
#[must_use]
pub fn json(file: &MotionFile, factored: &Factored, closed: Option<&Loop>) -> Value {
    let rows = factored.rows();
    let factor = |parts: &[String; 8]| json!({ "scalar": parts[0], "direction": parts[1..4], "moment": parts[5..8] });
    let list: Vec<Value> = rows
        .iter()
        .map(|(order, factors)| {
            json!({
                "norms": order.iter().map(|k| k + 1).collect::<Vec<_>>(),
                "factors": factors.iter().map(factor).collect::<Vec<_>>(),
            })
        })
        .collect();
    let text = |screw: &Screw<Rational>| {
        let part = |v: &[Rational; 3]| v.each_ref().map(ToString::to_string);
        json!({ "direction": part(&screw.direction), "moment": part(&screw.moment) })
    };
    let reason = verdict(factored, closed);
    let closed = closed.map(|closed| {
        let links = closed.parameters.as_ref().map(|links| {
            let one = |link: &crate::kinematics::motion_polynomial::LinkParameters| {
                json!({ "a": number(link.a), "alpha": number(link.alpha), "d": number(link.d), "theta": number(link.theta) })
            };
            links.iter().map(one).collect::<Vec<_>>()
        });
        let (least, most) = closed.mobility();
        json!({
            "pair": [closed.pair.0 + 1, closed.pair.1 + 1],
            "joints": closed.letters,
            "mobility": if least == most { json!(least) } else { json!([least, most]) },
            "screw_rank": closed.order,
            "system": closed.system,
            "proof": "proved",
            "bennett_ratio_squared": closed.bennett.as_ref().map(ToString::to_string),
            "axes": closed.axes.iter().map(|(screw, _)| text(screw)).collect::<Vec<_>>(),
            "dh": links,
        })
    });
    json!({
        "title": file.heading.title,
        "kind": "motion",
        "exact": matches!(factored, Factored::Exact(_)),
        "norm_factors": factored.quadratics(),
        "factorisations": list,
        "loop": closed,
        "reason": reason,
    })
}
