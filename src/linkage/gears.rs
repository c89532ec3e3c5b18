//! Groups with pairs of gears.
//!
//! The angle of the second gear is `ratio = p/q` times that of the first, both against the carrier, and a phase. With rotations
//! `a`, `b`, `c` of the first, the second and the carrier this is `b^q c^(p-q) = phase^q a^p`, an equation between monomials: as p
//! and q are coprime, its solutions are exactly the positions that the gears reach when they turn from the phase. Together with the
//! cycles of the group it is a system over the rationals in the cosines x and sines y of all classes, `x^2 + y^2 = 1`, and in the
//! slides: its Gröbner basis counts the assemblies.

use super::equations::{Closure, Equations};
use super::exact_group::solutions;
use super::groups::Group;
use super::isotropic::{Isotropic, Value};
use super::points::EFFORT;
use super::quadratic::{Root, Solved};
use super::real_system::{Form, RealSystem, circles, constant, cycle_forms, turned, unknowns, way};
use super::state::{Number, State, number};
use crate::algebra::disc::Disc;
use crate::algebra::groebner::{Basis, MOST_VARIABLES};
use crate::algebra::ring::Ring;
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Gaussian, Linkage, Pair};
use rug::Rational;

/// Largest sum of the numbers of teeth in lowest terms: monomials of a basis have degrees up to 127.
pub const MOST_TEETH: i32 = 40;

/// A pair of gears between classes: `sum of exponents[k] times the angle of class k` is the angle of `factor`.
#[derive(Clone, Debug)]
struct Mesh {
    exponents: Vec<i32>,
    factor: Number,
}

/// Returns the numerator and the denominator of a ratio of gears.
///
/// # Errors
/// For numbers above those that are solved.
pub fn teeth(ratio: &Rational) -> Result<(i32, i32)> {
    let both = ratio.numer().to_i32().zip(ratio.denom().to_i32());
    both.filter(|(p, q)| p.saturating_abs().saturating_add(*q) <= MOST_TEETH).ok_or_else(|| {
        Error::Unsupported(format!(
            "gears of the ratio {ratio}: numerator and denominator with a sum above {MOST_TEETH} are not solved yet"
        ))
    })
}

fn power(base: &Number, exponent: i32) -> Number {
    let base = if exponent < 0 { base.mirrored() } else { base.clone() };
    (0..exponent.unsigned_abs()).fold(Number::one(), |product, _| product.mul(&base))
}

/// The pair of gears as an equation between the rotations of the classes.
fn mesh(linkage: &Linkage, closure: &Closure, state: &State, gear: usize) -> Option<Mesh> {
    let joint = &linkage.joints[gear];
    let Pair::Gear { carrier, ratio, phase } = &joint.pair else { return None };
    let (p, q) = teeth(ratio).ok()?;
    let mut exponents = vec![0; closure.equations.classes];
    let mut factor = power(&number(phase), q);
    for (body, exponent) in [(joint.of[1], q), (*carrier, p - q), (joint.of[0], -p)] {
        let (class, turn) = closure.class_of(state, body)?;
        exponents[class] += exponent;
        factor = factor.mul(&power(&turn, -exponent));
    }
    // The first class is at rest.
    exponents[0] = 0;
    Some(Mesh { exponents, factor })
}

