//! Linkages in space: planted assemblies are listed with the count of their kind, and degenerate ones are not called complete.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, Options, SpaceFile, any_from_text, builtin_any};
use looproot::internal::claims::judge_any;
use looproot::internal::derivation::derive_in_space;
use looproot::internal::linkage::space::{SpaceAnswer, solve};
use looproot::internal::verdict::{Proof, Status};
use looproot_calculus::motion::{Motion, dot};
use looproot_calculus::quaternion::Quaternion;
use looproot_calculus::rotation::matrix::matrix;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;
use std::fmt::Write;

type Vector = [Rational; 3];

fn read(text: &str) -> Box<SpaceFile> {
    match any_from_text(text, "test.toml", Format::Toml, &Options::default()).unwrap() {
        Any::Space(file) => file,
        _ => panic!("a linkage in space"),
    }
}

fn solved(text: &str) -> SpaceAnswer {
    let file = read(text);
    let answer = solve(&file.linkage, &file.cases[0].given, file.exact && file.cases[0].exact).unwrap();
    derived(&file, &answer);
    answer
}

/// The closure polynomial has the assemblies for roots, where they are finite in number.
fn derived(file: &SpaceFile, answer: &SpaceAnswer) {
    let given = &file.cases[0].given;
    let is_finite =
        answer.verdict.complex_complete && answer.verdict.proof == Proof::Proved && answer.verdict.complex > 0;
    let Ok(found) = derive_in_space(&file.linkage, given) else {
        assert!(!is_finite || answer.groups.is_empty(), "{}: no polynomial", answer.verdict.reason);
        return;
    };
    let [best] = found.polynomials.as_slice() else { return };
    assert_eq!((best.assemblies, best.roots() * best.shared), (answer.verdict.complex, answer.verdict.complex));
    let real = answer.modes.iter().filter(|mode| mode.real).count();
    assert!(!best.separates() || (best.real_roots(), best.values()) == (real, answer.modes.len()));
}

fn refused(text: &str) -> String {
    match any_from_text(text, "test.toml", Format::Toml, &Options::default()) {
        Err(error) => error.to_string(),
        Ok(Any::Space(file)) => solve(&file.linkage, &file.cases[0].given, true)
            .map_or_else(|error| error.to_string(), |a| a.verdict.reason),
        Ok(_) => panic!("a linkage in space"),
    }
}

fn rotation(random: &mut ChaCha8Rng) -> [Vector; 3] {
    let q = Quaternion {
        scalar: Rational::from(random.random_range(1..4)),
        vector: std::array::from_fn(|_| Rational::from(random.random_range(-3..4))),
    };
    matrix(&q).unwrap()
}

fn point(random: &mut ChaCha8Rng) -> Vector {
    std::array::from_fn(|_| Rational::from(random.random_range(-6..7)))
}

fn pose(random: &mut ChaCha8Rng) -> Motion<Rational> {
    Motion { rotation: rotation(random), translation: point(random) }
}

fn still() -> Motion<Rational> {
    Motion::identity()
}

fn less(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| Rational::from(&a[k] - &b[k]))
}

fn plus(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|k| Rational::from(&a[k] + &b[k]))
}

fn scaled(a: &Vector, factor: &Rational) -> Vector {
    a.each_ref().map(|c| Rational::from(c * factor))
}

fn written(v: &Vector) -> String {
    format!("[\"{}\", \"{}\", \"{}\"]", v[0], v[1], v[2])
}

fn square(v: &Vector) -> Rational {
    dot(v, v)
}

/// A body with its planted pose and its points.
type Body = (String, Motion<Rational>, Vec<(String, Vector)>);

/// A file being written: bodies with their planted poses and points, joints and given values.
struct Draft {
    bodies: Vec<Body>,
    joints: Vec<String>,
    given: Vec<String>,
    /// The rotation whose columns every revolute joint has for axis and references; random ones without.
    common: Option<[Vector; 3]>,
}

impl Draft {
    fn new() -> Self {
        Self {
            bodies: vec![("base".to_owned(), still(), Vec::new())],
            joints: Vec::new(),
            given: Vec::new(),
            common: None,
        }
    }

