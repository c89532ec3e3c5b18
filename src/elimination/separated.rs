//! Two equations whose sides have one variable each.
//!
//! `a_e . m = b_e . m',  e = 1, 2,  m = (1, cos q, sin q)  or  (1, d, d^2)`: they give m' linearly in m, and the conic that m'
//! lies on (a circle or a parabola) is of degree 4 in the half tangent or the distance of the other variable. The roles may be
//! exchanged; and where neither side can be solved for, a combination of the equations has one variable only.

use crate::algebra::ring::{Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::kinematics::closed_loop::Variable;

/// The equations.
#[derive(Clone, Debug, PartialEq)]
pub struct Separated<R> {
    /// The kind of the variable of each side.
    pub kinds: [Variable; 2],
    /// Two rows, each over the monomials of one side and of the other.
    pub rows: [[[R; 3]; 2]; 2],
}

/// A way to solve the two equations.
#[derive(Clone, Debug, PartialEq)]
pub enum Plan<R> {
    /// Through the closure polynomial in one variable; `other` times its monomials are those of the other one.
    Together {
        /// The side whose variable the polynomial is in.
        hidden: usize,
        /// Matrix that takes the monomials of the hidden variable to those of the other one.
        other: [[R; 3]; 3],
    },
    /// One after the other: an equation in one variable alone, then one that is linear in the monomials of both.
    Apart {
        /// The side found first.
        first: usize,
        /// `equation . m = 0` for it.
        equation: [R; 3],
        /// The equation for the other one, its own row second.
        then: [[R; 3]; 2],
    },
}

impl<R: Ring> Separated<R> {
    /// The determinant by which the monomials of a side are solved for.
    fn determinant(&self, side: usize) -> R {
        let [one, two] = [&self.rows[0][side], &self.rows[1][side]];
        one[1].mul(&two[2]).sub(&one[2].mul(&two[1]))
    }

    /// Returns the monomials of a side as combinations of those of the other one, all times the determinant: without division.
    #[must_use]
    pub fn solved(&self, side: usize) -> [[R; 3]; 3] {
        let hidden = 1 - side;
        // rows[e][side] . m = rows[e][hidden] . m'
        let [one, two] = [&self.rows[0], &self.rows[1]];
        let value = |row: &[[R; 3]; 2], k: usize| {
            if k == 0 { row[hidden][0].sub(&row[side][0]) } else { row[hidden][k].clone() }
        };
        let first = |k: usize| value(one, k).mul(&two[side][2]).sub(&value(two, k).mul(&one[side][2]));
        let second = |k: usize| value(two, k).mul(&one[side][1]).sub(&value(one, k).mul(&two[side][1]));
        [[self.determinant(side), R::zero(), R::zero()], std::array::from_fn(first), std::array::from_fn(second)]
    }
}

impl<F: Field> Separated<F> {
    /// Returns the plan to solve the two equations; determinants no larger than `tolerance` (0 in exact fields) are zero.
    #[must_use]
    pub fn plan(&self, tolerance: f64) -> Plan<F> {
        let determinants = [self.determinant(0), self.determinant(1)];
        let solved = usize::from(determinants[1].pivot_size() >= determinants[0].pivot_size());
        let invertible = determinants[solved].pivot_size() > tolerance;
        if let Some(inverse) = determinants[solved].inverse().filter(|_| invertible) {
            let hidden = 1 - solved;
            let [_, first, second] = self.solved(solved).map(|row| row.map(|x| x.mul(&inverse)));
            let other = [[F::one(), F::zero(), F::zero()], first, second];
            return Plan::Together { hidden, other };
        }
        // The rows of both sides are dependent: the smaller one eliminates the second side from the other.
        let size = |row: &[F; 3]| row[1].pivot_size().max(row[2].pivot_size());
        let gone = 1;
        let [one, two] = [&self.rows[0], &self.rows[1]];
        let (keep, drop) = if size(&one[gone]) >= size(&two[gone]) { (one, two) } else { (two, one) };
        // factor = drop . keep / keep . keep over the monomials
        let pivot = if keep[gone][1].pivot_size() >= keep[gone][2].pivot_size() { 1 } else { 2 };
        let factor = keep[gone][pivot].inverse().map_or_else(F::zero, |inverse| drop[gone][pivot].mul(&inverse));
        let side = |s: usize| -> [F; 3] { std::array::from_fn(|k| drop[s][k].sub(&factor.mul(&keep[s][k]))) };
        let (mut equation, rest) = (side(1 - gone), side(gone));
        equation[0] = equation[0].sub(&rest[0]);
        Plan::Apart { first: 1 - gone, equation, then: [keep[1 - gone].clone(), keep[gone].clone()] }
    }
}

impl<R: Ring> Separated<R> {
    /// `q . q - 1` of the pair (cos, sin) or `d d - d^2`, as a form in the monomials of the hidden variable.
    #[must_use]
    pub fn conic(&self, hidden: usize, other: &[[R; 3]; 3]) -> [[R; 3]; 3] {
        let product = |x: &[R; 3], y: &[R; 3], i: usize, j: usize| x[i].mul(&y[j]);
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let [one, first, second] = other;
                match self.kinds[1 - hidden] {
                    Variable::Rotation => {
                        let sum = product(first, first, i, j).add(&product(second, second, i, j));
                        sum.sub(&product(one, one, i, j))
                    }
                    Variable::Translation => product(first, first, i, j).sub(&product(one, second, i, j)),
                }
            })
        })
    }
}

/// The monomials of a variable over the powers of its half tangent, or of its distance. Angles are counted from
/// `offset`, of length 1 or not: a factor in common changes nothing.
#[must_use]
pub fn powers<R: Ring>(variable: Variable, offset: &[R; 3]) -> [[R; 3]; 3] {
    let nought = R::zero;
    match variable {
        Variable::Rotation => {
            let [length, cos, sin] = offset;
            let twice = |x: &R| x.add(x);
            [
                [length.clone(), nought(), length.clone()],
                [cos.clone(), twice(sin).neg(), cos.neg()],
                [sin.clone(), twice(cos), sin.neg()],
            ]
        }
        Variable::Translation => {
            [[R::one(), nought(), nought()], [nought(), R::one(), nought()], [nought(), nought(), R::one()]]
        }
    }
}

/// The closure polynomial of a conic form, constant term first.
#[must_use]
pub fn quartic<R: Ring>(conic: &[[R; 3]; 3], powers: &[[R; 3]; 3]) -> [R; 5] {
    let mut coefficients: [R; 5] = std::array::from_fn(|_| R::zero());
    for i in 0..3 {
        for j in 0..3 {
            for k in 0..3 {
                for l in 0..3 {
                    let term = conic[i][j].mul(&powers[i][k]).mul(&powers[j][l]);
                    coefficients[k + l] = coefficients[k + l].add(&term);
                }
            }
        }
    }
    coefficients
}

/// The offset of angles in exact work, 2 atan(3/7) as (1, cos, sin) times 58: no root is likely at infinity.
#[must_use]
pub fn offset<R: Ring>() -> [R; 3] {
    [58, 40, 42].map(R::from_integer)
}

/// The closure polynomial in the half tangent of the hidden angle, less 2 atan(3/7), or in the hidden distance, where
/// the monomials of the other variable are `other` times those of the hidden one.
#[must_use]
pub fn closure_polynomial<F: Field>(equations: &Separated<F>, hidden: usize, other: &[[F; 3]; 3]) -> Univariate<F> {
    let powers = powers(equations.kinds[hidden], &offset());
    Univariate::new(quartic(&equations.conic(hidden, other), &powers).to_vec())
}
