//! The border basis itself: relations of each degree, solved, from the level below.
//!
//! Every relation of degree d is a row over the candidates `z_i b` (i = 1..3, b of level d - 1; products of `tau` come
//! behind them) and over the basis of lower levels. From degree 3 on the products must commute,
//! `z_i (z_j b) = z_j (z_i b)`; the equations of the platform bring further relations in degrees 2, 3 and 4, and their
//! multiples by `tau` in degrees 4, 5 and 6.

use super::arithmetic::{Arithmetic, LEVEL, LOW, MOST_CANDIDATES, MOST_RELATIONS, Relations, STRIDE, Split, WIDTH};
use super::directions::MOST;
use super::setting::Setting;
use crate::closure::study::{Form, left, right};

/// Dimension of the quotient algebra: the number of solutions of the general platform.
pub const DIMENSION: usize = 40;
/// Sizes of the levels.
pub const LEVELS: [usize; 8] = [1, 3, 7, 9, 9, 7, 3, 1];
/// Where the levels begin.
const START: [usize; 9] = [0, 1, 4, 11, 20, 29, 36, 39, 40];
/// The level of every basis element.
const LEVEL_OF: [usize; DIMENSION] = {
    let mut table = [0; DIMENSION];
    let mut level = 0;
    while level < 8 {
        let mut k = START[level];
        while k < START[level + 1] {
            table[k] = level;
            k += 1;
        }
        level += 1;
    }
    table
};

/// The error where a level of the quotient algebra has another rank than for the general platform: the geometry is special.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LostRank {
    /// The degree.
    pub degree: usize,
    /// Rank of the relations found.
    pub found: usize,
    /// Their rank for the general platform.
    pub expected: usize,
}

/// A vector over the whole basis.
type Vector<E> = [E; DIMENSION];

/// The multiplication matrices, and the memory to compute them.
#[derive(Clone, Debug)]
pub struct BorderBasis<E> {
    /// `z_i b` for i = 1..3 and every basis element b: coefficients of the basis.
    pub products: [Vec<Vector<E>>; 3],
    /// The smallest pivot of all degrees over the largest of its degree.
    pub quality: f64,
    /// `tau_a b` for b up to level 3, as far as they are known.
    tau_products: [Vec<Vector<E>>; MOST],
    /// `tau_a b` for the b of one level, before it is reduced.
    tau_rows: [Vec<Row<E>>; MOST],
    relations: Relations<E>,
    split: Split<E>,
    /// The elements of levels 2 and 3 as combinations of their candidates.
    lifts: [Vec<E>; 2],
    /// Relations of degrees 2, 3 and 4, kept to be multiplied by tau later.
    kept: [Vec<Row<E>>; 3],
}

/// A relation, or a product not yet reduced.
type Row<E> = [E; STRIDE];

impl<E: Copy + PartialEq + std::fmt::Debug> BorderBasis<E> {
    /// Memory for border bases.
    pub fn new<A: Arithmetic<Element = E>>(arithmetic: &A) -> Self {
        let zero = arithmetic.zero();
        let vectors = |count: usize| vec![[zero; DIMENSION]; count];
        let rows = |count: usize| vec![[zero; STRIDE]; count];
        Self {
            products: std::array::from_fn(|_| vectors(DIMENSION)),
            quality: 0.0,
            tau_products: std::array::from_fn(|_| vectors(START[4])),
            tau_rows: std::array::from_fn(|_| rows(LEVEL)),
            relations: Relations { rows: vec![zero; MOST_RELATIONS * STRIDE], count: 0, candidates: 0, low: 0 },
            split: Split { normal: vec![zero; MOST_CANDIDATES * WIDTH], lift: vec![zero; MOST_CANDIDATES * LEVEL] },
            lifts: std::array::from_fn(|_| vec![zero; MOST_CANDIDATES * LEVEL]),
            kept: [rows(2), rows(4), rows(8)],
        }
    }

    /// Computes the multiplication matrices of a platform.
    ///
    /// # Errors
    /// [`LostRank`] for special geometries.
    pub fn build<A: Arithmetic<Element = E>>(&mut self, arithmetic: &A, setting: &Setting<E>) -> Result<(), LostRank> {
        Building { arithmetic, setting, memory: self }.run()
    }
}

