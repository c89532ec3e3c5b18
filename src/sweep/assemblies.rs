//! All assemblies of a mechanism while one of its inputs runs through a range, joined by a proof or by their distances.
//!
//! The list of assemblies at every step comes from the solver, with its verdict. Without a proof assemblies of neighbouring inputs are
//! joined where each is by far the nearest to the other; where they are not, the step is halved. Where two of them come
//! together and there are none beyond, the input turns back: the halving ends at that limit position.

use super::{End, Range, SweepVerdict};
use crate::algebra::sort;
use crate::error::{Error, Result};
use crate::verdict::{Code, Status, Verdict};
use rayon::prelude::*;

/// Steps in which assemblies appear or vanish are halved until they are this part of the range: limit positions are as
/// near.
const SMALLEST: f64 = 1e-11;
/// Beside them assemblies are close together: steps in which their number stays are halved further, to this part of those.
const FURTHER: f64 = 1e-3;
/// An assembly is followed to one at this part of the distance of any other, at most.
const NEARER: f64 = 0.35;
/// Largest distance of two such assemblies: radians, or parts of the size of the linkage.
const NEAR: f64 = 0.5;
/// A point at this many times the size of the mechanism is on its way to infinity.
const FAR: f64 = 1e6;
/// Places at which a step is cut; the later ones serve where an assembly is double at the earlier ones.
const CUTS: [f64; 3] = [0.5, 0.463_017, 0.551_923];

/// The real assemblies at one input.
#[derive(Clone, Debug)]
pub struct AssemblySample<M> {
    /// The input: radians, not reduced modulo 2 pi, or metres.
    pub input: f64,
    /// Whether the list is complete.
    pub status: Status,
    /// Why, or why not.
    pub reason: String,
    /// The real assemblies.
    pub modes: Vec<M>,
    /// Whether all of them are simple and there are no others.
    pub(super) is_regular: bool,
}

impl<M> AssemblySample<M> {
    /// Returns the sample of an answer; `multiplicity` is that of a real assembly, and none of a complex one. A Gröbner basis may be too
    /// large at one input, and not at others: there the list is incomplete.
    pub(super) fn of(
        input: f64,
        answer: Result<(Verdict, Vec<M>)>,
        multiplicity: impl Fn(&M) -> Option<usize>,
    ) -> Result<Self> {
        match answer {
            Ok((Verdict { status, reason, .. }, mut modes)) => {
                modes.retain(|mode| multiplicity(mode).is_some());
                let is_regular = is_listed(status) && modes.iter().all(|mode| multiplicity(mode) == Some(1));
                Ok(Self { input, status, reason, modes, is_regular })
            }
            Err(Error::Unsupported(reason)) => {
                Ok(Self { input, status: Status::Incomplete, reason, modes: Vec::new(), is_regular: false })
            }
            Err(error) => Err(error),
        }
    }
}

/// An assembly of a branch at one step.
#[derive(Clone, Debug)]
pub struct AssemblyRow {
    /// The step, 0 for the first input.
    pub step: usize,
    /// The turn of the branch, from 0, where a full turn joins up.
    pub turn: usize,
    /// Index of the assembly among those of the sample.
    pub mode: usize,
}

/// Assemblies that pass into one another while the input moves one way.
#[derive(Clone, Debug)]
pub struct AssemblyBranch {
    /// Number, from 1, of its circuit: branches that meet in limit positions belong to one.
    pub circuit: usize,
    /// The input at which it begins, in the direction of the sweep.
    pub from: f64,
    /// The beginning.
    pub begin: End,
    /// The input at which it ends, not reduced by full turns.
    pub to: f64,
    /// The end.
    pub end: End,
    /// Its assemblies, step by step.
    pub rows: Vec<AssemblyRow>,
}

