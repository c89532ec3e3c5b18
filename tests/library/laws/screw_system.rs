//! Screw systems keep the properties that do not depend on the frame, and agree over the rationals and in f64.

use looproot::internal::kinematics::motion::{Motion, Vector, cross, dot};
use looproot::internal::kinematics::screw_system::{LinearComplex, Screw, ScrewSystem};
use looproot_algebra::number::nearest_f64;
use proptest::prelude::*;
use rug::Rational;

type Q = Rational;

fn vector() -> impl Strategy<Value = Vector<Q>> {
    [-6_i32..=6, -6..=6, -6..=6].prop_map(|v| v.map(Q::from))
}

/// A revolute, prismatic or helical joint.
fn screw() -> impl Strategy<Value = Screw<Q>> {
    (vector(), vector(), -3_i32..=3, 0..4_u8).prop_map(|(point, mut axis, pitch, kind)| {
        if axis.iter().all(|x| *x == 0) {
            axis[2] = Q::from(1);
        }
        let mut screw = Screw::rotation(&point, &axis);
        match kind {
            0 => Screw::translation(&axis),
            1 => {
                for (m, d) in screw.moment.iter_mut().zip(&axis) {
                    *m += Q::from(d * pitch);
                }
                screw
            }
            _ => screw,
        }
    })
}

fn line() -> impl Strategy<Value = Screw<Q>> {
    (vector(), vector()).prop_filter_map("an axis has a direction", |(point, axis)| {
        axis.iter().any(|x| *x != 0).then(|| Screw::rotation(&point, &axis))
    })
}

/// The screw in another frame, the rotation given by a quaternion.
fn moved(screw: &Screw<Q>, motion: &Motion<Q>) -> Screw<Q> {
    let direction = motion.rotate(&screw.direction);
    let moment = motion.rotate(&screw.moment);
    let shift = cross(&motion.translation, &direction);
    Screw { direction, moment: std::array::from_fn(|k| Q::from(&moment[k] + &shift[k])) }
}

fn motion() -> impl Strategy<Value = Motion<Q>> {
    (vector(), vector()).prop_map(|(axis, translation)| {
        let q = looproot::internal::kinematics::dual_quaternion::Quaternion { scalar: Q::from(1), vector: axis };
        let norm = q.norm();
        let rotation = q.scaled_rotation().map(|row| row.map(|x| x / &norm));
        Motion { rotation, translation }
    })
}

fn float(screw: &Screw<Q>) -> Screw<f64> {
    Screw { direction: screw.direction.each_ref().map(nearest_f64), moment: screw.moment.each_ref().map(nearest_f64) }
}

