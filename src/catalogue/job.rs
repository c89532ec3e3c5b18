//! Poses, inputs and claims about them.

use super::entry::{Case, Claim, Design, Entry, Expected, Input, InputValue, Source};
use super::geometry::{Mechanism, mechanism, variable_value};
use super::node::{Node, Value};
use super::options::Chains;
use super::platform;
use super::poses::{self, Typed};
use super::scope::{Scope, Table};
use crate::algebra::number::{Number, Quantity};
use crate::error::Result;
use crate::kinematics::chain::{Chain, JointKind};
use crate::kinematics::freedom::Freedom;

/// Number of correct digits of a claimed solution that gives none.
const DIGITS: u32 = 6;

/// Reads a whole mechanism file.
pub(super) fn entry(scope: &mut Scope<'_>, root: &Node, name: &str) -> Result<Entry> {
    let keys = ["title", "source", "notes", "units", "mechanism", "pose", "input", "legs", "expected", "solution"];
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
    let Mechanism { design, limits, platform_limits, case, labels } =
        mechanism(scope, scope.need(&table, "mechanism")?)?;
    let shared = scope.take_warnings();
    let mut cases = cases(scope, &table, &design, case)?;
    for case in &mut cases {
        case.warnings.splice(0..0, shared.iter().cloned());
    }
    // Claims at the top of a file concern its first case.
    let top = expected(scope, &table, &|scope, node| claim_of(scope, node, &design))?;
    if let (Some(first), true) = (cases.first_mut(), top != Expected::default()) {
        if first.expected != Expected::default() {
            return Err(scope
                .fail(first.line, "found claims about this case here and at the top of the file, expected one place"));
        }
        first.expected = top;
    }
    let (rounded, reading) = (scope.is_rounded(), scope.reading.clone());
    Ok(Entry {
        name: name.to_owned(),
        title,
        source,
        notes,
        design,
        limits,
        platform_limits,
        cases,
        rounded,
        reading,
        labels,
    })
}

/// Reads the poses of an arm, the inputs of a loop, the legs of a platform: one at least, or a loop that needs no input.
fn cases(scope: &Scope<'_>, table: &Table<'_>, design: &Design, own: Option<Case>) -> Result<Vec<Case>> {
    let (what, allowed): (&str, &[&str]) = match design {
        Design::Arm(_) => ("an arm", &["pose"]),
        Design::Loop(_) => ("a loop", &["input"]),
        Design::Platform(_) => ("a platform", &["legs", "pose"]),
    };
    let given: Vec<(&str, &Node)> =
        ["pose", "input", "legs"].into_iter().filter_map(|key| Some((key, table.get(key)?))).collect();
    if let Some((key, node)) = given.iter().find(|(key, _)| !allowed.contains(key)) {
        let expected = allowed.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(" or ");
        return Err(scope.fail(node.line, format!("found `{key}` in the file of {what}, expected {expected}")));
    }
    let (key, node) = match (given.as_slice(), own) {
        ([], Some(case)) => return Ok(vec![case]),
        ([(key, node)], None) => (*key, *node),
        ([], None) if scope.chains != Chains::Solved && !matches!(design, Design::Loop(_)) => return Ok(Vec::new()),
        ([], None) if matches!(design, Design::Platform(_)) => {
            let message = "found no legs, expected `legs` or `legs_squared` in the [mechanism], [[legs]] or [[pose]]";
            return Err(scope.fail(table.line(), message));
        }
        ([], None) if is_short(design) || scope.chains != Chains::Solved && matches!(design, Design::Loop(_)) => {
            return Ok(vec![Case::free(table.line())]);
        }
        ([], None) => match design {
            Design::Loop(chain) => {
                let message = format!(
                    "found no [[input]], expected one: the loop has {}, and one joint variable has to be given (a loop of six \
                     variables or fewer needs none)",
                    Freedom::of(chain)
                );
                return Err(scope.fail(table.line(), message));
            }
            Design::Arm(_) | Design::Platform(_) => (allowed[0], scope.need(table, allowed[0])?),
        },
        ([.., (_, node)], _) => {
            return Err(scope.fail(node.line, "found the legs of a platform in two places, expected one"));
        }
    };
    let blocks = scope.list(node, key)?;
    if blocks.is_empty() {
        return Err(scope.fail(node.line, format!("found an empty list `{key}`, expected at least one")));
    }
    let read = |node: &Node| match (design, key) {
        (Design::Loop(chain), _) => input(scope, node, chain),
        (Design::Platform(_), "legs") => platform::leg_lengths(scope, node),
        _ => pose(scope, node, design),
    };
    blocks.iter().map(read).collect()
}

