//! What a determinant from its values is predicted to cost, so that it can be compared with other routes.

use super::lattice::count_points;
use super::primes::count_beyond;
use super::problem::most_points;

/// Nanoseconds of a step of elimination or evaluation, of a step of interpolation, of a point for each parameter, of a
/// coefficient modulo one prime, of a term before anything is evaluated, and of the rest: measured with four lanes on a
/// processor of 3 GHz.
const STEP: f64 = 1.1;
const INTERPOLATION: f64 = 1.5;
const POINT: f64 = 30.0;
const REMAINDER: f64 = 12.0;
const TERM: f64 = 60.0;
const REST: f64 = 10_000.0;
/// Primes side by side.
const LANES: usize = 4;

/// Returns the nanoseconds for a determinant of this size, whose matrix takes so many steps to be written down at a point
/// and has so many terms, and the number of its coefficients; `None` if there would be too many values.
///
/// The determinant has these degrees and this total one at most, and coefficients of so many bits.
pub(super) fn cost(
    size: usize,
    steps: f64,
    degrees: &[usize],
    total: usize,
    bits: f64,
    terms: usize,
) -> Option<(f64, f64)> {
    // The logarithm of sums that no float holds.
    let bits = if bits.is_finite() { bits.max(0.0) } else { return None };
    let points = count_points(degrees, total, most_points(bits, degrees.len()))? as f64;
    let primes = count_beyond(bits + 2.0);
    let rounds = primes.div_ceil(LANES) as f64;
    let [size, terms] = [size, terms].map(|count| count as f64);
    let lines: f64 = degrees.iter().map(|&degree| degree as f64 + 1.0).sum();
    let at_point = STEP * (size * size * size / 3.0 + size * size + steps) + INTERPOLATION * lines;
    let once = POINT * degrees.len() as f64 + REMAINDER * primes as f64;
    Some((points * (rounds * at_point + once) + TERM * terms + REST, points))
}
