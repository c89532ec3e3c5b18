//! The characteristic polynomial of a matrix modulo a prime, by its Hessenberg form.

use super::border::Arithmetic;
use crate::algebra::modp::Modulus;

/// Coefficients of `det(x - matrix)`, constant term first; the matrix is used up. Residues in Montgomery form.
#[must_use]
pub fn characteristic_polynomial(modulus: &Modulus, matrix: &mut [Vec<u64>]) -> Vec<u64> {
    let n = matrix.len();
    reduce(modulus, matrix);
    // Those of the leading blocks: p_k = (x - h_kk) p_{k-1} - sum_i h_ik (h_{i+1,i} ... h_{k,k-1}) p_{i-1}.
    let mut leading: Vec<Vec<u64>> = vec![vec![modulus.enter(1)]];
    for k in 0..n {
        let mut p = vec![0; k + 2];
        p[1..].copy_from_slice(&leading[k]);
        modulus.add_multiple(&mut p[..=k], modulus.neg(matrix[k][k]), &leading[k]);
        let mut product = modulus.enter(1);
        for i in (0..k).rev() {
            product = modulus.mul(product, matrix[i + 1][i]);
            if product == 0 {
                break;
            }
            let factor = modulus.neg(modulus.mul(product, matrix[i][k]));
            modulus.add_multiple(&mut p[..=i], factor, &leading[i]);
        }
        leading.push(p);
    }
    leading.pop().unwrap_or_default()
}

/// Similar upper Hessenberg form, by elimination.
fn reduce(modulus: &Modulus, matrix: &mut [Vec<u64>]) {
    let n = matrix.len();
    for column in 0..n.saturating_sub(2) {
        let target = column + 1;
        let Some(pivot) = (target..n).find(|&i| matrix[i][column] != 0) else { continue };
        if pivot != target {
            matrix.swap(pivot, target);
            for row in matrix.iter_mut() {
                row.swap(pivot, target);
            }
        }
        let inverse = modulus.inverse(matrix[target][column]);
        let (head, tail) = matrix.split_at_mut(target + 1);
        let pivot_row = &head[target];
        let mut factors = vec![0; n];
        for (i, row) in tail.iter_mut().enumerate() {
            let factor = modulus.mul(row[column], inverse);
            factors[target + 1 + i] = factor;
            modulus.add_multiple(&mut row[column..], modulus.neg(factor), &pivot_row[column..]);
        }
        // The inverse operations from the right.
        for row in matrix.iter_mut() {
            let mut sum = [row[target]];
            let terms = row.chunks_exact(1).zip(&factors).skip(target + 1).map(|(x, &factor)| (factor, x));
            modulus.add_combination(&mut sum, terms);
            row[target] = sum[0];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_companion_matrix_has_its_polynomial_and_so_have_matrices_similar_to_it() {
        let modulus = Modulus::new(crate::algebra::modp::PRIME_61);
        let n = 7;
        let coefficients: Vec<u64> = (0..n).map(|k| modulus.enter(3 + 5 * k as u64 * k as u64)).collect();
        let mut matrix = vec![vec![0; n]; n];
        for k in 0..n {
            if k + 1 < n {
                matrix[k + 1][k] = modulus.enter(1);
            }
            matrix[k][n - 1] = modulus.neg(coefficients[k]);
        }
        // Adding a multiple of row i to row j and the opposite multiple of column j to column i keeps the polynomial.
        for (i, j, c) in [(0, 4, 7), (6, 1, 2), (3, 5, 11), (5, 0, 4), (2, 6, 3)] {
            let c = modulus.enter(c);
            let row = matrix[i].clone();
            modulus.add_multiple(&mut matrix[j], c, &row);
            for row in &mut matrix {
                row[i] = Modulus::sub(&modulus, row[i], Modulus::mul(&modulus, c, row[j]));
            }
        }
        let mut expected = coefficients;
        expected.push(modulus.enter(1));
        assert_eq!(characteristic_polynomial(&modulus, &mut matrix), expected);
        // A matrix in blocks: of zeros, x^2.
        assert_eq!(characteristic_polynomial(&modulus, &mut [vec![0, 0], vec![0, 0]]), [0, 0, modulus.enter(1)]);
    }
}