    fn body(&mut self, name: &str, pose: Motion<Rational>) {
        self.bodies.push((name.to_owned(), pose, Vec::new()));
    }

    fn pose(&self, name: &str) -> Motion<Rational> {
        self.bodies.iter().find(|body| body.0 == name).unwrap().1.clone()
    }

    /// Marks a point of space in a body.
    fn mark(&mut self, body: &str, point: &str, at: &Vector) {
        let own = self.pose(body).inverse().apply(at);
        self.bodies.iter_mut().find(|entry| entry.0 == body).unwrap().2.push((point.to_owned(), own));
    }

    /// A revolute joint at a point of space with a random axis; returns the tangent of half its planted value.
    fn revolute(&mut self, random: &mut ChaCha8Rng, name: &str, of: [&str; 2], at: &Vector) -> Rational {
        let columns = self.common.clone().unwrap_or_else(|| rotation(random));
        let column = |k: usize| -> Vector { std::array::from_fn(|i| columns[i][k].clone()) };
        let (axis, e, g) = (column(0), column(1), column(2));
        let t = Rational::from((random.random_range(-6..7), random.random_range(1..4)));
        let below = Rational::from(&t * &t) + 1;
        let (cos, sin) = ((1 - Rational::from(&t * &t)) / &below, Rational::from(2 * &t) / &below);
        let f = plus(&scaled(&e, &cos), &scaled(&g, &sin));
        let own = |body: &str, v: &Vector| written(&self.pose(body).inverse().rotate(v));
        let joint = format!(
            "{{ name = \"{name}\", type = \"R\", of = [\"{}\", \"{}\"], axis = [{}, {}], zero = [{}, {}] }}",
            of[0],
            of[1],
            own(of[0], &axis),
            own(of[1], &axis),
            own(of[0], &e),
            own(of[1], &f)
        );
        self.joints.push(joint);
        for body in of {
            self.mark(body, name, at);
        }
        t
    }

    /// A prismatic joint between bodies of equal rotation from one point of space to another; returns its planted value.
    fn prismatic(&mut self, random: &mut ChaCha8Rng, name: &str, of: [&str; 2], from: &Vector) -> Rational {
        let columns = rotation(random);
        let along: Vector = std::array::from_fn(|i| columns[i][0].clone());
        let way = Rational::from((random.random_range(1..9), random.random_range(1..3)));
        let own = written(&self.pose(of[0]).inverse().rotate(&along));
        self.joints
            .push(format!("{{ name = \"{name}\", type = \"P\", of = [\"{}\", \"{}\"], axis = {own} }}", of[0], of[1]));
        self.mark(of[0], name, from);
        self.mark(of[1], name, &plus(from, &scaled(&along, &way)));
        way
    }

    fn spherical(&mut self, name: &str, of: [&str; 2], at: &Vector) {
        self.joints.push(format!("{{ name = \"{name}\", type = \"S\", of = [\"{}\", \"{}\"] }}", of[0], of[1]));
        for body in of {
            self.mark(body, name, at);
        }
    }

    fn rod(&mut self, name: &str, of: [&str; 2], ends: [&Vector; 2]) {
        let length = square(&less(ends[0], ends[1]));
        self.joints.push(format!(
            "{{ name = \"{name}\", type = \"SS\", of = [\"{}\", \"{}\"], length = \"sqrt({length})\" }}",
            of[0], of[1]
        ));
        self.mark(of[0], name, ends[0]);
        self.mark(of[1], name, ends[1]);
    }

    fn give(&mut self, joint: &str, key: &str, value: &Rational) {
        self.given.push(format!("{joint} = {{ {key} = \"{value}\" }}"));
    }

    fn text(&self, input: Option<&str>) -> String {
        let mut text = "[mechanism]\nkind = \"linkage\"\nspace = \"space\"\nground = \"base\"\njoints = [\n".to_owned();
        for joint in &self.joints {
            let _ = writeln!(text, "    {joint},");
        }
        text += "]\n[mechanism.bodies]\n";
        for (name, _, points) in &self.bodies {
            let points: Vec<String> = points.iter().map(|(name, at)| format!("{name} = {}", written(at))).collect();
            let _ = writeln!(text, "{name} = {{ {} }}", points.join(", "));
        }
        match input {
            Some(own) => text + "[[input]]\n" + own,
            None => text + "[[input]]\ngiven = { " + &self.given.join(", ") + " }\n",
        }
    }
}

