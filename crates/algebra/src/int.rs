//! Integers that stay in a machine word while they fit: the coefficients of symbolic work, which rarely leave 64 bits.

use super::modp::Modulus;
use super::ring::{Domain, Ring};
use rug::{Complete, Integer, Rational};
use std::{borrow::Cow, cmp::Ordering, fmt};

/// An integer of any size, without allocation while it fits an i64.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Int(Repr);

/// Large never holds a number that fits Small, so that equality is structural. The word of a small one lies where a large one
/// has its length, so that both take 16 bytes, and a large one is allocated once.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Repr {
    Small(i64),
    Large(Integer),
}

impl Int {
    /// Returns the number as an i64, if it fits.
    #[must_use]
    #[inline(always)]
    pub fn to_i64(&self) -> Option<i64> {
        match &self.0 {
            Repr::Small(n) => Some(*n),
            Repr::Large(_) => None,
        }
    }

    /// Returns the residue modulo a prime, in Montgomery form.
    #[must_use]
    #[inline]
    pub fn residue(&self, modulus: &Modulus) -> u64 {
        match &self.0 {
            Repr::Small(n) if *n < 0 => modulus.sub(0, modulus.enter(n.unsigned_abs())),
            Repr::Small(n) => modulus.enter(n.unsigned_abs()),
            Repr::Large(n) => modulus.reduce(n),
        }
    }

    /// Returns the number as a big integer.
    #[must_use]
    pub fn to_integer(&self) -> Integer {
        match &self.0 {
            Repr::Small(n) => Integer::from(*n),
            Repr::Large(n) => Integer::clone(n),
        }
    }

    /// Returns the number as an element of a ring.
    #[must_use]
    pub(super) fn into_ring<R: Ring>(self) -> R {
        match self.0 {
            Repr::Small(n) => R::from_word(n),
            Repr::Large(n) => R::from_large(n),
        }
    }

    /// Its sign: how it compares to 0.
    #[must_use]
    pub fn sign(&self) -> Ordering {
        match &self.0 {
            Repr::Small(n) => n.cmp(&0),
            Repr::Large(n) => n.cmp0(),
        }
    }

    /// Returns the greatest common divisor, never negative; zero only of two zeros.
    #[must_use]
    pub fn gcd(&self, other: &Self) -> Self {
        match (&self.0, &other.0) {
            (Repr::Small(a), Repr::Small(b)) => Self::from(gcd_of_words(a.unsigned_abs(), b.unsigned_abs())),
            (Repr::Small(0), Repr::Large(n)) | (Repr::Large(n), Repr::Small(0)) => Self::from(n.abs_ref().complete()),
            (Repr::Small(a), Repr::Large(n)) | (Repr::Large(n), Repr::Small(a)) => {
                Self::from(gcd_of_words(a.unsigned_abs(), rest(n, a.unsigned_abs())))
            }
            (Repr::Large(a), Repr::Large(b)) => Self::from(a.gcd_ref(b).complete()),
        }
    }

    /// Returns the nearest f64.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "the conversion rounds to nearest")]
    pub fn to_f64(&self) -> f64 {
        match &self.0 {
            Repr::Small(n) => *n as f64,
            Repr::Large(n) => super::number::nearest_f64(&Rational::from(n)),
        }
    }

    /// Returns the absolute value.
    #[must_use]
    pub fn abs(&self) -> Self {
        if self.sign() == Ordering::Less { self.neg() } else { self.clone() }
    }
}

/// Returns the remainder of a large number by a nonzero word, up to multiples of the word and the sign.
#[cfg(all(target_pointer_width = "64", not(windows)))]
fn rest(n: &Integer, word: u64) -> u64 {
    rug::integer::IntegerExt64::mod_u64(n, word)
}

/// The remainder if GMP divides by 32 bits, as in WebAssembly.
#[cfg(not(all(target_pointer_width = "64", not(windows))))]
use wide_rest as rest;

/// Returns the remainder with integers of any size.
#[cfg(any(test, not(all(target_pointer_width = "64", not(windows)))))]
fn wide_rest(n: &Integer, word: u64) -> u64 {
    Integer::from(n % word).abs().to_u64_wrapping()
}

/// Stein's binary algorithm.
pub(super) fn gcd_of_words(mut a: u64, mut b: u64) -> u64 {
    if a == 0 || b == 0 {
        return a | b;
    }
    let twos = (a | b).trailing_zeros();
    a >>= a.trailing_zeros();
    while b != 0 {
        b >>= b.trailing_zeros();
        (a, b) = (a.min(b), a.abs_diff(b));
    }
    a << twos
}

