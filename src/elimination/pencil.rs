//! The dialytic step: four equations bilinear in two unknowns and linear in a third become a quadratic pencil.
//!
//! With x = tan(q/2) for the hidden unknown, z for the other one and x3 for the third,
//! `(A0 + A1 x + A2 x^2) y = 0`, `y = (1, z, z^2, z^3, x3, z x3, z^2 x3, z^3 x3)`; the rows are the four equations times
//! 1 and z. Its determinant has degree 16 and no factor 1 + x^2 in general: the closure polynomial of the loop.
//! \[LeeWoernleHiller1991\]

use super::cut::Hidden;
use crate::algebra::ring::{Field, Ring};
use crate::closure::half_angle::HalfAngleForm;
use crate::closure::woernle_lee::{MarkedLine, SIZE, act_on_form, right_columns};
use crate::kinematics::closed_loop::ClosedLoop;
use crate::kinematics::motion::Motion;

/// A square matrix.
pub type Square<R, const N: usize> = [[R; N]; N];

/// `A0 + A1 x + A2 x^2`.
#[derive(Clone, Debug)]
pub struct Pencil<R> {
    /// A0, A1, A2.
    pub coefficients: [Square<R, 8>; 3],
}

/// The closure equations of a cut after elimination: `[e][k1][k2]` is the coefficient of `(1, c1, s1)[k1] (1, c2, s2)[k2]`
/// in row e; rows 0 to 3 are free of x3, rows 4 to 7 multiply x3.
pub type Bilinear<R> = [[[R; 3]; 3]; 8];

/// `rows * T(G2^-1)`: the half-angle form ready for unknowns 1 and 2.
#[must_use]
pub fn before_second_link<F: Field>(form: &HalfAngleForm<F>, second: &Motion<F>) -> [MarkedLine<F>; 8] {
    let back = second.inverse();
    form.rows.each_ref().map(|row| act_on_form(row, &back))
}

/// The bilinear equations of a cut from its prepared rows and the constants G1 and G6.
#[must_use]
pub fn bilinear<R: Ring>(rows: &[MarkedLine<R>; 8], cut: &ClosedLoop<R>) -> Bilinear<R> {
    let columns = right_columns(cut);
    std::array::from_fn(|e| {
        std::array::from_fn(|k1| {
            std::array::from_fn(|k2| {
                let column = &columns[k1][k2];
                (0..SIZE).fold(R::zero(), |sum, i| sum.add(&rows[e][i].mul(&column[i])))
            })
        })
    })
}

/// Turns the hidden unknown by a constant angle: the equations in `q' = q - angle`, given its cosine and sine.
///
/// A generic offset keeps roots away from x = infinity, so that an angle of pi is an ordinary one.
#[must_use]
pub fn offset<R: Ring>(equations: &Bilinear<R>, hidden: Hidden, cos: &R, sin: &R) -> Bilinear<R> {
    let mut turned = equations.clone();
    for row in &mut turned {
        for k in 0..3 {
            let (c, s) = match hidden {
                Hidden::First => (row[1][k].clone(), row[2][k].clone()),
                Hidden::Second => (row[k][1].clone(), row[k][2].clone()),
            };
            // c = c' cos - s' sin, s = s' cos + c' sin
            let new_c = c.mul(cos).add(&s.mul(sin));
            let new_s = s.mul(cos).sub(&c.mul(sin));
            match hidden {
                Hidden::First => (row[1][k], row[2][k]) = (new_c, new_s),
                Hidden::Second => (row[k][1], row[k][2]) = (new_c, new_s),
            }
        }
    }
    turned
}

/// `(1, c, s)` times `1 + x^2` over the powers of x: coefficient triple of (1, x, x^2).
#[inline(always)]
fn half_angle<R: Ring>([one, cos, sin]: [&R; 3]) -> [R; 3] {
    [one.add(cos), sin.add(sin), one.sub(cos)]
}

/// The pencil of these equations in the hidden unknown.
#[must_use]
pub fn pencil<R: Ring>(equations: &Bilinear<R>, hidden: Hidden) -> Pencil<R> {
    let zero = || -> Square<R, 8> { std::array::from_fn(|_| std::array::from_fn(|_| R::zero())) };
    let mut coefficients = [zero(), zero(), zero()];
    for (e, equation) in equations.iter().enumerate() {
        // Powers of the hidden unknown first, then of the other one.
        let by_hidden: [[R; 3]; 3] = std::array::from_fn(|k| {
            half_angle(match hidden {
                Hidden::First => [&equation[0][k], &equation[1][k], &equation[2][k]],
                Hidden::Second => [&equation[k][0], &equation[k][1], &equation[k][2]],
            })
        });
        let (row, column) = (2 * (e % 4), 4 * (e / 4));
        for (power, matrix) in coefficients.iter_mut().enumerate() {
            let other = half_angle([&by_hidden[0][power], &by_hidden[1][power], &by_hidden[2][power]]);
            for (l, value) in other.into_iter().enumerate() {
                matrix[row + 1][column + l + 1] = value.clone();
                matrix[row][column + l] = value;
            }
        }
    }
    Pencil { coefficients }
}
