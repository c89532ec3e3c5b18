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

    /// Returns the fields of these variables in each word of a monomial.
    fn masks(&self) -> Vec<u64> {
        (0..self.packing.words()).map(|word| self.packing.leading(word, self.leading)).collect()
    }
}

/// Sorted terms in blocks that agree in the leading variables, without their coefficients.
pub(super) struct Blocks {
    /// The start of each block, and the number of terms.
    starts: Vec<usize>,
    /// The cell of each term.
    pub(super) cells: Vec<usize>,
}

impl Blocks {
    /// Returns the blocks of sorted terms.
    pub(super) fn new(grid: &Grid, monomials: &[u64]) -> Self {
        let packing = grid.packing;
        let masks = grid.masks();
        let strides: Vec<((usize, u32), usize)> =
            grid.strides.iter().enumerate().map(|(k, &stride)| (packing.place(grid.leading + k), stride)).collect();
        let count = monomials.len() / packing.words();
        let (mut starts, mut cells) = (Vec::new(), Vec::with_capacity(count));
        let mut previous: Option<&[u64]> = None;
        for (i, monomial) in monomials.chunks_exact(packing.words()).enumerate() {
            let same = previous.is_some_and(|p| p.iter().zip(monomial).zip(&masks).all(|((a, b), m)| (a ^ b) & m == 0));
            if !same {
                starts.push(i);
            }
            previous = Some(monomial);
            let cell = |((word, shift), stride): &((usize, u32), usize)| {
                packing.field(monomial[*word], *shift) as usize * stride
            };
            cells.push(strides.iter().map(cell).sum());
        }
        starts.push(count);
        Self { starts, cells }
    }

    /// Returns the monomial of each block in the leading variables, for the terms that the blocks were made of.
    pub(super) fn keys<K: Key>(&self, grid: &Grid, monomials: &[u64]) -> Vec<K> {
        let (words, masks) = (grid.words(), grid.masks());
        self.starts[..self.len()].iter().map(|start| K::read(&monomials[start * words..], &masks)).collect()
    }

    /// Returns the number of blocks.
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Returns the terms of a block.
    pub(super) fn block(&self, number: usize) -> Range<usize> {
        self.starts[number]..self.starts[number + 1]
    }
}

/// Two factors: the blocks of each, and its coefficients.
pub(super) type Factors<'a, C> = [(&'a Blocks, &'a [C]); 2];

/// What happens to the coefficients of a product while a heap orders its monomials. The heap sees no coefficients, so that it exists
/// once for all rings.
trait Collect {
    /// Adds the product of a block of the left factor and one of the right factor.
    fn add(&mut self, left: usize, right: usize);
    /// Empties the cells in this range, and appends those whose sums are not zero, decreasing.
    fn empty(&mut self, lowest: usize, highest: usize, cells: &mut Vec<usize>);
}

/// The sums of products that fall into the cells of a box. With `MARKED`, cells are found by marks, which pays if most are empty.
struct Collector<'a, C, A, const MARKED: bool> {
    factors: Factors<'a, C>,
    sums: Vec<A>,
    /// A bit for each cell that was hit, if they are marked.
    marks: Vec<u64>,
    /// Takes the sums that are not zero, in the order of their cells.
    take: &'a mut dyn FnMut(A),
}

impl<C, A: Accumulator<C>, const MARKED: bool> Collector<'_, C, A, MARKED> {
    #[inline(always)]
    fn pass(&mut self, cell: usize, cells: &mut Vec<usize>) {
        if !self.sums[cell].vanishes() {
            cells.push(cell);
            (self.take)(std::mem::replace(&mut self.sums[cell], A::empty()));
        }
    }
}

