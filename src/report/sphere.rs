//! Assemblies and derivations of linkages on the sphere as text and as JSON.

use super::document::units;
use super::json::{number, tenths};
use super::linkage::headline;
use super::model;
use super::number::{counted, duration, short};
use super::ring_curve;
use super::ring_derivation::Named;
use super::table::{Columns, paragraph};
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::text::{Format, Names};
use crate::catalogue::{SphereCase, SphereFile};
use crate::derivation::{SpecialPoint, SphereCurve, SphereEnd, SphereSymbolic, SphereTrace, Transfer};
use crate::kinematics::sphere::SphereGiven;
use crate::linkage::sphere::{Coordinate, SphereAnswer, SphereMode};
use looproot_calculus::rotation::matrix::from_matrix;
use looproot_calculus::rotation::vectors::unit;
use rug::Rational;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// The quaternion of what is given.
fn quaternion(given: &SphereGiven) -> [f64; 4] {
    let rows = given.rotation.each_ref().map(|row| row.each_ref().map(Rational::to_f64));
    unit(&from_matrix(&rows)).map_or([f64::NAN; 4], |q| [q.scalar, q.vector[0], q.vector[1], q.vector[2]])
}

/// Returns the inputs in words.
pub(super) fn asked(file: &SphereFile, given: &[SphereGiven]) -> String {
    let linkage = &file.linkage;
    let one = |given: &SphereGiven| {
        let q = quaternion(given).map(|part| short(part, 6)).join(", ");
        match given.joint {
            Some(joint) => {
                format!("{} = {} deg", linkage.joints[joint].name, short(angle(file, given).to_degrees(), 6))
            }
            None => format!("{} turned by ({q})", linkage.bodies[given.of[1]].name),
        }
    };
    if given.is_empty() { "nothing given".to_owned() } else { given.iter().map(one).collect::<Vec<_>>().join(", ") }
}

/// The given angle of a joint, radians.
fn angle(file: &SphereFile, given: &SphereGiven) -> f64 {
    let Some(joint) = given.joint else { return f64::NAN };
    let joint = &file.linkage.joints[joint];
    let float = |v: &[Rational; 3]| v.each_ref().map(Rational::to_f64);
    let rows = given.rotation.each_ref().map(|row| row.each_ref().map(Rational::to_f64));
    let (e, u) = (float(&joint.reference(0)), float(&joint.at[0]));
    let f = looproot_calculus::rotation::matrix::apply(&rows, &float(&joint.reference(1)));
    let dot = looproot_calculus::motion::dot::<f64>;
    dot(&u, &looproot_calculus::motion::cross(&e, &f)).atan2(dot(&e, &f) * dot(&u, &u).sqrt())
}

fn asked_json(file: &SphereFile, given: &[SphereGiven]) -> Value {
    let (mut joints, mut bodies) = (Map::new(), Map::new());
    for one in given {
        if let Some(joint) = one.joint {
            joints.insert(file.linkage.joints[joint].name.clone(), number(angle(file, one)));
        } else {
            let q: Value = quaternion(one).iter().map(|part| number(*part)).collect();
            bodies.insert(file.linkage.bodies[one.of[1]].name.clone(), json!({ "quaternion": q }));
        }
    }
    json!({ "joints": joints, "bodies": bodies })
}

/// The joints in the order of the file.
pub(super) fn joint_variables(file: &SphereFile) -> Value {
    let joints = (1..).zip(&file.linkage.joints);
    joints.map(|(k, joint)| json!({ "name": joint.name, "kind": "angle", "joint": k, "label": joint.name })).collect()
}

/// One document for all cases.
#[must_use]
pub fn json(file: &SphereFile, results: &[Value]) -> Value {
    json!({
        "title": file.heading.title,
        "kind": "linkage",
        "name": file.heading.name,
        "version": env!("CARGO_PKG_VERSION"),
        "units": units(),
        "joint_variables": joint_variables(file),
        "mechanism": model::sphere_json(file),
        "results": results,
    })
}

fn value(z: &Coordinate, real: bool) -> Value {
    if real { number(z.re) } else { json!([number(z.re), number(z.im)]) }
}

