//! Determinants with polynomial entries, known by their residues modulo many primes at all points of a lattice.

use super::batch::{Batch, SIDE, ZeroPivot};
use super::chinese::Chinese;
use super::lanes::{Floats, Lanes, MOST_LANES};
use super::lattice::Lattice;
use super::primes::{count_beyond, primes_beyond};
use super::substitution::{Plan, Values};
use crate::modp::Modulus;
use gmp_mpfr_sys::gmp::limb_t;
use pulp::{Arch, Simd, WithSimd};
use rug::Integer;

/// The number of values, each modulo one prime, beyond which a determinant is not to be found from its values.
const MOST_VALUES: usize = 1 << 24;

/// Returns the number of points at which determinants with coefficients up to `2^bits` may be evaluated.
pub(super) fn most_points(bits: f64, parameters: usize) -> usize {
    MOST_VALUES / usize::max(count_beyond(bits), 4 * parameters)
}

/// The form of the matrix whose determinant is sought.
#[derive(Clone, Copy)]
pub(super) enum Form {
    /// The matrix of this size whose entries the polynomials are, each with the index of its place.
    Matrix(usize),
    /// The hybrid Bezout matrix of two polynomials of these degrees, the first no less than the second, whose
    /// coefficients the polynomials are, constant terms first.
    Resultant(usize, usize),
}

/// A determinant to be found from its values.
pub(super) struct Problem<'a> {
    pub(super) form: Form,
    /// The polynomials that the matrix is made of, term by term.
    pub(super) plan: Plan,
    pub(super) coefficients: Vec<&'a Integer>,
    /// The exponents that the determinant may have.
    pub(super) lattice: Lattice,
    /// The binary logarithm of a bound on the coefficients of the determinant.
    pub(super) bits: f64,
}

impl Form {
    fn size(self) -> usize {
        match self {
            Form::Matrix(size) | Form::Resultant(size, _) => size,
        }
    }

    /// Writes the matrices at four points down.
    #[inline(always)]
    fn fill<L: Lanes>(
        self,
        lanes: L,
        values: &mut Values<L::Element>,
        points: [&[u32]; SIDE],
        batch: &mut Batch<L::Element>,
        group: usize,
    ) {
        let zero = [lanes.zero(); SIDE];
        match self {
            Form::Matrix(_) => {
                let entries = batch.group_mut(group);
                entries.fill(zero);
                values.at(lanes, points, entries);
            }
            Form::Resultant(m, n) => {
                let mut coefficients = vec![zero; m + n + 2];
                values.at(lanes, points, &mut coefficients);
                let (f, g) = coefficients.split_at(m + 1);
                // Row n - i holds F g x^(m - n) - G f, where F and G consist of the i highest terms of f and g, divided
                // by x^(m + 1 - i); so the row of i + 1 follows from that of i by Horner's rule.
                for i in 0..n {
                    let mut negative = zero;
                    for s in 0..SIDE {
                        negative[s] = lanes.sub(lanes.zero(), f[m - i][s]);
                    }
                    for k in 0..m {
                        let mut entry = if i == 0 || k == 0 { zero } else { batch.get(group, n - i, m - k) };
                        let shifted = if k < m - n { &zero } else { &g[k - (m - n)] };
                        for s in 0..SIDE {
                            let sum = lanes.subtract_product(lanes.sum(entry[s]), g[n - i][s], f[k][s]);
                            entry[s] = lanes.reduce(lanes.subtract_product(sum, negative[s], shifted[s]));
                        }
                        batch.set(group, n - 1 - i, m - 1 - k, entry);
                    }
                }
                for i in n..m {
                    for k in 0..m {
                        // Row i holds x^(m - 1 - i) g.
                        let entry = k.checked_sub(m - 1 - i).and_then(|e| g.get(e));
                        batch.set(group, i, m - 1 - k, *entry.unwrap_or(&zero));
                    }
                }
            }
        }
    }
}

impl Problem<'_> {
    /// Returns the coefficients of the determinant, in the order of the lattice.
    pub(super) fn solve(&self, arch: Arch) -> Vec<Integer> {
        // Twice the bound for the sign, and twice that for the margin of the Chinese remainders.
        let primes = primes_beyond(self.bits + 2.0);
        let mut shares = vec![0; self.lattice.count() * primes.len()];
        arch.dispatch(Images { problem: self, primes: &primes, shares: &mut shares });
        let chinese = Chinese::new(&primes);
        shares.chunks_exact(primes.len()).map(|shares| chinese.combine(shares)).collect()
    }
}

