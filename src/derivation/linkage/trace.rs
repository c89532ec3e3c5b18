//! The curve of a point of a body, as a polynomial in its coordinates.
//!
//! The position of the point adds one cycle, with all rotations unknown. The matrix is linear in the coordinates x and y, and
//! its determinant vanishes at every position of the point. \[Wampler2001\]

use super::closure::glued_state;
use super::geared_curve::geared_curve;
use super::without_circles;
use crate::algebra::int::Int;
use crate::algebra::modular::determinant;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};
use crate::derivation::interpolation::Watch;
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Gaussian, Given, Linkage, LinkageJoint};
use crate::linkage::assembly::glued;
use crate::linkage::equations::{Closure, Equations};
use crate::linkage::groups::{Group, Merged, groups};
use crate::linkage::parts::{group_of, least_mover};
use crate::linkage::pencil::{Parameter, Pencil};
use crate::linkage::real_form::RealForm;
use crate::linkage::state::{Number, State, number, real};
use rug::Rational;

/// Number of rows of a matrix beyond which its determinant in two variables is not computed.
const LARGE: usize = 20;

/// The curve of a point.
#[derive(Clone, Debug)]
pub struct Curve {
    /// The bodies whose joints determine the curve, including the ground.
    pub bodies: Vec<usize>,
    /// A polynomial in x and y, metres, that vanishes along every curve on which the point moves: primitive and without
    /// multiple factors.
    pub polynomial: Polynomial<Int>,
    /// Points of the ground whose isotropic lines were divided out of the determinant: the squared distance from such a
    /// point, and its multiplicity. There a rotation is zero or infinite.
    pub removed: Vec<(Polynomial<Int>, usize)>,
    /// Number of rows of its matrix, or with gears of that of the multiplication in the coordinate ring of a section with a line.
    pub rows: usize,
    /// Degree and multiplicity of the square-free factors of the determinant.
    pub factors: Vec<(u64, usize)>,
    /// With gears the number of lines, drawn at random, with which it has the sections of the linkage: it is interpolated and has no proof.
    /// `None` where it is a determinant.
    pub compared: Option<usize>,
}

impl Curve {
    /// Returns the degree in both coordinates.
    #[must_use]
    pub fn degree(&self) -> u64 {
        self.polynomial.total_degree().unwrap_or(0)
    }
}

/// Returns the curve of a point of a body in coordinates of the ground. In a linkage of several degrees of freedom all
/// given values but the first are held. With gears it is interpolated, under the eyes of `watch`.
///
/// # Errors
/// For a point that does not move on a curve, and for curves that are not implemented.
pub fn trace(linkage: &Linkage, given: &[Given], body: usize, point: &Gaussian, watch: &Watch<'_>) -> Result<Curve> {
    if linkage.joints.iter().any(LinkageJoint::is_gear) {
        return geared_curve(linkage, given, &[(body, point.clone(), Rational::from(1))], watch);
    }
    let group = mover(linkage, given, body)?;
    let held = held(linkage, given)?;
    let (mut merged, _) = glued(linkage, held)?;
    curve(linkage, held, &mut merged, &group, &linkage.bodies[body].name, &[(body, point.clone(), Rational::from(1))])
}

/// Returns the least part of one freedom that moves a body against the ground.
pub(super) fn mover(linkage: &Linkage, given: &[Given], body: usize) -> Result<Group> {
    let (mut merged, joints) = glued(linkage, held(linkage, given)?)?;
    let group = least_mover(linkage, &joints, &mut merged, linkage.ground, body);
    let what = "is made by no part of one freedom among at most 16 bodies";
    group.ok_or_else(|| unsupported(&linkage.bodies[body].name, what))
}

/// Returns the curve of the centre of mass of bodies, each with its own centre and its mass, as [`trace`].
///
/// # Errors
/// As [`trace`], and if the sum of the masses is 0.
pub fn trace_mass(
    linkage: &Linkage,
    given: &[Given],
    masses: &[(usize, Gaussian, Rational)],
    watch: &Watch<'_>,
) -> Result<Curve> {
    let total: Rational = masses.iter().map(|(_, _, mass)| mass).sum();
    if total == 0 {
        return Err(Error::Invalid("found no mass, expected [mechanism.mass] with the mass of a body".to_owned()));
    }
    let shares: Vec<(usize, Gaussian, Rational)> =
        masses.iter().map(|(body, centre, mass)| (*body, centre.clone(), Rational::from(mass / &total))).collect();
    if linkage.joints.iter().any(LinkageJoint::is_gear) {
        return geared_curve(linkage, given, &shares, watch);
    }
    let held = held(linkage, given)?;
    let (mut merged, joints) = glued(linkage, held)?;
    let group = group_of(linkage, joints.iter().map(|(joint, _)| *joint).collect(), &mut merged);
    curve(linkage, held, &mut merged, &group, "the centre of mass", &shares)
}

fn unsupported(name: &str, what: &str) -> Error {
    Error::Unsupported(format!("the curve of {name} {what}"))
}

