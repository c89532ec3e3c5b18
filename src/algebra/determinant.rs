//! Exact determinants: of numbers, of polynomials without fractions, and of matrix polynomials by their values.

use super::modp::{Modulus, primes};
use super::rational::primitive_scale;
use super::ring::{Domain, Field, Ring};
use super::univariate::Univariate;
use rug::{Complete, Integer, Rational};

/// The determinant over a field, for square matrices of any storage; 0 only where a column has no nonzero pivot.
///
/// # Panics
/// When the matrix is not square.
#[must_use]
pub fn determinant<F: Field, Row: AsRef<[F]>>(a: &[Row]) -> F {
    let mut rows: Vec<Vec<F>> = copy_square(a);
    let mut determinant = F::one();
    for k in 0..rows.len() {
        let mut pivot = k;
        for i in k + 1..rows.len() {
            if rows[i][k].pivot_size() > rows[pivot][k].pivot_size() {
                pivot = i;
            }
        }
        let Some(inverse) = rows[pivot][k].inverse() else { return F::zero() };
        determinant = determinant.mul(&rows[pivot][k]);
        if pivot != k {
            rows.swap(pivot, k);
            determinant = determinant.neg();
        }
        let (above, below) = rows.split_at_mut(k + 1);
        for row in below {
            let multiplier = row[k].mul(&inverse);
            subtract_multiple(&mut row[k + 1..], &multiplier, &above[k][k + 1..]);
        }
    }
    determinant
}

/// The determinant without fractions, over any ring with exact division (Bareiss).
///
/// # Panics
/// When the matrix is not square.
///
/// # Source
/// Bareiss 1968, Mathematics of Computation 22, 565-578.
#[must_use]
pub fn bareiss<D: Domain, Row: AsRef<[D]>>(a: &[Row]) -> D {
    let mut rows: Vec<Vec<D>> = copy_square(a);
    let (mut previous, mut odd) = (D::one(), false);
    for k in 0..rows.len() {
        let Some(pivot) = (k..rows.len()).find(|&i| !rows[i][k].is_zero()) else { return D::zero() };
        rows.swap(pivot, k);
        odd ^= pivot != k;
        let (above, below) = rows.split_at_mut(k + 1);
        let pivot_row = &above[k];
        for row in below {
            for j in k + 1..row.len() {
                row[j] = pivot_row[k].mul(&row[j]).sub(&row[k].mul(&pivot_row[j])).div_exact(&previous);
            }
        }
        previous = pivot_row[k].clone();
    }
    if odd { previous.neg() } else { previous }
}

/// The rows on the heap, seen to be as long as they are many.
fn copy_square<F: Clone, Row: AsRef<[F]>>(a: &[Row]) -> Vec<Vec<F>> {
    let rows: Vec<Vec<F>> = a.iter().map(|row| row.as_ref().to_vec()).collect();
    assert!(rows.iter().all(|row| row.len() == a.len()), "a determinant is of a square matrix");
    rows
}

/// `det(A0 + A1 x + ... + Ad x^d)` from its values at as many points as its degree may need, over an exact field.
///
/// # Shape
/// `coefficients` holds A0 to Ad, square and of one size.
///
/// # Panics
/// When the shape is wrong, or the field has too few elements.
#[must_use]
pub fn by_interpolation<F, M, Row>(coefficients: &[M]) -> Univariate<F>
where
    F: Field + Domain,
    M: AsRef<[Row]>,
    Row: AsRef<[F]>,
{
    let matrix = MatrixPolynomial::new(coefficients, F::is_zero);
    let value = |k: usize| {
        let x = F::from_integer(i32::try_from(k).expect("the degree fits an i32"));
        let horner = |entry: &Vec<F>| entry.iter().rev().fold(F::zero(), |value, c| value.mul(&x).add(c));
        let rows: Vec<Vec<F>> = matrix.rows.iter().map(|row| row.iter().map(horner).collect()).collect();
        let determinant = determinant(&rows);
        (x, determinant)
    };
    Univariate::interpolate(&(0..=matrix.degree).map(value).collect::<Vec<_>>())
}

