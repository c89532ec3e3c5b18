//! Linkages with gears: planted assemblies are listed, and the count is that of the Laurent polynomial.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, LinkageFile, Options, any_from_text};
use looproot::internal::derivation::{
    Curve, Watch, derive_linkage, derive_linkage_with_input, derive_linkage_with_symbols, trace,
};
use looproot::internal::kinematics::linkage::{Accuracy, Given};
use looproot::internal::linkage::answer::{LinkageAnswer, LinkageMode, solve};
use looproot::internal::linkage::dyads::Dyads;
use looproot::internal::sweep::{Range, sweep_linkage};
use looproot::internal::verdict::{Proof, Status};
use looproot_algebra::int::Int;
use looproot_algebra::polynomial::Polynomial;
use num_complex::Complex;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::{Integer, Rational};
use std::f64::consts::PI;

type Gaussian = (Rational, Rational);

fn read(text: &str) -> Box<LinkageFile> {
    match any_from_text(text, "test.toml", Format::Toml, &Options::default()).unwrap() {
        Any::Linkage(file) => file,
        _ => panic!("a linkage in the plane"),
    }
}

fn solved(text: &str) -> LinkageAnswer {
    let file = read(text);
    solve(&file.linkage, &file.cases[0].given, file.accuracy(&file.cases[0])).unwrap()
}

fn refused(text: &str) -> String {
    match any_from_text(text, "test.toml", Format::Toml, &Options::default()) {
        Err(error) => error.to_string(),
        Ok(Any::Linkage(file)) => match solve(&file.linkage, &file.cases[0].given, Accuracy::Exact) {
            Err(error) => error.to_string(),
            Ok(answer) => answer.verdict.reason,
        },
        Ok(_) => panic!("a linkage in the plane"),
    }
}

fn times(a: &Gaussian, b: &Gaussian) -> Gaussian {
    let product = |x: &Rational, y: &Rational| Rational::from(x * y);
    (product(&a.0, &b.0) - product(&a.1, &b.1), product(&a.0, &b.1) + product(&a.1, &b.0))
}

fn conjugate(a: &Gaussian) -> Gaussian {
    (a.0.clone(), Rational::from(-&a.1))
}

fn less(a: &Gaussian, b: &Gaussian) -> Gaussian {
    (Rational::from(&a.0 - &b.0), Rational::from(&a.1 - &b.1))
}

fn plus(a: &Gaussian, b: &Gaussian) -> Gaussian {
    (Rational::from(&a.0 + &b.0), Rational::from(&a.1 + &b.1))
}

fn power(a: &Gaussian, exponent: i32) -> Gaussian {
    let base = if exponent < 0 { conjugate(a) } else { a.clone() };
    (0..exponent.abs()).fold((Rational::from(1), Rational::new()), |product, _| times(&product, &base))
}

/// A rotation with its tangent of half the angle.
fn turn(random: &mut ChaCha8Rng) -> Gaussian {
    let t = Rational::from((random.random_range(-9..10), random.random_range(1..7)));
    let below = Rational::from(&t * &t) + 1;
    ((1 - Rational::from(&t * &t)) / &below, t * 2 / below)
}

fn point(random: &mut ChaCha8Rng) -> Gaussian {
    let mut whole = || Rational::from(random.random_range(-9..10));
    let (x, y) = (whole(), whole());
    (if x == 0 && y == 0 { Rational::from(1) } else { x }, y)
}

fn written(a: &Gaussian) -> String {
    format!("[\"{}\", \"{}\"]", a.0, a.1)
}

fn tangent(a: &Gaussian) -> String {
    if a.0 == -1 { "inf".to_owned() } else { (&a.1 / Rational::from(&a.0 + 1)).to_string() }
}

fn angle(a: &Gaussian) -> f64 {
    a.1.to_f64().atan2(a.0.to_f64())
}

/// The number of solutions of `|c0 + c1 t^q + c2 t^p| = c3` on the torus.
fn bound(p: i32, q: i32) -> usize {
    usize::try_from(2 * (p.max(q).max(0) - p.min(q).min(0))).unwrap()
}

/// The number of sign changes of the gap between the last two points round the circle of the common root: at least as many
/// assemblies are real.
fn sign_changes(gap: impl Fn(Complex<f64>) -> f64) -> usize {
    // Fine enough that few pairs of roots lie between two samples.
    let samples: u32 = 20_000;
    let at = |k: u32| gap(Complex::cis(0.1 + f64::from(k) * std::f64::consts::TAU / f64::from(samples)));
    (0..samples).filter(|k| (at(*k) < 0.0) != (at(*k + 1) < 0.0)).count()
}

fn float(a: &Gaussian) -> Complex<f64> {
    Complex::new(a.0.to_f64(), a.1.to_f64())
}

/// A geared five-bar with a known assembly.
struct Planted {
    text: String,
    /// The angles of the four bodies there.
    angles: [f64; 4],
    /// The number of assemblies in general.
    count: usize,
    /// The least number of real ones.
    real: usize,
}

