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
