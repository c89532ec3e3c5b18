//! Self-motions as answers: sets of solutions of dimension 1 and more.

use super::single_loop::within_limits;
use super::turns::Turns;
use crate::assembly::wrapped;
use crate::kinematics::closed_loop::Variable;
use crate::solve::walk::LONGEST;
use num_complex::Complex;
use std::f64::consts::TAU;

/// Solutions that form a curve or more.
#[derive(Clone, Debug, PartialEq)]
pub struct Family {
    /// Its dimension, at least 1.
    pub dimension: usize,
    /// The joint variables that move along it, counted from 0 in joint order; empty where they are not known.
    pub moving: Vec<usize>,
    /// Its largest distance from the requested pose; 0 where it reaches the pose exactly.
    pub distance: f64,
    /// A whole configuration of it, within the limits if it has one there; of a platform the quaternion `w, x, y, z` and
    /// the position `x, y, z`.
    pub sample: Vec<f64>,
    /// Further configurations of the family. Those of a curve are in their order along it, and the last one repeats the first
    /// where the curve closes. Where limits cut a curve, each part within them is a family.
    pub samples: Vec<Vec<f64>>,
}

/// Limits are met within rounding.
const ROUNDING: f64 = 1e-9;

/// Solutions that form a curve or more, by their joint variables in joint order.
#[derive(Clone, Debug)]
pub struct Shape {
    /// The dimension, at least 1.
    pub dimension: usize,
    /// The joint variables that move, counted from 0.
    pub moving: Vec<usize>,
    /// Its largest distance from the requested pose.
    pub distance: f64,
    /// Configurations: of a curve in their order along it, angles running on without jumps; else one, or some of a surface.
    pub points: Vec<Vec<f64>>,
    /// Whether the last configuration of a curve is the first one again.
    pub is_closed: bool,
}

/// The joint variables of a mechanism with their limits.
#[derive(Clone, Copy, Debug)]
pub struct Joints<'a> {
    /// The kind of each of them.
    pub variables: &'a [Variable],
    /// Their limits; none where there are none.
    pub limits: &'a [[f64; 2]],
}

