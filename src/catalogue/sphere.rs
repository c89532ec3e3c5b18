//! Linkages on the sphere: bodies with named directions, revolute joints between them, and the inputs.

use super::heading::{Heading, heading_with};
use super::job::digits;
use super::linkage::root;
use super::node::{Field, Node, Value};
use super::scope::{Scope, Table, nearest};
use super::space_configuration::{SpaceConfiguration, configuration};
use crate::algebra::number::{Angle, Quantity, Reading};
use crate::algebra::ring::exact_cos_sin;
use crate::algebra::sort;
use crate::error::Result;
use crate::kinematics::motion::{cross, dot};
use crate::kinematics::placement::rotation_of;
use crate::kinematics::sphere::{Direction, SphereBody, SphereGiven, SphereJoint, SphereLinkage, is_parallel};
use looproot_calculus::rotation::matrix::{Matrix, from_matrix, product};
use rug::Rational;
use std::collections::HashSet;

/// Maximum number of bodies, more than any linkage on the sphere that can be solved.
const MOST_BODIES: usize = 1000;

/// A file of a linkage on the sphere, as read.
#[derive(Clone, Debug)]
pub struct SphereFile {
    /// Title, source and remarks.
    pub heading: Heading,
    /// Its bodies and joints.
    pub linkage: SphereLinkage,
    /// The problems, one for every `[[input]]`; without any the linkage is a structure.
    pub cases: Vec<SphereCase>,
    /// Claims about curves of points: body, point, degree of the curve on the sphere, line.
    pub traces: Vec<SphereTrace>,
    /// Whether every direction is exact.
    pub exact: bool,
    /// Where the bodies stand, for the mobility.
    pub configuration: Option<SpaceConfiguration>,
    /// The interpretation of numbers in the file.
    pub reading: Reading,
}

/// A claim about the curve of a point.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereTrace {
    /// The body of the point.
    pub body: usize,
    /// Its name in that body.
    pub point: String,
    /// The degree of the curve in space.
    pub degree: u64,
    /// Line of the file, from 1.
    pub line: usize,
}

/// One problem of a linkage on the sphere.
#[derive(Clone, Debug)]
pub struct SphereCase {
    /// The given rotations.
    pub given: Vec<SphereGiven>,
    /// Whether all of them are exact.
    pub exact: bool,
    /// The claims.
    pub expected: SphereClaims,
    /// Line of the file at which the case begins, from 1.
    pub line: usize,
}

/// Claims about a case, every one optional.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SphereClaims {
    /// Isolated complex assemblies, with multiplicity.
    pub complex: Option<usize>,
    /// Isolated real assemblies.
    pub real: Option<usize>,
    /// Dimension of the set of assemblies.
    pub dimension: Option<usize>,
    /// Assemblies that must be among those found: joints with their angles, bodies with their quaternions, digits, line.
    pub solutions: Vec<SphereClaim>,
}

/// A claimed assembly.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SphereClaim {
    /// Joints with their angles, radians.
    pub joints: Vec<(usize, f64)>,
    /// Bodies with their quaternions relative to the ground.
    pub bodies: Vec<(usize, [f64; 4])>,
    /// Correct decimal digits.
    pub digits: u32,
    /// Line of the file, from 1.
    pub line: usize,
}

