//! The links and joints of a robot description.

use super::scope::{Scope, nearest};
use super::urdf::{child, line, macro_found};
use crate::error::Result;
use roxmltree::Node as Element;
use std::collections::{HashMap, HashSet};

/// Maximum number of joints or links.
const LARGEST: usize = 10_000;

/// The links and joints of a robot: a tree, or several.
pub(super) struct Tree<'a, 'i> {
    pub(super) robot: Element<'a, 'i>,
    pub(super) links: Vec<&'a str>,
    pub(super) joints: Vec<Element<'a, 'i>>,
    /// Parent and child of every joint.
    pub(super) ends: Vec<(&'a str, &'a str)>,
    /// The joint whose child a link is.
    pub(super) above: HashMap<&'a str, usize>,
}

impl<'a, 'i> Tree<'a, 'i> {
    pub(super) fn read(scope: &Scope<'_>, robot: Element<'a, 'i>) -> Result<Self> {
        let parts = |tag: &'static str| robot.children().filter(move |element| element.has_tag_name(tag));
        let (all_links, joints) = (parts("link").collect::<Vec<_>>(), parts("joint").collect::<Vec<_>>());
        if joints.len().max(all_links.len()) > LARGEST {
            return Err(scope.fail(line(robot), format!("found more than {LARGEST} joints or links, expected a robot")));
        }
        let is_macro = |element: Element<'_, '_>| element.tag_name().namespace().is_some_and(|n| n.contains("xacro"));
        if let Some(found) = robot.descendants().find(|element| is_macro(*element)) {
            return Err(scope.fail(line(found), macro_found(scope)));
        }
        if all_links.is_empty() {
            return Err(scope.fail(line(robot), "found a robot without links, expected at least two and a joint"));
        }
        only_once(scope, &all_links, "links")?;
        only_once(scope, &joints, "joints")?;
        let links: Vec<&str> = all_links.iter().filter_map(|link| link.attribute("name")).collect();
        let known: HashSet<&str> = links.iter().copied().collect();
        let (mut ends, mut above) = (Vec::with_capacity(joints.len()), HashMap::new());
        for (index, joint) in joints.iter().enumerate() {
            let [parent, child] = ["parent", "child"].map(|end| end_of(scope, *joint, end, &known));
            let (parent, child) = (parent?, child?);
            if let Some(other) = above.insert(child, index) {
                let names = [joints[other], *joint].map(|joint| joint.attribute("name").unwrap_or("without name"));
                let message = format!("found link `{child}` as child of two joints, {} and {}", names[0], names[1]);
                return Err(scope.fail(line(*joint), format!("{message}, expected one")));
            }
            ends.push((parent, child));
        }
        let tree = Self { robot, links, joints, ends, above };
        tree.refuse_circles(scope)?;
        Ok(tree)
    }

    /// Checks that every link descends from a root.
    fn refuse_circles(&self, scope: &Scope<'_>) -> Result<()> {
        let mut below: HashMap<&str, Vec<&str>> = HashMap::new();
        for (parent, child) in &self.ends {
            below.entry(parent).or_default().push(child);
        }
        let mut open: Vec<&str> = self.links.iter().copied().filter(|link| !self.above.contains_key(link)).collect();
        let mut reached = HashSet::new();
        while let Some(link) = open.pop() {
            if reached.insert(link) {
                open.extend(below.get(link).into_iter().flatten());
            }
        }
        match self.ends.iter().position(|(_, child)| !reached.contains(child)) {
            Some(joint) => {
                Err(scope.fail(line(self.joints[joint]), "found joints that close a circle, expected a tree of links"))
            }
            None => Ok(()),
        }
    }

    /// Returns the name of a link as in the file.
    pub(super) fn known(&self, scope: &Scope<'_>, name: &str) -> Result<&'a str> {
        if let Some(link) = self.links.iter().find(|link| **link == name) {
            return Ok(link);
        }
        let near = nearest(name, self.links.iter().copied());
        let hint = near
            .first()
            .map_or_else(|| format!("expected one of {}", self.links.join(", ")), |n| format!("did you mean `{n}`?"));
        Err(scope.fail(line(self.robot), format!("found no link `{name}`; {hint}")))
    }

    /// Returns the joints from the base, or from a root, to a link; `None` if the base is not above it, or beyond `most` joints.
    pub(super) fn path(&self, base: Option<&str>, tip: &str, most: usize) -> Option<Vec<usize>> {
        let (mut path, mut at) = (Vec::new(), tip);
        while base != Some(at) {
            match (self.above.get(at), base) {
                (Some(_), _) if path.len() == most => return None,
                (Some(&joint), _) => {
                    path.push(joint);
                    at = self.ends[joint].0;
                }
                (None, None) => break,
                (None, Some(_)) => return None,
            }
        }
        path.reverse();
        Some(path)
    }

    /// Returns the links that are no joint's parent.
    pub(super) fn leaves(&self) -> Vec<&'a str> {
        let parents: HashSet<&str> = self.ends.iter().map(|(parent, _)| *parent).collect();
        self.links.iter().copied().filter(|link| !parents.contains(link)).collect()
    }

    /// Parent and child of the joint of this name.
    pub(super) fn ends_of(&self, joint: &str) -> Option<(&'a str, &'a str)> {
        let index = self.joints.iter().position(|element| element.attribute("name") == Some(joint))?;
        Some(self.ends[index])
    }
}

/// Refuses two parts with the same name.
fn only_once(scope: &Scope<'_>, parts: &[Element<'_, '_>], what: &str) -> Result<()> {
    let mut names = HashSet::new();
    match parts.iter().find(|part| part.attribute("name").is_some_and(|name| !names.insert(name))) {
        Some(part) => {
            let name = part.attribute("name").unwrap_or_default();
            Err(scope.fail(line(*part), format!("found two {what} `{name}`, expected different names")))
        }
        None => Ok(()),
    }
}

/// Returns the link at an end of a joint, which must be one of the robot.
fn end_of<'a>(scope: &Scope<'_>, joint: Element<'a, '_>, end: &str, links: &HashSet<&str>) -> Result<&'a str> {
    let link = child(joint, end).and_then(|element| element.attribute("link"));
    let link =
        link.ok_or_else(|| scope.fail(line(joint), format!("found a joint without <{end} link=...>, expected one")))?;
    if !links.contains(link) {
        return Err(scope.fail(line(joint), format!("found no link `{link}`, the {end} of a joint, expected one")));
    }
    Ok(link)
}
