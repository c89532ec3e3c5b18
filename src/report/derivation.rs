//! Derivations: the verdict first, then equations, steps and polynomial; as text, JSON and Markdown.

use super::export::{Head, Line, ROUNDED, export};
use super::json::{kind, number};
use super::number::digits;
use super::paper::{Paper, Style};
use super::text::heading;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::text::{Format, Names};
use crate::catalogue::entry::{Entry, Kind};
use crate::derivation::{ClosurePolynomial, Derivation, Equation, Removed, Root, RootPose, Substitution};
use crate::error::Result;
use rug::Rational;
use serde_json::{Value, json};
use std::fmt::Write;

/// Factors longer than this are described by their degree in a verdict.
const LONGEST_FACTOR: usize = 40;

/// The name of the polynomial's variable.
fn variable<'d>(derivation: &'d Derivation, polynomial: &ClosurePolynomial) -> &'d str {
    &derivation.names.list()[polynomial.variable]
}

/// `degree 16 in t3, 16 distinct roots, 6 real (proved), removed (1 + t3^2)^4`
#[must_use]
pub fn verdict(derivation: &Derivation) -> String {
    let Some(polynomial) = &derivation.polynomial else {
        return format!("no closure polynomial: {}", derivation.without.as_deref().unwrap_or("not known"));
    };
    let (name, degree) = (variable(derivation, polynomial), polynomial.degree());
    let certainty = if derivation.proved { "proved" } else { "probability of error below 2^-40" };
    let mut text = match (polynomial.distinct(), polynomial.roots.len()) {
        (0, _) => format!("degree 0 in {name}, no finite root"),
        (1, real) => format!("degree {degree} in {name}, 1 distinct root, {real} real ({certainty})"),
        (distinct, real) => format!("degree {degree} in {name}, {distinct} distinct roots, {real} real ({certainty})"),
    };
    if polynomial.at_pi > 0 {
        let more = if degree > 0 { " more" } else { "" };
        text.push_str(&format!(", {}{more} at {name} = inf (the angle pi)", polynomial.at_pi));
    }
    if derivation.per_root > 1 {
        text.push_str(&format!(", up to {} solutions at each", derivation.per_root));
    }
    if !polynomial.removed.is_empty() {
        let factors: Vec<String> = polynomial.removed.iter().map(|one| removed(one, &derivation.names, name)).collect();
        text.push_str(&format!(", removed {}", factors.join(" ")));
    }
    text
}

/// `(t3^2 + 1)^4`, or what there is to say of a long factor and of roots at infinity.
fn removed(removed: &Removed, names: &Names, variable: &str) -> String {
    let power = if removed.multiplicity > 1 { format!("^{}", removed.multiplicity) } else { String::new() };
    match &removed.factor {
        None if removed.multiplicity == 1 => format!("a root at {variable} = inf"),
        None => format!("{} roots at {variable} = inf", removed.multiplicity),
        Some(factor) => {
            let text = plain(factor, names);
            if text.len() <= LONGEST_FACTOR {
                return format!("({text}){power}");
            }
            format!("(degree {}){power}", factor.total_degree().unwrap_or(0))
        }
    }
}

/// `square-free, discriminant positive`; `square-free factors (degree 12)^1 (degree 2)^2, discriminant 0`
fn factors(polynomial: &ClosurePolynomial) -> String {
    let sign = match polynomial.discriminant_sign() {
        None => "",
        Some(1) => ", discriminant positive",
        Some(0) => ", discriminant 0",
        Some(_) => ", discriminant negative",
    };
    decomposition(polynomial) + sign
}

fn decomposition(polynomial: &ClosurePolynomial) -> String {
    match polynomial.factors.as_slice() {
        [(_, 1)] | [] => "square-free".to_owned(),
        several => {
            let each = several.iter().map(|(degree, multiplicity)| format!("(degree {degree})^{multiplicity}"));
            format!("square-free factors {}", each.collect::<Vec<_>>().join(" "))
        }
    }
}

