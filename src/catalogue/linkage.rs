//! Linkages: bodies with named points, the joints between them, and the inputs.

use super::heading::{Heading, heading_with};
use super::job::digits;
use super::linkage_configuration::{LinkageConfiguration, configuration};
use super::masses::{Masses, masses};
use super::node::{Field, Node, Value};
use super::scope::{Scope, Table, nearest};
use crate::algebra::number::{Angle, Number, Quantity, Reading};
use crate::algebra::ring::{Ring, exact_cos_sin};
use crate::algebra::sort;
use crate::error::Result;
use crate::kinematics::linkage::{Accuracy, Bar, Body, Gaussian, Given, Linkage, LinkageJoint, Pair};
use rug::{Integer, Rational};
use std::collections::{HashMap, HashSet};

/// Maximum number of bodies: beyond any mechanism, and few enough to search for groups in seconds.
const MOST_BODIES: usize = 10_000;

/// A linkage file as read.
#[derive(Clone, Debug)]
pub struct LinkageFile {
    /// Title, source and remarks.
    pub heading: Heading,
    /// Its bodies and joints.
    pub linkage: Linkage,
    /// The problems, one for every `[[input]]`; without any the linkage is a structure.
    pub cases: Vec<LinkageCase>,
    /// Claims about curves of points.
    pub traces: Vec<TraceClaim>,
    /// Whether every number of bodies and joints is exact.
    pub exact: bool,
    /// Whether lengths of bars were rounded whose squares are exact, and all other numbers of bodies and joints are exact.
    pub squared: bool,
    /// Where the bodies stand, for questions about one assembly.
    pub configuration: Option<LinkageConfiguration>,
    /// Masses and gravity.
    pub masses: Masses,
    /// The interpretation of numbers in the file.
    pub reading: Reading,
}

impl LinkageFile {
    /// Returns what is known of all numbers of a case.
    #[must_use]
    pub fn accuracy(&self, case: &LinkageCase) -> Accuracy {
        match (self.exact, self.squared) {
            (true, _) => case.accuracy,
            (false, true) => case.accuracy.and(Accuracy::Squared),
            (false, false) => Accuracy::Rounded,
        }
    }

    /// Returns the given values of a case, and what is known of these and of the numbers of the linkage.
    #[must_use]
    pub fn given<'c>(&self, case: &'c LinkageCase) -> (&'c [Given], Accuracy) {
        (&case.given, self.accuracy(case))
    }
}

/// A claim about the curve of a point.
#[derive(Clone, Debug, PartialEq)]
pub struct TraceClaim {
    /// The body of the point.
    pub body: usize,
    /// Its name and its position in the body.
    pub point: (String, Gaussian),
    /// The degree of the curve.
    pub degree: u64,
    /// Line of the file, from 1.
    pub line: usize,
}

/// One problem of a linkage.
#[derive(Clone, Debug)]
pub struct LinkageCase {
    /// The given values.
    pub given: Vec<Given>,
    /// What is known of them.
    pub accuracy: Accuracy,
    /// The claims.
    pub expected: LinkageClaims,
    /// Line of the file at which the case begins, from 1.
    pub line: usize,
}

/// Claims about a case, every one optional.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinkageClaims {
    /// Isolated complex assemblies, with multiplicity.
    pub complex: Option<usize>,
    /// Isolated real assemblies.
    pub real: Option<usize>,
    /// Dimension of the largest set of assemblies.
    pub dimension: Option<usize>,
    /// Assemblies of every group, in the order in which they are solved.
    pub groups: Option<Vec<usize>>,
    /// Assemblies that must be among those found.
    pub solutions: Vec<LinkageClaim>,
}

/// A claimed assembly.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkageClaim {
    /// Joints with their values, radians or metres.
    pub joints: Vec<(usize, f64)>,
    /// Bodies with their angles and the positions of their origins relative to the ground, as far as claimed.
    pub bodies: Vec<(usize, Option<f64>, Option<[f64; 2]>)>,
    /// Correct decimal digits.
    pub digits: u32,
    /// Line of the file, from 1.
    pub line: usize,
}

/// Returns where a linkage file states that it lives: in the plane, on the sphere or in space.
pub(super) fn lives_in(root: &Node) -> Option<String> {
    let get = |node: &Node, key: &str| match &node.value {
        Value::Table(fields) => fields.iter().find(|field| field.key == key).map(|field| field.node.clone()),
        _ => None,
    };
    match get(root, "mechanism").and_then(|mechanism| get(&mechanism, "space"))?.value {
        Value::Text(word) => Some(word),
        _ => None,
    }
}

