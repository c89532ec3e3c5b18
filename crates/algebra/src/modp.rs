//! Prime fields: the prime is in the type for generic code, or a value for proofs with several primes.

use super::ring::{Domain, Field, Ring};
use num_complex::Complex;
use rug::{Integer, Rational};
use std::fmt;

/// The Mersenne prime `2^61 - 1`.
pub const PRIME_61: u64 = (1 << 61) - 1;
/// The largest prime below `2^62`.
pub const PRIME_62: u64 = (1 << 62) - 57;

/// Arithmetic modulo an odd prime below `2^63`, on residues in Montgomery form (`x 2^64 mod p`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Modulus {
    p: u64,
    /// `-1/p mod 2^64`
    negative_inverse: u64,
    /// `2^128 mod p`, which carries residues into Montgomery form
    square: u64,
}

impl Modulus {
    /// Creates the arithmetic modulo `p`. Primality is the caller's promise; only `inverse` relies on it.
    ///
    /// # Panics
    /// When `p` is even, 1, or not below `2^63`.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "residues modulo a u64 fit a u64")]
    pub const fn new(p: u64) -> Self {
        assert!(p % 2 == 1 && p > 1 && p < 1 << 63, "the modulus is odd, above 1 and below 2^63");
        // Newton's iteration; the start is right to 3 bits, and each step doubles them.
        let mut inverse = p;
        let mut step = 0;
        while step < 5 {
            inverse = inverse.wrapping_mul(2_u64.wrapping_sub(p.wrapping_mul(inverse)));
            step += 1;
        }
        let r = (1_u128 << 64) % p as u128;
        Self { p, negative_inverse: inverse.wrapping_neg(), square: (r * r % p as u128) as u64 }
    }

    /// Returns the prime.
    #[must_use]
    pub const fn prime(&self) -> u64 {
        self.p
    }

    /// Returns `a + b`.
    #[must_use]
    #[inline(always)]
    pub const fn add(&self, a: u64, b: u64) -> u64 {
        let sum = a + b;
        if sum >= self.p { sum - self.p } else { sum }
    }

    /// Returns `a - b`.
    #[must_use]
    #[inline(always)]
    pub const fn sub(&self, a: u64, b: u64) -> u64 {
        if a >= b { a - b } else { a + self.p - b }
    }

    /// Returns `a b`.
    #[must_use]
    #[inline(always)]
    pub const fn mul(&self, a: u64, b: u64) -> u64 {
        self.fold(product(a, b))
    }

    /// Returns the residue `sum / 2^64` of a number below `p 2^64`: of a sum of products of residues, the residue of the sum.
    #[must_use]
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "the low word, and a quotient below 2p")]
    pub const fn fold(&self, sum: u128) -> u64 {
        let quotient = (sum as u64).wrapping_mul(self.negative_inverse);
        // Below 2^127 + 2^127, so no overflow; the low word of the sum is 0.
        let reduced = ((sum + product(quotient, self.p)) >> 64) as u64;
        if reduced >= self.p { reduced - self.p } else { reduced }
    }

    /// Returns the Montgomery form of an integer.
    #[must_use]
    pub const fn enter(&self, a: u64) -> u64 {
        self.mul(a % self.p, self.square)
    }

    /// Returns the least nonnegative integer of a residue.
    #[must_use]
    pub const fn leave(&self, a: u64) -> u64 {
        self.mul(a, 1)
    }

    /// Returns the residue of a big integer.
    #[must_use]
    pub fn reduce(&self, n: &Integer) -> u64 {
        self.enter(remainder(n, self.p))
    }

    /// Returns `a^exponent`.
    #[must_use]
    pub const fn pow(&self, a: u64, exponent: u64) -> u64 {
        let (mut power, mut result, mut rest) = (a, self.enter(1), exponent);
        while rest > 0 {
            if rest & 1 == 1 {
                result = self.mul(result, power);
            }
            power = self.mul(power, power);
            rest >>= 1;
        }
        result
    }

    /// Returns `1/a` by Euclid's algorithm; 0 for 0.
    #[must_use]
    pub const fn inverse(&self, a: u64) -> u64 {
        // Each remainder is `a` times its factor modulo p, where the factors have alternating signs and grow to p at most.
        let (mut last, mut rest) = (self.p, a);
        let (mut last_factor, mut factor, mut is_negative) = (0_u64, 1_u64, false);
        while rest > 1 {
            let quotient = last / rest;
            (last, rest) = (rest, last - quotient * rest);
            (last_factor, factor) = (factor, last_factor + quotient * factor);
            is_negative = !is_negative;
        }
        if rest == 0 {
            return 0;
        }
        // The inverse of `x 2^64` is `2^-64 / x`: `2^128` is missing.
        let inverse = if is_negative { self.p - factor } else { factor };
        self.mul(self.mul(inverse, self.square), self.square)
    }
}

/// Returns the product of two words.
#[must_use]
#[inline(always)]
#[cfg(not(target_family = "wasm"))]
pub const fn product(a: u64, b: u64) -> u128 {
    a as u128 * b as u128
}

