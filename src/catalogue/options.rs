//! How to read a mechanism file.

use crate::algebra::number::DIGITS;

/// How to read a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// Decimal digits to which irrational angles and numbers are replaced by rationals for exact work.
    pub digits: u32,
    /// URDF: the link at the root of the chain; the root of the robot if none is named.
    pub base_link: Option<String>,
    /// URDF: the link at the end of the chain; the only leaf of the robot if none is named.
    pub tip_link: Option<String>,
}

impl Default for Options {
    /// 15 digits, no links named.
    fn default() -> Self {
        Self { digits: DIGITS, base_link: None, tip_link: None }
    }
}