/// A linkage with a known assembly: its file, the planted poses, and the number of assemblies in general.
type Planted = (Draft, String, usize);

/// A body on three legs of two joints and a spherical one, of which one is given: three points on circles, or on lines.
fn tripod(random: &mut ChaCha8Rng, kind: &str) -> Planted {
    let mut draft = Draft::new();
    draft.body("plate", pose(random));
    if kind.ends_with('=') {
        draft.common = Some(rotation(random));
    }
    let mut circles = true;
    for k in 1..=3 {
        let (lower, upper) = (format!("lower{k}"), format!("upper{k}"));
        let (first, second, ball) = (format!("A{k}"), format!("E{k}"), format!("B{k}"));
        let (lower_pose, mut upper_pose) = (pose(random), pose(random));
        let letters: Vec<char> = kind.chars().collect();
        let mut lower_pose = lower_pose.clone();
        if letters[0] == 'P' {
            lower_pose.rotation = still().rotation;
        }
        if letters[1] == 'P' {
            upper_pose.rotation = lower_pose.rotation.clone();
        }
        draft.body(&lower, lower_pose);
        draft.body(&upper, upper_pose);
        let (foot, knee, end) = (point(random), point(random), point(random));
        let joint =
            |draft: &mut Draft, random: &mut ChaCha8Rng, letter: char, name: &str, of: [&str; 2], at: &Vector| {
                match letter {
                    'P' => ("distance", draft.prismatic(random, name, of, at)),
                    _ => ("tan_half", draft.revolute(random, name, of, at)),
                }
            };
        let (key, value) = joint(&mut draft, random, letters[0], &first, ["base", &lower], &foot);
        let (other_key, other) = joint(&mut draft, random, letters[1], &second, [&lower, &upper], &knee);
        // The letter behind the word says which joint is given.
        if letters[3] == '1' {
            draft.give(&first, key, &value);
            circles &= letters[1] == 'R';
        } else {
            draft.give(&second, other_key, &other);
            circles &= letters[0] == 'R';
        }
        draft.spherical(&ball, [&upper, "plate"], &end);
    }
    let text = draft.text(None);
    (draft, text, if circles { 16 } else { 8 })
}

fn delta(random: &mut ChaCha8Rng, inverse: bool) -> Planted {
    let mut draft = Draft::new();
    let plate = Motion { translation: point(random), ..still() };
    draft.body("plate", plate.clone());
    for k in 1..=3 {
        let arm = format!("arm{k}");
        // The axis of a motor stands in base, arm and plate alike.
        let columns = rotation(random);
        let axis: Vector = std::array::from_fn(|i| columns[i][0].clone());
        let t = Rational::from((random.random_range(-4..5), random.random_range(1..4)));
        let [a, b, c] = &axis;
        let quaternion =
            Quaternion { scalar: Rational::from(1), vector: [a * t.clone(), b * t.clone(), c * t.clone()] };
        let foot = point(random);
        let turn =
            Motion { rotation: matrix(&quaternion).unwrap(), translation: std::array::from_fn(|_| Rational::new()) };
        let back = foot.each_ref().map(|c| Rational::from(-c));
        let placed = Motion::translation(foot.clone()).then_after(&turn).then_after(&Motion::translation(back));
        draft.body(&arm, placed);
        let motor = format!("A{k}");
        draft.joints.push(format!(
            "{{ name = \"{motor}\", type = \"R\", of = [\"base\", \"{arm}\"], axis = {} }}",
            written(&axis)
        ));
        draft.mark("base", &motor, &foot);
        draft.mark(&arm, &motor, &foot);
        let (elbow, end) = (point(random), point(random));
        draft.joints.push(format!(
            "{{ name = \"L{k}\", type = \"parallelogram\", of = [\"{arm}\", \"plate\"], axis = {}, length = \"sqrt({})\" }}",
            written(&axis),
            square(&less(&elbow, &end))
        ));
        draft.mark(&arm, &format!("L{k}"), &elbow);
        draft.mark("plate", &format!("L{k}"), &end);
        draft.give(&motor, "tan_half", &t);
    }
    let given = format!("body = \"plate\"\nquaternion = [1, 0, 0, 0]\nposition = {}\n", written(&plate.translation));
    let text = draft.text(inverse.then_some(&given));
    (draft, text, if inverse { 8 } else { 2 })
}

