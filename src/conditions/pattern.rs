//! The symmetric families to which the twists of an ansatz belong, and the conditions on its lengths.
//!
//! An axis may be directed the other way, `Rx(pi) Rz(theta) Tz(d) Rx(pi) = Rz(-theta) Tz(-d)`, and so may a common normal,
//! `Rz(pi) Rx(alpha) Tx(a) Rz(pi) = Rx(-alpha) Tx(-a)`. A pattern holds if it holds for some directions.

use super::search::MobileSlice;
use super::symmetry::Slice;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::sort;
use crate::catalogue::ansatz::{Ansatz, Twist};
use rug::Rational;
use std::collections::BTreeSet;

/// A symmetric family to which the twists of an ansatz belong.
#[derive(Clone, Debug, PartialEq)]
pub struct TwistPattern {
    /// The name of the permutation.
    pub involution: &'static str,
    /// The joint, counted from 0, that is the first one of the pattern.
    pub joint: usize,
    /// The conditions on the lengths, as polynomials of the ansatz; empty if all members belong to the family.
    pub conditions: Vec<Polynomial<Rational>>,
    /// Whether mobility is proved for all such lengths and all twists of the pattern.
    pub proved: bool,
}

/// Returns the symmetric families that move for all lengths and to which all twists of an ansatz belong, those with fewest
/// conditions first, each choice of lengths once.
#[must_use]
pub fn patterns(ansatz: &Ansatz, slices: &[MobileSlice]) -> Vec<TwistPattern> {
    let n = ansatz.joints.len();
    let twists: Vec<Twist> = (0..n).map(|k| ansatz.twist(k)).collect();
    let replaced = ansatz.without_relations();
    // Free symbols are used if possible, so that relations of the file are taken into account.
    let in_free =
        |p: &Polynomial<Rational>| replaced.as_ref().map_or_else(|| p.clone(), |replaced| replaced.polynomial(p));
    let mut found: Vec<TwistPattern> = Vec::new();
    let mut names: BTreeSet<&str> = BTreeSet::new();
    for mobile in slices.iter().filter(|mobile| mobile.slice.slice == Slice::Mobile) {
        // The other sign patterns are this one with other directions.
        if !names.insert(mobile.slice.involution.name) {
            continue;
        }
        for joint in 0..n {
            for reversed in 0..1_u32 << n {
                for conditions in conditions(ansatz, &twists, mobile, joint, reversed) {
                    let mut conditions: Vec<_> =
                        conditions.into_iter().filter(|condition| !in_free(condition).is_zero()).collect();
                    conditions.dedup();
                    let is_new = |other: &TwistPattern| {
                        other.involution != mobile.slice.involution.name || !same(&other.conditions, &conditions)
                    };
                    if found.iter().all(is_new) {
                        let (involution, proved) = (mobile.slice.involution.name, mobile.proof.is_some());
                        found.push(TwistPattern { involution, joint, conditions, proved });
                    }
                }
            }
        }
    }
    sort::by_key(&mut found, |pattern| pattern.conditions.len());
    // Skip lengths that belong to a larger family already.
    let larger: Vec<TwistPattern> = found.clone();
    found.retain(|pattern| {
        let is_part = |other: &TwistPattern| {
            other.conditions.len() < pattern.conditions.len()
                && other.conditions.iter().all(|condition| pattern.conditions.iter().any(|own| equal(own, condition)))
        };
        !larger.iter().any(is_part)
    });
    found
}

/// Returns whether two polynomials are equal up to sign.
fn equal(one: &Polynomial<Rational>, other: &Polynomial<Rational>) -> bool {
    one == other || *one == other.neg()
}

fn same(one: &[Polynomial<Rational>], other: &[Polynomial<Rational>]) -> bool {
    one.len() == other.len() && one.iter().all(|condition| other.iter().any(|own| equal(own, condition)))
}

/// Returns the conditions on lengths and offsets for reversed axes in `reversed`, one list for each choice of directions of
/// the common normals; none if the twists are not of the pattern.
fn conditions(
    ansatz: &Ansatz,
    twists: &[Twist],
    mobile: &MobileSlice,
    joint: usize,
    reversed: u32,
) -> Vec<Vec<Polynomial<Rational>>> {
    let n = twists.len();
    let angles = ansatz.symbols.angles.len();
    let place = |k: usize| (joint + k) % n;
    let is_reversed = |k: usize| reversed >> (k % n) & 1 == 1;
    let half_turn = Twist { multiples: vec![0; angles], constant: (Rational::from(-1), Rational::new()) };
    let twist = |k: usize| {
        let turns = i32::from(is_reversed(k) != is_reversed(k + 1));
        Twist::sum([(1, &twists[place(k)]), (turns, &half_turn)], angles)
    };
    let (involution, signs) = (&mobile.slice.involution, mobile.slice.signs);
    let mut lists = vec![Vec::new()];
    for k in 0..n {
        let image = involution.joints[k];
        if k > image {
            continue;
        }
        let negative = signs.offset != (is_reversed(k) != is_reversed(image));
        let offset = |k: usize| ansatz.joints[place(k)].d.clone();
        if k < image || negative {
            let condition = if k == image {
                offset(k)
            } else if negative {
                offset(image).add(&offset(k))
            } else {
                offset(image).sub(&offset(k))
            };
            lists[0].push(condition);
        }
    }
    for k in 0..n {
        let image = involution.links[k];
        if k >= image {
            continue;
        }
        let mut next = Vec::new();
        // The common normal of the image has the same or the opposite direction.
        for flipped in [false, true] {
            let sign = if signs.twist == flipped { 1 } else { -1 };
            let difference = Twist::sum([(1, &twist(image)), (-sign, &twist(k))], angles);
            if !difference.is_constant() || difference.constant != (Rational::from(1), Rational::new()) {
                continue;
            }
            let length = |k: usize| &ansatz.joints[place(k)].a;
            let condition =
                if signs.length == flipped { length(image).sub(length(k)) } else { length(image).add(length(k)) };
            next.extend(lists.iter().map(|list: &Vec<_>| list.iter().cloned().chain([condition.clone()]).collect()));
        }
        lists = next;
    }
    lists
}
