//! Looks for the solutions beside one: whether they form a curve or more, and which joints move along it.
//!
//! The loop has seven variables of which some are idle: six unknowns at a pose or input, or seven of an arm with one
//! freedom more than its pose has conditions.

use super::curve::{Curve, Point};
use super::walk::{Place, Trace, apart, dot, norm, step};
use crate::algebra::sort;
use looproot_calculus::finite::finite;
use nalgebra::{SMatrix, SVector, Vector6};

/// The Jacobian of seven variables, columns of idle ones zero.
type Jacobian = SMatrix<f64, 6, 7>;

/// Solutions that form a curve or more, as measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The dimension, at least 1.
    pub dimension: usize,
    /// Marks the variables that move.
    pub moving: [bool; 7],
    /// The points of a curve; of a surface one point, or some that are spread over it.
    pub trace: Trace,
}

/// Singular values below this part of the largest count as zero on a curve that closes to rounding.
const RANK: f64 = 1e-6;
/// Unknowns that change by less along a step of 0.02 stand still: rounding at a multiple curve reaches 1e-7.
const MOVED: f64 = 1e-6;
/// Unknowns that stand still may wander by this, in parts of what the closure may be missed by: condition numbers of usual arms.
const WANDERS: f64 = 100.0;
/// Length of a step that explores a self-motion.
const STEP: f64 = 0.01;
/// Directions in which points of a self-motion lie beside one of its points: those with at least this part of the largest
/// spread. A curve bends by a part of about one step of 0.01 out of its tangent.
const SPREAD: f64 = 0.15;
/// The length that a curve has at least, unless it closes: a multiple solution closes to rounding in its neighbourhood,
/// too, as 0.1 to the power of its order; and within what is allowed as far as the root of that order.
const SHORTEST: f64 = 0.15;

/// Largest difference of a constant variable between two points of a surface: near a multiple point both are known to the square
/// root of rounding only.
const STILL: f64 = 1e-4;
/// Screws of joints that are this near to dependent ones, in scaled lengths, count as dependent: a multiple solution is
/// known to the root of rounding.
const DEPENDENT: f64 = 1e-5;

/// Curves of this number of points are not looked at for crossings: they do not close, and go on without end.
const MOST_POINTS: usize = 500;
/// Steps towards a crossing at most: each one halves the distance, or shows how far it is.
const MOST_HALVINGS: usize = 40;
/// A crossing this near, in parts of what counts as one, is where the value would be 0: what is left is its square.
const NEXT_TO: f64 = 1e-2;
/// Points taken across a surface along each of its curves: two neighbours are less than 20 degrees apart.
const ACROSS: usize = 24;
/// Pieces looked at for crossings: more are not known of any arm.
const MOST_PIECES: usize = 16;

/// Looks for what one loop has beside its solutions. Points close the loop within `within`, in radians and scaled lengths.
#[derive(Debug)]
pub struct Explorer<'a> {
    curve: &'a Curve,
    within: f64,
    /// The number of variables that are not virtual.
    unknowns: usize,
}

/// The rank of the Jacobian, and its right singular vectors among the variables that are not idle, from the largest to the
/// smallest value.
struct Rank {
    rank: usize,
    vectors: Vec<Point>,
}

impl Rank {
    /// In how many directions the loop gives way.
    fn corank(&self) -> usize {
        self.vectors.len() - self.rank
    }

    fn kernel(&self) -> &[Point] {
        &self.vectors[self.rank..]
    }
}

impl Piece {
    /// Returns a piece known by one point, or by some that are not neighbours.
    fn at(dimension: usize, moving: [bool; 7], points: Vec<Point>) -> Self {
        Self { dimension, moving, trace: Trace { points, is_closed: false } }
    }
}

impl<'a> Explorer<'a> {
    /// Beside the solutions of this loop.
    #[must_use]
    pub fn new(curve: &'a Curve, within: f64) -> Self {
        let unknowns = curve.idle().iter().filter(|idle| !**idle).count();
        Self { curve, within, unknowns }
    }

