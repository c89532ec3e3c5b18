//! Scenes: what is drawn hangs together at every configuration.
#![allow(clippy::unwrap_used)]

use looproot::internal::scene::{Pose, apply};
use serde_json::Value;
use std::process::Command;

fn run(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_looproot")).args(arguments).output().unwrap();
    assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{arguments:?}");
    String::from_utf8(output.stdout).unwrap()
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    let list: Vec<f64> = value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    list.try_into().unwrap()
}

fn poses(configuration: &Value) -> Vec<Pose> {
    configuration["poses"].as_array().unwrap().iter().map(numbers).collect()
}

fn parts<'a>(body: &'a Value, kind: &'a str) -> impl Iterator<Item = &'a Value> {
    body["parts"].as_array().unwrap().iter().filter(move |part| part["kind"] == kind)
}

fn near(one: [f64; 3], two: [f64; 3], what: &str) {
    assert!((0..3).all(|k| (one[k] - two[k]).abs() < 1e-6), "{what}: {one:?} {two:?}");
}

/// At these poses every joint stands where a link, or a rod of the body behind it, begins.
fn hangs_together(scene: &Value, poses: &[Pose], name: &str) {
    let bodies = scene["bodies"].as_array().unwrap();
    assert_eq!(bodies.len(), poses.len(), "{name}");
    let mut corners: Vec<[f64; 3]> = Vec::new();
    for (body, pose) in bodies.iter().zip(poses) {
        for link in parts(body, "link") {
            let points = link["points"].as_array().unwrap();
            corners.extend(points.iter().map(|p| apply(pose, &numbers(p))));
        }
        corners.extend(parts(body, "frame").map(|frame| {
            let [.., x, y, z] = numbers::<7>(&frame["pose"]);
            apply(pose, &[x, y, z])
        }));
    }
    for connection in scene["connections"].as_array().unwrap() {
        for end in ["from", "to"] {
            let body = usize::try_from(connection[end][0].as_u64().unwrap()).unwrap();
            corners.push(apply(&poses[body], &numbers(&connection[end][1])));
        }
    }
    for (index, (body, pose)) in bodies.iter().zip(poses).enumerate() {
        for joint in parts(body, "joint") {
            let at = apply(pose, &numbers(&joint["at"]));
            let close = corners.iter().filter(|c| (0..3).all(|k| (c[k] - at[k]).abs() < 1e-6)).count();
            // Links of length 0 are not drawn.
            assert!(close >= 1, "{name}: nothing at joint {} in body {index}", joint["joint"]);
        }
    }
}

#[test]
fn links_meet_at_joints_in_every_solution() {
    let names =
        ["puma560", "general_16real", "ur5", "crcrr_2_angle", "rsrc", "rrsrr", "rssr", "general_7r", "bennett_a"];
    for name in names {
        let document = json(&run(&["solve", name, "--json", "--scene"]));
        let scene = &document["scene"];
        let mut count = 0;
        for result in document["results"].as_array().unwrap() {
            for mode in result["modes"].as_array().unwrap() {
                hangs_together(scene, &poses(mode), name);
                count += 1;
            }
        }
        assert!(count > 0, "{name}");
    }
}

#[test]
fn the_tool_of_an_arm_stands_where_it_was_asked_for() {
    let lines = run(&["solve", "general_16real", "--jsonl", "--scene"]);
    let mut lines = lines.lines();
    let document = json(lines.next().unwrap());
    let scene = &document["document"]["scene"];
    let tool = parts(&scene["bodies"][6], "frame").next().unwrap();
    let [.., x, y, z] = numbers::<7>(&tool["pose"]);
    for result in lines.map(json) {
        let wanted = [0, 1, 2].map(|k| result["asked"]["matrix"][k][3].as_f64().unwrap());
        for mode in result["modes"].as_array().unwrap() {
            near(apply(&poses(mode)[6], &[x, y, z]), wanted, "tool");
        }
    }
}

#[test]
fn the_legs_of_a_platform_are_as_long_as_asked() {
    let document = json(&run(&["solve", "dietmaier_40real", "--json", "--scene"]));
    let result = &document["results"][0];
    let legs: [f64; 6] = numbers(&result["legs"]);
    let modes = result["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 40);
    for mode in modes {
        let poses = poses(mode);
        for (leg, connection) in legs.iter().zip(document["scene"]["connections"].as_array().unwrap()) {
            let ends = ["from", "to"].map(|end| {
                let body = usize::try_from(connection[end][0].as_u64().unwrap()).unwrap();
                apply(&poses[body], &numbers(&connection[end][1]))
            });
            let square: f64 = (0..3).map(|k| (ends[0][k] - ends[1][k]).powi(2)).sum();
            assert!((square.sqrt() - leg).abs() < 1e-6 * leg.max(1.0));
        }
    }
}

#[test]
fn a_sweep_poses_every_row_and_limit_position() {
    let arguments = ["sweep", "cccr_1_angle", "--from", "-pi", "--to", "pi", "--steps", "24", "--json", "--scene"];
    let document = json(&run(&arguments));
    let branches = document["branches"].as_array().unwrap();
    assert!(!branches.is_empty());
    let rows = branches.iter().flat_map(|branch| branch["rows"].as_array().unwrap());
    for row in rows.chain(document["limits"].as_array().unwrap()) {
        hangs_together(&document["scene"], &poses(row), "cccr_1_angle");
    }
}

#[test]
fn the_bodies_of_linkages_meet_at_their_joints() {
    for name in ["jansen", "slider_crank_piston", "3prr", "whitworth", "spherical_3rrr"] {
        let document = json(&run(&["solve", &format!("linkage/{name}"), "--json", "--scene"]));
        let bodies: Vec<&str> =
            document["scene"]["bodies"].as_array().unwrap().iter().map(|body| body["name"].as_str().unwrap()).collect();
        assert_eq!(bodies[0], document["mechanism"]["ground"], "{name}: the ground stands first");
        let modes = document["results"][0]["modes"].as_array().unwrap();
        assert!(!modes.is_empty(), "{name}");
        for mode in modes {
            let poses = poses(mode);
            let of = |body: &Value| poses[bodies.iter().position(|own| body == own).unwrap()];
            for joint in document["mechanism"]["joints"].as_array().unwrap() {
                let end = |side: usize| {
                    let at: Vec<f64> =
                        joint["at"][side].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
                    apply(&of(&joint["of"][side]), &[at[0], at[1], at.get(2).copied().unwrap_or(0.0)])
                };
                if joint["type"] == "R" {
                    near(end(0), end(1), name);
                }
            }
            for (body, own) in bodies.iter().zip(&poses) {
                let listed = &mode["bodies"][body];
                if let Some(angle) = listed["angle"].as_f64() {
                    assert!((own[0] - (angle / 2.0).cos().abs()).abs() < 1e-9, "{name}: {body}");
                    near(
                        [own[4], own[5], own[6]],
                        [numbers::<2>(&listed["position"]), [0.0; 2]].concat()[..3].try_into().unwrap(),
                        name,
                    );
                } else {
                    let q: [f64; 4] = numbers(&listed["quaternion"]);
                    let along: f64 = (0..4).map(|k| q[k] * own[k]).sum();
                    assert!((along.abs() - 1.0).abs() < 1e-9, "{name}: {body}");
                }
            }
        }
    }
}

#[test]
fn scenes_are_json_only() {
    let output = Command::new(env!("CARGO_BIN_EXE_looproot")).args(["solve", "puma560", "--scene"]).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("expected it with --json or --jsonl"));
}
