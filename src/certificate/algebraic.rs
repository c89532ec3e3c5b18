//! Points with algebraic coordinates at which a loop closes: theorems 6 and 11 of docs/certificate.md.

use super::chain::ChainClosure;
use super::enclosing::Enclosing;
use super::fault::{Fault, refused, unreadable};
use super::mode::Ball;
use super::record::{decimal, fields, list, text};
use crate::algebra::ball::Ball as Long;
use crate::algebra::number_field::{Algebraic, NumberField};
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::Motion;
use rug::Rational;
use serde_json::Value;

/// Numbers of as many bits as the links are enclosed to, less some.
pub(super) const BITS: u32 = 1408;
pub(super) type Far = Long<BITS>;
/// Newton steps: from 53 bits, each doubles them.
const STEPS: usize = 6;
/// The kind of the item of theorem 11.
pub(super) const KIND: &str = "points";
/// Maximum number of solutions of six unknowns, and of conjugate points.
const MOST: usize = 16;

/// As many different points as the degree of a polynomial: numbers of `Q[T]` modulo this polynomial.
pub(super) struct Points {
    pub polynomial: Univariate<Rational>,
    /// Cosine and sine, or the distance, of every unknown.
    pub values: Vec<Vec<Algebraic>>,
    /// The weights by which these numbers add up to T.
    weights: Vec<Rational>,
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
        Ok(Self { polynomial, values, weights })
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

/// Returns the points of an item, at all of which a loop of fewer than six unknowns closes: theorem 11.
pub(super) fn exact_solutions(closure: &ChainClosure, item: &Value) -> Result<Points, Fault> {
    let points = Points::read(item, &closure.variables[..closure.own])?;
    // A spherical joint has two triples of angles for every rotation: its points would count twice.
    let links = closure.own_links.as_ref().filter(|_| closure.spherical.is_empty());
    if links.and_then(|links| points.standing(links)).is_none() {
        return refused("proof: points: the loop is not closed there");
    }
    Ok(points)
}

impl Points {
    /// Returns the number of points.
    pub(super) fn count(&self) -> usize {
        self.polynomial.degree().unwrap_or(0)
    }

    /// Whether a ball is proved to hold one of the points, with the added unknowns at 0.
    ///
    /// `P'/P` is the sum of 1/(t - root) over n roots, so that one of them is within n `|P(t)/P'(t)|` of t.
    pub(super) fn is_one_in(&self, closure: &ChainClosure, ball: &Ball) -> bool {
        let is_turn = |k: usize| closure.variables[k] == Variable::Rotation;
        // What overflowed is in no ball.
        let within = |x: &Far, factor: u32| x.upper().to_rational().is_some_and(|size| size * factor < ball.radius);
        let here: Vec<Vec<Far>> = (0..closure.own)
            .map(|k| {
                let (cos, sin) = Far::cos_sin_about(&ball.centre[k], 0.0);
                if is_turn(k) { vec![cos, sin] } else { vec![Far::about(&ball.centre[k], 0.0)] }
            })
            .collect();
        let at = |polynomial: &Univariate<Rational>, t: &Far| -> Option<Far> {
            Some(polynomial.map(Far::from_rational)?.eval(t))
        };
        let root = || {
            let weighed = here.iter().flatten().zip(&self.weights).map(|(x, w)| Some(x.mul(&Far::from_rational(w)?)));
            let start = weighed.collect::<Option<Vec<Far>>>()?.iter().fold(Far::zero(), |sum, x| sum.add(x)).midpoint();
            let slope = self.polynomial.derivative();
            let step = |t: &Far| at(&self.polynomial, t)?.over(&at(&slope, t)?);
            let near = (0..STEPS).try_fold(start, |t, _| Some(t.sub(&step(&t)?).midpoint()))?;
            let off = step(&near)?.mul(&Far::from_integer(i32::try_from(self.count()).ok()?));
            Some(near.enlarged(&off.upper()))
        };
        let Some(root) = root() else { return false };
        let is_near = |k: usize| -> Option<bool> {
            let point = self.values[k].iter().map(|x| at(&x.polynomial(), &root)).collect::<Option<Vec<Far>>>()?;
            Some(match (point.as_slice(), here[k].as_slice()) {
                // Cosine and sine of the difference d: where the sine is small and the cosine positive, d is less than twice the sine.
                ([cos, sin], [c, s]) => {
                    let along = cos.mul(c).add(&sin.mul(s));
                    let is_right = along.sub(&Far::one()).upper() < 1;
                    is_right && within(&sin.mul(c).sub(&cos.mul(s)), 2)
                }
                ([distance], [x]) => within(&distance.sub(x), 1),
                _ => false,
            })
        };
        let is_added_0 = |k: usize| within(&Far::about(&ball.centre[k], 0.0), 1);
        (0..closure.own).all(|k| is_near(k) == Some(true)) && (closure.own..6).all(is_added_0)
    }
}

pub(super) fn constant(c: &Rational) -> Algebraic {
    Algebraic::from_rational(c).unwrap_or_else(Algebraic::zero)
}

/// Reads rational numbers: decimals, or quotients of two.
fn rationals(value: &Value) -> Result<Vec<Rational>, Fault> {
    let one = |value: &Value| match text(value)?.split_once('/') {
        Some((above, below)) => {
            let below = decimal(&Value::from(below))?;
            if below == 0 { unreadable("found a division by zero") } else { Ok(decimal(&Value::from(above))? / below) }
        }
        None => decimal(value),
    };
    list(value)?.iter().map(one).collect()
}
