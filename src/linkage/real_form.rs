//! A pencil as a real matrix of polynomials, rational for rational data.
//!
//! With `x = (1 + i t)/(1 - i t)` for every rotation among the parameters and `z = x + i y` for a point, the rows of a set
//! and of its complement are conjugate. Written with the real and imaginary parts p and q of `v_S` up to a common factor,
//! `v_S = p + i q` and `v_(complement) = p - i q`, half of the rows are a real matrix.

use super::pencil::{self, Parameter, Pencil, Row};
use crate::algebra::modular::Terms;
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::Gaussian;
use rug::{Integer, Rational};
use std::collections::BTreeMap;

/// The real matrix of a pencil.
#[derive(Clone, Debug)]
pub struct RealForm {
    /// The entries, in the variables of the parameters: one for a rotation (its half-angle tangent) or a shift, two for
    /// the coordinates of a point. As many rows and columns as the pencil has.
    pub matrix: Vec<Vec<Terms>>,
    /// The degree of its determinant in every variable where no root of it is infinite.
    pub degrees: Vec<usize>,
}

/// A number in whose direction the real part of an equation is taken that is a real one times another number: one that no direction of
/// simple data is at right angles to.
const OFF_AXES: [i32; 2] = [1009, 501];

/// A polynomial with complex coefficients, by its exponents.
type Entry = BTreeMap<Vec<u32>, Gaussian>;

fn gaussian(re: i32, im: i32) -> Gaussian {
    Gaussian { re: Rational::from(re), im: Rational::from(im) }
}

/// `a p`, added to `sum`.
fn add_multiple(sum: &mut Entry, a: &Gaussian, p: &Entry) {
    for (exponents, c) in p {
        let own = sum.entry(exponents.clone()).or_insert_with(|| gaussian(0, 0));
        *own = own.add(&a.mul(c));
    }
}

fn product(a: &Entry, b: &Entry) -> Entry {
    let mut all = Entry::new();
    for (left, x) in a {
        let shifted = b.iter().map(|(right, y)| {
            let exponents = left.iter().zip(right).map(|(l, r)| l + r).collect();
            (exponents, y.clone())
        });
        add_multiple(&mut all, x, &shifted.collect());
    }
    all
}

/// The variables of the parameters.
struct Variables {
    /// The first variable of every parameter.
    first: Vec<usize>,
    total: usize,
}

impl Variables {
    fn of(parameters: &[Parameter]) -> Self {
        let mut total = 0;
        let first = parameters.iter().map(|parameter| {
            let own = total;
            total += if *parameter == Parameter::Point { 2 } else { 1 };
            own
        });
        Self { first: first.collect(), total }
    }

    fn constant(&self) -> Entry {
        Entry::from([(vec![0; self.total], gaussian(1, 0))])
    }

    /// A variable times a number.
    fn variable(&self, variable: usize, factor: Gaussian) -> Entry {
        let mut exponents = vec![0; self.total];
        exponents[variable] = 1;
        Entry::from([(exponents, factor)])
    }

    /// `1 - i t` (side 0), the denominator of a rotation, or `1 + i t` (side 1), that of its inverse.
    fn side(&self, parameter: usize, side: usize) -> Entry {
        let mut linear = self.variable(self.first[parameter], gaussian(0, if side == 0 { -1 } else { 1 }));
        add_multiple(&mut linear, &gaussian(1, 0), &self.constant());
        linear
    }

    /// The product of the denominators of a row, one of them replaced by its numerator.
    fn cleared(&self, used: &[[bool; 2]], replaced: Option<(usize, usize)>) -> Entry {
        let mut all = self.constant();
        for (parameter, sides) in used.iter().enumerate() {
            for side in (0..2).filter(|side| sides[*side]) {
                let side = if replaced == Some((parameter, side)) { 1 - side } else { side };
                all = product(&all, &self.side(parameter, side));
            }
        }
        all
    }

    /// A coefficient with parameters, times all denominators of its row.
    fn own(&self, parameters: &[Parameter], entry: &pencil::Entry<Gaussian>, used: &[[bool; 2]]) -> Entry {
        let factor = self.cleared(used, None);
        let mut own = Entry::new();
        add_multiple(&mut own, &entry.constant, &factor);
        for (k, (parameter, by)) in parameters.iter().zip(&entry.by).enumerate() {
            let first = self.first[k];
            match parameter {
                Parameter::Turn(_) => {
                    for side in (0..2).filter(|side| used[k][*side]) {
                        add_multiple(&mut own, &by[side], &self.cleared(used, Some((k, side))));
                    }
                }
                Parameter::Shift(_) => {
                    add_multiple(&mut own, &by[0], &product(&factor, &self.variable(first, gaussian(1, 0))));
                }
                Parameter::Point => {
                    for (side, sign) in [(0, 1), (1, -1)] {
                        let mut point = self.variable(first, gaussian(1, 0));
                        point.extend(self.variable(first + 1, gaussian(0, sign)));
                        add_multiple(&mut own, &by[side], &product(&factor, &point));
                    }
                }
            }
        }
        own
    }
}

