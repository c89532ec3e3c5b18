//! Poses, inputs and the claims made of them.

use super::entry::{Case, Claim, Entry, Expected, Input, InputValue, Kind, Source};
use super::geometry::{Mechanism, kinds, mechanism, variable_value, variables};
use super::node::Node;
use super::scope::{Scope, Table};
use crate::algebra::number::{Number, Quantity};
use crate::error::Result;
use crate::kinematics::chain::{Chain, JointKind};

/// Correct digits of a claimed solution that names none.
const DIGITS: u32 = 6;

/// Reads a whole mechanism file.
pub(super) fn entry(scope: &mut Scope<'_>, root: &Node, name: &str) -> Result<Entry> {
    let keys = ["title", "source", "notes", "units", "mechanism", "pose", "input", "expected", "solution"];
    let table = scope.table(root, "the file", &keys)?;
    if let Some(node) = table.get("units") {
        units(scope, node)?;
    }
    let title = match table.get("title") {
        Some(node) => scope.text(node, "title")?.to_owned(),
        None => name.to_owned(),
    };
    let source = table.get("source").map(|node| source(scope, node)).transpose()?;
    let notes = table.get("notes").map(|node| scope.text(node, "notes").map(str::to_owned)).transpose()?;
    let Mechanism { kind, chain, limits } = mechanism(scope, scope.need(&table, "mechanism")?)?;
    let shared = scope.take_warnings();
    let (own, foreign) = if kind == Kind::Arm { ("pose", "input") } else { ("input", "pose") };
    if let Some(node) = table.get(foreign) {
        let kind = if kind == Kind::Arm { "an arm" } else { "a loop" };
        return Err(scope.fail(node.line, format!("found `{foreign}` in the file of {kind}, expected `{own}`")));
    }
    let blocks = scope.list(scope.need(&table, own)?, own)?;
    let mut cases = Vec::with_capacity(blocks.len());
    for node in blocks {
        let mut case = if kind == Kind::Arm { pose(scope, node, &chain)? } else { input(scope, node, &chain)? };
        case.warnings.splice(0..0, shared.iter().cloned());
        cases.push(case);
    }
    let Some(first) = cases.first_mut() else {
        return Err(scope.fail(root.line, format!("found an empty list `{own}`, expected at least one")));
    };
    // Claims at the top of a file are about its first case.
    let top = expected(scope, &table, &chain)?;
    if top != Expected::default() {
        if first.expected != Expected::default() {
            return Err(scope
                .fail(first.line, "found claims about this case here and at the top of the file, expected one place"));
        }
        first.expected = top;
    }
    Ok(Entry { name: name.to_owned(), title, source, notes, kind, chain, limits, cases, rounded: scope.is_rounded() })
}

fn units(scope: &mut Scope<'_>, node: &Node) -> Result<()> {
    let table = scope.table(node, "`units`", &["length", "angle"])?;
    if let Some(length) = table.get("length") {
        let unit = scope.word(length, "length", &["m", "cm", "mm"])?;
        let metre = Number::parse(&format!("1 {unit}"), Quantity::Length, &scope.reading)?;
        scope.reading.length.clone_from(metre.rational());
    }
    if let Some(angle) = table.get("angle") {
        scope.reading.degrees = scope.word(angle, "angle", &["rad", "deg"])? == "deg";
    }
    Ok(())
}

fn source(scope: &Scope<'_>, node: &Node) -> Result<Source> {
    let table = scope.table(node, "`source`", &["key", "where"])?;
    let key = scope.text(scope.need(&table, "key")?, "key")?.to_owned();
    let place = table.get("where").map(|node| scope.text(node, "where").map(str::to_owned)).transpose()?;
    Ok(Source { key, place })
}

fn pose(scope: &Scope<'_>, node: &Node, chain: &Chain) -> Result<Case> {
    let table = scope.table(node, "[[pose]]", &["matrix", "position", "quaternion", "expected", "solution"])?;
    let pose = match (table.get("matrix"), table.get("position"), table.get("quaternion")) {
        (Some(matrix), None, None) => scope.matrix(matrix, "matrix")?,
        (None, Some(position), Some(quaternion)) => scope.quaternion_position(quaternion, position)?,
        _ => {
            let message =
                "found a [[pose]] without exactly one of `matrix` and `position` with `quaternion`, expected one";
            return Err(scope.fail(table.line(), message));
        }
    };
    let expected = expected(scope, &table, chain)?;
    Ok(Case { pose: Some(pose), input: Vec::new(), expected, warnings: scope.take_warnings(), line: table.line() })
}

