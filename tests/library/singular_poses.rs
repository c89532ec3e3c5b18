//! Robots of the library at singular poses: planted joint values are found again, on a self-motion or as a solution.
#![allow(clippy::unwrap_used)]

use looproot::Arm;
use looproot::internal::assembly::{Assembly, Roots, Workspace, wrapped};
use looproot::internal::catalogue::entry::{Case, InputValue};
use looproot::internal::catalogue::{Options, builtin};
use looproot::internal::kinematics::chain::Placement;
use looproot::internal::mechanism::{Mechanism, Solution, Tolerance};
use looproot::internal::verdict::{Proof, Status};
use looproot_algebra::number::{Angle, Number, Reading};
use std::f64::consts::FRAC_PI_2;

/// Solves a robot at the pose that joint values reach.
fn solved(name: &str, values: Vec<Angle>) -> Solution {
    let entry = builtin(name, &Options::default()).unwrap();
    let mechanism = Mechanism::prepare(&entry).unwrap();
    let values: Vec<InputValue> = values.into_iter().map(InputValue::Angle).collect();
    let case = Case::reached(entry.chain().unwrap(), &values, 1).unwrap();
    mechanism.solve(&case, Roots::Real, &mut Workspace::default(), &mut Assembly::default()).unwrap()
}

fn degrees(values: &[f64]) -> Vec<Angle> {
    values.iter().map(|x| Angle::parse(&format!("{x} deg"), &Reading::default()).unwrap()).collect()
}

fn apart(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| wrapped(a - b).abs()).fold(0.0, f64::max)
}

/// Checks that everything listed reaches the pose of planted joint values, by other forward kinematics.
fn check(name: &str, answer: &Solution, planted: &[f64]) {
    let arm = Arm::robot(name).unwrap();
    let pose = arm.fk(planted).unwrap();
    let modes = answer.modes.iter().map(|mode| mode.q.iter().map(|z| z.re).collect::<Vec<f64>>());
    let samples = answer.families.iter().flat_map(|family| &family.samples).cloned();
    for q in modes.chain(samples) {
        let reached = arm.fk(&q).unwrap();
        let off = (0..12).map(|k| (reached[k / 4][k % 4] - pose[k / 4][k % 4]).abs()).fold(0.0, f64::max);
        assert!(off < 1e-6, "{name}: {q:?} is {off} off");
    }
}

/// Whether joint values lie on a family in which these joints move. Samples of a curve are 0.1 apart at most.
fn is_on_family(answer: &Solution, planted: &[f64], moving: &[usize]) -> bool {
    answer
        .families
        .iter()
        .any(|family| family.moving == moving && family.samples.iter().any(|sample| apart(sample, planted) < 0.2))
}

#[test]
fn self_motions_of_robots_are_proved_by_the_axes_that_coincide() {
    let (wrist, parallel): (&[usize], &[usize]) = (&[3, 5], &[1, 2, 3, 5]);
    for (name, moving) in
        [("irb120", wrist), ("kr10_r1100", wrist), ("gp7", wrist), ("meca500", wrist), ("ur5e", parallel)]
    {
        for values in [[0.0; 6], [20.0, -40.0, 35.0, 10.0, 0.0, 50.0]] {
            let answer = solved(name, degrees(&values));
            let verdict = &answer.verdict;
            let found = (verdict.status, verdict.proof, verdict.self_motion);
            let planted = values.map(f64::to_radians);
            check(name, &answer, &planted);
            assert!(is_on_family(&answer, &planted, moving), "{name} {values:?}: {:?}", answer.families);
            // The home position of this robot is stretched, too.
            if name == "ur5e" && values[2] == 0.0 {
                continue;
            }
            assert_eq!(found, (Status::SelfMotion, Proof::Proved, 1), "{name} {values:?}: {}", verdict.reason);
        }
    }
}

