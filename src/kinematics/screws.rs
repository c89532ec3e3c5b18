//! Chains as screws of one variable each: with joints held at a value, and with virtual joints behind the tool.

use super::chain::{Chain, Geometry, JointKind, Placement, ScrewJoint};
use super::closed_loop::{Parameters, Variable, angle_motion, distance_motion};
use super::data_field::{DataField, JointMotion};
use super::known_motion::KnownMotion;
use super::motion::Motion;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::{Angle, Number};
use crate::algebra::ring::Ring;
use rug::Rational;

/// The value at which a joint variable is held.
#[derive(Clone, Debug, PartialEq)]
pub enum Held {
    /// An angle.
    Angle(Angle),
    /// A distance.
    Distance(Number),
}

impl Held {
    /// Whether it is known exactly.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        match self {
            Self::Angle(angle) => angle.is_exact(),
            Self::Distance(distance) => distance.is_exact(),
        }
    }

    /// The value in radians or metres.
    #[must_use]
    pub fn value(&self) -> f64 {
        match self {
            Self::Angle(angle) => angle.radians(),
            Self::Distance(distance) => distance.to_f64(),
        }
    }

    /// The motion of the joint.
    fn motion<R: Ring>(&self) -> Option<Motion<R>> {
        match self {
            Self::Angle(angle) => angle_motion(angle),
            Self::Distance(distance) => distance_motion(distance),
        }
    }

    /// The motion of the joint in closed form, where one is known.
    fn in_closed_form(&self) -> Option<JointMotion> {
        match self {
            Self::Angle(angle) => JointMotion::turn(angle),
            Self::Distance(distance) => JointMotion::shift(distance),
        }
    }
}

/// A coordinate axis of the tool, through its origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VirtualJoint {
    /// Its kind.
    pub variable: Variable,
    /// Which axis: 0 is x.
    pub axis: usize,
}

/// The part behind the tool.
#[derive(Clone, Debug, PartialEq)]
pub enum Behind {
    /// A joint along a coordinate axis.
    Joint(VirtualJoint),
    /// A spherical joint at the origin.
    Spherical,
    /// A constant motion.
    Constant(Box<Placement>),
}

impl Chain {
    /// The chain as screws of one variable each, in joint order: held variables are constants, and the virtual joints
    /// stand behind the tool. The pose it reaches is that of the chain with all virtual variables zero.
    #[must_use]
    pub fn in_screws(&self, held: &[(usize, Held)], behind: &[Behind]) -> Option<Self> {
        let field = self.field_with(held, behind);
        let Frames { joints: own, base, mut tool } = self.frames(held, field.as_ref())?;
        let field = field.as_ref().map(|field| &field.0);
        let kind = |variable: &Variable| match variable {
            Variable::Rotation => JointKind::Revolute,
            Variable::Translation => JointKind::Prismatic,
        };
        let screw = |kind: JointKind, frame: &KnownMotion, axis: usize| {
            let along = std::array::from_fn(|i| Number::exact(Rational::from(u32::from(i == axis))));
            ScrewJoint { kind, axis: frame.direction(field, &along), point: frame.point(field), pitch: None }
        };
        let mut joints: Vec<ScrewJoint> = own.iter().map(|(variable, frame)| screw(kind(variable), frame, 2)).collect();
        for own in behind {
            match own {
                Behind::Joint(own) => joints.push(screw(kind(&own.variable), &tool, own.axis)),
                Behind::Spherical => joints.push(screw(JointKind::Spherical, &tool, 2)),
                Behind::Constant(constant) => {
                    let algebraic = field.and_then(|field| DataField(field.clone()).placement(constant));
                    let constant = KnownMotion { exact: constant.image()?, enclosed: constant.image()?, algebraic };
                    tool = tool.then_after(&constant);
                }
            }
        }
        let geometry = Geometry::Screws { joints, home: Box::new(tool.placement(field)) };
        Some(Self { geometry, base: base.placement(field), tool: Placement::identity() })
    }

