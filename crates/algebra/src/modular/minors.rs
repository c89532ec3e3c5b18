//! Determinants of small matrices of polynomials in one variable by their minors, in machine words.
//!
//! The coefficients are computed modulo `2^64`, `2^128` or a higher power of it, where no sum overflows whatever the minors are. A bound on the
//! coefficients of the determinant, below half of that, says that they are the residues of least absolute value.

use crate::int::Int;
use crate::wrapping::{Wide, Wrapping};

/// The most rows: larger matrices have too many minors.
const MOST_ROWS: usize = 10;
/// The nanoseconds for a product of two coefficients with words of 64, 128, 256 and 512 bits, for a product of two polynomials, and for the
/// rest: measured on a processor of 3 GHz.
const TERM: [f64; 4] = [1.0, 1.8, 7.0, 28.0];
const PRODUCT: f64 = 10.0;
const REST: f64 = 200.0;

/// A square matrix of polynomials whose coefficients are words.
pub(super) struct Minors {
    size: usize,
    /// The entries row by row, each by its coefficients, constant term first, the last one not zero.
    pub(super) entries: Vec<Vec<i64>>,
    /// The highest degree in each row.
    degrees: Vec<usize>,
}

impl Minors {
    /// Takes the entries, row by row; `None` if the matrix is not small or a coefficient does not fit a word.
    pub(super) fn new(size: usize, entries: &[Vec<Int>]) -> Option<Self> {
        if size == 0 || size > MOST_ROWS {
            return None;
        }
        let mut words = Vec::with_capacity(entries.len());
        for entry in entries {
            let mut own: Vec<i64> = entry.iter().map(Int::to_i64).collect::<Option<_>>()?;
            own.truncate(own.iter().rposition(|&c| c != 0).map_or(0, |last| last + 1));
            words.push(own);
        }
        let degree = |row: &[Vec<i64>]| row.iter().map(Vec::len).max().unwrap_or(0).saturating_sub(1);
        let degrees = words.chunks_exact(size).map(degree).collect();
        Some(Self { size, entries: words, degrees })
    }

    /// Returns the degree that the determinant has at most.
    pub(super) fn degree(&self) -> usize {
        self.degrees.iter().sum()
    }

    /// Returns the coefficients of the determinant, constant term first, which are at most `2^bits` in absolute value; `None` if
    /// they may be too long, or if it would take more nanoseconds than the limit.
    pub(super) fn determinant(&self, bits: f64, limit: f64) -> Option<Vec<Int>> {
        // Half a bit less than a word without its sign, for the rounding of logarithms.
        match bits {
            ..62.5 if self.cost(TERM[0]) < limit => Some(self.coefficients::<i64>()),
            ..126.5 if self.cost(TERM[1]) < limit => Some(self.coefficients::<i128>()),
            ..254.5 if self.cost(TERM[2]) < limit => Some(self.coefficients::<Wide<4>>()),
            ..510.5 if self.cost(TERM[3]) < limit => Some(self.coefficients::<Wide<8>>()),
            _ => None,
        }
    }

    fn coefficients<R: Wrapping>(&self) -> Vec<Int> {
        self.expand::<R>().into_iter().map(R::to_ring).collect()
    }

    /// Returns the nanoseconds that the expansion is expected to take.
    fn cost(&self, term: f64) -> f64 {
        let (mut cost, mut length, mut minors) = (REST, 1, 1.0);
        for (k, degree) in (1..=self.size).zip(self.degrees.iter().rev()) {
            minors *= (self.size + 1 - k) as f64 / k as f64;
            cost += minors * k as f64 * (PRODUCT + term * ((degree + 1) * length) as f64);
            length += degree;
        }
        cost
    }

    /// Expands along the rows from the last one up; at each row the minors of the rows so far are kept, one for each set of as many
    /// columns.
    fn expand<R: Wrapping>(&self) -> Vec<R> {
        let sets = 1_usize << self.size;
        // The number of each set among those of its size.
        let (mut numbers, mut counts) = (vec![0; sets], vec![0; self.size + 1]);
        for (set, number) in numbers.iter_mut().enumerate() {
            let count = &mut counts[set.count_ones() as usize];
            *number = *count;
            *count += 1;
        }
        let (mut minors, mut length) = (vec![R::from_wide(1)], 1);
        for (done, row) in self.entries.rchunks_exact(self.size).enumerate() {
            let longer = length + self.degrees[self.size - 1 - done];
            let mut next = vec![R::ZERO; counts[done + 1] * longer];
            for set in (0..sets).filter(|set| set.count_ones() as usize == done + 1) {
                let sums = &mut next[numbers[set] * longer..][..longer];
                let (mut rest, mut odd) = (set, false);
                while rest != 0 {
                    let column = rest.trailing_zeros() as usize;
                    rest &= rest - 1;
                    let minor = &minors[numbers[set ^ 1 << column] * length..][..length];
                    for (k, &c) in row[column].iter().enumerate() {
                        let c = R::from_wide(if odd { -i128::from(c) } else { c.into() });
                        for (sum, &m) in sums[k..].iter_mut().zip(minor) {
                            sum.add_product(c, m);
                        }
                    }
                    odd = !odd;
                }
            }
            (minors, length) = (next, longer);
        }
        minors
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ring::Ring;

    /// Hadamard's matrix of size 4 times c has determinant `16 c^4`, which is the bound itself: words of both widths are filled.
    #[test]
    fn the_longest_coefficients_fit_their_words() {
        let signs = [1, 1, 1, 1, 1, -1, 1, -1, 1, 1, -1, -1, 1, -1, -1, 1];
        // How often each length was met.
        let mut found_in = [0; 4];
        for shift in 0..63_u32 {
            let c = if shift < 62 { (1_i64 << shift) + i64::from(shift) } else { i64::MAX };
            let entries: Vec<Vec<Int>> = signs.iter().map(|&sign| vec![Int::from(c * sign), Int::zero()]).collect();
            let square = Int::from(2_i64).mul(&Int::from(c));
            let square = square.mul(&square);
            let expected = square.mul(&square);
            let minors = Minors::new(4, &entries).unwrap();
            let bits = expected.to_f64().log2() + 1e-6;
            assert_eq!(minors.degree(), 0);
            assert!(minors.determinant(bits, 1.0).is_none());
            if let Some(found) = minors.determinant(bits, f64::INFINITY) {
                assert_eq!(found, [expected]);
                found_in[[62.5, 126.5, 254.5, 510.5].iter().position(|most| bits < *most).unwrap()] += 1;
            } else {
                assert!(bits > 254.0);
            }
            assert_eq!(minors.coefficients::<Wide<8>>(), minors.determinant(500.0, f64::INFINITY).unwrap());
        }
        assert!(found_in[..3].iter().all(|count| *count > 10));
    }

    #[test]
    fn only_small_matrices_of_words_are_taken() {
        let matrix = |size: usize, n: i128| (0..size * size).map(|_| vec![Int::from(n)]).collect::<Vec<_>>();
        assert!(Minors::new(MOST_ROWS, &matrix(MOST_ROWS, 1)).is_some());
        assert!(Minors::new(MOST_ROWS + 1, &matrix(MOST_ROWS + 1, 1)).is_none());
        assert!(Minors::new(2, &matrix(2, 1 << 63)).is_none() && Minors::new(0, &[]).is_none());
    }
}
