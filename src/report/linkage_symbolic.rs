//! Relations of input and output of linkages with symbols, as text and as JSON.

use super::linkage_derivation::{
    COORDINATES, circular, document, ends, heading, pair, rational, tangent, terms, written,
};
use super::number::counted;
use super::table::paragraph;
use crate::catalogue::LinkageFile;
use crate::derivation::{Coordinate, CurveSymbolic, LinkageSymbolic, in_cosines};
use crate::kinematics::linkage::LinkageJoint;
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

fn steps(file: &LinkageFile, found: &LinkageSymbolic) -> Vec<String> {
    let Some(compared) = found.compared else {
        return vec![
            "The third moving link keeps its length: the squared distance of the ends of the two others is a constant."
                .to_owned(),
        ];
    };
    let derived = if file.linkage.joints.iter().any(LinkageJoint::is_gear) {
        "The closure polynomial is derived at values of the input and of the symbols: a characteristic polynomial in the ring of polynomials \
         modulo the equations of cycles and gears."
    } else {
        "The relation of input and output is derived at values of the symbols: a determinant by Cramer's rule on the cycles of bodies."
    };
    vec![
        derived.to_owned(),
        format!(
            "Those at different values are known up to a factor; the factors are a solution of linear equations, and the coefficients \
             are interpolated modulo 256 primes. The result equals the relations derived at {compared} other values, drawn at random."
        ),
    ]
}

/// `degree 2 in t_A and 2 in t_r, 21 terms in 4 symbols; derived with ...`
#[must_use]
pub fn verdict(file: &LinkageFile, found: &LinkageSymbolic) -> String {
    let [input, output] = pair(file, found.input, found.body);
    let how = found.compared.map_or_else(
        || "derived with the symbols; the relation of the numbers of the file divides it there".to_owned(),
        |count| {
            format!("equal to the relations derived at {count} other values, drawn at random (probability of error below 2^-40)")
        },
    );
    format!(
        "degree {} in {input} and {} in {output}, {}{}; {how}",
        found.polynomial.degree(0),
        found.polynomial.degree(1),
        counted(found.polynomial.len(), "term"),
        if found.symbols.is_empty() {
            String::new()
        } else {
            format!(" in {}", counted(found.symbols.len(), "symbol"))
        },
    )
}

/// Writes what the symbols are, and which coordinates keep their numbers.
fn symbols(text: &mut String, file: &LinkageFile, symbols: &[Coordinate], numbers: &[Coordinate]) {
    let linkage = &file.linkage;
    text.push_str(if symbols.is_empty() { "\n" } else { "\nSymbols: coordinates of points in their bodies\n" });
    for one in symbols {
        let _ = writeln!(text, "  {} = {}, in the file {}", one.variable(linkage), one.name(linkage), one.value);
    }
    if !numbers.is_empty() {
        let list: Vec<String> = numbers.iter().map(|one| format!("{} = {}", one.name(linkage), one.value)).collect();
        paragraph(text, &format!("numbers of the file: {}", list.join(", ")));
    }
}

/// The relation for a reader.
#[must_use]
pub fn text(file: &LinkageFile, found: &LinkageSymbolic) -> String {
    let linkage = &file.linkage;
    let mut text = format!("{}\n", file.heading.title);
    paragraph(&mut text, &verdict(file, found));
    symbols(&mut text, file, &found.symbols, &found.numbers);
    text.push_str("\nElimination\n");
    for step in steps(file, found) {
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
    document["steps"] = json!(steps(file, found));
    document["proved"] = json!(found.compared.is_none() && file.exact);
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

/// `curve of k.P: degree 6 in x and y, 239 terms in 6 symbols; ...`
#[must_use]
pub fn curve_verdict(of: &str, found: &CurveSymbolic) -> String {
    let how = match (found.compared, found.agrees) {
        (None, true) => "derived with the symbols; the curve of the numbers of the file divides it there".to_owned(),
        (None, false) => {
            "derived with the symbols, and not compared at the numbers of the file, which are special".to_owned()
        }
        (Some(count), _) => format!(
            "equal to the curves derived at {count} other values, drawn at random (probability of error below 2^-40)"
        ),
    };
    format!(
        "curve of {of}: degree {} in x and y, {} in {}; {how}",
        found.degree(),
        counted(found.polynomial.len(), "term"),
        counted(found.symbols.len(), "symbol")
    )
}

fn curve_steps(found: &CurveSymbolic) -> Vec<String> {
    let step = match found.compared {
        None => {
            "The ends of the coupler satisfy two equations l_k = a_k c + b_k s in cosine and sine of its rotation, one for the length of the crank or the line of the slide at each. Cramer's rule and c^2 + s^2 = 1 give (l_1 b_2 - l_2 b_1)^2 + (a_1 l_2 - a_2 l_1)^2 - (a_1 b_2 - a_2 b_1)^2, which vanishes at every place of the point."
        }
        Some(_) => {
            "The curve is derived at values of the symbols: a determinant by Cramer's rule on the cycles of bodies. Its coefficients are interpolated modulo 256 primes."
        }
    };
    vec![step.to_owned()]
}

fn curve_variables(file: &LinkageFile, found: &CurveSymbolic) -> Vec<String> {
    COORDINATES
        .map(str::to_owned)
        .into_iter()
        .chain(found.symbols.iter().map(|one| one.variable(&file.linkage)))
        .collect()
}

/// The curve for a reader.
#[must_use]
pub fn curve_text(file: &LinkageFile, of: &str, found: &CurveSymbolic) -> String {
    let mut text = format!("{}\n", file.heading.title);
    paragraph(&mut text, &curve_verdict(of, found));
    symbols(&mut text, file, &found.symbols, &found.numbers);
    text.push_str("\nElimination\n");
    for step in curve_steps(found) {
        paragraph(&mut text, &step);
    }
    let _ = writeln!(text, "\n{} = 0", written(&rational(&found.polynomial), &curve_variables(file, found)));
    text
}

/// The curve as one document.
#[must_use]
pub fn curve_json(file: &LinkageFile, case: usize, (body, point): (&str, &str), found: &CurveSymbolic) -> Value {
    let mut document = document(file, case);
    let name = |one: &Coordinate| one.name(&file.linkage);
    let names = curve_variables(file, found);
    document["verdict"] = json!(curve_verdict(&format!("{body}.{point}"), found));
    for key in ["unknowns", "equations", "warnings", "removed_factors"] {
        document[key] = json!([]);
    }
    for key in ["degree", "real_roots", "polynomial"] {
        document[key] = Value::Null;
    }
    document["steps"] = json!(curve_steps(found));
    document["proved"] = json!(found.compared.is_none() && file.exact);
    document["symbols"] = found.symbols.iter().map(name).collect();
    document["numbers"] = found.numbers.iter().map(|one| format!("{} = {}", name(one), one.value)).collect();
    document["trace"] = json!({
        "body": body,
        "point": point,
        "degree": found.degree(),
        "variables": names,
        "polynomial": written(&rational(&found.polynomial), &names),
        "terms": terms(&found.polynomial, names.len()),
        "agrees": found.agrees,
    });
    document
}
