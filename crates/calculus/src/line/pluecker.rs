//! Pluecker vectors of a line.

use crate::motion::{Vector, cross, dot};
use crate::unit::{Root, Unit};
use looproot_algebra::dual::Dual;
use looproot_algebra::ring::Ring;

/// A line: a direction of any length, and the moment `p x direction` of any of its points.
///
/// # Units
/// `moment` is in the unit of `direction` times a length.
#[derive(Clone, Debug, PartialEq)]
pub struct Line<R> {
    /// The direction.
    pub direction: Vector<R>,
    /// The moment, perpendicular to the direction.
    pub moment: Vector<R>,
}

impl<R: Ring> Line<R> {
    /// Returns the line through a point.
    #[must_use]
    pub fn at(point: &Vector<R>, direction: &Vector<R>) -> Self {
        Self { direction: direction.clone(), moment: cross(point, direction) }
    }

    /// Returns the line through two points.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::line::pluecker::Line;
    /// let line = Line::through(&[0.0, 0.0, 1.0], &[0.0, 2.0, 1.0]);
    /// assert_eq!((line.direction, line.moment), ([0.0, 2.0, 0.0], [-2.0, 0.0, 0.0]));
    /// ```
    #[must_use]
    pub fn through(first: &Vector<R>, second: &Vector<R>) -> Self {
        Self::at(first, &std::array::from_fn(|i| second[i].sub(&first[i])))
    }

    /// Returns the line of two planes `n . x = c`.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::line::pluecker::Line;
    /// // z = 1 and x = 2.
    /// let line = Line::of_planes((&[0.0, 0.0, 1.0], &1.0), (&[1.0, 0.0, 0.0], &2.0));
    /// assert_eq!(line.point().unwrap(), [2.0, 0.0, 1.0]);
    /// ```
    ///
    /// # Source
    /// \[Wittenburg2016, 2.4\]
    #[must_use]
    pub fn of_planes((n1, c1): (&Vector<R>, &R), (n2, c2): (&Vector<R>, &R)) -> Self {
        // p x (n1 x n2) = n1 (p . n2) - n2 (p . n1)
        let moment = std::array::from_fn(|i| n1[i].mul(c2).sub(&n2[i].mul(c1)));
        Self { direction: cross(n1, n2), moment }
    }

    /// Returns the six coordinates, direction first.
    #[must_use]
    pub fn coordinates(&self) -> [R; 6] {
        std::array::from_fn(|k| if k < 3 { self.direction[k].clone() } else { self.moment[k - 3].clone() })
    }

    /// Returns the line with six coordinates, direction first.
    #[must_use]
    pub fn from_coordinates(c: &[R; 6]) -> Self {
        Self { direction: std::array::from_fn(|k| c[k].clone()), moment: std::array::from_fn(|k| c[k + 3].clone()) }
    }

    /// Returns `d1 . m2 + m1 . d2`, which is zero if two lines meet or are parallel.
    #[must_use]
    pub fn product(&self, other: &Self) -> R {
        dot(&self.direction, &other.moment).add(&dot(&self.moment, &other.direction))
    }

    /// Returns the line as one vector of dual numbers.
    #[must_use]
    pub fn dual(&self) -> Vector<Dual<R>> {
        std::array::from_fn(|k| Dual { value: self.direction[k].clone(), epsilon: self.moment[k].clone() })
    }

    /// Returns the line of a dual vector. For a product of two lines it is their common perpendicular, with a moment that lacks the
    /// part along the direction.
    #[must_use]
    pub fn of_dual(v: &Vector<Dual<R>>) -> Self {
        Self {
            direction: std::array::from_fn(|k| v[k].value.clone()),
            moment: std::array::from_fn(|k| v[k].epsilon.clone()),
        }
    }
}

impl<R: Unit> Line<R> {
    /// Returns the point nearest the origin; `None` for a line without direction.
    #[must_use]
    pub fn point(&self) -> Option<Vector<R>> {
        let inverse = dot(&self.direction, &self.direction).reciprocal()?;
        Some(cross(&self.direction, &self.moment).map(|c| c.mul(&inverse)))
    }

    /// Returns the line with the component of the moment along the direction removed: the axis of a screw.
    #[must_use]
    pub fn straightened(&self) -> Option<Self> {
        let along = dot(&self.direction, &self.moment).over(&dot(&self.direction, &self.direction))?;
        let moment = std::array::from_fn(|i| self.moment[i].sub(&self.direction[i].mul(&along)));
        Some(Self { direction: self.direction.clone(), moment })
    }

    /// Returns the common perpendicular of two lines that are not parallel, directed along `d1 x d2`.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::line::pluecker::Line;
    /// use rug::Rational;
    /// let vector = |v: [i32; 3]| v.map(Rational::from);
    /// let (x, y) = (Line::at(&vector([0, 0, 0]), &vector([1, 0, 0])), Line::at(&vector([3, 0, 2]), &vector([0, 1, 0])));
    /// assert_eq!(x.perpendicular(&y).unwrap().point().unwrap(), vector([3, 0, 0]));
    /// ```
    ///
    /// # Source
    /// \[Wittenburg2016, 2.6\]: the dual vector product.
    #[must_use]
    pub fn perpendicular(&self, other: &Self) -> Option<Self> {
        Self::of_dual(&cross(&self.dual(), &other.dual())).straightened()
    }

    /// Returns the point at which a line meets this one, or the foot of the common perpendicular on this one.
    #[must_use]
    pub fn foot(&self, other: &Self) -> Option<Vector<R>> {
        let normal = cross(&self.direction, &other.direction);
        let inverse = dot(&normal, &normal).reciprocal()?;
        let (p, q) = (self.point()?, other.point()?);
        let between: Vector<R> = std::array::from_fn(|i| q[i].sub(&p[i]));
        let along = dot(&cross(&between, &other.direction), &normal).mul(&inverse);
        Some(std::array::from_fn(|i| p[i].add(&self.direction[i].mul(&along))))
    }

    /// Returns the image of this line under the half turn about another one.
    ///
    /// # Source
    /// \[Wittenburg2016, 2.3\], as a product of dual vectors: `2 (l . v) l - v` for the unit line l.
    #[must_use]
    pub fn reflected(&self, axis: &Self) -> Option<Self> {
        let (l, v) = (axis.dual(), self.dual());
        let twice = dot(&l, &l).reciprocal().map(|inverse| inverse.add(&inverse))?;
        let along = dot(&l, &v).mul(&twice);
        Some(Self::of_dual(&std::array::from_fn(|i| l[i].mul(&along).sub(&v[i]))))
    }
}

impl<R: Root> Line<R> {
    /// Returns the same line with a direction of length 1.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::line::pluecker::Line;
    /// let line = Line::at(&[0.0, 0.0, 1.0], &[0.0, 2.0, 0.0]).unit().unwrap();
    /// assert_eq!((line.direction[1], line.moment[0]), (1.0, -1.0));
    /// ```
    #[must_use]
    pub fn unit(&self) -> Option<Self> {
        let inverse = crate::unit::length(&self.direction)?.reciprocal()?;
        let scaled = |v: &Vector<R>| v.each_ref().map(|c| c.mul(&inverse));
        Some(Self { direction: scaled(&self.direction), moment: scaled(&self.moment) })
    }
}
