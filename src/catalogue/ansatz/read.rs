//! The reader of ansatz files.

use super::expression::{check_name, is_number, polynomial, twist};
use super::resolve::relation;
use super::{Ansatz, SymbolicJoint, Symbols, Twist};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Ring, exact_cos_sin};
use crate::catalogue::entry::Design;
use crate::catalogue::geometry::mechanism;
use crate::catalogue::job::{source, units};
use crate::catalogue::node::{Node, Value};
use crate::catalogue::options::Chains;
use crate::catalogue::scope::Scope;
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use rug::Rational;

/// Number of joints of a loop.
const JOINTS: std::ops::RangeInclusive<usize> = 3..=7;

/// Reads a loop with symbols, or one with numbers only.
pub(in crate::internal::catalogue) fn ansatz(scope: &mut Scope<'_>, root: &Node, name: &str) -> Result<Ansatz> {
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
    if table.get("symbols").is_none() {
        ansatz.chain = chain(scope, scope.need(&table, "mechanism")?);
    }
    Ok(ansatz)
}

/// Returns the loop of a table without symbols.
fn chain(scope: &Scope<'_>, node: &Node) -> Option<Chain> {
    let mut own = Scope::new(scope.path, scope.reading.clone());
    own.chains = Chains::Any;
    match mechanism(&own, node).ok()?.design {
        Design::Loop(chain) => Some(chain),
        Design::Arm(_) | Design::Platform(_) => None,
    }
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
    let convention = scope.word(convention, "convention", &["dh", "modified-dh", "screws"])?;
    let list = scope.need(&table, "joints")?;
    let nodes = scope.list(list, "joints")?;
    if !JOINTS.contains(&nodes.len()) {
        let (least, most) = (JOINTS.start(), JOINTS.end());
        return Err(scope.fail(list.line, format!("found {} joints, expected {least} to {most}", nodes.len())));
    }
    match convention {
        "screws" => super::screws::joints(scope, &table, nodes, symbols.angles.len()),
        "modified-dh" => {
            // Rx Tx of each joint stands before its Rz Tz: round the loop, behind those of the joint before it.
            let mut joints: Vec<SymbolicJoint> =
                nodes.iter().map(|node| joint(scope, node, symbols)).collect::<Result<_>>()?;
            let links: Vec<_> = joints.iter().map(|joint| (joint.a.clone(), joint.alpha.clone())).collect();
            for (k, joint) in joints.iter_mut().enumerate() {
                (joint.a, joint.alpha) = links[(k + 1) % links.len()].clone();
            }
            Ok(joints)
        }
        _ => nodes.iter().map(|node| joint(scope, node, symbols)).collect(),
    }
}

/// Refuses joints that are not revolute.
pub(super) fn check_kind(scope: &Scope<'_>, joint: &Node) -> Result<()> {
    // The other keys depend on the type.
    let Value::Table(fields) = &joint.value else { return Ok(()) };
    let Some(kind) = fields.iter().find(|field| field.key == "type").map(|field| &field.node) else { return Ok(()) };
    let letter = scope.word(kind, "type", &["R", "P", "C", "H", "U", "S"])?;
    if letter == "R" {
        return Ok(());
    }
    let instead = match letter {
        "U" => "; a U joint can be written as two R joints with a link of length 0 and twist pi/2 between them",
        "S" => "; an S joint can be written as three R joints with links of length 0 and twist pi/2 between them",
        _ => "",
    };
    let message = format!(
        "found a joint of type `{letter}`: conditions are derived for loops of 4 to 6 revolute joints (type `R`) only{instead}; \
         whether one loop with numbers moves, `looproot mobility` decides for all types of joints"
    );
    Err(Error::Unsupported(message).at(scope.path, kind.line))
}

fn joint(scope: &Scope<'_>, node: &Node, symbols: &Symbols) -> Result<SymbolicJoint> {
    let keys = ["type", "a", "alpha", "tan_half_alpha", "d", "theta0", "tan_half_theta0", "name"];
    check_kind(scope, node)?;
    let table = scope.table(node, "a joint", &keys)?;
    scope.need(&table, "type")?;
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

/// Reads a length: a number with its unit, or a polynomial in symbols, whose numbers are metres.
fn length(scope: &Scope<'_>, node: &Node, what: &str, symbols: &Symbols) -> Result<Polynomial<Rational>> {
    match &node.value {
        Value::Text(text) if !is_number(text) => {
            polynomial(text, symbols).map_err(|fault| fault.at(scope.path, node.line))
        }
        _ => Ok(Polynomial::constant(scope.length(node, what)?.rational().clone())),
    }
}

/// Reads the `[ansatz]` table.
fn relations(scope: &Scope<'_>, node: &Node, ansatz: &mut Ansatz) -> Result<()> {
    let table = scope.table(node, "[ansatz]", &["relations", "unknown", "fit"])?;
    if let Some(list) = table.get("unknown") {
        for item in scope.list(list, "unknown")? {
            let name = scope.text(item, "unknown")?;
            let find = |names: &[String]| names.iter().position(|known| known == name);
            let symbols = &ansatz.symbols;
            let (chosen, index) = match (find(&symbols.lengths), find(&symbols.angles)) {
                (Some(length), _) => (&mut ansatz.unknown, length),
                (None, Some(angle)) => (&mut ansatz.unknown_angles, angle),
                (None, None) => {
                    let known: Vec<&str> = symbols.lengths.iter().chain(&symbols.angles).map(String::as_str).collect();
                    let message =
                        format!("found the unknown `{name}`, expected one of the symbols: {}", known.join(", "));
                    return Err(scope.fail(item.line, message));
                }
            };
            if chosen.contains(&index) {
                return Err(scope.fail(item.line, format!("found the unknown `{name}` twice, expected it once")));
            }
            chosen.push(index);
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

/// Reads the terms that a condition may have: a list, or lists of which all products are taken.
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
