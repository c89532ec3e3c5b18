//! Floating-point numbers of 384 or 960 bits that are copied like machine numbers, for problems beyond 31 digits.
//!
//! Their operations are calls, which take a small part of an operation: in place they are a kilobyte of machine code each.

use super::ring::{Field, Ring};
use rug::{Float, Integer, Rational, integer::Order};
use std::cmp::Ordering;

/// Numbers of 384 bits.
pub type LongFloat = LongNumber<6>;
/// Numbers of 512 bits, as discs have them.
pub type DiscFloat = LongNumber<8>;
/// Numbers of 960 bits.
pub type LongerFloat = LongNumber<15>;

/// `+-0.m 2^e` with the highest bit of m set, or zero. Results are cut off, not rounded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LongNumber<const LIMBS: usize> {
    /// The words of m, the least significant one first.
    limbs: [u64; LIMBS],
    exponent: i32,
    negative: bool,
}

/// A mantissa with a word of guard bits below.
struct Guarded<const LIMBS: usize> {
    guard: u64,
    limbs: [u64; LIMBS],
}

impl<const LIMBS: usize> LongNumber<LIMBS> {
    /// Bits of a mantissa.
    #[expect(clippy::cast_possible_truncation, reason = "some words")]
    pub const BITS: u32 = 64 * LIMBS as u32;
    /// Bound on the relative error of one operation, with room for the last steps of an inverse.
    pub const UNIT_ROUNDOFF: f64 = power_of_half(Self::BITS - 4);
    /// Number of Newton steps, each of which doubles the digits of f64, until all are right.
    pub const DOUBLINGS: u32 = (Self::BITS / 53).ilog2() + 1;

    const ZERO: Self = Self { limbs: [0; LIMBS], exponent: 0, negative: false };

