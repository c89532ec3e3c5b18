//! Polynomials with symbols in their coefficients, from the polynomials at many values of the symbols.
//!
//! The polynomial at values y of the symbols is primitive over Z, hence known up to a factor that depends on y. [`Shape`] finds
//! degree and factors. The arithmetic is modulo 256 primes at once; the rational numbers are found from their residues. The result
//! is compared with the polynomials at further values, which are drawn at run time.

use super::equation::primitive;
use crate::algebra::drawn;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::projective::{SPARE, Shape};
use crate::algebra::residues::ManyResidues;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::error::{Error, Result};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use rug::{Integer, Rational};
use std::collections::HashMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

/// Maximum number of terms: a program that reads larger polynomials is better served by the numbers.
const MOST_TERMS: usize = 100_000;
/// Maximum number of products of powers. Each has 256 residues of 8 bytes, so that all take a gigabyte.
const MOST_PRODUCTS: usize = 500_000;
/// Maximum degree in a symbol.
pub(super) const MOST_DEGREE: usize = 96;
/// Number of values at which the result is compared with a separate derivation.
pub(super) const COMPARED: usize = 20;
/// Number of values that may be skipped, because their derivation uses another unknown or fails.
pub(super) const PASSED_OVER: usize = 12;
/// The first of small values: at 0 and at 1 links have length 0, and angles are right.
const FIRST: usize = 2;
/// A primitive root modulo the prime 2^31 - 1: its powers are scattered values.
const ROOT: u64 = 48271;
const PRIME: u64 = (1 << 31) - 1;
/// Scattered values are below this: few of them are special for a polynomial of moderate degree.
const SCATTERED: u64 = 1 << 24;
/// Largest integer for comparisons: a wrong polynomial of degree d agrees by chance at all of them with a probability below
/// `(d / 2^20)^20`.
const LARGEST: u32 = 1 << 20;

/// Residues modulo all primes at hand: enough for numerators and denominators of 2389 digits.
type Wide = ManyResidues<256>;
/// Residues modulo the first of these primes.
type Narrow = ManyResidues<1>;

/// What sees how far a long derivation is, and may end it.
pub struct Watch<'w> {
    /// Set to true, it ends the derivation.
    pub stop: &'w AtomicBool,
    /// Is called once with the number of values that are needed, as far as it is known.
    pub begin: &'w (dyn Fn(usize) + Sync),
    /// Is called after every value.
    pub step: &'w (dyn Fn() + Sync),
}

impl Watch<'_> {
    /// Sees nothing, and lets the derivation run.
    #[must_use]
    pub fn none() -> Self {
        static STOP: AtomicBool = AtomicBool::new(false);
        Self { stop: &STOP, begin: &|_| (), step: &|| () }
    }

    pub(super) fn is_ended(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// Polynomials that depend on symbols.
pub(super) trait Source: Sync {
    /// Returns the coefficients at values of the symbols, in an order that depends on nothing; they are known up to a common factor.
    /// `None` where they are none of this family.
    fn coefficients(&self, values: &[Rational]) -> Option<Vec<Integer>>;
}

/// The values at which polynomials are derived.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Values {
    /// Small integers, for derivations that take longer with more digits; no two symbols ever have the same, so that no links are equal
    /// that are not always so.
    Small,
    /// Integers of up to eight digits, for mechanisms with many special ones: four-bars fold where sums of two lengths are equal.
    Scattered,
}

impl Values {
    /// Returns the value of a symbol with this number.
    fn at(self, symbol: usize, symbols: usize, number: usize) -> Rational {
        let place = symbol + symbols * number;
        match self {
            Self::Small => Rational::from(FIRST + place),
            Self::Scattered => {
                let power = (0..=place).fold(1, |power, _| power * ROOT % PRIME);
                Rational::from(FIRST as u64 + power % SCATTERED)
            }
        }
    }

    /// Returns a value of one symbol alone.
    pub fn first(self, number: usize) -> Rational {
        self.at(0, 1, number)
    }

    /// Returns values at which all derivations begin; they are among those used later, so that nothing is derived twice.
    pub fn start(self, symbols: usize) -> Vec<Rational> {
        (0..symbols).map(|symbol| self.at(symbol, symbols, 0)).collect()
    }
}

/// A family of polynomials, and what is known of it.
pub(super) struct Family<'s, S> {
    pub source: &'s S,
    pub watch: &'s Watch<'s>,
    pub values: Values,
    /// The names of the symbols.
    pub names: Vec<String>,
    /// Number of coefficients.
    pub length: usize,
    /// The values derived so far.
    known: Mutex<HashMap<Vec<Rational>, Option<Vec<Integer>>>>,
}

