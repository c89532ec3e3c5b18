//! Laws of real roots: their number is Sturm's count, each is alone in its interval and rounded correctly, however they lie.

use crate::strategies::{integers, nonzero_polynomial, rational};
use looproot_algebra::{
    real_roots::RealRoot,
    ring::Ring,
    sturm::{Place, SturmChain},
    univariate::Univariate,
};
use proptest::prelude::*;
use rug::{Float, Integer, Rational, ops::Pow};
use std::cmp::Ordering;

type Poly = Univariate<Rational>;

fn power(p: &Poly, exponent: usize) -> Poly {
    (0..exponent).fold(Poly::one(), |product, _| product.mul(p))
}

fn product(factors: &[Poly]) -> Poly {
    factors.iter().fold(Poly::one(), |product, p| product.mul(p))
}

/// `x - root`
fn linear(root: &Rational) -> Poly {
    Poly::new(vec![root.neg(), Rational::from(1)])
}

/// `2^exponent`
fn two(exponent: i32) -> Rational {
    Rational::from(2).pow(exponent)
}

/// `T_n`, all of whose n roots are real: `cos((2k - 1) pi/(2n))`.
fn chebyshev(n: usize) -> Poly {
    let (mut before, mut current) = (Poly::one(), Poly::x());
    for _ in 1..n {
        (before, current) = (current.clone(), integers(&[0, 2]).mul(&current).sub(&before));
    }
    current
}

/// `x^n - 2 (a x - 1)^2`, which has two roots extremely close to `1/a`.
fn mignotte(n: usize, a: &Rational) -> Poly {
    power(&Poly::x(), n).sub(&power(&Poly::new(vec![Rational::from(-1), a.clone()]), 2).scale(&Rational::from(2)))
}

/// A polynomial with pseudo-random coefficients of that many digits of base 2^31, the same in every run.
fn pseudo_random(degree: usize, digits: usize, seed: u64) -> Poly {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        i64::try_from(state >> 32).unwrap() - (1 << 31)
    };
    let coefficient = |_| (0..digits).fold(Integer::new(), |n, _| (n << 31_u32) + next()).into();
    Poly::new((0..=degree).map(coefficient).collect())
}

/// Everything that isolation promises, checked by Sturm's theorem; the roots.
fn checked(p: &Poly) -> Vec<RealRoot> {
    let roots = p.real_roots();
    let chain = SturmChain::new(p);
    assert_eq!(roots.len(), chain.count());
    assert!(roots.windows(2).all(|pair| pair[0].bounds().1 < pair[1].bounds().0), "disjoint and sorted");
    for root in &roots {
        assert_alone(&chain, root);
    }
    for (factor, multiplicity) in p.square_free_decomposition() {
        let here = roots.iter().filter(|root| root.multiplicity() == multiplicity).count();
        assert_eq!(here, factor.distinct_real_roots());
    }
    roots
}

fn assert_alone(chain: &SturmChain, root: &RealRoot) {
    let (lo, hi) = root.bounds();
    if lo == hi {
        assert_eq!(root.exact().as_ref(), Some(&lo));
        let radius = two(-2000);
        let around = (Rational::from(&lo - &radius), lo.clone());
        assert_eq!(chain.count_between(Place::At(&around.0), Place::At(&around.1)), 1, "{lo} is a root");
    } else {
        assert_eq!(chain.count_between(Place::At(&lo), Place::At(&hi)), 1, "one root in {lo} .. {hi}");
    }
}

/// Whether `x` is the root to the nearest f64, given the root to many more bits than an f64 has.
fn assert_rounded(root: &mut RealRoot, near: &Float) {
    let value = root.to_f64();
    assert_eq!(value, Float::with_val(53, near).to_f64(), "{near}");
    let (lo, hi) = root.enclosure();
    assert!(lo <= *near && *near <= hi && (lo == hi || hi == lo.next_up()), "{lo} {near} {hi}");
}

/// The root to 2^-400 relative to 1.
fn to_many_bits(root: &RealRoot) -> Float {
    let mut root = root.clone();
    root.refine(&two(-1300));
    Float::with_val(1500, &root.bounds().0)
}

