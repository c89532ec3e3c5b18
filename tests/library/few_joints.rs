//! Arms with fewer joints than a pose has conditions, and with a spherical joint: which configurations are listed, and how often.
#![allow(clippy::unwrap_used)]

use super::arms::{at_pose, chain, joint, pose, ratio, solve};
use looproot::internal::assembly::wrapped;
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::kinematics::chain::{Chain, Geometry, JointKind};
use looproot::internal::mechanism::{FullMode, Solution};
use looproot::internal::verdict::{Proof, Status};
use rug::Rational;
use rug::ops::Pow;

/// Revolutes from a table of `[a, tan(alpha/2), d]`, numerators over 10.
fn revolutes(rows: &[[i32; 3]]) -> Chain {
    let tenths = |n: i32| ratio(n, 10);
    let row = |[a, t, d]: &[i32; 3]| joint(JointKind::Revolute, &tenths(*a), &tenths(*t), &tenths(*d));
    chain(Geometry::Dh(rows.iter().map(row).collect()))
}

fn exact(solution: &Solution) -> Vec<&FullMode> {
    solution.modes.iter().filter(|mode| mode.real && !mode.near).collect()
}

#[test]
fn elbow_up_and_elbow_down_are_two_however_near() {
    let arm = revolutes(&[[10, 0, 0], [10, 0, 0], [5, 0, 0]]);
    for power in [2, 6, 9, 12, 15, 17, 18, 20] {
        let bend = Rational::from(10).pow(-power);
        let solution = at_pose(&arm, pose(&arm, &[ratio(1, 3), bend, ratio(2, 5)]));
        let verdict = &solution.verdict;
        assert_eq!(
            (verdict.status, verdict.proof),
            (Status::Complete, Proof::Proved),
            "1e-{power}: {}",
            verdict.reason
        );
        assert_eq!((verdict.real, exact(&solution).len()), (2, 2), "1e-{power}: {}", verdict.reason);
        let mut elbows: Vec<f64> = exact(&solution).iter().map(|mode| mode.q[1].re).collect();
        elbows.sort_by(f64::total_cmp);
        assert!(elbows[0] < 0.0 && elbows[1] > 0.0, "1e-{power}: {elbows:?}");
    }
}

#[test]
fn a_configuration_is_listed_once() {
    for (rows, values) in [
        (&[[10, 10, 3], [7, -4, 2], [5, 0, 1]][..], &[ratio(1, 3), ratio(2, 5), ratio(-3, 4)][..]),
        (&[[0, 10, 3], [7, 0, 2], [5, 3, 1]], &[ratio(1, 3), ratio(2, 5), ratio(1, 4)]),
        (&[[10, 0, 0], [10, 0, 0], [5, 0, 0]], &[ratio(1, 3), ratio(2, 5), ratio(1, 4)]),
    ] {
        let arm = revolutes(rows);
        let solution = at_pose(&arm, pose(&arm, values));
        let verdict = &solution.verdict;
        assert_eq!((verdict.status, verdict.proof), (Status::Complete, Proof::Proved), "{}", verdict.reason);
        let found = exact(&solution);
        assert_eq!(found.len(), verdict.real, "{}", verdict.reason);
        let apart = |one: &FullMode, q: &dyn Fn(usize) -> f64| {
            (0..3).map(|k| wrapped(one.q[k].re - q(k)).abs()).fold(0.0, f64::max)
        };
        let planted = |k: usize| 2.0 * values[k].to_f64().atan();
        assert!(found.iter().any(|mode| apart(mode, &planted) < 1e-9), "{}", verdict.reason);
        for (k, one) in found.iter().enumerate() {
            assert!(found[..k].iter().all(|other| apart(other, &|j| one.q[j].re) > 1e-6), "{}", verdict.reason);
        }
    }
}

/// Three revolutes and a spherical joint; the pose is 1e-12 m beyond the stretched arm.
const BEYOND: &str = r#"{
    "title": "RRRS, just beyond its reach",
    "mechanism": { "kind": "arm", "convention": "dh", "joints": [
        { "type": "R", "a": "0", "tan_half_alpha": "1", "d": "1" },
        { "type": "R", "a": "1", "tan_half_alpha": "0", "d": "0" },
        { "type": "R", "a": "1", "tan_half_alpha": "0", "d": "0" },
        { "type": "S", "a": "0", "tan_half_alpha": "0" }
    ] },
    "pose": [{ "matrix": [
        ["12/25", "-16/25", "3/5", "6000000000003/6250000000000"],
        ["9/25", "-12/25", "-4/5", "18000000000009/25000000000000"],
        ["4/5", "3/5", "0", "3250000000001/1250000000000"],
        ["0", "0", "0", "1"]
    ] }]
}"#;

#[test]
fn a_pose_reached_within_the_tolerance_is_not_unreachable() {
    let entry = load_text(BEYOND, "arm.json", Format::Json, &Options::default()).unwrap();
    let solution = solve(&entry);
    assert_eq!(solution.verdict.status, Status::Complete, "{}", solution.verdict.reason);
    assert_eq!(exact(&solution).len(), 0);
    // Elbow stretched, and the arm turned about by the first joint; the spherical joint has no singular position.
    assert_eq!(solution.modes.iter().filter(|mode| mode.near).count(), 2, "{}", solution.verdict.reason);
    assert!(solution.families.is_empty());
}