/// Returns the given values that are held while the first one moves.
pub(super) fn held<'g>(linkage: &Linkage, given: &'g [Given]) -> Result<&'g [Given]> {
    let links: Vec<(usize, [usize; 2])> = linkage.joints.iter().enumerate().map(|(k, joint)| (k, joint.of)).collect();
    if let Some(gear) = linkage.joints.iter().find(|joint| joint.is_gear()) {
        return Err(Error::Unsupported(format!(
            "the curve of a point of a linkage with gears, such as {}, is derived without symbols only",
            gear.name
        )));
    }
    match groups(linkage.bodies.len(), &links, Merged::new(linkage.bodies.len())).freedoms {
        0 => Err(Error::Invalid("found a rigid linkage, expected one whose points move".to_owned())),
        1 => Ok(&[]),
        more if given.len() == more => Ok(&given[1..]),
        more => {
            let message = format!(
                "found {} values given of a linkage of {more} freedoms, expected {more}: the first moves, the others are held",
                given.len()
            );
            Err(Error::Invalid(message))
        }
    }
}

/// Returns the cycles of a group and one more, for a weighted mean of points of bodies.
pub(super) fn mean(
    closure: &Closure,
    state: &State,
    base: usize,
    parts: &[(usize, Gaussian, Rational)],
) -> Option<Equations<Number>> {
    let mut sum: Option<Equations<Number>> = None;
    for (body, point, share) in parts {
        let mut own = closure.traced(state, base, *body, &number(point))?;
        let share = real(share);
        let scaled = |n: &mut Number| *n = n.mul(&share);
        own.cycles.last_mut()?.iter_mut().for_each(scaled);
        own.slides.iter_mut().filter_map(|slide| slide.coefficients.last_mut()).for_each(scaled);
        sum = Some(match sum {
            None => own,
            Some(mut sum) => {
                for (to, from) in sum.cycles.last_mut()?.iter_mut().zip(own.cycles.last()?) {
                    *to = to.add(from);
                }
                for (to, from) in sum.slides.iter_mut().zip(&own.slides) {
                    let (to, from) = (to.coefficients.last_mut()?, from.coefficients.last()?);
                    *to = to.add(from);
                }
                sum
            }
        });
    }
    sum
}

/// Returns the curve of a mean of points that a group of one degree of freedom moves.
fn curve(
    linkage: &Linkage,
    held: &[Given],
    merged: &mut Merged,
    group: &Group,
    name: &str,
    parts: &[(usize, Gaussian, Rational)],
) -> Result<Curve> {
    let unsupported = |what: &str| unsupported(name, what);
    let state = glued_state(linkage, held).ok_or_else(|| unsupported("depends on a value that is not there"))?;
    let closure = Closure::new(linkage, group, &state).ok_or_else(|| unsupported("is one of gears"))?;
    let exact = mean(&closure, &state, linkage.ground, parts).and_then(|equations| equations.exact());
    let rest = closure.class_of(&state, linkage.ground).map(|(class, _)| class);
    let (Some(exact), Some(rest)) = (exact, rest) else {
        return Err(unsupported("has data that are not rational"));
    };
    // Whether slides that turn leave factors of their own has not been looked into.
    let pencil = Pencil::new(&exact, rest, &[Parameter::Point]).filter(|pencil| pencil.plain == pencil.classes.len());
    let pencil = pencil.ok_or_else(|| unsupported("depends on slides that are fixed in bodies that turn"))?;
    let rows = pencil.sets.len();
    if rows > LARGE {
        return Err(unsupported(&format!("is the determinant of a matrix of {rows} rows, at most {LARGE} are taken")));
    }
    let terms = RealForm::new(&pencil).and_then(|form| determinant(&form.matrix, 2));
    let polynomial = terms.as_ref().and_then(|terms| without_circles(terms, 2, &[]));
    let polynomial =
        polynomial.ok_or_else(|| unsupported("is not the zero set of this determinant, which vanishes"))?;
    let (polynomial, removed) = without_isotropic_lines(polynomial, linkage, &group.joints);
    let factors = factors_of(&polynomial);
    let bodies = (0..linkage.bodies.len()).filter(|body| group.clusters.contains(&merged.root(*body))).collect();
    Ok(Curve { bodies, polynomial: polynomial.square_free_part(), removed, rows, factors, compared: None })
}

/// Returns degree and multiplicity of the square-free factors of a polynomial.
pub(super) fn factors_of(polynomial: &Polynomial<Int>) -> Vec<(u64, usize)> {
    let factors = polynomial.square_free_decomposition();
    factors.iter().map(|(factor, k)| (factor.total_degree().unwrap_or(0), *k)).collect()
}

/// Divides out the squares of the distances from the joints of the ground. Such a factor vanishes on two isotropic lines,
/// on which only the joint itself is real.
fn without_isotropic_lines(
    mut polynomial: Polynomial<Int>,
    linkage: &Linkage,
    joints: &[usize],
) -> (Polynomial<Int>, Vec<(Polynomial<Int>, usize)>) {
    let mut removed: Vec<(Polynomial<Int>, usize)> = Vec::new();
    for joint in joints {
        let joint = &linkage.joints[*joint];
        for (_, at) in joint.of.iter().zip(&joint.at).filter(|(body, _)| **body == linkage.ground) {
            let [x, y] = [(0, &at.re), (1, &at.im)]
                .map(|(k, own)| Polynomial::<Rational>::variable(k).sub(&Polynomial::constant(own.clone())));
            let distance = x.mul(&x).add(&y.mul(&y)).primitive().0;
            let mut power = 0;
            while polynomial.total_degree() > Some(2) {
                let Some(quotient) = polynomial.checked_div_exact(&distance) else { break };
                polynomial = quotient;
                power += 1;
            }
            if power > 0 {
                removed.push((distance, power));
            }
        }
    }
    (polynomial, removed)
}
