//! Polynomials as plain lists of terms.

use super::lattice::Lattice;
use crate::int::Int;
use crate::polynomial::Polynomial;
use crate::sort;
use rug::Integer;

/// A polynomial in several variables with integer coefficients, term by term, in any order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Terms {
    /// The exponents of all variables, term after term.
    pub exponents: Vec<u32>,
    /// One coefficient per term.
    pub coefficients: Vec<Integer>,
}

impl Terms {
    /// Returns the terms of a polynomial that has no more than the given number of variables.
    pub(crate) fn of(polynomial: &Polynomial<Int>, variables: usize) -> Self {
        let exponents = |term| (0..variables).map(move |variable| polynomial.exponent(term, variable));
        Self {
            exponents: (0..polynomial.len()).flat_map(exponents).collect(),
            coefficients: polynomial.coefficients().iter().map(Int::to_integer).collect(),
        }
    }

    /// Returns the polynomial with these terms.
    pub(crate) fn polynomial(self, variables: usize) -> Polynomial<Int> {
        let coefficients = self.coefficients.into_iter().map(Int::from).collect();
        Polynomial::from_lists(variables, &self.exponents, coefficients)
    }

    /// Returns the terms that are not zero, with their exponents.
    ///
    /// # Panics
    /// When the numbers of exponents and coefficients do not fit the number of variables.
    pub fn iter(&self, variables: usize) -> impl Iterator<Item = (&[u32], &Integer)> + Clone {
        assert_eq!(self.exponents.len(), self.coefficients.len() * variables, "one exponent per variable and term");
        let exponents = move |k| &self.exponents[k * variables..][..variables];
        self.coefficients.iter().enumerate().filter(|(_, c)| !c.is_zero()).map(move |(k, c)| (exponents(k), c))
    }
}

/// Terms of several polynomials in the order in which they are evaluated.
pub(super) struct Sorted<'a> {
    pub(super) slots: Vec<usize>,
    pub(super) exponents: Vec<u32>,
    pub(super) coefficients: Vec<&'a Integer>,
}

/// Sorts terms, each with the index of its polynomial and all its exponents, by the exponents of the parameters.
pub(super) fn descending<'a>(
    terms: impl Iterator<Item = (usize, &'a [u32], &'a Integer)>,
    parameters: &[usize],
) -> Sorted<'a> {
    let mut terms: Vec<_> = terms.collect();
    let key = |e: &'a [u32]| parameters.iter().map(move |&k| e[k]);
    sort::by(&mut terms, |(a, e, _), (b, f, _)| (b.cmp(a)).then_with(|| key(f).cmp(key(e))));
    let distinct = terms.windows(2).all(|t| t[0].0 != t[1].0 || t[0].1 != t[1].1);
    assert!(distinct, "no two terms of a polynomial have the same exponents");
    Sorted {
        slots: terms.iter().map(|t| t.0).collect(),
        exponents: terms.iter().flat_map(|t| key(t.1)).collect(),
        coefficients: terms.iter().map(|t| t.2).collect(),
    }
}

impl Lattice {
    /// Returns the polynomial with these coefficients, its parameters being those of the given variables.
    pub(super) fn terms(&self, coefficients: Vec<Integer>, variables: usize, parameters: &[usize]) -> Terms {
        let mut terms = Terms::default();
        for (k, c) in coefficients.into_iter().enumerate() {
            if c.is_zero() {
                continue;
            }
            let first = terms.exponents.len();
            terms.exponents.resize(first + variables, 0);
            for (&parameter, &e) in parameters.iter().zip(self.point(k)) {
                terms.exponents[first + parameter] = e;
            }
            terms.coefficients.push(c);
        }
        terms
    }
}
