//! The variable that runs in a loop: its input, a link parameter, or a coordinate of the pose of an arm.

use crate::algebra::circle_fraction::CircleFraction;
use crate::algebra::number::{Angle, Number};
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::catalogue::entry::Case;
use crate::derivation::Place;
use crate::kinematics::closed_loop::{Parameter, Parameters, Variable};
use crate::kinematics::motion::Motion;
use rug::Rational;

/// The quantity of a case that runs; all others are the numbers of the file.
#[derive(Clone, Copy, Debug)]
pub(in crate::internal::sweep) struct Moved<'c> {
    pub case: &'c Case,
    pub place: Place,
    pub kind: Variable,
}

/// A running variable with the angle from which its half tangents are counted.
pub(super) struct Running<'c> {
    moved: Moved<'c>,
    /// Cosine and sine of a running angle.
    turn: (CircleFraction, CircleFraction),
}

impl<'c> Moved<'c> {
    /// Whether the input of a loop runs.
    pub fn is_input(&self) -> bool {
        matches!(self.place, Place::Input)
    }

    /// Counted from an angle with this half tangent.
    pub(super) fn at(self, offset: &Rational) -> Running<'c> {
        let square = Rational::from(offset * offset);
        let length = Rational::from(&square + 1);
        let number = |x: Rational| CircleFraction::polynomial(Univariate::constant(x / &length));
        let (cos, sin) = CircleFraction::cosine_and_sine();
        let (c, s) = (number(1 - square), number(Rational::from(offset * 2)));
        let turn = (c.mul(&cos).sub(&s.mul(&sin)), c.mul(&sin).add(&s.mul(&cos)));
        Running { moved: self, turn }
    }
}

impl Running<'_> {
    /// The motion that closes the loop; `None` where nothing is given to close it.
    pub fn closing(&self) -> Option<Motion<CircleFraction>> {
        let case = self.moved.case;
        match (self.moved.place, self.moved.kind) {
            (Place::Input, Variable::Rotation) => Some(Motion::rotation_z(self.turn.0.clone(), self.turn.1.clone())),
            (Place::Input, Variable::Translation) => Some(Motion::translation_z(CircleFraction::variable())),
            (Place::Coordinate(k), _) => {
                let mut pose = case.pose.as_ref()?.exact.map(CircleFraction::from_rational)?;
                pose.translation[k] = CircleFraction::variable();
                Some(pose.inverse())
            }
            (Place::Turn(axis), _) => {
                let pose = case.pose.as_ref()?.exact.map(CircleFraction::from_rational)?;
                let (cos, sin) = self.turn.clone();
                Some(pose.then_after(&Motion::rotation_about(axis, cos, sin)).inverse())
            }
            _ => match (&case.pose, case.input.first()) {
                (Some(pose), _) => pose.exact.inverse().map(CircleFraction::from_rational),
                (None, Some(input)) => input.value.motion(),
                (None, None) => None,
            },
        }
    }

    fn is_at(&self, joint: usize, parameter: Parameter) -> bool {
        matches!(self.moved.place, Place::Link(own, kind) if own == joint && kind == parameter)
    }
}

impl Parameters<CircleFraction> for Running<'_> {
    fn angle(&self, joint: usize, parameter: Parameter, value: &Angle) -> Option<(CircleFraction, CircleFraction)> {
        if self.is_at(joint, parameter) { Some(self.turn.clone()) } else { CircleFraction::cos_sin(value) }
    }

    fn length(&self, joint: usize, parameter: Parameter, value: &Number) -> Option<CircleFraction> {
        if self.is_at(joint, parameter) { Some(CircleFraction::variable()) } else { CircleFraction::from_number(value) }
    }
}
