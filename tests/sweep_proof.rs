//! Proved sweeps: loops of the library, exact counts at random inputs, and circuits far smaller than a step.
#![allow(clippy::unwrap_used)]

use looproot::catalogue::entry::{Case, Entry, Input, InputValue};
use looproot::catalogue::{Format, Options, load, load_text};
use looproot::derivation::derive;
use looproot::kinematics::closed_loop::Variable;
use looproot::sweep::{Branch, Range, Sweep, sweep};
use looproot::verdict::{Code, Proof, Status};
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

/// How many branches there are at an input.
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
fn other_loops_and_rounded_numbers_are_not_proved() {
    let found = turn(&entry("rssr"), 1, 6);
    assert_eq!((found.verdict.proof, found.verdict.code), (Proof::RoundedData, Code::BranchesProved));
    let found = turn(&entry("goldberg_a"), 1, 6);
    assert_eq!((found.verdict.proof, found.verdict.code), (Proof::None, Code::NoExactRoute));
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
            let exact = looproot::algebra::number::HalfTangent::Finite(half_tangent);
            let angle = looproot::algebra::number::Angle::from_half_tangent(exact);
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
