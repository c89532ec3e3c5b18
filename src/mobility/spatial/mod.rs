//! Whether a linkage in space or on the sphere moves, at its configuration or at an assembly with inputs. The theorems are in docs/mobility.md, section "Linkages in
//! space and on the sphere".

mod curves;
mod freedoms;
mod loops;

use super::planar::LinkageMobility;
use crate::algebra::number::nearest_f64;
use crate::catalogue::{SpaceFile, SphereFile};
use crate::error::{Error, Result};
use crate::kinematics::space::SpacePair;
use crate::linkage::space::{self, conditions};
use crate::linkage::sphere;
use crate::verdict::{Code, Proof};
use curves::{Agreement, agree, shafts};
use freedoms::{Freedom, freedoms};
use looproot_calculus::line::pluecker::Line;
use loops::{Solver, System};
use rug::Rational;

/// A configuration that is open by more than this part of the size of the linkage is none.
const OPEN: f64 = 1e-6;
/// Series are followed to this order where no bound says when to stop.
const MOST: usize = 40;

/// A pair of revolute joints of the ground that turn alike along the motion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shafts {
    /// The joints, by their numbers.
    pub joints: [usize; 2],
    /// Whether they turn in opposite senses about their axes.
    pub is_opposite: bool,
}

/// Decides whether a linkage in space moves: at its configuration, or without one at an assembly of its first inputs.
///
/// # Errors
/// For a configuration that does not close, with the gap, and without configuration and inputs.
pub fn space_mobility(file: &SpaceFile) -> Result<LinkageMobility> {
    let linkage = &file.linkage;
    let taken: usize = linkage.joints.iter().map(|joint| joint.pair.conditions()).sum();
    let gruebler = gruebler(6, linkage.bodies.len(), taken);
    let Some(at) = &file.configuration else {
        let case = file.cases.first().filter(|case| !case.given.is_empty()).ok_or_else(without)?;
        let held = case.given.iter().map(|given| if given.joint.is_some() { 1 } else { 6 }).sum();
        let found = space::solve(linkage, &case.given, file.exact && case.exact)?;
        let simple = found.modes.iter().any(|mode| mode.real && mode.multiplicity == 1);
        let proof = found.verdict.proof.is_proved();
        return Ok(somewhere(gruebler, held, simple && proof, None));
    };
    let places = |joint: usize| linkage.joints[joint].of.map(|body| &at.places[body]);
    let mut list = Vec::new();
    let mut gap = (0.0, 0);
    let mut is_closed = true;
    let mut size = 1.0_f64;
    for (k, joint) in linkage.joints.iter().enumerate() {
        let open = conditions(joint, places(k), Rational::clone);
        is_closed &= open.iter().all(|c| *c == 0);
        let worst = open.iter().map(|c| nearest_f64(c).abs()).fold(0.0, f64::max);
        if worst > gap.0 {
            gap = (worst, k);
        }
        size = joint.at.iter().flatten().map(|c| nearest_f64(c).abs()).fold(size, f64::max);
        list.push((joint.of, freedoms(joint, places(k))?));
    }
    let name = |joint: usize| linkage.joints[joint].name.as_str();
    closed(gap, size, name)?;
    let is_shaft = |joint: usize| {
        matches!(linkage.joints[joint].pair, SpacePair::Revolute(_))
            && linkage.joints[joint].of.contains(&linkage.ground)
    };
    // Of a loop the largest number of assemblies for a given value of one of its variables.
    let most = |own: &System| {
        let joints: Vec<usize> = distinct(own);
        let count =
            |wanted: fn(&SpacePair) -> bool| joints.iter().filter(|k| wanted(&linkage.joints[**k].pair)).count();
        let balls = count(|pair| matches!(pair, SpacePair::Spherical | SpacePair::Rod(_)));
        let others =
            count(|pair| matches!(pair, SpacePair::Parallelogram(..) | SpacePair::Leg | SpacePair::UniversalLeg(_)));
        match (own.used().len(), others, balls) {
            (7, 0, 1) => Some(4),
            (7, 0, 0) => Some(16),
            _ => None,
        }
    };
    let question = Question {
        system: System::of(linkage.bodies.len(), linkage.ground, &list, 6),
        gruebler,
        is_exact: file.exact && at.exact,
        is_closed,
        is_shaft: &is_shaft,
        most: &most,
        name: &name,
    };
    Ok(question.answer())
}