/// Solves a robot at the pose that joint values reach, typed with so many digits, within a tolerance if one is asked for.
fn solved_as_typed(name: &str, planted: &[f64], digits: i32, tolerance: Option<Tolerance>) -> Solution {
    let entry = builtin(name, &Options::default()).unwrap();
    let rows = Arm::robot(name).unwrap().fk(planted).unwrap();
    let parts = 10_f64.powi(digits);
    let typed: [[Number; 4]; 4] = std::array::from_fn(|i| {
        std::array::from_fn(|j| match rows.get(i) {
            Some(row) => Number::from_f64((row[j] * parts).round() / parts),
            None => Number::from_f64(f64::from(u8::from(i == j))),
        })
    });
    let unit = Tolerance { length: 1.0 / parts, angle: 1.0 / parts };
    let case = Case { rounding: Some(unit), ..Case::at(Placement::from_matrix(&typed).unwrap().0, 1) };
    let mechanism = Mechanism::prepare(&entry).unwrap().with_tolerance(tolerance);
    mechanism.solve(&case, Roots::Real, &mut Workspace::default(), &mut Assembly::default()).unwrap()
}

#[test]
fn self_motions_that_six_digits_dissolve_are_near() {
    let (wrist, parallel): (&[usize], &[usize]) = (&[3, 5], &[1, 2, 3, 5]);
    // Where the elbow is stretched, too, most of these poses are out of reach by a part of the last digit.
    let elbows = [[302.0_f64, 70.0], [120.0, 38.0]].map(|[forearm, offset]| -forearm.atan2(offset));
    let stretched = [("ur5e", 0.0, parallel), ("irb120", elbows[0], wrist), ("meca500", elbows[1], wrist)];
    for (name, elbow, moving) in stretched {
        for (joint, third) in [(0.3, 0.9), (0.5, elbow), (-1.1, elbow), (0.9, elbow), (-0.2, elbow)] {
            let planted = [joint, 0.4 - joint, third, 0.3 + joint, 0.0, -0.7];
            let tolerance = Tolerance { length: 1e-5, angle: 1e-5 };
            let answer = solved_as_typed(name, &planted, 6, Some(tolerance));
            let holds = is_on_family(&answer, &planted, moving);
            assert!(answer.verdict.status == Status::Complete && holds, "{name} {planted:?}: {:?}", answer.verdict);
            assert!(answer.near() > 0 && answer.families.iter().all(|family| family.distance > 0.0), "{planted:?}");
        }
    }
}

#[test]
fn a_pose_that_typing_put_beyond_reach_is_not_denied() {
    // The elbow is stretched and the wrist in line: half of all poses beside the one that is reached are beyond reach.
    let elbow = -(302.0_f64.atan2(70.0));
    let mut near = 0;
    for digits in [3, 4, 6] {
        for joint in [0.5, -1.1, 0.9, -0.2] {
            let planted = [joint, 0.4 - joint, elbow, 0.3 + joint, 0.0, -0.7];
            let answer = solved_as_typed("irb120", &planted, digits, None);
            let verdict = &answer.verdict;
            assert_ne!(verdict.status, Status::Unreachable, "{digits} digits, {planted:?}: {}", verdict.reason);
            near += usize::from(answer.near() > 0);
            // What is listed misses the pose by no more than typing did.
            let mut errors = answer.modes.iter().filter_map(|mode| mode.error);
            assert!(errors.all(|error| error.largest() <= 10_f64.powi(-digits)), "{planted:?}");
        }
    }
    assert!(near > 3, "{near} have something near");
}

#[test]
fn a_typed_pose_far_beyond_reach_is_denied() {
    for (name, position) in
        [("ur5e", [1.2, 0.3, 0.4]), ("irb120", [0.7, -0.2, 0.5]), ("arm/jaco_j2n6", [0.2, 0.9, 0.8])]
    {
        let entry = builtin(name, &Options::default()).unwrap();
        let typed: [[Number; 4]; 4] = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                Number::from_f64(if j == 3 && i < 3 { position[i] } else { f64::from(u8::from(i == j)) })
            })
        });
        let rounding = Some(Tolerance { length: 1e-3, angle: 1e-3 });
        let case = Case { rounding, ..Case::at(Placement::from_matrix(&typed).unwrap().0, 1) };
        let mechanism = Mechanism::prepare(&entry).unwrap();
        let answer = mechanism.solve(&case, Roots::Real, &mut Workspace::default(), &mut Assembly::default()).unwrap();
        let verdict = &answer.verdict;
        assert_eq!((verdict.status, verdict.proof), (Status::Unreachable, Proof::Proved), "{name}: {}", verdict.reason);
    }
}

