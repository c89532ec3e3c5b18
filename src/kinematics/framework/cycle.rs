//! Two octahedra and a bar about one edge, such as Steffen's polyhedron: a proof that they do not move, from their lengths alone.
//!
//! Three vertices x, y, z are joined to p and to q, which are not joined; a bar joins y and z, and two octahedra have the edge pq and
//! the diagonals xy and xz. Let `s = |pq|^2`, `a = |xy|^2` and `b = |xz|^2`. Every realisation is a common zero of the closures
//! `N1(s, a)` and `N2(s, b)` of the rings about both diagonals and of the Cayley-Menger determinant `G(s, a, b)` of p, q, x, y and z.
//!
//! - If for one s no zeros a of N1 and b of N2 are one of G, their resultant is not zero, and s takes finitely many values. Modulo a
//!   prime that can be seen too: the coefficients of `a^2` and `b^2` in G are those of the triangles pqz and pqy, and free of a and b,
//!   so that no zero is at infinity.
//! - If the coefficients of N1 by the powers of a and of N2 by the powers of b have no common zero s, one of a and b takes finitely many
//!   values at each s, and by G both do.
//! - Then p, q, x, y and z are fixed to each other. An inner vertex is joined to three vertices, of an octahedron about xy to x, y and
//!   one of p and q, and moves only if these are in line, say with q; then the other inner vertex, which is joined to p, is in that line,
//!   or p is. Lengths seldom allow four points in line, and hardly the distances of a fifth one from three of them.

use super::Framework;
use super::octahedron::Octahedron;
use crate::algebra::determinant::determinant;
use crate::algebra::drawn::Drawn;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use rug::Rational;

/// The field of the proofs: what is not 0 there is not 0 over the rationals.
type Mod = Drawn;

/// The degree of the closure of a ring in the square of a length between neighbours in the ring.
const DEGREE: usize = 4;
/// Squares of the held length: any would do, few are unlucky.
const SQUARES: [i32; DEGREE + 1] = [1009, 1013, 1019, 1021, 1031];

/// The framework by its vertices.
struct Cycle {
    /// p and q.
    edge: [usize; 2],
    /// x, y and z.
    wings: [usize; 3],
    /// For the octahedra about xy and about xz: the inner vertex joined to q, and the one joined to p.
    inner: [[usize; 2]; 2],
}

/// Returns whether a framework consists of two octahedra and a bar about an edge and is proved not to move, in any realisation
/// with these squared lengths of its bars and whether or not it has one.
///
/// # Shape
/// A square for every bar.
#[must_use]
pub fn stands_still<R: Ring>(framework: &Framework<R>, squares: &[Rational]) -> bool {
    let bar = |a: usize, b: usize| framework.bars.iter().position(|bar| *bar == [a.min(b), a.max(b)]);
    let square = |a: usize, b: usize| bar(a, b).map_or_else(Rational::new, |k| squares[k].clone());
    let cycle = Cycle::of(framework.vertices.len(), |a, b| bar(a, b).is_some()).filter(|_| framework.bodies == 0);
    cycle.and_then(|cycle| cycle.is_fixed(square)).unwrap_or(false)
}

impl Cycle {
    /// Returns the cycle that the bars between `count` vertices form. Further bars only hold it.
    fn of(count: usize, joined: impl Fn(usize, usize) -> bool) -> Option<Self> {
        if count != 9 {
            return None;
        }
        let about = |p: usize, q: usize| {
            let wings: Vec<usize> = (0..count).filter(|&x| joined(p, x) && joined(q, x)).collect();
            let &[i, j, k] = wings.as_slice() else { return None };
            let apart = |x: usize, y: usize, z: usize| joined(y, z) && !joined(x, y) && !joined(x, z);
            let wings = [[i, j, k], [j, k, i], [k, i, j]].into_iter().find(|&[x, y, z]| apart(x, y, z))?;
            let others: Vec<usize> = (0..count).filter(|v| ![p, q].contains(v) && !wings.contains(v)).collect();
            let inner = |y: usize| {
                let between = |v: usize| joined(v, wings[0]) && joined(v, y);
                let pairs = others.iter().flat_map(|&u| others.iter().map(move |&v| [u, v]));
                pairs
                    .into_iter()
                    .find(|&[u, v]| u != v && between(u) && between(v) && joined(u, v) && joined(u, q) && joined(v, p))
            };
            let inner = [inner(wings[1])?, inner(wings[2])?];
            let is_everything = others.iter().all(|v| inner.as_flattened().contains(v));
            is_everything.then_some(Self { edge: [p, q], wings, inner })
        };
        let pairs = (0..count).flat_map(|q| (0..q).map(move |p| (p, q)));
        pairs.filter(|&(p, q)| !joined(p, q)).find_map(|(p, q)| about(p, q))
    }

