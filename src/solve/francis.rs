//! Eigenvalues of small real matrices on the stack: reduction to Hessenberg form by stabilised elimination, then
//! Francis's implicit double-shift QR steps with deflation. Vectors one by one by inverse iteration, no allocation: about
//! twice as fast as the general routine, which stays the reference. \[MartinPetersWilkinson1970\]

use super::scalar::Scalar;
use crate::elimination::pencil::Square;
use num_complex::Complex;

/// QR steps spent on one eigenvalue before giving up.
const MOST_STEPS: usize = 60;

/// The eigenvalues of a matrix, which is used up. `None` if the iteration does not converge or meets a number that is
/// not finite.
#[must_use]
pub fn eigenvalues<const N: usize>(matrix: &mut Square<f64, N>) -> Option<[Complex<f64>; N]> {
    reduce(matrix);
    of_hessenberg(matrix)
}

/// The eigenvalues of the upper Hessenberg part of a matrix, which is used up; what stands below it does not matter.
#[must_use]
pub fn of_hessenberg<const N: usize>(matrix: &mut Square<f64, N>) -> Option<[Complex<f64>; N]> {
    for (i, row) in matrix.iter_mut().enumerate().skip(2) {
        row[..i - 1].fill(0.0);
    }
    let norm: f64 = matrix.iter().flatten().map(|x| x.abs()).sum();
    if !norm.is_finite() {
        return None;
    }
    let mut roots = [Complex::new(0.0, 0.0); N];
    // Eigenvalues of the leading `open` rows and columns are still to be found.
    let mut open = N;
    let mut steps = 0;
    let mut shifted = 0.0;
    while open > 0 {
        let last = open - 1;
        let first = block_start(matrix, last, norm);
        match last - first {
            0 => {
                roots[last] = Complex::new(matrix[last][last] + shifted, 0.0);
                open -= 1;
                steps = 0;
            }
            1 => {
                let pair = pair_of(matrix, last, shifted);
                (roots[last - 1], roots[last]) = pair;
                open -= 2;
                steps = 0;
            }
            _ => {
                if steps == MOST_STEPS {
                    return None;
                }
                let shifts = if steps > 0 && steps % 10 == 0 {
                    // An exceptional shift breaks up cycles.
                    let away = matrix[last][last];
                    shifted += away;
                    for k in 0..open {
                        matrix[k][k] -= away;
                    }
                    let s = matrix[last][last - 1].abs() + matrix[last - 1][last - 2].abs();
                    Shifts { x: 0.75 * s, y: 0.75 * s, w: -0.4375 * s * s }
                } else {
                    Shifts {
                        x: matrix[last][last],
                        y: matrix[last - 1][last - 1],
                        w: matrix[last][last - 1] * matrix[last - 1][last],
                    }
                };
                steps += 1;
                double_step(matrix, first, last, shifts);
            }
        }
    }
    roots.iter().all(|z| z.re.is_finite() && z.im.is_finite()).then_some(roots)
}

/// The two shifts of a double step as trace and determinant hold them: those of `[[y, *], [*, x]]` with off-diagonal
/// product w.
#[derive(Clone, Copy)]
struct Shifts {
    x: f64,
    y: f64,
    w: f64,
}

/// Similar upper Hessenberg form, by elimination with the largest pivot of each column. The factors stay below the
/// subdiagonal; the row that each column's pivot came from.
pub fn reduce<const N: usize>(a: &mut Square<f64, N>) -> [usize; N] {
    let mut order: [usize; N] = std::array::from_fn(|i| i);
    for column in 0..N.saturating_sub(2) {
        let target = column + 1;
        let mut pivot = target;
        for i in target + 1..N {
            if a[i][column].abs() > a[pivot][column].abs() {
                pivot = i;
            }
        }
        order[target] = pivot;
        if a[pivot][column] == 0.0 {
            continue;
        }
        if pivot != target {
            let (head, tail) = a.split_at_mut(pivot);
            head[target][column..].swap_with_slice(&mut tail[0][column..]);
            for row in a.iter_mut() {
                row.swap(pivot, target);
            }
        }
        let inverse = 1.0 / a[target][column];
        let pivot_row = a[target];
        let mut factors = [0.0; N];
        for i in target + 1..N {
            let factor = a[i][column] * inverse;
            factors[i] = factor;
            a[i][column] = factor;
            if factor != 0.0 {
                for j in target..N {
                    a[i][j] -= factor * pivot_row[j];
                }
            }
        }
        // The inverse operations from the right: column `target` gains the others times their factors.
        for row in a.iter_mut() {
            let mut sum = row[target];
            for i in target + 1..N {
                sum += row[i] * factors[i];
            }
            row[target] = sum;
        }
    }
    order
}

