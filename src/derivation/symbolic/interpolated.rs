//! Closure polynomials with up to three symbols, for every mechanism whose closure polynomial is derived from numbers.

use super::routes::Outcome;
use super::setting::Setting;
use super::{Header, Symbolic, assembled};
use crate::algebra::polynomial::Polynomial;
use crate::catalogue::entry::{Case, Entry};
use crate::derivation::equation::primitive;
use crate::derivation::interpolation::{COMPARED, Family, Source, Values, Watch};
use crate::derivation::{Derivation, derive};
use crate::error::{Error, Result};
use rug::{Integer, Rational};

/// Maximum number of symbols: the number of samples is a product with one factor for each.
pub(super) const MOST_SYMBOLS: usize = 3;

/// The closure polynomials of a mechanism at values of the symbols, in one and the same unknown.
struct Closures<'s> {
    entry: Entry,
    case: &'s Case,
    settings: &'s [Setting],
    /// The derivation that determines the unknown.
    first: Derivation,
    /// Number of coefficients.
    length: usize,
}

fn derivation(entry: &Entry, case: &Case, settings: &[Setting], values: &[Rational]) -> Result<Derivation> {
    let (mut entry, mut case) = (entry.clone(), case.clone());
    for (setting, value) in settings.iter().zip(values) {
        setting.put(&mut entry, &mut case, value);
    }
    derive(&entry, &case)
}

impl<'s> Closures<'s> {
    fn of(entry: Entry, case: &'s Case, settings: &'s [Setting]) -> Result<Self> {
        let first = derivation(&entry, case, settings, &Values::Small.start(settings.len()))?;
        let Some(polynomial) = &first.polynomial else {
            let reason = first.without.as_deref().unwrap_or("there is no closure polynomial");
            return Err(Error::Unsupported(format!("at numbers in the place of the symbols, {reason}")));
        };
        let length = polynomial.degree() + polynomial.at_pi + 1;
        if length < 2 {
            let message = "at numbers in the place of the symbols, the closure polynomial is a constant";
            return Err(Error::Unsupported(message.to_owned()));
        }
        Ok(Self { entry, case, settings, first, length })
    }
}

impl Source for Closures<'_> {
    /// Returns the coefficients, constant term first; `None` if the derivation uses another unknown.
    fn coefficients(&self, values: &[Rational]) -> Option<Vec<Integer>> {
        let found = derivation(&self.entry, self.case, self.settings, values).ok()?;
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
}

/// Derives one case with up to three symbols by interpolation: link parameters, the input, coordinates of the pose, legs.
///
/// # Errors
/// [`Error::Unsupported`] for more symbols, for mechanisms without a closure polynomial, if it would have more than 100,000 terms, and
/// where it is ended; [`Error::Invalid`] for an unknown symbol.
pub(crate) fn derive_interpolated(
    entry: &Entry,
    case: &Case,
    wanted: &[String],
    watch: &Watch<'_>,
) -> Result<Symbolic> {
    let all = Setting::all(entry, case);
    let settings = Setting::named(&all, wanted)?;
    if settings.is_empty() || settings.len() > MOST_SYMBOLS {
        let found = settings.len();
        return Err(Error::Unsupported(format!(
            "found {found} symbols, expected one to {MOST_SYMBOLS} of this mechanism"
        )));
    }
    let source = Closures::of(Entry { cases: Vec::new(), ..entry.clone() }, case, &settings)?;
    let symbols = settings.iter().map(|one| one.name.clone()).collect();
    let family = Family::new(&source, watch, Values::Small, symbols, source.length);
    let interpolated = family.interpolated()?;
    let names = source.first.names.list().to_vec();
    let unknown = source.first.polynomial.as_ref().map_or(0, |polynomial| polynomial.variable);
    let variables = (names.len() + settings.len()).max(unknown + 1);
    let terms = interpolated.terms().map(|(power, symbols, c)| {
        let mut exponents = vec![0; variables];
        exponents[names.len()..names.len() + symbols.len()].copy_from_slice(&symbols);
        exponents[unknown] = u32::try_from(power).unwrap_or(u32::MAX);
        (exponents, c.clone())
    });
    let found = primitive(&Polynomial::from_terms(terms));
    family.compare(&found, names.len(), |coefficients| {
        let constants = coefficients.iter().map(|c| Polynomial::constant(Rational::from(c))).collect::<Vec<_>>();
        Polynomial::from_coefficients_in(unknown, &constants)
    })?;
    let degrees = interpolated.degrees;
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
    let definition = source.first.definition.iter();
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
