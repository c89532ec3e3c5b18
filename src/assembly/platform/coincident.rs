//! Real poses of platforms with legs of length zero.
//!
//! The quadric of such a leg, `w.w = 0`, has derivative zero where `w = 0`, so Newton's method fails there. Real poses
//! solve the linear equations `w = y + M x = 0` instead. Three of these are independent, and as a rule the poses are regular
//! solutions of them.

use super::search::{Search, real_parts};
use crate::closure::study::Leg;
use crate::solve::dense::inverse;
use crate::solve::pose::{Eight, Equations, PolishedPose, equations, normalised, patch};
use looproot_calculus::finite::finite;
use nalgebra::{SMatrix, SVector};
use num_complex::Complex;

/// Number of rows: those of six legs, of the Study condition and of the patch.
const ROWS: usize = 26;
/// Maximum number of Gauss-Newton steps.
const MOST_STEPS: usize = 25;
/// A step of this size is the last.
const SETTLED: f64 = 1e-15;
/// Relative residual of a pose.
const CLOSED: f64 = 1e-14;
/// Singular values below this part of the largest one count as zero.
const RANK: f64 = 1e-9;
/// Maximum distance of a start from its pose: multiple eigenvalues are off by roots of the rounding error.
const NEAR: f64 = 0.3;

/// Returns whether the two ends of some leg must coincide.
pub fn has_point_leg(legs: &[Leg<f64>; 6]) -> bool {
    legs.iter().any(|leg| leg.square == 0.0)
}

/// Returns the real pose near a point.
fn pose(legs: &[Leg<f64>; 6], start: &Eight<f64>) -> Option<(Eight<f64>, Equations<f64>)> {
    let begin = normalised(start)?;
    let mut v = begin;
    for _ in 0..MOST_STEPS {
        let here = equations(legs, &v, &patch(&v));
        let mut matrix = SMatrix::<f64, ROWS, 8>::zeros();
        let mut values = SVector::<f64, ROWS>::zeros();
        let (x, y) = ([v[0], v[1], v[2], v[3]], [v[4], v[5], v[6], v[7]]);
        for (i, leg) in legs.iter().enumerate() {
            if leg.square == 0.0 {
                let w = leg.vector(&x, &y, |x, c| x * c);
                for k in 0..4 {
                    values[4 * i + k] = w[k];
                    matrix[(4 * i + k, 4 + k)] = 1.0;
                    for j in 0..4 {
                        matrix[(4 * i + k, j)] = leg.matrix[k][j];
                    }
                }
            } else {
                values[4 * i] = here.values[i];
                for j in 0..8 {
                    matrix[(4 * i, j)] = here.jacobian[i][j];
                }
            }
        }
        for k in 6..8 {
            values[ROWS + k - 8] = here.values[k];
            for j in 0..8 {
                matrix[(ROWS + k - 8, j)] = here.jacobian[k][j];
            }
        }
        let svd = finite(matrix).svd(true, true);
        let step = svd.solve(&values, RANK * svd.singular_values.max()).ok()?;
        v = normalised(&std::array::from_fn(|k| v[k] - step[k]))?;
        let moved = (0..8).map(|k| (v[k] - begin[k]).abs()).fold(0.0, f64::max);
        if !(moved < NEAR) {
            return None;
        }
        if step.amax() < SETTLED {
            break;
        }
    }
    let here = equations(legs, &v, &patch(&v));
    (here.residual() < CLOSED).then_some((v, here))
}

impl Search<'_> {
    /// Takes in the real pose near a point at which the ends of legs of length zero coincide. Returns whether there is one.
    pub fn coincide(&mut self, start: &Eight<Complex<f64>>, eigenvalue: usize) -> bool {
        real_parts(start).iter().any(|real| {
            let Some((study, equations)) = pose(self.legs, real) else { return false };
            let inverse = inverse(&equations.jacobian).unwrap_or([[f64::INFINITY; 8]; 8]);
            self.admit(&PolishedPose { study, equations, inverse, step: 0.0 }, eigenvalue);
            true
        })
    }
}
