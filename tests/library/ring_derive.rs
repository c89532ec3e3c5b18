//! Closure polynomials of linkages in space and on the sphere have the assemblies that are listed for roots.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, Options, SpaceFile, SphereFile, any_from_text, builtin_any};
use looproot::internal::derivation::{
    CurveRelation, RingCurve, RingPolynomial, SphereTrace, Unknown, Watch, derive_in_space,
    derive_in_space_with_symbols, derive_on_sphere, derive_on_sphere_with_symbols, trace_in_space, trace_on_sphere,
    transfer,
};
use looproot::internal::linkage::{space, sphere};
use looproot_algebra::int::Int;
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::univariate::Univariate;
use num_complex::Complex;
use rug::{Integer, Rational};

fn in_space(name: &str) -> Box<SpaceFile> {
    match builtin_any(&format!("linkage/{name}"), &Options::default()).unwrap() {
        Any::Space(file) => file,
        _ => panic!("{name}: a linkage in space"),
    }
}

/// Whether the value of a polynomial is small beside the sizes of its terms.
fn vanishes(polynomial: &Univariate<Integer>, z: Complex<f64>) -> bool {
    let (mut sum, mut size) = (Complex::from(0.0), 0.0);
    for (k, c) in polynomial.coefficients().iter().enumerate() {
        let term = z.powu(u32::try_from(k).unwrap()) * c.to_f64();
        (sum, size) = (sum + term, size + term.norm());
    }
    sum.norm() <= 1e-9 * size
}

/// Compares a polynomial with the values of its unknown at all assemblies, and the number of these with multiplicity.
fn compare(name: &str, one: &RingPolynomial, values: &[Complex<f64>], complex: usize, real: usize) {
    assert_eq!((one.roots() * one.shared, one.assemblies), (complex, complex), "{name}");
    assert!(one.distinct.is_some(), "{name}");
    if one.separates() {
        assert_eq!((one.shared, one.real_roots()), (1, real), "{name}");
    }
    let mut infinite = 0;
    for z in values {
        if z.norm() > 1e12 {
            infinite += 1;
        } else {
            assert!(vanishes(&one.coefficients, *z), "{name}: {z}");
        }
    }
    assert_eq!(infinite, one.at_pi * one.shared, "{name}");
    // No root is without an assembly.
    for root in one.coefficients.real_roots() {
        let t = { root }.to_f64();
        let nearest = values.iter().map(|z| (z - t).norm()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-6 * (1.0 + t.abs()), "{name}: {t}");
    }
}

#[test]
fn roots_are_the_assemblies_of_linkages_in_space() {
    let names =
        [("ball_in_track", 1), ("clemens_coupling", 3), ("delta", 1), ("rear_axle", 1), ("rssr_ssr", 2), ("tripod", 1)];
    for (name, groups) in names {
        let file = in_space(name);
        let linkage = &file.linkage;
        let given = &file.cases[0].given;
        let found = derive_in_space(linkage, given).unwrap();
        assert!(found.warnings.is_empty() && found.polynomials.len() == groups, "{name}: {:?}", found.warnings);
        let answer = space::solve(linkage, given, true).unwrap();
        let best = &found.polynomials[0];
        let value = |mode: &space::SpaceMode| match best.unknown {
            Unknown::HalfTangent { joint, over } => {
                assert!(!over, "{name}");
                (mode.joints[joint].unwrap() / 2.0).tan()
            }
            Unknown::Distance { joint, over } => {
                let axis = match &linkage.joints[joint].pair {
                    looproot::internal::kinematics::space::SpacePair::Prismatic(axis) => &axis.sphere.at[0],
                    _ => panic!("{name}: a prismatic joint"),
                };
                let length = axis.iter().map(|c| c.to_f64().powi(2)).sum::<f64>().sqrt();
                mode.joints[joint].unwrap() / if over { length } else { 1.0 }
            }
            Unknown::Position { body, axis, .. } => mode.position(body)[axis],
            Unknown::Rotation { body, at: [i, j], .. } => mode.bodies[body].rotation[i][j],
            Unknown::Axis { .. } => panic!("{name}: an axis of a linkage on the sphere"),
        };
        let values: Vec<Complex<f64>> = answer.modes.iter().map(value).collect();
        let real = answer.modes.iter().filter(|mode| mode.real).count();
        compare(name, best, &values, answer.verdict.complex, real);
    }
    // The plate of a delta robot is given: three angles that are independent of each other, of two values each.
    let file = in_space("delta");
    let found = derive_in_space(&file.linkage, &file.cases[1].given).unwrap();
    let counts: Vec<[usize; 3]> =
        found.polynomials.iter().map(|one| [one.roots(), one.shared, one.assemblies]).collect();
    assert_eq!(counts, [[2, 4, 8], [2, 2, 4], [2, 1, 2]]);
}

