//! Freudenstein's equation of a four-bar with any coordinates of its points as symbols.
//!
//! With e from D to A, b along the crank, and v along the rocker (sign -1) or the coupler (sign 1), each in its own body, the third link keeps
//! its length: `|e + x b +- y v|^2 = |w|^2` for the rotations x and y of input and output. That holds whatever the symbols are.

use super::closure::Relation;
use super::places::{Places, Space, cross, difference, dot};
use super::symbolic::Coordinate;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::{Linkage, Pair};

/// Cosine, sine and 1 for a half-angle tangent, times `1 + t^2`.
fn turn(variable: usize) -> [Space; 3] {
    let t = Space::variable(variable);
    let square = t.mul(&t);
    [Space::one().sub(&square), t.add(&t), Space::one().add(&square)]
}

/// Returns the relation of input (variable 0) and output (variable 1) of a loop of four bodies and R joints, with symbols; `None` of others.
pub(super) fn four_bar(linkage: &Linkage, relation: &Relation, symbols: &[Coordinate]) -> Option<Polynomial<Int>> {
    let joints = &relation.joints;
    let is_turning = |joint: &usize| linkage.joints[*joint].pair == Pair::Revolute;
    if joints.len() != 4 || !relation.held.is_empty() || !joints.iter().all(is_turning) {
        return None;
    }
    let next = |body: usize, not: usize| {
        let mut others = joints.iter().copied().filter(|joint| *joint != not);
        others.find_map(|joint| match linkage.joints[joint].of {
            [a, b] if a == body => Some((joint, b)),
            [a, b] if b == body => Some((joint, a)),
            _ => None,
        })
    };
    let (base, first) = (relation.against, relation.input);
    let of = linkage.joints[first].of;
    let crank = if of[0] == base { of[1] } else { of[0] };
    let (second, coupler) = next(crank, first)?;
    let (third, rocker) = next(coupler, second)?;
    let (fourth, end) = next(rocker, third)?;
    if end != base || !of.contains(&base) {
        return None;
    }
    let places = Places { linkage, symbols };
    let link = |body: usize, [from, to]: [usize; 2]| {
        let side = |joint: usize| usize::from(linkage.joints[joint].of[0] != body);
        difference(&places.of_joint(to, side(to)), &places.of_joint(from, side(from)))
    };
    let (e, b) = (link(base, [fourth, first]), link(crank, [first, second]));
    let (along, across) = (link(coupler, [second, third]), link(rocker, [fourth, third]));
    let (v, w, is_against) = match relation.body {
        body if body == rocker => (across, along, true),
        body if body == coupler => (along, across, false),
        _ => return None,
    };
    let ([cx, sx, nx], [cy, sy, ny]) = (turn(0), turn(1));
    // The value of the joint is the turn of its second body against the first.
    let sx = if of[0] == base { sx } else { sx.neg() };
    let signed = |p: Space| if is_against { p.neg() } else { p };
    let lengths = dot(&e, &e).add(&dot(&b, &b)).add(&dot(&v, &v)).sub(&dot(&w, &w)).mul(&nx).mul(&ny);
    let input = cx.mul(&dot(&e, &b)).add(&sx.mul(&cross(&e, &b))).mul(&ny);
    let output = signed(cy.mul(&dot(&e, &v)).add(&sy.mul(&cross(&e, &v))).mul(&nx));
    let (cosine, sine) = (cx.mul(&cy).add(&sx.mul(&sy)), sy.mul(&cx).sub(&cy.mul(&sx)));
    let both = signed(cosine.mul(&dot(&b, &v)).add(&sine.mul(&cross(&b, &v))));
    let half = input.add(&output).add(&both);
    let all = lengths.add(&half).add(&half);
    (!all.is_zero()).then(|| all.primitive().0)
}
