//! How to read a mechanism file.

use crate::algebra::number::DIGITS;

/// Which chains are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Chains {
    /// Those that are solved, with their poses or inputs.
    #[default]
    Solved,
    /// The same; poses, inputs and legs need not be given: they come from elsewhere.
    Swept,
    /// Loops and arms of any number of joint variables, with poses or inputs or without.
    Any,
}

/// How to read a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// Decimal digits to which irrational angles and numbers are replaced by rationals for exact work.
    pub digits: u32,
    /// URDF: the link at the root of the chain; the root of the robot if none is named.
    pub base_link: Option<String>,
    /// URDF: the link at the end of the chain; that of the only arm if none is named.
    pub tip_link: Option<String>,
    /// Which chains are read.
    pub chains: Chains,
    /// URDF and DH tables: truncated multiples of pi are the angles meant.
    pub snap: bool,
    /// URDF: the SRDF file and the planning group in it that name the chain.
    pub group: Option<(std::path::PathBuf, String)>,
}

impl Default for Options {
    /// 15 digits, no links named, chains that are solved.
    fn default() -> Self {
        Self { digits: DIGITS, base_link: None, tip_link: None, chains: Chains::Solved, snap: false, group: None }
    }
}