#[test]
fn platforms_on_three_legs_have_sixteen_roots() {
    for name in ["3rps", "3rrs"] {
        let file = in_space(name);
        let found = derive_in_space(&file.linkage, &file.cases[0].given).unwrap();
        let best = &found.polynomials[0];
        let claims = &file.cases[0].expected;
        assert!(best.separates(), "{name}");
        assert_eq!((Some(best.roots()), Some(best.real_roots())), (claims.complex, claims.real), "{name}");
    }
    let file = in_space("3upu");
    let refused = derive_in_space(&file.linkage, &file.cases[0].given).unwrap_err();
    assert!(refused.to_string().contains("plates on UPU legs"), "{refused}");
}

#[test]
fn roots_are_the_assemblies_of_linkages_on_the_sphere() {
    let names = ["double_hooke", "hooke_series", "spherical_3rrr", "spherical_coupler_curve", "spherical_four_bar"];
    for name in names.into_iter().chain(["spherical_stephenson", "spherical_watt"]) {
        let Any::Sphere(file) = builtin_any(&format!("linkage/{name}"), &Options::default()).unwrap() else {
            panic!("{name}: a linkage on the sphere")
        };
        let given = &file.cases[0].given;
        let found = derive_on_sphere(&file.linkage, given).unwrap();
        let answer = sphere::solve(&file.linkage, given, true).unwrap();
        let best = &found.polynomials[0];
        let Unknown::HalfTangent { joint, over: false } = best.unknown else { panic!("{name}: {:?}", best.unknown) };
        let values: Vec<Complex<f64>> = answer.modes.iter().map(|mode| (mode.joints[joint] / 2.0).tan()).collect();
        let real = answer.modes.iter().filter(|mode| mode.real).count();
        compare(name, best, &values, answer.verdict.complex, real);
    }
}

/// The polynomial in variable 0 with rational numbers for the others, primitive.
fn at(polynomial: &Polynomial<Int>, values: &[Rational]) -> Vec<Integer> {
    let exact = polynomial.map(|c| Some(Rational::from(c.to_integer()))).unwrap();
    let put: Vec<(usize, Polynomial<Rational>)> =
        values.iter().enumerate().map(|(k, value)| (1 + k, Polynomial::constant(value.clone()))).collect();
    exact.substitute_all(&put).to_univariate(0).unwrap().primitive_integers()
}

#[test]
fn symbols_are_the_numbers_of_the_file_at_their_values() {
    let file = in_space("rssr_ssr");
    let own = derive_in_space(&file.linkage, &file.cases[0].given).unwrap();
    let own = own.polynomials[0].coefficients.coefficients();
    let names = |list: &[&str]| list.iter().map(|name| (*name).to_owned()).collect::<Vec<String>>();
    let derived = |list: &[&str]| derive_in_space_with_symbols(&file, 0, &names(list), &Watch::none());
    // The joint A is given: its point and its angle are symbols.
    for (list, values) in [(vec!["A"], vec![-1]), (vec!["crank.A.x", "rocker.C.z"], vec![-2, 2])] {
        let found = derived(&list).unwrap();
        let values: Vec<Rational> = values.into_iter().map(Rational::from).collect();
        assert_eq!(at(&found.polynomial, &values), own, "{list:?}");
    }
    // The length is irrational, and its square is a number of the file.
    let found = derived(&["rod2.length"]).unwrap().polynomial;
    let square = Rational::from((3_077_614, 29_645));
    let halved = found.terms().map(|(exponents, c)| {
        let [power, length] = [0, 1].map(|k| exponents.get(k).copied().unwrap_or(0));
        assert_eq!(length % 2, 0);
        (vec![power, length / 2], c.clone())
    });
    assert_eq!(at(&Polynomial::from_terms(halved), &[square]), own);
    for (list, reason) in [
        (vec!["D"], "expected some of A, rod1.length"),
        (vec!["rod1"], "expected some of A, rod1.length"),
        (vec!["A", "A"], "twice"),
        (vec!["A", "rod1.length", "rod2.length", "rocker.C.z"], "4 symbols"),
    ] {
        let message = derived(&list).unwrap_err().to_string();
        assert!(message.contains(reason), "{list:?}: {message}");
    }
}

