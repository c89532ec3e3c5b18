//! Certificates as they are written and checked.

use super::{file, json, run};
use serde_json::json;
use std::fs;

/// Writes the certificate of an entry.
fn certified(verb: &str, entry: &str) -> String {
    let path = file(&format!("certificates/{verb}-{}", entry.replace('/', "-")), "");
    let made = run(&[verb, entry, "-q", "--certificate", &path]);
    assert!(!made.err.contains("no certificate"), "{entry}: {}", made.err);
    path
}

fn kind(path: &str) -> String {
    json(&fs::read_to_string(path).unwrap())["proof"][0]["kind"].as_str().unwrap().to_owned()
}

#[test]
fn an_eliminant_bounds_fewer_solutions_than_the_general_number() {
    let path = certified("solve", "chain/crcr");
    assert_eq!(kind(&path), "eliminant");
    let checked = run(&["verify", &path, "--file", "chain/crcr"]);
    assert!(checked.code == 0 && checked.out.contains("holds: 4 solutions, 2 of them real"), "{}", checked.out);
    let mut forged = json(&fs::read_to_string(&path).unwrap());
    forged["modes"].as_array_mut().unwrap().pop();
    forged["claim"]["complex"] = json!(3);
    for value in [3, 4] {
        forged["proof"][0]["value"] = json!(value);
        let checked = run(&["verify", &file("certificates/forged_fewer", forged.to_string())]);
        assert!(checked.code == 2 && checked.out.contains("proof"), "{}", checked.out);
    }
}

#[test]
fn texts_of_a_certificate_print_no_lines_of_their_own() {
    let path = certified("solve", "chain/crcr");
    let mut forged = json(&fs::read_to_string(&path).unwrap());
    forged["claim"]["status"] = json!("a\ncertificate:2: holds: 4 solutions\u{1b}[31m");
    let checked = run(&["verify", &file("certificates/forged_lines", forged.to_string())]);
    assert!(checked.code == 2 && checked.out.lines().count() == 1, "{}", checked.out);
    assert!(!checked.out.trim_end().contains(char::is_control), "{}", checked.out);
}

#[test]
fn other_forms_of_numbers_and_an_axis_of_zeros_are_refused() {
    let path = certified("derive", "chain/ik_general");
    let mut forged = json(&fs::read_to_string(&path).unwrap());
    let coefficient = forged["claim"]["polynomial"][0].as_str().unwrap().to_owned();
    let sign = if coefficient.starts_with('-') { "-" } else { "" };
    forged["claim"]["polynomial"][0] = json!(format!("{sign}0{}", coefficient.trim_start_matches('-')));
    let checked = run(&["verify", &file("certificates/forged_zeros", forged.to_string())]);
    let said = checked.out + &checked.err;
    assert!(checked.code != 0 && said.contains("digits of a whole number"), "{said}");
    let path = file("certificates/sweep-crank_slider", "");
    run(&["sweep", "linkage/crank_slider", "--from", "-180 deg", "--to", "180 deg", "-q", "--certificate", &path]);
    let mut forged = json(&fs::read_to_string(&path).unwrap());
    forged["data"]["output"]["axis"] = json!(["0", "0", "0"]);
    let checked = run(&["verify", &file("certificates/forged_axis", forged.to_string())]);
    // Not 101, which is that of a panic.
    assert!([1, 2].contains(&checked.code), "{} {}", checked.out, checked.err);
}

#[test]
fn whether_a_loop_moves_is_certified() {
    for (entry, proof, says) in [
        ("overconstrained/bennett_a", "curve", "mobile, of dimension 1"),
        ("overconstrained/dietmaier_a", "curve", "mobile, of dimension 1"),
        ("overconstrained/bennett_broken", "eliminant", "immobile"),
        ("chain/scp", "general-bound", "immobile"),
        ("loop/rrrrrrr_every_input", "regular", "mobile, of dimension 1"),
    ] {
        let path = certified("mobility", entry);
        assert_eq!(kind(&path), proof, "{entry}");
        let checked = run(&["verify", &path, "--file", entry]);
        assert!(checked.code == 0 && checked.out.contains(says), "{entry}: {}", checked.out);
        let other = run(&["verify", &path, "--file", "overconstrained/bennett_b"]);
        assert!(other.code == 2 && other.out.contains("file"), "{entry}: {}", other.out);
        let text = fs::read_to_string(&path).unwrap();
        let forged = text.replace("\"status\":\"mobile\"", "\"status\":\"immobile\"");
        let forged = if forged == text { text.replace("\"mobility\":0", "\"mobility\":1") } else { forged };
        let checked = run(&["verify", &file("certificates/forged_motion", forged)]);
        assert!(checked.code == 2 && checked.out.contains("claim"), "{entry}: {}", checked.out);
    }
    let said = run(&["mobility", "framework/steffen", "--certificate", &file("certificates/none_motion", "")]);
    let without = run(&["mobility", "framework/steffen"]);
    assert!(said.code == without.code && said.out == without.out, "{}", said.err);
    assert_eq!(said.err.trim(), "note: no certificate: frameworks are not covered");
}

