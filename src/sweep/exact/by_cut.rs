//! Overconstrained loops of up to six joints, by a cut.
//!
//! The cut of docs/mobility.md, theorem 3, has a matrix that is linear in the half tangent of the output, and so it is in
//! that of the input. The loop closes where a vector of its kernel is made of two tensor products. Cofactors are such a
//! vector wherever they do not all vanish, and the closure polynomial is what all conditions on them have in common.

use super::plane_curve::{Integral, S, T};
use super::relation::{Content, Relation};
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};
use crate::exact::cut::Cut;
use crate::exact::{Axis, JointValue, Linkage};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{Layout, Variable};
use rug::{Integer, Rational};

type Plane = Polynomial<Int>;

/// The number of outputs with a relation: a second one is asked where the first one leaves something open.
const OUTPUTS: usize = 2;
/// Mixtures of the rows that are tried: the first rows as they are, and others where those are dependent.
const MIXTURES: i32 = 3;

/// The relations of a loop of rotations, and no more translations than input and output, between its locked variable,
/// counted from `offset`, and other ones.
pub(super) fn relations(chain: &Chain, layout: &Layout, offset: &Rational) -> Vec<Relation> {
    of_outputs(chain, layout, offset, OUTPUTS)
}

/// Returns the relations of every output that has one.
pub(super) fn of_every_output(chain: &Chain, layout: &Layout, offset: &Rational) -> Vec<Relation> {
    of_outputs(chain, layout, offset, usize::MAX)
}

fn of_outputs(chain: &Chain, layout: &Layout, offset: &Rational, most: usize) -> Vec<Relation> {
    let (Some(locked), Ok(linkage)) = (layout.locked, Linkage::of(chain)) else { return Vec::new() };
    let unknowns = linkage.variables.len().saturating_sub(1);
    let is_plain = layout.spherical.is_none() && linkage.axes.iter().all(|axis| *axis == Axis::Z);
    if !is_plain || !(3..=5).contains(&unknowns) {
        return Vec::new();
    }
    let held = Held::of(&linkage, locked, offset);
    let is_alone = |output: &usize| {
        let others = (0..unknowns).filter(|k| k != output);
        others.into_iter().all(|k| held.linkages[0].variables[k] == Variable::Rotation)
    };
    let relation = |output: usize| {
        Cut::<Rational>::hiding(unknowns, output).find_map(|cut| held.matrix(cut).relation(held.index(output)))
    };
    (0..unknowns).filter(is_alone).filter_map(relation).take(most).collect()
}

/// A loop with its input held: linear in the tangent of half of it.
struct Held {
    locked: usize,
    input: Variable,
    /// Without the input, and the factor of it.
    linkages: [Linkage<Rational>; 2],
}

/// `x + s y` and `c : s` as it stands for an angle counted from an offset, or a distance.
fn pairs(variable: Variable, offset: &Rational) -> [JointValue<Rational>; 2] {
    match variable {
        Variable::Rotation => [[Rational::from(1), offset.clone()], [-offset.clone(), Rational::from(1)]],
        Variable::Translation => [[Rational::from(2), Rational::new()], [Rational::new(), Rational::from(1)]],
    }
}

impl Held {
    fn of(linkage: &Linkage<Rational>, locked: usize, offset: &Rational) -> Self {
        let input = linkage.variables[locked];
        let linkages = pairs(input, offset).map(|pair| linkage.locked(&[(locked, pair)]));
        Self { locked, input, linkages }
    }

    /// Returns the index, among all joint variables, of an unknown.
    fn index(&self, unknown: usize) -> usize {
        unknown + usize::from(unknown >= self.locked)
    }

    /// The matrix of a cut.
    fn matrix(&self, cut: (usize, usize)) -> Matrix {
        let cuts = self.linkages.each_ref().map(|linkage| Cut::of(linkage, cut));
        let [one, other] = &cuts;
        let left = one.degree();
        let hidden = one.order[one.hidden];
        let kind = self.linkages[0].variables[hidden];
        let [constant, factor] = pairs(kind, &Rational::new());
        let scale = [constant[0].clone(), factor[1].clone()];
        // The input is part of the link behind the variable before it.
        let unknowns = one.order.len();
        let before = (self.locked + unknowns) % (unknowns + 1);
        let before = before - usize::from(before > self.locked);
        let place = one.order.iter().position(|k| *k == before).unwrap_or(0);
        let is_input_left = place < one.first_side;
        let entries = |i: usize, j: usize| -> [Rational; 4] {
            // The columns of one side are free of the output, those of one side of the input.
            let is_left = j < left;
            let of = |cut: &Cut<Rational>, power: usize| {
                let entry = &cut.matrix[power][i][j];
                if is_left { Rational::from(entry * &scale[power]) } else { entry.clone() }
            };
            let factor = |power: usize| if is_left == is_input_left { of(other, power) } else { Rational::new() };
            [of(one, 0), factor(0), of(one, 1), factor(1)]
        };
        let rows = (0..8).map(|i| row(&(0..one.columns()).map(|j| entries(i, j)).collect::<Vec<_>>())).collect();
        Matrix { rows, left, is_input_left, kind, input: self.input }
    }
}

