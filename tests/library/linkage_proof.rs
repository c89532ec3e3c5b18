//! Proved sweeps of linkages of dyads against counts at single inputs, and at inputs where proofs could go wrong.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, LinkageFile, Options, any_from_text};
use looproot::internal::kinematics::linkage::{Accuracy, Given};
use looproot::internal::linkage::answer::{LinkageMode, solve};
use looproot::internal::sweep::{AssemblyBranch, AssemblyRow, End, LinkageSweep, Range, sweep_linkage};
use looproot::internal::verdict::{Code, Proof, Status};
use rug::Rational;
use std::f64::consts::PI;

fn file(bodies: &str, input: &str) -> Box<LinkageFile> {
    let text = format!(
        "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"frame\"\njoints = \"shared points\"\n\
         [mechanism.bodies]\n{bodies}[[input]]\njoint = \"{input}\"\ntan_half = \"1/2\"\n"
    );
    match any_from_text(&text, "test.toml", Format::Toml, &Options::default()).unwrap() {
        Any::Linkage(file) => file,
        _ => panic!("a linkage"),
    }
}

fn four_bar([a, b, c, d]: [&str; 4]) -> Box<LinkageFile> {
    let bodies = format!(
        "frame = {{ A = 0, D = \"{d}\" }}\ncrank = {{ A = 0, B = \"{a}\" }}\n\
         coupler = {{ B = 0, C = \"{b}\" }}\nrocker = {{ D = 0, C = \"{c}\" }}\n"
    );
    file(&bodies, "A")
}

fn sweep(file: &LinkageFile, steps: usize) -> LinkageSweep {
    let Some(Given::Turn { joint, .. }) = file.cases[0].given.first() else { panic!("an angle") };
    let joint = *joint;
    let range = Range { from: -PI, to: PI, steps };
    sweep_linkage(&file.linkage, file.given(&file.cases[0]), joint, range, || ()).unwrap()
}

/// The real assemblies with this half tangent of the input.
fn at(file: &LinkageFile, half_tangent: &str) -> Vec<LinkageMode> {
    let t = Rational::from_str_radix(half_tangent, 10).unwrap();
    let square = Rational::from(&t * &t);
    let length = Rational::from(&square + 1);
    let mut given = file.cases[0].given.clone();
    if let [Given::Turn { turn, within, .. }] = given.as_mut_slice() {
        turn.re = Rational::from(1 - &square) / &length;
        turn.im = Rational::from(2 * &t) / &length;
        *within = None;
    }
    let answer = solve(&file.linkage, &given, Accuracy::Exact).unwrap();
    assert!(matches!(answer.verdict.status, Status::Complete | Status::Unreachable), "{}", answer.verdict.reason);
    answer.modes.into_iter().filter(|mode| mode.real).collect()
}

/// The number of branches over an input in (-pi, pi).
fn over(sweep: &LinkageSweep, input: f64) -> usize {
    let count = |branch: &AssemblyBranch| {
        let turns = (-3..=3).map(|turn| input + 2.0 * PI * f64::from(turn));
        turns.filter(|x| *x > branch.from && *x < branch.to).count()
    };
    sweep.branches.iter().map(count).sum()
}

/// As many branches are over inputs as there are assemblies, and no branch jumps.
fn agrees(file: &LinkageFile, found: &LinkageSweep) {
    for k in -17_i32..=17 {
        let t = format!("{}/{}", 97 * k + 5, 331);
        let input = 2.0 * (f64::from(97 * k + 5) / 331.0).atan();
        assert_eq!(over(found, input), at(file, &t).len(), "{input}");
    }
}

#[test]
fn four_bars_are_proved_with_as_many_branches_as_assemblies() {
    let all =
        [["3", "4", "3", "6"], ["4", "5", "6", "8"], ["6", "2", "5", "4"], ["2", "5", "4", "6"], ["5", "4", "6", "2"]];
    for lengths in all {
        let file = four_bar(lengths);
        let found = sweep(&file, 6);
        assert_eq!((found.verdict.status, found.verdict.proof), (Status::Complete, Proof::Proved), "{lengths:?}");
        agrees(&file, &found);
    }
}