/// Returns whether a loop has no more variables than equations, so that it needs no input. The idle spin of a link between
/// two S joints is not counted.
fn is_short(design: &Design) -> bool {
    let Design::Loop(chain) = design else { return false };
    let kinds = chain.joint_kinds();
    let spins = usize::from(kinds.iter().filter(|kind| **kind == JointKind::Spherical).count() == 2);
    chain.freedoms() < 7 + spins
}

pub(super) fn units(scope: &mut Scope<'_>, node: &Node) -> Result<()> {
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

pub(super) fn source(scope: &Scope<'_>, node: &Node) -> Result<Source> {
    let table = scope.table(node, "`source`", &["key", "where"])?;
    let key = scope.text(scope.need(&table, "key")?, "key")?.to_owned();
    let place = table.get("where").map(|node| scope.text(node, "where").map(str::to_owned)).transpose()?;
    Ok(Source { key, place })
}

pub(super) fn pose(scope: &Scope<'_>, node: &Node, design: &Design) -> Result<Case> {
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
    let expected = expected(scope, &table, &|scope, node| claim_of(scope, node, design))?;
    let line = table.line();
    let case = match design {
        Design::Platform(platform) => Case::legs_at(platform, pose, line),
        Design::Arm(_) | Design::Loop(_) => Case::at(pose, line),
    };
    let warnings = [scope.take_warnings(), case.warnings].concat();
    let Typed { unit, rounding } = typed(scope, &table);
    Ok(Case { typed: Some(unit), rounding: Some(rounding), expected, warnings, ..case })
}

/// Returns how exactly a pose is typed.
fn typed(scope: &Scope<'_>, table: &Table<'_>) -> Typed {
    let (mut lengths, mut others) = (Vec::new(), Vec::new());
    if let Some(matrix) = table.get("matrix") {
        for row in scope.list(matrix, "matrix").unwrap_or(&[]).iter().take(3) {
            let texts: Vec<&str> = scope.list(row, "matrix").unwrap_or(&[]).iter().filter_map(printed).collect();
            others.extend(texts.iter().take(3).copied());
            lengths.extend(texts.get(3).copied());
        }
    }
    let list = |key: &str| table.get(key).and_then(|node| scope.list(node, key).ok()).unwrap_or(&[]);
    lengths.extend(list("position").iter().filter_map(printed));
    others.extend(list("quaternion").iter().filter_map(printed));
    let is_quaternion = table.get("quaternion").is_some();
    poses::typed(&lengths, &others, poses::Of::Rotation, &scope.reading, is_quaternion)
}

/// Returns the printed form of a number.
fn printed(node: &Node) -> Option<&str> {
    match &node.value {
        Value::Number(text) | Value::Text(text) => Some(text),
        _ => None,
    }
}

fn input(scope: &Scope<'_>, node: &Node, chain: &Chain) -> Result<Case> {
    let table = scope.table(node, "[[input]]", &["joint", "angle", "tan_half", "distance", "expected", "solution"])?;
    let kinds = chain.joint_kinds();
    let joint_node = scope.need(&table, "joint")?;
    let joint = scope.count(joint_node, "joint")?;
    let Some(kind) = joint.checked_sub(1).and_then(|index| kinds.get(index)) else {
        let message =
            format!("found joint {joint}, expected one from 1 to {}: the loop has {}", kinds.len(), Freedom::of(chain));
        return Err(scope.fail(joint_node.line, message));
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
    if !kind.takes(value.variable()) {
        let found = if matches!(value, InputValue::Angle(_)) { "an angle" } else { "a distance" };
        let expected = if !kind.has_one_axis() {
            "expected a joint with one variable, or a C joint"
        } else if kind.only_translates() {
            "expected `distance`"
        } else {
            "expected `angle` or `tan_half`"
        };
        let message = format!(
            "found {found} as input of joint {joint}, which is {kind:?} and has none; {expected}: the loop has {}",
            Freedom::of(chain)
        );
        return Err(scope.fail(table.line(), message));
    }
    let expected = expected(scope, &table, &|scope, node| claim(scope, node, chain))?;
    Ok(Case { expected, warnings: scope.take_warnings(), ..Case::given(Input { joint, value }, table.line()) })
}

/// Reads the claims beside a case or at the top of the file, if they are wanted; `claim` reads their solutions.
pub(super) fn expected(
    scope: &Scope<'_>,
    table: &Table<'_>,
    claim: &dyn Fn(&Scope<'_>, &Node) -> Result<Claim>,
) -> Result<Expected> {
    let mut expected = Expected::default();
    if !scope.claims {
        return Ok(expected);
    }
    if let Some(node) = table.get("expected") {
        let claims = scope.table(node, "[expected]", &["complex", "real", "dimension", "mobility", "screw_rank"])?;
        let count = |key: &str| claims.get(key).map(|node| scope.count(node, key)).transpose();
        expected.complex = count("complex")?;
        expected.real = count("real")?;
        expected.dimension = count("dimension")?;
        expected.mobility = count("mobility")?;
        expected.screw_rank = count("screw_rank")?;
        if let (Some(real), Some(complex)) = (expected.real, expected.complex)
            && real > complex
        {
            let message = format!("found {real} real of {complex} complex solutions, expected at most {complex}");
            return Err(scope.fail(node.line, message));
        }
    }
    if let Some(node) = table.get("solution") {
        for node in scope.list(node, "solution")? {
            expected.solutions.push(claim(scope, node)?);
        }
    }
    Ok(expected)
}

fn claim_of(scope: &Scope<'_>, node: &Node, design: &Design) -> Result<Claim> {
    match design {
        Design::Arm(chain) | Design::Loop(chain) => claim(scope, node, chain),
        Design::Platform(_) => platform::claim(scope, node),
    }
}

/// Reads a `[[solution]]` of an arm or a loop.
fn claim(scope: &Scope<'_>, node: &Node, chain: &Chain) -> Result<Claim> {
    let table = scope.table(node, "[[solution]]", &["q", "digits"])?;
    let list = scope.need(&table, "q")?;
    let nodes = scope.list(list, "q")?;
    let variables = chain.variables();
    if nodes.len() != variables.len() {
        let (found, expected) = (nodes.len(), variables.len());
        return Err(
            scope.fail(list.line, format!("found {found} values in `q`, expected {expected}, one per joint variable"))
        );
    }
    // Claims are compared in f64, so rounding them does not make the mechanism inexact.
    let own = Scope::new(scope.path, scope.reading.clone());
    let values =
        nodes.iter().zip(variables).map(|(node, own_variable)| variable_value(&own, node, own_variable.variable, "q"));
    let q = values.collect::<Result<_>>()?;
    Ok(Claim { q, digits: digits(scope, &table)?, line: table.line() })
}

/// Reads the number of correct digits of a claimed solution.
pub(super) fn digits(scope: &Scope<'_>, table: &Table<'_>) -> Result<u32> {
    match table.get("digits") {
        None => Ok(DIGITS),
        Some(node) => match u32::try_from(scope.count(node, "digits")?) {
            Ok(digits @ 1..=60) => Ok(digits),
            _ => Err(scope.fail(node.line, "found `digits` out of range, expected 1 to 60")),
        },
    }
}
