//! Singular postures of an arm that come nearest to a pose.
//!
//! A pose is near to an arm without being reached only at singular postures: from a regular configuration within the tolerance Newton's
//! method leads to one that reaches the pose. A posture has corank c where the block of c times c of the Jacobian that belongs to its
//! smallest singular values is 0; some joints are dependent where the same holds of their columns. That block is linearised together with
//! the pose, and the miss is least subject to it.

use crate::kinematics::closed_loop::Variable;
use crate::kinematics::forward::Forward;
use crate::kinematics::motion::{Motion, Vector, cross};
use crate::kinematics::tolerance::{PoseError, Tolerance};
use crate::solve::curve::CLOSES_WITHIN;
use crate::solve::newton::Six;
use looproot_calculus::finite::finite;
use nalgebra::{DMatrix, DVector};

/// Coranks looked for: shoulder, elbow and wrist of an arm may be singular together, and no posture of one in use is more singular.
pub(super) const MOST_CORANK: usize = 3;
/// Equations: those of the pose, those of the block, and those that hold what the pose does not.
const ROWS: usize = 6 + MOST_CORANK * MOST_CORANK + MOST_CORANK;
/// Steps at most: they converge quadratically from nearby, and halve the distance where the block vanishes to second order.
const STEPS: usize = 40;
/// Steps after which those that converge are short, and the length of these.
const SETTLED: (usize, f64) = (10, 0.1);
/// A step this short, in parts of the tolerance, is the last one; rounding at double singular positions may be a tenth of a nanometre.
const CONVERGED: f64 = 0.1;
/// Steps to the singular posture alone, from as near as the square of the weight below leaves it.
const LAST: usize = 2;
/// A step is no longer, and a posture no farther away to first order: the cosine of half a radian is linear to an eighth.
const LONGEST: f64 = 0.5;
/// The weight of the block, which is to be 0, over that of the pose, which is missed.
const HOLD: f64 = 1e4;
/// Four joints whose twists have no smaller singular value are not taken for dependent ones: rounding to three digits leads a tenth away.
const DEPENDENT: f64 = 0.1;
/// Directions along which everything stays within this are those of a self-motion, not gone in.
const RANK: f64 = 1e-6;
/// The least sum of squares has no part larger than `sqrt(2)` times the least largest part; what misses by more, no weights help.
const BY_WEIGHTS: f64 = 1.5;

/// A tolerance leads this many fourth roots of it away from a singular posture, where it is one of order 4, or less.
const AWAY: f64 = 10.0;
/// A step bends a path by its square at most, in radians and units of lengths: what is missed by more to first order, is missed.
const BENDS: f64 = 2.0;

/// An arm of six joint variables and a pose.
pub(super) struct Postures<'a> {
    /// The arm.
    pub forward: &'a Forward,
    /// The pose.
    pub wanted: &'a Motion<f64>,
    /// What the pose may be missed by.
    pub tolerance: Tolerance,
    /// The unit of lengths.
    pub scale: f64,
}

/// In which way a posture is singular.
#[derive(Clone, Copy, Debug)]
pub(super) enum Singular {
    /// The Jacobian has this corank, or a larger one.
    Corank(usize),
    /// The joints of this set, by bits, are dependent by themselves: most self-motions are of such joints. Two ways to be singular may
    /// meet in one of corank 1, where the determinant vanishes to second order and does not show the one from the other.
    Joints(usize),
}

/// A twist: angular, then linear over the unit of lengths.
type Screw = [Vector<f64>; 2];

/// The smallest singular values of a Jacobian, and how they change.
struct Block {
    /// The Jacobian, angular rows first, as if these values were 0: what the posture moves along is not gone in to meet the pose.
    jacobian: DMatrix<f64>,
    /// The derivatives of its entries by the joint variables, row by row.
    rows: DMatrix<f64>,
    /// The entries, with the other sign.
    right: DVector<f64>,
}