#[test]
fn the_input_of_a_spherical_four_bar_as_symbol_gives_its_transfer_function() {
    let Any::Sphere(file) = builtin_any("linkage/spherical_four_bar", &Options::default()).unwrap() else {
        panic!("a linkage on the sphere")
    };
    let found = derive_on_sphere_with_symbols(&file, 0, &["A".to_owned()], &Watch::none()).unwrap();
    let input = file.linkage.joints.iter().position(|joint| joint.name == "A").unwrap();
    let transferred = transfer(&file.linkage, input).unwrap().polynomial;
    let swapped = transferred.terms().map(|(exponents, c)| {
        let power = |k: usize| exponents.get(k).copied().unwrap_or(0);
        (vec![power(1), power(0)], c.clone())
    });
    assert_eq!(found.polynomial, Polynomial::from_terms(swapped));
}

fn on_sphere(name: &str) -> Box<SphereFile> {
    match builtin_any(&format!("linkage/{name}"), &Options::default()).unwrap() {
        Any::Sphere(file) => file,
        _ => panic!("{name}: a linkage on the sphere"),
    }
}

fn traced_on_sphere(file: &SphereFile, of: &str) -> SphereTrace {
    let (body, _, place) = file.point(of).unwrap();
    trace_on_sphere(&file.linkage, &file.cases[0].given, body, &place, &Watch::none()).unwrap()
}

fn traced_in_space(file: &SpaceFile, of: &str) -> RingCurve {
    let (body, _, place) = file.point(of).unwrap();
    trace_in_space(&file.linkage, &file.cases[0].given, body, &place, &Watch::none()).unwrap()
}

/// The size of a polynomial at a place, which may be complex, relative to its terms at one whose coordinates are 1 at least: all terms of a
/// polynomial with a factor x vanish with it.
fn size_at(polynomial: &Polynomial<Int>, at: &[Complex<f64>; 3]) -> f64 {
    let (mut sum, mut size) = (Complex::from(0.0), 0.0);
    for (exponents, c) in polynomial.terms() {
        let number = c.to_integer().to_f64();
        let factors = || at.iter().zip(&exponents);
        sum += factors().fold(Complex::from(number), |product, (x, e)| product * x.powu(*e));
        size += factors().fold(number.abs(), |product, (x, e)| product * x.norm().max(1.0).powi(e.cast_signed()));
    }
    sum.norm() / size
}

fn floats(place: &[Rational; 3]) -> [f64; 3] {
    place.each_ref().map(Rational::to_f64)
}

/// Two bodies with one point have one curve: that of the coupler is derived by Cramer's rule, that of the other body from sections. Their
/// polynomials differ by a multiple of the sphere.
#[test]
fn the_curve_of_a_coupler_on_the_sphere_is_that_of_its_sections() {
    let file = on_sphere("spherical_stephenson");
    let (SphereTrace::Coupler(coupler), SphereTrace::Sections(other)) =
        (traced_on_sphere(&file, "k.E"), traced_on_sphere(&file, "m.E"))
    else {
        panic!("a coupler and another body")
    };
    assert_eq!((other.square.as_ref(), other.compared), (Some(&coupler.square), 20));
    // The sixth link holds the point on a circle, the section of the curve with a plane.
    let answer = sphere::solve(&file.linkage, &file.cases[0].given, true).unwrap();
    assert_eq!(usize::try_from(coupler.degree()).unwrap(), answer.verdict.complex);
    let own = &other.relations[0].polynomial;
    assert!(own.degree(2) <= 1);
    // On the sphere they have one ratio: polynomials of degree 4 have 25 dimensions there, and are compared at 49 points.
    assert_eq!(coupler.square, 1);
    let values = (1..8).flat_map(|u| (1..8).map(move |v| (Rational::from((u, 3)), Rational::from((-v, 2)))));
    let pairs: Vec<[Rational; 2]> = values
        .map(|(u, v)| {
            let squares = Rational::from(&u * &u) + Rational::from(&v * &v);
            let below = Rational::from(&squares + 1);
            let at = [u * 2 / &below, v * 2 / &below, (1 - squares) / below];
            [own, &coupler.polynomial].map(|p| p.map(|c| Some(Rational::from(c.to_integer()))).unwrap().evaluate(&at))
        })
        .collect();
    let [x, y] = &pairs[0];
    assert!(*x != 0 && *y != 0);
    assert!(pairs.iter().all(|[p, q]| Rational::from(p * y) == Rational::from(q * x)));
}

