//! Frameworks: vertices, bars, rods and bodies, and checks of these.

use super::heading::{Heading, heading};
use super::node::{Field, Node, Value};
use super::scope::{Scope, Table, nearest};
use crate::algebra::number::{Number, Quantity, nearest_f64};
use crate::error::{Error, Result};
use crate::kinematics::framework::{Framework, Mobility, mobility, mobility_with_lengths};
use crate::kinematics::motion::Vector;
use rug::Rational;

/// Maximum number of vertices of a framework: the rigidity matrices are dense.
const MOST_VERTICES: usize = 100;

/// A framework file as read.
#[derive(Clone, Debug)]
pub struct FrameworkFile {
    /// Title, source and remarks.
    pub heading: Heading,
    /// The names of the vertices.
    pub names: Vec<String>,
    /// The bodies, by their vertices.
    pub bodies: Vec<Vec<usize>>,
    /// The framework with the vertices of the file.
    pub framework: Framework<Rational>,
    /// The squared length of every bar, if the file gives lengths; then its vertices are the start of the search for a
    /// realisation.
    pub squares: Option<Vec<Rational>>,
    /// Whether every number of the file is exact.
    pub exact: bool,
    /// Claimed dimension of the motions.
    pub dimension: Option<usize>,
    /// Claimed number of infinitesimal motions.
    pub infinitesimal: Option<usize>,
    /// Line of the claims, from 1.
    pub line: usize,
}

impl FrameworkFile {
    /// Decides whether the framework moves, and follows its motion for a number of steps in f64.
    ///
    /// # Errors
    /// If there is no realisation with the given lengths near the given vertices.
    pub fn mobility(&self, steps: usize) -> Result<Mobility> {
        let found = match (&self.squares, self.exact) {
            (None, true) => mobility(&self.framework, steps),
            (given, _) => {
                let squares = given.clone().unwrap_or_else(|| self.framework.squares());
                let start = self.framework.map(|q| Some(nearest_f64(q)));
                start.and_then(|start| mobility_with_lengths(&start, &squares, self.exact, steps))
            }
        };
        found.ok_or_else(|| {
            let name = &self.heading.name;
            Error::Invalid(format!(
                "{name}: found no realisation with the given lengths near the given vertices, expected one"
            ))
        })
    }
}

/// Reads a framework file.
pub(super) fn framework(scope: &mut Scope<'_>, root: &Node, name: &str) -> Result<FrameworkFile> {
    let heading = heading(scope, root, name)?;
    let table = scope.table(root, "the file", &["title", "source", "notes", "units", "mechanism", "expected"])?;
    let node = scope.need(&table, "mechanism")?;
    let keys = ["kind", "vertices", "bars", "bodies", "lengths", "lengths_squared"];
    let mechanism = scope.table(node, "the [mechanism] of a framework", &keys)?;
    let (names, vertices) = vertices(scope, scope.need(&mechanism, "vertices")?)?;
    let bodies = match mechanism.get("bodies") {
        Some(node) => bodies(scope, node, &names)?,
        None => Vec::new(),
    };
    if !bodies.is_empty() && scope.is_rounded() {
        let message = "found bodies between vertices that are not rational, expected exact coordinates: which points of a body \
                       are in a line or a plane must be decided";
        return Err(scope.fail(mechanism.get("bodies").map_or(node.line, |node| node.line), message));
    }
    let bars = match mechanism.get("bars") {
        Some(node) => bars(scope, node, &names)?,
        None if bodies.is_empty() => scope.need(&mechanism, "bars").map(|_| Vec::new())?,
        None => Vec::new(),
    };
    for (vertex, name) in names.iter().enumerate() {
        if !bars.iter().flatten().chain(bodies.iter().flatten()).any(|v| *v == vertex) {
            return Err(scope.fail(node.line, format!("found no bar and no body at vertex {name}, expected one")));
        }
    }
    let framework = Framework::new(vertices, &bars, &bodies);
    let squares = squares(scope, &mechanism, &framework)?;
    let (dimension, infinitesimal, line) = match table.get("expected") {
        Some(node) => {
            let claims = scope.table(node, "the [expected] of a framework", &["dimension", "infinitesimal"])?;
            let count = |key: &str| claims.get(key).map(|node| scope.count(node, key)).transpose();
            (count("dimension")?, count("infinitesimal")?, node.line)
        }
        None => (None, None, node.line),
    };
    Ok(FrameworkFile {
        heading,
        names,
        bodies,
        framework,
        squares,
        exact: !scope.is_rounded(),
        dimension,
        infinitesimal,
        line,
    })
}

