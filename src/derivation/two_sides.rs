//! Spherical joints, and translations along two opposite axes: two equations with one unknown on each side.

use super::Equation;
use super::chain::{Eliminated, Exact};
use super::polynomial::Meaning;
use super::symbols::{Symbols, combination};
use super::triangle::of_row;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::elimination::separated::{Plan, Separated, powers, quartic};
use crate::elimination::spherical_pair;
use crate::elimination::two_sided::TwoSided;
use crate::kinematics::closed_loop::{SsDyad, Variable};
use rug::Rational;

/// Derives loops with two equations in one unknown each; `None` if the polynomial vanishes, or another elimination is the better one.
pub(super) fn eliminate(exact: &Exact, way: TwoSided) -> Option<Eliminated> {
    let variables = exact.closed.variables;
    let equations = way.serves(&exact.closed)?;
    let words = way.words(variables, |k| exact.symbols.label(k));
    let mut eliminated = solve(exact, &equations, way.unknowns(variables), words.names);
    eliminated.polynomial.as_ref().filter(|(_, polynomial, _)| way.is_last() || !polynomial.is_zero())?;
    eliminated.steps.insert(0, words.before);
    eliminated.steps.push(words.after);
    Some(eliminated)
}

/// Derives loops with two spherical joints, whose centres keep their distance.
pub(super) fn ss_dyad(symbols: &Symbols, labels: &[String], ss_dyad: &SsDyad<Rational>) -> Eliminated {
    let spherical = |k: usize| labels[ss_dyad.indices[k]].split('_').next().unwrap_or_default().to_owned();
    let equation = spherical_pair::equation(ss_dyad);
    let polynomial = combination(equation.iter().zip(&symbols.monomials(0, false)));
    let name = format!("centres of spherical joints {} and {} r.r", spherical(0), spherical(1));
    let meaning = match ss_dyad.variable {
        Variable::Rotation => Meaning::HalfTangent { degree: 2 },
        Variable::Translation => Meaning::Plain,
    };
    let steps = vec![
        format!(
            "The link between spherical joints {} and {} keeps the distance of their centres; joint {} carries one of them: one equation \
             in its unknown, of degree 2 in {}.",
            spherical(0),
            spherical(1),
            symbols.label(0),
            symbols.name(0)
        ),
        "The rotations of both spherical joints follow, but for the spin of the link about the line of their centres, which is free."
            .to_owned(),
    ];
    Eliminated {
        equations: vec![Equation::used(name, &polynomial)],
        steps,
        polynomial: Some((0, of_row(ss_dyad.variable, &equation), meaning)),
        removed: Vec::new(),
        per_root: 1,
    }
}

/// Solves the equations with these unknowns on their sides.
fn solve(exact: &Exact, equations: &Separated<Rational>, unknowns: [usize; 2], names: [String; 2]) -> Eliminated {
    let monomials = unknowns.map(|unknown| exact.symbols.monomials(unknown, false));
    let listed = equations.rows.iter().zip(names).map(|(row, name)| {
        let [left, right] = [0, 1].map(|side| combination(row[side].iter().zip(&monomials[side])));
        Equation::used(name, &left.sub(&right))
    });
    let name = |side: usize| exact.symbols.name(unknowns[side]);
    let (side, polynomial, step) = match equations.plan(0.0) {
        Plan::Together { hidden, other } => {
            let origin = [1, 1, 0].map(Rational::from);
            let powers = powers(equations.kinds[hidden], &origin);
            let polynomial = Univariate::new(quartic(&equations.conic(hidden, &other), &powers).to_vec());
            let conic = match equations.kinds[1 - hidden] {
                Variable::Rotation => "cos^2 + sin^2 = 1",
                Variable::Translation => "d d = d^2",
            };
            let step = format!(
                "The two equations are linear in the monomials of both unknowns, {} and {}: solved for those of the second \
                 one and put into {conic}, they leave a polynomial of degree 4 or less in {}.",
                name(hidden),
                name(1 - hidden),
                name(hidden)
            );
            (hidden, polynomial, step)
        }
        Plan::Apart { first, equation, .. } => {
            let step = format!(
                "One combination of the two equations is free of {}: degree 2 or less in {}; to each root belong the roots of \
                 an equation of degree 2 or less in {}.",
                name(1 - first),
                name(first),
                name(1 - first)
            );
            (first, of_row(equations.kinds[first], &equation), step)
        }
    };
    let apart = matches!(equations.plan(0.0), Plan::Apart { .. });
    let (degree, per_root) = if apart { (2, 2) } else { (4, 1) };
    let meaning = match equations.kinds[side] {
        Variable::Rotation => Meaning::HalfTangent { degree },
        Variable::Translation => Meaning::Plain,
    };
    let polynomial = Some((unknowns[side], polynomial, meaning));
    Eliminated { equations: listed.collect(), steps: vec![step], polynomial, removed: Vec::new(), per_root }
}
