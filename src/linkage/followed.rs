//! Groups that stand on one that moves by itself.
//!
//! At a place of that motion they are solved as anywhere else. If they have a real assembly there that is regular, it goes on along the
//! motion, by the theorem of implicit functions, and the whole linkage moves. Otherwise the group that moves and those that stand on it
//! are decided as one group over the rationals: they may close at other places.

use super::answer::is_one;
use super::assembly::{Asked, Assemblies, Branch, Family, FamilyKind, Route, SHALLOW, Solution, attempt, by_basis};
use super::equations::Closure;
use super::exact_group::decided;
use super::groups::Group;
use super::state::State;
use crate::kinematics::linkage::{Linkage, LinkageJoint, Pair};
use rug::Rational;
use std::collections::BTreeSet;

/// Branches whose groups are solved as one: a Gröbner basis takes up to a second.
const MOST_UNITED: usize = 4;
/// Motions that are followed in one branch.
const MOST_FOLLOWED: usize = 4;

/// Replaces real motions of a group, solved in the branch `before`, by those of the whole linkage; false where one of them is not known
/// to go on.
pub(super) fn follow(
    linkage: &Linkage,
    families: &mut [Family],
    before: &State,
    later: &[Group],
    asked: Asked<'_>,
) -> bool {
    let real = families.iter_mut().filter(|family| family.state.real);
    let mut all = true;
    for (k, family) in real.enumerate() {
        all = k < MOST_FOLLOWED && follow_one(linkage, family, before, later, asked) && all;
    }
    all
}

/// Whether every sample of a motion of this kind lies on it: one of another kind may be an isolated assembly beside it.
fn is_simple(kind: FamilyKind) -> bool {
    matches!(kind, FamilyKind::Dyad | FamilyKind::Slide | FamilyKind::Spin)
}

/// Whether a later motion is one of a group that the motion of an earlier one, solved in the branch `before`, leaves as it is: it joins
/// as many clusters there as in the branch `behind` that group. The groups between that the earlier motion leaves as they are, too, are placed in
/// both branches; groups that stand on it are placed in the second one alone.
fn is_apart(linkage: &Linkage, motion: &Family, before: &State, behind: &State, later: &[Group]) -> bool {
    if !is_simple(motion.kind) {
        return false;
    }
    let [mut without, mut with] =
        [before, behind].map(|state| state.bodies.iter().map(|body| body.0).collect::<Vec<_>>());
    for group in later {
        let bodies: Vec<usize> = group.joints.iter().flat_map(|joint| linkage.joints[*joint].of).collect();
        let joined = |clusters: &[usize]| bodies.iter().map(|body| clusters[*body]).collect::<BTreeSet<usize>>();
        let (one, other) = (joined(&without), joined(&with));
        // A gear may turn a body with the motion of others, wherever it stands.
        let is_left = group.gears.is_empty() && one.len() == other.len();
        if motion.joints.iter().all(|joint| group.joints.contains(joint)) {
            return is_left;
        }
        let place = |clusters: &mut [usize], joined: &BTreeSet<usize>| {
            let Some(first) = joined.first() else { return };
            clusters.iter_mut().filter(|cluster| joined.contains(cluster)).for_each(|cluster| *cluster = *first);
        };
        if is_left {
            place(&mut without, &one);
        }
        place(&mut with, &other);
    }
    false
}

/// Returns how many freedoms a group may have at special places of a motion that it stands on, if it is two bodies on three revolute joints: none if
/// their arms differ, two if both are 0, and one otherwise. Of other groups that is not known.
fn most_gained(linkage: &Linkage, group: &Group) -> Option<usize> {
    let [one, two, three] = group.joints.as_slice() else { return None };
    let joints = [one, two, three].map(|joint| &linkage.joints[*joint]);
    let is_dyad = group.clusters.len() == 3 && group.gears.is_empty() && linkage.bars.is_empty();
    if !is_dyad || joints.iter().any(|joint| joint.pair != Pair::Revolute) {
        return None;
    }
    // The square of the distance of two joints in the body that they share.
    let arm = |i: usize, j: usize| -> Option<Rational> {
        let body = joints[i].of.into_iter().find(|body| joints[j].of.contains(body))?;
        let place = |joint: &LinkageJoint| (0..2).find(|end| joint.of[*end] == body).map(|end| joint.at[end].clone());
        let (from, to) = (place(joints[i])?, place(joints[j])?);
        Some((from.re - to.re).square() + (from.im - to.im).square())
    };
    let arms: Vec<Rational> = [(0, 1), (1, 2), (0, 2)].into_iter().filter_map(|(i, j)| arm(i, j)).collect();
    // Where all three are in one body by pairs, one of these is at rest: which one is not asked.
    let pairs = (1..arms.len()).flat_map(|k| arms[..k].iter().zip(std::iter::repeat(&arms[k])));
    pairs
        .map(|(one, other)| {
            usize::from(*one == 0 || *other == 0 || one == other) + usize::from(*one == 0 && *other == 0)
        })
        .max()
}

