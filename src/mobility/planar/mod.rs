//! Whether a planar linkage moves: exactly at an assembly of the file, or by its count and an assembly that is found.

mod motion;
mod series;
mod system;

use super::spatial::Shafts;
use crate::catalogue::{LinkageConfiguration, LinkageFile};
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Accuracy, Gaussian, Given, Linkage, LinkageJoint, Pair};
use crate::linkage::answer::solve;
use crate::linkage::assembly::{Link, glued};
use crate::linkage::groups::{Groups, groups};
use crate::linkage::straight::with_slides;
use crate::verdict::{Code, Proof, Status, Verdict};
pub use motion::solve_or_move;
use rug::Rational;
use series::Local;
pub(in crate::internal::mobility) use series::Reduced;
use system::System;

/// What is known of the mobility of a linkage.
#[derive(Clone, Debug)]
pub struct LinkageMobility {
    /// The dimension of the real assemblies near the configuration, or of those found; `None` where it is not decided.
    pub mobility: Option<usize>,
    /// `3 (bodies - 1) - 2 joints`, one more for every pair of gears less; in space `6 (bodies - 1)` less the conditions of all joints.
    pub gruebler: i64,
    /// Variables less the rank of the closure equations at the configuration.
    pub first_order: Option<usize>,
    /// The order in which the closure equations fail along the only first-order motion.
    pub order: Option<usize>,
    /// Curves of assemblies that pass through the configuration; 0 where they are not counted.
    pub branches: usize,
    /// What it rests on.
    pub proof: Proof,
    /// Why, as a code.
    pub code: Code,
    /// Why, in words.
    pub reason: String,
    /// In space and on the sphere: shafts that turn alike.
    pub shafts: Vec<Shafts>,
}

impl LinkageMobility {
    /// Returns whether it moves to first order only.
    #[must_use]
    pub fn is_shaky(&self) -> bool {
        matches!((self.first_order, self.mobility), (Some(first), Some(mobility)) if first > mobility)
    }
}

/// Returns Gruebler's count.
fn gruebler(linkage: &Linkage) -> i64 {
    let size = |count: usize| i64::try_from(count).unwrap_or(i64::MAX / 8);
    let gears = linkage.joints.iter().filter(|joint| joint.is_gear()).count();
    3 * (size(linkage.bodies.len()) - 1) - 2 * size(linkage.joints.len() - gears) - size(gears)
}

/// Decides whether a linkage moves: at its configuration, or without one by an assembly that is found.
///
/// # Errors
/// For a configuration that does not close, with the gap; for gears.
pub fn planar_mobility(file: &LinkageFile) -> Result<LinkageMobility> {
    if let Some(gear) = file.linkage.joints.iter().find(|joint| joint.is_gear()) {
        let message = format!("the mobility of linkages with gears such as {} is not decided yet", gear.name);
        return Err(Error::Unsupported(message));
    }
    match &file.configuration {
        Some(configuration) => at(&file.linkage, configuration, file.exact && configuration.exact),
        None => somewhere(&file.linkage, accuracy(file)),
    }
}