fn planted(random: &mut ChaCha8Rng, input: &str) -> Planted {
    let ratios = [(-1, 1), (2, 1), (3, 1), (-2, 1), (1, 2), (3, 2), (-1, 2), (4, 1), (-3, 1), (2, 3)];
    let ratio = ratios[random.random_range(0..ratios.len())];
    planted_with(random, input, ratio)
}

fn planted_with(random: &mut ChaCha8Rng, input: &str, (p, q): (i32, i32)) -> Planted {
    let (common, phase) = (turn(random), turn(random));
    // The common root of both rotations is rational.
    let (crank, wheel) = (power(&common, q), times(&phase, &power(&common, p)));
    let (rod1, rod2) = (turn(random), turn(random));
    let (a, e) = (point(random), point(random));
    let (b, d, c) = (point(random), point(random), point(random));
    let joint_b = plus(&a, &times(&crank, &b));
    let joint_d = plus(&e, &times(&wheel, &d));
    let joint_c = plus(&joint_b, &times(&rod1, &c));
    let end = times(&conjugate(&rod2), &less(&joint_d, &joint_c));
    let against = |second: &Gaussian, first: &Gaussian| tangent(&times(second, &conjugate(first)));
    let value = match input {
        "A" => tangent(&crank),
        "B" => against(&rod1, &crank),
        _ => against(&rod2, &rod1),
    };
    let count = match input {
        "A" => 2 * usize::try_from(q).unwrap(),
        _ => bound(p, q),
    };
    let text = format!(
        r#"
[mechanism]
kind = "linkage"
space = "plane"
ground = "frame"
joints = [
    {{ name = "A", type = "R", of = ["frame", "crank"] }},
    {{ name = "E", type = "R", of = ["frame", "wheel"] }},
    {{ name = "B", type = "R", of = ["crank", "rod1"] }},
    {{ name = "C", type = "R", of = ["rod1", "rod2"] }},
    {{ name = "D", type = "R", of = ["wheel", "rod2"] }},
    {{ name = "G", type = "gear", of = ["crank", "wheel"], carrier = "frame", ratio = "{p}/{q}", phase = {{ tan_half = "{}" }} }},
]
[mechanism.bodies]
frame = {{ A = {}, E = {} }}
crank = {{ A = [0, 0], B = {} }}
wheel = {{ E = [0, 0], D = {} }}
rod1 = {{ B = [0, 0], C = {} }}
rod2 = {{ C = [0, 0], D = {} }}
[[input]]
joint = "{input}"
tan_half = "{value}"
"#,
        tangent(&phase),
        written(&a),
        written(&e),
        written(&b),
        written(&d),
        written(&c),
        written(&end)
    );
    // The distance of the ends of what is left when the input is held, less the length between them.
    let (from, to) = (float(&a), float(&e));
    let relative = float(&times(&rod1, &conjugate(&crank)));
    let held = float(&times(&rod2, &conjugate(&rod1)));
    let arm = match input {
        "B" => float(&b) + relative * float(&c),
        _ => float(&b),
    };
    let last = match input {
        "B" => float(&end).norm_sqr(),
        _ => (float(&c) + held * float(&end)).norm_sqr(),
    };
    let gap = |root: Complex<f64>| {
        let wheel_end = to + float(&phase) * root.powi(p) * float(&d);
        (wheel_end - from - root.powi(q) * arm).norm_sqr() - last
    };
    let real = if input == "A" { 1 } else { sign_changes(gap) };
    Planted { text, angles: [angle(&crank), angle(&wheel), angle(&rod1), angle(&rod2)], count, real }
}

fn is_listed(answer: &LinkageAnswer, angles: &[f64; 4]) -> bool {
    answer.modes.iter().filter(|mode| mode.real).any(|mode| {
        // Bodies in the order of the file, the frame first.
        let apart = |k: usize| (Complex::cis(mode.bodies[k + 1].0.re) - Complex::cis(angles[k])).norm();
        (0..4).all(|k| apart(k) < 1e-6)
    })
}

fn planted_are_listed(members: u64) -> [usize; 3] {
    let (mut met, mut open, mut fewer) = (0, 0, 0);
    for seed in 0..members {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let input = ["A", "B", "C"][random.random_range(0..3)];
        let Planted { text, angles, count, real } = planted(&mut random, input);
        let answer = solved(&text);
        if answer.verdict.status == Status::Incomplete {
            open += 1;
            continue;
        }
        assert_eq!(answer.verdict.status, Status::Complete, "{seed}: {}\n{text}", answer.verdict.reason);
        assert_eq!(answer.verdict.proof, Proof::Proved);
        assert!(is_listed(&answer, &angles), "{seed}: {angles:?}\n{text}");
        assert!(answer.verdict.complex <= count, "{seed}: {} of {count}", answer.verdict.complex);
        assert!(answer.verdict.real >= real, "{seed}: {} real, at least {real}\n{text}", answer.verdict.real);
        let residual = answer.modes.iter().map(|mode| mode.residual).fold(0.0, f64::max);
        assert!(residual < 1e-9, "{seed}: {residual}");
        if answer.verdict.complex == count { met += 1 } else { fewer += 1 }
    }
    [met, fewer, open]
}

