//! All assemblies of a linkage: its groups solved one after the other, branch by branch.

use super::bars::square;
use super::boxes::{LONG, RealAssemblies, SHORT, real_assemblies};
use super::equations::{Closure, Equations};
use super::exact_group::{Decided, decided};
use super::fibres::by_fibres;
use super::followed::{United, follow};
use super::geared_groups::geared_groups;
use super::gears::{Geared, geared, is_train, teeth};
use super::general::{general, least_rows, with_choices};
use super::groups::{Group, Groups, MOST_CLUSTERS, MOST_IN_BOXES, Merged};
use super::krawczyk::Proved;
use super::members::are_all;
use super::quadratic::{Root, Solved, one_cycle, realness};
use super::real_motion::Moving;
use super::real_system::is_real;
use super::state::{Half, Number, Place, State, place_of, place_within};
use super::straight::{open_angles, slides_alone, with_foundations, with_known_turns, with_slides};
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Gaussian, Given, Linkage, Pair};
use rug::Rational;
use std::sync::atomic::AtomicBool;

/// Towers of more generators are not built: the work doubles with each of them.
const DEEP: usize = 5;
/// Towers that hold i alone, and square roots that are no new ones.
pub(super) const SHALLOW: usize = 1;
/// The reason given for an assembly that is neither proved real nor proved complex.
const UNDECIDED: &str = "an assembly is neither proved real nor proved complex";
/// Most branches that are listed.
pub(super) const MOST_BRANCHES: usize = 1 << 14;

/// Rows of a pencil beyond which a group is solved by boxes where only real assemblies are asked for: 96 rows (11 links) took 2 s, 224 rows (13 links)
/// 25 s, and boxes less than 1 s for both.
const MOST_PENCIL_ROWS: usize = 100;
/// Choices of a hidden class that are tried for the assemblies beside a motion: structures of nine links take a fifth of a second for each.
const MOST_CHOICES: usize = 12;
/// Cycles up to which no pencil has more rows: C(8, 4) = 70.
const FEW_CYCLES: usize = 4;
/// Cycles up to which pencils are made to see how large they are: C(12, 6) = 924 rows at most.
const SEVERAL_CYCLES: usize = 6;

/// Groups that are solved as one with those that they stand on, one after the other: each attempt takes up to some seconds.
const MOST_UNITED: usize = 3;

/// What is asked of a linkage.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// Whether complex assemblies are asked for, too, even if they take long.
    pub complex: bool,
    /// Ends the search of large groups when it is raised.
    pub stop: &'a AtomicBool,
    /// Values of joints, radians or metres, to which the nearest assemblies are listed first.
    pub near: Option<&'a [Option<f64>]>,
}

/// A way in which a group is solved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Route {
    /// A quadratic equation, or a linear one.
    Quadratic,
    /// A matrix with this many rows.
    Pencil(usize),
    /// A Gröbner basis of the cycles.
    Basis,
    /// The equations of this many pairs of gears and of the cycles.
    Gears(usize),
    /// The turn of a wheel about a joint of the rest, of which a power is known.
    Wheel,
    /// This many boxes of angles: real assemblies only.
    Boxes(usize),
}

/// The solution of a group.
#[derive(Clone, Debug)]
pub struct Solution {
    /// The bodies of its clusters, in the order of the file.
    pub bodies: Vec<Vec<usize>>,
    /// The joints between them.
    pub joints: Vec<usize>,
    /// The most assemblies that a branch has, with multiplicity.
    pub count: usize,
    /// The route by which it was solved.
    pub route: Route,
}

/// A kind of families.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FamilyKind {
    /// A dyad whose ends coincide.
    Dyad,
    /// Bodies that slides alone hold together, which do not turn.
    Slide,
    /// Bodies whose joints coincide.
    Spin,
    /// Another one, beside which there may be isolated assemblies and more families.
    Other,
    /// A motion of one group on which others stand, at a place where these have a regular assembly.
    Followed,
}