proptest! {
    #[test]
    fn a_system_and_its_reciprocal_fill_the_space(screws in prop::collection::vec(screw(), 0..8)) {
        let system = ScrewSystem::of(&screws);
        let reciprocal = system.reciprocal();
        prop_assert_eq!(system.order() + reciprocal.order(), 6);
        for a in reciprocal.basis() {
            for b in &screws {
                prop_assert_eq!(a.reciprocal_product(b), 0);
            }
        }
        let back = reciprocal.reciprocal();
        let joined: Vec<_> = back.basis().into_iter().chain(screws).collect();
        prop_assert_eq!(ScrewSystem::of(&joined).order(), system.order());
    }

    #[test]
    fn order_and_words_are_those_of_floats_and_of_every_frame(
        screws in prop::collection::vec(screw(), 1..7), motion in motion()
    ) {
        let system = ScrewSystem::of(&screws);
        let seen = ScrewSystem::of(&screws.iter().map(|s| moved(s, &motion)).collect::<Vec<_>>());
        prop_assert_eq!(seen.order(), system.order());
        prop_assert_eq!(seen.description(), system.description());
        let floats = ScrewSystem::of(&screws.iter().map(float).collect::<Vec<_>>());
        prop_assert_eq!(floats.order(), system.order());
        prop_assert_eq!(floats.description(), system.description());
    }

    #[test]
    fn pitches_do_not_depend_on_the_frame(screw in screw(), motion in motion()) {
        let seen = moved(&screw, &motion);
        prop_assert_eq!(seen.pitch(), screw.pitch());
        if let (Some(foot), Some(there)) = (screw.foot(), seen.foot()) {
            // The foot is another point, but of the same axis.
            let image = motion.apply(&foot);
            let along: Vector<Q> = std::array::from_fn(|k| Q::from(&image[k] - &there[k]));
            prop_assert_eq!(cross(&along, &seen.direction), [Q::new(), Q::new(), Q::new()]);
        }
    }

    #[test]
    fn lines_of_a_linear_complex_are_reciprocal_to_it(lines in prop::collection::vec(line(), 5)) {
        let system = ScrewSystem::of(&lines);
        match system.linear_complex() {
            None => prop_assert!(system.order() < 5),
            Some(LinearComplex::General { screw, pitch, foot }) => {
                // Distance and angle from the axis: pitch = r tan(angle), without roots.
                for line in &lines {
                    prop_assert_eq!(line.reciprocal_product(&screw), 0);
                }
                let moment = cross(&foot, &screw.direction);
                let with_pitch: Vector<Q> =
                    std::array::from_fn(|k| Q::from(&moment[k] + Q::from(&pitch * &screw.direction[k])));
                prop_assert_eq!(&with_pitch, &screw.moment);
            }
            Some(LinearComplex::Perpendicular(direction)) => {
                prop_assert!(lines.iter().all(|line| dot(&line.direction, &direction) == 0));
            }
        }
    }

    #[test]
    fn redundant_constraints_make_up_for_the_count(screws in prop::collection::vec(screw(), 1..8)) {
        let freedom = ScrewSystem::of(&screws).loop_freedom();
        prop_assert_eq!(freedom.freedom + freedom.order, freedom.joints);
        prop_assert_eq!(freedom.rates.len(), freedom.freedom);
        prop_assert_eq!(freedom.freedom + 6, freedom.joints + freedom.redundant.order());
        for rate in &freedom.rates {
            for k in 0..6 {
                let sum = screws.iter().zip(rate).fold(Q::new(), |sum, (s, r)| sum + Q::from(&s.coordinates()[k] * r));
                prop_assert_eq!(sum, 0);
            }
            for &joint in &freedom.locked {
                prop_assert_eq!(&rate[joint], &Q::new());
            }
        }
    }

    #[test]
    fn two_screws_have_the_pitches_of_the_cylindroid(a in line(), b in line()) {
        // det(K - p G) = 0 for two screws, as the quadratic that it is.
        let dd = |x: &Screw<Q>, y: &Screw<Q>| dot(&x.direction, &y.direction);
        let gram = Q::from(&dd(&a, &a) * &dd(&b, &b)) - Q::from(&dd(&a, &b) * &dd(&a, &b));
        prop_assume!(gram != 0);
        let half = a.reciprocal_product(&b) / 2;
        let (screws, translations) = ScrewSystem::of(&[float(&a), float(&b)]).principal_screws();
        prop_assert_eq!((screws.len(), translations), (2, 0));
        // The pitches of two lines: p^2 gram + 2 p half (a.b) - half^2 = 0.
        let [gram, mixed, half] = [gram, Q::from(&half * &dd(&a, &b)), half].each_ref().map(nearest_f64);
        for found in &screws {
            let p = found.pitch;
            let residual = gram * p * p + 2.0 * p * mixed - half * half;
            prop_assert!(residual.abs() <= 1e-9 * (gram * p * p + half * half + 1.0), "{residual} at {p}");
            prop_assert!((found.screw.pitch().unwrap() - p).abs() <= 1e-9 * (1.0 + p.abs()));
        }
        prop_assert!(dot(&screws[0].screw.direction, &screws[1].screw.direction).abs() <= 1e-9);
        // Their axes meet: two perpendicular lines with the moments of lines.
        prop_assert!(screws[0].screw.reciprocal_product(&screws[1].screw).abs() <= 1e-7 * (1.0 + half.abs()));
    }
}

fn lines(data: &[([i32; 3], [i32; 3])]) -> Vec<Screw<Q>> {
    data.iter().map(|(point, axis)| Screw::rotation(&point.map(Q::from), &axis.map(Q::from))).collect()
}

