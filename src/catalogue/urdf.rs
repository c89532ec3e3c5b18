//! Robot descriptions (URDF): the chain of joints between two links, as screw axes in the home position.

use super::entry::{Design, Entry, Labels};
use super::geometry::check_kinds;
use super::node::{Node, Value};
use super::options::Options;
use super::scope::Scope;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::{Angle, Number, Quantity};
use crate::algebra::ring::Ring;
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Geometry, JointKind, Placement, ScrewJoint};
use crate::kinematics::freedom::Freedom;
use crate::kinematics::motion::Motion;
use roxmltree::{Document, Node as Element};
use rug::Rational;
use std::collections::{HashMap, HashSet};

/// Most joints or links read.
const LARGEST: usize = 10_000;
/// Most joints between base and tip, fixed ones included: the exact rotations of so many have half a million digits.
const LONGEST: usize = 100;

/// Reads the arm between two links; it has no pose.
pub(super) fn entry(scope: &Scope<'_>, text: &str, name: &str, options: &Options) -> Result<Entry> {
    let document = parse(scope, text)?;
    let robot = document.root_element();
    if robot.tag_name().name() != "robot" {
        let found: String = robot.tag_name().name().chars().take(40).collect();
        return Err(scope.fail(line(robot), format!("found <{found}>, expected <robot>")));
    }
    let Between { chain, links } = between(scope, robot, options)?;
    let kinds = chain.iter().map(|joint| kind(scope, *joint)).collect::<Result<Vec<_>>>()?;
    // The exact axes of a long chain have long numbers: what cannot be an arm is refused before.
    let moving: Vec<JointKind> = kinds.iter().flatten().copied().collect();
    let expected = (6, "expected 6 for an arm; name the chain by its base and tip links");
    check_kinds(
        scope,
        &moving,
        || Freedom { variables: moving.len(), rank: None, spins: false },
        line(robot),
        expected,
    )?;
    if chain.len() > LONGEST {
        let found = chain.len();
        return Err(scope.fail(line(robot), format!("found a chain of {found} joints, expected at most {LONGEST}")));
    }
    let (mut joints, mut limits, mut names) = (Vec::new(), Vec::new(), Vec::new());
    let (mut home, mut enclosed) = (Motion::<Rational>::identity(), Motion::<Enclosure>::identity());
    for (joint, kind) in chain.into_iter().zip(kinds) {
        let origin = origin(scope, joint)?;
        home = home.then_after(&origin.exact);
        enclosed = enclosed.then_after(&origin.enclosed);
        let Some(kind) = kind else { continue };
        let axis = axis(scope, joint)?;
        let known = |x: &Number| Enclosure::from_number(x).unwrap_or_else(Enclosure::zero);
        let direction = enclosed.rotate(&axis.each_ref().map(known));
        let rational = home.rotate(&axis.each_ref().map(|x| x.rational().clone()));
        let (axis, point) =
            (standing_for(rational, direction), standing_for(home.translation.clone(), enclosed.translation.clone()));
        joints.push(ScrewJoint { kind, axis, point, pitch: None });
        limits.push(limit(scope, joint)?);
        names.push(joint.attribute("name").map(str::to_owned));
    }
    let home = Placement::standing_for(home, enclosed, true);
    let geometry = Geometry::Screws { joints, home: Box::new(home) };
    let chain = Chain { geometry, base: Placement::identity(), tool: Placement::identity() };
    Ok(Entry {
        name: name.to_owned(),
        title: robot.attribute("name").unwrap_or(name).to_owned(),
        source: None,
        notes: None,
        design: Design::Arm(chain),
        limits,
        cases: Vec::new(),
        rounded: scope.is_rounded(),
        reading: scope.reading.clone(),
        labels: Labels { joints: names, links: Some(links) },
    })
}

/// The kind of a joint; none for a fixed one.
fn kind(scope: &Scope<'_>, joint: Element<'_, '_>) -> Result<Option<JointKind>> {
    let kind = match joint.attribute("type") {
        Some("fixed") => return Ok(None),
        Some("revolute" | "continuous") => JointKind::Revolute,
        Some("prismatic") => JointKind::Prismatic,
        other => {
            let found = other.unwrap_or("nothing");
            let message = format!("joint type `{found}`; revolute, continuous, prismatic and fixed are read");
            return Err(Error::Unsupported(message).at(scope.path, line(joint)));
        }
    };
    if let Some(mimic) = child(joint, "mimic") {
        let message = "joints that mimic others".to_owned();
        return Err(Error::Unsupported(message).at(scope.path, line(mimic)));
    }
    Ok(Some(kind))
}

