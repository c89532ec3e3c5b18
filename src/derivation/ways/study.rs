//! Study's parameters: both sides of the loop as dual quaternions that are linear in tensor products of half-angle pairs.
//!
//! Three unknowns `c, d, e` of one side make eight products w, and their dual quaternion is `R w` with a constant matrix R of size 8.
//! The other side, with the unknown x that is kept, is `L(x) v` with the four products v of `a, b`. So `w = R^-1 L(x) v`, and w is a
//! tensor product if and only if the minors of its flattenings vanish. These are nine independent quadrics, one of which, Study's
//! condition, also holds on the other side. Eight equations of degree 2 in a, b and x remain.

use super::matrix::PolynomialMatrix;
use super::{Found, Matrix, Way, refusal};
use crate::algebra::echelon::Echelon;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::derivation::Equation;
use crate::derivation::chain::{Exact, Mod};
use crate::derivation::symbols::Symbols;
use crate::error::Result;
use crate::exact::Linkage;
use crate::exact::cut::side;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::Motion;
use rug::Rational;

/// A quadric in `(1, a, b, a b)`: the coefficient of `a^i b^j` at `[i][j]`, by powers of x.
type Quadric = [[Univariate<Rational>; 3]; 3];
/// Mixtures of the equations; the common factor of both determinants is the eliminant.
const MIXTURES: [i32; 2] = [7919, 104_729];

/// A distribution of the unknowns over two sides: the first three in loop order, with the position of the kept one among them.
struct Split {
    first: usize,
    hidden: usize,
}

/// Returns the matrix that keeps an unknown.
pub(super) fn found(exact: &Exact, unknown: usize) -> Result<Found> {
    let splits = (0..3).map(|hidden| Split { first: (unknown + 6 - hidden) % 6, hidden });
    let found = splits.into_iter().find_map(|split| {
        let quadrics = split.quadrics(exact)?;
        let matrix = PolynomialMatrix::of(&dialytic(&quadrics));
        let minors = [false, true].map(|is_last| matrix.independent(is_last));
        let [Some(one), Some(two)] = minors else { return None };
        let eliminants = [one.mixed(MIXTURES[0]), two.mixed(MIXTURES[1])].map(|matrix| {
            let determinant = matrix.determinant();
            if exact.closed.variables[unknown] == Variable::Translation { halved(&determinant) } else { determinant }
        });
        eliminants.iter().all(|p| p.degree().is_some()).then_some((split, quadrics, one, eliminants))
    });
    let Some((split, quadrics, matrix, eliminants)) = found else {
        let why = "wherever the loop is cut, three unknowns of one side have dependent products";
        return Err(refusal(Way::Study, why));
    };
    let name = |place: usize| exact.symbols.name((split.first + place) % 6);
    let rank = matrix.columns();
    let [a, b] = split.others();
    let steps = vec![
        format!(
            "The loop is cut into the sides of {}, {}, {} and of {}, {}, {}. As a dual quaternion a rotation about z is 1 + t k, a translation 1 + \
             (d/2) eps k: either side is linear in the products of its pairs (1, t).",
            name(0),
            name(1),
            name(2),
            name(3),
            name(4),
            name(5)
        ),
        format!(
            "The eight products w of the second side are R^-1 L v: R is a constant 8 x 8 matrix of rank 8, L an 8 x 4 matrix of degree 1 in {}, v = \
             (1, {a}, {b}, {a} {b}).",
            name(split.hidden),
            a = name(a),
            b = name(b)
        ),
        format!(
            "w is a product of three pairs exactly where the 2 x 2 minors of its flattenings vanish, nine independent quadrics. Study's condition is \
             one of them and holds on the first side for itself: {} equations of degree 2 in {}, {} and {}.",
            quadrics.len(),
            name(a),
            name(b),
            name(split.hidden)
        ),
        format!(
            "Times 1 and {a}, they are {} linear equations of rank {rank} in the 12 products of (1, {a}, {a}^2, {a}^3) and (1, {b}, {b}^2); two mixtures of \
             them, in {rank} independent products, are {rank} x {rank} matrices of degree 2 in {}, and the eliminant is what their determinants have in \
             common.",
            2 * quadrics.len(),
            name(split.hidden),
            a = name(a),
            b = name(b)
        ),
    ];
    let meaning = format!(
        "{2} quadrics times 1 and {0}, mixed to {rank}, over products of powers of {0} and {1}",
        name(a),
        name(b),
        quadrics.len()
    );
    let size = Matrix { rows: rank, columns: rank, entries: matrix.degree(), meaning };
    Ok(Found { equations: split.listed(exact, &quadrics), steps, matrix: size, eliminants: eliminants.to_vec() })
}

