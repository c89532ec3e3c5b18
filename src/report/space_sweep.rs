//! Sweeps of linkages in space as text, CSV, JSON and a picture.

pub use super::assembly_sweep::verdict;
use super::assembly_sweep::{self, Input};
use super::json::number;
use super::number::short;
use super::picture::{Frame, graphs_svg};
use super::space::{moved, places, shared};
use crate::algebra::number::nearest_f64;
use crate::catalogue::SpaceFile;
use crate::kinematics::motion::Vector;
use crate::linkage::space::SpaceMode;
use crate::sweep::{SpaceSweep, space_place};
use rug::Rational;
use serde_json::{Map, Value, json};

/// A point that is followed: its body, its name and where it is.
pub type Traced = (usize, String, Vector<Rational>);

fn input<'a>(file: &'a SpaceFile, found: &SpaceSweep) -> Input<'a> {
    let joint = &file.linkage.joints[found.joint];
    Input { title: &file.heading.title, name: &joint.name, is_length: joint.is_distance() == Some(true) }
}

fn point_of(traced: &Traced, mode: &SpaceMode) -> [f64; 3] {
    space_place(mode, traced.0, &traced.2.each_ref().map(nearest_f64))
}

fn place(file: &SpaceFile, traced: Option<&Traced>, mode: &SpaceMode) -> Map<String, Value> {
    let mut object = places(file, mode);
    if let Some(traced) = traced {
        let place: Value = point_of(traced, mode).iter().map(|c| number(*c)).collect();
        object.insert("points".into(), json!({ traced.1.clone(): place }));
    }
    object
}

/// The document that equations/sweep.schema.json describes: radians and metres.
#[must_use]
pub fn json(file: &SpaceFile, traced: Option<&Traced>, found: &SpaceSweep) -> Value {
    let joints = &file.linkage.joints;
    let mut document = shared(file);
    document["variable"] = json!(joints[found.joint].name);
    let valued = joints.iter().filter(|joint| joint.is_distance().is_some());
    document["variables"] = valued.map(|joint| joint.name.clone()).collect();
    assembly_sweep::insert(&mut document, found, |mode| place(file, traced, mode));
    document
}

/// A number of an assembly that is drawn and listed: its name with its unit, and whether it is an angle.
struct Shown<'a> {
    label: String,
    is_turn: bool,
    value: Box<dyn Fn(&SpaceMode) -> f64 + 'a>,
}

/// The values of the joints in degrees and metres, the places of the bodies that no joint with a value moves, and those of the point.
fn shown<'a>(file: &'a SpaceFile, traced: Option<&'a Traced>) -> Vec<Shown<'a>> {
    let linkage = &file.linkage;
    let joints = linkage.joints.iter().enumerate().filter_map(|(k, joint)| {
        let is_turn = !joint.is_distance()?;
        let (unit, scale) = if is_turn { ("deg", 1.0_f64.to_degrees()) } else { ("m", 1.0) };
        // Every joint with a value has one in every assembly.
        let value = move |mode: &SpaceMode| mode.joints[k].map_or(f64::NAN, |z| z.re * scale);
        Some(Shown { label: format!("{} [{unit}]", joint.name), is_turn, value: Box::new(value) })
    });
    let mut list: Vec<Shown<'a>> = joints.collect();
    for body in moved(linkage) {
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let value = move |mode: &SpaceMode| mode.position(body)[k].re;
            let label = format!("{} {axis} [m]", linkage.bodies[body].name);
            list.push(Shown { label, is_turn: false, value: Box::new(value) });
        }
    }
    if let Some(traced) = traced {
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let value = move |mode: &SpaceMode| point_of(traced, mode)[k];
            list.push(Shown { label: format!("{} {axis} [m]", traced.1), is_turn: false, value: Box::new(value) });
        }
    }
    list
}

/// Joints, places of bodies and the point against the input, one panel each.
#[must_use]
pub fn svg(file: &SpaceFile, traced: Option<&Traced>, found: &SpaceSweep) -> String {
    let input = input(file, found);
    let own = format!("{} [{}]", input.name, input.unit());
    let graph = |shown: Shown<'_>| {
        let point = |x: f64, mode: &SpaceMode| [input.value(x), (shown.value)(mode)];
        assembly_sweep::graph(found, shown.label.clone(), shown.is_turn, point)
    };
    let frame = Frame {
        title: &file.heading.title,
        verdict: &verdict(found),
        input: &own,
        is_turn: !input.is_length,
        range: [found.range.from, found.range.to].map(|x| input.value(x)),
    };
    let others = shown(file, traced).into_iter().filter(|shown| shown.label != own);
    graphs_svg(&frame, &others.map(graph).collect::<Vec<_>>())
}

/// The verdict, the branches and the limit positions.
#[must_use]
pub fn text(file: &SpaceFile, found: &SpaceSweep) -> String {
    assembly_sweep::text(input(file, found), found, None)
}

/// The branches as comma-separated values, degrees and metres.
#[must_use]
pub fn csv(file: &SpaceFile, traced: Option<&Traced>, found: &SpaceSweep) -> String {
    let list = shown(file, traced);
    let header = std::iter::once("branch".to_owned()).chain(list.iter().map(|shown| shown.label.clone()));
    let mut text = header.collect::<Vec<_>>().join(",") + "\n";
    for (number, branch) in (1..).zip(&found.branches) {
        for row in &branch.rows {
            let mode = &found.samples[row.step].modes[row.mode];
            let digits = |is_turn: bool| if is_turn { 6 } else { 9 };
            let fields = list.iter().map(|shown| short((shown.value)(mode), digits(shown.is_turn)));
            let fields: Vec<String> = std::iter::once(number.to_string()).chain(fields).collect();
            text += &(fields.join(",") + "\n");
        }
    }
    text
}
