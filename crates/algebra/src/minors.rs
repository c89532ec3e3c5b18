//! Determinants of small matrices by their minors: no division, so that symbols stay in as few terms as they can.

use crate::determinant::bareiss;
use crate::polynomial::Polynomial;
use crate::ring::{Domain, Ring};

/// Returns the determinant of a matrix of polynomials: by minors if it is small, or not large and with symbols in it, else
/// without fractions.
pub(super) fn determinant<D: Domain>(rows: &[Vec<Polynomial<D>>]) -> Polynomial<D> {
    let most = if parameters(rows.iter().flatten()) <= 2 { 4 } else { 8 };
    match rows.split_first() {
        Some((top, rest)) if rest.len() < most => expand(top, &maximal_minors(rest, top.len())),
        _ => bareiss(rows),
    }
}

/// Returns the number of variables that occur.
pub(super) fn parameters<'a, R: Ring + 'a>(polynomials: impl Iterator<Item = &'a Polynomial<R>>) -> usize {
    let mut occurs: Vec<bool> = Vec::new();
    for polynomial in polynomials {
        occurs.resize(occurs.len().max(polynomial.variables()), false);
        for (occurs, degree) in occurs.iter_mut().zip(polynomial.degrees()) {
            *occurs |= degree > 0;
        }
    }
    occurs.into_iter().filter(|&occurs| occurs).count()
}

/// Returns the maximal minors of a matrix with one row less than columns: entry c is the minor without column c.
///
/// Expands along the rows, from the last one up, and keeps the minor of every set of columns: `m 2^(m-1)` products.
///
/// # Panics
/// When there are more than 20 columns, or the shape is wrong.
#[must_use]
pub fn maximal_minors<R: Ring>(rows: &[Vec<R>], columns: usize) -> Vec<R> {
    assert!(columns <= 20, "expansion by minors is for small matrices");
    assert!(rows.len() + 1 == columns && rows.iter().all(|row| row.len() == columns), "one row less than columns");
    let mut minors = vec![None; 1 << columns];
    minors[0] = Some(R::one());
    for (done, row) in rows.iter().rev().enumerate() {
        let mut next = vec![None; 1 << columns];
        for set in (0..1_usize << columns).filter(|set| set.count_ones() as usize == done + 1) {
            next[set] = expansion(row, set as u64, |c| minors[set & !(1 << c)].as_ref());
        }
        minors = next;
    }
    let all = (1 << columns) - 1;
    (0..columns).map(|c| minors[all & !(1 << c)].take().unwrap_or_else(R::zero)).collect()
}

/// Returns the determinant of a square matrix over any ring, by its minors; 1 for the empty matrix.
///
/// # Panics
/// When there are more than 20 columns, or the matrix is not square.
#[must_use]
pub fn determinant_by_minors<R: Ring>(rows: &[Vec<R>]) -> R {
    rows.split_first().map_or_else(R::one, |(top, rest)| expand(top, &maximal_minors(rest, top.len())))
}

/// Returns the determinant with one more row on top, from the maximal minors below it.
pub(super) fn expand<R: Ring>(top: &[R], minors: &[R]) -> R {
    let set = (1 << top.len()) - 1;
    expansion(top, set, |c| Some(&minors[c]).filter(|minor| !minor.is_zero())).unwrap_or_else(R::zero)
}

/// Returns the alternating sum of the entries in the columns of a set times the minors without these; `None` for zero.
fn expansion<'a, R: Ring + 'a>(row: &[R], set: u64, minor: impl Fn(usize) -> Option<&'a R>) -> Option<R> {
    let (mut sum, mut odd): (Option<R>, bool) = (None, false);
    for (c, x) in row.iter().enumerate() {
        if set >> c & 1 == 0 {
            continue;
        }
        if let Some(minor) = minor(c).filter(|_| !x.is_zero()) {
            let product = x.mul(minor);
            sum = Some(match (sum, odd) {
                (None, false) => product,
                (None, true) => product.neg(),
                (Some(sum), false) => sum.add(&product),
                (Some(sum), true) => sum.sub(&product),
            });
        }
        odd = !odd;
    }
    sum.filter(|sum| !sum.is_zero())
}

/// What the expansion of one minor along a row costs, in nanoseconds.
#[derive(Default)]
pub(super) struct Price {
    cost: f64,
    products: f64,
}

impl Price {
    /// Nanoseconds of a product of two polynomials, of a product of two terms in it, and of a term of the sum.
    pub(super) const PRODUCT: f64 = 150.0;
    const TERM_PRODUCT: f64 = 9.0;
    const TERM: f64 = 6.0;

    /// Adds the product of polynomials of these numbers of terms.
    pub(super) fn add(&mut self, entry: f64, minor: f64) {
        self.cost += Self::PRODUCT + Self::TERM_PRODUCT * entry * minor;
        self.products += entry * minor;
    }

    /// Returns the cost, and the number of terms expected if there are so many monomials for them.
    pub(super) fn total(self, cells: f64) -> (f64, f64) {
        let size = cells * -(-self.products / cells).exp_m1();
        (self.cost + Self::TERM * size, size)
    }
}

