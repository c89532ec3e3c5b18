//! Mobility of chains of any number of joints, and what the verbs say of loops that they cannot take.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Chains, Format, Options, builtin, load_text};
use looproot::internal::mobility::{Local, Mobility, mobility};
use looproot::internal::verdict::Proof;
use std::fs;
use std::process::Command;

/// A revolute joint of a DH file: link length, twist in degrees, offset.
fn revolute(a: &str, alpha: i32, d: &str) -> String {
    format!("{{ type = \"R\", a = {a}, alpha = \"{alpha} deg\", d = {d} }}")
}

fn spherical(a: &str) -> String {
    format!("{{ type = \"S\", a = {a}, alpha = 0 }}")
}

fn chain(kind: &str, joints: &[String], rest: &str) -> String {
    format!("[mechanism]\nkind = \"{kind}\"\nconvention = \"dh\"\njoints = [\n{}\n]\n{rest}", joints.join(",\n"))
}

/// Revolute joints in no special position.
fn general(count: usize) -> Vec<String> {
    let joint = |k: usize| {
        let a = ["0.9", "1.3", "0.7", "1.1", "0.8"][k % 5];
        let alpha = [67, 35, 110, 52, 81, 140][k % 6];
        revolute(a, alpha, ["0.2", "-0.3", "0.1", "0.4"][k % 4])
    };
    (0..count).map(joint).collect()
}

fn parallel(lengths: &[&str]) -> Vec<String> {
    lengths.iter().map(|a| revolute(a, 0, "0")).collect()
}

fn decided(text: &str) -> Mobility {
    let options = Options { chains: Chains::Any, ..Options::default() };
    mobility(&load_text(text, "own.toml", Format::Toml, &options).unwrap()).unwrap()
}

#[test]
fn loops_without_input_move_by_as_many_freedoms_as_they_have() {
    let cylindrical = |alpha: i32| format!("{{ type = \"C\", a = 0.7, alpha = \"{alpha} deg\" }}");
    let universal = "{ type = \"U\", a = 1, alpha = \"40 deg\" }".to_owned();
    let loops = [
        (general(7), 1),
        (general(9), 3),
        ([40, 60, 75, 50].map(cylindrical).to_vec(), 2),
        ([vec![universal], general(5)].concat(), 1),
        (vec![revolute("0.5", 30, "0.2"), spherical("1.5"), spherical("1.2"), revolute("2", 70, "0.1")], 2),
        (vec![revolute("0.5", 30, "0.2"), spherical("1.5"), spherical("1.2"), spherical("1.7")], 4),
    ];
    for (joints, freedoms) in loops {
        let answer = decided(&chain("loop", &joints, ""));
        let found = (answer.mobility, answer.gruebler(), answer.screw_rank());
        let expected = (Some(freedoms), i64::try_from(freedoms).unwrap(), Some(6));
        assert_eq!(found, expected, "{joints:?}: {}", answer.reason);
        // Twists of whole degrees are rounded, and a certificate may be of the rounded loop only.
        assert!(matches!(answer.proof, Proof::Proved | Proof::RoundedData), "{joints:?}: {}", answer.reason);
        assert!(!answer.configurations.is_empty() && answer.held.len() <= freedoms);
    }
}

#[test]
fn idle_spins_are_named() {
    let [two, three] = [2, 3].map(|spherical_joints| {
        let joints = [
            vec![revolute("0.5", 30, "0.2")],
            vec![spherical("1.5"); spherical_joints],
            vec![revolute("2", 70, "0.1")],
        ]
        .concat();
        decided(&chain("loop", &joints, "")).reason
    });
    assert!(two.contains("one of these freedoms is idle") && two.contains("S joints 2 and 3"), "{two}");
    assert!(three.contains("3 of these freedoms are idle") && three.contains("4 and 2"), "{three}");
}

