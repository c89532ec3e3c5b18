//! What a mechanism file says.

use crate::algebra::number::{Angle, Number, Reading};
use crate::kinematics::chain::{Chain, Placement};
use crate::kinematics::joint::Variable;
use crate::kinematics::platform::Platform;

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

/// What a mechanism is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Design {
    /// The joints of an arm.
    Arm(Chain),
    /// The joints round a loop.
    Loop(Chain),
    /// The points of a platform.
    Platform(Box<Platform<Number>>),
}

/// Where a mechanism comes from.
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
    /// What the given joint variable measures.
    #[must_use]
    pub fn variable(&self) -> Variable {
        match self {
            Self::Angle(_) => Variable::Rotation,
            Self::Distance(_) => Variable::Translation,
        }
    }
}

/// The given joint variable of a loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Which joint, counted from 1.
    pub joint: usize,
    /// Its value.
    pub value: InputValue,
}

/// One job of a file: a pose of an arm, an input of a loop or the legs of a platform, with what is claimed of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The pose (arm; platform, where its legs were computed from one).
    pub pose: Option<Placement>,
    /// The given variables (loop).
    pub input: Vec<Input>,
    /// The squares of the lengths of the legs (platform).
    pub legs_squared: Option<[Number; 6]>,
    /// Claims about this case.
    pub expected: Expected,
    /// Warnings to repeat in every report on this case (a projected pose, for example).
    pub warnings: Vec<String>,
    /// Line of the file at which the case begins, from 1.
    pub line: usize,
}

impl Case {
    /// A pose of an arm, without claims.
    #[must_use]
    pub fn at(pose: Placement, line: usize) -> Self {
        Self { pose: Some(pose), ..Self::empty(line) }
    }

    /// A loop without input, without claims.
    #[must_use]
    pub fn free(line: usize) -> Self {
        Self::empty(line)
    }

    /// An input of a loop, without claims.
    #[must_use]
    pub fn given(input: Input, line: usize) -> Self {
        Self { input: vec![input], ..Self::empty(line) }
    }

    /// Legs of a platform with these squared lengths, without claims.
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

    /// Legs of a platform as long as this pose of the plate makes them, exact where it is; without claims.
    #[must_use]
    pub fn legs_at(platform: &Platform<Number>, pose: Placement, line: usize) -> Self {
        let exact = |points: &[[Number; 3]; 6]| points.each_ref().map(|p| p.each_ref().map(|x| x.rational().clone()));
        let platform = Platform { base: exact(&platform.base), plate: exact(&platform.plate) };
        let squares = platform.legs_squared(&pose.exact).map(Number::exact);
        Self { pose: Some(pose), ..Self::legs(squares, line) }
    }

    fn empty(line: usize) -> Self {
        let (expected, warnings) = (Expected::default(), Vec::new());
        Self { pose: None, input: Vec::new(), legs_squared: None, expected, warnings, line }
    }
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
    /// Dimension of the motion of a loop, whatever its inputs are.
    pub mobility: Option<usize>,
    /// Rank of the joint screws along that motion.
    pub screw_rank: Option<usize>,
    /// Solutions that must be among those found.
    pub solutions: Vec<Claim>,
}

/// A claimed solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Joint variables in joint order; of a platform the quaternion `w, x, y, z` and the position `x, y, z`.
    pub q: Vec<f64>,
    /// Correct decimal digits of `q`.
    pub digits: u32,
    /// Line of the file, from 1.
    pub line: usize,
}

/// A mechanism file, read.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The file's own name without extension, or a built-in entry's name.
    pub name: String,
    /// One line that names the mechanism.
    pub title: String,
    /// Where it comes from; obligatory for built-in entries.
    pub source: Option<Source>,
    /// Remarks of the file.
    pub notes: Option<String>,
    /// The joints or points.
    pub design: Design,
    /// Lower and upper joint limits, radians or lengths, in joint order; empty if none are given.
    pub limits: Vec<[f64; 2]>,
    /// The poses or inputs.
    pub cases: Vec<Case>,
    /// Whether some number of the file had to be replaced by a nearby rational for exact work.
    pub rounded: bool,
    /// How numbers without a unit are read in the file.
    pub reading: Reading,
    /// What the file calls the parts of a chain.
    pub labels: Labels,
}

/// What a file calls the parts of a chain.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Labels {
    /// The names of the joints, in joint order; empty where the file names none.
    pub joints: Vec<Option<String>>,
    /// The base link and the tip link of a robot description.
    pub links: Option<[String; 2]>,
}

impl Entry {
    /// Arm, loop or platform.
    #[must_use]
    pub fn kind(&self) -> Kind {
        match self.design {
            Design::Arm(_) => Kind::Arm,
            Design::Loop(_) => Kind::Loop,
            Design::Platform(_) => Kind::Platform,
        }
    }

    /// The joints of an arm or a loop.
    #[must_use]
    pub fn chain(&self) -> Option<&Chain> {
        match &self.design {
            Design::Arm(chain) | Design::Loop(chain) => Some(chain),
            Design::Platform(_) => None,
        }
    }
}
