//! Which link of a robot description is meant as its tip, where none is named.

use super::robot_tree::Tree;
use super::scope::Scope;
use super::urdf::{LONGEST, child, line};
use crate::error::Result;
use std::collections::{BTreeMap, HashSet};

/// How many moving joints an arm has whose tip is looked for: fewer are a head or a wheel, more are two chains in one.
const JOINTS: std::ops::RangeInclusive<usize> = 4..=7;

/// The words by which people call the tip of an arm, the best one first.
const WORDS: [&str; 7] = ["tool0", "tcp", "ee", "end_effector", "tool", "flange", "tip"];

/// A tip, and why it is this one.
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
    /// The link that its name shows to be the tip, with the rank of the name.
    fn named(&self) -> Option<(usize, &'a str)> {
        let rank = |link: &&'a str| Some((rank(link)?, *link));
        // The last of several of one name is the outermost one.
        self.links.iter().filter_map(rank).rev().min_by_key(|(rank, _)| *rank)
    }
}

/// How good a name is for a tip.
fn rank(link: &str) -> Option<usize> {
    let name = link.rsplit('/').next().unwrap_or(link).to_ascii_lowercase();
    let has = |word: &str| name.split(['_', '-', '.']).any(|part| part == word);
    WORDS.iter().position(|word| match *word {
        "ee" => name.split(['_', '-', '.']).any(|part| part.starts_with("ee")),
        "end_effector" => name.contains(word),
        word => has(word),
    })
}

/// The tip of the only arm of a robot.
pub(super) fn tip_of<'a>(scope: &Scope<'_>, tree: &Tree<'a, '_>, base: Option<&str>) -> Result<Tip<'a>> {
    let all = arms(tree, base);
    let wanted: Vec<&Arm<'a>> =
        all.iter().filter(|(joints, _)| JOINTS.contains(&joints.len())).map(|(_, arm)| arm).collect();
    // A chain of another length is taken where it is the only one; what becomes of it is said by its solver.
    let arms: Vec<&Arm<'a>> = if wanted.is_empty() { all.values().collect() } else { wanted };
    let best = arms.iter().filter_map(|arm| Some((arm.named()?, *arm))).min_by_key(|((rank, _), _)| *rank);
    let rivals = best.map_or(0, |((rank, _), _)| {
        arms.iter().filter(|arm| arm.named().is_some_and(|(other, _)| other == rank)).count()
    });
    let found = match (arms.as_slice(), best) {
        ([], _) if tree.leaves().len() == 1 => Some((tree.leaves()[0], "the only end")),
        ([_], Some(((_, link), _))) => Some((link, "by its name, on the only arm")),
        ([arm], None) if arm.leaves.len() == 1 => Some((arm.leaves[0], "the end of the only arm")),
        (_, Some(((_, link), _))) if rivals == 1 => Some((link, "by its name")),
        _ => None,
    };
    if let Some((link, why)) = found {
        return Ok(Tip { link, remark: format!("the tip is link `{link}`, {why}; --tip-link names another one") });
    }
    let leaves = tree.leaves();
    let message = format!("found {} end links ({}), expected a tip link to be named", leaves.len(), leaves.join(", "));
    Err(scope.fail(line(tree.robot), format!("{message}: --tip-link LINK")))
}

/// The links below the base by the moving joints that move them, mimic joints, joints that others mimic and links without moving joints left out.
fn arms<'a>(tree: &Tree<'a, '_>, base: Option<&str>) -> BTreeMap<Vec<usize>, Arm<'a>> {
    let leaves = tree.leaves();
    // The joint that others mimic is a finger, too.
    let mimicked: HashSet<&str> =
        tree.joints.iter().filter_map(|joint| child(*joint, "mimic")?.attribute("joint")).collect();
    let mut arms: BTreeMap<Vec<usize>, Arm<'a>> = BTreeMap::new();
    for &link in &tree.links {
        let Some(path) = tree.path(base, link, LONGEST) else { continue };
        let moving: Vec<usize> =
            path.into_iter().filter(|joint| tree.joints[*joint].attribute("type") != Some("fixed")).collect();
        let is_gripper = |joint: &usize| {
            let joint = tree.joints[*joint];
            child(joint, "mimic").is_some() || joint.attribute("name").is_some_and(|name| mimicked.contains(name))
        };
        let mimics = moving.iter().any(is_gripper);
        if moving.is_empty() || mimics {
            continue;
        }
        let arm = arms.entry(moving).or_insert_with(|| Arm { links: Vec::new(), leaves: Vec::new() });
        arm.links.push(link);
        if leaves.contains(&link) {
            arm.leaves.push(link);
        }
    }
    // What more joints stand behind is the middle of an arm, unless a link ends there or is named as a tip.
    arms.retain(|_, arm| !arm.leaves.is_empty() || arm.named().is_some());
    arms
}
