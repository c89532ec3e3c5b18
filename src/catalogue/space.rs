//! Linkages in space: bodies with points, joints between them, and the inputs.

use super::entry::InputValue;
use super::heading::{Heading, heading_with};
use super::job::digits;
use super::linkage::root;
use super::node::{Field, Node, Value};
use super::scope::{Scope, Table, nearest};
use super::space_configuration::{SpaceConfiguration, configuration};
use super::sphere::{direction, fields, references, turned};
use crate::algebra::number::{Angle, Number, Quantity, Reading};
use crate::error::{Error, Result};
use crate::kinematics::motion::{Motion, Vector, dot};
use crate::kinematics::space::{Axis, Known, SpaceBody, SpaceGiven, SpaceJoint, SpaceLinkage, SpacePair};
use crate::kinematics::sphere::{SphereJoint, is_parallel};
use rug::Rational;
use std::collections::HashSet;

/// Maximum number of bodies, more than any linkage in space that can be solved.
const MOST_BODIES: usize = 1000;

/// A file of a linkage in space, as read.
#[derive(Clone, Debug)]
pub struct SpaceFile {
    /// Title, source and remarks.
    pub heading: Heading,
    /// Its bodies and joints.
    pub linkage: SpaceLinkage,
    /// The problems, one for every `[[input]]`; without any the linkage is a structure.
    pub cases: Vec<SpaceCase>,
    /// Whether every number of bodies and joints is exact.
    pub exact: bool,
    /// Where the bodies stand, for the mobility.
    pub configuration: Option<SpaceConfiguration>,
    /// The interpretation of numbers in the file.
    pub reading: Reading,
}

/// One problem of a linkage in space.
#[derive(Clone, Debug)]
pub struct SpaceCase {
    /// The given values.
    pub given: Vec<SpaceGiven>,
    /// Whether all of them are exact.
    pub exact: bool,
    /// The claims.
    pub expected: SpaceClaims,
    /// Line of the file at which the case begins, from 1.
    pub line: usize,
}

/// Claims about a case, every one optional.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpaceClaims {
    /// Isolated complex assemblies, with multiplicity.
    pub complex: Option<usize>,
    /// Isolated real assemblies.
    pub real: Option<usize>,
    /// Dimension of the set of assemblies.
    pub dimension: Option<usize>,
    /// Assemblies of every group, in the order in which they can be solved.
    pub groups: Option<Vec<usize>>,
    /// Assemblies that must be among those found.
    pub solutions: Vec<SpaceClaim>,
}

/// A body with its quaternion and the position of its origin relative to the ground, as far as claimed.
pub type ClaimedPlace = (usize, Option<[f64; 4]>, Option<[f64; 3]>);

/// A claimed assembly.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpaceClaim {
    /// Joints with their values, radians or metres.
    pub joints: Vec<(usize, f64)>,
    /// The places of bodies.
    pub bodies: Vec<ClaimedPlace>,
    /// Correct decimal digits.
    pub digits: u32,
    /// Line of the file, from 1.
    pub line: usize,
}

/// Reads a file whose `space` is space.
pub(super) fn space(scope: &mut Scope<'_>, top: &Node, name: &str) -> Result<SpaceFile> {
    let heading = heading_with(scope, top, name, &["input", "solution", "configuration"])?;
    let keys = ["title", "source", "notes", "units", "mechanism", "configuration", "expected", "input", "solution"];
    let table = scope.table(top, "the file", &keys)?;
    let node = scope.need(&table, "mechanism")?;
    let keys = ["kind", "space", "ground", "joints", "bodies"];
    let mechanism = scope.table(node, "the [mechanism] of a linkage in space", &keys)?;
    let bodies = bodies(scope, scope.need(&mechanism, "bodies")?)?;
    let mut linkage = SpaceLinkage { ground: 0, bodies, joints: Vec::new() };
    linkage.ground = body(scope, &linkage, scope.need(&mechanism, "ground")?)?;
    for item in scope.list(scope.need(&mechanism, "joints")?, "joints")? {
        let joint = joint(scope, &linkage, item)?;
        push(scope, &mut linkage, joint)?;
    }
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
        let (given, expected) = (Vec::new(), SpaceClaims::default());
        cases.push(SpaceCase { given, exact: true, expected, line: mechanism.line() });
    }
    let top = claims(scope, &table, &linkage)?;
    if let (Some(first), true) = (cases.first_mut(), top != SpaceClaims::default()) {
        if first.expected != SpaceClaims::default() {
            let message = "found claims about this case here and at the top of the file, expected one place";
            return Err(scope.fail(first.line, message));
        }
        first.expected = top;
    }
    let names: Vec<&str> = linkage.bodies.iter().map(|body| body.name.as_str()).collect();
    let configuration =
        table.get("configuration").map(|node| configuration(scope, node, &names, linkage.ground, false));
    let configuration = configuration.transpose()?;
    Ok(SpaceFile { heading, linkage, cases, exact, configuration, reading: scope.reading.clone() })
}

