//! Path generation: the four-bars whose coupler curve runs through points. \[WamplerMorganSommese1992\]
//!
//! Nine general points have 1442 triples of cognates. All those of nine points stored with the program are carried to the points asked
//! for along paths; each is proved by Krawczyk's theorem, and that none is missing by a trace test with numbers drawn at run time.

mod answer;
mod certificate;
mod class;
mod curve;
mod homotopy;
mod start;
mod trace;
mod turns;

pub use answer::NAMES;
pub use turns::{moving, pivots};

use super::answer::{Answer, Family, Mode, by_numbers, undecided};
use crate::algebra::disc::Disc;
use crate::algebra::drawn;
use crate::algebra::sort;
use crate::catalogue::SynthesisFile;
use crate::solve::paths::{Family as _, arc};
use crate::verdict::{Code, Proof, Status, Verdict};
use certificate::{Certified, Data, are_distinct};
use class::distinct;
use homotopy::{FourBar, Moving, PLACES, Places};
use num_complex::Complex;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use rug::Rational;
use start::{GENERAL, start};
use trace::{Trace, trace};

/// Angles of the bends of the arcs on which points move; a path that is lost on one is found on another.
const BENDS: [f64; 5] = [0.8, -1.4, 2.0, -2.4, 1.3];
/// Maximum number of steps of a path: nine in ten take fewer than 300.
const MOST_STEPS: usize = 3000;
/// A trace is straight where its defect is below this part of the median of one four-bar.
const STRAIGHT: f64 = 1e-6;
/// Maximum number of pencils drawn for a trace. A few in a hundred come so near to the curve of some four-bar that rounding of that
/// one hides the straight line; each pencil more multiplies the chance that all do by that.
const PENCILS: u32 = 8;
/// The mean distance of the start's points from the first one: units of a problem are chosen to have about the same.
const SPREAD: f64 = 0.8;
/// Sets of points that are tried to show one four-bar through fewer points than nine.
const TRIES: u64 = 4;

/// Nine points in units in which their distance from the first is about 1.
struct Problem {
    origin: [Rational; 2],
    unit: Rational,
    data: Data,
}

impl Problem {
    /// The problem of nine points of which some differ.
    fn of(points: &[[Rational; 2]]) -> Option<Self> {
        let (origin, others) = points.split_first()?;
        let ways: Vec<[Rational; 2]> =
            others.iter().map(|p| [0, 1].map(|k| Rational::from(&p[k] - &origin[k]))).collect();
        // A power of two: the points keep their digits. First the size of the largest number, which may be none of f64.
        let bits =
            |q: &Rational| q.numer().significant_bits().cast_signed() - q.denom().significant_bits().cast_signed();
        let largest = Rational::from(1) << ways.iter().flatten().filter(|q| **q != 0).map(bits).max()?;
        let squares = ways.iter().flatten().map(|q| Rational::from(q / &largest).to_f64().powi(2)).sum::<f64>();
        #[expect(clippy::cast_possible_truncation, reason = "the root is between 1/8 and 4")]
        let exponent = ((squares / PLACES as f64).sqrt() / SPREAD).log2().round() as i32;
        let unit = largest << exponent;
        let ways: Vec<[Rational; 2]> = ways.into_iter().map(|way| way.map(|q| q / &unit)).collect();
        let data = Data::of(&ways.try_into().ok()?);
        Some(Self { origin: origin.clone(), unit, data })
    }

    /// Follows paths from the start, on one arc after another until all four-bars of a general problem are found.
    fn followed(&self) -> (Vec<FourBar>, usize) {
        let start = start();
        let moving = Moving { start: &start.places, target: &self.data.places };
        let mut found: Vec<FourBar> = Vec::new();
        for (run, angle) in (1..).zip(BENDS) {
            let bend = Complex::from_polar(1.0, angle);
            let carry = |v: &FourBar| moving.follow(|s| arc(bend, s), v, 1.0, 0.0, MOST_STEPS);
            let ends: Vec<FourBar> = start.four_bars.par_iter().filter_map(carry).collect();
            found = distinct(found.into_iter().chain(ends));
            if found.len() >= GENERAL {
                return (found, run);
            }
        }
        (found, BENDS.len())
    }

    fn certified(&self, found: &[FourBar]) -> Vec<Certified> {
        let prove = |v: &FourBar| self.data.certificate(v).filter(|certified| certified.is_linkage(&self.data));
        found.par_iter().filter_map(prove).collect()
    }

    fn modes(&self, certified: &[Certified]) -> Vec<Mode> {
        let mut modes: Vec<Mode> =
            certified.par_iter().filter_map(|own| answer::mode(own, &self.origin, &self.unit)).collect();
        sort::by(&mut modes, |one, other| {
            other.is_real.cmp(&one.is_real).then_with(|| by_numbers(&one.dyad, &other.dyad))
        });
        modes
    }
}

