//! Loops that cannot close, since one link is longer than all others together.

use super::motion::{Vector, dot};
use rug::{Float, Rational};

/// Irrational lengths are within this part of their rationals, by far.
const ROUNDED: f64 = 1e-12;
/// Bits in which lengths are compared.
const BITS: u32 = 256;

/// Returns the length of the longest link and that of all others together, if it is longer by more than rounding, in words. A link is given
/// by the step from joint to joint.
#[must_use]
pub fn too_long<'a>(links: impl Iterator<Item = &'a Vector<Rational>>) -> Option<String> {
    let lengths: Vec<Float> = links.map(|step| Float::with_val(BITS, dot(step, step)).sqrt()).collect();
    let sum = lengths.iter().fold(Float::new(BITS), |sum, length| sum + length);
    let longest = lengths.iter().max_by(|a, b| a.total_cmp(b))?;
    let rest = Float::with_val(BITS, &sum - longest);
    // Numbers of the file may be rounded, and roots and sums are in the last of many bits.
    let margin = Float::with_val(BITS, &sum * ROUNDED);
    (Float::with_val(BITS, longest - &rest) > margin).then(|| {
        let (longest, rest) = (longest.to_f64(), rest.to_f64());
        format!("no real configuration: one link spans {longest:.6}, all others together {rest:.6}")
    })
}
