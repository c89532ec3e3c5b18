//! Relations between candidates solved modulo a prime: reduced echelon form, the basis a part of the candidates.

use super::arithmetic::{Arithmetic, LEVEL, LOW, MOST_CANDIDATES, Relations, STRIDE, Split, WIDTH};
use crate::algebra::modp::Modulus;

/// Solves for the candidates that come first; those without a pivot are the new basis elements.
///
/// # Errors
/// The rank found, where it is not the one asked for.
pub fn solve(
    modulus: &Modulus,
    relations: &mut Relations<u64>,
    rank: usize,
    split: &mut Split<u64>,
) -> Result<f64, usize> {
    let (count, n, low) = (relations.count, relations.candidates, relations.low);
    let rows = &mut relations.rows;
    let mut pivots = [0; MOST_CANDIDATES];
    let mut free = [0; MOST_CANDIDATES];
    let (mut found, mut left) = (0, 0);
    for column in 0..n {
        let Some(best) = (found..count).find(|i| rows[i * STRIDE + column] != 0) else {
            free[left] = column;
            left += 1;
            continue;
        };
        if best != found {
            let (head, tail) = rows.split_at_mut(best * STRIDE);
            head[found * STRIDE..(found + 1) * STRIDE].swap_with_slice(&mut tail[..STRIDE]);
        }
        let (head, tail) = rows.split_at_mut((found + 1) * STRIDE);
        let pivot_row = &mut head[found * STRIDE..];
        let inverse = modulus.inverse(pivot_row[column]);
        for part in [column..n, LOW..LOW + low] {
            for x in &mut pivot_row[part] {
                *x = modulus.mul(*x, inverse);
            }
        }
        for row in tail.chunks_exact_mut(STRIDE).take(count - found - 1) {
            let factor = modulus.neg(row[column]);
            modulus.add_multiple(&mut row[column..n], factor, &pivot_row[column..n]);
            modulus.add_multiple(&mut row[LOW..LOW + low], factor, &pivot_row[LOW..LOW + low]);
        }
        pivots[found] = column;
        found += 1;
    }
    let consistent = (found..count).all(|i| rows[i * STRIDE + LOW..i * STRIDE + LOW + low].iter().all(|&x| x == 0));
    if found != rank || !consistent {
        return Err(if consistent { found } else { n });
    }
    // From the last pivot up: the rows of later pivots are solved already.
    let normal = &mut split.normal;
    for k in (0..rank).rev() {
        let row = &rows[k * STRIDE..(k + 1) * STRIDE];
        let mut solved = [0; WIDTH];
        for (target, &source) in solved.iter_mut().zip(&row[LOW..LOW + low]) {
            *target = modulus.neg(source);
        }
        for t in 0..left {
            solved[low + t] = modulus.neg(row[free[t]]);
        }
        for &column in &pivots[k + 1..rank] {
            let factor = modulus.neg(row[column]);
            modulus.add_multiple(&mut solved[..low + left], factor, &normal[column * WIDTH..][..low + left]);
        }
        normal[pivots[k] * WIDTH..][..low + left].copy_from_slice(&solved[..low + left]);
    }
    split.lift[..n * LEVEL].fill(0);
    let one = modulus.one();
    for (t, &column) in free[..left].iter().enumerate() {
        let row = &mut normal[column * WIDTH..][..low + left];
        row.fill(0);
        row[low + t] = one;
        split.lift[column * LEVEL + t] = one;
    }
    Ok(1.0)
}
