//! Products of polynomials with long coefficients in one variable, by a discrete Fourier transform over the integers modulo `2^N + 1`.
//!
//! There `2^(2N/L)` is a root of unity of order L, by whose powers the transform multiplies: with numbers of D digits of 16 bits, `N = 16 D` and 2D
//! a multiple of L, that is a rotation of the digits, in which those that leave at the top come back at the bottom with the other sign.
//!
//! # Why the coefficients are right
//! The product has fewer slots than the transform has points, so that nothing wraps around. Its coefficients, times L, are below `2^(N-2)` in
//! absolute value, and their residues modulo `2^N + 1` determine them. Digits are not carried in between: they are at most `2^16` in absolute value
//! at the start, each of the `log2 L` levels at most doubles them, and `16 + log2 L` is at most 30.
//!
//! # Source
//! Schönhage, Strassen 1971, Schnelle Multiplikation großer Zahlen, Computing 7.

use super::kronecker::balanced;
use super::slots::LIMB;
use pulp::Arch;
use rug::{Integer, integer::Order};
use std::borrow::Cow;

/// The bits of a digit, and the digits of a limb.
const BITS: usize = 16;
const IN_LIMB: usize = LIMB / BITS;
/// The most levels: digits have 31 bits, and their sign.
const MOST_LEVELS: u32 = 14;
/// The nanoseconds for a digit in a step of the transform, and for one that is laid down or read: measured on a processor of 3 GHz.
const STEP: f64 = 0.15;
const CARRY: f64 = 0.6;

/// A number at a slot.
pub(super) type Placed<'a> = (usize, Cow<'a, Integer>);

/// The transform for two factors.
pub(super) struct Transform {
    /// The number of points, a power of two; and its logarithm.
    points: usize,
    levels: u32,
    /// The digits of a number.
    digits: usize,
}

impl Transform {
    /// Returns the transform for products with so many slots, whose numbers are below `2^(width-2)` in absolute value; `None` where the slots are too
    /// many.
    pub(super) fn new(width: usize, slots: usize) -> Option<Self> {
        let points = slots.checked_next_power_of_two().filter(|points| *points > 1)?;
        let levels = points.trailing_zeros();
        // Twice the digits are a multiple of the points, and they fill limbs.
        let step = (points / 2).max(IN_LIMB);
        let digits = (width + levels as usize).div_ceil(BITS).next_multiple_of(step);
        (levels <= MOST_LEVELS).then_some(Self { points, levels, digits })
    }

    /// Returns the nanoseconds that a product is expected to take.
    pub(super) fn cost(&self) -> f64 {
        let (points, digits) = (self.points as f64, self.digits as f64);
        let steps = 1.5 * points * f64::from(self.levels);
        let limbs = (self.digits / IN_LIMB) as f64;
        points * balanced(limbs) + digits * (STEP * steps + 4.0 * CARRY * points)
    }

    /// Returns the numbers in the slots of the product, the lowest first.
    pub(super) fn product(&self, left: &[Placed], right: &[Placed], slots: usize) -> Vec<Integer> {
        let (mut a, b) = (self.values(left), self.values(right));
        for (own, other) in a.chunks_exact_mut(self.digits).zip(b.chunks_exact(self.digits)) {
            let product = self.number(own) * self.number(other);
            self.lay(&product, own);
        }
        Arch::new().dispatch(
            #[inline(always)]
            || self.backward(&mut a),
        );
        // All values are times the number of points.
        a.chunks_exact(self.digits).take(slots).map(|value| self.least(value) >> self.levels).collect()
    }

    /// Returns the values of a factor, in the order in which the transform leaves them.
    fn values(&self, numbers: &[Placed]) -> Vec<i32> {
        let mut values = vec![0; self.points * self.digits];
        for (slot, n) in numbers {
            self.lay(n, &mut values[slot * self.digits..][..self.digits]);
        }
        Arch::new().dispatch(
            #[inline(always)]
            || self.forward(&mut values),
        );
        values
    }

    /// Applies the transform, by differences.
    #[inline(always)]
    fn forward(&self, values: &mut [i32]) {
        let digits = self.digits;
        let mut rest = vec![0; digits];
        let mut length = self.points;
        while length > 1 {
            for block in values.chunks_exact_mut(length * digits) {
                let (upper, lower) = block.split_at_mut(length / 2 * digits);
                for (j, (a, b)) in upper.chunks_exact_mut(digits).zip(lower.chunks_exact_mut(digits)).enumerate() {
                    for ((a, b), rest) in a.iter_mut().zip(b.iter()).zip(&mut rest) {
                        (*a, *rest) = (*a + b, *a - b);
                    }
                    let turn = j * (2 * digits / length);
                    let (low, high) = rest.split_at(digits - turn);
                    b[turn..].copy_from_slice(low);
                    for (b, high) in b.iter_mut().zip(high) {
                        *b = -high;
                    }
                }
            }
            length /= 2;
        }
    }

    /// Applies the inverse transform, but for a division by the number of points.
    #[inline(always)]
    fn backward(&self, values: &mut [i32]) {
        let digits = self.digits;
        let mut rest = vec![0; digits];
        let mut length = 2;
        while length <= self.points {
            for block in values.chunks_exact_mut(length * digits) {
                let (upper, lower) = block.split_at_mut(length / 2 * digits);
                for (j, (a, b)) in upper.chunks_exact_mut(digits).zip(lower.chunks_exact_mut(digits)).enumerate() {
                    let turn = j * (2 * digits / length);
                    rest[..digits - turn].copy_from_slice(&b[turn..]);
                    for (rest, b) in rest[digits - turn..].iter_mut().zip(b.iter()) {
                        *rest = -b;
                    }
                    for ((a, b), rest) in a.iter_mut().zip(b.iter_mut()).zip(&rest) {
                        (*a, *b) = (*a + rest, *a - rest);
                    }
                }
            }
            length *= 2;
        }
    }

