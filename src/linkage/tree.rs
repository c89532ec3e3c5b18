//! Linkages without loops: bodies as a tree, their velocities by recursion and by the path matrix.

use super::rates::{Body, Moving, joint_value, pair};
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::{Linkage, LinkageJoint, Pair};
use crate::kinematics::motion::Motion;
use looproot_calculus::tree::{Tree, Twist, turning};
use looproot_calculus::unit::Analytic;

/// The bodies of a linkage in an order in which every one hangs on an earlier one.
#[derive(Clone, Debug)]
pub struct Hanging {
    /// Bodies by their numbers, without the ground.
    pub bodies: Vec<usize>,
    /// The joint that carries each of them.
    pub joints: Vec<usize>,
    /// The tree.
    pub tree: Tree,
}

/// The tree of a linkage; `None` where it has loops or gears.
#[must_use]
pub fn hanging(linkage: &Linkage) -> Option<Hanging> {
    if linkage.joints.len() + 1 != linkage.bodies.len() || linkage.joints.iter().any(LinkageJoint::is_gear) {
        return None;
    }
    let (mut bodies, mut joints, mut parents) = (Vec::new(), Vec::new(), Vec::new());
    let mut seen = vec![false; linkage.bodies.len()];
    seen[linkage.ground] = true;
    while bodies.len() + 1 < linkage.bodies.len() {
        let next = linkage.joints.iter().position(|joint| seen[joint.of[0]] != seen[joint.of[1]])?;
        let [a, b] = linkage.joints[next].of;
        let (parent, child) = if seen[a] { (a, b) } else { (b, a) };
        parents.push(bodies.iter().position(|body| *body == parent));
        seen[child] = true;
        bodies.push(child);
        joints.push(next);
    }
    Some(Hanging { tree: Tree::new(parents)?, bodies, joints })
}

impl Hanging {
    /// The places of all bodies one after the other, from those of each against the one that carries it, as series in time.
    #[must_use]
    pub fn recursive(&self, linkage: &Linkage, bodies: &[Body]) -> Option<Vec<Motion<Moving>>> {
        let shift = |[x, y]: [f64; 2]| Motion::translation([Moving::constant(x), Moving::constant(y), Moving::zero()]);
        let one = |(child, joint): (&usize, &usize)| {
            let value = joint_value(linkage, bodies, *joint)?;
            let own = &linkage.joints[*joint];
            let [p, q] = own.at.each_ref().map(pair);
            let step = match &own.pair {
                Pair::Revolute => {
                    let (cos, sin) = value.cos_sin_of();
                    Motion::rotation_z(cos, sin)
                }
                Pair::Prismatic { along, turn, length } => {
                    let size = crate::algebra::number::nearest_f64(length);
                    let [x, y] = pair(along).map(|c| value.mul(&Moving::constant(c / size)));
                    let [cos, sin] = pair(turn).map(Moving::constant);
                    Motion::translation([x, y, Moving::zero()]).then_after(&Motion::rotation_z(cos, sin))
                }
                Pair::Gear { .. } => return None,
            };
            let placed = shift(p).then_after(&step).then_after(&shift(q.map(|c| -c)));
            Some(if own.of[1] == *child { placed } else { placed.inverse() })
        };
        let steps: Vec<_> = self.bodies.iter().zip(&self.joints).map(one).collect::<Option<_>>()?;
        self.tree.placed(&steps)
    }

    /// Angular velocity of every body and velocity of its point at the origin of the ground, by one sum over the joints on the
    /// way from the ground.
    #[must_use]
    pub fn explicit(&self, linkage: &Linkage, bodies: &[Body]) -> Option<Vec<Twist<f64>>> {
        let one = |(child, joint): (&usize, &usize)| {
            let rate = joint_value(linkage, bodies, *joint)?.coefficients[1];
            let own = &linkage.joints[*joint];
            let sign = if own.of[1] == *child { rate } else { -rate };
            let base = &bodies[own.of[0]];
            match &own.pair {
                Pair::Revolute => {
                    let [x, y] = base.place(pair(&own.at[0])).map(|part| part.coefficients[0]);
                    Some(turning(&[x, y, 0.0], &[0.0, 0.0, 1.0], &sign))
                }
                Pair::Prismatic { along, length, .. } => {
                    let size = crate::algebra::number::nearest_f64(length);
                    let [x, y] = base.turned(pair(along)).map(|part| part.coefficients[0] * sign / size);
                    Some(([0.0; 3], [x, y, 0.0]))
                }
                Pair::Gear { .. } => None,
            }
        };
        let twists: Vec<_> = self.bodies.iter().zip(&self.joints).map(one).collect::<Option<_>>()?;
        self.tree.twists(&twists)
    }
}
