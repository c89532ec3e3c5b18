//! Displacements in the plane in complex numbers: `z -> e z + t`, and reflections `z -> e conj(z) + t`.

use crate::rotation::turn::Turn;
use crate::unit::Unit;
use looproot_algebra::ring::Ring;
use num_complex::Complex;

/// A displacement of the plane, possibly preceded by a reflection in the real axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Displacement<R> {
    /// The complex number of norm 1 of the rotation.
    pub rotation: Complex<R>,
    /// The image of the origin.
    pub translation: Complex<R>,
    /// Whether points are conjugated first.
    pub is_reflected: bool,
}

fn conjugate<R: Ring>(z: &Complex<R>) -> Complex<R> {
    Complex { re: z.re.clone(), im: z.im.neg() }
}

impl<R: Ring> Displacement<R> {
    /// Returns the identity.
    #[must_use]
    pub fn identity() -> Self {
        Self::translation(Complex::zero())
    }

    /// Returns a translation.
    #[must_use]
    pub fn translation(translation: Complex<R>) -> Self {
        Self { rotation: Complex::one(), translation, is_reflected: false }
    }

    /// Returns the rotation about a point.
    #[must_use]
    pub fn about(point: &Complex<R>, turn: &Turn<R>) -> Self {
        let rotation = Complex { re: turn.cos.clone(), im: turn.sin.clone() };
        let translation = point.sub(&rotation.mul(point));
        Self { rotation, translation, is_reflected: false }
    }

    /// Returns the reflection in the line through a point in the direction of this angle, given by twice the angle.
    #[must_use]
    pub fn mirror(point: &Complex<R>, twice: &Turn<R>) -> Self {
        let rotation = Complex { re: twice.cos.clone(), im: twice.sin.clone() };
        let translation = point.sub(&rotation.mul(&conjugate(point)));
        Self { rotation, translation, is_reflected: true }
    }

    /// Returns the image of a point.
    #[must_use]
    pub fn apply(&self, z: &Complex<R>) -> Complex<R> {
        let z = if self.is_reflected { conjugate(z) } else { z.clone() };
        self.rotation.mul(&z).add(&self.translation)
    }

    /// Returns the displacement that applies `other` first, then `self`.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::plane::Displacement;
    /// use looproot_calculus::rotation::turn::Turn;
    /// use num_complex::Complex;
    /// use rug::Rational;
    /// let z = |x: i32, y: i32| Complex { re: Rational::from(x), im: Rational::from(y) };
    /// let half = Turn { cos: Rational::from(-1), sin: Rational::new() };
    /// // Half turns about the corners of a parallelogram, one after the other: a tile of type CCCC.
    /// let corners = [z(0, 0), z(3, 0), z(4, 2), z(1, 2)];
    /// let all = corners.iter().fold(Displacement::identity(), |all, c| Displacement::about(c, &half).then_after(&all));
    /// assert_eq!(all, Displacement::identity());
    /// ```
    ///
    /// # Source
    /// \[Wittenburg2016, 14.3 and 14.6\]
    #[must_use]
    pub fn then_after(&self, other: &Self) -> Self {
        let inner = if self.is_reflected { conjugate(&other.rotation) } else { other.rotation.clone() };
        Self {
            rotation: self.rotation.mul(&inner),
            translation: self.apply(&other.translation),
            is_reflected: self.is_reflected != other.is_reflected,
        }
    }

    /// Returns the inverse displacement.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = if self.is_reflected { self.rotation.clone() } else { conjugate(&self.rotation) };
        let own = Self { rotation, translation: Complex::zero(), is_reflected: self.is_reflected };
        let translation = own.apply(&self.translation).neg();
        Self { translation, ..own }
    }
}

impl<R: Unit> Displacement<R> {
    /// Returns the fixed point; `None` for translations and reflections.
    #[must_use]
    pub fn pole(&self) -> Option<Complex<R>> {
        if self.is_reflected {
            return None;
        }
        // t/(1 - e) = t conj(1 - e)/(2 - 2 cos)
        let rest = Complex::one().sub(&self.rotation);
        let square = rest.re.mul(&rest.re).add(&rest.im.mul(&rest.im));
        if square.is_small() {
            return None;
        }
        let inverse = square.reciprocal()?;
        let product = self.translation.mul(&conjugate(&rest));
        Some(Complex { re: product.re.mul(&inverse), im: product.im.mul(&inverse) })
    }
}

/// Returns the poles of the displacements between three positions: the pole triangle P12, P23, P31.
///
/// # Source
/// \[Wittenburg2016, 14.4\]
#[must_use]
pub fn pole_triangle<R: Unit>(positions: &[Displacement<R>; 3]) -> Option<[Complex<R>; 3]> {
    let pole = |k: usize| positions[(k + 1) % 3].then_after(&positions[k].inverse()).pole();
    Some([pole(0)?, pole(1)?, pole(2)?])
}
