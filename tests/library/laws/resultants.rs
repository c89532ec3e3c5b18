//! Laws of resultants: three algorithms and one definition agree, products, signs, common roots planted and found.

use crate::strategies::rational;
use looproot_algebra::{
    determinant::bareiss,
    factors::remove_factors,
    int::Int,
    modp::{ModP, PRIME_61},
    polynomial::Polynomial,
    resultant::{bezout, common_divisor, dixon, eliminate, resultant, subresultant, sylvester},
    ring::{Domain, Field, Ring},
    univariate::Univariate,
};
use num_complex::Complex;
use proptest::prelude::*;
use rug::{Integer, Rational};

type Poly = Polynomial<Int>;

fn int(n: i64) -> Int {
    Int::from(n)
}

fn variable(k: usize) -> Poly {
    Polynomial::variable(k)
}

fn number(n: i64) -> Poly {
    Polynomial::constant(int(n))
}

/// Small integers, mostly zero: gaps in the degrees come for free.
fn small() -> impl Strategy<Value = Vec<i32>> {
    prop::collection::vec(prop_oneof![2 => Just(0), 3 => -5_i32..6], 0..8)
}

fn image<R: Ring>(coefficients: &[i32]) -> Univariate<R> {
    Univariate::new(coefficients.iter().map(|&c| R::from_integer(c)).collect())
}

/// Polynomials in the given number of variables with few terms.
fn polynomial(variables: usize, degree: u32, terms: usize) -> impl Strategy<Value = Poly> {
    let term = (prop::collection::vec(0..=degree, variables), (-9_i64..10).prop_map(Int::from));
    prop::collection::vec(term, 1..=terms).prop_map(Polynomial::from_terms)
}

fn dense(coefficients: &[Rational]) -> Univariate<Rational> {
    Univariate::new(coefficients.to_vec())
}

/// `S_j` by its definition: determinants of parts of the Sylvester matrix.
fn by_definition<D: Domain>(f: &Univariate<D>, g: &Univariate<D>, j: usize) -> Univariate<D> {
    let (m, n) = (f.degree().unwrap(), g.degree().unwrap());
    let all = sylvester::matrix(f.coefficients(), g.coefficients());
    let rows: Vec<&[D]> = (j..n).chain(n + j..m + n).map(|row| &all[row][j..]).collect();
    let coefficient = |i: usize| {
        let row = |row: &&[D]| [&row[..rows.len() - 1], &row[row.len() - 1 - i..row.len() - i]].concat();
        bareiss(&rows.iter().map(row).collect::<Vec<_>>())
    };
    Univariate::new((0..=j).map(coefficient).collect())
}

fn algorithms_agree<D: Domain>(f: &Univariate<D>, g: &Univariate<D>) -> Result<(), TestCaseError> {
    let expected = sylvester::resultant(f, g);
    prop_assert_eq!(&subresultant::resultant(f, g), &expected);
    let expansion = bezout::expansion(f, g);
    prop_assert_eq!(&expansion.resultant, &expected);
    let (Some(m), Some(n)) = (f.degree(), g.degree()) else { return Ok(()) };
    if m >= n {
        prop_assert_eq!(&bareiss(&bezout::matrix(f.coefficients(), g.coefficients())), &expected);
    }
    let chain = subresultant::chain(f, g);
    prop_assert_eq!(chain.len(), m.min(n));
    for (j, s) in chain.iter().enumerate() {
        prop_assert_eq!(s, &by_definition(f, g, j));
    }
    if m >= n && n >= 2 {
        prop_assert_eq!(&expansion.linear, &chain[1]);
    }
    Ok(())
}

