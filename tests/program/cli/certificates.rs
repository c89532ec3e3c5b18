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