fn input(scope: &Scope<'_>, node: &Node, chain: &Chain) -> Result<Case> {
    let table = scope.table(node, "[[input]]", &["joint", "angle", "tan_half", "distance", "expected", "solution"])?;
    let kinds = kinds(chain);
    let joint_node = scope.need(&table, "joint")?;
    let joint = scope.count(joint_node, "joint")?;
    let Some(kind) = joint.checked_sub(1).and_then(|index| kinds.get(index)) else {
        return Err(scope.fail(joint_node.line, format!("found joint {joint}, expected one from 1 to {}", kinds.len())));
    };
    let value = match (table.get("angle"), table.get("tan_half"), table.get("distance")) {
        (Some(node), None, None) => InputValue::Angle(scope.angle(node, "angle")?),
        (None, Some(node), None) => InputValue::Angle(scope.half_tangent(node, "tan_half")?),
        (None, None, Some(node)) => InputValue::Distance(scope.length(node, "distance")?),
        _ => {
            let message = "found an [[input]] without exactly one of `angle`, `tan_half` and `distance`, expected one";
            return Err(scope.fail(table.line(), message));
        }
    };
    let fits = match value {
        InputValue::Angle(_) => matches!(kind, JointKind::Revolute | JointKind::Cylindrical | JointKind::Helical),
        InputValue::Distance(_) => matches!(kind, JointKind::Prismatic | JointKind::Cylindrical),
    };
    if !fits {
        let found = if matches!(value, InputValue::Angle(_)) { "an angle" } else { "a distance" };
        let expected = match kind {
            JointKind::Prismatic => "expected `distance`",
            JointKind::Spherical | JointKind::Universal => "expected a joint with one variable, or a C joint",
            _ => "expected `angle` or `tan_half`",
        };
        let message = format!("found {found} as input of joint {joint}, which is {kind:?} and has none; {expected}");
        return Err(scope.fail(table.line(), message));
    }
    let expected = expected(scope, &table, chain)?;
    let input = vec![Input { joint, value }];
    Ok(Case { pose: None, input, expected, warnings: scope.take_warnings(), line: table.line() })
}

/// The claims beside a case or at the top of the file.
fn expected(scope: &Scope<'_>, table: &Table<'_>, chain: &Chain) -> Result<Expected> {
    let mut expected = Expected::default();
    if let Some(node) = table.get("expected") {
        let claims = scope.table(node, "[expected]", &["complex", "real", "dimension"])?;
        let count = |key: &str| claims.get(key).map(|node| scope.count(node, key)).transpose();
        expected.complex = count("complex")?;
        expected.real = count("real")?;
        expected.dimension = count("dimension")?;
        if let (Some(real), Some(complex)) = (expected.real, expected.complex)
            && real > complex
        {
            let message = format!("found {real} real of {complex} complex solutions, expected at most {complex}");
            return Err(scope.fail(node.line, message));
        }
    }
    if let Some(node) = table.get("solution") {
        for node in scope.list(node, "solution")? {
            expected.solutions.push(claim(scope, node, chain)?);
        }
    }
    Ok(expected)
}

fn claim(scope: &Scope<'_>, node: &Node, chain: &Chain) -> Result<Claim> {
    let table = scope.table(node, "[[solution]]", &["q", "digits"])?;
    let list = scope.need(&table, "q")?;
    let nodes = scope.list(list, "q")?;
    let variables: Vec<_> = kinds(chain).iter().flat_map(|kind| variables(*kind)).copied().collect();
    if nodes.len() != variables.len() {
        let (found, expected) = (nodes.len(), variables.len());
        return Err(
            scope.fail(list.line, format!("found {found} values in `q`, expected {expected}, one per joint variable"))
        );
    }
    // Claims are compared in f64: they do not make the mechanism a rounded one.
    let own = Scope::new(scope.path, scope.reading.clone());
    let values = nodes.iter().zip(variables).map(|(node, variable)| variable_value(&own, node, variable, "q"));
    let q = values.collect::<Result<_>>()?;
    let digits = match table.get("digits") {
        None => DIGITS,
        Some(node) => match u32::try_from(scope.count(node, "digits")?) {
            Ok(digits @ 1..=60) => digits,
            _ => return Err(scope.fail(node.line, "found `digits` out of range, expected 1 to 60")),
        },
    };
    Ok(Claim { q, digits, line: table.line() })
}
