//! Robot descriptions (URDF): the chain of joints between two links, as screw axes in the home position.

use super::entry::{Design, Entry, Labels};
use super::geometry::check_kinds;
use super::node::{Node, Value};
use super::options::Options;
use super::robot_tip::tip_of;
use super::robot_tree::Tree;
use super::scope::Scope;
use super::srdf;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::{Angle, Number, Quantity};
use crate::algebra::real_field::RealField;
use crate::algebra::ring::Ring;
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Geometry, JointKind, Placement, ScrewJoint};
use crate::kinematics::freedom::Freedom;
use crate::kinematics::known_motion::KnownMotion;
use crate::kinematics::motion::Motion;
use roxmltree::{Document, Node as Element};
use rug::Rational;
use std::path::Path;

/// Maximum number of joints between base and tip, fixed ones included; their exact rotations then have half a million digits.
pub(super) const LONGEST: usize = 100;

/// Reads the arm between two links; it has no pose.
pub(super) fn entry(scope: &Scope<'_>, text: &str, name: &str, options: &Options) -> Result<Entry> {
    let document = parse(scope, text)?;
    let robot = document.root_element();
    if robot.tag_name().name() != "robot" {
        let found: String = robot.tag_name().name().chars().take(40).collect();
        return Err(scope.fail(line(robot), format!("found <{found}>, expected <robot>")));
    }
    let Between { chain, links, remark } = between(scope, robot, options)?;
    let kinds = chain.iter().map(|joint| kind(scope, *joint)).collect::<Result<Vec<_>>>()?;
    // The exact axes of a long chain have numbers of many digits, so a chain that cannot be an arm is refused first.
    let moving: Vec<JointKind> = kinds.iter().flatten().copied().collect();
    let expected = (6, "expected 1 to 24 for an arm; name the chain by its base and tip links");
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
    let origins = chain.iter().map(|joint| Origin::read(scope, *joint)).collect::<Result<Vec<_>>>()?;
    // The axis of a fixed joint is irrelevant.
    let moves = |(joint, kind): (&Element<'_, '_>, &Option<JointKind>)| match kind {
        Some(_) => axis(scope, *joint),
        None => Ok(along_x()),
    };
    let axes = chain.iter().zip(&kinds).map(moves).collect::<Result<Vec<_>>>()?;
    let field = field(&origins, &axes);
    let (mut joints, mut limits, mut names) = (Vec::new(), Vec::new(), Vec::new());
    let mut home = KnownMotion::identity();
    for (((joint, kind), origin), axis) in chain.into_iter().zip(kinds).zip(origins).zip(axes) {
        let unknown = || scope.fail(line(joint), "found an angle that is not known well enough");
        home = home.then_after(&origin.motion(field.as_ref()).ok_or_else(unknown)?);
        let Some(kind) = kind else { continue };
        let (axis, point) = (home.direction(field.as_ref(), &axis), home.point(field.as_ref()));
        joints.push(ScrewJoint { kind, axis, point, pitch: None });
        limits.push(limit(scope, joint)?);
        names.push(joint.attribute("name").map(str::to_owned));
    }
    let home = home.placement(field.as_ref());
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
        labels: Labels {
            joints: names,
            links: Some(links),
            snapped: scope.take_snapped(),
            remarks: remark.into_iter().collect(),
        },
    })
}

