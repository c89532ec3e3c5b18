//! The verbs `instant` and `dynamics` on the library: figures that were found by hand or with 60 digits.
#![allow(clippy::unwrap_used)]

use serde_json::Value;
use std::process::{Command, Stdio};

fn run(arguments: &[&str], code: i32) -> Value {
    let output = Command::new(env!("CARGO_BIN_EXE_looproot"))
        .args(arguments)
        .arg("--json")
        .current_dir(crate::ROOT)
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let fault = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{fault}");
    serde_json::from_slice(&output.stdout).unwrap_or(Value::String(fault))
}

fn near(value: &Value, expected: f64) {
    let found = value.as_f64().unwrap();
    assert!((found - expected).abs() < 1e-9 * expected.abs().max(1.0), "{found} is not {expected}");
}

/// The four-bar of the case, in the assembly whose coupler stands higher, against figures of 20 digits.
#[test]
fn the_coupler_moves_as_differentiation_says() {
    let document = run(&["instant", "linkage/weighted_four_bar", "--body", "coupler"], 0);
    let modes = document["results"][0]["modes"].as_array().unwrap();
    let mode = modes.iter().find(|mode| mode["bodies"]["coupler"]["angle"].as_f64().unwrap() > 0.0).unwrap();
    let instant = &mode["instant"];
    let pairs = [
        ("pole", [5.286_872_718_720_292, 7.049_163_624_960_39]),
        ("inflection_pole", [-32.331_224_156_675_31, -2.249_027_401_625_795_6]),
        ("a3", [263.028_384_115_206_1, 115.828_665_464_164_55]),
        ("ball", [2.606_321_256_731_716, 13.136_267_510_333_587]),
    ];
    for (key, [x, y]) in pairs {
        near(&instant[key][0], x);
        near(&instant[key][1], y);
    }
    near(&instant["inflection_diameter"], 38.750_194_436_848_13);
    // The pivots lie on the cubic of stationary curvature, and the pivots of the frame are their centres.
    for (point, x) in [("B", 0.0), ("C", 6.0)] {
        assert_eq!(instant["points"][point]["stationary"], 0.0);
        near(&instant["points"][point]["centre"][0], x);
    }
}

#[test]
fn poles_of_three_bodies_lie_in_a_line() {
    let document = run(&["instant", "linkage/coupler_instant", "--body", "coupler"], 0);
    for mode in document["results"][0]["modes"].as_array().unwrap() {
        let poles = &mode["instant"]["poles"];
        let pole = |name: &str| [0, 1].map(|k| poles[name][k].as_f64().unwrap());
        for triple in [
            ["frame crank", "crank coupler", "frame coupler"],
            ["frame rocker", "coupler rocker", "frame coupler"],
            ["frame crank", "crank rocker", "frame rocker"],
            ["crank coupler", "coupler rocker", "crank rocker"],
        ] {
            let [[ax, ay], [bx, by], [cx, cy]] = triple.map(pole);
            assert!(((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)).abs() < 1e-9, "{triple:?}");
        }
    }
}

#[test]
fn the_inverse_motion_has_the_same_pole_and_the_opposite_inflection_circle() {
    let of = |more: &[&str]| {
        let own = [&["instant", "linkage/involute_flanks", "--body", "wheel", "--against", "pinion"], more].concat();
        run(&own, 0)["results"][0]["modes"][0]["instant"].clone()
    };
    let (motion, inverse) = (of(&[]), of(&["--inverse"]));
    near(&inverse["rate"], -motion["rate"].as_f64().unwrap());
    near(&inverse["inflection_diameter"], motion["inflection_diameter"].as_f64().unwrap());
}

#[test]
fn reduced_inertia_and_accelerations_are_those_of_sixty_digits() {
    let document = run(&["dynamics", "linkage/weighted_four_bar", "--rate", "2"], 0);
    let mode = &document["results"][0]["modes"][1]["dynamics"];
    near(&mode["reduced_inertia"], 5.407_113_165_271_28);
    near(&mode["reduced_inertia_derivative"], 7.074_210_225_42);
    near(&mode["potential_derivative"], 17.463_634_063_700_9);
    near(&mode["acceleration"], -5.846_383_004_81);
}

