//! Points with algebraic coordinates, found from solutions that are known to many digits. No proof rests on this: the items are checked.

use super::algebraic::{BITS, Far, KIND};
use super::chain::ChainClosure;
use super::enclosing::{Enclosing, near_inverse};
use super::isolation::{Closure, Point};
use super::mode::Ball;
use super::refine::Near;
use crate::algebra::ring::Ring;
use crate::kinematics::joint::Variable;
use num_complex::Complex;
use rug::{Float, Integer, Rational};
use serde_json::{Value, json};

/// Newton steps: from 33 bits, each doubles them.
const STEPS: usize = 8;
/// A rational number of which so many bits are told by the computation is believed.
const TOLD: u32 = 900;
/// Largest denominator in bits: far fewer than half of those.
const LONGEST: u32 = 420;
/// Names of points nearer than this are not told apart.
const APART: f64 = 1e-6;
/// Solutions among which conjugates are looked for: all subsets are tried.
const MOST_AMONG: usize = 10;

/// Returns the balls of the solutions of a loop of fewer than six unknowns, and the item of theorem 11 if there are any, from all solutions of
/// the longer loop with balls around them; `None` if their coordinates have too many digits.
#[must_use]
pub fn proof_of_points(closure: &ChainClosure, near: &[Near], balls: &[Ball]) -> Option<(Vec<Ball>, Option<Value>)> {
    let own = || near.iter().zip(balls).filter(|(_, ball)| closure.may_be_own(ball));
    let points = own().map(|((x, _), _)| coordinates(closure, x)).collect::<Option<Vec<_>>>()?;
    let item = if points.is_empty() { None } else { Some(item(&points)?) };
    Some((own().map(|(_, ball)| ball.clone()).collect(), item))
}

/// Returns cosine and sine or the distance of the own unknowns at a solution, which is improved to many digits.
pub(super) fn coordinates(closure: &ChainClosure, near: &[Complex<f64>]) -> Option<Vec<Vec<Far>>> {
    let part = |x: f64| Some((Rational::from_f64(x)?, ()));
    let mut x: Vec<(Rational, Rational)> =
        near.iter().map(|z| Some((part(z.re)?.0, part(z.im)?.0))).collect::<Option<_>>()?;
    let (angles, links) = (closure.angles(), closure.constants());
    let mut turns = Vec::new();
    for step in 0..=STEPS {
        turns = (0..6).map(|k| angles[k].then(|| Far::cos_sin_about(&x[k], 0.0))).collect();
        if step == STEPS {
            break;
        }
        let point = Point { x: x.iter().map(|x| Far::about(x, 0.0)).collect(), turns: turns.clone() };
        let inverse = near_inverse(&closure.slope(&links, &point).0)?;
        let values = closure.values(&links, &point);
        for (row, (re, im)) in inverse.iter().zip(&mut x) {
            let change = row.iter().zip(&values).fold(Far::zero(), |sum, (c, f)| sum.add(&c.mul(f)));
            let less = |x: &Rational, by: &Float| Float::with_val(BITS, Float::with_val(BITS, x) - by).to_rational();
            (*re, *im) = (less(re, change.re())?, less(im, change.im())?);
        }
    }
    let own = (0..closure.own).map(|k| match &turns[k] {
        Some((cos, sin)) => vec![cos.midpoint(), sin.midpoint()],
        None => vec![Far::about(&x[k], 0.0).midpoint()],
    });
    Some(own.collect())
}

/// Returns the item of these points, which are closed under conjugation; `None` if their coordinates have too many digits.
pub(super) fn item(points: &[Vec<Vec<Far>>]) -> Option<Value> {
    let shape: Vec<usize> = points.first()?.iter().map(Vec::len).collect();
    let flat: Vec<Vec<Far>> = points.iter().map(|point| point.iter().flatten().cloned().collect()).collect();
    let count = flat[0].len();
    let units = (0..count).map(|k| (0..count).map(|i| i32::from(i == k)).collect::<Vec<i32>>());
    let sums =
        [3, 5].into_iter().map(|factor| (0..count).map(|i| i32::try_from(i).unwrap_or(0) % factor + 1).collect());
    let (weights, polynomial, values) = units.chain(sums).find_map(|weights| {
        let (polynomial, values) = named(&flat, &weights)?;
        Some((weights, polynomial, values))
    })?;
    let texts = |numbers: &[Rational]| numbers.iter().map(Rational::to_string).collect::<Vec<_>>();
    let mut values = values.iter().map(|value| texts(value));
    let values: Vec<Vec<Vec<String>>> = shape.iter().map(|count| values.by_ref().take(*count).collect()).collect();
    let weights: Vec<String> = weights.iter().map(i32::to_string).collect();
    Some(json!({ "kind": KIND, "polynomial": texts(&polynomial), "values": values, "aid": { "weights": weights } }))
}

