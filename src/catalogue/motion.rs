//! Rational motions: a motion polynomial by its coefficients or by its linear factors.

use super::heading::{Heading, heading};
use super::node::Node;
use super::scope::Scope;
use crate::algebra::number::{Number, Quantity};
use crate::error::{Error, Result};
use crate::kinematics::dual_quaternion::DualQuaternion;
use crate::kinematics::motion::dot;
use crate::kinematics::motion_polynomial::{Flaw, MotionPolynomial, from_coefficients, from_parts, monic, product};
use rug::Rational;

/// Degrees that can be factored: there are up to n! factorisations.
const DEGREES: std::ops::RangeInclusive<usize> = 2..=5;

/// A file with a rational motion, as read.
#[derive(Clone, Debug)]
pub struct MotionFile {
    /// Title, source and remarks.
    pub heading: Heading,
    /// The motion polynomial, monic.
    pub polynomial: MotionPolynomial<Rational>,
    /// Claimed number of factorisations.
    pub factorisations: Option<usize>,
    /// Claimed loop, such as `6R`.
    pub closed_loop: Option<String>,
    /// Claimed order of the screw system of the loop.
    pub order: Option<usize>,
    /// Claimed dimension of the motions of the loop.
    pub dimension: Option<usize>,
    /// Line of the claims, from 1.
    pub line: usize,
}

/// Reads the file of a rational motion.
pub(super) fn motion(scope: &mut Scope<'_>, root: &Node, name: &str) -> Result<MotionFile> {
    let heading = heading(scope, root, name)?;
    let table = scope.table(root, "the file", &["title", "source", "notes", "units", "mechanism", "expected"])?;
    let node = scope.need(&table, "mechanism")?;
    let mechanism = scope.table(node, "the [mechanism] of a motion", &["kind", "polynomial", "factors"])?;
    let (line, polynomial) = match (mechanism.get("polynomial"), mechanism.get("factors")) {
        (Some(node), None) => (node.line, from_coefficients(&coefficients(scope, node)?)),
        (None, Some(node)) => (node.line, product(&factors(scope, node)?)),
        (found, _) => {
            let found = if found.is_some() { "both" } else { "neither" };
            let message = format!("found {found} of `polynomial` and `factors` in [mechanism], expected one of them");
            return Err(scope.fail(node.line, message));
        }
    };
    if scope.is_rounded() {
        return Err(scope.fail(line, "found numbers that are not rational, expected rational ones: factors are exact"));
    }
    let polynomial = monic(&polynomial).map_err(|flaw| {
        scope.fail(line, match flaw {
            Flaw::Constant => "found a constant polynomial, expected a motion",
            Flaw::Leading => {
                "found a leading coefficient without rotation (no inverse), expected one that can be divided by; try t + 1/t or \
                 another parameter"
            }
            Flaw::Study => {
                "found a polynomial off the Study quadric, expected a motion: x0 y0 + x1 y1 + x2 y2 + x3 y3 must vanish for all t"
            }
        })
    })?;
    let claims = table.get("expected");
    let mut file = MotionFile {
        heading,
        polynomial,
        factorisations: None,
        closed_loop: None,
        order: None,
        dimension: None,
        line: claims.map_or(node.line, |node| node.line),
    };
    if let Some(node) = claims {
        let claims =
            scope.table(node, "the [expected] of a motion", &["factorisations", "loop", "order", "dimension"])?;
        let count = |key: &str| claims.get(key).map(|node| scope.count(node, key)).transpose();
        file.factorisations = count("factorisations")?;
        file.closed_loop = claims.get("loop").map(|node| scope.text(node, "loop").map(str::to_owned)).transpose()?;
        file.order = count("order")?;
        file.dimension = count("dimension")?;
    }
    Ok(file)
}

fn check_degree(scope: &Scope<'_>, line: usize, degree: usize) -> Result<()> {
    if DEGREES.contains(&degree) {
        return Ok(());
    }
    let (least, most) = (DEGREES.start(), DEGREES.end());
    let message = format!("found a motion polynomial of degree {degree}, expected {least} to {most}");
    let error = scope.fail(line, &message);
    Err(if degree > *most { Error::Unsupported(message).at(scope.path, line) } else { error })
}

/// Reads the coefficients, constant term first, eight numbers each.
fn coefficients(scope: &Scope<'_>, node: &Node) -> Result<Vec<DualQuaternion<Rational>>> {
    let items = scope.list(node, "polynomial")?;
    check_degree(scope, node.line, items.len().saturating_sub(1))?;
    let one = |item: &Node| {
        let mut parts: [Rational; 8] = std::array::from_fn(|_| Rational::new());
        for (part, node) in parts.iter_mut().zip(scope.exactly::<8>(item, "a coefficient")?) {
            part.clone_from(scope.number(node, Quantity::Ratio, "polynomial")?.rational());
        }
        Ok(from_parts(&parts))
    };
    items.iter().map(one).collect()
}

/// Reads the factors `t - h` from left to right.
fn factors(scope: &Scope<'_>, node: &Node) -> Result<Vec<DualQuaternion<Rational>>> {
    let items = scope.list(node, "factors")?;
    check_degree(scope, node.line, items.len())?;
    let one = |item: &Node| {
        let table = scope.table(item, "a factor", &["scalar", "direction", "moment"])?;
        let scalar = match table.get("scalar") {
            Some(node) => scope.number(node, Quantity::Ratio, "scalar")?,
            None => Number::zero(),
        };
        let vector = |key: &str| {
            let numbers = scope.vector(scope.need(&table, key)?, Quantity::Ratio, key)?;
            Ok::<_, Error>(numbers.each_ref().map(|x| x.rational().clone()))
        };
        let (direction, moment) = (vector("direction")?, vector("moment")?);
        if dot(&direction, &moment) != 0 {
            let message = "found a moment that is not perpendicular to its direction, expected the Pluecker coordinates of a line";
            return Err(scope.fail(item.line, message));
        }
        if direction.iter().chain(&moment).all(|x| *x == 0) {
            return Err(scope
                .fail(item.line, "found a factor without direction and moment, expected a rotation or translation"));
        }
        let [[x, y, z], [u, v, w]] = [direction, moment];
        Ok(from_parts(&[scalar.rational().clone(), x, y, z, Rational::new(), u, v, w]))
    };
    items.iter().map(one).collect()
}
