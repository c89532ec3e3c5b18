//! A loop along power series: the calculation of theorem 6 of docs/certificate.md.

use super::chain::six;
use super::fault::{Fault, refused};
use crate::algebra::number_field::Algebraic;
use crate::algebra::ring::{Field, Ring};
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::{Motion, dot};
use rug::Rational;

/// The joints and links of a loop along a power series, one coefficient after the other. Each coefficient is a sum over pairs of earlier ones:
/// all up to the order N cost a square of N, where the products of whole series for every order would cost its cube.
struct Along<'a> {
    variables: &'a [Variable],
    links: &'a [Motion<Algebraic>],
    /// The coefficients of every unknown, from that of order 0.
    unknowns: Vec<Vec<Algebraic>>,
    /// The coefficients of cosine and sine of every rotation.
    turns: Vec<[Vec<Algebraic>; 2]>,
    /// The coefficients of the motion of every joint with the link behind it, and of the product of all motions up to this one.
    motions: Vec<[Vec<Motion<Algebraic>>; 2]>,
}

fn nothing() -> Motion<Algebraic> {
    let row = || std::array::from_fn(|_| Algebraic::zero());
    Motion { rotation: std::array::from_fn(|_| row()), translation: row() }
}

/// Puts a coefficient in its place, or behind those that are known.
fn put<T>(list: &mut Vec<T>, order: usize, value: T) {
    list.truncate(order);
    list.push(value);
}

impl<'a> Along<'a> {
    fn new(variables: &'a [Variable], links: &'a [Motion<Algebraic>]) -> Self {
        let size = variables.len();
        let mut along = Self {
            variables,
            links,
            unknowns: vec![Vec::new(); size],
            turns: vec![[Vec::new(), Vec::new()]; size],
            motions: vec![[Vec::new(), Vec::new()]; size],
        };
        along.order(0, vec![Algebraic::zero(); size]);
        along
    }

    /// Takes the coefficients of the unknowns of the next order, or others of the last one. Returns those of the six closure equations.
    fn order(&mut self, order: usize, coefficients: Vec<Algebraic>) -> Option<[Algebraic; 6]> {
        for (k, coefficient) in coefficients.into_iter().enumerate() {
            put(&mut self.unknowns[k], order, coefficient);
            let motion = match self.variables[k] {
                Variable::Rotation => {
                    let [cos, sin] = self.turn(k, order)?;
                    put(&mut self.turns[k][0], order, cos.clone());
                    put(&mut self.turns[k][1], order, sin.clone());
                    self.turned(k, order, &cos, &sin)
                }
                Variable::Translation => self.displaced(k, order),
            };
            put(&mut self.motions[k][0], order, motion);
            let product = self.product(k, order);
            put(&mut self.motions[k][1], order, product);
        }
        let [_, products] = self.motions.last()?;
        let Motion { rotation, translation } = products.get(order)?;
        Some(six(rotation, translation))
    }

    /// Returns the coefficients of cosine and sine of an unknown that begins with 0. The derivative of each is the other one times the derivative
    /// of the unknown.
    fn turn(&self, k: usize, order: usize) -> Option<[Algebraic; 2]> {
        if order == 0 {
            return Some([Algebraic::one(), Algebraic::zero()]);
        }
        let [cos, sin] = &self.turns[k];
        let mut sums = [Algebraic::zero(), Algebraic::zero()];
        for j in 1..=order {
            let slope = Algebraic::from_rational(&Rational::from((j, order)))?.mul(&self.unknowns[k][j]);
            sums = [sums[0].sub(&slope.mul(&sin[order - j])), sums[1].add(&slope.mul(&cos[order - j]))];
        }
        Some(sums)
    }

