//! The moments of two lines of known directions: the conditions of a CC dyad are linear in them.

use super::cells::Place;
use super::equations::Wanted;
use super::linear::solved;
use crate::algebra::disc::Disc;
use crate::algebra::ring::Ring;

/// Components of two moments.
const UNKNOWNS: usize = 6;

/// Returns the place with the moments of both lines; `None` where the numbers of conditions and moments differ, or where these
/// discs do not show that the conditions are independent.
pub(super) fn with_moments(wanted: &Wanted, place: &Place<Disc>) -> Option<Place<Disc>> {
    let at = |numbers: Vec<Disc>| wanted.equations(&Place { directions: place.directions.clone(), numbers });
    let unit = |k: usize| (0..UNKNOWNS).map(|j| if j == k { Disc::one() } else { Disc::zero() }).collect();
    // The first equations are those of the directions alone, which have no part in this.
    let own = wanted.positions.len() - 1;
    let constants: Vec<Disc> = at(vec![Disc::zero(); UNKNOWNS]).split_off(own);
    if constants.len() != UNKNOWNS {
        return None;
    }
    let columns: Vec<Vec<Disc>> = (0..UNKNOWNS).map(|k| at(unit(k)).split_off(own)).collect();
    let row = |i: usize| -> Vec<Disc> {
        let coefficients = columns.iter().map(|column| column[i].sub(&constants[i]));
        coefficients.chain(std::iter::once(constants[i].neg())).collect()
    };
    let numbers = solved((0..UNKNOWNS).map(row).collect())?.into_iter().flatten().collect();
    Some(Place { directions: place.directions.clone(), numbers })
}
