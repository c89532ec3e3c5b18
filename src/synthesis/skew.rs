//! RR dyads in space: two skew axes.
//!
//! Axes that meet or are parallel turn a body about points or in planes only: no two of its positions then differ by a screw with an
//! angle and a translation. Where two positions do, every dyad has skew axes, and the unknowns of skew axes miss none.
//! \[Wittenburg2016, 7.2\]

use super::answer::{Answer, undecided};
use super::equations::Wanted;
use super::{EFFORT, by_basis};
use crate::catalogue::SynthesisFile;

/// All RR dyads of a file.
pub(super) fn synthesize(file: &SynthesisFile, wanted: &Wanted) -> Answer {
    if wanted.needs_skew_axes() {
        return by_basis(file, wanted, EFFORT);
    }
    let mut answer = undecided();
    answer.verdict.reason =
        "no two positions differ by a screw with an angle and a translation: axes that meet or are parallel may take the body through \
         them as well, which is a synthesis on the sphere or in the plane"
            .to_owned();
    answer
}