/// A vector of the Hessenberg form as a vector of the matrix that [`reduce`] made it of.
pub fn back<S: Scalar, const N: usize>(reduced: &Square<f64, N>, order: &[usize; N], vector: &mut [S; N]) {
    for column in (0..N.saturating_sub(2)).rev() {
        let target = column + 1;
        let along = vector[target];
        for i in target + 1..N {
            vector[i] = vector[i].add(&along.times(reduced[i][column]));
        }
        vector.swap(target, order[target]);
    }
}

/// An eigenvector of the upper Hessenberg part of a matrix, by one step of inverse iteration at an eigenvalue; `upper`
/// is scratch. The eigenvalue must be accurate: the step has the triangular factor alone to work with.
pub fn vector<S: Scalar, const N: usize>(reduced: &Square<f64, N>, value: S, upper: &mut Square<S, N>) -> [S; N] {
    let mut norm = 0.0_f64;
    let mut row: [S; N] = reduced[0].map(S::from_f64);
    row[0] = row[0].sub(&value);
    for k in 0..N - 1 {
        let mut next = [S::zero(); N];
        for j in k..N {
            next[j] = S::from_f64(reduced[k + 1][j]);
        }
        next[k + 1] = next[k + 1].sub(&value);
        norm = norm.max(next[k].size()).max(next[k + 1].size());
        if row[k].size() < next[k].size() {
            std::mem::swap(&mut row, &mut next);
        }
        upper[k] = row;
        let factor = if next[k].is_zero() { S::zero() } else { next[k].over(row[k]) };
        for j in k + 1..N {
            next[j] = next[j].sub(&factor.mul(&row[j]));
        }
        row = next;
    }
    upper[N - 1] = row;
    let least = f64::EPSILON * norm.max(f64::MIN_POSITIVE);
    let mut vector = [S::one(); N];
    for k in (0..N).rev() {
        let mut sum = vector[k];
        for j in k + 1..N {
            sum = sum.sub(&upper[k][j].mul(&vector[j]));
        }
        let pivot = upper[k][k];
        vector[k] = if pivot.size() < least { sum.times(1.0 / least) } else { sum.over(pivot) };
        // Two tiny pivots in a row would overflow in the end.
        let size = vector[k].size();
        if size > 1e100 {
            for x in &mut vector[..] {
                *x = x.times(1.0 / size);
            }
        }
    }
    vector
}

/// The first row of the unreduced block that ends at `last`: a negligible subdiagonal entry above it is cleared.
fn block_start<const N: usize>(a: &mut Square<f64, N>, last: usize, norm: f64) -> usize {
    let mut k = last;
    while k > 0 {
        let mut scale = a[k - 1][k - 1].abs() + a[k][k].abs();
        if scale == 0.0 {
            scale = norm;
        }
        if a[k][k - 1].abs() <= f64::EPSILON * scale {
            a[k][k - 1] = 0.0;
            break;
        }
        k -= 1;
    }
    k
}

/// The eigenvalues of the block of rows `last - 1` and `last`.
fn pair_of<const N: usize>(a: &Square<f64, N>, last: usize, shifted: f64) -> (Complex<f64>, Complex<f64>) {
    let (x, w) = (a[last][last], a[last][last - 1] * a[last - 1][last]);
    let half = 0.5 * (a[last - 1][last - 1] - x);
    let discriminant = half * half + w;
    let root = discriminant.abs().sqrt();
    let x = x + shifted;
    if discriminant >= 0.0 {
        let far = half + root.copysign(half);
        let near = if far == 0.0 { x } else { x - w / far };
        (Complex::new(x + far, 0.0), Complex::new(near, 0.0))
    } else {
        (Complex::new(x + half, root), Complex::new(x + half, -root))
    }
}

