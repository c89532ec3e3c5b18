//! Conditions of mobility: the verdict first, then the families and the steps of the proof; as text, JSON and Markdown.

use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::text::{Format, Names};
use crate::catalogue::ansatz::Ansatz;
use crate::conditions::decide::{Class, Decision, Family};
use crate::conditions::examples::{Example, examples, first, value_at};
use crate::conditions::four_bar::FourBar;
use crate::conditions::step::{factored, plain, product, rational};
use crate::error::{Error, Result};
use crate::verdict::Proof;
use rug::Rational;
use serde_json::{Value, json};
use std::fmt::Write;

/// Whether all joints of a family move.
fn moves(family: &Family) -> bool {
    family.class != Class::Coincident
}

fn class(class: Class) -> &'static str {
    match class {
        Class::Bennett => "bennett",
        Class::Spherical => "spherical",
        Class::Planar => "planar",
        Class::Coincident => "coincident axes",
    }
}

/// Whether the answer is about rounded numbers.
fn is_rounded(ansatz: &Ansatz, decision: &Decision) -> bool {
    ansatz.rounded && decision.field.is_none()
}

/// Returns the proof of the answer. Rounded numbers may satisfy or break an equality that the true ones do not.
#[must_use]
pub fn proof(theorem: &FourBar, ansatz: &Ansatz, decision: &Decision) -> Proof {
    if !theorem.is_proved() || decision.confirmed == Some(false) {
        return Proof::None;
    }
    Proof::Proved.of_rounded(is_rounded(ansatz, decision))
}

/// `moves as Bennett (+), Bennett (-), spherical, planar, and in no other way: proved, 11 of 11 steps`
#[must_use]
pub fn verdict(theorem: &FourBar, ansatz: &Ansatz, decision: &Decision) -> String {
    let held = theorem.steps.iter().filter(|step| step.holds).count();
    let total = theorem.steps.len();
    let proof = match (theorem.is_proved(), decision.confirmed) {
        _ if proof(theorem, ansatz, decision) == Proof::RoundedData => {
            format!("NOT proved: this holds for the rounded numbers of the file, {held} of {total} steps")
        }
        (true, Some(false)) => "NOT proved: the linear conditions at the numbers disagree".to_owned(),
        (true, Some(true)) => format!("proved, {held} of {total} steps, and by the linear conditions at the numbers"),
        (true, None) => {
            let field = decision.field.map_or_else(String::new, |degree| {
                format!(", the numbers of the file taken as elements of a number field of degree {degree}")
            });
            format!("proved, {held} of {total} steps{field}")
        }
        (false, _) => format!("NOT proved, {held} of {total} steps"),
    };
    if let Some(reason) = ansatz.empty() {
        return format!("no real mechanism: the real solution set is empty, {reason}");
    }
    let names = |wanted: bool| -> Vec<&str> {
        let mut names: Vec<&str> = decision
            .families
            .iter()
            .filter(|family| moves(family) == wanted)
            .map(|family| family.name.split(':').next().unwrap_or_default())
            .collect();
        names.dedup();
        names
    };
    let (moving, degenerate) = (names(true), names(false));
    let rest = if degenerate.is_empty() { "" } else { " (besides loops with coincident axes)" };
    match (decision.is_numeric, moving.is_empty()) {
        (true, true) if degenerate.is_empty() => format!("does not move ({proof})"),
        (true, true) => format!("moves at most where {}: degenerate ({proof})", degenerate.join(" or ")),
        (true, false) => format!("moves: {} ({proof})", moving.join(", ")),
        (false, true) => format!("no real values of the symbols for which all joints move{rest} ({proof})"),
        (false, false) => format!("moves as {} and in no other way{rest} ({proof})", moving.join(", ")),
    }
}

/// The assumption that the list makes on the twists.
fn assumption(decision: &Decision) -> Option<String> {
    if decision.oblique.is_empty() || decision.is_numeric {
        return None;
    }
    let links: Vec<String> = decision.oblique.iter().map(ToString::to_string).collect();
    Some(format!(
        "Bennett and spherical loops, and opposite axes that coincide, are listed for twists of links {} that are no multiples of pi.",
        links.join(", ")
    ))
}

/// Everything for a reader.
#[must_use]
pub fn text(theorem: &FourBar, ansatz: &Ansatz, decision: &Decision) -> String {
    let mut text = verdict(theorem, ansatz, decision) + "\n";
    if ansatz.empty().is_some() {
        return text;
    }
    if let Some(assumption) = assumption(decision) {
        let _ = writeln!(text, "{assumption}");
    }
    if !decision.names.list().is_empty() {
        let _ = writeln!(text, "Half-angle tangents of twists: t1 = tan(alpha1/2), tan_half_beta = tan(beta/2).");
    }
    text.push_str("\nConditions (each = 0)\n");
    for (index, family) in decision.families.iter().enumerate() {
        let same = |other: &&Family| other.name == family.name;
        if decision.families[..index].iter().any(|other| same(&other)) {
            continue;
        }
        let _ = writeln!(text, "{}", family.name);
        if family.conditions.is_empty() {
            text.push_str("  none: always\n");
        }
        for condition in &family.conditions {
            let _ = writeln!(text, "  {}", in_factors(condition, &decision.names));
        }
        if let Some(note) = &family.note {
            let _ = writeln!(text, "  ({note})");
        }
        if let Some(example) = library(family, decision) {
            let _ = writeln!(text, "  in the library: {example}");
        }
        let more = decision.families.iter().filter(same).count() - 1;
        if more > 0 {
            let _ = writeln!(
                text,
                "  (and {more} more choices of signs, for other orientations of the axes or special twists: --json)"
            );
        }
    }
    text.push_str("\nProof\n");
    for (number, step) in (1..).zip(&theorem.steps) {
        let mark = if step.holds { "checked" } else { "FAILED" };
        let _ = writeln!(text, "{number}. {} [{mark}]. {}", step.title, step.text);
        for formula in &step.formulas {
            let _ = writeln!(text, "     {} = {}", formula.name, formula.value);
        }
    }
    if is_rounded(ansatz, decision) {
        text.push_str(ROUNDED);
    }
    text
}

