//! Products of blocks of terms: a heap orders the leading variables, a dense box collects the last ones.
//!
//! With all variables in the box this is the dense product, with none the heap product.

use super::heap::{Heap, Key};
use crate::monomial::Packing;
use crate::ring::Ring;
use rug::Integer;
use std::ops::Range;

/// The sum of products of coefficients.
pub(super) trait Accumulator<C>: Clone {
    /// Returns the empty sum.
    fn empty() -> Self;
    /// Adds a product.
    fn add(&mut self, a: &C, b: &C);
    /// Returns whether the sum is zero.
    fn vanishes(&self) -> bool;
}

impl Accumulator<i64> for i64 {
    fn empty() -> Self {
        0
    }
    #[inline(always)]
    fn add(&mut self, a: &i64, b: &i64) {
        *self = self.wrapping_add(a.wrapping_mul(*b));
    }
    #[inline(always)]
    fn vanishes(&self) -> bool {
        *self == 0
    }
}

impl Accumulator<i64> for i128 {
    fn empty() -> Self {
        0
    }
    #[inline(always)]
    fn add(&mut self, a: &i64, b: &i64) {
        *self = self.wrapping_add(i128::from(*a) * i128::from(*b));
    }
    #[inline(always)]
    fn vanishes(&self) -> bool {
        *self == 0
    }
}

/// A signed integer of 192 bits: the sum of fewer than `2^64` products of words, each of at most `2^126`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Triple {
    hi: i64,
    lo: u128,
}

impl Triple {
    /// Returns the sum as an element of a ring.
    pub(super) fn to_ring<R: Ring>(self) -> R {
        let lo = self.lo.cast_signed();
        if i128::from(self.hi) == lo >> 127 {
            return R::from_wide(lo);
        }
        R::from_large((Integer::from(self.hi) << 128_u32) + self.lo)
    }
}

impl Accumulator<i64> for Triple {
    fn empty() -> Self {
        Self { hi: 0, lo: 0 }
    }
    #[inline(always)]
    fn add(&mut self, a: &i64, b: &i64) {
        let product = i128::from(*a) * i128::from(*b);
        let (lo, carry) = self.lo.overflowing_add(product.cast_unsigned());
        // The words above those of a negative product are all ones.
        self.hi = self.hi + i64::from(carry) - i64::from(product < 0);
        self.lo = lo;
    }
    #[inline(always)]
    fn vanishes(&self) -> bool {
        self.hi == 0 && self.lo == 0
    }
}

impl<R: Ring> Accumulator<R> for R {
    fn empty() -> Self {
        R::zero()
    }
    #[inline(always)]
    fn add(&mut self, a: &R, b: &R) {
        self.add_product(a, b);
    }
    #[inline(always)]
    fn vanishes(&self) -> bool {
        self.is_zero()
    }
}

/// The numbering of the exponents of the last variables: the cells of a box.
pub(super) struct Grid {
    packing: Packing,
    /// Number of variables before those of the box.
    leading: usize,
    /// The distance in cells between exponents of each variable of the box.
    strides: Vec<usize>,
    /// The packed monomial of each cell, as many words as a monomial has.
    monomials: Vec<u64>,
}

impl Grid {
    /// Returns the largest box with at most `most` cells, for exponents up to the given degrees.
    pub(super) fn new(packing: Packing, degrees: &[u32], most: usize) -> Self {
        let (mut leading, mut cells, mut strides) = (degrees.len(), 1, Vec::new());
        while leading > 0 {
            let wider = (degrees[leading - 1] as usize + 1).saturating_mul(cells);
            if wider > most {
                break;
            }
            strides.insert(0, cells);
            (leading, cells) = (leading - 1, wider);
        }
        // Filled by doubling: the monomials of the later variables, times all powers of one before.
        let words = packing.words();
        let mut monomials = Vec::with_capacity(cells * words);
        monomials.resize(words, 0);
        for variable in (leading..degrees.len()).rev() {
            let (word, shift) = packing.place(variable);
            let block = monomials.len();
            for exponent in 1..=degrees[variable] as usize {
                monomials.extend_from_within(..block);
                for monomial in monomials[exponent * block..].chunks_exact_mut(words) {
                    monomial[word] += (exponent as u64) << shift;
                }
            }
        }
        Self { packing, leading, strides, monomials }
    }

    /// Returns the number of cells.
    pub(super) fn cells(&self) -> usize {
        self.monomials.len() / self.packing.words()
    }

    /// Returns the monomial of a cell.
    #[inline(always)]
    pub(super) fn monomial(&self, cell: usize) -> &[u64] {
        let words = self.packing.words();
        &self.monomials[cell * words..(cell + 1) * words]
    }

    /// Returns the words of a monomial.
    pub(super) const fn words(&self) -> usize {
        self.packing.words()
    }

    /// Returns the number of variables before those of the box.
    pub(super) const fn leading(&self) -> usize {
        self.leading
    }
}

/// Terms in blocks that agree in the leading variables.
pub(super) struct Blocks<'a, K, C> {
    /// The monomial of each block in the leading variables.
    pub(super) keys: Vec<K>,
    /// The start of each block, and the number of terms.
    starts: Vec<usize>,
    /// The cell of each term.
    pub(super) cells: Vec<usize>,
    /// The coefficients of the terms.
    pub(super) coefficients: &'a [C],
}

