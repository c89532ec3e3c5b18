//! The proof of a sweep by the closure polynomial: see docs/sweep.md.
//!
//! Let F(s, t) be the closure polynomial of an input s and an output t. Between real roots of its discriminant, real roots t are
//! analytic functions of s that never meet, so their number is constant and so is their order. In the loops treated here s and t
//! determine a configuration uniquely wherever F has a simple root and the translations are independent. So the exact real roots
//! at one rational input of each interval give the number of configurations in all of it, and show which passes into which. At
//! the critical inputs themselves each branch is proved to pass, or two of them meet in a limit position or go to infinity.

mod by_cut;
mod crossing;
mod four_joints;
mod moved;
mod node;
mod output;
mod plane_curve;
mod relation;
mod wrist;

pub(super) use crossing::Ends;
pub(super) use moved::Moved;
pub(super) use output::{Critical, Event, Output};
pub(super) use plane_curve::{PlaneCurve, sign_changes};

use super::bridge::{Bridge, mode_at};
use super::sample::Sample;
use super::track::{Destination, Fold, follow};
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::assembly::wrapped;
use crate::catalogue::entry::{Case, Entry};
use crate::derivation::Place;
use crate::kinematics::closed_loop::{Layout, Variable};
use crate::mechanism::{InputCurve, locked_variable};
use crate::solve::curve::INPUT;
use crate::verdict::Code;
use crossing::Piece;
use plane_curve::{Integral, S, T};
use rug::Rational;
use std::f64::consts::PI;
use std::sync::OnceLock;
use wrist::Wrist;

/// Angles of the input are counted from one of these half tangents, so that none critical is half a turn from there.
/// Any numbers serve that are unlikely to be special.
const OFFSETS: [(i32, i32); 3] = [(3, 7), (-5, 13), (17, 11)];
/// Loops of more unknown rotations have no closure polynomial here, unless three of them are those of a spherical joint.
const MOST_ROTATIONS: usize = 4;
/// The longest interval of the input that one chart is asked about, in radians: two charts overlap by more than this.
const LONGEST: f64 = 1.5;
/// The largest angle of a chart: short of half a turn, where its half tangent is infinite.
const WIDEST: f64 = 2.5;

/// The closure polynomials of a loop.
pub(super) struct Exact {
    /// Whether the input is an angle or a distance.
    pub input: Variable,
    /// The angle from which angles of the input are counted.
    offset: f64,
    /// The half tangent of that angle.
    pub from: Rational,
    /// The three axes that are taken for a spherical joint.
    wrist: Option<Wrist>,
    /// Outputs with their polynomials, computed when first asked for.
    outputs: Vec<(relation::Relation, OnceLock<Option<Output>>)>,
}

impl Exact {
    /// The closure polynomials of the loop of an entry, moved by the input of a case.
    pub fn of(entry: &Entry, case: &Case, input: Variable) -> Result<Self, Code> {
        Self::moving(entry, Moved { case, place: Place::Input, kind: input })
    }

    /// The closure polynomials of the loop of an entry in which something runs.
    pub fn moving(entry: &Entry, moved: Moved<'_>) -> Result<Self, Code> {
        // The frame of an axis that runs is in no ring of fractions here.
        let chain = entry.chain().filter(|_| !matches!(moved.place, Place::AxisPoint(..))).ok_or(Code::NoExactRoute)?;
        let locked = locked_variable(chain, moved.case).map_err(|_| Code::NoExactRoute)?;
        let layout = Layout::of(chain, locked).map_err(|_| Code::NoExactRoute)?;
        let turns = moved.kind == Variable::Rotation;
        let rotations = layout.loop_kinds().iter().filter(|kind| **kind == Variable::Rotation).count();
        // Loops of fewer rotations have closure polynomials of their own.
        let wrist = if moved.is_input() && rotations > MOST_ROTATIONS { Wrist::of(chain, &layout) } else { None };
        let layout = Layout { spherical: wrist.map_or(layout.spherical, |wrist| Some(wrist.first)), ..layout };
        for (numerator, denominator) in OFFSETS {
            let half_tangent = if turns { Rational::from((numerator, denominator)) } else { Rational::new() };
            let relations = relation::relations(chain, &layout, moved, &half_tangent);
            let mut outputs: Vec<(relation::Relation, OnceLock<Option<Output>>)> = Vec::new();
            for relation in relations {
                if outputs.is_empty() {
                    // The first one that has a closure polynomial gives the critical inputs.
                    let Ok(Some(output)) = Output::of(&relation, turns) else { continue };
                    outputs.push((relation, OnceLock::from(Some(output))));
                } else if outputs.iter().all(|(known, _)| known.output != relation.output) {
                    outputs.push((relation, OnceLock::new()));
                }
            }
            if !outputs.is_empty() {
                return Ok(Self { wrist, ..Self::counted(moved.kind, half_tangent, outputs) });
            }
        }
        Err(Code::NoExactRoute)
    }

