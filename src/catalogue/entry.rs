//! What a mechanism file says.

use crate::algebra::number::{Angle, Number};
use crate::kinematics::chain::{Chain, Placement};

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

/// The given joint variable of a loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Which joint, counted from 1.
    pub joint: usize,
    /// Its value.
    pub value: InputValue,
}

/// One job of a file: a pose of an arm or an input of a loop, with what is claimed of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// The pose (arm).
    pub pose: Option<Placement>,
    /// The given variables (loop).
    pub input: Vec<Input>,
    /// Claims about this case.
    pub expected: Expected,
    /// Warnings to repeat in every report on this case (a projected pose, for example).
    pub warnings: Vec<String>,
    /// Line of the file at which the case begins, from 1.
    pub line: usize,
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
    /// Solutions that must be among those found.
    pub solutions: Vec<Claim>,
}

/// A claimed solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Joint variables in joint order.
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
    /// Arm, loop or platform.
    pub kind: Kind,
    /// The joints.
    pub chain: Chain,
    /// Lower and upper joint limits, radians or lengths, in joint order; empty if none are given.
    pub limits: Vec<[f64; 2]>,
    /// The poses or inputs.
    pub cases: Vec<Case>,
    /// Whether some number of the file had to be replaced by a nearby rational for exact work.
    pub rounded: bool,
}
