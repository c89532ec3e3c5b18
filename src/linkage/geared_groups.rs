//! Groups of linkages with gears: least sets of clusters that are rigid by count when every pair of gears takes one freedom.
//!
//! Groups without gears come first, as they are rigid by themselves. What is left is searched in the order of the number of
//! clusters, as gears join three bodies and no pebble game counts them.

use super::groups::{Group, Groups, Merged, groups};
use super::straight::unite;
use crate::algebra::sort;
use crate::error::{Error, Result};
use std::collections::{BTreeSet, HashMap};

/// Most clusters among which a group with gears is searched: 2^16 sets are searched in a fraction of a second.
const MOST_CLUSTERS: usize = 16;

/// A pair of gears: the carrier, the first and the second body.
pub type Gear = (usize, [usize; 3]);

/// Finds the groups of a linkage with these joints and gears.
///
/// # Errors
/// For more clusters than are searched.
pub fn geared_groups(
    bodies: usize,
    joints: &[(usize, [usize; 2])],
    gears: &[Gear],
    mut merged: Merged,
) -> Result<Groups> {
    let mut list: Vec<Group> = Vec::new();
    let mut open = gears.to_vec();
    loop {
        let found = groups(bodies, joints, merged.clone());
        for group in &found.list {
            unite(&mut merged, group);
        }
        list.extend(found.list);
        if open.is_empty() {
            return Ok(Groups { list, freedoms: found.freedoms });
        }
        let Some(group) = least(bodies, joints, &open, &mut merged)? else {
            return Ok(Groups { list, freedoms: found.freedoms.saturating_sub(open.len()) });
        };
        open.retain(|(gear, _)| !group.gears.contains(gear));
        unite(&mut merged, &group);
        list.push(group);
    }
}

/// Returns the least set of clusters that holds gears, is connected by joints and is rigid by count.
fn least(bodies: usize, joints: &[(usize, [usize; 2])], gears: &[Gear], merged: &mut Merged) -> Result<Option<Group>> {
    let roots: BTreeSet<usize> = (0..bodies).map(|body| merged.root(body)).collect();
    let place: HashMap<usize, usize> = roots.iter().enumerate().map(|(k, root)| (*root, k)).collect();
    let mut bit = |body: usize| 1_u32 << place.get(&merged.root(body)).copied().unwrap_or(0);
    if roots.len() > MOST_CLUSTERS {
        let message = format!("gears among {} bodies that move, at most {MOST_CLUSTERS} are searched", roots.len());
        return Err(Error::Unsupported(message));
    }
    let links: Vec<(usize, u32)> = joints.iter().map(|(joint, [a, b])| (*joint, bit(*a) | bit(*b))).collect();
    let wheels: Vec<(usize, u32)> =
        gears.iter().map(|(gear, of)| (*gear, of.iter().fold(0, |set, body| set | bit(*body)))).collect();
    let within = |list: &[(usize, u32)], set: u32| -> Vec<usize> {
        list.iter().filter(|(_, of)| of & !set == 0).map(|(number, _)| *number).collect()
    };
    let mut sets: Vec<u32> = (1..1_u32 << roots.len()).collect();
    sort::by_key(&mut sets, |set| set.count_ones());
    let size = |count: usize| i64::try_from(count).unwrap_or(i64::MAX / 8);
    for set in sets {
        let own_gears = within(&wheels, set);
        if own_gears.is_empty() {
            continue;
        }
        let inner: Vec<(usize, u32)> =
            links.iter().copied().filter(|(_, of)| of & !set == 0 && of.count_ones() == 2).collect();
        let count = 3 * (i64::from(set.count_ones()) - 1) - 2 * size(inner.len()) - size(own_gears.len());
        if count > 0 || !is_connected(set, &inner) {
            continue;
        }
        let clusters = roots.iter().enumerate().filter(|(k, _)| set >> k & 1 == 1).map(|(_, root)| *root).collect();
        let joints = inner.into_iter().map(|(joint, _)| joint).collect();
        return Ok(Some(Group { clusters, joints, gears: own_gears, count }));
    }
    Ok(None)
}

/// Returns whether joints connect all clusters of a set.
fn is_connected(set: u32, links: &[(usize, u32)]) -> bool {
    let mut reached = set & set.wrapping_neg();
    loop {
        let more = links.iter().filter(|(_, of)| of & reached != 0).fold(reached, |all, (_, of)| all | of);
        if more == reached {
            return reached == set;
        }
        reached = more;
    }
}
