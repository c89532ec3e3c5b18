//! Chooses the tip link of a robot description that names none.

use super::robot_chain::LONGEST;
use super::robot_tree::Tree;
use super::scope::Scope;
use crate::error::Result;
use std::collections::{BTreeMap, HashSet};

/// Number of moving joints of an arm whose tip is sought: fewer are a head or a wheel, more are two chains in one.
const JOINTS: std::ops::RangeInclusive<usize> = 4..=7;

/// Common words for the tip of an arm, the best one first.
const WORDS: [&str; 7] = ["tool0", "tcp", "ee", "end_effector", "tool", "flange", "tip"];

/// A tip, and the reason for its choice.
pub(super) struct Tip<'a> {
    pub(super) link: &'a str,
    pub(super) remark: String,
}

/// The links that the same moving joints move.
struct Arm<'a> {
    links: Vec<&'a str>,
    leaves: Vec<&'a str>,
}

impl<'a> Arm<'a> {
    /// Returns the link whose name marks it as the tip, with the rank of the name.
    fn named(&self) -> Option<(usize, &'a str)> {
        let rank = |link: &&'a str| Some((rank(link)?, *link));
        // The last of several of one name is the outermost one.
        self.links.iter().filter_map(rank).rev().min_by_key(|(rank, _)| *rank)
    }
}

/// Returns the rank of a name as that of a tip.
fn rank(link: &str) -> Option<usize> {
    let name = link.rsplit('/').next().unwrap_or(link).to_ascii_lowercase();
    let has = |word: &str| name.split(['_', '-', '.']).any(|part| part == word);
    WORDS.iter().position(|word| match *word {
        "ee" => name.split(['_', '-', '.']).any(|part| part.starts_with("ee")),
        "end_effector" => name.contains(word),
        word => has(word),
    })
}

/// Returns the tip of the only arm of a robot.
pub(super) fn tip_of<'a>(scope: &Scope<'_>, tree: &'a Tree, base: Option<&str>) -> Result<Tip<'a>> {
    let is_long_enough = |(joints, _): &(&Vec<usize>, &Arm<'_>)| JOINTS.contains(&joints.len());
    // A joint that others follow is a finger as a rule, and in some arms one that a rod moves.
    let mut all = arms(tree, base, false);
    if !all.iter().any(|arm| is_long_enough(&arm)) {
        let with_followed = arms(tree, base, true);
        if with_followed.iter().any(|arm| is_long_enough(&arm)) {
            all = with_followed;
        }
    }
    let wanted: Vec<&Arm<'a>> = all.iter().filter(is_long_enough).map(|(_, arm)| arm).collect();
    // A chain of another length is taken if it is the only one; its solver reports the outcome.
    let arms: Vec<&Arm<'a>> = if wanted.is_empty() { all.values().collect() } else { wanted };
    let best = arms.iter().filter_map(|arm| Some((arm.named()?, *arm))).min_by_key(|((rank, _), _)| *rank);
    let rivals = best.map_or(0, |((rank, _), _)| {
        arms.iter().filter(|arm| arm.named().is_some_and(|(other, _)| other == rank)).count()
    });
    let found = match (arms.as_slice(), best) {
        ([], _) if tree.leaves().len() == 1 => Some((tree.leaves()[0], "the only end")),
        ([_], Some(((_, link), _))) => Some((link, "by its name, on the only arm")),
        ([arm], None) if arm.leaves.len() == 1 => Some((arm.leaves[0], "the end of the only arm")),
        // Behind its last link only a gripper moves.
        ([arm], None) if arm.leaves.is_empty() => {
            outermost(tree, arm).map(|link| (link, "the last link of the only arm"))
        }
        (_, Some(((_, link), _))) if rivals == 1 => Some((link, "by its name")),
        _ => None,
    };
    if let Some((link, why)) = found {
        return Ok(Tip { link, remark: format!("the tip is link `{link}`, {why}; --tip-link names another one") });
    }
    let leaves = tree.leaves();
    let of_arms = arms.iter().flat_map(|arm| arm.leaves.iter()).next().copied();
    let common = parting(tree, base, all.keys().filter(|joints| JOINTS.contains(&joints.len())));
    let example = common.or(of_arms).or(leaves.first().copied()).unwrap_or("LINK");
    // Links that no joint moves are the ends of no arm.
    let moved: Vec<&str> = all.values().flat_map(|arm| arm.leaves.iter().copied()).collect();
    let ends = if moved.is_empty() { &leaves } else { &moved };
    let message = format!("found {} end links ({})", ends.len(), ends.join(", "));
    Err(scope.fail(tree.line, format!("{message}, expected a tip link to be named: --tip-link {example}")))
}

/// Returns the last link before chains part, if it ends an arm itself, as where two fingers begin; `None` if there are fewer than two chains.
fn parting<'a, 'b>(
    tree: &'a Tree,
    base: Option<&str>,
    mut chains: impl Iterator<Item = &'b Vec<usize>>,
) -> Option<&'a str> {
    let (mut common, mut count) = (chains.next()?.clone(), 1);
    for chain in chains {
        let shared = common.iter().zip(chain).take_while(|(one, other)| one == other).count();
        common.truncate(shared);
        count += 1;
    }
    if count < 2 || !JOINTS.contains(&common.len()) {
        return None;
    }
    let moving = |link: &str| {
        let path = tree.path(base, link, LONGEST)?;
        Some(path.into_iter().filter(|joint| !tree.joints[*joint].is_fixed).collect::<Vec<_>>())
    };
    tree.links.iter().map(String::as_str).rfind(|link| moving(link).as_ref() == Some(&common))
}

