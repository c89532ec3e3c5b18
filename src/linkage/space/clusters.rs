//! Bodies that are one by what is given, and the least sets of them that are rigid by count.

use crate::algebra::sort;
use crate::error::{Error, Result};
use crate::kinematics::motion::Motion;
use crate::kinematics::space::{Known, SpaceGiven, SpaceLinkage, SpacePair};
use crate::linkage::groups::Merged;
use rug::Rational;

/// Most clusters among which groups are searched: 2^14 sets are searched in no time.
const MOST_CLUSTERS: usize = 14;

/// Bodies that are one by what is given.
#[derive(Clone, Debug)]
pub struct Cluster {
    /// The bodies, each with its place in the cluster.
    pub bodies: Vec<(usize, Motion<Rational>)>,
    /// Whether it is a rod: its only joints are two spherical ones, about which it may spin.
    pub is_rod: bool,
}

/// A group: clusters, by their bodies, that are rigid by count.
#[derive(Clone, Debug)]
pub struct Group {
    /// The bodies of its clusters, as they were before it was solved.
    pub bodies: Vec<Vec<usize>>,
}

/// The clusters that what is given makes of these bodies, that of the first one in front, with its coordinates.
pub fn clusters(linkage: &SpaceLinkage, given: &[SpaceGiven], within: &[usize]) -> Result<Vec<Cluster>> {
    let single = |body: &usize| Cluster { bodies: vec![(*body, Motion::identity())], is_rod: false };
    let mut list: Vec<Cluster> = within.iter().map(single).collect();
    for one in given.iter().filter(|one| one.of.iter().all(|body| within.contains(body))) {
        let Known::Motion(known) = &one.known else { continue };
        let place = |body: usize| {
            let found = list.iter().enumerate().find_map(|(k, cluster)| {
                cluster.bodies.iter().find(|(own, _)| *own == body).map(|(_, motion)| (k, motion.clone()))
            });
            found.ok_or_else(|| Error::Invalid("found an input of a body that is not there".to_owned()))
        };
        let ((a, first), (b, second)) = (place(one.of[0])?, place(one.of[1])?);
        if a == b {
            let names = one.of.map(|body| linkage.bodies[body].name.as_str());
            let message = format!(
                "found an input between {} and {}, which other inputs hold together already; expected inputs that are independent",
                names[0], names[1]
            );
            return Err(Error::Invalid(message));
        }
        // From the cluster of the second body to that of the first; the one in front keeps its coordinates.
        let across = first.then_after(known).then_after(&second.inverse());
        let (kept, gone, across) = if b == 0 { (b, a, across.inverse()) } else { (a, b, across) };
        let moved = std::mem::take(&mut list[gone].bodies);
        let moved = moved.into_iter().map(|(body, motion)| (body, across.then_after(&motion)));
        list[kept].bodies.extend(moved);
        list.remove(gone);
    }
    for k in 1..list.len() {
        list[k].is_rod = is_rod(linkage, given, within, &list, k);
    }
    Ok(list)
}

/// The cluster of a body.
#[must_use]
pub fn home(list: &[Cluster], body: usize) -> Option<usize> {
    list.iter().position(|cluster| cluster.bodies.iter().any(|(own, _)| *own == body))
}

/// The joints between different clusters whose values are not given, with their clusters.
#[must_use]
pub fn open_joints(linkage: &SpaceLinkage, given: &[SpaceGiven], list: &[Cluster]) -> Vec<(usize, [usize; 2])> {
    let is_given =
        |joint: usize| given.iter().any(|one| one.joint == Some(joint) && matches!(one.known, Known::Motion(_)));
    let joints = linkage.joints.iter().enumerate().filter(|(number, _)| !is_given(*number));
    joints.filter_map(|(number, joint)| Some((number, [home(list, joint.of[0])?, home(list, joint.of[1])?]))).collect()
}

fn is_rod(linkage: &SpaceLinkage, given: &[SpaceGiven], within: &[usize], list: &[Cluster], k: usize) -> bool {
    // A body with a joint to one outside of the part is none: that joint may hold it.
    let whole = |body: usize| {
        linkage
            .joints
            .iter()
            .filter(|joint| joint.of.contains(&body))
            .all(|joint| joint.of.iter().all(|other| within.contains(other)))
    };
    let own: Vec<(usize, [usize; 2])> =
        open_joints(linkage, given, list).into_iter().filter(|(_, of)| of.contains(&k)).collect();
    let ends: Vec<usize> = own
        .iter()
        .filter(|(joint, of)| of[0] != of[1] && linkage.joints[*joint].pair == SpacePair::Spherical)
        .map(|(_, of)| if of[0] == k { of[1] } else { of[0] })
        .collect();
    // Two rods in a row are none: their common point is free.
    let is_plain = |other: usize| other == 0 || !list[other].is_rod;
    own.len() == 2 && ends.len() == 2 && ends.into_iter().all(is_plain) && list[k].bodies.iter().all(|(b, _)| whole(*b))
}

