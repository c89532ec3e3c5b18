//! Cramer's rule on the cycles of a group: a square matrix in a few parameters, singular at every solution.
//!
//! One of the classes is at rest, one is hidden with the rotation x, and m others are left; the equations are vectors of
//! 2 L halves, `e0(x) = (c_0 + c_x x; c_0' + c_x'/x)`, `a_j = (c_j; 0)`, `b_j = (0; c_j')`, and a constant vector for
//! every slide of the class at rest. Further parameters, an input or a point that is
//! traced, stand in e0 as x does. For a set S of classes let N_S be the rows a_j (j not in S), b_j (j in S) and all
//! slides. Where N_S has full rank, with the vector n_S of its maximal minors and `v_S = prod_(j in S) 1/theta_j`,
//!
//! `(e0(x) n_S) v_S + sum_(j in S) (a_j n_S) v_(S - j) + sum_(j not in S) (b_j n_S) v_(S + j) = 0`.
//!
//! A set that appears with a coefficient that is not zero has full rank itself. A solution whose rotations are finite and
//! not zero therefore has an x at which the matrix of these rows is singular, whatever its determinant is elsewhere.
//!
//! A class that turns may have one slide s, with the vectors `p = (u; 0)` and `q = (0; u')`: a joint at infinity, at which the two
//! sets that hold one of its two bodies have become equal. It has four members in the place of two, with the factors 1, `1/theta`,
//! `s/theta` and `1/theta^2` of v. The rows of the first are a and p, those of the last b and q, those of the other two p and q. The third has
//! the equation of `n_0 + s n_1`, where n_1 is the vector of the second, and n_0 has `p n_0 = -a n_1` and `q n_0 = -b n_1`, and is
//! orthogonal to all else, so that no power of s is left. Where several classes are in that state, n has a part for every product of
//! their slides.

use super::equations::Equations;
use super::isotropic::Isotropic;
use crate::algebra::ring::{Field, Ring};
use std::collections::BTreeMap;

/// The unknown on which the entries of the matrix depend, beside the data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// The rotation x of a class: its first halves stand before x, its second ones before 1/x.
    Turn(usize),
    /// The displacement s of a slide of the class at rest.
    Shift(usize),
    /// A point z of the class at rest, which the last cycle subtracts: its mirror image stands in the second half.
    Point,
}

/// The coefficient of a set in an equation.
#[derive(Clone, Debug)]
pub struct Entry<R> {
    /// The column of the set.
    pub column: usize,
    /// The part without parameters.
    pub constant: R,
    /// For every parameter the coefficients of it and of its mirror image there; a shift has the first alone.
    pub by: Vec<[R; 2]>,
}

/// One row: the equation of a set.
#[derive(Clone, Debug)]
pub struct Row<R> {
    /// The coefficients with parameters: of the set itself and, where slides turn with a class, of those without them.
    pub entries: Vec<Entry<R>>,
    /// Columns of other sets with their coefficients.
    pub others: Vec<(usize, R)>,
}

/// The matrix.
#[derive(Clone, Debug)]
pub struct Pencil<R> {
    /// The sets, as bits of the classes in `classes`; a class with a slide has two bits, the lower of `1/theta`, the upper of `s/theta`.
    pub sets: Vec<u32>,
    /// One row for every set.
    pub rows: Vec<Row<R>>,
    /// The classes that are neither at rest nor parameters, those without slides first.
    pub classes: Vec<usize>,
    /// The number of those without slides.
    pub plain: usize,
    /// The parameters.
    pub parameters: Vec<Parameter>,
}

/// Reduces rows of one column less than their own number of unknowns, and of further columns, to unit columns at the places that are
/// returned; `None` where they are dependent.
fn reduced<R: Field>(rows: &mut [Vec<R>]) -> Option<Vec<usize>> {
    let size = rows.len();
    let mut pivots: Vec<usize> = Vec::new();
    for k in 0..size {
        let (row, column) = (k..size)
            .flat_map(|i| (0..=size).map(move |j| (i, j)))
            .filter(|(i, j)| {
                !pivots.contains(j) && rows[*i][*j].pivot_size() > R::PIVOT_ZERO && !rows[*i][*j].is_zero()
            })
            .max_by(|a, b| rows[a.0][a.1].pivot_size().total_cmp(&rows[b.0][b.1].pivot_size()))?;
        rows.swap(k, row);
        pivots.push(column);
        let inverse = rows[k][column].inverse()?;
        let pivot: Vec<R> = rows[k].iter().map(|x| x.mul(&inverse)).collect();
        for (i, other) in rows.iter_mut().enumerate() {
            if i == k || other[column].is_zero() {
                continue;
            }
            let factor = other[column].clone();
            for (x, y) in other.iter_mut().zip(&pivot) {
                if !y.is_zero() {
                    *x = x.sub(&factor.mul(y));
                }
            }
        }
        rows[k] = pivot;
    }
    Some(pivots)
}

