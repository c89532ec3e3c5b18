//! Closure polynomials of linkages in space and on the sphere as text and as JSON.

use super::export::{Head, Line, ROUNDED, export, plain_names};
use super::linkage_derivation::{coefficients, insert_polynomial, rational, univariate, written};
use super::number::counted;
use super::table::paragraph;
use super::{space, sphere};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::text::Format;
use crate::algebra::univariate::Univariate;
use crate::catalogue::{Heading, SpaceFile, SphereFile};
use crate::derivation::{RingDerivation, RingPolynomial, RingSymbolic, Unknown};
use crate::error::Result;
use crate::linkage::space::Symbol;
use rug::Rational;
use serde_json::{Value, json};
use std::fmt::Write;

/// Longest equation of a text, in characters: all of it is in the JSON.
const LONGEST: usize = 600;

/// A case of a linkage, as far as its derivation names it.
pub struct Named<'f> {
    /// Title and case in one line.
    heading: String,
    file: &'f Heading,
    number: usize,
    asked: String,
    /// The name of every joint and those of its bodies.
    joints: Vec<[&'f str; 3]>,
    /// Whether the value of a joint is a distance.
    distances: Vec<bool>,
    bodies: Vec<&'f str>,
    /// Whether numbers of the file or the input were rounded.
    is_rounded: bool,
    complete: Box<dyn Fn(Value) -> Value + 'f>,
}

impl<'f> Named<'f> {
    /// Returns a case of a linkage in space, counted from 1.
    #[must_use]
    pub fn in_space(file: &'f SpaceFile, number: usize) -> Self {
        let (linkage, case) = (&file.linkage, &file.cases[number - 1]);
        let bodies: Vec<&str> = linkage.bodies.iter().map(|body| body.name.as_str()).collect();
        Self {
            heading: format!("{}, case {number}: {}", file.heading.title, space::asked(file, &case.given)),
            file: &file.heading,
            number,
            asked: space::asked(file, &case.given),
            joints: linkage.joints.iter().map(|one| [&*one.name, bodies[one.of[0]], bodies[one.of[1]]]).collect(),
            distances: linkage.joints.iter().map(|one| one.is_distance() == Some(true)).collect(),
            bodies,
            is_rounded: !(file.exact && case.exact),
            complete: Box::new(move |own| space::completed(file, number, own)),
        }
    }

    /// Returns a case of a linkage on the sphere, counted from 1.
    #[must_use]
    pub fn on_sphere(file: &'f SphereFile, number: usize) -> Self {
        let (linkage, case) = (&file.linkage, &file.cases[number - 1]);
        let bodies: Vec<&str> = linkage.bodies.iter().map(|body| body.name.as_str()).collect();
        Self {
            heading: format!("{}, case {number}: {}", file.heading.title, sphere::asked(file, &case.given)),
            file: &file.heading,
            number,
            asked: sphere::asked(file, &case.given),
            joints: linkage.joints.iter().map(|one| [&*one.name, bodies[one.of[0]], bodies[one.of[1]]]).collect(),
            distances: vec![false; linkage.joints.len()],
            bodies,
            is_rounded: !(file.exact && case.exact),
            complete: Box::new(move |own| sphere::completed(file, number, own)),
        }
    }