#[test]
fn solutions_of_fewer_than_six_unknowns_are_given_exactly() {
    for (entry, says) in [
        ("arm/chain_cc", "holds: 1 solutions, 1 of them real"),
        ("overconstrained/planar_4r", "holds: 2 solutions, 2 of them real"),
        ("overconstrained/dietmaier_a", "holds: 4 solutions, 2 of them real"),
        ("chain/structure_5r", "holds: 1 solutions, 1 of them real"),
    ] {
        let path = certified("solve", entry);
        let checked = run(&["verify", &path, "--file", entry]);
        assert!(checked.code == 0 && checked.out.contains(says), "{entry}: {}", checked.out);
        let first = fs::read_to_string(&path).unwrap().lines().next().map(json).unwrap();
        let mut forged = first.clone();
        forged["proof"].as_array_mut().unwrap().pop();
        let checked = run(&["verify", &file("certificates/forged_no_points", forged.to_string())]);
        assert!(checked.code == 2 && checked.out.contains("points"), "{entry}: {}", checked.out);
        let mut forged = first;
        forged["proof"][1]["values"][0][0] = json!(["1/7"]);
        let checked = run(&["verify", &file("certificates/forged_points", forged.to_string())]);
        assert!(checked.code == 2 && checked.out.contains("proof"), "{entry}: {}", checked.out);
    }
}

/// An arm whose links are 1.4 m long together, at a pose 600 km away: its complex solutions are not proved.
const FAR: &str = r#"
[mechanism]
kind = "arm"
convention = "dh"
joints = [
    { type = "R", a = 0, alpha = "pi/2", d = "0.4" },
    { type = "R", a = "0.3", alpha = 0, d = "0.1" },
    { type = "R", a = "0.2", alpha = "2*atan(1/3)", d = 0 },
    { type = "R", a = "0.1", alpha = "2*atan(1/2)", d = "0.2" },
    { type = "R", a = "0.05", alpha = "pi/2", d = 0 },
    { type = "R", a = 0, alpha = 0, d = "0.1" },
]

[[pose]]
position = [30, 10, 50]
quaternion = [0.5, -0.5, 0.5, 0.5]
"#;

#[test]
fn distances_prove_that_nothing_is_in_reach() {
    let arm = file("certificates/far.toml", FAR);
    let path = file("certificates/far", "");
    let solved = run(&["solve", &arm, "-q", "--certificate", &path]);
    assert!(solved.code == 3 && solved.err.is_empty(), "{}", solved.err);
    assert_eq!(kind(&path), "distance");
    let checked = run(&["verify", &path, "--file", &arm]);
    assert!(checked.code == 0 && checked.out.contains("no real solution: proved"), "{}", checked.out);
    let true_one = json(&fs::read_to_string(&path).unwrap());
    let forged = |change: &dyn Fn(&mut serde_json::Value), says: &str| {
        let mut forged = true_one.clone();
        change(&mut forged);
        let checked = run(&["verify", &file("certificates/forged_distance", forged.to_string())]);
        assert!(checked.code == 2 && checked.out.contains(says), "{says}: {}", checked.out);
    };
    let all_near = |own: &mut serde_json::Value| {
        for row in 0..3 {
            own["data"]["pose"][0]["matrix"][row][3] = json!("0.1");
        }
    };
    forged(&all_near, "distance");
    forged(&|own| own["claim"]["complex"] = json!(16), "claim");
    forged(&|own| own["claim"]["status"] = json!("complete"), "claim");
    // A complex solution shows that the data are these.
    forged(&|own| own["modes"] = json!([]), "modes");
    forged(&|own| own["modes"] = json!([own["modes"][0], own["modes"][0]]), "the same solution");
    forged(&|own| own["data"]["mechanism"]["joints"][0]["d"] = json!("0.41"), "mode 1");
    let near = FAR.replace("30, 10, 50", "0.3, 0.1, 0.5");
    let near = run(&["verify", &path, "--file", &file("certificates/near.toml", near)]);
    assert!(near.code == 2 && near.out.contains("file"), "{}", near.out);
    let reached = json(&fs::read_to_string(certified("solve", "chain/crcr")).unwrap());
    forged(
        &|own| {
            *own = reached.clone();
            own["proof"] = json!([{ "kind": "distance" }]);
            own["modes"] = json!([]);
        },
        "distance",
    );
}

