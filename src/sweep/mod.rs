//! All branches of a loop while its input runs through a range: every mode at every step, followed from step to step.
//!
//! The list of modes of each step comes from the solver, with its verdict. Between two steps every mode is followed
//! along the curve of the loop, forwards from one and backwards from the other, round limit positions where the input
//! turns back. Both ways must agree with each other and with the two lists; where they do not, the step is halved, and
//! what still does not add up is said to be unresolved. Complex modes show where a circuit may lie within a step.

mod assemblies;
mod branch;
mod bridge;
mod cells;
mod derivation;
mod dyads;
mod exact;
mod hidden;
mod linkage;
mod linkage_relation;
mod linking;
mod nodes;
mod platform;
mod sample;
mod space;
mod sphere;
mod track;
mod verdict;

pub use assemblies::{AssemblyBranch, AssemblyLimit, AssemblyRow, AssemblySample, AssemblySweep};
pub use branch::{Branch, End, Limit, Row};
pub use cells::{
    Cell, CellMap, Cells, CellsVerdict, Column, EntryCase, Label, LinkageCase, MapWanted, Parameter, SpaceCase,
    SphereCase, Subject, Zero, cell_map, cells,
};
pub use derivation::derive_any;
pub use linkage::{LinkageSweep, count_limits, sweep_linkage};
pub use platform::{PlatformSweep, sweep_platform};
pub use sample::{Sample, case};
pub use space::{SpaceSweep, place as space_place, sweep_space};
pub use sphere::{SphereSweep, place as sphere_place, sweep_sphere};
pub use verdict::SweepVerdict;

use crate::assembly::{Assembly, Workspace};
use crate::catalogue::entry::Entry;
use crate::error::{Error, Result};
use crate::kinematics::closed_loop::Variable;
use crate::mechanism::{InputCurve, Mechanism};
use crate::solve::curve::INPUT;
use crate::verdict::{Code, Status};
use branch::Web;
use bridge::{Bridge, Fate, bridges, mode_at};
use exact::Exact;
use nodes::Wanted;
use rayon::prelude::*;
use sample::Swept;
use std::f64::consts::TAU;

/// Beside a singular step branches are followed from inputs this part of a step away.
const BESIDE: f64 = 1e-3;

/// The range of an input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The beginning: radians or a length.
    pub from: f64,
    /// The end.
    pub to: f64,
    /// Number of equal steps between.
    pub steps: usize,
}

impl Range {
    /// The input at the end of a step, or the first one.
    #[must_use]
    pub fn input(&self, step: usize) -> f64 {
        if step == self.steps {
            return self.to;
        }
        self.from + (self.to - self.from) * (step as f64 / self.steps as f64)
    }
}

/// The result of a sweep.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The requested range.
    pub range: Range,
    /// The real modes at the first input and at the end of every step, as far as the sweep came.
    pub samples: Vec<Sample>,
    /// The branches, in the order in which they appear.
    pub branches: Vec<Branch>,
    /// The limit positions, in the order of their inputs.
    pub limits: Vec<Limit>,
    /// Whether the range is a full turn, whose end is its beginning.
    pub is_full_turn: bool,
    /// Whether the loop has fewer than seven joint variables, so that it may close at single inputs.
    pub is_overconstrained: bool,
    /// A note on the angles of spherical joints.
    pub note: Option<String>,
    /// Inputs of the range at which the loop moves while its input stands still, where branches are proved: no branches,
    /// but configurations that these may meet.
    pub standing: Vec<f64>,
    /// Is every branch found.
    pub verdict: SweepVerdict,
}

impl Sweep {
    /// Returns the number of inputs with this status.
    #[must_use]
    pub fn count(&self, status: Status) -> usize {
        self.samples.iter().filter(|sample| sample.status == status).count()
    }

    /// Returns the number of unresolved ends of branches.
    #[must_use]
    pub fn unresolved(&self) -> usize {
        let ends = self.branches.iter().flat_map(|branch| [&branch.begin, &branch.end]);
        ends.filter(|end| matches!(end, End::Unresolved(_))).count()
    }
}

