//! Nine general points with all their four-bars, from which the paths to other points start.
//!
//! They were found by monodromy from one four-bar: as the points go round a loop, four-bars change places. Those of one class are kept
//! once. The file `start.bin` holds them as f32 in little-endian order, real part before imaginary part: the eight places beside the
//! first point, each as d and e, then x, x*, a, a*, y, y*, b, b* of each four-bar. Newton's method gives their other digits. The test
//! `monodromy_finds_the_start` makes the file.

use super::curve::UNKNOWNS;
use super::homotopy::{FourBar, Moving, PLACES, Places};
use crate::solve::paths::Family;
use num_complex::Complex;
use std::sync::OnceLock;

/// The number of four-bars through nine general points, cognates and the exchange of the dyads not counted. \[WamplerMorganSommese1992\]
pub const GENERAL: usize = 1442;

static DATA: &[u8] = include_bytes!("start.bin");

/// General points and their four-bars.
pub struct Start {
    pub places: Places,
    pub four_bars: Vec<FourBar>,
}

/// Returns the start of all paths.
pub fn start() -> &'static Start {
    static START: OnceLock<Start> = OnceLock::new();
    START.get_or_init(|| Start::of(DATA))
}

impl Start {
    fn of(bytes: &[u8]) -> Self {
        let numbers: Vec<f64> = bytes
            .chunks_exact(4)
            .map(|four| f64::from(f32::from_le_bytes([four[0], four[1], four[2], four[3]])))
            .collect();
        let complex: Vec<Complex<f64>> = numbers.chunks_exact(2).map(|pair| Complex::new(pair[0], pair[1])).collect();
        let (first, rest) = complex.split_at(2 * PLACES);
        let places: Places = std::array::from_fn(|j| [first[2 * j], first[2 * j + 1]]);
        let still = Moving { start: &places, target: &places };
        let refined = |unknowns: &[Complex<f64>]| {
            let rounded = std::array::from_fn(|k| if k == 0 { Complex::from(1.0) } else { unknowns[k - 1] });
            still.corrected(Complex::from(0.0), &rounded).map(|(v, _)| v)
        };
        let four_bars = rest.chunks_exact(UNKNOWNS - 1).filter_map(refined).collect();
        Self { places, four_bars }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::paths::arc;
    use crate::synthesis::path::class::{affine, distinct};
    use crate::synthesis::path::trace::trace;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rayon::prelude::*;

    #[test]
    fn the_start_is_whole() {
        let Start { places, four_bars } = start();
        assert_eq!(distinct(four_bars.iter().copied()).len(), GENERAL);
        let whole = trace(places, four_bars, 1).expect("the pencil is followed");
        assert!(whole.defect < 1e-9 * whole.median, "{whole:?}");
        let one_less = trace(places, &four_bars[1..], 1).expect("the pencil is followed");
        assert!(one_less.defect > 1e-6 * one_less.median, "{one_less:?}");
    }

    /// Grows one four-bar to all of them, and compares the number, or writes the file with `LOOPROOT_BLESS=1`: a minute with
    /// `cargo test --release -- --ignored monodromy`.
    #[test]
    #[ignore = "takes a minute: cargo test --release --lib -- --ignored monodromy"]
    #[expect(clippy::cast_possible_truncation, reason = "numbers of the file have 24 bits")]
    fn monodromy_finds_the_start() {
        let random = &mut ChaCha8Rng::seed_from_u64(1992);
        let turn = |random: &mut ChaCha8Rng| Complex::from_polar(1.0, random.random_range(0.0..std::f64::consts::TAU));
        // Numbers of 24 bits, as they stand in the file.
        let short = |z: Complex<f64>| Complex::new(f64::from(z.re as f32), f64::from(z.im as f32));
        let general = |random: &mut ChaCha8Rng| -> Places {
            std::array::from_fn(|_| [(); 2].map(|()| short(turn(random) * random.random_range(0.4..1.2))))
        };
        // A four-bar with numbers drawn, and points where its coupler has turns drawn: of the two equations of the links, which hold d e, the
        // difference is linear.
        let four_bar: FourBar =
            std::array::from_fn(
                |k| if k == 0 { Complex::from(1.0) } else { turn(random) * random.random_range(0.2..1.0) },
            );
        let first: Places = std::array::from_fn(|_| {
            let t = turn(random) * random.random_range(0.5..2.0);
            let link = |[x, x_star, a, a_star]: [Complex<f64>; 4]| {
                [x_star / t - a_star, t * x - a, x * a_star + x_star * a - t * x * a_star - x_star * a / t]
            };
            let [_, x, x_star, a, a_star, y, y_star, b, b_star] = four_bar;
            let (one, other) = (link([x, x_star, a, a_star]), link([y, y_star, b, b_star]));
            let slope = -(one[0] - other[0]) / (one[1] - other[1]);
            let shift = -(one[2] - other[2]) / (one[1] - other[1]);
            let half = 0.5 * (one[0] + one[1] * slope + shift) / slope;
            let d = (half * half - (one[1] * shift + one[2]) / slope).sqrt() - half;
            [d, slope * d + shift]
        });
        let places = [general(random), general(random)];
        let carry = |start: &Places, target: &Places, bend: Complex<f64>, four_bars: &[FourBar]| -> Vec<FourBar> {
            let moving = Moving { start, target };
            four_bars.par_iter().filter_map(|v| moving.follow(|s| arc(bend, s), v, 1.0, 0.0, 3000)).collect()
        };
        let mut known = [carry(&first, &places[0], turn(random), &[four_bar]), Vec::new()];
        let mut unchanged = 0;
        while unchanged < 6 {
            let before = known[0].len() + known[1].len();
            for (from, to) in [(0, 1), (1, 0)] {
                let found = carry(&places[from], &places[to], turn(random), &known[from]);
                known[to] = distinct(known[to].iter().chain(&found).copied());
            }
            unchanged = if known[0].len() + known[1].len() == before { unchanged + 1 } else { 0 };
        }
        assert_eq!(known.each_ref().map(Vec::len), [GENERAL; 2]);
        if std::env::var_os("LOOPROOT_BLESS").is_some() {
            let numbers = places[0].iter().flatten().copied();
            let numbers = numbers.chain(known[0].iter().flat_map(affine));
            let bytes: Vec<u8> = numbers.flat_map(|z| [z.re as f32, z.im as f32]).flat_map(f32::to_le_bytes).collect();
            assert_eq!(bytes.len(), 8 * (2 * PLACES + (UNKNOWNS - 1) * GENERAL));
            std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/src/synthesis/path/start.bin"), bytes).unwrap();
        }
    }
}
