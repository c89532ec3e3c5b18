//! The transfer function of a four-bar on the sphere, or of several in series.

use super::{FourBar, axis, series};
use crate::algebra::int::Int;
use crate::algebra::number::{Angle, HalfTangent};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};
use crate::catalogue::sphere::turned;
use crate::error::{Error, Result};
use crate::kinematics::motion::{Vector, dot};
use crate::kinematics::sphere::{SphereJoint, SphereLinkage};
use rug::Rational;

/// A polynomial in the half-angle tangents t of the input and s of the output.
type Plane = Polynomial<Rational>;

/// The relation of two angles.
#[derive(Clone, Debug)]
pub struct Transfer {
    /// The joint of the first variable.
    pub input: usize,
    /// The joint of the second variable.
    pub output: usize,
    /// The bodies of every four-bar in the series.
    pub bodies: Vec<[usize; 4]>,
    /// The polynomial that vanishes for the half-angle tangents t of the input and s of the output.
    pub polynomial: Polynomial<Int>,
    /// Factors on which the angles have a constant sum or difference, so that the coupling is homokinetic.
    pub constant_ratio: Vec<(Polynomial<Int>, &'static str)>,
}

/// Derives the relation of the angle of a joint at the ground to that of the last rocker behind it.
///
/// # Errors
/// If the crank of the joint drives no four-bar or more than two, or its angles are no rational functions of half-angle tangents.
pub fn transfer(linkage: &SphereLinkage, input: usize) -> Result<Transfer> {
    let fours = series(linkage, input)?;
    let mut relation: Option<Plane> = None;
    for four in &fours {
        let next = of_four_bar(linkage, four)?;
        relation = Some(match relation {
            None => next,
            Some(first) => eliminated(&first, &next),
        });
    }
    let none = || Error::Unsupported("the transfer function vanishes for all angles".to_owned());
    let polynomial = without_circles(relation.filter(|p| !p.is_zero()).ok_or_else(none)?.primitive().0);
    let constant_ratio = constant_ratio(&polynomial);
    let output = fours.last().map_or(input, |four| four.joints[3]);
    let bodies = fours.iter().map(|four| four.bodies).collect();
    Ok(Transfer { input, output, bodies, polynomial, constant_ratio })
}

fn number(q: &Rational) -> Plane {
    Plane::constant(q.clone())
}

/// Returns `1 + t^2`.
pub(super) fn circle(variable: usize) -> Plane {
    let t = Plane::variable(variable);
    t.mul(&t).add(&Ring::one())
}

/// Returns the rotation of the second body of a joint relative to the first, times `1 + t^2`.
fn rotation(joint: &SphereJoint, variable: usize) -> Result<[Vector<Plane>; 3]> {
    let at = |t: i32| turned(joint, &Angle::from_half_tangent(HalfTangent::Finite(Rational::from(t))));
    let ((start, exact), (quarter, also)) = (at(0), at(1));
    if !(exact && also) {
        let message = format!(
            "a polynomial in the half-angle tangent of the joint {}, whose directions have irrational lengths",
            joint.name
        );
        return Err(Error::Unsupported(message));
    }
    let [u, w] = &joint.at;
    let square = dot(u, u);
    let t = Plane::variable(variable);
    let (plus, minus) = (circle(variable), number(&Rational::from(1)).sub(&t.mul(&t)));
    let twice = t.add(&t);
    Ok(std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let along = Rational::from(&u[i] * &w[j]) / &square;
            let (cos, sin) = (Rational::from(&start[i][j] - &along), Rational::from(&quarter[i][j] - &along));
            minus.mul(&number(&cos)).add(&twice.mul(&number(&sin))).add(&plus.mul(&number(&along)))
        })
    }))
}

/// Returns the axis of a joint at the far end of a body that rotates relative to the ground, times `1 + t^2`.
fn far_axis(linkage: &SphereLinkage, joint: usize, body: usize, far: usize, variable: usize) -> Result<Vector<Plane>> {
    let turn = rotation(&linkage.joints[joint], variable)?;
    let place = axis(linkage, far, body);
    let is_second = linkage.joints[joint].of[1] == body;
    Ok(std::array::from_fn(|i| {
        let entry = |k: usize| if is_second { &turn[i][k] } else { &turn[k][i] };
        (0..3).fold(Plane::zero(), |sum, k| sum.add(&entry(k).mul(&number(&place[k]))))
    }))
}

/// Returns the relation of a four-bar: the angle between the ends of crank and rocker is that of the coupler.
fn of_four_bar(linkage: &SphereLinkage, four: &FourBar) -> Result<Plane> {
    let [first, second, third, fourth] = four.joints;
    let [_, crank, coupler, rocker] = four.bodies;
    let b = far_axis(linkage, first, crank, second, 0)?;
    let c = far_axis(linkage, fourth, rocker, third, 1)?;
    let cosine = dot(axis(linkage, second, coupler), axis(linkage, third, coupler));
    Ok(dot(&b, &c).sub(&circle(0).mul(&circle(1)).mul(&number(&cosine))))
}

/// Returns the relation of t and s if both are related to one more variable, in which both relations are quadratic.
pub(super) fn eliminated(first: &Plane, second: &Plane) -> Plane {
    let quadratic = |p: &Plane, variable: usize| {
        let mut list = p.coefficients_in(variable);
        list.resize(3, Plane::zero());
        list
    };
    let (f, g) = (quadratic(first, 1), quadratic(second, 0));
    let minor = |i: usize, j: usize| f[i].mul(&g[j]).sub(&f[j].mul(&g[i]));
    let outer = minor(2, 0);
    outer.mul(&outer).sub(&minor(2, 1).mul(&minor(1, 0)))
}

/// Removes the factors `1 + t^2` and `1 + s^2`, on which no angle is real.
pub(super) fn without_circles(mut polynomial: Polynomial<Int>) -> Polynomial<Int> {
    for variable in 0..2 {
        let t = Polynomial::<Int>::variable(variable);
        let circle = t.mul(&t).add(&Ring::one());
        while let Some(quotient) = polynomial.checked_div_exact(&circle) {
            polynomial = quotient;
        }
    }
    polynomial
}

/// Returns factors on which the output rotates as fast as the input.
fn constant_ratio(polynomial: &Polynomial<Int>) -> Vec<(Polynomial<Int>, &'static str)> {
    let [t, s] = [0, 1].map(Polynomial::<Int>::variable);
    let one = Polynomial::<Int>::one();
    let candidates = [
        (s.sub(&t), "out = in"),
        (s.add(&t), "out = -in"),
        (t.mul(&s).add(&one), "out = in + 180 deg"),
        (t.mul(&s).sub(&one), "out = 180 deg - in"),
    ];
    candidates.into_iter().filter(|(factor, _)| polynomial.checked_div_exact(factor).is_some()).collect()
}
