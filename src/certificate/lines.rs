//! The matrix of an eliminant: equations of a line with a marked point, in the first three unknowns of a loop.
//!
//! A line of direction l through the marked point p is the vector `(1, p, l, p.p, p.l, m, w)` with `m = p x l` and
//! `w = (p.p) l - 2 (p.l) p`. Motions act on such vectors by matrices: `R p + t` has the square `p.p + 2 t.Rp + t.t`, the product
//! `p.l + t.Rl` with `R l`, the moment `R m + t x Rl`, and w becomes
//! `R w - 2 t x Rm + (t.t) Rl - 2 (t.Rl + p.l) t`. \[RaghavanRoth1993\]

use crate::algebra::echelon::Echelon;
use crate::algebra::ring::{Field, Ring};
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::{Motion, cross, dot};
use rug::Rational;

/// The number of entries of a line: 1 and fourteen others.
const ENTRIES: usize = 15;
/// The number of products of 1, cosine and sine, or of the powers of a distance, of three unknowns.
const PRODUCTS: usize = 27;
/// Columns of the matrix: `u^i v^j`, i up to 3 and j up to 2.
pub(super) const COLUMNS: usize = 12;

type Line<R> = [R; ENTRIES];
/// A polynomial of degree 2 in the hidden unknown, its constant coefficient first.
pub(super) type Square<R> = [R; 3];
/// The kind of every unknown; `None` for one that is held at 0.
pub(super) type Kinds = [Option<Variable>; 6];
/// Rows of the matrix, for [`COLUMNS`] columns.
pub(super) type Rows<R> = Vec<Vec<Square<R>>>;

/// Returns the z axis with the origin marked.
fn z_axis<R: Ring>() -> Line<R> {
    std::array::from_fn(|k| if k == 0 || k == 6 { R::one() } else { R::zero() })
}

fn twice<R: Ring>(x: &R) -> R {
    x.add(x)
}

/// Returns the line behind a motion.
fn moved<R: Ring>(motion: &Motion<R>, line: &Line<R>) -> Line<R> {
    let part = |first: usize| motion.rotate(&std::array::from_fn(|k| line[first + k].clone()));
    let ([one, square, inner], t) = ([&line[0], &line[7], &line[8]], &motion.translation);
    let [p, l, m, w] = [part(1), part(4), part(9), part(12)];
    let (tl, tt) = (dot(t, &l), dot(t, t));
    let (along, of_moment, of_direction) = (twice(&tl.add(inner)), cross(t, &m), cross(t, &l));
    std::array::from_fn(|k| match k {
        0 => one.clone(),
        1..=3 => p[k - 1].add(&t[k - 1].mul(one)),
        4..=6 => l[k - 4].clone(),
        7 => square.add(&twice(&dot(t, &p))).add(&tt.mul(one)),
        8 => inner.add(&tl),
        9..=11 => m[k - 9].add(&of_direction[k - 9]),
        _ => {
            let j = k - 12;
            w[j].sub(&twice(&of_moment[j])).add(&tt.mul(&l[j])).sub(&along.mul(&t[j]))
        }
    })
}

/// Returns the images of a line under an unknown: the coefficients of 1, cosine and sine of an angle, or of 1, x and x^2 of a
/// distance x. One that is held at 0 has the first alone.
fn split<R: Ring>(line: &Line<R>, kind: Option<Variable>) -> [Line<R>; 3] {
    let Some(kind) = kind else {
        return [line.clone(), [(); ENTRIES].map(|()| R::zero()), [(); ENTRIES].map(|()| R::zero())];
    };
    let with = |f: &dyn Fn(usize) -> R| -> Line<R> { std::array::from_fn(f) };
    if kind == Variable::Rotation {
        let at = |c: i32, s: i32| moved(&Motion::rotation_z(R::from_integer(c), R::from_integer(s)), line);
        let (still, cos, sin) = (at(0, 0), at(1, 0), at(0, 1));
        return [with(&|k| still[k].clone()), with(&|k| cos[k].sub(&still[k])), with(&|k| sin[k].sub(&still[k]))];
    }
    let at = |x: i32| moved(&Motion::translation_z(R::from_integer(x)), line);
    // Values at 0, 1 and 2 of a polynomial of degree 2: half the second difference is its last coefficient.
    let (one, two) = (at(1), at(2));
    let half = R::from_rational(&Rational::from((1, 2))).unwrap_or_else(R::zero);
    let last = with(&|k| half.mul(&two[k].sub(&twice(&one[k])).add(&line[k])));
    let middle = with(&|k| one[k].sub(&line[k]).sub(&last[k]));
    [line.clone(), middle, last]
}

