//! Laws of screws, lines and instantaneous motion.
#![allow(clippy::unwrap_used)]

use looproot_algebra::dual::Dual;
use looproot_algebra::series::Series;
use looproot_calculus::displacement::screw::{Screw, halphen, motion};
use looproot_calculus::displacement::velocity::State;
use looproot_calculus::instant::plane::Instant;
use looproot_calculus::line::pluecker::Line;
use looproot_calculus::motion::{Motion, cross, dot};
use looproot_calculus::quaternion::Quaternion;
use looproot_calculus::rotation::euler::Order;
use looproot_calculus::rotation::matrix::product;
use looproot_calculus::rotation::rates::{angular_velocity, quaternion_rate};
use looproot_calculus::rotation::three_axes::{angles, turned};
use looproot_calculus::rotation::turn::Turn;
use looproot_calculus::tree::{Tree, turning};
use num_complex::Complex;
use proptest::prelude::*;
use rug::Rational;

fn vector() -> impl Strategy<Value = [i32; 3]> {
    prop::array::uniform3(-6..=6_i32)
}

fn exact(v: [i32; 3]) -> [Rational; 3] {
    v.map(Rational::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_screw_of_a_screw_motion_is_that_screw(p in vector(), v in vector(), angle in 0.1..3.0_f64, shift in -3.0..3.0_f64) {
        prop_assume!(v != [0; 3]);
        let axis = Line::at(&p.map(f64::from), &v.map(f64::from)).unit().unwrap();
        let found = Screw::of(&motion(&axis, &(angle / 2.0).cos(), &(angle / 2.0).sin(), &shift).unwrap()).unwrap();
        prop_assert!((found.angle().unwrap() - angle).abs() < 1e-9);
        prop_assert!((found.translation - shift).abs() < 1e-9);
        let line = found.axis().unwrap();
        prop_assert!(line.moment.iter().zip(&axis.moment).all(|(a, b)| (a - b).abs() < 1e-7));
    }

    #[test]
    fn two_half_turns_move_along_the_common_perpendicular_by_twice_the_distance(
        p in vector(), u in vector(), q in vector(), v in vector()
    ) {
        let (one, two) = (Line::at(&exact(p), &exact(u)), Line::at(&exact(q), &exact(v)));
        let normal = cross(&one.direction, &two.direction);
        prop_assume!(dot(&normal, &normal) != 0);
        let motion = halphen(&one, &two).to_motion().unwrap();
        // The feet of the common perpendicular: a point of the first line moves by twice the distance.
        let (foot, other) = (one.foot(&two).unwrap(), two.foot(&one).unwrap());
        let image = motion.apply(&foot);
        for i in 0..3 {
            let way = Rational::from(&other[i] - &foot[i]) * 2;
            prop_assert_eq!(Rational::from(&image[i] - &foot[i]), way);
        }
    }

    #[test]
    fn angles_about_three_axes_compose_to_the_rotation(halves in prop::array::uniform3(-5..=5_i32)) {
        let axes = [[0, 3, 4], [2, 6, 9], [2, 3, 6]].map(|a: [i32; 3]| {
            let length = Rational::from(dot(&exact(a), &exact(a)).numer().clone().sqrt());
            exact(a).map(|c| c / &length)
        });
        let turns = halves.map(|half| Turn::from_half(&Rational::from(3), &Rational::from(half)).unwrap());
        let all = |turns: &[Turn<Rational>; 3]| {
            let [a, b, c]: [_; 3] = std::array::from_fn(|k| turned(&axes[k], &turns[k]).unwrap());
            product(&product(&a, &b), &c)
        };
        let rotation = all(&turns);
        // The discriminant is the square of a rational number, since one solution is rational.
        let found = angles(&axes, &rotation).unwrap();
        prop_assert!(found.contains(&turns));
        for other in &found {
            prop_assert_eq!(&all(other), &rotation);
        }
    }

    #[test]
    fn rates_and_angular_velocity_belong_together(q in prop::array::uniform4(-5..=5_i32), omega in vector()) {
        prop_assume!(q != [0; 4]);
        let [w, x, y, z] = q.map(Rational::from);
        let q = Quaternion { scalar: w, vector: [x, y, z] };
        let rate = quaternion_rate(&q, &exact(omega)).unwrap();
        let moving = Quaternion {
            scalar: Dual { value: q.scalar, epsilon: rate.scalar },
            vector: std::array::from_fn(|i| Dual { value: q.vector[i].clone(), epsilon: rate.vector[i].clone() }),
        };
        prop_assert_eq!(angular_velocity(&moving).unwrap(), exact(omega));
    }

    #[test]
    fn a_tree_moves_alike_by_recursion_and_by_its_path_matrix(slopes in prop::array::uniform3(-4..=4_i32)) {
        let tree = Tree::new(vec![None, Some(0), Some(0)]).unwrap();
        let rational = |n: i32| Rational::from(n);
        // Joints about z, x and y at the ends of links, each rotating at its own rate.
        let about = |axis: u8, slope: i32| -> Motion<Series<Rational, 3>> {
            let angle = Series { coefficients: [rational(0), rational(slope), rational(0)] };
            let (cos, sin) = angle.cos_sin_beyond(Rational::from((3, 5)), Rational::from((4, 5))).unwrap();
            let turn = Turn { cos, sin };
            let order = ["zxz", "xyx", "yxy"][usize::from(axis)];
            let still = Turn::zero();
            let rotation = Order::parse(order).unwrap().matrix(&[turn, still.clone(), still]);
            let end = [rational(1), rational(2), rational(i32::from(axis))].map(Series::constant);
            Motion { rotation, translation: end }
        };
        let joints: Vec<_> = (0..3).map(|k| about(k, slopes[usize::from(k)])).collect();
        let placed = tree.placed(&joints).unwrap();
        // The axes of the joints in space, before each rotates.
        let still = |m: &Motion<Series<Rational, 3>>| m.map(|s| Some(s.coefficients[0].clone())).unwrap();
        let unit = |k: usize| -> [Rational; 3] { std::array::from_fn(|i| rational(i32::from(i == k))) };
        let first = still(&placed[0]);
        let axes = [unit(2), first.rotate(&unit(0)), first.rotate(&unit(1))];
        let points = [still(&placed[0]).translation, still(&placed[1]).translation, still(&placed[2]).translation];
        let twists: Vec<_> = (0..3).map(|k| turning(&points[k], &axes[k], &rational(slopes[k]))).collect();
        for (place, (omega, velocity)) in placed.iter().zip(tree.twists(&twists).unwrap()) {
            let state = State::of(place);
            prop_assert_eq!(&state.omega, &omega);
            prop_assert_eq!(&state.velocity, &velocity);
        }
    }
}

#[test]
fn pivots_lie_on_the_cubic_and_have_the_frame_pivots_as_centres() {
    // A four-bar with the pole (0, 10): A = (0, 0), B = (0, 2), C = (3, 6), D = (6, 2), links 2, 5, 5. The coupler has its
    // origin at B, and its angle is the parameter.
    let z = |re: f64, im: f64| Complex { re, im };
    let instant = Instant { pole: z(0.0, 10.0), second: z(-110.0 / 3.0, -40.0), third: z(320.0, 440.0) };
    let (b, c) = (z(0.0, 2.0), z(3.0, 6.0));
    for (moving, fixed) in [(b, z(0.0, 0.0)), (c, z(6.0, 2.0))] {
        let centre = instant.centre(&moving).unwrap();
        assert!((centre - fixed).norm() < 1e-12, "{centre}");
        assert!(instant.stationary(&moving).abs() < 1e-8);
    }
    let ball = instant.ball_point().unwrap();
    assert!(instant.inflection(&ball).abs() < 1e-9 && instant.stationary(&ball).abs() < 1e-6);
    // The inverse of the inverse is the motion itself.
    let twice = instant.inverse().inverse();
    assert!((twice.third - instant.third).norm() < 1e-12);
}

#[path = "../examples/strapdown.rs"]
mod strapdown;

#[test]
fn an_orientation_is_found_from_gyroscopes() {
    strapdown::main();
}
