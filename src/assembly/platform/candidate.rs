//! From a rotation to the poses that may belong to it.

use crate::closure::study::{Form, Four, left, right, scalar};
use crate::elimination::border::Setting;
use crate::solve::scalar::Scalar;

/// Below this size of the last direction (relative to the first) the translation is not determined by the linear
/// equations alone: the two mirror poses of plane platforms share one rotation.
const LOOSE: f64 = 1e-3;

/// Up to three candidates for Study's parameters (x, y), with any common factor.
pub struct Candidates<S> {
    /// The candidates; `count` are in use.
    pub study: [(Four<S>, Four<S>); 3],
    /// Number of candidates.
    pub count: usize,
}

/// Returns `z^T form z`.
fn quadratic<S: Scalar>(form: &Form<f64>, products: &[S; 10]) -> S {
    let mut sum = S::zero();
    let mut k = 0;
    for i in 0..4 {
        for j in i..4 {
            let weight = if i == j { form[i][i] } else { 2.0 * form[i][j] };
            sum = sum.add(&products[k].times(weight));
            k += 1;
        }
    }
    sum
}

/// Returns `p x` (or `x p`) for a pure quaternion p.
fn product<S: Scalar>(matrix: &Form<S>, x: &Four<S>) -> Four<S> {
    std::array::from_fn(|i| scalar(&matrix[i], x))
}

/// Returns `p x - x q` from `u = (s, p, q)`.
fn mismatch<S: Scalar>(u: &[S; 7], x: &Four<S>) -> Four<S> {
    let (before, behind) = (product(&left(&[u[1], u[2], u[3]]), x), product(&right(&[u[4], u[5], u[6]]), x));
    std::array::from_fn(|i| before[i].sub(&behind[i]))
}

fn dot<S: Scalar>(a: &Four<S>, b: &Four<S>) -> S {
    (0..4).fold(S::zero(), |sum, i| sum.add(&a[i].conjugate().mul(&b[i])))
}

/// Returns the poses of a rotation x: the unknowns tau from `sum_a tau_a (n_pa x - x n_qa) = x q0 - p0 x` by least squares; where
/// these leave one direction open, also from `p.p + q.q = 2 N s` along it.
pub fn candidates<S: Scalar>(setting: &Setting<f64>, x: &Four<S>) -> Candidates<S> {
    let norm = scalar(x, x);
    let products: [S; 10] = {
        let mut all = [S::zero(); 10];
        let mut k = 0;
        for i in 0..4 {
            for j in i..4 {
                all[k] = x[i].mul(&x[j]);
                k += 1;
            }
        }
        all
    };
    let u: [S; 7] = std::array::from_fn(|k| quadratic(&setting.forms[k], &products));
    let null: [[S; 7]; 4] = setting.null.map(|n| n.map(S::from_f64));
    let count = setting.count;
    // Gram-Schmidt with the largest column first.
    let mut columns: [Four<S>; 4] = std::array::from_fn(|a| mismatch(&null[a], x));
    let mut order = [0, 1, 2, 3];
    let mut rest = mismatch(&u, x).map(|z| z.neg());
    let mut triangle = [[S::zero(); 4]; 4];
    let mut right_side = [S::zero(); 4];
    let mut pivots = [0.0; 4];
    for k in 0..count {
        let size = |a: usize| columns[a].iter().map(|z| z.size() * z.size()).sum::<f64>();
        let best = (k..count).fold(k, |best, a| if size(a) > size(best) { a } else { best });
        columns.swap(k, best);
        order.swap(k, best);
        for row in &mut triangle[..k] {
            row.swap(k, best);
        }
        let length = dot(&columns[k], &columns[k]).to_complex().re.sqrt();
        pivots[k] = length;
        let scale = 1.0 / length.max(f64::MIN_POSITIVE);
        triangle[k][k] = S::from_f64(length);
        columns[k] = columns[k].map(|z| z.times(scale));
        for a in k + 1..count {
            let along = dot(&columns[k], &columns[a]);
            triangle[k][a] = along;
            for i in 0..4 {
                columns[a][i] = columns[a][i].sub(&along.mul(&columns[k][i]));
            }
        }
        right_side[k] = dot(&columns[k], &rest);
        for i in 0..4 {
            rest[i] = rest[i].sub(&right_side[k].mul(&columns[k][i]));
        }
    }
    let reach = x.iter().map(|z| z.size()).fold(0.0, f64::max).max(pivots[0]);
    let loose = !(pivots[count - 1] > LOOSE * reach);
    let solve = |used: usize, right_side: &[S; 4]| {
        let mut tau = [S::zero(); 4];
        for k in (0..used).rev() {
            let sum = (k + 1..used).fold(right_side[k], |sum, a| sum.sub(&triangle[k][a].mul(&tau[a])));
            tau[k] = if pivots[k] > 0.0 { sum.times(1.0 / pivots[k]) } else { S::zero() };
        }
        tau
    };
    let translated = |tau: &[S; 4]| {
        let mut moved = u;
        for k in 0..count {
            for (m, n) in moved.iter_mut().zip(&null[order[k]]) {
                *m = m.add(&tau[k].mul(n));
            }
        }
        moved
    };
    // `p x / N` times N avoids the division by a norm that may vanish.
    let pose = |u: &[S; 7]| (x.map(|z| z.mul(&norm)), product(&left(&[u[1], u[2], u[3]]), x));
    let first = translated(&solve(count, &right_side));
    let mut found = Candidates { study: [pose(&first); 3], count: 1 };
    if loose {
        let base = translated(&solve(count - 1, &right_side));
        let open = triangle.map(|row| row[count - 1].neg());
        let mut direction = solve(count - 1, &open);
        direction[count - 1] = S::one();
        let mut along = [S::zero(); 7];
        for k in 0..count {
            for (m, n) in along.iter_mut().zip(&null[order[k]]) {
                *m = m.add(&direction[k].mul(n));
            }
        }
        let pair = |a: &[S; 7], b: &[S; 7]| (1..7).fold(S::zero(), |sum, k| sum.add(&a[k].mul(&b[k])));
        let alpha = pair(&along, &along);
        let half_beta = pair(&base, &along).sub(&norm.mul(&along[0]));
        let gamma = pair(&base, &base).sub(&norm.mul(&base[0]).times(2.0));
        let discriminant = half_beta.mul(&half_beta).sub(&alpha.mul(&gamma));
        let root = discriminant.root();
        for sign in [1.0, -1.0] {
            let c = root.times(sign).sub(&half_beta).over(alpha);
            let u: [S; 7] = std::array::from_fn(|k| base[k].add(&c.mul(&along[k])));
            if c.to_complex().is_finite() {
                found.study[found.count] = pose(&u);
                found.count += 1;
            }
        }
    }
    found
}
