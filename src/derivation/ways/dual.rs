//! The principle of transference: the equations of the spherical loop over dual numbers.

use super::{Found, Matrix, Way, refusal};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::derivation::Equation;
use crate::derivation::chain::Exact;
use crate::derivation::symbolic::dual::{axes, dualised, opposite_link, pair_at};
use crate::derivation::symbols::{Symbols, bilinear_form, combination};
use crate::derivation::triangle::of_row;
use crate::elimination::cut::Hidden;
use crate::elimination::octic::closure_polynomial;
use crate::elimination::spherical_triangle::triangle_without;
use crate::error::Result;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::link_form::LinkForm;
use rug::Rational;

/// Derives, over dual numbers, a loop whose translations run along axes of its rotations.
pub(super) fn found(exact: &Exact, unknown: usize) -> Result<Found> {
    let none = |why: &str| refusal(Way::Dual, why);
    if exact.spherical.is_some() {
        return Err(none("a spherical joint has no axis, and so no dual angle"));
    }
    if let Some(form) = LinkForm::<Rational, 3, 3>::of(&exact.closed) {
        if axes(&form) != Some([0, 1, 2]) {
            return Err(none("every translation must run along the axis of a rotation of its own (three C joints)"));
        }
        return triangle(exact, &form, unknown).ok_or_else(|| none("no dual triangle keeps the unknown"));
    }
    if let Some(form) = LinkForm::<Rational, 4, 2>::of(&exact.closed) {
        let Some(base) = opposite_link(&form) else {
            return Err(none("the two translations must run along the two axes of one link"));
        };
        return four_bar(exact, &form, base, unknown)
            .ok_or_else(|| none("no pair of dual equations keeps the unknown"));
    }
    Err(none(
        "it needs two translations along axes of rotations at least: a rotation without a translation along its axis has a real angle, and \
         dual equations of five or six of those are no fewer than the closure equations themselves",
    ))
}

/// Derives three cylindrical joints: the dual spherical triangle.
fn triangle(exact: &Exact, form: &LinkForm<Rational, 3, 3>, unknown: usize) -> Option<Found> {
    let dual = dualised(form);
    let dropped = (0..3).find(|dropped| form.rotations[(dropped + 2) % 3] == unknown)?;
    let label = |k: usize| exact.symbols.label(form.rotations[(dropped + k) % 3]);
    let monomials = exact.symbols.monomials(unknown, false);
    let row = triangle_without(&dual, dropped).equation;
    let [value, epsilon] = [row.each_ref().map(|x| x.value.clone()), row.each_ref().map(|x| x.epsilon.clone())];
    let axis = (dropped + 2) % 3;
    let slide = form.slides[axis].unknown;
    let d: Polynomial<Rational> = Polynomial::variable(Symbols::variable(slide));
    // The dual part in theta + eps d: its own dual part, and d times the derivative of its value.
    let turned = [Rational::new(), value[2].clone(), Rational::from(-&value[1])];
    let moment = combination(epsilon.iter().zip(&monomials)).add(&combination(turned.iter().zip(&monomials)).mul(&d));
    let equations = vec![
        Equation::used(
            format!("dual triangle {}-{}, value", label(1), label(3)),
            &combination(value.iter().zip(&monomials)),
        ),
        Equation::used(format!("dual triangle {}-{}, dual part", label(1), label(3)), &moment),
    ];
    let steps = vec![
        format!(
            "Joint {} has the dual angle theta + eps d, and its link the dual twist alpha + eps a, with eps^2 = 0. The spherical triangle holds over \
             dual numbers: the axes of joints {} and {} keep the dual angle of the link between them.",
            label(2),
            label(1),
            label(3)
        ),
        format!(
            "The value of this equation is of degree 2 in {}: the closure polynomial. Its dual part is linear in {}, which follows rationally; \
             the other two translations from the dual triangles at the other links.",
            exact.symbols.name(unknown),
            exact.symbols.name(slide)
        ),
    ];
    let eliminant = of_row(Variable::Rotation, &value);
    let meaning = "one dual equation, its value and its dual part, over (1, d) of the joint".to_owned();
    Some(Found {
        equations,
        steps,
        matrix: Matrix { rows: 2, columns: 2, entries: 2, meaning },
        eliminants: vec![eliminant],
    })
}

/// Derives two cylindrical joints on one link: the dual spherical four-bar, written for the link opposite.
fn four_bar(exact: &Exact, form: &LinkForm<Rational, 4, 2>, base: usize, unknown: usize) -> Option<Found> {
    let equations = pair_at(&form.links, base);
    let unknowns = [0, 1].map(|k| form.rotations[(base + k) % 4]);
    let hidden = match unknowns.iter().position(|own| *own == unknown)? {
        0 => Hidden::First,
        _ => Hidden::Second,
    };
    let label = |k: usize| exact.symbols.label(form.rotations[(base + k) % 4]);
    let monomials = unknowns.map(|k| exact.symbols.monomials(k, false));
    let pair = [("value n.n'", &equations.f), ("dual part n.(r x n')", &equations.g)];
    let listed = pair.map(|(name, form)| {
        let name = format!("dual four-bar {}-{}, {name}", label(2), label(3));
        Equation::used(name, &bilinear_form(form, &monomials[0], &monomials[1]))
    });
    let gone = exact.symbols.name(if hidden == Hidden::First { unknowns[1] } else { unknowns[0] });
    let steps = vec![
        format!(
            "The translations run along the axes of joints {} and {}. Over dual numbers the link between these keeps its dual angle: the value f = 0 and \
             the dual part g = 0 of one equation in the angles of joints {} and {}, free of both translations.",
            label(2),
            label(3),
            label(0),
            label(1)
        ),
        format!(
            "Both are linear in (1, cos, sin) of {gone}: the vector product N of their rows leaves N1^2 + N2^2 - N3^2 = 0, of degree 8 in {}.",
            exact.symbols.name(unknown)
        ),
    ];
    let origin = [1, 1, 0].map(Rational::from);
    let eliminant: Univariate<Rational> = closure_polynomial(&equations, hidden, &origin);
    let meaning = format!("value and dual part of one equation over (1, cos, sin) of {gone}");
    let matrix = Matrix { rows: 2, columns: 3, entries: 2, meaning };
    Some(Found { equations: listed.into(), steps, matrix, eliminants: vec![eliminant] })
}
