//! Output for readers, compared as text with the files of tests/golden. `LOOPROOT_BLESS=1 cargo test --test library golden::`
//! writes them anew: read the difference before you commit it.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::entry::Entry;
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::kinematics::velocity::Velocity;
use looproot::internal::mechanism::{FullMode, PlatformAnswer, PlatformMode, Solution};
use looproot::internal::report::text::{View, solution};
use looproot::internal::report::{json, model};
use looproot::internal::verdict::{Code, Proof, Status, Verdict};
use num_complex::Complex;
use std::fs;
use std::path::PathBuf;

fn compare(name: &str, text: &str) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(name);
    if std::env::var_os("LOOPROOT_BLESS").is_some() {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, text).unwrap();
    }
    let golden = fs::read_to_string(&path).unwrap_or_default();
    assert!(golden == text, "tests/golden/{name} says\n{golden}\nbut now it is\n{text}");
}

/// A loop with a cylindrical joint and limits: every sort of column.
fn entry() -> Entry {
    let text = r#"
        title = "Golden loop"
        [mechanism]
        kind = "loop"
        convention = "dh"
        joints = [
            { type = "R", a = 1, alpha = "pi/3", d = 0 }, { type = "C", a = "1/3", alpha = 0.5 },
            { type = "R", a = 2, alpha = "-30 deg", d = "150 mm", theta0 = "pi/7" }, { type = "P", a = 0, alpha = 1, theta = 0 },
            { type = "R", a = 1, alpha = 1, d = 0 }, { type = "R", a = 1, alpha = 1, d = 1 },
        ]
        limits = [[-1, 1], [-2, 2], [0, 0.5], [-3, 3], [0, 1], [-3, 3], ["-180 deg", "180 deg"]]
        [[input]]
        joint = 6
        angle = "90 deg"
        [[input]]
        joint = 4
        distance = "250 mm"
    "#;
    load_text(text, "golden.toml", Format::Toml, &Options::default()).unwrap()
}

fn mode(real: bool, multiplicity: usize, certified: bool) -> FullMode {
    let im = if real { 0.0 } else { -0.25 };
    let q = [0.1, -3.0, 0.375, std::f64::consts::PI, -0.0, 1e-9, 1.5].map(|re| Complex::new(re, im));
    FullMode {
        q: q.to_vec(),
        real,
        multiplicity,
        residual: 2.2e-16,
        condition: if certified { 21.4 } else { f64::INFINITY },
        certified,
        radius: if certified { 2e-15 } else { f64::INFINITY },
        within_limits: real.then_some(multiplicity == 1),
        near: false,
        error: None,
        platform: None,
    }
}

fn answer(status: Status, modes: Vec<FullMode>, reason: &str) -> Solution {
    let count = |real: bool| modes.iter().filter(|m| m.real || !real).map(|m| m.multiplicity.max(1)).sum();
    let verdict = Verdict {
        status,
        proof: if status == Status::Complete { Proof::Proved } else { Proof::None },
        code: Code::CountMet,
        complex_complete: status == Status::Complete,
        complex: count(false),
        real: count(true),
        at_infinity: if status == Status::Complete { 12 } else { 0 },
        self_motion: usize::from(status == Status::SelfMotion),
        certified: modes.iter().filter(|m| m.certified).count(),
        reason: reason.to_owned(),
    };
    let warnings = vec!["the rotation matrix is off by 3e-7; the nearest rotation was taken".to_owned()];
    Solution {
        nearest: None,
        arm: None,
        families: Vec::new(),
        verdict,
        modes,
        warnings,
        prepare_us: 71.25,
        solve_us: 46.0,
        platform: None,
    }
}

fn answers() -> Vec<(&'static str, Solution)> {
    let proved = "4 distinct certified roots of a closure polynomial";
    let simple = || mode(true, 1, true);
    vec![
        ("complete", answer(Status::Complete, vec![simple(), mode(true, 2, false), mode(false, 1, true)], proved)),
        ("unreachable", answer(Status::Unreachable, vec![mode(false, 1, true), mode(false, 1, true)], proved)),
        ("incomplete", answer(Status::Incomplete, vec![simple(), mode(true, 0, false)], "not proved: a singular root")),
        ("nothing", answer(Status::Incomplete, Vec::new(), "structurally deficient")),
        ("self-motion", answer(Status::SelfMotion, vec![simple()], "solutions form a self-motion of dimension 1")),
        ("unsupported", answer(Status::Unsupported, Vec::new(), "joints of type H")),
    ]
}

#[test]
fn solutions_read_as_agreed() {
    let entry = entry();
    let views = [
        ("default", View::default()),
        ("complex, colour", View { complex: true, colour: true, ..View::default() }),
        ("drop", View { drop_outside_limits: true, ..View::default() }),
        ("quiet", View { quiet: true, ..View::default() }),
    ];
    let mut text = String::new();
    for (name, answer) in answers() {
        // All views of the first answer, the default one of the others.
        let shown = if name == "complete" { &views[..] } else { &views[..1] };
        for (view_name, view) in shown {
            text += &format!("=== {name}, {view_name}\n");
            text += &solution(&entry, 1, &entry.cases[0], &answer, view).replace('\x1b', "ESC");
        }
    }
    compare("solutions.txt", &text);
}

