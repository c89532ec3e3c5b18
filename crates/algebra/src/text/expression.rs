//! The syntax tree of a text.

use super::fault::{Fault, Place};
use super::fraction::Fraction;
use super::names::Names;
use super::parser;
use super::terms::{Terms, power};
use crate::error::Error;
use crate::ring::Ring;
use rug::Rational;

/// Values whose exact rationals would have more bits than this are refused.
const LARGEST_VALUE: u64 = 1 << 30;
/// Polynomials in which one number might have more bits than this are refused; the bound is far from sharp for sums.
const LARGEST_NUMBER: u64 = 1 << 32;

/// A polynomial as it is written: sums, products and powers, not multiplied out.
///
/// Numbers are exact (`0.1` is 1/10), products need their `*`, powers are `^` or `**` with whole numbers, division is by
/// numbers only, and `#` begins a comment up to the end of its line.
///
/// # Example
/// ```
/// use looproot_algebra::text::{Expression, Format, Names};
///
/// let mut names = Names::collected();
/// let expression = Expression::parse("(x + y/2)^2 - 0.25*y^2", &mut names).unwrap();
/// let polynomial = expression.expand().unwrap().to_rational();
/// assert_eq!(Format::Text.polynomial(&polynomial, &names), "x^2 + x*y");
/// ```
#[derive(Clone, Debug)]
pub struct Expression(pub(super) Node);

#[derive(Clone, Debug)]
pub(super) enum Node {
    Terms(Place, Terms),
    /// Plain terms and others.
    Sum(Place, Terms, Vec<Node>),
    Product(Place, Vec<Node>),
    Power(Place, Box<Node>, u32),
}

impl Expression {
    /// Reads one polynomial.
    ///
    /// # Errors
    /// The text found, the text expected, and the place.
    pub fn parse(text: &str, names: &mut Names) -> Result<Self, Fault> {
        parser::one(text, names).map(Self)
    }

    /// Reads polynomials with `;` between them, and optionally behind the last one.
    ///
    /// # Errors
    /// The text found, the text expected, and the place.
    pub fn parse_all(text: &str, names: &mut Names) -> Result<Vec<Self>, Fault> {
        Ok(parser::all(text, names)?.into_iter().map(Self).collect())
    }

    /// Reads the rows of a matrix: `[[a, b], [c, d]]`, `[a, b; c, d]`, or the latter without brackets.
    ///
    /// # Errors
    /// The text found, the text expected, and the place.
    pub fn parse_matrix(text: &str, names: &mut Names) -> Result<Vec<Vec<Self>>, Fault> {
        let rows = parser::matrix(text, names)?;
        Ok(rows.into_iter().map(|row| row.into_iter().map(Self).collect()).collect())
    }

    /// Returns the polynomial, multiplied out, in lowest terms.
    ///
    /// # Errors
    /// If an exponent becomes too large, or the result would (by an estimate made before multiplying).
    pub fn expand(&self) -> Result<Fraction, Fault> {
        // Plain terms have the numbers that were read.
        let growth = if matches!(self.0, Node::Terms(..)) { 0 } else { self.0.growth(&[]) };
        if growth > LARGEST_NUMBER {
            let digits = growth as f64 * std::f64::consts::LOG10_2;
            let message =
                format!("found a polynomial with numbers of up to {digits:.0e} digits, expected shorter ones");
            return Err(Fault::new(self.0.place(), message));
        }
        self.0.expand().map(Fraction::reduced)
    }

    /// Returns the value for the given values of the variables, without multiplying out; `None` if a number has no image in
    /// the ring.
    ///
    /// # Panics
    /// If a variable has no value.
    #[must_use]
    pub fn evaluate<R: Ring>(&self, values: &[R]) -> Option<R> {
        self.0.evaluate(values)
    }

    /// Returns the exact value at rational numbers.
    ///
    /// # Errors
    /// [`Error::Invalid`] if it might have too many digits.
    ///
    /// # Panics
    /// If a variable has no value.
    pub fn value(&self, values: &[Rational]) -> Result<Rational, Error> {
        let bits =
            |q: &Rational| u64::from(q.numer().significant_bits().max(1)) + u64::from(q.denom().significant_bits());
        let growth = self.0.growth(&values.iter().map(bits).collect::<Vec<_>>());
        if growth > LARGEST_VALUE {
            let digits = growth as f64 * std::f64::consts::LOG10_2;
            return Err(Error::Invalid(format!("found a value of up to {digits:.0e} digits, expected a shorter one")));
        }
        Ok(self.evaluate(values).expect("every rational is its own image"))
    }
}

impl Node {
    /// Returns the place at which it begins.
    const fn place(&self) -> Place {
        match self {
            Self::Terms(place, _) | Self::Sum(place, ..) | Self::Product(place, _) | Self::Power(place, ..) => *place,
        }
    }

    fn evaluate<R: Ring>(&self, values: &[R]) -> Option<R> {
        match self {
            Self::Terms(_, terms) => terms.evaluate(values),
            Self::Sum(_, terms, nodes) => {
                nodes.iter().try_fold(terms.evaluate(values)?, |sum, node| Some(sum.add(&node.evaluate(values)?)))
            }
            Self::Product(_, nodes) => {
                nodes.iter().try_fold(R::one(), |product, node| Some(product.mul(&node.evaluate(values)?)))
            }
            Self::Power(_, base, exponent) => Some(power(&base.evaluate(values)?, *exponent)),
        }
    }

    /// Returns a bound of the size of the value, see [`Terms::growth`].
    fn growth(&self, sizes: &[u64]) -> u64 {
        match self {
            Self::Terms(_, terms) => terms.growth(sizes),
            Self::Sum(_, terms, nodes) => {
                nodes.iter().map(|node| node.growth(sizes)).fold(terms.growth(sizes), u64::saturating_add)
            }
            Self::Product(_, nodes) => nodes.iter().map(|node| node.growth(sizes)).fold(0, u64::saturating_add),
            Self::Power(_, base, exponent) => base.growth(sizes).saturating_mul(u64::from(*exponent)),
        }
    }
}
