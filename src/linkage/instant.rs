//! The motion of one body of an assembly against another at an instant: pole, inflection circle, centres of curvature.

use super::rates::{Body, Moving};
use crate::algebra::ring::Ring;
use looproot_calculus::instant::plane::Instant;
use looproot_calculus::unit::{Analytic, Unit};
use num_complex::Complex;

/// A share below this stands for 0.
const ROUNDED: f64 = 1e-12;

/// A body against another one, by the angle between them.
#[derive(Clone, Debug)]
pub struct Relative {
    /// Pole, a_2 and a_3, in axes of the second body.
    pub instant: Instant<f64>,
    /// The angular velocity.
    pub omega: f64,
    /// The angular acceleration.
    pub alpha: f64,
}

/// Returns the place of a body relative to another one: its angle, and its origin in axes of that body.
#[must_use]
pub fn against(body: &Body, base: &Body) -> Body {
    let angle = body.angle.sub(&base.angle);
    let (cos, sin) = base.angle.cos_sin_of();
    let [x, y] = [0, 1].map(|k| body.origin[k].sub(&base.origin[k]));
    Body { angle, origin: [cos.mul(&x).add(&sin.mul(&y)), cos.mul(&y).sub(&sin.mul(&x))] }
}

/// The derivative of a series, one order shorter.
fn slope(series: &Moving) -> Moving {
    let [_, a, b, c] = series.coefficients;
    Moving { coefficients: [a, 2.0 * b, 3.0 * c, 0.0] }
}

/// Velocity and acceleration.
#[must_use]
pub fn derivatives(series: &Moving) -> [f64; 2] {
    [series.coefficients[1], 2.0 * series.coefficients[2]]
}

/// The instant of a body that moves as `relative`; `None` where it does not turn.
#[must_use]
pub fn relative(relative: &Body) -> Option<Relative> {
    let [omega, alpha] = derivatives(&relative.angle);
    if !(omega.abs() > ROUNDED) {
        return None;
    }
    let inverse = slope(&relative.angle).reciprocal()?;
    // Derivatives by the angle: each is the derivative by time over that of the angle, and loses one order.
    let mut now = relative.origin;
    let mut list = [Complex::new(0.0, 0.0); 4];
    for one in &mut list {
        *one = Complex::new(now[0].coefficients[0], now[1].coefficients[0]);
        now = now.map(|part| slope(&part).mul(&inverse));
    }
    // Rounding beside the square of the angular velocity is no angular acceleration.
    let alpha = if alpha.abs() <= ROUNDED * omega * omega { 0.0 } else { alpha };
    Some(Relative { instant: Instant::of(&list), omega, alpha })
}

/// The pole of a body against another one in axes of the ground: the point with the same velocity in both. `None` where they
/// do not turn against one another.
#[must_use]
pub fn pole(body: &Body, base: &Body) -> Option<[f64; 2]> {
    let rate = |body: &Body| {
        // The velocity of the point of the body at the origin of the ground.
        let omega = body.angle.coefficients[1];
        let [x, y] = [0, 1].map(|k| body.origin[k].coefficients[0]);
        let [vx, vy] = [0, 1].map(|k| body.origin[k].coefficients[1]);
        (omega, [vx + omega * y, vy - omega * x])
    };
    let ((one, [ax, ay]), (two, [bx, by])) = (rate(body), rate(base));
    let omega = one - two;
    (omega.abs() > ROUNDED).then(|| [(by - ay) / omega, (ax - bx) / omega])
}