/// Returns the polynomial of the names of points, which are sums of their coordinates, and every coordinate as a polynomial in the name.
fn named(points: &[Vec<Far>], weights: &[i32]) -> Option<(Vec<Rational>, Vec<Vec<Rational>>)> {
    let name = |point: &Vec<Far>| {
        let terms = point.iter().zip(weights).filter(|(_, w)| **w != 0);
        terms.fold(Far::zero(), |sum, (x, w)| sum.add(&x.mul(&Far::from_integer(*w)))).midpoint()
    };
    let names: Vec<Far> = points.iter().map(name).collect();
    let are_apart = (0..names.len()).all(|k| names[..k].iter().all(|other| other.sub(&names[k]).at_least() > APART));
    if !are_apart {
        return None;
    }
    let polynomial: Vec<Rational> = product(names.iter()).iter().map(rational).collect::<Option<_>>()?;
    // Lagrange's polynomials: 1 at one of the names, 0 at the others.
    let one = |k: usize| {
        let others = || names.iter().enumerate().filter(|(i, _)| *i != k).map(|(_, other)| other);
        let scale = others().fold(Far::one(), |scale, other| scale.mul(&names[k].sub(other))).midpoint().inverse()?;
        Some(product(others()).iter().map(|c| c.mul(&scale).midpoint()).collect())
    };
    let basis: Vec<Vec<Far>> = (0..names.len()).map(one).collect::<Option<_>>()?;
    let value = |at: usize| -> Option<Vec<Rational>> {
        let coefficient = |power: usize| {
            let terms = points.iter().zip(&basis).map(|(point, own)| point[at].mul(&own[power]));
            rational(&terms.fold(Far::zero(), |sum, term| sum.add(&term)))
        };
        let mut found: Vec<Rational> = (0..names.len()).map(coefficient).collect::<Option<_>>()?;
        while found.last().is_some_and(|last| *last == 0) && found.len() > 1 {
            found.pop();
        }
        Some(found)
    };
    Some((polynomial, (0..weights.len()).map(value).collect::<Option<_>>()?))
}

/// Returns the coefficients of the polynomial with these roots that begins with 1, the constant one first.
fn product<'a>(roots: impl Iterator<Item = &'a Far>) -> Vec<Far> {
    let mut coefficients = vec![Far::one()];
    for root in roots {
        coefficients.insert(0, Far::zero());
        for k in 1..coefficients.len() {
            coefficients[k - 1] = coefficients[k - 1].sub(&root.mul(&coefficients[k])).midpoint();
        }
    }
    coefficients
}

/// Returns the points that are conjugate to one of them over the rationals: the least subset with a rational polynomial.
pub(super) fn conjugate(points: &[Vec<Vec<Far>>], to: usize) -> Option<Vec<Vec<Vec<Far>>>> {
    if points.len() > MOST_AMONG {
        return None;
    }
    let mut subsets: Vec<usize> = (0..1 << points.len()).filter(|subset| subset >> to & 1 == 1).collect();
    subsets.sort_by_key(|subset| subset.count_ones());
    let chosen = |subset: usize| (0..points.len()).filter(move |k| subset >> k & 1 == 1);
    let sums_are_rational = |subset: &usize| {
        let coordinates = points[to].iter().enumerate().flat_map(|(i, own)| (0..own.len()).map(move |j| (i, j)));
        coordinates
            .into_iter()
            .all(|(i, j)| rational(&chosen(*subset).fold(Far::zero(), |sum, k| sum.add(&points[k][i][j]))).is_some())
    };
    let subset = subsets.into_iter().find(sums_are_rational)?;
    Some(chosen(subset).map(|k| points[k].clone()).collect())
}

/// Returns the constant coordinates of an unknown that is held.
pub(super) fn held(variable: Variable, [first, second]: [&Rational; 2]) -> Option<Vec<Far>> {
    let first = Far::from_rational(first)?;
    Some(if variable == Variable::Rotation { vec![first, Far::from_rational(second)?] } else { vec![first] })
}

/// Returns the rational number of few digits that is as near as the computation tells; `None` if there is none.
fn rational(x: &Far) -> Option<Rational> {
    let tolerance = Rational::from((Integer::from(1), Integer::from(1) << TOLD));
    if x.im().to_rational()?.abs() > tolerance {
        return None;
    }
    let value = x.re().to_rational()?;
    // The convergents of the continued fraction.
    let mut rest = value.clone();
    let (mut before, mut last) = ((Integer::new(), Integer::from(1)), (Integer::from(1), Integer::new()));
    loop {
        let whole = rest.clone().floor().numer().clone();
        let next = (Integer::from(&whole * &last.0) + &before.0, Integer::from(&whole * &last.1) + &before.1);
        (before, last) = (last, next);
        if last.1.significant_bits() > LONGEST {
            return None;
        }
        let found = Rational::from((last.0.clone(), last.1.clone()));
        if Rational::from(&found - &value).abs() < tolerance {
            return Some(found);
        }
        rest = Rational::from(&rest - &whole).recip();
    }
}
