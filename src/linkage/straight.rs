//! Cycles of slides alone: nothing turns in them, and their closure is linear.
//!
//! All bodies of such a cycle keep their rotation against one another. Going round, the angles between the slides add up to a full
//! turn or the cycle never closes; that is a condition on the data. The rest is two linear equations for every cycle in the displacements:
//! one assembly, none, or a linear set of as many dimensions as the equations leave displacements free.

use super::assembly::Link;
use super::equations::Equations;
use super::groups::{Group, Groups, Merged};
use super::isotropic::Isotropic;
use super::quadratic::{Decidable, Moving, Root, Solved, scalar, undecided};
use super::state::{Place, State, number};
use super::tower::Surd;
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::{Gaussian, Linkage, Pair};
use rug::Rational;

/// Values of the displacements that are free, in parts of their directions: the first may be a special one, at which what stands on the
/// group does not close.
const TRIED: [(i32, i32); 5] = [(0, 1), (1, 2), (-1, 3), (2, 1), (-3, 1)];

/// Counts the freedoms of groups again: a cycle of slides alone closes by two equations, and not by three, so that it has one freedom more.
/// `joints` are those that are not given. A group that has more joints than hold it together, and stands on one that moves by count, is one with it and with what stands between.
#[must_use]
pub fn with_slides(linkage: &Linkage, joints: &[Link], groups: Groups, merged: &Merged) -> Groups {
    let mut list: Vec<Group> = Vec::new();
    let mut now = merged.clone();
    for mut group in groups.list {
        group.count += i64::try_from(slide_cycles(linkage, &group.joints, &now)).unwrap_or(i64::MAX / 8);
        let carries = |below: &Group, now: &mut Merged| {
            let root = below.clusters.first().map(|body| now.root(*body));
            root.is_some_and(|root| group.clusters.iter().any(|body| now.root(*body) == root))
        };
        let mut moving = list.iter().filter(|_| group.count < 0);
        let first = moving.position(|below| below.count > 0 && carries(below, &mut now));
        if let Some(first) = first {
            let (inside, kept): (Vec<_>, Vec<_>) =
                list.drain(..).enumerate().partition(|(k, below)| *k >= first && carries(below, &mut now));
            list.extend(kept.into_iter().map(|(_, below)| below));
            now = merged.clone();
            for below in &list {
                unite(&mut now, below);
            }
            let inside: Vec<Group> = inside.into_iter().map(|(_, below)| below).collect();
            group = as_one(group, inside, &mut now);
        }
        unite(&mut now, &group);
        list.push(group);
    }
    let mut is_open = |joint: &usize| {
        let [a, b] = linkage.joints[*joint].of.map(|body| now.root(body));
        a != b
    };
    let open: Vec<usize> = joints.iter().map(|(joint, _)| *joint).filter(&mut is_open).collect();
    let freedoms = groups.freedoms + slide_cycles(linkage, &open, &now);
    Groups { list, freedoms }
}

/// Makes one group of a group and of those below it, where `merged` holds what is solved before all of them.
fn as_one(mut group: Group, below: Vec<Group>, merged: &mut Merged) -> Group {
    for one in below {
        group.clusters.extend(one.clusters);
        group.joints.extend(one.joints);
        group.gears.extend(one.gears);
        group.count += one.count;
    }
    group.joints.sort_unstable();
    let mut names: Vec<usize> = group.clusters.iter().map(|body| merged.root(*body)).collect();
    names.sort_unstable();
    names.dedup();
    Group { clusters: names, ..group }
}

/// Returns the groups with one of them and all that it stands on as one; `None` where it stands on none, or where there are gears.
pub(super) fn with_foundations(list: &[Group], at: usize, merged: &Merged) -> Option<Vec<Group>> {
    let (before, later) = list.split_at_checked(at)?;
    let (group, later) = later.split_first()?;
    let mut now = merged.clone();
    for below in before {
        unite(&mut now, below);
    }
    let roots: Vec<usize> = group.clusters.iter().map(|body| now.root(*body)).collect();
    let (mut inside, mut kept): (Vec<&Group>, Vec<&Group>) = (Vec::new(), Vec::new());
    for below in before {
        let carries = below.clusters.first().is_some_and(|body| roots.contains(&now.root(*body)));
        if carries { &mut inside } else { &mut kept }.push(below);
    }
    if inside.is_empty() || inside.iter().chain([&group]).any(|one| !one.gears.is_empty()) {
        return None;
    }
    let mut now = merged.clone();
    for below in &kept {
        unite(&mut now, below);
    }
    let whole = as_one(group.clone(), inside.into_iter().cloned().collect(), &mut now);
    kept.push(&whole);
    kept.extend(later);
    Some(kept.into_iter().cloned().collect())
}

