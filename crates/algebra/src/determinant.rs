//! Exact determinants: of numbers, of polynomials without fractions, and of matrix polynomials by their values.

use super::int::Int;
use super::modular::{degree_bound, univariate_determinant};
use super::ring::{Domain, Field, Ring};
use super::univariate::Univariate;
use rug::{Integer, Rational};
use std::ops::Range;

/// Returns the determinant over a field, for square matrices of any storage; 0 only if a column has no nonzero pivot.
///
/// # Panics
/// If the matrix is not square.
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

/// Returns the determinant without fractions, over any ring with exact division (Bareiss).
///
/// # Panics
/// If the matrix is not square.
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

/// Copies the rows, checking that the matrix is square.
fn copy_square<F: Clone, Row: AsRef<[F]>>(a: &[Row]) -> Vec<Vec<F>> {
    let rows: Vec<Vec<F>> = a.iter().map(|row| row.as_ref().to_vec()).collect();
    assert!(rows.iter().all(|row| row.len() == a.len()), "a determinant is of a square matrix");
    rows
}

/// Returns `det(A0 + A1 x + ... + Ad x^d)` from its values at as many points as its degree may need, over an exact field.
///
/// # Example
/// ```
/// use looproot_algebra::{determinant::by_interpolation, univariate::Univariate};
/// use rug::Rational;
///
/// // The characteristic polynomial of [[2, 1], [1, 2]], as det(-A + 1 x).
/// let matrix = |rows: [[i32; 2]; 2]| rows.map(|row| row.map(Rational::from));
/// let found = by_interpolation(&[matrix([[-2, -1], [-1, -2]]), matrix([[1, 0], [0, 1]])]);
/// assert_eq!(found, Univariate::new([3, -4, 1].map(Rational::from).to_vec()));
/// ```
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
    let (size, entries) = entries(coefficients);
    let degrees: Vec<usize> =
        entries.iter().map(|entry| entry.iter().rposition(|c| !c.is_zero()).unwrap_or(0)).collect();
    let value = |k: usize| {
        let x = F::from_integer(i32::try_from(k).expect("the degree fits an i32"));
        let horner = |entry: &Vec<&F>| entry.iter().rev().fold(F::zero(), |value, c| value.mul(&x).add(c));
        let values: Vec<F> = entries.iter().map(horner).collect();
        let rows: Vec<&[F]> = values.chunks_exact(size.max(1)).collect();
        let determinant = determinant(&rows);
        (x, determinant)
    };
    Univariate::interpolate(&(0..=degree_bound(size, &degrees)).map(value).collect::<Vec<_>>())
}

/// Returns `det(A0 + A1 x + ... + Ad x^d)` over the rationals, from its images modulo many primes.
///
/// Exact and proved: with denominators and common factors of rows and columns taken out, the coefficients of the
/// determinant are integers of absolute value at most `prod_i sqrt(sum_j (sum_k |a_ijk|)^2)`, by Hadamard's inequality
/// on the unit circle, and the product of the primes used exceeds four times that.
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
    let (size, entries) = entries(coefficients);
    let (entries, denominator) = without_denominators(size, &entries);
    let determinant = of_polynomials(size, entries);
    let quotient = |c: Int| Rational::from((c.to_integer(), denominator.clone()));
    Univariate::new(determinant.into_iter().map(quotient).collect())
}

/// Returns the coefficients of the determinant of a matrix of polynomials in one variable, constant terms first, the entries row
/// by row; zeros may stand at the end. It is as exact and as proved as [`modular`].
///
/// # Panics
/// When the number of entries is not the square of the size.
#[must_use]
pub fn of_polynomials(size: usize, mut entries: Vec<Vec<Int>>) -> Vec<Int> {
    assert_eq!(entries.len(), size * size, "a determinant is of a square matrix");
    let mut content = Int::one();
    for i in 0..size {
        content = content.mul(&remove_content(&mut entries, i * size..(i + 1) * size, 1));
    }
    for j in 0..size {
        content = content.mul(&remove_content(&mut entries, j..size * size, size));
    }
    let determinant = univariate_determinant(size, &entries);
    if content == Int::one() {
        return determinant;
    }
    determinant.iter().map(|c| c.mul(&content)).collect()
}

/// Returns the size of the matrices, and row by row the entries of the matrix polynomial, each by its coefficients.
fn entries<'a, M: AsRef<[Row]>, Row: AsRef<[R]> + 'a, R>(coefficients: &'a [M]) -> (usize, Vec<Vec<&'a R>>) {
    let size = coefficients.first().map_or(0, |a| a.as_ref().len());
    let mut entries: Vec<Vec<&R>> = (0..size * size).map(|_| Vec::with_capacity(coefficients.len())).collect();
    for a in coefficients {
        assert_eq!(a.as_ref().len(), size, "the coefficients are of one size");
        for (i, row) in a.as_ref().iter().enumerate() {
            assert_eq!(row.as_ref().len(), size, "a determinant is of a square matrix");
            for (entry, c) in entries[i * size..].iter_mut().zip(row.as_ref()) {
                entry.push(c);
            }
        }
    }
    (size, entries)
}

/// Returns the entries with integers for coefficients, and the denominator by which the determinant was thereby multiplied.
fn without_denominators(size: usize, entries: &[Vec<&Rational>]) -> (Vec<Vec<Int>>, Integer) {
    let mut denominator = Integer::from(1);
    let mut integers: Vec<Vec<Int>> = Vec::with_capacity(entries.len());
    for row in entries.chunks_exact(size.max(1)) {
        let mut common = Integer::from(1);
        for q in row.iter().flatten() {
            if !common.is_divisible(q.denom()) {
                common.lcm_mut(q.denom());
            }
        }
        let scaled = |q: &&Rational| match (q.numer().to_i64(), common == *q.denom()) {
            (Some(numerator), true) => Int::from(numerator),
            _ => Int::from(Integer::from(common.div_exact_ref(q.denom())) * q.numer()),
        };
        integers.extend(row.iter().map(|entry| entry.iter().map(scaled).collect()));
        denominator *= common;
    }
    (integers, denominator)
}

/// Divides entries by the greatest common divisor of their coefficients, and returns it, or 1 if all are zero.
fn remove_content(entries: &mut [Vec<Int>], range: Range<usize>, step: usize) -> Int {
    let (mut content, one) = (Int::zero(), Int::one());
    for c in entries[range.clone()].iter().step_by(step).flatten() {
        content = content.gcd(c);
        if content == one {
            return content;
        }
    }
    if content.is_zero() {
        return one;
    }
    for c in entries[range].iter_mut().step_by(step).flatten() {
        *c = c.div_exact(&content);
    }
    content
}

/// `row -= multiplier * other`
fn subtract_multiple<F: Ring>(row: &mut [F], multiplier: &F, other: &[F]) {
    for (x, y) in row.iter_mut().zip(other) {
        *x = x.sub(&multiplier.mul(y));
    }
}
