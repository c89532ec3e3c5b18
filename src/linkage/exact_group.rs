//! Groups of several cycles with rational data, decided by a Gröbner basis over the rationals.
//!
//! Where assemblies coincide, no root of a closure polynomial leads to a regular one, and where a group moves there is no closure
//! polynomial. The cycles are then solved as far as they are linear; what is left, the circle of every rotation in the unknowns that
//! remain, has a Gröbner basis. It gives the dimension of the set of all assemblies, and of a finite set all members with their exact
//! multiplicities. The theorems are in `docs/exact.md`.

use super::equations::Equations;
use super::isotropic::{Isotropic, Value};
use super::points::Points;
use super::quadratic::Root;
use super::real_motion::{Moving, moving};
use super::real_system::{Form, RealSystem};
use super::state::{Number, number, real};
use crate::algebra::disc::Disc;
use crate::algebra::groebner::{Basis, Equation};
use crate::algebra::minors::determinant_by_minors;
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::Gaussian;
use rug::{Float, Rational};

/// Products of words that the basis of a group may take: a second. Structures of seven links take a fraction of it, those of nine
/// up to a hundred times as many.
pub(super) const EFFORT: u64 = 40_000_000;

/// What a basis says of the assemblies of a group.
pub(super) enum Decided {
    /// These are all, each with its exact multiplicity and whether it is real.
    Finite(Vec<(Root, bool)>),
    /// They are these, at which bodies turn freely about their joints, and whether each is real.
    Spinning(Vec<(Root, bool)>, Vec<usize>),
    /// They are infinitely many.
    Moving(Box<Moving>),
}

/// Decides a group; `None` for data that are not rational or those of a complex branch, and where the basis takes too much work.
pub(super) fn decided(equations: &Equations<Number>) -> Option<Decided> {
    let system = RealSystem::of(&equations.exact()?)?;
    let basis = Basis::of(system.unknowns, &system.equations, EFFORT)?;
    match basis.dimension() {
        None => Some(Decided::Finite(Vec::new())),
        Some(0) if system.spinning.is_empty() => Some(Decided::Finite(solutions(&system, &basis)?)),
        Some(0) => Some(Decided::Spinning(solutions(&system, &basis)?, system.spinning)),
        Some(dimension) => Some(Decided::Moving(Box::new(moved(&system, dimension)))),
    }
}

/// Describes infinitely many solutions of this dimension, and all regular ones beside them.
pub(super) fn moved(system: &RealSystem, dimension: usize) -> Moving {
    Moving { regular: regular(system), ..moving(system, dimension) }
}

/// Unknowns of a group whose regular assemblies are all looked for: the determinant of 6 rows has the degree 6, with up to 924 terms.
const MOST_IN_DETERMINANT: usize = 6;

/// All regular assemblies of a group, which are isolated, and whether each is real; `None` where that takes too much work. They are finitely
/// many: the determinant of the derivatives has an inverse there.
fn regular(system: &RealSystem) -> Option<Vec<(Root, bool)>> {
    let unknowns = system.unknowns;
    if unknowns > MOST_IN_DETERMINANT || !system.spinning.is_empty() {
        return None;
    }
    let at: Vec<Equation> = (0..unknowns).map(Equation::variable).collect();
    let determinant = determinant_by_minors(&twice_derivatives(system, &at)?);
    let inverse = Equation::variable(unknowns);
    let mut system = RealSystem { unknowns: unknowns + 1, ..system.clone() };
    system.equations.push(inverse.mul(&determinant).sub(&Equation::one()));
    let basis = Basis::of(system.unknowns, &system.equations, EFFORT)?;
    match basis.dimension() {
        None => Some(Vec::new()),
        Some(0) => solutions(&system, &basis),
        Some(_) => None,
    }
}

/// Twice the derivatives of as many equations as unknowns, of degree 2 at most, at a point.
pub(super) fn twice_derivatives<R: Ring>(system: &RealSystem, at: &[R]) -> Option<Vec<Vec<R>>> {
    if system.equations.len() != system.unknowns || system.equations.iter().any(|equation| equation.degree() > 2) {
        return None;
    }
    // The difference of two values, one to either side.
    let derivative = |equation: &Equation, k: usize| {
        let value = |step: &R| {
            let mut moved = at.to_vec();
            moved[k] = moved[k].add(step);
            equation.evaluate(&moved)
        };
        value(&R::one()).sub(&value(&R::one().neg()))
    };
    let row = |equation: &Equation| (0..system.unknowns).map(|k| derivative(equation, k)).collect();
    Some(system.equations.iter().map(row).collect())
}

/// All members of a finite set of assemblies, and whether each is real; `None` where they were not told apart.
pub(super) fn solutions(system: &RealSystem, basis: &Basis) -> Option<Vec<(Root, bool)>> {
    let points = Points::of(system.unknowns, basis)?;
    let mut list = Vec::new();
    for (root, multiplicity) in &points.list {
        let exact = points.rational(root).map(|values| exactly(system, &values));
        let found = exact.or_else(|| Some(within(system, &points.narrow(root)?)));
        let (turns, shifts) = found?;
        list.push((Root { turns, shifts, multiplicity: *multiplicity }, root.is_real()));
    }
    Some(list)
}

/// Rotations of the classes and slides from the values of the unknowns.
pub(super) type Values = (Vec<Number>, Vec<Number>);

/// Rotations and slides at rational values of the unknowns.
pub(super) fn exactly(system: &RealSystem, values: &[Rational]) -> Values {
    let at = |equation: &Equation| equation.evaluate(values);
    let turns = system.turns.iter().zip(&system.squares).map(|(turn, square)| {
        let turn: Number = number(&Gaussian { re: at(&turn.re), im: at(&turn.im) });
        over(turn, square)
    });
    (turns.collect(), system.shifts.iter().map(|shift| real(&at(shift))).collect())
}

/// A rotation from one times the length of a bar that stands by its square.
fn over(turn: Number, square: &Rational) -> Number {
    if *square == 1 {
        return turn;
    }
    let inverse = Value::from_rational(&Rational::from(square.recip_ref())).unwrap_or_else(Value::one);
    Isotropic { z: turn.z.mul(&inverse), w: turn.w }
}

/// Rotations and slides at values of the unknowns of which discs are known.
pub(super) fn within(system: &RealSystem, values: &[Disc]) -> Values {
    let at = |equation: &Equation| equation.evaluate(values);
    let i = Disc::point(Float::with_val(64, 0), Float::with_val(64, 1));
    let turn = |turn: &Form| {
        let (x, y) = (at(&turn.re), at(&turn.im).mul(&i));
        Isotropic { z: Value::within(x.add(&y)), w: Value::within(x.sub(&y)) }
    };
    let slide = |at: Disc| Isotropic { z: Value::within(at.clone()), w: Value::within(at) };
    let turns = system.turns.iter().zip(&system.squares).map(|(one, square)| over(turn(one), square));
    (turns.collect(), system.shifts.iter().map(|shift| slide(at(shift))).collect())
}
