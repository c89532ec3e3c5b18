//! Loops of fewer than six unknowns: overconstrained mechanisms, their controls, and structures.

use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::entry::{Case, Design, Entry, Input, InputValue};
use looproot::internal::catalogue::{Format, Options, builtin, load_text};
use looproot::internal::elimination::coordinate_ring::Plan;
use looproot::internal::elimination::degree::half_tangent_pair;
use looproot::internal::kinematics::chain::Geometry;
use looproot::internal::kinematics::closed_loop::{Layout, OpenLoop};
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::mechanism::{InputCurve, Mechanism, Solution, locked_variable};
use looproot::internal::verdict::Status;
use looproot_algebra::modp::{ModP, PRIME_61};
use looproot_algebra::number::{Angle, HalfTangent, Number};
use rug::Rational;

fn solve(entry: &Entry, case: usize) -> Solution {
    let mechanism = Mechanism::prepare(entry).unwrap();
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    mechanism.solve(&entry.cases[case], Roots::All, &mut workspace, &mut assembly).unwrap()
}

fn read(text: &str) -> Result<Entry, looproot::internal::error::Error> {
    load_text(text, "test.toml", Format::Toml, &Options::default())
}

fn bennett(joints: &str, rest: &str) -> String {
    format!("title = \"loop\"\n[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n{joints}]\n{rest}")
}

const LINKS: &str = "{ type = \"R\", a = 4, tan_half_alpha = \"1/2\", d = 0 },\n\
                     { type = \"R\", a = 3, tan_half_alpha = \"1/3\", d = 0 },\n";

#[test]
fn a_link_off_by_a_billionth_leaves_no_solution() {
    // f64 decides nothing about a double root: the exact count does, and the closure is off by 1e-9 only.
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
            assert!(verdict.reason.starts_with("no solution"), "{}", verdict.reason);
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
    // The same loop with one link too long.
    let rigid = bennett(&(LINKS.repeat(2).replacen("a = 3", "a = \"31/10\"", 1)), "");
    let rigid = solve(&read(&rigid).unwrap(), 0).verdict;
    assert_eq!((rigid.status, rigid.complex), (Status::Unreachable, 0), "{}", rigid.reason);
    let structure = solve(&builtin("structure_6r", &Options::default()).unwrap(), 0).verdict;
    assert_eq!((structure.status, structure.complex), (Status::Complete, 16));
}

#[test]
fn a_loop_of_seven_variables_without_input_says_what_it_needs() {
    let message = read(&bennett(&LINKS.repeat(4)[..LINKS.len() * 7 / 2], "")).unwrap_err().to_string();
    assert!(
        message.contains("no [[input]]") && message.contains("mobility 1 by Gruebler's count (7 - 6)"),
        "{message}"
    );
}

/// A planar four-bar may have a spherical joint for one of its revolutes: the two positions of its closed form.
#[test]
fn an_overconstrained_loop_with_a_ball_is_solved_by_its_centre() {
    let joint = |kind: char, a: i32| format!("{{ type = \"{kind}\", a = {a}, alpha = 0, d = 0 }},\n");
    let input = "[[input]]\njoint = 1\ntan_half = \"1/2\"\n";
    // cos q1 = 3/5, sin q1 = 4/5: the diagonal from joint 2 to joint 1 by way of link 4.
    let diagonal = (16.0_f64 + 4.0 + 2.0 * 4.0 * 2.0 * 0.6).sqrt();
    let inner = ((9.0 + 9.0 - diagonal * diagonal) / 18.0).acos();
    for spherical in [2, 3, 4] {
        let kind = |k: usize| if k == spherical { 'S' } else { 'R' };
        let links: String = (1..).zip([2, 3, 3, 4]).map(|(k, a)| joint(kind(k), a)).collect();
        let found = solve(&read(&bennett(&links, input)).unwrap(), 0);
        let verdict = &found.verdict;
        assert_eq!((verdict.status, verdict.complex, verdict.real), (Status::Complete, 2, 2), "{}", verdict.reason);
        // The angle of joint 3, which turns by the angle outside of the triangle.
        let third = if spherical == 2 { 4 } else { 2 };
        for mode in &found.modes {
            assert!(mode.residual < 1e-14 && mode.multiplicity == 1, "{spherical}: {:e}", mode.residual);
            assert!(mode.certified && mode.radius < 1e-10 && mode.condition < 1e6, "{spherical}: {:e}", mode.radius);
            if spherical != 3 {
                let turn = mode.q[third].re.abs();
                assert!((turn - (std::f64::consts::PI - inner)).abs() < 1e-12, "{spherical}: {turn} {inner}");
            }
        }
        // A joint off by a hair closes nothing.
        let off = links.replacen("d = 0", "d = \"1/1000000\"", 1);
        let verdict = solve(&read(&bennett(&off, input)).unwrap(), 0).verdict;
        assert_eq!((verdict.status, verdict.complex), (Status::Unreachable, 0), "{}", verdict.reason);
        let verdict = solve(&read(&bennett(&links, "")).unwrap(), 0).verdict;
        assert_eq!(verdict.status, Status::SelfMotion, "{}", verdict.reason);
    }
}

