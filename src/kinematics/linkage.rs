//! Planar linkages: a graph of bodies with points and of joints between them.

use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::Number;
use crate::algebra::ring::Ring;
use num_complex::Complex;
use rug::Rational;

/// A point, a direction or a rotation of the plane as the complex number x + i y, exact.
pub type Gaussian = Complex<Rational>;

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its name in the file.
    pub name: String,
    /// Its points in coordinates of its own, metres, in the order of the file.
    pub points: Vec<(String, Gaussian)>,
    /// Line of the file, from 1.
    pub line: usize,
}

impl Body {
    /// The place of a point.
    #[must_use]
    pub fn point(&self, name: &str) -> Option<&Gaussian> {
        self.points.iter().find(|(own, _)| own == name).map(|(_, place)| place)
    }
}

/// The relative motion that a joint allows its two bodies.
#[derive(Clone, Debug, PartialEq)]
pub enum Pair {
    /// The bodies turn about a common point.
    Revolute,
    /// The bodies keep their directions; the point of the second is that of the first moved along a line.
    Prismatic {
        /// The rotation of the second body against the first, of norm 1.
        turn: Gaussian,
        /// The direction of the line in the first body.
        along: Gaussian,
        /// The length of `along`, or a rational number that stands for it.
        length: Rational,
    },
    /// The angle of the second body is a multiple of that of the first, both against a carrier.
    Gear {
        /// The carrier, a body.
        carrier: usize,
        /// Angle of the second over angle of the first.
        ratio: Rational,
        /// The rotation of the second where the first has angle 0, of norm 1.
        phase: Gaussian,
    },
}

/// A joint between two bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkageJoint {
    /// Its name in the file.
    pub name: String,
    /// The relative motion that it allows.
    pub pair: Pair,
    /// The two bodies, by their numbers. Values of the joint are the motion of the second against the first.
    pub of: [usize; 2],
    /// The point of the joint in each of them.
    pub at: [Gaussian; 2],
    /// Line of the file, from 1.
    pub line: usize,
}

impl LinkageJoint {
    /// Whether its value is a distance.
    #[must_use]
    pub fn is_prismatic(&self) -> bool {
        matches!(self.pair, Pair::Prismatic { .. })
    }

    /// Whether it is a pair of gears, which has no value.
    #[must_use]
    pub fn is_gear(&self) -> bool {
        matches!(self.pair, Pair::Gear { .. })
    }
}

/// A planar linkage.
#[derive(Clone, Debug, PartialEq)]
pub struct Linkage {
    /// The body that stands still.
    pub ground: usize,
    /// The bodies.
    pub bodies: Vec<Body>,
    /// The joints.
    pub joints: Vec<LinkageJoint>,
    /// The bars whose length is the square root of a rational number and was rounded.
    pub bars: Vec<Bar>,
}

impl Linkage {
    /// Returns the square of a displacement of the P joint of a leg, where that is rational and the displacement itself is not.
    #[must_use]
    pub fn leg_square(&self, joint: usize, distance: &Number) -> Option<Rational> {
        let square = distance.squared();
        (self.is_leg(joint) && !distance.is_exact() && square.is_exact()).then(|| square.rational().clone())
    }

    /// The joints of a body.
    pub fn joints_of(&self, body: usize) -> impl Iterator<Item = &LinkageJoint> {
        self.joints.iter().filter(move |joint| joint.of.contains(&body))
    }

    /// Whether a joint is the P joint of a leg: each of its bodies has one pin beside it, and both pins stand on its line.
    fn is_leg(&self, joint: usize) -> bool {
        let own = &self.joints[joint];
        let Pair::Prismatic { turn, along, length } = &own.pair else { return false };
        let is_half = |body: usize| {
            let mut pins = self.joints_of(body).filter(|other| other.name != own.name);
            let pin = pins.next();
            let is_at_origin =
                |pin: &LinkageJoint| pin.pair == Pair::Revolute && pin.at[usize::from(pin.of[0] != body)].is_zero();
            pin.is_some_and(is_at_origin) && pins.next().is_none()
        };
        *turn == Gaussian::one()
            && *along == Gaussian::one()
            && *length == 1
            && own.at.iter().all(Ring::is_zero)
            && own.of.into_iter().all(is_half)
    }
}

