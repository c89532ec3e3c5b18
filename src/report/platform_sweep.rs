//! Sweeps of a leg of a platform as text, CSV, JSON and a picture.

pub use super::assembly_sweep::verdict;
use super::assembly_sweep::{self, Input};
use super::json::{number, words};
use super::picture::{Frame, graphs_svg};
use crate::catalogue::entry::Entry;
use crate::mechanism::FullMode;
use crate::sweep::{AssemblyBranch, PlatformSweep};
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// The numbers of a pose in their order, each with its unit.
const VARIABLES: [(&str, &str); 7] =
    [("qw", ""), ("qx", ""), ("qy", ""), ("qz", ""), ("x", "m"), ("y", "m"), ("z", "m")];

/// Returns the name of the leg that runs.
fn name(sweep: &PlatformSweep) -> String {
    format!("leg{}", sweep.joint + 1)
}

/// Returns the inputs at which a branch is within the limits, as ranges of steps.
fn within(branch: &AssemblyBranch, sweep: &PlatformSweep, input: Input<'_>) -> String {
    let mut ranges: Vec<[usize; 2]> = Vec::new();
    for row in &branch.rows {
        if sweep.samples[row.step].modes[row.mode].within_limits != Some(true) {
            continue;
        }
        match ranges.last_mut() {
            Some(last) if last[1] + 1 == row.step => last[1] = row.step,
            _ => ranges.push([row.step; 2]),
        }
    }
    let range = |ends: &[usize; 2]| ends.map(|step| input.shown(sweep.samples[step].input)).join("..");
    if ranges.is_empty() { "nowhere".to_owned() } else { ranges.iter().map(range).collect::<Vec<_>>().join(", ") }
}

/// Returns the verdict, the branches with the ranges in which they respect the limits, and the limit positions.
#[must_use]
pub fn text(entry: &Entry, sweep: &PlatformSweep) -> String {
    let name = name(sweep);
    let input = Input { title: &entry.title, name: &name, is_length: true };
    let cells: Vec<String> = sweep.branches.iter().map(|branch| within(branch, sweep, input)).collect();
    let more = (!entry.platform_limits.is_empty()).then_some(("within the limits [m]", &cells[..]));
    assembly_sweep::text(input, sweep, more)
}

/// Returns one row for every branch and step: the pose in metres and as a quaternion, and whether it respects the limits.
#[must_use]
pub fn csv(sweep: &PlatformSweep) -> String {
    let names: Vec<&str> = VARIABLES.iter().map(|(name, _)| *name).collect();
    let mut text = format!("branch,circuit,step,input,status,{},within_limits\n", names.join(","));
    for (index, branch) in sweep.branches.iter().enumerate() {
        for row in &branch.rows {
            let sample = &sweep.samples[row.step];
            let mode = &sample.modes[row.mode];
            let (number, circuit, status) = (index + 1, branch.circuit, sample.status.word());
            let _ = write!(text, "{number},{circuit},{},{},{status}", row.step, sample.input);
            for value in &mode.q {
                let _ = write!(text, ",{}", value.re + 0.0);
            }
            let within = mode.within_limits.map_or(String::new(), |within| within.to_string());
            let _ = writeln!(text, ",{within}");
        }
    }
    text
}

/// Returns the keys of a pose.
fn place(mode: &FullMode) -> Map<String, Value> {
    let mut object = Map::new();
    let values = |part: &[num_complex::Complex<f64>]| part.iter().map(|z| number(z.re)).collect::<Value>();
    object.insert("q".into(), values(&mode.q));
    if let Some((quaternion, position)) = mode.q.split_at_checked(4) {
        object.insert("quaternion".into(), values(quaternion));
        object.insert("position".into(), values(position));
    }
    if let (Some(within), Some(platform)) = (mode.within_limits, &mode.platform) {
        object.insert("within_limits".into(), json!(within));
        object.insert("outside".into(), words(&platform.outside));
    }
    object
}

/// Returns the keys of the sweep in the document that equations/sweep.schema.json describes.
#[must_use]
pub fn json(entry: &Entry, sweep: &PlatformSweep) -> Value {
    let mut document = json!({
        "title": entry.title,
        "kind": "platform",
        "variable": name(sweep),
        "variables": VARIABLES.map(|(name, _)| name),
    });
    assembly_sweep::insert(&mut document, sweep, place);
    document
}

/// Returns a picture: every number of the pose against the length of the leg, one panel each.
#[must_use]
pub fn svg(entry: &Entry, sweep: &PlatformSweep) -> String {
    let graph = |(index, (name, unit)): (usize, &(&str, &str))| {
        let label = if unit.is_empty() { (*name).to_owned() } else { format!("{name} [{unit}]") };
        let point = |x: f64, mode: &FullMode| [x, mode.q.get(index).map_or(f64::NAN, |value| value.re)];
        assembly_sweep::graph(sweep, label, false, point)
    };
    let frame = Frame {
        title: &entry.title,
        verdict: &verdict(sweep),
        input: &format!("{} [m]", name(sweep)),
        is_turn: false,
        range: [sweep.range.from, sweep.range.to],
    };
    graphs_svg(&frame, &VARIABLES.iter().enumerate().map(graph).collect::<Vec<_>>())
}
