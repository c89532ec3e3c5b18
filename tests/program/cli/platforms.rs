//! Platforms as built: limits, the nearest pose, paths, legs in bulk, a leg that runs.

use super::{file, json, run};
use serde_json::Value;

/// A hexapod in millimetres with limits that its home pose respects.
const HEXAPOD: &str = r#"
units = { length = "mm", angle = "deg" }
[mechanism]
kind = "platform"
base = [[492, 87, 0], [321, 383, 0], [-171, 470, 1], [-492, 87, 0], [-321, -383, 0], [171, -470, 2]]
plate = [[225, 268, 0], [120, 329, 0], [-345, 61, 0], [-345, -61, 3], [120, -329, 0], [225, -268, 0]]
limits = [500, 720]
base_cones = { axis = [0, 0, 1], angle = 50 }
plate_cones = { axis = [0, 0, -1], angle = "50 deg" }
[[pose]]
position = [0, 0, 550]
quaternion = [1, 0, 0, 0]
"#;

fn hexapod(name: &str) -> String {
    file(name, HEXAPOD)
}

/// Returns the real modes of the first result.
fn modes(document: &Value) -> &Vec<Value> {
    document["results"][0]["modes"].as_array().unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

/// The angle between two vectors, degrees.
fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
    (dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()).acos().to_degrees()
}

#[test]
fn poses_outside_the_limits_of_legs_and_joints_are_marked() {
    let path = hexapod("limits_hexapod.toml");
    let document = json(&run(&["solve", &path, "--json"]).out);
    let mechanism = &document["mechanism"];
    let points = |key: &str| -> Vec<[f64; 3]> {
        mechanism[key].as_array().unwrap().iter().map(|p| numbers(p).try_into().unwrap()).collect()
    };
    let (base, plate) = (points("base"), points("plate"));
    assert_eq!(numbers(&mechanism["limits"][3]), [0.5, 0.72]);
    let mut counts = [0, 0];
    for mode in modes(&document) {
        // The joints that lean too far, by a computation of its own.
        let [w, x, y, z]: [f64; 4] = numbers(&mode["quaternion"]).try_into().unwrap();
        let p = numbers(&mode["position"]);
        let r = [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
        ];
        let mut expected = Vec::new();
        let leg = |i: usize| -> [f64; 3] {
            std::array::from_fn(|k| p[k] + (0..3).map(|j| r[k][j] * plate[i][j]).sum::<f64>() - base[i][k])
        };
        let down =
            |i: usize| -> [f64; 3] { std::array::from_fn(|k| -(0..3).map(|j| r[j][k] * leg(i)[j]).sum::<f64>()) };
        expected
            .extend((0..6).filter(|i| angle(leg(*i), [0.0, 0.0, 1.0]) > 50.0).map(|i| format!("base joint {}", i + 1)));
        expected.extend(
            (0..6).filter(|i| angle(down(*i), [0.0, 0.0, -1.0]) > 50.0).map(|i| format!("plate joint {}", i + 1)),
        );
        let outside: Vec<&str> =
            mode["outside"].as_array().unwrap().iter().map(|part| part.as_str().unwrap()).collect();
        assert_eq!(outside, expected);
        assert_eq!(mode["within_limits"], outside.is_empty());
        counts[usize::from(outside.is_empty())] += 1;
    }
    assert!(counts[0] > 0 && counts[1] > 0, "{counts:?}");
    let dropped = json(&run(&["solve", &path, "--limits", "drop", "--json"]).out);
    assert_eq!(modes(&dropped).len(), counts[1]);
    let text = run(&["solve", &path]).out;
    assert!(text.contains("leg lengths 0.5..0.72 m; base joints within 50 deg of (0, 0, 1)"), "{text}");
    assert!(text.contains(&format!("within them: {} of {}", counts[1], counts[0] + counts[1])), "{text}");
    assert!(text.contains("outside") && text.contains("base joints 1, 2, plate joints 1, 2, 3, 4"), "{text}");
    assert!(run(&["show", &path]).out.contains("limits: leg lengths 0.5..0.72 m; base joints within 50 deg"));
}

#[test]
fn a_leg_that_is_too_long_excludes_every_pose() {
    let path = file(
        "limits_long.toml",
        HEXAPOD.replace("[500, 720]", "[[500, 720], [500, 720], [500, 600], [500, 720], [500, 720], [500, 720]]"),
    );
    let result = json(&run(&["solve", &path, "--json"]).out)["results"][0].clone();
    assert_eq!(result["outside"], serde_json::json!(["leg 3"]));
    assert!(result["warnings"].to_string().contains("leg 3 is outside the limits of length"), "{result}");
    assert!(result["modes"].as_array().unwrap().iter().all(|mode| mode["within_limits"] == false));
}

