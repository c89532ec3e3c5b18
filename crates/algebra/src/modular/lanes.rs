//! Arithmetic modulo several primes side by side: one algorithm, run in the lanes of a vector register or on one prime.

use super::primes::PRIME_BITS;
use crate::modp::Modulus;
use pulp::Simd;

/// No machine has registers of more f64.
pub(super) const MOST_LANES: usize = 32;

/// Residues modulo several primes, one prime per lane.
///
/// Elements are whatever the operations below return: reduced far enough that all of them are exact again.
pub trait Lanes: Copy {
    /// A residue in every lane.
    type Element: Copy;
    /// A sum of products, not reduced.
    type Sum: Copy;
    /// The number of products that may be subtracted before a sum must be reduced.
    const CHUNK: usize;

    /// Zero.
    fn zero(self) -> Self::Element;
    /// Returns 1 in every lane.
    fn one(self) -> Self::Element;
    /// Returns the same small number in every lane.
    fn digit(self, digit: u32) -> Self::Element;
    /// Loads one number per lane, of absolute value less than half the prime.
    fn load(self, residues: &[i64]) -> Self::Element;
    /// Returns the residues of least absolute value, or nearly so, one per lane.
    fn store(self, a: Self::Element, residues: &mut [i64]);
    /// Returns the sum modulo the primes.
    fn add(self, a: Self::Element, b: Self::Element) -> Self::Element;
    /// Returns the difference modulo the primes.
    fn sub(self, a: Self::Element, b: Self::Element) -> Self::Element;
    /// Returns the product modulo the primes.
    fn mul(self, a: Self::Element, b: Self::Element) -> Self::Element;
    /// Returns `a b + c`.
    fn mul_add(self, a: Self::Element, b: Self::Element, c: Self::Element) -> Self::Element;
    /// Returns `1/a`, or 0 if `a` is 0.
    fn inverse(self, a: Self::Element) -> Self::Element;
    /// Starts a sum that is reduced later, with its first term.
    fn sum(self, start: Self::Element) -> Self::Sum;
    /// Returns `sum - a b`.
    fn subtract_product(self, sum: Self::Sum, a: Self::Element, b: Self::Element) -> Self::Sum;
    /// Reduces a sum modulo the primes.
    fn reduce(self, sum: Self::Sum) -> Self::Element;
}

/// Lanes of f64 with a fused multiply-add, for primes p slightly below `2^49`.
///
/// Residues are integers of absolute value at most `0.56 p`. A product is `h + l`, h rounded and l its exact rounding
/// error by FMA. With q the rounded `h / p`, `h - q p` is an integer below p in absolute value, hence exact.
///
/// A sum of products is kept in two parts: the high one near the constant `1.5 * 2^101`, where numbers are multiples
/// of `2^49`, the low one taking up the rounding errors, each at most `2^48` and found exactly. With 12 products of at
/// most `0.314 p^2` the high part stays within `2^100` of the constant, the low one below `2^52`, and the quotient by p
/// below `2^51`, where adding and subtracting `1.5 * 2^52` rounds to integers.
#[derive(Clone, Copy)]
pub struct Floats<'a, S: Simd> {
    simd: S,
    prime: S::f64s,
    /// `1/p`, rounded
    reciprocal: S::f64s,
    /// `p - 2 = (2^ones - 1) 2^k +` the number whose k bits, highest first, are `bits` (0.0 or 1.0, by lanes)
    ones: u32,
    bits: &'a [S::f64s],
}

/// Returns the bits in which the numbers `p - 2` may differ: the rest above them are ones.
pub(super) fn low_bits(primes: &[u64]) -> u32 {
    let most = primes.iter().map(|&p| (1 << PRIME_BITS) - 1 - (p - 2)).max().unwrap_or(0);
    u64::BITS - most.leading_zeros()
}

/// The constant next to which f64 are integers.
const ROUND: f64 = 1.5 * (1_u64 << 52) as f64;
/// The constant next to which f64 are multiples of `2^PRIME_BITS`.
const COARSE: f64 = ROUND * (1_u64 << PRIME_BITS) as f64;

