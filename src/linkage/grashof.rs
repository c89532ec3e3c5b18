//! The links of a four-bar that turn all the way round: Grashof's condition in the plane, and its form on the sphere.

use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::Ring;
use crate::algebra::sort;
use crate::kinematics::linkage::{Gaussian, Linkage, Pair};
use crate::kinematics::motion::{cross, dot};
use crate::kinematics::sphere::SphereLinkage;
use rug::Rational;
use std::cmp::Ordering;

/// The class of a four-bar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grashof {
    /// Comparison of the sum of the shortest and the longest link with the sum of the others; on the sphere, where lengths are
    /// angles,
    pub sum: Ordering,
    /// Crank and rocker as seen from the ground.
    pub class: &'static str,
}

impl Grashof {
    /// The condition in letters: s shortest, l longest, p and q the others.
    #[must_use]
    pub fn condition(&self) -> &'static str {
        match self.sum {
            Ordering::Less => "s+l < p+q",
            Ordering::Equal => "s+l = p+q",
            Ordering::Greater => "s+l > p+q",
        }
    }
}

/// A ring of four bodies and four joints: joints and bodies alternate, the ground first, the joint of the file's first crank next.
fn ring(ground: usize, bodies: usize, of: &[[usize; 2]]) -> Option<([usize; 4], [usize; 4])> {
    if bodies != 4 || of.len() != 4 {
        return None;
    }
    let other = |joint: usize, body: usize| of[joint].iter().find(|end| **end != body).copied();
    let first = (0..4).find(|joint| of[*joint].contains(&ground))?;
    let (mut joints, mut chain) = ([first; 4], [ground; 4]);
    for k in 1..4 {
        chain[k] = other(joints[k - 1], chain[k - 1])?;
        joints[k] = (0..4).find(|joint| of[*joint].contains(&chain[k]) && *joint != joints[k - 1])?;
    }
    let is_closed = other(joints[3], chain[3]) == Some(ground);
    let is_ring = (0..4).all(|k| (0..k).all(|j| joints[j] != joints[k] && chain[j] != chain[k]));
    (is_closed && is_ring).then_some((joints, chain))
}

/// The sign of `sqrt(a) + sqrt(b) - sqrt(c) - sqrt(d)`.
fn compared([a, b, c, d]: [&Rational; 4]) -> Ordering {
    let root = |q: &Rational| if *q == 0 { Some(Enclosure::zero()) } else { Enclosure::of(q).sqrt() };
    let roots = || Some(root(a)?.add(&root(b)?).sub(&root(c)?.add(&root(d)?)));
    if let Some(difference) = roots().filter(|difference| !difference.holds_zero()) {
        return if difference.middle().is_sign_negative() { Ordering::Less } else { Ordering::Greater };
    }
    // Both sides squared, and once more: equal within many digits, they are equal if and only if this holds.
    let apart = Rational::from(a + b) - Rational::from(c + d);
    let (first, second) = (Rational::from(a * b), Rational::from(c * d));
    let middle: Rational = Rational::from(&first + &second) - Rational::from(apart.square_ref()) / 4;
    let is_equal = Rational::from(middle.square_ref()) == Rational::from(&first * &second) * 4;
    if is_equal { Ordering::Equal } else { apart.cmp0() }
}

/// The class of a planar linkage that is a four-bar of revolute joints.
#[must_use]
pub fn planar(linkage: &Linkage) -> Option<Grashof> {
    if linkage.joints.iter().any(|joint| !matches!(joint.pair, Pair::Revolute)) {
        return None;
    }
    let of: Vec<[usize; 2]> = linkage.joints.iter().map(|joint| joint.of).collect();
    let (joints, bodies) = ring(linkage.ground, linkage.bodies.len(), &of)?;
    let at = |joint: usize, body: usize| -> &Gaussian {
        let joint = &linkage.joints[joint];
        &joint.at[usize::from(joint.of[0] != body)]
    };
    let square = |k: usize| {
        let (p, q) = (at(joints[(k + 3) % 4], bodies[k]), at(joints[k], bodies[k]));
        let (x, y) = (Rational::from(&p.re - &q.re), Rational::from(&p.im - &q.im));
        Rational::from(x.square_ref()) + Rational::from(y.square_ref())
    };
    let squares: [Rational; 4] = std::array::from_fn(square);
    let mut order = [0, 1, 2, 3];
    sort::by(&mut order, |a, b| squares[*a].cmp(&squares[*b]));
    let [s, p, q, l] = order.map(|k| &squares[k]);
    let sum = compared([s, l, p, q]);
    // Bodies in the ring: ground, crank, coupler, rocker.
    let class = match (sum, order[0]) {
        (Ordering::Greater, _) => "triple-rocker",
        (Ordering::Equal, _) => "change-point",
        (_, 0) => "double-crank",
        (_, 1) => "crank-rocker",
        (_, 2) => "double-rocker",
        _ => "rocker-crank",
    };
    Some(Grashof { sum, class })
}