#[test]
fn limits_of_platforms_that_make_no_sense_are_named() {
    for (from, to, expected) in [
        ("limits = [500, 720]", "limits = [720, 500]", "found the limits [0.72, 0.5] of a leg in metres"),
        ("limits = [500, 720]", "limits = [-1, 500]", "expected 0 or more"),
        ("limits = [500, 720]", "limits = [[500, 720]]", "found 1 values in `limits`, expected 6"),
        ("limits = [500, 720]", "limits = [500]", "`limits`"),
        ("limits = [500, 720]", "limits = \"x\"", "`limits`"),
        ("axis = [0, 0, 1], angle = 50", "axis = [0, 0, 0], angle = 50", "found the axis 0 in `base_cones`"),
        ("axis = [0, 0, 1], angle = 50", "axis = [0, 0, 1], angle = 200", "expected 0 to 180 deg"),
        ("axis = [0, 0, 1], angle = 50", "axis = [0, 0, 1]", "`angle`"),
        ("base_cones = { axis = [0, 0, 1], angle = 50 }", "base_cones = 3", "`base_cones`"),
        ("base_cones", "base_cone", "base_cone"),
    ] {
        let path = file("limits_bad.toml", HEXAPOD.replace(from, to));
        let run = run(&["solve", &path]);
        assert!(
            run.code == 1 && run.err.contains(expected) && run.err.contains("limits_bad.toml:"),
            "{to}: {}",
            run.err
        );
    }
}

#[test]
fn the_nearest_pose_of_the_plate_comes_first() {
    let path = hexapod("near_hexapod.toml");
    let all = json(&run(&["solve", &path, "--json"]).out);
    for wanted in modes(&all) {
        let (q, p) = (numbers(&wanted["quaternion"]), numbers(&wanted["position"]));
        // The other quaternion of the same rotation, and a place not quite there.
        let near = format!("{} m, {} m, {} m; {}, {}, {}, {}", p[0] + 1e-3, p[1], p[2], -q[0], -q[1], -q[2], -q[3]);
        let found = json(&run(&["solve", &path, "--near", &near, "--json"]).out);
        assert_eq!(modes(&found)[0]["quaternion"], wanted["quaternion"], "{near}");
    }
    let wrong = run(&["solve", &path, "--near", "1, 2, 3"]);
    assert!(
        wrong.code == 1 && wrong.err.contains("found --near \"1, 2, 3\", expected \"x, y, z; w, x, y, z\""),
        "{}",
        wrong.err
    );
}

#[test]
fn the_legs_of_many_poses_are_listed_without_solving() {
    let path = hexapod("inverse_hexapod.toml");
    let poses = "x,y,z,qw,qx,qy,qz\n0,0,550,1,0,0,0\n40,0,560,0.995,0.1,0,0\n0,0,900,1,0,0,0\nx\ny\n".to_owned();
    let poses = file("inverse_poses.csv", poses);
    let found = run(&["solve", &path, "--poses", &poses, "--inverse", "--jsonl"]);
    assert_eq!(found.code, 1, "a row is no pose");
    let rows: Vec<Value> = found.out.lines().map(json).collect();
    assert_eq!(rows.len(), 5);
    assert_eq!((&rows[3]["line"], &rows[3]["error"]["code"]), (&5.into(), &"bad-row".into()));
    let solved = json(&run(&["solve", &path, "--json"]).out);
    assert_eq!(rows[0]["legs"], solved["results"][0]["legs"]);
    assert_eq!([&rows[0]["within_limits"], &rows[2]["within_limits"]], [true, false]);
    assert!(rows[2]["outside"].to_string().contains("leg 6"), "{}", rows[2]);
    let text = run(&["solve", &path, "--poses", &poses, "--inverse"]);
    assert!(
        text.out.contains("outside: all legs")
            && text.err.contains("inverse_poses.csv:5")
            && text.out.contains("2 rows without a pose"),
        "{} {}",
        text.out,
        text.err
    );
    let one = run(&["solve", &path, "--at", "0, 0, 550; 0, 0, 0", "--inverse", "--json"]);
    assert_eq!((one.code, &json(&one.out)["results"][0]["legs"]), (0, &rows[0]["legs"]));
    for (arguments, message) in [
        (&["solve", "puma560", "--inverse"][..], "found --inverse, expected it for a platform only"),
        (&["solve", "platform_06real", "--inverse"], "found legs, expected a pose beside --inverse"),
    ] {
        let run = run(arguments);
        assert!(run.code == 1 && run.err.contains(message), "{}", run.err);
    }
}

