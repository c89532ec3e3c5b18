//! One mechanism written in many ways: the same solutions and the same verdict.

use crate::arms::{
    angle, at_input, at_pose, chain, general, joint, motion, pose, puma_like, random, ratio, screw, screw_chain, small,
    three_parallel,
};
use looproot::internal::assembly::wrapped;
use looproot::internal::kinematics::chain::{Chain, Geometry, Joint, JointKind, Placement};
use looproot::internal::kinematics::motion::{Motion, link};
use looproot::internal::mechanism::{FullMode, Solution};
use looproot::internal::verdict::Status;
use looproot_algebra::number::{Angle, HalfTangent, Number};
use num_complex::Complex;
use rug::Rational;

/// Asserts the same verdict, and the same solutions after `image` has renamed those of the second.
fn assert_same(what: &str, one: &Solution, two: &Solution, image: impl Fn(&[Complex<f64>]) -> Vec<Complex<f64>>) {
    let facts = |s: &Solution| {
        let v = &s.verdict;
        (v.status, v.complex, v.real, v.at_infinity, v.self_motion, v.certified)
    };
    assert_eq!(facts(one), facts(two), "{what}: {} / {}", one.verdict.reason, two.verdict.reason);
    assert!(!one.modes.is_empty(), "{what}");
    let mut free: Vec<(Vec<Complex<f64>>, &FullMode)> = two.modes.iter().map(|m| (image(&m.q), m)).collect();
    for mode in &one.modes {
        let far = |q: &[Complex<f64>]| {
            let apart = |(a, b): (&Complex<f64>, &Complex<f64>)| Complex::new(wrapped(a.re - b.re), a.im - b.im).norm();
            mode.q.iter().zip(q).map(apart).fold(0.0, f64::max)
        };
        let found = free.iter().position(|(q, other)| far(q) < 1e-8 && other.real == mode.real);
        let found = found.unwrap_or_else(|| panic!("{what}: no image of {:?}", mode.q));
        free.swap_remove(found);
    }
    assert!(free.is_empty(), "{what}");
}

fn unchanged(q: &[Complex<f64>]) -> Vec<Complex<f64>> {
    q.to_vec()
}

/// The arms that everything is tried on, each with the half tangents of a configuration, and its number of solutions.
fn samples() -> Vec<(Chain, [Rational; 6], usize)> {
    let mut random = random(11);
    let mut values = || -> [Rational; 6] { std::array::from_fn(|_| small(&mut random)) };
    let mut samples = vec![(puma_like(), values(), 8), (three_parallel(), values(), 8)];
    for seed in 20..24 {
        samples.push((general(&mut crate::arms::random(seed)), values(), 16));
    }
    samples
}

fn joints(chain: &Chain) -> &[Joint] {
    match &chain.geometry {
        Geometry::Dh(joints) => joints,
        other => panic!("{other:?}"),
    }
}

/// All lengths times a factor.
fn scaled_motion(m: &Motion<Rational>, factor: &Rational) -> Motion<Rational> {
    Motion { translation: m.translation.clone().map(|x| x * factor), ..m.clone() }
}

fn negative(x: &Number) -> Number {
    Number::exact(-x.rational().clone())
}

fn opposite(joint: &Joint) -> Joint {
    let HalfTangent::Finite(t) = joint.alpha.half_tangent() else { panic!("a twist of pi") };
    Joint { a: negative(&joint.a), d: negative(&joint.d), alpha: angle(&-t.clone()), ..joint.clone() }
}

/// Returns the same arm with its links before the joints.
fn modified(arm: &Chain) -> Chain {
    let dh = joints(arm);
    let first = Joint { a: Number::zero(), alpha: Angle::zero(), ..dh[0].clone() };
    let later = (1..6).map(|k| Joint { a: dh[k - 1].a.clone(), alpha: dh[k - 1].alpha.clone(), ..dh[k].clone() });
    let tool = Placement::from_motion_exact(link(&dh[5].a, &dh[5].alpha).unwrap());
    let joints = std::iter::once(first).chain(later).collect();
    Chain { tool, ..chain(Geometry::ModifiedDh(joints)) }
}

/// Returns the same arm by its screw axes.
fn screws(arm: &Chain) -> Chain {
    let mut frame = Motion::identity();
    let mut axes = Vec::new();
    for joint in joints(arm) {
        axes.push(screw(JointKind::Revolute, &frame));
        let offset = Motion::translation_z(joint.d.rational().clone());
        frame = frame.then_after(&offset).then_after(&link(&joint.a, &joint.alpha).unwrap());
    }
    screw_chain(axes, frame)
}

#[test]
fn the_planted_solution_is_there_and_the_list_complete() {
    for (arm, values, count) in samples() {
        let solution = at_pose(&arm, pose(&arm, &values));
        assert_eq!((solution.verdict.status, solution.verdict.complex), (Status::Complete, count));
        let planted = values.each_ref().map(|t| angle(t).radians());
        let far = |m: &FullMode| (0..6).map(|k| wrapped(m.q[k].re - planted[k]).abs()).fold(0.0, f64::max);
        assert!(solution.modes.iter().any(|m| m.real && m.certified && far(m) < 1e-12));
    }
}

