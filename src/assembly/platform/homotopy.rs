//! A parameter homotopy: the solutions of a general platform, carried to a special one.
//!
//! Points and squared lengths of the legs move along `target + tau (start - target)`, with tau from 1 to 0 on an arc of the
//! complex numbers. With probability one no platform on the arc but the last is special. A solution to which several paths
//! converge is counted as often as paths lead to it.

use crate::closure::study::{Form, Leg, scalar};
use crate::solve::dense::solve_one;
use crate::solve::pose::{Eight, hermitian, parts};
use num_complex::Complex;
use std::f64::consts::TAU;

type Point = Eight<Complex<f64>>;

/// Maximum error of a predicted point, relative to the point.
const PREDICTED: f64 = 1e-4;
/// Intended error of a prediction.
const AIM: f64 = 1e-5;
/// Error below which a corrected point is accepted.
const CORRECTED: f64 = 1e-9;
/// Number of Newton steps after a prediction.
const CORRECTIONS: usize = 4;
/// Maximum number of steps on a path.
const MOST_STEPS: usize = 600;
/// Parameter at which the endgame of a path begins.
const END: f64 = 0.02;
/// Maximum number of steps to the end of a path that leads to a regular solution.
const LAST_STEPS: usize = 40;
/// Number of circles about the end; each is smaller than the last by the factor `SMALLER`.
const CIRCLES: usize = 4;
const SMALLER: f64 = 0.1;
/// Number of points sampled on a circle.
const SAMPLES: usize = 16;
/// Number of loops around a circle after which a path that has not closed is given up.
const MOST_TURNS: usize = 12;
/// A path is closed when it returns this near to its beginning.
const CLOSED: f64 = 1e-6;
/// Residual of the equations below which an end is accepted.
const HELD: f64 = 1e-7;
/// `|N|` over `|x|^2` below which a singular end belongs to no pose.
const NULL: f64 = 1e-4;
/// The same bound at a regular end.
const REGULAR_NULL: f64 = 1e-13;
/// `|x|` below which an end is at infinity.
const FAR: f64 = 1e-5;

/// The end of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// A regular solution.
    Regular(Point),
    /// A singular solution.
    Singular(Point),
    /// No pose: `N = x.x = 0`, or x = 0.
    Null,
    /// The end is not known.
    Lost,
}

/// The one-parameter family of platforms between two.
pub struct Homotopy<'a> {
    /// The legs at the end.
    pub target: &'a [Leg<f64>; 6],
    /// The legs at the beginning.
    pub start: &'a [Leg<f64>; 6],
    /// The bend of the arc, of absolute value 1.
    pub bend: Complex<f64>,
}

/// The equations, their derivatives by the point, and their derivatives by tau, at a point.
struct Here {
    values: Point,
    jacobian: [Point; 8],
    drift: Point,
}

fn distance(v: &Point, w: &Point) -> f64 {
    (0..8).map(|k| (v[k] - w[k]).norm_sqr()).sum::<f64>().sqrt()
}

/// Returns the multiple of a point on which a linear form is 1.
fn on_patch(v: &Point, patch: &Point) -> Option<Point> {
    let value: Complex<f64> = v.iter().zip(patch).map(|(v, p)| v * p).sum();
    let scale = value.inv();
    scale.is_finite().then(|| v.map(|z| z * scale))
}

fn unit(v: &Point) -> Option<Point> {
    let size = hermitian(v).sqrt();
    (size > 0.0 && size.is_finite()).then(|| v.map(|z| z / size))
}

