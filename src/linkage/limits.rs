//! The number of limit positions of an input, complex ones included.
//!
//! In a limit position the linkage has a velocity at which the input stands still: the matrix M of the derivatives of the cycles by all
//! other variables is singular. The cycles and `det M = 0` are a system over the rationals, and its Gröbner basis counts its solutions.
//!
//! A simple solution is a limit position. The derivatives of the system have full rank there, hence so have those of the cycles: the
//! positions form a smooth curve on which det M has a simple zero, and with it the velocity of the input, which changes its sign.
//!
//! The curve is a complete intersection, on which the differential of the input is det M times a generator of the dualising module. The
//! multiplicity of a solution is therefore `2 delta` and the zeros of the velocity of the input on the branches through it, with delta = 0
//! where the curve is smooth and above 0 elsewhere. Where it is not smooth and the multiplicity is 2, two branches cross and the input
//! turns back on none of them: that is no limit position. With other multiple solutions nothing is counted.

use super::assembly::{Solution, held_and_free, parts_when_still};
use super::equations::{Closure, Equations};
use super::group_velocities::determinant_of;
use super::groups::Group;
use super::isotropic::Isotropic;
use super::real_system::{Form, circles, constant, cycle_forms, turned, unknowns, way};
use super::state::{Number, State};
use crate::algebra::groebner::{Basis, Equation, FiniteRing, MOST_VARIABLES, Solutions};
use crate::algebra::minors::{determinant_by_minors, maximal_minors};
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::{Gaussian, Given, Linkage, LinkageJoint};

/// Products of words that a basis may take: a second.
const EFFORT: u64 = 300_000_000;
/// Products of words that the basis of one group's limit positions may take: less than a second. That of a dyad of a
/// six-bar takes a part of it.
const GROUP_EFFORT: u64 = 40_000_000;
/// Most cycles: bases of six-bars take seconds at most, those of eight-bars more work than is allowed.
const MOST_CYCLES: usize = 2;

/// Returns the number of complex limit positions of a joint while other values are held: proved where it is known, and `None` where
/// the linkage has gears, takes too much work, moves with its input held, or has limit positions that coincide.
#[must_use]
pub fn complex_limits(linkage: &Linkage, held: &[Given], joint: usize) -> Option<usize> {
    if linkage.joints.iter().any(LinkageJoint::is_gear) {
        return None;
    }
    let (state, joints) = held_and_free(linkage, held).ok()?;
    let group = Group { clusters: (0..linkage.bodies.len()).collect(), joints, gears: Vec::new(), count: 0 };
    let closure: Closure = Closure::new(linkage, &group, &state)?;
    let input = if linkage.joints[joint].is_prismatic() {
        Input::Slide(closure.equations.slides.iter().position(|slide| slide.joint == joint)?)
    } else {
        let [a, b] = linkage.joints[joint].of.map(|body| closure.class_of(&state, body).map(|(class, _)| class));
        Input::Turn(a?, b?)
    };
    if closure.equations.loops() > MOST_CYCLES {
        return None;
    }
    let parts = parts_when_still(linkage, held, joint).unwrap_or_default();
    if parts.len() < 2 {
        return count(&closure.equations, input);
    }
    // Where limit positions coincide, the whole may still be decided.
    match by_groups(linkage, &parts, &state, &closure) {
        ByGroups::Number(number) => Some(number),
        ByGroups::Open => count(&closure.equations, input),
        ByGroups::TooMuch => None,
    }
}

/// What groups say of the number of limit positions.
enum ByGroups {
    /// This is the number.
    Number(usize),
    /// Limit positions coincide, or groups have slides.
    Open,
    /// A basis takes too much work.
    TooMuch,
}

/// The number by groups.
///
/// With the input at rest and velocities measured group by group, the matrix M is block-triangular, as a group stands on earlier ones
/// only: det M is the product of the determinants of the groups, on all positions. A position where one of them alone is zero, and
/// simply, is a simple solution of the whole.
fn by_groups(linkage: &Linkage, parts: &[Solution], state: &State, closure: &Closure) -> ByGroups {
    let Some(exact) = closure.equations.exact() else { return ByGroups::TooMuch };
    let unknowns = unknowns(&exact);
    if unknowns > MOST_VARIABLES {
        return ByGroups::TooMuch;
    }
    let determinants: Option<Vec<Equation>> =
        parts.iter().map(|part| determinant_of(linkage, part, state, closure)).collect();
    // Those of groups with slides are not written down.
    let Some(determinants) = determinants else { return ByGroups::Open };
    let mut system: Vec<Equation> = cycle_forms(&exact).into_iter().flat_map(|sum| [sum.re, sum.im]).collect();
    system.extend(circles(exact.classes));
    system.retain(|equation| !equation.is_zero());
    let basis = |zero: &[&Equation]| {
        let all: Vec<Equation> = system.iter().chain(zero.iter().copied()).cloned().collect();
        <Basis>::of(unknowns, &all, GROUP_EFFORT)
    };
    let mut total = 0;
    for (k, own) in determinants.iter().enumerate() {
        let Some(found) = basis(&[own]) else { return ByGroups::TooMuch };
        match found.dimension() {
            None => continue,
            Some(0) => {}
            Some(_) => return ByGroups::Open,
        }
        let Some(ring) = FiniteRing::of(&found) else { return ByGroups::TooMuch };
        if ring.distinct() != ring.dimension() {
            return ByGroups::Open;
        }
        for other in &determinants[..k] {
            let Some(both) = basis(&[own, other]) else { return ByGroups::TooMuch };
            if both.dimension().is_some() {
                return ByGroups::Open;
            }
        }
        total += ring.dimension();
    }
    ByGroups::Number(total)
}

