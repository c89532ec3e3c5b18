//! `looproot poly` as a shell sees it: answers, languages, complaints, jobs.
#![allow(clippy::unwrap_used)]

use serde_json::Value;
use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// The result of a run of `looproot poly`.
struct Run {
    code: i32,
    out: String,
    err: String,
}

fn run_with_input(arguments: &[&str], input: &[u8]) -> Run {
    let mut command = Command::new(env!("CARGO_BIN_EXE_looproot"));
    command.arg("poly").args(arguments).current_dir(crate::ROOT);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(input).unwrap();
    let output = child.wait_with_output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    let run = Run { code: output.status.code().unwrap_or(-1), out: text(output.stdout), err: text(output.stderr) };
    assert!(!run.err.contains("panicked"), "{arguments:?}: {}", run.err);
    run
}

fn run(arguments: &[&str]) -> Run {
    run_with_input(arguments, b"")
}

fn answer(arguments: &[&str]) -> String {
    let run = run(arguments);
    assert_eq!((run.code, run.err.as_str()), (0, ""), "{arguments:?}");
    run.out
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// A file of its own for each test.
fn file(name: &str, content: impl AsRef<[u8]>) -> String {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("poly").join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(&path, content).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn answers_read_as_agreed() {
    let mut text = String::new();
    for arguments in [
        &["expand", "(x + y/2)^2 - 0.25*y^2"][..],
        &["expand", "-x + 1", "x^2 - 3", "--vars", "x"],
        &["expand", "x - x"],
        &["expand", "2/3 + 1"],
        &["expand", "x^2*y - 1/3", "--format", "latex"],
        &["expand", "x^2*y - 1/3", "y", "--format", "msolve"],
        &["expand", "x^2*y - 1/3", "--json"],
        &["resultant", "x^2 + y^2 - 1", "x - y/3", "--eliminate", "x"],
        &["resultant", "a*x^2 + b*x + c", "2*a*x + b", "--eliminate", "x", "--vars", "a,b,c,x"],
        &["resultant", "x^2 + y^2 - 25", "x*y - 12", "--eliminate", "x", "--lift"],
        &["det", "[[x, 1/2], [2, x + 1]]"],
        &["det", "a, b; c, d"],
        &["roots", "(x - 1)^2*(x^2 - 2)*(x - 1/3)^3"],
        &["roots", "-x^3 + x", "--json"],
        &["factor-free", "6*(x + y)^2*(x - y)*(x*y - 1)^3"],
        &["factor-free", "-3/2*x^2", "--json"],
        &["gcd", "(x + y)*(x - 1)", "(x + y)*(y - 2)/3"],
        &["evaluate", "(x + 1)^100/7*y", "--at", "x=1/2,y=3"],
        &["evaluate", "(x + 1)^2*y", "--at", "x=0.5", "--vars", "x,y"],
        &["evaluate", "x*y", "--at", "x=1e-2,y=-3", "--json"],
    ] {
        text += &format!("$ looproot poly {}\n{}\n", arguments.join(" "), answer(arguments));
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden/poly.txt");
    if std::env::var_os("LOOPROOT_BLESS").is_some() {
        fs::write(path, &text).unwrap();
    }
    assert_eq!(text, fs::read_to_string(path).unwrap_or_default());
}

#[test]
fn complaints_name_what_was_found_and_exit_with_1() {
    for (arguments, words) in [
        (&["expand", "x + 2y"][..], "`x + 2y`, column 6: found `y` where an operator should stand"),
        (&["expand", "alpha + bta", "--vars", "alpha,beta"], "did you mean `beta`?"),
        (&["expand", "x^2147483648"], "exponent above 1073741823"),
        (&["expand", "(x^1073741823)^2"], "exponent above 1073741823"),
        (&["expand", "x/(1 - 1)"], "column 3: found a division by zero"),
        (&["expand", "(a + b + c + 1)^1000"], "terms"),
        (&["expand", "x", "--vars", "x,x"], "`x` twice"),
        (&["expand", "x", "--vars", "2x"], "`2x`"),
        (&["expand", "1", "--format", "msolve"], "without any variable"),
        (&["expand", "@no/such/file"], "no/such/file"),
        (&["expand", "@src"], "found a directory"),
        (&["resultant", "x", "--eliminate", "x"], "found 1 polynomials, expected 2"),
        (&["resultant", "x", "y", "--eliminate", "z"], "unknown variable `z`"),
        (&["resultant", "x", "y"], "--eliminate"),
        (&["det", "1, 2"], "expected as many"),
        (&["det", "[[1, 2], [3]]"], "one of 1 entries"),
        (&["roots", "x*y - 1"], "found the variables x, y"),
        (&["roots", "7"], "found a number"),
        (&["roots", "x^1000000000 - 1"], "degree 1000000000"),
        (&["det", "[[x^1000000000]]"], "degree 1000000000"),
        (&["resultant", "x^1000000000", "x - 1", "--eliminate", "x"], "degree 1000000000"),
        (&["expand", "((x - x + 2)^1000000000)^1000000000"], "digits"),
        (&["roots", "x - x"], "found a number"),
        (&["factor-free", "0"], "found zero"),
        (&["evaluate", "x", "--at", "x"], "found `x` behind --at"),
        (&["evaluate", "x", "--at", "y=1"], "unknown variable `y`"),
        (&["evaluate", "x", "--at", "x=1,x=2"], "found two values"),
        (&["evaluate", "x", "--at", "x=1/0"], "division by zero"),
        (&["evaluate", "(x + 1)^1000000000", "--at", "x=3/2"], "expected a shorter one"),
        (&["job", "README.md"], "no JSON"),
        (&["job", "no/such/file"], "no/such/file"),
        (&["dance"], "dance"),
    ] {
        let run = run(arguments);
        assert_eq!((run.code, run.out.as_str()), (1, ""), "{arguments:?}");
        assert!(run.err.contains(words), "{arguments:?}: {}", run.err);
    }
    let path = file("wrong.txt", "x - 1;\n  y^2 -\n z z;\n");
    let run = run(&["expand", &path]);
    assert!(run.code == 1 && run.err.contains("wrong.txt:3: column 4: found `z` where"), "{}", run.err);
}

#[test]
fn files_and_standard_input_hold_polynomials() {
    let text = file("system.txt", "# a circle and a line\nx^2 + y^2 - 1;\nx - y/3\n");
    let direct = answer(&["resultant", "x^2 + y^2 - 1", "x - y/3", "--eliminate", "x"]);
    assert_eq!(answer(&["resultant", &text, "--eliminate", "x"]), direct);
    let document = file("system.json", "");
    assert_eq!(answer(&["expand", &text, "--json", "-o", &document]), "");
    assert_eq!(answer(&["resultant", &format!("@{document}"), "--eliminate", "x"]), direct);
    let piped = run_with_input(&["resultant", "-", "--eliminate", "x"], &fs::read(&document).unwrap());
    assert_eq!((piped.code, piped.out), (0, direct));
    // Output for people can be read again.
    let again = run_with_input(&["resultant", "-", "--eliminate", "x"], answer(&["expand", &text]).as_bytes());
    assert_eq!((again.code, again.out), (0, answer(&["resultant", &text, "--eliminate", "x"])));
    let refused = run(&["expand", &text, "-o", &text]);
    assert!(refused.code == 1 && refused.err.contains("never changed"), "{}", refused.err);
    assert!(fs::read_to_string(&text).unwrap().starts_with("# a circle"));
}

#[test]
fn no_real_root_is_an_answer_of_its_own() {
    let run = run(&["roots", "x^2 + 1"]);
    let verdict = "no real roots of degree 2 in x; Sturm's theorem counts 0\n";
    assert_eq!((run.code, run.out.as_str(), run.err.as_str()), (3, verdict, ""));
}

#[test]
fn a_million_terms_are_read() {
    let mut text = String::new();
    for k in 0..1_000_000_u64 {
        // Every residue once: 1000003 is prime, and no exponent comes twice.
        text += &format!("+{}*x^{}*y^{}", k * 7919 % 1_000_003 + 1, k % 1000, k / 1000);
    }
    let path = file("million.txt", &text);
    let out = file("million.out", "");
    assert_eq!(answer(&["expand", &path, "-o", &out]), "");
    let result = fs::read_to_string(&out).unwrap();
    fs::remove_file(&path).unwrap();
    fs::remove_file(&out).unwrap();
    assert!(result.starts_with("# degree 1998 (999 in x, 999 in y), 1000000 terms, content 1\n"), "{}", &result[..80]);
}

#[test]
fn jobs_print_their_three_lines() {
    for (name, terms, value) in [
        ("polydet", "3", "-137/42"),
        ("mpolydet", "5", "33"),
        ("res", "2", "9"),
        ("expand", "6", "5623"),
        ("mul", "28", "46764"),
        ("gcd", "3", "26"),
        ("roots", "3", "3"),
        ("roots_poly", "4", "4"),
    ] {
        let out = answer(&["job", &format!("tests/jobs/{name}.json"), "--seconds", "0"]);
        let lines: Vec<(&str, &str)> = out.lines().map(|line| line.split_once(' ').unwrap()).collect();
        assert_eq!((lines[0].0, lines[1].0), ("T", "READ"), "{name}");
        assert!(lines[0].1.parse::<f64>().unwrap() > 0.0 && lines[1].1.parse::<f64>().unwrap() > 0.0, "{name}");
        assert_eq!(lines[2..4], [("TERMS", terms), ("VAL", value)], "{name}");
    }
    for (content, code, words) in [
        ("{\"kind\": \"gb\"}", 4, "kind `gb`"),
        ("{\"kind\": \"res\", \"vars\": [\"x\"], \"f\": \"x\"}", 1, "`g`: found null, expected a string"),
        ("{\"kind\": \"mul\", \"vars\": [\"x\"], \"f\": \"x\", \"g\": \"y\"}", 1, "unknown variable `y`"),
        ("{\"kind\": \"polydet\", \"M\": [[[\"1\"], [\"2\"]]]}", 1, "expected a square"),
        ("{\"kind\": \"polydet\", \"M\": [[[\"1/0\"]]]}", 1, "division by zero"),
        ("{\"kind\": \"roots\", \"coefficients\": [\"0\"]}", 1, "found zero"),
        (
            "{\"kind\": \"expand\", \"vars\": [\"x\"], \"expr\": \"x^2\", \"div\": \"x+1\", \"times\": 1}",
            1,
            "remainder",
        ),
    ] {
        let run = run(&["job", &file("job.json", content)]);
        assert!(run.code == code && run.err.contains(words), "{content}: {}", run.err);
    }
}

#[test]
fn help_and_completions_know_the_verbs() {
    let help = answer(&["--help"]);
    for verb in ["expand", "resultant", "det", "roots", "factor-free", "gcd", "evaluate", "job"] {
        assert!(help.contains(verb), "{verb}");
    }
    let mut command = Command::new(env!("CARGO_BIN_EXE_looproot"));
    let completions = command.args(["completions", "bash"]).output().unwrap();
    let completions = String::from_utf8(completions.stdout).unwrap();
    assert!(completions.contains("factor-free") && completions.contains("macaulay2"));
    assert_eq!(json(&answer(&["evaluate", "x", "--at", "x=1/4", "--json"]))["f64"], 0.25);
}

#[test]
fn real_roots_are_isolated_from_degree_200_on() {
    // Roots of x^n - 2; of Mignotte's polynomial two roots are nearer to each other than 2^-2900.
    let cases: [(&str, &[f64]); 4] = [
        ("x^200-3", &[-1.005_508_175_967_681_4, 1.005_508_175_967_681_4]),
        ("x^400-2", &[-1.001_734_370_234_696, 1.001_734_370_234_696]),
        ("x^401-2", &[1.001_730_041_382_737_5]),
        (
            "x^290-2*(2^20*x-1)^2",
            &[-1.103_709_974_172_892_8, 9.536_743_164_062_5e-7, 9.536_743_164_062_5e-7, 1.103_709_960_927_416_4],
        ),
    ];
    for (polynomial, expected) in cases {
        let document = json(&run(&["roots", polynomial, "--json"]).out);
        let roots = document["roots"].as_array().unwrap();
        assert_eq!(roots.len(), expected.len(), "{polynomial}");
        for (root, expected) in roots.iter().zip(expected) {
            let value = root["value"].as_f64().unwrap();
            assert!((value / expected - 1.0).abs() < 1e-12, "{polynomial}: {value} {expected}");
        }
    }
}
