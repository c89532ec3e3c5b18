//! Proof of one mode: Newton-Kantorovich in the form of radii polynomials, every rounding error bounded.
//!
//! With the twists Z_j (4 x 4 matrices in the frame of the cut) the closure at unknowns q + h is
//! `E(q + h) = exp(h_1 Z_1) ... exp(h_6 Z_6) E(q)`, so that all its derivatives are bounded by the norms |Z_j|: second
//! ones in a ball of radius r by `(sum |Z_j|)^2 e^(r sum |Z_j|) |E|`. The same bound holds for complex unknowns. For an
//! approximate inverse A of the Jacobian and
//!
//! * `Y >= |A F(q)|`, the step,
//! * `Z0 >= |I - A F'(q)|`, the inexactness of A,
//! * `Z2 >= |A| (sum |Z_j|)^2 e^(r sum |Z_j|) |E|`, the curvature,
//!
//! every r with `Y + Z0 r + Z2 r^2 / 2 <= r` and `Z0 + Z2 r < 1` has exactly one solution of F = 0 in the ball of radius
//! r (largest coordinate) around q. F holds the translation and the skew part of the rotation of E. \[Krawczyk1969\]
//!
//! At a zero of F the translation of E vanishes and its rotation is symmetric: E = I, or a rotation by pi, for which
//! `|E - I| >= 2`. In the ball `|E - I|` is at most its value at q plus `(e^(r sum |Z_j|) - 1) |E(q)|`, which is checked to
//! be below 1/2, so the zero is a closure. Closures are always zeros of F, so no other one lies within the isolation.
//!
//! Rounding: E is computed as a product of six steps. Step j leaves an error of at most `c u |before| |step|`, which the
//! steps behind it magnify by at most their norm. The constants of a loop are assumed known to a few roundings, or to the error
//! set by `Closure::constant_is_off`. The bounds hold for every loop within these errors, so the proof holds for
//! the loop as given and not only as stored. The twist of an unknown is that of a frame p, z: if the frame is
//! off by a factor 1 + D, the twist is off by at most `3 |D|` times its lever, `|z| (1 + |p|)`, which may be large even if the
//! twist is small.

pub mod circle_lanes;
pub mod circle_zeros;
pub mod closure_lanes;
pub mod closure_zeros;
pub mod pose;
mod refined;

pub use refined::{
    Refined, exponential, exponential_pair, from_pairs, refined_certificate, refined_certificate_of, refined_exactly,
    refined_real_of, small_turn,
};

use crate::elimination::cut::Cut;
use crate::kinematics::closed_loop::ClosedLoop;
use crate::solve::dense::{inverse, times};
use crate::solve::newton::{Closure, Six, closure};
use crate::solve::scalar::{Number, Scalar};

/// The bounds proved for a mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certificate {
    /// Exactly one solution lies within this distance (largest coordinate) of the mode.
    pub radius: f64,
    /// No other solution lies within this larger distance.
    pub isolation: f64,
    /// The radius before the unknowns were rounded to f64: each of them is off by at most this and a few roundings of
    /// itself. An unknown of enormous size increases only the other radius.
    pub proved: f64,
}

/// Roundings per step of the product, relative to its norms, which add up |re| and |im|: cosine and sine (4, complex ones
/// 20), their use (3), the product (4), the stored constant (32), and a margin for second order.
pub(crate) const ROUNDINGS: f64 = 70.0;
/// Margin on bounds that are themselves computed in f64.
pub(crate) const MARGIN: f64 = 1.01;
/// Half a unit in the last place of 1.
pub(crate) const ROUNDOFF: f64 = f64::EPSILON / 2.0;
/// A product of motions farther than this from the identity proves nothing: the bounds hold near E = I, to first order and a margin.
pub(crate) const OFF_IDENTITY: f64 = 1e-3;

/// Bounds the error of every entry of the computed closure, compared with the exact one of the mechanism as given. Holds
/// near E = I.
#[must_use]
pub fn product_error<S: Number>(at: &Closure<S>) -> f64 {
    rounding_error(at) + at.data_error
}

/// Bounds the part of this error that is due to rounding.
fn rounding_error<S: Number>(at: &Closure<S>) -> f64 {
    ROUNDINGS * S::UNIT_ROUNDOFF * at.norms.iter().map(|n| n.before * n.step * n.behind).sum::<f64>()
}

/// Bounds |E - I|, as a sum over a row.
fn off_identity<S: Number>(at: &Closure<S>) -> f64 {
    8.0 * at.defect + product_error(at)
}

/// Equal weights of all unknowns.
const ALIKE: Six<f64> = [1.0; 6];

/// Bounds the sum of the errors of the twists in one coordinate, each unknown measured by its weight. The frames are off
/// by the error of the product, and their twists are computed in a few roundings.
fn twist_error<S: Number>(at: &Closure<S>, weights: &Six<f64>) -> f64 {
    let levers: f64 = at.norms.iter().zip(weights).map(|(n, w)| n.lever * w).sum();
    3.0 * (product_error(at) + 2.0 * S::UNIT_ROUNDOFF) * levers
}

/// Bounds the sum of the |Z_j|, each unknown measured by its weight.
fn twists<S: Number>(at: &Closure<S>, weights: &Six<f64>) -> f64 {
    // A row of a twist has three entries.
    let computed: f64 = at.norms.iter().zip(weights).map(|(n, w)| n.twist * w).sum();
    MARGIN * (computed + 3.0 * twist_error(at, weights))
}

