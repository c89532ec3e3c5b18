//! The integers modulo a prime that is drawn when the program first needs one, so that no data can be made to vanish modulo it.

use super::modp::{Modulus, is_prime};
use super::ring::{Domain, Field, Ring};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;
use std::fmt;
use std::sync::OnceLock;

/// The prime of this run.
#[derive(Clone, Copy, Debug)]
struct Draw {
    modulus: Modulus,
    one: u64,
    seed: u64,
}

static DRAW: OnceLock<Draw> = OnceLock::new();

/// A number that vanishes modulo a prime of 62 bits without being zero does so with a chance below its length in bits
/// over 62 divided by the number of such primes congruent to 3 modulo 4, which exceeds `2^55`. Counts meet numbers of
/// fewer than `2^15` bits: their chance of error is below this.
pub const PROBABILITY_OF_ERROR: f64 = 1.0 / (1_u64 << 40) as f64;

impl Draw {
    fn with(seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        // -1 is no square modulo such a prime, so that x^2 + y^2 = 0 only at 0.
        let prime = loop {
            let candidate = random.random_range(1_u64 << 61..1 << 62) | 3;
            if is_prime(candidate) {
                break candidate;
            }
        };
        let modulus = Modulus::new(prime);
        Self { modulus, one: modulus.enter(1), seed }
    }
}

fn draw() -> &'static Draw {
    // A seed that fits a double prints and reads as the same number everywhere.
    DRAW.get_or_init(|| Draw::with(rand::rng().random_range(0..1 << 53)))
}

/// Draws the prime of this run by a seed: the same seed repeats it. Returns whether the prime was still to be drawn.
pub fn plant(seed: u64) -> bool {
    DRAW.set(Draw::with(seed)).is_ok()
}

/// Returns the seed of the prime of this run.
#[must_use]
pub fn seed() -> u64 {
    draw().seed
}

/// Returns the seed of the prime of this run, if it was drawn.
#[must_use]
pub fn seed_used() -> Option<u64> {
    DRAW.get().map(|draw| draw.seed)
}

/// Returns the prime of this run, between `2^61` and `2^62` and congruent to 3 modulo 4.
#[must_use]
pub fn prime() -> u64 {
    draw().modulus.prime()
}

/// A residue modulo the prime of this run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Drawn(u64);

impl Drawn {
    /// Returns the residue of an integer.
    #[must_use]
    pub fn new(n: u64) -> Self {
        Self(draw().modulus.enter(n))
    }

    /// Returns the least nonnegative integer of this residue.
    #[must_use]
    pub fn value(self) -> u64 {
        draw().modulus.leave(self.0)
    }
}

impl fmt::Debug for Drawn {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} mod {}", self.value(), prime())
    }
}

impl Ring for Drawn {
    fn zero() -> Self {
        Self(0)
    }
    fn one() -> Self {
        Self(draw().one)
    }
    #[inline]
    fn add(&self, other: &Self) -> Self {
        Self(draw().modulus.add(self.0, other.0))
    }
    #[inline]
    fn sub(&self, other: &Self) -> Self {
        Self(draw().modulus.sub(self.0, other.0))
    }
    #[inline]
    fn mul(&self, other: &Self) -> Self {
        Self(draw().modulus.mul(self.0, other.0))
    }
    #[inline]
    fn neg(&self) -> Self {
        Self(draw().modulus.sub(0, self.0))
    }
    fn is_zero(&self) -> bool {
        self.0 == 0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        let modulus = &draw().modulus;
        // An inverse costs dozens of products, and most constants of mechanisms are 0 and 1.
        if *q.denom() == 1 {
            return Some(Self(modulus.reduce(q.numer())));
        }
        let denominator = Self(modulus.reduce(q.denom())).inverse()?;
        Some(Self(modulus.reduce(q.numer())).mul(&denominator))
    }
}

impl Domain for Drawn {
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        Some(self.mul(&other.inverse()?))
    }
}

impl Field for Drawn {
    fn inverse(&self) -> Option<Self> {
        (self.0 != 0).then(|| Self(draw().modulus.inverse(self.0)))
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
    fn a_seed_repeats_its_prime_and_other_seeds_have_others() {
        let primes: Vec<u64> = (0..20).map(|seed| Draw::with(seed).modulus.prime()).collect();
        for (seed, &prime) in (0..).zip(&primes) {
            assert_eq!(Draw::with(seed).modulus.prime(), prime);
            assert!(is_prime(prime) && prime % 4 == 3 && prime >> 61 == 1, "{prime}");
        }
        let distinct: std::collections::BTreeSet<u64> = primes.iter().copied().collect();
        assert_eq!(distinct.len(), primes.len());
    }

    #[test]
    fn residues_form_a_field() {
        let third = Drawn::from_rational(&Rational::from((1, 3))).expect("3 is no multiple of the prime");
        assert_eq!(third.add(&third).add(&third), Drawn::one());
        assert_eq!(Drawn::new(prime()), Drawn::zero());
        assert_eq!(Drawn::from_rational(&Rational::from((1, prime()))), None);
        assert_eq!(third.inverse().map(Drawn::value), Some(3));
    }
}
