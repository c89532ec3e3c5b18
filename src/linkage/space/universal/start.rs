//! A general plate on three UPU legs with all its poses, from which the paths to other plates start.
//!
//! The poses were found by monodromy from one: as the legs go round a loop, poses change places. The file `start.bin` holds them as f32 in
//! little-endian order, real part before imaginary part: for each leg the points in base and plate, the axes in base and plate and the
//! squared length, then x and y of each pose. Newton's method gives the other digits of the poses. The test
//! `monodromy_finds_the_start` makes such a file.

use super::paths::{Legs, Moving, Pose};
use crate::closure::universal_leg::UniversalLeg;
use crate::solve::paths::Family;
use num_complex::Complex;
use std::sync::OnceLock;

/// The number of poses of this plate; Gröbner bases modulo 32003 of another program count as many for general ones.
pub(super) const GENERAL: usize = 84;

static DATA: &[u8] = include_bytes!("start.bin");

/// Numbers of a leg: two points, two axes, a squared length.
const NUMBERS: usize = 13;

/// General legs and their poses.
pub(super) struct Start {
    pub legs: Legs,
    pub poses: Vec<Pose>,
}

/// Returns the start of all paths.
pub(super) fn start() -> &'static Start {
    static START: OnceLock<Start> = OnceLock::new();
    START.get_or_init(|| Start::of(DATA))
}

/// Returns the leg of these numbers.
fn leg(numbers: &[Complex<f64>]) -> UniversalLeg<Complex<f64>> {
    let vector = |from: usize| std::array::from_fn(|i| numbers[from + i]);
    UniversalLeg::new([&vector(0), &vector(3)], numbers[12], [&vector(6), &vector(9)])
}

/// Returns three legs, one after the other.
fn legs(numbers: &[Complex<f64>]) -> Legs {
    std::array::from_fn(|k| leg(&numbers[NUMBERS * k..]))
}

