//! Sweeps of linkages: branches, limit positions, traced points.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, LinkageFile, Options, any_from_text, builtin_any};
use looproot::internal::kinematics::linkage::Accuracy;
use looproot::internal::linkage::answer::solve;
use looproot::internal::linkage::limits::complex_limits;
use looproot::internal::report::linkage_sweep::Traced;
use looproot::internal::sweep::{End, LinkageSweep, Range, sweep_linkage};
use looproot::internal::verdict::{Proof, Status};
use std::f64::consts::PI;

fn four_bar([a, b, c, d]: [i32; 4], tan_half: &str) -> Box<LinkageFile> {
    let text = format!(
        "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"frame\"\njoints = \"shared points\"\n\
         [mechanism.bodies]\nframe = {{ A = 0, D = {d} }}\ncrank = {{ A = 0, B = {a} }}\n\
         coupler = {{ B = 0, C = {b}, P = [2, 3] }}\nrocker = {{ D = 0, C = {c} }}\n\
         [[input]]\njoint = \"A\"\ntan_half = \"{tan_half}\"\n"
    );
    match any_from_text(&text, "test.toml", Format::Toml, &Options::default()).unwrap() {
        Any::Linkage(file) => file,
        _ => panic!("a linkage"),
    }
}

fn turn(file: &LinkageFile, steps: usize) -> LinkageSweep {
    let joint = file.linkage.joints.iter().position(|joint| joint.name == "A").unwrap();
    let range = Range { from: -PI, to: PI, steps };
    sweep_linkage(&file.linkage, file.given(&file.cases[0]), joint, range, || ()).unwrap()
}

/// In a limit position coupler and rocker are in line: cos = (a^2 + d^2 - (b +- c)^2)/(2 a d).
fn limits([a, b, c, d]: [i32; 4]) -> Vec<f64> {
    let [a, b, c, d] = [a, b, c, d].map(f64::from);
    let cosines = [b + c, b - c].map(|l| (a * a + d * d - l * l) / (2.0 * a * d));
    let mut found: Vec<f64> =
        cosines.into_iter().filter(|cos| cos.abs() < 1.0).flat_map(|cos| [cos.acos(), -cos.acos()]).collect();
    found.sort_by(f64::total_cmp);
    found
}

#[test]
fn limit_positions_of_four_bars_are_where_coupler_and_rocker_are_in_line() {
    // A triple-rocker, a double-rocker of two circuits, a crank-rocker, a double-crank.
    for lengths in [[3, 4, 3, 6], [4, 5, 6, 8], [6, 2, 5, 4], [2, 5, 4, 6], [5, 4, 6, 2]] {
        let file = four_bar(lengths, "1/2");
        let found = turn(&file, 24);
        assert_eq!((found.unresolved(), found.incomplete()), (0, 0), "{lengths:?}");
        let inputs: Vec<f64> = found.limits.iter().map(|limit| limit.input).collect();
        let known = limits(lengths);
        assert_eq!(inputs.len(), known.len(), "{lengths:?}: {inputs:?}");
        for (own, known) in inputs.iter().zip(&known) {
            assert!((own - known).abs() < 1e-9, "{lengths:?}: {own} for {known}");
        }
        assert!(found.limits.iter().all(|limit| limit.branches.len() == 2));
        let closed = found.branches.iter().filter(|branch| branch.begin == End::Closed(1)).count();
        assert_eq!(closed, if known.is_empty() { 2 } else { 0 }, "{lengths:?}");
    }
}

#[test]
fn a_traced_point_keeps_its_distance_from_the_crank() {
    let file = four_bar([2, 5, 4, 6], "1/2");
    let found = turn(&file, 12);
    let body = file.linkage.bodies.iter().position(|body| body.name == "coupler").unwrap();
    let place = file.linkage.bodies[body].point("P").unwrap().clone();
    let traced = Traced { body, name: "coupler.P".to_owned(), place };
    let mut rows = 0;
    for branch in &found.branches {
        for row in &branch.rows {
            let sample = &found.samples[row.step];
            let [x, y] = traced.at(&sample.modes[row.mode]);
            let (bx, by) = (2.0 * sample.input.cos(), 2.0 * sample.input.sin());
            assert!(((x - bx).hypot(y - by) - 13.0_f64.sqrt()).abs() < 1e-12);
            rows += 1;
        }
    }
    assert!(rows >= 24);
}

/// cos = (a^2 + d^2 - (b +- c)^2)/(2 a d) has two angles for every cosine but 1 and -1, where the linkage passes a change point.
#[test]
fn complex_limit_positions_of_four_bars_are_those_of_the_law_of_cosines() {
    for (lengths, count) in [
        ([3, 4, 3, 6], 4),
        ([2, 5, 4, 6], 4),
        ([5, 4, 6, 2], 4),
        // Change points: one cosine is -1; both are 1 and -1.
        ([2, 3, 4, 5], 2),
        ([2, 3, 2, 3], 0),
    ] {
        let file = four_bar(lengths, "1/2");
        let joint = file.linkage.joints.iter().position(|joint| joint.name == "A").unwrap();
        assert_eq!(complex_limits(&file.linkage, &[], joint), Some(count), "{lengths:?}");
    }
}

/// Six-bars with a swept joint and its complex limit positions, counted by another program: Groebner bases of the closure equations and the
/// determinant of their derivatives, modulo 32003. Watt's has the 4 limits of its first dyad with 2 assemblies of the second, and 8 of the second.
const SIX_BARS: &[(&str, &str, usize)] =
    &[("watt_1", "A", 16), ("watt_2", "A", 16), ("stephenson_2", "A", 24), ("stephenson_3_triad", "H", 24)];

#[test]
fn complex_limit_positions_of_six_bars_are_counted() {
    for (name, joint, count) in SIX_BARS {
        let Any::Linkage(file) = builtin_any(&format!("linkage/{name}"), &Options::default()).unwrap() else {
            panic!("a linkage")
        };
        let joint = file.linkage.joints.iter().position(|own| own.name == *joint).unwrap();
        assert_eq!(complex_limits(&file.linkage, &[], joint), Some(*count), "{name}");
    }
}

#[test]
fn an_input_out_of_reach_says_by_how_much() {
    // The crank points away from the rocker: its end is 3 + 6 = 9 from D, and coupler and rocker reach 7.
    let file = four_bar([3, 4, 3, 6], "inf");
    let answer = solve(&file.linkage, &file.cases[0].given, Accuracy::Exact).unwrap();
    assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::Unreachable, Proof::Proved));
    assert!(answer.verdict.reason.contains("2.000000 m"), "{}", answer.verdict.reason);
}