/// A vector that is orthogonal to the rows of a matrix with one column more than rows; `None` where these are dependent.
fn orthogonal<R: Field>(mut rows: Vec<Vec<R>>) -> Option<Vec<R>> {
    let size = rows.len();
    let pivots = reduced(&mut rows)?;
    let free = (0..=size).find(|column| !pivots.contains(column))?;
    let mut vector = vec![R::zero(); size + 1];
    vector[free] = R::one();
    for (row, column) in rows.iter().zip(&pivots) {
        vector[*column] = row[free].neg();
    }
    Some(vector)
}

/// A vector that has these products with the rows of such a matrix.
fn with_products<R: Field>(rows: &[Vec<R>], products: Vec<R>) -> Option<Vec<R>> {
    let size = rows.len();
    let mut rows: Vec<Vec<R>> = rows.iter().zip(products).map(|(row, x)| [row.as_slice(), &[x]].concat()).collect();
    let pivots = reduced(&mut rows)?;
    let mut vector = vec![R::zero(); size + 1];
    for (row, column) in rows.iter().zip(&pivots) {
        vector[*column] = row[size + 1].clone();
    }
    Some(vector)
}

fn dot<R: Ring>(row: &[R], vector: &[R]) -> R {
    row.iter()
        .zip(vector)
        .filter(|(x, y)| !x.is_zero() && !y.is_zero())
        .fold(R::zero(), |sum, (x, y)| sum.add(&x.mul(y)))
}

/// The two halves of the vectors of a class or of a slide, `[(c; 0), (0; c')]`.
type Halves<R> = [Vec<R>; 2];

/// A class with a slide that turns with it.
struct Sliding<R> {
    /// The lower of its bits.
    bit: u32,
    class: Halves<R>,
    slide: Halves<R>,
}

impl<R> Sliding<R> {
    /// The state in a set: 0 to 3 for 1, `1/theta`, `s/theta` and `1/theta^2`.
    fn state(&self, set: u32) -> u32 {
        (set / self.bit) & 3
    }

    /// The set with another state.
    fn with(&self, set: u32, state: u32) -> u32 {
        set & !(3 * self.bit) | (state * self.bit)
    }
}

/// What the rows are made of.
struct Columns<R> {
    plain: Vec<Halves<R>>,
    sliding: Vec<Sliding<R>>,
    /// The slides of the class at rest.
    along: Vec<Vec<R>>,
}

impl<R: Field> Columns<R> {
    /// The rows of a set, and the vectors of its equation with the sets without which they stand there, all slides first; `None` where the rows
    /// are dependent.
    fn vectors(&self, set: u32) -> Option<Vec<(u32, Vec<R>)>> {
        let mut rows: Vec<Vec<R>> =
            self.plain.iter().enumerate().map(|(j, halves)| halves[(set >> j & 1) as usize].clone()).collect();
        for one in &self.sliding {
            let [a, b] = &one.class;
            let [p, q] = &one.slide;
            let pair = match one.state(set) {
                0 => [a, p],
                3 => [b, q],
                _ => [p, q],
            };
            rows.extend(pair.map(Clone::clone));
        }
        rows.extend(self.along.iter().cloned());
        let mut vectors = vec![(set, orthogonal(rows.clone())?)];
        let open: Vec<usize> = (0..self.sliding.len()).filter(|k| self.sliding[*k].state(set) == 2).collect();
        // Parts of the sets with fewer slides stand on those with one more.
        let mut order: Vec<u32> = (1..1_u32 << open.len()).collect();
        order.sort_by_key(|without| without.count_ones());
        let without = |bits: u32| {
            let gone = open.iter().enumerate().filter(|(i, _)| bits >> i & 1 == 1);
            gone.fold(set, |set, (_, k)| self.sliding[*k].with(set, 1))
        };
        for bits in order {
            let mut products = vec![R::zero(); rows.len()];
            for (i, k) in open.iter().enumerate().filter(|(i, _)| bits >> i & 1 == 1) {
                let above = without(bits ^ (1 << i));
                let (_, above) = vectors.iter().find(|(own, _)| *own == above)?;
                for half in 0..2 {
                    let place = self.plain.len() + 2 * k + half;
                    products[place] = dot(&self.sliding[*k].class[half], above).neg();
                }
            }
            vectors.push((without(bits), with_products(&rows, products)?));
        }
        Some(vectors)
    }

