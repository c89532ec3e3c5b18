//! Proved sweeps: loops of the library, exact counts at random inputs, and circuits far smaller than a step.
#![allow(clippy::unwrap_used)]

use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::entry::{Case, Entry, Input, InputValue};
use looproot::internal::catalogue::{Format, Options, load, load_text};
use looproot::internal::derivation::derive;
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::mechanism::Mechanism;
use looproot::internal::sweep::{Branch, End, Range, Row, Sweep, sweep};
use looproot::internal::verdict::{Code, Proof, Status};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;
use std::f64::consts::{PI, TAU};

fn entry(name: &str) -> Entry {
    load(name, &Options::default()).unwrap()
}

fn read(text: &str) -> Entry {
    load_text(text, "own.toml", Format::Toml, &Options::default()).unwrap()
}

fn turn(entry: &Entry, joint: usize, steps: usize) -> Sweep {
    swept(entry, joint, Variable::Rotation, [-PI, PI], steps)
}

fn swept(entry: &Entry, joint: usize, variable: Variable, [from, to]: [f64; 2], steps: usize) -> Sweep {
    sweep(entry, joint, variable, Range { from, to, steps }, || true, || {}).unwrap()
}

/// The number of branches at an input.
fn branches_at(found: &Sweep, input: f64) -> usize {
    let times = |branch: &Branch| {
        let (low, high) = (branch.from.min(branch.to), branch.from.max(branch.to));
        let first = input + TAU * ((low - input) / TAU).ceil();
        (0..4).filter(|turn| first + TAU * f64::from(*turn) <= high).count()
    };
    found.branches.iter().map(times).sum()
}

#[test]
fn loops_of_degree_8_at_most_are_proved() {
    for (name, joint) in [
        ("cccr_1_angle", 1),
        ("cccr_2_angle", 2),
        ("cccr_4_angle", 4),
        ("cpcrr_4_angle", 4),
        ("cprprr_5_angle", 5),
        ("crpprr_5_angle", 5),
        ("ppprrrr_4_angle", 4),
        ("prprprr_6_angle", 6),
        ("crcrr_2_angle", 2),
        ("crcrr_4_angle", 4),
        ("ccrrr_4_angle", 4),
        ("cprrrr_1_angle", 1),
        ("rrsrr", 1),
        ("rsrc", 1),
        ("homokinetic_rrsrr", 1),
        ("planar_4r", 1),
        ("spherical_4r", 1),
        ("slider_crank", 1),
        ("bennett_a", 1),
        ("bennett_b", 2),
    ] {
        for steps in [6, 24] {
            let found = turn(&entry(name), joint, steps);
            assert_eq!(found.verdict.code, Code::BranchesProved, "{name}, {steps} steps: {}", found.verdict.reason);
            assert_eq!((found.verdict.proof, found.verdict.status), (Proof::Proved, Status::Complete), "{name}");
            assert_eq!(found.unresolved(), 0, "{name}");
        }
    }
    for name in ["cprcr_2_distance", "ccprr_3_distance", "ppprrrr_1_distance"] {
        let loaded = entry(name);
        let joint = loaded.cases[0].input[0].joint;
        let found = swept(&loaded, joint, Variable::Translation, [-3.0, 3.0], 7);
        assert_eq!(found.verdict.code, Code::BranchesProved, "{name}: {}", found.verdict.reason);
    }
}

#[test]
fn far_solutions_beside_a_pole_are_no_self_motion() {
    // 1e-5 radians beside the input at which its translations grow beyond all bounds, PRRPRRR has solutions 10^5 units away.
    let found = turn(&entry("prrprrr_6_angle"), 6, 6);
    assert_eq!(
        (found.verdict.proof, found.verdict.code),
        (Proof::Proved, Code::BranchesProved),
        "{}",
        found.verdict.reason
    );
    assert!(found.branches.iter().any(|branch| matches!(branch.end, End::Infinite(_))));
}

