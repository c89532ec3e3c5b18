//! Kind `displacement`: displacements with some property.

use super::calculus::{counted, direction, found, line_of, parts, point};
use super::lines::pluecker;
use super::navigation::{self, Navigation};
use super::node::Node;
use super::planes::{MovingPoint, moving, places, planes};
use super::scope::{Scope, Table};
use super::tile::{self, Tile};
use crate::algebra::number::{HalfTangent, Quantity};
use crate::algebra::text::{Expression, Names};
use crate::error::{Error, Result};
use crate::kinematics::motion::{Motion, Vector};
use looproot_calculus::displacement::points::Moved;
use looproot_calculus::line::plane::Plane;
use looproot_calculus::line::pluecker::Line;
use looproot_calculus::rotation::matrix::Matrix;
use rug::Rational;

/// Maximum number of positions, every two of which are compared.
const MOST_POSITIONS: usize = 100;

/// A question about displacements.
#[derive(Clone, Debug)]
pub enum Displacement {
    /// Rotation matrices with three prescribed elements: places, rows and columns from 0, and values.
    Elements([(usize, usize); 3], [Rational; 3]),
    /// Rotations as three rotations about given axes of any length.
    ThreeRotations([Vector<Rational>; 3], Vec<Matrix<Rational>>),
    /// The motion X with A X = X B for pairs A, B.
    Calibration(Vec<(Motion<Rational>, Motion<Rational>)>),
    /// The product of screws, each given in space, in their order.
    Resultant(Vec<GivenScrew>),
    /// The displacement of points.
    Points(Vec<Moved<Rational>>),
    /// The displacements that take the first line to the second, or the rotations that do so with their directions.
    Line([Line<Rational>; 2], Through),
    /// The rotation of a point of the body through three positions on a circle.
    Circle([Vector<Rational>; 3]),
    /// The rotation at a share of the way from one to another.
    Between(Box<[Matrix<Rational>; 2]>, Rational),
    /// The rotations from every position to every later one.
    Relative(Vec<Matrix<Rational>>),
    /// The product of reflections in planes, in their order.
    Reflections(Vec<Plane<Rational>>),
    /// The lines of Roth's theorem of a screw and of points.
    Midpoints(Box<GivenScrew>, Vec<Vector<Rational>>),
    /// The motion of a body by the velocities and accelerations of three points.
    Velocities(Box<[MovingPoint; 3]>),
    /// The frame of a point that moves on a surface.
    Surface(Box<OnSurface>),
    /// Orientation, velocity and place of a body from the measurements of its instruments.
    Navigation(Box<Navigation>),
    /// Whether the copies of a polygon tile the plane.
    Tile(Box<Tile>),
}

/// A point that moves on a surface.
#[derive(Clone, Debug)]
pub struct OnSurface {
    /// The coordinates as polynomials in two parameters u and v.
    pub coordinates: [Expression; 3],
    /// The parameters of the point, their rates and their second rates.
    pub path: [[Rational; 2]; 3],
}

/// The set of displacements that take a line to a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Through {
    /// All such displacements.
    Space,
    /// Rotations about the origin; only the directions of the lines matter.
    Origin,
}

/// A finite screw of a file.
#[derive(Clone, Debug)]
pub struct GivenScrew {
    /// The axis, its direction of any length.
    pub axis: Line<Rational>,
    /// The angle by its half-angle tangent.
    pub half_tangent: HalfTangent,
    /// The translation along the axis, by its direction as a unit vector.
    pub translation: Rational,
}

impl Displacement {
    /// Returns the value of `find`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Elements(..) => "elements",
            Self::ThreeRotations(..) => "three-rotations",
            Self::Calibration(_) => "calibration",
            Self::Resultant(_) => "resultant",
            Self::Points(_) => "points",
            Self::Line(..) => "line",
            Self::Circle(_) => "circle",
            Self::Between(..) => "between",
            Self::Relative(_) => "relative",
            Self::Reflections(_) => "reflections",
            Self::Midpoints(..) => "midpoints",
            Self::Velocities(_) => "velocities",
            Self::Surface(_) => "surface",
            Self::Navigation(_) => "navigation",
            Self::Tile(_) => "tile",
        }
    }
}

