//! A configuration of a linkage in space or on the sphere: where every body stands against the ground.

use super::node::{Node, Value};
use super::scope::Scope;
use super::sphere::fields;
use crate::algebra::number::{Number, Quantity};
use crate::error::Result;
use crate::kinematics::motion::Motion;
use rug::Rational;

/// Where the bodies of a linkage stand.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceConfiguration {
    /// The place of every body against the ground.
    pub places: Vec<Motion<Rational>>,
    /// Whether all numbers are exact.
    pub exact: bool,
    /// Line of the file, from 1.
    pub line: usize,
}

/// Reads `[configuration]` of these bodies, on the sphere by quaternions alone.
pub(super) fn configuration(
    scope: &Scope<'_>,
    node: &Node,
    bodies: &[&str],
    ground: usize,
    is_sphere: bool,
) -> Result<SpaceConfiguration> {
    let own = Scope::new(scope.path, scope.reading.clone());
    let keys: &[&str] = if is_sphere { &["quaternion"] } else { &["quaternion", "position"] };
    let mut places: Vec<Option<Motion<Rational>>> = vec![None; bodies.len()];
    places[ground] = Some(Motion::identity());
    let mut exact = true;
    for field in fields(scope, node, "configuration")? {
        let Some(body) = bodies.iter().position(|name| *name == field.key) else {
            let name: String = field.key.chars().take(40).collect();
            let known = bodies.iter().take(12).copied().collect::<Vec<_>>().join(", ");
            let message = format!("found the unknown body `{name}`, expected one of {known}");
            return Err(scope.fail(field.line, message));
        };
        if body == ground {
            let message = format!("found the ground {} in the configuration, expected the other bodies", field.key);
            return Err(scope.fail(field.line, message));
        }
        let table = own.table(&field.node, &format!("configuration.{}", field.key), keys)?;
        let mut place = Motion::identity();
        if let Some(node) = table.get("quaternion") {
            place.rotation = own.rotation_quaternion(node)?;
            // Rational numbers give a rational rotation, whatever the length of the quaternion.
            exact &= is_exact(&own, node)?;
        }
        if let Some(node) = table.get("position") {
            let position = own.vector(node, Quantity::Length, "position")?;
            exact &= position.iter().all(Number::is_exact);
            place.translation = position.each_ref().map(|c| c.rational().clone());
        }
        places[body] = Some(place);
    }
    if let Some(missing) = places.iter().position(Option::is_none) {
        let name = bodies[missing];
        return Err(
            scope.fail(node.line, format!("found a configuration without the body {name}, expected every body"))
        );
    }
    Ok(SpaceConfiguration { places: places.into_iter().flatten().collect(), exact, line: node.line })
}

fn is_exact(scope: &Scope<'_>, node: &Node) -> Result<bool> {
    let Value::List(items) = &node.value else { return Ok(false) };
    let numbers = items.iter().map(|item| scope.number(item, Quantity::Ratio, "quaternion"));
    Ok(numbers.collect::<Result<Vec<_>>>()?.iter().all(Number::is_exact))
}
