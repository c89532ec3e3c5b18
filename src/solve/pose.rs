//! Poses of a platform in Study's parameters, polished on the six leg quadrics and the Study condition.

use super::dense::{self, solve_one, times};
use super::scalar::{Extended, Number, Scalar};
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::ring::Ring;
use crate::closure::study::{Four, Leg, scalar};
use num_complex::Complex;

/// Study's parameters (x, y) of a pose, as one vector.
pub type Eight<S> = [S; 8];

/// The square of a length, in units of the platform, below which legs count as points.
const SHORT: f64 = 1e-18;
/// Newton steps before giving up.
const MOST_STEPS: usize = 12;
/// A step of this size (relative to x of norm 1) is the last.
const SETTLED: f64 = 1e-14;
/// A step of this size that no longer shrinks is rounding, magnified by a nearly singular Jacobian, where the equations
/// hold as below.
const ROUNDING: f64 = 1e-5;
/// A refined step of this size is the last.
const REFINED: f64 = 1e-18;
/// Relative residual of a solution polished as far as rounding allows, as a rule.
const ROUNDED: f64 = 1e-15;
/// Relative residual of a solution.
const CLOSED: f64 = 1e-14;

/// The equations at a point: values and derivatives of the six leg quadrics, halved, of the Study condition, and of the
/// patch that fixes the common factor.
#[derive(Clone, Copy, Debug)]
pub struct Equations<S> {
    /// The left sides; that of the patch counts as 0.
    pub values: Eight<S>,
    /// Their derivatives.
    pub jacobian: [Eight<S>; 8],
    /// `|w|^2 + L^2 |x|^2` of each leg, halved: what its value is small against. Legs much shorter than the platform count
    /// as a billionth of it.
    pub sizes: [f64; 6],
}

/// x and y of a point.
#[inline(always)]
pub fn parts<S: Copy>(v: &Eight<S>) -> (Four<S>, Four<S>) {
    ([v[0], v[1], v[2], v[3]], [v[4], v[5], v[6], v[7]])
}

/// `|x|^2 + ...` in the hermitian sense.
#[inline(always)]
pub fn hermitian<S: Scalar>(v: &[S]) -> f64 {
    v.iter().map(|x| if S::REAL { x.size() * x.size() } else { x.to_complex().norm_sqr() }).sum()
}

/// The equations at a point, with the patch `patch.x = const` through that point.
#[inline(always)]
pub fn equations<S: Number<Real: From<f64>>>(legs: &[Leg<f64>; 6], v: &Eight<S>, patch: &Four<S>) -> Equations<S> {
    equations_with(legs, v, patch, |x, c| x.times((*c).into()), |c| c.abs())
}

/// As [`equations`], for legs of more digits than f64 has.
pub fn extended_equations<R: Extended>(
    legs: &[Leg<R>; 6],
    v: &Eight<Complex<R>>,
    patch: &Four<Complex<R>>,
) -> Equations<Complex<R>> {
    equations_with(legs, v, patch, |x, c| x.times(*c), |c| c.to_f64().abs())
}

#[inline(always)]
fn equations_with<S: Number, C: Ring>(
    legs: &[Leg<C>; 6],
    v: &Eight<S>,
    patch: &Four<S>,
    times: impl Fn(&S, &C) -> S + Copy,
    absolute: impl Fn(&C) -> f64,
) -> Equations<S> {
    let (x, y) = parts(v);
    let square = |v: &Four<S>| v.iter().map(|x| x.size() * x.size()).sum::<f64>();
    let norm = scalar(&x, &x);
    let length = square(&x);
    let mut equations = Equations { values: [S::zero(); 8], jacobian: [[S::zero(); 8]; 8], sizes: [0.0; 6] };
    for (i, leg) in legs.iter().enumerate() {
        let w = leg.vector(&x, &y, times);
        equations.values[i] = scalar(&w, &w).sub(&times(&norm, &leg.square)).halved();
        let by_x = leg.half_slope(&w, &x, times);
        equations.jacobian[i][..4].copy_from_slice(&by_x);
        equations.jacobian[i][4..].copy_from_slice(&w);
        equations.sizes[i] = 0.5 * (square(&w) + (absolute(&leg.square) + SHORT) * length);
    }
    equations.values[6] = scalar(&x, &y);
    equations.jacobian[6][..4].copy_from_slice(&y);
    equations.jacobian[6][4..].copy_from_slice(&x);
    equations.jacobian[7][..4].copy_from_slice(patch);
    equations
}

