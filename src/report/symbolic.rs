//! Derivations with symbols, as text and JSON.

use super::derivation::{head, unknowns};
use super::export::{Line, export, relations};
use super::json::kind;
use super::number::counted;
use super::paper::{Paper, Style};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::text::{Format, Names};
use crate::catalogue::entry::Entry;
use crate::derivation::{Quotient, Substitution, Symbolic};
use crate::error::Result;
use rug::Rational;
use serde_json::{Value, json};
use std::fmt::Write;

/// `degree 2 in t3, 20 terms in 8 symbols; at the numbers of the file equal to the closure polynomial derived from them`
#[must_use]
pub fn verdict(symbolic: &Symbolic) -> String {
    let symbols = counted(symbolic.symbols.len(), "symbol");
    let what = match &symbolic.polynomial {
        Some(polynomial) => {
            let expanded = &polynomial.displayed.polynomial;
            let name = &symbolic.names.list()[polynomial.variable];
            format!("degree {} in {name}, {}", expanded.degree(polynomial.variable), counted(expanded.len(), "term"))
        }
        None => counted(symbolic.equations.len(), "equation"),
    };
    let certainty = if symbolic.proved { "" } else { " (probability of error below 2^-40)" };
    format!("{what} in {symbols}; {}{certainty}", symbolic.compared)
}

fn plain(polynomial: &Polynomial<Rational>, names: &Names) -> String {
    Format::Text.polynomial(polynomial, names)
}

/// `d1 = -(...)/(...)`
fn quotient(quotient: &Quotient, names: &Names) -> String {
    let [above, below] = [&quotient.numerator, &quotient.denominator].map(|p| plain(p, names));
    format!("{} = ({above})/({below})", names.list()[quotient.variable])
}

/// Everything for a reader, large polynomials by names for their coefficients.
#[must_use]
pub fn text(symbolic: &Symbolic) -> String {
    let names = &symbolic.names;
    let mut text = verdict(symbolic)
        + "\n\nSymbols (c and s: cosine and sine; ca, sa: those of alpha; t, ta: half-angle tangents)\n";
    let _ = writeln!(text, "  {}", symbolic.symbols.join(", "));
    if !symbolic.numbers.is_empty() {
        let _ = writeln!(text, "  numbers of the file: {}", symbolic.numbers.join(", "));
    }
    if !symbolic.equations.is_empty() {
        text.push_str("\nClosure equations (= 0)\n");
    }
    for equation in &symbolic.equations {
        let terms = counted(equation.polynomial.len(), "term");
        let _ = writeln!(text, "{}, {terms}:\n  {}", equation.name, plain(&equation.compact, names));
    }
    text.push_str("\nElimination\n");
    for (number, step) in (1..).zip(&symbolic.steps) {
        let _ = writeln!(text, "{number}. {step}");
    }
    if let Some(polynomial) = &symbolic.polynomial {
        let displayed = &polynomial.displayed;
        let _ = writeln!(text, "\nClosure polynomial, {} expanded", counted(displayed.polynomial.len(), "term"));
        let compact = plain(&displayed.compact, names);
        if compact.len() <= TWO_PAGES {
            let _ = writeln!(text, "  {compact}");
        } else {
            let _ = writeln!(text, "  {}, too long for this page: --json", counted(displayed.compact.len(), "term"));
        }
        let _ = writeln!(text, "  its coefficients, without the names: --json, --format text and others");
    }
    if !symbolic.translations.is_empty() {
        text.push_str("\nTranslations\n");
    }
    for translation in &symbolic.translations {
        let _ = writeln!(text, "  {}", quotient(translation, names));
    }
    let shown: Vec<_> = symbolic.parts.iter().filter(|(_, part)| part.len() <= MOST_TERMS).collect();
    if !shown.is_empty() {
        text.push_str("\nwhere\n");
    }
    for (name, part) in shown {
        let _ = writeln!(text, "  {name} = {}", plain(part, names));
    }
    let long = symbolic.parts.iter().filter(|(_, part)| part.len() > MOST_TERMS);
    for (name, part) in long {
        let _ = writeln!(text, "  {name}: {}, in --json and --format", counted(part.len(), "term"));
    }
    text
}

/// Longer polynomials are not for readers.
const MOST_TERMS: usize = 120;

/// Two pages of characters: as much of a closure polynomial over names is for readers.
const TWO_PAGES: usize = 8000;