/// The joint values and the rotations of the bodies of an assembly.
fn places(file: &SphereFile, mode: &SphereMode) -> Map<String, Value> {
    let linkage = &file.linkage;
    let joints = linkage.joints.iter().zip(&mode.joints);
    let joints: Map<String, Value> = joints.map(|(joint, z)| (joint.name.clone(), value(z, mode.real))).collect();
    let q: Value = joints.values().cloned().collect();
    let bodies = linkage.bodies.iter().enumerate().map(|(k, body)| {
        let q = mode.quaternion(k).map_or(Value::Null, |q| q.iter().map(|z| value(z, mode.real)).collect());
        (body.name.clone(), json!({ "quaternion": q }))
    });
    let bodies: Map<String, Value> = bodies.collect();
    let mut object = Map::new();
    object.insert("q".into(), q);
    object.insert("joints".into(), Value::Object(joints));
    object.insert("bodies".into(), Value::Object(bodies));
    object
}

fn mode(file: &SphereFile, id: usize, mode: &SphereMode) -> Value {
    let mut object = Map::new();
    object.insert("id".into(), json!(id));
    object.insert("real".into(), json!(mode.real));
    object.extend(places(file, mode));
    object.insert("multiplicity".into(), json!(mode.multiplicity));
    object.insert("residual".into(), number(mode.residual));
    object.insert("certified".into(), json!(true));
    object.insert("radius".into(), number(mode.radius));
    Value::Object(object)
}

/// Returns the answer to one case, its number counted from 1, with complex assemblies on request.
#[must_use]
pub fn result(file: &SphereFile, case: &SphereCase, index: usize, answer: &SphereAnswer, complex: bool) -> Value {
    let verdict = &answer.verdict;
    let modes = (1..).zip(&answer.modes).filter(|(_, mode)| complex || mode.real);
    let families = answer.families.iter().map(|family| {
        let labels: Vec<&str> = family.joints.iter().map(|joint| file.linkage.joints[*joint].name.as_str()).collect();
        let numbers: Vec<usize> = family.joints.iter().map(|joint| joint + 1).collect();
        let sample = places(file, &family.sample);
        json!({ "dimension": family.dimension, "joints": numbers, "labels": labels, "real": true, "distance": 0, "sample": sample, "samples": [] })
    });
    json!({
        "case": index,
        "asked": asked_json(file, &case.given),
        "verdict": {
            "status": verdict.status.word(),
            "proof": verdict.proof.word(),
            "code": verdict.code.word(),
            "complex_complete": verdict.complex_complete,
            "complex": verdict.complex,
            "real": verdict.real,
            "at_infinity": verdict.at_infinity,
            "self_motion": verdict.self_motion,
            "certified": verdict.certified,
            "near": 0,
            "reason": verdict.reason,
        },
        "groups": [],
        "modes": modes.map(|(id, own)| mode(file, id, own)).collect::<Value>(),
        "families": families.collect::<Value>(),
        "warnings": [],
        "timings_us": { "solve": tenths(answer.solve_us) },
    })
}

/// Returns the answer to one case as a table, with complex assemblies on request.
#[must_use]
pub fn text(file: &SphereFile, case: &SphereCase, index: usize, answer: &SphereAnswer, complex: bool) -> String {
    let mut text = format!("{}, case {index}: {}\n", file.heading.title, asked(file, &case.given));
    paragraph(&mut text, &headline(&answer.verdict));
    let mut header = vec!["mode".to_owned()];
    header.extend(file.linkage.joints.iter().map(|joint| format!("{} [deg]", joint.name)));
    let shown = (1..).zip(&answer.modes).filter(|(_, mode)| complex || mode.real);
    let shown = shown.map(|(id, mode)| (id.to_string(), mode));
    let multiple = shown.clone().any(|(_, mode)| mode.multiplicity > 1);
    if multiple {
        header.push("multiplicity".to_owned());
    }
    let mut table = Columns::new(&header, &["mode"]);
    let mut rows = 0;
    let samples = answer.families.iter().map(|family| ("family".to_owned(), &family.sample));
    for (name, mode) in shown.chain(samples) {
        let cell = |z: &Coordinate| {
            let (re, im) = (z.re.to_degrees(), z.im.to_degrees());
            if mode.real { short(re, 6) } else { format!("{} {im:+.6}i", short(re, 6)) }
        };
        // A sample of a family has none.
        let times = if name == "family" { String::new() } else { mode.multiplicity.to_string() };
        let times = multiple.then_some(times);
        table.row([name].into_iter().chain(mode.joints.iter().map(cell)).chain(times));
        rows += 1;
    }
    if rows > 0 {
        let _ = write!(text, "\n{}", table.text());
    }
    for family in &answer.families {
        let labels: Vec<&str> = family.joints.iter().map(|joint| file.linkage.joints[*joint].name.as_str()).collect();
        paragraph(
            &mut text,
            &format!("family of dimension {}: the joints {} move", family.dimension, labels.join(", ")),
        );
    }
    let count = counted(answer.modes.len(), "assembly");
    let _ = writeln!(text, "\n{count} in {}", duration(answer.solve_us));
    text
}