    /// The closure polynomials of an overconstrained loop in its input, variable 0, and each output that has one, variable 1; half
    /// tangents are counted from 0.
    pub fn input_output(entry: &Entry, case: &Case, input: Variable) -> Vec<(usize, Polynomial<Int>)> {
        let moved = Moved { case, place: Place::Input, kind: input };
        let layout = entry.chain().and_then(|chain| {
            let locked = locked_variable(chain, case).ok()??;
            Some((chain, Layout::of(chain, Some(locked)).ok()?))
        });
        let Some((chain, layout)) = layout.filter(|(_, layout)| layout.missing() > 0) else { return Vec::new() };
        for (numerator, denominator) in OFFSETS {
            let turns = input == Variable::Rotation;
            let from = if turns { Rational::from((numerator, denominator)) } else { Rational::new() };
            let relations = relation::of_every_output(chain, &layout, moved, &from);
            let back = -from;
            let polynomial = |relation: &relation::Relation| {
                let divisor = Output::divisor(relation, turns)?;
                Some((relation.output, PlaneCurve::of(&divisor).counted_from(&back).polynomial()))
            };
            let found: Vec<_> = relations.iter().filter_map(polynomial).collect();
            if !found.is_empty() {
                return found;
            }
        }
        Vec::new()
    }

    /// Returns the output of a closure polynomial in variable 0, which runs, and the unknown 1. Half tangents of angles are
    /// counted from 0; `full` is the general degree in the unknown, half turns included.
    pub fn of_polynomial(
        polynomial: &Polynomial<Int>,
        moved: Variable,
        unknown: Variable,
        full: usize,
    ) -> Option<Self> {
        let turns = moved == Variable::Rotation;
        let degree = polynomial.degree(S) as usize;
        for (numerator, denominator) in OFFSETS {
            let from = if turns { Rational::from((numerator, denominator)) } else { Rational::new() };
            let counted = PlaneCurve::of(polynomial).counted_from(&from).polynomial();
            let is_finite = counted.degree(S) as usize == degree;
            let half_turns = full.saturating_sub(counted.degree(T) as usize);
            let equation = Integral::of_form(counted, is_finite, half_turns);
            let relation = relation::Relation::of(0, unknown, vec![equation]);
            if let Ok(Some(output)) = Output::of(&relation, turns) {
                return Some(Self::counted(moved, from, vec![(relation, OnceLock::from(Some(output)))]));
            }
        }
        None
    }

    /// Outputs whose half tangents of the input are counted from an angle with this half tangent.
    fn counted(input: Variable, from: Rational, outputs: Vec<(relation::Relation, OnceLock<Option<Output>>)>) -> Self {
        Self { input, offset: 2.0 * from.to_f64().atan(), from, wrist: None, outputs }
    }

    /// An output, if it has a closure polynomial.
    pub fn output(&self, index: usize) -> Option<&Output> {
        let (relation, output) = self.outputs.get(index)?;
        let turns = self.input == Variable::Rotation;
        output.get_or_init(|| Output::of(relation, turns).ok().flatten()).as_ref()
    }

    /// The critical inputs of the first output: angles in (-pi, pi], or distances.
    pub fn criticals(&self) -> Vec<f64> {
        self.output(0).map_or_else(Vec::new, |output| self.inputs(output.criticals.iter().map(|one| one.value)))
    }

