//! Claims about frameworks and rational motions.

use super::{Finding, Judgement, Sort};
use crate::catalogue::{FrameworkFile, MotionFile};
use crate::error::Result;
use crate::factoring::{Loop, factor};

/// Number of steps that suffice to see a motion.
const STEPS: usize = 10;

/// Judges the claims of a framework file about its motions.
///
/// # Errors
/// If there is no realisation with the given lengths.
pub(super) fn framework(file: &FrameworkFile) -> Result<Judgement> {
    let answer = file.mobility(STEPS)?;
    let mut findings = Vec::new();
    if let Some(claimed) = file.dimension {
        let (least, most) = answer.freedom();
        let proof = if answer.is_proved() { "proved" } else { "not proved" };
        let message = format!("claims motions of dimension {claimed}, found {least} to {most}, {proof}");
        findings.push(finding(file.line, (least, most) == (claimed, claimed) && answer.is_proved(), message));
    }
    if let Some(claimed) = file.infinitesimal {
        let message = format!("claims {claimed} motions to first order, found {}", answer.infinitesimal);
        findings.push(finding(file.line, answer.infinitesimal == claimed, message));
    }
    Ok(Judgement { findings, ..Judgement::default() })
}

/// Judges the claims of a file of a rational motion about its factorisations and the loop they close.
///
/// # Errors
/// Never: the pair of factorisations is chosen here.
pub(super) fn motion(file: &MotionFile) -> Result<Judgement> {
    let factored = factor(file);
    let closed = factored.closed_loop(None)?;
    let mut findings = Vec::new();
    let mut count = |claimed: Option<usize>, found: Option<usize>, what: &str| {
        if let Some(claimed) = claimed {
            let shown = found.map_or("none".to_owned(), |found| found.to_string());
            let message = format!("claims {what} {claimed}, found {shown}");
            findings.push(finding(file.line, found == Some(claimed), message));
        }
    };
    count(file.factorisations, Some(factored.factorisations()), "factorisations:");
    count(file.order, closed.as_ref().map(|closed| closed.order), "a screw system of order");
    let sure = |closed: &Loop| Some(closed.mobility()).filter(|(least, most)| least == most).map(|(least, _)| least);
    count(file.dimension, closed.as_ref().and_then(sure), "motions of dimension");
    if let Some(claimed) = &file.closed_loop {
        let found = closed.map_or("none".to_owned(), |closed| closed.letters);
        findings.push(finding(file.line, found == *claimed, format!("claims a loop {claimed}, found {found}")));
    }
    Ok(Judgement { findings, ..Judgement::default() })
}

fn finding(line: usize, holds: bool, message: String) -> Finding {
    Finding { case: 1, file: None, line, sort: Sort::Dimension, holds, message }
}
