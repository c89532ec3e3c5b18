//! Kind `lines`: questions about lines and about linear complexes of lines.

use super::calculus::{counted, direction, found, line_of, parts, point};
use super::node::Node;
use super::scope::{Scope, Table};
use crate::algebra::number::Quantity;
use crate::error::Result;
use crate::kinematics::motion::{Vector, dot};
use looproot_calculus::displacement::cylindroid::Pitched;
use looproot_calculus::line::complex::Complex;
use looproot_calculus::line::pluecker::Line;
use rug::Rational;

/// The keys of a `[[line]]`.
pub(super) const LINE: [&str; 4] = ["through", "point", "direction", "moment"];

/// A question about lines.
#[derive(Clone, Debug)]
pub enum Lines {
    /// The lines that meet four lines.
    Transversals([Line<Rational>; 4]),
    /// The complex of five lines, and the points whose null planes are asked for.
    Complex(Vec<Line<Rational>>, Vec<Vector<Rational>>),
    /// The cylindroid of two screws.
    Cylindroid([Pitched<Rational>; 2]),
    /// The common perpendicular of two lines.
    Perpendicular([Line<Rational>; 2]),
    /// The directrices of the lines that two complexes share.
    Congruence([Complex<Rational>; 2]),
    /// The quadric of three lines.
    Regulus([Line<Rational>; 3]),
}

impl Lines {
    /// The word behind `find`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Transversals(_) => "transversals",
            Self::Complex(..) => "complex",
            Self::Cylindroid(_) => "cylindroid",
            Self::Perpendicular(_) => "perpendicular",
            Self::Congruence(_) => "congruence",
            Self::Regulus(_) => "regulus",
        }
    }
}

/// Reads the question of a file of kind `lines`.
pub(super) fn lines(scope: &Scope<'_>, table: &Table<'_>) -> Result<Lines> {
    let words = ["transversals", "complex", "cylindroid", "perpendicular", "congruence", "regulus"];
    let (find, _, line) = found(scope, table, &words, &[])?;
    let wrong = || scope.fail(line, "found another number of parts than the question has, expected that number");
    Ok(match find {
        "transversals" => Lines::Transversals(given(scope, table, 4, &[])?.try_into().map_err(|_| wrong())?),
        "perpendicular" => Lines::Perpendicular(given(scope, table, 2, &[])?.try_into().map_err(|_| wrong())?),
        "regulus" => Lines::Regulus(given(scope, table, 3, &[])?.try_into().map_err(|_| wrong())?),
        "complex" => {
            let lines = given(scope, table, 5, &["point"])?;
            let points = match table.get("point") {
                Some(node) => {
                    let one = |item: &Node| {
                        let own = scope.table(item, "[[point]]", &["at"])?;
                        point(scope, scope.need(&own, "at")?, "at")
                    };
                    scope.list(node, "point")?.iter().map(one).collect::<Result<_>>()?
                }
                None => Vec::new(),
            };
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
        _ => {
            let complexes = parts(scope, table, "complex", &["a", "b"], &[])?;
            let complexes = counted(scope, line_of(table, "complex"), complexes, "complex", 2)?;
            let one = |(own, node): &(Table<'_>, &Node)| {
                let vector = |key: &str, quantity: Quantity| {
                    let found = scope.vector(scope.need(own, key)?, quantity, key)?;
                    Ok::<_, crate::error::Error>(found.each_ref().map(|c| c.rational().clone()))
                };
                let complex = Complex { a: vector("a", Quantity::Ratio)?, b: vector("b", Quantity::Length)? };
                if complex.a.iter().chain(&complex.b).all(|c| *c == 0) {
                    return Err(scope
                        .fail(node.line, "found a [[complex]] of zeros, expected two vectors that are not both zero"));
                }
                Ok(complex)
            };
            let complexes: Vec<_> = complexes.iter().map(one).collect::<Result<_>>()?;
            Lines::Congruence(complexes.try_into().map_err(|_| wrong())?)
        }
    })
}

/// Exactly this many lines.
fn given(scope: &Scope<'_>, table: &Table<'_>, count: usize, others: &[&str]) -> Result<Vec<Line<Rational>>> {
    let lines = parts(scope, table, "line", &LINE, others)?;
    let lines = counted(scope, line_of(table, "line"), lines, "line", count)?;
    lines.iter().map(|(line, node)| pluecker(scope, line, node)).collect()
}

/// A line by two points, by a point and a direction, or by direction and moment.
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