/// RSSR followed by SSR: rods between rockers, or bodies with two spherical joints.
fn series(random: &mut ChaCha8Rng) -> Planted {
    let mut draft = Draft::new();
    for name in ["crank", "rocker", "swing"] {
        draft.body(name, pose(random));
    }
    let (a, d, h) = (point(random), point(random), point(random));
    let value = draft.revolute(random, "A", ["base", "crank"], &a);
    draft.revolute(random, "D", ["base", "rocker"], &d);
    draft.revolute(random, "H", ["base", "swing"], &h);
    draft.give("A", "tan_half", &value);
    let [b, c, e, f] = std::array::from_fn(|_| point(random));
    draft.rod("one", ["crank", "rocker"], [&b, &c]);
    draft.body("bar", pose(random));
    draft.spherical("E", ["rocker", "bar"], &e);
    draft.spherical("F", ["bar", "swing"], &f);
    let text = draft.text(None);
    (draft, text, 4)
}

/// A plate on three UPU legs: the axis in the plate is a combination of that in the base and of the leg.
fn universal(random: &mut ChaCha8Rng) -> Planted {
    let mut draft = Draft::new();
    draft.body("plate", pose(random));
    for leg in 1..=3 {
        let [a, b, n] = [(); 3].map(|()| point(random));
        let way = less(&b, &a);
        let part = |random: &mut ChaCha8Rng| Rational::from((random.random_range(1..7), random.random_range(1..4)));
        let m = plus(&scaled(&n, &part(random)), &scaled(&way, &part(random)));
        let (first, second) = (format!("A{leg}"), format!("B{leg}"));
        draft.mark("base", &first, &a);
        draft.mark("plate", &second, &b);
        let own = written(&draft.pose("plate").inverse().rotate(&m));
        draft.joints.push(format!(
            "{{ name = \"leg{leg}\", type = \"UPU\", of = [\"base\", \"plate\"], at = [\"{first}\", \"{second}\"], axis = [{}, {own}] }}",
            written(&n)
        ));
        draft.given.push(format!("leg{leg} = {{ distance = \"sqrt({})\" }}", square(&way)));
    }
    let text = draft.text(None);
    (draft, text, 84)
}

fn planted(random: &mut ChaCha8Rng, kind: &str) -> Planted {
    match kind {
        "delta" => delta(random, false),
        "delta inverse" => delta(random, true),
        "series" => series(random),
        _ => tripod(random, kind),
    }
}

/// Whether an assembly is at the planted poses, rods left out: they spin.
fn is_listed(answer: &SpaceAnswer, draft: &Draft) -> bool {
    let float = |motion: &Motion<Rational>| motion.map(|c| Some(c.to_f64())).unwrap();
    let poses: Vec<Option<Motion<f64>>> =
        draft.bodies.iter().map(|(name, pose, _)| (name != "bar").then(|| float(pose))).collect();
    answer.modes.iter().filter(|mode| mode.real).any(|mode| {
        let near = |(pose, body): (&Option<Motion<f64>>, &Motion<num_complex::Complex<f64>>)| {
            pose.as_ref().is_none_or(|pose| {
                let entries = pose.rotation.iter().flatten().chain(&pose.translation);
                let found = body.rotation.iter().flatten().chain(&body.translation);
                entries.zip(found).all(|(a, b)| (a - b.re).abs() < 1e-6)
            })
        };
        poses.iter().zip(&mode.bodies).all(near)
    })
}