/// `det(A0 + A1 x + ... + Ad x^d)` over the rationals, from its images modulo many primes.
///
/// Exact and proved: with denominators and common factors of rows and columns taken out, the coefficients of the
/// determinant are integers of absolute value at most `prod_i sqrt(sum_j (sum_k |a_ijk|)^2)`, by Hadamard's inequality
/// on the unit circle, and the product of the primes used exceeds twice that.
///
/// # Shape
/// `coefficients` holds A0 to Ad, square and of one size.
///
/// # Panics
/// When the shape is wrong.
///
/// # Source
/// Goldstein, Graham 1974, A Hadamard-type bound on the coefficients of a determinant of polynomials, SIAM Review 16.
#[must_use]
pub fn modular<M, Row>(coefficients: &[M]) -> Univariate<Rational>
where
    M: AsRef<[Row]>,
    Row: AsRef<[Rational]>,
{
    let mut matrix = MatrixPolynomial::new(coefficients, Ring::is_zero);
    let scale = matrix.make_primitive();
    let matrix = matrix.map(|entry: &Rational| entry.numer().clone());
    let bound = matrix.bound();
    let mut residues = vec![Integer::new(); matrix.degree + 1];
    let mut product = Integer::from(1);
    for modulus in primes() {
        if product > (&bound * 2_u32).complete() {
            break;
        }
        let image = matrix.image(&modulus);
        let inverse = modulus.inverse(modulus.reduce(&product));
        for (residue, image) in residues.iter_mut().zip(image) {
            let digit = modulus.mul(modulus.sub(image, modulus.reduce(residue)), inverse);
            *residue += &product * Integer::from(modulus.leave(digit));
        }
        product *= modulus.prime();
    }
    let half = (&product / 2_u32).complete();
    let symmetric = |residue: Integer| if residue > half { residue - &product } else { residue };
    Univariate::new(residues.into_iter().map(|r| Rational::from(symmetric(r)) / &scale).collect())
}

/// A square matrix of polynomials: `rows[i][j][k]` is the coefficient of `x^k`.
struct MatrixPolynomial<R> {
    rows: Vec<Vec<Vec<R>>>,
    /// No smaller than the degree of the determinant.
    degree: usize,
}

impl<R: Clone> MatrixPolynomial<R> {
    fn new<M: AsRef<[Row]>, Row: AsRef<[R]>>(coefficients: &[M], is_zero: impl Fn(&R) -> bool) -> Self {
        let size = coefficients.first().map_or(0, |a| a.as_ref().len());
        let mut rows = vec![vec![Vec::new(); size]; size];
        for a in coefficients {
            assert_eq!(a.as_ref().len(), size, "the coefficients are of one size");
            for (row, given) in rows.iter_mut().zip(a.as_ref()) {
                assert_eq!(given.as_ref().len(), size, "a determinant is of a square matrix");
                for (entry, c) in row.iter_mut().zip(given.as_ref()) {
                    entry.push(c.clone());
                }
            }
        }
        // No row or column contributes more than the highest degree in it.
        let degree = |entry: &Vec<R>| entry.iter().rposition(|c| !is_zero(c)).unwrap_or(0);
        let by_rows = rows.iter().map(|row| row.iter().map(degree).max().unwrap_or(0)).sum();
        let by_columns = (0..size).map(|j| rows.iter().map(|row| degree(&row[j])).max().unwrap_or(0)).sum();
        Self { rows, degree: usize::min(by_rows, by_columns) }
    }

    fn map<S>(&self, image: impl Fn(&R) -> S) -> MatrixPolynomial<S> {
        let entry = |entry: &Vec<R>| entry.iter().map(&image).collect();
        MatrixPolynomial {
            rows: self.rows.iter().map(|row| row.iter().map(entry).collect()).collect(),
            degree: self.degree,
        }
    }
}