/// Reads a linkage file.
pub(super) fn linkage(scope: &mut Scope<'_>, root: &Node, name: &str) -> Result<LinkageFile> {
    let heading = heading_with(scope, root, name, &["input", "solution", "trace", "configuration"])?;
    let keys =
        ["title", "source", "notes", "units", "mechanism", "configuration", "expected", "input", "solution", "trace"];
    let table = scope.table(root, "the file", &keys)?;
    let node = scope.need(&table, "mechanism")?;
    let keys = ["kind", "space", "ground", "joints", "bodies", "mass", "gravity"];
    let mechanism = scope.table(node, "the [mechanism] of a linkage", &keys)?;
    scope.word(scope.need(&mechanism, "space")?, "space", &["plane", "sphere", "space"])?;
    let mut reader = Reader {
        scope,
        bodies: Vec::new(),
        places: HashMap::new(),
        joints: Vec::new(),
        names: HashSet::new(),
        bars: Vec::new(),
    };
    reader.bodies(scope.need(&mechanism, "bodies")?)?;
    let ground = reader.body(scope.need(&mechanism, "ground")?)?;
    reader.joints(scope.need(&mechanism, "joints")?, ground)?;
    let linkage = Linkage { ground, bodies: reader.bodies, joints: reader.joints, bars: reader.bars };
    joined(scope, &linkage)?;
    joined_once(scope, &linkage)?;
    let squared = !scope.is_rounded();
    let exact = squared && linkage.bars.is_empty();
    let mut cases = Vec::new();
    if let Some(inputs) = table.get("input") {
        for input in scope.list(inputs, "input")? {
            cases.push(case(scope, input, &linkage)?);
        }
    }
    // An empty list of inputs is one of a structure, as none is.
    if cases.is_empty() {
        let line = mechanism.line();
        cases.push(LinkageCase {
            given: Vec::new(),
            accuracy: Accuracy::Exact,
            expected: LinkageClaims::default(),
            line,
        });
    }
    // Claims at the top of a file concern its first case.
    let top = claims(scope, &table, &linkage)?;
    if let (Some(first), true) = (cases.first_mut(), top != LinkageClaims::default()) {
        if first.expected != LinkageClaims::default() {
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
    let configuration = table.get("configuration").map(|node| configuration(scope, node, &linkage)).transpose()?;
    let masses = masses(scope, &mechanism, &linkage)?;
    Ok(LinkageFile {
        heading,
        linkage,
        cases,
        traces,
        exact,
        squared,
        configuration,
        masses,
        reading: scope.reading.clone(),
    })
}

/// Reads a claim about the curve of a point, `BODY.POINT`.
fn traced(scope: &Scope<'_>, node: &Node, linkage: &Linkage) -> Result<TraceClaim> {
    let table = scope.table(node, "[[trace]]", &["point", "degree"])?;
    let point = scope.need(&table, "point")?;
    let text = scope.text(point, "point")?;
    let Some((body, name)) = text.split_once('.') else {
        return Err(scope.fail(point.line, format!("found the point `{text}`, expected BODY.POINT")));
    };
    let body = body_named(scope, linkage, body, point.line)?;
    let Some(place) = linkage.bodies[body].point(name) else {
        return Err(scope.fail(point.line, format!("found the point `{text}`, which that body does not have")));
    };
    let degree = scope.count(scope.need(&table, "degree")?, "degree")? as u64;
    Ok(TraceClaim { body, point: (name.to_owned(), place.clone()), degree, line: table.line() })
}

/// Checks that no two R joints of the same bodies stand at one point of either body: the second says nothing, or contradicts the first.
fn joined_once(scope: &Scope<'_>, linkage: &Linkage) -> Result<()> {
    let mut between: HashMap<[usize; 2], Vec<&LinkageJoint>> = HashMap::new();
    for joint in linkage.joints.iter().filter(|joint| matches!(joint.pair, Pair::Revolute)) {
        let [a, b] = joint.of;
        let known = between.entry([a.min(b), a.max(b)]).or_default();
        for other in known.iter() {
            let at = |joint: &LinkageJoint, body: usize| joint.at[usize::from(joint.of[0] != body)].clone();
            if let Some(body) = [a, b].into_iter().find(|body| at(joint, *body) == at(other, *body)) {
                let [one, two, at] = [a, b, body].map(|body| &linkage.bodies[body].name);
                let message = format!(
                    "found the joints {} and {} between {one} and {two} at the same point of {at}, expected different points",
                    other.name, joint.name
                );
                return Err(scope.fail(joint.line, message));
            }
        }
        known.push(joint);
    }
    Ok(())
}

/// Checks that every body is joined to the ground, possibly through others.
fn joined(scope: &Scope<'_>, linkage: &Linkage) -> Result<()> {
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); linkage.bodies.len()];
    for joint in linkage.joints.iter().filter(|joint| !joint.is_gear()) {
        let [a, b] = joint.of;
        around[a].push(b);
        around[b].push(a);
    }
    let mut seen = vec![false; linkage.bodies.len()];
    let mut open = vec![linkage.ground];
    seen[linkage.ground] = true;
    while let Some(body) = open.pop() {
        for other in &around[body] {
            if !std::mem::replace(&mut seen[*other], true) {
                open.push(*other);
            }
        }
    }
    match linkage.bodies.iter().zip(seen).find(|(_, seen)| !seen) {
        None => Ok(()),
        Some((body, _)) => {
            let ground = &linkage.bodies[linkage.ground].name;
            let message = format!("found no joints from the body {} to the ground {ground}, expected some", body.name);
            Err(scope.fail(body.line, message))
        }
    }
}