/// The freedoms that are left by count, beside the motion of the whole; negative where there are more conditions than needed.
#[must_use]
pub fn freedoms(linkage: &SpaceLinkage, given: &[SpaceGiven], list: &[Cluster]) -> i64 {
    let size = |count: usize| i64::try_from(count).unwrap_or(i64::MAX / 64);
    let count = list.iter().filter(|cluster| !cluster.is_rod).count();
    let joints = open_joints(linkage, given, list);
    let taken = joints.iter().map(|(joint, of)| conditions(linkage, given, list, *joint, *of)).sum::<usize>();
    let rods = list.len() - count;
    6 * (size(count) - 1) - size(taken) - size(rods)
}

/// The conditions of a joint, those at rods left out.
fn conditions(linkage: &SpaceLinkage, given: &[SpaceGiven], list: &[Cluster], joint: usize, of: [usize; 2]) -> usize {
    if of.iter().any(|k| list[*k].is_rod) {
        return 0;
    }
    let is_given = given.iter().any(|one| one.joint == Some(joint));
    linkage.joints[joint].pair.conditions() + usize::from(is_given)
}

/// The groups in the order in which they can be solved, with the bodies that are one after each of them.
#[must_use]
pub fn groups(linkage: &SpaceLinkage, given: &[SpaceGiven], list: &[Cluster]) -> Vec<(Group, Vec<usize>)> {
    let all = || -> Vec<usize> { list.iter().flat_map(|c| c.bodies.iter().map(|(body, _)| *body)).collect() };
    let bodies_of = |k: usize| -> Vec<usize> { list[k].bodies.iter().map(|(body, _)| *body).collect() };
    let whole = || vec![(Group { bodies: (0..list.len()).map(bodies_of).collect() }, all())];
    if list.len() < 2 {
        return Vec::new();
    }
    if list.len() > MOST_CLUSTERS {
        return whole();
    }
    let joints = open_joints(linkage, given, list);
    let mut merged = Merged::new(list.len());
    let mut found = Vec::new();
    loop {
        let mut roots: Vec<usize> = (0..list.len()).map(|k| merged.root(k)).collect();
        roots.dedup();
        roots.sort_unstable();
        roots.dedup();
        if roots.len() < 2 {
            return found;
        }
        let mut of = |k: usize| roots.binary_search(&merged.root(k)).map_or(0, |place| 1_u32 << place);
        let links: Vec<(usize, u32)> = joints
            .iter()
            .filter(|(_, ends)| ends.iter().all(|k| !list[*k].is_rod))
            .map(|(joint, ends)| (conditions(linkage, given, list, *joint, *ends), of(ends[0]) | of(ends[1])))
            .collect();
        // A rod is one condition between the clusters at its ends, and belongs to no set by itself.
        let rods: Vec<(usize, u32)> = (0..list.len())
            .filter(|k| list[*k].is_rod)
            .map(|k| {
                let ends = joints.iter().filter(|(_, ends)| ends.contains(&k));
                (k, ends.flat_map(|(_, ends)| *ends).filter(|end| *end != k).fold(0, |set, end| set | of(end)))
            })
            .collect();
        let rod_bits = (0..list.len()).filter(|k| list[*k].is_rod).fold(0, |set, k| set | of(k));
        let mut sets: Vec<u32> =
            (1..1_u32 << roots.len()).filter(|set| set & rod_bits == 0 && set.count_ones() > 1).collect();
        sort::by_key(&mut sets, |set| set.count_ones());
        let rigid = sets.into_iter().find(|set| {
            let inner = |of: u32| of & !set == 0 && of.count_ones() == 2;
            let taken = links.iter().filter(|(_, of)| inner(*of)).map(|(taken, _)| *taken).sum::<usize>()
                + rods.iter().filter(|(_, of)| inner(*of)).count();
            i64::from(6 * (set.count_ones() - 1)) <= i64::try_from(taken).unwrap_or(i64::MAX)
        });
        let Some(set) = rigid else {
            // What is held by special shapes alone, or moves, is one system.
            return if found.is_empty() { whole() } else { found.into_iter().chain(whole()).collect() };
        };
        let with_rods = set | rods.iter().filter(|(_, ends)| ends & !set == 0).fold(0, |bits, (k, _)| bits | of(*k));
        let chosen: Vec<usize> = (0..roots.len()).filter(|k| with_rods >> k & 1 == 1).map(|k| roots[k]).collect();
        let bodies = chosen.iter().map(|root| {
            (0..list.len()).filter(|k| merged.root(*k) == *root).flat_map(bodies_of).collect::<Vec<usize>>()
        });
        let group = Group { bodies: bodies.collect() };
        let mut held: Vec<usize> = group.bodies.iter().flatten().copied().collect();
        held.sort_unstable();
        for pair in chosen.windows(2) {
            merged.merge(pair[0], pair[1]);
        }
        found.push((group, held));
    }
}
