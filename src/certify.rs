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
//! r (largest coordinate) around q. F holds the translation and the skew part of the rotation of E; near E = I its zeros
//! are exactly the closures. \[Krawczyk1969\]
//!
//! Rounding: E is computed as a product of six steps. Step j leaves an error of at most `c u |before| |step|`, which the
//! steps behind it magnify by at most their norm. Constants of the loop count as known to a few roundings, so that the
//! proof covers the mechanism as given and not only as stored.

use crate::solve::dense::{norm, times};
use crate::solve::newton::{Closure, Six};
use crate::solve::scalar::Scalar;

/// What was proved of a mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certificate {
    /// Exactly one solution lies within this distance (largest coordinate) of the mode.
    pub radius: f64,
    /// And within this larger distance there is no other one.
    pub isolation: f64,
}

/// Unit roundoff.
const U: f64 = f64::EPSILON / 2.0;
/// Roundings per step of the product: cosine and sine (2), their use (4), the stored constant (8), the product (6), with
/// room for complex products (a factor of sqrt 8 on each operation).
const ROUNDINGS: f64 = 60.0;
/// Margin on bounds that are themselves computed in f64.
const MARGIN: f64 = 1.01;

/// Proves that exactly one solution lies near these unknowns; `None` where that cannot be shown.
#[must_use]
pub fn certificate<S: Scalar>(closure: &Closure<S>, inverse: &[Six<S>; 6]) -> Option<Certificate> {
    let product_error = ROUNDINGS * U * closure.norms.iter().map(|n| n.before * n.step * n.behind).sum::<f64>();
    let off_identity = 8.0 * closure.defect + product_error;
    if !(off_identity < 1e-3) {
        return None;
    }
    let inverse_norm = norm(inverse) * MARGIN;
    // |A F| with the error of F and of the product A F.
    let step = times(inverse, &closure.residual).into_iter().map(Scalar::bound).fold(0.0, f64::max);
    let residual = closure.residual.iter().map(|x| x.bound()).fold(0.0, f64::max);
    let y = MARGIN * (step + inverse_norm * (product_error + 16.0 * U * residual));
    // |I - A J|, the error of J as the derivative, and the roundings of this very product.
    let mut deviation = [[S::zero(); 6]; 6];
    let mut sums = 0.0_f64;
    for (i, row) in deviation.iter_mut().enumerate() {
        let mut sum = 0.0;
        for (j, entry) in row.iter_mut().enumerate() {
            let mut value = if i == j { S::one() } else { S::zero() };
            for k in 0..6 {
                let term = inverse[i][k].mul(&closure.jacobian[k][j]);
                sum += term.bound();
                value = value.sub(&term);
            }
            *entry = value;
        }
        sums = sums.max(sum);
    }
    let twists: f64 = MARGIN * closure.norms.iter().map(|n| n.twist).sum::<f64>();
    // The derivative is L(Z_j E): J differs from it by |Z_j| |E - I|, and Z_j is computed from a product of steps.
    let derivative_error = twists * (2.0 * off_identity + 4.0 * product_error);
    let z0 = MARGIN * (norm(&deviation) + 40.0 * U * sums + inverse_norm * derivative_error);
    if !(z0 < 0.5) {
        return None;
    }
    // Smallest radius that works, then the largest one (with half the contraction to spare).
    let bend = |r: f64| MARGIN * inverse_norm * twists * twists * (r * twists).exp() * (1.0 + off_identity);
    let radius = (1.05 * y / (1.0 - z0)).max(f64::MIN_POSITIVE);
    let works = |r: f64| {
        let z2 = bend(r);
        y + z0 * r + 0.5 * z2 * r * r <= r && z0 + z2 * r < 1.0
    };
    let radius = [1.0, 1.5, 2.0].into_iter().map(|f| f * radius).find(|&r| works(r))?;
    let mut isolation = (1.0 - z0) / bend(radius) * 0.9;
    if !(isolation > radius) || !works(isolation) {
        isolation *= 0.5;
        if !(isolation > radius) || !works(isolation) {
            isolation = radius;
        }
    }
    Some(Certificate { radius, isolation })
}
