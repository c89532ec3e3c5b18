//! Tilings of the plane by copies of one tile, all of which are equivalent: Poincare's theorem on polygons with paired sides.
//!
//! A polygon without self-intersections, an isometry for every pair of its sides that takes one to the other and the polygon to
//! the outside, and angles that add up to `2 pi/k` round every cycle of corners: then the isometries generate a discrete group, and its
//! images of the polygon tile the plane. \[Wittenburg2016, 14.6\]

use super::answer::{Answer, Named, list, number};
use crate::algebra::number::nearest_f64;
use crate::algebra::ring::{Field, Ring};
use crate::catalogue::tile::Tile;
use crate::kinematics::linkage::Gaussian;
use rug::Rational;
use serde_json::{Value, json};
use std::cmp::Ordering;
use std::f64::consts::TAU;

fn conjugate(z: &Gaussian) -> Gaussian {
    Gaussian { re: z.re.clone(), im: z.im.neg() }
}

/// `x y' - y x'`
fn area(a: &Gaussian, b: &Gaussian) -> Rational {
    conjugate(a).mul(b).im
}

fn square(z: &Gaussian) -> Rational {
    z.mul(&conjugate(z)).re
}

/// Returns whether the argument of a number, from 0 up to a whole turn, is less than that of another one.
fn is_less(a: &Gaussian, b: &Gaussian) -> bool {
    let is_lower = |z: &Gaussian| z.im < 0 || (z.im == 0 && z.re < 0);
    match (is_lower(a), is_lower(b)) {
        (false, true) => true,
        (true, false) => false,
        _ => area(a, b) > 0,
    }
}

/// How two sides are paired: the other side, and whether the copy is mirrored.
type Pairing = Vec<(usize, bool)>;

/// A cycle of corners with the sum of their angles as part of a turn.
struct Cycle {
    corners: Vec<usize>,
    /// The number of copies of the cycle round a point; `None` where the angles do not fit.
    order: Option<u32>,
    angle: f64,
}

impl Tile {
    fn corner(&self, k: usize) -> &Gaussian {
        &self.corners[k % self.corners.len()]
    }

    fn side(&self, k: usize) -> Gaussian {
        self.corner(k + 1).sub(self.corner(k))
    }

    fn pairing(&self) -> Pairing {
        let mut pairing = vec![(0, false); self.corners.len()];
        for (list, is_glide) in [(&self.pairs, false), (&self.glides, true)] {
            for [a, b] in list {
                (pairing[*a], pairing[*b]) = ((*b, is_glide), (*a, is_glide));
            }
        }
        pairing
    }

    /// The number whose argument is the angle at a corner.
    fn angle(&self, k: usize) -> Gaussian {
        let back = self.side(k + self.corners.len() - 1);
        conjugate(&self.side(k)).mul(&Gaussian { re: back.re.neg(), im: back.im.neg() })
    }

    /// The number of two sides that meet elsewhere than in a common corner.
    fn crossing(&self) -> Option<[usize; 2]> {
        let n = self.corners.len();
        let turn = |a: &Gaussian, b: &Gaussian, c: &Gaussian| area(&b.sub(a), &c.sub(a)).cmp0();
        let between = |a: &Gaussian, b: &Gaussian, c: &Gaussian| {
            conjugate(&a.sub(c)).mul(&b.sub(c)).re <= 0 && turn(a, b, c).is_eq()
        };
        let meet = |i: usize, j: usize| {
            let (a, b, c, d) = (self.corner(i), self.corner(i + 1), self.corner(j), self.corner(j + 1));
            let [p, q, r, s] = [turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b)];
            (p != q && r != s && p.is_ne() && q.is_ne() && r.is_ne() && s.is_ne())
                || between(a, b, c)
                || between(a, b, d)
                || between(c, d, a)
                || between(c, d, b)
        };
        for i in 0..n {
            for j in i + 1..n {
                let is_next = j == i + 1 || (i == 0 && j == n - 1);
                // Sides that follow each other meet elsewhere only where they fold back.
                let (k, folded) = if j == i + 1 { (j, self.angle(j)) } else { (i, self.angle(i)) };
                let is_folded = folded.im == 0 && folded.re > 0;
                if if is_next { is_folded && k < n } else { meet(i, j) } {
                    return Some([i, j]);
                }
            }
        }
        None
    }

    /// The cycles of corners that meet in one point of the tiling.
    fn cycles(&self, pairing: &Pairing) -> Vec<Cycle> {
        let n = self.corners.len();
        let mut seen = vec![false; n];
        let mut cycles = Vec::new();
        for start in 0..n {
            if seen[start] {
                continue;
            }
            let (mut corners, mut product, mut turns) = (Vec::new(), Gaussian::one(), 0_u32);
            let (mut corner, mut side) = (start, start);
            loop {
                seen[corner] = true;
                corners.push(corner);
                // The sum of the angles is more than a whole turn where its remainder falls.
                let next = product.mul(&self.angle(corner));
                turns += u32::from(is_less(&next, &product));
                product = next;
                let (other, is_glide) = pairing[side];
                // The image of the corner is the end of the other side at the same place along it, or at the opposite one.
                let at_start = (corner == side) == is_glide;
                corner = if at_start { other } else { (other + 1) % n };
                side = if at_start { (other + n - 1) % n } else { (other + 1) % n };
                if corner == start && side == start {
                    break;
                }
                if corners.len() > n {
                    break;
                }
            }
            let order = match (turns, product.re.cmp0(), product.im.cmp0()) {
                (1, Ordering::Greater, Ordering::Equal) => Some(1),
                (0, Ordering::Less, Ordering::Equal) => Some(2),
                (0, Ordering::Equal, Ordering::Greater) => Some(4),
                _ => None,
            };
            let size = if product.re.cmp_abs(&product.im).is_lt() {
                product.im.clone().abs()
            } else {
                product.re.clone().abs()
            };
            let part = |x: &Rational| nearest_f64(&Rational::from(x / &size));
            let rest = part(&product.im).atan2(part(&product.re)).rem_euclid(TAU);
            let angle = f64::from(turns) * TAU + rest;
            cycles.push(Cycle { corners, order, angle });
        }
        cycles
    }
}

