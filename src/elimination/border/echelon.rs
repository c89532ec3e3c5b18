//! Relations between candidates solved modulo primes: reduced echelon form, the basis a part of the candidates.

use super::arithmetic::{Arithmetic, LEVEL, LOW, MOST_CANDIDATES, Relations, STRIDE, Split, WIDTH};

/// Solves for the candidates that come first; those without a pivot are the new basis elements.
///
/// # Errors
/// The rank found, where it differs from `rank`.
pub fn solve<A: Arithmetic>(
    field: &A,
    inverse: impl Fn(A::Element) -> Option<A::Element>,
    relations: &mut Relations<A::Element>,
    rank: usize,
    split: &mut Split<A::Element>,
) -> Result<f64, usize> {
    let zero = field.zero();
    let (count, n, low) = (relations.count, relations.candidates, relations.low);
    let rows = &mut relations.rows;
    let mut pivots = [0; MOST_CANDIDATES];
    let mut free = [0; MOST_CANDIDATES];
    let (mut found, mut left) = (0, 0);
    // Candidates first, row after row by the pivots found; the effect on the other part is one combination.
    for i in 0..count {
        let (done, rest) = rows.split_at_mut(i * STRIDE);
        let row = &mut rest[..STRIDE];
        let mut factors = [zero; MOST_CANDIDATES];
        for (k, pivot_row) in done.chunks_exact(STRIDE).take(found).enumerate() {
            let column = pivots[k];
            factors[k] = field.neg(row[column]);
            field.add_multiple(&mut row[column..n], factors[k], &pivot_row[column..n]);
        }
        let (lead, behind) = row.split_at_mut(LOW);
        let pivot_rows = done.chunks_exact(STRIDE).take(found).map(|r| &r[LOW..LOW + low]);
        field.add_combination(&mut behind[..low], factors.iter().copied().zip(pivot_rows));
        let Some(column) = lead[..n].iter().position(|&x| x != zero) else { continue };
        let Some(inverse) = inverse(lead[column]) else { return Err(found) };
        for x in lead[column..n].iter_mut().chain(&mut behind[..low]) {
            *x = field.mul(*x, inverse);
        }
        pivots[found] = column;
        if i != found {
            done[found * STRIDE..(found + 1) * STRIDE].swap_with_slice(row);
        }
        found += 1;
    }
    for column in 0..n {
        if !pivots[..found].contains(&column) {
            free[left] = column;
            left += 1;
        }
    }
    let consistent = (found..count).all(|i| rows[i * STRIDE + LOW..i * STRIDE + LOW + low].iter().all(|&x| x == zero));
    if found != rank || !consistent {
        return Err(if consistent { found } else { n });
    }
    // From the largest pivot column down: a row reaches to larger columns only, and those are solved by then.
    let normal = &mut split.normal;
    let one = field.one();
    let mut order: [usize; MOST_CANDIDATES] = std::array::from_fn(|k| k);
    order[..rank].sort_unstable_by_key(|&k| std::cmp::Reverse(pivots[k]));
    for (t, &column) in free[..left].iter().enumerate() {
        let row = &mut normal[column * WIDTH..][..low + left];
        row.fill(zero);
        row[low + t] = one;
    }
    for &k in &order[..rank] {
        let row = &rows[k * STRIDE..(k + 1) * STRIDE];
        let mut solved = [zero; WIDTH];
        for (target, &source) in solved.iter_mut().zip(&row[LOW..LOW + low]) {
            *target = field.neg(source);
        }
        let column = pivots[k];
        let later = normal.chunks_exact(WIDTH).take(n).enumerate().skip(column + 1);
        let terms = later.map(|(c, normal)| (field.neg(row[c]), &normal[..low + left]));
        field.add_combination(&mut solved[..low + left], terms);
        normal[column * WIDTH..][..low + left].copy_from_slice(&solved[..low + left]);
    }
    split.lift[..n * LEVEL].fill(zero);
    for (t, &column) in free[..left].iter().enumerate() {
        split.lift[column * LEVEL + t] = one;
    }
    Ok(1.0)
}
