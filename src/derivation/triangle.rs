//! Three rotations: one equation in one angle.

use super::Equation;
use super::chain::{Eliminated, Exact};
use super::polynomial::Meaning;
use super::symbols::combination;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::elimination::separated::powers;
use crate::elimination::spherical_triangle::triangle;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::link_form::LinkForm;
use rug::Rational;

/// The polynomial of a row over `(1, cos, sin)` or `(1, d, d^2)`.
pub(super) fn of_row<R: Ring>(kind: Variable, row: &[R; 3]) -> Univariate<R> {
    let powers = powers(kind, &[1, 1, 0].map(R::from_integer));
    let coefficient = |k: usize| (0..3).fold(R::zero(), |sum, i| sum.add(&row[i].mul(&powers[i][k])));
    Univariate::new((0..3).map(coefficient).collect())
}

/// The equation of the spherical triangle and its polynomial.
pub(super) fn eliminate(exact: &Exact) -> Option<Eliminated> {
    let form: LinkForm<Rational, 3, 3> = LinkForm::of(&exact.closed)?;
    let found = triangle(&form);
    let label = |k: usize| exact.symbols.label(form.rotations[(found.dropped + k) % 3]);
    let unknown = form.rotations[(found.dropped + 2) % 3];
    let monomials = exact.symbols.monomials(unknown, false);
    let polynomial = combination(found.equation.iter().zip(&monomials));
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
        "The other two rotations are rational in it, and the three translations solve three linear equations."
            .to_owned(),
        format!("In {} the equation is of degree 2.", exact.symbols.name(unknown)),
    ];
    Some(Eliminated {
        equations: vec![Equation::used(name, &polynomial)],
        steps,
        polynomial: Some((unknown, of_row(Variable::Rotation, &found.equation), Meaning::HalfTangent { degree: 2 })),
        removed: Vec::new(),
        per_root: 1,
    })
}
