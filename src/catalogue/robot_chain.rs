//! The chain of a robot description between two links, as screw axes in the home position.

use super::entry::{Design, Entry, Labels};
use super::geometry::check_kinds;
use super::node::{Node, Value};
use super::options::Options;
use super::robot_tip::tip_of;
use super::robot_tree::Tree;
use super::scope::Scope;
use super::srdf;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::{Angle, Number};
use crate::algebra::real_field::RealField;
use crate::algebra::ring::Ring;
use crate::algebra::surd::Closed;
use crate::error::Result;
use crate::kinematics::chain::{Chain, Geometry, JointKind, Placement, ScrewJoint};
use crate::kinematics::freedom::Freedom;
use crate::kinematics::known_motion::KnownMotion;
use crate::kinematics::motion::Motion;
use crate::kinematics::placement::rotation_of;
use crate::kinematics::platform_limits::PlatformLimits;
use rug::Rational;

/// Maximum number of joints between base and tip, fixed ones included; their exact rotations then have half a million digits.
pub(super) const LONGEST: usize = 100;

/// The joints from the base link to the tip link, the names of these links, and the reason for the choice of the tip.
pub(super) struct Between {
    pub(super) path: Vec<usize>,
    pub(super) links: [String; 2],
    pub(super) remark: Option<String>,
}

/// Returns the requested chain, else that of the only arm.
pub(super) fn between(scope: &Scope<'_>, tree: &Tree, options: &Options) -> Result<Between> {
    let group = match &options.group {
        Some((path, group)) => srdf::ends(path, group, &|joint| tree.ends_of(joint))?,
        None => srdf::Ends::default(),
    };
    let (base, tip) = (options.base_link.clone().or(group.base), options.tip_link.clone().or(group.tip));
    let base = base.as_ref().map(|base| tree.known(scope, base)).transpose()?;
    let (tip, remark) = if let Some(tip) = &tip {
        (tree.known(scope, tip)?, None)
    } else {
        let tip = tip_of(scope, tree, base)?;
        (tip.link, Some(tip.remark))
    };
    let Some(path) = tree.path(base, tip, usize::MAX) else {
        let message = format!("found no chain from link `{}` to link `{tip}`, expected one", base.unwrap_or_default());
        return Err(scope.fail(tree.line, message));
    };
    let start = path.first().map_or(tip, |joint| tree.joints[*joint].parent.as_str());
    let links = [start.to_owned(), tip.to_owned()];
    Ok(Between { path, links, remark })
}

/// Refuses chains that are no arms before their numbers are read: the exact axes of long ones have long numbers.
pub(super) fn check(scope: &Scope<'_>, line: usize, kinds: &[Option<JointKind>]) -> Result<()> {
    let moving: Vec<JointKind> = kinds.iter().flatten().copied().collect();
    let expected = (6, "expected 1 to 24 for an arm; name the chain by its base and tip links");
    let freedom = || Freedom { variables: moving.len(), rank: None, spins: false };
    check_kinds(scope, &moving, freedom, line, expected)?;
    if kinds.len() > LONGEST {
        let found = kinds.len();
        return Err(scope.fail(line, format!("found a chain of {found} joints, expected at most {LONGEST}")));
    }
    Ok(())
}

/// A rotation of a description.
pub(super) enum Turn {
    /// About a coordinate axis.
    About(usize, Angle),
    /// By a quaternion `[w, x, y, z]` of any length but zero, exact numbers.
    Quaternion([Number; 4]),
}

/// Where a frame stands in the one before it: at a position, turned by rotations of which each is about axes that the ones
/// before it have turned.
pub(super) struct Origin {
    pub(super) position: [Number; 3],
    pub(super) turns: Vec<Turn>,
}

impl Origin {
    /// Returns the numbers of the origin in closed form; `None` if one has none.
    fn closed(&self) -> Option<Vec<Closed>> {
        let mut all: Vec<Closed> = self.position.iter().map(Number::closed).collect::<Option<_>>()?;
        for turn in &self.turns {
            if let Turn::About(_, angle) = turn {
                let (cos, sin) = angle.phase()?;
                all.extend([cos, sin]);
            }
        }
        Some(all)
    }

    /// Returns the motion; `None` for an angle that is not known well enough.
    fn motion(&self, field: Option<&RealField>) -> Option<KnownMotion> {
        let position = self.position.each_ref();
        let algebraic = field.and_then(|field| {
            let [x, y, z] = position.map(|x| field.element(&x.closed()?));
            Some(Motion { translation: [x?, y?, z?], ..Motion::identity() })
        });
        let start = KnownMotion {
            exact: Motion::translation(position.map(|x| x.rational().clone())),
            enclosed: Motion::translation(position.map(enclosed)),
            algebraic,
        };
        self.turns.iter().try_fold(start, |motion, turn| Some(motion.then_after(&turn.motion(field)?)))
    }
}

