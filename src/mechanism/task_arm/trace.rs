//! The families of configurations of an arm with one freedom more than its task has conditions.

use super::{Inner, TaskArm};
use crate::kinematics::chain::{Chain, Placement};
use crate::kinematics::closed_loop::{Layout, OpenLoop};
use crate::kinematics::screws::Behind;
use crate::kinematics::tolerance::{PoseError, Tolerance};
use crate::mechanism::Family;
use crate::mechanism::family::{Joints, Shape};
use crate::solve::curve::{CLOSES_WITHIN, Curve, INPUT, Point};
use crate::solve::explorer::{Explorer, Piece};

/// A miss below this part of the reach is the rounding of a curve that was followed in f64.
const ROUNDING: f64 = 1e-10;
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
    /// For every variable of a point the joint of the arm; none for virtual joints.
    joints: [Option<usize>; 7],
    found: Vec<Found>,
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
    /// The loop at a pose; `None` where a spherical joint stands in it, or it has not seven variables.
    pub(super) fn of(of: &'a TaskArm, pose: &'a Placement, tolerance: Tolerance) -> Option<Self> {
        let mut behind = of.behind(pose);
        if behind.contains(&Behind::Spherical) {
            return None;
        }
        behind.push(Behind::Constant(Box::new(pose.undone())));
        let chain: Chain = of.chain.in_screws(&of.held, &behind)?;
        let variables = chain.variables();
        if variables.len() != 7 {
            return None;
        }
        let layout = Layout::of(&chain, Some(0)).ok()?;
        let open: OpenLoop<f64> = chain.open_loop(&layout).ok()?;
        let kept = of.kept(&Inner { held: of.held.clone(), ..Inner::default() });
        let order = layout.joint_variables();
        let joints: [Option<usize>; 7] = std::array::from_fn(|k| {
            let own = if k == INPUT { Some(0) } else { order.get(k).copied().flatten() };
            own.and_then(|own| kept.get(own).copied())
        });
        // Virtual joints have no value in a configuration of the arm: a curve through one is not known by it.
        let is_whole = joints.iter().all(Option::is_some);
        let curve = Curve::new(&open, [false; 6], variables[0].variable);
        let turn = joints.iter().position(Option::is_some).unwrap_or(INPUT);
        let scale = (0..7).map(|k| curve.unit(k)).fold(curve.unit(turn), f64::max);
        let within = tolerance.angle.max(tolerance.length / scale).max(CLOSES_WITHIN);
        is_whole.then_some(Self { of, pose, curve, within, tolerance, joints, found: Vec::new() })
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

    fn point(&self, q: &[f64]) -> Point {
        std::array::from_fn(|k| self.joints[k].map_or(0.0, |joint| q[joint]) / self.curve.unit(k))
    }

    /// Follows the families through a point that closes the loop within a residual, unless they are known.
    fn follow_from(&mut self, start: &Point, within: f64) {
        let explorer = Explorer::new(&self.curve, within);
        let holds = |known: &Found| Explorer::new(&self.curve, known.within.max(within)).holds(&known.piece, start);
        if self.found.iter().any(holds) {
            return;
        }
        for piece in explorer.pieces(start) {
            let middle = piece.trace.points[piece.trace.points.len() / 2];
            let is_known =
                |known: &Found| known.piece.dimension >= piece.dimension && explorer.holds(&known.piece, &middle);
            let Some(distance) = self.distance(&piece).filter(|_| !self.found.iter().any(is_known)) else { continue };
            // A family contained in one of a larger dimension is dropped as a part of it.
            self.found.retain(|known| {
                let middle = &known.piece.trace.points[known.piece.trace.points.len() / 2];
                known.piece.dimension >= piece.dimension || !explorer.holds(&piece, middle)
            });
            self.found.push(Found { piece, distance, within });
        }
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
        let joints = Joints { variables: self.of.forward.variables(), limits: &self.of.limits };
        let family = |found: &Found| {
            let Found { piece, distance, within } = found;
            let explorer = Explorer::new(&self.curve, *within);
            let between = |first: usize, part: f64| Some(self.configuration(&explorer.between(piece, first, part)?));
            let mut moving: Vec<usize> = (0..7).filter(|k| piece.moving[*k]).filter_map(|k| self.joints[k]).collect();
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
        for (k, joint) in self.joints.iter().enumerate() {
            if let Some(joint) = joint {
                q[*joint] = point[k] * self.curve.unit(k);
            }
        }
        q
    }
}
