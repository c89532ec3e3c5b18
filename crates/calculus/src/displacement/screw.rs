//! Finite screws: every displacement is a rotation about a line with a translation along it (Chasles).

use crate::line::pluecker::Line;
use crate::motion::{Motion, Vector, cross, dot};
use crate::quaternion::{DualQuaternion, Quaternion};
use crate::rotation::matrix::from_matrix;
use crate::rotation::turn::Turn;
use crate::rotation::vectors::unit;
use crate::unit::{Analytic, Root, Unit, length};
use looproot_algebra::dual::Dual;
use looproot_algebra::ring::Ring;

/// A finite screw: a rotation about an axis, and a translation along it.
#[derive(Clone, Debug, PartialEq)]
pub struct Screw<R> {
    /// Unit direction of the axis; for a translation its own direction, and `None` for the identity.
    pub direction: Option<Vector<R>>,
    /// The point of the axis nearest the origin; `None` for a translation.
    pub point: Option<Vector<R>>,
    /// Half the angle, in [0, pi/2], by cosine and sine.
    pub half: Turn<R>,
    /// The translation along the axis.
    pub translation: R,
}

impl<R: Root> Screw<R> {
    /// Returns the screw of a motion; at an angle of pi the first nonzero entry of the direction is positive. `None` if
    /// the ring lacks a root.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::displacement::screw::Screw;
    /// use looproot_calculus::motion::Motion;
    /// let motion = Motion { translation: [1.0, 1.0, 2.0], ..Motion::rotation_z(0.0, 1.0) };
    /// let screw = Screw::of(&motion).unwrap();
    /// assert!((screw.translation - 2.0).abs() < 1e-15);
    /// let point = screw.point.unwrap();
    /// assert!(point[0].abs() < 1e-15 && (point[1] - 1.0).abs() < 1e-15);
    /// ```
    ///
    /// # Source
    /// Chasles' theorem, \[Wittenburg2016, 3.2\].
    #[must_use]
    pub fn of(motion: &Motion<R>) -> Option<Self> {
        let t = &motion.translation;
        let q = unit(&from_matrix(&motion.rotation))?;
        let sine = length(&q.vector)?;
        if sine.is_small() {
            let translation = length(t)?;
            let direction = if translation.is_small() { None } else { crate::unit::direction(t) };
            return Some(Self { direction, point: None, half: Turn::zero(), translation });
        }
        let inverse = sine.reciprocal()?;
        let direction = q.vector.each_ref().map(|c| c.mul(&inverse));
        let translation = dot(t, &direction);
        let cotangent = q.scalar.mul(&inverse);
        let (side, half) = (cross(&direction, t), R::from_integer(2).reciprocal()?);
        let point =
            std::array::from_fn(|i| t[i].sub(&direction[i].mul(&translation)).add(&side[i].mul(&cotangent)).mul(&half));
        let turn = Turn { cos: q.scalar, sin: sine };
        Some(Self { direction: Some(direction), point: Some(point), half: turn, translation })
    }

    /// Returns the axis; `None` for a translation.
    #[must_use]
    pub fn axis(&self) -> Option<Line<R>> {
        Some(Line::at(self.point.as_ref()?, self.direction.as_ref()?))
    }
}

impl<R: Analytic> Screw<R> {
    /// Returns the angle in [0, pi].
    #[must_use]
    pub fn angle(&self) -> Option<R> {
        self.half.angle().map(|half| half.add(&half))
    }

    /// Returns the translation over the angle; `None` for a translation.
    #[must_use]
    pub fn pitch(&self) -> Option<R> {
        self.point.as_ref()?;
        self.translation.over(&self.angle()?)
    }
}

/// Returns the motion with a unit axis, half an angle (as cosine and sine, up to a common factor) and a translation along the axis.
///
/// # Example
/// ```
/// use looproot_calculus::displacement::screw::motion;
/// use looproot_calculus::line::pluecker::Line;
/// use rug::Rational;
/// let vector = |v: [i32; 3]| v.map(Rational::from);
/// let axis = Line::at(&vector([0, 0, 1]), &vector([0, 1, 0]));
/// // Half a turn about y through z = 1.
/// let found = motion(&axis, &Rational::from(0), &Rational::from(1), &Rational::from(0)).unwrap();
/// assert_eq!(found.translation, vector([0, 0, 2]));
/// ```
#[must_use]
pub fn motion<R: Unit>(axis: &Line<R>, cos_half: &R, sin_half: &R, translation: &R) -> Option<Motion<R>> {
    let turn = Turn::from_half(cos_half, sin_half)?;
    let rotation = crate::rotation::three_axes::turned(&axis.direction, &turn)?;
    let point = axis.point()?;
    let turned = crate::rotation::matrix::apply(&rotation, &point);
    let translation = std::array::from_fn(|i| point[i].sub(&turned[i]).add(&axis.direction[i].mul(translation)));
    Some(Motion { rotation, translation })
}

