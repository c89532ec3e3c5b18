//! Determinants of matrices of polynomials with integer coefficients: the choice of the route.

use super::Polynomial;
use crate::determinant::of_entries;
use crate::int::Int;
use crate::minors;
use crate::modular::{self, Terms};
use crate::univariate::Univariate;

impl Polynomial<Int> {
    /// Returns the determinant of a square matrix of polynomials.
    ///
    /// It is computed from values modulo primes if there is at most one variable, or a few in polynomials that are not small;
    /// by minors or without fractions if there are many symbols.
    ///
    /// # Panics
    /// If the matrix is not square, or an exponent becomes larger than
    /// [`LARGEST_EXPONENT`](crate::monomial::LARGEST_EXPONENT).
    ///
    /// # Example
    /// ```
    /// use looproot_algebra::{int::Int, polynomial::Polynomial, ring::Ring};
    ///
    /// let (x, y) = (Polynomial::<Int>::variable(0), Polynomial::variable(1));
    /// let determinant = Polynomial::determinant(&[vec![x.clone(), y.clone()], vec![y.clone(), x.clone()]]);
    /// assert_eq!(determinant, x.pow(2).sub(&y.pow(2)));
    /// ```
    #[must_use]
    pub fn determinant(rows: &[Vec<Self>]) -> Self {
        let size = rows.len();
        assert!(rows.iter().all(|row| row.len() == size), "a determinant is of a square matrix");
        let entries = || rows.iter().flatten();
        let variables = entries().map(Self::variables).max().unwrap_or(0);
        let used: Vec<usize> = (0..variables).filter(|&v| entries().any(|entry| entry.degree(v) > 0)).collect();
        let terms: usize = entries().map(Self::len).sum();
        match used.as_slice() {
            [] | [_] => {
                let variable = used.first().copied().unwrap_or(0);
                let coefficients = |entry: &Self| {
                    let mut coefficients = vec![rug::Integer::new(); entry.degree(variable) as usize + 1];
                    for (term, c) in entry.coefficients().iter().enumerate() {
                        coefficients[entry.exponent(term, variable) as usize] = c.to_integer();
                    }
                    coefficients
                };
                let determinant = of_entries(size, entries().map(coefficients).collect());
                let image = determinant.into_iter().map(Int::from).collect();
                Self::from_univariate(variable, &Univariate::new(image))
            }
            [_, _] | [_, _, _] if size >= 4 && terms > 2 * size * size => {
                let terms = |entry: &Self| Terms::of(entry, variables);
                let matrix: Vec<Vec<Terms>> = rows.iter().map(|row| row.iter().map(terms).collect()).collect();
                let determinant = modular::determinant(&matrix, variables).map(|terms| terms.polynomial(variables));
                determinant.unwrap_or_else(|| minors::determinant(rows))
            }
            _ => minors::determinant(rows),
        }
    }
}