/// Sweeps a loop, on all threads of the current pool. `running` is asked now and then and stops the sweep, which keeps
/// what is done; `tick` is called for every input.
///
/// # Errors
/// [`Error::Invalid`] for entries that are no loops, joints without such a variable and empty ranges;
/// [`Error::Unsupported`] for loops that are not solved.
pub fn sweep(
    entry: &Entry,
    joint: usize,
    variable: Variable,
    range: Range,
    running: impl Fn() -> bool + Sync,
    tick: impl Fn() + Sync,
) -> Result<Sweep> {
    if !(range.from - range.to).is_normal() || range.steps == 0 {
        let message = format!("found a range from {} to {} in {} steps", range.from, range.to, range.steps);
        return Err(Error::Invalid(format!("{message}, expected two different ends and a step at least")));
    }
    let mut entry = entry.clone();
    // Branches are followed through angles in (-pi, pi].
    entry.limits.clear();
    entry.cases = vec![case(joint, variable, range.from)];
    let curve = InputCurve::of(&entry, &entry.cases[0])?;
    let mechanism = Mechanism::prepare(&entry)?;
    let is_overconstrained = curve.variables().len() < 7;
    let swept = Swept { mechanism: &mechanism, curve: &curve, joint, variable, is_overconstrained };
    let memory = || (Workspace::default(), Assembly::default());
    let mut samples: Vec<Sample> = Vec::new();
    let steps: Vec<usize> = (0..=range.steps).collect();
    for chunk in steps.chunks(16 * rayon::current_num_threads()) {
        if !running() {
            break;
        }
        let solve = |memory: &mut (Workspace, Assembly), step: &usize| {
            let sample = swept.sample(range.input(*step), memory);
            tick();
            sample
        };
        let solved: Result<Vec<Sample>> = chunk.par_iter().map_init(memory, solve).collect();
        samples.extend(solved?);
    }
    let is_whole = samples.len() == range.steps + 1;
    let turn = variable == Variable::Rotation && ((range.to - range.from).abs() - TAU).abs() < 1e-12;
    let is_full_turn = turn && is_whole;
    let (web, standing, unproved) = match proved(&swept, &entry, range, &samples, is_full_turn)? {
        Ok((web, standing)) => (web, standing, None),
        Err(code) => (connect(&swept, range, &samples, is_full_turn)?, Vec::new(), Some(code)),
    };
    let (branches, limits) = web.branches(&curve, &samples, range);
    let note = curve.note().map(ToOwned::to_owned);
    let verdict = SweepVerdict::none();
    let mut found =
        Sweep { range, samples, branches, limits, is_full_turn, is_overconstrained, note, standing, verdict };
    found.verdict = SweepVerdict::of(&found, unproved, entry.rounded);
    Ok(found)
}

/// The part between two neighbouring samples: further samples, and the bridges from each to the next one.
type Span = (Vec<Sample>, Vec<Bridge>);
/// A proved result, or the reason why it is not proved.
type Proved<T> = std::result::Result<T, Code>;
/// A sample to follow branches from, and the step that it is or stands for.
type Node = (Sample, Option<usize>);

/// All modes between neighbouring samples, as the closure polynomial proves them, and the inputs at which the loop moves
/// by itself.
fn proved(
    swept: &Swept<'_>,
    entry: &Entry,
    range: Range,
    samples: &[Sample],
    is_full_turn: bool,
) -> Result<Proved<(Web, Vec<f64>)>> {
    let exact = match Exact::of(entry, &entry.cases[0], swept.variable) {
        Ok(exact) => exact,
        Err(code) => return Ok(Err(code)),
    };
    let nodes = nodes(swept, range, samples, is_full_turn, Some(&exact))?;
    let pairs: Vec<&[Node]> = nodes.windows(2).collect();
    let between = |pair: &&[Node]| exact.bridge(swept.curve, &pair[0].0, &pair[1].0, pair[1].0.input);
    let found: Proved<Vec<Bridge>> = pairs.par_iter().map(between).collect();
    let bridges = match found {
        Ok(bridges) if !bridges.is_empty() => bridges,
        Ok(_) => return Ok(Err(Code::BranchesNotMatched)),
        Err(code) => return Ok(Err(code)),
    };
    let last = match (is_full_turn, nodes.first(), nodes.last()) {
        (true, Some((first, _)), Some((last, _))) => match closing(swept, first, last, range) {
            Closing::Same(bridge) => Some(bridge),
            Closing::Apart(next) => match exact.bridge(swept.curve, last, &next, first.input) {
                Ok(bridge) => Some(bridge),
                Err(code) => return Ok(Err(code)),
            },
        },
        _ => None,
    };
    let spans = bridges.into_iter().chain(last).map(|bridge| (Vec::new(), vec![bridge])).collect();
    let standing = range.having(&exact.standing(), swept.variable);
    Ok(Ok((Web::of(nodes, spans, is_full_turn), standing)))
}

