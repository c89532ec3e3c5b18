//! Files of linkages: what is refused, and what an empty list of inputs means.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, LinkageFile, Options, any_from_text};
use looproot::internal::linkage::answer::solve;
use looproot::internal::verdict::Status;

fn read(text: &str) -> Result<Box<LinkageFile>, String> {
    match any_from_text(text, "test.json", Format::Json, &Options::default()) {
        Ok(Any::Linkage(file)) => Ok(file),
        Ok(_) => panic!("a linkage in the plane"),
        Err(error) => Err(error.to_string()),
    }
}

/// A triangle of bars, with further joints and further keys of the file.
fn triangle(joints: &str, keys: &str) -> String {
    format!(
        r#"{{ "mechanism": {{ "kind": "linkage", "space": "plane", "ground": "f",
        "joints": [ {{ "name": "A", "type": "R", "of": ["f", "c"] }}, {{ "name": "B", "type": "R", "of": ["c", "r"] }},
        {{ "name": "D", "type": "R", "of": ["r", "f"] }} {joints} ],
        "bodies": {{ "f": {{ "A": 0, "D": 6, "Z": 0 }}, "c": {{ "A": 0, "B": 4, "Z": [0, 1] }}, "r": {{ "B": 0, "D": 5 }} }} }} {keys} }}"#
    )
}

#[test]
fn an_empty_list_of_inputs_is_a_structure() {
    for keys in ["", r#", "input": []"#] {
        let file = read(&triangle("", keys)).unwrap();
        assert_eq!(file.cases.len(), 1, "{keys}");
        let case = &file.cases[0];
        let answer = solve(&file.linkage, &case.given, file.accuracy(case)).unwrap();
        assert_eq!((answer.verdict.status, answer.verdict.complex), (Status::Complete, 2));
    }
}

#[test]
fn bodies_joined_twice_at_a_point_are_refused() {
    for (joint, message) in [
        (
            r#", { "name": "A2", "type": "R", "of": ["c", "f"], "at": "A" }"#,
            "the joints A and A2 between c and f at the same point of c",
        ),
        (
            r#", { "name": "Z", "type": "R", "of": ["f", "c"] }"#,
            "the joints A and Z between f and c at the same point of f",
        ),
    ] {
        let found = read(&triangle(joint, "")).unwrap_err();
        assert!(found.starts_with("test.json:") && found.contains(message), "{found}");
    }
}

#[test]
fn a_bar_with_the_name_of_a_body_does_not_take_its_place() {
    let bar = r#", { "name": "c", "type": "RR", "of": ["f", "r"], "at": ["Z", "B"], "length": 4 }, { "name": "Z", "type": "R", "of": ["c", "x"] }"#;
    let text = triangle(bar, "").replace(r#""r": { "B""#, r#""x": { "Z": 0 }, "r": { "B""#);
    let file = read(&text).unwrap();
    let last = file.linkage.joints.last().unwrap();
    assert_eq!(file.linkage.bodies[last.of[0]].points.len(), 3, "the body c of the file, not the bar");
}
