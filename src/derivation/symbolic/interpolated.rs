//! Closure polynomials with up to three symbols, for every mechanism whose closure polynomial is derived from numbers. They are
//! derived at many values of the symbols and interpolated.
//!
//! The closure polynomial at values y of the symbols is primitive over Z, hence known up to a factor that depends on y.
//! [`Shape`] finds degree and factors. The arithmetic is modulo 256 primes at once; the rational numbers are found from their
//! residues. The result is compared with the closure polynomials at further values, which are drawn at run time.

use super::routes::Outcome;
use super::setting::Setting;
use super::{Header, Symbolic, assembled};
use crate::algebra::drawn;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::projective::Shape;
use crate::algebra::residues::ManyResidues;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::catalogue::entry::{Case, Entry};
use crate::derivation::equation::primitive;
use crate::derivation::{Derivation, derive};
use crate::error::{Error, Result};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use rug::{Integer, Rational};
use std::collections::HashMap;
use std::sync::Mutex;

/// Maximum number of symbols: the number of samples is a product with one factor for each.
pub(super) const MOST_SYMBOLS: usize = 3;
/// Maximum number of terms: a program that reads larger polynomials is better served by the numbers.
const MOST_TERMS: usize = 100_000;
/// Maximum degree in a symbol.
const MOST_DEGREE: usize = 96;
/// Number of values at which the result is compared with a separate derivation.
const COMPARED: usize = 20;
/// Number of values that may be skipped, because their derivation uses another unknown or fails.
const PASSED_OVER: usize = 12;
/// The first value used: at 0 and at 1 links have length 0, and angles are right.
const FIRST: usize = 2;
/// Largest integer for comparisons: a wrong polynomial of degree d agrees by chance at all of them with a probability below
/// `(d / 2^20)^20`.
const LARGEST: u32 = 1 << 20;

/// Residues modulo all primes at hand: enough for numerators and denominators of 2389 digits.
type Wide = ManyResidues<256>;
/// Residues modulo the first of these primes.
type Narrow = ManyResidues<1>;

/// The closure polynomials of a mechanism at values of the symbols.
struct Source<'s> {
    entry: Entry,
    case: &'s Case,
    settings: &'s [Setting],
}

impl Source<'_> {
    fn derivation(&self, values: &[Rational]) -> Result<Derivation> {
        let (mut entry, mut case) = (self.entry.clone(), self.case.clone());
        for (setting, value) in self.settings.iter().zip(values) {
            setting.put(&mut entry, &mut case, value);
        }
        derive(&entry, &case)
    }
}

/// The closure polynomials in one and the same unknown.
struct Family<'s> {
    source: &'s Source<'s>,
    /// The derivation that determines the unknown.
    first: Derivation,
    /// Number of coefficients.
    length: usize,
    /// The values derived so far.
    known: Mutex<HashMap<Vec<Rational>, Option<Vec<Integer>>>>,
}

impl<'s> Family<'s> {
    fn of(source: &'s Source<'s>) -> Result<Self> {
        let start: Vec<Rational> = (0..source.settings.len()).map(base).collect();
        let first = source.derivation(&start)?;
        let Some(polynomial) = &first.polynomial else {
            let reason = first.without.as_deref().unwrap_or("there is no closure polynomial");
            return Err(Error::Unsupported(format!("at numbers in the place of the symbols, {reason}")));
        };
        let length = polynomial.degree() + polynomial.at_pi + 1;
        if length < 2 {
            let message = "at numbers in the place of the symbols, the closure polynomial is a constant";
            return Err(Error::Unsupported(message.to_owned()));
        }
        Ok(Self { source, first, length, known: Mutex::default() })
    }

    /// Returns the coefficients at values of the symbols, constant term first; `None` if the derivation uses another unknown.
    fn coefficients(&self, values: &[Rational]) -> Option<Vec<Integer>> {
        let known = self.known.lock().ok().and_then(|known| known.get(values).cloned());
        known.unwrap_or_else(|| {
            let found = self.derived(values);
            if let Ok(mut known) = self.known.lock() {
                known.insert(values.to_vec(), found.clone());
            }
            found
        })
    }

    fn derived(&self, values: &[Rational]) -> Option<Vec<Integer>> {
        let found = self.source.derivation(values).ok()?;
        let variable = |one: &Derivation| Some(one.names.list()[one.polynomial.as_ref()?.variable].clone());
        if variable(&found) != variable(&self.first) || found.definition != self.first.definition || !found.finite {
            return None;
        }
        let mut coefficients = found.polynomial?.coefficients.coefficients().to_vec();
        if coefficients.len() > self.length {
            return None;
        }
        coefficients.resize(self.length, Integer::new());
        Some(coefficients)
    }