/// The parts of the linkage read so far.
struct Reader<'a, 's> {
    scope: &'a Scope<'s>,
    bodies: Vec<Body>,
    places: HashMap<String, usize>,
    joints: Vec<LinkageJoint>,
    names: HashSet<String>,
    bars: Vec<Bar>,
}

impl Reader<'_, '_> {
    fn bodies(&mut self, node: &Node) -> Result<()> {
        let Value::Table(fields) = &node.value else {
            let message = format!("found {} as `bodies`, expected a table of bodies", node.describe());
            return Err(self.scope.fail(node.line, message));
        };
        if fields.len() > MOST_BODIES {
            let message = format!("found {} bodies, expected at most {MOST_BODIES}", fields.len());
            return Err(self.scope.fail(node.line, message));
        }
        for Field { key, node, line } in fields {
            let Value::Table(points) = &node.value else {
                let message = format!("found {} as the body {key}, expected a table of points", node.describe());
                return Err(self.scope.fail(*line, message));
            };
            let mut places = Vec::with_capacity(points.len());
            for point in points {
                places.push((point.key.clone(), self.point(&point.node, &format!("{key}.{}", point.key))?));
            }
            self.add(Body { name: key.clone(), points: places, line: *line });
        }
        Ok(())
    }

    fn add(&mut self, body: Body) -> usize {
        // A bar or a pin with the name of a body of the file does not take its place.
        self.places.entry(body.name.clone()).or_insert(self.bodies.len());
        self.bodies.push(body);
        self.bodies.len() - 1
    }

    /// Reads a point: two coordinates, or one on the x axis.
    fn point(&self, node: &Node, what: &str) -> Result<Gaussian> {
        let scope = self.scope;
        if let Value::List(_) = &node.value {
            let [x, y] = scope.exactly::<2>(node, what)?;
            let (x, y) = (scope.length(x, what)?, scope.length(y, what)?);
            return Ok(Gaussian { re: x.rational().clone(), im: y.rational().clone() });
        }
        Ok(Gaussian { re: scope.length(node, what)?.rational().clone(), im: Rational::new() })
    }

    fn body(&self, node: &Node) -> Result<usize> {
        let name = self.scope.text(node, "a body")?;
        self.places.get(name).copied().ok_or_else(|| {
            let near = nearest(name, self.bodies.iter().map(|body| body.name.as_str()));
            let known: Vec<&str> = self.bodies.iter().take(12).map(|body| body.name.as_str()).collect();
            let hint = near.first().map_or_else(
                || format!("expected one of {}", known.join(", ")),
                |near| format!("did you mean {near}?"),
            );
            let name: String = name.chars().take(40).collect();
            self.scope.fail(node.line, format!("found the unknown body `{name}`; {hint}"))
        })
    }

