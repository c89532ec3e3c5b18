//! Sweeps of linkages on the sphere as text, CSV, JSON and a picture.

pub use super::assembly_sweep::verdict;
use super::assembly_sweep::{self, Input};
use super::document::units;
use super::json::number;
use super::model;
use super::number::short;
use super::picture::{Frame, graphs_svg};
use super::sphere::joint_variables;
use crate::catalogue::SphereFile;
use crate::kinematics::sphere::Direction;
use crate::linkage::sphere::SphereMode;
use crate::sweep::{SphereSweep, sphere_place};
use serde_json::{Map, Value, json};

/// A point that is followed: its body, its name and where it is.
pub type Traced = (usize, String, Direction);

fn input<'a>(file: &'a SphereFile, found: &SphereSweep) -> Input<'a> {
    Input { title: &file.heading.title, name: &file.linkage.joints[found.joint].name, is_length: false }
}

/// Joints by name, all values in the order of the file, and the point.
fn place(file: &SphereFile, traced: Option<&Traced>, mode: &SphereMode) -> Map<String, Value> {
    let angles = file.linkage.joints.iter().zip(&mode.joints);
    let joints: Map<String, Value> = angles.map(|(joint, z)| (joint.name.clone(), number(z.re))).collect();
    let mut object = Map::new();
    object.insert("q".into(), mode.joints.iter().map(|z| number(z.re)).collect());
    object.insert("joints".into(), Value::Object(joints));
    if let Some((body, name, point)) = traced {
        let place: Value = sphere_place(mode, *body, point).iter().map(|c| number(*c)).collect();
        object.insert("points".into(), json!({ name: place }));
    }
    object
}

/// The document that equations/sweep.schema.json describes: radians.
#[must_use]
pub fn json(file: &SphereFile, traced: Option<&Traced>, found: &SphereSweep) -> Value {
    let joints = &file.linkage.joints;
    let mut document = json!({
        "name": file.heading.name,
        "version": env!("CARGO_PKG_VERSION"),
        "units": units(),
        "joint_variables": joint_variables(file),
        "mechanism": model::sphere_json(file),
        "title": file.heading.title,
        "kind": "linkage",
        "variable": joints[found.joint].name,
        "variables": joints.iter().map(|joint| joint.name.clone()).collect::<Vec<_>>(),
    });
    assembly_sweep::insert(&mut document, found, |mode| place(file, traced, mode));
    document
}

/// Every joint against the input, one panel each.
#[must_use]
pub fn svg(file: &SphereFile, found: &SphereSweep) -> String {
    let joints = &file.linkage.joints;
    let graph = |joint: usize| {
        let point = |x: f64, mode: &SphereMode| [x, mode.joints[joint].re].map(f64::to_degrees);
        assembly_sweep::graph(found, format!("{} [deg]", joints[joint].name), true, point)
    };
    let frame = Frame {
        title: &file.heading.title,
        verdict: &verdict(found),
        input: &format!("{} [deg]", joints[found.joint].name),
        is_turn: true,
        range: [found.range.from, found.range.to].map(f64::to_degrees),
    };
    let others = (0..joints.len()).filter(|joint| *joint != found.joint);
    graphs_svg(&frame, &others.map(graph).collect::<Vec<_>>())
}

/// The verdict, the branches and the limit positions.
#[must_use]
pub fn text(file: &SphereFile, found: &SphereSweep) -> String {
    assembly_sweep::text(input(file, found), found, None)
}

/// The branches as comma-separated values, degrees and directions.
#[must_use]
pub fn csv(file: &SphereFile, traced: Option<&Traced>, found: &SphereSweep) -> String {
    let mut header = vec!["branch".to_owned()];
    header.extend(file.linkage.joints.iter().map(|joint| format!("{} [deg]", joint.name)));
    if let Some((_, name, _)) = traced {
        header.extend(["x", "y", "z"].map(|axis| format!("{name} {axis}")));
    }
    let mut text = header.join(",") + "\n";
    for (number, branch) in (1..).zip(&found.branches) {
        for row in &branch.rows {
            let mode = &found.samples[row.step].modes[row.mode];
            let mut fields = vec![format!("{number}")];
            fields.extend(mode.joints.iter().map(|z| short(z.re.to_degrees(), 6)));
            if let Some((body, _, point)) = traced {
                fields.extend(sphere_place(mode, *body, point).map(|c| short(c, 9)));
            }
            text += &(fields.join(",") + "\n");
        }
    }
    text
}
