//! Ruled surfaces: striction point and distribution parameter of a generator, from its dual derivative.

use super::pluecker::Line;
use crate::motion::{Vector, cross, dot};
use crate::unit::Unit;

/// The local shape of a ruled surface, from a generator and its rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Generator<R> {
    /// The striction point, the foot of the common perpendicular with the next generator.
    pub striction: Vector<R>,
    /// The distribution parameter: the distance to the next generator over the angle between them. It is 0 on developable
    /// surfaces.
    pub distribution: R,
}

/// Returns striction point and distribution parameter of a generator with the rate `d', m'` of its Pluecker vectors; `None` if
/// the direction is constant, as on cylinders.
///
/// # Example
/// ```
/// use looproot_calculus::line::{pluecker::Line, ruled::generator};
/// // The hyperbolic paraboloid z = x y: generators through (u, 0, 0) along (0, 1, u).
/// let line = Line::at(&[0.0, 0.0, 0.0], &[0.0, 1.0, 0.0]);
/// let rate = Line { direction: [0.0, 0.0, 1.0], moment: [0.0, 0.0, 1.0] };
/// let found = generator(&line, &rate).unwrap();
/// assert_eq!(found.striction, [0.0, 0.0, 0.0]);
/// assert_eq!(found.distribution, 1.0);
/// ```
///
/// # Source
/// \[Wittenburg2016, 2.9.2\]
#[must_use]
pub fn generator<R: Unit>(line: &Line<R>, rate: &Line<R>) -> Option<Generator<R>> {
    let (d, m, dd, dm) = (&line.direction, &line.moment, &rate.direction, &rate.moment);
    let square = dot(d, d).reciprocal()?;
    // The rate of the unit direction is perpendicular to it.
    let along = dot(d, dd).mul(&square);
    let across: Vector<R> = std::array::from_fn(|i| dd[i].sub(&d[i].mul(&along)));
    let turned: Vector<R> = std::array::from_fn(|i| dm[i].sub(&m[i].mul(&along)));
    let turning = dot(&across, &across);
    if turning.is_small() {
        return None;
    }
    let inverse = turning.reciprocal()?;
    let point = line.point()?;
    // With m = p x d the rate of the moment is p' x d + p x d'.
    let rest: Vector<R> = {
        let own = cross(&point, &across);
        std::array::from_fn(|i| turned[i].sub(&own[i]))
    };
    // rest = p' x d: p' across d is d x rest / d.d.
    let slip = cross(d, &rest).map(|c| c.mul(&square));
    let shift = dot(&slip, &across).mul(&inverse).neg();
    let striction = std::array::from_fn(|i| point[i].add(&d[i].mul(&shift)));
    // det(p', d, d')/(d'.d')
    let distribution = dot(&slip, &cross(d, &across)).mul(&inverse);
    Some(Generator { striction, distribution })
}

/// Returns the generator of the fixed and of the moving axode of a motion: the axis of its velocity screw, with its rate. The
/// arguments are the velocity screw, as `omega` and the velocity at the origin, and the rates of these two at places fixed in space.
/// `None` for a translation, and if the axis keeps its direction.
///
/// Both axodes have the same striction point and distribution parameter: they touch along the axis, and one rolls and slides on
/// the other.
///
/// # Example
/// ```
/// use looproot_calculus::line::{pluecker::Line, ruled::axode};
/// // A body that turns about an axis, which itself turns about the origin: cones, whose apex is the striction point.
/// let screw = Line { direction: [1.0, 0.0, 1.0], moment: [0.0; 3] };
/// let rate = Line { direction: [0.0, 1.0, 0.0], moment: [0.0; 3] };
/// let found = axode(&screw, &rate).unwrap();
/// assert_eq!((found.striction, found.distribution), ([0.0; 3], 0.0));
/// ```
///
/// # Source
/// \[Wittenburg2016, 9.5\]
#[must_use]
pub fn axode<R: Unit>(screw: &Line<R>, rate: &Line<R>) -> Option<Generator<R>> {
    let (d, m, dd, dm) = (&screw.direction, &screw.moment, &rate.direction, &rate.moment);
    let square = dot(d, d).reciprocal()?;
    let pitch = dot(d, m).mul(&square);
    // The rate of (d . m)/(d . d).
    let twice = pitch.add(&pitch);
    let slope = dot(dd, m).add(&dot(d, dm)).sub(&twice.mul(&dot(d, dd))).mul(&square);
    let part = |m: &Vector<R>, d: &Vector<R>| -> Vector<R> { std::array::from_fn(|i| m[i].sub(&d[i].mul(&pitch))) };
    let axis = Line { direction: d.clone(), moment: part(m, d) };
    let turned = part(dm, dd);
    let moment = std::array::from_fn(|i| turned[i].sub(&d[i].mul(&slope)));
    generator(&axis, &Line { direction: dd.clone(), moment })
}
