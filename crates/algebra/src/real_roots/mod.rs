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
    /// Square-free; the root is a root of it.
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
        let zeros = self.coefficients().iter().take_while(|c| **c == 0).count();
        let rest = Univariate::new(self.coefficients()[zeros..].to_vec());
        let mut factors = rest.square_free_decomposition();
        if zeros > 0 {
            factors.insert(0, (Univariate::x(), zeros));
        }
        roots_of_factors(&factors)
    }
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
            let polynomial = Arc::new(Univariate::x());
            roots.push(RealRoot { polynomial, multiplicity, place: Place::At(Integer::new(), 0) });
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
