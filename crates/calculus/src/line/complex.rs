//! Linear complexes `(a; b)`: the lines with `a . m + b . d = 0`, perpendicular to the velocities `b + a x p` of a screw.

use super::pluecker::Line;
use crate::motion::{Vector, cross, dot};
use crate::unit::Unit;
use looproot_algebra::echelon::Echelon;
use looproot_algebra::ring::{Field, Ring};

/// A linear complex by its two vectors, up to a factor.
#[derive(Clone, Debug, PartialEq)]
pub struct Complex<R> {
    /// The direction of its axis; zero if all velocities are the same.
    pub a: Vector<R>,
    /// The velocity of the point at the origin.
    pub b: Vector<R>,
}

impl<R: Ring> Complex<R> {
    /// Returns the product with a line, which is zero for the lines of the complex.
    #[must_use]
    pub fn product(&self, line: &Line<R>) -> R {
        dot(&self.a, &line.moment).add(&dot(&self.b, &line.direction))
    }

    /// Returns the normal of the null plane of a point, the plane of all lines of the complex through it.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::line::complex::Complex;
    /// let complex = Complex { a: [0.0, 0.0, 1.0], b: [0.0, 0.0, 1.0] };
    /// assert_eq!(complex.null_plane(&[1.0, 0.0, 0.0]), [0.0, 1.0, 1.0]);
    /// ```
    ///
    /// # Source
    /// \[Wittenburg2016, 2.7.1\]
    #[must_use]
    pub fn null_plane(&self, point: &Vector<R>) -> Vector<R> {
        let turned = cross(&self.a, point);
        std::array::from_fn(|i| self.b[i].add(&turned[i]))
    }

    /// Returns the Klein form of two complexes; zero if they are in involution.
    #[must_use]
    pub fn with(&self, other: &Self) -> R {
        dot(&self.a, &other.b).add(&dot(&self.b, &other.a))
    }
}

impl<R: Unit> Complex<R> {
    /// Returns the pitch `a . b / a . a`; `None` if it is infinite.
    #[must_use]
    pub fn pitch(&self) -> Option<R> {
        dot(&self.a, &self.b).over(&dot(&self.a, &self.a))
    }

    /// Returns the point of the axis nearest the origin; `None` if there is no axis.
    #[must_use]
    pub fn axis_point(&self) -> Option<Vector<R>> {
        let inverse = dot(&self.a, &self.a).reciprocal()?;
        Some(cross(&self.a, &self.b).map(|c| c.mul(&inverse)))
    }

    /// Returns the null point of the plane `n . x = c`, the point with that null plane; `None` for a plane parallel to the axis.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::line::complex::Complex;
    /// let complex = Complex { a: [0.0, 0.0, 1.0], b: [0.0, 0.0, 1.0] };
    /// let point = complex.null_point(&[0.0, 1.0, 1.0], &0.0).unwrap();
    /// assert_eq!(point, [1.0, 0.0, 0.0]);
    /// ```
    ///
    /// # Source
    /// \[Wittenburg2016, 2.7.3\]: `p = (n x b + c a)/(n . a)`.
    #[must_use]
    pub fn null_point(&self, normal: &Vector<R>, distance: &R) -> Option<Vector<R>> {
        let inverse = dot(normal, &self.a).reciprocal()?;
        let side = cross(&self.b, normal);
        Some(std::array::from_fn(|i| distance.mul(&self.a[i]).sub(&side[i]).mul(&inverse)))
    }

    /// Returns the reciprocal polar of a line, in which the null planes of its points meet; `None` for a special complex.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::line::{complex::Complex, pluecker::Line};
    /// let complex = Complex { a: [0.0, 0.0, 1.0], b: [0.0, 0.0, 1.0] };
    /// let line = Line::at(&[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0]);
    /// let twice = complex.polar(&complex.polar(&line).unwrap()).unwrap();
    /// assert_eq!(twice.direction, line.direction);
    /// ```
    ///
    /// # Source
    /// \[Wittenburg2016, 2.7.5\]
    #[must_use]
    pub fn polar(&self, line: &Line<R>) -> Option<Line<R>> {
        let factor = self.product(line).over(&dot(&self.a, &self.b))?;
        let part = |own: &Vector<R>, of: &Vector<R>| std::array::from_fn(|i| own[i].sub(&of[i].mul(&factor)));
        Some(Line { direction: part(&line.direction, &self.a), moment: part(&line.moment, &self.b) })
    }
}

/// Returns a basis of the complexes that contain all of these lines: one complex for five independent lines.
///
/// # Source
/// \[Wittenburg2016, 2.7.4\]
#[must_use]
pub fn containing<F: Field>(lines: &[Line<F>]) -> Vec<Complex<F>> {
    let row = |line: &Line<F>| line.moment.iter().chain(&line.direction).cloned().collect();
    let space = Echelon::of(lines.iter().map(row).collect(), 6).null_space();
    let vector = |v: &[F]| std::array::from_fn(|k| v[k].clone());
    space.iter().map(|v| Complex { a: vector(&v[..3]), b: vector(&v[3..]) }).collect()
}