    fn joints(&mut self, node: &Node, ground: usize) -> Result<()> {
        if let Value::Text(word) = &node.value {
            if word != "shared points" {
                let message =
                    "found a string as `joints` that is not \"shared points\", expected that or a list of joints";
                return Err(self.scope.fail(node.line, message));
            }
            return self.shared(node.line, ground);
        }
        let items = self.scope.list(node, "joints")?;
        for item in items {
            self.joint(item)?;
        }
        Ok(())
    }

    /// Adds a joint at every point name that several bodies share, between the first of them and each other one.
    fn shared(&mut self, line: usize, ground: usize) -> Result<()> {
        let mut order: Vec<usize> = (0..self.bodies.len()).collect();
        sort::by_key(&mut order, |body| *body != ground);
        let mut points: Vec<(String, Vec<usize>)> = Vec::new();
        let mut at: HashMap<String, usize> = HashMap::new();
        for body in order {
            for (name, _) in &self.bodies[body].points {
                let index = *at.entry(name.clone()).or_insert_with(|| {
                    points.push((name.clone(), Vec::new()));
                    points.len() - 1
                });
                points[index].1.push(body);
            }
        }
        let taken: HashSet<String> = points.iter().map(|(name, _)| name.clone()).collect();
        for (point, bodies) in points {
            let mut number = 1;
            for other in &bodies[1..] {
                let mut name = point.clone();
                // A second joint at A is A2, unless a point has that name.
                if number > 1 {
                    name = format!("{point}{number}");
                    while taken.contains(&name) {
                        number += 1;
                        name = format!("{point}{number}");
                    }
                }
                number += 1;
                let of = [bodies[0], *other];
                let at = [self.place(of[0], &point, line)?, self.place(of[1], &point, line)?];
                self.push(LinkageJoint { name, pair: Pair::Revolute, of, at, line })?;
            }
        }
        Ok(())
    }

    fn place(&self, body: usize, point: &str, line: usize) -> Result<Gaussian> {
        let body = &self.bodies[body];
        body.point(point).cloned().ok_or_else(|| {
            let point: String = point.chars().take(40).collect();
            let known: Vec<&str> = body.points.iter().take(12).map(|(name, _)| name.as_str()).collect();
            let message = format!(
                "found no point `{point}` in the body {}, which has {}; expected one",
                body.name,
                known.join(", ")
            );
            self.scope.fail(line, message)
        })
    }

    fn push(&mut self, joint: LinkageJoint) -> Result<()> {
        if !self.names.insert(joint.name.clone()) {
            let message = format!("found the joint {} twice, expected different names", joint.name);
            return Err(self.scope.fail(joint.line, message));
        }
        if joint.of[0] == joint.of[1] {
            let body = &self.bodies[joint.of[0]].name;
            let message = format!("found the joint {} from the body {body} to itself, expected two bodies", joint.name);
            return Err(self.scope.fail(joint.line, message));
        }
        self.joints.push(joint);
        Ok(())
    }

