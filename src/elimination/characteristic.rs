//! The characteristic polynomial of a matrix over a field, by its Hessenberg form.

use super::border::Arithmetic;

/// Returns the coefficients of `det(x - matrix)`, constant term first; the matrix is overwritten. `None` where `inverse` does not
/// exist for a number that is not 0, which can happen for residues modulo several primes.
#[must_use]
pub fn characteristic_polynomial<A: Arithmetic>(
    field: &A,
    inverse: impl Fn(A::Element) -> Option<A::Element>,
    matrix: &mut [Vec<A::Element>],
) -> Option<Vec<A::Element>> {
    let (n, zero) = (matrix.len(), field.zero());
    reduce(field, inverse, matrix)?;
    // Polynomials of the leading blocks: p_k = (x - h_kk) p_{k-1} - sum_i h_ik (h_{i+1,i} ... h_{k,k-1}) p_{i-1}.
    let mut leading: Vec<Vec<A::Element>> = vec![vec![field.one()]];
    for k in 0..n {
        let mut p = vec![zero; k + 2];
        p[1..].copy_from_slice(&leading[k]);
        field.add_multiple(&mut p[..=k], field.neg(matrix[k][k]), &leading[k]);
        let mut product = field.one();
        for i in (0..k).rev() {
            product = field.mul(product, matrix[i + 1][i]);
            if product == zero {
                break;
            }
            let factor = field.neg(field.mul(product, matrix[i][k]));
            field.add_multiple(&mut p[..=i], factor, &leading[i]);
        }
        leading.push(p);
    }
    leading.pop()
}

/// Similar upper Hessenberg form, by elimination.
fn reduce<A: Arithmetic>(
    field: &A,
    inverse: impl Fn(A::Element) -> Option<A::Element>,
    matrix: &mut [Vec<A::Element>],
) -> Option<()> {
    let (n, zero) = (matrix.len(), field.zero());
    for column in 0..n.saturating_sub(2) {
        let target = column + 1;
        let Some(pivot) = (target..n).find(|&i| matrix[i][column] != zero) else { continue };
        if pivot != target {
            matrix.swap(pivot, target);
            for row in matrix.iter_mut() {
                row.swap(pivot, target);
            }
        }
        let inverse = inverse(matrix[target][column])?;
        let (head, tail) = matrix.split_at_mut(target + 1);
        let pivot_row = &head[target];
        let mut factors = vec![zero; n];
        for (i, row) in tail.iter_mut().enumerate() {
            let factor = field.mul(row[column], inverse);
            factors[target + 1 + i] = factor;
            field.add_multiple(&mut row[column..], field.neg(factor), &pivot_row[column..]);
        }
        // The inverse operations from the right.
        for row in matrix.iter_mut() {
            let mut sum = [row[target]];
            let terms = row.chunks_exact(1).zip(&factors).skip(target + 1).map(|(x, &factor)| (factor, x));
            field.add_combination(&mut sum, terms);
            row[target] = sum[0];
        }
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::modp::Modulus;

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
        let polynomial = |matrix: &mut [Vec<u64>]| {
            characteristic_polynomial(&modulus, |x| (x != 0).then(|| modulus.inverse(x)), matrix).unwrap()
        };
        assert_eq!(polynomial(&mut matrix), expected);
        // A matrix in blocks: of zeros, x^2.
        assert_eq!(polynomial(&mut [vec![0, 0], vec![0, 0]]), [0, 0, modulus.enter(1)]);
    }
}
