//! Robots of models for `MuJoCo` (MJCF): bodies, joints and sites as the links and joints of a robot.
//!
//! A body stands in its parent's frame at `pos` and an orientation, and moves by its joints one after the other, each about an
//! axis through its own `pos`. Joints between two bodies have links of their own here, sites are links that nothing moves.
//!
//! # Source
//! `MuJoCo` documentation, XML reference: `compiler`, `default`, `body`, `frame`, `joint`, `site`, `equality`.

use super::entry::Entry;
use super::mjcf_orientation::{Orientations, joint_axis, negated};
use super::options::Options;
use super::robot_chain::{self, Heading, Origin, Step, along, between, nowhere, numbers};
use super::robot_tree::{Joint, Tree};
use super::scope::Scope;
use super::urdf::{child, line, only_once};
use crate::algebra::number::{Number, Quantity};
use crate::error::{Error, Result};
use crate::kinematics::chain::JointKind;
use roxmltree::Node as Element;
use std::collections::{HashMap, HashSet};

/// The name of the frame in which the bodies stand.
const WORLD: &str = "world";

/// Attributes that elements of a class have where they say nothing else: by tag and attribute, with the line.
type Class<'a> = HashMap<(&'a str, &'a str), (&'a str, usize)>;

/// An element with the defaults of its class.
#[derive(Clone, Copy)]
pub(super) struct Part<'a, 'i, 'c> {
    pub(super) element: Element<'a, 'i>,
    class: Option<&'c Class<'a>>,
}

impl<'a> Part<'a, '_, '_> {
    /// Returns an attribute and its line.
    pub(super) fn attribute(&self, name: &str) -> Option<(&'a str, usize)> {
        let own = self.element.attribute(name).map(|text| (text, line(self.element)));
        let tag = self.element.tag_name().name();
        own.or_else(|| self.class?.get(&(tag, name)).copied())
    }

    /// Returns the name of the part, for messages.
    pub(super) fn place(&self) -> &'a str {
        self.element.attribute("name").unwrap_or("a part without name")
    }
}

/// A frame on the way from one link to the next.
#[derive(Clone, Copy)]
enum Frame<'a, 'i, 'c> {
    /// The `pos` and the orientation of a body, a frame or a site.
    Of(Part<'a, 'i, 'c>),
    /// The `pos` of a joint, or the way back from it.
    Anchor(Part<'a, 'i, 'c>, bool),
    /// The way that a joint is back at value 0 from its place in the model, at `ref`.
    Reference(Part<'a, 'i, 'c>),
}

/// A joint between two links with the frames before it; no joint for a fixed one.
struct Between<'a, 'i, 'c> {
    frames: Vec<Frame<'a, 'i, 'c>>,
    joint: Option<Part<'a, 'i, 'c>>,
}

/// The model as far as it was walked through.
struct Walk<'a, 'i, 'c> {
    classes: &'c HashMap<&'a str, Class<'a>>,
    follows: HashMap<&'a str, &'a str>,
    links: Vec<String>,
    joints: Vec<Joint>,
    between: Vec<Between<'a, 'i, 'c>>,
    /// Names of bodies, which sites may share.
    bodies: HashSet<&'a str>,
}

