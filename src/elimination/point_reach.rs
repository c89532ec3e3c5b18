//! A ball and three more joint variables: the point at its centre, reached from both sides, degree 4 at most.
//!
//! `V1 G1 V2 G2 V3 p = p0` for the centre seen from its two links. Where V2 turns, both sides have the same height and
//! distance from a point of its axis; where it slides, they lie over the same point: two equations, the same for every
//! sort of V1 and V3,
//!
//! `a_e . m3 = b_e . m1,  e = 1, 2,  m = (1, cos q, sin q)  or  (1, d, d^2)`.
//!
//! They give m1 linearly in m3, and the conic that m1 lies on (a circle or a parabola) is of degree 4 in the half
//! tangent or the distance of V3. Or the other way round; and where neither can be solved for, each equation has one
//! unknown.

use crate::algebra::ring::{Domain, Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::{Motion, Vector, dot};

/// A point that moves with one variable: coefficients over m.
type Moving<R> = [Vector<R>; 3];

/// The centre of a ball, reached from both sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Reach<R> {
    /// What the three variables behind the ball do.
    pub variables: [Variable; 3],
    /// The centre before V2 acts, over the monomials of V3, and behind it, over those of V1.
    sides: [Moving<R>; 2],
    /// The two equations: rows over the monomials of V3 and of V1.
    rows: [[[R; 3]; 2]; 2],
}

/// How the two equations are solved.
#[derive(Clone, Debug, PartialEq)]
pub enum Plan<R> {
    /// Through the closure polynomial in one variable; `other` times its monomials are those of the other one.
    Together {
        /// The variable of the polynomial: 0 is V3, 1 is V1.
        hidden: usize,
        /// The monomials of the other variable.
        other: [[R; 3]; 3],
    },
    /// One after the other: an equation in one variable alone, then one that is linear in the monomials of both.
    Apart {
        /// The variable found first: 0 is V3, 1 is V1.
        first: usize,
        /// `equation . m = 0` for it.
        equation: [R; 3],
        /// The equation for the other one, its own row second.
        then: [[R; 3]; 2],
    },
}

fn plus<R: Ring>(x: &Vector<R>, y: &Vector<R>) -> Vector<R> {
    std::array::from_fn(|i| x[i].add(&y[i]))
}

/// `V p` or, reversed, `V^-1 p` over the monomials of V.
fn moved<R: Ring>(variable: Variable, [x, y, z]: &Vector<R>, reversed: bool) -> Moving<R> {
    let nought = R::zero;
    let signed = |v: R| if reversed { v.neg() } else { v };
    match variable {
        Variable::Rotation => [
            [nought(), nought(), z.clone()],
            [x.clone(), y.clone(), nought()],
            [signed(y.neg()), signed(x.clone()), nought()],
        ],
        Variable::Translation => {
            [[x.clone(), y.clone(), z.clone()], [nought(), nought(), signed(R::one())], [nought(), nought(), nought()]]
        }
    }
}

/// A side: the moving point carried by a motion, and its squared distance from the origin, over the monomials.
fn side<R: Ring>(variable: Variable, p: &Vector<R>, reversed: bool, link: &Motion<R>) -> (Moving<R>, [R; 3]) {
    let moving = moved(variable, p, reversed);
    let mut square: [R; 3] = std::array::from_fn(|_| R::zero());
    square[0] = dot(p, p).add(&dot(&link.translation, &link.translation));
    if variable == Variable::Translation {
        // |p + d e|^2 = p.p + 2 d p_z + d^2
        let height = if reversed { p[2].neg() } else { p[2].clone() };
        square[1] = height.add(&height);
        square[2] = R::one();
    }
    let mut carried = moving.each_ref().map(|v| link.rotate(v));
    for (sum, v) in square.iter_mut().zip(&carried) {
        let twice = dot(&link.translation, v);
        *sum = sum.add(&twice).add(&twice);
    }
    carried[0] = plus(&carried[0], &link.translation);
    (carried, square)
}

