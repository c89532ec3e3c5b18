//! From zeros of the determinant to all six angles of a loop of rotations, side by side.

use super::lane_brackets::Brackets;
use super::lane_closure::{Angular, Pairs};
use super::lanes::Lanes;
use crate::closure::woernle_lee::MarkedLine;
use crate::elimination::cut::{Cut, Hidden};
use crate::kinematics::closed_loop::ClosedLoop;
use crate::kinematics::motion::Motion;
use pulp::Simd;

/// A cut whose constant 6 is the closing transformation or its inverse, with what back-substitution needs of it.
pub struct LaneView {
    /// The cut.
    pub cut: Cut,
    /// The angle that is given.
    pub hidden: Hidden,
    /// The constants of the cut and the inverses of the first three; the last one is made for a pose.
    constants: [Motion<f64>; 6],
    inverses: [Motion<f64>; 3],
    /// Rows that give cosine and sine of unknowns 5 and 4.
    last: [MarkedLine<f64>; 4],
}

impl LaneView {
    /// Prepares a cut of a loop of rotations, closed at any pose. `last` are the rows of its elimination that give unknowns 5 and 4.
    #[must_use]
    pub fn new(cut: Cut, hidden: Hidden, last: &[MarkedLine<f64>; 4], closed: &ClosedLoop<f64>) -> Self {
        let constants = cut.of(closed).constants;
        let inverses = [0, 1, 2].map(|k: usize| constants[k].inverse());
        Self { cut, hidden, constants, inverses, last: *last }
    }

    /// Returns the inverse of constant 6 of the cut, and that constant.
    #[must_use]
    #[inline(always)]
    pub fn ends(&self, closed: &ClosedLoop<f64>) -> [Motion<f64>; 2] {
        let (gap, back) = (closed.constants[5].clone(), closed.constants[5].inverse());
        if self.cut.reversed { [gap, back] } else { [back, gap] }
    }

    /// Returns the unknowns of the loop at zeros of the determinant with these brackets, given the hidden angle and what [`Self::ends`] returns.
    #[inline(always)]
    pub fn unknowns<S: Simd, N: Angular<S>>(
        &self,
        hidden: [N; 2],
        brackets: &Brackets<N>,
        ends: &[Motion<f64>; 2],
        one: Lanes<S>,
    ) -> Pairs<N> {
        let [start, last] = ends;
        let [a, b, c, d] = brackets.kernel(one.like(0.0));
        let other = double(longer::<S, N>([a, c], [b, d]));
        let third = double(longer::<S, N>([a, b], [c, d]));
        let (first, second) = if self.hidden == Hidden::First { (hidden, other) } else { (other, hidden) };
        // The last axis, as the frame in front of unknown 4 has it.
        let (r, t) = (&start.rotation, &start.translation);
        let mut l = real_vector([r[0][2], r[1][2], r[2][2]], one);
        let mut p = real_vector(*t, one);
        for (pair, back) in [first, second, third].into_iter().zip(&self.inverses) {
            unwind(&mut l, pair);
            unwind(&mut p, pair);
            l = rotate(back, &l, one);
            p = rotate(back, &p, one);
            for (x, shift) in p.iter_mut().zip(back.translation) {
                *x = *x + N::of(one.like(shift));
            }
        }
        let line = marked(&l, &p, one);
        let mut angles = [N::of(one.like(0.0)); 4];
        for (value, row) in angles.iter_mut().zip(&self.last) {
            for (x, factor) in line.iter().zip(row) {
                *value = x.times_plus(one.like(*factor), *value);
            }
        }
        let fifth = N::normalised([angles[0], angles[1]]);
        let fourth = N::normalised([angles[2], angles[3]]);
        // The x axis of the closing transformation, carried through the loop, is turned by unknown 6.
        let mut x: [N; 3] = real_vector(last.rotation[0], one);
        for (k, pair) in [first, second, third, fourth, fifth].into_iter().enumerate() {
            unwind(&mut x, pair);
            x = rotate_back(&self.constants[k], &x, one);
        }
        self.in_loop_order([first, second, third, fourth, fifth, N::normalised([x[0], x[1]])])
    }

