//! Self-motions as answers, and what reaches a rounded pose within the tolerance: arms by construction, planted configurations.
#![allow(clippy::unwrap_used)]

use looproot::internal::assembly::{Assembly, Roots, Workspace, wrapped};
use looproot::internal::catalogue::entry::{Design, Entry};
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::kinematics::chain::Placement;
use looproot::internal::mechanism::{Family, Mechanism, Solution, Tolerance, redundancy};
use looproot::internal::verdict::{Proof, Status};
use looproot_algebra::number::Number;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::{Value, json};

/// Rows of a Denavit-Hartenberg table: a, alpha in right angles, d.
type Table = [(f64, i32, f64); 6];

/// An arm with an offset at the shoulder and a spherical wrist.
const WRIST: Table = [(0.0, -1, 0.4), (0.45, 0, 0.1), (0.05, -1, 0.0), (0.0, 1, 0.4), (0.0, -1, 0.0), (0.0, 0, 0.1)];
/// An arm with three parallel axes and no wrist centre.
const PARALLEL: Table =
    [(0.0, 1, 0.15), (-0.4, 0, 0.0), (-0.38, 0, 0.0), (0.0, 1, 0.13), (0.0, -1, 0.1), (0.0, 0, 0.09)];
/// The same arm with the wrist centre on the first axis where the arm points up.
const CENTRED: Table = [(0.0, -1, 0.3), (0.4, 0, 0.0), (0.0, -1, 0.0), (0.0, 1, 0.35), (0.0, -1, 0.0), (0.0, 0, 0.08)];

type Matrix = [[f64; 4]; 4];

/// Forward kinematics of its own.
fn reached(table: &[(f64, i32, f64)], q: &[f64]) -> Matrix {
    let mut pose: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    for ((a, right_angles, d), angle) in table.iter().zip(q) {
        let (sin, cos) = angle.sin_cos();
        let (st, ct) = (f64::from(*right_angles), f64::from(1 - right_angles.abs()));
        let link = [
            [cos, -sin * ct, sin * st, a * cos],
            [sin, cos * ct, -cos * st, a * sin],
            [0.0, st, ct, *d],
            [0.0, 0.0, 0.0, 1.0],
        ];
        pose = std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| pose[i][k] * link[k][j]).sum()));
    }
    pose
}

fn document(table: &Table, pose: &Matrix, limits: Option<[f64; 2]>) -> String {
    let joint = |(a, right_angles, d): &(f64, i32, f64)| json!({ "type": "R", "a": a, "alpha": format!("{} deg", 90 * right_angles), "d": d });
    let joints: Vec<Value> = table.iter().map(joint).collect();
    let mut mechanism = json!({ "kind": "arm", "convention": "dh", "joints": joints });
    if let Some(limits) = limits {
        mechanism["limits"] = json!(vec![limits; 6]);
    }
    json!({ "title": "planted", "mechanism": mechanism, "pose": [{ "matrix": pose }] }).to_string()
}

fn solved_within(text: &str, tolerance: Tolerance) -> Solution {
    let entry = load_text(text, "arm.json", Format::Json, &Options::default()).unwrap();
    let mechanism = Mechanism::prepare(&entry).unwrap().with_tolerance(Some(tolerance));
    mechanism.solve(&entry.cases[0], Roots::All, &mut Workspace::default(), &mut Assembly::default()).unwrap()
}

fn solved(text: &str) -> Solution {
    solved_within(text, Tolerance::default())
}

fn apart(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| wrapped(a - b).abs()).fold(0.0, f64::max)
}

