//! Tests whether one or two legs alone exclude every real pose.

use crate::algebra::number::nearest_f64;
use crate::kinematics::motion::Vector;
use crate::kinematics::platform::Platform;
use rug::Rational;

/// Allowance for rounding, relative to the lengths compared, each of which is a square root of an exact number.
const ROOM: f64 = 1e-12;

/// The pairwise distances of the points of base and moving platform.
#[derive(Clone, Debug)]
pub struct Distances {
    base: [[f64; 6]; 6],
    plate: [[f64; 6]; 6],
}

/// Returns the square root of an exact number.
fn root(square: &Rational) -> f64 {
    nearest_f64(square).sqrt()
}

impl Distances {
    /// Returns the distances of a platform.
    #[must_use]
    pub fn new(platform: &Platform<Rational>) -> Self {
        let distance = |p: &Vector<Rational>, q: &Vector<Rational>| {
            root(&(0..3).map(|k| Rational::from(&p[k] - &q[k]).square()).sum())
        };
        let all = |points: &[Vector<Rational>; 6]| {
            std::array::from_fn(|i| std::array::from_fn(|j| distance(&points[i], &points[j])))
        };
        Self { base: all(&platform.base), plate: all(&platform.plate) }
    }

    /// Returns why no real pose can have legs of these squared lengths, if one or two of the legs show it: a square is
    /// negative, or two legs and their ends form a quadrangle with one side longer than the other three together.
    #[must_use]
    pub fn out_of_reach(&self, squares: &[Rational; 6]) -> Option<String> {
        if let Some(leg) = squares.iter().position(|square| *square < 0) {
            return Some(format!("the square of leg {} is negative", leg + 1));
        }
        let lengths = squares.each_ref().map(root);
        (1..6).flat_map(|j| (0..j).map(move |i| (i, j))).find_map(|(i, j)| self.pair_out_of_reach(&lengths, i, j))
    }

    fn pair_out_of_reach(&self, lengths: &[f64; 6], i: usize, j: usize) -> Option<String> {
        let (base, plate) = (self.base[i][j], self.plate[i][j]);
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
    }
}