/// Reads a file whose `space` is the sphere.
pub(super) fn sphere(scope: &mut Scope<'_>, root: &Node, name: &str) -> Result<SphereFile> {
    let heading = heading_with(scope, root, name, &["input", "solution", "trace", "configuration"])?;
    let keys =
        ["title", "source", "notes", "units", "mechanism", "configuration", "expected", "input", "solution", "trace"];
    let table = scope.table(root, "the file", &keys)?;
    let node = scope.need(&table, "mechanism")?;
    let keys = ["kind", "space", "ground", "joints", "bodies"];
    let mechanism = scope.table(node, "the [mechanism] of a linkage on the sphere", &keys)?;
    let bodies = bodies(scope, scope.need(&mechanism, "bodies")?)?;
    let mut linkage = SphereLinkage { ground: 0, bodies, joints: Vec::new() };
    linkage.ground = body(scope, &linkage, scope.need(&mechanism, "ground")?)?;
    joints(scope, &mut linkage, scope.need(&mechanism, "joints")?)?;
    joined(scope, &linkage)?;
    let exact = !scope.is_rounded();
    let mut cases = Vec::new();
    if let Some(inputs) = table.get("input") {
        for input in scope.list(inputs, "input")? {
            cases.push(case(scope, input, &linkage)?);
        }
    }
    // An empty list of inputs is one of a structure, as none is.
    if cases.is_empty() {
        let (given, expected) = (Vec::new(), SphereClaims::default());
        cases.push(SphereCase { given, exact: true, expected, line: mechanism.line() });
    }
    let top = claims(scope, &table, &linkage)?;
    if let (Some(first), true) = (cases.first_mut(), top != SphereClaims::default()) {
        if first.expected != SphereClaims::default() {
            let message = "found claims about this case here and at the top of the file, expected one place";
            return Err(scope.fail(first.line, message));
        }
        first.expected = top;
    }
    let traces = match table.get("trace") {
        Some(list) => {
            scope.list(list, "trace")?.iter().map(|node| traced(scope, node, &linkage)).collect::<Result<_>>()?
        }
        None => Vec::new(),
    };
    let names: Vec<&str> = linkage.bodies.iter().map(|body| body.name.as_str()).collect();
    let configuration = table.get("configuration").map(|node| configuration(scope, node, &names, linkage.ground, true));
    let configuration = configuration.transpose()?;
    Ok(SphereFile { heading, linkage, cases, traces, exact, configuration, reading: scope.reading.clone() })
}

fn bodies(scope: &Scope<'_>, node: &Node) -> Result<Vec<SphereBody>> {
    let mut list = Vec::new();
    for Field { key, node, line } in fields(scope, node, "bodies")? {
        let mut points = Vec::new();
        for point in fields(scope, node, key)? {
            let what = format!("{key}.{}", point.key);
            points.push((point.key.clone(), direction(scope, &point.node, &what)?));
        }
        list.push(SphereBody { name: key.clone(), points, line: *line });
    }
    if list.len() > MOST_BODIES {
        let message = format!("found {} bodies, expected at most {MOST_BODIES}", list.len());
        return Err(scope.fail(node.line, message));
    }
    Ok(list)
}

pub(super) fn fields<'n>(scope: &Scope<'_>, node: &'n Node, what: &str) -> Result<&'n [Field]> {
    match &node.value {
        Value::Table(fields) => Ok(fields),
        _ => Err(scope.fail(node.line, format!("found {} as `{what}`, expected a table", node.describe()))),
    }
}

/// Reads a direction that is not zero.
pub(super) fn direction(scope: &Scope<'_>, node: &Node, what: &str) -> Result<Direction> {
    let numbers = scope.vector(node, Quantity::Ratio, what)?;
    let vector: Direction = numbers.each_ref().map(|c| c.rational().clone());
    if vector.iter().all(|c| *c == 0) {
        return Err(scope.fail(node.line, format!("found the zero vector as `{what}`, expected a direction")));
    }
    Ok(vector)
}

fn body(scope: &Scope<'_>, linkage: &SphereLinkage, node: &Node) -> Result<usize> {
    let name = scope.text(node, "a body")?;
    let names = || linkage.bodies.iter().map(|body| body.name.as_str());
    linkage.bodies.iter().position(|body| body.name == name).ok_or_else(|| {
        let near = nearest(name, names());
        let known = || names().take(12).collect::<Vec<_>>().join(", ");
        let hint =
            near.first().map_or_else(|| format!("expected one of {}", known()), |near| format!("did you mean {near}?"));
        let name: String = name.chars().take(40).collect();
        scope.fail(node.line, format!("found the unknown body `{name}`; {hint}"))
    })
}

fn joint_named(scope: &Scope<'_>, linkage: &SphereLinkage, name: &str, line: usize) -> Result<usize> {
    linkage.joints.iter().position(|joint| joint.name == name).ok_or_else(|| {
        let known: Vec<&str> = linkage.joints.iter().take(12).map(|joint| joint.name.as_str()).collect();
        let name: String = name.chars().take(40).collect();
        scope.fail(line, format!("found the unknown joint `{name}`, expected one of {}", known.join(", ")))
    })
}