/// Whether the groups that stand on a motion cannot have more freedoms at one of its places than those that are counted, and one: such places have a
/// dimension less than the motion.
fn gain_little(linkage: &Linkage, later: &[Group], counted: usize) -> bool {
    later.iter().map(|group| most_gained(linkage, group)).sum::<Option<usize>>().is_some_and(|all| all <= counted + 1)
}

/// How a motion goes on at one of its places.
struct Further {
    state: State,
    dimension: usize,
    is_proved: bool,
    /// Whether no other motion there may be one all along this one, which would have a larger dimension.
    is_all: bool,
}

fn follow_one(linkage: &Linkage, family: &mut Family, before: &State, later: &[Group], asked: Asked<'_>) -> bool {
    let is_proved = is_simple(family.kind);
    let go_on = |sample: &State| {
        let found = attempt(linkage, sample, later, SHALLOW, false, asked).ok()?;
        // Another motion beside the first takes no part in that. Where it does, the first may have to stand still.
        let (beside, others): (Vec<Family>, Vec<Family>) = found
            .curves
            .into_iter()
            .filter(|other| other.state.real)
            .partition(|other| is_one(&other.state) && is_apart(linkage, other, before, sample, later));
        let is_regular = |state: &State| state.real && state.multiplicity == sample.multiplicity;
        let further = match beside.into_iter().max_by_key(|other| other.dimension) {
            Some(other) => (other.state, family.dimension + other.dimension, is_proved && other.is_proved),
            None => (found.modes.into_iter().find(is_regular)?, family.dimension, is_proved),
        };
        let (state, dimension, is_proved) = further;
        Some(Further { state, dimension, is_proved, is_all: others.is_empty() })
    };
    let mut found: Option<Further> = None;
    for sample in [&family.state].into_iter().chain(&family.samples) {
        if found.as_ref().is_some_and(|found| found.is_all) {
            break;
        }
        found = go_on(sample).filter(|next| found.is_none() || next.is_all).or(found);
    }
    let Some(Further { state, dimension, is_proved, is_all }) = found else { return false };
    let is_all = is_all && gain_little(linkage, later, dimension.saturating_sub(family.dimension));
    (family.state, family.dimension, family.is_proved) = (state, dimension, is_proved && is_all);
    family.kind = FamilyKind::Followed;
    is_all
}

/// Assemblies of all bodies from groups that were solved as one.
#[derive(Default)]
pub(super) struct United {
    /// The isolated ones.
    pub modes: Vec<State>,
    /// The group and how it was solved.
    pub solution: Option<Solution>,
    branches: usize,
}

impl United {
    /// Solves the group of a branch and those that stand on it as one, and takes the place of the curves from the number `moving` on; false
    /// where that takes too much work, or numbers are not rational.
    pub fn solve(&mut self, at: Branch<'_>, later: &[Group], moving: usize, found: &mut Assemblies) -> bool {
        let all = || [at.group].into_iter().chain(later);
        if self.branches >= MOST_UNITED || all().any(|group| !group.gears.is_empty()) {
            return false;
        }
        self.branches += 1;
        let clusters: Vec<usize> = all().flat_map(|group| group.clusters.iter().copied()).collect();
        let joints: Vec<usize> = all().flat_map(|group| group.joints.iter().copied()).collect();
        let mut names: Vec<usize> = clusters.iter().map(|body| at.state.bodies[*body].0).collect();
        names.sort_unstable();
        names.dedup();
        let group = Group { clusters, joints: joints.clone(), gears: Vec::new(), count: 0 };
        let Some(closure) = Closure::new(at.linkage, &group, at.state) else { return false };
        let Some(decided) = decided(&closure.equations) else { return false };
        let bodies = &at.state.bodies;
        let of = |name: &usize| (0..bodies.len()).filter(|body| bodies[*body].0 == *name).collect();
        let solution = self.solution.get_or_insert_with(|| Solution {
            bodies: names.iter().map(of).collect(),
            joints,
            count: 0,
            route: Route::Basis,
        });
        found.curves.truncate(moving);
        let whole = Branch { closure: &closure, group: &group, ..at };
        by_basis(decided, &[], whole, solution, &mut self.modes, found);
        true
    }
}
