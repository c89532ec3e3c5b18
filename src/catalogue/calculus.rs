//! Files of the calculus: questions about displacements, lines and gears.

use super::displacement::{Displacement, displacement};
use super::file_kind::FileKind;
use super::gearing::{Gearing, gearing};
use super::heading::{Heading, heading_with};
use super::lines::{Lines, lines};
use super::node::Node;
use super::scope::{Scope, Table};
use crate::algebra::number::{Number, Quantity};
use crate::error::Result;
use crate::kinematics::motion::Vector;
use rug::Rational;

/// A calculus file as read.
#[derive(Clone, Debug)]
pub struct CalculusFile {
    /// Title, source and remarks.
    pub heading: Heading,
    /// The question of the file.
    pub question: Question,
    /// Whether some number of the file had to be replaced by a nearby rational.
    pub rounded: bool,
    /// Warnings about matrices that were replaced by rotations.
    pub warnings: Vec<String>,
    /// The claims of the file about every problem.
    pub claims: Claims,
}

/// The question of a calculus file.
#[derive(Clone, Debug)]
pub enum Question {
    /// Displacements with some property.
    Displacement(Box<Displacement>),
    /// Lines and complexes of lines.
    Lines(Box<Lines>),
    /// Gears and wheels.
    Gearing(Box<Gearing>),
}

/// Claimed counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Claims {
    /// Isolated complex solutions, with multiplicity.
    pub complex: Option<usize>,
    /// Isolated real solutions.
    pub real: Option<usize>,
    /// Dimension of the solution set.
    pub dimension: Option<usize>,
    /// Line of the claims, from 1.
    pub line: usize,
}

impl CalculusFile {
    /// Returns the kind of the file.
    #[must_use]
    pub fn kind(&self) -> FileKind {
        match self.question {
            Question::Displacement(_) => FileKind::Displacement,
            Question::Lines(_) => FileKind::Lines,
            Question::Gearing(_) => FileKind::Gearing,
        }
    }

    /// Returns the value of `find`.
    #[must_use]
    pub fn find(&self) -> &'static str {
        match &self.question {
            Question::Displacement(question) => question.word(),
            Question::Lines(question) => question.word(),
            Question::Gearing(question) => question.word(),
        }
    }
}

/// The keys of the lists in questions.
const PARTS: [&str; 15] = [
    "element", "rotation", "pair", "screw", "point", "line", "complex", "plane", "force", "couple", "shaft", "gear",
    "relation", "wheel", "interval",
];

/// Reads a file of the calculus.
pub(super) fn calculus(scope: &mut Scope<'_>, root: &Node, name: &str, kind: FileKind) -> Result<CalculusFile> {
    let parts = &PARTS;
    let heading = heading_with(scope, root, name, parts.as_slice())?;
    let keys = [&["title", "source", "notes", "units", "mechanism", "expected"], parts.as_slice()].concat();
    let table = scope.table(root, "the file", &keys)?;
    let question = match kind {
        FileKind::Lines => Question::Lines(Box::new(lines(scope, &table)?)),
        FileKind::Gearing => Question::Gearing(Box::new(gearing(scope, &table)?)),
        _ => Question::Displacement(Box::new(displacement(scope, &table)?)),
    };
    let claims = claims(scope, &table)?;
    let (rounded, warnings) = (scope.is_rounded(), scope.take_warnings());
    Ok(CalculusFile { heading, question, rounded, warnings, claims })
}

fn claims(scope: &Scope<'_>, table: &Table<'_>) -> Result<Claims> {
    let Some(node) = table.get("expected") else { return Ok(Claims { line: table.line(), ..Claims::default() }) };
    let claims = scope.table(node, "[expected]", &["complex", "real", "dimension"])?;
    let count = |key: &str| claims.get(key).map(|node| scope.count(node, key)).transpose();
    Ok(Claims { complex: count("complex")?, real: count("real")?, dimension: count("dimension")?, line: node.line })
}

/// Returns the value of `find` in `[mechanism]`, one of those allowed, and the table.
pub(super) fn found<'n>(
    scope: &Scope<'_>,
    table: &Table<'n>,
    words: &[&str],
    keys: &[&str],
) -> Result<(&'n str, Table<'n>, usize)> {
    let node = scope.need(table, "mechanism")?;
    let mechanism = scope.table(node, "[mechanism]", &[&["kind", "find"], keys].concat())?;
    let find = scope.word(scope.need(&mechanism, "find")?, "find", words)?;
    Ok((find, mechanism, node.line))
}

/// Returns the tables of a required list, with the keys that they may have; no list but those named may occur in the file.
pub(super) fn parts<'n>(
    scope: &Scope<'_>,
    table: &Table<'n>,
    key: &str,
    allowed: &[&str],
    others: &[&str],
) -> Result<Vec<(Table<'n>, &'n Node)>> {
    for other in PARTS {
        if other != key
            && !others.contains(&other)
            && let Some(node) = table.get(other)
        {
            return Err(scope.fail(node.line, format!("found [[{other}]], expected [[{key}]] for this `find`")));
        }
    }
    let node = scope.need(table, key)?;
    let what = format!("[[{key}]]");
    scope.list(node, key)?.iter().map(|item| Ok((scope.table(item, &what, allowed)?, item))).collect()
}

/// Checks that a file has no lists, for a question that needs none.
pub(super) fn none(scope: &Scope<'_>, table: &Table<'_>, find: &str) -> Result<()> {
    match PARTS.into_iter().find_map(|key| Some((key, table.get(key)?))) {
        None => Ok(()),
        Some((key, node)) => {
            Err(scope.fail(node.line, format!("found [[{key}]], expected none for `find = \"{find}\"`")))
        }
    }
}

/// Checks that a list has exactly this many items.
pub(super) fn counted<T>(scope: &Scope<'_>, line: usize, items: Vec<T>, key: &str, count: usize) -> Result<Vec<T>> {
    if items.len() == count {
        return Ok(items);
    }
    Err(scope.fail(line, format!("found {} [[{key}]], expected {count}", items.len())))
}

/// Returns the line at which a list begins, else that of the file.
pub(super) fn line_of(table: &Table<'_>, key: &str) -> usize {
    table.get(key).map_or_else(|| table.line(), |node| node.line)
}

/// Reads a vector of rationals that is not zero.
pub(super) fn direction(scope: &Scope<'_>, node: &Node, what: &str) -> Result<Vector<Rational>> {
    let vector = numbers(&scope.vector(node, Quantity::Ratio, what)?);
    if vector.iter().all(|c| *c == 0) {
        return Err(scope.fail(node.line, format!("found the zero vector as `{what}`, expected a direction")));
    }
    Ok(vector)
}

/// Reads the coordinates of a point.
pub(super) fn point(scope: &Scope<'_>, node: &Node, what: &str) -> Result<Vector<Rational>> {
    Ok(numbers(&scope.vector(node, Quantity::Length, what)?))
}

fn numbers(vector: &[Number; 3]) -> Vector<Rational> {
    vector.each_ref().map(|c| c.rational().clone())
}
