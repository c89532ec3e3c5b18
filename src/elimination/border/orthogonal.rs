//! Relations between candidates solved in f64: orthogonal triangulation with the rows in order of size.

use super::arithmetic::{LEVEL, LOW, MOST_CANDIDATES, MOST_RELATIONS, Relations, STRIDE, Split, WIDTH};

/// Pivots of this relative size or less are rounding of zero: genuine ones of 20,000 random platforms were above 3e-6.
const NO_PIVOT: f64 = 1e-12;
/// After so many steps the sizes of the rows left are computed anew.
const REFRESH: usize = 4;

/// Splits the candidates: `Q^T candidates = (z, beta)` with the first ones solved for, `z = Z low`, the others new.
///
/// # Errors
/// The rank found, where it is below the one asked for.
pub fn solve(relations: &mut Relations<f64>, rank: usize, split: &mut Split<f64>) -> Result<f64, usize> {
    let (count, n, low) = (relations.count, relations.candidates, relations.low);
    let rows = &mut relations.rows;
    let mut sizes = [0.0; MOST_RELATIONS];
    for i in 0..count {
        let row = &mut rows[i * STRIDE..(i + 1) * STRIDE];
        let lead: f64 = row[..n].iter().map(|x| x * x).sum();
        let whole = lead + row[LOW..LOW + low].iter().map(|x| x * x).sum::<f64>();
        let scale = if whole > 0.0 { 1.0 / whole.sqrt() } else { 0.0 };
        for x in &mut row[..n] {
            *x *= scale;
        }
        for x in &mut row[LOW..LOW + low] {
            *x *= scale;
        }
        sizes[i] = lead * scale * scale;
    }
    // Reflection k is I - factor v v^T; v begins at entry k of row k, with 1 that is not stored.
    let mut factors = [0.0; MOST_CANDIDATES];
    let mut pivots = [0.0_f64; MOST_CANDIDATES];
    let mut smallest = f64::INFINITY;
    for k in 0..rank {
        if (k > 0 && k % REFRESH == 0) || k + 2 >= rank {
            for i in k..count {
                sizes[i] = rows[i * STRIDE + k..i * STRIDE + n].iter().map(|x| x * x).sum();
            }
        }
        let Some(best) = (k..count).max_by(|&i, &j| sizes[i].total_cmp(&sizes[j])) else { return Err(k) };
        if best != k {
            let (head, tail) = rows.split_at_mut(best * STRIDE);
            head[k * STRIDE..(k + 1) * STRIDE].swap_with_slice(&mut tail[..STRIDE]);
            sizes.swap(k, best);
        }
        let (head, tail) = rows.split_at_mut((k + 1) * STRIDE);
        let v = &mut head[k * STRIDE + k..k * STRIDE + n];
        let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        if !(norm > NO_PIVOT * pivots[0].abs()) || !norm.is_finite() {
            return Err(k);
        }
        smallest = smallest.min(norm);
        let pivot = if v[0] > 0.0 { -norm } else { norm };
        let scale = 1.0 / (v[0] - pivot);
        factors[k] = (pivot - v[0]) / pivot;
        pivots[k] = pivot;
        for x in &mut v[1..] {
            *x *= scale;
        }
        for i in k + 1..count {
            let start = (i - k - 1) * STRIDE + k;
            let row = &mut tail[start..start + n - k];
            let sum: f64 = row[0] + v[1..].iter().zip(&row[1..]).map(|(x, y)| x * y).sum::<f64>();
            let sum = sum * factors[k];
            row[0] -= sum;
            for (x, y) in row[1..].iter_mut().zip(&v[1..]) {
                *x -= sum * y;
            }
            sizes[i] -= row[0] * row[0];
        }
    }
    // Row k reads sum_{j<k} row[j] z_j + pivot z_k + low = 0.
    let normal = &mut split.normal;
    let new = n - rank;
    for k in 0..rank {
        let (done, rest) = normal.split_at_mut(k * WIDTH);
        let target = &mut rest[..low];
        let row = &rows[k * STRIDE..(k + 1) * STRIDE];
        target.copy_from_slice(&row[LOW..LOW + low]);
        for j in 0..k {
            let factor = row[j];
            for (t, s) in target.iter_mut().zip(&done[j * WIDTH..j * WIDTH + low]) {
                *t += factor * s;
            }
        }
        let scale = -1.0 / pivots[k];
        for t in target.iter_mut() {
            *t *= scale;
        }
        rest[low..low + new].fill(0.0);
    }
    for t in 0..new {
        let row = &mut normal[(rank + t) * WIDTH..(rank + t) * WIDTH + low + new];
        row.fill(0.0);
        row[low + t] = 1.0;
    }
    // Back through the reflections.
    let width = low + new;
    let mut sum = [0.0; WIDTH];
    for k in (0..rank).rev() {
        let v = &rows[k * STRIDE + k + 1..k * STRIDE + n];
        let (head, tail) = normal[..n * WIDTH].split_at_mut((k + 1) * WIDTH);
        let first = &mut head[k * WIDTH..k * WIDTH + width];
        let sum = &mut sum[..width];
        sum.copy_from_slice(first);
        for (x, row) in v.iter().zip(tail.chunks_exact(WIDTH)) {
            for (s, y) in sum.iter_mut().zip(&row[..width]) {
                *s += x * y;
            }
        }
        for (y, s) in first.iter_mut().zip(sum.iter_mut()) {
            *s *= factors[k];
            *y -= *s;
        }
        for (x, row) in v.iter().zip(tail.chunks_exact_mut(WIDTH)) {
            for (y, s) in row[..width].iter_mut().zip(sum.iter()) {
                *y -= x * s;
            }
        }
    }
    for c in 0..n {
        split.lift[c * LEVEL..c * LEVEL + new].copy_from_slice(&normal[c * WIDTH + low..c * WIDTH + low + new]);
    }
    Ok(smallest / pivots[0].abs())
}
