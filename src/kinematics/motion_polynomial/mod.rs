//! Rational motions: polynomials over the dual quaternions, their linear factors, and the closed loops these make.
//!
//! A monic polynomial `C(t)` whose norm is real is a motion for every t. Its factorisations `C = (t - h_1) ... (t - h_n)` are
//! chains of revolute joints that perform it, and two of them, the one run forwards and the other backwards, a closed loop
//! that moves: every step exact over the rationals. \[HegedusSchichoSchrocker2013\]

mod factorisation;
mod linkage;
mod parameters;
mod quadratic;

pub use factorisation::{Factorisations, Flaw, factorisations, monic};
pub use linkage::{Joint, Linkage};
pub use parameters::{LinkParameters, bennett_ratio};
pub use quadratic::{numeric_quadratics, quadratic_factors};

use super::dual_quaternion::DualQuaternion;
use crate::algebra::dual::Dual;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::univariate::Univariate;

/// A polynomial in t with dual quaternions for coefficients, which t commutes with: a dual quaternion of polynomials.
pub type MotionPolynomial<F> = DualQuaternion<Univariate<F>>;

/// The eight parts of a dual quaternion, Study's `x0..x3, y0..y3`.
#[must_use]
pub fn parts<R: Ring>(q: &DualQuaternion<R>) -> [R; 8] {
    let (x, y) = q.study();
    std::array::from_fn(|k| if k < 4 { x[k].clone() } else { y[k - 4].clone() })
}

/// The dual quaternion with these eight parts.
#[must_use]
pub fn from_parts<R: Ring>(parts: &[R; 8]) -> DualQuaternion<R> {
    DualQuaternion::from_study(
        &std::array::from_fn(|k| parts[k].clone()),
        &std::array::from_fn(|k| parts[k + 4].clone()),
    )
}

/// The polynomial with these coefficients, the constant one first.
#[must_use]
pub fn from_coefficients<R: Ring>(coefficients: &[DualQuaternion<R>]) -> MotionPolynomial<R> {
    let parts: Vec<[R; 8]> = coefficients.iter().map(parts).collect();
    from_parts(&std::array::from_fn(|k| Univariate::new(parts.iter().map(|part| part[k].clone()).collect())))
}

/// The coefficients, the constant one first; none for the zero polynomial.
#[must_use]
pub fn coefficients<R: Ring>(polynomial: &MotionPolynomial<R>) -> Vec<DualQuaternion<R>> {
    let parts = parts(polynomial);
    let count = parts.iter().map(|part| part.coefficients().len()).max().unwrap_or(0);
    let entry = |part: &Univariate<R>, k: usize| part.coefficients().get(k).cloned().unwrap_or_else(R::zero);
    (0..count).map(|k| from_parts(&std::array::from_fn(|j| entry(&parts[j], k)))).collect()
}

/// `t - h`
#[must_use]
pub fn linear<R: Ring>(h: &DualQuaternion<R>) -> MotionPolynomial<R> {
    let one = DualQuaternion::identity();
    from_coefficients(&[negated(h), one])
}

/// `(t - h_1) (t - h_2) ...`
#[must_use]
pub fn product<R: Ring>(factors: &[DualQuaternion<R>]) -> MotionPolynomial<R> {
    factors.iter().fold(DualQuaternion::identity(), |product, h| product.mul(&linear(h)))
}

/// The value at a real number.
#[must_use]
pub fn evaluate<R: Ring>(polynomial: &MotionPolynomial<R>, t: &R) -> DualQuaternion<R> {
    from_parts(&parts(polynomial).map(|part| part.eval(t)))
}

/// `-q`
#[must_use]
pub fn negated<R: Ring>(q: &DualQuaternion<R>) -> DualQuaternion<R> {
    from_parts(&parts(q).map(|part| part.neg()))
}

/// `p + q`
#[must_use]
pub fn sum<R: Ring>(p: &DualQuaternion<R>, q: &DualQuaternion<R>) -> DualQuaternion<R> {
    let (p, q) = (parts(p), parts(q));
    from_parts(&std::array::from_fn(|k| p[k].add(&q[k])))
}

/// The inverse `q* / (q q*)`; `None` where the primal part of the norm is zero.
#[must_use]
pub fn inverse<F: Field>(q: &DualQuaternion<F>) -> Option<DualQuaternion<F>> {
    let norm = q.norm().inverse()?;
    let scale = |part: &Dual<F>| part.mul(&norm);
    let conjugate = q.conjugate();
    Some(DualQuaternion { scalar: scale(&conjugate.scalar), vector: conjugate.vector.each_ref().map(scale) })
}
