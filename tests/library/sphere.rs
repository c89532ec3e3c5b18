//! Linkages on the sphere: planted assemblies, curves and transfer functions.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, Options, SphereFile, any_from_text, builtin_any};
use looproot::internal::derivation::{sphere_trace, sphere_with_symbols, surface, transfer};
use looproot::internal::linkage::grashof::spherical;
use looproot::internal::linkage::sphere::{System, solve};
use looproot::internal::verdict::{Proof, Status};
use looproot_algebra::int::Int;
use looproot_algebra::number::nearest_f64;
use looproot_algebra::polynomial::Polynomial;
use looproot_calculus::quaternion::Quaternion;
use looproot_calculus::rotation::matrix::{Matrix, apply, matrix, transpose};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;

type Direction = [Rational; 3];

fn read(text: &str) -> Box<SphereFile> {
    match any_from_text(text, "test.toml", Format::Toml, &Options::default()).unwrap() {
        Any::Sphere(file) => file,
        _ => panic!("a linkage on the sphere"),
    }
}

fn builtin(name: &str) -> Box<SphereFile> {
    match builtin_any(name, &Options::default()).unwrap() {
        Any::Sphere(file) => file,
        _ => panic!("a linkage on the sphere"),
    }
}

/// A quaternion of norm 1: the square of one of integers over its norm.
fn unit_quaternion(random: &mut ChaCha8Rng) -> Quaternion<Rational> {
    let p = Quaternion {
        scalar: Rational::from(random.random_range(1..5)),
        vector: std::array::from_fn(|_| Rational::from(random.random_range(-4..5))),
    };
    let (square, norm) = (p.mul(&p), p.norm());
    Quaternion { scalar: square.scalar / &norm, vector: square.vector.map(|c| c / &norm) }
}

fn written(v: &Direction) -> String {
    format!("[\"{}\", \"{}\", \"{}\"]", v[0], v[1], v[2])
}

fn direction(random: &mut ChaCha8Rng) -> Direction {
    let turn = matrix(&unit_quaternion(random)).unwrap();
    std::array::from_fn(|k| turn[k][0].clone())
}

/// A four-bar with a known assembly: its file, and the place of the coupler's point there.
fn planted(random: &mut ChaCha8Rng) -> (String, Direction) {
    let [a, b, c, d]: [Direction; 4] = std::array::from_fn(|_| direction(random));
    let p = direction(random);
    let quaternions: [Quaternion<Rational>; 3] = std::array::from_fn(|_| unit_quaternion(random));
    let turns: [Matrix<Rational>; 3] = quaternions.each_ref().map(|q| matrix(q).unwrap());
    let own = |k: usize, v: &Direction| written(&apply(&transpose(&turns[k]), v));
    let text = format!(
        "[mechanism]\nkind = \"linkage\"\nspace = \"sphere\"\nground = \"frame\"\njoints = \"shared points\"\n[mechanism.bodies]\n\
         frame = {{ A = {}, D = {} }}\ncrank = {{ A = {}, B = {} }}\ncoupler = {{ B = {}, C = {}, P = {} }}\n\
         rocker = {{ C = {}, D = {} }}\n",
        written(&a),
        written(&d),
        own(0, &a),
        own(0, &b),
        own(1, &b),
        own(1, &c),
        own(1, &p),
        own(2, &c),
        own(2, &d)
    );
    let q = &quaternions[0];
    let [x, y, z] = &q.vector;
    let input = format!(
        "[[input]]\nbody = \"crank\"\nquaternion = [\"{}\", \"{x}\", \"{y}\", \"{z}\"]\n[[trace]]\npoint = \"coupler.P\"\ndegree = 8\n",
        q.scalar
    );
    (text + &input, p)
}

fn value(polynomial: &Polynomial<Int>, at: &Direction) -> Rational {
    let exact = polynomial.map(|c| Some(Rational::from(c.to_integer()))).unwrap();
    exact.evaluate(at)
}