impl<F: Field> Reach<F> {
    /// The centre of the ball whose three rotations are the unknowns `ball`, `ball + 1`, `ball + 2` of a loop.
    #[must_use]
    pub fn of(closed: &ClosedLoop<F>, ball: usize) -> Self {
        let constant = |k: usize| &closed.constants[(ball + k) % 6];
        let variables = [3, 4, 5].map(|k| closed.variables[(ball + k) % 6]);
        let (before, behind) = (constant(2).inverse(), constant(5));
        let (near, near_square) = side(variables[2], &behind.translation, false, constant(4));
        let (far, far_square) = side(variables[0], &before.translation, true, &constant(3).inverse());
        let coordinate = |moving: &Moving<F>, i: usize| -> [F; 3] { std::array::from_fn(|k| moving[k][i].clone()) };
        let rows = match variables[1] {
            Variable::Rotation => [[coordinate(&near, 2), coordinate(&far, 2)], [near_square, far_square]],
            Variable::Translation => {
                [[coordinate(&near, 0), coordinate(&far, 0)], [coordinate(&near, 1), coordinate(&far, 1)]]
            }
        };
        Self { variables, sides: [near, far], rows }
    }

    /// What the variable of a side does: 0 is V3, 1 is V1.
    #[must_use]
    pub fn kind(&self, side: usize) -> Variable {
        self.variables[2 - 2 * side]
    }

    /// The determinant by which the monomials of a side are solved for.
    fn determinant(&self, side: usize) -> F {
        let [one, two] = [&self.rows[0][side], &self.rows[1][side]];
        one[1].mul(&two[2]).sub(&one[2].mul(&two[1]))
    }

