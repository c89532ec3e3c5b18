//! The families of configurations of an arm with one freedom more than its task has conditions.

use super::{Inner, TaskArm};
use crate::kinematics::chain::{Chain, Placement};
use crate::kinematics::closed_loop::{Layout, OpenLoop};
use crate::kinematics::screws::Behind;
use crate::kinematics::task::Task;
use crate::kinematics::tolerance::{PoseError, Tolerance};
use crate::mechanism::family::{Joints, Shape};
use crate::mechanism::{Family, FullMode};
use crate::solve::curve::{CLOSES_WITHIN, Curve, INPUT, Point};
use crate::solve::explorer::{Explorer, Piece};
use crate::solve::locked::locked;
use crate::solve::walk::{Trace, apart, norm};
use num_complex::Complex;
use std::f64::consts::PI;

/// A miss below this part of the reach is the rounding of a curve that was followed in f64.
const ROUNDING: f64 = 1e-10;
/// Two configurations at which the arm is locked are one where they are nearer: rounding of 1e-11 moves a double one by its root.
const SAME: f64 = 1e-4;
/// The error of a family is measured at this number of points.
const LOOKED_AT: usize = 24;

/// The loop of seven variables at a pose, and the order of its variables.
pub(super) struct Tracer<'a> {
    of: &'a TaskArm,
    pose: &'a Placement,
    curve: Curve,
    /// Residual up to which near configurations count as closed, in radians and scaled lengths.
    within: f64,
    tolerance: Tolerance,
    /// What moves by every variable of a point.
    movers: [Mover; 7],
    found: Vec<Found>,
    /// Configurations from which no curve leads away.
    locked: Vec<Point>,
}

/// What a variable of the loop moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mover {
    /// A joint of the arm.
    Joint(usize),
    /// A virtual joint of the task.
    Virtual(usize),
}

impl Mover {
    fn joint(self) -> Option<usize> {
        match self {
            Self::Joint(joint) => Some(joint),
            Self::Virtual(_) => None,
        }
    }
}

/// A family that was met.
struct Found {
    piece: Piece,
    /// Its largest distance from the pose.
    distance: f64,
    /// Residual within which its points close the loop.
    within: f64,
}

impl<'a> Tracer<'a> {
    /// The loop at a pose; `None` where it has not seven variables.
    pub(super) fn of(of: &'a TaskArm, pose: &'a Placement, tolerance: Tolerance) -> Option<Self> {
        let mut behind = of.task.behind_one_by_one(&|| Behind::Constant(Box::new(pose.turned_back())));
        // The rotation of a pose of which only the tilt is asked stands between its two virtual joints.
        let end = if of.task == Task::PositionTilt { pose.without_rotation().undone() } else { pose.undone() };
        behind.push(Behind::Constant(Box::new(end)));
        let chain: Chain = of.chain.in_screws(&of.held, &behind)?;
        let variables = chain.variables();
        if variables.len() != 7 {
            return None;
        }
        let layout = Layout::of(&chain, Some(0)).ok()?;
        let open: OpenLoop<f64> = chain.open_loop(&layout).ok()?;
        let kept = of.kept(&Inner { held: of.held.clone(), ..Inner::default() });
        let order = layout.joint_variables();
        // Virtual joints stand behind those of the arm.
        let mover = |own: usize| kept.get(own).map_or_else(|| Mover::Virtual(own - kept.len()), |k| Mover::Joint(*k));
        let mut movers = [Mover::Joint(0); 7];
        for (k, place) in movers.iter_mut().enumerate() {
            *place = mover(if k == INPUT { 0 } else { order.get(k).copied().flatten()? });
        }
        let curve = Curve::new(&open, [false; 6], variables[0].variable);
        let scale = (0..7).map(|k| curve.unit(k)).fold(f64::MIN_POSITIVE, f64::max);
        let within = tolerance.angle.max(tolerance.length / scale).max(CLOSES_WITHIN);
        Some(Self { of, pose, curve, within, tolerance, movers, found: Vec::new(), locked: Vec::new() })
    }

    /// Follows the families through a configuration, unless they are known. A configuration that only comes near the pose need
    /// not close exactly.
    pub(super) fn follow(&mut self, q: &[f64], is_near: bool) {
        let start = self.point(q);
        if !is_near {
            self.follow_from(&start, CLOSES_WITHIN);
        } else if let Some(start) = Explorer::new(&self.curve, self.within).nearest(&start) {
            self.follow_from(&start, self.within);
        }
    }

