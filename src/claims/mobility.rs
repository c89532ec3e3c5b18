//! Claims about the motion of a loop.

use super::{Finding, Sort};
use crate::catalogue::entry::{Case, Entry};
use crate::mobility::mobility;

/// Judges the claims of a case about the motion of its loop. `number` is that of the case in the file, from 1.
pub(super) fn findings(entry: &Entry, case: &Case, number: usize) -> Vec<Finding> {
    let claims = [("mobility", case.expected.mobility), ("screw rank", case.expected.screw_rank)];
    if claims.iter().all(|(_, claimed)| claimed.is_none()) {
        return Vec::new();
    }
    let answer = mobility(entry);
    let finding = |(what, claimed): (&str, Option<usize>)| {
        let claimed = claimed?;
        let (found, why) = match &answer {
            Ok(answer) => {
                let found = if what == "mobility" { answer.mobility } else { answer.screw_rank() };
                (found, answer.reason.clone())
            }
            Err(error) => (None, error.to_string()),
        };
        let shown = found.map_or_else(|| "none".to_owned(), |found| found.to_string());
        let message = format!("claims {what} {claimed}, found {shown}: {why}");
        Some(Finding {
            case: number,
            file: None,
            line: case.line,
            sort: Sort::Mobility,
            holds: found == Some(claimed),
            message,
        })
    };
    claims.into_iter().filter_map(finding).collect()
}