#[test]
fn branches_that_cross_beside_others_pass() {
    // The plane of symmetry holds a circuit of its own, which the other one crosses: one output tells them apart only by a node.
    for (name, limits) in [("homokinetic_rrsrr", 4), ("dietmaier_a", 6)] {
        let found = turn(&entry(name), 1, 24);
        assert_eq!(
            (found.verdict.proof, found.verdict.code),
            (Proof::Proved, Code::BranchesProved),
            "{name}: {}",
            found.verdict.reason
        );
        assert_eq!(found.limits.len(), limits, "{name}");
    }
    // By reflection q5 = -q1 - 180 degrees is an assembly at every input.
    let found = turn(&entry("homokinetic_rrsrr"), 1, 24);
    let off = |row: &Row| {
        let q = &found.samples[row.step].modes[row.mode];
        let sum = (q[0] + q[6] + PI).rem_euclid(TAU);
        sum.min(TAU - sum)
    };
    let mirrored: Vec<usize> =
        found.branches.iter().map(|branch| branch.rows.iter().filter(|row| off(row) < 1e-9).count()).collect();
    let whole = found.branches.iter().zip(&mirrored).filter(|(branch, count)| branch.rows.len() == **count).count();
    assert_eq!((whole, mirrored.iter().filter(|count| **count == 0).count()), (2, 2), "{mirrored:?}");
}

#[test]
fn three_axes_through_a_point_are_a_spherical_joint_twice() {
    for (wrist, spherical) in [("rscr_as_3r", "rscr"), ("rrsrr_as_7r", "rrsrr")] {
        let [found, single] = [wrist, spherical].map(|name| turn(&entry(name), 1, 12));
        assert_eq!(
            (found.verdict.proof, found.verdict.code),
            (Proof::Proved, Code::BranchesProved),
            "{wrist}: {}",
            found.verdict.reason
        );
        assert_eq!(found.branches.len(), 2 * single.branches.len(), "{wrist}");
        let inputs = |found: &Sweep, times: usize| {
            let mut all: Vec<f64> = found.limits.iter().flat_map(|limit| vec![limit.input; times]).collect();
            all.sort_by(f64::total_cmp);
            all
        };
        let (own, other) = (inputs(&found, 1), inputs(&single, 2));
        assert_eq!(own.len(), other.len(), "{wrist}");
        assert!(own.iter().zip(&other).all(|(a, b)| (a - b).abs() < 1e-9), "{wrist}: {own:?}, {other:?}");
    }
}

#[test]
fn other_loops_and_rounded_numbers_are_not_proved() {
    let found = turn(&entry("rssr"), 1, 6);
    assert_eq!((found.verdict.proof, found.verdict.code), (Proof::RoundedData, Code::BranchesProved));
    let found = turn(&entry("general_7r"), 1, 6);
    assert_eq!((found.verdict.proof, found.verdict.code), (Proof::None, Code::NoExactRoute));
}

#[test]
fn overconstrained_loops_of_five_and_six_joints_are_proved() {
    let mut random = ChaCha8Rng::seed_from_u64(16);
    for (name, joint) in [
        ("goldberg_a", 1),
        ("goldberg_subtractive", 4),
        ("myard_b", 1),
        ("rrrrp_parallel_pairs", 1),
        ("bennett_dyads_b", 1),
        ("bricard_trihedral_a", 1),
        ("bricard_plane_symmetric_a", 1),
        ("waldron_hybrid", 1),
        ("wohlhart_hybrid_a", 2),
    ] {
        let loaded = entry(name);
        let found = turn(&loaded, joint, 6);
        assert_eq!(found.verdict.code, Code::BranchesProved, "{name}: {}", found.verdict.reason);
        assert_eq!((found.verdict.proof, found.unresolved()), (Proof::Proved, 0), "{name}");
        for _ in 0..4 {
            let half_tangent = Rational::from((random.random_range(-90..90), 40));
            let input = 2.0 * half_tangent.to_f64().atan();
            let exact = looproot_algebra::number::HalfTangent::Finite(half_tangent);
            let angle = looproot_algebra::number::Angle::from_half_tangent(exact);
            let case = Case::given(Input { joint, value: InputValue::Angle(angle) }, 0);
            let mechanism = Mechanism::prepare(&Entry { cases: vec![case.clone()], ..loaded.clone() }).unwrap();
            let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
            let solution = mechanism.solve(&case, Roots::All, &mut workspace, &mut assembly).unwrap();
            assert_eq!(solution.verdict.proof, Proof::Proved, "{name}: {}", solution.verdict.reason);
            assert_eq!(branches_at(&found, input), solution.verdict.real, "{name} at {input}");
        }
    }
}