/// The coefficients as polynomials in the symbols.
pub(super) struct Interpolated {
    /// The degrees in the symbols.
    pub degrees: Vec<usize>,
    /// The coefficients of all products of powers of the symbols, that of the last symbol varies fastest, coefficient by coefficient.
    pub numbers: Vec<Rational>,
}

impl Interpolated {
    /// Returns the terms: the number of the coefficient, the exponents of the symbols, and the number.
    pub fn terms(&self) -> impl Iterator<Item = (usize, Vec<u32>, &Rational)> {
        self.numbers.iter().enumerate().filter(|(_, c)| !c.is_zero()).map(|(place, c)| {
            let mut exponents = vec![0; self.degrees.len()];
            let mut rest = place;
            for (exponent, degree) in exponents.iter_mut().zip(&self.degrees).rev() {
                *exponent = u32::try_from(rest % (degree + 1)).unwrap_or(u32::MAX);
                rest /= degree + 1;
            }
            (rest, exponents, c)
        })
    }
}

/// Returns the reason why there is no polynomial with these symbols.
fn open(what: &str) -> Error {
    Error::Unsupported(format!("{what}: the closure polynomial is derived with numbers only, or with other symbols"))
}

impl<'s, S: Source> Family<'s, S> {
    pub fn new(source: &'s S, watch: &'s Watch<'s>, values: Values, names: Vec<String>, length: usize) -> Self {
        Self { source, watch, values, names, length, known: Mutex::default() }
    }

    /// Returns the coefficients as polynomials in the symbols.
    ///
    /// # Errors
    /// [`Error::Unsupported`] where there are more than 100,000 terms, or the values do not determine them.
    pub fn interpolated(&self) -> Result<Interpolated> {
        let degree = |k: usize| {
            let message =
                format!("the degree in {} is above {MOST_DEGREE}, or the unknown changes with it", self.names[k]);
            self.degree(k).ok_or_else(|| self.stopped(&message))
        };
        let degrees: Vec<usize> = (0..self.names.len()).map(degree).collect::<Result<_>>()?;
        let products = degrees.iter().fold(self.length, |product, degree| product.saturating_mul(degree + 1));
        if products > MOST_TERMS {
            // A total degree too large to be found leaves room for all products.
            let total = self.total_degree().unwrap_or_else(|| degrees.iter().sum());
            let terms = self.length.saturating_mul(products_below(&degrees, total));
            if terms > MOST_TERMS || products > MOST_PRODUCTS {
                let message = format!("with these symbols it has some {terms} terms, expected at most {MOST_TERMS}");
                return Err(open(&message));
            }
        }
        (self.watch.begin)(self.samples(&degrees));
        let mut shapes = vec![None; degrees.len()];
        let residues = self.grid(degrees.len(), &degrees, &[], &mut shapes);
        let residues = residues.ok_or_else(|| self.stopped("the values of the symbols at hand do not determine it"))?;
        let numbers = numbers(&residues).ok_or_else(|| open("its coefficients are longer than 2389 digits"))?;
        Ok(Interpolated { degrees, numbers })
    }

    /// Returns the number of values at which polynomials are needed, as long as none of them is skipped.
    fn samples(&self, degrees: &[usize]) -> usize {
        let mut entries = self.length;
        let mut product = 1_usize;
        for degree in degrees {
            product = product.saturating_mul(Shape::points(*degree, entries));
            entries *= degree + 1;
        }
        product + COMPARED
    }

    fn stopped(&self, otherwise: &str) -> Error {
        if self.watch.is_ended() {
            return Error::Unsupported("the derivation was stopped before its end".to_owned());
        }
        open(otherwise)
    }

    /// Returns the coefficients at values of the symbols; `None` if they are none of this family.
    fn coefficients(&self, values: &[Rational]) -> Option<Vec<Integer>> {
        let known = self.known.lock().ok().and_then(|known| known.get(values).cloned());
        known.unwrap_or_else(|| {
            if self.watch.is_ended() {
                return None;
            }
            let found = self.source.coefficients(values).filter(|found| found.len() == self.length);
            (self.watch.step)();
            if let Ok(mut known) = self.known.lock() {
                known.insert(values.to_vec(), found.clone());
            }
            found
        })
    }

    fn residues<const N: usize>(&self, values: &[Rational]) -> Option<Vec<ManyResidues<N>>> {
        let coefficients = self.coefficients(values)?;
        coefficients.into_iter().map(|c| ManyResidues::from_rational(&Rational::from(c))).collect()
    }

