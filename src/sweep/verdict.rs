//! The proof of a sweep.

use super::{AssemblySweep, Sweep};
use crate::verdict::{Code, Proof, Status};

/// Is every branch found, and why, or why not.
#[derive(Clone, Debug)]
pub struct SweepVerdict {
    /// `Complete`, `Unreachable` where the loop closes at no input, or `Incomplete`.
    pub status: Status,
    /// Its proof.
    pub proof: Proof,
    /// The reason as a code.
    pub code: Code,
    /// The reason in words.
    pub reason: String,
}

/// The reason of a code in words.
fn reason(code: Code) -> &'static str {
    match code {
        Code::BranchesProved => {
            "between all critical inputs the exact closure polynomial has as many real roots as there are branches, and at \
             each critical input it is proved what the branches do"
        }
        Code::NoExactRoute => {
            "not proved: the critical inputs of this kind of loop are not computed exactly; branches were followed in floating \
             point"
        }
        Code::InputLocked => "not proved: at some input the loop may move while the input stands still",
        Code::SingularNotDecided => "not proved: at some critical input it is not decided what the branches do",
        Code::Interrupted => "not proved: the sweep was stopped before the end of its range",
        _ => "not proved: at some inputs the branches that were found are not those of the exact closure polynomial",
    }
}

/// The reason why they are not proved.
const BY_DISTANCES: &str =
    "not proved: the assemblies of every input are, but between the inputs branches are joined by their distances";

impl SweepVerdict {
    /// The verdict before anything is known.
    pub(super) fn none() -> Self {
        Self { status: Status::Incomplete, proof: Proof::None, code: Code::NoExactRoute, reason: String::new() }
    }

    /// The verdict on a sweep whose bridges are all proved, or not, for this reason.
    pub(super) fn of(sweep: &Sweep, unproved: Option<Code>, is_rounded: bool) -> Self {
        let is_whole = sweep.samples.len() > sweep.range.steps;
        let code = match unproved {
            _ if !is_whole => Code::Interrupted,
            Some(code) => code,
            None if sweep.unresolved() > 0 => Code::BranchesNotMatched,
            None => Code::BranchesProved,
        };
        let (status, proof) = match code {
            Code::BranchesProved if sweep.branches.is_empty() => (Status::Unreachable, Proof::Proved),
            Code::BranchesProved => (Status::Complete, Proof::Proved),
            _ => (Status::Incomplete, Proof::None),
        };
        Self { status, proof: proof.of_rounded(is_rounded), code, reason: reason(code).to_owned() }
    }

    /// The verdict on a sweep of assemblies whose links are all proved, because of what is said, or not, for this reason.
    pub(super) fn of_assemblies<M>(sweep: &AssemblySweep<M>, unproved: Option<Code>, because: &str) -> Self {
        let code = match unproved {
            _ if sweep.unresolved() > 0 => Code::BranchesNotMatched,
            None => Code::BranchesProved,
            Some(code) => code,
        };
        let (status, proof) = match code {
            Code::BranchesProved if sweep.branches.is_empty() => (Status::Unreachable, Proof::Proved),
            Code::BranchesProved => (Status::Complete, Proof::Proved),
            _ => (Status::Incomplete, Proof::None),
        };
        let reason = match code {
            Code::BranchesProved => because,
            Code::NoExactRoute => BY_DISTANCES,
            _ => reason(code),
        };
        Self { status, proof, code, reason: reason.to_owned() }
    }
}