impl Turn {
    fn motion(&self, field: Option<&RealField>) -> Option<KnownMotion> {
        match self {
            Self::About(axis, angle) => {
                let mut angles: [Angle; 3] = std::array::from_fn(|_| Angle::zero());
                angles[*axis] = angle.clone();
                let algebraic = field.and_then(|field| {
                    let phase = |angle: &Angle| {
                        let (cos, sin) = angle.phase()?;
                        Some((field.element(&cos)?, field.element(&sin)?))
                    };
                    let [roll, pitch, yaw] = angles.each_ref().map(phase);
                    Some(Motion::turned([roll?, pitch?, yaw?]))
                });
                Some(KnownMotion {
                    exact: Motion::<Rational>::roll_pitch_yaw(&angles)?,
                    enclosed: Motion::<Enclosure>::roll_pitch_yaw(&angles)?,
                    algebraic,
                })
            }
            Self::Quaternion(quaternion) => {
                let rotation = rotation_of(quaternion.each_ref().map(Number::rational));
                let algebraic = field.and_then(|field| {
                    let whole =
                        Motion { rotation: rotation.clone(), translation: std::array::from_fn(|_| Rational::new()) };
                    whole.map(|x| field.element(&Closed::rational(x.clone())))
                });
                let enclosed = rotation.each_ref().map(|row| row.each_ref().map(Enclosure::of));
                let no_way = || std::array::from_fn(|_| Enclosure::zero());
                Some(KnownMotion {
                    exact: Motion { rotation, translation: std::array::from_fn(|_| Rational::new()) },
                    enclosed: Motion { rotation: enclosed, translation: no_way() },
                    algebraic,
                })
            }
        }
    }
}

/// Returns an enclosure of a number.
fn enclosed(x: &Number) -> Enclosure {
    Enclosure::from_number(x).unwrap_or_else(Enclosure::zero)
}

/// A joint of the chain, or a fixed frame.
pub(super) struct Step {
    pub(super) name: Option<String>,
    /// None for a fixed one.
    pub(super) kind: Option<JointKind>,
    /// The frames from that of the step before to that of the joint.
    pub(super) origins: Vec<Origin>,
    pub(super) axis: [Number; 3],
    pub(super) limits: [f64; 2],
}

/// What stands at the top of a description.
pub(super) struct Heading<'a> {
    pub(super) name: &'a str,
    pub(super) title: &'a str,
    pub(super) line: usize,
    pub(super) remarks: Vec<String>,
    pub(super) links: [String; 2],
}

/// Returns the arm of a chain; it has no pose.
pub(super) fn entry(scope: &Scope<'_>, steps: Vec<Step>, heading: Heading<'_>) -> Result<Entry> {
    let field = field(&steps);
    let (mut joints, mut limits, mut names) = (Vec::new(), Vec::new(), Vec::new());
    let mut home = KnownMotion::identity();
    for step in steps {
        for origin in &step.origins {
            let unknown = || scope.fail(heading.line, "found an angle that is not known well enough");
            home = home.then_after(&origin.motion(field.as_ref()).ok_or_else(unknown)?);
        }
        let Some(kind) = step.kind else { continue };
        let (axis, point) = (home.direction(field.as_ref(), &step.axis), home.point(field.as_ref()));
        joints.push(ScrewJoint { kind, axis, point, pitch: None });
        limits.push(step.limits);
        names.push(step.name);
    }
    let home = home.placement(field.as_ref());
    let geometry = Geometry::Screws { joints, home: Box::new(home) };
    let chain = Chain { geometry, base: Placement::identity(), tool: Placement::identity() };
    let Heading { name, title, remarks, links, .. } = heading;
    Ok(Entry {
        name: name.to_owned(),
        title: title.to_owned(),
        source: None,
        notes: None,
        design: Design::Arm(chain),
        limits,
        platform_limits: PlatformLimits::default(),
        cases: Vec::new(),
        rounded: scope.is_rounded(),
        reading: scope.reading.clone(),
        labels: Labels { joints: names, links: Some(links), snapped: scope.take_snapped(), remarks },
    })
}

/// Returns the field of all numbers of a chain, if there is one.
fn field(steps: &[Step]) -> Option<RealField> {
    let mut all = Vec::new();
    for step in steps {
        for origin in &step.origins {
            all.extend(origin.closed()?);
        }
        for entry in &step.axis {
            all.push(entry.closed()?);
        }
    }
    RealField::containing(&all)
}

/// Returns the numbers of an attribute, each as a node of the attribute's line.
pub(super) fn numbers<const N: usize>(scope: &Scope<'_>, text: &str, line: usize, what: &str) -> Result<[Node; N]> {
    let nodes: Vec<Node> =
        text.split_whitespace().map(|word| Node { line, value: Value::Text(word.to_owned()) }).collect();
    let count = nodes.len();
    <[Node; N]>::try_from(nodes)
        .map_err(|_| scope.fail(line, format!("found {count} numbers in `{what}`, expected {N}")))
}

/// Returns the zero displacement.
pub(super) fn nowhere() -> [Number; 3] {
    std::array::from_fn(|_| Number::zero())
}

/// Returns the direction of a coordinate axis.
pub(super) fn along(axis: usize) -> [Number; 3] {
    std::array::from_fn(|k| Number::exact(Rational::from(u32::from(k == axis))))
}
