//! The legs' matrix K solved for u as far as that is safe; each direction left open becomes an unknown.

use super::arithmetic::Arithmetic;

/// Largest number of unknowns beside the rotation.
pub const MOST: usize = 4;
/// Largest number of them for which border bases have room.
pub const MOST_DIRECTIONS: usize = 3;
/// Directions of K that are always divided by.
const LEAST_KEPT: usize = 4;
/// Singular values of K below this part of the largest one are not divided by.
const WEAK: f64 = 0.1;
/// Singular values below this part of the largest one are rounding of zero.
const ZERO: f64 = 1e-12;

/// The solution of `K u = c`: `u = particular c + sum_a tau_a null_a`, where some combinations of the legs are left as
/// conditions, `dropped_a c = sum_b slopes_ab tau_b`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Directions<E> {
    /// Rank of K.
    pub rank: usize,
    /// The number of unknowns tau.
    pub count: usize,
    /// A right inverse of the part of K that is kept.
    pub particular: [[E; 6]; 7],
    /// A basis of the kernel of that part; `count` of these are in use.
    pub null: [[E; 7]; MOST],
    /// The combinations of legs that are left; `count - 1` of these are in use.
    pub dropped: [[E; 6]; MOST - 1],
    /// K, combined in the same way, on the kernel basis.
    pub slopes: [[E; MOST]; MOST - 1],
}

/// Solves K by its singular values and leaves out at most the two smallest, so that nothing is divided by a small number.
#[must_use]
pub fn weak_directions(matrix: &[[f64; 7]; 6]) -> Directions<f64> {
    let mut rows = *matrix;
    let mut combination: [[f64; 6]; 6] =
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }));
    // One-sided Jacobi: rotations of pairs of rows until all are orthogonal.
    for _ in 0..40 {
        let mut turned = false;
        for i in 0..5 {
            for j in i + 1..6 {
                let (a, b) = (square(&rows[i]), square(&rows[j]));
                let product: f64 = rows[i].iter().zip(&rows[j]).map(|(x, y)| x * y).sum();
                if !(product.abs() > 1e-15 * (a * b).sqrt()) || product == 0.0 {
                    continue;
                }
                turned = true;
                let cotangent = (b - a) / (2.0 * product);
                let tangent = cotangent.signum() / (cotangent.abs() + cotangent.hypot(1.0));
                let cos = 1.0 / tangent.hypot(1.0);
                rotate(&mut rows, i, j, cos, cos * tangent);
                rotate(&mut combination, i, j, cos, cos * tangent);
            }
        }
        if !turned {
            break;
        }
    }
    let mut order: [usize; 6] = std::array::from_fn(|i| i);
    order.sort_by(|&i, &j| square(&rows[j]).total_cmp(&square(&rows[i])));
    let sizes = order.map(|i| square(&rows[i]).sqrt());
    let rank = sizes.iter().filter(|&&s| s > ZERO * sizes[0]).count();
    let kept = sizes.iter().filter(|&&s| s >= WEAK * sizes[0]).count().clamp(LEAST_KEPT, 6);
    let mut particular = [[0.0; 6]; 7];
    for (&i, size) in order[..kept].iter().zip(sizes) {
        for k in 0..7 {
            for leg in 0..6 {
                particular[k][leg] += rows[i][k] / (size * size) * combination[i][leg];
            }
        }
    }
    let mut null = [[0.0; 7]; MOST];
    complement(&order.map(|i| rows[i])[..kept], &mut null[..7 - kept]);
    let (mut dropped, mut slopes) = ([[0.0; 6]; MOST - 1], [[0.0; MOST]; MOST - 1]);
    for (a, &i) in order[kept..].iter().enumerate() {
        dropped[a] = combination[i];
        for (slope, n) in slopes[a].iter_mut().zip(&null) {
            *slope = rows[i].iter().zip(n).map(|(x, y)| x * y).sum();
        }
    }
    Directions { rank, count: 7 - kept, particular, null, dropped, slopes }
}

fn square<const N: usize>(row: &[f64; N]) -> f64 {
    row.iter().map(|x| x * x).sum()
}

/// The rotation that makes rows i and j orthogonal, from its cosine and sine.
fn rotate<const N: usize>(rows: &mut [[f64; N]; 6], i: usize, j: usize, cos: f64, sin: f64) {
    for k in 0..N {
        let (x, y) = (rows[i][k], rows[j][k]);
        rows[i][k] = cos * x - sin * y;
        rows[j][k] = sin * x + cos * y;
    }
}

/// Orthonormal vectors orthogonal to the given ones, which are orthogonal to each other.
fn complement(given: &[[f64; 7]], found: &mut [[f64; 7]]) {
    let mut all = [[0.0; 7]; 7];
    let mut count = 0;
    for row in given {
        let size = square(row).sqrt();
        if size > 0.0 {
            all[count] = row.map(|x| x / size);
            count += 1;
        }
    }
    for target in found {
        let rest = |k: usize, all: &[[f64; 7]]| {
            let mut v: [f64; 7] = std::array::from_fn(|j| if j == k { 1.0 } else { 0.0 });
            for _ in 0..2 {
                for other in all {
                    let product: f64 = v.iter().zip(other).map(|(x, y)| x * y).sum();
                    for (x, y) in v.iter_mut().zip(other) {
                        *x -= product * y;
                    }
                }
            }
            v
        };
        let mut best = rest(0, &all[..count]);
        for k in 1..7 {
            let v = rest(k, &all[..count]);
            if square(&v) > square(&best) {
                best = v;
            }
        }
        let size = square(&best).sqrt();
        *target = best.map(|x| x / size);
        all[count] = *target;
        count += 1;
    }
}