fn parse<'a>(scope: &Scope<'_>, text: &'a str) -> Result<Document<'a>> {
    // The reader recurses with the depth of the tags; a robot is four deep.
    let mut depth = 0_usize;
    for (at, _) in text.match_indices('<') {
        depth = if text[at..].starts_with("</") { depth.saturating_sub(1) } else { depth };
        if text[at + 1..].starts_with(|c: char| c.is_ascii_alphabetic()) {
            let end = text[at..].find('>').map_or(text.len(), |end| at + end);
            depth += usize::from(!text[..end].ends_with('/'));
        }
        if depth > 64 {
            let line = super::node::Lines::new(text).at(at);
            return Err(scope.fail(line, "found tags nested deeper than 64"));
        }
    }
    let options = roxmltree::ParsingOptions { nodes_limit: 1_000_000, ..Default::default() };
    Document::parse_with_options(text, options)
        .map_err(|fault| scope.fail(fault.pos().row as usize, format!("found text that is not XML: {fault}")))
}

fn line(element: Element<'_, '_>) -> usize {
    element.document().text_pos_at(element.range().start).row as usize
}

fn child<'a, 'i>(element: Element<'a, 'i>, name: &str) -> Option<Element<'a, 'i>> {
    element.children().find(|child| child.has_tag_name(name))
}

/// The joints from the base link to the tip link, and the names of these links.
struct Between<'a, 'i> {
    chain: Vec<Element<'a, 'i>>,
    links: [String; 2],
}

/// The chain that was asked for, else the one to the only link at the end of a moving chain.
fn between<'a, 'i>(scope: &Scope<'_>, robot: Element<'a, 'i>, options: &Options) -> Result<Between<'a, 'i>> {
    let tree = Tree::read(scope, robot)?;
    let tip = match &options.tip_link {
        Some(tip) => tree.known(scope, tip)?,
        None => tree.only_tip(scope)?,
    };
    let base = options.base_link.as_ref().map(|base| tree.known(scope, base)).transpose()?;
    let mut chain = Vec::new();
    let mut at = tip;
    while base != Some(at) {
        match (tree.above.get(at), base) {
            (Some(&joint), _) => {
                chain.push(tree.joints[joint]);
                at = tree.ends[joint].0;
            }
            (None, None) => break,
            (None, Some(base)) => {
                let message = format!("found no chain from link `{base}` to link `{tip}`, expected one");
                return Err(scope.fail(line(robot), message));
            }
        }
    }
    chain.reverse();
    Ok(Between { chain, links: [at.to_owned(), tip.to_owned()] })
}

/// The links and joints of a robot: a tree, or several.
struct Tree<'a, 'i> {
    robot: Element<'a, 'i>,
    links: Vec<&'a str>,
    joints: Vec<Element<'a, 'i>>,
    /// Parent and child of every joint.
    ends: Vec<(&'a str, &'a str)>,
    /// The joint whose child a link is.
    above: HashMap<&'a str, usize>,
}

