//! Stewart platforms: their points, the lengths of their legs, and checks of these.

use super::entry::{Case, Claim};
use super::node::Node;
use super::scope::{Scope, Table};
use crate::algebra::number::{Number, Quantity};
use crate::error::Result;
use crate::kinematics::motion::{Vector, cross, dot};
use crate::kinematics::platform::Platform;
use crate::kinematics::platform_limits::PlatformLimits;
use rug::Rational;

/// The keys of the `[mechanism]` of a platform.
pub(super) const KEYS: [&str; 8] =
    ["kind", "base", "plate", "legs", "legs_squared", "limits", "base_cones", "plate_cones"];
/// Points nearer to a line than this, relative to their extent, are taken to lie on it.
const ON_A_LINE: f64 = 1e-12;
/// Maximum deviation from 1 of the norm of a claimed quaternion.
const NORM: f64 = 1e-3;

/// The points of a platform, its limits, and the legs if the `[mechanism]` gives them.
type Read = (Platform<Number>, PlatformLimits, Option<Case>);

/// Reads the `[mechanism]` of a platform.
pub(super) fn platform(scope: &Scope<'_>, node: &Node) -> Result<Read> {
    let table = scope.table(node, "the [mechanism] of a platform", &KEYS)?;
    let base = points(scope, scope.need(&table, "base")?, "base")?;
    let plate_node = scope.need(&table, "plate")?;
    let plate = points(scope, plate_node, "plate")?;
    for second in 1..6 {
        let same = |first: &usize| base[*first] == base[second] && plate[*first] == plate[second];
        if let Some(first) = (0..second).find(same) {
            let (first, line) = (first + 1, scope.list(plate_node, "plate")?[second].line);
            let message = format!(
                "found legs {first} and {} between the same two points, expected six different legs",
                second + 1
            );
            return Err(scope.fail(line, message));
        }
    }
    let platform = Platform { base, plate };
    let case = if table.get("legs").or_else(|| table.get("legs_squared")).is_some() {
        Some(legs(scope, &table, ["legs", "legs_squared"], "the [mechanism]")?)
    } else {
        None
    };
    Ok((platform, super::platform_limits::limits(scope, &table)?, case))
}

/// Reads the points of one body, which must not lie on a line.
fn points(scope: &Scope<'_>, node: &Node, what: &str) -> Result<[[Number; 3]; 6]> {
    let nodes = scope.list(node, what)?;
    let points: Vec<[Number; 3]> =
        nodes.iter().map(|point| scope.vector(point, Quantity::Length, what)).collect::<Result<_>>()?;
    let points: [[Number; 3]; 6] = points.try_into().map_err(|points: Vec<_>| {
        scope.fail(node.line, format!("found {} points in `{what}`, expected 6, one per leg", points.len()))
    })?;
    let exact = points.each_ref().map(|point| point.each_ref().map(|x| x.rational().clone()));
    let from_first: [Vector<Rational>; 6] =
        exact.each_ref().map(|p| std::array::from_fn(|k| Rational::from(&p[k] - &exact[0][k])));
    let squares = from_first.each_ref().map(|d| dot(d, d));
    let farthest = (1..6).fold(0, |best, k| if squares[k] > squares[best] { k } else { best });
    if squares[farthest] == 0 {
        return Err(scope.fail(node.line, format!("found six equal points in `{what}`, expected a body of some size")));
    }
    // |d x e|^2 <= (tolerance |d|^2)^2, in rationals: squares of squares may leave f64.
    let tolerance = Rational::from_f64(ON_A_LINE * ON_A_LINE).unwrap_or_default();
    let allowed = tolerance * Rational::from(squares[farthest].square_ref());
    let off = |d: &Vector<Rational>| {
        let across = cross(&from_first[farthest], d);
        dot(&across, &across)
    };
    if from_first.iter().all(|d| off(d) <= allowed) {
        let message = format!(
            "found all points of `{what}` on one line, about which the platform turns freely; expected some beside it"
        );
        return Err(scope.fail(node.line, message));
    }
    Ok(points)
}

/// Reads a table of `[[legs]]`.
pub(super) fn leg_lengths(scope: &Scope<'_>, node: &Node) -> Result<Case> {
    let table = scope.table(node, "[[legs]]", &["lengths", "squared", "expected", "solution"])?;
    let case = legs(scope, &table, ["lengths", "squared"], "[[legs]]")?;
    Ok(Case { expected: super::job::expected(scope, &table, &claim)?, line: table.line(), ..case })
}

/// Reads six lengths or their squares, by these two keys.
fn legs(scope: &Scope<'_>, table: &Table<'_>, keys: [&str; 2], place: &str) -> Result<Case> {
    let [lengths, squared] = keys;
    let (node, key) = match (table.get(lengths), table.get(squared)) {
        (Some(node), None) => (node, lengths),
        (None, Some(node)) => (node, squared),
        (found, _) => {
            let found = if found.is_some() { "both" } else { "neither" };
            let message = format!("found {found} of `{lengths}` and `{squared}` in {place}, expected one of them");
            return Err(scope.fail(found_line(table, keys), message));
        }
    };
    let nodes = scope.list(node, key)?;
    let mut squares = Vec::new();
    for (index, item) in nodes.iter().enumerate() {
        let number = if key == lengths { scope.rooted(item, key)? } else { square(scope, item, key)? };
        if *number.rational() < 0 {
            let (leg, found) = (index + 1, number.to_f64());
            let what = if key == lengths { "length" } else { "squared length" };
            return Err(
                scope.fail(item.line, format!("found the negative {what} {found} of leg {leg}, expected 0 or more"))
            );
        }
        squares.push(if key == lengths { number.squared() } else { number });
    }
    let squares: [Number; 6] = squares.try_into().map_err(|squares: Vec<_>| {
        scope.fail(node.line, format!("found {} values in `{key}`, expected 6, one per leg", squares.len()))
    })?;
    Ok(Case::legs(squares, node.line))
}

fn found_line(table: &Table<'_>, keys: [&str; 2]) -> usize {
    table.get(keys[1]).map_or(table.line(), |node| node.line)
}

/// Reads the square of a length: a number in the square of the unit of length.
fn square(scope: &Scope<'_>, node: &Node, what: &str) -> Result<Number> {
    let number = scope.number(node, Quantity::Ratio, what)?;
    Ok(number.scaled(&Rational::from(scope.reading.length.square_ref())))
}

/// Reads a `[[solution]]` of a platform.
pub(super) fn claim(scope: &Scope<'_>, node: &Node) -> Result<Claim> {
    let table = scope.table(node, "the [[solution]] of a platform", &["quaternion", "position", "digits"])?;
    // Claims are compared in f64, so rounding them does not make the mechanism inexact.
    let own = Scope::new(scope.path, scope.reading.clone());
    let quaternion = scope.need(&table, "quaternion")?;
    let mut q = Vec::with_capacity(7);
    for item in own.exactly::<4>(quaternion, "quaternion")? {
        q.push(own.number(item, Quantity::Ratio, "quaternion")?.to_f64());
    }
    let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    if !((norm - 1.0).abs() <= NORM) {
        let message = format!("found a quaternion of norm {norm:.6}, expected 1 to within {NORM:e}");
        return Err(scope.fail(quaternion.line, message));
    }
    for component in &mut q {
        *component /= norm;
    }
    let position = own.vector(scope.need(&table, "position")?, Quantity::Length, "position")?;
    q.extend(position.iter().map(Number::to_f64));
    Ok(Claim { q, digits: super::job::digits(scope, &table)?, line: table.line() })
}
