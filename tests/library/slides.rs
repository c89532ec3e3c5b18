//! Planar groups with slides at every place: planted assemblies are listed, and the list is complete.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, LinkageFile, Options, any_from_text};
use looproot::internal::linkage::answer::{LinkageAnswer, solve};
use looproot::internal::verdict::{Proof, Status};
use looproot_algebra::ring::Ring;
use num_complex::Complex;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;
use std::fmt::Write;

type Gaussian = Complex<Rational>;

/// The structures of five and seven links, by their joints.
const STRUCTURES: [&[[usize; 2]]; 4] = [
    &[[0, 1], [0, 2], [0, 3], [1, 4], [2, 4], [3, 4]],
    &[[0, 1], [0, 5], [0, 6], [1, 2], [2, 3], [2, 6], [3, 4], [4, 5], [4, 6]],
    &[[0, 1], [0, 3], [0, 6], [1, 2], [1, 4], [2, 3], [3, 5], [4, 5], [4, 6]],
    &[[0, 1], [0, 2], [0, 5], [0, 6], [1, 4], [2, 3], [3, 4], [3, 6], [4, 5]],
];

fn solved(text: &str) -> LinkageAnswer {
    let file: Box<LinkageFile> = match any_from_text(text, "test.toml", Format::Toml, &Options::default()).unwrap() {
        Any::Linkage(file) => file,
        _ => panic!("a linkage in the plane"),
    };
    solve(&file.linkage, &file.cases[0].given, file.accuracy(&file.cases[0])).unwrap()
}

fn whole(re: i32, im: i32) -> Gaussian {
    Complex::new(Rational::from(re), Rational::from(im))
}

fn turn(random: &mut ChaCha8Rng) -> Gaussian {
    let (m, n) = [(1, 2), (2, 3), (1, 3), (1, 4), (3, 4), (2, 5)][random.random_range(0..6)];
    let length = m * m + n * n;
    let part = |x: i32| Rational::from((x, length));
    let sign = if random.random_bool(0.5) { 1 } else { -1 };
    Complex::new(part(n * n - m * m), part(2 * m * n * sign))
}

fn written(a: &Gaussian) -> String {
    format!("[\"{}\", \"{}\"]", a.re, a.im)
}

/// A member of a structure with slides at these joints, and the angles of its bodies in a planted assembly.
fn planted(joints: &[[usize; 2]], slides: &[usize], random: &mut ChaCha8Rng) -> (String, Vec<f64>) {
    let count = joints.iter().flatten().max().unwrap() + 1;
    // Nine digits: a Gröbner basis of the cycles takes more work than is allowed.
    let part = |random: &mut ChaCha8Rng| Rational::from((random.random_range(-900_000_000..900_000_000), 100_000_001));
    let point = |random: &mut ChaCha8Rng| Complex::new(part(random), part(random));
    let mut poses: Vec<(Gaussian, Gaussian)> = (0..count).map(|_| (turn(random), point(random))).collect();
    poses[0] = (whole(1, 0), whole(0, 0));
    let (mut list, mut bodies) = (String::new(), vec![String::new(); count]);
    for (k, [a, b]) in joints.iter().enumerate() {
        let here = point(random);
        let back = |body: usize| Complex::new(poses[body].0.re.clone(), -poses[body].0.im.clone());
        let mut there = here.clone();
        let mut kind = "type = \"R\"".to_owned();
        if slides.contains(&k) {
            let (x, y) = [(3, 4), (5, 12), (1, 0), (-3, 4), (4, 3), (-5, 12), (8, 15)][random.random_range(0..7)];
            let way = whole(x, y);
            let shift = Rational::from((random.random_range(-7..8), 2));
            there = here.add(&Complex::new(way.re.clone() * &shift, way.im.clone() * &shift));
            let along = [a, b].map(|body| written(&back(*body).mul(&way)));
            kind = format!("type = \"P\", along = [{}, {}]", along[0], along[1]);
        }
        writeln!(list, "{{ name = \"j{k}\", {kind}, of = [\"b{a}\", \"b{b}\"] }},").unwrap();
        for (body, at) in [(*a, here), (*b, there)] {
            let own = back(body).mul(&at.sub(&poses[body].1));
            write!(bodies[body], "j{k} = {}, ", written(&own)).unwrap();
        }
    }
    let mut text = format!(
        "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"b0\"\njoints = [\n{list}]\n[mechanism.bodies]\n"
    );
    for (body, points) in bodies.iter().enumerate() {
        writeln!(text, "b{body} = {{ {} }}", points.trim_end_matches(", ")).unwrap();
    }
    let angles = poses.iter().map(|(turn, _)| turn.im.to_f64().atan2(turn.re.to_f64()));
    (text, angles.collect())
}