/// WebAssembly has no product of 64 bits by 64: the compiler calls a function that multiplies 128 bits by 128, which took two fifths of
/// the time of a platform.
#[cfg(target_family = "wasm")]
pub use product_of_halves as product;

/// The product of two words from those of their halves.
#[must_use]
#[inline(always)]
#[cfg(any(test, target_family = "wasm"))]
pub const fn product_of_halves(a: u64, b: u64) -> u128 {
    const LOW: u64 = u32::MAX as u64;
    let (a, upper_a) = (a & LOW, a >> 32);
    let (b, upper_b) = (b & LOW, b >> 32);
    let low = a * b;
    // Each sum of a product below (2^32 - 1)^2 and two halves is below 2^64.
    let first = upper_a * b + (low >> 32);
    let second = a * upper_b + (first & LOW);
    let high = upper_a * upper_b + (first >> 32) + (second >> 32);
    ((high as u128) << 64) | ((second << 32) | (low & LOW)) as u128
}

/// Returns the remainder by a word other than 0, not negative; nothing is allocated.
#[cfg(all(target_pointer_width = "64", not(windows)))]
fn remainder(n: &Integer, word: u64) -> u64 {
    rug::integer::IntegerExt64::mod_u64(n, word)
}

/// The remainder if GMP divides by 32 bits, as in WebAssembly.
#[cfg(not(all(target_pointer_width = "64", not(windows))))]
use wide_remainder as remainder;

/// Returns the remainder with integers of any size.
#[cfg(any(test, not(all(target_pointer_width = "64", not(windows)))))]
fn wide_remainder(n: &Integer, word: u64) -> u64 {
    use rug::ops::RemRounding;
    Integer::from(n.rem_euc(word)).to_u64_wrapping()
}

/// Returns whether an integer below `2^63` is prime: Miller-Rabin to the first twelve prime bases, a proof below `3.3e24`.
#[must_use]
pub const fn is_prime(n: u64) -> bool {
    const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    if n < 2 {
        return false;
    }
    let mut i = 0;
    while i < BASES.len() {
        if n.is_multiple_of(BASES[i]) {
            return n == BASES[i];
        }
        i += 1;
    }
    let modulus = Modulus::new(n);
    let (one, minus_one) = (modulus.enter(1), modulus.enter(n - 1));
    let twos = (n - 1).trailing_zeros();
    i = 0;
    while i < BASES.len() {
        let mut x = modulus.pow(modulus.enter(BASES[i]), (n - 1) >> twos);
        let mut witness = x != one && x != minus_one;
        let mut squarings = 1;
        while witness && squarings < twos {
            x = modulus.mul(x, x);
            witness = x != minus_one;
            squarings += 1;
        }
        if witness {
            return false;
        }
        i += 1;
    }
    true
}

/// What the largest primes below `2^62` lack to it: finding the first ones anew would take longer than most of what is done with them.
const FIRST_PRIMES: [u64; 24] = [
    57, 87, 117, 143, 153, 167, 171, 195, 203, 273, 287, 317, 443, 483, 495, 575, 581, 603, 633, 663, 765, 773, 777,
    791,
];

/// Returns the primes below `2^62`, largest first: as many distinct moduli as a proof asks for.
pub fn primes() -> impl Iterator<Item = Modulus> {
    const LAST: u64 = (1 << 62) - FIRST_PRIMES[FIRST_PRIMES.len() - 1];
    let first = FIRST_PRIMES.iter().map(|lacking| (1 << 62) - lacking);
    first.chain((0..LAST - 1).rev().step_by(2).filter(|&p| is_prime(p))).map(Modulus::new)
}

/// The integers modulo a prime. A composite or even `P`, or one beyond `2^63`, does not compile:
///
/// ```compile_fail
/// use looproot_algebra::{modp::ModP, ring::Ring};
/// let x = ModP::<91>::one();
/// ```
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct ModP<const P: u64>(u64);

impl<const P: u64> ModP<P> {
    const MODULUS: Modulus = {
        assert!(is_prime(P), "the modulus is a prime");
        Modulus::new(P)
    };

    /// Returns the residue of an integer.
    #[must_use]
    pub fn new(n: u64) -> Self {
        Self(Self::MODULUS.enter(n))
    }

    /// Returns the least nonnegative integer of this residue.
    #[must_use]
    pub fn value(self) -> u64 {
        Self::MODULUS.leave(self.0)
    }

    /// Returns a square root. Every residue has one together with `i = sqrt(-1)`.
    ///
    /// # Panics
    /// Does not compile for a prime that is 1 modulo 4: `i` is a residue then.
    #[must_use]
    pub fn square_root(self) -> Complex<Self> {
        const { assert!(P % 4 == 3, "the prime is 3 modulo 4") };
        // The square of a^((p+1)/4) is a if a is a square, and -a if not.
        let root = Self(Self::MODULUS.pow(self.0, P.div_ceil(4)));
        let zero = Self::zero();
        if root.mul(&root) == self { Complex { re: root, im: zero } } else { Complex { re: zero, im: root } }
    }
}

impl<const P: u64> fmt::Debug for ModP<P> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} mod {P}", self.value())
    }
}