/// Bounds the error of the Jacobian, summed over a row: the derivative is L(Z_j E), from which `at.jacobian` differs by
/// |Z_j| |E - I| and the error of Z_j.
#[must_use]
pub fn derivative_error<S: Number>(at: &Closure<S>) -> f64 {
    weighted_derivative_error(at, &ALIKE)
}

fn weighted_derivative_error<S: Number>(at: &Closure<S>, weights: &Six<f64>) -> f64 {
    MARGIN * (2.0 * twists(at, weights) * off_identity(at) + twist_error(at, weights))
}

/// Bounds the rate of change of the derivative with the distance, as the largest sum over a row, within `r` (largest
/// coordinate) of the unknowns.
#[must_use]
pub fn curvature<S: Number>(at: &Closure<S>, r: f64) -> f64 {
    weighted_curvature(at, r, &ALIKE)
}

fn weighted_curvature<S: Number>(at: &Closure<S>, r: f64, weights: &Six<f64>) -> f64 {
    let twists = twists(at, weights);
    twists * twists * (r * twists).exp() * (1.0 + off_identity(at))
}

/// Proves that exactly one solution lies near these unknowns; `None` if that cannot be shown.
#[must_use]
pub fn certificate<S: Number>(at: &Closure<S>, approximate_inverse: &[Six<S>; 6]) -> Option<Certificate> {
    weighted_certificate(at, approximate_inverse, &ALIKE, None)
}

/// As [`certificate`], with the size of every unknown measured by its weight, at least 1: long translations need not be
/// as exact as angles. `moved` bounds `|A (F' - F)|` for all F' within the errors of the constants, if a better bound than
/// that by the norms is known.
fn weighted_certificate<S: Number>(
    at: &Closure<S>,
    approximate_inverse: &[Six<S>; 6],
    weights: &Six<f64>,
    moved: Option<f64>,
) -> Option<Certificate> {
    if !(off_identity(at) < OFF_IDENTITY) {
        return None;
    }
    let row = |(row, weight): (&Six<S>, &f64)| row.iter().map(|x| x.bound()).sum::<f64>() / weight;
    let inverse_norm = approximate_inverse.iter().zip(weights).map(row).fold(0.0, f64::max) * MARGIN;
    // |A F| with the error of F and of the product A F.
    let step = times(approximate_inverse, &at.residual);
    let step = step.into_iter().zip(weights).map(|(x, weight)| x.bound() / weight).fold(0.0, f64::max);
    let residual = at.residual.iter().map(|x| x.bound()).fold(0.0, f64::max);
    let moved = moved.unwrap_or(inverse_norm * at.data_error);
    let y = MARGIN * (step + inverse_norm * (rounding_error(at) + 16.0 * S::UNIT_ROUNDOFF * residual) + moved);
    // |I - A J|, the error of J as the derivative, and the roundings of this product.
    let (mut deviation, mut sums) = (0.0_f64, 0.0_f64);
    for i in 0..6 {
        let (mut off, mut sum) = (0.0, 0.0);
        for j in 0..6 {
            let mut value = if i == j { S::one() } else { S::zero() };
            for k in 0..6 {
                let term = approximate_inverse[i][k].mul(&at.jacobian[k][j]);
                sum += term.bound() * weights[j];
                value = value.sub(&term);
            }
            off += value.bound() * weights[j];
        }
        deviation = deviation.max(off / weights[i]);
        sums = sums.max(sum / weights[i]);
    }
    let derivative_error = inverse_norm * weighted_derivative_error(at, weights);
    let z0 = MARGIN * (deviation + 40.0 * S::UNIT_ROUNDOFF * sums + derivative_error);
    if !(z0 < 0.5) {
        return None;
    }
    // The smallest radius that works, then the largest one (with half the contraction to spare).
    let bend = |r: f64| MARGIN * inverse_norm * weighted_curvature(at, r, weights);
    let radius = (1.05 * y / (1.0 - z0)).max(f64::MIN_POSITIVE);
    let works = |r: f64| {
        let z2 = bend(r);
        y + z0 * r + 0.5 * z2 * r * r <= r && z0 + z2 * r < 1.0
    };
    let radius = [1.0, 1.5, 2.0].into_iter().map(|f| f * radius).find(|&r| works(r))?;
    // No rotation by pi is near.
    let turned = (radius * twists(at, weights)).exp_m1();
    if !(off_identity(at) + 1.01 * turned < 0.5) {
        return None;
    }
    let mut isolation = (1.0 - z0) / bend(radius) * 0.9;
    if !(isolation > radius) || !works(isolation) {
        isolation *= 0.5;
        if !(isolation > radius) || !works(isolation) {
            isolation = radius;
        }
    }
    // The radius holds for coordinates, not for weighted ones.
    let largest = weights.iter().copied().fold(1.0, f64::max);
    let radius = radius * largest;
    (radius <= isolation).then_some(Certificate { radius, isolation, proved: radius })
}

/// As [`certificate`], with the loop opened in turn behind each of its joints: imaginary parts make some frames far
/// worse than others. The last constant may be off by a matrix of row-sum norm `off`.
#[must_use]
pub fn certificate_in_any_frame<S: Scalar>(
    closed: &ClosedLoop<f64>,
    unknowns: &Six<S>,
    off: f64,
) -> Option<Certificate> {
    (1..6).find_map(|k| {
        let rotated = Cut { rotation: k, reversed: false }.of(closed);
        let mut here = closure(&rotated, &std::array::from_fn(|j| unknowns[(k + j) % 6]));
        here.constant_is_off(5 - k, off);
        certificate(&here, &inverse(&here.jacobian)?)
    })
}
