//! Self-motions: solutions of a loop of six unknowns that form a curve or more.
//!
//! Where the Jacobian has corank 1 the loop gives way in one direction at most, and a self-motion is a curve there: it is
//! followed until it closes. Where the corank is larger several curves may meet, or the solutions may form a surface:
//! points beside the solution are looked for in many directions of the kernel, and each of them is judged for itself.

use super::curve::{Curve, Point};
use super::newton::{Six, closure};
use super::walk::{Trace, apart};
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use nalgebra::{Matrix6, Vector6};

/// Solutions that form a curve or more, as measured.
#[derive(Clone, Debug, PartialEq)]
pub struct SelfMotion {
    /// The dimension, at least 1.
    pub dimension: usize,
    /// Which unknowns move.
    pub moving: [bool; 6],
    /// Points: of a curve in their order along it, angles running on without jumps; else one point.
    pub points: Vec<Six<f64>>,
    /// Whether the last point of a curve is the first one again, whole turns apart.
    pub is_closed: bool,
}

/// Singular values below this part of the largest count as zero on a curve that closes to rounding.
const RANK: f64 = 1e-6;
/// Unknowns that change by less along a step of 0.02 stand still: rounding at a multiple curve reaches 1e-7.
const MOVED: f64 = 1e-6;
/// How far a step goes that explores a self-motion.
const STEP: f64 = 0.01;
/// Directions in which points of a self-motion lie beside one of its points: those with at least this part of the largest
/// spread. A curve bends by a part of about one step of 0.01 out of its tangent.
const SPREAD: f64 = 0.15;
/// The length that a curve has at least, unless it closes: a multiple solution closes to rounding in its neighbourhood,
/// too, as 0.1 to the power of its order; and within what is allowed as far as the root of that order.
const SHORTEST: f64 = 0.15;

/// The self-motions that a real solution lies on, none where it is isolated as far as is seen. Their points close the loop
/// within `within`, in radians and scaled lengths.
#[must_use]
pub fn self_motions(closed: &ClosedLoop<f64>, solution: &Six<f64>, within: f64) -> Vec<SelfMotion> {
    let search = Explorer { closed, within };
    let (rank, kernel) = search.rank(solution);
    match rank {
        6 | 0 => Vec::new(),
        5 => search.curve_through(solution, &[true; 6]).into_iter().collect(),
        _ => {
            let in_groups = search.in_groups(solution);
            if in_groups.is_empty() { search.around(solution, rank, &kernel) } else { in_groups }
        }
    }
}

/// The real configuration nearest to closing beside this one, along which the loop gives way least; `None` where none closes
/// within `within`.
#[must_use]
pub fn nearest(closed: &ClosedLoop<f64>, start: &Six<f64>, within: f64) -> Option<Six<f64>> {
    let search = Explorer { closed, within };
    let (rank, _) = search.rank(start);
    let mut found = *start;
    (rank > 0 && search.project(&mut found, rank) < within).then_some(found)
}

impl SelfMotion {
    /// The point of a curve at a part of the way from one of its points, by number, to the next one.
    #[must_use]
    pub fn between(&self, closed: &ClosedLoop<f64>, first: usize, part: f64, within: f64) -> Option<Six<f64>> {
        let curve = Curve::of_self_motion(closed, &self.moving, within);
        self.trace().between(&curve, first, part).map(|point| unknowns(&point))
    }

    /// Whether a solution lies on the self-motion, angles modulo whole turns: on a curve; of a surface it is taken to where
    /// all that stands still along it is the same.
    #[must_use]
    pub fn holds(&self, closed: &ClosedLoop<f64>, solution: &Six<f64>, within: f64) -> bool {
        if self.dimension == 1 && self.points.len() > 2 {
            let curve = Curve::of_self_motion(closed, &self.moving, within);
            return self.trace().holds(&curve, &full(solution), &turns(closed));
        }
        let difference = apart(&full(solution), &full(&self.points[0]), &turns(closed));
        (0..6).all(|k| self.moving[k] || difference[k].abs() < STILL)
    }

    fn trace(&self) -> Trace {
        Trace { points: self.points.iter().map(full).collect(), is_closed: self.is_closed }
    }
}

/// A point of the seven variables of a curve.
fn full(unknowns: &Six<f64>) -> Point {
    std::array::from_fn(|k| unknowns.get(k).copied().unwrap_or(0.0))
}

