//! Relations of input and output of linkages with symbols, as text and as JSON.

use super::linkage_derivation::{circular, document, ends, heading, pair, rational, tangent, terms, written};
use super::number::counted;
use super::table::paragraph;
use crate::catalogue::LinkageFile;
use crate::derivation::{Coordinate, LinkageSymbolic, in_cosines};
use serde_json::{Value, json};
use std::fmt::Write;

/// The variables of the polynomial.
fn variables(file: &LinkageFile, found: &LinkageSymbolic) -> Vec<String> {
    let own = pair(file, found.input, found.body);
    own.into_iter().chain(found.symbols.iter().map(|one| one.variable(&file.linkage))).collect()
}

/// The relation in cosines and sines, if it has the degrees of a dyad.
fn cosines(file: &LinkageFile, found: &LinkageSymbolic) -> Option<String> {
    let own = in_cosines(&found.polynomial, found.is_turn)?;
    let symbols = found.symbols.iter().map(|one| one.variable(&file.linkage));
    let names: Vec<String> = circular(file, found.input, found.body).into_iter().chain(symbols).collect();
    Some(written(&rational(&own), &names))
}

fn steps(found: &LinkageSymbolic) -> Vec<String> {
    vec![
        "The relation of input and output is derived at values of the symbols: a determinant by Cramer's rule on the cycles of bodies."
            .to_owned(),
        format!(
            "Those at different values are known up to a factor; the factors are a solution of linear equations, and the coefficients \
             are interpolated modulo 256 primes. The result equals the relations derived at {} other values, drawn at random.",
            found.compared
        ),
    ]
}

/// `degree 2 in t_A and 2 in t_r, 21 terms in 4 symbols; equal to ...`
#[must_use]
pub fn verdict(file: &LinkageFile, found: &LinkageSymbolic) -> String {
    let [input, output] = pair(file, found.input, found.body);
    format!(
        "degree {} in {input} and {} in {output}, {} in {}; equal to the relations derived at {} other values, drawn at random \
         (probability of error below 2^-40)",
        found.polynomial.degree(0),
        found.polynomial.degree(1),
        counted(found.polynomial.len(), "term"),
        counted(found.symbols.len(), "symbol"),
        found.compared
    )
}

/// The relation for a reader.
#[must_use]
pub fn text(file: &LinkageFile, found: &LinkageSymbolic) -> String {
    let linkage = &file.linkage;
    let mut text = format!("{}\n", file.heading.title);
    paragraph(&mut text, &verdict(file, found));
    text.push_str("\nSymbols: coordinates of points in their bodies\n");
    for one in &found.symbols {
        let _ = writeln!(text, "  {} = {}, in the file {}", one.variable(linkage), one.name(linkage), one.value);
    }
    if !found.numbers.is_empty() {
        let list: Vec<String> =
            found.numbers.iter().map(|one| format!("{} = {}", one.name(linkage), one.value)).collect();
        paragraph(&mut text, &format!("numbers of the file: {}", list.join(", ")));
    }
    text.push_str("\nElimination\n");
    for step in steps(found) {
        paragraph(&mut text, &step);
    }
    let [body, against] = [found.body, found.against].map(|body| &linkage.bodies[body].name);
    let output = tangent(file, found.body);
    paragraph(&mut text, &format!("{output} is the tangent of half the angle of {body} against {against}."));
    let _ = writeln!(text, "\n{}", ends(file, (found.input, found.body), &found.held));
    let _ = writeln!(text, "  {}", written(&rational(&found.polynomial), &variables(file, found)));
    if let Some(own) = cosines(file, found) {
        let _ = writeln!(text, "\n{}\n  {own}", heading(file, found.joints.len(), found.is_turn));
    }
    text
}

/// The relation as one document.
#[must_use]
pub fn json(file: &LinkageFile, case: usize, found: &LinkageSymbolic) -> Value {
    let linkage = &file.linkage;
    let mut document = document(file, case);
    let name = |one: &Coordinate| one.name(linkage);
    let names = variables(file, found);
    document["verdict"] = json!(verdict(file, found));
    for key in ["equations", "warnings", "removed_factors"] {
        document[key] = json!([]);
    }
    for key in ["degree", "real_roots", "polynomial"] {
        document[key] = Value::Null;
    }
    document["unknowns"] = json!([tangent(file, found.body)]);
    document["steps"] = json!(steps(found));
    document["proved"] = json!(false);
    document["symbols"] = found.symbols.iter().map(name).collect();
    document["numbers"] = found.numbers.iter().map(|one| format!("{} = {}", name(one), one.value)).collect();
    document["terms"] = json!(found.polynomial.len());
    document["input_output"] = json!({
        "input": linkage.joints[found.input].name,
        "body": linkage.bodies[found.body].name,
        "against": linkage.bodies[found.against].name,
        "held": found.held.iter().map(|joint| &linkage.joints[*joint].name).collect::<Vec<_>>(),
        "variables": names,
        "degrees": (0..names.len()).map(|k| found.polynomial.degree(k)).collect::<Vec<u32>>(),
        "polynomial": written(&rational(&found.polynomial), &names),
        "terms": terms(&found.polynomial, names.len()),
        "cosines": cosines(file, found),
        "agrees": found.agrees,
    });
    document
}