    fn joint(&mut self, node: &Node) -> Result<()> {
        let keys = ["name", "type", "of", "at", "along", "length", "carrier", "ratio", "phase"];
        let scope = self.scope;
        let table = scope.table(node, "a joint", &keys)?;
        let name = scope.text(scope.need(&table, "name")?, "name")?.to_owned();
        let [first, second] = scope.exactly::<2>(scope.need(&table, "of")?, "of")?;
        let of = [self.body(first)?, self.body(second)?];
        let line = node.line;
        let kind = scope.need(&table, "type")?;
        let kind = scope.word(kind, "type", &["R", "P", "gear", "RR", "RPR", "PR"])?;
        let allowed: &[&str] = match kind {
            "P" | "PR" => &["name", "type", "of", "at", "along"],
            "gear" => &["name", "type", "of", "carrier", "ratio", "phase"],
            "RR" => &["name", "type", "of", "at", "length"],
            _ => &["name", "type", "of", "at"],
        };
        scope.table(node, &format!("a joint of type {kind}"), allowed)?;
        if kind == "gear" {
            return self.gear(&table, name, of, line);
        }
        let points = match table.get("at").map(|node| (node, &node.value)) {
            None => [name.clone(), name.clone()],
            Some((_, Value::Text(point))) => [point.clone(), point.clone()],
            Some((node, _)) => {
                let [a, b] = scope.exactly::<2>(node, "at")?;
                [scope.text(a, "at")?.to_owned(), scope.text(b, "at")?.to_owned()]
            }
        };
        let at = [self.place(of[0], &points[0], line)?, self.place(of[1], &points[1], line)?];
        let origin = || Gaussian { re: Rational::new(), im: Rational::new() };
        let x_axis = || Gaussian { re: Rational::from(1), im: Rational::new() };
        let revolute =
            |name: String, of: [usize; 2], at: [Gaussian; 2]| LinkageJoint { name, pair: Pair::Revolute, of, at, line };
        let straight = |along: Gaussian, length: Rational| Pair::Prismatic { turn: x_axis(), along, length };
        let [first_at, second_at] = at.clone();
        match kind {
            "P" => {
                let pair = self.prismatic(scope.need(&table, "along")?)?;
                self.push(LinkageJoint { name, pair, of, at, line })
            }
            "PR" => {
                let (along, length) = self.direction(scope.need(&table, "along")?)?;
                let pin = self.add(Body { name: name.clone(), points: vec![("pin".to_owned(), origin())], line });
                let slot = straight(along, length);
                self.push(LinkageJoint {
                    name: name.clone(),
                    pair: slot,
                    of: [of[0], pin],
                    at: [first_at, origin()],
                    line,
                })?;
                self.push(revolute(format!("{name}.pin"), [pin, of[1]], [origin(), second_at]))
            }
            "RR" => {
                let node = scope.need(&table, "length")?;
                let length = scope.rooted(node, "length")?;
                if *length.rational() <= 0 {
                    return Err(scope.fail(
                        node.line,
                        format!("found the length {} of a bar, expected a positive one", length.to_f64()),
                    ));
                }
                let end = Gaussian { re: length.rational().clone(), im: Rational::new() };
                let points = vec![("first".to_owned(), origin()), ("second".to_owned(), end.clone())];
                let bar = self.add(Body { name: name.clone(), points, line });
                if !length.is_exact() && length.squared().is_exact() {
                    let square = length.squared().rational().clone();
                    self.bars.push(Bar { bodies: vec![bar], length: length.rational().clone(), square });
                }
                self.push(revolute(format!("{name}.first"), [of[0], bar], [first_at, origin()]))?;
                self.push(revolute(format!("{name}.second"), [bar, of[1]], [end, second_at]))
            }
            "RPR" => {
                let end = |name: String| Body { name, points: vec![("end".to_owned(), origin())], line };
                let (lower, upper) = (self.add(end(format!("{name}.lower"))), self.add(end(format!("{name}.upper"))));
                self.push(revolute(format!("{name}.first"), [of[0], lower], [first_at, origin()]))?;
                let leg = straight(x_axis(), Rational::from(1));
                self.push(LinkageJoint {
                    name: name.clone(),
                    pair: leg,
                    of: [lower, upper],
                    at: [origin(), origin()],
                    line,
                })?;
                self.push(revolute(format!("{name}.second"), [upper, of[1]], [origin(), second_at]))
            }
            _ => self.push(LinkageJoint { name, pair: Pair::Revolute, of, at, line }),
        }
    }

    /// Reads a direction that is not zero, and its length.
    fn direction(&self, node: &Node) -> Result<(Gaussian, Rational)> {
        let [x, y] = self.scope.exactly::<2>(node, "along")?;
        let number = |node: &Node| self.scope.number(node, Quantity::Ratio, "along");
        let (x, y) = (number(x)?, number(y)?);
        let square = Rational::from(x.rational().square_ref()) + Rational::from(y.rational().square_ref());
        if square == 0 {
            return Err(self.scope.fail(node.line, "found the direction [0, 0] as `along`, expected another one"));
        }
        Ok((Gaussian { re: x.rational().clone(), im: y.rational().clone() }, root(&square).0))
    }

    fn prismatic(&self, node: &Node) -> Result<Pair> {
        let scope = self.scope;
        let items = scope.list(node, "along")?;
        if !items.first().is_some_and(|item| matches!(item.value, Value::List(_))) {
            let (along, length) = self.direction(node)?;
            return Ok(Pair::Prismatic { turn: Gaussian::one(), along, length });
        }
        let [first, second] = scope.exactly::<2>(node, "along")?;
        let ((along, length), (other, _)) = (self.direction(first)?, self.direction(second)?);
        // The rotation that takes the second direction to the first.
        let quotient = along.mul(&Gaussian { re: other.re.clone(), im: Rational::from(-&other.im) });
        let square = Rational::from(quotient.re.square_ref()) + Rational::from(quotient.im.square_ref());
        let (norm, exact) = root(&square);
        let turn = if exact {
            Gaussian { re: quotient.re / &norm, im: quotient.im / norm }
        } else {
            // Tangent of half the angle, to 30 digits: the rotation has norm 1 in any case.
            scope.note(false);
            let length = norm + &quotient.re;
            if length == 0 {
                Gaussian { re: Rational::from(-1), im: Rational::new() }
            } else {
                let tangent = quotient.im / length;
                let square = Rational::from(tangent.square_ref());
                let whole = Rational::from(&square + 1);
                Gaussian { re: (1 - square) / &whole, im: tangent * 2 / whole }
            }
        };
        Ok(Pair::Prismatic { turn, along, length })
    }

