//! Laws of polynomials in several variables, and of the integers that are their coefficients.

use crate::strategies::{Sample, element, rational};
use looproot_algebra::{
    dual::Dual,
    int::Int,
    interval::Interval,
    modp::{ModP, PRIME_61},
    monomial::{LARGEST_EXPONENT, Packing},
    polynomial::Polynomial,
    ring::{Domain, Ring},
    univariate::Univariate,
};
use num_complex::Complex;
use proptest::prelude::*;
use rug::{Complete, Integer, Rational, ops::Pow};
use std::cmp::Ordering;

type Poly = Polynomial<Int>;

/// Integers of one, two and more words, and those beside the ends of words.
fn integer() -> impl Strategy<Value = Integer> {
    let ends = [i128::from(i64::MIN), i128::from(i64::MAX), i128::MIN, i128::MAX, 1 << 64, -(1 << 64), 1 << 32];
    prop_oneof![
        4 => (-9_i64..10).prop_map(Integer::from),
        1 => any::<i64>().prop_map(Integer::from),
        1 => any::<i128>().prop_map(Integer::from),
        2 => (prop::sample::select(ends.to_vec()), -2_i32..3).prop_map(|(end, step)| Integer::from(end) + step),
        1 => (any::<i128>(), any::<i128>()).prop_map(|(a, b)| Integer::from(a) * b),
    ]
}

fn small() -> impl Strategy<Value = Int> {
    (-9_i64..10).prop_map(Int::from)
}

fn any_int() -> impl Strategy<Value = Int> {
    integer().prop_map(Int::from)
}

/// A polynomial with at most this many terms and variables, with exponents up to a degree.
fn polynomial<R: Ring>(
    c: impl Strategy<Value = R> + 'static,
    terms: usize,
    variables: usize,
    degree: u32,
) -> impl Strategy<Value = Polynomial<R>> {
    let exponents = prop::collection::vec(prop_oneof![2 => Just(0), 3 => 0..=degree], 0..=variables);
    prop::collection::vec((exponents, c), 0..=terms).prop_map(Polynomial::from_terms)
}

fn nonzero(terms: usize, variables: usize, degree: u32) -> impl Strategy<Value = Poly> {
    polynomial(small(), terms, variables, degree).prop_filter("not zero", |p| !p.is_zero())
}

/// All products of terms, summed by `from_terms`: the definition.
fn schoolbook<R: Ring>(a: &Polynomial<R>, b: &Polynomial<R>) -> Polynomial<R> {
    let variables = a.variables().max(b.variables());
    let terms = a.terms().flat_map(|(e, c)| b.terms().map(move |(f, d)| (e.clone(), f, c.mul(d))));
    let at = |e: &[u32], i: usize| e.get(i).copied().unwrap_or(0);
    Polynomial::from_terms(terms.map(|(e, f, c)| ((0..variables).map(|i| at(&e, i) + at(&f, i)).collect(), c)))
}

/// Monomials decrease, no coefficient is zero, and terms rebuild the polynomial.
fn is_normal<R: Ring>(p: &Polynomial<R>) -> Result<(), TestCaseError> {
    let exponents: Vec<Vec<u32>> = p.terms().map(|(exponents, _)| exponents).collect();
    prop_assert!(exponents.is_sorted_by(|a, b| a > b), "{:?}", exponents);
    prop_assert!(p.coefficients().iter().all(|c| !c.is_zero()));
    prop_assert_eq!(&Polynomial::from_terms(p.terms().map(|(e, c)| (e, c.clone()))), p);
    Ok(())
}