fn written(polynomial: &Polynomial<Int>, names: &[&str]) -> String {
    let exact = polynomial.map(|c| Some(Rational::from(c.to_integer()))).unwrap_or_else(Polynomial::zero);
    Names::given(names).map_or_else(|_| String::new(), |names| Format::Text.polynomial(&exact, &names))
}

const SPACE: [&str; 3] = ["x", "y", "z"];
const CHART: [&str; 2] = ["u", "v"];
const TANGENTS: [&str; 2] = ["t", "s"];

/// The sentence on the derivation of the polynomial of a curve.
const CURVE: &str =
    "three equations are linear in the end of the crank; by Cramer's rule its length is the equation of the curve";
/// The sentence on the derivation of a transfer function.
const TRANSFER: &str =
    "the ends of crank and rocker include the angle of the coupler; what lies between two four-bars is eliminated";

/// Returns a document with the keys that every document of a linkage has; `case` is counted from 1.
#[must_use]
pub fn completed(file: &SphereFile, case: usize, own: Value) -> Value {
    let mut document = json!({
        "name": file.heading.name,
        "version": env!("CARGO_PKG_VERSION"),
        "units": units(),
        "joint_variables": joint_variables(file),
        "mechanism": model::sphere_json(file),
        "title": file.heading.title,
        "kind": "linkage",
        "case": case,
    });
    if let (Value::Object(document), Value::Object(own)) = (&mut document, own) {
        document.extend(own);
    }
    document
}

/// Returns the common part of all documents of derivations.
fn document(file: &SphereFile, case: usize, verdict: &str, step: &str) -> Value {
    let own = json!({
        "verdict": verdict,
        "unknowns": [],
        "degree": null,
        "real_roots": null,
        "polynomial": null,
        "removed_factors": [],
        "equations": [],
        "steps": [step],
        "warnings": [],
    });
    completed(file, case, own)
}

/// The verdict on a curve.
fn curve_verdict(of: &str, curve: &SphereCurve) -> String {
    let own = curve.polynomial.total_degree().unwrap_or(0);
    format!(
        "curve of {of}: of degree {} in space, the sphere x^2 + y^2 + z^2 = {} and a surface of degree {own} with {} terms",
        curve.degree(),
        curve.square,
        curve.polynomial.len()
    )
}

fn points_json(points: Option<&Vec<SpecialPoint>>) -> Value {
    let one = |point: &SpecialPoint| {
        let at: Value = point.at.iter().map(|z| value(z, point.real)).collect();
        json!({ "at": at, "real": point.real, "multiplicity": point.multiplicity })
    };
    points.map_or(Value::Null, |points| points.iter().map(one).collect())
}

/// The curve of a point as one document.
fn curve_json(file: &SphereFile, case: usize, body: &str, point: &str, curve: &SphereCurve) -> Value {
    let mut document = document(file, case, &curve_verdict(&format!("{body}.{point}"), curve), CURVE);
    let names = curve.four_bar.bodies.map(|body| file.linkage.bodies[body].name.clone());
    let mirrors: Value =
        curve.mirrors.iter().map(|n| n.iter().map(|c| number(c.to_f64())).collect::<Value>()).collect();
    document["trace"] = json!({
        "body": body,
        "point": point,
        "degree": curve.degree(),
        "polynomial": written(&curve.polynomial, &SPACE),
        "sphere": curve.square.to_string(),
        "bodies": names,
        "locus_of_double_points": written(&curve.locus, &SPACE),
        "double_points": points_json(curve.double_points.as_ref()),
        "cusps": points_json(curve.cusps.as_ref()),
        "mirrors": mirrors,
        "stereographic": curve.stereographic.as_ref().map(|p| written(p, &CHART)),
        "stereographic_degree": curve.stereographic.as_ref().and_then(Polynomial::total_degree),
    });
    document
}

