//! Study's equations are those of the legs.

use super::cases::Draw;
use looproot::internal::closure::study::{Leg, left, linear_legs, right, scalar};
use looproot::internal::kinematics::dual_quaternion::Quaternion;
use looproot_algebra::dual::Dual;
use looproot_algebra::ring::Ring;
use rug::Rational;

fn four<R: Clone>(q: &Quaternion<R>) -> [R; 4] {
    let [x, y, z] = q.vector.clone();
    [q.scalar.clone(), x, y, z]
}

fn pure(v: &[Rational; 3]) -> Quaternion<Rational> {
    Quaternion { scalar: Rational::new(), vector: v.clone() }
}

#[test]
fn the_quadrics_vanish_at_a_pose_and_the_legs_are_linear_in_u() {
    for seed in 0..10 {
        let mut draw = Draw::new(seed);
        let platform = draw.platform();
        let (x, pose) = draw.pose();
        let squares = platform.legs_squared(&pose);
        let y = pure(&pose.translation).mul(&x);
        let (x4, y4) = (four(&x), four(&y));
        assert!(scalar(&x4, &y4).is_zero());
        for i in 0..6 {
            let leg = Leg::new(&platform.base[i], &platform.plate[i], squares[i].clone());
            assert!(leg.quadric(&x4, &y4, Ring::mul).is_zero(), "{seed} {i}");
            let longer = Leg { square: squares[i].clone() + 1, ..leg };
            assert_eq!(longer.quadric(&x4, &y4, Ring::mul), -x.norm());
        }
        // u = N (p.p, p, R^T p)
        let p = &pose.translation;
        let back = pose.inverse().rotate(p);
        let norm = x.norm();
        let mut u = vec![Rational::from(&p[0] * &p[0]) + Rational::from(&p[1] * &p[1]) + Rational::from(&p[2] * &p[2])];
        u.extend(p.iter().chain(&back).cloned());
        let legs = linear_legs(&platform);
        for i in 0..6 {
            let left_side: Rational = legs.matrix[i].iter().zip(&u).map(|(k, u)| Rational::from(k * u)).sum();
            let mut right_side = squares[i].clone() * &norm;
            for j in 0..4 {
                for k in 0..4 {
                    right_side += legs.forms[i][j][k].clone() * &x4[j] * &x4[k];
                }
            }
            assert_eq!(left_side * &norm, right_side);
        }
    }
}

#[test]
fn matrices_of_products_are_products_and_slopes_are_derivatives() {
    let mut draw = Draw::new(3);
    let (a, b, (x, _), (y, _)) = (draw.point(), draw.point(), draw.pose(), draw.pose());
    let apply = |m: &[[Rational; 4]; 4]| -> [Rational; 4] { std::array::from_fn(|i| scalar(&m[i], &four(&x))) };
    assert_eq!(apply(&left(&a)), four(&pure(&a).mul(&x)));
    assert_eq!(apply(&right(&b)), four(&x.mul(&pure(&b))));
    let leg = Leg::new(&a, &b, draw.number());
    let (x, y) = (four(&x), four(&y));
    let times = |d: &Dual<Rational>, c: &Rational| d.mul(&Dual::constant(c.clone()));
    let w = leg.vector(&x, &y, Ring::mul);
    let slope = leg.half_slope(&w, &x, Ring::mul);
    for k in 0..8 {
        let dual = |v: &[Rational; 4], from: usize| -> [Dual<Rational>; 4] {
            std::array::from_fn(|j| Dual { value: v[j].clone(), epsilon: Rational::from(i32::from(j + from == k)) })
        };
        let derivative = leg.quadric(&dual(&x, 0), &dual(&y, 4), times).epsilon;
        let half = if k < 4 { &slope[k] } else { &w[k - 4] };
        assert_eq!(derivative, Rational::from(half * 2), "{k}");
    }
}