fn bodies(scope: &Scope<'_>, node: &Node) -> Result<Vec<SpaceBody>> {
    let mut list = Vec::new();
    for Field { key, node, line } in fields(scope, node, "bodies")? {
        let mut points = Vec::new();
        for point in fields(scope, node, key)? {
            let what = format!("{key}.{}", point.key);
            let place = scope.vector(&point.node, Quantity::Length, &what)?;
            points.push((point.key.clone(), place.each_ref().map(|c| c.rational().clone())));
        }
        list.push(SpaceBody { name: key.clone(), points, line: *line });
    }
    if list.len() > MOST_BODIES {
        let message = format!("found {} bodies, expected at most {MOST_BODIES}", list.len());
        return Err(scope.fail(node.line, message));
    }
    Ok(list)
}

fn body(scope: &Scope<'_>, linkage: &SpaceLinkage, node: &Node) -> Result<usize> {
    body_named(scope, linkage, scope.text(node, "a body")?, node.line)
}

fn body_named(scope: &Scope<'_>, linkage: &SpaceLinkage, name: &str, line: usize) -> Result<usize> {
    let names = || linkage.bodies.iter().map(|body| body.name.as_str());
    names().position(|own| own == name).ok_or_else(|| {
        let near = nearest(name, names());
        let known = || names().take(12).collect::<Vec<_>>().join(", ");
        let hint =
            near.first().map_or_else(|| format!("expected one of {}", known()), |near| format!("did you mean {near}?"));
        let name: String = name.chars().take(40).collect();
        scope.fail(line, format!("found the unknown body `{name}`; {hint}"))
    })
}

fn joint_named(scope: &Scope<'_>, linkage: &SpaceLinkage, name: &str, line: usize) -> Result<usize> {
    let names = || linkage.joints.iter().map(|joint| joint.name.as_str());
    names().position(|own| own == name).ok_or_else(|| {
        let known: Vec<&str> = names().take(12).collect();
        let name: String = name.chars().take(40).collect();
        scope.fail(line, format!("found the unknown joint `{name}`, expected one of {}", known.join(", ")))
    })
}

fn point(scope: &Scope<'_>, linkage: &SpaceLinkage, body: usize, name: &str, line: usize) -> Result<Vector<Rational>> {
    let body = &linkage.bodies[body];
    body.point(name).cloned().ok_or_else(|| {
        let name: String = name.chars().take(40).collect();
        let known: Vec<&str> = body.points.iter().take(12).map(|(name, _)| name.as_str()).collect();
        let message =
            format!("found no point `{name}` in the body {}, which has {}; expected one", body.name, known.join(", "));
        scope.fail(line, message)
    })
}

/// Reads a number whose square is wanted, such as a length `sqrt(5)`: the number, its square, and whether that is exact.
fn squared(scope: &Scope<'_>, node: &Node, what: &str) -> Result<(Number, Rational, bool)> {
    let number = scope.rooted(node, what)?;
    let square = number.squared();
    Ok((number, square.rational().clone(), square.is_exact()))
}

