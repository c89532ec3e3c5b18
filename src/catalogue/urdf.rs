//! Robot descriptions (URDF): the chain of joints between two links, as screw axes in the home position.

use super::entry::{Design, Entry};
use super::geometry::check_count;
use super::node::{Node, Value};
use super::options::Options;
use super::scope::Scope;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::{Angle, Number, Quantity};
use crate::algebra::ring::Ring;
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Geometry, JointKind, Placement, ScrewJoint};
use crate::kinematics::motion::Motion;
use roxmltree::{Document, Node as Element};
use rug::Rational;

/// Most joints or links read.
const LARGEST: usize = 10_000;

/// Reads the arm between two links; it has no pose.
pub(super) fn entry(scope: &Scope<'_>, text: &str, name: &str, options: &Options) -> Result<Entry> {
    let document = parse(scope, text)?;
    let robot = document.root_element();
    if robot.tag_name().name() != "robot" {
        let found: String = robot.tag_name().name().chars().take(40).collect();
        return Err(scope.fail(line(robot), format!("found <{found}>, expected <robot>")));
    }
    let chain = between(scope, robot, options)?;
    let (mut joints, mut limits) = (Vec::new(), Vec::new());
    let (mut home, mut enclosed) = (Motion::<Rational>::identity(), Motion::<Enclosure>::identity());
    for joint in chain {
        let origin = origin(scope, joint)?;
        home = home.then_after(&origin.exact);
        enclosed = enclosed.then_after(&origin.enclosed);
        let kind = match joint.attribute("type") {
            Some("fixed") => continue,
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
        let axis = axis(scope, joint)?;
        let known = |x: &Number| Enclosure::from_number(x).unwrap_or_else(Enclosure::zero);
        let direction = enclosed.rotate(&axis.each_ref().map(known));
        let rational = home.rotate(&axis.each_ref().map(|x| x.rational().clone()));
        let (axis, point) =
            (standing_for(rational, direction), standing_for(home.translation.clone(), enclosed.translation.clone()));
        joints.push(ScrewJoint { kind, axis, point, pitch: None });
        limits.push(limit(scope, joint)?);
    }
    let home = Placement::standing_for(home, enclosed, true);
    let geometry = Geometry::Screws { joints, home: Box::new(home) };
    let chain = Chain { geometry, base: Placement::identity(), tool: Placement::identity() };
    check_count(scope, &chain, line(robot), (6, "expected 6 for an arm; name the chain by its base and tip links"))?;
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
    })
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

/// The joints from the base link to the tip link.
fn between<'a, 'i>(scope: &Scope<'_>, robot: Element<'a, 'i>, options: &Options) -> Result<Vec<Element<'a, 'i>>> {
    let joints: Vec<_> = robot.children().filter(|element| element.has_tag_name("joint")).collect();
    let link = |joint: Element<'a, 'i>, end: &str| -> Result<&'a str> {
        child(joint, end)
            .and_then(|element| element.attribute("link"))
            .ok_or_else(|| scope.fail(line(joint), format!("found a joint without <{end} link=...>, expected one")))
    };
    let mut ends = Vec::with_capacity(joints.len());
    for joint in &joints {
        ends.push((link(*joint, "parent")?, link(*joint, "child")?));
    }
    let names: Vec<&str> =
        robot.children().filter(|e| e.has_tag_name("link")).filter_map(|e| e.attribute("name")).collect();
    let known = |name: &str| -> Result<()> {
        if names.contains(&name) {
            return Ok(());
        }
        let near = super::scope::nearest(name, names.iter().copied());
        let hint = near
            .first()
            .map_or_else(|| format!("expected one of {}", names.join(", ")), |n| format!("did you mean `{n}`?"));
        Err(scope.fail(line(robot), format!("found no link `{name}`; {hint}")))
    };
    if joints.len().max(names.len()) > LARGEST {
        return Err(scope.fail(line(robot), format!("found more than {LARGEST} joints or links, expected a robot")));
    }
    let tip = if let Some(tip) = &options.tip_link {
        tip.as_str()
    } else {
        let leaves: Vec<&str> =
            names.iter().copied().filter(|name| !ends.iter().any(|(parent, _)| parent == name)).collect();
        let [leaf] = leaves[..] else {
            let found = leaves.join(", ");
            return Err(scope.fail(
                line(robot),
                format!("found {} end links ({found}), expected a tip link to be named", leaves.len()),
            ));
        };
        leaf
    };
    known(tip)?;
    if let Some(base) = &options.base_link {
        known(base)?;
    }
    let mut chain = Vec::new();
    let mut at = tip;
    while options.base_link.as_deref() != Some(at) {
        let Some(index) = ends.iter().position(|(_, child)| *child == at) else {
            match &options.base_link {
                None => break,
                Some(base) => {
                    return Err(scope.fail(
                        line(robot),
                        format!("found no chain from link `{base}` to link `{tip}`, expected one"),
                    ));
                }
            }
        };
        chain.push(joints[index]);
        at = ends[index].0;
        if chain.len() > joints.len() {
            return Err(scope.fail(line(robot), "found links that close a circle, expected a tree"));
        }
    }
    chain.reverse();
    Ok(chain)
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
    Ok([read("lower")?, read("upper")?])
}
