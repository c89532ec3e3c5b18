//! Derivations of linkages as text and as JSON.

use super::document::units;
use super::export::{Head, Line, ROUNDED, export, plain_names, relations};
use super::json::number;
use super::linkage::{asked, joint_variables};
use super::model;
use super::number::counted;
use super::table::paragraph;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};
use crate::algebra::text::{Format, Names};
use crate::algebra::univariate::Univariate;
use crate::catalogue::{LinkageCase, LinkageFile};
use crate::derivation::{Curve, GroupPolynomial, LinkageDerivation, Symbol, in_cosines};
use crate::error::Result;
use crate::kinematics::linkage::{Accuracy, Gaussian, Linkage};
use rug::{Integer, Rational};
use serde_json::{Value, json};
use std::fmt::Write;

/// The text of a polynomial in these variables, or in v1, v2, ... where they are no names.
pub(super) fn written(polynomial: &Polynomial<Rational>, names: &[String]) -> String {
    let plain = || Names::given((1..=names.len()).map(|k| format!("v{k}")));
    Names::given(names)
        .or_else(|_| plain())
        .map_or_else(|_| String::new(), |names| Format::Text.polynomial(polynomial, &names))
}

pub(super) fn rational(polynomial: &Polynomial<Int>) -> Polynomial<Rational> {
    polynomial.map(|c| Some(Rational::from(c.to_integer()))).unwrap_or_else(Polynomial::zero)
}

pub(super) fn univariate(polynomial: &Univariate<Integer>) -> Polynomial<Rational> {
    let coefficients = polynomial.coefficients().iter().map(Rational::from).collect();
    Polynomial::from_univariate(0, &Univariate::new(coefficients))
}

/// What the letters of the unknowns stand for.
const LETTERS: &str = "c and s are the cosine and the sine of the angle of a body, d is the displacement of a joint over the length of its direction in the file";

/// The half-angle tangent of a body.
pub(super) fn tangent(file: &LinkageFile, body: usize) -> String {
    format!("t_{}", file.linkage.bodies[body].name)
}

/// The variables of an input and the angle of a body.
pub(super) fn pair(file: &LinkageFile, input: usize, body: usize) -> [String; 2] {
    let joint = &file.linkage.joints[input];
    let letter = if joint.is_prismatic() { 'd' } else { 't' };
    let input = format!("{letter}_{}", joint.name);
    let output = tangent(file, body);
    if input == output { ["s".to_owned(), "t".to_owned()] } else { [input, output] }
}

fn symbol(file: &LinkageFile, symbol: Symbol) -> String {
    let linkage = &file.linkage;
    match symbol {
        Symbol::Cosine(body) => format!("c_{}", linkage.bodies[body].name),
        Symbol::Sine(body) => format!("s_{}", linkage.bodies[body].name),
        Symbol::Shift(joint) => format!("d_{}", linkage.joints[joint].name),
    }
}

/// Returns the meaning of the variable of a polynomial.
fn meaning(file: &LinkageFile, polynomial: &GroupPolynomial) -> String {
    let [body, against] = [polynomial.body, polynomial.against].map(|body| &file.linkage.bodies[body].name);
    format!("{} is the tangent of half the angle of {body} against {against}", tangent(file, polynomial.body))
}

/// The verdict on one line.
#[must_use]
pub fn verdict(file: &LinkageFile, derivation: &LinkageDerivation) -> String {
    let Some(best) = derivation.polynomials.first() else { return "no closure polynomial".to_owned() };
    let degree = best.coefficients.degree().unwrap_or(0);
    let real = best.coefficients.real_roots().len();
    let at_pi =
        if best.at_pi > 0 { format!(", {} at the half turn", counted(best.at_pi, "root")) } else { String::new() };
    let proof = match best.assemblies {
        _ if best.is_proved() => "every root is one of an assembly (proved)".to_owned(),
        Some(known) => format!("of {known} assemblies: other roots belong to none"),
        None => "every assembly has its root, other roots are not excluded".to_owned(),
    };
    let name = tangent(file, best.body);
    format!("closure polynomial of degree {degree} in {name}, {}{at_pi}; {proof}", counted(real, "distinct real root"))
}