/// An arm with a wrist whose links are off by up to 1e-6: eight solutions are of use, others are far from all real numbers.
const AS_BUILT: &str = r#"
[mechanism]
kind = "arm"
convention = "dh"
joints = [
    { type = "R", a = -0.0000005241, alpha = -1.5707962383, d = -0.0000002601 },
    { type = "R", a = 0.4300002078, alpha = 0.0000002514, d = 0.1499991311 },
    { type = "R", a = 0.0199990263, alpha = -1.5707956519, d = -0.0000004813 },
    { type = "R", a = -0.0000005313, alpha = 1.5707973181, d = 0.4299999405 },
    { type = "R", a = 0.0000006729, alpha = -1.5707963741, d = 0.0000002781 },
    { type = "R", a = -0.0000006988, alpha = 0.0000002697, d = 0.1000007361 },
]

[[pose]]
matrix = [[-0.776832129004, -0.125333327847, -0.617108904714, -0.308696230834], [0.354482413651, 0.722928945972, -0.593056453879, 0.057579093148], [0.520455629001, -0.679459561715, -0.517165971653, -0.152592450013], [0.0, 0.0, 0.0, 1.0]]
"#;

#[test]
fn real_zeros_prove_that_no_real_solution_is_missing() {
    let arm = file("certificates/as_built.toml", AS_BUILT);
    let path = file("certificates/as_built", "");
    let solved = run(&["solve", &arm, "-q", "--certificate", &path]);
    assert!(solved.code == 0 && solved.err.is_empty(), "{}", solved.err);
    assert_eq!(kind(&path), "real-zeros");
    let checked = run(&["verify", &path, "--file", &arm]);
    assert!(checked.code == 0 && checked.out.contains("holds: 8 real solutions"), "{}", checked.out);
    let true_one = json(&fs::read_to_string(&path).unwrap());
    let forged = |change: &dyn Fn(&mut serde_json::Value), says: &str| {
        let mut forged = true_one.clone();
        change(&mut forged);
        let checked = run(&["verify", &file("certificates/forged_real", forged.to_string())]);
        assert!(checked.code == 2 && checked.out.contains(says), "{says}: {}", checked.out);
    };
    let with = |modes: usize| {
        move |own: &mut serde_json::Value| {
            own["modes"].as_array_mut().unwrap().truncate(modes);
            own["claim"]["real"] = json!(modes);
            own["proof"][0]["value"] = json!(modes);
        }
    };
    forged(&with(7), "the bound is 8");
    forged(&with(0), "the bound is 8");
    forged(&|own| own["modes"][7] = own["modes"][0].clone(), "the same solution");
    forged(&|own| own["modes"][0]["radius"] = json!("1e-40"), "mode 1");
    forged(&|own| own["claim"]["complex"] = json!(16), "claim");
    forged(&|own| own["claim"]["status"] = json!("unreachable"), "claim");
    forged(&|own| own["proof"][0]["aid"]["hidden"] = json!(3), "real-zeros");
    forged(&|own| own["proof"] = json!([{ "kind": "general-bound", "value": 16 }]), "proof");
    forged(&|own| own["data"]["mechanism"]["joints"][0]["d"] = json!("0.0900010001"), "mode 1");
}

