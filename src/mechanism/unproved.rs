//! Verdicts on lists that f64 does not prove complete, corrected by exact facts.

use crate::algebra::drawn;
use crate::assembly::Assembly;
use crate::verdict::{Code, Proof, Status, Verdict};

/// Whether a list is proved complete, complex solutions included.
pub(super) fn is_settled(verdict: &Verdict) -> bool {
    verdict.proof.is_proved() && verdict.complex_complete
}

/// Whether it is left to the closure equations over the rationals what the solutions are: nothing of the answer is proved.
pub(super) fn is_left_to_equations(verdict: &Verdict) -> bool {
    verdict.proof == Proof::None && verdict.code != Code::OnlyReal
}

/// The verdict on a self-motion that the closure equations decide, beside a list that is as it was found.
pub(super) fn moving(exact: &Verdict, found: &Verdict, structural_rank: usize) -> Verdict {
    let rest = "the isolated ones are listed, not proved complete";
    let is_alike = exact.self_motion == found.self_motion;
    let reason = match found.status {
        Status::SelfMotion if structural_rank < 6 && is_alike => format!("{}; {}; {rest}", found.reason, exact.reason),
        Status::SelfMotion => format!("{}; {rest}", exact.reason),
        _ => format!("{}; no real curve was found; {rest}", exact.reason),
    };
    let Verdict { status, proof, code, self_motion, .. } = *exact;
    Verdict { status, proof, code, self_motion, complex_complete: false, reason, ..found.clone() }
}

/// The verdict on a self-motion that was measured, where there are finitely many solutions.
pub(super) fn not_moving(finite: &Verdict, found: &Verdict) -> Verdict {
    let Verdict { status, proof, code, ref reason, .. } = *finite;
    Verdict { status, proof, code, self_motion: 0, complex_complete: false, reason: reason.clone(), ..found.clone() }
}

/// Returns the verdict, `incomplete` where it denies every real solution and nothing proves that.
pub(super) fn not_denied(verdict: Verdict) -> Verdict {
    if verdict.status != Status::Unreachable || verdict.proof != Proof::None {
        return verdict;
    }
    let reason = format!("not proved: no real solution was found; {}", verdict.reason);
    Verdict { status: Status::Incomplete, complex_complete: false, reason, ..verdict }
}

/// Returns the verdict on a pose that nothing reaches exactly, where it is not proved that nothing comes near it.
pub(super) fn perhaps_near(verdict: &Verdict, code: Code) -> Verdict {
    let reason = format!(
        "not proved: rounding decides what reaches the pose exactly, and what comes near it is not known in full; {}",
        verdict.reason
    );
    let (status, proof) = (Status::Incomplete, Proof::None);
    Verdict { status, proof, code, complex_complete: false, reason, ..verdict.clone() }
}

/// Corrects the dimension of self-motions where all unknowns but so many have finitely many values. There are fewer dimensions
/// than joints that move: while the others stand still, no joint moves alone. Whether there was something to correct.
pub(super) fn cap(assembly: &mut Assembly, free: usize) -> bool {
    let most = free.saturating_sub(1).max(1);
    for family in &mut assembly.families {
        family.dimension = family.dimension.min(most);
    }
    let is_wrong = assembly.self_motion > most;
    assembly.self_motion = assembly.self_motion.min(most);
    is_wrong
}

/// A list of certified solutions that is as long as a count modulo the drawn prime is complete with a probability.
pub(super) fn probable(verdict: Verdict, assembly: &Assembly) -> Verdict {
    let is_counted = verdict.complex_complete && verdict.code == Code::CountMet;
    let is_certified = assembly.modes.iter().all(|mode| mode.certificate.is_some());
    if !(is_counted && is_certified) {
        return verdict;
    }
    let proof = Proof::Probable { error: drawn::PROBABILITY_OF_ERROR, seed: drawn::seed() };
    Verdict { proof, ..verdict }
}