fn joint(scope: &Scope<'_>, linkage: &SpaceLinkage, node: &Node) -> Result<SpaceJoint> {
    let keys = ["name", "type", "of", "at", "axis", "axes", "zero", "length"];
    let table = scope.table(node, "a joint in space", &keys)?;
    let name = scope.text(scope.need(&table, "name")?, "name")?.to_owned();
    let kinds = ["R", "P", "S", "U", "SS", "SPS", "UPU", "parallelogram"];
    let kind = scope.word(scope.need(&table, "type")?, "type", &kinds)?;
    let allowed: &[&str] = match kind {
        "R" | "P" => &["name", "type", "of", "at", "axis", "zero"],
        "U" => &["name", "type", "of", "at", "axes"],
        "SS" => &["name", "type", "of", "at", "length"],
        "UPU" => &["name", "type", "of", "at", "axis"],
        "parallelogram" => &["name", "type", "of", "at", "axis", "length"],
        _ => &["name", "type", "of", "at"],
    };
    scope.table(node, &format!("a joint of type {kind}"), allowed)?;
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
    let line = node.line;
    let at = [point(scope, linkage, of[0], &points[0], line)?, point(scope, linkage, of[1], &points[1], line)?];
    let length = || -> Result<Rational> {
        let node = scope.need(&table, "length")?;
        let (number, square, _) = squared(scope, node, "length")?;
        if number.to_f64() <= 0.0 {
            let message = format!("found the length {} of a rod, expected a positive one", number.to_f64());
            return Err(scope.fail(node.line, message));
        }
        Ok(square)
    };
    let pair = match kind {
        "R" => SpacePair::Revolute(axis(scope, &table, &name, of, line)?),
        "P" => SpacePair::Prismatic(axis(scope, &table, &name, of, line)?),
        "U" => {
            let [a, b] = scope.exactly::<2>(scope.need(&table, "axes")?, "axes")?;
            SpacePair::Universal([direction(scope, a, "axes")?, direction(scope, b, "axes")?])
        }
        "SS" => SpacePair::Rod(length()?),
        "SPS" => SpacePair::Leg,
        "UPU" => {
            let [a, b] = scope.exactly::<2>(scope.need(&table, "axis")?, "axis")?;
            SpacePair::UniversalLeg([direction(scope, a, "axis")?, direction(scope, b, "axis")?])
        }
        "parallelogram" => SpacePair::Parallelogram(axes(scope, &table, &name, line)?, length()?),
        _ => SpacePair::Spherical,
    };
    Ok(SpaceJoint { name, pair, of, at, line })
}

/// Reads `axis`: the same numbers in both bodies, or one direction in each, made equally long.
fn axes(scope: &Scope<'_>, table: &Table<'_>, name: &str, line: usize) -> Result<[Vector<Rational>; 2]> {
    let node = scope.need(table, "axis")?;
    let items = scope.list(node, "axis")?;
    if !items.first().is_some_and(|item| matches!(item.value, Value::List(_))) {
        let both = direction(scope, node, "axis")?;
        return Ok([both.clone(), both]);
    }
    let [a, b] = scope.exactly::<2>(node, "axis")?;
    let (a, b) = (direction(scope, a, "axis")?, direction(scope, b, "axis")?);
    let (factor, exact) = root(&Rational::from(&dot(&a, &a) / &dot(&b, &b)));
    if !exact {
        let [a, b] = [&a, &b].map(|v| dot(v, v).to_f64().sqrt());
        let message =
            format!("found axes of lengths {a} and {b} at the joint {name}, expected lengths of rational ratio");
        return Err(scope.fail(line, message));
    }
    Ok([a, b.map(|c| c * &factor)])
}

fn axis(scope: &Scope<'_>, table: &Table<'_>, name: &str, of: [usize; 2], line: usize) -> Result<Axis> {
    let at = axes(scope, table, name, line)?;
    let zero = match table.get("zero") {
        None => references(&at),
        Some(node) => {
            let [a, b] = scope.exactly::<2>(node, "zero")?;
            [direction(scope, a, "zero")?, direction(scope, b, "zero")?]
        }
    };
    if (0..2).any(|side| is_parallel(&at[side], &zero[side])) {
        let message = format!("found a `zero` along the axis of the joint {name}, expected another direction");
        return Err(scope.fail(line, message));
    }
    let sphere = SphereJoint { name: name.to_owned(), of, at, zero, line };
    let (rotation, exact) = turned(&sphere, &Angle::zero());
    scope.note(exact);
    let home = Motion { rotation, translation: std::array::from_fn(|_| Rational::new()) };
    Ok(Axis { sphere, home })
}