/// Returns the isometries of a tile with the group that they generate, or why its copies do not tile.
pub fn answer(tile: &Tile) -> Answer {
    let n = tile.corners.len();
    let twice = (0..n).fold(Rational::new(), |sum, k| sum + area(tile.corner(k), tile.corner(k + 1)));
    if (0..n).any(|k| square(&tile.side(k)) == 0) {
        return Answer::none("two corners that follow each other are the same point");
    }
    if let Some([i, j]) = tile.crossing() {
        return Answer::none(format!("the sides {} and {} of the polygon meet", i + 1, j + 1));
    }
    if twice <= 0 {
        return Answer::none("the corners run clockwise: the polygon is on the wrong side of its sides");
    }
    let pairing = tile.pairing();
    for (k, (other, _)) in pairing.iter().enumerate() {
        if square(&tile.side(k)) != square(&tile.side(*other)) {
            return Answer::none(format!("the sides {} and {} are of different lengths", k + 1, other + 1));
        }
    }
    let cycles = tile.cycles(&pairing);
    if let Some(cycle) = cycles.iter().find(|cycle| cycle.order.is_none()) {
        let names: Vec<String> = cycle.corners.iter().map(|k| (k + 1).to_string()).collect();
        return Answer::none(format!(
            "the angles at the corners {} add up to {:.6} of a turn, no whole part of it that rational corners allow",
            names.join(", "),
            cycle.angle / TAU
        ));
    }
    let mut named = Named::default();
    let mut generators = Vec::new();
    for (list, is_glide) in [(&tile.pairs, false), (&tile.glides, true)] {
        for [a, b] in list {
            let (from, to) = (tile.side(*a), tile.side(*b));
            // z -> f z + s, or f z~ + s: the start of one side goes to the end of the other, mirrored to its start.
            let (goal, place) = if is_glide { (to, tile.corner(*b)) } else { (to.neg(), tile.corner(b + 1)) };
            let source = |z: &Gaussian| if is_glide { conjugate(z) } else { z.clone() };
            let Some(inverse) = source(&from).inverse() else { continue };
            let factor = goal.mul(&inverse);
            let shift = place.sub(&factor.mul(&source(tile.corner(*a))));
            let word = match (is_glide, &factor) {
                (true, _) => "glide reflection",
                (false, f) if *f == Gaussian::one() => "translation",
                (false, f) if f.neg() == Gaussian::one() => "half turn",
                _ => "rotation",
            };
            let mut pair = |z: &Gaussian| list_of(&mut named, z);
            let (factor, shift) = (pair(&factor), pair(&shift));
            generators.push(json!({ "sides": [a + 1, b + 1], "kind": word, "factor": factor, "shift": shift, "conjugate": is_glide }));
        }
    }
    let mut points: Vec<Value> = cycles
        .iter()
        .map(|cycle| {
            let corners: Vec<usize> = cycle.corners.iter().map(|k| k + 1).collect();
            json!({ "corners": corners, "angle": number(cycle.angle), "order": cycle.order })
        })
        .collect();
    let halves = tile.pairs.iter().filter(|[a, b]| a == b);
    let mut orders: Vec<u32> = cycles.iter().filter_map(|cycle| cycle.order).filter(|order| *order > 1).collect();
    for [side, _] in halves {
        points.push(json!({ "side": side + 1, "angle": number(TAU / 2.0), "order": 2 }));
        orders.push(2);
    }
    orders.sort_unstable();
    let group = match (orders.as_slice(), tile.glides.is_empty()) {
        ([], true) => "p1",
        ([2, 2, 2, 2], true) => "p2",
        ([2, 4, 4], true) => "p4",
        ([], false) => "pg",
        ([2, 2], false) => "pgg",
        _ => return Answer::none("the orders of the points belong to no group of the plane"),
    };
    named.put("group", json!(group));
    named.put("generators", Value::Array(generators));
    named.put("points", Value::Array(points));
    named.number("area", &(twice / Rational::from(2)));
    named.answer(
        "the angles round every point of the tiling add up to a whole part of a turn: by Poincare's theorem the copies of the polygon tile the \
         plane",
    )
}

fn list_of(named: &mut Named, z: &Gaussian) -> Value {
    let [x, y, _] = named.rounded(&[z.re.clone(), z.im.clone(), Rational::new()]);
    list(&[x, y])
}