/// A line for each factor that was divided out, and why.
fn divided_out(derivation: &Derivation, polynomial: &ClosurePolynomial) -> Vec<String> {
    let name = variable(derivation, polynomial);
    let line = |one: &Removed| {
        let long = one.factor.as_ref().map(|factor| plain(factor, &derivation.names));
        let text = match long {
            Some(text) if one.multiplicity > 1 => format!("({text})^{}", one.multiplicity),
            Some(text) => text,
            None => removed(one, &derivation.names, name),
        };
        format!("{text}: {}", one.reason)
    };
    polynomial.removed.iter().map(line).collect()
}

fn root(root: &Root) -> String {
    let value = root.exact.as_ref().map_or_else(|| format!("{:?}", root.value), ToString::to_string);
    if root.multiplicity > 1 { format!("{value} (multiplicity {})", root.multiplicity) } else { value }
}

/// A pose in 15 digits: `quaternion (1, 0, 0, 0), position (0, 0, 0.5)`.
fn pose(pose: &RootPose) -> String {
    let list = |numbers: &[f64]| numbers.iter().map(|x| digits(*x)).collect::<Vec<_>>().join(", ");
    format!("quaternion ({}), position ({})", list(&pose.quaternion), list(&pose.position))
}

fn plain(polynomial: &Polynomial<Rational>, names: &Names) -> String {
    Format::Text.polynomial(polynomial, names)
}

/// Everything for a reader.
#[must_use]
pub fn text(derivation: &Derivation) -> String {
    let names = &derivation.names;
    let mut text = verdict(derivation) + "\n";
    if !derivation.equations.is_empty() {
        text.push_str("\nClosure equations (= 0)\n");
    }
    for equation in &derivation.equations {
        let _ = writeln!(text, "{}:\n  {}", equation.name, plain(&equation.polynomial, names));
        if let Some(algebraic) = equation.algebraic.as_ref().filter(|a| **a != equation.polynomial) {
            let _ = writeln!(text, "  in half-angle tangents: {}", plain(algebraic, names));
        }
    }
    text.push_str("\nElimination\n");
    for (number, step) in (1..).zip(&derivation.steps) {
        let _ = writeln!(text, "{number}. {step}");
    }
    if let Some(polynomial) = &derivation.polynomial {
        let _ = writeln!(text, "\nClosure polynomial, {}", factors(polynomial));
        let _ = writeln!(text, "  {}", plain(&polynomial.to_polynomial(), names));
        if !polynomial.removed.is_empty() {
            text.push_str("\nDivided out\n");
        }
        for line in divided_out(derivation, polynomial) {
            let _ = writeln!(text, "  {line}");
        }
        if !polynomial.roots.is_empty() {
            let name = variable(derivation, polynomial);
            let _ = writeln!(text, "\nReal roots, isolated and counted by Sturm's theorem");
            for real in &polynomial.roots {
                let _ = writeln!(text, "  {name} = {}", root(real));
                for pose in &real.poses {
                    let _ = writeln!(text, "    {}", self::pose(pose));
                }
            }
        }
    }
    for warning in &derivation.warnings {
        let _ = writeln!(text, "\nwarning: {warning}");
    }
    text
}

