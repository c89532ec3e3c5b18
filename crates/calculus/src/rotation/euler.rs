//! Euler angles of any order of axes: A = Ri(a) Rj(b) Rk(c), each about a coordinate axis of the body as rotated before.
//!
//! `zxz` are Euler angles as in \[Wittenburg2016, 1.3\], `xyz` his Bryan angles.

use super::matrix::{Matrix, from_matrix};
use super::turn::Turn;
use crate::quaternion::Quaternion;
use crate::unit::{Root, Unit};
use looproot_algebra::ring::Ring;

/// Three coordinate axes, neighbours different.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Order {
    axes: [usize; 3],
}

/// All angles of a rotation in one order of axes.
#[derive(Clone, Debug, PartialEq)]
pub enum Angles<R> {
    /// The two triples.
    Two([[Turn<R>; 3]; 2]),
    /// The outer axes coincide: only the sum or the difference of the outer angles is known.
    Family {
        /// The middle angle.
        middle: Turn<R>,
        /// The sum or the difference of the outer angles.
        outer: Turn<R>,
        /// Whether it is the difference, the first less the third.
        is_difference: bool,
    },
}

impl Order {
    /// Euler angles, zxz.
    pub const EULER: Self = Self { axes: [2, 0, 2] };
    /// Bryan angles, xyz.
    pub const BRYAN: Self = Self { axes: [0, 1, 2] };

    /// Reads an order by its letters, such as `zyz`; `None` for other words, and if neighbours are equal.
    #[must_use]
    pub fn parse(word: &str) -> Option<Self> {
        let letters: Vec<usize> = word.chars().map(|c| "xyz".find(c.to_ascii_lowercase())).collect::<Option<_>>()?;
        let axes: [usize; 3] = letters.try_into().ok()?;
        (axes[0] != axes[1] && axes[1] != axes[2]).then_some(Self { axes })
    }

    /// Returns whether first and third axis are the same.
    #[must_use]
    pub fn is_proper(self) -> bool {
        self.axes[0] == self.axes[2]
    }

    /// Returns the first two axes, the remaining one, and whether they are in cyclic order.
    fn frame(self) -> (usize, usize, usize, bool) {
        let [i, j, _] = self.axes;
        (i, j, 3 - i - j, (i + 1) % 3 == j)
    }

    /// Returns the rotation by three angles.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::rotation::{euler::Order, turn::Turn};
    /// let quarter = Turn { cos: 0.0, sin: 1.0 };
    /// let a = Order::EULER.matrix(&[quarter.clone(), Turn::zero(), quarter]);
    /// assert_eq!(a[0], [-1.0, 0.0, 0.0]);
    /// ```
    #[must_use]
    pub fn matrix<R: Ring>(self, angles: &[Turn<R>; 3]) -> Matrix<R> {
        let [i, j, k] = self.axes;
        let [a, b, c] = angles;
        turned(turned(about_axis(i, a), j, b), k, c)
    }

    /// Returns a quaternion of the rotation by three angles, up to a factor.
    #[must_use]
    pub fn quaternion<R: Root>(self, angles: &[Turn<R>; 3]) -> Quaternion<R> {
        from_matrix(&self.matrix(angles))
    }

    /// Returns all angles of a rotation; `None` if the ring lacks a root, as for most rational matrices.
    ///
    /// # Source
    /// \[Wittenburg2016, 1.3 and 1.4\], for any order.
    #[must_use]
    pub fn angles<R: Root>(self, m: &Matrix<R>) -> Option<Angles<R>> {
        let (i, j, l, cyclic) = self.frame();
        let signed = |c: &R| if cyclic { c.clone() } else { c.neg() };
        // The middle angle, and the two entries that its sine (or its cosine) multiplies on either side.
        let (first, third) = if self.is_proper() {
            ([signed(&m[l][i]).neg(), m[j][i].clone()], [signed(&m[i][l]), m[i][j].clone()])
        } else {
            ([m[l][l].clone(), signed(&m[j][l]).neg()], [m[i][i].clone(), signed(&m[i][j]).neg()])
        };
        let square = third[0].mul(&third[0]).add(&third[1].mul(&third[1]));
        let outer = || Turn { cos: m[j][j].clone(), sin: signed(&m[l][j]) };
        let vanishes = third.iter().all(Unit::is_small);
        let zero = R::zero;
        if vanishes && self.is_proper() {
            let is_difference = m[i][i].is_negative();
            let cos = if is_difference { R::one().neg() } else { R::one() };
            return Some(Angles::Family { middle: Turn { cos, sin: zero() }, outer: outer(), is_difference });
        }
        if vanishes {
            let sine = signed(&m[i][l]);
            let is_difference = sine.is_negative() == cyclic;
            let sin = if sine.is_negative() { R::one().neg() } else { R::one() };
            return Some(Angles::Family { middle: Turn { cos: zero(), sin }, outer: outer(), is_difference });
        }
        let size = square.sqrt()?;
        let branch = |size: &R| {
            let inverse = size.reciprocal()?;
            let turn = |[cos, sin]: &[R; 2]| Turn { cos: cos.mul(&inverse), sin: sin.mul(&inverse) };
            let middle = if self.is_proper() {
                Turn { cos: m[i][i].clone(), sin: size.clone() }
            } else {
                Turn { cos: size.clone(), sin: signed(&m[i][l]) }
            };
            Some([turn(&first), middle, turn(&third)])
        };
        Some(Angles::Two([branch(&size)?, branch(&size.neg())?]))
    }
}

/// Returns the product of a matrix and the rotation about a coordinate axis, which changes two columns.
fn turned<R: Ring>(mut m: Matrix<R>, axis: usize, turn: &Turn<R>) -> Matrix<R> {
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    for row in &mut m {
        let first = row[next].mul(&turn.cos).add(&row[last].mul(&turn.sin));
        row[last] = row[last].mul(&turn.cos).sub(&row[next].mul(&turn.sin));
        row[next] = first;
    }
    m
}

/// Returns the rotation about a coordinate axis.
fn about_axis<R: Ring>(axis: usize, turn: &Turn<R>) -> Matrix<R> {
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut m: Matrix<R> = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { R::one() } else { R::zero() }));
    m[next][next] = turn.cos.clone();
    m[last][last] = turn.cos.clone();
    m[last][next] = turn.sin.clone();
    m[next][last] = turn.sin.neg();
    m
}
