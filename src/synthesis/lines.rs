//! CC dyads: their directions are those of spherical RR dyads, and their moments follow from linear equations.

use super::answer::{Answer, Family, found, undecided};
use super::by_basis;
use super::dyad::dyad;
use super::equations::Wanted;
use super::solved::{Found, solve};
use super::{EFFORT, cells};
use crate::catalogue::SynthesisFile;
use crate::verdict::{Code, Status};

/// Products of words for all unknowns of two lines at once: some seconds.
const ALL_AT_ONCE: u64 = 100_000_000;

/// All CC dyads of a file. Where the directions are finitely many and the linear equations of the moments independent at each
/// of them, one dyad belongs to each, with the same multiplicity.
pub(super) fn synthesize(file: &SynthesisFile, wanted: &Wanted) -> Answer {
    let directions = wanted.directions();
    let equations = |place: &cells::Place<_>| directions.equations(place);
    match solve(&directions.shape(), &equations, EFFORT) {
        Some(Found::Points(points)) => {
            let answer = found(file, wanted, Found::Points(points), dyad);
            if answer.verdict.certified == answer.modes.len() {
                return answer;
            }
            by_basis(file, wanted, ALL_AT_ONCE)
        }
        Some(Found::Family(dimension)) if wanted.freedom() > 0 => family(wanted, dimension),
        _ => by_basis(file, wanted, ALL_AT_ONCE),
    }
}

/// The answer for fewer than five positions, whose directions form a family of this dimension.
fn family(wanted: &Wanted, directions: usize) -> Answer {
    let dimension = usize::try_from(wanted.freedom()).unwrap_or(0);
    let reason = format!(
        "a Gröbner basis over the rationals: the directions of both lines form a family of dimension {directions}, complex ones counted; \
         with the linear conditions of the moments the dyads have dimension {dimension} by the number of unknowns and conditions, \
         and that it is not larger is not proved"
    );
    let mut answer = undecided();
    (answer.verdict.status, answer.verdict.code) = (Status::SelfMotion, Code::SelfMotion);
    (answer.verdict.self_motion, answer.verdict.reason) = (dimension, reason);
    answer.families = vec![Family { dimension, sample: None }];
    answer
}
