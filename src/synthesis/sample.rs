//! A real member of a family of dyads: the family is cut by linear equations until finitely many are left.

use super::answer::{Maker, numbers};
use super::cells::Place;
use super::dyad::Dyad;
use super::equations::Wanted;
use super::solved::{Found, solve};
use crate::algebra::groebner::Equation;
use crate::algebra::ring::Ring;

/// Products of words that a cut may take: a sample is no part of the verdict.
const EFFORT: u64 = 50_000_000;
/// Number of cuts that are tried. Where half of all members are real, one in a thousand families is left without a sample.
const TRIES: i32 = 10;

/// One real dyad of a family of this dimension, if a cut meets one.
pub(super) fn sample(wanted: &Wanted, dimension: usize, maker: Maker) -> Option<Dyad> {
    (0..TRIES).find_map(|number| {
        let equations = |place: &Place<Equation>| {
            let mut all = wanted.equations(place);
            all.extend((0..dimension).filter_map(|k| cut(place, k, number)));
            all
        };
        let Some(Found::Points(points)) = solve(&wanted.shape(), &equations, EFFORT) else { return None };
        let point = points.iter().find(|point| point.is_real() && !point.is_origin())?;
        Some(numbers(wanted, point, maker)).filter(|dyad| dyad.radius.is_finite())
    })
}

/// The equation of this number of a cut: it fixes a coordinate, the last ones first, or lays a direction into a plane.
fn cut(place: &Place<Equation>, k: usize, number: i32) -> Option<Equation> {
    let shift = i32::try_from(k).unwrap_or(0);
    // Small whole numbers, another one for each coordinate and each try.
    let value = (number * (2 + shift) + shift + 1) % 7 - 3;
    if k < place.numbers.len() {
        let coordinate = &place.numbers[place.numbers.len() - 1 - k];
        return Some(coordinate.sub(&Equation::from_integer(value)));
    }
    let direction = place.directions.get(place.directions.len().checked_sub(1 + k - place.numbers.len())?)?;
    let [x, y] = [direction.first()?, direction.last()?];
    Some(x.mul(&Equation::from_integer(value)).add(&y.mul(&Equation::from_integer(number + 1))))
}
