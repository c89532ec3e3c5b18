//! Configurations that come nearest to a pose, by least squares.

use crate::kinematics::forward::Forward;
use crate::kinematics::motion::Motion;
use crate::kinematics::tolerance::{PoseError, Tolerance};
use looproot_calculus::finite::finite;
use nalgebra::{DMatrix, DVector};

/// Steps of the search: each one squares what is missing, or halves it at a double root.
const STEPS: usize = 40;
/// Singular values below this part of the largest one count as zero.
const RANK: f64 = 1e-10;

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
        let Ok(step) = svd.solve(&residual, RANK * svd.singular_values.max()) else { break };
        // A step that does not help is halved; at the nearest configuration none helps.
        let tried = (0..6).map(|halvings| {
            let mut there = q.clone();
            for (value, joint) in step.iter().zip(moving) {
                there[*joint] += value * 0.5_f64.powi(halvings);
            }
            let miss = PoseError::between(&forward.pose(&there), wanted);
            (there, miss)
        });
        let Some((there, miss)) = tried.into_iter().find(|(_, miss)| scale(miss) < scale(&best)) else { break };
        (q, best) = (there, miss);
    }
    (q, best)
}

/// The rotation from one orientation to another as a vector along its axis, as long as its angle; small angles are meant.
fn rotation_vector(from: &Motion<f64>, to: &Motion<f64>) -> [f64; 3] {
    let entry = |i: usize, j: usize| (0..3).map(|k| to.rotation[i][k] * from.rotation[j][k]).sum::<f64>();
    [entry(2, 1) - entry(1, 2), entry(0, 2) - entry(2, 0), entry(1, 0) - entry(0, 1)].map(|x| x / 2.0)
}
