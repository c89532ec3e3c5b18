//! Balls around solutions.

use rug::Rational;

/// A ball in the largest norm, which is claimed to hold exactly one solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Ball {
    /// Real and imaginary parts of the unknowns, angles in radians and lengths in metres; for a platform the quaternion of
    /// norm 1, w first, and the position.
    pub centre: Vec<(Rational, Rational)>,
    /// Maximum distance of the unknowns from the centre.
    pub radius: Rational,
    /// Whether the solution is real.
    pub real: bool,
}

/// A mode as read from a certificate.
pub(super) struct Unproved {
    pub ball: Ball,
    pub multiplicity: usize,
}
