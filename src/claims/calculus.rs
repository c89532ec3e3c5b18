//! Claims about displacements and lines.

use super::{Finding, Judgement, Sort};
use crate::catalogue::CalculusFile;
use crate::error::Result;
use crate::lines;
use crate::verdict::Status;

/// Judges the claims of a file on the number of solutions of each of its problems.
///
/// # Errors
/// As [`lines::answers`].
pub(super) fn calculus(file: &CalculusFile) -> Result<Judgement> {
    let answers = lines::answers(file)?;
    let mut judgement = Judgement { cases: answers.len(), ..Judgement::default() };
    for (case, answer) in (1..).zip(&answers) {
        let verdict = &answer.verdict;
        let is_complete = verdict.proof.is_proved() && matches!(verdict.status, Status::Complete | Status::Unreachable);
        judgement.complete += usize::from(is_complete);
        judgement.self_motions += usize::from(verdict.status == Status::SelfMotion);
        let claims = [
            (Sort::Complex, file.claims.complex, verdict.complex, "complex solutions"),
            (Sort::Real, file.claims.real, verdict.real, "real solutions"),
            (Sort::Dimension, file.claims.dimension, verdict.self_motion, "for the dimension"),
        ];
        for (sort, claimed, found, what) in claims {
            if let Some(claimed) = claimed {
                let message = format!("claims {claimed} {what}, found {found}");
                let line = file.claims.line;
                judgement.findings.push(Finding { case, file: None, line, sort, holds: claimed == found, message });
            }
        }
    }
    Ok(judgement)
}
