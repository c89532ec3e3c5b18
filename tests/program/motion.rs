//! Rational motions: factorisations multiply back, loops close, Bennett is recognised.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, MotionFile, Options, any_from_text, builtin_any};
use looproot::internal::factoring::{Factored, factor};
use looproot::internal::kinematics::dual_quaternion::DualQuaternion;
use looproot::internal::kinematics::motion_polynomial::{
    Linkage, factorisations, from_parts, parts, product, quadratic_factors,
};
use looproot::internal::kinematics::screw_system::ScrewSystem;
use looproot::internal::mobility::mobility;
use looproot::internal::report::motion::toml;
use looproot::internal::verdict::Proof;
use looproot_algebra::ring::Ring;
use looproot_algebra::univariate::Univariate;
use proptest::prelude::*;
use rug::Rational;
use std::process::Command;

type Q = Rational;

fn builtin(name: &str) -> MotionFile {
    match builtin_any(name, &Options::default()).unwrap() {
        Any::Motion(file) => *file,
        _ => panic!("{name} is no motion"),
    }
}

fn read(text: &str) -> Result<Any, String> {
    any_from_text(text, "own.toml", Format::Toml, &Options::default()).map_err(|error| error.to_string())
}

fn rational(text: &str) -> Q {
    text.parse().unwrap()
}

#[test]
fn bennett_is_recognised_exactly() {
    let factored = factor(&builtin("motion/bennett"));
    let Factored::Exact(found) = &factored else { panic!("rational factors") };
    assert_eq!((found.list.len(), found.failed), (2, 0));
    // The other factorisation, known from an independent computation.
    let other = |h: &DualQuaternion<Q>| parts(h).map(|x| x.to_string()).join(" ");
    let all: Vec<String> = found.list.iter().flat_map(|(_, factors)| factors.iter().map(other)).collect();
    assert!(all.contains(&"1 17/9 10/9 -4/9 0 -58/81 85/81 -34/81".to_owned()), "{all:?}");
    assert!(all.contains(&"0 1/9 8/9 4/9 0 -104/81 -4/81 34/81".to_owned()), "{all:?}");
    let closed = factored.closed_loop(None).unwrap().unwrap();
    assert_eq!((closed.letters.as_str(), closed.order, closed.mobility()), ("4R", 3, (1, 1)));
    assert_eq!(closed.bennett, Some(rational("5/4")));
    let links = closed.parameters.unwrap();
    for k in 0..4 {
        assert!(links[k].d.abs() < 1e-14);
        assert!((links[k].a - links[(k + 2) % 4].a).abs() < 1e-14);
        assert!((links[k].a.powi(2) / links[k].alpha.sin().powi(2) - 1.25).abs() < 1e-13);
    }
}

#[test]
fn three_factors_make_six_factorisations_and_6r_loops() {
    let factored = factor(&builtin("motion/six_revolutes"));
    let Factored::Exact(found) = &factored else { panic!("rational factors") };
    assert_eq!(found.list.len(), 6);
    let mut letters = Vec::new();
    for i in 0..6 {
        for j in 0..i {
            let linkage = Linkage::of(&found.list[i].1, &found.list[j].1);
            assert!(linkage.closes());
            let orders =
                [(0, 1), (1, 2), (3, 1), (-2, 1)].map(|t| ScrewSystem::of(&linkage.screws(&Q::from(t))).order());
            assert_eq!(orders, [linkage.joints.len() - 1; 4], "Bricard's theorem at every position");
            letters.push(linkage.letters());
        }
    }
    // Orders that begin or end with the same norm share that factor, which drops out.
    assert_eq!(letters.iter().filter(|l| *l == "4R").count(), 6);
    assert_eq!(letters.iter().filter(|l| *l == "6R").count(), 9);
}