    /// Returns the pieces on which a real solution lies; none where it appears to be isolated.
    #[must_use]
    pub fn pieces(&self, solution: &Point) -> Vec<Piece> {
        let here = self.rank(solution);
        match (here.rank, here.corank()) {
            (0, _) | (_, 0) => Vec::new(),
            (_, 1) => self.curve_through(solution, &[true; 7]).into_iter().collect(),
            _ => {
                let in_groups = self.in_groups(solution);
                if in_groups.is_empty() { self.around(solution, &here) } else { in_groups }
            }
        }
    }

    /// Adds the curves that cross known ones: where a curve of an arm passes another singular position, its other joints are free too.
    pub fn add_crossing(&self, known: &mut Vec<Piece>) {
        let mut next = 0;
        while next < known.len().min(MOST_PIECES) {
            for point in self.crossings(&known[next]) {
                for other in self.pieces(&point) {
                    let is_curve = other.dimension == 1 && other.trace.points.len() > 2;
                    let middle = &other.trace.points[other.trace.points.len() / 2];
                    if is_curve && !known.iter().any(|own| self.holds(own, middle)) {
                        known.push(other);
                    }
                }
            }
            next += 1;
        }
    }

    /// Returns the points of a curve at which the loop gives way in a direction beside that of the curve.
    fn crossings(&self, piece: &Piece) -> Vec<Point> {
        let points = &piece.trace.points;
        if piece.dimension != 1 || !(3..MOST_POINTS).contains(&points.len()) || self.unknowns < 2 {
            return Vec::new();
        }
        let curve = self.curve.unlocked(&piece.moving, self.within);
        let values: Vec<f64> = points.iter().map(|point| self.second(point)).collect();
        let last = points.len() - 1;
        let mut found = Vec::new();
        for k in 0..=last {
            // Past the end of a closed curve, whose last point is its first one, it goes on.
            let (before, after) = match k {
                0 if piece.trace.is_closed => continue,
                _ if k == last && piece.trace.is_closed => (k - 1, 1),
                _ => (k.saturating_sub(1), (k + 1).min(last)),
            };
            let beside = values[before].max(values[after]);
            // On both sides of a crossing the value grows with the distance, and a multiple curve has it small all along.
            if values[k] <= values[before].min(values[after]) && values[k] < 0.75 * beside && beside > RANK {
                let beyond =
                    |from: &usize| self.crossing(&curve, [&points[k], &points[*from]], [values[k], values[*from]]);
                found.extend([before, after].iter().filter(|from| **from != k).find_map(beyond));
            }
        }
        found
    }

    /// The crossing beyond a point of a curve as seen from the second one: how far it is shows the second smallest singular value,
    /// which is proportional to the distance, and which every step halves.
    fn crossing(&self, curve: &Curve, [at, from]: [&Point; 2], [mut value, before]: [f64; 2]) -> Option<Point> {
        let chord = apart(at, from, &self.curve.turns());
        let mut here = Place { point: *at, direction: curve.tangent(at, &chord)? };
        let longest = norm(&chord);
        let mut away = (longest * value / (before - value)).min(longest);
        for _ in 0..MOST_HALVINGS {
            if value < NEXT_TO * RANK {
                let point = std::array::from_fn(|k| here.point[k] + away * here.direction[k]);
                return (self.second(&point) < RANK).then_some(point);
            }
            let (next, way) = step(curve, &here, away / 2.0)?;
            let there = self.second(&next.point);
            if !(there < value) {
                return None;
            }
            away = (way * there / (value - there)).min(longest);
            (here, value) = (next, there);
        }
        None
    }

    /// The second smallest singular value of the Jacobian of the variables that are not idle, in parts of the largest: that of a
    /// point of a curve is 0 where another one meets it.
    fn second(&self, at: &Point) -> f64 {
        let mut values: Vec<f64> = finite(self.matrix(at)).singular_values().iter().copied().collect();
        sort::by(&mut values, |a, b| b.total_cmp(a));
        values[self.unknowns - 2] / values[0]
    }

