//! Arms of four to seven joints as robot descriptions: poses of every form, tasks and joints that are held, against forward
//! kinematics written here from the definition of the format.
#![allow(clippy::unwrap_used)]

use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

/// One joint of a robot: its type, `xyz`, `rpy` and axis.
type Joint = (&'static str, [f64; 3], [f64; 3], [f64; 3]);

type Matrix = [[f64; 4]; 4];

const H: f64 = PI / 2.0;

/// An arm of a waist and three parallel joints.
const FOUR: [Joint; 4] = [
    ("revolute", [0.0, 0.0, 0.1], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ("revolute", [0.02, 0.0, 0.05], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
    ("revolute", [0.05, 0.0, 0.2], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
    ("revolute", [0.2, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
];

/// A SCARA arm.
const SCARA: [Joint; 4] = [
    ("revolute", [0.0, 0.0, 0.3], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ("revolute", [0.25, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ("prismatic", [0.2, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, -1.0]),
    ("revolute", [0.0, 0.0, 0.0], [PI, 0.0, 0.0], [0.0, 0.0, 1.0]),
];

/// The first arm with a wrist that rolls.
const FIVE: [Joint; 5] =
    [FOUR[0], FOUR[1], FOUR[2], FOUR[3], ("revolute", [0.1, 0.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0])];

/// An arm whose axes lie anyhow.
const CROOKED: [Joint; 5] = [
    ("revolute", [0.0, 0.0, 0.1], [0.1, 0.2, 0.3], [0.0, 0.0, 1.0]),
    ("revolute", [0.1, 0.03, 0.2], [1.2, 0.3, -0.4], [0.0, 0.0, 1.0]),
    ("revolute", [0.3, -0.02, 0.1], [0.2, -0.1, 0.7], [0.0, 0.0, 1.0]),
    ("revolute", [0.25, 0.1, 0.0], [-1.1, 0.4, 0.2], [0.0, 0.0, 1.0]),
    ("revolute", [0.1, 0.0, 0.15], [0.9, -0.3, 0.5], [0.0, 0.0, 1.0]),
];

/// Shoulder, elbow and wrist of seven joints.
const SEVEN: [Joint; 7] = [
    ("revolute", [0.0, 0.0, 0.34], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ("revolute", [0.0, 0.0, 0.0], [-H, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ("revolute", [0.0, -0.4, 0.0], [H, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ("revolute", [0.0, 0.0, 0.0], [H, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ("revolute", [0.0, 0.4, 0.0], [-H, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ("revolute", [0.0, 0.0, 0.0], [-H, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ("revolute", [0.0, 0.0, 0.0], [H, 0.0, 0.0], [0.0, 0.0, 1.0]),
];

/// The tool stands off the last joint.
const TOOL: [f64; 3] = [0.07, 0.0, 0.11];

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

fn moved([x, y, z]: [f64; 3]) -> Matrix {
    [[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z], [0.0, 0.0, 0.0, 1.0]]
}

/// The rotation about a unit vector, by the formula of Rodrigues.
fn turned([x, y, z]: [f64; 3], angle: f64) -> Matrix {
    let (s, c) = angle.sin_cos();
    let v = 1.0 - c;
    [
        [c + x * x * v, x * y * v - z * s, x * z * v + y * s, 0.0],
        [y * x * v + z * s, c + y * y * v, y * z * v - x * s, 0.0],
        [z * x * v - y * s, z * y * v + x * s, c + z * z * v, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

fn forward(robot: &[Joint], q: &[f64]) -> Matrix {
    let mut pose = moved([0.0; 3]);
    for ((kind, xyz, [roll, pitch, yaw], axis), value) in robot.iter().zip(q) {
        pose = product(&pose, &moved(*xyz));
        for (axis, angle) in [([0.0, 0.0, 1.0], yaw), ([0.0, 1.0, 0.0], pitch), ([1.0, 0.0, 0.0], roll)] {
            pose = product(&pose, &turned(axis, *angle));
        }
        let own = if *kind == "prismatic" { moved(axis.map(|x| x * value)) } else { turned(*axis, *value) };
        pose = product(&pose, &own);
    }
    product(&pose, &moved(TOOL))
}

fn urdf(robot: &[Joint]) -> String {
    let words = |v: [f64; 3]| v.map(|x| x.to_string()).join(" ");
    let mut text = "<robot name=\"test\"><link name=\"l0\"/>".to_owned();
    for (k, (kind, xyz, rpy, axis)) in robot.iter().enumerate() {
        let (next, [xyz, rpy, axis]) = (k + 1, [xyz, rpy, axis].map(|v| words(*v)));
        text += &format!(
            "<link name=\"l{next}\"/><joint name=\"joint_{next}\" type=\"{kind}\"><parent link=\"l{k}\"/><child link=\"l{next}\"/>\n\
             <origin xyz=\"{xyz}\" rpy=\"{rpy}\"/><axis xyz=\"{axis}\"/><limit lower=\"-3.1\" upper=\"3.1\"/></joint>\n"
        );
    }
    let last = robot.len();
    text + &format!(
        "<link name=\"tool0\"/><joint name=\"tool\" type=\"fixed\"><parent link=\"l{last}\"/><child link=\"tool0\"/>\
         <origin xyz=\"{}\"/></joint></robot>",
        words(TOOL)
    )
}

/// A file of its own for each test.
fn file(name: &str, content: &str) -> String {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(&path, content).unwrap();
    path.to_str().unwrap().to_owned()
}

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_looproot")).args(arguments).output().unwrap()
}

fn lines(output: &Output) -> Vec<Value> {
    let text = String::from_utf8_lossy(&output.stdout);
    text.lines().map(|line| serde_json::from_str(line).unwrap_or_else(|_| panic!("{line}"))).collect()
}

/// Joint values spread over (-3, 3), other ones for every number.
fn configuration(joints: usize, number: usize) -> Vec<f64> {
    let root = |k: usize| [2.0_f64, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0][k].sqrt();
    (0..joints).map(|k| 6.0 * (root(k) * (number + 3) as f64).fract() - 3.0).collect()
}

/// A table of the poses at these configurations.
fn table(robot: &[Joint], configurations: &[Vec<f64>]) -> String {
    let names: Vec<String> = (0..12).map(|k| format!("m{}{}", k / 4, k % 4)).collect();
    let mut text = names.join(",") + "\n";
    for q in configurations {
        let pose = forward(robot, q);
        let row: Vec<String> = pose[..3].iter().flatten().map(f64::to_string).collect();
        text += &(row.join(",") + "\n");
    }
    text
}

fn values(q: &Value) -> Vec<f64> {
    q.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

fn apart(one: &[f64], other: &[f64]) -> f64 {
    let off = |(a, b): (&f64, &f64)| ((a - b) - TAU * ((a - b) / TAU).round()).abs();
    one.iter().zip(other).map(off).fold(0.0, f64::max)
}

fn defect(one: &Matrix, other: &Matrix) -> f64 {
    one.iter().flatten().zip(other.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Solves the poses of some configurations; each must be found, every mode must reach its pose.
fn all_found(name: &str, robot: &[Joint], configurations: &[Vec<f64>], more: &[&str]) {
    let path = file(&format!("{name}.urdf"), &urdf(robot));
    let poses = file(&format!("{name}.csv"), &table(robot, configurations));
    let output = run(&[&["solve", &path, "--poses", &poses, "--jsonl"], more].concat());
    let results = lines(&output);
    assert_eq!(results.len(), configurations.len(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    for (result, q) in results.iter().zip(configurations) {
        let modes = result["modes"].as_array().unwrap();
        let all: Vec<Vec<f64>> = modes.iter().map(|mode| values(&mode["q"])).collect();
        let nearest = all.iter().map(|own| apart(own, q)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-7, "{name}: {q:?} is missing: {result}");
        for own in &all {
            assert!(defect(&forward(robot, own), &forward(robot, q)) < 1e-9, "{name}: {own:?} is elsewhere");
        }
        assert_eq!(result["verdict"]["status"], "complete", "{name}: {result}");
    }
}

fn some(joints: usize, count: usize) -> Vec<Vec<f64>> {
    (0..count).map(|number| configuration(joints, number)).collect()
}

#[test]
fn poses_of_four_joints_are_found() {
    all_found("four", &FOUR, &some(4, 6), &[]);
    all_found("scara", &SCARA, &some(4, 6), &[]);
}

#[test]
fn poses_of_five_joints_are_found() {
    all_found("five", &FIVE, &some(5, 6), &[]);
    all_found("crooked", &CROOKED, &some(5, 6), &[]);
}

#[test]
fn the_pose_of_an_arm_of_few_joints_is_an_exact_datum() {
    // Printed as decimals no rotation is one to the last digit: the nearest one is the datum, and it is exact.
    let right = [
        ("revolute", [0.0, 0.0, 0.1], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
        ("revolute", [0.02, 0.0, 0.05], [H, 0.0, 0.0], [0.0, 0.0, 1.0]),
        ("revolute", [0.2, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
        ("revolute", [0.2, 0.0, 0.0], [0.0, 0.0, PI / 6.0], [0.0, 0.0, 1.0]),
    ];
    for (name, robot) in [("exact4.urdf", &FOUR[..]), ("exact5.urdf", &FIVE), ("right.urdf", &right)] {
        let path = file(name, &urdf(robot));
        for q in some(robot.len(), 2) {
            let poses = file(&format!("{name}.csv"), &table(robot, &[q]));
            let output = run(&["solve", &path, "--poses", &poses, "--jsonl"]);
            let verdict = &lines(&output)[0]["verdict"];
            assert_eq!(
                (&verdict["status"], &verdict["proof"]),
                (&"complete".into(), &"proved".into()),
                "{name}: {verdict}"
            );
            assert_eq!(output.status.code(), Some(0), "{name}");
        }
    }
}

#[test]
fn the_home_position_of_few_joints_is_found() {
    all_found("four_home", &FOUR, &[vec![0.0; 4]], &[]);
    all_found("scara_home", &SCARA, &[vec![0.0, 0.3, 0.0, 0.0]], &[]);
    all_found("five_home", &FIVE, &[vec![0.0; 5]], &[]);
}

#[test]
fn seven_joints_of_which_one_is_held_are_found() {
    let configurations: Vec<Vec<f64>> = some(7, 4).into_iter().map(|q| [&q[..2], &[0.3], &q[3..]].concat()).collect();
    all_found("seven", &SEVEN, &configurations, &["--lock", "joint_3=0.3"]);
}

#[test]
fn a_pose_beyond_an_arm_of_few_joints_is_unreachable() {
    let path = file("beyond.urdf", &urdf(&FOUR));
    let output = run(&["solve", &path, "--at", "0.3,0.1,0.2; 0.5,0.5,0.5,0.5", "--json"]);
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    let result = &document["results"][0];
    assert_eq!(result["verdict"]["status"], "unreachable", "{result}");
    assert_eq!(result["verdict"]["conditions"].as_array().unwrap().len(), 4);
    assert!(result["nearest"]["error"]["orientation"].as_f64().unwrap() > 0.01, "{result}");
    let labels: Vec<&str> =
        document["joint_variables"].as_array().unwrap().iter().map(|own| own["label"].as_str().unwrap()).collect();
    assert_eq!(labels, ["joint_1", "joint_2", "joint_3", "joint_4"]);
    assert_eq!((document["base_link"].as_str(), document["tip_link"].as_str()), (Some("l0"), Some("tool0")));
}

#[test]
fn tasks_leave_the_tool_free() {
    let q = configuration(5, 2);
    let pose = forward(&FIVE, &q);
    let (path, poses) = (file("task.urdf", &urdf(&FIVE)), file("task.csv", &table(&FIVE, &[q])));
    let asked = |task: &str| {
        let results = lines(&run(&["solve", &path, "--poses", &poses, "--jsonl", "--task", task]));
        let families = results[0]["families"].as_array().unwrap().clone();
        let modes = results[0]["modes"].as_array().unwrap().clone();
        let of = |own: &Value| values(if own["sample"].is_null() { &own["q"] } else { &own["sample"]["q"] });
        let all: Vec<Matrix> = families.iter().chain(&modes).map(of).map(|q| forward(&FIVE, &q)).collect();
        assert!(!all.is_empty(), "{task}: {}", results[0]);
        all
    };
    let off = |own: &Matrix, columns: &[usize]| {
        columns.iter().flat_map(|j| (0..3).map(|i| (own[i][*j] - pose[i][*j]).abs())).fold(0.0, f64::max)
    };
    assert!(asked("position+axis").iter().all(|own| off(own, &[2, 3]) < 1e-9));
    assert!(asked("position+tilt").iter().all(|own| off(own, &[3]) < 1e-9 && (own[2][2] - pose[2][2]).abs() < 1e-9));
    assert!(asked("position").iter().all(|own| off(own, &[3]) < 1e-9));
    assert!(asked("orientation").iter().all(|own| off(own, &[0, 1, 2]) < 1e-9));
}

#[test]
fn the_curves_of_a_task_with_a_freedom_more_are_followed() {
    // A spherical virtual joint, and two that turn about the tool's axis and the base's.
    for (name, robot, task) in [("four_curve", &FOUR[..], "position"), ("five_curve", &FIVE, "position+tilt")] {
        let configurations = some(robot.len(), 2);
        let path = file(&format!("{name}.urdf"), &urdf(robot));
        let poses = file(&format!("{name}.csv"), &table(robot, &configurations));
        let results = lines(&run(&["solve", &path, "--poses", &poses, "--jsonl", "--task", task]));
        for (result, q) in results.iter().zip(&configurations) {
            let families = result["families"].as_array().unwrap();
            let samples = families.iter().flat_map(|own| own["samples"].as_array().unwrap());
            let all: Vec<Vec<f64>> = samples.map(|own| values(&own["q"])).collect();
            // Neighbours along a curve are no farther apart than its longest step, 0.1.
            let nearest = all.iter().map(|own| apart(own, q)).fold(f64::INFINITY, f64::min);
            assert!(nearest < 0.1, "{name}: {q:?} is missing: {nearest}");
            let wanted = forward(robot, q);
            for pose in all.iter().map(|own| forward(robot, own)) {
                assert!((0..3).all(|i| (pose[i][3] - wanted[i][3]).abs() < 1e-9), "{name}: a sample is elsewhere");
                assert!(task == "position" || (pose[2][2] - wanted[2][2]).abs() < 1e-9, "{name}: a sample is tilted");
            }
        }
    }
}

#[test]
fn the_tilt_of_an_upright_tool_is_its_axis() {
    // The joints that bend sum to 0: the tool stands upright, turned about the vertical by the angle whose half has the tangent 3/4.
    let q = [2.0 * 0.75_f64.atan(), 0.4, 0.5, -0.9, 0.0];
    let pose = forward(&FIVE, &q);
    let at = format!("{}, {}, {}; 0.8, 0, 0, 0.6", pose[0][3], pose[1][3], pose[2][3]);
    let path = file("upright.urdf", &urdf(&FIVE));
    let asked = |task: &str| {
        let output = run(&["solve", &path, "--at", &at, "--task", task, "--jsonl"]);
        let result = lines(&output)[0].clone();
        let modes: Vec<Vec<f64>> = result["modes"].as_array().unwrap().iter().map(|mode| values(&mode["q"])).collect();
        (modes, result["verdict"]["status"].clone(), result["verdict"]["proof"].clone())
    };
    let tilt = asked("position+tilt");
    assert_eq!((&tilt.1, &tilt.2), (&json!("complete"), &json!("proved")));
    assert!(tilt.0.iter().any(|own| apart(own, &q) < 1e-6), "{:?}", tilt.0);
    assert_eq!(tilt, asked("position+axis"));
    // A SCARA arm has no other tilt.
    let output = run(&["solve", "cobra600", "--at", "0.4, 0.2, 0.1; 0, 1, 0, 0", "--task", "position+tilt", "--jsonl"]);
    let result = lines(&output)[0].clone();
    assert_eq!(result["families"].as_array().unwrap().len(), 4, "{result}");
}

#[test]
fn a_joint_that_the_task_leaves_free_is_a_dimension_of_every_family() {
    // With the wrist in line joint 4 turns against joint 6, which turns freely about the tool's axis.
    let output = run(&["solve", "puma560", "--joints", "0,0,0,0,0,0", "--task", "position+axis", "--jsonl"]);
    let result = lines(&output)[0].clone();
    let is_surface = |own: &Value| own["dimension"] == 2 && own["joints"] == json!([4, 6]);
    assert!(result["families"].as_array().unwrap().iter().any(is_surface), "{result}");
    assert_eq!(result["verdict"]["self_motion"], 2, "{result}");
}

#[test]
fn bad_rows_are_reported_and_the_others_solved() {
    let path = file("rows.urdf", &urdf(&FIVE));
    let good = table(&FIVE, &some(5, 2));
    let mut rows: Vec<&str> = good.lines().collect();
    rows.insert(2, "1,2,3");
    rows.insert(3, "1,0,0,0,0,1,0,x,0,0,1,0");
    let output = run(&["solve", &path, "--poses", &file("rows.csv", &rows.join("\n")), "--jsonl"]);
    let results = lines(&output);
    assert_eq!(output.status.code(), Some(1));
    let faults: Vec<(u64, u64)> = results
        .iter()
        .filter(|result| !result["error"].is_null())
        .map(|result| (result["case"].as_u64().unwrap(), result["line"].as_u64().unwrap()))
        .collect();
    assert_eq!((results.len(), faults), (4, vec![(2, 3), (3, 4)]));
    let header = run(&["solve", &path, "--poses", &file("header.csv", "1,2,3,4,5,6\n"), "--jsonl"]);
    assert!(String::from_utf8_lossy(&header.stderr).contains("found the header `1,2,3,4,5,6`, expected"));
}

#[test]
fn every_form_of_a_pose_is_the_same_pose() {
    let path = file("forms.urdf", &urdf(&FIVE));
    // The tool points along x, turned by 40 degrees about it, and the base by 30 degrees.
    let q = ["30 deg", "10 deg", "20 deg", "-30 deg", "40 deg"].join(",");
    let by_joints = run(&["solve", &path, "--joints", &q, "--jsonl"]);
    let asked = &lines(&by_joints)[0]["asked"]["matrix"];
    let number = |i: usize, j: usize| asked[i][j].as_f64().unwrap();
    let [x, y, z] = [number(0, 3), number(1, 3), number(2, 3)];
    let angles = format!("x_mm,y_mm,z_mm,roll_deg,pitch_deg,yaw_deg\n{},{},{},40,0,30\n", x * 1e3, y * 1e3, z * 1e3);
    let matrix: Vec<String> = (0..4)
        .map(|i| format!("[{}]", (0..4).map(|j| number(i, j).to_string()).collect::<Vec<_>>().join(",")))
        .collect();
    let objects = format!("{{\"matrix\": [{}]}}\n", matrix.join(","));
    let first = |arguments: &[&str]| {
        let output = run(arguments);
        let results = lines(&output);
        assert!(!results.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
        results[0]["modes"].as_array().unwrap().iter().map(|mode| values(&mode["q"])).collect::<Vec<_>>()
    };
    let known = first(&["solve", &path, "--joints", &q, "--jsonl"]);
    assert!(!known.is_empty());
    for (name, text) in [("angles.csv", angles), ("objects.jsonl", objects)] {
        let found = first(&["solve", &path, "--poses", &file(name, &text), "--jsonl"]);
        assert_eq!(found.len(), known.len(), "{name}");
        let is_found = |own: &Vec<f64>| found.iter().any(|other| apart(own, other) < 1e-6);
        assert!(known.iter().all(is_found), "{name}: {found:?} {known:?}");
    }
    let at = format!("{x},{y},{z}; 40 deg,0,30 deg");
    assert_eq!(first(&["solve", &path, "--at", &at, "--jsonl"]).len(), known.len());
    // The nearest one comes first.
    let near = first(&["solve", &path, "--at", &at, "--jsonl", "--near", &q]);
    let wanted = [30.0_f64, 10.0, 20.0, -30.0, 40.0].map(f64::to_radians);
    assert!(apart(&near[0], &wanted) < 1e-6, "{near:?}");
}

#[test]
fn a_robot_without_a_pose_says_what_to_type() {
    let output = run(&["solve", &file("next.urdf", &urdf(&FIVE))]);
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1));
    for words in ["--at", "--joints \"0,0,0,0,0\"", "--poses poses.csv", "the tip is link `tool0`"] {
        assert!(text.contains(words), "{words}: {text}");
    }
}

#[test]
fn joints_are_held_by_name_and_mistakes_are_named() {
    let path = file("lock.urdf", &urdf(&SEVEN));
    let fault = |lock: &str| {
        let output = run(&["solve", &path, "--at", "0.4,0.1,0.5; 1,0,0,0", "--lock", lock]);
        assert_eq!(output.status.code(), Some(1));
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    assert!(fault("elbow=1").contains("found no joint `elbow`") && fault("elbow=1").contains("3 (joint_3)"));
    assert!(fault("joint_3").contains("expected NAME=VALUE"));
    // Without it the redundancy is named, with a configuration.
    let output = run(&["solve", &path, "--at", "0.4,0.1,0.5; 1,0,0,0", "--jsonl"]);
    let result = &lines(&output)[0];
    assert_eq!((output.status.code(), result["verdict"]["self_motion"].as_u64()), (Some(2), Some(1)), "{result}");
    let sample = values(&result["families"][0]["sample"]["q"]);
    let asked = forward(&SEVEN, &sample);
    assert!((asked[0][3] - 0.4).abs() < 1e-9 && (asked[2][3] - 0.5).abs() < 1e-9);
}

#[test]
fn seven_joints_move_along_curves_within_the_limits() {
    let q = [0.3, 0.9, -0.4, -1.2, 0.5, 0.8, 0.2];
    let (path, poses) = (file("curves.urdf", &urdf(&SEVEN)), file("curves.csv", &table(&SEVEN, &[q.to_vec()])));
    let output = run(&["solve", &path, "--poses", &poses, "--jsonl"]);
    let result = &lines(&output)[0];
    let families = result["families"].as_array().unwrap();
    assert!(families.len() > 1, "{}", result["verdict"]);
    let pose = forward(&SEVEN, &q);
    let mut nearest = f64::INFINITY;
    for family in families {
        let samples: Vec<Vec<f64>> =
            family["samples"].as_array().unwrap().iter().map(|own| values(&own["q"])).collect();
        assert!(!samples.is_empty());
        for own in &samples {
            assert!(defect(&forward(&SEVEN, own), &pose) < 1e-9, "{own:?}");
            nearest = nearest.min(apart(own, &q));
        }
        for pair in samples.windows(2) {
            assert!(apart(&pair[0], &pair[1]) < 0.11, "{pair:?}");
        }
    }
    // Points lie a tenth apart at most.
    assert!(nearest < 0.06, "{nearest}");
}

#[test]
fn singular_poses_of_seven_joints_have_their_families() {
    // Stretched upwards, four axes are one line; with the second joint at 0 the first and the third are, with the sixth the fifth and the
    // seventh: two pairs turn independently of each other.
    let cases: [(&str, &str, u64, &[u64]); 3] = [
        ("iiwa7", "0, 0, 0, 0, 0, 0, 0", 3, &[1, 3, 5, 7]),
        ("panda", "20 deg, 0, -40 deg, -100 deg, 25 deg, 95 deg, 30 deg", 1, &[1, 3]),
        ("sia5d", "95 deg, 0, -135 deg, -20 deg, 80 deg, 0, -65 deg", 2, &[1, 3, 5, 7]),
    ];
    for (robot, q, dimension, joints) in cases {
        let output = run(&["solve", robot, "--joints", q, "--jsonl"]);
        let result = &lines(&output)[0];
        let is_it = |family: &&Value| {
            family["dimension"] == json!(dimension)
                && family["joints"] == json!(joints)
                && family["distance"] == json!(0.0)
        };
        assert!(
            result["families"].as_array().unwrap().iter().any(|own| is_it(&own)),
            "{robot}: {}",
            result["families"]
        );
        assert_eq!(result["verdict"]["self_motion"], json!(dimension), "{robot}");
        let circle = |own: &&Value| own["dimension"] == json!(1) && own["joints"].as_array().unwrap().len() == 2;
        let circles = result["families"].as_array().unwrap().iter().filter(circle).count();
        assert!(dimension == 1 || circles == 0, "{robot}: {}", result["families"]);
    }
}

/// Axes in general position, beside a configuration in which the screws of the joints have rank 5 and from which no curve leaves: the poses
/// beside it are reached along curves so short that no joint passes a value at which it is held.
#[test]
fn a_short_self_motion_of_seven_joints_is_found() {
    const ARM: &str = r#"{"title": "small", "units": {"length": "m", "angle": "deg"}, "mechanism": {"kind": "arm", "convention": "dh", "joints": [
        {"type": "R", "a": -0.366, "alpha": 47.5, "d": 0.347}, {"type": "R", "a": -0.005, "alpha": 27.3, "d": -0.051},
        {"type": "R", "a": -0.012, "alpha": -19.8, "d": 0.393}, {"type": "R", "a": 0.196, "alpha": 54.3, "d": -0.234},
        {"type": "R", "a": 0.401, "alpha": -85.4, "d": -0.469}, {"type": "R", "a": 0.439, "alpha": -51, "d": -0.119},
        {"type": "R", "a": -0.471, "alpha": -11.2, "d": -0.278}],
        "limits": [[-120, 100], [-100, 100], [-170, 100], [-170, 100], [-170, 100], [-120, 170], [-120, 170]]},
        "pose": [{"position": [0.3, 0.2, 0.1], "quaternion": [1, 0, 0, 0]}]}"#;
    let path = file("small.json", ARM);
    let cases =
        [[-0.284, 0.177, -1.578, -0.841, 0.046, 0.774, 0.321], [-0.26, 0.157, -1.551, -0.842, 0.022, 0.778, 0.307]];
    for planted in cases {
        let q = planted.map(|value| format!("{value} rad")).join(", ");
        let result = &lines(&run(&["solve", &path, "--joints", &q, "--jsonl"]))[0];
        let families = result["families"].as_array().unwrap();
        let samples = families.iter().flat_map(|family| family["samples"].as_array().unwrap());
        let nearest = samples.map(|own| apart(&values(&own["q"]), &planted)).fold(f64::INFINITY, f64::min);
        // Points of so short a curve are nearer to each other than a hundredth.
        assert!(nearest < 0.01, "{planted:?}: {nearest}, {}", result["verdict"]);
    }
}

/// The second and the sixth joint at 0: the arm is singular, and two complex curves meet in this one real configuration.
#[test]
fn a_configuration_at_which_an_arm_of_seven_joints_is_locked_is_listed() {
    for planted in [[0.0, 0.0, 0.0, 50.9, -30.0, 0.0, 0.0], [15.0, 0.0, 0.0, 45.0, 60.0, 0.0, 0.0]] {
        let q = planted.map(|value| format!("{value} deg")).join(", ");
        let result = &lines(&run(&["solve", "gen3", "--joints", &q, "--jsonl"]))[0];
        let modes = result["modes"].as_array().unwrap();
        let off = |mode: &Value| apart(&values(&mode["q"]), &planted.map(f64::to_radians));
        // A double configuration is known to the root of rounding.
        assert!(
            modes.iter().any(|mode| off(mode) < 1e-6 && mode["multiplicity"] == json!(2)),
            "{planted:?}: {modes:?}"
        );
        assert!(modes.iter().all(|mode| mode["certified"] == json!(false)));
        assert!(!result["families"].as_array().unwrap().is_empty());
    }
}

#[test]
fn a_path_is_followed_branch_by_branch() {
    let rows: Vec<Vec<f64>> = (0..8).map(|k| vec![0.2 + 0.02 * f64::from(k), 0.3, 0.5, -0.4, 0.1]).collect();
    let path = file("path.urdf", &urdf(&FIVE));
    let output = run(&["solve", &path, "--poses", &file("path.csv", &table(&FIVE, &rows)), "--jsonl", "--follow"]);
    let results = lines(&output);
    let branches = results[8]["branches"].as_array().unwrap();
    assert_eq!(branches.len(), results[0]["modes"].as_array().unwrap().len());
    for branch in branches {
        assert_eq!((branch["from"].as_u64(), branch["to"].as_u64()), (Some(1), Some(8)));
        let largest = &branch["largest_move"];
        assert_eq!(largest["joint"], "joint_1");
        assert!((largest["value"].as_f64().unwrap() - 0.02).abs() < 1e-9);
    }
    assert!(results[..8].iter().all(|result| result["events"].as_array().unwrap().is_empty()));
}

/// The pose that a file gives to joint values, as its own solver reads it; `units` are those of the joints.
fn asked(path: &str, q: &[f64], units: &[&str]) -> Matrix {
    let joints: Vec<String> = q.iter().zip(units).map(|(x, unit)| format!("{x} {unit}")).collect();
    let output = run(&["solve", path, "--joints", &joints.join(","), "--jsonl", "--real"]);
    let results = lines(&output);
    let matrix =
        &results.first().unwrap_or_else(|| panic!("{}", String::from_utf8_lossy(&output.stderr)))["asked"]["matrix"];
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[i][j].as_f64().unwrap()))
}

#[test]
fn a_pose_out_of_reach_is_answered_with_the_nearest_configuration() {
    // The links of both arms are shorter than 1.3 m together, which proves it for the second one.
    for (name, code) in [("puma560", "geometry-bound-met"), ("panda", "out-of-reach")] {
        let pose = ["solve", name, "--at", "9, 0, 0; 1, 0, 0, 0"];
        let output = run(&[&pose[..], &["--json"]].concat());
        assert_eq!(output.status.code(), Some(3), "{name}");
        let document: Value = serde_json::from_slice(&output.stdout).unwrap();
        let Value::Object(result) = &document["results"][0] else { panic!("{document}") };
        assert_eq!(
            (&result["verdict"]["proof"], &result["verdict"]["code"]),
            (&json!("proved"), &json!(code)),
            "{name}"
        );
        // The error is that of the configuration, and the arm is stretched.
        let q: Vec<f64> = result["nearest"]["q"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
        let reached = asked(name, &q, &vec!["rad"; q.len()]);
        let apart = (reached[0][3] - 9.0).hypot(reached[1][3]).hypot(reached[2][3]);
        let error = result["nearest"]["error"]["position"].as_f64().unwrap();
        assert!((apart - error).abs() < 1e-9 && error > 7.7 && error < 8.3, "{name}: {error}, {apart}");
        let text = String::from_utf8(run(&pose).stdout).unwrap();
        assert!(text.contains("\nnearest found: q1 "), "{text}");
    }
}

#[test]
fn converted_arms_have_the_same_forward_kinematics() {
    let robots: [(&str, String); 4] = [
        ("puma560", "puma560".to_owned()),
        ("ur5e", "ur5e".to_owned()),
        ("crooked", file("convert.urdf", &urdf(&CROOKED))),
        ("scara", file("convert_scara.urdf", &urdf(&SCARA))),
    ];
    for (name, path) in robots {
        for to in ["toml", "json", "urdf"] {
            let other = file(&format!("{name}_converted.{to}"), "");
            let output = run(&["convert", &path, "--to", to, "-o", &other]);
            assert!(output.status.success(), "{name} {to}: {}", String::from_utf8_lossy(&output.stderr));
            let joints = if name == "scara" { 4 } else { 6 - usize::from(name == "crooked") };
            let units = ["rad", "rad", if name == "scara" { "m" } else { "rad" }, "rad", "rad", "rad"];
            for number in 0..3 {
                let q = configuration(joints, number);
                assert!(defect(&asked(&path, &q, &units), &asked(&other, &q, &units)) < 1e-12, "{name} {to}");
            }
        }
    }
    let table = file("puma_converted.csv", "");
    assert!(run(&["convert", "tsai_morgan_1985_a", "--to", "csv", "-o", &table]).status.success());
    let q = configuration(6, 1);
    assert!(defect(&asked("tsai_morgan_1985_a", &q, &["rad"; 6]), &asked(&table, &q, &["rad"; 6])) < 1e-12);
    let refused = run(&["convert", "jaco_j2n6", "--to", "opw"]);
    assert_eq!(refused.status.code(), Some(4));
}

#[test]
fn seven_lengths_give_the_same_pose() {
    let output = run(&["convert", "kr6_r900", "--to", "opw"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let list = |line: &str| -> Vec<f64> {
        let (_, list) = line.split_once(": ").unwrap();
        list.trim_matches(['[', ']']).split(", ").map(|x| x.parse().unwrap()).collect()
    };
    let lines: Vec<Vec<f64>> = text.lines().filter(|line| line.contains(": ")).map(list).collect();
    let [a1, a2, b, c1, c2, c3, c4] = std::array::from_fn(|k| lines[k][0]);
    let theta = configuration(6, 4);
    let q: [f64; 6] = std::array::from_fn(|k| lines[8][k] * theta[k] - lines[7][k]);
    let (y, z) = ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let steps = [
        moved([0.0, 0.0, c1]),
        turned(z, q[0]),
        moved([a1, b, 0.0]),
        turned(y, q[1]),
        moved([0.0, 0.0, c2]),
        turned(y, q[2]),
        moved([a2, 0.0, c3]),
        turned(z, q[3]),
        turned(y, q[4]),
        turned(z, q[5]),
        moved([0.0, 0.0, c4]),
    ];
    let pose = steps.iter().fold(moved([0.0; 3]), |pose, step| product(&pose, step));
    assert!(defect(&pose, &asked("kr6_r900", &theta, &["rad"; 6])) < 1e-9, "{text}");
}

#[test]
fn an_irrational_twist_leaves_the_bound_of_a_wrist_proved() {
    let code = |arguments: &[&str]| {
        let output = run(&[&["solve"], arguments, &["--json"]].concat());
        let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let verdict = &document["results"][0]["verdict"];
        ["proof", "code"].map(|key| verdict[key].as_str().unwrap().to_owned())
    };
    let proved = ["proved", "geometry-bound-met"].map(str::to_owned);
    // The wrist of an arm whose third joint is held at 0.5 radian, as a twist and by `--lock`.
    assert_eq!(code(&["iiwa14", "--joints", "0.3, 0.7, -1.1, 0.4, 0.9, 0.2"]), proved);
    assert_eq!(code(&["iiwa14_r820", "--lock", "3=0.5 rad", "--at", "0.3, 0.2, 0.6; 0.3, 0.2, 0.1"]), proved);
}

#[test]
fn a_stretched_arm_whose_twist_is_rounded_reaches_its_own_pose() {
    // Rounding of pi - 0.5 leaves of the self-motion not even complex solutions.
    for q in ["0,0,0,0,0,0", "0.3,0,0,0,0,0.1"] {
        let output = run(&["solve", "iiwa14", "--joints", q, "--json"]);
        let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let result = &document["results"][0];
        assert_eq!((&result["verdict"]["status"], &result["verdict"]["real"]), (&"complete".into(), &0.into()), "{q}");
        let families = result["families"].as_array().unwrap();
        assert_eq!(
            (families.len(), &families[0]["dimension"], &families[0]["joints"]),
            (1, &2.into(), &serde_json::json!([1, 4, 6]))
        );
    }
}
