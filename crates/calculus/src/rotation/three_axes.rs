//! A rotation as three rotations about given axes: `R = Rot(n1, t1) Rot(n2, t2) Rot(n3, t3)`, axes fixed in space.
//!
//! The middle angle solves one equation, `A cos t2 + B sin t2 = C`, from `n1 . R n3`; each outer angle follows from one vector.
//! Over the dual numbers the axes are lines and the rotations screws.

use super::matrix::{Matrix, apply, matrix, product, transpose};
use super::turn::Turn;
use crate::motion::{Vector, cross, dot};
use crate::unit::{Root, Unit};
use looproot_algebra::ring::Ring;

/// The equation of the middle angle, for axes of any length: `cos cos t2 + sin |n2| sin t2 = right`.
///
/// `n1 . R n3 - (n1.n2)(n2.n3) = (n1.n3 - (n1.n2)(n2.n3)) cos t2 + n1.(n2 x n3) sin t2` for unit axes. Here both sides are
/// multiplied by the lengths of the outer axes and the squared length of the middle one, so that rational axes give rational
/// coefficients.
///
/// # Source
/// \[Wittenburg2016, 1.15.11\]
#[derive(Clone, Debug, PartialEq)]
pub struct Equation<R> {
    /// The coefficient of the cosine.
    pub cos: R,
    /// The coefficient of the sine, divided by the length of the middle axis.
    pub sin: R,
    /// The right side.
    pub right: R,
    /// The square of the length of the middle axis.
    pub square: R,
}

impl<R: Ring> Equation<R> {
    /// Returns the equation for three axes and a rotation.
    #[must_use]
    pub fn of(axes: &[Vector<R>; 3], rotation: &Matrix<R>) -> Self {
        let [n1, n2, n3] = axes;
        let square = dot(n2, n2);
        let along = dot(n1, n2).mul(&dot(n2, n3));
        Self {
            cos: square.mul(&dot(n1, n3)).sub(&along),
            sin: dot(n1, &cross(n2, n3)),
            right: square.mul(&dot(n1, &apply(rotation, n3))).sub(&along),
            square,
        }
    }

    /// Returns the square of the amplitude of the left side.
    #[must_use]
    pub fn amplitude_squared(&self) -> R {
        self.cos.mul(&self.cos).add(&self.square.mul(&self.sin).mul(&self.sin))
    }

    /// Returns the square of the amplitude minus that of the right side: there are two real solutions if it is positive, a double
    /// one if it is 0, none if it is negative.
    #[must_use]
    pub fn discriminant(&self) -> R {
        self.amplitude_squared().sub(&self.right.mul(&self.right))
    }
}

/// Returns the angles about three unit axes: two triples, or one if they coincide. `None` if the middle angle is not determined,
/// if an outer axis and its image leave the outer angles free, or if the ring lacks the root of the discriminant.
///
/// # Example
/// ```
/// use looproot_calculus::rotation::three_axes::angles;
/// let axes = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
/// let rotation = [[0.0, -0.6, 0.8], [1.0, 0.0, 0.0], [0.0, 0.8, 0.6]];
/// let found = angles(&axes, &rotation).unwrap();
/// assert_eq!(found.len(), 2);
/// assert!(found.iter().any(|[a, b, c]| {
///     let of = |turn: &looproot_calculus::rotation::turn::Turn<f64>| turn.angle().unwrap();
///     (of(a) - 1.570796).abs() < 1e-6 && (of(b) - 0.927295).abs() < 1e-6 && of(c).abs() < 1e-6
/// }));
/// ```
#[must_use]
pub fn angles<R: Root>(axes: &[Vector<R>; 3], rotation: &Matrix<R>) -> Option<Vec<[Turn<R>; 3]>> {
    let equation = Equation::of(axes, rotation);
    let discriminant = equation.discriminant();
    if discriminant.is_small() {
        return with_root(axes, rotation, &equation, &R::zero()).map(|found| vec![found]);
    }
    let root = discriminant.sqrt()?;
    let plus = with_root(axes, rotation, &equation, &root)?;
    Some(vec![plus, with_root(axes, rotation, &equation, &root.neg())?])
}

/// Returns the angles that belong to a root of the discriminant.
#[must_use]
pub fn with_root<R: Unit>(
    axes: &[Vector<R>; 3],
    rotation: &Matrix<R>,
    equation: &Equation<R>,
    root: &R,
) -> Option<[Turn<R>; 3]> {
    let [n1, n2, n3] = axes;
    let Equation { cos, sin, right, .. } = equation;
    let inverse = equation.amplitude_squared().reciprocal()?;
    let second = Turn {
        cos: cos.mul(right).sub(&sin.mul(root)).mul(&inverse),
        sin: sin.mul(right).add(&cos.mul(root)).mul(&inverse),
    };
    let about_second = turned(n2, &second)?;
    let first = Turn::between(n1, &beside(n1, &apply(&about_second, n3)), &beside(n1, &apply(rotation, n3)))?;
    let rest = product(&transpose(&product(&turned(n1, &first)?, &about_second)), rotation);
    // A vector perpendicular to the third axis, from the base vector farthest from it.
    let least = (0..3).min_by(|i, j| n3[*i].size().total_cmp(&n3[*j].size()))?;
    let unit: Vector<R> = std::array::from_fn(|i| if i == least { R::one() } else { R::zero() });
    let across = beside(n3, &unit);
    let third = Turn::between(n3, &across, &apply(&rest, &across))?;
    Some([first, second, third])
}

/// Returns the rotation about a unit axis.
#[must_use]
pub fn turned<R: Unit>(axis: &Vector<R>, turn: &Turn<R>) -> Option<Matrix<R>> {
    matrix(&turn.about(axis))
}

/// Returns the part of a vector perpendicular to a unit axis.
fn beside<R: Ring>(axis: &Vector<R>, v: &Vector<R>) -> Vector<R> {
    let along = dot(axis, v);
    std::array::from_fn(|i| v[i].sub(&axis[i].mul(&along)))
}
