//! Reads what gyroscopes and accelerometers of a body measure, interval by interval.

use super::calculus::{direction, parts, point};
use super::node::Node;
use super::scope::{Scope, Table};
use crate::algebra::number::{HalfTangent, Quantity};
use crate::error::Result;
use crate::kinematics::motion::{Motion, Vector};
use looproot_calculus::rotation::matrix::Matrix;
use rug::Rational;
use std::f64::consts::{PI, TAU};

/// Maximum number of intervals.
const MOST: usize = 10_000;

/// An interval of constant angular velocity and constant specific force, both in axes of the body.
#[derive(Clone, Debug)]
pub struct Interval {
    /// The axis of the rotation, of any length.
    pub axis: Vector<Rational>,
    /// The angle of the rotation up to whole turns, by its half-angle tangent.
    pub half_tangent: HalfTangent,
    /// Whole turns beside it.
    pub turns: i32,
    /// Seconds.
    pub duration: Rational,
    /// Acceleration less gravity, metres per second squared.
    pub force: Vector<Rational>,
}

/// Where a body starts, and what its instruments measure.
#[derive(Clone, Debug)]
pub struct Navigation {
    /// Orientation at the start.
    pub rotation: Matrix<Rational>,
    /// Place at the start, metres.
    pub position: Vector<Rational>,
    /// Velocity at the start, metres per second.
    pub velocity: Vector<Rational>,
    /// Gravity, metres per second squared.
    pub gravity: Vector<Rational>,
    /// The measurements.
    pub intervals: Vec<Interval>,
    /// Steps of the integration of the kinematic differential equations in every interval.
    pub steps: Option<usize>,
}

/// The keys of `[mechanism]`.
pub(super) const KEYS: [&str; 5] = ["gravity", "quaternion", "position", "velocity", "steps"];

/// Reads `[[interval]]` and the state at the start.
pub(super) fn navigation(scope: &Scope<'_>, table: &Table<'_>, mechanism: &Table<'_>) -> Result<Navigation> {
    let zero = || -> Vector<Rational> { std::array::from_fn(|_| Rational::new()) };
    let vector = |table: &Table<'_>, key: &str| -> Result<Vector<Rational>> {
        let Some(node) = table.get(key) else { return Ok(zero()) };
        Ok(scope.vector(node, Quantity::Ratio, key)?.each_ref().map(|c| c.rational().clone()))
    };
    let rotation = match mechanism.get("quaternion") {
        Some(node) => scope.rotation_quaternion(node)?,
        None => Motion::identity().rotation,
    };
    let position = mechanism.get("position").map(|node| point(scope, node, "position")).transpose()?;
    let given = parts(scope, table, "interval", &["axis", "angle", "tan_half", "duration", "force"], &[])?;
    if given.is_empty() || given.len() > MOST {
        let line = table.get("interval").map_or_else(|| table.line(), |node| node.line);
        return Err(scope.fail(line, format!("found {} [[interval]], expected 1 to {MOST}", given.len())));
    }
    let one = |(own, node): &(Table<'_>, &Node)| -> Result<Interval> {
        let angle = match (own.get("angle"), own.get("tan_half")) {
            (Some(node), None) => scope.angle(node, "angle")?,
            (None, Some(node)) => scope.half_tangent(node, "tan_half")?,
            _ => {
                let message = "found an [[interval]] without exactly one of `angle` and `tan_half`, expected one";
                return Err(scope.fail(node.line, message));
            }
        };
        let axis = direction(scope, scope.need(own, "axis")?, "axis")?;
        let duration = scope.number(scope.need(own, "duration")?, Quantity::Ratio, "duration")?.rational().clone();
        if duration <= 0 {
            return Err(scope.fail(node.line, "found a `duration` that is not positive, expected seconds"));
        }
        let reduced = match angle.half_tangent() {
            HalfTangent::Infinite => PI,
            HalfTangent::Finite(t) => 2.0 * t.to_f64().atan(),
        };
        let turns = ((angle.radians() - reduced) / TAU).round();
        if !(turns.abs() < 1e6) {
            return Err(scope.fail(node.line, "found an angle of more than a million turns, expected fewer"));
        }
        #[expect(clippy::cast_possible_truncation, reason = "whole, and below a million")]
        let turns = turns as i32;
        let force = vector(own, "force")?;
        Ok(Interval { axis, half_tangent: angle.half_tangent().clone(), turns, duration, force })
    };
    Ok(Navigation {
        rotation,
        position: position.unwrap_or_else(zero),
        velocity: vector(mechanism, "velocity")?,
        gravity: vector(mechanism, "gravity")?,
        intervals: given.iter().map(one).collect::<Result<_>>()?,
        steps: mechanism.get("steps").map(|node| scope.count(node, "steps")).transpose()?,
    })
}
