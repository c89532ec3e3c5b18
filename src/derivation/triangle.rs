//! Three rotations: one equation in one angle.

use super::Equation;
use super::chain::{Eliminated, Exact};
use super::four_bar::removed;
use super::polynomial::Meaning;
use super::symbols::combination;
use crate::algebra::ring::{Domain, Ring};
use crate::algebra::univariate::Univariate;
use crate::elimination::separated::powers;
use crate::elimination::spherical_triangle::{false_roots, triangle};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::link_form::LinkForm;
use rug::Rational;

/// Returns the polynomial of a row over `(1, cos, sin)` or `(1, d, d^2)`.
pub(super) fn of_row<R: Ring>(kind: Variable, row: &[R; 3]) -> Univariate<R> {
    let powers = powers(kind, &[1, 1, 0].map(R::from_integer));
    let coefficient = |k: usize| (0..3).fold(R::zero(), |sum, i| sum.add(&row[i].mul(&powers[i][k])));
    Univariate::new((0..3).map(coefficient).collect())
}

/// Returns the equation of the spherical triangle and its polynomial.
pub(super) fn eliminate(exact: &Exact) -> Option<Eliminated> {
    let form: LinkForm<Rational, 3, 3> = LinkForm::of(&exact.closed)?;
    let found = triangle(&form);
    let label = |k: usize| exact.symbols.label(form.rotations[(found.dropped + k) % 3]);
    let unknown = form.rotations[(found.dropped + 2) % 3];
    let monomials = exact.symbols.monomials(unknown, false);
    let equation = combination(found.equation.iter().zip(&monomials));
    let name = format!("spherical triangle {}-{} n.n'", label(1), label(3));
    let steps = vec![
        format!(
            "The rotations {}, {}, {} close by themselves: a spherical triangle. The axes of joints {} and {} keep the angle \
             of the link between them, one equation in the angle of joint {}.",
            label(1),
            label(2),
            label(3),
            label(1),
            label(3),
            label(2)
        ),
        "The other two rotations are rational in it, and the three translations solve three linear equations; a root at which \
         these are dependent without closing the loop is no solution."
            .to_owned(),
        format!("In {} the equation is of degree 2.", exact.symbols.name(unknown)),
    ];
    let all = of_row(Variable::Rotation, &found.equation);
    let (lost, at_pi) = false_roots(&form, &found);
    let reason = "the translations are dependent there and do not close the loop";
    let degree = 2 - lost.degree().unwrap_or(0) - at_pi;
    let polynomial = (unknown, if all.is_zero() { all } else { all.div_exact(&lost) }, Meaning::HalfTangent { degree });
    Some(Eliminated {
        equations: vec![Equation::used(name, &equation)],
        steps,
        polynomial: Some(polynomial),
        removed: removed(unknown, &lost, at_pi, reason),
        per_root: 1,
    })
}