/// The largest entry by which poses differ.
fn off(one: &Matrix, other: &Matrix) -> f64 {
    one.iter().flatten().zip(other.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Returns the distance of a configuration from the nearest sample.
fn beside(family: &Family, q: &[f64]) -> f64 {
    family.samples.iter().chain([&family.sample]).map(|sample| apart(sample, q)).fold(f64::INFINITY, f64::min)
}

/// Checks what holds of every answer: families reach the pose, a curve is closed or has two ends, and no mode lies on it.
fn check(table: &Table, pose: &Matrix, answer: &Solution, within: f64) {
    for family in &answer.families {
        for q in family.samples.iter().chain([&family.sample]) {
            assert!(off(&reached(table, q), pose) < within, "{q:?}");
        }
        assert!(family.samples.windows(2).all(|pair| apart(&pair[0], &pair[1]) < 0.2), "{:?}", family.samples);
        let mut moving =
            (0..6).filter(|&k| family.samples.iter().any(|q| wrapped(q[k] - family.sample[k]).abs() > 1e-6));
        assert!(moving.all(|k| family.moving.contains(&k)), "{:?}", family.moving);
    }
    for mode in answer.modes.iter().filter(|mode| mode.real) {
        let q: Vec<f64> = mode.q.iter().map(|z| z.re).collect();
        assert!(off(&reached(table, &q), pose) < within, "{q:?}");
    }
}

#[test]
fn the_posture_asked_for_lies_on_a_closed_curve() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    for (table, moving, isolated) in [(&WRIST, vec![3, 5], 6), (&PARALLEL, vec![1, 2, 3, 5], 4)] {
        for is_home in [true, false] {
            // Right angles and zeros are reached exactly, and what they reach is written without rounding.
            let mut q: Vec<f64> = (0..6).map(|_| if is_home { 0.0 } else { rng.random_range(-2.0..2.0) }).collect();
            q[4] = 0.0;
            let pose = reached(table, &q);
            let answer = solved(&document(table, &pose, None));
            check(table, &pose, &answer, 1e-11);
            let family = answer.families.iter().find(|family| beside(family, &q) < 0.06);
            let family = family.unwrap_or_else(|| panic!("{q:?}: {:?}", answer.verdict));
            assert_eq!((family.dimension, &family.moving), (1, &moving));
            let ends = apart(family.samples.first().unwrap(), family.samples.last().unwrap());
            assert!(ends < 1e-9, "the curve is open by {ends:e}");
            if answer.verdict.status == Status::SelfMotion {
                assert_eq!((family.distance, answer.verdict.complex), (0.0, isolated), "{}", answer.verdict.reason);
                assert_eq!(answer.near(), 0);
            } else {
                assert!(family.distance > 0.0 && family.distance < 1e-9);
                assert_eq!(answer.verdict.status, Status::Complete, "{}", answer.verdict.reason);
                assert!(answer.near() >= 1 && answer.verdict.self_motion == 0);
            }
        }
    }
}

#[test]
fn a_wrist_centre_on_the_first_axis_leaves_a_curve() {
    // The wrist centre is on the first axis: the hand keeps its pose while the first joint turns.
    // The third joint places the centre: 0.4 cos q2 + 0.35 cos(q2 + q3 + pi/2) = 0.
    let mut planted: [f64; 6] = [0.3, -1.0, 0.0, 0.4, 0.9, -0.2];
    planted[2] = (-0.4 * planted[1].cos() / 0.35).acos() - planted[1] - std::f64::consts::FRAC_PI_2;
    let pose = reached(&CENTRED, &planted);
    let centre = [pose[0][3] - 0.08 * pose[0][2], pose[1][3] - 0.08 * pose[1][2]];
    assert!(centre.iter().all(|x| x.abs() < 1e-15), "{centre:?}");
    let answer = solved(&document(&CENTRED, &pose, None));
    check(&CENTRED, &pose, &answer, 1e-9);
    let family = answer.families.iter().find(|family| beside(family, &planted) < 0.1).unwrap();
    assert_eq!((family.dimension, family.moving.as_slice()), (1, [0, 3, 4, 5].as_slice()));
}

#[test]
fn a_family_is_cut_at_the_joint_limits() {
    let q = [0.2, -0.9, 0.4, 0.1, 0.0, 0.7];
    let pose = reached(&WRIST, &q);
    let answer = solved(&document(&WRIST, &pose, Some([-1.5, 2.0])));
    let family = answer.families.iter().find(|family| beside(family, &q) < 0.06).unwrap();
    let is_inside = |q: &Vec<f64>| q.iter().all(|x| (-1.5..=2.0).contains(x));
    assert!(family.samples.iter().chain([&family.sample]).all(is_inside), "{:?}", family.samples);
    // q4 + q6 stays 0.8: q4 runs from -1.2, where q6 is 2, to 2.
    let ends = [&family.samples[0], family.samples.last().unwrap()].map(|q| q[3]);
    let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    assert!((low + 1.2).abs() < 1e-8 && (high - 2.0).abs() < 1e-8, "{ends:?}");
}

#[test]
fn a_stretched_arm_out_of_reach_by_rounding_is_near() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut near = 0;
    for _ in 0..6 {
        let mut q: Vec<f64> = (0..6).map(|_| rng.random_range(-1.5..1.5)).collect();
        q[2] = 0.0;
        let mut pose = reached(&PARALLEL, &q);
        // A part of the reach away from the shoulder.
        for i in 0..3 {
            pose[i][3] += 1e-12 * pose[i][3];
        }
        let answer = solved(&document(&PARALLEL, &pose, None));
        check(&PARALLEL, &pose, &answer, 1e-9);
        let own = |mode: &&looproot::internal::mechanism::FullMode| {
            mode.real && apart(&mode.q.iter().map(|z| z.re).collect::<Vec<_>>(), &q) < 1e-4
        };
        let found = answer.modes.iter().find(own).unwrap_or_else(|| panic!("{:?}", answer.verdict));
        assert_eq!(answer.verdict.status, Status::Complete, "{}", answer.verdict.reason);
        if found.near {
            near += 1;
            let error = found.error.unwrap();
            assert!(!found.certified && error.position > 0.0 && error.largest() < 1e-9, "{error:?}");
            assert_eq!(answer.verdict.real, answer.modes.iter().filter(|mode| mode.real && !mode.near).count());
        }
        let tight = solved_within(&document(&PARALLEL, &pose, None), Tolerance { length: 1e-15, angle: 1e-15 });
        assert!(tight.modes.iter().all(|mode| !mode.near || mode.error.unwrap().largest() <= 1e-15));
    }
    assert!(near > 0, "no pose is out of reach");
}

