//! Angles as points of the unit circle: they exist over every ring.

use crate::motion::Vector;
use crate::quaternion::Quaternion;
use crate::unit::{Analytic, Unit};
use looproot_algebra::ring::Ring;

/// An angle by its cosine and sine.
#[derive(Clone, Debug, PartialEq)]
pub struct Turn<R> {
    /// The cosine.
    pub cos: R,
    /// The sine.
    pub sin: R,
}

impl<R: Ring> Turn<R> {
    /// Returns the angle 0.
    #[must_use]
    pub fn zero() -> Self {
        Self { cos: R::one(), sin: R::zero() }
    }

    /// Returns the sum of two angles.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            cos: self.cos.mul(&other.cos).sub(&self.sin.mul(&other.sin)),
            sin: self.sin.mul(&other.cos).add(&self.cos.mul(&other.sin)),
        }
    }

    /// Returns the negative angle.
    #[must_use]
    pub fn negated(&self) -> Self {
        Self { cos: self.cos.clone(), sin: self.sin.neg() }
    }
}

impl<R: Unit> Turn<R> {
    /// Returns the angle whose half has the tangent `sin_half : cos_half`; `None` if both are too small.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::rotation::turn::Turn;
    /// use rug::Rational;
    /// let turn = Turn::from_half(&Rational::from(2), &Rational::from(1)).unwrap();
    /// assert_eq!((turn.cos, turn.sin), (Rational::from((3, 5)), Rational::from((4, 5))));
    /// ```
    #[must_use]
    pub fn from_half(cos_half: &R, sin_half: &R) -> Option<Self> {
        let (c, s) = (cos_half.mul(cos_half), sin_half.mul(sin_half));
        let inverse = c.add(&s).reciprocal()?;
        let product = cos_half.mul(sin_half);
        Some(Self { cos: c.sub(&s).mul(&inverse), sin: product.add(&product).mul(&inverse) })
    }

    /// Returns the angle between two vectors perpendicular to a unit axis, from the first to the second, both of one length;
    /// `None` if they are zero.
    #[must_use]
    pub fn between(axis: &Vector<R>, first: &Vector<R>, second: &Vector<R>) -> Option<Self> {
        use crate::motion::{cross, dot};
        let inverse = dot(first, first).reciprocal()?;
        Some(Self { cos: dot(first, second).mul(&inverse), sin: dot(axis, &cross(first, second)).mul(&inverse) })
    }

    /// Returns a quaternion of the rotation about a unit axis by this angle, up to a factor: `1 + cos + sin n`, and n for
    /// the angle pi.
    #[must_use]
    pub fn about(&self, axis: &Vector<R>) -> Quaternion<R> {
        let one_plus = R::one().add(&self.cos);
        if one_plus.is_small() {
            return Quaternion { scalar: R::zero(), vector: axis.clone() };
        }
        Quaternion { scalar: one_plus, vector: axis.each_ref().map(|c| c.mul(&self.sin)) }
    }
}

impl<R: Analytic> Turn<R> {
    /// Returns the angle in radians, in (-pi, pi].
    #[must_use]
    pub fn angle(&self) -> Option<R> {
        R::atan2(&self.sin, &self.cos)
    }

    /// Returns cosine and sine of an angle in radians.
    #[must_use]
    pub fn of_angle(angle: &R) -> Self {
        let (cos, sin) = angle.cos_sin_of();
        Self { cos, sin }
    }
}
