//! Points with algebraic coordinates at which a loop closes: theorems 6 and 11 of docs/certificate.md.

use super::chain::ChainClosure;
use super::fault::{Fault, refused, unreadable};
use super::record::{decimal, fields, list, text};
use crate::algebra::number_field::{Algebraic, NumberField};
use crate::algebra::ring::{Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::Motion;
use rug::Rational;
use serde_json::Value;

/// The kind of the item of theorem 11.
pub(super) const KIND: &str = "points";
/// Maximum number of solutions of six unknowns, and of conjugate points.
const MOST: usize = 16;

/// As many different points as the degree of a polynomial: numbers of `Q[T]` modulo this polynomial.
pub(super) struct Points {
    pub polynomial: Univariate<Rational>,
    /// Cosine and sine, or the distance, of every unknown.
    pub values: Vec<Vec<Algebraic>>,
}

impl Points {
    /// Reads the points of an item.
    ///
    /// # Errors
    /// [`Fault::Refused`] if they are not different, or if an angle is none.
    pub(super) fn read(item: &Value, variables: &[Variable]) -> Result<Self, Fault> {
        let [_, polynomial, values, aid] = fields(item, ["kind", "polynomial", "values", "aid"], &[])?;
        let [weights] = fields(aid, ["weights"], &[])?;
        let coefficients = rationals(polynomial)?;
        let is_monic = coefficients.last().is_some_and(|last| *last == 1);
        let polynomial = Univariate::new(coefficients);
        let degree = polynomial.degree().unwrap_or(0);
        let is_simple = polynomial.gcd(&polynomial.derivative()).degree() == Some(0);
        if !is_monic || degree == 0 || degree > MOST || !is_simple {
            return refused(
                "proof: the polynomial of the points has no degree from 1 to 16, does not begin with 1, or has multiple roots",
            );
        }
        let root = NumberField::new(&polynomial).root();
        let number = |value: &Value| -> Result<Algebraic, Fault> {
            let horner = |sum: Algebraic, c: &Rational| sum.mul(&root).add(&constant(c));
            Ok(rationals(value)?.iter().rev().fold(Algebraic::zero(), horner))
        };
        let values: Vec<Vec<Algebraic>> =
            list(values)?.iter().map(|own| list(own)?.iter().map(number).collect()).collect::<Result<_, _>>()?;
        let count = |variable: &Variable| if *variable == Variable::Rotation { 2 } else { 1 };
        if values.len() != variables.len() || variables.iter().zip(&values).any(|(v, own)| own.len() != count(v)) {
            return unreadable("proof: the points have other numbers than the loop has unknowns");
        }
        let is_angle = |own: &Vec<Algebraic>| match own.as_slice() {
            [cos, sin] => cos.mul(cos).add(&sin.mul(sin)) == Algebraic::one(),
            _ => true,
        };
        if !values.iter().all(is_angle) {
            return refused("proof: a cosine and a sine of the points are those of no angle");
        }
        let (flat, weights): (Vec<&Algebraic>, _) = (values.iter().flatten().collect(), rationals(weights)?);
        let name = flat.iter().zip(&weights).fold(Algebraic::zero(), |sum, (x, w)| sum.add(&x.mul(&constant(w))));
        if flat.len() != weights.len() || name != root {
            return refused("proof: the points are not told apart by the weights");
        }
        Ok(Self { polynomial, values })
    }

    /// Returns the links behind the unknowns with the motions of these in front of them, if the loop closes at the points.
    pub(super) fn standing(&self, links: &[Motion<Rational>]) -> Option<Vec<Motion<Algebraic>>> {
        let standing = |(own, link): (&Vec<Algebraic>, &Motion<Rational>)| {
            let moved = match own.as_slice() {
                [cos, sin] => Motion::rotation_z(cos.clone(), sin.clone()),
                [distance] => Motion::translation_z(distance.clone()),
                _ => return None,
            };
            Some(moved.then_after(&link.map(Algebraic::from_rational)?))
        };
        let motions: Vec<Motion<Algebraic>> = self.values.iter().zip(links).map(standing).collect::<Option<_>>()?;
        let product = motions.iter().fold(Motion::identity(), |product, motion| product.then_after(motion));
        (product == Motion::identity()).then_some(motions)
    }
}

/// Returns the number of points of an item, at all of which a loop of fewer than six unknowns closes: theorem 11.
pub(super) fn exact_solutions(closure: &ChainClosure, item: &Value) -> Result<usize, Fault> {
    let points = Points::read(item, &closure.variables[..closure.own])?;
    // A spherical joint has two triples of angles for every rotation: its points would count twice.
    let links = closure.own_links.as_ref().filter(|_| closure.spherical.is_empty());
    if links.and_then(|links| points.standing(links)).is_none() {
        return refused("proof: points: the loop is not closed there");
    }
    Ok(points.polynomial.degree().unwrap_or(0))
}

pub(super) fn constant(c: &Rational) -> Algebraic {
    Algebraic::from_rational(c).unwrap_or_else(Algebraic::zero)
}

/// Reads rational numbers: decimals, or quotients of two.
fn rationals(value: &Value) -> Result<Vec<Rational>, Fault> {
    let one = |value: &Value| match text(value)?.split_once('/') {
        Some((above, below)) => {
            let below = decimal(&Value::from(below))?;
            let inverse = below.inverse();
            inverse.map_or_else(|| unreadable("found a division by zero"), |inverse| Ok(decimal(&Value::from(above))? * inverse))
        }
        None => decimal(value),
    };
    list(value)?.iter().map(one).collect()
}
