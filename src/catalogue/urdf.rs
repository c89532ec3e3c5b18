//! Robot descriptions (URDF): the joints and frames of a robot.

use super::entry::Entry;
use super::mjcf;
use super::node::{Node, Value};
use super::options::Options;
use super::robot_chain::{self, Heading, Origin, Step, Turn, along, between, nowhere, numbers};
use super::robot_tree::{Joint, LARGEST, Tree};
use super::scope::Scope;
use crate::algebra::number::{Number, Quantity};
use crate::error::{Error, Result};
use crate::kinematics::chain::JointKind;
use roxmltree::{Document, Node as Element};
use std::collections::HashSet;
use std::path::Path;

/// Reads the arm between two links of a robot, described by URDF or MJCF; it has no pose.
pub(super) fn entry(scope: &Scope<'_>, text: &str, name: &str, options: &Options) -> Result<Entry> {
    let document = parse(scope, text)?;
    let robot = document.root_element();
    match robot.tag_name().name() {
        "robot" => {}
        "mujoco" => return mjcf::entry(scope, robot, name, options),
        other => {
            let found: String = other.chars().take(40).collect();
            return Err(scope.fail(line(robot), format!("found <{found}>, expected <robot> or <mujoco>")));
        }
    }
    let (tree, joints) = tree(scope, robot)?;
    let way = between(scope, &tree, options)?;
    let chain: Vec<Element<'_, '_>> = way.path.iter().map(|joint| joints[*joint]).collect();
    let kinds = chain.iter().map(|joint| kind(scope, *joint)).collect::<Result<Vec<_>>>()?;
    robot_chain::check(scope, line(robot), &kinds)?;
    let steps = chain.into_iter().zip(kinds).map(|(joint, kind)| step(scope, joint, kind)).collect::<Result<_>>()?;
    let title = robot.attribute("name").unwrap_or(name);
    let remarks = way.remark.into_iter().collect();
    robot_chain::entry(scope, steps, Heading { name, title, line: line(robot), remarks, links: way.links })
}

/// Returns the links and joints of a robot, and the elements of its joints.
fn tree<'a, 'i>(scope: &Scope<'_>, robot: Element<'a, 'i>) -> Result<(Tree, Vec<Element<'a, 'i>>)> {
    let parts = |tag: &'static str| robot.children().filter(move |element| element.has_tag_name(tag));
    let (all_links, elements) = (parts("link").collect::<Vec<_>>(), parts("joint").collect::<Vec<_>>());
    if elements.len().max(all_links.len()) > LARGEST {
        return Err(scope.fail(line(robot), format!("found more than {LARGEST} joints or links, expected a robot")));
    }
    if let Some(found) = macro_of(robot) {
        return Err(scope.fail(line(found), macro_found(scope)));
    }
    if all_links.is_empty() {
        return Err(scope.fail(line(robot), "found a robot without links, expected at least two and a joint"));
    }
    only_once(scope, &all_links, "links")?;
    only_once(scope, &elements, "joints")?;
    let links: Vec<String> = all_links.iter().filter_map(|link| link.attribute("name")).map(str::to_owned).collect();
    let known: HashSet<&str> = links.iter().map(String::as_str).collect();
    let joint = |joint: &Element<'_, '_>| -> Result<Joint> {
        let [parent, child_link] = ["parent", "child"].map(|end| end_of(scope, *joint, end, &known));
        Ok(Joint {
            name: joint.attribute("name").map(str::to_owned),
            line: line(*joint),
            is_fixed: joint.attribute("type") == Some("fixed"),
            // A joint that follows one without a name follows some joint all the same.
            follows: child(*joint, "mimic").map(|mimic| mimic.attribute("joint").unwrap_or_default().to_owned()),
            parent: parent?.to_owned(),
            child: child_link?.to_owned(),
        })
    };
    let joints = elements.iter().map(joint).collect::<Result<_>>()?;
    Ok((Tree::new(scope, line(robot), links, joints)?, elements))
}

/// Returns an element that `xacro` has to expand: one that may stand for links and joints, or an expression in one of these. Properties without
/// a use, and what stands below materials and simulators, are left over in many expanded files.
fn macro_of<'a, 'i>(robot: Element<'a, 'i>) -> Option<Element<'a, 'i>> {
    let is_macro =
        |element: &Element<'_, '_>| element.tag_name().namespace().is_some_and(|name| name.contains("xacro"));
    let is_definition = |element: &Element<'_, '_>| ["property", "arg"].contains(&element.tag_name().name());
    let is_expression = |text: &str| text.contains("${") || text.contains("$(");
    let stands_for_more = |element: &Element<'_, '_>| {
        let has_expression = || element.attributes().any(|attribute| is_expression(attribute.value()));
        is_macro(element) || has_expression()
    };
    let calls = robot.children().filter(|part| is_macro(part) && !is_definition(part));
    let links = robot.children().filter(|part| part.has_tag_name("link") && stands_for_more(part));
    let joints = robot.children().filter(|part| part.has_tag_name("joint"));
    calls.chain(links).chain(joints.flat_map(|joint| joint.descendants()).filter(stands_for_more)).next()
}

