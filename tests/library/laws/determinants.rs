//! Determinants and resultants of polynomials with numeric coefficients, by two algorithms each.

use super::Poly;
use crate::strategies::{integers, rational};
use looproot_algebra::determinant::{bareiss, by_interpolation, modular};
use looproot_algebra::modp::{ModP, PRIME_61};
use looproot_algebra::modular::{Terms, determinant, resultant};
use looproot_algebra::ring::{Domain, Ring};
use proptest::prelude::*;
use rug::{Integer, Rational};

/// A polynomial in this many variables, of a total degree; some coefficients are zero.
fn polynomial(variables: usize, degree: u32) -> impl Strategy<Value = Terms> {
    let mut exponents = vec![vec![]];
    for _ in 0..variables {
        let longer = |e: &Vec<u32>| (0..=degree - e.iter().sum::<u32>()).map(|k| [&e[..], &[k]].concat()).collect();
        exponents = exponents.iter().flat_map::<Vec<Vec<u32>>, _>(longer).collect();
    }
    let coefficient = prop_oneof![1 => Just(0), 3 => -99_i64..100, 1 => any::<i64>()].prop_map(Integer::from);
    prop::collection::vec(coefficient, exponents.len()).prop_shuffle().prop_map(move |coefficients| {
        let terms = exponents.iter().zip(coefficients).filter(|(_, c)| !c.is_zero());
        let (exponents, coefficients): (Vec<&Vec<u32>>, _) = terms.unzip();
        Terms { exponents: exponents.into_iter().flatten().copied().collect(), coefficients }
    })
}

fn product(f: &Terms, g: &Terms, variables: usize) -> Terms {
    let mut sums = std::collections::BTreeMap::<Vec<u32>, Integer>::new();
    for (e, c) in f.iter(variables) {
        for (d, b) in g.iter(variables) {
            *sums.entry(e.iter().zip(d).map(|(e, d)| e + d).collect()).or_default() += c * b;
        }
    }
    sums.retain(|_, c| !c.is_zero());
    Terms { exponents: sums.keys().flatten().copied().collect(), coefficients: sums.into_values().collect() }
}

/// The terms in one order.
fn sorted(f: &Terms, variables: usize) -> Vec<(&[u32], &Integer)> {
    let mut terms: Vec<_> = f.iter(variables).collect();
    terms.sort();
    terms
}

fn negated(mut f: Terms) -> Terms {
    f.coefficients.iter_mut().for_each(|c| *c = Integer::from(-&*c));
    f
}

/// The coefficients in the first variable, constant one first, as polynomials in the second.
fn coefficients(f: &Terms) -> Vec<Poly> {
    let mut all = Vec::new();
    for (e, c) in f.iter(2) {
        let k = e[0] as usize;
        all.resize(all.len().max(k + 1), Poly::zero());
        let mut term = vec![Rational::new(); e[1] as usize];
        term.push(Rational::from(c.clone()));
        all[k] = all[k].add(&Poly::new(term));
    }
    all
}

/// The determinant of the Sylvester matrix, of two polynomials by their coefficients, constant ones first.
fn sylvester<D: Domain>(f: &[D], g: &[D]) -> D {
    if f.is_empty() || g.is_empty() {
        return D::zero();
    }
    let (m, n) = (f.len() - 1, g.len() - 1);
    let row = |p: &[D], shift: usize| -> Vec<D> {
        let column = |k: usize| (m + n - 1 - k).checked_sub(shift).and_then(|e| p.get(e).cloned());
        (0..m + n).map(|k| column(k).unwrap_or_else(D::zero)).collect()
    };
    let rows: Vec<_> = (0..n).rev().map(|s| row(f, s)).chain((0..m).rev().map(|s| row(g, s))).collect();
    bareiss(&rows)
}

/// The polynomial in the second variable alone.
fn in_second(f: &Terms) -> Poly {
    coefficients(f).into_iter().next().unwrap_or_else(Poly::zero)
}

/// Substitutes values for all but the first variable and returns the coefficients in the first, padded to the degree.
fn specialised(f: &Terms, variables: usize, at: &[i64]) -> Vec<Integer> {
    let mut all = Vec::new();
    for (e, c) in f.iter(variables) {
        let k = e[0] as usize;
        all.resize(all.len().max(k + 1), Integer::new());
        all[k] += at.iter().zip(&e[1..]).fold(c.clone(), |c, (&x, &e)| c * rug::ops::Pow::pow(Integer::from(x), e));
    }
    all
}