impl MatrixPolynomial<Rational> {
    /// Makes rows and then columns primitive integers; returns the factor by which that multiplied the determinant.
    fn make_primitive(&mut self) -> Rational {
        let mut total = Rational::from(1);
        for row in &mut self.rows {
            let scale = primitive_scale(&row.concat());
            for c in row.iter_mut().flatten() {
                *c *= &scale;
            }
            total *= scale;
        }
        for j in 0..self.rows.len() {
            let column: Vec<Rational> = self.rows.iter().flat_map(|row| row[j].iter().cloned()).collect();
            let scale = primitive_scale(&column);
            for c in self.rows.iter_mut().flat_map(|row| row[j].iter_mut()) {
                *c *= &scale;
            }
            total *= scale;
        }
        total
    }
}

impl MatrixPolynomial<Integer> {
    /// A bound on the absolute values of the coefficients of the determinant, rounded up.
    fn bound(&self) -> Integer {
        let norm = |entry: &Vec<Integer>| entry.iter().map(|c| c.clone().abs()).sum::<Integer>().square();
        let by_rows: Integer = self.rows.iter().map(|row| row.iter().map(norm).sum::<Integer>()).product();
        let column = |j: usize| self.rows.iter().map(|row| norm(&row[j])).sum::<Integer>();
        let by_columns: Integer = (0..self.rows.len()).map(column).product();
        by_rows.min(by_columns).sqrt() + 1_u32
    }

    /// The coefficients of the determinant modulo a prime (in Montgomery form).
    fn image(&self, modulus: &Modulus) -> Vec<u64> {
        let rows = self.map(|c| modulus.reduce(c)).rows;
        let mut work: Vec<Vec<u64>> = vec![vec![0; rows.len()]; rows.len()];
        let value = |k: usize| {
            let x = modulus.enter(k as u64);
            for (row, entries) in work.iter_mut().zip(&rows) {
                for (value, entry) in row.iter_mut().zip(entries) {
                    *value = entry.iter().rev().fold(0, |value, &c| modulus.add(modulus.mul(value, x), c));
                }
            }
            determinant_modulo(modulus, &mut work)
        };
        interpolate_modulo(modulus, (0..=self.degree).map(value).collect())
    }
}

/// The determinant modulo a prime, with one inversion: rows are multiplied by the pivots, and that divided out at last.
fn determinant_modulo(modulus: &Modulus, rows: &mut [Vec<u64>]) -> u64 {
    let one = modulus.enter(1);
    let (mut numerator, mut denominator, mut power) = (one, one, one);
    for k in 0..rows.len() {
        let Some(found) = (k..rows.len()).find(|&i| rows[i][k] != 0) else { return 0 };
        if found != k {
            rows.swap(found, k);
            numerator = modulus.sub(0, numerator);
        }
        let (above, below) = rows.split_at_mut(k + 1);
        let pivot_row = &above[k][k..];
        // Every earlier pivot has multiplied this row once, so the diagonal is too large by their product.
        numerator = modulus.mul(numerator, pivot_row[0]);
        denominator = modulus.mul(denominator, power);
        power = modulus.mul(power, pivot_row[0]);
        for row in below {
            let first = row[k];
            for (x, &y) in row[k..].iter_mut().zip(pivot_row) {
                *x = modulus.sub(modulus.mul(*x, pivot_row[0]), modulus.mul(first, y));
            }
        }
    }
    modulus.mul(numerator, modulus.inverse(denominator))
}

/// The polynomial with the given values at 0, 1, 2, ... modulo a prime.
fn interpolate_modulo(modulus: &Modulus, mut values: Vec<u64>) -> Vec<u64> {
    for order in 1..values.len() {
        let inverse = modulus.inverse(modulus.enter(order as u64));
        for i in (order..values.len()).rev() {
            values[i] = modulus.mul(modulus.sub(values[i], values[i - 1]), inverse);
        }
    }
    // From Newton's form to powers of x: Horner's rule with (x - k), in place from the top.
    for k in (0..values.len().saturating_sub(1)).rev() {
        let node = modulus.enter(k as u64);
        for i in k..values.len() - 1 {
            values[i] = modulus.sub(values[i], modulus.mul(node, values[i + 1]));
        }
    }
    values
}

/// `row -= multiplier * other`
fn subtract_multiple<F: Ring>(row: &mut [F], multiplier: &F, other: &[F]) {
    for (x, y) in row.iter_mut().zip(other) {
        *x = x.sub(&multiplier.mul(y));
    }
}