/// The document that equations/derivation.schema.json describes; `case` is the number of the case in the file.
#[must_use]
pub fn json(entry: &Entry, case: usize, derivation: &Derivation) -> Value {
    let names = &derivation.names;
    let equations: Vec<Value> = derivation
        .equations
        .iter()
        .map(|equation| {
            let mut object = json!({ "name": equation.name, "text": plain(&equation.polynomial, names) });
            if let Some(algebraic) = &equation.algebraic {
                object["half_angle"] = json!(plain(algebraic, names));
            }
            object
        })
        .collect();
    let mut document = json!({
        "title": entry.title,
        "kind": kind(entry.kind()),
        "case": case,
        "verdict": verdict(derivation),
        "unknowns": [],
        "degree": null,
        "real_roots": null,
        "polynomial": null,
        "removed_factors": [],
        "equations": equations,
        "steps": derivation.steps,
        "warnings": derivation.warnings,
    });
    if let Some(polynomial) = &derivation.polynomial {
        let name = variable(derivation, polynomial);
        let coefficients: Vec<String> =
            polynomial.coefficients.coefficients().iter().map(ToString::to_string).collect();
        document["unknowns"] = json!([name]);
        document["degree"] = json!(polynomial.degree());
        document["real_roots"] = json!(polynomial.roots.len());
        document["solutions_per_root"] = json!(derivation.per_root);
        document["at_pi"] = json!(polynomial.at_pi);
        document["polynomial"] = json!({ "variable": name, "coefficients": coefficients });
        let factor = |one: &Removed| {
            let text = one.factor.as_ref().map_or_else(|| format!("{name} = inf"), |factor| plain(factor, names));
            json!({ "factor": text, "multiplicity": one.multiplicity, "reason": one.reason })
        };
        document["removed_factors"] = polynomial.removed.iter().map(factor).collect();
        document["proved"] = json!(derivation.proved);
        document["discriminant_sign"] = json!(polynomial.discriminant_sign());
        let factor =
            |(degree, multiplicity): &(usize, usize)| json!({ "degree": degree, "multiplicity": multiplicity });
        document["square_free"] = polynomial.factors.iter().map(factor).collect();
        let root = |root: &Root| {
            let exact = root.exact.as_ref().map(ToString::to_string);
            let mut object = json!({ "value": number(root.value), "exact": exact, "multiplicity": root.multiplicity });
            if entry.kind() == Kind::Platform {
                let pose = |pose: &RootPose| json!({ "quaternion": pose.quaternion, "position": pose.position });
                object["poses"] = root.poses.iter().map(pose).collect();
            }
            object
        };
        document["roots"] = polynomial.roots.iter().map(root).collect();
    }
    document
}

/// The system in the language of another program, over the variables that occur, with comments on what everything is where the language
/// has comments; `case` is the number of the case in the file.
///
/// # Errors
/// Where the language has no way to say it.
pub fn system(entry: &Entry, case: usize, derivation: &Derivation, format: Format) -> Result<String> {
    let polynomial = derivation.polynomial.as_ref();
    let last = |name: &str, degree: usize| {
        format!("the closure polynomial, of degree {degree} in {name}: its roots are the solutions' values of {name}")
    };
    let closing = polynomial.map(|p| (p.to_polynomial(), last(variable(derivation, p), p.degree())));
    let mut lines: Vec<Line> = Vec::new();
    for one in derivation.system() {
        let named = |equation: &&Equation| equation.algebraic.as_ref() == Some(&one);
        let meaning = match (&closing, derivation.equations.iter().find(named)) {
            (Some((polynomial, last)), _) if *polynomial == one => last.clone(),
            (_, Some(equation)) => format!("closure equation, {}", equation.name),
            _ => "the variable of the closure polynomial".to_owned(),
        };
        lines.push(Line::new(meaning, one));
    }
    export(&head(entry, case), &lines, &derivation.names, format)
}

/// What stands above a system of an entry.
pub(super) fn head(entry: &Entry, number: usize) -> Head<'_> {
    let case = number.checked_sub(1).and_then(|index| entry.cases.get(index));
    // The title stands above.
    let asked = case.and_then(|case| {
        let heading = heading(entry, number, case).replace('\n', "; ");
        heading.strip_prefix(&entry.title).map(|rest| rest.trim_start_matches([',', ';', ' ']).to_owned())
    });
    let asked = asked.filter(|asked| !asked.is_empty());
    let rounded = entry.rounded.then(|| ROUNDED.to_owned());
    let source = entry.source.as_ref().map(|source| source.key.as_str());
    Head { title: &entry.title, source, case: number, remarks: asked.into_iter().chain(rounded).collect() }
}

/// The derivation as a paper, every displayed equation one of those that were used, and what came of putting solutions
/// into them.
#[must_use]
pub fn paper(entry: &Entry, case: usize, derivation: &Derivation, found: &Substitution, style: Style) -> String {
    paper_with(entry, case, derivation, found, style, None)
}

