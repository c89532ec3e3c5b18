//! Poses and arms with answers of their own: self-motions, deficient arms, double solutions, nothing in reach.

use crate::arms::{
    angle, at_pose, closed_at, general, jacobian, motion, motions, open, pose, puma_like, ratio, singular, small,
    table, three_parallel,
};
use looproot::internal::assembly::wrapped;
use looproot::internal::catalogue::{Options, builtin};
use looproot::internal::kinematics::chain::{Chain, Placement};
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::mechanism::{FullMode, Solution};
use looproot::internal::verdict::Status;
use looproot_algebra::determinant::determinant;
use rug::Rational;
use std::f64::consts::PI;

fn at(arm: &Chain, values: &[[i32; 2]; 6]) -> Solution {
    at_pose(arm, pose(arm, &values.map(|[n, d]| ratio(n, d))))
}

/// The largest distance of a joint from where it was planted.
fn away(mode: &FullMode, planted: &[f64; 6]) -> f64 {
    (0..6).map(|k| wrapped(mode.q[k].re - planted[k]).abs().max(mode.q[k].im.abs())).fold(0.0, f64::max)
}

fn is_self_motion(solution: &Solution) {
    let verdict = &solution.verdict;
    assert_eq!((verdict.status, verdict.self_motion), (Status::SelfMotion, 1), "{}", verdict.reason);
}

#[test]
fn a_puma_with_a_straight_wrist_moves_by_itself() {
    is_self_motion(&at(&puma_like(), &[[1, 2], [-2, 3], [3, 4], [1, 3], [0, 1], [2, 5]]));
    // With a bent elbow it does not.
    let bent = at(&puma_like(), &[[1, 2], [-2, 3], [3, 4], [1, 3], [1, 7], [2, 5]]);
    assert_eq!((bent.verdict.status, bent.verdict.complex), (Status::Complete, 8), "{}", bent.verdict.reason);
}

#[test]
fn an_arm_with_four_parallel_axes_at_its_pose_moves_by_itself() {
    is_self_motion(&at(&three_parallel(), &[[1, 2], [-2, 3], [3, 4], [1, 3], [0, 1], [2, 5]]));
}

#[test]
fn a_line_symmetric_bricard_loop_moves() {
    is_self_motion(&crate::arms::solve(&builtin("bricard_line_symmetric", &Options::default()).unwrap()));
}

/// Arms whose axes have rank 5: axes 3 and 4 coincide, axes 2 to 5 are parallel, axes 5 and 6 coincide.
fn deficient() -> [Chain; 3] {
    [
        table([[3, 7, 4], [5, -6, 2], [0, 0, 3], [4, 9, 6], [2, -7, 1], [1, 3, 5]]),
        table([[3, 7, 4], [5, 0, 2], [4, 0, 3], [4, 0, 6], [2, -7, 1], [1, 3, 5]]),
        table([[3, 7, 4], [5, -6, 2], [4, 8, 3], [4, 9, 6], [0, 0, 1], [1, 3, 5]]),
    ]
}

/// Returns the answers to deficient arms at six reachable poses each.
fn deficient_answers() -> Vec<Solution> {
    let mut random = crate::arms::random(99);
    let mut answers = Vec::new();
    for arm in deficient() {
        for _ in 0..6 {
            answers.push(at_pose(&arm, pose(&arm, &std::array::from_fn::<_, 6, _>(|_| small(&mut random)))));
        }
    }
    answers
}

#[test]
fn deficient_arms_are_said_to_be_so() {
    for solution in deficient_answers() {
        let reason = &solution.verdict.reason;
        assert!(reason.contains("structurally deficient") && reason.contains("rank 5 of 6"), "{reason}");
        assert!(matches!(solution.verdict.status, Status::SelfMotion | Status::Incomplete), "{reason}");
        assert!(solution.modes.iter().all(|m| !m.certified), "{:?}", solution.modes);
    }
}

#[test]
fn deficient_arms_move_by_themselves_at_every_pose_in_reach() {
    for solution in deficient_answers() {
        is_self_motion(&solution);
    }
}

#[test]
fn a_pose_out_of_reach_has_sixteen_complex_solutions() {
    let mut random = crate::arms::random(60);
    for _ in 0..5 {
        let arm = general(&mut random);
        let values: [Rational; 6] = std::array::from_fn(|_| small(&mut random));
        let far = Motion { translation: [ratio(300, 1), ratio(-200, 1), ratio(100, 1)], ..pose(&arm, &values) };
        let verdict = at_pose(&arm, far).verdict;
        let facts = (verdict.status, verdict.real, verdict.complex, verdict.certified);
        assert_eq!(facts, (Status::Unreachable, 0, 16, 16), "{}", verdict.reason);
    }
}

