//! Every conversion and its inverse, over rationals, f64 and dual numbers.
#![allow(clippy::unwrap_used)]

use looproot_algebra::dual::Dual;
use looproot_algebra::ring::Ring;
use looproot_calculus::quaternion::Quaternion;
use looproot_calculus::rotation::cayley_klein::CayleyKlein;
use looproot_calculus::rotation::euler::{Angles, Order};
use looproot_calculus::rotation::matrix::{Matrix, from_matrix, matrix};
use looproot_calculus::rotation::turn::Turn;
use looproot_calculus::rotation::vectors::{
    axis_angle, axis_turn, euler_vectors, from_axis_angle, from_euler_vector, from_rodrigues, from_wiener, rodrigues,
    unit, wiener,
};
use looproot_calculus::unit::{Analytic, Root};
use proptest::prelude::*;
use rug::Rational;

/// The twelve orders of axes.
const ORDERS: [&str; 12] = ["zxz", "zyz", "xyx", "xzx", "yxy", "yzy", "xyz", "xzy", "yxz", "yzx", "zxy", "zyx"];

fn rational((n, d): (i32, i32)) -> Rational {
    Rational::from((n, d))
}

fn fraction() -> impl Strategy<Value = (i32, i32)> {
    (-9..=9_i32, 1..=7_i32)
}

/// Draws a nonzero quaternion of rationals.
fn quaternion() -> impl Strategy<Value = [(i32, i32); 4]> {
    prop::array::uniform4(fraction()).prop_filter("zero", |q| q.iter().any(|(n, _)| *n != 0))
}

fn exact(q: &[(i32, i32); 4]) -> Quaternion<Rational> {
    let [w, x, y, z] = q.map(rational);
    Quaternion { scalar: w, vector: [x, y, z] }
}

fn float(q: &[(i32, i32); 4]) -> Quaternion<f64> {
    let [w, x, y, z] = q.map(|(n, d)| f64::from(n) / f64::from(d));
    Quaternion { scalar: w, vector: [x, y, z] }
}

fn dual(q: &[(i32, i32); 4], rate: &[(i32, i32); 4]) -> Quaternion<Dual<f64>> {
    let (value, epsilon) = (float(q), float(rate));
    Quaternion {
        scalar: Dual { value: value.scalar, epsilon: epsilon.scalar },
        vector: std::array::from_fn(|i| Dual { value: value.vector[i], epsilon: epsilon.vector[i] }),
    }
}

/// Returns whether entries agree to rounding.
fn near<R: Analytic>(a: &Matrix<R>, b: &Matrix<R>, parts: impl Fn(&R) -> Vec<f64>) -> bool {
    let entries = a.iter().flatten().zip(b.iter().flatten());
    entries.into_iter().all(|(x, y)| parts(x).iter().zip(parts(y)).all(|(x, y)| (x - y).abs() < 1e-6))
}

