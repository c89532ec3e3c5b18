//! The integers modulo a prime chosen for a number field such that the polynomial of the field has a root. Then every element
//! whose denominator the prime does not divide has a residue. An element with nonzero residue is not 0 in the field.

use super::drawn;
use super::modp::{Modulus, is_prime};
use super::number_field::Algebraic;
use super::real_field::RealField;
use super::ring::{Domain, Field, Ring};
use super::univariate::Univariate;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::{Integer, Rational};
use std::cell::Cell;

/// Number of primes tried: half of those at hand have each of the square roots, of which there are at most five.
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

/// The image of the generating element of a field: its residue modulo the prime of this thread.
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

    /// Returns the residue of an element; `None` if the prime divides its denominator.
    #[must_use]
    pub fn residue(self, x: &Algebraic) -> Option<Residue> {
        Some(x.polynomial().map(Residue::from_rational)?.eval(&self.0))
    }
}

/// A prime over which a field splits into places of degree 1: the generating element has as many residues as conjugates.
/// An integer of the field that is 0 at all of them is the prime times an integer of the field.
#[derive(Clone, Debug)]
pub struct Places {
    modulus: Modulus,
    /// The residues of the element that generates the field, all different.
    generators: Vec<Residue>,
}

impl Places {
    /// Draws such a prime for a field, and chooses it for this thread.
    #[must_use]
    pub fn draw(field: &RealField, random: &mut ChaCha8Rng) -> Option<Self> {
        let step = 2 * u64::from(field.order());
        (0..TRIALS).find_map(|_| {
            let candidate = random.random_range((1 << 59) / step..(1 << 60) / step) * step + 1;
            is_prime(candidate).then(|| Self::over(field, candidate))?
        })
    }

    fn over(field: &RealField, prime: u64) -> Option<Self> {
        let modulus = Modulus::new(prime);
        MODULUS.set(modulus);
        let shift = |(multiplier, radicand): &(Integer, Integer)| {
            let radicand = Residue(modulus.reduce(radicand));
            let euler = modulus.pow(radicand.0, (prime - 1) / 2);
            let root = || root(&Univariate::new(vec![radicand.neg(), Residue::zero(), Residue::one()]));
            Some((euler == modulus.enter(1)).then(root)??.mul(&Residue(modulus.reduce(multiplier))))
        };
        let shifts: Vec<Residue> = field.summands().iter().map(shift).collect::<Option<_>>()?;
        let part = root_of_unity(&modulus, u64::from(field.order()));
        let cosine = |unit: u32| {
            let power = Residue(modulus.pow(part, u64::from(unit)));
            Some(power.add(&power.inverse()?))
        };
        let mut generators: Vec<Residue> = field.units().map(cosine).collect::<Option<_>>()?;
        for shift in shifts {
            generators = generators.iter().flat_map(|x| [x.add(&shift), x.sub(&shift)]).collect();
        }
        let is_root = |x: &Residue| field.polynomial().map(Residue::from_rational).is_some_and(|f| f.eval(x).is_zero());
        let distinct = |k: usize| generators[..k].iter().all(|x| *x != generators[k]);
        let are_all = generators.len() == field.degree() && generators.iter().all(is_root);
        (are_all && (0..generators.len()).all(distinct)).then_some(Self { modulus, generators })
    }

    /// Chooses the prime for this thread again.
    pub fn enter(&self) {
        MODULUS.set(self.modulus);
    }

    /// Returns the prime.
    #[must_use]
    pub fn prime(&self) -> u64 {
        self.modulus.prime()
    }

    /// Returns the residues of the element that generates the field.
    #[must_use]
    pub fn generators(&self) -> &[Residue] {
        &self.generators
    }
}

impl Residue {
    /// Returns an element modulo the prime of this thread, as a polynomial in the generating element of the field; `None` if the
    /// prime divides its denominator.
    #[must_use]
    pub fn reduced(x: &Algebraic) -> Option<Univariate<Self>> {
        let (numerator, denominator) = x.parts();
        let scale = Self(modulus().reduce(denominator)).inverse()?;
        Some(Univariate::new(numerator.iter().map(|c| Self(modulus().reduce(c)).mul(&scale)).collect()))
    }

    /// Returns the least nonnegative integer of the residue.
    #[must_use]
    pub fn value(self) -> u64 {
        modulus().leave(self.0)
    }
}

/// Returns a residue of this multiplicative order; the prime minus 1 must be a multiple of the order.
fn root_of_unity(modulus: &Modulus, order: u64) -> u64 {
    let one = modulus.enter(1);
    let factors = (2..=order).filter(|q| order.is_multiple_of(*q) && is_prime(*q));
    let factors: Vec<u64> = factors.collect();
    let candidates = (2..).map(|n| modulus.pow(modulus.enter(n), (modulus.prime() - 1) / order));
    let is_primitive = |x: &u64| factors.iter().all(|q| modulus.pow(*x, order / q) != one);
    candidates.take(TRIALS).find(is_primitive).unwrap_or(one)
}

/// Returns a root of a polynomial modulo the prime.
fn root(f: &Univariate<Residue>) -> Option<Residue> {
    let p = modulus().prime();
    let minus_x = Univariate::x().neg();
    let mut rest = f.gcd(&power(&Univariate::x(), p, f).add(&minus_x));
    let mut shift = Residue::zero();
    while rest.degree()? > 1 {
        // Of the roots x keep those for which x + shift is a square.
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

/// Returns a power modulo a polynomial.
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
