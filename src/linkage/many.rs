//! The answer to a case of a linkage that has more assemblies than are listed.

use super::answer::{LinkageAnswer, LinkageGroup, LinkageMode, mode};
use super::assembly::{Asked, MOST_BRANCHES, groups_of};
use super::count::{Count, Dyads, Halt, MOST_NEAR, MOST_REAL, Nearest};
use super::groups::Group;
use super::state::State;
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Accuracy, Given, Linkage};
use crate::verdict::{Code, Proof, Status, Verdict};
use std::time::Instant;

/// Dyads beyond which the branches of complex assemblies are not followed for the real ones: 1024 of them take a second.
const MANY: usize = 10;

/// Lists the real assemblies of a linkage that falls into many dyads, or counts all where they are too many for a list; `None` for others.
/// Where values of joints are given, the assemblies nearest to them are listed, and the others are not counted.
///
/// # Errors
/// As [`groups_of`], and where there are more branches than are counted.
pub fn of_many(
    linkage: &Linkage,
    given: &[Given],
    accuracy: Accuracy,
    asked: Asked<'_>,
) -> Result<Option<LinkageAnswer>> {
    let start = Instant::now();
    let groups = groups_of(linkage, given)?.list;
    let is_listed = groups.len() <= MOST_BRANCHES.ilog2() as usize;
    if groups.len() <= MANY || (is_listed && (asked.complex || asked.near.is_some())) {
        return Ok(None);
    }
    let Some(dyads) = Dyads::of(linkage, given, &groups, asked.stop) else { return Ok(None) };
    let dyad = |group: &Group| LinkageGroup {
        bodies: group.clusters.iter().map(|body| vec![*body]).collect(),
        count: 2,
        route: "quadratic".to_owned(),
    };
    let listed = groups.iter().map(dyad).collect();
    let answer = |verdict, modes| LinkageAnswer {
        verdict,
        modes,
        families: Vec::new(),
        groups: listed,
        listed: false,
        solve_us: start.elapsed().as_secs_f64() * 1e6,
    };
    let stopped = |halt: Halt| match halt {
        Halt::Stopped => Ok("the search was ended".to_owned()),
        Halt::Undecided(reason) | Halt::Open(reason) => Ok(reason),
        Halt::TooMany => Err(Error::Unsupported(format!(
            "{} dyads have more branches than are counted; --near lists the assemblies nearest to given joint values",
            groups.len()
        ))),
    };
    let rounded = Proof::Proved.of_rounded(accuracy >= Accuracy::Squared);
    let all_real = |states: &[State]| {
        let modes: Vec<LinkageMode> = states.iter().map(|state| mode(linkage, state)).collect();
        let real = modes.iter().map(|mode| mode.multiplicity).sum();
        (Verdict { complex_complete: false, certified: modes.len(), ..of_all_real(real, rounded) }, modes)
    };
    let Some(near) = asked.near else {
        let none = vec![None; linkage.joints.len()];
        let found = (!asked.complex).then(|| dyads.nearest(&none, MOST_REAL));
        if let Some(Ok(Nearest { states, is_all: true })) = found {
            let (verdict, modes) = all_real(&states);
            return Ok(Some(LinkageAnswer { listed: true, ..answer(verdict, modes) }));
        }
        if is_listed {
            return Ok(None);
        }
        return Ok(Some(match dyads.count() {
            Ok(count) => answer(of_count(count, rounded, groups.len()), Vec::new()),
            Err(halt) => answer(unproved(&stopped(halt)?, 0), Vec::new()),
        }));
    };
    Ok(Some(match dyads.nearest(near, MOST_NEAR) {
        Ok(Nearest { states, is_all }) => {
            let (verdict, modes) = all_real(&states);
            let verdict = if is_all {
                verdict
            } else {
                let reason = format!(
                    "the {} nearest to the given values are listed, nearest first; the others, of {} dyads, are not counted",
                    modes.len(),
                    groups.len()
                );
                unproved(&reason, verdict.real)
            };
            LinkageAnswer { listed: is_all, ..answer(verdict, modes) }
        }
        Err(halt) => answer(unproved(&stopped(halt)?, 0), Vec::new()),
    }))
}

/// Returns the verdict of a list of which it is not known that it holds all, with this many assemblies.
fn unproved(reason: &str, real: usize) -> Verdict {
    Verdict {
        status: Status::Incomplete,
        proof: Proof::None,
        code: Code::TooFew,
        complex_complete: false,
        complex: real,
        real,
        at_infinity: 0,
        self_motion: 0,
        certified: real,
        reason: format!("not proved: {reason}"),
    }
}

/// Returns the verdict of a list of all real assemblies.
fn of_all_real(real: usize, proof: Proof) -> Verdict {
    let count = of_count(Count { complex: real, real }, proof, 0);
    let reason = "every real branch of the dyads was followed; complex ones were not looked for".to_owned();
    Verdict { reason, ..count }
}

/// Returns the verdict on a number of assemblies.
fn of_count(Count { complex, real }: Count, proof: Proof, dyads: usize) -> Verdict {
    Verdict {
        status: if real == 0 { Status::Unreachable } else { Status::Complete },
        proof,
        code: Code::GeneralBoundMet,
        complex_complete: true,
        complex,
        real,
        at_infinity: 0,
        self_motion: 0,
        certified: 0,
        reason: format!(
            "the linkage falls into {dyads} dyads, which have two each in every branch, with multiplicity; assemblies are counted and \
             not listed: --near lists those nearest to given joint values"
        ),
    }
}
