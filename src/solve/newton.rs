//! The closure of a loop in numbers, its derivative, and Newton's method that only ever goes downhill.

use super::dense::{inverse, times};
use super::scalar::{Number, Scalar};
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::Motion;
use num_complex::Complex;

/// Six numbers or residuals.
pub type Six<S> = [S; 6];

/// The closure E = prod V_j G_j of a loop at some unknowns.
#[derive(Clone, Debug)]
pub struct Closure<S> {
    /// The skew-symmetric part of the rotation of E as a vector, and its translation.
    pub residual: Six<S>,
    /// Column j is the twist of unknown j in the frame of the cut: the derivative of `residual` where E = I.
    pub jacobian: [Six<S>; 6],
    /// The largest entry of |E - I|.
    pub defect: f64,
    /// The largest one of its rotation.
    pub turn: f64,
    /// The largest one of its translation.
    pub shift: f64,
    /// The trace of the rotation of E.
    pub trace: S,
    /// Norms for error bounds, one set per unknown.
    pub norms: [StepNorms; 6],
    /// Error of the closure due to the constants, beyond the rounding that error bounds include.
    pub data_error: f64,
}

/// Row-sum norms at one step of the product round the loop.
#[derive(Clone, Copy, Debug, Default)]
pub struct StepNorms {
    /// Norm of the product of all steps before this one.
    pub before: f64,
    /// Norm of this step.
    pub step: f64,
    /// Norm of the inverse of the product up to and including this step, which by closure is the product of all steps behind it.
    pub behind: f64,
    /// Norm of the twist of this unknown as a 4 x 4 matrix.
    pub twist: f64,
    /// Derivative of that twist with respect to the frame before this step: of the direction of its axis, times 1 and the
    /// distance of the frame for a rotation.
    pub lever: f64,
}

impl<S> Closure<S> {
    /// Takes note that the constant of this step may be off by a matrix of row-sum norm `off`.
    pub fn constant_is_off(&mut self, step: usize, off: f64) {
        // The step is at least as large as its unknown's motion alone.
        let norms = self.norms[step];
        self.data_error += norms.before * norms.step * norms.behind * off;
    }

    /// Returns the largest growth of rounding errors round the loop: 1 for real unknowns, the largest product of norms for
    /// complex ones, whose imaginary parts may make it large.
    #[must_use]
    pub fn growth(&self, real: bool) -> f64 {
        if real { 1.0 } else { self.norms.iter().map(|n| n.before * n.step * n.behind).fold(1.0, f64::max) }
    }
}

impl<S: Number> Closure<S> {
    /// The defect over the size of the terms that cancel in it. For real unknowns the entries of rotations are at most 1, and the
    /// translation is a sum of the links and joint translations round the loop: it counts in parts of their whole length, or of
    /// the scale of lengths if that is larger. For complex unknowns the size is the largest product of the norms of all steps
    /// before, at and behind one of them.
    #[must_use]
    pub fn relative_defect(&self, closed: &ClosedLoop<S::Real>, unknowns: &Six<Complex<f64>>, real: bool) -> f64
    where
        S::Real: Number,
    {
        if !real {
            return self.defect / self.growth(false);
        }
        let link = |motion: &Motion<S::Real>| motion.translation.iter().map(|x| x.square_size()).sum::<f64>().sqrt();
        let slides = unknowns.iter().zip(closed.variables).filter(|(_, kind)| *kind == Variable::Translation);
        let length = closed.constants.iter().map(link).sum::<f64>() + slides.map(|(x, _)| x.norm()).sum::<f64>();
        self.defect_over(length.max(1.0))
    }

    /// The defect with its translation in parts of this length.
    fn defect_over(&self, length: f64) -> f64 {
        larger(self.turn, self.shift / length)
    }
}

fn frame_norm<S: Number>(frame: &Motion<S>) -> f64 {
    let mut largest = 1.0_f64;
    for i in 0..3 {
        let row = &frame.rotation[i];
        largest = largest.max(row[0].bound() + row[1].bound() + row[2].bound() + frame.translation[i].bound());
    }
    largest
}

fn inverse_norm<S: Number>(frame: &Motion<S>) -> f64 {
    let (r, t) = (&frame.rotation, &frame.translation);
    let mut largest = 1.0_f64;
    for j in 0..3 {
        let back = r[0][j].mul(&t[0]).add(&r[1][j].mul(&t[1])).add(&r[2][j].mul(&t[2]));
        largest = largest.max(r[0][j].bound() + r[1][j].bound() + r[2][j].bound() + back.bound());
    }
    largest
}

