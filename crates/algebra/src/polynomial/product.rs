//! Products, by the method that the planner expects to be fastest.

use super::blocks::{self, Accumulator, Blocks, Grid, Triple};
use super::kronecker::{Kronecker, Numbers};
use super::limbs::{Factor, Sum};
use super::planes::{Planes, Sums};
use super::{Polynomial, Size, line, scattered, short};
use crate::int::Int;
use crate::monomial::Packing;
use crate::ring::Ring;
use rug::Integer;
use std::borrow::Cow;

/// Maximum number of products of terms that are sorted.
const FEW: usize = 1024;
/// The number of them from which on they are collected in a box if they fill it.
const DENSE: usize = 128;
/// The fewest products of terms that are worth a look at how many of the possible terms there are; and the nanoseconds that one takes where
/// they are added up one by one.
const FILLED: usize = 400;
const PAIR: f64 = 1.2;
/// Cells of a box: their sums stay in the first-level cache, or nearly so.
pub(super) const CELLS: usize = 1 << 12;
/// The most terms of a block, on the average, for which a box is worth nothing.
const MOST_IN_BLOCKS: usize = 2;
/// Nanoseconds of a product that need no other way than the box.
const SHORT: f64 = 1e3;
/// Sums below these fit an i64, and an i128.
const HALF: u128 = 1 << 63;
/// Words of a factor that is collected in words, enough for 57 decimal digits; and of a sum: those of a product, and one for the sign and the sum of
/// fewer than `2^63` products.
const FACTOR: usize = 3;
const SUM: usize = 2 * FACTOR + 1;
const WHOLE: u128 = 1 << 127;

/// Returns the coefficients as machine words, if all are such.
pub(super) fn to_words<R: Ring>(coefficients: &[R]) -> Option<Vec<i64>> {
    // With room from the start, which collecting would not make.
    let mut words = Vec::with_capacity(coefficients.len());
    for c in coefficients {
        words.push(c.to_word()?);
    }
    Some(words)
}

/// Returns the coefficients as big integers, if they are integers; those of most rings are not, which the first one tells.
pub(super) fn to_large<R: Ring>(coefficients: &[R]) -> Option<Vec<Cow<'_, Integer>>> {
    coefficients.iter().map(Ring::to_large).collect()
}

/// Returns the nanoseconds that a product of two terms takes, and adding it in its place: measured, on a processor of 3 GHz.
fn pair_cost(bound: Option<u128>, short: bool, a: &Numbers, b: &Numbers) -> f64 {
    match bound {
        Some(..HALF) => 0.65,
        Some(..WHOLE) => 1.05,
        Some(_) => 1.8,
        None if short => 9.0,
        None => 20.0 + 1.5 * (a.bits() / 64 + 1) as f64 * (b.bits() / 64 + 1) as f64,
    }
}

/// Returns a bound of the absolute values of the coefficients of the product, and of all sums on the way there.
pub(super) fn bound(a: &[i64], b: &[i64]) -> u128 {
    let norms = |words: &[i64]| {
        let sizes = || words.iter().map(|n| u128::from(n.unsigned_abs()));
        (sizes().sum::<u128>(), sizes().max().unwrap_or(0))
    };
    let ((sum_a, max_a), (sum_b, max_b)) = (norms(a), norms(b));
    sum_a.saturating_mul(max_b).min(sum_b.saturating_mul(max_a))
}

/// Returns the coefficients as integers of any size, if they are such; those of most rings are not, which the first one tells.
fn to_ints<R: Ring>(coefficients: &[R]) -> Option<Vec<&Int>> {
    coefficients.iter().map(Ring::as_int).collect()
}

/// Returns a bound of the bits of the coefficients of the product, and of all sums on the way there.
fn bits_of_product(a: &[&Int], b: &[&Int]) -> u32 {
    let bits = |c: &&Int| match c.to_i64() {
        Some(n) => u64::BITS - n.unsigned_abs().leading_zeros(),
        None => c.to_large().map_or(0, |n| n.significant_bits()),
    };
    let longest = |coefficients: &[&Int]| coefficients.iter().map(bits).max().unwrap_or(0);
    let terms = usize::BITS - a.len().min(b.len()).leading_zeros();
    longest(a) + longest(b) + terms
}