/// A limit position: two branches meet, and the input turns back.
#[derive(Clone, Debug)]
pub struct AssemblyLimit<M> {
    /// The input there.
    pub input: f64,
    /// Whether it is largest there, else smallest.
    pub is_largest: bool,
    /// The assembly there: in the middle between two that are nearly one.
    pub mode: M,
    /// The branches that meet.
    pub branches: Vec<usize>,
}

/// The result of a sweep.
#[derive(Clone, Debug)]
pub struct AssemblySweep<M> {
    /// The index of the joint or leg that runs.
    pub joint: usize,
    /// The requested range.
    pub range: Range,
    /// The assemblies at the first input and at the end of every step.
    pub samples: Vec<AssemblySample<M>>,
    /// The branches.
    pub branches: Vec<AssemblyBranch>,
    /// The limit positions, in the order of the sweep.
    pub limits: Vec<AssemblyLimit<M>>,
    /// The proved number of complex limit positions of the input in its whole turn, or on its whole line; `None` where they are not
    /// counted.
    pub complex_limits: Option<usize>,
    /// Whether the range is a full turn, whose end is its beginning.
    pub is_full_turn: bool,
    /// Is every branch found.
    pub verdict: SweepVerdict,
}

impl<M> AssemblySweep<M> {
    /// Returns the number of unresolved ends of branches.
    #[must_use]
    pub fn unresolved(&self) -> usize {
        let ends = self.branches.iter().flat_map(|branch| [&branch.begin, &branch.end]);
        ends.filter(|end| matches!(end, End::Unresolved(_))).count()
    }

    /// Returns the number of inputs whose list is not complete.
    #[must_use]
    pub fn incomplete(&self) -> usize {
        self.samples.iter().filter(|sample| !is_listed(sample.status)).count()
    }
}

/// Returns whether a point is on its way to infinity.
pub(super) fn is_far<const N: usize>(place: [f64; N], size: f64) -> bool {
    place.iter().map(|x| x * x).sum::<f64>().sqrt() > FAR * size
}

/// Returns the distance of two places of a point in parts of the size of the mechanism, or of the distance of a point on its way to
/// infinity: all steps there would else be too large, however short they are. Very far away its direction counts.
pub(super) fn step<const N: usize>(here: [f64; N], there: [f64; N], size: f64) -> f64 {
    let norm = |p: [f64; N]| p.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [one, two] = [here, there].map(norm);
    let scale = if one.min(two) > FAR * size { [one, two] } else { [size.max(one.min(two)); 2] };
    norm(std::array::from_fn(|k| here[k] / scale[0] - there[k] / scale[1]))
}

/// Returns whether a list of assemblies is complete.
pub(super) fn is_listed(status: Status) -> bool {
    matches!(status, Status::Complete | Status::Unreachable)
}

/// A mechanism with an input that runs, while others are held.
pub(super) trait Running: Sync {
    /// An assembly.
    type Mode: Clone + Send + Sync;
    /// The memory of a thread.
    type Memory: Default;

    /// Returns all real assemblies at an input.
    fn sample(&self, input: f64, memory: &mut Self::Memory) -> Result<AssemblySample<Self::Mode>>;

    /// Returns the distance of two assemblies: radians, or parts of the size of the mechanism.
    fn apart(&self, one: &Self::Mode, two: &Self::Mode) -> f64;

    /// Returns the assembly between two that are nearly one.
    fn middle(&self, one: &Self::Mode, two: &Self::Mode) -> Self::Mode;

    /// Returns whether a part of an assembly is on its way to infinity.
    fn is_far(&self, _mode: &Self::Mode) -> bool {
        false
    }

    /// Returns how the assemblies of the samples, with more samples between them, are proved to pass into one another.
    fn proved(
        &self,
        _range: Range,
        _is_full_turn: bool,
        _samples: &[AssemblySample<Self::Mode>],
    ) -> Result<Proved<Self::Mode>> {
        Ok(Err(Code::NoExactRoute))
    }

    /// Why they are, in words.
    fn because(&self) -> &'static str {
        ""
    }
}