fn ring<R: Ring>(a: &Polynomial<R>, b: &Polynomial<R>, c: &Polynomial<R>) -> Result<(), TestCaseError> {
    prop_assert_eq!(a.add(b).add(c), a.add(&b.add(c)));
    prop_assert_eq!(a.add(b), b.add(a));
    prop_assert_eq!(a.mul(b).mul(c), a.mul(&b.mul(c)));
    prop_assert_eq!(a.mul(b), b.mul(a));
    prop_assert_eq!(a.mul(&b.add(c)), a.mul(b).add(&a.mul(c)));
    prop_assert_eq!(&a.add(&Polynomial::zero()), a);
    prop_assert_eq!(&a.mul(&Polynomial::one()), a);
    prop_assert_eq!(a.sub(b), a.add(&b.neg()));
    prop_assert!(a.sub(a).is_zero() && Polynomial::<R>::zero().is_zero() && !Polynomial::<R>::one().is_zero());
    prop_assert_eq!(a.mul(b), schoolbook(a, b));
    prop_assert_eq!(a.pow(3), a.mul(a).mul(a));
    prop_assert_eq!(Polynomial::<R>::from_integer(6), Polynomial::from_integer(-2).mul(&Polynomial::from_integer(-3)));
    let mut sum = c.clone();
    sum.add_product(a, b);
    prop_assert_eq!(sum, c.add(&a.mul(b)));
    for p in [a.add(b), a.sub(b), a.mul(b), a.pow(2), a.derivative(0), a.neg(), a.substitute(1, b)] {
        is_normal(&p)?;
    }
    Ok(())
}

fn three<R: Sample + 'static>() -> impl Strategy<Value = [Polynomial<R>; 3]> {
    let one = || polynomial(element::<R>(), 5, 3, 3);
    [one(), one(), one()]
}

macro_rules! rings {
    ($($name:ident: $ring:ty;)*) => {
        proptest! {
            #![proptest_config(ProptestConfig::with_cases(48))]
            $(#[test]
            fn $name([a, b, c] in three::<$ring>()) {
                ring(&a, &b, &c)?;
            })*
        }
    };
}

mod over {
    use super::*;