#[test]
fn links_that_move_in_groups_have_more_freedoms_than_the_count_says() {
    let one = decided(&chain("loop", &parallel(&["1", "1.2", "0.8", "1.1", "0.9", "1.3", "0.7"]), ""));
    assert_eq!((one.mobility, one.gruebler(), one.screw_rank(), one.proof), (Some(4), 1, Some(3), Proof::Proved));
    // Four parallel axes, then three of another direction: Sarrus's linkage with one joint more.
    let mut two = parallel(&["1", "1.1", "0.9", "0.5", "1", "1.2", "0.4"]);
    two[3] = revolute("0.5", 90, "0");
    two[6] = revolute("0.4", -90, "0");
    let two = decided(&chain("loop", &two, ""));
    assert_eq!((two.mobility, two.gruebler(), two.screw_rank(), two.proof), (Some(2), 1, Some(5), Proof::Proved));
    assert!(two.configurations.iter().any(|c| c.local == Local::Manifold { dimension: 2 }), "{}", two.reason);
}

#[test]
fn a_link_longer_than_all_others_is_never_closed() {
    let joints = [vec![revolute("50", 60, "1")], general(6)].concat();
    let answer = decided(&chain("loop", &joints, ""));
    assert_eq!((answer.mobility, answer.proof), (Some(0), Proof::Proved));
    assert!(answer.configurations.is_empty() && answer.reason.contains("one link spans"), "{}", answer.reason);
}

#[test]
fn where_nothing_real_is_found_it_is_not_decided() {
    // Two prismatic joints in a loop whose links cannot meet, though none of them is too long.
    let slide = |alpha: i32| format!("{{ type = \"P\", a = 9, alpha = \"{alpha} deg\", theta = \"30 deg\" }}");
    let joints = [vec![slide(40)], general(5), vec![slide(60)]].concat();
    let answer = decided(&chain("loop", &joints, ""));
    assert_eq!((answer.mobility, answer.proof), (None, Proof::None), "{}", answer.reason);
    assert!(answer.reason.contains("no regular real configuration was found"), "{}", answer.reason);
}

#[test]
fn an_arm_moves_freely_and_a_platform_on_locked_legs_does_not() {
    let arm = decided(&chain("arm", &general(7), ""));
    assert_eq!((arm.mobility, arm.gruebler(), arm.screw_rank(), arm.proof), (Some(7), 7, Some(6), Proof::Proved));
    assert!(arm.reason.contains("with the tool held 1 remain"), "{}", arm.reason);
    let platform = mobility(&builtin("platform_02real", &Options::default()).unwrap()).unwrap();
    let found = (platform.mobility, platform.gruebler(), platform.screw_rank(), platform.proof);
    assert_eq!(found, (Some(0), 0, Some(6), Proof::Proved), "{}", platform.reason);
    let free = mobility(&builtin("bricard_octahedron", &Options::default()).unwrap()).unwrap();
    assert!(free.proof == Proof::None && free.mobility != Some(0), "{}", free.reason);
}

