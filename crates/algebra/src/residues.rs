//! Rational numbers by their residues modulo many primes at once: one run of an algorithm, and the numbers of its result from
//! their residues, however long those between would be.

use super::lift::rational;
use super::modp::{Modulus, primes};
use super::ring::{Domain, Field, Ring};
use rug::Rational;
use std::sync::LazyLock;

/// The number of primes that most numbers need.
pub const MOST: usize = 64;

/// The number of primes at hand.
const AT_HAND: usize = 256;

static MODULI: LazyLock<[Modulus; AT_HAND]> = LazyLock::new(|| {
    let mut primes = primes();
    std::array::from_fn(|_| primes.next().expect("there are more primes below 2^62"))
});

/// Residues modulo the 64 largest primes below `2^62`.
pub type Residues = ManyResidues<MOST>;

/// Residues modulo the N largest primes below `2^62`, at most 256 of them. As a field it returns no inverse for a
/// number that is 0 modulo some of the primes only, which does not happen by chance.
///
/// # Example
/// ```
/// use looproot_algebra::{residues::Residues, ring::{Field, Ring}};
/// use rug::Rational;
///
/// let x = Residues::from_rational(&Rational::from((-22, 7))).unwrap();
/// assert_eq!(x.inverse().unwrap().rational(), Some(Rational::from((-7, 22))));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ManyResidues<const N: usize>([u64; N]);

impl<const N: usize> ManyResidues<N> {
    /// Returns the residues modulo the first `M` of the primes.
    ///
    /// # Panics
    /// When `M` exceeds N.
    #[must_use]
    pub fn first<const M: usize>(&self) -> ManyResidues<M> {
        ManyResidues(std::array::from_fn(|k| self.0[k]))
    }

    /// Returns the rational number of least height with these residues, if numerator and denominator are below the square root of
    /// half the product of the primes, `2^1983` for 64 of them.
    #[must_use]
    pub fn rational(&self) -> Option<Rational> {
        let pair = |(r, modulus): (&u64, &Modulus)| (modulus.leave(*r), modulus.prime());
        rational(&self.0.iter().zip(MODULI.iter()).map(pair).collect::<Vec<_>>())
    }

    fn combined(&self, other: &Self, operation: impl Fn(&Modulus, u64, u64) -> u64) -> Self {
        let mut residues = self.0;
        for ((r, other), modulus) in residues.iter_mut().zip(&other.0).zip(MODULI.iter()) {
            *r = operation(modulus, *r, *other);
        }
        Self(residues)
    }
}

impl<const N: usize> Ring for ManyResidues<N> {
    fn zero() -> Self {
        Self([0; N])
    }
    fn one() -> Self {
        Self(std::array::from_fn(|k| MODULI[k].enter(1)))
    }
    fn add(&self, other: &Self) -> Self {
        self.combined(other, Modulus::add)
    }
    fn sub(&self, other: &Self) -> Self {
        self.combined(other, Modulus::sub)
    }
    fn mul(&self, other: &Self) -> Self {
        self.combined(other, Modulus::mul)
    }
    fn neg(&self) -> Self {
        Self::zero().sub(self)
    }
    fn is_zero(&self) -> bool {
        self.0.iter().all(|r| *r == 0)
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        let image = |n| Self(std::array::from_fn(|k| MODULI[k].reduce(n)));
        if *q.denom() == 1 {
            return Some(image(q.numer()));
        }
        Some(image(q.numer()).mul(&image(q.denom()).inverse()?))
    }
}

impl<const N: usize> Domain for ManyResidues<N> {
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        Some(self.mul(&other.inverse()?))
    }
}

impl<const N: usize> Field for ManyResidues<N> {
    fn inverse(&self) -> Option<Self> {
        let inverse = |k: usize| MODULI[k].inverse(self.0[k]);
        self.0.iter().all(|r| *r != 0).then(|| Self(std::array::from_fn(inverse)))
    }
    fn pivot_size(&self) -> f64 {
        if self.is_zero() { 0.0 } else { 1.0 }
    }
    const PIVOT_ZERO: f64 = 0.0;
}
