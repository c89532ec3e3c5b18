//! The fate of every mode between two neighbouring inputs.

use super::sample::{Sample, Swept};
use super::track::{Destination, Fold, Track, follow};
use crate::algebra::sort;
use crate::assembly::{Assembly, Workspace, wrapped};
use crate::error::Result;
use crate::kinematics::closed_loop::Variable;
use crate::mechanism::InputCurve;
use crate::solve::curve::{INPUT, Point};
use std::f64::consts::PI;

/// Points nearer than this are one, in radians and scaled lengths over the longest of them.
const SAME: f64 = 1e-6;
/// Number of times that a step is halved whose branches do not match.
const HALVINGS: usize = 8;

/// The fate of a mode on one side.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Fate {
    /// To a mode of the neighbouring input; limit positions passed on the way.
    On(usize, Vec<usize>),
    /// To a limit position, and from there back to another mode of the same input.
    Back(usize, Vec<usize>),
    /// To infinity near this input; limit positions passed on the way.
    Infinite(f64, Vec<usize>),
    /// Nowhere: it is an isolated position of a loop that does not move there.
    Still,
    /// Unknown.
    Lost,
}

/// The fates of the modes of two neighbouring inputs between them.
#[derive(Clone, Debug)]
pub(super) struct Bridge {
    /// The fates of the modes at the lower index, forwards.
    pub forwards: Vec<Fate>,
    /// The fates of the modes at the higher index, backwards.
    pub backwards: Vec<Fate>,
    /// The limit positions.
    pub folds: Vec<Fold>,
}

impl Bridge {
    fn is_settled(&self) -> bool {
        !self.forwards.iter().chain(&self.backwards).any(|fate| *fate == Fate::Lost)
    }

    /// Whether the fate of every mode is unknown.
    fn is_blank(&self) -> bool {
        self.forwards.iter().chain(&self.backwards).all(|fate| *fate == Fate::Lost)
    }
}

/// The largest difference of two points, angles modulo 2 pi, over the size of the larger one; the input left out.
pub(super) fn apart(curve: &InputCurve, a: &Point, b: &Point) -> f64 {
    let plain = |a: &Point| {
        let mut largest = 0.0_f64;
        let mut size = 1.0_f64;
        for k in 0..INPUT {
            let difference = a[k] - b[k];
            largest = largest.max(match curve.kinds()[k] {
                Variable::Rotation => wrapped(difference).abs(),
                Variable::Translation => {
                    size = size.max(b[k].abs());
                    difference.abs()
                }
            });
        }
        largest / size
    };
    let Some(spherical) = curve.spherical() else { return plain(a) };
    // Other angles give the same orientation of a spherical joint.
    let mut other = *a;
    let index = |k: usize| (spherical + k) % INPUT;
    other[index(1)] = -other[index(1)];
    other[index(0)] += PI;
    other[index(2)] += PI;
    plain(a).min(plain(&other))
}

/// The mode of a sample that a point is.
pub(super) fn mode_at(curve: &InputCurve, sample: &Sample, point: &Point) -> Option<usize> {
    let distances = sample.points.iter().map(|mode| apart(curve, mode, point));
    let mut order: Vec<(usize, f64)> = distances.enumerate().collect();
    sort::by(&mut order, |a, b| a.1.total_cmp(&b.1));
    match order.as_slice() {
        [(mode, distance)] if *distance < SAME => Some(*mode),
        [(mode, distance), (_, second), ..] if *distance < SAME && *distance < 1e-2 * second => Some(*mode),
        _ => None,
    }
}

/// Follows every mode of two neighbouring inputs to its destination in between. A mode that cannot be followed is [`Fate::Lost`].
pub(super) fn bridge(curve: &InputCurve, low: &Sample, high: &Sample) -> Bridge {
    let mut folds: Vec<Fold> = Vec::new();
    let unit = curve.unit(INPUT);
    let mut fates = |own: &Sample, other: &Sample| -> Vec<Fate> {
        let one = |point: &Point| {
            if curve.is_rigid(point) {
                return Fate::Still;
            }
            let Track { destination, folds: passed } = follow(curve, point, other.input / unit);
            let numbers = passed.iter().map(|fold| {
                let known = folds.iter().position(|known| {
                    apart(curve, &known.point, &fold.point) < SAME
                        && (known.point[INPUT] - fold.point[INPUT]).abs() < 1e-8
                });
                known.unwrap_or_else(|| {
                    folds.push(*fold);
                    folds.len() - 1
                })
            });
            let numbers: Vec<usize> = numbers.collect();
            match destination {
                Destination::Reached(point) => {
                    mode_at(curve, other, &point).map_or(Fate::Lost, |mode| Fate::On(mode, numbers))
                }
                Destination::Returned(point) => {
                    mode_at(curve, own, &point).map_or(Fate::Lost, |mode| Fate::Back(mode, numbers))
                }
                Destination::Infinite(input) => Fate::Infinite(input * unit, numbers),
                Destination::Lost => Fate::Lost,
            }
        };
        own.points.iter().map(one).collect()
    };
    let (mut forwards, mut backwards) = (fates(low, high), fates(high, low));
    // A way must be the same in both directions, and every limit position turns it round.
    let agrees = |own: &[Fate], other: &[Fate], mode: usize| match &own[mode] {
        Fate::On(next, folds) => {
            folds.len() % 2 == 0
                && matches!(&other[*next], Fate::On(back, same) if *back == mode && same.len() == folds.len())
        }
        Fate::Back(next, folds) => {
            let same = matches!(&own[*next], Fate::Back(back, same) if *back == mode && same.len() == folds.len());
            folds.len() % 2 == 1 && *next != mode && same
        }
        Fate::Infinite(..) | Fate::Still => true,
        Fate::Lost => false,
    };
    let doubtful = |own: &[Fate], other: &[Fate]| -> Vec<usize> {
        (0..own.len()).filter(|mode| !agrees(own, other, *mode)).collect()
    };
    let (doubtful_low, doubtful_high) = (doubtful(&forwards, &backwards), doubtful(&backwards, &forwards));
    for mode in doubtful_low {
        forwards[mode] = Fate::Lost;
    }
    for mode in doubtful_high {
        backwards[mode] = Fate::Lost;
    }
    Bridge { forwards, backwards, folds }
}

/// The bridge between two samples, with further samples between them where branches do not add up.
pub(super) fn bridges(
    swept: &Swept<'_>,
    low: &Sample,
    high: &Sample,
    depth: usize,
    memory: &mut (Workspace, Assembly),
) -> Result<(Vec<Sample>, Vec<Bridge>)> {
    let direct = bridge(swept.curve, low, high);
    if direct.is_settled() || depth >= HALVINGS {
        return Ok((Vec::new(), vec![direct]));
    }
    // No round part of the step, where symmetric loops like to be singular.
    let part = 0.487;
    let middle = swept.sample(low.input + part * (high.input - low.input), memory)?;
    if !middle.is_regular {
        return Ok((Vec::new(), vec![direct]));
    }
    let (mut samples, mut found) = bridges(swept, low, &middle, depth + 1, memory)?;
    let (mut more_samples, mut more) = bridges(swept, &middle, high, depth + 1, memory)?;
    if let (Some(last), Some(next)) = (found.last_mut(), more.first_mut())
        && last.is_blank()
        && next.is_blank()
    {
        // A sample without any known fate on either side would only cut one unresolved step in two.
        last.backwards = std::mem::take(&mut next.backwards);
        more.remove(0);
    } else {
        samples.push(middle);
    }
    samples.append(&mut more_samples);
    found.append(&mut more);
    Ok((samples, found))
}
