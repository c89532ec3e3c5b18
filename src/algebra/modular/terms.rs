//! Polynomials as plain lists of terms.

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
    /// The terms that are not zero, with their exponents.
    ///
    /// # Panics
    /// When the numbers of exponents and coefficients do not fit the number of variables.
    pub fn iter(&self, variables: usize) -> impl Iterator<Item = (&[u32], &Integer)> + Clone {
        assert_eq!(self.exponents.len(), self.coefficients.len() * variables, "one exponent per variable and term");
        let exponents = move |k| &self.exponents[k * variables..][..variables];
        self.coefficients.iter().enumerate().filter(|(_, c)| !c.is_zero()).map(move |(k, c)| (exponents(k), c))
    }
}