impl RealForm {
    /// The real form of a pencil whose data are those of real bodies; `None` where sets have no complements.
    #[must_use]
    pub fn new(pencil: &Pencil<Gaussian>) -> Option<Self> {
        // One of every two complementary sets; a set that is its own complement has a real v.
        let kept: Vec<usize> =
            (0..pencil.sets.len()).filter(|k| pencil.sets[*k] <= pencil.complement(pencil.sets[*k])).collect();
        let is_own = |set: u32| pencil.complement(set) == set;
        let doubled: Vec<usize> = kept.iter().copied().filter(|k| !is_own(pencil.sets[*k])).collect();
        let size = kept.len() + doubled.len();
        if size == 0 || size != pencil.sets.len() {
            return None;
        }
        // The columns of the real and of the imaginary part, and the sign of that.
        let column = |k: usize| {
            let set = pencil.sets[k];
            let mirror = pencil.complement(set);
            let (own, sign) = if set <= mirror { (set, 1) } else { (mirror, -1) };
            let at = pencil.sets.binary_search(&own).ok()?;
            let imaginary = doubled.binary_search(&at).ok().map(|place| kept.len() + place);
            Some((kept.binary_search(&at).ok()?, imaginary, Rational::from(sign)))
        };
        let variables = Variables::of(&pencil.parameters);
        let mut matrix = Vec::with_capacity(size);
        let mut degrees = vec![0; variables.total];
        for k in &kept {
            let row = &pencil.rows[*k];
            let is_own = is_own(pencil.sets[*k]);
            let used = denominators(pencil, row);
            for (place, used) in variables.first.iter().zip(&used) {
                degrees[*place] += if is_own { 1 } else { 2 } * used.iter().filter(|used| **used).count();
            }
            let factor = variables.cleared(&used, None);
            let own = row.entries.iter();
            let mut entries: Vec<(usize, Entry)> =
                own.map(|entry| (entry.column, variables.own(&pencil.parameters, entry, &used))).collect();
            for (other, coefficient) in &row.others {
                let mut entry = Entry::new();
                add_multiple(&mut entry, coefficient, &factor);
                entries.push((*other, entry));
            }
            let mut pair = [vec![Real::new(); size], vec![Real::new(); size]];
            for (other, entry) in entries {
                let (place, imaginary, sign) = column(other)?;
                for (exponents, c) in entry {
                    let c = if is_own { c.mul(&gaussian(OFF_AXES[0], OFF_AXES[1])) } else { c };
                    // c (p + s i q) = (re p - s im q) + i (im p + s re q)
                    let mut add = |row: usize, place: usize, by: Rational| {
                        *pair[row][place].entry(exponents.clone()).or_default() += by;
                    };
                    if let Some(imaginary) = imaginary {
                        add(0, imaginary, Rational::from(-&c.im) * &sign);
                        add(1, imaginary, Rational::from(&c.re * &sign));
                    }
                    add(0, place, c.re);
                    add(1, place, c.im);
                }
            }
            // An equation that is its own mirror image is a real one times a complex number, and its parts say the same.
            matrix.extend(pair.iter().take(if is_own { 1 } else { 2 }).map(|row| integers(row)));
        }
        Some(Self { matrix, degrees })
    }
}

/// Returns the denominators that the rotations of a row have: their own and those of their inverses.
fn denominators(pencil: &Pencil<Gaussian>, row: &Row<Gaussian>) -> Vec<[bool; 2]> {
    let is_turn = |parameter: &Parameter| matches!(parameter, Parameter::Turn(_));
    let has = |k: usize, half: usize| row.entries.iter().any(|entry| !entry.by[k][half].is_zero());
    let parameters = pencil.parameters.iter().enumerate();
    parameters.map(|(k, parameter)| [0, 1].map(|half| is_turn(parameter) && has(k, half))).collect()
}

/// A polynomial with rational coefficients, by its exponents.
type Real = BTreeMap<Vec<u32>, Rational>;

/// A row times the least common denominator of its numbers.
fn integers(row: &[Real]) -> Vec<Terms> {
    let numbers = row.iter().flat_map(BTreeMap::values);
    let common = numbers.fold(Integer::from(1), |common, q| common.lcm(q.denom()));
    let terms = |entry: &Real| {
        let mut terms = Terms::default();
        for (exponents, q) in entry.iter().filter(|(_, q)| **q != 0) {
            terms.exponents.extend(exponents);
            terms.coefficients.push(Rational::from(q * &common).numer().clone());
        }
        terms
    };
    row.iter().map(terms).collect()
}