    /// How to solve the two equations; determinants no larger than `tolerance` (0 in exact fields) are zero.
    #[must_use]
    pub fn plan(&self, tolerance: f64) -> Plan<F> {
        let determinants = [self.determinant(0), self.determinant(1)];
        let solved = usize::from(determinants[1].pivot_size() >= determinants[0].pivot_size());
        let invertible = determinants[solved].pivot_size() > tolerance;
        if let Some(inverse) = determinants[solved].inverse().filter(|_| invertible) {
            let hidden = 1 - solved;
            // rows[e][solved] . m = rows[e][hidden] . m'
            let [one, two] = [&self.rows[0], &self.rows[1]];
            let value = |row: &[[F; 3]; 2], k: usize| {
                if k == 0 { row[hidden][0].sub(&row[solved][0]) } else { row[hidden][k].clone() }
            };
            let first = |k: usize| value(one, k).mul(&two[solved][2]).sub(&value(two, k).mul(&one[solved][2]));
            let second = |k: usize| value(two, k).mul(&one[solved][1]).sub(&value(one, k).mul(&two[solved][1]));
            let mut unit: [F; 3] = std::array::from_fn(|_| F::zero());
            unit[0] = F::one();
            let other = [
                unit,
                std::array::from_fn(|k| first(k).mul(&inverse)),
                std::array::from_fn(|k| second(k).mul(&inverse)),
            ];
            return Plan::Together { hidden, other };
        }
        // Rows are dependent in both: the smaller one takes the monomials of V1 out of the other.
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

    /// V2 from the monomials of V3 and V1, as the pair with which it enters a motion: cosine and sine, or the distance
    /// and 0. `None` where the centre lies on the axis of V2.
    #[must_use]
    pub fn middle(&self, monomials: [&[F; 3]; 2]) -> Option<(F, F)> {
        let at = |side: usize| -> Vector<F> {
            std::array::from_fn(|i| {
                (0..3).fold(F::zero(), |sum, k| sum.add(&self.sides[side][k][i].mul(&monomials[side][k])))
            })
        };
        let (near, far) = (at(0), at(1));
        if self.variables[1] == Variable::Translation {
            return Some((far[2].sub(&near[2]), F::zero()));
        }
        let inverse = near[0].mul(&near[0]).add(&near[1].mul(&near[1])).inverse()?;
        let cos = near[0].mul(&far[0]).add(&near[1].mul(&far[1])).mul(&inverse);
        let sin = near[0].mul(&far[1]).sub(&near[1].mul(&far[0])).mul(&inverse);
        Some((cos, sin))
    }

    /// `q . q - 1` of the pair (cos, sin) or `d d - d^2`, as a form in the monomials of the hidden variable.
    #[must_use]
    pub fn conic(&self, hidden: usize, other: &[[F; 3]; 3]) -> [[F; 3]; 3] {
        let product = |x: &[F; 3], y: &[F; 3], i: usize, j: usize| x[i].mul(&y[j]);
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let [one, first, second] = other;
                match self.kind(1 - hidden) {
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
fn offset<R: Ring>() -> [R; 3] {
    [58, 40, 42].map(R::from_integer)
}

/// The closure polynomial in the half tangent of the hidden angle, less 2 atan(3/7), or in the hidden distance, where
/// the monomials of the other variable are `other` times those of the hidden one.
#[must_use]
pub fn closure_polynomial<F: Field>(reach: &Reach<F>, hidden: usize, other: &[[F; 3]; 3]) -> Univariate<F> {
    let powers = powers(reach.kind(hidden), &offset());
    Univariate::new(quartic(&reach.conic(hidden, other), &powers).to_vec())
}

/// How many positions of its centre a ball allows, exactly; `None` where some are not isolated.
#[must_use]
pub fn count<F: Field + Domain>(closed: &ClosedLoop<F>, ball: usize) -> Option<usize> {
    let reach = Reach::of(closed, ball);
    let circle = Univariate::new(vec![F::one(), F::zero(), F::one()]);
    match reach.plan(0.0) {
        Plan::Together { hidden, other } => {
            let powers = powers(reach.kind(hidden), &offset());
            let polynomial = closure_polynomial(&reach, hidden, &other);
            polynomial.degree()?;
            let rest = match reach.kind(hidden) {
                Variable::Rotation => polynomial.remove_factor(&circle).1,
                Variable::Translation => polynomial,
            };
            if reach.variables[1] == Variable::Rotation {
                // Where the centre lies on the axis of V2, V2 is not determined.
                let monomials = powers.map(|row| Univariate::new(row.to_vec()));
                let side = &reach.sides[hidden];
                let at = |i: usize| {
                    (0..3).fold(Univariate::zero(), |sum: Univariate<F>, k| sum.add(&monomials[k].scale(&side[k][i])))
                };
                let radius = at(0).mul(&at(0)).add(&at(1).mul(&at(1)));
                if radius.is_zero() || rest.gcd(&radius).degree() > Some(0) {
                    return None;
                }
            }
            rest.degree()
        }
        Plan::Apart { first, equation, then } => {
            let roots = |kind: Variable, row: &[F; 3]| match kind {
                Variable::Rotation => {
                    let square = row[1].mul(&row[1]).add(&row[2].mul(&row[2]));
                    if square.is_zero() { None } else { Some(2) }
                }
                Variable::Translation if !row[2].is_zero() => Some(2),
                Variable::Translation => (!row[1].is_zero()).then_some(1),
            };
            if equation[1].is_zero() && equation[2].is_zero() {
                return if equation[0].is_zero() { None } else { Some(0) };
            }
            Some(roots(reach.kind(first), &equation)? * roots(reach.kind(1 - first), &then[1])?)
        }
    }
}

/// How many positions a ball and three variables allow in general.
#[must_use]
pub fn general_count(variables: [Variable; 3]) -> usize {
    match variables.iter().filter(|v| **v == Variable::Translation).count() {
        0 | 1 => 4,
        2 => 2,
        _ => 1,
    }
}