#[test]
fn planted_four_bars_are_found_and_their_points_lie_on_the_curves() {
    let mut random = ChaCha8Rng::seed_from_u64(23);
    let mut found = 0;
    for _ in 0..12 {
        let (text, point) = planted(&mut random);
        let Ok(Any::Sphere(file)) = any_from_text(&text, "test.toml", Format::Toml, &Options::default()) else {
            continue;
        };
        let Ok(answer) = solve(&file.linkage, &file.cases[0].given, true) else { continue };
        // Coincident axes make a curve of assemblies or a folded one.
        if answer.verdict.status != Status::Complete {
            continue;
        }
        assert_eq!(answer.verdict.proof, Proof::Proved);
        assert_eq!((answer.verdict.complex, answer.verdict.real), (2, 2), "{text}");
        let coupler = file.linkage.bodies.iter().position(|body| body.name == "coupler").unwrap();
        let own = file.linkage.bodies[coupler].point("P").unwrap().clone();
        let is_planted = |mode: &looproot::internal::linkage::sphere::SphereMode| {
            (0..3).all(|i| {
                let image: f64 = (0..3).map(|k| mode.bodies[coupler][i][k].re * nearest_f64(&own[k])).sum();
                (image - nearest_f64(&point[i])).abs() < 1e-12
            })
        };
        assert!(answer.modes.iter().any(is_planted));
        assert!(answer.modes.iter().all(|mode| mode.residual < 1e-12));
        let Ok(curve) = sphere_trace(&file.linkage, coupler, &own) else { continue };
        assert_eq!(value(&curve.polynomial, &point), 0);
        found += 1;
    }
    assert!(found >= 6, "{found}");
}

#[test]
fn a_double_point_is_reached_twice_and_lies_on_its_quadric() {
    let file = builtin("linkage/spherical_coupler_curve");
    let coupler = file.linkage.bodies.iter().position(|body| body.name == "coupler").unwrap();
    let point = file.linkage.bodies[coupler].point("P").unwrap().clone();
    let curve = sphere_trace(&file.linkage, coupler, &point).unwrap();
    assert_eq!(curve.degree(), 8);
    let points = curve.double_points.as_ref().unwrap();
    assert_eq!(points.iter().map(|point| point.multiplicity).sum::<usize>(), 4);
    let float = |polynomial: &Polynomial<Int>| polynomial.map(|c| Some(c.to_f64())).unwrap();
    let (surface, locus) = (float(&curve.polynomial), float(&curve.locus));
    for point in points.iter().filter(|point| point.real) {
        let at = point.at.map(|z| z.re);
        assert!(locus.evaluate(&at).abs() < 1e-9);
        // The gradient on the sphere vanishes: it is along the point.
        let gradient: Vec<f64> = (0..3).map(|k| surface.derivative(k).evaluate(&at)).collect();
        let along: f64 = gradient.iter().zip(&at).map(|(g, x)| g * x).sum();
        let size = surface.coefficients().iter().fold(0.0_f64, |most, c| most.max(c.abs()));
        assert!(gradient.iter().zip(&at).all(|(g, x)| (g - along * x).abs() < 1e-8 * size));
    }
}

#[test]
fn the_cusp_that_was_made_is_found() {
    let file = builtin("linkage/spherical_cusp");
    let coupler = file.linkage.bodies.iter().position(|body| body.name == "coupler").unwrap();
    let point = file.linkage.bodies[coupler].point("P").unwrap().clone();
    let cusps = sphere_trace(&file.linkage, coupler, &point).unwrap().cusps.unwrap();
    assert_eq!(cusps.len(), 1);
    assert!(cusps[0].at.iter().zip(&point).all(|(z, x)| (z.re - nearest_f64(x)).abs() < 1e-12));
}

#[test]
fn a_hooke_joint_divides_the_tangent_by_its_cosine() {
    let text = r#"
[mechanism]
kind = "linkage"
space = "sphere"
ground = "house"
joints = [
    { name = "S0", type = "R", of = ["house", "in"], zero = [[0, 1, 0], [1, 0, 0]] },
    { name = "F1", type = "R", of = ["in", "cross"] }, { name = "G1", type = "R", of = ["cross", "out"] },
    { name = "S1", type = "R", of = ["house", "out"], zero = [["-4/5", "3/5", 0], [1, 0, 0]] },
]
[mechanism.bodies]
house = { S0 = [1, 0, 0], S1 = ["3/5", "4/5", 0] }
in = { S0 = [0, 0, 1], F1 = [1, 0, 0] }
cross = { F1 = [1, 0, 0], G1 = [0, 1, 0] }
out = { S1 = [0, 0, 1], G1 = [0, 1, 0] }
[[input]]
joint = "S0"
tan_half = "1/3"
"#;
    let file = read(text);
    let found = transfer(&file.linkage, 0).unwrap();
    // tan in = 2 t/(1 - t^2) = (3/5) 2 s/(1 - s^2)
    for (t, s) in [((1, 2), (2, 1)), ((1, 3), (1, 2)), ((0, 1), (0, 1))] {
        let tangent = |(n, d): (i32, i32)| {
            let x = Rational::from((n, d));
            Rational::from(&x * 2) / (Rational::from(1) - Rational::from(x.square_ref()))
        };
        let on = tangent(t) == tangent(s) * Rational::from((3, 5));
        let at = [Rational::from(t), Rational::from(s), Rational::new()];
        assert_eq!(value(&found.polynomial, &at) == 0, on, "{t:?} {s:?}");
    }
    let answer = solve(&file.linkage, &file.cases[0].given, true).unwrap();
    let angles: Vec<f64> = answer.modes.iter().map(|mode| mode.joints[3].re).collect();
    assert!(angles.iter().all(|angle| (angle.tan() - 1.25).abs() < 1e-12), "{angles:?}");
    assert!(found.constant_ratio.is_empty());
    let double = builtin("linkage/double_hooke");
    let words: Vec<&str> = transfer(&double.linkage, 0).unwrap().constant_ratio.iter().map(|(_, what)| *what).collect();
    assert!(words.contains(&"out = in"));
}