    fn gear(&mut self, table: &Table<'_>, name: String, of: [usize; 2], line: usize) -> Result<()> {
        let scope = self.scope;
        let carrier = self.body(scope.need(table, "carrier")?)?;
        let node = scope.need(table, "ratio")?;
        let ratio = scope.number(node, Quantity::Ratio, "ratio")?;
        if !ratio.is_exact() {
            let message = format!("found the irrational ratio {} of gears, expected a rational one", ratio.to_f64());
            return Err(scope.fail(node.line, message));
        }
        if *ratio.rational() == 0 {
            return Err(scope.fail(node.line, "found the ratio 0 of gears, expected another one"));
        }
        let phase = match table.get("phase") {
            None => Gaussian::one(),
            Some(node) => self.turn(node, "phase")?.0,
        };
        let zero = Gaussian { re: Rational::new(), im: Rational::new() };
        let pair = Pair::Gear { carrier, ratio: ratio.rational().clone(), phase };
        self.push(LinkageJoint { name, pair, of, at: [zero.clone(), zero], line })
    }

    fn turn(&self, node: &Node, what: &str) -> Result<(Gaussian, bool)> {
        Ok(rotation(&angle(self.scope, node, what)?))
    }
}

/// Returns the square root of a positive rational number, and whether it is exact; else it is right to 30 digits.
pub(crate) fn root(square: &Rational) -> (Rational, bool) {
    let (numerator, denominator) = (square.numer(), square.denom());
    if numerator.is_perfect_square() && denominator.is_perfect_square() {
        let root = |n: &Integer| Integer::from(n.sqrt_ref());
        return (Rational::from((root(numerator), root(denominator))), true);
    }
    let scale = Integer::from(Integer::u_pow_u(10, 60));
    let whole = Integer::from(numerator * &scale) / denominator;
    (Rational::from((whole.sqrt(), Integer::from(Integer::u_pow_u(10, 30)))), false)
}

/// Returns an angle as a rotation, and whether it is exact.
pub(super) fn rotation(angle: &Angle) -> (Gaussian, bool) {
    let (re, im) = exact_cos_sin(angle);
    (Gaussian { re, im }, angle.is_exact())
}

/// Reads an angle, or a table with `angle` or `tan_half`.
fn angle(scope: &Scope<'_>, node: &Node, what: &str) -> Result<Angle> {
    if !matches!(node.value, Value::Table(_)) {
        return scope.angle(node, what);
    }
    angle_of(scope, &scope.table(node, what, &["angle", "tan_half"])?, what)
}

/// Returns the angle of a table with `angle` or `tan_half`.
pub(super) fn angle_of(scope: &Scope<'_>, table: &Table<'_>, what: &str) -> Result<Angle> {
    match (table.get("angle"), table.get("tan_half")) {
        (Some(node), None) => scope.angle(node, "angle"),
        (None, Some(node)) => scope.half_tangent(node, "tan_half"),
        _ => Err(scope
            .fail(table.line(), format!("found `{what}` without exactly one of `angle` and `tan_half`, expected one"))),
    }
}

/// Returns the given angle of a revolute joint, and whether it is exact.
pub(super) fn given_turn(joint: usize, angle: &Angle, line: usize) -> (Given, bool) {
    let (turn, exact) = rotation(angle);
    let within = angle.enclosed().filter(|_| !exact).map(|pair| Box::new(pair.clone()));
    (Given::Turn { joint, turn, within, line }, exact)
}

/// Reads a length, or a table with `distance`.
fn distance(scope: &Scope<'_>, node: &Node, what: &str) -> Result<Number> {
    if !matches!(node.value, Value::Table(_)) {
        return scope.length(node, what);
    }
    let table = scope.table(node, what, &["distance"])?;
    scope.length(scope.need(&table, "distance")?, "distance")
}