impl<'a, K: Key, C> Blocks<'a, K, C> {
    /// Returns the blocks of sorted terms.
    pub(super) fn new(grid: &Grid, monomials: &[u64], coefficients: &'a [C]) -> Self {
        let packing = grid.packing;
        let masks: Vec<u64> = (0..packing.words()).map(|word| packing.leading(word, grid.leading)).collect();
        let strides: Vec<((usize, u32), usize)> =
            grid.strides.iter().enumerate().map(|(k, &stride)| (packing.place(grid.leading + k), stride)).collect();
        let (mut keys, mut starts, mut cells) = (Vec::new(), Vec::new(), Vec::with_capacity(coefficients.len()));
        let mut previous: Option<&[u64]> = None;
        for (i, monomial) in monomials.chunks_exact(packing.words()).enumerate() {
            let same = previous.is_some_and(|p| p.iter().zip(monomial).zip(&masks).all(|((a, b), m)| (a ^ b) & m == 0));
            if !same {
                keys.push(K::read(monomial, &masks));
                starts.push(i);
            }
            previous = Some(monomial);
            let cell = |((word, shift), stride): &((usize, u32), usize)| {
                packing.field(monomial[*word], *shift) as usize * stride
            };
            cells.push(strides.iter().map(cell).sum());
        }
        starts.push(coefficients.len());
        Self { keys, starts, cells, coefficients }
    }
}

impl<K, C> Blocks<'_, K, C> {
    /// Returns the number of blocks.
    pub(super) fn len(&self) -> usize {
        self.keys.len()
    }

    /// Returns the terms of a block.
    pub(super) fn block(&self, number: usize) -> Range<usize> {
        self.starts[number]..self.starts[number + 1]
    }
}

/// The sums of products that fall into the cells of a box.
struct Collector<A> {
    sums: Vec<A>,
    /// A bit for each cell that was hit, if they are marked.
    marks: Vec<u64>,
}

impl<A> Collector<A> {
    /// Adds the product of two blocks.
    #[inline(always)]
    fn add<K, C, const MARKED: bool>(&mut self, left: &Blocks<K, C>, i: usize, right: &Blocks<K, C>, j: usize)
    where
        A: Accumulator<C>,
    {
        let range = right.block(j);
        let (cells, coefficients) = (&right.cells[range.clone()], &right.coefficients[range]);
        for k in left.block(i) {
            let (start, a) = (left.cells[k], &left.coefficients[k]);
            let sums = &mut self.sums[start..];
            for (&cell, b) in cells.iter().zip(coefficients) {
                sums[cell].add(a, b);
                if MARKED {
                    let cell = start + cell;
                    self.marks[cell / 64] |= 1 << (cell % 64);
                }
            }
        }
    }
}

/// Returns the monomials of the product, decreasing; its coefficients are passed one by one to `take`, which is not generic so
/// that the code for machine words exists once for all rings. With `MARKED`, cells are found by marks, which pays if most are empty.
pub(super) fn product<K: Key, C, A: Accumulator<C>, const MARKED: bool>(
    grid: &Grid,
    left: &Blocks<K, C>,
    right: &Blocks<K, C>,
    take: &mut dyn FnMut(A),
) -> Vec<u64> {
    let cells = grid.cells();
    let marks = vec![0; if MARKED { cells.div_ceil(64) } else { 0 }];
    let mut collector = Collector { sums: vec![A::empty(); cells], marks };
    let mut monomials = Vec::new();
    let mut heap = Heap::new(left.len());
    let mut columns = vec![0; left.len()];
    heap.insert(left.keys[0].times(&right.keys[0]), 0);
    let mut rows = Vec::new();
    while let Some(key) = heap.pop(&mut rows) {
        let (mut lowest, mut highest) = (cells, 0);
        for &row in &rows {
            let column = columns[row];
            collector.add::<K, C, MARKED>(left, row, right, column);
            // The cells of a block decrease.
            highest = highest.max(left.cells[left.starts[row]] + right.cells[right.starts[column]]);
            lowest = lowest.min(left.cells[left.starts[row + 1] - 1] + right.cells[right.starts[column + 1] - 1]);
        }
        for row in rows.drain(..) {
            columns[row] += 1;
            if columns[row] == 1 && row + 1 < left.len() {
                heap.insert(left.keys[row + 1].times(&right.keys[0]), row + 1);
            }
            if let Some(next) = right.keys.get(columns[row]) {
                heap.insert(left.keys[row].times(next), row);
            }
        }
        let mut emit = |cell: usize, sums: &mut [A]| {
            if !sums[cell].vanishes() {
                let sum = std::mem::replace(&mut sums[cell], A::empty());
                monomials.extend(key.words().iter().zip(grid.monomial(cell)).map(|(outer, inner)| outer | inner));
                take(sum);
            }
        };
        if MARKED {
            for word in (lowest / 64..=highest / 64).rev() {
                let mut marks = std::mem::take(&mut collector.marks[word]);
                while marks != 0 {
                    let bit = 63 - marks.leading_zeros() as usize;
                    marks ^= 1 << bit;
                    emit(word * 64 + bit, &mut collector.sums);
                }
            }
        } else {
            for cell in (lowest..=highest).rev() {
                emit(cell, &mut collector.sums);
            }
        }
    }
    monomials.shrink_to_fit();
    monomials
}