#[test]
fn what_does_not_hold_a_body_is_refused() {
    let head = "[mechanism]\nkind = \"linkage\"\nspace = \"sphere\"\nground = \"f\"\njoints = \"shared points\"\n[mechanism.bodies]\n";
    let four = "f = { A = [1, 0, 0], D = [0, 1, 0] }\nc = { A = [1, 0, 0], B = [0, 0, 1] }\n";
    let free =
        read(&format!("{head}{four}k = {{ B = [1, 0, 0], C = [0, 1, 0] }}\nr = {{ C = [1, 0, 0], D = [0, 1, 0] }}\n"));
    assert!(solve(&free.linkage, &[], true).unwrap_err().to_string().contains("leaves 1"));
    let bad = format!("{head}f = {{ A = [1, 0, 0] }}\nc = {{ A = [2, 0, 0] }}\n");
    let message = any_from_text(&bad, "test.toml", Format::Toml, &Options::default()).unwrap_err().to_string();
    assert!(message.contains("lengths"), "{message}");
}

#[test]
fn classes_of_spherical_four_bars_follow_their_sides() {
    assert_eq!(spherical(&builtin("linkage/spherical_four_bar").linkage).unwrap().class, "double-rocker");
    // A small crank between sides of a right angle turns round, and the rocker does not.
    let head = "[mechanism]\nkind = \"linkage\"\nspace = \"sphere\"\nground = \"f\"\njoints = \"shared points\"\n[mechanism.bodies]\n";
    let right = "{ A = [1, 0, 0], D = [0, 1, 0] }";
    let text = format!(
        "{head}f = {right}\nc = {{ A = [1, 0, 0], B = [\"24/25\", \"7/25\", 0] }}\nk = {{ B = [1, 0, 0], C = [0, 1, 0] }}\n\
         r = {{ C = [1, 0, 0], D = [0, 1, 0] }}\n"
    );
    assert_eq!(spherical(&read(&text).linkage).unwrap().class, "crank-rocker");
}

#[test]
fn surfaces_of_open_chains_hold_the_points_of_the_chains() {
    use looproot::internal::catalogue::builtin;
    use looproot::internal::catalogue::entry::Design;
    use looproot::internal::kinematics::forward::Forward;
    for (name, degree) in [("arm/chain_rr", 4), ("arm/chain_rp", 2), ("arm/chain_pr", 2), ("arm/chain_pp", 1)] {
        let entry = builtin(name, &Options::default()).unwrap();
        let Design::Arm(chain) = &entry.design else { panic!("an arm") };
        let found = surface(chain, &std::array::from_fn(|_| Rational::new())).unwrap();
        assert_eq!(found.degree(), degree, "{name}");
        let polynomial = found.polynomial.map(|c| Some(c.to_f64())).unwrap();
        let forward = Forward::of(chain).unwrap();
        for q in [[0.3, -1.2], [2.0, 0.7], [-0.4, 1.9]] {
            let at = forward.pose(&q).translation;
            assert!(polynomial.evaluate(&at).abs() < 1e-9, "{name} at {q:?}");
        }
    }
}

