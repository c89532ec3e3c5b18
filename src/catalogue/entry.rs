//! The content of a mechanism file.

use super::snap::Snapped;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::{Angle, Number, Reading};
use crate::algebra::ring::Ring;
use crate::kinematics::chain::{Chain, Placement};
use crate::kinematics::closed_loop::{angle_motion, distance_motion};
use crate::kinematics::data_field::{ClosedForm, DataField, JointMotion};
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::Motion;
use crate::kinematics::platform::Platform;
use crate::kinematics::platform_limits::PlatformLimits;
use crate::kinematics::tolerance::Tolerance;
use rug::Rational;

/// The kind of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A serial arm at a pose of its tool.
    Arm,
    /// A closed loop with one joint variable given.
    Loop,
    /// A Stewart platform.
    Platform,
}

/// The joints or points of a mechanism.
#[derive(Clone, Debug, PartialEq)]
pub enum Design {
    /// The joints of an arm.
    Arm(Chain),
    /// The joints round a loop.
    Loop(Chain),
    /// The points of a platform.
    Platform(Box<Platform<Number>>),
}

/// The publication a mechanism is taken from.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Key of equations/REFERENCES.md.
    pub key: String,
    /// Place in that reference.
    pub place: Option<String>,
}

/// The value of the given joint variable of a loop.
#[derive(Clone, Debug, PartialEq)]
pub enum InputValue {
    /// The angle of an R or C joint.
    Angle(Angle),
    /// The displacement of a P or C joint.
    Distance(Number),
}

impl InputValue {
    /// Returns the kind of the given joint variable.
    #[must_use]
    pub fn variable(&self) -> Variable {
        match self {
            Self::Angle(_) => Variable::Rotation,
            Self::Distance(_) => Variable::Translation,
        }
    }

    /// Returns whether the value is a rational number, or its half-angle tangent is.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        match self {
            Self::Angle(angle) => angle.is_exact(),
            Self::Distance(distance) => distance.is_exact(),
        }
    }

    /// Returns the motion of the joint variable over a ring.
    pub(crate) fn motion<R: Ring>(&self) -> Option<Motion<R>> {
        match self {
            Self::Angle(angle) => angle_motion(angle),
            Self::Distance(distance) => distance_motion(distance),
        }
    }

    /// Returns the motion of the joint variable in closed form, if one is known.
    #[must_use]
    pub fn in_closed_form(&self) -> Option<JointMotion> {
        match self {
            Self::Angle(angle) => JointMotion::turn(angle),
            Self::Distance(distance) => JointMotion::shift(distance),
        }
    }
}

/// The given joint variable of a loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// The joint, counted from 1.
    pub joint: usize,
    /// Its value.
    pub value: InputValue,
}

/// One problem of a file: a pose of an arm, an input of a loop or the legs of a platform, with the claims about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The pose of an arm, or that from which the legs of a platform were computed.
    pub pose: Option<Placement>,
    /// The given variables of a loop.
    pub input: Vec<Input>,
    /// The squares of the lengths of the legs of a platform.
    pub legs_squared: Option<[Number; 6]>,
    /// One unit of the last printed digit of the pose, which limits its accuracy.
    pub typed: Option<Tolerance>,
    /// What typing rounded the pose by, at most: one unit of the last digit of its decimals, 0 where it has whole numbers and
    /// expressions only.
    pub rounding: Option<Tolerance>,
    /// Claims about this case.
    pub expected: Expected,
    /// Warnings to repeat in every report on this case (for example about a projected pose).
    pub warnings: Vec<String>,
    /// Line of the file at which the case begins, from 1.
    pub line: usize,
}

impl Case {
    /// Returns a pose of an arm, without claims.
    #[must_use]
    pub fn at(pose: Placement, line: usize) -> Self {
        Self { pose: Some(pose), ..Self::empty(line) }
    }

    /// Returns the pose that an arm reaches with these values of its joint variables; `None` if there are too few.
    #[must_use]
    pub fn reached(chain: &Chain, values: &[InputValue], line: usize) -> Option<Self> {
        let motions: Vec<Motion<Rational>> = values.iter().map(InputValue::motion).collect::<Option<_>>()?;
        let exact = chain.forward(&motions)?;
        let is_rational = || DataField::of(chain, None, None).is_some_and(|field| field.is_rational());
        if values.iter().all(InputValue::is_exact) && is_rational() {
            return Some(Self::at(Placement::from_motion_exact(exact), line));
        }
        let motions: Vec<Motion<Enclosure>> = values.iter().map(InputValue::motion).collect::<Option<_>>()?;
        let enclosed = chain.forward(&motions)?;
        let closed: Option<Vec<JointMotion>> = values.iter().map(InputValue::in_closed_form).collect();
        let is_in_field = closed.as_ref().is_some_and(|motions| DataField::holding(chain, None, motions).is_some());
        let pose = match closed.filter(|_| is_in_field) {
            Some(motions) => Placement {
                closed: Some(ClosedForm::Joints(motions.into())),
                ..Placement::standing_for(exact, enclosed, true)
            },
            // The nearest rational motion replaces it.
            None => Placement::near(&enclosed),
        };
        Some(Self::at(pose, line))
    }

    /// Returns a loop without input, without claims.
    #[must_use]
    pub fn free(line: usize) -> Self {
        Self::empty(line)
    }