/// The document that equations/derivation.schema.json describes; `case` is the number of the case in the file.
#[must_use]
pub fn json(entry: &Entry, case: usize, symbolic: &Symbolic) -> Value {
    let names = &symbolic.names;
    let text = |polynomial: &Polynomial<Rational>| plain(polynomial, names);
    let equations = symbolic.equations.iter().map(|equation| {
        json!({ "name": equation.name, "text": text(&equation.polynomial), "compact": text(&equation.compact) })
    });
    let translations = symbolic.translations.iter().map(|one| {
        let name = &names.list()[one.variable];
        json!({ "variable": name, "numerator": text(&one.numerator), "denominator": text(&one.denominator) })
    });
    let mut document = json!({
        "title": entry.title,
        "kind": kind(entry.kind()),
        "case": case,
        "verdict": verdict(symbolic),
        "symbols": symbolic.symbols,
        "numbers": symbolic.numbers,
        "unknowns": [],
        "degree": null,
        "real_roots": null,
        "polynomial": null,
        "removed_factors": [],
        "equations": equations.collect::<Vec<_>>(),
        "where": symbolic.parts.iter().map(|(name, part)| json!({ "name": name, "text": text(part) })).collect::<Vec<_>>(),
        "translations": translations.collect::<Vec<_>>(),
        "steps": symbolic.steps,
        "warnings": [],
    });
    if let Some(polynomial) = &symbolic.polynomial {
        let (name, expanded) = (&names.list()[polynomial.variable], &polynomial.displayed.polynomial);
        let coefficients: Vec<String> = expanded.coefficients_in(polynomial.variable).iter().map(text).collect();
        document["unknowns"] = json!([name]);
        document["degree"] = json!(expanded.degree(polynomial.variable));
        document["terms"] = json!(expanded.len());
        document["proved"] = json!(symbolic.proved);
        document["polynomial"] = json!({
            "variable": name,
            "coefficients": coefficients,
            "compact": text(&polynomial.displayed.compact),
        });
    }
    document
}

/// The closure polynomial, the closure equations, the translations, and the relations between cosines, sines and half-angle tangents, in the
/// language of another program.
///
/// # Errors
/// Where the language has no way to say it.
pub fn system(entry: &Entry, case: usize, symbolic: &Symbolic, format: Format) -> Result<String> {
    let names = &symbolic.names;
    let mut lines: Vec<Line> = Vec::new();
    if let Some(polynomial) = &symbolic.polynomial {
        let (name, expanded) = (&names.list()[polynomial.variable], &polynomial.displayed.polynomial);
        let degree = expanded.degree(polynomial.variable);
        let symbols = symbolic.symbols.join(", ");
        let meaning = format!("the closure polynomial, of degree {degree} in {name}, with the symbols {symbols}");
        lines.push(Line::new(meaning, expanded.clone()));
    }
    for equation in &symbolic.equations {
        if lines.iter().all(|line| line.polynomial != equation.polynomial) {
            lines.push(Line::new(format!("closure equation, {}", equation.name), equation.polynomial.clone()));
        }
    }
    for one in &symbolic.translations {
        let name = &names.list()[one.variable];
        let polynomial = Polynomial::variable(one.variable).mul(&one.denominator).sub(&one.numerator);
        lines.push(Line::new(format!("the translation {name}, a quotient"), polynomial));
    }
    let relations = relations(&lines, names);
    lines.extend(relations);
    export(&head(entry, case), &lines, names, format)
}

/// The derivation as a paper, every displayed equation one of those that were used, and what came of putting solutions
/// with the numbers of the file into them.
#[must_use]
pub fn paper(entry: &Entry, case: usize, symbolic: &Symbolic, found: &Substitution, style: Style) -> String {
    let names = &symbolic.names;
    let summary = format!("{}, case {case}, with symbols: {}.", kind(entry.kind()), verdict(symbolic));
    let mut paper = Paper::new(style, names, &entry.title, &summary);
    paper.heading("Unknowns and symbols");
    unknowns(&mut paper, entry.kind());
    paper.typeset_paragraph("Cosine and sine of the twist $\\alpha_k$ are $c_{\\alpha_k}$ and $s_{\\alpha_k}$.");
    paper.sentence(&format!("Symbols: {}.", symbolic.symbols.join(", ")));
    if !symbolic.numbers.is_empty() {
        paper.sentence(&format!("Numbers of the file: {}.", symbolic.numbers.join(", ")));
    }
    if !symbolic.equations.is_empty() {
        paper.heading("Closure equations");
    }
    for equation in &symbolic.equations {
        paper.label(&format!("{}, {} expanded", equation.name, counted(equation.polynomial.len(), "term")));
        paper.equation(&equation.compact);
    }
    let mut long = Vec::new();
    if !symbolic.parts.is_empty() {
        paper.sentence("with");
    }
    for (name, part) in &symbolic.parts {
        if part.len() <= MOST_TERMS {
            paper.definition(name, part);
        } else {
            long.push(format!("{name}: {}", counted(part.len(), "term")));
        }
    }
    if !long.is_empty() {
        paper.sentence("Too long for a page, in --json and --format:");
        paper.bullets(&long);
    }
    paper.heading("Elimination");
    paper.numbered(&symbolic.steps);
    if let Some(polynomial) = &symbolic.polynomial {
        let displayed = &polynomial.displayed;
        let name = &names.list()[polynomial.variable];
        let degree = displayed.polynomial.degree(polynomial.variable);
        paper.heading("Closure polynomial");
        let terms = counted(displayed.polynomial.len(), "term");
        if plain(&displayed.compact, names).len() <= TWO_PAGES {
            paper.sentence(&format!("Degree {degree} in {name}, {terms} expanded:"));
            paper.equation(&displayed.compact);
        } else {
            let compact = counted(displayed.compact.len(), "term");
            paper.sentence(&format!(
                "Degree {degree} in {name}, {terms} expanded and {compact} in the names above: too long for a page, in --json and --format."
            ));
        }
    }
    if !symbolic.translations.is_empty() {
        paper.heading("Translations");
    }
    for translation in &symbolic.translations {
        paper.quotient(translation.variable, [&translation.numerator, &translation.denominator]);
    }
    paper.check(found);
    paper.finish()
}