    /// Returns the first `count` values of a symbol at which there is a vector, with these.
    fn sampled<F: Field + Send>(
        &self,
        symbol: usize,
        count: usize,
        vector: impl Fn(&Rational) -> Option<Vec<F>> + Sync,
    ) -> Option<Samples<F>> {
        let mut found = Samples::default();
        let mut next = 0;
        while found.points.len() < count {
            if next > count + PASSED_OVER {
                return None;
            }
            let batch: Vec<Rational> = (next..next + count - found.points.len())
                .map(|number| self.values.at(symbol, self.names.len(), number))
                .collect();
            next += batch.len();
            let vectors: Vec<Option<Vec<F>>> = batch.par_iter().map(&vector).collect();
            for (point, vector) in batch.iter().zip(vectors) {
                if let Some(vector) = vector {
                    found.push(point, vector)?;
                }
            }
        }
        Some(found)
    }

    /// Returns the degree in one symbol, with numbers for the others.
    fn degree(&self, symbol: usize) -> Option<usize> {
        let values = self.values.start(self.names.len());
        self.degree_along(symbol, |at| {
            let mut values = values.clone();
            values[symbol] = at.clone();
            values
        })
    }

    /// Returns the degree in all symbols together: that on a line, which may be lower on this one.
    fn total_degree(&self) -> Option<usize> {
        self.degree_along(0, |at| (0..self.names.len()).map(|k| Rational::from(at + k as u64)).collect())
    }

    /// Returns the degree in the values of a symbol where these lead to values of all.
    fn degree_along(&self, symbol: usize, values: impl Fn(&Rational) -> Vec<Rational> + Sync) -> Option<usize> {
        let mut degree = 2;
        while degree <= MOST_DEGREE {
            let count = Shape::points(degree, self.length);
            let samples = self.sampled(symbol, count, |at| self.residues::<1>(&values(at)))?;
            if let Some(shape) = Shape::of(&samples.points, &samples.vectors) {
                return Some(shape.degree);
            }
            degree *= 2;
        }
        None
    }

    /// Returns all coefficients of the polynomial in the unknown and the first `level` symbols, those of the unknown outermost, at
    /// values of the other symbols. Unknown shapes are determined and stored, with the number of points that they need.
    fn grid(
        &self,
        level: usize,
        degrees: &[usize],
        outer: &[Rational],
        shapes: &mut [Option<(Shape, usize)>],
    ) -> Option<Vec<Wide>> {
        let Some(below) = level.checked_sub(1) else { return self.residues(outer) };
        let entries = degrees[..below].iter().fold(self.length, |product, degree| product * (degree + 1));
        let least = Shape::points(degrees[below], entries);
        // Where the vectors at all values have few dimensions, as if they are even in the symbol, more of them determine the factors: two
        // dimensions need one point more for every degree and for every spare equation.
        let most = least + degrees[below] + 1 + SPARE;
        let mut count = shapes[below].as_ref().map_or(least, |(_, count)| *count);
        let samples = loop {
            let samples = self.sampled_below(below, count, degrees, outer, shapes)?;
            if shapes[below].is_some() {
                break samples;
            }
            let narrow: Vec<Vec<Narrow>> =
                samples.vectors.iter().map(|vector| vector.iter().map(ManyResidues::first).collect()).collect();
            let points: Vec<Narrow> = samples.points.iter().map(ManyResidues::first).collect();
            // At values where the degree falls the shape is another one: they are skipped.
            if let Some(shape) = Shape::of(&points, &narrow).filter(|shape| shape.degree == degrees[below]) {
                shapes[below] = Some((shape, count));
                break samples;
            }
            if count == most {
                return None;
            }
            count = most.min(2 * count - least + 1);
        };
        let polynomials = shapes[below].as_ref()?.0.interpolate(&samples.points, &samples.vectors)?;
        let padded = |polynomial: Univariate<Wide>| {
            let mut coefficients = polynomial.coefficients().to_vec();
            coefficients.resize(degrees[below] + 1, Wide::zero());
            coefficients
        };
        Some(polynomials.into_iter().flat_map(padded).collect())
    }