impl Homotopy<'_> {
    /// Returns tau and its derivative on the arc, with s from 1 to 0.
    fn arc(&self, s: f64) -> [Complex<f64>; 2] {
        let below = (self.bend * s + (1.0 - s)).inv();
        [self.bend * s * below, self.bend * below * below]
    }

    /// Evaluates the equations of the platform at tau, with a linear form that fixes the common factor of v.
    fn at(&self, tau: Complex<f64>, v: &Point, patch: &Point) -> Here {
        let (x, y) = parts(v);
        let zero = Complex::from(0.0);
        let mut here = Here { values: [zero; 8], jacobian: [[zero; 8]; 8], drift: [zero; 8] };
        let times = |z: &Complex<f64>, c: &Complex<f64>| z * c;
        let norm = scalar(&x, &x);
        for i in 0..6 {
            let (end, begin) = (&self.target[i], &self.start[i]);
            let moved = |end: f64, begin: f64| end + tau * (begin - end);
            let matrix: Form<Complex<f64>> =
                std::array::from_fn(|j| std::array::from_fn(|k| moved(end.matrix[j][k], begin.matrix[j][k])));
            let leg = Leg { matrix, square: moved(end.square, begin.square) };
            let w = leg.vector(&x, &y, times);
            here.values[i] = (scalar(&w, &w) - leg.square * norm) * 0.5;
            here.jacobian[i][..4].copy_from_slice(&leg.half_slope(&w, &x, times));
            here.jacobian[i][4..].copy_from_slice(&w);
            let change =
                |j: usize| -> Complex<f64> { (0..4).map(|k| x[k] * (begin.matrix[j][k] - end.matrix[j][k])).sum() };
            here.drift[i] = (0..4).map(|j| w[j] * change(j)).sum::<Complex<f64>>();
            here.drift[i] -= norm * (0.5 * (begin.square - end.square));
        }
        here.values[6] = scalar(&x, &y);
        here.jacobian[6][..4].copy_from_slice(&y);
        here.jacobian[6][4..].copy_from_slice(&x);
        here.jacobian[7] = *patch;
        here
    }

    /// Returns the velocity of a solution at a place of a path.
    fn velocity(&self, [tau, speed]: [Complex<f64>; 2], v: &Point, patch: &Point) -> Option<Point> {
        let here = self.at(tau, v, patch);
        let velocity = solve_one(&here.jacobian, &here.drift)?;
        Some(velocity.map(|z| -z * speed))
    }

    /// Takes a Runge-Kutta step.
    fn predicted(&self, path: impl Fn(f64) -> [Complex<f64>; 2], v: &Point, s: f64, step: f64) -> Option<Point> {
        let patch = v.map(|z| z.conj());
        let ahead = |slope: &Point, part: f64| -> Point { std::array::from_fn(|k| v[k] + slope[k] * (part * step)) };
        let one = self.velocity(path(s), v, &patch)?;
        let two = self.velocity(path(s + 0.5 * step), &ahead(&one, 0.5), &patch)?;
        let three = self.velocity(path(s + 0.5 * step), &ahead(&two, 0.5), &patch)?;
        let four = self.velocity(path(s + step), &ahead(&three, 1.0), &patch)?;
        Some(std::array::from_fn(|k| v[k] + (one[k] + 2.0 * (two[k] + three[k]) + four[k]) * (step / 6.0)))
    }

    /// Applies Newton's method. Returns the point and the prediction error; `None` if that is too large or it does not converge.
    fn corrected(&self, tau: Complex<f64>, start: &Point) -> Option<(Point, f64)> {
        let mut v = unit(start)?;
        let mut off = 0.0;
        let mut before = f64::INFINITY;
        for count in 0..CORRECTIONS {
            let patch = v.map(|z| z.conj());
            let here = self.at(tau, &v, &patch);
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

    /// Follows a path from s to `to`; `None` if it cannot be followed.
    fn follow(
        &self,
        path: impl Fn(f64) -> [Complex<f64>; 2] + Copy,
        start: &Point,
        from: f64,
        to: f64,
        most: usize,
    ) -> Option<Point> {
        let mut v = unit(start)?;
        let whole = to - from;
        let (mut done, mut part) = (0.0, 0.1);
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
                if part < 1e-9 {
                    return None;
                }
            }
        }
        None
    }

    /// Carries a solution of the platform at the beginning to the one at the end.
    #[must_use]
    pub fn carry(&self, start: &Point) -> End {
        let arc = |s: f64| self.arc(s);
        let Some(near) = self.follow(arc, start, 1.0, END, MOST_STEPS) else { return End::Lost };
        self.regular_end(&near, END).unwrap_or_else(|| self.singular_end(&near))
    }

    /// Returns the end of a path that runs straight into a regular solution from s.
    fn regular_end(&self, near: &Point, s: f64) -> Option<End> {
        let v = self.follow(|s| self.arc(s), near, s, 0.0, LAST_STEPS)?;
        let [n, x] = sizes(&v);
        (x > FAR).then_some(if n < REGULAR_NULL { End::Null } else { End::Regular(v) })
    }

    /// Returns the end of a path by Cauchy's formula: the mean over a circle of tau, walked until the path closes.
    fn singular_end(&self, near: &Point) -> End {
        let (mut v, mut s) = (*near, END);
        for circle in 0..CIRCLES {
            if circle > 0 {
                let smaller = SMALLER * s;
                let Some(next) = self.follow(|s| self.arc(s), &v, s, smaller, MOST_STEPS) else { return End::Lost };
                (v, s) = (next, smaller);
                // By now a path that only passed near another solution has left it.
                if let Some(end) = self.regular_end(&v, s) {
                    return end;
                }
            }
            let Some(mean) = self.mean(&v, self.arc(s)[0]) else { continue };
            let Some(mean) = unit(&mean) else { continue };
            let here = self.at(Complex::from(0.0), &mean, &mean.map(|z| z.conj()));
            if here.values.iter().any(|value| value.norm() > HELD) {
                continue;
            }
            let [n, x] = sizes(&mean);
            return if x < FAR || n < NULL { End::Null } else { End::Singular(mean) };
        }
        End::Lost
    }

    /// Returns the mean of a solution over a circle through `tau`, walked until it closes.
    fn mean(&self, start: &Point, tau: Complex<f64>) -> Option<Point> {
        let patch = start.map(|z| z.conj());
        let begin = on_patch(start, &patch)?;
        let circle = |turn: f64| {
            let here = tau * Complex::from_polar(1.0, TAU * turn);
            [here, here * Complex::new(0.0, TAU)]
        };
        let mut v = *start;
        let mut sum = [Complex::from(0.0); 8];
        for turn in 1..=MOST_TURNS {
            for sample in 0..SAMPLES {
                let part = |k: usize| k as f64 / SAMPLES as f64;
                v = self.follow(circle, &v, part(sample), part(sample + 1), LAST_STEPS)?;
                let point = on_patch(&v, &patch)?;
                for (sum, z) in sum.iter_mut().zip(&point) {
                    *sum += z;
                }
            }
            let size = hermitian(&begin).sqrt();
            if distance(&on_patch(&v, &patch)?, &begin) < CLOSED * size {
                return Some(sum.map(|z| z / (turn * SAMPLES) as f64));
            }
        }
        None
    }
}

/// Returns `|N|` over `|x|^2`, and `|x|`.
fn sizes(v: &Point) -> [f64; 2] {
    let (x, _) = parts(v);
    let length = hermitian(&x);
    [scalar(&x, &x).norm() / length.max(f64::MIN_POSITIVE), length.sqrt()]
}