    fn residues<const N: usize>(&self, values: &[Rational]) -> Option<Vec<ManyResidues<N>>> {
        let coefficients = self.coefficients(values)?;
        coefficients.into_iter().map(|c| ManyResidues::from_rational(&Rational::from(c))).collect()
    }

    /// Returns the degree in one symbol, with numbers for the others.
    fn degree(&self, symbol: usize) -> Option<usize> {
        let values: Vec<Rational> = (0..self.source.settings.len()).map(base).collect();
        let mut degree = 2;
        while degree <= MOST_DEGREE {
            let count = Shape::points(degree, self.length);
            let samples = samples(count, |at| {
                let mut values = values.clone();
                values[symbol] = at.clone();
                self.residues::<1>(&values)
            })?;
            if let Some(shape) = Shape::of(&samples.points, &samples.vectors) {
                return Some(shape.degree);
            }
            degree *= 2;
        }
        None
    }

    /// Returns all coefficients of the polynomial in the unknown and the first `level` symbols, those of the unknown outermost, at
    /// values of the other symbols. Unknown shapes are determined and stored.
    fn grid(
        &self,
        level: usize,
        degrees: &[usize],
        outer: &[Rational],
        shapes: &mut [Option<Shape>],
    ) -> Option<Vec<Wide>> {
        let Some(below) = level.checked_sub(1) else { return self.residues(outer) };
        let entries = degrees[..below].iter().fold(self.length, |product, degree| product * (degree + 1));
        let count = Shape::points(degrees[below], entries);
        let at = |value: &Rational| std::iter::once(value.clone()).chain(outer.iter().cloned()).collect::<Vec<_>>();
        let samples = if below == 0 {
            samples(count, |value| self.residues(&at(value)))?
        } else {
            let mut found = Samples::default();
            let mut value = FIRST;
            while found.points.len() < count {
                if value > FIRST + count + PASSED_OVER {
                    return None;
                }
                let number = Rational::from(value);
                if let Some(vector) = self.grid(below, degrees, &at(&number), shapes) {
                    found.push(&number, vector)?;
                }
                value += 1;
            }
            found
        };
        if shapes[below].is_none() {
            let narrow: Vec<Vec<Narrow>> =
                samples.vectors.iter().map(|vector| vector.iter().map(ManyResidues::first).collect()).collect();
            let points: Vec<Narrow> = samples.points.iter().map(ManyResidues::first).collect();
            shapes[below] = Some(Shape::of(&points, &narrow).filter(|shape| shape.degree <= degrees[below])?);
        }
        let polynomials = shapes[below].as_ref()?.interpolate(&samples.points, &samples.vectors)?;
        let padded = |polynomial: Univariate<Wide>| {
            let mut coefficients = polynomial.coefficients().to_vec();
            coefficients.resize(degrees[below] + 1, Wide::zero());
            coefficients
        };
        Some(polynomials.into_iter().flat_map(padded).collect())
    }
}

