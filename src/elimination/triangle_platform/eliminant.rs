//! Two resultants in closed form: they reduce three circles and three sides to one equation on the first circle.

use super::circle::Triangle;
use crate::algebra::ring::{Field, Ring};
use crate::kinematics::link_form::{product, transposed};
use crate::kinematics::motion::{cross, dot};

/// A vector, point or line of the projective plane of `h = (1, alpha, beta)`.
type Three<R> = [R; 3];

/// The eliminant of a triangle for one of its corners.
///
/// With `h` on its conic `h^T G h = 0`, `G = diag(-r^2, u.u, v.v)`, and sides `h_i^T M_ij h_j = 0`: for given `h_1` the
/// point `h_2` is on the line `a = M_12^T h_1`, and `h_3` on the line `d = M_13^T h_1`.
///
/// First resultant, by `h_2`: the lines a and `M_23 h_3` meet in `a x M_23 h_3`, which is on the conic if
/// `h_3^T Q h_3 = 0` with `Q = M_23^T A M_23`, `A = [a]^T G_2 [a]`. Second, by `h_3`: the line d meets the conics `G_3` and Q
/// in a common point if
///
/// `f = m^2 - 4 (d^T adj G_3 d) (d^T adj Q d) = 0`,
///
/// with `d^T adj Q d = (a^T adj G_2 a) (d^T adj(M_23) a)^2` and the mixed term `m = trace([d]^T G_3 [d] Q)`. f is a form of
/// degree 8 in `h_1`, and meets its conic in 16 points.
#[derive(Clone, Debug)]
pub struct Eliminant<R> {
    /// `M_12^T`, `M_13^T`.
    pub lines: [[Three<R>; 3]; 2],
    /// The diagonals of `G_2`, `G_3`.
    pub conics: [Three<R>; 2],
    /// `M_23`.
    pub opposite: [Three<R>; 3],
    /// The adjugate of `M_23`.
    adjugate: [Three<R>; 3],
}

/// `matrix vector`
fn image<R: Ring>(matrix: &[Three<R>; 3], vector: &Three<R>) -> Three<R> {
    std::array::from_fn(|i| dot(&matrix[i], vector))
}

/// `[l]^T G [l]` for a diagonal G: the conic's equation for the point in which the line l meets another one.
fn on_line<R: Ring>([p, q, r]: &Three<R>, [x, y, z]: &Three<R>) -> [Three<R>; 3] {
    let (pp, qq, rr) = (p.mul(p), q.mul(q), r.mul(r));
    let pair = |a: &R, b: &R, g: &R| a.mul(b).mul(g).neg();
    let (pq, pr, qr) = (pair(p, q, z), pair(p, r, y), pair(q, r, x));
    [
        [y.mul(&rr).add(&z.mul(&qq)), pq.clone(), pr.clone()],
        [pq, x.mul(&rr).add(&z.mul(&pp)), qr.clone()],
        [pr, qr, x.mul(&qq).add(&y.mul(&pp))],
    ]
}

/// `l^T adj(G) l` for a diagonal G: zero for lines that touch the conic.
fn tangency<R: Ring>([p, q, r]: &Three<R>, [x, y, z]: &Three<R>) -> R {
    let term = |a: &R, g: &R, h: &R| a.mul(a).mul(&g.mul(h));
    term(p, y, z).add(&term(q, x, z)).add(&term(r, x, y))
}

impl<F: Field> Eliminant<F> {
    /// The eliminant for corner `first`.
    #[must_use]
    pub fn new(triangle: &Triangle<F>, first: usize) -> Self {
        let (second, third) = ((first + 1) % 3, (first + 2) % 3);
        let conic = |k: usize| {
            let circle = &triangle.circles[k];
            [circle.radius_square.neg(), circle.squares[0].clone(), circle.squares[1].clone()]
        };
        let opposite = triangle.side(second, third);
        // Row k of the cofactors is the cross product of the other two rows.
        let cofactors: [Three<F>; 3] = std::array::from_fn(|k| cross(&opposite[(k + 1) % 3], &opposite[(k + 2) % 3]));
        Self {
            lines: [transposed(&triangle.side(first, second)), transposed(&triangle.side(first, third))],
            conics: [conic(second), conic(third)],
            opposite,
            adjugate: transposed(&cofactors),
        }
    }
}

impl<R: Ring> Eliminant<R> {
    /// Maps the eliminant to a larger ring.
    pub fn map<S>(&self, image: impl Fn(&R) -> S) -> Eliminant<S> {
        let vector = |v: &Three<R>| v.each_ref().map(&image);
        let matrix = |m: &[Three<R>; 3]| m.each_ref().map(vector);
        Eliminant {
            lines: self.lines.each_ref().map(matrix),
            conics: self.conics.each_ref().map(vector),
            opposite: matrix(&self.opposite),
            adjugate: matrix(&self.adjugate),
        }
    }

    /// The lines a and d of the other two corners.
    pub fn lines_at(&self, h: &Three<R>) -> [Three<R>; 2] {
        self.lines.each_ref().map(|matrix| image(matrix, h))
    }

    /// The form f at a point `h`.
    pub fn value(&self, h: &Three<R>) -> R {
        let [one, other] = self.terms(h);
        one.sub(&other)
    }

    /// Returns the two terms whose difference is f: equal all along the circle where the triangle moves.
    pub fn terms(&self, h: &Three<R>) -> [R; 2] {
        let [a, d] = self.lines_at(h);
        let [second, third] = &self.conics;
        let (inner, outer) = (on_line(&a, second), on_line(&d, third));
        let moved = product(&product(&self.opposite, &outer), &transposed(&self.opposite));
        let mixed = (0..3).fold(R::zero(), |sum, i| sum.add(&dot(&moved[i], &inner[i])));
        let across = dot(&d, &image(&self.adjugate, &a));
        let separate = tangency(&d, third).mul(&tangency(&a, second)).mul(&across.mul(&across));
        let twice = separate.add(&separate);
        [mixed.mul(&mixed), twice.add(&twice)]
    }
}