impl<R: Ring> Polynomial<R> {
    /// Returns a bound on the size of the product.
    #[must_use]
    pub fn product_size(&self, other: &Self) -> Size {
        if self.is_zero() || other.is_zero() {
            return Size { terms: 0, largest_exponent: 0 };
        }
        let variables = self.variables().max(other.variables());
        let (own, others) = (self.degrees(), other.degrees());
        let of = |degrees: &[u32], variable: usize| u64::from(degrees.get(variable).copied().unwrap_or(0));
        let degrees = (0..variables).map(|v| of(&own, v) + of(&others, v));
        let pairs = (self.len() as u64).saturating_mul(other.len() as u64);
        let cells = degrees.clone().fold(1_u64, |cells, degree| cells.saturating_mul(degree + 1));
        Size { terms: pairs.min(cells), largest_exponent: degrees.max().unwrap_or(0) }
    }

    /// Returns the product; neither polynomial is copied unless their packing differs.
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
        if packing.words() == 1
            && let factors = ((&a[..], &left.coefficients[..]), (&b[..], &right.coefficients[..]))
            && let Some((monomials, coefficients)) = line::product(packing, factors.0, factors.1)
        {
            return Self::from_sorted(packing, monomials, coefficients);
        }
        if packing.words() == 1 && left.len() == 2 {
            return left.merged_product(right, packing, &a, &b);
        }
        if let Some(product) = left.short_product(right, packing, &a, &b) {
            return product;
        }
        if packing.words() == 1 && left.len() * right.len() <= FEW && !left.fills_box(right) {
            return left.sorted_product(right, packing, &a, &b);
        }
        left.collected_product(right, packing, &a, &b)
    }

    /// Returns the product of few terms with short coefficients.
    fn short_product(&self, other: &Self, packing: Packing, left: &[u64], right: &[u64]) -> Option<Self> {
        if packing.words() != 1 || self.len() * other.len() > short::MOST {
            return None;
        }
        let degrees = || self.degrees_of_product(other, packing);
        if let Some(product) = self.filled_product(other, packing, left, right) {
            return Some(product);
        }
        if let Some((a, b)) = to_words(&self.coefficients).zip(to_words(&other.coefficients))
            && let Some((monomials, words)) = short::product(packing, &degrees, (left, &a), (right, &b))
        {
            return Some(Self { packing, monomials, coefficients: words.into_iter().map(R::from_word).collect() });
        }
        let (a, b) = (to_ints(&self.coefficients)?, to_ints(&other.coefficients)?);
        let (monomials, integers) =
            short::wide_product(packing, &degrees, (left, &a), (right, &b), bits_of_product(&a, &b))?;
        Some(Self { packing, monomials, coefficients: integers.into_iter().map(Int::into_ring).collect() })
    }

    /// Returns the product of few terms that fill most of what their degrees allow, as one product of long integers.
    fn filled_product(&self, other: &Self, packing: Packing, left: &[u64], right: &[u64]) -> Option<Self> {
        let pairs = left.len() * right.len();
        if pairs < FILLED {
            return None;
        }
        let degrees = self.degrees_of_product(other, packing);
        if degrees.iter().fold(1, |cells: usize, degree| cells.saturating_mul(*degree as usize + 1)) > pairs {
            return None;
        }
        let (a, b) = to_words(&self.coefficients).zip(to_words(&other.coefficients))?;
        let (a, b) = (Numbers::Words(&a), Numbers::Words(&b));
        let (left, right) = ((left, &a), (right, &b));
        let substitution = Kronecker::new(packing, &degrees, left, right)?;
        if substitution.cost() > PAIR * pairs as f64 {
            return None;
        }
        let (monomials, coefficients) = substitution.product(left, right);
        Some(Self { packing, monomials, coefficients })
    }

    fn degrees_of_product(&self, other: &Self, packing: Packing) -> Vec<u32> {
        let (own, others) = (self.degrees(), other.degrees());
        let of = |degrees: &[u32], variable: usize| degrees.get(variable).copied().unwrap_or(0);
        (0..packing.variables()).map(|v| of(&own, v) + of(&others, v)).collect()
    }

    /// Returns whether coefficients are integers and many of the monomials that the degrees of the product allow occur in it.
    fn fills_box(&self, other: &Self) -> bool {
        let pairs = self.len() * other.len();
        pairs >= DENSE && R::zero().to_wide().is_some() && {
            let (own, others) = (self.degrees(), other.degrees());
            let (long, short) = if own.len() < others.len() { (others, own) } else { (own, others) };
            let degree = |(v, degree): (usize, &u32)| (degree + short.get(v).unwrap_or(&0)) as usize + 1;
            long.iter().enumerate().map(degree).fold(1, usize::saturating_mul) <= 2 * pairs
        }
    }

    /// Returns a packing with room for the product.
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

    /// Returns the product with one term.
    fn shifted(&self, packing: Packing, own: &[u64], monomial: &[u64], c: &R) -> Self {
        let monomials = if let [word] = monomial {
            own.iter().map(|own| own + word).collect()
        } else {
            own.chunks_exact(monomial.len()).flat_map(|own| own.iter().zip(monomial).map(|(a, b)| a + b)).collect()
        };
        Self::from_sorted(packing, monomials, self.coefficients.iter().map(|own| own.mul(c)).collect())
    }

    /// Returns the product of two terms with a polynomial: two sorted lists, merged.
    fn merged_product(&self, other: &Self, packing: Packing, left: &[u64], right: &[u64]) -> Self {
        let (mut monomials, mut coefficients) = (Vec::new(), Vec::new());
        monomials.reserve(2 * right.len());
        coefficients.reserve(2 * right.len());
        let (a, b) = (&self.coefficients[0], &self.coefficients[1]);
        let (mut i, mut j) = (0, 0);
        // The first list begins higher, and ends first.
        while j < right.len() {
            let lower = left[1] + right[j];
            let upper = right.get(i).map_or(0, |monomial| left[0] + monomial);
            let (from_upper, from_lower) = (i < right.len() && upper >= lower, i == right.len() || upper <= lower);
            let mut c = if from_lower { b.mul(&other.coefficients[j]) } else { a.mul(&other.coefficients[i]) };
            if from_upper && from_lower {
                c.add_product(a, &other.coefficients[i]);
            }
            if !c.is_zero() {
                monomials.push(upper.max(lower));
                coefficients.push(c);
            }
            i += usize::from(from_upper);
            j += usize::from(from_lower);
        }
        Self { packing, monomials, coefficients }
    }

    /// Schoolbook: all products of terms, sorted.
    fn sorted_product(&self, other: &Self, packing: Packing, left: &[u64], right: &[u64]) -> Self {
        const MASK: usize = (1 << 16) - 1;
        // Monomial and place in one integer sort faster than a pair.
        let mut pairs: Vec<u128> = Vec::with_capacity(left.len() * right.len());
        for (i, a) in left.iter().enumerate() {
            for (j, b) in right.iter().enumerate() {
                pairs.push(u128::from(a + b) << 64 | (i << 16 | j) as u128);
            }
        }
        pairs.sort_unstable();
        let (mut monomials, mut coefficients) = (Vec::with_capacity(pairs.len()), Vec::with_capacity(pairs.len()));
        let place = |pair: u128| ((pair >> 64) as u64, (pair >> 16) as usize & MASK, pair as usize & MASK);
        let mut pairs = pairs.into_iter().rev().map(place).peekable();
        while let Some((monomial, i, j)) = pairs.next() {
            let mut sum = self.coefficients[i].mul(&other.coefficients[j]);
            while let Some((_, i, j)) = pairs.next_if(|pair| pair.0 == monomial) {
                sum.add_product(&self.coefficients[i], &other.coefficients[j]);
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
        let degrees = self.degrees_of_product(other, packing);
        let words = to_words(&self.coefficients).zip(to_words(&other.coefficients));
        let bound = words.as_ref().map(|(a, b)| bound(a, b));
        let pairs = self.len() as f64 * other.len() as f64;
        let large =
            if words.is_none() { to_large(&self.coefficients).zip(to_large(&other.coefficients)) } else { None };
        let factors = |c: &[R]| c.iter().map(|n| Factor::new(n.as_int()?)).collect::<Option<Vec<Factor<FACTOR>>>>();
        let short = large.as_ref().and_then(|_| factors(&self.coefficients).zip(factors(&other.coefficients)));
        let numbers = match (&words, &large) {
            (Some((a, b)), _) => Some((Numbers::Words(a), Numbers::Words(b))),
            (None, Some((a, b))) => Some((Numbers::Large(a), Numbers::Large(b))),
            (None, None) => None,
        };
        let limit = |(a, b): &(Numbers, Numbers)| pairs * pair_cost(bound, short.is_some(), a, b);
        if let Some(((a, b), limit)) = numbers.as_ref().map(|n| (n, limit(n))).filter(|(_, limit)| *limit > SHORT) {
            let (left, right) = ((left, a), (right, b));
            let substituted = Kronecker::new(packing, &degrees, left, right).filter(|k| k.cost() < limit);
            let limit = substituted.as_ref().map_or(limit, Kronecker::cost);
            let planes = Planes::new(packing, &degrees, (bound, limit), left, right);
            if let Some(planes) = planes.filter(|planes| planes.cost() < limit) {
                let mut coefficients = Vec::with_capacity(planes.room());
                let monomials = planes.product(&mut |sums| match sums {
                    Sums::Words(words) => coefficients.extend(words.iter().map(|n| R::from_word(*n))),
                    Sums::Wide(n) => coefficients.push(R::from_wide(n)),
                    Sums::Large(n) => coefficients.push(R::from_large(n)),
                });
                return Self { packing, monomials, coefficients };
            }
            if let Some(substitution) = substituted {
                let (monomials, coefficients) = substitution.product(left, right);
                return Self { packing, monomials, coefficients };
            }
        }
        let grid = Grid::new(packing, &degrees, CELLS.min(self.len().saturating_mul(other.len())));
        if let (Some((a, b)), Some(..HALF)) = (&words, bound) {
            let blocks = [Blocks::new(&grid, left), Blocks::new(&grid, right)];
            let product = if blocks.iter().any(|blocks| blocks.cells.len() > MOST_IN_BLOCKS * blocks.len()) {
                None
            } else {
                scattered::product(packing, &degrees, (left, a), (right, b))
            };
            if let Some((monomials, words)) = product {
                let coefficients = words.into_iter().map(R::from_word).collect();
                return Self { packing, monomials, coefficients };
            }
        }
        let mut coefficients = Vec::new();
        let monomials = match (&words, bound, &short) {
            (Some((a, b)), Some(..HALF), _) => collect(&grid, &degrees, (left, a), (right, b), &mut |n: i64| {
                coefficients.push(R::from_word(n));
            }),
            (Some((a, b)), Some(..WHOLE), _) => {
                collect(&grid, &degrees, (left, a), (right, b), &mut |n: i128| coefficients.push(R::from_wide(n)))
            }
            (Some((a, b)), ..) => {
                collect(&grid, &degrees, (left, a), (right, b), &mut |n: Triple| coefficients.push(n.to_ring()))
            }
            (None, _, Some((a, b))) => collect(&grid, &degrees, (left, a), (right, b), &mut |n: Sum<SUM>| {
                coefficients.push(n.to_int().into_ring());
            }),
            (None, ..) => {
                let (a, b) = (&self.coefficients[..], &other.coefficients[..]);
                collect(&grid, &degrees, (left, a), (right, b), &mut |sum: R| coefficients.push(sum))
            }
        };
        coefficients.shrink_to_fit();
        Self { packing, monomials, coefficients }
    }
}

/// Returns the product of terms by heap and box: the monomials, and by `take` the coefficients.
fn collect<C, A: Accumulator<C>>(
    grid: &Grid,
    degrees: &[u32],
    (left, a): (&[u64], &[C]),
    (right, b): (&[u64], &[C]),
    take: &mut dyn FnMut(A),
) -> Vec<u64> {
    let blocks = [Blocks::new(grid, left), Blocks::new(grid, right)];
    let marked = is_sparse(grid, degrees, &blocks);
    blocks::product(grid, [left, right], [(&blocks[0], a), (&blocks[1], b)], marked, take)
}

/// Whether a product has fewer pairs of terms than its boxes have cells.
fn is_sparse(grid: &Grid, degrees: &[u32], [left, right]: &[Blocks; 2]) -> bool {
    // The maximum number of boxes, and how full they are then.
    let volume = |degrees: &[u32]| degrees.iter().fold(1.0, |cells, &degree| cells * (f64::from(degree) + 1.0));
    let (outer, inner) = degrees.split_at(grid.leading());
    let boxes = volume(outer).min(left.len() as f64 * right.len() as f64);
    (left.cells.len() as f64 * right.cells.len() as f64) < boxes * volume(inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::int::Int;

    type Poly = Polynomial<Int>;

    /// Terms scattered by a congruential generator.
    fn scattered(variables: usize, degree: u32, terms: usize, largest: i64) -> Poly {
        let mut state = 12345_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            u32::try_from(state >> 33).unwrap()
        };
        let mut term = || {
            let exponents = (0..variables).map(|_| next() % (degree + 1)).collect();
            (exponents, Int::from(i64::from(next()).wrapping_mul(i64::from(next())) % largest - largest / 2))
        };
        Poly::from_terms((0..terms).map(|_| term()))
    }

    /// Returns the product by one branch: with a box of at most this size, marked or not.
    fn branch<C, A: Accumulator<C>>(
        (f, a): (&Poly, &[C]),
        (g, b): (&Poly, &[C]),
        most: usize,
        marked: bool,
        image: impl Fn(A) -> Int,
    ) -> Poly {
        let packing = f.product_packing(g);
        let degrees: Vec<u32> = (0..packing.variables()).map(|v| f.degree(v) + g.degree(v)).collect();
        let grid = Grid::new(packing, &degrees, most);
        let (left, right) = (f.packed_as(packing), g.packed_as(packing));
        let blocks = [Blocks::new(&grid, &left), Blocks::new(&grid, &right)];
        let mut coefficients = Vec::new();
        let mut take = |sum: A| coefficients.push(image(sum));
        let factors = [(&blocks[0], a), (&blocks[1], b)];
        let monomials = blocks::product(&grid, [&left, &right], factors, marked, &mut take);
        Poly { packing, monomials, coefficients }
    }

    fn all_branches(f: &Poly, g: &Poly) {
        let packing = f.product_packing(g);
        let expected = if packing.words() == 1 {
            f.sorted_product(g, packing, &f.packed_as(packing), &g.packed_as(packing))
        } else {
            // Term by term.
            g.terms()
                .fold(Poly::zero(), |sum, (exponents, c)| sum.add(&f.mul(&Poly::from_terms([(exponents, c.clone())]))))
        };
        assert_eq!(f.mul(g), expected);
        let (a, b) = (to_words(&f.coefficients).unwrap(), to_words(&g.coefficients).unwrap());
        if packing.words() == 1 && bound(&a, &b) < 1 << 63 {
            let degrees = f.degrees_of_product(g, packing);
            let (left, right) = (f.packed_as(packing), g.packed_as(packing));
            let (monomials, words) = scattered::product(packing, &degrees, (&left, &a), (&right, &b)).unwrap();
            assert_eq!(Poly { packing, monomials, coefficients: words.into_iter().map(Int::from).collect() }, expected);
        }
        for most in [1, 2, 40, 1000, CELLS, 1 << 20] {
            for marked in [false, true] {
                assert_eq!(branch::<i64, i128>((f, &a), (g, &b), most, marked, Int::from), expected);
                assert_eq!(branch::<i64, Triple>((f, &a), (g, &b), most, marked, Triple::to_ring), expected);
                let (c, d) = (&f.coefficients[..], &g.coefficients[..]);
                assert_eq!(branch::<Int, Int>((f, c), (g, d), most, marked, |sum| sum), expected);
                if bound(&a, &b) < 1 << 63 {
                    assert_eq!(branch::<i64, i64>((f, &a), (g, &b), most, marked, Int::from), expected);
                }
            }
        }
    }

    #[test]
    fn all_branches_agree() {
        for (variables, degree, terms, largest) in
            [(1, 50, 40, 1000), (3, 6, 60, 1000), (4, 9, 50, i64::MAX), (2, 4000, 30, i64::MAX)]
        {
            let f = scattered(variables, degree, terms, largest);
            let g = scattered(variables, degree / 2 + 1, terms / 2, largest);
            all_branches(&f, &g);
            all_branches(&f, &f.neg());
        }
        let (f, g) = (scattered(13, 9, 30, 1000), scattered(11, 20, 30, i64::MAX));
        assert_eq!(f.product_packing(&g).words(), 2);
        all_branches(&f, &g);
        let (f, g) = (scattered(30, 9, 30, 1000), scattered(20, 90, 30, i64::MAX));
        assert!(f.product_packing(&g).words() > 2);
        all_branches(&f, &g);
    }

    #[test]
    fn bounds_hold_for_the_worst_signs() {
        assert_eq!(bound(&[1, -2, 3], &[-5]), 15);
        assert_eq!(bound(&[i64::MIN], &[i64::MIN]), 1 << 126);
        assert_eq!(bound(&[], &[7]), 0);
    }
}