    /// The other sets to which the equation of a vector leads, and their coefficients.
    fn others(&self, set: u32, vector: &[R]) -> Vec<(u32, R)> {
        let mut list = Vec::new();
        for (j, halves) in self.plain.iter().enumerate() {
            list.push((set ^ (1 << j), dot(&halves[1 - (set >> j & 1) as usize], vector)));
        }
        for one in &self.sliding {
            let [a, b] = &one.class;
            let [p, q] = &one.slide;
            let pair = match one.state(set) {
                0 => [(1, b), (2, q)],
                3 => [(1, a), (2, p)],
                1 => [(0, a), (3, b)],
                // Of the part with s nothing is left.
                _ => continue,
            };
            list.extend(pair.map(|(state, row)| (one.with(set, state), dot(row, vector))));
        }
        list.retain(|(_, factor)| !factor.is_zero());
        list
    }
}

impl<R: Field> Pencil<R> {
    /// The matrix with the class `rest` at rest and these parameters; `None` for other classes with more than one slide, for
    /// parameters with slides that turn, and for systems that are not square.
    #[must_use]
    pub fn new(equations: &Equations<Isotropic<R>>, rest: usize, parameters: &[Parameter]) -> Option<Self> {
        Self::of_sets(equations, rest, parameters, None)
    }

    /// As [`Self::new`], with the rows of these sets where those of all others are known to be dependent; `None` if these are not proved to be
    /// independent.
    #[must_use]
    pub fn of_sets(
        equations: &Equations<Isotropic<R>>,
        rest: usize,
        parameters: &[Parameter],
        known: Option<&[u32]>,
    ) -> Option<Self> {
        let loops = equations.loops();
        let has = |parameter: Parameter| parameters.contains(&parameter);
        let of = |class: usize| equations.slides.iter().enumerate().filter(move |(_, slide)| slide.class == class);
        let (mut classes, sliding): (Vec<usize>, Vec<usize>) = (0..equations.classes)
            .filter(|class| *class != rest && !has(Parameter::Turn(*class)))
            .partition(|class| of(*class).count() == 0);
        let slides: Vec<usize> = of(rest).map(|(q, _)| q).filter(|q| !has(Parameter::Shift(*q))).collect();
        let plain = classes.len();
        classes.extend(&sliding);
        // Sets are bits of a word.
        let bits = plain + 2 * sliding.len();
        let is_square = bits + slides.len() + 1 == 2 * loops && bits < 32;
        let is_free = |parameter: &Parameter| match parameter {
            Parameter::Turn(class) => of(*class).count() == 0,
            Parameter::Shift(q) => equations.slides[*q].class == rest,
            Parameter::Point => true,
        };
        if !is_square || !parameters.iter().all(is_free) || sliding.iter().any(|class| of(*class).count() > 1) {
            return None;
        }
        let zeros = || vec![R::zero(); loops];
        let halves = |list: Vec<Isotropic<R>>| -> Halves<R> {
            let (z, w): (Vec<R>, Vec<R>) = list.into_iter().map(|n| (n.z, n.w)).unzip();
            [[z, zeros()].concat(), [zeros(), w].concat()]
        };
        let class = |class: usize| halves(equations.cycles.iter().map(|cycle| cycle[class].clone()).collect());
        let slide = |q: usize| halves(equations.slides[q].coefficients.clone());
        let both = |[z, w]: Halves<R>| -> Vec<R> { z.iter().zip(&w).map(|(z, w)| z.add(w)).collect() };
        let parts: Vec<Halves<R>> = parameters
            .iter()
            .map(|parameter| match parameter {
                Parameter::Turn(own) => class(*own),
                Parameter::Shift(q) => [both(slide(*q)), [zeros(), zeros()].concat()],
                Parameter::Point => [loops - 1, 2 * loops - 1].map(|place| {
                    let mut column = [zeros(), zeros()].concat();
                    column[place] = R::one().neg();
                    column
                }),
            })
            .collect();
        let of_class = |(k, own): (usize, &usize)| {
            let (q, _) = of(*own).next()?;
            Some(Sliding { bit: 1 << (plain + 2 * k), class: class(*own), slide: slide(q) })
        };
        let columns = Columns {
            plain: classes[..plain].iter().map(|own| class(*own)).collect(),
            sliding: sliding.iter().enumerate().filter_map(of_class).collect(),
            along: slides.iter().map(|q| both(slide(*q))).collect(),
        };
        let constant = both(class(rest));
        let mut vectors = BTreeMap::new();
        for set in 0..1_u32 << bits {
            // Among the halves of L equations, at most L rows are independent.
            let of_b = set.count_ones() as usize;
            if of_b > loops || bits - of_b > loops || known.is_some_and(|known| known.binary_search(&set).is_err()) {
                continue;
            }
            match columns.vectors(set) {
                Some(own) => vectors.insert(set, own),
                None if known.is_some() => return None,
                None => continue,
            };
        }
        let sets: Vec<u32> = vectors.keys().copied().collect();
        let place = |set: u32| sets.binary_search(&set).ok();
        let mut rows = Vec::with_capacity(sets.len());
        for own in vectors.values() {
            let mut row = Row { entries: Vec::new(), others: Vec::new() };
            for (set, vector) in own {
                let by = parts.iter().map(|part| part.each_ref().map(|half| dot(half, vector))).collect();
                let column = place(*set)?;
                row.entries.push(Entry { column, constant: dot(&constant, vector), by });
                for (other, factor) in columns.others(*set, vector) {
                    match place(other) {
                        Some(column) => row.others.push((column, factor)),
                        // A set of lower rank has the coefficient zero, but for what a slide leads to.
                        None if known.is_none() && !sliding.is_empty() => return None,
                        None => {}
                    }
                }
            }
            rows.push(row);
        }
        Some(Self { sets, rows, classes, plain, parameters: parameters.to_vec() })
    }