impl<'a, S: Simd> Floats<'a, S> {
    /// Creates one lane for each of these primes; `bits` is filled for the inversion.
    #[inline(always)]
    pub fn new(simd: S, primes: &[u64], bits: &'a mut Vec<S::f64s>) -> Self {
        let low = low_bits(primes);
        let mut buffer = [0.0; MOST_LANES];
        let buffer = &mut buffer[..primes.len()];
        bits.clear();
        for bit in (0..low).rev() {
            for (x, p) in buffer.iter_mut().zip(primes) {
                *x = ((p - 2) >> bit & 1) as f64;
            }
            bits.push(simd.partial_load_f64s(buffer));
        }
        for (x, &p) in buffer.iter_mut().zip(primes) {
            *x = p as f64;
        }
        let prime = simd.partial_load_f64s(buffer);
        Self { simd, prime, reciprocal: simd.div_f64s(simd.splat_f64s(1.0), prime), ones: PRIME_BITS - low, bits }
    }

    /// Returns the lanes of these primes and their rounded reciprocals, for everything but inversion.
    #[inline(always)]
    pub fn of(simd: S, primes: &[f64], reciprocals: &[f64]) -> Self {
        let (prime, reciprocal) = (simd.partial_load_f64s(primes), simd.partial_load_f64s(reciprocals));
        Self { simd, prime, reciprocal, ones: 0, bits: &[] }
    }

    /// Returns `round(a / p)`, for quotients below `2^51`.
    #[inline(always)]
    fn quotient(self, a: S::f64s) -> S::f64s {
        let simd = self.simd;
        let round = simd.splat_f64s(ROUND);
        simd.sub_f64s(simd.mul_add_f64s(a, self.reciprocal, round), round)
    }

    /// Returns the residue of an integer below `2^53`.
    #[inline(always)]
    fn remainder(self, a: S::f64s) -> S::f64s {
        self.simd.negate_mul_add_f64s(self.quotient(a), self.prime, a)
    }
}