    /// Returns what stands above a system.
    fn head(&self) -> Head<'f> {
        let source = self.file.source.as_ref().map(|source| source.key.as_str());
        Head { title: &self.file.title, source, case: self.number, remarks: vec![self.asked.clone()] }
    }

    /// Returns title and case in one line.
    pub(super) fn title(&self) -> &str {
        &self.heading
    }

    /// Returns what was derived as a document with title, source and case.
    pub(super) fn completed(&self, own: Value) -> Value {
        (self.complete)(own)
    }

    /// Returns the name of a variable: `t_A`, `d_P`, `x_plate`.
    #[must_use]
    pub fn variable(&self, unknown: Unknown) -> String {
        match unknown {
            Unknown::HalfTangent { joint, .. } => format!("t_{}", self.joints[joint][0]),
            Unknown::Distance { joint, .. } => format!("d_{}", self.joints[joint][0]),
            Unknown::Position { body, axis, .. } => format!("{}_{}", AXES[axis], self.bodies[body]),
            Unknown::Rotation { body, at: [i, j], .. } => format!("r{}{}_{}", i + 1, j + 1, self.bodies[body]),
            Unknown::Axis { joint, axis, .. } => format!("{}_{}", AXES[axis], self.joints[joint][0]),
        }
    }

    /// Returns the meaning of a variable, a sentence without its end.
    fn meaning(&self, unknown: Unknown) -> String {
        let name = self.variable(unknown);
        let over = |over: bool| if over { ", over the length of its axis" } else { "" };
        match unknown {
            Unknown::HalfTangent { joint, over: is_over } => {
                let [joint, one, two] = self.joints[joint];
                format!("{name} is the tangent of half the angle of {joint}, of {two} against {one}{}", over(is_over))
            }
            Unknown::Distance { joint, over: is_over } => {
                let [joint, one, two] = self.joints[joint];
                format!("{name} is the displacement of {joint} in metres, of {two} against {one}{}", over(is_over))
            }
            Unknown::Position { body, against, axis } => {
                let [body, against] = [body, against].map(|body| self.bodies[body]);
                format!("{name} is the coordinate {} of the origin of {body} against {against} in metres", AXES[axis])
            }
            Unknown::Rotation { body, against, at: [i, j] } => {
                let [body, against] = [body, against].map(|body| self.bodies[body]);
                let place = format!("row {} and column {}", i + 1, j + 1);
                format!("{name} is the entry of {place} of the rotation matrix of {body} against {against}")
            }
            Unknown::Axis { joint, axis, rest } => {
                let [axis, joint, rest] = [AXES[axis], self.joints[joint][0], self.bodies[rest]];
                format!("{name} is the coordinate {axis} of the axis of {joint} in those of {rest}")
            }
        }
    }

    /// Returns the body that the variable is about, and that against which it is measured.
    fn ends(&self, unknown: Unknown) -> [&str; 2] {
        match unknown {
            Unknown::HalfTangent { joint, .. } | Unknown::Distance { joint, .. } => {
                [self.joints[joint][2], self.joints[joint][1]]
            }
            Unknown::Position { body, against, .. } | Unknown::Rotation { body, against, .. } => {
                [self.bodies[body], self.bodies[against]]
            }
            Unknown::Axis { joint, rest, .. } => [self.joints[joint][2], self.bodies[rest]],
        }
    }

    fn symbol(&self, symbol: Symbol) -> String {
        let joint = |joint: usize| self.joints[joint][0];
        match symbol {
            Symbol::Cosine(own) => format!("c_{}", joint(own)),
            Symbol::Sine(own) => format!("s_{}", joint(own)),
            Symbol::Shift(own) => format!("d_{}", joint(own)),
            Symbol::Direction(body, number, axis) => {
                format!("{}_{}_{}", ["u", "v"][number.min(1)], self.bodies[body], AXES[axis])
            }
            Symbol::Position(body, axis) => format!("{}_{}", AXES[axis], self.bodies[body]),
            Symbol::Axis(own, axis) => format!("{}_{}", AXES[axis], joint(own)),
        }
    }
}

const AXES: [&str; 3] = ["x", "y", "z"];

/// What the letters of the unknowns stand for.
const LETTERS: &str = "c and s are the cosine and the sine (this over the length of the axis) of the angle of a joint, d is the \
                       displacement over the length of the axis; x, y and z are coordinates of the origin of a body or, on the \
                       sphere, of the axis of a joint; u and v are directions that are fixed in a body.";