/// The coefficients modulo all primes, prepared for the Chinese remainders: by coefficient, then by prime.
struct Images<'a> {
    problem: &'a Problem<'a>,
    primes: &'a [u64],
    shares: &'a mut [i64],
}

impl WithSimd for Images<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        // On the web a fused multiply-add may round twice.
        if S::IS_SCALAR || cfg!(target_family = "wasm") {
            for k in 0..self.primes.len() {
                self.image(Modulus::new(self.primes[k]), k, &[self.primes[k]]);
            }
            return;
        }
        let (mut primes, mut bits) = ([0; MOST_LANES], Vec::new());
        let primes = &mut primes[..S::F64_LANES];
        for first in (0..self.primes.len()).step_by(S::F64_LANES) {
            // The lanes left over repeat the last prime.
            for lane in 0..S::F64_LANES {
                primes[lane] = self.primes[usize::min(first + lane, self.primes.len() - 1)];
            }
            let lanes = Floats::new(simd, primes, &mut bits);
            self.image(lanes, first, primes);
        }
    }
}

/// The size in bytes up to which matrices are eliminated together.
const BATCH_BYTES: usize = 1 << 19;

impl Images<'_> {
    /// Computes the coefficients modulo the primes of these lanes, the first of which has the index `first`.
    #[inline(always)]
    fn image<L: Lanes>(&mut self, lanes: L, first: usize, primes: &[u64]) {
        let (form, lattice) = (self.problem.form, &self.problem.lattice);
        let mut coefficients = Vec::with_capacity(self.problem.coefficients.len());
        let base = lanes.mul(lanes.digit(1 << 16), lanes.digit(1 << 16));
        for c in &self.problem.coefficients {
            coefficients.push(residue(lanes, base, c));
        }
        let mut values = Values::new(lanes, &self.problem.plan, coefficients);

        let matrix_bytes = usize::max(form.size() * (form.size() | 1) * size_of::<L::Element>(), 1);
        let most = usize::max(BATCH_BYTES / matrix_bytes / SIDE, 1);
        let all = lattice.count().div_ceil(SIDE);
        // Equal parts.
        let groups = all.div_ceil(all.div_ceil(most));
        let mut batch = Batch::new(lanes, form.size(), groups);
        let mut images = Vec::with_capacity(lattice.count());
        while images.len() < lattice.count() {
            let (done, left) = (images.len(), lattice.count() - images.len());
            batch.groups = usize::min(groups, left.div_ceil(SIDE));
            for group in 0..batch.groups {
                let mut points = [lattice.point(done + group * SIDE); SIDE];
                for m in 1..usize::min(SIDE, left - group * SIDE) {
                    points[m] = lattice.point(done + group * SIDE + m);
                }
                form.fill(lanes, &mut values, points, &mut batch, group);
            }
            let zeros = batch.eliminate_all(lanes, primes.len());
            for matrix in 0..usize::min(batch.groups * SIDE, left) {
                images.push(batch.determinant(matrix));
            }
            for ZeroPivot { matrix, lane } in zeros {
                if matrix < left {
                    form.fill(lanes, &mut values, [lattice.point(done + matrix); SIDE], &mut batch, 0);
                    let mut residues = [0; MOST_LANES];
                    let residues = &mut residues[..primes.len()];
                    let mut rows = vec![vec![0; form.size()]; form.size()];
                    for i in 0..form.size() {
                        for j in 0..form.size() {
                            lanes.store(batch.get(0, i, j)[0], residues);
                            rows[i][j] = residues[lane];
                        }
                    }
                    let determinant = determinant_modulo(primes[lane], &rows);
                    lanes.store(images[done + matrix], residues);
                    residues[lane] = determinant;
                    images[done + matrix] = lanes.load(residues);
                }
            }
        }
        lattice.interpolate(lanes, &mut images);

        let weight = lanes.inverse(cofactor(lanes, self.primes, primes));
        let width = usize::min(primes.len(), self.primes.len() - first);
        let mut shares = [0; MOST_LANES];
        for (k, &image) in images.iter().enumerate() {
            lanes.store(lanes.mul(image, weight), &mut shares[..primes.len()]);
            self.shares[k * self.primes.len() + first..][..width].copy_from_slice(&shares[..width]);
        }
    }
}