    /// The inputs at which the loop moves while its input stands still, as the first output knows them.
    pub fn standing(&self) -> Vec<f64> {
        self.output(0).map_or_else(Vec::new, |output| self.inputs(output.standing.iter().copied()))
    }

    /// Angles in (-pi, pi], or distances, that half tangents or distances of the chart stand for.
    fn inputs(&self, values: impl Iterator<Item = f64>) -> Vec<f64> {
        let input = |x: f64| if self.input == Variable::Rotation { wrapped(self.offset + 2.0 * x.atan()) } else { x };
        values.map(input).collect()
    }

    /// The bridge between two samples as the first output that serves proves it, or the reason of the first one. The
    /// second sample may be that of `to` a turn on.
    pub fn bridge(&self, curve: &InputCurve, low: &Sample, high: &Sample, to: f64) -> Result<Bridge, Code> {
        let piece = self.piece(low.input, to).ok_or(Code::BranchesNotMatched)?;
        self.by_some_output(|output| {
            let bridge = |samples: [&Sample; 2]| crossing::bridge(output, &piece, &LoopEnds { curve, samples });
            self.wrist.map_or_else(|| bridge([low, high]), |wrist| wrist.bridge([low, high], bridge))
        })
    }

    /// As `bridge`, for modes of another kind.
    pub fn bridge_between(&self, modes: &impl Ends, to: f64) -> Result<Bridge, Code> {
        let piece = self.piece(modes.inputs()[0], to).ok_or(Code::BranchesNotMatched)?;
        self.by_some_output(|output| crossing::bridge(output, &piece, modes))
    }

    fn by_some_output(&self, bridge: impl Fn(&Output) -> Result<Bridge, Code>) -> Result<Bridge, Code> {
        let mut reason = Code::NoExactRoute;
        for index in 0..self.outputs.len() {
            let Some(output) = self.output(index) else { continue };
            match bridge(output) {
                Ok(bridge) => return Ok(bridge),
                Err(code) if index == 0 => reason = code,
                Err(_) => {}
            }
        }
        Err(reason)
    }

    /// A piece of the range in one of the charts. Every input has one rational number, in whatever piece it stands, so
    /// that nothing is left out between pieces.
    fn piece(&self, from: f64, to: f64) -> Option<Piece> {
        if self.input == Variable::Translation {
            return Some(Piece { chart: 0, ends: [Rational::from_f64(from)?, Rational::from_f64(to)?] });
        }
        let angles = [from, to].map(|input| wrapped(input - self.offset));
        let way = wrapped(to - from);
        let [a, b] = angles.map(|x| Rational::from_f64((x / 2.0).tan()));
        let half_tangents = [a?, b?];
        let is_one_way = |x: [f64; 2]| x.iter().all(|x| x.abs() <= WIDEST) && (x[1] - x[0] - way).abs() < 1.0;
        if way.abs() > LONGEST {
            return None;
        }
        if is_one_way(angles) {
            return Some(Piece { chart: 0, ends: half_tangents });
        }
        let is_turned = is_one_way(angles.map(|x| wrapped(x - PI))) && half_tangents.iter().all(|s| !s.is_zero());
        is_turned.then(|| Piece { chart: 1, ends: half_tangents.map(|s| -s.recip()) })
    }
}

/// The samples of a loop, with the curve on which its modes are followed.
struct LoopEnds<'a> {
    curve: &'a InputCurve,
    samples: [&'a Sample; 2],
}

impl Ends for LoopEnds<'_> {
    fn inputs(&self) -> [f64; 2] {
        self.samples.map(|sample| sample.input)
    }

    fn outputs(&self, end: usize, output: usize) -> Vec<f64> {
        self.samples[end].modes.iter().map(|q| q[output]).collect()
    }

    fn limit(&self, end: usize, [one, two]: [usize; 2]) -> Result<Option<Fold>, Code> {
        let (own, other) = (self.samples[end], self.samples[1 - end]);
        let track = follow(self.curve, &own.points[one], other.input / self.curve.unit(INPUT));
        match (track.destination, track.folds.as_slice()) {
            (Destination::Returned(point), [fold]) if mode_at(self.curve, own, &point) == Some(two) => Ok(Some(*fold)),
            _ => Err(Code::BranchesNotMatched),
        }
    }
}