#[test]
fn special_systems_are_named() {
    let named = |data: &[([i32; 3], [i32; 3])]| {
        let system = ScrewSystem::of(&lines(data));
        (system.order(), system.description())
    };
    let (z, x, y) = ([0, 0, 1], [1, 0, 0], [0, 1, 0]);
    let cases = [
        (named(&[([1, 2, 3], z), ([1, 2, 7], [0, 0, -2])]), 1, "all axes coincide"),
        (named(&[([0, 0, 0], z), ([1, 0, 0], z), ([0, 1, 0], z), ([3, 4, 0], z)]), 3, "(planar)"),
        (named(&[([0, 0, 0], z), ([1, 0, 0], z), ([2, 0, 0], z)]), 2, "parallel and in one plane"),
        (named(&[([1, 1, 1], z), ([1, 1, 1], x), ([1, 1, 1], [1, 1, 3]), ([1, 1, 1], y)]), 3, "(spherical)"),
        (named(&[([0, 0, 0], x), ([0, 1, 0], [1, 2, 0]), ([5, 0, 0], y)]), 3, "lie in one plane"),
        // Generators of z = x y, one family.
        (
            named(&[([0, 0, 0], y), ([1, 0, 0], [0, 1, 1]), ([2, 0, 0], [0, 1, 2]), ([3, 0, 0], [0, 1, 3])]),
            3,
            "regulus",
        ),
        (
            named(&[
                ([0, 0, 0], x),
                ([0, 0, 1], [1, 2, 3]),
                ([0, 0, 4], [2, -1, 1]),
                ([0, 0, 2], y),
                ([0, 0, 7], [3, 1, 1]),
            ]),
            5,
            "meet one line",
        ),
        (
            named(&[
                ([0, 0, 0], x),
                ([0, 5, 1], [1, 2, 0]),
                ([1, 2, 4], [2, -1, 0]),
                ([1, 0, 2], y),
                ([8, 3, 3], [3, 1, 0]),
            ]),
            5,
            "perpendicular to one direction",
        ),
    ];
    for ((order, words), expected, part) in cases {
        assert_eq!(order, expected, "{words}");
        assert!(words.contains(part), "{words} / {part}");
    }
    let crossed = [Screw::translation(&x.map(Q::from)), Screw::translation(&y.map(Q::from))];
    assert_eq!(ScrewSystem::of(&crossed).description(), "translations only, 2 independent directions");
    assert_eq!(ScrewSystem::<Q>::of(&[]).loop_freedom().freedom, 0);
}

#[test]
fn a_rotation_and_a_translation_along_it_leave_one_finite_pitch() {
    let screws = [Screw::rotation(&[1.0, 0.0, 0.0], &[0.0, 0.0, 2.0]), Screw::translation(&[0.0, 0.0, 3.0])];
    let (principal, translations) = ScrewSystem::of(&screws).principal_screws();
    assert_eq!((principal.len(), translations), (1, 1));
    assert!(principal[0].pitch.abs() < 1e-12);
    // Three perpendicular screws through the origin are the principal ones of the system that they span.
    let axis = |k: usize, pitch: f64| {
        let direction: Vector<f64> = std::array::from_fn(|j| f64::from(u8::from(j == k)));
        Screw { direction, moment: direction.map(|x| pitch * x) }
    };
    let mixed = [axis(0, 3.0), axis(1, -1.0), axis(2, 0.5)];
    let add = |a: &Screw<f64>, b: &Screw<f64>| Screw {
        direction: std::array::from_fn(|k| a.direction[k] + b.direction[k]),
        moment: std::array::from_fn(|k| a.moment[k] + b.moment[k]),
    };
    let system = ScrewSystem::of(&[add(&mixed[0], &mixed[1]), add(&mixed[1], &mixed[2]), mixed[0].clone()]);
    let (found, _) = system.principal_screws();
    for (screw, pitch) in found.iter().zip([-1.0, 0.5, 3.0]) {
        assert!((screw.pitch - pitch).abs() < 1e-12);
    }
}
