//! Feet of common normals, between which links are drawn.

use super::Point;
use crate::kinematics::motion::{Motion, cross, dot};

/// Axes whose sine is smaller count as parallel: their common normal says nothing about where the link is.
const PARALLEL: f64 = 1e-4;
/// Feet farther away than this many times the size of the mechanism are not used: nearly parallel axes have them.
const FAR: f64 = 2.0;

/// The place at which a joint acts.
#[derive(Clone, Copy, Debug)]
pub(super) enum Seat {
    /// About or along a line: a point of it and its direction.
    Line(Point, Point),
    /// About a point.
    Centre(Point),
}

impl Seat {
    /// The z axis of a frame, or its origin.
    pub(super) fn of(frame: &Motion<f64>, has_one_axis: bool) -> Self {
        let origin = frame.translation;
        if has_one_axis { Self::Line(origin, axis(frame)) } else { Self::Centre(origin) }
    }

    /// The point of it nearest to a point.
    pub(super) fn nearest(&self, p: &Point) -> Point {
        match self {
            Self::Centre(centre) => *centre,
            Self::Line(origin, direction) => {
                let along = dot(&minus(p, origin), direction);
                std::array::from_fn(|k| origin[k] + along * direction[k])
            }
        }
    }
}

/// The direction of the z axis of a frame.
pub(super) fn axis(frame: &Motion<f64>) -> Point {
    [frame.rotation[0][2], frame.rotation[1][2], frame.rotation[2][2]]
}

/// `a - b`
pub(super) fn minus(a: &Point, b: &Point) -> Point {
    std::array::from_fn(|k| a[k] - b[k])
}

/// The distance of two points.
pub(super) fn distance(a: &Point, b: &Point) -> f64 {
    let d = minus(a, b);
    dot(&d, &d).sqrt()
}

/// The feet of the common normal of two seats. Where there are many, or where they are far away, the point `keep` of the
/// first one has one of them.
pub(super) fn feet(one: &Seat, two: &Seat, keep: &Point, size: f64) -> [Point; 2] {
    let kept = |keep: &Point| {
        let first = one.nearest(keep);
        [first, two.nearest(&first)]
    };
    match (one, two) {
        (Seat::Line(_, _), Seat::Centre(centre)) => [one.nearest(centre), *centre],
        (Seat::Centre(centre), _) => [*centre, two.nearest(centre)],
        (Seat::Line(p, u), Seat::Line(q, v)) => {
            let normal = cross(u, v);
            let square = dot(&normal, &normal);
            if square < PARALLEL * PARALLEL {
                return kept(keep);
            }
            let between = minus(q, p);
            let s = dot(&cross(&between, v), &normal) / square;
            let t = dot(&cross(&between, u), &normal) / square;
            let found: [Point; 2] =
                [std::array::from_fn(|k| p[k] + s * u[k]), std::array::from_fn(|k| q[k] + t * v[k])];
            let far = distance(&found[0], keep).max(distance(&found[1], keep));
            if far > FAR * size { kept(keep) } else { found }
        }
    }
}
