//! The reader of ansatz files.

use super::expression::{check_name, is_number, polynomial, twist};
use super::resolve::relation;
use super::{Ansatz, SymbolicJoint, Symbols, Twist};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Ring, exact_cos_sin};
use crate::catalogue::job::{source, units};
use crate::catalogue::node::{Node, Value};
use crate::catalogue::scope::Scope;
use crate::error::{Error, Result};
use rug::Rational;

/// Loops have at least so many joints and at most as many.
const JOINTS: std::ops::RangeInclusive<usize> = 3..=7;

/// Reads a loop with symbols, or one with numbers only.
pub(in crate::catalogue) fn ansatz(scope: &mut Scope<'_>, root: &Node, name: &str) -> Result<Ansatz> {
    let keys = [
        "title",
        "source",
        "notes",
        "units",
        "symbols",
        "mechanism",
        "ansatz",
        "input",
        "expected",
        "solution",
        "mobility",
    ];
    let table = scope.table(root, "the file", &keys)?;
    if let Some(node) = table.get("units") {
        units(scope, node)?;
    }
    let text = |key: &str| table.get(key).map(|node| scope.text(node, key).map(str::to_owned)).transpose();
    let title = text("title")?.unwrap_or_else(|| name.to_owned());
    let notes = text("notes")?;
    let source = table.get("source").map(|node| source(scope, node)).transpose()?;
    let symbols = match table.get("symbols") {
        Some(node) => symbols(scope, node)?,
        None => Symbols::new(Vec::new(), Vec::new())?,
    };
    let joints = joints(scope, scope.need(&table, "mechanism")?, &symbols)?;
    let mut ansatz = Ansatz { name: name.to_owned(), title, source, notes, joints, ..Ansatz::general(0) };
    ansatz.symbols = symbols;
    if let Some(node) = table.get("ansatz") {
        relations(scope, node, &mut ansatz)?;
    }
    ansatz.resolve().map_err(|(line, fault)| fault.at(scope.path, line))?;
    ansatz.rounded = scope.is_rounded();
    Ok(ansatz)
}

fn names(scope: &Scope<'_>, node: &Node, what: &str) -> Result<Vec<String>> {
    let read = |item: &Node| {
        let name = scope.text(item, what)?;
        check_name(name).map_err(|fault| fault.at(scope.path, item.line))?;
        Ok(name.to_owned())
    };
    scope.list(node, what)?.iter().map(read).collect()
}

fn symbols(scope: &Scope<'_>, node: &Node) -> Result<Symbols> {
    let table = scope.table(node, "[symbols]", &["angles", "lengths"])?;
    let list = |key: &str| table.get(key).map_or(Ok(Vec::new()), |node| names(scope, node, key));
    Symbols::new(list("angles")?, list("lengths")?).map_err(|fault| fault.at(scope.path, node.line))
}

fn joints(scope: &Scope<'_>, node: &Node, symbols: &Symbols) -> Result<Vec<SymbolicJoint>> {
    let table = scope.table(node, "the [mechanism] of conditions", &["kind", "convention", "joints", "limits"])?;
    scope.word(scope.need(&table, "kind")?, "kind", &["loop"])?;
    let convention = scope.need(&table, "convention")?;
    if scope.word(convention, "convention", &["dh", "modified-dh", "screws"])? != "dh" {
        return Err(Error::Unsupported("conditions of loops in another convention than \"dh\"".to_owned())
            .at(scope.path, convention.line));
    }
    let list = scope.need(&table, "joints")?;
    let nodes = scope.list(list, "joints")?;
    if !JOINTS.contains(&nodes.len()) {
        let (least, most) = (JOINTS.start(), JOINTS.end());
        return Err(scope.fail(list.line, format!("found {} joints, expected {least} to {most}", nodes.len())));
    }
    nodes.iter().map(|node| joint(scope, node, symbols)).collect()
}