/// Decides at a configuration.
fn at(linkage: &Linkage, configuration: &LinkageConfiguration, exact: bool) -> Result<LinkageMobility> {
    let system = System::at(linkage, configuration)?;
    let gruebler = gruebler(linkage);
    let local = system.local();
    let (rank, variables) = (local.rank, system.variables());
    let first = variables - rank;
    let rows = 2 * system.loops();
    let rounded = |proof: Proof| proof.of_rounded(!exact);
    let answer = |mobility: Option<usize>, proof: Proof, code: Code, reason: String| LinkageMobility {
        mobility,
        gruebler,
        first_order: Some(first),
        order: None,
        branches: 0,
        proof,
        code,
        reason,
        shafts: Vec::new(),
    };
    if !system.is_closed() {
        let reason = format!(
            "the configuration closes to {:.1e} m only: its rank, {rank} of {variables} variables, is measured",
            system.gap()
        );
        let mobility = (rank == rows || first == 0).then_some(first);
        return Ok(answer(mobility, Proof::None, Code::NotDecided, reason));
    }
    Ok(match local.what {
        Local::Regular if rank == rows => {
            let reason = format!(
                "the {rows} closure equations are independent at the configuration: the assemblies near it form a manifold of dimension \
                 {variables} - {rank} = {first}"
            );
            answer(Some(first), rounded(Proof::Proved), Code::RegularConfiguration, reason)
        }
        Local::Regular => {
            let reason = format!(
                "the {rows} closure equations have rank {rank}, as many as there are variables: no first-order motion, and nothing moves"
            );
            answer(Some(0), rounded(Proof::Proved), Code::NoCurve, reason)
        }
        Local::Moves { order, bound } => {
            let along = if first == 1 {
                "the only first-order motion".to_owned()
            } else {
                format!("{} first-order motions", local.lines)
            };
            let reason = format!(
                "all closure equations hold along {along} through order {order}, exactly, and no isolated assembly has a multiplicity \
                 above {bound}: the assemblies near the configuration form a manifold of dimension {first}"
            );
            answer(Some(first), rounded(Proof::Proved), Code::OrderExceedsBound, reason)
        }
        Local::Isolated { order } => {
            let reason = format!(
                "along the only first-order motion the closure equations fail in order {order}: the assembly is isolated, of \
                 multiplicity {order}"
            );
            LinkageMobility { order: Some(order), ..answer(Some(0), rounded(Proof::Proved), Code::NoCurve, reason) }
        }
        Local::Definite => {
            let reason = format!(
                "the second-order part of a closure equation on the {first} first-order motions is definite: no other real assembly is \
                 near"
            );
            LinkageMobility { order: Some(2), ..answer(Some(0), rounded(Proof::Proved), Code::NoCurve, reason) }
        }
        Local::Crossing => {
            let reason = format!(
                "one closure equation depends on the others at the configuration, and its second-order part on the {first} first-order \
                 motions is regular and indefinite: the assemblies near form a cone of dimension {}{}",
                first - 1,
                if first == 2 { ", two curves that cross" } else { "" }
            );
            let branches = if first == 2 { 2 } else { 0 };
            LinkageMobility {
                branches,
                ..answer(Some(first - 1), rounded(Proof::Proved), Code::RegularConfiguration, reason)
            }
        }
        Local::Undecided { order } => {
            let reason = format!(
                "the closure equations have rank {rank} at the configuration and {first} first-order motions; through order {order} this \
                 does not decide which of them belong to a motion"
            );
            answer(None, Proof::None, Code::NotDecided, reason)
        }
    })
}

/// Half-angle tangents and displacements tried for the joints that are held.
const TRIED: [[i32; 2]; 10] = [[1, 2], [-1, 2], [2, 1], [-2, 1], [1, 5], [-1, 5], [1, 1], [-1, 1], [5, 1], [-5, 1]];

/// What is known of the numbers of a file.
fn accuracy(file: &LinkageFile) -> Accuracy {
    match (file.exact, file.squared) {
        (true, _) => Accuracy::Exact,
        (false, true) => Accuracy::Squared,
        (false, false) => Accuracy::Rounded,
    }
}