/// Assemblies of a group that are infinitely many.
#[derive(Clone, Debug)]
pub struct Family {
    /// One of them.
    pub state: State,
    /// The joints of the group that move.
    pub joints: Vec<usize>,
    /// The dimension of their set, complex ones included.
    pub dimension: usize,
    /// What it is.
    pub kind: FamilyKind,
    /// Whether real ones are proved to form a curve, if the state is real.
    pub is_proved: bool,
    /// More of them, at which groups are tried that stand on this one.
    pub samples: Vec<State>,
    /// Whether all regular assemblies of the group are listed.
    pub with_regular: bool,
}

impl Family {
    fn new(state: State, joints: Vec<usize>, dimension: usize, kind: FamilyKind) -> Self {
        Self { state, joints, dimension, kind, is_proved: true, samples: Vec::new(), with_regular: true }
    }
}

/// Assemblies of all bodies.
#[derive(Clone, Debug)]
pub struct Assemblies {
    /// The isolated ones.
    pub modes: Vec<State>,
    /// Assemblies that are not isolated.
    pub curves: Vec<Family>,
    /// The groups in the order in which they were solved.
    pub groups: Vec<Solution>,
    /// Why the list may not be complete.
    pub doubt: Option<String>,
    /// The number of the group that left it in doubt first.
    pub doubted: Option<usize>,
    /// Whether only real assemblies were looked for.
    pub only_real: bool,
    /// Whether the number of assemblies of a group is that of members that were drawn.
    pub is_probable: bool,
    /// The least distance, metres, by which a dyad of a real branch does not close; none where all close.
    pub gap: Option<f64>,
}

impl Assemblies {
    /// Notes by how much a group without a real assembly does not close.
    fn note_gap(&mut self, equations: &Equations<Number>) {
        self.gap = [self.gap, dyad_gap(equations)].into_iter().flatten().reduce(f64::min);
    }
}

/// A joint with its two bodies.
pub type Link = (usize, [usize; 2]);

/// The bodies that inputs glue, and the joints that are left.
///
/// # Errors
/// Where an input glues bodies that are one already.
pub fn glued(linkage: &Linkage, given: &[Given]) -> Result<(Merged, Vec<Link>)> {
    let mut merged = Merged::new(linkage.bodies.len());
    for one in given {
        let [a, b] = one.bodies(linkage);
        if !merged.merge(a, b) {
            let names = [a, b].map(|body| linkage.bodies[body].name.as_str());
            let message = format!(
                "found an input between {} and {}, which other inputs hold together already; expected inputs that are independent",
                names[0], names[1]
            );
            return Err(Error::Invalid(message));
        }
    }
    let is_given = |index: usize| {
        given.iter().any(|one| matches!(one, Given::Turn { joint, .. } | Given::Shift { joint, .. } if *joint == index))
    };
    let joints = linkage.joints.iter().enumerate();
    let joints =
        joints.filter(|(index, joint)| !joint.is_gear() && !is_given(*index)).map(|(index, joint)| (index, joint.of));
    Ok((merged, joints.collect()))
}

