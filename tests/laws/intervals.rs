//! Laws of intervals, checked against the directed rounding of MPFR and against exact rationals.

use crate::holds;
use crate::strategies::{double, rational};
use looproot::algebra::{interval::Interval, ring::Ring};
use proptest::prelude::*;
use rug::{Float, Rational, float::Round};

fn is_rounded(interval: Interval, exact: impl Fn(Round) -> Float) -> Result<(), TestCaseError> {
    let (lo, hi) = (exact(Round::Down).to_f64_round(Round::Down), exact(Round::Up).to_f64_round(Round::Up));
    prop_assert!(interval.lo() <= lo && hi <= interval.hi(), "{:?} misses [{}, {}]", interval, lo, hi);
    // Away from overflow and underflow the bounds are the best there are.
    if (1e-250..1e250).contains(&lo.abs()) && (1e-250..1e250).contains(&hi.abs()) {
        prop_assert_eq!((interval.lo(), interval.hi()), (lo, hi));
    }
    Ok(())
}

fn point() -> impl Strategy<Value = (f64, f64)> {
    let tame = |x: &f64| *x == 0.0 || (1e-240..1e240).contains(&x.abs());
    (double().prop_filter("tame", tame), double().prop_filter("tame", tame))
}

fn interval() -> impl Strategy<Value = Interval> {
    (double(), double()).prop_map(|(x, y)| Interval::new(x.min(y), x.max(y)))
}

/// Numbers of an interval: its ends, and some between.
fn members(interval: &Interval) -> Vec<f64> {
    let (lo, hi) = (interval.lo(), interval.hi());
    let between = [0.25, 0.5, 0.9].map(|s| (lo * (1.0 - s) + hi * s).clamp(lo, hi));
    [lo, hi, interval.mid(), 0.0].into_iter().chain(between).filter(|&x| interval.contains(x)).collect()
}

proptest! {
    #[test]
    fn of_points_round_like_mpfr((x, y) in point()) {
        let (a, b) = (Interval::from_f64(x), Interval::from_f64(y));
        let float = |x: f64| Float::with_val(53, x);
        is_rounded(a.add(&b), |r| Float::with_val_round(53, &float(x) + &float(y), r).0)?;
        is_rounded(a.sub(&b), |r| Float::with_val_round(53, &float(x) - &float(y), r).0)?;
        is_rounded(a.mul(&b), |r| Float::with_val_round(53, &float(x) * &float(y), r).0)?;
        is_rounded(a.square(), |r| Float::with_val_round(53, float(x).square_ref(), r).0)?;
        prop_assert_eq!(a.inverse().is_none(), x == 0.0);
        prop_assert_eq!(a.sqrt().is_none(), x < 0.0);
    }

    #[test]
    fn enclose_rationals_tightly(q in rational()) {
        is_rounded(Interval::from_rational(&q).unwrap(), |r| Float::with_val_round(53, &q, r).0)?;
    }

    #[test]
    fn enclose_what_their_members_do(a in interval(), b in interval()) {
        let exact = |x: f64| Rational::from_f64(x).unwrap();
        prop_assert_eq!(a.add(&b), b.add(&a));
        prop_assert_eq!(a.mul(&b), b.mul(&a));
        for x in members(&a) {
            prop_assert!((exact(x) - exact(a.mid())).abs() <= exact(a.radius().min(f64::MAX)) || a.radius().is_infinite());
            prop_assert!(a.mignitude() <= x.abs() && x.abs() <= a.magnitude());
            prop_assert!(holds(&a.square(), &exact(x).square()));
            if let Some(inverse) = a.inverse() {
                prop_assert!(holds(&inverse, &exact(x).recip()));
            }
            if let Some(root) = a.sqrt() {
                prop_assert!(exact(root.lo()).square() <= exact(x) && exact(x) <= exact(root.hi()).square());
            }
            for y in members(&b) {
                prop_assert!(holds(&a.add(&b), &(exact(x) + exact(y))));
                prop_assert!(holds(&a.sub(&b), &(exact(x) - exact(y))));
                prop_assert!(holds(&a.mul(&b), &(exact(x) * exact(y))));
            }
            prop_assert!(a.hull(&b).contains(x));
            prop_assert_eq!(b.contains(x), a.intersection(&b).is_some_and(|common| common.contains(x)));
        }
    }
}

#[test]
fn unknown_numbers_stay_unknown() {
    let unknown = Interval::from_f64(f64::NAN);
    assert_eq!(unknown, Interval::ENTIRE);
    assert_eq!(unknown.add(&unknown), Interval::ENTIRE);
    assert_eq!(unknown.mul(&Interval::from_f64(-2.0)), Interval::ENTIRE);
    assert_eq!(unknown.mul(&Interval::zero()), Interval::zero());
    assert_eq!(Interval::new(1.0, f64::NAN), Interval::ENTIRE);
    let huge = Interval::from_f64(f64::MAX);
    assert_eq!(huge.add(&huge), Interval::new(f64::MAX, f64::INFINITY));
    assert_eq!(huge.mul(&huge.neg()), Interval::new(f64::NEG_INFINITY, f64::MIN));
    assert!(unknown.mid().is_finite());
}

#[test]
fn exact_results_stay_points() {
    let point = Interval::from_f64;
    assert_eq!(point(0.5).mul(&point(3.0)).add(&point(-1.5)), point(0.0));
    assert_eq!(point(9.0).sqrt(), Some(point(3.0)));
    assert_eq!(point(-0.25).inverse(), Some(point(-4.0)));
    assert!(Interval::new(0.25, 0.5).is_interior_to(&Interval::new(0.0, 1.0)));
    assert!(!Interval::new(0.25, 1.0).is_interior_to(&Interval::new(0.0, 1.0)));
}
