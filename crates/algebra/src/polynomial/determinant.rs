//! Determinants of matrices of polynomials with integer coefficients: the choice of the route.

use super::{Polynomial, short};
use crate::determinant::{bareiss, of_polynomials};
use crate::int::Int;
use crate::minors::{Expansion, Price, cells};
use crate::modular::{self, Terms};
use crate::ring::Ring;
use crate::triangular::blocks;
use crate::univariate::Univariate;

impl Polynomial<Int> {
    /// Returns the determinant of a square matrix of polynomials.
    ///
    /// Sparse matrices are split into the blocks of their triangular form. A block is computed from values modulo primes if
    /// there is at most one variable, and else by minors or from values, whichever is predicted to cost less; without
    /// fractions if there are too many symbols for either.
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
        if let Some(determinant) = short::determinant(rows) {
            return determinant;
        }
        let all: Vec<&[Self]> = rows.iter().map(Vec::as_slice).collect();
        if size > Expansion::MOST_COLUMNS {
            return Matrix { rows: all, pattern: None }.determinant();
        }
        let entries = |row: &&[Self]| {
            let present = row.iter().enumerate().filter(|(_, entry)| !entry.is_zero());
            present.fold(0, |set, (column, _)| set | 1_u64 << column)
        };
        let pattern: Vec<u64> = all.iter().map(entries).collect();
        let Some((blocks, odd)) = blocks(&pattern) else { return Self::zero() };
        if blocks.len() == 1 {
            return Matrix { rows: all, pattern: Some(pattern) }.determinant();
        }
        let determinant = blocks.iter().fold(Self::one(), |product, block| {
            if let ([row], [column]) = (block.rows.as_slice(), block.columns.as_slice()) {
                return product.mul(&rows[*row][*column]);
            }
            let part = |&row: &usize| block.columns.iter().map(|&column| rows[row][column].clone()).collect();
            product.mul(&Self::determinant(&block.rows.iter().map(part).collect::<Vec<Vec<Self>>>()))
        });
        if odd { determinant.neg() } else { determinant }
    }
}

/// A square matrix that is no longer to be split.
struct Matrix<'a> {
    rows: Vec<&'a [Polynomial<Int>]>,
    /// The columns of each row that are not zero, if there are not too many.
    pattern: Option<Vec<u64>>,
}

impl Matrix<'_> {
    fn entries(&self) -> impl Iterator<Item = &Polynomial<Int>> + Clone {
        self.rows.iter().copied().flatten()
    }

    fn determinant(&self) -> Polynomial<Int> {
        let variables = self.entries().map(Polynomial::variables).max().unwrap_or(0);
        let occurs = |&variable: &usize| self.entries().any(|entry| entry.degree(variable) > 0);
        let used: Vec<usize> = (0..variables).filter(occurs).collect();
        if used.len() < 2 {
            return self.univariate(used.first().copied().unwrap_or(0));
        }
        let degrees = Degrees::of(self, &used);
        let by_values = degrees.cost_by_values(self);
        if let Some(expansion) = self.expansion(&degrees, by_values.unwrap_or(f64::INFINITY)) {
            return expansion.determinant(&self.rows);
        }
        let values = by_values.and_then(|_| {
            let terms = |entry: &Polynomial<Int>| Terms::of(entry, variables);
            let matrix: Vec<Vec<Terms>> = self.rows.iter().map(|row| row.iter().map(terms).collect()).collect();
            modular::determinant(&matrix, variables)
        });
        values.map_or_else(|| bareiss(&self.rows), |terms| terms.polynomial(variables))
    }

    /// From the coefficients of one variable.
    fn univariate(&self, variable: usize) -> Polynomial<Int> {
        let coefficients = |entry: &Polynomial<Int>| {
            let mut coefficients = vec![Int::zero(); entry.degree(variable) as usize + 1];
            for (term, c) in entry.coefficients().iter().enumerate() {
                coefficients[entry.exponent(term, variable) as usize] = c.clone();
            }
            coefficients
        };
        let determinant = of_polynomials(self.rows.len(), self.entries().map(coefficients).collect());
        Polynomial::from_univariate(variable, &Univariate::new(determinant))
    }

    /// Returns the plan for an expansion by minors, if it is predicted to cost less than the limit.
    fn expansion(&self, degrees: &Degrees, limit: f64) -> Option<Expansion> {
        let pattern = self.pattern.as_ref()?;
        let price = |rows: &[usize], factors: &[(usize, f64)]| {
            let Some(&row) = rows.last() else { return (0.0, 0.0) };
            let mut price = Price::default();
            for &(column, size) in factors {
                price.add(self.rows[row][column].len() as f64, size);
            }
            price.total(degrees.cells(rows))
        };
        Expansion::plan(pattern, limit, price).map(|(expansion, _)| expansion)
    }
}