    /// Returns the coefficients in all symbols before one at so many values of it.
    fn sampled_below(
        &self,
        below: usize,
        count: usize,
        degrees: &[usize],
        outer: &[Rational],
        shapes: &mut [Option<(Shape, usize)>],
    ) -> Option<Samples<Wide>> {
        let at = |value: &Rational| std::iter::once(value.clone()).chain(outer.iter().cloned()).collect::<Vec<_>>();
        if below == 0 {
            return self.sampled(below, count, |value| self.residues(&at(value)));
        }
        let mut found = Samples::default();
        let mut next = 0;
        while found.points.len() < count {
            if next > count + PASSED_OVER || self.watch.is_ended() {
                return None;
            }
            let number = self.values.at(below, self.names.len(), next);
            if let Some(vector) = self.grid(below, degrees, &at(&number), shapes) {
                found.push(&number, vector)?;
            }
            next += 1;
        }
        Some(found)
    }

    /// Returns the polynomial in the one symbol (variable 0) and the unknown (variable 1), compared at values drawn at random.
    ///
    /// # Errors
    /// As [`Self::interpolated`] and [`Self::compare`].
    pub fn relation(&self) -> Result<Polynomial<Int>> {
        let interpolated = self.interpolated()?;
        let exponent = |power: usize| u32::try_from(power).unwrap_or(u32::MAX);
        let terms = interpolated.terms().map(|(power, own, c)| (vec![own[0], exponent(power)], c.clone()));
        let found = primitive(&Polynomial::from_terms(terms));
        self.compare(&found, 0, |coefficients| {
            let terms = coefficients.iter().enumerate().map(|(power, c)| (vec![0, exponent(power)], Rational::from(c)));
            Polynomial::from_terms(terms)
        })?;
        Ok(found.primitive().0)
    }

    /// Compares a polynomial with those at values drawn at random. Its symbols are the variables from `first`; `polynomial` makes one
    /// of coefficients.
    ///
    /// # Errors
    /// [`Error::Unsupported`] where too few values can be compared.
    pub fn compare(
        &self,
        found: &Polynomial<Rational>,
        first: usize,
        polynomial: impl Fn(&[Integer]) -> Polynomial<Rational>,
    ) -> Result<()> {
        let mut random = ChaCha8Rng::seed_from_u64(drawn::seed());
        let mut compared = 0;
        for _ in 0..COMPARED + PASSED_OVER {
            let values: Vec<Rational> =
                self.names.iter().map(|_| Rational::from(random.random_range(1..=LARGEST))).collect();
            let Some(expected) = self.coefficients(&values) else { continue };
            let put: Vec<(usize, Polynomial<Rational>)> =
                values.iter().enumerate().map(|(k, value)| (first + k, Polynomial::constant(value.clone()))).collect();
            if primitive(&found.substitute_all(&put)) != primitive(&polynomial(&expected)) {
                let message = "the interpolated polynomial differs from the closure polynomial at other values: a fault of this program";
                return Err(Error::Invalid(message.to_owned()));
            }
            compared += 1;
            if compared == COMPARED {
                return Ok(());
            }
        }
        Err(self.stopped("values drawn at random lead to another unknown"))
    }
}

/// Returns the number of products of powers of these degrees at most, and of this total degree at most.
fn products_below(degrees: &[usize], total: usize) -> usize {
    let mut ways = vec![1_usize];
    for degree in degrees {
        let mut next = vec![0; ways.len() + degree];
        for (sum, count) in ways.iter().enumerate() {
            for own in &mut next[sum..=sum + degree] {
                *own += count;
            }
        }
        ways = next;
    }
    ways.iter().take(total + 1).sum()
}

/// Vectors at points.
struct Samples<F> {
    points: Vec<F>,
    vectors: Vec<Vec<F>>,
}

impl<F> Default for Samples<F> {
    fn default() -> Self {
        Self { points: Vec::new(), vectors: Vec::new() }
    }
}

impl<F: Field> Samples<F> {
    fn push(&mut self, point: &Rational, vector: Vec<F>) -> Option<()> {
        self.points.push(F::from_rational(point)?);
        self.vectors.push(vector);
        Some(())
    }
}

/// Returns the rational numbers with these residues, up to a common factor; `None` if they are too long.
fn numbers(residues: &[Wide]) -> Option<Vec<Rational>> {
    let pivot = residues.iter().rev().find(|x| !x.is_zero())?.inverse()?;
    let mut denominator = Rational::from(1);
    let mut numbers = Vec::with_capacity(residues.len());
    for residue in residues {
        if residue.is_zero() {
            numbers.push(Rational::new());
            continue;
        }
        // With the denominators of earlier numbers most are integers, which are found at once.
        let number = residue.mul(&pivot).mul(&Wide::from_rational(&denominator)?).rational()?;
        let own = number.denom().clone();
        numbers.push(number / &denominator);
        denominator *= own;
    }
    Some(numbers)
}
