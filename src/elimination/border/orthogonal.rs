//! Relations between candidates solved in f64: orthogonal triangulation with the rows in order of size.

use super::arithmetic::{LEVEL, LOW, MOST_CANDIDATES, MOST_RELATIONS, Relations, STRIDE, Split, WIDTH};

/// Pivots of this relative size or less are rounding of zero: genuine ones of 20,000 random platforms were above 3e-6.
const NO_PIVOT: f64 = 1e-10;
/// Number of steps after which the sizes of the rows left are computed anew.
const REFRESH: usize = 4;

/// Splits the candidates: `Q^T candidates = (z, beta)` with the first ones solved for, `z = Z low`, the others new.
///
/// # Errors
/// The rank found, where it is below `rank`.
pub fn solve(relations: &mut Relations<f64>, rank: usize, split: &mut Split<f64>) -> Result<f64, usize> {
    let (n, low) = (relations.candidates, relations.low);
    let triangle = triangulate(relations, rank)?;
    let normal = &mut split.normal;
    let new = n - rank;
    forward(&relations.rows, &triangle, rank, low, normal);
    for k in 0..n {
        let row = &mut normal[k * WIDTH..][..low + new];
        if k < rank {
            row[low..].fill(0.0);
        } else {
            row.fill(0.0);
            row[low + k - rank] = 1.0;
        }
    }
    reflect(&relations.rows, &triangle, rank, n, &mut normal[..n * WIDTH], low + new);
    for (lift, normal) in split.lift.chunks_exact_mut(LEVEL).zip(normal.chunks_exact(WIDTH)).take(n) {
        lift[..new].copy_from_slice(&normal[low..low + new]);
    }
    Ok(triangle.quality)
}

/// The relations' first parts, transposed, as `Q R`: what does not stand in the rows themselves.
struct Triangle {
    /// Reflection k is `I - factor v v^T`; v begins at entry k of row k, with 1 that is not stored.
    factors: [f64; MOST_CANDIDATES],
    /// The diagonal of R; column k of R above it is the beginning of row k.
    pivots: [f64; MOST_CANDIDATES],
    /// The smallest pivot over the first one.
    quality: f64,
}

/// Scales all rows to length 1; the squares of their first parts.
fn normalise(relations: &mut Relations<f64>) -> [f64; MOST_RELATIONS] {
    let (n, low) = (relations.candidates, relations.low);
    let mut sizes = [0.0; MOST_RELATIONS];
    for (row, size) in relations.rows.chunks_exact_mut(STRIDE).take(relations.count).zip(&mut sizes) {
        let lead: f64 = row[..n].iter().map(|x| x * x).sum();
        let whole = lead + row[LOW..LOW + low].iter().map(|x| x * x).sum::<f64>();
        let scale = if whole > 0.0 { 1.0 / whole.sqrt() } else { 0.0 };
        for x in &mut row[..n] {
            *x *= scale;
        }
        for x in &mut row[LOW..LOW + low] {
            *x *= scale;
        }
        *size = lead * scale * scale;
    }
    sizes
}

/// Reflects row after row onto its beginning, the largest of those left first.
fn triangulate(relations: &mut Relations<f64>, rank: usize) -> Result<Triangle, usize> {
    let mut sizes = normalise(relations);
    let (count, n) = (relations.count, relations.candidates);
    let rows = &mut relations.rows;
    let mut triangle = Triangle { factors: [0.0; MOST_CANDIDATES], pivots: [0.0; MOST_CANDIDATES], quality: 1.0 };
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
        let first = if k == 0 { norm } else { triangle.pivots[0].abs() };
        if !(norm > NO_PIVOT * first) || !norm.is_finite() {
            return Err(k);
        }
        triangle.quality = triangle.quality.min(norm / first);
        let pivot = if v[0] > 0.0 { -norm } else { norm };
        let scale = 1.0 / (v[0] - pivot);
        let factor = (pivot - v[0]) / pivot;
        (triangle.factors[k], triangle.pivots[k]) = (factor, pivot);
        for x in &mut v[1..] {
            *x *= scale;
        }
        for (row, size) in tail.chunks_exact_mut(STRIDE).zip(&mut sizes[k + 1..count]) {
            let row = &mut row[k..n];
            let sum: f64 = row[0] + v[1..].iter().zip(&row[1..]).map(|(x, y)| x * y).sum::<f64>();
            let sum = sum * factor;
            row[0] -= sum;
            for (x, y) in row[1..].iter_mut().zip(&v[1..]) {
                *x -= sum * y;
            }
            *size -= row[0] * row[0];
        }
    }
    Ok(triangle)
}

/// The z: row k reads `sum_{j<k} row[j] z_j + pivot z_k + low = 0`.
fn forward(rows: &[f64], triangle: &Triangle, rank: usize, low: usize, solved: &mut [f64]) {
    for k in 0..rank {
        let (done, rest) = solved.split_at_mut(k * WIDTH);
        let target = &mut rest[..low];
        let row = &rows[k * STRIDE..(k + 1) * STRIDE];
        target.copy_from_slice(&row[LOW..LOW + low]);
        for (factor, other) in row[..k].iter().zip(done.chunks_exact(WIDTH)) {
            for (t, s) in target.iter_mut().zip(&other[..low]) {
                *t += factor * s;
            }
        }
        let scale = -1.0 / triangle.pivots[k];
        for t in target.iter_mut() {
            *t *= scale;
        }
    }
}

/// Back through the reflections, the last one first: from (z, beta) to the candidates.
fn reflect(rows: &[f64], triangle: &Triangle, rank: usize, n: usize, normal: &mut [f64], width: usize) {
    let mut buffer = [0.0; WIDTH];
    let sum = &mut buffer[..width];
    for k in (0..rank).rev() {
        let v = &rows[k * STRIDE + k + 1..k * STRIDE + n];
        let (head, tail) = normal.split_at_mut((k + 1) * WIDTH);
        let first = &mut head[k * WIDTH..k * WIDTH + width];
        sum.copy_from_slice(first);
        for (x, row) in v.iter().zip(tail.chunks_exact(WIDTH)) {
            for (s, y) in sum.iter_mut().zip(&row[..width]) {
                *s += x * y;
            }
        }
        for (y, s) in first.iter_mut().zip(sum.iter_mut()) {
            *s *= triangle.factors[k];
            *y -= *s;
        }
        for (x, row) in v.iter().zip(tail.chunks_exact_mut(WIDTH)) {
            for (y, s) in row[..width].iter_mut().zip(sum.iter()) {
                *y -= x * s;
            }
        }
    }
}