    /// Returns the nearest f64 or a neighbour of it; 0 and infinity for numbers too small or too large.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        let size = scaled(self.limbs[LIMBS - 1] as f64, self.exponent.saturating_sub(64));
        if self.negative { -size } else { size }
    }

    /// Returns the least k with `|self| < 2^k`; of zero the least there is.
    #[must_use]
    pub fn exponent(self) -> i32 {
        if self.is_zero() { i32::MIN } else { self.exponent }
    }

    /// Returns `self 2^k`, exactly.
    #[must_use]
    pub fn shifted(self, k: i32) -> Self {
        if self.is_zero() { self } else { Self { exponent: self.exponent + k, ..self } }
    }

    /// Returns `n 2^exponent`, cut off.
    fn of_integer(n: Integer, exponent: i32) -> Option<Self> {
        let negative = n.is_negative();
        let length = i32::try_from(n.significant_bits()).ok()?;
        if length == 0 {
            return Some(Self::ZERO);
        }
        let excess = length - i32::try_from(Self::BITS).ok()?;
        let mut limbs = [0; LIMBS];
        (n.abs() >> excess).write_digits(&mut limbs, Order::Lsf);
        Some(Self { limbs, exponent: exponent + length, negative })
    }

    /// Returns a number of MPFR, cut off; `None` for infinities and NaN.
    #[must_use]
    pub fn of_float(x: &Float) -> Option<Self> {
        let (n, exponent) = x.to_integer_exp()?;
        Self::of_integer(n, exponent)
    }

    /// Returns the number as one of MPFR with as many bits.
    #[must_use]
    pub fn to_float(self) -> Float {
        let places = self.exponent.saturating_sub_unsigned(Self::BITS);
        let size = Float::with_val(Self::BITS, Integer::from_digits(&self.limbs, Order::Lsf)) << places;
        if self.negative { -size } else { size }
    }

    /// Returns the sum of two numbers of one sign, the first one not the smaller in exponent.
    fn plus(&self, other: &Self) -> Self {
        let b = guarded(&other.limbs, self.exponent.abs_diff(other.exponent));
        let mut limbs = [0; LIMBS];
        let mut carry = false;
        for ((s, &x), y) in limbs.iter_mut().zip(&self.limbs).zip(b.limbs) {
            let (partial, first) = x.overflowing_add(y);
            let (total, second) = partial.overflowing_add(u64::from(carry));
            (*s, carry) = (total, first || second);
        }
        let mut exponent = self.exponent;
        if carry {
            for k in 0..LIMBS {
                let above = if k + 1 < LIMBS { limbs[k + 1] } else { 1 };
                limbs[k] = limbs[k] >> 1 | above << 63;
            }
            exponent += 1;
        }
        Self { limbs, exponent, negative: self.negative }
    }

    /// Returns the difference of the absolute values, with the sign of the first; that one is not the smaller in exponent.
    fn minus(&self, other: &Self) -> Self {
        let (mut a, mut b) = (guarded(&self.limbs, 0), guarded(&other.limbs, self.exponent.abs_diff(other.exponent)));
        let mut negative = self.negative;
        match a.limbs.iter().rev().cmp(b.limbs.iter().rev()).then(a.guard.cmp(&b.guard)) {
            Ordering::Equal => return Self::ZERO,
            Ordering::Less => {
                std::mem::swap(&mut a, &mut b);
                negative = !negative;
            }
            Ordering::Greater => {}
        }
        let (guard, mut borrow) = a.guard.overflowing_sub(b.guard);
        let mut rest = [0; LIMBS];
        for ((r, x), y) in rest.iter_mut().zip(a.limbs).zip(b.limbs) {
            let (partial, first) = x.overflowing_sub(y);
            let (total, second) = partial.overflowing_sub(u64::from(borrow));
            (*r, borrow) = (total, first || second);
        }
        // Word k from below, the guard bits being word 0.
        let word = |k: usize| if k == 0 { guard } else { rest[k - 1] };
        let words = (0..=LIMBS).rev().take_while(|&k| word(k) == 0).count();
        let bits = word(LIMBS - words).leading_zeros();
        let limb = |k: usize| if k >= words { word(k - words) } else { 0 };
        let limbs = std::array::from_fn(|k| match bits {
            0 => limb(k + 1),
            _ => limb(k + 1) << bits | limb(k) >> (64 - bits),
        });
        let places = 64 * i32::try_from(words).unwrap_or(0) + i32::try_from(bits).unwrap_or(0);
        Self { limbs, exponent: self.exponent - places, negative }
    }
}

/// Returns `2^-k`.
const fn power_of_half(k: u32) -> f64 {
    let (mut value, mut left) = (1.0, k);
    while left > 0 {
        value *= 0.5;
        left -= 1;
    }
    value
}

/// Returns `x 2^k`.
fn scaled(x: f64, k: i32) -> f64 {
    // Two steps are needed: the power alone may be out of range where the product is not.
    let half = (k / 2).clamp(-1100, 1100);
    let rest = (k - k / 2).clamp(-1100, 1100);
    x * f64::from(half).exp2() * f64::from(rest).exp2()
}

/// Returns a mantissa shifted down by this many places.
#[expect(clippy::cast_possible_truncation, reason = "some words")]
fn guarded<const LIMBS: usize>(limbs: &[u64; LIMBS], places: u32) -> Guarded<LIMBS> {
    if places > 64 * (LIMBS as u32 + 1) {
        return Guarded { guard: 0, limbs: [0; LIMBS] };
    }
    let (words, bits) = ((places / 64) as usize, places % 64);
    let limb = |k: usize| if (1..=LIMBS).contains(&k) { limbs[k - 1] } else { 0 };
    let moved = |k: usize| match bits {
        0 => limb(k + words),
        _ => limb(k + words) >> bits | limb(k + words + 1) << (64 - bits),
    };
    Guarded { guard: moved(0), limbs: std::array::from_fn(|k| moved(k + 1)) }
}