    /// The columns of the pairs of sets whose entries have the rotation of `classes[j]` as their quotient, that with the lower power of
    /// it first.
    #[must_use]
    pub fn pairs(&self, j: usize) -> Vec<[usize; 2]> {
        let (bit, steps): (usize, &[[u32; 2]]) =
            if j < self.plain { (j, &[[1, 0]]) } else { (2 * j - self.plain, &[[1, 0], [3, 1]]) };
        let mask = if j < self.plain { 1 } else { 3 };
        let mut list = Vec::new();
        for (column, set) in self.sets.iter().enumerate() {
            for [with, without] in steps.iter().filter(|[with, _]| set >> bit & mask == *with) {
                let other = set ^ ((with ^ without) << bit);
                list.extend(self.sets.binary_search(&other).ok().map(|other| [column, other]));
            }
        }
        list
    }

    /// The set whose equation is the mirror image of that of a set: without its classes and with all others; of a class with a slide 1 and
    /// `1/theta^2` change places.
    #[must_use]
    pub fn complement(&self, set: u32) -> u32 {
        let pairs = self.plain..self.classes.len();
        pairs.map(|j| 2 * j - self.plain).fold(set ^ ((1 << self.plain) - 1), |set, bit| match set >> bit & 3 {
            0 | 3 => set ^ (3 << bit),
            _ => set,
        })
    }

    /// The matrix at values of the parameters and of their mirror images.
    #[must_use]
    pub fn at(&self, values: &[[R; 2]]) -> Vec<Vec<R>> {
        let size = self.sets.len();
        let mut matrix = vec![vec![R::zero(); size]; size];
        for (line, row) in matrix.iter_mut().zip(&self.rows) {
            for Entry { column, constant, by } in &row.entries {
                let terms = by.iter().zip(values).map(|(by, value)| by[0].mul(&value[0]).add(&by[1].mul(&value[1])));
                line[*column] = terms.fold(constant.clone(), |sum, term| sum.add(&term));
            }
            for (column, factor) in &row.others {
                line[*column] = line[*column].add(factor);
            }
        }
        matrix
    }
}