    /// Lays a number modulo `2^N + 1` down in digits; it is below `2^(2N+1)` in absolute value.
    #[expect(clippy::cast_possible_truncation, reason = "digits have 16 bits")]
    fn lay(&self, n: &Integer, digits: &mut [i32]) {
        let length = self.digits / IN_LIMB;
        let mut limbs = vec![0_u64; 2 * length + 1];
        n.write_digits(&mut limbs, Order::Lsf);
        let sign = if n.is_negative() { -1 } else { 1 };
        // `2^N` is -1, and `2^(2N)` is 1.
        let (low, high) = limbs.split_at(length);
        for ((places, low), high) in digits.chunks_exact_mut(IN_LIMB).zip(low).zip(high) {
            for (k, place) in places.iter_mut().enumerate() {
                let digit = |limb: u64| i32::from((limb >> (k * BITS)) as u16);
                *place = sign * (digit(*low) - digit(*high));
            }
        }
        digits[0] += sign * i32::from(high[length] as u16);
    }

    /// Returns the number with these digits, modulo `2^N + 1`: less than `2^N + 2^31` in absolute value.
    #[expect(clippy::cast_possible_truncation, reason = "what does not fit half a limb is carried")]
    fn number(&self, digits: &[i32]) -> Integer {
        // Half of the digits of a limb.
        const HALF: usize = IN_LIMB / 2;
        let (mut carry, mut limbs) = (0, Vec::with_capacity(self.digits / IN_LIMB));
        let pair = |digits: &[i32]| i64::from(digits[0]) + (i64::from(digits[1]) << BITS);
        for digits in digits.chunks_exact(IN_LIMB) {
            let low = pair(&digits[..HALF]) + carry;
            let high = pair(&digits[HALF..]) + (low >> (LIMB / 2));
            carry = high >> (LIMB / 2);
            limbs.push(u64::from(low.cast_unsigned() as u32) | high.cast_unsigned() << (LIMB / 2));
        }
        // `2^N` is -1.
        Integer::from_digits(&limbs, Order::Lsf) - carry
    }

    /// Returns the number of least absolute value with these digits, modulo `2^N + 1`.
    fn least(&self, digits: &[i32]) -> Integer {
        let n = self.number(digits);
        let length = self.digits * BITS;
        if n.significant_bits() as usize >= length {
            let power = Integer::from(1) << u32::try_from(length).unwrap_or(u32::MAX);
            let below = Integer::from(&n - &power) - 1_u32;
            if Integer::from(below.abs_ref()) < Integer::from(n.abs_ref()) {
                return below;
            }
        }
        n
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn numbers(terms: usize, bits: u32) -> impl Strategy<Value = Vec<Integer>> {
        let number =
            (prop::collection::vec(any::<u64>(), 1..40), 0..bits, 0..6_u32).prop_map(move |(limbs, less, kind)| {
                let most = Integer::from(1) << bits;
                let n = match kind {
                    0 => Integer::new(),
                    1 => most - 1_u32,
                    _ => (Integer::from_digits(&limbs, Order::Lsf) % most) >> less,
                };
                if limbs[0] & 1 == 0 { -n } else { n }
            });
        prop::collection::vec(number, 1..=terms)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]
        #[test]
        fn products_are_those_of_the_terms(
            (a, b, bits) in (1..60_usize, 10..1500_u32).prop_flat_map(|(n, bits)| (numbers(n, bits), numbers(n, bits), Just(bits)))
        ) {
            let slots = a.len() + b.len() - 1;
            let mut expected = vec![Integer::new(); slots];
            for (i, c) in a.iter().enumerate() {
                for (j, d) in b.iter().enumerate() {
                    expected[i + j] += c * d;
                }
            }
            let placed = |n: Vec<Integer>| n.into_iter().map(Cow::Owned).enumerate().collect::<Vec<Placed>>();
            let (a, b) = (placed(a), placed(b));
            let terms = usize::BITS - a.len().min(b.len()).leading_zeros();
            if let Some(transform) = Transform::new((2 * bits + terms + 2) as usize, slots) {
                prop_assert_eq!(transform.product(&a, &b, slots), expected);
            }
        }
    }

    /// All digits are as large as they can be, with all signs.
    #[test]
    fn the_largest_numbers() {
        for (terms, bits) in [(2_usize, 200_u32), (16, 2000), (33, 700), (128, 3000)] {
            let n = (Integer::from(1) << bits) - 1_u32;
            for signs in [[1, 1], [1, -1], [-1, -1]] {
                let [a, b] = signs.map(|sign| Integer::from(&n * sign));
                let placed =
                    |n: &Integer| (0..terms).map(|slot| (slot, Cow::Owned(n.clone()))).collect::<Vec<Placed>>();
                let slots = 2 * terms - 1;
                let width = 2 * bits as usize + (usize::BITS - terms.leading_zeros()) as usize + 2;
                let transform = Transform::new(width, slots).unwrap();
                let found = transform.product(&placed(&a), &placed(&b), slots);
                let product = Integer::from(&a * &b);
                for (slot, c) in found.into_iter().enumerate() {
                    assert_eq!(c, Integer::from(&product * (slot + 1).min(slots - slot) as u64));
                }
            }
        }
    }
}