proptest! {
    #[test]
    fn of_all_algorithms_are_one(f in small(), g in small()) {
        algorithms_agree::<Rational>(&image(&f), &image(&g))?;
        algorithms_agree::<Int>(&image(&f), &image(&g))?;
        algorithms_agree::<Integer>(&image(&f), &image(&g))?;
        // Small primes: leading coefficients and whole subresultants vanish that do not over the integers.
        algorithms_agree::<ModP<3>>(&image(&f), &image(&g))?;
        algorithms_agree::<ModP<7>>(&image(&f), &image(&g))?;
        algorithms_agree::<ModP<PRIME_61>>(&image(&f), &image(&g))?;
    }

    #[test]
    fn of_all_algorithms_are_one_over_polynomials(
        f in prop::collection::vec(polynomial(2, 2, 2), 1..5), g in prop::collection::vec(polynomial(2, 2, 2), 1..5),
    ) {
        algorithms_agree(&Univariate::new(f), &Univariate::new(g))?;
    }

    #[test]
    fn of_all_algorithms_are_one_over_dense_polynomials(
        f in prop::collection::vec(prop::collection::vec(rational(), 1..3), 1..4),
        g in prop::collection::vec(prop::collection::vec(rational(), 1..3), 1..4),
    ) {
        let nested = |f: &[Vec<Rational>]| Univariate::new(f.iter().map(|c| dense(c)).collect());
        algorithms_agree(&nested(&f), &nested(&g))?;
    }

    #[test]
    fn multiply_and_change_sign(f in small(), g in small(), h in small()) {
        let (f, g, h) = (image::<Int>(&f), image::<Int>(&g), image::<Int>(&h));
        let res = subresultant::resultant;
        prop_assert_eq!(res(&f, &g.mul(&h)), res(&f, &g).mul(&res(&f, &h)));
        if let (Some(m), Some(n)) = (f.degree(), g.degree()) {
            let turned = res(&g, &f);
            prop_assert_eq!(res(&f, &g), if m * n % 2 == 1 { turned.neg() } else { turned });
        }
        prop_assert_eq!(res(&f, &Univariate::zero()), Int::zero());
        prop_assert_eq!(res(&Univariate::zero(), &g), Int::zero());
    }

    #[test]
    fn are_products_of_differences_of_roots(
        a in prop::collection::vec(rational(), 0..5), b in prop::collection::vec(rational(), 0..5), lead in 1_i32..5,
    ) {
        let with_roots = |roots: &[Rational]| {
            let linear = |root: &Rational| dense(&[root.neg(), Rational::from(1)]);
            roots.iter().fold(image::<Rational>(&[lead]), |f, root| f.mul(&linear(root)))
        };
        let power = |n: usize| (0..n).fold(Rational::from(1), |p, _| p * lead);
        let differences = a.iter().flat_map(|x| b.iter().map(move |y| x.sub(y)));
        let expected = differences.fold(power(a.len()) * power(b.len()), |product, d| product * d);
        prop_assert_eq!(subresultant::resultant(&with_roots(&a), &with_roots(&b)), expected);
    }

    #[test]
    fn come_out_alike_on_every_route(
        f in prop_oneof![polynomial(3, 2, 5), polynomial(2, 6, 6)],
        g in prop_oneof![polynomial(3, 2, 5), polynomial(2, 6, 6)],
        monomial in (0_u32..3, 0_u32..3),
        gap in 1_u32..3,
    ) {
        // Common monomials and gaps in the eliminated variable are divided out before, and contents too.
        let monomial = Polynomial::from_terms([(vec![0, monomial.0, monomial.1], int(6))]);
        let spread = |f: &Poly| Polynomial::from_terms(f.terms().map(|(mut e, c)| {
            if let Some(first) = e.first_mut() { *first *= gap; }
            (e, c.clone())
        }));
        let (f, g) = (spread(&f), spread(&g).mul(&monomial));
        let parts = |f: &Poly| Univariate::new(f.coefficients_in(0));
        prop_assert_eq!(resultant(&f, &g, 0), subresultant::resultant(&parts(&f), &parts(&g)));
    }

    #[test]
    fn of_half_angle_forms_are_sums_of_squares(
        f in prop::collection::vec(polynomial(2, 2, 4), 3), g in prop::collection::vec(polynomial(2, 2, 4), 3),
    ) {
        let form = |p: &[Poly]| Univariate::new(vec![p[0].add(&p[1]), p[2].clone(), p[0].sub(&p[1])]);
        let (f, g) = (form(&f), form(&g));
        let whole = |f: &Univariate<Poly>| Polynomial::from_coefficients_in(2, f.coefficients());
        let eliminant = eliminate(&whole(&f), &whole(&g), 2);
        prop_assert_eq!(&eliminant.resultant, &sylvester::resultant(&f, &g));
        // The lift is a multiple of the first subresultant.
        if let (Some(2), Some(2), [s0, s1]) = (f.degree(), g.degree(), bezout::expansion(&f, &g).linear.coefficients()) {
            let lift = eliminant.lift.coefficients();
            prop_assert_eq!(lift[0].mul(s1), lift[1].mul(s0));
        }
    }

    #[test]
    fn vanish_at_planted_roots_which_come_back(
        f in polynomial(3, 3, 8), g in polynomial(3, 3, 8), at in prop::collection::vec(-4_i64..5, 3),
    ) {
        let values: Vec<Int> = at.iter().map(|&x| int(x)).collect();
        let shifted = |f: &Poly| f.sub(&Polynomial::constant(f.evaluate(&values)));
        let (f, g) = (shifted(&f), shifted(&g));
        let eliminant = eliminate(&f, &g, 0);
        if f.degree(0) > 0 || g.degree(0) > 0 {
            prop_assert!(eliminant.resultant.evaluate(&values).is_zero());
        }
        let lift: Vec<Int> = eliminant.lift.coefficients().iter().map(|c| c.evaluate(&values)).collect();
        let numbers: Vec<Rational> = at.iter().map(|&x| Rational::from(x)).collect();
        let rational = |c: &Int| Some(Rational::from(c.to_integer()));
        let divisor = eliminant.common_divisor_at(rational, &numbers, 0.0).unwrap();
        let root = Univariate::new(divisor.clone()).eval(&numbers[0]);
        prop_assert!(root.is_zero() , "{:?}", divisor);
        // A single common root is a root of the lift, too, unless the lift vanishes.
        if divisor.len() == 2 {
            prop_assert!(Univariate::new(lift).eval(&values[0]).is_zero());
        }
    }

    #[test]
    fn leave_common_divisors_in_exact_and_inexact_fields(
        common in prop::collection::vec(-3_i32..4, 0..4), f in small(), g in small(), infinite in 0_usize..3,
    ) {
        let linear = |root: &i32| image::<Rational>(&[-root, 1]);
        let divisor = common.iter().fold(Univariate::<Rational>::one(), |d, root| d.mul(&linear(root)));
        let (f, g) = (image::<Rational>(&f), image::<Rational>(&g));
        prop_assume!(!f.is_zero() || !g.is_zero());
        let (f, g) = (f.div_exact(&f.gcd(&g)), g.div_exact(&f.gcd(&g)));
        // Zeros in front of both are common roots at infinity.
        let given = |f: &Univariate<Rational>| [f.mul(&divisor).coefficients(), &vec![Rational::new(); infinite]].concat();
        let (f, g) = (given(&f), given(&g));
        let expected = [divisor.coefficients(), &vec![Rational::new(); infinite]].concat();
        let found = common_divisor(&f, &g, 0.0);
        prop_assert_eq!(found.len(), expected.len());
        let proportional = |a: &[Rational], b: &[Rational]| {
            (0..a.len()).all(|i| (0..i).all(|j| a[i].mul(&b[j]) == a[j].mul(&b[i])))
        };
        prop_assert!(proportional(&found, &expected), "{:?} {:?}", found, expected);
        let float = |f: &[Rational]| -> Vec<Complex<f64>> { f.iter().map(|c| Complex::from_rational(c).unwrap()).collect() };
        let inexact = common_divisor(&float(&f), &float(&g), 1e-9);
        prop_assert_eq!(inexact.len(), expected.len());
        for (x, y) in inexact.iter().zip(&float(&{ let mut e = expected; Rational::normalise(&mut e); e })) {
            prop_assert!((x - y).norm() <= 1e-6 * (1.0 + y.norm()) || infinite > 0, "{:?}", inexact);
        }
    }
}

