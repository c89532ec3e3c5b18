//! Real assemblies by boxes of angles, beside the pencil and beside assemblies that were planted.
#![allow(clippy::unwrap_used)]

use crate::arms;

use arms::random;
use looproot::internal::catalogue::{Any, Format, LinkageFile, Options, any_from_text};
use looproot::internal::linkage::answer::{LinkageAnswer, solve};
use looproot::internal::linkage::assembly::groups_of;
use looproot::internal::linkage::boxes::{LONG, RealAssemblies, real_assemblies};
use looproot::internal::linkage::equations::{Closure, Equations};
use looproot::internal::linkage::general::general;
use looproot::internal::linkage::isotropic::Value;
use looproot::internal::linkage::krawczyk::Proved;
use looproot::internal::linkage::state::{Number, State};
use looproot::internal::verdict::{Code, Proof, Status};
use rand::Rng;
use rug::Rational;
use std::sync::atomic::AtomicBool;

/// Rotations with rational cosine and sine: a/c and b/c.
const TRIPLES: [[i64; 3]; 5] = [[3, 4, 5], [5, 12, 13], [8, 15, 17], [7, 24, 25], [20, 21, 29]];

/// What stands before the bodies of a structure.
const HEAD: &str = "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"b0\"\njoints = \"shared points\"\n[mechanism.bodies]\n";

/// A linkage with an assembly in it: the angles of its bodies.
struct Planted {
    bodies: Vec<String>,
    angles: Vec<f64>,
}

impl Planted {
    fn text(&self) -> String {
        format!("{HEAD}{}", self.bodies.concat())
    }
}

/// Bodies between points whose places in the assembly are drawn: every joint is a pair of bodies.
fn planted(joints: &[[usize; 2]], bodies: usize, seed: u64) -> Planted {
    let mut random = random(seed);
    // A body whose two points coincide would turn freely.
    let mut places: Vec<[i64; 2]> = Vec::new();
    while places.len() < joints.len() {
        let place = [random.random_range(-9..=9), random.random_range(-9..=9)];
        if !places.contains(&place) {
            places.push(place);
        }
    }
    let mut planted = Planted { bodies: Vec::new(), angles: Vec::new() };
    for body in 0..bodies {
        let [a, b, c] = if body == 0 { [1, 0, 1] } else { TRIPLES[random.random_range(0..TRIPLES.len())] };
        let (a, b) = if random.random_bool(0.5) && body > 0 { (-a, b) } else { (a, b) };
        let origin = if body == 0 { [0, 0] } else { [random.random_range(-9..=9), random.random_range(-9..=9)] };
        planted.angles.push((b as f64).atan2(a as f64));
        let points = joints.iter().zip(&places).enumerate().filter(|(_, (of, _))| of.contains(&body));
        let points: Vec<String> = points
            .map(|(k, (_, place))| {
                let (x, y) = (place[0] - origin[0], place[1] - origin[1]);
                // The rotation back: a - i b over c.
                format!("p{k} = [\"{}/{c}\", \"{}/{c}\"]", a * x + b * y, a * y - b * x)
            })
            .collect();
        planted.bodies.push(format!("b{body} = {{ {} }}\n", points.join(", ")));
    }
    planted
}

fn file(text: &str) -> Box<LinkageFile> {
    match any_from_text(text, "test.toml", Format::Toml, &Options::default()).unwrap() {
        Any::Linkage(file) => file,
        _ => panic!("a linkage in the plane"),
    }
}

/// The ground and `count` bodies on it, neighbours joined by bars: a structure of 2 `count` + 1 links.
fn ring(count: usize) -> (Vec<[usize; 2]>, usize) {
    let mut joints: Vec<[usize; 2]> = (1..=count).map(|body| [0, body]).collect();
    for body in 1..=count {
        joints.push([body, count + body]);
        joints.push([count + body, body % count + 1]);
    }
    (joints, 2 * count + 1)
}

/// The equations of the only group of a structure without inputs.
fn equations(file: &LinkageFile) -> Equations<Number> {
    let groups = groups_of(&file.linkage, &[]).unwrap();
    assert_eq!(groups.list.len(), 1);
    let state: State<Value> = State::new(file.linkage.bodies.len(), 1);
    Closure::new(&file.linkage, &groups.list[0], &state).unwrap().equations
}

fn by_boxes(file: &LinkageFile) -> RealAssemblies {
    real_assemblies(&equations(file), LONG, &AtomicBool::new(false)).unwrap()
}

/// The angles of all classes against the first.
fn angles(proved: &Proved) -> Vec<f64> {
    let middles: Vec<_> = proved.root.turns.iter().map(|turn| turn.z.middle()).collect();
    middles.iter().map(|z| (z / middles[0]).arg()).collect()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let turned = |x: f64| (x - std::f64::consts::TAU * (x / std::f64::consts::TAU).round()).abs();
    a.iter().zip(b).map(|(x, y)| turned(x - y)).fold(0.0, f64::max)
}

/// Boxes list the real assemblies of the pencil, each once.
fn agree(file: &LinkageFile) -> Vec<Vec<f64>> {
    let (boxes, pencil) = (by_boxes(file), general(&equations(file)));
    assert_eq!(boxes.doubt, None);
    assert_eq!(pencil.most, Some(pencil.solutions.len()), "{:?}", pencil.doubt);
    let known: Vec<Vec<f64>> = pencil.solutions.iter().filter(|one| one.real == Some(true)).map(angles).collect();
    let found: Vec<Vec<f64>> = boxes.solutions.iter().map(angles).collect();
    assert_eq!(found.len(), known.len());
    for one in &known {
        assert_eq!(found.iter().filter(|other| distance(one, other) < 1e-12).count(), 1);
    }
    // Complex assemblies are pairs, and these counts are even.
    assert_eq!(found.len() % 2, pencil.solutions.len() % 2);
    found
}

