//! Proofs by distances that nothing real closes: theorem 8 of docs/certificate.md.

use super::fault::{Fault, refused};
use super::isolation::{Closed, Longer};
use super::record::fields;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::Ring;
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::dot;
use rug::{Float, float::Round};
use serde_json::{Value, json};

/// The kind of the item.
pub(super) const KIND: &str = "distance";

/// Returns the item that proves an answer without real solutions; `None` where distances do not show it.
#[must_use]
pub fn proof_by_distance(closed: &Closed) -> Option<Value> {
    is_too_far(closed).then(|| json!({ "kind": KIND }))
}

/// Checks the item: it has no other key.
pub(super) fn check_distance(closed: &Closed, item: &Value) -> Result<(), Fault> {
    let [_] = fields(item, ["kind"], &[])?;
    if is_too_far(closed) { Ok(()) } else { refused("proof: distance: no length exceeds the others together") }
}

/// Whether one side of a closed polygon is longer than all others together.
fn is_too_far(closed: &Closed) -> bool {
    match closed {
        Closed::Chain(closure) => {
            let turns = closure.variables.iter().all(|variable| *variable == Variable::Rotation);
            turns && is_open(&closure.links.each_ref().map(|link| Side::of_vector(&link.translation)))
        }
        Closed::Platform(closure) => {
            let legs: Vec<Side> = closure.squares.iter().map(|square| Side::of_square(&Longer::from(square))).collect();
            let between = |points: &[[Enclosure; 3]; 6], i: usize, j: usize| {
                Side::of_vector(&std::array::from_fn(|k| points[i][k].sub(&points[j][k])))
            };
            (0..6).any(|i| {
                (0..i)
                    .any(|j| is_open(&[legs[i], legs[j], between(&closure.base, i, j), between(&closure.plate, i, j)]))
            })
        }
    }
}

/// Bounds of a length from below and above. That of a negative square is no number, and opens every polygon.
#[derive(Clone, Copy)]
struct Side {
    least: f64,
    most: f64,
    is_imaginary: bool,
}

impl Side {
    fn of_vector(vector: &[Enclosure; 3]) -> Self {
        let vector = vector.each_ref().map(Longer::from);
        Self::of_square(&dot(&vector, &vector))
    }

    fn of_square(square: &Longer) -> Self {
        let part = |round, x: Float| Float::with_val_round(53, x, round).0.to_f64();
        let bits = square.re().prec() + 64;
        let low = part(Round::Down, Float::with_val_round(bits, square.re() - square.radius(), Round::Down).0);
        let high = part(Round::Up, Float::with_val_round(bits, square.re() + square.radius(), Round::Up).0);
        // The square root is correctly rounded: its neighbours are bounds.
        let root = |x: f64| x.max(0.0).sqrt();
        Self { least: root(low).next_down().max(0.0), most: root(high).next_up(), is_imaginary: high < 0.0 }
    }
}

/// Whether sides of these lengths cannot be those of a closed polygon.
fn is_open(sides: &[Side]) -> bool {
    sides.iter().enumerate().any(|(at, side)| {
        let others = sides.iter().enumerate().filter(|(k, _)| *k != at);
        side.is_imaginary || side.least > others.fold(0.0, |sum, (_, other)| (sum + other.most).next_up())
    })
}
