//! Sums of products of integers of a few words, in a fixed number of words: nothing is allocated before they are complete.

use super::blocks::Accumulator;
use crate::ring::Ring;
use rug::{Integer, integer::Order};

/// Words of a factor, enough for 57 decimal digits.
const FACTOR: usize = 3;
/// Words of a sum: those of a product, and one for the sign and the sum of fewer than `2^63` products.
const SUM: usize = 2 * FACTOR + 1;

/// A factor: its words, the lowest first, and all ones if it is negative, else 0.
#[derive(Clone, Copy)]
pub(super) struct Factor {
    words: [u64; FACTOR],
    sign: u64,
}

impl Factor {
    /// Returns the integer; `None` if it is too long.
    pub(super) fn new(n: &Integer) -> Option<Self> {
        let mut words = [0; FACTOR];
        let used = words.get_mut(..n.significant_digits::<u64>())?;
        n.write_digits(used, Order::Lsf);
        Some(Self { words, sign: if n.is_negative() { u64::MAX } else { 0 } })
    }
}

/// A sum in two's complement, the lowest word first.
#[derive(Clone)]
pub(super) struct Sum([u64; SUM]);

impl Sum {
    /// Returns the sum as an element of a ring.
    pub(super) fn to_ring<R: Ring>(&self) -> R {
        let mut words = self.0;
        let negative = words[SUM - 1] >> 63 == 1;
        let mut carry = negative;
        for word in words.iter_mut().filter(|_| negative) {
            (*word, carry) = (!*word).overflowing_add(u64::from(carry));
        }
        let n = Integer::from_digits(&words, Order::Lsf);
        R::from_large(if negative { -n } else { n })
    }
}

/// Returns the lower word and the upper one.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "both words are returned")]
fn split(sum: u128) -> (u64, u64) {
    (sum as u64, (sum >> 64) as u64)
}

impl Accumulator<Factor> for Sum {
    fn empty() -> Self {
        Self([0; SUM])
    }
    #[inline(always)]
    fn add(&mut self, a: &Factor, b: &Factor) {
        let mut product = [0; SUM];
        for i in 0..FACTOR {
            let mut carry = 0;
            for j in 0..FACTOR {
                let term = u128::from(a.words[i]) * u128::from(b.words[j]);
                (product[i + j], carry) = split(term + u128::from(product[i + j]) + u128::from(carry));
            }
            product[i + FACTOR] = carry;
        }
        // The negative of a number is the complement of its words, and 1 more.
        let sign = a.sign ^ b.sign;
        let mut carry = sign & 1;
        for (sum, word) in self.0.iter_mut().zip(product) {
            (*sum, carry) = split(u128::from(*sum) + u128::from(word ^ sign) + u128::from(carry));
        }
    }
    #[inline(always)]
    fn vanishes(&self) -> bool {
        self.0.iter().all(|&word| word == 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::int::Int;

    #[test]
    fn sums_are_those_of_integers() {
        let top = (Integer::from(1) << 192_u32) - 1_u32;
        let long = (Integer::from(0x9e37_79b9_7f4a_7c15_u64) << 77_u32) + 12_345_u32;
        let numbers: Vec<Integer> =
            [top.clone(), -top.clone(), long.clone(), -long, Integer::from(1), Integer::from(-7)].into();
        assert!(Factor::new(&(top + 1_u32)).is_none());
        let (mut sum, mut expected) = (Sum::empty(), Integer::new());
        for repeat in 0..40_usize {
            for (i, a) in numbers.iter().enumerate() {
                // Signs prevail in turn.
                let b = &numbers[(i * repeat + repeat / 7) % numbers.len()];
                sum.add(&Factor::new(a).unwrap(), &Factor::new(b).unwrap());
                expected += a * b;
                assert_eq!(sum.to_ring::<Int>(), Int::from(expected.clone()));
                assert_eq!(sum.vanishes(), expected == 0);
            }
        }
        let factors = [1, -1].map(|n| Factor::new(&Integer::from(n)).unwrap());
        let mut sum = Sum::empty();
        sum.add(&factors[0], &factors[1]);
        assert!(!sum.vanishes() && sum.to_ring::<Int>() == Int::from(-1));
        sum.add(&factors[1], &factors[1]);
        assert!(sum.vanishes());
    }
}
