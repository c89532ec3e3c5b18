//! Overconstrained loops with a small error in one link: none of them may be called mobile.

use crate::kinematics::dual_quaternion::DualQuaternion;
use crate::mobility::{Linkage, moves};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use rug::{Integer, Rational};

/// Powers of ten of the errors: 1e-3 to 1e-9.
const SIZES: std::ops::RangeInclusive<u32> = 3..=9;

/// What became of the disturbed loops of one kind.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// How many were looked at.
    pub count: usize,
    /// Proved to be immobile.
    pub immobile: usize,
    /// Not decided.
    pub undecided: usize,
    /// Called mobile: the numbers of their draws.
    pub mobile: Vec<u64>,
}

/// A loop with a small motion added behind one of its links, another one for every seed and number: a rotation and a
/// translation of 1e-3 to 1e-9, in radians and in lengths of the links.
#[must_use]
pub fn disturbed(linkage: &Linkage<Rational>, seed: u64, number: u64) -> Linkage<Rational> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(number);
    let size = Integer::from(Integer::u_pow_u(10, random.random_range(SIZES)));
    let unit = linkage.unit();
    let mut error = || Rational::from((random.random_range(-1000..=1000_i32), 1000)) / &size;
    let turn = [Rational::from(1), error(), error(), error()];
    let shift = [error(), error(), error()].map(|x| x * &unit);
    let zero = || Rational::new();
    let rotation = DualQuaternion::from_study(&turn, &[zero(), zero(), zero(), zero()]);
    let motion = DualQuaternion::translation(&shift).mul(&rotation);
    let link = random.random_range(0..linkage.links.len());
    linkage.with_error(link, &motion)
}

/// Disturbs a loop so many times, on all threads of the current pool, and decides whether what comes out moves. `running` is
/// asked now and then and stops the run; `tick` is called for every loop.
#[must_use]
pub fn run(
    linkage: &Linkage<Rational>,
    count: u64,
    seed: u64,
    running: impl Fn() -> bool + Sync,
    tick: impl Fn() + Sync,
) -> Tally {
    let decide = |number: u64| {
        if !running() {
            return None;
        }
        let answer = moves(&disturbed(linkage, seed, number));
        tick();
        Some((number, answer))
    };
    let answers: Vec<(u64, Option<bool>)> = (0..count).into_par_iter().filter_map(decide).collect();
    let mut tally = Tally { count: answers.len(), ..Tally::default() };
    for (number, answer) in answers {
        match answer {
            Some(false) => tally.immobile += 1,
            None => tally.undecided += 1,
            Some(true) => tally.mobile.push(number),
        }
    }
    tally
}