/// Reads the question of a file of kind `displacement`.
pub(super) fn displacement(scope: &Scope<'_>, table: &Table<'_>) -> Result<Displacement> {
    let words = [
        "elements",
        "three-rotations",
        "calibration",
        "resultant",
        "points",
        "line",
        "circle",
        "between",
        "relative",
        "reflections",
        "midpoints",
        "velocities",
        "surface",
        "navigation",
        "tile",
    ];
    let own = ["axes", "through", "share", "coordinates", "at", "rate", "second_rate"];
    let keys = [&own, navigation::KEYS.as_slice(), tile::KEYS.as_slice()].concat();
    let (find, mechanism, line) = found(scope, table, &words, &keys)?;
    let further =
        navigation::KEYS.map(|key| (key, "navigation")).into_iter().chain(tile::KEYS.map(|key| (key, "tile")));
    let owners = [
        ("axes", "three-rotations"),
        ("through", "line"),
        ("share", "between"),
        ("coordinates", "surface"),
        ("at", "surface"),
        ("rate", "surface"),
        ("second_rate", "surface"),
    ];
    for (key, of) in owners.into_iter().chain(further) {
        if let (Some(node), false) = (mechanism.get(key), find == of) {
            return Err(scope
                .fail(node.line, format!("found `{key}` with `find = \"{find}\"`, expected it with \"{of}\" only")));
        }
    }
    match find {
        "elements" => elements(scope, table),
        "three-rotations" => three_rotations(scope, table, &mechanism),
        "calibration" => calibration(scope, table),
        "resultant" => resultant(scope, table),
        "points" => points(scope, table),
        "circle" => circle(scope, table, line),
        "between" => {
            let found = rotations(scope, table)?;
            let found = counted(scope, line_of(table, "rotation"), found, "rotation", 2)?;
            let share = scope.number(scope.need(&mechanism, "share")?, Quantity::Ratio, "share")?.rational().clone();
            let both =
                found.try_into().map_err(|_| scope.fail(line, "found another number of rotations, expected two"))?;
            Ok(Displacement::Between(Box::new(both), share))
        }
        "relative" => {
            let found = rotations(scope, table)?;
            if !(2..=MOST_POSITIONS).contains(&found.len()) {
                let message = format!("found {} [[rotation]], expected 2 to {MOST_POSITIONS} positions", found.len());
                return Err(scope.fail(line_of(table, "rotation"), message));
            }
            Ok(Displacement::Relative(found))
        }
        "reflections" => {
            let found = planes(scope, table, &[])?;
            if found.is_empty() {
                return Err(scope.fail(line, "found no [[plane]], expected one or many"));
            }
            Ok(Displacement::Reflections(found))
        }
        "midpoints" => {
            let screws = counted(scope, line_of(table, "screw"), screws(scope, table, &["point"])?, "screw", 1)?;
            let screw = screws.into_iter().next();
            let screw = screw.ok_or_else(|| scope.fail(line, "found no [[screw]], expected one"))?;
            let points = places(scope, table, &["screw"])?;
            if points.is_empty() {
                return Err(scope.fail(line, "found no [[point]], expected one or many"));
            }
            Ok(Displacement::Midpoints(Box::new(screw), points))
        }
        "surface" => on_surface(scope, &mechanism),
        "navigation" => Ok(Displacement::Navigation(Box::new(navigation::navigation(scope, table, &mechanism)?))),
        "tile" => Ok(Displacement::Tile(Box::new(tile::tile(scope, table, &mechanism)?))),
        "velocities" => Ok(Displacement::Velocities(Box::new(moving(scope, table)?))),
        _ => {
            let given = parts(scope, table, "line", &super::lines::LINE, &[])?;
            let given = counted(scope, line_of(table, "line"), given, "line", 2)?;
            let lines: Vec<Line<Rational>> =
                given.iter().map(|(line, node)| pluecker(scope, line, node)).collect::<Result<_>>()?;
            let through = match mechanism.get("through") {
                Some(node) => {
                    scope.word(node, "through", &["origin"])?;
                    Through::Origin
                }
                None => Through::Space,
            };
            let [first, second] = lines
                .try_into()
                .map_err(|_| scope.fail(line, "found another number of lines than two, expected two"))?;
            Ok(Displacement::Line([first, second], through))
        }
    }
}

