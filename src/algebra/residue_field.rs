//! The integers modulo a prime that is chosen for a number field: modulo it the polynomial of the field has a root, so that
//! every element whose denominator the prime does not divide has a residue. What is not 0 there is not 0 in the field.

use super::drawn;
use super::modp::{Modulus, is_prime};
use super::number_field::Algebraic;
use super::real_field::RealField;
use super::ring::{Domain, Field, Ring};
use super::univariate::Univariate;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;
use std::cell::Cell;

/// Primes tried: half of those at hand have each of the square roots, and there are five of them at most.
const TRIALS: usize = 4000;

thread_local! {
    static MODULUS: Cell<Modulus> = const { Cell::new(Modulus::new(3)) };
}

fn modulus() -> Modulus {
    MODULUS.get()
}

/// A residue modulo the prime that this thread has chosen last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Residue(u64);

impl Ring for Residue {
    fn zero() -> Self {
        Self(0)
    }
    fn one() -> Self {
        Self(modulus().enter(1))
    }
    fn add(&self, other: &Self) -> Self {
        Self(modulus().add(self.0, other.0))
    }
    fn sub(&self, other: &Self) -> Self {
        Self(modulus().sub(self.0, other.0))
    }
    fn mul(&self, other: &Self) -> Self {
        Self(modulus().mul(self.0, other.0))
    }
    fn neg(&self) -> Self {
        Self(modulus().sub(0, self.0))
    }
    fn is_zero(&self) -> bool {
        self.0 == 0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        let denominator = Self(modulus().reduce(q.denom())).inverse()?;
        Some(Self(modulus().reduce(q.numer())).mul(&denominator))
    }
}

impl Domain for Residue {
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        Some(self.mul(&other.inverse()?))
    }
}

impl Field for Residue {
    fn inverse(&self) -> Option<Self> {
        (self.0 != 0).then(|| Self(modulus().inverse(self.0)))
    }
    fn pivot_size(&self) -> f64 {
        if self.0 == 0 { 0.0 } else { 1.0 }
    }
    const PIVOT_ZERO: f64 = 0.0;
}

/// Where the element that generates a field goes: its residue modulo the prime of this thread.
#[derive(Clone, Copy, Debug)]
pub struct Reduction(Residue);

impl Reduction {
    /// Chooses a prime for a field, by the seed of the run.
    #[must_use]
    pub fn of(field: &RealField) -> Option<Self> {
        let mut random = ChaCha8Rng::seed_from_u64(drawn::seed());
        // Modulo a prime of this form the cosines have residues.
        let step = 2 * u64::from(field.order());
        for _ in 0..TRIALS {
            let candidate = random.random_range((1 << 59) / step..(1 << 60) / step) * step + 1;
            if !is_prime(candidate) {
                continue;
            }
            MODULUS.set(Modulus::new(candidate));
            let polynomial = field.polynomial().map(Residue::from_rational);
            if let Some(root) = polynomial.and_then(|polynomial| root(&polynomial)) {
                return Some(Self(root));
            }
        }
        None
    }

    /// The residue of an element; `None` where the prime divides its denominator.
    #[must_use]
    pub fn residue(self, x: &Algebraic) -> Option<Residue> {
        Some(x.polynomial().map(Residue::from_rational)?.eval(&self.0))
    }
}

/// A root of a polynomial modulo the prime.
fn root(f: &Univariate<Residue>) -> Option<Residue> {
    let p = modulus().prime();
    let minus_x = Univariate::x().neg();
    let mut rest = f.gcd(&power(&Univariate::x(), p, f).add(&minus_x));
    let mut shift = Residue::zero();
    while rest.degree()? > 1 {
        // Of the roots x those for which x + shift is a square.
        shift = shift.add(&Residue::one());
        let base = Univariate::new(vec![shift, Residue::one()]);
        let squares = rest.gcd(&power(&base, (p - 1) / 2, &rest).sub(&Univariate::one()));
        if squares.degree() > Some(0) && squares.degree() < rest.degree() {
            rest = squares;
        }
    }
    match rest.coefficients() {
        [constant, leading] => Some(constant.neg().mul(&leading.inverse()?)),
        _ => None,
    }
}

/// A power modulo a polynomial.
fn power(base: &Univariate<Residue>, exponent: u64, f: &Univariate<Residue>) -> Univariate<Residue> {
    let mut result = Univariate::one();
    for bit in (0..u64::BITS - exponent.leading_zeros()).rev() {
        result = result.mul(&result).div_rem(f).1;
        if exponent >> bit & 1 == 1 {
            result = result.mul(base).div_rem(f).1;
        }
    }
    result
}