#[test]
fn a_wide_tolerance_lists_what_is_farther_off() {
    let q = [0.3, -0.5, 0.0, 0.7, 1.1, -0.4];
    let mut pose = reached(&PARALLEL, &q);
    for row in pose.iter_mut().take(3) {
        row[3] *= 1.0 + 1e-5;
    }
    let text = document(&PARALLEL, &pose, None);
    let wide = solved_within(&text, Tolerance { length: 1e-3, angle: 1e-3 });
    check(&PARALLEL, &pose, &wide, 3e-3);
    let strict = solved(&text);
    assert!(strict.near() <= wide.near(), "{} {}", strict.near(), wide.near());
    let own = |answer: &Solution| {
        answer.modes.iter().any(|mode| mode.real && apart(&mode.q.iter().map(|z| z.re).collect::<Vec<_>>(), &q) < 0.1)
    };
    assert!(own(&wide), "{:?}", wide.verdict);
}

/// An arm of seven joints with a spherical shoulder and a spherical wrist: a, alpha in right angles, d.
const SEVEN: [(f64, i32, f64); 7] =
    [(0.0, -1, 0.36), (0.0, 1, 0.0), (0.0, 1, 0.42), (0.0, -1, 0.0), (0.0, -1, 0.4), (0.0, 1, 0.0), (0.0, 0, 0.126)];

/// The loop that an arm closes with a pose: what remains of the pose is the last link.
fn closed_at(table: &[(f64, i32, f64)], q: &[f64]) -> Entry {
    let pose = reached(table, q);
    let back = |i: usize, j: usize| match (i, j) {
        (3, _) => f64::from(u8::from(j == 3)),
        (_, 3) => -(0..3).map(|k| pose[k][i] * pose[k][3]).sum::<f64>(),
        _ => pose[j][i],
    };
    let tool = std::array::from_fn(|i| std::array::from_fn(|j| Number::from_f64(back(i, j))));
    let joint = |(a, right_angles, d): &(f64, i32, f64)| json!({ "type": "R", "a": a, "alpha": format!("{} deg", 90 * right_angles), "d": d });
    let joints: Vec<Value> = table.iter().map(joint).collect();
    let mechanism = json!({ "kind": "loop", "convention": "dh", "joints": joints });
    let text = json!({ "title": "seven", "mechanism": mechanism, "input": [{ "joint": 3, "angle": 0.1 }] }).to_string();
    let mut entry = load_text(&text, "loop.json", Format::Json, &Options::default()).unwrap();
    if let Design::Loop(chain) = &mut entry.design {
        chain.tool = Placement::from_matrix(&tool).unwrap().0;
    }
    entry
}

#[test]
fn the_redundancy_of_seven_joints_is_met_in_all_branches() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let q: Vec<f64> = (0..7).map(|_| rng.random_range(-1.5..1.5)).collect();
    let entry = closed_at(&SEVEN, &q);
    let found = redundancy(&entry, 5).unwrap();
    assert_eq!((found.curves, found.closed, found.incomplete), (found.closed, found.curves, 0), "{found:?}");
    let pose = reached(&SEVEN, &q);
    for sample in found.families.iter().flat_map(|family| &family.samples) {
        assert!(off(&reached(&SEVEN, sample), &pose) < 1e-9, "{sample:?}");
    }
    // The configurations with a joint held at another value lie on the curves.
    let mechanism = Mechanism::prepare(&entry).unwrap();
    let answer =
        mechanism.solve(&entry.cases[0], Roots::All, &mut Workspace::default(), &mut Assembly::default()).unwrap();
    let held: Vec<Vec<f64>> =
        answer.modes.iter().filter(|mode| mode.real).map(|mode| mode.q.iter().map(|z| z.re).collect()).collect();
    assert!(!held.is_empty(), "{:?}", answer.verdict);
    for q in held.iter().chain([&q]) {
        let near = found.families.iter().map(|family| beside(family, q)).fold(f64::INFINITY, f64::min);
        assert!(near < 0.12, "{q:?} is {near} off all curves");
    }
}

