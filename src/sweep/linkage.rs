//! All assemblies of a linkage while one of its joints runs through a range.
//!
//! The list of assemblies at every step comes from the solver, with its verdict. Assemblies of neighbouring inputs are
//! joined where each is by far the nearest to the other; where they are not, the step is halved. Where two of them come
//! together and there are none beyond, the input turns back: the halving ends at that limit position.

use super::{End, Range};
use crate::algebra::number::Angle;
use crate::algebra::ring::exact_cos_sin;
use crate::assembly::wrapped;
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Gaussian, Given, Linkage, Pair};
use crate::linkage::answer::{LinkageMode, solve};
use crate::verdict::Status;
use num_complex::Complex;
use rayon::prelude::*;
use rug::Rational;
use std::f64::consts::TAU;

/// Steps in which assemblies appear or vanish are halved until they are this part of the range: limit positions are as
/// near.
const SMALLEST: f64 = 1e-11;
/// Beside them assemblies are close together: steps in which their number stays are halved further, to this part of those.
const FURTHER: f64 = 1e-3;
/// An assembly is followed to one at this part of the distance of any other, at most.
const NEARER: f64 = 0.35;
/// Largest distance of two such assemblies: radians, or parts of the size of the linkage.
const NEAR: f64 = 0.5;
/// Places at which a step is cut; the later ones serve where an assembly is double at the earlier ones.
const CUTS: [f64; 3] = [0.5, 0.463_017, 0.551_923];

/// The real assemblies at one input.
#[derive(Clone, Debug)]
pub struct LinkageSample {
    /// The input: radians, not reduced modulo 2 pi, or metres.
    pub input: f64,
    /// Whether the list is complete.
    pub status: Status,
    /// Why, or why not.
    pub reason: String,
    /// The real assemblies.
    pub modes: Vec<LinkageMode>,
    /// Whether all of them are simple and there are no others.
    is_regular: bool,
}

/// An assembly of a branch at one step.
#[derive(Clone, Debug)]
pub struct LinkageRow {
    /// The step, 0 for the first input.
    pub step: usize,
    /// The turn of the branch, from 0, where a full turn joins up.
    pub turn: usize,
    /// Index of the assembly among those of the sample.
    pub mode: usize,
}

/// Assemblies that pass into one another while the input moves one way.
#[derive(Clone, Debug)]
pub struct LinkageBranch {
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
    pub rows: Vec<LinkageRow>,
}

/// A limit position: two branches meet, and the input turns back.
#[derive(Clone, Debug)]
pub struct LinkageLimit {
    /// The input there.
    pub input: f64,
    /// Whether it is largest there, else smallest.
    pub is_largest: bool,
    /// The assembly there: in the middle between two that are nearly one.
    pub mode: LinkageMode,
    /// The branches that meet.
    pub branches: Vec<usize>,
}

/// The result of a sweep of a linkage.
#[derive(Clone, Debug)]
pub struct LinkageSweep {
    /// The joint that runs.
    pub joint: usize,
    /// The requested range.
    pub range: Range,
    /// The assemblies at the first input and at the end of every step.
    pub samples: Vec<LinkageSample>,
    /// The branches.
    pub branches: Vec<LinkageBranch>,
    /// The limit positions, in the order of the sweep.
    pub limits: Vec<LinkageLimit>,
    /// Whether the range is a full turn, whose end is its beginning.
    pub is_full_turn: bool,
}

impl LinkageSweep {
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

fn is_listed(status: Status) -> bool {
    matches!(status, Status::Complete | Status::Unreachable)
}

/// A joint that runs, while other values are given.
struct Run<'a> {
    linkage: &'a Linkage,
    joint: usize,
    held: Vec<Given>,
    /// The size of the linkage: places are compared in parts of it.
    size: f64,
}