/// Cosine and sine of an angle between 0 and pi.
type Side = (Enclosure, Enclosure);

/// Returns whether the joint between the first two of four sides turns all the way round: in its two stretched positions the
/// other two can still be bridged. `None` where a position is just reached, which decides nothing.
fn turns([one, two, three, four]: [&Side; 4]) -> Option<bool> {
    let (cosines, sines) = (|a: &Side, b: &Side| a.0.mul(&b.0), |a: &Side, b: &Side| a.1.mul(&b.1));
    // cos(three - four) >= cos(one - two), and cos(one + two) >= cos(three + four)
    let folded = cosines(three, four).add(&sines(three, four)).sub(&cosines(one, two).add(&sines(one, two)));
    let stretched = cosines(one, two).sub(&sines(one, two)).sub(&cosines(three, four).sub(&sines(three, four)));
    let mut all = true;
    for margin in [folded, stretched] {
        if margin.holds_zero() {
            return None;
        }
        all &= !margin.middle().is_sign_negative();
    }
    Some(all)
}

/// The class of a linkage on the sphere that is a four-bar.
#[must_use]
pub fn spherical(linkage: &SphereLinkage) -> Option<Grashof> {
    let of: Vec<[usize; 2]> = linkage.joints.iter().map(|joint| joint.of).collect();
    let (joints, bodies) = ring(linkage.ground, linkage.bodies.len(), &of)?;
    let side = |k: usize| -> Option<Side> {
        let axis = |joint: usize| {
            let joint = &linkage.joints[joint];
            &joint.at[usize::from(joint.of[0] != bodies[k])]
        };
        let (u, v) = (axis(joints[(k + 3) % 4]), axis(joints[k]));
        let normal = cross(u, v);
        let root = |q: &Rational| if *q == 0 { Some(Enclosure::zero()) } else { Enclosure::of(q).sqrt() };
        let length = root(&Rational::from(&dot(u, u) * &dot(v, v)))?;
        Some((Enclosure::of(&dot(u, v)).over(&length)?, root(&dot(&normal, &normal))?.over(&length)?))
    };
    let [ground, crank, coupler, rocker] = [side(0)?, side(1)?, side(2)?, side(3)?];
    let around = [
        turns([&ground, &crank, &coupler, &rocker]),
        turns([&crank, &coupler, &rocker, &ground]),
        turns([&coupler, &rocker, &ground, &crank]),
        turns([&rocker, &ground, &crank, &coupler]),
    ];
    let [Some(first), Some(second), Some(third), Some(fourth)] = around else {
        return Some(Grashof { sum: Ordering::Equal, class: "change-point" });
    };
    let class = match (first, fourth) {
        (true, true) => "double-crank",
        (true, false) => "crank-rocker",
        (false, true) => "rocker-crank",
        _ if second && third => "double-rocker",
        _ => "triple-rocker",
    };
    let sum = if class == "triple-rocker" { Ordering::Greater } else { Ordering::Less };
    Some(Grashof { sum, class })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_roots_are_compared_exactly() {
        let q = |n: i32| Rational::from(n);
        // 1 + sqrt 8 = sqrt 2 + (1 + sqrt 2) is no sum of two roots; 2 sqrt 2 + 3 sqrt 2 = sqrt 2 + 4 sqrt 2.
        assert_eq!(compared([&q(8), &q(18), &q(2), &q(32)]), Ordering::Equal);
        assert_eq!(compared([&q(8), &q(18), &q(2), &q(33)]), Ordering::Less);
        assert_eq!(compared([&q(9), &q(16), &q(9), &q(9)]), Ordering::Greater);
        assert_eq!(compared([&q(0), &q(16), &q(4), &q(4)]), Ordering::Equal);
    }
}