/// Members with the count of the kind, with fewer assemblies, and those that are no finite set.
fn tally(kind: &str, members: std::ops::Range<u64>) -> [usize; 3] {
    let (mut met, mut fewer, mut open) = (0, 0, 0);
    for seed in members {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let (draft, text, count) = planted(&mut random, kind);
        let answer = solved(&text);
        if !matches!(answer.verdict.status, Status::Complete) {
            // Coincident points and parallel axes are among random small numbers.
            assert!(matches!(answer.verdict.status, Status::SelfMotion | Status::Incomplete), "{kind} {seed}\n{text}");
            assert_eq!(answer.verdict.proof, Proof::None);
            open += 1;
            continue;
        }
        assert_eq!(answer.verdict.proof, Proof::Proved, "{kind} {seed}");
        assert!(is_listed(&answer, &draft), "{kind} {seed}: {}\n{text}", answer.verdict.reason);
        assert!(answer.verdict.complex <= count, "{kind} {seed}: {} of {count}", answer.verdict.complex);
        let real = answer.modes.iter().filter(|mode| mode.real);
        assert!(real.map(|mode| mode.residual).fold(0.0, f64::max) < 1e-9, "{kind} {seed}");
        if answer.verdict.complex == count { met += 1 } else { fewer += 1 }
    }
    [met, fewer, open]
}

const KINDS: [&str; 8] = ["RRS1", "RRS2", "RPS2", "PRS1", "PRS2", "delta", "delta inverse", "series"];

#[test]
fn planted_assemblies_in_space_are_listed() {
    for kind in KINDS {
        let [met, fewer, open] = tally(kind, 0..2);
        assert!(met >= 1, "{kind}: {met} met, {fewer} fewer, {open} open");
    }
}

/// Three hundred members of every kind.
#[test]
#[ignore = "takes many minutes: cargo test --test library space:: -- --ignored"]
fn three_hundred_of_every_kind() {
    for kind in KINDS {
        let start = std::time::Instant::now();
        let [met, fewer, open] = tally(kind, 0..300);
        let each = start.elapsed().as_secs_f64() / 0.3;
        println!("{kind}: {met} with the count of the kind, {fewer} with fewer, {open} not finite, {each:.1} ms each");
        assert!(met >= 250, "{kind}");
    }
}

#[test]
fn groups_in_series_have_counts_of_their_own() {
    let (_, text, _) = series(&mut ChaCha8Rng::seed_from_u64(3));
    let answer = solved(&text);
    let counts: Vec<usize> = answer.groups.iter().map(|group| group.count).collect();
    assert_eq!(counts, [2, 2], "{}", answer.verdict.reason);
}

/// Circles in parallel planes have fewer real and complex assemblies, or a curve of them; the planted one is among them.
#[test]
fn circles_in_parallel_planes_lose_nothing() {
    let [met, fewer, open] = tally("RRS1=", 0..4);
    assert_eq!(met + fewer + open, 4);
    assert!(open < 4, "{met} met, {fewer} fewer, {open} open");
}

/// A plate whose points are on one line turns about it.
#[test]
fn a_plate_on_points_of_a_line_moves() {
    let (draft, text, _) = tripod(&mut ChaCha8Rng::seed_from_u64(5), "RRS1");
    let points = &draft.bodies.iter().find(|body| body.0 == "plate").unwrap().2;
    let own = |k: usize| format!("{} = {}", points[k].0, written(&points[k].1));
    let start = text.find("plate = {").unwrap();
    let end = start + text[start..].find('\n').unwrap();
    // B3 where B1 is: the legs find no place, or the plate turns about the line of both.
    let same = format!("plate = {{ {}, {}, B3 = {} }}", own(0), own(1), written(&points[0].1));
    let answer = solved(&(text[..start].to_owned() + &same + &text[end..]));
    assert_ne!(answer.verdict.status, Status::Complete, "{}", answer.verdict.reason);
    assert!(answer.verdict.status != Status::Unreachable || answer.verdict.complex == 0);
}

#[test]
fn a_plate_on_three_legs_with_universal_joints_has_84_assemblies() {
    let (draft, text, count) = universal(&mut ChaCha8Rng::seed_from_u64(2));
    let answer = solved(&text);
    assert_eq!(answer.verdict.status, Status::Complete, "{}", answer.verdict.reason);
    assert!(matches!(answer.verdict.proof, Proof::Probable { .. }));
    assert_eq!((answer.verdict.complex, answer.modes.len()), (count, count));
    assert!(is_listed(&answer, &draft));
    assert!(answer.modes.iter().map(|mode| mode.residual).fold(0.0, f64::max) < 1e-9);
}

