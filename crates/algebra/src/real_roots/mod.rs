//! Real roots of polynomials with integer or rational coefficients, isolated with proof and refined on demand.

mod bernstein;
mod cell;
mod evaluate;
mod fixed;
mod isolate;
mod rational;
mod refine;
mod rough;
mod sample;
mod short;

use super::int::Int;
use super::ring::Ring;
use super::univariate::Univariate;
use cell::dyadic;
use isolate::{Place, isolate};
use rug::{Integer, Rational};
use std::sync::Arc;

/// A real root of a polynomial: an exact number, or an interval in which the polynomial has no other.
///
/// # Example
/// ```
/// use looproot_algebra::univariate::Univariate;
/// use rug::{Integer, Rational};
///
/// // x (x^2 - 2)^2
/// let poly = Univariate::new([0, 4, 0, -4, 0, 1].map(Integer::from).to_vec());
/// let mut roots = poly.real_roots();
/// assert_eq!(roots.iter().map(|root| root.multiplicity()).collect::<Vec<_>>(), [2, 1, 2]);
/// assert_eq!(roots[1].exact(), Some(Rational::new()));
/// assert_eq!(roots[2].to_f64(), 2.0_f64.sqrt());
/// ```
#[derive(Clone, Debug)]
pub struct RealRoot {
    /// The root is a simple root of it.
    polynomial: Arc<Univariate<Integer>>,
    multiplicity: usize,
    place: Place,
}

impl RealRoot {
    /// Returns the multiplicity of the root in the polynomial that was given.
    #[must_use]
    pub fn multiplicity(&self) -> usize {
        self.multiplicity
    }

    /// Returns the exact root if the bisection hit it, as a dyadic number. Other roots may be rational too.
    #[must_use]
    pub fn exact(&self) -> Option<Rational> {
        match &self.place {
            Place::At(numerator, exponent) => Some(dyadic(numerator, *exponent)),
            Place::Within(..) => None,
        }
    }

    /// Returns the closed interval that holds the root; its ends are equal if the root is known exactly.
    #[must_use]
    pub fn bounds(&self) -> (Rational, Rational) {
        match &self.place {
            Place::At(numerator, exponent) => (dyadic(numerator, *exponent), dyadic(numerator, *exponent)),
            Place::Within(cell, ..) => (cell.lo(), cell.hi()),
        }
    }
}

/// Sorts the roots and shrinks their intervals until no two of them touch.
fn separate(roots: &mut [RealRoot]) {
    loop {
        roots.sort_by(RealRoot::compare_start);
        let mut touched = false;
        for i in 1..roots.len() {
            let (left, right) = roots.split_at_mut(i);
            let (a, b) = (&mut left[i - 1], &mut right[0]);
            let mut bits = 1;
            while a.touches(b) {
                touched = true;
                a.shrink(bits);
                if a.touches(b) {
                    b.shrink(bits);
                }
                bits *= 2;
            }
        }
        // Intervals of different square-free factors may overlap; narrowing them may change the order.
        if !touched {
            return;
        }
    }
}

impl Univariate<Integer> {
    /// Returns the distinct real roots from left to right, each with its multiplicity and a closed interval of its own that
    /// meets no other; none for a constant.
    ///
    /// # Panics
    /// When the polynomial is zero.
    ///
    /// # Source
    /// Descartes' rule on Bernstein coefficients as in Eigenwillig et al. 2005, "A Descartes algorithm for polynomials
    /// with bit-stream coefficients", CASC.
    #[must_use]
    pub fn real_roots(&self) -> Vec<RealRoot> {
        assert!(self.degree().is_some(), "every number is a root of zero");
        let by_floats = roots_by_floats(self.coefficients(), rough::leading, Integer::clone);
        by_floats.unwrap_or_else(|| roots_of_multiplicity(self.coefficients()))
    }
}

impl Univariate<Int> {
    /// Returns the distinct real roots, as for big integers.
    ///
    /// # Panics
    /// When the polynomial is zero.
    #[must_use]
    pub fn real_roots(&self) -> Vec<RealRoot> {
        assert!(self.degree().is_some(), "every number is a root of zero");
        let lead = |c: &Int| c.to_i64().map_or_else(|| rough::leading(&c.to_integer()), short::lead_of_word);
        let integers = || self.coefficients().iter().map(Int::to_integer).collect::<Vec<_>>();
        roots_by_floats(self.coefficients(), lead, Int::to_integer)
            .unwrap_or_else(|| roots_of_multiplicity(&integers()))
    }
}

/// Returns the number of lowest coefficients that are zero.
fn zeros<C: Ring>(coefficients: &[C]) -> usize {
    coefficients.iter().take_while(|c| c.is_zero()).count()
}

