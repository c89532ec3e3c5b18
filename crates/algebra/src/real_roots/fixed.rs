//! Fixed-point numbers of 256 bits for Bernstein coefficients.

use rug::{Integer, integer::Order};

/// A signed integer of 256 bits, `2^128 hi + lo`. Overflow is the caller's to exclude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Wide {
    hi: i128,
    lo: u128,
}

impl Wide {
    pub(super) const ZERO: Self = Self { hi: 0, lo: 0 };

    /// Returns the number, which must have at most 255 bits.
    pub(super) fn new(n: &Integer) -> Self {
        debug_assert!(n.significant_bits() < 256, "the number fits 256 bits with its sign");
        let mut digits = [0_u128; 2];
        n.write_digits(&mut digits, Order::Lsf);
        let size = Self { hi: digits[1].cast_signed(), lo: digits[0] };
        if n.is_negative() { size.negate() } else { size }
    }

    pub(super) fn negate(self) -> Self {
        let (lo, borrow) = 0_u128.overflowing_sub(self.lo);
        Self { hi: 0_i128.wrapping_sub(self.hi).wrapping_sub(i128::from(borrow)), lo }
    }

    #[inline(always)]
    pub(super) fn add(self, other: Self) -> Self {
        let (lo, carry) = self.lo.overflowing_add(other.lo);
        Self { hi: self.hi.wrapping_add(other.hi).wrapping_add(i128::from(carry)), lo }
    }

    /// Returns `floor(2^shift self)`.
    #[inline(always)]
    pub(super) fn shift(self, shift: i64) -> Self {
        let size = shift.unsigned_abs();
        #[expect(clippy::cast_possible_truncation, reason = "below 256 where it is used")]
        let (near, far) = (size as u32, size as u32 & 127);
        let Self { hi, lo } = self;
        match (shift, size) {
            (_, 0) => self,
            (..0, 256..) => Self { hi: hi >> 127, lo: (hi >> 127).cast_unsigned() },
            (..0, 128..) => Self { hi: hi >> 127, lo: (hi >> far).cast_unsigned() },
            (..0, _) => Self { hi: hi >> near, lo: lo >> near | hi.cast_unsigned() << (128 - near) },
            (_, 256..) => Self::ZERO,
            (_, 128..) => Self { hi: (lo << far).cast_signed(), lo: 0 },
            _ => Self { hi: hi << near | (lo >> (128 - near)).cast_signed(), lo: lo << near },
        }
    }

    /// Becomes `floor((self + other)/2)`.
    #[inline(always)]
    pub(super) fn average(&mut self, other: &Self) {
        let Self { hi, lo } = self.add(*other);
        *self = Self { hi: hi >> 1, lo: lo >> 1 | hi.cast_unsigned() << 127 };
    }

    /// Returns the sign of every number within `error` of this one; 0 when they differ.
    #[inline(always)]
    pub(super) fn sign_beyond(self, error: u64) -> i8 {
        let error = u128::from(error);
        let above = self.hi > 0 || self.hi == 0 && self.lo > error;
        // The number is lo - 2^128 when hi is -1.
        let below = self.hi < -1 || self.hi == -1 && self.lo.wrapping_neg().wrapping_sub(1) >= error;
        i8::from(above) - i8::from(below)
    }

    /// Returns a float near the number.
    fn to_f64(self) -> f64 {
        const HALF: f64 = 1_u128.rotate_right(1) as f64;
        self.hi as f64 * (2.0 * HALF) + self.lo as f64
    }

    /// Returns a float within three units of its last place of the number.
    pub(super) fn nearby(self) -> f64 {
        // A negative number is a difference of its halves, which could lose all digits.
        if self.hi < 0 { -self.negate().to_f64() } else { self.to_f64() }
    }

    /// Returns whether the absolute value exceeds `2^bits error`, `bits` at most 64.
    pub(super) fn exceeds(self, error: u64, bits: u32) -> bool {
        let size = if self.hi < 0 { self.negate() } else { self };
        size.hi > 0 || size.lo > u128::from(error) << bits
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn big(w: Wide) -> Integer {
        (Integer::from(w.hi) << 128_u32) + w.lo
    }

    #[test]
    fn wide_numbers_compute_like_big_integers() {
        let base = Integer::from(0x1234_5678_9abc_def1_u64);
        for power in [0_u32, 1, 2, 3] {
            for sign in [1, -1] {
                let n = (0..power).fold(Integer::from(sign), |n, _| n * &base + 7_u32);
                let w = Wide::new(&n);
                assert_eq!(big(w), n);
                assert_eq!(big(w.negate()), -n.clone());
                for shift in [0_i64, 1, 17, 40, 63] {
                    let left = Integer::from(&n << u32::try_from(shift).unwrap());
                    if power < 3 {
                        assert_eq!(big(w.shift(shift)), left);
                        assert_eq!(big(Wide::new(&left).shift(-shift)), n);
                    }
                }
                for shift in [1_u32, 5, 64, 127, 128, 129, 200, 255, 256, 300] {
                    assert_eq!(big(w.shift(-i64::from(shift))), Integer::from(&n >> shift));
                }
                if power < 2 {
                    assert_eq!(big(w.shift(150)), Integer::from(&n << 150_u32));
                    assert_eq!(big(w.shift(128)), Integer::from(&n << 128_u32));
                }
                let mut half = w;
                half.average(&Wide::new(&base));
                assert_eq!(big(half), (Integer::from(&n) + &base) >> 1_u32);
                let sign = i8::try_from(sign).unwrap();
                for error in [0, 1, 7, u64::MAX] {
                    let beyond = |limit: Integer| n.cmp_abs(&limit).is_gt();
                    assert_eq!(w.sign_beyond(error), if beyond(error.into()) { sign } else { 0 }, "{n} {error}");
                    assert_eq!(w.exceeds(error, 12), beyond(Integer::from(error) << 12_u32));
                }
                for size in [4_i8, 5, 6] {
                    let n = Integer::from(size * sign);
                    assert_eq!(Wide::new(&n).sign_beyond(5), if size > 5 { sign } else { 0 }, "{n}");
                }
            }
        }
    }
}
