//! The multiplicity of an isolated position: the dimension of its local ring, order by order.

use crate::algebra::echelon::Echelon;
use crate::algebra::ring::Field;
use crate::exact::linkage::{Position, equations};
use std::collections::HashMap;

/// Orders are looked at that have no more monomials, and hence columns, than this: 5 for four variables, 4 for five and 3 for
/// six.
const MOST_MONOMIALS: usize = 126;

/// The multiplicity of a position with several infinitesimal motions, if it is isolated and low orders show that.
///
/// The closure equations f are polynomials of degree 1 in every joint variable. Modulo the order d + 1, the ideal is spanned by
/// the products of f with monomials, and if the quotients of orders d - 1 and d are of one dimension, this is the multiplicity.
///
/// # Source
/// docs/mobility.md, theorem 7.
pub(super) fn multiplicity<F: Field>(position: &Position<F>) -> Option<usize> {
    let n = position.joints();
    if monomials(n, 2).len() > MOST_MONOMIALS {
        return None;
    }
    let products: Vec<[F; 6]> = (0..1_usize << n).map(|mask| equations(&position.with_units(mask))).collect();
    let mut last = 1;
    for order in 1.. {
        let monomials = monomials(n, order);
        if monomials.len() > MOST_MONOMIALS {
            break;
        }
        let place: HashMap<&[usize], usize> = monomials.iter().map(Vec::as_slice).zip(0..).collect();
        let factors = monomials.iter().filter(|m| m.iter().sum::<usize>() < order);
        let mut rows = Vec::new();
        for factor in factors {
            for i in 0..6 {
                let mut row = vec![F::zero(); monomials.len()];
                for (mask, product) in products.iter().enumerate().skip(1) {
                    let exponents: Vec<usize> = (0..n).map(|k| factor[k] + (mask >> k & 1)).collect();
                    if let Some(column) = place.get(exponents.as_slice()) {
                        row[*column] = product[i].clone();
                    }
                }
                rows.push(row);
            }
        }
        let dimension = monomials.len() - Echelon::of(rows, monomials.len()).rank();
        if dimension == last {
            return Some(dimension);
        }
        last = dimension;
    }
    None
}

/// The exponents of all monomials in n variables up to a degree.
fn monomials(n: usize, degree: usize) -> Vec<Vec<usize>> {
    if n == 0 {
        return vec![Vec::new()];
    }
    let with = |last: usize| {
        monomials(n - 1, degree - last).into_iter().map(move |mut exponents| {
            exponents.push(last);
            exponents
        })
    };
    (0..=degree).flat_map(with).collect()
}
