//! Loops given by their axes in one position: twists, lengths and offsets from the common normals, if they are rational.

use super::read::check_kind;
use super::{SymbolicJoint, Twist};
use crate::algebra::number::Quantity;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Field, Ring};
use crate::catalogue::node::Node;
use crate::catalogue::scope::{Scope, Table};
use crate::error::{Error, Result};
use crate::kinematics::motion::{Vector, cross, dot};
use rug::Rational;

/// A directed line, its direction of length 1.
struct Axis {
    direction: Vector<Rational>,
    point: Vector<Rational>,
}

/// A link: its twist and length, and the feet of its common normal on the two axes.
struct Normal {
    cos: Rational,
    sin: Rational,
    length: Rational,
    feet: [Vector<Rational>; 2],
}

/// Returns the joints of a loop of screw axes.
pub(super) fn joints(
    scope: &Scope<'_>,
    table: &Table<'_>,
    nodes: &[Node],
    angles: usize,
) -> Result<Vec<SymbolicJoint>> {
    let axes: Vec<Axis> = nodes.iter().map(|node| axis(scope, node)).collect::<Result<_>>()?;
    let n = axes.len();
    let fault = |fault: Error| fault.at(scope.path, table.line());
    let normals: Vec<Normal> = (0..n)
        .map(|k| normal(&axes[k], &axes[(k + 1) % n], k + 1, (k + 1) % n + 1).map_err(fault))
        .collect::<Result<_>>()?;
    let joint = |k: usize| {
        let [before, link] = [&normals[(k + n - 1) % n], &normals[k]];
        SymbolicJoint {
            a: Polynomial::constant(link.length.clone()),
            alpha: Twist { multiples: vec![0; angles], constant: (link.cos.clone(), link.sin.clone()) },
            d: Polynomial::constant(dot(&difference(&link.feet[0], &before.feet[1]), &axes[k].direction)),
        }
    };
    Ok((0..n).map(joint).collect())
}

fn axis(scope: &Scope<'_>, node: &Node) -> Result<Axis> {
    check_kind(scope, node)?;
    let table = scope.table(node, "a screw joint", &["type", "name", "axis", "point"])?;
    let rational = |key: &str, quantity: Quantity| -> Result<Vector<Rational>> {
        let vector = scope.vector(scope.need(&table, key)?, quantity, key)?;
        for number in &vector {
            scope.note(number.is_exact());
        }
        Ok(vector.map(|number| number.rational().clone()))
    };
    let (direction, point) = (rational("axis", Quantity::Ratio)?, rational("point", Quantity::Length)?);
    let square = dot(&direction, &direction);
    if square.is_zero() {
        return Err(scope.fail(table.line(), "found the axis [0, 0, 0], expected a direction"));
    }
    let Some(inverse) = root(&square).and_then(|norm| norm.inverse()) else {
        let message = irrational(&format!("an axis whose length squared is {square}"));
        return Err(message.at(scope.path, table.line()));
    };
    Ok(Axis { direction: direction.map(|x| Ring::mul(&x, &inverse)), point })
}

/// Returns the error for an irrational length, which would make the loop inexact.
fn irrational(what: &str) -> Error {
    Error::Unsupported(format!(
        "found {what}, which has no rational root: conditions are derived for rational cosines and sines of twists and \
         rational lengths; the convention \"dh\" with `tan_half_alpha` or symbols takes every other loop"
    ))
}

fn normal(one: &Axis, other: &Axis, first: usize, second: usize) -> Result<Normal> {
    let cos = dot(&one.direction, &other.direction);
    let across = cross(&one.direction, &other.direction);
    let between = difference(&other.point, &one.point);
    let square = dot(&across, &across);
    let Some(inverse) = square.inverse() else {
        // For parallel axes the normal may be anywhere.
        let along = dot(&between, &one.direction);
        let foot = moved(&other.point, &one.direction, &along.neg());
        let distance = difference(&foot, &one.point);
        let length = dot(&distance, &distance);
        if length.is_zero() {
            let message =
                format!("found axes {first} and {second} that coincide: their common normal is not determined");
            return Err(Error::Unsupported(message));
        }
        let length = root(&length)
            .ok_or_else(|| irrational(&format!("the axes {first} and {second} whose distance squared is {length}")))?;
        return Ok(Normal { cos, sin: Rational::new(), length, feet: [one.point.clone(), foot] });
    };
    let sin = root(&square).ok_or_else(|| {
        irrational(&format!("the axes {first} and {second} whose twist has the squared sine {square}"))
    })?;
    // between = s z - t z' + multiple of the normal.
    let coordinate = |with: &Vector<Rational>| Ring::mul(&dot(&cross(&between, with), &across), &inverse);
    let feet = [
        moved(&one.point, &one.direction, &coordinate(&other.direction)),
        moved(&other.point, &other.direction, &coordinate(&one.direction)),
    ];
    let length = dot(&difference(&feet[1], &feet[0]), &across) / &sin;
    Ok(Normal { cos, sin, length, feet })
}

fn difference(x: &Vector<Rational>, y: &Vector<Rational>) -> Vector<Rational> {
    std::array::from_fn(|i| Rational::from(&x[i] - &y[i]))
}

fn moved(point: &Vector<Rational>, direction: &Vector<Rational>, by: &Rational) -> Vector<Rational> {
    std::array::from_fn(|i| Rational::from(&direction[i] * by) + &point[i])
}

fn root(x: &Rational) -> Option<Rational> {
    let is_square = x.numer().is_perfect_square() && x.denom().is_perfect_square();
    is_square.then(|| Rational::from((x.numer().clone().sqrt(), x.denom().clone().sqrt())))
}