/// Samples, with the steps that some of them are, and the links between them, or the reason why they are not proved.
pub(super) type Proved<M> = std::result::Result<(Vec<(AssemblySample<M>, Option<usize>)>, Vec<Link>), Code>;

/// The assemblies of samples of a running mechanism, compared.
struct Compared<'a, R: Running>(&'a R);

type Sample<R> = AssemblySample<<R as Running>::Mode>;

impl<R: Running> Compared<'_, R> {
    /// The distance from an assembly to the nearest other one of its sample.
    fn room(&self, sample: &Sample<R>, mode: usize) -> f64 {
        let others = (0..sample.modes.len()).filter(|other| *other != mode);
        others.map(|other| self.0.apart(&sample.modes[mode], &sample.modes[other])).fold(f64::INFINITY, f64::min)
    }

    /// The assemblies of one sample that pass into those of the next, as far as that is clear.
    fn passes(&self, one: &Sample<R>, two: &Sample<R>) -> Vec<Option<usize>> {
        let nearest = |mode: &R::Mode, of: &Sample<R>| {
            let all = of.modes.iter().map(|other| self.0.apart(mode, other)).enumerate();
            all.min_by(|a, b| a.1.total_cmp(&b.1))
        };
        let pass = |(k, mode): (usize, &R::Mode)| {
            let (other, distance) = nearest(mode, two)?;
            let is_mutual = nearest(&two.modes[other], one)?.0 == k;
            let room = self.room(one, k).min(self.room(two, other));
            (is_mutual && distance < NEAR && distance < NEARER * room).then_some(other)
        };
        one.modes.iter().enumerate().map(pass).collect()
    }

    /// The pair of assemblies that come together, of those that pass into none.
    fn fold(&self, sample: &Sample<R>, left: &[usize]) -> Option<[usize; 2]> {
        let pairs = left.iter().enumerate().flat_map(|(k, a)| left[k + 1..].iter().map(move |b| [*a, *b]));
        let distance = |[a, b]: &[usize; 2]| self.0.apart(&sample.modes[*a], &sample.modes[*b]);
        pairs.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Samples between two, and the links from each sample to the next.
    fn between(
        &self,
        [one, two]: [&Sample<R>; 2],
        least: f64,
        found: &mut Between<R::Mode>,
        memory: &mut R::Memory,
    ) -> Result<()> {
        let passes = self.passes(one, two);
        let lost: Vec<usize> = (0..one.modes.len()).filter(|k| passes[*k].is_none()).collect();
        let new: Vec<usize> = (0..two.modes.len()).filter(|k| !passes.contains(&Some(*k))).collect();
        let is_whole = lost.is_empty() && new.is_empty();
        let least_here = if one.modes.len() == two.modes.len() { FURTHER * least } else { least };
        if is_whole || (two.input - one.input).abs() < least_here {
            // The assemblies left after all halving meet in pairs, or are unresolved.
            let pairs = |sample: &Sample<R>, mut left: Vec<usize>| {
                let mut pairs = Vec::new();
                while let Some(pair) = self.fold(sample, &left) {
                    left.retain(|mode| !pair.contains(mode));
                    pairs.push(pair);
                }
                if left.is_empty() { pairs } else { Vec::new() }
            };
            let folds = match (lost.is_empty(), new.is_empty()) {
                (false, true) => [pairs(one, lost), Vec::new()],
                (true, false) => [Vec::new(), pairs(two, new)],
                _ => [Vec::new(), Vec::new()],
            };
            found.links.push(Link { passes, folds, is_ring: false });
            return Ok(());
        }
        for cut in CUTS {
            let middle = self.0.sample(one.input + cut * (two.input - one.input), memory)?;
            if middle.is_regular {
                self.between([one, &middle], least, found, memory)?;
                found.samples.push(middle.clone());
                return self.between([&middle, two], least, found, memory);
            }
        }
        found.links.push(Link { passes, folds: [Vec::new(), Vec::new()], is_ring: false });
        Ok(())
    }
}