    /// The field that holds the numbers of the chain, of what is held and of what stands behind the tool.
    fn field_with(&self, held: &[(usize, Held)], behind: &[Behind]) -> Option<DataField> {
        let given: Option<Vec<JointMotion>> = held.iter().map(|(_, value)| value.in_closed_form()).collect();
        let constants = behind.iter().filter_map(|own| match own {
            Behind::Constant(constant) => Some(constant.as_ref()),
            Behind::Joint(_) | Behind::Spherical => None,
        });
        DataField::holding(self, constants, &given?)
    }

    /// The frames of the joints that are not held, each with its z axis along the joint, and the frame of the tool, in the
    /// home position.
    ///
    /// They are seen from behind a joint that is held at a value that is not exact, if most joints are there: incidences of axes
    /// between which all is exact remain exact.
    fn frames(&self, held: &[(usize, Held)], field: Option<&DataField>) -> Option<Frames> {
        let (variables, exact) = self.unknowns_and_constants::<Rational>()?;
        let (_, enclosed) = self.unknowns_and_constants::<Enclosure>()?;
        let algebraic = field.and_then(|field| Some(self.unknowns_and_constants_over(field)?.1));
        let mut constants = exact.into_iter().zip(enclosed).enumerate().map(|(k, (exact, enclosed))| {
            let algebraic = algebraic.as_ref().and_then(|all| all.get(k).cloned());
            KnownMotion { exact, enclosed, algebraic }
        });
        let mut part = Part { joints: Vec::new(), whole: constants.next()? };
        let mut parts = Vec::new();
        for (k, (variable, constant)) in variables.into_iter().zip(constants).enumerate() {
            match held.iter().find(|(own, _)| *own == k) {
                Some((_, value)) => {
                    let algebraic = field.zip(value.in_closed_form()).and_then(|(field, own)| field.motion(&own));
                    let turned = KnownMotion { exact: value.motion()?, enclosed: value.motion()?, algebraic };
                    part.whole = part.whole.then_after(&turned);
                    if turned.algebraic.is_none() {
                        parts.push(part);
                        part = Part { joints: Vec::new(), whole: KnownMotion::identity() };
                    }
                }
                None => part.joints.push((variable, part.whole.clone())),
            }
            part.whole = part.whole.then_after(&constant);
        }
        parts.push(part);
        Some(Frames::of(&parts))
    }
}

/// The joints between two that are held at values that are not exact, or between one of these and an end of the chain.
struct Part {
    /// The frames of the joints that are not held, seen from the beginning of the part.
    joints: Vec<(Variable, KnownMotion)>,
    /// The motion from its beginning to its end.
    whole: KnownMotion,
}

/// The frames of the joints, and that of the tool.
struct Frames {
    joints: Vec<(Variable, KnownMotion)>,
    /// From the world to what they are seen from.
    base: KnownMotion,
    tool: KnownMotion,
}

impl Frames {
    /// The frames seen from the beginning of the first part with the most joints.
    fn of(parts: &[Part]) -> Self {
        let most = parts.iter().map(|part| part.joints.len()).max();
        let chosen = parts.iter().position(|part| Some(part.joints.len()) == most).unwrap_or(0);
        let over =
            |parts: &[Part]| parts.iter().fold(KnownMotion::identity(), |motion, part| motion.then_after(&part.whole));
        let beginning = |k: usize| match k.checked_sub(chosen) {
            Some(_) => over(&parts[chosen..k]),
            None => over(&parts[k..chosen]).inverse(),
        };
        let of_part = |(k, part): (usize, &Part)| {
            let beginning = beginning(k);
            part.joints.iter().map(|(variable, frame)| (*variable, beginning.then_after(frame))).collect::<Vec<_>>()
        };
        let joints = parts.iter().enumerate().flat_map(of_part).collect();
        Self { joints, base: over(&parts[..chosen]), tool: beginning(parts.len()) }
    }
}