fn joint_named(scope: &Scope<'_>, linkage: &Linkage, name: &str, line: usize) -> Result<usize> {
    linkage.joints.iter().position(|joint| joint.name == name).ok_or_else(|| {
        let near = nearest(name, linkage.joints.iter().map(|joint| joint.name.as_str()));
        let known: Vec<&str> = linkage.joints.iter().take(12).map(|joint| joint.name.as_str()).collect();
        let hint = near
            .first()
            .map_or_else(|| format!("expected one of {}", known.join(", ")), |near| format!("did you mean {near}?"));
        let name: String = name.chars().take(40).collect();
        scope.fail(line, format!("found the unknown joint `{name}`; {hint}"))
    })
}

pub(super) fn body_named(scope: &Scope<'_>, linkage: &Linkage, name: &str, line: usize) -> Result<usize> {
    linkage.bodies.iter().position(|body| body.name == name).ok_or_else(|| {
        let name: String = name.chars().take(40).collect();
        scope.fail(line, format!("found the unknown body `{name}`, expected one of [mechanism.bodies]"))
    })
}

/// Reads the given value of a joint, and whether it is exact.
fn given_joint(scope: &Scope<'_>, linkage: &Linkage, joint: usize, node: &Node, line: usize) -> Result<(Given, bool)> {
    let own = &linkage.joints[joint];
    if let Pair::Prismatic { along, length, .. } = &own.pair {
        let value = distance(scope, node, &own.name)?;
        let square = Rational::from(along.re.square_ref()) + Rational::from(along.im.square_ref());
        let exact = value.is_exact() && root(&square).1;
        scope.note(exact);
        let square = linkage.leg_square(joint, &value);
        return Ok((Given::Shift { joint, shift: Rational::from(value.rational() / length), square, line }, exact));
    }
    if own.is_gear() {
        return Err(
            scope.fail(line, format!("found an input of the gears {}, expected one of a joint with a value", own.name))
        );
    }
    Ok(given_turn(joint, &angle(scope, node, &own.name)?, line))
}

/// Reads an `[[input]]`.
fn case(scope: &Scope<'_>, node: &Node, linkage: &Linkage) -> Result<LinkageCase> {
    let keys = ["joint", "angle", "tan_half", "distance", "given", "body", "position", "expected", "solution"];
    let table = scope.table(node, "[[input]]", &keys)?;
    let line = table.line();
    let mut given = Vec::new();
    let mut accuracy = Accuracy::Exact;
    let mut add = |(one, is_exact): (Given, bool)| {
        accuracy = accuracy.and(one.accuracy(is_exact));
        given.push(one);
    };
    if let Some(list) = table.get("given") {
        let Value::Table(fields) = &list.value else {
            return Err(
                scope.fail(list.line, format!("found {} as `given`, expected a table of joints", list.describe()))
            );
        };
        for field in fields {
            let joint = joint_named(scope, linkage, &field.key, field.line)?;
            add(given_joint(scope, linkage, joint, &field.node, field.line)?);
        }
    }
    match (table.get("joint"), table.get("body")) {
        (Some(joint), None) => {
            let joint_line = joint.line;
            let joint = joint_named(scope, linkage, scope.text(joint, "joint")?, joint_line)?;
            let own = &linkage.joints[joint];
            let (wanted, others): (&[&str], &[&str]) = if own.is_prismatic() {
                (&["distance"], &["angle", "tan_half"])
            } else {
                (&["angle", "tan_half"], &["distance"])
            };
            let values: Vec<&Node> = wanted.iter().filter_map(|key| table.get(key)).collect();
            let wrong = others.iter().any(|key| table.get(key).is_some());
            let [value] = values.as_slice() else {
                let message = format!(
                    "found an input of the joint {} without exactly one of `{}`, expected one",
                    own.name,
                    wanted.join("`, `")
                );
                return Err(scope.fail(line, message));
            };
            if wrong {
                let message = format!(
                    "found `{}` for the joint {}, expected `{}`",
                    others.join("` or `"),
                    own.name,
                    wanted.join("` or `")
                );
                return Err(scope.fail(line, message));
            }
            let one = if table.get("tan_half").is_some() {
                let angle = scope.half_tangent(value, "tan_half")?;
                if own.is_gear() {
                    return Err(scope.fail(
                        line,
                        format!("found an input of the gears {}, expected a joint with a value", own.name),
                    ));
                }
                given_turn(joint, &angle, joint_line)
            } else {
                given_joint(scope, linkage, joint, value, joint_line)?
            };
            add(one);
        }
        (None, Some(body)) => {
            let index = body_named(scope, linkage, scope.text(body, "body")?, body.line)?;
            if index == linkage.ground {
                return Err(scope.fail(body.line, "found the ground as the `body` of an input, expected another body"));
            }
            let (turn, is_exact) = match (table.get("angle"), table.get("tan_half")) {
                (Some(node), None) => rotation(&scope.angle(node, "angle")?),
                (None, Some(node)) => rotation(&scope.half_tangent(node, "tan_half")?),
                _ => {
                    let message =
                        "found an input of a body without exactly one of `angle` and `tan_half`, expected one";
                    return Err(scope.fail(line, message));
                }
            };
            let [x, y] = scope.exactly::<2>(scope.need(&table, "position")?, "position")?;
            let (x, y) = (scope.length(x, "position")?, scope.length(y, "position")?);
            let origin = Gaussian { re: x.rational().clone(), im: y.rational().clone() };
            let is_exact = is_exact && x.is_exact() && y.is_exact();
            add((Given::Place { body: index, turn, origin, line: body.line }, is_exact));
        }
        (None, None) if !given.is_empty() => {}
        _ => {
            let message = "found an [[input]] without exactly one of `joint`, `body` and `given`, expected one";
            return Err(scope.fail(line, message));
        }
    }
    Ok(LinkageCase { given, accuracy, expected: claims(scope, &table, linkage)?, line })
}

