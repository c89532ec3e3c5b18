//! Groups whose multiple assemblies all have rational values of one rotation.
//!
//! Over a simple root of the closure polynomial the kernel of the matrix has dimension 1, and there is one assembly at most. If as many
//! certified assemblies lie beside the multiple roots as there are simple ones, these are all there. Over a multiple root that is
//! rational the equations with that rotation have more conditions than unknowns, and their Gröbner basis is found in no time. So nine
//! links are decided whose own basis takes minutes. The theorem is in `docs/exact.md`.

use super::equations::Equations;
use super::exact_group::{EFFORT, exactly, twice_derivatives, within};
use super::general::Choice;
use super::isotropic::Value;
use super::krawczyk::Proved;
use super::points::Points;
use super::quadratic::Root;
use super::real_system::{Form, RealSystem, constant};
use super::state::{Number, number};
use crate::algebra::disc::Disc;
use crate::algebra::groebner::{Basis, Equation};
use crate::algebra::local_multiplicity::{Quadric, multiplicity};
use crate::algebra::minors::determinant_by_minors;
use crate::algebra::real_roots::RealRoot;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::kinematics::linkage::Gaussian;
use rug::Rational;

/// Largest multiplicity that is looked for: no structure of nine links has more assemblies.
const MOST: usize = 64;

/// All assemblies of a group, and whether each is real, by a choice of classes at rest and hidden and by assemblies that are certified
/// and distinct; `None` where that does not decide them.
pub(super) fn by_fibres(
    equations: &Equations<Number>,
    choice: &Choice,
    certified: &[Proved],
) -> Option<Vec<(Root, bool)>> {
    let exact = equations.exact().filter(|exact| choice.tells_all(exact))?;
    let system = RealSystem::of(&exact)?;
    if !system.spinning.is_empty() || system.equations.iter().any(|equation| equation.degree() > 2) {
        return None;
    }
    let (simple, multiple) = roots(choice)?;
    let beside: Vec<&Proved> =
        certified.iter().filter(|one| multiple.iter().all(|x| is_beside(one, choice, x))).collect();
    if beside.len() != simple {
        return None;
    }
    let mut list = Vec::new();
    for one in beside {
        list.push((one.root.clone(), one.real?));
    }
    for x in &multiple {
        list.extend(fibre(&system, choice, x)?);
    }
    Some(list)
}

/// The number of simple roots of the closure polynomial, and the hidden rotations at the multiple ones; `None` where one of these is
/// not rational.
fn roots(choice: &Choice) -> Option<(usize, Vec<Gaussian>)> {
    let polynomial: Univariate<Rational> = choice.found.polynomial.map(|c| Some(Rational::from(c)))?;
    let (mut simple, mut multiple) = (0, Vec::new());
    for (part, order) in polynomial.square_free_decomposition() {
        let degree = part.degree()?;
        if order == 1 {
            simple += degree;
            continue;
        }
        let found: Vec<Rational> = part.real_roots().iter_mut().filter_map(RealRoot::rational).collect();
        if found.len() != degree {
            return None;
        }
        multiple.extend(found.iter().map(|t| choice.rotation(t)));
    }
    Some((simple, multiple))
}

/// Whether an assembly is proved to have another value of the hidden rotation.
fn is_beside(one: &Proved, choice: &Choice, x: &Gaussian) -> bool {
    let turns = &one.root.turns;
    let own = turns[choice.hidden].mul(&turns[choice.rest].mirrored());
    own.sub(&number::<Value>(x)).z.disc.is_not_zero()
}

/// All assemblies with a rational value of the hidden rotation; `None` where one of them is not isolated, or neither rational nor regular.
fn fibre(system: &RealSystem, choice: &Choice, x: &Gaussian) -> Option<Vec<(Root, bool)>> {
    let Form { re, im } = system.turns[choice.hidden].sub(&constant(x).mul(&system.turns[choice.rest]));
    let all: Vec<Equation> = system.equations.iter().cloned().chain([re, im]).collect();
    let basis: Basis = Basis::of(system.unknowns, &all, EFFORT)?;
    match basis.dimension() {
        None => return Some(Vec::new()),
        Some(0) => {}
        Some(_) => return None,
    }
    let points = Points::of(system.unknowns, &basis)?;
    let one = |(root, _): &(_, usize)| {
        let Some(at) = points.rational(root) else {
            let at = points.narrow(root)?;
            let (turns, shifts) = within(system, &at);
            return is_regular(system, &at).then_some((Root { turns, shifts, multiplicity: 1 }, root.is_real()));
        };
        let equations: Vec<Quadric<Rational>> =
            system.equations.iter().map(|equation| quadric(equation, &at)).collect();
        let (turns, shifts) = exactly(system, &at);
        Some((Root { turns, shifts, multiplicity: multiplicity(&equations, MOST)? }, true))
    };
    points.list.iter().map(one).collect()
}

/// Whether the derivatives of the equations are proved to be independent at a point, which is then a simple solution.
fn is_regular(system: &RealSystem, at: &[Disc]) -> bool {
    twice_derivatives(system, at).is_some_and(|rows| determinant_by_minors(&rows).is_not_zero())
}

/// An equation of degree 2 at most about a point that fulfils it.
fn quadric(equation: &Equation, at: &[Rational]) -> Quadric<Rational> {
    let size = at.len();
    // The value where some unknowns are moved by one.
    let moved = |by: &[(usize, i32)]| {
        let mut values = at.to_vec();
        for (k, step) in by {
            values[*k] += *step;
        }
        equation.evaluate(&values)
    };
    let ahead: Vec<Rational> = (0..size).map(|k| moved(&[(k, 1)])).collect();
    let behind: Vec<Rational> = (0..size).map(|k| moved(&[(k, -1)])).collect();
    let half = |x: Rational| x / 2;
    let linear = (0..size).map(|k| half(Rational::from(&ahead[k] - &behind[k]))).collect();
    let entry = |i: usize, j: usize| {
        if i == j {
            return half(Rational::from(&ahead[i] + &behind[i]));
        }
        half(moved(&[(i, 1), (j, 1)]) - &ahead[i] - &ahead[j])
    };
    Quadric { linear, form: (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_equation_about_a_point_is_the_same() {
        let (x, y) = (Equation::variable(0), Equation::variable(1));
        let number = |n: i32| Equation::from_integer(n);
        // x^2 + 3 x y - 2 y - 26 = 0 at (4, 1)
        let equation = x.mul(&x).add(&number(3).mul(&x).mul(&y)).sub(&number(2).mul(&y)).sub(&number(26));
        let at = [Rational::from(4), Rational::from(1)];
        let found = quadric(&equation, &at);
        let half = |n: i32| Rational::from((n, 2));
        assert_eq!(found.linear, [half(22), half(20)]);
        assert_eq!(found.form, [[half(2), half(3)], [half(3), half(0)]]);
    }
}