/// Follows all modes between all neighbouring samples.
fn connect(swept: &Swept<'_>, range: Range, samples: &[Sample], is_full_turn: bool) -> Result<Web> {
    let memory = || (Workspace::default(), Assembly::default());
    let nodes = with_hidden(swept, nodes(swept, range, samples, is_full_turn, None)?)?;
    let pairs: Vec<&[Node]> = nodes.windows(2).collect();
    let between =
        |memory: &mut (Workspace, Assembly), pair: &&[Node]| bridges(swept, &pair[0].0, &pair[1].0, 0, memory);
    let found: Result<Vec<Span>> = pairs.par_iter().map_init(memory, between).collect();
    let mut spans = found?;
    if let (true, Some((first, _)), Some((last, _))) = (is_full_turn, nodes.first(), nodes.last()) {
        spans.push(match closing(swept, first, last, range) {
            Closing::Same(bridge) => (Vec::new(), vec![bridge]),
            Closing::Apart(next) => bridges(swept, last, &next, 0, &mut memory())?,
        });
    }
    Ok(Web::of(nodes, spans, is_full_turn))
}

/// The samples to follow branches from, each with the step that it is or stands for: singular ones and those beside
/// critical inputs are replaced by regular ones on both sides.
fn nodes(
    swept: &Swept<'_>,
    range: Range,
    samples: &[Sample],
    is_full_turn: bool,
    exact: Option<&Exact>,
) -> Result<Vec<Node>> {
    let memory = || (Workspace::default(), Assembly::default());
    let criticals = exact.map(|exact| range.criticals(&exact.criticals(), swept.variable, is_full_turn));
    let aside = BESIDE * (range.to - range.from) / range.steps as f64;
    let wanted = range.wanted(samples, criticals.as_deref(), aside);
    let wanted = range.filled(wanted, swept.variable, exact.is_some(), swept.is_overconstrained);
    let sample = |memory: &mut (Workspace, Assembly), (_, wanted): &(f64, Wanted)| {
        Ok(match wanted {
            Wanted::Step(step) => Some((samples[*step].clone(), Some(*step))),
            Wanted::Beside(input, step) => {
                let sample = swept.sample(*input, memory)?;
                sample.is_regular.then_some((sample, *step))
            }
        })
    };
    let found: Result<Vec<Option<Node>>> = wanted.par_iter().map_init(memory, sample).collect();
    Ok(found?.into_iter().flatten().collect())
}

/// The samples with those between them that show a circuit which none of them shows.
fn with_hidden(swept: &Swept<'_>, nodes: Vec<Node>) -> Result<Vec<Node>> {
    let memory = || (Workspace::default(), Assembly::default());
    let (samples, steps): (Vec<Sample>, Vec<Option<usize>>) = nodes.into_iter().unzip();
    let spans: Vec<usize> = (1..samples.len()).collect();
    let look = |memory: &mut (Workspace, Assembly), end: &usize| hidden::between(swept, &samples, end - 1, memory);
    let found: Result<Vec<Vec<Sample>>> = spans.par_iter().map_init(memory, look).collect();
    let mut all = Vec::new();
    // Nothing stands before the first sample.
    for ((sample, step), hidden) in samples.iter().zip(steps).zip(std::iter::once(Vec::new()).chain(found?)) {
        all.extend(hidden.into_iter().map(|sample| (sample, None)));
        all.push((sample.clone(), step));
    }
    Ok(all)
}

/// The joint of the end of a full turn and its beginning.
enum Closing {
    /// They are the same input: the same modes.
    Same(Bridge),
    /// By a bridge to the first sample, a turn on.
    Apart(Box<Sample>),
}

/// The end of a full turn and its beginning.
fn closing(swept: &Swept<'_>, first: &Sample, last: &Sample, range: Range) -> Closing {
    let turn = range.to - range.from;
    let mut next = first.clone();
    next.input += turn;
    for point in &mut next.points {
        point[INPUT] += turn;
    }
    if (next.input - last.input).abs() > 1e-12 {
        return Closing::Apart(Box::new(next));
    }
    let same = |own: &Sample, other: &Sample| -> Vec<Fate> {
        let fate = |point| mode_at(swept.curve, other, point).map_or(Fate::Lost, |mode| Fate::On(mode, Vec::new()));
        own.points.iter().map(fate).collect()
    };
    let (forwards, backwards) = (same(last, &next), same(&next, last));
    Closing::Same(Bridge { forwards, backwards, folds: Vec::new() })
}
