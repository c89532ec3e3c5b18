//! Arms at multiple roots, near them, and in special geometry: verdicts against Groebner bases and against the exact side alone.
#![allow(clippy::unwrap_used)]

use looproot::internal::assembly::{Assembly, Roots, Workspace, wrapped};
use looproot::internal::catalogue::entry::{Case, Entry, InputValue};
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::exact::{OverRationals, Resolution, Solution as Exact, resolve};
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::mechanism::{Mechanism, Solution, closed_loop};
use looproot::internal::verdict::{Proof, Status};
use looproot_algebra::drawn::Drawn;
use looproot_algebra::number::{Angle, Number};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;
use serde_json::{Value, json};

mod dependent;
mod fields;

/// Entries of the list: mechanism and pose as a file has them, and the truth.
const ARMS: &str = include_str!("exact/arms.json");

fn solved(text: &str) -> Solution {
    solution(&load_text(text, "arm.json", Format::Json, &Options::default()).unwrap())
}

/// The answer to the first case of a file.
fn solution(entry: &Entry) -> Solution {
    let mechanism = Mechanism::prepare(entry).unwrap();
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap()
}

fn document(arm: &Value) -> String {
    json!({ "title": arm["title"], "mechanism": arm["mechanism"], "pose": arm["pose"] }).to_string()
}

/// The largest difference of two lists of angles.
fn apart(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| wrapped(a - b).abs()).fold(0.0, f64::max)
}

/// Returns the fault of an answer, judged by the truth.
fn fault(arm: &Value, answer: &Solution) -> Option<String> {
    let verdict = &answer.verdict;
    let dimension = arm["dimension"].as_u64().unwrap();
    if verdict.status == Status::SelfMotion {
        let found = verdict.self_motion as u64;
        return (found > dimension).then(|| format!("a self-motion of dimension {found} in place of {dimension}"));
    }
    let is_done = matches!(verdict.status, Status::Complete | Status::Unreachable) && verdict.proof == Proof::Proved;
    if !is_done {
        return (arm["must"] == "complete").then(|| format!("not proved: {}", verdict.reason));
    }
    if dimension > 0 {
        return Some(format!("complete, but the solutions have dimension {dimension}"));
    }
    let count = usize::try_from(arm["count"].as_u64().unwrap()).unwrap();
    if verdict.complex != count {
        return Some(format!("{} solutions in place of {count}", verdict.complex));
    }
    if let Some(real) = arm["real_with_multiplicity"].as_u64()
        && verdict.real as u64 != real
    {
        return Some(format!("{} real solutions with multiplicity in place of {real}", verdict.real));
    }
    let truth: Vec<Vec<f64>> = arm["reals"]
        .as_array()?
        .iter()
        .map(|q| q.as_array().unwrap().iter().map(|x| x.as_str().unwrap().parse().unwrap()).collect())
        .collect();
    let real: Vec<_> = answer.modes.iter().filter(|mode| mode.real && !mode.near).collect();
    if real.len() != truth.len() {
        return Some(format!("{} distinct real solutions in place of {}", real.len(), truth.len()));
    }
    for mode in real {
        let own: Vec<f64> = mode.q.iter().map(|z| z.re).collect();
        let off = truth.iter().map(|q| apart(&own, q)).fold(f64::INFINITY, f64::min);
        // The truth is given to 25 digits, and an f64 rounds.
        if !(off <= mode.radius + 1e-15) {
            return Some(format!("certified within {:e}, off by {off:e}", mode.radius));
        }
    }
    None
}