/// Common roots of two closure polynomials, and the dimension of the ring of the equations themselves: two counts of the
/// solutions of an overconstrained loop that have nothing in common.
#[test]
fn two_exact_counts_agree() {
    for name in [
        "bennett_a",
        "goldberg_a",
        "myard_a",
        "bricard_trihedral_a",
        "rrcrp_a",
        "rrrrp_parallel_pairs",
        "bennett_broken",
    ] {
        let entry = builtin(name, &Options::default()).unwrap();
        let chain = entry.chain().unwrap();
        let locked = locked_variable(chain, &entry.cases[0]).unwrap();
        let layout = Layout::of(chain, locked).unwrap();
        let filled = layout.with_idle(layout.missing(), 5);
        let open: OpenLoop<ModP<PRIME_61>> = chain.open_loop(&filled).unwrap();
        let half_tangent = ModP::new(3);
        let (cos, sin) = half_tangent_pair(&half_tangent).unwrap();
        let is_idle = filled.joint_variables().map(|joint| joint.is_none());
        let count = Plan::at_zero(&open.close(&Motion::rotation_z(cos, sin)), is_idle).map(|plan| plan.count());
        let mut entry = entry;
        entry.cases = vec![Case::given(
            Input { joint: 1, value: InputValue::Angle(Angle::from_half_tangent(HalfTangent::Finite(3.into()))) },
            0,
        )];
        let found = solve(&entry, 0).verdict;
        assert_eq!(count, Some(found.complex), "{name}: {}", found.reason);
    }
}

/// A triangle of a revolute joint and two spherical joints: the two positions of its closed form, without input, and no other way to
/// close.
#[test]
fn a_structure_of_two_balls_needs_no_input() {
    let joints = "{ type = \"R\", a = 3, alpha = 0, d = 0 },\n{ type = \"S\", a = 4, alpha = 0 },\n{ type = \"S\", a = 2, alpha = 0 },\n";
    let found = solve(&read(&bennett(joints, "")).unwrap(), 0);
    let verdict = &found.verdict;
    assert_eq!((verdict.status, verdict.real, verdict.certified), (Status::Complete, 2, 2), "{}", verdict.reason);
    // 16 = 9 + 4 + 12 cos q1.
    for mode in &found.modes {
        assert!((mode.q[0].re.cos() - 0.25).abs() < 1e-14 && mode.residual < 1e-14);
    }
    let message = Mechanism::prepare(&read(&bennett(joints, &at("1"))).unwrap()).map(|_| ()).unwrap_err();
    assert!(message.exit_code() == 4 && message.to_string().contains("or RSS without"), "{message}");
}

/// The second spherical joint on the axis of the last joint: the input alone decides whether the loop closes, and then that joint turns on.
#[test]
fn a_ball_on_the_axis_of_its_neighbour_turns_on_or_never_closes() {
    let joint = |kind: char, a: i32| format!("{{ type = \"{kind}\", a = {a}, alpha = 0, d = 0 }},\n");
    let joints: String = [('R', 3), ('S', 5), ('S', 0), ('R', 4)].into_iter().map(|(kind, a)| joint(kind, a)).collect();
    for (angle, status) in [("\"pi/2\"", Status::SelfMotion), ("1", Status::Unreachable)] {
        let verdict = solve(&read(&bennett(&joints, &at(angle))).unwrap(), 0).verdict;
        assert_eq!((verdict.status, verdict.complex), (status, 0), "{}", verdict.reason);
    }
}

/// The angle of joint 1 as input.
fn at(angle: &str) -> String {
    format!("[[input]]\njoint = 1\nangle = {angle}\n")
}

