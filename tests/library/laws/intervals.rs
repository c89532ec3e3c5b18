//! Laws of intervals, checked against the directed rounding of MPFR and against exact rationals.

use super::holds;
use crate::strategies::{double, rational};
use looproot_algebra::{
    interval::Interval,
    number::{Angle, HalfTangent, Number, Reading, nearest_f64},
    ring::{Ring, exact_cos_sin},
};
use proptest::prelude::*;
use rug::{
    Float, Rational,
    float::{Constant, Round},
};

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
fn enclose_the_angles_and_numbers_of_a_file_and_not_their_stand_ins() {
    let third = Float::with_val(300, Rational::from((1, 3)));
    let pi = Float::with_val(300, Constant::Pi);
    let angles = [
        ("pi/3", pi.clone() / 3_u32),
        ("0.3", Float::with_val(300, Rational::from((3, 10)))),
        ("-2.5", Float::with_val(300, -2.5)),
        ("acos(1/3)", third.acos()),
        ("3.1415", Float::with_val(300, Rational::from((31415, 10000)))),
        ("1.5707963267948966", Float::with_val(300, Float::parse("1.5707963267948966").unwrap())),
        ("pi/2", pi.clone() / 2_u32),
        ("pi", pi),
    ];
    for (text, radians) in angles {
        let (cos, sin) = Interval::cos_sin(&Angle::parse(text, &Reading::default()).unwrap()).unwrap();
        for (interval, value) in [(cos, radians.clone().cos()), (sin, radians.sin())] {
            // The reference is itself an ulp of 300 bits off: pi/2 has cosine 1e-90 there, and exactly 0 in truth.
            assert!(interval.lo() - 1e-80 <= value && value <= interval.hi() + 1e-80, "{text}: {interval:?}");
            assert!(interval.radius() <= 2.0 * f64::EPSILON, "{text}: {interval:?}");
        }
    }
    let turned = Angle::from_half_tangent(HalfTangent::Finite(Rational::from((1, 3))));
    let (cos, sin) = Interval::cos_sin(&turned).unwrap();
    let (exact_cos, exact_sin) = exact_cos_sin(&turned);
    assert!(holds(&cos, &exact_cos) && holds(&sin, &exact_sin));

    let third = Rational::from((1, 3));
    assert!(holds(&Interval::from_number(&Number::exact(third.clone())).unwrap(), &third));
    assert_eq!(Interval::from_number(&Number::exact(Rational::from(3))), Some(Interval::from_f64(3.0)));
    let rounded = Interval::from_number(&Number::rounded(third.clone())).unwrap();
    assert!(rounded.lo() < nearest_f64(&third) && nearest_f64(&third) < rounded.hi());
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