/// Returns the dual quaternion of a screw: `cos(F/2) + l sin(F/2)` with the unit line l and the dual angle F, half of which is
/// given by dual cosine and sine. The formula is that of rotations.
///
/// # Source
/// \[Wittenburg2016, 3.10.5\]
#[must_use]
pub fn dual_quaternion<R: Ring>(axis: &Line<R>, half: &Turn<Dual<R>>) -> DualQuaternion<R> {
    crate::rotation::line::about(&axis.dual(), half)
}

/// Returns the half turn about a line: the unit dual vector itself.
#[must_use]
pub fn half_turn<R: Ring>(axis: &Line<R>) -> DualQuaternion<R> {
    Quaternion { scalar: Dual::zero(), vector: axis.dual() }
}

/// Returns the displacement by half turns about two lines, with `first` applied first: a screw about their common
/// perpendicular, by twice their angle and twice their distance (Halphen).
///
/// # Example
/// ```
/// use looproot_calculus::displacement::screw::{Screw, halphen};
/// use looproot_calculus::line::pluecker::Line;
/// let (x, y) = (Line::at(&[0.0; 3], &[1.0, 0.0, 0.0]), Line::at(&[0.0, 0.0, 1.0], &[0.0, 1.0, 0.0]));
/// let screw = Screw::of(&halphen(&x, &y).to_motion().unwrap()).unwrap();
/// assert_eq!((screw.translation, screw.half.sin), (2.0, 1.0));
/// ```
///
/// # Source
/// \[Wittenburg2016, 3.6\]
#[must_use]
pub fn halphen<R: Ring>(first: &Line<R>, second: &Line<R>) -> DualQuaternion<R> {
    half_turn(second).mul(&half_turn(first))
}

/// Returns the screw triangle of two screws: the three lines whose half turns, two by two, are the screws and their product.
/// The axes are given, and their common perpendicular is computed; the other two lines cut an axis at right angles.
///
/// The first screw is the product of the half turns about the first line and the perpendicular, the second one that of the
/// perpendicular and the last line. `None` for parallel axes.
///
/// # Source
/// \[Wittenburg2016, 3.7\]
#[must_use]
pub fn triangle<R: Root>(
    (one, first): (&Line<R>, &Turn<Dual<R>>),
    (two, second): (&Line<R>, &Turn<Dual<R>>),
) -> Option<[Line<R>; 3]> {
    let middle = one.perpendicular(two)?.unit()?;
    let q = half_turn(&middle);
    // From a screw s = n l with the half turn n about the middle line: l = n^-1 s up to sign.
    let before = q.mul(&dual_quaternion(one, first));
    let after = dual_quaternion(two, second).mul(&q);
    Some([Line::of_dual(&before.vector), middle, Line::of_dual(&after.vector)])
}

/// Returns the line through the midpoint of a point and its image that is perpendicular to their chord and to the axis of the
/// screw; it cuts the axis at a right angle (Roth). `None` if the chord is parallel to the axis.
///
/// # Example
/// ```
/// use looproot_calculus::displacement::screw::{midpoint_perpendicular, motion};
/// use looproot_calculus::line::pluecker::Line;
/// use rug::Rational;
/// let vector = |v: [i32; 3]| v.map(Rational::from);
/// let axis = Line::at(&vector([1, 0, 0]), &vector([0, 0, 1]));
/// let screw = motion(&axis, &Rational::from(2), &Rational::from(1), &Rational::from(5)).unwrap();
/// let line = midpoint_perpendicular(&screw, &axis, &vector([3, 1, 7])).unwrap();
/// assert_eq!(line.product(&axis), 0);
/// ```
///
/// # Source
/// \[Wittenburg2016, 3.4\]
#[must_use]
pub fn midpoint_perpendicular<R: Unit>(motion: &Motion<R>, axis: &Line<R>, point: &Vector<R>) -> Option<Line<R>> {
    let image = motion.apply(point);
    let half = R::from_integer(2).reciprocal()?;
    let middle: Vector<R> = std::array::from_fn(|i| point[i].add(&image[i]).mul(&half));
    let chord: Vector<R> = std::array::from_fn(|i| image[i].sub(&point[i]));
    let direction = cross(&chord, &axis.direction);
    if dot(&direction, &direction).is_small() {
        return None;
    }
    Some(Line::at(&middle, &direction))
}