/// `frame * constant`.
#[inline(always)]
fn behind<S: Number>(frame: &Motion<S>, constant: &Motion<S::Real>) -> Motion<S> {
    let row = |r: &[S; 3], column: [S::Real; 3]| {
        r[0].times(column[0]).add(&r[1].times(column[1])).add(&r[2].times(column[2]))
    };
    let g = &constant.rotation;
    Motion {
        rotation: std::array::from_fn(|i| {
            std::array::from_fn(|j| row(&frame.rotation[i], [g[0][j], g[1][j], g[2][j]]))
        }),
        translation: std::array::from_fn(|i| row(&frame.rotation[i], constant.translation).add(&frame.translation[i])),
    }
}

/// `frame * V(x)` for an unknown given by (cos, sin), or by its distance in the first place.
#[inline(always)]
pub fn turn<S: Number>(frame: &mut Motion<S>, variable: Variable, (first, second): (S, S)) {
    for i in 0..3 {
        let row = &mut frame.rotation[i];
        match variable {
            Variable::Rotation => {
                let (x, y) = (row[0], row[1]);
                row[0] = x.mul(&first).add(&y.mul(&second));
                row[1] = y.mul(&first).sub(&x.mul(&second));
            }
            Variable::Translation => {
                frame.translation[i] = frame.translation[i].add(&row[2].mul(&first));
            }
        }
    }
}

/// The pair with which an unknown enters a motion: (cos, sin) of an angle, (distance, 0) of a translation.
#[inline(always)]
pub fn coordinates<S: Scalar>(variable: Variable, value: S) -> (S, S) {
    match variable {
        Variable::Rotation => value.cos_sin_of(),
        Variable::Translation => (value, S::zero()),
    }
}

/// `frame * V(x) * constant`.
#[must_use]
pub fn behind_step<S: Number>(
    frame: &Motion<S>,
    variable: Variable,
    pair: (S, S),
    constant: &Motion<S::Real>,
) -> Motion<S> {
    let mut turned = frame.clone();
    turn(&mut turned, variable, pair);
    behind(&turned, constant)
}

/// The product of the first `count` steps of the loop.
#[must_use]
pub fn product<S: Number>(closed: &ClosedLoop<S::Real>, values: &[(S, S)], count: usize) -> Motion<S> {
    let mut frame = Motion::identity();
    for j in 0..count {
        turn(&mut frame, closed.variables[j], values[j]);
        frame = behind(&frame, &closed.constants[j]);
    }
    frame
}

/// Evaluates the closure of a loop, its derivative and the norms its error bounds need.
#[must_use]
#[inline(always)]
pub fn closure<S: Scalar>(closed: &ClosedLoop<f64>, unknowns: &Six<S>) -> Closure<S> {
    closure_at(closed, &std::array::from_fn(|j| coordinates(closed.variables[j], unknowns[j])))
}

/// As [`closure`], with the unknowns given by the pairs with which they enter the motions.
#[must_use]
#[inline(always)]
pub fn closure_at<S: Number>(closed: &ClosedLoop<S::Real>, pairs: &[(S, S); 6]) -> Closure<S>
where
    S::Real: Number,
{
    let mut frame: Motion<S> = Motion::identity();
    let mut jacobian = [[S::zero(); 6]; 6];
    let mut norms = [StepNorms::default(); 6];
    for j in 0..6 {
        let z: [S; 3] = std::array::from_fn(|i| frame.rotation[i][2]);
        let p = &frame.translation;
        let moment = crate::kinematics::motion::cross(p, &z);
        let before = frame_norm(&frame);
        let constant = &closed.constants[j];
        let pair = pairs[j];
        let step = match closed.variables[j] {
            Variable::Rotation => {
                for i in 0..3 {
                    jacobian[i][j] = z[i];
                    jacobian[3 + i][j] = moment[i];
                }
                let z = z.map(Number::bound);
                norms[j].lever = (z[0] + z[1] + z[2]) * (1.0 + p[0].bound() + p[1].bound() + p[2].bound());
                norms[j].twist = (z[1] + z[2] + moment[0].bound())
                    .max(z[0] + z[2] + moment[1].bound())
                    .max(z[0] + z[1] + moment[2].bound());
                frame_norm(constant) * (pair.0.bound() + pair.1.bound()).max(1.0)
            }
            Variable::Translation => {
                for i in 0..3 {
                    jacobian[3 + i][j] = z[i];
                }
                let z = z.map(Number::bound);
                norms[j].lever = z[0] + z[1] + z[2];
                norms[j].twist = z.into_iter().fold(0.0, f64::max);
                frame_norm(constant) + pair.0.bound()
            }
        };
        turn(&mut frame, closed.variables[j], pair);
        frame = behind(&frame, constant);
        norms[j] = StepNorms { before, step, behind: inverse_norm(&frame), ..norms[j] };
    }
    let r = &frame.rotation;
    let half = |x: S, y: S| x.sub(&y).halved();
    let t = frame.translation;
    let (mut turn, mut shift) = (0.0_f64, 0.0_f64);
    for i in 0..3 {
        for j in 0..3 {
            let off = if i == j { r[i][j].sub(&S::one()) } else { r[i][j] };
            turn = larger(turn, off.size());
        }
        shift = larger(shift, t[i].size());
    }
    Closure {
        residual: [half(r[2][1], r[1][2]), half(r[0][2], r[2][0]), half(r[1][0], r[0][1]), t[0], t[1], t[2]],
        jacobian,
        defect: larger(turn, shift),
        turn,
        shift,
        trace: r[0][0].add(&r[1][1]).add(&r[2][2]),
        norms,
        data_error: 0.0,
    }
}