#[test]
fn a_double_solution_that_nine_digits_split_is_near() {
    // Other solutions are real, and f64 does not find the complex pair beside the planted one.
    for planted in [
        [
            -0.268_702_221_527_804_43,
            1.983_677_775_017_676,
            1.188_825_898_165_347_2,
            -0.653_607_238_733_098_2,
            0.604_580_576_038_177,
            1.832_502_283_124_045,
        ],
        [
            -2.785_201_080_656_707,
            -1.490_483_835_016_368_3,
            2.228_332_341_170_421_7,
            2.730_688_236_405_785_4,
            -0.018_439_699_051_599_17,
            -0.389_052_630_263_251_4,
        ],
    ] {
        let answer = solved_as_typed("arm/jaco_j2n6", &planted, 9, None);
        let is_planted = |q: &[f64]| apart(q, &planted) < 1e-3;
        let is_found = answer.modes.iter().any(|mode| is_planted(&mode.q.iter().map(|z| z.re).collect::<Vec<_>>()));
        assert!(is_found && answer.near() > 0, "{}", answer.verdict.reason);
    }
}

#[test]
fn a_curve_that_crosses_another_one_is_a_family_of_its_own() {
    // The wrist centre is on the first axis, and the fourth axis in line with the sixth one.
    let planted = [-0.276, -0.152_947_260_390_856_88, -1.057, -0.883, 0.0, -1.326];
    let answer = solved("irb120", planted.map(Angle::from_radians).into());
    check("irb120", &answer, &planted);
    assert!(is_on_family(&answer, &planted, &[3, 5]), "{:?}", answer.families);
    assert!(answer.families.iter().any(|family| family.moving == [0, 3, 4, 5]), "{:?}", answer.families);
}

#[test]
fn a_stretched_arm_with_its_wrist_in_line_has_the_family_of_the_wrist() {
    let planted = [1.784, 1.478, -FRAC_PI_2, -0.006, 0.0, 1.238];
    let answer = solved("irb1600_6_120", planted.map(Angle::from_radians).into());
    check("irb1600_6_120", &answer, &planted);
    assert!(is_on_family(&answer, &planted, &[3, 5]), "{:?}", answer.verdict);
}

#[test]
fn conditions_that_are_singular_at_a_pose_do_not_hide_its_solutions() {
    // With the last joint at 0 or a half turn the tool could turn about the parallel axes, were that not a condition.
    for values in [[-135.0, -90.0, -35.0, -70.0, 0.0], [-25.0, -60.0, 0.0, 100.0, 0.0], [0.0; 5]] {
        let planted = values.map(f64::to_radians);
        for values in [degrees(&values), planted.map(Angle::from_radians).into()] {
            let answer = solved("px150", values);
            check("px150", &answer, &planted);
            let is_planted = |q: &[f64]| apart(q, &planted) < 1e-6;
            let is_found = answer.modes.iter().any(|mode| is_planted(&mode.q.iter().map(|z| z.re).collect::<Vec<_>>()));
            assert!(answer.verdict.status == Status::Complete && is_found, "{planted:?}: {:?}", answer.verdict);
        }
    }
}

#[test]
fn poses_far_beyond_every_arm_have_an_answer() {
    for name in ["puma560", "ur5e", "irb120"] {
        let arm = Arm::robot(name).unwrap();
        let near = arm.fk(&[0.2, 0.5, 0.8, 1.1, 1.4, 1.7]).unwrap();
        for distance in [1e5, 1e20, 1e100, 1e200, 1e300] {
            for axis in 0..3 {
                let mut pose = near;
                pose[axis][3] = distance;
                let answer = arm.ik(&pose).unwrap();
                assert!(answer.modes.is_empty(), "{name}, {distance:e} along axis {axis}: {}", answer.verdict.reason);
                assert_eq!(answer.verdict.status, Status::Unreachable, "{name}: {}", answer.verdict.reason);
                assert!(answer.verdict.proof.is_proved(), "{name}: {}", answer.verdict.reason);
            }
        }
    }
}
