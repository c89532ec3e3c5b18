//! The inputs from which branches are followed: the steps, both sides of every critical input, and what is between where
//! steps are long.

use super::Range;
use super::sample::Sample;
use crate::algebra::sort;
use crate::kinematics::closed_loop::Variable;
use std::f64::consts::TAU;

/// Distance on both sides of a critical input at which branches are examined, in radians or parts of the range: near enough to
/// isolate two branches that meet there, far enough to separate them in floating point.
const REACH: f64 = 1e-5;
/// Critical inputs keep this part of the distance to the next one.
const PART: f64 = 0.25;
/// Inputs are no farther apart than this, in radians, where critical inputs are known: a chart has room for it.
const LONGEST: f64 = 0.5;
/// The least number of inputs for a full turn, or for any range of a distance, where critical inputs are not known.
const FEWEST: f64 = 360.0;
/// The least number of inputs of overconstrained loops, whose solutions are counted at every input, which takes long.
const FEWEST_OVERCONSTRAINED: f64 = 60.0;

/// A critical input and how far on both sides it is looked at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Critical {
    input: f64,
    reach: f64,
}

/// An input to look at.
#[derive(Clone, Debug)]
pub(super) enum Wanted {
    /// The sample of a step.
    Step(usize),
    /// Another input, and the step that it stands for.
    Beside(f64, Option<usize>),
}

impl Range {
    fn contains(&self, input: f64) -> bool {
        (input - self.from) * (input - self.to) <= 0.0
    }

    /// The inputs in the range that are these, but for full turns, each turn by itself; the end of the range left out.
    pub(super) fn having(&self, given: &[f64], variable: Variable) -> Vec<f64> {
        let is_inside = |input: &f64| self.contains(*input) && input.total_cmp(&self.to).is_ne();
        self.turned(given, variable).into_iter().filter(is_inside).collect()
    }

    /// Inputs of which one of every turn is given, from a turn before the range to a turn behind it.
    pub(super) fn turned(&self, given: &[f64], variable: Variable) -> Vec<f64> {
        let (low, high) = (self.from.min(self.to), self.from.max(self.to));
        let mut all: Vec<f64> = Vec::new();
        for input in given {
            match variable {
                Variable::Translation => all.push(*input),
                Variable::Rotation => {
                    let mut turned = input + TAU * ((low - TAU - input) / TAU).ceil();
                    while turned <= high + TAU {
                        all.push(turned);
                        turned += TAU;
                    }
                }
            }
        }
        all.sort_by(f64::total_cmp);
        all
    }

    /// The critical inputs in the range, of which one of every turn is given.
    pub(super) fn criticals(&self, given: &[f64], variable: Variable, is_full_turn: bool) -> Vec<Critical> {
        let (low, high) = (self.from.min(self.to), self.from.max(self.to));
        let unit = if variable == Variable::Rotation { 1.0 } else { high - low };
        // Beyond the range, too, so that all have neighbours.
        let all = self.turned(given, variable);
        let gap = |k: usize| if k + 1 < all.len() { all[k + 1] - all[k] } else { f64::INFINITY };
        let reach = |k: usize| {
            let neighbours = gap(k).min(if k > 0 { gap(k - 1) } else { f64::INFINITY });
            let ends = [low, high].map(|end| (all[k] - end).abs()).into_iter().filter(|d| *d > 0.0 && !is_full_turn);
            ends.fold((REACH * unit).min(PART * neighbours), |reach, d| reach.min(PART * d))
        };
        let criticals = (0..all.len()).map(|k| Critical { input: all[k], reach: reach(k) });
        criticals.filter(|critical| self.contains(critical.input)).collect()
    }

    /// The inputs to look at, in the order of the sweep; a step is left out where it is singular or too near to a critical
    /// input, and inputs on both sides stand for it.
    pub(super) fn wanted(&self, samples: &[Sample], criticals: Option<&[Critical]>, aside: f64) -> Vec<(f64, Wanted)> {
        let mut wanted: Vec<(f64, Wanted)> = Vec::new();
        let mut stood_for: Vec<Option<usize>> = vec![None; criticals.map_or(0, <[Critical]>::len)];
        for (step, sample) in samples.iter().enumerate() {
            let near = |critical: &Critical| (critical.input - sample.input).abs() < critical.reach;
            if let Some(k) = criticals.and_then(|list| list.iter().position(near)) {
                stood_for[k] = Some(step);
            } else if sample.is_regular {
                wanted.push((sample.input, Wanted::Step(step)));
            } else {
                let sides = [sample.input - aside, sample.input + aside];
                wanted.extend(sides.map(|input| (input, Wanted::Beside(input, Some(step)))));
            }
        }
        for (critical, step) in criticals.unwrap_or_default().iter().zip(stood_for) {
            let sides = [critical.input - critical.reach, critical.input + critical.reach];
            wanted.extend(sides.map(|input| (input, Wanted::Beside(input, step))));
        }
        wanted.retain(|(input, _)| self.contains(*input));
        let forward = self.to > self.from;
        sort::by(&mut wanted, |a, b| if forward { a.0.total_cmp(&b.0) } else { b.0.total_cmp(&a.0) });
        wanted
    }

    /// Inserts inputs between those that are too far apart.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
    pub(super) fn filled(
        &self,
        wanted: Vec<(f64, Wanted)>,
        variable: Variable,
        is_exact: bool,
        is_overconstrained: bool,
    ) -> Vec<(f64, Wanted)> {
        let span = (self.to - self.from).abs();
        let fewest = if is_overconstrained { FEWEST_OVERCONSTRAINED } else { FEWEST };
        let longest = match (is_exact, variable) {
            (true, Variable::Rotation) => LONGEST,
            (true, Variable::Translation) => span,
            (false, Variable::Rotation) => TAU / fewest,
            (false, Variable::Translation) => span / fewest,
        };
        let mut filled: Vec<(f64, Wanted)> = Vec::new();
        for (input, one) in wanted {
            if let Some(last) = filled.last().map(|(last, _)| *last) {
                // Rounding makes a step no longer than it is.
                let parts = ((input - last).abs() / longest - 1e-9).ceil().max(1.0);
                for k in 1..parts as usize {
                    let between = last + (input - last) * (k as f64 / parts);
                    filled.push((between, Wanted::Beside(between, None)));
                }
            }
            filled.push((input, one));
        }
        filled
    }
}
