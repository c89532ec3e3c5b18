//! Determinants of many matrices at once, modulo the primes of the lanes.

use super::lanes::{Lanes, MOST_LANES};

/// Four matrices are eliminated side by side, which hides the latency of the arithmetic.
pub(super) const SIDE: usize = 4;

/// Elements between rows: odd, so that columns do not share a few sets of the cache.
const fn stride(size: usize) -> usize {
    size | 1
}

/// Returns the place of an entry, given its index row by row, among those of its group.
pub(super) const fn place(size: usize, index: usize) -> usize {
    index / size * stride(size) + index % size
}

/// Square matrices of one size, in groups of four.
pub(super) struct Batch<E> {
    size: usize,
    stride: usize,
    /// The groups in use.
    pub(super) groups: usize,
    /// Entry (i, j) of the matrices of group g at `(g size + i) stride + j`.
    entries: Vec<[E; SIDE]>,
    /// The products of the pivots of this step in the groups before.
    products: Vec<[E; SIDE]>,
    determinants: Vec<[E; SIDE]>,
}

/// A matrix of the batch and a lane of it in which the chosen pivot is 0, but another would not have been.
pub(super) struct ZeroPivot {
    pub(super) matrix: usize,
    pub(super) lane: usize,
}

impl<E: Copy> Batch<E> {
    #[inline(always)]
    pub(super) fn new<L: Lanes<Element = E>>(lanes: L, size: usize, groups: usize) -> Self {
        let (stride, none) = (stride(size), [lanes.zero(); SIDE]);
        let entries = vec![none; groups * size * stride];
        Self { size, stride, groups, entries, products: vec![none; groups], determinants: vec![none; groups] }
    }

    /// Returns the entries of the matrices of a group, each at the place of its index.
    #[inline(always)]
    pub(super) fn group_mut(&mut self, group: usize) -> &mut [[E; SIDE]] {
        let length = self.size * self.stride;
        &mut self.entries[group * length..][..length]
    }

    #[inline(always)]
    pub(super) fn set(&mut self, group: usize, row: usize, column: usize, values: [E; SIDE]) {
        self.entries[(group * self.size + row) * self.stride + column] = values;
    }

    #[inline(always)]
    pub(super) fn get(&self, group: usize, row: usize, column: usize) -> [E; SIDE] {
        self.entries[(group * self.size + row) * self.stride + column]
    }

    #[inline(always)]
    pub(super) fn determinant(&self, matrix: usize) -> E {
        self.determinants[matrix / SIDE][matrix % SIDE]
    }

    /// Entry (i, j) of group g less the products of the entries left of it and above it.
    #[inline(always)]
    fn eliminate<L: Lanes<Element = E>>(&mut self, lanes: L, group: usize, i: usize, j: usize) {
        let (first, count) = (group * self.size, usize::min(i, j));
        let row = &self.entries[(first + i) * self.stride..][..self.stride];
        let above = &self.entries[first * self.stride + j..];
        let mut value = row[j];
        let mut done = 0;
        while done < count {
            let end = usize::min(count, done.saturating_add(L::CHUNK));
            let mut sums = [lanes.sum(value[0]), lanes.sum(value[1]), lanes.sum(value[2]), lanes.sum(value[3])];
            for t in done..end {
                let (a, b) = (&row[t], &above[t * self.stride]);
                for m in 0..SIDE {
                    sums[m] = lanes.subtract_product(sums[m], a[m], b[m]);
                }
            }
            for m in 0..SIDE {
                value[m] = lanes.reduce(sums[m]);
            }
            done = end;
        }
        self.entries[(first + i) * self.stride + j] = value;
    }

    /// Computes the determinants. If one is wrong because a pivot was 0 modulo one prime only, that is returned.
    ///
    /// # Source
    /// Crout's form of Gaussian elimination; the inverses of all pivots of a step from one inversion by Montgomery's
    /// trick.
    #[inline(always)]
    pub(super) fn eliminate_all<L: Lanes<Element = E>>(&mut self, lanes: L, width: usize) -> Vec<ZeroPivot> {
        let mut zeros = Vec::new();
        self.determinants.fill([lanes.one(); SIDE]);
        for k in 0..self.size {
            for group in 0..self.groups {
                for i in k..self.size {
                    self.eliminate(lanes, group, i, k);
                }
            }
            if k + 1 < self.size {
                self.divide(lanes, k, width, &mut zeros);
                for group in 0..self.groups {
                    for j in k + 1..self.size {
                        self.eliminate(lanes, group, k, j);
                    }
                }
            } else {
                for group in 0..self.groups {
                    let pivot = self.entries[(group * self.size + k) * self.stride + k];
                    for m in 0..SIDE {
                        self.determinants[group][m] = lanes.mul(self.determinants[group][m], pivot[m]);
                    }
                }
            }
        }
        zeros
    }