/// Whether no slides form a ring: its bodies would turn together.
fn is_forest(joints: &[[usize; 2]], slides: &[usize]) -> bool {
    let mut roots: Vec<usize> = (0..7).collect();
    slides.iter().all(|k| {
        let [a, b] = joints[*k].map(|body| roots[body]);
        roots.iter_mut().filter(|root| **root == a).for_each(|root| *root = b);
        a != b
    })
}

fn is_listed(answer: &LinkageAnswer, angles: &[f64]) -> bool {
    let is_same =
        |(body, angle): (&(Complex<f64>, _), &f64)| (Complex::cis(body.0.re) - Complex::cis(*angle)).norm() < 1e-6;
    answer.modes.iter().filter(|mode| mode.real).any(|mode| mode.bodies.iter().zip(angles).all(is_same))
}

/// Solves members with this many slides: how many have a complete list, and how many not.
fn members(slides: usize, seeds: std::ops::Range<u64>) -> [usize; 2] {
    let mut counts = [0, 0];
    for seed in seeds {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let joints = STRUCTURES[random.random_range(0..STRUCTURES.len())];
        let mut chosen: Vec<usize> = Vec::new();
        while chosen.len() < slides {
            let joint = random.random_range(0..joints.len());
            if !chosen.contains(&joint) && is_forest(joints, &[chosen.as_slice(), &[joint]].concat()) {
                chosen.push(joint);
            }
        }
        let (text, angles) = planted(joints, &chosen, &mut random);
        let answer = solved(&text);
        if answer.verdict.status == Status::Incomplete {
            counts[1] += 1;
            continue;
        }
        assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::Complete, Proof::Proved), "{seed}: {text}");
        assert!(is_listed(&answer, &angles), "{seed}: {angles:?}\n{text}");
        counts[0] += 1;
    }
    counts
}

#[test]
fn slides_in_bodies_that_turn_are_solved() {
    for slides in 1..=3 {
        let [complete, open] = members(slides, 0..6);
        assert!(open == 0, "{slides}: {complete} complete, {open} open");
    }
}

/// A linkage of slides alone between the ground, `a`, `b` and so on, with directions [x, y] in the first body of each.
fn sliding(slides: &[(&str, &str, [i32; 2])], more: &str, given: &str) -> String {
    let mut text = "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"g\"\njoints = [\n".to_owned();
    let mut bodies = std::collections::BTreeMap::<&str, Vec<usize>>::new();
    for (k, (first, second, [x, y])) in slides.iter().enumerate() {
        writeln!(text, "{{ name = \"p{k}\", type = \"P\", of = [\"{first}\", \"{second}\"], along = [{x}, {y}] }},")
            .unwrap();
        bodies.entry(first).or_default().push(k);
        bodies.entry(second).or_default().push(k);
    }
    writeln!(text, "{more}]\n[mechanism.bodies]").unwrap();
    for (body, joints) in bodies {
        // Points apart, so that no displacement is 0 by chance.
        let place = |k: &usize| format!("p{k} = [{}, {}]", k + 1, 2 * k);
        let points: Vec<String> = joints.iter().map(place).collect();
        let pins = if more.is_empty() { "" } else { ", pin = [7, 3]" };
        writeln!(text, "{body} = {{ {}{pins} }}", points.join(", ")).unwrap();
    }
    text + given
}

#[test]
fn a_cycle_of_slides_alone_is_linear() {
    let triangle = [("g", "a", [1, 0]), ("g", "b", [0, 1]), ("a", "b", [3, 4])];
    let free = solved(&sliding(&triangle, "", ""));
    assert_eq!((free.verdict.status, free.verdict.proof), (Status::SelfMotion, Proof::Proved));
    assert_eq!((free.verdict.self_motion, free.families[0].joints.as_slice()), (1, [0, 1, 2].as_slice()));
    assert!(free.families[0].sample.residual < 1e-12);

    let held = solved(&sliding(&triangle, "", "[[input]]\ngiven = { p0 = 3 }\n"));
    assert_eq!((held.verdict.status, held.verdict.proof), (Status::Complete, Proof::Proved));
    assert_eq!(held.modes.len(), 1);
    // All points agree but for the displacements: 3 (1, 0) + s (3, 4)/5 = t (0, 1) + the way from p0 to p1.
    let value = |k: usize| held.modes[0].joints[k].unwrap().re;
    assert!((3.0 * 5.0 + 3.0 * value(2)).abs() < 1e-12 && (value(1) - 0.8 * value(2)).abs() < 1e-12);

    // Two parallel slides move along one another, the third stands.
    let parallel = solved(&sliding(&[("g", "a", [1, 0]), ("g", "b", [2, 0]), ("a", "b", [1, 1])], "", ""));
    assert_eq!((parallel.verdict.self_motion, parallel.families[0].joints.as_slice()), (1, [0, 1].as_slice()));

    let ring = [("g", "a", [1, 0]), ("a", "b", [0, 1]), ("b", "c", [3, 4]), ("c", "g", [1, 2])];
    let four = solved(&sliding(&ring, "", "[[input]]\ngiven = { p1 = 1 }\n"));
    assert_eq!((four.verdict.self_motion, four.verdict.proof), (1, Proof::Proved));
    let both = solved(&sliding(&ring, "", "[[input]]\ngiven = { p1 = 1, p2 = 2 }\n"));
    assert_eq!((both.verdict.status, both.verdict.real, both.verdict.proof), (Status::Complete, 1, Proof::Proved));
}

