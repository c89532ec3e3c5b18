//! Loops of few unknowns, decided over the rationals: their numbers of solutions by Gröbner bases of another program, or by
//! construction.

use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::entry::Entry;
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::mechanism::{Mechanism, Solution};
use looproot::internal::verdict::{Proof, Status};
use std::f64::consts::PI;

/// A loop of DH joints, `kind a tan(alpha/2) d` or `P a tan(alpha/2) tan(theta/2)` each, at an input.
fn read(joints: &[[&str; 4]], input: &str) -> Entry {
    let joint = |[kind, a, alpha, last]: &[&str; 4]| {
        let last = match *kind {
            "P" => format!(", tan_half_theta = \"{last}\""),
            "C" => String::new(),
            _ => format!(", d = \"{last}\""),
        };
        format!("{{ type = \"{kind}\", a = \"{a}\", tan_half_alpha = \"{alpha}\"{last} }},\n")
    };
    let joints: String = joints.iter().map(joint).collect();
    let text =
        format!("title = \"loop\"\n[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n{joints}]\n{input}");
    load_text(&text, "test.toml", Format::Toml, &Options::default()).unwrap()
}

fn solve(joints: &[[&str; 4]], joint: usize, value: &str) -> Solution {
    let input = if joint == 0 { String::new() } else { format!("[[input]]\njoint = {joint}\n{value}\n") };
    let entry = read(joints, &input);
    let mechanism = Mechanism::prepare(&entry).unwrap();
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap()
}

/// Asserts that a loop is proved to have this many solutions, and this many real ones.
fn has(joints: &[[&str; 4]], joint: usize, value: &str, complex: usize, real: usize) -> Solution {
    let found = solve(joints, joint, value);
    let verdict = &found.verdict;
    let status = if real == 0 { Status::Unreachable } else { Status::Complete };
    assert_eq!((verdict.status, verdict.complex, verdict.real), (status, complex, real), "{}", verdict.reason);
    assert_eq!(verdict.proof, Proof::Proved, "{}", verdict.reason);
    for mode in &found.modes {
        assert!(mode.certified && mode.radius < 1e-10 && mode.residual < 1e-12, "{mode:?}");
    }
    found
}

/// Proves a loop to have a self-motion of this dimension.
fn moves(joints: &[[&str; 4]], joint: usize, value: &str, dimension: usize) {
    let verdict = solve(joints, joint, value).verdict;
    assert_eq!((verdict.status, verdict.self_motion), (Status::SelfMotion, dimension), "{}", verdict.reason);
    assert_eq!(verdict.proof, Proof::Proved);
}

/// Source: Gröbner basis.
#[test]
fn loops_with_a_spherical_joint_and_dependent_axes() {
    let none = |joints: &[[&str; 4]], joint, value| {
        has(joints, joint, value, 0, 0);
    };
    none(
        &[["S", "-1", "-3/2", "-1"], ["P", "0", "0", "-9/2"], ["R", "3", "-1", "1"], ["C", "0", "0", ""]],
        2,
        "distance = 0",
    );
    none(
        &[
            ["P", "0", "-1/3", "0"],
            ["S", "0", "9/8", "0"],
            ["R", "0", "0", "0"],
            ["P", "0", "-5", "-3/7"],
            ["R", "-3", "1", "-1"],
        ],
        5,
        "tan_half = 1",
    );
    none(
        &[["S", "0", "7/6", "-1"], ["R", "2", "3/7", "0"], ["R", "0", "8/5", "-1"], ["C", "0", "-4", ""]],
        3,
        "tan_half = \"4/7\"",
    );
    let moving = [
        ["R", "0", "inf", "0"],
        ["S", "1", "-1", "0"],
        ["R", "0", "0", "0"],
        ["R", "-1", "inf", "0"],
        ["P", "0", "-6/5", "-1"],
    ];
    moves(&moving, 4, "tan_half = -9", 1);
}

/// Planted: the arm of the spherical joint is stretched, or so long that it is one of two or four.
#[test]
fn double_positions_of_a_centre_are_counted_twice() {
    // In a plane: links of 3 and 2, the centre at 5, 4 and 6 from the first axis.
    for (reach, complex, real, distinct) in [("5", 2, 2, 1), ("4", 2, 2, 2), ("6", 2, 0, 2), ("1", 2, 2, 1)] {
        let joints = [["R", "3", "0", "0"], ["R", "2", "0", "0"], ["S", "0", "0", "0"], ["P", reach, "1", "0"]];
        let found = has(&joints, 4, "distance = 0", complex, real);
        assert_eq!(found.modes.len(), distinct);
        assert!(found.modes.iter().all(|mode| mode.multiplicity * distinct == 2));
    }
}

