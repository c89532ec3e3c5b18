//! Kind `lines`: questions about lines and about linear complexes of lines.

use super::calculus::{counted, direction, found, line_of, parts, point};
use super::node::Node;
use super::planes::{Turning, complexes, places, planes, turnings};
use super::scope::{Scope, Table};
use crate::algebra::number::Quantity;
use crate::error::Result;
use crate::kinematics::motion::{Vector, cross, dot};
use looproot_calculus::displacement::cylindroid::Pitched;
use looproot_calculus::line::complex::Complex;
use looproot_calculus::line::plane::Plane;
use looproot_calculus::line::pluecker::Line;
use rug::Rational;

/// The keys of a `[[line]]`.
pub(super) const LINE: [&str; 4] = ["through", "point", "direction", "moment"];

/// A question about lines.
#[derive(Clone, Debug)]
pub enum Lines {
    /// The lines that meet four lines.
    Transversals([Line<Rational>; 4]),
    /// The complex of five lines, and the points whose null planes are requested.
    Complex(Vec<Line<Rational>>, Vec<Vector<Rational>>),
    /// The cylindroid of two screws.
    Cylindroid([Pitched<Rational>; 2]),
    /// The common perpendicular of two lines.
    Perpendicular([Line<Rational>; 2]),
    /// The directrices of the lines that two complexes share.
    Congruence([Complex<Rational>; 2]),
    /// The quadric of three lines.
    Regulus([Line<Rational>; 3]),
    /// The plane through three points.
    Plane([Vector<Rational>; 3]),
    /// The line of two planes.
    Planes([Plane<Rational>; 2]),
    /// The polarity of a complex, applied to points, planes and lines.
    Polarity(Box<Polarity>),
    /// A generator of a ruled surface, and its rate.
    Generator(Box<[Line<Rational>; 2]>),
    /// Two bodies that rotate about lines, one relative to the other.
    Relative([Turning; 2]),
    /// The resultant of forces and couples, and the screws on which it works.
    Wrench(Box<Wrench>),
    /// The screws that are reciprocal to given ones.
    Reciprocal(Vec<Pitched<Rational>>),
}

/// A complex, and the elements to which its polarity is applied.
#[derive(Clone, Debug)]
pub struct Polarity {
    /// The complex.
    pub complex: Complex<Rational>,
    /// Points, whose null planes are requested.
    pub points: Vec<Vector<Rational>>,
    /// Planes, whose null points are requested.
    pub planes: Vec<Plane<Rational>>,
    /// Lines, whose reciprocal polars are requested.
    pub lines: Vec<Line<Rational>>,
}

/// Forces with their points, couples, and velocity screws.
#[derive(Clone, Debug)]
pub struct Wrench {
    /// Points and forces.
    pub forces: Vec<(Vector<Rational>, Vector<Rational>)>,
    /// Free couples.
    pub couples: Vec<Vector<Rational>>,
    /// Velocity screws of the body, for the power.
    pub screws: Vec<Turning>,
}

impl Lines {
    /// Returns the value of `find`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Transversals(_) => "transversals",
            Self::Complex(..) => "complex",
            Self::Cylindroid(_) => "cylindroid",
            Self::Perpendicular(_) => "perpendicular",
            Self::Congruence(_) => "congruence",
            Self::Regulus(_) => "regulus",
            Self::Plane(_) => "plane",
            Self::Planes(_) => "planes",
            Self::Polarity(_) => "polarity",
            Self::Generator(_) => "generator",
            Self::Relative(_) => "relative",
            Self::Wrench(_) => "wrench",
            Self::Reciprocal(_) => "reciprocal",
        }
    }
}

