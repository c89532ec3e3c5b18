//! Mechanisms that move without a closed loop of their own: arms, and platforms with locked legs.

use super::answer::{JointVariable, Mobility};
use super::decision::solve;
use crate::catalogue::entry::Entry;
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::freedom::Freedom;
use crate::verdict::{Code, Proof, Status};

/// An answer without configurations.
fn answer(
    variables: Vec<JointVariable>,
    equations: usize,
    mobility: Option<usize>,
    (proof, code): (Proof, Code),
    reason: String,
) -> Mobility {
    Mobility {
        variables,
        equations,
        general_rank: None,
        mobility,
        proof,
        code,
        shaky: None,
        held: Vec::new(),
        configurations: Vec::new(),
        complex: 0,
        is_listed: true,
        reason,
    }
}

/// An open chain: nothing binds its joints.
pub(super) fn of_arm(chain: &Chain, variables: Vec<JointVariable>) -> Mobility {
    let freedom = Freedom::of(chain);
    let n = freedom.variables;
    let of_tool = freedom.rank.map_or_else(String::new, |rank| {
        let held = match n - rank {
            0 => "with the tool held nothing moves in general".to_owned(),
            left => format!("with the tool held {left} remain"),
        };
        format!("; screw rank {rank} in general position: so many freedoms has the tool, and {held}")
    });
    let reason = format!("an open chain, whose {n} joint variables nothing binds{of_tool}");
    Mobility { general_rank: freedom.rank, ..answer(variables, 0, Some(n), (Proof::Proved, Code::OpenChain), reason) }
}

/// A platform on legs of the lengths of its first case.
pub(super) fn of_platform(entry: &Entry) -> Result<Mobility> {
    let variables = (1..=6).map(|joint| JointVariable { joint, variable: Variable::Translation }).collect();
    let case = entry.cases.first().ok_or_else(|| Error::Invalid("a platform without legs".to_owned()))?;
    let solution = solve(entry, case.clone(), false)?;
    let verdict = &solution.verdict;
    let are_regular = solution.modes.iter().all(|mode| mode.certified && mode.multiplicity == 1);
    let proof = verdict.proof;
    let (mobility, proof, what) = match verdict.status {
        Status::Complete if are_regular => (Some(0), proof, "every real pose is isolated and regular"),
        Status::Complete => (Some(0), proof, "every real pose is isolated, but one of them is singular"),
        Status::Unreachable => (Some(0), proof, "no pose has legs of these lengths"),
        Status::SelfMotion => (Some(verdict.self_motion), Proof::None, "a self-motion"),
        Status::Incomplete | Status::Unsupported => (None, Proof::None, "whether all poses are isolated is not known"),
    };
    let several = if entry.cases.len() > 1 { " of the first case" } else { "" };
    let reason = format!(
        "the six legs{several} locked, {what}: {}; with free legs the plate has six freedoms, one for every leg",
        verdict.reason
    );
    let legs = solution.platform.as_ref().map(|platform| platform.legs).unwrap_or_default();
    Ok(Mobility {
        general_rank: solution
            .modes
            .iter()
            .any(|mode| mode.real && mode.certified && mode.multiplicity == 1)
            .then_some(6),
        held: legs.into_iter().enumerate().collect(),
        complex: verdict.complex,
        is_listed: verdict.real == 0,
        ..answer(variables, 6, mobility, (proof, verdict.code), reason)
    })
}