/// The highest degrees in each row and in each column: by variable, then the total ones.
struct Degrees {
    rows: Vec<Vec<usize>>,
    columns: Vec<Vec<usize>>,
}

impl Degrees {
    fn of(matrix: &Matrix, used: &[usize]) -> Self {
        let size = matrix.rows.len();
        let zero = || vec![vec![0; used.len() + 1]; size];
        let mut degrees = Self { rows: zero(), columns: zero() };
        for (i, row) in matrix.rows.iter().enumerate() {
            for (j, entry) in row.iter().enumerate().filter(|(_, entry)| !entry.is_zero()) {
                let own = used.iter().map(|&variable| entry.degree(variable) as usize);
                let total = usize::try_from(entry.total_degree().unwrap_or(0)).unwrap_or(usize::MAX);
                for (k, degree) in own.chain([total]).enumerate() {
                    let (row, column) = (&mut degrees.rows[i][k], &mut degrees.columns[j][k]);
                    (*row, *column) = (degree.max(*row), degree.max(*column));
                }
            }
        }
        degrees
    }

    /// Returns about how many monomials a minor of these rows may have.
    fn cells(&self, rows: &[usize]) -> f64 {
        let sum = |k: usize| rows.iter().map(|&row| self.rows[row][k] as f64).sum::<f64>();
        let variables = self.rows[0].len() - 1;
        cells((0..variables).map(sum), sum(variables))
    }

    /// Returns what the determinant from values is predicted to cost, in nanoseconds; `None` where it takes too much memory.
    fn cost_by_values(&self, matrix: &Matrix) -> Option<f64> {
        let bound = |k: usize| {
            let sum = |lines: &[Vec<usize>]| lines.iter().map(|line| line[k]).fold(0, usize::saturating_add);
            sum(&self.rows).min(sum(&self.columns))
        };
        let variables = self.rows[0].len() - 1;
        let degrees: Vec<usize> = (0..variables).map(bound).collect();
        let norm = |entry: &Polynomial<Int>| entry.coefficients().iter().map(|c| c.to_f64().abs()).sum::<f64>();
        let bits: f64 =
            matrix.rows.iter().map(|row| row.iter().map(|entry| norm(entry).powi(2)).sum::<f64>().log2() / 2.0).sum();
        let terms = matrix.entries().map(Polynomial::len).sum();
        modular::determinant_cost(matrix.rows.len(), &degrees, bound(variables), bits, terms)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type Poly = Polynomial<Int>;

    /// Square matrices most of whose entries are zero, or none.
    fn matrices(size: usize, variables: usize, zeros: u32) -> impl Strategy<Value = Vec<Vec<Poly>>> {
        let term = (prop::collection::vec(0..=3_u32, variables), -9_i64..=9);
        let terms = prop::collection::vec(term, 1..=3);
        let entry = (0..10_u32, terms).prop_map(move |(kind, terms)| {
            let terms = terms.into_iter().map(|(e, c)| (e, Int::from(c)));
            if kind < zeros { Poly::zero() } else { Poly::from_terms(terms) }
        });
        prop::collection::vec(prop::collection::vec(entry, size), size)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]

        #[test]
        fn every_route_to_a_sparse_determinant_agrees(
            rows in (1..7_usize, 2..4_usize, 0..9_u32).prop_flat_map(|(n, v, zeros)| matrices(n, v, zeros)),
        ) {
            let expected = bareiss(&rows);
            prop_assert_eq!(&Poly::determinant(&rows), &expected);
            let matrix = Matrix { rows: rows.iter().map(Vec::as_slice).collect(), pattern: None };
            let terms = |entry: &Poly| Terms::of(entry, 3);
            let entries: Vec<Vec<Terms>> = rows.iter().map(|row| row.iter().map(terms).collect()).collect();
            prop_assert_eq!(modular::determinant(&entries, 3).unwrap().polynomial(3), expected.clone());
            // By minors, split or not.
            let filled = |row: &Vec<Poly>| (0..row.len()).fold(0, |set, c| set | 1_u64 << c);
            let pattern = Some(rows.iter().map(filled).collect());
            let matrix = Matrix { pattern, ..matrix };
            let degrees = Degrees::of(&matrix, &[0, 1, 2]);
            let expansion = matrix.expansion(&degrees, f64::INFINITY).unwrap();
            prop_assert_eq!(expansion.determinant(&matrix.rows), expected);
        }
    }
}