fn unknowns(point: &Point) -> Six<f64> {
    std::array::from_fn(|k| point[k])
}

/// Which variables of the curve of a loop turn.
fn turns(closed: &ClosedLoop<f64>) -> [bool; 7] {
    std::array::from_fn(|k| closed.variables.get(k).is_none_or(|variable| *variable == Variable::Rotation))
}

/// What stands still along a surface differs by less between two of its points: beside a multiple one they are known to the
/// root of rounding.
const STILL: f64 = 1e-4;
/// Screws of joints that are this near to dependent ones, in scaled lengths, count as dependent: a multiple solution is
/// known to the root of rounding.
const DEPENDENT: f64 = 1e-5;

/// Looks for self-motions of one loop.
struct Explorer<'a> {
    closed: &'a ClosedLoop<f64>,
    within: f64,
}

impl Explorer<'_> {
    /// Rank of the Jacobian at real unknowns, and its right singular vectors from the largest to the smallest value.
    fn rank(&self, unknowns: &Six<f64>) -> (usize, [Six<f64>; 6]) {
        let here = closure(self.closed, unknowns);
        let matrix = Matrix6::from_fn(|i, j| here.jacobian[i][j]);
        let svd = matrix.svd(false, true);
        let mut order: [usize; 6] = std::array::from_fn(|k| k);
        let values = svd.singular_values;
        order.sort_by(|&a, &b| values[b].total_cmp(&values[a]));
        let least = RANK.max(10.0 * self.within) * values[order[0]];
        let count = order.iter().filter(|&&k| values[k] > least).count();
        let vectors = svd.v_t.map_or([[0.0; 6]; 6], |v| order.map(|k| std::array::from_fn(|j| v[(k, j)])));
        (count, vectors)
    }

    /// Slides back onto the solutions by Gauss-Newton steps with the pseudo-inverse; the closure defect reached.
    fn project(&self, unknowns: &mut Six<f64>, full_rank: usize) -> f64 {
        let mut defect = f64::INFINITY;
        for _ in 0..30 {
            let here = closure(self.closed, unknowns);
            if !(here.defect < 0.9 * defect) {
                defect = defect.min(here.defect);
                break;
            }
            defect = here.defect;
            let svd = Matrix6::from_fn(|i, j| here.jacobian[i][j]).svd(true, true);
            let mut values: Vec<f64> = svd.singular_values.iter().copied().collect();
            values.sort_by(|a, b| b.total_cmp(a));
            // Keep as many directions as the solution set leaves transversal ones.
            let cut = values[full_rank - 1].max(1e-9 * values[0]) * 0.999;
            let Ok(step) = svd.solve(&Vector6::from(here.residual), cut) else { break };
            for k in 0..6 {
                unknowns[k] -= step[k];
            }
        }
        defect
    }

    /// The curve of these unknowns through a solution at which they give way in one direction, both ways from it; `None`
    /// where the solution is isolated.
    fn curve_through(&self, solution: &Six<f64>, unlocked: &[bool; 6]) -> Option<SelfMotion> {
        let point = full(solution);
        let curve = Curve::of_self_motion(self.closed, unlocked, self.within);
        let trace = Trace::through(&curve, &point, &turns(self.closed))?;
        if !trace.is_closed && trace.length() < SHORTEST.max(4.0 * self.within.powf(0.25)) {
            return None;
        }
        let moving = |k: usize| trace.points.iter().any(|other| (other[k] - point[k]).abs() > MOVED);
        let points = trace.points.iter().map(unknowns).collect();
        Some(SelfMotion { dimension: 1, moving: std::array::from_fn(moving), points, is_closed: trace.is_closed })
    }

    /// The self-motions through a solution in which the screws of some joints span the algebra of a group of motions, and are
    /// more than its dimension: these joints move, and all others stand still. Coaxial joints are the usual case, four
    /// parallel or four concurrent axes the next.
    fn in_groups(&self, solution: &Six<f64>) -> Vec<SelfMotion> {
        let here = closure(self.closed, solution);
        let screw = |j: usize| Vector6::from_fn(|i, _| here.jacobian[i][j]);
        let mut sets: Vec<(usize, usize)> = (1_usize..64)
            .filter_map(|set| {
                let members = (0..6).filter(|j| set >> j & 1 == 1);
                let screws: Vec<Vector6<f64>> = members.map(screw).collect();
                let freedom = surplus(&screws)?;
                Some((set, freedom))
            })
            .collect();
        // The largest freedom first, of the fewest joints.
        sets.sort_by_key(|(set, freedom)| (std::cmp::Reverse(*freedom), set.count_ones()));
        let mut chosen: Vec<usize> = Vec::new();
        let mut found: Vec<SelfMotion> = Vec::new();
        for (set, dimension) in sets {
            if chosen.iter().any(|other| other & set == *other || other & set == set) {
                continue;
            }
            chosen.push(set);
            let moving: [bool; 6] = std::array::from_fn(|j| set >> j & 1 == 1);
            if dimension == 1 {
                found.extend(self.curve_through(solution, &moving));
            } else {
                found.push(SelfMotion { dimension, moving, points: vec![*solution], is_closed: false });
            }
        }
        found
    }

    /// The self-motions that meet in a solution of a higher corank.
    fn around(&self, solution: &Six<f64>, rank: usize, kernel: &[Six<f64>; 6]) -> Vec<SelfMotion> {
        let mut found: Vec<SelfMotion> = Vec::new();
        for slid in self.beside(solution, rank, kernel) {
            if found.iter().any(|other| other.holds(self.closed, &slid, self.within)) {
                continue;
            }
            let moving: [bool; 6] = std::array::from_fn(|k| (slid[k] - solution[k]).abs() > MOVED);
            match self.dimension_at(&slid) {
                None => {}
                Some(1) => {
                    // A multiple curve, whose corank is larger all along it, is not followed.
                    let points = vec![*solution, slid];
                    let short = || SelfMotion { dimension: 1, moving, points, is_closed: false };
                    let own = self.curve_through(&slid, &[true; 6]).unwrap_or_else(short);
                    let is_known = |other: &SelfMotion| other.points.len() == 2 && other.moving == own.moving;
                    if own.points.len() > 2 || !found.iter().any(is_known) {
                        found.push(own);
                    }
                }
                Some(dimension) => {
                    let dimension = dimension.min(self.dimension_away(solution, &slid).unwrap_or(1));
                    match found.iter_mut().find(|other| other.points.len() == 1) {
                        Some(other) => {
                            other.dimension = other.dimension.min(dimension);
                            other.moving = std::array::from_fn(|k| other.moving[k] || moving[k]);
                        }
                        None => found.push(SelfMotion { dimension, moving, points: vec![*solution], is_closed: false }),
                    }
                }
            }
        }
        found
    }

    /// Solutions beside one of a higher corank, in directions of its kernel, then in mixtures of them: curves leave such a
    /// point only along special ones.
    fn beside(&self, solution: &Six<f64>, rank: usize, kernel: &[Six<f64>; 6]) -> Vec<Six<f64>> {
        let corank = 6 - rank;
        let along = |trial: usize| {
            let weight = |k: usize| -> f64 {
                if trial < 2 * corank {
                    if trial / 2 == k { if trial.is_multiple_of(2) { 1.0 } else { -1.0 } } else { 0.0 }
                } else {
                    // A fixed sequence of directions, spread by the golden angle.
                    ((trial * 7 + k * 13) as f64 * 2.399_963).sin()
                }
            };
            let size = (0..corank).map(|k| weight(k).powi(2)).sum::<f64>().sqrt().max(1e-9);
            let shift = |j: usize| (0..corank).map(|k| weight(k) / size * kernel[rank + k][j]).sum::<f64>();
            std::array::from_fn::<f64, 6, _>(|j| solution[j] + 2.0 * STEP * shift(j))
        };
        let slid = |trial: usize| {
            let start = along(trial);
            (rank..6).find_map(|keep| {
                let mut slid = start;
                let defect = self.project(&mut slid, keep);
                let distance = (0..6).map(|k| (slid[k] - solution[k]).abs()).fold(0.0, f64::max);
                (defect < self.within && distance > 1e-3 && distance < 0.5).then_some(slid)
            })
        };
        (0..2 * corank + 24).filter_map(slid).collect()
    }

    /// The dimension of the solutions at one of them on a self-motion, by where points beside it lie: the corank may be
    /// larger, also all along a curve. `None` for a regular point.
    fn dimension_at(&self, unknowns: &Six<f64>) -> Option<usize> {
        let (count, vectors) = self.rank(unknowns);
        let corank = 6 - count;
        if corank <= 1 || count == 0 {
            return (corank > 0).then_some(corank);
        }
        // A fixed sequence of directions in the kernel, several for each dimension.
        let directions = (1..=6 * corank).map(|trial| {
            let weights: Vec<f64> = (0..corank).map(|k| ((trial * 5 + k * 11) as f64 * 2.399_963).sin()).collect();
            let norm = weights.iter().map(|w| w * w).sum::<f64>().sqrt().max(1e-9);
            let entry = |j: usize| (0..corank).map(|k| weights[k] / norm * vectors[count + k][j]).sum::<f64>();
            std::array::from_fn::<f64, 6, _>(entry)
        });
        let mut moment = Matrix6::zeros();
        for direction in directions {
            let start: Six<f64> = std::array::from_fn(|j| unknowns[j] + STEP * direction[j]);
            for keep in count..6 {
                let mut slid = start;
                let defect = self.project(&mut slid, keep);
                let moved = Vector6::from_fn(|j, _| (slid[j] - unknowns[j]) / STEP);
                if defect < self.within && moved.norm() < 10.0 {
                    moment += moved * moved.transpose();
                    break;
                }
            }
        }
        let spreads: Vec<f64> = moment.symmetric_eigenvalues().iter().map(|x| x.max(0.0).sqrt()).collect();
        let largest = spreads.iter().copied().fold(0.0, f64::max);
        let dimension = spreads.iter().filter(|spread| **spread > SPREAD * largest).count();
        Some(dimension.clamp(1, corank))
    }

    /// The dimension some way off, in the direction from a solution to one beside it; `None` where nothing leads away in that
    /// direction, as beside a point in which curves meet: a surface goes on in every direction of the kernel.
    fn dimension_away(&self, from: &Six<f64>, beside: &Six<f64>) -> Option<usize> {
        let heading = Vector6::from_fn(|k, _| beside[k] - from[k]);
        let mut here = *beside;
        for number in 0..5 {
            let (count, vectors) = self.rank(&here);
            let kernel = vectors[count..].iter().map(|v| Vector6::from_row_slice(v));
            let direction: Vector6<f64> = kernel.map(|v| v * v.dot(&heading)).sum();
            let size = direction.norm();
            if !(size > 0.0) || count == 0 {
                return None;
            }
            let mut next: Six<f64> = std::array::from_fn(|k| here[k] + 5.0 * STEP * direction[k] / size);
            if !(self.project(&mut next, count) < self.within) {
                if number == 0 {
                    return None;
                }
                break;
            }
            here = next;
        }
        self.dimension_at(&here)
    }
}