/// Reads the arm between two bodies or sites; it has no pose.
pub(super) fn entry(scope: &Scope<'_>, model: Element<'_, '_>, name: &str, options: &Options) -> Result<Entry> {
    let orientations = Orientations::of(scope, model)?;
    let classes = classes(scope, model)?;
    let worlds: Vec<Element<'_, '_>> = model.children().filter(|own| own.has_tag_name("worldbody")).collect();
    let bodies: Vec<Element<'_, '_>> =
        worlds.iter().flat_map(Element::descendants).filter(|own| own.has_tag_name("body")).collect();
    if bodies.is_empty() {
        refuse_include(scope, model)?;
        return Err(scope.fail(line(model), "found a model without bodies, expected a robot"));
    }
    only_once(scope, &bodies, "bodies")?;
    let mut walk = Walk {
        classes: &classes,
        follows: follows(model),
        links: vec![WORLD.to_owned()],
        joints: Vec::new(),
        between: Vec::new(),
        bodies: bodies.iter().filter_map(|body| body.attribute("name")).collect(),
    };
    for world in worlds {
        walk.inside(scope, world, WORLD, &[], None)?;
    }
    let Walk { links, joints, between: ways, .. } = walk;
    let tree = Tree::new(scope, line(model), links, joints)?;
    let way = between(scope, &tree, options)?;
    let chain: Vec<&Between<'_, '_, '_>> = way.path.iter().map(|joint| &ways[*joint]).collect();
    let kinds = chain.iter().map(|own| kind(scope, own.joint.as_ref())).collect::<Result<Vec<_>>>()?;
    for (joint, kind) in way.path.iter().zip(&kinds) {
        let joint = &tree.joints[*joint];
        if kind.is_some() && joint.follows.is_some() {
            return Err(Error::Unsupported("joints that mimic others".to_owned()).at(scope.path, joint.line));
        }
    }
    robot_chain::check(scope, line(model), &kinds)?;
    let step = |(own, kind): (&&Between<'_, '_, '_>, Option<JointKind>)| orientations.step(scope, own, kind);
    let steps = chain.iter().zip(kinds).map(step).collect::<Result<_>>()?;
    orientations.note(scope);
    let title = model.attribute("model").unwrap_or(name);
    let mut remarks: Vec<String> = way.remark.into_iter().collect();
    if let Some(include) = model.children().find(|own| own.has_tag_name("include")) {
        let file = include.attribute("file").unwrap_or_default();
        remarks.push(format!("line {}: what `{file}` includes was not read", line(include)));
    }
    robot_chain::entry(scope, steps, Heading { name, title, line: line(model), remarks, links: way.links })
}

impl<'a, 'i, 'c> Walk<'a, 'i, 'c> {
    /// Walks through the children of a body or of a frame in it.
    fn inside(
        &mut self,
        scope: &Scope<'_>,
        of: Element<'a, 'i>,
        link: &str,
        frames: &[Frame<'a, 'i, 'c>],
        class: Option<&'a str>,
    ) -> Result<()> {
        for own in of.children().filter(Element::is_element) {
            match own.tag_name().name() {
                "body" => self.body(scope, own, link, frames, class)?,
                "frame" => {
                    let frames = [frames, &[Frame::Of(self.part(scope, own, None)?)]].concat();
                    self.inside(scope, own, link, &frames, own.attribute("childclass").or(class))?;
                }
                "site" => self.site(scope, own, link, frames, class)?,
                "joint" | "freejoint" if !frames.is_empty() || link == WORLD => {
                    let message = "found a joint that is not directly in its body, expected it there";
                    return Err(scope.fail(line(own), message));
                }
                "include" | "attach" | "replicate" => return Err(refused(scope, own)),
                _ => {}
            }
        }
        Ok(())
    }

    fn body(
        &mut self,
        scope: &Scope<'_>,
        body: Element<'a, 'i>,
        parent: &str,
        frames: &[Frame<'a, 'i, 'c>],
        class: Option<&'a str>,
    ) -> Result<()> {
        let unnamed = || format!("body {} of line {}", self.links.len(), line(body));
        let name = body.attribute("name").map_or_else(unnamed, str::to_owned);
        let class = body.attribute("childclass").or(class);
        let mut frames = [frames, &[Frame::Of(self.part(scope, body, None)?)]].concat();
        let mut above = parent.to_owned();
        for joint in body.children().filter(|own| own.has_tag_name("joint") || own.has_tag_name("freejoint")) {
            let part = self.part(scope, joint, class)?;
            let has = |attribute: &str| part.attribute(attribute).is_some();
            if has("pos") {
                frames.push(Frame::Anchor(part, false));
            }
            let below = format!("{name} behind joint {}", self.joints.len());
            self.join(&above, below.clone(), std::mem::take(&mut frames), Some(part), line(joint));
            if has("ref") {
                frames.push(Frame::Reference(part));
            }
            if has("pos") {
                frames.push(Frame::Anchor(part, true));
            }
            above = below;
        }
        // Without anything between the last joint and the body they are one link.
        match self.joints.last_mut() {
            Some(last) if frames.is_empty() && last.child == above => {
                last.child.clone_from(&name);
                self.links.pop();
                self.links.push(name.clone());
            }
            _ => self.join(&above, name.clone(), frames, None, line(body)),
        }
        self.inside(scope, body, &name, &[], class)
    }

    fn site(
        &mut self,
        scope: &Scope<'_>,
        site: Element<'a, 'i>,
        link: &str,
        frames: &[Frame<'a, 'i, 'c>],
        class: Option<&'a str>,
    ) -> Result<()> {
        let Some(name) = site.attribute("name") else { return Ok(()) };
        let shown = if self.bodies.contains(name) || name == WORLD { format!("site:{name}") } else { name.to_owned() };
        let frames = [frames, &[Frame::Of(self.part(scope, site, class)?)]].concat();
        self.join(link, shown, frames, None, line(site));
        Ok(())
    }

    fn join(
        &mut self,
        parent: &str,
        child: String,
        frames: Vec<Frame<'a, 'i, 'c>>,
        joint: Option<Part<'a, 'i, 'c>>,
        line: usize,
    ) {
        let name = joint.and_then(|joint| joint.element.attribute("name"));
        self.joints.push(Joint {
            name: name.map(str::to_owned),
            line,
            is_fixed: joint.is_none(),
            follows: name.and_then(|name| self.follows.get(name)).map(|&other| other.to_owned()),
            parent: parent.to_owned(),
            child: child.clone(),
        });
        self.links.push(child);
        self.between.push(Between { frames, joint });
    }

    /// Returns an element with the defaults of its class, or of that of the bodies around it.
    fn part(&self, scope: &Scope<'_>, element: Element<'a, 'i>, around: Option<&'a str>) -> Result<Part<'a, 'i, 'c>> {
        // Bodies and frames have no defaults.
        let is_plain = matches!(element.tag_name().name(), "body" | "frame");
        let named = if is_plain { element.attribute("childclass") } else { element.attribute("class").or(around) };
        let class = match named {
            Some(name) => Some(self.classes.get(name).ok_or_else(|| {
                let mut known: Vec<&str> = self.classes.keys().copied().collect();
                known.sort_unstable();
                let expected = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
                scope.fail(line(element), format!("found the default class `{name}`, expected one of {expected}"))
            })?),
            None => self.classes.get(MAIN),
        };
        Ok(Part { element, class: class.filter(|_| !is_plain) })
    }
}

/// The class of elements that name none.
const MAIN: &str = "main";

/// Returns the default classes of a model, each with what it inherits.
fn classes<'a>(scope: &Scope<'_>, model: Element<'a, '_>) -> Result<HashMap<&'a str, Class<'a>>> {
    let mut all = HashMap::new();
    for top in model.children().filter(|own| own.has_tag_name("default")) {
        let name = top.attribute("class").unwrap_or(MAIN);
        class(scope, top, name, all.get(MAIN).cloned().unwrap_or_default(), &mut all)?;
    }
    Ok(all)
}

fn class<'a>(
    scope: &Scope<'_>,
    element: Element<'a, '_>,
    name: &'a str,
    mut own: Class<'a>,
    all: &mut HashMap<&'a str, Class<'a>>,
) -> Result<()> {
    for part in element.children().filter(|own| own.has_tag_name("joint") || own.has_tag_name("site")) {
        own.extend(part.attributes().map(|a| ((part.tag_name().name(), a.name()), (a.value(), line(part)))));
    }
    for inner in element.children().filter(|own| own.has_tag_name("default")) {
        let Some(name) = inner.attribute("class") else {
            return Err(scope.fail(line(inner), "found a default class without name, expected `class`"));
        };
        class(scope, inner, name, own.clone(), all)?;
    }
    // The outermost class is also that of elements that name none.
    if element.parent().is_some_and(|parent| parent.has_tag_name("mujoco")) && name != MAIN {
        all.insert(MAIN, own.clone());
    }
    all.insert(name, own);
    Ok(())
}

/// Returns the joints that follow others, by equality constraints.
fn follows<'a>(model: Element<'a, '_>) -> HashMap<&'a str, &'a str> {
    let constraints = model.children().filter(|own| own.has_tag_name("equality")).flat_map(|own| own.children());
    constraints
        .filter(|own| own.has_tag_name("joint"))
        .filter_map(|own| Some((own.attribute("joint1")?, own.attribute("joint2")?)))
        .collect()
}

