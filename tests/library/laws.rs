//! Laws: every coefficient type is an image of the rationals, and whatever is built on them keeps the algebra.
#![allow(clippy::unwrap_used)]

use crate::strategies;

mod determinants;
mod intervals;
mod matrices;
mod motions;
mod multivariate;
mod polynomials;
mod resultants;
mod roots;
mod screw_system;
mod series;
mod texts;
mod trigonometry;
mod velocities;

use looproot_algebra::{
    dual::Dual,
    interval::Interval,
    modp::{ModP, PRIME_61, PRIME_62},
    number::nearest_f64,
    ring::{Domain, Field, Ring},
    univariate::Univariate,
};
use num_bigint::BigInt;
use num_complex::Complex;
use num_rational::Ratio;
use proptest::prelude::*;
use rug::{Integer, Rational};
use strategies::{Sample, element, expression, rational};

type Poly = Univariate<Rational>;

/// Whether the interval holds the rational, compared exactly.
fn holds(interval: &Interval, q: &Rational) -> bool {
    (interval.lo() == f64::NEG_INFINITY || Rational::from_f64(interval.lo()).is_some_and(|lo| lo <= *q))
        && (interval.hi() == f64::INFINITY || Rational::from_f64(interval.hi()).is_some_and(|hi| *q <= hi))
}

mod images {
    use super::*;

    /// Evaluating and mapping in either order gives the same element of R.
    fn commutes<R: Ring>(tree: &strategies::Expression, q: &Rational) -> Result<(), TestCaseError> {
        let value = tree.evaluate(q).expect("every rational is its own image");
        let image = R::from_rational(q).expect("the primes are large");
        prop_assert_eq!(tree.evaluate(&image), R::from_rational(&value));
        Ok(())
    }

    proptest! {
        #[test]
        fn of_expressions_are_exact_in_exact_rings(tree in expression(), q in rational()) {
            commutes::<Ratio<BigInt>>(&tree, &q)?;
            commutes::<ModP<PRIME_61>>(&tree, &q)?;
            commutes::<ModP<PRIME_62>>(&tree, &q)?;
            commutes::<Complex<Rational>>(&tree, &q)?;
            commutes::<Complex<ModP<PRIME_61>>>(&tree, &q)?;
            commutes::<Dual<Rational>>(&tree, &q)?;
            commutes::<Poly>(&tree, &q)?;
        }

        #[test]
        fn of_expressions_are_enclosed_by_intervals(tree in expression(), q in rational()) {
            let value = tree.evaluate(&q).unwrap();
            let interval = tree.evaluate(&Interval::from_rational(&q).unwrap()).unwrap();
            let float = tree.evaluate(&nearest_f64(&q)).unwrap();
            prop_assert!(holds(&interval, &value), "{:?} misses {}", interval, value);
            // Rounding to nearest is monotone, so f64 never leaves the interval, and the interval is narrow.
            prop_assert!(interval.contains(float));
            prop_assert!(interval.radius() <= 1e-13 * tree.majorant(nearest_f64(&q)));
        }

        #[test]
        fn of_complex_expressions_are_enclosed(tree in expression(), x in element::<Complex<Rational>>()) {
            let value = tree.evaluate(&x).unwrap();
            let interval = |q| Interval::from_rational(q).unwrap();
            let z = tree.evaluate(&Complex { re: interval(&x.re), im: interval(&x.im) }).unwrap();
            let float = tree.evaluate(&Complex { re: nearest_f64(&x.re), im: nearest_f64(&x.im) }).unwrap();
            prop_assert!(holds(&z.re, &value.re) && holds(&z.im, &value.im));
            prop_assert!(z.re.contains(float.re) && z.im.contains(float.im));
        }

        #[test]
        fn in_dual_numbers_are_derivatives(tree in expression(), q in rational()) {
            let polynomial: Poly = tree.evaluate(&Univariate::x()).unwrap();
            let dual = tree.evaluate(&Dual::variable(q.clone())).unwrap();
            prop_assert_eq!(dual.value, polynomial.eval(&q));
            prop_assert_eq!(dual.epsilon, polynomial.derivative().eval(&q));
        }
    }
}

mod axioms {
    use super::*;

    fn ring<R: Ring>(a: &R, b: &R, c: &R) -> Result<(), TestCaseError> {
        prop_assert_eq!(a.add(b).add(c), a.add(&b.add(c)));
        prop_assert_eq!(a.add(b), b.add(a));
        prop_assert_eq!(a.mul(b).mul(c), a.mul(&b.mul(c)));
        prop_assert_eq!(a.mul(b), b.mul(a));
        prop_assert_eq!(a.mul(&b.add(c)), a.mul(b).add(&a.mul(c)));
        prop_assert_eq!(&a.add(&R::zero()), a);
        prop_assert_eq!(&a.mul(&R::one()), a);
        prop_assert_eq!(a.sub(b), a.add(&b.neg()));
        prop_assert!(a.sub(a).is_zero() && R::zero().is_zero() && !R::one().is_zero());
        prop_assert_eq!(a.is_zero(), *a == R::zero());
        prop_assert_eq!(R::from_integer(6), R::from_integer(-2).mul(&R::from_integer(-3)));
        prop_assert_eq!(Some(R::from_integer(-7)), R::from_rational(&Rational::from(-7)));
        Ok(())
    }

    fn domain<R: Domain>(a: &R, b: &R, c: &R) -> Result<(), TestCaseError> {
        ring(a, b, c)?;
        prop_assert_eq!(a.mul(b).is_zero(), a.is_zero() || b.is_zero());
        if !b.is_zero() {
            prop_assert_eq!(&a.mul(b).div_exact(b), a);
        }
        Ok(())
    }

    fn field<R: Field + Domain>(a: &R, b: &R, c: &R) -> Result<(), TestCaseError> {
        domain(a, b, c)?;
        prop_assert_eq!(a.inverse().is_none(), a.is_zero());
        prop_assert_eq!(a.pivot_size() > R::PIVOT_ZERO, !a.is_zero());
        if let Some(inverse) = a.inverse() {
            prop_assert_eq!(a.mul(&inverse), R::one());
        }
        Ok(())
    }

    fn three<R: Sample>() -> impl Strategy<Value = (R, R, R)> {
        (element(), element(), element())
    }

    macro_rules! hold {
        ($($name:ident: $law:ident of $ring:ty;)*) => {
            proptest! {
                $(#[test]
                fn $name((a, b, c) in three::<$ring>()) {
                    $law(&a, &b, &c)?;
                })*
            }
        };
    }

    hold! {
        rationals: field of Rational;
        integers: domain of Integer;
        oracle: field of Ratio<BigInt>;
        modulo_mersenne: field of ModP<PRIME_61>;
        modulo_large: field of ModP<PRIME_62>;
        modulo_small: ring of ModP<1_000_003>;
        complex: field of Complex<Rational>;
        complex_modulo: field of Complex<ModP<PRIME_62>>;
        dual: ring of Dual<Rational>;
        dual_complex: ring of Dual<Complex<ModP<PRIME_61>>>;
        polynomials: domain of Poly;
        polynomials_modulo: domain of Univariate<ModP<PRIME_61>>;
        polynomials_in_two_variables: ring of Univariate<Poly>;
    }

    proptest! {
        #[test]
        fn dual_inverses(a in element::<Dual<Rational>>()) {
            prop_assert_eq!(a.inverse().is_none(), a.value.is_zero());
            if let Some(inverse) = a.inverse() {
                prop_assert_eq!(a.mul(&inverse), Dual::one());
            }
        }
    }
}