/// Returns by how many the screws outnumber the dimension of the algebra of motions that they span; `None` unless they do,
/// and span it.
fn surplus(screws: &[Vector6<f64>]) -> Option<usize> {
    let mut basis: Vec<Vector6<f64>> = Vec::new();
    for screw in screws {
        extend(&mut basis, screw);
    }
    let rank = basis.len();
    let surplus = screws.len().checked_sub(rank).filter(|surplus| *surplus > 0)?;
    let is_closed = (0..rank).all(|j| (0..j).all(|k| !extend(&mut basis.clone(), &bracket(&basis[j], &basis[k]))));
    is_closed.then_some(surplus)
}

/// Adds what is new of a screw to an orthonormal basis. Whether there was anything.
fn extend(basis: &mut Vec<Vector6<f64>>, screw: &Vector6<f64>) -> bool {
    let mut left = *screw;
    // Twice: what cancels at first leaves rounding.
    for _ in 0..2 {
        for own in basis.iter() {
            left -= *own * own.dot(&left);
        }
    }
    let size = left.norm();
    let is_new = size > DEPENDENT * screw.norm().max(1.0);
    if is_new {
        basis.push(left / size);
    }
    is_new
}

/// The Lie bracket of two screws, direction and moment.
fn bracket(a: &Vector6<f64>, b: &Vector6<f64>) -> Vector6<f64> {
    let [wa, va, wb, vb] = [(a, 0), (a, 3), (b, 0), (b, 3)].map(|(s, at)| s.fixed_rows::<3>(at).into_owned());
    let (w, v) = (wa.cross(&wb), wa.cross(&vb) + va.cross(&wb));
    Vector6::new(w.x, w.y, w.z, v.x, v.y, v.z)
}
