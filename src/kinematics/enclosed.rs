//! Loops whose constants are enclosed, and their rounding.

use super::closed_loop::{ClosedLoop, OpenLoop, OpenSsDyad, SsDyad, Stretch};
use super::motion::Motion;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::Ring;

/// Bits by which entries must be known beyond the rounding, so that their error does not affect it.
const SPARE: i32 = 10;

/// The longest coordinate of a motion's translation, as a power of two.
fn reach(motion: &Motion<Enclosure>) -> i32 {
    motion.translation.iter().map(Enclosure::size).fold(i32::MIN, i32::max)
}

/// Rounds a motion once to numbers of `digits` digits; `None` where it is not known to that precision: rotations in parts of 1,
/// translations in parts of the longest coordinate and of `length`, a power of two.
pub fn rounded<R: Ring>(motion: &Motion<Enclosure>, length: i32, digits: u32) -> Option<Motion<R>> {
    let digits = digits.cast_signed() + SPARE;
    let is_known = |x: &Enclosure, size: i32| x.off() == i32::MIN || x.off() <= size.saturating_sub(digits);
    let longest = length.max(reach(motion));
    let longest = if longest == i32::MIN { 0 } else { longest };
    let turns = motion.rotation.iter().flatten().all(|x| is_known(x, 0));
    let shifts = motion.translation.iter().all(|x| is_known(x, longest));
    if turns && shifts { motion.map(Enclosure::image) } else { None }
}

/// The length of the longest of some links, or else of some ends, or else 1, as a power of two.
fn longest(links: &[Motion<Enclosure>], ends: &[&Motion<Enclosure>]) -> i32 {
    let of_links = links.iter().map(reach).fold(i32::MIN, i32::max);
    let of_ends = || ends.iter().map(|end| reach(end)).fold(i32::MIN, i32::max);
    [of_links, of_ends(), 0].into_iter().find(|length| *length != i32::MIN).unwrap_or(0)
}

fn all<R: Ring, const N: usize>(motions: &[Motion<Enclosure>; N], length: i32, digits: u32) -> Option<[Motion<R>; N]> {
    let images: Option<Vec<Motion<R>>> = motions.iter().map(|motion| rounded(motion, length, digits)).collect();
    images?.try_into().ok()
}

impl OpenLoop<Enclosure> {
    /// Rounds every constant of the loop once to numbers of `digits` digits; `None` where one is not known to that precision.
    #[must_use]
    pub fn rounded<R: Ring>(&self, digits: u32) -> Option<OpenLoop<R>> {
        let length = longest(&self.constants, &[&self.before_gap, &self.after_gap]);
        Some(OpenLoop {
            variables: self.variables,
            constants: all(&self.constants, length, digits)?,
            before_gap: rounded(&self.before_gap, length, digits)?,
            after_gap: rounded(&self.after_gap, length, digits)?,
        })
    }
}

impl ClosedLoop<Enclosure> {
    /// Rounds every constant of the loop once to numbers of `digits` digits; `None` where one is not known to that precision.
    #[must_use]
    pub fn rounded<R: Ring>(&self, digits: u32) -> Option<ClosedLoop<R>> {
        // The last constant contains the motion that a pose or input supplies: it counts by its own length.
        let length = longest(&self.constants[..5], &[&self.constants[5]]);
        Some(ClosedLoop { variables: self.variables, constants: all(&self.constants, length, digits)? })
    }
}

impl SsDyad<Enclosure> {
    /// Rounds every constant of the loop once to numbers of `digits` digits; `None` where one is not known to that precision.
    #[must_use]
    pub fn rounded<R: Ring>(&self, digits: u32) -> Option<SsDyad<R>> {
        let motion = |motion| rounded(motion, i32::MIN, digits);
        let [link, before, behind] = [motion(&self.link)?, motion(&self.before)?, motion(&self.behind)?];
        Some(SsDyad { variable: self.variable, link, before, behind, indices: self.indices })
    }
}

impl OpenSsDyad<Enclosure> {
    /// Rounds every constant of the loop once to numbers of `digits` digits; `None` where one is not known to that precision.
    #[must_use]
    pub fn rounded<R: Ring>(&self, digits: u32) -> Option<OpenSsDyad<R>> {
        let stretch = |stretch: &Stretch<Enclosure>| {
            let after = match &stretch.after {
                None => None,
                Some(after) => Some(rounded(after, i32::MIN, digits)?),
            };
            Some(Stretch { before: rounded(&stretch.before, i32::MIN, digits)?, after })
        };
        let [one, two, three] = self.stretches.each_ref().map(stretch);
        Some(OpenSsDyad { variable: self.variable, stretches: [one?, two?, three?], indices: self.indices })
    }
}