#[test]
fn forces_in_a_double_pendulum_are_those_of_newton() {
    let document = run(&["dynamics", "linkage/double_pendulum", "--rate", "1, 2", "--forces"], 0);
    let mode = &document["results"][0]["modes"][0]["dynamics"];
    for (joint, [x, y]) in [("A", [-2.0, 0.0]), ("B", [0.0, -6.0])] {
        near(&mode["joints"][joint]["force"][0], x);
        near(&mode["joints"][joint]["force"][1], y);
    }
    for (k, acceleration) in [-7.0, 6.0].into_iter().enumerate() {
        near(&mode["acceleration"][k], acceleration);
    }
}

#[test]
fn velocities_in_a_tree_are_the_same_by_paths_and_by_recursion() {
    let document = run(&["dynamics", "linkage/branched_tree", "--rate", "1, 2, 3"], 0);
    let tree = &document["results"][0]["modes"][0]["dynamics"]["tree"];
    for body in ["arm", "fork", "slider"] {
        let (path, step) = (&tree["explicit"][body], &tree["recursive"][body]);
        near(&path["rate"], step["rate"].as_f64().unwrap());
        for k in 0..2 {
            near(&path["velocity"][k], step["velocity"][k].as_f64().unwrap());
        }
    }
}

#[test]
fn a_motion_keeps_its_energy() {
    for (name, time) in [("linkage/double_pendulum", "1"), ("linkage/weighted_four_bar", "1")] {
        let document = run(&["dynamics", name, "--time", time, "--steps", "20"], 2);
        let motion = &document["results"][0]["motion"];
        assert_eq!(motion["rows"].as_array().unwrap().len(), 21);
        let drift = motion["energy_drift"].as_f64().unwrap();
        assert!(drift < 1e-6, "{name}: {drift}");
    }
}

/// A Bennett loop whose input stands at tan(q1/2) = 1/2: tan(q1/2) tan(q2/2) = -5 gives q2' = 25/101 by hand.
#[test]
fn links_of_loops_have_the_velocity_screws_of_differentiation() {
    let document = run(&["instant", "bennett_a", "--input", "1", "--body", "2"], 0);
    let instant = &document["results"][0]["modes"][0]["instant"];
    let rate = 25.0 / 101.0;
    for (k, expected) in [0.64 * rate, -0.48 * rate, 1.0 + 0.6 * rate].into_iter().enumerate() {
        near(&instant["angular_velocity"][k], expected);
    }
    // The first link turns about the first axis, and the last one is at rest.
    let first = run(&["instant", "bennett_a", "--input", "1", "--body", "1"], 0);
    assert_eq!(first["results"][0]["modes"][0]["instant"]["screw"]["direction"][2], 1.0);
    let last = run(&["instant", "bennett_a", "--input", "1", "--body", "4"], 0);
    assert_eq!(last["results"][0]["modes"][0]["instant"]["screw"], Value::Null);
    // Axodes touch in one line: the inverse motion has the same ones.
    let inverse = run(&["instant", "bennett_a", "--input", "1", "--body", "2", "--inverse"], 0);
    let inverse = &inverse["results"][0]["modes"][0]["instant"];
    near(&inverse["axodes"]["distribution"], instant["axodes"]["distribution"].as_f64().unwrap());
    for k in 0..3 {
        near(&inverse["axodes"]["striction"][k], instant["axodes"]["striction"][k].as_f64().unwrap());
    }
}

