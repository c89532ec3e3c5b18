//! Loops whose six unknown joints are dependent in every position: why they are, and the proof that no real configuration of an arm
//! comes near a pose.
//!
//! Such an arm reaches a set of poses of a lower dimension, which rounding alone leaves: that no configuration closes the loop exactly
//! says nothing of those that close it within the tolerance.
//!
//! Let a configuration reach a pose P' that differs from the pose P by an angle a and a way d. The closure equations compare
//! lines with a marked point at two places of the loop. At that configuration one of them is moved by a displacement
//! conjugate to `P^-1 P'`: its direction by a, its point by `d + a L`, where L is the sum of all links, which no point of
//! the loop exceeds. The coordinates of the line are at most cubic, and change by what [`miss`] says.

use super::single_loop::{SixUnknowns, closing_transformation};
use crate::algebra::enclosure::Enclosure;
use crate::algebra::interval::Interval;
use crate::assembly::AxisTriple;
use crate::catalogue::entry::Case;
use crate::elimination::coordinate_ring::Plan;
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{ClosedLoop, Layout, OpenLoop};
use crate::kinematics::motion::Motion;
use crate::kinematics::tolerance::Tolerance;

/// Why six joints are dependent, where two triples of their axes say it.
pub(super) fn dependent(chain: &Chain, layout: &Layout, triples: &[AxisTriple]) -> String {
    let [one, two] = triples else { return String::new() };
    let joints = chain.variables();
    let variables = layout.joint_variables();
    let name = |triple: &AxisTriple| {
        let joint = |k: usize| variables[triple.first + k].and_then(|v| joints.get(v)).map_or(0, |own| own.joint);
        let how = if triple.parallel { "are parallel" } else { "meet in a point" };
        format!("the axes of joints {}, {}, {} {how}", joint(0), joint(1), joint(2))
    };
    format!("; {} and {}: their six screws are dependent in every position", name(one), name(two))
}

/// A bound of 1 up to which it is a contradiction: rounding of the sums that lead to it is far below the other half.
const CONTRADICTION: f64 = 0.5;

/// Returns how much a closure equation is off at a configuration within the tolerance.
fn miss(links: f64, tolerance: Tolerance) -> f64 {
    let turned = tolerance.angle;
    let moved = tolerance.length + turned * links;
    // The moved point is farther away than the links reach, by this at most: terms of second order count as well.
    let links = links + moved;
    // Of the direction, of the moment and `p . l`, and of `(p . p) l - 2 (p . l) p`, the largest of all.
    let coordinates = [turned, moved + links * turned, 6.0 * links * moved + 3.0 * links * links * turned];
    coordinates.into_iter().fold(2.0 * links * moved, f64::max)
}

fn length(motion: &Motion<Enclosure>) -> f64 {
    motion.translation.iter().map(|x| Interval::from(x).magnitude()).sum()
}

impl SixUnknowns {
    /// Returns whether it is proved that no real configuration reaches the pose or closes the loop of a case within the tolerance, by
    /// a plan of its closure equations that leads to a contradiction.
    pub(super) fn is_clear(&self, chain: &Chain, case: &Case, plan: &Plan, tolerance: Tolerance) -> bool {
        let Ok(Some(closed)) = self.enclosed(chain, case) else { return false };
        let Ok(Some(open)): Result<Option<OpenLoop<Enclosure>>, _> = chain.try_open_loop(&self.layout) else {
            return false;
        };
        let Ok(closing) = closing_transformation(case) else { return false };
        let ends = [&open.before_gap, &closing, &open.after_gap];
        let links: f64 = open.constants.iter().chain(ends).map(length).sum();
        let interval = |motion: Motion<Enclosure>| motion.map(|x| Some(Interval::from(x)));
        let Some(constants) = closed.constants.into_iter().map(interval).collect::<Option<Vec<_>>>() else {
            return false;
        };
        let Ok(constants) = constants.try_into() else { return false };
        let closed = ClosedLoop { variables: closed.variables, constants };
        plan.one_off(&closed, miss(links, tolerance)).is_some_and(|bound| bound < CONTRADICTION)
    }
}
