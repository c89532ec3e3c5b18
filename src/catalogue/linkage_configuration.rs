//! A configuration of a planar linkage: the angle of every body against the ground, and positions where slides need them.

use super::linkage::{angle_of, body_named, rotation};
use super::node::{Node, Value};
use super::scope::Scope;
use crate::error::Result;
use crate::kinematics::linkage::{Gaussian, Linkage};

/// Where the bodies of a linkage stand.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkageConfiguration {
    /// Of every body its rotation against the ground, of norm 1; 1 of the ground.
    pub turns: Vec<Gaussian>,
    /// The places of origins, metres, where they are given.
    pub origins: Vec<Option<Gaussian>>,
    /// Whether all numbers are exact.
    pub exact: bool,
    /// Line of the file, from 1.
    pub line: usize,
}

/// Reads `[configuration]`.
pub(super) fn configuration(scope: &Scope<'_>, node: &Node, linkage: &Linkage) -> Result<LinkageConfiguration> {
    let Value::Table(fields) = &node.value else {
        let message = format!("found {} as `configuration`, expected a table of bodies", node.describe());
        return Err(scope.fail(node.line, message));
    };
    let count = linkage.bodies.len();
    let mut turns: Vec<Option<Gaussian>> = vec![None; count];
    let mut origins: Vec<Option<Gaussian>> = vec![None; count];
    let one = || Gaussian { re: 1.into(), im: 0.into() };
    turns[linkage.ground] = Some(one());
    let mut exact = true;
    for field in fields {
        let body = body_named(scope, linkage, &field.key, field.line)?;
        if body == linkage.ground {
            let message = format!("found the ground {} in the configuration, expected the other bodies", field.key);
            return Err(scope.fail(field.line, message));
        }
        let what = format!("configuration.{}", field.key);
        let table = scope.table(&field.node, &what, &["angle", "tan_half", "position"])?;
        let (rotation, is_exact) = rotation(&angle_of(scope, &table, &what)?);
        turns[body] = Some(rotation);
        exact &= is_exact;
        if let Some(node) = table.get("position") {
            let [x, y] = scope.exactly::<2>(node, "position")?;
            let (x, y) = (scope.length(x, "position")?, scope.length(y, "position")?);
            exact &= x.is_exact() && y.is_exact();
            origins[body] = Some(Gaussian { re: x.rational().clone(), im: y.rational().clone() });
        }
    }
    if let Some(missing) = turns.iter().position(Option::is_none) {
        let name = &linkage.bodies[missing].name;
        return Err(
            scope.fail(node.line, format!("found a configuration without the body {name}, expected every body"))
        );
    }
    Ok(LinkageConfiguration { turns: turns.into_iter().flatten().collect(), origins, exact, line: node.line })
}
