//! Linkages that fall into dyads: their number of assemblies without a list is that of the list.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, LinkageFile, Options, any_from_text};
use looproot::internal::linkage::answer::solve;
use looproot::internal::linkage::assembly::{Asked, groups_of};
use looproot::internal::linkage::count::{Count, Dyads, Halt, MOST_NEAR};
use looproot::internal::linkage::many::of_many;
use looproot::internal::verdict::{Proof, Status};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;
use std::fmt::Write;
use std::sync::atomic::AtomicBool;

type Point = [Rational; 2];

/// How the middle joints of the dyads stand in the planted assembly.
#[derive(Clone, Copy, PartialEq)]
enum Planted {
    Anywhere,
    /// The middle joint of the dyad with this number stands between its ends, which are as far apart as they can be.
    Straight(usize),
}

fn file(text: &str) -> Box<LinkageFile> {
    match any_from_text(text, "test.toml", Format::Toml, &Options::default()).unwrap() {
        Any::Linkage(file) => file,
        _ => panic!("a linkage in the plane"),
    }
}

/// A number of two digits behind the point.
fn number(random: &mut ChaCha8Rng) -> Rational {
    Rational::from((random.random_range(-300..=300), 100))
}

/// A crank and dyads that each stand on two earlier bodies. All places are rational and no body is turned but the crank.
fn dyads(count: usize, planted: Planted, random: &mut ChaCha8Rng) -> Box<LinkageFile> {
    let mut points: Vec<Vec<String>> = vec![vec!["A = [0, 0]".into()], vec!["A = [0, 0]".into()]];
    let mut origins: Vec<Point> = vec![[Rational::new(), Rational::new()], [Rational::new(), Rational::new()]];
    let mut joints = String::from("{ name = \"A\", type = \"R\", of = [\"b0\", \"b1\"] },\n");
    let written = |name: &str, at: &Point| format!("{name} = [\"{}\", \"{}\"]", at[0], at[1]);
    for k in 0..count {
        // The newest body and one before it, so that nearly every dyad stands on all earlier ones.
        let below = [points.len() - 1, random.random_range(0..points.len() - 1)];
        let first = points.len();
        let ends: Vec<Point> = below
            .iter()
            .map(|body| {
                let own: Point = [number(random), number(random)];
                points[*body].push(written(&format!("E{k}_{body}"), &own));
                [Rational::from(&own[0] + &origins[*body][0]), Rational::from(&own[1] + &origins[*body][1])]
            })
            .collect();
        let middle = |axis: usize| Rational::from(&ends[0][axis] + &ends[1][axis]) / 2;
        let middle: Point = match planted {
            Planted::Straight(which) if which == k => [0, 1].map(middle),
            _ => [middle(0) + number(random), middle(1) + number(random)],
        };
        for (side, (body, end)) in below.iter().zip(&ends).enumerate() {
            let off: Point = [Rational::from(&middle[0] - &end[0]), Rational::from(&middle[1] - &end[1])];
            points.push(vec![format!("E{k}_{body} = [0, 0]"), written(&format!("M{k}"), &off)]);
            origins.push(end.clone());
            let _ = writeln!(
                joints,
                "{{ name = \"E{k}_{body}\", type = \"R\", of = [\"b{body}\", \"b{}\"] }},",
                first + side
            );
        }
        let _ = writeln!(joints, "{{ name = \"M{k}\", type = \"R\", of = [\"b{first}\", \"b{}\"] }},", first + 1);
    }
    let bodies = points
        .iter()
        .enumerate()
        .fold(String::new(), |text, (body, points)| format!("{text}b{body} = {{ {} }}\n", points.join(", ")));
    file(&format!(
        "title = \"dyads\"\n[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"b0\"\njoints = [\n{joints}]\n\
         [mechanism.bodies]\n{bodies}[[input]]\njoint = \"A\"\ntan_half = 0\n"
    ))
}

fn counted(file: &LinkageFile) -> Result<Count, Halt> {
    let given = &file.cases[0].given;
    let groups = groups_of(&file.linkage, given).unwrap().list;
    let stop = AtomicBool::new(false);
    Dyads::of(&file.linkage, given, &groups, &stop).unwrap().count()
}

#[test]
fn the_number_is_that_of_the_list() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut multiple = 0;
    for round in 0..24 {
        let planted = if round % 3 == 0 { Planted::Straight(round / 3 % 3) } else { Planted::Anywhere };
        let file = dyads(3 + round % 3, planted, &mut random);
        let case = &file.cases[0];
        let answer = solve(&file.linkage, &case.given, file.accuracy(case)).unwrap();
        let verdict = &answer.verdict;
        assert_eq!((verdict.status, verdict.proof), (Status::Complete, Proof::Proved), "{}", verdict.reason);
        let listed = Count { complex: verdict.complex, real: verdict.real };
        assert_eq!(counted(&file), Ok(listed), "round {round}");
        multiple += usize::from(answer.modes.iter().any(|mode| mode.multiplicity > 1));
    }
    // A dyad that is straight leaves f64 in doubt: the exact numbers decide.
    assert!(multiple >= 8, "{multiple}");
}