/// Decides whether a linkage on the sphere moves: at its configuration, or without one at an assembly of its first inputs.
///
/// # Errors
/// For a configuration that does not close, with the gap, and without configuration and inputs.
pub fn sphere_mobility(file: &SphereFile) -> Result<LinkageMobility> {
    let linkage = &file.linkage;
    let gruebler = gruebler(3, linkage.bodies.len(), 2 * linkage.joints.len());
    let Some(at) = &file.configuration else {
        let case = file.cases.first().filter(|case| !case.given.is_empty()).ok_or_else(without)?;
        let held = case.given.iter().map(|given| if given.joint.is_some() { 1 } else { 3 }).sum();
        let found = sphere::solve(linkage, &case.given, file.exact && case.exact)?;
        let simple = found.modes.iter().any(|mode| mode.real && mode.multiplicity == 1);
        let proof = found.verdict.proof.is_proved();
        // The equations of a single loop are dependent where all its axes lie in one plane; these assemblies move in no more dimensions.
        let ring = (linkage.joints.len() == linkage.bodies.len()).then_some("whose axes all lie in one plane");
        return Ok(somewhere(gruebler, held, simple && proof, ring));
    };
    let centre = std::array::from_fn(|_| Rational::new());
    let mut list: Vec<([usize; 2], Vec<Freedom>)> = Vec::new();
    let mut gap = (0.0, 0);
    let mut is_closed = true;
    for (k, joint) in linkage.joints.iter().enumerate() {
        let [u, v] = [0, 1].map(|side| at.places[joint.of[side]].rotate(&joint.at[side]));
        is_closed &= u == v;
        let off = (0..3).map(|i| Rational::from(&u[i] - &v[i]));
        let worst = off.map(|c| nearest_f64(&c).abs()).fold(0.0, f64::max);
        if worst > gap.0 {
            gap = (worst, k);
        }
        list.push((joint.of, vec![vec![Line::at(&centre, &u)]]));
    }
    let name = |joint: usize| linkage.joints[joint].name.as_str();
    closed(gap, 1.0, name)?;
    let is_shaft = |joint: usize| linkage.joints[joint].of.contains(&linkage.ground);
    let most = |own: &System| (own.used().len() == 4).then_some(2);
    let question = Question {
        system: System::of(linkage.bodies.len(), linkage.ground, &list, 3),
        gruebler,
        is_exact: file.exact && at.exact,
        is_closed,
        is_shaft: &is_shaft,
        most: &most,
        name: &name,
    };
    Ok(question.answer())
}

fn without() -> Error {
    Error::Unsupported(
        "the mobility of a linkage in space or on the sphere without a [configuration] and without inputs".to_owned(),
    )
}

/// Says what follows from the assemblies with as many variables held; `ring` names those of a single loop that are not regular.
fn somewhere(gruebler: i64, held: i64, is_simple: bool, ring: Option<&str>) -> LinkageMobility {
    let is_regular = is_simple && held == gruebler;
    let mobility = usize::try_from(held).ok().filter(|_| is_regular);
    let manifold = format!(
        "there is a simple real assembly with {held} of its freedoms held, as many as by count: the assemblies near it form a manifold of dimension \
         {held}"
    );
    let (proof, code, reason) = match (is_regular, ring) {
        (true, Some(ring)) => {
            let reason = format!(
                "{manifold}; the equations of a single loop are dependent in assemblies only {ring}, which move in no more dimensions"
            );
            (Proof::Proved, Code::RegularConfiguration, reason)
        }
        (true, None) => {
            let reason = format!("{manifold}; that no other assemblies move in more dimensions is not proved");
            (Proof::None, Code::NotDecided, reason)
        }
        _ => {
            let reason = format!(
                "with the inputs of the file held, {held} freedoms where the count is {gruebler}, no simple real assembly decides it: such a linkage is \
                 decided at a [configuration]"
            );
            (Proof::None, Code::NotDecided, reason)
        }
    };
    LinkageMobility {
        mobility,
        gruebler,
        first_order: mobility,
        order: None,
        branches: 0,
        proof,
        code,
        reason,
        shafts: Vec::new(),
    }
}

fn closed<'a>((gap, joint): (f64, usize), size: f64, name: impl Fn(usize) -> &'a str) -> Result<()> {
    if gap <= OPEN * size {
        return Ok(());
    }
    let message = format!(
        "found a configuration that leaves the joint {} open by {gap:.3e}, expected one that closes",
        name(joint)
    );
    Err(Error::Invalid(message))
}

fn gruebler(freedoms: i64, bodies: usize, taken: usize) -> i64 {
    let size = |count: usize| i64::try_from(count).unwrap_or(i64::MAX / 8);
    freedoms * (size(bodies) - 1) - size(taken)
}