/// The four-bars through these points, which are different and at most nine.
pub(super) fn synthesize(file: &SynthesisFile, points: &[[Rational; 2]]) -> Answer {
    if points.len() <= PLACES {
        return family(points);
    }
    let Some(problem) = Problem::of(points) else { return undecided() };
    let (found, runs) = problem.followed();
    let certified = problem.certified(&found);
    let classes: Option<Vec<_>> = certified.iter().map(|own| class::numbers(&own.discs, Disc::inverse)).collect();
    let modes = problem.modes(&certified);
    let is_list = classes.is_some_and(|classes| are_distinct(&classes)) && modes.len() == certified.len();
    let trace =
        if is_list && modes.len() == GENERAL { straightest(&problem.data.places, &found, drawn::seed()) } else { None };
    let mut verdict = judged(&modes, found.len(), is_list, trace);
    verdict.reason += &format!("; {runs} {}", if runs == 1 { "run of paths" } else { "runs of paths" });
    if !file.exact {
        verdict.reason += "; some numbers of the file are not rational and were rounded";
    }
    Answer { verdict, modes, ..undecided() }
}

/// Draws pencils until the trace along one is straight. Returns that trace with the number of pencils drawn; `None` if none is.
fn straightest(places: &Places, four_bars: &[FourBar], seed: u64) -> Option<(Trace, u32)> {
    (0..PENCILS).find_map(|k| {
        let trace = trace(places, four_bars, seed.wrapping_add(k.into()))?;
        (trace.defect < STRAIGHT * trace.median).then_some((trace, k + 1))
    })
}

fn judged(modes: &[Mode], found: usize, is_list: bool, straight: Option<(Trace, u32)>) -> Verdict {
    let real = modes.iter().filter(|mode| mode.is_real).count();
    let verdict = Verdict { complex: modes.len(), real, certified: modes.len(), ..undecided().verdict };
    if let Some((Trace { defect, median }, pencils)) = straight {
        // The chance that a missing one differs from a straight line by no more than the defect, along any of the pencils.
        let error = f64::from(pencils) * (defect / median).powi(2).max(f64::EPSILON * f64::EPSILON);
        return Verdict {
            status: if real > 0 { Status::Complete } else { Status::Unreachable },
            proof: Proof::Probable { error, seed: drawn::seed() },
            code: Code::CountMet,
            complex_complete: true,
            reason: format!(
                "{GENERAL} different certified triples of cognates, as many as through nine general points; their trace along a pencil drawn \
                 at run time is straight to {:.0e} of one",
                defect / median
            ),
            ..verdict
        };
    }
    let (code, reason) = if !is_list {
        (Code::NotDistinct, "not all triples are proved to be different".to_owned())
    } else if modes.len() < GENERAL {
        let doubtful = found.saturating_sub(modes.len());
        let reason = format!(
            "{} certified triples of cognates of the {GENERAL} through nine general points; the others are at infinity, multiple or no \
             linkages, or were lost; {doubtful} ends of paths have no certificate",
            modes.len()
        );
        (Code::TooFew, reason)
    } else {
        (Code::NotDecided, format!("the trace of the triples is straight along none of {PENCILS} pencils"))
    };
    Verdict { status: Status::Incomplete, code, reason, ..verdict }
}

/// Fewer than nine points: a family, with one member that runs through further points.
fn family(points: &[[Rational; 2]]) -> Answer {
    let dimension = PLACES + 1 - points.len();
    let sample = (0..TRIES).find_map(|number| {
        let mut nine = points.to_vec();
        nine.extend(further(points, dimension, number));
        let problem = Problem::of(&nine)?;
        let (found, _) = problem.followed();
        let real = problem.certified(&found).into_iter().filter(|own| own.is_real).collect::<Vec<_>>();
        problem.modes(&real).into_iter().map(|mode| mode.dyad).next()
    });
    let certified = usize::from(sample.is_some());
    let reason = format!(
        "nine points leave finitely many four-bars, and every point fewer one freedom more: a family of dimension {dimension}, complex \
         members counted; at the member shown the conditions are proved to be independent"
    );
    let verdict = Verdict {
        status: Status::SelfMotion,
        code: Code::SelfMotion,
        self_motion: dimension,
        certified,
        reason,
        ..undecided().verdict
    };
    Answer { verdict, families: vec![Family { dimension, sample }], ..undecided() }
}

/// Further points, drawn with few digits from the square about the points.
fn further(points: &[[Rational; 2]], count: usize, number: u64) -> Vec<[Rational; 2]> {
    let mut random = ChaCha8Rng::seed_from_u64(number);
    let range = |k: usize| {
        let values = points.iter().map(|p| p[k].to_f64());
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
    };
    let [x, y] = [range(0), range(1)];
    let half = 0.5 * (x.1 - x.0).max(y.1 - y.0);
    let mut coordinate = |(low, high): (f64, f64)| {
        let value = 0.5 * (low + high) + half * random.random_range(-1.0..1.0);
        Rational::from_f64(value).unwrap_or_default()
    };
    (0..count).map(|_| [coordinate(x), coordinate(y)]).collect()
}