#[test]
fn planted_assemblies_of_geared_five_bars_are_listed() {
    let [met, fewer, open] = planted_are_listed(20);
    assert!(met >= 18 && open == 0, "{met} met, {fewer} fewer, {open} open");
}

/// Three hundred members.
#[test]
fn three_hundred_geared_five_bars() {
    let [met, fewer, open] = planted_are_listed(300);
    println!("geared five-bars: {met} with the count of the torus, {fewer} with fewer, {open} open");
    assert!(met >= 280 && open <= 3);
}

/// Rods leave the equations with their lengths alone, so that high powers of the cranks remain cheap.
#[test]
fn high_ratios_have_all_assemblies() {
    for (seed, ratio) in (0..).zip([(7, 1), (7, 4), (-5, 2), (11, 3)]) {
        let Planted { text, angles, count, real } = planted_with(&mut ChaCha8Rng::seed_from_u64(seed), "C", ratio);
        let answer = solved(&text);
        assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::Complete, Proof::Proved), "{ratio:?}");
        assert_eq!(answer.verdict.complex, count, "{ratio:?}");
        assert!(is_listed(&answer, &angles) && answer.verdict.real >= real, "{ratio:?}");
    }
}

/// The closure polynomial of every body has as many roots as there are assemblies, and the half tangents of all of them among these.
#[test]
fn closure_polynomials_have_all_assemblies_for_roots() {
    for seed in 0..12 {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let input = ["B", "C"][random.random_range(0..2)];
        let text = planted(&mut random, input).text;
        let file = read(&text);
        let derivation = derive_linkage(&file.linkage, &file.cases[0].given).unwrap();
        let answer = solved(&text);
        assert_eq!(derivation.equations.len(), 4, "two of the cycle and two of the gears");
        assert!(derivation.polynomials.len() >= 3);
        for own in &derivation.polynomials {
            assert!(own.is_proved());
            assert_eq!(own.roots(), answer.verdict.complex, "{seed}");
            let coefficients: Vec<f64> = own.coefficients.coefficients().iter().map(rug::Integer::to_f64).collect();
            for mode in answer.modes.iter().filter(|mode| mode.real) {
                let (cos, sin) = ((mode.bodies[own.body].0.re / 2.0).cos(), (mode.bodies[own.body].0.re / 2.0).sin());
                let (mut value, mut size) = (0.0, 0.0);
                for (k, c) in (0..).zip(&coefficients) {
                    let last = i32::try_from(coefficients.len()).unwrap() - 1;
                    let term = c * f64::powi(sin, k) * f64::powi(cos, last - k);
                    value += term;
                    size += term.abs();
                }
                assert!(value.abs() <= 1e-8 * size, "{seed}: {value} of {size}");
            }
        }
        let first = &derivation.polynomials[0];
        assert_eq!(first.coefficients.distinct_real_roots() + usize::from(first.at_pi > 0), answer.verdict.real);
    }
}

/// The size of a polynomial in half-angle tangents at an input and at an angle, relative to its terms; a further exponent belongs to `other`.
fn relative(polynomial: &Polynomial<Int>, tangent: f64, angle: Complex<f64>, other: f64) -> f64 {
    let (sin, cos) = ((angle / 2.0).sin(), (angle / 2.0).cos());
    let last = polynomial.degree(1);
    let (mut value, mut size) = (Complex::new(0.0, 0.0), 0.0);
    for (exponents, c) in polynomial.terms() {
        let power = |k: usize| exponents.get(k).copied().unwrap_or(0);
        let number =
            c.to_integer().to_f64() * tangent.powi(power(0).cast_signed()) * other.powi(power(2).cast_signed());
        let term = sin.powu(power(1)) * cos.powu(last - power(1)) * number;
        value += term;
        size += term.norm();
    }
    value.norm() / size
}

/// The file with another value of its input.
fn at_input(text: &str, value: &Rational) -> String {
    let (start, _) = text.rsplit_once("tan_half = ").unwrap();
    format!("{start}tan_half = \"{value}\"\n")
}

