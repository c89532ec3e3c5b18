//! Claims about syntheses: numbers of dyads, and dyads.

use super::{Finding, Judgement, Sort};
use crate::catalogue::{ClaimedDyad, SynthesisFile};
use crate::synthesis::{Mode, synthesize};
use crate::verdict::Status;

/// Judges the claims of the file of a synthesis.
pub(super) fn judge(file: &SynthesisFile) -> Judgement {
    let answer = synthesize(file);
    let verdict = &answer.verdict;
    let mut judgement = Judgement { cases: 1, ..Judgement::default() };
    match verdict.status {
        Status::Complete | Status::Unreachable => judgement.complete = 1,
        Status::SelfMotion => judgement.self_motions = 1,
        Status::Incomplete | Status::Unsupported => {}
    }
    let finding = |line, sort, holds, message| Finding { case: 1, file: None, line, sort, holds, message };
    for (sort, claimed, found, is_known) in [
        (Sort::Complex, file.expected.complex, verdict.complex, judgement.complete == 1),
        (Sort::Real, file.expected.real, verdict.real, judgement.complete == 1),
        (Sort::Dimension, file.expected.dimension, verdict.self_motion, verdict.status != Status::Incomplete),
    ] {
        if let Some(claimed) = claimed {
            let message = format!("claims {}: {claimed}, found {found} ({})", sort.word(), verdict.status.word());
            judgement.findings.push(finding(file.line, sort, is_known && claimed == found, message));
        }
    }
    for claim in &file.claims {
        let distance = answer.modes.iter().filter(|mode| mode.is_real).map(|mode| distance(claim, mode));
        let best = distance.fold(f64::INFINITY, f64::min);
        // A number claimed to a number of correct digits is off by at most one unit of the last one.
        let tolerance = 10_f64.powi(-i32::try_from(claim.digits).unwrap_or(i32::MAX));
        let message = format!("claims a dyad to {} digits, the nearest one is off by {best:.1e}", claim.digits);
        judgement.findings.push(finding(claim.line, Sort::Found, best <= tolerance, message));
    }
    judgement
}

/// Returns the largest difference of a number of a claim from that of a mode; infinite if the mode has no such number.
fn distance(claim: &ClaimedDyad, mode: &Mode) -> f64 {
    let of = |(name, values): &(String, Vec<f64>)| match mode.dyad.get(name) {
        Some(found) if found.len() == values.len() => {
            found.iter().zip(values).map(|(z, x)| (z.re - x).abs()).fold(0.0, f64::max)
        }
        _ => f64::INFINITY,
    };
    claim.values.iter().map(of).fold(0.0, f64::max)
}
