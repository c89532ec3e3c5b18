//! One closure equation.

use super::symbols::half_angles;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use rug::Rational;

/// A closure equation, `polynomial = 0`, with integer coefficients without common factor.
#[derive(Clone, Debug, PartialEq)]
pub struct Equation {
    /// Its name, with the axes at which the loop is cut.
    pub name: String,
    /// In the cosines and sines of the unknowns.
    pub polynomial: Polynomial<Rational>,
    /// In half-angle tangents, where the elimination goes on with it. Where the first form has no cosine, the same one.
    pub algebraic: Option<Polynomial<Rational>>,
}

/// The primitive multiple with positive leading coefficient.
pub(super) fn primitive(polynomial: &Polynomial<Rational>) -> Polynomial<Rational> {
    let image = |c: &Int| Some(Rational::from(c.to_integer()));
    polynomial.primitive().0.map(image).unwrap_or_else(|| polynomial.clone())
}

impl Equation {
    /// An equation that is only listed.
    pub(super) fn listed(name: String, polynomial: &Polynomial<Rational>) -> Self {
        Self { name, polynomial: primitive(polynomial), algebraic: None }
    }

    /// An equation that the elimination goes on with.
    pub(super) fn used(name: String, polynomial: &Polynomial<Rational>) -> Self {
        let algebraic = Some(primitive(&half_angles(polynomial)));
        Self { algebraic, ..Self::listed(name, polynomial) }
    }
}