    /// The real configuration nearest to closing beside this one, along which the loop gives way least; `None` where none
    /// closes.
    #[must_use]
    pub fn nearest(&self, start: &Point) -> Option<Point> {
        let Rank { rank, .. } = self.rank(start);
        let mut found = *start;
        (rank > 0 && self.project(&mut found, rank) < self.within).then_some(found)
    }

    /// Returns whether a solution lies on a piece, angles modulo whole turns. On a curve this is tested; on a surface it is
    /// assumed where all constant variables agree.
    #[must_use]
    pub fn holds(&self, piece: &Piece, solution: &Point) -> bool {
        let turns = self.curve.turns();
        if piece.dimension == 1 && piece.trace.points.len() > 2 {
            let curve = self.curve.unlocked(&piece.moving, self.within);
            return piece.trace.holds(&curve, solution, &turns);
        }
        let difference = apart(solution, &piece.trace.points[0], &turns);
        (0..7).all(|k| piece.moving[k] || difference[k].abs() < STILL)
    }

    /// The point of a curve at a part of the way from one of its points, by number, to the next one.
    #[must_use]
    pub fn between(&self, piece: &Piece, first: usize, part: f64) -> Option<Point> {
        let curve = self.curve.unlocked(&piece.moving, self.within);
        piece.trace.between(&curve, first, part)
    }

    fn rank(&self, at: &Point) -> Rank {
        let svd = finite(self.matrix(at).transpose()).svd(true, false);
        let values = svd.singular_values;
        let mut order: [usize; 6] = std::array::from_fn(|k| k);
        sort::by(&mut order, |&a, &b| values[b].total_cmp(&values[a]));
        let least = RANK.max(10.0 * self.within) * values[order[0]];
        let rank = order.iter().filter(|&&k| values[k] > least).count();
        let mut vectors: Vec<Point> = Vec::with_capacity(self.unknowns);
        if let Some(left) = svd.u {
            let column = |k: usize| -> Point { std::array::from_fn(|j| left[(j, k)]) };
            vectors.extend(order.iter().take(rank.min(self.unknowns)).map(|&k| column(k)));
            // The last direction of seven unknowns does not belong to the six.
            let others = order.iter().skip(rank).map(|&k| column(k));
            let units = (0..7).map(|k| std::array::from_fn(|j| f64::from(u8::from(j == k))));
            for vector in others.chain(units) {
                if vectors.len() < self.unknowns {
                    vectors.extend(self.beside_all(&vectors, vector));
                }
            }
        }
        Rank { rank: rank.min(self.unknowns), vectors }
    }

    /// Returns the component of a vector across orthonormal ones, scaled to length 1 and without virtual variables; `None` where
    /// it is rounding.
    fn beside_all(&self, all: &[Point], vector: Point) -> Option<Point> {
        /// Less of a vector than this is rounding.
        const LEAST: f64 = 1e-3;
        let idle = self.curve.idle();
        let mut left: Point = std::array::from_fn(|j| if idle[j] { 0.0 } else { vector[j] });
        for _ in 0..2 {
            for own in all {
                let along = dot(own, &left);
                left = std::array::from_fn(|j| left[j] - along * own[j]);
            }
        }
        let size = norm(&left);
        (size > LEAST).then(|| left.map(|x| x / size))
    }

    /// The Jacobian with columns of zeros for idle variables.
    fn matrix(&self, at: &Point) -> Jacobian {
        let (_, jacobian) = self.curve.closure(at);
        let idle = self.curve.idle();
        Jacobian::from_fn(|i, j| if idle[j] { 0.0 } else { jacobian[i][j] })
    }