/// The longest translation of some unknowns, at least 1: the size of a closed loop.
#[must_use]
pub fn reach(variables: &[Variable; 6], unknowns: &Six<Complex<f64>>) -> f64 {
    let translations = unknowns.iter().zip(variables).filter(|(_, variable)| **variable == Variable::Translation);
    translations.map(|(x, _)| x.norm()).fold(1.0, f64::max)
}

/// The maximum that keeps NaN, so that nonsense never passes a test of smallness.
fn larger(x: f64, y: f64) -> f64 {
    if y > x || y.is_nan() { y } else { x }
}

/// Unknowns polished on the closure equations.
#[derive(Clone, Debug)]
pub struct Polished<S> {
    /// The unknowns.
    pub unknowns: Six<S>,
    /// The closure there.
    pub closure: Closure<S>,
    /// The inverse of the Jacobian there or one step before; `None` where it is singular.
    pub inverse: Option<[Six<S>; 6]>,
    /// The defect before the first step.
    pub raw: f64,
    /// The distance that the polish moved: the largest change of an unknown.
    pub moved: f64,
}

/// Closure defects below this are rounding: no further step can improve them.
const ROUNDING: f64 = 2e-15;
/// Enough for linear convergence to a double root to come down to rounding.
const MOST_STEPS: usize = 100;
/// Number of steps after which the defect must have halved: a step reduces it to a quarter beside a double root and to a third
/// beside a triple one, and candidates that damped steps do not improve are dropped.
const PATIENCE: usize = 10;
/// The largest change of an unknown in a damped step.
const LONGEST_STEP: f64 = 0.5;

/// Newton's method on all six unknowns: a step is taken only if the defect falls; where a full step does not help,
/// a damped one is tried; ends when nothing improves.
#[must_use]
pub fn polish<S: Scalar>(closed: &ClosedLoop<f64>, start: &Six<S>) -> Polished<S> {
    let mut unknowns = *start;
    let mut here = closure(closed, &unknowns);
    let raw = here.defect;
    // Beside long translations, whose rounding is as long, the rotation counts in full.
    let length = reach(&closed.variables, &start.map(Scalar::to_complex));
    let mut known_inverse = None;
    let mut before = f64::INFINITY;
    for count in 0..MOST_STEPS {
        let floor = ROUNDING.max(1e-16 * here.growth(S::REAL));
        let defect = here.defect_over(length);
        if count % PATIENCE == 0 {
            if count > 0 && !(defect < 0.5 * before) {
                break;
            }
            before = defect;
        }
        if !defect.is_finite() || (defect <= floor && known_inverse.is_some()) {
            break;
        }
        let inverted = inverse(&here.jacobian);
        if let Some(matrix) = &inverted {
            let step = times(matrix, &here.residual);
            let next: Six<S> = std::array::from_fn(|k| unknowns[k].sub(&step[k]));
            let there = closure(closed, &next);
            let left = there.defect_over(length);
            if left < 0.5 * defect {
                (unknowns, here, known_inverse) = (next, there, inverted);
                continue;
            }
            // At a regular root one step from here lands on rounding; creeping just above it is noise.
            if left < defect && left < 50.0 * floor {
                (unknowns, here, known_inverse) = (next, there, inverted);
                break;
            }
            known_inverse = inverted;
        }
        if defect <= 5.0 * floor && count > 0 {
            break;
        }
        let Some((next, there)) = damped(closed, &unknowns, &here, length) else { break };
        (unknowns, here) = (next, there);
        known_inverse = None;
    }
    if known_inverse.is_none() {
        known_inverse = inverse(&here.jacobian);
    }
    let moved = (0..6).map(|k| unknowns[k].sub(&start[k]).size()).fold(0.0, larger);
    Polished { unknowns, closure: here, inverse: known_inverse, raw, moved }
}