#[test]
fn of_constants_and_of_lower_with_higher_degree_have_the_sign_of_the_definition() {
    let res = |f: &[i32], g: &[i32]| subresultant::resultant(&image::<Int>(f), &image(g));
    assert_eq!(res(&[5], &[7]), Int::one());
    assert_eq!(res(&[1, 2, 3], &[7]), int(49));
    assert_eq!(res(&[-2], &[1, 2, 3, 4]), int(-8));
    // x + 1 and x^3 + 2: one of degree lower than the other, both odd.
    assert_eq!(res(&[1, 1], &[2, 0, 0, 1]), Int::one());
    assert_eq!(res(&[2, 0, 0, 1], &[1, 1]), int(-1));
    let (f, g) = (variable(0).add(&variable(1)), variable(0).pow(3).add(&number(2)));
    assert_eq!(resultant(&f, &g, 0), number(2).sub(&variable(1).pow(3)));
    assert_eq!(resultant(&number(3), &g, 0), number(27));
    assert_eq!(resultant(&Poly::zero(), &number(3), 0), Poly::zero());
}

#[test]
fn of_a_polynomial_and_its_derivative_are_discriminants() {
    let [x, a, b, c, d] = [0, 1, 2, 3, 4].map(variable);
    let cubic = a.mul(&x.pow(3)).add(&b.mul(&x.pow(2))).add(&c.mul(&x)).add(&d);
    let terms = [
        (vec![0, 0, 2, 2], 1),
        (vec![0, 1, 0, 3], -4),
        (vec![0, 0, 3, 0, 1], -4),
        (vec![0, 2, 0, 0, 2], -27),
        (vec![0, 1, 1, 1, 1], 18),
    ];
    let discriminant = Polynomial::from_terms(terms.map(|(exponents, c)| (exponents, int(c))));
    assert_eq!(resultant(&cubic, &cubic.derivative(0), 0), a.mul(&discriminant).neg());
    let [p, q, r] = [a, b, c];
    let quartic = x.pow(4).add(&p.mul(&x.pow(2))).add(&q.mul(&x)).add(&r);
    let terms = [
        (vec![0, 4, 0, 1], 16),
        (vec![0, 3, 2], -4),
        (vec![0, 2, 0, 2], -128),
        (vec![0, 1, 2, 1], 144),
        (vec![0, 0, 4], -27),
        (vec![0, 0, 0, 3], 256),
    ];
    let discriminant = Polynomial::from_terms(terms.map(|(exponents, c)| (exponents, int(c))));
    assert_eq!(resultant(&quartic, &quartic.derivative(0), 0), discriminant);
}