fn joint(scope: &Scope<'_>, node: &Node, symbols: &Symbols) -> Result<SymbolicJoint> {
    let keys = ["type", "a", "alpha", "tan_half_alpha", "d", "theta0", "tan_half_theta0", "name"];
    let table = scope.table(node, "a joint", &keys)?;
    let kind = scope.need(&table, "type")?;
    if scope.word(kind, "type", &["R", "P", "C", "H", "U", "S"])? != "R" {
        return Err(
            Error::Unsupported("conditions of loops with joints other than R".to_owned()).at(scope.path, kind.line)
        );
    }
    let length = |key: &str| match table.get(key) {
        Some(node) => length(scope, node, key, symbols),
        None => Err(scope.fail(table.line(), format!("found no `{key}` in a joint, expected one"))),
    };
    let alpha = match (table.get("alpha"), table.get("tan_half_alpha")) {
        (Some(node), None) => match &node.value {
            Value::Text(text) => {
                let (alpha, exact) =
                    twist(text, symbols, &scope.reading).map_err(|fault| fault.at(scope.path, node.line))?;
                scope.note(exact);
                alpha
            }
            _ => constant(&exact_cos_sin(&scope.angle(node, "alpha")?), symbols),
        },
        (None, Some(node)) => constant(&exact_cos_sin(&scope.half_tangent(node, "tan_half_alpha")?), symbols),
        _ => {
            let message = "found a joint without exactly one of `alpha` and `tan_half_alpha`, expected one";
            return Err(scope.fail(table.line(), message));
        }
    };
    Ok(SymbolicJoint { a: length("a")?, alpha, d: length("d")? })
}

fn constant((cos, sin): &(Rational, Rational), symbols: &Symbols) -> Twist {
    Twist { multiples: vec![0; symbols.angles.len()], constant: (cos.clone(), sin.clone()) }
}

/// A length: a number with its unit, or a polynomial in symbols, whose numbers are metres.
fn length(scope: &Scope<'_>, node: &Node, what: &str, symbols: &Symbols) -> Result<Polynomial<Rational>> {
    match &node.value {
        Value::Text(text) if !is_number(text) => {
            polynomial(text, symbols).map_err(|fault| fault.at(scope.path, node.line))
        }
        _ => Ok(Polynomial::constant(scope.length(node, what)?.rational().clone())),
    }
}

/// The `[ansatz]` table.
fn relations(scope: &Scope<'_>, node: &Node, ansatz: &mut Ansatz) -> Result<()> {
    let table = scope.table(node, "[ansatz]", &["relations", "unknown", "fit"])?;
    if let Some(list) = table.get("unknown") {
        for item in scope.list(list, "unknown")? {
            let name = scope.text(item, "unknown")?;
            let known = ansatz.symbols.lengths.iter().position(|length| length == name);
            let fault = || {
                let lengths = ansatz.symbols.lengths.join(", ");
                scope.fail(item.line, format!("found the unknown `{name}`, expected one of the lengths: {lengths}"))
            };
            let index = known.ok_or_else(fault)?;
            if ansatz.unknown.contains(&index) {
                return Err(scope.fail(item.line, format!("found the unknown `{name}` twice, expected it once")));
            }
            ansatz.unknown.push(index);
        }
    }
    if let Some(list) = table.get("relations") {
        for item in scope.list(list, "relations")? {
            let text = scope.text(item, "relations")?;
            let read = relation(text, item.line, &ansatz.symbols, scope);
            ansatz.relations.push(read.map_err(|fault| fault.at(scope.path, item.line))?);
        }
    }
    if let Some(list) = table.get("fit") {
        ansatz.fit = fit(scope, list, &ansatz.symbols)?;
    }
    Ok(())
}

/// The terms that a condition may have: a list, or lists of which all products are meant.
fn fit(scope: &Scope<'_>, node: &Node, symbols: &Symbols) -> Result<Vec<Polynomial<Rational>>> {
    let items = scope.list(node, "fit")?;
    let term = |item: &Node| -> Result<Polynomial<Rational>> {
        let found = match &item.value {
            Value::Number(text) | Value::Text(text) => polynomial(text, symbols),
            _ => Err(Error::Invalid(format!("found {} in `fit`, expected a term", item.describe()))),
        };
        let found = found.map_err(|fault| fault.at(scope.path, item.line))?;
        if found.len() == 1 && found.coefficients()[0] == 1 {
            return Ok(found);
        }
        Err(scope.fail(item.line, "found a sum or a factor in `fit`, expected a product of symbols, cosines and sines"))
    };
    if !items.iter().any(|item| matches!(item.value, Value::List(_))) {
        return items.iter().map(term).collect();
    }
    let mut products = vec![Polynomial::one()];
    for list in items {
        let factors: Vec<_> = scope.list(list, "fit")?.iter().map(term).collect::<Result<_>>()?;
        products = products.iter().flat_map(|product| factors.iter().map(|factor| product.mul(factor))).collect();
    }
    Ok(products)
}