impl<const P: u64> Ring for ModP<P> {
    fn zero() -> Self {
        Self(0)
    }
    fn one() -> Self {
        const { Self(Self::MODULUS.enter(1)) }
    }
    #[inline(always)]
    fn add(&self, other: &Self) -> Self {
        Self(Self::MODULUS.add(self.0, other.0))
    }
    #[inline(always)]
    fn sub(&self, other: &Self) -> Self {
        Self(Self::MODULUS.sub(self.0, other.0))
    }
    #[inline(always)]
    fn mul(&self, other: &Self) -> Self {
        Self(Self::MODULUS.mul(self.0, other.0))
    }
    #[inline(always)]
    fn neg(&self) -> Self {
        Self(Self::MODULUS.sub(0, self.0))
    }
    fn is_zero(&self) -> bool {
        self.0 == 0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        // An inverse costs dozens of products, and most constants of mechanisms are 0 and 1.
        if *q.denom() == 1 {
            return Some(Self(Self::MODULUS.reduce(q.numer())));
        }
        let denominator = Self(Self::MODULUS.reduce(q.denom())).inverse()?;
        Some(Self(Self::MODULUS.reduce(q.numer())).mul(&denominator))
    }
}

impl<const P: u64> Domain for ModP<P> {
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        Some(self.mul(&other.inverse()?))
    }
}

impl<const P: u64> Field for ModP<P> {
    fn inverse(&self) -> Option<Self> {
        (self.0 != 0).then(|| Self(Self::MODULUS.inverse(self.0)))
    }
    fn pivot_size(&self) -> f64 {
        if self.0 == 0 { 0.0 } else { 1.0 }
    }
    const PIVOT_ZERO: f64 = 0.0;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn named_primes_are_prime_and_make_the_complex_numbers_a_field() {
        for p in [PRIME_61, PRIME_62] {
            assert!(is_prime(p));
            assert_ne!(Integer::from(p).is_probably_prime(40), rug::integer::IsPrime::No);
            // -1 is no square, so x^2 + y^2 = 0 only at 0.
            assert_eq!(p % 4, 3);
        }
        assert_eq!(primes().next().map(|m| m.prime()), Some(PRIME_62));
        let found: Vec<u64> = (0..=PRIME_62).rev().step_by(2).filter(|&p| is_prime(p)).take(26).collect();
        assert_eq!(primes().take(26).map(|m| m.prime()).collect::<Vec<_>>(), found);
    }

    #[test]
    fn every_residue_has_a_square_root() {
        type Residue = ModP<PRIME_61>;
        for n in 0..50 {
            let root = Residue::new(n).square_root();
            assert_eq!(root.mul(&root), Complex { re: Residue::new(n), im: Residue::zero() });
        }
    }

    #[test]
    fn primality_agrees_with_trial_division() {
        for n in 0..2000_u64 {
            let by_trial = n > 1 && (2..n).take_while(|d| d * d <= n).all(|d| n % d != 0);
            assert_eq!(is_prime(n), by_trial, "{n}");
        }
        // Strong pseudoprimes to the bases 2 to 7 and 2 to 23.
        assert!(!is_prime(3_215_031_751) && !is_prime(3_825_123_056_546_413_051));
    }

    #[test]
    fn a_denominator_divisible_by_the_prime_has_no_image() {
        assert_eq!(ModP::<7>::from_rational(&Rational::from((1, 14))), None);
        assert_eq!(ModP::<7>::from_rational(&Rational::from((-1, 2))).map(ModP::value), Some(3));
    }

    #[test]
    fn a_number_times_its_inverse_is_one() {
        for p in [3, 7, 65_537, PRIME_61, PRIME_62, (1 << 63) - 25] {
            let modulus = Modulus::new(p);
            for a in [1, 2, 3, 5, 77, 123_456_789, 1 << 40, (1 << 61) - 3, p / 2, p / 3 + 1, p - 2, p - 1] {
                let own = modulus.enter(a % p);
                let expected = if own == 0 { 0 } else { modulus.enter(1) };
                assert_eq!(modulus.mul(own, modulus.inverse(own)), expected, "{a} modulo {p}");
                assert_eq!(modulus.inverse(own), modulus.pow(own, p - 2), "{a} modulo {p}");
            }
            assert_eq!(modulus.inverse(0), 0);
        }
    }

    #[test]
    fn both_products_agree() {
        let words =
            [0, 1, 77, (1 << 32) - 1, 1 << 32, (1 << 32) + 1, PRIME_61, PRIME_62, 0xdead_beef_0bad_cafe, u64::MAX];
        for a in words {
            for b in words {
                assert_eq!(product(a, b), product_of_halves(a, b), "{a} {b}");
            }
        }
    }

    #[test]
    fn both_remainders_agree() {
        let n: Integer = (Integer::from(3) << 200_u32) - 12_345;
        for word in [1, 77, (1 << 32) - 5, 1 << 32, PRIME_61, PRIME_62, u64::MAX] {
            for n in [n.clone(), -n.clone(), Integer::new(), Integer::from(-1)] {
                assert_eq!(remainder(&n, word), wide_remainder(&n, word));
            }
        }
    }
}