/// Makes one cluster of those of a group.
pub(super) fn unite(merged: &mut Merged, group: &Group) {
    for pair in group.clusters.windows(2) {
        merged.merge(pair[0], pair[1]);
    }
}

/// Returns the number of independent cycles of slides alone among these joints.
fn slide_cycles(linkage: &Linkage, joints: &[usize], merged: &Merged) -> usize {
    let slides = || joints.iter().map(|joint| &linkage.joints[*joint]).filter(|joint| joint.is_prismatic());
    if slides().count() < 2 {
        return 0;
    }
    let mut slid = merged.clone();
    slides().filter(|joint| !slid.merge(joint.of[0], joint.of[1])).count()
}

/// Returns a branch in which the clusters of a group stand so that the bodies of its slides have exact rotations, as far as the slides and inputs
/// within each cluster determine them: bodies that these join keep their rotations against one another, whatever the numbers of the branch.
pub(super) fn with_known_turns(linkage: &Linkage, group: &Group, start: &State, state: &State) -> State {
    let mut next = state.clone();
    let mut seen = Vec::new();
    let slides = group.joints.iter().map(|joint| &linkage.joints[*joint]).filter(|joint| joint.is_prismatic());
    let bodies: Vec<usize> = slides.flat_map(|joint| joint.of).collect();
    for body in bodies.iter().copied() {
        let (cluster, place) = &state.bodies[body];
        // One slide by itself has an angle with no other.
        let is_one = bodies.iter().filter(|other| state.bodies[**other].0 == *cluster).count() < 2;
        if is_one || seen.contains(cluster) || place.turn.z.exact.is_some() {
            continue;
        }
        seen.push(*cluster);
        let back = Place { turn: place.turn.mirrored(), origin: Isotropic::zero() };
        next.move_cluster(*cluster, *cluster, &back);
        for (other, turn) in held_turns(linkage, start, state, body) {
            next.bodies[other].1.turn = number(&turn);
        }
    }
    next
}

/// The bodies of a cluster whose rotations against one of them follow from slides and inputs within it, with these rotations.
fn held_turns(linkage: &Linkage, start: &State, state: &State, body: usize) -> Vec<(usize, Gaussian)> {
    let conjugate = |z: &Gaussian| Gaussian { re: z.re.clone(), im: Rational::from(-&z.im) };
    let exactly = |body: usize| {
        let turn = &start.bodies[body].1.turn;
        let own = start.squares[body].is_none().then(|| turn.z.exact.as_ref().and_then(Surd::to_gaussian)).flatten();
        // Of a complex branch the conjugate is no inverse.
        own.filter(|own| own.mul(&conjugate(own)) == Gaussian::one())
    };
    let mut found = vec![(body, Gaussian::one())];
    let mut next = 0;
    while let Some((here, turn)) = found.get(next).cloned() {
        next += 1;
        let mut reached: Vec<(usize, Gaussian)> = Vec::new();
        for joint in &linkage.joints {
            let Pair::Prismatic { turn: step, .. } = &joint.pair else { continue };
            match joint.of {
                [a, b] if a == here => reached.push((b, turn.mul(step))),
                [a, b] if b == here => reached.push((a, turn.mul(&conjugate(step)))),
                _ => {}
            }
        }
        if let Some(own) = exactly(here) {
            let glued = (0..start.bodies.len()).filter(|other| start.bodies[*other].0 == start.bodies[here].0);
            let back = turn.mul(&conjugate(&own));
            reached.extend(glued.filter_map(|other| Some((other, back.mul(&exactly(other)?)))));
        }
        // A joint with a body of another cluster is not closed yet.
        for (other, turn) in reached.into_iter().filter(|(other, _)| state.bodies[*other].0 == state.bodies[body].0) {
            if found.iter().all(|(known, _)| *known != other) {
                found.push((other, turn));
            }
        }
    }
    found
}

/// Returns what is known of a group of which a cycle of slides alone does not close in its angles, or may not; `None` where all do.
pub(super) fn open_angles<R: Decidable>(equations: &Equations<Isotropic<R>>) -> Option<Solved<R>> {
    let closes = |gap: &Isotropic<R>| match (gap.z.vanishes(), gap.w.vanishes()) {
        (Some(false), _) | (_, Some(false)) => Some(false),
        (Some(true), Some(true)) => Some(true),
        _ => None,
    };
    let found: Vec<Option<bool>> = equations.angles.iter().map(closes).collect();
    if found.contains(&Some(false)) {
        return Some(Solved::Roots(Vec::new()));
    }
    found.contains(&None).then(|| undecided("the angle round a cycle of slides"))
}