/// The verdict on one line.
#[must_use]
pub fn verdict(named: &Named<'_>, derivation: &RingDerivation) -> String {
    let Some(best) = derivation.polynomials.first() else { return "no closure polynomial".to_owned() };
    let degree = best.coefficients.degree().unwrap_or(0);
    let at_pi =
        if best.at_pi > 0 { format!(", {} at the half turn", counted(best.at_pi, "root")) } else { String::new() };
    let real = counted(best.coefficients.distinct_real_roots(), "distinct real root");
    let each = match best.shared {
        1 => String::new(),
        shared => format!(", each of {shared} assemblies"),
    };
    let proved = if named.is_rounded { "proved of the rounded numbers" } else { "proved" };
    let proof = match best.distinct {
        _ if best.separates() => format!("every root is one of an assembly ({proved})"),
        Some(distinct) => format!(
            "the {distinct} distinct assemblies have {} different values of it{each} ({proved}), and real ones may be those of complex \
             assemblies",
            best.values()
        ),
        None => "whether different assemblies have different values of it is not known".to_owned(),
    };
    format!("closure polynomial of degree {degree} in {}, {real}{at_pi}; {proof}", named.variable(best.unknown))
}

/// Describes the steps that lead to the polynomial.
fn steps(named: &Named<'_>, derivation: &RingDerivation) -> Vec<String> {
    let mut steps = vec![LETTERS.to_owned()];
    if let Some(best) = derivation.polynomials.first() {
        steps.push(format!(
            "A Gröbner basis over the rationals of the equations in {} makes them a ring of dimension {}: the number of assemblies, \
             complex ones included, with multiplicity, of the group and of those on which it stands.",
            counted(best.unknowns, "unknown"),
            best.assemblies
        ));
        steps.push(format!(
            "The closure polynomial is the characteristic polynomial of the multiplication by the unknown there{}; {}.",
            if best.shared > 1 { format!(", which is its power {}", best.shared) } else { String::new() },
            named.meaning(best.unknown)
        ));
    }
    steps
}

/// Whether it is proved of the file that every root belongs to an assembly and every assembly to a root.
fn is_proved(named: &Named<'_>, one: &RingPolynomial) -> bool {
    one.distinct.is_some() && !named.is_rounded
}

fn group_json(named: &Named<'_>, one: &RingPolynomial) -> Value {
    let [body, against] = named.ends(one.unknown);
    json!({
        "group": one.group + 1,
        "body": body,
        "against": against,
        "variable": named.variable(one.unknown),
        "means": named.meaning(one.unknown),
        "coefficients": coefficients(&one.coefficients),
        "at_pi": one.at_pi,
        "assemblies": one.assemblies,
        "shared": one.shared,
        "values": one.values(),
        "proved": is_proved(named, one),
    })
}

/// The derivation of a case as one document.
#[must_use]
pub fn json(named: &Named<'_>, derivation: &RingDerivation) -> Value {
    let names: Vec<String> = derivation.symbols.iter().map(|one| named.symbol(*one)).collect();
    let equations = (1..).zip(&derivation.equations);
    let best = derivation.polynomials.first();
    let mut document = named.completed(json!({
        "verdict": verdict(named, derivation),
        "equations": equations
            .map(|(k, equation)| json!({ "name": format!("equation {k}"), "text": written(equation, &names) }))
            .collect::<Value>(),
        "steps": steps(named, derivation),
        "warnings": derivation.warnings,
        "removed_factors": [],
        "unknowns": best.iter().map(|best| named.variable(best.unknown)).collect::<Value>(),
        "polynomials": derivation.polynomials.iter().map(|one| group_json(named, one)).collect::<Value>(),
        "degree": null,
        "real_roots": null,
        "polynomial": null,
    }));
    if let Some(best) = best {
        let variable = named.variable(best.unknown);
        insert_polynomial(&mut document, &variable, &best.coefficients, best.at_pi, is_proved(named, best));
    }
    document
}