/// The structures of five links, of seven with 18, 16 and 14 assemblies, and one of nine.
fn structures() -> Vec<(Vec<[usize; 2]>, usize)> {
    let triad = vec![[0, 1], [0, 2], [0, 3], [1, 4], [2, 4], [3, 4]];
    let eighteen = vec![[0, 1], [0, 2], [0, 5], [0, 6], [1, 4], [2, 3], [3, 4], [3, 6], [4, 5]];
    vec![(triad, 5), (eighteen, 7), ring(3), ring(4)]
}

#[test]
fn boxes_agree_with_the_pencil() {
    for (joints, bodies) in structures() {
        for seed in 0..if bodies < 9 { 6 } else { 1 } {
            let planted = planted(&joints, bodies, seed);
            let found = agree(&file(&planted.text()));
            assert!(found.iter().any(|one| distance(one, &planted.angles) < 1e-12), "{bodies} links, {seed}");
        }
    }
}

fn answer(text: &str) -> LinkageAnswer {
    solve(&file(text).linkage, &[], file(text).accuracy(&file(text).cases[0])).unwrap()
}

#[test]
fn planted_assemblies_of_large_structures_are_found() {
    for (count, seeds) in [(6, 3), (7, 1)] {
        let (joints, bodies) = ring(count);
        for seed in 0..seeds {
            let planted = planted(&joints, bodies, 100 + seed);
            let answer = answer(&planted.text());
            let verdict = &answer.verdict;
            assert_eq!((verdict.status, verdict.proof), (Status::Complete, Proof::Proved), "{}", verdict.reason);
            assert_eq!((verdict.code, verdict.complex_complete), (Code::BoxesExhausted, false));
            // A ring has an even number of complex assemblies, and so of real ones.
            assert_eq!(answer.modes.len() % 2, 0);
            let own = |mode: &looproot::internal::linkage::answer::LinkageMode| -> Vec<f64> {
                mode.bodies.iter().map(|(angle, _)| angle.re).collect()
            };
            let near = answer.modes.iter().filter(|mode| distance(&own(mode), &planted.angles) < 1e-12);
            assert_eq!(near.count(), 1);
            assert!(answer.modes.iter().all(|mode| mode.real && mode.residual < 1e-12 && mode.radius < 1e-12));
        }
    }
}

/// A plate on three legs, the last of this length.
fn legs(last: &Rational) -> String {
    format!(
        "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"frame\"\njoints = \"shared points\"\n[mechanism.bodies]\n\
         frame = {{ A = [0, 0], B = [7, 0], C = [3, 6] }}\none = {{ A = 0, D = 5 }}\ntwo = {{ B = 0, E = 4 }}\n\
         three = {{ C = 0, F = \"{last}\" }}\nplate = {{ D = [0, 0], E = [3, 1], F = [1, 3] }}\n"
    )
}

#[test]
fn assemblies_close_together_are_told_apart() {
    let count = |length: &Rational| by_boxes(&file(&legs(length))).solutions.len();
    // Somewhere in between the leg is too short for two of them.
    let (mut few, mut many) = (Rational::from((1, 100)), Rational::from(4));
    let least = count(&few);
    assert!(least < count(&many));
    for _ in 0..36 {
        let middle = Rational::from(&few + &many) / 2;
        // Within 1e-10 of the limit, which is less than what is tried beside it.
        if count(&middle) > least {
            many = middle;
        } else {
            few = middle;
        }
    }
    let mut nearest = f64::INFINITY;
    for digits in [3, 5, 7, 9] {
        let beside = Rational::from((1, 10_u64.pow(digits)));
        let found = agree(&file(&legs(&Rational::from(&many + &beside))));
        let pairs = (0..found.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
        let least = pairs.map(|(a, b)| distance(&found[a], &found[b])).fold(f64::INFINITY, f64::min);
        assert!(least < nearest);
        nearest = least;
        agree(&file(&legs(&Rational::from(&few - &beside))));
    }
    assert!(nearest < 1e-4, "{nearest:e}");
}

#[test]
fn a_structure_out_of_reach_is_proved_to_be() {
    let (joints, bodies) = ring(6);
    let mut planted = planted(&joints, bodies, 7);
    // One bar becomes longer than all other bodies together.
    let ends: Vec<usize> = (0..joints.len()).filter(|joint| joints[*joint].contains(&(bodies - 1))).collect();
    planted.bodies[bodies - 1] = format!("b{} = {{ p{} = 0, p{} = 300 }}\n", bodies - 1, ends[0], ends[1]);
    let answer = answer(&planted.text());
    assert_eq!(
        (answer.verdict.status, answer.verdict.proof),
        (Status::Unreachable, Proof::Proved),
        "{}",
        answer.verdict.reason
    );
    assert_eq!(answer.verdict.code, Code::BoxesExhausted);
}

#[test]
fn a_curve_of_assemblies_and_an_interrupt_end_the_search() {
    // Three parallel cranks turn.
    let text = "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"frame\"\njoints = \"shared points\"\n[mechanism.bodies]\n\
         frame = { A = [0, 0], B = [3, 0], C = [1, 2] }\none = { A = 0, D = 1 }\ntwo = { B = 0, E = 1 }\nthree = { C = 0, F = 1 }\n\
         plate = { D = [0, 0], E = [3, 0], F = [1, 2] }\n";
    let file = file(text);
    let found = by_boxes(&file);
    assert!(found.doubt.unwrap().contains("too narrow to be decided"));
    let found = real_assemblies(&equations(&file), LONG, &AtomicBool::new(true)).unwrap();
    assert!(found.boxes == 0 && found.doubt.unwrap().starts_with("interrupted"));
}
