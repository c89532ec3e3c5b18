//! Loops whose six unknown joints are dependent in every position.

use super::solution;
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::verdict::{Code, Proof, Status};
use serde_json::{Value, json};

/// Loops without a solution, by Groebner bases.
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