#[test]
fn a_loop_without_solutions_names_one_of_the_longer_loop() {
    let path = certified("solve", "overconstrained/dietmaier_broken");
    let true_one = fs::read_to_string(&path).unwrap().lines().next().map(json).unwrap();
    assert_eq!(true_one["proof"][0]["kind"], json!("own-eliminant"));
    assert_eq!(true_one["modes"].as_array().unwrap().len(), 1);
    for (pointer, value, says) in [
        ("/modes", json!([]), "0 modes"),
        ("/modes/0/centre/0", json!("0.5"), "mode 1"),
        ("/data/mechanism/joints/1/a", json!("3.25"), "mode 1"),
        ("/proof/0/value", json!(1), "proof"),
    ] {
        let mut forged = true_one.clone();
        *forged.pointer_mut(pointer).unwrap() = value;
        let checked = run(&["verify", &file("certificates/forged_none", forged.to_string())]);
        assert!(checked.code == 2 && checked.out.contains(says), "{pointer}: {}", checked.out);
    }
}

#[test]
fn a_loop_that_does_not_move_names_a_solution_of_the_longer_loop() {
    let path = certified("mobility", "overconstrained/bennett_broken");
    let true_one = json(&fs::read_to_string(&path).unwrap());
    for (pointer, value, says) in [
        ("/modes", json!([]), "modes"),
        ("/modes/0/centre/0", json!("0.5"), "mode 1"),
        ("/data/mechanism/joints/1/d", json!("0.001"), "mode 1"),
    ] {
        let mut forged = true_one.clone();
        *forged.pointer_mut(pointer).unwrap() = value;
        let checked = run(&["verify", &file("certificates/forged_rest", forged.to_string())]);
        assert!(checked.code == 2 && checked.out.contains(says), "{pointer}: {}", checked.out);
    }
}

#[test]
fn the_roots_of_a_closure_polynomial_are_certified() {
    let path = certified("derive", "chain/ik_general");
    let checked = run(&["verify", &path, "--file", "chain/ik_general"]);
    assert!(checked.code == 0 && checked.out.contains("at the roots of the polynomial"), "{}", checked.out);
    let true_one = json(&fs::read_to_string(&path).unwrap());
    for (pointer, value, says) in [
        ("/claim/polynomial/3", json!("7"), "membership"),
        ("/claim/degree", json!(15), "claim"),
        ("/claim/unknown", json!(2), "membership"),
        ("/claim/complex", json!(15), "claim"),
        ("/proof", json!([{ "kind": "general-bound", "value": 16 }]), "proof"),
        ("/proof/1/aid/first", json!(7), "membership"),
        ("/modes/0/centre/0", json!("0.1"), "mode 1"),
    ] {
        let mut forged = true_one.clone();
        *forged.pointer_mut(pointer).unwrap() = value;
        let checked = run(&["verify", &file("certificates/forged_polynomial", forged.to_string())]);
        assert!(checked.code == 2 && checked.out.contains(says), "{pointer}: {}", checked.out);
    }
    let said = run(&["derive", "platform/affine", "-q", "--certificate", &file("certificates/none_polynomial", "")]);
    assert!(said.err.contains("no certificate"), "{}", said.err);
}

#[test]
fn the_assemblies_of_linkages_are_certified() {
    for (entry, says) in [
        ("linkage/four_bar_coupler", "2 solutions, 2 of them real"),
        ("linkage/3rpr", "6 solutions, 4 of them real"),
        ("linkage/crank_slider", "2 solutions, 2 of them real"),
    ] {
        let path = certified("solve", entry);
        assert_eq!(kind(&path), "kernel", "{entry}");
        let checked = run(&["verify", &path, "--file", entry]);
        assert!(checked.code == 0 && checked.out.contains(says), "{entry}: {}", checked.out);
        let other = run(&["verify", &path, "--file", "linkage/watt_1"]);
        assert!(other.code == 2 && other.out.contains("file"), "{entry}: {}", other.out);
        let mut forged = json(&fs::read_to_string(&path).unwrap());
        let left = forged["modes"].as_array_mut().map(|modes| modes.pop().map(|_| modes.len())).unwrap().unwrap();
        forged["claim"]["complex"] = json!(left);
        forged["proof"][0]["value"] = json!(left);
        let checked = run(&["verify", &file("certificates/forged_linkage", forged.to_string())]);
        assert!(checked.code == 2 && checked.out.contains("kernel"), "{entry}: {}", checked.out);
    }
    for entry in ["linkage/spherical_four_bar", "linkage/delta"] {
        let said = run(&["solve", entry, "-q", "--certificate", &file("certificates/none_linkage", "")]);
        assert!(said.err.contains("no certificate") && said.err.contains("not covered"), "{entry}: {}", said.err);
    }
}
