//! Decides whether a platform moves with its legs locked, along a curve of poses, real or complex, through a point.

use super::prepared::norm;
use crate::closure::study::Leg;
use crate::solve::pose::{Eight, equations, normalised, patch};
use crate::solve::scalar::{Number, Scalar};
use looproot_calculus::finite::finite;
use nalgebra::{ComplexField, SMatrix, SVector};

/// Singular values below this part of the largest one count as zero.
const RANK: f64 = 1e-6;
/// The same bound while a pose is approached: the singular values of multiple ones shrink with the distance.
const NEGLIGIBLE: f64 = 1e-8;
/// Relative residual of a pose.
const CLOSED: f64 = 1e-12;
/// Length of a step along the curve.
const STEP: f64 = 0.02;
/// Poses count as another direction of motion if they are farther away than this part of a step.
const MOVED: f64 = 0.2;
/// Maximum number of steps along a curve.
const MOST_STEPS: usize = 1500;
/// Approximate number of points stored for a curve.
const KEPT: usize = 60;
/// |N| of a point on a family without poses.
const NULL: f64 = 1e-3;

/// Numbers with a singular value decomposition.
pub trait Numeric: Scalar + ComplexField<RealField = f64> {}

impl<S: Scalar + ComplexField<RealField = f64>> Numeric for S {}

/// Returns the pose near a point that solves the legs' equations in the least-squares sense, by Gauss-Newton steps; `None`
/// if there is none.
pub fn project<S: Numeric>(legs: &[Leg<f64>; 6], start: &Eight<S>) -> Option<Eight<S>> {
    let mut v = normalised(start)?;
    for _ in 0..40 {
        let here = equations(legs, &v, &patch(&v));
        if here.residual() < CLOSED && here.values[6].size() < CLOSED {
            return Some(v);
        }
        let svd = finite(SMatrix::<S, 8, 8>::from_fn(|i, j| here.jacobian[i][j])).svd(true, true);
        let cut = NEGLIGIBLE * svd.singular_values.max();
        let step = svd.solve(&SVector::<S, 8>::from(here.values), cut).ok()?;
        for k in 0..8 {
            v[k] -= step[k];
        }
        v = normalised(&v)?;
    }
    None
}

/// Returns the null directions of the equations at a pose.
fn kernel<S: Numeric>(legs: &[Leg<f64>; 6], v: &Eight<S>) -> impl Iterator<Item = Eight<S>> {
    let here = equations(legs, v, &patch(v));
    let svd = finite(SMatrix::<S, 8, 8>::from_fn(|i, j| here.jacobian[i][j])).svd(false, true);
    let (values, rows) = (svd.singular_values, svd.v_t);
    let cut = RANK * values.max();
    (0..8)
        .filter(move |&k| values[k] <= cut)
        .filter_map(move |k| rows.map(|rows| std::array::from_fn(|j| Number::conjugate(rows[(k, j)]))))
}

/// Returns poses in their order along the curve of poses next to a point. The curve is followed until it closes or the
/// number of steps is exhausted, and thinned out.
#[must_use]
pub fn curve(legs: &[Leg<f64>; 6], start: &Eight<f64>) -> Vec<Eight<f64>> {
    let Some(first) = project(legs, start) else { return Vec::new() };
    let ahead = |v: &Eight<f64>, direction: &Eight<f64>| {
        let start = std::array::from_fn(|j| v[j] + direction[j] * STEP);
        project(legs, &start).filter(|next| distance(v, next) > MOVED * STEP)
    };
    let mut points = vec![first];
    let Some(mut next) = kernel(legs, &first).find_map(|direction| ahead(&first, &direction)) else { return points };
    let (mut last, mut has_left) = (first, false);
    for _ in 0..MOST_STEPS {
        // Quaternions of opposite signs are the same rotation.
        if same_sign(&last, &next) < 0.0 {
            next = next.map(|x| -x);
        }
        points.push(next);
        let back = distance(&first, &next).min(distance(&first, &next.map(|x| -x)));
        has_left |= back > 2.0 * STEP;
        if has_left && back < 0.7 * STEP {
            points.push(first);
            break;
        }
        let length = distance(&last, &next);
        let direction = std::array::from_fn(|j| (next[j] - last[j]) / length);
        last = next;
        let Some(further) = ahead(&last, &direction) else { break };
        next = further;
    }
    let every = points.len().div_ceil(KEPT);
    let end = points.len() - 1;
    points.iter().enumerate().filter(|(k, _)| k % every == 0 || *k == end).map(|(_, point)| *point).collect()
}

fn distance(v: &Eight<f64>, w: &Eight<f64>) -> f64 {
    (0..8).map(|k| (v[k] - w[k]).powi(2)).sum::<f64>().sqrt()
}

fn same_sign(v: &Eight<f64>, w: &Eight<f64>) -> f64 {
    (0..4).map(|k| v[k] * w[k]).sum()
}

/// Returns the dimension of the set of poses through the pose next to a point, real or complex as the type is; 0 for
/// isolated poses and if there is none.
///
/// The equations may have more null directions than there is motion. Therefore those directions count in which a step
/// leads to poses again.
#[must_use]
pub fn self_motion<S: Numeric>(legs: &[Leg<f64>; 6], start: &Eight<S>) -> usize {
    let Some(v) = project(legs, start) else { return 0 };
    if norm(&v).size() < NULL {
        return 0;
    }
    let mut moved = SMatrix::<S, 8, 16>::zeros();
    for (k, direction) in kernel(legs, &v).enumerate() {
        for (side, step) in [STEP, -STEP].into_iter().enumerate() {
            let start = std::array::from_fn(|j| v[j] + direction[j].times(step));
            let Some(slid) = project(legs, &start) else { continue };
            for j in 0..8 {
                moved[(j, 2 * k + side)] = slid[j] - v[j];
            }
        }
    }
    finite(moved).svd(false, false).singular_values.iter().filter(|&&size| size > MOVED * STEP).count()
}
