//! The velocities of a group of revolute joints while all that it stands on is at rest.
//!
//! A cluster that turns with the rate w about the origin of the plane moves the point z of a joint with `i w z`. Round every cycle of the
//! clusters the motions of the joints between them add up to nothing: `sum of i w_c (z_out - z_in) = 0`, two real equations for every
//! cycle. The group has as many rates as equations, and other velocities than none where their determinant is zero.

use super::assembly::Solution;
use super::equations::Closure;
use super::real_system::{Form, constant, turned};
use super::state::{State, number};
use crate::algebra::groebner::Equation;
use crate::algebra::minors::determinant_by_minors;
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::Linkage;

/// The determinant of the rates of a group, as a polynomial in cosines and sines of all classes; `None` for joints that are no revolute
/// ones, and for other numbers of rates than equations.
pub(super) fn determinant_of(linkage: &Linkage, part: &Solution, state: &State, closure: &Closure) -> Option<Equation> {
    let cluster = |body: usize| part.bodies.iter().position(|bodies| bodies.contains(&body));
    let ends: Vec<([usize; 2], Form)> = part
        .joints
        .iter()
        .map(|joint| {
            let of = linkage.joints[*joint].of;
            Some(([cluster(of[0])?, cluster(of[1])?], place(linkage, *joint, state, closure)?))
        })
        .collect::<Option<_>>()?;
    // The way of joints from the first cluster to every other one.
    let mut ways: Vec<Option<Vec<usize>>> = vec![None; part.bodies.len()];
    *ways.first_mut()? = Some(Vec::new());
    let mut tree = Vec::new();
    while let Some(next) = (0..ends.len()).find(|k| ways[ends[*k].0[0]].is_some() != ways[ends[*k].0[1]].is_some()) {
        let [a, b] = ends[next].0;
        let (from, to) = if ways[a].is_some() { (a, b) } else { (b, a) };
        let mut way = ways[from].clone()?;
        way.push(next);
        ways[to] = Some(way);
        tree.push(next);
    }
    let mut rows = Vec::new();
    for closing in (0..ends.len()).filter(|k| !tree.contains(k)) {
        // Out along one way, across the joint, and back along the other.
        let [a, b] = ends[closing].0;
        let (out, back) = (ways[a].as_ref()?, ways[b].as_ref()?);
        let mut sums = vec![Form::zero(); part.bodies.len()];
        let mut here = 0;
        for joint in out.iter().copied().chain([closing]).chain(back.iter().rev().copied()) {
            let ([one, two], at) = &ends[joint];
            let next = if *one == here { *two } else { *one };
            sums[here] = sums[here].add(at);
            sums[next] = sums[next].sub(at);
            here = next;
        }
        let rates = sums.iter().skip(1);
        let (re, im): (Vec<Equation>, Vec<Equation>) = rates.map(|sum| (sum.re.clone(), sum.im.clone())).unzip();
        rows.extend([re, im]);
    }
    let is_square = rows.len() + 1 == part.bodies.len();
    is_square.then(|| determinant_by_minors(&rows))
}

/// The place of a revolute joint of a linkage without slides, against the ground.
fn place(linkage: &Linkage, joint: usize, state: &State, closure: &Closure) -> Option<Form> {
    let joint = &linkage.joints[joint];
    if joint.is_prismatic() || joint.is_gear() {
        return None;
    }
    let traced = closure.traced(state, linkage.ground, joint.of[0], &number(&joint.at[0]))?;
    let exact = traced.exact()?;
    let terms = exact.cycles.last()?.iter().enumerate();
    Some(terms.fold(Form::zero(), |sum, (class, c)| sum.add(&constant(&c.z).mul(&turned(class, 1)))))
}