/// Solves a group in which nothing turns, of any number of cycles, whose angles close.
pub(super) fn slides_alone<R: Decidable>(equations: &Equations<Isotropic<R>>) -> Solved<R> {
    let slides = equations.slides.len();
    let rows = (0..equations.loops()).flat_map(|k| {
        let side = |part: fn(&Isotropic<R>) -> &R| -> Vec<R> {
            let own = equations.slides.iter().map(|slide| part(&slide.coefficients[k]).clone());
            own.chain([part(&equations.cycles[k][0]).clone()]).collect()
        };
        [side(|n| &n.z), side(|n| &n.w)]
    });
    let solved = match Solution::of(rows.collect(), slides) {
        Ok(Some(solved)) => solved,
        Ok(None) => return Solved::Roots(Vec::new()),
        Err(what) => return undecided(what),
    };
    let free: Vec<usize> = (0..slides).filter(|slide| solved.row_of(*slide).is_none()).collect();
    let root = |value: &R| Root {
        turns: vec![Isotropic::one()],
        shifts: (0..slides).map(|slide| scalar(&solved.value(slide, &free, value))).collect(),
        multiplicity: 1,
    };
    if free.is_empty() {
        return Solved::Roots(vec![root(&R::zero())]);
    }
    let value = |(p, q): &(i32, i32)| R::from_rational(&Rational::from((*p, *q))).unwrap_or_else(R::zero);
    let samples = TRIED.iter().map(|tried| root(&value(tried))).collect();
    let way = |moved: &usize| {
        let moves = |slide: usize| match solved.row_of(slide) {
            Some(row) => row[*moved].vanishes() != Some(true),
            None => slide == *moved,
        };
        let slides = (0..slides).map(|slide| f64::from(u8::from(moves(slide))));
        [0.0].into_iter().chain(slides).collect()
    };
    Solved::Moving(Moving { samples, ways: free.iter().map(way).collect() })
}

/// Linear equations that are solved: a row for each displacement that the others determine, with 1 in its column and 0 in those of the
/// others that are determined. The last entry is the constant.
struct Solution<R> {
    pivots: Vec<usize>,
    rows: Vec<Vec<R>>,
}

impl<R: Decidable> Solution<R> {
    /// Solves equations; `Ok(None)` where they contradict one another, and an error where an entry is not decided.
    fn of(mut open: Vec<Vec<R>>, columns: usize) -> Result<Option<Self>, &'static str> {
        let mut solved = Self { pivots: Vec::new(), rows: Vec::new() };
        loop {
            let entry = open.iter().enumerate().find_map(|(place, row)| {
                let column = (0..columns).find(|column| row[*column].vanishes() == Some(false))?;
                Some((place, column, row[column].inverse()?))
            });
            let Some((place, column, inverse)) = entry else { break };
            let mut pivot: Vec<R> = open.remove(place).iter().map(|entry| entry.mul(&inverse)).collect();
            // Exact ones and zeros, where discs would leave a doubt.
            pivot[column] = R::one();
            for row in open.iter_mut().chain(&mut solved.rows) {
                let by = std::mem::replace(&mut row[column], R::zero());
                for (k, entry) in row.iter_mut().enumerate().filter(|(k, _)| *k != column) {
                    *entry = entry.sub(&by.mul(&pivot[k]));
                }
            }
            solved.pivots.push(column);
            solved.rows.push(pivot);
        }
        for row in &open {
            if row[..columns].iter().any(|entry| entry.vanishes() != Some(true)) {
                return Err("the angle between two slides");
            }
        }
        let ends: Vec<Option<bool>> = open.iter().map(|row| row[columns].vanishes()).collect();
        if ends.contains(&Some(false)) {
            return Ok(None);
        }
        if ends.contains(&None) { Err("the distance of parallel slides") } else { Ok(Some(solved)) }
    }

    /// The row of a displacement that the others determine.
    fn row_of(&self, slide: usize) -> Option<&[R]> {
        self.pivots.iter().position(|own| *own == slide).map(|row| self.rows[row].as_slice())
    }

    /// The displacement along a slide where all free ones have this value.
    fn value(&self, slide: usize, free: &[usize], value: &R) -> R {
        let Some(row) = self.row_of(slide) else { return value.clone() };
        let moved = free.iter().fold(R::zero(), |sum, own| sum.add(&row[*own].mul(value)));
        row.last().map_or_else(R::zero, |constant| constant.add(&moved).neg())
    }
}
