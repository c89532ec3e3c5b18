//! The number of assemblies of a linkage that falls into many dyads, and those near given joint values, without a list of all.
//!
//! Dyads are solved one after the other, branch by branch, and only the branch that is followed is kept. Where the groups that are left
//! fall into parts that share no body but those at rest, each part is counted by itself, and the numbers are multiplied.

use super::assembly::started;
use super::bounded_half::{BoundedHalf, Followed};
use super::equations::Closure;
use super::groups::Group;
use super::isotropic::turn_within;
use super::near::off;
use super::quadratic::{Decidable, Root, Solved, one_cycle, realness};
use super::state::{State, number, place_of, turned};
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::{Given, Linkage, Pair};
use num_complex::Complex;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::sync::atomic::{self, AtomicBool};

/// Most dyads that are solved for a number: some minutes.
const MOST_STEPS: usize = 1 << 24;
/// Most branches that wait while the nearest assemblies are looked for: each holds the places of all bodies.
const MOST_OPEN: usize = 1 << 14;
/// Assemblies that are listed beside given joint values: as many as a general arm has.
pub const MOST_NEAR: usize = 16;
/// Real assemblies that are listed where none is the nearest one: as many as a page of a table or two.
pub const MOST_REAL: usize = 128;

/// Numbers of assemblies, with multiplicity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Count {
    /// All of them.
    pub complex: usize,
    /// The real ones.
    pub real: usize,
}

/// Why assemblies were not counted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Halt {
    /// The search was ended.
    Stopped,
    /// There are too many branches.
    TooMany,
    /// A question is open, which finer numbers may decide.
    Undecided(String),
    /// A question is left open.
    Open(String),
}

impl Count {
    const ONE: Self = Self { complex: 1, real: 1 };

    fn times(self, other: Self) -> Result<Self, Halt> {
        let product = |a: usize, b: usize| a.checked_mul(b).ok_or(Halt::TooMany);
        Ok(Self { complex: product(self.complex, other.complex)?, real: product(self.real, other.real)? })
    }
}

/// Real assemblies near values of joints.
pub struct Nearest {
    /// The nearest ones, nearest first.
    pub states: Vec<State>,
    /// Whether there are no others.
    pub is_all: bool,
}

/// A linkage that falls into dyads.
pub struct Dyads<'a> {
    linkage: &'a Linkage,
    given: &'a [Given],
    groups: &'a [Group],
    stop: &'a AtomicBool,
}

/// The solution of a group that a branch goes through: the group, and the rotations of its classes.
#[derive(Clone)]
struct Step {
    group: usize,
    turns: Vec<BoundedHalf<f64>>,
}

/// A solution of a group: the branch with it, the step to it, and its multiplicity.
struct Next<R> {
    state: State<R>,
    step: Step,
    multiplicity: usize,
}

fn left_open<T>(reason: &str) -> Result<T, Halt> {
    Err(Halt::Undecided(reason.to_owned()))
}

impl<'a> Dyads<'a> {
    /// Returns the linkage as one of dyads; `None` where a group is none.
    #[must_use]
    pub fn of(linkage: &'a Linkage, given: &'a [Given], groups: &'a [Group], stop: &'a AtomicBool) -> Option<Self> {
        let is_dyad = |group: &Group| group.gears.is_empty() && group.joints.len() == 3;
        groups.iter().all(is_dyad).then_some(Self { linkage, given, groups, stop })
    }

    /// Returns the branch in which only what is given is placed. Enclosed angles stay enclosed in every kind of numbers.
    fn start<R: Followed>(&self) -> Result<State<R>, Halt> {
        let place = |linkage: &Linkage, given: &Given| {
            let Given::Turn { joint, within: Some(within), .. } = given else { return place_of(linkage, given) };
            Some(turned(linkage, *joint, turn_within(within).map(R::within)))
        };
        started(self.linkage, self.given, place).map_err(|error| Halt::Open(error.to_string()))
    }

    /// Returns the solutions of a group in a branch.
    fn solutions<R: Followed>(&self, state: &State<R>, group: usize, is_last: bool) -> Result<Vec<Next<R>>, Halt> {
        let Some(closure) = Closure::new(self.linkage, &self.groups[group], state) else { return left_open("a group") };
        let roots = match one_cycle(&closure.equations, &state.top) {
            Solved::Roots(roots) => roots,
            Solved::Moving(_) => {
                return left_open("a dyad moves by itself there: its ends coincide, or its slides are parallel");
            }
            Solved::Undecided(reason) => return Err(Halt::Undecided(reason)),
        };
        let real =
            if state.real { realness(&roots, &closure.equations.squares) } else { vec![Some(false); roots.len()] };
        let one = |(root, real): (Root<R>, Option<bool>)| {
            let Some(real) = real else { return left_open("an assembly is neither proved real nor proved complex") };
            // Nothing stands on the last group: it is counted where it is.
            let mut next = if is_last { State::new(0, 0) } else { closure.assembled(state, &root.turns, &root.shifts) };
            next.real = real;
            next.multiplicity *= root.multiplicity;
            next.top.hold(&root);
            let turns = root.turns.iter().chain(&root.shifts).map(|number| number.z.rough()).collect();
            Ok(Next { state: next, step: Step { group, turns }, multiplicity: root.multiplicity })
        };
        roots.into_iter().zip(real).map(one).collect()
    }

