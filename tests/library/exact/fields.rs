//! Arms whose numbers lie in a number field: truth by construction.

use super::{apart, pick, solved, special_arm};
use looproot::internal::catalogue::entry::{Case, InputValue};
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::exact::{Ground, OverField, OverRationals, Resolution, Solution as Exact, resolve};
use looproot::internal::kinematics::data_field::DataField;
use looproot::internal::mechanism::{Solution, closed_loop};
use looproot::internal::verdict::{Proof, Status};
use looproot_algebra::drawn::Drawn;
use looproot_algebra::enclosure::Enclosure;
use looproot_algebra::number_field::Algebraic;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rug::Rational;
use serde_json::{Value, json};

/// The distinct solutions, real ones among them, and all with multiplicity; `None` where not all are known.
fn counts(ground: &impl Ground) -> Option<[usize; 3]> {
    let Resolution::All(all) = resolve(ground, &[]) else { return None };
    let mut counts = [0; 3];
    for solution in &all {
        let Exact::Found { is_real, multiplicity, .. } = solution else { panic!("none was known") };
        counts[0] += 1;
        counts[1] += usize::from(*is_real);
        counts[2] += multiplicity;
    }
    Some(counts)
}

#[test]
fn rational_arms_are_decided_as_over_a_field_of_degree_one() {
    let mut decided = 0;
    for seed in 0..20 {
        let (text, _) = special_arm(seed);
        let entry = load_text(&text, "arm.json", Format::Json, &Options::default()).unwrap();
        let (chain, case) = (entry.chain().unwrap(), &entry.cases[0]);
        let field = DataField::of(chain, case.pose.as_ref(), None).unwrap();
        assert!(field.is_rational());
        let (_, closed) = closed_loop::<Rational>(chain, case).unwrap().unwrap();
        let (_, modular) = closed_loop::<Drawn>(chain, case).unwrap().unwrap();
        let (_, algebraic) = closed_loop::<Algebraic>(chain, case).unwrap().unwrap();
        let (_, enclosed) = closed_loop::<Enclosure>(chain, case).unwrap().unwrap();
        let over_field = OverField::of(field.0, algebraic, &enclosed).unwrap();
        let Some(by_places) = counts(&over_field) else { continue };
        let by_integers = counts(&OverRationals { closed: &closed, modular: &modular });
        assert_eq!(Some(by_places), by_integers, "special arm {seed}");
        decided += 1;
    }
    assert!(decided > 4, "only {decided} are decided");
}

/// Returns the same arm and pose with all lengths scaled by a number.
fn scaled(text: &str, factor: &str) -> String {
    let mut document: Value = serde_json::from_str(text).unwrap();
    let times = |x: &mut Value| *x = json!(format!("({})*({factor})", x.as_str().unwrap()));
    for joint in document["mechanism"]["joints"].as_array_mut().unwrap() {
        times(&mut joint["a"]);
        times(&mut joint["d"]);
    }
    for row in document["pose"][0]["matrix"].as_array_mut().unwrap().iter_mut().take(3) {
        times(&mut row[3]);
    }
    document.to_string()
}

/// Returns whether every mode of one list is in the other, with its multiplicity.
fn agree(one: &Solution, other: &Solution) -> bool {
    let real = |solution: &Solution| -> Vec<(Vec<f64>, usize)> {
        let modes = solution.modes.iter().filter(|mode| mode.real);
        modes.map(|mode| (mode.q.iter().map(|z| z.re).collect(), mode.multiplicity)).collect()
    };
    let (one, other) = (real(one), real(other));
    let is_in = |(q, m): &(Vec<f64>, usize)| other.iter().any(|(p, n)| apart(p, q) < 1e-9 && m == n);
    one.len() == other.len() && one.iter().all(is_in)
}

#[test]
fn irrational_lengths_leave_the_solutions_as_they_are() {
    let factors = ["sqrt(2)", "cos(20 deg)", "(1+sqrt(3))/2", "sqrt(2)*cos(36 deg)"];
    let mut compared = 0;
    for seed in 0..12 {
        let (text, _) = special_arm(seed);
        let rational = solved(&text);
        let one = &rational.verdict;
        // Finite lists are decided in the field as they are over the rationals.
        if one.status == Status::Complete && one.proof == Proof::Proved {
            let irrational = solved(&scaled(&text, factors[usize::try_from(seed).unwrap() % 4]));
            let other = &irrational.verdict;
            assert_eq!(
                (other.status, other.proof, other.complex),
                (one.status, one.proof, one.complex),
                "{seed}: {}",
                other.reason
            );
            assert!(agree(&rational, &irrational), "{seed}");
            compared += 1;
        }
    }
    assert!(compared > 1, "only {compared} compared");
}

