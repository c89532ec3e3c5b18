//! An upper bound on the number of real solutions of a loop by the real zeros of an eliminant: theorem 9 of docs/certificate.md.

use super::chain::ChainClosure;
use super::doubled::Doubled;
use super::enclosing::Enclosing;
use super::fault::{Fault, refused};
use super::lines::{COLUMNS, Kinds, Rows, at, matrix};
use super::nearby::Nearby;
use super::real_ball::RealBall;
use super::record::{count, fields};
use crate::algebra::determinant::determinant;
use crate::algebra::echelon::Echelon;
use crate::algebra::univariate::Univariate;
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::Motion;
use rug::{Float, Rational, float::Round};
use serde_json::{Value, json};

/// The kind of the item.
pub(super) const KIND: &str = "real-zeros";
/// Degree of the minor: 2 for each row.
const DEGREE: usize = 2 * COLUMNS;
/// The half-angle tangent is searched up to this number, and its inverse up to the inverse: no angle of a data sheet is there.
const END: (i32, i32) = (97, 89);
/// The interval from -1 to 1 is divided here: special data have zeros in the middle.
const ASIDE: (i32, i32) = (1, 32);
/// Divisions that are tried in f64 at once.
const SHALLOW: usize = 5;
/// Depth of the divisions: zeros nearer than 2^-100 are not told apart.
const DEEPEST: usize = 100;
/// Divisions that are tried with numbers of twice the digits of f64: then no digit of theirs is left.
const DEEP: usize = 60;
/// The places at which the minor is computed are `(11 k + 1)/64` for k from -12 to 12: binary fractions, none of them special, and from
/// -2 to 2, so that few digits are lost.
const PLACES: std::ops::RangeInclusive<i32> = -12..=12;

/// The choice of the hidden unknown.
#[derive(Clone, Copy)]
pub(super) struct Choice {
    first: usize,
    hidden: usize,
}

impl Choice {
    /// Returns the unknown that is number k from the first one.
    fn around(self, k: usize) -> usize {
        (self.first + k) % 6
    }

    pub(super) fn read(aid: &Value) -> Result<Self, Fault> {
        let [first, hidden] = fields(aid, ["first", "hidden"], &[])?;
        Ok(Self { first: count(first)?, hidden: count(hidden)? })
    }
}

/// Returns the item that bounds the number of real solutions by this one; `None` if no choice of the hidden unknown does.
pub(super) fn proof_of_real(closure: &ChainClosure, value: usize) -> Option<Value> {
    let mut choices = (0..18).map(|k| Choice { first: k % 6, hidden: k / 6 });
    let choice = choices.find(|choice| real_solutions(closure, *choice) == Ok(value))?;
    Some(json!({ "kind": KIND, "value": value, "aid": { "first": choice.first, "hidden": choice.hidden } }))
}

/// Returns the number of real zeros of the eliminant of a choice, which are proved to be simple.
///
/// # Errors
/// [`Fault::Refused`] if they are not, or if there is no such eliminant.
pub(super) fn real_solutions(closure: &ChainClosure, choice: Choice) -> Result<usize, Fault> {
    let no = |why: &str| refused(format!("proof: {KIND}: {why}"));
    if choice.first > 5 || choice.hidden > 2 || !closure.spherical.is_empty() {
        return no("no such unknown");
    }
    let kinds: Kinds = std::array::from_fn(|k| Some(closure.variables[choice.around(k)]));
    if [kinds[3], kinds[choice.hidden]] != [Some(Variable::Rotation); 2] {
        return no("the hidden unknown or the fourth one is no rotation");
    }
    let near = real_zeros::<Doubled>(closure, &kinds, choice, |f| few_zeros(f, DEEP));
    near.or_else(|_| real_zeros::<RealBall>(closure, &kinds, choice, |f| zeros(f, 0))).or_else(no)
}

/// As [`real_solutions`], over numbers of one kind; `zeros` counts the zeros from -1 to 1 of a polynomial.
fn real_zeros<S: Enclosing>(
    closure: &ChainClosure,
    kinds: &Kinds,
    choice: Choice,
    zeros: impl Fn(&[S]) -> Option<usize>,
) -> Result<usize, &'static str> {
    let own = closure.links::<S>();
    let links: [Motion<S>; 6] = std::array::from_fn(|k| own[choice.around(k)].clone());
    let rows = matrix(&links, kinds, choice.hidden).ok_or("the other unknowns do not follow from three of them")?;
    let minor = minor(&rows).ok_or("the eliminant is 0, or not known well enough")?;
    let backwards: Vec<S> = minor.iter().rev().cloned().collect();
    let end = Rational::from(END);
    let within = |f: &[S], end: &Rational| zeros(&shifted(f, &Rational::new(), end)?);
    match [within(&minor, &end), within(&backwards, &Rational::from(end.recip_ref()))] {
        [Some(inside), Some(outside)] => Ok(inside + outside),
        _ => Err("two zeros may be one, or one is at the end of an interval"),
    }
}

