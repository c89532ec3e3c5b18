//! The equivalent ways to cut a loop: six places, two directions, two angles to hide.

use crate::algebra::ring::Ring;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};

/// The place where a loop is opened and the direction in which it is read. The loop is rotated left first, then reversed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cut {
    /// The number of unknowns that move from the head to the tail, 0 to 5.
    pub rotation: usize,
    /// Whether the loop is then read backwards, every unknown negated.
    pub reversed: bool,
}

/// The unknown of a cut that stays in the pencil as its eigenvalue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hidden {
    /// Unknown 1 of the cut; 2 and 3 form the eigenvector.
    First,
    /// Unknown 2 of the cut; 1 and 3 form the eigenvector.
    Second,
}

impl Cut {
    /// All twelve cuts. The first ones leave the closing transformation (constant 6) out of the elimination of unknowns 4 to 6,
    /// so that everything that depends on geometry alone can be prepared; then come those with it in constant 2, then the rest.
    pub const ALL: [Self; 12] = [
        Self { rotation: 0, reversed: false },
        Self { rotation: 5, reversed: false },
        Self { rotation: 0, reversed: true },
        Self { rotation: 1, reversed: true },
        Self { rotation: 4, reversed: false },
        Self { rotation: 2, reversed: true },
        Self { rotation: 1, reversed: false },
        Self { rotation: 2, reversed: false },
        Self { rotation: 3, reversed: false },
        Self { rotation: 3, reversed: true },
        Self { rotation: 4, reversed: true },
        Self { rotation: 5, reversed: true },
    ];
    /// The number of leading [`Cut::ALL`] that can be prepared before the closing transformation is known.
    pub const PREPARED: usize = 6;

    /// All cuts with both hidden unknowns, each with its index in the loop.
    pub fn hidings() -> impl Iterator<Item = (Self, Hidden, usize)> {
        let of_cut =
            |cut: Self| [(cut, Hidden::First, cut.unknown_index(0)), (cut, Hidden::Second, cut.unknown_index(1))];
        Self::ALL.into_iter().flat_map(of_cut)
    }

    /// The loop as this cut reads it.
    #[must_use]
    pub fn of<R: Ring>(self, original: &ClosedLoop<R>) -> ClosedLoop<R> {
        ClosedLoop {
            variables: self.variables(original.variables),
            constants: std::array::from_fn(|j| self.constant(original, j)),
        }
    }

    /// Constant j (from 0) of the loop as this cut reads it.
    #[must_use]
    pub fn constant<R: Ring>(self, original: &ClosedLoop<R>, j: usize) -> crate::kinematics::motion::Motion<R> {
        let index = self.constant_index(j);
        if self.reversed { original.constants[index].inverse() } else { original.constants[index].clone() }
    }

    /// Returns the index of the constant of the original loop that stands behind unknown j of the cut, inverted if reversed.
    #[must_use]
    pub fn constant_index(self, j: usize) -> usize {
        if self.reversed { (self.rotation + if j == 5 { 5 } else { 4 - j }) % 6 } else { (self.rotation + j) % 6 }
    }

    /// The unknowns' kinds as this cut reads them.
    #[must_use]
    pub fn variables(self, original: [Variable; 6]) -> [Variable; 6] {
        std::array::from_fn(|j| original[self.unknown_index(j)])
    }

    /// Returns the index of the unknown of the original loop that is unknown j of the cut, negated if reversed.
    #[must_use]
    pub fn unknown_index(self, j: usize) -> usize {
        if self.reversed { (self.rotation + 5 - j) % 6 } else { (self.rotation + j) % 6 }
    }

    /// Returns whether the elimination can use this cut: translations may stand only as unknowns 4 and 5.
    #[must_use]
    pub fn fits(self, original: [Variable; 6]) -> bool {
        let kinds = self.variables(original);
        [0, 1, 2, 5].iter().all(|&j| kinds[j] == Variable::Rotation)
    }
}
