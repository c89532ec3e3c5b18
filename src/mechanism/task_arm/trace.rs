//! The curves of configurations of an arm with one freedom more than its task has conditions.

use super::{Inner, TaskArm};
use crate::assembly::wrapped;
use crate::kinematics::chain::{Chain, Placement};
use crate::kinematics::closed_loop::{Layout, OpenLoop, Variable};
use crate::kinematics::screws::Behind;
use crate::mechanism::Family;
use crate::mechanism::single_loop::within_limits;
use crate::mechanism::turns::Turns;
use crate::solve::curve::{Curve, INPUT, Point};
use crate::solve::walk::{LONGEST, Place, difference, dot, norm, step};
use num_complex::Complex;
use std::f64::consts::TAU;

/// Steps along a curve at most: a straight turn of one joint takes 63 of them.
const MOST_STEPS: usize = 3000;
/// Steps shorter than this make no way: the curve ends where several meet.
const CRAWL: f64 = 1e-6;
/// Cosine between the directions in which a curve passes a point twice.
const SAME_WAY: f64 = 0.8;
/// A configuration so near to the chords of a curve lies on it: chords are 0.1 long, and bent by 0.2 over their length.
const SAG: f64 = 1e-2;
/// A joint that changes by less along a whole curve stands still.
const MOVED: f64 = 1e-6;
/// Limits are met within rounding.
const ROUNDING: f64 = 1e-9;
/// Halvings of a chord that meets a limit: to the last digit of a tenth.
const HALVINGS: usize = 50;

/// The loop of seven variables at a pose, and the order of its variables.
pub(super) struct Tracer<'a> {
    of: &'a TaskArm,
    curve: Curve,
    /// For every variable of a point the joint of the arm; none for virtual joints.
    joints: [Option<usize>; 7],
    found: Vec<Traced>,
}

/// A curve that was followed: its points in order.
struct Traced {
    points: Vec<Point>,
    is_closed: bool,
}

