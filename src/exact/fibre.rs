//! The solutions of a loop modulo a prime, where they are finite in number.
//!
//! The closure equations of a loop form a complete intersection, which is flat there: every solution modulo the prime of
//! multiplicity m is the image of solutions over the rationals whose multiplicities add up to m.

use crate::algebra::determinant::by_interpolation;
use crate::algebra::ring::{Domain, Field};
use crate::algebra::univariate::Univariate;
use crate::elimination::coordinate_ring::{CoordinateRing, Plan};
use crate::kinematics::closed_loop::ClosedLoop;

/// The ring of the solutions modulo the prime.
pub struct Fibre<F> {
    ring: CoordinateRing<F>,
    count: usize,
}

/// Weights of a linear form in cosines and sines: any numbers will do modulo a prime that is drawn after them.
const WEIGHTS: [i32; 10] = [
    1_000_003,
    1_299_709,
    15_485_863,
    32_452_843,
    49_979_687,
    67_867_967,
    86_028_121,
    104_395_301,
    122_949_823,
    141_650_939,
];

impl<F: Field + Domain> Fibre<F> {
    /// The solutions modulo the prime; `None` where there may be infinitely many of them, or more than `most`.
    pub fn of(modular: &ClosedLoop<F>, most: usize) -> Option<Self> {
        let plan = Plan::of(modular).filter(|plan| plan.count() <= most)?;
        let ring = plan.ring(modular)?;
        ring.is_exact().then(|| Self { ring, count: plan.count() })
    }

    /// The number of solutions modulo the prime, with multiplicity: over the rationals there are at least as many.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The orders of the roots of the characteristic polynomial of a linear form on the solutions. Distinct roots belong to
    /// distinct solutions modulo the prime: where there are as many roots as solutions over the rationals, these
    /// orders are their multiplicities.
    pub fn exponents(&self) -> Vec<usize> {
        let product = self.ring.multiplication(&WEIGHTS.map(F::from_integer));
        let unit = |i: usize| (0..product.len()).map(|j| F::from_integer(-i32::from(i == j))).collect::<Vec<_>>();
        let unit: Vec<Vec<F>> = (0..product.len()).map(unit).collect();
        let characteristic: Univariate<F> = by_interpolation(&[product, unit]);
        let factors = characteristic.square_free_decomposition().into_iter();
        factors.flat_map(|(factor, order)| vec![order; factor.degree().unwrap_or(0)]).collect()
    }
}