    /// Follows the families through the configuration of the pose to which the real part of a complex solution leads, if it leads to
    /// one. A closed curve between two values of the held joint meets neither, and two solutions become real where that joint enters it:
    /// before that, their real part is in the middle between them. From the middle of a small closed curve every step of Newton's
    /// method leads outwards, to the curve itself.
    pub(super) fn follow_beside(&mut self, q: &[f64]) {
        if let Some(start) = Explorer::new(&self.curve, CLOSES_WITHIN).nearest(&self.point(q)) {
            self.follow_from(&start, CLOSES_WITHIN);
        }
    }

    /// Looks for a configuration at which the arm is locked, near the real part of a complex solution: two complex branches meet there.
    pub(super) fn look_for_locked(&mut self, q: &[f64]) {
        let Some(found) = locked(&self.curve, &self.point(q)) else { return };
        let twin = self.twin(&found);
        let turns = self.curve.turns();
        let is_same = |known: &Point, point: &Point| norm(&apart(known, point, &turns)) < SAME;
        let is_known = |known: &Point| is_same(known, &found) || twin.as_ref().is_some_and(|twin| is_same(known, twin));
        if !self.locked.iter().any(is_known) {
            self.locked.push(found);
        }
    }

    /// Returns the configurations at which the arm is locked: each is two solutions that coincide.
    pub(super) fn locked(&self) -> Vec<FullMode> {
        let joints = self.joints();
        let mode = |point: &Point| {
            let q = joints.placed(self.configuration(point));
            let (closing, _) = self.curve.closure(point);
            FullMode {
                within_limits: (!joints.limits.is_empty()).then(|| joints.is_inside(&q)),
                q: q.into_iter().map(Complex::from).collect(),
                real: true,
                multiplicity: 2,
                residual: closing.defect,
                condition: f64::INFINITY,
                certified: false,
                radius: f64::INFINITY,
                near: false,
                error: None,
                platform: None,
            }
        };
        self.locked.iter().map(mode).collect()
    }

