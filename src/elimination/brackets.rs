//! The closure polynomial of a cut as a function of its hidden angle, without division and without pivots.
//!
//! At a hidden angle the four equations `sum_l z^l (c_l + x3 d_l) = 0`, l = 0 to 2, have six columns of four numbers each. The
//! determinant of the 8 x 8 matrix of [`pencil`](super::pencil) is a polynomial in their 4 x 4 minors (Laplace's expansion), which
//! are made from 2 x 2 minors. In the hidden angle it is a trigonometric polynomial of degree 8.

use super::cut::Hidden;
use super::pencil::Bilinear;
use crate::algebra::ring::Ring;

/// The columns c0, c1, c2, d0, d1, d2 over `(1, cos, sin)` of the hidden angle: `[column][equation][k]`.
pub type Columns<R> = [[[R; 3]; 4]; 6];

/// Returns the columns of a cut's equations, without the factor that makes half-angles of the other unknown polynomial.
pub fn columns<R: Ring>(equations: &Bilinear<R>, hidden: Hidden) -> Columns<R> {
    let zero = || std::array::from_fn(|_| std::array::from_fn(|_| R::zero()));
    let mut columns: Columns<R> = std::array::from_fn(|_| zero());
    for (e, equation) in equations.iter().enumerate() {
        for k in 0..3 {
            let [one, cos, sin] = match hidden {
                Hidden::First => [&equation[k][0], &equation[k][1], &equation[k][2]],
                Hidden::Second => [&equation[0][k], &equation[1][k], &equation[2][k]],
            };
            let first = 3 * (e / 4);
            columns[first][e % 4][k] = one.add(cos);
            columns[first + 1][e % 4][k] = sin.add(sin);
            columns[first + 2][e % 4][k] = one.sub(cos);
        }
    }
    columns
}

/// Returns the columns at a hidden angle, given its cosine and sine.
#[inline(always)]
pub fn at<R: Ring>(columns: &Columns<R>, cos: &R, sin: &R) -> [[R; 4]; 6] {
    columns.each_ref().map(|column| column.each_ref().map(|[one, c, s]| one.add(&c.mul(cos)).add(&s.mul(sin))))
}

/// Returns the determinant of the 8 x 8 matrix of these columns, up to its sign.
#[inline(always)]
pub fn determinant<R: Ring>(columns: &[[R; 4]; 6]) -> R {
    // Minors of rows 0, 1 and of rows 2, 3.
    let minors = |row: usize| -> [[R; 6]; 6] {
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                if i >= j {
                    return R::zero();
                }
                let (a, b) = (&columns[i], &columns[j]);
                a[row].mul(&b[row + 1]).sub(&a[row + 1].mul(&b[row]))
            })
        })
    };
    let (upper, lower) = (minors(0), minors(2));
    let bracket = |a: usize, b: usize, c: usize, d: usize| {
        let pair = |i: usize, j: usize, k: usize, l: usize| upper[i][j].mul(&lower[k][l]);
        let plus = pair(a, b, c, d).add(&pair(a, d, b, c)).add(&pair(b, c, a, d)).add(&pair(c, d, a, b));
        plus.sub(&pair(a, c, b, d)).sub(&pair(b, d, a, c))
    };
    let middle = bracket(0, 2, 3, 5);
    let minus = bracket(0, 1, 2, 3)
        .mul(&bracket(2, 3, 4, 5))
        .add(&bracket(0, 1, 3, 5).mul(&bracket(1, 2, 3, 5)))
        .add(&bracket(0, 2, 3, 4).mul(&bracket(0, 2, 4, 5)))
        .add(&bracket(0, 3, 4, 5).mul(&bracket(0, 1, 2, 5)));
    bracket(0, 1, 3, 4).mul(&bracket(1, 2, 4, 5)).add(&middle.mul(&middle)).sub(&minus)
}

/// Returns the 8 x 8 matrix of these columns: every equation times 1 and times the half-tangent of the other unknown.
pub fn matrix<R: Ring>(columns: &[[R; 4]; 6]) -> super::pencil::Square<R, 8> {
    let mut matrix: super::pencil::Square<R, 8> = std::array::from_fn(|_| std::array::from_fn(|_| R::zero()));
    for (l, column) in columns.iter().enumerate() {
        let place = 4 * (l / 3) + l % 3;
        for (e, value) in column.iter().enumerate() {
            matrix[2 * e][place] = value.clone();
            matrix[2 * e + 1][place + 1] = value.clone();
        }
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::determinant::bareiss;
    use rug::Integer;

    #[test]
    fn brackets_give_the_determinant() {
        for seed in 1..20_usize {
            let entry = |l: usize, e: usize| Integer::from((seed * 7919 + (l * 4 + e + 1) * 104_729) % 23) - 11;
            let columns: [[Integer; 4]; 6] = std::array::from_fn(|l| {
                std::array::from_fn(|e| entry(l, e) * Integer::from(l + 2 * e + 1) % Integer::from(17))
            });
            let own = determinant(&columns);
            let full = matrix(&columns).map(|row| row.to_vec()).to_vec();
            let other = bareiss(&full);
            assert_eq!(Integer::from(own.abs_ref()), Integer::from(other.abs_ref()), "{columns:?}");
        }
    }
}