/// Every branch of the route of a spherical joint: what is planted is found, with its multiplicity.
#[test]
fn planted_positions_of_a_ball_are_found() {
    let link = |kind: char, a: &str, twist: &str, own: &str| {
        format!("{{ type = \"{kind}\", a = \"{a}\", tan_half_alpha = \"{twist}\", {own} }},\n")
    };
    let spherical = link('S', "0", "0", "d = 0");
    // Both arms stretched: a double root.
    let (long, short) = (link('R', "4", "0", "d = 0"), link('R', "2", "0", "d = 0"));
    let stretched = solve(&read(&bennett(&(long + &short + &short + &spherical), &at("0"))).unwrap(), 0);
    let verdict = &stretched.verdict;
    assert_eq!((verdict.status, verdict.complex, verdict.real), (Status::Complete, 2, 2), "{}", verdict.reason);
    assert!(stretched.modes.len() == 1 && stretched.modes[0].multiplicity == 2);
    // The centre on the axis of a revolute joint: it turns on.
    let still = link('R', "0", "1/2", "d = 0").repeat(2) + &spherical;
    assert_eq!(solve(&read(&bennett(&still, &at("0"))).unwrap(), 0).verdict.status, Status::SelfMotion);
    // A slider between: rotation and translation, translation and rotation, two translations, one of either.
    let slider = link('P', "0", "1", "tan_half_theta = 0");
    let across = link('P', "0", "1", "tan_half_theta = 1") + &link('P', "0", "0", "tan_half_theta = 0");
    for (links, complex) in [
        (link('R', "1", "0", "d = 0") + &link('R', "2", "1", "d = 0") + &slider + &spherical, 2),
        (link('R', "1", "1", "d = 0") + &slider + &link('R', "2", "0", "d = 0") + &spherical, 2),
        (link('R', "1", "1", "d = 0") + &across + &spherical, 1),
        (link('R', "1", "1", "d = 0") + &slider + &spherical, 0),
    ] {
        let found = solve(&read(&bennett(&links, &at("0"))).unwrap(), 0);
        assert_eq!(found.verdict.complex, complex, "{links}{}", found.verdict.reason);
        for mode in &found.modes {
            assert!(mode.residual < 1e-13, "{links}{:e}", mode.residual);
            assert!(mode.certified && mode.multiplicity == 1, "{links}");
        }
    }
}

