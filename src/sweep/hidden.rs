//! Circuits that lie wholly between two neighbouring inputs, where no sample shows them.
//!
//! Such a circuit begins and ends in limit positions, and beyond them its two modes go on as a pair of conjugate complex
//! ones. The square of their distance from the real modes is an analytic function of the input that changes its sign in a
//! limit position. So wherever it is smallest, the loop is solved once more.

use super::bridge::apart;
use super::sample::{Pair, Sample, Swept};
use crate::algebra::sort;
use crate::assembly::{Assembly, Workspace};
use crate::error::Result;

/// Number of times that the search for a smallest distance is refined.
const LOOKS: usize = 10;
/// Part of the step to probe the direction of a pair that is met on one side only.
const PROBE: f64 = 0.1;

/// A pair of conjugate modes at some input.
#[derive(Clone, Copy)]
struct Seen {
    input: f64,
    pair: Pair,
}

/// Further samples between the sample at an index and the next one: those at which a pair has become real.
pub(super) fn between(
    swept: &Swept<'_>,
    samples: &[Sample],
    index: usize,
    memory: &mut (Workspace, Assembly),
) -> Result<Vec<Sample>> {
    let (low, high) = (&samples[index], &samples[index + 1]);
    let mut found: Vec<Sample> = Vec::new();
    for pair in &low.pairs {
        let here = Seen { input: low.input, pair: *pair };
        let Some(next) = nearest(swept, &here, high) else { continue };
        // The pair is followed outwards on both sides, so that a smallest distance at either end is recognised.
        let before = index.checked_sub(1).and_then(|k| nearest(swept, &here, &samples[k]));
        let after = samples.get(index + 2).and_then(|sample| nearest(swept, &next, sample));
        let (mut triples, mut seen): (Vec<[Seen; 3]>, Vec<Sample>) = (Vec::new(), Vec::new());
        for (outside, end, other) in [(before, here, next), (after, next, here)] {
            if end.pair.spread > other.pair.spread {
                continue;
            }
            match outside {
                Some(outside) if outside.pair.spread >= end.pair.spread => triples.push([outside, end, other]),
                Some(_) => {}
                None => match probed(swept, end, other, memory)? {
                    Probe::Real(sample) => seen.push(sample),
                    Probe::Nearer(triple) => triples.push(triple),
                    Probe::Farther => {}
                },
            }
        }
        for triple in triples {
            seen.extend(closer(swept, triple, memory)?);
        }
        for sample in seen {
            let inside = (sample.input - low.input) * (sample.input - high.input) < 0.0;
            let apart = |other: &Sample| (other.input - sample.input).abs() > 1e-9 * (high.input - low.input).abs();
            if inside && found.iter().all(apart) {
                found.push(sample);
            }
        }
    }
    let forward = high.input > low.input;
    sort::by(&mut found, |a, b| if forward { a.input.total_cmp(&b.input) } else { b.input.total_cmp(&a.input) });
    Ok(found)
}

/// The pair of a sample that another pair passes into.
fn nearest(swept: &Swept<'_>, seen: &Seen, sample: &Sample) -> Option<Seen> {
    let distance = |pair: &&Pair| {
        let across = (pair.spread.sqrt() - seen.pair.spread.sqrt()).abs();
        apart(swept.curve, &pair.centre, &seen.pair.centre) + across / (1.0 + seen.pair.spread.sqrt())
    };
    let pair = sample.pairs.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    Some(Seen { input: sample.input, pair: *pair })
}

/// The state of a pair at a probe from one input a little way towards another one.
enum Probe {
    /// It has become real.
    Real(Sample),
    /// It comes nearer to the real modes: the pair at three inputs, the middle one nearest.
    Nearer([Seen; 3]),
    /// It does not.
    Farther,
}

fn probed(swept: &Swept<'_>, end: Seen, other: Seen, memory: &mut (Workspace, Assembly)) -> Result<Probe> {
    let sample = swept.sample(end.input + PROBE * (other.input - end.input), memory)?;
    Ok(match followed(swept, &end, &sample, end.pair.spread.max(other.pair.spread)) {
        None if sample.is_regular => Probe::Real(sample),
        Some(middle) if middle.pair.spread < end.pair.spread => Probe::Nearer([end, middle, other]),
        _ => Probe::Farther,
    })
}

/// The pair of a sample that another pair passes into, no farther from the real modes than `farthest`: a pair that
/// became real is missing, and the nearest of the others is then another one, farther off.
fn followed(swept: &Swept<'_>, seen: &Seen, sample: &Sample, farthest: f64) -> Option<Seen> {
    nearest(swept, seen, sample).filter(|found| found.pair.spread <= farthest)
}

/// The sample at which the pair has become real, if there is one near its smallest distance from the real modes.
fn closer(
    swept: &Swept<'_>,
    [mut one, mut middle, mut two]: [Seen; 3],
    memory: &mut (Workspace, Assembly),
) -> Result<Option<Sample>> {
    for look in 0..LOOKS {
        let Some((input, least)) = vertex([one, middle, two]) else { return Ok(None) };
        let resolved = (input - middle.input).abs() < 1e-6 * (two.input - one.input).abs();
        if resolved || (look > 1 && least > 0.5 * middle.pair.spread) {
            return Ok(None);
        }
        let sample = swept.sample(input, memory)?;
        let farthest = one.pair.spread.max(two.pair.spread);
        let Some(seen) = followed(swept, &middle, &sample, farthest) else {
            return Ok(sample.is_regular.then_some(sample));
        };
        let outer_is_one = (input - one.input) * (input - middle.input) < 0.0;
        match (seen.pair.spread < middle.pair.spread, outer_is_one) {
            (true, true) => [middle, two] = [seen, middle],
            (true, false) => [one, middle] = [middle, seen],
            (false, true) => one = seen,
            (false, false) => two = seen,
        }
    }
    Ok(None)
}

/// Returns the place of the minimum of a parabola through three points, between the outer ones, and its value there.
fn vertex([one, middle, two]: [Seen; 3]) -> Option<(f64, f64)> {
    let (a, c) = (one.input - middle.input, two.input - middle.input);
    let (fa, fc) = (one.pair.spread - middle.pair.spread, two.pair.spread - middle.pair.spread);
    // f = u x^2 + v x
    let determinant = a * c * (a - c);
    let u = (fa * c - fc * a) / determinant;
    let v = (a * a * fc - c * c * fa) / determinant;
    let x = -v / (2.0 * u);
    let inside = u > 0.0 && u.is_finite() && (x - a) * (x - c) < 0.0;
    inside.then(|| (middle.input + x, middle.pair.spread + x * v / 2.0))
}