fn joints(scope: &Scope<'_>, linkage: &mut SphereLinkage, node: &Node) -> Result<()> {
    if let Value::Text(word) = &node.value {
        if word != "shared points" {
            let message = "found a string as `joints` that is not \"shared points\", expected that or a list of joints";
            return Err(scope.fail(node.line, message));
        }
        return shared(scope, linkage, node.line);
    }
    for item in scope.list(node, "joints")? {
        let table = scope.table(item, "a joint on the sphere", &["name", "type", "of", "at", "zero"])?;
        let name = scope.text(scope.need(&table, "name")?, "name")?.to_owned();
        scope.word(scope.need(&table, "type")?, "type", &["R"])?;
        let [first, second] = scope.exactly::<2>(scope.need(&table, "of")?, "of")?;
        let of = [body(scope, linkage, first)?, body(scope, linkage, second)?];
        let points = match table.get("at") {
            None => [name.clone(), name.clone()],
            Some(Node { value: Value::Text(point), .. }) => [point.clone(), point.clone()],
            Some(node) => {
                let [a, b] = scope.exactly::<2>(node, "at")?;
                [scope.text(a, "at")?.to_owned(), scope.text(b, "at")?.to_owned()]
            }
        };
        let at = [
            point(scope, linkage, of[0], &points[0], item.line)?,
            point(scope, linkage, of[1], &points[1], item.line)?,
        ];
        let at = matched(scope, at);
        let zero = match table.get("zero") {
            None => references(&at),
            Some(node) => {
                let [a, b] = scope.exactly::<2>(node, "zero")?;
                [direction(scope, a, "zero")?, direction(scope, b, "zero")?]
            }
        };
        push(scope, linkage, SphereJoint { name, of, at, zero, line: item.line })?;
    }
    Ok(())
}

/// Returns references if the file names none. At angle 0 equal axes coincide without a rotation; others do by a rotation by
/// pi about the direction between them, or for opposite axes about a perpendicular one. Rational directions have rational ones.
pub(super) fn references(at: &[Direction; 2]) -> [Direction; 2] {
    let [u, w] = at;
    let first = least_along(u);
    if u == w {
        return [first.clone(), first];
    }
    let mut about: Direction = std::array::from_fn(|k| Rational::from(&u[k] + &w[k]));
    if about.iter().all(|c| *c == 0) {
        about = cross(u, &first);
    }
    let factor = Rational::from(2) * dot(&about, &first) / dot(&about, &about);
    let second = std::array::from_fn(|k| Rational::from(&factor * &about[k]) - &first[k]);
    [first, second]
}

/// Directions of a joint are taken to differ in length by their rounding if they do so by less than this part: three digits are typed at least.
const ROUNDED: (u32, u32) = (1, 500);

/// The directions of a joint in its two bodies: where their lengths differ by no more than the rounding of cosines and sines, as directions of
/// length 1 that are near them.
fn matched(scope: &Scope<'_>, at: [Direction; 2]) -> [Direction; 2] {
    let [a, b] = at.each_ref().map(|at| dot(at, at));
    let apart = Rational::from(&a - &b).abs();
    if apart == 0 || apart > (a + b) * Rational::from(ROUNDED) {
        return at;
    }
    scope.note(false);
    at.each_ref().map(unit_near)
}

/// Returns a direction of length 1, by a stereographic projection that is rounded to 56 bits: finer than the f64
/// in which answers are.
fn unit_near(direction: &Direction) -> Direction {
    let (length, _) = root(&dot(direction, direction));
    let sizes = direction.each_ref().map(|c| Rational::from(c.abs_ref()));
    let pole = (0..3).max_by(|a, b| sizes[*a].cmp(&sizes[*b])).unwrap_or(0);
    let below = length + &sizes[pole];
    let scale = Rational::from(1_u64 << 56);
    let image: Direction = direction.each_ref().map(|c| (Rational::from(c / &below) * &scale).round() / &scale);
    let square = dot(&image, &image) - Rational::from(&image[pole] * &image[pole]);
    let above = Rational::from(&square + 1);
    std::array::from_fn(|k| {
        let part = if k == pole { Rational::from(1 - &square) } else { Rational::from(&image[k] * 2_u32) };
        if k == pole && direction[k] < 0 { -part / &above } else { part / &above }
    })
}

