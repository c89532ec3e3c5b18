//! Null spaces of matrices of polynomials over their field of fractions, without fractions.

use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};
use std::cmp::Ordering;

type Poly = Polynomial<Int>;

/// Returns a basis of the null space over the field of fractions: vectors of polynomials without common factor.
///
/// Every vector of the basis is multiplied by the matrix as a check.
///
/// # Panics
/// If a row has another length or, which error-free arithmetic excludes, if the product is not zero.
#[must_use]
pub fn null_space(rows: &[Vec<Poly>], columns: usize) -> Vec<Vec<Poly>> {
    let mut reduced: Vec<Vec<Poly>> = Vec::new();
    let mut pivots: Vec<usize> = Vec::new();
    let mut rest: Vec<Vec<Poly>> = rows.iter().map(|row| primitive(row)).collect();
    rest.retain(|row| row.iter().any(|entry| !entry.is_zero()));
    for column in 0..columns {
        let candidates = rest.iter().enumerate().filter(|(_, row)| !row[column].is_zero());
        let Some((chosen, _)) = candidates.min_by_key(|(_, row)| row.iter().map(Poly::len).sum::<usize>()) else {
            continue;
        };
        let pivot = rest.swap_remove(chosen);
        for row in reduced.iter_mut().chain(&mut rest) {
            if !row[column].is_zero() {
                let common = row[column].gcd(&pivot[column]);
                let (own, other) = (pivot[column].div_exact(&common), row[column].div_exact(&common));
                let combined: Vec<Poly> =
                    row.iter().zip(&pivot).map(|(x, y)| x.mul(&own).sub(&y.mul(&other))).collect();
                *row = primitive(&combined);
            }
        }
        rest.retain(|row| row.iter().any(|entry| !entry.is_zero()));
        reduced.push(pivot);
        pivots.push(column);
    }
    let free = (0..columns).filter(|column| !pivots.contains(column));
    let basis: Vec<Vec<Poly>> = free.map(|column| vector(&reduced, &pivots, column, columns)).collect();
    let product =
        |row: &[Poly], vector: &[Poly]| row.iter().zip(vector).fold(Poly::zero(), |sum, (x, y)| sum.add(&x.mul(y)));
    let vanishes = basis.iter().all(|vector| rows.iter().all(|row| product(row, vector).is_zero()));
    assert!(vanishes, "a basis of the null space is in the null space");
    basis
}

/// Returns the vector of the null space for a free column, from rows in reduced form with one pivot each.
fn vector(reduced: &[Vec<Poly>], pivots: &[usize], free: usize, columns: usize) -> Vec<Poly> {
    let mut common = Poly::one();
    for (row, &pivot) in reduced.iter().zip(pivots) {
        if !row[free].is_zero() {
            let own = row[pivot].div_exact(&row[pivot].gcd(&row[free]));
            common = common.mul(&own.div_exact(&own.gcd(&common)));
        }
    }
    let mut vector = vec![Poly::zero(); columns];
    for (row, &pivot) in reduced.iter().zip(pivots) {
        vector[pivot] = row[free].neg().mul(&common).div_exact(&row[pivot]);
    }
    vector[free] = common;
    primitive(&vector)
}

/// Divides a row by the common factor of its entries; the first nonzero one gets a positive leading coefficient.
#[must_use]
pub fn primitive(row: &[Poly]) -> Vec<Poly> {
    let mut common = Poly::zero();
    for entry in row {
        common = common.gcd(entry);
        if common == Poly::one() {
            break;
        }
    }
    let Some(first) = row.iter().find(|entry| !entry.is_zero()) else { return row.to_vec() };
    if first.coefficients()[0].sign() == Ordering::Less {
        common = common.neg();
    }
    row.iter().map(|entry| entry.div_exact(&common)).collect()
}

/// Returns the square root with positive leading coefficient; `None` if the polynomial is no square.
#[must_use]
pub fn square_root(square: &Poly) -> Option<Poly> {
    if square.is_zero() {
        return Some(Poly::zero());
    }
    let content = square.content().to_integer();
    if !content.is_perfect_square() {
        return None;
    }
    let mut root = Poly::constant(Int::from(content.sqrt()));
    for (factor, multiplicity) in square.square_free_decomposition() {
        let half = u32::try_from(multiplicity).ok().filter(|m| m % 2 == 0)? / 2;
        root = root.mul(&factor.pow(half));
    }
    // The sign of the leading coefficient is the sign of the square.
    (root.mul(&root) == *square).then_some(root)
}