#[test]
fn base_and_tool_may_move() {
    let mut random = random(12);
    for (mut arm, values, _) in samples() {
        let wanted = at_pose(&arm, pose(&arm, &values));
        arm.base = Placement::from_motion_exact(motion(&mut random));
        assert_same("base", &wanted, &at_pose(&arm, pose(&arm, &values)), unchanged);
        arm.tool = Placement::from_motion_exact(motion(&mut random));
        assert_same("tool", &wanted, &at_pose(&arm, pose(&arm, &values)), unchanged);
    }
}

#[test]
fn an_arm_may_be_read_from_its_tool() {
    for (arm, values, _) in samples() {
        let wanted = at_pose(&arm, pose(&arm, &values));
        let reversed = joints(&arm).iter().rev().map(opposite).collect();
        let reversed = chain(Geometry::ModifiedDh(reversed));
        let found = at_pose(&reversed, pose::<Rational>(&arm, &values).inverse());
        assert_same("reversed", &wanted, &found, |q| q.iter().rev().map(|z| -z).collect());
    }
}

#[test]
fn conventions_are_only_writing() {
    for (arm, values, _) in samples() {
        let here = pose::<Rational>(&arm, &values);
        let wanted = at_pose(&arm, here.clone());
        for (name, other) in [("modified", modified(&arm)), ("screws", screws(&arm))] {
            assert_eq!(pose::<Rational>(&other, &values), here, "{name}");
            assert_same(name, &wanted, &at_pose(&other, here.clone()), unchanged);
        }
    }
}

#[test]
fn the_unit_of_length_does_not_matter() {
    for (arm, values, _) in samples() {
        let here = pose::<Rational>(&arm, &values);
        let wanted = at_pose(&arm, here.clone());
        for factor in [ratio(1000, 1), ratio(3, 7000)] {
            let times = |x: &Number| Number::exact(x.rational().clone() * &factor);
            let scaled = joints(&arm).iter().map(|j| Joint { a: times(&j.a), d: times(&j.d), ..j.clone() });
            let scaled = chain(Geometry::Dh(scaled.collect()));
            let found = at_pose(&scaled, scaled_motion(&here, &factor));
            assert_same(&format!("times {factor}"), &wanted, &found, unchanged);
        }
    }
}

/// Seven revolutes that close at these half tangents, and the values.
fn seven(seed: u64) -> (Chain, Vec<Rational>) {
    let mut random = random(seed);
    let plain = |random: &mut _| joint(JointKind::Revolute, &small(random), &small(random), &small(random));
    let joints: Vec<Joint> = (0..7).map(|_| plain(&mut random)).collect();
    let values: Vec<Rational> = (0..7).map(|_| small(&mut random)).collect();
    let mut chain = chain(Geometry::Dh(joints));
    let reached: Motion<Rational> = pose(&chain, &values);
    chain.tool = Placement::from_motion_exact(reached.inverse());
    (chain, values)
}

#[test]
fn a_loop_is_an_arm_at_the_pose_of_its_input_link() {
    for seed in 30..34 {
        let (loop_of_seven, values) = seven(seed);
        let wanted = at_input(&loop_of_seven, 7, &values[6]);
        assert_eq!((wanted.verdict.status, wanted.verdict.complex), (Status::Complete, 16));
        let arm = chain(Geometry::Dh(joints(&loop_of_seven)[..6].to_vec()));
        let here = pose::<Rational>(&arm, &values[..6]);
        let given = Complex::from(angle(&values[6]).radians());
        let with_input = |q: &[Complex<f64>]| [q, &[given]].concat();
        assert_same("arm", &wanted, &at_pose(&arm, here), with_input);
    }
}

#[test]
fn a_loop_may_be_listed_from_any_joint() {
    for seed in 30..33 {
        let (loop_of_seven, values) = seven(seed);
        // As screws, so that the links of the first and the last joint need no common form.
        let wanted = at_input(&loop_of_seven, 3, &values[2]);
        for shift in 1..7 {
            let all = joints(&loop_of_seven);
            let mut frame = Motion::identity();
            let mut axes = Vec::new();
            for k in 0..7 {
                let joint = &all[(shift + k) % 7];
                axes.push(screw(JointKind::Revolute, &frame));
                let offset = Motion::translation_z(joint.d.rational().clone());
                frame = frame.then_after(&offset).then_after(&link(&joint.a, &joint.alpha).unwrap());
                if shift + k == 6 {
                    frame = frame.then_after(&loop_of_seven.tool.exact);
                }
            }
            let shifted = screw_chain(axes, frame);
            let found = at_input(&shifted, (2 + 7 - shift) % 7 + 1, &values[2]);
            assert_same(&format!("from joint {}", shift + 1), &wanted, &found, |q| {
                (0..7).map(|k| q[(k + 7 - shift) % 7]).collect()
            });
        }
    }
}

#[test]
fn whichever_joint_is_given_the_planted_closure_is_found() {
    let (loop_of_seven, values) = seven(40);
    let planted: Vec<f64> = values.iter().map(|t| angle(t).radians()).collect();
    for joint in 1..=7 {
        let solution = at_input(&loop_of_seven, joint, &values[joint - 1]);
        assert_eq!((solution.verdict.status, solution.verdict.complex), (Status::Complete, 16), "joint {joint}");
        let far = |m: &FullMode| (0..7).map(|k| wrapped(m.q[k].re - planted[k]).abs()).fold(0.0, f64::max);
        assert!(solution.modes.iter().any(|m| m.real && far(m) < 1e-11), "joint {joint}");
    }
}