/// The curve vanishes at the place of the point in all assemblies, complex ones too, at other values of the input.
#[test]
fn curves_on_the_sphere_pass_all_assemblies() {
    let mut file = on_sphere("spherical_3rrr");
    let SphereTrace::Sections(found) = traced_on_sphere(&file, "plate.B1") else { panic!("no coupler of a four-bar") };
    let own = &found.relations[0];
    // The leg that moves holds the point on a circle, the section of the curve with a plane.
    assert_eq!(2 * own.degree(), 8);
    let (body, _, place) = file.point("plate.B1").unwrap();
    let place = floats(&place);
    for value in ["A1 = 20 deg", "A1 = -75 deg", "A1 = 2.5"] {
        file.cases[0] = file.case_with(value).unwrap();
        let answer = sphere::solve(&file.linkage, &file.cases[0].given, false).unwrap();
        assert_eq!(answer.verdict.complex, 8);
        for mode in &answer.modes {
            let at = mode.bodies[body].each_ref().map(|row| row.iter().zip(place).map(|(z, x)| z * x).sum());
            let off = size_at(&own.polynomial, &at);
            assert!(off < 1e-8, "{value}: {off}");
        }
    }
    let elsewhere = [0.6, 0.0, 0.8].map(Complex::from);
    assert!(size_at(&own.polynomial, &elsewhere) > 1e-6);
}

/// A point that a rod keeps on a sphere and two axes on a torus: outside of the absolute conic, which is double on the torus, they meet in a
/// curve of degree 4.
const TWO_AXES: &str = r#"
[mechanism]
kind = "linkage"
space = "space"
ground = "base"
joints = [
    { name = "A", type = "R", of = ["base", "crank"], axis = [0, "3/5", "4/5"] },
    { name = "C", type = "R", of = ["crank", "coupler"], axis = [0, 1, 0] },
    { name = "rod", type = "SS", of = ["base", "coupler"], at = ["E", "F"], length = 7 },
]
[mechanism.bodies]
base = { A = [0, 0, 0], E = [6, 1, 2] }
crank = { A = [0, 0, 0], C = [3, 0, 1] }
coupler = { C = [0, 0, 0], F = [4, 1, -2], P = [2, 2, 1] }
[[input]]
given = { A = { tan_half = "1/3" } }
"#;

/// The projections of a curve in space vanish at the place of the point in all assemblies at other values of the input.
#[test]
fn curves_in_space_pass_all_assemblies() {
    let read = || match any_from_text(TWO_AXES, "test.toml", Format::Toml, &Options::default()).unwrap() {
        Any::Space(file) => file,
        _ => panic!("a linkage in space"),
    };
    let values = ["A = 20 deg", "A = -75 deg", "A = 2.5"];
    let delta = ["A1 = 10 deg", "A1 = 25 deg", "A1 = -1/3"];
    let track = ["S0 = 20 deg", "S0 = 1", "S0 = -1/3"];
    for (mut file, of, degrees, values) in [
        (read(), "coupler.F", [4, 4, 4], values),
        (read(), "coupler.P", [8, 8, 8], values),
        (in_space("delta"), "plate.B1", [2, 2, 2], delta),
        (in_space("ball_in_track"), "near.ball", [2, 3, 3], track),
    ] {
        let found = traced_in_space(&file, of);
        assert_eq!(found.square, None);
        let own: Vec<u64> = found.relations.iter().map(CurveRelation::degree).collect();
        assert_eq!(own, degrees, "{of}");
        let (body, _, place) = file.point(of).unwrap();
        let place = floats(&place).map(Complex::from);
        for value in values {
            file.cases[0] = file.case_with(value).unwrap();
            let answer = space::solve(&file.linkage, &file.cases[0].given, false).unwrap();
            assert!(!answer.modes.is_empty(), "{of} at {value}");
            for mode in &answer.modes {
                let at = mode.bodies[body].apply(&place);
                for relation in &found.relations {
                    let off = size_at(&relation.polynomial, &at);
                    assert!(off < 1e-8, "{of} at {value}: {off}");
                }
            }
        }
        let elsewhere = [0.6, 1.3, 0.8].map(Complex::from);
        assert!(found.relations.iter().all(|one| size_at(&one.polynomial, &elsewhere) > 1e-6), "{of}");
    }
}

