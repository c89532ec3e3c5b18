//! `looproot solve` on questions `find = "navigation"`.
#![allow(clippy::unwrap_used)]

use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// Runs a file of kind displacement and returns the first result.
fn solved(name: &str, text: &str) -> Value {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("navigation");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_looproot"))
        .args(["solve", path.to_str().unwrap(), "--json"])
        .output()
        .unwrap();
    let document: Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)));
    document["results"][0].clone()
}

const HEAD: &str = "[mechanism]\nkind = \"displacement\"\nfind = \"navigation\"\ngravity = [0, 0, -9.81]\nvelocity = [1, 2, 3]\n\
                    position = [4, 5, 6]\nquaternion = [0.5, 0.5, 0.5, 0.5]\nsteps = 20\n";

fn interval(tan_half: &str, duration: &str) -> String {
    format!(
        "[[interval]]\naxis = [1, 2, 2]\ntan_half = \"{tan_half}\"\nduration = \"{duration}\"\nforce = [3, -1, 2]\n"
    )
}

fn vector(mode: &Value, key: &str) -> Vec<f64> {
    mode[key].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// Half an interval twice is the whole interval: tan(2a) = 2 tan a/(1 - tan^2 a) at twice the duration.
#[test]
fn two_halves_are_the_whole() {
    let whole = solved("whole.toml", &format!("{HEAD}{}", interval("3/4", "3")));
    let halves = solved("halves.toml", &format!("{HEAD}{0}{0}", interval("1/3", "3/2")));
    assert_eq!(whole["verdict"]["proof"], "proved");
    for key in ["quaternion", "velocity", "position"] {
        let (a, b) = (vector(&whole["modes"][0], key), vector(&halves["modes"][0], key));
        assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-14), "{key}: {a:?} {b:?}");
    }
}

/// A body that does not turn falls on a parabola.
#[test]
fn without_a_turn_the_path_is_a_parabola() {
    let found = solved("still.toml", &format!("{HEAD}{}", interval("0", "2")));
    // The quaternion takes x, y, z to y, z, x: the force is (2, 3, -1) in space.
    let mode = &found["modes"][0];
    let near = |key: &str, right: [f64; 3]| {
        let found = vector(mode, key);
        assert!(found.iter().zip(right).all(|(a, b)| (a - b).abs() < 1e-12), "{key}: {found:?}");
    };
    near("velocity", [1.0 + 4.0, 2.0 + 6.0, 3.0 - 2.0 - 19.62]);
    near("position", [4.0 + 2.0 + 4.0, 5.0 + 4.0 + 6.0, 6.0 + 6.0 - 2.0 - 19.62]);
}

/// Without a correction the norm of the parameters drifts; with it norm and orientation are right to the order of the steps.
#[test]
fn the_correction_keeps_the_norm() {
    let found = solved("drift.toml", &format!("{HEAD}{}", interval("2", "1")));
    let drift = &found["modes"][0]["drift"];
    let number = |key: &str| drift[key].as_f64().unwrap().abs();
    assert!(number("norm") > 1e-12 && number("corrected_norm") < 1e-14, "{drift}");
    assert!(number("corrected_error") < 1e-6 && number("error") < 1e-5, "{drift}");
}

/// A whole turn beside the angle is not lost.
#[test]
fn whole_turns_count() {
    let text = |angle: &str| {
        format!("{HEAD}[[interval]]\naxis = [0, 0, 1]\nangle = \"{angle}\"\nduration = 1\nforce = [1, 0, 0]\n")
    };
    let (slow, fast) = (solved("slow.toml", &text("90 deg")), solved("fast.toml", &text("450 deg")));
    let [slow, fast] = [&slow, &fast].map(|found| &found["modes"][0]);
    assert_eq!(slow["quaternion"], fast["quaternion"]);
    // The gain of velocity is the reciprocal of the angle times (sin, 1 - cos), in axes turned by the start.
    let gain = |mode: &Value| vector(mode, "velocity")[1] - 2.0;
    assert!((gain(slow) - 5.0 * gain(fast)).abs() < 1e-14);
}
