//! Loops of fewer than six unknowns: overconstrained mechanisms, their controls, and structures.

use looproot::algebra::number::Number;
use looproot::assembly::{Assembly, Roots, Workspace};
use looproot::catalogue::entry::{Design, Entry};
use looproot::catalogue::{Format, Options, builtin, load_text};
use looproot::kinematics::chain::Geometry;
use looproot::mechanism::{InputCurve, Mechanism, Solution};
use looproot::verdict::Status;
use rug::Rational;

fn solve(entry: &Entry, case: usize) -> Solution {
    let mechanism = Mechanism::prepare(entry).unwrap();
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    mechanism.solve(&entry.cases[case], Roots::All, &mut workspace, &mut assembly).unwrap()
}

fn read(text: &str) -> Result<Entry, looproot::error::Error> {
    load_text(text, "test.toml", Format::Toml, &Options::default())
}

fn bennett(joints: &str, rest: &str) -> String {
    format!("title = \"loop\"\n[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n{joints}]\n{rest}")
}

const LINKS: &str = "{ type = \"R\", a = 4, tan_half_alpha = \"1/2\", d = 0 },\n\
                     { type = \"R\", a = 3, tan_half_alpha = \"1/3\", d = 0 },\n";

#[test]
fn a_link_off_by_a_billionth_leaves_no_solution() {
    // Of a double root in f64 nothing could be said: the exact count decides, and the closure is off by 1e-9 only.
    let names = [
        "bennett_a",
        "goldberg_a",
        "myard_a",
        "bricard_line_symmetric_a",
        "bricard_plane_symmetric_a",
        "bricard_trihedral_a",
        "wohlhart_hybrid_a",
        "dietmaier_a",
        "double_goldberg",
    ];
    for name in names {
        for power in [3, 6, 9] {
            let mut entry = builtin(name, &Options::default()).unwrap();
            let Design::Loop(chain) = &mut entry.design else { panic!("{name} is a loop") };
            let Geometry::Dh(joints) = &mut chain.geometry else { panic!("{name} has DH joints") };
            let off = Rational::from((1, 10_i64.pow(power)));
            joints[1].a = Number::exact(Rational::from(joints[1].a.rational() + &off));
            let found = solve(&entry, 0);
            let verdict = found.verdict;
            assert_eq!((verdict.status, verdict.complex), (Status::Unreachable, 0), "{name} 1e-{power}");
            assert!(verdict.reason.contains("no common root"), "{}", verdict.reason);
        }
    }
}

#[test]
fn a_bennett_loop_folds_where_idle_translations_see_a_double_root() {
    let text = bennett(&LINKS.repeat(2), "[[input]]\njoint = 1\nangle = 0\n[[input]]\njoint = 1\nangle = \"pi\"\n");
    let entry = read(&text).unwrap();
    for case in 0..2 {
        let found = solve(&entry, case);
        assert_eq!((found.verdict.status, found.verdict.complex), (Status::Complete, 1), "{}", found.verdict.reason);
        assert_eq!(found.modes[0].multiplicity, 1);
        assert!(found.modes[0].certified && found.modes[0].residual < 1e-14);
    }
}

#[test]
fn rounded_data_close_but_prove_nothing() {
    let links = "{ type = \"R\", a = \"sin(2*pi/9)\", alpha = \"2*pi/9\", d = 0 },\n\
                 { type = \"R\", a = \"sin(7*pi/18)\", alpha = \"7*pi/18\", d = 0 },\n";
    let entry = read(&bennett(&links.repeat(2), "[[input]]\njoint = 1\nangle = 1\n")).unwrap();
    let found = solve(&entry, 0);
    assert_eq!((found.verdict.status, found.verdict.real, found.verdict.certified), (Status::Incomplete, 1, 0));
    assert!(found.verdict.reason.contains("rounded"), "{}", found.verdict.reason);
}

#[test]
fn a_loop_without_input_moves_or_is_a_structure() {
    let moving = solve(&read(&bennett(&LINKS.repeat(2), "")).unwrap(), 0).verdict;
    assert_eq!((moving.status, moving.self_motion), (Status::SelfMotion, 1), "{}", moving.reason);
    // The same with one link too long.
    let rigid = bennett(&(LINKS.repeat(2).replacen("a = 3", "a = \"31/10\"", 1)), "");
    let rigid = solve(&read(&rigid).unwrap(), 0).verdict;
    assert_eq!((rigid.status, rigid.complex), (Status::Unreachable, 0), "{}", rigid.reason);
    let structure = solve(&builtin("structure_6r", &Options::default()).unwrap(), 0).verdict;
    assert_eq!((structure.status, structure.complex), (Status::Complete, 16));
}

#[test]
fn a_loop_of_seven_variables_without_input_says_what_it_needs() {
    let message = read(&bennett(&LINKS.repeat(4)[..LINKS.len() * 7 / 2], "")).unwrap_err().to_string();
    assert!(message.contains("no [[input]]") && message.contains("mobility of 1"), "{message}");
}

#[test]
fn an_overconstrained_loop_with_a_ball_is_refused() {
    let links = format!("{LINKS}{{ type = \"S\", a = 1, tan_half_alpha = 0 }},\n");
    let entry = read(&bennett(&links, "[[input]]\njoint = 1\nangle = 1\n")).unwrap();
    let message = Mechanism::prepare(&entry).map(|_| ()).unwrap_err().to_string();
    assert!(message.contains("overconstrained loop with an S joint"), "{message}");
}

#[test]
fn velocities_of_a_bennett_loop_are_those_of_its_closed_form() {
    // tan(q1/2) tan(q2/2) = -5, q3 = -q1, q4 = -q2.
    let entry = builtin("bennett_a", &Options::default()).unwrap();
    let curve = InputCurve::of(&entry, &entry.cases[0]).unwrap();
    let found = solve(&entry, 0);
    let derivatives = curve.derivatives(&found.modes[0]).unwrap();
    let x: f64 = 0.5;
    let rate = 5.0 * (1.0 + x * x) / (x * x + 25.0);
    for (velocity, expected) in derivatives.velocity.iter().zip([1.0, rate, -1.0, -rate]) {
        assert!((velocity - expected).abs() < 1e-12, "{velocity} {expected}");
    }
}