#[test]
fn a_circuit_within_a_step_is_met() {
    // The crank nearly comes round: B is out of reach for a small angle only, and in reach for a small one only.
    for (lengths, limits) in [(["2", "5", "4", "10999/1000"], 2), (["2", "5", "39999/10000", "6999999/1000000"], 2)] {
        let file = four_bar(lengths);
        let found = sweep(&file, 3);
        assert_eq!(found.verdict.proof, Proof::Proved, "{}", found.verdict.reason);
        assert_eq!(found.limits.len(), limits, "{lengths:?}");
        agrees(&file, &found);
    }
}

#[test]
fn branches_go_straight_through_change_points() {
    // A parallelogram: the parallel assembly has the angle of the crank throughout, the crossed one passes it twice.
    let file = four_bar(["2", "5", "2", "5"]);
    let found = sweep(&file, 24);
    assert_eq!((found.verdict.proof, found.limits.len()), (Proof::Proved, 0), "{}", found.verdict.reason);
    let body = |name: &str| file.linkage.bodies.iter().position(|body| body.name == name).unwrap();
    let (crank, rocker) = (body("crank"), body("rocker"));
    assert_eq!(found.branches.len(), 2);
    let mut parallel = 0;
    for branch in &found.branches {
        assert_eq!(branch.begin, End::Closed(1));
        let is_parallel = |row: &AssemblyRow| {
            let bodies = &found.samples[row.step].modes[row.mode].bodies;
            (bodies[crank].0.re - bodies[rocker].0.re).abs() < 1e-9
        };
        let count = branch.rows.iter().filter(|row| is_parallel(row)).count();
        assert!(count == 0 || count == branch.rows.len(), "{count} of {}", branch.rows.len());
        parallel += usize::from(count > 0);
    }
    assert_eq!(parallel, 1);
    // 2 + 6 = 5 + 3: one change point, which changes the assembly.
    let folding = four_bar(["2", "5", "3", "6"]);
    let found = sweep(&folding, 24);
    assert_eq!((found.verdict.proof, found.limits.len()), (Proof::Proved, 0), "{}", found.verdict.reason);
    assert_eq!(found.branches.len(), 1);
    assert_eq!(found.branches[0].begin, End::Closed(2));
    agrees(&folding, &found);
}

#[test]
fn change_points_and_limits_beside_each_other_are_distinguished() {
    // 1e-6, 1e-9 and 1e-12 beside the four-bar that folds: two limits close together, or none.
    for digits in [6, 9, 12] {
        let small = format!("1{}", "0".repeat(digits));
        for sign in [1_i128, -1] {
            let own = 2 * small.parse::<i128>().unwrap() + sign;
            let file = four_bar([&format!("{own}/{small}"), "5", "3", "6"]);
            let found = sweep(&file, 24);
            if found.verdict.proof == Proof::Proved {
                // 2 + e + 6 > 5 + 3: the crank is not the shortest of a Grashof chain, and turns back.
                assert_eq!(found.limits.len(), if sign > 0 { 2 } else { 0 }, "{digits} {sign}");
                agrees(&file, &found);
            } else {
                assert_ne!(found.verdict.code, Code::BranchesProved);
            }
        }
    }
}

/// A dyad from the coupler to the frame: Stephenson's third linkage.
fn six_bar(p: &str, [e, f]: [&str; 2], g: &str) -> Box<LinkageFile> {
    let bodies = format!(
        "frame = {{ A = 0, D = 6, G = {g} }}\ncrank = {{ A = 0, B = 2 }}\ncoupler = {{ B = 0, C = 5, P = {p} }}\n\
         rocker = {{ D = 0, C = 4 }}\nlink = {{ P = 0, Q = \"{e}\" }}\narm = {{ G = 0, Q = \"{f}\" }}\n"
    );
    file(&bodies, "A")
}

#[test]
fn six_bars_are_proved_with_as_many_branches_as_assemblies() {
    let all = [
        six_bar("[2, 3]", ["3", "4"], "[9, 1]"),
        six_bar("[2, 3]", ["2", "5/2"], "[1, 6]"),
        six_bar("[\"5/2\", -1]", ["7/2", "2"], "[-2, -3]"),
        // Symmetric: the dyad closes at several assemblies of the four-bar at once.
        six_bar("[\"5/2\", 0]", ["3", "3"], "[3, 0]"),
        six_bar("[0, 0]", ["3", "2"], "[4, 0]"),
    ];
    let mut proved = 0;
    for file in all {
        let found = sweep(&file, 12);
        if found.verdict.proof == Proof::Proved {
            agrees(&file, &found);
            proved += 1;
        }
    }
    assert!(proved >= 4, "{proved}");
}

