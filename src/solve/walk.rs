//! One step along a curve: predicted by its Taylor coefficients, corrected back onto it, as long as the curve allows.

use super::curve::{Curve, Point};
use std::f64::consts::{PI, TAU};

/// The longest step, in radians or scaled lengths.
pub const LONGEST: f64 = 0.1;
/// The shortest step before following is given up.
const SHORTEST: f64 = 1e-8;
/// The correction of a predicted point over the length of the step above which the step is taken shorter.
const CORRECTION: f64 = 0.02;
/// The cosine between directions at both ends of a step below which it is taken shorter.
const TURN: f64 = 0.97;

/// Steps round a curve at most. Where it is straight, a curve takes 63 of them for a turn.
const MOST_STEPS: usize = 3000;
/// Steps shorter than this make no way: the curve ends in a point where several meet.
const CRAWL: f64 = 1e-6;
/// Cosine between the directions in which a curve passes a point twice.
const SAME_WAY: f64 = 0.8;
/// Chords of steps lie as near to their curve.
const SAG: f64 = 5e-3;
/// Steps over the way that distances have gone, once that is five times the scale of the loop: a slide without end is straight far away,
/// where short steps show nothing new.
const FAR_STEP: f64 = 0.02;
/// The way of a distance, in parts of the scale of the loop, after which a curve is not followed any more: it goes on without end,
/// or nobody builds it.
const FAR: f64 = 300.0;
/// Two ways to the same point of a curve differ by less.
const SAME: f64 = 1e-5;

/// A straight step that misses the start of its curve by less has come back to it: what is stretched is known to the root of what may be
/// missed.
const BESIDE: f64 = 3e-5;

/// A curve that can be followed.
pub trait Followed {
    /// The Taylor coefficients of the curve at a point of it, see [`Curve::taylor`].
    fn taylor(&self, at: &Point, border: &Point) -> Option<[Point; 3]>;
    /// The direction of the curve at a point of it, see [`Curve::tangent`].
    fn tangent(&self, at: &Point, towards: &Point) -> Option<Point>;
    /// The point of the curve with the same `border . q` as `start`, see [`Curve::corrected`].
    fn corrected(&self, start: &Point, border: &Point) -> Option<(Point, f64)>;
}

impl Followed for Curve {
    fn taylor(&self, at: &Point, border: &Point) -> Option<[Point; 3]> {
        Self::taylor(self, at, border)
    }
    fn tangent(&self, at: &Point, towards: &Point) -> Option<Point> {
        Self::tangent(self, at, towards)
    }
    fn corrected(&self, start: &Point, border: &Point) -> Option<(Point, f64)> {
        Self::corrected(self, start, border)
    }
}

/// A point of a curve and the direction in which it is run through.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The point.
    pub point: Point,
    /// The direction, of length 1.
    pub direction: Point,
}

/// The length of a vector.
#[must_use]
pub fn norm(v: &Point) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The scalar product of two vectors.
#[must_use]
pub fn dot(a: &Point, b: &Point) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// `a - b`
#[must_use]
pub fn difference(a: &Point, b: &Point) -> Point {
    std::array::from_fn(|k| a[k] - b[k])
}

/// The point `at + step h + bend h^2`.
#[must_use]
pub fn along(at: &Point, step: &Point, bend: &Point, h: f64) -> Point {
    std::array::from_fn(|k| at[k] + h * (step[k] + h * bend[k]))
}

/// One step along a curve, no longer than `longest`, and its length.
#[must_use]
pub fn step(curve: &impl Followed, here: &Place, longest: f64) -> Option<(Place, f64)> {
    let [_, slope, bend] = curve.taylor(&here.point, &here.direction)?;
    let curvature = norm(&bend);
    let mut h = if curvature * longest > 0.2 { 0.2 / curvature } else { longest };
    // The sag of a chord is a quarter of the bend times the square of the step: that of long steps is at most half of what is allowed.
    h = h.min((2.0 * SAG / curvature).sqrt().max(LONGEST));
    while h > SHORTEST {
        let predicted = along(&here.point, &slope, &bend, h);
        if let Some((point, correction)) = curve.corrected(&predicted, &here.direction)
            && correction < CORRECTION * h
            && let Some(direction) = curve.tangent(&point, &here.direction)
            && dot(&direction, &here.direction) > TURN
        {
            return Some((Place { point, direction }, h));
        }
        h /= 2.0;
    }
    None
}

/// `a - b`, those variables that turn modulo whole turns.
#[must_use]
pub fn apart(a: &Point, b: &Point, turns: &[bool; 7]) -> Point {
    std::array::from_fn(|k| {
        let difference = a[k] - b[k];
        if turns[k] { difference - TAU * ((difference + PI) / TAU).floor() } else { difference }
    })
}

