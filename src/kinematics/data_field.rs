//! The number field of a mechanism: all of its numbers are sums of cosines of parts of a turn and square roots.

use super::chain::{Chain, Geometry, Placement, ScrewJoint};
use super::closed_loop::{Parameter, Parameters};
use super::motion::{Motion, dot};
use crate::algebra::number::{Angle, Number};
use crate::algebra::number_field::Algebraic;
use crate::algebra::real_field::RealField;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::surd::{Closed, Phase, Surd};
use std::sync::Arc;

/// A motion that is no rational one, in closed form.
#[derive(Clone, Debug, PartialEq)]
pub enum ClosedForm {
    /// Its entries.
    Entries(Box<Motion<Closed>>),
    /// The pose of an arm with these motions of its joint variables.
    Joints(Arc<Vec<JointMotion>>),
}

/// The motion of one joint variable in closed form.
#[derive(Clone, Debug, PartialEq)]
pub enum JointMotion {
    /// Cosine and sine of an angle.
    Turn(Phase),
    /// A distance.
    Shift(Closed),
}

impl JointMotion {
    /// The motion by an angle; `None` where no closed form is known.
    #[must_use]
    pub fn turn(angle: &Angle) -> Option<Self> {
        angle.phase().map(Self::Turn)
    }

    /// The motion by a distance; `None` where no closed form is known.
    #[must_use]
    pub fn shift(distance: &Number) -> Option<Self> {
        distance.closed().map(Self::Shift)
    }

    fn numbers(&self) -> Vec<Closed> {
        match self {
            Self::Turn((cos, sin)) => vec![cos.clone(), sin.clone()],
            Self::Shift(distance) => vec![distance.clone()],
        }
    }
}

/// Largest number of bits of a number whose square root is adjoined: each root doubles the degree of the field, and every axis of
/// a file of decimals has its own. Three components of six digits each have a radicand of this size.
const LONGEST_RADICAND: u32 = 42;

/// A real number field that holds the numbers of a mechanism.
#[derive(Clone, Debug)]
pub struct DataField(pub RealField);

/// The numbers of a chain in closed form; `None` where one has none.
#[must_use]
pub fn numbers(chain: &Chain) -> Option<Vec<Closed>> {
    let mut found = Vec::new();
    match &chain.geometry {
        Geometry::Dh(joints) | Geometry::ModifiedDh(joints) => {
            for joint in joints {
                found.extend([joint.a.closed()?, joint.d.closed()?]);
                for (cos, sin) in [joint.alpha.phase()?, joint.theta0.phase()?] {
                    found.extend([cos, sin]);
                }
            }
        }
        Geometry::Screws { joints, .. } => {
            for number in joints.iter().flat_map(|joint| joint.axis.iter().chain(&joint.point)) {
                found.push(number.closed()?);
            }
        }
    }
    Some(found)
}

/// The numbers of a placement that are not rational; `None` where one has no closed form.
fn placed(placement: &Placement) -> Option<Vec<Closed>> {
    match (&placement.closed, &placement.given) {
        (Some(ClosedForm::Entries(motion)), _) => {
            Some(motion.rotation.iter().flatten().chain(&motion.translation).cloned().collect())
        }
        (Some(ClosedForm::Joints(motions)), _) => Some(motions.iter().flat_map(JointMotion::numbers).collect()),
        (None, None) => Some(Vec::new()),
        (None, Some(_)) => None,
    }
}

impl DataField {
    /// The field of the numbers of a chain, of a pose and of a joint variable, if there is one of a moderate degree.
    #[must_use]
    pub fn of(chain: &Chain, pose: Option<&Placement>, given: Option<&JointMotion>) -> Option<Self> {
        Self::holding(chain, pose, given)
    }

