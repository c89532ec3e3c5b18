//! Configurations that come nearest to a pose, by least squares.

use super::single_loop::SingleLoop;
use crate::kinematics::chain::Placement;
use crate::kinematics::forward::Forward;
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::Motion;
use crate::kinematics::tolerance::{PoseError, Tolerance};
use looproot_calculus::finite::finite;
use nalgebra::{DMatrix, DVector, Dyn, SVD};
use std::f64::consts::{PI, TAU};

/// Steps of the search: each one squares what is missing, or halves it at a double root.
const STEPS: usize = 40;
/// Singular values below this part of the largest one count as zero.
const RANK: f64 = 1e-10;
/// Steps are damped by these parts of the largest singular value where none along the undamped step helps: beside a singular posture the
/// undamped one leads far away. The last one is short where the pose is far.
const DAMPED: [f64; 5] = [1e-4, 1e-3, 1e-2, 1e-1, 1.0];

/// Configurations whose joints all agree so far, in radians or metres, are listed once.
const SAME: f64 = 1e-3;
/// Starts of the search all over the joints: more than a general arm has solutions, and some milliseconds.
const STARTS: u32 = 24;
/// Half the range of the translations of the starts, in reaches of the arm.
const TRAVEL: f64 = 0.5;

/// Returns the configuration of an arm that comes nearest to a pose, and by how much it misses, where least squares look for it from
/// places all over: the joints `moving` are spread, the others stay as they are in `start`. A metre counts as much as a radian.
pub(super) fn nearest_of_all(
    forward: &Forward,
    start: &[f64],
    moving: &[usize],
    wanted: &Motion<f64>,
) -> Option<(Vec<f64>, PoseError)> {
    let even = Tolerance { length: 1.0, angle: 1.0 };
    let found = starts(forward, start, moving).map(|from| nearest(forward, &from, moving, wanted, even));
    let size = |miss: &PoseError| miss.position.hypot(miss.orientation);
    let (mut q, miss) = found.min_by(|(_, one), (_, other)| size(one).total_cmp(&size(other)))?;
    within_a_turn(forward, &mut q);
    Some((q, miss))
}

/// Returns the starts of the search all over the joints.
fn starts(forward: &Forward, start: &[f64], moving: &[usize]) -> impl Iterator<Item = Vec<f64>> {
    let travel = TRAVEL * forward.reach();
    (0..STARTS).map(move |trial| {
        let mut from = start.to_vec();
        for (place, joint) in (0..).zip(moving) {
            let half = if forward.variables()[*joint] == Variable::Rotation { PI } else { travel };
            from[*joint] = half * scattered(trial, place);
        }
        from
    })
}

/// Turns all rotations to angles between -pi and pi.
fn within_a_turn(forward: &Forward, q: &mut [f64]) {
    for (value, variable) in q.iter_mut().zip(forward.variables()) {
        if *variable == Variable::Rotation {
            *value -= TAU * (*value / TAU).round();
        }
    }
}

impl SingleLoop {
    /// Returns the configuration of an arm that comes nearest to a pose of all that the search finds.
    pub(super) fn nearest(&self, pose: &Placement) -> Option<(Vec<f64>, PoseError)> {
        let forward = self.forward.get_or_init(|| Forward::of(&self.chain)).as_ref()?;
        let total = forward.variables().len();
        nearest_of_all(forward, &vec![0.0; total], &(0..total).collect::<Vec<_>>(), &pose.float)
    }

    /// Returns configurations of an arm within the tolerance of a pose that least squares find from the zero position and from places all
    /// over. Those of a near self-motion are a few of many.
    pub(super) fn all_nearest(&self, pose: &Placement, tolerance: Tolerance) -> Vec<(Vec<f64>, PoseError)> {
        let Some(forward) = self.forward.get_or_init(|| Forward::of(&self.chain)).as_ref() else { return Vec::new() };
        let (zero, all) = (vec![0.0; forward.variables().len()], (0..forward.variables().len()).collect::<Vec<_>>());
        let mut found = Vec::<(Vec<f64>, PoseError)>::new();
        for from in std::iter::once(zero.clone()).chain(starts(forward, &zero, &all)) {
            let (mut q, miss) = nearest(forward, &from, &all, &pose.float, tolerance);
            within_a_turn(forward, &mut q);
            let is_known = |other: &Vec<f64>| q.iter().zip(other).all(|(x, y)| (x - y).abs() < SAME);
            if tolerance.allows(&miss) && !found.iter().any(|(other, _)| is_known(other)) {
                found.push((q, miss));
            }
        }
        found
    }
}

/// Returns a number of a sequence that fills the interval from -1 to 1 evenly, another one for every place: multiples of the square roots of
/// primes, which are independent over the rationals.
fn scattered(trial: u32, place: usize) -> f64 {
    const PRIMES: [f64; 8] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0];
    2.0 * (f64::from(trial) * PRIMES[place % PRIMES.len()].sqrt()).fract() - 1.0
}

/// The configuration near `start` that comes nearest to a pose, in units of the tolerance, and by how much it misses.
pub(super) fn nearest(
    forward: &Forward,
    start: &[f64],
    moving: &[usize],
    wanted: &Motion<f64>,
    tolerance: Tolerance,
) -> (Vec<f64>, PoseError) {
    let mut q = start.to_vec();
    let scale = |miss: &PoseError| (miss.position / tolerance.length).hypot(miss.orientation / tolerance.angle);
    let mut best = PoseError::between(&forward.pose(&q), wanted);
    for _ in 0..STEPS {
        let (reached, twists) = forward.jacobian(&q);
        let matrix = DMatrix::from_fn(6, moving.len(), |i, j| {
            let twist = &twists[moving[j]];
            if i < 3 { twist.linear[i] / tolerance.length } else { twist.angular[i - 3] / tolerance.angle }
        });
        let turned = reached.turn_to(wanted);
        let residual = DVector::from_fn(6, |i, _| match i {
            0..3 => (wanted.translation[i] - reached.translation[i]) / tolerance.length,
            _ => turned[i - 3] / tolerance.angle,
        });
        let svd = finite(matrix).svd(true, true);
        let largest = svd.singular_values.max();
        let Ok(step) = svd.solve(&residual, RANK * largest) else { break };
        let moved = |step: &DVector<f64>, part: f64| {
            let mut there = q.clone();
            for (value, joint) in step.iter().zip(moving) {
                there[*joint] += value * part;
            }
            let miss = PoseError::between(&forward.pose(&there), wanted);
            (there, miss)
        };
        // A step that does not help is halved; at the nearest configuration none helps.
        let halved = (0..6).map(|halvings| moved(&step, 0.5_f64.powi(halvings)));
        let damped = DAMPED.iter().filter_map(|part| Some(moved(&damped(&svd, &residual, part * largest)?, 1.0)));
        let Some((there, miss)) = halved.chain(damped).find(|(_, miss)| scale(miss) < scale(&best)) else { break };
        (q, best) = (there, miss);
    }
    (q, best)
}

/// The step of least squares that is damped by so much.
fn damped(svd: &SVD<f64, Dyn, Dyn>, residual: &DVector<f64>, by: f64) -> Option<DVector<f64>> {
    let (left, right) = (svd.u.as_ref()?, svd.v_t.as_ref()?);
    let mut along = left.tr_mul(residual);
    for (value, own) in along.iter_mut().zip(&svd.singular_values) {
        *value *= own / (own * own + by * by);
    }
    Some(right.tr_mul(&along))
}