impl Start {
    fn of(bytes: &[u8]) -> Self {
        let numbers: Vec<f64> = bytes
            .chunks_exact(4)
            .map(|four| f64::from(f32::from_le_bytes([four[0], four[1], four[2], four[3]])))
            .collect();
        let complex: Vec<Complex<f64>> = numbers.chunks_exact(2).map(|pair| Complex::new(pair[0], pair[1])).collect();
        let (first, rest) = complex.split_at(3 * NUMBERS);
        let legs = legs(first);
        let still = Moving { start: &legs, target: &legs };
        let refined = |pose: &[Complex<f64>]| {
            still.corrected(Complex::from(0.0), &std::array::from_fn(|k| pose[k])).map(|(v, _)| v)
        };
        let poses = rest.chunks_exact(8).filter_map(refined).collect();
        Self { legs, poses }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linkage::space::universal::paths::is_pose;
    use crate::solve::paths::{arc, unit};
    use looproot_calculus::quaternion::Quaternion;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rayon::prelude::*;

    /// Returns whether two unit vectors are one point up to a factor.
    fn is_same(v: &Pose, w: &Pose) -> bool {
        let product: Complex<f64> = v.iter().zip(w).map(|(a, b)| a.conj() * b).sum();
        // Points of a list are followed to 1e-9, and are that far apart only where they are double.
        product.norm_sqr() > 1.0 - 1e-14
    }

    /// Returns the poses of a list of unit vectors, each once.
    fn distinct(poses: impl IntoIterator<Item = Pose>) -> Vec<Pose> {
        let mut list: Vec<Pose> = Vec::new();
        for pose in poses {
            if !list.iter().any(|own| is_same(own, &pose)) {
                list.push(pose);
            }
        }
        list
    }

    #[test]
    fn the_start_is_whole() {
        let Start { poses, .. } = start();
        assert_eq!(distinct(poses.iter().copied()).len(), GENERAL);
        assert!(poses.iter().all(is_pose));
    }

    /// Grows one pose to all of them, and compares the number, or writes the file with `LOOPROOT_BLESS=1`.
    #[test]
    #[ignore = "takes some seconds: cargo test --release --lib -- --ignored universal"]
    #[expect(clippy::cast_possible_truncation, reason = "numbers of the file have 24 bits")]
    fn monodromy_finds_the_start() {
        let random = &mut ChaCha8Rng::seed_from_u64(1996);
        let short = |z: Complex<f64>| Complex::new(f64::from(z.re as f32), f64::from(z.im as f32));
        let turn = |random: &mut ChaCha8Rng| Complex::from_polar(1.0, random.random_range(0.0..std::f64::consts::TAU));
        let draw = |random: &mut ChaCha8Rng| short(turn(random) * random.random_range(0.4..1.2));
        let general =
            |random: &mut ChaCha8Rng| -> Vec<Complex<f64>> { (0..3 * NUMBERS).map(|_| draw(random)).collect() };
        // A pose, and legs through it: the axis in the base is made perpendicular to the product of the other one and the leg.
        let mut first = general(random);
        let [scalar, a, b, c] = [(); 4].map(|()| draw(random));
        let x = Quaternion { scalar, vector: [a, b, c] };
        let place = [(); 3].map(|()| draw(random));
        let y = Quaternion { scalar: Complex::from(0.0), vector: place }.mul(&x);
        let pose: Pose =
            [x.scalar, x.vector[0], x.vector[1], x.vector[2], y.scalar, y.vector[0], y.vector[1], y.vector[2]];
        for own in first.chunks_mut(NUMBERS) {
            own[12] = Complex::from(0.0);
            let probe = leg(own);
            let [x, y]: [[Complex<f64>; 4]; 2] = [0, 4].map(|from| std::array::from_fn(|k| pose[from + k]));
            let values = probe.values(&x, &y, |z, c| z * c);
            let norm: Complex<f64> = x.iter().map(|z| z * z).sum();
            own[12] = values[0] / norm;
            // The form of the axes is linear in the first axis: its last entry makes it 0.
            let with = |last: Complex<f64>| {
                let mut own = own.to_vec();
                own[8] = last;
                leg(&own).values(&x, &y, |z, c| z * c)[1]
            };
            let (zero, one) = (with(Complex::from(0.0)), with(Complex::from(1.0)));
            own[8] = zero / (zero - one);
        }
        let first = legs(&first);
        let numbers = [general(random), general(random)];
        let places = numbers.each_ref().map(|numbers| legs(numbers));
        let carry = |start: &Legs, target: &Legs, bend: Complex<f64>, poses: &[Pose]| -> Vec<Pose> {
            let moving = Moving { start, target };
            poses.par_iter().filter_map(|v| moving.follow(|s| arc(bend, s), v, 1.0, 0.0, 3000)).collect()
        };
        let mut known = [carry(&first, &places[0], turn(random), &[unit(&pose).unwrap()]), Vec::new()];
        let mut unchanged = 0;
        while unchanged < 6 {
            let before = known[0].len() + known[1].len();
            for (from, to) in [(0, 1), (1, 0)] {
                let found = carry(&places[from], &places[to], turn(random), &known[from]);
                known[to] = distinct(known[to].iter().chain(&found).copied().filter(is_pose));
            }
            unchanged = if known[0].len() + known[1].len() == before { unchanged + 1 } else { 0 };
        }
        assert_eq!(known.each_ref().map(Vec::len), [GENERAL; 2]);
        if std::env::var_os("LOOPROOT_BLESS").is_some() {
            let numbers = numbers[0].iter().chain(known[0].iter().flatten());
            let bytes: Vec<u8> = numbers.flat_map(|z| [z.re as f32, z.im as f32]).flat_map(f32::to_le_bytes).collect();
            std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/src/linkage/space/universal/start.bin"), bytes)
                .unwrap();
        }
    }
}