/// The curve of a point of the coupler: circles of radius a about (0, 0) and b about (p, 0) carry the points at distances
/// r and s from the one drawing the curve, seen under the angle with cosine c and sine w.
#[test]
fn of_the_two_circles_of_a_fourbar_are_the_coupler_sextic() {
    let [t, x, y, p, a, b, r, s, c, w] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9].map(variable);
    let half_angle = |constant: &Poly, cos: &Poly, sin: &Poly| {
        let outer = constant.add(cos).add(&constant.sub(cos).mul(&t.pow(2)));
        outer.add(&sin.mul(&t).scale(&int(2)))
    };
    let square = |x: &Poly| x.pow(2);
    let two = |x: Poly| x.scale(&int(2));
    let first = square(&x).add(&square(&y)).add(&square(&r)).sub(&square(&a));
    let f = half_angle(&first, &two(r.mul(&x)).neg(), &two(r.mul(&y)).neg());
    let u = x.sub(&p);
    let second = square(&u).add(&square(&y)).add(&square(&s)).sub(&square(&b));
    let cos = two(s.mul(&u.mul(&c).add(&y.mul(&w)))).neg();
    let sin = two(s.mul(&y.mul(&c).sub(&u.mul(&w)))).neg();
    let g = half_angle(&second, &cos, &sin);
    let sextic = resultant(&f, &g, 0);
    assert_eq!(sextic.len(), 182);
    assert_eq!((sextic.degree(1), sextic.degree(2)), (6, 6));
    // The value that FLINT, Symbolica and PARI find.
    let primes = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29].map(int);
    assert_eq!(sextic.evaluate(&primes), int(11_384_543_093_536));
}

