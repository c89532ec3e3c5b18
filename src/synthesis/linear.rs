//! Linear equations in discs.

use crate::algebra::disc::Disc;
use crate::algebra::ring::Ring;

/// The solutions of linear equations with several right sides: the rows of a square matrix, each with its right sides behind it,
/// are replaced by the rows of the solutions. `None` where some pivot may be 0.
pub(super) fn solved(mut rows: Vec<Vec<Disc>>) -> Option<Vec<Vec<Disc>>> {
    let count = rows.len();
    for k in 0..count {
        let size = |i: &usize| rows[*i][k].at_least();
        let pivot = (k..count).max_by(|i, j| size(i).partial_cmp(&size(j)).unwrap_or(std::cmp::Ordering::Equal))?;
        rows.swap(k, pivot);
        let inverse = rows[k][k].inverse()?;
        let pivot: Vec<Disc> = rows[k].iter().map(|x| x.mul(&inverse)).collect();
        for (_, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = row[k].clone();
            for (x, y) in row.iter_mut().zip(&pivot).skip(k) {
                *x = x.sub(&factor.mul(y));
            }
        }
        rows[k] = pivot;
    }
    Some(rows.into_iter().map(|mut row| row.split_off(count)).collect())
}
