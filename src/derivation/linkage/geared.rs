//! Closure polynomials of linkages with gears, in the coordinate ring of all their equations.
//!
//! Cycles and gears are equations over the rationals in as few rotations as the gears leave ([`GearedEquations`]). Their solutions are
//! the assemblies, so that the characteristic polynomial of the tangent of half an angle has one root for every assembly.

use super::closure::{GroupPolynomial, LinkageDerivation, Part, Symbol};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::sort;
use crate::derivation::by_ring::EFFORT;
use crate::derivation::coordinate_ring::{CoordinateRing, Function, Solutions};
use crate::derivation::equation::primitive;
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Gaussian, Given, Linkage, LinkageJoint, Pair};
use crate::linkage::assembly::{glued, groups_of};
use crate::linkage::gears::{GearedEquations, teeth};
use crate::linkage::isotropic::Isotropic;
use rug::Rational;

/// A rotation by its cosine and its sine.
type Turn = [Polynomial<Rational>; 2];

fn unsupported(what: &str) -> Error {
    Error::Unsupported(format!("the closure polynomial of this linkage with gears is not derived: {what}"))
}

/// Derives the closure polynomials of the angles of all bodies of a linkage with gears: every one has all assemblies for its roots.
///
/// # Errors
/// As [`groups_of`], for numbers that are not rational, and where the Gröbner basis takes too much work.
pub(super) fn derive_geared(linkage: &Linkage, given: &[Given]) -> Result<LinkageDerivation> {
    let groups = groups_of(linkage, given)?.list;
    let joints = glued(linkage, given)?.1.into_iter().map(|(joint, _)| joint).collect();
    let rational = || unsupported("its numbers are not rational, or its unknowns are too many");
    let mut part = Part::new(linkage, given, joints).ok_or_else(rational)?;
    part.group.gears = (0..linkage.joints.len()).filter(|joint| linkage.joints[*joint].is_gear()).collect();
    let equations = GearedEquations::of(linkage, &part.closure, &part.group, &part.state).ok_or_else(rational)?;
    let ring = CoordinateRing::of(equations.unknowns, &equations.list, EFFORT);
    let ring = ring
        .ok_or_else(|| unsupported("its Gröbner basis takes more work than is allowed, or has too many solutions"))?;
    let mut warnings = Vec::new();
    let mut polynomials = Vec::new();
    let mut assemblies = 0;
    match ring {
        Solutions::None => warnings.push("the equations of cycles and gears contradict one another".to_owned()),
        Solutions::Set(dimension) => warnings.push(format!(
            "the assemblies form a set of dimension {dimension}, complex ones counted, and have no closure polynomial"
        )),
        Solutions::Finite(ring) => {
            assemblies = ring.dimension();
            polynomials = of_bodies(linkage, &part, &equations, &ring, groups.len().saturating_sub(1));
        }
    }
    let (variables, equations) = part.equations(linkage.ground).unwrap_or_default();
    let mut all = equations;
    all.extend(meshes(linkage, &part, &variables).into_iter().flatten());
    Ok(LinkageDerivation {
        relations: vec![None; polynomials.len()],
        polynomials,
        input_output: None,
        // The polynomial is that of all groups at once.
        groups: vec![(bodies_of(linkage, &part), assemblies)],
        equations: all,
        gears: part.group.gears,
        variables,
        is_bounded: false,
        warnings,
    })
}

/// Returns the bodies of every cluster that inputs make.
fn bodies_of(linkage: &Linkage, part: &Part) -> Vec<Vec<usize>> {
    let of = |root: usize| (0..linkage.bodies.len()).filter(|body| part.state.bodies[*body].0 == root).collect();
    let roots = (0..linkage.bodies.len()).filter(|body| part.state.bodies[*body].0 == *body);
    roots.map(of).collect()
}

/// Returns the polynomials of all bodies that turn against the ground, those first that tell most assemblies apart.
fn of_bodies(
    linkage: &Linkage,
    part: &Part,
    equations: &GearedEquations,
    ring: &CoordinateRing,
    group: usize,
) -> Vec<GroupPolynomial> {
    let against = linkage.ground;
    let Some((rest, still)) = part.class_of(against) else { return Vec::new() };
    let mut list: Vec<(usize, GroupPolynomial)> = Vec::new();
    let mut known = vec![rest];
    for body in 0..linkage.bodies.len() {
        let Some((class, own)) = part.class_of(body).filter(|(class, _)| !known.contains(class)) else { continue };
        known.push(class);
        let [cos, sin] = equations.angle((class, &own.z), (rest, &still.z));
        let function = Function::HalfTangent { cos, sin, square: Rational::from(1) };
        let Some((coefficients, at_pi)) = ring.values(&function) else { continue };
        let values = coefficients.square_free_part().degree().unwrap_or(0) + usize::from(at_pi > 0);
        let assemblies = Some(ring.dimension());
        let rows = ring.dimension();
        list.push((values, GroupPolynomial { group, body, against, coefficients, at_pi, assemblies, rows }));
    }
    sort::by_key(&mut list, |(values, _)| std::cmp::Reverse(*values));
    list.into_iter().map(|(_, polynomial)| polynomial).collect()
}

fn times(a: &Turn, b: &Turn) -> Turn {
    [a[0].mul(&b[0]).sub(&a[1].mul(&b[1])), a[0].mul(&b[1]).add(&a[1].mul(&b[0]))]
}

fn constant(z: &Gaussian) -> Turn {
    [&z.re, &z.im].map(|part| Polynomial::constant(part.clone()))
}

/// Returns the equations of the pairs of gears in these variables, two for each; `None` where a body has none of them.
fn meshes(linkage: &Linkage, part: &Part, variables: &[Symbol]) -> Option<Vec<Polynomial<Rational>>> {
    let (rest, still) = part.class_of(linkage.ground)?;
    // The rotation of a body: that of the first body of its class, times a constant.
    let turn = |body: usize| -> Option<Turn> {
        let (class, own) = part.class_of(body)?;
        if class == rest {
            return Some(constant(&own.mul(&still.mirrored()).z));
        }
        let first = (0..linkage.bodies.len()).find(|other| part.class_of(*other).is_some_and(|(of, _)| of == class))?;
        let place = variables.iter().position(|symbol| *symbol == Symbol::Cosine(first))?;
        let against: Isotropic<Gaussian> = own.mul(&part.class_of(first)?.1.mirrored());
        Some(times(&[place, place + 1].map(Polynomial::variable), &constant(&against.z)))
    };
    let mut list = Vec::new();
    for joint in linkage.joints.iter().filter(|joint| joint.is_gear()) {
        let LinkageJoint { of: [first, second], pair: Pair::Gear { carrier, ratio, phase }, .. } = joint else {
            continue;
        };
        let (p, q) = teeth(ratio).ok()?;
        let mut sides = [
            constant(&Gaussian { re: Rational::from(1), im: Rational::new() }),
            constant(&Gaussian { re: Rational::from(1), im: Rational::new() }),
        ];
        for _ in 0..q {
            sides[1] = times(&sides[1], &constant(phase));
        }
        // The second to the power q, the carrier to p - q and the first to -p: negative powers stand on the other side.
        for (body, exponent) in [(*second, q), (*carrier, p - q), (*first, -p)] {
            let own = turn(body)?;
            let side = &mut sides[usize::from(exponent < 0)];
            for _ in 0..exponent.unsigned_abs() {
                *side = times(side, &own);
            }
        }
        let [left, right] = &sides;
        list.extend([0, 1].map(|k| primitive(&left[k].sub(&right[k]))));
    }
    Some(list)
}
