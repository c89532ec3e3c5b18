//! Loops with the translation at another place: along parallel axes translations and rotations may change places.
//!
//! `Rz(q) G Tz(d) G' = Tz(+-d) Rz(q) G G'` where G carries the z axis into itself or its opposite. With one translation
//! among five rotations this gives more cuts.

use crate::algebra::ring::Field;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::Motion;

/// A loop, and the relation of its unknowns to those of another one.
#[derive(Clone, Debug)]
pub struct Rearranged<F> {
    /// The loop.
    pub closed: ClosedLoop<F>,
    /// Index in the other loop of each of its unknowns.
    pub order: [usize; 6],
    /// Whether the translation counts the other way.
    pub flipped: bool,
}

/// Returns all loops that differ from a loop with one translation by its place; entries no larger than `tolerance` (0 in exact
/// fields) are zero. The list is empty for other loops.
#[must_use]
pub fn rearranged<F: Field>(closed: &ClosedLoop<F>, tolerance: f64) -> Vec<Rearranged<F>> {
    let mut found = Vec::new();
    let translations = closed.variables.iter().filter(|v| **v == Variable::Translation).count();
    let Some(place) = closed.variables.iter().position(|v| *v == Variable::Translation).filter(|_| translations == 1)
    else {
        return found;
    };
    let original = Rearranged { closed: closed.clone(), order: [0, 1, 2, 3, 4, 5], flipped: false };
    for ahead in [true, false] {
        let (mut current, mut at) = (original.clone(), place);
        for _ in 0..5 {
            let Some((next, to)) = moved(&current, at, ahead, tolerance) else { break };
            found.push(next.clone());
            (current, at) = (next, to);
        }
    }
    found
}

/// Exchanges the translation at `at` with the rotation behind or before it; also returns its new place.
fn moved<F: Field>(of: &Rearranged<F>, at: usize, ahead: bool, tolerance: f64) -> Option<(Rearranged<F>, usize)> {
    let to = (at + if ahead { 1 } else { 5 }) % 6;
    let mut next = of.clone();
    // The constant between the two, and the one behind both.
    let (between, behind) = if ahead { (at, to) } else { (to, at) };
    let axis = &of.closed.constants[between].rotation;
    if axis[0][2].pivot_size() > tolerance || axis[1][2].pivot_size() > tolerance {
        return None;
    }
    // T G R G' = G T' R G' = G R T' G' with T' along the carried axis: the translation counts the other way if that is
    // reversed. Likewise R G T G' = T' R G G'.
    let opposite = axis[2][2].add(&F::one()).pivot_size() <= axis[2][2].sub(&F::one()).pivot_size();
    next.flipped ^= opposite;
    let constants = &mut next.closed.constants;
    let joined = constants[between].clone();
    if ahead {
        let before = (at + 5) % 6;
        constants[before] = constants[before].then_after(&joined);
    } else {
        constants[behind] = joined.then_after(&constants[behind]);
    }
    constants[between] = Motion::identity();
    next.closed.variables.swap(at, to);
    next.order.swap(at, to);
    Some((next, to))
}
