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
        let checked = run(&["verify", &file("certificates/forged", forged.to_string())]);
        assert!(checked.code == 2 && checked.out.contains("proof"), "{}", checked.out);
    }
}

#[test]
fn whether_a_loop_moves_is_certified() {
    for (entry, proof, says) in [
        ("overconstrained/bennett_a", "curve", "mobile, of dimension 1"),
        ("overconstrained/bennett_broken", "eliminant", "immobile"),
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
        let checked = run(&["verify", &file("certificates/forged", forged)]);
        assert!(checked.code == 2 && checked.out.contains("claim"), "{entry}: {}", checked.out);
    }
    let said = run(&["mobility", "framework/steffen", "--certificate", &file("certificates/none", "")]);
    assert!(said.code == 1 && said.err.lines().count() == 1, "{}", said.err);
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
position = [300000, 100000, 500000]
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
        let checked = run(&["verify", &file("certificates/forged", forged.to_string())]);
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
    let near = FAR.replace("300000, 100000, 500000", "0.3, 0.1, 0.5");
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
