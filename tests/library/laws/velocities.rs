//! The velocity of a platform: derivative of the legs, exactly; and the inverse of what it inverts.

use crate::strategies::rational;
use looproot::internal::kinematics::dual_quaternion::Quaternion;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::kinematics::platform::Platform;
use looproot::internal::kinematics::velocity::{leg_screws, velocity};
use looproot_algebra::dual::Dual;
use looproot_algebra::number::nearest_f64;
use looproot_algebra::ring::Ring;
use proptest::prelude::*;
use rug::Rational;

fn points() -> impl Strategy<Value = [[Rational; 3]; 6]> {
    prop::collection::vec(rational(), 18)
        .prop_map(|v| std::array::from_fn(|i| std::array::from_fn(|k| v[3 * i + k].clone())))
}

fn pose() -> impl Strategy<Value = Motion<Rational>> {
    prop::collection::vec(rational(), 7).prop_filter_map("a rotation", |v| {
        let [w, x, y, z, a, b, c] = <[Rational; 7]>::try_from(v).ok()?;
        let q = Quaternion { scalar: w, vector: [x, y, z] };
        let norm = q.norm();
        let rotation = (norm != 0).then(|| q.scaled_rotation().map(|row| row.map(|x| x / &norm)))?;
        Some(Motion { rotation, translation: [a, b, c] })
    })
}

fn twist() -> impl Strategy<Value = [Rational; 6]> {
    prop::collection::vec(rational(), 6).prop_map(|v| std::array::from_fn(|k| v[k].clone()))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    #[test]
    fn leg_screws_are_the_derivative_of_the_legs(base in points(), plate in points(), pose in pose(), twist in twist()) {
        let platform = Platform { base, plate };
        let screws = leg_screws(&platform, &pose);
        // The pose moved by the twist: R + eps w x R, p + eps v.
        let [v, w] = [[0, 1, 2], [3, 4, 5]].map(|k| k.map(|k: usize| twist[k].clone()));
        let cross = |x: &[Rational; 3]| looproot::internal::kinematics::motion::cross(&w, x);
        let columns: [[Rational; 3]; 3] = std::array::from_fn(|j| cross(&std::array::from_fn(|i| pose.rotation[i][j].clone())));
        let moved = Motion {
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| {
                Dual { value: pose.rotation[i][j].clone(), epsilon: columns[j][i].clone() }
            })),
            translation: std::array::from_fn(|i| Dual { value: pose.translation[i].clone(), epsilon: v[i].clone() }),
        };
        let squares = platform.map(|x| Some(Dual::constant(x.clone()))).unwrap().legs_squared(&moved);
        for (screw, square) in screws.iter().zip(&squares) {
            let rate = screw.iter().zip(&twist).fold(Rational::zero(), |sum, (s, t)| sum + Rational::from(s * t));
            prop_assert_eq!(rate * 2, square.epsilon.clone());
        }
    }

    #[test]
    fn the_twist_of_a_leg_lengthens_it_alone(base in points(), plate in points(), pose in pose()) {
        let platform = Platform { base, plate }.map(|x| Some(nearest_f64(x))).unwrap();
        let pose = pose.map(|x| Some(nearest_f64(x))).unwrap();
        let found = velocity(&platform, &pose);
        prop_assert!(found.singular_values.windows(2).all(|w| w[0] >= w[1]));
        if let Some(twist) = found.twist {
            let condition = found.singular_values[0] / found.singular_values[5];
            let screws = leg_screws(&platform, &pose);
            let extent = platform.plate.iter().flatten().map(|x| x.abs()).fold(1.0, f64::max);
            for (i, screw) in screws.iter().enumerate() {
                let length = screw[..3].iter().map(|x| x * x).sum::<f64>().sqrt();
                for leg in 0..6 {
                    let rate = (0..6).map(|k| screw[k] * twist[k][leg]).sum::<f64>() / length;
                    let wanted = f64::from(u8::from(i == leg));
                    prop_assert!((rate - wanted).abs() < 1e-12 * condition * extent * 1e3, "{rate} in place of {wanted}");
                }
            }
        }
    }

    #[test]
    fn singular_values_know_no_frame(base in points(), plate in points(), pose in pose(), frames in (pose(), pose())) {
        let platform = Platform { base, plate };
        let moved = Platform {
            base: platform.base.each_ref().map(|p| frames.0.apply(p)),
            plate: platform.plate.each_ref().map(|p| frames.1.apply(p)),
        };
        let there = frames.0.then_after(&pose).then_after(&frames.1.inverse());
        let image = |q: &Rational| Some(nearest_f64(q));
        let one = velocity(&platform.map(image).unwrap(), &pose.map(image).unwrap()).singular_values;
        let two = velocity(&moved.map(image).unwrap(), &there.map(image).unwrap()).singular_values;
        for (x, y) in one.iter().zip(two) {
            // Points far from the origin cost digits.
            prop_assert!((x - y).abs() < 1e-6 * one[0], "{one:?} {two:?}");
        }
    }
}
