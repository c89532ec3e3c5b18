//! The polynomial whose roots are the half-angle tangents of one unknown at all solutions: theorem 10 of docs/certificate.md.

use super::chain::ChainClosure;
use super::eliminant::minor_of;
use super::enclosing::Enclosing;
use super::fault::{Fault, refused, shortened, unreadable};
use super::isolation::Longer;
use super::mode::Ball;
use super::record::{count, fields, list, text};
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::kinematics::joint::Variable;
use rug::{Float, Integer, Rational, float::Round};
use serde_json::{Value, json};

/// The kind of the item.
pub(super) const KIND: &str = "membership";
/// Maximum number of digits of a coefficient.
const LONGEST: usize = 4000;

/// The claim about a polynomial.
pub(super) struct Claim {
    /// Index of the unknown, from 0.
    unknown: usize,
    degree: usize,
    /// Integers, the constant coefficient first.
    coefficients: Vec<Integer>,
}

impl Claim {
    pub(super) fn read(unknown: &Value, degree: &Value, polynomial: &Value) -> Result<Self, Fault> {
        let coefficients = list(polynomial)?.iter().map(integer).collect::<Result<_, _>>()?;
        let Some(unknown) = count(unknown)?.checked_sub(1) else { return unreadable("found the unknown 0") };
        Ok(Self { unknown, degree: count(degree)?, coefficients })
    }
}

fn integer(value: &Value) -> Result<Integer, Fault> {
    let written = text(value)?;
    let digits = written.strip_prefix('-').unwrap_or(written);
    let is_whole = !digits.is_empty() && digits.len() <= LONGEST && digits.bytes().all(|b| b.is_ascii_digit());
    match written.parse::<Integer>() {
        // Zeros in front, and a sign of 0, are another way to write the same number.
        Ok(number) if is_whole && number.to_string() == written => Ok(number),
        _ => unreadable(format!("found `{}`, expected the digits of a whole number", shortened(&written))),
    }
}

/// Returns the item for a polynomial in an unknown, of which the balls are all solutions; `None` if no choice of the eliminant gives it.
#[must_use]
pub fn proof_of_polynomial(
    closure: &ChainClosure,
    balls: &[Ball],
    unknown: usize,
    coefficients: &[Integer],
) -> Option<Value> {
    let degree = coefficients.len().checked_sub(1)?;
    let claim = Claim { unknown, degree, coefficients: coefficients.to_vec() };
    let items = (0..3).map(|hidden| {
        let first = (unknown + 6 - hidden) % 6;
        json!({ "kind": KIND, "aid": { "first": first, "hidden": hidden } })
    });
    items.into_iter().find(|item| check_polynomial(closure, balls, &claim, item).is_ok())
}

/// Checks that the roots of a polynomial are the values of an unknown at the solutions in the balls, which are all.
pub(super) fn check_polynomial(
    closure: &ChainClosure,
    balls: &[Ball],
    claim: &Claim,
    item: &Value,
) -> Result<(), Fault> {
    let no = |why: &str| refused(format!("proof: {KIND}: {why}"));
    let [_, aid] = fields(item, ["kind", "aid"], &[])?;
    let [first, hidden] = fields(aid, ["first", "hidden"], &[])?;
    let (first, hidden) = (count(first)?, count(hidden)?);
    let Some(links) = closure.exact.as_ref().filter(|_| closure.spherical.is_empty()) else {
        return no("only loops of rotations and translations with rational constants have an eliminant");
    };
    let is_own = claim.unknown == (first + hidden) % 6 && closure.variables[claim.unknown] == Variable::Rotation;
    if first > 5 || hidden > 2 || !is_own {
        return no("the unknown is not the angle of this eliminant");
    }
    let content = claim.coefficients.iter().fold(Integer::new(), Integer::gcd);
    let leads = claim.coefficients.last().is_some_and(|last| *last > 0);
    if claim.coefficients.len() != claim.degree + 1 || !leads || content != 1 {
        return refused("claim: the polynomial is not of this degree, or has a common factor or another sign");
    }
    let polynomial = Univariate::new(claim.coefficients.iter().map(|c| Rational::from(c.clone())).collect());
    let (rest, remainder) = minor_of(links, &closure.variables, first, hidden)?.div_rem(&polynomial);
    let Some(rest) = rest.map(Longer::from_rational) else { return no("the numbers are too long") };
    let Some(tangents) = balls.iter().map(|ball| tangent(ball, claim.unknown)).collect::<Option<Vec<_>>>() else {
        return no("an angle may be pi");
    };
    if !remainder.is_zero() || tangents.iter().any(|t| rest.eval(t).contains_zero()) {
        return no("the polynomial does not vanish at all solutions");
    }
    let are_apart = (0..tangents.len()).all(|k| tangents[..k].iter().all(|other| !other.overlaps(&tangents[k])));
    if tangents.len() != claim.degree || !are_apart {
        return no("the solutions are other in number than the roots");
    }
    Ok(())
}

/// Returns the half-angle tangent of an unknown in a ball: the sine over one and the cosine.
fn tangent(ball: &Ball, unknown: usize) -> Option<Longer> {
    let radius = Float::with_val_round(53, &ball.radius, Round::Up).0.to_f64();
    let (cos, sin) = Longer::cos_sin_about(&ball.centre[unknown], radius);
    sin.over(&cos.add(&Longer::one()))
}