impl fmt::Display for Int {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match &self.0 {
            Repr::Small(n) => n.fmt(f),
            Repr::Large(n) => n.fmt(f),
        }
    }
}

impl PartialOrd for Int {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Int {
    fn cmp(&self, other: &Self) -> Ordering {
        match (&self.0, &other.0) {
            (Repr::Small(a), Repr::Small(b)) => a.cmp(b),
            (Repr::Large(a), Repr::Large(b)) => a.cmp(b),
            // A large one lies beyond all small ones, on the side of its sign.
            (Repr::Small(_), Repr::Large(b)) => b.cmp0().reverse(),
            (Repr::Large(a), Repr::Small(_)) => a.cmp0(),
        }
    }
}

impl From<i32> for Int {
    fn from(n: i32) -> Self {
        Self::from(i64::from(n))
    }
}

impl From<i64> for Int {
    #[inline(always)]
    fn from(n: i64) -> Self {
        Self(Repr::Small(n))
    }
}

impl From<u64> for Int {
    fn from(n: u64) -> Self {
        Self::from(i128::from(n))
    }
}

impl From<i128> for Int {
    #[inline]
    fn from(n: i128) -> Self {
        i64::try_from(n).map_or_else(|_| Self(Repr::Large(Integer::from(n))), Self::from)
    }
}

impl From<Integer> for Int {
    fn from(n: Integer) -> Self {
        match n.to_i64() {
            Some(n) => Self(Repr::Small(n)),
            None => Self(Repr::Large(n)),
        }
    }
}

impl Ring for Int {
    fn zero() -> Self {
        Self(Repr::Small(0))
    }
    fn one() -> Self {
        Self(Repr::Small(1))
    }
    #[inline]
    fn add(&self, other: &Self) -> Self {
        match (&self.0, &other.0) {
            (Repr::Small(a), Repr::Small(b)) => match a.checked_add(*b) {
                Some(sum) => Self(Repr::Small(sum)),
                None => Self::from(i128::from(*a) + i128::from(*b)),
            },
            (Repr::Small(a), Repr::Large(b)) | (Repr::Large(b), Repr::Small(a)) => Self::from((b + *a).complete()),
            (Repr::Large(a), Repr::Large(b)) => Self::from((a + b).complete()),
        }
    }
    #[inline]
    fn sub(&self, other: &Self) -> Self {
        match (&self.0, &other.0) {
            (Repr::Small(a), Repr::Small(b)) => match a.checked_sub(*b) {
                Some(difference) => Self(Repr::Small(difference)),
                None => Self::from(i128::from(*a) - i128::from(*b)),
            },
            (Repr::Small(a), Repr::Large(b)) => Self::from((*a - b).complete()),
            (Repr::Large(a), Repr::Small(b)) => Self::from((a - *b).complete()),
            (Repr::Large(a), Repr::Large(b)) => Self::from((a - b).complete()),
        }
    }
    #[inline]
    fn mul(&self, other: &Self) -> Self {
        match (&self.0, &other.0) {
            (Repr::Small(a), Repr::Small(b)) => match a.checked_mul(*b) {
                Some(product) => Self(Repr::Small(product)),
                None => Self::from(i128::from(*a) * i128::from(*b)),
            },
            (Repr::Small(a), Repr::Large(b)) | (Repr::Large(b), Repr::Small(a)) => Self::from((b * *a).complete()),
            (Repr::Large(a), Repr::Large(b)) => Self::from((a * b).complete()),
        }
    }
    #[inline]
    fn add_product(&mut self, a: &Self, b: &Self) {
        match (&mut self.0, &a.0, &b.0) {
            (Repr::Small(sum), Repr::Small(a), Repr::Small(b)) => {
                // Below 2^126 + 2^63, so no overflow.
                *self = Self::from(i128::from(*sum) + i128::from(*a) * i128::from(*b));
            }
            (Repr::Small(sum), _, _) => *self = Self::from(*sum).add(&a.mul(b)),
            (Repr::Large(sum), a, b) => {
                match (a, b) {
                    (Repr::Small(a), Repr::Small(b)) => *sum += i128::from(*a) * i128::from(*b),
                    (Repr::Small(a), Repr::Large(b)) | (Repr::Large(b), Repr::Small(a)) => *sum += b * *a,
                    (Repr::Large(a), Repr::Large(b)) => *sum += a * b,
                }
                if let Some(small) = sum.to_i64() {
                    *self = Self::from(small);
                }
            }
        }
    }
    #[inline(always)]
    fn to_wide(&self) -> Option<i128> {
        match &self.0 {
            Repr::Small(n) => Some(i128::from(*n)),
            Repr::Large(n) => n.to_i128(),
        }
    }
    #[inline]
    fn from_wide(n: i128) -> Self {
        Self::from(n)
    }
    #[inline(always)]
    fn to_word(&self) -> Option<i64> {
        self.to_i64()
    }
    #[inline(always)]
    fn from_word(n: i64) -> Self {
        Self::from(n)
    }
    fn to_large(&self) -> Option<Cow<'_, Integer>> {
        Some(match &self.0 {
            Repr::Small(n) => Cow::Owned(Integer::from(*n)),
            Repr::Large(n) => Cow::Borrowed(n),
        })
    }
    fn from_large(n: Integer) -> Self {
        Self::from(n)
    }
    #[inline(always)]
    fn as_int(&self) -> Option<&Int> {
        Some(self)
    }
    #[inline]
    fn neg(&self) -> Self {
        match &self.0 {
            Repr::Small(n) => n.checked_neg().map_or_else(|| Self::from(-i128::from(*n)), Self::from),
            Repr::Large(n) => Self::from((-n).complete()),
        }
    }
    #[inline(always)]
    fn is_zero(&self) -> bool {
        matches!(self.0, Repr::Small(0))
    }
    /// Only integers have an image.
    fn from_rational(q: &Rational) -> Option<Self> {
        q.is_integer().then(|| Self::from(q.numer().clone()))
    }
    fn from_integer(n: i32) -> Self {
        Self::from(i64::from(n))
    }
}