/// A link between two pins whose distance was rounded, while its square is rational. Nothing but the square has a part in the closure
/// equations where no angle of the link is given.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Its bodies: the link, or the two halves of a leg. Their pins stand on the x axis of the first, one at its origin.
    pub bodies: Vec<usize>,
    /// The distance of its pins as it was rounded.
    pub length: Rational,
    /// The square of their distance.
    pub square: Rational,
}

/// A measure of what is known of the numbers of a linkage and its inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Accuracy {
    /// All are exact.
    Exact,
    /// All are exact but angles of inputs, which are enclosed.
    Enclosed,
    /// All are exact but lengths of bars and legs, whose squares are.
    Squared,
    /// Some were rounded.
    Rounded,
}

impl Accuracy {
    /// What is known of all numbers of two kinds.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        match (self, other) {
            // What is decided with squares takes no enclosures.
            (Self::Enclosed, Self::Squared) | (Self::Squared, Self::Enclosed) => Self::Rounded,
            _ => self.max(other),
        }
    }
}

/// A value of a linkage that is given as input.
#[derive(Clone, Debug, PartialEq)]
pub enum Given {
    /// The rotation of the second body of a revolute joint against the first.
    Turn {
        /// The joint.
        joint: usize,
        /// The rotation, of norm 1.
        turn: Gaussian,
        /// What holds cosine and sine, where the rotation is rounded.
        within: Option<Box<(Enclosure, Enclosure)>>,
        /// Line of the file, from 1.
        line: usize,
    },
    /// The displacement along a prismatic joint, in parts of the length of its direction vector.
    Shift {
        /// The joint.
        joint: usize,
        /// The displacement.
        shift: Rational,
        /// Its square, where that is rational and the displacement itself was rounded.
        square: Option<Rational>,
        /// Line of the file, from 1.
        line: usize,
    },
    /// The place of a body relative to the ground.
    Place {
        /// The body.
        body: usize,
        /// Its rotation, of norm 1.
        turn: Gaussian,
        /// The place of its origin.
        origin: Gaussian,
        /// Line of the file, from 1.
        line: usize,
    },
}

impl Given {
    /// Returns the joint whose value is given; `None` of a place.
    #[must_use]
    pub fn joint(&self) -> Option<usize> {
        match self {
            Self::Turn { joint, .. } | Self::Shift { joint, .. } => Some(*joint),
            Self::Place { .. } => None,
        }
    }

    /// Returns the same joint with another value: the half-angle tangent of a rotation, or metres. `None` of a place.
    #[must_use]
    pub fn at(&self, linkage: &Linkage, value: &Rational) -> Option<Self> {
        match self {
            Self::Turn { joint, line, .. } => {
                let square = Rational::from(value.square_ref());
                let below = Rational::from(1 + &square);
                let turn = Gaussian { re: (1 - square) / &below, im: Rational::from(value * 2) / below };
                Some(Self::Turn { joint: *joint, turn, within: None, line: *line })
            }
            Self::Shift { joint, line, .. } => {
                let Pair::Prismatic { length, .. } = &linkage.joints[*joint].pair else { return None };
                Some(Self::Shift { joint: *joint, shift: Rational::from(value / length), square: None, line: *line })
            }
            Self::Place { .. } => None,
        }
    }

    /// Returns what is known of the value, where `is_exact` says whether it is exact.
    #[must_use]
    pub fn accuracy(&self, is_exact: bool) -> Accuracy {
        match self {
            _ if is_exact => Accuracy::Exact,
            Self::Turn { within: Some(_), .. } => Accuracy::Enclosed,
            Self::Shift { square: Some(_), .. } => Accuracy::Squared,
            Self::Turn { .. } | Self::Shift { .. } | Self::Place { .. } => Accuracy::Rounded,
        }
    }

    /// Line of the file, from 1.
    #[must_use]
    pub fn line(&self) -> usize {
        match self {
            Self::Turn { line, .. } | Self::Shift { line, .. } | Self::Place { line, .. } => *line,
        }
    }

    /// The two bodies that it glues, given the joints and the ground.
    #[must_use]
    pub fn bodies(&self, linkage: &Linkage) -> [usize; 2] {
        match self {
            Self::Turn { joint, .. } | Self::Shift { joint, .. } => linkage.joints[*joint].of,
            Self::Place { body, .. } => [linkage.ground, *body],
        }
    }
}