    /// Slides back onto the solutions by Gauss-Newton steps with the pseudo-inverse; the closure defect reached.
    fn project(&self, at: &mut Point, full_rank: usize) -> f64 {
        let mut last = f64::INFINITY;
        for _ in 0..30 {
            let (closing, _) = self.curve.closure(at);
            if !(closing.defect < 0.9 * last) {
                last = last.min(closing.defect);
                break;
            }
            last = closing.defect;
            let svd = finite(self.matrix(at)).svd(true, true);
            let mut values: Vec<f64> = svd.singular_values.iter().copied().collect();
            sort::by(&mut values, |a, b| b.total_cmp(a));
            // The cut keeps as many directions as the solution set leaves transversal ones.
            let cut = values[full_rank.min(6) - 1].max(1e-9 * values[0]) * 0.999;
            let Ok(step) = svd.solve(&Vector6::from(closing.residual), cut) else { break };
            for k in 0..7 {
                at[k] -= step[k];
            }
        }
        last
    }

    /// The curve of these variables through a solution at which they give way in one direction, both ways from it; `None`
    /// where the solution is isolated.
    fn curve_through(&self, solution: &Point, unlocked: &[bool; 7]) -> Option<Piece> {
        let curve = self.curve.unlocked(unlocked, self.within);
        let trace = Trace::through(&curve, solution, &self.curve.turns())?;
        if !trace.is_closed && trace.length() < SHORTEST.max(4.0 * self.within.powf(0.25)) {
            return None;
        }
        // Within a wide tolerance joints wander by what it lets them.
        let moved = MOVED.max(WANDERS * self.within);
        let moving = |k: usize| trace.points.iter().any(|other| (other[k] - solution[k]).abs() > moved);
        let moving = std::array::from_fn(moving);
        Some(Piece { dimension: 1, moving, trace })
    }

    /// The pieces through a solution in which the screws of some joints span the algebra of a group of motions, and are
    /// more than its dimension: these joints move, and all others stand still. Coaxial joints are the usual case, four
    /// parallel or four concurrent axes the next.
    fn in_groups(&self, solution: &Point) -> Vec<Piece> {
        let (_, jacobian) = self.curve.closure(solution);
        let idle = self.curve.idle();
        let screw = |j: usize| Vector6::from_fn(|i, _| jacobian[i][j]);
        let mut sets: Vec<(usize, usize)> = (1_usize..128)
            .filter(|set| (0..7).all(|j| set >> j & 1 == 0 || !idle[j]))
            .filter_map(|set| {
                let members = (0..7).filter(|j| set >> j & 1 == 1);
                let screws: Vec<Vector6<f64>> = members.map(screw).collect();
                let freedom = surplus(&screws)?;
                Some((set, freedom))
            })
            // All motions in space are a group, too, but what its joints do is not known by that.
            .filter(|(set, _)| set.count_ones() < 7)
            .collect();
        // The largest freedom first, of the fewest joints.
        sort::by_key(&mut sets, |(set, freedom)| (std::cmp::Reverse(*freedom), set.count_ones()));
        let mut chosen: Vec<(usize, usize)> = Vec::new();
        for (set, dimension) in sets {
            if !chosen.iter().any(|(other, _)| other & set == *other || other & set == set) {
                chosen.push((set, dimension));
            }
        }
        together(&chosen).iter().filter_map(|sets| self.moved_together(solution, sets)).collect()
    }

    /// The piece through a solution along which sets of joints move independently of each other, each with its freedom.
    fn moved_together(&self, solution: &Point, sets: &[(usize, usize)]) -> Option<Piece> {
        let marks = |set: usize| -> [bool; 7] { std::array::from_fn(|j| set >> j & 1 == 1) };
        let mut all = Piece::at(0, [false; 7], vec![*solution]);
        for (set, dimension) in sets {
            let own = marks(*set);
            let piece = match dimension {
                1 => match self.curve_through(solution, &own) {
                    Some(curve) => curve,
                    None => continue,
                },
                _ => Piece::at(*dimension, own, vec![*solution]),
            };
            if all.dimension == 0 {
                all = piece;
                continue;
            }
            // The points of both, some of every curve: all that is asked of them is one within joint limits.
            let some = |piece: &Piece| -> Vec<Point> {
                let points = &piece.trace.points;
                points.iter().step_by(points.len().div_ceil(ACROSS)).copied().collect()
            };
            let (ones, others) = (some(&all), some(&piece));
            let joined = |one: &Point, other: &Point| std::array::from_fn(|j| if own[j] { other[j] } else { one[j] });
            let points = ones.iter().flat_map(|one| others.iter().map(move |other| joined(one, other))).collect();
            let moving = std::array::from_fn(|j| all.moving[j] || piece.moving[j]);
            all = Piece::at(all.dimension + dimension, moving, points);
        }
        (all.dimension > 0).then_some(all)
    }

