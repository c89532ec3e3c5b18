//! Fields of the cosines and square roots of a file.
#![allow(clippy::unwrap_used)]

use looproot_algebra::number::{Angle, Number, Quantity, Reading};
use looproot_algebra::number_field::Algebraic;
use looproot_algebra::real_field::RealField;
use looproot_algebra::ring::Ring;
use looproot_algebra::surd::{Closed, Surd, phase_of_turn};
use rug::Rational;

/// The value of an element in floating point.
fn value(field: &RealField, x: &Algebraic) -> f64 {
    x.at(&field.conjugates()[0]).to_f64()
}

#[test]
fn cosines_and_roots_have_their_values() {
    let root = |n: i32| Closed::from(Surd::square_root(&Rational::from(n)).unwrap());
    for (turns, roots, degree) in [
        (vec![(1, 8)], vec![2], 2),
        (vec![(1, 24)], vec![2, 3, 6], 4),
        (vec![(1, 20)], vec![5, 7], 8),
        (vec![(1, 360)], vec![2, 3, 5, 15], 48),
        (vec![], vec![2, 3, 1_007, 6042], 8),
        (vec![(1, 5)], vec![13, 65], 8),
        (vec![(1, 28)], vec![7], 6),
    ] {
        let mut numbers: Vec<(Closed, f64)> = roots.iter().map(|n| (root(*n), f64::from(*n).sqrt())).collect();
        for (n, d) in turns {
            let (cos, sin) = phase_of_turn(&Rational::from((n, d)));
            let angle = std::f64::consts::TAU * f64::from(n) / f64::from(d);
            numbers.extend([(cos, angle.cos()), (sin, angle.sin())]);
        }
        let field = RealField::containing(numbers.iter().map(|(number, _)| number)).unwrap();
        assert_eq!(field.degree(), degree);
        for (number, expected) in &numbers {
            let found = value(&field, &field.element(number).unwrap());
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
    }
    let seventh = phase_of_turn(&Rational::from((1, 997))).0;
    assert!(RealField::containing([&seventh]).is_none());
}

#[test]
fn sums_of_different_form_are_equal() {
    // cos 36 - cos 72 = 1/2, and sin 75 = (sqrt 6 + sqrt 2)/4.
    let cosine = |n: i32, d: i32| Closed::from(Surd::cosine(&Rational::from((n, d))));
    let root = |n: i32| Closed::from(Surd::square_root(&Rational::from(n)).unwrap());
    let difference = cosine(1, 10).add(&cosine(1, 5).neg()).unwrap();
    let sum = root(6).add(&root(2)).unwrap().div(&Closed::rational(Rational::from(4))).unwrap();
    let sine = cosine(15, 360);
    let field = RealField::containing([&difference, &sum, &sine]).unwrap();
    assert_eq!(field.element(&difference).unwrap().rational(), Some(Rational::from((1, 2))));
    assert_eq!(field.element(&sum), field.element(&sine));
}
fn number(text: &str) -> Closed {
    Number::parse(text, Quantity::Ratio, &Reading::default()).unwrap().closed().unwrap()
}

#[test]
fn expressions_are_read_into_one_field() {
    // Pairs of expressions of one value.
    for (a, b, degree) in [
        ("100*sin(45 deg)/sin(30 deg)", "sqrt(20000)", 2),
        ("sin(23 deg)/sin(41 deg)*sin(41 deg)", "cos(67 deg)", 48),
        ("cos(acos(1/3) + pi/6)", "(sqrt(3) - sqrt(8))/6", 4),
        ("tan(22.5 deg)", "sqrt(2) - 1", 4),
        ("sin(2*atan(sqrt(2)))", "sin(2*atan(sqrt(2)))", 1),
        ("cos(2*atan(1/2)) + sqrt(5)", "3/5 + sqrt(5)", 2),
        ("(1 + sqrt(5))/4", "cos(36 deg)", 2),
    ] {
        let Some(x) = Number::parse(a, Quantity::Ratio, &Reading::default()).unwrap().closed() else {
            assert_eq!(degree, 1, "{a}");
            continue;
        };
        let y = number(b);
        let field = RealField::containing([&x, &y]).unwrap();
        assert_eq!(field.degree(), degree, "{a}");
        assert_eq!(field.element(&x).unwrap(), field.element(&y).unwrap(), "{a}");
    }
    let (cos, sin) = Angle::parse("37 deg", &Reading::default()).unwrap().phase().unwrap();
    let field = RealField::containing([&cos, &sin]).unwrap();
    let [c, s] = [&cos, &sin].map(|x| field.element(x).unwrap());
    assert_eq!(c.mul(&c).add(&s.mul(&s)).rational(), Some(Rational::from(1)));
    assert!(Number::parse("cos(1)", Quantity::Ratio, &Reading::default()).unwrap().closed().is_none());
    assert!(Number::parse("sqrt(1 + sqrt(2))", Quantity::Ratio, &Reading::default()).unwrap().closed().is_none());
}