/// Reads the vertices: a table of names, or a list, whose vertices are named by their numbers from 1.
fn vertices(scope: &Scope<'_>, node: &Node) -> Result<(Vec<String>, Vec<Vector<Rational>>)> {
    let named: Vec<(String, &Node)> = match &node.value {
        Value::Table(fields) => fields.iter().map(|Field { key, node, .. }| (key.clone(), node)).collect(),
        _ => scope.list(node, "vertices")?.iter().enumerate().map(|(k, node)| ((k + 1).to_string(), node)).collect(),
    };
    if !(2..=MOST_VERTICES).contains(&named.len()) {
        let message = format!("found {} vertices, expected 2 to {MOST_VERTICES}", named.len());
        return Err(scope.fail(node.line, message));
    }
    let (mut names, mut vertices): (Vec<String>, Vec<Vector<Rational>>) = (Vec::new(), Vec::new());
    for (name, node) in named {
        let numbers = scope.vector(node, Quantity::Length, &format!("vertices.{name}"))?;
        let vertex = numbers.each_ref().map(|x| x.rational().clone());
        if let Some(other) = vertices.iter().position(|v| *v == vertex) {
            let message =
                format!("found vertices {} and {name} at the same place, expected different points", names[other]);
            return Err(scope.fail(node.line, message));
        }
        names.push(name);
        vertices.push(vertex);
    }
    Ok((names, vertices))
}

/// Returns the index of a vertex by its name.
fn vertex(scope: &Scope<'_>, node: &Node, names: &[String]) -> Result<usize> {
    let name = match &node.value {
        Value::Text(text) | Value::Number(text) => text.as_str(),
        _ => scope.text(node, "a vertex")?,
    };
    names.iter().position(|known| known == name).ok_or_else(|| {
        let near = nearest(name, names.iter().map(String::as_str));
        let hint = match near.first() {
            Some(near) => format!("did you mean {near}?"),
            None => format!("expected one of {}", shortened(names)),
        };
        let name: String = name.chars().take(40).collect();
        scope.fail(node.line, format!("found the unknown vertex `{name}`; {hint}"))
    })
}

/// Returns the first few names.
fn shortened(names: &[String]) -> String {
    let shown = names.iter().take(12).cloned().collect::<Vec<_>>().join(", ");
    if names.len() > 12 { format!("{shown}, ...") } else { shown }
}

/// Reads the bars: pairs of vertices, each once.
fn bars(scope: &Scope<'_>, node: &Node, names: &[String]) -> Result<Vec<[usize; 2]>> {
    let mut bars: Vec<[usize; 2]> = Vec::new();
    for item in scope.list(node, "bars")? {
        let [a, b] = scope.exactly::<2>(item, "a bar")?;
        let (a, b) = (vertex(scope, a, names)?, vertex(scope, b, names)?);
        if a == b {
            let message = format!("found a bar from {} to itself, expected two vertices", names[a]);
            return Err(scope.fail(item.line, message));
        }
        let bar = [a.min(b), a.max(b)];
        if bars.contains(&bar) {
            let message = format!("found the bar {} {} twice, expected it once", names[a], names[b]);
            return Err(scope.fail(item.line, message));
        }
        bars.push(bar);
    }
    Ok(bars)
}

/// Reads the bodies: lists of at least three vertices, each once.
fn bodies(scope: &Scope<'_>, node: &Node, names: &[String]) -> Result<Vec<Vec<usize>>> {
    let mut bodies = Vec::new();
    for item in scope.list(node, "bodies")? {
        let mut body = Vec::new();
        for node in scope.list(item, "a body")? {
            let vertex = vertex(scope, node, names)?;
            if body.contains(&vertex) {
                let message = format!("found vertex {} twice in a body, expected it once", names[vertex]);
                return Err(scope.fail(node.line, message));
            }
            body.push(vertex);
        }
        if body.len() < 3 {
            let message = format!("found a body of {} vertices, expected at least 3; two are a bar", body.len());
            return Err(scope.fail(item.line, message));
        }
        bodies.push(body);
    }
    Ok(bodies)
}

/// Reads the squared lengths of all bars if the file gives some; those of bodies follow from their vertices.
fn squares(scope: &Scope<'_>, table: &Table<'_>, framework: &Framework<Rational>) -> Result<Option<Vec<Rational>>> {
    let (node, key) = match (table.get("lengths"), table.get("lengths_squared")) {
        (None, None) => return Ok(None),
        (Some(node), None) => (node, "lengths"),
        (None, Some(node)) => (node, "lengths_squared"),
        (Some(_), Some(node)) => {
            let message = "found both of `lengths` and `lengths_squared`, expected one of them";
            return Err(scope.fail(node.line, message));
        }
    };
    let items = scope.list(node, key)?;
    if items.len() != framework.given_bars {
        let message =
            format!("found {} values in `{key}`, expected {}, one per bar", items.len(), framework.given_bars);
        return Err(scope.fail(node.line, message));
    }
    let mut squares = framework.squares();
    for (square, item) in squares.iter_mut().zip(items) {
        let number = if key == "lengths" {
            scope.rooted(item, key)?
        } else {
            let number = scope.number(item, Quantity::Ratio, key)?;
            let unit = Rational::from(scope.reading.length.square_ref());
            Number::exact(unit * number.rational())
        };
        if *number.rational() <= 0 {
            let message = format!("found {} in `{key}`, expected a positive number", number.to_f64());
            return Err(scope.fail(item.line, message));
        }
        *square = if key == "lengths" { number.squared() } else { number }.rational().clone();
    }
    Ok(Some(squares))
}
