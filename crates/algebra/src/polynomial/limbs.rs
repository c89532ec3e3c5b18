//! Sums of products of integers of a few words, in a fixed number of words: nothing is allocated before they are complete.

use super::blocks::Accumulator;
use crate::int::Int;
use crate::ring::Ring;
use rug::{Integer, integer::Order};

/// A factor of F words: the words, the lowest first, and all ones if it is negative, else 0.
#[derive(Clone, Copy)]
pub(super) struct Factor<const F: usize> {
    words: [u64; F],
    sign: u64,
}

impl<const F: usize> Factor<F> {
    /// Returns the integer; `None` if it is too long.
    pub(super) fn new(n: &Int) -> Option<Self> {
        let mut words = [0; F];
        if let Some(n) = n.to_i64() {
            words[0] = n.unsigned_abs();
            return Some(Self { words, sign: if n < 0 { u64::MAX } else { 0 } });
        }
        let n = n.to_large()?;
        let used = words.get_mut(..n.significant_digits::<u64>())?;
        n.write_digits(used, Order::Lsf);
        Some(Self { words, sign: if n.is_negative() { u64::MAX } else { 0 } })
    }
}

/// A sum of S words in two's complement, the lowest word first: at least twice those of a factor.
#[derive(Clone)]
pub(super) struct Sum<const S: usize>([u64; S]);

impl<const S: usize> Sum<S> {
    /// Returns the empty sum.
    pub(super) const fn zero() -> Self {
        Self([0; S])
    }

    /// Returns whether the sum is zero.
    #[inline(always)]
    pub(super) fn is_zero(&self) -> bool {
        self.0.iter().all(|&word| word == 0)
    }

    /// Returns the sum.
    pub(super) fn to_int(&self) -> Int {
        let mut words = self.0;
        let negative = words[S - 1] >> 63 == 1;
        let mut carry = negative;
        for word in words.iter_mut().filter(|_| negative) {
            (*word, carry) = (!*word).overflowing_add(u64::from(carry));
        }
        let n = Integer::from_digits(&words, Order::Lsf);
        Int::from(if negative { -n } else { n })
    }
}

/// Returns the lower word and the upper one.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "both words are returned")]
fn split(sum: u128) -> (u64, u64) {
    (sum as u64, (sum >> 64) as u64)
}

impl<const F: usize, const S: usize> Accumulator<Factor<F>> for Sum<S> {
    fn empty() -> Self {
        Self::zero()
    }
    #[inline(always)]
    fn add(&mut self, a: &Factor<F>, b: &Factor<F>) {
        let mut product = [0; S];
        for i in 0..F {
            let mut carry = 0;
            for j in 0..F {
                let term = u128::from(a.words[i]) * u128::from(b.words[j]);
                (product[i + j], carry) = split(term + u128::from(product[i + j]) + u128::from(carry));
            }
            product[i + F] = carry;
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
        self.is_zero()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sums_are_those_of_integers<const F: usize, const S: usize>() {
        let bits = 64 * u32::try_from(F).unwrap();
        let top = (Integer::from(1) << bits) - 1_u32;
        let long = (Integer::from(0x9e37_79b9_7f4a_7c15_u64) << (bits / 3)) + 12_345_u32;
        let numbers: Vec<Integer> =
            [top.clone(), -top.clone(), long.clone(), -long, Integer::from(1), Integer::from(-7)].into();
        let factor = |n: &Integer| Factor::<F>::new(&Int::from(n.clone()));
        assert!(factor(&(top + 1_u32)).is_none());
        let (mut sum, mut expected) = (Sum::<S>::zero(), Integer::new());
        let most = Integer::from(1) << (64 * u32::try_from(S).unwrap() - 1);
        for repeat in 0..40_usize {
            for (i, a) in numbers.iter().enumerate() {
                // Signs prevail in turn.
                let b = &numbers[(i * repeat + repeat / 7) % numbers.len()];
                if Integer::from(&expected + a * b).abs() >= most {
                    continue;
                }
                sum.add(&factor(a).unwrap(), &factor(b).unwrap());
                expected += a * b;
                assert_eq!(sum.to_int(), Int::from(expected.clone()));
                assert_eq!(sum.is_zero(), expected == 0);
            }
        }
        let factors = [1, -1].map(|n| factor(&Integer::from(n)).unwrap());
        let mut sum = Sum::<S>::zero();
        sum.add(&factors[0], &factors[1]);
        assert!(!sum.is_zero() && sum.to_int() == Int::from(-1));
        sum.add(&factors[1], &factors[1]);
        assert!(sum.is_zero());
    }

    #[test]
    fn sums_of_all_lengths_are_those_of_integers() {
        sums_are_those_of_integers::<2, 4>();
        sums_are_those_of_integers::<3, 6>();
        sums_are_those_of_integers::<3, 7>();
        sums_are_those_of_integers::<4, 8>();
        sums_are_those_of_integers::<6, 12>();
    }
}
