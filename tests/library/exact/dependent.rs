//! Loops whose six unknown joints are dependent in every position.

use super::solution;
use looproot::internal::catalogue::entry::{Design, Entry};
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::elimination::coordinate_ring::Plan;
use looproot::internal::mechanism::closed_loop;
use looproot::internal::verdict::{Code, Proof, Status};
use looproot_algebra::drawn::Drawn;
use looproot_algebra::interval::Interval;
use serde_json::{Value, json};

/// Loops without a solution, and arms at singular poses, by Groebner bases.
const LOOPS: &str = include_str!("dependent.json");

fn answer(document: &Value) -> looproot::internal::mechanism::Solution {
    let text = document.to_string();
    solution(&load_text(&text, "loop.json", Format::Json, &Options::default()).unwrap())
}

#[test]
fn that_dependent_joints_do_not_close_a_loop_is_proved() {
    let list: Value = serde_json::from_str(LOOPS).unwrap();
    for document in list["loops"].as_array().unwrap() {
        let verdict = answer(document).verdict;
        let expected = (Status::Unreachable, Proof::Proved, Code::NoSolution);
        assert_eq!((verdict.status, verdict.proof, verdict.code), expected, "{document}: {}", verdict.reason);
    }
}

#[test]
fn dependent_joints_that_close_a_loop_are_not_said_to_leave_it_open() {
    // Seven parallel axes.
    let joint = |a: i32| json!({ "type": "R", "a": a, "tan_half_alpha": 0, "d": 0 });
    let joints: Vec<Value> = [3, 2, 4, 3, 2, 3, 4].map(joint).into();
    let document = json!({
        "title": "seven parallel axes",
        "mechanism": { "kind": "loop", "convention": "dh", "joints": joints },
        "input": [{ "joint": 1, "tan_half": "1/2" }]
    });
    let verdict = answer(&document).verdict;
    assert_ne!(verdict.status, Status::Unreachable, "{}", verdict.reason);
}

#[test]
fn self_motions_at_singular_poses_are_proved() {
    let list: Value = serde_json::from_str(LOOPS).unwrap();
    for arm in list["moving"].as_array().unwrap() {
        let document = json!({ "title": arm["title"], "mechanism": arm["mechanism"], "pose": arm["pose"] });
        let answer = answer(&document);
        let verdict = &answer.verdict;
        assert_eq!(
            (verdict.status, verdict.proof),
            (Status::SelfMotion, Proof::Proved),
            "{document}: {}",
            verdict.reason
        );
        assert_eq!(verdict.self_motion as u64, arm["dimension"].as_u64().unwrap(), "{document}");
        // A linkage stretched flat is a real point of a complex curve.
        assert_eq!(!answer.families.is_empty(), arm["has_family"].as_bool().unwrap(), "{document}");
        assert!(!answer.families.is_empty() || answer.modes.iter().any(|mode| mode.real), "{document}");
    }
}

/// Rows of Denavit and Hartenberg: a, alpha in right angles, d.
type Row = (f64, i32, f64);

type Matrix = [[f64; 4]; 4];

/// Forward kinematics of its own, rounded to twelve digits as poses are printed.
fn typed_pose(rows: &[Row; 6], q: &[f64; 6]) -> Matrix {
    reached(rows, q).map(|row| row.map(|x| (x * 1e12).round() / 1e12))
}

fn reached(rows: &[Row; 6], q: &[f64]) -> Matrix {
    let mut pose: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    for ((a, right_angles, d), angle) in rows.iter().zip(q) {
        let (sin, cos) = angle.sin_cos();
        let (st, ct) = (f64::from(*right_angles), f64::from(1 - right_angles.abs()));
        let link = [
            [cos, -sin * ct, sin * st, a * cos],
            [sin, cos * ct, -cos * st, a * sin],
            [0.0, st, ct, *d],
            [0.0, 0.0, 0.0, 1.0],
        ];
        pose = std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| pose[i][k] * link[k][j]).sum()));
    }
    pose
}

/// Arms whose six joints are dependent: four axes through a point, two coaxial ones, four parallel ones.
const ARMS: [[Row; 6]; 3] = [
    [(0.3, 1, 0.2), (0.5, 0, 0.0), (0.0, 1, 0.0), (0.0, -1, 0.0), (0.0, 1, 0.0), (0.1, 0, 0.2)],
    [(0.3, 1, 0.2), (0.5, 1, 0.1), (0.2, 1, 0.3), (0.0, 0, 0.1), (0.2, -1, 0.0), (0.1, 0, 0.2)],
    [(0.3, 0, 0.2), (0.5, 0, 0.0), (0.25, 0, 0.1), (0.2, 1, 0.0), (0.1, -1, 0.3), (0.1, 0, 0.2)],
];