    /// Divides column k below the diagonal by the pivot.
    #[inline(always)]
    fn divide<L: Lanes<Element = E>>(&mut self, lanes: L, k: usize, width: usize, zeros: &mut Vec<ZeroPivot>) {
        let mut product = self.pivot_products(lanes, k);
        let mut pairs = [lanes.mul(product[0], product[1]), lanes.mul(product[2], product[3])];
        let mut total = lanes.mul(pairs[0], pairs[1]);
        if any_zero(lanes, total, width) {
            self.exchange(lanes, k, width, zeros);
            product = self.pivot_products(lanes, k);
            pairs = [lanes.mul(product[0], product[1]), lanes.mul(product[2], product[3])];
            total = lanes.mul(pairs[0], pairs[1]);
        }
        let inverse = lanes.inverse(total);
        let halves = [lanes.mul(inverse, pairs[1]), lanes.mul(inverse, pairs[0])];
        let mut inverses = [
            lanes.mul(halves[0], product[1]),
            lanes.mul(halves[0], product[0]),
            lanes.mul(halves[1], product[3]),
            lanes.mul(halves[1], product[2]),
        ];
        for group in (0..self.groups).rev() {
            let first = group * self.size * self.stride + k;
            let pivot = self.entries[first + k * self.stride];
            let mut inverse = inverses;
            for m in 0..SIDE {
                inverse[m] = lanes.mul(inverses[m], self.products[group][m]);
                inverses[m] = lanes.mul(inverses[m], pivot[m]);
                self.determinants[group][m] = lanes.mul(self.determinants[group][m], pivot[m]);
            }
            for i in k + 1..self.size {
                let entry = &mut self.entries[first + i * self.stride];
                for m in 0..SIDE {
                    entry[m] = lanes.mul(entry[m], inverse[m]);
                }
            }
        }
    }

    /// Fills in the products of the pivots of all earlier groups, and returns those of all groups.
    #[inline(always)]
    fn pivot_products<L: Lanes<Element = E>>(&mut self, lanes: L, k: usize) -> [E; SIDE] {
        let mut product = [lanes.one(); SIDE];
        for group in 0..self.groups {
            self.products[group] = product;
            let pivot = self.entries[(group * self.size + k) * self.stride + k];
            for m in 0..SIDE {
                product[m] = lanes.mul(product[m], pivot[m]);
            }
        }
        product
    }

    /// Exchanges row k for the one with the fewest zeros in column k. Where that is still 0, the determinant becomes 0,
    /// and the pivot 1 so that the others can be inverted together.
    #[inline(always)]
    fn exchange<L: Lanes<Element = E>>(&mut self, lanes: L, k: usize, width: usize, zeros: &mut Vec<ZeroPivot>) {
        let (mut best, mut fewest) = (k, usize::MAX);
        let mut residues = [0; MOST_LANES];
        let residues = &mut residues[..width];
        for i in k..self.size {
            let mut count = 0;
            for matrix in 0..self.groups * SIDE {
                lanes.store(self.get(matrix / SIDE, i, k)[matrix % SIDE], residues);
                count += residues.iter().filter(|&&r| r == 0).count();
            }
            if count < fewest {
                (best, fewest) = (i, count);
            }
        }
        if best != k {
            for group in 0..self.groups {
                for j in 0..self.size {
                    let first = group * self.size * self.stride + j;
                    self.entries.swap(first + k * self.stride, first + best * self.stride);
                }
                for m in 0..SIDE {
                    self.determinants[group][m] = lanes.sub(lanes.zero(), self.determinants[group][m]);
                }
            }
        }
        for matrix in 0..self.groups * SIDE {
            let mut pivots = self.get(matrix / SIDE, k, k);
            lanes.store(pivots[matrix % SIDE], residues);
            for lane in 0..width {
                if residues[lane] == 0 {
                    let mut other = [0; MOST_LANES];
                    let mut lost = false;
                    for i in k + 1..self.size {
                        lanes.store(self.get(matrix / SIDE, i, k)[matrix % SIDE], &mut other[..width]);
                        lost |= other[lane] != 0;
                    }
                    if lost {
                        zeros.push(ZeroPivot { matrix, lane });
                    }
                    residues[lane] = 1;
                    lanes.store(self.determinant(matrix), &mut other[..width]);
                    other[lane] = 0;
                    self.determinants[matrix / SIDE][matrix % SIDE] = lanes.load(&other[..width]);
                }
            }
            pivots[matrix % SIDE] = lanes.load(residues);
            self.set(matrix / SIDE, k, k, pivots);
        }
    }
}

/// Returns whether some lane is 0.
#[inline(always)]
fn any_zero<L: Lanes>(lanes: L, a: L::Element, width: usize) -> bool {
    let mut residues = [0; MOST_LANES];
    lanes.store(a, &mut residues[..width]);
    residues[..width].contains(&0)
}