/// Describes the steps that lead to the polynomials.
fn steps(file: &LinkageFile, derivation: &LinkageDerivation) -> Vec<String> {
    let cycles = "Every cycle of bodies gives an equation in the rotations exp(i angle) and its conjugate.".to_owned();
    let (middle, last) = if derivation.gears.is_empty() {
        (
            "Cramer's rule on these makes a square matrix in the rotation of one body, singular at every assembly.",
            "the determinant of the matrix",
        )
    } else {
        (
            "Every pair of gears gives an equation between powers of rotations. In the ring of polynomials modulo all equations, whose \
             dimension is the number of assemblies, multiplication by a function has its values at the assemblies for eigenvalues.",
            "the determinant of t (1 + c) - s, with the matrices of multiplication by cosine c and sine s,",
        )
    };
    let mut steps = vec![cycles, middle.to_owned()];
    if let Some(best) = derivation.polynomials.first() {
        let rows = counted(best.rows, "row");
        let without = if derivation.gears.is_empty() { ", without factors 1 + t^2" } else { "" };
        steps.push(format!("The closure polynomial is {last} of {rows}{without}; {}.", meaning(file, best)));
    }
    steps
}

fn group_json(file: &LinkageFile, one: &GroupPolynomial) -> Value {
    let names = |body: usize| file.linkage.bodies[body].name.clone();
    json!({
        "group": one.group + 1,
        "body": names(one.body),
        "against": names(one.against),
        "variable": tangent(file, one.body),
        "coefficients": coefficients(&one.coefficients),
        "at_pi": one.at_pi,
        "assemblies": one.assemblies,
        "proved": one.is_proved(),
    })
}

pub(super) fn coefficients(polynomial: &Univariate<Integer>) -> Vec<String> {
    polynomial.coefficients().iter().map(ToString::to_string).collect()
}

/// Writes a closure polynomial and its roots into a document.
pub(super) fn insert_polynomial(
    document: &mut Value,
    variable: &str,
    polynomial: &Univariate<Integer>,
    at_pi: usize,
    proved: bool,
) {
    let roots = polynomial.real_roots();
    document["degree"] = json!(polynomial.degree().unwrap_or(0));
    document["real_roots"] = json!(roots.len());
    document["proved"] = json!(proved);
    document["at_pi"] = json!(at_pi);
    document["polynomial"] = json!({ "variable": variable, "coefficients": coefficients(polynomial) });
    document["roots"] = roots
        .into_iter()
        .map(|mut root| {
            let exact = root.exact().map(|q| q.to_string());
            json!({ "value": number(root.to_f64()), "exact": exact, "multiplicity": root.multiplicity() })
        })
        .collect();
    document["square_free"] = polynomial
        .square_free_decomposition()
        .iter()
        .map(|(factor, k)| json!({ "degree": factor.degree().unwrap_or(0), "multiplicity": k }))
        .collect();
}

/// The exponents of so many variables and the coefficient of every term.
pub(super) fn terms(polynomial: &Polynomial<Int>, variables: usize) -> Value {
    let term = |(exponents, c): (Vec<u32>, &Int)| -> Value {
        let exponent = |k: usize| json!(exponents.get(k).copied().unwrap_or(0));
        (0..variables).map(exponent).chain([json!(c.to_integer().to_string())]).collect()
    };
    polynomial.terms().map(term).collect()
}

/// How a relation with gears was found.
fn interpolated(count: usize, agrees: bool) -> String {
    let here =
        if agrees { "" } else { "; at the value of the input it is another polynomial than the closure polynomial" };
    format!(
        "interpolated from closure polynomials at values of the input, and equal to those at {count} other values, drawn at random \
         (probability of error below 2^-40){here}"
    )
}

/// The names of the variables of a relation in cosines and sines.
pub(super) fn circular(file: &LinkageFile, input: usize, body: usize) -> Vec<String> {
    let joint = &file.linkage.joints[input];
    let body = &file.linkage.bodies[body].name;
    let input = if joint.name == *body { "input" } else { joint.name.as_str() };
    let output = [format!("c_{body}"), format!("s_{body}")];
    let first = if joint.is_prismatic() {
        vec![format!("d_{input}")]
    } else {
        vec![format!("c_{input}"), format!("s_{input}")]
    };
    first.into_iter().chain(output).collect()
}

