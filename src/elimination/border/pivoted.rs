//! Relations between candidates solved in multiprecision: elimination with the largest pivot of all.

use super::arithmetic::{LEVEL, LOW, MOST_CANDIDATES, Relations, STRIDE, Split, WIDTH};
use crate::algebra::long_float::LongNumber;
use crate::algebra::ring::{Field, Ring};

/// Pivots of this relative size or less are rounding of zero: half the digits.
fn no_pivot<const LIMBS: usize>() -> f64 {
    (-0.5 * f64::from(LongNumber::<LIMBS>::BITS)).exp2()
}

/// Solves for the candidates with the largest pivots; those without one are the new basis elements.
///
/// # Errors
/// The rank found, where it differs from `rank`.
pub fn solve<const LIMBS: usize>(
    relations: &mut Relations<LongNumber<LIMBS>>,
    rank: usize,
    split: &mut Split<LongNumber<LIMBS>>,
) -> Result<f64, usize> {
    let (count, n, low) = (relations.count, relations.candidates, relations.low);
    let rows = &mut relations.rows;
    let mut pivots = [0; MOST_CANDIDATES];
    let (mut first, mut smallest) = (0.0_f64, 1.0_f64);
    for k in 0..rank {
        let (mut best, mut at, mut column) = (0.0, k, 0);
        for i in k..count {
            for (j, x) in rows[i * STRIDE..i * STRIDE + n].iter().enumerate() {
                let size = x.pivot_size();
                if size > best && !pivots[..k].contains(&j) {
                    (best, at, column) = (size, i, j);
                }
            }
        }
        first = if k == 0 { best } else { first };
        if !(best > no_pivot::<LIMBS>() * first) {
            return Err(k);
        }
        smallest = smallest.min(best / first);
        for j in 0..STRIDE {
            rows.swap(k * STRIDE + j, at * STRIDE + j);
        }
        pivots[k] = column;
        let Some(inverse) = rows[k * STRIDE + column].inverse() else { return Err(k) };
        let (head, tail) = rows.split_at_mut((k + 1) * STRIDE);
        let pivot_row = &mut head[k * STRIDE..];
        for x in used(pivot_row, n, low) {
            *x = x.mul(&inverse);
        }
        for row in tail.chunks_exact_mut(STRIDE).take(count - k - 1) {
            let factor = row[column].neg();
            if factor.is_zero() {
                continue;
            }
            row[column] = LongNumber::zero();
            let others = pivot_row[..n].iter().chain(&pivot_row[LOW..LOW + low]);
            for (j, (x, p)) in used(row, n, low).zip(others).enumerate() {
                if j != column {
                    *x = x.add(&factor.mul(p));
                }
            }
        }
    }
    let rest = rows[rank * STRIDE..count * STRIDE].chunks_exact_mut(STRIDE);
    if rest.flat_map(|row| used(row, n, low)).any(|x| x.pivot_size() > no_pivot::<LIMBS>() * first.max(1.0)) {
        return Err(n);
    }
    let normal = &mut split.normal;
    let free = (0..n).filter(|j| !pivots[..rank].contains(j));
    let left = n - rank;
    split.lift[..n * LEVEL].fill(LongNumber::zero());
    for (t, column) in free.enumerate() {
        let row = &mut normal[column * WIDTH..][..low + left];
        row.fill(LongNumber::zero());
        row[low + t] = LongNumber::one();
        split.lift[column * LEVEL + t] = LongNumber::one();
    }
    // A row is free of the pivots found before it: from the last one back.
    for k in (0..rank).rev() {
        let row = &rows[k * STRIDE..(k + 1) * STRIDE];
        let mut solved = [LongNumber::zero(); WIDTH];
        for (target, source) in solved.iter_mut().zip(&row[LOW..LOW + low]) {
            *target = source.neg();
        }
        for j in (0..n).filter(|j| !pivots[..=k].contains(j)) {
            for (target, x) in solved[..low + left].iter_mut().zip(&normal[j * WIDTH..]) {
                *target = target.sub(&row[j].mul(x));
            }
        }
        normal[pivots[k] * WIDTH..][..low + left].copy_from_slice(&solved[..low + left]);
    }
    Ok(smallest)
}

/// The entries of a row that are in use.
fn used<const LIMBS: usize>(
    row: &mut [LongNumber<LIMBS>],
    n: usize,
    low: usize,
) -> impl Iterator<Item = &mut LongNumber<LIMBS>> {
    let (lead, behind) = row.split_at_mut(LOW);
    lead[..n].iter_mut().chain(&mut behind[..low])
}