/// Rates of an arm of two cylindrical joints about (0, 0, 1) and (0, 3/5, 4/5).
/// The drive and the forces of the joints against figures by hand: C moves by (-1, -3/4) for a unit rate of the crank, and the rod on
/// which nothing acts between its joints pulls along (3, 4).
#[test]
fn loads_are_held_by_virtual_power() {
    let loads = ["instant", "linkage/coupler_instant", "--loads", "coupler.C: 0, -10; rocker: 5"];
    let document = run(&loads, 0);
    let modes = document["results"][0]["modes"].as_array().unwrap();
    let mode = modes.iter().find(|mode| mode["balance"]["holding"].as_f64().unwrap() < 0.0).unwrap();
    assert!(mode.get("instant").is_none());
    near(&mode["balance"]["holding"], -8.75);
    for (joint, [x, y]) in [("A", [4.375, 35.0 / 6.0]), ("B", [4.375, 35.0 / 6.0]), ("C", [4.375, -25.0 / 6.0])] {
        near(&mode["balance"]["joints"][joint]["force"][0], x);
        near(&mode["balance"]["joints"][joint]["force"][1], y);
    }
    // Weights as loads need the drive that masses and gravity need.
    let own = ["crank: -9.81; coupler.B: 0, -14.715; coupler.C: 0, -14.715; rocker: -9.81"];
    let level = run(&["instant", "linkage/level_four_bar", "--loads", own[0], "--body", "coupler"], 0);
    let dynamics = run(&["dynamics", "linkage/level_four_bar"], 0);
    for (mode, other) in [0, 1].map(|k| (&level["results"][0]["modes"][k], &dynamics["results"][0]["modes"][k])) {
        assert!(mode["instant"]["points"]["B"].is_object());
        // The crank and the rocker stand at 2 atan(1/2): their weights have arms of 3/10.
        if mode["bodies"]["coupler"]["angle"].as_f64().unwrap().abs() < 1e-9 {
            near(&mode["balance"]["holding"], 9.81 * 2.0 + 14.715 * 2.0 * 0.6);
            near(&other["dynamics"]["holding"], 9.81 * 2.0 * 0.6 + 14.715 * 2.0 * 0.6);
        }
    }
    // A unit moment on the last shaft needs the ratio of the shafts.
    let shafts = run(&["instant", "linkage/hooke_series", "--loads", "out: 36/85, 77/85, 0"], 1);
    assert!(shafts.as_str().unwrap().contains("3 numbers"));
    let axis = format!("out: {}, {}, 0", 36.0 / 85.0, 77.0 / 85.0);
    let shafts = run(&["instant", "linkage/hooke_series", "--loads", &axis, "--body", "out"], 0);
    for mode in shafts["results"][0]["modes"].as_array().unwrap() {
        near(&mode["balance"]["holding"], -mode["instant"]["joint_rates"]["S2"][0].as_f64().unwrap());
    }
    let rods = run(&["instant", "linkage/rssr_ssr", "--loads", "rocker2.F: 1, 2, 3", "--body", "rocker2"], 0);
    for mode in rods["results"][0]["modes"].as_array().unwrap() {
        let velocity = |k: usize| mode["instant"]["points"]["F"]["velocity"][k].as_f64().unwrap();
        near(&mode["balance"]["holding"], -(velocity(0) + 2.0 * velocity(1) + 3.0 * velocity(2)));
    }
}

/// The ratio is stationary where the slope of the closure equation says so, found by another program with 30 digits.
#[test]
fn ratios_have_their_extremes() {
    let sweep = ["sweep", "linkage/coupler_instant", "--from", "0", "--to", "360 deg", "--steps", "90", "--ratio", "D"];
    let document = run(&sweep, 0);
    for branch in document["ratio"]["branches"].as_array().unwrap() {
        let value = |key: &str| branch[key]["ratio"].as_f64().unwrap();
        assert!((value("least") - LEAST).abs() < 1e-6 && (value("greatest") - GREATEST).abs() < 1e-6, "{branch}");
        assert_eq!(branch["constant"], false);
    }
    // Both shafts of a double Hooke joint turn alike, and those of the plane-symmetric RRSRR loop on two branches.
    let shafts =
        run(&["sweep", "linkage/double_hooke", "--from", "0", "--to", "90 deg", "--steps", "2", "--ratio", "S2"], 0);
    for branch in shafts["ratio"]["branches"].as_array().unwrap() {
        assert_eq!(branch["constant"], true);
        near(&branch["least"]["ratio"], 1.0);
    }
    for row in rows(&shafts) {
        near(&row["ratio"], 1.0);
    }
    let loops =
        run(&["sweep", "homokinetic_rrsrr", "--from", "-90 deg", "--to", "90 deg", "--steps", "4", "--ratio", "q5"], 0);
    assert!(loops["ratio"]["branches"].as_array().unwrap().iter().any(|branch| branch["constant"] == true));
    let wrong = run(&["sweep", "linkage/coupler_instant", "--from", "0", "--to", "1", "--ratio", "X"], 1);
    assert!(wrong.as_str().unwrap().contains("expected one of A, D, B, C"));
}

