//! Random arms with a planted configuration, the same ones for the same seed.

use crate::algebra::number::{Angle, HalfTangent, Number, Reading};
use crate::catalogue::entry::{Case, Design, Entry, Labels};
use crate::error::Result;
use crate::kinematics::chain::{Chain, Geometry, Joint, JointKind, Placement};
use crate::kinematics::closed_loop::{Layout, OpenLoop, Variable, angle_motion, distance_motion};
use crate::kinematics::motion::Motion;
use crate::kinematics::platform_limits::PlatformLimits;
use crate::solve::newton::closure;
use looproot_calculus::finite::finite;
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
    /// Structured arms after calibration: every parameter is off by 1e-6.
    Calibrated,
    /// Loops of one of the [`CHAINS`] in general.
    Chain(usize),
    /// Loops of one of the [`CHAINS`] with right angles, parallel and crossing axes, at angles that are mostly 0, right
    /// or pi.
    SpecialChain(usize),
}

/// The number format of lengths, offsets, angles and planted joint variables.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Data {
    /// The numbers as drawn.
    Floats,
    /// Lengths and half-angle tangents with three decimals, and the exact pose that they reach.
    Decimals,
}

impl Data {
    fn number(self, x: f64) -> Number {
        match self {
            Self::Floats => Number::from_f64(x),
            Self::Decimals => Number::exact(thousandths(x)),
        }
    }

    fn angle(self, radians: f64) -> Angle {
        match self {
            Self::Floats => Angle::from_radians(radians),
            // A rotation by pi has an infinite half-angle tangent.
            Self::Decimals if radians.abs() == PI => Angle::from_half_tangent(HalfTangent::Infinite),
            Self::Decimals => Angle::from_half_tangent(HalfTangent::Finite(thousandths((0.5 * radians).tan()))),
        }
    }
}

fn thousandths(x: f64) -> Rational {
    Rational::from_f64((x * 1000.0).round()).expect("a finite number was drawn") / 1000
}

/// The residual chains of the single-loop mechanisms with given input: six joint variables of revolute, prismatic and
/// cylindrical joints, up to rotation and reversal, or a spherical joint and three; and the number of solutions in
/// general.
pub const CHAINS: [(&str, usize); 32] = [
    ("CCC", 2),
    ("CCPR", 2),
    ("CPCR", 2),
    ("CPPRR", 2),
    ("CPRPR", 2),
    ("CPRRP", 2),
    ("CRPPR", 2),
    ("PPPRRR", 2),
    ("PPRPRR", 2),
    ("PRPRPR", 2),
    ("CRCR", 4),
    ("CCRR", 8),
    ("CPRRR", 8),
    ("CRPRR", 8),
    ("PPRRRR", 8),
    ("PRPRRR", 8),
    ("PRRPRR", 8),
    ("CRRRR", 16),
    ("PRRRRR", 16),
    ("RRRRRR", 16),
    ("SRRR", 4),
    ("SRRP", 4),
    ("SPRR", 4),
    ("SRPR", 4),
    ("SCR", 4),
    ("SRC", 4),
    ("SPPR", 2),
    ("SPRP", 2),
    ("SRPP", 2),
    ("SCP", 2),
    ("SPC", 2),
    ("SPPP", 1),
];

