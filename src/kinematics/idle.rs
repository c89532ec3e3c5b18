//! Virtual joints: what a loop of fewer than six unknowns is given to become one of six.
//!
//! An overconstrained loop has fewer unknowns than equations. Idle rotations and translations about and along axes in
//! general position make up the number, so that every route for six unknowns serves; the loop closes where all idle
//! unknowns are zero.

use super::closed_loop::Variable;
use super::motion::Motion;
use rug::Rational;

/// An unknown that no joint has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Idle {
    /// Index of the joint variable behind which it stands.
    pub behind: usize,
    /// Its kind.
    pub variable: Variable,
    /// The number that selects its axis: any two numbers give unrelated axes.
    pub choice: u32,
}

impl Idle {
    /// The frame whose z axis is its axis, exactly; lengths are of the order of `unit`.
    #[must_use]
    pub fn frame(&self, unit: &Rational) -> Motion<Rational> {
        // Digits of a fixed generator: general position for every purpose, and the same every time.
        let mut state = u64::from(self.choice).wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(0x2545_F491_4F6C_DD1D);
        let mut draw = || {
            for shift in [13, 7, 17] {
                state ^= if shift == 7 { state >> shift } else { state << shift };
            }
            // Between 1/3 and 3, of either sign.
            let size = Rational::from((1 + i64::try_from(state % 65_521).unwrap_or(0), 65_537_i64));
            let between = Rational::from((1, 3)) + size * Rational::from((4, 3));
            if state & (1 << 40) == 0 { between } else { -between }
        };
        let mut pair = || {
            let t = draw();
            let square = Rational::from(&t * &t);
            let scale = Rational::from(1 + &square).recip();
            ((1 - square) * &scale, t * 2 * scale)
        };
        let ((c1, s1), (c2, s2)) = (pair(), pair());
        let turn = Motion::rotation_z(c1, s1).then_after(&Motion::rotation_x(c2, s2));
        Motion { translation: [draw() * unit, draw() * unit, draw() * unit], ..turn }
    }
}
