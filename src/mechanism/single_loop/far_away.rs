//! Poses that the links cannot bridge.

use super::Question;
use crate::assembly::Assembly;
use crate::verdict::{Verdict, out_of_reach};

/// Where the distance is this many times the length of all links, complex solutions are not looked for. The cosines of their joint
/// angles are of the order of the ratio, and closed forms square them: from 2^13 on that takes half the digits of f64, and the numbers
/// of the exact side grow with the distance.
const FAR: f64 = 8192.0;

impl Question<'_> {
    /// Returns the distance to be bridged and the length of all links, if the former is larger by more than the tolerance: what
    /// misses the pose by less is near.
    pub(super) fn too_far(&self) -> Option<(f64, f64)> {
        let is_beyond =
            |(gap, links): &(f64, f64)| self.tolerance.is_none_or(|own| gap - links > own.length + own.angle * links);
        self.prepared.solver.too_far(self.gap).filter(is_beyond)
    }

    /// Returns the verdict where the distance is so large that nothing but the proof is of use; the list is emptied.
    pub(super) fn far_away(&self, assembly: &mut Assembly) -> Option<Verdict> {
        let (gap, links) = self.too_far().filter(|(gap, links)| *gap > FAR * links)?;
        assembly.clear();
        Some(out_of_reach((gap, links), assembly))
    }
}
