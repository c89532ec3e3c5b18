//! Reads `[[plane]]`, `[[point]] at` and other parts of questions of the calculus.

use super::calculus::{direction, parts, point};
use super::node::Node;
use super::scope::{Scope, Table};
use crate::algebra::number::Quantity;
use crate::algebra::ring::Ring;
use crate::error::Result;
use crate::kinematics::motion::Vector;
use looproot_calculus::displacement::cylindroid::Pitched;
use looproot_calculus::line::complex::Complex;
use looproot_calculus::line::plane::Plane;
use looproot_calculus::line::pluecker::Line;
use rug::Rational;

/// A velocity screw: `omega` is the rate times the unit direction.
#[derive(Clone, Debug)]
pub struct Turning {
    /// Axis and pitch.
    pub screw: Pitched<Rational>,
    /// The rate about the direction given in the file, taken as a unit vector.
    pub rate: Rational,
}

/// A point of a body with its velocity, and with its acceleration if given.
#[derive(Clone, Debug)]
pub struct MovingPoint {
    /// Its place.
    pub at: Vector<Rational>,
    /// Its velocity.
    pub velocity: Vector<Rational>,
    /// Its acceleration.
    pub acceleration: Option<Vector<Rational>>,
}

/// Reads the planes of a file; empty if there is no such list.
pub(super) fn planes(scope: &Scope<'_>, table: &Table<'_>, others: &[&str]) -> Result<Vec<Plane<Rational>>> {
    if table.get("plane").is_none() {
        return Ok(Vec::new());
    }
    let given = parts(scope, table, "plane", &["normal", "distance", "point"], others)?;
    let one = |(own, node): &(Table<'_>, &Node)| {
        let normal = direction(scope, scope.need(own, "normal")?, "normal")?;
        let distance = match (own.get("distance"), own.get("point")) {
            (Some(node), None) => scope.length(node, "distance")?.rational().clone(),
            (None, Some(node)) => looproot_calculus::motion::dot(&normal, &point(scope, node, "point")?),
            _ => {
                let message = "found a [[plane]] without exactly one of `distance` and `point`, expected one";
                return Err(scope.fail(node.line, message));
            }
        };
        Ok(Plane { normal, distance })
    };
    given.iter().map(one).collect()
}

/// Reads the points of a file by `at`; empty if there is no such list.
pub(super) fn places(scope: &Scope<'_>, table: &Table<'_>, others: &[&str]) -> Result<Vec<Vector<Rational>>> {
    if table.get("point").is_none() {
        return Ok(Vec::new());
    }
    let given = parts(scope, table, "point", &["at"], others)?;
    given.iter().map(|(own, _)| point(scope, scope.need(own, "at")?, "at")).collect()
}

/// Reads three points with their velocities, and with their accelerations if all three have one.
pub(super) fn moving(scope: &Scope<'_>, table: &Table<'_>) -> Result<[MovingPoint; 3]> {
    let given = parts(scope, table, "point", &["at", "velocity", "acceleration"], &[])?;
    let one = |(own, _): &(Table<'_>, &Node)| {
        let vector = |key: &str| point(scope, scope.need(own, key)?, key);
        let acceleration = own.get("acceleration").map(|node| point(scope, node, "acceleration")).transpose()?;
        Ok(MovingPoint { at: vector("at")?, velocity: vector("velocity")?, acceleration })
    };
    let points: Vec<MovingPoint> = given.iter().map(one).collect::<Result<_>>()?;
    let line = table.get("point").map_or_else(|| table.line(), |node| node.line);
    let count = points.iter().filter(|point| point.acceleration.is_some()).count();
    let [a, b, c]: [MovingPoint; 3] = points
        .try_into()
        .map_err(|all: Vec<_>| scope.fail(line, format!("found {} [[point]], expected three", all.len())))?;
    if count % 3 != 0 {
        return Err(scope.fail(line, "found accelerations of some points, expected them of all three or of none"));
    }
    let corners = [a.at.clone(), b.at.clone(), c.at.clone()];
    if Plane::through(&corners).normal.iter().all(|c| *c == 0) {
        let message =
            "found points in a line, expected three that are not: a rotation about that line would not move them";
        return Err(scope.fail(line, message));
    }
    Ok([a, b, c])
}

/// Reads velocity screws: `direction`, `point`, `pitch` and `rate`.
pub(super) fn turnings(scope: &Scope<'_>, table: &Table<'_>, others: &[&str]) -> Result<Vec<Turning>> {
    if table.get("screw").is_none() {
        return Ok(Vec::new());
    }
    let given = parts(scope, table, "screw", &["direction", "point", "pitch", "rate"], others)?;
    let one = |(own, _): &(Table<'_>, &Node)| {
        let along = direction(scope, scope.need(own, "direction")?, "direction")?;
        let at = point(scope, scope.need(own, "point")?, "point")?;
        let pitch = match own.get("pitch") {
            Some(node) => scope.length(node, "pitch")?.rational().clone(),
            None => Rational::new(),
        };
        let rate = match own.get("rate") {
            Some(node) => scope.number(node, Quantity::Ratio, "rate")?.rational().clone(),
            None => Rational::one(),
        };
        Ok(Turning { screw: Pitched { axis: Line::at(&at, &along), pitch }, rate })
    };
    given.iter().map(one).collect()
}

/// Reads the complexes of a file.
pub(super) fn complexes(scope: &Scope<'_>, table: &Table<'_>, others: &[&str]) -> Result<Vec<Complex<Rational>>> {
    let given = parts(scope, table, "complex", &["a", "b"], others)?;
    let one = |(own, node): &(Table<'_>, &Node)| {
        let vector = |key: &str, quantity: Quantity| {
            let found = scope.vector(scope.need(own, key)?, quantity, key)?;
            Ok::<_, crate::error::Error>(found.each_ref().map(|c| c.rational().clone()))
        };
        let complex = Complex { a: vector("a", Quantity::Ratio)?, b: vector("b", Quantity::Length)? };
        if complex.a.iter().chain(&complex.b).all(|c| *c == 0) {
            let message = "found a [[complex]] of zeros, expected two vectors that are not both zero";
            return Err(scope.fail(node.line, message));
        }
        Ok(complex)
    };
    given.iter().map(one).collect()
}