/// Returns `p(x/2)`: a translation by d is 1 + (d/2) eps k.
fn halved(p: &Univariate<Rational>) -> Univariate<Rational> {
    let scaled = p.coefficients().iter().zip(0_u32..).map(|(c, k)| Rational::from(c >> k));
    Univariate::new(scaled.collect())
}

impl Split {
    /// Returns the positions of the two eliminated unknowns of the first side.
    fn others(&self) -> [usize; 2] {
        [[1, 2], [0, 2], [0, 1]][self.hidden]
    }

    /// Returns eight independent quadrics; `None` if the products of the second side are dependent.
    fn quadrics(&self, exact: &Exact) -> Option<Vec<Quadric>> {
        let linkage = linkage(&exact.closed)?;
        let order: Vec<usize> = (0..6).map(|k| (self.first + k) % 6).collect();
        let (left, right) = order.split_at(3);
        let conjugate = |mut column: [Rational; 8]| {
            for i in [1, 2, 3, 5, 6, 7] {
                column[i] = Rational::from(-&column[i]);
            }
            column
        };
        let columns: Vec<[Rational; 8]> = (0..8).map(|bits| conjugate(side(&linkage, right, bits))).collect();
        let inverse = inverse(&columns)?;
        // w over (1, a, b, a b), by powers of x.
        let product = |choice: usize| -> Vec<Rational> {
            let column = side(&linkage, left, choice);
            inverse
                .iter()
                .map(|row| row.iter().zip(&column).fold(Rational::new(), |sum, (x, y)| sum + Rational::from(x * y)))
                .collect()
        };
        let form = |bits: usize| {
            let low = bits & ((1 << self.hidden) - 1);
            let without = (bits - low) << 1 | low;
            [product(without), product(without | 1 << self.hidden)]
        };
        let forms: Vec<[Vec<Rational>; 2]> = (0..4).map(form).collect();
        let coordinate = |i: usize| -> [Univariate<Rational>; 4] {
            std::array::from_fn(|bits| Univariate::new(vec![forms[bits][0][i].clone(), forms[bits][1][i].clone()]))
        };
        let w: Vec<[Univariate<Rational>; 4]> = (0..8).map(coordinate).collect();
        let all: Vec<Quadric> =
            minors().into_iter().map(|[i, j, k, l]| quadric([&w[i], &w[j]], [&w[k], &w[l]])).collect();
        Some(independent(all))
    }

    fn listed(&self, exact: &Exact, quadrics: &[Quadric]) -> Vec<Equation> {
        let variable = |place: usize| Symbols::variable((self.first + place) % 6);
        let is_translation = |place: usize| exact.closed.variables[(self.first + place) % 6] == Variable::Translation;
        let [a, b] = self.others();
        let places = [a, b, self.hidden];
        quadrics
            .iter()
            .zip(1..)
            .map(|(quadric, number)| {
                let terms = (0..3).flat_map(|i| (0..3).map(move |j| (i, j))).flat_map(|(i, j)| {
                    let coefficients = quadric[i][j].coefficients().iter().enumerate();
                    coefficients.map(move |(k, c)| ([i, j, k], c.clone())).collect::<Vec<_>>()
                });
                let terms = terms.map(|(powers, mut c)| {
                    let mut exponents = vec![0; 18];
                    for (place, power) in places.into_iter().zip(powers) {
                        exponents[variable(place)] = u32::try_from(power).unwrap_or(0);
                        // A translation by d is 1 + (d/2) eps k.
                        if is_translation(place) {
                            c >>= u32::try_from(power).unwrap_or(0);
                        }
                    }
                    (exponents, c)
                });
                Equation::used(format!("tensor product, quadric {number}"), &Polynomial::from_terms(terms))
            })
            .collect()
    }
}

/// Returns the loop as joint variables with a link behind each.
fn linkage(closed: &ClosedLoop<Rational>) -> Option<Linkage<Rational>> {
    let motions = std::iter::once(Motion::identity()).chain(closed.constants.iter().cloned()).collect();
    Linkage::of_motions(closed.variables.to_vec(), motions)
}

