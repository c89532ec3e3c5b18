//! Rational arms at poses made by exact forward kinematics, for checks that can be exact.
#![allow(dead_code, reason = "shared by several test files")]
#![allow(clippy::unwrap_used)]

use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::entry::{Case, Design, Entry, Input, InputValue, Labels};
use looproot::internal::kinematics::chain::{Chain, Geometry, Joint, JointKind, Placement, ScrewJoint};
use looproot::internal::kinematics::closed_loop::{
    ClosedLoop, Layout, OpenLoop, Variable, angle_motion, distance_motion,
};
use looproot::internal::kinematics::motion::{Motion, cross};
use looproot::internal::kinematics::platform_limits::PlatformLimits;
use looproot::internal::mechanism::{Mechanism, Solution};
use looproot_algebra::determinant::determinant;
use looproot_algebra::number::{Angle, HalfTangent, Number, Reading};
use looproot_algebra::ring::Ring;
use rand::Rng;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rug::Rational;

/// A source of random numbers, the same ones for the same seed.
#[must_use]
pub fn random(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// `n / d`
#[must_use]
pub fn ratio(n: i32, d: i32) -> Rational {
    Rational::from((n, d))
}

/// A small rational, not zero.
pub fn small(random: &mut ChaCha8Rng) -> Rational {
    let n = random.random_range(1..=7) * if random.random_bool(0.5) { 1 } else { -1 };
    ratio(n, random.random_range(1..=5))
}

/// An angle by its half-angle tangent.
#[must_use]
pub fn angle(half_tangent: &Rational) -> Angle {
    Angle::from_half_tangent(HalfTangent::Finite(half_tangent.clone()))
}

/// The angle pi.
#[must_use]
pub fn pi() -> Angle {
    Angle::from_half_tangent(HalfTangent::Infinite)
}

/// A joint with link length, half tangent of the twist, offset, and zero position 0.
#[must_use]
pub fn joint(kind: JointKind, a: &Rational, half_alpha: &Rational, d: &Rational) -> Joint {
    Joint {
        kind,
        a: Number::exact(a.clone()),
        alpha: angle(half_alpha),
        d: Number::exact(d.clone()),
        theta0: Angle::zero(),
        pitch: None,
    }
}

/// An arm without base and tool.
#[must_use]
pub fn chain(geometry: Geometry) -> Chain {
    Chain { geometry, base: Placement::identity(), tool: Placement::identity() }
}

/// Six revolutes with small rational parameters in general position.
pub fn general(random: &mut ChaCha8Rng) -> Chain {
    let joints = (0..6).map(|_| joint(JointKind::Revolute, &small(random), &small(random), &small(random)));
    chain(Geometry::Dh(joints.collect()))
}

/// Six revolutes from a table of `[a, tan(alpha/2), d]`, numerators over 10.
#[must_use]
pub fn table(rows: [[i32; 3]; 6]) -> Chain {
    let tenths = |n: i32| ratio(n, 10);
    let row = |[a, t, d]: [i32; 3]| joint(JointKind::Revolute, &tenths(a), &tenths(t), &tenths(d));
    chain(Geometry::Dh(rows.map(row).to_vec()))
}

/// Axes 2 and 3 parallel, a spherical wrist, and the tool where the wrist is.
#[must_use]
pub fn puma_like() -> Chain {
    table([[0, 10, 0], [43, 0, 0], [-2, 10, 15], [0, 10, 43], [0, 10, 0], [0, 0, 0]])
}

/// Axes 2, 3 and 4 parallel.
#[must_use]
pub fn three_parallel() -> Chain {
    table([[0, 10, 9], [-42, 0, 0], [-39, 0, 0], [0, 10, 11], [0, -10, 9], [0, 0, 8]])
}

/// The last three axes through one point, nothing else special.
#[must_use]
pub fn spherical_wrist() -> Chain {
    table([[3, 7, 4], [5, -6, 2], [4, 8, -3], [0, 9, 6], [0, -7, 0], [0, 0, 5]])
}

/// A rational motion in general position.
pub fn motion(random: &mut ChaCha8Rng) -> Motion<Rational> {
    let (first, second, third) = (small(random), small(random), small(random));
    let turn = |t: &Rational| angle_motion::<Rational>(&angle(t)).unwrap();
    let tilt = Rational::cos_sin(&angle(&second)).unwrap();
    let turned = turn(&first).then_after(&Motion::rotation_x(tilt.0, tilt.1)).then_after(&turn(&third));
    Motion { translation: std::array::from_fn(|_| small(random)), ..turned }
}

/// A screw joint on the axis that this motion makes of the z axis.
#[must_use]
pub fn screw(kind: JointKind, frame: &Motion<Rational>) -> ScrewJoint {
    ScrewJoint {
        kind,
        axis: std::array::from_fn(|i| Number::exact(frame.rotation[i][2].clone())),
        point: std::array::from_fn(|i| Number::exact(frame.translation[i].clone())),
        pitch: None,
    }
}

/// An arm by its screw axes and its home position.
#[must_use]
pub fn screw_chain(joints: Vec<ScrewJoint>, home: Motion<Rational>) -> Chain {
    chain(Geometry::Screws { joints, home: Box::new(Placement::from_motion_exact(home)) })
}

/// The motion of a joint variable: half the tangent of an angle, or a distance.
#[must_use]
pub fn variable_motion<R: Ring>(variable: Variable, value: &Rational) -> Motion<R> {
    match variable {
        Variable::Rotation => angle_motion(&angle(value)).unwrap(),
        Variable::Translation => distance_motion(&Number::exact(value.clone())).unwrap(),
    }
}

/// The motions of joint variables given by half tangents and distances.
#[must_use]
pub fn motions<R: Ring>(variables: &[Variable], values: &[Rational]) -> Vec<Motion<R>> {
    variables.iter().zip(values).map(|(variable, value)| variable_motion(*variable, value)).collect()
}

/// The pose of an arm at these joint variables.
#[must_use]
pub fn pose<R: Ring>(chain: &Chain, values: &[Rational]) -> Motion<R> {
    let layout = Layout::of(chain, None).unwrap();
    chain.forward(&motions(&layout.variables, values)).unwrap()
}

/// The loop of an arm without its pose.
#[must_use]
pub fn open<R: Ring>(chain: &Chain) -> OpenLoop<R> {
    chain.open_loop(&Layout::of(chain, None).unwrap()).unwrap()
}

/// The loop of an arm at the pose of these joint variables.
#[must_use]
pub fn closed_at<R: Ring>(chain: &Chain, values: &[Rational]) -> ClosedLoop<R> {
    open(chain).close(&pose(chain, values).inverse())
}

/// The correctly rounded image of a rational motion.
#[must_use]
pub fn rounded(motion: &Motion<Rational>) -> Motion<f64> {
    motion.map(f64::from_rational).unwrap()
}

/// A mechanism file without words.
#[must_use]
pub fn entry(design: Design, cases: Vec<Case>) -> Entry {
    Entry {
        name: String::new(),
        title: String::new(),
        source: None,
        notes: None,
        design,
        limits: Vec::new(),
        platform_limits: PlatformLimits::default(),
        cases,
        rounded: false,
        reading: Reading::default(),
        labels: Labels::default(),
    }
}

/// All solutions of the first case.
#[must_use]
pub fn solve(entry: &Entry) -> Solution {
    let mechanism = Mechanism::prepare(entry).unwrap();
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap()
}

/// All solutions of an arm at a pose.
#[must_use]
pub fn at_pose(chain: &Chain, pose: Motion<Rational>) -> Solution {
    solve(&entry(Design::Arm(chain.clone()), vec![Case::at(Placement::from_motion_exact(pose), 0)]))
}

/// All solutions of a loop with this joint (from 1) at this half tangent.
#[must_use]
pub fn at_input(chain: &Chain, joint: usize, half_tangent: &Rational) -> Solution {
    let input = Input { joint, value: InputValue::Angle(angle(half_tangent)) };
    solve(&entry(Design::Loop(chain.clone()), vec![Case::given(input, 0)]))
}

/// The Jacobian of a loop of rotations at these joint motions: column j is the twist of joint j.
#[must_use]
pub fn jacobian(closed: &ClosedLoop<Rational>, turns: &[Motion<Rational>]) -> [[Rational; 6]; 6] {
    let mut frame: Motion<Rational> = Motion::identity();
    let columns: [[Rational; 6]; 6] = std::array::from_fn(|j| {
        let z: [Rational; 3] = std::array::from_fn(|i| frame.rotation[i][2].clone());
        let moment = cross(&frame.translation, &z);
        frame = frame.then_after(&turns[j]).then_after(&closed.constants[j]);
        std::array::from_fn(|i| if i < 3 { z[i].clone() } else { moment[i - 3].clone() })
    });
    std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i].clone()))
}

/// An arm in general position but for the link length a5, which is such that the pose of the half tangents is exactly
/// singular.
pub fn singular(random: &mut ChaCha8Rng) -> (Chain, [Rational; 6]) {
    let Geometry::Dh(joints) = general(random).geometry else { unreachable!() };
    let values: [Rational; 6] = std::array::from_fn(|_| small(random));
    let with = |a5: Rational| {
        let mut joints = joints.clone();
        joints[4].a = Number::exact(a5);
        chain(Geometry::Dh(joints))
    };
    let turns = motions(&[Variable::Rotation; 6], &values);
    let determinant = |a5: i32| determinant(&jacobian(&closed_at(&with(Rational::from(a5)), &values), &turns));
    // a5 moves axis 6 alone: the determinant is linear in it.
    let (at_0, at_1) = (determinant(0), determinant(1));
    let a5 = -at_0.clone() / (at_1 - at_0);
    (with(a5), values)
}