/// Holds as many joints as the linkage has freedoms by count, and looks for a real assembly.
fn somewhere(linkage: &Linkage, accuracy: Accuracy) -> Result<LinkageMobility> {
    let exact = accuracy == Accuracy::Exact;
    let gruebler = gruebler(linkage);
    let counted = grouped(linkage, &[])?;
    let answer = |mobility: Option<usize>, proof: Proof, code: Code, reason: String| LinkageMobility {
        mobility,
        gruebler,
        first_order: mobility,
        order: None,
        branches: 0,
        proof,
        code,
        reason,
        shafts: Vec::new(),
    };
    if let Some(group) = counted.list.iter().find(|group| group.count < 0) {
        let names: Vec<&str> = group.clusters.iter().take(8).map(|body| linkage.bodies[*body].name.as_str()).collect();
        let reason = format!(
            "the bodies {} have more joints than hold them together: such a linkage is decided at a [configuration]",
            names.join(", ")
        );
        return Ok(answer(None, Proof::None, Code::NotDecided, reason));
    }
    let freedoms = freedoms_of(&counted);
    if linkage.joints.len() + 1 == linkage.bodies.len() {
        let reason = "the bodies form a tree, whose joints nothing binds".to_owned();
        return Ok(answer(Some(freedoms), Proof::Proved, Code::OpenChain, reason));
    }
    let mut held: Vec<usize> = Vec::new();
    let mut left = freedoms;
    for joint in 0..linkage.joints.len() {
        if left == 0 {
            break;
        }
        let trial = [held.clone(), vec![joint]].concat();
        let found = grouped(linkage, &trial)?;
        if freedoms_of(&found) < left && found.list.iter().all(|group| group.count >= 0) {
            left = freedoms_of(&found);
            held = trial;
        }
    }
    for k in 0..TRIED.len() {
        let given: Vec<Given> =
            held.iter().enumerate().map(|(place, joint)| given(linkage, *joint, k + 3 * place)).collect();
        let Ok(found) = solve(linkage, &given, accuracy) else { continue };
        let Verdict { status, proof, self_motion, .. } = found.verdict;
        if freedoms == 0 && status == Status::SelfMotion && proof != Proof::None {
            return Ok(answer(Some(self_motion), proof, Code::SelfMotion, found.verdict.reason));
        }
        if found.modes.iter().any(|mode| mode.real && mode.multiplicity == 1) {
            return Ok(regular(linkage, freedoms, exact, &answer));
        }
        if freedoms == 0 {
            break;
        }
    }
    let reason = "no real assembly was found at the values of the joints that were tried".to_owned();
    Ok(answer(None, Proof::None, Code::NotDecided, reason))
}

/// Says what follows from a simple assembly at which as many joints are held as there are freedoms by count.
fn regular(
    linkage: &Linkage,
    freedoms: usize,
    exact: bool,
    answer: &impl Fn(Option<usize>, Proof, Code, String) -> LinkageMobility,
) -> LinkageMobility {
    let manifold = format!(
        "there is a simple real assembly with {freedoms} joints held: the assemblies near it form a manifold of dimension {freedoms}"
    );
    // Where the equations of one loop are dependent, all its links lie in one line, and such assemblies are finitely many.
    let is_ring = linkage.joints.len() == linkage.bodies.len()
        && linkage.joints.iter().all(|joint| matches!(joint.pair, Pair::Revolute))
        && freedoms > 0;
    if is_ring {
        let reason = format!(
            "{manifold}; the equations of a single loop of pins are dependent in finitely many assemblies only, so that none has more"
        );
        return answer(Some(freedoms), Proof::Proved.of_rounded(!exact), Code::RegularConfiguration, reason);
    }
    if freedoms > 0 && linkage.joints.iter().all(LinkageJoint::is_prismatic) {
        let reason = format!("{manifold}; all equations of slides alone are linear, so that these are all assemblies");
        return answer(Some(freedoms), Proof::Proved.of_rounded(!exact), Code::RegularConfiguration, reason);
    }
    let reason = format!("{manifold}; that no other assemblies move in more dimensions is not proved");
    answer(Some(freedoms), Proof::None, Code::NotDecided, reason)
}

/// The freedoms that are left by count, with those of cycles of slides alone.
fn freedoms_of(groups: &Groups) -> usize {
    groups.freedoms + groups.list.iter().map(|group| usize::try_from(group.count).unwrap_or(0)).sum::<usize>()
}

fn grouped(linkage: &Linkage, held: &[usize]) -> Result<Groups> {
    let given: Vec<Given> = held.iter().map(|joint| given(linkage, *joint, 0)).collect();
    let (merged, links): (_, Vec<Link>) = glued(linkage, &given)?;
    Ok(with_slides(linkage, &links, groups(linkage.bodies.len(), &links, merged.clone()), &merged))
}

/// Returns a value of a joint.
fn given(linkage: &Linkage, joint: usize, number: usize) -> Given {
    let [a, b] = TRIED[number % TRIED.len()];
    let value = Rational::from((a, b));
    if let Pair::Prismatic { length, .. } = &linkage.joints[joint].pair {
        return Given::Shift { joint, shift: value / length, square: None, line: 1 };
    }
    let square = Rational::from(value.square_ref());
    let whole = Rational::from(&square + 1);
    let turn = Gaussian { re: (1 - square) / &whole, im: value * 2 / whole };
    Given::Turn { joint, turn, within: None, line: 1 }
}