/// A point of the ground rests, and has no curve.
#[test]
fn points_that_rest_have_no_curve() {
    let file = in_space("delta");
    let (body, _, place) = file.point("base.A1").unwrap();
    let refused = trace_in_space(&file.linkage, &file.cases[0].given, body, &place, &Watch::none()).unwrap_err();
    assert!(refused.to_string().contains("found a point that rests"), "{refused}");
}

/// Sides of bodies are symbols: the polynomial is that of the file at the sides of the file, and that of a file with another side at this one.
/// Both points of the first side are a quarter turn apart, so that the tangent of half of it is 1; the second side has an irrational sine s and
/// the cosine c, so that its symbol is 1/(1 + c).
#[test]
fn sides_of_bodies_on_the_sphere_are_symbols() {
    let file = on_sphere("spherical_stephenson");
    let names = ["c.A.B", "k.B.E"].map(str::to_owned);
    let found = derive_on_sphere_with_symbols(&file, 0, &names, &Watch::none()).unwrap();
    assert_eq!((found.compared, found.sides[0].as_ref()), (20, Some(&Rational::from(1))));
    let k = file.linkage.bodies.iter().find(|body| body.name == "k").unwrap();
    let [b, e] = ["B", "E"].map(|point| k.point(point).unwrap());
    let cosine = b.iter().zip(e).fold(Rational::new(), |sum, (x, y)| sum + Rational::from(x * y));
    assert_eq!(found.sides[1], Some(Rational::from(1) - Rational::from(&cosine * &cosine)));
    let side = (cosine + 1_u32).recip();
    let own = |file: &SphereFile| {
        let derived = derive_on_sphere(&file.linkage, &file.cases[0].given).unwrap();
        assert_eq!(derived.polynomials[0].unknown, found.unknown);
        derived.polynomials[0].coefficients.coefficients().to_vec()
    };
    assert_eq!(positive(at(&found.polynomial, &[Rational::from(1), side.clone()])), own(&file));
    // The side with the half-angle tangent 1/2 has the cosine 3/5.
    let text =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/equations/linkage/spherical_stephenson.toml"))
            .unwrap();
    let a = [-3, -18, -14].map(|x| Rational::from((x, 23)));
    let b = [22, -6, 3].map(|x| Rational::from((x, 23)));
    let moved: Vec<String> =
        (0..3).map(|k| format!("\"{}\"", &a[k] * Rational::from((3, 5)) + &b[k] * Rational::from((4, 5)))).collect();
    let before = "B = [\"22/23\", \"-6/23\", \"3/23\"] }";
    assert!(text.contains(before));
    let (text, _) = text.split_once("[expected]").unwrap();
    let text = text.replace(before, &format!("B = [{}] }}", moved.join(", ")));
    let Any::Sphere(other) = any_from_text(&text, "test.toml", Format::Toml, &Options::default()).unwrap() else {
        panic!("a linkage on the sphere")
    };
    assert_eq!(positive(at(&found.polynomial, &[Rational::from((1, 2)), side])), own(&other));
}

fn positive(coefficients: Vec<Integer>) -> Vec<Integer> {
    let is_negative = coefficients.last().is_some_and(|c| *c < 0);
    if is_negative { coefficients.into_iter().map(|c| -c).collect() } else { coefficients }
}

/// Symbols that are none on the sphere are refused with the reason.
#[test]
fn coordinates_of_directions_are_no_symbols() {
    let file = on_sphere("spherical_stephenson");
    let refused = |names: &[&str]| {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        derive_on_sphere_with_symbols(&file, 0, &names, &Watch::none()).unwrap_err().to_string()
    };
    assert!(refused(&["c.B.x"]).contains("changes its length"));
    assert!(refused(&["c.A.A"]).contains("one or opposite"));
    assert!(refused(&["c.A.Q"]).contains("found the symbol c.A.Q"));
    assert!(refused(&["k.B.C", "k.C.E"]).contains("moves a point of the second"));
}