impl<C, A: Accumulator<C>, const MARKED: bool> Collect for Collector<'_, C, A, MARKED> {
    fn add(&mut self, left: usize, right: usize) {
        let [(left_terms, left_coefficients), (right_terms, right_coefficients)] = self.factors;
        let range = right_terms.block(right);
        let (cells, coefficients) = (&right_terms.cells[range.clone()], &right_coefficients[range]);
        for k in left_terms.block(left) {
            let (start, a) = (left_terms.cells[k], &left_coefficients[k]);
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

    fn empty(&mut self, lowest: usize, highest: usize, cells: &mut Vec<usize>) {
        if MARKED {
            for word in (lowest / 64..=highest / 64).rev() {
                let mut marks = std::mem::take(&mut self.marks[word]);
                while marks != 0 {
                    let bit = 63 - marks.leading_zeros() as usize;
                    marks ^= 1 << bit;
                    self.pass(word * 64 + bit, cells);
                }
            }
        } else {
            for cell in (lowest..=highest).rev() {
                self.pass(cell, cells);
            }
        }
    }
}

/// Returns the monomials of the product, decreasing; its coefficients are passed one by one to `take`.
pub(super) fn product<C, A: Accumulator<C>>(
    grid: &Grid,
    monomials: [&[u64]; 2],
    factors: Factors<C>,
    marked: bool,
    take: &mut dyn FnMut(A),
) -> Vec<u64> {
    let (sums, blocks) = (vec![A::empty(); grid.cells()], factors.map(|(blocks, _)| blocks));
    if marked {
        let marks = vec![0; grid.cells().div_ceil(64)];
        in_order(grid, monomials, blocks, &mut Collector::<C, A, true> { factors, sums, marks, take })
    } else {
        in_order(grid, monomials, blocks, &mut Collector::<C, A, false> { factors, sums, marks: Vec::new(), take })
    }
}

fn in_order(grid: &Grid, monomials: [&[u64]; 2], blocks: [&Blocks; 2], sums: &mut dyn Collect) -> Vec<u64> {
    match grid.words() {
        1 => in_order_by::<u64>(grid, monomials, blocks, sums),
        2 => in_order_by::<[u64; 2]>(grid, monomials, blocks, sums),
        _ => in_order_by::<Box<[u64]>>(grid, monomials, blocks, sums),
    }
}

fn in_order_by<K: Key>(
    grid: &Grid,
    [left_monomials, right_monomials]: [&[u64]; 2],
    [left, right]: [&Blocks; 2],
    sums: &mut dyn Collect,
) -> Vec<u64> {
    let (left_keys, right_keys) = (left.keys::<K>(grid, left_monomials), right.keys::<K>(grid, right_monomials));
    let mut monomials = Vec::new();
    let mut heap = Heap::new(left.len());
    let mut columns = vec![0; left.len()];
    heap.insert(left_keys[0].times(&right_keys[0]), 0);
    let (mut rows, mut hit) = (Vec::new(), Vec::new());
    while let Some(key) = heap.pop(&mut rows) {
        let (mut lowest, mut highest) = (grid.cells(), 0);
        for &row in &rows {
            let column = columns[row];
            sums.add(row, column);
            // The cells of a block decrease.
            highest = highest.max(left.cells[left.starts[row]] + right.cells[right.starts[column]]);
            lowest = lowest.min(left.cells[left.starts[row + 1] - 1] + right.cells[right.starts[column + 1] - 1]);
        }
        for row in rows.drain(..) {
            columns[row] += 1;
            if columns[row] == 1 && row + 1 < left.len() {
                heap.insert(left_keys[row + 1].times(&right_keys[0]), row + 1);
            }
            if let Some(next) = right_keys.get(columns[row]) {
                heap.insert(left_keys[row].times(next), row);
            }
        }
        sums.empty(lowest, highest, &mut hit);
        for cell in hit.drain(..) {
            monomials.extend(key.words().iter().zip(grid.monomial(cell)).map(|(outer, inner)| outer | inner));
        }
    }
    monomials.shrink_to_fit();
    monomials
}