/// Returns the coefficients of a minor that is not 0 as a polynomial of degree 24, the highest ones 0 if it has a lower degree.
fn minor<S: Enclosing>(rows: &Rows<S>) -> Option<Vec<S>> {
    let place = |k: i32| S::from_rational(&Rational::from((11 * k + 1, 64)));
    let chosen = Echelon::of(at(rows, &place(3)?), COLUMNS);
    if chosen.rank() < COLUMNS {
        return None;
    }
    let chosen: Rows<S> = chosen.independent_rows().iter().map(|row| rows[*row].clone()).collect();
    let value = |k: i32| {
        let t = place(k)?;
        // A determinant without a sure pivot is 0 as a number, and no bound.
        let value = determinant(&at(&chosen, &t));
        (!value.is_zero()).then_some((t, value))
    };
    let points: Vec<(S, S)> = PLACES.map(value).collect::<Option<_>>()?;
    let mut coefficients = Univariate::interpolate(&points).coefficients().to_vec();
    coefficients.resize(DEGREE + 1, S::zero());
    Some(coefficients)
}

/// Returns the number of zeros from -1 to 1 of a real polynomial that is not 0 at these ends; `None` if they are not proved to be simple.
fn zeros(f: &[RealBall], depth: usize) -> Option<usize> {
    rounded(f).and_then(|near| few_zeros(&near, SHALLOW)).or_else(|| few_zeros(f, 0)).or_else(|| {
        let parts = if depth < DEEPEST { divided(f) } else { None };
        let [below, above] = parts?;
        Some(zeros(&below, depth + 1)? + zeros(&above, depth + 1)?)
    })
}

/// Returns the coefficients in f64, as parts of the largest one.
fn rounded(f: &[RealBall]) -> Option<Vec<Nearby>> {
    let size = f.iter().filter_map(|c| c.parts().0.get_exp()).max()?;
    let part = |x: &Float| x.clone() >> size;
    let near = |c: &RealBall| {
        let (middle, radius) = c.parts();
        let radius = part(&Float::with_val(53, radius)).to_f64_round(Round::Up);
        Nearby::near(&part(middle), &Float::new(53), radius)
    };
    Some(f.iter().map(near).collect())
}

/// As [`zeros`], with at most so many divisions of the interval one after the other.
fn few_zeros<S: Enclosing>(f: &[S], divisions: usize) -> Option<usize> {
    // The upper neighbours of sums and products of upper bounds are upper bounds.
    let beyond = |terms: &[S], factor: &dyn Fn(usize) -> f64| {
        terms.iter().enumerate().fold(0.0, |sum: f64, (k, x)| (sum + (x.at_most() * factor(k)).next_up()).next_up())
    };
    if f[0].at_least() > beyond(&f[1..], &|_| 1.0) {
        return Some(0);
    }
    // The derivative is not 0 in the interval.
    if f[1].at_least() > beyond(&f[2..], &|k| k as f64 + 2.0) {
        let sign = |end: i32| {
            let value = f.iter().rev().fold(S::zero(), |value, c| if end < 0 { c.sub(&value) } else { c.add(&value) });
            (value.at_least() > 0.0).then(|| value.is_right())
        };
        return Some(usize::from(sign(-1)? != sign(1)?));
    }
    let [below, above] = if divisions > 0 { divided(f)? } else { return None };
    Some(few_zeros(&below, divisions - 1)? + few_zeros(&above, divisions - 1)?)
}

/// Divides the interval from -1 to 1 in two, and returns the polynomial of each as one from -1 to 1.
fn divided<S: Enclosing>(f: &[S]) -> Option<[Vec<S>; 2]> {
    let place = Rational::from(ASIDE);
    let (below, above) = (Rational::from(&place + 1) / 2_u32, Rational::from(1 - &place) / 2_u32);
    Some([shifted(f, &Rational::from(&below - 1), &below)?, shifted(f, &Rational::from(1 - &above), &above)?])
}

/// Returns the coefficients of `f(middle + half x)`: Horner's rule, again for each coefficient.
fn shifted<S: Enclosing>(f: &[S], middle: &Rational, half: &Rational) -> Option<Vec<S>> {
    let (middle, half) = (S::from_rational(middle)?, S::from_rational(half)?);
    let mut result = f.to_vec();
    let mut power = S::one();
    for first in 0..f.len() {
        for k in (first..f.len() - 1).rev() {
            result[k] = result[k].add(&middle.mul(&result[k + 1]));
        }
        result[first] = result[first].mul(&power);
        power = power.mul(&half);
    }
    Some(result)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::ring::Ring;

    /// The product of `x - root` and of `x^2 + 1`.
    fn with_roots(roots: &[(i32, i32)]) -> Vec<RealBall> {
        let linear = |root: &(i32, i32)| Univariate::new(vec![-Rational::from(*root), Rational::from(1)]);
        let product = roots.iter().fold(Univariate::circle(), |product, root| product.mul(&linear(root)));
        product.coefficients().iter().map(|c| RealBall::from_rational(c).unwrap()).collect()
    }

    #[test]
    fn simple_zeros_are_counted_and_no_others() {
        for (roots, count) in [
            (&[][..], Some(0)),
            (&[(1, 2), (-1, 4), (50_001, 100_000)], Some(3)),
            (&[(1, 2), (3, 2), (-5, 4)], Some(1)),
            (&[(0, 1), (1, 1_000_000_000)], Some(2)),
            (&[(1, 3), (1, 3)], None),
            (&[(1, 1)], None),
        ] {
            assert_eq!(zeros(&with_roots(roots), 0), count, "{roots:?}");
        }
    }
}