/// The curve of a point for a reader.
fn curve_text(file: &SphereFile, of: &str, curve: &SphereCurve) -> String {
    let mut text = format!("{}\n", file.heading.title);
    paragraph(&mut text, &curve_verdict(of, curve));
    let names = curve.four_bar.bodies.map(|body| file.linkage.bodies[body].name.as_str());
    paragraph(&mut text, &format!("the four-bar of {}: {CURVE}", names.join(", ")));
    let _ = writeln!(text, "\n{} = 0", written(&curve.polynomial, &SPACE));
    let _ = writeln!(text, "\nDouble points lie on\n  {} = 0", written(&curve.locus, &SPACE));
    for (name, points) in [("double points", &curve.double_points), ("cusps", &curve.cusps)] {
        let Some(points) = points else {
            let _ = writeln!(text, "\n{name}: not decided");
            continue;
        };
        let count: usize = points.iter().map(|point| point.multiplicity).sum();
        let real: Vec<&SpecialPoint> = points.iter().filter(|point| point.real).collect();
        let _ = writeln!(text, "\n{name}: {count} complex with multiplicity, {} real", real.len());
        for point in real {
            let at = point.at.map(|z| short(z.re, 9)).join(", ");
            let _ = writeln!(text, "  ({at})");
        }
    }
    for normal in &curve.mirrors {
        let normal = normal.each_ref().map(ToString::to_string).join(", ");
        paragraph(
            &mut text,
            &format!("symmetric: the curve is its own mirror image in the plane with the normal ({normal})"),
        );
    }
    if let Some(plane) = &curve.stereographic {
        let degree = plane.total_degree().unwrap_or(0);
        let _ = writeln!(text, "\nStereographic projection, degree {degree}\n  {} = 0", written(plane, &CHART));
    }
    text
}

/// The curve of a point, derived or interpolated, as one document.
#[must_use]
pub fn trace_json(file: &SphereFile, case: usize, (body, point): (&str, &str), found: &SphereTrace) -> Value {
    match found {
        SphereTrace::Coupler(curve) => curve_json(file, case, body, point, curve),
        SphereTrace::Sections(curve) => ring_curve::json(&Named::on_sphere(file, case), (body, point), curve),
    }
}

/// The verdict on the curve of a point.
#[must_use]
pub fn trace_verdict(of: &str, found: &SphereTrace) -> String {
    match found {
        SphereTrace::Coupler(curve) => curve_verdict(of, curve),
        SphereTrace::Sections(curve) => ring_curve::verdict(of, curve),
    }
}

/// The curve of a point for a reader.
#[must_use]
pub fn trace_text(file: &SphereFile, case: usize, of: &str, found: &SphereTrace) -> String {
    match found {
        SphereTrace::Coupler(curve) => curve_text(file, of, curve),
        SphereTrace::Sections(curve) => ring_curve::text(&Named::on_sphere(file, case), of, curve),
    }
}

/// The verdict on a transfer function.
#[must_use]
pub fn transfer_verdict(file: &SphereFile, found: &Transfer) -> String {
    let name = |joint: usize| &file.linkage.joints[joint].name;
    let degrees = found.polynomial.degrees();
    let degree = |k: usize| degrees.get(k).copied().unwrap_or(0);
    let ratio: Vec<&str> = found.constant_ratio.iter().map(|(_, what)| *what).collect();
    let homokinetic =
        if ratio.is_empty() { String::new() } else { format!("; homokinetic: {} is a factor", ratio.join(", ")) };
    format!(
        "transfer function of {} and {}: degree {} in the output, {} in the input{homokinetic}",
        name(found.input),
        name(found.output),
        degree(1),
        degree(0)
    )
}

/// The transfer function as one document.
#[must_use]
pub fn transfer_json(file: &SphereFile, case: usize, found: &Transfer) -> Value {
    let mut document = document(file, case, &transfer_verdict(file, found), TRANSFER);
    let names = |bodies: &[usize; 4]| bodies.map(|body| file.linkage.bodies[body].name.clone());
    let factors = found
        .constant_ratio
        .iter()
        .map(|(factor, what)| json!({ "factor": written(factor, &TANGENTS), "means": what }));
    document["transfer"] = json!({
        "input": file.linkage.joints[found.input].name,
        "output": file.linkage.joints[found.output].name,
        "variables": TANGENTS,
        "polynomial": written(&found.polynomial, &TANGENTS),
        "four_bars": found.bodies.iter().map(names).collect::<Vec<_>>(),
        "constant_ratio": factors.collect::<Value>(),
    });
    document
}