fn push(scope: &Scope<'_>, linkage: &mut SpaceLinkage, joint: SpaceJoint) -> Result<()> {
    if linkage.joints.iter().any(|other| other.name == joint.name) {
        let message = format!("found the joint {} twice, expected different names", joint.name);
        return Err(scope.fail(joint.line, message));
    }
    if joint.of[0] == joint.of[1] {
        let body = &linkage.bodies[joint.of[0]].name;
        let message = format!("found the joint {} from the body {body} to itself, expected two bodies", joint.name);
        return Err(scope.fail(joint.line, message));
    }
    linkage.joints.push(joint);
    Ok(())
}

/// Checks that every body is joined to the ground, possibly through others.
fn joined(scope: &Scope<'_>, linkage: &SpaceLinkage) -> Result<()> {
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

/// The motion of the second body of a joint against the first, and whether it is exact.
fn moved(joint: &SpaceJoint, rotation: [[Rational; 3]; 3], way: &Vector<Rational>) -> Motion<Rational> {
    let middle = Motion { rotation, translation: std::array::from_fn(|_| Rational::new()) };
    let back = joint.at[1].each_ref().map(|c| Rational::from(-c));
    let start: Vector<Rational> = std::array::from_fn(|k| Rational::from(&joint.at[0][k] + &way[k]));
    Motion::translation(start).then_after(&middle).then_after(&Motion::translation(back))
}

/// The given value of a joint, and whether it is exact.
fn given(linkage: &SpaceLinkage, joint: usize, value: &InputValue, line: usize) -> Result<(SpaceGiven, bool)> {
    let own = &linkage.joints[joint];
    let (known, size, exact) = match (&own.pair, value) {
        (SpacePair::Revolute(axis), InputValue::Angle(angle)) => {
            let (rotation, exact) = turned(&axis.sphere, angle);
            let still = std::array::from_fn(|_| Rational::new());
            (Known::Motion(Box::new(moved(own, rotation, &still))), angle.radians(), exact)
        }
        (SpacePair::Prismatic(axis), InputValue::Distance(distance)) => {
            let along = &axis.sphere.at[0];
            let (part, exact) = part_of(distance, &dot(along, along));
            let way = along.each_ref().map(|c| Rational::from(c * &part));
            (Known::Motion(Box::new(moved(own, axis.home.rotation.clone(), &way))), distance.to_f64(), exact)
        }
        (SpacePair::Leg | SpacePair::UniversalLeg(_), InputValue::Distance(distance)) => {
            let square = distance.squared();
            (Known::Square(square.rational().clone()), distance.to_f64(), square.is_exact())
        }
        (SpacePair::Revolute(_) | SpacePair::Prismatic(_) | SpacePair::Leg | SpacePair::UniversalLeg(_), _) => {
            let wanted = if own.is_distance() == Some(true) { "a distance" } else { "an angle" };
            return Err(Error::Invalid(format!(
                "found a value of another kind for the joint {}, expected {wanted}",
                own.name
            )));
        }
        _ => {
            let message = format!(
                "found the joint {} of type {} as an input, expected R, P, SPS or UPU",
                own.name,
                own.pair.word()
            );
            return Err(Error::Invalid(message));
        }
    };
    Ok((SpaceGiven { of: own.of, known, joint: Some(joint), value: Some(size), line }, exact))
}

/// A distance in parts of a vector with this square, and whether that is exact.
fn part_of(distance: &Number, square: &Rational) -> (Rational, bool) {
    let own = distance.squared();
    if own.is_exact() {
        let (part, exact) = root(&Rational::from(own.rational() / square));
        if exact {
            return (if distance.to_f64() < 0.0 { -part } else { part }, true);
        }
    }
    (distance.rational() / root(square).0, false)
}

/// Reads the value of a joint, a number or a table.
fn value_of(scope: &Scope<'_>, linkage: &SpaceLinkage, joint: usize, node: &Node) -> Result<InputValue> {
    let own = &linkage.joints[joint];
    if matches!(node.value, Value::Table(_)) {
        let keys = ["angle", "tan_half", "distance"];
        return value_in(scope, own, &scope.table(node, &own.name, &keys)?);
    }
    match own.is_distance() {
        Some(true) => Ok(InputValue::Distance(length(scope, node)?)),
        Some(false) => Ok(InputValue::Angle(scope.angle(node, &own.name)?)),
        None => Err(without_value(scope, own, node.line)),
    }
}

/// A length whose square may be all that matters: it does not count as rounded here.
fn length(scope: &Scope<'_>, node: &Node) -> Result<Number> {
    Scope::new(scope.path, scope.reading.clone()).length(node, "distance")
}

fn without_value(scope: &Scope<'_>, joint: &SpaceJoint, line: usize) -> Error {
    let word = joint.pair.word();
    scope.fail(
        line,
        format!("found an input of the joint {} of type {word}, expected one of type R, P, SPS or UPU", joint.name),
    )
}

fn value_in(scope: &Scope<'_>, joint: &SpaceJoint, table: &Table<'_>) -> Result<InputValue> {
    let Some(is_distance) = joint.is_distance() else { return Err(without_value(scope, joint, table.line())) };
    match (table.get("angle"), table.get("tan_half"), table.get("distance")) {
        (Some(node), None, None) if !is_distance => Ok(InputValue::Angle(scope.angle(node, "angle")?)),
        (None, Some(node), None) if !is_distance => Ok(InputValue::Angle(scope.half_tangent(node, "tan_half")?)),
        (None, None, Some(node)) if is_distance => Ok(InputValue::Distance(length(scope, node)?)),
        _ => {
            let wanted = if is_distance { "`distance`" } else { "exactly one of `angle` and `tan_half`" };
            Err(scope.fail(
                table.line(),
                format!("found an input of the joint {} without {wanted}, expected one", joint.name),
            ))
        }
    }
}

/// Reads an `[[input]]`.
fn case(scope: &Scope<'_>, node: &Node, linkage: &SpaceLinkage) -> Result<SpaceCase> {
    let keys =
        ["joint", "angle", "tan_half", "distance", "given", "body", "quaternion", "position", "expected", "solution"];
    let table = scope.table(node, "[[input]]", &keys)?;
    let line = table.line();
    let (mut list, mut exact) = (Vec::new(), true);
    let mut add = |joint: usize, value: InputValue, line: usize| -> Result<()> {
        let (one, is_exact) = given(linkage, joint, &value, line).map_err(|error| error.at(scope.path, line))?;
        list.push(one);
        exact &= is_exact;
        Ok(())
    };
    if let Some(node) = table.get("given") {
        for field in fields(scope, node, "given")? {
            let joint = joint_named(scope, linkage, &field.key, field.line)?;
            add(joint, value_of(scope, linkage, joint, &field.node)?, field.line)?;
        }
    }
    match (table.get("joint"), table.get("body")) {
        (Some(node), None) => {
            let joint = joint_named(scope, linkage, scope.text(node, "joint")?, node.line)?;
            add(joint, value_in(scope, &linkage.joints[joint], &table)?, node.line)?;
        }
        (None, Some(node)) => {
            let index = body(scope, linkage, node)?;
            if index == linkage.ground {
                return Err(scope.fail(node.line, "found the ground as the `body` of an input, expected another body"));
            }
            let rotation = scope.rotation_quaternion(scope.need(&table, "quaternion")?)?;
            let position = scope.vector(scope.need(&table, "position")?, Quantity::Length, "position")?;
            exact &= position.iter().all(Number::is_exact);
            let translation = position.each_ref().map(|c| c.rational().clone());
            let known = Known::Motion(Box::new(Motion { rotation, translation }));
            list.push(SpaceGiven { of: [linkage.ground, index], known, joint: None, value: None, line: node.line });
        }
        (None, None) if !list.is_empty() => {}
        _ => {
            let message = "found an [[input]] without exactly one of `joint`, `body` and `given`, expected one";
            return Err(scope.fail(line, message));
        }
    }
    for (k, one) in list.iter().enumerate() {
        if let Some(joint) = one.joint.filter(|_| list[..k].iter().any(|other| other.joint == one.joint)) {
            let message = format!("found the joint {} given twice, expected once", linkage.joints[joint].name);
            return Err(scope.fail(one.line, message));
        }
    }
    Ok(SpaceCase { given: list, exact, expected: claims(scope, &table, linkage)?, line })
}

impl SpaceFile {
    /// Returns the first case with these values in place of those of the same joints, or beside them.
    ///
    /// # Errors
    /// For unknown joints and values of another kind than that of their joint.
    pub fn case_at(&self, values: &[(String, InputValue)]) -> Result<SpaceCase> {
        let mut case = SpaceCase { expected: SpaceClaims::default(), ..self.cases[0].clone() };
        for (name, value) in values {
            let joints = &self.linkage.joints;
            let joint = joints.iter().position(|joint| joint.name == *name).ok_or_else(|| {
                let known: Vec<&str> = joints.iter().take(12).map(|joint| joint.name.as_str()).collect();
                let name: String = name.chars().take(40).collect();
                Error::Invalid(format!(
                    "found the unknown joint `{name}` as an input, expected one of {}",
                    known.join(", ")
                ))
            })?;
            let (one, exact) = given(&self.linkage, joint, value, case.line)?;
            case.given.retain(|other| other.joint != Some(joint));
            case.given.push(one);
            case.exact &= exact;
        }
        Ok(case)
    }

    /// Returns the given value of a joint by its number: radians or metres.
    ///
    /// # Errors
    /// For joints without a value.
    pub fn driven(&self, joint: usize, value: f64) -> Result<SpaceGiven> {
        let value = match self.linkage.joints[joint].is_distance() {
            Some(true) => InputValue::Distance(Number::from_f64(value)),
            _ => InputValue::Angle(Angle::from_radians(value)),
        };
        given(&self.linkage, joint, &value, self.cases[0].line).map(|(given, _)| given)
    }

    /// Returns whether the value of a joint is a distance; `None` for unknown joints and those without a value.
    #[must_use]
    pub fn is_distance(&self, name: &str) -> Option<bool> {
        self.linkage.joints.iter().find(|joint| joint.name == name)?.is_distance()
    }
}

/// Reads the claims beside a case or at the top of the file.
fn claims(scope: &Scope<'_>, table: &Table<'_>, linkage: &SpaceLinkage) -> Result<SpaceClaims> {
    let mut found = SpaceClaims::default();
    // Claims are compared in f64, so rounding them does not make the mechanism inexact.
    let own = Scope::new(scope.path, scope.reading.clone());
    if let Some(node) = table.get("expected") {
        let keys = ["complex", "real", "dimension", "groups"];
        let claims = own.table(node, "the [expected] of a linkage in space", &keys)?;
        let count = |key: &str| claims.get(key).map(|node| own.count(node, key)).transpose();
        (found.complex, found.real, found.dimension) = (count("complex")?, count("real")?, count("dimension")?);
        if let Some(list) = claims.get("groups") {
            let list = own.list(list, "groups")?;
            found.groups = Some(list.iter().map(|node| own.count(node, "groups")).collect::<Result<_>>()?);
        }
    }
    let Some(list) = table.get("solution") else { return Ok(found) };
    for node in own.list(list, "solution")? {
        let table = own.table(node, "[[solution]]", &["joints", "bodies", "digits"])?;
        let mut claim = SpaceClaim { digits: digits(&own, &table)?, line: node.line, ..SpaceClaim::default() };
        for field in table.get("joints").map_or(Ok(&[][..]), |list| fields(&own, list, "joints"))? {
            let joint = joint_named(&own, linkage, &field.key, field.line)?;
            let value = match linkage.joints[joint].is_distance() {
                Some(true) => own.length(&field.node, &field.key)?.to_f64(),
                _ => own.radians(&field.node, &field.key)?,
            };
            claim.joints.push((joint, value));
        }
        for field in table.get("bodies").map_or(Ok(&[][..]), |list| fields(&own, list, "bodies"))? {
            let index = body_named(&own, linkage, &field.key, field.line)?;
            let place = own.table(&field.node, &field.key, &["quaternion", "position"])?;
            let mut quaternion = None;
            if let Some(node) = place.get("quaternion") {
                let mut q = [0.0; 4];
                for (part, node) in q.iter_mut().zip(own.exactly::<4>(node, "quaternion")?) {
                    *part = own.number(node, Quantity::Ratio, "quaternion")?.to_f64();
                }
                quaternion = Some(q);
            }
            let position = match place.get("position") {
                Some(node) => Some(own.vector(node, Quantity::Length, "position")?.each_ref().map(Number::to_f64)),
                None => None,
            };
            claim.bodies.push((index, quaternion, position));
        }
        if claim.joints.is_empty() && claim.bodies.is_empty() {
            return Err(own.fail(node.line, "found a [[solution]] without `joints` and `bodies`, expected one of them"));
        }
        found.solutions.push(claim);
    }
    Ok(found)
}
