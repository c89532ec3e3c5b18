//! Random platforms with a planted pose, the same ones for the same seed. All coordinates are multiples of 2^-20, so that
//! special geometries are exactly special.

use crate::algebra::number::{Number, Reading};
use crate::catalogue::entry::{Case, Design, Entry, Labels};
use crate::error::Result;
use crate::kinematics::chain::Placement;
use crate::kinematics::motion::Motion;
use crate::kinematics::platform::Platform;
use crate::kinematics::platform_limits::PlatformLimits;
use crate::kinematics::velocity::velocity;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rug::Rational;

/// The families of random platforms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlatformSet {
    /// Points in a cube.
    General,
    /// Points of the base in a plane.
    PlanarBase,
    /// Points of the moving platform in a plane.
    PlanarPlate,
    /// Points of base and moving platform in planes.
    PlanarBoth,
    /// Plane but for 1e-2, 1e-3, ... 1e-9 in turn.
    NearPlanar,
    /// Hexagons with alternating sides.
    Hexapod,
    /// Points that coincide: the pairs of legs that meet in the base and in the moving platform, counted from 0.
    Shared(&'static [(usize, usize)], &'static [(usize, usize)]),
    /// The moving platform is an affine image of the base.
    Affine,
    /// The moving platform is similar to the base.
    Similar,
    /// The moving platform is congruent to the base.
    Congruent,
    /// The moving platform is similar to the base, and both are plane.
    SimilarPlanar,
}

impl PlatformSet {
    /// All of them by name.
    pub const NAMED: [(&'static str, Self); 24] = [
        ("platform", Self::General),
        ("platform-planar-base", Self::PlanarBase),
        ("platform-planar-plate", Self::PlanarPlate),
        ("platform-planar-both", Self::PlanarBoth),
        ("platform-near-planar", Self::NearPlanar),
        ("platform-hexapod", Self::Hexapod),
        ("platform-6-5", Self::Shared(&[], &[(0, 1)])),
        ("platform-6-4", Self::Shared(&[], &[(0, 1), (2, 3)])),
        ("platform-6-4-triple", Self::Shared(&[], &[(0, 1), (0, 2)])),
        ("platform-6-3", Self::Shared(&[], &[(0, 1), (2, 3), (4, 5)])),
        ("platform-6-3-triple", Self::Shared(&[], &[(0, 1), (0, 2), (3, 4)])),
        ("platform-5-5-a", Self::Shared(&[(0, 1)], &[(1, 2)])),
        ("platform-5-5-b", Self::Shared(&[(0, 1)], &[(2, 3)])),
        ("platform-5-4-a", Self::Shared(&[(0, 1)], &[(1, 2), (3, 4)])),
        ("platform-5-4-b", Self::Shared(&[(0, 1)], &[(2, 3), (4, 5)])),
        ("platform-5-3", Self::Shared(&[(1, 2)], &[(0, 1), (2, 3), (4, 5)])),
        ("platform-4-4-a", Self::Shared(&[(0, 1), (3, 4)], &[(1, 2), (4, 5)])),
        ("platform-4-4-b", Self::Shared(&[(0, 1), (2, 3)], &[(1, 2), (3, 4)])),
        ("platform-4-4-c", Self::Shared(&[(0, 1), (2, 3)], &[(1, 2), (3, 0)])),
        ("platform-3-3", Self::Shared(&[(0, 1), (2, 3), (4, 5)], &[(1, 2), (3, 4), (5, 0)])),
        ("platform-affine", Self::Affine),
        ("platform-similar", Self::Similar),
        ("platform-congruent", Self::Congruent),
        ("platform-similar-planar", Self::SimilarPlanar),
    ];
}

/// One platform, its legs, and the pose they were computed from.
#[derive(Clone, Debug)]
pub struct PlatformSample {
    /// The platform with one set of legs.
    pub entry: Entry,
    /// Its points.
    pub platform: Platform<f64>,
    /// The planted pose.
    pub planted: Motion<f64>,
    /// Smallest over largest singular value of the inverse Jacobian there.
    pub regularity: f64,
}

type Points = [[f64; 3]; 6];

/// Rounds to a multiple of 2^-20.
fn grid(x: f64) -> f64 {
    (x * 1_048_576.0).round() / 1_048_576.0
}

fn cube(random: &mut ChaCha8Rng) -> Points {
    std::array::from_fn(|_| std::array::from_fn(|_| grid(random.random_range(-1.0..1.0))))
}

fn flattened(points: Points) -> Points {
    points.map(|[x, y, _]| [x, y, 0.0])
}

/// Returns the corners of a hexagon with alternating sides: all permutations of three numbers, in cyclic order.
fn hexagon(random: &mut ChaCha8Rng) -> Points {
    let [a, b, c] = std::array::from_fn(|_| grid(random.random_range(-1.0..1.0)));
    [[a, b, c], [b, a, c], [c, a, b], [c, b, a], [b, c, a], [a, c, b]]
}

fn points(set: PlatformSet, index: u64, random: &mut ChaCha8Rng) -> [Points; 2] {
    let (base, plate) = (cube(random), cube(random));
    match set {
        PlatformSet::General => [base, plate],
        PlatformSet::PlanarBase => [flattened(base), plate],
        PlatformSet::PlanarPlate => [base, flattened(plate)],
        PlatformSet::PlanarBoth => [flattened(base), flattened(plate)],
        PlatformSet::NearPlanar => {
            let noise = 10.0_f64.powi(-2 - i32::try_from(index % 8).unwrap_or(0));
            let thin = |points: Points| points.map(|[x, y, z]| [x, y, noise * z]);
            [thin(base), thin(plate)]
        }
        PlatformSet::Hexapod => {
            let mut plate = hexagon(random);
            plate.rotate_left(1);
            [hexagon(random), plate]
        }
        PlatformSet::Shared(in_base, in_plate) => {
            let merged = |mut points: Points, pairs: &[(usize, usize)]| {
                for (kept, moved) in pairs {
                    points[*moved] = points[*kept];
                }
                points
            };
            [merged(base, in_base), merged(plate, in_plate)]
        }
        PlatformSet::Affine => {
            let map: [[f64; 3]; 3] =
                std::array::from_fn(|_| std::array::from_fn(|_| f64::from(random.random_range(-16..=16)) / 8.0));
            [base, base.map(|p| map.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2]))]
        }
        PlatformSet::Similar | PlatformSet::SimilarPlanar => {
            let base = if set == PlatformSet::Similar { base } else { flattened(base) };
            let ratio = f64::from(random.random_range(2..=14)) / 8.0;
            // A ratio of 1 would be the congruent case.
            let ratio = if ratio == 1.0 { 0.75 } else { ratio };
            [base, base.map(|p| p.map(|x| ratio * x))]
        }
        PlatformSet::Congruent => [base, base],
    }
}