impl Joints<'_> {
    /// Returns the solutions as an answer: one family, or one for each part of a curve that the joint limits leave. `between`
    /// returns the configuration at a part of the way from one point of a curve, by number, to the next one.
    #[must_use]
    pub fn families(&self, shape: &Shape, between: &dyn Fn(usize, f64) -> Option<Vec<f64>>) -> Vec<Family> {
        let (at, all) = self.looked_at(shape, between);
        let family = |samples: Vec<Vec<f64>>| {
            let sample = self.best(&samples)?;
            let samples = if samples.len() > 1 && shape.dimension == 1 { samples } else { Vec::new() };
            let (dimension, moving, distance) = (shape.dimension, shape.moving.clone(), shape.distance);
            Some(Family { dimension, moving, distance, sample, samples })
        };
        let inside: Vec<bool> = all.iter().map(|q| self.is_inside(q)).collect();
        let is_whole = self.limits.is_empty() || inside.iter().all(|x| *x) || !inside.contains(&true);
        if is_whole || shape.dimension > 1 {
            return family(all).into_iter().collect();
        }
        let parts = parts(&inside, shape.is_closed);
        let crossing = |outer: usize, inner: usize| {
            let first = at[inner].0.min(at[outer].0);
            let [from, to] = [at[inner], at[outer]].map(|(number, part)| (number - first) as f64 + part);
            self.crossing(|part| between(first, from + part * (to - from)))
        };
        let last = all.len() - 1;
        let step = |k: usize, by: usize| if shape.is_closed { (k + by) % last } else { k + by };
        let cut = |&(from, count): &(usize, usize)| {
            let before = if shape.is_closed { Some((from + last - 1) % last) } else { from.checked_sub(1) };
            let end = step(from, count - 1);
            let behind = Some(step(end, 1)).filter(|k| *k <= last);
            let border = |outer: usize, inner: usize| {
                let (outer, inner) = neighbours(outer, inner, last, shape.is_closed);
                crossing(outer, inner)
            };
            let enter = before.and_then(|outer| border(outer, from));
            let leave = behind.and_then(|outer| border(outer, end));
            let within = (0..count).map(|by| all[step(from, by)].clone());
            family(enter.into_iter().chain(within).chain(leave).collect())
        };
        parts.iter().filter_map(cut).collect()
    }

    /// The points of a shape, each with a number and a part of the way to the next one. Between two points outside the limits the
    /// point that comes within them is looked for: a part of a curve within the limits may be shorter than a step, or a corner of
    /// them alone.
    fn looked_at(
        &self,
        shape: &Shape,
        between: &dyn Fn(usize, f64) -> Option<Vec<f64>>,
    ) -> (Vec<(usize, f64)>, Vec<Vec<f64>>) {
        /// Steps of the search: each leaves two thirds of the chord.
        const THIRDS: usize = 60;
        let placed: Vec<Vec<f64>> = shape.points.iter().map(|q| self.placed(q.clone())).collect();
        let outside: Vec<f64> = placed.iter().map(|q| self.outside(q)).collect();
        let (mut at, mut all) = (Vec::new(), Vec::new());
        for (k, q) in placed.into_iter().enumerate() {
            at.push((k, 0.0));
            all.push(q);
            let ends = outside.get(k + 1).map(|next| [outside[k], *next]);
            // A joint goes no farther than a step.
            let way =
                |next: &Vec<f64>| next.iter().zip(&shape.points[k]).map(|(x, y)| (x - y).abs()).fold(LONGEST, f64::max);
            let longest = shape.points.get(k + 1).map_or(LONGEST, way);
            let Some([one, other]) = ends.filter(|ends| ends.iter().all(|x| *x > 0.0 && *x < longest)) else {
                continue;
            };
            if one + other > longest || shape.dimension > 1 {
                continue;
            }
            let value = |part: f64| between(k, part).map_or(f64::INFINITY, |q| self.outside(&q));
            let (mut low, mut high) = (0.0_f64, 1.0_f64);
            for _ in 0..THIRDS {
                let [one, other] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
                if value(one) < value(other) { high = other } else { low = one }
            }
            let part = f64::midpoint(low, high);
            if let Some(q) = between(k, part).map(|q| self.placed(q)).filter(|q| self.is_inside(q)) {
                at.push((k, part));
                all.push(q);
            }
        }
        (at, all)
    }

    /// Returns the distance of a configuration from the limits; 0 within them.
    fn outside(&self, q: &[f64]) -> f64 {
        let own =
            q.iter().zip(self.variables).zip(self.limits).map(|((value, variable), [low, high])| match variable {
                Variable::Translation => (low - value).max(value - high),
                Variable::Rotation => {
                    // Infinite limits have no turns.
                    let above = if low.is_finite() { value + TAU * ((low - value) / TAU).ceil() } else { *value };
                    (above - high).min(low - (above - TAU))
                }
            });
        own.fold(0.0, f64::max)
    }

    /// The last configuration within the limits on the way out of them, by bisection; `at` runs from 0 inside to 1 outside.
    fn crossing(&self, at: impl Fn(f64) -> Option<Vec<f64>>) -> Option<Vec<f64>> {
        let (mut inside, mut outside) = (0.0, 1.0);
        let mut found = None;
        for _ in 0..40 {
            let middle = f64::midpoint(inside, outside);
            let q = self.placed(at(middle)?);
            if self.is_inside(&q) {
                (inside, found) = (middle, Some(q));
            } else {
                outside = middle;
            }
        }
        found
    }

    /// A configuration with its angles in (-pi, pi], or within the limits where whole turns lead there.
    pub(super) fn placed(&self, mut q: Vec<f64>) -> Vec<f64> {
        for (value, variable) in q.iter_mut().zip(self.variables) {
            if *variable == Variable::Rotation {
                *value = wrapped(*value);
            }
        }
        if self.is_inside(&q) {
            Turns::new(self.variables, self.limits).place(&mut q, ROUNDING);
        }
        q
    }

    /// Whether a configuration is within the limits, to rounding.
    #[must_use]
    pub fn is_inside(&self, q: &[f64]) -> bool {
        let wide: Vec<[f64; 2]> = self.limits.iter().map(|[low, high]| [low - ROUNDING, high + ROUNDING]).collect();
        let q: Vec<Complex<f64>> = q.iter().copied().map(Complex::from).collect();
        within_limits(&q, self.variables, &wide)
    }

    /// The configuration farthest from the limits, in parts of their width; the first one where there are none.
    fn best(&self, samples: &[Vec<f64>]) -> Option<Vec<f64>> {
        let margin = |q: &Vec<f64>| {
            let own = q.iter().zip(self.variables).zip(self.limits);
            own.map(|((value, variable), [low, high])| {
                let width = if *variable == Variable::Rotation { (high - low).min(TAU) } else { high - low };
                (value - low).min(high - value) / width.max(f64::MIN_POSITIVE)
            })
            .fold(f64::INFINITY, f64::min)
        };
        let first = samples.first()?;
        let best = samples.iter().skip(1).fold((first, margin(first)), |best, q| {
            let own = margin(q);
            if own > best.1 { (q, own) } else { best }
        });
        Some(best.0.clone())
    }
}