/// The groups of a linkage with these inputs.
///
/// # Errors
/// Where inputs are too few, too many, or meet a rigid part; where a group is beyond what is implemented.
pub fn groups_of(linkage: &Linkage, given: &[Given]) -> Result<Groups> {
    let (mut merged, joints) = glued(linkage, given)?;
    // A joint between bodies that inputs hold together is in no group: nothing would say that it closes.
    let is_held = |(_, [a, b]): &&Link| merged.root(*a) == merged.root(*b);
    let held = joints.iter().find(is_held).map(|(joint, of)| Group {
        clusters: of.to_vec(),
        joints: vec![*joint],
        gears: Vec::new(),
        count: -2,
    });
    let gears = gears_of(linkage)?;
    let found =
        with_slides(linkage, &joints, geared_groups(linkage.bodies.len(), &joints, &gears, merged.clone())?, &merged);
    let named = |group: &Group| {
        let names: Vec<&str> = group.clusters.iter().take(8).map(|body| linkage.bodies[*body].name.as_str()).collect();
        names.join(", ") + if group.clusters.len() > 8 { ", ..." } else { "" }
    };
    if let Some(group) = held.iter().chain(&found.list).find(|group| group.count < 0) {
        let (merged, free) = glued(linkage, &[])?;
        let without =
            with_slides(linkage, &free, geared_groups(linkage.bodies.len(), &free, &gears, merged.clone())?, &merged);
        if !given.is_empty() && without.list.iter().all(|group| group.count >= 0) {
            let message = format!(
                "found inputs that close a rigid part ({}), expected inputs of joints that can move; without inputs the linkage has {}",
                named(group),
                freedoms(without.freedoms)
            );
            return Err(Error::Invalid(message));
        }
        return Err(Error::Unsupported(format!(
            "the bodies {} have more joints than hold them together: overconstrained groups are not solved yet",
            named(group)
        )));
    }
    if found.freedoms > 0 {
        let message = format!(
            "found {} given, which leaves {}; expected as many inputs as the linkage has freedoms, {}",
            if given.len() == 1 { "1 input".to_owned() } else { format!("{} inputs", given.len()) },
            freedoms(found.freedoms),
            given.len() + found.freedoms
        );
        return Err(Error::Invalid(message));
    }
    let slides = |group: &Group| group.joints.iter().any(|joint| linkage.joints[*joint].is_prismatic());
    let most = |group: &Group| if slides(group) || !group.gears.is_empty() { MOST_CLUSTERS } else { MOST_IN_BOXES };
    if let Some(group) = found.list.iter().find(|group| group.clusters.len() > most(group)) {
        return Err(Error::Unsupported(format!(
            "a group of {} bodies, at most {} are solved: {}",
            group.clusters.len(),
            most(group),
            named(group)
        )));
    }
    Ok(found)
}

/// The pairs of gears with their carriers and bodies.
fn gears_of(linkage: &Linkage) -> Result<Vec<(usize, [usize; 3])>> {
    let joints = linkage.joints.iter().enumerate();
    let gears = joints.filter_map(|(index, joint)| match &joint.pair {
        Pair::Gear { carrier, ratio, .. } => Some(teeth(ratio).map(|_| (index, [*carrier, joint.of[0], joint.of[1]]))),
        _ => None,
    });
    gears.collect()
}

fn freedoms(count: usize) -> String {
    if count == 1 { "1 freedom".to_owned() } else { format!("{count} freedoms") }
}

/// All assemblies with these inputs; of groups that are solved by boxes all real ones.
///
/// # Errors
/// As [`groups_of`].
pub fn assemblies(linkage: &Linkage, given: &[Given], asked: Asked<'_>) -> Result<Assemblies> {
    placed(linkage, given, place_of, asked)
}

/// All assemblies with inputs of which enclosures are known: what is found holds for all values within them. It is in doubt where
/// an equality decides.
///
/// # Errors
/// As [`groups_of`].
pub fn assemblies_within(linkage: &Linkage, given: &[Given], asked: Asked<'_>) -> Result<Assemblies> {
    placed(linkage, given, place_within, asked)
}

/// All assemblies, where lengths of bars and legs were rounded whose squares are exact; `None` where angles of these are given.
///
/// # Errors
/// As [`groups_of`].
pub fn assemblies_of_squares(linkage: &Linkage, given: &[Given], asked: Asked<'_>) -> Result<Option<Assemblies>> {
    let groups = groups_of(linkage, given)?;
    let mut start = State::new(linkage.bodies.len(), SHALLOW);
    if !square(linkage, given, &mut start) {
        return Ok(None);
    }
    glue(linkage, given, place_of, &mut start)?;
    by_groups(linkage, &groups.list, &start, asked).map(Some)
}

/// All assemblies, where `place` is that of the second body of an input against the first.
fn placed(
    linkage: &Linkage,
    given: &[Given],
    place: impl Fn(&Linkage, &Given) -> Option<Place>,
    asked: Asked<'_>,
) -> Result<Assemblies> {
    let groups = groups_of(linkage, given)?;
    by_groups(linkage, &groups.list, &started(linkage, given, place)?, asked)
}

