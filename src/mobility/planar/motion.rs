//! Assemblies of a linkage that moves at the configuration of its file.

use super::system::System;
use super::{LinkageMobility, at};
use crate::algebra::ring::Ring;
use crate::catalogue::{LinkageCase, LinkageConfiguration, LinkageFile};
use crate::error::Result;
use crate::kinematics::linkage::{Linkage, Pair};
use crate::linkage::answer::{LinkageAnswer, LinkageFamily, solve_asked};
use crate::linkage::assembly::Asked;
use crate::linkage::many::of_many;
use crate::linkage::state::{State, number, turned};
use crate::verdict::{Code, Proof, Status, Verdict};
use std::sync::atomic::Ordering;

/// Order up to which motions are followed to see which joints move: at a dead point one begins in order 2, where several meet in one a
/// little later.
const LAST: usize = 8;

/// Finds all assemblies of a case, or counts them where they are too many for a list. Where their list is not proved and nothing is given, the mobility at the configuration of the file
/// shows whether they are infinitely many.
///
/// # Errors
/// As [`solve_asked`].
pub fn solve_or_move(file: &LinkageFile, case: &LinkageCase, asked: Asked<'_>) -> Result<LinkageAnswer> {
    if let Some(answer) = of_many(&file.linkage, &case.given, file.accuracy(case), asked)? {
        return Ok(answer);
    }
    let answer = solve_asked(&file.linkage, &case.given, file.accuracy(case), asked)?;
    let Verdict { status, proof, self_motion, .. } = answer.verdict;
    let is_open = match status {
        Status::Incomplete => true,
        Status::SelfMotion => proof == Proof::None,
        _ => false,
    };
    let is_open = is_open && case.given.is_empty() && !asked.stop.load(Ordering::Relaxed);
    let Some(configuration) = file.configuration.as_ref().filter(|_| is_open) else { return Ok(answer) };
    // Of a set whose dimension is known, complex assemblies included, the real ones at the configuration are to have it.
    let is_all = |motion: &Motion| status == Status::Incomplete || motion.family.dimension == self_motion;
    Ok(match motion(file, configuration).filter(is_all) {
        Some(motion) => motion.in_place_of(answer),
        None => answer,
    })
}

/// A motion of a linkage, and what proves it.
struct Motion {
    family: LinkageFamily,
    mobility: LinkageMobility,
}

impl Motion {
    /// Returns the answer that the linkage moves, beside the assemblies that were found.
    fn in_place_of(self, mut answer: LinkageAnswer) -> LinkageAnswer {
        let Self { family, mobility } = self;
        let verdict = &mut answer.verdict;
        verdict.status = Status::SelfMotion;
        verdict.code = Code::SelfMotion;
        verdict.proof = mobility.proof;
        verdict.self_motion = family.dimension;
        verdict.reason =
            format!("at the configuration of the file {}; other assemblies are not all looked for", mobility.reason);
        answer.families = vec![family];
        answer
    }
}

/// The motion at a configuration; `None` where it is not proved.
fn motion(file: &LinkageFile, configuration: &LinkageConfiguration) -> Option<Motion> {
    let linkage = &file.linkage;
    let state = placed(linkage, configuration)?;
    let mobility = at(linkage, configuration, file.exact && configuration.exact).ok()?;
    let dimension = mobility.mobility.filter(|dimension| *dimension > 0 && mobility.proof == Proof::Proved)?;
    // Where branches cross, not every first-order motion belongs to one.
    if mobility.first_order != Some(dimension) {
        return None;
    }
    let system = System::at(linkage, configuration).ok()?;
    let motions = system.motions(LAST);
    let moves = |joint: &usize| {
        let at_rest = Vec::new();
        let [first, second] = linkage.joints[*joint].of.map(|body| system.variable_of(body));
        motions.iter().any(|series| {
            let own = |variable: Option<usize>| variable.map_or(&at_rest, |variable| &series[variable]);
            let [one, two] = [own(first), own(second)];
            (0..=LAST)
                .any(|order| one.get(order).cloned().unwrap_or_default() != two.get(order).cloned().unwrap_or_default())
        })
    };
    let joints = (0..linkage.joints.len()).filter(moves).collect();
    Some(Motion { family: LinkageFamily::at(linkage, &state, dimension, joints), mobility })
}

/// The assembly at a configuration of revolute joints; `None` of others, or where bodies hang together by none.
fn placed(linkage: &Linkage, configuration: &LinkageConfiguration) -> Option<State> {
    let mut state = State::new(linkage.bodies.len(), 1);
    let of = |body: usize| number(&configuration.turns[body]);
    for (index, joint) in linkage.joints.iter().enumerate() {
        if joint.pair != Pair::Revolute {
            return None;
        }
        let [first, second] = joint.of;
        if state.bodies[first].0 != state.bodies[second].0 {
            let turn = of(first).mirrored().mul(&of(second));
            state.glue(first, second, &turned(linkage, index, turn));
        }
    }
    let first = state.bodies[0].0;
    state.bodies.iter().all(|body| body.0 == first).then_some(state)
}
