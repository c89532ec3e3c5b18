//! Laws of univariate polynomials: division, common divisors, factors, interpolation, real roots.

use crate::strategies::{integers, nonzero_polynomial, polynomial, rational};
use looproot_algebra::{
    modp::{ModP, PRIME_61},
    ring::Ring,
    sturm::{Place, SturmChain},
    univariate::Univariate,
};
use proptest::prelude::*;
use rug::{Integer, Rational};

type Poly = Univariate<Rational>;

proptest! {
    #[test]
    fn divide_with_remainder(f in polynomial(6), g in nonzero_polynomial(4)) {
        let (quotient, remainder) = f.div_rem(&g);
        prop_assert_eq!(quotient.mul(&g).add(&remainder), f);
        prop_assert!(remainder.degree() < g.degree());
    }

    #[test]
    fn have_greatest_common_divisors(f in polynomial(4), g in polynomial(4), h in nonzero_polynomial(3)) {
        let gcd = f.mul(&h).gcd(&g.mul(&h));
        prop_assert_eq!(&gcd, &f.gcd(&g).mul(&h).normalise());
        if !gcd.is_zero() {
            prop_assert!(f.mul(&h).div_rem(&gcd).1.is_zero() && g.mul(&h).div_rem(&gcd).1.is_zero());
        }
        let modulo = |p: &Poly| p.map(ModP::<PRIME_61>::from_rational).unwrap();
        let (f, g, h) = (modulo(&f), modulo(&g), modulo(&h));
        prop_assert_eq!(f.mul(&h).gcd(&g.mul(&h)), f.gcd(&g).mul(&h).normalise());
    }

    #[test]
    fn fall_into_square_free_factors(f in nonzero_polynomial(3), g in nonzero_polynomial(3), h in nonzero_polynomial(2)) {
        let product = f.mul(&g.mul(&g)).mul(&h.mul(&h).mul(&h));
        let factors = product.square_free_decomposition();
        let mut rebuilt = Poly::one();
        let mut part = Poly::one();
        for (factor, multiplicity) in &factors {
            prop_assert_eq!(factor.gcd(&factor.derivative()).degree(), Some(0));
            part = part.mul(factor);
            rebuilt = (0..*multiplicity).fold(rebuilt, |p, _| p.mul(factor));
        }
        prop_assert!(factors.is_sorted_by_key(|(_, multiplicity)| *multiplicity));
        prop_assert_eq!(rebuilt.normalise(), product.clone().normalise());
        prop_assert_eq!(part.normalise(), product.square_free_part());
    }

    #[test]
    fn lose_factors_with_their_multiplicity(f in nonzero_polynomial(5), times in 0_usize..4) {
        let circle = integers(&[1, 0, 1]);
        let (already, _) = f.remove_factor(&circle);
        let product = (0..times).fold(f.clone(), |p, _| p.mul(&circle));
        let (multiplicity, cofactor) = product.remove_factor(&circle);
        prop_assert_eq!(multiplicity, times + already);
        prop_assert!(!cofactor.div_rem(&circle).1.is_zero());
    }

    #[test]
    fn are_interpolated(f in polynomial(6), start in rational()) {
        let points: Vec<(Rational, Rational)> =
            (0..8).map(|k| Rational::from(&start + k)).map(|x| (x.clone(), f.eval(&x))).collect();
        prop_assert_eq!(&Univariate::interpolate(&points), &f);
        let least = f.degree().map_or(0, |d| d + 1);
        prop_assert_eq!(Univariate::interpolate(&points[..least]), f);
    }

    #[test]
    fn have_primitive_integer_forms(f in nonzero_polynomial(6)) {
        let integers = f.primitive_integers();
        let content = integers.iter().fold(Integer::new(), Integer::gcd);
        prop_assert_eq!(content, 1);
        prop_assert!(integers[integers.len() - 1] > 0);
        let again = Poly::new(integers.into_iter().map(Rational::from).collect());
        prop_assert!(f.div_rem(&again).1.is_zero());
        prop_assert_eq!(f.degree(), again.degree());
    }

    #[test]
    fn have_the_real_roots_put_into_them(
        roots in prop::collection::vec((rational(), 1_usize..3), 0..5), pairs in 0_usize..3, sign in prop::bool::ANY,
    ) {
        let linear = |root: &Rational| Poly::new(vec![root.neg(), Rational::from(1)]);
        let start = integers(&[if sign { 3 } else { -3 }]);
        let real = roots.iter().fold(start, |p, (root, k)| (0..*k).fold(p, |p, _| p.mul(&linear(root))));
        let f = (0..pairs).fold(real, |p, k| p.mul(&integers(&[1, i32::from(k == 1), 1])));
        let mut distinct: Vec<Rational> = roots.into_iter().map(|(root, _)| root).collect();
        distinct.sort();
        distinct.dedup();
        prop_assert_eq!(f.distinct_real_roots(), distinct.len());
        let chain = SturmChain::new(&f);
        for (k, root) in distinct.iter().enumerate() {
            // Half-open: a root at the right end counts.
            prop_assert_eq!(chain.count_between(Place::MinusInfinity, Place::At(root)), k + 1);
            prop_assert_eq!(chain.count_between(Place::At(root), Place::PlusInfinity), distinct.len() - k - 1);
        }
    }
}
