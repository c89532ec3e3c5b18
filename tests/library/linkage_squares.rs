//! Bars and legs in the plane whose lengths are square roots: their squares decide.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, LinkageFile, Options, any_from_text};
use looproot::internal::linkage::answer::{LinkageAnswer, solve};
use looproot::internal::verdict::{Proof, Status};

fn solved(joints: &str, bodies: &str, given: &str) -> LinkageAnswer {
    let text = format!(
        "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"g\"\njoints = [\n{joints}\n]\n[mechanism.bodies]\n{bodies}\n{given}"
    );
    let file: Box<LinkageFile> = match any_from_text(&text, "test.toml", Format::Toml, &Options::default()).unwrap() {
        Any::Linkage(file) => file,
        _ => panic!("a linkage in the plane"),
    };
    solve(&file.linkage, &file.cases[0].given, file.accuracy(&file.cases[0])).unwrap()
}

/// A crank about A and a bar from its end E to B.
fn crank_and_bar(end: &str, pivot: &str, length: &str) -> LinkageAnswer {
    let joints = format!(
        "{{ name = \"A\", type = \"R\", of = [\"g\", \"crank\"] }},\n\
         {{ name = \"bar\", type = \"RR\", of = [\"crank\", \"g\"], at = [\"E\", \"B\"], length = \"{length}\" }},"
    );
    solved(&joints, &format!("g = {{ A = [0, 0], B = {pivot} }}\ncrank = {{ A = [0, 0], E = {end} }}"), "")
}

#[test]
fn a_bar_of_irrational_length_turns_with_the_crank() {
    let moving = crank_and_bar("[4, 2]", "[0, 0]", "sqrt(20)");
    assert_eq!((moving.verdict.status, moving.verdict.proof), (Status::SelfMotion, Proof::Proved));
    assert_eq!((moving.verdict.self_motion, moving.families.len()), (1, 1));
    assert!(moving.families[0].sample.residual < 1e-12);
    let off = crank_and_bar("[4, 2]", "[0, 0]", "sqrt(21)");
    assert_eq!((off.verdict.status, off.verdict.proof), (Status::Unreachable, Proof::Proved));
}

#[test]
fn assemblies_of_irrational_bars_are_exact() {
    let two = crank_and_bar("[2, 1]", "[3, 0]", "sqrt(2)");
    assert_eq!((two.verdict.status, two.verdict.proof), (Status::Complete, Proof::Proved));
    assert_eq!((two.verdict.complex, two.verdict.real), (2, 2));
    // The end at (2, 1) and at (2, -1): the bar leads from there to (3, 0).
    for mode in &two.modes {
        let sign = mode.bodies[1].0.re.signum();
        let bar = mode.bodies[2].0.re;
        assert!((bar.abs() - std::f64::consts::FRAC_PI_4).abs() < 1e-12, "{sign} {bar}");
        assert!(mode.residual < 1e-12);
    }
    // Stretched: sqrt(5) + sqrt(5) = sqrt(20) between the pivots.
    let double = crank_and_bar("[2, 1]", "[4, 2]", "sqrt(5)");
    assert_eq!((double.verdict.status, double.verdict.proof), (Status::Complete, Proof::Proved));
    assert_eq!((double.modes.len(), double.modes[0].multiplicity), (1, 2));
    // Too far by a little.
    let far = crank_and_bar("[2, 1]", "[4, 2]", "sqrt(4.999999999999999999999)");
    assert_eq!((far.verdict.status, far.verdict.proof), (Status::Unreachable, Proof::Proved));
}

#[test]
fn a_platform_on_three_legs_of_irrational_lengths_is_complete() {
    let legs = ["A", "B", "C"].map(|name| {
        format!("{{ name = \"{name}\", type = \"RPR\", of = [\"g\", \"plate\"], at = [\"{name}\", \"{name}\"] }},")
    });
    let bodies = "g = { A = [0, 0], B = [4, 0], C = [1, 3] }\nplate = { A = [0, 0], B = [2, 1], C = [0, 1] }";
    // The plate at (1, 1), not turned: legs from A to (1, 1), from B to (3, 2), from C to (1, 2).
    let given =
        "[[input]]\ngiven = { A = { distance = \"sqrt(2)\" }, B = { distance = \"sqrt(5)\" }, C = { distance = 1 } }";
    let answer = solved(&legs.join("\n"), bodies, given);
    assert_eq!(
        (answer.verdict.status, answer.verdict.proof),
        (Status::Complete, Proof::Proved),
        "{}",
        answer.verdict.reason
    );
    let is_planted = |mode: &&looproot::internal::linkage::answer::LinkageMode| {
        let (angle, [x, y]) = &mode.bodies[1];
        mode.real && angle.re.abs() < 1e-9 && (x.re - 1.0).abs() < 1e-9 && (y.re - 1.0).abs() < 1e-9
    };
    assert!(answer.modes.iter().any(|mode| is_planted(&mode)));
}