#[test]
fn a_cycle_of_slides_whose_angles_do_not_close_has_no_assembly() {
    let text = sliding(&[("g", "a", [1, 0]), ("g", "b", [0, 1]), ("a", "b", [3, 4])], "", "");
    let turned = text.replace("along = [3, 4]", "along = [[3, 4], [4, 3]]");
    let answer = solved(&turned);
    assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::Unreachable, Proof::Proved));
}

#[test]
fn a_bar_that_holds_a_cycle_of_slides_is_solved_with_it() {
    let triangle = [("g", "a", [1, 0]), ("g", "b", [0, 1]), ("a", "b", [3, 4])];
    let bar = "{ name = \"bar\", type = \"RR\", of = [\"a\", \"b\"], at = \"pin\", length = 5 },\n";
    let answer = solved(&sliding(&triangle, bar, ""));
    assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::Complete, Proof::Proved));
    assert_eq!((answer.verdict.complex, answer.verdict.real), (2, 2));
}

/// A structure whose last dyad, of b1 and b3, is stretched over irrational assemblies of the bodies below it.
const STRETCHED: &str = "[mechanism]
kind = \"linkage\"
space = \"plane\"
ground = \"b0\"
joints = [
    { name = \"p02\", type = \"R\", of = [\"b0\", \"b2\"] },
    { name = \"p05\", type = \"P\", of = [\"b0\", \"b5\"], along = [[-1, 0], [-1, 0]] },
    { name = \"p13\", type = \"P\", of = [\"b1\", \"b3\"], along = [[-1, 0], [-1, 0]] },
    { name = \"p16\", type = \"R\", of = [\"b1\", \"b6\"] },
    { name = \"p27\", type = \"R\", of = [\"b2\", \"b7\"] },
    { name = \"p37\", type = \"R\", of = [\"b3\", \"b7\"] },
    { name = \"p45\", type = \"P\", of = [\"b4\", \"b5\"], along = [[4, -3], [4, -3]] },
    { name = \"p47\", type = \"P\", of = [\"b4\", \"b7\"], along = [[-4, -3], [-4, -3]] },
    { name = \"p56\", type = \"P\", of = [\"b5\", \"b6\"], along = [[-0.8, -0.6], [-0.8, -0.6]] },
    { name = \"p67\", type = \"R\", of = [\"b6\", \"b7\"] },
]

[mechanism.bodies]
b0 = { p02 = [-1, -1], p05 = [1, -1] }
b2 = { p02 = [-1, -1], p27 = [-1, 3] }
b5 = { p05 = [0, -1], p45 = [1.8, 2.4], p56 = [1, -1] }
b1 = { p13 = [-1, -1], p16 = [-1, 1] }
b3 = { p13 = [-2, -1], p37 = [-1, -1] }
b6 = { p16 = [-1, 1], p56 = [1.8, -0.4], p67 = [1, -1] }
b7 = { p27 = [-1, 3], p37 = [-1, -1], p47 = [0.2, 0.4], p67 = [1, -1] }
b4 = { p45 = [1, 3], p47 = [1, 1] }

[[input]]
given = { p05 = { distance = 1 } }
";

#[test]
fn a_dyad_stretched_over_irrational_assemblies_is_decided() {
    let answer = solved(STRETCHED);
    assert_eq!(
        (answer.verdict.status, answer.verdict.proof),
        (Status::Complete, Proof::Proved),
        "{}",
        answer.verdict.reason
    );
    assert_eq!((answer.verdict.complex, answer.verdict.real), (4, 4));
    assert!(answer.modes.iter().all(|mode| mode.residual < 1e-9));
    // The bodies stand as in the file in one of them.
    let is_planted =
        |bodies: &[(Complex<f64>, [Complex<f64>; 2])]| bodies.iter().all(|(angle, _)| angle.re.abs() < 1e-9);
    assert!(answer.modes.iter().any(|mode| is_planted(&mode.bodies)));
}
