//! Paths of solutions: the solutions of homogeneous equations that depend on a parameter, followed while the parameter moves.
//!
//! A point is a vector up to a factor, kept at length 1. A step is predicted by the method of Runge and Kutta and corrected by
//! Newton's. Its length is chosen so that predictions are off by a small part of the point.

use super::dense::solve_one;
use super::pose::hermitian;
use num_complex::Complex;

/// A vector of unknowns with a common factor.
pub type Point<const N: usize> = [Complex<f64>; N];

/// Maximum error of a predicted point, relative to the point.
const PREDICTED: f64 = 1e-4;
/// Intended error of a prediction.
const AIM: f64 = 1e-5;
/// Error below which a corrected point is accepted.
const CORRECTED: f64 = 1e-9;
/// Number of Newton steps after a prediction.
const CORRECTIONS: usize = 4;
/// Part of a path that the first step takes.
const FIRST: f64 = 0.1;
/// Part of a path below which a step is too short to lead on.
const LEAST: f64 = 1e-9;

/// The equations, their derivatives by the point, and their derivatives by the parameter, at a point.
pub struct Here<const N: usize> {
    /// The values.
    pub values: Point<N>,
    /// The derivatives by the point, one row for each equation.
    pub jacobian: [Point<N>; N],
    /// The derivatives by the parameter.
    pub drift: Point<N>,
}

impl<const N: usize> Here<N> {
    /// Returns equations that are all 0.
    #[must_use]
    pub fn zero() -> Self {
        let zero = [Complex::from(0.0); N];
        Self { values: zero, jacobian: [zero; N], drift: zero }
    }
}

/// Returns a point scaled to length 1; `None` if it is not finite, or 0.
#[must_use]
pub fn unit<const N: usize>(v: &Point<N>) -> Option<Point<N>> {
    let size = hermitian(v).sqrt();
    (size > 0.0 && size.is_finite()).then(|| v.map(|z| z / size))
}

/// Returns the parameter and its derivative on an arc of the complex numbers, with s from 1 to 0. The arc goes from 1 to 0; its
/// bend, of absolute value 1, is 1 where it is straight.
#[must_use]
pub fn arc(bend: Complex<f64>, s: f64) -> [Complex<f64>; 2] {
    let below = (bend * s + (1.0 - s)).inv();
    [bend * s * below, bend * below * below]
}

/// A family of homogeneous equations with one parameter.
pub trait Family<const N: usize> {
    /// Evaluates the equations at a parameter, with the linear form `patch` as the last one: it fixes the common factor of v.
    fn at(&self, parameter: Complex<f64>, v: &Point<N>, patch: &Point<N>) -> Here<N>;

    /// Returns the velocity of a solution at a place of a path.
    fn velocity(&self, [parameter, speed]: [Complex<f64>; 2], v: &Point<N>, patch: &Point<N>) -> Option<Point<N>> {
        let here = self.at(parameter, v, patch);
        let velocity = solve_one(&here.jacobian, &here.drift)?;
        Some(velocity.map(|z| -z * speed))
    }

    /// Takes a Runge-Kutta step.
    fn predicted(&self, path: impl Fn(f64) -> [Complex<f64>; 2], v: &Point<N>, s: f64, step: f64) -> Option<Point<N>> {
        let patch = v.map(|z| z.conj());
        let ahead =
            |slope: &Point<N>, part: f64| -> Point<N> { std::array::from_fn(|k| v[k] + slope[k] * (part * step)) };
        let one = self.velocity(path(s), v, &patch)?;
        let two = self.velocity(path(s + 0.5 * step), &ahead(&one, 0.5), &patch)?;
        let three = self.velocity(path(s + 0.5 * step), &ahead(&two, 0.5), &patch)?;
        let four = self.velocity(path(s + step), &ahead(&three, 1.0), &patch)?;
        Some(std::array::from_fn(|k| v[k] + (one[k] + 2.0 * (two[k] + three[k]) + four[k]) * (step / 6.0)))
    }

    /// Applies Newton's method. Returns the point and the prediction error; `None` if that is too large or it does not converge.
    fn corrected(&self, parameter: Complex<f64>, start: &Point<N>) -> Option<(Point<N>, f64)> {
        let mut v = unit(start)?;
        let mut off = 0.0;
        let mut before = f64::INFINITY;
        for count in 0..CORRECTIONS {
            let patch = v.map(|z| z.conj());
            let here = self.at(parameter, &v, &patch);
            let step = solve_one(&here.jacobian, &here.values)?;
            let size = hermitian(&step).sqrt();
            if count == 0 {
                off = size;
            }
            if !(size < PREDICTED) || !(size < 0.3 * before) && size > CORRECTED {
                return None;
            }
            v = unit(&std::array::from_fn(|k| v[k] - step[k]))?;
            if size < CORRECTED {
                return Some((v, off));
            }
            before = size;
        }
        None
    }

    /// Follows a path from s to `to` in at most this many steps; `None` if it cannot be followed.
    fn follow(
        &self,
        path: impl Fn(f64) -> [Complex<f64>; 2] + Copy,
        start: &Point<N>,
        from: f64,
        to: f64,
        most: usize,
    ) -> Option<Point<N>> {
        let mut v = unit(start)?;
        let whole = to - from;
        let (mut done, mut part) = (0.0, FIRST);
        for _ in 0..most {
            let last = part >= 1.0 - done;
            let next = if last { 1.0 } else { done + part };
            let s = from + done * whole;
            let there = if last { to } else { from + next * whole };
            let ahead = self.predicted(path, &v, s, there - s).and_then(|p| self.corrected(path(there)[0], &p));
            if let Some((point, off)) = ahead {
                (v, done) = (point, next);
                if last {
                    return Some(v);
                }
                part *= (0.9 * (AIM / off.max(1e-12)).powf(0.2)).clamp(0.3, 3.0);
            } else {
                part = part.min(1.0 - done) * 0.35;
                if part < LEAST {
                    return None;
                }
            }
        }
        None
    }
}
