//! Loops whose six unknown joints are dependent in every position.

use super::solution;
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::verdict::{Code, Proof, Status};
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