#[test]
fn the_poses_of_a_path_are_connected() {
    let path = hexapod("follow_hexapod.toml");
    let rows = (0..6).fold(String::new(), |text, k| text + &format!("{},0,{},1,0,0,0\n", 4 * k, 550 + k));
    let poses = file("follow_poses.csv", format!("x,y,z,qw,qx,qy,qz\n{rows}0,300,300,0,1,0,0\n"));
    let found = run(&["solve", &path, "--poses", &poses, "--follow", "--jsonl"]);
    let lines: Vec<Value> = found.out.lines().map(json).collect();
    assert_eq!(lines.len(), 8);
    let is_level = |mode: &Value| (mode["quaternion"][0].as_f64().unwrap() - 1.0).abs() < 1e-9;
    // The branch of the home pose: a step of (4, 0, 1) mm moves every point by as much.
    let home = lines[0]["modes"].as_array().unwrap().iter().find(|mode| is_level(mode)).unwrap();
    for line in &lines[1..6] {
        let all = line["modes"].as_array().unwrap();
        assert!(all.iter().any(|mode| mode["branch"] == home["branch"] && is_level(mode)));
    }
    assert!(lines[6]["events"].to_string().contains("jump"), "{}", lines[6]["events"]);
    let text = run(&["solve", &path, "--poses", &poses, "--follow", "-q"]).out;
    assert!(text.contains("m of plate at pose"), "{text}");
}

#[test]
fn a_leg_runs_through_its_range() {
    let path = hexapod("sweep_hexapod.toml");
    let arguments = ["sweep", &path, "--joint", "leg2", "--from", "600", "--to", "640", "--steps", "8"];
    let document = json(&run(&[&arguments[..], &["--json"]].concat()).out);
    assert_eq!(
        (&document["kind"], &document["variable"], &document["joint"]),
        (&"platform".into(), &"leg2".into(), &2.into())
    );
    // Every pose listed at a step is one of a branch, and has the legs that were asked for.
    let branches = document["branches"].as_array().unwrap();
    let listed: u64 = document["inputs"].as_array().unwrap().iter().map(|input| input["real"].as_u64().unwrap()).sum();
    let rows: usize = branches.iter().map(|branch| branch["rows"].as_array().unwrap().len()).sum();
    assert!(listed > 0 && rows as u64 == listed, "{listed} {rows}");
    let row = &branches[0]["rows"][0];
    let at = format!(
        "{} m, {} m, {} m; {}, {}, {}, {}",
        row["position"][0],
        row["position"][1],
        row["position"][2],
        row["quaternion"][0],
        row["quaternion"][1],
        row["quaternion"][2],
        row["quaternion"][3]
    );
    let legs = json(&run(&["solve", &path, "--at", &at, "--inverse", "--json"]).out)["results"][0]["legs"].clone();
    let home =
        json(&run(&["solve", &path, "--at", "0, 0, 550; 0, 0, 0", "--inverse", "--json"]).out)["results"][0]["legs"]
            .clone();
    let input = document["inputs"][usize::try_from(row["step"].as_u64().unwrap()).unwrap()]["input"].as_f64().unwrap();
    for (leg, (own, held)) in numbers(&legs).into_iter().zip(numbers(&home)).enumerate() {
        let expected = if leg == 1 { input } else { held };
        assert!((own - expected).abs() < 1e-9, "leg {leg}: {own} {expected}");
    }
    // The quaternions along a branch do not change their signs.
    for branch in branches {
        let rows = branch["rows"].as_array().unwrap();
        for pair in rows.windows(2) {
            let (a, b) = (numbers(&pair[0]["quaternion"]), numbers(&pair[1]["quaternion"]));
            assert!(a.iter().zip(&b).map(|(a, b)| a * b).sum::<f64>() > 0.9);
        }
    }
    let text = run(&arguments).out;
    assert!(text.contains("within the limits [m]") && text.contains("leg2 from 0.6 to 0.64 m in 8 steps"), "{text}");
    assert_eq!(run(&[&arguments[..], &["--csv"]].concat()).out.lines().count(), rows + 1);
    assert!(run(&[&arguments[..], &["--svg"]].concat()).out.starts_with("<svg"));
    for (joint, from, message) in [
        ("leg7", "1", "found --joint leg7, expected a leg, leg1 to leg6"),
        ("0", "1", "expected a leg"),
        ("leg1", "-1", "expected 0 or more"),
        ("leg1", "1 deg", "--from: "),
        ("leg1", "640", "expected a range"),
    ] {
        let run = run(&["sweep", &path, "--joint", joint, "--from", from, "--to", "640"]);
        assert!(run.code == 1 && run.err.contains(message), "{joint} {from}: {}", run.err);
    }
    assert!(run(&["sweep", &path, "--from", "1", "--to", "2"]).err.contains("found a platform and no --joint"));
}
