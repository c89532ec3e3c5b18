//! Masses of the bodies of a linkage, and gravity.

use super::node::{Node, Value};
use super::scope::{Scope, Table};
use crate::algebra::number::Quantity;
use crate::error::Result;
use crate::kinematics::linkage::{Gaussian, Linkage};
use rug::Rational;

/// The mass of a body.
///
/// # Units
/// Kilograms, metres, kilogram square metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Mass {
    /// The mass.
    pub mass: f64,
    /// The centre of mass in coordinates of the body.
    pub centre: [f64; 2],
    /// The moment of inertia about the centre.
    pub inertia: f64,
    /// Mass and centre as given in the file; `None` if one of them is not rational.
    pub exact: Option<(Rational, Gaussian)>,
}

/// The masses and the gravity that act on a linkage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Masses {
    /// The mass of every body; bodies without one are massless.
    pub bodies: Vec<Option<Mass>>,
    /// The acceleration of gravity, metres per square second.
    pub gravity: [f64; 2],
}

impl Masses {
    /// Returns whether no body has a mass.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.bodies.iter().all(Option::is_none)
    }
}

/// Reads `mass` and `gravity` of `[mechanism]`.
pub(super) fn masses(scope: &Scope<'_>, mechanism: &Table<'_>, linkage: &Linkage) -> Result<Masses> {
    // Masses are used in f64 only, so rounding them does not make the mechanism inexact.
    let scope = &Scope::new(scope.path, scope.reading.clone());
    let mut found = Masses { bodies: vec![None; linkage.bodies.len()], gravity: [0.0; 2] };
    if let Some(node) = mechanism.get("gravity") {
        let [x, y] = scope.exactly::<2>(node, "gravity")?;
        let number = |node: &Node| scope.number(node, Quantity::Ratio, "gravity").map(|g| g.to_f64());
        found.gravity = [number(x)?, number(y)?];
    }
    let Some(node) = mechanism.get("mass") else { return Ok(found) };
    let Value::Table(fields) = &node.value else {
        return Err(scope.fail(node.line, format!("found {} as `mass`, expected a table of bodies", node.describe())));
    };
    for field in fields {
        let body = linkage.bodies.iter().position(|body| body.name == field.key);
        let body = body.ok_or_else(|| {
            let name: String = field.key.chars().take(40).collect();
            scope.fail(
                field.line,
                format!("found the mass of the unknown body `{name}`, expected one of [mechanism.bodies]"),
            )
        })?;
        if body == linkage.ground {
            return Err(
                scope.fail(field.line, "found a mass of the ground, which does not move, expected one of another body")
            );
        }
        found.bodies[body] = Some(mass(scope, &field.node)?);
    }
    Ok(found)
}

fn mass(scope: &Scope<'_>, node: &Node) -> Result<Mass> {
    let table = scope.table(node, "the mass of a body", &["mass", "centre", "inertia"])?;
    let number = |key: &str| {
        let node = scope.need(&table, key)?;
        let found = scope.number(node, Quantity::Ratio, key)?.to_f64();
        if found >= 0.0 {
            return Ok(found);
        }
        Err(scope.fail(node.line, format!("found the negative `{key}` {found}, expected 0 or more")))
    };
    let [x, y] = scope.exactly::<2>(scope.need(&table, "centre")?, "centre")?;
    let (x, y) = (scope.length(x, "centre")?, scope.length(y, "centre")?);
    let weight = scope.number(scope.need(&table, "mass")?, Quantity::Ratio, "mass")?;
    let is_exact = x.is_exact() && y.is_exact() && weight.is_exact();
    let exact =
        is_exact.then(|| (weight.rational().clone(), Gaussian { re: x.rational().clone(), im: y.rational().clone() }));
    Ok(Mass { mass: number("mass")?, centre: [x.to_f64(), y.to_f64()], inertia: number("inertia")?, exact })
}
