//! The derivation of an overconstrained loop: its closure polynomials in the input and one output each.

use super::equation::{Equation, primitive};
use super::polynomial::{ClosurePolynomial, Eliminant};
use super::symbols::{Symbols, joint_labels, joint_variables};
use super::{Derivation, over_integers};
use crate::algebra::int::Int;
use crate::algebra::number::HalfTangent;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::catalogue::entry::InputValue;
use crate::error::Result;
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::Variable;
use rug::{Integer, Rational};

/// A closure polynomial in the input, variable 0, and an output, variable 1: half tangents, or distances.
pub(crate) struct Relation {
    /// Index of the output among the joint variables.
    pub output: usize,
    /// The polynomial with integer coefficients, without multiple factors and without factors in the input alone.
    pub polynomial: Polynomial<Int>,
}

/// Returns the derivation with these polynomials; its closure polynomial is the first one at the input of the case.
pub(crate) fn derivation(
    chain: &Chain,
    input: usize,
    value: &InputValue,
    relations: &[Relation],
) -> Result<Derivation> {
    let symbols = Symbols::variables(joint_labels(chain), joint_variables(chain).into_iter().map(|(_, kind)| kind));
    let in_place = |relation: &Relation| {
        let places = [input, relation.output].map(Symbols::variable);
        Polynomial::from_terms(relation.polynomial.terms().map(|(exponents, c)| {
            let mut moved = vec![0; 3 * symbols.len()];
            for (place, power) in places.into_iter().zip(exponents) {
                moved[place] = power;
            }
            (moved, Rational::from(c.to_integer()))
        }))
    };
    let label = |index: usize| symbols.label(index).to_owned();
    let equations = relations.iter().map(|relation| {
        let polynomial = primitive(&in_place(relation));
        let degrees = [0, 1].map(|k| relation.polynomial.degree(k));
        let name = format!(
            "closure of joints {} and {}, of degree {} and {}",
            label(input),
            label(relation.output),
            degrees[0],
            degrees[1]
        );
        Equation { name, polynomial: polynomial.clone(), algebraic: Some(polynomial) }
    });
    let equations: Vec<Equation> = equations.collect();
    let steps = vec![
        format!(
            "The loop has fewer than seven joint variables: with joint {} given, the closure equations are more than the unknowns. What all of them have \
             for a common divisor, in the input and one output, vanishes along every branch on which the input is not constant.",
            label(input)
        ),
        "Each polynomial is that divisor, computed over the rationals with the numbers of the file, which satisfy the conditions under which the loop \
         moves: without multiple factors, without factors in the input alone, and without 1 + t^2."
            .to_owned(),
    ];
    let first = &relations[0];
    let at = at_input(&first.polynomial, value);
    let full = first.polynomial.degree(1) as usize;
    let variable = Symbols::variable(first.output);
    let is_angle = joint_variables(chain).get(first.output).is_some_and(|(_, kind)| *kind == Variable::Rotation);
    let at_pi = if is_angle { full - at.degree().unwrap_or(full) } else { 0 };
    let polynomial = match at.degree() {
        None => None,
        Some(_) => Some(ClosurePolynomial::of(variable, Eliminant { coefficients: at, at_pi, removed: Vec::new() })?),
    };
    let without = polynomial.is_none().then(|| {
        "the closure polynomial vanishes at this input: the loop moves while its input stands still".to_owned()
    });
    let warnings = vec![
        "isolated configurations, at which the loop closes at this input alone, need not be roots: sweep and solve list them".to_owned(),
    ];
    Ok(Derivation {
        names: symbols.names()?,
        equations,
        steps,
        polynomial,
        without,
        proved: true,
        per_root: 1,
        finite: true,
        definition: None,
        warnings,
    })
}

/// Returns the polynomial in the output at the input of a case.
fn at_input(polynomial: &Polynomial<Int>, value: &InputValue) -> Univariate<Integer> {
    let rows: Vec<Univariate<Integer>> =
        polynomial.coefficients_in(1).iter().map(|row| over_integers(row, 0)).collect();
    let number = match value {
        InputValue::Angle(angle) => match angle.half_tangent() {
            HalfTangent::Finite(t) => Some(t.clone()),
            HalfTangent::Infinite => None,
        },
        InputValue::Distance(distance) => Some(distance.rational().clone()),
    };
    let degree = rows.iter().filter_map(Univariate::degree).max().unwrap_or(0);
    let at = |row: &Univariate<Integer>| -> Rational {
        match &number {
            Some(s) => row.coefficients().iter().rev().fold(Rational::new(), |value, c| value * s + c),
            None => row.coefficients().get(degree).map(Rational::from).unwrap_or_default(),
        }
    };
    let values: Univariate<Rational> = Univariate::new(rows.iter().map(at).collect());
    if values.is_zero() { Univariate::zero() } else { Univariate::new(values.primitive_integers()) }
}
