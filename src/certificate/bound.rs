//! Proofs that no solution is missing: upper bounds on the number of isolated solutions, which the modes meet.

use super::chain::ChainClosure;
use super::fault::{Fault, refused, unreadable};
use super::incidence::{of_axes, of_points};
use super::isolation::Closed;
use super::record::{count, fields};
use crate::kinematics::joint::Variable;
use serde_json::Value;

/// The bound that the proof of a certificate states.
pub(super) fn bound(closed: &Closed, proof: &[Value]) -> Result<usize, Fault> {
    let [item] = proof else {
        return refused(format!(
            "proof: found {} items, expected one that bounds the number of solutions",
            proof.len()
        ));
    };
    let kind = item.get("kind").and_then(Value::as_str).unwrap_or_default();
    let known = match kind {
        "general-bound" => general(closed),
        "geometry-bound" => match closed {
            Closed::Chain(closure) => of_axes(closure),
            Closed::Platform(closure) => of_points(closure),
        },
        _ => return unreadable(format!("proof: found the kind `{}`", super::fault::shortened(&kind))),
    };
    let [_, value] = fields(item, ["kind", "value"], &[])?;
    let stated = count(value)?;
    match known {
        Some(known) if known == stated => Ok(known),
        Some(known) => refused(format!("proof: {kind}: the value is {stated}, where the bound is {known}")),
        None => refused(format!("proof: {kind}: no such bound holds for these data")),
    }
}

/// The most isolated poses of six legs: theorem 2 of docs/platforms.md.
const OF_PLATFORMS: usize = 40;

/// What mechanisms of this kind can have at all: theorem 2 of docs/certificate.md.
fn general(closed: &Closed) -> Option<usize> {
    match closed {
        Closed::Platform(_) => Some(OF_PLATFORMS),
        Closed::Chain(closure) => of_chains(closure),
    }
}

fn of_chains(closure: &ChainClosure) -> Option<usize> {
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