/// Samples between two others, and the links from each to the next.
struct Between<M> {
    samples: Vec<AssemblySample<M>>,
    links: Vec<Link>,
}

/// The connections of the assemblies of a sample to those of the next one.
pub(super) struct Link {
    /// For every assembly, the one of the next sample into which it passes.
    pub passes: Vec<Option<usize>>,
    /// Pairs that come together behind the sample, and pairs that come from one before the next sample.
    pub folds: [Vec<[usize; 2]>; 2],
    /// Whether it leads from the end of a full turn to its beginning.
    pub is_ring: bool,
}

/// Runs an input through its range, on all threads of the current pool. `tick` is called for every step.
///
/// # Errors
/// [`Error::Invalid`] for empty ranges; as the solver.
pub(super) fn follow<R: Running>(
    run: &R,
    joint: usize,
    range: Range,
    is_full_turn: bool,
    tick: impl Fn() + Sync,
) -> Result<AssemblySweep<R::Mode>> {
    if !(range.from - range.to).is_normal() || range.steps == 0 {
        let message = format!("found a range from {} to {} in {} steps", range.from, range.to, range.steps);
        return Err(Error::Invalid(format!("{message}, expected two different ends and a step at least")));
    }
    let solved = (0..=range.steps).into_par_iter().map_init(R::Memory::default, |memory, step| {
        let sample = run.sample(range.input(step), memory);
        tick();
        sample
    });
    let samples: Vec<Sample<R>> = solved.collect::<Result<_>>()?;
    let (nodes, links, unproved) = match run.proved(range, is_full_turn, &samples)? {
        Ok((nodes, links)) => (nodes, links, None),
        Err(code) => {
            let (nodes, links) = joined(run, range, is_full_turn, &samples)?;
            (nodes, links, Some(code))
        }
    };
    let step = |node: Option<&Node<R>>| node.and_then(|(_, step)| *step);
    let ends = [step(nodes.first()) == Some(0), step(nodes.last()) == Some(range.steps)];
    let web = Web { run, nodes, links, range };
    let (branches, limits) = web.branches(ends);
    let verdict = SweepVerdict::none();
    let mut sweep =
        AssemblySweep { joint, range, samples, branches, limits, complex_limits: None, is_full_turn, verdict };
    sweep.verdict = SweepVerdict::of_assemblies(&sweep, unproved, run.because());
    Ok(sweep)
}

/// A sample and the step that it is, if it is one.
type Node<R> = (Sample<R>, Option<usize>);

/// Joins assemblies by their distances.
fn joined<R: Running>(
    run: &R,
    range: Range,
    is_full_turn: bool,
    samples: &[Sample<R>],
) -> Result<(Vec<Node<R>>, Vec<Link>)> {
    let compared = Compared(run);
    let regular: Vec<usize> = (0..samples.len()).filter(|step| samples[*step].is_regular).collect();
    let least = SMALLEST * (range.to - range.from).abs().max(1.0);
    let spans: Vec<(Between<R::Mode>, usize)> = regular
        .par_windows(2)
        .map_init(R::Memory::default, |memory, pair| {
            let mut found = Between { samples: Vec::new(), links: Vec::new() };
            compared.between([&samples[pair[0]], &samples[pair[1]]], least, &mut found, memory)?;
            Ok((found, pair[1]))
        })
        .collect::<Result<_>>()?;
    let mut nodes: Vec<(Sample<R>, Option<usize>)> = Vec::new();
    let mut links = Vec::new();
    if let Some(first) = regular.first() {
        nodes.push((samples[*first].clone(), Some(*first)));
    }
    for (between, step) in spans {
        nodes.extend(between.samples.into_iter().map(|sample| (sample, None)));
        links.extend(between.links);
        nodes.push((samples[step].clone(), Some(step)));
    }
    let ends = [regular.first() == Some(&0), regular.last() == Some(&range.steps)];
    if let (true, [true, true], Some((first, _)), Some((last, _))) = (is_full_turn, ends, nodes.first(), nodes.last()) {
        let passes = compared.passes(last, first);
        links.push(Link { passes, folds: [Vec::new(), Vec::new()], is_ring: true });
    }
    Ok((nodes, links))
}