proptest! {
    #[test]
    fn are_as_many_as_sturm_counts(f in nonzero_polynomial(7), g in nonzero_polynomial(2)) {
        for root in &mut checked(&f.mul(&g).mul(&g)) {
            let near = to_many_bits(root);
            assert_rounded(root, &near);
        }
    }

    #[test]
    fn are_those_put_in(
        planted in prop::collection::btree_map(rational(), 1_usize..4, 0..5),
        squares in prop::collection::btree_map(2_i32..40, 1_usize..3, 0..3),
        scale in -600_i32..600,
    ) {
        let scale = two(scale);
        let scaled = |n: i32| Rational::from(n) * &scale;
        let mut expected = Vec::new();
        let mut factors = vec![integers(&[1, 1, 1])];
        for (root, multiplicity) in planted {
            let root = root * &scale;
            factors.push(power(&linear(&root), multiplicity));
            expected.push((Float::with_val(2000, &root), multiplicity));
        }
        for (n, multiplicity) in squares {
            // x^2 = n scale^2; rational roots are those of another planting.
            if f64::from(n).sqrt().fract() != 0.0 {
                factors.push(power(&Poly::new(vec![-scaled(n) * &scale, Rational::new(), Rational::from(1)]), multiplicity));
                let root = Float::with_val(2000, n).sqrt() * &scale;
                expected.push((Float::with_val(2000, -&root), multiplicity));
                expected.push((root, multiplicity));
            }
        }
        expected.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap());
        let mut roots = checked(&product(&factors));
        prop_assert_eq!(roots.len(), expected.len());
        for (root, (near, multiplicity)) in roots.iter_mut().zip(&expected) {
            prop_assert_eq!(root.multiplicity(), *multiplicity);
            assert_rounded(root, near);
        }
    }

    #[test]
    fn stay_where_they_are_when_refined(f in nonzero_polynomial(6), bits in 1_i32..300) {
        let chain = SturmChain::new(&f);
        for mut root in f.real_roots() {
            let (lo, hi) = root.bounds();
            root.refine(&two(-bits));
            assert_alone(&chain, &root);
            let (finer_lo, finer_hi) = root.bounds();
            prop_assert!(lo <= finer_lo && finer_hi <= hi && finer_hi.clone() - &finer_lo <= two(-bits));
            prop_assert_ne!(root.compare(&finer_lo), Ordering::Less);
            prop_assert_ne!(root.compare(&finer_hi), Ordering::Greater);
        }
    }

    #[test]
    fn compare_with_numbers(f in nonzero_polynomial(4), x in rational()) {
        let left_of = SturmChain::new(&f).count_between(Place::MinusInfinity, Place::At(&x));
        let roots = f.real_roots();
        prop_assert_eq!(roots.iter().filter(|root| root.compare(&x).is_le()).count(), left_of);
        let is_root = f.eval(&x).is_zero();
        prop_assert_eq!(roots.iter().any(|root| root.compare(&x).is_eq()), is_root);
    }

    #[test]
    fn square_free_factors_agree_over_integers_and_rationals(
        f in nonzero_polynomial(3), g in nonzero_polynomial(3), h in nonzero_polynomial(2),
    ) {
        let p = f.mul(&power(&g, 2)).mul(&power(&h, 3));
        let over_integers = |p: &Poly| Univariate::new(p.primitive_integers());
        let over_rationals = |p: &Univariate<Integer>| p.map(|c| Some(Rational::from(c))).unwrap();
        let integer = over_integers(&p);
        let factors: Vec<(Poly, usize)> =
            integer.square_free_decomposition().iter().map(|(p, m)| (over_rationals(p), *m)).collect();
        prop_assert_eq!(factors, p.square_free_decomposition());
        prop_assert_eq!(over_rationals(&integer.square_free_part()), p.square_free_part());
        let gcd = over_integers(&f.mul(&h)).gcd(&over_integers(&g.mul(&h)));
        prop_assert_eq!(over_rationals(&gcd), f.mul(&h).gcd(&g.mul(&h)));
    }
}

#[test]
fn common_divisors_include_contents() {
    let poly = |c: &[i32]| Univariate::new(c.iter().map(|&c| Integer::from(c)).collect());
    // 6 (x + 1)(x - 2) and 4 (x + 1)(2 x + 3)
    assert_eq!(poly(&[-12, -6, 6]).gcd(&poly(&[12, 20, 8])), poly(&[2, 2]));
    assert_eq!(poly(&[0, -6]).gcd(&poly(&[])), poly(&[0, 6]));
    assert_eq!(poly(&[]).gcd(&poly(&[])), poly(&[]));
    assert_eq!(poly(&[-6]).gcd(&poly(&[4])), poly(&[2]));
    assert_eq!(poly(&[1, 3, 2]).quotient(&poly(&[1, 2])), Some(poly(&[1, 1])));
    assert_eq!(poly(&[1, 1, 1]).quotient(&poly(&[1, 1])), None);
    assert_eq!(poly(&[1, 1]).quotient(&poly(&[2])), None);
    assert_eq!(poly(&[-4, 0, -2]).primitive_part(), poly(&[2, 0, 1]));
}