/// Tests every conversion from a rotation to a parametrisation and back, over a ring with angles. `is_clear` decides which places
/// are critical.
fn round_trips<R: Analytic>(q: &Quaternion<R>, parts: impl Fn(&R) -> Vec<f64> + Copy) -> Result<(), TestCaseError> {
    let rows = matrix(q).unwrap();
    let same = |found: &Quaternion<R>| near(&matrix(found).unwrap(), &rows, parts);
    let q = unit(q).unwrap();
    prop_assert!(same(&q), "unit");
    prop_assert!(same(&from_matrix(&rows)), "matrix");
    prop_assert!(same(&CayleyKlein::of(&q).quaternion()), "Cayley-Klein");
    if let Some((axis, angle)) = axis_angle(&q) {
        prop_assert!(same(&from_axis_angle(&axis, &angle).unwrap()), "axis");
        let (axis, turn) = axis_turn(&q).unwrap();
        prop_assert!(same(&turn.about(&axis)), "axis and turn");
        for vector in euler_vectors(&q) {
            prop_assert!(same(&from_euler_vector(&vector).unwrap()), "Euler vector");
        }
    }
    for vector in wiener(&q) {
        prop_assert!(same(&from_wiener(&vector)), "Wiener vector");
    }
    if let Some(vector) = rodrigues(&q) {
        prop_assert!(same(&from_rodrigues(&vector)), "Rodrigues vector");
    }
    for order in ORDERS {
        let order = Order::parse(order).unwrap();
        match order.angles(&rows) {
            Some(Angles::Two(branches)) => {
                for turns in branches {
                    let angles = turns.each_ref().map(|turn| turn.angle().unwrap());
                    let back = angles.each_ref().map(Turn::of_angle);
                    prop_assert!(near(&order.matrix(&back), &rows, parts), "{order:?}");
                }
            }
            Some(Angles::Family { middle, outer, .. }) => {
                // Every split of the outer angle belongs to it; over dual numbers only the values do, as the place is critical.
                let turns = [outer, middle, Turn::zero()];
                let values = |x: &R| vec![parts(x)[0]];
                prop_assert!(near(&order.matrix(&turns), &rows, values), "{order:?} at a critical place");
            }
            None => prop_assert!(false, "{order:?} has no angles"),
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn floats_come_back(q in quaternion()) {
        round_trips(&float(&q), |x| vec![*x])?;
    }

    #[test]
    fn dual_numbers_come_back(q in quaternion(), rate in prop::array::uniform4(fraction())) {
        // If a quaternion is a half turn or the identity, its dual parametrisations are critical.
        prop_assume!(q.iter().all(|(n, _)| *n != 0));
        round_trips(&dual(&q, &rate), |x| vec![x.value, x.epsilon])?;
    }

    #[test]
    fn rationals_come_back_exactly(q in quaternion()) {
        let q = exact(&q);
        let rows = matrix(&q).unwrap();
        prop_assert_eq!(matrix(&from_matrix(&rows)).unwrap(), rows.clone());
        prop_assert_eq!(matrix(&CayleyKlein::of(&q).quaternion()).unwrap(), rows.clone());
        if let Some(vector) = rodrigues(&q) {
            prop_assert_eq!(matrix(&from_rodrigues(&vector)).unwrap(), rows);
        } else {
            prop_assert_eq!(q.scalar, 0);
        }
    }

    /// Euler vectors have no part in it: but for 0 no rotation with a rational matrix has a rational one.
    #[test]
    fn rational_axes_and_angles_come_back_exactly(p in quaternion(), half in fraction()) {
        let axis = matrix(&exact(&p)).unwrap().map(|row| row[2].clone());
        let half = Turn::from_half(&Rational::from(1), &rational(half)).unwrap();
        let q = Quaternion { scalar: half.cos.clone(), vector: axis.each_ref().map(|c| Rational::from(c * &half.sin)) };
        prop_assert_eq!(matrix(&half.plus(&half).about(&axis)).unwrap(), matrix(&q).unwrap());
        if let Some((found, turn)) = axis_turn(&unit(&q).unwrap()) {
            prop_assert_eq!(matrix(&turn.about(&found)).unwrap(), matrix(&q).unwrap());
            let same = found == axis && turn == half.plus(&half);
            let opposite = found.each_ref().map(|c| Rational::from(-c)) == axis && turn == half.plus(&half).negated();
            prop_assert!(same || opposite);
        } else {
            prop_assert_eq!(half.sin, 0);
        }
    }

    #[test]
    fn rational_wiener_vectors_come_back_exactly(v in prop::array::uniform3(fraction())) {
        let v = v.map(rational);
        let q = from_wiener(&v);
        // The norm of 1 - v.v + 2 v is the square of 1 + v.v.
        let found = wiener(&unit(&q).unwrap());
        prop_assert!(found.contains(&v));
        for other in found {
            prop_assert_eq!(matrix(&from_wiener(&other)).unwrap(), matrix(&q).unwrap());
        }
    }

    #[test]
    fn rational_angles_come_back_exactly(halves in prop::array::uniform3(fraction())) {
        let turns = halves.map(|half| Turn::from_half(&Rational::from(1), &rational(half)).unwrap());
        for order in ORDERS {
            let order = Order::parse(order).unwrap();
            let rows = order.matrix(&turns);
            match order.angles(&rows).unwrap() {
                Angles::Two(branches) => {
                    prop_assert!(branches.contains(&turns));
                    for branch in &branches {
                        prop_assert_eq!(&order.matrix(branch), &rows);
                    }
                }
                Angles::Family { middle, outer, is_difference } => {
                    let third = if is_difference { turns[2].negated() } else { turns[2].clone() };
                    prop_assert_eq!(&outer, &turns[0].plus(&third));
                    prop_assert_eq!(&order.matrix(&[outer, middle, Turn::zero()]), &rows);
                }
            }
        }
    }

    #[test]
    fn similar_rotations_have_one_angle_and_the_turned_axis(p in quaternion(), q in quaternion()) {
        let (p, q) = (exact(&p), exact(&q));
        let moved = p.mul(&q).mul(&p.conjugate());
        let norm = p.norm();
        prop_assert_eq!(&moved.scalar, &q.scalar.clone().mul(&norm));
        let axis = p.mul(&Quaternion { scalar: Rational::new(), vector: q.vector }).mul(&p.conjugate()).vector;
        prop_assert_eq!(moved.vector, axis);
    }
}

#[test]
fn roots_of_rationals_are_those_of_squares() {
    assert_eq!(Root::sqrt(&Rational::from((4, 9))), Some(Rational::from((2, 3))));
    assert_eq!(Root::sqrt(&Rational::from(2)), None);
    assert_eq!(Root::sqrt(&Rational::from(-4)), None);
}
