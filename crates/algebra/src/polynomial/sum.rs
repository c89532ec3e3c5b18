//! Sums, by merging sorted terms.

use super::Polynomial;
use crate::ring::Ring;
use std::cmp::Ordering;

impl<R: Ring> Polynomial<R> {
    /// Returns the sum or difference: `lone` maps a term of `other` alone, `both` two with the same monomial.
    pub(super) fn merge(&self, other: &Self, lone: impl Fn(&R) -> R, both: impl Fn(&R, &R) -> R) -> Self {
        if other.is_zero() {
            return self.clone();
        }
        let packing = self.joint_packing(other);
        let (left, right) = (self.packed_as(packing), other.packed_as(packing));
        let words = packing.words();
        let mut monomials = Vec::with_capacity(left.len() + right.len());
        let mut coefficients = Vec::with_capacity(self.len() + other.len());
        let (mut i, mut j) = (0, 0);
        while i < self.len() && j < other.len() {
            let (a, b) = (&left[i * words..(i + 1) * words], &right[j * words..(j + 1) * words]);
            match if words == 1 { a[0].cmp(&b[0]) } else { a.cmp(b) } {
                Ordering::Greater => {
                    monomials.extend_from_slice(a);
                    coefficients.push(self.coefficients[i].clone());
                    i += 1;
                }
                Ordering::Less => {
                    monomials.extend_from_slice(b);
                    coefficients.push(lone(&other.coefficients[j]));
                    j += 1;
                }
                Ordering::Equal => {
                    let sum = both(&self.coefficients[i], &other.coefficients[j]);
                    if !sum.is_zero() {
                        monomials.extend_from_slice(a);
                        coefficients.push(sum);
                    }
                    (i, j) = (i + 1, j + 1);
                }
            }
        }
        monomials.extend_from_slice(&left[i * words..]);
        coefficients.extend_from_slice(&self.coefficients[i..]);
        monomials.extend_from_slice(&right[j * words..]);
        coefficients.extend(other.coefficients[j..].iter().map(lone));
        Self { packing, monomials, coefficients }
    }
}