#[test]
fn every_joint_of_a_slider_crank_is_an_input() {
    let loaded = entry("slider_crank");
    for joint in 1..=3 {
        let found = turn(&loaded, joint, 6);
        assert_eq!(found.verdict.code, Code::BranchesProved, "{joint}: {}", found.verdict.reason);
    }
    let found = swept(&loaded, 4, Variable::Translation, [-6.0, 6.0], 6);
    assert_eq!(found.verdict.code, Code::BranchesProved, "{}", found.verdict.reason);
}

#[test]
fn branches_are_as_many_as_exact_real_roots() {
    let mut random = ChaCha8Rng::seed_from_u64(14);
    for (name, joint) in [("crcrr_2_angle", 2), ("ccrrr_4_angle", 4), ("rrsrr", 1), ("cccr_1_angle", 1)] {
        let loaded = entry(name);
        let found = turn(&loaded, joint, 6);
        for _ in 0..50 {
            let half_tangent = Rational::from((random.random_range(-400..400), random.random_range(1..200)));
            let input = 2.0 * half_tangent.to_f64().atan();
            let exact = looproot_algebra::number::HalfTangent::Finite(half_tangent);
            let angle = looproot_algebra::number::Angle::from_half_tangent(exact);
            let case = Case::given(Input { joint, value: InputValue::Angle(angle) }, 0);
            let polynomial = derive(&loaded, &case).unwrap().polynomial.unwrap();
            let count = polynomial.roots.len() + polynomial.at_pi;
            assert_eq!(branches_at(&found, input), count, "{name} at {input}");
        }
    }
}

/// Two spherical joints and a link whose length decides whether the loop closes at all.
fn rssr(length: &Rational) -> Entry {
    read(&format!(
        "[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n\
         {{ type = \"R\", a = 2, tan_half_alpha = \"1/3\", d = 1 }},\n\
         {{ type = \"S\", a = \"{length}\", tan_half_alpha = 0 }},\n\
         {{ type = \"S\", a = 3, tan_half_alpha = 0 }},\n\
         {{ type = \"R\", a = 1, tan_half_alpha = \"1/2\", d = \"-1/2\" }},\n]\n[[input]]\njoint = 1\nangle = 0\n"
    ))
}

#[test]
fn the_smallest_circuit_is_met_with_few_steps() {
    // The shortest link with which the loop closes, between one without and one with branches.
    let (mut low, mut high) = (Rational::from((1, 1000)), Rational::from(3));
    assert!(turn(&rssr(&low), 1, 6).branches.is_empty());
    assert!(!turn(&rssr(&high), 1, 6).branches.is_empty());
    for _ in 0..20 {
        let middle = Rational::from(&low + &high) / 2;
        let found = turn(&rssr(&middle), 1, 6);
        assert_eq!(found.verdict.code, Code::BranchesProved, "{middle}: {}", found.verdict.reason);
        if found.branches.is_empty() { low = middle } else { high = middle }
    }
    for steps in [1, 6, 24] {
        let found = turn(&rssr(&high), 1, steps);
        assert_eq!((found.branches.len(), found.limits.len(), found.verdict.proof), (2, 2, Proof::Proved));
        let width = found.limits[1].input - found.limits[0].input;
        assert!(width > 0.0 && width < 7e-3, "{width}");
        let found = turn(&rssr(&low), 1, steps);
        assert_eq!((found.branches.len(), found.verdict.status), (0, Status::Unreachable));
    }
}

