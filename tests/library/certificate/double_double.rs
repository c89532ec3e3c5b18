//! Numbers of two f64 against floats of 400 bits.

use looproot_algebra::double_double::DoubleDouble;
use looproot_algebra::ring::{Field, Ring};
use proptest::prelude::*;
use rug::{Float, Rational};

/// The value, exactly.
fn value(x: DoubleDouble) -> Rational {
    let high = x.to_f64();
    let low = x.sub(&DoubleDouble::from(high)).to_f64();
    Rational::from_f64(high).unwrap() + Rational::from_f64(low).unwrap()
}

fn pair(high: f64, low: f64) -> DoubleDouble {
    DoubleDouble::from(high).add(&DoubleDouble::from(low))
}

/// Whether `found` is `exact` to one unit roundoff.
fn is_right(found: DoubleDouble, exact: &Rational) -> bool {
    let error = (value(found) - exact).abs();
    error <= exact.clone().abs() * Rational::from_f64(DoubleDouble::UNIT_ROUNDOFF).unwrap()
}

/// Finite numbers from 1e-60 to 1e60, with tails of every size below the last digit.
fn number() -> impl Strategy<Value = DoubleDouble> {
    let mantissa = prop_oneof![4 => -2.0..2.0_f64, 1 => (-9_i32..10).prop_map(f64::from)];
    (mantissa, -200..200_i32, -1.0..1.0_f64, 0..60_i32).prop_map(|(mantissa, exponent, tail, below)| {
        let high = mantissa * 2.0_f64.powi(exponent);
        pair(high, high * tail * 2.0_f64.powi(-53 - below))
    })
}

proptest! {
    #[test]
    fn operations_are_right_to_the_unit_roundoff(x in number(), y in number()) {
        prop_assert!(is_right(x.add(&y), &(value(x) + value(y))));
        prop_assert!(is_right(x.sub(&y), &(value(x) - value(y))));
        prop_assert!(is_right(x.mul(&y), &(value(x) * value(y))));
        prop_assert_eq!(value(x.neg()), -value(x));
        if !y.is_zero() {
            prop_assert!(is_right(y.inverse().unwrap(), &value(y).recip()));
        }
    }

    #[test]
    fn cancellation_costs_nothing(x in number(), digits in 0..110_i32, y in -1.0..1.0_f64, z in -1.0..1.0_f64) {
        // A neighbour that shares a given number of digits, and has a tail of its own.
        let gap = x.to_f64() * y * 2.0_f64.powi(-digits);
        let neighbour = x.add(&pair(gap, gap * z * 2.0_f64.powi(-54)));
        prop_assert!(is_right(x.sub(&neighbour), &(value(x) - value(neighbour))));
        prop_assert!(is_right(neighbour.sub(&x), &(value(neighbour) - value(x))));
        prop_assert!(x.sub(&x).is_zero());
    }

    #[test]
    fn rationals_are_rounded_right(n in any::<i64>(), d in 1..i64::MAX) {
        let q = Rational::from((n, d));
        prop_assert!(is_right(DoubleDouble::from_rational(&q).unwrap(), &q));
    }
}

#[test]
fn it_is_indeed_twice_as_precise() {
    let third = DoubleDouble::from_rational(&Rational::from((1, 3))).unwrap();
    let error = Float::with_val(53, value(third) - Rational::from((1, 3))).to_f64().abs();
    assert!(error < 1e-32, "{error:e}");
    // An ordinary f64 would fail the test of the operations.
    assert!(!is_right(DoubleDouble::from(1.0 / 3.0), &Rational::from((1, 3))));
}
