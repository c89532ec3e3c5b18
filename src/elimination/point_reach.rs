//! A spherical joint and three more joint variables: the point at its centre, reached from both sides, degree 4 at most.
//!
//! `V1 G1 V2 G2 V3 p = p0` for the centre seen from its two links. Where V2 turns, both sides have the same height and
//! distance from a point of its axis; where it slides, they lie over the same point: two equations, the same for every
//! sort of V1 and V3,
//!
//! `a_e . m3 = b_e . m1,  e = 1, 2,  m = (1, cos q, sin q)  or  (1, d, d^2)`.

use super::separated::{Plan, Separated, closure_polynomial, offset, powers};
use crate::algebra::ring::{Domain, Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::{Motion, Vector, dot};

/// A point that moves with one variable: coefficients over m.
pub type Moving<R> = [Vector<R>; 3];

/// The centre of a spherical joint, reached from both sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Reach<R> {
    /// The kinds of the three variables behind the spherical joint.
    pub variables: [Variable; 3],
    /// The centre before V2 acts, over the monomials of V3, and behind it, over those of V1.
    pub sides: [Moving<R>; 2],
    /// The two equations: sides are V3 and V1.
    pub equations: Separated<R>,
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

impl<F: Ring> Reach<F> {
    /// The centre of the spherical joint whose three rotations are the unknowns `spherical`, `spherical + 1`, `spherical + 2` of a loop.
    #[must_use]
    pub fn of(closed: &ClosedLoop<F>, spherical: usize) -> Self {
        let constant = |k: usize| &closed.constants[(spherical + k) % 6];
        let variables = [3, 4, 5].map(|k| closed.variables[(spherical + k) % 6]);
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
        Self { variables, sides: [near, far], equations: Separated { kinds: [variables[2], variables[0]], rows } }
    }
}

impl<F: Field> Reach<F> {
    /// Returns V2 from the monomials of V3 and V1, as the pair with which it enters a motion: cosine and sine, or the distance
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
}

/// Returns the exact number of positions of the centre of a spherical joint; `None` where some are not isolated.
#[must_use]
pub fn count<F: Field + Domain>(closed: &ClosedLoop<F>, spherical: usize) -> Option<usize> {
    let reach = Reach::of(closed, spherical);
    match reach.equations.plan(0.0) {
        Plan::Together { hidden, other } => {
            let powers = powers(reach.equations.kinds[hidden], &offset());
            let polynomial = closure_polynomial(&reach.equations, hidden, &other);
            polynomial.degree()?;
            let rest = match reach.equations.kinds[hidden] {
                Variable::Rotation => polynomial.remove_factor(&Univariate::circle()).1,
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
            Some(roots(reach.equations.kinds[first], &equation)? * roots(reach.equations.kinds[1 - first], &then[1])?)
        }
    }
}

/// Returns the number of positions that a spherical joint and three variables have in general.
#[must_use]
pub fn general_count(variables: [Variable; 3]) -> usize {
    match variables.iter().filter(|v| **v == Variable::Translation).count() {
        0 | 1 => 4,
        2 => 2,
        _ => 1,
    }
}