/// The patch through a point that keeps the hermitian norm of x to first order.
#[inline(always)]
pub fn patch<S: Scalar>(v: &Eight<S>) -> Four<S> {
    std::array::from_fn(|k| v[k].conjugate())
}

impl<S: Number> Equations<S> {
    /// The largest relative residual of a leg, `|l^2 - L^2|` over `|l|^2 + L^2`.
    pub fn residual(&self) -> f64 {
        self.values.iter().zip(&self.sizes).map(|(value, size)| value.size() / size).fold(0.0, f64::max)
    }

    /// The condition number of the Jacobian in the row-sum norm, its rows scaled to 1.
    pub fn condition(&self, inverse: &[Eight<S>; 8]) -> f64 {
        let rows = self.jacobian.map(|row| row.iter().map(|x| x.bound()).sum::<f64>());
        inverse.iter().map(|row| row.iter().zip(rows).map(|(x, r)| x.bound() * r).sum::<f64>()).fold(0.0, f64::max)
    }
}

/// A complex number with twice the digits.
pub type Wide = Complex<DoubleDouble>;

/// A polished pose.
#[derive(Clone, Copy, Debug)]
pub struct PolishedPose<S> {
    /// Study's parameters, x of hermitian norm 1.
    pub study: Eight<S>,
    /// The equations there.
    pub equations: Equations<S>,
    /// The inverse of the Jacobian, near enough for bounds.
    pub inverse: [Eight<S>; 8],
    /// Size of the step that was left.
    pub step: f64,
}

impl<S: Scalar> PolishedPose<S> {
    /// The point behind the step that was left, if the legs are better met there.
    fn one_step_further(self, legs: &[Leg<f64>; 6], step: &Eight<S>) -> Self {
        let Some(study) = normalised(&std::array::from_fn(|k| self.study[k].sub(&step[k]))) else { return self };
        let there = equations(legs, &study, &patch(&study));
        if there.residual() < self.equations.residual() { Self { study, equations: there, ..self } } else { self }
    }
}

/// The point with x of hermitian norm 1; `None` for x = 0 and what is not finite.
#[inline(always)]
pub fn normalised<S: Scalar>(v: &Eight<S>) -> Option<Eight<S>> {
    let length = hermitian(&v[..4]);
    let whole = hermitian(v);
    (length > 0.0 && whole.is_finite()).then(|| {
        let scale = 1.0 / length.sqrt();
        v.map(|x| x.times(scale))
    })
}

/// Newton's method; `None` where it does not settle.
#[must_use]
pub fn polish<S: Scalar>(legs: &[Leg<f64>; 6], start: &Eight<S>) -> Option<PolishedPose<S>> {
    let mut v = normalised(start)?;
    let mut before = f64::INFINITY;
    let mut growing = 0;
    for _ in 0..MOST_STEPS {
        let here = equations(legs, &v, &patch(&v));
        let reach = v.iter().map(|x| x.size()).fold(1.0, f64::max);
        // Convergence is quadratic: what a step of 1e-8 leaves is rounding, as the inverse will tell.
        let near = before < 1e-8 * reach;
        let (inverse, step) = if near {
            let inverse = dense::inverse(&here.jacobian)?;
            (Some(inverse), times(&inverse, &here.values))
        } else {
            (None, solve_one(&here.jacobian, &here.values)?)
        };
        let size = step.iter().map(|x| x.size()).fold(0.0, f64::max);
        if !size.is_finite() {
            return None;
        }
        let stalls = !(size < 0.5 * before);
        let settled = near && size < SETTLED * reach;
        let at_rounding = settled || (stalls && size < ROUNDING * reach && here.residual() < CLOSED);
        if at_rounding {
            let inverse = inverse.or_else(|| dense::inverse(&here.jacobian))?;
            let stay = PolishedPose { study: v, equations: here, inverse, step: size };
            return Some(if here.residual() > ROUNDED { stay.one_step_further(legs, &step) } else { stay });
        }
        growing += usize::from(stalls);
        if growing > 3 {
            return None;
        }
        for (x, s) in v.iter_mut().zip(&step) {
            *x = x.sub(s);
        }
        v = normalised(&v)?;
        before = size;
    }
    None
}