fn document(rows: &[Row; 6], pose: &Matrix) -> Value {
    let joint = |(a, right_angles, d): &Row| json!({ "type": "R", "a": a, "alpha": format!("{} deg", 90 * right_angles), "d": d });
    let joints: Vec<Value> = rows.iter().map(joint).collect();
    let mechanism = json!({ "kind": "arm", "convention": "dh", "joints": joints });
    json!({ "title": "dependent", "mechanism": mechanism, "pose": [{ "matrix": pose }] })
}

fn at(rows: &[Row; 6], pose: &Matrix) -> looproot::internal::mechanism::Solution {
    answer(&document(rows, pose))
}

/// Configurations of which no joint is at a special angle.
const CONFIGURATIONS: [[f64; 6]; 3] =
    [[0.3, -0.7, 1.1, 0.4, -1.9, 2.2], [-2.5, 0.9, 0.2, -1.3, 0.6, -0.4], [1.4, 2.3, -0.8, 2.9, 1.7, 0.1]];

#[test]
fn typed_poses_of_dependent_joints_are_met() {
    for rows in &ARMS {
        for q in &CONFIGURATIONS {
            let pose = typed_pose(rows, q);
            let answer = at(rows, &pose);
            // The typed pose is reached by no configuration exactly, and by families within the tolerance.
            assert_ne!(answer.verdict.status, Status::Unreachable, "{rows:?} {q:?}: {}", answer.verdict.reason);
            assert!(!answer.families.is_empty(), "{rows:?} {q:?}: {}", answer.verdict.reason);
            for family in &answer.families {
                let off = reached(rows, &family.sample).into_iter().flatten().zip(pose.into_iter().flatten());
                let off = off.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
                assert!(off < 1e-9, "{rows:?} {q:?}: {off}");
            }
        }
    }
}

#[test]
fn what_dependent_joints_do_not_reach_is_denied_by_proof_only() {
    // The tool of another arm of the same size.
    let other = [(0.2, 1, 0.1), (0.4, -1, 0.1), (0.2, 1, 0.1), (0.1, 1, 0.1), (0.1, -1, 0.1), (0.1, 0, 0.1)];
    let mut denied = 0;
    for rows in &ARMS {
        for q in [[0.5, 1.7, -0.4, 0.8, 1.2, 0.3], [-1.1, 0.2, 2.1, -0.6, 0.4, 1.5]] {
            let verdict = at(rows, &typed_pose(&other, &q)).verdict;
            assert_eq!(verdict.real, 0, "{rows:?}: {}", verdict.reason);
            denied += usize::from(verdict.status == Status::Unreachable);
            let is_denied = verdict.status == Status::Unreachable;
            assert_eq!(is_denied, verdict.proof == Proof::Proved, "{rows:?}: {}", verdict.reason);
        }
    }
    assert!(denied > 0);
}

#[test]
fn a_contradiction_of_the_closure_equations_knows_what_nearly_closes() {
    // How far the equations of these arms are off at a configuration that misses the pose by 3e-6, and more.
    let miss = 2e-4;
    let mut compared = 0;
    for rows in &ARMS {
        for q in &CONFIGURATIONS {
            let mut pose = typed_pose(rows, q);
            for (row, off) in pose.iter_mut().zip([1e-6, 2e-6, -1.5e-6]) {
                row[3] += off;
            }
            let text = document(rows, &pose).to_string();
            let entry: Entry = load_text(&text, "arm.json", Format::Json, &Options::default()).unwrap();
            let Design::Arm(chain) = &entry.design else { panic!("no arm") };
            let (_, modular) = closed_loop::<Drawn>(chain, &entry.cases[0]).unwrap().unwrap();
            let (_, closed) = closed_loop::<Interval>(chain, &entry.cases[0]).unwrap().unwrap();
            let Some(plan) = Plan::of(&modular).filter(|plan| plan.count() == 0) else { continue };
            // Nothing closes exactly, but this configuration comes within that.
            if let (Some(exact), Some(bound)) = (plan.one_off(&closed, 0.0), plan.one_off(&closed, miss)) {
                assert!(exact < 0.5 && bound >= 1.0, "{rows:?} {q:?}: {exact} {bound}");
                compared += 1;
            }
        }
    }
    assert!(compared > 3, "{compared}");
}
