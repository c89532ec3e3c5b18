//! Self-motions: solutions of a loop of six unknowns that form a curve or more.
//!
//! Where the Jacobian has corank 1 the loop gives way in one direction at most, and a self-motion is a curve there: it is
//! followed until it closes. Where the corank is larger several curves may meet, or the solutions may form a surface:
//! points beside the solution are looked for in many directions of the kernel, and each of them is judged for itself.

use super::curve::{Curve, Point};
use super::explorer::{Explorer, Piece};
use super::newton::Six;
use super::walk::Trace;
use crate::kinematics::closed_loop::ClosedLoop;

/// Solutions that form a curve or more, as measured.
#[derive(Clone, Debug, PartialEq)]
pub struct SelfMotion {
    /// The dimension, at least 1.
    pub dimension: usize,
    /// Marks the unknowns that move.
    pub moving: [bool; 6],
    /// Points: of a curve in their order along it, angles running on without jumps; else one point.
    pub points: Vec<Six<f64>>,
    /// Whether the last point of a curve is the first one again, whole turns apart.
    pub is_closed: bool,
}

/// Returns the self-motions on which a real solution lies, and those that meet them; none where it appears to be isolated. Their points close the loop
/// within `within`, in radians and scaled lengths.
#[must_use]
pub fn self_motions(closed: &ClosedLoop<f64>, solution: &Six<f64>, within: f64) -> Vec<SelfMotion> {
    let curve = Curve::of_self_motion(closed, within);
    let explorer = Explorer::new(&curve, within);
    let mut pieces = explorer.pieces(&full(solution));
    explorer.add_crossing(&mut pieces);
    pieces.into_iter().map(SelfMotion::from).collect()
}

/// The real configuration nearest to closing beside this one, along which the loop gives way least; `None` where none closes
/// within `within`.
#[must_use]
pub fn nearest(closed: &ClosedLoop<f64>, start: &Six<f64>, within: f64) -> Option<Six<f64>> {
    let curve = Curve::of_self_motion(closed, within);
    Explorer::new(&curve, within).nearest(&full(start)).map(|point| unknowns(&point))
}

impl SelfMotion {
    /// The point of a curve at a part of the way from one of its points, by number, to the next one.
    #[must_use]
    pub fn between(&self, closed: &ClosedLoop<f64>, first: usize, part: f64, within: f64) -> Option<Six<f64>> {
        let curve = Curve::of_self_motion(closed, within);
        Explorer::new(&curve, within).between(&self.piece(), first, part).map(|point| unknowns(&point))
    }

    /// Returns whether a solution lies on the self-motion, angles modulo whole turns. On a curve this is tested; on a surface it
    /// is assumed where all constant unknowns agree.
    #[must_use]
    pub fn holds(&self, closed: &ClosedLoop<f64>, solution: &Six<f64>, within: f64) -> bool {
        let curve = Curve::of_self_motion(closed, within);
        Explorer::new(&curve, within).holds(&self.piece(), &full(solution))
    }

    fn piece(&self) -> Piece {
        Piece {
            dimension: self.dimension,
            moving: std::array::from_fn(|k| self.moving.get(k).is_some_and(|moves| *moves)),
            trace: Trace { points: self.points.iter().map(full).collect(), is_closed: self.is_closed },
        }
    }
}

impl From<Piece> for SelfMotion {
    fn from(piece: Piece) -> Self {
        Self {
            dimension: piece.dimension,
            moving: std::array::from_fn(|k| piece.moving[k]),
            points: piece.trace.points.iter().map(unknowns).collect(),
            is_closed: piece.trace.is_closed,
        }
    }
}

/// A point of the seven variables of a curve.
fn full(unknowns: &Six<f64>) -> Point {
    std::array::from_fn(|k| unknowns.get(k).copied().unwrap_or(0.0))
}

fn unknowns(point: &Point) -> Six<f64> {
    std::array::from_fn(|k| point[k])
}