impl<S: Simd> Lanes for Floats<'_, S> {
    type Element = S::f64s;
    type Sum = (S::f64s, S::f64s);
    const CHUNK: usize = 12;

    #[inline(always)]
    fn zero(self) -> S::f64s {
        self.simd.splat_f64s(0.0)
    }
    #[inline(always)]
    fn one(self) -> S::f64s {
        self.simd.splat_f64s(1.0)
    }
    #[inline(always)]
    fn digit(self, digit: u32) -> S::f64s {
        self.simd.splat_f64s(f64::from(digit))
    }
    #[inline(always)]
    fn load(self, residues: &[i64]) -> S::f64s {
        let mut buffer = [0.0; MOST_LANES];
        for (x, &r) in buffer.iter_mut().zip(residues) {
            *x = r as f64;
        }
        self.simd.partial_load_f64s(&buffer[..residues.len()])
    }
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "residues are integers")]
    fn store(self, a: S::f64s, residues: &mut [i64]) {
        let mut buffer = [0.0; MOST_LANES];
        self.simd.partial_store_f64s(&mut buffer[..residues.len()], a);
        for (r, &x) in residues.iter_mut().zip(&buffer) {
            *r = x as i64;
        }
    }
    #[inline(always)]
    fn add(self, a: S::f64s, b: S::f64s) -> S::f64s {
        self.remainder(self.simd.add_f64s(a, b))
    }
    #[inline(always)]
    fn sub(self, a: S::f64s, b: S::f64s) -> S::f64s {
        self.remainder(self.simd.sub_f64s(a, b))
    }
    #[inline(always)]
    fn mul(self, a: S::f64s, b: S::f64s) -> S::f64s {
        let simd = self.simd;
        let high = simd.mul_f64s(a, b);
        let error = simd.negate_mul_add_f64s(a, b, high);
        simd.sub_f64s(self.remainder(high), error)
    }
    #[inline(always)]
    fn mul_add(self, a: S::f64s, b: S::f64s, c: S::f64s) -> S::f64s {
        let simd = self.simd;
        let high = simd.mul_f64s(a, b);
        let error = simd.negate_mul_add_f64s(a, b, high);
        // Rounding in this sum only touches the quotient.
        let quotient = self.quotient(simd.add_f64s(high, c));
        simd.sub_f64s(simd.add_f64s(simd.negate_mul_add_f64s(quotient, self.prime, high), c), error)
    }
    #[inline(always)]
    fn inverse(self, a: S::f64s) -> S::f64s {
        let mut power = a;
        // Fermat's exponent p - 2: a run of ones, doubled in length by squaring it past itself, then the low bits.
        let mut length = 1;
        for bit in (0..self.ones.ilog2()).rev() {
            let mut shifted = power;
            for _ in 0..length {
                shifted = self.mul(shifted, shifted);
            }
            power = self.mul(shifted, power);
            length *= 2;
            if self.ones >> bit & 1 == 1 {
                power = self.mul(self.mul(power, power), a);
                length += 1;
            }
        }
        let difference = self.simd.sub_f64s(a, self.one());
        for &bit in self.bits {
            let factor = self.simd.mul_add_f64s(bit, difference, self.one());
            power = self.mul(self.mul(power, power), factor);
        }
        power
    }
    #[inline(always)]
    fn sum(self, start: S::f64s) -> Self::Sum {
        (self.simd.splat_f64s(COARSE), start)
    }
    #[inline(always)]
    fn subtract_product(self, (high, low): Self::Sum, a: S::f64s, b: S::f64s) -> Self::Sum {
        let simd = self.simd;
        let sum = simd.negate_mul_add_f64s(a, b, high);
        let change = simd.sub_f64s(sum, high);
        (sum, simd.sub_f64s(low, simd.mul_add_f64s(a, b, change)))
    }
    #[inline(always)]
    fn reduce(self, (high, low): Self::Sum) -> S::f64s {
        let high = self.simd.sub_f64s(high, self.simd.splat_f64s(COARSE));
        self.remainder(self.simd.add_f64s(self.remainder(high), low))
    }
}

/// One lane, in Montgomery form, for machines without fused multiply-add and to check the floats.
impl Lanes for Modulus {
    type Element = u64;
    type Sum = u64;
    const CHUNK: usize = usize::MAX;