/// A row of `w + x s + y t + z s t` over the integers.
fn row(entries: &[[Rational; 4]]) -> Vec<Plane> {
    let mut common = Integer::from(1);
    entries.iter().flatten().for_each(|c| common.lcm_mut(c.denom()));
    let whole = |c: &Rational| Int::from((Rational::from(c * &common)).numer().clone());
    let entry = |[w, x, y, z]: &[Rational; 4]| {
        let terms = [(vec![], w), (vec![1], x), (vec![0, 1], y), (vec![1, 1], z)];
        Polynomial::from_terms(terms.into_iter().filter(|(_, c)| **c != 0).map(|(power, c)| (power, whole(c))))
    };
    entries.iter().map(entry).collect()
}

/// The matrix of a cut, linear in input and output.
struct Matrix {
    rows: Vec<Vec<Plane>>,
    /// The columns that have the output; the other ones are free of it.
    left: usize,
    /// Whether the input occurs in these columns, or in the other ones.
    is_input_left: bool,
    kind: Variable,
    input: Variable,
}

/// A polynomial that vanishes where the loop closes, and its degrees in input and output as a form.
struct Condition {
    polynomial: Plane,
    degrees: [usize; 2],
}

impl Matrix {
    /// The closure polynomial with this output; `None` where cofactors vanish along a part of it.
    fn relation(&self, output: usize) -> Option<Relation> {
        let equation = (0..MIXTURES).find_map(|mixture| self.closure(mixture))?;
        Some(Relation { content: Content::Nothing, ..Relation::of(output, self.kind, vec![equation]) })
    }

    /// One row less than there are columns, each a mixture of all rows, or the first ones as they are.
    fn mixed(&self, mixture: i32) -> Vec<Vec<Plane>> {
        let columns = self.rows[0].len();
        let weight = |i: i32, k: i32| {
            if mixture == 0 { i32::from(i == k) } else { (mixture * (i + 2) * (i + 3 * k + 1)).rem_euclid(11) - 5 }
        };
        let entry = |i: i32, j: usize| {
            let terms = self.rows.iter().zip(0..).map(|(row, k)| row[j].mul(&Ring::from_integer(weight(i, k))));
            terms.fold(Plane::zero(), |sum, term| sum.add(&term))
        };
        (0..7).take(columns - 1).map(|i| (0..columns).map(|j| entry(i, j)).collect()).collect()
    }

    /// The common divisor of all conditions on the cofactors of a mixture of the rows.
    fn closure(&self, mixture: i32) -> Option<Integral> {
        let mixed = self.mixed(mixture);
        let vector: Vec<Plane> = (0..self.rows[0].len()).map(|j| cofactor(&mixed, j)).collect();
        let conditions = self.conditions(&vector);
        let nonzero: Vec<&Condition> = conditions.iter().filter(|c| !c.polynomial.is_zero()).collect();
        let whole = nonzero.iter().fold(Plane::zero(), |gcd, c| gcd.gcd(&c.polynomial));
        if whole.is_zero() || !is_on_branches(&whole, &vector)? {
            return None;
        }
        let is_full = |c: &&&Condition| c.polynomial.degree(S) as usize == c.degrees[0];
        let is_finite = self.input == Variable::Translation || nonzero.iter().any(|c| is_full(&c));
        let short = nonzero.iter().map(|c| c.degrees[1].saturating_sub(c.polynomial.degree(T) as usize)).min()?;
        Some(Integral::of_form(whole, is_finite, short))
    }

    /// Returns the conditions that vanish where a vector is in the kernel and consists of two tensor products.
    fn conditions(&self, vector: &[Plane]) -> Vec<Condition> {
        let right = vector.len() - self.left;
        // A coordinate of the vector has one column less of the side that it belongs to.
        let count = |is_left: bool| if is_left { self.left } else { right };
        let sides = [self.is_input_left, true];
        let residual = |row: &Vec<Plane>| {
            let terms = row.iter().zip(vector);
            let polynomial = terms.fold(Plane::zero(), |sum, (x, y)| sum.add(&x.mul(y)));
            Condition { polynomial, degrees: sides.map(count) }
        };
        let tensor = |is_left: bool| {
            let part = if is_left { &vector[..self.left] } else { &vector[self.left..] };
            let [a, b, c, d] = part else { return None };
            let degrees = sides.map(|side| 2 * (count(side) - usize::from(side == is_left)));
            Some(Condition { polynomial: a.mul(d).sub(&b.mul(c)), degrees })
        };
        self.rows.iter().map(residual).chain([tensor(true), tensor(false)].into_iter().flatten()).collect()
    }
}

/// Whether a vector vanishes along no curve of zeros of a polynomial on which the input is not constant.
fn is_on_branches(whole: &Plane, vector: &[Plane]) -> Option<bool> {
    let rest = Integral::of_form(whole.checked_div_exact(&whole.content_in(T))?, true, 0).polynomial;
    let foreign = vector.iter().fold(rest, |gcd, v| gcd.gcd(v));
    Some(foreign.degree(S) + foreign.degree(T) == 0)
}

/// The determinant of rows without a column, with its sign.
fn cofactor(rows: &[Vec<Plane>], column: usize) -> Plane {
    let without = |row: &Vec<Plane>| -> Vec<Plane> {
        row.iter().enumerate().filter(|(j, _)| *j != column).map(|(_, x)| x.clone()).collect()
    };
    let minor = Polynomial::determinant(&rows.iter().map(without).collect::<Vec<_>>());
    if column.is_multiple_of(2) { minor } else { minor.neg() }
}