/// Writes the paper with the part about one elimination of several: its name, its matrix, and the factors divided out.
pub(super) fn paper_with(
    entry: &Entry,
    case: usize,
    derivation: &Derivation,
    found: &Substitution,
    style: Style,
    way: Option<(&str, &str, &[String])>,
) -> String {
    let names = &derivation.names;
    let by = way.map_or_else(String::new, |(name, _, _)| format!(", by {name}"));
    let summary = format!("{}, case {case}{by}: {}.", kind(entry.kind()), verdict(derivation));
    let mut paper = Paper::new(style, names, &entry.title, &summary);
    paper.heading("Unknowns");
    unknowns(&mut paper, entry.kind());
    paper.heading("Closure equations");
    paper.sentence("With integer coefficients without common factor.");
    for equation in &derivation.equations {
        paper.label(&equation.name);
        paper.equation(&equation.polynomial);
        if let Some(algebraic) = equation.algebraic.as_ref().filter(|a| **a != equation.polynomial) {
            paper.sentence("in half-angle tangents");
            paper.equation(algebraic);
        }
    }
    paper.heading("Elimination");
    paper.numbered(&derivation.steps);
    if let Some((_, matrix, divided)) = way {
        paper.heading("Matrix");
        paper.sentence(matrix);
        if !divided.is_empty() {
            paper.sentence("Divided out of the eliminant:");
            paper.bullets(divided);
        }
    }
    if let Some(polynomial) = &derivation.polynomial {
        paper.heading("Closure polynomial");
        paper.sentence(&format!("{}; {}.", verdict(derivation), factors(polynomial)));
        if let Some(definition) = &derivation.definition {
            paper.sentence("Its variable is defined by");
            paper.equation(definition);
        }
        paper.equation(&polynomial.to_polynomial());
        if !polynomial.removed.is_empty() {
            paper.sentence("Divided out:");
            paper.bullets(&divided_out(derivation, polynomial));
        }
        if !polynomial.roots.is_empty() {
            let name = variable(derivation, polynomial);
            paper.sentence("Real roots, isolated by Descartes' rule and counted by Sturm's theorem:");
            let listed = polynomial.roots.iter().map(|real| {
                let poses: Vec<String> = real.poses.iter().map(pose).collect();
                let poses = if poses.is_empty() { String::new() } else { format!(": {}", poses.join("; ")) };
                format!("{name} = {}{poses}", root(real))
            });
            paper.bullets(&listed.collect::<Vec<_>>());
        }
    }
    paper.check(found);
    for warning in &derivation.warnings {
        paper.sentence(&format!("Warning: {warning}"));
    }
    paper.finish()
}

/// Describes the variables of the equations.
pub(super) fn unknowns(paper: &mut Paper<'_>, kind: Kind) {
    match kind {
        Kind::Platform => {
            paper.typeset_paragraph(
                "A pose is a point $(x, y)$ of the projective space of dimension 7: $x$ the quaternion of the rotation, $y = p\\,x$ \
                 that of the translation $p$, as a dual quaternion $x + \\tfrac12\\varepsilon y$. With $a_i$, $b_i$ the ends of leg \
                 $i$, of length $L_i$, as pure quaternions:",
            );
            paper.formula(
                "w_i = y + x\\,b_i - a_i\\,x, \\qquad w_i \\cdot w_i = L_i^2\\,(x \\cdot x), \\qquad x \\cdot y = 0",
            );
        }
        Kind::Arm | Kind::Loop => {
            paper.typeset_paragraph(
                "The motions of the joints, multiplied round the loop, are the identity: $V_1 G_1 V_2 G_2 \\cdots V_n G_n = I$ \
                 with constant $G_j$ and each $V_j$ a rotation about or a translation along its own $z$ axis. The cosine, sine and \
                 half-angle tangent of joint $j$ are $c_j$, $s_j$ and $t_j$, a distance is $d_j$:",
            );
            paper.formula("c_j = \\frac{1 - t_j^2}{1 + t_j^2}, \\qquad s_j = \\frac{2 t_j}{1 + t_j^2}");
        }
    }
}