/// Solves K exactly; `None` where its rank is below 3.
#[must_use]
pub fn exact_directions<A: Arithmetic>(
    arithmetic: &A,
    inverse: impl Fn(A::Element) -> Option<A::Element>,
    matrix: &[[A::Element; 7]; 6],
) -> Option<Directions<A::Element>> {
    let (zero, one) = (arithmetic.zero(), arithmetic.one());
    let mut rows = *matrix;
    let mut combination: [[A::Element; 6]; 6] =
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { one } else { zero }));
    let mut pivots = [0; 6];
    let mut free = [0; 7];
    let (mut rank, mut left) = (0, 0);
    for column in 0..7 {
        let Some(best) = (rank..6).find(|&i| rows[i][column] != zero) else {
            free[left] = column;
            left += 1;
            continue;
        };
        rows.swap(best, rank);
        combination.swap(best, rank);
        let scale = inverse(rows[rank][column])?;
        rows[rank] = rows[rank].map(|x| arithmetic.mul(x, scale));
        combination[rank] = combination[rank].map(|x| arithmetic.mul(x, scale));
        for i in (0..6).filter(|&i| i != rank) {
            let factor = arithmetic.neg(rows[i][column]);
            let (from, along) = (rows[rank], combination[rank]);
            arithmetic.add_multiple(&mut rows[i], factor, &from);
            arithmetic.add_multiple(&mut combination[i], factor, &along);
        }
        pivots[rank] = column;
        rank += 1;
    }
    if left > MOST {
        return None;
    }
    let mut particular = [[zero; 6]; 7];
    let mut null = [[zero; 7]; MOST];
    for (k, &column) in pivots[..rank].iter().enumerate() {
        particular[column] = combination[k];
        for (a, &open) in free[..left].iter().enumerate() {
            null[a][column] = arithmetic.neg(rows[k][open]);
        }
    }
    for (a, &open) in free[..left].iter().enumerate() {
        null[a][open] = one;
    }
    let mut dropped = [[zero; 6]; MOST - 1];
    for (target, source) in dropped.iter_mut().zip(&combination[rank..]) {
        *target = *source;
    }
    Some(Directions { rank, count: left, particular, null, dropped, slopes: [[zero; MOST]; MOST - 1] })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elimination::border::Reals;

    /// Checks that `K u` for `u = particular c + sum_a tau_a null_a` is c up to the conditions left.
    fn check(matrix: &[[f64; 7]; 6], directions: &Directions<f64>) {
        let c = [0.3, -1.0, 0.7, 2.0, -0.4, 1.1];
        let tau = [0.9, -0.6, 0.8, 0.5];
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        let u: [f64; 7] = std::array::from_fn(|k| {
            let along: f64 = (0..directions.count).map(|a| tau[a] * directions.null[a][k]).sum();
            dot(&directions.particular[k], &c) + along
        });
        let defect: [f64; 6] = std::array::from_fn(|i| c[i] - dot(&matrix[i], &u));
        // The defect lies in the span of the conditions: combining the legs that way gives the sides of the conditions.
        for a in 0..directions.count - 1 {
            let combined: [f64; 7] =
                std::array::from_fn(|k| (0..6).map(|i| directions.dropped[a][i] * matrix[i][k]).sum());
            let slope = dot(&directions.slopes[a], &tau);
            assert!((dot(&combined, &u) - slope).abs() < 1e-12);
        }
        if directions.count == 1 {
            assert!(defect.iter().all(|d| d.abs() < 1e-12), "{defect:?}");
        }
    }

    fn matrix(height: f64) -> [[f64; 7]; 6] {
        std::array::from_fn(|i| {
            let angle = |k: usize| ((3 * i + 5 * k * k + i * i * k) as f64).sin();
            [1.0, angle(1), angle(2), height * angle(3), angle(4), angle(5), height * angle(6)]
        })
    }

    #[test]
    fn both_ways_solve_the_legs() {
        for (height, rank) in [(1.0, 6), (1e-6, 6), (0.0, 5)] {
            let matrix = matrix(height);
            let directions = weak_directions(&matrix);
            assert_eq!(directions.rank, rank);
            assert!(directions.count == 1 || height < 1.0, "{}", directions.count);
            check(&matrix, &directions);
        }
        let matrix = matrix(1.0);
        let exact = exact_directions(&Reals, |x| (x != 0.0).then(|| 1.0 / x), &matrix).unwrap();
        assert_eq!((exact.rank, exact.count), (6, 1));
        check(&matrix, &exact);
    }
}
