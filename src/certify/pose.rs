//! Proof of one pose of a platform: Newton-Kantorovich on the leg quadrics, every rounding error bounded.
//!
//! The equations are quadratic, so their second derivative is constant. In the sup norm it is at most
//! `2 sum_r (1 + sum_c |M_rc|)^2 + 8 L^2` for a leg (here halved, as the equations are) and 8 for the Study condition. With
//! an approximate inverse A of the Jacobian, `Y >= |A F|`, `Z0 >= |I - A J|` and `Z2` the largest row of `|A|` times those
//! bounds, every r with `Y + Z0 r + Z2 r^2 / 2 <= r` has exactly one solution within r of the point. \[Krawczyk1969\]
//!
//! The legs are those of the file: a bound on the effect of their rounding on the equations is part of Y and Z0.

use super::{Certificate, MARGIN};
use crate::closure::study::Leg;
use crate::solve::pose::{Eight, Equations, parts};
use crate::solve::scalar::Number;
use num_complex::Complex;

/// Roundings of a value of an equation, relative to the sum of the sizes of its terms, with room for complex products.
const VALUE_ROUNDINGS: f64 = 32.0;
/// Roundings of an entry of `A J`, relative to the sum of the sizes of its terms; those of J are among them.
const PRODUCT_ROUNDINGS: f64 = 96.0;
/// Roundings of the data in a value, relative to `w^2 + L^2 |x|^2 / 2`. Every entry of M is a sum of two coordinates, off by
/// three roundings of the larger one, and that is at most the largest row sum of M: so every entry of w is off by `3 |M| |x|`,
/// at most 12 roundings of the bound w; the value, half the square of four of them, by 48 of its square.
const DATA_ROUNDINGS: f64 = 50.0;

/// Bounds on the second derivatives of the equations, from the legs alone.
#[derive(Clone, Copy, Debug)]
pub struct Curvature {
    /// One bound for each halved leg quadric, the Study condition, and the patch.
    bounds: Eight<f64>,
    /// `sum_c |M_rc|` of each leg, the largest row.
    reach: [f64; 6],
    /// Bound on the relative rounding, to f64, of the points and squared lengths that determine the legs.
    rounding: f64,
}

impl Curvature {
    /// Returns the bounds for six legs whose numbers have this relative rounding error in f64.
    #[must_use]
    pub fn new(legs: &[Leg<f64>; 6], rounding: f64) -> Self {
        let mut curvature = Self { bounds: [0.0; 8], reach: [0.0; 6], rounding };
        for (i, leg) in legs.iter().enumerate() {
            let sums = leg.matrix.map(|row| row.iter().map(|m| m.abs()).sum::<f64>());
            curvature.bounds[i] =
                MARGIN * (sums.iter().map(|s| (1.0 + s) * (1.0 + s)).sum::<f64>() + 4.0 * leg.square.abs());
            curvature.reach[i] = sums.iter().fold(0.0, |a: f64, &b| a.max(b));
        }
        curvature.bounds[6] = 8.0;
        curvature
    }
}