/// Sample number `index` of a set.
///
/// # Errors
/// None in practice: the numbers drawn are finite and the quaternions rational.
pub fn sample(set: PlatformSet, seed: u64, index: u64) -> Result<PlatformSample> {
    // Each sample has its own stream, so that it can be drawn alone, on any thread.
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(index);
    loop {
        let [base, plate] = points(set, index, &mut random);
        let platform = Platform { base, plate };
        let quaternion: [i32; 4] = std::array::from_fn(|_| random.random_range(-99..=99));
        let position: [f64; 3] = std::array::from_fn(|_| grid(random.random_range(-2.0..2.0)));
        let Some(pose) = placement(quaternion, position) else { continue };
        let values = velocity(&platform, &pose.float).singular_values;
        let regularity = values[5] / values[0];
        // A pose on a self-motion is not isolated and cannot be planted; one near a self-motion is no fair test.
        if !(regularity > 1e-6) {
            continue;
        }
        let exact = |points: &Points| points.map(|p| p.map(Number::from_f64));
        let numbers = Platform { base: exact(&base), plate: exact(&plate) };
        let planted = pose.float.clone();
        let case = Case::legs_at(&numbers, pose, 0);
        let entry = Entry {
            name: format!("sample {index}"),
            title: format!("random platform {index} of seed {seed}"),
            source: None,
            notes: None,
            design: Design::Platform(Box::new(numbers)),
            limits: Vec::new(),
            platform_limits: PlatformLimits::default(),
            cases: vec![case],
            rounded: false,
            reading: Reading::default(),
            labels: Labels::default(),
        };
        return Ok(PlatformSample { entry, platform, planted, regularity });
    }
}

/// Returns the exact pose of an integer quaternion and a position; `None` for the quaternion 0.
fn placement(quaternion: [i32; 4], position: [f64; 3]) -> Option<Placement> {
    use crate::kinematics::dual_quaternion::Quaternion;
    let [w, x, y, z] = quaternion.map(Rational::from);
    let quaternion = Quaternion { scalar: w, vector: [x, y, z] };
    let norm = quaternion.norm();
    if norm == 0 {
        return None;
    }
    let rotation = quaternion.scaled_rotation().map(|row| row.map(|x| x / &norm));
    let [a, b, c] = position.map(Rational::from_f64);
    Some(Placement::from_motion_exact(Motion { rotation, translation: [a?, b?, c?] }))
}
