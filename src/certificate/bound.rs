//! Proofs that no solution is missing: upper bounds on the number of isolated solutions that equal the number of modes.

use super::chain::ChainClosure;
use super::eliminant::{Choice, own_solutions_by_eliminant, solutions_by_eliminant};
use super::fault::{Fault, refused, unreadable};
use super::incidence::of_axes;
use super::isolation::Closed;
use super::mode::Ball;
use super::points::of_points;
use super::real_zeros::proof_of_real;
use super::record::{count, fields};
use crate::kinematics::joint::Variable;
use rug::Rational;
use serde_json::{Value, json};

/// The half-angle tangents from which hidden angles are counted, tried in turn, in case an angle is pi.
const SHIFTS: [(i32, i32); 2] = [(0, 1), (1, 4)];

/// The kind of the item for a loop of fewer than six unknowns with an eliminant of its own, to which no rotations were added.
pub(super) const OF_OWN: &str = "own-eliminant";

/// Returns the bound stated in the proof of a certificate. The balls are those of its modes; the bound does not rest on them.
pub(super) fn bound(closed: &Closed, proof: &[Value], balls: &[Ball]) -> Result<usize, Fault> {
    let [item] = proof else {
        return refused(format!(
            "proof: found {} items, expected one that bounds the number of solutions",
            proof.len()
        ));
    };
    let kind = item.get("kind").and_then(Value::as_str).unwrap_or_default();
    let known = match kind {
        "general-bound" => general(closed),
        "geometry-bound" => geometry(closed),
        "eliminant" | OF_OWN => {
            let [_, _, aid] = fields(item, ["kind", "value", "aid"], &[])?;
            let choice = Choice::read(aid)?;
            match closed {
                Closed::Chain(closure) if kind == OF_OWN => Some(own_solutions_by_eliminant(closure, &choice, balls)?),
                Closed::Chain(closure) => Some(solutions_by_eliminant(closure, &choice, balls)?),
                Closed::Platform(_) => None,
            }
        }
        _ => return unreadable(format!("proof: found the kind `{}`", super::fault::shortened(&kind))),
    };
    let optional: &[&str] = if kind == "eliminant" || kind == OF_OWN { &["aid"] } else { &[] };
    let [_, value] = fields(item, ["kind", "value"], optional)?;
    let stated = count(value)?;
    match known {
        Some(known) if known == stated => Ok(known),
        Some(known) => refused(format!("proof: {kind}: the value is {stated}, where the bound is {known}")),
        None => refused(format!("proof: {kind}: no such bound holds for these data")),
    }
}

/// Returns a proof that there are no solutions outside the balls; `None` if no kind of proof gives this bound.
#[must_use]
pub fn proof_of(closed: &Closed, balls: &[Ball]) -> Option<Value> {
    proof_of_all(closed, balls, 0)
}

/// As [`proof_of`], where so many of the balls hold double solutions.
#[must_use]
pub fn proof_of_all(closed: &Closed, balls: &[Ball], doubles: usize) -> Option<Value> {
    let counted = balls.len() + doubles;
    for (kind, known) in [("general-bound", general(closed)), ("geometry-bound", geometry(closed))] {
        if known == Some(counted) {
            return Some(json!({ "kind": kind, "value": counted }));
        }
    }
    // Theorem 4 counts different solutions.
    let value = balls.len();
    let Closed::Chain(closure) = closed else { return None };
    let mut choices = choices();
    let meets = |choice: &Choice| solutions_by_eliminant(closure, choice, balls) == Ok(value);
    let choice = choices.find(meets)?;
    Some(json!({ "kind": "eliminant", "value": value, "aid": choice.json() }))
}

/// Returns a proof that a loop of fewer than six unknowns has no solutions outside the balls; `None` if no eliminant gives this bound.
#[must_use]
pub fn proof_of_own(closure: &ChainClosure, balls: &[Ball]) -> Option<Value> {
    let value = balls.len();
    let choice = choices().find(|choice| own_solutions_by_eliminant(closure, choice, balls) == Ok(value))?;
    Some(json!({ "kind": OF_OWN, "value": value, "aid": choice.json() }))
}

/// Returns a proof that there are no real solutions but so many; `None` if theorem 9 gives none.
#[must_use]
pub fn proof_of_real_list(closed: &Closed, value: usize) -> Option<Value> {
    let Closed::Chain(closure) = closed else { return None };
    proof_of_real(closure, value)
}

/// Returns all choices of an eliminant that are tried.
pub(super) fn choices() -> impl Iterator<Item = Choice> {
    let shifts = SHIFTS.into_iter().map(Rational::from);
    shifts.flat_map(|shift| (0..18).map(move |k| Choice { first: k % 6, hidden: k / 6, shift: shift.clone() }))
}

fn geometry(closed: &Closed) -> Option<usize> {
    match closed {
        Closed::Chain(closure) => of_axes(closure),
        Closed::Platform(closure) => of_points(closure),
    }
}

/// Maximum number of isolated poses of six legs: theorem 2 of docs/platforms.md.
const OF_PLATFORMS: usize = 40;

/// Returns the bound for all mechanisms of this kind: theorem 2 of docs/certificate.md.
fn general(closed: &Closed) -> Option<usize> {
    match closed {
        Closed::Platform(_) => Some(OF_PLATFORMS),
        Closed::Chain(closure) => of_chains(closure),
    }
}

/// As [`general`], of a loop.
pub(super) fn of_chains(closure: &ChainClosure) -> Option<usize> {
    let translations = closure.variables.iter().filter(|v| **v == Variable::Translation).count();
    match (closure.spherical.len(), translations) {
        (0, 0 | 1) => Some(16),
        (0, 2) => Some(8),
        (0, 3) | (1, 2) => Some(2),
        (1, 0 | 1) => Some(4),
        (1, 3) => Some(1),
        _ => None,
    }
}