/// Returns the names of input and output, and of the joints that are held: `Input A and output rocker, E held`.
pub(super) fn ends(file: &LinkageFile, (input, body): (usize, usize), held: &[usize]) -> String {
    let joint = |joint: &usize| file.linkage.joints[*joint].name.clone();
    let held: Vec<String> = held.iter().map(joint).collect();
    let rest = if held.is_empty() { String::new() } else { format!(", {} held", held.join(", ")) };
    format!("Input {} and output {}{rest}", joint(&input), file.linkage.bodies[body].name)
}

/// Returns the heading of a relation in cosines and sines: that of a four-bar is Freudenstein's equation.
pub(super) fn heading(file: &LinkageFile, joints: usize, is_turn: bool) -> &'static str {
    let is_four_bar =
        joints == 4 && is_turn && file.linkage.joints.iter().all(|joint| !joint.is_prismatic() && !joint.is_gear());
    if is_four_bar { "In cosines and sines, Freudenstein's equation" } else { "In cosines and sines" }
}

/// The keys that every document of a linkage has.
pub(super) fn document(file: &LinkageFile, case: usize) -> Value {
    json!({
        "name": file.heading.name,
        "version": env!("CARGO_PKG_VERSION"),
        "units": units(),
        "joint_variables": joint_variables(file),
        "mechanism": model::linkage_json(file),
        "title": file.heading.title,
        "kind": "linkage",
        "case": case,
    })
}

/// Returns a document with the keys that every document of a linkage has; `case` is counted from 1.
#[must_use]
pub fn completed(file: &LinkageFile, case: usize, own: Value) -> Value {
    let mut document = document(file, case);
    if let (Value::Object(document), Value::Object(own)) = (&mut document, own) {
        document.extend(own);
    }
    document
}

/// The closure equations with their names.
fn cycles(file: &LinkageFile, derivation: &LinkageDerivation) -> Vec<(String, String)> {
    let names: Vec<String> = derivation.variables.iter().map(|one| symbol(file, *one)).collect();
    let texts = derivation.equations.iter().map(|equation| written(equation, &names));
    cycle_names(file, derivation).into_iter().zip(texts).collect()
}

/// The names of the closure equations.
fn cycle_names(file: &LinkageFile, derivation: &LinkageDerivation) -> Vec<String> {
    let cycles = derivation.equations.len().saturating_sub(2 * derivation.gears.len()) / 2;
    let names = (0..derivation.equations.len()).map(|k| {
        let half = if k % 2 == 0 { "x" } else { "y" };
        let of = match (k / 2).checked_sub(cycles) {
            None => format!("cycle {}", k / 2 + 1),
            Some(gear) => format!("gears {}", file.linkage.joints[derivation.gears[gear]].name),
        };
        format!("{of}, {half}")
    });
    names.collect()
}

/// The closure equations as a page, and the closure polynomial behind them.
pub(super) fn page(file: &LinkageFile, derivation: &LinkageDerivation) -> (String, Option<String>) {
    let mut text = format!("# {LETTERS}\n");
    for (name, equation) in cycles(file, derivation) {
        let _ = write!(text, "\n{name}\n  {equation}\n");
    }
    let last = derivation.polynomials.first().map(|best| {
        let name = tangent(file, best.body);
        let degree = best.coefficients.degree().unwrap_or(0);
        let further = if best.is_proved() { "" } else { ", with further roots" };
        let own = written(&univariate(&best.coefficients), std::slice::from_ref(&name));
        format!("\nclosure polynomial of degree {degree} in {name}{further}: {}\n  {own}\n", meaning(file, best))
    });
    (text, last)
}

/// The closure polynomial of a body whose angle the equations have, where there is one: a body may turn with another one, after which the angle
/// is named.
fn in_equations(derivation: &LinkageDerivation) -> Option<&GroupPolynomial> {
    let first = derivation.polynomials.first()?;
    let is_there = |one: &&GroupPolynomial| {
        let is_of_group = (one.group, one.against) == (first.group, first.against);
        is_of_group && derivation.variables.contains(&Symbol::Cosine(one.body))
    };
    derivation.polynomials.iter().find(is_there).or(Some(first))
}