#[test]
fn verdicts_on_special_arms_agree_with_groebner_bases() {
    let list: Value = serde_json::from_str(ARMS).unwrap();
    let arms = list["arms"].as_array().unwrap();
    assert!(arms.len() > 30);
    let faults: Vec<String> = arms
        .iter()
        .filter_map(|arm| Some(format!("{}: {}", arm["title"], fault(arm, &solved(&document(arm)))?)))
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// A random entry of a list.
fn pick(random: &mut impl Rng, list: &[&'static str]) -> &'static str {
    list[random.random_range(0..list.len())]
}

/// Cosine and sine from a half-angle tangent.
fn turn(tangent: &str) -> (Rational, Rational) {
    if tangent == "inf" {
        return (Rational::from(-1), Rational::new());
    }
    let t: Rational = tangent.parse().unwrap();
    let scale = (Rational::from(&t * &t) + 1_u32).recip();
    ((1 - Rational::from(&t * &t)) * &scale, Rational::from(2) * t * scale)
}

/// A half-angle tangent, or one that is off by `1e-3` to `1e-13`.
fn near(random: &mut impl Rng, tangent: &str) -> String {
    if tangent == "inf" || random.random_range(0..4) > 0 {
        return tangent.to_owned();
    }
    let off = Rational::from((1, 10_u64.pow(random.random_range(3..=13))));
    (tangent.parse::<Rational>().unwrap() + off).to_string()
}

/// An arm of rotations with zeros, right angles and parallel axes, at the pose of a configuration that is singular as a rule or
/// beside such a one, and that configuration.
fn special_arm(seed: u64) -> (String, Vec<f64>) {
    special_arm_with(seed, 0, &LENGTHS)
}

/// Lengths and offsets of special arms.
const LENGTHS: [&[&str]; 2] = [&["0", "0", "1", "-1", "2", "1/2"], &["0", "0", "1", "-2", "3/2"]];
/// Arms with lengths of all sizes are decided alike.
const OF_ALL_SIZES: [&[&str]; 2] =
    [&["0", "1", "100000000", "1/100000000", "-3/2"], &["0", "0", "1/100000000", "-200000000", "1", "7/100"]];

/// Returns a special arm with this many translations among the first joints, of these lengths and offsets.
fn special_arm_with(seed: u64, translations: usize, lengths: &[&[&'static str]; 2]) -> (String, Vec<f64>) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (mut joints, mut values) = (Vec::new(), Vec::new());
    let places: Vec<usize> = [1, 3, 5].map(|k| (k * usize::try_from(seed).unwrap()) % 6).to_vec();
    let mut pose: Motion<Rational> = Motion::identity();
    // Half of the arms stand at the special configuration itself; the draw of how far off the others are leaves theirs as it is.
    let mut beside = ChaCha8Rng::seed_from_u64(seed);
    let is_beside = beside.random_bool(0.5);
    for joint in 0..6 {
        let a = pick(&mut random, lengths[0]);
        let twist = pick(&mut random, &["0", "0", "1", "-1", "1", "1/2", "inf"]);
        let d = pick(&mut random, lengths[1]);
        let angle = pick(&mut random, &["0", "0", "1", "-1", "inf", "1/2", "-1/3"]);
        let angle = if is_beside { near(&mut beside, angle) } else { angle.to_owned() };
        let (cos, sin) = turn(&angle);
        if places[..translations].contains(&joint) {
            joints.push(json!({ "type": "P", "a": a, "tan_half_alpha": twist, "tan_half_theta": angle }));
            values.push(d.parse::<Rational>().unwrap().to_f64());
        } else {
            joints.push(json!({ "type": "R", "a": a, "tan_half_alpha": twist, "d": d }));
            values.push(sin.to_f64().atan2(cos.to_f64()));
        }
        let shift = Motion::translation_z(d.parse().unwrap());
        let link = Motion::link(a.parse().unwrap(), turn(twist));
        pose = pose.then_after(&Motion::rotation_z(cos, sin)).then_after(&shift).then_after(&link);
    }
    let row = |i: usize| -> Vec<String> {
        pose.rotation[i].iter().chain([&pose.translation[i]]).map(ToString::to_string).collect()
    };
    let text = json!({
        "title": format!("special arm {seed}"),
        "mechanism": { "kind": "arm", "convention": "dh", "joints": joints },
        "pose": [{ "matrix": [row(0), row(1), row(2), ["0", "0", "0", "1"]] }],
    });
    (text.to_string(), values)
}

/// Returns the contradiction in the answer to a special arm: the planted configuration is not listed, or the exact side alone
/// counts other solutions.
fn contradiction(seed: u64, translations: usize, lengths: &[&[&'static str]; 2]) -> Option<String> {
    let (text, planted) = special_arm_with(seed, translations, lengths);
    let answer = solved(&text);
    let verdict = &answer.verdict;
    let is_proved = verdict.proof == Proof::Proved;
    let fault =
        |what: String| Some(format!("special arm {seed}, {translations} translations: {what}; {}", verdict.reason));
    if verdict.status == Status::Unreachable && is_proved {
        return fault("a pose that is reached is called unreachable".to_owned());
    }
    if !(verdict.status == Status::Complete && is_proved) {
        return None;
    }
    let own = |mode: &looproot::internal::mechanism::FullMode| mode.q.iter().map(|z| z.re).collect::<Vec<f64>>();
    let nearest = answer.modes.iter().filter(|m| m.real).map(|mode| apart(&own(mode), &planted));
    if !(nearest.fold(f64::INFINITY, f64::min) < 1e-9) {
        return fault("the planted configuration is lost".to_owned());
    }
    let entry = load_text(&text, "arm.json", Format::Json, &Options::default()).unwrap();
    let (chain, case) = (entry.chain().unwrap(), &entry.cases[0]);
    let (_, exact) = closed_loop::<Rational>(chain, case).unwrap().unwrap();
    let (_, modular) = closed_loop::<Drawn>(chain, case).unwrap().unwrap();
    // Without any help from f64.
    let ground = OverRationals { closed: &exact, modular: &modular };
    let Resolution::All(all) = resolve(&ground, &[]) else { return None };
    let count = |wanted: fn(bool) -> bool| -> (usize, usize) {
        all.iter().fold((0, 0), |(distinct, total), solution| match solution {
            Exact::Found { is_real, multiplicity, .. } if wanted(*is_real) => (distinct + 1, total + multiplicity),
            _ => (distinct, total),
        })
    };
    let (real, all) = (count(|is_real| is_real), count(|_| true));
    let found_real = answer.modes.iter().filter(|mode| mode.real).count();
    if (real.0, all.1) != (found_real, verdict.complex) {
        return fault(format!("{found_real} real of {} against {} real of {}", verdict.complex, real.0, all.1));
    }
    None
}

#[test]
fn special_arms_do_not_contradict_the_exact_side() {
    // A long run is asked for by the number of arms: LOOPROOT_SPECIAL_ARMS=100000.
    let count = std::env::var("LOOPROOT_SPECIAL_ARMS").ok().and_then(|n| n.parse().ok()).unwrap_or(60);
    let faults: Vec<String> = (0..count).filter_map(|seed| contradiction(seed, 0, &LENGTHS)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    let proved = (0..20).filter(|seed| solved(&special_arm(*seed).0).verdict.proof == Proof::Proved).count();
    // Most of the others move.
    assert!(proved > 3, "only {proved} of 20 are proved");
}

#[test]
fn special_arms_with_translations_do_not_contradict_the_exact_side() {
    let count = std::env::var("LOOPROOT_SPECIAL_ARMS").ok().and_then(|n| n.parse().ok()).unwrap_or(12);
    let both = (0..count).flat_map(|seed| [(seed, 1), (seed, 2)]);
    let faults: Vec<String> =
        both.filter_map(|(seed, translations)| contradiction(seed, translations, &LENGTHS)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn arms_of_lengths_of_all_sizes_do_not_contradict_the_exact_side() {
    let count = std::env::var("LOOPROOT_SPECIAL_ARMS").ok().and_then(|n| n.parse().ok()).unwrap_or(16);
    let faults: Vec<String> = (0..count).filter_map(|seed| contradiction(seed, 0, &OF_ALL_SIZES)).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_double_solution_of_an_arm_with_a_translation_is_proved() {
    // At the planted configuration the six joint screws are dependent, by construction.
    let joints = json!([
        { "type": "R", "a": 1, "tan_half_alpha": -1, "d": 0 },
        { "type": "P", "a": 0, "tan_half_alpha": 0, "tan_half_theta": 0 },
        { "type": "R", "a": -1, "tan_half_alpha": 0, "d": 1 },
        { "type": "R", "a": -1, "tan_half_alpha": -1, "d": 1 },
        { "type": "R", "a": 0, "tan_half_alpha": -1, "d": 0 },
        { "type": "R", "a": 0, "tan_half_alpha": 0, "d": 2 },
    ]);
    let identity = json!([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]);
    let document = json!({
        "title": "double",
        "mechanism": { "kind": "arm", "convention": "dh", "joints": joints },
        "pose": [{ "matrix": identity }],
    });
    let mut entry = load_text(&document.to_string(), "arm.json", Format::Json, &Options::default()).unwrap();
    let angle = |text: &str| InputValue::Angle(Angle::parse(text, &entry.reading).unwrap());
    let mut values = ["0", "0", "-90 deg", "180 deg", "-90 deg", "90 deg"].map(angle).to_vec();
    values[1] = InputValue::Distance(Number::zero());
    entry.cases[0] = Case::reached(entry.chain().unwrap(), &values, 1).unwrap();
    let answer = solution(&entry);
    assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::Complete, Proof::Proved));
    let quarter = std::f64::consts::FRAC_PI_2;
    let planted = [0.0, 0.0, -quarter, 2.0 * quarter, -quarter, quarter];
    let own = |mode: &looproot::internal::mechanism::FullMode| mode.q.iter().map(|z| z.re).collect::<Vec<f64>>();
    assert!(
        answer.modes.iter().any(|mode| mode.multiplicity == 2 && apart(&own(mode), &planted) <= mode.radius + 1e-15)
    );
}
