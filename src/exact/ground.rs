//! The ground field over which the equations of a loop are decided: the rationals, or a number field.

use super::eliminant::{Eliminant, Way, count, eliminant, eliminant_by_ring};
use crate::algebra::ball::Ball;
use crate::algebra::drawn::Drawn;
use crate::algebra::ring::{Domain, Field, Ring};
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::Motion;
use rug::Rational;

/// A loop whose constants lie in a field of algebraic numbers.
pub trait Ground {
    /// The field modulo a prime.
    type Residue: Field + Domain;

    /// Returns the kinds of the unknowns.
    fn variables(&self) -> [Variable; 6];

    /// The loop modulo a prime.
    fn modular(&self) -> &ClosedLoop<Self::Residue>;

    /// The constants in balls.
    fn constants<const BITS: u32>(&self) -> Option<Vec<Motion<Ball<BITS>>>>;

    /// The number of roots of the eliminant that a way leads to, with multiplicity.
    fn count(&self, way: &Way) -> Option<usize>;

    /// The eliminant that a way leads to; `None` where its determinant vanishes, or is not decided.
    fn eliminant(&self, way: &Way) -> Option<Eliminant>;

    /// The eliminant of an unknown whose determinants vanish, from the ring of the loop.
    fn eliminant_by_ring(&self, unknown: usize) -> Option<Eliminant>;
}

/// A loop over the rationals.
#[derive(Clone, Copy, Debug)]
pub struct OverRationals<'a> {
    /// The loop.
    pub closed: &'a ClosedLoop<Rational>,
    /// The loop modulo the prime of the run.
    pub modular: &'a ClosedLoop<Drawn>,
}

impl Ground for OverRationals<'_> {
    type Residue = Drawn;

    fn variables(&self) -> [Variable; 6] {
        self.closed.variables
    }

    fn modular(&self) -> &ClosedLoop<Drawn> {
        self.modular
    }

    fn constants<const BITS: u32>(&self) -> Option<Vec<Motion<Ball<BITS>>>> {
        self.closed.constants.iter().map(|motion| motion.map(Ball::from_rational)).collect()
    }

    fn count(&self, way: &Way) -> Option<usize> {
        count(self.closed, way)
    }

    fn eliminant(&self, way: &Way) -> Option<Eliminant> {
        eliminant(self.closed, way)
    }

    fn eliminant_by_ring(&self, unknown: usize) -> Option<Eliminant> {
        eliminant_by_ring(self.closed, self.modular, unknown)
    }
}
