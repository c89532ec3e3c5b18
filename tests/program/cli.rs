//! The program as a shell sees it: exit codes, streams, files left alone, and no panic whatever comes in.
#![allow(clippy::unwrap_used)]

mod certificates;
mod descriptions;
mod platforms;
mod score;
mod tables;

use serde_json::Value;
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};

/// The result of a run of the program.
struct Run {
    code: i32,
    out: String,
    err: String,
}

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_looproot"));
    command.args(arguments).current_dir(crate::ROOT).env_remove("NO_COLOR");
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn finish(child: Child) -> Run {
    let output = child.wait_with_output().unwrap();
    let run = Run {
        code: output.status.code().unwrap_or(-1),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8(output.stderr).unwrap(),
    };
    assert!(!run.err.contains("panicked"), "{}", run.err);
    run
}

fn run(arguments: &[&str]) -> Run {
    finish(command(arguments).spawn().unwrap())
}

fn run_with_input(arguments: &[&str], input: &[u8]) -> Run {
    let mut child = command(arguments).stdin(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(input).unwrap();
    finish(child)
}

/// A file of its own for each test.
fn file(name: &str, content: impl AsRef<[u8]>) -> String {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(&path, content).unwrap();
    path.to_str().unwrap().to_owned()
}

fn library(name: &str) -> String {
    fs::read_to_string(format!("{}/equations/{name}.toml", crate::ROOT)).unwrap()
}

/// A general arm up to its first pose, and that pose without claims.
fn general_arm() -> (String, String) {
    let text = library("arm/general_02real");
    let (head, rest) = text.split_once("[[pose]]").unwrap();
    let pose = &rest[..rest.find("\n]").unwrap() + 2];
    (head.to_owned(), format!("[[pose]]{pose}\n"))
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

#[test]
fn a_complete_answer_begins_with_its_verdict() {
    let run = run(&["solve", "general_16real"]);
    let first = run.out.lines().next().unwrap();
    assert!(first.starts_with("complete (proved): 16 of 16 roots (16 real), all certified, residual <= "), "{first}");
    assert!(first.ends_with(" ms"), "{first}");
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    assert_eq!(run.out.lines().filter(|line| line.ends_with("  yes")).count(), 16);
    assert!(run.out.contains("q1 [deg]") && run.out.contains("\nwhy: 16 distinct certified roots"));
}

#[test]
fn an_unreachable_pose_is_an_answer_of_its_own() {
    let (head, pose) = general_arm();
    let rows: Vec<&str> = pose.lines().collect();
    // The same orientation, 3 m away.
    let far = rows.iter().map(|row| match row.rsplit_once(", ") {
        Some((row, last)) if last.ends_with("],") && !last.starts_with('1') => format!("{row}, 3],"),
        _ => (*row).to_owned(),
    });
    let far = head + &far.collect::<Vec<_>>().join("\n");
    let path = file("unreachable.toml", far);
    let text = run(&["solve", &path]);
    assert!(
        text.out.starts_with("unreachable (proved): 0 real of 16 roots, all certified: this pose cannot be reached, "),
        "{}",
        text.out
    );
    assert_eq!(text.code, 3);
    let document = run(&["solve", &path, "--json"]);
    assert_eq!(document.code, 3);
    assert_eq!(json(&document.out)["results"][0]["verdict"]["status"], "unreachable");
}

#[test]
fn the_document_follows_its_schema() {
    follows(
        "result.schema.json",
        &[
            "solve general_7r --json",
            "solve general_02real --json --complex",
            "solve ur5 --json --complex",
            "solve general_12real --json --real",
            "solve three_parallel --json",
            "solve dietmaier_40real --json",
            "solve platform/hexapod --json --complex",
            "solve platform/circle --json",
            "solve general_7r --json --scene",
            "solve dietmaier_40real --json --scene",
            "solve linkage/3prr --json --complex --scene",
            "solve linkage/peaucellier --json",
            "solve linkage/spherical_watt --json --complex --scene",
            "solve crcrr_2_angle --json --complex --derivatives",
        ],
    );
    follows(
        "derivation.schema.json",
        &[
            "derive puma560 --json",
            "derive rsrc --json",
            "derive rsrc --by half-angle --json",
            "derive bricard_line_symmetric --json",
            "derive platform/hexapod --json",
            "derive crcrr_4_angle --symbolic --json",
            "derive linkage/stephenson_3_triad --json",
            "derive linkage/coupler_curve --trace coupler.P --json",
            "derive linkage/spherical_cusp --trace coupler.P --json",
            "derive linkage/double_hooke --json",
            "derive linkage/spherical_3rrr --json",
            "derive linkage/rssr_ssr --json",
            "derive linkage/delta --input 2 --json",
            "derive linkage/rssr_ssr --symbolic=A --json",
            "derive arm/chain_rr --trace tool --json",
        ],
    );
    follows(
        "mobility.schema.json",
        &[
            "mobility bennett_a --json",
            "mobility bennett_broken --json",
            "mobility rscr --json",
            "mobility planar_4r --json",
            "mobility puma560 --json",
            "mobility platform/hexapod --json",
            "mobility framework/heureka --json",
            "mobility linkage/coupler_curve --json",
        ],
    );
    follows(
        "sweep.schema.json",
        &[
            "sweep cccr_1_angle --from -pi --to pi --steps 24 --json",
            "sweep rrsrr --from -pi --to pi --steps 24 --json",
            "sweep rrsrr --from -pi --to pi --steps 24 --json --scene",
            "sweep platform/points_6_3 --joint leg1 --from 48 --to 48.2 --steps 2 --json --scene",
            "sweep linkage/coupler_curve --from -2 --to 2 --steps 4 --trace coupler.P --json",
        ],
    );
    follows(
        "cells.schema.json",
        &[
            "derive cccr_1_angle --discriminant theta1 --json",
            "derive rssr --discriminant a1,theta1 --columns 3 --json",
            "derive linkage/level_four_bar --discriminant A --json",
        ],
    );
    follows(
        "synthesis.schema.json",
        &[
            "synthesize burmester5_2real_a --json --complex",
            "synthesize burmester4_a --json",
            "synthesize function5_1real_a --json --complex",
            "synthesize cc5_a --json",
        ],
    );
    follows("conditions.schema.json", &["conditions 4R --json", "conditions bennett --json"]);
    follows(
        "conditions_search.schema.json",
        &[
            "conditions 5R --json",
            "conditions goldberg_5r --json",
            "conditions dietmaier_6r --json",
            "conditions trihedral_6r --json",
        ],
    );
}

fn follows(schema: &str, runs: &[&str]) {
    let schema = fs::read_to_string(format!("{}/equations/{schema}", crate::ROOT)).unwrap();
    let schema = json(&schema);
    for arguments in runs {
        let words: Vec<&str> = arguments.split_whitespace().collect();
        let run = run(&words);
        assert_eq!(run.err, "", "{arguments}");
        let fault = fault(&json(&run.out), &schema, &schema, "document");
        assert_eq!(fault, None, "{arguments}");
    }
}

/// The first place at which a value is not of a schema, by as much of JSON Schema as the schemas use.
fn fault(value: &Value, schema: &Value, root: &Value, place: &str) -> Option<String> {
    if let Some(reference) = schema["$ref"].as_str() {
        return fault(value, root.pointer(&reference[1..]).unwrap(), root, place);
    }
    let is = |kind: &Value| match kind.as_str().unwrap() {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        "integer" => value.is_i64() || value.is_u64(),
        "number" => value.is_number(),
        other => panic!("{other}"),
    };
    let is_of_type = match &schema["type"] {
        Value::Null => true,
        Value::Array(kinds) => kinds.iter().any(is),
        kind => is(kind),
    };
    let is_in = schema["enum"].as_array().is_none_or(|words| words.contains(value));
    let least = schema["minimum"].as_f64().unwrap_or(f64::NEG_INFINITY);
    let items = value.as_array().map_or(&[][..], Vec::as_slice);
    let length = |key: &str, otherwise: u64| schema[key].as_u64().unwrap_or(otherwise);
    let is_long = |count: usize| (length("minItems", 0)..=length("maxItems", u64::MAX)).contains(&(count as u64));
    let is_counted = !value.is_array() || is_long(items.len());
    if !is_of_type || !is_in || value.as_f64().is_some_and(|number| number < least) || !is_counted {
        return Some(format!("{place}: {value} is not {schema}"));
    }
    if let Some(choices) = schema["oneOf"].as_array() {
        let faults: Vec<_> = choices.iter().filter_map(|choice| fault(value, choice, root, place)).collect();
        if faults.len() + 1 != choices.len() {
            return Some(format!(
                "{place}: {} of {} alternatives: {faults:?}",
                choices.len() - faults.len(),
                choices.len()
            ));
        }
    }
    // No key is required of a value that is no object: null, where the type allows it.
    let mut required = schema["required"].as_array().into_iter().flatten().filter(|_| value.is_object());
    if let Some(key) = required.find(|key| value.get(key.as_str().unwrap()).is_none()) {
        return Some(format!("{place}: no {key}"));
    }
    let properties = schema["properties"].as_object().into_iter().flatten();
    let mut of_properties = properties.filter_map(|(key, inner)| {
        value.get(key).and_then(|value| fault(value, inner, root, &format!("{place}.{key}")))
    });
    let of_items = || {
        let inner = schema.get("items")?;
        items.iter().enumerate().find_map(|(index, value)| fault(value, inner, root, &format!("{place}[{index}]")))
    };
    of_properties.next().or_else(of_items)
}

#[test]
fn modes_have_the_promised_fields() {
    let run = run(&["solve", "general_12real", "--json", "--complex"]);
    let document = json(&run.out);
    assert_eq!(document["kind"], "arm");
    let result = &document["results"][0];
    let expected = [("status", "complete".into()), ("complex", 16.into()), ("real", Value::from(12))];
    for (key, value) in expected {
        assert_eq!(result["verdict"][key], value);
    }
    assert!(result["timings_us"]["prepare"].is_number() && result["timings_us"]["solve"].is_number());
    let modes = result["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 16);
    for (index, mode) in modes.iter().enumerate() {
        assert_eq!(mode["real"], index < 12, "real ones first");
        assert_eq!(mode["q"].as_array().unwrap().len(), 6);
        for value in mode["q"].as_array().unwrap() {
            let angle = if index < 12 { value.as_f64() } else { value[0].as_f64() }.unwrap();
            assert!(-std::f64::consts::PI < angle && angle <= std::f64::consts::PI);
        }
        assert!(mode["certified"].as_bool().unwrap() && mode["radius"].as_f64().unwrap() < 1e-6);
        assert_eq!(mode["multiplicity"], 1);
    }
}

#[test]
fn lines_are_results_one_by_one() {
    let run = run(&["solve", "general_7r", "--jsonl"]);
    let lines: Vec<Value> = run.out.lines().map(json).collect();
    assert_eq!((run.code, lines.len()), (0, 2));
    assert_eq!((&lines[0]["case"], &lines[1]["case"]), (&1.into(), &2.into()));
}

#[test]
fn one_case_can_be_picked_or_given() {
    let one = run(&["solve", "general_7r", "--input", "2", "--jsonl"]);
    assert_eq!(json(&one.out)["case"], 2);
    let given = run(&["solve", "rrrrrrr", "--input", "7=90 deg"]);
    assert!(given.code == 0 && given.out.contains("q7 = 90 deg"), "{}", given.out);
    let reached = run(&["solve", "general_02real", "--joints", "0.1, -20 deg, 0.3, pi/4, 0.5, 0.6"]);
    assert!(reached.code == 0 && reached.out.contains("-20.0000"), "{}", reached.out);
    for arguments in [
        &["solve", "general_7r", "--input", "3"][..],
        &["solve", "general_7r", "--input", "0"],
        &["solve", "general_7r", "--input", "8=1"],
        &["solve", "rssr", "--input", "2=1"],
        &["solve", "general_7r", "--input", "1=x"],
        &["solve", "general_7r", "--pose", "1"],
        &["solve", "general_7r", "--joints", "1"],
        &["solve", "general_02real", "--input", "1"],
        &["solve", "general_02real", "--pose", "9"],
        &["solve", "general_02real", "--joints", "1,2,3"],
        &["solve", "general_02real", "--joints", "1,2,3,4,5,nan"],
    ] {
        assert_eq!(run(arguments).code, 1, "{arguments:?}");
    }
}

#[test]
fn a_platform_is_solved_with_quaternions_and_positions() {
    let all = run(&["solve", "dietmaier_40real"]);
    let first = all.out.lines().next().unwrap();
    assert!(first.starts_with("complete (proved): 40 of 40 roots (40 real), all certified, residual <= "), "{first}");
    assert_eq!((all.code, all.out.lines().filter(|line| line.ends_with("  yes")).count()), (0, 40));
    assert!(all.out.contains("route: border basis"), "{}", all.out);
    let document = json(&run(&["solve", "platform_06real", "--json", "--complex"]).out);
    assert_eq!(document["kind"], "platform");
    let result = &document["results"][0];
    assert_eq!((&result["verdict"]["complex"], &result["verdict"]["real"]), (&40.into(), &6.into()));
    assert_eq!(result["legs"].as_array().unwrap().len(), 6);
    let modes = result["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 40);
    for (index, mode) in modes.iter().enumerate() {
        assert_eq!(mode["real"], index < 6, "real ones first");
        assert!(mode.get("q").is_none() && mode.get("within_limits").is_none());
        let (quaternion, position) = (mode["quaternion"].as_array().unwrap(), mode["position"].as_array().unwrap());
        assert_eq!((quaternion.len(), position.len()), (4, 3));
        let values = mode["singular_values"].as_array();
        assert_eq!((values.is_some(), mode["twist"].is_array()), (index < 6, index < 6));
        if let Some(values) = values {
            let norm: f64 = quaternion.iter().map(|q| q.as_f64().unwrap().powi(2)).sum();
            assert!((norm - 1.0).abs() < 1e-14);
            let ratio = values[0].as_f64().unwrap() / values[5].as_f64().unwrap();
            assert!((mode["condition"].as_f64().unwrap() / ratio - 1.0).abs() < 1e-12);
        }
    }
    let lines = run(&["solve", "platform/hexapod", "--jsonl"]);
    assert_eq!((lines.code, lines.out.lines().map(json).count()), (0, 3));
    let real = run(&["solve", "dietmaier_40real", "--real", "-q"]);
    assert!(real.code == 0 && real.out.starts_with("complete (proved): 40 of 40 roots"), "{}", real.out);
    let posture = run(&["solve", "platform/hexapod", "--pose", "2", "-q"]);
    assert!(
        posture.code == 0 && posture.out.starts_with("complete (proved): 28 of 28 roots (8 real)"),
        "{}",
        posture.out
    );
}

#[test]
fn what_becomes_of_a_platform_is_in_the_exit_code() {
    for (name, code, start) in [
        (
            "platform_00real",
            3,
            "unreachable (proved): 0 real of 40 roots, all certified: no pose has legs of these lengths, ",
        ),
        ("points_6_3", 0, "complete (proved): 16 of 16 roots (6 real), all certified"),
        ("bricard_octahedron", 2, "self-motion of dimension 1 ("),
        ("singular_pose", 0, "complete (proved): 40 of 40 roots (2 real), all certified, "),
    ] {
        let run = run(&["solve", &format!("platform/{name}"), "-q"]);
        assert!(run.code == code && run.out.starts_with(start), "{name}: {} {}", run.code, run.out);
    }
    // Legs that are too short to reach are an answer.
    let short = run(&["solve", "dietmaier_40real", "--legs", "1, 1, 1, 1, 1, 0.001"]);
    assert!(
        short.code == 3 && short.out.starts_with("unreachable (proved): 0 real of 40 roots"),
        "{} {}",
        short.code,
        short.out
    );
}

#[test]
fn legs_can_be_given_or_asked_for() {
    let at = run(&["solve", "dietmaier_40real", "--at", "0.1, 0.2, \"1\"; 1, 0, 0, 0"]);
    assert_eq!(at.code, 1, "a stray quotation mark: {}", at.err);
    let at = json(&run(&["solve", "dietmaier_40real", "--at", "0.1, 20 cm, 1; 0.6, 0, 0, -0.8", "--json"]).out);
    let legs: Vec<f64> = at["results"][0]["legs"].as_array().unwrap().iter().map(|l| l.as_f64().unwrap()).collect();
    assert!((legs[0] - 1.05_f64.sqrt()).abs() < 1e-15, "{legs:?}");
    let hit = |mode: &Value| (mode["position"][1].as_f64().unwrap() - 0.2).abs() < 1e-12;
    assert!(at["results"][0]["modes"].as_array().unwrap().iter().any(hit), "{at}");
    let lengths = legs.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let back = json(&run(&["solve", "dietmaier_40real", "--legs", &lengths, "--json"]).out);
    assert!(back["results"][0]["modes"].as_array().unwrap().iter().any(hit), "{back}");
    for arguments in [
        &["solve", "dietmaier_40real", "--legs", "1, 2, 3"][..],
        &["solve", "dietmaier_40real", "--legs", "1, 2, 3, 4, 5, -6"],
        &["solve", "dietmaier_40real", "--legs", "1, 2, 3, 4, 5, nan"],
        &["solve", "dietmaier_40real", "--at", "1, 2, 3"],
        &["solve", "dietmaier_40real", "--at", "1, 2; 1, 0, 0, 0"],
        &["solve", "dietmaier_40real", "--at", "1, 2, 3; 2, 0, 0, 0"],
        &["solve", "dietmaier_40real", "--at", "1, 2, 3; 1, 0, 0, 0", "--pose", "1"],
        &["solve", "dietmaier_40real", "--pose", "2"],
        &["solve", "dietmaier_40real", "--input", "1"],
        &["solve", "dietmaier_40real", "--joints", "1"],
        &["solve", "general_02real", "--legs", "1, 2, 3, 4, 5, 6"],
        &["solve", "general_7r", "--at", "1, 2, 3; 1, 0, 0, 0"],
    ] {
        let run = run(arguments);
        assert!(run.code == 1 && run.err.starts_with("error: "), "{arguments:?}: {} {}", run.code, run.err);
    }
    let shown = run(&["show", "platform/hexapod"]);
    assert!(shown.out.contains("6-6 platform") && shown.out.contains("L6 [m]"), "{}", shown.out);
    let model = json(&run(&["show", "points_6_3", "--json"]).out);
    assert_eq!((&model["type"], model["plate"].as_array().unwrap().len()), (&"6-3".into(), 6));
    assert_eq!(model["cases"][0]["legs"].as_array().unwrap().len(), 6);
}

#[test]
fn bad_platforms_exit_with_1() {
    let good = library("platform/platform_06real");
    let cases = [
        ("five.toml", good.replacen("    [6, 6, 1],\n", "", 1), "5 points"),
        ("nan.toml", good.replacen("[6, 6, 1]", "[nan, 6, 1]", 1), "nan"),
        ("seven.toml", good.replacen("    [6, 6, 1],\n", "    [6, 6, 1],\n    [1, 2, 3],\n", 1), "7 points"),
        ("longer.toml", good.replacen("[253, ", "[253, 253, ", 1), "7 values"),
        ("nan_leg.toml", good.replacen("[253, ", "[nan, ", 1), "not a finite number"),
        ("infinite.toml", good.replacen("[6, 6, 1]", "[inf, 6, 1]", 1), "not a finite number"),
        ("legless.toml", good.replacen("legs_squared", "# legs_squared", 1), "no legs"),
        ("negative.toml", good.replacen("[253, ", "[-253, ", 1), "negative"),
        ("short.toml", good.replacen("[253, ", "[", 1), "5 values"),
        ("truncated.toml", good[..good.len() / 3].to_owned(), "expected"),
    ];
    for (name, content, word) in cases {
        let path = file(&format!("platforms/{name}"), &content);
        for verb in ["solve", "show", "check"] {
            let run = run(&[verb, &path]);
            assert_eq!(run.code, 1, "{verb} {name}: {}", run.err);
            assert!(run.err.contains(name) && run.err.contains(word), "{name}: {}", run.err);
        }
    }
}

#[test]
fn degenerate_platforms_are_named() {
    let with = |base: &str, plate: &str| {
        format!("[mechanism]\nkind = \"platform\"\nbase = {base}\nplate = {plate}\nlegs = [3, 3, 3, 3, 3, 3]\n")
    };
    let round = "[[2, 0, 0], [1, 2, 0], [-1, 2, 1], [-2, 0, 0], [-1, -2, 0], [1, -2, 2]]";
    let line = "[[0, 0, 0], [1, 1, 2], [2, 2, 4], [3, 3, 6], [4, 4, 8], [5, 5, 10]]";
    let point = "[[1, 2, 3], [1, 2, 3], [1, 2, 3], [1, 2, 3], [1, 2, 3], [1, 2, 3]]";
    let twice = "[[2, 0, 0], [2, 0, 0], [-1, 2, 1], [-2, 0, 0], [-1, -2, 0], [1, -2, 2]]";
    for (name, text, message) in [
        ("line_base.toml", with(line, round), ":3: found all points of `base` on one line"),
        ("line_plate.toml", with(round, line), ":4: found all points of `plate` on one line"),
        ("point.toml", with(round, point), ":4: found six equal points in `plate`"),
        ("twice.toml", with(twice, twice), "found legs 1 and 2 between the same two points"),
    ] {
        let path = file(&format!("platforms/{name}"), text);
        for verb in ["solve", "derive", "show"] {
            let run = run(&[verb, &path]);
            assert!(run.code == 1 && run.err.contains(name) && run.err.contains(message), "{name}: {}", run.err);
        }
    }
}

#[test]
fn legs_that_cannot_reach_are_an_answer_with_a_reason() {
    let said = |legs: &str| {
        let run = run(&["solve", "dietmaier_40real", "--legs", legs]);
        (run.code, run.out + &run.err)
    };
    let (code, text) = said("0.01, 0.01, 0.01, 0.01, 0.01, 0.01");
    assert!(code == 3 && text.contains("no pose is real: legs 1 and 2 are too short"), "{code} {text}");
    let (code, text) = said("1, 9, 1, 1, 1, 1");
    assert!(code == 3 && text.contains("no pose is real: leg 2 is too long beside leg 1"), "{code} {text}");
}

#[test]
fn platforms_are_measured() {
    let counts = run(&["bench", "accuracy", "--set", "platform-planar-base", "--count", "3"]);
    assert!(counts.code == 0 && counts.out.starts_with("3 platforms: 3 planted found, 0 lost"), "{}", counts.out);
    let document = json(&run(&["bench", "accuracy", "--set", "platform", "--count", "2", "--json"]).out);
    assert_eq!((&document["platforms"], &document["miscounted"]), (&2.into(), &0.into()));
    let times = run(&["bench", "speed", "--set", "platform", "--count", "1", "--repeats", "1"]);
    assert!(times.code == 0 && times.out.contains("all 40 poses"), "{}", times.out);
    let times = json(&run(&["bench", "speed", "--set", "platform", "--count", "1", "--repeats", "1", "--json"]).out);
    assert!(times["stages"][0]["least_us"].is_number(), "{times}");
    for arguments in [&["bench", "accuracy", "--set", "platform-7-7"][..], &["bench", "speed", "--set", "structured"]] {
        assert_eq!(run(arguments).code, 1, "{arguments:?}");
    }
}

#[test]
fn loops_are_measured() {
    let times = json(&run(&["bench", "speed", "--set", "loops", "--count", "1", "--repeats", "1", "--json"]).out);
    let row = |group: &str, name: &str| {
        let rows = times[group].as_array().unwrap();
        rows.iter().find(|row| row["unknowns"] == name).unwrap_or_else(|| panic!("{name}: {times}")).clone()
    };
    for (name, solutions) in [("CCC", 2), ("CRCR", 4), ("CCRR", 8), ("RRRRRR", 16), ("SRRR", 4), ("loop/rssr", 2)] {
        let row = row("loops", name);
        assert!(row["solutions"] == solutions && row["answer"]["slowest_us"].is_number(), "{row}");
    }
    assert!(row("loops", "overconstrained/planar_4r")["real"].is_null());
    for (name, degree) in [("CCC", 2), ("CRCR", 4), ("PRPRRR", 8), ("RRRRRR", 16)] {
        let row = row("exact", name);
        assert!(row["degree"] == degree && row["roots"]["median_us"].is_number(), "{row}");
    }
    let text = run(&["bench", "speed", "--set", "loops", "--count", "1", "--repeats", "1"]).out;
    assert!(text.starts_with("microseconds, one core; faer"), "{text}");
}

#[test]
fn joint_limits_mark_or_drop() {
    let (head, pose) = general_arm();
    let limits = "limits = [[-0.1, 0.1], [-4, 4], [-4, 4], [-4, 4], [-4, 4], [-4, 4]]\n\n";
    let path = file("limits.toml", head + limits + &pose);
    let marked = run(&["solve", &path]);
    assert!(
        marked.out.contains("in limits") && marked.out.contains("joint limits: q1 -5.73..5.73 deg"),
        "{}",
        marked.out
    );
    let document = json(&run(&["solve", &path, "--json"]).out);
    assert_eq!(document["results"][0]["modes"].as_array().unwrap().len(), 2);
    let outside = document["results"][0]["modes"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|mode| mode["within_limits"] == false)
        .count();
    let dropped = json(&run(&["solve", &path, "--json", "--limits", "drop"]).out);
    assert_eq!(dropped["results"][0]["modes"].as_array().unwrap().len(), 2 - outside);
    assert_eq!(dropped["results"][0]["verdict"]["real"], 2);
}

#[test]
fn standard_input_is_a_file_named_dash() {
    let text = library("arm/general_16real");
    let run = run_with_input(&["solve", "-"], text.as_bytes());
    assert_eq!(run.code, 0);
    assert!(run.out.starts_with("complete (proved): 16 of 16 roots"));
    assert_eq!(run_with_input(&["solve", "-"], b"").code, 1);
}

#[test]
fn output_goes_to_a_file_but_never_to_the_input() {
    let text = library("arm/general_16real");
    let input = file("kept.toml", &text);
    let output = file("out.json", "old");
    let run_to = |output: &str| run(&["solve", &input, "--json", "-o", output]);
    let done = run_to(&output);
    assert_eq!((done.code, done.out.as_str()), (0, ""));
    assert_eq!(json(&fs::read_to_string(&output).unwrap())["results"].as_array().unwrap().len(), 1);
    let refused = run_to(&input);
    assert!(refused.code == 1 && refused.err.contains("never changed"), "{}", refused.err);
    assert_eq!(fs::read_to_string(&input).unwrap(), text);
    assert_eq!(run_to(&format!("{}/no/such/folder/x", env!("CARGO_TARGET_TMPDIR"))).code, 1);
}

#[test]
fn colours_are_asked_for() {
    let bare = run(&["solve", "general_16real"]);
    assert!(!bare.out.contains('\x1b'));
    assert!(
        run(&["solve", "general_16real", "--color", "always"]).out.starts_with("\x1b[32mcomplete (proved): 16 of 16")
    );
    let quiet = run(&["solve", "general_16real", "--quiet"]);
    assert_eq!(quiet.out.lines().count(), 1);
}

#[test]
fn misuse_exits_with_1() {
    for arguments in [
        &[][..],
        &["dance"],
        &["solve"],
        &["solve", "ur5", "--dance"],
        &["solve", "ur5", "--json", "--jsonl"],
        &["solve", "ur5", "--digits", "many"],
        &["solve", "ur5", "--digits", "0"],
        &["show"],
        &["completions", "dos"],
    ] {
        let run = run(arguments);
        assert_eq!(run.code, 1, "{arguments:?}");
        assert!(run.out.is_empty() && !run.err.is_empty(), "{arguments:?}");
    }
    for arguments in [&["--help"][..], &["--version"], &["solve", "--help"]] {
        let run = run(arguments);
        assert!(run.code == 0 && !run.out.is_empty() && run.err.is_empty(), "{arguments:?}");
    }
}

#[test]
fn bad_input_names_its_place_and_exits_with_1() {
    let good = library("arm/general_16real");
    let first_joint = good.lines().find(|line| line.trim_start().starts_with("{ type")).unwrap().to_owned();
    let joints = |n: usize| {
        let mut lines: Vec<&str> = good.lines().filter(|line| !line.trim_start().starts_with("{ type")).collect();
        let at = lines.iter().position(|line| line.starts_with("joints")).unwrap();
        lines.splice(at + 1..=at, std::iter::repeat_n(first_joint.as_str(), n));
        lines.join("\n")
    };
    let pose = good.find("matrix").unwrap();
    let stretched = format!("{}{}", &good[..pose], good[pose..].replacen("[0.", "[1.", 1).replacen("[-0.", "[-1.", 1));
    let cases: [(&str, Vec<u8>, &str); 11] = [
        ("no_convention.toml", good.replace("convention = \"dh\"\n", "").into(), "convention"),
        ("joint_type.toml", good.replacen("\"R\"", "\"Q\"", 1).into(), "found \"q\""),
        ("not_rigid.toml", stretched.into(), "rotation"),
        ("none.toml", joints(0).into(), "found 0 joints"),
        ("many.toml", joints(25).into(), "found 25 joints"),
        ("nan.toml", good.replacen("a = ", "a = nan #", 1).into(), "nan"),
        ("truncated.toml", good.as_bytes()[..good.len() / 2].into(), "expected"),
        ("binary.toml", (0..=255).cycle().take(5000).collect(), "expected text"),
        ("empty.toml", Vec::new(), "empty"),
        ("number.json", b"17".to_vec(), "expected"),
        ("table.csv", b"type,a,alpha,d,theta0\nR,1,2\n".to_vec(), "expected 5"),
    ];
    for (name, content, word) in cases {
        let path = file(&format!("bad/{name}"), &content);
        for verb in ["solve", "show", "check"] {
            let run = run(&[verb, &path]);
            assert_eq!(run.code, 1, "{verb} {name}: {}", run.err);
            assert!(run.err.starts_with("error: ") && run.err.contains(name), "{name}: {}", run.err);
            assert!(run.err.to_lowercase().contains(word), "{name}: {}", run.err);
        }
        assert_eq!(fs::read(&path).unwrap(), content, "{name} was changed");
    }
}

#[test]
fn what_is_no_file_is_said_so() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../src");
    let here = run(&["solve", folder]);
    assert!(here.code == 1 && here.err.contains("directory"), "{}", here.err);
    let nowhere = run(&["solve", "pumma560"]);
    assert!(nowhere.code == 1 && nowhere.err.contains("did you mean `puma560`"), "{}", nowhere.err);
    let huge = file("huge.toml", "");
    fs::File::options().write(true).open(&huge).unwrap().set_len(1 << 30).unwrap();
    let refused = run(&["solve", &huge]);
    fs::remove_file(&huge).unwrap();
    assert!(refused.code == 1 && refused.err.contains("64 MiB"), "{}", refused.err);
    let table = file("arm.csv", "type,a,alpha,d,theta0\n".to_owned() + &"R,0.3,1,0.2,0\n".repeat(6));
    let no_pose = run(&["solve", &table]);
    assert!(no_pose.code == 1 && no_pose.err.contains("--joints"), "{}", no_pose.err);
    let posed = run(&["solve", &table, "--joints", "1,2,3,-1,-2,-3", "-q"]);
    assert!(!posed.out.is_empty() && posed.code != 1, "{}", posed.err);
}

#[test]
fn what_is_not_solved_yet_exits_with_4() {
    let helical = library("arm/general_16real").replacen("\"R\"", "\"H\", pitch = 0.1", 1);
    let path = file("helical.toml", helical);
    let text = run(&["solve", &path]);
    assert!(text.code == 4 && text.out.is_empty() && text.err.contains("unsupported"), "{}{}", text.out, text.err);
    let document = run(&["solve", &path, "--json"]);
    assert_eq!(document.code, 4);
    assert_eq!(json(&document.out)["results"][0]["verdict"]["status"], "unsupported");
}

#[test]
fn the_library_is_listed_and_shown() {
    let list = run(&["list"]);
    assert_eq!(list.code, 0);
    let document = run(&["list", "--json"]);
    let document = json(&document.out);
    let entries = document.as_array().unwrap();
    assert!(entries.len() >= 25);
    assert_eq!(list.out.lines().count(), entries.len() + 2);
    for entry in entries {
        assert!(entry["name"].is_string() && entry["kind"].is_string() && entry["source"]["key"].is_string());
    }
    let source = run(&["show", "puma560", "--source"]);
    assert_eq!(source.out, library("arm/puma560"));
    let shown = run(&["show", "puma560"]);
    assert!(shown.out.starts_with("Puma 560\n6R arm, dh: "), "{}", shown.out);
    let model = json(&run(&["show", "ur3e", "--json"]).out);
    assert_eq!(model["convention"], "screws");
    assert_eq!(model["joints"].as_array().unwrap().len(), 6);
    assert_eq!(model["home"].as_array().unwrap().len(), 4);
}

#[test]
fn files_of_every_kind_are_listed_and_shown() {
    let list = json(&run(&["list", "--json"]).out);
    let kinds =
        [("framework/steffen", "framework"), ("motion/bennett", "motion"), ("conditions/bennett", "conditions")];
    for (name, kind) in kinds {
        let line = list.as_array().unwrap().iter().find(|line| line["name"] == name).unwrap();
        assert_eq!(line["kind"], kind);
        let shown = run(&["show", name]);
        let source = line["source"]["key"].as_str().unwrap();
        assert_eq!((shown.code, shown.err.as_str()), (0, ""), "{name}");
        assert!(shown.out.starts_with(line["title"].as_str().unwrap()), "{}", shown.out);
        assert!(shown.out.contains(&format!("source: [{source}]")), "{}", shown.out);
        assert_eq!(run(&["show", name, "--source"]).out, library(name));
        let model = json(&run(&["show", name, "--json"]).out);
        assert!(model["kind"] == kind && model["citation"].is_string(), "{model}");
    }
    assert!(run(&["list"]).out.contains("framework, 9 vertices, 21 bars"));
    let steffen = run(&["show", "steffen"]).out;
    assert!(steffen.contains("claimed: dimension 1, infinitesimal 1"), "{steffen}");
    let motion = json(&run(&["show", "motion/bennett", "--json"]).out);
    // (t - i) (t - 1 - i - 2 j + eps (2 i - j)), multiplied by hand.
    let expected = [
        ["-1", "1", "0", "2", "2", "0", "0", "1"],
        ["-1", "-2", "-2", "0", "0", "2", "-1", "0"],
        ["1", "0", "0", "0", "0", "0", "0", "0"],
    ];
    assert_eq!(motion["polynomial"], serde_json::json!(expected));
    let symbols = run(&["show", "dietmaier_6r"]).out;
    assert!(symbols.contains("6R loop with symbols") && symbols.contains("unknown: b'"), "{symbols}");
    let goldberg = json(&run(&["show", "goldberg_5r", "--json"]).out);
    assert_eq!((&goldberg["joints"][0]["alpha"], &goldberg["joints"][0]["a"]), (&"beta + gamma".into(), &"a1".into()));
}

#[test]
fn a_name_in_two_folders_is_given_with_its_folder() {
    for arguments in [&["show", "bennett"][..], &["show", "bennett", "--source"]] {
        let run = run(arguments);
        let expected = "found the name `bennett`, expected one of conditions/bennett, motion/bennett";
        assert!(run.code == 1 && run.err.contains(expected), "{}", run.err);
    }
    // Where only one of them can be meant, the name is enough.
    assert_eq!(run(&["factor", "bennett", "-q"]).code, 0);
    assert_eq!(run(&["conditions", "bennett", "-q"]).code, 0);
}

/// Each verb with a file of each kind that it is not for: the kind found, the kind expected, the verb to use.
#[test]
fn a_file_of_the_wrong_kind_is_told_with_its_verb() {
    let entry = "expected an arm, a loop or a platform with numbers";
    let moving = "expected a loop, an arm, a platform, a linkage or a framework";
    let kinds = [
        ("motion/bennett", "a rational motion", "factor"),
        ("framework/steffen", "a framework", "mobility"),
        ("conditions/bennett", "a loop with symbols", "conditions"),
        ("arm/puma560", "an arm", "solve"),
        ("loop/general_7r", "a loop", "solve"),
        ("platform/hexapod", "a platform", "solve"),
        ("synthesis/burmester4_a", "a synthesis", "synthesize"),
    ];
    let swept = "expected a loop, a linkage or a platform, which has an input to sweep";
    let wrong: [(&[&str], &str, &[usize]); 8] = [
        (&["solve"], entry, &[0, 1, 2, 6]),
        (&["derive"], entry, &[0, 1, 2]),
        (&["sweep", "--from", "0", "--to", "1"], entry, &[0, 1, 2]),
        (&["sweep", "--from", "0", "--to", "1"], swept, &[3]),
        (&["mobility"], moving, &[0, 2]),
        (&["factor"], "expected a rational motion", &[1, 2, 3, 4, 5]),
        (&["conditions"], "expected a loop, with symbols or numbers", &[0, 1, 3, 5, 6]),
        (&["synthesize"], "expected a synthesis", &[0, 1, 2, 3, 4, 5]),
    ];
    for (arguments, expected, files) in wrong {
        for (name, noun, verb) in files.iter().map(|&index| kinds[index]) {
            let path = format!("equations/{name}.toml");
            // By its path, and by its name in the library.
            for given in [path.as_str(), name] {
                let run = run(&[arguments, &[given]].concat());
                let message = format!("found {noun}, {expected}; {noun} is for `looproot {verb}`\n");
                assert!(run.code == 1 && run.err.ends_with(&message), "{arguments:?} {given}: {}", run.err);
                assert!(run.err.contains(name) && run.out.is_empty(), "{arguments:?} {given}: {}", run.err);
            }
        }
    }
    let asks = run(&["check", "conditions/bennett"]);
    assert!(asks.code == 1 && asks.err.contains("found a loop with symbols"), "{}", asks.err);
}

#[test]
fn claims_are_tested() {
    let good = run(&["check", "arm/general_16real", "loop/rrrrrrr"]);
    assert!(good.code == 0 && good.out.contains("in 2 entries hold"), "{}", good.out);
    let text = library("arm/general_16real");
    let q = text.find("q = [").unwrap() + 5;
    let wrong_q = format!("{}9.5, {}", &text[..q], &text[text[q..].find(", ").unwrap() + q + 2..]);
    file("claims/wrong_q.toml", wrong_q);
    file("claims/sub/wrong_count.toml", text.replace("real = 16", "real = 14"));
    file("claims/README.md", "not a mechanism");
    let folder = format!("{}/claims", env!("CARGO_TARGET_TMPDIR"));
    let wrong = run(&["check", &folder]);
    assert_eq!(wrong.code, 2);
    assert!(wrong.out.contains("claims 14 real solutions, found 16"), "{}", wrong.out);
    assert!(wrong.out.contains("its closure is off by"), "{}", wrong.out);
    assert!(wrong.out.trim_end().lines().last().unwrap().contains("FAIL"), "{}", wrong.out);
    let document = json(&run(&["check", &folder, "--json"]).out);
    assert_eq!((&document[0]["holds"], &document[1]["holds"]), (&false.into(), &false.into()));
    assert_eq!(run(&["check", "/no/such/path"]).code, 1);
    let empty = format!("{}/nothing", env!("CARGO_TARGET_TMPDIR"));
    fs::create_dir_all(&empty).unwrap();
    assert_eq!(run(&["check", &empty]).code, 1);
}

#[test]
fn completions_are_printed() {
    for shell in ["bash", "zsh", "fish"] {
        assert!(run(&["completions", shell]).out.contains("looproot"));
    }
}

#[test]
fn a_reader_that_goes_away_is_no_fault() {
    let mut child = command(&["list"]).spawn().unwrap();
    drop(child.stdout.take());
    let run = finish(child);
    assert_eq!((run.code, run.err.as_str()), (0, ""));
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_is_done() {
    let (head, pose) = general_arm();
    let path = file("many.toml", head + &pose.repeat(3000));
    for form in ["--json", "--jsonl"] {
        let mut child = command(&["solve", &path, form, "--threads", "1"]).spawn().unwrap();
        let mut out = BufReader::new(child.stdout.take().unwrap());
        let mut text = String::new();
        // With a full pipe the program waits for its reader, so that it has not ended yet.
        out.read_line(&mut text).unwrap();
        let kill = format!("kill -INT {}", child.id());
        assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
        std::thread::sleep(std::time::Duration::from_millis(200));
        out.read_to_string(&mut text).unwrap();
        assert_eq!(finish(child).code, 130, "{form}");
        let done = match form {
            "--json" => json(&text)["results"].as_array().unwrap().len(),
            _ => text.lines().map(json).count(),
        };
        assert!((1..3000).contains(&done), "{done}");
    }
}

#[test]
fn numbers_of_options_follow_the_units_of_the_file() {
    let joint = |a: u32, alpha: u32| format!("{{ type = \"R\", a = {a}, alpha = {alpha}, d = 0 }},\n");
    let units = "units = { length = \"mm\", angle = \"deg\" }\n[mechanism]\nconvention = \"dh\"\n";
    let bennett = joint(400, 30) + &joint(300, 20);
    let four = file("units_loop.toml", format!("{units}kind = \"loop\"\njoints = [\n{}]\n", bennett.repeat(2)));
    let document = json(&run(&["solve", &four, "--input", "1=90", "--json"]).out);
    let asked = |document: &Value, key: &str| document["results"][0]["asked"][key].as_f64().unwrap();
    assert!((asked(&document, "angle") - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    let document = json(&run(&["solve", &four, "--input", "1=0.5 rad", "--json"]).out);
    assert_eq!(asked(&document, "angle"), 0.5);

    // Neither an arm nor a platform needs a case of its own then.
    let six = (1..7).map(|k| joint(100 * k, 10 * k + 5)).collect::<String>();
    let arm = file("units_arm.toml", format!("{units}kind = \"arm\"\njoints = [\n{six}]\n"));
    let found = run(&["solve", &arm, "--joints", "10, 20, 30, 40, 50, 60", "--json"]);
    let modes = json(&found.out)["results"][0]["modes"].clone();
    let planted = |mode: &Value| {
        (1..7)
            .zip(mode["q"].as_array().unwrap())
            .all(|(k, q)| (q.as_f64().unwrap().to_degrees() - 10.0 * f64::from(k)).abs() < 1e-6)
    };
    assert!(modes.as_array().unwrap().iter().any(planted), "{modes}");
    assert_eq!(run(&["solve", &arm]).code, 1);

    let text = library("platform/dietmaier_40real");
    let points = &text[text.find("base = ").unwrap()..];
    let points = &points[..points.find("legs").unwrap()];
    let platform = format!("units = {{ length = \"mm\" }}\n[mechanism]\nkind = \"platform\"\n{points}");
    let platform = file("units_platform.toml", platform);
    let document = json(&run(&["solve", &platform, "--legs", "700, 700, 710, 720, 700, 700", "--real", "--json"]).out);
    assert_eq!(document["results"][0]["asked"]["legs"][2], 0.71);
}

#[test]
fn angles_within_the_limits_are_listed_within_them() {
    let (head, pose) = general_arm();
    let free = file("turns_free.toml", head.clone() + &pose);
    let q = |path: &str, index: usize| -> Vec<f64> {
        let document = json(&run(&["solve", path, "--json"]).out);
        let modes = document["results"][0]["modes"].as_array().unwrap();
        modes[index]["q"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    };
    let first = q(&free, 0);
    // A whole turn further, all of them.
    let limits: Vec<String> = first.iter().map(|x| format!("[{}, {}]", x + 6.0, x + 6.5)).collect();
    let limited = file("turns_limited.toml", format!("{head}limits = [{}]\n\n{pose}", limits.join(", ")));
    for (free, limited) in first.iter().zip(q(&limited, 0)) {
        assert!((limited - free - std::f64::consts::TAU).abs() < 1e-12, "{free} {limited}");
    }
    let text = run(&["solve", &limited]);
    assert!(text.out.contains("within them: 1 of 2 real solutions"), "{}", text.out);
}
