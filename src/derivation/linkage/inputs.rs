//! The closure polynomial of a linkage as a polynomial in a given value and coordinates too, interpolated from those at numbers.

use super::closure::{InputNumber, InputOutput, LinkageDerivation, derive_linkage, is_multiple};
use super::symbolic::Coordinate;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::derivation::equation::primitive;
use crate::derivation::interpolation::{COMPARED, Family, Source, Values, Watch};
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Given, Linkage};
use rug::{Integer, Rational};

/// The closure polynomials of one body at values of one given joint and of coordinates of points.
pub(super) struct Closures<'l> {
    pub linkage: &'l Linkage,
    pub given: &'l [Given],
    /// The number of the given joint.
    pub place: usize,
    pub symbols: &'l [Coordinate],
    /// The body whose half-angle tangent is the unknown.
    pub body: usize,
    /// The number of roots, those at pi counted.
    pub degree: usize,
}

impl Closures<'_> {
    /// Returns the derivation at a value of the given joint, a half-angle tangent or metres, and of the coordinates in metres.
    fn at(&self, values: &[Rational]) -> Option<LinkageDerivation> {
        let (value, coordinates) = values.split_first()?;
        let mut linkage = self.linkage.clone();
        for (symbol, coordinate) in self.symbols.iter().zip(coordinates) {
            symbol.put(&mut linkage, coordinate);
        }
        let mut given = self.given.to_vec();
        given[self.place] = given[self.place].at(&linkage, value)?;
        derive_linkage(&linkage, &given).ok()
    }

    /// Takes the number of roots at values in general position for the degree; `None` where there is no polynomial.
    fn general(mut self) -> Option<Self> {
        let found = self.at(&Values::Small.start(1 + self.symbols.len()))?;
        self.degree = found.polynomials.iter().find(|one| one.body == self.body)?.roots();
        Some(self)
    }

    /// Returns the polynomial in the given value (variable 0), the half-angle tangent of the body (variable 1) and the coordinates. It is
    /// compared at values drawn at random, and has no proof.
    ///
    /// # Errors
    /// [`Error::Unsupported`] where the values do not determine it.
    pub fn interpolated(&self, watch: &Watch<'_>) -> Result<Polynomial<Int>> {
        let joint = self.given[self.place].joint();
        let names = joint.map_or_else(String::new, |joint| self.linkage.joints[joint].name.clone());
        let names = std::iter::once(names).chain(self.symbols.iter().map(|one| one.name(self.linkage))).collect();
        let family = Family::new(self, watch, Values::Small, names, self.degree + 1);
        let exponent = |power: usize| u32::try_from(power).unwrap_or(u32::MAX);
        // The unknown is variable 0 here, as the symbols have to follow one another.
        let interpolated = family.interpolated()?;
        let terms = interpolated.terms().map(|(power, own, c)| {
            let exponents = std::iter::once(exponent(power)).chain(own);
            (exponents.collect::<Vec<u32>>(), c.clone())
        });
        let found = primitive(&Polynomial::from_terms(terms));
        family.compare(&found, 1, |coefficients| {
            let terms = coefficients.iter().enumerate().map(|(power, c)| (vec![exponent(power)], Rational::from(c)));
            Polynomial::from_terms(terms)
        })?;
        let count = 2 + self.symbols.len();
        let exchanged = found.terms().map(|(mut exponents, c)| {
            exponents.resize(count, 0);
            exponents.swap(0, 1);
            (exponents, c.clone())
        });
        let integers = Polynomial::from_terms(exchanged).primitive().0;
        if integers.degree(1) as usize == self.degree { Ok(integers) } else { Err(half_turn()) }
    }
}

impl Source for Closures<'_> {
    fn coefficients(&self, values: &[Rational]) -> Option<Vec<Integer>> {
        let found = self.at(values)?;
        let own = found.polynomials.iter().find(|one| one.body == self.body)?;
        let mut list = own.coefficients.coefficients().to_vec();
        list.resize(self.degree + 1, Integer::new());
        (own.roots() == self.degree).then_some(list)
    }
}

/// Returns the polynomial in a given value, a half-angle tangent or metres (variable 0), and the half-angle tangent of a body (variable 1),
/// of the closure polynomials of this body, which have so many roots. It is compared at values drawn at random, and has no proof.
///
/// # Errors
/// [`Error::Unsupported`] where the values do not determine it.
pub fn relation_by_values(
    linkage: &Linkage,
    given: &[Given],
    place: usize,
    (body, degree): (usize, usize),
    watch: &Watch<'_>,
) -> Result<Polynomial<Int>> {
    Closures { linkage, given, place, symbols: &[], body, degree }.interpolated(watch)
}

fn half_turn() -> Error {
    Error::Unsupported(
        "a body makes half a turn at all values of the input: no closure polynomial in it is known".to_owned(),
    )
}

/// Returns the relation of the first given joint, the others held, and the body of the best polynomial, with coordinates for symbols; and
/// whether at the numbers of the file it is that polynomial. `None` without a given joint and a polynomial.
///
/// # Errors
/// As [`Closures::interpolated`].
pub(super) fn relation_with_symbols(
    linkage: &Linkage,
    given: &[Given],
    derivation: &LinkageDerivation,
    symbols: &[Coordinate],
    watch: &Watch<'_>,
) -> Result<Option<(Polynomial<Int>, bool)>> {
    let (Some(one), Some(best)) = (given.first(), derivation.polynomials.first()) else { return Ok(None) };
    let closures = Closures { linkage, given, place: 0, symbols, body: best.body, degree: 0 };
    let Some(closures) = one.joint().and_then(|_| closures.general()) else { return Ok(None) };
    let polynomial = closures.interpolated(watch)?;
    let own = InputNumber::in_metres(linkage, one).and_then(|number| number.put(&polynomial));
    let at_file: Vec<(usize, Polynomial<Rational>)> =
        symbols.iter().enumerate().map(|(k, own)| (2 + k, Polynomial::constant(own.value.clone()))).collect();
    let own = own.and_then(|own| own.substitute_all(&at_file).to_univariate(1));
    let agrees = own.is_some_and(|own| is_multiple(&own, &best.coefficients));
    Ok(Some((polynomial, agrees)))
}

/// Derives the closure polynomials as [`derive_linkage`], and with gears the relation of the first given joint, a half-angle tangent or
/// metres, and the half-angle tangent of the body of the best one, too. That is interpolated from closure polynomials at other values of the
/// joint. Where these do not determine it a warning says why.
///
/// # Errors
/// As [`derive_linkage`].
pub fn derive_linkage_with_input(linkage: &Linkage, given: &[Given], watch: &Watch<'_>) -> Result<LinkageDerivation> {
    let mut derivation = derive_linkage(linkage, given)?;
    if derivation.gears.is_empty() {
        return Ok(derivation);
    }
    match relation_with_symbols(linkage, given, &derivation, &[], watch) {
        Ok(Some((polynomial, agrees))) => {
            let (Some(one), Some(best)) = (given.first(), derivation.polynomials.first()) else {
                return Ok(derivation);
            };
            derivation.input_output = one.joint().map(|input| InputOutput {
                input,
                is_turn: matches!(one, Given::Turn { .. }),
                body: best.body,
                against: best.against,
                held: given[1..].iter().filter_map(Given::joint).collect(),
                joints: linkage.joints.len(),
                polynomial,
                compared: Some(COMPARED),
                agrees,
            });
        }
        Ok(None) => (),
        Err(error) => derivation.warnings.push(format!("no relation of the input and the output is known: {error}")),
    }
    Ok(derivation)
}
