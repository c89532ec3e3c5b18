//! Truncated power series.

use crate::strategies::{Sample, element, expression, rational};
use looproot_algebra::dual::Dual;
use looproot_algebra::modp::{ModP, PRIME_61};
use looproot_algebra::ring::Ring;
use looproot_algebra::series::Series;
use looproot_algebra::univariate::Univariate;
use proptest::prelude::*;
use rug::Rational;

type Cubic = Series<Rational, 4>;

fn series<R: Sample>() -> impl Strategy<Value = Series<R, 4>> {
    [element(), element(), element(), element()].prop_map(|coefficients| Series { coefficients })
}

/// Coefficients of a polynomial, missing ones 0.
fn of_polynomial(polynomial: &Univariate<Rational>) -> Cubic {
    let coefficient = |k: usize| polynomial.coefficients().get(k).cloned().unwrap_or_default();
    Series { coefficients: std::array::from_fn(coefficient) }
}

fn axioms<R: Ring, const N: usize>(a: &Series<R, N>, b: &Series<R, N>, c: &Series<R, N>) -> Result<(), TestCaseError> {
    prop_assert_eq!(a.mul(b).mul(c), a.mul(&b.mul(c)));
    prop_assert_eq!(a.mul(b), b.mul(a));
    prop_assert_eq!(a.mul(&b.add(c)), a.mul(b).add(&a.mul(c)));
    prop_assert_eq!(&a.mul(&Ring::one()), a);
    prop_assert_eq!(a.sub(b), a.add(&b.neg()));
    prop_assert!(a.sub(a).is_zero());
    prop_assert_eq!(a.is_zero(), *a == Ring::zero());
    Ok(())
}

proptest! {
    #[test]
    fn are_a_ring(a in series::<Rational>(), b in series::<Rational>(), c in series::<Rational>()) {
        axioms(&a, &b, &c)?;
    }

    #[test]
    fn are_a_ring_modulo_a_prime(
        a in series::<ModP<PRIME_61>>(), b in series::<ModP<PRIME_61>>(), c in series::<ModP<PRIME_61>>(),
    ) {
        axioms(&a, &b, &c)?;
    }

    /// Evaluating at `q + eps` expands the polynomial about q.
    #[test]
    fn expand_expressions(tree in expression(), q in rational()) {
        let [one, zero] = [Rational::from(1), Rational::new()];
        let value: Cubic =
            tree.evaluate(&Series { coefficients: [q.clone(), one.clone(), zero.clone(), zero] }).unwrap();
        let shifted: Univariate<Rational> = tree.evaluate(&Univariate::new(vec![q.clone(), one])).unwrap();
        prop_assert_eq!(&value, &of_polynomial(&shifted));
        let dual = tree.evaluate(&Dual::variable(q)).unwrap();
        prop_assert_eq!((&dual.value, &dual.epsilon), (&value.coefficients[0], &value.coefficients[1]));
    }

    /// `cos^2 + sin^2 = 1`, the angles add, and the first order is that of a dual angle: exactly, about any rational angle.
    #[test]
    fn of_angles_obey_trigonometry(a in series::<Rational>(), b in series::<Rational>(), s in rational(), t in rational()) {
        let of = |t: &Rational| -> (Rational, Rational) {
            let square = Rational::from(t * t);
            let length = Rational::from(&square + 1);
            ((1 - square) / &length, Rational::from(t * 2) / length)
        };
        let ((cos_s, sin_s), (cos_t, sin_t)) = (of(&s), of(&t));
        let (c, d) = a.cos_sin_beyond(cos_s.clone(), sin_s.clone()).unwrap();
        let (e, f) = b.cos_sin_beyond(cos_t.clone(), sin_t.clone()).unwrap();
        prop_assert_eq!(c.mul(&c).add(&d.mul(&d)), Cubic::one());
        let cos = cos_s.mul(&cos_t).sub(&sin_s.mul(&sin_t));
        let sin = sin_s.clone().mul(&cos_t).add(&cos_s.clone().mul(&sin_t));
        let sum = a.add(&b).cos_sin_beyond(cos, sin).unwrap();
        prop_assert_eq!(sum, (c.mul(&e).sub(&d.mul(&f)), d.mul(&e).add(&c.mul(&f))));
        let (cos, sin) = Dual::angle(cos_s, sin_s, &a.coefficients[1]);
        prop_assert_eq!((&cos.epsilon, &sin.epsilon), (&c.coefficients[1], &d.coefficients[1]));
    }
}

#[test]
fn an_angle_needs_small_numbers_to_have_inverses() {
    let angle = Series { coefficients: std::array::from_fn::<ModP<3>, 4, _>(|_| ModP::one()) };
    assert!(angle.cos_sin_beyond(ModP::one(), ModP::zero()).is_none());
}