mod of_three_polynomials {
    use super::*;

    /// All monomials up to the degrees in x and y, with coefficients of the given degree in the variable 2, and
    /// vanishing at the point.
    fn through(point: [i64; 3], degrees: [u32; 2], inner: u32, seed: &mut i64) -> Poly {
        let mut terms = Vec::new();
        for a in 0..=degrees[0] {
            for b in 0..=degrees[1] {
                for k in 0..=inner {
                    *seed = (*seed * 389 + 7) % 1009;
                    terms.push((vec![a, b, k], int(*seed % 19 - 9)));
                }
            }
        }
        let f = Polynomial::from_terms(terms);
        f.sub(&Polynomial::constant(f.evaluate(&point.map(int))))
    }

    fn planted_root_comes_back(degrees: [u32; 2], size: usize, degree: u32) {
        let (point, mut seed) = ([-2, 3, 5], 11);
        let f: [Poly; 3] = std::array::from_fn(|_| through(point, degrees, 1, &mut seed));
        let eliminant = dixon::eliminate(f.each_ref(), [0, 1]);
        assert_eq!((eliminant.matrix.rows.len(), eliminant.matrix.columns.len()), (size, size));
        assert_eq!(eliminant.witness, Some([0, 0]));
        assert_eq!(eliminant.determinant.degrees(), [0, 0, degree]);
        let values = point.map(int);
        assert!(eliminant.determinant.evaluate(&values).is_zero());
        let at = |c: &Poly| Some(Rational::from(c.evaluate(&values).to_integer()));
        let [[p, q], [r, s]] = eliminant.matrix.common_root_at(at, 0.0).unwrap();
        assert_eq!((p / q, r / s), (Rational::from(-2), Rational::from(3)));
        let at = |c: &Poly| c.map(|c| f64::from_rational(&c.to_integer().into())).map(|c| c.evaluate(&[0.0, 0.0, 5.0]));
        let [[p, q], [r, s]] = eliminant.matrix.common_root_at(at, 1e-9).unwrap();
        assert!((p / q + 2.0).abs() < 1e-9 && (r / s - 3.0).abs() < 1e-9);
        // There is no common root elsewhere.
        let at = |c: &Poly| Some(ModP::<PRIME_61>::new(c.evaluate(&[0, 0, 4].map(int)).to_integer().mod_u(97).into()));
        assert!(eliminant.matrix.common_root_at(at, 0.0).is_none());
    }

    /// Degrees: `2mn` in the coefficients of each.
    #[test]
    fn vanish_at_planted_roots() {
        planted_root_comes_back([1, 1], 2, 6);
        planted_root_comes_back([1, 2], 4, 12);
        planted_root_comes_back([2, 1], 4, 12);
        planted_root_comes_back([2, 2], 8, 24);
    }

    /// Three products of lines have a common point for four values of the parameter, each of them simple.
    #[test]
    fn of_three_products_of_linear_forms() {
        let [x, y, z] = [0, 1, 2].map(variable);
        let f = [x.sub(&z).mul(&y.sub(&number(1))), x.mul(&y.sub(&number(2))), x.sub(&number(3)).mul(&y.sub(&z))];
        let determinant = dixon::eliminate(f.each_ref(), [0, 1]).determinant;
        // At (z, 2) if z = 2 or z = 3, at (0, 1) if z = 1, and at (0, z) if z = 0.
        let removal =
            remove_factors(&determinant, &[z.clone(), z.sub(&number(1)), z.sub(&number(2)), z.sub(&number(3))]);
        let multiplicities: Vec<u32> = removal.factors.iter().map(|(_, k)| *k).collect();
        assert_eq!(multiplicities, [1, 1, 1, 1]);
        assert!(removal.rest.to_constant().is_some());
    }

