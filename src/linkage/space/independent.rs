//! Parts of a linkage that only the ground joins: each is solved by itself, and the assemblies are all combinations.

use super::answer::{Coordinate, SpaceMode};
use super::clusters::open_joints;
use super::equations::System;
use super::values::finished;
use crate::kinematics::motion::Motion;
use crate::kinematics::space::{SpaceGiven, SpaceLinkage};
use crate::linkage::groups::Merged;

/// Returns the bodies of each part behind those of the ground; a single list of all where the linkage has one part.
pub(super) fn parts(linkage: &SpaceLinkage, given: &[SpaceGiven], system: &System) -> Vec<Vec<usize>> {
    let list = &system.clusters;
    let bodies = |k: usize| list[k].bodies.iter().map(|(body, _)| *body);
    let mut merged = Merged::new(list.len());
    for (_, [one, two]) in open_joints(linkage, given, list) {
        if one != 0 && two != 0 {
            merged.merge(one, two);
        }
    }
    let mut parts: Vec<(usize, Vec<usize>)> = Vec::new();
    for k in 1..list.len() {
        let root = merged.root(k);
        match parts.iter_mut().find(|(own, _)| *own == root) {
            Some((_, part)) => part.extend(bodies(k)),
            None => parts.push((root, bodies(0).chain(bodies(k)).collect())),
        }
    }
    parts.into_iter().map(|(_, part)| part).collect()
}

/// Returns all combinations of the assemblies of parts, each with the bodies that are placed in it.
pub(super) fn combined(
    linkage: &SpaceLinkage,
    given: &[SpaceGiven],
    system: &System,
    parts: &[(Vec<usize>, Vec<SpaceMode>)],
) -> Vec<SpaceMode> {
    /// The places of the bodies so far, whether they are real, the multiplicity and the radius.
    type Begun = (Vec<Option<Motion<Coordinate>>>, bool, usize, f64);
    let mut all: Vec<Begun> = vec![(vec![None; linkage.bodies.len()], true, 1, f64::EPSILON)];
    for (within, modes) in parts {
        let with = |(bodies, is_real, times, radius): &Begun, mode: &SpaceMode| -> Begun {
            let mut bodies = bodies.clone();
            for body in within {
                bodies[*body] = Some(mode.bodies[*body].clone());
            }
            (bodies, *is_real && mode.real, times * mode.multiplicity, radius.max(mode.radius))
        };
        all = all.iter().flat_map(|begun| modes.iter().map(move |mode| with(begun, mode))).collect();
    }
    all.into_iter()
        .map(|(bodies, is_real, times, radius)| finished(linkage, given, system, bodies, is_real, times, radius))
        .collect()
}