/// Returns the residues of an integer.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the parts of a limb")]
fn residue<L: Lanes>(lanes: L, base: L::Element, integer: &Integer) -> L::Element {
    let mut value = lanes.zero();
    let limbs = integer.as_limbs();
    for (k, &limb) in limbs.iter().enumerate().rev() {
        // A limb has 64 bits or, in WebAssembly, 32.
        for place in (0..limb_t::BITS).step_by(32).rev() {
            let digit = (limb >> place) as u32;
            if digit != 0 || place == 0 || k + 1 < limbs.len() {
                value = lanes.mul_add(value, base, lanes.digit(digit));
            }
        }
    }
    if integer.is_negative() { lanes.sub(lanes.zero(), value) } else { value }
}

/// Returns the product of all primes but the one of the lane, in each lane.
#[inline(always)]
fn cofactor<L: Lanes>(lanes: L, all: &[u64], primes: &[u64]) -> L::Element {
    let mut product = lanes.one();
    let mut differences = [0; MOST_LANES];
    for &q in all {
        for (difference, &p) in differences.iter_mut().zip(primes) {
            *difference = if p == q { 1 } else { q.cast_signed() - p.cast_signed() };
        }
        product = lanes.mul(product, lanes.load(&differences[..primes.len()]));
    }
    product
}