/// An assembly of a node.
type Place = (usize, usize);

/// Samples in a row with the links between them.
struct Web<'a, R: Running> {
    run: &'a R,
    nodes: Vec<(Sample<R>, Option<usize>)>,
    links: Vec<Link>,
    range: Range,
}

impl<R: Running> Web<'_, R> {
    fn next(&self, (node, mode): Place) -> Option<Place> {
        let link = self.links.get(node)?;
        let next = if link.is_ring { 0 } else { node + 1 };
        link.passes[mode].map(|mode| (next, mode))
    }

    /// The link that leads to a node.
    fn before(&self, node: usize) -> Option<usize> {
        match node.checked_sub(1) {
            Some(before) => Some(before),
            None => self.links.iter().position(|link| link.is_ring),
        }
    }

    fn previous(&self, (node, mode): Place) -> Option<Place> {
        let before = self.before(node)?;
        let from = self.links[before].passes.iter().position(|to| *to == Some(mode))?;
        Some((before, from))
    }

    /// The limit position behind a place, or before it: link, side and number.
    fn fold_at(&self, (node, mode): Place, forwards: bool) -> Option<(usize, usize, usize)> {
        let (link, side) = if forwards { (node, 0) } else { (self.before(node)?, 1) };
        let folds = &self.links.get(link)?.folds[side];
        folds.iter().position(|pair| pair.contains(&mode)).map(|number| (link, side, number))
    }

    fn branches(&self, ends: [bool; 2]) -> (Vec<AssemblyBranch>, Vec<AssemblyLimit<R::Mode>>) {
        let mut owner: Vec<Vec<bool>> = self.nodes.iter().map(|(sample, _)| vec![false; sample.modes.len()]).collect();
        let places = || (0..self.nodes.len()).flat_map(|n| (0..self.nodes[n].0.modes.len()).map(move |m| (n, m)));
        let mut keys: Vec<(usize, usize, usize)> = Vec::new();
        let mut limits: Vec<AssemblyLimit<R::Mode>> = Vec::new();
        let mut branches: Vec<AssemblyBranch> = Vec::new();
        // Paths with a beginning come first; the rest are closed.
        for is_open in [true, false] {
            for start in places() {
                if owner[start.0][start.1] || (is_open && self.previous(start).is_some()) {
                    continue;
                }
                let mut path = vec![start];
                owner[start.0][start.1] = true;
                let mut is_closed = false;
                while let Some(next) = self.next(path[path.len() - 1]) {
                    if owner[next.0][next.1] {
                        is_closed = next == start;
                        break;
                    }
                    owner[next.0][next.1] = true;
                    path.push(next);
                }
                let number = branches.len();
                let mut end = |place: Place, forwards: bool| {
                    let input = self.nodes[place.0].0.input;
                    if let Some(key) = self.fold_at(place, forwards) {
                        let known = keys.iter().position(|own| *own == key).unwrap_or_else(|| {
                            keys.push(key);
                            limits.push(self.limit(key));
                            keys.len() - 1
                        });
                        limits[known].branches.push(number);
                        // What begins between the end of a full turn and its beginning begins a turn before the end.
                        let is_wrapped = !forwards && self.links[key.0].is_ring;
                        let turn = if is_wrapped { self.range.to - self.range.from } else { 0.0 };
                        return (End::Limit(known), limits[known].input - turn);
                    }
                    let is_border =
                        if forwards { place.0 + 1 == self.nodes.len() && ends[1] } else { place.0 == 0 && ends[0] };
                    if is_border && !self.links.iter().any(|link| link.is_ring) {
                        return (End::Range, input);
                    }
                    let beside = if forwards { place.0 + 1 } else { place.0.wrapping_sub(1) };
                    let other = self.nodes.get(beside).map_or(input, |(sample, _)| sample.input);
                    if self.run.is_far(&self.nodes[place.0].0.modes[place.1]) {
                        return (End::Infinite(input), input);
                    }
                    (End::Unresolved([input, other]), input)
                };
                let turns = path.iter().filter(|place| place.0 == 0).count();
                let span = self.range.to - self.range.from;
                let ((begin, from), (finish, to)) = if is_closed {
                    let turns = turns.max(1);
                    let from = self.nodes[start.0].0.input;
                    ((End::Closed(turns), from), (End::Closed(turns), from + turns as f64 * span))
                } else {
                    let wrapped = path[1..].iter().filter(|place| place.0 == 0).count() as f64;
                    let (last, to) = end(path[path.len() - 1], true);
                    (end(start, false), (last, to + wrapped * span))
                };
                branches.push(AssemblyBranch { circuit: 0, from, begin, to, end: finish, rows: self.rows(&path) });
            }
        }
        circuits(&mut branches, &limits);
        sorted(&mut branches, &limits, self.range)
    }

    fn rows(&self, path: &[Place]) -> Vec<AssemblyRow> {
        let mut turn = 0;
        let mut rows = Vec::new();
        for (k, (node, mode)) in path.iter().enumerate() {
            if k > 0 && *node == 0 {
                turn += 1;
            }
            if let Some(step) = self.nodes[*node].1 {
                rows.push(AssemblyRow { step, turn, mode: *mode });
            }
        }
        rows
    }

    fn limit(&self, (link, side, number): (usize, usize, usize)) -> AssemblyLimit<R::Mode> {
        let is_ring = self.links[link].is_ring;
        let (one, two) = (&self.nodes[link].0, &self.nodes[if is_ring { 0 } else { link + 1 }].0);
        let next = two.input + if is_ring { self.range.to - self.range.from } else { 0.0 };
        let sample = if side == 0 { one } else { two };
        let [a, b] = self.links[link].folds[side][number].map(|mode| &sample.modes[mode]);
        let is_upwards = self.range.to > self.range.from;
        AssemblyLimit {
            input: 0.5 * (one.input + next),
            is_largest: (side == 0) == is_upwards,
            mode: self.run.middle(a, b),
            branches: Vec::new(),
        }
    }
}

