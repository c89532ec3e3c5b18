//! Options for reading a mechanism file.

use crate::algebra::number::DIGITS;

/// The chains that are accepted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Chains {
    /// Chains that can be solved, with their poses or inputs.
    #[default]
    Solved,
    /// The same chains; poses, inputs and legs may be missing, because they come from elsewhere.
    Swept,
    /// Loops and arms of any number of joint variables, with or without poses or inputs.
    Any,
}

/// Options for reading a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// Number of decimal digits of the rationals that replace irrational angles and numbers for exact work.
    pub digits: u32,
    /// URDF: the link at the root of the chain; by default the root of the robot.
    pub base_link: Option<String>,
    /// URDF: the link at the end of the chain; by default that of the only arm.
    pub tip_link: Option<String>,
    /// The chains that are accepted.
    pub chains: Chains,
    /// URDF and DH tables: whether truncated multiples of pi are replaced by the exact angles.
    pub snap: bool,
    /// Whether claims about solutions are read.
    pub claims: bool,
    /// URDF: the SRDF file and the planning group in it that name the chain.
    pub group: Option<(std::path::PathBuf, String)>,
}

impl Default for Options {
    /// Returns 15 digits, no links named, chains that can be solved.
    fn default() -> Self {
        Self {
            digits: DIGITS,
            base_link: None,
            tip_link: None,
            chains: Chains::Solved,
            snap: false,
            claims: true,
            group: None,
        }
    }
}