impl Run<'_> {
    fn given(&self, input: f64) -> Result<Vec<Given>> {
        let (joint, line) = (self.joint, 1);
        let own = match &self.linkage.joints[joint].pair {
            Pair::Revolute => {
                let (re, im) = exact_cos_sin(&Angle::from_radians(input));
                Given::Turn { joint, turn: Gaussian { re, im }, line }
            }
            Pair::Prismatic { length, .. } => {
                let metres = Rational::from_f64(input);
                let metres =
                    metres.ok_or_else(|| Error::Invalid(format!("found the input {input}, expected a number")))?;
                Given::Shift { joint, shift: metres / length, line }
            }
            Pair::Gear { .. } => {
                return Err(Error::Invalid("found gears as the input, expected a joint with a value".to_owned()));
            }
        };
        Ok(self.held.iter().cloned().chain([own]).collect())
    }

    fn sample(&self, input: f64) -> Result<LinkageSample> {
        let answer = solve(self.linkage, &self.given(input)?, true)?;
        let status = answer.verdict.status;
        let modes: Vec<LinkageMode> = answer.modes.into_iter().filter(|mode| mode.real).collect();
        let is_regular = is_listed(status) && modes.iter().all(|mode| mode.multiplicity == 1);
        Ok(LinkageSample { input, status, reason: answer.verdict.reason, modes, is_regular })
    }

    /// The distance of two assemblies: the largest turn or step of a body.
    fn apart(&self, one: &LinkageMode, two: &LinkageMode) -> f64 {
        one.bodies.iter().zip(&two.bodies).fold(0.0, |worst, ((angle, place), (other, at))| {
            let turn = wrapped(angle.re - other.re).abs();
            let step = (place[0].re - at[0].re).hypot(place[1].re - at[1].re) / self.size;
            worst.max(turn).max(step)
        })
    }

    /// The distance from an assembly to the nearest other one of its sample.
    fn room(&self, sample: &LinkageSample, mode: usize) -> f64 {
        let others = (0..sample.modes.len()).filter(|other| *other != mode);
        others.map(|other| self.apart(&sample.modes[mode], &sample.modes[other])).fold(f64::INFINITY, f64::min)
    }

    /// The assemblies of one sample that pass into those of the next, as far as that is clear.
    fn passes(&self, one: &LinkageSample, two: &LinkageSample) -> Vec<Option<usize>> {
        let nearest = |mode: &LinkageMode, of: &LinkageSample| {
            let all = of.modes.iter().map(|other| self.apart(mode, other)).enumerate();
            all.min_by(|a, b| a.1.total_cmp(&b.1))
        };
        let pass = |(k, mode): (usize, &LinkageMode)| {
            let (other, distance) = nearest(mode, two)?;
            let is_mutual = nearest(&two.modes[other], one)?.0 == k;
            let room = self.room(one, k).min(self.room(two, other));
            (is_mutual && distance < NEAR && distance < NEARER * room).then_some(other)
        };
        one.modes.iter().enumerate().map(pass).collect()
    }

    /// The pair of assemblies that come together, of those that pass into none.
    fn fold(&self, sample: &LinkageSample, left: &[usize]) -> Option<[usize; 2]> {
        let pairs = left.iter().enumerate().flat_map(|(k, a)| left[k + 1..].iter().map(move |b| [*a, *b]));
        let distance = |[a, b]: &[usize; 2]| self.apart(&sample.modes[*a], &sample.modes[*b]);
        pairs.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Samples between two, and the links from each sample to the next.
    fn between(&self, one: &LinkageSample, two: &LinkageSample, least: f64, found: &mut Between) -> Result<()> {
        let passes = self.passes(one, two);
        let lost: Vec<usize> = (0..one.modes.len()).filter(|k| passes[*k].is_none()).collect();
        let new: Vec<usize> = (0..two.modes.len()).filter(|k| !passes.contains(&Some(*k))).collect();
        let is_whole = lost.is_empty() && new.is_empty();
        let least_here = if one.modes.len() == two.modes.len() { FURTHER * least } else { least };
        if is_whole || (two.input - one.input).abs() < least_here {
            // The assemblies left after all halving meet in pairs, or are unresolved.
            let pairs = |sample: &LinkageSample, mut left: Vec<usize>| {
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
            let middle = self.sample(one.input + cut * (two.input - one.input))?;
            if middle.is_regular {
                self.between(one, &middle, least, found)?;
                found.samples.push(middle.clone());
                return self.between(&middle, two, least, found);
            }
        }
        found.links.push(Link { passes, folds: [Vec::new(), Vec::new()], is_ring: false });
        Ok(())
    }
}

/// Samples between two others, and the links from each to the next.
#[derive(Default)]
struct Between {
    samples: Vec<LinkageSample>,
    links: Vec<Link>,
}

/// The connections of the assemblies of a sample to those of the next one.
struct Link {
    /// For every assembly, the one of the next sample into which it passes.
    passes: Vec<Option<usize>>,
    /// Pairs that come together behind the sample, and pairs that come from one before the next sample.
    folds: [Vec<[usize; 2]>; 2],
    /// Whether it leads from the end of a full turn to its beginning.
    is_ring: bool,
}

/// Sweeps a joint of a linkage, on all threads of the current pool, while the other given values are held.
///
/// # Errors
/// [`Error::Invalid`] for empty ranges and gears; as [`solve`].
pub fn sweep_linkage(
    linkage: &Linkage,
    given: &[Given],
    joint: usize,
    range: Range,
    tick: impl Fn() + Sync,
) -> Result<LinkageSweep> {
    if !(range.from - range.to).is_normal() || range.steps == 0 {
        let message = format!("found a range from {} to {} in {} steps", range.from, range.to, range.steps);
        return Err(Error::Invalid(format!("{message}, expected two different ends and a step at least")));
    }
    let is_other = |one: &&Given| !matches!(one, Given::Turn { joint: own, .. } | Given::Shift { joint: own, .. } if *own == joint);
    let held = given.iter().filter(is_other).cloned().collect();
    let points = linkage.bodies.iter().flat_map(|body| &body.points);
    let size = points.map(|(_, at)| at.re.to_f64().hypot(at.im.to_f64())).fold(1e-9, f64::max);
    let run = Run { linkage, joint, held, size };
    let solved = (0..=range.steps).into_par_iter().map(|step| {
        let sample = run.sample(range.input(step));
        tick();
        sample
    });
    let samples: Vec<LinkageSample> = solved.collect::<Result<_>>()?;
    let turn = !linkage.joints[joint].is_prismatic();
    let is_full_turn = turn && ((range.to - range.from).abs() - TAU).abs() < 1e-12;
    let regular: Vec<usize> = (0..samples.len()).filter(|step| samples[*step].is_regular).collect();
    let least = SMALLEST * (range.to - range.from).abs().max(1.0);
    let spans: Vec<(Between, usize)> = regular
        .par_windows(2)
        .map(|pair| {
            let mut found = Between::default();
            run.between(&samples[pair[0]], &samples[pair[1]], least, &mut found)?;
            Ok((found, pair[1]))
        })
        .collect::<Result<_>>()?;
    let mut nodes: Vec<(LinkageSample, Option<usize>)> = Vec::new();
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
        let passes = run.passes(last, first);
        links.push(Link { passes, folds: [Vec::new(), Vec::new()], is_ring: true });
    }
    let web = Web { nodes, links, range };
    let (branches, limits) = web.branches(ends);
    Ok(LinkageSweep { joint, range, samples, branches, limits, is_full_turn })
}

