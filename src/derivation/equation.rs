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
    /// The equation in the cosines and sines of the unknowns.
    pub polynomial: Polynomial<Rational>,
    /// The equation in half-angle tangents, if the elimination uses it; identical if the first form has no cosine.
    pub algebraic: Option<Polynomial<Rational>>,
}

/// Returns the primitive multiple with positive leading coefficient.
pub(super) fn primitive(polynomial: &Polynomial<Rational>) -> Polynomial<Rational> {
    let image = |c: &Int| Some(Rational::from(c.to_integer()));
    polynomial.primitive().0.map(image).unwrap_or_else(|| polynomial.clone())
}

impl Equation {
    /// Returns an equation that is only listed.
    pub(super) fn listed(name: String, polynomial: &Polynomial<Rational>) -> Self {
        Self { name, polynomial: primitive(polynomial), algebraic: None }
    }

    /// Returns an equation that the elimination uses.
    pub(super) fn used(name: String, polynomial: &Polynomial<Rational>) -> Self {
        let algebraic = Some(primitive(&half_angles(polynomial)));
        Self { algebraic, ..Self::listed(name, polynomial) }
    }
}