/// Returns the coordinate axis that is least along a direction.
fn least_along(direction: &Direction) -> Direction {
    let sizes = direction.each_ref().map(|c| Rational::from(c.abs_ref()));
    let least = (0..3).min_by(|a, b| sizes[*a].cmp(&sizes[*b])).unwrap_or(0);
    std::array::from_fn(|k| Rational::from(u8::from(k == least)))
}

/// Adds a joint at every point name that several bodies share, between the first of them, or the ground, and each other one.
fn shared(scope: &Scope<'_>, linkage: &mut SphereLinkage, line: usize) -> Result<()> {
    let mut order: Vec<usize> = (0..linkage.bodies.len()).collect();
    sort::by_key(&mut order, |body| *body != linkage.ground);
    let mut names: Vec<String> = Vec::new();
    for body in &order {
        for (name, _) in &linkage.bodies[*body].points {
            if !names.contains(name) {
                names.push(name.clone());
            }
        }
    }
    for name in &names {
        let with: Vec<usize> = order.iter().copied().filter(|b| linkage.bodies[*b].point(name).is_some()).collect();
        let mut number = 1;
        for other in with.iter().skip(1) {
            let mut own = name.clone();
            while number > 1 && (own == *name || names.contains(&own)) {
                own = format!("{name}{number}");
                number += usize::from(names.contains(&own));
            }
            number += 1;
            let of = [with[0], *other];
            let at =
                matched(scope, [point(scope, linkage, of[0], name, line)?, point(scope, linkage, of[1], name, line)?]);
            let zero = references(&at);
            push(scope, linkage, SphereJoint { name: own, of, at, zero, line })?;
        }
    }
    Ok(())
}

fn point(scope: &Scope<'_>, linkage: &SphereLinkage, body: usize, name: &str, line: usize) -> Result<Direction> {
    let body = &linkage.bodies[body];
    body.point(name).cloned().ok_or_else(|| {
        let name: String = name.chars().take(40).collect();
        let known: Vec<&str> = body.points.iter().take(12).map(|(name, _)| name.as_str()).collect();
        let message =
            format!("found no point `{name}` in the body {}, which has {}; expected one", body.name, known.join(", "));
        scope.fail(line, message)
    })
}

fn push(scope: &Scope<'_>, linkage: &mut SphereLinkage, joint: SphereJoint) -> Result<()> {
    let refused = |what: String| Err(scope.fail(joint.line, what));
    if linkage.joints.iter().any(|other| other.name == joint.name) {
        return refused(format!("found the joint {} twice, expected different names", joint.name));
    }
    if joint.of[0] == joint.of[1] {
        let body = &linkage.bodies[joint.of[0]].name;
        return refused(format!("found the joint {} from the body {body} to itself, expected two bodies", joint.name));
    }
    let squares = joint.at.each_ref().map(|at| dot(at, at));
    if squares[0] != squares[1] {
        let [a, b] = squares.map(|square| square.to_f64().sqrt());
        return refused(format!(
            "found directions of lengths {a} and {b} at the joint {}, expected equal ones",
            joint.name
        ));
    }
    if let Some(side) = (0..2).find(|side| is_parallel(&joint.at[*side], &joint.zero[*side])) {
        let body = &linkage.bodies[joint.of[side]].name;
        return refused(format!(
            "found a `zero` along the axis of the joint {} in the body {body}, expected another direction",
            joint.name
        ));
    }
    linkage.joints.push(joint);
    Ok(())
}

/// Checks that every body is joined to the ground, possibly through others.
fn joined(scope: &Scope<'_>, linkage: &SphereLinkage) -> Result<()> {
    let mut seen = HashSet::from([linkage.ground]);
    let mut open = vec![linkage.ground];
    while let Some(body) = open.pop() {
        for joint in linkage.joints.iter().filter(|joint| joint.of.contains(&body)) {
            open.extend(joint.of.into_iter().filter(|other| seen.insert(*other)));
        }
    }
    match (0..linkage.bodies.len()).find(|body| !seen.contains(body)) {
        None => Ok(()),
        Some(body) => {
            let (body, ground) = (&linkage.bodies[body], &linkage.bodies[linkage.ground].name);
            let message = format!("found no joints from the body {} to the ground {ground}, expected some", body.name);
            Err(scope.fail(body.line, message))
        }
    }
}