/// The variable that stands still.
#[derive(Clone, Copy)]
enum Input {
    /// The angle between two classes.
    Turn(usize, usize),
    /// A displacement.
    Slide(usize),
}

fn count(equations: &Equations<Number>, input: Input) -> Option<usize> {
    let exact = equations.exact()?;
    let unknowns = unknowns(&exact);
    if unknowns > MOST_VARIABLES {
        return None;
    }
    let columns = velocities(&exact);
    let still = columns_of(&columns, exact.classes, input)?;
    if still.len() != 2 * exact.loops() {
        return None;
    }
    let mut system: Vec<Equation> = cycle_forms(&exact).into_iter().flat_map(|sum| [sum.re, sum.im]).collect();
    system.extend(circles(exact.classes));
    system.push(determinant_by_minors(&transposed(&still)));
    system.retain(|equation| !equation.is_zero());
    let basis = Basis::of(unknowns, &system, EFFORT)?;
    match basis.dimension() {
        None => return Some(0),
        Some(0) => {}
        Some(_) => return None,
    }
    let ring = FiniteRing::of(&basis)?;
    if ring.distinct() == ring.dimension() {
        return Some(ring.dimension());
    }
    let parts = Solutions::of(ring, unknowns)?.parts;
    let of = |is_simple: bool| {
        let parts = parts.iter().filter(|part| (part.multiplicity == 1) == is_simple);
        parts.filter_map(|part| part.polynomial.degree()).sum::<usize>()
    };
    // Are all multiple solutions double, and places where the curve is not smooth, at which all columns have no full rank?
    if parts.iter().any(|part| part.multiplicity > 2) {
        return None;
    }
    system.extend(maximal_minors(&transposed(&columns), columns.len()));
    let crossings = Basis::of(unknowns, &system, EFFORT)?;
    let crossings = if crossings.dimension().is_none() { 0 } else { FiniteRing::of(&crossings)?.distinct() };
    (crossings == of(false)).then(|| of(true))
}

/// The derivatives of both parts of every cycle: by the angles of all classes but the first, then by the slides.
fn velocities(equations: &Equations<Isotropic<Gaussian>>) -> Vec<Vec<Equation>> {
    let i = Form { re: Equation::zero(), im: Equation::one() };
    let parts = |forms: Vec<Form>| forms.into_iter().flat_map(|form| [form.re, form.im]).collect();
    let turn = |class: usize| {
        let of_cycle = |(k, cycle): (usize, &Vec<Isotropic<Gaussian>>)| {
            let own = equations.slides.iter().enumerate().filter(|(_, slide)| slide.class == class);
            let slides = own.map(|(q, slide)| constant(&slide.coefficients[k].z).mul(&way(equations.classes, q)));
            let sum = slides.fold(constant(&cycle[class].z), |sum, term| sum.add(&term));
            i.mul(&turned(class, 1)).mul(&sum)
        };
        parts(equations.cycles.iter().enumerate().map(of_cycle).collect())
    };
    let slides = equations.slides.iter().map(|slide| {
        let of_cycle = |c: &Isotropic<Gaussian>| constant(&c.z).mul(&turned(slide.class, 1));
        parts(slide.coefficients.iter().map(of_cycle).collect())
    });
    (1..equations.classes).map(turn).chain(slides).collect()
}

/// The columns of all variables while the input stands still.
fn columns_of(columns: &[Vec<Equation>], classes: usize, input: Input) -> Option<Vec<Vec<Equation>>> {
    let mut still = columns.to_vec();
    let gone = match input {
        Input::Slide(slide) => classes - 1 + slide,
        Input::Turn(a, b) if a == b => return None,
        Input::Turn(0, class) | Input::Turn(class, 0) => class - 1,
        Input::Turn(a, b) => {
            // Both classes turn together.
            still[a - 1] = columns[a - 1].iter().zip(&columns[b - 1]).map(|(x, y)| x.add(y)).collect();
            b - 1
        }
    };
    still.remove(gone);
    Some(still)
}

fn transposed(columns: &[Vec<Equation>]) -> Vec<Vec<Equation>> {
    let rows = columns.first().map_or(0, Vec::len);
    (0..rows).map(|k| columns.iter().map(|column| column[k].clone()).collect()).collect()
}