#[test]
fn relations_with_symbols_hold_at_all_assemblies() {
    for (name, symbols, degrees, wanted) in [
        ("spherical_four_bar", 4, [2, 2], None),
        ("hooke_series", 2, [4, 4], None),
        ("spherical_watt", 3, [2, 2], None),
        // The other sides have numbers.
        ("spherical_four_bar", 1, [2, 2], Some("c_A_B")),
        ("spherical_four_bar", 1, [2, 2], Some("k_B_C")),
    ] {
        let file = builtin(&format!("linkage/{name}"));
        let case = &file.cases[0];
        let wanted: Vec<String> = wanted.iter().map(|name: &&str| (*name).to_owned()).collect();
        let found = sphere_with_symbols(&file.linkage, case.given[0].joint.unwrap(), &wanted).unwrap();
        assert!(found.symbols.len() >= symbols, "{name}: {:?}", found.symbols);
        assert!((0..2).all(|k| found.polynomial.degree(k) <= degrees[k]), "{name}");
        let answer = solve(&file.linkage, &case.given, true).unwrap();
        let mut compared = 0;
        for mode in answer.modes.iter().filter(|mode| mode.real) {
            let tangents =
                found.ends.each_ref().map(|end| (0.5 * (end.sign * mode.joints[end.joint].re + end.offset)).tan());
            let values: Vec<f64> = tangents
                .into_iter()
                .chain(found.symbols.iter().flat_map(|one| [one.value.cos(), one.value.sin()]))
                .collect();
            let terms = found.polynomial.terms().map(|(exponents, c)| {
                let powers = exponents.iter().zip(&values).map(|(e, x)| x.powi(i32::try_from(*e).unwrap()));
                c.to_integer().to_f64() * powers.product::<f64>()
            });
            let (sum, size) = terms.fold((0.0, 0.0), |(sum, size), term: f64| (sum + term, size + term.abs()));
            assert!(sum.abs() < 1e-12 * size, "{name}: {sum} of {size}");
            compared += 1;
        }
        assert!(compared >= 2, "{name}");
    }
}

#[test]
fn directions_from_cosines_are_of_length_1() {
    // Arcs of 70, 30, 60 and 50 degrees: the directions of a joint in its two bodies do not have quite the same length.
    let arc = |degrees: f64| [degrees.to_radians().cos(), degrees.to_radians().sin()];
    let point = |name: &str, degrees: f64| format!("{name} = [{}, {}, 0]", arc(degrees)[0], arc(degrees)[1]);
    let body = |name: &str, ends: [&str; 2], degrees: f64| {
        format!("{name} = {{ {}, {} }}\n", point(ends[0], 0.0), point(ends[1], degrees))
    };
    let text = format!(
        "[mechanism]\nkind = \"linkage\"\nspace = \"sphere\"\nground = \"f\"\njoints = \"shared points\"\n[mechanism.bodies]\n\
         {}{}{}{}[[input]]\njoint = \"A\"\ntan_half = \"1/2\"\n",
        body("f", ["A", "D"], 70.0),
        body("c", ["A", "B"], 30.0),
        body("k", ["B", "C"], 60.0),
        body("r", ["D", "C"], 50.0)
    );
    let file = read(&text);
    let answer = solve(&file.linkage, &file.cases[0].given, file.cases[0].exact && file.exact).unwrap();
    assert_eq!((answer.verdict.status, answer.verdict.real), (Status::Complete, 2));
    assert_ne!(answer.verdict.proof, Proof::Proved);
    for mode in &answer.modes {
        let place = |body: usize, degrees: f64| {
            let [x, y] = arc(degrees);
            let turn = &mode.bodies[body];
            [0, 1, 2].map(|i: usize| (turn[i][0] * x + turn[i][1] * y).re)
        };
        let [b, c] = [place(2, 0.0), place(2, 60.0)];
        let cosine = |v: [f64; 3], w: [f64; 3]| v.iter().zip(w).map(|(x, y)| x * y).sum::<f64>();
        let d = [arc(70.0)[0], arc(70.0)[1], 0.0];
        assert!((cosine(c, d) - arc(50.0)[0]).abs() < 1e-14);
        assert!((cosine(b, [1.0, 0.0, 0.0]) - arc(30.0)[0]).abs() < 1e-14);
    }
}

/// A six-bar of which the frame b0 is in no dyad with the bodies that the input holds together.
const SIX_BAR: &str = r#"
[mechanism]
kind = "linkage"
space = "sphere"
ground = "b0"
joints = [
    { name = "j0", type = "R", of = ["b3", "b1"] },
    { name = "j1", type = "R", of = ["b2", "b1"] },
    { name = "j2", type = "R", of = ["b5", "b4"] },
    { name = "j3", type = "R", of = ["b4", "b3"] },
    { name = "j4", type = "R", of = ["b5", "b1"], zero = [["17/3", "8/3", "-5/3"], ["19/11", "25/11", "-64/11"]] },
    { name = "j5", type = "R", of = ["b0", "b4"] },
    { name = "j6", type = "R", of = ["b2", "b0"] },
]
[mechanism.bodies]
b0 = { j5 = [3, 1, 3], j6 = [1, -2, 2] }
b1 = { j0 = ["-25/11", "47/11", "-42/11"], j1 = ["6/11", "-61/11", "29/11"], j4 = ["47/11", "8/11", "53/11"] }
b2 = { j1 = [-5, "6/5", "17/5"], j6 = [2, -2, 1] }
b3 = { j0 = ["29/11", "-29/11", "-54/11"], j3 = ["53/11", "-75/11", "6/11"] }
b4 = { j2 = ["-20/9", "-16/9", "44/9"], j3 = ["-61/9", "43/9", "10/9"], j5 = ["-7/9", "-11/9", "37/9"] }
b5 = { j2 = [4, -4, 0], j4 = ["-32/9", "-23/9", "-43/9"] }
[[input]]
given = { j4 = { tan_half = 0 } }
"#;

