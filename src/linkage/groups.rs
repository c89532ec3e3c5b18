//! The groups of a linkage: least sets of clusters that are rigid by count, in the order in which they are solved.
//!
//! A set of k clusters joined by e joints of one freedom is counted as `3 (k - 1) - 2 e`. Dyads are found as triangles;
//! what is left is searched by a pebble game: every cluster has three pebbles, every joint covers two, and the least
//! rigid set of two clusters is what can be reached from them when all free pebbles that can come are at one of them.
//! \[LeeStreinu2008\]

use std::collections::{BTreeMap, BTreeSet};

/// Most clusters of a group with slides or gears: the pencil of a group of L loops has up to C(2L, L) rows.
pub const MOST_CLUSTERS: usize = 13;
/// Most clusters of a group of revolute joints: the angles whose rounding errors boxes allow for, and one at rest.
pub const MOST_IN_BOXES: usize = super::boxes::arc::MOST_ROWS + 1;

/// A group: a rigid set of clusters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// One body of every cluster.
    pub clusters: Vec<usize>,
    /// The joints between them.
    pub joints: Vec<usize>,
    /// The pairs of gears among them.
    pub gears: Vec<usize>,
    /// `3 (k - 1) - 2 e`, less one for every pair of gears: 0, or less where there are more than needed.
    pub count: i64,
}

/// The groups of a linkage, and what they leave.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Groups {
    /// In the order in which they are solved.
    pub list: Vec<Group>,
    /// Freedoms that are left by count, beside the rigid motion of the whole.
    pub freedoms: usize,
}

/// Sets of bodies that are merged one after the other.
#[derive(Clone, Debug)]
pub struct Merged(Vec<usize>);

impl Merged {
    /// Every body by itself.
    #[must_use]
    pub fn new(bodies: usize) -> Self {
        Self((0..bodies).collect())
    }

    /// The body that stands for the set of another one.
    pub fn root(&mut self, body: usize) -> usize {
        let mut root = body;
        while self.0[root] != root {
            self.0[root] = self.0[self.0[root]];
            root = self.0[root];
        }
        root
    }

    /// Merges two sets; false where they are one already.
    pub fn merge(&mut self, one: usize, two: usize) -> bool {
        let (one, two) = (self.root(one), self.root(two));
        self.0[two] = one;
        one != two
    }
}

/// Finds the groups. `joints` holds the two bodies of every joint that is not given; `merged` the bodies that are glued.
#[must_use]
pub fn groups(bodies: usize, joints: &[(usize, [usize; 2])], mut merged: Merged) -> Groups {
    let mut graph = Graph::new(bodies, joints, &mut merged);
    let mut list = Vec::new();
    loop {
        while let Some(group) = graph.small(&mut merged) {
            graph.contract(&group, &mut merged);
            list.push(group);
        }
        let Some(group) = graph.large() else { break };
        graph.contract(&group, &mut merged);
        list.push(group);
    }
    let clusters = graph.around.len();
    let rank = graph.pebbles().rank();
    Groups { list, freedoms: (3 * clusters).saturating_sub(3 + rank) }
}

/// The clusters and the joints between them.
struct Graph {
    /// The neighbours of every cluster, and the joints with each.
    around: BTreeMap<usize, BTreeMap<usize, Vec<usize>>>,
    /// Pairs of neighbours not yet searched for triangles.
    fresh: Vec<(usize, usize)>,
}

impl Graph {
    fn new(bodies: usize, joints: &[(usize, [usize; 2])], merged: &mut Merged) -> Self {
        let mut graph = Self { around: BTreeMap::new(), fresh: Vec::new() };
        for body in 0..bodies {
            graph.around.entry(merged.root(body)).or_default();
        }
        for &(joint, [a, b]) in joints {
            let (a, b) = (merged.root(a), merged.root(b));
            if a != b {
                graph.join(a, b, joint);
                graph.fresh.push((a, b));
            }
        }
        // The first pair of the file is searched first.
        graph.fresh.reverse();
        graph
    }

    fn join(&mut self, a: usize, b: usize, joint: usize) {
        for (a, b) in [(a, b), (b, a)] {
            self.around.entry(a).or_default().entry(b).or_default().push(joint);
        }
    }