/// Returns the rotation of the second body of a joint relative to the first, and whether it is exact.
pub(crate) fn turned(joint: &SphereJoint, angle: &Angle) -> (Matrix<Rational>, bool) {
    let (cos, sin) = exact_cos_sin(angle);
    let [u, w] = &joint.at;
    let square = dot(u, u);
    let [e, f] = [joint.reference(0), joint.reference(1)];
    let (size, exact_size) = root(&Rational::from(&dot(&e, &e) * &dot(&f, &f)));
    let (length, exact_length) = root(&square);
    // The rotation from the second body to the first at angle 0: axis to axis, reference to reference.
    let (x, y) = (cross(u, &e), cross(w, &f));
    let first: Matrix<Rational> = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let beside = Rational::from(&e[i] * &f[j]) + Rational::from(&x[i] * &y[j]) / &square;
            Rational::from(&u[i] * &w[j]) / &square + beside / &size
        })
    });
    let [a, b, c] = u;
    let minus = |x: &Rational| Rational::from(-x);
    let skew = [
        [Rational::new(), minus(c), b.clone()],
        [c.clone(), Rational::new(), minus(a)],
        [minus(b), a.clone(), Rational::new()],
    ];
    let turn: Matrix<Rational> = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let along = Rational::from(&u[i] * &u[j]) / &square;
            let unit = Rational::from(u8::from(i == j));
            let beside = Rational::from(&skew[i][j] * &sin) / &length;
            Rational::from(&cos * &(unit - &along)) + along + beside
        })
    });
    let rotation = product(&turn, &first);
    let exact = exact_size && (exact_length || sin == 0);
    if exact {
        return (rotation, angle.is_exact());
    }
    // Roots are right to 30 digits only; the quaternion of the matrix gives a rotation in any case.
    let q = from_matrix(&rotation);
    let [x, y, z] = &q.vector;
    (rotation_of([&q.scalar, x, y, z]), false)
}

fn given_joint(
    scope: &Scope<'_>,
    linkage: &SphereLinkage,
    joint: usize,
    angle: &Angle,
    line: usize,
) -> (SphereGiven, bool) {
    let own = &linkage.joints[joint];
    let (rotation, exact) = turned(own, angle);
    scope.note(exact);
    (SphereGiven { of: own.of, rotation, joint: Some(joint), line }, exact)
}

fn angle_of(scope: &Scope<'_>, node: &Node, what: &str) -> Result<Angle> {
    if !matches!(node.value, Value::Table(_)) {
        return scope.angle(node, what);
    }
    let table = scope.table(node, what, &["angle", "tan_half"])?;
    one_angle(scope, &table, table.line())
}

fn one_angle(scope: &Scope<'_>, table: &Table<'_>, line: usize) -> Result<Angle> {
    match (table.get("angle"), table.get("tan_half")) {
        (Some(node), None) => scope.angle(node, "angle"),
        (None, Some(node)) => scope.half_tangent(node, "tan_half"),
        _ => Err(scope.fail(line, "found an input without exactly one of `angle` and `tan_half`, expected one")),
    }
}

