//! Legs of which two alone show that no real pose exists.

use crate::kinematics::motion::Vector;
use crate::kinematics::platform::Platform;

/// Room for rounding, relative to the lengths compared.
const ROOM: f64 = 1e-12;

/// Why no real pose can have legs of these lengths, if two of them tell: their ends and they themselves are the sides of a
/// quadrangle, each at most as long as the others together.
#[must_use]
pub fn out_of_reach(platform: &Platform<f64>, lengths: &[f64; 6]) -> Option<String> {
    let distance = |p: &Vector<f64>, q: &Vector<f64>| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt();
    (1..6).flat_map(|j| (0..j).map(move |i| (i, j))).find_map(|(i, j)| {
        let base = distance(&platform.base[i], &platform.base[j]);
        let plate = distance(&platform.plate[i], &platform.plate[j]);
        let (one, two) = (lengths[i], lengths[j]);
        let whole = base + plate + one + two;
        let exceeds = |side: f64| side > (whole - side) + ROOM * whole;
        let legs = format!("legs {} and {}", i + 1, j + 1);
        let apart = |body: &str, side: f64| {
            format!(
                "{legs} are too short: their points of the {body} are {side:.6} apart, both legs and the distance of their \
                 other ends together only {:.6}",
                whole - side
            )
        };
        let long = |leg: usize, side: f64| {
            format!(
                "leg {} is too long beside leg {}: {side:.6}, with only {:.6} on the way round by the other leg",
                leg + 1,
                i + j - leg + 1,
                whole - side
            )
        };
        if exceeds(base) {
            Some(apart("base", base))
        } else if exceeds(plate) {
            Some(apart("plate", plate))
        } else if exceeds(one) {
            Some(long(i, one))
        } else if exceeds(two) {
            Some(long(j, two))
        } else {
            None
        }
    })
}