impl<'a> Tracer<'a> {
    /// The loop at a pose; `None` where a spherical joint stands in it, or it has not seven variables.
    pub(super) fn of(of: &'a TaskArm, pose: &Placement) -> Option<Self> {
        let mut behind = of.behind(pose);
        if behind.contains(&Behind::Ball) {
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
        let joints = std::array::from_fn(|k| {
            let own = if k == INPUT { Some(0) } else { order.get(k).copied().flatten() };
            own.and_then(|own| kept.get(own).copied())
        });
        let curve = Curve::new(&open, [false; 6], variables[0].variable);
        // Virtual joints have no value in a configuration of the arm: a curve through one is not known by it.
        let is_whole = joints.iter().all(Option::is_some);
        is_whole.then_some(Self { of, curve, joints, found: Vec::new() })
    }

    /// Follows the curve through a configuration, unless it is known.
    pub(super) fn follow(&mut self, q: &[f64]) {
        let start: Point = std::array::from_fn(|k| self.joints[k].map_or(0.0, |joint| q[joint]) / self.curve.unit(k));
        if self.found.iter().any(|known| self.holds(known, &start)) {
            return;
        }
        let Some(direction) = self.curve.tangent(&start, &[1.0; 7]) else { return };
        let first = Place { point: start, direction };
        let (mut points, is_closed) = self.run(first);
        if !is_closed {
            let back = Place { point: start, direction: direction.map(|x| -x) };
            let (mut other, _) = self.run(back);
            other.reverse();
            other.pop();
            other.append(&mut points);
            points = other;
        }
        self.found.push(Traced { points, is_closed });
    }

    /// The points from a place on, and whether the curve comes back to it.
    fn run(&self, start: Place) -> (Vec<Point>, bool) {
        let (mut here, mut points) = (start, vec![start.point]);
        for _ in 0..MOST_STEPS {
            let Some((next, length)) = step(&self.curve, &here, LONGEST) else { break };
            if length < CRAWL {
                break;
            }
            let chord = self.apart(&next.point, &here.point);
            let to_start = self.apart(&start.point, &here.point);
            // The start lies beside the chord just made, and is passed in the same direction.
            let part = dot(&chord, &to_start) / dot(&chord, &chord).max(f64::MIN_POSITIVE);
            let beside = norm(&std::array::from_fn(|k| to_start[k] - part * chord[k]));
            let is_back =
                (0.0..=1.0).contains(&part) && beside < SAG && dot(&next.direction, &start.direction) > SAME_WAY;
            if is_back && points.len() > 3 {
                points.push(std::array::from_fn(|k| here.point[k] + to_start[k]));
                return (points, true);
            }
            points.push(next.point);
            here = next;
        }
        (points, false)
    }

    /// The difference of two points, whole turns apart.
    fn apart(&self, one: &Point, other: &Point) -> Point {
        let off = difference(one, other);
        let variables = self.curve.variables();
        std::array::from_fn(|k| {
            if variables[k] == Variable::Rotation { off[k] - TAU * (off[k] / TAU).round() } else { off[k] }
        })
    }

    /// Whether a point lies on a curve.
    fn holds(&self, known: &Traced, point: &Point) -> bool {
        known.points.windows(2).any(|pair| {
            let (chord, to) = (difference(&pair[1], &pair[0]), self.apart(point, &pair[0]));
            let part = (dot(&chord, &to) / dot(&chord, &chord).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            norm(&std::array::from_fn(|k| to[k] - part * chord[k])) < SAG
        })
    }

    /// The curves as families, cut by the joint limits where they meet them.
    pub(super) fn families(&self) -> Vec<Family> {
        self.found.iter().flat_map(|traced| self.cut(traced)).collect()
    }

    fn cut(&self, traced: &Traced) -> Vec<Family> {
        let Traced { points, is_closed } = traced;
        let moving = self.moving(points);
        let family = |samples: Vec<Vec<f64>>| {
            let sample = samples.get(samples.len() / 2)?.clone();
            Some(Family { dimension: 1, moving: moving.clone(), distance: 0.0, sample, samples })
        };
        let inside: Vec<bool> = points.iter().map(|point| self.is_inside(&self.configuration(point))).collect();
        if !inside.contains(&true) || !inside.contains(&false) {
            return family(points.iter().map(|point| self.placed(point)).collect()).into_iter().collect();
        }
        // A closed curve is run through from a place outside the limits: no part of it is cut in two.
        let last = points.len() - 1;
        let start = if *is_closed { inside.iter().position(|is_in| !is_in).unwrap_or(0) } else { 0 };
        let at = |k: usize| if *is_closed { points[(start + k) % last] } else { points[k] };
        let is_in = |k: usize| if *is_closed { inside[(start + k) % last] } else { inside[k] };
        let (mut families, mut part): (Vec<Family>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
        for k in 0..=last {
            if is_in(k) {
                if part.is_empty() && k > 0 {
                    part.extend(self.border(&at(k), &at(k - 1)));
                }
                part.push(self.placed(&at(k)));
            } else if !part.is_empty() {
                part.extend(self.border(&at(k - 1), &at(k)));
                families.extend(family(std::mem::take(&mut part)));
            }
        }
        families.extend(family(part));
        families
    }

    /// The last configuration within the limits on the way from a point inside to one outside.
    fn border(&self, inside: &Point, outside: &Point) -> Option<Vec<f64>> {
        let chord = self.apart(outside, inside);
        let length = norm(&chord);
        let along = chord.map(|x| x / length);
        let (mut low, mut high, mut found) = (0.0, 1.0, None);
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            let start = std::array::from_fn(|k| inside[k] + middle * chord[k]);
            let (point, _) = self.curve.corrected(&start, &along)?;
            if self.is_inside(&self.configuration(&point)) {
                (low, found) = (middle, Some(self.placed(&point)));
            } else {
                high = middle;
            }
        }
        found
    }

    /// The joints that change along a curve.
    fn moving(&self, points: &[Point]) -> Vec<usize> {
        let changes = |k: usize| points.iter().any(|point| (point[k] - points[0][k]).abs() > MOVED);
        let mut moving: Vec<usize> = (0..7).filter(|k| changes(*k)).filter_map(|k| self.joints[k]).collect();
        moving.sort_unstable();
        moving
    }

    /// All joints of the arm at a point, angles in (-pi, pi].
    fn configuration(&self, point: &Point) -> Vec<f64> {
        let variables = self.of.forward.variables();
        let mut q = vec![0.0; variables.len()];
        for (joint, value) in &self.of.held {
            q[*joint] = value.value();
        }
        for (k, joint) in self.joints.iter().enumerate() {
            if let Some(joint) = joint {
                let value = point[k] * self.curve.unit(k);
                q[*joint] = if variables[*joint] == Variable::Rotation { wrapped(value) } else { value };
            }
        }
        q
    }

    /// The same, within the limits where whole turns lead there.
    fn placed(&self, point: &Point) -> Vec<f64> {
        let mut q = self.configuration(point);
        if self.is_inside(&q) {
            Turns::new(self.of.forward.variables(), &self.of.limits).place(&mut q, ROUNDING);
        }
        q
    }

    fn is_inside(&self, q: &[f64]) -> bool {
        let wide: Vec<[f64; 2]> = self.of.limits.iter().map(|[low, high]| [low - ROUNDING, high + ROUNDING]).collect();
        let q: Vec<Complex<f64>> = q.iter().copied().map(Complex::from).collect();
        within_limits(&q, self.of.forward.variables(), &wide)
    }
}