/// All assemblies from the branch in which inputs are placed.
fn by_groups(linkage: &Linkage, groups: &[Group], start: &State, asked: Asked<'_>) -> Result<Assemblies> {
    let shallow = attempt(linkage, start, groups, SHALLOW, true, asked)?;
    // Square roots are kept as such only where a disc about zero decides nothing.
    if shallow.doubt.is_some() && groups.iter().any(|group| group.clusters.len() <= 3) {
        let deep = attempt(linkage, start, groups, DEEP, true, asked)?;
        if deep.doubt.is_none() {
            return Ok(deep);
        }
    }
    as_united(linkage, groups, start, &shallow, asked).map(|united| united.unwrap_or(shallow))
}

/// Solves groups of which one is left in doubt on what it stands on, whose numbers are not rational, as one with all that it stands on:
/// the numbers of that group are rational. `None` where a doubt remains.
fn as_united(
    linkage: &Linkage,
    groups: &[Group],
    start: &State,
    shallow: &Assemblies,
    asked: Asked<'_>,
) -> Result<Option<Assemblies>> {
    let is_exact = start.bodies.iter().all(|(_, place)| place.turn.z.exact.is_some());
    let mut merged = Merged::new(linkage.bodies.len());
    for (body, (cluster, _)) in start.bodies.iter().enumerate() {
        merged.merge(*cluster, body);
    }
    let (mut list, mut doubted) = (groups.to_vec(), shallow.doubted.filter(|_| is_exact));
    for _ in 0..MOST_UNITED {
        let Some(at) = doubted else { return Ok(None) };
        let Some(next) = with_foundations(&list, at, &merged) else { return Ok(None) };
        let is_small = |group: &Group| group.joints.len() < group.clusters.len() + SEVERAL_CYCLES;
        if !next.iter().all(is_small) {
            return Ok(None);
        }
        let found = attempt(linkage, start, &next, SHALLOW, true, asked)?;
        if found.doubt.is_none() {
            return Ok(Some(found));
        }
        (list, doubted) = (next, found.doubted);
    }
    Ok(None)
}

/// The bodies that these inputs glue, and the joints that they leave free.
///
/// # Errors
/// Where an input glues bodies that are one already.
pub fn held_and_free(linkage: &Linkage, given: &[Given]) -> Result<(State, Vec<usize>)> {
    let (_, joints) = glued(linkage, given)?;
    Ok((started(linkage, given, place_of)?, joints.into_iter().map(|(joint, _)| joint).collect()))
}

/// The groups of a linkage with these inputs and a joint held, by bodies and joints; `None` where there are no such groups.
#[must_use]
pub fn parts_when_still(linkage: &Linkage, held: &[Given], joint: usize) -> Option<Vec<Solution>> {
    let mut inputs = held.to_vec();
    let one = Gaussian { re: Rational::from(1), im: Rational::new() };
    inputs.push(Given::Turn { joint, turn: one, within: None, line: 0 });
    let list = groups_of(linkage, &inputs).ok()?.list;
    let (mut merged, _) = glued(linkage, &inputs).ok()?;
    let mut parts = Vec::new();
    for group in &list {
        let roots: Vec<usize> = group.clusters.iter().map(|body| merged.root(*body)).collect();
        let mut of = |root: &usize| (0..linkage.bodies.len()).filter(|body| merged.root(*body) == *root).collect();
        let bodies = roots.iter().map(&mut of).collect();
        parts.push(Solution { bodies, joints: group.joints.clone(), count: 0, route: Route::Quadratic });
        for pair in roots.windows(2) {
            merged.merge(pair[0], pair[1]);
        }
    }
    Some(parts)
}