#[test]
fn three_coaxial_joints_of_a_straight_arm_are_a_surface() {
    // Straight up: the first, the fourth and the sixth axis are one, and the elbow is stretched.
    let quarter = std::f64::consts::FRAC_PI_2;
    let table = [(0.0, -1, 0.36), (0.42, 0, 0.0), (0.0, -1, 0.0), (0.0, 1, 0.4), (0.0, -1, 0.0), (0.0, 0, 0.126)];
    let rounded = reached(&table, &[0.0, -quarter, quarter, 0.0, 0.0, 0.0]);
    let thousandths = |x: f64| (1e3 * x).round() / 1e3;
    let up = rounded.map(|row| row.map(thousandths));
    assert!(off(&rounded, &up) < 1e-15, "{rounded:?}");
    for pose in [up, rounded] {
        let answer = solved(&document(&table, &pose, None));
        check(&table, &pose, &answer, 1e-9);
        let surfaces: Vec<&Family> = answer.families.iter().filter(|family| family.dimension == 2).collect();
        assert_eq!((surfaces.len(), answer.families.len()), (1, 1), "{:?}", answer.families);
        assert_eq!(surfaces[0].moving, [0, 3, 5]);
    }
}

/// The fourth and the fifth axis coincide, so that their joints turn against each other: a curve, by construction. Theorem 5 of
/// docs/exact.md decides it.
#[test]
fn the_self_motion_of_two_coaxial_joints_is_proved() {
    let joint =
        |a: &str, half_tangent: &str, d: &str| json!({ "type": "R", "a": a, "tan_half_alpha": half_tangent, "d": d });
    let joints = [
        joint("2", "inf", "-1"),
        joint("-4", "inf", "-1/2"),
        joint("2", "-1", "0"),
        joint("0", "0", "0"),
        joint("-4/7", "1", "1"),
        joint("-2", "0", "1"),
    ];
    let matrix = json!([
        [0, "1056/2425", "-2183/2425", "56843/16975"],
        [-1, 0, 0, 1],
        [0, "2183/2425", "1056/2425", "15273/33950"],
        [0, 0, 0, 1],
    ]);
    let mechanism = json!({ "kind": "arm", "convention": "dh", "joints": joints });
    let text = json!({ "title": "coaxial", "mechanism": mechanism, "pose": [{ "matrix": matrix }] }).to_string();
    let verdict = solved(&text).verdict;
    assert_eq!(
        (verdict.status, verdict.proof, verdict.self_motion),
        (Status::SelfMotion, Proof::Proved, 1),
        "{}",
        verdict.reason
    );
}

#[test]
fn a_linkage_folded_flat_has_no_more_solutions_than_there_can_be() {
    // Four parallel axes, all in one plane: over the complex numbers solutions form a curve, of which this is the real point.
    let quarter = std::f64::consts::FRAC_PI_2;
    let pose = reached(&PARALLEL, &[0.0, -quarter, 0.0, -quarter, 0.0, 0.0]);
    let answer = solved(&document(&PARALLEL, &pose, None));
    assert!(answer.verdict.complex <= 16 && answer.families.is_empty(), "{:?}", answer.verdict);
    assert!(answer.verdict.status != Status::Unreachable, "{:?}", answer.verdict);
}

#[test]
fn curves_that_meet_in_a_point_are_no_surface() {
    // Folded flat: four parallel axes, and two curves of the four-bar cross there. The dimension is that of a Groebner basis of the
    // closure equations.
    let link =
        |(a, alpha, d): (&str, i32, &str)| json!({ "type": "R", "a": a, "alpha": format!("{alpha} deg"), "d": d });
    let links =
        [("2", 90, "-1"), ("2", -90, "3/2"), ("0", -90, "0"), ("1/2", 0, "-1"), ("2", 180, "-1"), ("0", 180, "0")];
    let pose = json!([[0, 0, 1, "-1/2"], [1, 0, 0, "3/2"], [0, 1, 0, -1], [0, 0, 0, 1]]);
    let joints: Vec<Value> = links.map(link).into();
    let mechanism = json!({ "kind": "arm", "convention": "dh", "joints": joints });
    let text = json!({ "title": "folded", "mechanism": mechanism, "pose": [{ "matrix": pose }] }).to_string();
    let answer = solved(&text);
    assert_eq!(
        (answer.verdict.status, answer.verdict.self_motion),
        (Status::SelfMotion, 1),
        "{}",
        answer.verdict.reason
    );
}
