//! Arithmetic of a border basis: f64, numbers of 384 bits, or residues modulo a prime that is known only at run time.

use super::echelon;
use super::orthogonal;
use super::pivoted;
use crate::algebra::long_float::LongNumber;
use crate::algebra::modp::{Modulus, product};
use crate::algebra::ring::Ring;

/// Largest number of candidates for the basis of a level: 27 products and 6 of two `tau`.
pub const MOST_CANDIDATES: usize = 33;
/// Column at which the second part of a relation begins.
pub const LOW: usize = 36;
/// Room for one relation.
pub const STRIDE: usize = LOW + 40;
/// Room for the normal form of one candidate.
pub const WIDTH: usize = 40;
/// Largest number of relations of one degree.
pub const MOST_RELATIONS: usize = 48;

/// Relations of one degree: rows of coefficients of the candidates (from 0) and of the basis of lower levels (from
/// `LOW`), which sum to zero.
#[derive(Clone, Debug)]
pub struct Relations<E> {
    /// The rows, `STRIDE` apart.
    pub rows: Vec<E>,
    /// The number of rows in use.
    pub count: usize,
    /// The number of candidates.
    pub candidates: usize,
    /// The number of basis elements of the lower levels.
    pub low: usize,
}

/// The candidates of a level, reduced by its relations.
#[derive(Clone, Debug)]
pub struct Split<E> {
    /// The normal forms of the candidates, `WIDTH` apart: coefficients of the lower levels, then of the new one.
    pub normal: Vec<E>,
    /// The new basis elements as combinations of the candidates: row c, `LEVEL` apart, holds the coefficients of
    /// candidate c.
    pub lift: Vec<E>,
}

/// The most elements of one level.
pub const LEVEL: usize = 9;

/// The sum of this many products of residues modulo a prime below 2^62 is less than `p 2^64`.
const PRODUCTS: usize = 4;

/// A field whose numbers can solve relations between candidates.
pub trait Arithmetic {
    /// The numbers.
    type Element: Copy + PartialEq + std::fmt::Debug;
    /// 0
    fn zero(&self) -> Self::Element;
    /// 1
    fn one(&self) -> Self::Element;
    /// `a + b`
    fn add(&self, a: Self::Element, b: Self::Element) -> Self::Element;
    /// `a - b`
    fn sub(&self, a: Self::Element, b: Self::Element) -> Self::Element;
    /// `a b`
    fn mul(&self, a: Self::Element, b: Self::Element) -> Self::Element;
    /// `target += factor source`
    fn add_multiple(&self, target: &mut [Self::Element], factor: Self::Element, source: &[Self::Element]);
    /// `target += sum of factor source`, sources as long as the target or shorter.
    fn add_combination<'a>(
        &self,
        target: &mut [Self::Element],
        terms: impl Iterator<Item = (Self::Element, &'a [Self::Element])>,
    ) where
        Self::Element: 'a,
    {
        for (factor, source) in terms {
            self.add_multiple(target, factor, source);
        }
    }
    /// Solves relations of the given rank for as many candidates; the others, or combinations of them, are the new basis
    /// elements. Returns the smallest pivot over the largest.
    ///
    /// # Errors
    /// The rank found, where it differs from `rank`.
    fn solve(
        &self,
        relations: &mut Relations<Self::Element>,
        rank: usize,
        split: &mut Split<Self::Element>,
    ) -> Result<f64, usize>;

    /// `-a`
    fn neg(&self, a: Self::Element) -> Self::Element {
        self.sub(self.zero(), a)
    }
}

/// The field of the f64.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reals;

impl Arithmetic for Reals {
    type Element = f64;
    #[inline(always)]
    fn zero(&self) -> f64 {
        0.0
    }
    #[inline(always)]
    fn one(&self) -> f64 {
        1.0
    }
    #[inline(always)]
    fn add(&self, a: f64, b: f64) -> f64 {
        a + b
    }
    #[inline(always)]
    fn sub(&self, a: f64, b: f64) -> f64 {
        a - b
    }
    #[inline(always)]
    fn mul(&self, a: f64, b: f64) -> f64 {
        a * b
    }
    #[inline(always)]
    fn add_multiple(&self, target: &mut [f64], factor: f64, source: &[f64]) {
        for (t, s) in target.iter_mut().zip(source) {
            *t += factor * s;
        }
    }
    fn solve(&self, relations: &mut Relations<f64>, rank: usize, split: &mut Split<f64>) -> Result<f64, usize> {
        orthogonal::solve(relations, rank, split)
    }
}