#[test]
fn a_dyad_on_a_double_root_is_not_taken_for_a_limit() {
    // The end of the crank, alone: |AG| + 2 = 3 + 4 exactly at one input, where the dyad is stretched and the end turns back.
    let touching = six_bar("[0, 0]", ["3", "4"], "[-5, 0]");
    let found = sweep(&touching, 12);
    agrees(&touching, &found);
    assert!(found.verdict.proof == Proof::Proved || found.verdict.code == Code::SingularNotDecided);
    assert!(found.limits.iter().all(|limit| limit.input.abs() > 1e-6 || found.verdict.proof != Proof::Proved));
}

#[test]
fn a_branch_that_begins_where_a_full_turn_begins_lies_within_the_turn() {
    // At half a turn B is at [0, -2], and D at [4, 1] is as far away as coupler and rocker reach: 5.
    let bodies = "frame = { A = 0, D = [4, 1] }\ncrank = { A = 0, B = [0, 2] }\n\
                  coupler = { B = 0, C = 2 }\nrocker = { D = 0, C = 3 }\n";
    let file = file(bodies, "A");
    let found = sweep(&file, 24);
    assert_eq!((found.verdict.proof, found.limits.len()), (Proof::Proved, 2), "{}", found.verdict.reason);
    for branch in &found.branches {
        assert!((branch.from + PI).abs() < 1e-6 && branch.to < 1.0, "{} {}", branch.from, branch.to);
    }
    agrees(&file, &found);
}

#[test]
fn slides_that_become_parallel_end_a_sweep_without_proof() {
    // Two slides, one fixed in the crank, one in the frame: where they are parallel the pin between them is infinitely far away.
    let text = "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"frame\"\njoints = [\n\
        { name = \"A\", type = \"R\", of = [\"frame\", \"crank\"] },\n\
        { name = \"S\", type = \"P\", of = [\"crank\", \"one\"], along = [0, 1] },\n\
        { name = \"T\", type = \"P\", of = [\"frame\", \"two\"], along = [3, 4] },\n\
        { name = \"B\", type = \"R\", of = [\"one\", \"two\"] }]\n\
        [mechanism.bodies]\nframe = { A = 0, T = [0, 1] }\ncrank = { A = 0, S = 4 }\none = { S = 0, B = 5 }\ntwo = { T = 0, B = 2 }\n\
        [[input]]\njoint = \"A\"\ntan_half = \"1/2\"\n";
    let Any::Linkage(file) = any_from_text(text, "test.toml", Format::Toml, &Options::default()).unwrap() else {
        panic!("a linkage")
    };
    let found = sweep(&file, 24);
    assert_eq!(found.verdict.proof, Proof::None);
    assert_eq!((found.limits.len(), found.unresolved()), (0, 0));
    let ends = found.branches.iter().flat_map(|branch| [&branch.begin, &branch.end]);
    assert_eq!(ends.filter(|end| matches!(end, End::Infinite(_))).count(), 4);
}

#[test]
fn a_second_joint_between_the_bodies_of_the_input_is_not_passed_over() {
    let bodies = "frame = { A = 0, Q = [1, 1], D = 5 }\ncrank = { A = 0, Q = [1, 1], B = 2 }\n\
                  coupler = { B = 0, C = 4 }\nrocker = { D = 0, C = 3 }\n";
    let file = file(bodies, "A");
    assert!(solve(&file.linkage, &file.cases[0].given, Accuracy::Exact).is_err());
}

#[test]
fn linkages_of_dyads_in_the_library_are_proved() {
    let all = [
        "four_bar_coupler",
        "crank_slider",
        "inverted_slider_crank",
        "whitworth",
        "watt_1",
        "watt_2",
        "stephenson_1",
        "stephenson_3",
        "jansen",
    ];
    for name in all {
        let path = format!("{}/equations/linkage/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap();
        let Any::Linkage(file) = any_from_text(&text, &path, Format::Toml, &Options::default()).unwrap() else {
            panic!("a linkage")
        };
        let found = sweep(&file, 12);
        assert_ne!(found.verdict.proof, Proof::None, "{name}: {}", found.verdict.reason);
        agrees(&file, &found);
    }
}
