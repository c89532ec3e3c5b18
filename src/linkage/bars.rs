//! Bars and legs whose lengths are square roots of rational numbers.
//!
//! A link that is joined at its two ends only has a part in the closure equations by the square of its length alone. With z and its
//! conjugate w as independent numbers, its end may stand at any (z, w) with `z w = n`, the square: at (n, 1), which is rational. Its rotation is
//! then `(exp(i q)/sqrt(n), sqrt(n) exp(-i q))` in place of `(exp(i q), exp(-i q))`, which is as good a rotation, real where z is the conjugate
//! of w over n. Once the link has its place, its own coordinates are those of the rounded length but for a factor as near 1 as that is exact.

use super::isotropic::Isotropic;
use super::state::State;
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::{Bar, Given, Linkage, LinkageJoint, Pair};
use rug::Rational;

/// The bars of a linkage, and its legs of given lengths, of which nothing but the square of the length matters; `None` where an
/// angle of one is given, or something else stands on one.
fn bars(linkage: &Linkage, given: &[Given]) -> Option<Vec<Bar>> {
    let legs = given.iter().filter_map(|one| match one {
        Given::Shift { joint, shift, square: Some(square), .. } => {
            Some(Bar { bodies: linkage.joints[*joint].of.to_vec(), length: shift.clone(), square: square.clone() })
        }
        _ => None,
    });
    let all: Vec<Bar> = linkage.bars.iter().cloned().chain(legs).collect();
    let is_alone = |bar: &Bar| {
        let joints: Vec<&LinkageJoint> = bar.bodies.iter().flat_map(|body| linkage.joints_of(*body)).collect();
        let pins = joints.iter().filter(|joint| joint.pair == Pair::Revolute).count();
        // Both halves of a leg have its P joint.
        let is_free = joints.len() == 2 * bar.bodies.len();
        let is_placed = given.iter().any(|one| match one {
            Given::Turn { joint, .. } => linkage.joints[*joint].of.iter().any(|body| bar.bodies.contains(body)),
            Given::Place { body, .. } => bar.bodies.contains(body),
            Given::Shift { .. } => false,
        });
        let is_carrier = |joint: &LinkageJoint| matches!(joint.pair, Pair::Gear { .. });
        let is_geared = linkage.joints.iter().any(is_carrier);
        pins == 2 && is_free && !is_placed && !is_geared && bar.length != 0 && !bar.bodies.contains(&linkage.ground)
    };
    all.iter().all(is_alone).then_some(all)
}

/// Places bars so that the squares of their lengths are exact, in a branch in which nothing is glued; false where their lengths matter.
pub(super) fn square(linkage: &Linkage, given: &[Given], state: &mut State) -> bool {
    let Some(bars) = bars(linkage, given) else { return false };
    for Bar { bodies, length, square } in bars {
        let factor = Rational::from(&square / &length);
        let inverse = Rational::from(length.recip_ref());
        for body in bodies {
            // A length (r, r) becomes (n, 1).
            let [z, w] = [&factor, &inverse].map(|q| Ring::from_rational(q).unwrap_or_else(Ring::one));
            state.bodies[body].1.turn = Isotropic { z, w };
            state.squares[body] = Some(square.clone());
        }
    }
    true
}