/// Returns the kind of a joint; `None` for a fixed one.
fn kind(scope: &Scope<'_>, joint: Option<&Part<'_, '_, '_>>) -> Result<Option<JointKind>> {
    let Some(joint) = joint else { return Ok(None) };
    let (found, at) = match joint.element.tag_name().name() {
        "freejoint" => ("free", line(joint.element)),
        _ => joint.attribute("type").unwrap_or(("hinge", line(joint.element))),
    };
    match found {
        "hinge" => Ok(Some(JointKind::Revolute)),
        "slide" => Ok(Some(JointKind::Prismatic)),
        _ => {
            let hint = if found == "free" { "; --base-link BODY begins behind it" } else { "" };
            let message = format!("joint type `{found}`; hinge and slide are read{hint}");
            Err(Error::Unsupported(message).at(scope.path, at))
        }
    }
}

impl Orientations {
    /// Reads the numbers of a joint of the chain.
    fn step(&self, scope: &Scope<'_>, own: &Between<'_, '_, '_>, kind: Option<JointKind>) -> Result<Step> {
        let origins = own.frames.iter().map(|frame| self.frame(scope, *frame)).collect::<Result<_>>()?;
        let (axis, limits) = match (&own.joint, kind) {
            (Some(joint), Some(kind)) => (joint_axis(scope, joint)?, self.limits(scope, joint, kind)?),
            // Fixed frames have no axis that counts.
            _ => (along(0), [f64::NEG_INFINITY, f64::INFINITY]),
        };
        let name = own.joint.and_then(|joint| joint.element.attribute("name")).map(str::to_owned);
        Ok(Step { name, kind, origins, axis, limits })
    }

