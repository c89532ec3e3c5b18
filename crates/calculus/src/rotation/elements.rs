//! Rotation matrices with three prescribed elements: three quadrics in the quaternion, eight points of P^3 in general.
//!
//! The nine places fall into four patterns up to exchanges of rows, of columns, and of rows with columns. In three of them
//! signed square roots give the other elements. In the fourth, three elements of one row, there is a circle of solutions or none.

use super::matrix::{Matrix, matrix, transpose};
use crate::motion::cross;
use crate::quaternion::Quaternion;
use crate::unit::Unit;
use looproot_algebra::ring::Ring;

/// The relative position of three places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// No two in one row or column: the squares of the four quaternion parameters are linear in the elements.
    Scattered,
    /// One shares its row with the second and its column with the third.
    Corner,
    /// Two in one row (or column), the third beside both.
    Pair,
    /// Three in one row or column.
    Line,
}

/// Three places with their values, brought to the standard form of their pattern.
///
/// Standard places are the diagonal; (1,1), (1,2), (2,1); (1,1), (1,2), (3,3).
#[derive(Clone, Debug, PartialEq)]
pub struct Elements<R> {
    /// The pattern of the places.
    pub pattern: Pattern,
    /// The values in the standard form.
    pub values: [R; 3],
    transposed: bool,
    rows: [usize; 3],
    columns: [usize; 3],
}

/// Returns whether a permutation of three is odd.
fn is_odd(p: [usize; 3]) -> bool {
    (p[0] > p[1]) ^ (p[0] > p[2]) ^ (p[1] > p[2])
}

/// Returns the index that differs from two others.
fn third(i: usize, j: usize) -> usize {
    3 - i - j
}

impl<R: Ring> Elements<R> {
    /// Takes three different places, rows and columns counted from 0, with their values; `None` if two places are the same or one
    /// is invalid.
    #[must_use]
    pub fn of(places: [(usize, usize); 3], values: [R; 3]) -> Option<Self> {
        let distinct = places[0] != places[1] && places[0] != places[2] && places[1] != places[2];
        if !distinct || places.iter().any(|(i, j)| *i > 2 || *j > 2) {
            return None;
        }
        let share = |of: fn(&(usize, usize)) -> usize| {
            [(0, 1, 2), (0, 2, 1), (1, 2, 0)].into_iter().find(|(a, b, _)| of(&places[*a]) == of(&places[*b]))
        };
        let (row, column) = (share(|p| p.0), share(|p| p.1));
        let (transposed, pair) = match (row, column) {
            (Some(pair), _) => (false, Some(pair)),
            (None, Some(pair)) => (true, Some(pair)),
            (None, None) => (false, None),
        };
        let at = |k: usize| if transposed { (places[k].1, places[k].0) } else { places[k] };
        let Some((a, b, c)) = pair else {
            let columns = [0, 1, 2].map(|row| places.iter().find(|p| p.0 == row).map_or(0, |p| p.1));
            let values = [0, 1, 2].map(|row| values[places.iter().position(|p| p.0 == row).unwrap_or(0)].clone());
            return Some(Self::standard(Pattern::Scattered, values, false, [0, 1, 2], columns));
        };
        let ((own, first), (_, second), (other, last)) = (at(a), at(b), at(c));
        if other == own {
            return Some(Self::standard(Pattern::Line, values, transposed, [0, 1, 2], [0, 1, 2]));
        }
        if last == first || last == second {
            let (head, tail, h, t) = if last == first { (first, second, a, b) } else { (second, first, b, a) };
            let (rows, columns) = ([own, other, third(own, other)], [head, tail, third(head, tail)]);
            let values = [values[h].clone(), values[t].clone(), values[c].clone()];
            return Some(Self::standard(Pattern::Corner, values, transposed, rows, columns));
        }
        let (rows, columns) = ([own, third(own, other), other], [first, second, last]);
        let values = [values[a].clone(), values[b].clone(), values[c].clone()];
        Some(Self::standard(Pattern::Pair, values, transposed, rows, columns))
    }

    /// An odd permutation of rows and columns changes the sign of the determinant, and so do three changed signs.
    fn standard(pattern: Pattern, values: [R; 3], transposed: bool, rows: [usize; 3], columns: [usize; 3]) -> Self {
        let flip = is_odd(rows) != is_odd(columns);
        let values = if flip { values.map(|v| v.neg()) } else { values };
        Self { pattern, values, transposed, rows, columns }
    }