    fn joints(&self) -> Joints<'_> {
        Joints { variables: self.of.forward.variables(), limits: &self.of.limits }
    }

    /// The point of a configuration; where the pose is missed, with virtual joints that come near it.
    fn point(&self, q: &[f64]) -> Point {
        let virtual_ones = self.of.task.virtual_values(&self.of.forward.pose(q), &self.pose.float);
        std::array::from_fn(|k| {
            let value = match self.movers[k] {
                Mover::Joint(joint) => q[joint],
                Mover::Virtual(number) => virtual_ones[number],
            };
            value / self.curve.unit(k)
        })
    }

    /// The other point of the same configuration: three rotations in place of a spherical joint turn the tool alike in two ways.
    fn twin(&self, point: &Point) -> Option<Point> {
        (self.of.task == Task::Position).then(|| {
            std::array::from_fn(|k| match self.movers[k] {
                Mover::Virtual(1) => PI - point[k],
                Mover::Virtual(_) => point[k] + PI,
                Mover::Joint(_) => point[k],
            })
        })
    }

    /// Whether a configuration lies on a piece.
    fn holds(&self, explorer: &Explorer<'_>, piece: &Piece, point: &Point) -> bool {
        explorer.holds(piece, point) || self.twin(point).is_some_and(|twin| explorer.holds(piece, &twin))
    }

    /// Follows the families through a point that closes the loop within a residual, unless they are known.
    fn follow_from(&mut self, start: &Point, within: f64) {
        let explorer = Explorer::new(&self.curve, within);
        let holds =
            |known: &Found| self.holds(&Explorer::new(&self.curve, known.within.max(within)), &known.piece, start);
        if self.found.iter().any(holds) {
            return;
        }
        let mut new: Vec<Found> = Vec::new();
        for piece in explorer.pieces(start) {
            // Where virtual joints alone move, the arm stands still.
            if !(0..7).any(|k| piece.moving[k] && self.movers[k].joint().is_some()) {
                continue;
            }
            let piece = self.once_round(piece, within);
            let middle = piece.trace.points[piece.trace.points.len() / 2];
            let is_known = |known: &Found| {
                known.piece.dimension >= piece.dimension && self.holds(&explorer, &known.piece, &middle)
            };
            let is_new = !self.found.iter().chain(&new).any(is_known);
            if let Some(distance) = self.distance(&piece).filter(|_| is_new) {
                new.push(Found { piece, distance, within });
            }
        }
        // A family contained in one of a larger dimension is dropped as a part of it.
        let mut all = std::mem::take(&mut self.found);
        all.extend(new);
        let explorer = Explorer::new(&self.curve, within);
        let is_part = |known: &Found, of: &Piece| {
            let middle = &known.piece.trace.points[known.piece.trace.points.len() / 2];
            known.piece.dimension < of.dimension && self.holds(&explorer, of, middle)
        };
        let keeps: Vec<bool> = all.iter().map(|known| !all.iter().any(|other| is_part(known, &other.piece))).collect();
        self.found = all.into_iter().zip(keeps).filter_map(|(known, is_kept)| is_kept.then_some(known)).collect();
    }

    /// A closed curve on which every configuration lies twice, cut to one time round.
    fn once_round(&self, piece: Piece, within: f64) -> Piece {
        let points = &piece.trace.points;
        let Some(twin) = points.first().and_then(|first| self.twin(first)) else { return piece };
        if piece.dimension != 1 || !piece.trace.is_closed {
            return piece;
        }
        let (curve, turns) = (self.curve.unlocked(&piece.moving, within), self.curve.turns());
        let is_between =
            |pair: &[Point]| Trace { points: pair.to_vec(), is_closed: false }.holds(&curve, &twin, &turns);
        let Some(last) = points.windows(2).position(is_between) else { return piece };
        let way = apart(&twin, &points[last], &turns);
        let end: Point = std::array::from_fn(|k| points[last][k] + way[k]);
        let points = points[..=last].iter().copied().chain([end]).collect();
        Piece { trace: Trace { points, is_closed: true }, ..piece }
    }

    /// Returns the largest distance of a family from the pose: 0 where it is rounding; `None` beyond the tolerance.
    fn distance(&self, piece: &Piece) -> Option<f64> {
        let points = &piece.trace.points;
        let stride = points.len().div_ceil(LOOKED_AT);
        let miss = |point: &Point| {
            let q = self.configuration(point);
            self.of.task.miss(&self.of.forward.pose(&q), &self.pose.float)
        };
        let misses: Vec<PoseError> = points.iter().step_by(stride).map(miss).collect();
        let worst = misses.iter().map(PoseError::largest).fold(0.0, f64::max);
        if worst < ROUNDING * (1.0 + self.of.forward.reach()) {
            return Some(0.0);
        }
        misses.iter().all(|miss| self.tolerance.allows(miss)).then_some(worst)
    }

    /// Returns the families found, cut by the joint limits.
    pub(super) fn families(&self) -> Vec<Family> {
        let joints = self.joints();
        let family = |found: &Found| {
            let Found { piece, distance, within } = found;
            let explorer = Explorer::new(&self.curve, *within);
            let between = |first: usize, part: f64| Some(self.configuration(&explorer.between(piece, first, part)?));
            let mut moving: Vec<usize> =
                (0..7).filter(|k| piece.moving[*k]).filter_map(|k| self.movers[k].joint()).collect();
            moving.sort_unstable();
            let points = piece.trace.points.iter().map(|point| self.configuration(point)).collect();
            let shape = Shape {
                dimension: piece.dimension,
                moving,
                distance: *distance,
                points,
                is_closed: piece.trace.is_closed,
            };
            joints.families(&shape, &between)
        };
        // Families that reach the pose exactly come first.
        let (exact, near): (Vec<&Found>, Vec<&Found>) = self.found.iter().partition(|found| found.distance == 0.0);
        exact.into_iter().chain(near).flat_map(family).collect()
    }

    /// All joints of the arm at a point.
    fn configuration(&self, point: &Point) -> Vec<f64> {
        let mut q = vec![0.0; self.of.forward.variables().len()];
        for (joint, value) in &self.of.held {
            q[*joint] = value.value();
        }
        for (k, mover) in self.movers.iter().enumerate() {
            if let Some(joint) = mover.joint() {
                q[joint] = point[k] * self.curve.unit(k);
            }
        }
        q
    }
}