    /// The pieces that meet in a solution of a higher corank.
    fn around(&self, solution: &Point, here: &Rank) -> Vec<Piece> {
        let mut found: Vec<Piece> = Vec::new();
        for slid in self.beside(solution, here) {
            if found.iter().any(|other| self.holds(other, &slid)) {
                continue;
            }
            let moving: [bool; 7] = std::array::from_fn(|k| (slid[k] - solution[k]).abs() > MOVED);
            match self.dimension_at(&slid) {
                None => {}
                Some(1) => {
                    // A multiple curve, whose corank is larger all along it, is not followed.
                    let points = vec![*solution, slid];
                    let short = || Piece::at(1, moving, points);
                    let own = self.curve_through(&slid, &[true; 7]).unwrap_or_else(short);
                    let is_known = |other: &Piece| other.trace.points.len() == 2 && other.moving == own.moving;
                    if own.trace.points.len() > 2 || !found.iter().any(is_known) {
                        found.push(own);
                    }
                }
                Some(dimension) => {
                    let dimension = dimension.min(self.dimension_away(solution, &slid).unwrap_or(1));
                    match found.iter_mut().find(|other| other.trace.points.len() == 1) {
                        Some(other) => {
                            other.dimension = other.dimension.min(dimension);
                            other.moving = std::array::from_fn(|k| other.moving[k] || moving[k]);
                        }
                        None => found.push(Piece::at(dimension, moving, vec![*solution])),
                    }
                }
            }
        }
        found
    }