/// The bodies that the inputs glue, where `place` is that of the second body of an input against the first.
pub(super) fn started<R: Half>(
    linkage: &Linkage,
    given: &[Given],
    place: impl Fn(&Linkage, &Given) -> Option<Place<R>>,
) -> Result<State<R>> {
    let mut start = State::new(linkage.bodies.len(), SHALLOW);
    glue(linkage, given, place, &mut start)?;
    Ok(start)
}

/// Glues the bodies that inputs hold together.
fn glue<R: Half>(
    linkage: &Linkage,
    given: &[Given],
    place: impl Fn(&Linkage, &Given) -> Option<Place<R>>,
    start: &mut State<R>,
) -> Result<()> {
    for one in given {
        let [a, b] = one.bodies(linkage);
        let Some(place) = place(linkage, one) else {
            return Err(Error::Invalid("found a distance for a joint that has none".to_owned()));
        };
        start.glue(a, b, &place);
    }
    Ok(())
}

/// Solves groups one after the other. `follows` says whether groups that stand on one that moves are solved, too.
pub(super) fn attempt(
    linkage: &Linkage,
    start: &State,
    groups: &[Group],
    highest: usize,
    follows: bool,
    asked: Asked<'_>,
) -> Result<Assemblies> {
    let mut start = start.clone();
    start.top.highest = highest;
    let mut found = Assemblies {
        modes: Vec::new(),
        curves: Vec::new(),
        groups: Vec::new(),
        doubt: None,
        doubted: None,
        only_real: false,
        is_probable: false,
        gap: None,
    };
    let mut branches = vec![start.clone()];
    let mut united = United::default();
    for (number, group) in groups.iter().enumerate() {
        let later = if follows { &groups[number + 1..] } else { &[] };
        let mut names: Vec<usize> = Vec::new();
        let mut next = Vec::new();
        let mut solution =
            Solution { bodies: Vec::new(), joints: group.joints.clone(), count: 0, route: Route::Quadratic };
        for state in &branches {
            let state = &with_known_turns(linkage, group, &start, state);
            if solution.bodies.is_empty() {
                names.extend(group.clusters.iter().map(|body| state.bodies[*body].0));
                let of = |name: &usize| (0..state.bodies.len()).filter(|body| state.bodies[*body].0 == *name).collect();
                solution.bodies = names.iter().map(of).collect();
            }
            let Some(closure) = Closure::new(linkage, group, state) else {
                return Err(Error::Unsupported("a group with gears".to_owned()));
            };
            let at = Branch { linkage, closure: &closure, group, state };
            let (known, moving) = (next.len(), found.curves.len());
            if group.gears.is_empty() {
                branch(at, &mut solution, &mut next, &mut found, asked);
            } else {
                by_gears(at, &mut solution, &mut next, &mut found);
            }
            let is_open = !later.is_empty() && !follow(linkage, &mut found.curves[moving..], state, later, asked);
            if is_open && united.solve(at, later, moving, &mut found) {
                next.truncate(known);
            }
        }
        if found.doubt.is_some() {
            found.doubted.get_or_insert(number);
        }
        branches = next;
        if branches.is_empty()
            && let Some(one) = united.solution.take()
        {
            found.groups.push(one);
            break;
        }
        found.groups.push(solution);
        if branches.len() > MOST_BRANCHES {
            return Err(Error::Unsupported(format!("more than {MOST_BRANCHES} assemblies are not listed")));
        }
    }
    found.groups.extend(united.solution);
    found.modes = branches;
    found.modes.extend(united.modes);
    Ok(found)
}

/// A group in one branch of the earlier ones.
#[derive(Clone, Copy)]
pub(super) struct Branch<'a> {
    pub linkage: &'a Linkage,
    pub closure: &'a Closure,
    pub group: &'a Group,
    pub state: &'a State,
}

