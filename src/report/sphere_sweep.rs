//! Sweeps of linkages on the sphere as text and as JSON.

use super::document::units;
use super::json::number;
use super::model;
use super::number::{counted, short};
use super::picture::{Frame, Graph, graphs_svg};
use super::sphere::joint_variables;
use super::table::{Columns, paragraph};
use crate::catalogue::SphereFile;
use crate::kinematics::sphere::Direction;
use crate::sweep::{SphereNode, SphereSweep, sphere_place};
use crate::verdict::Status;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// A point that is followed: its body, its name and where it is.
pub type Traced = (usize, String, Direction);

/// The verdict on one line.
#[must_use]
pub fn verdict(found: &SphereSweep) -> String {
    let limits = match &found.limits {
        Some(list) if list.is_empty() => "; no limit position in the whole turn".to_owned(),
        Some(list) => {
            let angles: Vec<String> = list.iter().map(|x| short(x.to_degrees(), 6)).collect();
            let positions = counted(list.len(), "limit position");
            format!("; {positions} in the whole turn, at {} deg", angles.join(", "))
        }
        None => String::new(),
    };
    let branches = counted(found.branches.len(), "branch").replace("branchs", "branches");
    format!("{branches}{limits}")
}

/// Why nothing is proved of a sweep.
const REASON: &str = "every input is solved by itself; between the inputs nothing is proved";

/// The document that equations/sweep.schema.json describes: radians.
#[must_use]
pub fn json(file: &SphereFile, traced: Option<&Traced>, found: &SphereSweep) -> Value {
    let joints = &file.linkage.joints;
    let last = found.inputs.len().saturating_sub(1);
    let input = |step: usize| number(found.inputs.get(step).map_or(f64::NAN, |(input, _)| *input));
    let end = |step: usize, edge: usize| {
        if step == edge {
            return json!({ "kind": "range" });
        }
        let other = if edge == 0 { step - 1 } else { step + 1 };
        json!({ "kind": "unresolved", "between": [input(step.min(other)), input(step.max(other))] })
    };
    let row = |node: &SphereNode| {
        let angles = joints.iter().zip(&node.mode.joints).map(|(joint, z)| (joint.name.clone(), number(z.re)));
        let q: Value = node.mode.joints.iter().map(|z| number(z.re)).collect();
        let mut row = json!({ "step": node.step, "turn": 0, "q": q, "joints": angles.collect::<Map<_, _>>() });
        if let Some((body, name, point)) = traced {
            let place: Value = sphere_place(&node.mode, *body, point).iter().map(|c| number(*c)).collect();
            row["points"] = json!({ name: place });
        }
        row
    };
    let branches = (1..).zip(&found.branches).filter_map(|(circuit, branch)| {
        let (first, second) = (branch.first()?.step, branch.last()?.step);
        let rows: Value = branch.iter().map(row).collect();
        Some(json!({
            "circuit": circuit,
            "from": input(first), "begins": end(first, 0), "to": input(second), "ends": end(second, last), "rows": rows,
        }))
    });
    let inputs = found.inputs.iter().enumerate().map(|(step, (input, verdict))| {
        json!({
            "step": step, "input": number(*input), "status": verdict.status.word(), "real": verdict.real, "reason": verdict.reason,
        })
    });
    let count = |status: Status| found.inputs.iter().filter(|(_, verdict)| verdict.status == status).count();
    let ends = found.branches.iter().map(|branch| {
        let ends = [branch.first().map(|node| node.step) == Some(0), branch.last().map(|node| node.step) == Some(last)];
        ends.iter().filter(|is_range| !**is_range).count()
    });
    let limits = found.limits.as_ref().map(|list| list.iter().map(|x| number(*x)).collect::<Value>());
    json!({
        "name": file.heading.name,
        "version": env!("CARGO_PKG_VERSION"),
        "units": units(),
        "joint_variables": joint_variables(file),
        "mechanism": model::sphere_json(file),
        "title": file.heading.title,
        "kind": "linkage",
        "joint": found.joint + 1,
        "variable": joints[found.joint].name,
        "from": input(0),
        "to": input(last),
        "steps": last,
        "full_turn": false,
        "verdict": {
            "status": "incomplete",
            "proof": "none",
            "code": "no-exact-route",
            "reason": REASON,
            "branches": found.branches.len(),
            "limits": 0,
            "limit_inputs": limits,
            "complex_limits": found.complex_limits,
            "inputs": found.inputs.len(),
            "incomplete": count(Status::Incomplete),
            "self_motion": count(Status::SelfMotion),
            "unresolved": ends.sum::<usize>(),
        },
        "variables": joints.iter().map(|joint| joint.name.clone()).collect::<Vec<_>>(),
        "branches": branches.collect::<Vec<_>>(),
        "limits": [],
        "standing": [],
        "inputs": inputs.collect::<Vec<_>>(),
    })
}

