//! Rotations by one vector: axis and angle, Euler vector, Rodrigues vector, Wiener vector.

use super::turn::Turn;
use crate::motion::Vector;
use crate::quaternion::Quaternion;
use crate::unit::{Analytic, Root, Unit, length};

/// Returns the quaternion of norm 1 whose first nonzero entry is positive; `None` if the ring lacks the root.
///
/// # Example
/// ```
/// use looproot_calculus::{quaternion::Quaternion, rotation::vectors::unit};
/// let q = unit(&Quaternion { scalar: 0.0, vector: [-3.0, 0.0, 4.0] }).unwrap();
/// assert!(q.vector.iter().zip([0.6, 0.0, -0.8]).all(|(a, b)| (a - b).abs() < 1e-15));
/// ```
#[must_use]
pub fn unit<R: Root>(q: &Quaternion<R>) -> Option<Quaternion<R>> {
    let parts = [&q.scalar, &q.vector[0], &q.vector[1], &q.vector[2]];
    let inverse = q.norm().sqrt()?.reciprocal()?;
    let scaled = parts.map(|c| c.mul(&inverse));
    let is_negative = scaled.iter().find(|c| !c.is_small()).is_some_and(Root::is_negative);
    let [scalar, x, y, z] = if is_negative { scaled.map(|c| c.neg()) } else { scaled };
    Some(Quaternion { scalar, vector: [x, y, z] })
}

/// Returns unit axis and half the angle, as cosine and sine, of a unit quaternion, with the angle in [0, pi]; `None` at the
/// identity, where every axis is possible.
fn axis_and_half<R: Root>(q: &Quaternion<R>) -> Option<(Vector<R>, R, R)> {
    let sine = length(&q.vector)?;
    if sine.is_small() {
        return None;
    }
    let inverse = sine.reciprocal()?;
    Some((q.vector.each_ref().map(|c| c.mul(&inverse)), q.scalar.clone(), sine))
}

/// Returns unit axis and angle in [0, pi] of a unit quaternion as from [`unit()`]; `None` at the identity, which has any axis.
#[must_use]
pub fn axis_angle<R: Analytic>(q: &Quaternion<R>) -> Option<(Vector<R>, R)> {
    let (axis, cos, sin) = axis_and_half(q)?;
    let half = R::atan2(&sin, &cos)?;
    Some((axis, half.add(&half)))
}

/// Returns unit axis and angle of a unit quaternion, the angle by cosine and sine, which may be rational; `None` at the identity.
/// [`Turn::about`] leads back.
///
/// # Example
/// ```
/// use looproot_calculus::{quaternion::Quaternion, rotation::vectors::axis_turn};
/// use rug::Rational;
/// let q = Quaternion { scalar: Rational::from((4, 5)), vector: [(0, 1), (0, 1), (3, 5)].map(Rational::from) };
/// let (axis, turn) = axis_turn(&q).unwrap();
/// assert_eq!((&axis[2], turn.cos, turn.sin), (&Rational::from(1), Rational::from((7, 25)), Rational::from((24, 25))));
/// ```
#[must_use]
pub fn axis_turn<R: Root>(q: &Quaternion<R>) -> Option<(Vector<R>, Turn<R>)> {
    let (axis, cos, sin) = axis_and_half(q)?;
    Some((axis, Turn::from_half(&cos, &sin)?))
}

/// Returns a quaternion of the rotation about an axis of any length; `None` for the zero vector.
///
/// # Example
/// ```
/// use looproot_calculus::rotation::vectors::from_axis_angle;
/// let q = from_axis_angle(&[0.0, 0.0, 2.0], &std::f64::consts::FRAC_PI_2).unwrap();
/// assert!((q.scalar - 0.5_f64.sqrt()).abs() < 1e-15 && (q.vector[2] - 0.5_f64.sqrt()).abs() < 1e-15);
/// ```
#[must_use]
pub fn from_axis_angle<R: Analytic>(axis: &Vector<R>, angle: &R) -> Option<Quaternion<R>> {
    let half = angle.over(&R::from_integer(2))?;
    let (cos, sin) = half.cos_sin_of();
    let axis = crate::unit::direction(axis)?;
    Some(Quaternion { scalar: cos, vector: axis.map(|c| c.mul(&sin)) })
}

/// Returns the Euler vectors `n angle`, angle in [0, pi], of a unit quaternion as from [`unit()`]: one, or two for the angle pi.
#[must_use]
pub fn euler_vectors<R: Analytic>(q: &Quaternion<R>) -> Vec<Vector<R>> {
    let Some((axis, angle)) = axis_angle(q) else { return vec![std::array::from_fn(|_| R::zero())] };
    let vector = axis.map(|c| c.mul(&angle));
    if q.scalar.is_small() {
        let other = vector.each_ref().map(R::neg);
        return vec![vector, other];
    }
    vec![vector]
}

/// Returns the quaternion of an Euler vector, the exponential of half of it.
#[must_use]
pub fn from_euler_vector<R: Analytic>(v: &Vector<R>) -> Option<Quaternion<R>> {
    let angle = length(v)?;
    if angle.is_small() {
        // sin(x)/x is 1 to rounding here; the linear part carries derivatives.
        let half = R::from_integer(2).reciprocal()?;
        return Some(Quaternion { scalar: R::one(), vector: v.each_ref().map(|c| c.mul(&half)) });
    }
    from_axis_angle(v, &angle)
}

/// Returns the Rodrigues vector `n tan(angle/2)`; `None` for the angle pi, where it is infinite.
#[must_use]
pub fn rodrigues<R: Unit>(q: &Quaternion<R>) -> Option<Vector<R>> {
    if q.scalar.is_small() {
        return None;
    }
    let inverse = q.scalar.reciprocal()?;
    Some(q.vector.each_ref().map(|c| c.mul(&inverse)))
}

/// Returns a quaternion of a Rodrigues vector, up to a factor.
#[must_use]
pub fn from_rodrigues<R: Unit>(v: &Vector<R>) -> Quaternion<R> {
    Quaternion { scalar: R::one(), vector: v.clone() }
}

/// Returns the Wiener vectors `n tan(angle/4)` of a unit quaternion: two, the second being the shadow of the first, or one at
/// the identity, where the shadow is infinite.
///
/// # Example
/// ```
/// use looproot_calculus::{quaternion::Quaternion, rotation::vectors::wiener};
/// let found = wiener(&Quaternion { scalar: 0.2, vector: [0.4, 0.4, 0.8] });
/// assert!((found[0][2] - 2.0 / 3.0).abs() < 1e-15 && (found[1][2] + 1.0).abs() < 1e-15);
/// ```
#[must_use]
pub fn wiener<R: Unit>(q: &Quaternion<R>) -> Vec<Vector<R>> {
    let over = |divisor: R| {
        if divisor.is_small() {
            return None;
        }
        let inverse = divisor.reciprocal()?;
        Some(q.vector.each_ref().map(|c| c.mul(&inverse)))
    };
    let (near, shadow) = (over(R::one().add(&q.scalar)), over(q.scalar.sub(&R::one())));
    near.into_iter().chain(shadow).collect()
}

/// Returns a quaternion of a Wiener vector, up to a factor: `1 - v.v + 2 v`.
#[must_use]
pub fn from_wiener<R: Unit>(v: &Vector<R>) -> Quaternion<R> {
    let square = crate::motion::dot(v, v);
    Quaternion { scalar: R::one().sub(&square), vector: v.each_ref().map(|c| c.add(c)) }
}