/// Numbers the circuits.
fn circuits<M>(branches: &mut [AssemblyBranch], limits: &[AssemblyLimit<M>]) {
    let mut circuit: Vec<usize> = (0..branches.len()).collect();
    for limit in limits {
        if let [a, b] = limit.branches[..] {
            let (low, high) = (circuit[a].min(circuit[b]), circuit[a].max(circuit[b]));
            circuit.iter_mut().filter(|own| **own == high).for_each(|own| *own = low);
        }
    }
    let mut order = circuit.clone();
    order.sort_unstable();
    order.dedup();
    for (branch, own) in branches.iter_mut().zip(circuit) {
        branch.circuit = order.partition_point(|other| *other < own) + 1;
    }
}

/// Puts the limit positions in the order of the sweep.
fn sorted<M: Clone>(
    branches: &mut Vec<AssemblyBranch>,
    limits: &[AssemblyLimit<M>],
    range: Range,
) -> (Vec<AssemblyBranch>, Vec<AssemblyLimit<M>>) {
    let sign = (range.to - range.from).signum();
    let mut order: Vec<usize> = (0..limits.len()).collect();
    sort::by(&mut order, |a, b| (sign * limits[*a].input).total_cmp(&(sign * limits[*b].input)));
    for end in branches.iter_mut().flat_map(|branch| [&mut branch.begin, &mut branch.end]) {
        if let End::Limit(limit) = end {
            *limit = order.iter().position(|own| own == limit).unwrap_or(*limit);
        }
    }
    let limits = order.iter().map(|own| limits[*own].clone()).collect();
    (std::mem::take(branches), limits)
}