/// Returns the kind of a joint; `None` for a fixed one.
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
        if text.contains("<xacro:") {
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

/// The joints from the base link to the tip link, the names of these links, and the reason for the choice of the tip.
struct Between<'a, 'i> {
    chain: Vec<Element<'a, 'i>>,
    links: [String; 2],
    remark: Option<String>,
}

/// Returns the requested chain, else that of the only arm.
fn between<'a, 'i>(scope: &Scope<'_>, robot: Element<'a, 'i>, options: &Options) -> Result<Between<'a, 'i>> {
    let tree = Tree::read(scope, robot)?;
    let group = match &options.group {
        Some((path, group)) => srdf::ends(path, group, &|joint| tree.ends_of(joint))?,
        None => srdf::Ends::default(),
    };
    let (base, tip) = (options.base_link.clone().or(group.base), options.tip_link.clone().or(group.tip));
    let base = base.as_ref().map(|base| tree.known(scope, base)).transpose()?;
    let (tip, remark) = if let Some(tip) = &tip {
        (tree.known(scope, tip)?, None)
    } else {
        let tip = tip_of(scope, &tree, base)?;
        (tip.link, Some(tip.remark))
    };
    let Some(path) = tree.path(base, tip, usize::MAX) else {
        let message = format!("found no chain from link `{}` to link `{tip}`, expected one", base.unwrap_or_default());
        return Err(scope.fail(line(robot), message));
    };
    let start = path.first().map_or(tip, |joint| tree.ends[*joint].0);
    let chain = path.into_iter().map(|joint| tree.joints[joint]).collect();
    Ok(Between { chain, links: [start.to_owned(), tip.to_owned()], remark })
}

/// Returns the numbers of an attribute, each as a node of the attribute's line.
fn triple(scope: &Scope<'_>, element: Element<'_, '_>, name: &str) -> Result<Option<[Node; 3]>> {
    let Some(text) = element.attribute(name) else { return Ok(None) };
    let nodes: Vec<Node> =
        text.split_whitespace().map(|word| Node { line: line(element), value: Value::Text(word.to_owned()) }).collect();
    let count = nodes.len();
    <[Node; 3]>::try_from(nodes)
        .map(Some)
        .map_err(|_| scope.fail(line(element), format!("found {count} numbers in `{name}`, expected 3")))
}

/// The numbers of an `<origin>`: translation after roll about x, pitch about y, yaw about z.
struct Origin {
    angles: [Angle; 3],
    position: [Number; 3],
}

impl Origin {
    fn read(scope: &Scope<'_>, joint: Element<'_, '_>) -> Result<Self> {
        let mut origin =
            Self { angles: std::array::from_fn(|_| Angle::zero()), position: std::array::from_fn(|_| Number::zero()) };
        let Some(element) = child(joint, "origin") else { return Ok(origin) };
        if let Some(nodes) = triple(scope, element, "rpy")? {
            let place = joint.attribute("name").unwrap_or("a joint without name");
            for (angle, node) in origin.angles.iter_mut().zip(&nodes) {
                *angle = scope.printed_angle(node, "rpy", place)?;
            }
        }
        if let Some(nodes) = triple(scope, element, "xyz")? {
            for (length, node) in origin.position.iter_mut().zip(&nodes) {
                *length = scope.length(node, "xyz")?;
            }
        }
        Ok(origin)
    }

    /// Returns the motion; `None` for an angle that is not known well enough.
    fn motion(&self, field: Option<&RealField>) -> Option<KnownMotion> {
        let mut exact = Motion::<Rational>::roll_pitch_yaw(&self.angles)?;
        exact.translation = self.position.each_ref().map(|x| x.rational().clone());
        let mut enclosed = Motion::<Enclosure>::roll_pitch_yaw(&self.angles)?;
        enclosed.translation =
            self.position.each_ref().map(|x| Enclosure::from_number(x).unwrap_or_else(Enclosure::zero));
        let algebraic = field.and_then(|field| {
            let phase = |angle: &Angle| {
                let (cos, sin) = angle.phase()?;
                Some((field.element(&cos)?, field.element(&sin)?))
            };
            let [roll, pitch, yaw] = self.angles.each_ref().map(phase);
            let [x, y, z] = self.position.each_ref().map(|x| field.element(&x.closed()?));
            Some(Motion { translation: [x?, y?, z?], ..Motion::turned([roll?, pitch?, yaw?]) })
        });
        Some(KnownMotion { exact, enclosed, algebraic })
    }
}

/// Returns the field of all numbers of the origins and axes of a chain, if there is one.
fn field(origins: &[Origin], axes: &[[Number; 3]]) -> Option<RealField> {
    let mut all = Vec::new();
    for Origin { angles, position } in origins {
        for angle in angles {
            let (cos, sin) = angle.phase()?;
            all.extend([cos, sin]);
        }
        for length in position {
            all.push(length.closed()?);
        }
    }
    for entry in axes.iter().flatten() {
        all.push(entry.closed()?);
    }
    RealField::containing(&all)
}

/// Returns the default axis of a joint.
fn along_x() -> [Number; 3] {
    [1, 0, 0].map(|n| Number::exact(Rational::from(n)))
}

fn axis(scope: &Scope<'_>, joint: Element<'_, '_>) -> Result<[Number; 3]> {
    let Some(element) = child(joint, "axis") else { return Ok(along_x()) };
    let Some(nodes) = triple(scope, element, "xyz")? else { return Ok(along_x()) };
    let mut axis = along_x();
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