    /// Returns the branch that these steps lead to, in other numbers.
    fn retraced<R: Followed>(&self, path: &[Step]) -> Result<State<R>, Halt> {
        let mut state = self.start::<R>()?;
        for step in path {
            let apart = |next: &Next<R>| {
                next.step.turns.iter().zip(&step.turns).any(|(a, b)| a.sub(b).vanishes() == Some(false))
            };
            let mut close = self.solutions(&state, step.group, false)?.into_iter().filter(|next| !apart(next));
            let (Some(one), None) = (close.next(), close.next()) else {
                return left_open("two assemblies of a dyad are not told apart");
            };
            state = one.state;
        }
        Ok(state)
    }

    /// Returns the groups in parts that share no cluster but the one at rest.
    fn parts<R: Ring>(&self, state: &State<R>, groups: &[usize]) -> Vec<Vec<usize>> {
        if let [_] = groups {
            return vec![groups.to_vec()];
        }
        let cluster = |body: usize| state.bodies[body].0;
        let rest = cluster(self.linkage.ground);
        // The clusters of every part, and its groups.
        let mut parts: Vec<(Vec<usize>, Vec<usize>)> = Vec::new();
        for &group in groups {
            // The bodies that joints connect: what stands for a cluster may be at rest where its others are not yet.
            let bodies = self.groups[group].joints.iter().flat_map(|joint| self.linkage.joints[*joint].of);
            let own: Vec<usize> = bodies.map(cluster).filter(|name| *name != rest).collect();
            let mut joined = (own, vec![group]);
            let mut others = Vec::with_capacity(parts.len() + 1);
            for part in parts {
                if part.0.iter().any(|name| joined.0.contains(name)) {
                    joined.0.extend(part.0);
                    joined.1.extend(part.1);
                } else {
                    others.push(part);
                }
            }
            others.push(joined);
            parts = others;
        }
        let in_order = |(_, mut groups): (Vec<usize>, Vec<usize>)| {
            // Groups are solved in the order of the list.
            groups.sort_unstable();
            groups
        };
        parts.into_iter().map(in_order).collect()
    }

    /// Returns the number of assemblies.
    ///
    /// # Errors
    /// Where the search is ended, there are too many branches, or a question is open.
    pub fn count(&self) -> Result<Count, Halt> {
        let all: Vec<usize> = (0..self.groups.len()).collect();
        let mut walk = Walk { dyads: self, path: Vec::new(), steps: 0 };
        walk.count(&self.start::<BoundedHalf<f64>>()?, &all)
    }

    /// Returns the real assemblies, so many at most, that are nearest to these values of joints, radians or metres. Joints without
    /// a value do not count.
    ///
    /// # Errors
    /// As [`Dyads::count`].
    pub fn nearest(&self, near: &[Option<f64>], most: usize) -> Result<Nearest, Halt> {
        let mut open = BinaryHeap::new();
        open.push(Open { cost: 0.0, path: Vec::new(), state: self.start::<BoundedHalf<f64>>()? });
        let mut states = Vec::new();
        // The cost of a branch is no more than that of what it leads to: what is taken first is nearest.
        while let Some(Open { cost, path, state }) = open.pop() {
            if self.stop.load(atomic::Ordering::Relaxed) {
                return Err(Halt::Stopped);
            }
            if path.len() == self.groups.len() {
                states.push(self.listed(&path)?);
                if states.len() == most {
                    return Ok(Nearest { states, is_all: open.is_empty() });
                }
                continue;
            }
            if open.len() > MOST_OPEN {
                return if states.is_empty() { Err(Halt::TooMany) } else { Ok(Nearest { states, is_all: false }) };
            }
            let next = match self.solutions(&state, path.len(), false) {
                Err(Halt::Undecided(reason)) => self.finer_solutions::<BoundedHalf<f64>>(&path, reason),
                next => next,
            };
            for next in next?.into_iter().filter(|next| next.state.real) {
                let off: f64 = self.groups[path.len()]
                    .joints
                    .iter()
                    .filter_map(|joint| Some(self.off(&next.state, *joint, near[*joint]?)))
                    .map(|off| off * off)
                    .sum();
                let mut path = path.clone();
                path.push(next.step);
                open.push(Open { cost: cost + off, path, state: next.state });
            }
        }
        Ok(Nearest { states, is_all: true })
    }

