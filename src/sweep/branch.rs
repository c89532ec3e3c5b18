//! Modes of neighbouring inputs joined to branches.

use super::bridge::{Bridge, Fate, apart};
use super::sample::Sample;
use super::track::Fold;
use super::{Range, Span};
use crate::algebra::sort;
use crate::assembly::wrapped;
use crate::kinematics::closed_loop::Variable;
use crate::mechanism::InputCurve;
use crate::solve::curve::INPUT;

/// The beginning or end of a branch.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// In a limit position: index in [`super::Sweep::limits`].
    Limit(usize),
    /// At an end of the range.
    Range,
    /// In itself, after this many full turns.
    Closed(usize),
    /// A translation grows beyond all bounds near this input.
    Infinite(f64),
    /// At an isolated input: the loop closes there and does not move.
    Isolated,
    /// Unresolved between these two inputs.
    Unresolved([f64; 2]),
}

/// A mode of a branch at one step.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The step, 0 for the first input.
    pub step: usize,
    /// The turn of the branch, from 0, where a full turn joins up.
    pub turn: usize,
    /// Index of the mode among those of the sample.
    pub mode: usize,
}

/// Modes that pass into one another while the input moves one way.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
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
    /// Its modes, step by step.
    pub rows: Vec<Row>,
}

/// A limit position: two branches meet, and the input turns back.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// The input there.
    pub input: f64,
    /// All joint variables there, in joint order; angles in (-pi, pi].
    pub q: Vec<f64>,
    /// Whether the input is largest there, else smallest.
    pub is_largest: bool,
    /// The branches that meet: indices in [`super::Sweep::branches`].
    pub branches: Vec<usize>,
}

/// Samples in a row, and the bridges between them.
pub(super) struct Web {
    samples: Vec<(Sample, Option<usize>)>,
    bridges: Vec<Bridge>,
    is_ring: bool,
}

/// A mode of a sample.
type Node = (usize, usize);

impl Web {
    /// The samples, each with the step that it is or stands for, and what lies between each and the next one: of a
    /// ring also between the last one and the first one.
    pub(super) fn of(nodes: Vec<(Sample, Option<usize>)>, spans: Vec<Span>, is_ring: bool) -> Self {
        let mut web = Self { samples: Vec::new(), bridges: Vec::new(), is_ring };
        let mut spans = spans.into_iter();
        for node in nodes {
            web.samples.push(node);
            if let Some((samples, bridges)) = spans.next() {
                web.samples.extend(samples.into_iter().map(|sample| (sample, None)));
                web.bridges.extend(bridges);
            }
        }
        web
    }

    /// The bridge on one side of a sample and the fate of a mode there.
    fn fate(&self, (sample, mode): Node, forwards: bool) -> Option<(usize, &Fate)> {
        if forwards {
            let bridge = self.bridges.get(sample)?;
            return Some((sample, &bridge.forwards[mode]));
        }
        let index = if sample > 0 { sample - 1 } else { self.bridges.len().checked_sub(1).filter(|_| self.is_ring)? };
        Some((index, &self.bridges[index].backwards[mode]))
    }

    /// The sample behind or before another one.
    fn neighbour(&self, sample: usize, forwards: bool) -> usize {
        let count = self.samples.len();
        if forwards { (sample + 1) % count } else { (sample + count - 1) % count }
    }

    /// The mode that a mode passes into without a limit position on the way.
    fn next(&self, node: Node, forwards: bool) -> Option<Node> {
        match self.fate(node, forwards)? {
            (_, Fate::On(mode, folds)) if folds.is_empty() => Some((self.neighbour(node.0, forwards), *mode)),
            _ => None,
        }
    }

    /// The branches and the limit positions in which they meet.
    pub(super) fn branches(&self, curve: &InputCurve, steps: &[Sample], range: Range) -> (Vec<Branch>, Vec<Limit>) {
        let nodes = || (0..self.samples.len()).flat_map(|s| (0..self.samples[s].0.modes.len()).map(move |m| (s, m)));
        let mut owner: Vec<Vec<Option<usize>>> =
            self.samples.iter().map(|(sample, _)| vec![None; sample.modes.len()]).collect();
        let mut paths: Vec<(Vec<Node>, bool)> = Vec::new();
        // Paths with a beginning come first; the rest are closed.
        for is_open in [true, false] {
            for start in nodes() {
                if owner[start.0][start.1].is_some() || (is_open && self.next(start, false).is_some()) {
                    continue;
                }
                let mut path = vec![start];
                owner[start.0][start.1] = Some(paths.len());
                let mut closed = false;
                while let Some(next) = self.next(path[path.len() - 1], true) {
                    if owner[next.0][next.1].is_some() {
                        closed = next == start;
                        break;
                    }
                    owner[next.0][next.1] = Some(paths.len());
                    path.push(next);
                }
                paths.push((path, closed));
            }
        }
        let borders = [steps.first(), steps.last()].map(|sample| sample.map_or(range.from, |sample| sample.input));
        let mut found = Found { web: self, curve, range, borders, limits: Vec::new(), keys: Vec::new() };
        let mut branches: Vec<Branch> = paths.iter().map(|(path, closed)| found.branch(path, *closed, steps)).collect();
        self.circuits(&mut branches, &paths, &owner);
        found.between(&mut branches, &owner);
        let mut limits = found.limits;
        for (index, branch) in branches.iter().enumerate() {
            for end in [&branch.begin, &branch.end] {
                if let End::Limit(limit) = end {
                    limits[*limit].branches.push(index);
                }
            }
        }
        sort_limits(&mut branches, &mut limits);
        (branches, limits)
    }

