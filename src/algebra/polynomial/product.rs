//! Products, by the method that the planner expects to be fastest.

use super::blocks::{self, Accumulator, Blocks, Grid};
use super::heap::Key;
use super::{Polynomial, Size};
use crate::algebra::monomial::Packing;
use crate::algebra::ring::Ring;

/// Up to so many products of terms are sorted.
const FEW: usize = 1024;
/// Cells of a box: their sums stay in the second-level cache.
const CELLS: usize = 1 << 14;

/// The coefficients as machine words, if all are such.
pub(super) fn words<R: Ring>(coefficients: &[R]) -> Option<Vec<i64>> {
    coefficients.iter().map(R::to_word).collect()
}

/// A bound of the absolute values of the coefficients of the product, and of all sums on the way there.
pub(super) fn bound(a: &[i64], b: &[i64]) -> u128 {
    let norms = |words: &[i64]| {
        let sizes = || words.iter().map(|n| u128::from(n.unsigned_abs()));
        (sizes().sum::<u128>(), sizes().max().unwrap_or(0))
    };
    let ((sum_a, max_a), (sum_b, max_b)) = (norms(a), norms(b));
    sum_a.saturating_mul(max_b).min(sum_b.saturating_mul(max_a))
}

impl<R: Ring> Polynomial<R> {
    /// How large the product may become.
    #[must_use]
    pub fn product_size(&self, other: &Self) -> Size {
        if self.is_zero() || other.is_zero() {
            return Size { terms: 0, largest_exponent: 0 };
        }
        let variables = self.variables().max(other.variables());
        let degrees = (0..variables).map(|v| u64::from(self.degree(v)) + u64::from(other.degree(v)));
        let pairs = (self.len() as u64).saturating_mul(other.len() as u64);
        let cells = degrees.clone().fold(1_u64, |cells, degree| cells.saturating_mul(degree + 1));
        Size { terms: pairs.min(cells), largest_exponent: degrees.max().unwrap_or(0) }
    }

    /// The product; neither polynomial is copied unless their packing differs.
    pub(super) fn product(&self, other: &Self) -> Self {
        let (left, right) = if self.len() <= other.len() { (self, other) } else { (other, self) };
        if left.is_zero() {
            return Self::zero();
        }
        let packing = left.product_packing(right);
        let (a, b) = (left.packed_as(packing), right.packed_as(packing));
        if left.len() == 1 {
            return right.shifted(packing, &b, &a, &left.coefficients[0]);
        }
        if packing.words() == 1 && left.len() * right.len() <= FEW {
            return left.sorted_product(right, packing, &a, &b);
        }
        let (monomials, coefficients) = match packing.words() {
            1 => left.collected_product::<u64>(right, packing, &a, &b),
            2 => left.collected_product::<[u64; 2]>(right, packing, &a, &b),
            _ => left.collected_product::<Box<[u64]>>(right, packing, &a, &b),
        };
        Self { packing, monomials, coefficients }
    }

    /// A packing with room for the product.
    fn product_packing(&self, other: &Self) -> Packing {
        let joint = self.joint_packing(other);
        if self.packing == other.packing && joint.holds_products(&self.monomials, &other.monomials) {
            return joint;
        }
        let largest = self.product_size(other).largest_exponent;
        if largest <= u64::from(joint.largest()) {
            return joint;
        }
        Packing::new(joint.variables(), u32::try_from(largest).unwrap_or(u32::MAX))
    }

    /// The product with one term.
    fn shifted(&self, packing: Packing, own: &[u64], monomial: &[u64], c: &R) -> Self {
        let monomials = if let [word] = monomial {
            own.iter().map(|own| own + word).collect()
        } else {
            own.chunks_exact(monomial.len()).flat_map(|own| own.iter().zip(monomial).map(|(a, b)| a + b)).collect()
        };
        Self::from_sorted(packing, monomials, self.coefficients.iter().map(|own| own.mul(c)).collect())
    }

    /// Schoolbook: all products of terms, sorted.
    fn sorted_product(&self, other: &Self, packing: Packing, left: &[u64], right: &[u64]) -> Self {
        // Monomial and place in one integer sort faster than a pair.
        let mut pairs: Vec<u128> = Vec::with_capacity(left.len() * right.len());
        for (i, a) in left.iter().enumerate() {
            for (j, b) in right.iter().enumerate() {
                pairs.push(u128::from(a + b) << 64 | (i << 32 | j) as u128);
            }
        }
        pairs.sort_unstable();
        let (mut monomials, mut coefficients) = (Vec::with_capacity(pairs.len()), Vec::with_capacity(pairs.len()));
        let mut pairs =
            pairs.into_iter().rev().map(|pair| ((pair >> 64) as u64, (pair >> 32) as u32, pair as u32)).peekable();
        while let Some((monomial, i, j)) = pairs.next() {
            let mut sum = self.coefficients[i as usize].mul(&other.coefficients[j as usize]);
            while let Some((_, i, j)) = pairs.next_if(|pair| pair.0 == monomial) {
                sum.add_product(&self.coefficients[i as usize], &other.coefficients[j as usize]);
            }
            if !sum.is_zero() {
                monomials.push(monomial);
                coefficients.push(sum);
            }
        }
        Self { packing, monomials, coefficients }
    }

    /// By heap and box, with sums in the shortest integers that hold them.
    fn collected_product<K: Key>(
        &self,
        other: &Self,
        packing: Packing,
        left: &[u64],
        right: &[u64],
    ) -> (Vec<u64>, Vec<R>) {
        let sum = |variable| self.degree(variable) + other.degree(variable);
        let degrees: Vec<u32> = (0..packing.variables()).map(sum).collect();
        let grid = Grid::new(packing, &degrees, CELLS.min(self.len().saturating_mul(other.len())));
        let exact = |sum: R| sum;
        if let Some((a, b)) = words(&self.coefficients).zip(words(&other.coefficients)) {
            let bound = bound(&a, &b);
            if bound < 1 << 63 {
                return collect::<K, i64, i64, R>(&grid, (left, &a), (right, &b), &degrees, |n| {
                    R::from_wide(i128::from(n))
                });
            }
            if bound < 1 << 127 {
                return collect::<K, i64, i128, R>(&grid, (left, &a), (right, &b), &degrees, R::from_wide);
            }
        }
        collect::<K, R, R, R>(&grid, (left, &self.coefficients), (right, &other.coefficients), &degrees, exact)
    }
}

fn collect<K: Key, C, A: Accumulator<C>, R>(
    grid: &Grid,
    (left, a): (&[u64], &[C]),
    (right, b): (&[u64], &[C]),
    degrees: &[u32],
    finish: impl Fn(A) -> R,
) -> (Vec<u64>, Vec<R>) {
    let left = Blocks::<K, C>::new(grid, left, a);
    let right = Blocks::<K, C>::new(grid, right, b);
    // How many boxes there will be at most, and how full they are then.
    let boxes = degrees[..grid.leading()].iter().fold(1.0, |cells, &degree| cells * (f64::from(degree) + 1.0));
    let boxes = boxes.min(left.len() as f64 * right.len() as f64);
    let cells = degrees[grid.leading()..].iter().fold(1.0, |cells, &degree| cells * (f64::from(degree) + 1.0));
    if a.len() as f64 * b.len() as f64 >= boxes * cells {
        blocks::product::<K, C, A, R, false>(grid, &left, &right, finish)
    } else {
        blocks::product::<K, C, A, R, true>(grid, &left, &right, finish)
    }
}