#[test]
fn angles_of_pi_are_ordinary() {
    let mut random = crate::arms::random(61);
    for which in 1..64_u32 {
        let arm = general(&mut random);
        let halves: [Rational; 6] = std::array::from_fn(|_| small(&mut random));
        let is_pi = |k: usize| which >> k & 1 == 1;
        let mut turns = motions::<Rational>(&[Variable::Rotation; 6], &halves);
        for k in (0..6).filter(|&k| is_pi(k)) {
            turns[k] = Motion::rotation_z(ratio(-1, 1), Rational::new());
        }
        let solution = at_pose(&arm, arm.forward(&turns).unwrap());
        let planted = std::array::from_fn(|k| if is_pi(k) { PI } else { angle(&halves[k]).radians() });
        let facts = (solution.verdict.status, solution.verdict.complex);
        assert_eq!(facts, (Status::Complete, 16), "{which:b}: {}", solution.verdict.reason);
        let closed = open::<Rational>(&arm).close(&arm.forward(&turns).unwrap().inverse());
        let is_singular = determinant(&jacobian(&closed, &turns)).is_zero();
        // Four straight angles in a row fold the arm into a plane.
        assert_eq!(is_singular, which & 0b11110 == 0b11110, "{which:b}");
        let found = |m: &FullMode| {
            let expected = if is_singular { (2, 1e-5) } else { (1, 1e-10) };
            m.real && m.multiplicity == expected.0 && m.certified && away(m, &planted) < expected.1
        };
        assert!(solution.modes.iter().any(found), "{which:b}");
    }
}

#[test]
fn a_double_solution_counts_twice() {
    for seed in 0..12 {
        let (arm, values) = singular(&mut crate::arms::random(seed));
        assert!(
            determinant(&jacobian(&closed_at(&arm, &values), &motions(&[Variable::Rotation; 6], &values))).is_zero(),
            "arm {seed}"
        );
        let solution = at_pose(&arm, pose(&arm, &values));
        let reason = &solution.verdict.reason;
        assert_eq!((solution.verdict.status, solution.verdict.complex), (Status::Complete, 16), "arm {seed}: {reason}");
        let planted = values.each_ref().map(|t| angle(t).radians());
        let here: Vec<&FullMode> = solution.modes.iter().filter(|m| away(m, &planted) < 1e-4).collect();
        assert!(here.len() == 1 && here[0].real && here[0].multiplicity == 2, "arm {seed}: {here:?}");
        // The rounding of the pose moves a double solution by its square root.
        assert!(away(here[0], &planted) < 1e-5, "arm {seed}: {:e}", away(here[0], &planted));
        assert!(solution.modes.iter().all(|m| m.multiplicity == 1 || away(m, &planted) < 1e-4), "arm {seed}");
    }
}

#[test]
fn a_stretched_elbow_halves_the_solutions() {
    // Axes 2, 3 and 4 of an arm with three parallel ones in a plane: elbow up and elbow down are one.
    let solution = at(&three_parallel(), &[[1, 2], [-2, 3], [0, 1], [1, 3], [-3, 2], [2, 5]]);
    let verdict = &solution.verdict;
    assert_eq!((verdict.status, verdict.complex), (Status::Complete, 8), "{}", verdict.reason);
    let double = solution.modes.iter().filter(|m| m.multiplicity == 2).count();
    assert!(double >= 1, "{:?}", solution.modes);
}

/// An arm without offsets, its links on one line when all joints are at zero: a solution of multiplicity 4.
fn straight() -> Chain {
    table([[3, 7, 0], [5, -6, 0], [4, 8, 0], [4, 9, 0], [7, -4, 0], [2, 3, 0]])
}

#[test]
fn a_fully_stretched_arm_is_within_reach() {
    let mut random = crate::arms::random(62);
    for base in [0, 1, 1000, 1_000_000] {
        for _ in 0..5 {
            let mut arm = straight();
            let mut away = motion(&mut random);
            away.translation = away.translation.map(|x| x * base);
            arm.base = Placement::from_motion_exact(away);
            let verdict = at(&arm, &[[0, 1]; 6]).verdict;
            assert!(verdict.real > 0 && verdict.status != Status::Unreachable, "{base}: {}", verdict.reason);
        }
    }
}

#[test]
fn a_proved_ball_holds_a_solution_of_the_arm_as_given() {
    let mut random = crate::arms::random(62);
    for _ in 0..5 {
        let mut arm = straight();
        arm.base =
            Placement::from_motion_exact(Motion { translation: [0, 0, 0].map(Rational::from), ..motion(&mut random) });
        for mode in at(&arm, &[[0, 1]; 6]).modes.iter().filter(|m| m.real && m.certified) {
            let error = away(mode, &[0.0; 6]);
            assert!(error <= mode.radius || error > 1e-3, "{error:e} away, radius {:e}", mode.radius);
        }
    }
}