impl<'a, 'i> Tree<'a, 'i> {
    fn read(scope: &Scope<'_>, robot: Element<'a, 'i>) -> Result<Self> {
        let parts = |tag: &'static str| robot.children().filter(move |element| element.has_tag_name(tag));
        let (all_links, joints) = (parts("link").collect::<Vec<_>>(), parts("joint").collect::<Vec<_>>());
        if joints.len().max(all_links.len()) > LARGEST {
            return Err(scope.fail(line(robot), format!("found more than {LARGEST} joints or links, expected a robot")));
        }
        let is_macro = |element: Element<'_, '_>| element.tag_name().namespace().is_some_and(|n| n.contains("xacro"));
        if let Some(found) = robot.descendants().find(|element| is_macro(*element)) {
            let message =
                "found a macro of xacro, expected URDF: expand it first, as by `xacro robot.xacro > robot.urdf`";
            return Err(scope.fail(line(found), message));
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

    /// Every link must be below one that is below none.
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

    /// The name of a link, as the file has it.
    fn known(&self, scope: &Scope<'_>, name: &str) -> Result<&'a str> {
        if let Some(link) = self.links.iter().find(|link| **link == name) {
            return Ok(link);
        }
        let near = super::scope::nearest(name, self.links.iter().copied());
        let hint = near
            .first()
            .map_or_else(|| format!("expected one of {}", self.links.join(", ")), |n| format!("did you mean `{n}`?"));
        Err(scope.fail(line(self.robot), format!("found no link `{name}`; {hint}")))
    }

    /// The link at the end of the only chain; where there are several ends, of the only one that moves.
    fn only_tip(&self, scope: &Scope<'_>) -> Result<&'a str> {
        let parents: HashSet<&str> = self.ends.iter().map(|(parent, _)| *parent).collect();
        let leaves: Vec<&'a str> = self.links.iter().copied().filter(|link| !parents.contains(link)).collect();
        let moving: Vec<&'a str> = leaves.iter().copied().filter(|link| self.moves(link)).collect();
        match (leaves.as_slice(), moving.as_slice()) {
            ([tip], _) | (_, [tip]) => Ok(tip),
            _ => {
                let (count, found) = (leaves.len(), leaves.join(", "));
                let message = format!("found {count} end links ({found}), expected a tip link to be named");
                Err(scope.fail(line(self.robot), message))
            }
        }
    }

    /// Whether a joint between the root and this link moves.
    fn moves(&self, link: &str) -> bool {
        let joint = |link: &str| self.above.get(link).copied();
        let mut chain = std::iter::successors(joint(link), |at| joint(self.ends[*at].0));
        chain.any(|at| self.joints[at].attribute("type") != Some("fixed"))
    }
}

/// Refuses two parts of one name.
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

/// The link at an end of a joint, which must be one of the robot.
fn end_of<'a>(scope: &Scope<'_>, joint: Element<'a, '_>, end: &str, links: &HashSet<&str>) -> Result<&'a str> {
    let link = child(joint, end).and_then(|element| element.attribute("link"));
    let link =
        link.ok_or_else(|| scope.fail(line(joint), format!("found a joint without <{end} link=...>, expected one")))?;
    if !links.contains(link) {
        return Err(scope.fail(line(joint), format!("found no link `{link}`, the {end} of a joint, expected one")));
    }
    Ok(link)
}

/// The numbers of an attribute, each as a node of the attribute's line.
fn triple(scope: &Scope<'_>, element: Element<'_, '_>, name: &str) -> Result<Option<[Node; 3]>> {
    let Some(text) = element.attribute(name) else { return Ok(None) };
    let nodes: Vec<Node> =
        text.split_whitespace().map(|word| Node { line: line(element), value: Value::Text(word.to_owned()) }).collect();
    let count = nodes.len();
    <[Node; 3]>::try_from(nodes)
        .map(Some)
        .map_err(|_| scope.fail(line(element), format!("found {count} numbers in `{name}`, expected 3")))
}

/// The motion of an `<origin>`: by rational numbers, and enclosed.
struct Origin {
    exact: Motion<Rational>,
    enclosed: Motion<Enclosure>,
}

fn standing_for(rational: [Rational; 3], enclosed: [Enclosure; 3]) -> [Number; 3] {
    let mut enclosed = enclosed.into_iter();
    rational.map(|q| Number::standing_for(q, enclosed.next().unwrap_or_else(Enclosure::zero)))
}

/// The motion of `<origin xyz rpy>`: translation after roll about x, pitch about y, yaw about z.
fn origin(scope: &Scope<'_>, joint: Element<'_, '_>) -> Result<Origin> {
    let mut origin = Origin { exact: Motion::identity(), enclosed: Motion::identity() };
    let Some(element) = child(joint, "origin") else { return Ok(origin) };
    if let Some(angles) = triple(scope, element, "rpy")? {
        for (axis, node) in angles.iter().enumerate() {
            let angle = scope.angle(node, "rpy")?;
            origin.exact = about(axis, &angle).then_after(&origin.exact);
            origin.enclosed = about(axis, &angle).then_after(&origin.enclosed);
        }
    }
    if let Some(xyz) = triple(scope, element, "xyz")? {
        for (k, node) in xyz.iter().enumerate() {
            let length = scope.length(node, "xyz")?;
            origin.exact.translation[k].clone_from(length.rational());
            origin.enclosed.translation[k] = Enclosure::from_number(&length).unwrap_or_else(Enclosure::zero);
        }
    }
    Ok(origin)
}

/// The rotation about a coordinate axis.
fn about<R: Ring>(axis: usize, angle: &Angle) -> Motion<R> {
    let (cos, sin) = R::cos_sin(angle).expect("numbers without a prime have every cosine");
    match axis {
        0 => Motion::rotation_x(cos, sin),
        1 => {
            let mut motion = Motion::identity();
            motion.rotation[0] = [cos.clone(), R::zero(), sin.clone()];
            motion.rotation[2] = [sin.neg(), R::zero(), cos];
            motion
        }
        _ => Motion::rotation_z(cos, sin),
    }
}

fn axis(scope: &Scope<'_>, joint: Element<'_, '_>) -> Result<[Number; 3]> {
    let standard = || [1, 0, 0].map(|n| Number::exact(Rational::from(n)));
    let Some(element) = child(joint, "axis") else { return Ok(standard()) };
    let Some(nodes) = triple(scope, element, "xyz")? else { return Ok(standard()) };
    let mut axis = standard();
    for (image, node) in axis.iter_mut().zip(&nodes) {
        *image = scope.number(node, Quantity::Ratio, "axis")?;
    }
    if axis.iter().all(|x| x.rational().is_zero()) {
        return Err(scope.fail(line(element), "found the axis 0 0 0, expected a direction"));
    }
    Ok(axis)
}

fn limit(scope: &Scope<'_>, joint: Element<'_, '_>) -> Result<[f64; 2]> {
    let unlimited = [f64::NEG_INFINITY, f64::INFINITY];
    let (Some(element), false) = (child(joint, "limit"), joint.attribute("type") == Some("continuous")) else {
        return Ok(unlimited);
    };
    let read = |name: &str| -> Result<f64> {
        let Some(text) = element.attribute(name) else { return Ok(0.0) };
        let node = Node { line: line(element), value: Value::Text(text.to_owned()) };
        scope.number(&node, Quantity::Ratio, name).map(|number| number.to_f64())
    };
    let (lower, upper) = (read("lower")?, read("upper")?);
    if lower > upper {
        let message = format!("found the limits [{lower}, {upper}], expected the lower one first");
        return Err(scope.fail(line(element), message));
    }
    Ok([lower, upper])
}