/// The transfer function for a reader.
#[must_use]
pub fn transfer_text(file: &SphereFile, found: &Transfer) -> String {
    let mut text = format!("{}\n", file.heading.title);
    paragraph(&mut text, &transfer_verdict(file, found));
    paragraph(&mut text, TRANSFER);
    let name = |joint: usize| &file.linkage.joints[joint].name;
    let _ = writeln!(text, "\nt = tan({}/2), s = tan({}/2)", name(found.input), name(found.output));
    let _ = writeln!(text, "{} = 0", written(&found.polynomial, &TANGENTS));
    for (factor, what) in &found.constant_ratio {
        let _ = writeln!(text, "{} divides it: {what}", written(factor, &TANGENTS));
    }
    text
}

/// The names of the variables of a relation with symbols.
fn symbolic_names(found: &SphereSymbolic) -> Vec<String> {
    let own = TANGENTS.map(str::to_owned).into_iter();
    own.chain(found.symbols.iter().flat_map(|one| ["c", "s"].map(|kind| format!("{kind}_{}", one.name)))).collect()
}

/// `degree 2 in t and 2 in s, 34 terms in cosines and sines of 4 angles, derived with these as symbols`
#[must_use]
pub fn symbolic_verdict(found: &SphereSymbolic) -> String {
    format!(
        "degree {} in t and {} in s, {} in cosines and sines of {}, derived with these as symbols",
        found.polynomial.degree(0),
        found.polynomial.degree(1),
        counted(found.polynomial.len(), "term"),
        counted(found.symbols.len(), "angle")
    )
}

/// What an angle of the relation is.
fn end(file: &SphereFile, end: &SphereEnd, (own, from): (&str, &str)) -> String {
    let name = &file.linkage.joints[end.joint].name;
    let sign = if end.sign < 0.0 { "-" } else { "" };
    format!("{own} is the angle at {name} from {from}: {sign}{name} {:+.6} deg", end.offset.to_degrees())
}

/// What the two angles are.
fn angles(file: &SphereFile, found: &SphereSymbolic) -> [String; 2] {
    let [first, last] = &found.ends;
    let arc = "the arc of the ground to the crank";
    [
        end(file, first, ("phi", arc)),
        end(file, last, ("psi", "the arc of the last four-bar's ground, continued, to its rocker")),
    ]
}

/// The relation with symbols for a reader.
#[must_use]
pub fn symbolic_text(file: &SphereFile, found: &SphereSymbolic) -> String {
    let mut text = format!("{}\n", file.heading.title);
    paragraph(&mut text, &symbolic_verdict(found));
    paragraph(&mut text, TRANSFER);
    text.push_str("\nt = tan(phi/2), s = tan(psi/2)\n");
    for one in angles(file, found) {
        paragraph(&mut text, &one);
    }
    if !found.symbols.is_empty() {
        text.push_str("\nSymbols: c is the cosine and s the sine, c^2 + s^2 = 1\n");
    }
    for one in &found.symbols {
        let words = format!("c_{0}, s_{0}: {1}, in the file {2:.6} deg", one.name, one.meaning, one.value.to_degrees());
        paragraph(&mut text, &words);
    }
    let names = symbolic_names(found);
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let _ = writeln!(text, "\n{} = 0", written(&found.polynomial, &names));
    text
}

/// The relation with symbols as one document.
#[must_use]
pub fn symbolic_json(file: &SphereFile, case: usize, found: &SphereSymbolic) -> Value {
    let mut document = document(file, case, &symbolic_verdict(found), TRANSFER);
    let name = |joint: usize| file.linkage.joints[joint].name.clone();
    let bodies = |bodies: &[usize; 4]| bodies.map(|body| file.linkage.bodies[body].name.clone());
    let names = symbolic_names(found);
    let shown: Vec<&str> = names.iter().map(String::as_str).collect();
    let ends = found
        .ends
        .iter()
        .map(|end| json!({ "joint": name(end.joint), "sign": end.sign, "offset": number(end.offset) }));
    let symbols = found.symbols.iter().map(|one| {
        json!({ "cosine": format!("c_{}", one.name), "sine": format!("s_{}", one.name), "means": one.meaning, "value": number(one.value) })
    });
    document["transfer"] = json!({
        "input": name(found.ends[0].joint),
        "output": name(found.ends[1].joint),
        "variables": names,
        "polynomial": written(&found.polynomial, &shown),
        "four_bars": found.bodies.iter().map(bodies).collect::<Vec<_>>(),
        "constant_ratio": [],
        "angles": ends.collect::<Value>(),
        "symbols": symbols.collect::<Value>(),
    });
    document
}
