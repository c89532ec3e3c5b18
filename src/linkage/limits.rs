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

use super::assembly::held_and_free;
use super::equations::{Closure, Equations};
use super::groups::Group;
use super::isotropic::Isotropic;
use super::real_system::{Form, circles, constant, cycle_forms, turned, unknowns, way};
use super::state::Number;
use crate::algebra::groebner::{Basis, Equation, FiniteRing, MOST_VARIABLES, Solutions};
use crate::algebra::minors::{determinant_by_minors, maximal_minors};
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::{Gaussian, Given, Linkage, LinkageJoint};

/// Products of words that a basis may take: a second.
const EFFORT: u64 = 300_000_000;
/// Most cycles: the determinant of twice as many rows, expanded by minors, doubles with every one of them.
const MOST_CYCLES: usize = 4;

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
    count(&closure.equations, input)
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
    if unknowns > MOST_VARIABLES || exact.loops() > MOST_CYCLES {
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