/// The closure equations and the closure polynomial of a case, its number counted from 1, in the language of another program.
///
/// # Errors
/// Where the language has no way to say it.
pub fn system(file: &LinkageFile, number: usize, derivation: &LinkageDerivation, format: Format) -> Result<String> {
    let mut names: Vec<String> = derivation.variables.iter().map(|one| symbol(file, *one)).collect();
    let mut lines: Vec<Line> = cycle_names(file, derivation)
        .into_iter()
        .zip(&derivation.equations)
        .map(|(name, equation)| Line::new(format!("closure equation, {name}"), equation.clone()))
        .collect();
    let closing = in_equations(derivation).map(|best| {
        names.push(tangent(file, best.body));
        let degree = best.coefficients.degree().unwrap_or(0);
        let coefficients = Univariate::new(best.coefficients.coefficients().iter().map(Rational::from).collect());
        let is_there = derivation.variables.contains(&Symbol::Cosine(best.body));
        let alone = if is_there { "" } else { ", which turns with a body of the equations" };
        let last = format!("the closure polynomial, of degree {degree}: {}{alone}", meaning(file, best));
        Line::new(last, Polynomial::from_univariate(names.len() - 1, &coefficients))
    });
    let (plain, renamed) = plain_names(&names)?;
    lines.extend(closing);
    // The relations go by the letters of names. The closure polynomial stands last.
    let further = relations(&lines, &Names::given(&names).unwrap_or_else(|_| plain.clone()));
    let before = derivation.equations.len();
    lines.splice(before..before, further);
    let case = &file.cases[number - 1];
    let rounded = (file.accuracy(case) != Accuracy::Exact).then(|| ROUNDED.to_owned());
    let remarks =
        [asked(&file.linkage, &case.given), LETTERS.to_owned()].into_iter().chain(rounded).chain(renamed).collect();
    let source = file.heading.source.as_ref().map(|source| source.key.as_str());
    export(&Head { title: &file.heading.title, source, case: number, remarks }, &lines, &plain, format)
}

/// The derivation of a case, its number counted from 1, as one document.
#[must_use]
pub fn json(file: &LinkageFile, case: usize, derivation: &LinkageDerivation) -> Value {
    let mut document = document(file, case);
    let equations = cycles(file, derivation).into_iter().map(|(name, text)| json!({ "name": name, "text": text }));
    document["verdict"] = json!(verdict(file, derivation));
    document["equations"] = equations.collect();
    document["steps"] = json!(steps(file, derivation));
    document["warnings"] = json!(derivation.warnings);
    document["removed_factors"] = json!([]);
    document["groups"] = derivation
        .groups
        .iter()
        .map(|(bodies, count)| {
            let names =
                |bodies: &Vec<usize>| bodies.iter().map(|k| file.linkage.bodies[*k].name.clone()).collect::<Vec<_>>();
            json!({ "bodies": bodies.iter().map(names).collect::<Vec<_>>(), "count": count })
        })
        .collect();
    document["polynomials"] = derivation.polynomials.iter().map(|one| group_json(file, one)).collect();
    document["input_output"] = derivation.input_output.as_ref().map_or(Value::Null, |found| {
        let variables = pair(file, found.input, found.body);
        json!({
            "input": file.linkage.joints[found.input].name,
            "body": file.linkage.bodies[found.body].name,
            "against": file.linkage.bodies[found.against].name,
            "held": found.held.iter().map(|joint| &file.linkage.joints[*joint].name).collect::<Vec<_>>(),
            "variables": variables,
            "degrees": [found.polynomial.degree(0), found.polynomial.degree(1)],
            "polynomial": written(&rational(&found.polynomial), &variables),
            "terms": terms(&found.polynomial, 2),
            "cosines": in_cosines(&found.polynomial, found.is_turn)
                .map(|own| written(&rational(&own), &circular(file, found.input, found.body))),
            "agrees": found.agrees,
            "compared": found.compared,
        })
    });
    let best = derivation.polynomials.first();
    document["unknowns"] = best.iter().map(|best| tangent(file, best.body)).collect();
    document["degree"] = Value::Null;
    document["real_roots"] = Value::Null;
    document["polynomial"] = Value::Null;
    if let Some(best) = best {
        let variable = tangent(file, best.body);
        insert_polynomial(&mut document, &variable, &best.coefficients, best.at_pi, best.is_proved());
    }
    document
}

