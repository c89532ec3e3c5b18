//! Which elimination a loop takes: the one case analysis over the kinds of its six unknowns, which everyone asks.

use super::point_reach::general_count;
use crate::kinematics::closed_loop::Variable;

/// The elimination of a loop of six unknowns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Elimination {
    /// The centre of the spherical joint whose first rotation is this unknown is reached from both sides.
    Centre(usize),
    /// Three rotations close by themselves, as a spherical triangle.
    Triangle,
    /// Four rotations make a spherical four-bar, and there is one condition on the translations.
    FourBar,
    /// A loop of five or six rotations is cut, and one angle of the cut is hidden.
    Cut,
    /// Fewer than three rotations have none: the links move in parallel planes, or they only translate.
    Planar,
}

impl Elimination {
    /// The elimination of a loop with these unknowns, `spherical` the first rotation of a spherical joint among them.
    #[must_use]
    pub fn of(variables: [Variable; 6], spherical: Option<usize>) -> Self {
        match (spherical, variables.iter().filter(|v| **v == Variable::Rotation).count()) {
            (Some(spherical), _) => Self::Centre(spherical),
            (None, 0..3) => Self::Planar,
            (None, 3) => Self::Triangle,
            (None, 4) => Self::FourBar,
            (None, _) => Self::Cut,
        }
    }

    /// The degree of the closure polynomial of a general loop with these unknowns; `None` where there is none.
    #[must_use]
    pub fn degree(self, variables: [Variable; 6]) -> Option<usize> {
        match self {
            Self::Centre(spherical) => Some(general_count([3, 4, 5].map(|k| variables[(spherical + k) % 6]))),
            Self::Triangle => Some(2),
            Self::FourBar => Some(8),
            Self::Cut => Some(16),
            Self::Planar => None,
        }
    }
}