/// The least and the greatest ratio of the rocker of that four-bar.
const LEAST: f64 = -0.502_642_58;
const GREATEST: f64 = 0.403_403_32;

#[test]
fn cognates_have_the_polynomial_of_the_four_bar() {
    let document = run(&["derive", "linkage/coupler_curve", "--trace", "coupler.P", "--cognates"], 0);
    let list = document["cognates"].as_array().unwrap();
    assert_eq!(list.len(), 2);
    for own in list {
        assert_eq!(own["same_polynomial"], true);
        assert!(own["file"].as_str().unwrap().contains("\"12/5\", \"18/5\""));
    }
    for (name, point) in
        [("linkage/coupler_curve", "coupler.B"), ("linkage/slider_crank_piston", "coupler.P"), ("puma560", "tool")]
    {
        run(&["derive", name, "--trace", point, "--cognates"], 1);
    }
}

/// The strip of Chebyshev's line between its middle and the place at which a crank is upright, and that of Watt's, each found by another program.
#[test]
fn curves_say_how_straight_they_are() {
    let of = |name: &str, from: &str, to: &str| {
        let document = run(&["sweep", name, "--from", from, "--to", to, "--trace", "coupler.P"], 0);
        let least = document["straight"]
            .as_array()
            .unwrap()
            .iter()
            .map(|own| (own["deviation"].as_f64().unwrap(), own["length"].as_f64().unwrap()));
        least.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap()
    };
    let (deviation, length) = of("linkage/chebyshev_line", "53.13010235 deg", "90 deg");
    assert!((deviation - 0.004_876_845).abs() < 1e-7 && (length - 2.0).abs() < 1e-6, "{deviation} {length}");
    let (deviation, length) = of("linkage/watt_line", "-20 deg", "20 deg");
    assert!((deviation - 0.002_022_546).abs() < 1e-8 && (length - 1.370_855).abs() < 1e-5, "{deviation} {length}");
}

/// Helical gears on skew axes: the way to the tips along the line of action and the points at which it touches the base cylinders,
/// found from the distances of its points from the axes.
#[test]
fn gears_on_skew_axes_touch_along_one_line() {
    let document = run(&["solve", "gearing/crossed_pair"], 0);
    let mode = &document["results"][0]["modes"][0];
    near(&mode["contact_ratio"], 1.670_256_510_912_717_6);
    near(&mode["shaft_angle"], std::f64::consts::FRAC_PI_4);
    for (k, (base, curvature)) in
        [(0.021_290_161_443_652_6, 0.010_136_250_476_120_9), (0.029_063_450_267_969_17, 0.011_290_400_806_175_6)]
            .into_iter()
            .enumerate()
    {
        near(&mode["base_radii"][k], base);
        near(&mode["flank_curvature_radii"][k], curvature);
    }
}

#[test]
fn links_of_arms_move_with_the_rates_of_their_joints() {
    let document = run(&["instant", "arm/chain_cc", "--body", "tool", "--rate", "1, 2, 1, 3"], 0);
    let instant = &document["results"][0]["modes"][0]["instant"];
    for (k, expected) in [0.0, 0.6, 1.8].into_iter().enumerate() {
        near(&instant["angular_velocity"][k], expected);
    }
    // (0, 0, 2) + 3 (0, 3/5, 4/5) + (3, 0, 0) x (0, 3/5, 4/5)
    for (k, expected) in [0.0, 1.8 - 2.4, 4.4 + 1.8].into_iter().enumerate() {
        near(&instant["velocity"][k], expected);
    }
}