/// Returns the link of an arm farthest from the root; `None` if there are several.
fn outermost<'a>(tree: &Tree, arm: &Arm<'a>) -> Option<&'a str> {
    let length = |link: &&str| tree.path(None, link, LONGEST).map_or(0, |path| path.len());
    let longest = arm.links.iter().map(length).max()?;
    let mut all = arm.links.iter().filter(|link| length(link) == longest);
    let first = all.next()?;
    all.next().is_none().then_some(*first)
}

/// Groups the links below the base by the moving joints that move them, without mimic joints and immobile links, and with those joints that
/// others follow only if these are asked for.
fn arms<'a>(tree: &'a Tree, base: Option<&str>, with_followed: bool) -> BTreeMap<Vec<usize>, Arm<'a>> {
    let leaves = tree.leaves();
    let followed: HashSet<&str> = tree.joints.iter().filter_map(|joint| joint.follows.as_deref()).collect();
    let mut arms: BTreeMap<Vec<usize>, Arm<'a>> = BTreeMap::new();
    for link in tree.links.iter().map(String::as_str) {
        let Some(path) = tree.path(base, link, LONGEST) else { continue };
        let moving: Vec<usize> = path.into_iter().filter(|joint| !tree.joints[*joint].is_fixed).collect();
        let is_gripper = |joint: &usize| {
            let joint = &tree.joints[*joint];
            let is_followed = || joint.name.as_deref().is_some_and(|name| followed.contains(name));
            joint.follows.is_some() || !with_followed && is_followed()
        };
        if moving.is_empty() || moving.iter().any(is_gripper) {
            continue;
        }
        let arm = arms.entry(moving).or_insert_with(|| Arm { links: Vec::new(), leaves: Vec::new() });
        arm.links.push(link);
        if leaves.contains(&link) {
            arm.leaves.push(link);
        }
    }
    // If more joints follow, or too many are there, it is the middle of an arm, unless a link ends there or is named as a tip.
    let all: Vec<Vec<usize>> = arms.keys().cloned().collect();
    let is_middle = |joints: &[usize]| all.iter().any(|other| other.len() > joints.len() && other.starts_with(joints));
    arms.retain(|joints, arm| {
        (JOINTS.contains(&joints.len()) && !is_middle(joints)) || !arm.leaves.is_empty() || arm.named().is_some()
    });
    arms
}