/// The error for a loop that is not solved: its mobility by Gruebler's count and by screws, and the missing part.
#[test]
fn mobility_is_named_where_a_loop_is_not_solved() {
    let joint = |kind: char, own: &str| format!("{{ type = \"{kind}\", a = 1, tan_half_alpha = \"2/3\", {own} }},\n");
    let general = |kinds: &str| -> String {
        let own = |kind| match kind {
            'P' => "tan_half_theta = \"1/4\"",
            'C' => "d0 = 0",
            _ => "d = 2",
        };
        kinds.chars().map(|kind| joint(kind, own(kind))).collect()
    };
    let angle = |joint: usize| format!("[[input]]\njoint = {joint}\nangle = 1\n");
    let unread = |kinds: &str, input: &str| read(&bennett(&general(kinds), input)).unwrap_err().to_string();
    let unsolved = |kinds: &str, input: &str| {
        let entry = read(&bennett(&general(kinds), input)).unwrap();
        let message = Mechanism::prepare(&entry).map(|_| ()).unwrap_err();
        assert_eq!(message.exit_code(), 4);
        message.to_string()
    };
    let contains = |message: String, words: &[&str]| {
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    };
    let too_many = "mobility 2 by Gruebler's count (8 - 6), screw rank 6 in general position: one freedom too many";
    contains(unread("RRRRRRRR", &angle(1)), &[too_many, "make one variable constant"]);
    contains(unread("CCCC", &angle(1)), &[too_many]);
    contains(
        unread("RSSRR", &angle(1)),
        &["mobility 3 by", "the spin of a link between two S joints", "one freedom too many"],
    );
    contains(unread("RSSSR", &angle(1)), &["mobility 5 by", "4 freedoms too many"]);
    contains(unread("R", ""), &["mobility -5 by", "no loop of them can close in more than one way"]);
    contains(unread("RRRRRRR", ""), &["found no [[input]]", "mobility 1 by", "screw rank 6"]);
    contains(unread("RRRRRRR", &angle(8)), &["found joint 8, expected one from 1 to 7"]);
    contains(unread("PRRRRRR", &angle(1)), &["found an angle as input of joint 1", "expected `distance`"]);
    let found = solve(&read(&bennett(&general("RRS"), "[[input]]\njoint = 1\ntan_half = 2\n")).unwrap(), 0);
    assert_eq!((found.verdict.status, found.verdict.complex), (Status::Unreachable, 0), "{}", found.verdict.reason);
    contains(found.warnings.concat(), &["mobility -1 by Gruebler's count (5 - 6), screw rank 5", "looproot mobility"]);
    contains(unsolved("SS", ""), &["mobility 0 by", "the spin of a link between two S joints", "as RSSR"]);
    contains(unsolved("PPPPRRR", &angle(5)), &["mobility 1 by", "give a distance in place of an angle"]);
    let found = solve(&read(&bennett(&general("RRRR"), &angle(1))).unwrap(), 0);
    assert_eq!(found.verdict.status, Status::Unreachable);
    contains(found.warnings.concat(), &["mobility -2 by Gruebler's count (4 - 6), screw rank 4", "looproot mobility"]);
    let short = read(&bennett(&general("RRRRRR"), &angle(1))).unwrap();
    let message = looproot::internal::derivation::derive(&short, &short.cases[0]).unwrap_err();
    assert_eq!(message.exit_code(), 4);
    contains(message.to_string(), &["mobility 0 by", "screw rank 6", "no single closure polynomial"]);
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

/// A loop given by its screws, which closes where all variables are 0.
fn sliding(joints: &str, input: &str) -> Entry {
    let text = format!(
        "title = \"loop\"\n[mechanism]\nkind = \"loop\"\nconvention = \"screws\"\njoints = [\n{joints}]\n[[input]]\n{input}\n"
    );
    read(&text).unwrap()
}

#[test]
fn loops_of_few_revolutes_are_solved_exactly() {
    let slides = "{ type = \"P\", axis = [1, 0, 2] },\n{ type = \"P\", axis = [0, 3, 4] },\n{ type = \"P\", axis = [2, -1, 2] },\n";
    let general = slides.to_owned() + "{ type = \"P\", axis = [-2, 3, 6] },\n";
    let solution = solve(&sliding(&general, "joint = 4\ndistance = \"7/3\""), 0);
    assert_eq!((solution.verdict.status, solution.verdict.real), (Status::Complete, 1), "{}", solution.verdict.reason);
    let mode = &solution.modes[0];
    // Directions of irrational length are rounded: what closes then is not proved to close with them.
    assert!(!mode.certified && mode.residual < 1e-15 && mode.q[0].norm() > 0.1, "{mode:?}");
    // A turn in place of a slide has nowhere to go, unless it is 0.
    let turning = slides.to_owned() + "{ type = \"R\", axis = [1, 1, 1], point = [0, 1, 0] },\n";
    let solution = solve(&sliding(&turning, "joint = 4\ntan_half = \"1/5\""), 0);
    assert_eq!(solution.verdict.status, Status::Unreachable, "{}", solution.verdict.reason);
    let solution = solve(&sliding(&turning, "joint = 4\nangle = 0"), 0);
    assert_eq!((solution.verdict.status, solution.verdict.real), (Status::Complete, 1), "{}", solution.verdict.reason);
    // Two turns about axes at an angle stay where they are, and slides within a plane are one too many.
    let plane = "{ type = \"R\", axis = [0, 0, 1], point = [0, 1, 0] },\n{ type = \"P\", axis = [1, 0, 0] },\n\
                 { type = \"P\", axis = [0, 1, 0] },\n{ type = \"R\", axis = [1, 0, 0], point = [0, 0, 1] },\n\
                 { type = \"P\", axis = [3, 4, 0] },\n{ type = \"P\", axis = [0, 4, 3] },\n";
    let solution = solve(&sliding(plane, "joint = 6\ndistance = 0"), 0);
    assert_eq!(solution.verdict.self_motion, 1, "{}", solution.verdict.reason);
}

#[test]
fn two_balls_are_solved_in_any_unit() {
    for unit in ["1e-9", "1e-3", "1", "1e7"] {
        let joint = |kind: &str, a: &str, d: &str| {
            let d = if kind == "R" { format!("d = \"{d}*{unit}\", ") } else { String::new() };
            format!("{{ type = \"{kind}\", {d}a = \"{a}*{unit}\", alpha = 0.5 }},\n")
        };
        let joints = joint("R", "1", "1") + &joint("S", "2", "0") + &joint("S", "1", "0") + &joint("R", "2", "1");
        let entry = read(&bennett(&joints, "[[input]]\njoint = 1\nangle = 1\n")).unwrap();
        let solution = solve(&entry, 0);
        let verdict = &solution.verdict;
        assert_eq!((verdict.complex, verdict.certified), (2, 2), "{unit}: {}", verdict.reason);
        assert!(solution.modes.iter().all(|mode| mode.residual < 1e-14), "{unit}");
    }
}
