//! DH tables as CSV: a header `type,a,alpha,d,theta0`, then one joint per line, classic convention.

use super::entry::{Design, Entry, Labels};
use super::geometry::{check_count, joint_kind};
use super::node::{Node, Value};
use super::scope::Scope;
use crate::algebra::number::Number;
use crate::error::Result;
use crate::kinematics::chain::{Chain, Geometry, Joint, JointKind, Placement};

const HEADER: [&str; 5] = ["type", "a", "alpha", "d", "theta0"];

/// Reads an arm from a DH table; it has no pose.
pub(super) fn entry(scope: &Scope<'_>, text: &str, name: &str) -> Result<Entry> {
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let header = lines.next();
    let expected = "expected the header `type,a,alpha,d,theta0`";
    let Some((at, header)) = header else { return Err(scope.fail(1, format!("found an empty table, {expected}"))) };
    let names: Vec<&str> = header.trim_start_matches('\u{feff}').split(',').map(str::trim).collect();
    if names != HEADER {
        let found: String = header.chars().take(60).collect();
        return Err(scope.fail(at + 1, format!("found the header `{found}`, {expected}")));
    }
    let mut joints = Vec::new();
    for (at, line) in lines {
        joints.push(joint(scope, line, at + 1)?);
    }
    let geometry = Geometry::Dh(joints);
    let chain = Chain { geometry, base: Placement::identity(), tool: Placement::identity() };
    check_count(scope, &chain, at + 1, (6, "expected 6 for an arm"))?;
    Ok(Entry {
        name: name.to_owned(),
        title: name.to_owned(),
        source: None,
        notes: None,
        design: Design::Arm(chain),
        limits: Vec::new(),
        cases: Vec::new(),
        rounded: scope.is_rounded(),
        reading: scope.reading.clone(),
        labels: Labels::default(),
    })
}

fn joint(scope: &Scope<'_>, line: &str, at: usize) -> Result<Joint> {
    let cells: Vec<Node> = line
        .split(',')
        .map(|cell| Node { line: at, value: Value::Text(cell.trim().trim_matches('"').to_owned()) })
        .collect();
    let Ok([kind, a, alpha, d, theta0]) = <[Node; 5]>::try_from(cells) else {
        return Err(scope.fail(at, format!("found {} values, expected 5", line.split(',').count())));
    };
    let kind = joint_kind(scope, &kind, &[JointKind::Revolute, JointKind::Prismatic, JointKind::Cylindrical])?;
    let length = |node: &Node, what: &str| -> Result<Number> { scope.length(node, what) };
    Ok(Joint {
        kind,
        a: length(&a, "a")?,
        alpha: scope.angle(&alpha, "alpha")?,
        d: length(&d, "d")?,
        theta0: scope.angle(&theta0, "theta0")?,
        pitch: None,
    })
}