/// Numbers of two points of a curve that are neighbours: of a closed one, the last point is the first one.
fn neighbours(outer: usize, inner: usize, last: usize, is_closed: bool) -> (usize, usize) {
    match (outer, inner) {
        (0, k) if is_closed && k + 1 == last => (last, k),
        (k, 0) if is_closed && k + 1 == last => (k, last),
        pair => pair,
    }
}

/// Returns the longest runs of neighbouring points inside, each by its first point and its length. In a closed curve, whose last
/// point is its first one, runs continue over its end.
fn parts(inside: &[bool], is_closed: bool) -> Vec<(usize, usize)> {
    let count = if is_closed { inside.len() - 1 } else { inside.len() };
    let before = |k: usize| if is_closed { inside[(k + count - 1) % count] } else { k > 0 && inside[k - 1] };
    let begins = (0..count).filter(|&k| inside[k] && !before(k));
    let length = |from: usize| {
        let at =
            |by: usize| if is_closed { inside[(from + by) % count] } else { from + by < count && inside[from + by] };
        (0..count).take_while(|by| at(*by)).count()
    };
    begins.map(|from| (from, length(from))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_inside_run_on_over_the_end_of_a_closed_curve() {
        assert_eq!(parts(&[true, true, false, true, false], false), [(0, 2), (3, 1)]);
        assert_eq!(parts(&[true, false, false, true, true], true), [(3, 2)]);
        assert_eq!(parts(&[false, true, true, false, false], true), [(1, 2)]);
    }

    #[test]
    fn a_corner_of_the_limits_that_a_curve_touches_is_found() {
        // Two joints run in opposite directions and meet their upper limits at one configuration, between two points.
        let corner = 0.437;
        let at = |k: f64| vec![0.1 * k, 2.0 * corner - 0.1 * k, 0.0, 0.0, 0.0, 0.0];
        let mut limits = [[-1.0, 1.0]; 6];
        (limits[0][1], limits[1][1]) = (corner, corner);
        let points = (-9..=15).map(|k| at(f64::from(k))).collect();
        let shape = Shape { dimension: 1, moving: vec![0, 1], distance: 0.0, points, is_closed: false };
        let joints = Joints { variables: &[Variable::Rotation; 6], limits: &limits };
        let families = joints.families(&shape, &|first, part| Some(at(first as f64 + part - 9.0)));
        assert_eq!(families.len(), 1, "{families:?}");
        assert!(families[0].sample[..2].iter().all(|q| (q - corner).abs() < 1e-8), "{families:?}");
    }

    #[test]
    fn a_curve_is_cut_where_it_meets_a_limit() {
        let (variables, limits) = ([Variable::Rotation; 6], [[-1.0, 2.0]; 6]);
        // The first unknown turns once, the second one against it.
        let at = |k: f64| vec![k * TAU / 8.0, -k * TAU / 8.0, 0.0, 0.0, 0.0, 0.0];
        let points = (0..=8).map(|k| at(f64::from(k))).collect();
        let shape = Shape { dimension: 1, moving: vec![0, 1], distance: 0.0, points, is_closed: true };
        let joints = Joints { variables: &variables, limits: &limits };
        let between = |first: usize, part: f64| Some(at(first as f64 + part));
        let families = joints.families(&shape, &between);
        assert_eq!(families.len(), 1, "{families:?}");
        let ends = [families[0].samples.first(), families[0].samples.last()].map(|q| q.map(|q| q[0]));
        assert!((ends[0].unwrap_or(9.0) + 1.0).abs() < 1e-6 && (ends[1].unwrap_or(9.0) - 1.0).abs() < 1e-6, "{ends:?}");
        let none = Joints { limits: &[], ..joints };
        assert_eq!(none.families(&shape, &between)[0].samples.len(), 9);
    }
}
