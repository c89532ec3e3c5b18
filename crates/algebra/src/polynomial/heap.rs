//! A heap of rows of monomials, from which the largest monomial and all rows that show it are taken together.
//!
//! # Source
//! Monagan and Pearce 2011, Sparse polynomial division using a heap, Journal of Symbolic Computation 46(7).

/// Packed monomials as heap keys.
pub(super) trait Key: Clone + Ord {
    /// Returns the fields of a monomial that the masks keep.
    fn read(words: &[u64], masks: &[u64]) -> Self;
    /// Returns the product of two monomials.
    fn times(&self, other: &Self) -> Self;
    /// Returns the quotient by a monomial that divides this one.
    fn over(&self, other: &Self) -> Self;
    /// Returns the words of the monomial.
    fn words(&self) -> &[u64];
}

impl Key for u64 {
    #[inline(always)]
    fn read(words: &[u64], masks: &[u64]) -> Self {
        words[0] & masks[0]
    }
    #[inline(always)]
    fn times(&self, other: &Self) -> Self {
        self + other
    }
    #[inline(always)]
    fn over(&self, other: &Self) -> Self {
        self - other
    }
    #[inline(always)]
    fn words(&self) -> &[u64] {
        std::slice::from_ref(self)
    }
}

impl Key for [u64; 2] {
    #[inline(always)]
    fn read(words: &[u64], masks: &[u64]) -> Self {
        [words[0] & masks[0], words[1] & masks[1]]
    }
    #[inline(always)]
    fn times(&self, other: &Self) -> Self {
        [self[0] + other[0], self[1] + other[1]]
    }
    #[inline(always)]
    fn over(&self, other: &Self) -> Self {
        [self[0] - other[0], self[1] - other[1]]
    }
    #[inline(always)]
    fn words(&self) -> &[u64] {
        self
    }
}

impl Key for Box<[u64]> {
    fn read(words: &[u64], masks: &[u64]) -> Self {
        words.iter().zip(masks).map(|(word, mask)| word & mask).collect()
    }
    fn times(&self, other: &Self) -> Self {
        self.iter().zip(other).map(|(a, b)| a + b).collect()
    }
    fn over(&self, other: &Self) -> Self {
        self.iter().zip(other).map(|(a, b)| a - b).collect()
    }
    fn words(&self) -> &[u64] {
        self
    }
}

/// The end of a chain.
const NONE: usize = usize::MAX;

/// The rows by their current monomials, each row at most once. Rows that meet equal monomials on their way up are
/// chained to them, which keeps the heap small.
pub(super) struct Heap<K> {
    entries: Vec<(K, usize)>,
    next: Vec<usize>,
}

impl<K: Key> Heap<K> {
    /// Returns an empty heap for rows with numbers below `rows`.
    pub(super) fn new(rows: usize) -> Self {
        Self { entries: Vec::new(), next: vec![NONE; rows] }
    }

    /// Returns the largest monomial.
    #[inline(always)]
    pub(super) fn peek(&self) -> Option<&K> {
        self.entries.first().map(|(key, _)| key)
    }

    /// Enters a row.
    pub(super) fn insert(&mut self, key: K, row: usize) {
        let mut place = self.entries.len();
        while place > 0 {
            let parent = (place - 1) / 2;
            let (above, chain) = &mut self.entries[parent];
            if key < *above {
                break;
            }
            if key == *above {
                self.next[row] = *chain;
                *chain = row;
                return;
            }
            place = parent;
        }
        self.next[row] = NONE;
        self.entries.push((key, row));
        let mut hole = self.entries.len() - 1;
        while hole > place {
            let parent = (hole - 1) / 2;
            self.entries.swap(hole, parent);
            hole = parent;
        }
    }

    /// Takes out the largest monomial, and appends all rows that show it.
    pub(super) fn pop(&mut self, rows: &mut Vec<usize>) -> Option<K> {
        let key = self.peek()?.clone();
        while self.peek() == Some(&key) {
            let mut row = self.remove_first();
            while row != NONE {
                rows.push(row);
                row = self.next[row];
            }
        }
        Some(key)
    }

    fn remove_first(&mut self) -> usize {
        let (_, row) = self.entries.swap_remove(0);
        let mut hole = 0;
        loop {
            let left = 2 * hole + 1;
            if left >= self.entries.len() {
                return row;
            }
            let right = left + 1;
            let child =
                if right < self.entries.len() && self.entries[right].0 > self.entries[left].0 { right } else { left };
            if self.entries[child].0 <= self.entries[hole].0 {
                return row;
            }
            self.entries.swap(hole, child);
            hole = child;
        }
    }
}