/// An assembly of a node.
type Place = (usize, usize);

/// Samples in a row with the links between them.
struct Web {
    nodes: Vec<(LinkageSample, Option<usize>)>,
    links: Vec<Link>,
    range: Range,
}

impl Web {
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

    fn branches(&self, ends: [bool; 2]) -> (Vec<LinkageBranch>, Vec<LinkageLimit>) {
        let mut owner: Vec<Vec<bool>> = self.nodes.iter().map(|(sample, _)| vec![false; sample.modes.len()]).collect();
        let places = || (0..self.nodes.len()).flat_map(|n| (0..self.nodes[n].0.modes.len()).map(move |m| (n, m)));
        let mut keys: Vec<(usize, usize, usize)> = Vec::new();
        let mut limits: Vec<LinkageLimit> = Vec::new();
        let mut branches: Vec<LinkageBranch> = Vec::new();
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
                        return (End::Limit(known), limits[known].input);
                    }
                    let is_border =
                        if forwards { place.0 + 1 == self.nodes.len() && ends[1] } else { place.0 == 0 && ends[0] };
                    if is_border && !self.links.iter().any(|link| link.is_ring) {
                        return (End::Range, input);
                    }
                    let beside = if forwards { place.0 + 1 } else { place.0.wrapping_sub(1) };
                    let other = self.nodes.get(beside).map_or(input, |(sample, _)| sample.input);
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
                branches.push(LinkageBranch { circuit: 0, from, begin, to, end: finish, rows: self.rows(&path) });
            }
        }
        circuits(&mut branches, &limits);
        sorted(&mut branches, &limits, self.range)
    }

    fn rows(&self, path: &[Place]) -> Vec<LinkageRow> {
        let mut turn = 0;
        let mut rows = Vec::new();
        for (k, (node, mode)) in path.iter().enumerate() {
            if k > 0 && *node == 0 {
                turn += 1;
            }
            if let Some(step) = self.nodes[*node].1 {
                rows.push(LinkageRow { step, turn, mode: *mode });
            }
        }
        rows
    }

    fn limit(&self, (link, side, number): (usize, usize, usize)) -> LinkageLimit {
        let (one, two) = (&self.nodes[link].0, &self.nodes[link + 1].0);
        let sample = if side == 0 { one } else { two };
        let [a, b] = self.links[link].folds[side][number].map(|mode| &sample.modes[mode]);
        let is_upwards = self.range.to > self.range.from;
        LinkageLimit {
            input: 0.5 * (one.input + two.input),
            is_largest: (side == 0) == is_upwards,
            mode: middle(a, b),
            branches: Vec::new(),
        }
    }
}