    rings! {
        rationals: Rational;
        integers: Integer;
        modulo: ModP<PRIME_61>;
        a_small_prime: ModP<1009>;
        complex_numbers: Complex<Rational>;
        dual_numbers: Dual<Rational>;
        univariates: Univariate<Rational>;
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn machine_integers(a in polynomial(any_int(), 6, 4, 4), b in polynomial(any_int(), 6, 2, 9), c in polynomial(small(), 30, 3, 3)) {
            ring(&a, &b, &c)?;
        }

        #[test]
        fn polynomials([a, b, c] in [0, 1, 2].map(|_| polynomial(polynomial(small(), 3, 2, 2), 4, 2, 2))) {
            ring(&a, &b, &c)?;
        }

        /// Integers of at most 53 bits are exact in f64, and so are the intervals.
        #[test]
        fn floats_that_are_integers([a, b] in [0, 1].map(|_| polynomial(small(), 8, 3, 3))) {
            let float = |p: &Poly| p.map(|c| Some(c.to_f64())).unwrap();
            prop_assert_eq!(float(&a).mul(&float(&b)), float(&a.mul(&b)));
            let interval = |p: &Poly| p.map(|c| Interval::from_rational(&Rational::from(c.to_integer()))).unwrap();
            let product = interval(&a).mul(&interval(&b));
            for (exponents, c) in a.mul(&b).terms() {
                let enclosed = product.terms().any(|(e, i)| e == exponents && i.contains(c.to_f64()));
                prop_assert!(enclosed);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn evaluate_homomorphically(a in polynomial(any_int(), 8, 4, 5), b in polynomial(any_int(), 8, 4, 5), x in [0, 1, 2, 3].map(|_| small())) {
        let value = |p: &Poly| p.evaluate(&x);
        prop_assert_eq!(value(&a.mul(&b)), value(&a).mul(&value(&b)));
        prop_assert_eq!(value(&a.add(&b)), value(&a).add(&value(&b)));
        let by_parts = (0..4).fold(a.clone(), |p, i| p.substitute(i, &Poly::constant(x[i].clone())));
        prop_assert_eq!(by_parts.to_constant(), Some(value(&a)));
        prop_assert_eq!(a.evaluate(&x[..2]), a.evaluate(&[x[0].clone(), x[1].clone(), Int::zero(), Int::zero()]));
    }

    #[test]
    fn substitute_homomorphically(a in polynomial(small(), 6, 3, 3), b in polynomial(small(), 6, 3, 3), r in polynomial(small(), 3, 4, 2)) {
        prop_assert_eq!(a.mul(&b).substitute(1, &r), a.substitute(1, &r).mul(&b.substitute(1, &r)));
        prop_assert_eq!(a.substitute(2, &Poly::variable(2)), a.clone());
        prop_assert_eq!(a.substitute(5, &r), a.clone());
        // At once, so that exchanged variables do not run into each other; twice is the identity.
        let exchange = [(0, Poly::variable(1)), (1, Poly::variable(0))];
        let exchanged = a.substitute_all(&exchange);
        prop_assert_eq!(exchanged.substitute_all(&exchange), a.clone());
        prop_assert_eq!(exchanged.degree(0), a.degree(1));
        prop_assert_eq!(a.substitute_all(&[(0, r.clone()), (2, b.clone())]), a.substitute(0, &Poly::variable(7)).substitute(2, &b).substitute(7, &r));
    }

    #[test]
    fn have_coefficients_in_each_variable(a in polynomial(any_int(), 12, 4, 5), variable in 0_usize..6) {
        let parts = a.coefficients_in(variable);
        prop_assert_eq!(parts.len(), if a.is_zero() { 0 } else { a.degree(variable) as usize + 1 });
        for part in &parts {
            is_normal(part)?;
            prop_assert_eq!(part.degree(variable), 0);
        }
        prop_assert_eq!(&Poly::from_coefficients_in(variable, &parts), &a);
        let shifted: Vec<Poly> = parts.iter().map(|part| part.mul(&Poly::variable(variable))).collect();
        prop_assert_eq!(Poly::from_coefficients_in(variable, &shifted), a.mul(&Poly::variable(variable)));
    }

    #[test]
    fn differentiate_by_the_product_rule(a in polynomial(any_int(), 8, 3, 5), b in polynomial(any_int(), 8, 3, 5), v in 0_usize..4) {
        let rule = a.derivative(v).mul(&b).add(&a.mul(&b.derivative(v)));
        prop_assert_eq!(a.mul(&b).derivative(v), rule);
    }

    #[test]
    fn convert_to_and_from_one_variable(coefficients in prop::collection::vec(any_int(), 0..8), variable in 0_usize..9) {
        let univariate = Univariate::new(coefficients);
        let polynomial = Poly::from_univariate(variable, &univariate);
        is_normal(&polynomial)?;
        prop_assert_eq!(polynomial.to_univariate(variable), Some(univariate.clone()));
        prop_assert!(polynomial.to_univariate(variable + 1).is_none() || univariate.degree().unwrap_or(0) == 0);
    }

    #[test]
    fn multiply_in_many_variables(a in polynomial(small(), 40, 40, 2), b in polynomial(small(), 40, 33, 300), c in polynomial(any_int(), 50, 7, 90)) {
        for (left, right) in [(&a, &b), (&b, &c), (&a, &c), (&b, &b)] {
            let product = left.mul(right);
            prop_assert_eq!(&product, &schoolbook(left, right));
            prop_assert!(product.len() as u64 <= left.product_size(right).terms);
            if !left.is_zero() && !right.is_zero() {
                prop_assert_eq!(u64::from(product.degrees().into_iter().max().unwrap_or(0)), left.product_size(right).largest_exponent);
                prop_assert_eq!(&product.div_exact(right), left);
            }
        }
    }

    #[test]
    fn are_raised_to_powers(a in polynomial(any_int(), 6, 3, 4), e in 0_u32..7) {
        let power = a.pow(e);
        prop_assert_eq!(&power, &(0..e).fold(Poly::one(), |p, _| p.mul(&a)));
        prop_assert!(power.len() as u64 <= a.power_size(e).terms);
        prop_assert_eq!(u64::from(power.degree(1)), u64::from(a.degree(1)) * u64::from(e));
    }

    #[test]
    fn divide_exactly_or_not_at_all(a in polynomial(any_int(), 12, 4, 6), b in polynomial(any_int(), 6, 4, 6), r in polynomial(small(), 2, 4, 5)) {
        prop_assert_eq!(a.checked_div_exact(&Poly::zero()), None);
        if !b.is_zero() {
            let product = a.mul(&b);
            prop_assert_eq!(product.checked_div_exact(&b), Some(a.clone()));
            let disturbed = product.add(&r);
            if let Some(quotient) = disturbed.checked_div_exact(&b) {
                prop_assert_eq!(quotient.mul(&b), disturbed);
            } else {
                prop_assert_ne!(r.checked_div_exact(&b).map(|q| q.mul(&b)), Some(r));
            }
            let modulo = |p: &Poly| p.map(|c| ModP::<PRIME_61>::from_rational(&Rational::from(c.to_integer()))).unwrap();
            prop_assert_eq!(modulo(&product).checked_div_exact(&modulo(&b)), modulo(&b).coefficients().first().map(|_| modulo(&a)));
        }
    }

    #[test]
    fn fall_into_content_and_primitive_part(a in polynomial(rational(), 6, 3, 4), n in any_int()) {
        let (primitive, factor) = a.primitive();
        let rational = |c: &Int| Some(Rational::from(c.to_integer()));
        prop_assert_eq!(primitive.map(rational).unwrap().scale(&factor), a.clone());
        if !a.is_zero() {
            prop_assert_eq!(primitive.content(), Int::one());
            prop_assert_eq!(primitive.coefficients()[0].sign(), Ordering::Greater);
        }
        if !n.is_zero() {
            let scaled = primitive.scale(&n);
            prop_assert_eq!(scaled.content(), if a.is_zero() { Int::zero() } else { n.abs() });
            prop_assert_eq!(scaled.primitive_part(), primitive);
        }
    }

    #[test]
    fn have_greatest_common_divisors(f in nonzero(4, 3, 3), g in nonzero(4, 3, 3), h in nonzero(4, 3, 3), n in any_int(), m in any_int()) {
        let (n, m) = (n.add(&Int::one()), m.add(&Int::one()));
        prop_assume!(!n.is_zero() && !m.is_zero());
        let (a, b) = (f.mul(&h).scale(&n), g.mul(&h).scale(&m));
        let gcd = a.gcd(&b);
        is_normal(&gcd)?;
        prop_assert!(gcd.checked_div_exact(&h).is_some(), "{:?} is not divisible by {:?}", gcd, h);
        let (a, b) = (a.div_exact(&gcd), b.div_exact(&gcd));
        prop_assert_eq!(a.gcd(&b), Poly::one());
        prop_assert_eq!(b.gcd(&a), Poly::one());
        prop_assert_eq!(gcd.coefficients()[0].sign(), Ordering::Greater);
        prop_assert_eq!(gcd.gcd(&Poly::zero()), gcd.clone());
        // Over the rationals the numbers do not matter.
        let rational = |p: &Poly| p.map(|c| Some(Rational::from((c.to_integer(), 6)))).unwrap();
        prop_assert_eq!(rational(&f.mul(&h)).gcd(&rational(&g.mul(&h))), gcd.primitive_part());
    }

    #[test]
    fn fall_into_square_free_factors(f in nonzero(3, 3, 2), g in nonzero(3, 2, 2), x in 0_usize..3, n in 1_i64..9) {
        let product = f.mul(&g.pow(3)).mul(&Poly::variable(x).pow(2)).scale(&Int::from(-n));
        let factors = product.square_free_decomposition();
        prop_assert!(factors.is_sorted_by(|a, b| a.1 < b.1));
        let rebuilt = factors.iter().fold(Poly::one(), |p, (factor, k)| p.mul(&factor.pow(u32::try_from(*k).unwrap())));
        prop_assert_eq!(rebuilt, product.primitive_part());
        let part = product.square_free_part();
        prop_assert!(part.checked_div_exact(&Poly::variable(x)).is_some());
        for variable in 0..3 {
            prop_assert_eq!(part.gcd(&part.derivative(variable)).degree(variable), 0);
        }
        for (i, (factor, _)) in factors.iter().enumerate() {
            for (other, _) in &factors[..i] {
                prop_assert_eq!(factor.gcd(other), Poly::one());
            }
        }
    }

    #[test]
    fn integers_agree_with_big_ones(a in integer(), b in integer(), c in integer()) {
        let [x, y, z] = [&a, &b, &c].map(|n| Int::from(n.clone()));
        prop_assert_eq!(x.add(&y).to_integer(), Integer::from(&a + &b));
        prop_assert_eq!(x.sub(&y).to_integer(), Integer::from(&a - &b));
        prop_assert_eq!(x.mul(&y).to_integer(), Integer::from(&a * &b));
        prop_assert_eq!(x.neg().to_integer(), Integer::from(-&a));
        prop_assert_eq!(x.abs().to_integer(), a.clone().abs());
        prop_assert_eq!(x.gcd(&y).to_integer(), Integer::from(a.gcd_ref(&b)));
        prop_assert_eq!(x.cmp(&y), a.cmp(&b));
        prop_assert_eq!(x.sign(), a.cmp0());
        prop_assert_eq!(x == y, a == b);
        prop_assert_eq!(x.to_string(), a.to_string());
        prop_assert_eq!(x.checked_div_exact(&y).map(|q| q.to_integer()), a.checked_div_exact(&b));
        let mut sum = z.clone();
        sum.add_product(&x, &y);
        prop_assert_eq!(&sum, &z.add(&x.mul(&y)));
        prop_assert_eq!(sum.to_i64(), sum.to_integer().to_i64());
        // Back to where it came from, and small again if it was.
        sum.add_product(&x.neg(), &y);
        prop_assert_eq!(&sum, &z);
        prop_assert!((x.to_f64() - a.to_f64()).abs() <= a.to_f64().abs() * f64::EPSILON);
    }

    #[test]
    fn packing_keeps_exponents(exponents in prop::collection::vec(0..=LARGEST_EXPONENT, 1..40), bits in 0_u32..30) {
        let exponents: Vec<u32> = exponents.into_iter().map(|e| e >> bits).collect();
        let packing = Packing::new(exponents.len(), *exponents.iter().max().unwrap());
        let mut packed = Vec::new();
        packing.push(&exponents, &mut packed);
        prop_assert_eq!(packing.unpack(&packed), exponents.clone());
        prop_assert!(packed.iter().all(|word| word & packing.guards() == 0));
        let monomial = Poly::from_terms([(exponents.clone(), Int::one())]);
        let half: Vec<u32> = exponents.iter().map(|e| e / 2).collect();
        let quotient = monomial.div_exact(&Poly::from_terms([(half.clone(), Int::one())]));
        let rest: Vec<u32> = exponents.iter().zip(&half).map(|(e, h)| e - h).collect();
        prop_assert_eq!(quotient, Poly::from_terms([(rest, Int::one())]));
    }
}

/// `(1 + x + ...)^n` for the given number of variables.
fn power_of_sum(variables: usize, n: u32) -> Poly {
    (0..variables).fold(Poly::one(), |sum, v| sum.add(&Poly::variable(v))).pow(n)
}

#[test]
fn dense_products_are_powers() {
    for (variables, n) in [(1, 90), (2, 12), (3, 7), (4, 5), (6, 3)] {
        assert_eq!(power_of_sum(variables, n).mul(&power_of_sum(variables, n + 1)), power_of_sum(variables, 2 * n + 1));
        assert_eq!(power_of_sum(variables, 2 * n).div_exact(&power_of_sum(variables, n)), power_of_sum(variables, n));
    }
    // (1 + x + y)^40 at (1, 1) and its middle coefficient, a multinomial of more than a word.
    let power = power_of_sum(2, 40);
    assert_eq!(power.evaluate(&[Int::one(), Int::one()]).to_integer(), Integer::from(Integer::u_pow_u(3, 40)));
    let middle = power.terms().find(|(exponents, _)| exponents == &[13, 13]).unwrap().1.to_integer();
    assert_eq!(
        middle,
        Integer::factorial(40).complete()
            / (Integer::factorial(13).complete().pow(2) * Integer::factorial(14).complete())
    );
}

#[test]
fn sums_in_machine_words_are_bounded_beforehand() {
    // Products of 2^62, 2^63, 2^126 and beyond, many at a time: each accumulator at its limit.
    for bits in [30, 31, 32, 61, 62, 63] {
        let large = Int::from((Integer::from(1) << bits) - 1);
        let f = power_of_sum(2, 9).map(|_| Some(large.clone())).unwrap();
        let g = f.sub(&Poly::variable(0).scale(&Int::from(3)));
        assert_eq!(f.mul(&g), schoolbook(&f, &g), "{bits}");
        assert_eq!(f.mul(&g).div_exact(&g), f, "{bits}");
        assert_eq!(f.mul(&g.neg()), schoolbook(&f, &g.neg()), "{bits}");
    }
}

#[test]
fn exponents_at_the_limit() {
    let x = Poly::variable(0);
    let top = Poly::from_terms([(vec![LARGEST_EXPONENT], Int::one())]);
    assert_eq!(x.pow(LARGEST_EXPONENT), top);
    assert_eq!(top.div_exact(&x).mul(&x), top);
    assert_eq!(top.product_size(&x).largest_exponent, u64::from(LARGEST_EXPONENT) + 1);
    assert_eq!(x.power_size(LARGEST_EXPONENT + 1).largest_exponent, u64::from(LARGEST_EXPONENT) + 1);
    assert!(std::panic::catch_unwind(|| top.mul(&x)).is_err());
    assert!(std::panic::catch_unwind(|| x.pow(LARGEST_EXPONENT + 1)).is_err());
    // Widely scattered exponents: no box has room for them.
    let scattered = |seed: u32| {
        let exponent = |k: u32, i: u32| (k * 7919 + i * 104_729 + seed).wrapping_mul(2_654_435_761) >> 3;
        Poly::from_terms((0..60).map(|k| ((0..3).map(|i| exponent(k, i)).collect(), Int::from(i64::from(k) - 30))))
    };
    let (f, g) = (scattered(1), scattered(5));
    assert_eq!(f.mul(&g), schoolbook(&f, &g));
    assert_eq!(f.mul(&g).div_exact(&f), g);
}

#[test]
fn divisors_with_contents_in_every_variable() {
    let [x, y, z] = [0, 1, 2].map(Poly::variable);
    let (one, two) = (Poly::one(), Poly::from_integer(2));
    let h = x.mul(&y).sub(&z.pow(3)).add(&two);
    let f = y.mul(&y.add(&one)).mul(&z.sub(&one)).mul(&h);
    let g = y.pow(2).mul(&z.pow(2).sub(&one)).mul(&x.add(&z)).mul(&h);
    assert_eq!(f.gcd(&g), y.mul(&z.sub(&one)).mul(&h));
    // A variable of one polynomial only, and constants.
    assert_eq!(h.mul(&Poly::variable(5).add(&x)).gcd(&h.mul(&y)), h);
    assert_eq!(two.gcd(&h.scale(&Int::from(4))), two);
    assert_eq!(Poly::zero().gcd(&Poly::zero()), Poly::zero());
    // Coefficients of more than one prime.
    let big = h.pow(3).add(&x.scale(&Int::from(i128::MAX)));
    assert_eq!(big.mul(&x.add(&z)).gcd(&big.mul(&y.add(&z))), big);
}

#[test]
fn a_golden_square_free_decomposition() {
    let [x, y] = [0, 1].map(Poly::variable);
    let circle = x.pow(2).add(&y.pow(2)).sub(&Poly::one());
    let product = circle.pow(2).mul(&x.sub(&y)).mul(&y.pow(2)).mul(&x.add(&y).pow(5)).scale(&Int::from(-14));
    assert_eq!(product.square_free_decomposition(), [(x.sub(&y), 1), (circle.mul(&y), 2), (x.add(&y), 5)]);
    assert_eq!(Poly::from_integer(-3).square_free_decomposition(), []);
    assert_eq!(Poly::from_integer(-3).square_free_part(), Poly::one());
}
