//! The curve of a point of a linkage in space or on the sphere, from its sections ([`Track`]).

use super::interpolation::{COMPARED, Watch};
use super::ring_curve::Track;
use super::sphere::{SphereCurve, sphere_trace};
use crate::algebra::groebner::Equation;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::error::{Error, Result};
use crate::kinematics::motion::{Vector, dot};
use crate::kinematics::space::{SpaceGiven, SpaceLinkage};
use crate::kinematics::sphere::{Direction, SphereGiven, SphereLinkage};
use crate::linkage::space::{self, bodies};
use crate::linkage::sphere;
use looproot_calculus::rotation::matrix::{apply, transpose};
use rug::Rational;

/// A polynomial that vanishes at every place of a point.
#[derive(Clone, Debug)]
pub struct CurveRelation {
    /// The coordinates that it relates: x, y and z are 0, 1 and 2.
    pub coordinates: Vec<usize>,
    /// A polynomial in x, y and z, metres, in coordinates of the ground.
    pub polynomial: Polynomial<Int>,
    /// The number of assemblies with the point on a general line of the plane of two coordinates, or on a general plane, complex ones
    /// included, with multiplicity.
    pub assemblies: usize,
}

impl CurveRelation {
    /// Returns the degree.
    #[must_use]
    pub fn degree(&self) -> u64 {
        self.polynomial.total_degree().unwrap_or(0)
    }
}

/// The curve of a point, interpolated.
#[derive(Clone, Debug)]
pub struct RingCurve {
    /// On the sphere one relation of all coordinates, of degree 1 at most in z; in space those of pairs of coordinates, the projections of the
    /// curve. A pair that rests has none.
    pub relations: Vec<CurveRelation>,
    /// The square of the radius, on the sphere.
    pub square: Option<Rational>,
    /// The number of sections, drawn at random, with which every relation was compared.
    pub compared: usize,
}

/// The curve of a point on the sphere.
#[derive(Clone, Debug)]
pub enum SphereTrace {
    /// The curve of the coupler of a four-bar, which is derived.
    Coupler(Box<SphereCurve>),
    /// The curve of another body, which is interpolated.
    Sections(RingCurve),
}

impl SphereTrace {
    /// Returns the degree of the curve in space: the number of intersections with a general plane.
    #[must_use]
    pub fn degree(&self) -> u64 {
        match self {
            Self::Coupler(curve) => curve.degree(),
            // The sphere has the degree 2.
            Self::Sections(curve) => 2 * curve.relations.first().map_or(0, CurveRelation::degree),
        }
    }
}

fn resting() -> Error {
    Error::Invalid("found a point that rests, expected one that moves".to_owned())
}

fn constant(v: &Vector<Rational>) -> Vector<Equation> {
    v.each_ref().map(|c| Equation::from_rational(c).unwrap_or_else(Equation::zero))
}

/// Returns the curve of a point of a body of a linkage on the sphere while the first given joint moves and the others are held.
///
/// # Errors
/// As [`sphere::System::with_freedoms`], and for a point whose curve is not derived.
pub fn trace_on_sphere(
    linkage: &SphereLinkage,
    given: &[SphereGiven],
    body: usize,
    point: &Direction,
    watch: &Watch<'_>,
) -> Result<SphereTrace> {
    if let Ok(curve) = sphere_trace(linkage, body, point) {
        return Ok(SphereTrace::Coupler(Box::new(curve)));
    }
    let system = sphere::System::with_freedoms(linkage, given.get(1..).unwrap_or_default(), 1)?;
    let rotations = sphere::rotations(&system, &system.axes);
    let rotation = |wanted: usize| rotations.iter().find(|(own, _)| *own == wanted).map(|(_, rotation)| rotation);
    let [Some(ground), Some(own)] = [linkage.ground, body].map(rotation) else { return Err(resting()) };
    let at = apply(&transpose(ground), &apply(own, &constant(point)));
    let square = dot(point, point);
    let (unknowns, equations) = (system.unknowns, system.equations);
    let track = Track { unknowns, equations, at: at.to_vec(), square: Some(square.clone()) };
    let (polynomial, assemblies) = track.curve(watch)?.ok_or_else(resting)?;
    let relations = vec![CurveRelation { coordinates: vec![0, 1, 2], polynomial, assemblies }];
    Ok(SphereTrace::Sections(RingCurve { relations, square: Some(square), compared: COMPARED }))
}

/// Returns the curve of a point of a body of a linkage in space while the first given joint moves and the others are held: its projections on
/// the planes of two coordinates.
///
/// # Errors
/// As [`space::System::with_freedoms`], and for a point whose curve is not derived.
pub fn trace_in_space(
    linkage: &SpaceLinkage,
    given: &[SpaceGiven],
    body: usize,
    point: &Vector<Rational>,
    watch: &Watch<'_>,
) -> Result<RingCurve> {
    let held = given.get(1..).unwrap_or_default();
    let system = space::System::with_freedoms(linkage, held, &bodies(linkage), 1)?;
    let place = system.place(body).ok_or_else(|| {
        let name = &linkage.bodies[body].name;
        Error::Unsupported(format!("the curve of a point of {name}, a rod that turns freely about its line"))
    })?;
    let at = place.apply(&constant(point));
    let mut relations = Vec::new();
    for coordinates in [[0, 1], [0, 2], [1, 2]] {
        let track = Track {
            unknowns: system.unknowns,
            equations: system.equations.clone(),
            at: coordinates.map(|k: usize| at[k].clone()).to_vec(),
            square: None,
        };
        let Some((polynomial, assemblies)) = track.curve(watch)? else { continue };
        let terms = polynomial.terms().map(|(exponents, c)| {
            let mut own = vec![0; 3];
            for (place, exponent) in coordinates.into_iter().zip(exponents) {
                own[place] = exponent;
            }
            (own, c.clone())
        });
        let polynomial = Polynomial::from_terms(terms).square_free_part();
        relations.push(CurveRelation { coordinates: coordinates.to_vec(), polynomial, assemblies });
    }
    if relations.is_empty() {
        return Err(resting());
    }
    Ok(RingCurve { relations, square: None, compared: COMPARED })
}