/// The relation of input and output vanishes at every assembly, complex ones too, that `solve` finds at inputs drawn at random, and has no
/// other roots there.
#[test]
fn the_relation_of_a_geared_five_bar_has_all_assemblies_for_roots() {
    for (seed, ratio) in [(2, (-1, 1)), (3, (2, 1)), (5, (1, 2))] {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let text = planted_with(&mut random, "C", ratio).text;
        let file = read(&text);
        let given = &file.cases[0].given;
        assert!(derive_linkage(&file.linkage, given).unwrap().input_output.is_none());
        let derivation = derive_linkage_with_input(&file.linkage, given, &Watch::none()).unwrap();
        assert_eq!(derivation.warnings, Vec::<String>::new());
        let found = derivation.input_output.unwrap();
        assert!(found.agrees && found.is_turn && found.compared == Some(20));
        for _ in 0..3 {
            let value = Rational::from((random.random_range(-50..50), random.random_range(1..30)));
            let answer = solved(&at_input(&text, &value));
            // Some inputs have complex assemblies alone, and are unreachable.
            assert_eq!(answer.verdict.proof, Proof::Proved);
            assert_eq!(answer.verdict.complex, found.polynomial.degree(1) as usize, "{ratio:?}");
            for mode in &answer.modes {
                let off = relative(&found.polynomial, value.to_f64(), mode.bodies[found.body].0, 1.0);
                assert!(off < 1e-8, "{ratio:?} at {value}: {off}");
            }
        }
        // Angles of no assembly are no roots.
        assert!(relative(&found.polynomial, 0.37, Complex::new(1.234, 0.1), 1.0) > 1e-8);
    }
}

/// A length as a symbol: the relation contains that of other lengths, and a third symbol is refused.
#[test]
fn the_relation_of_a_geared_five_bar_has_a_length_as_a_symbol() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let file = read(&planted_with(&mut random, "C", (-1, 1)).text);
    let given = &file.cases[0].given;
    let with = |names: &[&str]| {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        derive_linkage_with_symbols(&file.linkage, given, &names, &Watch::none())
    };
    let found = with(&["crank.B.x"]).unwrap();
    assert!(found.agrees && found.compared == Some(20));
    let mut other = file.linkage.clone();
    let length = Rational::from((7, 3));
    found.symbols[0].put(&mut other, &length);
    let own = derive_linkage_with_input(&other, given, &Watch::none()).unwrap().input_output.unwrap();
    assert_eq!(own.body, found.body);
    let at = found.polynomial.map(|c| Some(Rational::from(c.to_integer()))).unwrap();
    let at = at.substitute(2, &Polynomial::constant(length)).primitive().0;
    assert!(at == own.polynomial || at == own.polynomial.scale(&Int::from(Integer::from(-1))));
    let refused = with(&["crank.B.x", "crank.B.y", "wheel.D.x"]).unwrap_err().to_string();
    assert!(refused.contains("found 3 symbols, expected one to 2"), "{refused}");
}

fn curve(file: &LinkageFile, of: &str) -> Curve {
    let (body, _, place) = file.point(of).unwrap();
    trace(&file.linkage, &file.cases[0].given, body, &place, &Watch::none()).unwrap()
}

/// The size of a polynomial at a place of the plane, which may be complex, relative to its terms.
fn size_at(polynomial: &Polynomial<Int>, [x, y]: [Complex<f64>; 2]) -> f64 {
    let (mut value, mut size) = (Complex::new(0.0, 0.0), 0.0);
    for (exponents, c) in polynomial.terms() {
        let power = |k: usize| exponents.get(k).copied().unwrap_or(0);
        let term = x.powu(power(0)) * y.powu(power(1)) * c.to_integer().to_f64();
        value += term;
        size += term.norm();
    }
    value.norm() / size
}

/// The curve of the joint between the rods vanishes at its places in all assemblies, complex ones too, at inputs drawn at random. Its degree
/// is the number of assemblies with a slider that keeps the joint on a line.
#[test]
fn the_curve_of_a_geared_five_bar_passes_all_assemblies() {
    for (seed, ratio, degree) in [(2, (-1, 1), 6), (3, (2, 1), 10), (5, (1, 2), 10)] {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let text = planted_with(&mut random, "A", ratio).text;
        let file = read(&text);
        let found = curve(&file, "rod1.C");
        assert_eq!((found.degree(), found.compared), (degree, Some(20)), "{ratio:?}");
        let (body, _, place) = file.point("rod1.C").unwrap();
        let own = [place.re.to_f64(), place.im.to_f64()];
        for _ in 0..5 {
            let value = Rational::from((random.random_range(-50..50), random.random_range(1..30)));
            let answer = solved(&at_input(&text, &value));
            assert_eq!(answer.verdict.proof, Proof::Proved);
            assert!(!answer.modes.is_empty(), "{ratio:?}");
            for mode in &answer.modes {
                let (angle, [x, y]) = &mode.bodies[body];
                let (sin, cos) = (angle.sin(), angle.cos());
                let at = [x + cos * own[0] - sin * own[1], y + sin * own[0] + cos * own[1]];
                let off = size_at(&found.polynomial, at);
                assert!(off < 1e-8, "{ratio:?} at {value}: {off}");
            }
        }
        assert!(size_at(&found.polynomial, [Complex::new(0.37, 0.0), Complex::new(1.23, 0.1)]) > 1e-6);
        let (bodies, _) = text.split_once("[[input]]").unwrap();
        let slider = "joints = [\n    { name = \"K\", type = \"R\", of = [\"rod1\", \"slot\"], at = [\"C\", \"K\"] },\n    { name = \"L\", type = \
                      \"P\", of = [\"frame\", \"slot\"], along = [3, 7] },";
        let pinned = bodies
            .replace("joints = [", slider)
            .replace("frame = {", "slot = { L = [0, 0], K = [0, 0] }\nframe = { L = [1, \"5/3\"],");
        let answer = solved(&pinned);
        assert_eq!((answer.verdict.proof, answer.verdict.complex as u64), (Proof::Proved, degree), "{ratio:?}");
    }
}