    /// Returns the solutions of the group behind a path, found in numbers that decide more than these.
    fn finer_solutions<R: Followed>(&self, path: &[Step], reason: String) -> Result<Vec<Next<BoundedHalf<f64>>>, Halt> {
        if !R::HAS_FINER {
            return Err(Halt::Open(reason));
        }
        let state = self.retraced::<R::Finer>(path);
        match state.and_then(|state| self.solutions(&state, path.len(), false)) {
            Err(Halt::Undecided(reason)) => self.finer_solutions::<R::Finer>(path, reason),
            Err(halt) => Err(halt),
            Ok(list) => {
                let rough = |Next { state, step, multiplicity }: Next<R::Finer>| Next {
                    state: state.map(Followed::rough),
                    step,
                    multiplicity,
                };
                Ok(list.into_iter().map(rough).collect())
            }
        }
    }

    /// Returns by how much a joint misses a value, full turns apart.
    fn off(&self, state: &State<BoundedHalf<f64>>, joint: usize, near: f64) -> f64 {
        let own = &self.linkage.joints[joint];
        let place = state.against(own.of[1], own.of[0]);
        let value = match &own.pair {
            Pair::Prismatic { along, length, .. } => {
                let gap = place.apply(&number(&own.at[1])).sub(&number(&own.at[0]));
                let along = Complex::new(along.re.to_f64(), along.im.to_f64());
                (gap.z.middle() / along).re * length.to_f64()
            }
            _ => place.turn.z.middle().arg(),
        };
        off(own, value, near)
    }

    /// Returns an assembly as it is listed, in more digits than the search needs.
    fn listed(&self, path: &[Step]) -> Result<State, Halt> {
        type Finer = <BoundedHalf<f64> as Followed>::Finer;
        let Ok(fine) = self.retraced::<Finer>(path) else { return self.retraced(path) };
        Ok(fine.map(Followed::value))
    }
}

/// A branch that waits.
struct Open {
    cost: f64,
    path: Vec<Step>,
    state: State<BoundedHalf<f64>>,
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    /// The nearest branch is the greatest; of equal ones the one that is farther on.
    fn cmp(&self, other: &Self) -> Ordering {
        other.cost.total_cmp(&self.cost).then_with(|| self.path.len().cmp(&other.path.len()))
    }
}

/// A walk through all branches.
struct Walk<'a> {
    dyads: &'a Dyads<'a>,
    path: Vec<Step>,
    steps: usize,
}

impl Walk<'_> {
    /// Counts the assemblies of these groups in a branch.
    fn count<R: Followed>(&mut self, state: &State<R>, groups: &[usize]) -> Result<Count, Halt> {
        let mut product = Count::ONE;
        for part in self.dyads.parts(state, groups) {
            let own = match self.count_part(state, &part) {
                Err(Halt::Undecided(reason)) => self.count_finer::<R>(&part, reason),
                own => own,
            };
            product = product.times(own?)?;
        }
        Ok(product)
    }

    /// Counts the assemblies of groups that form one part in numbers that decide more than these.
    fn count_finer<R: Followed>(&mut self, part: &[usize], reason: String) -> Result<Count, Halt> {
        if !R::HAS_FINER {
            return Err(Halt::Open(reason));
        }
        let state = self.dyads.retraced::<R::Finer>(&self.path);
        match state.and_then(|state| self.count_part(&state, part)) {
            Err(Halt::Undecided(reason)) => self.count_finer::<R::Finer>(part, reason),
            own => own,
        }
    }

    /// Counts the assemblies of groups that form one part.
    fn count_part<R: Followed>(&mut self, state: &State<R>, part: &[usize]) -> Result<Count, Halt> {
        let Some((first, rest)) = part.split_first() else { return Ok(Count::ONE) };
        self.steps += 1;
        if self.dyads.stop.load(atomic::Ordering::Relaxed) {
            return Err(Halt::Stopped);
        }
        if self.steps > MOST_STEPS {
            return Err(Halt::TooMany);
        }
        let mut sum = Count { complex: 0, real: 0 };
        for next in self.dyads.solutions(state, *first, rest.is_empty())? {
            let is_real = next.state.real;
            let below = if rest.is_empty() {
                Count::ONE
            } else {
                self.path.push(next.step);
                let below = self.count(&next.state, rest);
                self.path.pop();
                below?
            };
            let own =
                below.times(Count { complex: next.multiplicity, real: if is_real { next.multiplicity } else { 0 } })?;
            let total = |a: usize, b: usize| a.checked_add(b).ok_or(Halt::TooMany);
            sum = Count { complex: total(sum.complex, own.complex)?, real: total(sum.real, own.real)? };
        }
        Ok(sum)
    }
}