impl Postures<'_> {
    /// The sets of joints that are nearly dependent by themselves, as those of self-motions are: two in line, or four of which no two are.
    pub fn nearly_dependent(&self, at: &Six<f64>) -> Vec<usize> {
        let (_, screws) = self.screws(at);
        let mut sets: Vec<usize> = pairs().filter(|&set| in_line(&screws, set) < self.away()).collect();
        let all = jacobian(&screws);
        let fours =
            (0..1_usize << 6).filter(|set| set.count_ones() == 4 && sets.iter().all(|pair| set & pair != *pair));
        let is_near = |set: &usize| {
            let part = DMatrix::from_fn(6, 6, |i, j| if set >> j & 1 == 1 { all[(i, j)] } else { 0.0 });
            part.svd(false, false).singular_values[3] < DEPENDENT.min(self.away())
        };
        let fours: Vec<usize> = fours.filter(is_near).collect();
        sets.extend(fours);
        sets
    }

    /// The postures, of a list, at which two joints are most nearly in line, and these.
    pub fn most_in_line(&self, postures: &[Six<f64>]) -> Vec<(usize, Six<f64>)> {
        let screws: Vec<[Screw; 6]> = postures.iter().map(|q| self.screws(q).1).collect();
        let best = |set: usize| {
            let off: Vec<f64> = screws.iter().map(|own| in_line(own, set)).collect();
            let least = (0..off.len()).min_by(|a, b| off[*a].total_cmp(&off[*b]))?;
            (off[least] < LONGEST).then_some((set, postures[least]))
        };
        pairs().filter_map(best).collect()
    }

    /// The joint values of a posture near `start`, singular in this way, that reaches the pose within the tolerance and misses it least,
    /// or nearly so; `None` where the steps do not lead to one.
    pub fn nearest(&self, start: &Six<f64>, way: Singular) -> Option<Six<f64>> {
        let [length, angle] = self.within();
        let within = length.max(angle);
        let mut weights = [within / angle, within / length];
        let mut q = *start;
        for count in 0..STEPS {
            let (tool, screws) = self.screws(&q);
            let mut block = Block::of(&screws, way)?;
            // Which joints are dependent is known before, where that was near enough.
            let farthest = if matches!(way, Singular::Joints(_)) { LONGEST } else { self.away() };
            if count == 0 && !(block.way() < farthest) {
                return None;
            }
            let (error, turn) = (PoseError::between(&tool, self.wanted), tool.turn_to(self.wanted));
            for i in 0..3 {
                let moved = (self.wanted.translation[i] - tool.translation[i]) / self.scale;
                for (row, value, part) in [(i, turn[i], 0), (3 + i, moved, 1)] {
                    block.right[row] = weights[part] * value;
                    for k in 0..6 {
                        block.rows[(row, k)] = weights[part] * block.jacobian[(row, k)];
                    }
                }
            }
            let step = block.step()?;
            let size = step.amax();
            // The step itself meets the pose as well as it can.
            let left =
                (0..6).map(|row| (block.right[row] - (block.rows.row(row) * &step)[0]).abs()).fold(0.0, f64::max);
            if left > 2.0 * within * BY_WEIGHTS + BENDS * weights[0].max(weights[1]) * size * size {
                return None;
            }
            if size < CONVERGED * within {
                let [turned, moved] = [error.orientation / angle, error.position / self.scale / length];
                if let Some(settled) = self.settled(q, way) {
                    return Some(settled);
                }
                if !(turned.max(moved) < BY_WEIGHTS) {
                    return None;
                }
                // The larger part weighs more, until both are alike.
                let balance = (turned / moved).clamp(0.5, 2.0);
                weights = [weights[0] * balance, weights[1] / balance];
            } else if count > SETTLED.0 && size > SETTLED.1 {
                return None;
            }
            self.go(&mut q, &step, (LONGEST / size).min(1.0));
        }
        None
    }

    /// The posture that is singular to rounding, if it is near the pose: what misses a pose pulls at it, though not as strongly as the
    /// block holds it.
    fn settled(&self, mut q: Six<f64>, way: Singular) -> Option<Six<f64>> {
        for _ in 0..LAST {
            let step = Block::of(&self.screws(&q).1, way)?.step()?;
            self.go(&mut q, &step, 1.0);
        }
        let error = PoseError::between(&self.forward.pose(&q), self.wanted);
        self.tolerance.allows(&error).then_some(q)
    }

    fn go(&self, q: &mut Six<f64>, step: &DVector<f64>, part: f64) {
        for (k, value) in q.iter_mut().enumerate() {
            *value += part * step[k] * self.unit(k);
        }
    }

    /// The tolerance of lengths, in the unit of them, and of angles.
    fn within(&self) -> [f64; 2] {
        [self.tolerance.length / self.scale, self.tolerance.angle].map(|x| x.max(CLOSES_WITHIN))
    }

    /// How far from a singular posture what is near to it may be.
    fn away(&self) -> f64 {
        let [length, angle] = self.within();
        (AWAY * length.max(angle).sqrt().sqrt()).min(LONGEST)
    }

    fn unit(&self, k: usize) -> f64 {
        if self.forward.variables()[k] == Variable::Rotation { 1.0 } else { self.scale }
    }

    /// The pose of the tool, and the twists of its origin per unit of every variable.
    fn screws(&self, q: &Six<f64>) -> (Motion<f64>, [Screw; 6]) {
        let (tool, twists) = self.forward.jacobian(q);
        let screw = |k: usize| {
            let unit = self.unit(k);
            [twists[k].angular, twists[k].linear.map(|x| x * unit / self.scale)]
        };
        (tool, std::array::from_fn(screw))
    }
}