/// Solves a group in one branch.
fn branch(at: Branch<'_>, solution: &mut Solution, next: &mut Vec<State>, found: &mut Assemblies, asked: Asked<'_>) {
    let Branch { linkage, closure, group, state } = at;
    let equations = &closure.equations;
    if let Some(open) = open_angles(equations) {
        add(open, at, solution, next, found);
        return;
    }
    if equations.loops() == 1 {
        add(one_cycle(equations, &state.top), at, solution, next, found);
        return;
    }
    if equations.classes == 1 {
        add(slides_alone(equations), at, solution, next, found);
        return;
    }
    if !equations.angles.is_empty() || equations.has_squares() {
        // Cycles of slides alone leave more unknowns than equations, and bars by their squares are not real in a pencil.
        if found.doubt.is_some() && equations.has_squares() {
            // The whole attempt is in doubt, and another branch would take as much work.
            return;
        }
        if let Some(decided) = decided(equations) {
            by_basis(decided, &[], at, solution, next, found);
        } else {
            let size = group.clusters.len();
            found.doubt.get_or_insert(format!("a group of {size} bodies with cycles of slides takes too much work"));
        }
        return;
    }
    if equations.slides.is_empty() && !has_pencil(equations, asked.complex) {
        by_boxes(at, solution, next, found, asked);
        return;
    }
    let is_exact = equations.exact().is_some_and(|exact| is_real(&exact));
    if !is_exact && !state.real {
        // An assembly of the whole that is real is so in its parts. The real form of a pencil is one of real data.
        found.only_real = true;
        return;
    }
    let general = general(equations);
    solution.route = Route::Pencil(general.size);
    if !is_exact && are_all(linkage, group, state, equations, &general) {
        found.is_probable = true;
        solution.count = solution.count.max(general.solutions.len());
        add_proved(&general.solutions, at, next, found);
        return;
    }
    let proved: usize = general.solutions.len();
    solution.count = solution.count.max(general.most.unwrap_or(proved));
    let is_complete = general.most == Some(proved);
    let over_multiple_roots = || {
        let found = general.choices.iter().find_map(|choice| by_fibres(equations, choice, &general.solutions));
        found.map(Decided::Finite)
    };
    if !is_complete && let Some(decided) = over_multiple_roots().or_else(|| decided(equations)) {
        let isolated = match &decided {
            // Where not all regular assemblies are known, more choices lead to some.
            Decided::Moving(moving) if moving.regular.is_none() => with_choices(equations, MOST_CHOICES).solutions,
            _ => general.solutions,
        };
        by_basis(decided, &isolated, at, solution, next, found);
        return;
    }
    // What leaves the complex list in doubt, as multiple roots do, need not be near a real assembly.
    let boxes = if is_complete || !state.real { None } else { real_assemblies(equations, SHORT, asked.stop) };
    if let Some(real) = boxes.filter(|real| real.doubt.is_none()) {
        add_boxes(real, at, solution, next, found);
        let complex = general.solutions.iter().filter(|one| one.real == Some(false));
        next.extend(complex.map(|one| assembled(closure, state, one, false)));
        return;
    }
    if !is_complete {
        let reason = general.doubt.unwrap_or_else(|| "the number of assemblies of a group is not known".to_owned());
        found.doubt.get_or_insert(format!("{reason} (group of {} bodies)", group.clusters.len()));
    }
    add_proved(&general.solutions, at, next, found);
}

/// Solves a group with gears in one branch.
fn by_gears(at: Branch<'_>, solution: &mut Solution, next: &mut Vec<State>, found: &mut Assemblies) {
    let Branch { linkage, closure, group, state } = at;
    let route = if is_train(&closure.equations) { Route::Wheel } else { Route::Gears(group.gears.len()) };
    if let Some(open) = open_angles(&closure.equations) {
        add(open, at, solution, next, found);
    } else {
        match geared(linkage, closure, group, state) {
            Geared::Wheels(roots) => add(Solved::Roots(roots), at, solution, next, found),
            Geared::Decided(decided) => by_basis(decided, &[], at, solution, next, found),
            Geared::Undecided(reason) => add(Solved::Undecided(reason), at, solution, next, found),
        }
    }
    solution.route = route;
}

