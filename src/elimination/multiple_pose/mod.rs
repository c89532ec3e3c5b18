//! Poses of a platform that count more than once, or share their rotation, as algebraic numbers, with their exact
//! multiplicities.
//!
//! The polynomial of the platform shows at which values of its variable k several poses coincide or share k. Modulo a prime,
//! traces on the part of the quotient algebra that belongs to the roots of one square-free factor g give the mean rotation of the
//! poses at each root as a polynomial in k, and several primes give it over the rational numbers. None of this has to be proved:
//! the pose is substituted into the equations over `Q[k]/g`, where it satisfies them or not, and its multiplicity is counted
//! there.

mod local;
mod position;
mod rotation;

use super::platform_polynomial::PlatformPolynomial;
use crate::algebra::number_field::{Algebraic, NumberField};
use crate::algebra::real_roots::RealRoot;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::platform::Platform;
use local::multiplicity_at;
use position::{Positions, positions};
use rotation::{Rotation, rotation};
use rug::{Integer, Rational};
use std::sync::Arc;

/// Poses that are conjugate over the rational numbers, one for every root of a polynomial.
#[derive(Clone, Debug)]
pub struct ExactPoses {
    /// Square-free; the poses are in the field of its roots.
    pub polynomial: Univariate<Rational>,
    /// The rotation, (w, x, y, z) of any length.
    pub quaternion: [Algebraic; 4],
    /// The position.
    pub position: [Algebraic; 3],
    /// The multiplicity of each of them: 1 where only the rotation is shared.
    pub multiplicity: usize,
}

/// Most roots of a factor that is treated: the numbers of larger ones are too long.
const MOST_CONJUGATES: usize = 20;
/// More poses than a platform can have.
const MOST: usize = 40;

/// Returns the poses found at multiple roots of the polynomial of a platform. Each listed pose is proved; whether the list is
/// complete has to be judged by the number of poses.
#[must_use]
pub fn multiple_poses(
    platform: &Platform<Rational>,
    squares: &[Rational; 6],
    polynomial: &PlatformPolynomial,
) -> Vec<ExactPoses> {
    let whole = Univariate::new(polynomial.coefficients.clone());
    let factors = whole.square_free_decomposition().into_iter();
    let several =
        factors.filter(|(_, m)| *m > 1).flat_map(|(factor, m)| parts(&factor).into_iter().map(move |f| (f, m)));
    let within_reach = several.filter(|(factor, _)| factor.degree() <= Some(MOST_CONJUGATES));
    within_reach.flat_map(|(factor, m)| at_factor(platform, squares, polynomial, &factor, m)).collect()
}

/// Splits a square-free polynomial into the linear factors of its rational roots and the remaining factor: a field of small
/// degree has short numbers.
fn parts(factor: &Univariate<Integer>) -> Vec<Univariate<Integer>> {
    let mut parts: Vec<Univariate<Integer>> = Vec::new();
    let Some(mut rest) = factor.map(|c| Some(Rational::from(c))) else { return Vec::new() };
    for root in factor.real_roots().iter_mut().filter_map(RealRoot::rational) {
        let (numerator, denominator) = root.into_numer_denom();
        let linear = Univariate::new(vec![-numerator, denominator]);
        let divisor = linear.coefficients().iter().map(Rational::from).collect();
        rest = rest.div_rem(&Univariate::new(divisor)).0;
        parts.push(linear);
    }
    // Integers, since the linear factors have none in common.
    parts.extend(rest.map(|c| Some(c.numer().clone())).filter(|rest| rest.degree() > Some(0)));
    parts
}

/// The poses at the roots of one factor.
fn at_factor(
    platform: &Platform<Rational>,
    squares: &[Rational; 6],
    polynomial: &PlatformPolynomial,
    factor: &Univariate<Integer>,
    multiplicity: usize,
) -> Vec<ExactPoses> {
    let Some(rotation) = rotation(platform, squares, polynomial, factor, multiplicity) else { return Vec::new() };
    let Some(rational) = factor.map(|c| Some(Rational::from(c))) else { return Vec::new() };
    let mut left = vec![rational];
    let mut found = Vec::new();
    while let Some(polynomial) = left.pop() {
        let field = NumberField::new(&polynomial);
        let here = over(&field, &polynomial, platform, squares, &rotation);
        // Where the roots differ in which numbers are zero, each part is treated on its own.
        match field.split() {
            Some(part) => left.extend([part.clone(), polynomial.div_rem(part).0]),
            None => found.extend(here.unwrap_or_default()),
        }
    }
    found
}

/// Returns the poses of one rotation over a field.
fn over(
    field: &Arc<NumberField>,
    polynomial: &Univariate<Rational>,
    platform: &Platform<Rational>,
    squares: &[Rational; 6],
    rotation: &Rotation,
) -> Option<Vec<ExactPoses>> {
    let x = rotation.over(field)?;
    let in_field = |q: &Rational| <Algebraic as Ring>::from_rational(q);
    let here: Platform<Algebraic> = platform.map(in_field)?;
    let lengths = squares.each_ref().map(in_field);
    let [Some(a), Some(b), Some(c), Some(d), Some(e), Some(f)] = lengths else { return None };
    let lengths = [a, b, c, d, e, f];
    let at = |x: &Quaternion<Algebraic>, p: [Algebraic; 3], polynomial: &Univariate<Rational>| {
        let multiplicity = multiplicity_at(&here, &lengths, x, &p, MOST)?;
        let [i, j, k] = x.vector.clone();
        let quaternion = [x.scalar.clone(), i, j, k];
        Some(ExactPoses { polynomial: polynomial.clone(), quaternion, position: p, multiplicity })
    };
    match positions(&here, &lengths, &x)? {
        Positions::One(p) => at(&x, p, polynomial).map(|pose| vec![pose]),
        Positions::Two(pair) => {
            // Where both positions coincide at some roots only, these are treated on their own.
            pair.discriminant.inverse()?;
            if let Some(root) = pair.root() {
                [root.clone(), root.neg()].iter().map(|root| at(&x, pair.at(root)?, polynomial)).collect()
            } else {
                // Only where everything else is rational: one square root is then the only extension.
                let square = pair.discriminant.rational()?;
                let rational = x.vector.iter().chain([&x.scalar]).all(|c| c.rational().is_some());
                let minimal = Univariate::new(vec![-square, Rational::new(), Rational::from(1)]);
                let root = NumberField::new(&minimal).root();
                rational.then(|| at(&x, pair.at(&root)?, &minimal))?.map(|pose| vec![pose])
            }
        }
    }
}
