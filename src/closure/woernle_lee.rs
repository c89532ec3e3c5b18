//! The closure equations of a loop, made linear: the action of motions on lines with a marked point.
//!
//! For an oriented line with direction l, |l| = 1, and marked point p put
//! `v = (1, l, p, p.l, p.p, p x l, (p.p) l - 2 (p.l) p)`, 15 coordinates. A motion acts on v linearly. Under a rotation
//! about z seven coordinates are invariant and four pairs turn like (cos, sin). A loop cut at the axes of two joints
//! equates two images of the same v: the invariant coordinates are the six Woernle-Lee equations of the pair (the first
//! coordinate is trivial), the turning ones the four half-angle pairs, together the 14 equations of the general loop.
//! [LeeWoernleHiller1991, RaghavanRoth1993]

use crate::algebra::ring::Ring;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::{Motion, Vector, cross, dot};

/// Number of coordinates.
pub const SIZE: usize = 15;
/// Coordinates invariant under rotations about z; the first is the trivial one.
pub const FIXED: [usize; 7] = [0, 3, 6, 7, 8, 11, 14];
/// First coordinates of the rotating pairs.
pub const TURNING_X: [usize; 4] = [1, 4, 9, 12];
/// Second coordinates of the rotating pairs.
pub const TURNING_Y: [usize; 4] = [2, 5, 10, 13];

/// The 15 coordinates of a line with a marked point.
pub type MarkedLine<R> = [R; SIZE];

/// Returns the z axis with its origin marked.
#[must_use]
pub fn z_axis<R: Ring>() -> MarkedLine<R> {
    std::array::from_fn(|i| if i == 0 || i == 3 { R::one() } else { R::zero() })
}

fn block<R: Ring>(v: &MarkedLine<R>, at: usize) -> Vector<R> {
    std::array::from_fn(|i| v[at + i].clone())
}

fn scale<R: Ring>(v: &Vector<R>, factor: &R) -> Vector<R> {
    std::array::from_fn(|i| v[i].mul(factor))
}

fn plus<R: Ring>(v: &Vector<R>, w: &Vector<R>) -> Vector<R> {
    std::array::from_fn(|i| v[i].add(&w[i]))
}

fn twice<R: Ring>(x: &R) -> R {
    x.add(x)
}

fn join<R: Ring>(one: R, l: Vector<R>, p: Vector<R>, pl: R, pp: R, q: Vector<R>, w: Vector<R>) -> MarkedLine<R> {
    let [l0, l1, l2] = l;
    let [p0, p1, p2] = p;
    let [q0, q1, q2] = q;
    let [w0, w1, w2] = w;
    [one, l0, l1, l2, p0, p1, p2, pl, pp, q0, q1, q2, w0, w1, w2]
}

/// Returns `T(g) v`, the coordinates after the motion g.
#[must_use]
pub fn act<R: Ring>(g: &Motion<R>, v: &MarkedLine<R>) -> MarkedLine<R> {
    let t = &g.translation;
    let [l, p, q, w] = [1, 4, 9, 12].map(|at| g.rotate(&block(v, at)));
    let (one, pl, pp) = (&v[0], &v[7], &v[8]);
    let tt = dot(t, t);
    let tl = dot(t, &l);
    let along = twice(&tl.add(pl)).neg();
    let turned = cross(t, &q);
    let new_w = plus(&plus(&w, &scale(&l, &tt)), &plus(&scale(t, &along), &turned.map(|x| twice(&x).neg())));
    join(
        one.clone(),
        l.clone(),
        plus(&p, &scale(t, one)),
        pl.add(&tl),
        pp.add(&twice(&dot(t, &p))).add(&one.mul(&tt)),
        plus(&q, &cross(t, &l)),
        new_w,
    )
}