/// Refuses two parts with the same name.
pub(super) fn only_once(scope: &Scope<'_>, parts: &[Element<'_, '_>], what: &str) -> Result<()> {
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

/// Returns the kind of a joint; `None` for a fixed one.
fn kind(scope: &Scope<'_>, joint: Element<'_, '_>) -> Result<Option<JointKind>> {
    let kind = match joint.attribute("type") {
        Some("fixed") => return Ok(None),
        Some("revolute" | "continuous") => JointKind::Revolute,
        Some("prismatic") => JointKind::Prismatic,
        Some(other @ ("floating" | "planar")) => {
            let message = format!("joint type `{other}`; revolute, continuous, prismatic and fixed are read");
            return Err(Error::Unsupported(message).at(scope.path, line(joint)));
        }
        other => {
            let found = other.map_or("no type of a joint".to_owned(), |other| format!("joint type `{other}`"));
            let expected = "expected revolute, continuous, prismatic or fixed";
            return Err(scope.fail(line(joint), format!("found {found}, {expected}")));
        }
    };
    if let Some(mimic) = child(joint, "mimic") {
        let message = "joints that mimic others".to_owned();
        return Err(Error::Unsupported(message).at(scope.path, line(mimic)));
    }
    Ok(Some(kind))
}

pub(super) fn parse<'a>(scope: &Scope<'_>, text: &'a str) -> Result<Document<'a>> {
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
    Document::parse_with_options(text, options).map_err(|fault| {
        let row = fault.pos().row as usize;
        // A macro file may leave its prefix undeclared.
        if matches!(&fault, roxmltree::Error::UnknownNamespace(prefix, _) if prefix == "xacro") {
            return scope.fail(row, macro_found(scope));
        }
        scope.fail(row, format!("found text that is not XML: {fault}"))
    })
}

/// Returns the error message for a file of macros, with the command that expands it.
pub(super) fn macro_found(scope: &Scope<'_>) -> String {
    let path = scope.path;
    let expanded = Path::new(path).with_extension("urdf").display().to_string();
    let expanded = if expanded == path { "expanded.urdf".to_owned() } else { expanded };
    format!("found a macro of xacro, expected URDF: expand it first by `xacro {path} > {expanded}`")
}

pub(super) fn line(element: Element<'_, '_>) -> usize {
    element.document().text_pos_at(element.range().start).row as usize
}

pub(super) fn child<'a, 'i>(element: Element<'a, 'i>, name: &str) -> Option<Element<'a, 'i>> {
    element.children().find(|child| child.has_tag_name(name))
}

/// Reads the numbers of a joint of the chain.
fn step(scope: &Scope<'_>, joint: Element<'_, '_>, kind: Option<JointKind>) -> Result<Step> {
    let name = joint.attribute("name");
    // Fixed joints have no axis that counts.
    let axis = if kind.is_some() { axis(scope, joint)? } else { along(0) };
    Ok(Step {
        name: name.map(str::to_owned),
        kind,
        origins: vec![origin(scope, joint, name.unwrap_or("a joint without name"))?],
        axis,
        limits: limit(scope, joint)?,
    })
}

/// Reads the `<origin>` of a joint: a translation, then a rotation by roll about x after pitch about y after yaw about z.
fn origin(scope: &Scope<'_>, joint: Element<'_, '_>, place: &str) -> Result<Origin> {
    let mut origin = Origin { position: nowhere(), turns: Vec::new() };
    let Some(element) = child(joint, "origin") else { return Ok(origin) };
    if let Some(nodes) = triple(scope, element, "rpy")? {
        for (axis, node) in nodes.iter().enumerate().rev() {
            origin.turns.push(Turn::About(axis, scope.printed_angle(node, "rpy", place)?));
        }
    }
    if let Some(nodes) = triple(scope, element, "xyz")? {
        for (length, node) in origin.position.iter_mut().zip(&nodes) {
            *length = scope.length(node, "xyz")?;
        }
    }
    Ok(origin)
}

/// Reads the three numbers of an attribute.
fn triple(scope: &Scope<'_>, element: Element<'_, '_>, name: &str) -> Result<Option<[Node; 3]>> {
    element.attribute(name).map(|text| numbers(scope, text, line(element), name)).transpose()
}

fn axis(scope: &Scope<'_>, joint: Element<'_, '_>) -> Result<[Number; 3]> {
    let Some(element) = child(joint, "axis") else { return Ok(along(0)) };
    let Some(nodes) = triple(scope, element, "xyz")? else { return Ok(along(0)) };
    let mut axis = along(0);
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