/// Returns about how many monomials there are within these degrees and this total one.
pub(super) fn cells(degrees: impl Iterator<Item = f64>, total: f64) -> f64 {
    let (mut cells, mut simplex) = (1.0, 1.0);
    for (k, degree) in (1..).map(f64::from).zip(degrees) {
        cells *= degree + 1.0;
        simplex *= (total + k) / k;
    }
    f64::min(cells, simplex)
}

/// The order in which a sparse determinant is expanded along its rows, and which minors that takes.
pub(super) struct Expansion {
    /// The rows, the lowest one of the minors first.
    rows: Vec<usize>,
    /// For each number of rows the sets of columns of the minors that count, in increasing order.
    levels: Vec<Vec<u64>>,
}

impl Expansion {
    /// More columns than a machine word has bits are not expanded.
    pub(super) const MOST_COLUMNS: usize = 64;
    /// The number of minors beyond which no plan is made.
    const MOST_MINORS: usize = 1 << 16;

    /// Returns the plan for a square matrix of which it is known where it has entries, a set of columns for each row, and what it
    /// costs; `None` if that is more than the limit.
    ///
    /// `price` says what a minor costs and how large it is: it is given the rows of the minor, the newest one last, and the
    /// columns of the new row with the sizes of the minors that their entries are multiplied by.
    pub(super) fn plan(
        pattern: &[u64],
        limit: f64,
        mut price: impl FnMut(&[usize], &[(usize, f64)]) -> (f64, f64),
    ) -> Option<(Self, f64)> {
        let rows = order(pattern);
        // The columns that are left for the rows to come.
        let mut left = vec![0; rows.len() + 1];
        for (k, &row) in rows.iter().enumerate().rev() {
            left[k] = left[k + 1] | pattern[row];
        }
        let all = left[0];
        let (mut levels, mut sizes, mut cost, mut count) = (vec![vec![0]], vec![1.0], 0.0, 0);
        for (k, &row) in rows.iter().enumerate() {
            let before: &Vec<u64> = &levels[k];
            let mut sets: Vec<u64> = Vec::new();
            for &set in before {
                // A column that no later row has must be taken by now.
                let free = columns(pattern[row] & !set).map(|c| set | 1 << c);
                sets.extend(free.filter(|set| set | left[k + 1] == all));
            }
            sets.sort_unstable();
            sets.dedup();
            count += sets.len();
            if count > Self::MOST_MINORS {
                return None;
            }
            let mut new_sizes = Vec::with_capacity(sets.len());
            let mut factors = Vec::new();
            for &set in &sets {
                factors.clear();
                let size = |c: usize| before.binary_search(&(set & !(1 << c))).ok().map(|at| (c, sizes[at]));
                factors.extend(columns(pattern[row] & set).filter_map(size));
                let (own, size) = price(&rows[..=k], &factors);
                cost += own;
                new_sizes.push(size);
            }
            if cost > limit {
                return None;
            }
            levels.push(sets);
            sizes = new_sizes;
        }
        Some((Self { rows, levels }, cost))
    }

    /// Returns the determinant.
    pub(super) fn determinant<R: Ring>(&self, matrix: &[&[R]]) -> R {
        let mut minors = vec![R::one()];
        for ((&row, before), sets) in self.rows.iter().zip(&self.levels).zip(&self.levels[1..]) {
            let minor =
                |set: u64| before.binary_search(&set).ok().map(|at| &minors[at]).filter(|minor| !minor.is_zero());
            let next = |&set: &u64| expansion(matrix[row], set, |c| minor(set & !(1 << c))).unwrap_or_else(R::zero);
            minors = sets.iter().map(next).collect();
        }
        let determinant = minors.pop().unwrap_or_else(R::zero);
        let mut top_down = self.rows.clone();
        top_down.reverse();
        if is_odd(&top_down) { determinant.neg() } else { determinant }
    }
}

/// Returns the rows in an order in which few new columns come in at a time.
fn order(pattern: &[u64]) -> Vec<usize> {
    let (mut rows, mut left, mut seen) = (Vec::new(), (0..pattern.len()).collect::<Vec<usize>>(), 0);
    while !left.is_empty() {
        let new = |&(_, &row): &(usize, &usize)| ((pattern[row] & !seen).count_ones(), pattern[row].count_ones());
        let (at, _) = left.iter().enumerate().min_by_key(new).expect("rows are left");
        let row = left.swap_remove(at);
        seen |= pattern[row];
        rows.push(row);
    }
    rows
}

/// Returns the members of a set.
fn columns(set: u64) -> impl Iterator<Item = usize> {
    let mut rest = set;
    std::iter::from_fn(move || {
        let lowest = rest.trailing_zeros();
        rest &= rest.wrapping_sub(1);
        (lowest < u64::BITS).then_some(lowest as usize)
    })
}

/// Returns whether a permutation is odd.
pub(super) fn is_odd(permutation: &[usize]) -> bool {
    let mut seen = vec![false; permutation.len()];
    let mut odd = false;
    for start in 0..permutation.len() {
        let mut at = start;
        while !std::mem::replace(&mut seen[at], true) {
            at = permutation[at];
            odd ^= at != start;
        }
    }
    odd
}
