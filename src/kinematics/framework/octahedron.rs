//! The mobility of an octahedron of bars, decided exactly from its twelve lengths.
//!
//! Let C, C' be opposite vertices and `s = |CC'|^2`. Seen along CC', the other four vertices A, B, A', B' are the corners of a
//! closed ring of dihedral angles: the angles (A,B), (B,A'), (A',B'), (B',A) about the line CC' add up to a multiple of a full
//! turn. With `w = C' - C` and
//!
//! `g(P,Q) = s (P-C).(Q-C) - ((P-C).w) ((Q-C).w)`, a polynomial of degree 2 in s for every bar PQ and for P = Q,
//!
//! the cosine of the angle (P,Q) is `g(P,Q) / sqrt(g(P,P) g(Q,Q))`, and the square of its sine `D(P,Q) / (g(P,P) g(Q,Q))` with
//! `D = g(P,P) g(Q,Q) - g(P,Q)^2`. The cosine of (A,B) + (B,A') equals that of (A',B') + (B',A): free of denominators
//!
//! `X = e1 U - e2 V`, `X = g(B',B') g(A,B) g(B,A') - g(B,B) g(A',B') g(B',A)`,
//! `U^2 = g(B',B')^2 D(A,B) D(B,A')`, `V^2 = g(B,B)^2 D(A',B') D(B',A)`,
//!
//! with signs e1, e2 = 1 or -1: necessary, and sufficient with one choice of the orientation of the angles. The product over
//! the signs is the polynomial `N(s) = (X^2 + V^2 - U^2)^2 - 4 X^2 V^2`. If N is not zero, the diagonal has finitely many lengths. If
//! that is so for all three diagonals, the octahedron is rigid. If N vanishes identically, so does one of its four
//! factors, and a ring that closes with its signs at one s closes for all s near: the octahedron moves. Lengths enter by their squares only.

use super::Framework;
use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::kinematics::motion::{Vector, cross, dot};
use rug::Rational;

/// Largest distance, as a share, of realisations in f64 from exact ones, with a wide margin.
const NEAR: (u32, u32) = (1, 100_000_000);
/// Least difference of numbers that must differ: far above rounding.
const DISTINCT: f64 = 1e-6;

type Poly = Univariate<Rational>;

/// The twelve squared lengths of an octahedron, by its vertices; opposite vertices are `k` and `k + 3`.
#[derive(Clone, Debug)]
pub struct Octahedron {
    /// The vertices of the framework in the order A, B, C, A', B', C'.
    pub vertices: [usize; 6],
    /// The square of the distance of two neighbours.
    squares: [[Rational; 6]; 6],
}

/// The verdict on one diagonal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Diagonal {
    /// Its length changes in a real motion: proved.
    Moves,
    /// It has finitely many lengths: proved.
    Fixed,
    /// A condition holds identically, but not on the side of the realisation, or it degenerates there.
    Undecided,
}

impl Octahedron {
    /// The octahedron that the bars of a framework form, if they do.
    #[must_use]
    pub fn of(framework: &Framework<f64>, squares: &[Rational]) -> Option<Self> {
        if framework.free.len() != 6 || framework.vertices.len() != 6 || framework.bars.len() != 12 {
            return None;
        }
        let bar = |a: usize, b: usize| framework.bars.iter().position(|bar| *bar == [a.min(b), a.max(b)]);
        let opposite = |a: usize| {
            let mut others = (0..6).filter(|&b| b != a && bar(a, b).is_none());
            others.next().filter(|_| others.next().is_none())
        };
        let mut first = Vec::new();
        for a in 0..6 {
            if opposite(a)? > a {
                first.push(a);
            }
        }
        let &[a, b, c] = first.as_slice() else { return None };
        let vertices = [a, b, c, opposite(a)?, opposite(b)?, opposite(c)?];
        Some(Self::with(vertices, |i, j| bar(i, j).map_or_else(Rational::new, |k| squares[k].clone())))
    }

    /// The octahedron of these vertices, in the order A, B, C, A', B', C', with the squared distances of neighbours.
    #[must_use]
    pub fn with(vertices: [usize; 6], square: impl Fn(usize, usize) -> Rational) -> Self {
        let entry =
            |i: usize, j: usize| if i % 3 == j % 3 { Rational::new() } else { square(vertices[i], vertices[j]) };
        Self { vertices, squares: std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))) }
    }

    /// The closure of the ring about the diagonal of `axis` and `axis + 3`, a polynomial in the square of its length that vanishes
    /// at all realisations.
    ///
    /// # Panics
    /// When the axis is not 0, 1 or 2.
    #[must_use]
    pub fn closure(&self, axis: usize) -> Univariate<Rational> {
        Condition::of(self, axis).norm()
    }

    /// Whether the diagonal of `axis` and `axis + 3` changes in a motion of this realisation.
    ///
    /// # Panics
    /// When the axis is not 0, 1 or 2.
    #[must_use]
    pub fn diagonal(&self, axis: usize, realisation: &Framework<f64>) -> Diagonal {
        let condition = Condition::of(self, axis);
        if !condition.norm().is_zero() {
            return Diagonal::Fixed;
        }
        let [c, opposite] = [axis, axis + 3].map(|k| &realisation.vertices[self.vertices[k]]);
        let from_c = |p: &Vector<f64>| -> Vector<f64> { std::array::from_fn(|k| p[k] - c[k]) };
        let (along, ring) = (from_c(opposite), ring(axis).map(|p| from_c(&realisation.vertices[self.vertices[p]])));
        let turns: [f64; 4] = std::array::from_fn(|k| dot(&along, &cross(&ring[k], &ring[(k + 1) % 4])));
        let square = Rational::from_f64(dot(&along, &along)).unwrap_or_default();
        let moves = condition.closes_near(&square, turns[0] * turns[1] > 0.0, turns[2] * turns[3] > 0.0);
        if moves { Diagonal::Moves } else { Diagonal::Undecided }
    }
}