/// A polynomial in two variables with few terms.
fn sparse() -> impl Strategy<Value = Terms> {
    prop::collection::btree_map([0_u32..5, 0_u32..5], -9_i64..10, 0..4).prop_map(|terms| Terms {
        exponents: terms.keys().flatten().copied().collect(),
        coefficients: terms.into_values().map(Integer::from).collect(),
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn of_matrix_polynomials_are_the_same_by_three_algorithms(
        numbers in prop::collection::vec(rational(), 75), size in 1_usize..6, degree in 0_usize..3,
    ) {
        let matrix = |k: usize| -> Vec<Vec<Rational>> {
            numbers[k * 25..].chunks(5).take(size).map(|row| row[..size].to_vec()).collect()
        };
        let matrices: Vec<_> = (0..=degree).map(matrix).collect();
        let found = modular(&matrices);
        prop_assert_eq!(&found, &by_interpolation(&matrices));
        let image = |q: &Rational| ModP::<PRIME_61>::from_rational(q).unwrap();
        let images: Vec<Vec<Vec<_>>> =
            matrices.iter().map(|a| a.iter().map(|row| row.iter().map(image).collect()).collect()).collect();
        prop_assert_eq!(found.map(|q| Some(image(q))).unwrap(), by_interpolation(&images));
    }

    #[test]
    fn of_singular_pencils_and_of_pencils_with_singular_parts_are_exact(
        a in prop::collection::vec(rational(), 16), b in prop::collection::vec(rational(), 16), rank in 0_usize..4,
    ) {
        let rows = |m: &[Rational]| m.chunks(4).map(<[Rational]>::to_vec).collect::<Vec<_>>();
        let (a, mut b) = (rows(&a), rows(&b));
        for row in rank..4 {
            b[row] = b[0].clone();
        }
        let pencils = [vec![a.clone(), b.clone()], vec![b.clone(), a], vec![b.clone(), b]];
        for pencil in pencils {
            prop_assert_eq!(modular(&pencil), by_interpolation(&pencil));
        }
    }

    #[test]
    fn of_polynomials_in_two_variables_are_those_of_their_values(
        entries in prop::collection::vec(polynomial(2, 2), 9), x in -9_i64..10, y in -9_i64..10,
    ) {
        let rows: Vec<Vec<Terms>> = entries.chunks(3).map(<[Terms]>::to_vec).collect();
        let value = |f: &Terms| {
            let in_first = specialised(f, 2, &[y]);
            in_first.iter().rev().fold(Integer::new(), |value, c| value * x + c)
        };
        let values: Vec<Vec<Integer>> = rows.iter().map(|row| row.iter().map(value).collect()).collect();
        prop_assert_eq!(value(&determinant(&rows, 2).unwrap()), bareiss(&values));
    }

    #[test]
    fn resultants_are_sylvester_determinants(f in (0_u32..6).prop_flat_map(|d| polynomial(2, d)),
                                             g in (0_u32..6).prop_flat_map(|d| polynomial(2, d))) {
        let found = resultant(&f, &g, 2, 0).unwrap();
        prop_assert!(found.iter(2).all(|(e, _)| e[0] == 0));
        prop_assert_eq!(in_second(&found), sylvester(&coefficients(&f), &coefficients(&g)));
    }

    #[test]
    fn resultants_of_few_terms_are_sylvester_determinants(f in sparse(), g in sparse()) {
        let found = resultant(&f, &g, 2, 0).unwrap();
        prop_assert_eq!(in_second(&found), sylvester(&coefficients(&f), &coefficients(&g)));
    }

    #[test]
    fn resultants_in_three_variables_are_those_of_their_values(
        f in (1_u32..4).prop_flat_map(|d| polynomial(3, d)), g in (1_u32..4).prop_flat_map(|d| polynomial(3, d)),
        x in -9_i64..10, y in -9_i64..10,
    ) {
        let found = resultant(&f, &g, 3, 0).unwrap();
        let value = specialised(&found, 3, &[x, y]).into_iter().next().unwrap_or_default();
        prop_assert_eq!(value, sylvester(&specialised(&f, 3, &[x, y]), &specialised(&g, 3, &[x, y])));
    }

    #[test]
    fn resultants_are_multiplicative_and_change_sign_with_the_order(
        f in (0_u32..4).prop_flat_map(|d| polynomial(2, d)), g in (0_u32..4).prop_flat_map(|d| polynomial(2, d)),
        h in (0_u32..3).prop_flat_map(|d| polynomial(2, d)),
    ) {
        let of = |f: &Terms, g: &Terms| resultant(f, g, 2, 0).unwrap();
        let (by_g, by_h) = (of(&f, &g), of(&f, &h));
        let together = of(&f, &product(&g, &h, 2));
        let separate = product(&by_g, &by_h, 2);
        prop_assert_eq!(sorted(&together, 2), sorted(&separate, 2));

        let degree = |f: &Terms| f.iter(2).map(|(e, _)| e[0]).max().unwrap_or(0);
        let exchanged = of(&g, &f);
        let expected = if degree(&f) * degree(&g) % 2 == 1 { negated(by_g) } else { by_g };
        prop_assert_eq!(sorted(&exchanged, 2), sorted(&expected, 2));
    }

    #[test]
    fn resultants_of_polynomials_with_a_common_root_are_zero(
        f in polynomial(2, 3), g in polynomial(2, 2), a in -9_i64..10, b in -9_i64..10,
    ) {
        // x = a y + b is a root of both.
        let root = Terms { exponents: vec![1, 0, 0, 1, 0, 0], coefficients: [1, -a, -b].map(Integer::from).to_vec() };
        let found = resultant(&product(&f, &root, 2), &product(&g, &root, 2), 2, 0).unwrap();
        prop_assert_eq!(found, Terms::default());
    }
}

fn terms(list: &[(&[u32], i64)]) -> Terms {
    Terms {
        exponents: list.iter().flat_map(|(e, _)| e.iter().copied()).collect(),
        coefficients: list.iter().map(|&(_, c)| Integer::from(c)).collect(),
    }
}

/// Leading coefficients in x that vanish at the points 0, 1, 2 and 3 where the polynomials are evaluated.
#[test]
fn resultants_have_the_degrees_of_the_polynomials_not_of_their_values() {
    let zeros: &[(&[u32], i64)] = &[(&[2, 4], 1), (&[2, 3], -6), (&[2, 2], 11), (&[2, 1], -6)];
    let f = terms(&[zeros, &[(&[1, 0], 2), (&[0, 1], -1)]].concat());
    for tail in
        [&[(&[3, 2][..], 5), (&[3, 1], -5), (&[1, 0], 1), (&[0, 0], 7)][..], zeros, &[(&[0, 2], 3)], &[(&[1, 1], 2)]]
    {
        let g = terms(tail);
        for (f, g) in [(&f, &g), (&g, &f)] {
            let found = resultant(f, g, 2, 0).unwrap();
            assert_eq!(in_second(&found), sylvester(&coefficients(f), &coefficients(g)));
        }
    }
}

#[test]
fn resultants_of_constants_and_of_zero() {
    let one = |list| terms(list);
    let (cubic, constant, zero) = (one(&[(&[3], 2), (&[0], 5)]), one(&[(&[0], -7)]), Terms::default());
    let value = |f, g| resultant(f, g, 1, 0).unwrap().coefficients;
    assert_eq!(value(&cubic, &constant), [-343]);
    assert_eq!(value(&constant, &cubic), [-343]);
    assert_eq!(value(&constant, &constant), [1]);
    for f in [&cubic, &constant, &zero] {
        assert!(value(f, &zero).is_empty() && value(&zero, f).is_empty());
    }
    // A zero coefficient is no term.
    assert_eq!(value(&one(&[(&[9], 0), (&[1], 1), (&[0], -3)]), &cubic), [59]);
}

/// The circle `x^2 + y^2 = 25` and the parabola `x = y^2 - 5` meet where `y^4 - 9 y^2 = 0`.
#[test]
fn a_circle_meets_a_parabola() {
    let circle = terms(&[(&[2, 0], 1), (&[0, 2], 1), (&[0, 0], -25)]);
    let parabola = terms(&[(&[1, 0], 1), (&[0, 2], -1), (&[0, 0], 5)]);
    let found = resultant(&circle, &parabola, 2, 0).unwrap();
    assert_eq!(in_second(&found), integers(&[0, 0, -9, 0, 1]));
}

/// Vandermonde's determinant of x, y and z, term by term.
#[test]
fn vandermonde_is_the_product_of_differences() {
    let power = |k: usize, e: u32| {
        let mut exponents = vec![0; 3];
        exponents[k] = e;
        Terms { exponents, coefficients: vec![Integer::from(1)] }
    };
    let rows: Vec<Vec<Terms>> = (0..3).map(|k| (0..3).map(|e| power(k, e)).collect()).collect();
    let found = determinant(&rows, 3).unwrap();
    let difference = |i: usize, j: usize| Terms {
        exponents: [power(i, 1).exponents, power(j, 1).exponents].concat(),
        coefficients: [1, -1].map(Integer::from).to_vec(),
    };
    let expected = product(&product(&difference(1, 0), &difference(2, 0), 3), &difference(2, 1), 3);
    assert_eq!(sorted(&found, 3), sorted(&expected, 3));
    assert_eq!(determinant(&[], 3).unwrap(), terms(&[(&[0, 0, 0], 1)]));
}

/// In eight parameters together of degree 80 there are 6 * 10^10 monomials.
#[test]
fn what_would_need_too_many_values_is_left_to_others() {
    let mut f = terms(&[(&[2, 0, 0, 0, 0, 0, 0, 0, 0], 1)]);
    for k in 1..9 {
        let mut exponents = [0; 9];
        exponents[k] = 40;
        f.exponents.extend(exponents);
        f.coefficients.push(Integer::from(k));
    }
    assert_eq!(resultant(&f, &f, 9, 0), None);
    let (high, one) = (terms(&[(&[1025], 1)]), terms(&[(&[0], 1)]));
    assert_eq!(resultant(&high, &one, 1, 0), None);
    let far = terms(&[(&[1, 4_000_000_000], 1), (&[0, 0], 1)]);
    assert_eq!(resultant(&far, &terms(&[(&[1, 0], 1), (&[0, 0], 1)]), 2, 0), None);
}

#[test]
#[should_panic(expected = "no two terms")]
fn terms_given_twice_are_misuse() {
    let twice = terms(&[(&[1, 1], 1), (&[1, 1], 2)]);
    let _ = resultant(&twice, &terms(&[(&[1, 0], 1), (&[0, 0], 1)]), 2, 0);
}
