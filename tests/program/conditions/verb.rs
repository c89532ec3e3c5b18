//! `looproot conditions`

use serde_json::Value;
use std::io::Write;
use std::process::{Command, Stdio};

struct Run {
    code: i32,
    out: String,
    err: String,
}

fn run(arguments: &[&str], input: &str) -> Run {
    verb("conditions", arguments, input)
}

fn verb(verb: &str, arguments: &[&str], input: &str) -> Run {
    let mut command = Command::new(env!("CARGO_BIN_EXE_looproot"));
    command.arg(verb).args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    Run { code: output.status.code().unwrap(), out: text(output.stdout), err: text(output.stderr) }
}

fn numbers(lengths: [&str; 4]) -> String {
    let twists = ["1/2", "1/3", "1/2", "1/3"];
    let joints: Vec<String> = lengths
        .iter()
        .zip(twists)
        .map(|(a, t)| format!("{{ type = \"R\", a = {a}, tan_half_alpha = \"{t}\", d = 0 }}"))
        .collect();
    format!("[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [{}]\n", joints.join(", "))
}

#[test]
fn the_verdict_comes_first() {
    let run = run(&["4R"], "");
    assert_eq!((run.code, run.err.as_str()), (0, ""));
    let first = run.out.lines().next().unwrap();
    assert_eq!(
        first,
        "moves as Bennett (+), Bennett (-), spherical, planar and in no other way (besides loops with coincident axes) (proved, \
         10 of 10 steps)"
    );
    assert!(run.out.contains("tan(theta1/2) tan(theta4/2) = (t1 + t2)/(t1 - t2)"), "{}", run.out);
    assert!(!run.out.contains("FAILED"));
}

#[test]
fn numbers_and_faults() {
    let moves = run(&["-", "--quiet"], &numbers(["4", "3", "4", "3"]));
    assert!(moves.code == 0 && moves.out.starts_with("moves: Bennett (+) (proved"), "{}", moves.out);
    let rigid = run(&["-", "--quiet"], &numbers(["4", "3", "4", "3.000000001"]));
    assert!(rigid.code == 3 && rigid.out.starts_with("does not move (proved"), "{}", rigid.out);
    assert_eq!(run(&["benet"], "").code, 1);
    assert!(run(&["benet"], "").err.contains("did you mean `bennett`?"));
    let empty =
        numbers(["4", "3", "4", "3"]) + "[symbols]\nlengths = [\"p\"]\n[ansatz]\nrelations = [\"p^2 + 1 = 0\"]\n";
    let empty = run(&["-"], &empty);
    assert!(
        empty.code == 3 && empty.out.starts_with("no real mechanism: the real solution set is empty"),
        "{}",
        empty.out
    );
    assert!(empty.out.contains("(line 8)"), "{}", empty.out);
}

#[test]
fn documents_and_other_languages() {
    let json = run(&["bennett", "--json"], "");
    let document: Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!(document["proved"], true);
    assert_eq!(document["families"][0]["class"], "bennett");
    let conditions = document["families"][0]["conditions"].as_array().unwrap();
    assert!(conditions.iter().any(|c| c["text"] == "t1^2*t2*a1 - t1*t2^2*a2 - t1*a2 + t2*a1"));
    let singular = run(&["4R", "--format", "singular"], "");
    assert!(singular.out.contains("poly f1 = t2 - t4;"), "{}", singular.out);
    let spherical = run(&["4R", "--format", "text", "--family", "spherical"], "");
    assert_eq!(spherical.out, "a1;\nd1;\na2;\nd2;\na3;\nd3;\na4;\nd4\n");
    assert_eq!(run(&["4R", "--format", "text", "--family", "cardan"], "").code, 1);
    let markdown = run(&["4R", "--explain"], "");
    assert!(markdown.code == 0 && markdown.out.starts_with("# General 4R loop\n") && markdown.out.contains("$$"));
}

#[test]
fn transference_is_shown() {
    let hooke = verb("derive", &["hooke", "--transference"], "");
    assert_eq!(hooke.code, 0, "{}", hooke.err);
    assert!(hooke.out.starts_with("spherical equation f of 2 terms"), "{}", hooke.out);
    assert!(hooke.out.contains("\nd4 = ("));
    let file = verb("derive", &["cccr_4_angle", "--transference", "--json"], "");
    let document: Value = serde_json::from_str(&file.out).unwrap();
    assert_eq!(document["offsets"][0]["name"], "d1");
    assert_eq!(verb("derive", &["puma560", "--transference"], "").code, 4);
    assert!(verb("derive", &["ccrr", "--transference", "--format", "maple"], "").out.contains("variables := "));
}

/// Bennett's loop in degrees, its second length given by a quotient of sines.
fn in_degrees(twist: &str, length: &str) -> String {
    let link = |a: &str, alpha: &str| format!("{{ type = \"R\", a = \"{a}\", alpha = \"{alpha} deg\", d = 0 }}");
    let joints = [link("100", "30"), link(length, twist)].join(", ");
    format!(
        "units = {{ length = \"mm\", angle = \"deg\" }}\n[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [{joints}, {joints}]\n"
    )
}

#[test]
fn numbers_of_one_field_are_taken_as_they_are() {
    for (twist, degree) in [("45", 4), ("41", 48)] {
        let length = format!("100*sin({twist} deg)/sin(30 deg)");
        let moves = run(&["-", "--json"], &in_degrees(twist, &length));
        let answer: Value = serde_json::from_str(&moves.out).unwrap();
        assert!(moves.code == 0 && answer["verdict"].as_str().unwrap().starts_with("moves: Bennett"), "{}", moves.out);
        assert_eq!(
            (&answer["proved"], &answer["proof"], &answer["rounded"]),
            (&true.into(), &"proved".into(), &false.into())
        );
        assert!(answer["field_degree"].as_u64().unwrap() <= degree);
        let rigid = run(&["-", "--json"], &in_degrees(twist, &(length + " + 1e-20")));
        let answer: Value = serde_json::from_str(&rigid.out).unwrap();
        assert!(
            rigid.code == 3 && answer["verdict"].as_str().unwrap().starts_with("does not move (proved"),
            "{}",
            rigid.out
        );
    }
}

#[test]
fn of_rounded_numbers_nothing_is_proved() {
    let rounded = in_degrees("45", "100*sin(1)/sin(2)");
    let run = run(&["-", "--json"], &rounded);
    let answer: Value = serde_json::from_str(&run.out).unwrap();
    assert_eq!((run.code, &answer["proved"], &answer["proof"]), (2, &false.into(), &"rounded-data".into()));
}

#[test]
fn certificates_are_of_the_general_loop_of_four_joints() {
    let path = std::env::temp_dir().join(format!("looproot-conditions-{}.cert", std::process::id()));
    let path = path.to_str().unwrap();
    let written = run(&["4r", "--quiet", "--certificate", path], "");
    assert_eq!((written.code, written.err.as_str()), (0, ""));
    let checked = verb("verify", &[path], "");
    assert!(checked.code == 0 && checked.out.contains("holds: 17 families"), "{}{}", checked.out, checked.err);
    let of_a_file = verb("verify", &[path, "--file", "bennett_a"], "");
    assert!(of_a_file.code == 2 && of_a_file.out.contains("refused: file"), "{}", of_a_file.out);
    std::fs::remove_file(path).unwrap();
    for other in ["5R", "bennett"] {
        let refused = run(&[other, "--certificate", path], "");
        assert!(refused.code == 4 && refused.err.contains("expected 4R"), "{other}: {} {}", refused.code, refused.err);
    }
}
