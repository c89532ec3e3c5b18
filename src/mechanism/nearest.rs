//! Configurations that come nearest to a pose, by least squares.

use crate::kinematics::forward::Forward;
use crate::kinematics::motion::Motion;
use crate::kinematics::tolerance::{PoseError, Tolerance};
use looproot_calculus::finite::finite;
use nalgebra::{DMatrix, DVector, Dyn, SVD};

/// Steps of the search: each one squares what is missing, or halves it at a double root.
const STEPS: usize = 40;
/// Singular values below this part of the largest one count as zero.
const RANK: f64 = 1e-10;
/// Steps are damped by these parts of the largest singular value where none along the undamped step helps: beside a singular posture the
/// undamped one leads far away.
const DAMPED: [f64; 3] = [1e-4, 1e-3, 1e-2];

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
        let turned = rotation_vector(&reached, wanted);
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

/// The rotation from one orientation to another as a vector along its axis, as long as its angle; small angles are meant.
fn rotation_vector(from: &Motion<f64>, to: &Motion<f64>) -> [f64; 3] {
    let entry = |i: usize, j: usize| (0..3).map(|k| to.rotation[i][k] * from.rotation[j][k]).sum::<f64>();
    [entry(2, 1) - entry(1, 2), entry(0, 2) - entry(2, 0), entry(1, 0) - entry(0, 1)].map(|x| x / 2.0)
}