/// A wheel geared to the crank of a four-bar changes nothing about the coupler, also where it has two places for each of the crank: the curve
/// from sections is the determinant.
#[test]
fn a_wheel_beside_a_four_bar_leaves_the_curve() {
    let four_bar = |joints: &str, bodies: &str| {
        read(&format!(
            "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"frame\"\njoints = [\n\
             {{ name = \"A\", type = \"R\", of = [\"frame\", \"crank\"] }},\n{{ name = \"B\", type = \"R\", of = [\"crank\", \"coupler\"] }},\n\
             {{ name = \"C\", type = \"R\", of = [\"coupler\", \"rocker\"] }},\n{{ name = \"D\", type = \"R\", of = [\"rocker\", \"frame\"] }},\n\
             {joints}]\n[mechanism.bodies]\nframe = {{ A = [0, 0], D = [7, 1], E = [2, 5] }}\ncrank = {{ A = [0, 0], B = [3, 0] }}\n\
             coupler = {{ B = [0, 0], C = [6, 0], P = [2, 3] }}\nrocker = {{ C = [0, 0], D = [5, 0] }}\n{bodies}\n\
             [[input]]\njoint = \"A\"\ntan_half = \"1/3\"\n"
        ))
    };
    let plain = curve(&four_bar("", ""), "coupler.P");
    assert_eq!((plain.degree(), plain.compared), (6, None));
    for ratio in ["2", "-1/2"] {
        let joints = format!(
            "{{ name = \"E\", type = \"R\", of = [\"frame\", \"wheel\"] }},\n\
             {{ name = \"G\", type = \"gear\", of = [\"crank\", \"wheel\"], carrier = \"frame\", ratio = \"{ratio}\" }},\n"
        );
        let found = curve(&four_bar(&joints, "wheel = { E = [0, 0] }"), "coupler.P");
        assert_eq!(found.compared, Some(20), "{ratio}");
        let negative = plain.polynomial.scale(&Int::from(Integer::from(-1)));
        assert!(found.polynomial == plain.polynomial || found.polynomial == negative, "{ratio}");
    }
}

/// A wheel on an arm, driven by the sun, drives a second wheel of the size of the sun: that one only moves along with the arm.
#[test]
fn a_train_that_turns_freely_moves() {
    let text = r#"
[mechanism]
kind = "linkage"
space = "plane"
ground = "sun"
joints = [
    { name = "O", type = "R", of = ["sun", "arm"] },
    { name = "P", type = "R", of = ["arm", "planet"] },
    { name = "Q", type = "R", of = ["arm", "last"] },
    { name = "S", type = "P", of = ["sun", "slide"], along = [1, 0] },
    { name = "T", type = "P", of = ["slide", "last"], along = [0, 1] },
    { name = "G", type = "gear", of = ["sun", "planet"], carrier = "arm", ratio = -2 },
    { name = "H", type = "gear", of = ["planet", "last"], carrier = "arm", ratio = "-1/2" },
]
[mechanism.bodies]
sun = { O = 0, S = 0 }
arm = { O = 0, P = 4, Q = 8 }
planet = { P = 0 }
last = { Q = 0, T = 0 }
slide = { S = 0, T = 0 }
"#;
    let answer = solved(text);
    assert_eq!(
        (answer.verdict.status, answer.verdict.self_motion),
        (Status::SelfMotion, 1),
        "{}",
        answer.verdict.reason
    );
}

/// A planet on an arm that is given: it turns by 1 - ratio times the arm's angle.
#[test]
fn a_planet_follows_its_arm() {
    let text = r#"
[mechanism]
kind = "linkage"
space = "plane"
ground = "sun"
joints = [
    { name = "O", type = "R", of = ["sun", "arm"] },
    { name = "P", type = "R", of = ["arm", "planet"] },
    { name = "G", type = "gear", of = ["sun", "planet"], carrier = "arm", ratio = "-3/1" },
]
[mechanism.bodies]
sun = { O = 0 }
arm = { O = 0, P = 4 }
planet = { P = 0, Q = 1 }
[[input]]
joint = "O"
tan_half = "1/3"
"#;
    let answer = solved(text);
    assert_eq!((answer.verdict.status, answer.verdict.complex), (Status::Complete, 1));
    let arm = 2.0 * (1.0_f64 / 3.0).atan();
    assert!((Complex::cis(answer.modes[0].bodies[2].0.re) - Complex::cis(4.0 * arm)).norm() < 1e-12);
    assert_eq!(answer.groups.len(), 1);
}

