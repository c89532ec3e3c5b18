//! Integers modulo a power of two, in which no sum overflows: where a bound says that a result is small enough, it is the one of least
//! absolute value.

use super::ring::Ring;
use rug::{Integer, integer::Order};

/// Integers modulo a power of two, of which those of least absolute value are the elements.
pub(crate) trait Wrapping: Copy {
    const ZERO: Self;
    fn from_wide(n: i128) -> Self;
    fn from_large(n: &Integer) -> Self;
    fn negative(self) -> Self;
    fn add_product(&mut self, a: Self, b: Self);
    fn is_zero(&self) -> bool;
    fn to_ring<R: Ring>(self) -> R;
}

/// Returns the residue of an integer of a ring of integers; `None` in all other rings.
#[inline(always)]
pub(crate) fn wrapped<C: Wrapping, R: Ring>(c: &R) -> Option<C> {
    c.to_wide().map(C::from_wide).or_else(|| c.to_large().map(|n| C::from_large(&n)))
}

macro_rules! word {
    ($($word:ty, $wrap:ident);*) => {$(
        impl Wrapping for $word {
            const ZERO: Self = 0;
            #[inline(always)]
            #[allow(clippy::cast_possible_truncation, clippy::unnecessary_cast, reason = "the residue is meant")]
            fn from_wide(n: i128) -> Self {
                n as $word
            }
            fn from_large(n: &Integer) -> Self {
                n.$wrap()
            }
            #[inline(always)]
            fn negative(self) -> Self {
                self.wrapping_neg()
            }
            #[inline(always)]
            fn add_product(&mut self, a: Self, b: Self) {
                *self = self.wrapping_add(a.wrapping_mul(b));
            }
            #[inline(always)]
            fn is_zero(&self) -> bool {
                *self == 0
            }
            #[inline(always)]
            fn to_ring<R: Ring>(self) -> R {
                R::from_wide(self.into())
            }
        }
    )*};
}
word!(i64, to_i64_wrapping; i128, to_i128_wrapping);

/// Integers of N limbs, lowest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Wide<const N: usize>([u64; N]);

impl<const N: usize> Wide<N> {
    const fn is_negative(&self) -> bool {
        self.0[N - 1] >> 63 == 1
    }
}

#[expect(clippy::cast_possible_truncation, reason = "limbs are the halves of two words")]
impl<const N: usize> Wrapping for Wide<N> {
    const ZERO: Self = Self([0; N]);

    #[inline(always)]
    fn from_wide(n: i128) -> Self {
        let mut limbs = [if n < 0 { u64::MAX } else { 0 }; N];
        limbs[0] = n.cast_unsigned() as u64;
        limbs[1] = (n.cast_unsigned() >> 64) as u64;
        Self(limbs)
    }

    fn from_large(n: &Integer) -> Self {
        let mut limbs = [0; N];
        if n.significant_digits::<u64>() <= N {
            n.write_digits(&mut limbs, Order::Lsf);
        } else {
            limbs.copy_from_slice(&n.to_digits::<u64>(Order::Lsf)[..N]);
        }
        let size = Self(limbs);
        if n.is_negative() { size.negative() } else { size }
    }

    #[inline(always)]
    fn negative(self) -> Self {
        let mut carry = true;
        Self(self.0.map(|limb| {
            let (sum, over) = (!limb).overflowing_add(u64::from(carry));
            carry = over;
            sum
        }))
    }

    #[inline(always)]
    fn add_product(&mut self, a: Self, b: Self) {
        for i in 0..N {
            let mut carry = 0;
            for j in 0..N - i {
                let sum = u128::from(a.0[i]) * u128::from(b.0[j]) + u128::from(self.0[i + j]) + u128::from(carry);
                self.0[i + j] = sum as u64;
                carry = (sum >> 64) as u64;
            }
        }
    }

    #[inline(always)]
    fn is_zero(&self) -> bool {
        self.0.iter().all(|limb| *limb == 0)
    }

    fn to_ring<R: Ring>(self) -> R {
        let fill = if self.is_negative() { u64::MAX } else { 0 };
        let low = u128::from(self.0[0]) | u128::from(self.0[1]) << 64;
        let sign = low.cast_signed() >> 127;
        if self.0[2..].iter().all(|limb| *limb == fill) && sign == i128::from(fill.cast_signed()) {
            return R::from_wide(low.cast_signed());
        }
        let size = if self.is_negative() { self.negative() } else { self };
        let n = Integer::from_digits(&size.0, Order::Lsf);
        R::from_large(if self.is_negative() { -n } else { n })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::int::Int;
    use proptest::prelude::*;

    fn number() -> impl Strategy<Value = Integer> {
        let ends = [i64::MIN, i64::MAX, -1, 0, 1].map(Integer::from).to_vec();
        let long = (any::<i128>(), 0..120_u32).prop_map(|(n, bits)| (Integer::from(n) << bits) - 1);
        prop_oneof![any::<i128>().prop_map(Integer::from), prop::sample::select(ends), long]
    }

    fn agrees<C: Wrapping>(terms: &[(Integer, Integer)]) {
        let (mut sum, mut expected) = (C::ZERO, Integer::new());
        for (a, b) in terms {
            sum.add_product(C::from_large(a), C::from_large(b));
            expected += a * b;
        }
        let bits = 8 * u32::try_from(size_of::<C>()).unwrap();
        let modulus = Integer::from(1) << bits;
        let half = Integer::from(1) << (bits - 1);
        let mut residue: Integer = expected % &modulus;
        if residue >= half {
            residue -= &modulus;
        } else if residue < -half {
            residue += &modulus;
        }
        assert_eq!(sum.is_zero(), residue == 0);
        assert_eq!(sum.to_ring::<Int>(), Int::from(residue));
    }

    proptest! {
        #[test]
        fn sums_of_products_are_those_of_integers(terms in prop::collection::vec((number(), number()), 0..6)) {
            agrees::<i64>(&terms);
            agrees::<i128>(&terms);
            agrees::<Wide<3>>(&terms);
            agrees::<Wide<4>>(&terms);
            agrees::<Wide<8>>(&terms);
        }
    }

    #[test]
    fn words_are_those_of_integers() {
        for n in [0, 1, -1, i128::MAX, i128::MIN, 1 << 64, -(1 << 64)] {
            assert_eq!(wrapped::<Wide<4>, _>(&Int::from(n)), Some(Wide::from_large(&Integer::from(n))));
            assert_eq!(Wide::<4>::from_wide(n).to_ring::<Int>(), Int::from(n));
            assert_eq!(Wide::<4>::from_wide(n).negative().to_ring::<Int>(), Int::from(n).neg());
        }
    }
}