impl Block {
    /// The block of a Jacobian that is 0 where a posture is singular in this way; `None` where there is none.
    fn of(screws: &[Screw; 6], way: Singular) -> Option<Self> {
        let all = jacobian(screws);
        let (set, lefts, rights) = match way {
            Singular::Corank(corank) => (0b11_1111, 6 - corank..6, 6 - corank..6),
            Singular::Joints(set) => {
                let first = (set.count_ones() as usize).checked_sub(1)?;
                (set, first..6, first..first + 1)
            }
        };
        let part = DMatrix::from_fn(6, 6, |i, j| if set >> j & 1 == 1 { all[(i, j)] } else { 0.0 });
        let svd = part.svd(true, true);
        let values = &svd.singular_values;
        let (left, right) = (svd.u.as_ref()?, svd.v_t.as_ref()?);
        // They are in descending order.
        if !(values[rights.start.checked_sub(1)?] > RANK) {
            return None;
        }
        let mut block = Self { jacobian: all, rows: DMatrix::zeros(ROWS, 6), right: DVector::zeros(ROWS) };
        for (number, column) in rights.clone().enumerate() {
            for (row, at) in lefts.clone().zip(6 + number * lefts.len()..) {
                for k in 0..6 {
                    let turned = |j: usize| {
                        let [angular, linear] = bent(screws, k, j);
                        let entry = |i: usize| left[(i, row)] * angular[i] + left[(3 + i, row)] * linear[i];
                        right[(column, j)] * (0..3).map(entry).sum::<f64>()
                    };
                    block.rows[(at, k)] = HOLD * (0..6).map(turned).sum::<f64>();
                }
                block.right[at] = if row == column { -HOLD * values[row] } else { 0.0 };
            }
            block.jacobian -= left.column(column) * right.row(column) * values[column];
            // Of all postures along a self-motion, the nearest one.
            for k in 0..6 {
                block.rows[(ROWS - 1 - number, k)] = right[(column, k)];
            }
        }
        Some(block)
    }

    /// How far, to first order, the posture is in which the block is 0.
    fn way(&self) -> f64 {
        self.step().map_or(f64::INFINITY, |step| step.amax())
    }

    /// The shortest step to where the equations are met best.
    fn step(&self) -> Option<DVector<f64>> {
        finite(self.rows.clone()).svd(true, true).solve(&finite(self.right.clone()), RANK).ok()
    }
}

/// The sets of two of six joints.
fn pairs() -> impl Iterator<Item = usize> {
    (0..1_usize << 6).filter(|set| set.count_ones() == 2)
}

/// How far two joints are from being in line.
fn in_line(screws: &[Screw; 6], pair: usize) -> f64 {
    let (j, k) = (pair.trailing_zeros() as usize, pair.ilog2() as usize);
    let off = |sign: f64| {
        (0..6).map(|i| (screws[j][i / 3][i % 3] - sign * screws[k][i / 3][i % 3]).abs()).fold(0.0, f64::max)
    };
    off(1.0).min(off(-1.0))
}

/// The Jacobian, angular rows first.
fn jacobian(screws: &[Screw; 6]) -> DMatrix<f64> {
    finite(DMatrix::from_fn(6, 6, |i, j| screws[j][i / 3][i % 3]))
}

/// The derivative of the twist j of the tool by the variable k: those before a joint carry its axis and the tool, those behind it the
/// tool alone.
fn bent(screws: &[Screw; 6], k: usize, j: usize) -> Screw {
    let [angular, linear] = &screws[k];
    if k < j {
        [cross(angular, &screws[j][0]), cross(angular, &screws[j][1])]
    } else {
        [[0.0; 3], cross(&screws[j][0], linear)]
    }
}