    /// Returns an input of a loop, without claims.
    #[must_use]
    pub fn given(input: Input, line: usize) -> Self {
        Self { input: vec![input], ..Self::empty(line) }
    }

    /// Returns the case of a platform with these squared leg lengths, without claims.
    #[must_use]
    pub fn legs(squares: [Number; 6], line: usize) -> Self {
        let empty: Vec<String> =
            (0..6).filter(|k| *squares[*k].rational() == 0).map(|k| format!("leg {}", k + 1)).collect();
        let warnings = if empty.is_empty() {
            Vec::new()
        } else {
            let legs = empty.join(" and ");
            vec![format!("{legs} of length 0: where the ends of a leg coincide, real solutions are singular")]
        };
        Self { legs_squared: Some(squares), warnings, ..Self::empty(line) }
    }

    /// Returns the case of a platform with the leg lengths of this pose, exact if the pose is; without claims.
    #[must_use]
    pub fn legs_at(platform: &Platform<Number>, pose: Placement, line: usize) -> Self {
        let exact = in_numbers(platform, |x| x.rational().clone());
        let squares = exact.legs_squared(&pose.exact);
        let squares = match &pose.given {
            None => squares.map(Number::exact),
            // The pose has irrational numbers, and so have the legs as a rule.
            Some(given) => {
                let known = |x: &Number| Enclosure::from_number(x).unwrap_or_else(Enclosure::zero);
                let mut enclosed = in_numbers(platform, known).legs_squared(&given.motion).into_iter();
                squares.map(|square| match enclosed.next() {
                    Some(real) => Number::standing_for(square, real),
                    None => Number::rounded(square),
                })
            }
        };
        Self { pose: Some(pose), ..Self::legs(squares, line) }
    }

    fn empty(line: usize) -> Self {
        let (expected, warnings) = (Expected::default(), Vec::new());
        Self {
            pose: None,
            input: Vec::new(),
            legs_squared: None,
            typed: None,
            rounding: None,
            expected,
            warnings,
            line,
        }
    }
}

/// The points of a platform in numbers of another kind.
fn in_numbers<R>(platform: &Platform<Number>, number: impl Fn(&Number) -> R) -> Platform<R> {
    let points = |points: &[[Number; 3]; 6]| points.each_ref().map(|point| point.each_ref().map(&number));
    Platform { base: points(&platform.base), plate: points(&platform.plate) }
}

/// Claims that `looproot check` tests; every one optional.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Expected {
    /// Isolated complex solutions, with multiplicity.
    pub complex: Option<usize>,
    /// Isolated real solutions.
    pub real: Option<usize>,
    /// Dimension of the solution set.
    pub dimension: Option<usize>,
    /// Dimension of the motion of a loop, independent of its inputs.
    pub mobility: Option<usize>,
    /// Rank of the joint screws along that motion.
    pub screw_rank: Option<usize>,
    /// Solutions that must be among those found.
    pub solutions: Vec<Claim>,
}

/// A claimed solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Joint variables in joint order; for a platform the quaternion `w, x, y, z` and the position `x, y, z`.
    pub q: Vec<f64>,
    /// Correct decimal digits of `q`.
    pub digits: u32,
    /// Line of the file, from 1.
    pub line: usize,
}

/// A mechanism file as read.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The file's own name without extension, or a built-in entry's name.
    pub name: String,
    /// One line that names the mechanism.
    pub title: String,
    /// The publication it is taken from; obligatory for built-in entries.
    pub source: Option<Source>,
    /// Remarks of the file.
    pub notes: Option<String>,
    /// The joints or points.
    pub design: Design,
    /// Lower and upper joint limits, radians or lengths, in joint order; empty if none are given.
    pub limits: Vec<[f64; 2]>,
    /// The limits of the legs and joints of a platform.
    pub platform_limits: PlatformLimits,
    /// The poses or inputs.
    pub cases: Vec<Case>,
    /// Whether some number of the file had to be replaced by a nearby rational for exact work.
    pub rounded: bool,
    /// The interpretation of numbers without a unit in the file.
    pub reading: Reading,
    /// The names of the parts of a chain in the file.
    pub labels: Labels,
}

/// The names of the parts of a chain in a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Labels {
    /// The names of the joints, in joint order; empty if the file names none.
    pub joints: Vec<Option<String>>,
    /// The base link and the tip link of a robot description.
    pub links: Option<[String; 2]>,
    /// Angles near multiples of half a degree, replaced by these or reported.
    pub snapped: Vec<Snapped>,
    /// Decisions of the reader to be reported to the user, each a sentence.
    pub remarks: Vec<String>,
}

impl Entry {
    /// Returns the kind: arm, loop or platform.
    #[must_use]
    pub fn kind(&self) -> Kind {
        match self.design {
            Design::Arm(_) => Kind::Arm,
            Design::Loop(_) => Kind::Loop,
            Design::Platform(_) => Kind::Platform,
        }
    }

    /// Returns the joints of an arm or a loop.
    #[must_use]
    pub fn chain(&self) -> Option<&Chain> {
        match &self.design {
            Design::Arm(chain) | Design::Loop(chain) => Some(chain),
            Design::Platform(_) => None,
        }
    }
}
