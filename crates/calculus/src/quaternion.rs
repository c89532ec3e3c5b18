//! Quaternions, and over the dual numbers the dual quaternions whose coordinates are Study's parameters of a motion.
//!
//! By the principle of transference there is one product for both.

use crate::motion::{Motion, Vector, cross, dot};
use looproot_algebra::{
    dual::Dual,
    ring::{Field, Ring},
};

/// A quaternion `w + x i + y j + z k` over any ring.
#[derive(Clone, Debug, PartialEq)]
pub struct Quaternion<R> {
    /// The real part.
    pub scalar: R,
    /// The coefficients of i, j, k.
    pub vector: Vector<R>,
}

/// A motion up to a common factor, as a quaternion of dual numbers.
///
/// The values are Study's `x0..x3`, the parts with `eps` his `y0..y3`; a point of the projective space belongs to a
/// motion when it lies on the Study quadric `x0 y0 + ... + x3 y3 = 0` and `x` is not null.
pub type DualQuaternion<R> = Quaternion<Dual<R>>;

impl<R: Ring> Quaternion<R> {
    /// Returns the quaternion 1.
    #[must_use]
    pub fn identity() -> Self {
        Self { scalar: R::one(), vector: std::array::from_fn(|_| R::zero()) }
    }

    /// Returns `self other`, which as a motion applies `other` first.
    #[must_use]
    pub fn mul(&self, other: &Self) -> Self {
        let (v, w) = (&self.vector, &other.vector);
        let cross = cross(v, w);
        Self {
            scalar: self.scalar.mul(&other.scalar).sub(&dot(v, w)),
            vector: std::array::from_fn(|i| self.scalar.mul(&w[i]).add(&other.scalar.mul(&v[i])).add(&cross[i])),
        }
    }

    /// Returns the conjugate, which represents the inverse rotation or motion.
    #[must_use]
    pub fn conjugate(&self) -> Self {
        Self { scalar: self.scalar.clone(), vector: std::array::from_fn(|i| self.vector[i].neg()) }
    }

    /// Returns `q q*`, a number of the ring.
    #[must_use]
    pub fn norm(&self) -> R {
        self.scalar.mul(&self.scalar).add(&dot(&self.vector, &self.vector))
    }

    /// Returns the rotation matrix times the norm.
    #[must_use]
    pub fn scaled_rotation(&self) -> [[R; 3]; 3] {
        let column = |j: usize| {
            let unit = std::array::from_fn(|i| if i == j { R::one() } else { R::zero() });
            self.mul(&Self { scalar: R::zero(), vector: unit }).mul(&self.conjugate()).vector
        };
        let columns: [Vector<R>; 3] = std::array::from_fn(column);
        std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i].clone()))
    }
}

impl<R: Ring> DualQuaternion<R> {
    /// Returns the dual quaternion with Study's parameters `x` and `y`, scalar parts first.
    #[must_use]
    pub fn from_study(x: &[R; 4], y: &[R; 4]) -> Self {
        let dual = |i: usize| Dual { value: x[i].clone(), epsilon: y[i].clone() };
        Self { scalar: dual(0), vector: [dual(1), dual(2), dual(3)] }
    }

    /// Study's parameters `x` and `y`, scalar parts first.
    #[must_use]
    pub fn study(&self) -> ([R; 4], [R; 4]) {
        let part = |i: usize| if i == 0 { &self.scalar } else { &self.vector[i - 1] };
        (std::array::from_fn(|i| part(i).value.clone()), std::array::from_fn(|i| part(i).epsilon.clone()))
    }

    /// Returns the rotation about the z axis by the angle whose half has the tangent `sin_half : cos_half`. Any multiple of the
    /// pair gives the same rotation, so that the angle pi is no exception.
    #[must_use]
    pub fn rotation_z(cos_half: R, sin_half: R) -> Self {
        let mut q = Self::identity();
        q.scalar = Dual::constant(cos_half);
        q.vector[2] = Dual::constant(sin_half);
        q
    }

    /// Returns the rotation about the x axis by the angle whose half has the tangent `sin_half : cos_half`.
    #[must_use]
    pub fn rotation_x(cos_half: R, sin_half: R) -> Self {
        let mut q = Self::identity();
        q.scalar = Dual::constant(cos_half);
        q.vector[0] = Dual::constant(sin_half);
        q
    }

    /// Returns a translation, as `2 + eps t`, since some rings have no 1/2.
    #[must_use]
    pub fn translation(t: &Vector<R>) -> Self {
        let part = |c: &R| Dual { value: R::zero(), epsilon: c.clone() };
        Self { scalar: Dual::constant(R::from_integer(2)), vector: [part(&t[0]), part(&t[1]), part(&t[2])] }
    }

    /// Returns `x0 y0 + x1 y1 + x2 y2 + x3 y3`, which is zero for motions.
    #[must_use]
    pub fn study_residual(&self) -> R {
        let (x, y) = self.study();
        x.iter().zip(&y).fold(R::zero(), |sum, (x, y)| sum.add(&x.mul(y)))
    }

    /// Rotation matrix and translation vector, both times the norm `x0^2 + ... + x3^2`, and that norm.
    ///
    /// Off the Study quadric this is the motion of the point in which the fibre `y + s x` meets the quadric.
    #[must_use]
    pub fn scaled_motion(&self) -> (Motion<R>, R) {
        let (x, y) = self.study();
        let quaternion = |[w, i, j, k]: [R; 4]| Quaternion { scalar: w, vector: [i, j, k] };
        let (x, y) = (quaternion(x), quaternion(y));
        let half = y.mul(&x.conjugate()).vector;
        let translation = std::array::from_fn(|i| half[i].add(&half[i]));
        (Motion { rotation: x.scaled_rotation(), translation }, x.norm())
    }

    /// Returns the image of a point in homogeneous coordinates: the norm times the image, and the norm.
    #[must_use]
    pub fn scaled_image(&self, p: &Vector<R>) -> (Vector<R>, R) {
        let (motion, norm) = self.scaled_motion();
        (motion.apply(p), norm)
    }
}

impl<F: Field> DualQuaternion<F> {
    /// Returns the motion; `None` if the norm vanishes.
    #[must_use]
    pub fn to_motion(&self) -> Option<Motion<F>> {
        let (scaled, norm) = self.scaled_motion();
        let inverse = norm.inverse()?;
        scaled.map(|c| Some(c.mul(&inverse)))
    }
}