/// Reads three positions of a point on a circle.
fn circle(scope: &Scope<'_>, table: &Table<'_>, line: usize) -> Result<Displacement> {
    let points = counted(scope, line_of(table, "point"), places(scope, table, &[])?, "point", 3)?;
    let points: [Vector<Rational>; 3] =
        points.try_into().map_err(|_| scope.fail(line, "found another number of points, expected three"))?;
    if Plane::through(&points).normal.iter().all(|c| *c == 0) {
        let message = "found points in a line, expected three on a circle";
        return Err(scope.fail(line_of(table, "point"), message));
    }
    Ok(Displacement::Circle(points))
}

/// Reads coordinates in u and v, and the motion of u and v.
fn on_surface(scope: &Scope<'_>, mechanism: &Table<'_>) -> Result<Displacement> {
    let node = scope.need(mechanism, "coordinates")?;
    let mut names = Names::given(["u", "v"])?;
    let mut one = |node: &Node| {
        let text = scope.text(node, "coordinates")?;
        Expression::parse(text, &mut names).map_err(|fault| scope.fail(node.line, fault.message))
    };
    let [x, y, z] = scope.exactly::<3>(node, "coordinates")?;
    let coordinates = [one(x)?, one(y)?, one(z)?];
    let pair = |key: &str| -> Result<[Rational; 2]> {
        let Some(node) = mechanism.get(key) else { return Ok([Rational::new(), Rational::new()]) };
        let [u, v] = scope.exactly::<2>(node, key)?;
        let number = |node: &Node| Ok::<_, Error>(scope.number(node, Quantity::Ratio, key)?.rational().clone());
        Ok([number(u)?, number(v)?])
    };
    scope.need(mechanism, "at")?;
    let rate = scope.need(mechanism, "rate")?;
    let path = [pair("at")?, pair("rate")?, pair("second_rate")?];
    if path[1].iter().all(|c| *c == 0) {
        return Err(scope.fail(rate.line, "found a point at rest, expected one that moves"));
    }
    Ok(Displacement::Surface(Box::new(OnSurface { coordinates, path })))
}

fn elements(scope: &Scope<'_>, table: &Table<'_>) -> Result<Displacement> {
    let given = parts(scope, table, "element", &["row", "column", "value"], &[])?;
    let line = line_of(table, "element");
    let given = counted(scope, line, given, "element", 3)?;
    let mut places = [(0, 0); 3];
    let mut values: [Rational; 3] = std::array::from_fn(|_| Rational::new());
    for (k, (element, node)) in given.iter().enumerate() {
        let index = |key: &str| {
            let found = scope.need(element, key)?;
            match scope.count(found, key)? {
                index @ 1..=3 => Ok(index - 1),
                other => Err(scope.fail(found.line, format!("found {other} as `{key}`, expected 1, 2 or 3"))),
            }
        };
        places[k] = (index("row")?, index("column")?);
        if places[..k].contains(&places[k]) {
            let (row, column) = (places[k].0 + 1, places[k].1 + 1);
            let message =
                format!("found the element of row {row} and column {column} twice, expected three different ones");
            return Err(scope.fail(node.line, message));
        }
        values[k].clone_from(scope.number(scope.need(element, "value")?, Quantity::Ratio, "value")?.rational());
    }
    Ok(Displacement::Elements(places, values))
}

fn three_rotations(scope: &Scope<'_>, table: &Table<'_>, mechanism: &Table<'_>) -> Result<Displacement> {
    let [a, b, c] = scope.exactly::<3>(scope.need(mechanism, "axes")?, "axes")?;
    let axes = [direction(scope, a, "axes")?, direction(scope, b, "axes")?, direction(scope, c, "axes")?];
    Ok(Displacement::ThreeRotations(axes, rotations(scope, table)?))
}