/// A planar four-bar with a spherical joint: its first and third axis are one line in both positions.
#[test]
fn a_spherical_joint_in_the_plane_is_listed_with_a_middle_angle_of_0() {
    let joints = [["R", "2", "0", "0"], ["S", "3", "0", "0"], ["R", "3", "0", "0"], ["R", "4", "0", "0"]];
    let found = has(&joints, 1, "tan_half = \"1/2\"", 2, 2);
    for mode in &found.modes {
        assert!(mode.q[2].norm() < 1e-15 && mode.q[3].norm() < 1e-15, "{:?}", mode.q);
    }
    let turned = [["R", "2", "0", "0"], ["S", "3", "inf", "0"], ["R", "3", "0", "0"], ["R", "4", "0", "0"]];
    for mode in has(&turned, 1, "tan_half = \"1/2\"", 2, 2).modes {
        assert!((mode.q[2].re - PI).abs() < 1e-15, "{:?}", mode.q);
    }
}

/// By construction: the sides of a triangle, stretched, folded, too long and of no length at all.
#[test]
fn two_spherical_joints_have_the_roots_of_their_quadratic() {
    let triangle = |a, b, l| [["R", a, "0", "0"], ["S", l, "0", "0"], ["S", b, "0", "0"]];
    for (joints, complex, real, distinct) in [
        (triangle("3", "2", "4"), 2, 2, 2),
        (triangle("3", "2", "5"), 2, 2, 1),
        (triangle("3", "2", "1"), 2, 2, 1),
        (triangle("3", "2", "6"), 2, 0, 2),
        (triangle("3", "3", "0"), 2, 2, 1),
        (triangle("3", "0", "2"), 0, 0, 0),
    ] {
        let found = has(&joints, 0, "", complex, real);
        assert_eq!((found.modes.len(), found.verdict.complex_complete), (distinct, true));
        assert!(found.modes.iter().all(|mode| mode.multiplicity * distinct == 2));
    }
    moves(&triangle("3", "0", "3"), 0, "", 1);
    // Centres that have to coincide, and do so in no real position.
    let apart = solve(&triangle("3", "2", "0"), 0, "").verdict;
    assert_eq!((apart.status, apart.proof, apart.complex_complete), (Status::Unreachable, Proof::Proved, false));
}

/// Source: Gröbner basis; the offset is a multiple of the prime 2^61 - 1.
#[test]
fn a_bennett_loop_with_an_offset_does_not_close() {
    let links = |d| [["R", "4", "1/2", d], ["R", "3", "1/3", "0"], ["R", "4", "1/2", "0"], ["R", "3", "1/3", "0"]];
    has(&links("2305843009213693951/1000000000000000000000000000000"), 1, "tan_half = \"1/2\"", 0, 0);
    has(&links("0"), 1, "tan_half = \"1/2\"", 1, 1);
    moves(&links("0"), 0, "", 1);
}

/// Source: Gröbner basis.
#[test]
fn overconstrained_loops_have_their_dimension_and_count() {
    moves(&[["R", "3", "1/3", "0"]; 4], 1, "tan_half = \"inf\"", 1);
    let spherical = ["1", "1/2", "3", "1/2", "-1"].map(|twist| ["R", "0", twist, "0"]);
    moves(&spherical, 3, "tan_half = 3", 1);
    let planar = ["1/2", "6", "4/3", "4", "3", "2"].map(|a| ["R", a, "0", "0"]);
    moves(&planar, 2, "tan_half = \"inf\"", 2);
    let slider = [["R", "2", "0", "0"], ["R", "3", "0", "0"], ["R", "3", "1", "0"], ["P", "0", "-1", "0"]];
    let found = has(&slider, 1, "tan_half = 1", 2, 2);
    let [mode] = found.modes.as_slice() else { panic!("one double position") };
    assert_eq!(mode.multiplicity, 2);
    for (value, expected) in mode.q[1..].iter().zip([PI / 2.0, PI, 2.0]) {
        assert!((value.re - expected).abs() <= mode.radius.max(1e-15), "{value} {expected}");
    }
}

/// Source: the counts of common roots of two closure polynomials each, by another route of the program.
#[test]
fn loops_of_six_revolute_joints_are_proved_at_an_input() {
    for (name, complex, real) in [
        ("bennett_dyads_b", 2, 2),
        ("bricard_line_symmetric_a", 2, 2),
        ("bricard_plane_symmetric_a", 4, 2),
        ("bricard_trihedral_b", 4, 2),
        ("dietmaier_a", 4, 2),
        ("double_goldberg", 1, 1),
        ("waldron_hybrid", 1, 1),
        ("wohlhart_hybrid_a", 4, 4),
        ("bennett_dyads_broken", 0, 0),
        ("dietmaier_broken", 0, 0),
    ] {
        let entry = looproot::internal::catalogue::load(name, &Options::default()).unwrap();
        let mechanism = Mechanism::prepare(&entry).unwrap();
        let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
        let found = mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap();
        let verdict = &found.verdict;
        assert_eq!((verdict.proof, verdict.complex, verdict.real), (Proof::Proved, complex, real), "{name}");
        assert!(found.modes.iter().all(|mode| mode.certified && mode.residual < 1e-11), "{name}");
    }
}