/// Adds the assemblies of a group in one branch that are proved one by one.
fn add_proved(solutions: &[Proved], at: Branch<'_>, next: &mut Vec<State>, found: &mut Assemblies) {
    let Branch { closure, state, .. } = at;
    for proved in solutions {
        let Some(real) = (if state.real { proved.real } else { Some(false) }) else {
            found.doubt.get_or_insert_with(|| UNDECIDED.to_owned());
            continue;
        };
        next.push(assembled(closure, state, proved, real));
    }
}

/// Adds what a Gröbner basis says of a group in one branch. `isolated` are the assemblies that are known by themselves.
pub(super) fn by_basis(
    decided: Decided,
    isolated: &[Proved],
    at: Branch<'_>,
    solution: &mut Solution,
    next: &mut Vec<State>,
    found: &mut Assemblies,
) {
    let Branch { linkage, closure, group, state } = at;
    solution.route = Route::Basis;
    match decided {
        Decided::Finite(roots) => {
            let (roots, real): (Vec<Root>, Vec<bool>) = roots.into_iter().unzip();
            if state.real && real.iter().all(|real| !real) {
                found.note_gap(&closure.equations);
            }
            add_roots(&roots, real.into_iter().map(Some), at, solution, next, found);
        }
        Decided::Spinning(roots, spinning) => {
            let size = closure.equations.classes + closure.equations.slides.len();
            let unit = |class: &usize| (0..size).map(|k| f64::from(u8::from(k == *class))).collect();
            let rates: Vec<Vec<f64>> = spinning.iter().map(unit).collect();
            for (root, real) in roots {
                let mut own = closure.assembled(state, &root.turns, &root.shifts);
                own.real = state.real && real;
                let joints = closure.moving_joints(linkage, group, state, &rates);
                let (dimension, kind) = (spinning.len(), FamilyKind::Spin);
                found.curves.push(Family::new(own, joints, dimension, kind));
            }
        }
        Decided::Moving(moving) => {
            let Moving { dimension, sample, is_proved, regular, .. } = *moving;
            let with_regular = regular.is_some();
            if let Some(regular) = regular {
                let (roots, real): (Vec<Root>, Vec<bool>) = regular.into_iter().unzip();
                add_roots(&roots, real.into_iter().map(Some), at, solution, next, found);
            } else {
                solution.count = solution.count.max(isolated.len());
                let known = isolated.iter().filter_map(|one| Some((one, one.real?)));
                next.extend(known.map(|(one, real)| assembled(closure, state, one, state.real && real)));
            }
            let Some((root, rates)) = sample else {
                let bodies = group.clusters.len();
                found.doubt.get_or_insert_with(|| {
                    format!(
                        "the assemblies of a group of {bodies} bodies form a set of dimension {dimension}, complex ones counted, \
                         by a Gröbner basis over the rationals; no real one that moves was found"
                    )
                });
                return;
            };
            let mut own = closure.assembled(state, &root.turns, &root.shifts);
            own.real = state.real;
            let joints = closure.moving_joints(linkage, group, state, &rates);
            let family = Family::new(own, joints, dimension, FamilyKind::Other);
            found.curves.push(Family { is_proved, with_regular, ..family });
        }
    }
}

/// The branch with a solution of a group in it.
fn assembled(closure: &Closure, state: &State, proved: &Proved, real: bool) -> State {
    let mut next = closure.assembled(state, &proved.root.turns, &proved.root.shifts);
    next.real = real;
    next
}

/// Whether a group has rational data and a pencil, of moderate size where only real assemblies are asked for.
fn has_pencil(equations: &Equations<Number>, complex: bool) -> bool {
    let Some(exact) = equations.exact() else { return false };
    let is_small = || least_rows(&exact).is_some_and(|rows| rows <= MOST_PENCIL_ROWS);
    let loops = equations.loops();
    loops <= FEW_CYCLES || loops <= SEVERAL_CYCLES && (complex || is_small())
}

