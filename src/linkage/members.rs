//! Groups whose numbers are not rational: their assemblies are compared in number with those of a member that is drawn.
//!
//! The coefficients of the cycles are polynomials in the places of the bodies in their clusters. At places that are drawn, what
//! vanishes does so for all places, but for a small probability: the rows of all sets that the pencil leaves out are dependent for all
//! places, and its determinant has no higher degree for any. The rows of the other sets and the determinant at one rotation are computed in discs
//! for the numbers themselves. Where they are regular there, the degree for drawn places bounds the number of assemblies.

use super::equations::{Closure, Equations};
use super::general::{Found, choice};
use super::groups::Group;
use super::isotropic::{Isotropic, Value, middle};
use super::pencil::{Parameter, Pencil};
use super::polynomial::turned;
use super::state::{Number, Place, State, number};
use crate::algebra::determinant::determinant;
use crate::algebra::drawn;
use crate::algebra::ring::Field;
use crate::kinematics::linkage::{Gaussian, Linkage};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;

/// Bits of the numbers that are drawn: polynomials of degrees below 10^4, for some hundred of which this is asked, vanish by chance less often than
/// [`drawn::PROBABILITY_OF_ERROR`].
const DRAWN_BITS: u32 = 62;
/// The half-angle tangent at which the determinant is asked: a number that is no root of simple data.
const PLACE: u32 = 37;

impl Field for Value {
    fn inverse(&self) -> Option<Self> {
        Self::inverse(self)
    }
    fn pivot_size(&self) -> f64 {
        middle(&self.disc).norm()
    }
    const PIVOT_ZERO: f64 = 0.0;
}

/// The cycles of a group at places of the bodies that are drawn.
fn drawn_member(linkage: &Linkage, group: &Group, state: &State) -> Option<Equations<Isotropic<Gaussian>>> {
    let mut random = ChaCha8Rng::seed_from_u64(drawn::seed());
    let mut state = state.clone();
    let mut any = || {
        let mut part = || Rational::from(random.random_range(1..1_u64 << DRAWN_BITS));
        let (re, im) = (part(), part());
        number(&Gaussian { re, im })
    };
    for (_, place) in &mut state.bodies {
        *place = Place { turn: any(), origin: any() };
    }
    Closure::new(linkage, group, &state)?.equations.exact()
}

/// Whether a group in a branch has no assemblies beside those that were proved, and does not move, but for a small probability.
#[must_use]
pub(super) fn are_all(
    linkage: &Linkage,
    group: &Group,
    state: &State,
    equations: &Equations<Number>,
    found: &Found,
) -> bool {
    let regular = || {
        let (rest, hidden) = found.met?;
        let member = drawn_member(linkage, group, state)?;
        let choice = choice(&member, rest, hidden).filter(|choice| choice.tells(&member))?;
        if choice.found.polynomial.degree()? != found.solutions.len() {
            return None;
        }
        let values = equations.map(|n| Some(n.map(|half| Value::within(half.disc.clone()))))?;
        let pencil = Pencil::of_sets(&values, rest, &[Parameter::Turn(hidden)], Some(&choice.pencil.sets))?;
        let at: Number = number(&turned(PLACE).z);
        Some(determinant(&pencil.at(&[[at.z, at.w]])).disc.is_not_zero())
    };
    regular() == Some(true)
}