impl Set {
    /// All of them by name.
    pub const NAMED: [(&'static str, Self); 5] = [
        ("general", Self::General),
        ("structured", Self::Structured),
        ("near-singular", Self::NearSingular),
        ("badly-scaled", Self::BadlyScaled),
        ("calibrated", Self::Calibrated),
    ];

    /// Returns the tolerance for the planted configuration, radians.
    #[must_use]
    pub fn tolerance(self) -> f64 {
        if matches!(self, Self::General | Self::Chain(_)) { 1e-6 } else { 1e-5 }
    }

    /// Returns the joints of a chain of this set.
    pub(super) fn joints(self) -> Vec<JointKind> {
        let (Self::Chain(index) | Self::SpecialChain(index)) = self else { return vec![JointKind::Revolute; 6] };
        let letters = CHAINS[index].0;
        (0..letters.len()).filter_map(|at| JointKind::from_letter(&letters[at..=at])).collect()
    }

    /// Returns whether lengths often vanish and angles are often right.
    fn is_structured(self) -> bool {
        matches!(self, Self::Structured | Self::Calibrated | Self::SpecialChain(_))
    }

    /// Returns the distance that planted configurations keep from singular ones.
    fn least_regularity(self) -> f64 {
        match self {
            Self::Calibrated => 1e-4,
            Self::SpecialChain(_) => 1e-3,
            // A deficient arm has no isolated solution to plant.
            _ => 1e-13,
        }
    }
}

/// One arm, its pose, and the configuration from which the pose was computed.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The arm with one pose.
    pub entry: Entry,
    /// Its joints.
    pub chain: Chain,
    /// The planted joint variables.
    pub planted: [f64; 6],
    /// The kind of each of them.
    pub variables: [Variable; 6],
    /// Smallest over largest singular value of the Jacobian there, lengths as given.
    pub regularity: f64,
}

/// Sample number `index` of a set.
///
/// # Errors
/// None in practice: the numbers drawn are finite and the poses rigid.
pub fn sample(set: Set, seed: u64, index: u64) -> Result<Sample> {
    draw(set, Data::Floats, seed, index)
}

/// Returns sample number `index` of a set with three decimals of all lengths and half-angle tangents, planted ones
/// included, and the exact pose that these reach.
///
/// # Errors
/// As [`sample`].
pub fn rational_sample(set: Set, seed: u64, index: u64) -> Result<Sample> {
    draw(set, Data::Decimals, seed, index)
}

fn draw(set: Set, data: Data, seed: u64, index: u64) -> Result<Sample> {
    // Each sample has its own stream, so that it can be drawn alone, on any thread.
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(index);
    loop {
        let joints: Vec<Joint> = set.joints().into_iter().map(|kind| joint(set, data, kind, &mut random)).collect();
        let chain = Chain { geometry: Geometry::Dh(joints), base: Placement::identity(), tool: Placement::identity() };
        let layout = Layout::of(&chain, None)?;
        let open: OpenLoop<f64> = chain.open_loop(&layout)?;
        let variables = open.variables;
        let mut planted: [f64; 6] = std::array::from_fn(|k| value(set, variables[k], &mut random));
        if let Some(spherical) = layout.spherical {
            // Angles stay away from the ends of the second angle's range, where the other two are not unique.
            for k in 0..3 {
                planted[spherical + k] =
                    if k == 1 { random.random_range(0.1..3.0) } else { random.random_range(-PI..PI) };
            }
        }
        if set == Set::NearSingular {
            let away = 10.0_f64.powi(-2 - i32::try_from(index % 5).unwrap_or(0));
            let Some((singular, joint)) = singular_near(&open, planted) else { continue };
            planted = singular;
            planted[joint] += away;
        }
        if data == Data::Decimals {
            for (q, variable) in planted.iter_mut().zip(variables) {
                *q = match variable {
                    Variable::Rotation => data.angle(*q).radians(),
                    Variable::Translation => data.number(*q).to_f64(),
                };
            }
        }
        let regularity = regularity(&open, &planted);
        if regularity < set.least_regularity() {
            continue;
        }
        let Some(placement) = reached(data, &chain, &variables, &planted)? else { continue };
        let case = Case::at(placement, 0);
        let entry = Entry {
            name: format!("sample {index}"),
            title: format!("random arm {index} of seed {seed}"),
            source: None,
            notes: None,
            design: Design::Arm(chain.clone()),
            limits: Vec::new(),
            platform_limits: PlatformLimits::default(),
            cases: vec![case],
            rounded: data == Data::Floats,
            reading: Reading::default(),
            labels: Labels::default(),
        };
        return Ok(Sample { entry, chain, planted, variables, regularity });
    }
}

