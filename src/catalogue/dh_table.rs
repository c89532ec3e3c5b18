//! DH tables as CSV: a header `type,a,alpha,d,theta0`, then one joint per line, classic convention.

use super::entry::{Design, Entry, Labels};
use super::geometry::{check_count, joint_kind};
use super::node::{Node, Value};
use super::scope::Scope;
use crate::algebra::number::{Angle, Number};
use crate::error::Result;
use crate::kinematics::chain::{Chain, Geometry, Joint, JointKind, Placement};
use crate::kinematics::platform_limits::PlatformLimits;
use std::f64::consts::TAU;

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
    check_count(scope, &chain, at + 1, (6, "expected 1 to 24 for an arm"))?;
    Ok(Entry {
        name: name.to_owned(),
        title: name.to_owned(),
        source: None,
        notes: None,
        design: Design::Arm(chain),
        limits: Vec::new(),
        platform_limits: PlatformLimits::default(),
        cases: Vec::new(),
        rounded: scope.is_rounded(),
        reading: scope.reading.clone(),
        labels: Labels { snapped: scope.take_snapped(), ..Labels::default() },
    })
}

/// Reads a twist; a value above a full turn is taken to be in degrees.
fn twist(scope: &Scope<'_>, node: &Node) -> Result<Angle> {
    let angle = scope.printed_angle(node, "alpha", &format!("line {}", node.line))?;
    let radians = angle.radians();
    let has_unit = matches!(&node.value, Value::Text(text) if text.contains("deg") || text.contains("rad"));
    if radians.abs() <= TAU || has_unit {
        return Ok(angle);
    }
    let expected =
        format!("expected at most a full turn: angles of a table are radians, write `{radians} deg` for degrees");
    Err(scope.fail(node.line, format!("found the twist {radians}, {expected}")))
}

fn joint(scope: &Scope<'_>, line: &str, at: usize) -> Result<Joint> {
    let cells: Vec<Node> = line
        .split(',')
        .map(|cell| Node { line: at, value: Value::Text(cell.trim().trim_matches('"').to_owned()) })
        .collect();
    let Ok([kind, a, alpha, d, theta0]) = <[Node; 5]>::try_from(cells) else {
        return Err(scope.fail(at, format!("found {} values, expected 5", line.split(',').count())));
    };
    let plain: Vec<JointKind> = JointKind::ALL.into_iter().filter(|kind| kind.is_plain()).collect();
    let kind = joint_kind(scope, &kind, &plain)?;
    let length = |node: &Node, what: &str| -> Result<Number> { scope.length(node, what) };
    Ok(Joint {
        kind,
        a: length(&a, "a")?,
        alpha: twist(scope, &alpha)?,
        d: length(&d, "d")?,
        theta0: scope.printed_angle(&theta0, "theta0", &format!("line {at}"))?,
        pitch: None,
    })
}