/// Returns `n T(g)` for a row n: the same action on linear forms.
#[must_use]
pub fn act_on_form<R: Ring>(n: &MarkedLine<R>, g: &Motion<R>) -> MarkedLine<R> {
    let t = &g.translation;
    let [a, b, e, f] = [1, 4, 9, 12].map(|at| block(n, at));
    let (c, d) = (&n[7], &n[8]);
    let tt = dot(t, t);
    let ft = twice(&dot(&f, t));
    let on_l = plus(&plus(&a, &scale(t, &c.sub(&ft))), &plus(&cross(&e, t), &scale(&f, &tt)));
    let on_p = plus(&b, &scale(t, &twice(d)));
    let on_q = plus(&e, &cross(&f, t).map(|x| twice(&x).neg()));
    let back = |x: &Vector<R>| -> Vector<R> {
        std::array::from_fn(|j| {
            let column: Vector<R> = std::array::from_fn(|i| g.rotation[i][j].clone());
            dot(&column, x)
        })
    };
    join(n[0].add(&dot(&b, t)).add(&d.mul(&tt)), back(&on_l), back(&on_p), c.sub(&ft), d.clone(), back(&on_q), back(&f))
}

/// Returns the three parts of `T(V(x)) v` for an unknown V: coefficients of (1, cos, sin), or of (1, d, d^2).
#[must_use]
pub fn split<R: Ring>(variable: Variable, v: &MarkedLine<R>) -> [MarkedLine<R>; 3] {
    let zero = || std::array::from_fn(|_| R::zero());
    let mut parts: [MarkedLine<R>; 3] = [zero(), zero(), zero()];
    match variable {
        Variable::Rotation => {
            for i in FIXED {
                parts[0][i] = v[i].clone();
            }
            for (x, y) in TURNING_X.into_iter().zip(TURNING_Y) {
                parts[1][x] = v[x].clone();
                parts[1][y] = v[y].clone();
                parts[2][x] = v[y].neg();
                parts[2][y] = v[x].clone();
            }
        }
        Variable::Translation => {
            parts[0] = v.clone();
            // d^1: p_z + d, p.l + d l_z, p.p + 2 d p_z, q + d e_z x l, w - 2 d (p.l) e_z - 2 d e_z x q
            parts[1][6] = v[0].clone();
            parts[1][7] = v[3].clone();
            parts[1][8] = twice(&v[6]);
            parts[1][9] = v[2].neg();
            parts[1][10] = v[1].clone();
            parts[1][12] = twice(&v[10]);
            parts[1][13] = twice(&v[9]).neg();
            parts[1][14] = twice(&v[7]).neg();
            // d^2: p.p + d^2, w + d^2 l - 2 d^2 l_z e_z
            parts[2][8] = v[0].clone();
            parts[2][12] = v[1].clone();
            parts[2][13] = v[2].clone();
            parts[2][14] = v[3].neg();
        }
    }
    parts
}

/// Returns the parts of `T(V(x)^-1) v`: as [`split`], for the inverse of the unknown.
#[must_use]
pub fn split_inverse<R: Ring>(variable: Variable, v: &MarkedLine<R>) -> [MarkedLine<R>; 3] {
    let [constant, first, second] = split(variable, v);
    match variable {
        Variable::Rotation => [constant, first, second.map(|x| x.neg())],
        Variable::Translation => [constant, first.map(|x| x.neg()), second],
    }
}

/// Returns the left sides of the closure equations: the 9 columns of `T(V4) T(G4) T(V5) T(G5) v6` over the monomials
/// (1, c5, s5) x (1, c4, s4), with the factor of unknown 5 as the slow index.
#[must_use]
pub fn left_columns<R: Ring>(cut: &ClosedLoop<R>) -> [MarkedLine<R>; 9] {
    let after_five = split(cut.variables[4], &act(&cut.constants[4], &z_axis()));
    let columns = after_five.map(|v| split(cut.variables[3], &act(&cut.constants[3], &v)));
    std::array::from_fn(|k| columns[k / 3][k % 3].clone())
}

/// Returns `u(q1, q2)` of the right sides `T(G3^-1) T(V3^-1) u`, up to its constant factor `T(G2^-1)`: the coefficient of
/// (1, c1, s1) x (1, c2, s2) at `[k1][k2]`.
#[must_use]
pub fn right_columns<R: Ring>(cut: &ClosedLoop<R>) -> [[MarkedLine<R>; 3]; 3] {
    let start = act(&cut.constants[5].inverse(), &z_axis());
    let back = cut.constants[0].inverse();
    split_inverse(cut.variables[0], &start).map(|v| split_inverse(cut.variables[1], &act(&back, &v)))
}