/// One implicit double-shift QR step on the block of rows and columns `first..=last`, which has at least three.
fn double_step<const N: usize>(a: &mut Square<f64, N>, first: usize, last: usize, shifts: Shifts) {
    // Two consecutive small subdiagonal entries let the step begin further down.
    let mut start = last - 2;
    let mut bulge;
    loop {
        let diagonal = a[start][start];
        let (r, s) = (shifts.x - diagonal, shifts.y - diagonal);
        let p = (r * s - shifts.w) / a[start + 1][start] + a[start][start + 1];
        let q = a[start + 1][start + 1] - diagonal - r - s;
        let r = a[start + 2][start + 1];
        let scale = 1.0 / (p.abs() + q.abs() + r.abs());
        bulge = [p * scale, q * scale, r * scale];
        if start == first {
            break;
        }
        let small = a[start][start - 1].abs() * (bulge[1].abs() + bulge[2].abs());
        let around = a[start - 1][start - 1].abs() + diagonal.abs() + a[start + 1][start + 1].abs();
        if small <= f64::EPSILON * bulge[0].abs() * around {
            break;
        }
        start -= 1;
    }
    for i in start + 2..=last {
        a[i][i - 2] = 0.0;
        if i > start + 2 {
            a[i][i - 3] = 0.0;
        }
    }
    // Chase the bulge down with reflections of three rows and columns, two at the end.
    for k in start..last {
        let three = k + 1 < last;
        let mut size = 1.0;
        if k > start {
            bulge = [a[k][k - 1], a[k + 1][k - 1], if three { a[k + 2][k - 1] } else { 0.0 }];
            size = bulge[0].abs() + bulge[1].abs() + bulge[2].abs();
            if size == 0.0 {
                continue;
            }
            let scale = 1.0 / size;
            bulge = bulge.map(|x| x * scale);
        }
        let [p, q, r] = bulge;
        let s = (p * p + q * q + r * r).sqrt().copysign(p);
        if s == 0.0 {
            continue;
        }
        if k > start {
            a[k][k - 1] = -s * size;
        } else if first != start {
            a[k][k - 1] = -a[k][k - 1];
        }
        let over_s = 1.0 / s;
        let p = p + s;
        let over_p = 1.0 / p;
        // The reflection is I - u v^T with u = (x, y, z) and v = (1, q, r).
        let (x, y, z) = (p * over_s, q * over_s, r * over_s);
        let (q, r) = (q * over_p, r * over_p);
        if three {
            let [row0, row1, row2] = a.get_disjoint_mut([k, k + 1, k + 2]).unwrap_or_else(|_| unreachable!());
            for j in k..=last {
                let sum = row0[j] + q * row1[j] + r * row2[j];
                row0[j] -= sum * x;
                row1[j] -= sum * y;
                row2[j] -= sum * z;
            }
            for row in &mut a[first..=last.min(k + 3)] {
                let sum = x * row[k] + y * row[k + 1] + z * row[k + 2];
                row[k] -= sum;
                row[k + 1] -= sum * q;
                row[k + 2] -= sum * r;
            }
        } else {
            let [row0, row1] = a.get_disjoint_mut([k, k + 1]).unwrap_or_else(|_| unreachable!());
            for j in k..=last {
                let sum = row0[j] + q * row1[j];
                row0[j] -= sum * x;
                row1[j] -= sum * y;
            }
            for row in &mut a[first..=last] {
                let sum = x * row[k] + y * row[k + 1];
                row[k] -= sum;
                row[k + 1] -= sum * q;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{back, eigenvalues, of_hessenberg, reduce, vector};
    use num_complex::Complex;

    #[test]
    fn vectors_belong_to_their_values() {
        const N: usize = 9;
        let zero = Complex::new(0.0, 0.0);
        let matrix: [[f64; N]; N] =
            std::array::from_fn(|i| std::array::from_fn(|j| ((i * 31 + j * 17 + i * j * 7) % 23) as f64 / 11.0 - 1.0));
        let mut reduced = matrix;
        let order = reduce(&mut reduced);
        for value in of_hessenberg(&mut reduced.clone()).unwrap() {
            let mut found = vector(&reduced, value, &mut [[zero; N]; N]);
            back(&reduced, &order, &mut found);
            let size = found.iter().map(|x| x.norm()).fold(0.0, f64::max);
            for (row, x) in matrix.iter().zip(&found) {
                let image: Complex<f64> = row.iter().zip(&found).map(|(a, x)| a * x).sum();
                assert!((image - value * x).norm() < 1e-12 * size, "{value}");
            }
        }
    }

    #[test]
    fn known_spectra() {
        // A companion matrix of (x - 1)(x - 2)(x^2 + 1): x^4 - 3 x^3 + 3 x^2 - 3 x + 2.
        let mut companion = [[0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0], [-2.0, 3.0, -3.0, 3.0]];
        let mut roots = eigenvalues(&mut companion).unwrap();
        roots.sort_by(|a, b| a.re.total_cmp(&b.re).then(a.im.total_cmp(&b.im)));
        for (root, (re, im)) in roots.iter().zip([(0.0, -1.0), (0.0, 1.0), (1.0, 0.0), (2.0, 0.0)]) {
            assert!((root.re - re).abs() < 1e-13 && (root.im - im).abs() < 1e-13, "{root}");
        }
        // A cyclic shift, on which unshifted QR stands still: the eighth roots of unity.
        let mut shift = [[0.0; 8]; 8];
        for (k, row) in shift.iter_mut().enumerate() {
            row[(k + 1) % 8] = 1.0;
        }
        for root in eigenvalues(&mut shift).unwrap() {
            assert!((root.norm() - 1.0).abs() < 1e-13 && (root.powi(8) - 1.0).norm() < 1e-12, "{root}");
        }
        assert!(eigenvalues(&mut [[f64::NAN; 3]; 3]).is_none());
        assert!(eigenvalues(&mut [[0.0; 3]; 3]).unwrap().iter().all(|z| z.norm() == 0.0));
    }
}