/// Reads the question of a file of kind `lines`.
pub(super) fn lines(scope: &Scope<'_>, table: &Table<'_>) -> Result<Lines> {
    let words = [
        "transversals",
        "complex",
        "cylindroid",
        "perpendicular",
        "congruence",
        "regulus",
        "plane",
        "planes",
        "polarity",
        "generator",
        "relative",
        "wrench",
        "reciprocal",
    ];
    let (find, _, line) = found(scope, table, &words, &[])?;
    let wrong = || scope.fail(line, "found another number of parts than the question has, expected that number");
    Ok(match find {
        "transversals" => Lines::Transversals(given(scope, table, 4, &[])?.try_into().map_err(|_| wrong())?),
        "perpendicular" => Lines::Perpendicular(given(scope, table, 2, &[])?.try_into().map_err(|_| wrong())?),
        "regulus" => Lines::Regulus(given(scope, table, 3, &[])?.try_into().map_err(|_| wrong())?),
        "complex" => {
            let lines = given(scope, table, 5, &["point"])?;
            let points = places(scope, table, &["line"])?;
            Lines::Complex(lines, points)
        }
        "cylindroid" => {
            let screws = parts(scope, table, "screw", &["direction", "point", "pitch"], &[])?;
            let screws = counted(scope, line_of(table, "screw"), screws, "screw", 2)?;
            let one = |(screw, _): &(Table<'_>, &Node)| {
                let along = direction(scope, scope.need(screw, "direction")?, "direction")?;
                let at = point(scope, scope.need(screw, "point")?, "point")?;
                let pitch = scope.length(scope.need(screw, "pitch")?, "pitch")?.rational().clone();
                Ok(Pitched { axis: Line::at(&at, &along), pitch })
            };
            let screws: Vec<_> = screws.iter().map(one).collect::<Result<_>>()?;
            Lines::Cylindroid(screws.try_into().map_err(|_| wrong())?)
        }
        "plane" => {
            let points = counted(scope, line_of(table, "point"), places(scope, table, &[])?, "point", 3)?;
            let points: [Vector<Rational>; 3] = points.try_into().map_err(|_| wrong())?;
            if Plane::through(&points).normal.iter().all(|c| *c == 0) {
                let message = "found points in a line, which lies in many planes, expected three that are not";
                return Err(scope.fail(line_of(table, "point"), message));
            }
            Lines::Plane(points)
        }
        "planes" => {
            let planes = counted(scope, line_of(table, "plane"), planes(scope, table, &[])?, "plane", 2)?;
            Lines::Planes(planes.try_into().map_err(|_| wrong())?)
        }
        "polarity" => polarity(scope, table)?,
        "generator" => generator(scope, table)?,
        "relative" => {
            let screws = counted(scope, line_of(table, "screw"), turnings(scope, table, &[])?, "screw", 2)?;
            Lines::Relative(screws.try_into().map_err(|_| wrong())?)
        }
        "wrench" => wrench(scope, table)?,
        "reciprocal" => {
            let screws = parts(scope, table, "screw", &["direction", "point", "pitch"], &[])?;
            let one = |(screw, _): &(Table<'_>, &Node)| {
                let along = direction(scope, scope.need(screw, "direction")?, "direction")?;
                let at = point(scope, scope.need(screw, "point")?, "point")?;
                let pitch = scope.length(scope.need(screw, "pitch")?, "pitch")?.rational().clone();
                Ok(Pitched { axis: Line::at(&at, &along), pitch })
            };
            Lines::Reciprocal(screws.iter().map(one).collect::<Result<_>>()?)
        }
        _ => {
            let found = complexes(scope, table, &[])?;
            let complexes = counted(scope, line_of(table, "complex"), found, "complex", 2)?;
            Lines::Congruence(complexes.try_into().map_err(|_| wrong())?)
        }
    })
}

/// Reads a complex, and the points, planes and lines to which it is applied.
fn polarity(scope: &Scope<'_>, table: &Table<'_>) -> Result<Lines> {
    let found = complexes(scope, table, &["point", "plane", "line"])?;
    let [complex]: [Complex<Rational>; 1] = counted(scope, line_of(table, "complex"), found, "complex", 1)?
        .try_into()
        .map_err(|_| scope.fail(table.line(), "found another number of complexes, expected one"))?;
    let lines = match table.get("line") {
        None => Vec::new(),
        Some(_) => parts(scope, table, "line", &LINE, &["complex", "point", "plane"])?
            .iter()
            .map(|(line, node)| pluecker(scope, line, node))
            .collect::<Result<_>>()?,
    };
    let points = places(scope, table, &["complex", "plane", "line"])?;
    let planes = planes(scope, table, &["complex", "point", "line"])?;
    Ok(Lines::Polarity(Box::new(Polarity { complex, points, planes, lines })))
}