/// Returns a loop of the library that belongs to a family, where all parameters are symbols.
fn library(family: &Family, decision: &Decision) -> Option<String> {
    if decision.is_numeric || !moves(family) || family.conditions.is_empty() {
        return None;
    }
    let contains = |own: &Example| {
        let values: Option<Vec<Rational>> = decision.names.list().iter().map(|name| own.parameter(name)).collect();
        values.is_some_and(|values| family.conditions.iter().all(|one| value_at(one, &values) == 0))
    };
    first(&examples(4), &contains)
}

const ROUNDED: &str = "\nwarning: numbers of the file without rational value or half-angle tangent are replaced by rationals nearby \
                       (--digits): everything here is exact for those\n";

fn in_factors(condition: &Polynomial<Int>, names: &Names) -> String {
    product(&factored(condition, &[]), names)
}

/// The document that equations/conditions.schema.json describes.
#[must_use]
pub fn json(theorem: &FourBar, ansatz: &Ansatz, decision: &Decision) -> Value {
    let names = &decision.names;
    let condition = |condition: &Polynomial<Int>| {
        let factors: Vec<Value> = factored(condition, &[])
            .iter()
            .map(|(factor, power)| json!({ "text": plain(factor, names), "multiplicity": power }))
            .collect();
        json!({ "text": plain(condition, names), "factors": factors })
    };
    let families: Vec<Value> = decision
        .families
        .iter()
        .map(|family| {
            json!({
                "class": class(family.class),
                "name": family.name,
                "degenerate": !moves(family),
                "library": library(family, decision),
                "conditions": family.conditions.iter().map(condition).collect::<Vec<_>>(),
                "note": family.note,
            })
        })
        .collect();
    let steps: Vec<Value> = theorem
        .steps
        .iter()
        .map(|step| {
            let formulas = step.formulas.iter().map(|f| json!({ "name": f.name, "value": f.value }));
            json!({
                "title": step.title, "text": step.text, "holds": step.holds, "formulas": formulas.collect::<Vec<_>>(),
            })
        })
        .collect();
    json!({
        "title": ansatz.title,
        "joints": ansatz.joints.len(),
        "verdict": verdict(theorem, ansatz, decision),
        "proved": proof(theorem, ansatz, decision).is_proved(),
        "proof": proof(theorem, ansatz, decision).word(),
        "complete": true,
        "symbols": names.list(),
        "oblique_links": decision.oblique,
        "families": families,
        "empty": ansatz.empty(),
        "steps": steps,
        "rounded": is_rounded(ansatz, decision),
        "field_degree": decision.field,
    })
}

/// The conditions of one family in the language of another program; without a name, of the first one.
///
/// # Errors
/// Where there is no such family, or the language has no way to say it.
pub fn system(decision: &Decision, family: Option<&str>, format: Format) -> Result<String> {
    let found = match family {
        None => decision.families.first(),
        Some(wanted) => {
            decision.families.iter().find(|family| family.name.to_lowercase().contains(&wanted.to_lowercase()))
        }
    };
    let Some(found) = found else {
        let names: Vec<&str> = decision.families.iter().map(|family| family.name.as_str()).collect();
        return Err(Error::Invalid(format!(
            "found no family `{}`, expected a part of one of: {}",
            family.unwrap_or("first"),
            names.join("; ")
        )));
    };
    Ok(format.system(&found.conditions.iter().map(rational).collect::<Vec<_>>(), &decision.names)?)
}

/// The derivation as Markdown with formulas in LaTeX.
///
/// # Errors
/// Never for derivations of this crate.
pub fn markdown(theorem: &FourBar, ansatz: &Ansatz, decision: &Decision) -> Result<String> {
    let mut text = format!("# {}\n\n{}.\n", ansatz.title, verdict(theorem, ansatz, decision));
    if let Some(assumption) = assumption(decision) {
        let _ = writeln!(text, "\n{assumption}");
    }
    text.push_str("\n## Conditions\n");
    for family in &decision.families {
        let _ = writeln!(text, "\n### {}\n", family.name);
        if family.conditions.is_empty() {
            text.push_str("No further condition.\n");
        } else {
            let polynomials: Vec<_> = family.conditions.iter().map(rational).collect();
            let lines = Format::Latex.system(&polynomials, &decision.names)?.replace("align*", "aligned");
            let _ = writeln!(text, "All of these vanish:\n\n$$\n{lines}$$");
        }
        if let Some(note) = &family.note {
            let _ = writeln!(text, "\n`{note}`");
        }
    }
    text.push_str("\n## Proof\n");
    for (number, step) in (1..).zip(&theorem.steps) {
        let mark = if step.holds { "checked" } else { "FAILED" };
        let _ = writeln!(text, "\n{number}. **{}** ({mark}). {}", step.title, step.text);
        for formula in &step.formulas {
            let _ = writeln!(text, "   - `{} = {}`", formula.name, formula.value);
        }
    }
    if is_rounded(ansatz, decision) {
        let _ = write!(text, "\n> {}", ROUNDED.trim_start());
    }
    Ok(text)
}
