//! One branch followed along its curve from one input to another, round limit positions where there are any.

use crate::kinematics::closed_loop::Variable;
use crate::mechanism::InputCurve;
use crate::solve::curve::{ALONG_INPUT, INPUT, Point};
use crate::solve::walk::{LONGEST, Place, along, difference, dot, norm, step};

/// The most steps between two inputs.
const MOST_STEPS: usize = 2000;
/// Translations beyond this, in scaled lengths, are on their way to infinity.
const FAR: f64 = 1e5;
/// Translations beyond this are where the way cannot be followed any longer and they grow as beside a pole.
const LARGE: f64 = 1e3;
/// Largest difference, as a part of the way to a pole, of two estimates of the same pole.
const SAME_POLE: f64 = 0.05;

/// A limit position as it is met on the way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fold {
    /// The place.
    pub point: Point,
    /// Whether the input is largest there, else smallest.
    pub is_largest: bool,
}

/// The destination of a branch.
#[derive(Clone, Debug)]
pub(super) enum Destination {
    /// To a point at the input it was followed to.
    Reached(Point),
    /// Back to a point at the input where it began.
    Returned(Point),
    /// To infinity near this input.
    Infinite(f64),
    /// Unknown: the branch could not be followed.
    Lost,
}

/// A branch followed.
#[derive(Clone, Debug)]
pub(super) struct Track {
    /// The destination.
    pub destination: Destination,
    /// The limit positions on the way.
    pub folds: Vec<Fold>,
}

/// The end of a way, if it is met.
type Reached = Result<Option<Destination>, Untraceable>;

/// Follows the branch of a point at input `point[INPUT]` to the input `target`, both in the unit of the curve.
pub(super) fn follow(curve: &InputCurve, point: &Point, target: f64) -> Track {
    let mut track = Track { destination: Destination::Lost, folds: Vec::new() };
    let walk = Walk { curve, begin: point[INPUT], target };
    if let Some(destination) = walk.run(point, &mut track.folds) {
        track.destination = destination;
    }
    track
}

/// The way between two inputs.
struct Walk<'a> {
    curve: &'a InputCurve,
    begin: f64,
    target: f64,
}

