//! Planar structures at configurations where assemblies coincide, and some that move, against counts by other programs.
//!
//! `structures.json` holds random structures of five and seven links: the joints, each with its two bodies and its point in either of
//! them. They were planted stretched on a line, on small grids and on two lines; some have one point moved by 1e-3 to 1e-13 afterwards.
//! `count` and `dimension` are those of a Groebner basis of the closure equations modulo 2147483629 (Singular), `distinct` counts the points of
//! its radical, and `real` the real solutions over the rationals (msolve).
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, LinkageFile, Options, any_from_text};
use looproot::internal::kinematics::linkage::Accuracy;
use looproot::internal::linkage::answer::{LinkageAnswer, solve};
use looproot::internal::verdict::{Proof, Status};
use serde_json::{Map, Value, json};

fn file(joints: &[Value]) -> Box<LinkageFile> {
    let mut bodies = Map::new();
    let mut list = Vec::new();
    for (k, joint) in joints.iter().enumerate() {
        let name = format!("p{k}");
        let of = [0, 1].map(|side| format!("b{}", joint[side]));
        for (side, body) in of.iter().enumerate() {
            let points = bodies.entry(body.clone()).or_insert_with(|| json!({}));
            points[&name] = joint[2 + side].clone();
        }
        list.push(json!({ "name": name, "type": "R", "of": of }));
    }
    let mechanism = json!({ "kind": "linkage", "space": "plane", "ground": "b0", "joints": list, "bodies": bodies });
    let text = json!({ "title": "structure", "mechanism": mechanism }).to_string();
    match any_from_text(&text, "test.json", Format::Json, &Options::default()).unwrap() {
        Any::Linkage(file) => file,
        _ => panic!("a linkage"),
    }
}

fn answer(joints: &[Value]) -> LinkageAnswer {
    let file = file(joints);
    solve(&file.linkage, &file.cases[0].given, Accuracy::Exact).unwrap()
}

#[test]
fn multiple_assemblies_are_listed_once_with_their_multiplicity() {
    let cases: Vec<Value> = serde_json::from_str(include_str!("linkage_singular/structures.json")).unwrap();
    let (mut finite, mut moving) = (0, 0);
    for case in &cases {
        let joints = case["joints"].as_array().unwrap();
        let answer = answer(joints);
        let verdict = &answer.verdict;
        let told = &verdict.reason;
        let Some(count) = case["count"].as_u64() else {
            // Complex assemblies move; whether real ones do is another question.
            assert!(matches!(verdict.status, Status::SelfMotion | Status::Incomplete), "{told}");
            assert!(told.contains("form a set of dimension") || told.contains("turns freely"), "{told}");
            if verdict.status == Status::SelfMotion {
                moving += 1;
                assert_eq!(Some(verdict.self_motion as u64), case["dimension"].as_u64(), "{told}");
                assert!(answer.families.iter().all(|family| family.sample.residual < 1e-9));
            }
            continue;
        };
        finite += 1;
        assert_eq!(verdict.proof, Proof::Proved, "{told}");
        assert!(matches!(verdict.status, Status::Complete | Status::Unreachable), "{told}");
        let real = answer.modes.iter().filter(|mode| mode.real);
        assert_eq!(Some(real.count() as u64), case["real"].as_u64(), "{told}");
        assert!(answer.modes.iter().all(|mode| mode.residual < 1e-9), "{told}");
        if verdict.complex_complete {
            assert_eq!(
                (verdict.complex as u64, Some(answer.modes.len() as u64)),
                (count, case["distinct"].as_u64()),
                "{told}"
            );
        }
    }
    assert!(finite > 15 && moving > 0, "{finite} {moving}");
}

/// Solves bodies in the plane whose shared points are joints.
fn of_bodies(bodies: &Value) -> LinkageAnswer {
    let mechanism = json!({
        "kind": "linkage", "space": "plane", "ground": "f", "joints": "shared points", "bodies": bodies
    });
    let text = json!({ "title": "bodies", "mechanism": mechanism }).to_string();
    let Any::Linkage(file) = any_from_text(&text, "test.json", Format::Json, &Options::default()).unwrap() else {
        panic!("a linkage")
    };
    solve(&file.linkage, &file.cases[0].given, Accuracy::Exact).unwrap()
}

/// A crank of two equal links turns about A; a dyad of these lengths stands on it and on E.
fn on_a_crank(lengths: [&str; 2]) -> LinkageAnswer {
    of_bodies(&json!({
        "f": { "A": [0, 0], "D": [0, 0], "E": [-2, 0] }, "a": { "A": 0, "B": 2, "P": 1 }, "b": { "D": 0, "B": 2 },
        "c": { "P": 0, "Q": lengths[0] }, "d": { "E": 0, "Q": lengths[1] }
    }))
}