    /// Solutions beside one of a higher corank, in directions of its kernel, then in mixtures of them: curves leave such a
    /// point only along special ones.
    fn beside(&self, solution: &Point, here: &Rank) -> Vec<Point> {
        let (rank, corank, kernel) = (here.rank, here.corank(), here.kernel());
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
            let shift = |j: usize| (0..corank).map(|k| weight(k) / size * kernel[k][j]).sum::<f64>();
            std::array::from_fn::<f64, 7, _>(|j| solution[j] + 2.0 * STEP * shift(j))
        };
        let slid = |trial: usize| {
            let start = along(trial);
            (rank..self.unknowns).find_map(|keep| {
                let mut slid = start;
                let defect = self.project(&mut slid, keep);
                let distance = (0..7).map(|k| (slid[k] - solution[k]).abs()).fold(0.0, f64::max);
                (defect < self.within && distance > 1e-3 && distance < 0.5).then_some(slid)
            })
        };
        (0..2 * corank + 24).filter_map(slid).collect()
    }

    /// The dimension of the solutions at one of them on a self-motion, by where points beside it lie: the corank may be
    /// larger, also all along a curve. `None` for a regular point.
    fn dimension_at(&self, unknowns: &Point) -> Option<usize> {
        let here = self.rank(unknowns);
        let (count, corank) = (here.rank, here.corank());
        if corank <= 1 || count == 0 {
            return (corank > 0).then_some(corank);
        }
        // A fixed sequence of directions in the kernel, several for each dimension.
        let directions = (1..=6 * corank).map(|trial| {
            let weights: Vec<f64> = (0..corank).map(|k| ((trial * 5 + k * 11) as f64 * 2.399_963).sin()).collect();
            let norm = weights.iter().map(|w| w * w).sum::<f64>().sqrt().max(1e-9);
            let entry = |j: usize| (0..corank).map(|k| weights[k] / norm * here.kernel()[k][j]).sum::<f64>();
            std::array::from_fn::<f64, 7, _>(entry)
        });
        let mut moment = SMatrix::<f64, 7, 7>::zeros();
        for direction in directions {
            let start: Point = std::array::from_fn(|j| unknowns[j] + STEP * direction[j]);
            for keep in count..self.unknowns {
                let mut slid = start;
                let defect = self.project(&mut slid, keep);
                let moved = SVector::<f64, 7>::from_fn(|j, _| (slid[j] - unknowns[j]) / STEP);
                if defect < self.within && moved.norm() < 10.0 {
                    moment += moved * moved.transpose();
                    break;
                }
            }
        }
        let spreads: Vec<f64> = finite(moment).symmetric_eigenvalues().iter().map(|x| x.max(0.0).sqrt()).collect();
        let largest = spreads.iter().copied().fold(0.0, f64::max);
        let dimension = spreads.iter().filter(|spread| **spread > SPREAD * largest).count();
        Some(dimension.clamp(1, corank))
    }

    /// The dimension some way off, in the direction from a solution to one beside it; `None` where nothing leads away in that
    /// direction, as beside a point in which curves meet: a surface goes on in every direction of the kernel.
    fn dimension_away(&self, from: &Point, beside: &Point) -> Option<usize> {
        let heading: Point = std::array::from_fn(|k| beside[k] - from[k]);
        let mut here = *beside;
        for number in 0..5 {
            let at = self.rank(&here);
            let direction = at.kernel().iter().fold([0.0; 7], |sum: Point, own| {
                let along = dot(own, &heading);
                std::array::from_fn(|k| sum[k] + along * own[k])
            });
            let size = norm(&direction);
            if !(size > 0.0) || at.rank == 0 {
                return None;
            }
            let mut next: Point = std::array::from_fn(|k| here[k] + 5.0 * STEP * direction[k] / size);
            if !(self.project(&mut next, at.rank) < self.within) {
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

/// Returns the sets of joints that move independently of each other, with their freedoms, as many of them together as do. Of two sets
/// without a common joint that do not alternate round the loop, one stands between two neighbours of the other: what it does there
/// amounts to nothing, and the other one does not see it.
fn together(sets: &[(usize, usize)]) -> Vec<Vec<(usize, usize)>> {
    let mut found: Vec<Vec<(usize, usize)>> = Vec::new();
    for first in sets {
        let mut own = vec![*first];
        for other in sets {
            if own.iter().all(|(set, _)| are_independent(*set, other.0)) {
                own.push(*other);
            }
        }
        let is_known = found.iter().any(|known| own.iter().all(|set| known.contains(set)));
        if !is_known {
            found.push(own);
        }
    }
    found
}

/// Whether two sets of joints have no joint in common, and do not alternate round the loop.
fn are_independent(one: usize, other: usize) -> bool {
    let sides: Vec<bool> = (0..7).filter(|j| (one | other) >> j & 1 == 1).map(|j| one >> j & 1 == 1).collect();
    let next = sides.iter().cycle().skip(1);
    one & other == 0 && sides.iter().zip(next).filter(|(side, next)| side != next).count() <= 2
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_of_joints_that_alternate_round_the_loop_do_not_move_together() {
        // Joints 1 and 3, 5 and 7; 1 and 3 with 2 and 4; 1 and 7 stand beside each other, round the end.
        let [one, other, between, round] = [0b000_0101, 0b101_0000, 0b000_1010, 0b100_0001];
        assert!(are_independent(one, other) && are_independent(round, between));
        assert!(!are_independent(one, between) && !are_independent(one, round));
        assert_eq!(
            together(&[(one, 1), (other, 1), (between, 2)]),
            [vec![(one, 1), (other, 1)], vec![(between, 2), (other, 1)]]
        );
    }
}