#[test]
fn a_prime_that_divides_a_discriminant_misleads_nobody() {
    // Modulo the first prime x^2 - p and (x^2 + 1)(x^2 - p x + 1) have multiple factors.
    for p in [4_611_686_018_427_387_847_u64, (1 << 61) - 1] {
        let p = Rational::from(p);
        let f = Poly::new(vec![p.neg(), Rational::new(), Rational::from(1)]);
        assert_eq!(checked(&f).len(), 2);
        let g = Poly::new(vec![Rational::from(1), p.neg(), Rational::from(1)]).mul(&integers(&[1, 0, 1]));
        let integer = Univariate::new(g.primitive_integers());
        assert_eq!(integer.square_free_decomposition(), [(integer.clone(), 1)]);
        // The leading coefficient vanishes modulo the prime.
        assert_eq!(checked(&f.mul(&Poly::new(vec![Rational::from(1), p]))).len(), 3);
    }
}

#[test]
fn of_constants_there_are_none() {
    assert!(integers(&[-3]).real_roots().is_empty());
    assert!(checked(&integers(&[1, 0, 1])).is_empty());
    assert!(checked(&integers(&[2, 0, 1, 0, 3, 0, 5])).is_empty());
}

#[test]
#[should_panic(expected = "every number is a root of zero")]
fn of_zero_all_numbers_are() {
    let _ = Poly::zero().real_roots();
}

#[test]
fn of_chebyshev_polynomials_are_cosines() {
    for n in [1_u32, 2, 7, 20, 33] {
        let mut roots = checked(&chebyshev(n as usize));
        assert_eq!(roots.len(), n as usize);
        for (root, k) in roots.iter_mut().zip((1..=n).rev()) {
            let angle = Float::with_val(300, rug::float::Constant::Pi) * (2 * k - 1) / (2 * n);
            if 2 * k - 1 == n {
                assert_eq!(root.exact(), Some(Rational::new()));
            } else {
                assert_rounded(root, &angle.cos());
            }
        }
    }
}

#[test]
fn of_wilkinson_polynomials_are_integers() {
    for (from, to) in [(1, 20), (-15, 15), (0, 12)] {
        let mut roots = checked(&product(&(from..=to).map(|n| linear(&Rational::from(n))).collect::<Vec<_>>()));
        let values: Vec<f64> = roots.iter_mut().map(RealRoot::to_f64).collect();
        assert_eq!(values, (from..=to).map(f64::from).collect::<Vec<_>>());
        assert!(roots.iter_mut().all(|root| root.enclosure().0 == root.enclosure().1));
    }
}

#[test]
fn on_the_corners_of_cells_are_met_exactly() {
    let corners = [(-3, 1), (-1, 2), (0, 1), (1, 4), (1, 2), (3, 4), (1, 1), (2, 1), (4, 1), (1025, 1024)];
    let corners = corners.map(Rational::from);
    let p = product(&corners.iter().map(linear).collect::<Vec<_>>()).mul(&integers(&[-2, 0, 1]));
    let mut roots = checked(&p.mul(&power(&Poly::x(), 4)));
    assert_eq!(roots.len(), 12);
    assert_eq!(roots[3].multiplicity(), 5);
    for expected in &corners {
        assert!(roots.iter().any(|root| root.compare(expected).is_eq()), "{expected}");
    }
    let enclosures = roots.iter_mut().map(RealRoot::enclosure);
    assert_eq!(enclosures.filter(|(lo, hi)| lo < hi).count(), 2, "the irrational ones");
}

#[test]
fn in_clusters_are_told_apart() {
    for (n, bits, count) in [(5, 10, 3), (8, 14, 4), (21, 3, 3), (30, 20, 4)] {
        let a = two(bits);
        let mut roots = checked(&mignotte(n, &a));
        assert_eq!(roots.len(), count);
        let middle = count - 3;
        let pair: Vec<f64> = roots[middle..middle + 2].iter_mut().map(RealRoot::to_f64).collect();
        assert!(pair.iter().all(|x| (x - 0.5_f64.powi(bits)).abs() < 1e-3));
        // Off the corners of the cells, and off the real line.
        let odd = a + Rational::from((1, 3));
        assert_eq!(checked(&mignotte(n, &odd)).len(), count);
        assert_eq!(mignotte(n, &odd).add(&power(&Poly::x(), n).scale(&Rational::from(-2))).real_roots().len(), n % 2);
    }
    // Four roots within 1e-60, next to one at 1.
    let tiny = two(-200);
    let centre = Rational::from((1, 3));
    let cluster = product(&(0..4).map(|k| linear(&(centre.clone() + Rational::from(k) * &tiny))).collect::<Vec<_>>());
    let mut roots = checked(&cluster.mul(&linear(&Rational::from(1))).mul(&integers(&[3, 1, 1])));
    assert_eq!(roots.len(), 5);
    assert!(roots[..4].iter_mut().all(|root| root.to_f64() == 1.0 / 3.0));
}