    /// Returns the coefficient of a rotation about the z axis with the link behind it.
    fn turned(&self, k: usize, order: usize, cos: &Algebraic, sin: &Algebraic) -> Motion<Algebraic> {
        let Motion { rotation, translation } = &self.links[k];
        let row = |i: usize, x: &Algebraic, y: &Algebraic| match i {
            0 => cos.mul(x).sub(&sin.mul(y)),
            _ => sin.mul(x).add(&cos.mul(y)),
        };
        let kept = |x: &Algebraic| if order == 0 { x.clone() } else { Algebraic::zero() };
        let column = |i: usize, [x, y, z]: [&Algebraic; 3]| if i < 2 { row(i, x, y) } else { kept(z) };
        Motion {
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| column(i, [0, 1, 2].map(|l| &rotation[l][j])))),
            translation: std::array::from_fn(|i| column(i, translation.each_ref())),
        }
    }

    /// Returns the coefficient of a translation along the z axis with the link behind it.
    fn displaced(&self, k: usize, order: usize) -> Motion<Algebraic> {
        let mut motion = if order == 0 { self.links[k].clone() } else { nothing() };
        motion.translation[2] = motion.translation[2].add(&self.unknowns[k][order]);
        motion
    }

    /// Returns the coefficient of the product of the first k + 1 motions.
    fn product(&self, k: usize, order: usize) -> Motion<Algebraic> {
        let own = &self.motions[k][0];
        let Some(before) = k.checked_sub(1).map(|before| &self.motions[before][1]) else { return own[order].clone() };
        let mut sum = nothing();
        sum.translation = before[order].translation.clone();
        for i in 0..=order {
            let (left, right) = (&before[i].rotation, &own[order - i]);
            for row in 0..3 {
                for column in 0..3 {
                    let entries = [0, 1, 2].map(|l| right.rotation[l][column].clone());
                    sum.rotation[row][column] = sum.rotation[row][column].add(&dot(&left[row], &entries));
                }
                sum.translation[row] = sum.translation[row].add(&dot(&left[row], &right.translation));
            }
        }
        sum
    }
}

/// Checks that the loop stays closed to this order along its only first-order motion.
pub(super) fn follows(orders: usize, variables: &[Variable], links: &[Motion<Algebraic>]) -> Result<(), Fault> {
    let size = variables.len();
    let broken = || Fault::Unreadable("proof: curve: found numbers that are not known well enough".to_owned());
    let only = |free: usize| (0..size).map(|k| Algebraic::from_integer(i32::from(k == free))).collect::<Vec<_>>();
    let mut along = Along::new(variables, links);
    let screws: Vec<[Algebraic; 6]> =
        (0..size).map(|k| along.order(1, only(k))).collect::<Option<_>>().ok_or_else(broken)?;
    // The derivative of the equations, and beside it the combination that every row is.
    let rows = (0..6).map(|i| {
        let unit = (0..6).map(|k| Algebraic::from_integer(i32::from(k == i)));
        screws.iter().map(|screw| screw[i].clone()).chain(unit).collect()
    });
    let (pivots, rows) = reduced(rows.collect(), size)?;
    let rank = pivots.iter().flatten().count();
    if rank + 1 != size {
        return refused(format!("proof: curve: the joint screws have the rank {rank}, expected {}", size - 1));
    }
    let free = (0..size).find(|k| !pivots.contains(&Some(*k))).unwrap_or(0);
    for order in 1..=orders {
        let mut next = if order == 1 { only(free) } else { vec![Algebraic::zero(); size] };
        let values = along.order(order, next.clone()).ok_or_else(broken)?;
        for (row, pivot) in rows.iter().zip(&pivots) {
            let terms = row[size..].iter().zip(&values).map(|(x, f)| x.mul(f));
            let value = terms.fold(Algebraic::zero(), |sum, term| sum.add(&term));
            match pivot {
                Some(k) => next[*k] = value.neg(),
                None if value.is_zero() => {}
                None => return refused("proof: curve: the loop opens along the motion"),
            }
        }
        along.order(order, next).ok_or_else(broken)?;
    }
    Ok(())
}

/// The pivot of every row, and the rows after Gauss's algorithm.
type Reduced = (Vec<Option<usize>>, Vec<Vec<Algebraic>>);

/// Reduces rows by pivots in the first columns, which are 0 at none of the conjugate points.
fn reduced(mut rows: Vec<Vec<Algebraic>>, columns: usize) -> Result<Reduced, Fault> {
    let mut pivots = vec![None; rows.len()];
    for column in 0..columns {
        let Some(at) = (0..rows.len()).find(|i| pivots[*i].is_none() && !rows[*i][column].is_zero()) else { continue };
        let Some(inverse) = rows[at][column].inverse() else {
            return refused("proof: a number is 0 at some of the conjugate points, and not at others");
        };
        pivots[at] = Some(column);
        let pivot: Vec<Algebraic> = rows[at].iter().map(|x| x.mul(&inverse)).collect();
        for row in &mut rows {
            let factor = row[column].clone();
            for (x, p) in row.iter_mut().zip(&pivot) {
                *x = x.sub(&factor.mul(p));
            }
        }
        rows[at] = pivot;
    }
    Ok((pivots, rows))
}