/// The derivation of a case for a reader.
#[must_use]
pub fn text(file: &LinkageFile, case: &LinkageCase, number: usize, derivation: &LinkageDerivation) -> String {
    let mut text = format!("{}, case {number}: {}\n", file.heading.title, asked(&file.linkage, &case.given));
    paragraph(&mut text, &verdict(file, derivation));
    if !derivation.equations.is_empty() {
        text.push_str("\nClosure equations (= 0)\n");
    }
    for (name, equation) in cycles(file, derivation) {
        let _ = writeln!(text, "{name}:\n  {equation}");
    }
    text.push_str("\nElimination\n");
    for step in steps(file, derivation) {
        paragraph(&mut text, &step);
    }
    for one in &derivation.polynomials {
        let variable = [tangent(file, one.body)];
        let proof = if one.is_proved() { "" } else { ", with further roots" };
        let _ = writeln!(text, "\nGroup {}, angle of {}{proof}", one.group + 1, file.linkage.bodies[one.body].name);
        let _ = writeln!(text, "  {}", written(&univariate(&one.coefficients), &variable));
    }
    if let Some(found) = &derivation.input_output {
        let variables = pair(file, found.input, found.body);
        let _ = writeln!(text, "\n{}", ends(file, (found.input, found.body), &found.held));
        let _ = writeln!(text, "  {}", written(&rational(&found.polynomial), &variables));
        if let Some(count) = found.compared {
            paragraph(&mut text, &interpolated(count, found.agrees));
        }
        if let Some(own) = in_cosines(&found.polynomial, found.is_turn) {
            let names = circular(file, found.input, found.body);
            let heading = heading(file, found.joints, found.is_turn);
            let _ = writeln!(text, "\n{heading}\n  {}", written(&rational(&own), &names));
        }
    }
    for warning in &derivation.warnings {
        paragraph(&mut text, &format!("warning: {warning}"));
    }
    text
}

/// Returns the number of times that the curve passes the circular points: the power of x^2 + y^2 in its highest terms.
fn circularity(curve: &Curve) -> usize {
    let highest = curve
        .polynomial
        .terms()
        .filter(|(exponents, _)| exponents.iter().map(|e| u64::from(*e)).sum::<u64>() == curve.degree());
    let mut form = Polynomial::from_terms(highest.map(|(exponents, c)| (exponents, c.clone())));
    let [x, y] = [0, 1].map(Polynomial::<Int>::variable);
    let circle = x.mul(&x).add(&y.mul(&y));
    let mut power = 0;
    while let Some(quotient) = form.checked_div_exact(&circle).filter(|_| !form.is_zero()) {
        form = quotient;
        power += 1;
    }
    power
}

pub(super) const COORDINATES: [&str; 2] = ["x", "y"];

/// The verdict on a curve.
#[must_use]
pub fn curve_verdict(of: &str, curve: &Curve) -> String {
    let own = format!("curve of {of}: a polynomial of degree {} with {} terms", curve.degree(), curve.polynomial.len());
    curve.compared.map_or(own.clone(), |count| format!("{own}; {}", sections(count, "lines")))
}

/// How an interpolated curve was compared.
pub(super) fn sections(count: usize, with: &str) -> String {
    format!(
        "interpolated, and equal to the sections of the linkage with {count} {with}, drawn at random (probability of error below 2^-40)"
    )
}

fn bodies(file: &LinkageFile, curve: &Curve) -> Vec<String> {
    curve.bodies.iter().map(|body| file.linkage.bodies[*body].name.clone()).collect()
}

/// The curve of a point as one document.
#[must_use]
pub fn curve_json(file: &LinkageFile, case: usize, body: &str, point: &str, curve: &Curve) -> Value {
    let mut document = document(file, case);
    let names = COORDINATES.map(str::to_owned);
    let factors = curve.factors.iter().map(|(degree, k)| json!({ "degree": degree, "multiplicity": k }));
    document["verdict"] = json!(curve_verdict(&format!("{body}.{point}"), curve));
    for key in ["unknowns", "equations", "steps", "warnings"] {
        document[key] = json!([]);
    }
    for key in ["degree", "real_roots", "polynomial"] {
        document[key] = Value::Null;
    }
    let removed = curve.removed.iter().map(|(factor, power)| {
        let reason = "only the joint of the ground is real on it, and a rotation is zero or infinite elsewhere";
        json!({ "factor": written(&rational(factor), &names), "multiplicity": power, "reason": reason })
    });
    document["removed_factors"] = removed.collect();
    document["trace"] = json!({
        "body": body,
        "point": point,
        "degree": curve.degree(),
        "circularity": circularity(curve),
        "polynomial": written(&rational(&curve.polynomial), &names),
        "terms": terms(&curve.polynomial, 2),
        "bodies": bodies(file, curve),
        "rows": curve.rows,
        "square_free": factors.collect::<Value>(),
        "compared": curve.compared,
    });
    document
}