#[test]
fn a_wrong_factor_does_not_close() {
    let factored = factor(&builtin("motion/bennett"));
    let Factored::Exact(found) = &factored else { panic!("rational factors") };
    let mut wrong = found.list[1].1.clone();
    wrong[0].vector[0].epsilon += Q::from((1, 1000));
    assert!(!Linkage::of(&found.list[0].1, &wrong).closes());
}

#[test]
fn quadratic_factors_are_found_exactly() {
    let quadratic = |p: &str, q: &str| Univariate::new(vec![rational(q), rational(p), Q::from(1)]);
    let factors =
        [quadratic("0", "1"), quadratic("-2/3", "100/7"), quadratic("12345/6789", "98765432/10"), quadratic("0", "1")];
    let product = factors.iter().fold(Univariate::one(), |p: Univariate<Q>, f| p.mul(f));
    let mut found = quadratic_factors(&product).unwrap();
    assert_eq!(found.len(), 4);
    for factor in &factors {
        let place = found.iter().position(|f| f == factor).unwrap();
        found.remove(place);
    }
    // t^4 + 1 splits over the reals, and not over the rationals; t^2 - 2 has real roots.
    assert!(quadratic_factors(&Univariate::new([1, 0, 0, 0, 1].map(Q::from).to_vec())).is_none());
    assert!(quadratic_factors(&Univariate::new([-2, 0, 1].map(Q::from).to_vec())).is_none());
}

#[test]
fn an_irrational_norm_is_factored_in_f64_and_said_to_be() {
    // (t - h1)(t - h2) for a norm t^4 + 1: coefficients of a rotation about z through t^2 + i, moved.
    let text = "[mechanism]\nkind = \"motion\"\npolynomial = [[0, 0, 0, 1, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1, 0, 0], [1, 0, 0, 0, 0, 0, 0, 0]]\n";
    let Any::Motion(file) = read(text).unwrap() else { panic!("a motion") };
    let factored = factor(&file);
    assert!(!matches!(factored, Factored::Exact(_)));
    assert!(factored.closed_loop(None).unwrap().is_none());
}

#[test]
fn bad_motions_are_refused_with_their_place() {
    let head = "[mechanism]\nkind = \"motion\"\n";
    let cases = [
        (format!("{head}factors = []"), "own.toml:3: found a motion polynomial of degree 0"),
        (
            format!(
                "{head}factors = [{{ direction = [1, 0, 0], moment = [1, 0, 0] }}, {{ direction = [0, 1, 0], moment = [0, 0, 0] }}]"
            ),
            "own.toml:3: found a moment that is not perpendicular",
        ),
        (
            format!(
                "{head}factors = [{{ direction = [0, 0, 0], moment = [0, 0, 0] }}, {{ direction = [0, 1, 0], moment = [0, 0, 0] }}]"
            ),
            "found a factor without direction",
        ),
        (
            format!(
                "{head}factors = [{{ direction = [\"sqrt(2)\", 0, 0], moment = [0, 0, 0] }}, {{ direction = [0, 1, 0], moment = [0, 0, 0] }}]"
            ),
            "found numbers that are not rational",
        ),
        (
            format!(
                "{head}polynomial = [[1, 0, 0, 0, 1, 0, 0, 0], [0, 1, 0, 0, 0, 0, 0, 0], [1, 0, 0, 0, 0, 0, 0, 0]]"
            ),
            "own.toml:3: found a polynomial off the Study quadric",
        ),
        (
            format!(
                "{head}polynomial = [[1, 0, 0, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 1, 0, 0, 0]]"
            ),
            "found a leading coefficient without rotation",
        ),
        (format!("{head}polynomial = [[1, 0], [0, 1], [1, 1]]"), "expected a list of 8"),
        (head.to_owned(), "found neither of `polynomial` and `factors`"),
    ];
    for (text, expected) in cases {
        let error = read(&text).map(|_| ()).unwrap_err();
        assert!(error.contains(expected), "{error}\n{expected}");
    }
}