#[test]
fn wrong_gears_are_named() {
    let Planted { text, .. } = planted(&mut ChaCha8Rng::seed_from_u64(1), "C");
    let with = |ratio: &str| {
        let start = text.find("ratio = ").unwrap();
        let end = start + text[start..].find(", phase").unwrap();
        format!("{}ratio = {ratio}{}", &text[..start], &text[end..])
    };
    for (ratio, message) in [
        ("\"sqrt(2)\"", "test.toml:12: found the irrational ratio"),
        ("0", "test.toml:12: found the ratio 0 of gears, expected another one"),
        ("\"90/91\"", "with a sum above 40"),
    ] {
        let found = refused(&with(ratio));
        assert!(found.contains(message), "{found}");
    }
    // Two given values hold a linkage of one freedom twice.
    let both = text.replace("joint = \"C\"", "given = { A = { tan_half = 1 } }\njoint = \"C\"");
    assert!(refused(&both).contains("close a rigid part"), "{}", refused(&both));
    let none = &text[..text.find("[[input]]").unwrap()];
    assert!(refused(none).contains("leaves 1 freedom"), "{}", refused(none));
}

/// Equal wheels that turn the same way with equal cranks keep their rods parallel: the assemblies form a curve.
#[test]
fn a_geared_parallelogram_is_not_called_complete() {
    let text = r#"
[mechanism]
kind = "linkage"
space = "plane"
ground = "frame"
joints = [
    { name = "A", type = "R", of = ["frame", "crank"] },
    { name = "E", type = "R", of = ["frame", "wheel"] },
    { name = "B", type = "R", of = ["crank", "rod1"] },
    { name = "C", type = "R", of = ["rod1", "rod2"] },
    { name = "D", type = "R", of = ["wheel", "rod2"] },
    { name = "G", type = "gear", of = ["crank", "wheel"], carrier = "frame", ratio = 1 },
]
[mechanism.bodies]
frame = { A = 0, E = 4 }
crank = { A = 0, B = 1 }
wheel = { E = 0, D = 1 }
rod1 = { B = 0, C = 2 }
rod2 = { C = 0, D = 2 }
[[input]]
joint = "C"
tan_half = 0
"#;
    let answer = solved(text);
    assert_eq!(answer.verdict.status, Status::SelfMotion, "{}", answer.verdict.reason);
    assert_eq!(answer.verdict.self_motion, 1);
    assert!(answer.verdict.reason.contains("dimension 1"), "{}", answer.verdict.reason);
}

/// A four-bar's coupler triangle and a wheel upon it: the triangle has irrational coordinates, and the wheel a position for every root.
#[test]
fn a_wheel_on_a_dyad_takes_every_position() {
    for (ratio, p, q) in [("-2", -2_i32, 1), ("3", 3, 1), ("-3/2", -3, 2), ("1/4", 1, 4)] {
        let text = format!(
            r#"
[mechanism]
kind = "linkage"
space = "plane"
ground = "b0"
joints = [
 {{ name = "J0", type = "R", of = ["b0", "b1"] }},
 {{ name = "J1", type = "R", of = ["b1", "b2"] }},
 {{ name = "J2", type = "R", of = ["b1", "b3"] }},
 {{ name = "J3", type = "R", of = ["b0", "b2"] }},
 {{ name = "J4", type = "gear", of = ["b3", "b2"], carrier = "b1", ratio = "{ratio}", phase = {{ tan_half = "-3" }} }},
]
[mechanism.bodies]
b0 = {{ J0 = [0, -1], J3 = [2, 2] }}
b1 = {{ J0 = [3, -2], J1 = [1, -1], J2 = [1, "8/5"] }}
b2 = {{ J1 = ["-3/2", 8], J3 = [1, 4] }}
b3 = {{ J2 = [3, -2] }}
"#
        );
        let answer = solved(&text);
        assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::Complete, Proof::Proved), "{ratio}");
        // The angle of the wheel is 1/p times a known one.
        assert_eq!(answer.modes.iter().filter(|mode| mode.real).count(), 2 * p.unsigned_abs() as usize);
        let phase = 2.0 * (-3_f64).atan();
        for (k, mode) in answer.modes.iter().enumerate() {
            let [carrier, second, first] = [1, 2, 3].map(|body: usize| mode.bodies[body].0.re);
            let (p, q) = (f64::from(p), f64::from(q));
            let turns = (q * (second - carrier) - p * (first - carrier) - q * phase) / std::f64::consts::TAU;
            assert!((turns - turns.round()).abs() < 1e-12, "{ratio}: {turns}");
            let gap = |other: &looproot::internal::linkage::answer::LinkageMode| (other.bodies[3].0.re - first).abs();
            assert!(answer.modes[..k].iter().all(|other| gap(other) > 1e-6));
        }
    }
}