/// The tangent of the second shaft is that of the first divided by 15/17.
#[test]
fn the_cross_of_a_hooke_joint_rolls_on_cones() {
    let document = run(&["instant", "linkage/hooke_series", "--body", "cross1"], 0);
    for mode in document["results"][0]["modes"].as_array().unwrap() {
        let instant = &mode["instant"];
        near(&instant["joint_rates"]["S1"][0], 17.0 / 15.0 * (1.0 + 16.0 / 9.0) / (1.0 + (68.0_f64 / 45.0).powi(2)));
        assert_eq!(instant["axodes"]["striction"], serde_json::json!([0.0, 0.0, 0.0]));
        assert_eq!(instant["axodes"]["distribution"], 0.0);
        // The cross turns at unit rate about the first shaft, and about an axis across it.
        near(&instant["angular_velocity"][0], 1.0);
    }
}

/// All rows of the branches of a sweep.
fn rows(document: &Value) -> Vec<&Value> {
    let branches = document["branches"].as_array().unwrap();
    branches.iter().flat_map(|branch| branch["rows"].as_array().unwrap()).collect()
}

#[test]
fn sweeps_have_the_poles_and_axes_of_single_instants() {
    let range = ["--from", "90 deg", "--to", "100 deg", "--steps", "1"];
    let of = |name: &str, more: [&str; 2], code: i32| run(&[&["sweep", name][..], &range, &more].concat(), code);
    let plane = of("linkage/coupler_instant", ["--centrodes", "coupler"], 0);
    let first: Vec<&Value> = rows(&plane).into_iter().filter(|row| row["step"] == 0).collect();
    assert_eq!(first.len(), 2);
    let upper = first.iter().find(|row| row["centrodes"]["coupler"]["fixed"][1].as_f64().unwrap() > 0.0).unwrap();
    for (k, expected) in [6.4, 4.8].into_iter().enumerate() {
        near(&upper["centrodes"]["coupler"]["moving"][k], expected);
    }
    // The cross turns at unit rate about the first shaft: its axis is not across it.
    let sphere = of("linkage/hooke_series", ["--axodes", "cross1"], 0);
    for row in rows(&sphere) {
        assert!(row["axodes"]["cross1"]["fixed"]["direction"][0].as_f64().unwrap() > 0.1);
    }
    let bennett = run(&["sweep", "bennett_a", "--from", "0 deg", "--to", "90 deg", "--steps", "2", "--axodes", "2"], 0);
    let last = rows(&bennett).into_iter().find(|row| row["step"] == 2).unwrap();
    let single = run(&["instant", "bennett_a", "--input", "1=90 deg", "--body", "2"], 0);
    let screw = &single["results"][0]["modes"][0]["instant"]["screw"];
    near(&last["axodes"]["link 2"]["pitch"], screw["pitch"].as_f64().unwrap());
    for k in 0..3 {
        near(&last["axodes"]["link 2"]["fixed"]["direction"][k], screw["direction"][k].as_f64().unwrap());
        near(&last["axodes"]["link 2"]["fixed"]["point"][k], screw["point"][k].as_f64().unwrap());
    }
}

#[test]
fn four_bars_of_dyads_are_sorted_by_circuit_and_order() {
    let document = run(&["synthesize", "burmester5_in_order", "--no-defects"], 0);
    let list = document["results"][0]["linkages"].as_array().unwrap();
    // Another program walked along the circuits of all twelve: the positions of these come in order.
    let dyads: Vec<Value> = list.iter().map(|own| own["dyads"].clone()).collect();
    let pairs = [[1, 3], [1, 4], [3, 1], [3, 4], [4, 1], [4, 3]];
    assert_eq!(dyads, pairs.map(|pair| serde_json::json!(pair)));
    let free: Vec<&Value> = list.iter().filter(|own| own["without_limit"] == true).map(|own| &own["class"]).collect();
    assert_eq!(free, ["double-crank", "double-crank"]);
    // The same positions in another order.
    let other = run(&["synthesize", "burmester5_4real_a", "--no-defects"], 0);
    assert!(other["results"][0]["linkages"].as_array().unwrap().is_empty());
}