/// The derivation of a case for a reader.
#[must_use]
pub fn text(named: &Named<'_>, derivation: &RingDerivation) -> String {
    let mut text = format!("{}\n", named.heading);
    paragraph(&mut text, &verdict(named, derivation));
    text.push_str("\nClosure equations (= 0)\n");
    let names: Vec<String> = derivation.symbols.iter().map(|one| named.symbol(*one)).collect();
    for equation in &derivation.equations {
        let whole = written(equation, &names);
        // Equations of a plate have thousands of terms.
        if whole.len() > LONGEST {
            let degree = equation.total_degree().unwrap_or(0);
            let _ = writeln!(text, "  {} of degree {degree} (--json)", counted(equation.len(), "term"));
        } else {
            let _ = writeln!(text, "  {whole}");
        }
    }
    text.push_str("\nElimination\n");
    for step in steps(named, derivation) {
        paragraph(&mut text, &step);
    }
    for one in &derivation.polynomials {
        let doubt =
            if one.separates() { String::new() } else { format!(", which {} assemblies share", one.assemblies) };
        let heading = format!("\nGroup {}, {}{doubt}", one.group + 1, counted(one.roots(), "root"));
        let _ = writeln!(text, "{heading}: {}", named.meaning(one.unknown));
        let _ = writeln!(text, "  {}", written(&univariate(&one.coefficients), &[named.variable(one.unknown)]));
    }
    for warning in &derivation.warnings {
        paragraph(&mut text, &format!("warning: {warning}"));
    }
    text
}

/// The names of the variables of a polynomial with symbols: `crank.B.x` is `crank_B_x`, the half-angle tangent of a given joint A is `t_A`.
fn variables(named: &Named<'_>, found: &RingSymbolic) -> Vec<String> {
    let own = found.symbols.iter().map(|name| {
        let joint = named.joints.iter().position(|[joint, ..]| joint == name);
        joint.map_or_else(
            || name.replace('.', "_"),
            |joint| {
                if named.distances[joint] { format!("d_{name}") } else { format!("t_{name}") }
            },
        )
    });
    std::iter::once(named.variable(found.unknown)).chain(own).collect()
}

/// `degree 4 in t_H, 35 terms in 1 symbol; ...`
#[must_use]
pub fn symbolic_verdict(named: &Named<'_>, found: &RingSymbolic) -> String {
    format!(
        "closure polynomial of degree {} in {}, {} in {}; equal to those derived at {} other values, drawn at random (probability \
         of error below 2^-40)",
        found.polynomial.degree(0),
        named.variable(found.unknown),
        counted(found.polynomial.len(), "term"),
        counted(found.symbols.len(), "symbol"),
        found.compared
    )
}

/// The name of a symbol, and of a side what the symbol is.
fn meaning_of_side(name: &str, side: Option<&Rational>) -> String {
    match side {
        None => name.to_owned(),
        Some(square) if *square == 1 => format!("{name}, the tangent of half the side"),
        Some(square) => {
            format!("{name}, the tangent of half the side over sqrt({square}), the sine of the side in the file")
        }
    }
}

fn symbolic_steps(named: &Named<'_>, found: &RingSymbolic) -> Vec<String> {
    let mut steps = vec![
        "The closure polynomial is derived at values of the symbols, by a Gröbner basis over the rationals at each; its coefficients are \
         interpolated modulo 256 primes."
            .to_owned(),
        format!("{}.", named.meaning(found.unknown)),
    ];
    if found.sides.iter().any(Option::is_some) {
        steps.push(
            "With a side its second point moves on the great circle through both; the directions from which angles are measured there turn \
             along, and what else belongs to the body stays."
                .to_owned(),
        );
    }
    steps
}

/// The polynomial with symbols for a reader.
#[must_use]
pub fn symbolic_text(named: &Named<'_>, found: &RingSymbolic) -> String {
    let mut text = format!("{}\n", named.heading);
    paragraph(&mut text, &symbolic_verdict(named, found));
    let names = variables(named, found);
    text.push_str(if found.sides.iter().any(Option::is_some) {
        "\nSymbols: half-angle tangents of sides of bodies and of given joints\n"
    } else {
        "\nSymbols: coordinates of points in their bodies, lengths, and given values (half-angle tangents, metres)\n"
    });
    for ((variable, name), side) in names[1..].iter().zip(&found.symbols).zip(&found.sides) {
        let _ = writeln!(text, "  {variable} = {}", meaning_of_side(name, side.as_ref()));
    }
    text.push_str("\nElimination\n");
    for step in symbolic_steps(named, found) {
        paragraph(&mut text, &step);
    }
    let _ = writeln!(text, "\n{} = 0", written(&rational(&found.polynomial), &names));
    text
}