/// Returns the determinant modulo a prime, with a search for pivots.
fn determinant_modulo(prime: u64, rows: &[Vec<i64>]) -> i64 {
    let modulus = Modulus::new(prime);
    let mut rows: Vec<Vec<u64>> =
        rows.iter().map(|row| row.iter().map(|&r| Lanes::load(modulus, &[r])).collect()).collect();
    let mut determinant = modulus.enter(1);
    for k in 0..rows.len() {
        let Some(found) = (k..rows.len()).find(|&i| rows[i][k] != 0) else { return 0 };
        if found != k {
            rows.swap(found, k);
            determinant = Modulus::sub(&modulus, 0, determinant);
        }
        let (above, below) = rows.split_at_mut(k + 1);
        let pivot_row = &above[k][k..];
        determinant = Modulus::mul(&modulus, determinant, pivot_row[0]);
        let inverse = Modulus::inverse(&modulus, pivot_row[0]);
        for row in below {
            let multiplier = Modulus::mul(&modulus, row[k], inverse);
            for (x, &y) in row[k..].iter_mut().zip(pivot_row) {
                *x = Modulus::sub(&modulus, *x, Modulus::mul(&modulus, multiplier, y));
            }
        }
    }
    let mut residue = [0];
    Lanes::store(modulus, determinant, &mut residue);
    residue[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::determinant::bareiss;
    use crate::int::Int;
    use crate::modular::determinant::{by_values, determinant_on, univariate_determinant};
    use crate::modular::primes::primes_beyond;
    use crate::modular::resultant::resultant_on;
    use crate::modular::terms::Terms;
    use crate::univariate::Univariate;
    use rug::Rational;

    /// Integers that only look random.
    fn numbers(seed: u64) -> impl FnMut(i64) -> Integer {
        let mut state = seed;
        move |size| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            Integer::from((state >> 33).cast_signed() % (2 * size + 1) - size)
        }
    }

    /// Returns the determinant by lanes, by the single lane and by Bareiss.
    fn agree(size: usize, entries: &[Vec<Integer>]) {
        let polynomial = |c: &[Integer]| Univariate::new(c.iter().map(|c| Rational::from(c.clone())).collect());
        let rows: Vec<Vec<_>> =
            entries.chunks(size).map(|row| row.iter().map(|entry| polynomial(entry)).collect()).collect();
        let expected = bareiss(&rows);
        let integers = |c: &[Int]| c.iter().map(Int::to_integer).collect::<Vec<_>>();
        let own: Vec<Vec<Int>> = entries.iter().map(|entry| entry.iter().cloned().map(Int::from).collect()).collect();
        for arch in [Arch::new(), Arch::Scalar] {
            assert_eq!(polynomial(&integers(&by_values(arch, size, &own))), expected, "{arch:?}");
        }
        assert_eq!(polynomial(&integers(&univariate_determinant(size, &own))), expected);
    }

    #[test]
    fn pivots_that_vanish_modulo_one_prime_do_no_harm() {
        let [p, q] = [0, 1].map(|k| Integer::from(primes_beyond(100.0)[k]));
        let one = Integer::from(1);
        let entries = |numbers: [&Integer; 9]| numbers.map(|n| vec![n.clone(), Integer::from(3)]).to_vec();
        // A row without zeros is at hand, or each row has a zero in one lane, or in the same lane.
        agree(3, &entries([&p, &one, &q, &one, &p, &q, &p, &one, &p]));
        agree(3, &entries([&p, &one, &q, &q, &p, &p, &q, &q, &one]));
        agree(3, &entries([&p, &one, &q, &p, &p, &one, &p, &q, &one]));
        let constants = [&p, &one, &q, &q, &p, &p, &q, &q, &one].map(|n| vec![n.clone()]);
        agree(3, &constants);
    }

    #[test]
    fn pivots_that_vanish_at_some_points_do_no_harm() {
        // x - k in the first column, so that each row has a zero there at another point.
        let mut number = numbers(1);
        for size in [2, 3, 5] {
            let mut entry = |k: usize| match k % size {
                0 => vec![-Integer::from(k / size), Integer::from(1)],
                _ => vec![number(99), number(99), number(99)],
            };
            agree(size, &(0..size * size).map(&mut entry).collect::<Vec<_>>());
        }
    }

    #[test]
    fn the_size_of_the_matrix_and_of_its_entries_does_not_matter() {
        let mut number = numbers(2);
        for size in [1, 2, 4, 13, 16] {
            agree(size, &(0..size * size).map(|_| vec![number(1 << 30), number(5)]).collect::<Vec<_>>());
        }
        let huge = |k: u32| (number(1 << 30) << 2000) + number(1 << 30) - (Integer::from(1) << (2000 - k));
        let entries: Vec<Integer> = (0..18).map(huge).collect();
        agree(3, &entries.chunks(2).map(<[Integer]>::to_vec).collect::<Vec<_>>());
    }

    #[test]
    fn matrices_of_rank_less_than_their_size_have_determinant_zero() {
        let mut number = numbers(3);
        let half: Vec<Vec<Integer>> = (0..12).map(|_| vec![number(99), number(99)]).collect();
        // The second half of the rows repeats the first.
        agree(4, &[&half[..8], &half[..8]].concat());
        agree(4, &[&half[..4], &half[..12]].concat());
        let zero = vec![vec![]; 4];
        agree(4, &[&half[..12], &zero[..]].concat());
        agree(1, &[vec![]]);
        agree(2, &[vec![], vec![number(9)], vec![], vec![number(9)]]);
        // A zero block, which leaves no pivot in any lane before the last column.
        let block = |k: usize| if k / 4 < 3 && k % 4 < 2 { vec![] } else { vec![number(9), number(9)] };
        agree(4, &(0..16).map(block).collect::<Vec<_>>());
    }

    /// Hadamard's matrix of size 4 times c has determinant `16 c^4`, which is the bound itself.
    #[test]
    fn coefficients_as_large_as_their_bound_come_out() {
        let signs = [1, 1, 1, 1, 1, -1, 1, -1, 1, 1, -1, -1, 1, -1, -1, 1];
        for shift in 0..50_u32 {
            let c = (Integer::from(1) << shift) + shift;
            for first in [1, -1] {
                let entry = |(k, sign): (usize, i32)| Terms {
                    exponents: vec![],
                    coefficients: vec![Integer::from(&c * if k < 4 { first * sign } else { sign })],
                };
                let entries: Vec<Terms> = signs.into_iter().enumerate().map(entry).collect();
                let rows: Vec<Vec<Terms>> = entries.chunks(4).map(<[Terms]>::to_vec).collect();
                let determinant = determinant_on(Arch::new(), &rows, 0).unwrap();
                assert_eq!(determinant.coefficients, [Integer::from(&c * 2).square().square() * first]);
            }
        }
    }

    #[test]
    fn resultants_agree_in_all_lanes_and_in_one() {
        let mut number = numbers(4);
        let polynomial = |number: &mut dyn FnMut(i64) -> Integer, degree: u32| {
            let mut terms = Terms::default();
            for (i, j, k) in (0..=degree).flat_map(|i| (0..=degree - i).map(move |j| (i, j, (degree - i - j) / 2))) {
                terms.exponents.extend([i, j, k]);
                terms.coefficients.push(number(1 << 20));
            }
            terms
        };
        for (m, n) in [(3, 3), (2, 4), (4, 1), (0, 2)] {
            let (f, g) = (polynomial(&mut number, m), polynomial(&mut number, n));
            for variable in 0..3 {
                let [by_lanes, by_one] =
                    [Arch::new(), Arch::Scalar].map(|arch| resultant_on(arch, &f, &g, 3, variable));
                assert_eq!(by_lanes, by_one);
            }
        }
    }
}