/// The four vertices around a diagonal, A, B, A', B'.
fn ring(axis: usize) -> [usize; 4] {
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    [a, b, a + 3, b + 3]
}

/// The closure of the ring about one diagonal.
struct Condition {
    /// `g(P,P)` of A, B, A', B'.
    own: [Poly; 4],
    /// `D(P,Q)` of the neighbours A B, B A', A' B', B' A.
    sines: [Poly; 4],
    /// `g(P,Q)` of the same neighbours.
    mixed: [Poly; 4],
    x: Poly,
}

impl Condition {
    fn of(octahedron: &Octahedron, axis: usize) -> Self {
        let (c, opposite) = (axis, axis + 3);
        let ring = ring(axis);
        let square = |i: usize, j: usize| &octahedron.squares[i][j];
        let half = Rational::from((1, 2));
        // (P - C).w = (|CP|^2 + s - |C'P|^2) / 2
        let along =
            |p: usize| Poly::new(vec![Rational::from(square(c, p) - square(opposite, p)) * &half, half.clone()]);
        let g = |p: usize, q: usize| {
            let inner = if p == q {
                square(c, p).clone()
            } else {
                (Rational::from(square(c, p) + square(c, q)) - square(p, q)) * &half
            };
            Poly::new(vec![Rational::new(), inner]).sub(&along(p).mul(&along(q)))
        };
        let own = ring.map(|p| g(p, p));
        let mixed: [Poly; 4] = std::array::from_fn(|k| g(ring[k], ring[(k + 1) % 4]));
        let sines = std::array::from_fn(|k| own[k].mul(&own[(k + 1) % 4]).sub(&mixed[k].mul(&mixed[k])));
        let x = own[3].mul(&mixed[0]).mul(&mixed[1]).sub(&own[1].mul(&mixed[2]).mul(&mixed[3]));
        Self { own, sines, mixed, x }
    }

    fn u_squared(&self) -> Poly {
        self.own[3].mul(&self.own[3]).mul(&self.sines[0]).mul(&self.sines[1])
    }

    fn v_squared(&self) -> Poly {
        self.own[1].mul(&self.own[1]).mul(&self.sines[2]).mul(&self.sines[3])
    }

    fn norm(&self) -> Poly {
        let (x, v) = (self.x.mul(&self.x), self.v_squared());
        let sum = x.add(&v).sub(&self.u_squared());
        sum.mul(&sum).sub(&x.mul(&v).scale(&Rational::from(4)))
    }

    /// Whether the ring stays closed near this s, where it is closed with angles whose products of sines have these signs (true
    /// is positive). The norm must be zero.
    ///
    /// Where all g and D are positive, U and V are positive analytic functions of s. If X is zero, `U^2 = V^2` and U = V. Else let
    /// `W = (X^2 + V^2 - U^2) / 2X`: then `V^2 = W^2` and `U^2 = (X - W)^2` by the norm, and `X = (X - W) + W` is the one combination
    /// of signs for which the condition is an identity; signs of X - W and W at s name it.
    fn closes_near(&self, s: &Rational, first: bool, second: bool) -> bool {
        let positive = |p: &Poly| is_positive_near(p, s);
        if *s <= 0 || !self.own.iter().chain(&self.sines).all(positive) {
            return false;
        }
        let is_identity = if self.x.is_zero() {
            self.u_squared() == self.v_squared() && first == second
        } else {
            let x = self.x.eval(s);
            if x == 0 {
                return false;
            }
            let w = (Rational::from(&x * &x) + self.v_squared().eval(s) - self.u_squared().eval(s))
                / (Rational::from(&x * 2));
            first == (Rational::from(&x - &w) > 0) && second == (w < 0)
        };
        if !is_identity {
            return false;
        }
        let value = |p: &Poly| nearest_f64(&p.eval(s));
        let sign = if first { 1.0 } else { -1.0 };
        // The cosine of (A,B) + (B,A') must not be 1 or -1: there equal cosines do not tell an angle from its opposite.
        let product = value(&self.mixed[0]) * value(&self.mixed[1]);
        let cosine = product - sign * (value(&self.sines[0]) * value(&self.sines[1])).sqrt();
        let whole = value(&self.own[0]) * value(&self.own[2]) * value(&self.own[1]).powi(2);
        cosine * cosine < (1.0 - DISTINCT) * whole
    }
}

/// Whether a polynomial is positive wherever the argument is within a share [`NEAR`] of s: its constant Taylor coefficient there
/// exceeds all others together.
fn is_positive_near(p: &Poly, s: &Rational) -> bool {
    let distance = s * Rational::from(NEAR);
    let shifted = Poly::new(vec![s.clone(), Rational::from(1)]);
    let taylor =
        p.coefficients().iter().rev().fold(Poly::zero(), |sum, c| sum.mul(&shifted).add(&Poly::constant(c.clone())));
    let Some((constant, others)) = taylor.coefficients().split_first() else { return false };
    let mut power = Rational::from(1);
    let mut rest = Rational::new();
    for c in others {
        power *= &distance;
        rest += Rational::from(c * &power).abs();
    }
    *constant > rest
}