impl<const LIMBS: usize> From<f64> for LongNumber<LIMBS> {
    /// Returns the number itself.
    ///
    /// # Panics
    /// For NaN and infinities, which no number here is.
    fn from(x: f64) -> Self {
        assert!(x.is_finite(), "a finite number was promised");
        if x == 0.0 {
            return Self::ZERO;
        }
        // Subnormal numbers first become ordinary ones.
        let (x, down) = if x.abs() < f64::MIN_POSITIVE { (x * 2.0_f64.powi(64), 64) } else { (x, 0) };
        let bits = x.to_bits();
        let exponent = i32::try_from(bits >> 52 & 0x7ff).unwrap_or(0) - 1022 - down;
        let mut limbs = [0; LIMBS];
        limbs[LIMBS - 1] = 1 << 63 | bits << 11;
        Self { limbs, exponent, negative: x < 0.0 }
    }
}

impl<const LIMBS: usize> Ring for LongNumber<LIMBS> {
    const DIGITS: Option<u32> = Some(Self::BITS);

    fn zero() -> Self {
        Self::ZERO
    }
    fn one() -> Self {
        Self::from(1.0)
    }
    #[inline(never)]
    fn add(&self, other: &Self) -> Self {
        if self.is_zero() {
            return *other;
        }
        if other.is_zero() {
            return *self;
        }
        let (large, small) = if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        if large.negative == small.negative { large.plus(small) } else { large.minus(small) }
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    #[inline(never)]
    fn mul(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::ZERO;
        }
        // The upper half of the product so far, and the word below it.
        let (mut upper, mut below) = ([0_u64; LIMBS], 0);
        for &a in &self.limbs {
            let mut carry = 0_u128;
            let mut lowest = 0;
            for j in 0..LIMBS {
                let sum = u128::from(a) * u128::from(other.limbs[j]) + u128::from(upper[j]) + carry;
                carry = sum >> 64;
                if j == 0 {
                    lowest = low_word(sum);
                } else {
                    upper[j - 1] = low_word(sum);
                }
            }
            (upper[LIMBS - 1], below) = (low_word(carry), lowest);
        }
        let mut exponent = self.exponent + other.exponent;
        let full = upper[LIMBS - 1] >> 63 == 1;
        let limbs = std::array::from_fn(|k| {
            let under = if k == 0 { below } else { upper[k - 1] };
            if full { upper[k] } else { upper[k] << 1 | under >> 63 }
        });
        if !full {
            exponent -= 1;
        }
        Self { limbs, exponent, negative: self.negative != other.negative }
    }
    fn neg(&self) -> Self {
        if self.is_zero() { *self } else { Self { negative: !self.negative, ..*self } }
    }
    fn is_zero(&self) -> bool {
        self.limbs[LIMBS - 1] == 0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        if q.is_zero() {
            return Some(Self::ZERO);
        }
        let length = |n: &Integer| i32::try_from(n.significant_bits()).ok();
        let (top, bottom) = (length(q.numer())?, length(q.denom())?);
        let bits = i32::try_from(Self::BITS).ok()?;
        // The quotient gets the bits of a mantissa, or one more.
        let shift = bits + 1 + bottom - top;
        let size = Integer::from(q.numer().abs_ref()) << shift.max(0);
        let quotient = size / (q.denom().clone() << (-shift).max(0));
        Self::of_integer(if q.is_negative() { -quotient } else { quotient }, -shift)
    }
    fn from_integer(n: i32) -> Self {
        Self::from(f64::from(n))
    }
}

/// Returns the lower half.
fn low_word(x: u128) -> u64 {
    u64::try_from(x & u128::from(u64::MAX)).unwrap_or(0)
}