/// A four-bar of parallel or concurrent axes: what each link has for a length, or for the tangent of half its twist.
fn four_bar(links: [&str; 4], is_planar: bool) -> Entry {
    let key = if is_planar { ("a", "tan_half_alpha") } else { ("tan_half_alpha", "a") };
    let joint = |link: &str| format!("{{ type = \"R\", {} = \"{link}\", {} = 0, d = 0 }},\n", key.0, key.1);
    let joints: String = links.iter().map(|link| joint(link)).collect();
    read(&format!("[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n{joints}]\n"))
}

/// Returns the number of positions of a planar four-bar: two circles meet, about the ends of the links at the input.
fn circles(lengths: [f64; 4], joint: usize, input: f64) -> usize {
    let length = |k: usize| lengths[(joint + k) % 4];
    let (before, behind) = (length(2), length(3));
    let apart = (before * before + behind * behind + 2.0 * before * behind * input.cos()).sqrt();
    let (one, two) = (length(0), length(1));
    2 * usize::from((one - two).abs() < apart && apart < one + two)
}

#[test]
fn planar_four_bars_that_fold_are_proved() {
    let mut random = ChaCha8Rng::seed_from_u64(15);
    for (lengths, standing) in [
        // Parallelogram, rhombus, kite, two that only fold, and one with a joint that never turns round.
        ([2, 3, 2, 3], [0; 4]),
        ([2, 2, 2, 2], [1; 4]),
        ([2, 2, 3, 3], [0, 1, 0, 1]),
        ([2, 5, 4, 3], [0; 4]),
        ([1, 5, 3, 3], [0; 4]),
        ([7, 3, 4, 6], [0; 4]),
    ] {
        let loaded = four_bar(lengths.map(|x: i32| x.to_string()).each_ref().map(String::as_str), true);
        for joint in 1..=4 {
            let found = turn(&loaded, joint, 6);
            assert_eq!(found.verdict.code, Code::BranchesProved, "{lengths:?} {joint}: {}", found.verdict.reason);
            assert_eq!((found.verdict.proof, found.unresolved()), (Proof::Proved, 0));
            assert_eq!(found.standing.len(), standing[joint - 1], "{lengths:?} {joint}: {:?}", found.standing);
            for _ in 0..40 {
                let input = random.random_range(-PI..PI);
                let count = circles(lengths.map(f64::from), joint, input);
                assert_eq!(branches_at(&found, input), count, "{lengths:?}, joint {joint} at {input}");
            }
        }
    }
}

#[test]
fn branches_pass_each_other_where_a_parallelogram_is_flat() {
    let found = turn(&four_bar(["2", "3", "2", "3"], true), 1, 24);
    assert_eq!((found.branches.len(), found.limits.len()), (2, 0));
    let opposite = |branch: &Branch| {
        let turned = |row: &looproot::internal::sweep::Row| {
            let q = &found.samples[row.step].modes[row.mode];
            (q[0] - q[2]).sin().abs() < 1e-9 && (q[0] + q[1]).sin().abs() < 1e-9
        };
        // Flat positions belong to both.
        branch.rows.iter().filter(|row| turned(row)).count()
    };
    let counts: Vec<usize> = found.branches.iter().map(opposite).collect();
    assert!(counts.iter().any(|count| *count >= 22) && counts.iter().any(|count| *count <= 3), "{counts:?}");
}

#[test]
fn spherical_four_bars_that_fold_are_proved() {
    for links in [
        ["1/3", "1/2", "1/3", "1/2"],
        ["1/3", "1/3", "1/3", "1/3"],
        ["1/3", "1/3", "1/2", "1/2"],
        // tan(a + b) of half angles: 1/2 and 1/3 are as much as 1/5 and 2/3.
        ["1/2", "1/3", "1/5", "2/3"],
        ["1/2", "1/5", "1/3", "2/3"],
    ] {
        let loaded = four_bar(links, false);
        for joint in 1..=4 {
            for steps in [6, 24] {
                let found = turn(&loaded, joint, steps);
                assert_eq!(found.verdict.code, Code::BranchesProved, "{links:?} {joint}: {}", found.verdict.reason);
            }
        }
    }
}