/// Solves a group with gears.
#[must_use]
pub fn geared(linkage: &Linkage, closure: &Closure, group: &Group, state: &State) -> Solved {
    let equations = &closure.equations;
    let meshes: Option<Vec<Mesh>> = group.gears.iter().map(|gear| mesh(linkage, closure, state, *gear)).collect();
    let Some(meshes) = meshes else { return Solved::Undecided("gears whose bodies are not of one group".to_owned()) };
    let only = if is_wheel(equations, group) { meshes.first() } else { None };
    if let Some(turn) = only.and_then(wheel) {
        return Solved::Roots(vec![Root { turns: vec![Number::one(), turn], shifts: Vec::new(), multiplicity: 1 }]);
    }
    let exact = |n: &Number| n.z.exact.as_ref()?.to_gaussian();
    let factors: Option<Vec<Gaussian>> = meshes.iter().map(|mesh| exact(&mesh.factor)).collect();
    let (Some(cycles), Some(factors)) = (equations.exact(), factors) else {
        let undecided =
            || Solved::Undecided("a group with gears stands on an assembly whose numbers are not rational".to_owned());
        return only.and_then(wheel_by_roots).map_or_else(undecided, Solved::Roots);
    };
    let unknowns = unknowns(equations);
    if unknowns > MOST_VARIABLES {
        return Solved::Undecided(format!("a group with gears has more than {MOST_VARIABLES} unknowns"));
    }
    let system = system(&cycles, &meshes, &factors);
    let Some(basis) = Basis::of(unknowns, &system.equations, EFFORT) else {
        return Solved::Undecided("the Gröbner basis of a group with gears takes more work than is allowed".to_owned());
    };
    match basis.dimension() {
        None => Solved::Roots(Vec::new()),
        Some(0) => match solutions(&system, &basis) {
            Some(list) => Solved::Roots(list.into_iter().map(|(root, _)| root).collect()),
            None => Solved::Undecided("the assemblies of a group with gears were not told apart".to_owned()),
        },
        Some(dimension) => Solved::Undecided(format!(
            "the assemblies of a group with gears form a set of dimension {dimension}, complex ones counted"
        )),
    }
}

/// Whether a group is a wheel that turns about a joint of the rest.
#[must_use]
pub fn is_wheel<N>(equations: &Equations<N>, group: &Group) -> bool {
    group.gears.len() == 1 && equations.classes == 2 && equations.loops() == 0 && equations.slides.is_empty()
}

/// The rotations of a wheel, all n of them where its n-th power is known; `None` where that power is not kept from 0 by its disc.
fn wheel_by_roots(mesh: &Mesh) -> Option<Vec<Root>> {
    let exponent = mesh.exponents[1];
    let known = if exponent < 0 { mesh.factor.mirrored() } else { mesh.factor.clone() };
    let root = |z: Disc| {
        let turn = Isotropic { w: Value::within(z.inverse()?), z: Value::within(z) };
        Some(Root { turns: vec![Number::one(), turn], shifts: Vec::new(), multiplicity: 1 })
    };
    known.z.disc.roots(exponent.unsigned_abs())?.into_iter().map(root).collect()
}

/// The rotation of a wheel that turns once for every turn of what drives it; `None` of others.
fn wheel(mesh: &Mesh) -> Option<Number> {
    match mesh.exponents[1] {
        1 => Some(mesh.factor.clone()),
        -1 => Some(mesh.factor.mirrored()),
        _ => None,
    }
}

/// The polynomials that vanish: both parts of every cycle and every pair of gears, and the circles of the classes.
fn system(cycles: &Equations<Isotropic<Gaussian>>, meshes: &[Mesh], factors: &[Gaussian]) -> RealSystem {
    let mut list: Vec<_> = cycle_forms(cycles).into_iter().flat_map(|sum| [sum.re, sum.im]).collect();
    for (mesh, factor) in meshes.iter().zip(factors) {
        let side = |sign: i32| {
            let terms = mesh.exponents.iter().enumerate().filter(|(_, exponent)| **exponent * sign > 0);
            terms.fold(Form::one(), |product, (class, exponent)| product.mul(&turned(class, exponent.abs())))
        };
        let difference = side(1).sub(&constant(factor).mul(&side(-1)));
        list.extend([difference.re, difference.im]);
    }
    list.extend(circles(cycles.classes));
    list.retain(|equation| !equation.is_zero());
    let ways = (0..cycles.slides.len()).map(|slide| way(cycles.classes, slide).re);
    RealSystem {
        unknowns: unknowns(cycles),
        turns: (0..cycles.classes).map(|class| turned(class, 1)).collect(),
        shifts: ways.collect(),
        equations: list,
        spinning: Vec::new(),
    }
}