    /// Numbers the circuits.
    fn circuits(&self, branches: &mut [Branch], paths: &[(Vec<Node>, bool)], owner: &[Vec<Option<usize>>]) {
        let mut circuit: Vec<usize> = (0..branches.len()).collect();
        let mut unite = |a: usize, b: usize| {
            let (low, high) = (circuit[a].min(circuit[b]), circuit[a].max(circuit[b]));
            circuit.iter_mut().filter(|c| **c == high).for_each(|c| *c = low);
        };
        for (index, (path, _)) in paths.iter().enumerate() {
            for (node, forwards) in [(path[0], false), (path[path.len() - 1], true)] {
                let other = match self.fate(node, forwards) {
                    Some((_, Fate::Back(mode, _))) => Some((node.0, *mode)),
                    Some((_, Fate::On(mode, _))) => Some((self.neighbour(node.0, forwards), *mode)),
                    _ => None,
                };
                if let Some(other) = other.and_then(|(s, m)| owner[s][m]) {
                    unite(index, other);
                }
            }
        }
        let mut order: Vec<usize> = circuit.clone();
        order.sort_unstable();
        order.dedup();
        for (branch, own) in branches.iter_mut().zip(circuit) {
            branch.circuit = order.partition_point(|c| *c < own) + 1;
        }
    }
}

/// Puts the limit positions in the order of the sweep.
fn sort_limits(branches: &mut [Branch], limits: &mut Vec<Limit>) {
    let mut order: Vec<usize> = (0..limits.len()).collect();
    sort::by(&mut order, |a, b| limits[*a].input.total_cmp(&limits[*b].input));
    let sorted = order.iter().map(|index| limits[*index].clone()).collect();
    *limits = sorted;
    for end in branches.iter_mut().flat_map(|branch| [&mut branch.begin, &mut branch.end]) {
        if let End::Limit(limit) = end {
            *limit = order.iter().position(|index| index == limit).unwrap_or(*limit);
        }
    }
}

/// The branches found so far.
struct Found<'a> {
    web: &'a Web,
    curve: &'a InputCurve,
    range: Range,
    /// The first and the last input that were looked at.
    borders: [f64; 2],
    limits: Vec<Limit>,
    /// Bridge and number in it of every limit position.
    keys: Vec<(usize, usize)>,
}