fn run(arguments: &[&str]) -> (i32, String, String) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_looproot")).args(arguments).current_dir(crate::ROOT).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    let (out, err) = (text(output.stdout), text(output.stderr));
    assert!(!err.contains("panicked"), "{err}");
    (output.status.code().unwrap(), out, err)
}

#[test]
fn the_program_factors_and_its_loop_is_a_mechanism_file() {
    let (code, out, _) = run(&["factor", "motion/bennett"]);
    assert_eq!(code, 0);
    let verdict = "2 factorisations over the rationals; 1 and 2 close a 4R loop (Bennett), mobile: mobility 1, screw rank 3; \
                   proof: proved\n";
    assert!(out.starts_with(verdict), "{out}");
    let (code, out, _) = run(&["factor", "six_revolutes", "--json"]);
    let answer: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!((code, &answer["loop"]["joints"], &answer["loop"]["screw_rank"]), (0, &"6R".into(), &5.into()));
    assert!(answer["reason"].as_str().unwrap().contains("close a 6R loop"), "{answer}");
    let (code, out, _) = run(&["factor", "six_revolutes", "--toml"]);
    assert_eq!((code, out.matches("type = \"R\"").count()), (0, 6));
    let loop_file = read(&out).unwrap();
    assert!(matches!(loop_file, Any::Entry(_)));
    let (code, _, err) = run(&["factor", "six_revolutes", "--pair", "1,9"]);
    assert!(code == 1 && err.contains("1,9"), "{err}");
    let (code, _, err) = run(&["factor", "steffen"]);
    assert!(code == 1 && err.contains("expected a rational motion"), "{err}");
    assert_eq!(run(&["check", "equations/motion", "--quiet"]).0, 0);
}

/// The loop of every two factorisations, printed and read again, is proved to move: the axes are rational vectors whose lengths
/// are not.
#[test]
fn printed_loops_are_proved_to_move() {
    for (name, count) in [("motion/bennett", 2), ("motion/six_revolutes", 6), ("motion/rotation_translation", 2)] {
        let file = builtin(name);
        let factored = factor(&file);
        for (i, j) in (0..count).flat_map(|i| (0..i).map(move |j| (j, i))) {
            let closed = factored.closed_loop(Some((i, j))).unwrap().unwrap();
            let Any::Entry(entry) = read(&toml(&file, &closed)).unwrap() else { panic!("a loop") };
            let answer = mobility(&entry).unwrap();
            let expected = (Some(closed.mobility().0), Some(closed.order), Proof::Proved);
            assert_eq!(
                (answer.mobility, answer.screw_rank(), answer.proof),
                expected,
                "{name} {i} {j}: {}",
                answer.reason
            );
        }
    }
}

/// The rotation about a line through a point.
fn factor_of(scalar: i32, direction: [i32; 3], point: [i32; 3]) -> DualQuaternion<Q> {
    let [a, b, c] = direction;
    let [x, y, z] = point;
    let moment = [y * c - z * b, z * a - x * c, x * b - y * a];
    from_parts(&[scalar, a, b, c, 0, moment[0], moment[1], moment[2]].map(Q::from))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn factorisations_multiply_back_and_close(
        factors in prop::collection::vec(
            (-3_i32..=3, [-3_i32..=3, -3..=3, 1..=3], [-4_i32..=4, -4..=4, -4..=4]), 2..4),
    ) {
        let factors: Vec<_> = factors.into_iter().map(|(s, d, p)| factor_of(s, d, p)).collect();
        let polynomial = product(&factors);
        let quadratics = quadratic_factors(&polynomial.norm().value);
        prop_assert!(quadratics.is_some());
        let found = factorisations(&polynomial, &quadratics.unwrap()).unwrap();
        prop_assert_eq!(found.defect, 0.0);
        for (_, other) in &found.list {
            prop_assert_eq!(&product(other), &polynomial);
            prop_assert!(Linkage::of(&found.list[0].1, other).closes());
        }
    }
}
