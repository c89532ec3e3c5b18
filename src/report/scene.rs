//! Scenes as JSON, and the poses of the bodies beside every configuration of a document.

use super::json::number;
use crate::scene::{Part, Point, Scene, Stage, Trace};
use serde_json::{Value, json};

/// The scene of a mechanism.
#[must_use]
pub fn json(scene: &Scene) -> Value {
    let bodies = scene.bodies.iter().map(|body| {
        let parts: Vec<Value> = body.parts.iter().map(part).collect();
        json!({ "name": body.name, "parts": parts })
    });
    let connections = scene.connections.iter().map(|connection| {
        let end = |(body, at): &(usize, Point)| json!([body, numbers(at)]);
        json!({ "kind": connection.kind.word(), "from": end(&connection.from), "to": end(&connection.to) })
    });
    let mut object = json!({
        "bodies": bodies.collect::<Vec<_>>(),
        "connections": connections.collect::<Vec<_>>(),
        "centre": numbers(&scene.centre),
        "size": number(scene.size),
    });
    if scene.is_flat {
        object["flat"] = json!(true);
    }
    if !scene.traces.is_empty() {
        let trace = |trace: &Trace| json!({ "name": trace.name, "body": trace.body, "at": numbers(&trace.at) });
        object["traces"] = scene.traces.iter().map(trace).collect();
    }
    object
}

fn numbers(list: &[f64]) -> Value {
    list.iter().map(|x| number(*x)).collect()
}

fn part(part: &Part) -> Value {
    let points = |points: &[Point]| points.iter().map(|p| numbers(p)).collect::<Value>();
    match part {
        Part::Joint { joint, kind, at, axis, label } => {
            let mut object = json!({
                "kind": "joint", "joint": joint, "type": kind.letter(), "at": numbers(at), "axis": numbers(axis),
            });
            if let Some(label) = label {
                object["label"] = json!(label);
            }
            object
        }
        Part::Support { at } => json!({ "kind": "support", "at": numbers(at) }),
        Part::Link { points: corners } => json!({ "kind": "link", "points": points(corners) }),
        Part::Frame { pose } => json!({ "kind": "frame", "pose": numbers(pose) }),
        Part::Hull { points: corners, triangles } => {
            json!({ "kind": "hull", "points": points(corners), "triangles": triangles })
        }
    }
}

/// Adds the poses of the bodies to the real modes and to the samples of the families of one result.
pub fn pose_result(result: &mut Value, stage: &Stage) {
    each(&mut result["modes"], |mode| pose(mode, stage));
    if let Some(nearest) = result.get_mut("nearest") {
        pose(nearest, stage);
    }
    each(&mut result["families"], |family| {
        pose(&mut family["sample"], stage);
        each(&mut family["samples"], |sample| pose(sample, stage));
    });
}

/// Adds the poses of the bodies to the rows of the branches and to the limit positions of a sweep.
pub fn pose_sweep(document: &mut Value, stage: &Stage) {
    each(&mut document["branches"], |branch| each(&mut branch["rows"], |row| pose(row, stage)));
    each(&mut document["limits"], |limit| pose(limit, stage));
}

fn each(list: &mut Value, change: impl FnMut(&mut Value)) {
    list.as_array_mut().into_iter().flatten().for_each(change);
}

/// The numbers of a configuration: `q`, or of a plate its quaternion and its position; `None` where one is complex.
#[must_use]
pub fn configuration(object: &Value) -> Option<Vec<f64>> {
    let list = |key: &str| object[key].as_array()?.iter().map(Value::as_f64).collect::<Option<Vec<f64>>>();
    list("q").or_else(|| Some([list("quaternion")?, list("position")?].concat()))
}

/// The quaternions and positions of all bodies of a configuration, one after the other; `None` where one is complex.
fn places(object: &Value) -> Option<Vec<f64>> {
    let bodies: Option<Vec<Vec<f64>>> = object["bodies"].as_object()?.values().map(configuration).collect();
    Some(bodies?.concat())
}

fn pose(object: &mut Value, stage: &Stage) {
    let q = if stage.takes_places() { places(object) } else { configuration(object) };
    let poses = q.and_then(|q| stage.poses(&q));
    if let (Some(poses), Some(object)) = (poses, object.as_object_mut()) {
        object.insert("poses".into(), poses.iter().map(|pose| numbers(pose)).collect());
    }
}