/// The joints of a system.
fn distinct(system: &System) -> Vec<usize> {
    let mut joints: Vec<usize> = system.used().into_iter().map(|k| system.variables[k].joint).collect();
    joints.dedup();
    joints
}

/// A linkage at a configuration.
struct Question<'a> {
    system: System,
    gruebler: i64,
    is_exact: bool,
    is_closed: bool,
    /// Whether a joint turns a body against the ground.
    is_shaft: &'a dyn Fn(usize) -> bool,
    most: &'a dyn Fn(&System) -> Option<usize>,
    name: &'a dyn Fn(usize) -> &'a str,
}

impl Question<'_> {
    fn answer(&self) -> LinkageMobility {
        let system = &self.system;
        let variables = system.variables.len();
        let all: Vec<usize> = (0..variables).collect();
        let solver = Solver::of(system, &all);
        let (rank, rows) = (solver.rank(), system.conditions * system.loops.len());
        let first = variables - rank;
        let answer = |mobility: Option<usize>, proof: Proof, code: Code, reason: String| LinkageMobility {
            mobility,
            gruebler: self.gruebler,
            first_order: Some(first),
            order: None,
            branches: 0,
            proof: proof.of_rounded(!self.is_exact),
            code,
            reason,
            shafts: Vec::new(),
        };
        let none = |reason: String| LinkageMobility {
            proof: Proof::None,
            ..answer(None, Proof::None, Code::NotDecided, reason)
        };
        if !self.is_closed {
            let reason = format!(
                "the configuration closes approximately only: its rank, {rank} of {variables} variables, is measured"
            );
            let mobility = (rank == rows || first == 0).then_some(first);
            return LinkageMobility { mobility, ..none(reason) };
        }
        if rows == 0 {
            let reason = "the bodies form a tree, whose joints nothing binds".to_owned();
            return answer(Some(first), Proof::Proved, Code::OpenChain, reason);
        }
        if first == 0 {
            let reason = format!(
                "the {rows} closure equations have rank {rank}, as many as there are variables: no first-order motion, and nothing moves"
            );
            return answer(Some(0), Proof::Proved, Code::NoCurve, reason);
        }
        if rank == rows {
            let reason = format!(
                "the {rows} closure equations are independent at the configuration: the assemblies near it form a manifold of dimension \
                 {variables} - {rank} = {first}"
            );
            let found = answer(Some(first), Proof::Proved, Code::RegularConfiguration, reason);
            return if first == 1 { self.with_shafts(found) } else { found };
        }
        if first > 1 {
            return none(format!(
                "the {rows} closure equations have rank {rank} at the configuration and {first} first-order motions, more than their \
                 number says; which of them belong to a motion is not decided"
            ));
        }
        match agree(system, self.most) {
            Agreement::Proved { order, bound, joints } => {
                let names: Vec<&str> = joints.into_iter().map(self.name).collect();
                let reason = format!(
                    "each of the {} loops by itself moves along one curve, and {} have on all of these the same values through order {order}, \
                     exactly; curves that are not the same meet with multiplicity {bound} at most. So all loops close along one \
                     curve, and there is only one first-order motion",
                    system.loops.len(),
                    names.join(", ")
                );
                self.with_shafts(answer(Some(1), Proof::Proved, Code::OrderExceedsBound, reason))
            }
            Agreement::Fails | Agreement::Unknown => match solver.follow(&solver.free[0].1, MOST) {
                Err(order) => {
                    let reason = format!(
                        "along the only first-order motion the closure equations fail in order {order}: the assembly is isolated, of \
                         multiplicity {order}"
                    );
                    LinkageMobility { order: Some(order), ..answer(Some(0), Proof::Proved, Code::NoCurve, reason) }
                }
                Ok(_) => none(format!(
                    "all closure equations hold along the only first-order motion through order {MOST}; no bound says that this is enough"
                )),
            },
        }
    }

    /// Adds the shafts that turn alike, and says so.
    fn with_shafts(&self, mut answer: LinkageMobility) -> LinkageMobility {
        for (joints, is_opposite) in shafts(&self.system, self.most, self.is_shaft) {
            let [a, b] = joints.map(self.name);
            let sign = if is_opposite { "-" } else { "" };
            answer.reason +=
                &format!(". The turns of {a} and {b} from there are equal along the motion: {b} = {sign}{a}");
            answer.shafts.push(Shafts { joints, is_opposite });
        }
        answer
    }
}
