//! Random arms with a planted configuration, the same ones for the same seed.

use crate::algebra::number::{Angle, HalfTangent, Number};
use crate::catalogue::entry::{Case, Design, Entry};
use crate::error::Result;
use crate::kinematics::chain::{Chain, Geometry, Joint, JointKind, Placement};
use crate::kinematics::closed_loop::{Layout, OpenLoop};
use crate::kinematics::motion::Motion;
use crate::solve::newton::closure;
use nalgebra::Matrix6;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rug::Rational;
use std::f64::consts::PI;

/// The families of random arms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Set {
    /// Lengths in [-1, 1], twists and angles in (-pi, pi).
    General,
    /// Two lengths in five zero, twists mostly 0, right angles or pi: wrists, parallel and crossing axes.
    Structured,
    /// General arms near a singular configuration, at 1e-2, 1e-3, ... 1e-6 radians from it in turn.
    NearSingular,
    /// Link lengths and offsets of very different sizes, 1e-3 to 1.
    BadlyScaled,
    /// Structured arms as calibrated: every parameter off by 1e-6.
    Calibrated,
}

impl Set {
    /// All of them by name.
    pub const NAMED: [(&'static str, Self); 5] = [
        ("general", Self::General),
        ("structured", Self::Structured),
        ("near-singular", Self::NearSingular),
        ("badly-scaled", Self::BadlyScaled),
        ("calibrated", Self::Calibrated),
    ];

    /// How near the planted configuration must be found, radians.
    #[must_use]
    pub fn tolerance(self) -> f64 {
        if self == Self::General { 1e-6 } else { 1e-5 }
    }
}

/// One arm, its pose, and the configuration the pose was made from.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The arm with one pose.
    pub entry: Entry,
    /// Its joints.
    pub chain: Chain,
    /// The planted joint angles.
    pub planted: [f64; 6],
    /// Smallest over largest singular value of the Jacobian there, lengths as given.
    pub regularity: f64,
}

/// Sample number `index` of a set.
///
/// # Errors
/// None in practice: the numbers drawn are finite and the poses rigid.
pub fn sample(set: Set, seed: u64, index: u64) -> Result<Sample> {
    // One stream per sample: any of them can be drawn alone, on any thread.
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(index);
    loop {
        let joints: Vec<Joint> = (0..6).map(|_| joint(set, &mut random)).collect();
        let chain = Chain { geometry: Geometry::Dh(joints), base: Placement::identity(), tool: Placement::identity() };
        let open: OpenLoop<f64> = chain.open_loop(&Layout::of(&chain, None)?)?;
        let mut planted: [f64; 6] = std::array::from_fn(|_| random.random_range(-PI..PI));
        if set == Set::NearSingular {
            let away = 10.0_f64.powi(-2 - i32::try_from(index % 5).unwrap_or(0));
            let Some((singular, joint)) = singular_near(&open, planted) else { continue };
            planted = singular;
            planted[joint] += away;
        }
        let regularity = regularity(&open, &planted);
        // A deficient arm has no isolated solution to plant.
        if regularity < if set == Set::Calibrated { 1e-4 } else { 1e-13 } {
            continue;
        }
        let turns = planted.map(|q| Motion::rotation_z(q.cos(), q.sin()));
        let Some(pose) = chain.forward::<f64>(&turns) else { continue };
        let (placement, _) = Placement::from_matrix(&matrix(&pose))?;
        let case = Case::at(placement, 0);
        let entry = Entry {
            name: format!("sample {index}"),
            title: format!("random arm {index} of seed {seed}"),
            source: None,
            notes: None,
            design: Design::Arm(chain.clone()),
            limits: Vec::new(),
            cases: vec![case],
            rounded: true,
        };
        return Ok(Sample { entry, chain, planted, regularity });
    }
}

fn matrix(pose: &Motion<f64>) -> [[Number; 4]; 4] {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| match (i, j) {
            (3, _) => Number::exact(Rational::from(u32::from(j == 3))),
            (_, 3) => Number::from_f64(pose.translation[i]),
            _ => Number::from_f64(pose.rotation[i][j]),
        })
    })
}

fn joint(set: Set, random: &mut ChaCha8Rng) -> Joint {
    let length = |random: &mut ChaCha8Rng| {
        let x: f64 = random.random_range(-1.0..1.0);
        match set {
            Set::Structured | Set::Calibrated if random.random_bool(0.4) => 0.0,
            Set::BadlyScaled => x.signum() * 10.0_f64.powf(3.0 * x.abs() - 3.0),
            _ => x,
        }
    };
    let (a, d) = (length(random), length(random));
    let free = random.random_range(-PI..PI);
    let right = |numerator: i32| Angle::from_half_tangent(HalfTangent::Finite(Rational::from(numerator)));
    let structured = matches!(set, Set::Structured | Set::Calibrated);
    let alpha = match random.random_range(0..10) {
        0..3 if structured => Angle::zero(),
        3..5 if structured => right(1),
        5..7 if structured => right(-1),
        7 if structured => Angle::from_half_tangent(HalfTangent::Infinite),
        _ => Angle::from_radians(free),
    };
    let mut off = |x: f64| if set == Set::Calibrated { x + random.random_range(-1e-6..1e-6) } else { x };
    let (a, d) = (off(a), off(d));
    let alpha = if set == Set::Calibrated { Angle::from_radians(off(alpha.radians())) } else { alpha };
    Joint {
        kind: JointKind::Revolute,
        a: Number::from_f64(a),
        alpha,
        d: Number::from_f64(d),
        theta0: Angle::zero(),
        pitch: None,
    }
}

/// The Jacobian at a configuration, as the twists of the axes in the base frame.
fn jacobian(open: &OpenLoop<f64>, q: &[f64; 6]) -> Matrix6<f64> {
    let here = closure(&open.close(&Motion::identity()), q);
    Matrix6::from_fn(|i, j| here.jacobian[i][j])
}

fn regularity(open: &OpenLoop<f64>, q: &[f64; 6]) -> f64 {
    let values = jacobian(open, q).singular_values();
    values.min() / values.max()
}

/// A singular configuration, by bisection of the determinant along joint 3, else 4, else 5; and the index of that joint.
fn singular_near(open: &OpenLoop<f64>, start: [f64; 6]) -> Option<([f64; 6], usize)> {
    for joint in 2..5 {
        let at = |value: f64| {
            let mut q = start;
            q[joint] = value;
            q
        };
        let det = |value: f64| jacobian(open, &at(value)).determinant();
        let steps: Vec<f64> = (0..=24).map(|k| start[joint] + 2.0 * PI * f64::from(k) / 24.0).collect();
        let Some(bracket) = steps.windows(2).find(|w| det(w[0]) * det(w[1]) < 0.0) else { continue };
        let (mut low, mut high) = (bracket[0], bracket[1]);
        let sign = det(low).signum();
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if det(middle) * sign > 0.0 { low = middle } else { high = middle }
        }
        return Some((at(0.5 * (low + high)), joint));
    }
    None
}
