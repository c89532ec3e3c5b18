//! Laws of gearing: Camus' theorem, pin gears, involute gears on skew axes.
#![allow(clippy::unwrap_used)]

use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

fn run(arguments: &[&str]) -> String {
    let output =
        Command::new(env!("CARGO_BIN_EXE_looproot")).args(arguments).current_dir(crate::ROOT).output().unwrap();
    String::from_utf8(output.stdout).unwrap()
}

/// The terms of a polynomial: coefficients, and exponents of x and y.
fn terms(polynomial: &str) -> Vec<(f64, u32, u32)> {
    let signed = polynomial.trim().replace(" - ", " + -");
    let term = |text: &str| {
        let (mut coefficient, mut x, mut y) = (1.0, 0, 0);
        let text = text.trim();
        let positive = text.trim_start_matches('-');
        if positive.len() < text.len() {
            coefficient = -1.0;
        }
        for factor in positive.split('*') {
            let (base, exponent) = factor.split_once('^').unwrap_or((factor, "1"));
            match base {
                "x" => x += exponent.parse::<u32>().unwrap(),
                "y" => y += exponent.parse::<u32>().unwrap(),
                number => coefficient *= number.parse::<f64>().unwrap(),
            }
        }
        (coefficient, x, y)
    };
    signed.split(" + ").map(term).collect()
}

/// The last line of an envelope.
fn envelope(family: &str) -> Vec<(f64, u32, u32)> {
    let out = run(&["poly", "envelope", "--parameter", "t", family]);
    terms(out.lines().last().unwrap())
}

/// A point of a circle that rolls on both centrodes draws conjugate flanks. In a centrode of twice the radius of the circle its flank is a
/// diameter; the envelope of that diameter in the other wheel is the epicycloid that the same circle draws there.
#[test]
fn one_circle_draws_flanks_that_mesh() {
    let found = envelope("y*(1-3*t^2)-x*(3*t-t^3)+3*t*(1+t^2)");
    let trochoid: Value = serde_json::from_str(&run(&["solve", "gearing/cardioid", "--json"])).unwrap();
    let drawn = terms(trochoid["results"][0]["modes"][0]["polynomial"].as_str().unwrap());
    let set = |list: &[(f64, u32, u32)]| -> BTreeSet<String> { list.iter().map(|term| format!("{term:?}")).collect() };
    assert_eq!(set(&found), set(&drawn));
}

/// The flank that meshes with pins of radius 1/2 has this distance from the path of their centres, a cardioid.
#[test]
fn flanks_of_pin_gears_are_offsets_of_a_trochoid() {
    let found = envelope(
        "(x^2+y^2+5-1/4)*(1+t^2)^2-2*x*(2*(1-t^2)*(1+t^2)-((1-t^2)^2-4*t^2))-2*y*(4*t*(1+t^2)-4*t*(1-t^2))-4*(1-t^2)*(1+t^2)",
    );
    for step in 1..40 {
        let a = f64::from(step) * 0.157;
        let centre = [2.0 * a.cos() - (2.0 * a).cos(), 2.0 * a.sin() - (2.0 * a).sin()];
        let along = [-2.0 * a.sin() + 2.0 * (2.0 * a).sin(), 2.0 * a.cos() - 2.0 * (2.0 * a).cos()];
        let length = along[0].hypot(along[1]);
        for side in [0.5, -0.5] {
            let (x, y) = (centre[0] - side * along[1] / length, centre[1] + side * along[0] / length);
            let values = found.iter().map(|(c, i, j)| c * x.powf(f64::from(*i)) * y.powf(f64::from(*j)));
            let (sum, size) = values.fold((0.0, 0.0), |(sum, size), v| (sum + v, f64::max(size, v.abs())));
            assert!(sum.abs() < 1e-11 * size, "{a}: {sum} of {size}");
        }
    }
}

/// The normal of both flanks at the pitch point touches both base cylinders, and both gears have one base pitch along it.
#[test]
fn the_line_of_action_of_skew_gears_touches_both_base_cylinders() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("gearing");
    fs::create_dir_all(&folder).unwrap();
    for (number, (helix, teeth)) in
        [([30.0_f64, 15.0_f64], [20, 30]), ([45.0, 45.0], [12, 25]), ([10.0, -35.0], [17, 40])].into_iter().enumerate()
    {
        let path = folder.join(format!("{number}.toml"));
        let text = format!(
            "[mechanism]\nkind = \"gearing\"\nfind = \"crossed\"\nmodule = 2\npressure_angle = \"20 deg\"\n\
             helix = [\"{} deg\", \"{} deg\"]\nteeth = [{}, {}]\n",
            helix[0], helix[1], teeth[0], teeth[1]
        );
        fs::write(&path, text).unwrap();
        let found: Value = serde_json::from_str(&run(&["solve", path.to_str().unwrap(), "--json"])).unwrap();
        let mode = &found["results"][0]["modes"][0];
        let value = |key: &str, k: usize| mode[key][k].as_f64().unwrap();
        let [x, y, z] = [0, 1, 2].map(|k| value("line_of_action", k));
        let pitch = mode["base_pitch"].as_f64().unwrap();
        for k in 0..2 {
            // The axis of a gear is the tooth, along z, turned by the helix about the common perpendicular, along x.
            let (sin, cos) = helix[k].to_radians().sin_cos();
            let normal = [y * cos - z * sin, -x * cos, x * sin];
            let distance = value("reference_radii", k) * normal[0] / normal.iter().map(|c| c * c).sum::<f64>().sqrt();
            let base = value("base_radii", k);
            assert!((distance - base).abs() < 1e-13 * base, "{helix:?}: {distance} {base}");
            let own = std::f64::consts::TAU * base * value("base_helix_angles", k).cos() / f64::from(teeth[k]);
            assert!((own - pitch).abs() < 1e-13 * pitch, "{helix:?}: {own} {pitch}");
        }
    }
}