/// The polynomial with symbols as one document.
#[must_use]
pub fn symbolic_json(named: &Named<'_>, found: &RingSymbolic) -> Value {
    let names = variables(named, found);
    let coefficients = found.coefficients();
    let coefficients = coefficients.iter().map(|c| written(&rational(c), &names));
    named.completed(json!({
        "verdict": symbolic_verdict(named, found),
        "equations": [],
        "steps": symbolic_steps(named, found),
        "warnings": [],
        "removed_factors": [],
        "unknowns": [names[0]],
        "degree": found.polynomial.degree(0),
        "real_roots": null,
        "proved": false,
        "symbols": found.symbols,
        "meanings": found.symbols.iter().zip(&found.sides).map(|(name, side)| meaning_of_side(name, side.as_ref())).collect::<Value>(),
        "terms": found.polynomial.len(),
        "polynomial": { "variable": names[0], "coefficients": coefficients.collect::<Vec<String>>() },
    }))
}

/// The closure equations and the closure polynomial in the language of another program.
///
/// # Errors
/// Where the language has no way to say it.
pub fn system(named: &Named<'_>, derivation: &RingDerivation, format: Format) -> Result<String> {
    let mut names: Vec<String> = derivation.symbols.iter().map(|one| named.symbol(*one)).collect();
    let mut lines: Vec<Line> = (1..)
        .zip(&derivation.equations)
        .map(|(k, equation)| Line::new(format!("closure equation {k}"), equation.clone()))
        .collect();
    if let Some(best) = derivation.polynomials.first() {
        let name = named.variable(best.unknown);
        let degree = best.coefficients.degree().unwrap_or(0);
        let place = names.iter().position(|known| *known == name).unwrap_or_else(|| {
            names.push(name.clone());
            names.len() - 1
        });
        let variable: Polynomial<Rational> = Polynomial::variable(place);
        let [above, below] = &derivation.unknown;
        let definition = variable.mul(below).sub(above);
        if !definition.is_zero() {
            lines.push(Line::new(format!("what {name} is in the other variables"), definition));
        }
        let coefficients = Univariate::new(best.coefficients.coefficients().iter().map(Rational::from).collect());
        let last = format!("the closure polynomial, of degree {degree}: {}", named.meaning(best.unknown));
        lines.push(Line::new(last, Polynomial::from_univariate(place, &coefficients)));
    }
    let (plain, renamed) = plain_names(&names)?;
    let rounded = named.is_rounded.then(|| ROUNDED.to_owned());
    let mut head = named.head();
    head.remarks.extend([LETTERS.to_owned()].into_iter().chain(rounded).chain(renamed));
    export(&head, &lines, &plain, format)
}

/// The equations of a case and the closure polynomial of its last group on a page of the atlas, and the latter by itself.
#[must_use]
pub(super) fn page(named: &Named<'_>, derivation: &RingDerivation) -> (String, Option<String>) {
    let names: Vec<String> = derivation.symbols.iter().map(|one| named.symbol(*one)).collect();
    let mut text = format!("# {LETTERS}\n");
    for (k, equation) in (1..).zip(&derivation.equations) {
        let _ = write!(text, "\nequation {k}\n  {}\n", written(equation, &names));
    }
    let last = derivation.polynomials.first().map(|best| {
        let name = named.variable(best.unknown);
        let degree = best.coefficients.degree().unwrap_or(0);
        let own = written(&univariate(&best.coefficients), std::slice::from_ref(&name));
        format!("\nclosure polynomial of degree {degree} in {name}: {}\n  {own}\n", named.meaning(best.unknown))
    });
    (text, last)
}