/// Reads an `[[input]]`.
fn case(scope: &Scope<'_>, node: &Node, linkage: &SphereLinkage) -> Result<SphereCase> {
    let keys = ["joint", "angle", "tan_half", "given", "body", "quaternion", "expected", "solution"];
    let table = scope.table(node, "[[input]]", &keys)?;
    let line = table.line();
    let mut given = Vec::new();
    let mut exact = true;
    if let Some(list) = table.get("given") {
        for field in fields(scope, list, "given")? {
            let joint = joint_named(scope, linkage, &field.key, field.line)?;
            let angle = angle_of(scope, &field.node, &field.key)?;
            let (one, is_exact) = given_joint(scope, linkage, joint, &angle, field.line);
            given.push(one);
            exact &= is_exact;
        }
    }
    match (table.get("joint"), table.get("body")) {
        (Some(joint), None) => {
            let index = joint_named(scope, linkage, scope.text(joint, "joint")?, joint.line)?;
            let (one, is_exact) = given_joint(scope, linkage, index, &one_angle(scope, &table, line)?, joint.line);
            given.push(one);
            exact &= is_exact;
        }
        (None, Some(node)) => {
            let index = body(scope, linkage, node)?;
            if index == linkage.ground {
                return Err(scope.fail(node.line, "found the ground as the `body` of an input, expected another body"));
            }
            let rotation = scope.rotation_quaternion(scope.need(&table, "quaternion")?)?;
            given.push(SphereGiven { of: [linkage.ground, index], rotation, joint: None, line: node.line });
        }
        (None, None) if !given.is_empty() => {}
        _ => {
            let message = "found an [[input]] without exactly one of `joint`, `body` and `given`, expected one";
            return Err(scope.fail(line, message));
        }
    }
    Ok(SphereCase { given, exact, expected: claims(scope, &table, linkage)?, line })
}

/// Reads the claims beside a case or at the top of the file.
fn claims(scope: &Scope<'_>, table: &Table<'_>, linkage: &SphereLinkage) -> Result<SphereClaims> {
    let mut found = SphereClaims::default();
    // Claims are compared in f64, so rounding them does not make the mechanism inexact.
    let own = Scope::new(scope.path, scope.reading.clone());
    if let Some(node) = table.get("expected") {
        let claims = own.table(node, "the [expected] of a linkage on the sphere", &["complex", "real", "dimension"])?;
        let count = |key: &str| claims.get(key).map(|node| own.count(node, key)).transpose();
        (found.complex, found.real, found.dimension) = (count("complex")?, count("real")?, count("dimension")?);
    }
    let Some(list) = table.get("solution") else { return Ok(found) };
    for node in own.list(list, "solution")? {
        let table = own.table(node, "[[solution]]", &["joints", "bodies", "digits"])?;
        let mut claim = SphereClaim { digits: digits(&own, &table)?, line: node.line, ..SphereClaim::default() };
        if let Some(list) = table.get("joints") {
            for field in fields(&own, list, "joints")? {
                let joint = joint_named(&own, linkage, &field.key, field.line)?;
                claim.joints.push((joint, own.radians(&field.node, &field.key)?));
            }
        }
        if let Some(list) = table.get("bodies") {
            for field in fields(&own, list, "bodies")? {
                let index = linkage.bodies.iter().position(|body| body.name == field.key);
                let index = index
                    .ok_or_else(|| own.fail(field.line, "found an unknown body, expected one of [mechanism.bodies]"))?;
                let place = own.table(&field.node, &field.key, &["quaternion"])?;
                let mut q = [0.0; 4];
                let node = own.need(&place, "quaternion")?;
                for (part, node) in q.iter_mut().zip(own.exactly::<4>(node, "quaternion")?) {
                    *part = own.number(node, Quantity::Ratio, "quaternion")?.to_f64();
                }
                claim.bodies.push((index, q));
            }
        }
        if claim.joints.is_empty() && claim.bodies.is_empty() {
            return Err(own.fail(node.line, "found a [[solution]] without `joints` and `bodies`, expected one of them"));
        }
        found.solutions.push(claim);
    }
    Ok(found)
}

/// Reads a claim about the curve of a point, `BODY.POINT`.
fn traced(scope: &Scope<'_>, node: &Node, linkage: &SphereLinkage) -> Result<SphereTrace> {
    let table = scope.table(node, "[[trace]]", &["point", "degree"])?;
    let node = scope.need(&table, "point")?;
    let text = scope.text(node, "point")?;
    let found = text.split_once('.').and_then(|(body, name)| {
        let index = linkage.bodies.iter().position(|own| own.name == body)?;
        linkage.bodies[index].point(name).map(|_| (index, name.to_owned()))
    });
    let Some((body, point)) = found else {
        let message = format!("found the point `{text}`, expected BODY.POINT with a point of a body");
        return Err(scope.fail(node.line, message));
    };
    let degree = scope.count(scope.need(&table, "degree")?, "degree")? as u64;
    Ok(SphereTrace { body, point, degree, line: table.line() })
}