fn run(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_looproot")).args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

fn file(name: &str, text: &str) -> String {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("mobility_verb");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path.display().to_string()
}

#[test]
fn loops_that_the_verbs_cannot_take_are_refused_with_place_and_mobility() {
    let input = |joint: usize, value: &str| format!("[[input]]\njoint = {joint}\n{value}\n");
    let slide = "{ type = \"P\", a = 0.5, alpha = \"40 deg\", theta = \"30 deg\" }".to_owned();
    let files = [
        ("eight", chain("loop", &general(8), &input(1, "angle = 0.5")), 1, "make one variable constant"),
        ("no_input", chain("loop", &general(7), ""), 1, "found no [[input]]"),
        ("joint_9", chain("loop", &general(7), &input(9, "angle = 0.5")), 1, "expected one from 1 to 7"),
        ("distance", chain("loop", &general(7), &input(1, "distance = 0.5")), 1, "expected `angle`"),
        (
            "slide",
            chain("loop", &[vec![slide.clone()], general(6)].concat(), &input(1, "angle = 1")),
            1,
            "expected `distance`",
        ),
        (
            "spherical joints",
            chain("loop", &[vec![spherical("1"); 3], general(1)].concat(), &input(4, "angle = 1")),
            1,
            "3 freedoms too many",
        ),
        (
            "slides",
            chain("loop", &[vec![slide; 5], general(2)].concat(), &input(6, "angle = 1")),
            4,
            "three unknown rotations",
        ),
        (
            "helical",
            chain(
                "loop",
                &[vec!["{ type = \"H\", a = 1, alpha = 1, d = 0, pitch = 0.1 }".to_owned()], general(6)].concat(),
                &input(2, "angle = 1"),
            ),
            4,
            "not solved yet",
        ),
        ("short", chain("loop", &general(6), &input(1, "angle = 1")), 4, "no single closure polynomial"),
    ];
    for (name, text, code, what) in files {
        let path = file(&format!("{name}.toml"), &text);
        // Short loops are solved: for them only derivation is refused.
        for verb in if name == "short" { &["derive"][..] } else { &["solve", "derive"] } {
            let (found, _, err) = run(&[verb, &path]);
            assert_eq!(found, Some(code), "{verb} {name}: {err}");
            for part in [&format!("{path}:"), "Gruebler's count", "screw rank"] {
                assert!(err.contains(part), "{verb} {name}: {err}");
            }
            assert!(verb == &"derive" || err.contains(what), "{verb} {name}: {err}");
        }
    }
}

#[test]
fn a_sweep_brings_its_own_input() {
    let path = file("swept.toml", &chain("loop", &general(7), ""));
    let (code, out, err) = run(&["sweep", &path, "--joint", "1", "--from", "0", "--to", "1", "--steps", "2"]);
    // Six unknown rotations are of degree 16: the branches are followed, not proved.
    assert_eq!(code, Some(2), "{out}{err}");
    let (code, out, _) = run(&["mobility", &path, "--json"]);
    let document: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!((code, &document["mobility"], &document["freedoms"]), (Some(0), &1.into(), &7.into()));
    for (name, kind, freedoms, expected) in [("puma560", "arm", 6, 0), ("platform_02real", "platform", 6, 3)] {
        let (code, out, _) = run(&["mobility", name, "--json"]);
        let document: serde_json::Value = serde_json::from_str(&out).unwrap();
        assert_eq!((code, &document["kind"], &document["freedoms"]), (Some(expected), &kind.into(), &freedoms.into()));
        assert_eq!(document["variables"].as_array().unwrap().len(), freedoms);
    }
}

#[test]
fn data_of_few_digits_do_not_move_and_are_said_to_be_near_what_does() {
    // Bennett's loop of twists 30 and 60 degrees, to six digits, and the same with a link that does not fit.
    let typed = |second: &str| {
        let links = [("1.0", "0.523599"), (second, "1.047198"), ("1.0", "0.523599"), ("1.732051", "1.047198")];
        let joints = links.map(|(a, alpha)| format!("{{ type = \"R\", a = {a}, alpha = {alpha}, d = 0 }}"));
        decided(&chain("loop", &joints, ""))
    };
    let near = typed("1.732051");
    // Twists in radians have no rational half-angle tangent and lie in no small field.
    assert_eq!((near.mobility, near.proof), (Some(0), Proof::RoundedData), "{}", near.reason);
    assert!(near.reason.contains("the loop as given is immobile, but near a mobile one"), "{}", near.reason);
    let number =
        |before: &str| -> f64 { near.reason.split(before).nth(1).unwrap().split(' ').next().unwrap().parse().unwrap() };
    let (turn, shift) = (number("turned by at most "), number("shifted by at most "));
    assert!(turn < 1e-6 && shift < 1e-6 && turn.max(shift) > 1e-8, "{}", near.reason);
    let far = typed("1.9");
    assert_eq!((far.mobility, far.proof), (Some(0), Proof::RoundedData), "{}", far.reason);
    assert!(!far.reason.contains("near a mobile one"), "{}", far.reason);
}

/// The verdict of a document begins with what it decides, whatever the kind.
#[test]
fn documents_begin_their_verdict_with_what_is_decided() {
    for (name, word) in [
        ("bennett_a", "mobile: mobility 1"),
        ("linkage/jansen", "mobile: mobility 1"),
        ("framework/steffen", "mobile: mobility 1"),
        ("linkage/3rpr", "mobile: mobility 3"),
        ("framework/octahedron_control", "immobile: "),
    ] {
        let (_, out, error) = run(&["mobility", name, "--json"]);
        let document: serde_json::Value = serde_json::from_str(&out).unwrap_or_else(|_| panic!("{name}: {error}"));
        let verdict = document["verdict"].as_str().unwrap();
        assert!(verdict.starts_with(word), "{name}: {verdict}");
    }
}