/// An arm with these twists and angles in multiples of some degrees, and the pose that the angles reach.
fn reached(twists: &[i32; 6], angles: &[i32; 6], unit: i32, lengths: &[[&str; 2]; 6]) -> Solution {
    let joints: Vec<Value> = twists
        .iter()
        .zip(lengths)
        .map(|(twist, [a, d])| json!({ "type": "R", "a": a, "alpha": format!("{} deg", twist * unit), "d": d }))
        .collect();
    let identity = json!([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]);
    let document = json!({
        "title": "whole degrees",
        "mechanism": { "kind": "arm", "convention": "dh", "joints": joints },
        "pose": [{ "matrix": identity }],
    });
    let mut entry = load_text(&document.to_string(), "arm.json", Format::Json, &Options::default()).unwrap();
    let angle = |k: &i32| {
        let text = format!("{} deg", k * unit);
        InputValue::Angle(looproot_algebra::number::Angle::parse(&text, &entry.reading).unwrap())
    };
    let values: Vec<InputValue> = angles.iter().map(angle).collect();
    entry.cases[0] = Case::reached(entry.chain().unwrap(), &values, 1).unwrap();
    super::solution(&entry)
}

/// Random arms of whole degrees with their angles: twists and angles in units of the given degrees.
fn whole_degrees(seed: u64) -> ([i32; 6], [i32; 6], [[&'static str; 2]; 6]) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut number = |list: &[&'static str]| pick(&mut random, list).parse().unwrap();
    let twists = std::array::from_fn(|_| number(&["0", "1", "2", "-1", "3"]));
    let angles = std::array::from_fn(|_| number(&["0", "0", "1", "-2", "3"]));
    let lengths =
        std::array::from_fn(|_| [pick(&mut random, &["0", "1", "-1", "1/2"]), pick(&mut random, &["0", "1", "2"])]);
    (twists, angles, lengths)
}

#[test]
fn conjugate_arms_have_as_many_solutions() {
    // cos(40 deg), cos(80 deg) and cos(160 deg) are conjugate, and so are cos(36 deg) and cos(108 deg), sines with them.
    let mut compared = 0;
    for (unit, other) in [(40, 80), (36, 108)] {
        for seed in 0..6 {
            let (twists, angles, lengths) = whole_degrees(seed);
            let [one, two] = [unit, other].map(|unit| reached(&twists, &angles, unit, &lengths));
            for (solution, unit) in [(&one, unit), (&two, other)] {
                assert_ne!(solution.verdict.proof, Proof::RoundedData, "{seed}: {}", solution.verdict.reason);
                let planted: Vec<f64> = angles.iter().map(|k| f64::from(k * unit).to_radians()).collect();
                let own =
                    |mode: &looproot::internal::mechanism::FullMode| mode.q.iter().map(|z| z.re).collect::<Vec<f64>>();
                let is_planted =
                    |mode: &looproot::internal::mechanism::FullMode| mode.real && apart(&own(mode), &planted) < 1e-9;
                let is_proved = solution.verdict.proof == Proof::Proved;
                assert!(!is_proved || solution.modes.iter().any(is_planted), "{seed}: {}", solution.verdict.reason);
            }
            if one.verdict.proof == Proof::Proved && two.verdict.proof == Proof::Proved {
                assert_eq!(one.verdict.complex, two.verdict.complex, "{unit} {seed}");
                compared += 1;
            }
        }
    }
    assert!(compared > 2, "only {compared} compared");
}

#[test]
fn an_arm_with_the_largest_field_is_decided_at_a_singular_pose() {
    // Twists of 37 and 14 degrees lie in the field of cos(1 deg), of degree 48; the wrist is straight.
    let lengths = [["0", "2"], ["1", "0"], ["1/2", "1"], ["0", "1"], ["0", "0"], ["0", "1/2"]];
    let solution = reached(&[37, 0, 14, 90, 90, 0], &[20, 11, 30, 0, 0, 0], 1, &lengths);
    let verdict = &solution.verdict;
    assert!(verdict.proof == Proof::Proved || verdict.status == Status::SelfMotion, "{}", verdict.reason);
}

#[test]
fn numbers_of_no_small_field_are_rounded() {
    let (text, _) = special_arm(1);
    let solution = solved(&scaled(&text, "cos(1 deg)*sqrt(7)"));
    assert!(
        matches!(solution.verdict.proof, Proof::RoundedData | Proof::None | Proof::Proved),
        "{:?}",
        solution.verdict.proof
    );
    // Fewer solutions than the general number are never proved of rounded numbers.
    assert!(solution.verdict.proof != Proof::Proved || solution.verdict.complex == 16);
}