/// Reads the rotations of a file, one or many.
fn rotations(scope: &Scope<'_>, table: &Table<'_>) -> Result<Vec<Matrix<Rational>>> {
    let given = parts(scope, table, "rotation", &["matrix", "quaternion"], &[])?;
    if given.is_empty() {
        return Err(scope.fail(line_of(table, "rotation"), "found no [[rotation]], expected one or many"));
    }
    let rotations = given.iter().map(|(own, node)| match (own.get("matrix"), own.get("quaternion")) {
        (Some(matrix), None) => scope.rotation_matrix(matrix, "matrix"),
        (None, Some(quaternion)) => scope.rotation_quaternion(quaternion),
        _ => {
            let message = "found a [[rotation]] without exactly one of `matrix` and `quaternion`, expected one";
            Err(scope.fail(node.line, message))
        }
    });
    rotations.collect()
}

fn calibration(scope: &Scope<'_>, table: &Table<'_>) -> Result<Displacement> {
    let given = parts(scope, table, "pair", &["A", "B"], &[])?;
    if given.is_empty() {
        return Err(scope.fail(line_of(table, "pair"), "found no [[pair]], expected one or many"));
    }
    let motion = |pair: &Table<'_>, key: &str| {
        let node: &Node = scope.need(pair, key)?;
        if matches!(node.value, super::node::Value::List(_)) {
            return scope.matrix(node, key).map(|placement| placement.exact.motion());
        }
        let own = scope.table(node, key, &["position", "quaternion"])?;
        let placed = scope.quaternion_position(scope.need(&own, "quaternion")?, scope.need(&own, "position")?)?;
        Ok(placed.exact.motion())
    };
    let pairs = given.iter().map(|(pair, _)| Ok((motion(pair, "A")?, motion(pair, "B")?)));
    Ok(Displacement::Calibration(pairs.collect::<Result<_>>()?))
}

fn resultant(scope: &Scope<'_>, table: &Table<'_>) -> Result<Displacement> {
    Ok(Displacement::Resultant(screws(scope, table, &[])?))
}

/// Reads the finite screws of a file.
fn screws(scope: &Scope<'_>, table: &Table<'_>, others: &[&str]) -> Result<Vec<GivenScrew>> {
    let keys = ["direction", "point", "angle", "tan_half", "translation"];
    let given = parts(scope, table, "screw", &keys, others)?;
    let screws = given.iter().map(|(screw, node)| {
        let along = direction(scope, scope.need(screw, "direction")?, "direction")?;
        let at = point(scope, scope.need(screw, "point")?, "point")?;
        let angle = match (screw.get("angle"), screw.get("tan_half")) {
            (Some(node), None) => scope.angle(node, "angle")?,
            (None, Some(node)) => scope.half_tangent(node, "tan_half")?,
            _ => {
                let message = "found a [[screw]] without exactly one of `angle` and `tan_half`, expected one";
                return Err(scope.fail(node.line, message));
            }
        };
        let translation = scope.length(scope.need(screw, "translation")?, "translation")?.rational().clone();
        Ok(GivenScrew { axis: Line::at(&at, &along), half_tangent: angle.half_tangent().clone(), translation })
    });
    screws.collect()
}

fn points(scope: &Scope<'_>, table: &Table<'_>) -> Result<Displacement> {
    let given = parts(scope, table, "point", &["before", "after"], &[])?;
    let line = line_of(table, "point");
    if given.len() < 3 {
        return Err(scope.fail(line, format!("found {} [[point]], expected three or more", given.len())));
    }
    let moved = given.iter().map(|(own, _)| {
        let place = |key: &str| point(scope, scope.need(own, key)?, key);
        Ok((place("before")?, place("after")?))
    });
    let moved: Vec<Moved<Rational>> = moved.collect::<Result<_>>()?;
    let plane = looproot_calculus::displacement::points::spread(&moved.iter().map(|p| p.0.clone()).collect::<Vec<_>>());
    if plane.is_none() {
        let message =
            "found points in a line, expected three that are not: a rotation about that line would not move them";
        return Err(scope.fail(line, message));
    }
    Ok(Displacement::Points(moved))
}