/// One border basis being computed.
struct Building<'a, A: Arithmetic> {
    arithmetic: &'a A,
    setting: &'a Setting<A::Element>,
    memory: &'a mut BorderBasis<A::Element>,
}

impl<A: Arithmetic> Building<'_, A> {
    fn run(&mut self) -> Result<(), LostRank> {
        let (zero, one) = (self.arithmetic.zero(), self.arithmetic.one());
        self.memory.quality = 1.0;
        for i in 0..3 {
            self.memory.products[i][0] = [zero; DIMENSION];
            self.memory.products[i][0][1 + i] = one;
        }
        let count = self.setting.count;
        for degree in 2..=8 {
            let tau_candidates = match degree {
                4 => count * (count + 1) / 2,
                6 => count * (count + 1) * (count + 2) / 6,
                _ => 0,
            };
            self.memory.relations.count = 0;
            self.memory.relations.candidates = 3 * LEVELS[degree - 1] + tau_candidates;
            self.memory.relations.low = if degree == 2 { 4 + count } else { START[degree] };
            self.commutation(degree);
            match degree {
                2 => self.dropped_legs(),
                3 => self.cubics(),
                4 => self.degree_four(),
                5 => self.degree_five(),
                6 => self.degree_six(),
                _ => {}
            }
            self.solve(degree)?;
        }
        Ok(())
    }

    /// A new relation, all zeros.
    fn push(&mut self, row: &Row<A::Element>) {
        let relations = &mut self.memory.relations;
        let at = relations.count * STRIDE;
        relations.rows[at..at + STRIDE].copy_from_slice(row);
        relations.count += 1;
    }

    fn empty(&self) -> Row<A::Element> {
        [self.arithmetic.zero(); STRIDE]
    }

    /// `row += z_i v` in this degree, for v over the levels below it; `z_0 = 1`.
    fn add_product(&self, row: &mut Row<A::Element>, degree: usize, i: usize, v: &[A::Element]) {
        let (start, end) = (START[degree - 1], START[degree]);
        let arithmetic = self.arithmetic;
        if i == 0 {
            for (target, &source) in row[LOW..LOW + end].iter_mut().zip(v) {
                *target = arithmetic.add(*target, source);
            }
            return;
        }
        let lead = (i - 1) * LEVELS[degree - 1];
        for (target, &source) in row[lead..].iter_mut().zip(&v[start..end]) {
            *target = arithmetic.add(*target, source);
        }
        let products = &self.memory.products[i - 1];
        let terms = v[..start].iter().enumerate().map(|(c, &factor)| (factor, &products[c][..START[LEVEL_OF[c] + 2]]));
        arithmetic.add_combination(&mut row[LOW..LOW + end], terms);
    }

    /// `z_i v` as a vector, for v up to a level below the ones known; `z_0 = 1`.
    fn times(&self, i: usize, v: &Vector<A::Element>, length: usize) -> Vector<A::Element> {
        if i == 0 {
            return *v;
        }
        let mut product = [self.arithmetic.zero(); DIMENSION];
        let products = &self.memory.products[i - 1];
        let terms = v[..length].iter().enumerate().map(|(c, &factor)| (factor, &products[c][..START[LEVEL_OF[c] + 2]]));
        self.arithmetic.add_combination(&mut product, terms);
        product
    }

    /// `z_i (z_j b) - z_j (z_i b)` for all b two levels below.
    fn commutation(&mut self, degree: usize) {
        for b in START[degree - 2]..START[degree - 1] {
            for (i, j) in [(1, 2), (1, 3), (2, 3)] {
                let mut row = self.empty();
                self.add_product(&mut row, degree, j, &self.memory.products[i - 1][b]);
                for x in &mut row {
                    *x = self.arithmetic.neg(*x);
                }
                self.add_product(&mut row, degree, i, &self.memory.products[j - 1][b]);
                self.push(&row);
            }
        }
    }

    /// The conditions left by the weak directions: relations between products of two z.
    fn dropped_legs(&mut self) {
        for a in 0..self.setting.count - 1 {
            let mut row = self.empty();
            let form = &self.setting.dropped[a];
            for i in 1..4 {
                for k in 1..4 {
                    row[(i - 1) * 3 + k - 1] = form[i][k];
                }
                row[LOW + i] = self.arithmetic.add(form[0][i], form[0][i]);
            }
            row[LOW] = form[0][0];
            for b in 0..self.setting.count {
                row[LOW + 4 + b] = self.arithmetic.neg(self.setting.slopes[a][b]);
            }
            self.memory.kept[0][a] = row;
            self.push(&row);
        }
    }

    /// A quadratic form as a vector over levels 0 to 2.
    fn quadratic(&self, form: &Form<A::Element>) -> Vector<A::Element> {
        let mut v = [self.arithmetic.zero(); DIMENSION];
        v[0] = form[0][0];
        for i in 1..4 {
            v[i] = self.arithmetic.add(v[i], self.arithmetic.add(form[0][i], form[0][i]));
        }
        for i in 1..4 {
            for j in 1..4 {
                self.arithmetic.add_multiple(
                    &mut v[..START[3]],
                    form[i][j],
                    &self.memory.products[i - 1][j][..START[3]],
                );
            }
        }
        v
    }

    /// `u = N (p.p, p, R^T p)` as vectors over levels 0 to 2.
    fn unknowns(&self) -> [Vector<A::Element>; 7] {
        std::array::from_fn(|k| {
            let mut v = self.quadratic(&self.setting.forms[k]);
            for a in 0..self.setting.count {
                v[4 + a] = self.arithmetic.add(v[4 + a], self.setting.null[a][k]);
            }
            v
        })
    }

    /// `x q - p x = 0`: the second and third part of u belong to one translation.
    fn cubics(&mut self) {
        let u = self.unknowns();
        let [right, left] = unit_products();
        for i in 0..4 {
            let mut row = self.empty();
            for j in 0..4 {
                let mut factor = [self.arithmetic.zero(); DIMENSION];
                for k in 0..3 {
                    self.add_signed(&mut factor, right[k][i][j], &u[4 + k]);
                    self.add_signed(&mut factor, -left[k][i][j], &u[1 + k]);
                }
                self.add_product(&mut row, 3, j, &factor);
            }
            self.memory.kept[1][i] = row;
            self.push(&row);
        }
    }

    /// `target += sign source` for a sign of 1, 0 or -1.
    fn add_signed(&self, target: &mut Vector<A::Element>, sign: f64, source: &Vector<A::Element>) {
        for (t, s) in target.iter_mut().zip(source) {
            if sign > 0.0 {
                *t = self.arithmetic.add(*t, *s);
            } else if sign < 0.0 {
                *t = self.arithmetic.sub(*t, *s);
            }
        }
    }

    /// The place of `tau_a tau_b` among the candidates of degree 4.
    fn pair(&self, a: usize, b: usize) -> usize {
        let (a, b) = (a.min(b), a.max(b));
        27 + a * self.setting.count - a * (a + 1) / 2 + b
    }

    /// The place of `tau_a tau_b tau_c` among the candidates of degree 6.
    fn triple(&self, a: usize, b: usize, c: usize) -> usize {
        let mut sorted = [a, b, c];
        sorted.sort_unstable();
        let n = self.setting.count;
        let all = (0..n).flat_map(|i| (i..n).flat_map(move |j| (j..n).map(move |k| [i, j, k])));
        21 + all.take_while(|triple| *triple != sorted).count()
    }

    /// `p.p = q.q = N s`, and multiples of the conditions of degree 2.
    fn degree_four(&mut self) {
        self.tau_times_level_two();
        let u = self.unknowns();
        for (kept, part) in [1..4, 4..7].into_iter().enumerate() {
            // sum_i z_i (sum_kj S_k[i][j] z_j u_k - z_i s) + sum_a tau_a sum_k null_a[k] u_k
            let mut row = self.empty();
            let shifted: [[Vector<A::Element>; 4]; 3] =
                std::array::from_fn(|m| std::array::from_fn(|j| self.times(j, &u[part.start + m], START[3])));
            for i in 0..4 {
                let mut factor = self.times(i, &u[0], START[3]);
                for x in &mut factor {
                    *x = self.arithmetic.neg(*x);
                }
                for (k, shifted) in part.clone().zip(&shifted) {
                    for (j, vector) in shifted.iter().enumerate() {
                        let weight = self.setting.forms[k][i][j];
                        self.arithmetic.add_multiple(&mut factor[..START[4]], weight, &vector[..START[4]]);
                    }
                }
                self.add_product(&mut row, 4, i, &factor);
            }
            for a in 0..self.setting.count {
                let mut v = [self.arithmetic.zero(); DIMENSION];
                for k in part.clone() {
                    self.arithmetic.add_multiple(&mut v[..START[3]], self.setting.null[a][k], &u[k][..START[3]]);
                }
                self.add_tau_row(&mut row, a, &v);
            }
            self.memory.kept[2][kept] = row;
            self.push(&row);
        }
        // tau_a times the conditions; the row of tau_a F_b is kept where it is multiplied once more.
        let count = self.setting.count;
        for a in 0..count {
            for b in 0..count - 1 {
                let condition = self.memory.kept[0][b];
                let mut row = self.empty();
                for i in 1..4 {
                    for k in 1..4 {
                        let mut v = [self.arithmetic.zero(); DIMENSION];
                        let product = &self.memory.products[k - 1][4 + a];
                        self.arithmetic.add_multiple(&mut v, condition[(i - 1) * 3 + k - 1], product);
                        self.add_product(&mut row, 4, i, &v);
                    }
                }
                let mut low = [self.arithmetic.zero(); DIMENSION];
                low[..4 + count].copy_from_slice(&condition[LOW..LOW + 4 + count]);
                self.add_tau_row(&mut row, a, &low);
                self.memory.kept[2][2 + a * (count - 1) + b] = row;
                self.push(&row);
            }
        }
    }

    /// `tau_a b` for b up to level 2: of levels 0 and 1 as vectors, of level 2 as rows of degree 4.
    fn tau_times_level_two(&mut self) {
        let (zero, one) = (self.arithmetic.zero(), self.arithmetic.one());
        let count = self.setting.count;
        for a in 0..count {
            self.memory.tau_products[a][0] = [zero; DIMENSION];
            self.memory.tau_products[a][0][4 + a] = one;
            for j in 0..3 {
                self.memory.tau_products[a][1 + j] = self.memory.products[j][4 + a];
            }
            for b in 0..LEVELS[2] {
                let mut row = self.empty();
                if b < count {
                    row[self.pair(a, b)] = one;
                } else {
                    // b is the sum of lift (z_i z_j); the degree 4 row of z_i (z_j tau_a).
                    for i in 1..4 {
                        let mut v = [zero; DIMENSION];
                        for j in 0..3 {
                            let weight = self.memory.lifts[0][((i - 1) * 3 + j) * LEVEL + b - count];
                            self.arithmetic.add_multiple(&mut v, weight, &self.memory.products[j][4 + a]);
                        }
                        self.add_product(&mut row, 4, i, &v);
                    }
                }
                self.memory.tau_rows[a][b] = row;
            }
        }
    }

    /// `row += tau_a v` in degree 4, for v over levels 0 to 2.
    fn add_tau_row(&self, row: &mut Row<A::Element>, a: usize, v: &Vector<A::Element>) {
        for b in 0..4 {
            self.arithmetic.add_multiple(
                &mut row[LOW..LOW + START[4]],
                v[b],
                &self.memory.tau_products[a][b][..START[4]],
            );
        }
        for b in 0..LEVELS[2] {
            self.arithmetic.add_multiple(row, v[START[2] + b], &self.memory.tau_rows[a][b]);
        }
    }

    /// Multiples of the cubics by tau.
    fn degree_five(&mut self) {
        for a in 0..self.setting.count {
            for b in 0..LEVELS[3] {
                let mut row = self.empty();
                for i in 1..4 {
                    let mut v = [self.arithmetic.zero(); DIMENSION];
                    let terms = (0..LEVELS[2]).map(|c| {
                        let weight = self.memory.lifts[1][((i - 1) * LEVELS[2] + c) * LEVEL + b];
                        (weight, &self.memory.tau_products[a][START[2] + c][..START[5]])
                    });
                    self.arithmetic.add_combination(&mut v[..START[5]], terms);
                    self.add_product(&mut row, 5, i, &v);
                }
                self.memory.tau_rows[a][b] = row;
            }
            for i in 0..4 {
                let row = self.tau_multiple(5, a, &self.memory.kept[1][i]);
                self.push(&row);
            }
        }
    }

    /// Multiples of the relations of degree 4 by tau.
    fn degree_six(&mut self) {
        let count = self.setting.count;
        for a in 0..count {
            for kept in 0..2 + count * (count - 1) {
                // tau_a tau_b F is the same as tau_b tau_a F.
                if kept >= 2 && (kept - 2) / (count - 1) < a {
                    continue;
                }
                let relation = self.memory.kept[2][kept];
                let mut row = self.tau_multiple(6, a, &relation);
                for b in 0..count {
                    for c in b..count {
                        let at = self.triple(a, b, c);
                        row[at] = self.arithmetic.add(row[at], relation[self.pair(b, c)]);
                    }
                }
                self.push(&row);
            }
        }
    }

    /// `tau_a` times a relation of two degrees less, products of `tau` in it left out.
    fn tau_multiple(&self, degree: usize, a: usize, relation: &Row<A::Element>) -> Row<A::Element> {
        let mut row = self.empty();
        let (level, reach) = (degree - 3, START[degree]);
        let (size, start) = (LEVELS[level], START[level]);
        for i in 1..4 {
            let mut v = [self.arithmetic.zero(); DIMENSION];
            let products = &self.memory.tau_products[a][start..start + size];
            let terms = products.iter().enumerate().map(|(b, p)| (relation[(i - 1) * size + b], &p[..reach]));
            self.arithmetic.add_combination(&mut v[..reach], terms);
            self.add_product(&mut row, degree, i, &v);
        }
        let products = &self.memory.tau_products[a][..START[level + 1]];
        let terms = products.iter().enumerate().map(|(b, p)| (relation[LOW + b], &p[..reach]));
        self.arithmetic.add_combination(&mut row[LOW..LOW + reach], terms);
        row
    }

    /// Solves the relations of a degree and stores what follows.
    fn solve(&mut self, degree: usize) -> Result<(), LostRank> {
        let memory = &mut *self.memory;
        let new = if degree == 8 { 0 } else { LEVELS[degree] } - if degree == 2 { self.setting.count } else { 0 };
        let expected = memory.relations.candidates - new;
        match self.arithmetic.solve(&mut memory.relations, expected, &mut memory.split) {
            Ok(quality) => memory.quality = memory.quality.min(quality),
            Err(found) => return Err(LostRank { degree, found, expected }),
        }
        let (size, start) = (LEVELS[degree - 1], START[degree - 1]);
        let width = memory.relations.low + new;
        for i in 0..3 {
            for b in 0..size {
                let normal = &memory.split.normal[(i * size + b) * WIDTH..][..width];
                let product = &mut memory.products[i][start + b];
                product[..width].copy_from_slice(normal);
                product[width..].fill(self.arithmetic.zero());
            }
        }
        if degree == 2 || degree == 3 {
            memory.lifts[degree - 2].copy_from_slice(&memory.split.lift);
        }
        if degree == 4 || degree == 5 {
            let level = degree - 2;
            for a in 0..self.setting.count {
                for b in 0..LEVELS[level] {
                    let row = &memory.tau_rows[a][b];
                    let product = &mut memory.tau_products[a][START[level] + b];
                    product.fill(self.arithmetic.zero());
                    product[..START[degree]].copy_from_slice(&row[LOW..LOW + START[degree]]);
                    let normal = memory.split.normal.chunks_exact(WIDTH).take(memory.relations.candidates);
                    let terms = row.iter().zip(normal).map(|(&c, normal)| (c, &normal[..width]));
                    self.arithmetic.add_combination(&mut product[..width], terms);
                }
            }
        }
        Ok(())
    }
}

/// The matrices of the products with i, j, k on the right and on the left.
fn unit_products() -> [[Form<f64>; 3]; 2] {
    let unit = |k: usize| std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 });
    [std::array::from_fn(|k| right(&unit(k))), std::array::from_fn(|k| left(&unit(k)))]
}