/// Reads forces, couples and velocity screws.
fn wrench(scope: &Scope<'_>, table: &Table<'_>) -> Result<Lines> {
    let forces = parts(scope, table, "force", &["at", "vector"], &["couple", "screw"])?;
    let forces = forces.iter().map(|(own, _)| {
        let vector = |key: &str| point(scope, scope.need(own, key)?, key);
        Ok((vector("at")?, vector("vector")?))
    });
    let forces = forces.collect::<Result<_>>()?;
    let couples = match table.get("couple") {
        None => Vec::new(),
        Some(_) => parts(scope, table, "couple", &["vector"], &["force", "screw"])?
            .iter()
            .map(|(own, _)| point(scope, scope.need(own, "vector")?, "vector"))
            .collect::<Result<_>>()?,
    };
    let screws = turnings(scope, table, &["force", "couple"])?;
    Ok(Lines::Wrench(Box::new(Wrench { forces, couples, screws })))
}

/// Reads a line with the rates of its point and of its direction.
fn generator(scope: &Scope<'_>, table: &Table<'_>) -> Result<Lines> {
    let given = parts(scope, table, "line", &["point", "direction", "point_rate", "direction_rate"], &[])?;
    let given = counted(scope, line_of(table, "line"), given, "line", 1)?;
    let [(own, _)] = given.as_slice() else { return Err(scope.fail(table.line(), "found no line, expected one")) };
    let vector = |key: &str| point(scope, scope.need(own, key)?, key);
    let along = direction(scope, scope.need(own, "direction")?, "direction")?;
    let rate = scope.vector(scope.need(own, "direction_rate")?, Quantity::Ratio, "direction_rate")?;
    let rate = rate.each_ref().map(|c| c.rational().clone());
    let (at, slip) = (vector("point")?, vector("point_rate")?);
    // The rate of the moment p x d.
    let (one, two) = (cross(&slip, &along), cross(&at, &rate));
    let moment = std::array::from_fn(|i| Rational::from(&one[i] + &two[i]));
    Ok(Lines::Generator(Box::new([Line::at(&at, &along), Line { direction: rate, moment }])))
}

/// Reads exactly this many lines.
fn given(scope: &Scope<'_>, table: &Table<'_>, count: usize, others: &[&str]) -> Result<Vec<Line<Rational>>> {
    let lines = parts(scope, table, "line", &LINE, others)?;
    let lines = counted(scope, line_of(table, "line"), lines, "line", count)?;
    lines.iter().map(|(line, node)| pluecker(scope, line, node)).collect()
}

/// Reads a line by two points, by a point and a direction, or by direction and moment.
pub(super) fn pluecker(scope: &Scope<'_>, line: &Table<'_>, node: &Node) -> Result<Line<Rational>> {
    match (line.get("through"), line.get("point"), line.get("direction"), line.get("moment")) {
        (Some(through), None, None, None) => {
            let [first, second] = scope.exactly::<2>(through, "through")?;
            let (first, second) = (point(scope, first, "through")?, point(scope, second, "through")?);
            if first == second {
                return Err(scope
                    .fail(through.line, "found the same point twice in `through`, expected two points of the line"));
            }
            Ok(Line::through(&first, &second))
        }
        (None, Some(at), Some(along), None) => {
            Ok(Line::at(&point(scope, at, "point")?, &direction(scope, along, "direction")?))
        }
        (None, None, Some(along), Some(moment)) => {
            let line =
                Line { direction: direction(scope, along, "direction")?, moment: point(scope, moment, "moment")? };
            if dot(&line.direction, &line.moment) != 0 {
                let message = "found a moment that is not perpendicular to its direction, expected the Pluecker vectors of a line";
                return Err(scope.fail(moment.line, message));
            }
            Ok(line)
        }
        _ => {
            let message = "found a [[line]] without exactly one of `through`, `point` with `direction`, and `direction` with `moment`, expected one";
            Err(scope.fail(node.line, message))
        }
    }
}
