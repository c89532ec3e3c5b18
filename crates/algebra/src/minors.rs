//! Determinants of small matrices by their minors: no division, so that symbols stay in as few terms as they can.

use crate::determinant::bareiss;
use crate::polynomial::Polynomial;
use crate::ring::{Domain, Ring};

/// Returns the determinant of a matrix of polynomials: by minors if it is small, or not large and with symbols in it, else
/// without fractions.
pub(super) fn determinant<D: Domain>(rows: &[Vec<Polynomial<D>>]) -> Polynomial<D> {
    let most = if parameters(rows.iter().flatten()) <= 2 { 4 } else { 8 };
    match rows.split_first() {
        Some((top, rest)) if rest.len() < most => expand(top, &maximal_minors(rest, top.len())),
        _ => bareiss(rows),
    }
}

/// Returns the number of variables that occur.
pub(super) fn parameters<'a, R: Ring + 'a>(polynomials: impl Iterator<Item = &'a Polynomial<R>>) -> usize {
    let mut occurs: Vec<bool> = Vec::new();
    for polynomial in polynomials {
        occurs.resize(occurs.len().max(polynomial.variables()), false);
        for (occurs, degree) in occurs.iter_mut().zip(polynomial.degrees()) {
            *occurs |= degree > 0;
        }
    }
    occurs.into_iter().filter(|&occurs| occurs).count()
}

/// Returns the maximal minors of a matrix with one row less than columns: entry c is the minor without column c.
///
/// Expands along the rows, from the last one up, and keeps the minor of every set of columns: `m 2^(m-1)` products.
///
/// # Panics
/// When there are more than 20 columns, or the shape is wrong.
pub(super) fn maximal_minors<R: Ring>(rows: &[Vec<R>], columns: usize) -> Vec<R> {
    assert!(columns <= 20, "expansion by minors is for small matrices");
    assert!(rows.len() + 1 == columns && rows.iter().all(|row| row.len() == columns), "one row less than columns");
    let mut minors = vec![None; 1 << columns];
    minors[0] = Some(R::one());
    for (done, row) in rows.iter().rev().enumerate() {
        let mut next = vec![None; 1 << columns];
        for set in (0..1_usize << columns).filter(|set| set.count_ones() as usize == done + 1) {
            next[set] = expansion(row, set, |c| minors[set & !(1 << c)].as_ref());
        }
        minors = next;
    }
    let all = (1 << columns) - 1;
    (0..columns).map(|c| minors[all & !(1 << c)].take().unwrap_or_else(R::zero)).collect()
}

/// Returns the determinant with one more row on top, from the maximal minors below it.
pub(super) fn expand<R: Ring>(top: &[R], minors: &[R]) -> R {
    let set = (1 << top.len()) - 1;
    expansion(top, set, |c| Some(&minors[c]).filter(|minor| !minor.is_zero())).unwrap_or_else(R::zero)
}

/// Returns the alternating sum of the entries in the columns of a set times the minors without these; `None` for zero.
fn expansion<'a, R: Ring + 'a>(row: &[R], set: usize, minor: impl Fn(usize) -> Option<&'a R>) -> Option<R> {
    let (mut sum, mut odd): (Option<R>, bool) = (None, false);
    for (c, x) in row.iter().enumerate() {
        if set >> c & 1 == 0 {
            continue;
        }
        if let Some(minor) = minor(c).filter(|_| !x.is_zero()) {
            let product = x.mul(minor);
            sum = Some(match (sum, odd) {
                (None, false) => product,
                (None, true) => product.neg(),
                (Some(sum), false) => sum.add(&product),
                (Some(sum), true) => sum.sub(&product),
            });
        }
        odd = !odd;
    }
    sum.filter(|sum| !sum.is_zero())
}