#[test]
fn documents_read_as_agreed() {
    let mut text = json::head(&entry(), &looproot::internal::report::document::keys(&entry())) + "\n";
    let labels = looproot::internal::report::document::labels(&entry());
    let view = View { complex: true, ..View::default() };
    for (_, answer) in answers() {
        text += &format!("{}\n", json::result(1, &entry().cases[0], &answer, &labels, &view));
    }
    compare("results.json.txt", &text);
}

/// An arm by its screw axes, with a source, notes, a tool and claims.
fn screws() -> Entry {
    let axis = |axis: &str, point: &str| format!("{{ type = \"R\", axis = {axis}, point = {point} }},\n");
    let joints = axis("[0, 0, 1]", "[0, 0, 0]")
        + &axis("[0, -1, 0]", "[0, 0, \"152 mm\"]").repeat(3)
        + &axis("[0, 0, 3]", "[1, 0, 0]").repeat(2);
    let text = format!(
        r#"
        title = "Golden arm"
        source = {{ key = "LeeLiang1988", where = "nowhere" }}
        notes = "Set up for this test, with a remark that is long enough to need a second line when it is printed."
        [mechanism]
        kind = "arm"
        convention = "screws"
        home = [[1, 0, 0, "-1/3"], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]]
        tool = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.05], [0, 0, 0, 1]]
        joints = [{joints}]
        [[pose]]
        position = [1, 2, 3]
        quaternion = [1, 0, 0, 0]
        expected = {{ complex = 8, real = 2 }}
        [[pose]]
        position = [1, 2, 3]
        quaternion = [1, 0, 0, 0]
        expected = {{ complex = 16, real = 2, dimension = 0 }}
        solution = [{{ q = [0, 0, 0, 0, 0, 0], digits = 3 }}]
        "#
    );
    load_text(&text, "arm.toml", Format::Toml, &Options::default()).unwrap()
}

/// A platform with two sets of legs.
fn platform() -> Entry {
    let text = r#"
        title = "Golden platform"
        source = { key = "Dietmaier1998" }
        [mechanism]
        kind = "platform"
        base = [[0, 0, 0], [1, 0, 0], [1, "2/3", 0], [0, 0.5, 0], [0, 0, 0], [0.25, 0.125, 0]]
        plate = [[0, 0, 0], [1, 0, 0], [1, "2/3", 0], [0, 0.5, 0], [1, 1, 0], [1, 1, 0]]
        [[legs]]
        lengths = [1, 2, "sqrt(2)", "150 cm", 1, 0]
        expected = { complex = 40, real = 2 }
        solution = [{ quaternion = [0.6, 0, 0, 0.8], position = [1, 2, 3], digits = 3 }]
        [[legs]]
        squared = [1, 4, 2, 3, 5, 6]
    "#;
    load_text(text, "platform.toml", Format::Toml, &Options::default()).unwrap()
}

fn pose(real: bool, mirror: Option<usize>) -> FullMode {
    let q = [0.6, 0.0, -0.8, 0.0, 1.25, -3.5, 1e-9].map(|re| Complex::new(re, if real { 0.0 } else { 0.25 }));
    let velocity = Velocity { singular_values: [2.0, 1.0, 0.5, 0.25, 0.125, 0.1], twist: None };
    FullMode {
        q: q.to_vec(),
        within_limits: None,
        near: false,
        error: None,
        platform: Some(PlatformMode { velocity: real.then_some(velocity), mirror, outside: Vec::new() }),
        ..mode(real, 1, true)
    }
}

#[test]
fn platforms_read_as_agreed() {
    let entry = platform();
    let legs = [1.0, 2.0, 2.0_f64.sqrt(), 1.5, 1.0, 0.0];
    let answered = |status, modes, reason: &str| Solution {
        arm: None,
        families: Vec::new(),
        platform: Some(PlatformAnswer { legs, route: "the only one".to_owned(), outside: Vec::new() }),
        ..answer(status, modes, reason)
    };
    let proved = "3 distinct certified roots of a test";
    let modes = vec![pose(true, Some(2)), pose(true, Some(1)), pose(false, None)];
    let answers = [
        answered(Status::Complete, modes, proved),
        answered(Status::Unreachable, vec![pose(false, None)], proved),
        answered(Status::Unreachable, Vec::new(), proved),
        answered(Status::SelfMotion, Vec::new(), "poses form a self-motion of dimension 1"),
    ];
    let mut text = model::text(&entry);
    for answer in &answers {
        let answer =
            Solution { arm: None, verdict: Verdict { at_infinity: 0, ..answer.verdict.clone() }, ..answer.clone() };
        text += &format!("===\n{}", solution(&entry, 1, &entry.cases[0], &answer, &View::default()));
        let view = View { complex: true, ..View::default() };
        text += &format!("{}\n", json::result(1, &entry.cases[0], &answer, &[], &view));
    }
    text += &format!("===\n{:#}\n", model::json(&entry));
    compare("platforms.txt", &text);
}

#[test]
fn models_read_as_agreed() {
    compare("models.txt", &[model::text(&entry()), model::text(&screws())].join("===\n"));
    compare("model.json", &format!("{:#}\n", model::json(&screws())));
}
