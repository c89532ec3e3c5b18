//! A parameter homotopy: the solutions of a general platform, carried to a special one.
//!
//! Points and squared lengths of the legs move along `target + tau (start - target)`, with tau from 1 to 0 on an arc of the
//! complex numbers. With probability one no platform on the arc but the last is special. A solution to which several paths
//! converge is counted as often as paths lead to it.

use crate::closure::study::{Form, Leg, scalar};
use crate::solve::paths::{Family, Here, arc, unit};
use crate::solve::pose::{Eight, hermitian, parts};
use num_complex::Complex;
use std::f64::consts::TAU;

type Point = Eight<Complex<f64>>;

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

fn distance(v: &Point, w: &Point) -> f64 {
    (0..8).map(|k| (v[k] - w[k]).norm_sqr()).sum::<f64>().sqrt()
}

/// Returns the multiple of a point on which a linear form is 1.
fn on_patch(v: &Point, patch: &Point) -> Option<Point> {
    let value: Complex<f64> = v.iter().zip(patch).map(|(v, p)| v * p).sum();
    let scale = value.inv();
    scale.is_finite().then(|| v.map(|z| z * scale))
}

impl Family<8> for Homotopy<'_> {
    fn at(&self, tau: Complex<f64>, v: &Point, patch: &Point) -> Here<8> {
        let (x, y) = parts(v);
        let mut here = Here::zero();
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
}

impl Homotopy<'_> {
    /// Carries a solution of the platform at the beginning to the one at the end.
    #[must_use]
    pub fn carry(&self, start: &Point) -> End {
        let arc = |s: f64| arc(self.bend, s);
        let Some(near) = self.follow(arc, start, 1.0, END, MOST_STEPS) else { return End::Lost };
        self.regular_end(&near, END).unwrap_or_else(|| self.singular_end(&near))
    }

    /// Returns the end of a path that runs straight into a regular solution from s.
    fn regular_end(&self, near: &Point, s: f64) -> Option<End> {
        let v = self.follow(|s| arc(self.bend, s), near, s, 0.0, LAST_STEPS)?;
        let [n, x] = sizes(&v);
        (x > FAR).then_some(if n < REGULAR_NULL { End::Null } else { End::Regular(v) })
    }

    /// Returns the end of a path by Cauchy's formula: the mean over a circle of tau, walked until the path closes.
    fn singular_end(&self, near: &Point) -> End {
        let (mut v, mut s) = (*near, END);
        for circle in 0..CIRCLES {
            if circle > 0 {
                let smaller = SMALLER * s;
                let Some(next) = self.follow(|s| arc(self.bend, s), &v, s, smaller, MOST_STEPS) else {
                    return End::Lost;
                };
                (v, s) = (next, smaller);
                // By now a path that only passed near another solution has left it.
                if let Some(end) = self.regular_end(&v, s) {
                    return end;
                }
            }
            let Some(mean) = self.mean(&v, arc(self.bend, s)[0]) else { continue };
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
