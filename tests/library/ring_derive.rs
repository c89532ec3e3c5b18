//! Closure polynomials of linkages in space and on the sphere have the assemblies that are listed for roots.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Options, SpaceFile, builtin_any};
use looproot::internal::derivation::{
    RingPolynomial, Unknown, Watch, derive_in_space, derive_in_space_with_symbols, derive_on_sphere,
    derive_on_sphere_with_symbols, transfer,
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
        (vec!["D"], "expected --symbolic=NAMES"),
        (vec!["rod1"], "expected --symbolic=NAMES"),
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