/// Returns the square-free factors of a polynomial, not zero, and their multiplicities.
fn factors(coefficients: &[Integer]) -> Vec<(Univariate<Integer>, usize)> {
    let zeros = zeros(coefficients);
    let rest = Univariate::new(coefficients[zeros..].to_vec());
    let mut factors = rest.square_free_decomposition();
    if zeros > 0 {
        factors.insert(0, (Univariate::x(), zeros));
    }
    factors
}

/// Returns the real roots of a polynomial, not zero, by its square-free factors, without f64 alone.
#[cfg(test)]
fn roots(coefficients: &[Integer]) -> Vec<RealRoot> {
    roots_of_factors(&factors(coefficients))
}

/// Returns the real roots of a polynomial, not zero, where f64 alone did not settle them: mostly because some are multiple, and then those of
/// the square-free factors are often settled by it.
fn roots_of_multiplicity(coefficients: &[Integer]) -> Vec<RealRoot> {
    let factors = factors(coefficients);
    let by_floats = |(factor, multiplicity): &(Univariate<Integer>, usize)| {
        if *factor == Univariate::x() {
            return Some(vec![zero(*multiplicity)]);
        }
        let mut roots = roots_by_floats(factor.coefficients(), rough::leading, Integer::clone)?;
        for root in &mut roots {
            root.multiplicity = *multiplicity;
        }
        Some(roots)
    };
    if factors.iter().all(|(_, multiplicity)| *multiplicity == 1) {
        return roots_of_factors(&factors);
    }
    let mut roots = Vec::new();
    for factor in &factors {
        roots.extend(by_floats(factor).unwrap_or_else(|| roots_of_factors(std::slice::from_ref(factor))));
    }
    separate(&mut roots);
    roots
}

/// Returns the same if f64 settles where they are and that all but 0 are simple.
fn roots_by_floats<C: Ring>(
    coefficients: &[C],
    lead: impl Fn(&C) -> (f64, i64),
    integer: impl Fn(&C) -> Integer,
) -> Option<Vec<RealRoot>> {
    let zeros = zeros(coefficients);
    let rest = &coefficients[zeros..];
    if !(2..=short::HIGHEST + 1).contains(&rest.len()) {
        return None;
    }
    let integers = || rest.iter().map(&integer).collect::<Vec<Integer>>();
    let leads: Vec<(f64, i64)> = rest.iter().map(lead).collect();
    let places = short::isolate(&leads, zeros > 0, &integers)?;
    let negative = places.iter().take_while(|place| *place.start().0 < 0).count();
    let mut roots: Vec<RealRoot> = Vec::with_capacity(places.len() + 1);
    if !places.is_empty() {
        let polynomial = Arc::new(Univariate::new(integers()));
        roots.extend(places.into_iter().map(|place| RealRoot {
            polynomial: polynomial.clone(),
            multiplicity: 1,
            place,
        }));
    }
    if zeros > 0 {
        roots.insert(negative, zero(zeros));
    }
    Some(roots)
}

/// Returns the root 0.
fn zero(multiplicity: usize) -> RealRoot {
    RealRoot { polynomial: Arc::new(Univariate::x()), multiplicity, place: Place::At(Integer::new(), 0) }
}

/// Returns the distinct real roots of a product from left to right, as [`Univariate::real_roots`] does, if its square-free factors are known.
/// The factors are not zero, have no multiple roots and no roots in common; each has the multiplicity beside it.
#[must_use]
pub fn roots_of_factors(factors: &[(Univariate<Integer>, usize)]) -> Vec<RealRoot> {
    let mut roots = Vec::new();
    for (factor, multiplicity) in factors {
        let multiplicity = *multiplicity;
        let is_root = factor.coefficients().first().is_some_and(|c| *c == 0);
        if is_root {
            roots.push(zero(multiplicity));
        }
        let factor = Univariate::new(factor.coefficients()[usize::from(is_root)..].to_vec());
        if factor.degree() > Some(0) {
            let places = isolate(factor.coefficients().to_vec()).into_iter();
            let polynomial = Arc::new(factor);
            roots.extend(places.map(|place| RealRoot { polynomial: polynomial.clone(), multiplicity, place }));
        }
    }
    separate(&mut roots);
    roots
}

impl Univariate<Rational> {
    /// Returns the real roots, as for integer coefficients.
    ///
    /// # Panics
    /// When the polynomial is zero.
    #[must_use]
    pub fn real_roots(&self) -> Vec<RealRoot> {
        Univariate::new(self.primitive_integers()).real_roots()
    }
}
