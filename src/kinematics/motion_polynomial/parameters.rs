//! Links between the axes of a loop: lengths, twists and offsets, and the loops that they characterise.

use super::linkage::Linkage;
use crate::algebra::ring::Field;
use crate::kinematics::motion::{Vector, cross, dot};
use crate::kinematics::screw_system::Screw;
use rug::Rational;

/// A joint and the link behind it, `Rz(theta) Tz(d) Tx(a) Rx(alpha)`.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkParameters {
    /// Length of the common normal to the next axis, not negative.
    pub a: f64,
    /// Angle to the next axis about the common normal, radians.
    pub alpha: f64,
    /// Offset between the two common normals along the axis.
    pub d: f64,
    /// Angle between the two common normals in the home position, radians.
    pub theta: f64,
}

/// The common normal of two lines.
struct Normal {
    foot_first: Vector<f64>,
    foot_second: Vector<f64>,
    direction: Vector<f64>,
}

fn scaled(v: &Vector<f64>, factor: f64) -> Vector<f64> {
    v.map(|x| factor * x)
}

fn plus(v: &Vector<f64>, w: &Vector<f64>) -> Vector<f64> {
    std::array::from_fn(|k| v[k] + w[k])
}

fn minus(v: &Vector<f64>, w: &Vector<f64>) -> Vector<f64> {
    std::array::from_fn(|k| v[k] - w[k])
}

fn length(v: &Vector<f64>) -> f64 {
    dot(v, v).sqrt()
}

/// For parallel lines, returns the normal through the point nearest to the origin of the first.
fn normal(first: &Screw<f64>, second: &Screw<f64>) -> Option<Normal> {
    let (p, q) = (first.foot()?, second.foot()?);
    let (u, v) = (
        scaled(&first.direction, 1.0 / length(&first.direction)),
        scaled(&second.direction, 1.0 / length(&second.direction)),
    );
    let across = cross(&u, &v);
    let sine = length(&across);
    let between = minus(&q, &p);
    if sine <= 1e-10 {
        let foot = plus(&q, &scaled(&v, -dot(&between, &v)));
        let gap = minus(&foot, &p);
        let direction = if length(&gap) > 0.0 { scaled(&gap, 1.0 / length(&gap)) } else { perpendicular(&u) };
        return Some(Normal { foot_first: p, foot_second: foot, direction });
    }
    let cosine = dot(&u, &v);
    let square = sine * sine;
    let s = (dot(&between, &u) - dot(&between, &v) * cosine) / square;
    let r = (dot(&between, &u) * cosine - dot(&between, &v)) / square;
    let (foot_first, foot_second) = (plus(&p, &scaled(&u, s)), plus(&q, &scaled(&v, r)));
    let gap = minus(&foot_second, &foot_first);
    let mut direction = scaled(&across, 1.0 / sine);
    // From the first axis to the second, so that no length is negative.
    if dot(&gap, &direction) < 0.0 {
        direction = scaled(&direction, -1.0);
    }
    Some(Normal { foot_first, foot_second, direction })
}

fn perpendicular(u: &Vector<f64>) -> Vector<f64> {
    let unit = if u[0].abs() < 0.7 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let across = cross(u, &unit);
    scaled(&across, 1.0 / length(&across))
}

/// The angle from v to w about the unit vector u.
fn angle_about(u: &Vector<f64>, v: &Vector<f64>, w: &Vector<f64>) -> f64 {
    dot(&cross(v, w), u).atan2(dot(v, w))
}

impl<F: Field> Linkage<F> {
    /// The Denavit-Hartenberg parameters of the links, `theta` at t = infinity; `None` for loops with prismatic joints.
    #[must_use]
    pub fn parameters(&self, float: impl Fn(&F) -> f64) -> Option<Vec<LinkParameters>> {
        let axes: Vec<Screw<f64>> = self
            .joints
            .iter()
            .map(|joint| Screw {
                direction: joint.axis.direction.each_ref().map(&float),
                moment: joint.axis.moment.each_ref().map(&float),
            })
            .collect();
        let count = axes.len();
        let normals: Vec<Normal> =
            (0..count).map(|k| normal(&axes[k], &axes[(k + 1) % count])).collect::<Option<_>>()?;
        let unit = |k: usize| scaled(&axes[k].direction, 1.0 / length(&axes[k].direction));
        let link = |k: usize| {
            let (before, here) = (&normals[(k + count - 1) % count], &normals[k]);
            let z = unit(k);
            LinkParameters {
                a: length(&minus(&here.foot_second, &here.foot_first)),
                alpha: angle_about(&here.direction, &z, &unit((k + 1) % count)),
                d: dot(&minus(&here.foot_first, &before.foot_second), &z),
                theta: angle_about(&z, &before.direction, &here.direction),
            }
        };
        Some((0..count).map(link).collect())
    }
}

/// Twist and length of a link without roots: `(cos^2 alpha, a^2)`, and where its common normal meets the two axes; `None` for
/// parallel axes.
fn link_squares(first: &Screw<Rational>, second: &Screw<Rational>) -> Option<([Rational; 2], [Vector<Rational>; 2])> {
    let (p, q) = (first.foot()?, second.foot()?);
    let (u, v) = (&first.direction, &second.direction);
    let (uu, vv, uv) = (dot(u, u), dot(v, v), dot(u, v));
    let gram = Rational::from(&uu * &vv) - Rational::from(&uv * &uv);
    if gram == 0 {
        return None;
    }
    let between: Vector<Rational> = std::array::from_fn(|k| Rational::from(&q[k] - &p[k]));
    let (bu, bv) = (dot(&between, u), dot(&between, v));
    let s = (Rational::from(&bu * &vv) - Rational::from(&bv * &uv)) / &gram;
    let r = (Rational::from(&bu * &uv) - Rational::from(&bv * &uu)) / &gram;
    let point = |p: &Vector<Rational>, s: &Rational, u: &Vector<Rational>| -> Vector<Rational> {
        std::array::from_fn(|k| &p[k] + Rational::from(s * &u[k]))
    };
    let feet = [point(&p, &s, u), point(&q, &r, v)];
    let gap: Vector<Rational> = std::array::from_fn(|k| Rational::from(&feet[1][k] - &feet[0][k]));
    let cosine = Rational::from(&uv * &uv) / Rational::from(&uu * &vv);
    Some(([cosine, dot(&gap, &gap)], feet))
}

/// Bennett's ratio `(a / sin alpha)^2` if the loop is Bennett's, verified in exact arithmetic: four skew axes, opposite links
/// alike, all offsets zero, and the same ratio for all links. `None` for any other loop.
#[must_use]
pub fn bennett_ratio(linkage: &Linkage<Rational>) -> Option<Rational> {
    if linkage.joints.len() != 4 || linkage.joints.iter().any(|joint| joint.prismatic) {
        return None;
    }
    let axis = |k: usize| &linkage.joints[k % 4].axis;
    let links: Vec<_> = (0..4).map(|k| link_squares(axis(k), axis(k + 1))).collect::<Option<_>>()?;
    let opposite_alike = links[0].0 == links[2].0 && links[1].0 == links[3].0;
    let no_offsets = (0..4).all(|k| links[k].1[1] == links[(k + 1) % 4].1[0]);
    let ratio = |k: usize| &links[k].0[1] / Rational::from(1 - &links[k].0[0]);
    let skew = links.iter().all(|(squares, _)| squares[1] != 0);
    (opposite_alike && no_offsets && skew && ratio(0) == ratio(1)).then(|| ratio(0))
}
