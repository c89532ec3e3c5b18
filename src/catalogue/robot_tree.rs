//! The links and joints of a robot, whatever description they come from.

use super::scope::{Scope, nearest};
use crate::error::Result;
use std::collections::{HashMap, HashSet};

/// Maximum number of joints or links.
pub(super) const LARGEST: usize = 10_000;

/// A joint as far as the way from link to link needs it.
pub(super) struct Joint {
    pub(super) name: Option<String>,
    pub(super) line: usize,
    pub(super) is_fixed: bool,
    /// The joint that it follows.
    pub(super) follows: Option<String>,
    pub(super) parent: String,
    pub(super) child: String,
}

/// The links and joints of a robot: a tree, or several.
pub(super) struct Tree {
    /// Where the robot begins.
    pub(super) line: usize,
    pub(super) links: Vec<String>,
    pub(super) joints: Vec<Joint>,
    /// The joint whose child a link is.
    above: HashMap<String, usize>,
}

impl Tree {
    /// Builds the tree of these links and joints.
    ///
    /// # Errors
    /// For a link below two joints, and for joints that close a circle.
    pub(super) fn new(scope: &Scope<'_>, line: usize, links: Vec<String>, joints: Vec<Joint>) -> Result<Self> {
        if joints.len().max(links.len()) > LARGEST {
            return Err(scope.fail(line, format!("found more than {LARGEST} joints or links, expected a robot")));
        }
        let mut above = HashMap::new();
        for (index, joint) in joints.iter().enumerate() {
            if let Some(other) = above.insert(joint.child.clone(), index) {
                let names = [&joints[other], joint].map(|joint| joint.name.as_deref().unwrap_or("without name"));
                let child = &joint.child;
                let message = format!("found link `{child}` as child of two joints, {} and {}", names[0], names[1]);
                return Err(scope.fail(joint.line, format!("{message}, expected one")));
            }
        }
        let tree = Self { line, links, joints, above };
        tree.refuse_circles(scope)?;
        Ok(tree)
    }

    /// Checks that every link descends from a root.
    fn refuse_circles(&self, scope: &Scope<'_>) -> Result<()> {
        let mut below: HashMap<&str, Vec<&str>> = HashMap::new();
        for joint in &self.joints {
            below.entry(&joint.parent).or_default().push(&joint.child);
        }
        let mut open: Vec<&str> =
            self.links.iter().map(String::as_str).filter(|link| !self.above.contains_key(*link)).collect();
        let mut reached = HashSet::new();
        while let Some(link) = open.pop() {
            if reached.insert(link) {
                open.extend(below.get(link).into_iter().flatten());
            }
        }
        match self.joints.iter().find(|joint| !reached.contains(joint.child.as_str())) {
            Some(joint) => Err(scope.fail(joint.line, "found joints that close a circle, expected a tree of links")),
            None => Ok(()),
        }
    }

    /// Returns the name of a link as in the file.
    pub(super) fn known(&self, scope: &Scope<'_>, name: &str) -> Result<&str> {
        if let Some(link) = self.links.iter().find(|link| *link == name) {
            return Ok(link);
        }
        let near = nearest(name, self.links.iter().map(String::as_str));
        let hint = near
            .first()
            .map_or_else(|| format!("expected one of {}", self.links.join(", ")), |n| format!("did you mean `{n}`?"));
        Err(scope.fail(self.line, format!("found no link `{name}`; {hint}")))
    }

    /// Returns the joints from the base, or from a root, to a link; `None` if the base is not above it, or beyond `most` joints.
    pub(super) fn path(&self, base: Option<&str>, tip: &str, most: usize) -> Option<Vec<usize>> {
        let (mut path, mut at) = (Vec::new(), tip);
        while base != Some(at) {
            match (self.above.get(at), base) {
                (Some(_), _) if path.len() == most => return None,
                (Some(&joint), _) => {
                    path.push(joint);
                    at = &self.joints[joint].parent;
                }
                (None, None) => break,
                (None, Some(_)) => return None,
            }
        }
        path.reverse();
        Some(path)
    }

    /// Returns the links that are no joint's parent.
    pub(super) fn leaves(&self) -> Vec<&str> {
        let parents: HashSet<&str> = self.joints.iter().map(|joint| joint.parent.as_str()).collect();
        self.links.iter().map(String::as_str).filter(|link| !parents.contains(link)).collect()
    }

    /// Returns parent and child of the joint of this name.
    pub(super) fn ends_of(&self, name: &str) -> Option<(&str, &str)> {
        let joint = self.joints.iter().find(|joint| joint.name.as_deref() == Some(name))?;
        Some((&joint.parent, &joint.child))
    }
}