    fn joints(&self, a: usize, b: usize) -> &[usize] {
        self.around.get(&a).and_then(|around| around.get(&b)).map_or(&[], Vec::as_slice)
    }

    /// Two clusters with two joints or more, or three clusters each joined to both others.
    fn small(&mut self, merged: &mut Merged) -> Option<Group> {
        while let Some((a, b)) = self.fresh.pop() {
            let (a, b) = (merged.root(a), merged.root(b));
            if a == b {
                continue;
            }
            if self.joints(a, b).len() > 1 {
                return Some(self.group(vec![a, b]));
            }
            let (Some(of_a), Some(of_b)) = (self.around.get(&a), self.around.get(&b)) else { continue };
            let (few, many) = if of_a.len() < of_b.len() { (of_a, of_b) } else { (of_b, of_a) };
            if let Some(third) = few.keys().find(|third| many.contains_key(third)) {
                let third = *third;
                self.fresh.push((a, b));
                return Some(self.group(vec![a, b, third]));
            }
        }
        None
    }

    fn group(&self, mut clusters: Vec<usize>) -> Group {
        clusters.sort_unstable();
        let mut joints = Vec::new();
        for (k, a) in clusters.iter().enumerate() {
            for b in &clusters[..k] {
                joints.extend_from_slice(self.joints(*a, *b));
            }
        }
        joints.sort_unstable();
        let size = |list: &Vec<usize>| i64::try_from(list.len()).unwrap_or(i64::MAX / 4);
        let count = 3 * (size(&clusters) - 1) - 2 * size(&joints);
        Group { clusters, joints, gears: Vec::new(), count }
    }

    /// Makes one cluster of a group.
    fn contract(&mut self, group: &Group, merged: &mut Merged) {
        let Some((&first, rest)) = group.clusters.split_first() else { return };
        let mut outside: Vec<(usize, Vec<usize>)> = Vec::new();
        for cluster in rest {
            merged.merge(first, *cluster);
            for (other, joints) in self.around.remove(cluster).unwrap_or_default() {
                if let Some(around) = self.around.get_mut(&other) {
                    around.remove(cluster);
                }
                if !group.clusters.contains(&other) {
                    outside.push((other, joints));
                }
            }
        }
        if let Some(around) = self.around.get_mut(&first) {
            for cluster in rest {
                around.remove(cluster);
            }
        }
        for (other, joints) in outside {
            for joint in joints {
                self.join(first, other, joint);
            }
            self.fresh.push((first, other));
        }
    }

    fn pebbles(&self) -> Pebbles {
        let mut pebbles = Pebbles::new(self.around.keys().copied());
        for (a, around) in &self.around {
            for (b, joints) in around.range(a + 1..) {
                for _ in 0..2 * joints.len() {
                    pebbles.cover(*a, *b);
                }
            }
        }
        pebbles
    }

    /// The least rigid set that is neither a pair nor a triangle.
    fn large(&self) -> Option<Group> {
        let mut pebbles = self.pebbles();
        let mut best: Option<BTreeSet<usize>> = None;
        for (a, around) in &self.around {
            for b in around.range(a + 1..).map(|(b, _)| b) {
                pebbles.gather(*a, &[]);
                let most = best.as_ref().map_or(usize::MAX, BTreeSet::len);
                if let Some(set) = pebbles.rigid(*a, *b, most) {
                    best = Some(set);
                }
            }
        }
        best.map(|set| self.group(set.into_iter().collect()))
    }
}

/// A pebble game of three pebbles a cluster.
struct Pebbles {
    /// The heads of the edges that the pebbles of every cluster cover.
    out: BTreeMap<usize, Vec<usize>>,
    covered: usize,
}

impl Pebbles {
    fn new(clusters: impl Iterator<Item = usize>) -> Self {
        Self { out: clusters.map(|cluster| (cluster, Vec::new())).collect(), covered: 0 }
    }

    /// Returns the number of covered edges: the rank of the joints by count.
    fn rank(&self) -> usize {
        self.covered
    }

