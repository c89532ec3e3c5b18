//! The half-angle form: closure equations in which the one unknown next to the cut appears linearly by tan(q3/2).
//!
//! A pair (x, y) of the right side that rotates with q3 enters as `(x + i y) e^(-i q3)`. Two complex combinations of the closure
//! equations contain no `e^(+i q3)`: `P e^(-i q3) + Q = 0`, and with `x3 = tan(q3/2)` they become
//! `(P + Q) - i x3 (P - Q) = 0`, four real equations linear in x3 without the factor `1 + x3^2`.
//! [LeeWoernleHiller1991, RaghavanRoth1993]

use super::woernle_lee::{FIXED, MarkedLine, TURNING_X, TURNING_Y, act_on_form, left_columns};
use crate::algebra::reduction::{Reduction, reduce};
use crate::algebra::ring::{Field, Ring};
use crate::kinematics::closed_loop::ClosedLoop;

/// The closure equations of a cut that remain when unknowns 4, 5 and 6 are eliminated from its 14. They depend on the
/// constants G3, G4, G5 alone.
#[derive(Clone, Debug)]
pub struct HalfAngleForm<F> {
    /// Four pairs of rows (e0, e1), as rows k and 4 + k: `(e0 + x3 e1) T(G2^-1) u(q1, q2) = 0`.
    pub rows: [MarkedLine<F>; 8],
    /// The six equations free of unknowns 4 to 6 before q3 is split off: `M T(Rz(-q3)) T(G2^-1) u(q1, q2) = 0`.
    pub free_of_last: [MarkedLine<F>; 6],
    /// Rows that solve the left side: applied to `T(G3^-1) T(Rz(-q3)) T(G2^-1) u` they give c5, s5, c4, s4.
    pub last_monomials: [MarkedLine<F>; 4],
    /// Distance of the cut from losing an equation: 0 if one is lost, near 1 far from it. A cut at 0 must not be used.
    pub score: f64,
}

/// The row operations behind a half-angle form. Over inexact fields they are approximate, and a proof bounds by how much.
#[derive(Clone, Debug)]
pub struct Combinations<F> {
    /// Rows that annihilate the left side.
    pub annihilators: [MarkedLine<F>; 6],
    /// A left inverse of the left side: row k gives its monomial k.
    pub monomials: [MarkedLine<F>; 9],
    /// Rows that annihilate what turns with `e^(+i q3)`, see [`turning`].
    pub without_plus: [[F; 12]; 4],
    /// A left inverse of that.
    pub turning_inverse: [[F; 12]; 8],
}

/// Eliminates unknowns 4, 5 and 6 of a cut; `None` if it is degenerate and loses equations.
#[must_use]
pub fn half_angle_form<F: Field>(cut: &ClosedLoop<F>) -> Option<HalfAngleForm<F>> {
    with_combinations(cut).map(|(form, _)| form)
}

/// As [`half_angle_form`], with the row operations.
///
/// # Panics
/// Never: a reduction of full rank has a pivot in every column.
#[must_use]
pub fn with_combinations<F: Field>(cut: &ClosedLoop<F>) -> Option<(HalfAngleForm<F>, Combinations<F>)> {
    let columns = left_columns(cut);
    let left: [[F; 9]; 15] = std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i].clone()));
    let solved: Reduction<F, 15, 9> = reduce(left);
    if solved.rank < 9 {
        return None;
    }
    let mut annihilators: [MarkedLine<F>; 6] = std::array::from_fn(|k| solved.transform[9 + k].clone());
    F::orthonormalise(&mut annihilators);
    let back = cut.constants[2].inverse();
    let free_of_last = annihilators.each_ref().map(|n| act_on_form(n, &back));

    let split: Reduction<F, 12, 8> = reduce(turning(&free_of_last));
    if split.rank < 8 {
        return None;
    }
    let mut without_plus: [[F; 12]; 4] = std::array::from_fn(|k| split.transform[8 + k].clone());
    F::orthonormalise(&mut without_plus);
    let rows = combined(&without_plus, &free_of_last);

    let solving = |column: usize| {
        let row = solved.columns.iter().position(|&c| c == column).expect("all nine columns have a pivot");
        solved.transform[row].clone()
    };
    let monomials: [MarkedLine<F>; 9] = std::array::from_fn(solving);
    let solving = |column: usize| {
        let row = split.columns.iter().position(|&c| c == column).expect("all eight columns have a pivot");
        split.transform[row].clone()
    };
    let turning_inverse = std::array::from_fn(solving);
    // Monomials run (1, c5, s5) slowly, (1, c4, s4) fast.
    let last_monomials = [3, 6, 1, 2].map(|k| monomials[k].clone());
    let score = solved.independence.min(split.independence);
    let form = HalfAngleForm { rows, free_of_last, last_monomials, score };
    Some((form, Combinations { annihilators, monomials, without_plus, turning_inverse }))
}

/// The coefficients of `e^(+i q3)` in the equations free of unknowns 4 to 6: a real and an imaginary part of each. Left null vectors
/// (yr, yi) of this matrix `[[Mx, My], [-My, Mx]]` are the combinations without `e^(+i q3)`.
#[must_use]
pub fn turning<R: Ring>(free_of_last: &[MarkedLine<R>; 6]) -> [[R; 8]; 12] {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let (m, x_block) = (&free_of_last[i % 6], j < 4);
            match (i < 6, x_block) {
                (true, true) => m[TURNING_X[j]].clone(),
                (true, false) => m[TURNING_Y[j - 4]].clone(),
                (false, true) => m[TURNING_Y[j]].neg(),
                (false, false) => m[TURNING_X[j - 4]].clone(),
            }
        })
    })
}

/// The rows of a half-angle form, from the combinations of the equations free of unknowns 4 to 6 that hold no `e^(+i q3)`.
#[must_use]
pub fn combined<R: Ring>(combinations: &[[R; 12]; 4], free_of_last: &[MarkedLine<R>; 6]) -> [MarkedLine<R>; 8] {
    let mut rows: [MarkedLine<R>; 8] = std::array::from_fn(|_| std::array::from_fn(|_| R::zero()));
    for (k, y) in combinations.iter().enumerate() {
        let (real, imaginary) = y.split_at(6);
        let combine = |weights: &[R], at: usize| {
            weights.iter().zip(free_of_last).fold(R::zero(), |sum, (w, m)| sum.add(&w.mul(&m[at])))
        };
        for (x, y) in TURNING_X.into_iter().zip(TURNING_Y) {
            let (along, across) = (combine(real, x), combine(imaginary, x));
            rows[k][x] = along.clone();
            rows[k][y] = across.neg();
            rows[4 + k][x] = across;
            rows[4 + k][y] = along;
        }
        for i in FIXED {
            rows[k][i] = combine(real, i);
            rows[4 + k][i] = combine(imaginary, i).neg();
        }
    }
    rows
}
