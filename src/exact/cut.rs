//! A chain cut into two sides, with one hidden variable: the closure equations as one matrix, linear in that variable.

use super::linkage::{Linkage, Study, one, times, times_axis};
use crate::algebra::ring::Field;
use crate::algebra::univariate::Univariate;
use crate::kinematics::closed_loop::Variable;

/// A chain of up to five variables, cut.
///
/// The dual quaternions of a side are linear in the tensor product of the pairs `c : s` of its variables other than the hidden
/// one, and linear in the hidden pair. A configuration is a pair of tensor products in the kernel of the matrix.
pub(crate) struct Cut<F> {
    /// The variables in loop order from the cut.
    pub order: Vec<usize>,
    /// Place of the hidden one in this order; it belongs to the first side.
    pub hidden: usize,
    /// Number of variables of the first side.
    pub first_side: usize,
    /// The matrix without t, and the factor of t: eight rows.
    pub matrix: [Vec<Vec<F>>; 2],
    /// This power of c divides every determinant of as many rows, mixed or not, as there are columns: infinite distances of
    /// the hidden translation.
    pub at_infinity: usize,
}

/// Number of the variables of the first side of a chain of n.
fn first_side(n: usize) -> usize {
    (n - 1).div_ceil(2) + 1
}

/// The product of a side in which every variable is the first or the second unit of its pair, by the bits of `choice`.
pub(crate) fn side<F: Field>(linkage: &Linkage<F>, variables: &[usize], choice: usize) -> Study<F> {
    variables.iter().enumerate().fold(one(), |product, (bit, k)| {
        let factor = if choice >> bit & 1 == 0 {
            product
        } else {
            times_axis(&product, linkage.variables[*k], &linkage.axes[*k])
        };
        let (x, y) = linkage.links[*k].study();
        let ([a, b, c, d], [e, f, g, h]) = (x, y);
        times(&factor, &[a, b, c, d, e, f, g, h])
    })
}

impl<F: Field> Cut<F> {
    /// Returns all cuts of a chain of n variables: the variable at which each begins, and the place of the hidden variable.
    pub fn all(n: usize) -> impl Iterator<Item = (usize, usize)> {
        (0..n).flat_map(move |first| (0..first_side(n)).map(move |hidden| (first, hidden)))
    }

    /// Returns the cuts that hide a certain variable.
    pub fn hiding(n: usize, variable: usize) -> impl Iterator<Item = (usize, usize)> {
        (0..first_side(n)).map(move |hidden| ((variable + n - hidden) % n, hidden))
    }

    pub fn of(linkage: &Linkage<F>, (first, hidden): (usize, usize)) -> Self {
        let n = linkage.variables.len();
        let order: Vec<usize> = (0..n).map(|k| (first + k) % n).collect();
        let first_side = first_side(n);
        let (left, right) = order.split_at(first_side);
        let mut columns: [Vec<Study<F>>; 2] = [Vec::new(), Vec::new()];
        for power in 0..2 {
            for bits in 0..1_usize << (first_side - 1) {
                // The bits above the hidden place move up by one.
                let low = bits & ((1 << hidden) - 1);
                let choice = (bits - low) << 1 | power << hidden | low;
                columns[power].push(side(linkage, left, choice));
            }
            for bits in 0..1_usize << right.len() {
                let mut column = side(linkage, right, bits);
                for i in [1, 2, 3, 5, 6, 7] {
                    column[i] = column[i].neg();
                }
                // The second side is free of the hidden variable.
                columns[power].push(if power == 0 { column } else { std::array::from_fn(|_| F::zero()) });
            }
        }
        let matrix = columns.map(|columns| (0..8).map(|i| columns.iter().map(|c| c[i].clone()).collect()).collect());
        let at_infinity = at_infinity(linkage, left, right, hidden);
        Self { order, hidden, first_side, matrix, at_infinity }
    }

    /// Number of columns: the products of the variables but the hidden one.
    pub fn columns(&self) -> usize {
        self.matrix[0][0].len()
    }

    /// Returns the matrix with its rows mixed down to the number of columns; with eight columns all rows are kept.
    fn mixed(&self, seed: i32) -> [Vec<Vec<F>>; 2] {
        let columns = self.columns();
        if columns == 8 {
            return self.matrix.clone();
        }
        let weight = |i: usize, j: usize| {
            let (i, j) = (i32::try_from(i).unwrap_or(0), i32::try_from(j).unwrap_or(0));
            F::from_integer(seed.wrapping_mul((i + 2) * (i + 3 * j + 1)).rem_euclid(211) - 105)
        };
        self.matrix.each_ref().map(|m| {
            let entry = |i: usize, c: usize| (0..8).fold(F::zero(), |sum, j| sum.add(&weight(i, j).mul(&m[j][c])));
            (0..columns).map(|i| (0..columns).map(|c| entry(i, c)).collect()).collect()
        })
    }

    /// Returns polynomials in t that vanish wherever the columns are dependent: one where there are as many rows as columns, else
    /// two from mixtures of the rows, since an extraneous factor of the one is not a factor of the other.
    pub fn conditions(&self, determinant: impl Fn(&[Vec<Vec<F>>; 2]) -> Univariate<F>) -> Vec<Univariate<F>> {
        let seeds: &[i32] = if self.columns() == 8 { &[0] } else { &[7919, 104_729] };
        seeds.iter().map(|seed| determinant(&self.mixed(*seed))).collect()
    }

    /// Returns the degree in t that such a polynomial has in general.
    pub fn degree(&self) -> usize {
        1 << (self.first_side - 1)
    }
}

/// A lower bound of the corank of the matrix where the hidden variable is a translation by an infinite distance: columns
/// with the factor eps twice vanish, and those with it once lie in a space of dimension four.
fn at_infinity<F>(linkage: &Linkage<F>, left: &[usize], right: &[usize], hidden: usize) -> usize {
    let is_translation = |k: usize| linkage.variables[k] == Variable::Translation;
    if !is_translation(left[hidden]) {
        return 0;
    }
    let choices = |side: &[usize], others: usize| -> Vec<usize> {
        let count = side.iter().filter(|k| is_translation(**k)).count();
        // For the products of a side: the numbers with no, one, two, ... units eps.
        let mut powers = vec![0; count + others + 1];
        let rotations = side.len() - count;
        for chosen in 0..1_usize << count {
            powers[chosen.count_ones() as usize + others] += 1 << rotations;
        }
        powers
    };
    let rest: Vec<usize> = left.iter().copied().filter(|k| *k != left[hidden]).collect();
    let (first, second) = (choices(&rest, 1), choices(right, 0));
    let of = |power: usize| first.get(power).unwrap_or(&0) + second.get(power).unwrap_or(&0);
    let vanishing: usize = first.iter().skip(2).chain(second.iter().skip(2)).sum();
    vanishing + of(1).saturating_sub(4)
}