/// Points at the corners of equilateral triangles and axes along their circles, as in Tsai's robot, have fewer.
#[test]
fn an_equilateral_plate_on_universal_joints_has_78_assemblies() {
    let text = r#"
[mechanism]
kind = "linkage"
space = "space"
ground = "base"
joints = [
    { name = "leg1", type = "UPU", of = ["base", "plate"], at = ["A1", "B1"], axis = [[0, 1, -1], [0, 1, -1]] },
    { name = "leg2", type = "UPU", of = ["plate", "base"], at = ["B2", "A2"], axis = [[-1, 0, 1], [-1, 0, 1]] },
    { name = "leg3", type = "UPU", of = ["base", "plate"], at = ["A3", "B3"], axis = [[1, -1, 0], [1, -1, 0]] },
]
[mechanism.bodies]
base = { A1 = [3, 0, 0], A2 = [0, 3, 0], A3 = [0, 0, 3] }
plate = { B1 = [2, 0, 0], B2 = [0, 2, 0], B3 = [0, 0, 2] }
[[input]]
given = { leg1 = { distance = "sqrt(13)" }, leg2 = { distance = "sqrt(15)" }, leg3 = { distance = "sqrt(18)" } }
"#;
    let answer = solved(text);
    assert_eq!(answer.verdict.status, Status::Complete, "{}", answer.verdict.reason);
    assert_eq!((answer.verdict.complex, answer.modes.len(), answer.verdict.real), (78, 78, 28));
    for (from, to, message) in [
        ("axis = [[0, 1, -1], [0, 1, -1]]", "axis = [0, 1, -1]", "found a list of 3 as `axis`"),
        ("axis = [[0, 1, -1], [0, 1, -1]]", "length = 3", "length"),
        ("leg1 = { distance = \"sqrt(13)\" }", "leg1 = { tan_half = 1 }", "expected"),
    ] {
        let found = refused(&text.replacen(from, to, 1));
        assert!(found.contains(message) && found.contains("test.toml:"), "{to}: {found}");
    }
}

#[test]
fn wrong_linkages_in_space_are_named() {
    let (_, text, _) = tripod(&mut ChaCha8Rng::seed_from_u64(7), "RRS1");
    let given = text.find("given = { ").unwrap();
    let only_one = format!("{}joint = \"A1\"\ntan_half = 1\n", &text[..given]);
    assert!(refused(&only_one).contains("found 1 input given, which leaves 2 by count"), "{}", refused(&only_one));
    let replaced = |from: &str, to: &str| refused(&text.replacen(from, to, 1));
    for (from, to, message) in [
        ("given = { A1 = { tan_half", "given = { A1 = { distance", "without exactly one of `angle` and `tan_half`"),
        ("given = { A1", "given = { B1", "found an input of the joint B1 of type S"),
        ("given = { A1", "given = { Q1", "found the unknown joint `Q1`"),
        ("type = \"S\", of = [\"upper1\"", "type = \"S\", of = [\"upper4\"", "did you mean upper"),
        ("name = \"B1\"", "name = \"B9\"", "found no point `B9` in the body upper1"),
        ("type = \"S\"", "type = \"H\"", "expected"),
        ("axis = [", "axis = [[0, 0, 0], ", "test.toml:6"),
    ] {
        let found = replaced(from, to);
        assert!(found.contains(message) && found.contains("test.toml:"), "{to}: {found}");
    }
}