/// An arm whose planet runs on a fixed ring and on a sun that a dyad turns: neither pair of gears places it alone.
#[test]
fn an_arm_between_two_wheels_on_a_dyad_takes_every_position() {
    let text = r#"
[mechanism]
kind = "linkage"
space = "plane"
ground = "b0"
joints = [
 { name = "J0", type = "R", of = ["b0", "sun"] },
 { name = "J1", type = "R", of = ["sun", "b2"] },
 { name = "J3", type = "R", of = ["b0", "b2"] },
 { name = "O", type = "R", of = ["b0", "arm"] },
 { name = "P", type = "R", of = ["arm", "planet"] },
 { name = "G", type = "gear", of = ["sun", "planet"], carrier = "arm", ratio = -2 },
 { name = "H", type = "gear", of = ["b0", "planet"], carrier = "arm", ratio = 3 },
]
[mechanism.bodies]
b0 = { J0 = [0, -1], J3 = [2, 2], O = [0, -1] }
sun = { J0 = [3, -2], J1 = [1, -1] }
b2 = { J1 = ["-3/2", 8], J3 = [1, 4] }
arm = { O = 0, P = 4 }
planet = { P = 0 }
"#;
    let answer = solved(text);
    assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::Complete, Proof::Proved));
    // planet - arm = -2 (sun - arm) = -3 arm: five positions of the arm for each of the two of the sun.
    assert_eq!((answer.verdict.complex, answer.verdict.real), (10, 10));
    for mode in &answer.modes {
        let [sun, arm, planet] = [1, 3, 4].map(|body: usize| mode.bodies[body].0.re);
        for zero in [planet - 3.0 * arm + 2.0 * sun, planet + 2.0 * arm] {
            assert!((Complex::cis(zero) - 1.0).norm() < 1e-12, "{zero}");
        }
    }
}

/// Ratios of long trains multiply: their powers are refused before they are formed.
#[test]
fn a_long_train_of_large_ratios_is_undecided() {
    for phase in ["0", "1/2"] {
        let wheels = 0..12;
        let joints: Vec<String> =
            wheels.clone().map(|k| format!("{{ name = \"j{k}\", type = \"R\", of = [\"f\", \"w{k}\"] }},\n")).collect();
        let meshes: Vec<String> = (0..12)
            .map(|k| {
                let (next, ratio) = ((k + 1) % 12, if k == 11 { 1 } else { 39 });
                format!(
                    "{{ name = \"g{k}\", type = \"gear\", of = [\"w{k}\", \"w{next}\"], carrier = \"f\", ratio = {ratio}, phase = {{ tan_half = \"{phase}\" }} }},\n"
                )
            })
            .collect();
        let ground: Vec<String> = wheels.clone().map(|k| format!("j{k} = [{k}, 0]")).collect();
        let bodies: Vec<String> = wheels.map(|k| format!("w{k} = {{ j{k} = 0 }}\n")).collect();
        let text = format!(
            "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"f\"\njoints = [\n{joints}{meshes}]\n[mechanism.bodies]\nf = {{ {} }}\n{bodies}",
            ground.join(", "),
            joints = joints.concat(),
            meshes = meshes.concat(),
            bodies = bodies.concat(),
        );
        assert_eq!(solved(&text).verdict.status, Status::Incomplete, "{phase}");
    }
}

/// The half-angle tangents of the bodies but the first in a planted assembly.
const PLANTED: [f64; 5] = [-1.0 / 9.0, -5.0 / 4.0, 4.0 / 5.0, -3.0 / 1.0, 2.0 / 3.0];

/// Three pairs of gears in a loop of six links: five rotations are powers of two.
#[test]
fn three_pairs_of_gears_in_one_loop() {
    let text = r#"
[mechanism]
kind = "linkage"
space = "plane"
ground = "b0"
joints = [
    { name = "j0", type = "R", of = ["b0", "b1"] },
    { name = "j1", type = "R", of = ["b1", "b2"] },
    { name = "j2", type = "R", of = ["b2", "b3"] },
    { name = "j3", type = "R", of = ["b3", "b4"] },
    { name = "j4", type = "R", of = ["b4", "b5"] },
    { name = "j5", type = "R", of = ["b5", "b0"] },
    { name = "g0", type = "gear", of = ["b1", "b5"], carrier = "b0", ratio = 2, phase = { tan_half = "107/102" } },
    { name = "g1", type = "gear", of = ["b0", "b2"], carrier = "b1", ratio = -1, phase = { tan_half = "-4/5" } },
    { name = "g2", type = "gear", of = ["b3", "b5"], carrier = "b4", ratio = 3, phase = { tan_half = "-3371/3322" } },
]
[mechanism.bodies]
b0 = { j0 = ["2", "-6"], j5 = ["7", "3"] }
b1 = { j0 = ["53/41", "138/41"], j1 = ["-356/41", "88/41"] }
b2 = { j1 = ["503/41", "-181/41"], j2 = ["297/41", "361/41"] }
b3 = { j2 = ["-253/41", "-183/41"], j3 = ["-36/41", "160/41"] }
b4 = { j3 = ["31/5", "8/5"], j4 = ["27/5", "11/5"] }
b5 = { j4 = ["83/13", "105/13"], j5 = ["106/13", "16/13"] }
"#;
    let answer = solved(text);
    assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::Complete, Proof::Proved));
    let is_planted = |mode: &&LinkageMode| {
        let tangents = [(1, PLANTED[0]), (2, PLANTED[1]), (3, PLANTED[2]), (4, PLANTED[3]), (5, PLANTED[4])];
        tangents.iter().all(|(body, t): &(usize, f64)| {
            (Complex::cis(mode.bodies[*body].0.re - 2.0 * t.atan()) - 1.0).norm() < 1e-9
        })
    };
    assert_eq!(answer.modes.iter().filter(is_planted).count(), 1);
}