/// Returns the rows of the inverse of the matrix with these columns.
fn inverse(columns: &[[Rational; 8]]) -> Option<Vec<Vec<Rational>>> {
    let mut rows: Vec<Vec<Rational>> = (0..8)
        .map(|i| {
            let unit = (0..8).map(|k| Rational::from(i32::from(i == k)));
            columns.iter().map(|column| column[i].clone()).chain(unit).collect()
        })
        .collect();
    for k in 0..8 {
        let pivot = (k..8).find(|i| !rows[*i][k].is_zero())?;
        rows.swap(k, pivot);
        let scale = rows[k][k].clone().recip();
        rows[k].iter_mut().for_each(|x| *x *= &scale);
        let own = rows[k].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = row[k].clone();
            if !factor.is_zero() {
                row.iter_mut().zip(&own).for_each(|(x, y)| *x -= Rational::from(&factor * y));
            }
        }
    }
    Some(rows.into_iter().map(|row| row[8..].to_vec()).collect())
}

/// Returns the 2 x 2 minors `w_i w_j - w_k w_l` of the flattenings of a 2 x 2 x 2 tensor, with indices read as three bits.
fn minors() -> Vec<[usize; 4]> {
    let pairs: Vec<[usize; 2]> = (0..8).flat_map(|i| (i + 1..8).map(move |j| [i, j])).collect();
    let is_same = |p: &[usize; 2], q: &[usize; 2]| p[0] & p[1] == q[0] & q[1] && p[0] | p[1] == q[0] | q[1];
    let mut found = Vec::new();
    for (n, p) in pairs.iter().enumerate() {
        for q in pairs[n + 1..].iter().filter(|q| is_same(p, q)) {
            found.push([p[0], p[1], q[0], q[1]]);
        }
    }
    found
}

/// Returns `p q - r s` of forms in `(1, a, b, a b)`.
fn quadric(one: [&[Univariate<Rational>; 4]; 2], other: [&[Univariate<Rational>; 4]; 2]) -> Quadric {
    let mut sum: Quadric = std::array::from_fn(|_| std::array::from_fn(|_| Univariate::zero()));
    for (pair, is_first) in [(one, true), (other, false)] {
        for (s, x) in pair[0].iter().enumerate() {
            for (t, y) in pair[1].iter().enumerate() {
                let entry = &mut sum[(s & 1) + (t & 1)][(s >> 1) + (t >> 1)];
                let term = x.mul(y);
                *entry = if is_first { entry.add(&term) } else { entry.sub(&term) };
            }
        }
    }
    sum
}

/// Returns the quadrics that are no combination of earlier ones, for a value of x.
fn independent(all: Vec<Quadric>) -> Vec<Quadric> {
    // Any element of the field that is unlikely to be special.
    let x = Mod::from_integer(1_234_567);
    let at = |quadric: &Quadric| -> Option<Vec<Mod>> {
        quadric.iter().flatten().map(|p| Some(p.map(Mod::from_rational)?.eval(&x))).collect()
    };
    let mut kept: Vec<Quadric> = Vec::new();
    let mut rows: Vec<Vec<Mod>> = Vec::new();
    for quadric in all {
        let Some(row) = at(&quadric) else { continue };
        rows.push(row);
        if Echelon::of(rows.clone(), 9).rank() == rows.len() {
            kept.push(quadric);
        } else {
            rows.pop();
        }
    }
    kept
}

/// Returns the quadrics times 1 and a, over `a^i b^j` with i up to 3 and j up to 2.
fn dialytic(quadrics: &[Quadric]) -> Vec<Vec<Univariate<Rational>>> {
    let row = |quadric: &Quadric, shift: usize| {
        let mut line = vec![Univariate::zero(); 12];
        for (i, by_b) in quadric.iter().enumerate() {
            for (j, c) in by_b.iter().enumerate() {
                line[3 * (i + shift) + j] = c.clone();
            }
        }
        line
    };
    quadrics.iter().flat_map(|quadric| [row(quadric, 0), row(quadric, 1)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tensor_of_pairs_has_twelve_minors_of_rank_nine() {
        assert_eq!(minors().len(), 12);
        // (1, 2) x (1, 3) x (1, 5): every minor vanishes.
        let w: Vec<i32> = (0..8).map(|k| [1, 2][k & 1] * [1, 3][k >> 1 & 1] * [1, 5][k >> 2]).collect();
        assert!(minors().iter().all(|[i, j, k, l]| w[*i] * w[*j] == w[*k] * w[*l]));
    }
}