#[test]
fn equations_are_written_in_the_axes_of_the_body_in_which_they_are_smallest() {
    let file = read(SIX_BAR);
    let (linkage, given) = (&file.linkage, &file.cases[0].given);
    let [of, least] =
        [System::of(linkage, given), System::least(linkage, given)].map(|system| system.unwrap().unknowns);
    assert_eq!([of, least], [9, 6]);
    let answer = solve(linkage, given, true).unwrap();
    assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::Complete, Proof::Proved));
    assert_eq!((answer.verdict.complex, answer.verdict.real), (4, 4));
    for mode in &answer.modes {
        assert!(mode.residual < 1e-14 && mode.joints[4].re.abs() < 1e-14);
        for (i, row) in mode.bodies[linkage.ground].iter().enumerate() {
            assert!(row.iter().enumerate().all(|(j, z)| z.re == f64::from(u8::from(i == j))));
        }
    }
}

/// A four-bar whose crank stands at the angle 0: the arcs from B to C and from C to D are given by the axes of the links.
fn four_bar(crank: &str, coupler: [&str; 2], rocker: [&str; 2], ground: &str) -> Box<SphereFile> {
    let [b, c] = coupler;
    let [other, d] = rocker;
    read(&format!(
        "[mechanism]\nkind = \"linkage\"\nspace = \"sphere\"\nground = \"base\"\njoints = [\n\
         {{ name = \"A\", type = \"R\", of = [\"base\", \"crank\"] }},\n{{ name = \"B\", type = \"R\", of = [\"crank\", \"coupler\"] }},\n\
         {{ name = \"C\", type = \"R\", of = [\"coupler\", \"rocker\"] }},\n{{ name = \"D\", type = \"R\", of = [\"rocker\", \"base\"] }},\n]\n\
         [mechanism.bodies]\nbase = {{ A = [1, 0, 0], D = {ground} }}\ncrank = {{ A = [1, 0, 0], B = {crank} }}\n\
         coupler = {{ B = {b}, C = {c} }}\nrocker = {{ C = {other}, D = {d} }}\n\
         [[input]]\ngiven = {{ A = {{ tan_half = 0 }} }}\n"
    ))
}

#[test]
fn a_dyad_whose_ends_coincide_or_are_opposite_moves_and_that_is_proved() {
    let [x, y] = ["[1, 0, 0]", "[0, 1, 0]"];
    let slanted = "[0.6, 0.8, 0]";
    // (crank's end, rocker's arc, ground's end): the end of the crank is D, or opposite to it.
    let equal = four_bar(y, [y, slanted], [slanted, y], y);
    let opposite = four_bar(y, ["[0, 1, 0]", slanted], [slanted, "[0, -1, 0]"], "[0, -1, 0]");
    for file in [&equal, &opposite] {
        let answer = solve(&file.linkage, &file.cases[0].given, true).unwrap();
        assert_eq!(
            (answer.verdict.status, answer.verdict.proof),
            (Status::SelfMotion, Proof::Proved),
            "{}",
            answer.verdict.reason
        );
        assert_eq!((answer.verdict.self_motion, answer.families.len()), (1, 1));
        let family = &answer.families[0];
        assert_eq!((family.dimension, family.joints.as_slice()), (1, [1, 3].as_slice()));
        assert!(family.sample.real && family.sample.residual < 1e-12);
    }
    // Arcs of other lengths do not close there.
    let open = four_bar(y, [y, slanted], ["[0, 0.6, 0.8]", y], y);
    let answer = solve(&open.linkage, &open.cases[0].given, true).unwrap();
    assert_eq!((answer.verdict.status, answer.verdict.proof), (Status::Unreachable, Proof::Proved));
    // A regular assembly does not move.
    let regular = four_bar(y, [y, x], [x, "[0, 0, 1]"], "[0, 0, 1]");
    let answer = solve(&regular.linkage, &regular.cases[0].given, true).unwrap();
    assert!(answer.verdict.status != Status::SelfMotion && answer.families.is_empty());
}