/// Reads the claims beside a case or at the top of the file.
fn claims(scope: &Scope<'_>, table: &Table<'_>, linkage: &Linkage) -> Result<LinkageClaims> {
    let mut found = LinkageClaims::default();
    // Claims are compared in f64, so rounding them does not make the mechanism inexact.
    let own = Scope::new(scope.path, scope.reading.clone());
    if let Some(node) = table.get("expected") {
        let claims = own.table(node, "the [expected] of a linkage", &["complex", "real", "dimension", "groups"])?;
        let count = |key: &str| claims.get(key).map(|node| own.count(node, key)).transpose();
        (found.complex, found.real, found.dimension) = (count("complex")?, count("real")?, count("dimension")?);
        if let Some(list) = claims.get("groups") {
            let list = own.list(list, "groups")?;
            found.groups = Some(list.iter().map(|node| own.count(node, "groups")).collect::<Result<_>>()?);
        }
    }
    let Some(list) = table.get("solution") else { return Ok(found) };
    for node in own.list(list, "solution")? {
        let claim = own.table(node, "[[solution]]", &["joints", "bodies", "digits"])?;
        let (mut joints, mut bodies) = (Vec::new(), Vec::new());
        let fields = |key: &str| match claim.get(key).map(|node| (&node.value, node.line)) {
            None => Ok(&[][..]),
            Some((Value::Table(fields), _)) => Ok(fields.as_slice()),
            Some((_, line)) => Err(own.fail(line, format!("found `{key}` that is no table, expected one"))),
        };
        for field in fields("joints")? {
            let joint = joint_named(&own, linkage, &field.key, field.line)?;
            let value = if linkage.joints[joint].is_prismatic() {
                own.length(&field.node, &field.key)?.to_f64()
            } else {
                own.radians(&field.node, &field.key)?
            };
            joints.push((joint, value));
        }
        for field in fields("bodies")? {
            let body = body_named(&own, linkage, &field.key, field.line)?;
            let place = own.table(&field.node, &field.key, &["angle", "position"])?;
            let angle = place.get("angle").map(|node| own.radians(node, "angle")).transpose()?;
            let position = match place.get("position") {
                None => None,
                Some(node) => {
                    let [x, y] = own.exactly::<2>(node, "position")?;
                    Some([own.length(x, "position")?.to_f64(), own.length(y, "position")?.to_f64()])
                }
            };
            bodies.push((body, angle, position));
        }
        if joints.is_empty() && bodies.is_empty() {
            return Err(own.fail(node.line, "found a [[solution]] without `joints` and `bodies`, expected one of them"));
        }
        found.solutions.push(LinkageClaim { joints, bodies, digits: digits(&own, &claim)?, line: node.line });
    }
    Ok(found)
}
