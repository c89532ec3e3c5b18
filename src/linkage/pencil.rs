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

/// One row: the equation of a set.
#[derive(Clone, Debug)]
pub struct Row<R> {
    /// The coefficient of the set itself, without parameters.
    pub constant: R,
    /// For every parameter the coefficients of it and of its mirror image there; a shift has the first alone.
    pub by: Vec<[R; 2]>,
    /// Columns of other sets with their coefficients.
    pub others: Vec<(usize, R)>,
}

/// The matrix.
#[derive(Clone, Debug)]
pub struct Pencil<R> {
    /// The sets, as bits of the classes in `classes`.
    pub sets: Vec<u32>,
    /// One row for every set.
    pub rows: Vec<Row<R>>,
    /// The classes that are neither at rest nor parameters.
    pub classes: Vec<usize>,
    /// The parameters.
    pub parameters: Vec<Parameter>,
}

/// A vector that is orthogonal to the rows of a matrix with one column more than rows; `None` where these are dependent.
fn orthogonal<R: Field>(mut rows: Vec<Vec<R>>) -> Option<Vec<R>> {
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
    let free = (0..=size).find(|column| !pivots.contains(column))?;
    let mut vector = vec![R::zero(); size + 1];
    vector[free] = R::one();
    for (row, column) in rows.iter().zip(&pivots) {
        vector[*column] = row[free].neg();
    }
    Some(vector)
}

fn dot<R: Ring>(row: &[R], vector: &[R]) -> R {
    row.iter()
        .zip(vector)
        .filter(|(x, y)| !x.is_zero() && !y.is_zero())
        .fold(R::zero(), |sum, (x, y)| sum.add(&x.mul(y)))
}

impl<R: Field> Pencil<R> {
    /// The matrix with the class `rest` at rest, which has all slides, and these parameters; `None` for other slides and for
    /// systems that are not square.
    #[must_use]
    pub fn new(equations: &Equations<Isotropic<R>>, rest: usize, parameters: &[Parameter]) -> Option<Self> {
        let loops = equations.loops();
        let has = |parameter: Parameter| parameters.contains(&parameter);
        let classes: Vec<usize> =
            (0..equations.classes).filter(|class| *class != rest && !has(Parameter::Turn(*class))).collect();
        let slides: Vec<usize> = (0..equations.slides.len()).filter(|q| !has(Parameter::Shift(*q))).collect();
        // Sets are bits of a word.
        let is_square = classes.len() + slides.len() + 1 == 2 * loops && classes.len() < 32;
        if !is_square || equations.slides.iter().any(|slide| slide.class != rest) {
            return None;
        }
        let zeros = || vec![R::zero(); loops];
        let first = |class: usize| -> Vec<R> { equations.cycles.iter().map(|cycle| cycle[class].z.clone()).collect() };
        let second = |class: usize| -> Vec<R> { equations.cycles.iter().map(|cycle| cycle[class].w.clone()).collect() };
        let a: Vec<Vec<R>> = classes.iter().map(|class| [first(*class), zeros()].concat()).collect();
        let b: Vec<Vec<R>> = classes.iter().map(|class| [zeros(), second(*class)].concat()).collect();
        let along = |slide: usize| {
            let halves = |half: fn(&Isotropic<R>) -> &R| {
                equations.slides[slide].coefficients.iter().map(half).cloned().collect::<Vec<R>>()
            };
            [halves(|n| &n.z), halves(|n| &n.w)].concat()
        };
        let columns: Vec<[Vec<R>; 2]> = parameters
            .iter()
            .map(|parameter| match parameter {
                Parameter::Turn(class) => [[first(*class), zeros()].concat(), [zeros(), second(*class)].concat()],
                Parameter::Shift(slide) => [along(*slide), [zeros(), zeros()].concat()],
                Parameter::Point => [loops - 1, 2 * loops - 1].map(|place| {
                    let mut column = [zeros(), zeros()].concat();
                    column[place] = R::one().neg();
                    column
                }),
            })
            .collect();
        let along: Vec<Vec<R>> = slides.iter().map(|slide| along(*slide)).collect();
        let constant = [first(rest), second(rest)].concat();
        let mut vectors: BTreeMap<u32, Vec<R>> = BTreeMap::new();
        for set in 0..1_u32 << classes.len() {
            // Among the halves of L equations, at most L rows are independent.
            let of_b = set.count_ones() as usize;
            if of_b > loops || classes.len() - of_b > loops {
                continue;
            }
            let rows = (0..classes.len()).map(|j| if set >> j & 1 == 1 { b[j].clone() } else { a[j].clone() });
            if let Some(vector) = orthogonal(rows.chain(along.iter().cloned()).collect()) {
                vectors.insert(set, vector);
            }
        }
        let sets: Vec<u32> = vectors.keys().copied().collect();
        let place = |set: u32| sets.binary_search(&set).ok();
        let mut rows = Vec::with_capacity(sets.len());
        for set in &sets {
            let vector = vectors.get(set)?;
            let by = columns.iter().map(|[own, mirror]| [dot(own, vector), dot(mirror, vector)]).collect();
            let mut others = Vec::new();
            for j in 0..classes.len() {
                let factor = dot(if set >> j & 1 == 1 { &a[j] } else { &b[j] }, vector);
                // A set of lower rank has the coefficient zero; over rounded numbers it is nearly zero.
                if let (Some(column), false) = (place(set ^ (1 << j)), factor.is_zero()) {
                    others.push((column, factor));
                }
            }
            rows.push(Row { constant: dot(&constant, vector), by, others });
        }
        Some(Self { sets, rows, classes, parameters: parameters.to_vec() })
    }

    /// The matrix at values of the parameters and of their mirror images.
    #[must_use]
    pub fn at(&self, values: &[[R; 2]]) -> Vec<Vec<R>> {
        let size = self.sets.len();
        let mut matrix = vec![vec![R::zero(); size]; size];
        for (k, row) in self.rows.iter().enumerate() {
            let terms = row.by.iter().zip(values).map(|(by, value)| by[0].mul(&value[0]).add(&by[1].mul(&value[1])));
            matrix[k][k] = terms.fold(row.constant.clone(), |sum, term| sum.add(&term));
            for (column, factor) in &row.others {
                matrix[k][*column] = factor.clone();
            }
        }
        matrix
    }
}