    /// Returns whether a proof shows that nothing moves; `None` for an unlucky prime.
    fn is_fixed(&self, square: impl Fn(usize, usize) -> Rational) -> Option<bool> {
        let ([p, q], [x, y, z]) = (self.edge, self.wings);
        let images = |side: usize| -> Option<Vec<Univariate<Mod>>> {
            let ([u, v], end) = (self.inner[side], self.wings[side + 1]);
            let closure = |s: i32| {
                let length = |a: usize, b: usize| {
                    if [a, b] == [p, q] || [a, b] == [q, p] { Rational::from(s) } else { square(a, b) }
                };
                Octahedron::with([p, q, x, u, v, end], length).closure(2).map(Mod::from_rational)
            };
            SQUARES.into_iter().map(closure).collect()
        };
        let sides = [images(0)?, images(1)?];
        let known = |a: usize, b: usize| Mod::from_rational(&square(a, b));
        let distances = Distances {
            s: Mod::from_integer(SQUARES[0]),
            from_p: [known(p, x)?, known(p, y)?, known(p, z)?],
            from_q: [known(q, x)?, known(q, y)?, known(q, z)?],
            between: known(y, z)?,
        };
        let content = |points: &[usize], unknown: [usize; 2]| cayley_menger(points, unknown, &square);
        let triangle = |end: usize| content(&[p, q, end], [p, q]).map(Mod::from_rational);
        let is_still = are_free_of_families([&sides[0], &sides[1]], [&triangle(z)?, &triangle(y)?]);
        let is_held = (0..2).all(|side| {
            let ([u, v], [end, other]) = (self.inner[side], if side == 0 { [y, z] } else { [z, y] });
            let line = |by: usize| content(&[x, by, end], [x, end]);
            // u turns about x, q and y, or v about x, p and y.
            let alone = [(q, v, p), (p, u, q)].into_iter().all(|(third, inner, outside)| {
                are_apart(&[line(third), line(inner), content(&[x, end, inner, outside], [x, end])])
            });
            let in_one_line = [content(&[p, q, x], [p, q]), content(&[p, q, end], [p, q])];
            let [one, two] = in_one_line;
            let both = are_apart(&[line(q), line(p)]) || are_apart(&[one, two, content(&[p, q, end, other], [p, q])]);
            alone && both
        });
        Some(is_still && is_held && distances.exclude(&sides[0][0], &sides[1][0]))
    }
}

/// Returns the Cayley-Menger determinant of some points as a polynomial in the square of one distance.
fn cayley_menger(
    points: &[usize],
    unknown: [usize; 2],
    square: impl Fn(usize, usize) -> Rational,
) -> Univariate<Rational> {
    let at = |value: i32| {
        let value = Rational::from(value);
        let entry = |i: usize, j: usize| match (i.checked_sub(1), j.checked_sub(1)) {
            _ if i == j => Rational::new(),
            (Some(i), Some(j)) if unknown == [points[i], points[j]] || unknown == [points[j], points[i]] => {
                value.clone()
            }
            (Some(i), Some(j)) => square(points[i], points[j]),
            _ => Rational::from(1),
        };
        let rows: Vec<Vec<Rational>> =
            (0..=points.len()).map(|i| (0..=points.len()).map(|j| entry(i, j)).collect()).collect();
        let determinant = determinant(&rows);
        (value, determinant)
    };
    Univariate::interpolate(&[0, 1, 2].map(at))
}

/// Returns whether polynomials have no zero in common.
fn are_apart(polynomials: &[Univariate<Rational>]) -> bool {
    let common = polynomials.iter().fold(Univariate::zero(), |common: Univariate<Rational>, other| common.gcd(other));
    common.degree() == Some(0)
}