/// Returns the combinations of the fourteen equations that are free of the last two unknowns, by their coefficients of the products
/// of the first three; `None` if those two do not follow from the others.
fn equations<R: Field>(links: &[Motion<R>; 6], kinds: &Kinds) -> Option<Vec<Vec<R>>> {
    let mut left = vec![z_axis::<R>()];
    for k in (0..3).rev() {
        // The first unknown counts most: 9 i + 3 j + k.
        let split_up: Vec<[Line<R>; 3]> = left.iter().map(|line| split(&moved(&links[k], line), kinds[k])).collect();
        left = (0..3).flat_map(|e| split_up.iter().map(move |parts| parts[e].clone())).collect();
    }
    let mut right = vec![moved(&links[3].inverse(), &z_axis::<R>())];
    for k in [4, 5] {
        let back = links[k].inverse();
        right = right.iter().flat_map(|line| split(line, kinds[k])).map(|line| moved(&back, &line)).collect();
    }
    // Of the last two unknowns the product (i, j) stands at 3 i + j, and (0, 0) is known.
    let terms: Vec<usize> = (1..right.len()).filter(|k| right[*k].iter().any(|x| !x.is_zero())).collect();
    let turns = |k: usize| kinds[k] == Some(Variable::Rotation);
    let own = [kinds[4].map(|_| 3), turns(4).then_some(6), kinds[5].map(|_| 1), turns(5).then_some(2)];
    let table = terms.iter().map(|k| right[*k][1..].to_vec()).collect();
    let table = Echelon::of(table, ENTRIES - 1);
    if table.rank() != terms.len() || !own.iter().flatten().all(|k| terms.contains(k)) {
        return None;
    }
    let combined = |weights: &Vec<R>| -> Vec<R> {
        let of = |line: &Line<R>| weights.iter().zip(&line[1..]).fold(R::zero(), |sum, (w, x)| sum.add(&w.mul(x)));
        let mut equation: Vec<R> = left.iter().map(of).collect();
        equation[0] = equation[0].sub(&of(&right[0]));
        equation
    };
    Some(table.null_space().iter().map(combined).collect())
}

/// Returns a polynomial of degree 2 for 1, cosine and sine times `1 + t^2`, or for a power of a distance.
fn part(is_turn: bool, exponent: usize) -> [i32; 3] {
    match (is_turn, exponent) {
        (true, 0) => [1, 0, 1],
        (true, 1) => [1, 0, -1],
        (true, _) => [0, 2, 0],
        (false, k) => std::array::from_fn(|i| i32::from(i == k)),
    }
}

/// Returns the equations times `1 + t^2` of every rotation, once and times the first other unknown u, as rows for the columns `u^i v^j`;
/// `None` if the last two unknowns do not follow from the others.
pub(super) fn matrix<R: Field>(links: &[Motion<R>; 6], kinds: &Kinds, hidden: usize) -> Option<Rows<R>> {
    let mut rows = Rows::new();
    let others: Vec<usize> = (0..3).filter(|k| *k != hidden).collect();
    for equation in equations(links, kinds)? {
        let mut row = vec![[(); 3].map(|()| R::zero()); COLUMNS];
        for (at, value) in (0..PRODUCTS).zip(&equation) {
            let exponents = [at / 9, at / 3 % 3, at % 3];
            let of = |k: usize| part(kinds[k] == Some(Variable::Rotation), exponents[k]);
            let (own, u, v) = (of(hidden), of(others[0]), of(others[1]));
            for i in 0..3 {
                for j in 0..3 {
                    for (sum, h) in row[3 * i + j].iter_mut().zip(own) {
                        let factor = u[i] * v[j] * h;
                        if factor != 0 {
                            *sum = sum.add(&value.mul(&R::from_integer(factor)));
                        }
                    }
                }
            }
        }
        let mut shifted = row.clone();
        shifted.rotate_right(3);
        rows.extend([row, shifted]);
    }
    Some(rows)
}

/// Returns the matrix at a value of the hidden unknown.
pub(super) fn at<R: Ring>(rows: &Rows<R>, t: &R) -> Vec<Vec<R>> {
    let value = |[a, b, c]: &Square<R>| c.mul(t).add(b).mul(t).add(a);
    rows.iter().map(|row| row.iter().map(value).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(p: &[Rational; 3], l: &[Rational; 3]) -> Line<Rational> {
        let (square, inner, m) = (dot(p, p), dot(p, l), cross(p, l));
        std::array::from_fn(|k| match k {
            0 => Rational::from(1),
            1..=3 => p[k - 1].clone(),
            4..=6 => l[k - 4].clone(),
            7 => square.clone(),
            8 => inner.clone(),
            9..=11 => m[k - 9].clone(),
            _ => Rational::from(&square * &l[k - 12]) - Rational::from(&inner * &p[k - 12]) * 2_u32,
        })
    }

    #[test]
    fn a_line_moves_as_its_point_and_direction_do() {
        let of = |k: i32| Rational::from((7 * k % 23 - 11, 9));
        let (p, l) = ([of(1), of(2), of(3)], [of(4), of(5), of(6)]);
        let mut motion = Motion::rotation_z(Rational::from((3, 5)), Rational::from((4, 5)))
            .then_after(&Motion::rotation_x(Rational::from((5, 13)), Rational::from((12, 13))));
        motion.translation = [of(7), of(8), of(9)];
        assert_eq!(moved(&motion, &line(&p, &l)), line(&motion.apply(&p), &motion.rotate(&l)));
        let x = Rational::from((3, 7));
        let parts = split(&line(&p, &l), Some(Variable::Translation));
        let sum = |k: usize| (Rational::from(&parts[2][k] * &x) + &parts[1][k]) * &x + &parts[0][k];
        assert_eq!(std::array::from_fn(sum), moved(&Motion::translation_z(x.clone()), &line(&p, &l)));
    }
}
