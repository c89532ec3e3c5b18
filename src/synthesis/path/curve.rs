//! The coupler curve of a four-bar as a form in the four-bar.
//!
//! Complex numbers stand for points of the plane, and the conjugate of a number is a number of its own: d and e for a point of the
//! curve, seen from its first point. From there x leads to the moving pivot of a dyad and a to its fixed one. With the turn t of
//! the coupler the link keeps its length where `A t + B/t + C = 0`, with `A = x(e - a*)`, `B = x*(d - a)` and
//! `A + B + C = k = e(x - a) + d(x* - a*) + d e`. Both dyads have a root t in common where
//! `T(u + w) + u w = 0`, with `T = A1 B2 - A2 B1`, `u = B1 k2 - B2 k1` and `w = k1 A2 - k2 A1`. \[WamplerMorganSommese1992\]
//!
//! The form is of degree 7 in x, x*, a, a*, y, y*, b, b* of both dyads and in h, which makes it homogeneous, and of degree 3 in d and
//! in e.

use crate::algebra::ring::Ring;

/// The number of unknowns: h, then x, x*, a, a* of both dyads.
pub const UNKNOWNS: usize = 9;

/// One dyad at a point of the curve.
struct Arm<R> {
    a: R,
    b: R,
    k: R,
    /// e h - a*
    from: R,
    /// d h - a
    other_from: R,
}

impl<R: Ring> Arm<R> {
    fn of(h: &R, [x, x_star, a, a_star]: &[R; 4], d: &R, e: &R) -> Self {
        let (from, other_from) = (e.mul(h).sub(a_star), d.mul(h).sub(a));
        let links = e.mul(&x.sub(a)).add(&d.mul(&x_star.sub(a_star)));
        Self { a: x.mul(&from), b: x_star.mul(&other_from), k: links.add(&d.mul(e).mul(h)), from, other_from }
    }
}

/// The parts of the form at a point.
struct Parts<R> {
    arms: [Arm<R>; 2],
    t: R,
    u: R,
    w: R,
}

fn dyads<R: Ring>(v: &[R; UNKNOWNS]) -> [[R; 4]; 2] {
    [1, 5].map(|first| std::array::from_fn(|k| v[first + k].clone()))
}

impl<R: Ring> Parts<R> {
    fn of(v: &[R; UNKNOWNS], d: &R, e: &R) -> Self {
        let arms = dyads(v).map(|dyad| Arm::of(&v[0], &dyad, d, e));
        let [one, two] = &arms;
        let t = one.a.mul(&two.b).sub(&two.a.mul(&one.b));
        let u = one.b.mul(&two.k).sub(&two.b.mul(&one.k));
        let w = one.k.mul(&two.a).sub(&two.k.mul(&one.a));
        Self { arms, t, u, w }
    }

    fn value(&self, h: &R) -> R {
        self.t.mul(&self.u.add(&self.w)).add(&h.mul(&self.u).mul(&self.w))
    }
}

/// The value of the form: 0 where the curve of the four-bar v runs through (d, e).
pub fn value<R: Ring>(v: &[R; UNKNOWNS], d: &R, e: &R) -> R {
    Parts::of(v, d, e).value(&v[0])
}

/// The turn of the coupler at a point of the curve, as a quotient, and its inverse; with one of them 0 there is none.
pub fn turn<R: Ring>(v: &[R; UNKNOWNS], d: &R, e: &R) -> [R; 3] {
    let Parts { t, u, w, .. } = Parts::of(v, d, e);
    let (u, w) = (t.add(&v[0].mul(&u)), t.add(&v[0].mul(&w)));
    [t, w, u]
}

/// The form with its derivatives.
pub struct Slopes<R> {
    pub value: R,
    /// By the unknowns.
    pub gradient: [R; UNKNOWNS],
    /// By d and e.
    pub drift: [R; 2],
}

/// The form and its derivatives.
pub fn slopes<R: Ring>(v: &[R; UNKNOWNS], d: &R, e: &R) -> Slopes<R> {
    let h = &v[0];
    let parts = Parts::of(v, d, e);
    let Parts { arms: [one, two], t, u, w } = &parts;
    // The derivatives by T, u and w, then those by A, B and k of both dyads.
    let by_t = u.add(w);
    let (by_u, by_w) = (t.add(&h.mul(w)), t.add(&h.mul(u)));
    let less = |x: &R, y: &R, z: &R, s: &R| x.mul(y).sub(&z.mul(s));
    let by_parts = [
        [less(&by_t, &two.b, &by_w, &two.k), less(&by_u, &two.k, &by_t, &two.a), less(&by_w, &two.a, &by_u, &two.b)],
        [less(&by_w, &one.k, &by_t, &one.b), less(&by_t, &one.a, &by_u, &one.k), less(&by_u, &one.b, &by_w, &one.a)],
    ];
    let mut gradient: [R; UNKNOWNS] = std::array::from_fn(|_| R::zero());
    let mut drift = [R::zero(), R::zero()];
    let mut by_h = u.mul(w);
    let product = d.mul(e);
    for (i, ([x, x_star, a, a_star], [by_a, by_b, by_k])) in dyads(v).iter().zip(&by_parts).enumerate() {
        let arm = &parts.arms[i];
        let (by_e_h, by_d_h) = (by_a.mul(x), by_b.mul(x_star));
        let (along_e, along_d) = (by_k.mul(e), by_k.mul(d));
        gradient[1 + 4 * i] = by_a.mul(&arm.from).add(&along_e);
        gradient[2 + 4 * i] = by_b.mul(&arm.other_from).add(&along_d);
        gradient[3 + 4 * i] = by_d_h.add(&along_e).neg();
        gradient[4 + 4 * i] = by_e_h.add(&along_d).neg();
        by_h = by_h.add(&by_d_h.mul(d)).add(&by_e_h.mul(e)).add(&by_k.mul(&product));
        drift[0] = drift[0].add(&by_d_h.mul(h)).add(&by_k.mul(&x_star.sub(a_star).add(&e.mul(h))));
        drift[1] = drift[1].add(&by_e_h.mul(h)).add(&by_k.mul(&x.sub(a).add(&d.mul(h))));
    }
    gradient[0] = by_h;
    Slopes { value: parts.value(h), gradient, drift }
}