/// The assembly between two that are nearly one.
fn middle(one: &LinkageMode, two: &LinkageMode) -> LinkageMode {
    let between = |a: f64, b: f64, is_turn: bool| {
        if is_turn { wrapped(a + 0.5 * wrapped(b - a)) } else { 0.5 * (a + b) }
    };
    let mut mode = one.clone();
    for ((own, (angle, place)), (other, at)) in mode.bodies.iter_mut().zip(&one.bodies).zip(&two.bodies) {
        own.0 = Complex::new(between(angle.re, other.re, true), 0.0);
        own.1 = [0, 1].map(|k| Complex::new(between(place[k].re, at[k].re, false), 0.0));
    }
    for (own, other) in mode.joints.iter_mut().zip(&two.joints) {
        if let (Some(own), Some(other)) = (own, other) {
            // Displacements that are nearly one are nearer than a half turn.
            let step = if (other.re - own.re).abs() > 1.0 { wrapped(other.re - own.re) } else { other.re - own.re };
            *own = Complex::new(own.re + 0.5 * step, 0.0);
        }
    }
    mode
}

/// Numbers the circuits.
fn circuits(branches: &mut [LinkageBranch], limits: &[LinkageLimit]) {
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
fn sorted(
    branches: &mut Vec<LinkageBranch>,
    limits: &[LinkageLimit],
    range: Range,
) -> (Vec<LinkageBranch>, Vec<LinkageLimit>) {
    let sign = (range.to - range.from).signum();
    let mut order: Vec<usize> = (0..limits.len()).collect();
    order.sort_by(|a, b| (sign * limits[*a].input).total_cmp(&(sign * limits[*b].input)));
    for end in branches.iter_mut().flat_map(|branch| [&mut branch.begin, &mut branch.end]) {
        if let End::Limit(limit) = end {
            *limit = order.iter().position(|own| own == limit).unwrap_or(*limit);
        }
    }
    let limits = order.iter().map(|own| limits[*own].clone()).collect();
    (std::mem::take(branches), limits)
}
