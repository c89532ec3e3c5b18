//! The limits of platforms: the lengths of legs and the cones of joints.

use super::node::{Node, Value};
use super::scope::{Scope, Table};
use crate::algebra::number::{Number, Quantity};
use crate::error::Result;
use crate::kinematics::platform_limits::{Cone, PlatformLimits};
use rug::Rational;
use std::f64::consts::PI;

/// Reads the limits in the `[mechanism]` of a platform.
pub(super) fn limits(scope: &Scope<'_>, table: &Table<'_>) -> Result<PlatformLimits> {
    // Limits are compared only: they do not make the mechanism a rounded one.
    let own = Scope::new(scope.path, scope.reading.clone());
    let cones = |key: &str| table.get(key).map(|node| each(&own, node, key, is_cone, cone)).transpose();
    let legs_squared = table.get("limits").map(|node| each(&own, node, "limits", is_pair, pair)).transpose()?;
    Ok(PlatformLimits { legs_squared, base: cones("base_cones")?, plate: cones("plate_cones")? })
}

/// Reads six values, one per leg, or one that holds for all legs.
fn each<T: Clone>(
    scope: &Scope<'_>,
    node: &Node,
    key: &str,
    is_one: fn(&Node) -> bool,
    read: fn(&Scope<'_>, &Node, &str) -> Result<T>,
) -> Result<[T; 6]> {
    if is_one(node) {
        let value = read(scope, node, key)?;
        return Ok(std::array::from_fn(|_| value.clone()));
    }
    let nodes = scope.list(node, key)?;
    let values: Vec<T> = nodes.iter().map(|item| read(scope, item, key)).collect::<Result<_>>()?;
    values.try_into().map_err(|values: Vec<T>| {
        let found = values.len();
        scope.fail(node.line, format!("found {found} values in `{key}`, expected 6, one per leg, or one for all legs"))
    })
}

/// Returns whether a value is a pair of lengths, not a list of pairs.
fn is_pair(node: &Node) -> bool {
    matches!(&node.value, Value::List(items) if items.iter().any(|item| !matches!(item.value, Value::List(_))))
}

fn is_cone(node: &Node) -> bool {
    matches!(node.value, Value::Table(_))
}

/// Reads the shortest and the longest length of a leg, and returns their squares.
fn pair(scope: &Scope<'_>, node: &Node, key: &str) -> Result<[Rational; 2]> {
    let nodes = scope.exactly::<2>(node, key)?;
    let lengths: Vec<Number> = nodes.iter().map(|item| scope.length(item, key)).collect::<Result<_>>()?;
    let [low, high] = [&lengths[0], &lengths[1]];
    if *low.rational() < 0 || low.rational() > high.rational() {
        let (low, high) = (low.to_f64(), high.to_f64());
        let message =
            format!("found the limits [{low}, {high}] of a leg in metres, expected 0 or more, the lower one first");
        return Err(scope.fail(node.line, message));
    }
    Ok([low, high].map(|length| Rational::from(length.rational().square_ref())))
}

/// Reads the cone of a joint.
fn cone(scope: &Scope<'_>, node: &Node, key: &str) -> Result<Cone> {
    let table = scope.table(node, key, &["axis", "angle"])?;
    let axis_node = scope.need(&table, "axis")?;
    let axis = scope.vector(axis_node, Quantity::Ratio, "axis")?.map(|x| x.to_f64());
    let size = axis.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    if size == 0.0 {
        return Err(scope.fail(axis_node.line, format!("found the axis 0 in `{key}`, expected a direction")));
    }
    let angle_node = scope.need(&table, "angle")?;
    let angle = scope.radians(angle_node, "angle")?;
    if !(0.0..=PI).contains(&angle) {
        let degrees = angle.to_degrees();
        let message = format!("found the angle {degrees} deg in `{key}`, expected 0 to 180 deg between leg and axis");
        return Err(scope.fail(angle_node.line, message));
    }
    // Squares of large coordinates may leave f64.
    Ok(Cone { axis: axis.map(|x| x / size), angle })
}