/// Adds the real assemblies that a group has in one branch, where no others are looked for.
fn by_boxes(at: Branch<'_>, solution: &mut Solution, next: &mut Vec<State>, found: &mut Assemblies, asked: Asked<'_>) {
    let Branch { closure, group, state, .. } = at;
    // An assembly of the whole that is real is so in its parts.
    if !state.real {
        found.only_real = true;
        return;
    }
    match real_assemblies(&closure.equations, LONG, asked.stop) {
        Some(real) => add_boxes(real, at, solution, next, found),
        None => {
            found.doubt.get_or_insert(format!("a group of {} bodies is too large", group.clusters.len()));
        }
    }
}

/// Adds the assemblies that boxes have led to in one branch.
fn add_boxes(
    real: RealAssemblies,
    at: Branch<'_>,
    solution: &mut Solution,
    next: &mut Vec<State>,
    found: &mut Assemblies,
) {
    let Branch { closure, group, state, .. } = at;
    found.only_real = true;
    let before = if let Route::Boxes(boxes) = solution.route { boxes } else { 0 };
    solution.route = Route::Boxes(before + real.boxes);
    solution.count = solution.count.max(real.solutions.len());
    if let Some(doubt) = real.doubt {
        found.doubt.get_or_insert(format!("{doubt} (group of {} bodies)", group.clusters.len()));
    }
    next.extend(real.solutions.iter().map(|one| assembled(closure, state, one, true)));
}

/// Adds the assemblies that a group has in one branch.
fn add(solved: Solved, at: Branch<'_>, solution: &mut Solution, next: &mut Vec<State>, found: &mut Assemblies) {
    let Branch { closure, group, state, .. } = at;
    match solved {
        Solved::Undecided(reason) => {
            found.doubt.get_or_insert(reason);
        }
        Solved::Moving(moving) => {
            let rates = &moving.ways;
            let mut samples: Vec<State> =
                moving.samples.iter().map(|root| closure.assembled(state, &root.turns, &root.shifts)).collect();
            if samples.is_empty() {
                return;
            }
            let joints = closure.moving_joints(at.linkage, group, state, rates);
            let kind = if closure.equations.classes == 1 { FamilyKind::Slide } else { FamilyKind::Dyad };
            let family = Family::new(samples.remove(0), joints, rates.len(), kind);
            found.curves.push(Family { samples, ..family });
        }
        Solved::Roots(roots) => {
            let real = realness(&roots, &closure.equations.squares);
            if state.real && real.iter().all(|real| *real == Some(false)) {
                found.note_gap(&closure.equations);
            }
            add_roots(&roots, real.into_iter(), at, solution, next, found);
        }
    }
}

/// Adds the roots of a group in one branch; `real` says of each whether it is real where the branch is.
fn add_roots(
    roots: &[Root],
    real: impl Iterator<Item = Option<bool>>,
    at: Branch<'_>,
    solution: &mut Solution,
    next: &mut Vec<State>,
    found: &mut Assemblies,
) {
    let Branch { closure, state, .. } = at;
    solution.count = solution.count.max(roots.iter().map(|root| root.multiplicity).sum());
    for (root, real) in roots.iter().zip(real) {
        let Some(real) = (if state.real { real } else { Some(false) }) else {
            found.doubt.get_or_insert_with(|| UNDECIDED.to_owned());
            continue;
        };
        let mut next_state = closure.assembled(state, &root.turns, &root.shifts);
        next_state.real = real;
        next_state.multiplicity *= root.multiplicity;
        next_state.top.hold(root);
        next.push(next_state);
    }
}

/// Returns the distance, in metres, by which the ends of a dyad exceed the reach of its links; `None` with slides.
fn dyad_gap(equations: &Equations<Number>) -> Option<f64> {
    let [cycle] = equations.cycles.as_slice() else { return None };
    if !equations.slides.is_empty() {
        return None;
    }
    let lengths: Vec<f64> = cycle.iter().map(|n| (n.z.middle().norm() * n.w.middle().norm()).sqrt()).collect();
    let longest = lengths.iter().copied().fold(0.0, f64::max);
    Some((2.0 * longest - lengths.iter().sum::<f64>()).max(0.0))
}
