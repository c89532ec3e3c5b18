//! `looproot solve` where f64 proves the real solutions alone, and where it must not.
#![allow(clippy::unwrap_used)]

use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// Writes a file, solves it, and returns the exit code and the first result.
fn solved(name: &str, text: &str, options: &[&str]) -> (i32, Value) {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("real_list");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_looproot"))
        .args(["solve", path.to_str().unwrap(), "--json"])
        .args(options)
        .output()
        .unwrap();
    let document: Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)));
    (output.status.code().unwrap(), document["results"][0].clone())
}

/// A UR5 as it is built: its twists and lengths are off by up to 1e-6.
const AS_BUILT: &str = r#"
[mechanism]
kind = "arm"
convention = "dh"
joints = [
    { type = "R", a = 4.1e-7, alpha = "1.5707959 rad", d = 0.0891593 },
    { type = "R", a = -0.4250006, alpha = "-7.3e-7 rad", d = 2.1e-7 },
    { type = "R", a = -0.3922498, alpha = "5.9e-7 rad", d = -8.8e-7 },
    { type = "R", a = -3.7e-7, alpha = "1.5707967 rad", d = 0.1091502 },
    { type = "R", a = 6.6e-7, alpha = "-1.5707955 rad", d = 0.0946494 },
    { type = "R", a = 1.2e-7, alpha = "3.3e-7 rad", d = 0.0823007 },
]
"#;

/// The joint values of a mode.
fn joints(mode: &Value) -> Vec<f64> {
    mode["q"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

#[test]
fn arms_as_built_are_proved_in_f64() {
    let asked = ["--joints", "0.3, -1.1, 1.4, -0.7, 0.9, 0.2"];
    let (code, result) = solved("as_built.toml", AS_BUILT, &asked);
    assert_eq!(code, 0, "{}", result["verdict"]);
    let verdict = &result["verdict"];
    assert_eq!(verdict["code"], "real-zeros-matched");
    assert_eq!((&verdict["status"], &verdict["proof"]), (&"complete".into(), &"proved".into()));
    assert_eq!(verdict["complex"], Value::Null);
    let real = verdict["real"].as_u64().unwrap();
    // The same list with all complex solutions, in long numbers.
    let (_, all) = solved("as_built.toml", AS_BUILT, &[&asked[..], &["--complex"]].concat());
    assert_eq!(all["verdict"]["real"], real, "{}", all["verdict"]);
    let modes = all["modes"].as_array().unwrap();
    for mode in result["modes"].as_array().unwrap().iter().filter(|mode| mode["real"] == true) {
        let near = |other: &&Value| joints(other).iter().zip(joints(mode)).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(modes.iter().any(|other| near(&other)), "{mode}");
    }
    let (code, real_only) = solved("as_built.toml", AS_BUILT, &[&asked[..], &["--real"]].concat());
    assert_eq!((code, real_only["verdict"]["real"].as_u64().unwrap()), (0, real));
}

#[test]
fn poses_out_of_reach_by_less_than_the_tolerance_are_near() {
    // The arm of 0.9 m is stretched; the pose is 3e-10 m farther.
    let text = r#"
[mechanism]
kind = "arm"
convention = "dh"
joints = [
    { type = "R", a = 0, alpha = "90 deg", d = 0 },
    { type = "R", a = 0.43, alpha = 0, d = 0 },
    { type = "R", a = 0, alpha = "90 deg", d = 0 },
    { type = "R", a = 0, alpha = "-90 deg", d = 0.47 },
    { type = "R", a = 0, alpha = "90 deg", d = 0 },
    { type = "R", a = 0, alpha = 0, d = 0 },
]
"#;
    for option in ["--real", "--complex", "--quiet"] {
        let (_, result) =
            solved("stretched.toml", text, &["--at", "0.9000000003 m, 0, 0; 20 deg, 30 deg, 40 deg", option]);
        let verdict = &result["verdict"];
        let denies = verdict["status"] == "unreachable" && verdict["proof"] == "proved";
        assert!(!denies || option == "--complex" && verdict["near"] != 0, "{option}: {verdict}");
    }
}

#[test]
fn irrational_poses_are_solved_as_they_are() {
    // With three digits of output the pose is that of all digits.
    let asked = ["--at", "0.3 m, 0.2 m, 0.4 m; 30 deg, 45 deg, 60 deg"];
    for arm in ["arm/ur5", "arm/general_16real"] {
        let modes = |digits: &str| {
            let output = Command::new(env!("CARGO_BIN_EXE_looproot"))
                .args(["solve", arm, "--jsonl", "--digits", digits])
                .args(asked)
                .output()
                .unwrap();
            let text = String::from_utf8(output.stdout).unwrap();
            let line: Value = serde_json::from_str(text.lines().next().unwrap()).unwrap();
            line["modes"].as_array().unwrap().iter().map(joints).collect::<Vec<_>>()
        };
        let (few, all) = (modes("3"), modes("15"));
        assert_eq!(few.len(), all.len(), "{arm}");
        for (a, b) in few.iter().zip(&all) {
            assert!(a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-9), "{arm}: {a:?} {b:?}");
        }
    }
}

#[test]
fn dimensions_of_long_numbers_are_those_modulo_a_prime() {
    // Lengths from 1e-8 to 1e8: f64 measures a dimension of 2.
    let text = r#"
[mechanism]
kind = "arm"
convention = "dh"
joints = [
    { type = "R", a = 0, tan_half_alpha = -1, d = "-1/100000000" },
    { type = "R", a = 0, tan_half_alpha = 1, d = 0 },
    { type = "R", a = "-1/100000000", tan_half_alpha = "inf", d = 0 },
    { type = "R", a = 1, tan_half_alpha = 1, d = "-1/100000000" },
    { type = "R", a = 0, tan_half_alpha = "-1/2", d = 100000000 },
    { type = "R", a = 0, tan_half_alpha = "inf", d = 100000000 },
]

[[pose]]
matrix = [["4/5", 0, "-3/5", "16000000000000001/100000000"], [0, -1, 0, -1], ["-3/5", 0, "-4/5", 80000000], [0, 0, 0, 1]]
"#;
    let (code, result) = solved("scales.toml", text, &["--complex"]);
    let verdict = &result["verdict"];
    assert_eq!((code, verdict["self_motion"].as_u64()), (2, Some(1)), "{verdict}");
    assert!(verdict["proof"] == "probable" || verdict["proof"] == "proved", "{verdict}");
}