    fn free(&self, cluster: usize) -> usize {
        3 - self.out.get(&cluster).map_or(3, |out| out.len().min(3))
    }

    /// Brings free pebbles to a cluster from others than the `kept` ones until it has three or none comes any more.
    fn gather(&mut self, to: usize, kept: &[usize]) {
        while self.free(to) < 3 && self.bring(to, kept) {}
    }

    /// Brings one free pebble along a path and turns the path round.
    fn bring(&mut self, to: usize, kept: &[usize]) -> bool {
        let mut from: BTreeMap<usize, usize> = BTreeMap::new();
        let mut open = vec![to];
        let mut seen: BTreeSet<usize> = kept.iter().copied().chain([to]).collect();
        while let Some(cluster) = open.pop() {
            let heads = self.out.get(&cluster).cloned().unwrap_or_default();
            for head in heads {
                if !seen.insert(head) {
                    continue;
                }
                from.insert(head, cluster);
                if self.free(head) > 0 {
                    let mut end = head;
                    while let Some(&start) = from.get(&end) {
                        if let Some(out) = self.out.get_mut(&start)
                            && let Some(at) = out.iter().position(|h| *h == end)
                        {
                            out.remove(at);
                        }
                        self.out.entry(end).or_default().push(start);
                        end = start;
                    }
                    return true;
                }
                open.push(head);
            }
        }
        false
    }

    /// Covers an edge where four pebbles can come to its ends.
    fn cover(&mut self, a: usize, b: usize) {
        self.gather(a, &[]);
        while self.free(a) + self.free(b) < 4 && self.bring(b, &[a]) {}
        if self.free(a) + self.free(b) >= 4 {
            let (tail, head) = if self.free(a) > 0 { (a, b) } else { (b, a) };
            self.out.entry(tail).or_default().push(head);
            self.covered += 1;
        }
    }

    /// Returns the least rigid set that holds two clusters, after all possible pebbles were moved to the first; `None` where
    /// there is none of fewer clusters than `most`.
    fn rigid(&self, a: usize, b: usize, most: usize) -> Option<BTreeSet<usize>> {
        let mut seen = BTreeSet::from([a, b]);
        let mut open = vec![a, b];
        while let Some(cluster) = open.pop() {
            if cluster != a && self.free(cluster) > 0 || seen.len() >= most {
                return None;
            }
            for head in self.out.get(&cluster).into_iter().flatten() {
                if seen.insert(*head) {
                    open.push(*head);
                }
            }
        }
        (self.free(a) == 3 && seen.len() < most).then_some(seen)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(bodies: usize, pairs: &[[usize; 2]]) -> Vec<(Vec<usize>, usize)> {
        let joints: Vec<(usize, [usize; 2])> = pairs.iter().copied().enumerate().collect();
        let groups = groups(bodies, &joints, Merged::new(bodies));
        groups.list.into_iter().map(|group| (group.clusters.clone(), group.joints.len())).collect()
    }

    #[test]
    fn a_triangle_is_a_dyad_and_three_legs_are_a_triad() {
        assert_eq!(found(3, &[[0, 1], [1, 2], [2, 0]]), [(vec![0, 1, 2], 3)]);
        let legs = [[0, 1], [1, 4], [0, 2], [2, 4], [0, 3], [3, 4]];
        assert_eq!(found(5, &legs), [(vec![0, 1, 2, 3, 4], 6)]);
    }

    #[test]
    fn a_four_bar_has_a_freedom_and_no_group() {
        let joints: Vec<(usize, [usize; 2])> = [[0, 1], [1, 2], [2, 3], [3, 0]].into_iter().enumerate().collect();
        let groups = groups(4, &joints, Merged::new(4));
        assert!(groups.list.is_empty());
        assert_eq!(groups.freedoms, 1);
    }

    #[test]
    fn a_long_chain_of_dyads_is_quick() {
        // Every new cluster stands on the two before it.
        let pairs: Vec<[usize; 2]> = (0..5000).flat_map(|k| [[k, k + 1], [k, k + 2]]).chain([[5000, 5001]]).collect();
        assert!(!found(5002, &pairs).is_empty());
    }
}
