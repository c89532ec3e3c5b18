//! The values that one unknown has at the solutions: the roots of its eliminant, as cosines and sines.

use super::eliminant::{Eliminant, WIDE};
use super::roots::{Isolated, isolated_in_balls};
use crate::algebra::ball::Ball;
use crate::algebra::ring::Ring;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::Motion;
use num_complex::Complex;
use rug::Float;

/// Cosine and sine of an angle, or a distance and 0.
pub type Pair<const BITS: u32> = (Ball<BITS>, Ball<BITS>);

/// The motion of an unknown.
#[must_use]
pub fn moved<const BITS: u32>(variable: Variable, (first, second): &Pair<BITS>) -> Motion<Ball<BITS>> {
    match variable {
        Variable::Rotation => Motion::rotation_z(first.clone(), second.clone()),
        Variable::Translation => Motion::translation_z(first.clone()),
    }
}

/// One root of an eliminant.
#[derive(Clone, Debug)]
pub struct Value<const BITS: u32> {
    /// Cosine and sine of the unknown there.
    pub pair: Pair<BITS>,
    /// The order of the root: upper bound on the number of solutions with this value, with multiplicity.
    pub order: usize,
    /// Whether the value is real.
    pub is_real: bool,
}

/// Returns all roots of an eliminant, the one at infinity included; `None` where this precision does not separate them.
#[must_use]
pub fn values<const BITS: u32>(eliminant: &Eliminant) -> Option<Vec<Value<BITS>>> {
    let mut all = Vec::new();
    for (factor, order) in &eliminant.factors {
        for Isolated { ball, is_real } in isolated_in_balls(&shorter(factor))? {
            all.push(Value { pair: pair(&ball)?, order: *order, is_real });
        }
    }
    if eliminant.at_pi > 0 {
        let pair = (Ball::one().neg(), Ball::zero());
        all.push(Value { pair, order: eliminant.at_pi, is_real: true });
    }
    // Roots of different factors are distinct, and their balls are small: the test fails only for crowded roots.
    let apart = |j: usize, k: usize| !meet(&all[j].pair, &all[k].pair);
    let are_apart = (0..all.len()).all(|k| (0..k).all(|j| apart(j, k)));
    are_apart.then_some(all)
}

/// Coefficients in balls of fewer digits.
fn shorter<const BITS: u32>(coefficients: &[Ball<WIDE>]) -> Vec<Ball<BITS>> {
    coefficients.iter().map(Ball::of_precision).collect()
}

/// Returns cosine and sine of the angle with this half-angle tangent; `None` where the ball may contain +-i.
fn pair<const BITS: u32>(tangent: &Ball<BITS>) -> Option<Pair<BITS>> {
    let square = tangent.mul(tangent);
    let scale = Ball::one().add(&square).inverse()?;
    Some((Ball::one().sub(&square).mul(&scale), tangent.add(tangent).mul(&scale)))
}

/// Returns whether two pairs may be equal.
#[must_use]
pub fn meet<const BITS: u32>(one: &Pair<BITS>, other: &Pair<BITS>) -> bool {
    one.0.overlaps(&other.0) && one.1.overlaps(&other.1)
}

/// Cosine and sine of all angles within a radius of an angle.
#[must_use]
pub fn pair_around<const BITS: u32>(angle: Complex<f64>, radius: f64) -> Pair<BITS> {
    let (re, im) = (Float::with_val(BITS, angle.re), Float::with_val(BITS, angle.im));
    let (sin, cos) = re.sin_cos(Float::new(BITS));
    let (sinh, cosh) = im.clone().sinh_cosh(Float::new(BITS));
    // Both functions have a derivative of absolute value at most cosh of the imaginary part. The functions are rounded to
    // `BITS` bits, each product again: three roundings, of which the ball of one product includes one.
    let bound = Float::with_val(64, im.abs() + radius).cosh();
    let rounding = Float::with_val(64, &bound * 8_u32) >> BITS;
    let error = Float::with_val(64, &bound * radius) * 1.01_f64 + rounding;
    let product = |a: &Float, b: &Float| Float::with_val(BITS, a * b);
    let ball = |re: Float, im: Float| Ball::point(&re, &im).enlarged(&error);
    (ball(product(&cos, &cosh), -product(&sin, &sinh)), ball(product(&sin, &cosh), product(&cos, &sinh)))
}