/// Proves that exactly one solution of the equations, the patch among them, lies near this point; `None` if that
/// cannot be shown. [`is_pose`] decides whether it is a pose (`N != 0`).
#[must_use]
pub fn pose_certificate<S: Number>(
    legs: &[Leg<f64>; 6],
    curvature: &Curvature,
    v: &Eight<S>,
    at: &Equations<S>,
    approximate_inverse: &[Eight<S>; 8],
) -> Option<Certificate> {
    // In multiprecision the data have as many digits.
    let data = if S::UNIT_ROUNDOFF < f64::UNIT_ROUNDOFF { S::UNIT_ROUNDOFF } else { curvature.rounding };
    let (x, y) = parts(v);
    let (size_x, size_y) = (x.map(Number::bound), y.map(Number::bound));
    let (most_x, most_y) = (size_x.iter().sum::<f64>(), size_y.iter().fold(0.0, |a: f64, &b| a.max(b)));
    // Rounding of the values: w is at most |y| + |M| |x| in every entry.
    let mut errors = [0.0; 8];
    for i in 0..6 {
        let w = most_y + curvature.reach[i] * size_x.iter().fold(0.0, |a: f64, &b| a.max(b));
        errors[i] = 2.0 * w * w + 0.5 * legs[i].square.abs() * most_x * most_x;
    }
    errors[6] = size_x.iter().zip(&size_y).map(|(a, b)| a * b).sum();
    let mut errors = errors.map(|e| VALUE_ROUNDINGS * S::UNIT_ROUNDOFF * e);
    for i in 0..6 {
        let w = most_y + curvature.reach[i] * size_x.iter().fold(0.0, |a: f64, &b| a.max(b));
        errors[i] += DATA_ROUNDINGS * data * (w * w + 0.5 * legs[i].square.abs() * most_x * most_x);
    }
    let (mut step, mut deviation, mut bend) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (i, row) in approximate_inverse.iter().enumerate() {
        let mut moved = S::zero();
        let (mut slack, mut bent) = (0.0, 0.0);
        for k in 0..8 {
            let size = row[k].bound();
            moved = moved.add(&row[k].mul(&at.values[k]));
            slack += size * (errors[k] + VALUE_ROUNDINGS * S::UNIT_ROUNDOFF * at.values[k].bound());
            bent += size * curvature.bounds[k];
        }
        let length = moved.bound() + slack;
        // `max` would ignore NaN.
        if !(length.is_finite() && bent.is_finite()) {
            return None;
        }
        step = step.max(length);
        bend = bend.max(bent);
        let (mut sum, mut sizes) = (0.0, 0.0);
        for j in 0..8 {
            let mut entry = if i == j { S::one() } else { S::zero() };
            for k in 0..8 {
                entry = entry.sub(&row[k].mul(&at.jacobian[k][j]));
            }
            sum += entry.bound();
        }
        for k in 0..8 {
            // The entries of J are w, -M w - L^2 x, and coordinates of the point.
            let column = match k {
                0..6 => {
                    let w = most_y + curvature.reach[k] * most_x;
                    4.0 * (w * (1.0 + curvature.reach[k]) + legs[k].square.abs() * most_x)
                }
                _ => 4.0 * (most_x + most_y),
            };
            sizes += row[k].bound() * column;
        }
        let row_deviation = sum + PRODUCT_ROUNDINGS * (S::UNIT_ROUNDOFF + data) * sizes;
        if !row_deviation.is_finite() {
            return None;
        }
        deviation = deviation.max(row_deviation);
    }
    let (step, deviation, bend) = (MARGIN * step, MARGIN * deviation, MARGIN * bend);
    let slope = 1.0 - deviation;
    let discriminant = slope * slope - 2.0 * bend * step;
    if !(slope > 0.0 && discriminant > 0.0) {
        return None;
    }
    let root = discriminant.sqrt();
    let radius = (MARGIN * 2.0 * step / (slope + root)).max(f64::MIN_POSITIVE);
    let isolation = (slope + root) / (MARGIN * bend);
    (radius < isolation).then_some(Certificate { radius, isolation, proved: radius })
}

/// Returns whether `N = x.x` differs from zero on the whole ball around a point.
#[must_use]
pub fn is_pose<S: Number>(v: &Eight<S>, radius: f64) -> bool {
    let sum: f64 = v[..4].iter().map(|x| x.bound()).sum();
    let norm = v[..4].iter().fold(S::zero(), |sum, x| sum.add(&x.mul(x)));
    let rounding = 32.0 * S::UNIT_ROUNDOFF * sum * sum;
    norm.square_size().sqrt() > 2.0 * radius * sum + 4.0 * radius * radius + rounding
}

/// Returns whether the points of two balls cannot belong to one solution: a minor of the two vectors is not zero.
#[must_use]
pub fn are_apart(v: &Eight<Complex<f64>>, radius: f64, w: &Eight<Complex<f64>>, other: f64) -> bool {
    let b = largest(w);
    (0..8).any(|i| {
        let minor = v[i] * w[b] - v[b] * w[i];
        let (left, right) = (v[i].bound() + v[b].bound(), w[i].bound() + w[b].bound());
        let rounding = 8.0 * f64::EPSILON * left * right;
        minor.norm() > radius * right + other * left + 2.0 * radius * other + rounding
    })
}

/// Returns whether no point of the ball is a multiple of a real one.
#[must_use]
pub fn is_complex(v: &Eight<Complex<f64>>, radius: f64) -> bool {
    let b = largest(v);
    v.iter().any(|z| {
        let imaginary = (z * v[b].conj()).im.abs();
        let size = z.bound() + v[b].bound();
        imaginary > radius * size + radius * radius + 8.0 * f64::EPSILON * size * size
    })
}

/// Returns the largest coordinate of the rotation.
fn largest(v: &Eight<Complex<f64>>) -> usize {
    (1..4).fold(0, |best, k| if v[k].norm_sqr() > v[best].norm_sqr() { k } else { best })
}