    fn zero(self) -> u64 {
        0
    }
    fn one(self) -> u64 {
        self.enter(1)
    }
    fn digit(self, digit: u32) -> u64 {
        self.enter(u64::from(digit))
    }
    fn load(self, residues: &[i64]) -> u64 {
        let size = self.enter(residues[0].unsigned_abs());
        if residues[0] < 0 { Modulus::sub(&self, 0, size) } else { size }
    }
    fn store(self, a: u64, residues: &mut [i64]) {
        let (residue, prime) = (self.leave(a).cast_signed(), self.prime().cast_signed());
        residues[0] = if residue > prime / 2 { residue - prime } else { residue };
    }
    fn add(self, a: u64, b: u64) -> u64 {
        Modulus::add(&self, a, b)
    }
    fn sub(self, a: u64, b: u64) -> u64 {
        Modulus::sub(&self, a, b)
    }
    fn mul(self, a: u64, b: u64) -> u64 {
        Modulus::mul(&self, a, b)
    }
    fn mul_add(self, a: u64, b: u64, c: u64) -> u64 {
        Modulus::add(&self, Modulus::mul(&self, a, b), c)
    }
    fn inverse(self, a: u64) -> u64 {
        Modulus::inverse(&self, a)
    }
    fn sum(self, start: u64) -> u64 {
        start
    }
    fn subtract_product(self, sum: u64, a: u64, b: u64) -> u64 {
        Modulus::sub(&self, sum, Modulus::mul(&self, a, b))
    }
    fn reduce(self, sum: u64) -> u64 {
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modular::primes::primes_beyond;
    use pulp::{Arch, WithSimd};
    use rug::Integer;

    /// Residues as far from 0 as they may be, and others, by turns in the lanes.
    fn residues(p: i64, lane: usize) -> Vec<i64> {
        let most = p / 100 * 56;
        let sizes = [most, p / 2, p / 2 + 1, p / 3, most - 12_345, 1 << 48, 77, 1, 0];
        let all = sizes.into_iter().chain(sizes.map(|r| -r));
        let mut all: Vec<i64> = all.filter(|r| r.abs() <= most).collect();
        all.rotate_left(lane % 3);
        all
    }

    /// All operations on the lanes, compared with integers.
    struct Compare;

    impl WithSimd for Compare {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            // The distances of the later primes have more bits.
            for skip in [0, 60] {
                let primes: Vec<u64> = primes_beyond(49.0 * 100.0).into_iter().skip(skip).take(S::F64_LANES).collect();
                let mut bits = Vec::new();
                let lanes = Floats::new(simd, &primes, &mut bits);
                let columns: Vec<Vec<i64>> =
                    primes.iter().enumerate().map(|(lane, &p)| residues(p.cast_signed(), lane)).collect();
                let count = columns.iter().map(Vec::len).min().unwrap();
                let row = |k: usize| -> Vec<i64> { columns.iter().map(|column| column[k]).collect() };
                let check = |result: S::f64s, expected: &dyn Fn(usize) -> i128| {
                    let mut found = vec![0; primes.len()];
                    lanes.store(result, &mut found);
                    for (lane, &p) in primes.iter().enumerate() {
                        let p = i128::from(p);
                        assert_eq!((i128::from(found[lane]) - expected(lane)).rem_euclid(p), 0);
                        assert!(i128::from(found[lane].abs()) * 100 <= p * 56, "reduced");
                    }
                };
                for i in 0..count {
                    let (r, a) = (row(i), lanes.load(&row(i)));
                    let product = lanes.mul(a, lanes.inverse(a));
                    check(product, &|lane| i128::from(r[lane] != 0));
                    for j in 0..count {
                        let (s, b) = (row(j), lanes.load(&row(j)));
                        let wide = |lane: usize| (i128::from(r[lane]), i128::from(s[lane]));
                        check(lanes.add(a, b), &|lane| wide(lane).0 + wide(lane).1);
                        check(lanes.sub(a, b), &|lane| wide(lane).0 - wide(lane).1);
                        check(lanes.mul(a, b), &|lane| wide(lane).0 * wide(lane).1);
                        for k in 0..count {
                            let (t, c) = (row(k), lanes.load(&row(k)));
                            check(lanes.mul_add(a, b, c), &|lane| wide(lane).0 * wide(lane).1 + i128::from(t[lane]));
                            let mut sum = lanes.sum(c);
                            for _ in 0..Floats::<S>::CHUNK {
                                sum = lanes.subtract_product(sum, a, b);
                            }
                            check(lanes.reduce(sum), &|lane| i128::from(t[lane]) - 12 * wide(lane).0 * wide(lane).1);
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn lanes_compute_as_integers_do() {
        Arch::new().dispatch(Compare);
        Arch::Scalar.dispatch(Compare);
    }

    #[test]
    fn the_single_lane_computes_as_integers_do() {
        let p = primes_beyond(0.0)[0];
        let modulus = Modulus::new(p);
        for r in residues(p.cast_signed(), 0) {
            for s in residues(p.cast_signed(), 1) {
                let (a, b) = (modulus.load(&[r]), modulus.load(&[s]));
                let mut found = [0];
                Lanes::store(modulus, Lanes::mul_add(modulus, a, b, a), &mut found);
                let expected = Integer::from(r) * s + r - found[0];
                assert!(expected.is_divisible(&Integer::from(p)));
                Lanes::store(
                    modulus,
                    modulus.reduce(modulus.subtract_product(Lanes::sum(modulus, b), a, a)),
                    &mut found,
                );
                assert!((Integer::from(s) - Integer::from(r) * r - found[0]).is_divisible(&Integer::from(p)));
            }
        }
    }
}