/// Returns whether no s makes the closures of both rings vanish for all lengths of their diagonals, nor the closure of one ring where
/// the triangle that holds the other one degenerates; the closures are given for each of [`SQUARES`].
fn are_free_of_families(closures: [&[Univariate<Mod>]; 2], triangles: [&Univariate<Mod>; 2]) -> bool {
    let [first, second] = closures.map(by_powers);
    let common = |list: &[Univariate<Mod>]| {
        list.iter().fold(Univariate::zero(), |common: Univariate<Mod>, other| common.gcd(other))
    };
    let [one, two] = [common(&first), common(&second)];
    // The leading coefficient of a common divisor over the rationals divides those of all: it is not 0 modulo the prime if one of them
    // is not, as are those of triangles.
    let is_lucky = first.iter().chain(&second).any(|c| c.degree() == Some(DEGREE));
    let no_zero = |divisor: &Univariate<Mod>| divisor.degree() == Some(0);
    is_lucky && no_zero(&one.gcd(&two)) && no_zero(&one.gcd(triangles[0])) && no_zero(&two.gcd(triangles[1]))
}

/// The coefficients of a closure by the powers of the diagonal, as polynomials in s.
fn by_powers(closures: &[Univariate<Mod>]) -> Vec<Univariate<Mod>> {
    let terms = closures.iter().map(|closure| closure.coefficients().len()).max().unwrap_or(0);
    let coefficient = |k: usize| {
        let at = |(s, closure): (i32, &Univariate<Mod>)| {
            (Mod::from_integer(s), closure.coefficients().get(k).copied().unwrap_or_else(Mod::zero))
        };
        Univariate::interpolate(&SQUARES.into_iter().zip(closures).map(at).collect::<Vec<_>>())
    };
    (0..terms).map(coefficient).collect()
}

/// The squares of the distances of p, q, x, y and z that are known at one s.
struct Distances {
    s: Mod,
    /// Squared distances of p from x, y and z.
    from_p: [Mod; 3],
    /// Squared distances of q from x, y and z.
    from_q: [Mod; 3],
    /// Squared distance of y from z.
    between: Mod,
}

impl Distances {
    /// The Cayley-Menger determinant, up to a factor, at `a = |xy|^2` as a polynomial in `b = |xz|^2`.
    fn determinant(&self, a: Mod) -> Univariate<Mod> {
        let (one, zero) = (Mod::one(), Mod::zero());
        let ([px, py, pz], [qx, qy, qz]) = (self.from_p, self.from_q);
        let at = |b: Mod| {
            let rows = [
                [zero, one, one, one, one, one],
                [one, zero, self.s, px, py, pz],
                [one, self.s, zero, qx, qy, qz],
                [one, px, qx, zero, a, b],
                [one, py, qy, a, zero, self.between],
                [one, pz, qz, b, self.between, zero],
            ];
            (b, determinant(&rows))
        };
        Univariate::interpolate(&[0, 1, 2].map(|b| at(Mod::from_integer(b))))
    }

    /// Whether no zero a of one polynomial and b of another one make five points of these distances.
    fn exclude(&self, first: &Univariate<Mod>, second: &Univariate<Mod>) -> bool {
        let Some(degree) = second.degree() else { return false };
        // The product of the determinants at all zeros b of the second one, up to a factor: a polynomial in a.
        let mut values = Vec::new();
        for a in (0..).take(2 * degree + 1).map(Mod::from_integer) {
            let quadratic = self.determinant(a);
            let &[_, _, lead] = quadratic.coefficients() else { return false };
            let value = second.div_rem(&quadratic).1;
            let [c, d] = [0, 1].map(|k| value.coefficients().get(k).copied().unwrap_or_else(Mod::zero));
            let [e, f] = [0, 1].map(|k| quadratic.coefficients()[k]);
            // Both zeros r of the quadratic: the product of `c + d r` times the lead, and times as many leads as the second's degree.
            let product = c.mul(&c).mul(&lead).sub(&c.mul(&d).mul(&f)).add(&d.mul(&d).mul(&e));
            let leads = (1..degree).fold(Mod::one(), |power, _| power.mul(&lead));
            values.push((a, product.mul(&leads)));
        }
        let all = Univariate::interpolate(&values);
        all.degree() == Some(2 * degree) && first.degree().is_some() && first.gcd(&all).degree() == Some(0)
    }
}