    /// A spherical four-bar between each two of three joints: 16 positions, in t^2 only 8; the leading coefficients of the
    /// two equations with the hidden joint come in as extraneous factors.
    #[test]
    fn of_three_spherical_fourbars_contain_the_iterated_resultant() {
        let fourbar = |x: usize, y: usize, c: [i64; 5]| {
            let monomial = |a: u32, b: u32| variable(x).pow(a).mul(&variable(y).pow(b));
            let terms = [monomial(2, 2), monomial(2, 0), monomial(0, 2), monomial(1, 1), monomial(0, 0)];
            terms.iter().zip(c).fold(Poly::zero(), |f, (term, c)| f.add(&term.scale(&int(c))))
        };
        let f = [fourbar(0, 1, [3, -1, 2, 5, -4]), fourbar(1, 2, [1, 2, -5, 3, 1]), fourbar(2, 0, [2, 7, -3, -4, 1])];
        let eliminant = dixon::eliminate(f.each_ref(), [0, 1]);
        assert_eq!(eliminant.witness, Some([0, 0]));
        let iterated = resultant(&resultant(&f[0], &f[2], 0), &f[1], 1);
        assert_eq!(iterated.degree(2), 16);
        assert!(iterated.terms().all(|(exponents, _)| exponents[2] % 2 == 0));
        let leading = [f[1].coefficients_in(1)[2].clone(), f[2].coefficients_in(0)[2].clone()];
        let removal = remove_factors(&eliminant.determinant, &leading);
        assert_eq!(removal.factors.iter().map(|(_, k)| *k).collect::<Vec<_>>(), [4, 4]);
        let ratio = removal.rest.div_exact(&iterated);
        assert_eq!(ratio.to_constant(), Some(int(81)));
    }

    /// Few terms can make the matrix singular; a maximal minor still vanishes at the root.
    #[test]
    fn of_special_form_have_a_singular_matrix_and_a_minor() {
        let [x, y, z] = [0, 1, 2].map(variable);
        let f = [
            x.pow(2).add(&x.mul(&y)).add(&x.mul(&z)),
            y.pow(2).add(&x.mul(&y)).sub(&z),
            x.pow(2).sub(&y.pow(2)).add(&y.mul(&z)).sub(&x),
        ];
        let values = [2, 3, 1].map(int);
        let f = f.map(|f| f.sub(&Polynomial::constant(f.evaluate(&values))));
        let eliminant = dixon::eliminate(f.each_ref(), [0, 1]);
        let at = |c: &Poly| ModP::<PRIME_61>::from_rational(&c.evaluate(&[0, 0, 1234].map(int)).to_integer().into());
        let minor = eliminant.matrix.maximal_minor(at).unwrap();
        assert_eq!((eliminant.matrix.rows.len(), eliminant.matrix.columns.len(), minor.entries.len()), (5, 5, 4));
        assert_eq!(eliminant.witness, Some([0, 0]));
        assert!(!eliminant.determinant.is_zero());
        assert!(eliminant.determinant.evaluate(&values).is_zero());
    }

    #[test]
    fn with_a_common_component_leave_nothing() {
        let [x, y] = [0, 1].map(variable);
        let component = x.add(&y).sub(&number(1));
        let f = [component.clone(), component.mul(&x), component.mul(&y)];
        assert!(dixon::eliminate(f.each_ref(), [0, 1]).witness.is_none());
    }
}

#[test]
fn known_factors_are_removed_and_reported() {
    let (t, x) = (variable(0), variable(1));
    let circle = t.pow(2).add(&number(1));
    let f = circle.pow(3).mul(&t.pow(2)).mul(&x.add(&t)).scale(&int(12));
    let removal = remove_factors(&f, &[circle.clone(), t.clone(), x.clone(), number(2), number(-1), Poly::zero()]);
    assert_eq!(removal.rest, x.add(&t).scale(&int(3)));
    assert_eq!(removal.factors.iter().map(|(_, k)| *k).collect::<Vec<_>>(), [3, 2, 0, 2, 0, 0]);
    let nothing = remove_factors(&Poly::zero(), &[circle]);
    assert!(nothing.rest.is_zero() && nothing.factors[0].1 == 0);
}