#[test]
fn of_all_sizes_are_found_together() {
    let ten = |exponent: i32| Rational::from(10).pow(exponent);
    let sizes: Vec<Rational> = [-400, -330, -320, -310, -300, -5, 0, 5, 300, 308, 310].map(ten).to_vec();
    let both: Vec<Rational> = sizes.iter().rev().map(Ring::neg).chain(sizes.iter().cloned()).collect();
    let mut roots = checked(&product(&both.iter().map(linear).collect::<Vec<_>>()));
    assert_eq!(roots.len(), both.len());
    let values: Vec<f64> = roots.iter_mut().map(RealRoot::to_f64).collect();
    // Subnormal, and beyond the range at both ends; decimal texts are rounded correctly too.
    let positive = [0.0, 0.0, 1e-320, 1e-310, 1e-300, 1e-5, 1.0, 1e5, 1e300, 1e308, f64::INFINITY];
    let negative: Vec<f64> = positive.iter().rev().map(|x| -x).collect();
    assert_eq!(values, [negative, positive.to_vec()].concat());
    assert_eq!(roots[21].enclosure(), (f64::MAX, f64::INFINITY));
    assert_eq!(roots[0].enclosure(), (f64::NEG_INFINITY, f64::MIN));
    assert_eq!(roots[11].enclosure(), (0.0, f64::from_bits(1)));
    assert_eq!(roots[10].enclosure(), (-f64::from_bits(1), 0.0));
}

#[test]
fn halfway_between_floats_round_to_even() {
    let ulp = two(-52);
    for k in 0..6 {
        let tie = Rational::from(1) + (Rational::from(k) + Rational::from((1, 2))) * &ulp;
        let off = two(-150) / 3_u32;
        let shifts = [(Rational::new(), k + k % 2), (off.clone(), k + 1), (-off, k)];
        for (shift, expected) in shifts {
            let root = &tie + shift;
            let f = linear(&root).mul(&integers(&[-7, 0, 0, 1])).mul(&linear(&Rational::from((4, 3))));
            let mut roots = f.real_roots();
            assert_eq!(roots[0].to_f64(), 1.0 + f64::from(expected) * f64::EPSILON);
            let lower = 1.0 + f64::from(k) * f64::EPSILON;
            assert_eq!(roots[0].enclosure(), (lower, lower.next_up()));
        }
    }
}

#[test]
fn of_long_polynomials_agree_with_sturm() {
    for (degree, digits) in [(12, 1), (16, 10), (17, 40), (24, 3)] {
        let p = pseudo_random(degree, digits, 7 + degree as u64);
        let roots = checked(&p);
        let squared = p.mul(&p).real_roots();
        assert_eq!(roots.len(), squared.len());
        assert!(squared.iter().all(|root| root.multiplicity() == 2));
        // x -> x^2 keeps the positive roots and mirrors them.
        let mut spread = Vec::new();
        for c in p.coefficients() {
            spread.extend([c.clone(), Rational::new()]);
        }
        let positive = roots.iter().filter(|root| root.compare(&Rational::new()).is_gt()).count();
        assert_eq!(Poly::new(spread).real_roots().len(), 2 * positive);
    }
}

#[test]
fn of_high_degree_are_found() {
    // Beyond the degree up to which 256 bits hold a first expansion.
    let n = 150;
    let mut roots = Univariate::new(chebyshev(n).primitive_integers()).real_roots();
    assert_eq!(roots.len(), n);
    assert_eq!(roots[n - 1].to_f64(), (std::f64::consts::PI / 300.0).cos());
    let p = pseudo_random(200, 2, 3);
    assert_eq!(p.real_roots().len() % 2, 0);
}

/// Eight roots 1e-12 apart take 84 of the 115 digits of 384 bits; the others are right.
#[test]
fn a_crowd_of_simple_roots_is_told_apart() {
    use looproot::internal::solve::polynomial_roots::polynomial_roots;
    use looproot_algebra::long_float::LongFloat;
    let unit = 1_000_000_000_000_i64;
    let root = |k: i64| Rational::from((unit + k, unit));
    let number = |q: &Rational| LongFloat::from_rational(q).unwrap();
    let one = Univariate::constant(LongFloat::one());
    let polynomial =
        (0..8).fold(one, |product, k| product.mul(&Univariate::new(vec![number(&-root(k)), LongFloat::one()])));
    let roots = polynomial_roots(&polynomial).unwrap();
    assert_eq!(roots.len(), 8);
    for k in 0..8 {
        let wanted = number(&root(k));
        let off =
            |found: &num_complex::Complex<LongFloat>| found.re.sub(&wanted).to_f64().abs().max(found.im.to_f64().abs());
        assert!(roots.iter().any(|found| off(found) < 1e-22), "{k}");
    }
}