#[test]
fn dyads_that_turn_freely_are_not_counted() {
    let text = "title = \"folded\"\n[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"g\"\njoints = \"shared points\"\n\
                [mechanism.bodies]\ng = { A = [0, 0] }\nc = { A = [0, 0], B = [1, 0], D = [1, 0] }\nb = { B = [1, 0], C = [3, 0] }\n\
                a = { D = [1, 0], C = [3, 0] }\n[[input]]\njoint = \"A\"\ntan_half = 0\n";
    assert!(matches!(counted(&file(text)), Err(Halt::Open(_))));
}

#[test]
fn more_dyads_than_are_listed_are_counted_and_the_nearest_assemblies_are_listed() {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let file = dyads(15, Planted::Anywhere, &mut random);
    let (linkage, case) = (&file.linkage, &file.cases[0]);
    let stop = AtomicBool::new(false);
    // In the planted assembly no body is turned.
    let near: Vec<Option<f64>> = linkage.joints.iter().map(|joint| (joint.name != "A").then_some(0.0)).collect();
    let asked = Asked { complex: false, stop: &stop, near: Some(&near) };
    let answer = of_many(linkage, &case.given, file.accuracy(case), asked).unwrap().unwrap();
    assert_eq!(answer.verdict.status, Status::Incomplete);
    assert!(answer.modes.len() <= MOST_NEAR && !answer.listed);
    let angles = |k: usize| answer.modes[k].joints.iter().flatten().map(|angle| angle.re.abs());
    assert!(angles(0).fold(0.0, f64::max) < 1e-9, "the planted assembly is the nearest one");
    let far = |k: usize| angles(k).map(|angle| angle * angle).sum::<f64>();
    for k in 1..answer.modes.len() {
        assert!(far(k - 1) <= far(k));
        assert!(answer.modes[k].residual < 1e-12 && answer.modes[k].radius < 1e-9);
    }
}

/// A chain of four-bars, each on the rocker of the one before: few of its 4096 assemblies are real.
#[test]
fn real_assemblies_of_many_dyads_are_listed_without_the_complex_ones() {
    let count = 12;
    let (mut bodies, mut ground) = (String::from("b0 = { O = 0, P0 = 1 }\n"), String::from("O = 0"));
    let mut joints = String::from("{ name = \"O\", type = \"R\", of = [\"g\", \"b0\"] },\n");
    for k in 0..count {
        let (coupler, rocker, before) = (2 * k + 1, 2 * k + 2, 2 * k);
        let _ = write!(ground, ", S{k} = {}", 3 + 4 * k);
        let _ = writeln!(
            bodies,
            "b{coupler} = {{ P{k} = 0, Q{k} = 3 }}\nb{rocker} = {{ Q{k} = 0, S{k} = 2, P{} = [3, 1] }}",
            k + 1
        );
        let _ = writeln!(joints, "{{ name = \"P{k}\", type = \"R\", of = [\"b{before}\", \"b{coupler}\"] }},");
        let _ = writeln!(joints, "{{ name = \"Q{k}\", type = \"R\", of = [\"b{coupler}\", \"b{rocker}\"] }},");
        let _ = writeln!(joints, "{{ name = \"S{k}\", type = \"R\", of = [\"b{rocker}\", \"g\"] }},");
    }
    let file = file(&format!(
        "title = \"chain\"\n[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"g\"\njoints = [\n{joints}]\n\
         [mechanism.bodies]\ng = {{ {ground} }}\n{bodies}[[input]]\njoint = \"O\"\nangle = \"70 deg\"\n"
    ));
    let (linkage, case) = (&file.linkage, &file.cases[0]);
    let stop = AtomicBool::new(false);
    let asked = Asked { complex: false, stop: &stop, near: None };
    let answer = of_many(linkage, &case.given, file.accuracy(case), asked).unwrap().unwrap();
    let verdict = &answer.verdict;
    assert!(answer.listed && verdict.real == answer.modes.len() && !verdict.complex_complete, "{}", verdict.reason);
    assert_eq!(verdict.proof, Proof::Proved);
    // The walk through all branches counts as many.
    let counted = counted(&file).unwrap();
    assert_eq!((counted.complex, counted.real), (1 << count, verdict.real));
}