#[test]
fn groups_that_stand_on_a_motion_follow_it() {
    // The dyad does not close with the crank at angle 0, and does elsewhere.
    let answer = on_a_crank(["1", "1"]);
    assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::SelfMotion, Proof::Proved));
    let [family] = answer.families.as_slice() else { panic!("one family") };
    // All joints but B, about which the two equal links do not turn.
    assert_eq!((family.dimension, &family.joints), (1, &vec![0, 1, 2, 4, 5]));
    assert!(family.sample.real && family.sample.residual < 1e-12);
}

/// The rod c and the rod below turn about one joint of k. What hangs on the moving group through k is not left as it is by its motion.
#[test]
fn a_motion_that_stands_on_another_one_adds_no_freedom() {
    let bodies = json!({
        "frame": { "P": [3, 0], "B": 0, "Q": [-3, 5], "D": [4, 5] }, "j": { "P": 0, "X": 3 }, "upper": { "X": 0, "B": 0, "Z": 4 },
        "k": { "Q": 0, "Y": 3 }, "c": { "D": 0, "Y": 4 }, "f": { "Z": 0, "W": 3 }, "lower": { "W": 0, "Y": 0 }
    });
    let joint = |name: &str, of: [&str; 2]| json!({ "name": name, "type": "R", "of": of });
    let joints = json!([
        joint("P", ["frame", "j"]), joint("X", ["j", "upper"]), joint("B", ["frame", "upper"]), joint("Q", ["frame", "k"]),
        joint("Y", ["k", "c"]), joint("D", ["frame", "c"]), { "name": "Y2", "type": "R", "of": ["k", "lower"], "at": "Y" },
        joint("W", ["f", "lower"]), joint("Z", ["upper", "f"])
    ]);
    let mechanism =
        json!({ "kind": "linkage", "space": "plane", "ground": "frame", "joints": joints, "bodies": bodies });
    let text = json!({ "title": "spins", "mechanism": mechanism }).to_string();
    let Any::Linkage(file) = any_from_text(&text, "test.json", Format::Json, &Options::default()).unwrap() else {
        panic!("a linkage")
    };
    let answer = solve(&file.linkage, &file.cases[0].given, Accuracy::Exact).unwrap();
    assert!(answer.families.iter().all(|family| family.dimension == 1) && !answer.families.is_empty());
    assert_eq!(answer.verdict.self_motion, 1);
}

#[test]
fn a_motion_on_which_nothing_can_stand_is_none() {
    // P and E are 1 apart at least: the dyad closes nowhere, or stretched in one real assembly. Complex ones move in both cases.
    for lengths in [["1/4", "1/4"], ["3/5", "2/5"]] {
        let answer = on_a_crank(lengths);
        assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::Incomplete, Proof::None));
        assert!(answer.families.is_empty());
    }
}

#[test]
fn assemblies_beside_a_motion_are_listed() {
    // Three equal cranks move in parallel; two assemblies do not.
    let answer = of_bodies(&json!({
        "f": { "A": [0, 0], "B": [4, 0], "C": [0, 3] }, "a": { "A": 0, "D": 2 }, "b": { "B": 0, "E": 2 },
        "c": { "C": 0, "G": 2 }, "plate": { "D": [0, 0], "E": [4, 0], "G": [0, 3] }
    }));
    assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::SelfMotion, Proof::Proved));
    assert_eq!((answer.modes.len(), answer.verdict.real), (2, 2));
    // The centres of the circles on which its corners lie are moved by 2 sin(angle / 2) times the radius 5/2 of the triangle: to 2.
    for mode in &answer.modes {
        assert!(((mode.bodies[4].0.re / 2.0).sin().abs() - 0.4).abs() < 1e-12);
    }
    assert!(answer.verdict.reason.contains("all regular assemblies"), "{}", answer.verdict.reason);
}

#[test]
fn dyads_that_turn_beside_one_another_have_two_freedoms() {
    let answer = of_bodies(&json!({
        "f": { "A": [0, 0], "B": [1, 0], "D": [1, 0], "E": [2, 0], "G": [2, 0] },
        "b": { "B": [1, 0], "C": [3, 0] }, "a": { "D": [1, 0], "C": [3, 0] },
        "e": { "E": [2, 0], "F": [4, 0] }, "c": { "G": [2, 0], "F": [4, 0] }
    }));
    let verdict = &answer.verdict;
    assert_eq!((verdict.status, verdict.proof, verdict.self_motion), (Status::SelfMotion, Proof::Proved, 2));
}
