//! Parts of a linkage that decide about a body: groups on which another group stands, and the least part of one freedom
//! that moves a body.

use super::assembly::{Link, Solution};
use super::groups::{Group, Merged};
use crate::algebra::sort;
use crate::kinematics::linkage::Linkage;
use std::collections::BTreeSet;

/// Clusters among which the least part that moves a body is searched for.
const MOST_CLUSTERS: usize = 16;

/// The groups on which one of a list stands, by their numbers, itself the last: those that hold together the bodies at which
/// its joints are, and the body `base` where that belongs to it. `merged` is what inputs glue.
#[must_use]
pub fn foundations(linkage: &Linkage, list: &[Solution], number: usize, base: usize, merged: &Merged) -> Vec<usize> {
    let ends = |group: &Solution| -> BTreeSet<usize> {
        group.joints.iter().flat_map(|joint| linkage.joints[*joint].of).collect()
    };
    // Sets of bodies that must be held together.
    let mut required: Vec<BTreeSet<usize>> = Vec::new();
    let require = |group: &Solution, with: &BTreeSet<usize>, required: &mut Vec<BTreeSet<usize>>| {
        for cluster in &group.bodies {
            let own: BTreeSet<usize> = cluster.iter().copied().filter(|body| with.contains(body)).collect();
            required.push(own);
        }
    };
    let mut first = ends(&list[number]);
    first.insert(base);
    require(&list[number], &first, &mut required);
    let mut needed = vec![number];
    for earlier in (0..number).rev() {
        // The clusters after the inputs and the groups before this one are merged.
        let mut before = merged.clone();
        for group in &list[..earlier] {
            let mut bodies = group.bodies.iter().flatten();
            if let Some(one) = bodies.next() {
                for other in bodies {
                    before.merge(*one, *other);
                }
            }
        }
        let mut split = |set: &BTreeSet<usize>| {
            let mut roots: Vec<usize> = set.iter().map(|body| before.root(*body)).collect();
            roots.sort_unstable();
            roots.dedup();
            roots.len() > 1
        };
        let (apart, mut whole): (Vec<BTreeSet<usize>>, Vec<BTreeSet<usize>>) =
            required.into_iter().partition(|set| split(set));
        if !apart.is_empty() {
            needed.push(earlier);
            let mut with = ends(&list[earlier]);
            with.extend(apart.into_iter().flatten());
            require(&list[earlier], &with, &mut whole);
        }
        required = whole;
    }
    needed.reverse();
    needed
}

/// The group that some joints make: their bodies and they.
#[must_use]
pub fn group_of(linkage: &Linkage, joints: Vec<usize>, merged: &mut Merged) -> Group {
    let bodies: BTreeSet<usize> =
        joints.iter().flat_map(|joint| linkage.joints[*joint].of).map(|body| merged.root(body)).collect();
    let clusters: Vec<usize> = bodies.into_iter().collect();
    let number = |length: usize| i64::try_from(length).unwrap_or(i64::MAX / 8);
    let count = 3 * (number(clusters.len()) - 1) - 2 * number(joints.len());
    Group { clusters, joints, gears: Vec::new(), count }
}

/// Returns the least part of one freedom, by count, that holds two bodies: the second moves against the first on a curve. `None`
/// where there is none, or where there are more clusters than are searched.
#[must_use]
pub fn least_mover(linkage: &Linkage, joints: &[Link], merged: &mut Merged, base: usize, body: usize) -> Option<Group> {
    let (base, body) = (merged.root(base), merged.root(body));
    let ends: Vec<(usize, [usize; 2])> =
        joints.iter().map(|(joint, of)| (*joint, of.map(|body| merged.root(body)))).collect();
    let others: BTreeSet<usize> =
        ends.iter().flat_map(|(_, of)| *of).filter(|end| *end != base && *end != body).collect();
    let others: Vec<usize> = others.into_iter().collect();
    if base == body || others.len() + 2 > MOST_CLUSTERS {
        return None;
    }
    let mut sets: Vec<u32> = (0..1_u32 << others.len()).collect();
    sort::by_key(&mut sets, |set| set.count_ones());
    sets.into_iter().find_map(|set| {
        let is_in = |end: usize| {
            let place = others.iter().position(|other| *other == end);
            end == base || end == body || place.is_some_and(|place| set >> place & 1 == 1)
        };
        let kept = ends.iter().filter(|(_, of)| of[0] != of[1] && of.iter().all(|end| is_in(*end)));
        let kept: Vec<usize> = kept.map(|(joint, _)| *joint).collect();
        let clusters = set.count_ones() as usize + 2;
        // Connected by count: every cluster is an end of a joint.
        let group = (3 * (clusters - 1) == 2 * kept.len() + 1).then(|| group_of(linkage, kept, merged))?;
        (group.clusters.len() == clusters).then_some(group)
    })
}