/// Returns the pose that an arm reaches.
fn reached(data: Data, chain: &Chain, variables: &[Variable; 6], planted: &[f64; 6]) -> Result<Option<Placement>> {
    if data == Data::Floats {
        let pose = chain.forward::<f64>(&motions(variables, planted));
        return pose.map(|pose| Ok(Placement::from_matrix(&matrix(&pose))?.0)).transpose();
    }
    let motion = |k: usize| match variables[k] {
        Variable::Rotation => angle_motion(&data.angle(planted[k])),
        Variable::Translation => distance_motion(&data.number(planted[k])),
    };
    let motions: Option<Vec<Motion<Rational>>> = (0..6).map(motion).collect();
    Ok(motions.and_then(|motions| chain.forward(&motions)).map(Placement::from_motion_exact))
}

pub(super) fn matrix(pose: &Motion<f64>) -> [[Number; 4]; 4] {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| match (i, j) {
            (3, _) => Number::exact(Rational::from(u32::from(j == 3))),
            (_, 3) => Number::from_f64(pose.translation[i]),
            _ => Number::from_f64(pose.rotation[i][j]),
        })
    })
}

/// Returns the motions of joint variables.
#[must_use]
pub fn motions(variables: &[Variable; 6], values: &[f64; 6]) -> [Motion<f64>; 6] {
    std::array::from_fn(|k| match variables[k] {
        Variable::Rotation => Motion::rotation_z(values[k].cos(), values[k].sin()),
        Variable::Translation => Motion::translation_z(values[k]),
    })
}

fn value(set: Set, variable: Variable, random: &mut ChaCha8Rng) -> f64 {
    match variable {
        Variable::Translation => random.random_range(-2.0..2.0),
        Variable::Rotation if matches!(set, Set::SpecialChain(_)) && random.random_bool(0.6) => {
            0.5 * PI * f64::from(random.random_range(-1..3))
        }
        Variable::Rotation => random.random_range(-PI..PI),
    }
}

fn joint(set: Set, data: Data, kind: JointKind, random: &mut ChaCha8Rng) -> Joint {
    let length = |random: &mut ChaCha8Rng| {
        let x: f64 = random.random_range(-1.0..1.0);
        match set {
            _ if set.is_structured() && random.random_bool(0.4) => 0.0,
            Set::BadlyScaled => x.signum() * 10.0_f64.powf(3.0 * x.abs() - 3.0),
            _ => x,
        }
    };
    let (a, d) = (length(random), length(random));
    let free = random.random_range(-PI..PI);
    let right = |numerator: i32| Angle::from_half_tangent(HalfTangent::Finite(Rational::from(numerator)));
    let structured = set.is_structured();
    let alpha = match random.random_range(0..10) {
        0..3 if structured => Angle::zero(),
        3..5 if structured => right(1),
        5..7 if structured => right(-1),
        7 if structured => Angle::from_half_tangent(HalfTangent::Infinite),
        _ => data.angle(free),
    };
    let mut off = |x: f64| if set == Set::Calibrated { x + random.random_range(-1e-6..1e-6) } else { x };
    let (a, d) = (off(a), off(d));
    let alpha = if set == Set::Calibrated { Angle::from_radians(off(alpha.radians())) } else { alpha };
    // The constant angle of a prismatic joint; offsets of variables are left at zero.
    let theta0 = match kind {
        JointKind::Prismatic if structured && random.random_bool(0.6) => right(random.random_range(-1..2)),
        JointKind::Prismatic => data.angle(random.random_range(-PI..PI)),
        _ => Angle::zero(),
    };
    let d = if kind == JointKind::Revolute { data.number(d) } else { Number::zero() };
    Joint { kind, a: data.number(a), alpha, d, theta0, pitch: None }
}

/// Returns the Jacobian at a configuration, as the twists of the axes in the base frame.
fn jacobian(open: &OpenLoop<f64>, q: &[f64; 6]) -> Matrix6<f64> {
    let here = closure(&open.close(&Motion::identity()), q);
    Matrix6::from_fn(|i, j| here.jacobian[i][j])
}

fn regularity(open: &OpenLoop<f64>, q: &[f64; 6]) -> f64 {
    let values = finite(jacobian(open, q)).singular_values();
    values.min() / values.max()
}

/// Returns a singular configuration, by bisection of the determinant along joint 3, else 4, else 5; and the index of that joint.
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