/// The curve of a point for a reader.
#[must_use]
pub fn curve_text(file: &LinkageFile, of: &str, curve: &Curve) -> String {
    let mut text = format!("{}\n", file.heading.title);
    paragraph(&mut text, &curve_verdict(of, curve));
    let bodies = bodies(file, curve).join(", ");
    let how = if curve.compared.is_some() {
        format!(
            "the equations of cycles and gears of {bodies} have {} with the point on a line, complex ones included, with multiplicity; the \
             powers of y there have a relation, and that is interpolated in a linear form of x and y",
            counted(curve.rows, "solution")
        )
    } else {
        format!(
            "the determinant of {} rows from the cycles of {bodies} vanishes at every place of the point",
            curve.rows
        )
    };
    paragraph(
        &mut text,
        &format!("{how}; x^2 + y^2 divides the highest terms {}", counted(circularity(curve), "time")),
    );
    let names = COORDINATES.map(str::to_owned);
    for (factor, power) in &curve.removed {
        let times = if *power > 1 { format!(", {power} times") } else { String::new() };
        let factor = written(&rational(factor), &names);
        paragraph(&mut text, &format!("divided out: {factor}{times}, on which a rotation is zero or infinite"));
    }
    let _ = writeln!(text, "\n{} = 0", written(&rational(&curve.polynomial), &names));
    text
}

/// A point as a file has it.
fn place(z: &Gaussian) -> String {
    let one = |x: &Rational| if x.is_integer() { x.to_string() } else { format!("\"{x}\"") };
    format!("[{}, {}]", one(&z.re), one(&z.im))
}

/// A cognate as a mechanism file.
fn file_of(title: &str, linkage: &Linkage) -> String {
    let mut text = format!(
        "title = {}\n\n[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"frame\"\njoints = \"shared points\"\n\n\
         [mechanism.bodies]\n",
        json!(title)
    );
    for body in &linkage.bodies {
        let points: Vec<String> = body.points.iter().map(|(name, at)| format!("{name} = {}", place(at))).collect();
        let _ = writeln!(text, "{} = {{ {} }}", body.name, points.join(", "));
    }
    text + "\n[[input]]\njoint = \"A\"\ntan_half = 0\n"
}

fn titled<'a>(file: &LinkageFile, found: &'a [Linkage]) -> Vec<(String, &'a Linkage)> {
    (1..).zip(found).map(|(k, own)| (format!("Cognate {k} of {}", file.heading.title), own)).collect()
}

/// The cognates of a four-bar, with the curve of all, as one document.
#[must_use]
pub fn cognates_json(
    file: &LinkageFile,
    case: usize,
    (of, curve): (&str, &Curve),
    found: &[Linkage],
    equal: &[bool],
) -> Value {
    let (body, point) = of.split_once('.').unwrap_or((of, ""));
    let mut document = curve_json(file, case, body, point, curve);
    let list = titled(file, found)
        .into_iter()
        .zip(equal)
        .map(|((title, own), is_equal)| json!({ "file": file_of(&title, own), "same_polynomial": is_equal }));
    document["cognates"] = list.collect();
    document
}

/// The cognates of a four-bar, with the curve of all, for a reader.
#[must_use]
pub fn cognates_text(file: &LinkageFile, (of, curve): (&str, &Curve), found: &[Linkage], equal: &[bool]) -> String {
    let mut text = curve_text(file, of, curve);
    for ((title, own), is_equal) in titled(file, found).into_iter().zip(equal) {
        let words = if *is_equal {
            "the curve of coupler.P has the same polynomial"
        } else {
            "polynomials differ: one is reducible"
        };
        let _ = write!(text, "\n# {words}\n{}", file_of(&title, own));
    }
    text
}
