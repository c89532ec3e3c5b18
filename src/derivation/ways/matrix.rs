//! Matrices of polynomials in the unknown that is kept, and their determinants.

use crate::algebra::determinant::modular;
use crate::algebra::echelon::Echelon;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::derivation::chain::Mod;
use rug::Rational;

/// A matrix of polynomials in one variable, by its powers: `[power][row][column]`.
pub(super) struct PolynomialMatrix {
    pub powers: Vec<Vec<Vec<Rational>>>,
}

impl PolynomialMatrix {
    /// Creates the matrix of these entries, polynomials in one variable.
    pub fn of(rows: &[Vec<Univariate<Rational>>]) -> Self {
        let degree = rows.iter().flatten().filter_map(Univariate::degree).max().unwrap_or(0);
        let entry = |p: &Univariate<Rational>, power: usize| p.coefficients().get(power).cloned().unwrap_or_default();
        let power = |power: usize| rows.iter().map(|row| row.iter().map(|p| entry(p, power)).collect()).collect();
        Self { powers: (0..=degree).map(power).collect() }
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.powers.first().map_or(0, Vec::len)
    }

    /// Returns the number of columns.
    pub fn columns(&self) -> usize {
        self.powers.first().and_then(|m| m.first()).map_or(0, Vec::len)
    }

    /// Returns the degree of its entries.
    pub fn degree(&self) -> usize {
        self.powers.len().saturating_sub(1)
    }

    /// Returns combinations of its rows, as many as it has columns, with small generic integer weights.
    pub fn mixed(&self, seed: i32) -> Self {
        let (rows, columns) = (self.rows(), self.columns());
        let weight = |i: usize, k: usize| {
            let (i, k) = (i32::try_from(i).unwrap_or(0), i32::try_from(k).unwrap_or(0));
            Rational::from((seed * (i + 2) * (2 * i + 3 * k + 1) * (k + 5)).rem_euclid(13) - 6)
        };
        let mixed = |m: &Vec<Vec<Rational>>| {
            let entry = |i: usize, j: usize| {
                // The first rows are kept, with some of the others added.
                let others = (columns..rows).map(|k| &m[k][j] * weight(i, k));
                others.fold(m[i][j].clone(), |sum, term| sum + term)
            };
            (0..columns).map(|i| (0..columns).map(|j| entry(i, j)).collect()).collect()
        };
        Self { powers: self.powers.iter().map(mixed).collect() }
    }

    /// Returns the matrix of a maximal set of columns that are independent for a generic value of the variable, the first or
    /// the last ones. If the rank is smaller than the number of columns, all minors vanish.
    pub fn independent(&self, is_last: bool) -> Option<Self> {
        // Any element of the field that is unlikely to be special.
        let x = Mod::from_integer(7_654_321);
        let entry = |i: usize, j: usize| {
            self.powers
                .iter()
                .rev()
                .try_fold(Mod::zero(), |value, m| Some(value.mul(&x).add(&Mod::from_rational(&m[i][j])?)))
        };
        let column = |j: usize| (0..self.rows()).map(|i| entry(i, j)).collect::<Option<Vec<Mod>>>();
        let mut order: Vec<usize> = (0..self.columns()).collect();
        if is_last {
            order.reverse();
        }
        let (mut kept, mut known): (Vec<usize>, Vec<Vec<Mod>>) = (Vec::new(), Vec::new());
        for j in order {
            known.push(column(j)?);
            if Echelon::of(known.clone(), self.rows()).rank() == known.len() {
                kept.push(j);
            } else {
                known.pop();
            }
        }
        kept.sort_unstable();
        let of = |m: &Vec<Vec<Rational>>| m.iter().map(|row| kept.iter().map(|j| row[*j].clone()).collect()).collect();
        Some(Self { powers: self.powers.iter().map(of).collect() })
    }

    /// Its determinant.
    pub fn determinant(&self) -> Univariate<Rational> {
        modular(&self.powers)
    }
}

/// Returns the Sylvester matrix of two polynomials in a variable, of polynomials in another one.
pub(super) fn sylvester(
    f: &Polynomial<Rational>,
    g: &Polynomial<Rational>,
    variable: usize,
    kept: usize,
) -> Option<Vec<Vec<Univariate<Rational>>>> {
    let coefficients = |p: &Polynomial<Rational>| -> Option<Vec<Univariate<Rational>>> {
        p.coefficients_in(variable).iter().map(|c| c.to_univariate(kept)).collect()
    };
    let (f, g) = (coefficients(f)?, coefficients(g)?);
    let (m, n) = (f.len() - 1, g.len() - 1);
    let size = m + n;
    let shifted = |p: &[Univariate<Rational>], by: usize| {
        let entry = |j: usize| j.checked_sub(by).and_then(|j| p.get(j)).cloned().unwrap_or_else(Univariate::zero);
        (0..size).map(entry).collect::<Vec<_>>()
    };
    Some((0..n).map(|k| shifted(&f, k)).chain((0..m).map(|k| shifted(&g, k))).collect())
}