#[test]
fn limits_and_wrong_words_are_answers() {
    let message = |arguments: &[&str]| run(arguments, 1).as_str().unwrap().to_owned();
    assert!(message(&["instant", "linkage/coupler_instant", "--body", "nobody"]).contains("unknown body"));
    let point = ["instant", "linkage/coupler_instant", "--body", "coupler", "--point", "crank.A"];
    assert!(message(&point).contains("coupler.B"));
    assert!(message(&["instant", "bennett_a", "--body", "5"]).contains("1 to 4"));
    assert!(message(&["instant", "bennett_a", "--body", "2", "--rate", "1"]).contains("unit rate"));
    assert!(message(&["instant", "puma560", "--body", "2"]).contains("--rate"));
    assert!(message(&["instant", "puma560", "--body", "2", "--rate", "1, 2"]).contains("6 numbers"));
    assert!(message(&["instant", "linkage/hooke_series", "--body", "nobody"]).contains("unknown body"));
    assert!(message(&["instant", "linkage/hooke_series", "--body", "in", "--point", "in.X"]).contains("in.F1"));
    assert!(message(&["instant", "bennett_a", "--body", "2", "--point", "a.b"]).contains("linkage"));
    for wrong in ["coupler.P: 1, 2", "rocker 5", "rocker: 5, 6", "coupler.C: 1, x"] {
        assert!(message(&["instant", "linkage/coupler_instant", "--loads", wrong]).contains("expected"), "{wrong}");
    }
    assert!(message(&["instant", "bennett_a", "--loads", "2: 1, 2, 3", "--body", "2"]).contains("linkage"));
    assert!(message(&["dynamics", "linkage/coupler_instant"]).contains("mass"));
    assert!(message(&["dynamics", "linkage/weighted_four_bar", "--rate", "x"]).contains("--rate"));
}

/// Assemblies at three angles of the input, by `solve`: differences stand for derivatives.
#[test]
fn linkages_in_space_move_as_their_assemblies_do() {
    // The second of these steps is the rate by central differences with an error of the square of the step.
    let step = 1e-3_f64;
    for (name, joint, at, body) in
        [("linkage/rssr_ssr", "A", -1.57_f64, "rocker2"), ("linkage/ball_in_track", "S0", 0.6, "far")]
    {
        let places = |angle: f64| -> Vec<[f64; 3]> {
            let input = format!("{joint}={angle}");
            let document = run(&["instant", name, "--body", body, "--input", &input], 2);
            let modes = document["results"][0]["modes"].as_array().unwrap().clone();
            let point = |mode: &Value| {
                let points = mode["instant"]["points"].as_object().unwrap();
                let at = &points.values().next().unwrap()["position"];
                [0, 1, 2].map(|k| at[k].as_f64().unwrap())
            };
            modes.iter().map(point).collect()
        };
        let document = run(&["instant", name, "--body", body, "--input", &format!("{joint}={at}")], 2);
        let modes = document["results"][0]["modes"].as_array().unwrap();
        let [before, now, after] = [at - step, at, at + step].map(places);
        assert!(!modes.is_empty() && before.len() == modes.len() && after.len() == modes.len(), "{name}");
        for (m, mode) in modes.iter().enumerate() {
            let shown = mode["instant"]["points"].as_object().unwrap().values().next().unwrap();
            for k in 0..3 {
                let velocity = (after[m][k] - before[m][k]) / (2.0 * step);
                let acceleration = (after[m][k] - 2.0 * now[m][k] + before[m][k]) / (step * step);
                let [v, a] = ["velocity", "acceleration"].map(|key| shown[key][k].as_f64().unwrap());
                assert!((v - velocity).abs() < 1e-3 * (1.0 + v.abs()), "{name} mode {m}: {v} is not {velocity}");
                assert!(
                    (a - acceleration).abs() < 1e-3 * (1.0 + a.abs()),
                    "{name} mode {m}: {a} is not {acceleration}"
                );
            }
        }
    }
}

#[test]
fn a_plate_of_a_delta_robot_does_not_turn() {
    let document = run(&["instant", "linkage/delta", "--body", "plate", "--input", "1"], 0);
    for mode in document["results"][0]["modes"].as_array().unwrap() {
        let instant = &mode["instant"];
        assert_eq!(instant["screw"], Value::Null);
        assert_eq!(instant["joint_rates"]["A2"], serde_json::json!([0.0, 0.0]));
    }
}