    fn frame(&self, scope: &Scope<'_>, frame: Frame<'_, '_, '_>) -> Result<Origin> {
        Ok(match frame {
            Frame::Of(part) => {
                if let Some((_, at)) = part.attribute("fromto") {
                    return Err(scope.fail(at, "found a site with `fromto` as tip, expected one with `pos`"));
                }
                Origin { position: position(scope, &part, false)?, turns: self.turns(scope, &part)? }
            }
            Frame::Anchor(part, is_back) => Origin { position: position(scope, &part, is_back)?, turns: Vec::new() },
            Frame::Reference(part) => self.reference(scope, &part, kind(scope, Some(&part))?)?,
        })
    }

    /// Returns the limits of a joint, where it has some.
    fn limits(&self, scope: &Scope<'_>, joint: &Part<'_, '_, '_>, kind: JointKind) -> Result<[f64; 2]> {
        let unlimited = [f64::NEG_INFINITY, f64::INFINITY];
        let range = joint.attribute("range");
        let is_limited = match joint.attribute("limited") {
            Some(("true", _)) => true,
            Some(("false", _)) => false,
            Some(("auto", _)) | None => range.is_some() && self.autolimits,
            Some((found, at)) => {
                return Err(scope.fail(at, format!("found \"{found}\" as `limited`, expected true, false or auto")));
            }
        };
        if !is_limited {
            return Ok(unlimited);
        }
        let Some((text, at)) = range else {
            return Err(scope.fail(line(joint.element), "found a limited joint without `range`, expected one"));
        };
        let [lower, upper] = numbers::<2>(scope, text, at, "range")?;
        let read = |node| scope.number(node, Quantity::Ratio, "range").map(|number| number.to_f64());
        let (lower, upper) = (read(&lower)?, read(&upper)?);
        if lower > upper {
            let message = format!("found the limits [{lower}, {upper}], expected the lower one first");
            return Err(scope.fail(at, message));
        }
        let is_degrees = self.is_degrees && kind == JointKind::Revolute;
        Ok([lower, upper].map(|x| if is_degrees { x.to_radians() } else { x }))
    }
}

/// Returns the `pos` of a part, or the way back from it.
fn position(scope: &Scope<'_>, part: &Part<'_, '_, '_>, is_back: bool) -> Result<[Number; 3]> {
    let mut position = nowhere();
    if let Some((text, at)) = part.attribute("pos") {
        for (length, mut node) in position.iter_mut().zip(numbers::<3>(scope, text, at, "pos")?) {
            if is_back {
                node = negated(node);
            }
            *length = scope.length(&node, "pos")?;
        }
    }
    Ok(position)
}

/// Refuses a model whose bodies stand in another file.
fn refuse_include(scope: &Scope<'_>, model: Element<'_, '_>) -> Result<()> {
    child(model, "include").map_or(Ok(()), |include| Err(refused(scope, include)))
}

/// Returns the error for an element that stands for bodies of elsewhere, with the command that writes them.
fn refused(scope: &Scope<'_>, element: Element<'_, '_>) -> Error {
    let (tag, path) = (element.tag_name().name(), scope.path);
    let model = format!("mujoco.MjModel.from_xml_path('{path}')");
    let command = format!("python3 -c \"import mujoco; mujoco.mj_saveLastXML('whole.xml', {model})\"");
    scope.fail(line(element), format!("found <{tag}>, expected a model in one file: write it first by `{command}`"))
}