impl Domain for Int {
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        match (&self.0, &other.0) {
            (_, Repr::Small(0)) => None,
            // Only i64::MIN / -1 leaves the word.
            (Repr::Small(a), Repr::Small(-1)) => Some(Self::from(-i128::from(*a))),
            (Repr::Small(a), Repr::Small(b)) => (a % b == 0).then(|| Self::from(a / b)),
            (Repr::Small(0), Repr::Large(_)) => Some(Self::zero()),
            // i64::MIN by 2^63 is the one quotient of a small number by a large one.
            (Repr::Small(a), Repr::Large(b)) => (*b == -i128::from(*a)).then(|| Self::from(-1_i64)),
            (Repr::Large(a), Repr::Small(b)) => {
                // Short divisors need no long number.
                if let Ok(word) = u32::try_from(b.unsigned_abs()) {
                    let quotient = a.is_divisible_u(word).then(|| Integer::from(a.div_exact_u_ref(word)))?;
                    return Some(Self::from(if *b < 0 { -quotient } else { quotient }));
                }
                let (quotient, rest) = a.div_rem_ref(&Integer::from(*b)).complete();
                rest.is_zero().then(|| Self::from(quotient))
            }
            (Repr::Large(a), Repr::Large(b)) => {
                let (quotient, rest) = a.div_rem_ref(b).complete();
                rest.is_zero().then(|| Self::from(quotient))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_quotients_by_words_are_those_of_long_numbers() {
        let n: Integer = (Integer::from(3) << 200) * 105;
        for b in [1, -1, 2, -7, 11, 15, -105, i64::from(u32::MAX), 1 << 40, -(1 << 62), i64::MIN] {
            for n in [&n, &-n.clone()] {
                let (quotient, rest) = n.clone().div_rem(Integer::from(b));
                let expected = (rest == 0).then(|| Int::from(quotient));
                assert_eq!(Int::from(n.clone()).checked_div_exact(&Int::from(b)), expected);
            }
        }
        assert_eq!(Int::from(n).checked_div_exact(&Int::zero()), None);
    }

    #[test]
    fn both_ways_to_divide_by_a_word_agree() {
        let n: Integer = (Integer::from(3) << 200) - 12_345;
        for word in [1, 77, (1 << 32) - 5, 1 << 32, (1 << 61) - 1, u64::MAX] {
            assert_eq!(rest(&n, word), wide_rest(&n, word));
            assert_eq!(gcd_of_words(word, rest(&-n.clone(), word)), gcd_of_words(word, wide_rest(&n, word)));
        }
    }
}