impl Walk<'_> {
    /// Walks on until the way ends; `None` where it cannot be followed.
    fn run(&self, start: &Point, folds: &mut Vec<Fold>) -> Option<Destination> {
        let mut towards = ALONG_INPUT;
        towards[INPUT] = (self.target - self.begin).signum();
        let mut here = Place { point: *start, direction: self.curve.tangent(start, &towards)? };
        let mut longest = LONGEST;
        let mut first: Option<Place> = None;
        for _ in 0..MOST_STEPS {
            if first.is_none() && self.largest(&here).1 > LARGE {
                first = Some(here);
            }
            let far = here.point[..INPUT]
                .iter()
                .zip(self.curve.kinds())
                .any(|(x, variable)| *variable == Variable::Translation && x.abs() > FAR);
            if far {
                return Some(Destination::Infinite(here.point[INPUT]));
            }
            let reach = norm(&here.point).max(4.0) / 4.0;
            let Some((next, h)) = step(self.curve, &here, longest.min(LONGEST * reach)) else {
                return self.pole(&first?, &here);
            };
            match self.events(&here, &next, h, folds) {
                Ok(Some(end)) => return Some(end),
                Ok(None) => {}
                Err(Untraceable) => return self.pole(&first?, &here),
            }
            here = next;
            longest = 2.0 * h;
        }
        None
    }

    /// The translation that is largest, and its size.
    fn largest(&self, place: &Place) -> (usize, f64) {
        let translations = (0..INPUT).filter(|&k| self.curve.kinds()[k] == Variable::Translation);
        let sizes = translations.map(|k| (k, place.point[k].abs()));
        sizes.fold((0, 0.0), |best, other| if other.1 > best.1 { other } else { best })
    }

    /// Returns the pole of a translation on the way, if two places agree on it or one is far out. There the closure in floating
    /// point no longer determines the way, but beside a pole y = c/(x - x0) it is known: x0 = x + y/y'.
    fn pole(&self, first: &Place, last: &Place) -> Option<Destination> {
        let (k, size) = self.largest(last);
        let pole = |place: &Place| place.point[INPUT] + place.point[k] * place.direction[INPUT] / place.direction[k];
        let (one, two) = (pole(first), pole(last));
        let is_same = (one - two).abs() <= SAME_POLE * (one - first.point[INPUT]).abs();
        let is_far = size > 10.0 * LARGE || size > 2.0 * first.point[k].abs();
        let is_ahead = (two - last.point[INPUT]) * last.direction[INPUT] > 0.0;
        let is_inside = (two - self.begin) * (two - self.target) <= 0.0;
        (is_same && is_far && is_ahead && is_inside).then_some(Destination::Infinite(two))
    }

    /// Returns the event between two neighbouring places: a limit position, or the end of the way.
    fn events(&self, here: &Place, next: &Place, h: f64, folds: &mut Vec<Fold>) -> Reached {
        let (before, after) = (here.direction[INPUT], next.direction[INPUT]);
        if before * after > 0.0 {
            return self.landing(&here.point, &next.point, Bend::None);
        }
        let fold = self.fold(here, next, h).ok_or(Untraceable)?;
        if let Some(end) = self.landing(&here.point, &fold, Bend::AtEnd)? {
            return Ok(Some(end));
        }
        folds.push(Fold { point: fold, is_largest: before > 0.0 });
        self.landing(&fold, &next.point, Bend::AtBegin)
    }

    /// The limit position between two places: where the input, as a function of the way along the first direction, has
    /// slope 0. Newton's method on its second derivative, held between the two places.
    fn fold(&self, here: &Place, next: &Place, h: f64) -> Option<Point> {
        let border = here.direction;
        let slope_of = |point: &Point| {
            let [_, slope, bend] = self.curve.taylor::<3>(point, &border)?;
            Some((slope, bend))
        };
        let (mut low, mut high) = (0.0, dot(&difference(&next.point, &here.point), &border));
        let sign = here.direction[INPUT].signum();
        let mut point = here.point;
        let mut way = 0.0;
        // A quarter of the bits at worst by bisection, then quadratic.
        for _ in 0..60 {
            let (slope, bend) = slope_of(&point)?;
            if slope[INPUT] * sign > 0.0 {
                low = way;
            } else {
                high = way;
            }
            let newton = way - slope[INPUT] / (2.0 * bend[INPUT]);
            let aim = if newton >= low && newton <= high { newton } else { f64::midpoint(low, high) };
            if (aim - way).abs() < 1e-13 * h.max(1e-3) || high - low < 1e-15 {
                return Some(point);
            }
            let predicted = along(&point, &slope, &bend, aim - way);
            (point, _) = self.curve.corrected(&predicted, &border)?;
            way = aim;
        }
        Some(point)
    }

    /// Returns the point at which the curve between two neighbouring points, along which the input is monotone, meets an end of
    /// the way.
    fn landing(&self, from: &Point, to: &Point, bend: Bend) -> Reached {
        let inside = |x: f64| (x - self.begin) * (x - self.target) <= 0.0;
        let heading = (to[INPUT] - from[INPUT]) * (self.target - self.begin) > 0.0;
        let (end, reached) = if heading { (self.target, true) } else { (self.begin, false) };
        let passed = if heading {
            (to[INPUT] - self.target) * (self.target - self.begin) >= 0.0
        } else {
            (self.begin - to[INPUT]) * (self.target - self.begin) >= 0.0
        };
        // A limit position may lie beyond the end by rounding only where it is the beginning.
        if !passed || !(inside(from[INPUT]) || bend == Bend::AtBegin) {
            return Ok(None);
        }
        let span = to[INPUT] - from[INPUT];
        let part = if span == 0.0 { 0.0 } else { ((end - from[INPUT]) / span).clamp(0.0, 1.0) };
        let part = match bend {
            Bend::None => part,
            Bend::AtEnd => 1.0 - (1.0 - part).sqrt(),
            Bend::AtBegin => part.sqrt(),
        };
        let mut guess: Point = std::array::from_fn(|k| from[k] + part * (to[k] - from[k]));
        guess[INPUT] = end;
        let (point, _) = self.curve.corrected(&guess, &ALONG_INPUT).ok_or(Untraceable)?;
        let near = norm(&difference(&point, &guess)) <= 0.5 * norm(&difference(to, from)).max(1e-6);
        if !near {
            return Err(Untraceable);
        }
        Ok(Some(if reached { Destination::Reached(point) } else { Destination::Returned(point) }))
    }
}

/// The curve could not be followed.
struct Untraceable;

/// The end of a piece of the curve at which the input is stationary.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Bend {
    None,
    AtBegin,
    AtEnd,
}