/// Every joint against the input, one panel each.
#[must_use]
pub fn svg(file: &SphereFile, found: &SphereSweep) -> String {
    let joints = &file.linkage.joints;
    let graph = |joint: usize| {
        let point = |node: &SphereNode| {
            let input = found.inputs.get(node.step).map_or(f64::NAN, |(input, _)| *input);
            [input, node.mode.joints[joint].re].map(f64::to_degrees)
        };
        let line = |(circuit, branch): (usize, &Vec<SphereNode>)| (circuit, vec![branch.iter().map(point).collect()]);
        let label = format!("{} [deg]", joints[joint].name);
        Graph { label, is_turn: true, lines: (1..).zip(&found.branches).map(line).collect(), dots: Vec::new() }
    };
    let range = [found.inputs.first(), found.inputs.last()];
    let frame = Frame {
        title: &file.heading.title,
        verdict: &verdict(found),
        input: &format!("{} [deg]", joints[found.joint].name),
        is_turn: true,
        range: range.map(|end| end.map_or(0.0, |(input, _)| input.to_degrees())),
    };
    let others = (0..joints.len()).filter(|joint| *joint != found.joint);
    graphs_svg(&frame, &others.map(graph).collect::<Vec<_>>())
}

/// The branches as rows of numbers, degrees and directions.
fn columns(file: &SphereFile, traced: Option<&Traced>) -> Vec<String> {
    let mut header = vec!["branch".to_owned()];
    header.extend(file.linkage.joints.iter().map(|joint| format!("{} [deg]", joint.name)));
    if let Some((_, name, _)) = traced {
        header.extend(["x", "y", "z"].map(|axis| format!("{name} {axis}")));
    }
    header
}

fn rows(traced: Option<&Traced>, found: &SphereSweep) -> Vec<Vec<String>> {
    let mut list = Vec::new();
    for (number, branch) in (1..).zip(&found.branches) {
        for node in branch {
            let mut row = vec![number.to_string()];
            row.extend(node.mode.joints.iter().map(|z| short(z.re.to_degrees(), 6)));
            if let Some((body, _, point)) = traced {
                row.extend(sphere_place(&node.mode, *body, point).map(|c| short(c, 9)));
            }
            list.push(row);
        }
    }
    list
}

/// The branches as a table.
#[must_use]
pub fn text(file: &SphereFile, traced: Option<&Traced>, found: &SphereSweep) -> String {
    let mut text = format!("{}\n", file.heading.title);
    paragraph(&mut text, &verdict(found));
    let mut table = Columns::new(&columns(file, traced), &[]);
    for row in rows(traced, found) {
        table.row(row);
    }
    let _ = write!(text, "\n{}", table.text());
    text
}

/// The branches as comma-separated values.
#[must_use]
pub fn csv(file: &SphereFile, traced: Option<&Traced>, found: &SphereSweep) -> String {
    let mut text = columns(file, traced).join(",") + "\n";
    for row in rows(traced, found) {
        text += &(row.join(",") + "\n");
    }
    text
}
