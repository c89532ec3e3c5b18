//! The trace test: whether a list of four-bars through nine points is complete.
//!
//! Coupler curves are forms of degree 3 in d and in e: those of four-bars make up a variety of dimension 9 in a projective space of
//! dimension 15. To run through a point is one linear condition on the form, so the curves through eight points are a curve X in that
//! variety, and the last point cuts it with a hyperplane F(9) = 0. Along the pencil F(9) + s F(10) = 0 of another place the quotient
//! F(11)/F(10) is an affine coordinate of the points of X, and those cut out are the points of parallel hyperplanes: the sum of the
//! coordinate over all of them is a polynomial of degree 1 in s. Over some of them only it is not, as X is irreducible and the
//! others are reached from them along loops of s. \[SommeseVerscheldeWampler2002\]

use super::curve::value;
use super::homotopy::{FourBar, Pencil, Place, Places};
use crate::solve::paths::Family;
use num_complex::Complex;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// How far the pencil is followed either way: far enough for differences well above rounding, near enough for a few steps.
const WAY: f64 = 0.1;
/// Maximum number of steps to either side.
const MOST_STEPS: usize = 2000;
/// The distance of the other places from the first point, that of general points in units of a problem.
const DISTANCE: f64 = 0.8;

/// The second difference of the coordinate.
#[derive(Clone, Copy, Debug)]
pub struct Trace {
    /// The absolute value of the sum: 0 but for rounding of a complete list.
    pub defect: f64,
    /// The median of the absolute values for one four-bar.
    pub median: f64,
}

/// Tests a list of four-bars with places drawn by this seed; `None` where some four-bar cannot be followed.
pub fn trace(places: &Places, four_bars: &[FourBar], seed: u64) -> Option<Trace> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut turn = || Complex::from_polar(DISTANCE, random.random_range(0.0..TAU));
    let [other, third]: [Place; 2] = [[turn(), turn()], [turn(), turn()]];
    let direction = turn() / DISTANCE;
    let pencil = Pencil { places, other };
    let line = |s: f64| [direction * (WAY * s), direction * WAY];
    let coordinate = |v: &FourBar| value(v, &third[0], &third[1]) / value(v, &other[0], &other[1]);
    let difference = |v: &FourBar| {
        let [before, after] = [-1.0, 1.0].map(|to| pencil.follow(line, v, 0.0, to, MOST_STEPS));
        Some(coordinate(&before?) + coordinate(&after?) - 2.0 * coordinate(v))
    };
    let differences: Vec<Complex<f64>> = four_bars.par_iter().map(difference).collect::<Option<_>>()?;
    let mut sizes: Vec<f64> = differences.iter().map(|z| z.norm()).collect();
    sizes.sort_by(f64::total_cmp);
    let defect = differences.iter().sum::<Complex<f64>>().norm();
    Some(Trace { defect, median: *sizes.get(sizes.len() / 2)? })
}
