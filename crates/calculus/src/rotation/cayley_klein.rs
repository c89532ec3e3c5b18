//! Cayley-Klein parameters: `alpha = q0 + i q3`, `beta = q2 + i q1`, the first row of a matrix of SU(2) up to signs that differ
//! between books.

use crate::quaternion::Quaternion;
use looproot_algebra::ring::Ring;

/// The two complex parameters, each as real and imaginary part.
#[derive(Clone, Debug, PartialEq)]
pub struct CayleyKlein<R> {
    /// `q0 + i q3`
    pub alpha: [R; 2],
    /// `q2 + i q1`
    pub beta: [R; 2],
}

impl<R: Ring> CayleyKlein<R> {
    /// Returns the parameters of a quaternion. Those of the opposite quaternion belong to the same rotation.
    #[must_use]
    pub fn of(q: &Quaternion<R>) -> Self {
        let [x, y, z] = q.vector.clone();
        Self { alpha: [q.scalar.clone(), z], beta: [y, x] }
    }

    /// Returns the quaternion of the parameters.
    #[must_use]
    pub fn quaternion(&self) -> Quaternion<R> {
        let ([w, z], [y, x]) = (self.alpha.clone(), self.beta.clone());
        Quaternion { scalar: w, vector: [x, y, z] }
    }

    /// Returns the parameters of the rotation by `other` first, then by `self`: a product in SU(2).
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::{quaternion::Quaternion, rotation::cayley_klein::CayleyKlein};
    /// let p = Quaternion { scalar: 1.0, vector: [2.0, -3.0, 5.0] };
    /// let q = Quaternion { scalar: 7.0, vector: [-1.0, 4.0, 2.0] };
    /// let product = CayleyKlein::of(&p).times(&CayleyKlein::of(&q));
    /// assert_eq!(product, CayleyKlein::of(&p.mul(&q)));
    /// ```
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        // [alpha, beta; -conj(beta), conj(alpha)] of q2 + i q1 is the image of q.
        let mul = |[a, b]: &[R; 2], [c, d]: &[R; 2]| [a.mul(c).sub(&b.mul(d)), a.mul(d).add(&b.mul(c))];
        let conjugate = |[a, b]: &[R; 2]| [a.clone(), b.neg()];
        let add = |[a, b]: [R; 2], [c, d]: [R; 2]| [a.add(&c), b.add(&d)];
        let sub = |[a, b]: [R; 2], [c, d]: [R; 2]| [a.sub(&c), b.sub(&d)];
        // The image of a product is the product of the images in the other order.
        Self {
            alpha: sub(mul(&other.alpha, &self.alpha), mul(&other.beta, &conjugate(&self.beta))),
            beta: add(mul(&other.alpha, &self.beta), mul(&other.beta, &conjugate(&self.alpha))),
        }
    }
}
