//! Whether a platform moves with its legs locked: a curve of poses, real or complex, through a point.

use super::prepared::norm;
use crate::closure::study::Leg;
use crate::solve::pose::{Eight, equations, normalised, patch};
use crate::solve::scalar::{Number, Scalar};
use nalgebra::{ComplexField, SMatrix, SVector};

/// Singular values below this part of the largest one count as zero.
const RANK: f64 = 1e-6;
/// Relative residual of a pose.
const CLOSED: f64 = 1e-12;
/// How far a step along the curve goes.
const STEP: f64 = 0.02;
/// |N| of a point on a family without poses.
const NULL: f64 = 1e-3;

/// Numbers with a singular value decomposition.
pub trait Numeric: Scalar + ComplexField<RealField = f64> {}

impl<S: Scalar + ComplexField<RealField = f64>> Numeric for S {}

/// The pose near a point that solves the legs' equations as well as they can be solved, by Gauss-Newton steps; `None`
/// where there is none.
pub fn project<S: Numeric>(legs: &[Leg<f64>; 6], start: &Eight<S>) -> Option<Eight<S>> {
    let mut v = normalised(start)?;
    for _ in 0..40 {
        let here = equations(legs, &v, &patch(&v));
        if here.residual() < CLOSED && here.values[6].size() < CLOSED {
            return Some(v);
        }
        let svd = SMatrix::<S, 8, 8>::from_fn(|i, j| here.jacobian[i][j]).svd(true, true);
        let cut = RANK * svd.singular_values.max();
        let step = svd.solve(&SVector::<S, 8>::from(here.values), cut).ok()?;
        for k in 0..8 {
            v[k] -= step[k];
        }
        v = normalised(&v)?;
    }
    None
}

/// The corank of the equations at a pose, and a direction in which they give way.
fn corank<S: Numeric>(legs: &[Leg<f64>; 6], v: &Eight<S>) -> (usize, Eight<S>) {
    let here = equations(legs, v, &patch(v));
    let svd = SMatrix::<S, 8, 8>::from_fn(|i, j| here.jacobian[i][j]).svd(false, true);
    let values = svd.singular_values;
    let smallest = (1..8).fold(0, |best, k| if values[k] < values[best] { k } else { best });
    let count = values.iter().filter(|&&s| s <= RANK * values.max()).count();
    (
        count,
        svd.v_t.map_or([<S as Scalar>::from_f64(0.0); 8], |v| {
            std::array::from_fn(|j| Number::conjugate(v[(smallest, j)]))
        }),
    )
}

/// The dimension of the set of poses through the pose next to a point, real or complex as the type is; 0 for isolated ones
/// and where there is none.
#[must_use]
pub fn self_motion<S: Numeric>(legs: &[Leg<f64>; 6], start: &Eight<S>) -> usize {
    let Some(v) = project(legs, start) else { return 0 };
    let norm = norm(&v).size();
    let (count, direction) = corank(legs, &v);
    if count == 0 || norm < NULL {
        return 0;
    }
    let there = [STEP, -STEP].map(|h| {
        let moved = std::array::from_fn(|k| v[k] + direction[k].times(h));
        let slid = project(legs, &moved)?;
        let distance = (0..8).map(|k| (slid[k] - v[k]).size()).fold(0.0, f64::max);
        (distance > 0.2 * STEP && distance < 5.0 * STEP).then(|| corank(legs, &slid).0)
    });
    // The corank may be larger at a point where branches meet.
    there.into_iter().flatten().min().unwrap_or(0).min(count)
}