    /// Returns the same places over another ring; `None` if a value has no image.
    pub fn map<S>(&self, image: impl Fn(&R) -> Option<S>) -> Option<Elements<S>> {
        let [a, b, c] = &self.values;
        let values = [image(a)?, image(b)?, image(c)?];
        let Self { pattern, transposed, rows, columns, .. } = *self;
        Some(Elements { pattern, values, transposed, rows, columns })
    }

    /// Returns the squares of the unknown roots: four times those of the quaternion parameters if the places are scattered,
    /// else those of the two elements that complete a row and a column. Empty for three in a line.
    #[must_use]
    pub fn squares(&self) -> Vec<R> {
        let [a, b, c] = &self.values;
        let one = R::one();
        let rest = |x: &R, y: &R| one.sub(&x.mul(x)).sub(&y.mul(y));
        match self.pattern {
            Pattern::Scattered => vec![
                one.add(a).add(b).add(c),
                one.add(a).sub(b).sub(c),
                one.sub(a).add(b).sub(c),
                one.sub(a).sub(b).add(c),
            ],
            Pattern::Corner => vec![rest(a, b), rest(a, c)],
            Pattern::Pair => vec![rest(a, b), a.mul(a).add(&b.mul(b)).sub(&c.mul(c))],
            Pattern::Line => Vec::new(),
        }
    }

    /// Returns a divisor that must not vanish for the roots to determine the matrix; 1 if they always do.
    #[must_use]
    pub fn divisor(&self) -> R {
        let [a, b, _] = &self.values;
        match self.pattern {
            Pattern::Corner => R::one().sub(&a.mul(a)),
            Pattern::Pair => a.mul(a).add(&b.mul(b)),
            Pattern::Scattered | Pattern::Line => R::one(),
        }
    }
}

impl<R: Unit> Elements<R> {
    /// Returns the matrix that belongs to signed roots of [`Elements::squares`]; `None` if they do not determine one.
    ///
    /// # Example
    /// ```
    /// use looproot_calculus::rotation::elements::Elements;
    /// let elements = Elements::of([(0, 1), (1, 2), (2, 0)], [-14.0 / 15.0, -11.0 / 15.0, 2.0 / 3.0]).unwrap();
    /// let roots: Vec<f64> = elements.squares().iter().map(|s| s.sqrt()).collect();
    /// let a = elements.matrix(&roots).unwrap();
    /// assert!((a[0][1] + 14.0 / 15.0).abs() < 1e-15 && (a[2][0] - 2.0 / 3.0).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn matrix(&self, roots: &[R]) -> Option<Matrix<R>> {
        let [a, b, c] = &self.values;
        let standard = match (self.pattern, roots) {
            (Pattern::Scattered, [w, x, y, z]) => {
                matrix(&Quaternion { scalar: w.clone(), vector: [x.clone(), y.clone(), z.clone()] })?
            }
            (Pattern::Corner, [u, v]) => {
                let inverse = self.divisor().reciprocal()?;
                let side = a.mul(c).neg();
                let x = side.mul(b).sub(&u.mul(v)).mul(&inverse);
                let y = side.mul(u).add(&b.mul(v)).mul(&inverse);
                completed([a.clone(), b.clone(), u.clone()], [c.clone(), x, y])
            }
            (Pattern::Pair, [u, v]) => {
                let inverse = self.divisor().reciprocal()?;
                let side = u.mul(v).neg();
                let p = a.mul(&side).sub(&b.mul(c)).mul(&inverse);
                let q = b.mul(&side).add(&a.mul(c)).mul(&inverse);
                completed([a.clone(), b.clone(), u.clone()], [p, q, v.clone()])
            }
            _ => return None,
        };
        let flip = is_odd(self.rows) != is_odd(self.columns);
        let mut found = standard.clone();
        for (i, row) in standard.into_iter().enumerate() {
            for (j, entry) in row.into_iter().enumerate() {
                found[self.rows[i]][self.columns[j]] = if flip { entry.neg() } else { entry };
            }
        }
        Some(if self.transposed { transpose(&found) } else { found })
    }
}

/// Returns the matrix with these first rows.
fn completed<R: Ring>(first: [R; 3], second: [R; 3]) -> Matrix<R> {
    let last = cross(&first, &second);
    [first, second, last]
}