/// Comes near a real solution from anywhere, if there is one downhill.
#[must_use]
pub fn approach(closed: &ClosedLoop<f64>, start: &Six<f64>) -> Six<f64> {
    downhill(closed, start, 1e-6, 60, |defect| 1e-3 * defect.min(1.0))
}

/// Comes from nearby to a real solution at which the equations are dependent, where Newton's steps only halve the distance.
#[must_use]
pub fn approach_singular(closed: &ClosedLoop<f64>, start: &Six<f64>) -> Six<f64> {
    // The smallest singular value has shrunk to the root of the defect: more damping than that slows the steps down.
    downhill(closed, start, 1e-13, 200, |defect| (1e-6 * defect).max(1e-15))
}

/// Damped steps on the whole rotation angle of the closure, of which the skew part used near a solution sees only the
/// sine, until the loop closes to `goal`, or after so many steps; `damping` is that at a defect.
fn downhill(
    closed: &ClosedLoop<f64>,
    start: &Six<f64>,
    goal: f64,
    steps: usize,
    damping: impl Fn(f64) -> f64,
) -> Six<f64> {
    /// The search ends after this many steps without progress.
    const IDLE: usize = 10;
    let mut unknowns = *start;
    let mut before = f64::INFINITY;
    for count in 0..steps {
        let mut here = closure(closed, &unknowns);
        if here.defect < goal {
            break;
        }
        if count % IDLE == 0 {
            if !(here.defect < 0.9 * before) {
                break;
            }
            before = here.defect;
        }
        let [x, y, z, ..] = here.residual;
        let sine = (x * x + y * y + z * z).sqrt();
        let angle = sine.atan2(0.5 * (here.trace - 1.0));
        if sine > 0.0 {
            for value in &mut here.residual[..3] {
                *value *= angle / sine;
            }
        }
        let Some(step) = damped_step(&here, damping(here.defect)) else { break };
        for (x, d) in unknowns.iter_mut().zip(step) {
            *x -= d;
        }
    }
    unknowns
}

/// The step d of `(J* J + l^2) d = J* F`, no longer than [`LONGEST_STEP`] in any unknown.
fn damped_step<S: Scalar>(here: &Closure<S>, damping: f64) -> Option<Six<S>> {
    let j = &here.jacobian;
    let product = |a: usize, b: usize| (0..6).fold(S::zero(), |sum, i| sum.add(&j[i][a].conjugate().mul(&j[i][b])));
    let mut normal: [Six<S>; 6] = std::array::from_fn(|a| std::array::from_fn(|b| product(a, b)));
    let gradient: Six<S> =
        std::array::from_fn(|a| (0..6).fold(S::zero(), |sum, i| sum.add(&j[i][a].conjugate().mul(&here.residual[i]))));
    let scale = (0..6).map(|a| normal[a][a].size()).fold(0.0, f64::max);
    for (a, row) in normal.iter_mut().enumerate() {
        row[a] = row[a].add(&S::from_f64(damping * scale));
    }
    let step = times(&inverse(&normal)?, &gradient);
    // Far from a solution the linear model holds for a fraction of a turn at best.
    let longest = step.iter().map(|x| x.size()).fold(0.0, larger);
    let shortened = if longest > LONGEST_STEP { LONGEST_STEP / longest } else { 1.0 };
    Some(step.map(|x| x.times(shortened)))
}

/// The best of some Levenberg-Marquardt steps, from none to strong damping, that go downhill.
fn damped<S: Scalar>(
    closed: &ClosedLoop<f64>,
    unknowns: &Six<S>,
    here: &Closure<S>,
    length: f64,
) -> Option<(Six<S>, Closure<S>)> {
    let mut best: Option<(Six<S>, Closure<S>)> = None;
    for damping in [0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-4, 1e-2] {
        let Some(step) = damped_step(here, damping) else { continue };
        let next: Six<S> = std::array::from_fn(|k| unknowns[k].sub(&step[k]));
        let there = closure(closed, &next);
        if there.defect_over(length) < best.as_ref().map_or(here, |(_, closure)| closure).defect_over(length) {
            best = Some((next, there));
        }
    }
    best
}
