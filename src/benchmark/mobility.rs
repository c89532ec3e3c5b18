//! Overconstrained mechanisms with a small error: none may be called mobile, and their configurations must be counted right.

use crate::algebra::modp::{ModP, PRIME_62};
use crate::algebra::number::Number;
use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::entry::{Case, Design, Entry};
use crate::elimination::coordinate_ring::Plan;
use crate::kinematics::chain::{Chain, Geometry, Placement};
use crate::kinematics::dual_quaternion::DualQuaternion;
use crate::kinematics::motion::Motion;
use crate::mechanism::{Mechanism, closed_loop};
use crate::mobility::{self, Linkage, at_most, moves};
use crate::verdict::{Status, Verdict};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use rug::{Integer, Rational};
use std::cmp::Ordering;

/// Powers of ten of the errors: 1e-3 to 1e-9.
pub(super) const SIZES: std::ops::RangeInclusive<u32> = 3..=9;

/// The results for the disturbed mechanisms of one kind.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Number of mechanisms.
    pub count: usize,
    /// Proved to be immobile.
    pub immobile: usize,
    /// Not decided.
    pub undecided: usize,
    /// The draws called mobile, by number.
    pub mobile: Vec<u64>,
    /// Number of loops passed to `solve`.
    pub asked: usize,
    /// Number of loops for which `solve` reports a complete list of configurations.
    pub solved: usize,
    /// Number of these loops whose number of configurations is confirmed by an exact count.
    pub counted: usize,
    /// The draws of these loops that an exact count contradicts, by number.
    pub miscounted: Vec<u64>,
    /// Configurations of all solved loops, complex and real.
    pub configurations: (usize, usize),
}

impl Tally {
    /// Adds two tallies.
    pub(super) fn and(mut self, mut other: Self) -> Self {
        self.count += other.count;
        self.immobile += other.immobile;
        self.undecided += other.undecided;
        self.mobile.append(&mut other.mobile);
        self.asked += other.asked;
        self.solved += other.solved;
        self.counted += other.counted;
        self.miscounted.append(&mut other.miscounted);
        self.configurations.0 += other.configurations.0;
        self.configurations.1 += other.configurations.1;
        self
    }

    /// Returns the tally of one mechanism, by whether it moves.
    pub(super) fn of(number: u64, moves: Option<bool>) -> Self {
        Self {
            count: 1,
            immobile: usize::from(moves == Some(false)),
            undecided: usize::from(moves.is_none()),
            mobile: if moves == Some(true) { vec![number] } else { Vec::new() },
            ..Self::default()
        }
    }
}

/// Returns the random numbers of a draw, which depend on seed and number.
pub(super) fn stream(seed: u64, number: u64) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(number);
    random
}

/// Returns a loop with a small motion added behind one of its joints, which depends on seed and number: a rotation and a
/// translation of 1e-3 to 1e-9, in radians and in lengths of the links.
#[must_use]
pub fn disturbed(entry: &Entry, seed: u64, number: u64) -> Option<Entry> {
    let chain = entry.chain()?;
    let mut random = stream(seed, number);
    let size = Integer::from(Integer::u_pow_u(10, random.random_range(SIZES)));
    let unit = Linkage::of(chain).ok()?.unit();
    let mut error = || Rational::from((random.random_range(-1000..=1000_i32), 1000)) / &size;
    let turn = [Rational::from(1), error(), error(), error()];
    let shift = [error(), error(), error()].map(|x| x * &unit);
    let zero = || Rational::new();
    let rotation = DualQuaternion::from_study(&turn, &[zero(), zero(), zero(), zero()]);
    let motion = DualQuaternion::translation(&shift).mul(&rotation).to_motion()?;
    let joint = random.random_range(0..chain.joint_kinds().len());
    Some(Entry { design: Design::Loop(with_error(chain, joint, &motion)), cases: vec![Case::free(0)], ..entry.clone() })
}

/// Returns the chain with a motion behind one of its joints.
fn with_error(chain: &Chain, joint: usize, motion: &Motion<Rational>) -> Chain {
    let behind = |placement: &Placement| Placement::from_motion_exact(motion.then_after(&placement.exact));
    let mut chain = chain.clone();
    match &mut chain.geometry {
        // A loop has no beginning, so the joint becomes the last one and the motion stands behind the chain.
        Geometry::Dh(joints) | Geometry::ModifiedDh(joints) => {
            let is_bare = *chain.base.exact == Motion::identity() && *chain.tool.exact == Motion::identity();
            if is_bare {
                joints.rotate_left(joint + 1);
            }
            chain.tool = behind(&chain.tool);
        }
        // The joints behind this one are moved.
        Geometry::Screws { joints, home } => {
            for screw in joints.iter_mut().skip(joint + 1) {
                let exact = |v: &[Number; 3]| v.each_ref().map(|x| x.rational().clone());
                screw.axis = motion.rotate(&exact(&screw.axis)).map(Number::exact);
                screw.point = motion.apply(&exact(&screw.point)).map(Number::exact);
            }
            **home = behind(home);
        }
    }
    chain
}

/// Disturbs a loop `count` times, on all threads of the current pool, and decides whether the results move. The first
/// `solved` of them are solved as well, and their configurations counted. `running` is called now and then and stops the run;
/// `tick` is called for every loop.
#[must_use]
pub fn run(
    entry: &Entry,
    (count, solved): (u64, u64),
    seed: u64,
    running: impl Fn() -> bool + Sync,
    tick: impl Fn() + Sync,
) -> Tally {
    let one = |number: u64| {
        if !running() {
            return None;
        }
        let tally = disturbed(entry, seed, number).and_then(|disturbed| judged(&disturbed, number, number < solved));
        tick();
        tally
    };
    (0..count).into_par_iter().filter_map(one).reduce(Tally::default, Tally::and)
}

/// Returns a bound on the number of configurations by the ring of the loop, modulo a prime that `solve` does not use.
fn ring_modulo_another_prime(entry: &Entry) -> Option<usize> {
    let (_, closed) = closed_loop::<ModP<PRIME_62>>(entry.chain()?, &entry.cases[0]).ok()??;
    Plan::of(&closed).map(|plan| plan.count())
}

/// Returns the results for one loop, by itself and by `solve`.
fn judged(entry: &Entry, number: u64, is_solved: bool) -> Option<Tally> {
    let linkage = Linkage::of(entry.chain()?).ok()?;
    let mut tally = Tally::of(number, moves(&linkage));
    if !is_solved {
        return Some(tally);
    }
    tally.asked = 1;
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    let solution =
        Mechanism::prepare(entry).and_then(|m| m.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly));
    let is_complete = |verdict: &Verdict| matches!(verdict.status, Status::Complete | Status::Unreachable);
    let Some(verdict) = solution.ok().map(|solution| solution.verdict).filter(is_complete) else {
        return Some(tally);
    };
    tally.solved = 1;
    tally.configurations = (verdict.complex, verdict.real);
    let is_right = if linkage.variables.len() < 6 {
        mobility::count(&linkage).map(|exact| exact == verdict.complex)
    } else {
        // The bound is met, and all of the listed configurations are certified.
        let most = ring_modulo_another_prime(entry).filter(|most| *most <= verdict.complex);
        most.or_else(|| at_most(&linkage, verdict.complex)).and_then(|most| match verdict.complex.cmp(&most) {
            Ordering::Equal => Some(true),
            Ordering::Greater => Some(false),
            Ordering::Less => None,
        })
    };
    match is_right {
        Some(true) => tally.counted = 1,
        Some(false) => tally.miscounted.push(number),
        None => {}
    }
    Some(tally)
}
