//! Products, by the method that the planner expects to be fastest.

use super::blocks::{self, Accumulator, Blocks, Grid};
use super::heap::Key;
use super::{Polynomial, Size};
use crate::algebra::monomial::Packing;
use crate::algebra::ring::Ring;

/// Up to so many products of terms are sorted.
const FEW: usize = 1024;
/// Cells of a box: their sums stay in the second-level cache.
pub(super) const CELLS: usize = 1 << 14;

/// The coefficients as machine words, if all are such.
pub(super) fn to_words<R: Ring>(coefficients: &[R]) -> Option<Vec<i64>> {
    coefficients.iter().map(|c| i64::try_from(c.to_wide()?).ok()).collect()
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
        left.collected_product(right, packing, &a, &b)
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
    fn collected_product(&self, other: &Self, packing: Packing, left: &[u64], right: &[u64]) -> Self {
        let sum = |variable| self.degree(variable) + other.degree(variable);
        let degrees: Vec<u32> = (0..packing.variables()).map(sum).collect();
        let grid = Grid::new(packing, &degrees, CELLS.min(self.len().saturating_mul(other.len())));
        let mut coefficients = Vec::new();
        let integers = to_words(&self.coefficients).zip(to_words(&other.coefficients));
        let integers = integers.map(|(a, b)| (bound(&a, &b), a, b)).filter(|(bound, _, _)| *bound < 1 << 127);
        let monomials = if let Some((bound, a, b)) = integers {
            if bound < 1 << 63 {
                collect(&grid, &degrees, (left, &a), (right, &b), &mut |n: i64| {
                    coefficients.push(R::from_wide(n.into()))
                })
            } else {
                collect(&grid, &degrees, (left, &a), (right, &b), &mut |n: i128| coefficients.push(R::from_wide(n)))
            }
        } else {
            let (a, b) = (&self.coefficients[..], &other.coefficients[..]);
            collect(&grid, &degrees, (left, a), (right, b), &mut |sum: R| coefficients.push(sum))
        };
        coefficients.shrink_to_fit();
        Self { packing, monomials, coefficients }
    }
}

/// The product of terms by heap and box: the monomials, and by `take` the coefficients.
fn collect<C, A: Accumulator<C>>(
    grid: &Grid,
    degrees: &[u32],
    left: (&[u64], &[C]),
    right: (&[u64], &[C]),
    take: &mut dyn FnMut(A),
) -> Vec<u64> {
    match grid.words() {
        1 => collect_by::<u64, C, A>(grid, degrees, left, right, take),
        2 => collect_by::<[u64; 2], C, A>(grid, degrees, left, right, take),
        _ => collect_by::<Box<[u64]>, C, A>(grid, degrees, left, right, take),
    }
}

fn collect_by<K: Key, C, A: Accumulator<C>>(
    grid: &Grid,
    degrees: &[u32],
    (left, a): (&[u64], &[C]),
    (right, b): (&[u64], &[C]),
    take: &mut dyn FnMut(A),
) -> Vec<u64> {
    let left = Blocks::<K, C>::new(grid, left, a);
    let right = Blocks::<K, C>::new(grid, right, b);
    // How many boxes there will be at most, and how full they are then.
    let volume = |degrees: &[u32]| degrees.iter().fold(1.0, |cells, &degree| cells * (f64::from(degree) + 1.0));
    let (outer, inner) = degrees.split_at(grid.leading());
    let boxes = volume(outer).min(left.len() as f64 * right.len() as f64);
    if a.len() as f64 * b.len() as f64 >= boxes * volume(inner) {
        blocks::product::<K, C, A, false>(grid, &left, &right, take)
    } else {
        blocks::product::<K, C, A, true>(grid, &left, &right, take)
    }
}
