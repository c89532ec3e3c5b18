//! The frame in which a joint given by its axis turns about z.

use super::chain::ScrewJoint;
use super::motion::{Motion, Vector, dot};
use super::placement::image;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::Number;
use crate::algebra::ring::Ring;
use rug::{Float, Rational};

/// Bits of the rounding of directions.
const BITS: u32 = 160;
/// Bits to which a stereographic coordinate is rounded.
const COORDINATE: i32 = 60;

/// A frame whose z axis lies along the axis of a screw joint and whose origin is its given point; `None` for an unlucky
/// prime.
///
/// A direction of irrational length has no rational unit vector: exact rings take one within rounding of it.
pub(super) fn axis_frame<R: Ring>(joint: &ScrewJoint) -> Option<Motion<R>> {
    let axis = joint.axis.each_ref().map(|x| x.rational().clone());
    let length = rational_length(&axis);
    let n = match &length {
        Some(length) => axis.each_ref().map(|x| Rational::from(x / length)),
        None => rational_direction(&axis),
    };
    let origin = joint.point.each_ref().map(|x| x.rational().clone());
    let is_down = n[2] == -1;
    let exact = frame(n, origin, |_| is_down, |x, y| Some(Rational::from(x / y)))?;
    let is_exact = length.is_some() && joint.axis.iter().chain(&joint.point).all(Number::is_exact);
    image(&exact, || if is_exact { None } else { enclosed(joint, is_down) })
}

fn enclosed(joint: &ScrewJoint, is_down: bool) -> Option<Motion<Enclosure>> {
    let known = |v: &[Number; 3]| -> Option<Vector<Enclosure>> {
        let [x, y, z] = v.each_ref().map(Enclosure::from_number);
        Some([x?, y?, z?])
    };
    let axis = known(&joint.axis)?;
    let length = dot(&axis, &axis).sqrt()?;
    let [x, y, z] = axis.each_ref().map(|x| x.over(&length));
    frame([x?, y?, z?], known(&joint.point)?, |_| is_down, Enclosure::over)
}

/// The frame of a unit vector at a point, turned the shortest way from the z axis, or first by a half turn about x where
/// that vector points down.
pub(super) fn frame<R: Ring>(
    n: Vector<R>,
    origin: Vector<R>,
    is_down: impl Fn(&R) -> bool,
    over: impl Fn(&R, &R) -> Option<R>,
) -> Option<Motion<R>> {
    let [x, y, z] = n;
    let is_down = is_down(&z);
    let n = if is_down { [x, y.neg(), z.neg()] } else { [x, y, z] };
    let mut rotation = shortest(&n, over)?;
    if is_down {
        rotation[1] = rotation[1].each_ref().map(R::neg);
        rotation[2] = rotation[2].each_ref().map(R::neg);
    }
    Some(Motion { rotation, translation: origin })
}

/// The shortest rotation from e_z to a unit vector n, that of the quaternion `(1 + n_z, -n_y, n_x, 0)`.
fn shortest<R: Ring>([x, y, z]: &Vector<R>, over: impl Fn(&R, &R) -> Option<R>) -> Option<[Vector<R>; 3]> {
    let w = z.add(&R::one());
    let beside = over(&x.mul(y), &w)?.neg();
    Some([
        [R::one().sub(&over(&x.mul(x), &w)?), beside.clone(), x.clone()],
        [beside, R::one().sub(&over(&y.mul(y), &w)?), y.clone()],
        [x.neg(), y.neg(), z.clone()],
    ])
}

/// The length of a vector, where it is rational.
fn rational_length(axis: &Vector<Rational>) -> Option<Rational> {
    let square = dot(axis, axis);
    let (numerator, denominator) = (square.numer(), square.denom());
    let is_square = numerator.is_perfect_square() && denominator.is_perfect_square();
    is_square.then(|| Rational::from((numerator.clone().sqrt(), denominator.clone().sqrt())))
}

/// A rational unit vector along a vector, by stereographic projection from the pole farther away; its coordinates there
/// are rounded in parts of themselves, so that a direction next to a pole is not taken for it.
fn rational_direction(axis: &Vector<Rational>) -> Vector<Rational> {
    let length = Float::with_val(BITS, dot(axis, axis)).sqrt();
    let unit = axis.each_ref().map(|x| Float::with_val(BITS, x) / &length);
    let flip = unit[2] < 0;
    let below = if flip { Float::with_val(BITS, 1 - &unit[2]) } else { Float::with_val(BITS, 1 + &unit[2]) };
    let rounded = |x: &Float| {
        let ratio = Float::with_val(BITS, x / &below);
        let places = COORDINATE - ratio.get_exp().unwrap_or(0).min(0);
        let integer = Float::with_val(BITS, &ratio << places).to_integer().unwrap_or_default();
        Rational::from(integer) >> places
    };
    let (u, v) = (rounded(&unit[0]), rounded(&unit[1]));
    let norm = Rational::from(&u * &u) + Rational::from(&v * &v);
    let scale = Rational::from(&norm + 1).recip();
    let z: Rational = (1 - norm) * &scale;
    [u * 2 * &scale, v * 2 * &scale, if flip { -z } else { z }]
}