    /// The field of the numbers of a chain, of further motions and of some joint variables, if there is one of a moderate
    /// degree.
    #[must_use]
    pub fn holding<'a>(
        chain: &'a Chain,
        motions: impl IntoIterator<Item = &'a Placement>,
        given: impl IntoIterator<Item = &'a JointMotion>,
    ) -> Option<Self> {
        let mut placements = vec![&chain.base, &chain.tool];
        placements.extend(motions);
        if let Geometry::Screws { home, .. } = &chain.geometry {
            placements.push(home);
        }
        // Rounded poses are frequent, and recognised at once.
        let mut all = Vec::new();
        for placement in placements {
            all.extend(placed(placement)?);
        }
        all.extend(numbers(chain)?);
        if let Geometry::Screws { joints, .. } = &chain.geometry {
            for joint in joints {
                all.push(length(joint)?);
            }
        }
        all.extend(given.into_iter().flat_map(JointMotion::numbers));
        RealField::containing(&all).map(Self)
    }

    /// Whether all numbers are rational.
    #[must_use]
    pub fn is_rational(&self) -> bool {
        self.0.degree() == 1
    }

    /// The motion of a joint variable; `None` for one of another field.
    #[must_use]
    pub fn motion(&self, motion: &JointMotion) -> Option<Motion<Algebraic>> {
        Some(match motion {
            JointMotion::Turn((cos, sin)) => Motion::rotation_z(self.0.element(cos)?, self.0.element(sin)?),
            JointMotion::Shift(distance) => Motion::translation_z(self.0.element(distance)?),
        })
    }

    /// The pose of an arm; `None` for one of another field.
    #[must_use]
    pub fn pose(&self, chain: &Chain, pose: &Placement) -> Option<Motion<Algebraic>> {
        match &pose.closed {
            Some(ClosedForm::Joints(motions)) => {
                let motions: Option<Vec<_>> = motions.iter().map(|motion| self.motion(motion)).collect();
                chain.forward_over(self, &motions?)
            }
            _ => self.placement(pose),
        }
    }

    fn vector(&self, numbers: [&Number; 3]) -> Option<[Algebraic; 3]> {
        let [x, y, z] = numbers.map(|x| self.0.element(&x.closed()?));
        Some([x?, y?, z?])
    }
}

/// The length of the axis of a screw joint, if its square is rational.
fn length(joint: &ScrewJoint) -> Option<Closed> {
    let axis: Option<Vec<Closed>> = joint.axis.iter().map(Number::closed).collect();
    let axis = axis?;
    let square = axis.iter().try_fold(Closed::from_small(0), |sum, x| sum.add(&x.mul(x)?))?;
    let field = RealField::containing(axis.iter().chain([&square]))?;
    let length = Surd::square_root(&field.element(&square)?.rational()?)?;
    // The square root of a multiprecision number belongs to a direction that was rounded.
    let is_short = length.terms().all(|(_, radicand, _)| radicand.significant_bits() <= LONGEST_RADICAND);
    is_short.then(|| length.into())
}

impl Parameters<Algebraic> for DataField {
    fn angle(&self, _joint: usize, _parameter: Parameter, value: &Angle) -> Option<(Algebraic, Algebraic)> {
        let (cos, sin) = value.phase()?;
        Some((self.0.element(&cos)?, self.0.element(&sin)?))
    }

    fn length(&self, _joint: usize, _parameter: Parameter, value: &Number) -> Option<Algebraic> {
        self.0.element(&value.closed()?)
    }

    fn frame(&self, joint: &ScrewJoint) -> Option<Motion<Algebraic>> {
        let axis = self.vector(joint.axis.each_ref())?;
        let inverse = self.0.element(&length(joint)?)?.inverse()?;
        super::axis_frame::frame(
            axis.map(|x| x.mul(&inverse)),
            self.vector(joint.point.each_ref())?,
            |z| *z == Algebraic::from_integer(-1),
            |x, y| Some(x.mul(&y.inverse()?)),
        )
    }

    fn placement(&self, placement: &Placement) -> Option<Motion<Algebraic>> {
        let Some(ClosedForm::Entries(motion)) = &placement.closed else {
            return placement.given.is_none().then(|| placement.exact.map(Algebraic::from_rational))?;
        };
        let motion = motion.map(|x| self.0.element(x))?;
        // A matrix that is no rotation in the field was rounded.
        let unit = |i: usize, j: usize| {
            dot(&motion.rotation[i], &motion.rotation[j]) == Algebraic::from_integer(i32::from(i == j))
        };
        (0..3).all(|i| (0..=i).all(|j| unit(i, j))).then_some(motion)
    }
}