/// Numbers of `LIMBS` 64-bit words. A sum in which all but the last bits cancel counts as zero.
#[derive(Clone, Copy, Debug, Default)]
pub struct LongReals<const LIMBS: usize>;

impl<const LIMBS: usize> LongReals<LIMBS> {
    /// Number of leading bits whose cancellation makes a sum zero: a fifth of the bits are room for rounding.
    const CANCELLED: i32 = LongNumber::<LIMBS>::BITS.cast_signed() / 32 * 25;
}

impl<const LIMBS: usize> Arithmetic for LongReals<LIMBS> {
    type Element = LongNumber<LIMBS>;
    fn zero(&self) -> LongNumber<LIMBS> {
        LongNumber::zero()
    }
    fn one(&self) -> LongNumber<LIMBS> {
        LongNumber::one()
    }
    fn add(&self, a: LongNumber<LIMBS>, b: LongNumber<LIMBS>) -> LongNumber<LIMBS> {
        let sum = a.add(&b);
        let largest = a.exponent().max(b.exponent());
        if sum.exponent() < largest.saturating_sub(Self::CANCELLED) { LongNumber::zero() } else { sum }
    }
    fn sub(&self, a: LongNumber<LIMBS>, b: LongNumber<LIMBS>) -> LongNumber<LIMBS> {
        self.add(a, b.neg())
    }
    fn mul(&self, a: LongNumber<LIMBS>, b: LongNumber<LIMBS>) -> LongNumber<LIMBS> {
        Ring::mul(&a, &b)
    }
    fn add_multiple(&self, target: &mut [LongNumber<LIMBS>], factor: LongNumber<LIMBS>, source: &[LongNumber<LIMBS>]) {
        if factor.is_zero() {
            return;
        }
        for (t, s) in target.iter_mut().zip(source) {
            if !s.is_zero() {
                *t = self.add(*t, Ring::mul(&factor, s));
            }
        }
    }
    fn solve(
        &self,
        relations: &mut Relations<LongNumber<LIMBS>>,
        rank: usize,
        split: &mut Split<LongNumber<LIMBS>>,
    ) -> Result<f64, usize> {
        pivoted::solve(relations, rank, split)
    }
}

impl Arithmetic for Modulus {
    type Element = u64;
    #[inline(always)]
    fn zero(&self) -> u64 {
        0
    }
    #[inline(always)]
    fn one(&self) -> u64 {
        self.enter(1)
    }
    #[inline(always)]
    fn add(&self, a: u64, b: u64) -> u64 {
        Modulus::add(self, a, b)
    }
    #[inline(always)]
    fn sub(&self, a: u64, b: u64) -> u64 {
        Modulus::sub(self, a, b)
    }
    #[inline(always)]
    fn mul(&self, a: u64, b: u64) -> u64 {
        Modulus::mul(self, a, b)
    }
    #[inline(always)]
    fn add_multiple(&self, target: &mut [u64], factor: u64, source: &[u64]) {
        if factor == 0 {
            return;
        }
        for (t, s) in target.iter_mut().zip(source) {
            *t = Modulus::add(self, *t, Modulus::mul(self, factor, *s));
        }
    }
    fn add_combination<'a>(&self, target: &mut [u64], terms: impl Iterator<Item = (u64, &'a [u64])>) {
        // Sums of products are folded once: four products of residues below 2^62 add less than p 2^64.
        let mut buffer = [0_u128; STRIDE];
        let sums = &mut buffer[..target.len()];
        for (sum, &t) in sums.iter_mut().zip(target.iter()) {
            *sum = u128::from(t) << 64;
        }
        let limit = u128::from(self.prime()) << 64;
        let mut open = 0;
        for (factor, source) in terms {
            if factor == 0 {
                continue;
            }
            for (sum, &s) in sums.iter_mut().zip(source) {
                *sum += product(factor, s);
            }
            open += 1;
            if open == PRODUCTS {
                open = 0;
                for sum in sums.iter_mut() {
                    *sum -= if *sum >= limit { limit } else { 0 };
                }
            }
        }
        for (t, sum) in target.iter_mut().zip(sums) {
            *t = self.fold(if *sum >= limit { *sum - limit } else { *sum });
        }
    }
    fn solve(&self, relations: &mut Relations<u64>, rank: usize, split: &mut Split<u64>) -> Result<f64, usize> {
        let inverse = |x: u64| (x != 0).then(|| self.inverse(x));
        echelon::solve(self, inverse, relations, rank, split)
    }
}