/// A point as complex numbers.
#[must_use]
pub fn complex<S: Scalar>(v: &Eight<S>) -> Eight<Complex<f64>> {
    v.map(Scalar::to_complex)
}

/// Newton steps in numbers of twice the precision from a polished point, with the inverse known there: the point they
/// settle at, and its equations; `None` where they do not.
#[must_use]
pub fn refine(
    legs: &[Leg<DoubleDouble>; 6],
    v: &Eight<Complex<f64>>,
    inverse: &[Eight<Complex<f64>>; 8],
) -> Option<(Eight<Wide>, Equations<Wide>)> {
    let mut point = v.map(wide);
    let patch: Four<Wide> = std::array::from_fn(|k| wide(v[k].conj()));
    let narrow = |z: &Wide| Complex::new(z.re.to_f64(), z.im.to_f64());
    let mut before = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let here = extended_equations(legs, &point, &patch);
        let step = times(inverse, &here.values.each_ref().map(narrow));
        let size = step.iter().map(|x| x.size()).fold(0.0, f64::max);
        if size < REFINED {
            return Some((point, here));
        }
        if !(size < 0.5 * before) {
            return None;
        }
        for (x, s) in point.iter_mut().zip(&step) {
            *x = x.sub(&wide(*s));
        }
        before = size;
    }
    None
}

/// A pose in more digits: the point, its equations, and the inverse of their Jacobian.
pub type ExtendedPose<R> = (Eight<Complex<R>>, Equations<Complex<R>>, [Eight<Complex<R>>; 8]);

/// Newton's method in more digits all along, for poses very far away, where `N = x.x` is tiny; `None` where it does not
/// settle.
#[must_use]
pub fn polish_extended<R: Extended>(legs: &[Leg<R>; 6], start: &Eight<Complex<R>>) -> Option<ExtendedPose<R>> {
    let length: f64 = start[..4].iter().map(|x| x.square_size()).sum();
    let scale = R::from(1.0 / length.sqrt().max(f64::MIN_POSITIVE));
    let mut point = start.map(|x| x.times(scale));
    let patch: Four<Complex<R>> = std::array::from_fn(|k| point[k].conjugate());
    let mut before = f64::INFINITY;
    let mut growing = 0;
    for _ in 0..2 * MOST_STEPS {
        let here = extended_equations(legs, &point, &patch);
        let step = solve_one(&here.jacobian, &here.values)?;
        let reach = point.iter().map(|x| x.size()).fold(1.0, f64::max);
        let size = step.iter().map(|x| x.size()).fold(0.0, f64::max);
        if size < REFINED * reach {
            let inverse = dense::inverse(&here.jacobian)?;
            return Some((point, here, inverse));
        }
        growing += usize::from(!(size < 0.5 * before));
        if growing > 3 || !size.is_finite() {
            return None;
        }
        for (x, s) in point.iter_mut().zip(&step) {
            *x = x.sub(s);
        }
        before = size;
    }
    None
}

/// A complex number with twice the digits.
#[must_use]
pub fn wide(z: Complex<f64>) -> Wide {
    Complex::new(z.re.into(), z.im.into())
}