/// A rod that is too short for both ends: nothing reaches.
#[test]
fn what_no_rod_reaches_is_unreachable() {
    let text = r#"
[mechanism]
kind = "linkage"
space = "space"
ground = "base"
joints = [
    { name = "A", type = "R", of = ["base", "crank"], axis = [0, 0, 1] },
    { name = "D", type = "R", of = ["base", "rocker"], axis = [1, 0, 0] },
    { name = "rod", type = "SS", of = ["crank", "rocker"], at = ["B", "C"], length = 1 },
]
[mechanism.bodies]
base = { A = [0, 0, 0], D = [9, 0, 0] }
crank = { A = [0, 0, 0], B = [1, 0, 0] }
rocker = { D = [9, 0, 0], C = [9, 1, 0] }
[[input]]
joint = "A"
tan_half = "1/2"
"#;
    let answer = solved(text);
    assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::Unreachable, Proof::Proved));
    assert_eq!((answer.verdict.complex, answer.verdict.real), (2, 0));
}

#[test]
fn entries_keep_their_claims() {
    for name in ["3rrs", "3rps", "3upu", "delta", "rssr_ssr", "geared_five_bar", "geared_five_bar_reversed"] {
        let any = builtin_any(&format!("linkage/{name}"), &Options::default()).unwrap();
        let judgement = judge_any(&any).unwrap();
        let failed: Vec<String> = judgement.failures().map(|finding| finding.message.clone()).collect();
        assert!(failed.is_empty(), "{name}: {failed:?}");
        // That of a plate on UPU legs is probable.
        assert_eq!(judgement.complete, if name == "3upu" { 0 } else { judgement.cases }, "{name}");
    }
}

/// Two quadratics in a row with a second joint Z between two bodies, and its points in them.
fn with_second_joint(joint: &str, [one, other]: [(&str, &str); 2]) -> SpaceAnswer {
    let text = include_str!("../../equations/linkage/rssr_ssr.toml");
    let (mechanism, _) = text.split_once("[[input]]").unwrap();
    let mut own = mechanism.replacen("joints = [", &format!("joints = [\n    {{ name = \"Z\", {joint} }},"), 1);
    for (body, point) in [one, other] {
        own = own.replacen(&format!("\n{body} = {{ "), &format!("\n{body} = {{ {point}, "), 1);
    }
    solved(&format!("{own}\n[[input]]\ngiven = {{ A = {{ tan_half = -1 }} }}\n"))
}

#[test]
fn a_second_joint_between_bodies_held_together_is_met() {
    let crank = |joint: &str, points: [&str; 2]| with_second_joint(joint, [("base", points[0]), ("crank", points[1])]);
    let rod = |length: &str| {
        let joint = format!("type = \"SS\", of = [\"base\", \"crank\"], at = [\"X\", \"Y\"], length = {length}");
        crank(&joint, ["X = [0, 0, 0]", "Y = [1, 2, 3]"])
    };
    // Turned by -90 degrees about A, the point stands 1912/25 from the origin, squared.
    assert_eq!((rod("\"sqrt(1912/25)\"").verdict.status, rod("\"sqrt(1912/25)\"").modes.len()), (Status::Complete, 4));
    assert_eq!(rod("5").verdict.status, Status::Unreachable);
    let again =
        |axis: &str, at: [&str; 2]| crank(&format!("type = \"R\", of = [\"base\", \"crank\"], axis = {axis}"), at);
    let on_axis = ["Z = [-2, -5, 1]", "Z = [-2, -5, 1]"];
    assert_eq!(again("[0, \"3/5\", \"4/5\"]", on_axis).modes.len(), 4);
    assert_eq!(again("[1, 0, 0]", on_axis).verdict.status, Status::Unreachable);
    assert_eq!(again("[0, \"3/5\", \"4/5\"]", ["Z = [0, 0, 0]", "Z = [1, 2, 3]"]).verdict.status, Status::Unreachable);
    // Bodies of a group that is rigid with the input.
    let rocker = |axis: &str, points: [&str; 2]| {
        let joint = format!("type = \"R\", of = [\"base\", \"rocker\"], axis = {axis}");
        with_second_joint(&joint, [("base", points[0]), ("rocker", points[1])])
    };
    assert_eq!(rocker("[\"2/11\", \"6/11\", \"9/11\"]", ["Z = [6, 1, 1]", "Z = [6, 1, 1]"]).modes.len(), 4);
    assert_eq!(rocker("[1, 0, 0]", ["Z = [0, 0, 0]", "Z = [1, 2, 3]"]).verdict.status, Status::Unreachable);
}