/// Returns a number for a symbol while another one varies; it is one of those used later, so that nothing is derived twice.
fn base(symbol: usize) -> Rational {
    Rational::from(FIRST + symbol)
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

/// Returns the first `count` values at which there is a vector.
fn samples<F: Field + Send>(count: usize, vector: impl Fn(&Rational) -> Option<Vec<F>> + Sync) -> Option<Samples<F>> {
    let mut found = Samples::default();
    let mut next = FIRST;
    while found.points.len() < count {
        if next > FIRST + count + PASSED_OVER {
            return None;
        }
        let batch: Vec<Rational> = (next..next + count - found.points.len()).map(Rational::from).collect();
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

/// Returns the polynomial over all variables: the unknown, and the symbols from `first`.
fn polynomial(numbers: &[Rational], degrees: &[usize], unknown: usize, first: usize) -> Polynomial<Rational> {
    let variables = first + degrees.len();
    let terms = numbers.iter().enumerate().filter(|(_, c)| !c.is_zero()).map(|(place, c)| {
        let mut exponents = vec![0; variables.max(unknown + 1)];
        let mut rest = place;
        for (k, degree) in degrees.iter().enumerate().rev() {
            exponents[first + k] = u32::try_from(rest % (degree + 1)).unwrap_or(u32::MAX);
            rest /= degree + 1;
        }
        exponents[unknown] = u32::try_from(rest).unwrap_or(u32::MAX);
        (exponents, c.clone())
    });
    Polynomial::from_terms(terms)
}

/// Derives one case with up to three symbols by interpolation: link parameters, the input, coordinates of the pose, legs.
///
/// # Errors
/// [`Error::Unsupported`] for more symbols, for mechanisms without a closure polynomial, and if it would have more than
/// 100,000 terms; [`Error::Invalid`] for an unknown symbol.
pub(crate) fn derive_interpolated(entry: &Entry, case: &Case, wanted: &[String]) -> Result<Symbolic> {
    let all = Setting::all(entry, case);
    let settings = Setting::named(&all, wanted)?;
    if settings.is_empty() || settings.len() > MOST_SYMBOLS {
        let found = settings.len();
        return Err(Error::Unsupported(format!(
            "found {found} symbols, expected one to {MOST_SYMBOLS} of this mechanism"
        )));
    }
    let source = Source { entry: Entry { cases: Vec::new(), ..entry.clone() }, case, settings: &settings };
    let family = Family::of(&source)?;
    let open = |what: &str| {
        let message = format!("{what}: the closure polynomial is derived with numbers only, or with other symbols");
        Error::Unsupported(message)
    };
    let degree = |k: usize| {
        let message =
            format!("the degree in {} is above {MOST_DEGREE}, or the unknown changes with it", settings[k].name);
        family.degree(k).ok_or_else(|| open(&message))
    };
    let degrees: Vec<usize> = (0..settings.len()).map(degree).collect::<Result<_>>()?;
    let terms = degrees.iter().fold(family.length, |product, degree| product.saturating_mul(degree + 1));
    if terms > MOST_TERMS {
        let message = format!("with these symbols there is room for {terms} terms, expected at most {MOST_TERMS}");
        return Err(open(&message));
    }
    let mut shapes: Vec<Option<Shape>> = vec![None; settings.len()];
    let residues = family.grid(settings.len(), &degrees, &[], &mut shapes);
    let residues = residues.ok_or_else(|| open("the values of the symbols at hand do not determine it"))?;
    let numbers = numbers(&residues).ok_or_else(|| open("its coefficients are longer than 2389 digits"))?;
    let names = family.first.names.list().to_vec();
    let unknown = family.first.polynomial.as_ref().map_or(0, |polynomial| polynomial.variable);
    let found = primitive(&polynomial(&numbers, &degrees, unknown, names.len()));
    compare(&family, &found, unknown, names.len())?;
    let list: Vec<String> =
        degrees.iter().zip(&settings).map(|(degree, one)| format!("{degree} in {}", one.variable)).collect();
    let steps = vec![
        format!(
            "The closure polynomial is derived at values of {}, each time over the rationals as without --symbolic.",
            wanted.join(", ")
        ),
        format!(
            "It is of degree {}: the factors by which those at different values are divided are a solution of linear equations, \
             divided differences that vanish; the coefficients are interpolated modulo 256 primes and found from their residues.",
            list.join(", ")
        ),
    ];
    let definition = family.first.definition.iter();
    let outcome = Outcome {
        equations: definition.map(|one| ("the variable".to_owned(), one.clone())).collect(),
        steps,
        // Coefficients of hundreds of digits, expanded over names, would exceed the range of f64.
        polynomial: Some((unknown, found.clone(), Some(Box::new(move |_| found)))),
        translations: Vec::new(),
        compare: Vec::new(),
        removed: Polynomial::constant(Rational::from(1)),
        compared: format!("equal to the closure polynomials derived at {COMPARED} other values, drawn at random"),
    };
    let values =
        settings.iter().enumerate().filter_map(|(k, one)| Some((names.len() + k, one.value.clone()?))).collect();
    let others = all.iter().filter(|one| !wanted.contains(&one.name) && one.text != "0");
    let header = Header {
        unknowns: names.clone(),
        variables: settings.iter().map(|one| one.variable.clone()).collect(),
        symbols: wanted.to_vec(),
        numbers: others.map(|one| format!("{} = {}", one.name, one.text)).collect(),
        values,
        proved: false,
    };
    assembled(header, outcome)
}

/// Compares the polynomial with the closure polynomials at values drawn at random.
fn compare(family: &Family<'_>, found: &Polynomial<Rational>, unknown: usize, first: usize) -> Result<()> {
    let mut random = ChaCha8Rng::seed_from_u64(drawn::seed());
    let mut compared = 0;
    for _ in 0..COMPARED + PASSED_OVER {
        let values: Vec<Rational> =
            family.source.settings.iter().map(|_| Rational::from(random.random_range(1..=LARGEST))).collect();
        let Some(expected) = family.coefficients(&values) else { continue };
        let put: Vec<(usize, Polynomial<Rational>)> =
            values.iter().enumerate().map(|(k, value)| (first + k, Polynomial::constant(value.clone()))).collect();
        let expected = expected.into_iter().map(|c| Polynomial::constant(Rational::from(c))).collect::<Vec<_>>();
        let expected = Polynomial::from_coefficients_in(unknown, &expected);
        if primitive(&found.substitute_all(&put)) != primitive(&expected) {
            let message = "the interpolated polynomial differs from the closure polynomial at other values: a fault of this program";
            return Err(Error::Invalid(message.to_owned()));
        }
        compared += 1;
        if compared == COMPARED {
            return Ok(());
        }
    }
    let message = "values drawn at random lead to another unknown: the closure polynomial is derived with numbers only";
    Err(Error::Unsupported(message.to_owned()))
}