/// A curve, followed as far as it goes.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Its points in their order along it, angles running on without jumps.
    pub points: Vec<Point>,
    /// Whether the last point is the first one again, whole turns apart.
    pub is_closed: bool,
}

impl Trace {
    /// Follows a curve from one of its points, both ways if it does not close. `turns` says which variables turn. `None`
    /// where no direction is known.
    #[must_use]
    pub fn through(curve: &impl Followed, point: &Point, turns: &[bool; 7]) -> Option<Self> {
        let direction = curve.tangent(point, &[1.0; 7])?;
        let ahead = Self::run(curve, Place { point: *point, direction }, turns);
        if ahead.is_closed {
            return Some(ahead);
        }
        let behind = Self::run(curve, Place { point: *point, direction: direction.map(|x| -x) }, turns);
        let points = behind.points.into_iter().rev().chain(ahead.points.into_iter().skip(1)).collect();
        Some(Self { points, is_closed: false })
    }

    /// Follows a curve until it closes or ends.
    fn run(curve: &impl Followed, start: Place, turns: &[bool; 7]) -> Self {
        let mut run = Self { points: vec![start.point], is_closed: false };
        let (mut here, mut longest) = (start, LONGEST);
        for _ in 0..MOST_STEPS {
            let Some((next, h)) = step(curve, &here, longest).filter(|(_, h)| *h > CRAWL) else { break };
            if run.points.len() > 2
                && let Some(end) = closing(curve, &start, &here, h, turns)
            {
                run.points.push(end);
                run.is_closed = true;
                break;
            }
            run.points.push(next.point);
            here = next;
            let way = (0..7).filter(|k| !turns[*k]).map(|k| (here.point[k] - start.point[k]).abs()).fold(0.0, f64::max);
            if way > FAR {
                break;
            }
            longest = (2.0 * h).min(LONGEST.max(FAR_STEP * way));
        }
        run
    }

    /// The length of all steps.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.points.windows(2).map(|pair| norm(&difference(&pair[1], &pair[0]))).sum()
    }

    /// Whether a point at which the loop closes lies on the curve.
    #[must_use]
    pub fn holds(&self, curve: &impl Followed, point: &Point, turns: &[bool; 7]) -> bool {
        self.points.windows(2).any(|pair| {
            let [from, to] = [&pair[0], &pair[1]];
            let chord = difference(to, from);
            let length = norm(&chord);
            let way = apart(point, from, turns);
            let part = dot(&way, &chord) / (length * length);
            let aside: Point = std::array::from_fn(|k| way[k] - part * chord[k]);
            if !((-0.1..=1.1).contains(&part) && norm(&aside) < SAG) {
                return false;
            }
            // The point of the curve itself beside the one at hand.
            let beside: Point = std::array::from_fn(|k| from[k] + part * chord[k]);
            let found = curve.corrected(&beside, &chord.map(|x| x / length));
            found.is_some_and(|(found, _)| norm(&apart(point, &found, turns)) < SAME)
        })
    }

    /// The point at a part of the way from one of the points, by number, to the next one.
    #[must_use]
    pub fn between(&self, curve: &impl Followed, first: usize, part: f64) -> Option<Point> {
        let (from, to) = (self.points.get(first)?, self.points.get(first + 1)?);
        let chord = difference(to, from);
        let length = norm(&chord);
        let start: Point = std::array::from_fn(|k| from[k] + part * chord[k]);
        Some(curve.corrected(&start, &chord.map(|x| x / length))?.0)
    }
}

/// The start of a curve, whole turns on, where the step of this length from here passes it.
fn closing(curve: &impl Followed, start: &Place, here: &Place, h: f64, turns: &[bool; 7]) -> Option<Point> {
    let gap = apart(&start.point, &here.point, turns);
    let way = dot(&gap, &here.direction);
    let is_near = way > 0.0 && way <= 1.01 * h && norm(&gap) < 1.1 * way + SAME;
    if !is_near || dot(&start.direction, &here.direction) < SAME_WAY {
        return None;
    }
    let end: Point = std::array::from_fn(|k| here.point[k] + gap[k]);
    // A curve along which the loop gives way in another direction too, as that of a wrist in line on a stretched arm, comes back as near
    // as rounding lets it, and no correction leads to its start.
    if norm(&along(&gap, &here.direction, &[0.0; 7], -way)) < BESIDE {
        return Some(end);
    }
    let [_, slope, bend] = curve.taylor(&here.point, &here.direction)?;
    let (point, _) = curve.corrected(&along(&here.point, &slope, &bend, way), &here.direction)?;
    (norm(&difference(&point, &end)) < SAME).then_some(end)
}
