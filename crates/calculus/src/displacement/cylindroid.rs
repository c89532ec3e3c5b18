//! The cylindroid: the ruled surface of all screws that two screws span.

use crate::line::pluecker::Line;
use crate::motion::{Vector, cross, dot};
use crate::unit::{Root, Unit};
use looproot_algebra::ring::Ring;

/// A screw as an axis with a pitch.
#[derive(Clone, Debug, PartialEq)]
pub struct Pitched<R> {
    /// The axis, its direction of any length.
    pub axis: Line<R>,
    /// The pitch, a length for an angle.
    pub pitch: R,
}

impl<R: Ring> Pitched<R> {
    /// Returns direction and moment of the screw: the line of the axis, plus the pitch times the direction as moment.
    #[must_use]
    pub fn twist(&self) -> Line<R> {
        let Line { direction, moment } = &self.axis;
        let moment = std::array::from_fn(|i| moment[i].add(&direction[i].mul(&self.pitch)));
        Line { direction: direction.clone(), moment }
    }
}

impl<R: Unit> Pitched<R> {
    /// Returns the screw of a twist; `None` for a translation.
    #[must_use]
    pub fn of_twist(twist: &Line<R>) -> Option<Self> {
        let pitch = dot(&twist.direction, &twist.moment).over(&dot(&twist.direction, &twist.direction))?;
        Some(Self { axis: twist.straightened()?, pitch })
    }
}

/// The principal screws of a cylindroid, perpendicular and concurrent, and the line between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Cylindroid<R> {
    /// The larger and the smaller principal pitch.
    pub pitches: [R; 2],
    /// Their unit directions.
    pub directions: [Vector<R>; 2],
    /// The line that cuts all axes of the surface at right angles, with a unit direction.
    pub axis: Vector<R>,
    /// The point in which the principal axes meet.
    pub centre: Vector<R>,
    /// The length of the surface, the difference of the pitches.
    pub length: R,
}

/// Returns the cylindroid of two screws; `None` if their axes are parallel and no such surface exists, if all pitches are equal
/// and every direction is principal, or if the ring lacks a root.
///
/// With unit vectors x, y across the common perpendicular, `H = (moments)(directions)^-1` is a 2 x 2 matrix: the pitches are
/// the eigenvalues of its symmetric part, and the height of the centre is half the difference of the other entries.
///
/// # Example
/// ```
/// use looproot_calculus::displacement::cylindroid::{Pitched, cylindroid};
/// use looproot_calculus::line::pluecker::Line;
/// let screw = |point, direction| Pitched { axis: Line::at(&point, &direction), pitch: 0.0 };
/// let found = cylindroid(&screw([0.0; 3], [1.0, 0.0, 0.0]), &screw([0.0, 0.0, 1.0], [0.0, 1.0, 0.0])).unwrap();
/// assert!((found.pitches[0] - 0.5).abs() < 1e-15 && (found.centre[2] - 0.5).abs() < 1e-15);
/// assert!((found.length - 1.0).abs() < 1e-15 && found.directions[0][0] * found.directions[0][1] < 0.0);
/// ```
///
/// # Source
/// \[Ball1900\]; \[Wittenburg2016, 3.13 and 12.1\]
#[must_use]
pub fn cylindroid<R: Root>(one: &Pitched<R>, two: &Pitched<R>) -> Option<Cylindroid<R>> {
    let axis = one.axis.perpendicular(&two.axis)?.unit()?;
    let x = crate::unit::direction(&one.axis.direction)?;
    let y = cross(&axis.direction, &x);
    let foot = one.axis.foot(&two.axis)?;
    // Twists about the foot on the first axis, in the frame x, y, axis.
    let about = |screw: &Pitched<R>| {
        let twist = screw.twist();
        let shifted = cross(&foot, &twist.direction);
        let moment: Vector<R> = std::array::from_fn(|i| twist.moment[i].sub(&shifted[i]));
        let flat = |v: &Vector<R>| [dot(&x, v), dot(&y, v)];
        (flat(&twist.direction), flat(&moment))
    };
    let (([a, c], [p, r]), ([b, d], [q, s])) = (about(one), about(two));
    let inverse = a.mul(&d).sub(&b.mul(&c)).reciprocal()?;
    // (p q; r s)(a b; c d)^-1
    let entry = |u: &R, v: &R, e: &R, f: &R| u.mul(e).sub(&v.mul(f)).mul(&inverse);
    let (h11, h12) = (entry(&p, &q, &d, &c), entry(&q, &p, &a, &b));
    let (h21, h22) = (entry(&r, &s, &d, &c), entry(&s, &r, &a, &b));
    let half = R::from_integer(2).reciprocal()?;
    let (mean, difference) = (h11.add(&h22).mul(&half), h11.sub(&h22).mul(&half));
    let off = h12.add(&h21).mul(&half);
    let height = h21.sub(&h12).mul(&half);
    let square = difference.mul(&difference).add(&off.mul(&off));
    let radius = square.sqrt()?;
    if radius.is_small() {
        return None;
    }
    // The eigenvector of the larger pitch: (difference + radius, off), or (off, radius - difference) if that is longer.
    let [u, v] = if difference.is_negative() {
        [off.clone(), radius.sub(&difference)]
    } else {
        [difference.add(&radius), off.clone()]
    };
    let scale = u.mul(&u).add(&v.mul(&v)).sqrt()?.reciprocal()?;
    let (u, v) = (u.mul(&scale), v.mul(&scale));
    let combine = |u: &R, v: &R| std::array::from_fn(|i| x[i].mul(u).add(&y[i].mul(v)));
    let centre = std::array::from_fn(|i| foot[i].add(&axis.direction[i].mul(&height)));
    Some(Cylindroid {
        pitches: [mean.add(&radius), mean.sub(&radius)],
        directions: [combine(&u, &v), combine(&v.neg(), &u)],
        axis: axis.direction,
        centre,
        length: radius.add(&radius),
    })
}