/// A crank that drives a wheel of an integer ratio: the sign of one discriminant says at which inputs there are assemblies.
#[test]
fn dyads_that_gears_drive_have_a_discriminant() {
    let mut driven = 0;
    for seed in 0..12 {
        let Planted { text, .. } = planted(&mut ChaCha8Rng::seed_from_u64(seed), "A");
        let mut file = read(&text);
        let Some(Given::Turn { joint, .. }) = file.cases[0].given.first() else { panic!("an angle") };
        let dyads = Dyads::of(&file.linkage, &[], *joint);
        // Wheels of q positions for one of the crank are no dyads.
        assert_eq!(dyads.is_some(), text.contains("/1\", phase"), "{text}");
        let Some(dyads) = dyads else { continue };
        driven += 1;
        for k in -8_i32..8 {
            let t = Rational::from((2 * k + 1, 5));
            let below = Rational::from(&t * &t) + 1;
            let (re, im): (Rational, Rational) = ((1 - Rational::from(&t * &t)) / &below, t * 2 / &below);
            let unknown = Complex::new(re.to_f64(), im.to_f64());
            if let Given::Turn { turn, within, .. } = &mut file.cases[0].given[0] {
                (turn.re, turn.im, *within) = (re, im, None);
            }
            let answer = solve(&file.linkage, &file.cases[0].given, Accuracy::Exact).unwrap();
            let (value, _) = dyads.list[0].discriminant.value(&[unknown]);
            assert_eq!(answer.verdict.real == 2, value.re < 0.0, "{seed}: {value}");
            for mode in answer.modes.iter().filter(|mode| mode.real) {
                assert!(dyads.signs(mode, unknown.arg()).is_some());
            }
        }
    }
    assert!(driven >= 4, "{driven}");
}

/// The sweep of such a crank is that of a dyad.
#[test]
fn a_sweep_of_a_geared_five_bar_is_proved() {
    let mut proved = 0;
    for seed in 0..6 {
        let Planted { text, .. } = planted(&mut ChaCha8Rng::seed_from_u64(seed), "A");
        let file = read(&text);
        let Some(Given::Turn { joint, .. }) = file.cases[0].given.first() else { panic!("an angle") };
        let range = Range { from: -PI, to: PI, steps: 30 };
        let found = sweep_linkage(&file.linkage, file.given(&file.cases[0]), *joint, range, || ()).unwrap();
        proved += usize::from(found.verdict.proof == Proof::Proved);
    }
    assert!(proved >= 1);
}

/// A group of several loops and slides in bodies that turn on an irrational dyad.
#[test]
fn groups_with_slides_are_solved_near_rational_numbers() {
    let text = r#"
[mechanism]
kind = "linkage"
space = "plane"
ground = "b0"
joints = [
 { name = "J0", type = "R", of = ["b0", "b1"] },
 { name = "J1", type = "R", of = ["b0", "b2"] },
 { name = "J2", type = "R", of = ["b1", "b3"] },
 { name = "J3", type = "R", of = ["b2", "b4"] },
 { name = "J4", type = "RR", of = ["b4", "b3"], length = 9 },
 { name = "J5", type = "RR", of = ["b0", "b4"], length = 7 },
 { name = "J6", type = "PR", of = ["b4", "b1"], along = [0, 1] },
 { name = "J7", type = "PR", of = ["b3", "b1"], along = [4, -3] },
]
[mechanism.bodies]
b0 = { J0 = [0, 0], J1 = [0, 2], J5 = [5, 0] }
b1 = { J0 = [1, 0], J2 = [-5, -4], J6 = [4, -2], J7 = [3, -2] }
b2 = { J1 = [2, "-7/2"], J3 = [0, 2] }
b3 = { J2 = [2, -1], J4 = ["-5/2", -6], J7 = [0, 0] }
b4 = { J3 = [1, 0], J4 = [3, -1], J5 = [0, 0], J6 = ["4/3", 2] }
"#;
    let answer = solved(text);
    assert_eq!(answer.verdict.status, Status::Complete, "{}", answer.verdict.reason);
    assert!(matches!(answer.verdict.proof, Proof::Probable { .. }));
    assert_eq!((answer.verdict.complex, answer.verdict.real), (36, 16));
}