    /// Returns the unknowns in the order and direction of the loop.
    #[inline(always)]
    fn in_loop_order<S: Simd, N: Angular<S>>(&self, pairs: Pairs<N>) -> Pairs<N> {
        let mut ordered = pairs;
        for (j, [cos, sin]) in pairs.into_iter().enumerate() {
            ordered[self.cut.unknown_index(j)] = [cos, if self.cut.reversed { -sin } else { sin }];
        }
        ordered
    }
}

/// The same numbers in every lane.
#[inline(always)]
fn real_vector<S: Simd, N: Angular<S>>([x, y, z]: [f64; 3], one: Lanes<S>) -> [N; 3] {
    [N::of(one.like(x)), N::of(one.like(y)), N::of(one.like(z))]
}

/// Double angles of half-angles given by multiples of cosine and sine.
#[inline(always)]
fn double<S: Simd, N: Angular<S>>([cos, sin]: [N; 2]) -> [N; 2] {
    let (square, other, product) = (cos * cos, sin * sin, cos * sin);
    let over = (square + other).inverse();
    [(square - other) * over, (product + product) * over]
}

/// The first or the second pair, whichever is longer.
#[inline(always)]
fn longer<S: Simd, N: Angular<S>>(one: [N; 2], other: [N; 2]) -> [N; 2] {
    let is_other = one[0].square_plus(one[1].square_size()).below(other[0].square_plus(other[1].square_size()));
    [N::selected(is_other, other[0], one[0]), N::selected(is_other, other[1], one[1])]
}

/// A rotation about z backwards, of a vector.
#[inline(always)]
fn unwind<S: Simd, N: Angular<S>>(v: &mut [N; 3], [cos, sin]: [N; 2]) {
    let (x, y) = (v[0], v[1]);
    v[0] = cos.mul_add(x, sin * y);
    v[1] = sin.mul_from(x, cos * y);
}

/// The image of a direction.
#[inline(always)]
fn rotate<S: Simd, N: Angular<S>>(motion: &Motion<f64>, v: &[N; 3], one: Lanes<S>) -> [N; 3] {
    let mut image = *v;
    for (x, row) in image.iter_mut().zip(&motion.rotation) {
        let inner = v[1].times_plus(one.like(row[1]), v[2].times(one.like(row[2])));
        *x = v[0].times_plus(one.like(row[0]), inner);
    }
    image
}

/// The image of a direction under the inverse.
#[inline(always)]
fn rotate_back<S: Simd, N: Angular<S>>(motion: &Motion<f64>, v: &[N; 3], one: Lanes<S>) -> [N; 3] {
    let g = &motion.rotation;
    let mut image = *v;
    for (j, x) in image.iter_mut().enumerate() {
        let inner = v[1].times_plus(one.like(g[1][j]), v[2].times(one.like(g[2][j])));
        *x = v[0].times_plus(one.like(g[0][j]), inner);
    }
    image
}

/// The sum of products.
#[inline(always)]
fn dot<S: Simd, N: Angular<S>>(x: &[N; 3], y: &[N; 3]) -> N {
    x[0].mul_add(y[0], x[1].mul_add(y[1], x[2] * y[2]))
}

/// The coordinates of a line with a marked point.
#[inline(always)]
fn marked<S: Simd, N: Angular<S>>(l: &[N; 3], p: &[N; 3], one: Lanes<S>) -> [N; 15] {
    let (pl, pp) = (dot(p, l), dot(p, p));
    let twice = pl + pl;
    [
        N::of(one),
        l[0],
        l[1],
        l[2],
        p[0],
        p[1],
        p[2],
        pl,
        pp,
        p[2].mul_from(l[1], p[1] * l[2]),
        p[0].mul_from(l[2], p[2] * l[0]),
        p[1].mul_from(l[0], p[0] * l[1]),
        twice.mul_from(p[0], pp * l[0]),
        twice.mul_from(p[1], pp * l[1]),
        twice.mul_from(p[2], pp * l[2]),
    ]
}