impl Found<'_> {
    fn branch(&mut self, path: &[Node], closed: bool, steps: &[Sample]) -> Branch {
        let web = self.web;
        let span = self.range.to - self.range.from;
        let mut rows: Vec<Row> = Vec::new();
        let mut turn = 0;
        for (index, node) in path.iter().enumerate() {
            if index > 0 && node.0 == 0 {
                turn += 1;
            }
            let (sample, step) = &web.samples[node.0];
            let Some(step) = *step else { continue };
            if rows.last().is_some_and(|row| row.step == step && row.turn == turn) {
                continue;
            }
            #[expect(clippy::float_cmp, reason = "the very sample of the step")]
            let is_step = sample.input == steps[step].input;
            let mode = if is_step {
                Some(node.1)
            } else {
                // A stand-in beside a singular step or a critical input: the mode there that is nearest.
                let distance = |point| apart(self.curve, point, &sample.points[node.1]);
                let all = steps[step].points.iter().map(distance).enumerate();
                all.filter(|(_, d)| *d < 0.1).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(mode, _)| mode)
            };
            rows.extend(mode.map(|mode| Row { step, turn, mode }));
        }
        let (first, last) = (path[0], path[path.len() - 1]);
        let input = |node: Node| web.samples[node.0].0.input;
        if closed {
            let turns = path.iter().filter(|node| node.0 == 0).count().max(1);
            let (from, to) = (input(first), input(first) + turns as f64 * span);
            return Branch { circuit: 0, from, begin: End::Closed(turns), to, end: End::Closed(turns), rows };
        }
        let (begin, from) = self.end(first, false);
        let (end, to) = self.end(last, true);
        // An end between the end of a full turn and its beginning may be given by its input one turn away.
        let from = if (from - input(first)) * span > 0.0 { from - span } else { from };
        let to = if (to - input(last)) * span < 0.0 { to + span } else { to };
        Branch { circuit: 0, from, begin, to: to + turn as f64 * span, end, rows }
    }

    /// Returns the end of a branch at a node, and the input there.
    fn end(&mut self, node: Node, forwards: bool) -> (End, f64) {
        let web = self.web;
        let own = web.samples[node.0].0.input;
        match web.fate(node, forwards) {
            Some((_, Fate::Still)) => (End::Isolated, own),
            None if self.curve.is_rigid(&web.samples[node.0].0.points[node.1]) => (End::Isolated, own),
            None => {
                let border = self.borders[usize::from(forwards)];
                let step = (self.range.to - self.range.from) / self.range.steps as f64;
                // Beyond the last input of which anything is known nothing is known, short of the end of the range.
                if (own - border).abs() < 0.5 * step.abs() {
                    return (End::Range, own);
                }
                (End::Unresolved([own, if forwards { own + step } else { own - step }]), own)
            }
            Some((bridge, Fate::Back(_, folds) | Fate::On(_, folds) | Fate::Infinite(_, folds)))
                if !folds.is_empty() =>
            {
                let limit = self.limit(bridge, folds[0]);
                (End::Limit(limit), self.limits[limit].input)
            }
            Some((_, Fate::Infinite(input, _))) => (End::Infinite(*input), *input),
            Some(_) => {
                let other = web.samples[web.neighbour(node.0, forwards)].0.input;
                (End::Unresolved([own, other]), own)
            }
        }
    }

    /// Adds the branches from one limit position to the next within a step, which hold no mode of any input.
    fn between(&mut self, branches: &mut Vec<Branch>, owner: &[Vec<Option<usize>>]) {
        let web = self.web;
        let forward = self.range.to > self.range.from;
        for (index, bridge) in web.bridges.iter().enumerate() {
            let behind = web.neighbour(index, true);
            let sides = [(index, &bridge.forwards, true), (behind, &bridge.backwards, false)];
            for (sample, fates, is_forwards) in sides {
                for (mode, fate) in fates.iter().enumerate() {
                    // Every way is known from both of its ends.
                    let folds = match fate {
                        Fate::On(_, folds) if is_forwards => folds,
                        Fate::Back(other, folds) if mode < *other => folds,
                        Fate::Infinite(_, folds) => folds,
                        _ => continue,
                    };
                    let circuit = owner[sample][mode].map_or(0, |branch| branches[branch].circuit);
                    for pair in folds.windows(2) {
                        let mut ends = [self.limit(index, pair[0]), self.limit(index, pair[1])];
                        sort::by(&mut ends, |a, b| self.limits[*a].input.total_cmp(&self.limits[*b].input));
                        let [one, two] = if forward { ends } else { [ends[1], ends[0]] };
                        let [from, to] = [one, two].map(|limit| self.limits[limit].input);
                        let (begin, end) = (End::Limit(one), End::Limit(two));
                        branches.push(Branch { circuit, from, begin, to, end, rows: Vec::new() });
                    }
                    if let (Fate::Infinite(input, _), Some(last)) = (fate, folds.last()) {
                        let limit = self.limit(index, *last);
                        let ends = [(self.limits[limit].input, End::Limit(limit)), (*input, End::Infinite(*input))];
                        let [one, two] = ends;
                        let ((from, begin), (to, end)) =
                            if (one.0 < two.0) == forward { (one, two) } else { (two, one) };
                        branches.push(Branch { circuit, from, begin, to, end, rows: Vec::new() });
                    }
                }
            }
        }
    }

    /// The limit position that is this one of a bridge.
    fn limit(&mut self, bridge: usize, number: usize) -> usize {
        if let Some(known) = self.keys.iter().position(|key| *key == (bridge, number)) {
            return known;
        }
        let fold: &Fold = &self.web.bridges[bridge].folds[number];
        let mut q = self.curve.joints(&fold.point);
        for (value, variable) in q.iter_mut().zip(self.curve.variables()) {
            if *variable == Variable::Rotation {
                *value = wrapped(*value);
            }
        }
        let mut input = fold.point[INPUT] * self.curve.unit(INPUT);
        let span = self.range.to - self.range.from;
        if (input - self.range.to) * span > 0.0 {
            // Between the end of a full turn and its beginning.
            input -= span;
        }
        self.keys.push((bridge, number));
        self.limits.push(Limit { input, q, is_largest: fold.is_largest, branches: Vec::new() });
        self.limits.len() - 1
    }
}