impl<const LIMBS: usize> Field for LongNumber<LIMBS> {
    #[inline(never)]
    fn inverse(&self) -> Option<Self> {
        if self.is_zero() {
            return None;
        }
        // Newton's method from the f64 inverse of the mantissa: 53 digits are doubled until there are enough.
        let mantissa = Self { exponent: 0, ..*self };
        let mut x = Self::from(1.0 / mantissa.to_f64());
        for _ in 0..Self::DOUBLINGS {
            let error = Self::one().sub(&mantissa.mul(&x));
            x = x.add(&x.mul(&error));
        }
        Some(x.shifted(-self.exponent))
    }
    fn pivot_size(&self) -> f64 {
        self.to_f64().abs()
    }
    // Ten digits are left for roundings.
    const PIVOT_ZERO: f64 = power_of_half(Self::BITS - 35);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn exact<const LIMBS: usize>(x: LongNumber<LIMBS>) -> Rational {
        let mantissa = Integer::from_digits(&x.limbs, Order::Lsf);
        let places = x.exponent - i32::try_from(LongNumber::<LIMBS>::BITS).unwrap();
        let value = if places < 0 {
            Rational::from((mantissa, Integer::from(1) << places.unsigned_abs()))
        } else {
            Rational::from(mantissa << places.unsigned_abs())
        };
        if x.negative { -value } else { value }
    }

    fn close<const LIMBS: usize>(x: LongNumber<LIMBS>, wanted: &Rational) -> bool {
        let limit = Rational::from_f64(LongNumber::<LIMBS>::UNIT_ROUNDOFF).unwrap() * Rational::from(wanted.abs_ref());
        (exact(x) - wanted).abs() <= limit
    }

    fn number() -> impl Strategy<Value = Rational> {
        (any::<i128>(), any::<i128>(), 1..=i64::MAX, -200..200_i32).prop_map(|(a, b, c, k)| {
            let numerator = Integer::from(a) * Integer::from(b | 1) * Integer::from(a ^ b);
            let value = Rational::from((numerator, Integer::from(c)));
            if k < 0 { value >> k.unsigned_abs() } else { value << k.unsigned_abs() }
        })
    }

    fn operations_are_right<const LIMBS: usize>(a: &Rational, b: &Rational) -> Result<(), TestCaseError> {
        let [x, y] = [a, b].map(|q| LongNumber::<LIMBS>::from_rational(q).unwrap());
        prop_assert!(close(x, a) && close(y, b));
        // Operands are exact from here on.
        let (a, b) = (exact(x), exact(y));
        prop_assert!(close(x.add(&y), &Rational::from(&a + &b)));
        prop_assert!(close(x.sub(&y), &Rational::from(&a - &b)));
        prop_assert!(close(x.mul(&y), &Rational::from(&a * &b)));
        // Nearly equal numbers, whose leading bits cancel.
        for places in [520_u32, 1090] {
            let near = LongNumber::<LIMBS>::from_rational(&(Rational::from(1) + (a.clone() >> places))).unwrap();
            prop_assert!(close(near.sub(&Ring::one()), &(exact(near) - Rational::from(1))));
        }
        if let Some(inverse) = x.inverse() {
            prop_assert!(close(inverse, &a.recip()));
        }
        Ok(())
    }

    proptest! {
        #[test]
        fn every_operation_is_right_to_the_bound(a in number(), b in number()) {
            operations_are_right::<6>(&a, &b)?;
            operations_are_right::<15>(&a, &b)?;
            let long = LongFloat::from_rational(&a).unwrap();
            prop_assert_eq!(LongFloat::of_float(&long.to_float()), Some(long));
            prop_assert_eq!(&long.to_float().to_rational().unwrap(), &exact(long));
        }

        #[test]
        fn machine_numbers_come_and_go_unchanged(x in any::<f64>().prop_filter("finite", |x| x.is_finite())) {
            let long = LongFloat::from(x);
            prop_assert_eq!(&exact(long), &Rational::from_f64(x).unwrap());
            // Subnormal numbers lose digits on the way back.
            prop_assert!(long.to_f64() == x || x.abs() < f64::MIN_POSITIVE);
            prop_assert!(long.to_float() == x);
            prop_assert_eq!(LongFloat::of_float(&Float::with_val(53, x)), Some(long));
        }
    }

    #[test]
    fn zero_is_zero() {
        let zero = LongFloat::zero();
        assert!(zero.is_zero() && zero.neg() == zero && zero.inverse().is_none() && zero.to_f64() == 0.0);
        assert_eq!(LongFloat::one().sub(&LongFloat::one()), zero);
        assert_eq!(LongFloat::from_rational(&Rational::new()), Some(zero));
    }
}
