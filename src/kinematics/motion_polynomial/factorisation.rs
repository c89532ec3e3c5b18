//! All factorisations of a motion polynomial into linear factors.

use super::{MotionPolynomial, coefficients, from_parts, inverse, negated, parts, product, sum};
use crate::algebra::ring::{Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::kinematics::dual_quaternion::DualQuaternion;

/// Why a polynomial is no motion, or does not factor this way.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Flaw {
    /// The polynomial is constant.
    Constant,
    /// The leading coefficient has no inverse, so that the polynomial cannot be made monic.
    Leading,
    /// The norm has a dual part: the values are off the Study quadric.
    Study,
}

/// The factorisations of a monic polynomial.
#[derive(Clone, Debug)]
pub struct Factorisations<F> {
    /// The polynomial after division by its leading coefficient.
    pub monic: MotionPolynomial<F>,
    /// The quadratic factors of the norm.
    pub quadratics: Vec<Univariate<F>>,
    /// For each order of the quadratics that gives one, the order (factor k from the left has the norm of this number) and the
    /// factors h with `C = (t - h_1) ... (t - h_n)`.
    pub list: Vec<(Vec<usize>, Vec<DualQuaternion<F>>)>,
    /// Orders for which a remainder had no inverse.
    pub failed: usize,
    /// The largest part by which the product of a factorisation differs from the polynomial; 0 in exact fields.
    pub defect: f64,
}

/// The polynomial divided by its leading coefficient, from the left.
///
/// # Errors
/// For what is no motion at all.
pub fn monic<F: Field>(polynomial: &MotionPolynomial<F>) -> Result<MotionPolynomial<F>, Flaw> {
    let all = coefficients(polynomial);
    let leading = match all.as_slice() {
        [] | [_] => return Err(Flaw::Constant),
        [.., leading] => inverse(leading).ok_or(Flaw::Leading)?,
    };
    let constant = from_parts(&parts(&leading).map(Univariate::constant));
    let scaled = constant.mul(polynomial);
    let norm = scaled.norm();
    let size = |p: &Univariate<F>| p.coefficients().iter().map(Field::pivot_size).fold(0.0, f64::max);
    if size(&norm.epsilon) > F::PIVOT_ZERO * 1e4 * size(&norm.value) {
        return Err(Flaw::Study);
    }
    Ok(scaled)
}

/// `C = D (t - h)` and the remainder `C(h)`, with the powers of h on the right.
fn divide<F: Field>(all: &[DualQuaternion<F>], h: &DualQuaternion<F>) -> (Vec<DualQuaternion<F>>, DualQuaternion<F>) {
    let mut quotient = Vec::with_capacity(all.len());
    let mut carry = from_parts(&std::array::from_fn(|_| F::zero()));
    for c in all.iter().rev() {
        carry = sum(c, &carry.mul(h));
        quotient.push(carry.clone());
    }
    let remainder = quotient.pop().unwrap_or(carry);
    quotient.reverse();
    (quotient, remainder)
}

/// The right factor `t - h` whose norm is this quadratic: `h = -r1^-1 r0` with the remainder `r1 t + r0` of the division by
/// it. `None` where `r1` has no inverse.
fn right_factor<F: Field>(all: &[DualQuaternion<F>], quadratic: &Univariate<F>) -> Option<DualQuaternion<F>> {
    let rest = super::from_coefficients(all);
    let remainders = parts(&rest).map(|part| part.div_rem(quadratic).1);
    let coefficient = |k: usize| {
        let entry = |p: &Univariate<F>| p.coefficients().get(k).cloned().unwrap_or_else(F::zero);
        from_parts(&remainders.each_ref().map(entry))
    };
    let (r0, r1) = (coefficient(0), coefficient(1));
    let scale = parts(&r0).iter().chain(&parts(&r1)).map(Field::pivot_size).fold(0.0, f64::max);
    let primal = r1.norm().value.pivot_size();
    if primal <= F::PIVOT_ZERO * scale * scale {
        return None;
    }
    Some(negated(&inverse(&r1)?.mul(&r0)))
}

/// All factorisations that split the quadratic factors of the norm off in some order.
///
/// # Errors
/// For a polynomial that is no motion.
///
/// # Panics
/// When the number of quadratics differs from the degree.
///
/// # Source
/// \[HegedusSchichoSchrocker2013\], the algorithm of their section 3.
pub fn factorisations<F: Field>(
    polynomial: &MotionPolynomial<F>,
    quadratics: &[Univariate<F>],
) -> Result<Factorisations<F>, Flaw> {
    let monic = monic(polynomial)?;
    let all = coefficients(&monic);
    assert_eq!(quadratics.len() + 1, all.len(), "one quadratic for every degree");
    let mut found = Factorisations { monic, quadratics: quadratics.to_vec(), list: Vec::new(), failed: 0, defect: 0.0 };
    let mut order = Vec::new();
    let mut factors = Vec::new();
    descend(&mut found, &all, &mut order, &mut factors);
    let target = parts(&found.monic);
    for (_, factors) in &found.list {
        for (a, b) in parts(&product(factors)).iter().zip(&target) {
            let defect = a.sub(b).coefficients().iter().map(Field::pivot_size).fold(0.0, f64::max);
            found.defect = found.defect.max(defect);
        }
    }
    Ok(found)
}

/// Splits factors off from the right; equal quadratics in one order only.
fn descend<F: Field>(
    found: &mut Factorisations<F>,
    rest: &[DualQuaternion<F>],
    order: &mut Vec<usize>,
    factors: &mut Vec<DualQuaternion<F>>,
) {
    if rest.len() == 1 {
        found.list.push((order.iter().rev().copied().collect(), factors.iter().rev().cloned().collect()));
        return;
    }
    for k in 0..found.quadratics.len() {
        let seen_before = (0..k).any(|j| !order.contains(&j) && found.quadratics[j] == found.quadratics[k]);
        if order.contains(&k) || seen_before {
            continue;
        }
        let Some(h) = right_factor(rest, &found.quadratics[k]) else {
            found.failed += 1;
            continue;
        };
        let (quotient, remainder) = divide(rest, &h);
        // In an exact field a remainder means that the quadratic does not divide the norm as often as it is listed.
        if F::PIVOT_ZERO == 0.0 && parts(&remainder).iter().any(|part| !part.is_zero()) {
            found.failed += 1;
            continue;
        }
        order.push(k);
        factors.push(h);
        descend(found, &quotient, order, factors);
        order.pop();
        factors.pop();
    }
}
