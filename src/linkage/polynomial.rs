//! The exact closure polynomial of a group, in the tangent of half the angle of its hidden class.
//!
//! The determinant of the real form vanishes where that of the pencil does, apart from t = i and t = -i, which stand for x
//! infinite and zero and are divided out.

use super::isotropic::Isotropic;
use super::pencil::Pencil;
use super::real_form::RealForm;
use crate::algebra::modular::determinant;
use crate::algebra::univariate::Univariate;
use crate::kinematics::linkage::Gaussian;
use rug::{Integer, Rational, ops::Pow};

/// The closure polynomial and how it was found.
#[derive(Clone, Debug)]
pub struct ClosurePolynomial {
    /// Primitive, without the factors `1 + t^2`.
    pub polynomial: Univariate<Integer>,
    /// The number of roots at the half turn, t = infinity.
    pub at_pi: usize,
    /// Rows of the matrix.
    pub size: usize,
}

/// The closure polynomial of a pencil with rational data and one parameter, a rotation; `None` where its determinant
/// vanishes or takes too much memory.
#[must_use]
pub fn closure_polynomial(pencil: &Pencil<Gaussian>) -> Option<ClosurePolynomial> {
    let form = RealForm::new(pencil)?;
    let terms = determinant(&form.matrix, 1)?;
    let mut coefficients = Vec::new();
    for (exponents, c) in terms.iter(1) {
        let power = exponents[0] as usize;
        if coefficients.len() <= power {
            coefficients.resize(power + 1, Integer::new());
        }
        coefficients[power] = c.clone();
    }
    let mut polynomial = Univariate::new(coefficients).primitive_part();
    let at_pi = form.degrees[0].saturating_sub(polynomial.degree()?);
    let circle = Univariate::new(vec![Integer::from(1), Integer::new(), Integer::from(1)]);
    while let Some(quotient) = polynomial.quotient(&circle).filter(|quotient| quotient.degree().is_some()) {
        polynomial = quotient;
    }
    Some(ClosurePolynomial { polynomial, at_pi, size: pencil.sets.len() })
}

/// The rotations by which the hidden class may be turned so that the half turn is no root: that of the half-angle tangent k.
#[must_use]
pub fn turned(k: u32) -> Isotropic<Gaussian> {
    let t = Rational::from(k);
    let square = Rational::from((&t).pow(2));
    let length = Rational::from(&square + 1);
    Isotropic::of(&Gaussian { re: (1 - square) / &length, im: t * 2 / length })
}
